// The result of an optimisation, and its confirmation by fresh seeds.
import { h } from '../../dom.js';
import { number, percent } from '../../format.js';
import { curve } from '../../parts/curve.js';
import { facts } from '../../parts/table.js';
import { meanText } from './words.js';

export function optimum(data) {
  const a = data.answer;
  if (!a) return null;
  const best = a.parameters.map((name, k) => `${name} ${number(a.best[k], 4)}`).join(', ');
  return h('section', { id: 'optimum', 'aria-label': 'Best setting' },
    h('div', { class: `verdict ${a.improved ? 'named' : 'no-gap'}` },
      h('p.head', a.improved ? `Better than the base: ${best}` : 'No better than the base is shown'), h('p', a.says)),
    facts([
      [a.objective, `${meanText(a.confirmed)} with fresh seeds`], ['Base', meanText(a.base)], ['Difference, paired', meanText(a.difference)],
      ['Confidence', percent(a.confidence, 1)], ['Best setting', best],
      ...a.constraints.map((c) => [c.text, `${meanText(c)}${c.held ? '' : ': not held'}`]),
      ['Points, runs of the search', `${a.points}, ${a.runs}`],
    ]),
    a.slices.map((s) => curve(s.x, [{ label: 'model', values: s.mean, colour: 'blue', around: [s.low, s.high] }],
      { title: `${a.objective} about the best setting`, xLabel: s.parameter, height: 180 })));
}
