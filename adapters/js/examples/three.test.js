// three.js without a GPU, a ray through each pixel's centre and triangles of shapes: `npm install three`.
import { test } from 'vitest';
import { Ray, ShapeUtils, Vector2, Vector3 } from 'three';
import { assertPartition, assertRasterizer } from 'rasterproof';

function pick(corners, [width, height]) {
  const [a, b, c] = corners.map(([x, y]) => new Vector3(x, y, 0));
  const ray = new Ray(new Vector3(), new Vector3(0, 0, 1)), hit = new Vector3();
  return Uint8Array.from({ length: width * height }, (_, i) => {
    ray.origin.set((i % width) + 0.5, Math.floor(i / width) + 0.5, -1);
    return ray.intersectTriangle(a, b, c, false, hit) !== null;
  });
}

function shape(contours) {
  const [outer, ...holes] = contours.map((contour) => contour.map(([x, y]) => new Vector2(x, y)));
  const all = [outer, ...holes].flat(); // before repeated ends are taken away
  return ShapeUtils.triangulateShape(outer, holes).map((face) => face.map((i) => all[i].toArray()));
}

test('Ray.intersectTriangle', () => assertRasterizer(pick, { declare: 'range=4096' }));
test('ShapeUtils.triangulateShape', () => assertPartition(shape, { declare: 't-junctions triangles=any' }));
