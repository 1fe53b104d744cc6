// What a section shows of each pass: under the pass's number where there are several, folded on a phone.
import { h } from '../dom.js';

const PHONE = matchMedia('(max-width: 720px)');

/// passes: [{pass, …}]; show(p) gives the content.
export function eachPass(passes, show) {
  if (passes.length < 2) return passes.map(show);
  return passes.map((p) => h('details.pass', { open: !PHONE.matches }, h('summary', h('h3', `Pass ${p.pass}`)), show(p)));
}
