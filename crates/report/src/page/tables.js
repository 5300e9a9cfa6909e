// The tables below the picture.
import { $, fill, renew, table } from './dom.js';
import { colourOf, hex, hitsOf, spanOf } from './items.js';

export const ROLES = { engine: 'engine', planted: 'planted fault', oracle: 'oracle', expected: 'target', specimen: 'published' };

/** What the layers of a case are compared with. */
const target = (item) => (item.layers[item.oracle].role === 'oracle' ? 'the oracle' : 'what is expected of its declaration');

/** Who draws what; `is-a` and `is-b` are marked. */
export const layerTable = ({ item, cursor, a, b }) => {
  const heads = item.isCase
    ? ['who', 'is', 'pixels', 'missing', 'extra', 'twice', 'hits here', 'span of the row here']
    : ['picture', 'size', 'colour here'];
  const cellsOf = ({ role, refused, covered, tally, pixels, ...layer }) => {
    if (refused) return [ROLES[role], refused];
    if (!item.isCase) return [`${pixels.width} x ${pixels.height}`, cursor ? hex(colourOf({ pixels }, ...cursor)) : ''];
    const here = cursor ? [hitsOf(item, layer, ...cursor), spanOf(item, layer, ...cursor)] : ['', ''];
    return [ROLES[role], covered, tally.missing, tally.extra, tally.twice, ...here].map(String);
  };
  const rows = item.layers.map((layer, i) => (
    { cells: [layer.everybody, ...cellsOf(layer)], className: [i === a && 'is-a', i === b && 'is-b'].filter(Boolean).join(' ') }));
  const caption = item.isCase ? `Who draws what, judged by ${target(item)}` : 'Pictures';
  renew($('layers'), table(heads, rows, { caption }));
};

const runsOfRow = (item, layer, y) => {
  const runs = [];
  for (let x = item.box[0]; x < item.box[2]; x += 1) {
    const hits = hitsOf(item, layer, x, y);
    const last = runs.at(-1);
    if (last && last.hits === hits && last.to === x) last.to += 1;
    else if (hits > 0) runs.push({ from: x, to: x + 1, hits });
  }
  const text = ({ from, to, hits }) => `${from}${to - from > 1 ? ` to ${to - 1}` : ''}${hits > 1 ? ` (${hits} hits)` : ''}`;
  return runs.map(text).join(', ');
};

/** The columns that are hit in each row, when somebody wants to read them. */
export const rowTable = ({ item, a, b }) => {
  $('rows').hidden = !item.isCase;
  if (!$('rows').open || !item.isCase) return;
  const columns = [['A', a], ['B', b], ['oracle', item.oracle]];
  const [, top, , bottom] = item.box;
  const rows = Array.from({ length: bottom - top }, (_, at) => {
    const texts = columns.map(([, i]) => runsOfRow(item, item.layers[i], top + at));
    const differs = texts[0] === texts[1] ? '' : 'A and B differ';
    return { cells: [String(top + at), ...texts, differs], className: differs ? 'wrong' : '' };
  });
  const heads = ['row', ...columns.map(([name, i]) => (name === 'oracle' ? name : `${name}: ${item.layers[i].label}`)), 'difference'];
  fill(document.querySelector('#rows div'), table(heads, rows, { caption: 'Columns that are hit in each row' }));
};
