// The case as it ran, and its hashes.
import { h, section } from '../../dom.js';
import { facts } from '../../parts/table.js';

export function caseSection(model) {
  if (!model.caseText) return null;
  const groups = new Map([['case', []]]);
  for (const line of model.caseText.split('\n')) {
    const at = line.indexOf('=');
    if (at < 0) continue;
    const key = line.slice(0, at);
    const dot = key.indexOf('.');
    const group = dot < 0 ? 'case' : key.slice(0, dot);
    groups.set(group, [...(groups.get(group) ?? []), [dot < 0 ? key : key.slice(dot + 1), plain(line.slice(at + 1))]]);
  }
  const { run } = model;
  const hash = (text) => text && h('code.hash', text);
  return section('case', 'The case', 'What is needed to repeat it.',
    facts([
      ['Case', run.case], ['Seed', run.seed], ['Dipper', run.version], ['Rock side', run.rock_version],
      ['Machine side', run.machine_version], ['Case hash', hash(run.case_hash)], ['End state hash', hash(run.state_hash)],
    ]),
    h('div.groups', [...groups].filter(([, keys]) => keys.length).map(([name, keys]) => h('details', h('summary', name, h('span.count', `${keys.length}`)),
      h('dl.keys', keys.map(([key, value]) => h('div', h('dt', key), h('dd', value))))))));
}

// 17 digits say the same number as the fewest that give it back.
function plain(value) {
  return value.replace(/-?\d+\.\d{6,}(e[-+]?\d+)?/gi, (digits) => String(Number(digits)));
}
