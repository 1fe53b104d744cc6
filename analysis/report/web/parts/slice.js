// A slice through the middle of the dipper: the rock of the flow zone, of the bulk zone and the rest.
import { h, svg } from '../dom.js';
import { fixed, tonnes } from '../format.js';

/// slice: {time_s, spheres [[out, up, radius, relative speed, x, y, z in B, rock]], walls, stage};
/// stage.near: what its time cannot be distinguished from; zone(speed, p_B): 'flow', 'bulk' or null for rock that is not in the dipper.
export function sliceFigure(slice, zone, clock, index) {
  const kinds = slice.spheres.map((s) => zone(s[3], s.slice(4, 7)));
  const count = (kind) => kinds.filter((k) => k === kind).length;
  const [left, right, low, high] = extent(slice);
  // The spheres of a rock share one outline: first all outlines of the rock, then its fills.
  const rocks = new Map();
  slice.spheres.forEach((s, k) => {
    const key = s[7] < 0 ? `s${k}` : s[7];
    rocks.set(key, [...(rocks.get(key) ?? []), k]);
  });
  const circles = [...rocks.values()].flatMap((members) => [0.045, 0].flatMap((margin) => members.map((k) => {
    const [x, z, r] = slice.spheres[k];
    return svg('circle', { cx: x, cy: -z, r: r + margin, class: `${kinds[k] ?? 'rest'}${margin ? ' outline' : ''}` });
  })));
  const { stage } = slice;
  return h('figure.slice',
    svg('svg', { viewBox: `${left} ${-high} ${right - left} ${high - low}`, role: 'img',
      'aria-label': `Slice through the dipper at ${fixed(slice.time_s, 2)} s: ${count('flow')} spheres of the flow zone, ${count('bulk')} of the bulk zone` },
    circles, svg('path', { d: slice.walls.map(([a, b, c, d]) => `M${a} ${-b}L${c} ${-d}`).join(''), 'stroke-width': 0.11, fill: 'none', 'stroke-linecap': 'round' })),
    h('figcaption', h('button.stage', { type: 'button', title: 'Show this moment in the replay', onclick: () => { clock.pause(); clock.set(slice.time_s); } },
      h('b', `${stage.stage ?? index + 1}`), h('span', `${fixed(slice.time_s, 2)} s`)),
    h('span', stage.name ?? '', Number.isFinite(stage.mass_kg) && ` · ${tonnes(stage.mass_kg)} t in the dipper`,
      stage.near && ` · ${stage.near}`)));
}

function extent(slice) {
  const x = slice.walls.flatMap(([a, , c]) => [a, c]);
  const z = slice.walls.flatMap(([, b, , d]) => [b, d]);
  if (!x.length) return [-5, 5, -5, 5];
  const [cx, cz] = [(Math.min(...x) + Math.max(...x)) / 2, (Math.min(...z) + Math.max(...z)) / 2];
  return [cx - 4.4, cx + 4.4, cz - 4.2, cz + 4.2];
}
