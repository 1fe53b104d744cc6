// Forces, masses and powers against time, the phases behind them.
import { h, section } from '../../dom.js';
import { curve } from '../../parts/curve.js';

export function signals(model, clock) {
  const { time_s: time } = model.curves;
  if (!time.length) return null;
  const of = (name, per) => model.channel(name)?.map((v) => (v === null ? null : v / per));
  const line = ([label, name, colour, width], per) => ({ label, values: of(name, per), colour, width });
  const lines = (per, ...wanted) => wanted.map((it) => line(it, per)).filter(({ values }) => values);
  const force = model.digForce()?.map((v) => (v === null ? null : v / 1e6));
  const dig = force ? [{ label: 'dig force', values: force, colour: 'ink', width: 1.6, gaps: true }] : [];
  const names = Object.keys(model.curves.channels);
  const bodies = names.filter((name) => name.startsWith('force/')).map((name, k) => [`on the ${name.slice(6)}`, name, ['blue', 'orange', 'green', 'purple'][k % 4], 1.4]);
  const weighed = names.filter((name) => name.startsWith('rock/mass_in_') && !['rock/mass_in_dipper', 'rock/mass_in_truck'].includes(name))
    .map((name) => [`in the ${name.slice(13)}`, name, 'purple']);
  const plots = [
    { title: 'Force', unit: 'MN', height: 250, lines: [...dig, ...lines(1e6,
      ['hoist', 'machine/hoist_force', 'blue', 1.2], ['crowd', 'machine/crowd_force', 'orange', 1.2], ...bodies)] },
    { title: 'Rock', unit: 't', height: 190, lines: lines(1e3,
      ['in the dipper', 'rock/mass_in_dipper', 'purple'], ['in the truck', 'rock/mass_in_truck', 'green'], ...weighed) },
    { title: 'Power of the drives', unit: 'MW', height: 210, lines: lines(1e6,
      ['hoist', 'machine/hoist_power', 'blue', 1.2], ['crowd', 'machine/crowd_power', 'orange', 1.2], ['swing', 'machine/swing_power', 'green', 1.2]) },
  ].filter((plot) => plot.lines.length);
  return section('signals', bodies.length ? 'Force and load' : 'Force, load and power',
    (bodies.length ? 'The force is the rock’s on each body, in the mean over each sync step. '
      : 'Dig force is √(hoist² + crowd²), Eq. 11 of Svanberg et al. 2021, drawn while the dipper digs: before and after that the drives carry what dipper and load weigh. ')
    + 'Click a curve to see that moment in the replay; drag to zoom, double-click to zoom out.',
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
