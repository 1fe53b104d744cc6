// Controls: one of several, and on or off.
import { h } from '../dom.js';

/// values: [[value, text], …].
export function choice(label, values, chosen, act) {
  const name = `choice-${label.replace(/\W/g, '')}`;
  return h('fieldset.choice', h('legend', label), values.map(([value, text]) => h('label',
    h('input', { type: 'radio', name, value, checked: value === chosen, onchange: () => act(value) }), h('span', text))));
}

export function toggle(label, act) {
  return h('label.toggle', h('input', { type: 'checkbox', onchange: (event) => act(event.target.checked) }), h('span', label));
}
