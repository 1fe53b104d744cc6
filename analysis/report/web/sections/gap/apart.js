// Which effects these data can tell apart.
import { h, section } from '../../dom.js';
import { fixed, number } from '../../format.js';
import { grid } from '../../parts/grid.js';
import { table } from '../../parts/table.js';
import { named, title } from './words.js';

export function apart(data) {
  const { apart: a, answer } = data;
  if (!a?.names.length) return answer.confusable?.length ? ofTheLead(answer) : null;
  const near = (i) => a.names.map((name, j) => ({ name, d: a.d_prime[i][j] })).filter((_, j) => j !== i).sort((x, y) => x.d - y.d).slice(0, 3);
  const rows = a.names.map((name, i) => ({ name, i }));
  return section('apart', 'What these data can tell apart', lead(a.confusable_below),
    h('div.stack', table(null, [
      { name: 'Effect', cell: (r) => named(data, r.name) },
      { name: 'at strength', cell: (r) => number(a.strengths[r.i], 2) },
      { name: 'stands out, d', cell: (r) => fixed(a.d[r.i], 1) },
      { name: 'found from', cell: (r) => (a.found_from[r.i] === null ? 'not within its bounds' : number(a.found_from[r.i], 2)) },
      { name: 'nearest', kind: 'text', cell: (r) => near(r.i).map(({ name, d }, k) => [
        k > 0 && ', ', d < a.confusable_below ? h('b', name, ' ', fixed(d, 1)) : `${name} ${fixed(d, 1)}`]) },
    ], rows)),
    grid('Distinguishability: the row\'s effect against any strength of the column\'s', a.names, a.names, (i, j) => i !== j && {
      text: fixed(a.d_prime[i][j], a.d_prime[i][j] < 10 ? 1 : 0), ...colouring(a.d_prime[i][j], a.confusable_below),
      say: `${title(data, a.names[i])} against ${title(data, a.names[j])}: `
        + `${fixed(a.d_prime[i][j], 1)}${a.d_prime[i][j] < a.confusable_below ? ', hard to tell from it' : ''}`,
    }, { upright: true, narrow: true }));
}

const lead = (below) => 'Computed before the measurements are used. Stands out: by how many standard deviations of instruments, seeds and nuisances, at that strength. '
  + `Found from: the approximate strength from which it is found. Framed and bold: below ${below}, the two form one class.`;

/// The nearer, the more orange; without colour from three times the limit on.
const colouring = (d, below) => (d < below ? { share: 1 - 0.5 * d / below, framed: true } : { share: Math.max(0, 0.2 * (3 - d / below)) });

function ofTheLead({ confusable, effect }) {
  return section('apart', 'How different the other effects look', null, table(null, [
    { name: 'Effect', cell: (r) => r.effect },
    { name: `distinguishability${effect ? ` from ${effect}` : ''}`, cell: (r) => fixed(r.distinguishability, 1) },
    { name: 'one class', cell: (r) => (r.same_class ? 'yes' : 'no') },
  ], confusable, { compact: true }));
}
