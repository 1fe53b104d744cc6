// The page of a run without rock: kind "dry".
import { foot, masthead, showPage } from '../page.js';
import { seconds } from '../format.js';
import { forces } from '../sections/dry/forces.js';
import { limits } from '../sections/dry/limits.js';
import { passes } from '../sections/dry/passes.js';
import { way } from '../sections/dry/way.js';

const ROCK = {
  none: 'The machine moves in the air: no rock weighs, none resists.',
  estimate: 'The rock is an estimate, not a computation: what the teeth cut weighs, and resists by the cut\'s area.',
};

showPage((data) => {
  window.dipper = { data }; // for the console, and for tests
  const { summary } = data;
  return [
    masthead('Dipper, a run without rock', data.title, `${seconds(summary.sim_s, 1)} of ${summary.case}. ${ROCK[summary.rock_model]}`),
    passes(summary),
    limits(summary.limits),
    way(data.ways, summary.faces),
    forces(data),
    foot(summary.version),
  ];
});
