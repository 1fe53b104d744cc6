// The drives' largest values beside their limits.
import { section } from '../../dom.js';
import { fixed, number, percent } from '../../format.js';
import { table } from '../../parts/table.js';

const SHOWN = { N: ['MN', 1e6], 'N m': ['MN m', 1e6], W: ['MW', 1e6], 'm/s': ['m/s', 1], 'rad/s': ['rad/s', 1] };
const name = (limit) => limit.name.replace('_', ' ').replace('rate', 'speed');

/// `drives`: of summary.json, where they are limited.
export function limits(rows, drives) {
  const shown = (row, value) => `${number(value / SHOWN[row.unit][1], 3)} ${SHOWN[row.unit][0]}`;
  const held = (r) => drives?.[`${r.name.split('_')[0]}_saturated_s`];
  return section('limits', drives ? 'What the drives gave' : 'What the motion demands of the drives',
    'The largest value of the run and the limit in the machine file. '
    + (drives ? 'A drive at its limit stalls or is late.' : 'A drive above its limit would stall or be late; machine.drives: limited simulates that.'),
    table(null, [
      { name: 'Drive', cell: name },
      { name: 'largest', cell: (r) => shown(r, r.most) },
      { name: 'at', unit: 's', cell: (r) => fixed(r.at_s, 1) },
      { name: 'limit', cell: (r) => shown(r, r.limit) },
      { name: 'of the limit', cell: (r) => percent(r.most / r.limit) },
      { name: drives ? 'drive at its limit' : 'time above', unit: 's', cell: (r) => fixed((drives ? held(r) : r.over_s) || NaN, 1) },
    ], rows, { compact: true, cells: true }));
}
