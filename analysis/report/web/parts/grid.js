// A grid of numbers as a coloured table: read by a screen reader as a table, walked with the arrow keys, and
// each cell tells more of itself when it is pointed at.
import { h } from '../dom.js';

/// cell(row, column) gives null or {text, share: -1 (least) to 1 (most), framed, say, act}; say is text or
/// elements. options: {upright: column names stand, narrow: cells are}.
export function grid(caption, rows, columns, cell, options = {}) {
  const detail = h('p.detail', { 'aria-live': 'polite' });
  const cells = rows.map((_, i) => columns.map((_column, j) => {
    const it = cell(i, j);
    const td = element(it);
    if (it) for (const event of ['mouseenter', 'focus', 'click']) td.addEventListener(event, () => detail.replaceChildren(...[it.say].flat()));
    return td;
  }));
  const first = cells.flat().find((td) => td.hasAttribute('tabindex'));
  if (first) first.tabIndex = 0;
  const body = h('tbody', { onkeydown: (event) => walk(event, cells) }, rows.map((name, i) => h('tr', h('th', { scope: 'row' }, name), cells[i])));
  return h('div.grid', h('div.table', h('table', { class: Object.keys(options).filter((key) => options[key]).join(' ') || undefined },
    caption && h('caption', caption), h('thead', h('tr', h('td.corner', { style: 'background:none' }), columns.map((name) => h('th', { scope: 'col' }, name)))), body)), detail);
}

function element(it) {
  if (!it) return h('td', h('span', { 'aria-label': 'no value' }));
  const share = Math.min(Math.abs(it.share), 1);
  return h('td', {
    tabindex: '-1', style: `--share:${share.toFixed(3)}`,
    class: [it.share < 0 ? 'less' : 'more', share > (it.share < 0 ? 0.65 : 0.85) && 'strong', it.framed && 'framed'].filter(Boolean).join(' '),
  }, it.text);
}

const STEPS = { ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowUp: [-1, 0], ArrowDown: [1, 0] };

/// One cell of the grid is in the tab order; the arrows go to the next that has a value.
function walk(event, cells) {
  const step = STEPS[event.key];
  const i = cells.findIndex((row) => row.includes(event.target));
  if (!step || i < 0) return;
  let [y, x] = [i, cells[i].indexOf(event.target)];
  do {
    [y, x] = [y + step[0], x + step[1]];
  } while (cells[y]?.[x] && !cells[y][x].hasAttribute('tabindex'));
  const next = cells[y]?.[x];
  event.preventDefault();
  if (!next) return;
  event.target.tabIndex = -1;
  next.tabIndex = 0;
  next.focus();
}
