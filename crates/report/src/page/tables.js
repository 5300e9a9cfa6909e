// The tables below the picture.
import { $, make } from './dom.js';
import { colourOf, hex, hitsOf } from './items.js';
import { spanOf } from './explain.js';

export const ROLES = { engine: 'engine', planted: 'planted fault', oracle: 'oracle', expected: 'target', specimen: 'published' };

/** What the layers of a case are compared with. */
const target = (item) => (item.layers[item.oracle].role === 'oracle' ? 'the oracle' : 'what is expected of its declaration');

/** Who draws what; `is-a` and `is-b` are marked. */
export const layerTable = ({ item, cursor, a, b }) => {
  const headings = item.isCase
    ? ['who', 'is', 'pixels', 'missing', 'extra', 'twice', 'hits here', 'span of the row here']
    : ['picture', 'size', 'colour here'];
  const numbers = item.isCase ? [2, 3, 4, 5, 6] : [];
  const rows = item.layers.map((layer, i) => {
    const here = cursor ? [String(hitsOf(item, layer, ...cursor)), spanOf(item, layer, ...cursor)] : ['', ''];
    const cells = item.isCase ? [ROLES[layer.role], ...[layer.covered, layer.tally.missing, layer.tally.extra, layer.tally.twice].map(String), ...here] : [
      `${layer.pixels.width} x ${layer.pixels.height}`,
      cursor ? hex(colourOf(layer, ...cursor)) : ''];
    const chosen = [i === a && 'is-a', i === b && 'is-b'].filter(Boolean).join(' ');
    const name = make('th', { scope: 'row' }, layer.everybody);
    if (layer.refused) return make('tr', { className: chosen }, name, make('td', {}, ROLES[layer.role]), make('td', { colSpan: 6 }, layer.refused));
    return make('tr', { className: chosen }, name,
      ...cells.map((cell, at) => make('td', { className: numbers.includes(at + 1) ? 'number' : '' }, cell)));
  });
  const head = headings.map((text, at) =>
    make('th', { scope: 'col', className: numbers.includes(at) ? 'number' : '' }, text));
  $('layers').replaceChildren(make('caption', {}, item.isCase ? `Who draws what, judged by ${target(item)}` : 'Pictures'),
    make('thead', {}, make('tr', {}, ...head)), make('tbody', {}, ...rows));
};

const runsOfRow = (item, layer, y) => {
  const runs = [];
  for (let x = item.box[0]; x < item.box[2]; x += 1) {
    const hits = hitsOf(item, layer, x, y);
    const last = runs.at(-1);
    if (last && last.hits === hits && last.to === x) last.to += 1;
    else if (hits > 0) runs.push({ from: x, to: x + 1, hits });
  }
  const text = ({ from, to, hits }) =>
    `${from}${to - from > 1 ? ` to ${to - 1}` : ''}${hits > 1 ? ` (${hits} hits)` : ''}`;
  return runs.map(text).join(', ');
};

/** The columns that are hit in each row, when somebody wants to read them. */
export const rowTable = ({ item, a, b }) => {
  $('rows').hidden = !item.isCase;
  if (!$('rows').open || !item.isCase) return;
  const columns = [['A', a], ['B', b], ['oracle', item.oracle]];
  const [, top, , bottom] = item.box;
  const rows = Array.from({ length: bottom - top }, (_, at) => {
    const y = top + at;
    const texts = columns.map(([, i]) => runsOfRow(item, item.layers[i], y));
    const differs = texts[0] === texts[1] ? '' : 'A and B differ';
    return make('tr', { className: differs ? 'wrong' : '' }, make('th', { scope: 'row' }, String(y)),
      ...[...texts, differs].map((text) => make('td', {}, text)));
  });
  const head = ['row', ...columns.map(([name, i]) => (name === 'oracle' ? name : `${name}: ${item.layers[i].label}`)), 'difference'];
  document.querySelector('#rows .scroll').replaceChildren(make('table', {}, make('caption', {}, 'Columns that are hit in each row'),
    make('thead', {}, make('tr', {}, ...head.map((text) => make('th', { scope: 'col' }, text)))),
    make('tbody', {}, ...rows)));
};
