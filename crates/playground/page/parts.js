// What scenes are made of: tables, fields, sliders, steps and how pixels are judged.

const at = (x, y, more = {}) => ({ x, y, w: 1, depth: 0, u: 0, v: 0, ...more });
const corner = (i) => LETTERS[i % LETTERS.length];
const round = (value, digits = 4) => (Number.isFinite(value) ? String(Number(value.toFixed(digits))) : '–');
/** A byte as the pipeline makes it of a value: thresholds lie off simple fractions. */
const mix = (value) => Math.floor(255 * Math.max(0, Math.min(1, value)) + 0.5 + 2 ** -20 / 3);

/** Names with a label, for a panel to choose from. */
function painters() {
  const rules = [['exclusive-edges', word('strict')], ['inclusive-edges', word('inclusive')]];
  const all = names.triangles.map(({ name }) => (name === 'edge-function' ? [name, `${name}: ${word('tl')}`] : name));
  return [...all.slice(0, 2), ...rules, ...all.slice(2)];
}

/** A pixel by its hits and what they should be. */
function judged(hits, right) {
  const mark = judge(Number(hits), Number(right));
  const isRightlyTwice = mark?.fill === 'overlap';
  return mark && (state.numbers || isRightlyTwice) ? { fill: isRightlyTwice ? 'agrees' : mark.fill, glyph: hits } : mark;
}

function verdict(panel) {
  if (panel.refused) return { says: `${word('refused')}: ${panel.refused}`, bad: true };
  const { missing, extra, twice = 0, covered } = panel;
  const wrong = missing + extra > 0;
  const counts = [[missing, 'missing'], [extra - twice, 'extra'], [twice, 'twice']].filter(([count]) => count > 0);
  const says = wrong ? counts.map(([count, kind]) => `${count} ${word(kind)}`).join(', ') : word('agrees');
  return { says: (covered === undefined ? '' : `${covered} ${word('covered')}: `) + says, bad: wrong };
}

/** What two painters of an answer make of each pixel differently. */
function difference({ panels: [a, b] }) {
  const title = [a, b].map(({ name }) => labelOf(painters(), name)).join(' − ');
  if (!a.hits || !b.hits) return { title, says: word('refused'), bad: true };
  const count = [...a.hits].filter((hits, i) => hits !== b.hits[i]).length;
  return {
    title, says: count ? `${count} ${word('differ')}` : word('same'), bad: count > 0,
    pixel: (i) => judged(a.hits[i], b.hits[i]),
  };
}

/** Buttons behind the word for what they choose. */
const choices = (key, buttons) => make('span', { className: 'group', role: 'group', 'aria-label': word(key) }, `${word(key)} `, ...buttons);

/** The rules, to choose for the second panel at one press. */
const RULES = { 'exclusive-edges': 'strict', 'inclusive-edges': 'inclusive', 'edge-function': 'tl' };
function rules() {
  const choose = (name) => () => { state.by[1] = name; redraw(); };
  return choices('ruleOf', Object.entries(RULES).map(([name, key]) => button(word(key), choose(name), { id: `rule-${key}`, 'data-by': name })));
}

const SQUARE = [[at(2.5, 2.5), at(10.5, 2.5), at(10.5, 10.5)], [at(2.5, 10.5), at(2.5, 2.5), at(10.5, 10.5)]];
const RIM = [[11.5, 6.5], [10.5, 10.5], [6.5, 12.5], [2.5, 10.5], [1.5, 6.5], [2.5, 2.5], [6.5, 0.5], [10.5, 2.5]];
const SHAPES = {
  square: SQUARE,
  fan: RIM.map((rim, i) => [at(6.5, 6.5), at(...rim), at(...RIM[(i + 1) % RIM.length])]),
  single: [[at(2.25, 1.75), at(11.5, 4.5), at(5, 12.25)]],
};
function shapes() {
  const take = (name) => () => { load({ picture: { window: [0, 0, 14, 14], snap: true, triangles: structuredClone(SHAPES[name]) } }, {}); };
  return choices('shape', Object.keys(SHAPES).map((name) => button(word(name), take(name), { id: `shape-${name}` })));
}

/** Shows four panels, the last two by the first of these that are not shown, or two. */
const four = (...more) => check(word('four'), 'four', () => {
  while (state.four && state.by.length < 4) state.by.push(more.find((name) => !state.by.includes(name)));
  if (!state.four) state.by.length = 2;
});

/** A value of the corners, in the table; at least `low`. */
function field(key, low, step) {
  return { key, step, get: (handle) => handle.members[0][key], set: (handle, value) => setField(handle, key, Math.max(low, value)) };
}

function setField(handle, key, value) {
  for (const member of handle.members) member[key] = value;
}

/** A slider for a value of each corner. */
const sliders = (key, range) => handles().map((_, i) => (
  slide(`${key} ${corner(i)}`, () => handles()[i].members[0][key], range, (next) => setField(handles()[i], key, next))));

/** A value within a range, on its steps. */
function stepped(value, [low, high, step]) {
  return clamp(Number((Math.round(value / step) * step).toFixed(6)), low, high);
}

/** A grip for a value of each corner: the longer its stalk to the middle, the larger the value. */
const stalks = (key, range) => handles().map((handle, i) => {
  const [x0, y0, x1, y1] = state.window;
  const [dx, dy] = [(x0 + x1) / 2 - handle.x, (y0 + y1) / 2 - handle.y];
  const far = Math.hypot(dx, dy);
  const [along, up] = far > 0 ? [dx / far, dy / far] : [0, -1];
  const unit = side() / 32;
  const value = handle.members[0][key];
  const long = (value + 1.5) * unit;
  const set = (next) => { setField(handle, key, stepped(next, range)); redraw(); };
  return {
    name: `${key} ${corner(i)}`, says: `${key} ${corner(i)} = ${value}`,
    x: handle.x + along * long, y: handle.y + up * long, from: [handle.x, handle.y],
    place: (x, y) => set(((x - handle.x) * along + (y - handle.y) * up) / unit - 1.5),
    nudge: (right, down, isFine) => set(value + (right - down) * (isFine ? range[2] : 5 * range[2])),
  };
});

function snapAll() {
  const off = state.triangles.flat().filter((c) => [c.x, c.y].some((v) => !Number.isInteger(v * SUB)));
  for (const c of off) Object.assign(c, { x: Math.round(c.x * SUB) / SUB, y: Math.round(c.y * SUB) / SUB });
  if (off.length) forget();
}

const mostSteps = () => last.answer?.lines?.[0]?.length ?? 0;

function stepTo(step) {
  state.step = clamp(step, 0, mostSteps());
  redraw();
}

function playSteps() {
  if (!state.playing) stepTo(0);
  play(250, () => {
    const before = state.step;
    stepTo(before + 1);
    return state.step > before;
  });
}

/** Takes a step again and again, until one is the last, or somebody pauses it. */
function play(milliseconds, step) {
  clearInterval(state.playing);
  const tick = () => { if (!step()) play(); };
  state.playing = state.playing || !step ? 0 : setInterval(tick, milliseconds);
  redraw();
}

/** t against t', as a curve in a square, with the diagonal for comparison. */
function plot(pairs) {
  const path = pairs.map(([screen, space], i) => `${i ? 'L' : 'M'}${(screen * 100).toFixed(2)} ${(100 - space * 100).toFixed(2)}`).join('');
  const line = (d, colour, width) => `<path d="${d}" fill="none" stroke="${colour}" stroke-width="${width}"/>`;
  const name = (text, x, y) => `<text x="${x}" y="${y}" fill="${colours.sample}" font-size="7">${text}</text>`;
  const around = make('div');
  around.innerHTML = `<svg viewBox="-4 -4 108 108" role="img" aria-label="${word('tPlot')}" style="max-width: 14rem">
    ${line('M0 0V100H100', colours.cursor, 0.8)}${line('M0 100L100 0', colours.grid, 1)}${line(path, colours.edge, 2)}${name('t', 2, 5)}${name('t′', 95, 97)}</svg>`;
  return around.firstChild;
}
