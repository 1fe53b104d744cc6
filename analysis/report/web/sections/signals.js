// Forces, masses and powers against time, the phases behind them.
import { h, section } from '../dom.js';
import { curve } from '../parts/curve.js';
import { BLUE, GREEN, INK, ORANGE, PURPLE } from '../palette.js';

export function signals(model, clock) {
  const { time_s: time } = model.curves;
  if (!time.length) return null;
  const of = (name, per) => model.channel(name)?.map((v) => (v === null ? null : v / per));
  const lines = (per, ...wanted) => wanted.map(([label, name, colour, width]) => ({ label, values: of(name, per), colour, width }))
    .filter((line) => line.values);
  const plots = [
    { title: 'Force', unit: 'MN', lines: lines(1e6, ['dig force', 'dig_force', INK, 1.6], ['hoist', 'machine/hoist_force', BLUE, 1.2], ['crowd', 'machine/crowd_force', ORANGE, 1.2]), height: 250 },
    { title: 'Rock', unit: 't', lines: lines(1e3, ['in the dipper', 'rock/mass_in_dipper', PURPLE], ['in the truck', 'rock/mass_in_truck', GREEN]), height: 170 },
    { title: 'Power of the drives', unit: 'MW', lines: lines(1e6, ['hoist', 'machine/hoist_power', BLUE, 1.2], ['crowd', 'machine/crowd_power', ORANGE, 1.2], ['swing', 'machine/swing_power', GREEN, 1.2]), height: 190 },
  ].filter((plot) => plot.lines.length);
  return section('signals', 'Force, load and power',
    'Dig force is √(hoist² + crowd²), Eq. 11 of Svanberg et al. 2021. Click a curve to see that moment in the replay; drag to zoom, double-click to zoom out.',
    plots.map((plot) => curve(time, plot.lines, { ...plot, clock, bands: model.phases })), missing(model.phases));
}

const PHASES = ['approach', 'penetrate', 'fill', 'breakout', 'swing', 'dump', 'return'];

/// Says which phases the motion does not have, rather than leave the reader to look for them.
function missing(phases) {
  if (!phases.length) return null;
  const none = PHASES.filter((name) => !phases.some((phase) => phase.name === name));
  if (!none.length) return null;
  return h('p.note.missing', `Phases that the motion does not have: ${none.join(', ')}.${none.includes('return') ? ' It ends before the dipper swings back.' : ''}`);
}
