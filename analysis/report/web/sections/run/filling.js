// How the dipper fills: slices at the paper's stages, the mass of the flow and of the bulk zone.
import { h, section } from '../../dom.js';
import { number } from '../../format.js';
import { curve } from '../../parts/curve.js';
import { sliceFigure } from '../../parts/slice.js';

export function filling(model, clock) {
  const { slices, zones } = model;
  if (!slices.length && !zones) return null;
  const threshold = zones?.threshold_m_s;
  const key = (colour, text) => h('span.key', h('i', { style: `background:var(--${colour})` }), text);
  return section('filling', 'How the dipper fills',
    'A slice of 1 m through the middle of the dipper at the stages of Svanberg et al. 2021 (Fig. 14). '
    + 'Rock of the flow zone slides and rolls through the dipper; rock of the bulk zone moves with it.',
    slices.length > 0 && h('div.slices', nearby(slices, model.metrics.frames?.time_s ?? []).map((slice, k) => sliceFigure(slice, zoneOf(zones), clock, k))),
    threshold !== undefined && h('p.zones', key('flow', `flow zone: faster than ${number(threshold, 2)} m/s in the dipper`),
      key('bulk', 'bulk zone'), key('rest', 'not in the dipper')),
    zones?.time_s?.length > 0 && curve(zones.time_s, [
      { label: 'all', values: zones.all_t, colour: 'flow', fill: 0.8 },
      { label: 'bulk zone', values: zones.bulk_t, colour: 'bulk', fill: 0.9 },
    ], { title: 'Rock in the dipper', unit: 't', height: 200, clock, bands: model.phases }));
}

/// Stages are found in the frames: of two that are a frame apart, or none, the order in time is hardly known.
function nearby(slices, times) {
  const frame = (slice) => times.indexOf(slice.stage.t_s);
  return slices.map((slice, k) => {
    const before = slices[k - 1];
    if (!before || before.stage.pass !== slice.stage.pass || frame(slice) < 0 || frame(slice) - frame(before) > 1) return slice;
    const near = frame(slice) === frame(before) ? `in the same frame as stage ${before.stage.stage}`
      : `one frame (${number(slice.stage.t_s - before.stage.t_s, 2)} s) after stage ${before.stage.stage}; no frame lies between`;
    return { ...slice, stage: { ...slice.stage, near } };
  });
}

function zoneOf(zones) {
  return (speed, [x, y, z]) => {
    const box = zones?.region;
    if (!box || x < box.min_m[0] || x > box.max_m[0] || y < box.min_m[1] || y > box.max_m[1] || z < box.min_m[2] || z > box.max_m[2]) return null;
    return speed > zones.threshold_m_s ? 'flow' : 'bulk';
  };
}
