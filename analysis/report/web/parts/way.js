// A face and the path of the teeth through it, in the plane of the boom: metres from the swing axis and above the ground.
import { svg } from '../dom.js';
import { passColour } from '../palette.js';

const STEP = 5; // m, of the grid

/// surface, path: [[x, z], …], drawn up to x = right and z = top; `words` say for those who cannot see it what it shows.
export function way(surface, path, { right, top, pass, words }) {
  const steps = (to) => Array.from({ length: Math.floor(to / STEP) + 1 }, (_, k) => k * STEP);
  const inside = (list) => list.filter(([x]) => x <= right);
  const line = (list) => list.map(([x, z]) => `${x} ${-z}`).join('L');
  const bench = inside(surface);
  const [last] = bench.slice(-1);
  return svg('svg', { viewBox: `-2 ${-top - 0.5} ${right + 2.5} ${top + 2.5}`, role: 'img', 'aria-label': words },
    steps(right).map((x) => [svg('path', { d: `M${x} ${-top}V0`, class: 'grid' }), svg('text', { x, y: 1.2, 'text-anchor': 'middle' }, `${x}`)]),
    steps(top).map((z) => [svg('path', { d: `M0 ${-z}H${right}`, class: 'grid' }), svg('text', { x: -0.4, y: -z + 0.3, 'text-anchor': 'end' }, `${z}`)]),
    svg('path', { d: `M${line([[bench[0][0], 0], ...bench, [last[0], 0]])}Z`, class: 'bench' }),
    svg('path', { d: `M0 0H${right}`, class: 'ground' }),
    svg('path', { d: `M${line(inside(path))}`, class: 'teeth', style: `stroke:var(--${passColour(pass)})` }));
}
