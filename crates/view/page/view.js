// <rp-view>: panels of pixels side by side at one scale, with zoom, panning, keys, fingers, grips to drag, and a size as large as the window.
//
// A page calls show() with what there is to see, as often as that changes:
//   part      [x0, y0, x1, y1], what is shown at first and after `fit`; another part is fitted anew
//   bounds    the whole picture. Without it the plane is endless, is shown in whole pixels, and the viewer calls `onSeen` with what it shows
//   panels    {key, head, says, isBad, label, view, layers, samples, outlines, corners, over, svg}, see paintPanel
//   grips()   what can be dragged, each {name, says, x, y, view, place, nudge} where it is now, on the panels of a view; `from` draws a stalk
//   cursor    the pixel that is looked at; the viewer calls onPoint(x, y, byKeys) for another one, and onHold(i) when a grip is taken
//   covers    elements over the picture, each {element, x, y, width, height}
//   legend    [fill, glyph, text] of each colour
//   title     the name of a saved picture, with `about` below it
//   high      the largest share of the window's height; `most` and `least`, the largest and the smallest pixel: of a part that needs smaller ones
//             what lies about the cursor is shown at first
import { arrowOf, become, button, clamp, fill, make, mark, paced, pageLanguage, say, whenIdle } from './dom.js';
import { AXIS_HIGH, axisWide, colours, contextOf, paintCorners, paintCursor, paintGrid, paintImage, paintMarks, paintNumbers, paintOutline, paintSamples, readColours } from './paint.js';

/** Pixels along the longer side, from the nearest view to the farthest. */
const SIDES = [4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256, 384, 512, 768, 1024, 1536, 2048, 3072, 4096, 8192, 16384];

/** Pixels along the longer side of an endless plane at most. */
export const FARTHEST_PX = 128;

const VIEW_WORDS = {
  en: {
    tools: 'Zoom', zoomOut: 'Zoom out', zoomIn: 'Zoom in', fit: 'fit', enlarge: 'As large as the window', back: 'As large as before', save: 'save',
    keys: 'Keys on a picture: arrows go from pixel to pixel, with Shift by eight, with Alt they move what is seen; + and \u2212 zoom, 0 fits, f fills the window, Esc leaves it. On a grip arrows move it, with Shift finely. Two fingers zoom, a drag moves what is seen, and the wheel zooms once the picture was clicked.',
  },
  zh: {
    tools: '缩放', zoomOut: '缩小', zoomIn: '放大', fit: '适合', enlarge: '占满窗口', back: '恢复大小', save: '保存',
    keys: '画面上的按键：方向键逐像素移动，加 Shift 移动八个像素，加 Alt 平移画面；+ 和 − 缩放，0 恢复适合的大小，f 占满窗口，Esc 退出。在拖动点上，方向键移动它，加 Shift 移动得更细。双指缩放，拖动则平移；点过画面之后，滚轮也可缩放。',
  },
};
export const viewWords = () => VIEW_WORDS[pageLanguage()];

/** How long what is said stays, at least. */
const TELLS_MS = 100;
/** How long a frame of a drag paints panels, at most, and at least one of them. */
const DRAGGED_MS = 3;

const sideOf = ([x0, y0, x1, y1]) => Math.max(x1 - x0, y1 - y0);

class View extends HTMLElement {
  connectedCallback() {
    if (this.body) return;
    Object.assign(this, { shown: [], seen: null, source: null, laidOut: '', isWide: false, isHeld: false, waiting: new Set(), tellSoon: paced(() => this.tell(), TELLS_MS) });
    const act = (word, label, then) => button(label, then, { 'data-tool': word });
    this.scale = make('output', { 'aria-live': 'off' });
    this.larger = act('enlarge', '\u2922', () => this.enlarge());
    this.tools = make('div', { className: 'view-tools', role: 'toolbar' },
      act('zoomOut', '\u2212', () => this.zoom(1)), act('fit', '', () => this.fit()), act('zoomIn', '+', () => this.zoom(-1)), this.larger, act('save', '', () => this.save()), this.scale);
    this.body = make('div', { className: 'panels' });
    this.legend = make('ul', { className: 'legend' });
    this.append(this.tools, this.body, this.legend);
    this.speak();
    // All views of a page have the same colours.
    if (!colours.empty) readColours(this);
    new ResizeObserver(() => this.resized()).observe(this.body);
    addEventListener('resize', () => this.resized());
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => { readColours(this); this.resized(); });
    this.addEventListener('keydown', (event) => { if (event.key === 'Escape' && this.isWide) this.enlarge(); });
    this.addEventListener('wheel', (event) => {
      const panel = this.shown.find(({ frame }) => frame.contains(event.target));
      if (!panel || !(event.ctrlKey || panel.frame.contains(document.activeElement))) return;
      event.preventDefault();
      this.zoom(event.deltaY > 0 ? 1 : -1, this.at(panel.frame.getBoundingClientRect(), event));
    }, { passive: false });
  }

  /** The words of the tools, in the language of the page. */
  speak() {
    const words = viewWords();
    this.tools.setAttribute('aria-label', words.tools);
    for (const made of this.tools.querySelectorAll('[data-tool]')) {
      const word = made === this.larger && this.isWide ? 'back' : made.dataset.tool;
      if (word === 'fit' || word === 'save') made.textContent = words[word];
      else Object.assign(made, { title: words[word], ariaLabel: words[word] });
    }
  }

  show(source) {
    const isOther = String(source.part) !== String(this.source?.part) || String(source.bounds) !== String(this.source?.bounds);
    this.source = source;
    if (isOther) this.seen = null;
    const { panels } = source;
    while (this.shown.length > panels.length) this.shown.pop().figure.remove();
    panels.forEach((panel, i) => {
      this.shown[i] ??= this.newPanel();
      this.caption(this.shown[i], panel);
    });
    Object.assign(this.body.dataset, { count: panels.length });
    const legend = JSON.stringify(source.legend ?? []);
    if (this.legend.dataset.shows !== legend) {
      this.legend.dataset.shows = legend;
      fill(this.legend, ...(source.legend ?? []).map(([colour, glyph, text]) => (
        make('li', {}, make('span', { className: `px-${colour}`, style: colours[colour] ? '' : `background: ${colour}`, 'aria-hidden': 'true' }, glyph), text))));
    }
    this.layOut();
    this.paint();
  }

  newPanel() {
    const panel = { caption: make('figcaption'), above: make('canvas', { className: 'above' }), beside: make('canvas', { className: 'beside' }), grips: [], key: null };
    panel.canvas = make('canvas', { className: 'pixels', tabIndex: 0, role: 'application' });
    panel.frame = make('div', { className: 'frame' }, panel.canvas);
    panel.figure = make('figure', { className: 'panel' }, panel.caption, panel.above, panel.beside, panel.frame);
    for (const axis of [panel.above, panel.beside]) axis.setAttribute('aria-hidden', 'true');
    this.body.append(panel.figure);
    this.listen(panel);
    return panel;
  }

  /** What stands above a panel: its head is made anew only when it is another one. */
  caption(shown, panel) {
    shown.of = panel;
    if (shown.key === panel.key) return;
    shown.key = panel.key;
    // What it says is said once, by the live region of the page.
    shown.says = make('output', { 'aria-live': 'off' }, panel.says);
    fill(shown.caption, panel.head?.() ?? panel.label, shown.says);
  }

  /** What is said of the picture, in captions, of grips, and to who does not see it: the page is laid out anew for that, so it follows a drag some times a second. */
  tell() {
    say(this.scale, this.source.isPicture ? `${Math.round(100 * this.unit)}%` : `${Math.round(this.unit * 10) / 10} : 1`);
    const grips = this.grips();
    for (const { of: { label, says = '', isBad }, says: said, canvas, grips: knobs } of this.shown) {
      say(said, says);
      said.className = isBad === undefined ? '' : isBad ? 'bad' : 'good';
      mark(canvas, 'aria-label', [label, says].filter(Boolean).join(': '));
      for (const knob of knobs) {
        const { name, x, y, low = -4096, high = 4096, now = x, says: place = `${x}, ${y}` } = grips[knob.dataset.index] ?? {};
        const attributes = { label: name, valuemin: low, valuemax: high, valuenow: now, valuetext: place };
        for (const [attribute, value] of Object.entries(attributes)) mark(knob, `aria-${attribute}`, value);
      }
    }
  }

  resized() {
    this.laidOut = '';
    if (!this.source) return;
    this.layOut();
    this.paint();
  }

  /** Gives the panels the size at which the part fits; read and written only when something changed. */
  layOut() {
    const { part, panels, high = 0.56, most = 112, least = 0, numbers } = this.source;
    const [width, height] = [part[2] - part[0], part[3] - part[1]];
    const key = JSON.stringify([panels.length, width, height, this.isWide, high, most, numbers && axisWide(part)]);
    if (key === this.laidOut) return;
    this.laidOut = key;
    const axis = numbers ? axisWide(part) : 0;
    // Panels that are much wider than high stand below one another, where that shows them larger.
    const [all, tall] = [this.body.clientWidth, Math.max(200, innerHeight * high)];
    const [beside, below] = [[all / panels.length, tall], [all, tall / panels.length]].map(([w, h]) => Math.min(most, w / width, h / height));
    const isStacked = (all / panels.length > 240 || beside < least) && below > 1.3 * beside;
    this.body.classList.toggle('is-stacked', isStacked);
    const rows = Math.ceil(panels.length / getComputedStyle(this.body).gridTemplateColumns.split(' ').length);
    const room = this.isWide ? (innerHeight - 90) / rows - 60 : isStacked ? tall / panels.length : tall;
    const wide = Math.max(40, this.shown[0].figure.clientWidth - axis - 2); // its frame
    const fits = Math.min(this.isWide ? Infinity : most, wide / width, room / height);
    this.cell = Math.max(least, fits >= 4 ? Math.floor(fits) : fits);
    // How many pixels of the part are seen at this size, across and down: all of them, unless they would have to be smaller than `least`.
    const fitting = this.cell === least ? [Math.min(width, Math.floor(wide / least)), Math.min(height, Math.max(1, Math.floor(room / least)))] : [width, height];
    // Another shape shows another part.
    if (String(fitting) !== String(this.fitting)) this.seen = null;
    this.fitting = fitting;
    // A canvas has whole pixels; a drawing keeps its shape to the last part of one.
    const isDrawing = panels[0]?.svg !== undefined;
    this.size = fitting.map((length) => (isDrawing ? length * this.cell : Math.max(1, Math.round(length * this.cell))));
    for (const { figure, frame, canvas, above, beside } of this.shown) {
      figure.classList.toggle('numbered', Boolean(numbers));
      figure.style.setProperty('--axis', `${axis}px`);
      for (const one of [frame, canvas]) Object.assign(one.style, { width: `${this.size[0]}px`, height: `${this.size[1]}px` });
      Object.assign(above.style, { width: `${this.size[0]}px`, height: `${AXIS_HIGH}px` });
      Object.assign(beside.style, { width: `${axis}px`, height: `${this.size[1]}px` });
    }
  }

  /** What is shown at first: the whole part, or as much of it as fits about the cursor. */
  fitted() {
    const { part, cursor } = this.source;
    const corner = [0, 1].map((i) => clamp((cursor ?? part)[i] - (this.fitting[i] >> 1), part[i], part[i + 2] - this.fitting[i]));
    return [...corner, ...corner.map((at, i) => at + this.fitting[i])];
  }

  grips() { return this.source.grips?.() ?? []; }

  /** Screen pixels for each pixel. */
  get unit() { return this.size[0] / (this.seen[2] - this.seen[0]); }

  paint() {
    const { bounds, covers = [] } = this.source;
    this.seen ??= this.fitted();
    const grips = this.grips();
    mark(this, 'data-cell', Math.round(this.unit * 1000) / 1000);
    this.tellSoon();
    const canMove = !bounds || this.seen[0] > bounds[0] || this.seen[1] > bounds[1] || this.seen[2] < bounds[2] || this.seen[3] < bounds[3];
    this.shown.forEach((shown, i) => {
      shown.frame.style.touchAction = canMove ? 'none' : 'pan-y';
      this.waiting.add(shown);
      const own = grips.flatMap((grip, index) => (grip.view === shown.of.view ? [{ grip, index }] : []));
      // The keyboard stops at a grip once, on the first panel that shows it.
      const isFirst = this.shown.findIndex(({ of }) => of.view === shown.of.view) === i;
      this.placeGrips(shown, own, isFirst ? 0 : -1);
    });
    for (const { element, x, y, width, height } of covers) {
      this.over(element, x, y);
      Object.assign(element.style, { width: `${width * this.unit}px`, height: `${height * this.unit}px` });
    }
    this.paintWaiting(this.isHeld ? performance.now() + DRAGGED_MS : Infinity);
  }

  /** Paints panels until a time. Those that are left are the first ones in the next frame of the drag, or come when it pauses. */
  paintWaiting(end) {
    for (const shown of this.waiting) {
      this.waiting.delete(shown);
      this.paintPanel(shown);
      if (performance.now() > end) break;
    }
    if (this.waiting.size > 0) whenIdle(() => this.paintWaiting(Infinity));
  }

  /** A panel is a drawing of its own (`svg`), or layers over one another, each {mark | image, from, to, veil}: from one column to another, the next over the last through a veil. */
  paintPanel(shown) {
    const { canvas, frame, above, beside, of: panel } = shown;
    const [width, height] = this.size;
    const [x0, y0, x1, y1] = this.seen;
    canvas.hidden = panel.svg !== undefined;
    if (panel.svg !== undefined) {
      const seen = [x0, y0, x1 - x0, y1 - y0].join(' ');
      if (shown.svg === panel.svg && shown.drawing.getAttribute('viewBox') === seen) return;
      const next = make('template', { innerHTML: panel.svg }).content.firstElementChild;
      next.setAttribute('viewBox', seen);
      if (shown.drawing) become(shown.drawing, next);
      else frame.prepend(shown.drawing = next);
      shown.svg = panel.svg;
      return;
    }
    const g = contextOf(canvas, width, height);
    const sheet = { g, x0, y0, x1, y1, unit: this.unit, width, height };
    g.fillStyle = colours.empty;
    g.fillRect(0, 0, width, height);
    for (const { mark, image, from = -Infinity, to = Infinity, veil = 0 } of panel.layers ?? []) {
      const [left, right] = [from, to].map((x) => clamp((x - x0) * this.unit, 0, width));
      g.save();
      g.beginPath();
      g.rect(left, 0, right - left, height);
      g.clip();
      g.globalAlpha = 1 - veil;
      if (veil) g.fillRect(0, 0, width, height);
      if (image) paintImage(sheet, image);
      else if (mark) paintMarks(sheet, mark);
      g.restore();
    }
    if (panel.hasGrid !== false && !(this.source.isPicture && this.unit < 6)) paintGrid(sheet);
    for (const outline of panel.outlines ?? []) paintOutline(sheet, outline);
    if (panel.samples) paintSamples(sheet, panel.samples);
    for (const { from, x, y, view } of this.grips()) if (from && view === panel.view) paintOutline(sheet, [from, [x, y]]);
    panel.over?.(sheet);
    if (this.source.cursor) paintCursor(sheet, this.source.cursor);
    if (panel.corners) paintCorners(sheet, panel.corners);
    if (this.source.numbers) paintNumbers(sheet, above, beside);
  }

  /** Puts an element over a place of the picture, by its upper left corner; nothing of the page is laid out anew. */
  over(element, x, y) {
    const [x0, y0, x1, y1] = this.seen;
    const place = `translate(${(x - x0) * this.unit}px, ${(y - y0) * this.unit}px)`;
    if (element.style.transform !== place) element.style.transform = place;
    const isOut = x < x0 || y < y0 || x > x1 || y > y1;
    if (element.hidden !== isOut) element.hidden = isOut;
  }

  placeGrips(shown, own, tabIndex) {
    while (shown.grips.length > own.length) shown.grips.pop().remove();
    own.forEach(({ grip, index }, i) => {
      const made = (shown.grips[i] ??= shown.frame.appendChild(make('div', { role: 'slider', 'aria-valuenow': 0, 'aria-label': grip.name })));
      const className = ['knob', grip.nudge && 'is-value', grip.isPainted && 'is-painted'].filter(Boolean).join(' ');
      const attributes = { class: className, 'data-name': grip.name, 'data-label': own.length > 26 ? '' : grip.name, 'data-index': index, tabindex: tabIndex };
      const is = Object.values(attributes).join();
      if (made.is !== is) for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
      made.is = is;
      this.over(made, grip.x, grip.y);
    });
  }

  // ---- What is seen ----

  /** Shows another part, inside of the bounds; an endless plane in whole pixels. */
  see([x0, y0, x1, y1]) {
    const { bounds, onSeen } = this.source;
    let [left, top] = [x0, y0];
    const [width, height] = [x1 - x0, y1 - y0];
    if (bounds) {
      const inside = (at, size, low, high) => (size >= high - low ? (low + high - size) / 2 : clamp(at, low, high - size));
      left = inside(x0, width, bounds[0], bounds[2]);
      top = inside(y0, height, bounds[1], bounds[3]);
    } else [left, top] = [Math.round(left), Math.round(top)];
    const next = [left, top, left + width, top + height];
    if (String(next) === String(this.seen)) return;
    this.seen = next;
    if (onSeen) onSeen(next);
    else this.paint();
  }

  pan(dx, dy) {
    const [x0, y0, x1, y1] = this.seen;
    this.see([x0 + dx, y0 + dy, x1 + dx, y1 + dy]);
  }

  /** More or fewer pixels in the same panel, about the middle or another position. */
  zoom(way, about) {
    const now = sideOf(this.seen);
    const next = way > 0 ? SIDES.find((one) => one > now) : SIDES.findLast((one) => one < now);
    if (next) this.zoomTo(next, about);
  }

  zoomTo(wanted, about) {
    const { bounds, cursor, part: begun } = this.source;
    const all = bounds ? Math.max(sideOf(bounds), sideOf(begun)) : FARTHEST_PX;
    const side = Math.min(wanted, all);
    const [x0, y0, x1, y1] = this.seen;
    const part = side / sideOf(this.seen);
    if (part === 1) return;
    const isSeen = cursor && cursor[0] >= x0 && cursor[0] < x1 && cursor[1] >= y0 && cursor[1] < y1;
    const [x, y] = about ?? (bounds && isSeen ? [cursor[0] + 0.5, cursor[1] + 0.5] : [(x0 + x1) / 2, (y0 + y1) / 2]);
    const size = [x1 - x0, y1 - y0].map((length) => (bounds ? length * part : Math.max(1, Math.round(length * part))));
    const [left, top] = [x - ((x - x0) / (x1 - x0)) * size[0], y - ((y - y0) / (y1 - y0)) * size[1]];
    this.see([left, top, left + size[0], top + size[1]]);
  }

  fit() { this.see(this.source.home ?? this.fitted()); }

  /** Moves the tools elsewhere; they come along when the viewer fills the window. */
  putTools(place) {
    this.place = place;
    place.append(this.tools);
  }

  /** As large as the window, and back. */
  enlarge() {
    this.isWide = !this.isWide;
    this.classList.toggle('is-wide', this.isWide);
    this.larger.setAttribute('aria-pressed', String(this.isWide));
    if (this.isWide) this.prepend(this.tools);
    else if (this.place) this.place.append(this.tools);
    this.speak();
    this.resized();
    this.larger.focus({ preventScroll: true });
  }

  // ---- Hands ----

  /** Where on the plane an event lies, on a panel whose frame has this box. */
  at(box, event) {
    return [this.seen[0] + (event.clientX - box.left - 1) / this.unit, this.seen[1] + (event.clientY - box.top - 1) / this.unit];
  }

  point([x, y], byKeys) {
    const { bounds, cursor, onPoint } = this.source;
    const [x0, y0, x1, y1] = bounds ?? [-Infinity, -Infinity, Infinity, Infinity];
    const next = [clamp(Math.floor(x), x0, x1 - 1), clamp(Math.floor(y), y0, y1 - 1)];
    if (!onPoint || String(next) === String(cursor)) return;
    onPoint(...next, byKeys);
    // The keyboard may go on beyond what is seen.
    const beyond = (at, low, high) => Math.min(0, at - low) + Math.max(0, at + 1 - high);
    if (byKeys) this.pan(beyond(next[0], this.seen[0], this.seen[2]), beyond(next[1], this.seen[1], this.seen[3]));
  }

  listen(panel) {
    const { frame, canvas } = panel;
    const fingers = new Map();
    let held = null; // {index, dx, dy} of a grip, or {pan, moved}
    let pinched = null; // {apart, side, about}: how two fingers began
    let box = null; // of the frame when the last finger came: to read it at each move would lay the page out each time
    const apart = ([a, b]) => Math.max(1, Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY));
    frame.addEventListener('pointerdown', (event) => {
      if (event.target.closest('button')) return;
      const grip = event.target.closest('.knob');
      frame.setPointerCapture(event.pointerId);
      box = frame.getBoundingClientRect();
      fingers.set(event.pointerId, event);
      if (fingers.size === 2) {
        const [a, b] = [...fingers.values()];
        const about = this.at(box, { clientX: (a.clientX + b.clientX) / 2, clientY: (a.clientY + b.clientY) / 2 });
        pinched = { apart: apart([a, b]), side: sideOf(this.seen), about };
        held = null;
        return;
      }
      const [x, y] = this.at(box, event);
      if (grip) {
        const index = Number(grip.dataset.index);
        const taken = this.grips()[index];
        held = { index, dx: taken.x - x, dy: taken.y - y };
        this.isHeld = true;
        this.source.onHold?.(index);
        grip.focus({ preventScroll: true, focusVisible: false });
      } else held = { pan: [x, y], moved: false };
    });
    frame.addEventListener('pointermove', (event) => {
      if (fingers.has(event.pointerId)) fingers.set(event.pointerId, event);
      if (pinched) {
        const [a, b] = [...fingers.values()];
        const wanted = b && (pinched.side * pinched.apart) / apart([a, b]);
        // An endless plane is seen in steps.
        const steps = (one, best) => Math.abs(Math.log(one / wanted)) < Math.abs(Math.log(best / wanted));
        if (b) this.zoomTo(this.source.bounds ? wanted : SIDES.reduce((best, one) => (steps(one, best) ? one : best)), pinched.about);
        return;
      }
      if (!held) box = frame.getBoundingClientRect();
      const [x, y] = this.at(box, event);
      if (held?.index !== undefined) this.grips()[held.index]?.place(x + held.dx, y + held.dy);
      else if (held) {
        const moved = [held.pan[0] - x, held.pan[1] - y].map((d) => (this.source.bounds ? d : Math.round(d)));
        held.moved ||= Math.hypot(...moved) * this.unit > 4;
        if (held.moved) this.pan(...moved);
      } else if (event.pointerType === 'mouse') this.source.hovers !== false && this.point([x, y], false);
    });
    const release = (event) => {
      fingers.delete(event.pointerId);
      this.isHeld = false;
      if (pinched) {
        if (fingers.size === 0) pinched = null;
        return;
      }
      if (event.type === 'pointerup' && held?.pan && !held.moved) {
        canvas.focus({ preventScroll: true });
        this.point(this.at(box, event), false);
        this.source.onTap?.(event.pointerType);
      }
      held = null;
    };
    for (const ends of ['pointerup', 'pointercancel']) frame.addEventListener(ends, release);
    frame.addEventListener('focusin', ({ target }) => { if (target.matches('.knob')) this.source.onHold?.(Number(target.dataset.index)); });
    const acts = { '+': () => this.zoom(-1), '=': () => this.zoom(-1), '-': () => this.zoom(1), 0: () => this.fit(), f: () => this.enlarge() };
    frame.addEventListener('keydown', (event) => {
      const grip = this.grips()[event.target.closest('.knob')?.dataset.index];
      const step = arrowOf(event);
      const { cursor, fine = 1 } = this.source;
      if (step && event.altKey) this.pan(...step);
      else if (step && grip?.nudge) grip.nudge(...step, event.shiftKey);
      else if (step && grip) grip.place(grip.x + step[0] * (event.shiftKey ? fine : 1), grip.y + step[1] * (event.shiftKey ? fine : 1));
      else if (step && event.target === canvas) {
        const from = cursor ?? [(this.seen[0] + this.seen[2]) / 2 - step[0], (this.seen[1] + this.seen[3]) / 2 - step[1]];
        this.point([0, 1].map((axis) => from[axis] + step[axis] * (event.shiftKey ? 8 : 1)), true);
      } else acts[event.key]?.();
    });
  }

  // ---- As a picture ----

  save() {
    const name = (this.source.title ?? document.title).replace(/[^\w.-]+/g, '-');
    const link = make('a', { href: this.picture().toDataURL('image/png'), download: `${name}.png` });
    document.body.append(link);
    link.click();
    link.remove();
  }

  /** What is shown with its captions, numbers and legend, as one canvas below a title. */
  picture() {
    const { title = document.title, about = '' } = this.source;
    const [PAD, LINE] = [16, 22];
    const axis = this.source.numbers ? axisWide(this.source.part) : 0;
    const [width, height] = this.size;
    const wide = Math.max(420, PAD + this.shown.length * (width + axis + PAD));
    const high = height + AXIS_HIGH + 5 * LINE + 3 * PAD;
    const canvas = make('canvas', { width: 2 * wide, height: 2 * high });
    const g = canvas.getContext('2d');
    g.scale(2, 2);
    const style = getComputedStyle(document.documentElement);
    const ink = style.getPropertyValue('--ink').trim();
    g.fillStyle = style.getPropertyValue('--paper').trim();
    g.fillRect(0, 0, wide, high);
    g.fillStyle = ink;
    g.textBaseline = 'top';
    const write = (text, x, y, font) => {
      g.font = `${font} system-ui, sans-serif`;
      g.fillText(text, x, y, wide - x);
    };
    write(title, PAD, PAD, '600 17px');
    write(about, PAD, PAD + LINE, '13px');
    this.shown.forEach(({ caption, above, beside, canvas: pixels }, i) => {
      const [x, y] = [PAD + i * (width + axis + PAD), PAD + 2 * LINE + 6];
      write(caption.textContent, x + axis, y, '600 13px');
      if (axis) g.drawImage(above, x + axis, y + LINE, width, AXIS_HIGH);
      if (axis) g.drawImage(beside, x, y + LINE + AXIS_HIGH, axis, height);
      g.drawImage(pixels, x + axis, y + LINE + AXIS_HIGH, width, height);
    });
    let at = PAD;
    for (const [colour, , text] of this.source.legend ?? []) {
      g.fillStyle = colours[colour] ?? colour;
      g.fillRect(at, high - PAD - 14, 14, 14);
      g.fillStyle = ink;
      write(text, at + 19, high - PAD - 14, '12px');
      at += 34 + g.measureText(text).width;
    }
    return canvas;
  }
}

customElements.define('rp-view', View);
