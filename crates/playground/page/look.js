// What is said about a pixel: its edges as the engines have them, and how the scanline came to its row.

function aboutPixel() {
  const head = make('h2', {}, `${word('pixel')} ${state.px?.join(', ') ?? ''}`);
  if (!last.look) return [head];
  const all = handles();
  const nameOf = (place) => corner(all.findIndex((handle) => handle.members.includes(place)));
  const { nodes, listed } = aboutTriangles(withEdges(last.look.triangles, picture(), nameOf), state.by, state.snap ? 8 : 0);
  const walked = listed.find((triangle) => triangle.rows?.length || triangle.crossings);
  return [head, ...nodes, ...(walked ? [walked.rows ? walkOf(walked) : crossingsOf(walked)] : [])];
}

/** Off the lattice rows are crossed one by one, so there is nothing to step through. */
function crossingsOf(triangle) {
  const rows = triangle.crossings.map((crossing, i) => [
    word(i ? 'shortEdge' : 'longEdge'), round(crossing.x, 6), crossing.error.toExponential(0), crossing.column, word(crossing.by_filter ? 'byFloats' : 'byIntegers'),
  ]);
  return make('div', {}, make('p', {}, make('strong', {}, word('crossings'))), table([word('edge'), 'x', '±', word('column'), word('decided')], rows),
    make('p', { className: 'quiet' }, word('crossNote')));
}

/** The rows of the scanline up to the pixel's, with a button that plays them. */
function walkOf(triangle) {
  const { rows } = triangle;
  const row = rows.findIndex((r) => r.y_px === state.px[1]);
  const first = Math.max(0, Math.min(row < 0 ? 0 : row - 3, rows.length - 5));
  const cell = (step) => [String(step.column), String(step.remainder), step.carries ? '+1' : ''];
  const parts = [word('column'), word('remainder'), word('carry')];
  const body = rows.slice(first, first + 6).map((r) => [`${r.y_px === state.px[1] ? '▸ ' : ''}${r.y_px}`, ...cell(r.long), ...cell(r.short)]);
  const walks = table([word('row'), ...parts, ...parts], body);
  walks.classList.add('tight');
  walks.querySelector('thead').prepend(make('tr', {}, make('td'),
    ...['longEdge', 'shortEdge'].map((name) => make('th', { colSpan: 3, scope: 'colgroup' }, word(name)))));
  const here = rows[Math.max(row, 0)];
  const step = (name, walk) => `${word(name)}: + ${walk.step_whole}, − ${walk.step_part} / ${walk.dy}`;
  const steps = `${word('eachRow')} ${step('longEdge', here.long)}; ${step('shortEdge', here.short)}`;
  return make('details', { open: state.walk !== false, ontoggle: (event) => { state.walk = event.target.open; } },
    make('summary', {}, word('walk')),
    button(word(state.playing ? 'pause' : 'play'), playRows, { id: 'play' }), walks, make('p', {}, steps), make('p', { className: 'quiet' }, word('walkNote')));
}

function playRows() {
  state.hover = false;
  play(700, () => {
    const { rows } = last.look?.triangles.find((t) => t.rows.length) ?? { rows: [] };
    const next = state.px[1] + 1;
    if (rows.length) lookAt(state.px[0], next);
    return rows.length > 0 && next < rows.at(-1).y_px && next + 1 < state.window[3];
  });
}
