// Every figure against the first parameter: mean, interval, and a point a seed.
import { h, section } from '../../dom.js';
import { choice } from '../../parts/choice.js';
import { curve } from '../../parts/curve.js';
import { table } from '../../parts/table.js';
import { columnName, meanText } from './words.js';

const COLOURS = ['blue', 'orange', 'green', 'purple', 'ochre', 'sky'];

export function curves(data) {
  const [chart] = data.charts;
  if (!chart?.lines.length) return null;
  const place = h('div.two');
  const show = (column) => place.replaceChildren(...data.columns.filter(({ name }) => column === 'all' || column === name)
    .map(({ name, title }) => picture(chart, name, title)));
  const first = data.columns.length > 4 ? 'all' : data.columns[0].name;
  const pick = choice('Figure', [...data.columns.map(({ name }) => [name, columnName(name)[0]]), ['all', 'all']], first, show);
  show(first);
  return section('curves', `Against ${chart.name}`, 'Line: mean over the seeds. Band: its 90 % interval. Points: the seeds.', h('div.controls', pick), place);
}

function picture(chart, column, title) {
  const [, unit] = columnName(column);
  // Names that are no numbers stand side by side.
  const x = chart.numbers ?? chart.names.map((_, k) => k);
  const order = x.map((_, k) => k).sort((a, b) => x[a] - x[b]);
  const sorted = (values) => order.map((k) => values[k]);
  const lines = chart.lines.flatMap((line, k) => {
    const colour = COLOURS[k % COLOURS.length];
    const of = (key) => sorted(line.summaries[column].map((s) => s[key]));
    return [{ label: line.label, values: of('mean'), colour, around: [of('low'), of('high')] },
      ...line.seeds[column].map((values) => ({ label: 'a seed', values: sorted(values), colour, dots: true, unnamed: true }))];
  });
  const [low, high] = [Math.min(...x), Math.max(...x)];
  const margin = 0.06 * (high - low || 1);
  return curve(sorted(x), lines, {
    title, unit, xLabel: chart.name, xTicks: sorted(x), xRange: [low - margin, high + margin], yRange: yRange(chart.lines, column), together: 'study',
    xNames: chart.numbers ? undefined : chart.names,
  });
}

/// As far as the points and intervals reach, but at most the points' range beyond them, and to 0 where no point is below:
/// intervals of two seeds would flatten the chart. Undefined where the points do not differ.
function yRange(lines, column) {
  const points = lines.flatMap((line) => line.seeds[column].flat()).filter(Number.isFinite);
  const [low, high] = [Math.min(...points), Math.max(...points)];
  const range = high - low;
  if (!(range > 0)) return undefined;
  const ends = lines.flatMap((line) => line.summaries[column].flatMap((s) => [s.low, s.high])).filter(Number.isFinite);
  const [bottom, top] = [Math.max(Math.min(low, ...ends), low - range), Math.min(Math.max(high, ...ends), high + range)];
  const margin = 0.05 * (top - bottom);
  return [low < 0 ? bottom - margin : Math.max(bottom - margin, 0), top + margin];
}

export function trends(data) {
  if (!data.trends.length) return null;
  const several = new Set(data.trends.map((t) => t.parameter)).size > 1;
  return section('trends', 'Trends',
    `Slope of a straight line through the points of one seed, for one unit of ${several ? 'the parameter' : data.trends[0].parameter}; mean and 90 % interval over the seeds.`,
    h('div.stack', table(null, [
    { name: 'Figure', cell: (t) => columnName(t.column)[0] },
    ...(several ? [{ name: 'Parameter', kind: 'text', cell: (t) => t.parameter }] : []),
    { name: 'Slope', cell: (t) => `${meanText(t)} ${columnName(t.column)[1]}` },
    { name: 'Shown', cell: (t) => (t.low > 0 ? 'rises' : t.high < 0 ? 'falls' : '–') },
    { name: 'Lines', cell: (t) => String(t.n) },
  ], data.trends, { compact: true })));
}
