// Measured, and the model before and after: the gap, the signals, the masses.
import { h, section } from '../../dom.js';
import { fixed } from '../../format.js';
import { choice } from '../../parts/choice.js';
import { curve } from '../../parts/curve.js';
import { lengths } from '../../parts/lengths.js';
import { table } from '../../parts/table.js';
import { curveId } from './heat_map.js';
import { channelName, passName } from './words.js';

const MANY = 3; // passes from which one is shown at a time

export function beforeAfter(data) {
  const { closures, curves, masses } = data;
  if (!curves?.length && !masses?.length) return null;
  const added = (curves[0] ?? masses[0]).after !== null;
  const usual = data.answer.reference ? 'reference' : 'model';
  return section('before-after', added ? 'Before and after' : `Measured and ${usual === 'model' ? 'modelled' : 'reference'}`,
    `Measured, and the ${usual} with two standard deviations ${usual === 'model' ? 'by its seeds' : 'of what runs differ by'}`
      + (added ? '; then fresh runs with the effect added' : '') + (added && usual === 'reference' ? ', less what model and reference differ by.' : '.'),
    Object.keys(closures ?? {}).length > 0 && h('div.two', Object.entries(closures).map(([name, c]) => gap(name, c))),
    curves?.length > 0 && charts(curves, usual), masses?.length > 0 && h('div.stack', massTable(masses, usual)));
}

function gap(name, { before, after, floor }) {
  return lengths(`Gap G on the passes ${name === 'holdout' ? 'held out' : 'searched'}`, [
    { name: 'before', value: before, colour: 'orange' }, { name: 'after', value: after, colour: 'blue' }, { name: 'floor', value: floor, colour: 'muted' }],
  (v) => fixed(v, 2));
}

function charts(curves, usual) {
  const passes = [...new Map(curves.map((c) => [c.pass, c.held_out]))];
  const figures = curves.map((c) => ({ c, figure: chart(c, usual) }));
  const show = (pass) => figures.forEach(({ c, figure }) => { figure.hidden = pass !== 'all' && String(c.pass) !== pass; });
  const first = passes.length > MANY ? String((passes.find(([, held]) => held) ?? passes[0])[0]) : 'all';
  show(first);
  // A link from the heat map shows the curve it leads to.
  addEventListener('hashchange', () => {
    const wanted = figures.find(({ figure }) => `#${figure.id}` === location.hash);
    if (!wanted?.figure.hidden) return;
    pick.querySelector('input[value=all]').click();
    wanted.figure.scrollIntoView();
  });
  const pick = choice('Passes', [...passes.map(([pass, held]) => [String(pass), `${pass}${held ? ' (held out)' : ''}`]), ['all', 'all']], first, show);
  return h('div', passes.length > 1 && h('div.controls', pick), h('div.two', figures.map(({ figure }) => figure)));
}

function chart(c, usual) {
  const [name, unit] = channelName(c.channel);
  const lines = [
    { label: 'measured', values: c.measured, colour: 'ink', dots: true },
    { label: usual, values: c.before, colour: 'orange', around: [-2, 2].map((k) => c.before.map((v, i) => v + k * c.spread[i])) },
    c.after && { label: 'with the effect', values: c.after, colour: 'blue' },
  ].filter(Boolean);
  const figure = curve(c.time_s, lines, {
    title: `${name}, ${passName(c.pass, c.held_out)}`, unit, height: 230, xLabel: 'time in the pass (s)', together: `pass ${c.pass}`,
    bands: Object.entries(c.phases).map(([phase, [from, to]]) => ({ name: phase, from, to })),
  });
  figure.id = curveId(c);
  return figure;
}

function massTable(masses, usual) {
  return table(null, [
    { name: 'Truck mass', cell: (m) => passName(m.pass, m.held_out) },
    { name: 'measured', unit: 't', cell: (m) => fixed(m.measured, 1) },
    { name: usual, unit: 't', cell: (m) => `${fixed(m.before, 1)} ± ${fixed(2 * m.spread, 1)}` },
    ...(masses[0].after === null ? [] : [{ name: 'with the effect', unit: 't', cell: (m) => fixed(m.after, 1) }]),
  ], masses, { compact: true });
}
