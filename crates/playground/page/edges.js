// Triangles at the sample of a pixel, as the engines see them, for the one explanation of a pixel (`aboutTriangles`).

/** A float with as many digits as a table holds. */
const short = (value) => (value === 0 || (Math.abs(value) >= 1e-3 && Math.abs(value) < 1e6) ? String(Number(value.toFixed(3))) : value.toExponential(2));

/** An edge for the table of edges; `nameOf` says what a corner is called. */
function edgeOf({ ends, value, bound, sign, topLeft: isTopLeft, byFilter }, corners, nameOf) {
  const [from, to] = ends.map((end) => corners[end]);
  return {
    name: `${nameOf(from)} → ${nameOf(to)}`, sign, isTopLeft, kind: kindOfEdge(to.x - from.x, to.y - from.y), isByExact: byFilter === false,
    ...(bound === undefined ? { value } : { value: short(Number(value)), bound: bound.toExponential(0) }),
  };
}

/** What the engines said of the triangles of a picture, with their edges as the explanation wants them. */
const withEdges = (triangles, picture, nameOf) => triangles.map((triangle, i) => (
  { ...triangle, i, edges: triangle.edges?.map((edge) => edgeOf(edge, picture.triangles[i], nameOf)) }));
