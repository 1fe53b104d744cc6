// The rock: sizes in the pile and in the load, the face before and after.
import { h, section } from '../../dom.js';
import { fixed, number } from '../../format.js';
import { passColour } from '../../palette.js';
import { curve } from '../../parts/curve.js';

export function rock(model) {
  const { sizes, pile } = model.metrics;
  if (!sizes?.length && !pile?.x_m?.length) return null;
  return section('rock', 'The rock', null, h('div.two', sizes?.length > 1 && sizeCurves(sizes), pile?.x_m?.length > 2 && profile(pile)));
}

/// Share of the mass in rocks smaller than a size. A class is one size: the curve climbs there.
function sizeCurves(sizes) {
  const classes = [...sizes].sort((a, b) => a.size_m - b.size_m);
  const x = [classes[0].size_m * 0.6, ...classes.map((c) => c.size_m), classes[classes.length - 1].size_m * 1.4];
  const passing = (share) => {
    let sum = 0;
    return [0, ...classes.map((c) => (sum += share(c) ?? 0)), 100];
  };
  const loads = classes[0].loaded_percent ?? [];
  const known = (k) => classes.some((c) => Number.isFinite(c.loaded_percent[k]));
  return curve(x, [
    { label: 'pile', values: passing((c) => c.pile_percent), colour: 'muted', width: 2.5, stepped: true },
    ...loads.map((_, k) => known(k) && { label: loads.length > 1 ? `load of pass ${k + 1}` : 'load', values: passing((c) => c.loaded_percent[k]),
      colour: passColour(k + 1), stepped: true }),
  ].filter(Boolean), { title: 'Sizes', unit: '% of the mass passing', height: 240, logX: true, yRange: [0, 104], xLabel: 'size (m)', xRange: [x[0], x[x.length - 1]],
    xTicks: classes.map((c) => Number(c.size_m.toPrecision(2))) });
}

function profile(pile) {
  // The last bin has the rims of the last rocks alone, at a rear wall too: it would show a drop.
  const shown = (values) => values.slice(0, -1);
  const angle = (degrees, sigma) => (Number.isFinite(degrees) ? ` ${fixed(degrees, 1)}${Number.isFinite(sigma) ? ` ± ${fixed(sigma, 1)}` : ''}°` : '');
  return curve(shown(pile.x_m), [
    { label: `before${angle(pile.angle_before_deg, pile.angle_before_sigma_deg)}`, values: shown(pile.before_m), colour: 'ink', width: 1.6, dash: [6, 4] },
    pile.after_m && { label: `after${angle(pile.angle_after_deg, pile.angle_after_sigma_deg)}`, values: shown(pile.after_m), colour: 'orange', fill: 0.2 },
  ].filter(Boolean), { title: 'Face', unit: `m high${Number.isFinite(pile.removed_m3_per_m) ? `; ${number(pile.removed_m3_per_m, 3)} m³ a metre of width removed` : ''}`,
    height: 240, xLabel: 'x (m)', yRange: [0, 1.08 * Math.max(...pile.before_m.filter(Number.isFinite), ...(pile.after_m ?? []).filter(Number.isFinite))] });
}
