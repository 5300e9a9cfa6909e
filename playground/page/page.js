// The page draws what the compiled engines answer, and listens. It computes no pixel of its own.

// --- The compiled module -------------------------------------------------------------------------

let engines = null;
let compiled = null;

function instantiate() {
  engines = new WebAssembly.Instance(compiled, {}).exports;
}

/** Asks the engines; an answer, or an error as its text. A module that stopped is started again. */
function ask(question) {
  const text = new TextEncoder().encode(JSON.stringify(question));
  try {
    const at = engines.room(text.length);
    new Uint8Array(engines.memory.buffer, at, text.length).set(text);
    const length = engines.answer();
    const bytes = new Uint8Array(engines.memory.buffer, engines.text(), length);
    return JSON.parse(new TextDecoder().decode(bytes));
  } catch (error) {
    instantiate();
    return { error: `${word('crash')} (${error.message})` };
  }
}

// --- What is shown -------------------------------------------------------------------------------

const SUB = 256;
const LETTERS = 'ABCDEFGHIJKLMNOPQRSTUVWXYZ';
const state = { lang: 'en', scene: 'triangle' };
let names = null; // what there is to choose from
let shown = []; // panels of the last frame: {canvas, view}
let last = { answer: null, look: null };
const frames = []; // milliseconds that each frame took

const word = (key) => WORDS[state.lang][key] ?? key;
const $ = (id) => document.getElementById(id);

/** An element with properties, attributes (as `attr`) and children. */
function make(tag, properties = {}, ...children) {
  const { attr = {}, ...rest } = properties;
  const element = Object.assign(document.createElement(tag), rest);
  for (const [name, value] of Object.entries(attr)) element.setAttribute(name, value);
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}

function begin(scene, from = {}) {
  clearInterval(state.playing);
  for (const key of Object.keys(state)) if (key !== 'lang') delete state[key];
  Object.assign(state, { scene, snap: true, four: false, numbers: false, chosen: 0, moves: 'corner', step: 0 });
  Object.assign(state, structuredClone(SCENES[scene].start), from);
}

const scene = () => SCENES[state.scene];
const picture = () => (state.lines
  ? { window: state.window, snap: true, lines: state.lines }
  : { window: state.window, snap: state.snap, triangles: state.triangles });

/** The corners that can be dragged, those at one place together: [{x, y, members}]. */
function handles() {
  if (scene().handles) return scene().handles();
  if (state.lines) {
    return state.lines.flatMap((line) => line.map((end) => ({ x: end[0] + 0.5, y: end[1] + 0.5, members: [end] })));
  }
  const found = [];
  for (const corner of state.triangles.flat()) {
    const same = found.find((handle) => handle.x === corner.x && handle.y === corner.y);
    if (same) same.members.push(corner);
    else found.push({ x: corner.x, y: corner.y, members: [corner] });
  }
  return found;
}

/** Puts a handle somewhere, on the lattice where corners snap, on a whole pixel for lines. */
function place(handle, x, y) {
  const limit = (v) => Math.max(-4096, Math.min(4096, v));
  if (scene().place) scene().place(handle, x, y);
  else if (state.lines) {
    handle.members[0][0] = limit(Math.floor(x));
    handle.members[0][1] = limit(Math.floor(y));
  } else {
    const to = (v) => limit(state.snap ? Math.round(v * SUB) / SUB : v);
    for (const corner of handle.members) Object.assign(corner, { x: to(x), y: to(y) });
  }
  delete state.named;
  delete state.generated;
  redraw();
}

// --- Frames --------------------------------------------------------------------------------------

let pending = false;
function redraw() {
  if (pending) return;
  pending = true;
  requestAnimationFrame(() => {
    pending = false;
    const begun = performance.now();
    drawFrame();
    frames.push(performance.now() - begun);
    if (frames.length > 1000) frames.shift();
  });
  keepAddress();
}

function drawFrame() {
  const answer = scene().ask();
  trouble(answer.error);
  if (!answer.error) {
    last.answer = answer;
    const panels = scene().panels(answer);
    while (shown.length > panels.length) shown.pop().figure.remove();
    $('panels').dataset.count = panels.length;
    panels.forEach((_, i) => { shown[i] ??= newPanel(i); });
    // Read before anything is written, so that the page is laid out once.
    for (const panel of shown) panel.width = panel.canvas.clientWidth;
    panels.forEach((panel, i) => drawPanel(panel, i, answer));
  }
  explain(answer);
  drawCorners();
  $('command').textContent = command();
  $('same').hidden = command() === '';
}

/** What is said beside the panels. Tables take longer than pixels, so they follow a drag ten times a second. */
let explained = 0;
let explaining = 0;
function explain(answer) {
  clearTimeout(explaining);
  const wait = explained + 100 - performance.now();
  if (wait > 0) { explaining = setTimeout(() => explain(last.answer), wait); return; }
  explained = performance.now();
  last.look = null;
  if (state.px && state.triangles && !scene().handles) {
    if (state.snap) {
      const look = ask({ ask: 'look', picture: picture(), px: state.px });
      last.look = look.error ? null : look;
    }
  }
  fill($('look'), scene().look && !answer.error ? scene().look(answer) : []);
  const said = [...$('look').querySelectorAll('h2, .say')].map((element) => element.textContent).join('. ');
  if ($('announce').textContent !== said) $('announce').textContent = said;
}

function trouble(text) {
  $('trouble').hidden = !text;
  $('trouble').textContent = text ?? '';
}

/** New contents; what had the focus and is there again keeps it. */
function fill(element, children) {
  const focused = element.contains(document.activeElement) ? document.activeElement.id : '';
  element.replaceChildren(...children.filter(Boolean));
  if (focused) $(focused)?.focus();
}

// --- Panels --------------------------------------------------------------------------------------

let colours = {};
function readColours() {
  const style = getComputedStyle(document.documentElement);
  for (const name of ['empty', 'grid', 'agrees', 'missing', 'extra', 'twice', 'edge', 'sample', 'cursor', 'glyph', 'a', 'b', 'c', 'd']) {
    colours[name] = style.getPropertyValue(`--px-${name}`).trim();
  }
}

function newPanel(i) {
  const caption = make('figcaption');
  const canvas = make('canvas', { tabIndex: 0, attr: { role: 'application', 'aria-describedby': 'keys' } });
  const figure = make('figure', {}, caption, canvas);
  $('panels').append(figure);
  listen(canvas, i);
  return { figure, caption, canvas, said: '' };
}

/** A panel is {title | select, says, bad, pixel(i, x, y), outlines, over}. */
function drawPanel(panel, i, answer) {
  const { caption, canvas } = shown[i];
  const key = JSON.stringify([panel.title, panel.select, state.lang]);
  if (shown[i].said !== key) {
    shown[i].said = key;
    const head = panel.select ? chooser(i, panel.select) : make('strong', {}, panel.title);
    caption.replaceChildren(head, make('output'));
  }
  const output = caption.lastChild;
  const says = panel.says ?? '';
  if (output.textContent !== says) {
    output.textContent = says;
    output.className = panel.bad === undefined ? '' : panel.bad ? 'bad' : 'good';
    canvas.setAttribute('aria-label', `${panel.title ?? panel.select}: ${says}`);
  }
  const [x0, y0, x1, y1] = state.window;
  const ratio = devicePixelRatio || 1;
  const wide = Math.max(1, Math.round(shown[i].width * ratio));
  const high = Math.round((wide * (y1 - y0)) / (x1 - x0));
  if (canvas.width !== wide || canvas.height !== high) Object.assign(canvas, { width: wide, height: high });
  const unit = wide / (x1 - x0);
  const view = { unit, x0, y0, x: (px) => (px - x0) * unit, y: (px) => (px - y0) * unit, ratio };
  shown[i].view = view;
  const g = canvas.getContext('2d');
  g.fillStyle = colours.empty;
  g.fillRect(0, 0, wide, high);
  drawPixels(g, view, panel);
  drawGrid(g, view);
  for (const outline of panel.outlines ?? answer.outlines ?? []) drawOutline(g, view, outline);
  panel.over?.(g, view);
  drawHandles(g, view);
}

function chooser(i, name) {
  const select = make('select', { attr: { 'aria-label': `${word('panel')} ${i + 1}` } });
  for (const [value, label] of scene().choices()) select.append(make('option', { value }, label));
  select.value = name;
  select.addEventListener('change', () => { state.by[i] = select.value; redraw(); });
  return select;
}

/** A colour as the 32 bits of a picture, by the browser's own reading of it. */
const bits = new Map();
const reader = make('canvas', { width: 1, height: 1 }).getContext('2d', { willReadFrequently: true });
function bitsOf(colour) {
  let found = bits.get(colour);
  if (found === undefined) {
    if (bits.size > 50000) bits.clear();
    reader.fillStyle = colour;
    reader.fillRect(0, 0, 1, 1);
    found = new Uint32Array(reader.getImageData(0, 0, 1, 1).data.buffer)[0];
    bits.set(colour, found);
  }
  return found;
}

/** All pixels as one small picture, enlarged: a rectangle for each of them took most of a frame. */
const small = make('canvas').getContext('2d');
function drawPixels(g, view, panel) {
  const [x0, y0, x1, y1] = state.window;
  const [width, height] = [x1 - x0, y1 - y0];
  const image = new ImageData(width, height);
  const data = new Uint32Array(image.data.buffer);
  const signs = [];
  for (let i = 0; i < data.length; i += 1) {
    const [x, y] = [x0 + (i % width), y0 + Math.floor(i / width)];
    const pixel = panel.pixel?.(i, x, y);
    if (!pixel) continue;
    data[i] = bitsOf(pixel.colour);
    if (pixel.ring || (pixel.glyph && view.unit > 7)) signs.push([x, y, pixel]);
  }
  Object.assign(small.canvas, { width, height });
  small.putImageData(image, 0, 0);
  g.imageSmoothingEnabled = false;
  g.drawImage(small.canvas, 0, 0, width * view.unit, height * view.unit);
  g.font = `600 ${Math.floor(view.unit * 0.6)}px ui-monospace, Consolas, monospace`;
  g.textAlign = 'center';
  g.textBaseline = 'middle';
  g.strokeStyle = colours.cursor;
  g.fillStyle = colours.glyph;
  g.lineWidth = Math.max(1, view.ratio);
  for (const [x, y, { glyph, ring }] of signs) {
    if (glyph) g.fillText(glyph, view.x(x + 0.5), view.y(y + 0.5));
    if (ring) {
      g.beginPath();
      g.arc(view.x(x + 0.5), view.y(y + 0.5), view.unit * 0.36, 0, 7);
      g.stroke();
    }
  }
}

function drawGrid(g, view) {
  const [x0, y0, x1, y1] = state.window;
  if (view.unit >= 4) {
    g.strokeStyle = colours.grid;
    g.lineWidth = 1;
    g.beginPath();
    for (let x = x0; x <= x1; x += 1) { g.moveTo(Math.floor(view.x(x)) + 0.5, 0); g.lineTo(Math.floor(view.x(x)) + 0.5, view.y(y1)); }
    for (let y = y0; y <= y1; y += 1) { g.moveTo(0, Math.floor(view.y(y)) + 0.5); g.lineTo(view.x(x1), Math.floor(view.y(y)) + 0.5); }
    g.stroke();
  }
  if (view.unit >= 12 * view.ratio && !scene().noSamples) {
    g.fillStyle = colours.sample;
    const dot = Math.max(1.5, view.ratio);
    for (let y = y0; y < y1; y += 1) {
      for (let x = x0; x < x1; x += 1) g.fillRect(view.x(x + 0.5) - dot / 2, view.y(y + 0.5) - dot / 2, dot, dot);
    }
  }
}

function drawOutline(g, view, points, colour = colours.edge) {
  g.strokeStyle = colour;
  g.lineWidth = 1.5 * view.ratio;
  g.beginPath();
  points.forEach(([x, y], i) => (i ? g.lineTo(view.x(x), view.y(y)) : g.moveTo(view.x(x), view.y(y))));
  g.closePath();
  g.stroke();
}

function drawHandles(g, view) {
  const focused = handles();
  g.font = `600 ${12 * view.ratio}px system-ui, sans-serif`;
  g.textAlign = 'center';
  g.textBaseline = 'middle';
  focused.forEach((handle, i) => {
    const chosen = state.moves === 'corner' && i === state.chosen;
    g.beginPath();
    g.arc(view.x(handle.x), view.y(handle.y), (chosen ? 7 : 5) * view.ratio, 0, 7);
    g.fillStyle = chosen ? colours.edge : colours.empty;
    g.fill();
    g.strokeStyle = colours.edge;
    g.lineWidth = 2 * view.ratio;
    g.stroke();
    g.fillStyle = colours.cursor;
    if (focused.length <= LETTERS.length) g.fillText(LETTERS[i], view.x(handle.x) + 13 * view.ratio, view.y(handle.y) - 9 * view.ratio);
  });
  if (state.px) {
    g.strokeStyle = colours.cursor;
    g.lineWidth = (state.moves === 'pixel' ? 3 : 2) * view.ratio;
    g.strokeRect(view.x(state.px[0]), view.y(state.px[1]), view.unit, view.unit);
  }
}

// --- Listening -----------------------------------------------------------------------------------

function listen(canvas, i) {
  let held = null;
  const at = (event) => {
    const box = canvas.getBoundingClientRect();
    const { x0, y0, unit, ratio } = shown[i].view;
    return [x0 + ((event.clientX - box.left) * ratio) / unit, y0 + ((event.clientY - box.top) * ratio) / unit];
  };
  const nearest = (event) => {
    const [x, y] = at(event);
    const { unit, ratio } = shown[i].view;
    const reach = (event.pointerType === 'touch' ? 26 : 14) * ratio;
    const far = (handle) => Math.hypot(handle.x - x, handle.y - y) * unit;
    const order = handles().map((handle, index) => ({ index, far: far(handle) })).sort((a, b) => a.far - b.far);
    return order[0]?.far <= reach ? order[0].index : null;
  };
  canvas.addEventListener('pointerdown', (event) => {
    const index = nearest(event);
    canvas.setPointerCapture(event.pointerId);
    held = index === null ? { pan: at(event), moved: false } : { index };
    if (index !== null) Object.assign(state, { chosen: index, moves: 'corner' });
    redraw();
  });
  canvas.addEventListener('pointermove', (event) => {
    const [x, y] = at(event);
    if (held?.index !== undefined) place(handles()[held.index] ?? handles()[0], x, y);
    else if (held?.pan) {
      const [dx, dy] = [Math.round(held.pan[0] - x), Math.round(held.pan[1] - y)];
      if (dx || dy) { held.moved = true; pan(dx, dy); }
    } else if (event.pointerType === 'mouse' && state.hover !== false) lookAt(x, y);
  });
  const release = (event) => {
    if (held?.pan && !held.moved) { lookAt(...at(event)); state.hover = event.pointerType !== 'mouse' || state.hover === false; }
    held = null;
  };
  canvas.addEventListener('pointerup', release);
  canvas.addEventListener('pointercancel', () => { held = null; });
  canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    zoom(event.deltaY > 0 ? 1 : -1);
  }, { passive: false });
  canvas.addEventListener('keydown', keys);
}

function lookAt(x, y) {
  if (scene().handles) return;
  const [px, py] = [Math.floor(x), Math.floor(y)];
  const [x0, y0, x1, y1] = state.window;
  if (px < x0 || py < y0 || px >= x1 || py >= y1) return;
  if (state.px?.[0] === px && state.px?.[1] === py) return;
  state.px = [px, py];
  redraw();
}

const SIDES = [4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128];

/** More or fewer pixels in the same panel, about the middle. */
function zoom(way) {
  if (scene().handles) return;
  const [x0, y0, x1, y1] = state.window;
  const now = Math.max(x1 - x0, y1 - y0);
  const next = way > 0 ? SIDES.find((side) => side > now) : [...SIDES].reverse().find((side) => side < now);
  if (!next) return;
  const [cx, cy] = [(x0 + x1) / 2, (y0 + y1) / 2];
  const [left, top] = [Math.round(cx - next / 2), Math.round(cy - next / 2)];
  state.window = [left, top, left + next, top + next];
  keepPixel();
  redraw();
}

function pan(dx, dy) {
  if (scene().handles) return;
  const [x0, y0, x1, y1] = state.window;
  state.window = [x0 + dx, y0 + dy, x1 + dx, y1 + dy];
  keepPixel();
  redraw();
}

function keepPixel() {
  if (!state.px) return;
  const [x0, y0, x1, y1] = state.window;
  const within = (v, low, high) => Math.max(low, Math.min(high - 1, v));
  state.px = [within(state.px[0], x0, x1), within(state.px[1], y0, y1)];
}

function keys(event) {
  const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
  const arrow = arrows[event.key];
  const all = handles();
  if (arrow && event.altKey) pan(...arrow);
  else if (arrow && state.moves === 'pixel') lookAt(state.px[0] + arrow[0], state.px[1] + arrow[1]);
  else if (arrow) {
    const handle = all[state.chosen % all.length];
    const step = event.shiftKey && !state.lines ? 1 / SUB : 1;
    place(handle, handle.x + arrow[0] * step, handle.y + arrow[1] * step);
  } else if (event.key === ']' || event.key === '[') {
    Object.assign(state, { moves: 'corner', chosen: (state.chosen + (event.key === ']' ? 1 : all.length - 1)) % all.length });
    redraw();
  } else if (event.key === 'p') {
    state.moves = state.moves === 'pixel' ? 'corner' : 'pixel';
    state.px ??= [state.window[0], state.window[1]];
    redraw();
  } else if (event.key === '+' || event.key === '=') zoom(-1);
  else if (event.key === '-') zoom(1);
  else return;
  event.preventDefault();
}

// --- Tools and the table of corners --------------------------------------------------------------

function button(label, act, attr = {}) {
  const made = make('button', { type: 'button', attr }, label);
  made.addEventListener('click', act);
  return made;
}

function check(label, key, then = () => {}) {
  const box = make('input', { type: 'checkbox', checked: state[key], attr: { 'data-state': key } });
  box.addEventListener('change', () => { state[key] = box.checked; then(); redraw(); });
  return make('label', {}, box, ` ${label}`);
}

function slide(label, value, [low, high, step], set) {
  const range = make('input', { type: 'range', min: low, max: high, step, value });
  const says = make('output', {}, String(value));
  range.addEventListener('input', () => { set(Number(range.value)); says.textContent = range.value; redraw(); });
  return make('label', { className: 'group' }, `${label} `, range, ' ', says);
}

function drawTools() {
  const tools = [];
  if (!scene().handles) {
    tools.push(make('span', { className: 'group' },
      button('−', () => zoom(1), { 'aria-label': word('zoomOut') }), button('+', () => zoom(-1), { 'aria-label': word('zoomIn') }),
      button('←', () => pan(-1, 0), { 'aria-label': word('panLeft') }), button('→', () => pan(1, 0), { 'aria-label': word('panRight') }),
      button('↑', () => pan(0, -1), { 'aria-label': word('panUp') }), button('↓', () => pan(0, 1), { 'aria-label': word('panDown') })));
  }
  fill($('tools'), [...tools, ...(scene().tools?.() ?? [])]);
}

/** Corners as numbers; built anew only when there are other ones, so that typing is not disturbed. */
let cornersFor = '';
function drawCorners() {
  const all = handles();
  const fields = scene().fields ?? (state.lines ? [] : []);
  const key = JSON.stringify([state.scene, state.lang, all.length, state.snap, fields.map((f) => f.key)]);
  if (key !== cornersFor) {
    cornersFor = key;
    buildCorners(all, fields);
  }
  for (const input of $('corners').querySelectorAll('input')) {
    const handle = all[Number(input.dataset.corner)];
    const value = fields.find((f) => f.key === input.dataset.key)?.get(handle) ?? handle[input.dataset.key];
    const text = String(state.lines ? Math.floor(value) : value);
    if (document.activeElement !== input || input.type === 'range') input.value = text;
  }
  [...$('corners').querySelectorAll('tbody tr')].forEach((row, i) => row.classList.toggle('chosen', i === state.chosen));
}

function buildCorners(all, fields) {
  const columns = [{ key: 'x' }, { key: 'y' }, ...fields];
  const head = make('tr', {}, make('th', {}, word(state.lines ? 'end' : 'corner')), ...columns.map((c) => make('th', {}, c.key)));
  const rows = all.map((handle, i) => {
    const cells = columns.map((column) => {
      const step = state.lines ? 1 : column.step ?? (state.snap ? 1 / SUB : 'any');
      const input = make('input', { type: 'number', attr: { step, 'data-corner': i, 'data-key': column.key, 'aria-label': `${LETTERS[i % 26]} ${column.key}` } });
      input.addEventListener('input', () => {
        const value = Number(input.value);
        const now = handles()[i];
        if (input.value === '' || !Number.isFinite(value) || !now) return;
        if (column.set) { column.set(now, value); redraw(); } else place(now, column.key === 'x' ? value : now.x, column.key === 'y' ? value : now.y);
      });
      input.addEventListener('focus', () => { state.chosen = i; });
      return make('td', {}, input);
    });
    return make('tr', {}, make('th', { scope: 'row' }, LETTERS[i % 26]), ...cells);
  });
  fill($('corners'), [
    make('h2', { id: 'corners-title' }, word('corners')),
    make('div', { className: 'scroll' }, make('table', {}, make('thead', {}, head), make('tbody', {}, ...rows))),
  ]);
}

// --- Break it ------------------------------------------------------------------------------------

let hunt = null;

function load(found, from) {
  if (found.error) { trouble(found.error); return; }
  const { picture: drawn } = found;
  const kind = drawn.lines?.length ? 'line' : 'triangle';
  const by = state.scene === kind ? state.by : undefined;
  if (state.scene !== kind) { begin(kind); drawAll(); }
  if (by) state.by = by;
  state.window = drawn.window;
  state.snap = drawn.snap;
  if (kind === 'line') state.lines = drawn.lines;
  else state.triangles = drawn.triangles;
  delete state.named;
  delete state.generated;
  Object.assign(state, from, { chosen: 0, px: middle(drawn.window), step: 999 });
  const box = document.querySelector('[data-state="snap"]');
  if (box) box.checked = state.snap;
  pointAtWrong(state.by?.at(-1));
  redraw();
}

const middle = ([x0, y0, x1, y1]) => [Math.floor((x0 + x1) / 2), Math.floor((y0 + y1) / 2)];

function drawBreak() {
  const section = $('break');
  section.hidden = !scene().breaks;
  if (section.hidden) { fill(section, []); return; }
  const { families, who, defaults } = scene().breaks();
  const options = (list) => list.map((entry) => make('option', { value: entry.name, title: entry.about }, entry.name));
  const named = make('select', { id: 'named' }, make('option', { value: '' }, word('choose')), ...options([...names.named, ...names.recorded]));
  named.addEventListener('change', () => {
    if (!named.value) return;
    const found = ask({ ask: 'named', name: named.value });
    load(found, { named: named.value });
    $('hunt').textContent = found.about ?? '';
  });
  const by = make('select', { id: 'who' }, ...who.map(([value, label]) => make('option', { value }, label)));
  by.value = defaults.by;
  const family = make('select', { id: 'family' }, ...options(families));
  family.value = defaults.family;
  const says = make('p', { id: 'hunt', attr: { role: 'status' } });
  const show = (found, index) => {
    load(found, { generated: { family: family.value, seed: 1, index } });
    if (!state.by.includes(by.value)) { state.by[state.by.length - 1] = by.value; redraw(); }
    pointAtWrong(by.value);
  };
  fill(section, [
    make('h2', { id: 'break-title' }, word('breakIt')),
    make('div', { className: 'form' },
      make('label', { htmlFor: 'named' }, word('named')), named,
      make('label', { htmlFor: 'who' }, word('who')), by,
      make('label', { htmlFor: 'family' }, word('family')), family),
    make('p', {},
      button(word('random'), () => {
        const index = Math.floor(Math.random() * 1e6);
        show(ask({ ask: 'generated', family: family.value, seed: 1, index }), index);
        says.textContent = `${family.value}#${index}`;
      }, { id: 'random' }), ' ',
      button(word('search'), () => search(by.value, family.value, says, show), { id: 'search' }), ' ',
      button(word('shrink'), () => shrink(by.value, says), { id: 'shrink' }), ' ',
      button(word('stop'), () => { hunt = null; }, { id: 'stop' })),
    says,
  ]);
}

/** Points at the first pixel that somebody gets wrong, so that the column beside explains it. */
function pointAtWrong(by) {
  if (!state.triangles) return;
  const { panels, truth } = ask({ ask: 'draw', picture: picture(), by: [by] });
  const wrong = [...(panels?.[0]?.hits ?? '')].findIndex((hits, i) => hits !== truth[i]);
  if (wrong < 0) return;
  const [x0, y0, x1] = state.window;
  state.px = [x0 + (wrong % (x1 - x0)), y0 + Math.floor(wrong / (x1 - x0))];
  redraw();
}

/** Looks at some cases a frame, so that the page stays alive. */
function search(by, family, says, show) {
  const mine = {};
  hunt = mine;
  const begun = Math.floor(Math.random() * 1e6);
  let from = begun;
  const slice = () => {
    if (hunt !== mine) return;
    const until = performance.now() + 12;
    do {
      const answer = ask({ ask: 'search', by, family, seed: 1, from, count: 20 });
      if (answer.error) { says.textContent = answer.error; return; }
      from = answer.next;
      if (answer.found !== null) {
        hunt = null;
        says.textContent = word('caught')(`${family}#${answer.found}`, from - begun);
        show(answer, answer.found);
        return;
      }
    } while (performance.now() < until);
    if (from - begun >= 20000) { says.textContent = word('never')(from - begun); return; }
    says.textContent = word('searched')(from - begun);
    requestAnimationFrame(slice);
  };
  slice();
}

/** Plays the ever smaller cases, slower towards the end. */
function shrink(by, says) {
  const answer = ask({ ask: 'shrink', by, picture: picture() });
  if (answer.error) { says.textContent = answer.error; return; }
  const mine = {};
  hunt = mine;
  const calm = matchMedia('(prefers-reduced-motion: reduce)').matches;
  let at = calm ? answer.steps.length - 1 : 0;
  const next = () => {
    if (hunt !== mine) return;
    load({ picture: answer.steps[at] }, {});
    pointAtWrong(by);
    says.textContent = word('shrunk')(at);
    at += 1;
    if (at < answer.steps.length) setTimeout(next, Math.min(250, 3000 / answer.steps.length));
    else hunt = null;
  };
  next();
}

// --- Address and command -------------------------------------------------------------------------

const FIELDS = ['x', 'y', 'w', 'depth', 'u', 'v'];

function address() {
  const words = new URLSearchParams({ scene: state.scene });
  if (state.named) words.set('case', state.named);
  else if (state.generated) {
    words.set('case', `${state.generated.family}#${state.generated.index}`);
    words.set('seed', state.generated.seed);
  }
  else if (state.lines) words.set('lines', state.lines.map((line) => line.flat().join(',')).join(';'));
  else if (state.triangles) {
    const corner = (c) => FIELDS.map((f) => c[f] ?? (f === 'w' ? 1 : 0)).join(',').replace(/(,0)+$/, '').replace(/^([^,]*)$/, '$1,0');
    words.set('t', state.triangles.map((t) => t.map(corner).join('_')).join(';'));
  }
  if (state.window) words.set('window', state.window.join(','));
  if (state.by) words.set('by', state.by.join(','));
  if (state.px) words.set('px', state.px.join(','));
  if (state.snap === false) words.set('snap', '0');
  if (state.numbers) words.set('numbers', '1');
  for (const key of scene().keeps ?? []) words.set(key, typeof state[key] === 'object' ? JSON.stringify(state[key]) : state[key]);
  if (state.lang !== 'en') words.set('lang', state.lang);
  return `#${words.toString().replaceAll('%2C', ',').replaceAll('%3B', ';')}`;
}

let keeping = 0;
function keepAddress() {
  clearTimeout(keeping);
  // Browsers refuse addresses that change at every frame.
  keeping = setTimeout(() => history.replaceState(null, '', address()), 250);
}

/** Restores what an address says; what it does not say is as the scene begins. */
function restore(hash) {
  const words = new URLSearchParams(hash.replace(/^#/, ''));
  state.lang = words.get('lang') ?? (navigator.language.startsWith('zh') ? 'zh' : 'en');
  if (!WORDS[state.lang]) state.lang = 'en';
  begin(SCENES[words.get('scene')] ? words.get('scene') : 'triangle');
  const numbers = (text) => text.split(',').map(Number);
  const wanted = words.get('case');
  if (wanted) {
    const [family, index] = wanted.split('#');
    const seed = Number(words.get('seed') ?? 1);
    const found = index === undefined ? ask({ ask: 'named', name: wanted }) : ask({ ask: 'generated', family, seed, index: Number(index) });
    load(found, index === undefined ? { named: wanted } : { generated: { family, seed, index: Number(index) } });
  }
  const good = (list) => list.every((n) => Number.isFinite(n));
  const lines = words.get('lines')?.split(';').map(numbers);
  if (lines?.every((l) => l.length === 4 && good(l)) && state.lines) state.lines = lines.map(([a, b, c, d]) => [[a, b], [c, d]]);
  const triangles = words.get('t')?.split(';').map((t) => t.split('_').map(numbers));
  if (triangles?.every((t) => t.length === 3 && t.every((c) => c.length >= 2 && good(c))) && state.triangles) {
    state.triangles = triangles.map((t) => t.map((c) => Object.fromEntries(FIELDS.map((f, i) => [f, c[i] ?? (f === 'w' ? 1 : 0)]))));
  }
  const window = words.get('window') && numbers(words.get('window'));
  if (window?.length === 4 && good(window) && state.window) state.window = window.map(Math.round);
  const by = words.get('by')?.split(',');
  if (by && state.by) { state.by = by.slice(0, 4); state.four = by.length === 4; }
  const px = words.get('px') && numbers(words.get('px'));
  if (px?.length === 2 && good(px)) state.px = px;
  if (words.get('snap') === '0') state.snap = false;
  state.numbers = words.get('numbers') === '1';
  for (const key of scene().keeps ?? []) {
    const text = words.get(key);
    if (text === null) continue;
    try { state[key] = typeof state[key] === 'string' ? text : JSON.parse(text); } catch { /* as the scene begins */ }
  }
  keepPixel();
}

/** What shows the same on the command line; nothing where there is no such command. */
function command() {
  const point = (c) => `${c.x},${c.y}`;
  if (state.named) return `rasterproof inspect ${state.named}`;
  if (state.generated) return `rasterproof inspect '${state.generated.family}#${state.generated.index}' --seed ${state.generated.seed}`;
  if (state.lines) return `rasterproof inspect --line ${state.lines[0].map((end) => end.join(',')).join(' ')}`;
  if (!state.triangles || !state.snap) return '';
  return state.triangles.slice(0, 2).map((t) => `rasterproof inspect ${t.map(point).join(' ')}`).join('\n');
}

async function copy(text) {
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    const area = make('textarea', { value: text });
    document.body.append(area);
    area.select();
    document.execCommand('copy');
    area.remove();
  }
  $('copied').textContent = word('copied');
  setTimeout(() => { $('copied').textContent = ''; }, 1500);
}

// --- The whole -----------------------------------------------------------------------------------

function drawAll() {
  document.documentElement.lang = state.lang === 'zh' ? 'zh-CN' : 'en';
  for (const element of document.querySelectorAll('[data-word]')) element.textContent = word(element.dataset.word);
  $('scenes').setAttribute('aria-label', word('scenes'));
  $('tools').setAttribute('aria-label', word('engines'));
  fill($('scenes'), Object.keys(SCENES).map((name) => button(word(name), () => { begin(name); drawAll(); }, { 'aria-pressed': name === state.scene, id: `scene-${name}` })));
  $('about').textContent = WORDS[state.lang].about[state.scene];
  $('panels').replaceChildren();
  shown = [];
  cornersFor = '';
  clearTimeout(explaining);
  explained = 0;
  hunt = null;
  drawTools();
  drawBreak();
  redraw();
}

function start() {
  const text = $('module').textContent.trim();
  compiled = new WebAssembly.Module(Uint8Array.from(atob(text), (c) => c.charCodeAt(0)));
  instantiate();
  names = ask({ ask: 'list' });
  readColours();
  restore(location.hash);
  drawAll();
  $('language').addEventListener('click', () => { state.lang = state.lang === 'en' ? 'zh' : 'en'; drawAll(); });
  $('copy').addEventListener('click', () => copy($('command').textContent));
  $('copy-address').addEventListener('click', () => { history.replaceState(null, '', address()); copy(location.href); });
  $('reset').addEventListener('click', () => { begin(state.scene); drawAll(); });
  addEventListener('resize', redraw);
  addEventListener('hashchange', () => { restore(location.hash); drawAll(); });
  document.body.dataset.ready = '';
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => { readColours(); redraw(); });
}

start();
