// Checks of the viewer, which tests/pages/quick/view.mjs runs in a browser: each is a sentence with what makes it true, and throws where it is not.
import { make } from './dom.js';
import { colours } from './paint.js';

const is = (got, wanted) => { if (JSON.stringify(got) !== JSON.stringify(wanted)) throw new Error(`${JSON.stringify(got)} is not ${JSON.stringify(wanted)}`); };
const near = (got, wanted, by) => { if (!(Math.abs(got - wanted) <= by)) throw new Error(`${got} is not ${wanted}`); };

/** A viewer of 20 x 10 pixels, of which one is missing, and a grip. */
function fresh(more = {}) {
  document.body.replaceChildren();
  const view = document.body.appendChild(make('rp-view'));
  const said = [];
  const grip = { name: 'A', x: 5, y: 5, place: (x, y) => { Object.assign(grip, { x, y }); view.show(view.source); } };
  const mark = (x, y) => (x === 3 && y === 2 ? { fill: 'missing', glyph: '\u2212' } : null);
  const panel = (key) => ({ key, label: key, layers: [{ mark }], samples: [0.5, 0.5], outlines: [[[1, 1], [9, 1], [9, 9]]] });
  view.show({
    part: [0, 0, 20, 10], bounds: [0, 0, 20, 10], numbers: true, panels: ['drawn', 'expected', 'difference'].map(panel), grips: () => [grip],
    cursor: null, onPoint: (x, y, byKeys) => { said.push([x, y, byKeys]); view.show({ ...view.source, cursor: [x, y] }); }, ...more,
  });
  return { view, said, grip };
}

const key = (target, name, more = {}) => target.dispatchEvent(new KeyboardEvent('keydown', { key: name, bubbles: true, cancelable: true, ...more }));
/** A pointer at a place of the first panel, in pixels of the picture. */
function pointer(view, kind, [x, y], more = {}) {
  const { frame, canvas } = view.shown[0];
  const box = canvas.getBoundingClientRect();
  // There is no such pointer to capture.
  frame.setPointerCapture = () => {};
  const [clientX, clientY] = [box.left + (x - view.seen[0]) * view.unit, box.top + (y - view.seen[1]) * view.unit];
  (more.target ?? canvas).dispatchEvent(new PointerEvent(kind, { clientX, clientY, pointerId: 1, pointerType: 'mouse', bubbles: true, ...more }));
}
const colourAt = ({ canvas }, x, y) => `rgb(${[...canvas.getContext('2d').getImageData(x, y, 1, 1).data.slice(0, 3)].join(', ')})`;
const sizes = (view) => view.shown.map(({ canvas }) => [canvas.clientWidth, canvas.clientHeight]);
const frames = () => new Promise((done) => { requestAnimationFrame(() => requestAnimationFrame(done)); });

const CHECKS = {
  'panels stand side by side at one scale, and fit': () => {
    const { view } = fresh();
    is(new Set(sizes(view).map(String)).size, 1);
    near(sizes(view)[0][0] / sizes(view)[0][1], 2, 0.02);
    for (const { frame } of view.shown) if (frame.getBoundingClientRect().right > innerWidth) throw new Error('a panel is cut');
    is(colourAt(view.shown[1], ...[3.2, 2.8].map((at) => Math.round(at * view.unit))), colours.missing);
  },
  'panels much wider than high stand below one another': () => {
    const { view } = fresh({ part: [0, 0, 20, 2], bounds: [0, 0, 20, 2], high: 0.4 });
    const lefts = new Set(view.shown.map(({ frame }) => frame.getBoundingClientRect().left));
    is([lefts.size, view.unit > 40], [1, true]);
  },
  'another part is fitted, the same one keeps the zoom': () => {
    const { view } = fresh();
    view.zoom(-1);
    const zoomed = [...view.seen];
    view.show({ ...view.source });
    is(view.seen, zoomed);
    view.show({ ...view.source, part: [2, 2, 8, 6] });
    is(view.seen, [2, 2, 8, 6]);
    view.show({ ...view.source, part: [3, 2, 9, 6] });
    is(view.seen, [3, 2, 9, 6]);
  },
  'zoom changes no size of a panel, stays inside, and goes back': () => {
    const { view } = fresh();
    const before = sizes(view);
    for (let i = 0; i < 3; i += 1) view.zoom(-1, [19, 9]);
    near(view.seen[2] - view.seen[0], 8, 1e-9);
    is(view.seen[2] <= 20 && view.seen[3] <= 10, true);
    is(sizes(view), before);
    view.fit();
    is(view.seen, [0, 0, 20, 10]);
    view.zoom(1);
    is(view.seen, [0, 0, 20, 10]);
  },
  'it is fitted anew when the room changes': async () => {
    const { view } = fresh();
    const [[before]] = sizes(view);
    document.body.style.width = '400px';
    for (let i = 0; i < 2; i += 1) await frames();
    is(sizes(view)[0][0] < before, true);
    document.body.style.width = '';
  },
  'an endless plane is seen in whole pixels, which are asked for': () => {
    const asked = [];
    const { view } = fresh({ bounds: null, onSeen: (window) => asked.push(window) });
    view.pan(0.6, -3.2);
    view.zoom(-1);
    is(asked, [[1, -3, 21, 7], [3, -2, 19, 6]]);
  },
  'keys go from pixel to pixel, and the page around does not get them': () => {
    const { view, said } = fresh({ cursor: [4, 4] });
    let heard = 0;
    addEventListener('keydown', () => { heard += 1; }, { once: true });
    key(view.shown[0].canvas, 'ArrowRight');
    key(view.shown[0].canvas, 'ArrowDown', { shiftKey: true });
    is(said, [[5, 4, true], [5, 9, true]]);
    is(heard, 0);
  },
  'the keyboard takes what is seen along': () => {
    const { view } = fresh({ cursor: [10, 5] });
    for (let i = 0; i < 4; i += 1) view.zoom(-1);
    for (let i = 0; i < 8; i += 1) key(view.shown[0].canvas, 'ArrowRight');
    is(view.source.cursor, [18, 5]);
    is(view.seen[2] >= 19, true);
  },
  'the mouse points, and drags what is seen': () => {
    const { view, said } = fresh();
    pointer(view, 'pointermove', [7.5, 3.5]);
    is(said, [[7, 3, false]]);
    view.zoom(-1);
    const before = view.seen[0];
    pointer(view, 'pointerdown', [9, 5]);
    pointer(view, 'pointermove', [7, 5]);
    pointer(view, 'pointerup', [7, 5]);
    near(view.seen[0], Math.min(4, before + 2), 0.05);
  },
  'a grip follows the mouse, keys move it by one and finely, and it says where it is': async () => {
    const { view, grip } = fresh({ fine: 1 / 256 });
    const [target] = view.shown[0].grips;
    pointer(view, 'pointerdown', [5, 5], { target });
    pointer(view, 'pointermove', [8, 6]);
    pointer(view, 'pointerup', [8, 6]);
    near(grip.x, 8, 0.05);
    const { x, y } = grip;
    key(target, 'ArrowRight');
    key(target, 'ArrowUp', { shiftKey: true });
    is([grip.x, grip.y], [x + 1, y - 1 / 256]);
    const said = () => [target.getAttribute('aria-label'), target.getAttribute('aria-valuetext')];
    // It is said when frames leave time for it.
    for (let i = 0; i < 200 && said()[1] !== `${grip.x}, ${grip.y}`; i += 1) await frames();
    is(said(), ['A', `${grip.x}, ${grip.y}`]);
    // The keyboard stops at it once, though three panels show it.
    is(view.querySelectorAll('.knob[tabindex="0"]').length, 1);
  },
  'two fingers zoom about the spot between them': () => {
    const { view } = fresh();
    const finger = (kind, pointerId, at) => pointer(view, kind, at, { pointerId, pointerType: 'touch' });
    finger('pointerdown', 1, [9, 5]);
    finger('pointerdown', 2, [11, 5]);
    finger('pointermove', 2, [13, 5]);
    near(view.seen[2] - view.seen[0], 10, 0.2);
    near((10 - view.seen[0]) / (view.seen[2] - view.seen[0]), 0.5, 0.05);
    finger('pointerup', 1, [9, 5]);
    finger('pointerup', 2, [13, 5]);
  },
  'the wheel is the page\u2019s until the picture has the focus': () => {
    const { view } = fresh();
    const wheel = () => !view.shown[0].canvas.dispatchEvent(new WheelEvent('wheel', { deltaY: -1, bubbles: true, cancelable: true }));
    is(wheel(), false);
    view.shown[0].canvas.focus();
    is(wheel(), true);
    is(view.seen[2] - view.seen[0] < 20, true);
  },
  'it fills the window, and Escape brings it back': () => {
    const { view } = fresh({ panels: [{ key: 'one', label: 'one', layers: [] }], high: 0.3 });
    const before = sizes(view)[0][1];
    view.querySelector('[data-tool=enlarge]').click();
    const { top, left, width } = view.getBoundingClientRect();
    is([top, left, width], [0, 0, document.documentElement.clientWidth]);
    is(sizes(view)[0][1] > 1.5 * before, true);
    key(view, 'Escape');
    is([view.classList.contains('is-wide'), sizes(view)[0][1]], [false, before]);
  },
  'a wrong pixel that is smaller than one of the screen is seen': () => {
    const mark = (x, y) => (x === 777 && y === 333 ? { fill: 'missing' } : null);
    const box = [0, 0, 4000, 1000];
    const { view } = fresh({ part: box, bounds: box, panels: [{ key: 'far', label: 'far', layers: [{ mark }] }] });
    is(view.unit < 0.5, true);
    is(colourAt(view.shown[0], Math.round(777 * view.unit), Math.round(333 * view.unit)), colours.missing);
  },
  'every tool has a name, in both languages': () => {
    for (const lang of ['en', 'zh-CN']) {
      document.documentElement.lang = lang;
      const { view } = fresh();
      for (const tool of view.tools.querySelectorAll('button')) if (!(tool.ariaLabel ?? tool.textContent)) throw new Error(`${lang}: a tool without a name`);
      is(/[\u4e00-\u9fff]/.test(view.tools.textContent), lang !== 'en');
    }
    document.documentElement.lang = 'en';
  },
  'what is saved has the panels, their captions and the legend': () => {
    const { view } = fresh({ title: 'T', about: 'about', legend: [['missing', '\u2212', 'missing']] });
    const picture = view.picture();
    is(picture.width > 2 * 3 * sizes(view)[0][0], true);
    const { data } = picture.getContext('2d').getImageData(0, 0, picture.width, picture.height);
    const reds = data.filter((byte, i) => i % 4 === 0 && `rgb(${byte}, ${data[i + 1]}, ${data[i + 2]})` === colours.missing).length;
    is(reds > 500, true);
  },
};

/** The sentences that are not true, each with why. */
globalThis.failing = async () => {
  const wrong = [];
  for (const [sentence, check] of Object.entries(CHECKS)) {
    try {
      await check();
    } catch (error) {
      wrong.push(`${sentence}: ${error.message}`);
    }
  }
  return { count: Object.keys(CHECKS).length, wrong };
};
