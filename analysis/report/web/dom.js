// Short forms for elements: h('p.note', {title: '…'}, 'text', child, …).

export function h(tag, ...rest) {
  const [name, ...classes] = tag.split('.');
  const element = document.createElement(name || 'div');
  if (classes.length) element.className = classes.join(' ');
  for (const part of rest.flat(Infinity)) {
    if (part === null || part === undefined || part === false) continue;
    if (part instanceof Node || typeof part !== 'object') element.append(part);
    else attributes(element, part);
  }
  return element;
}

const SVG = 'http://www.w3.org/2000/svg';

export function svg(tag, ...rest) {
  const element = document.createElementNS(SVG, tag);
  for (const part of rest.flat(Infinity)) {
    if (part === null || part === undefined || part === false) continue;
    if (part instanceof Node || typeof part !== 'object') element.append(part);
    else for (const [key, value] of Object.entries(part)) element.setAttribute(key, value);
  }
  return element;
}

function attributes(element, values) {
  for (const [key, value] of Object.entries(values)) {
    if (key.startsWith('on')) element.addEventListener(key.slice(2), value);
    else if (value === true) element.setAttribute(key, '');
    else if (value !== false && value !== undefined) element.setAttribute(key, value);
  }
}

/// A section of the page: heading, a line of explanation, content.
export function section(id, title, lead, ...content) {
  return h('section', { id, 'aria-labelledby': `${id}-title` },
    h('h2', { id: `${id}-title` }, title), lead && h('p.lead', lead), ...content);
}

/// Calls draw(width) now and whenever the element's width changes.
export function onWidth(element, draw) {
  let last = 0;
  new ResizeObserver(() => {
    const width = Math.floor(element.clientWidth);
    if (width > 0 && width !== last) draw((last = width));
  }).observe(element);
}
