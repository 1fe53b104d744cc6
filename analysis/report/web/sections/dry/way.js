// The teeth's path over each pass's face, in the plane of the boom.
import { h, section, svg } from '../../dom.js';
import { passColour } from '../../palette.js';

const STEP = 5; // m, of the grid

export function way(ways, faces) {
  if (!ways.length) return null;
  const figures = ways.map((w) => picture(w, faces.find((f) => f.pass === w.pass)));
  return section('way', 'The path of the teeth',
    'In the plane of the boom, from the start of a pass to the dump. Line: the middle of the tooth tips. Filled: the bench of the case. '
    + 'Metres from the swing axis and above the ground.',
    h('div.ways', figures));
}

function picture(w, face) {
  const right = Math.ceil(Math.max(...w.out_m, 20) / STEP + 0.4) * STEP;
  const top = Math.ceil(Math.max(...w.up_m, 5) / STEP + 0.2) * STEP;
  const steps = (to) => Array.from({ length: Math.floor(to / STEP) + 1 }, (_, k) => k * STEP);
  const points = (xs, zs) => xs.map((x, k) => [x, zs[k]]).filter(([x]) => x <= right);
  const line = (list) => list.map(([x, z]) => `${x} ${-z}`).join('L');
  const surface = points(face.out_m, face.up_m);
  const [last] = surface.slice(-1);
  return h('figure.way', h('figcaption.title', `Pass ${w.pass}`),
    svg('svg', { viewBox: `-2 ${-top - 0.5} ${right + 2.5} ${top + 2.5}`, role: 'img',
      'aria-label': `The teeth go from ${w.out_m[0]} m out and ${w.up_m[0]} m up, through a bench of ${Math.max(...face.up_m)} m, `
        + `to ${w.out_m[w.out_m.length - 1]} m out and ${w.up_m[w.up_m.length - 1]} m up.` },
    steps(right).map((x) => [svg('path', { d: `M${x} ${-top}V0`, class: 'grid' }), svg('text', { x, y: 1.2, 'text-anchor': 'middle' }, `${x}`)]),
    steps(top).map((z) => [svg('path', { d: `M0 ${-z}H${right}`, class: 'grid' }), svg('text', { x: -0.4, y: -z + 0.3, 'text-anchor': 'end' }, `${z}`)]),
    svg('path', { d: `M${line([[surface[0][0], 0], ...surface, [right, last[1]], [right, 0]])}Z`, class: 'bench' }),
    svg('path', { d: `M0 0H${right}`, class: 'ground' }),
    svg('path', { d: `M${line(points(w.out_m, w.up_m))}`, class: 'teeth', style: `stroke:var(--${passColour(w.pass)})` })));
}
