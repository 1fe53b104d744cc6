// A table; each column formats its own cells.
import { h } from '../dom.js';

/// columns: [{name, alone, unit, cell(row), kind}]; the first column names the row. kind 'text' is left-aligned. `alone`: the name
/// when its neighbours are not beside it, as on a phone. cells: on a phone each row is a grid of named values.
export function table(caption, columns, rows, { foot = [], compact = false, cells = false } = {}) {
  const line = (row) => h('tr', columns.map((column, k) => h(k === 0 ? 'th' : 'td',
    { scope: k === 0 ? 'row' : undefined, class: column.kind === 'text' ? 'text' : undefined,
      'data-name': (column.alone ?? column.name) + (column.unit ? ` (${column.unit})` : '') }, column.cell(row))));
  const alone = columns.length % 3 === 2; // of three a row, one is left over: the first value gets a row of its own
  return h(`div.table${cells ? '.cells' : ''}${cells && alone ? '.first-alone' : ''}`, h(`table${compact ? '.compact' : ''}`, caption && h('caption', caption),
    h('thead', h('tr', columns.map((column) => h('th', { scope: 'col', class: column.kind === 'text' ? 'text' : undefined },
      column.name, column.unit && h('span.unit', column.unit))))),
    h('tbody', rows.map(line)), foot.length > 0 && h('tfoot', foot.map(line))));
}

/// Names and values, two columns: [[name, value], …].
export function facts(pairs) {
  return h('dl.facts', pairs.filter(([, value]) => value !== undefined && value !== null).map(([name, value]) =>
    h('div', h('dt', name), h('dd', value))));
}
