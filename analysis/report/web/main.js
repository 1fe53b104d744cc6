// The page: reads what it carries, puts the sections one under the other.
import { Clock, listenToKeys } from './clock.js';
import { h, section } from './dom.js';
import { meganewtons, tonnes } from './format.js';
import { Model } from './model.js';
import { replay } from './replay/replay.js';
import { caseSection } from './sections/case.js';
import { coupling } from './sections/coupling.js';
import { filling } from './sections/filling.js';
import { headline, masthead } from './sections/headline.js';
import { payload } from './sections/payload.js';
import { rock } from './sections/rock.js';
import { signals } from './sections/signals.js';
import { Frames, readHead } from './unpack.js';

async function start() {
  // Curves are painted text and all: their font has to be there first.
  const fonts = ['400', '500', '600'].map((weight) => document.fonts.load(`${weight} 12px "IBM Plex Sans"`));
  const model = new Model(await readHead());
  await Promise.all(fonts);
  const page = document.getElementById('report');
  const frames = model.replay && new Frames(model.replay);
  const clock = new Clock(frames?.times.length ? frames.times : model.curves.time_s);
  page.append(...[
    masthead(model),
    headline(model),
    frames && section('replay', 'The dig', null, replay(model.replay, frames, clock, model.phases, model.classNames, readout(model))),
    filling(model, clock),
    signals(model, clock),
    payload(model),
    rock(model),
    coupling(model, clock),
    caseSection(model),
    h('footer', `Written by ${['dipper', model.run.version].filter(Boolean).join(' ')}. This file is complete in itself and asks for nothing over the network.`),
  ].filter(Boolean));
  listenToKeys(clock);
  window.dipper = { clock, frames, model }; // for the console, and for tests
}

/// What the machine feels at the time shown, over the picture.
function readout(model) {
  const time = model.curves.time_s;
  const wanted = [['in the dipper', 'rock/mass_in_dipper', tonnes, 't'], ['in the truck', 'rock/mass_in_truck', tonnes, 't'], ['dig force', 'dig_force', meganewtons, 'MN']]
    .filter(([, name]) => model.channel(name));
  if (!wanted.length) return null;
  const values = wanted.map(() => h('b'));
  const element = h('div.readout', wanted.map(([label, , , unit], k) => h('div', values[k], ` ${unit} ${label}`)));
  return {
    element,
    show(t) {
      let low = 0;
      let high = time.length - 1;
      while (low < high) {
        const mid = (low + high + 1) >> 1;
        if (time[mid] <= t) low = mid;
        else high = mid - 1;
      }
      wanted.forEach(([, name, text], k) => { values[k].textContent = text(model.channel(name)[low] ?? NaN); });
    },
  };
}

start().catch((error) => {
  document.getElementById('report').append(h('p.warning', { role: 'alert' }, `The report cannot be drawn: ${error.message}`));
  throw error;
});
