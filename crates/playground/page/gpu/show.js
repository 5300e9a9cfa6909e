// What the page shows: progress, verdicts, and a case drawn large.

function drawProgress() {
  const { progress } = state;
  $('progress').hidden = !state.running;
  if (!progress) return;
  $('progress').querySelector('progress').value = progress.part;
  $('doing').textContent = progress.text;
}

/** The worst word of a result's rows. */
const worst = (result) => Object.values(result.rows).reduce((most, { word: is }) => Math.max(most, WORST.indexOf(is)), 0);
const checksThat = (result, is) => Object.keys(WORDS.en.checks).filter((check) => result.rows[check]?.word === is);

function summary(result) {
  if (Object.keys(result.rows).length === 0) return null;
  const broken = checksThat(result, 'outside');
  const names = broken.map((check) => word('checks')[check]);
  const says = [word('allPromised'), word('someFree')(checksThat(result, 'allowed').length), word('someBroken')(broken.length, names)][worst(result)];
  return make('p', { className: `verdict ${WORST[worst(result)]}` }, says);
}

/** Shows a case, and takes the keyboard and the eye there. */
function showCase(index, check) {
  state.shown = [index, check];
  drawAll();
  finding.scrollIntoView();
  finding.querySelector('h2').focus({ preventScroll: true });
}

function row(result, index, check) {
  const { word: is, tally, facts } = result.rows[check];
  const rule = ruleOf(result.name, check);
  const view = result.views[check];
  const show = view && button(word('show'), () => showCase(index, check));
  return make('tr', { 'data-check': check },
    make('th', { scope: 'row' }, word('checks')[check]),
    make('td', { className: is }, word(is), show ? make('div', {}, show) : null),
    make('td', {}, tally ? inGroups(word('details')[check](tally, facts)) : ''),
    make('td', {}, make('details', {}, make('summary', {}, rule.section), make('p', {}, inWords(rule)), make('p', {}, `${word('open')}: ${rule.open}`))));
}

function resultOf(result, index) {
  const checks = Object.keys(WORDS.en.checks).filter((check) => result.rows[check]);
  const software = result.isSoftware ? make('p', { className: 'note' }, word('software')) : null;
  const samples = result.rows.samples?.tally?.subjects ?? 0;
  const totals = result.seconds ? make('p', {}, word('totals')(result.triangles, samples, result.seconds.toFixed(1))) : null;
  return make('section', { 'data-api': result.name },
    make('h2', {}, result.title ?? result.name),
    result.refused ? make('p', {}, said(result.refused)) : null,
    summary(result),
    result.cause ? make('p', { className: 'cause' }, word('cause')(result.cause)) : null,
    result.renderer ? make('p', {}, `${word('renderer')}: ${result.renderer}`) : null,
    software, totals,
    ...result.notes.map((note) => make('p', { className: 'note' }, said(note))),
    checks.length ? make('table', { className: 'checks' }, make('thead', {}, make('tr', {}, ...['check', 'verdict', 'found', 'rule'].map((head) => make('th', { scope: 'col' }, word(head))))), make('tbody', {}, ...checks.map((check) => row(result, index, check)))) : null);
}

/** The pixels around what matters: corners and marks, with one to spare. */
function crop({ cell, outlines, marks }) {
  const places = [...outlines.flat(), ...marks.flatMap(({ x, y }) => [[x, y], [x + 1, y + 1]])];
  return places.length ? boxAround(places, 1, [0, 0, cell, cell]) : [0, 0, cell, cell];
}

/** What the viewer shows of a case: what is expected and what is drawn, with the differences; of four samples those that differ. */
function seenIn(view, heads) {
  const part = crop(view);
  const wanted = [...new Set(view.marks.map(({ plane }) => plane))];
  const corners = placesOf(view).map((at, i) => ({ at, name: letter(i), text: letter(i) }));
  const panels = (wanted.length ? wanted : [0]).flatMap((plane) => [view.ours, view.theirs].map((planes, i) => {
    const label = heads[i] + (view.samples.length ? ` (${word('sample')(plane)})` : '');
    const [dx, dy] = view.samples[plane] ?? [128, 128];
    const mark = (x, y) => {
      const hits = planes[plane][y * view.cell + x];
      const found = i === 1 && view.marks.find((m) => m.plane === plane && m.x === x && m.y === y);
      if (hits === '0' && !found) return null;
      return { fill: found ? { outside: 'missing', allowed: 'extra' }[found.word] : 'agrees', glyph: hits };
    };
    return { key: `${state.lang} ${label}`, label, layers: [{ mark }], outlines: view.outlines, corners, samples: [dx / 256, dy / 256] };
  }));
  const first = view.marks.find(({ plane }) => plane === (wanted[0] ?? 0));
  let cursor = first ? [first.x, first.y] : null;
  const source = {
    part, bounds: [0, 0, view.cell, view.cell], numbers: true, high: 0.5, most: 64, least: 24, panels, cursor,
    legend: [['missing', '', word('outside')], ['extra', '', word('allowed')]],
    onPoint: (x, y) => {
      cursor = [x, y];
      tellPixel(view, cursor);
      pixels.show({ ...source, cursor });
    },
  };
  return source;
}

/** The one viewer of the page, which is put where a case is shown. */
const pixels = make('rp-view');

/** The corners of a case, each place once. */
const placesOf = ({ outlines }) => [...new Map(outlines.flat().map((place) => [String(place), place])).values()];
const letter = (i) => String.fromCharCode(65 + (i % 26));

/** What the engines say of the triangles of a case at a sample, which is moved to where they sample: the middle of a pixel. */
function whyAt(view, [x, y], [dx, dy] = [128, 128]) {
  const places = placesOf(view).map(String);
  const nameOf = ({ place }) => letter(places.indexOf(String(place)));
  const moved = (place) => ({ x: place[0] + 0.5 - dx / 256, y: place[1] + 0.5 - dy / 256, place });
  const triangles = view.outlines.filter(({ length }) => length === 3).map((outline) => outline.map(moved));
  const snap = triangles.flat().every((corner) => [corner.x, corner.y].every((v) => Number.isInteger(256 * v)));
  const plain = triangles.map((triangle) => triangle.map((corner) => ({ x: corner.x, y: corner.y })));
  const answer = ask({ ask: 'look', picture: { window: [x, y, x + 1, y + 1], snap, triangles: plain }, px: [x, y] });
  return answer.error ? [] : aboutTriangles(withEdges(answer.triangles, { triangles }, nameOf), [], snap ? 8 : 0).nodes;
}

/** What is said of the pixel that is looked at: what was drawn, and why which triangle has the sample in question. */
function tellPixel(view, [x, y]) {
  const at = y * view.cell + x;
  const marks = view.marks.filter((mark) => mark.x === x && mark.y === y);
  const hits = [view.ours, view.theirs].map((planes) => planes.map((plane) => plane[at]).join(' '));
  say($('pixel'), `${word('pixelSays')(x, y, ...hits)} ${marks.map(({ note }) => note).filter(Boolean).join('; ')}`);
  renew($('why'), whyAt(view, [x, y], view.samples[marks[0]?.plane ?? 0]));
}

/** The rows of a plane as text, for a report. */
function asText(view, planes) {
  const [x0, y0, x1, y1] = crop(view);
  return planes.map((plane) => Array.from({ length: y1 - y0 }, (_, i) => plane.slice((y0 + i) * view.cell + x0, (y0 + i) * view.cell + x1)).join('\n')).join('\n\n');
}

/** Whether a subject is more than positions. */
const isPlain = (subject) => subject.flat().every(([, , z, w, a, b]) => z === 0.5 && w === 1 && a === 1 && b === 0);
const corners = (subject) => subject.map((shape) => shape.map((vertex) => (isPlain(subject) ? vertex.slice(0, 2) : vertex).join(', ')).join('   ')).join('\n');

function address(name, check, subject) {
  const words = new URLSearchParams({ interface: name, check, case: JSON.stringify(subject) });
  if (state.lang !== 'en') words.set('lang', state.lang);
  return `${location.href.replace(/#.*/, '')}#${words}`;
}

/** Shaders that draw a case alone, with the state in words. */
function reproduction(name, check, { subject, samples }) {
  const device = { interface: name, bits: 8, samples_apart: true };
  const { vertices, side, kind } = must(ask({ ask: 'gpu-batch', check, device, seed: 1, only: subject }));
  const v = numbers(vertices);
  const rows = [];
  for (let at = 0; at < v.length; at += 6) rows.push(Array.from(v.subarray(at, at + 6)));
  const float = (x) => (Number.isInteger(x) ? x.toFixed(1) : String(x));
  const list = (vector, from, to) => rows.map((r) => `  ${vector}(${r.slice(from, to).map(float).join(', ')})`).join(',\n');
  const topology = kind === 'lines' ? 'lines' : 'triangles';
  const how = { values: 'no blending', depth: 'no blending, depth test less, depths cleared to 1', samples: '4 samples, blending ONE ONE' }[kind] ?? 'blending ONE ONE';
  if (name === 'webgl2') {
    return `#version 300 es
// ${side} x ${side} px ${kind === 'values' ? 'RGBA32F' : 'RGBA8'}, viewport all of it, ${how}${kind === 'facing' ? ', back faces culled' : ''};
// drawArrays(${topology.toUpperCase()}, 0, ${rows.length}); the first row of pixels above is the lowest, which readPixels reads first.
const vec4 positions[${rows.length}] = vec4[](
${list('vec4', 0, 4)});
const vec2 attributes[${rows.length}] = vec2[](
${list('vec2', 4, 6)});
out vec2 carried;
void main() { gl_Position = positions[gl_VertexID]; carried = attributes[gl_VertexID]; }

${GLSL[kind === 'values' ? 'values' : samples.length ? 'samples' : 'hits']}`;
  }
  return `// ${side} x ${side} px ${kind === 'values' ? 'rgba32float' : 'r8unorm'}, ${how}${kind === 'facing' ? ', cullMode back' : ''}; draw(${rows.length}) of a ${kind === 'lines' ? 'line' : 'triangle'}-list.
struct Carried { @builtin(position) position: vec4f, @location(0) values: vec2f }
@vertex fn vertex(@builtin(vertex_index) i: u32) -> Carried {
  var positions = array(
${list('vec4f', 0, 4)});
  var attributes = array(
${list('vec2f', 4, 6)});
  return Carried(positions[i], attributes[i]);
}
${WGSL.split('\n').find((line) => line.startsWith(`@fragment fn ${kind === 'values' ? 'values' : 'hits'}`))}${kind === 'samples' ? WGSL_SAMPLES : ''}`;
}

function report(result, check, view) {
  const rule = ruleOf(result.name, check, 'en');
  const [x0, y0, x1, y1] = crop(view).map((at, i) => at + view.origin[i % 2]);
  const [ours, theirs] = check === 'twice' ? [WORDS.en.drawnFirst, WORDS.en.drawnAgain] : ['Expected', 'Drawn'];
  const notes = view.marks.filter(({ note }) => note).slice(0, 8).map(({ x, y, note }) => `pixel ${x}, ${y}: ${note}`);
  return [
    `${result.title}: ${WORDS.en.checks[check]}`, '',
    `Browser: ${navigator.userAgent}`, `Renderer: ${result.renderer}`,
    `Specification: ${rule.section}. ${inWords(rule, WORDS.en)}`,
    ...(result.cause && OF_PIXELS.includes(check) ? [WORDS.en.cause(result.cause)] : []), '',
    isPlain(view.subject) ? WORDS.en.corners : WORDS.en.cornersMore, corners(view.subject), '',
    `Columns ${x0} to ${x1 - 1} and rows ${y0} to ${y1 - 1} of the picture. ${WORDS.en.legend(check).split('.')[0]}.`,
    `${ours}:`, asText(view, view.ours), '', `${theirs}:`, asText(view, view.theirs), ...notes, '',
    reproduction(result.name, check, view), '',
    `Page: ${address(result.name, check, view.subject)}`,
  ].join('\n');
}

const copying = (text) => button(word('copy'), ({ target }) => copyText(text, target, word('copied')));

const finding = $('finding');

/** The first check that breaks a promise, and has a case to show. */
const firstBroken = (results) => results.flatMap(({ rows, views }, index) => (
  Object.keys(views).filter((check) => rows[check]?.word === 'outside').map((check) => [index, check])))[0] ?? null;

function drawFinding() {
  const [index, check] = state.shown ?? [];
  const result = state.results?.[index];
  const view = result?.views[check];
  finding.hidden = !view;
  // It stands right below the headline of its interface.
  const of = view && document.querySelector(`#results [data-api=${result.name}]`);
  (of?.querySelector('.cause') ?? of?.querySelector('.verdict') ?? $('results')).after(finding);
  if (!view) return;
  const rule = ruleOf(result.name, check);
  const heads = (check === 'twice' ? ['drawnFirst', 'drawnAgain'] : ['ours', 'theirs']).map(word);
  const isBroken = result.rows[check]?.word === 'outside' || view.marks.some((mark) => mark.word === 'outside');
  const link = address(result.name, check, view.subject);
  const text = report(result, check, view);
  fill(finding,
    make('h2', { tabIndex: -1 }, `${result.title}, ${word('checks')[check]}: ${word(isBroken ? 'finding' : view.marks.length ? 'example' : 'alike')}`),
    make('div', { className: 'look' }, pixels, make('div', {}, make('p', { id: 'pixel', role: 'status' }), make('div', { id: 'why' }))),
    make('p', { className: 'quiet' }, word('legend')(check)),
    make('blockquote', {}, make('p', {}, inWords(rule)), make('cite', {}, rule.section)),
    make('p', {}, word(isPlain(view.subject) ? 'corners' : 'cornersMore')), make('pre', { tabIndex: 0 }, corners(view.subject)),
    make('p', {}, make('a', { href: link }, word('address')), ' ', copying(link)),
    make('details', {}, make('summary', {}, word('report')), make('pre', { id: 'report', tabIndex: 0 }, text), copying(text)));
  pixels.speak();
  pixels.show(seenIn(view, heads));
  if (pixels.source.cursor) tellPixel(view, pixels.source.cursor);
}

/** The checks, each with the address that makes it alone. */
function listOfChecks() {
  const link = (check) => make('li', {}, make('a', { href: `#${new URLSearchParams({ check, lang: state.lang })}` }, word('checks')[check]));
  return [make('p', {}, word('alone')), make('ul', {}, ...Object.keys(WORDS.en.checks).map(link))];
}

function drawAll() {
  document.documentElement.lang = state.lang === 'zh' ? 'zh-CN' : 'en';
  for (const element of document.querySelectorAll('[data-word]')) element.textContent = word(element.dataset.word);
  $('judge').textContent = word(state.running ? 'stop' : state.results?.length ? 'again' : 'judge');
  const { one } = state;
  const verdict = { equal: 'passes', allowed: 'differs', outside: 'fails' }[one?.verdict];
  $('one').hidden = !one;
  fill($('one'), one ? word('repeats') : '', one?.error ? make('p', { className: 'outside' }, `${word('badCase')} ${one.error}`) : null, verdict ? make('p', { className: one.verdict }, word(verdict)) : null, verdict && one.check === 'lattice' ? make('p', {}, word('latticeOne')(one.facts.finest)) : null);
  const isBegin = !one && !state.running && !state.results?.length;
  fill($('checks'), isBegin ? listOfChecks() : null);
  const results = one ? [] : state.results ?? [];
  const isRefused = !state.running && results.length > 0 && results.every((result) => result.refused);
  fill($('results'), isRefused ? make('p', { className: 'note' }, word('advice')) : null, ...results.map(resultOf));
  drawProgress();
  drawFinding();
}

/** What an address asks for. */
function restore() {
  const words = new URLSearchParams(location.hash.slice(1));
  state.lang = words.get('lang') ?? (navigator.language.startsWith('zh') ? 'zh' : 'en');
  if (!Object.hasOwn(WORDS, state.lang)) state.lang = 'en';
  const [name, check, text] = ['interface', 'check', 'case'].map((key) => words.get(key));
  state.progress = { text: word('starting'), part: 0 };
  drawAll();
  if (text === null) {
    if (Object.hasOwn(WORDS.en.checks, check ?? '')) judgeAll({ check, names: Object.hasOwn(APIS, name ?? '') ? [name] : undefined });
    return;
  }
  try {
    if (!Object.hasOwn(APIS, name ?? '') || !Object.hasOwn(WORDS.en.checks, check ?? '')) throw new Error(`${name}, ${check}`);
    judgeOne({ name, check, subject: JSON.parse(text) });
  } catch (error) {
    state.one = { error: error.message };
    drawAll();
  }
}

function start() {
  instantiate(new WebAssembly.Module(bytesOf($('module').textContent.trim())));
  $('agent').textContent = navigator.userAgent;
  $('judge').addEventListener('click', () => { if (state.running) state.running = false; else judgeAll(); });
  $('language').addEventListener('click', () => { state.lang = state.lang === 'en' ? 'zh' : 'en'; drawAll(); });
  addEventListener('hashchange', restore);
  restore();
  document.body.dataset.ready = '';
}

start();
