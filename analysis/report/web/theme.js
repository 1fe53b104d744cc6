// Light or dark as the system asks, and always light on paper. Colours are those of style.css, by name:
// elements take them as var(--name) and change by themselves; canvases ask here, and paint again.

const dark = matchMedia('(prefers-color-scheme: dark)');
const changes = new EventTarget();
const root = document.documentElement;

function onPaper(on) {
  root.classList.toggle('paper', on);
  changes.dispatchEvent(new Event('change'));
}

dark.addEventListener('change', () => changes.dispatchEvent(new Event('change')));
addEventListener('beforeprint', () => onPaper(true));
addEventListener('afterprint', () => onPaper(false));

export const printing = () => root.classList.contains('paper');
export const isDark = () => dark.matches && !printing();

/// The colour's value now: what a canvas needs.
export const colour = (name) => getComputedStyle(root).getPropertyValue(`--${name}`).trim();

/// Calls paint() when colours change; gives what ends that.
export function onTheme(paint) {
  changes.addEventListener('change', paint);
  return () => changes.removeEventListener('change', paint);
}
