// Each value against the first, seed by seed.
import { h, section } from '../../dom.js';
import { percent } from '../../format.js';
import { table } from '../../parts/table.js';
import { columnName, meanText } from './words.js';

export function comparisons(data) {
  const list = data.comparisons;
  if (!list.length) return null;
  const groups = [...new Map(list.map((c) => [`${c.parameter} ${c.value}`, c])).values()];
  return section('comparisons', 'Paired comparisons',
    'The difference is taken seed by seed, so the seed\'s effect on both cancels. Confidence: the probability that the true mean difference has this sign. '
    + 'Of ten figures without any difference, one is outside its 90 % interval by chance.',
    groups.map((g) => h('div', h('h3', `${g.parameter}: ${g.value} against ${g.against}`), h('div.stack', table(null, [
      { name: 'Figure', cell: (c) => columnName(c.column)[0] },
      { name: 'Difference', cell: (c) => `${meanText(c)} ${columnName(c.column)[1]}` },
      { name: 'Confidence', cell: (c) => percent(c.confidence, 1) },
      { name: 'Shown', cell: (c) => (c.shown ? (c.mean > 0 ? 'more' : 'less') : '–') },
      { name: 'Pairs', cell: (c) => String(c.n) },
    ], list.filter((c) => c.parameter === g.parameter && c.value === g.value), { compact: true })))));
}
