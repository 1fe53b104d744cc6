// Every point and every run.
import { h, section } from '../../dom.js';
import { number } from '../../format.js';
import { table } from '../../parts/table.js';
import { columnName } from './words.js';

export function points(data) {
  if (!data.points.length) return null;
  return section('points', 'Points', 'Mean over the seeds and its 90 % interval; below, the standard deviation of one run.', h('div.stack', table(null, [
    { name: data.parameters.join(', ') || 'point', cell: (p) => p.values.join(', ') || 'the case' },
    ...data.columns.map(({ name }) => {
      const [title, unit] = columnName(name);
      return { name: title, unit, cell: (p) => figure(p.figures[name]) };
    }),
  ], data.points)));
}

const figure = (f) => [number(f.mean), f.low !== null && h('small', `${number(f.low)} to ${number(f.high)}`), f.sd !== null && h('small', `± ${number(f.sd, 2)}`)];

export function runs(data) {
  return section('runs', 'Runs', 'Each with its own page, as long as the cache keeps it. The same table: study.csv and study.h5.', h('div.stack', table(null, [
    { name: 'Run', cell: (r) => (r.status === 'complete' ? h('a', { href: r.report }, r.run) : r.run) },
    { name: 'Seed', cell: (r) => String(r.seed) },
    { name: 'Status', kind: 'text', cell: (r) => r.status },
    ...data.columns.map(({ name }) => ({ name: columnName(name)[0], unit: columnName(name)[1], cell: (r) => number(r[name]) })),
  ], data.runs)));
}
