// Forces, powers, load and cut against time.
import { section } from '../../dom.js';
import { curve } from '../../parts/curve.js';

export function forces({ curves, summary }) {
  const { time_s: time, channels } = curves;
  const line = (label, name, colour, per = 1) => ({ label, values: channels[name].values.map((v) => (v === null ? null : v / per)), colour, width: 1.4 });
  const limit = (name, colour, per) => {
    const { limit: most } = summary.limits.find((l) => l.name === name);
    return { label: `${name.split('_')[0]}'s limit`, values: time.map(() => most / per), colour, width: 1, dash: [6, 4] };
  };
  const plots = [
    { title: 'Force of the drives', unit: 'MN', height: 250, lines: [line('hoist', 'machine/hoist_force', 'blue', 1e6), line('crowd', 'machine/crowd_force', 'orange', 1e6),
      limit('hoist_force', 'blue', 1e6), limit('crowd_force', 'orange', 1e6)] },
    { title: 'Power of the drives', unit: 'MW', height: 230, lines: [line('hoist', 'machine/hoist_power', 'blue', 1e6), line('crowd', 'machine/crowd_power', 'orange', 1e6),
      line('swing', 'machine/swing_power', 'green', 1e6), limit('hoist_power', 'blue', 1e6), limit('crowd_power', 'orange', 1e6)] },
    summary.rock_model === 'estimate' && { title: 'Load', unit: 't', height: 170, lines: [line('in the dipper', 'rock/mass_in_dipper', 'purple', 1e3)] },
    summary.rock_model === 'estimate' && { title: 'Depth of the cut', unit: 'm', height: 170, lines: [line('teeth below the surface', 'rock/cut_depth', 'ink')] },
    { title: 'Drives', unit: 'm', height: 190, lines: [line('hoist', 'machine/hoist', 'blue'), line('crowd', 'machine/crowd', 'orange')] },
  ].filter(Boolean);
  const bands = summary.passes.map((p) => ({ name: `pass ${p.pass}`, from: p.t_start_s, to: p.t_dump_s }));
  return section('forces', 'Forces, powers and drives', 'Drag to zoom, double-click to zoom out.',
    plots.map((plot) => curve(time, plot.lines, { ...plot, bands, xLabel: 'time (s)', together: 'time' })));
}
