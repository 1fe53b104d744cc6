// The face of the reference and of now, as surveys show it.
import { section } from '../../dom.js';
import { number, pValue } from '../../format.js';
import { table } from '../../parts/table.js';

const NAMES = { slope: 'Slope', toe: 'Toe, distance', crest: 'Crest, distance', removed: 'Removed by a pass, per metre of width', t_a_m2: 'Truck mass over what was removed' };

const squared = (unit) => unit.replace('m2', 'm²');

export function face(data) {
  const rows = data.answer.face;
  if (!rows?.length) return null;
  return section('face', 'The face', 'Means over the trucks’ surveys; p: of so large a difference by the scatter of the trucks, adjusted for all rows.',
    table(null, [
      { name: 'Of the face', cell: (r) => NAMES[r.what] },
      { name: 'reference', cell: (r) => `${number(r.before, 3)} ${squared(r.unit)}` },
      { name: 'now', cell: (r) => `${number(r.now, 3)} ${squared(r.unit)}` },
      { name: 'p', cell: (r) => pValue(r.p_adjusted) },
    ], rows, { compact: true }));
}
