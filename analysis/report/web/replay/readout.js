// Forces and masses at the time shown, over the picture.
import { lastUpTo } from '../clock.js';
import { h } from '../dom.js';
import { meganewtons, tonnes } from '../format.js';

export function readout(model) {
  const time = model.curves.time_s;
  const wanted = [
    ['in the dipper', model.channel('rock/mass_in_dipper'), tonnes, 't'],
    ['in the truck', model.channel('rock/mass_in_truck'), tonnes, 't'],
    ['dig force', model.digForce(), meganewtons, 'MN'],
  ].filter(([, values]) => values);
  const lines = wanted.map(() => h('div')); // empty where there is no value
  const phase = h('div.now');
  const element = h('div.readout', phase, lines);
  return {
    element,
    show(t) {
      const row = lastUpTo(time, t);
      phase.textContent = model.phases.find((p) => p.from <= t && t <= p.to)?.name ?? '';
      wanted.forEach(([label, channel, text, unit], k) => {
        const value = channel[row];
        lines[k].replaceChildren(...(Number.isFinite(value) ? [h('b', text(value)), ` ${unit} ${label}`] : []));
      });
    },
  };
}
