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
    { title: 'Force', unit: 'MN', height: 250, lines: [...stalled(model, 'hoist', 'blue'), ...stalled(model, 'crowd', 'orange'), ...dig, ...lines(1e6,
      ['hoist', 'machine/hoist_force', 'blue', 1.2], ['crowd', 'machine/crowd_force', 'orange', 1.2], ...bodies)] },
    !model.program && { title: 'Behind the motion', unit: 's', height: 150, lines: lines(1, ['late', 'late', 'ink', 1.4]) },
    !model.program && { title: 'Crowd let back', unit: model.channel('machine/crowd_relief')?.some((m) => m < -0.005) ? 'm; below 0: sent further out' : 'm',
      height: 150, lines: lines(1, ['let back', 'machine/crowd_relief', 'orange', 1.4]) },
    { title: 'Rock', unit: 't', height: 190, lines: lines(1e3,
      ['in the dipper', 'rock/mass_in_dipper', 'purple'], ['in the truck', 'rock/mass_in_truck', 'green'], ...weighed) },
    { title: 'Power of the drives', unit: 'MW', height: 210, lines: [...stalled(model, 'swing', 'green', 'power'), ...lines(1e6,
      ['hoist', 'machine/hoist_power', 'blue', 1.2], ['crowd', 'machine/crowd_power', 'orange', 1.2], ['swing', 'machine/swing_power', 'green', 1.2])] },
  ].filter((plot) => plot && plot.lines.length);
  return section('signals', bodies.length ? 'Force and load' : 'Force, load and power',
    (bodies.length ? 'The force is the rock’s on each body, the mean over each sync step. '
      : 'Dig force is √(hoist² + crowd²) (Svanberg et al. 2021, Eq. 11), shown while the dipper digs; before and after, the drives carry the weight of dipper and load. ')
    + 'Click a curve to see that moment in the replay. Drag to zoom, double-click to zoom out.',
    plots.map((plot) => curve(time, plot.lines, { ...plot, clock, bands: model.phases })), missing(model));
}

/// The drive's force [MN] or power [MW] where it is at its limit, as a broad line behind it; nothing where it never is.
function stalled(model, drive, colour, quantity = 'force') {
  const at = model.channel(`machine/${drive}_saturated`);
  if (!at?.some((flag) => flag > 0)) return [];
  const values = model.channel(`machine/${drive}_${quantity}`)?.map((value, k) => (at[k] > 0 && value !== null ? value / 1e6 : null));
  if (!values) return [];
  return [{ label: `${drive} at its limit`, values, colour, width: 7, gaps: true, faint: true }];
}

const PHASES = ['approach', 'penetrate', 'fill', 'breakout', 'swing', 'dump', 'return'];

/// Says which phases the motion does not have, or the run where it does not follow one to its end.
function missing({ phases, program, run }) {
  if (!phases.length) return null;
  const none = PHASES.filter((name) => !phases.some((phase) => phase.name === name));
  if (!none.length) return null;
  if (program || (run.status ?? 'complete') !== 'complete') return h('p.note.missing', `Phases that this run does not have: ${none.join(', ')}.`);
  const ends = none.includes('return') && 'The motion ends before the dipper swings back';
  return h('p.note.missing', none.length === 1 && ends ? `${ends}; there is no return phase.`
    : `Phases that the motion does not have: ${none.join(', ')}.${ends ? ` ${ends}.` : ''}`);
}
