// The demand on the machine by phase: slack ropes, teeth off their path, drives at or beyond their limits.
import { section } from '../../dom.js';
import { fixed } from '../../format.js';
import { eachPass } from '../../parts/each_pass.js';
import { table } from '../../parts/table.js';

const PRESCRIBED = 'Beyond: the drive needs more force than the machine has.';
const LIMITED = 'At limit: the drive needs more force or power than it has.';
const FOLLOWS = ' Lost: by how much the machine falls behind its motion. '
  + 'Let back: how far at most the operator moves the crowd back, which makes the cut shallower.';

const percent = (share) => fixed(100 * share, 1);

/// passes: [{pass, phases: [{phase, slack_fraction, teeth_deviation_m, hoist_beyond_fraction, crowd_beyond_fraction}]}]; of limited drives
/// also {hoist, crowd, swing}_saturated_s, late_s, crowd_relief_most_m.
/// `program`: one drives, and follows no motion.
export function demand(passes, program) {
  const known = passes.filter((p) => p.phases.some((row) => Number.isFinite(row.teeth_deviation_m)));
  if (!known.length) return null;
  const limited = known.some((p) => p.phases.some((row) => Number.isFinite(row.late_s)));
  return section('demand', limited ? 'Where the drives stall' : 'Ropes, teeth and limits by phase',
    `Ropes slack: the dipper rides on rock. Teeth off: the largest distance from where taut ropes would hold them. ${limited ? LIMITED + (program ? '' : FOLLOWS) : PRESCRIBED}`,
    eachPass(known, (p) => byPhase(p.phases, limited, program)));
}

function byPhase(phases, limited, program) {
  return table(null, [
    { name: 'Phase', cell: (row) => row.phase },
    { name: 'ropes slack', unit: '%', cell: (row) => percent(row.slack_fraction) },
    { name: 'teeth off', unit: 'm', cell: (row) => fixed(row.teeth_deviation_m, 2) },
    ...(limited ? [
      ...['hoist', 'crowd', 'swing'].map((name) => ({ name: `${name} at limit`, unit: 's', cell: (row) => fixed(row[`${name}_saturated_s`], 1) })),
      ...(program ? [] : [
        { name: 'lost', unit: 's', cell: (row) => fixed(row.late_s, 1) },
        { name: 'crowd let back', unit: 'm', cell: (row) => fixed(row.crowd_relief_most_m, 2) },
      ]),
    ] : ['hoist', 'crowd'].map((name) => ({ name: `${name} beyond`, unit: '%', cell: (row) => percent(row[`${name}_beyond_fraction`]) }))),
  ], phases, { compact: true, cells: true });
}
