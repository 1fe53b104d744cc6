// The page of a run, or of dumps: kind "run".
import { Clock, listenToKeys } from '../clock.js';
import { section } from '../dom.js';
import { Model } from '../model.js';
import { foot, showPage } from '../page.js';
import { readout } from '../replay/readout.js';
import { replay } from '../replay/replay.js';
import { caseSection } from '../sections/run/case.js';
import { coupling } from '../sections/run/coupling.js';
import { demand } from '../sections/run/demand.js';
import { filling } from '../sections/run/filling.js';
import { head, headline } from '../sections/run/headline.js';
import { operator } from '../sections/run/operator.js';
import { payload } from '../sections/run/payload.js';
import { rock } from '../sections/run/rock.js';
import { signals } from '../sections/run/signals.js';
import { work } from '../sections/work.js';
import { Frames } from '../unpack.js';

showPage((data) => {
  const model = new Model(data);
  const frames = model.replay && new Frames(model.replay);
  const clock = new Clock(frames?.times.length ? frames.times : model.curves.time_s);
  listenToKeys(clock);
  window.dipper = { clock, frames, model }; // for the console, and for tests
  return [
    head(model),
    headline(model),
    frames && section('replay', 'The dig',
      model.caseText && 'At first rocks may still slide on the face: it is cut to its outline just before the start.',
      replay(model.replay, frames, clock, model.phases, { sizes: model.rockSizes(), classes: model.classes }, readout(model))),
    operator(data.operator),
    filling(model, clock),
    signals(model, clock),
    work(model.passes),
    demand(model.passes, model.program),
    payload(model),
    rock(model),
    coupling(model, clock),
    caseSection(model),
    foot(model.run.version),
  ];
});
