// Colours that are the same in light and dark, and which of style.css's a phase has. Curves and
// classes: Okabe and Ito 2008, distinguishable with any colour vision. Scales get darker all the way, so
// that they also read in grey; both as in scripts/plot_run.

export const CLASSES = ['#56b4e9', '#e69f00', '#009e73', '#cc79a7', '#0072b2', '#d55e00', '#f0e442', '#555555'];
export const classColour = (type) => CLASSES[(type - 1) % CLASSES.length];

/// The colour of a pass, by style.css's name.
const PASSES = ['orange', 'blue', 'green', 'purple', 'ochre', 'sky'];
export const passColour = (pass) => PASSES[(pass - 1) % PASSES.length];

export const SPEED = ['#dcd8d0', '#e0b25c', '#cf6a2e', '#7b2d5b', '#1b1440'];
export const SIZE = ['#e6e3dc', '#a9c3cf', '#5f97b3', '#2b6490', '#12305c'];

/// The scale for fields on walls: none of its tones is the bare wall's grey.
export const PRESSED = ['#fbe3a6', '#f0a93b', '#d0542c', '#86204f', '#2a0a45'];

const PHASES = {
  penetrate: 'phase-in', fill: 'phase-fill', breakout: 'phase-lift', swing: 'phase-swing', dump: 'phase-dump',
};
/// The name of the tone of a phase.
export const phaseTone = (name) => PHASES[name] ?? 'phase-idle';

/// [r, g, b], 0 to 255, of a scale at x in 0 to 1.
export function ramp(stops, x) {
  const at = Math.min(Math.max(x, 0), 1) * (stops.length - 1);
  const k = Math.min(Math.floor(at), stops.length - 2);
  const [a, b] = [rgb(stops[k]), rgb(stops[k + 1])];
  return a.map((v, i) => Math.round(v + (b[i] - v) * (at - k)));
}

export function rgb(hex) {
  const n = parseInt(hex.slice(1), 16);
  return [n >> 16, (n >> 8) & 255, n & 255];
}

export const css = ([r, g, b]) => `rgb(${r} ${g} ${b})`;
export const gradient = (stops) => `linear-gradient(90deg, ${stops.join(', ')})`;
