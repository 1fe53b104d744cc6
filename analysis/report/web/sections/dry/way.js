// The teeth's path over each pass's face, in the plane of the boom.
import { h, section } from '../../dom.js';
import { way as teethPath } from '../../parts/way.js';

export function way(ways, faces) {
  if (!ways.length) return null;
  const figures = ways.map((w) => picture(w, faces.find((f) => f.pass === w.pass)));
  return section('way', 'The path of the teeth',
    'In the plane of the boom, from the start of a pass to the dump. Line: the middle of the tooth tips. Filled: the bench of the case. '
    + 'Metres from the swing axis and above the ground.',
    h('div.ways', figures));
}

function picture(w, face) {
  const points = (xs, zs) => xs.map((x, k) => [x, zs[k]]);
  const upTo = (values, least, more) => Math.ceil(Math.max(...values, least) / 5 + more) * 5; // lines of the grid
  const right = upTo(w.out_m, 20, 0.4);
  const surface = [...points(face.out_m, face.up_m).filter(([x]) => x < right), [right, face.up_m[face.up_m.length - 1]]];
  return h('figure.way', h('figcaption.title', `Pass ${w.pass}`), teethPath(surface, points(w.out_m, w.up_m), {
    right, top: upTo(w.up_m, 5, 0.2), pass: w.pass,
    words: `The teeth go from ${w.out_m[0]} m out and ${w.up_m[0]} m up, through a bench of ${Math.max(...face.up_m)} m, `
      + `to ${w.out_m[w.out_m.length - 1]} m out and ${w.up_m[w.up_m.length - 1]} m up.` }));
}
