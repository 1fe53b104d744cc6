// A few values as bars of one scale.
import { h } from '../dom.js';

/// parts: [{name, value, colour}]; text(value) prints one.
export function lengths(title, parts, text) {
  const top = Math.max(...parts.map((part) => part.value), 1e-9);
  return h('figure', { role: 'img', 'aria-label': `${title}: ${parts.map((p) => `${p.name} ${text(p.value)}`).join(', ')}` }, h('figcaption.title', title),
    h('div.lengths', parts.map((part) => [h('span', part.name),
      h('span.share', { style: `--colour:var(--${part.colour})` }, h('i', { style: `width:${100 * part.value / top}%` })), h('span', text(part.value))])));
}
