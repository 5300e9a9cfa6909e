// What the types of the package take, and what they refuse. `adapters/check` compiles it; nothing runs it.
import { assertLines, assertPartition, assertRasterizer, assertValues, AssertionError } from 'rasterproof';

assertRasterizer((corners, [width, height]) => {
  const mask = new Uint8Array(width * height);
  for (const [x, y] of corners) mask[Math.floor(y) * width + Math.floor(x)] = 1;
  return mask;
}, { cases: 10, seed: 3, family: ['uniform', 'fan'], declare: 'rule=strict', seconds: 5, hits: true });
assertRasterizer((_, window) => Array.from({ length: window[0] * window[1] }, () => 0), { case: 3, family: 'fan' });
assertRasterizer(() => new Array<boolean>(64).fill(false));
assertRasterizer(() => {
  const spans: [y: number, x0: number, x1: number][] = [];
  spans.push([0, 1, 2]);
  return spans;
});
// Lists whose length is not known to the compiler.
assertRasterizer((corners) => corners.map(([x, y]) => [Math.round(y), Math.round(x), Math.round(x) + 1]));
assertLines((ends) => ends.map(([x, y]) => [x, y]));
assertPartition((contours) => (contours.length > 1 ? null : [[[0, 0], [1, 0], [0, 1]]]));
assertPartition((contours) => contours.map((contour) => contour.slice(0, 3)));
assertValues((corners, [width, height]) => {
  const [[, , z]] = corners;
  return { mask: new Uint8ClampedArray(width * height), values: new Float32Array(3 * width * height).fill(z) };
});
assertValues((_, [width, height]) => ({ mask: [0], values: new Float64Array(3 * width * height) }));
try {
  assertRasterizer(() => new Uint8Array(1));
} catch (error) {
  if (error instanceof AssertionError) console.log(error.message, error.cause);
}

// @ts-expect-error: a generator is no answer.
assertRasterizer(function* () { yield [0, 1, 2]; });
// @ts-expect-error: an option that there is not.
assertRasterizer(() => new Uint8Array(1), { case_: 1 });
// @ts-expect-error: cases is a number.
assertRasterizer(() => new Uint8Array(1), { cases: '5' });
assertRasterizer((_, window) => {
  // @ts-expect-error: the window is not changed.
  window[0] = 3;
  return new Uint8Array(9);
});
