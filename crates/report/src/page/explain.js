// What is said of a pixel: who hits it, and of triangles, lines and pictures why.
import { make, plural } from './dom.js';
import { decimal, judgeLinePixel, judgeSample } from './exact.js';
import { colourOf, hex, hitsOf, spanOf } from './items.js';
import { aboutTriangles } from './pixel.js';

/** The triangles of a case as their edges are at a sample, computed here. */
const trianglesAt = ({ exact: { bits, triangles } }, x, y) => triangles.map((triangle, i) => {
  const { edges, flat } = judgeSample(triangle, bits, x, y);
  const shown = ({ value, ...edge }) => ({ ...edge, sign: value > 0n ? 1 : value < 0n ? -1 : 0, value: bits === 8 ? String(value) : decimal(value, 2 * bits) });
  return { i, edges: flat ? null : edges.map(shown) };
});

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
      const other = j.isTie ? 'the tie goes to the other pixel' : 'another pixel is nearer';
      text = `${which}the centre lies ${off} off the line in ${j.minor}${tie}; ${j.isOn ? 'the pixel is lit' : other}`;
    }
    words.push(text);
    return make('p', {}, text);
  });
  return { nodes, why: words.slice(0, 1), isTie: words.some((w) => w.includes('a tie')) };
};

/** What is said of a pixel of A and B: nodes, and words for the live region. */
export const aboutPixel = (item, a, b, [x, y]) => {
  const title = make('h4', {}, `Pixel ${x}, ${y}`);
  if (!item.isCase) {
    const [ca, cb] = [a, b].map((i) => hex(colourOf(item.layers[i], x, y)));
    const text = `A ${ca}, B ${cb}: ${ca === cb ? 'the same' : 'different'}`;
    return { nodes: [title, make('p', {}, text)], words: `pixel ${x}, ${y}: ${text}` };
  }
  const by = [a, b].flatMap((i) => item.layers[i].names);
  const about = item.exact ? aboutTriangles(trianglesAt(item, x, y), by, item.exact.bits === 8 ? 8 : 0) : aboutLines(item, x, y);
  const isTie = about.isTie ?? about.why.length > 0;
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
    make('p', { id: 'pixel-hits' }, `${hits.join('; ')}; ${isTie ? 'a tie' : 'no tie'}`),
    make('p', { id: 'pixel-span' }, `span in row ${y}: ${spans.join('; ')}`), ...about.nodes];
  return { nodes, words: `pixel ${x}, ${y}: ${hits.join(', ')}; ${about.why.join(' ') || 'no tie'}` };
};
