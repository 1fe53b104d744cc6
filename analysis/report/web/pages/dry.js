// The page of a run without rock: kind "dry".
import { foot, masthead, showPage } from '../page.js';
import { seconds } from '../format.js';
import { forces } from '../sections/dry/forces.js';
import { limits } from '../sections/dry/limits.js';
import { passes } from '../sections/dry/passes.js';
import { way } from '../sections/dry/way.js';
import { work } from '../sections/work.js';
import { Clock, listenToKeys } from '../clock.js';
import { section } from '../dom.js';
import { replay } from '../replay/replay.js';
import { Frames } from '../unpack.js';

const ROCK = {
  none: 'The machine moves in the air: no rock weighs, none resists.',
  estimate: 'The rock is an estimate, not a computation: what the teeth cut weighs, and resists by the cut\'s area.',
};

showPage((data) => {
  const { summary } = data;
  const frames = new Frames(data.replay);
  const clock = new Clock(frames.times);
  listenToKeys(clock);
  window.dipper = { clock, data, frames }; // for the console, and for tests
  const phases = summary.passes.map((p) => ({ name: `pass ${p.pass}`, from: p.t_start_s, to: p.t_end_s }));
  return [
    masthead('Dipper, a run without rock', data.title, `${seconds(summary.sim_s, 1)} of ${summary.case}. ${ROCK[summary.rock_model]}`),
    passes(summary),
    section('replay', 'The machine at work', 'The bench stands as the case has it; the line is the way of the teeth.',
      replay(data.replay, frames, clock, phases, { sizes: [], classes: new Map() })),
    limits(summary.limits),
    way(data.ways, summary.faces),
    forces(data),
    work(summary.passes),
    foot(summary.version),
  ];
});
