// libtess.js, a port of SGI's tessellator of GLU: `npm install libtess`.
import { test } from 'vitest';
import libtess from 'libtess';
import { assertPartition } from 'rasterproof';

const { gluEnum, windingRule, GluTesselator } = libtess;

function triangles(contours) {
  const tess = new GluTesselator(), corners = [];
  tess.gluTessCallback(gluEnum.GLU_TESS_VERTEX_DATA, ([x, y]) => corners.push([x, y]));
  tess.gluTessCallback(gluEnum.GLU_TESS_COMBINE, ([x, y]) => [x, y, 0]);
  tess.gluTessCallback(gluEnum.GLU_TESS_EDGE_FLAG, () => {}); // separate triangles, no fans
  tess.gluTessProperty(gluEnum.GLU_TESS_WINDING_RULE, windingRule.GLU_TESS_WINDING_ODD);
  tess.gluTessBeginPolygon();
  for (const contour of contours) {
    tess.gluTessBeginContour();
    for (const [x, y] of contour) tess.gluTessVertex([x, y, 0], [x, y]);
    tess.gluTessEndContour();
  }
  tess.gluTessEndPolygon();
  return Array.from({ length: corners.length / 3 }, (_, i) => corners.slice(3 * i, 3 * i + 3));
}

test('libtess', () => assertPartition(triangles, { declare: 't-junctions degenerate triangles=any' }));
