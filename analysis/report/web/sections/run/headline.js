// Title and the main figures.
import { h } from '../../dom.js';
import { masthead } from '../../page.js';
import { duration, fixed, meganewtons, megajoules, number, percent, seconds, tonnes } from '../../format.js';
import { table } from '../../parts/table.js';
import { timeColumn } from '../time_column.js';

export function head(model) {
  const { run } = model;
  return masthead('Dipper report', model.title,
    [
      run.rocks && `${fixed(run.rocks, 0)} rocks of ${fixed(run.particles, 0)} spheres`,
      run.sim_s && `${seconds(run.sim_s, 1)} of digging`,
      run.cpu_s && `computed in ${duration(run.cpu_s)} of processor time`,
      run.seed !== undefined && `seed ${run.seed}`,
      run.operator && (model.program ? `driven by ${model.program}` : 'each pass planned by the operator'),
    ].filter(Boolean).join(' · '),
    run.status && run.status !== 'complete' && `This run is ${run.status}: the figures cover the part that exists.`,
    ...(run.warnings ?? []));
}

export function headline(model) {
  const { passes, run } = model;
  if (!passes.length) return null;
  const columns = [
    { name: 'Pass', cell: (p) => (p.dumped === false ? [p.pass, ' ', h('small', 'unfinished')] : p.pass) },
    { name: 'Payload', unit: 't', cell: (p) => tonnes(p.payload_kg) },
    { name: 'In the truck', unit: 't', cell: (p) => tonnes(p.truck_kg) },
    { name: 'Fill factor, by the pile’s density', cell: (p) => fixed(p.fill_factor, 2) },
    { name: 'by the load’s own', alone: 'Fill factor, by the load’s own density', cell: (p) => fixed(p.fill_factor_load, 2) },
    { name: 'Dig force, mean over the dig', unit: 'MN', cell: (p) => meganewtons(p.dig_phases_force_mean_N) },
    { name: 'mean to the dump', alone: 'Dig force, mean to the dump', unit: 'MN', cell: (p) => meganewtons(p.dig_force_mean_N) },
    { name: 'peak', alone: 'Dig force, peak', unit: 'MN', cell: (p) => meganewtons(p.dig_force_peak_N, 1) },
    { name: 'Dig work', unit: 'MJ', cell: (p) => megajoules(p.dig_work_J) },
    { name: 'per payload', alone: 'Dig work per payload', unit: 'J/kg', cell: (p) => fixed(p.specific_dig_energy_J_kg, 0) },
    { name: 'Spilt', unit: 't', cell: (p) => tonnes(p.dumped === false ? NaN : p.spillage_kg, 2) },
    timeColumn,
    { name: 'Cost', unit: 'CPU s', cell: (p) => number((p.t_end_s - p.t_start_s) * run.cpu_s_per_sim_s, 3) },
  ].filter((column) => passes.some((p) => column.cell(p) !== '–'));
  const sum = (key) => passes.reduce((total, p) => total + (p[key] ?? NaN), 0);
  const whole = dumped(passes);
  const mean = (key) => whole.reduce((total, p) => total + (p[key] ?? NaN), 0) / whole.length;
  const total = passes.length > 1 ? [{
    pass: 'All', payload_kg: sum('payload_kg'), truck_kg: sum('truck_kg'),
    fill_factor: mean('fill_factor'), fill_factor_load: mean('fill_factor_load'),
    dig_force_peak_N: Math.max(...passes.map((p) => p.dig_force_peak_N)), dig_work_J: sum('dig_work_J'),
    spillage_kg: sum('spillage_kg'), t_start_s: passes[0].t_start_s, t_end_s: passes[passes.length - 1].t_end_s,
  }] : [];
  return h('section', { id: 'headline', 'aria-label': 'Headline figures', class: passes.length === 1 ? 'single' : undefined },
    table(null, columns, passes, { foot: total }), notes(model));
}

/// A pass that the run's end leaves unfinished has no load.
const dumped = (passes) => passes.filter((p) => p.dumped !== false);

/// Notes that a reader needs to judge the figures.
function notes(model) {
  const { passes, drives, metrics } = model;
  const rated = metrics.dipper?.rated_load_kg;
  const shares = dumped(passes).map((p) => percent(p.payload_kg / rated)).join(', ');
  const assumed = metrics.dipper?.rated_load_assumed ? ' (assumed, not a maker’s figure)' : '';
  return h('ul.notes', [
    rated && shares && ['Rated load', `${tonnes(rated, 0)} t${assumed}. The payload is ${shares} of it.`],
    model.run.truck && ['Truck', truck(model.run.truck)],
    drives && ['Drives', stalls(drives, model.program), ' ', h('a', { href: '#demand' }, 'By phase')],
    model.coupling && ['Scatter', scatter(metrics.dipper?.machine)],
    passes.some((p) => Number.isFinite(p.fill_factor))
      && ['Fill factor', 'Payload over what the struck volume holds: of rock as loose as in the settled pile, or as in the load itself.'],
    ['Dig force', 'The mean is over penetrate, fill and breakout. The mean to the dump is the paper\'s: from first contact until the door opens, with the swing.'],
    ['Dig work', 'Of hoist and crowd over penetrate, fill and breakout, with the lifting of dipper and load. Per payload: that work divided by the payload; 1000 J/kg is 1 MJ/t.'],
  ].filter(Boolean).map(([name, ...text]) => h('li', h('b', name), '. ', text)));
}

/// How many passes fill it, and how full it is: summary.json's truck.
function truck(t) {
  const passes = (n) => `${n} ${n === 1 ? 'pass' : 'passes'}`;
  const off = t.filled_fraction - 1;
  const more = t.passes_to_fill > t.passes ? `, if further passes load the mean ${fixed(t.mean_pass_t, 0)} t` : '';
  const now = t.passes_to_fill === t.passes ? ''
    : ` After the ${passes(t.passes)} of this run it has ${fixed(t.load_t, 0)} t, ${percent(t.load_fraction)} of it.`;
  return `${passes(t.passes_to_fill)} ${t.passes_to_fill === 1 ? 'fills' : 'fill'} it with ${fixed(t.filled_t, 0)} t, `
    + `${percent(Math.abs(off))} ${off > 0 ? 'over' : 'under'} its rated ${fixed(t.rated_t, 0)} t${more}.${now}`;
}

/// Measured for one machine: docs/data/{paper,coarse,screening,quick}_passes.csv.
function scatter(machine) {
  const known = machine === 'Bucyrus 495'
    ? 'In the cases that come with the Bucyrus 495 the payload of a pass scatters between seeds by 3 to 7 t (standard deviation), least with rock at true size.'
    : 'How much the payload scatters between seeds has not been measured for this machine.';
  return `This is one seed, one pile of this rock. ${known} To measure it for this case, run several seeds: dipper study.`;
}

/// A program that drives follows no motion: it is not behind one.
function stalls(drives, byProgram) {
  const held = ['hoist', 'crowd', 'swing'].map((name) => [name, drives[`${name}_saturated_s`]]).filter(([, s]) => s >= 0.05);
  if (!held.length) return 'None reached its limits.';
  const limits = `At the limit: ${held.map(([name, s]) => `${name} for ${fixed(s, 1)} s`).join(', ')}.`;
  if (byProgram) return limits;
  return `${limits} The machine ended ${fixed(drives.late_s, 1)} s behind its motion, `
    + `and the operator moved the crowd back by up to ${fixed(drives.crowd_relief_most_m, 2)} m.`;
}
