// What is said of a pixel: why it belongs to each triangle or does not. A page gives triangles as {edges, i}, `edges` nothing where there is no
// area, each {name, value, bound, sign, kind, isTopLeft, isByExact}: sign and value of its edge function at the sample, and which edge it is.
import { inGroups, make, pageLanguage, table } from './dom.js';

const PIXEL_WORDS = {
  en: {
    edge: 'Edge', value: 'E', sample: 'The sample is', ifOn: 'A sample on it', ofTriangle: 'Triangle', belongs: 'Belongs', yes: 'yes', no: 'no', degenerate: 'without area: covers nothing',
    strict: 'strict (E > 0)', inclusive: 'inclusive (E \u2265 0)', tl: 'top-left', onEdge: 'exactly on this edge', inside: 'inside', outside: 'outside', byExact: ', decided exactly: floats cannot tell',
    keeps: 'keeps it', leaves: 'leaves it', left: 'left', right: 'right', top: 'top', bottom: 'bottom',
    isOf: (kind, what) => `${kind} edge: ${what}`, more: (n) => `And ${n} more at this sample.`, unit: (bits) => `E is twice an area in ${bits ? `1/${4 ** bits}` : ''} px\u00b2`.replace('  ', ' '),
    hole: 'The sample lies exactly on the edge that two triangles share: E = 0 for both. Strict asks for E\u00a0>\u00a00, so neither gets it, and that is a hole.',
    missed: 'The sample lies exactly on an edge, E = 0. Strict asks for E\u00a0>\u00a00, so this triangle does not get it.',
    double: 'The sample lies exactly on the edge that two triangles share: E = 0 for both. Inclusive asks for E\u00a0\u2265\u00a00, so both get it, and it is hit twice.',
    added: 'The sample lies exactly on an edge, E = 0. Inclusive asks for E\u00a0\u2265\u00a00, so this triangle gets it, whatever edge it is.',
    once: 'The top-left rule: a sample on an edge belongs where that edge is a top or left one. A shared edge is that for one of its triangles only, so the sample is hit once.',
    kept: 'The top-left rule: the edge is a top or left one, so the sample belongs.',
    lost: 'The top-left rule: the edge is no top or left one, so the sample is left to the neighbour on the other side.',
  },
  zh: {
    edge: '边', value: 'E', sample: '采样点', ifOn: '若采样点在边上', ofTriangle: '三角形', belongs: '属于', yes: '是', no: '否', degenerate: '没有面积：什么也不覆盖',
    strict: '严格（E > 0）', inclusive: '包含（E ≥ 0）', tl: '左上规则', onEdge: '恰好在这条边上', inside: '在内侧', outside: '在外侧', byExact: '，由精确计算决定：浮点数分不清',
    keeps: '归它', leaves: '归邻居', left: '左边', right: '右边', top: '上边', bottom: '下边',
    isOf: (kind, what) => `${kind}：${what}`, more: (n) => `在这个采样点还有 ${n} 个。`, unit: (bits) => `E 是面积的两倍，单位是 ${bits ? `1/${4 ** bits} ` : ''}平方像素`,
    hole: '采样点恰好在两个三角形的公共边上：对两者都是 E = 0。严格规则要求 E\u00a0>\u00a00，所以谁也得不到它，这就是空洞。',
    missed: '采样点恰好在一条边上，E = 0。严格规则要求 E\u00a0>\u00a00，所以这个三角形得不到它。',
    double: '采样点恰好在两个三角形的公共边上：对两者都是 E = 0。包含规则要求 E\u00a0≥\u00a00，所以两个都得到它，于是重复命中。',
    added: '采样点恰好在一条边上，E = 0。包含规则要求 E\u00a0≥\u00a00，所以不管是哪条边，这个三角形都得到它。',
    once: '左上规则：边上的采样点归以它为上边或左边的三角形。公共边只是其中一个三角形的上边或左边，所以恰好命中一次。',
    kept: '左上规则：这是上边或左边，所以采样点归它。',
    lost: '左上规则：这不是上边或左边，所以采样点留给另一侧的邻居。',
  },
};
export const pixelWords = () => PIXEL_WORDS[pageLanguage()];

/** Which edge one is that runs by (dx, dy) with the inside at its right. */
export const kindOfEdge = (dx, dy) => (dy < 0 ? 'left' : dy > 0 ? 'right' : dx > 0 ? 'top' : 'bottom');

const isStrict = ({ edges }) => edges?.every(({ sign }) => sign > 0);
const isInclusive = ({ edges }) => edges?.every(({ sign }) => sign >= 0);
const isTopLeft = ({ edges }) => edges?.every(({ sign, isTopLeft: keeps }) => sign > 0 || (sign === 0 && keeps));
const outsideOf = ({ edges }) => edges?.filter(({ sign }) => sign < 0).length ?? 3;

/** Why the rules differ at a sample on an edge: those of who draws (`by`), and the right one. */
function reasons(triangles, by) {
  const touching = triangles.filter((triangle) => isInclusive(triangle) && !isStrict(triangle));
  if (touching.length === 0) return [];
  const draws = (...names) => names.some((name) => by.includes(name));
  const isShared = touching.length > 1;
  const isOwned = triangles.some(isTopLeft);
  const says = [isShared && isOwned ? 'once' : isOwned ? 'kept' : 'lost'];
  if (draws('inclusive-edges', 'sysu-inclusive')) says.unshift(isShared ? 'double' : 'added');
  if (draws('exclusive-edges', 'games101-strict') && !triangles.some(isStrict)) says.unshift(isShared ? 'hole' : 'missed');
  return says.map((key) => pixelWords()[key]);
}

function tableOfEdges({ edges }, bits) {
  const words = pixelWords();
  const hasBounds = edges.some(({ bound }) => bound);
  const rows = edges.map(({ name, value, bound, sign, kind, isTopLeft: keeps, isByExact }) => [
    name, inGroups(String(value)), ...(hasBounds ? [bound] : []),
    words[sign === 0 ? 'onEdge' : sign > 0 ? 'inside' : 'outside'] + (isByExact ? words.byExact : ''), words.isOf(words[kind], words[keeps ? 'keeps' : 'leaves']),
  ]);
  return table([words.edge, words.value, ...(hasBounds ? ['\u00b1'] : []), words.sample, words.ifOn], rows, { caption: words.unit(bits), className: 'edges' });
}

/** Most triangles of which the edges are shown. */
const MOST_LISTED = 4;

/** The triangles that matter at a pixel, those that have or touch its sample, else the nearest; what is said of them as elements, and why in words. */
export function aboutTriangles(triangles, by, bits) {
  const words = pixelWords();
  const here = triangles.filter(isInclusive);
  const nearest = triangles.toSorted((p, q) => outsideOf(p) - outsideOf(q)).slice(0, 1);
  const listed = (here.length ? here : nearest).slice(0, MOST_LISTED);
  const why = reasons(triangles, by);
  const yes = (held) => words[held ? 'yes' : 'no'];
  const nodes = listed.flatMap((triangle) => {
    const title = `${words.ofTriangle} ${triangle.i + 1}`;
    if (!triangle.edges) return [make('p', {}, `${title}: ${words.degenerate}`)];
    const rules = `${words.belongs}: ${words.strict}: ${yes(isStrict(triangle))}; ${words.inclusive}: ${yes(isInclusive(triangle))}; ${words.tl}: ${yes(isTopLeft(triangle))}`;
    return [make('p', {}, make('strong', {}, title)), tableOfEdges(triangle, bits), make('p', { className: 'quiet' }, rules)];
  });
  const more = here.length > MOST_LISTED ? [make('p', {}, words.more(here.length - MOST_LISTED))] : [];
  return { nodes: [...why.map((text) => make('p', { className: 'say' }, text)), ...nodes, ...more], why, listed };
}
