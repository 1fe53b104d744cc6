// What each phase asks of the machine: slack ropes, teeth off their way, forces beyond its drives'.
import { h, section } from '../../dom.js';
import { fixed } from '../../format.js';
import { table } from '../../parts/table.js';

const percent = (share) => fixed(100 * share, 1);

/// passes: [{pass, phases: [{phase, slack_fraction, teeth_deviation_m, hoist_beyond_fraction, crowd_beyond_fraction}]}]
export function demand(passes) {
  const told = passes.filter((p) => p.phases.some((row) => Number.isFinite(row.teeth_deviation_m)));
  if (!told.length) return null;
  return section('demand', 'Ropes, teeth and limits by phase',
    'Slack ropes: the dipper rides on rock. Teeth: from where taut ropes would have them, at most. Beyond: more force than the machine’s drive has.',
    told.flatMap((p) => [told.length > 1 && h('h3', `Pass ${p.pass}`), byPhase(p.phases)]));
}

function byPhase(phases) {
  return table(null, [
    { name: 'Phase', cell: (row) => row.phase },
    { name: 'ropes slack', unit: '%', cell: (row) => percent(row.slack_fraction) },
    { name: 'teeth off', unit: 'm', cell: (row) => fixed(row.teeth_deviation_m, 2) },
    { name: 'hoist beyond', unit: '%', cell: (row) => percent(row.hoist_beyond_fraction) },
    { name: 'crowd beyond', unit: '%', cell: (row) => percent(row.crowd_beyond_fraction) },
  ], phases, { compact: true });
}
