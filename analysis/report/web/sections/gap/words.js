// Names and numbers of an analysis, as text.
import { h } from '../../dom.js';
import { number } from '../../format.js';

export const unitText = (unit) => (unit === '-' || unit === '1' ? '' : unit.replaceAll('m2', 'm²').replaceAll('m3', 'm³'));

/// "hoist_force_kN" as ["hoist force", "kN"].
export function channelName(channel) {
  const at = channel.lastIndexOf('_');
  return at < 0 ? [channel, ''] : [channel.slice(0, at).replaceAll('_', ' '), channel.slice(at + 1)];
}

export function rowName([channel, feature]) {
  const [name] = channelName(channel);
  return feature === 'mass' ? name : `${name} ${feature}`;
}

export const title = (data, effect) => data.effects?.[effect]?.title ?? effect;

/// A table's cell: the effect's title, and its name where that is another; a gap.json alone has no titles.
export const titleAndName = (data, effect) => [title(data, effect), title(data, effect) !== effect && h('small', effect)];

/// "0.21 m (0.16 to 0.27, 90 %)"
export function strengthText(parameter) {
  const [low, high] = parameter.interval90;
  const unit = unitText(parameter.unit);
  return `${number(parameter.estimate, 3)}${unit && ` ${unit}`} (${number(low, 2)} to ${number(high, 2)}, 90 %)`;
}

/// "crowd force: +90 kN as the crowd moves out, and -90 kN as it moves in; hoist force: ..."
export const lawText = (law) => [law, ...(law.also ?? [])].map((one) => `${channelName(one.channel)[0]}: ${one.words}`).join('; ');

/// "pass 2 (held out)"
export const passName = (pass, heldOut) => `pass ${pass}${heldOut ? ' (held out)' : ''}`;
