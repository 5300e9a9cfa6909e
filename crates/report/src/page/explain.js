// What is said of a pixel: who hits it, the edge functions at its sample, and why it belongs or does not.
import { make } from './dom.js';
import { decimal, judgeLinePixel, judgeSample } from './exact.js';
import { colourOf, hex, hitsOf } from './items.js';

export const plural = (n, one, many = `${one}s`) => `${n} ${n === 1 ? one : many}`;

/** The run of hit pixels around a column of a row. */
export const spanOf = (item, layer, x, y) => {
  if (hitsOf(item, layer, x, y) === 0) return '';
  let [from, to] = [x, x + 1];
  while (hitsOf(item, layer, from - 1, y) > 0) from -= 1;
  while (hitsOf(item, layer, to, y) > 0) to += 1;
  return `${from} to ${to - 1} (${to - from} px)`;
};

const edgeTable = (judged, bits) => {
  const unit = bits === 8 ? 'E is twice an area in 1/65536 px\u00b2' : 'E is twice an area in px\u00b2';
  const head = ['edge', 'E', 'sample', 'this edge', 'top-left'].map((text, at) =>
    make('th', { scope: 'col', className: at === 1 ? 'number' : '' }, text));
  const rows = judged.edges.map((edge) => {
    const side = edge.value === 0n ? 'on it' : edge.value > 0n ? 'inside' : 'outside';
    const value = bits === 8 ? String(edge.value) : decimal(edge.value, 2 * bits);
    return make('tr', {}, make('th', { scope: 'row' }, edge.name), make('td', { className: 'number' }, value),
      ...[side, edge.kind, edge.isTopLeft ? 'yes' : 'no'].map((text) => make('td', {}, text)));
  });
  return make('div', { className: 'scroll', tabIndex: 0, role: 'group', 'aria-label': `edges, ${unit}` }, make('table', { className: 'edges' },
    make('caption', {}, unit), make('thead', {}, make('tr', {}, ...head)), make('tbody', {}, ...rows)));
};

/** The triangles that matter at a pixel: those that hit or touch its sample, else the nearest. */
const aboutTriangles = (item, x, y) => {
  const { bits, triangles } = item.exact;
  const judged = triangles.map((t, i) => ({ ...judgeSample(t, bits, x, y), i }));
  let chosen = judged.filter((j) => j.isIn || j.isTie);
  if (chosen.length === 0) {
    const outside = (j) => j.edges.filter((edge) => edge.value < 0n).length + (j.flat ? 3 : 0);
    chosen = [...judged].sort((p, q) => outside(p) - outside(q)).slice(0, 1);
  }
  const nodes = chosen.slice(0, 3).flatMap((j) => {
    const which = triangles.length > 1 ? `triangle ${j.i + 1} of ${triangles.length}: ` : '';
    let what = j.isIn ? 'the sample is inside' : 'the sample is outside';
    if (j.flat) what = 'flat, so it covers nothing';
    else if (j.isTie) what = `a tie: the sample lies exactly on an edge, and counts as ${j.isIn ? 'inside' : 'outside'}`;
    return [make('p', {}, which + what), edgeTable(j, bits)];
  });
  if (chosen.length > 3) nodes.push(make('p', {}, `and ${plural(chosen.length - 3, 'more triangle')} at this sample`));
  const isTie = judged.some((j) => j.isTie);
  return { nodes, words: isTie ? 'a tie, the sample lies exactly on an edge' : 'no tie', isTie };
};

/** A fraction of a pixel in lowest terms, and in decimal. */
const distance = (over, under) => {
  const size = over < 0n ? -over : over;
  let [p, q] = [size, under];
  while (q > 0n) [p, q] = [q, p % q];
  const exact = under / p === 1n ? `${size / p}` : `${size / p}/${under / p}`;
  const rounded = Number(size) / Number(under);
  return exact.length > 4 ? `${exact} px (${Number(rounded.toPrecision(3))})` : `${exact} px`;
};

const aboutLines = (item, x, y) => {
  const words = [];
  const nodes = item.shape.points.map((line, i) => {
    const j = judgeLinePixel(line, x, y);
    const which = item.shape.points.length > 1 ? `line ${i + 1}: ` : '';
    let text = `${which}beyond its ends along ${j.major}`;
    if (j.length === 0n) text = `${which}a single pixel`;
    else if (!j.beyond) {
      const off = distance(j.twice, 2n * j.length);
      const tie = j.isTie ? ', a tie: halfway between two pixels' : '';
      text = `${which}the centre lies ${off} off the line in ${j.minor}${tie}; ${j.isOn ? 'the pixel is lit' : 'another pixel is nearer'}`;
      if (j.isTie && !j.isOn) text = text.replace('another pixel is nearer', 'the tie goes to the other pixel');
    }
    words.push(text);
    return make('p', {}, text);
  });
  return { nodes, words: words[0], isTie: nodes.length > 0 && words.some((w) => w.includes('a tie')) };
};

/** What is said of a pixel of A and B: nodes, and words for the live region. */
export const aboutPixel = (item, a, b, [x, y]) => {
  const title = make('h4', {}, `Pixel ${x}, ${y}`);
  if (!item.isCase) {
    const [ca, cb] = [a, b].map((i) => hex(colourOf(item.layers[i], x, y)));
    const text = `A ${ca}, B ${cb}: ${ca === cb ? 'the same' : 'different'}`;
    return { nodes: [title, make('p', {}, text)], words: `pixel ${x}, ${y}: ${text}` };
  }
  const about = item.exact ? aboutTriangles(item, x, y) : aboutLines(item, x, y);
  const letter = (i) => (i === a ? 'A ' : i === b ? 'B ' : '');
  const hits = [...new Set([a, b, item.oracle])].map((i) => {
    const layer = item.layers[i];
    const says = layer.refused ? 'draws nothing' : plural(hitsOf(item, layer, x, y), 'hit');
    return `${letter(i)}${layer.label} ${says}`;
  });
  const spans = [a, b].map((i, at) => {
    const span = spanOf(item, item.layers[i], x, y);
    return `${'AB'[at]} ${span ? `columns ${span}` : 'none'}`;
  });
  const nodes = [title,
    make('p', { id: 'pixel-hits' }, `${hits.join('; ')}; ${about.isTie ? 'a tie' : 'no tie'}`),
    make('p', { id: 'pixel-span' }, `span in row ${y}: ${spans.join('; ')}`), ...about.nodes];
  return { nodes, words: `pixel ${x}, ${y}: ${hits.join(', ')}; ${about.words}` };
};
