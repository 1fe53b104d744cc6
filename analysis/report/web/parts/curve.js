// Curves on one axis, by uPlot: bands behind them, a marker that follows a clock, a click that sets it.
import uPlot from 'uplot';
import { h, onWidth } from '../dom.js';
import { number, tick } from '../format.js';
import { INK, MUTED, phaseTone } from '../palette.js';

const FONT = '12px "IBM Plex Sans", system-ui, sans-serif';
const cursors = uPlot.sync('time');

/// lines: [{label, values, colour, width, dash, fill}]; x and values are arrays of the same length.
/// options: title, unit, height, bands [{name, from, to}], clock, logX, logY, xLabel, xRange, yRange,
/// xTicks (where labels stand), describe (what a screen reader says).
export function curve(x, lines, options) {
  const box = h('div.plot', { role: 'img', 'aria-label': options.describe ?? `${options.title}: ${lines.map((l) => l.label).join(', ')}` });
  const keys = lines.map((line) => ({ line, value: h('span.value', '') }));
  const head = h('figcaption', h('span.title', options.title, options.unit && h('span.unit', options.unit)),
    h('span.keys', keys.map(({ line, value }) => h('span.key',
      h('i', { style: `border-top: ${Math.max(line.width ?? 2, 2)}px ${line.dash ? 'dashed' : 'solid'} ${line.colour}` }), line.label, value))));
  const showValues = (plot, index) => keys.forEach(({ value }, k) => {
    value.textContent = index === null || index === undefined ? '' : number(plot.data[k + 1][index], 3);
  });
  let plot;
  onWidth(box, (width) => {
    plot?.destroy();
    plot = new uPlot(settings(lines, options, width, showValues), [x, ...lines.map((line) => line.values)], box);
    if (options.clock) followClock(plot, options.clock);
  });
  return h('figure.curve', head, box);
}

function settings(lines, options, width, showValues) {
  const axis = { font: FONT, stroke: MUTED, ticks: { stroke: '#c9c5bc', width: 1, size: 4 }, grid: { stroke: '#00000014', width: 1 } };
  const onTime = Boolean(options.clock);
  return {
    width,
    height: options.height ?? 220,
    padding: [8, 8, 0, 0],
    legend: { show: false },
    cursor: {
      sync: onTime ? { key: cursors.key, setSeries: false } : undefined,
      y: false,
      points: { size: 6 },
      drag: { x: onTime, y: false },
      bind: { dblclick: (plot, _target, handler) => (event) => { handler(event); } },
    },
    scales: {
      x: { time: false, distr: options.logX ? 3 : 1, range: options.xRange && (() => options.xRange) },
      y: { distr: options.logY ? 3 : 1, range: options.yRange ? () => options.yRange : undefined },
    },
    axes: [
      { ...axis, size: 26, label: options.xLabel, labelFont: FONT, labelSize: 20, labelGap: 0, space: 56, values: labels,
        splits: options.xTicks && (() => options.xTicks), filter: options.xTicks && ((_plot, ticks) => ticks) },
      { ...axis, size: 48, space: 34, values: labels, splits: options.logY && decades },
    ],
    series: [{}, ...lines.map((line) => ({
      label: line.label, stroke: line.colour, width: line.width ?? 2, dash: line.dash, fill: line.fill,
      points: { show: Boolean(line.points), size: 5, fill: line.colour }, spanGaps: true,
      paths: line.stepped ? uPlot.paths.stepped({ align: 1 }) : undefined,
    }))],
    hooks: {
      drawClear: [(plot) => drawBands(plot, options.bands ?? [])],
      setCursor: [(plot) => showValues(plot, plot.cursor.idx)],
    },
  };
}

const labels = (_plot, ticks) => ticks.map((t) => (t === null ? '' : tick(t)));

function decades(_plot, _axis, low, high) {
  const [from, to] = [Math.ceil(Math.log10(low)), Math.floor(Math.log10(high))];
  const every = Math.max(1, Math.ceil((to - from) / 4));
  return Array.from({ length: Math.floor((to - from) / every) + 1 }, (_, k) => 10 ** (from + k * every));
}

function drawBands(plot, bands) {
  const { ctx, bbox } = plot;
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  ctx.font = `500 ${11 * devicePixelRatio}px "IBM Plex Sans", system-ui, sans-serif`;
  ctx.textBaseline = 'top';
  for (const band of bands) {
    const from = plot.valToPos(band.from, 'x', true);
    const to = plot.valToPos(band.to, 'x', true);
    ctx.fillStyle = band.colour ?? phaseTone(band.name);
    ctx.globalAlpha = 0.62;
    ctx.fillRect(from, bbox.top, Math.max(to - from - 1, 1), bbox.height);
    ctx.globalAlpha = 1;
    ctx.fillStyle = INK;
    if (band.name && ctx.measureText(band.name).width + 10 * devicePixelRatio < to - from) {
      ctx.globalAlpha = 0.72;
      ctx.fillText(band.name, from + 5 * devicePixelRatio, bbox.top + 4 * devicePixelRatio);
      ctx.globalAlpha = 1;
    }
  }
  ctx.restore();
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
