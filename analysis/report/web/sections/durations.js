// The duration of a pass; called a cycle only if the dipper returns in each.
import { h } from '../dom.js';
import { fixed } from '../format.js';

const returns = (pass) => pass.phases?.some((row) => row.phase === 'return');

/// The column of a table of passes: [{t_start_s, t_end_s, phases: [{phase}]}].
export function durationColumn(passes) {
  const some = passes.some(returns);
  return {
    name: !some ? 'Time without return' : passes.every(returns) ? 'Cycle' : 'Time', unit: 's',
    cell: (pass) => [fixed(pass.t_end_s - pass.t_start_s, 1), some && pass.phases && !returns(pass) && h('small', ' no return')],
  };
}
