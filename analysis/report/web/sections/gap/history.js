// Truck by truck since the reference: how strong it is, and when it began.
import { section } from '../../dom.js';
import { fixed, number } from '../../format.js';
import { curve } from '../../parts/curve.js';
import { facts } from '../../parts/table.js';
import { since } from './foreman.js';
import { title, unitText } from './words.js';

export function history(data) {
  const { history: h, reference } = data.answer;
  if (!h) return null;
  const order = h.trucks.map((_, k) => k + 1);
  const strength = h.trucks.map((t) => t.strength);
  const began = h.began;
  const name = h.effect ? title(data, h.effect) : 'The gap';
  const lines = [
    { label: 'truck, ± 2 sd', values: strength, colour: 'ink', dots: true, around: [-2, 2].map((k) => h.trucks.map((t) => t.strength + k * t.sd)) },
    began && { label: began.shape === 'ramp' ? 'a ramp' : 'a step', values: shape(h), colour: 'blue', width: 2 },
  ].filter(Boolean);
  return section('history', 'Since when',
    'How strong it is in each truck, in the order in which they were loaded' + (reference ? `: ${reference.trucks} of the reference, then the measured ones.` : '.')
    + (h.effect ? '' : ' It has no name: 1 is the gap of the measured trucks’ mean.'),
    curve(order, lines, { title: name, unit: unitText(h.unit), height: 230, xLabel: 'truck', xTicks: order,
      xRange: [0.5, order.length + 0.5],
      bands: reference ? [{ name: 'reference', from: 0.5, to: reference.trucks + 0.5 }, { name: 'measured', from: reference.trucks + 0.5, to: order.length + 0.5 }] : [] }),
    began && facts([['It began', since(data.answer)], ['Since then', `${number(began.size, 3)} ± ${number(2 * began.size_sd, 2)} ${unitText(h.unit)} (2 sd)`],
      reference && ['Reference against the model', `mean square of z ${fixed(reference.model_gap, 1)}: this constant difference is subtracted`]].filter(Boolean)));
}

/// The step or ramp, about the mean of the trucks before it.
function shape({ trucks, began }) {
  const before = trucks.slice(0, began.after_trucks);
  const level = before.reduce((sum, t) => sum + t.strength, 0) / before.length;
  const all = trucks.length - began.after_trucks;
  return trucks.map((_, k) => level + (k < began.after_trucks ? 0 : began.size * (began.shape === 'ramp' ? (k + 1 - began.after_trucks) / all : 1)));
}
