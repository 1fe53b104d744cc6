// The page of a run without rock: kind "dry".
import { foot, masthead, showPage } from '../page.js';
import { seconds } from '../format.js';
import { forces } from '../sections/dry/forces.js';
import { limits } from '../sections/dry/limits.js';
import { passes } from '../sections/dry/passes.js';
import { way } from '../sections/dry/way.js';
import { demand } from '../sections/run/demand.js';
import { work } from '../sections/work.js';
import { Clock, listenToKeys } from '../clock.js';
import { h, section } from '../dom.js';
import { passColour } from '../palette.js';
import { replay } from '../replay/replay.js';
import { Frames } from '../unpack.js';

const ROCK = {
  none: 'The machine moves without rock: nothing weighs on it or resists it.',
  estimate: 'The rock is an estimate, not a simulation: it weighs what the teeth cut, and resists by the area of the cut.',
};

showPage((data) => {
  const { summary } = data;
  const frames = new Frames(data.replay);
  const clock = new Clock(frames.times);
  listenToKeys(clock);
  window.dipper = { clock, data, frames }; // for the console, and for tests
  const phases = summary.passes.map((p) => ({ name: `pass ${p.pass}`, from: p.t_start_s, to: p.t_end_s }));
  return [
    masthead('Dipper: a run without rock', data.title, `${seconds(summary.sim_s, 1)} of ${summary.case}. ${ROCK[summary.rock_model]}`),
    passes(summary),
    section('replay', 'The machine at work', 'The bench is the case\'s, before the first pass. A line shows the path of the teeth in each pass.',
      h('p.zones', data.ways.map(({ pass }) => h('span.key', h('i', { style: `background:var(--${passColour(pass)})` }), `pass ${pass}`))),
      replay(data.replay, frames, clock, phases, { sizes: [], classes: new Map() })),
    limits(summary.limits, summary.drives),
    summary.drives && demand(summary.passes, typeof summary.operator === 'string'),
    way(data.ways, summary.faces),
    forces(data),
    work(summary.passes),
    foot(summary.version),
  ];
});
