// What is said about a pixel: edges, rules, and how the scanline came to its row.

const isStrict = (triangle) => triangle.edges?.every((edge) => edge.sign > 0);
const isInclusive = (triangle) => triangle.edges?.every((edge) => edge.sign >= 0);

/** A float with as many digits as a table holds. */
const short = (value) => (value === 0 || (Math.abs(value) >= 1e-3 && Math.abs(value) < 1e6) ? round(value, 3) : value.toExponential(2));

function rulesOf(triangle) {
  const yes = (held) => word(held ? 'yes' : 'no');
  return [[word('strict'), yes(isStrict(triangle))], [word('inclusive'), yes(isInclusive(triangle))], [word('tl'), yes(triangle.covered)]];
}

/** Why the rules differ here, if they do: of the rules that are shown, and the right one. */
function reason(triangles) {
  const touching = triangles.filter((triangle) => isInclusive(triangle) && !isStrict(triangle));
  if (touching.length === 0) return [];
  const shows = (...painters) => painters.some((name) => state.by.includes(name));
  const isShared = touching.length > 1;
  const says = [];
  if (shows('exclusive-edges', 'games101-strict') && !triangles.some(isStrict)) says.push(isShared ? 'hole' : 'missed');
  if (shows('inclusive-edges', 'sysu-inclusive')) says.push(isShared ? 'double' : 'added');
  const owned = triangles.some((triangle) => triangle.covered);
  says.push(isShared && owned ? 'once' : owned ? 'kept' : 'left');
  return says.map((key) => make('p', { className: 'say' }, word(key)));
}

function aboutPixel() {
  const head = make('h2', {}, `${word('pixel')} ${state.px?.join(', ') ?? ''}`);
  if (!last.look) return [head];
  const triangles = last.look.triangles.map((triangle, i) => ({ ...triangle, i }));
  const here = triangles.filter(isInclusive);
  const listed = here.length ? here : triangles.slice(0, 1);
  const parts = [head, ...reason(triangles)];
  for (const triangle of listed.slice(0, 4)) parts.push(...aboutTriangle(triangle));
  const walked = listed.find((triangle) => triangle.rows?.length || triangle.crossings);
  if (walked) parts.push(walked.rows ? walkOf(walked) : crossingsOf(walked));
  return parts;
}

function aboutTriangle(triangle) {
  const title = `${word('ofTriangle')} ${triangle.i + 1}`;
  if (!triangle.edges) return [make('p', {}, `${title}: ${word('degenerate')}`)];
  const all = handles();
  const letter = (end) => corner(all.findIndex((handle) => handle.members.includes(state.triangles[triangle.i][end])));
  const rows = triangle.edges.map((edge) => [
    edge.ends.map(letter).join(' → '),
    ...(state.snap ? [edge.value] : [short(Number(edge.value)), edge.bound.toExponential(0)]),
    word(edge.sign === 0 ? 'onEdge' : edge.sign > 0 ? 'inside' : 'outside') + (edge.byFilter === false ? word('byExact') : ''),
    word(edge.topLeft ? 'topLeft' : 'notTopLeft'),
  ]);
  const heads = [word('edge'), word('value'), ...(state.snap ? [] : ['±']), word('sample'), word('ifOn')];
  return [make('p', {}, make('strong', {}, title)), table(heads, rows),
    make('p', { className: 'quiet' }, `${word('belongs')}: ${rulesOf(triangle).map((rule) => rule.join(': ')).join('; ')}`)];
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
  clearInterval(state.playing);
  if (state.playing) { state.playing = 0; redraw(); return; }
  state.hover = false;
  state.playing = setInterval(() => {
    const { rows } = last.look?.triangles.find((t) => t.rows.length) ?? { rows: [] };
    const next = state.px[1] + 1;
    if (!rows.length || next > rows.at(-1).y_px || next >= state.window[3]) { clearInterval(state.playing); state.playing = 0; redraw(); return; }
    lookAt(state.px[0], next);
  }, 700);
  redraw();
}
