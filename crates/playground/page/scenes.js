// The scenes: what each asks the engines, how it colours the answer, what it says about a pixel.
// A scene is {start, ask, panels, look?, tools?, choices?, fields?, breaks?, keeps?, handles?, place?, grips?, values?, unsnapped?}.

/** The ranges of values that are dragged: lowest, highest, step. */
const RANGE_OF_W = [0.25, 8, 0.05];
const RANGE_BEHIND = [-2, 4, 0.1];
const RANGE_OF_NEAR = [0.1, 4, 0.1];
/** The near plane from the side: w to the right, and up. The rays to one place on the screen run straight to the eye. */
const aside = (w, y = 0) => [((w + 2) / 6) * side(), (0.5 - (y * Math.abs(w)) / 8) * side()];
const asideW = (x) => (x / side()) * 6 - 2;

/** Eye, field of view, near plane and triangle from the side; what is cut away is shaded. */
function fromTheSide() {
  return {
    title: word('side'), says: `w ≥ ${state.near}`, view: 'side',
    outlines: [state.points.map((p) => aside(p[2], p[1]))],
    over: (sheet) => {
      const [near] = aside(state.near);
      for (const way of [1, -1]) paintOutline(sheet, [aside(0), aside(4, way)], colours.grid);
      paintOutline(sheet, [[aside(0)[0], 0], [aside(0)[0], side()]], colours.grid);
      paintOutline(sheet, [[near, 0], [near, side()]], colours.missing);
      const { g } = sheet;
      g.globalAlpha = 0.15;
      g.fillStyle = colours.missing;
      const [right, below] = placed(sheet, [near, side()]);
      g.fillRect(0, 0, right, below);
      g.globalAlpha = 1;
      g.fillStyle = colours.sample;
      g.textAlign = 'left';
      g.textBaseline = 'middle';
      g.font = '12px system-ui, sans-serif';
      const [x, y] = placed(sheet, aside(0, 0));
      g.fillText(word('eye'), x + 4, y - 0.4 * below);
    },
  };
}

/** The scanline engine or the DDA, or who takes the place of either: rules too, but no specimens. */
function drawers() {
  const [triangles, lines] = [names.triangles, names.lines].map((all) => all.filter(({ specimen }) => !specimen).map(({ name }) => name));
  return [...new Set([...triangles.slice(0, 2), 'exclusive-edges', 'inclusive-edges', ...triangles.slice(2), ...lines])];
}

/** Panels of values against the exact ones; `fillOf` colours a value. */
const valuePanels = (answer, digitsOf, fillOf, more = {}) => answer.panels.map(({ name, refused, worst, values }) => ({
  by: name,
  says: refused ?? `${word('worst')} ${digitsOf(worst[1])}`,
  bad: refused || worst[1] > 1e-9 ? true : undefined,
  pixel: (i) => (values?.[i] ? { fill: fillOf(values[i]) } : null),
  ...more,
}));

const SCENES = {
  triangle: {
    start: { window: [0, 0, 14, 14], triangles: SQUARE, by: ['scanline', 'exclusive-edges'], px: [6, 6], difference: false },
    choices: painters,
    unsnapped: true,
    ask: () => ask({ ask: 'draw', picture: picture(), by: state.by }),
    keeps: ['difference'],
    panels: (answer) => [...answer.panels.map((panel) => ({
      by: panel.name,
      ...verdict(panel),
      pixel: (i) => (panel.hits ? judged(panel.hits[i], answer.truth[i]) : null),
    })), ...(state.difference ? [difference(answer)] : [])],
    tools: () => [rules(), shapes(), make('span', { className: 'boxes' }, check(word('snap'), 'snap', () => { if (state.snap) snapAll(); }), check(word('numbers'), 'numbers'), four('scanline', 'oracle', 'inclusive-edges', 'games101-strict', 'exclusive-edges'), check(word('difference'), 'difference'))],
    look: (answer) => [...aboutPixel(), make('p', { className: 'quiet' }, `${word('ties')} ${answer.ties ?? 0}`)],
    breaks: () => ({ families: [...names.families, ...names.offFamilies], who: painters(), defaults: { by: 'games101-strict', family: 'half-integer' } }),
  },

  line: {
    start: { window: [0, 0, 24, 14], lines: [[[2, 3], [20, 10]]], by: ['dda', 'bresenham'], step: 8 },
    noSamples: false,
    choices: () => names.lines.map(({ name }) => name),
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
          by: panel.name,
          ...verdict(panel),
          outlines: ends,
          pixel: (i, x, y) => {
            const step = order.get(`${x},${y}`);
            const wanted = truth.has(`${x},${y}`);
            if (step === undefined) return wanted && state.step >= drawn.length - 1 ? { fill: 'missing', glyph: '−' } : null;
            return { fill: wanted ? 'agrees' : 'extra', glyph: step === state.step ? '●' : wanted ? '' : '+' };
          },
        };
      });
    },
    tools: () => [
      slide(word('steps'), () => Math.min(state.step, mostSteps()), [0, mostSteps, 1], stepTo),
      button('−1', () => stepTo(state.step - 1), { id: 'step-back', 'aria-label': `${word('steps')} −1` }),
      button('+1', () => stepTo(state.step + 1), { id: 'step-on', 'aria-label': `${word('steps')} +1` }),
      button(word('play'), playSteps, { id: 'play' }), four('oracle', 'book-dda', 'sysu-bresenham', 'dda'),
    ],
    look: (answer) => {
      const [line] = answer.lines ?? [];
      if (!line) return [];
      const step = Math.min(state.step, line.length);
      const rise = step * line.rise;
      const length = Math.max(1, line.length);
      const rows = (answer.panels ?? []).map((panel) => [panel.name, (panel.pixels?.[0]?.[step] ?? ['–']).join(', ')]);
      const whole = Math.floor(rise / length);
      const part = rise - whole * length;
      const half = part === 0 ? 'exact' : 2 * part < length ? 'lower' : 2 * part > length ? 'upper' : 'halfway';
      return [
        make('h2', {}, `${word('after')} ${step} ${word('ofSteps')} ${line.length}, ${word('along')} ${line.major}`),
        make('p', {}, `${word('exactHeight')} ${rise} / ${length} = ${whole} + ${part} / ${length}: ${word(half)}`),
        table([word('engines'), word('pixel')], rows),
      ];
    },
    breaks: () => ({ families: names.lineFamilies, who: names.lines.map(({ name }) => name), defaults: { by: 'book-dda', family: 'line-octants' } }),
  },

  weights: {
    start: {
      window: [0, 0, 16, 16], triangles: [[at(2, 13, { u: 1 }), at(8, 2, { v: 1 }), at(14, 11)]], by: ['edge-function', 'scanline'], px: [7, 8],
    },
    values: true,
    choices: () => ['edge-function', 'scanline', 'oracle', 'book-ch3', 'sysu-weights'],
    ask: () => ask({ ask: 'values', picture: picture(), by: state.by }),
    panels: (answer) => valuePanels(answer, (worst) => (worst ? worst.toExponential(1) : 0), ([, u, v]) => `rgb(${mix(u)} ${mix(v)} ${mix(1 - u - v)})`, {
      over: (sheet) => {
        if (!state.px) return;
        const middle = [state.px[0] + 0.5, state.px[1] + 0.5];
        for (const corner of answer.outlines[0]) paintOutline(sheet, [middle, corner], colours.cursor);
      },
    }),
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
    values: true,
    choices: () => ['edge-function', 'scanline', 'oracle', 'book-affine', 'book-ch11', 'games101-strict', 'games101-depth'],
    fields: [field('w', 0.25, 0.01)],
    tools: () => sliders('w', RANGE_OF_W),
    grips: () => stalks('w', RANGE_OF_W),
    ask: () => ask({ ask: 'values', picture: picture(), by: state.by }),
    panels: (answer) => valuePanels(answer, (worst) => round(worst, 3), ([, u, v]) => {
      const isDark = (Math.floor(u * 4 + 1e-9) + Math.floor(v * 4 + 1e-9)) % 2 !== 0;
      return isDark ? 'agrees' : 'extra';
    }),
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
    values: true,
    fields: [field('depth', 0, 0.05)],
    tools: () => sliders('depth', [0, 1, 0.05]),
    ask: () => ask({ ask: 'depth', picture: picture(), by: ['scanline'] }),
    panels: (answer) => ['nearest', 'last'].map((way) => {
      const [drawn] = answer.panels;
      const wrong = [...(drawn.nearest ?? '')].filter((letter, i) => letter !== drawn.last[i]).length;
      return {
        title: word(way), says: way === 'last' ? `${wrong} ${word('wrong')}` : '', bad: way === 'last' ? wrong > 0 : undefined,
        pixel: (i) => (drawn[way]?.[i] === '.' ? null : { fill: 'abcd'.includes(drawn[way]?.[i]) ? drawn[way][i] : 'agrees' }),
      };
    }),
    look: () => {
      const rows = (last.look?.triangles ?? []).map((t, i) => [String(i + 1), t.covered ? round(t.values[0].values[0], 6) : '–']);
      return [make('h2', {}, `${word('pixel')} ${state.px?.join(', ') ?? ''}`), table([word('ofTriangle'), word('depth')], rows)];
    },
  },

  near: {
    start: { window: [0, 0, 32, 32], near: 1, points: [[-0.7, -0.3, 2], [0.7, -0.1, 2], [-0.1, 0.9, 0.4]] },
    keeps: ['near', 'points'],
    noSamples: true,
    handles: () => state.points.map((p) => ({ x: Number(round(((p[0] + 1) / 2) * side(), 6)), y: Number(round(((1 - p[1]) / 2) * side(), 6)), members: [p] })),
    place: (handle, x, y) => { handle.members[0].splice(0, 2, Math.round(((2 * x) / side() - 1) * 100) / 100, Math.round((1 - (2 * y) / side()) * 100) / 100); },
    fields: [{ key: 'w', step: 0.1, get: (h) => h.members[0][2], set: (h, value) => { h.members[0][2] = value; } }],
    grips: () => {
      const grip = (name, value, [x, y], range, set) => {
        const to = (next) => { set(stepped(next, range)); redraw(); };
        return {
          view: 'side', name, says: `${name} = ${value}`, x, y,
          place: (at) => to(asideW(at)), nudge: (right, down, isFine) => to(value + (right - down) * (isFine ? 1 : 5) * range[2]),
        };
      };
      return [
        ...state.points.map((p, i) => grip(`w ${corner(i)}`, p[2], aside(p[2], p[1]), RANGE_BEHIND, (w) => { p[2] = w; })),
        grip(word('plane'), state.near, [aside(state.near)[0], 0.94 * side()], RANGE_OF_NEAR, (w) => { state.near = w; }),
      ];
    },
    ask: () => ask({ ask: 'near', side_px: side(), corners: state.points, near: state.near }),
    panels: (answer) => [fromTheSide(), ...answer.panels.map((panel) => ({
      title: word(panel.name),
      says: panel.refused ? `${word('refused')}: ${panel.refused}` : `${panel.outline.length} ${word('polygon')}, ${panel.covered} ${word('covered')}`,
      bad: panel.refused ? true : undefined,
      outlines: panel.outline ? [panel.outline] : [],
      pixel: (i) => (panel.hits?.[i] > 0 ? { fill: 'agrees' } : null),
    }))],
    tools: () => [
      slide(word('nearPlane'), () => state.near, RANGE_OF_NEAR, (value) => { state.near = value; }),
      ...state.points.map((p, i) => slide(`w ${corner(i)}`, () => p[2], RANGE_BEHIND, (value) => { p[2] = value; })),
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
        return { fill: `color-mix(in srgb, ${colours.edge} ${(100 * count) / panel.of}%, ${colours.empty})`, ring: count < panel.of, glyph: state.numbers ? String(count) : '' };
      },
    })),
    tools: () => [check(word('numbers'), 'numbers')],
  },

  culling: {
    start: { window: [0, 0, 20, 20], triangles: [[at(2, 3), at(10, 3), at(3, 12)], [at(17, 8), at(9, 17), at(17, 17)]], removes: 'counter-clockwise' },
    keeps: ['removes'],
    ask: () => ask({ ask: 'cull', picture: picture(), removes: state.removes }),
    panels: (answer) => [{
      title: `${word('cullWhat')}: ${word(state.removes)}`, says: `${answer.covered} ${word('covered')}`,
      pixel: (i) => (answer.hits[i] > 0 ? { fill: 'agrees' } : null),
    }],
    tools: () => {
      const ways = ['none', 'clockwise', 'counter-clockwise'].map((way) => [way, word(way)]);
      const removes = select(ways, state.removes, (way) => { state.removes = way; redraw(); }, { id: 'removes' });
      const turn = (i) => button(`${word('turn')} ${i + 1}`, () => { const t = state.triangles[i]; [t[1], t[2]] = [t[2], t[1]]; redraw(); });
      return [make('label', { className: 'group' }, `${word('cullWhat')} `, removes), ...state.triangles.map((_, i) => turn(i))];
    },
    look: (answer) => [make('h2', {}, word('culling')), table([word('ofTriangle'), '2A', word('winding'), word('result')], (answer.areas ?? []).map((area, i) => [
      String(i + 1), area.twiceArea, word(area.sign > 0 ? 'clockwise' : area.sign < 0 ? 'counter-clockwise' : 'degenerate'), word(area.removed ? 'removed' : 'drawn')]))],
  },

  figure: {
    start: { window: [0, 0, 360, 240], figure: 'one-sample', at: '[]', by: ['scanline', 'oracle'] },
    keeps: ['figure', 'at'],
    choices: drawers,
    noSamples: true,
    handles: () => [],
    ask: () => {
      const isDark = matchMedia('(prefers-color-scheme: dark)').matches;
      const panels = state.by.map((by) => ask({
        ask: 'figure', name: state.figure, language: state.lang, at: JSON.parse(state.at), is_answered: true, is_dark: isDark, by,
      }));
      const error = panels.find((panel) => panel.error);
      if (error) return error;
      state.at = JSON.stringify(panels[0].at);
      state.window = panels[0].svg.match(/viewBox="([^"]*)"/)[1].split(' ').map(Number);
      return { ...panels[0], panels };
    },
    panels: ({ panels }) => panels.map(({ svg }, i) => ({
      by: state.by[i], view: 'sheet',
      says: i ? word(svg === panels[0].svg ? 'samePicture' : 'otherPicture') : '',
      bad: i ? svg !== panels[0].svg : undefined,
      svg,
      outlines: [],
    })),
    grips: () => figureGrips(last.answer?.svg ? last.answer.grips : [], (i, value) => {
      state.at = JSON.stringify(JSON.parse(state.at).map((old, k) => (k === i ? value : old)));
      redraw();
    }),
    tools: () => {
      const figures = names.figures.map(({ name, zh, about: en }) => [name, state.lang === 'zh' ? zh : en]);
      const choose = (figure) => { Object.assign(state, { figure, at: '[]', chosen: 0 }); redraw(); };
      return [make('label', { className: 'group' }, `${word('figure')} `, select(figures, state.figure, choose, { id: 'figure' }))];
    },
    look: ({ title, question, answer }) => [make('h2', {}, title), make('p', {}, question), make('p', { className: 'say' }, answer)],
  },
};
