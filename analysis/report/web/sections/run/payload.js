// The payload by several methods, and the rock in which they differ.
import { h, section } from '../../dom.js';
import { percent, seconds, tonnes } from '../../format.js';
import { bar } from '../../parts/bar.js';
import { eachPass } from '../../parts/each_pass.js';
import { table } from '../../parts/table.js';

export function payload(model) {
  const passes = model.passes.filter((p) => p.payload_ways);
  if (!passes.length) return null;
  return section('payload', 'The payload, weighed in several ways',
    'The rock inside the dipper, the weight on its walls while it hangs still, the gain of the truck, and what the shovel\'s own monitor would show.',
    eachPass(passes, (p) => [ways(p), notes(p), fate(p)]));
}

function ways(pass) {
  const w = pass.payload_ways;
  const rows = [
    ['rocks inside the dipper', w.inside_kg, `mean over ${span(w)}`],
    ['weight on dipper and door', w.wrench_kg, `while it hangs still, ${span(w)}`],
    ['gained by the truck', pass.dumped === false ? NaN : w.truck_kg, 'to the end of the pass'],
    ['the shovel\'s monitor', pass.monitor_payload_kg, `from hoist and crowd force, ${monitored(pass)}`],
  ].filter(([, kg]) => Number.isFinite(kg));
  const first = rows[0][1];
  return table(null, [
    { name: 'Way', cell: (r) => [r[0], h('small', r[2])] },
    { name: 'Mass', unit: 't', cell: (r) => tonnes(r[1], 2) },
    { name: 'against the first', cell: (r) => (r === rows[0] ? '–' : `${r[1] >= first ? '+' : ''}${percent(r[1] / first - 1, 2)}`) },
  ], rows, { compact: true });
}

const span = (w) => (Number.isFinite(w.still_from_s) ? `${seconds(w.still_from_s)} to ${seconds(w.still_to_s)}` : 'the last second before the door opens');

const monitored = (p) => `${seconds(p.monitor_from_s)} to ${seconds(p.monitor_to_s)}${p.monitor_at_rest ? '' : ', while they move'}; `
  + `${tonnes(p.monitor_inside_kg, 2)} t were inside then`;

function notes(pass) {
  const list = pass.payload_ways.notes ?? [];
  return list.length > 0 && h('ul.notes', list.map((text) => h('li', text)));
}

function fate(pass) {
  const of = (name, key, colour) => ({ name, value: pass[key] ?? 0, colour, text: `${tonnes(pass[key], 2)} t` });
  if (!Number.isFinite(pass.lifted_kg) || pass.dumped === false) return null;
  const rest = ['carry_back_kg', 'back_in_pile_kg', 'spillage_kg'].reduce((sum, key) => sum + (pass[key] ?? 0), 0);
  return h('div', h('h3', `Where the ${tonnes(pass.lifted_kg)} t lifted went`), bar('Fate of the load', [
    { name: 'truck', value: pass.lifted_kg - rest, colour: 'green', text: `${tonnes(pass.lifted_kg - rest, 2)} t` },
    of('spilt', 'spillage_kg', 'orange'), of('back in the pile', 'back_in_pile_kg', 'ochre'), of('still in the dipper', 'carry_back_kg', 'purple')]));
}
