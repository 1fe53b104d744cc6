// One bar, divided into the parts of a whole.
import { h } from '../dom.js';

/// parts: [{name, value, colour, text}]; colour: a name of style.css.
export function bar(label, parts) {
  const whole = parts.reduce((sum, part) => sum + Math.max(part.value, 0), 0);
  return h('figure.bar', { role: 'img', 'aria-label': `${label}: ${parts.map((p) => `${p.name} ${p.text}`).join(', ')}` },
    h('div.parts', parts.map((part) => whole > 0 && part.value > 0 &&
      h('span', { style: `flex-grow:${part.value / whole};background:var(--${part.colour})`, title: `${part.name}: ${part.text}` }))),
    h('div.keys', parts.map((part) => h('span.key', h('i', { style: `background:var(--${part.colour})` }), part.name, h('span.value', part.text)))));
}
