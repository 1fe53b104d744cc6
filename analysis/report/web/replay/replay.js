// The replay with its controls.
import { Vector3 } from 'three';
import { h, onWidth } from '../dom.js';
import { fixed, number, seconds } from '../format.js';
import { choice, toggle } from '../parts/choice.js';
import { SIZE, SPEED, classColour, gradient, PRESSED, phaseTone, ramp, rgb } from '../palette.js';
import { printing, onTheme } from '../theme.js';
import { film } from './film.js';
import { Stage } from './stage.js';

const DECADES = 5; // of a wall's field, as replay_encoder.hpp has it
// What LIGGGHTS calls them; other fields are shown under their own names.
const WALL_FIELDS = {
  normal_stress_average: { name: 'pressure', unit: 'MPa', per: 1e6 },
  shear_stress_average: { name: 'shear', unit: 'MPa', per: 1e6 },
  wear: { name: 'wear', unit: 'µm', per: 1e-6 },
};

const SPEED_TOP = 2; // m/s; a falling rock is faster, but what matters is what creeps and what slides

export function replay(head, frames, clock, phases, { sizes, classes }, readout) {
  const canvas = h('canvas', { tabindex: '0', role: 'img', 'aria-label': 'Replay of the dig in three dimensions. Drag to orbit, two fingers or the wheel to zoom.' });
  const clockFace = h('output.clock', { 'aria-live': 'off' });
  const loading = h('p.loading', { role: 'status' }, 'Unpacking the replay …');
  const still = h('img.still', { alt: 'The dig at the moment shown' });
  const screen = h('div.screen', canvas, still, loading);
  const face = h('div.face', clockFace, readout?.element);

  let stage;
  try {
    stage = new Stage(canvas, head, frames, clock, SPEED_TOP);
  } catch (error) {
    return h('p.note', 'The replay needs WebGL 2, which this browser does not provide: ', error.message);
  }

  const play = h('button.play', { type: 'button', 'aria-label': 'Play', onclick: () => clock.toggle() });
  clock.addEventListener('state', () => {
    play.setAttribute('aria-label', clock.playing ? 'Pause' : 'Play');
    play.classList.toggle('on', clock.playing);
  });
  const scrub = h('input.scrub', {
    type: 'range', min: clock.times[0], max: clock.end, step: 'any', value: clock.times[0], 'aria-label': 'Time',
    oninput: () => { clock.pause(); clock.set(Number(scrub.value)); },
  });
  const track = h('div.track', phaseBand(phases, clock), scrub);
  const rate = choice('Speed', [['0.25', '¼×'], ['1', '1×'], ['2', '2×'], ['4', '4×']], '1', (value) => { clock.rate = Number(value); });

  const legend = h('div.legend');
  const [small, large] = sizes.reduce(([low, high], size) => [Math.min(low, size), Math.max(high, size)], [Infinity, 0]);
  const colourBy = {
    speed: () => {
      stage.rocks.tint(null);
      legend.replaceChildren(scaleLegend('speed', SPEED, 0, SPEED_TOP, 'm/s', true));
    },
    size: () => {
      stage.rocks.tint((i) => ramp(SIZE, large > small ? (sizes[i] - small) / (large - small) : 0.5));
      legend.replaceChildren(scaleLegend('rock size', SIZE, small, large, 'm'));
    },
    class: () => {
      stage.rocks.tint((i) => rgb(classColour(head.type[i])));
      const types = [...new Set(head.type ?? [])].sort((a, b) => a - b);
      legend.replaceChildren(...types.map((type) => h('span.key',
        h('i', { style: `background:${classColour(type)}` }), className(classes.get(type), type))));
    },
  };
  const moves = head.speed_max_m_s > 0; // dumps may have no speeds
  const first = moves ? 'speed' : 'size';
  const colour = choice('Colour by', [moves && ['speed', 'speed'], ['size', 'size'], ['class', 'class']].filter(Boolean), first, (value) => {
    colourBy[value]();
    stage.ask();
  });
  colourBy[first]();

  const walls = wallColours(head, stage);
  const views = cameraViews(stage);
  if (!stage.dipper) delete views.Follow;
  const camera = viewButtons(views, stage);
  const cut = toggle('Cut through the dipper', (on) => { stage.cutting = on; stage.ask(); });
  const solid = toggle('Solid walls', (on) => { stage.walls.forEach((wall) => wall.seeThrough(!on)); stage.ask(); });

  const bare = toggle('Hide the shovel', (on) => { stage.figure.visible = !on; stage.ask(); });

  const show = () => {
    scrub.value = clock.time;
    scrub.setAttribute('aria-valuetext', seconds(clock.time));
    clockFace.textContent = seconds(clock.time);
    readout?.show(clock.time);
  };
  clock.addEventListener('time', show);

  onWidth(screen, (width) => stage.resize(width, screen.clientHeight));
  frames.load(() => {
    if (!stage.placed) {
      stage.placed = true;
      stage.draw();
      camera.querySelector('button').click();
    }
    loading.textContent = `Unpacking the replay … ${Math.round(100 * frames.ready / clock.times.length)} %`;
    if (frames.ready >= clock.times.length) loading.remove();
    stage.ask();
  });
  onTheme(() => {
    stage.dress();
    stage.draw();
    if (printing()) still.src = canvas.toDataURL(); // what WebGL has drawn is not printed
  });
  show();
  canvas.stage = stage; // for measurements of the drawing speed
  const picture = film(stage, clock, () => [clockFace.textContent, ...[...(readout?.element.children ?? [])].map((line) => line.textContent)],
    head.spheres > 0 && moves && { what: 'speed of the rock', stops: SPEED, low: '0', high: `≥ ${SPEED_TOP} m/s` });
  canvas.film = (...of) => { views.All(); return picture(...of); };
  return h('div.replay', face, screen,
    h('div.transport', play, track, rate),
    h('div.options', head.spheres > 0 && [colour, legend], walls, camera, stage.walls.length > 0 && h('div.group', stage.dipper && cut, solid, stage.figure && bare)),
    h('p.note', note(head), h('span.controls', ' ', h('kbd', 'Space'), ' plays, ', h('kbd', '←'), ' ', h('kbd', '→'),
      ' step a frame, with ', h('kbd', 'Shift'), ' a second.')));
}

/// A class has the case's name and the size of the simulated rocks, which coarse graining enlarges.
function className(it, type) {
  return it ? `${it.name}, ${number(it.size_m, 2)} m` : `class ${type}`;
}

/// Nothing when no wall's dumps have a field.
function wallColours(head, stage) {
  const fields = Object.keys(head.field_max).filter((field) => head.field_max[field] > 0);
  if (!fields.length) return null;
  const of = (field) => WALL_FIELDS[field] ?? { name: field, unit: '', per: 1 };
  const legend = h('div.legend');
  const colour = choice('Walls', [['', 'plain'], ...fields.map((field) => [field, of(field).name])], '', (field) => {
    stage.walls.forEach((wall) => wall.colourBy(field));
    const { unit, per } = of(field);
    const high = head.field_max[field] / per;
    legend.replaceChildren(...(field ? [scaleLegend('logarithmic; grey: less', PRESSED, high / 10 ** DECADES, high, unit)] : []));
    stage.ask();
  });
  const bare = toggle('Hide the rock', (on) => { stage.rocks.visible = !on; stage.ask(); });
  return h('div.group.walls', colour, bare, legend);
}

function note(head) {
  const few = head.one_rock_in > 1 ? ` One rock in ${head.one_rock_in} is shown.` : '';
  const rare = head.one_frame_in > 1 ? ` One frame in ${head.one_frame_in} of the dumps is shown.` : '';
  const interval = head.times_s.length > 1 ? (head.times_s[head.times_s.length - 1] - head.times_s[0]) / (head.times_s.length - 1) : 0;
  const spheres = head.spheres > 0 ? `${fixed(head.spheres, 0)} spheres, ` : '';
  return `${spheres}${head.times_s.length} frames ${number(interval, 2)} s apart, drawn on a straight line between them.${few}${rare}`;
}

function cameraViews(stage) {
  const dipper = () => stage.dipper?.position ?? stage.rocks.geometry.boundingSphere.center;
  const box = stage.bounds();
  const narrow = () => (stage.camera.aspect < 1.3 ? 1.3 : 1);
  const face = () => (narrow() > 1 ? new Vector3(7, 0, 0) : new Vector3(2.5, 2, 0)).add(dipper()).setZ(5);
  return {
    Dig: () => stage.look(face(), new Vector3(-10, -27, 10).multiplyScalar(narrow()), false),
    Follow: () => stage.look(dipper().clone().add(new Vector3(1, 0, 0)), new Vector3(-4.5, -12, 5).multiplyScalar(narrow()), true),
    Above: () => stage.look(new Vector3(dipper().x, box.center.y, 0), new Vector3(-0.5, 0, 52).multiplyScalar(narrow()), false),
    All: () => stage.look(box.center, new Vector3(-0.3, -0.86, 0.36).multiplyScalar((stage.figure ? 2.25 : 1.9) * box.radius * narrow()), false),
  };
}

/// The view taken is pressed, until the camera is turned by hand.
function viewButtons(views, stage) {
  const buttons = Object.entries(views).map(([name, look]) => h('button', {
    type: 'button', 'aria-pressed': 'false', onclick: () => { look(); press(name); } }, name));
  const press = (name) => buttons.forEach((b) => b.setAttribute('aria-pressed', String(b.textContent === name)));
  stage.controls.addEventListener('start', () => press(stage.following ? 'Follow' : null));
  return h('div.group', { role: 'group', 'aria-label': 'View' }, h('span.label', 'View'), buttons);
}

function phaseBand(phases, clock) {
  const span = clock.end - clock.times[0];
  return h('div.phases', { 'aria-hidden': 'true' }, phases.map((p) => {
    const left = 100 * (p.from - clock.times[0]) / span;
    const width = 100 * (Math.min(p.to, clock.end) - p.from) / span;
    return width > 0 && h('span', { style: `left:${left}%;width:${width}%;background:var(--${phaseTone(p.name)})`, title: p.name }, h('b', p.name));
  }));
}

function scaleLegend(what, stops, low, high, unit, open) {
  return h('span.scale', h('span', number(low, 2)), h('i', { style: `background:${gradient(stops)}` }),
    h('span', `${open ? '≥ ' : ''}${number(high, 2)} ${unit}`), h('span.what', what));
}
