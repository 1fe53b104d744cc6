// A grid of numbers as colours, with its scale: drawn as SVG, so that it prints.
import { h, svg } from '../dom.js';
import { number } from '../format.js';
import { SIZE, css, gradient, ramp } from '../palette.js';

/// values[row][column], row 0 below; null: no value. options: title, unit, x {label, from, to},
/// y {label, from, to}, stops, top (the scale's upper end).
export function heatMap(values, { title, unit, x, y, stops = SIZE, top }) {
  const rows = values.length;
  const columns = values[0].length;
  const all = values.flat().filter((v) => Number.isFinite(v));
  const high = top ?? Math.max(...all, 0);
  const low = Math.min(...all, 0);
  const width = 100;
  const height = width * rows / columns;
  const cells = values.flatMap((row, j) => row.map((v, i) => Number.isFinite(v) && svg('rect', {
    x: width * i / columns, y: height * (rows - 1 - j) / rows, width: width / columns + 0.05, height: height / rows + 0.05,
    fill: css(ramp(stops, high > low ? (v - low) / (high - low) : 0)),
  }, svg('title', `${number(v, 3)} ${unit}`))));
  return h('figure.heat', h('figcaption', h('span.title', title, h('span.unit', unit))),
    h('div.axes', h('span.y', `${y.label}: ${number(y.from, 2)} to ${number(y.to, 2)}`),
      svg('svg', { viewBox: `0 0 ${width} ${height}`, role: 'img', 'aria-label': title, preserveAspectRatio: 'none' }, cells),
      h('span.x', `${x.label}: ${number(x.from, 2)} to ${number(x.to, 2)}`)),
    h('span.scale', h('span', number(low, 2)), h('i', { style: `background:${gradient(stops)}` }), h('span', `${number(high, 2)} ${unit}`)));
}
