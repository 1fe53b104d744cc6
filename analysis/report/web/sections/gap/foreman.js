// The answer for whoever runs the shovel: what, where, how much, how sure, since when, and what to measure next.
import { number, percent } from '../../format.js';
import { facts } from '../../parts/table.js';
import { channelName, lawText, strengthText, title, unitText } from './words.js';

const PLACES = 3;
const LEVELS = ['mean', 'mass', 'balance'];
const FACE = { removed: 'rock that a pass removes from the face', slope: 'slope of the face', toe: 'distance of the toe', crest: 'distance of the crest' };

export function foreman(data) {
  const { answer } = data;
  return facts([
    ['What', what(data)],
    ['Where', where(answer)],
    ['How much', howMuch(data)],
    ['Since when', since(answer)],
    ['How sure', howSure(answer)],
    ['Measure next', next(data)],
  ]);
}

function what(data) {
  const { answer } = data;
  const named = answer.reference ? 'Changed since the reference' : 'Missing in the model';
  if (answer.verdict === 'named') return `${named}: ${title(data, answer.effect)}.`;
  if (answer.verdict === 'class') return `${named}, one of these: ${answer.class.map((effect) => title(data, effect)).join('; ')}.`;
  if (answer.law) return `${named}: a force that follows from the motion; it has no name in the catalogue.`;
  if (answer.verdict === 'unknown') return `${named}: something that these data do not identify.`;
  return answer.reference ? 'Nothing that these data can show has changed.' : 'Nothing that these data can show is missing.';
}

/// The places that stand out, one a phase and channel, each with its direction: by its mean, where that stands out too.
function where(answer) {
  if (answer.verdict === 'no-gap' || !answer.disagreement.length) return null;
  const places = new Map();
  for (const { channel, phase, feature, z } of answer.disagreement) {
    const name = channelName(channel)[0];
    const place = channel === 'face_m' ? FACE[feature] : feature === 'balance' ? 'truck mass against the load on the rope' : `${name}${feature === 'mass' ? '' : ` in ${phase}`}`;
    const level = LEVELS.includes(feature) || channel === 'face_m' ? (z > 0 ? 'higher' : 'lower') : null;
    places.set(place, places.get(place) ?? level);
  }
  return [...places].slice(0, PLACES).map(([place, level]) => `${place}: ${level ?? 'differs in shape'}`).join('; ');
}

function howMuch(data) {
  const { answer } = data;
  if (answer.verdict === 'named') return `${answer.parameter.name} ${strengthText(answer.parameter)}`;
  if (answer.law) return lawText(answer.law);
  if (answer.verdict !== 'class') return null;
  return answer.class.filter((name) => answer.intervals[name]).map((name) => {
    const [low, high] = answer.intervals[name];
    return `${title(data, name)}: ${number(low, 2)} to ${number(high, 2)} ${unitText(data.effects?.[name]?.unit ?? '')}`.trim();
  }).join('; ');
}

export function since(answer) {
  const began = answer.history?.began;
  if (!began) return null;
  const trucks = answer.history.trucks;
  const name = (k) => `${trucks[k].period === 'reference' ? 'reference truck' : 'truck'} ${trucks[k].truck}${trucks[k].time ? ` (${trucks[k].time})` : ''}`;
  const [low, high] = began.interval90_trucks;
  const how = { step: 'At once', ramp: 'Little by little', unclear: 'It began' }[began.shape];
  return `${how}, between ${name(began.after_trucks - 1)} and ${name(began.after_trucks)}`
    + (low === high ? '' : `; 90 %: between ${name(low - 1)} and ${name(high)}`);
}

function howSure(answer) {
  if (answer.verdict === 'no-gap') return `Noise alone gives a gap like this in ${percent(answer.omnibus_p)} of cases.`;
  const probability = `Probability ${percent(answer.probability, 1)}`;
  if (answer.verdict === 'named' && answer.gap.holdout_closure !== null) {
    return `${probability}; with it the model closes ${percent(Math.min(answer.gap.holdout_closure, 1))} of the gap on passes that it had not seen.`;
  }
  if (answer.verdict === 'named') return `${probability}; the passes held out do not show it.`;
  if (answer.law?.effect && answer.gap.holdout_closure !== null) {
    return `That something is there: noise alone gives such a gap in ${percent(answer.omnibus_p, 1)} of cases. `
      + `With this force the model closes ${percent(Math.min(answer.gap.holdout_closure, 1))} of the gap on passes that it had not seen; what causes it is open.`;
  }
  const which = answer.verdict === 'class' ? `one of these, ${probability.toLowerCase()}` : 'open';
  return `That something is there: noise alone gives such a gap in ${percent(answer.omnibus_p, 1)} of cases. What it is: ${which}.`;
}

function next(data) {
  const [first] = data.experiments ?? data.answer.next_experiment ?? [];
  return first ? `${first.title} (${first.minutes} min)` : null;
}
