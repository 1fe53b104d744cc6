// Where and when model and mine disagree, before and with the effect.
import { h, section } from '../../dom.js';
import { fixed, number, pValue } from '../../format.js';
import { choice } from '../../parts/choice.js';
import { grid } from '../../parts/grid.js';
import { passName, rowName } from './words.js';

const TOP = 6; // standard deviations with the full colour

export function heatMap(data) {
  const cells = data.cells ?? data.answer.disagreement;
  if (!cells?.length) return null;
  const rows = data.rows ?? [...new Map(cells.map((c) => [`${c.channel} ${c.feature}`, [c.channel, c.feature]])).values()];
  const phases = (data.phases ?? ['approach', 'penetrate', 'fill', 'breakout', 'swing', 'dump', 'return'])
    .filter((phase) => cells.some((c) => c.phase === phase));
  const place = h('div.grids');
  const show = (key) => place.replaceChildren(...passes(cells, data.passes, key).map((pass) => map(data, cells, rows, phases, pass, key)));
  show('z');
  const changed = data.answer.reference;
  const after = cells.some((c) => c.z_after !== undefined);
  return section('disagreement', 'Where and when they disagree',
    `Measured minus ${changed ? 'reference' : 'simulated'}, in standard deviations of instruments and seeds together: `
    + `orange where the mine has more${changed ? ' now' : ''}, blue where it has less. `
    + `Framed: the cell’s p, adjusted for all cells searched, is at most ${data.cell_p ?? 0.05}. Grey: no value, or one that its neighbours imply.${held(data, after)}`,
    after && h('div.controls', choice('Against', [['z', changed ? 'the reference' : 'the model as it is'],
      ['z_after', `the ${changed ? 'reference' : 'model'} with the effect`]], 'z', show)), place);
}

/// Held-out passes are shown with the effect only, so that nobody searches them.
function passes(cells, parts, key) {
  const there = [...new Set(cells.filter((c) => key === 'z_after' || c.p_adjusted !== undefined).map((c) => c.pass))];
  return there.sort((a, b) => a - b).map((pass) => ({ pass, heldOut: Boolean(parts?.holdout.includes(pass)) }));
}

function held(data, after) {
  if (!data.passes) return '';
  const { holdout } = data.passes;
  return ` Pass ${holdout.join(', ')}: held out${after ? ', shown with the effect only' : ' and not used here'}.`;
}

function map(data, cells, rows, phases, { pass, heldOut }, key) {
  const of = new Map(cells.filter((c) => c.pass === pass).map((c) => [`${c.phase} ${c.channel} ${c.feature}`, c]));
  return grid(passName(pass, heldOut).replace('p', 'P'), rows.map(rowName), phases, (i, j) => {
    const cell = of.get(`${phases[j]} ${rows[i].join(' ')}`);
    if (!cell) return null;
    const z = cell[key];
    return {
      text: fixed(z, 1), share: Math.sign(z) * Math.min(Math.abs(z) / TOP, 1) ** 0.8, framed: key === 'z' && cell.p_adjusted <= (data.cell_p ?? 0.05),
      say: [h('b', `${rowName(rows[i])} in ${cell.phase}`), `: the mine has ${z < 0 ? 'less' : 'more'}, by ${number(Math.abs(z), 3)} sd`,
        key === 'z' ? `; adjusted p ${pValue(cell.p_adjusted)}` : `; ${number(Math.abs(cell.z), 3)} ${cell.z < 0 ? 'less' : 'more'} without the effect`,
        '. ', data.curves?.some((c) => c.channel === cell.channel) && h('a', { href: `#${curveId(cell)}` }, 'The curve')],
    };
  });
}

export const curveId = ({ channel, pass }) => `curve-${channel}-${pass}`;
