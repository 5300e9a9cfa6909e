// Panels: what a scene shows, as the viewer takes it.

const view = $('view');

/** The name that a list of choices, each a value or value and text, has for one of them. */
const labelOf = (choices, value) => choices.map((one) => [one].flat()).find(([is]) => is === value)?.at(-1) ?? value;

/** A panel of a scene is {title | select, says, bad, pixel(i, x, y), outlines, over, view, svg}. */
function panelOf(panel, i, answer) {
  const [x0, y0, x1, y1] = state.window;
  const { title, by, says, bad: isBad, view: of, svg, over } = panel;
  const choose = (name) => { state.by[i] = name; redraw(); };
  const isIn = (x, y) => x >= x0 && y >= y0 && x < x1 && y < y1;
  return {
    key: JSON.stringify([state.scene, title, by, state.lang]),
    head: () => (by ? select(scene().choices(), by, choose, { 'aria-label': `${word('panel')} ${i + 1}` }) : title),
    label: title ?? labelOf(scene().choices(), by),
    says, isBad, view: of, svg, over,
    layers: of || !panel.pixel ? [] : [{ mark: (x, y) => (isIn(x, y) ? panel.pixel((y - y0) * (x1 - x0) + x - x0, x, y) : null) }],
    hasGrid: !of,
    samples: of || scene().noSamples ? null : [0.5, 0.5],
    outlines: panel.outlines ?? answer.outlines ?? [],
  };
}

/** What the viewer shows of an answer. Scenes with handles of their own have a window that stays. */
function shownOf(answer) {
  const isFixed = Boolean(scene().handles);
  return {
    part: state.window, home: isFixed ? state.window : state.own ?? SCENES[state.scene].start.window, bounds: isFixed ? state.window : null,
    title: `${word('title')}: ${word(state.scene)}`, high: 0.8, most: 64, fine: state.lines ? 1 : 1 / SUB,
    panels: scene().panels(answer).map((panel, i) => panelOf(panel, i, answer)),
    grips, cursor: state.px ?? null, hovers: state.hover,
    legend: scene().choices === painters ? ['agrees', 'missing', 'extra', 'twice'].map((kind) => [kind, GLYPHS[kind], word(kind)]) : [],
    onSeen: isFixed ? null : (window) => { state.window = window; keepPixel(); redraw(); },
    onPoint: isFixed ? null : lookAt,
    // A click keeps the pixel, another one lets it follow the mouse again.
    onTap: (type) => { state.hover = type !== 'mouse' || state.hover === false; },
    onHold: (index) => { state.chosen = index; },
  };
}

function lookAt(...px) {
  state.px = px.slice(0, 2);
  redraw();
}

/** Pixels along the longer side of the panels. */
const side = () => Math.max(state.window[2] - state.window[0], state.window[3] - state.window[1]);

function keepPixel() {
  const [x0, y0, x1, y1] = state.window;
  if (state.px) state.px = [clamp(state.px[0], x0, x1 - 1), clamp(state.px[1], y0, y1 - 1)];
}
