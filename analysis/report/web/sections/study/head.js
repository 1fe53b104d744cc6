// What was run, and what failed.
import { h, section } from '../../dom.js';
import { masthead } from '../../page.js';

export function head(data) {
  const { counts, seeds, parameters } = data;
  const missing = counts['not made'] ? `${counts['not made']} runs are not made yet; the same command continues.` : null;
  const runs = counts.unfinished ? `finished runs, and ${counts.unfinished} unfinished ones,` : 'runs';
  return masthead('Study', data.title, `${counts.complete} ${runs} of ${data.case} over ${parameters.join(', ') || 'seeds'}, `
    + `with the same ${seeds.length} seed${seeds.length === 1 ? '' : 's'} for every point. Intervals are 90 % intervals of the mean, over the seeds.`, missing);
}

export function warnings(data) {
  if (!data.warnings?.length) return null;
  return section('warnings', `${data.warnings.length} warning${data.warnings.length === 1 ? '' : 's'}`, 'Warnings of the runs themselves.',
    h('ul', data.warnings.map((text) => h('li', text))));
}

export function failures(data) {
  if (!data.failures.length) return null;
  return section('failures', `${data.failures.length} run${data.failures.length === 1 ? '' : 's'} failed`, 'They are left out of every figure below.',
    h('ul', data.failures.map((text) => h('li', text))));
}
