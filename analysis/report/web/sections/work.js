// Work and power of the drives in each phase, of a run with rock or without.
import { section } from '../dom.js';
import { fixed, megajoules, megawatts } from '../format.js';
import { eachPass } from '../parts/each_pass.js';
import { table } from '../parts/table.js';

const DRIVES = ['hoist', 'crowd', 'swing'];

/// passes: [{pass, phases: [{phase, t_start_s, t_end_s, hoist_work_J, …}]}]
export function work(passes) {
  const worked = passes.filter((p) => p.phases?.some((row) => Number.isFinite(row.hoist_work_J)));
  if (!worked.length) return null;
  return section('work', 'Work and power by phase',
    'The work of each drive on the machine; negative where it brakes. Peak: the largest power.',
    eachPass(worked, (p) => byPhase(p.phases)));
}

function byPhase(phases) {
  const total = { phase: 'All', t_start_s: phases[0].t_start_s, t_end_s: phases[phases.length - 1].t_end_s };
  for (const drive of DRIVES) {
    total[`${drive}_work_J`] = phases.reduce((sum, row) => sum + row[`${drive}_work_J`], 0);
    total[`${drive}_power_mean_W`] = total[`${drive}_work_J`] / (total.t_end_s - total.t_start_s);
    total[`${drive}_power_peak_W`] = Math.max(...phases.map((row) => row[`${drive}_power_peak_W`]));
  }
  return table(null, [
    { name: 'Phase', cell: (row) => row.phase },
    { name: 'lasts', unit: 's', cell: (row) => fixed(row.t_end_s - row.t_start_s, 1) },
    ...DRIVES.flatMap((drive) => [
      { name: `${drive}, work`, alone: `${drive} work`, unit: 'MJ', cell: (row) => megajoules(row[`${drive}_work_J`], 2) },
      { name: 'mean', alone: `${drive} mean`, unit: 'MW', cell: (row) => megawatts(row[`${drive}_power_mean_W`]) },
      { name: 'peak', alone: `${drive} peak`, unit: 'MW', cell: (row) => megawatts(row[`${drive}_power_peak_W`]) },
    ]),
  ], phases, { foot: [total], compact: true, cells: true });
}
