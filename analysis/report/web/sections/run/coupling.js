// Steps, error and cost of the coupling.
import { h, section } from '../../dom.js';
import { duration, fixed, megajoules, number, percent } from '../../format.js';
import { bar } from '../../parts/bar.js';
import { curve } from '../../parts/curve.js';
import { facts } from '../../parts/table.js';

export function coupling(model, clock) {
  const { coupling: c, dem, mbs, run } = model;
  if (!c) return null;
  const time = model.curves.time_s;
  const work = model.channel('coupling/rock_work')?.map((v) => Math.max(Math.abs(v ?? 0), 1) / 1e6);
  const residual = model.channel('coupling/energy_residual')?.map((v) => Math.max(Math.abs(v ?? 0), 1) / 1e6);
  const sync = model.channel('sync_s')?.map((v) => (v ? v * 1e3 : null));
  // The last step is cut to the run's end, and the first row is the start.
  const within = sync?.slice(2, -2).filter((v) => v);
  const steady = within?.length > 0 && Math.max(...within) - Math.min(...within) < 1e-6;
  const share = Math.abs(c.energy_residual_J / c.interface_work_J);
  return section('coupling', 'The coupling',
    `Rock and machine exchanged forces and motion ${fixed(c.syncs, 0)} times. `
    + `The residual is the energy that the exchange created or lost: ${percent(share, 2)} of the work between them.`,
    work && residual && curve(time, [
      { label: 'work between rock and machine', values: work, colour: 'blue' },
      { label: 'residual', values: residual, colour: 'orange', width: 1.4 },
    ], { title: 'Energy', unit: 'MJ', height: 210, logY: true, clock, bands: model.phases }),
    sync && !steady && curve(time, [{ label: 'length of a sync step', values: sync, colour: 'green', width: 1.4, stepped: true }],
      { title: 'Sync step', unit: 'ms', height: 170, clock, bands: model.phases }),
    timeSpent(model),
    facts([
      ['Scheme', c.scheme],
      ['Sync step', `${number(1e3 * c.sync_step_mean_s, 3)} ms${steady ? '' : ' (mean)'}`],
      ['DEM step', dem && `${number(1e3 * dem.timestep_s, 3)} ms, ${fixed(dem.steps, 0)} of them`],
      ['Residual', `${megajoules(c.energy_residual_J, 3)} of ${megajoules(c.interface_work_J, 2)} MJ`],
      ['Messages sent again', c.resends],
      ['Wall time', dem && duration(dem.wall_s)],
      ['Processor time', run.cpu_s && `${duration(run.cpu_s)}; ${number(run.cpu_s_per_sim_s, 3)} s per simulated second`],
      ['Rock side', dem && `${number(dem.particle_steps_per_cpu_s / 1e6, 3)} million particle steps per processor second`],
      ['Machine side', mbs && `${number(mbs.realtime_factor, 2)} times real time`],
    ]));
}

function timeSpent(model) {
  const { dem, coupling: c } = model;
  if (!dem || !Number.isFinite(c.overhead_fraction)) return null;
  const rock = (1 - c.overhead_fraction) * dem.wall_s;
  const machine = Math.min(model.mbs?.cpu_s ?? 0, dem.wall_s - rock);
  const rest = Math.max(dem.wall_s - rock - machine, 0);
  const part = (name, value, colour) => ({ name, value, colour, text: `${duration(value)}, ${percent(value / dem.wall_s)}` });
  return h('div', h('h3', 'Where the time went'), bar('Wall time', [
    part('rock (DEM)', rock, 'blue'), part('machine', machine, 'sky'), part('exchange, record and waiting', rest, 'ochre')]));
}
