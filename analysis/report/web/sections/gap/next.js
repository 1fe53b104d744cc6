// What to measure next, what was rejected and why, and how to repeat the analysis.
import { h, section } from '../../dom.js';
import { fixed, number, percent } from '../../format.js';
import { facts, table } from '../../parts/table.js';
import { title, titleAndName } from './words.js';

const FIRST = 3;
const FOLDERS = { measured: 'measured folder', reference: 'reference folder' };

export function experiments(data) {
  const list = (data.experiments ?? data.answer.next_experiment ?? []).slice(0, FIRST);
  if (!list.length) return null;
  return section('next', 'Next experiment', 'The experiments that tell most per minute about which effect it is. After the colon: the effects that an outcome would support.',
    h('ol', list.map((e) => h('li', h('b', e.title), ` (${number(e.minutes, 2)} min, ${fixed(e.bits, 1)} bits)`,
      e.answers && h('ul', e.answers.map(([seen, effects]) => h('li', `${seen}: ${effects.map((name) => title(data, name)).join(', ')}`)))))));
}

export function rejected(data) {
  const { second } = data.answer;
  const list = data.answer.rejected?.filter((r) => r.effect !== second?.effect);
  const held = data.closures?.holdout;
  if (!list?.length && !held) return null;
  return section('rejected', 'Considered and not named', null,
    list?.length > 0 && h('div.stack', table(null, [
      { name: 'Effect', cell: (r) => titleAndName(data, r.effect) },
      { name: 'Probability that it is present', cell: (r) => percent(r.probability, 2) },
      { name: 'Why', kind: 'text', cell: (r) => r.reason },
    ], list)),
    held && table('Rivals on the held-out passes, by T²: smaller is better. A rival that makes the data ten times likelier counts as an objection', [
      { name: 'Explanation', cell: (r) => r[0] }, { name: 'T²', cell: (r) => fixed(r[1], 0) },
    ], [['the effect, fresh runs', held.t2], ...Object.entries(held.rivals)], { compact: true }));
}

export function again(data) {
  const { answer } = data;
  const patch = Object.entries(answer.patch ?? {}).map(([key, value]) => `--set ${key}=${Number(value.toPrecision(6))}`);
  const seeds = Object.entries(answer.seeds ?? {}).filter(([, list]) => list.length)
    .map(([name, list]) => [`Seeds, ${name}`, `${list[0]} to ${list[list.length - 1]}`]);
  return section('again', 'The change to the case, and how to repeat the analysis', patch.length ? 'Options of dipper run:' : null,
    patch.length ? h('pre', patch.join('\n')) : h('p', 'Nothing is added to the case.'),
    facts([
      ['Runs', answer.runs], ...seeds,
      ['Inflation of the seeds\' covariance', data.inflation && `× ${fixed(data.inflation, 2)}`],
      ...Object.entries(answer.hashes ?? {}).map(([name, hash]) => [`Hash of the ${FOLDERS[name] ?? name}`, h('code', { title: hash }, hash.slice(0, 16))]),
    ]));
}
