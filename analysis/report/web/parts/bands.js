// Phases behind a curve: a tint over the plot's height, their names in a strip of their own above it, where no
// line crosses them.
import { colour } from '../theme.js';
import { phaseTone } from '../palette.js';

export const STRIP = 18; // px

/// bands: [{name, from, to}] in the plot's x.
export function drawBands(plot, bands) {
  const { ctx, bbox } = plot;
  const strip = STRIP * devicePixelRatio;
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top - strip, bbox.width, bbox.height + strip);
  ctx.clip();
  ctx.font = `500 ${11 * devicePixelRatio}px "IBM Plex Sans", system-ui, sans-serif`;
  ctx.textBaseline = 'middle';
  for (const { name, from, to } of bands) {
    const left = Math.max(plot.valToPos(from, 'x', true), bbox.left);
    const width = Math.min(plot.valToPos(to, 'x', true), bbox.left + bbox.width) - left - devicePixelRatio;
    if (!(width > 0)) continue;
    ctx.fillStyle = colour(phaseTone(name));
    ctx.fillRect(left, bbox.top - strip, width, strip);
    ctx.globalAlpha = 0.4;
    ctx.fillRect(left, bbox.top, width, bbox.height);
    ctx.globalAlpha = 1;
    ctx.fillStyle = colour('phase-ink');
    const text = fitting(ctx, name ?? '', width - 6 * devicePixelRatio);
    ctx.fillText(text, left + 4 * devicePixelRatio, bbox.top - strip / 2);
  }
  ctx.restore();
}

/// The name, or the shortest part of it that is unique, or nothing.
function fitting(ctx, name, width) {
  for (let n = name.length; n >= 3; --n) {
    const text = n < name.length ? `${name.slice(0, n)}.` : name;
    if (ctx.measureText(text).width <= width) return text;
  }
  return '';
}
