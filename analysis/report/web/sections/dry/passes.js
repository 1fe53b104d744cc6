// Load and duration of each pass.
import { h } from '../../dom.js';
import { fixed, megajoules, meganewtons, tonnes } from '../../format.js';
import { timeColumn } from '../time_column.js';
import { table } from '../../parts/table.js';

export function passes({ passes: rows, rock_model: rock }) {
  if (!rows.length) return null;
  return h('section', { id: 'headline', 'aria-label': 'Passes', class: rows.length === 1 ? 'single' : undefined }, table(null, [
    { name: 'Pass', cell: (p) => p.pass },
    timeColumn,
    ...(rock === 'none' ? [] : [
      { name: 'Load', unit: 't', cell: (p) => tonnes(p.payload_kg) },
      { name: 'Fill factor, by the pile’s density', cell: (p) => fixed(p.fill_factor, 2) },
      { name: 'Dig force, mean over the dig', unit: 'MN', cell: (p) => meganewtons(p.dig_phases_force_mean_N ?? p.dig_force_mean_N) },
      { name: 'peak', unit: 'MN', cell: (p) => meganewtons(p.dig_force_peak_N, 1) },
      { name: 'Dig work', unit: 'MJ', cell: (p) => megajoules(p.dig_work_J) },
      { name: 'per load', unit: 'J/kg', cell: (p) => fixed(p.specific_dig_energy_J_kg, 0) },
    ]),
  ], rows));
}
