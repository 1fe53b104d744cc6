// What an operator who plans saw before each pass, the digs compared, and the path chosen.
import { h, section } from '../../dom.js';
import { fixed, meganewtons, tonnes } from '../../format.js';
import { passColour, ramp, SIZE } from '../../palette.js';
import { eachPass } from '../../parts/each_pass.js';
import { table } from '../../parts/table.js';
import { way } from '../../parts/way.js';

const SHOWN = 6; // candidates, the best

/// data: {decisions: [operator/pass_N.json], end: operator/end.json or null}.
export function operator(data) {
  const decisions = data?.decisions ?? [];
  if (!decisions.length) return null;
  return section('operator', 'What the operator saw and chose',
    'Before each pass: the face as the operator saw it, in the plane of the boom, and the chosen path of the teeth. Map: the height of the rock '
    + 'from above, darker is higher; the line is the chosen heading. Expected figures are the operator\'s estimate, not the run\'s.',
    eachPass(decisions, decision), data.end && h('p.note', `End: ${data.end.reason}.`));
}

const sentence = (text) => text.charAt(0).toUpperCase() + text.slice(1);

function decision(d) {
  const chosen = d.candidates[d.chosen];
  return h('div.decision', h('p', `${sentence(d.reason)}.`),
    h('div.ways', chosen && profile(d), map(d, chosen)), candidates(d));
}

function profile(d) {
  const last = d.path_m[d.path_m.length - 1];
  return h('figure.way', h('figcaption', 'The face as seen, and the path of the teeth (control points), in m'), way(d.profile_m, d.path_m, {
    right: 30, top: 15, pass: d.pass,
    words: `A face up to ${fixed(Math.max(...d.profile_m.map(([, z]) => z)), 1)} m, and a path from ${d.path_m[0][0]} m out to ${last[0]} m out.` }));
}

/// From above: x to the right, y (left of the machine) up.
function map(d, chosen) {
  const { nx, ny, x0_m: x0, y0_m: y0, cell_m: cell, z_cm: z } = d.face;
  const most = Math.max(...z, 1);
  const canvas = h('canvas', { width: nx, height: ny, style: 'width:100%;image-rendering:pixelated',
    role: 'img', 'aria-label': `Heights from 0 to ${fixed(most / 100, 1)} m over ${fixed(nx * cell, 0)} by ${fixed(ny * cell, 0)} m` });
  const ctx = canvas.getContext('2d');
  const image = ctx.createImageData(nx, ny);
  for (let i = 0; i < nx; ++i) {
    for (let j = 0; j < ny; ++j) {
      const [r, g, b] = ramp(SIZE, z[i * ny + j] / most);
      image.data.set([r, g, b, 255], 4 * ((ny - 1 - j) * nx + i));
    }
  }
  ctx.putImageData(image, 0, 0);
  if (chosen) {
    const heading = chosen.heading_deg * Math.PI / 180;
    const row = (x) => ny - 1 - (x * Math.tan(heading) - y0) / cell;
    ctx.strokeStyle = getComputedStyle(document.documentElement).getPropertyValue(`--${passColour(d.pass)}`) || '#d55e00';
    ctx.beginPath();
    ctx.moveTo(0, row(x0));
    ctx.lineTo(nx, row(x0 + nx * cell));
    ctx.stroke();
  }
  return h('figure.way', h('figcaption', `From above, ${fixed(x0, 0)} to ${fixed(x0 + nx * cell, 0)} m from the swing axis, up to ${fixed(most / 100, 1)} m high`),
    canvas);
}

function candidates(d) {
  const score = d.goal === 'energy' ? { name: 'payload per energy', unit: 'kg/kJ', cell: (c) => fixed(1e3 * c.score, 2) }
    : { name: 'payload per time', unit: 'kg/s', cell: (c) => fixed(c.score, 0) };
  const can = d.candidates.map((c, k) => ({ ...c, chosen: k === d.chosen })).filter((c) => !c.refused)
    .sort((a, b) => b.score - a.score).slice(0, SHOWN);
  const refused = d.candidates.filter((c) => c.refused);
  const because = new Map();
  refused.forEach((c) => {
    const why = c.refused.replace(/^the (\w+) needs .* MN and has .*$/, 'the $1 has too little force')
      .replace(/^the (\w+) would be at .* m$/, 'the $1 cannot reach as far').replace(/-?\d+(\.\d+)?/g, '…');
    because.set(why, (because.get(why) ?? 0) + 1);
  });
  return [can.length > 0 && table(`The best of ${d.candidates.length}`, [
    { name: 'Heading', cell: (c) => `${fixed(c.heading_deg, 0)}°${c.chosen ? ' ← chosen' : ''}` },
    score,
    { name: 'depth', unit: 'm', cell: (c) => fixed(c.depth_m, 2) },
    { name: 'floor rises', unit: 'm/m', cell: (c) => fixed(c.floor_rise, 2) },
    { name: 'out at', unit: 'm', cell: (c) => fixed(c.exit_z_m, 1) },
    { name: 'payload', unit: 't', cell: (c) => tonnes(c.payload_kg, 0) },
    { name: 'crowd at most', unit: 'MN', cell: (c) => meganewtons(c.crowd_peak_N) },
    { name: 'hoist at most', unit: 'MN', cell: (c) => meganewtons(c.hoist_peak_N) },
    { name: 'cycle', unit: 's', cell: (c) => fixed(c.cycle_s, 1) },
    { name: 'energy', unit: 'MJ', cell: (c) => fixed(c.energy_J / 1e6, 1) },
  ], can, { compact: true, cells: true }),
  refused.length > 0 && h('p.note', `Not possible, ${refused.length}: `, [...because].map(([why, n]) => `${why} (${n})`).join('; '), '.')];
}
