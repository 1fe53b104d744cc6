// Names and numbers of a study, as text.
import { number } from '../../format.js';

const SAID = {
  fill_factor: 'fill factor, by the pile’s density',
  fill_factor_load: 'fill factor, by the load’s own density',
};

/// "dig_force_mean_MN" as ["dig force mean", "MN"].
export function columnName(column) {
  if (SAID[column]) return [SAID[column], ''];
  const at = column.lastIndexOf('_');
  const unit = at < 0 ? '' : column.slice(at + 1);
  return ['t', 'MN', 'MJ', 's'].includes(unit) ? [column.slice(0, at).replaceAll('_', ' '), unit] : [column.replaceAll('_', ' '), ''];
}

/// "61.2 (58.0 to 64.4)": a mean and its 90 % interval.
export function meanText({ mean, low, high }) {
  return low === null ? number(mean) : `${number(mean)} (${number(low)} to ${number(high)})`;
}
