// Common to all pages: reads the data, appends the sections, and shows errors.
import { h } from './dom.js';
import { readHead } from './unpack.js';

/// `build(data)` gives the sections; null ones are left out.
export async function showPage(build) {
  const page = document.getElementById('page');
  try {
    // Charts are painted with their text: the font has to be loaded first.
    const fonts = ['400', '500', '600'].map((weight) => document.fonts.load(`${weight} 12px "IBM Plex Sans"`));
    const data = await readHead();
    await Promise.all(fonts);
    page.append(...build(data).filter(Boolean));
  } catch (error) {
    page.append(h('p.warning', { role: 'alert' }, `This page cannot be drawn: ${error.message}`));
    throw error;
  }
}

export function masthead(kind, title, lead, ...warnings) {
  return h('header.masthead', h('p.eyebrow', kind), h('h1', title), lead && h('p.lead', lead),
    warnings.filter(Boolean).map((text) => h('p.warning', { role: 'alert' }, text)));
}

export function foot(version) {
  return h('footer', `Written by ${['dipper', version].filter(Boolean).join(' ')}. This file is complete: it loads nothing over the network.`);
}
