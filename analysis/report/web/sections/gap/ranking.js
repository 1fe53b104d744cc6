// How likely each effect is, and how strong it would be.
import { h, section } from '../../dom.js';
import { number, percent } from '../../format.js';
import { table } from '../../parts/table.js';
import { named, unitText } from './words.js';

const FIRST = 6;        // rows shown at once
const NOTHING = 0.005;  // probability below which a strength is not worth showing

export function ranking(data) {
  if (!data.ranking?.length) return null;
  const rows = data.ranking;
  const place = h('div.stack');
  const show = (count) => place.replaceChildren(list(data, rows.slice(0, count)));
  show(FIRST);
  const more = h('button.link', { type: 'button', onclick: () => { show(rows.length); more.remove(); } }, `Show all ${rows.length} effects`);
  return section('ranking', 'Ranked effects',
    `Probability that the effect is present, alone or with others. No effect: ${percent(data.nothing, 1)}; an unknown one: ${percent(data.unknown, 1)}. `
    + 'Strength, if it is present: the dot is the estimate, the bar its 90 % interval, the line the range allowed.',
    place, rows.length > FIRST && h('p.controls', more));
}

function list(data, rows) {
  const made = table(null, [
    { name: 'Effect', cell: (r) => named(data, r.effect) },
    { name: 'Probability', kind: 'text', cell: (r) => [share(r.probability), percent(r.probability, 1)] },
    { name: 'Strength', kind: 'text', cell: (r) => (r.probability < NOTHING ? '–' : [interval(r, data.effects[r.effect]), strength(r, data.effects[r.effect])]) },
  ], rows);
  made.classList.add('ranking');
  return made;
}

const share = (x, colour = 'accent') => h('span.share', { style: `--colour:var(--${colour})`, 'aria-hidden': 'true' }, h('i', { style: `width:${100 * Math.min(x, 1)}%` }));

function interval({ estimate, low, high }, effect) {
  const at = (x) => `${100 * (x - effect.low) / (effect.high - effect.low)}%`;
  return h('span.interval', { 'aria-hidden': 'true', title: effect.signature }, h('i.bounds'), h('i.zero', { style: `left:${at(0)}` }),
    h('i.range', { style: `left:${at(low)};right:calc(100% - ${at(high)})` }), h('i.best', { style: `left:${at(estimate)}` }));
}

function strength({ estimate, low, high }, effect) {
  const unit = unitText(effect.unit);
  return `${number(estimate, 2)}${unit && ` ${unit}`} (${number(low, 2)} to ${number(high, 2)})`;
}
