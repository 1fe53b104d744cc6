// The duration of a pass: it ends as the door is shut, on the way back; what is left of that way is the next pass's.
import { fixed } from '../format.js';

/// A column of a table of passes: [{t_start_s, t_end_s}].
export const timeColumn = { name: 'Time until the door is shut', unit: 's', cell: (pass) => fixed(pass.t_end_s - pass.t_start_s, 1) };
