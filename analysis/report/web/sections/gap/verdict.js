// The verdict, and its probability.
import { h } from '../../dom.js';
import { pValue, percent } from '../../format.js';
import { masthead } from '../../page.js';
import { foreman } from './foreman.js';
import { channelName, lawText, strengthText, title } from './words.js';

const WORDS = {
  named: 'The model misses this effect. Fresh runs with the effect added were compared with the passes held out.',
  class: 'These effects look alike in these data. The experiments below would distinguish them.',
  unknown: 'Model and mine disagree, but no effect of the catalogue can be named with confidence.',
  'no-gap': 'Model and mine agree within the scatter of instruments and seeds. That does not prove that nothing is missing.',
};

const CHANGED = {
  named: 'This has changed since the reference. Fresh runs with it added were compared with the passes held out.',
  class: 'These effects look alike in these data. The experiments below would tell them apart.',
  unknown: 'The trucks now and those of the reference disagree, but no effect of the catalogue can be named with confidence.',
  'no-gap': 'The trucks now and those of the reference agree within their scatter and that of the instruments. That does not prove that nothing has changed.',
};

export function head(data) {
  return masthead(`Gap analysis of ${data.title}`, data.answer.reference ? 'What has changed?' : 'What does the model miss?', null, ...new Set(data.answer.warnings ?? []));
}

export function verdict(data) {
  const { answer } = data;
  return h('section', { id: 'verdict', 'aria-label': 'Verdict', style: 'padding-top:0' },
    h('div', { class: `verdict ${answer.verdict}` }, h('p.head', headline(data)), h('p', (answer.reference ? CHANGED : WORDS)[answer.verdict], clearest(data)),
      answer.reasons?.length > 0 && h('ul', answer.reasons.map((text) => h('li', text))), law(data), second(data)),
    foreman(data),
    h('dl.figures', figures(data).map(([name, value, more]) => h('div', h('dt', name), h('dd', value, more && h('small', more))))));
}

function headline(data) {
  const { answer } = data;
  if (answer.verdict === 'named') return `${title(data, answer.effect)}: ${answer.parameter.name} ${strengthText(answer.parameter)}`;
  if (answer.verdict === 'class') return `One of: ${answer.class.map((effect) => title(data, effect)).join(', ')}`;
  return answer.verdict === 'unknown' ? 'There is a gap, and its cause is not known' : 'No gap that these data can show';
}

/// The places that disagree most, one a phase and channel.
function clearest(data, count = 3) {
  if (data.answer.verdict !== 'unknown' || !data.cells) return null;
  const cells = data.cells.filter((c) => c.p_adjusted !== undefined).sort((a, b) => Math.abs(b.z) - Math.abs(a.z));
  const places = new Set(cells.map((c) => `${channelName(c.channel)[0]} in ${c.phase}`));
  return ` It is clearest in ${[...places].slice(0, count).join(', ')}.`;
}

/// What the residual follows from, where no effect of the catalogue explains it.
function law({ answer }) {
  if (!answer.law) return null;
  const closed = answer.gap.holdout_closure ?? null;
  return h('p', 'The difference follows from the motion. ', h('b', lawText(answer.law)),
    `. That explains ${percent(answer.law.holdout_explained)} of it on the passes held out`
    + (answer.law.effect
      ? `. The case with it (effects.${answer.law.effect}: 1) ${closed === null ? 'was run' : `closes ${percent(Math.min(closed, 1))} of the gap there`}.`
      : '.'));
}

function second(data) {
  const { second: other } = data.answer;
  if (!other) return null;
  if (other.verdict !== 'named') return h('p', 'Something else remains that cannot be named.');
  return h('p', 'A second effect is present: ', h('b', title(data, other.effect)),
    `, ${other.parameter.name} ${strengthText(other.parameter)}, probability ${percent(other.probability, 1)}.`);
}

/// [name, value, what it is between]
function figures(data) {
  const { answer, passes, closures } = data;
  const { gap } = answer;
  const rows = [
    ['probability', percent(answer.probability, 1), 'of this verdict'],
    ['omnibus p', pValue(answer.omnibus_p), 'that noise alone gives such a gap'],
    passes && ['passes', `${passes.training.length} + ${passes.holdout.length}`,
      `searched, and held out; of ${answer.trucks} truck${answer.trucks === 1 ? '' : 's'} each`
      + (answer.reference ? `, and ${answer.reference.trucks} of the reference` : '')],
  ];
  if (answer.verdict === 'named') {
    rows.push(data.stability !== undefined && ['stability', percent(data.stability), 'of resampled data have the same lead'],
      ['gap closed, searched', ...share(gap.closure, gap.closure_interval90)],
      ['gap closed, held out', ...share(gap.holdout_closure, gap.holdout_interval90)],
      closures?.holdout && ['by chance, held out', `p ${pValue(gap.holdout_p)}`]);
  }
  return rows.filter(Boolean);
}

/// More than all: what is left is, by chance, less than the noise that even a perfect model leaves.
function share(value, interval) {
  if (value === null) return ['–', 'no gap there'];
  const range = `${percent(interval[0])} to ${percent(interval[1])}, 90 %`;
  if (value > 1) return ['100 %', `all of it: the rest is below the noise floor (uncapped: ${percent(value)}; ${range})`];
  return [percent(value), interval[1] > 1 ? `${range}; over 100 %: the rest is below the noise floor` : range];
}
