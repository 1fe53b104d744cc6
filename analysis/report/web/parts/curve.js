// Curves on one axis, by uPlot: bands behind them, a marker that follows a clock, a click that sets it.
import uPlot from 'uplot';
import { h, onWidth } from '../dom.js';
import { number, tick } from '../format.js';
import { colour, onTheme, printing } from '../theme.js';
import { STRIP, drawBands } from './bands.js';

const FONT = '12px "IBM Plex Sans", system-ui, sans-serif';
const PAPER = 700; // px: as wide as a sheet of A4 has room; two columns of it beside each other
const COLUMN = 340;
const TICK = 36;   // between labels of given ticks
const TIME = 'time (s)';

/// lines: [{label, values, colour, width, dash, fill, stepped, gaps, dots, around, unnamed}]; x and values are arrays of the
/// same length. colour: a name of style.css. fill: how much of it shows below the line, 0 to 1. gaps: null
/// values are not drawn over. faint: half seen through. dots: no line. unnamed: no key. around: [low, high], two more arrays, a band about the line.
/// options: title, unit, height, bands [{name, from, to}], clock, together (name of the plots whose cursors go
/// together), logX, logY, xLabel, xRange, yRange, xTicks (where labels stand), xNames (what they say, from x = 0 on).
export function curve(x, lines, options) {
  const given = { xLabel: options.clock && TIME, together: options.clock && 'time', ...options };
  const box = h('div.plot', { role: 'img', 'aria-label': describe(x, lines, given) });
  const keys = lines.map((line) => ({ line, value: h('span.value', '') }));
  const head = h('figcaption', h('span.title', given.title, given.unit && h('span.unit', given.unit)),
    h('span.keys', keys.filter(({ line }) => !line.unnamed).map(({ line, value }) => h('span.key', mark(line), line.label, value))));
  const showValues = (plot, index) => keys.forEach(({ value }, k) => {
    value.textContent = index === null || index === undefined ? '' : number(plot.data[k + 1][index], 3);
  });
  const around = lines.filter((line) => line.around);
  const data = [x, ...lines.map((line) => line.values), ...around.flatMap((line) => line.around)];
  let plot;
  let shown = 0;
  const draw = (width) => {
    plot?.destroy();
    const room = printing() ? Math.min(width, box.closest('.two') ? COLUMN : PAPER) : width;
    plot = new uPlot(settings(lines, around, given, room, showValues), data, box);
    if (given.clock) followClock(plot, given.clock);
  };
  onWidth(box, (width) => draw((shown = width)));
  onTheme(() => shown && draw(shown));
  return h('figure.curve', head, box);
}

function mark(line) {
  if (line.dots) return h('i.dot', { style: `background: var(--${line.colour})` });
  return h('i', { style: `border-top: ${Math.max(line.width ?? 2, 2)}px ${line.dash ? 'dashed' : 'solid'} var(--${line.colour})${line.faint ? '; opacity: 0.35' : ''}` });
}

/// What the picture shows, in words: each line's least and largest value, and where.
function describe(x, lines, { title, unit, xLabel }) {
  const at = (k) => `${number(x[k], 3)}`;
  const said = lines.filter((line) => !line.unnamed).map(({ label, values }) => {
    let [low, high] = [-1, -1];
    values.forEach((v, k) => {
      if (!Number.isFinite(v)) return;
      if (low < 0 || v < values[low]) low = k;
      if (high < 0 || v > values[high]) high = k;
    });
    return low < 0 ? `${label}: no values` : `${label}: least ${number(values[low], 3)} at ${at(low)}, most ${number(values[high], 3)} at ${at(high)}`;
  });
  return `Chart of ${title}${unit ? `, ${unit}` : ''}, against ${xLabel ?? 'x'} from ${at(0)} to ${at(x.length - 1)}. ${said.join('; ')}.`;
}

function settings(lines, around, options, width, showValues) {
  const axis = {
    font: FONT, labelFont: FONT, stroke: colour('muted'),
    ticks: { stroke: colour('rule'), width: 1, size: 4 }, grid: { stroke: colour('grid'), width: 1 },
  };
  const bands = options.bands ?? [];
  const first = lines.length + 1; // of the series that bound the bands about lines
  return {
    width,
    height: options.height ?? 220,
    padding: [bands.length ? STRIP + 4 : 8, 10, 0, 0],
    legend: { show: false },
    cursor: {
      sync: options.together ? { key: uPlot.sync(options.together).key, setSeries: false } : undefined,
      y: false,
      points: { size: 6 },
      drag: { x: Boolean(options.together), y: false },
    },
    scales: {
      x: { time: false, distr: options.logX ? 3 : 1, range: options.xRange && (() => options.xRange) },
      y: { distr: options.logY ? 3 : 1, range: options.yRange ? () => options.yRange : undefined },
    },
    axes: [
      { ...axis, size: 26, label: options.xLabel, labelSize: options.xLabel ? 20 : 0, labelGap: 0, space: 56,
        values: options.xNames ? (_plot, ticks) => ticks.map((k) => options.xNames[k] ?? '') : labels,
        splits: options.xTicks && (() => options.xTicks), filter: options.xTicks && spaced },
      { ...axis, size: 48, space: 34, values: labels, splits: options.logY && decades },
    ],
    series: [{}, ...lines.map((line) => ({
      label: line.label, stroke: line.faint ? alpha(line.colour, 0.35) : colour(line.colour), width: line.width ?? 2, dash: line.dash,
      fill: line.fill && alpha(line.colour, line.fill),
      points: { show: Boolean(line.dots), size: 5, width: 0, fill: colour(line.colour) }, spanGaps: !line.gaps,
      paths: line.dots ? () => null : line.stepped ? uPlot.paths.stepped({ align: 1 }) : undefined,
    })), ...around.flatMap(() => [{ points: { show: false }, width: 0 }, { points: { show: false }, width: 0 }])],
    bands: around.map((line, k) => ({ series: [first + 2 * k + 1, first + 2 * k], fill: alpha(line.colour, 0.22) })),
    hooks: {
      drawClear: [(plot) => drawBands(plot, bands)],
      setCursor: [(plot) => showValues(plot, plot.cursor.idx)],
    },
  };
}

function alpha(name, share) {
  return colour(name) + Math.round(255 * share).toString(16).padStart(2, '0');
}

/// Ticks that have room for their labels; the others are left out.
function spaced(plot, ticks) {
  let last = -Infinity;
  return ticks.map((value) => {
    const at = plot.valToPos(value, 'x');
    if (at - last < TICK) return null;
    last = at;
    return value;
  });
}

const labels = (_plot, ticks) => ticks.map((t) => (t === null ? '' : tick(t)));

function decades(_plot, _axis, low, high) {
  const [from, to] = [Math.ceil(Math.log10(low)), Math.floor(Math.log10(high))];
  const every = Math.max(1, Math.ceil((to - from) / 4));
  return Array.from({ length: Math.floor((to - from) / every) + 1 }, (_, k) => 10 ** (from + k * every));
}

function followClock(plot, clock) {
  const marker = h('div.marker');
  plot.over.append(marker);
  const show = () => { marker.style.transform = `translateX(${plot.valToPos(clock.time, 'x')}px)`; };
  clock.addEventListener('time', show);
  plot.hooks.setScale = [show];
  plot.hooks.destroy = [() => clock.removeEventListener('time', show)];
  let pressed = 0;
  plot.over.addEventListener('mousedown', (event) => { pressed = event.clientX; });
  plot.over.addEventListener('click', (event) => {
    if (Math.abs(event.clientX - pressed) > 3) return; // a drag zooms
    clock.pause();
    clock.set(plot.posToVal(event.clientX - plot.over.getBoundingClientRect().left, 'x'));
  });
  show();
}
