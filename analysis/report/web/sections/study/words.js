// Names and numbers of a study, as text.
import { number } from '../../format.js';

const SAID = {
  fill_factor: 'fill factor, by the pile’s density',
  fill_factor_load: 'fill factor, by the load’s own density',
  dig_force_mean: 'dig force, mean to the dump',
  dig_phases_force_mean: 'dig force, mean over the dig',
};

/// "payload_t" as ["payload", "t"].
export function columnName(column) {
  const at = column.lastIndexOf('_');
  const unit = at < 0 ? '' : column.slice(at + 1);
  const [name, of] = ['t', 'MN', 'MJ', 's'].includes(unit) ? [column.slice(0, at), unit] : [column, ''];
  return [SAID[name] ?? name.replaceAll('_', ' '), of];
}

/// "61.2 (58.0 to 64.4)": a mean and its 90 % interval.
export function meanText({ mean, low, high }) {
  return low === null ? number(mean) : `${number(mean)} (${number(low)} to ${number(high)})`;
}
