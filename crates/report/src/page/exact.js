// Edge functions and lines in exact arithmetic, computed from the corners in BigInt; positions that are doubles are
// taken apart into mantissa and exponent first. A fourth implementation: the tests compare it with the oracle.
import { kindOfEdge } from './pixel.js';

/** A double as [m, e] with value m * 2^e, m odd or zero. */
const takeApart = (value) => {
  const bytes = new DataView(new ArrayBuffer(8));
  bytes.setFloat64(0, value);
  const bits = bytes.getBigUint64(0);
  const field = Number((bits >> 52n) & 0x7ffn);
  let m = bits & 0xfffffffffffffn;
  if (field > 0) m |= 1n << 52n;
  let e = field > 0 ? field - 1075 : -1074;
  if (m === 0n) return [0n, 0];
  while ((m & 1n) === 0n) { m >>= 1n; e += 1; }
  return [bits >> 63n ? -m : m, e];
};

/** Corners as whole numbers of 2^-bits px. */
export const fixedPoint = (shape) => {
  if (shape.kind === 'triangles') {
    return { bits: 8, triangles: shape.points.map((t) => t.map((p) => p.map(BigInt))) };
  }
  const parts = shape.points.map((t) => t.map((p) => p.map(takeApart)));
  const bits = Math.max(1, ...parts.flat(2).map(([, e]) => -e));
  const fixed = ([m, e]) => m << BigInt(e + bits);
  return { bits, triangles: parts.map((t) => t.map((p) => p.map(fixed))) };
};

/** The edge functions of a triangle at the centre of a pixel, positive inside. */
export const judgeSample = (triangle, bits, x, y) => {
  const centre = (px) => ((2n * BigInt(px) + 1n) << BigInt(bits)) >> 1n;
  const [px, py] = [centre(x), centre(y)];
  const cross = (a, b, qx, qy) => (b[0] - a[0]) * (qy - a[1]) - (b[1] - a[1]) * (qx - a[0]);
  const area = cross(triangle[0], triangle[1], triangle[2][0], triangle[2][1]);
  const sign = area < 0n ? -1n : 1n;
  const edges = [0, 1, 2].map((i) => {
    const j = (i + 1) % 3;
    const [a, b] = [triangle[i], triangle[j]];
    const kind = kindOfEdge(sign * (b[0] - a[0]), sign * (b[1] - a[1]));
    return {
      name: sign > 0n ? `v${i} \u2192 v${j}` : `v${j} \u2192 v${i}`,
      value: sign * cross(a, b, px, py),
      kind,
      isTopLeft: kind === 'left' || kind === 'top',
    };
  });
  const flat = area === 0n;
  const isTie = !flat && edges.some((e) => e.value === 0n) && edges.every((e) => e.value >= 0n);
  const isIn = !flat && edges.every((e) => e.value > 0n || (e.value === 0n && e.isTopLeft));
  return { edges, isTie, isIn, flat };
};

/** Where a line's ideal height lies beside a pixel of it, in exact fractions. */
export const judgeLinePixel = ([from, to], x, y) => {
  const [a, b] = [from, to].map((p) => p.map(BigInt));
  const size = (v) => (v < 0n ? -v : v);
  const major = size(b[0] - a[0]) >= size(b[1] - a[1]) ? 0 : 1;
  const [first, last] = a[major] <= b[major] ? [a, b] : [b, a];
  const pixel = [BigInt(x), BigInt(y)];
  const length = last[major] - first[major];
  const rise = last[1 - major] - first[1 - major];
  const step = pixel[major] - first[major];
  const axes = { major: 'xy'[major], minor: 'xy'[1 - major] };
  if (step < 0n || step > length) return { ...axes, isOn: false, beyond: true };
  if (length === 0n) return { ...axes, isOn: pixel[1 - major] === first[1 - major], length };
  // Twice the distance from the ideal height, in 1/length.
  const twice = 2n * ((pixel[1 - major] - first[1 - major]) * length - step * rise);
  const forward = rise < 0n ? -twice : twice;
  const isTie = size(twice) === length;
  const isOn = size(twice) < length || (isTie && forward > 0n);
  return { ...axes, isOn, isTie, twice, length, step, rise, first };
};

/** A BigInt times 2^-bits in decimal, rounded to four digits where it is long. */
export const decimal = (value, bits) => {
  if (value === 0n) return '0';
  // 2^-bits is 5^bits * 10^-bits.
  const digits = String((value < 0n ? -value : value) * 5n ** BigInt(bits));
  const [lead, more] = Number(`${digits[0]}.${digits.slice(1, 20)}`).toExponential(3).split('e');
  const exponent = digits.length - 1 - bits + Number(more);
  const text = exponent >= -3 && exponent < 7 ? String(Number(`${lead}e${exponent}`)) : `${lead}e${exponent}`;
  return value < 0n ? `\u2212${text}` : text;
};
