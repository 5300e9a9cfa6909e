// Earcut, a polygon with holes: `npm install earcut`.
import { test } from 'vitest';
import earcut, { flatten } from 'earcut';
import { assertPartition } from 'rasterproof';

function triangles(contours) {
  const { vertices, holes } = flatten(contours);
  const corners = earcut(vertices, holes).map((i) => [vertices[2 * i], vertices[2 * i + 1]]);
  return Array.from({ length: corners.length / 3 }, (_, i) => corners.slice(3 * i, 3 * i + 3));
}

test('earcut', () => assertPartition(triangles, { declare: 't-junctions triangles=any' }));
