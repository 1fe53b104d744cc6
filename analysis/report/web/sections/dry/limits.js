// The drives' largest values beside their limits.
import { section } from '../../dom.js';
import { fixed, number, percent } from '../../format.js';
import { table } from '../../parts/table.js';

const SHOWN = { N: ['MN', 1e6], 'N m': ['MN m', 1e6], W: ['MW', 1e6], 'm/s': ['m/s', 1], 'rad/s': ['rad/s', 1] };
const name = (limit) => limit.name.replace('_', ' ').replace('rate', 'speed');

export function limits(rows) {
  const shown = (row, value) => `${number(value / SHOWN[row.unit][1], 3)} ${SHOWN[row.unit][0]}`;
  return section('limits', 'What the motion demands of the drives',
    'The largest value of the run and the limit in the machine file. A drive above its limit would stall or be late; machine.drives: limited simulates that.',
    table(null, [
      { name: 'Drive', cell: name },
      { name: 'largest', cell: (r) => shown(r, r.most) },
      { name: 'at', unit: 's', cell: (r) => fixed(r.at_s, 1) },
      { name: 'limit', cell: (r) => shown(r, r.limit) },
      { name: 'of the limit', cell: (r) => percent(r.most / r.limit) },
      { name: 'time above', unit: 's', cell: (r) => (r.over_s > 0 ? fixed(r.over_s, 1) : '–') },
    ], rows, { compact: true, cells: true }));
}
