import { test } from 'node:test'; // or from 'vitest'
import { assertRasterizer } from 'rasterproof';

export function draw([a, b, c], [width, height]) { // corners [x, y] in pixels, y down
  const edge = (p, q, x, y) => (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]);
  return Uint8Array.from({ length: width * height }, (_, i) => { // how often each pixel is drawn, row by row
    const x = (i % width) + 0.5, y = Math.floor(i / width) + 0.5;
    const e = [edge(a, b, x, y), edge(b, c, x, y), edge(c, a, x, y)];
    return e.every((v) => v > 0) || e.every((v) => v < 0);
  });
}

test('draw', () => assertRasterizer(draw, { declare: 'range=4096' }));
