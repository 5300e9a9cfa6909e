// The scenes: what each asks the engines, how it colours the answer, what it says about a pixel.
// A scene is {start, ask, panels, look?, tools?, choices?, fields?, breaks?, keeps?, handles?, place?}.

const at = (x, y, more = {}) => ({ x, y, w: 1, depth: 0, u: 0, v: 0, ...more });
const corner = (i) => LETTERS[i % LETTERS.length];
const table = (head, rows) => make('div', { className: 'scroll' }, make('table', {},
  make('thead', {}, make('tr', {}, ...head.map((cell) => make('th', {}, cell)))),
  make('tbody', {}, ...rows.map((row) => make('tr', {}, ...row.map((cell, i) => (
    cell instanceof Node ? make('td', {}, cell) : make('td', { className: i && /^[-\d.]/.test(cell) ? 'number' : '' }, String(cell)))))))));
const round = (value, digits = 4) => (Number.isFinite(value) ? String(Number(value.toFixed(digits))) : '–');
const mix = (value) => Math.round(255 * Math.max(0, Math.min(1, value)));

/** Names with a label, for a panel to choose from. */
function painters() {
  const rules = [['exclusive-edges', word('strict')], ['inclusive-edges', word('inclusive')]];
  const label = (name) => (name === 'edge-function' ? `${name}: ${word('tl')}` : name);
  return [...names.triangles.slice(0, 2).map((e) => [e.name, label(e.name)]), ...rules, ...names.triangles.slice(2).map((e) => [e.name, e.name])];
}

/** A pixel by its hits and what they should be. */
function judged(hits, right) {
  const [is, should] = [Number(hits), Number(right)];
  if (is === 0 && should === 0) return null;
  if (is < should) return { colour: colours.missing, glyph: is ? String(is) : '−' };
  const glyph = is > 1 || state.numbers ? String(is) : '';
  if (is > should) return { colour: is > 1 ? colours.twice : colours.extra, glyph: glyph || '+' };
  return { colour: colours.agrees, glyph };
}

function verdict(panel) {
  if (panel.refused) return { says: `${word('refused')}: ${panel.refused}`, bad: true };
  const wrong = panel.missing + panel.extra > 0;
  const count = panel.covered === undefined ? '' : `${panel.covered} ${word('covered')}: `;
  const says = wrong
    ? [panel.missing && `${panel.missing} ${word('missing')}`, panel.extra && `${panel.extra} ${word('extra')}`].filter(Boolean).join(', ')
    : word('agrees');
  return { says: count + says, bad: wrong };
}

/** Two panels, or four. */
function setFour() {
  const more = ['scanline', 'oracle', 'inclusive-edges', 'games101-strict', 'exclusive-edges'];
  while (state.four && state.by.length < 4) state.by.push(more.find((name) => !state.by.includes(name)) ?? 'oracle');
  if (!state.four) state.by.length = 2;
}

// --- What is said about a pixel ------------------------------------------------------------------

function edgesOf(triangle) {
  return triangle.edges.map((edge) => [
    `${edge.ends.map((end) => corner(end)).join(' ')}`,
    edge.value,
    edge.sign === 0 ? word('onEdge') : word(edge.sign > 0 ? 'inside' : 'outside'),
    word(edge.topLeft ? 'topLeft' : 'notTopLeft'),
  ]);
}

function rulesOf(triangle) {
  const all = (test) => word(triangle.edges.every(test) ? 'yes' : 'no');
  return [
    [word('strict'), all((e) => e.sign > 0)],
    [word('inclusive'), all((e) => e.sign >= 0)],
    [word('tl'), all((e) => e.sign > 0 || (e.sign === 0 && e.topLeft))],
  ];
}

/** Why rules differ here, if they do. */
function reason(triangles) {
  const touching = triangles.filter((t) => t.edges?.every((e) => e.sign >= 0) && t.edges.some((e) => e.sign === 0));
  if (touching.length === 0) return null;
  const strict = triangles.some((t) => t.edges?.every((e) => e.sign > 0));
  const { by } = state;
  const says = [];
  if (by.includes('exclusive-edges') || by.includes('games101-strict')) says.push(strict ? null : word('hole'));
  if ((by.includes('inclusive-edges') || by.includes('sysu-inclusive')) && touching.length > 1) says.push(word('double'));
  if (triangles.some((t) => t.covered)) says.push(word('once'));
  return says.filter(Boolean).map((text) => make('p', { className: 'say' }, text));
}

function aboutPixel() {
  const head = make('h2', {}, `${word('pixel')} ${state.px?.join(', ') ?? ''}`);
  if (!state.snap) return [head, make('p', {}, word('onlyLattice'))];
  if (!last.look) return [head];
  const { triangles } = last.look;
  const near = triangles.map((t, i) => ({ ...t, i })).filter((t) => t.edges?.every((e) => e.sign >= 0));
  const listed = near.length ? near : triangles.slice(0, 1).map((t, i) => ({ ...t, i }));
  const parts = [head, ...(reason(triangles) ?? [])];
  for (const triangle of listed.slice(0, 4)) {
    if (!triangle.edges) { parts.push(make('p', {}, `${word('ofTriangle')} ${triangle.i + 1}: ${word('degenerate')}`)); continue; }
    parts.push(make('p', {}, make('strong', {}, `${word('ofTriangle')} ${triangle.i + 1}`)),
      table([word('edge'), word('value'), '', word('ifOn')], edgesNamed(triangle)),
      make('p', { className: 'quiet' }, `${word('belongs')}: ${rulesOf(triangle).map((rule) => rule.join(': ')).join('; ')}`));
  }
  const walked = listed.find((t) => t.rows.length);
  if (walked) parts.push(walkOf(walked));
  return parts;
}

/** The letters of the handles at the ends of each edge. */
function edgesNamed(triangle) {
  const all = handles();
  const letter = (end) => corner(all.findIndex((handle) => handle.members.includes(state.triangles[triangle.i][end])));
  return edgesOf(triangle).map((row, i) => [triangle.edges[i].ends.map(letter).join(' → '), ...row.slice(1)]);
}

/** The rows of the scanline up to the pixel's, with a button that plays them. */
function walkOf(triangle) {
  const { rows } = triangle;
  const row = rows.findIndex((r) => r.y_px === state.px[1]);
  const first = Math.max(0, Math.min(row < 0 ? 0 : row - 3, rows.length - 5));
  const cell = (step) => [String(step.column), String(step.remainder), step.carries ? '+1' : ''];
  const head = [word('row'), word('longEdge'), word('remainder'), word('carry'), word('shortEdge'), word('remainder'), word('carry')];
  const body = rows.slice(first, first + 6).map((r) => [`${r.y_px === state.px[1] ? '▸ ' : ''}${r.y_px}`, ...cell(r.long), ...cell(r.short)]);
  const here = rows[Math.max(row, 0)];
  const step = (name, walk) => `${word(name)}: + ${walk.step_whole}, − ${walk.step_part} / ${walk.dy}`;
  const steps = `${word('eachRow')} ${step('longEdge', here.long)}; ${step('shortEdge', here.short)}`;
  return make('details', { open: state.walk !== false, ontoggle: (event) => { state.walk = event.target.open; } },
    make('summary', {}, word('walk')),
    button(word(state.playing ? 'pause' : 'play'), playRows, { id: 'play' }), table(head, body), make('p', {}, steps), make('p', { className: 'quiet' }, word('walkNote')));
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

// --- The scenes ----------------------------------------------------------------------------------

const SQUARE = [[at(2.5, 2.5), at(10.5, 2.5), at(10.5, 10.5)], [at(2.5, 10.5), at(2.5, 2.5), at(10.5, 10.5)]];

const SCENES = {
  triangle: {
    start: { window: [0, 0, 14, 14], triangles: SQUARE, by: ['scanline', 'exclusive-edges'], px: [6, 6] },
    choices: painters,
    ask: () => ask({ ask: 'draw', picture: picture(), by: state.by }),
    panels: (answer) => answer.panels.map((panel) => ({
      select: panel.name,
      ...verdict(panel),
      pixel: (i) => (panel.hits ? judged(panel.hits[i], answer.truth[i]) : null),
    })),
    tools: () => [check(word('snap'), 'snap', () => { if (state.snap) snapAll(); }), check(word('numbers'), 'numbers'), check(word('four'), 'four', setFour)],
    look: (answer) => [...aboutPixel(), make('p', { className: 'quiet' }, `${answer.ties ?? 0} ${word('ties')}`)],
    breaks: () => ({ families: [...names.families, ...names.offFamilies], who: painters(), defaults: { by: 'games101-strict', family: 'half-integer' } }),
  },

  line: {
    start: { window: [0, 0, 24, 14], lines: [[[2, 3], [20, 10]]], by: ['dda', 'bresenham'], step: 8 },
    noSamples: false,
    choices: () => names.lines.map((e) => [e.name, e.name]),
    keeps: ['step'],
    ask: () => ask({ ask: 'lines', picture: picture(), by: state.by }),
    panels: (answer) => {
      const key = ([x, y]) => `${x},${y}`;
      const truth = new Set(answer.truth.flat().map(key));
      return answer.panels.map((panel) => {
        const drawn = (panel.pixels ?? []).flat();
        const order = new Map(drawn.slice(0, state.step + 1).map((pixel, i) => [key(pixel), i]));
        const ends = state.lines.map((line) => line.map(([x, y]) => [x + 0.5, y + 0.5]));
        return {
          select: panel.name,
          ...verdict(panel),
          outlines: ends,
          pixel: (i, x, y) => {
            const step = order.get(`${x},${y}`);
            const wanted = truth.has(`${x},${y}`);
            if (step === undefined) return wanted && state.step >= drawn.length - 1 ? { colour: colours.missing, glyph: '−' } : null;
            return { colour: wanted ? colours.agrees : colours.extra, glyph: step === state.step ? '●' : wanted ? '' : '+' };
          },
        };
      });
    },
    tools: () => [
      make('label', { className: 'group' }, `${word('steps')} `, stepper()),
      button('−1', () => stepTo(state.step - 1), { id: 'step-back' }), button('+1', () => stepTo(state.step + 1), { id: 'step-on' }),
      button(word('play'), playSteps, { id: 'play' }), check(word('four'), 'four', () => {
        while (state.four && state.by.length < 4) state.by.push(['oracle', 'book-dda', 'sysu-bresenham', 'dda'].find((name) => !state.by.includes(name)));
        if (!state.four) state.by.length = 2;
      }),
    ],
    look: (answer) => {
      const [line] = answer.lines ?? [];
      if (!line) return [];
      const step = Math.min(state.step, line.length);
      const rise = step * line.rise;
      const length = Math.max(1, line.length);
      const rows = (answer.panels ?? []).map((panel) => [panel.name, (panel.pixels?.[0]?.[step] ?? ['–']).join(', ')]);
      return [
        make('h2', {}, `${word('after')} ${step} ${word('ofSteps')} ${line.length}, ${word('along')} ${line.major}`),
        make('p', {}, `${word('exactHeight')} ${rise} / ${length} = ${round(rise / length)}`),
        table([word('engines'), word('pixel')], rows),
      ];
    },
    breaks: () => ({ families: names.lineFamilies, who: names.lines.map((e) => [e.name, e.name]), defaults: { by: 'book-dda', family: 'line-octants' } }),
  },

  weights: {
    start: {
      window: [0, 0, 16, 16], triangles: [[at(2, 13, { u: 1 }), at(8, 2, { v: 1 }), at(14, 11)]], by: ['edge-function', 'scanline'], px: [7, 8],
    },
    choices: () => ['edge-function', 'scanline', 'oracle', 'book-ch3', 'sysu-weights'].map((name) => [name, name]),
    ask: () => ask({ ask: 'values', picture: picture(), by: state.by }),
    panels: (answer) => answer.panels.map((panel) => ({
      select: panel.name,
      says: panel.refused ?? `${word('worst')}: ${panel.worst[1].toExponential(1)}`,
      bad: panel.refused || panel.worst[1] > 1e-9 ? true : undefined,
      pixel: (i) => {
        const value = panel.values?.[i];
        return value ? { colour: `rgb(${mix(value[1])} ${mix(value[2])} ${mix(1 - value[1] - value[2])})` } : null;
      },
      over: (g, view) => {
        if (!state.px) return;
        const middle = [state.px[0] + 0.5, state.px[1] + 0.5];
        for (const [x, y] of answer.outlines[0]) drawOutline(g, view, [middle, [x, y]], colours.cursor);
      },
    })),
    look: () => {
      const [triangle] = last.look?.triangles ?? [];
      if (!triangle?.edges) return aboutPixel().slice(0, 1);
      const rows = triangle.edges.map((edge, i) => [corner(i), edge.value, round(edge.weight, 6)]);
      return [make('h2', {}, `${word('pixel')} ${state.px.join(', ')}`), table([word('corner'), word('value'), word('weight')], rows),
        ...triangle.values.map((v) => make('p', { className: 'quiet' }, `${v.by}: ${v.values ? v.values.slice(1).map((n) => round(n, 6)).join(', ') : '–'}`))];
    },
  },

  perspective: {
    start: {
      window: [0, 0, 32, 32], by: ['edge-function', 'book-affine'],
      triangles: [[at(2, 29, { w: 1 }), at(12, 4, { w: 4, v: 1 }), at(20, 4, { w: 4, u: 1, v: 1 })], [at(2, 29, { w: 1 }), at(20, 4, { w: 4, u: 1, v: 1 }), at(30, 29, { w: 1, u: 1 })]],
    },
    choices: () => ['edge-function', 'scanline', 'oracle', 'book-affine', 'book-ch11', 'games101-strict', 'games101-depth'].map((name) => [name, name]),
    fields: [field('w', 0.25, 0.01)],
    tools: () => sliders('w', [0.25, 8, 0.25]),
    ask: () => ask({ ask: 'values', picture: picture(), by: state.by }),
    panels: (answer) => answer.panels.map((panel) => ({
      select: panel.name,
      says: panel.refused ?? `${word('worst')}: ${round(panel.worst[1], 3)}`,
      bad: panel.refused || panel.worst[1] > 1e-9 ? true : undefined,
      pixel: (i) => {
        const value = panel.values?.[i];
        if (!value) return null;
        const dark = (Math.floor(value[1] * 4) + Math.floor(value[2] * 4)) % 2 !== 0;
        return { colour: dark ? colours.agrees : colours.extra };
      },
    })),
    look: () => {
      const [a, b] = state.triangles[0];
      const answer = ask({ ask: 'along', w: [a.w, b.w], steps: 64 });
      return [make('h2', {}, word('tPlot')), plot(answer.pairs ?? []), make('p', { className: 'quiet' }, `w = ${a.w}, ${b.w}`)];
    },
  },

  depth: {
    start: {
      window: [0, 0, 28, 28], px: [14, 12],
      triangles: [
        [at(2, 4, { depth: 0.2 }), at(26, 10, { depth: 0.8 }), at(2, 20, { depth: 0.2 })],
        [at(26, 5, { depth: 0.2 }), at(2, 14, { depth: 0.8 }), at(26, 23, { depth: 0.2 })],
      ],
    },
    fields: [field('depth', 0, 0.05)],
    tools: () => sliders('depth', [0, 1, 0.05]),
    ask: () => ask({ ask: 'depth', picture: picture(), by: ['scanline'] }),
    panels: (answer) => ['nearest', 'last'].map((way) => {
      const [drawn] = answer.panels;
      const wrong = [...(drawn.nearest ?? '')].filter((letter, i) => letter !== drawn.last[i]).length;
      return {
        title: word(way), says: way === 'last' ? `${wrong} ${word('wrong')}` : '', bad: way === 'last' ? wrong > 0 : undefined,
        pixel: (i) => (drawn[way]?.[i] === '.' ? null : { colour: colours[drawn[way]?.[i]] ?? colours.agrees }),
      };
    }),
    look: () => {
      const rows = (last.look?.triangles ?? []).map((t, i) => [String(i + 1), t.covered ? round(t.values[0].values[0], 6) : '–']);
      return [make('h2', {}, `${word('pixel')} ${state.px?.join(', ') ?? ''}`), table([word('ofTriangle'), word('depth')], rows)];
    },
  },

  near: {
    start: { window: [0, 0, 32, 32], near: 1, points: [[-0.6, -0.7, 2], [0.7, -0.5, 2], [-0.1, 0.6, 0.4]] },
    keeps: ['near', 'points'],
    noSamples: true,
    handles: () => state.points.map((p) => ({ x: (p[0] + 1) * 16, y: (1 - p[1]) * 16, members: [p] })),
    place: (handle, x, y) => { handle.members[0].splice(0, 2, Math.round((x / 16 - 1) * 100) / 100, Math.round((1 - y / 16) * 100) / 100); },
    fields: [{ key: 'w', step: 0.1, get: (h) => h.members[0][2], set: (h, value) => { h.members[0][2] = value; } }],
    ask: () => ask({ ask: 'near', side_px: 32, corners: state.points, near: state.near }),
    panels: (answer) => answer.panels.map((panel) => ({
      title: word(panel.name),
      says: panel.refused ? `${word('refused')}: ${panel.refused}` : `${panel.outline.length} ${word('polygon')}, ${panel.covered} ${word('covered')}`,
      bad: panel.refused ? true : undefined,
      outlines: panel.outline ? [panel.outline] : [],
      pixel: (i) => (panel.hits?.[i] > 0 ? { colour: colours.agrees } : null),
    })),
    tools: () => [
      slide(word('nearPlane'), state.near, [0.1, 4, 0.1], (value) => { state.near = value; }),
      ...state.points.map((p, i) => slide(`w ${corner(i)}`, p[2], [-2, 4, 0.1], (value) => { p[2] = value; })),
    ],
  },

  samples: {
    start: { window: [0, 0, 16, 16], triangles: [[at(2, 3), at(14, 5), at(5, 14)]] },
    ask: () => ask({ ask: 'samples', picture: picture() }),
    panels: (answer) => answer.panels.map((panel) => ({
      title: panel.name,
      says: `${panel.toldApart} ${word('toldApart')}`,
      pixel: (i) => {
        const count = panel.counts[i];
        if (!count) return null;
        return { colour: `color-mix(in srgb, ${colours.edge} ${(100 * count) / panel.of}%, ${colours.empty})`, ring: count < panel.of, glyph: state.numbers ? String(count) : '' };
      },
    })),
    tools: () => [check(word('numbers'), 'numbers')],
  },

  culling: {
    start: { window: [0, 0, 20, 20], triangles: [[at(2, 3), at(10, 3), at(3, 12)], [at(17, 8), at(9, 17), at(17, 17)]], removes: 'counter-clockwise' },
    keeps: ['removes'],
    ask: () => ask({ ask: 'cull', picture: picture(), removes: state.removes }),
    panels: (answer) => [{
      title: word(state.removes), says: `${answer.covered} ${word('covered')}`,
      pixel: (i) => (answer.hits[i] > 0 ? { colour: colours.agrees } : null),
    }],
    tools: () => {
      const select = make('select', { id: 'removes' }, ...['none', 'clockwise', 'counter-clockwise'].map((value) => make('option', { value }, word(value))));
      select.value = state.removes;
      select.addEventListener('change', () => { state.removes = select.value; redraw(); });
      const turn = (i) => button(`${word('turn')} ${i + 1}`, () => { const t = state.triangles[i]; [t[1], t[2]] = [t[2], t[1]]; redraw(); });
      return [make('label', { className: 'group' }, `${word('cullWhat')} `, select), ...state.triangles.map((_, i) => turn(i))];
    },
    look: (answer) => [table([word('ofTriangle'), '2A', '', ''], (answer.areas ?? []).map((area, i) => [
      String(i + 1), area.twiceArea, word(area.sign > 0 ? 'clockwise' : area.sign < 0 ? 'counter-clockwise' : 'degenerate'), word(area.removed ? 'left' : 'drawn')]))],
  },
};

/** A value of the corners, in the table; at least `low`. */
function field(key, low, step) {
  return { key, step, get: (handle) => handle.members[0][key], set: (handle, value) => setField(handle, key, Math.max(low, value)) };
}

function setField(handle, key, value) {
  for (const member of handle.members) member[key] = value;
}

/** A slider for a value of each corner. */
const sliders = (key, range) => handles().map((handle, i) => (
  slide(`${key} ${corner(i)}`, handle.members[0][key], range, (next) => setField(handles()[i], key, next))));

function snapAll() {
  for (const c of state.triangles.flat()) Object.assign(c, { x: Math.round(c.x * SUB) / SUB, y: Math.round(c.y * SUB) / SUB });
}

function stepper() {
  const range = make('input', { type: 'range', id: 'step', min: 0, max: 64, value: state.step });
  range.addEventListener('input', () => stepTo(Number(range.value)));
  return range;
}

function stepTo(step) {
  const most = last.answer?.lines?.[0]?.length ?? 0;
  state.step = Math.max(0, Math.min(step, most));
  if ($('step')) Object.assign($('step'), { max: most, value: state.step });
  redraw();
}

function playSteps() {
  clearInterval(state.playing);
  stepTo(0);
  state.playing = setInterval(() => {
    const before = state.step;
    if (state.scene === 'line') stepTo(state.step + 1);
    if (state.scene !== 'line' || state.step === before) clearInterval(state.playing);
  }, 250);
}

/** t against t', as a curve in a square, with the diagonal for comparison. */
function plot(pairs) {
  const path = pairs.map(([screen, space], i) => `${i ? 'L' : 'M'}${(screen * 100).toFixed(2)} ${(100 - space * 100).toFixed(2)}`).join('');
  const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
  svg.setAttribute('viewBox', '-4 -4 108 108');
  svg.setAttribute('role', 'img');
  svg.setAttribute('aria-label', word('tPlot'));
  svg.style.maxWidth = '14rem';
  const line = (d, colour, width) => {
    const element = document.createElementNS('http://www.w3.org/2000/svg', 'path');
    for (const [name, value] of Object.entries({ d, fill: 'none', stroke: colour, 'stroke-width': width })) element.setAttribute(name, value);
    svg.append(element);
  };
  line('M0 0V100H100', colours.cursor, 0.8);
  line('M0 100L100 0', colours.grid, 1);
  line(path, colours.edge, 2);
  return svg;
}
