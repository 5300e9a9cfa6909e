// Listening: mouse, fingers and keys on a panel.

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
    const far = (grip) => (grip.view === shown[i].of ? Math.hypot(grip.x - x, grip.y - y) * unit : Infinity);
    const order = grips().map((grip, index) => ({ index, far: far(grip) })).sort((a, b) => a.far - b.far);
    return order[0]?.far <= reach ? order[0].index : null;
  };
  const fingers = new Map();
  let pinched = null; // {apart, side, about}: how the two fingers began
  const apart = () => {
    const [a, b] = [...fingers.values()];
    return Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY);
  };
  const pinch = () => {
    const [a, b] = [...fingers.values()];
    const about = at({ clientX: (a.clientX + b.clientX) / 2, clientY: (a.clientY + b.clientY) / 2 });
    pinched = { apart: Math.max(1, apart()), side: side(), about };
    held = null;
  };
  canvas.addEventListener('pointerdown', (event) => {
    const index = nearest(event);
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, event);
    if (fingers.size === 2) { pinch(); return; }
    held = index === null ? { pan: at(event), moved: false } : { index };
    if (index !== null) Object.assign(state, { chosen: index, moves: 'corner' });
    redraw();
  });
  canvas.addEventListener('pointermove', (event) => {
    if (fingers.has(event.pointerId)) fingers.set(event.pointerId, event);
    if (pinched) {
      if (fingers.size === 2) zoomTo((pinched.side * pinched.apart) / Math.max(1, apart()), pinched.about);
      return;
    }
    const [x, y] = at(event);
    if (held?.index !== undefined) (grips()[held.index] ?? grips()[0]).place(x, y);
    else if (held?.pan) {
      const [dx, dy] = [Math.round(held.pan[0] - x), Math.round(held.pan[1] - y)];
      if (dx || dy) { held.moved = true; pan(dx, dy); }
    } else if (event.pointerType === 'mouse' && state.hover !== false) lookAt(x, y);
  });
  const release = (event) => {
    fingers.delete(event.pointerId);
    if (pinched) { if (fingers.size === 0) pinched = null; return; }
    if (event.type === 'pointerup' && held?.pan && !held.moved) {
      lookAt(...at(event));
      state.hover = event.pointerType !== 'mouse' || state.hover === false;
    }
    held = null;
  };
  for (const ends of ['pointerup', 'pointercancel']) canvas.addEventListener(ends, release);
  canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    zoom(event.deltaY > 0 ? 1 : -1, at(event));
  }, { passive: false });
  canvas.addEventListener('keydown', (event) => keys(event, i));
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

/** Pixels along the longer side of the panels. */
const side = () => Math.max(state.window[2] - state.window[0], state.window[3] - state.window[1]);

/** More or fewer pixels in the same panel, about the middle or another position. */
function zoom(way, about) {
  const next = way > 0 ? SIDES.find((one) => one > side()) : SIDES.findLast((one) => one < side());
  if (next) zoomTo(next, about);
}

/** So many pixels along a side, as near as there is; the position `about` stays where it is. */
function zoomTo(wanted, about) {
  if (scene().handles) return;
  const [x0, y0, x1, y1] = state.window;
  const next = SIDES.reduce((best, one) => (Math.abs(Math.log(one / wanted)) < Math.abs(Math.log(best / wanted)) ? one : best));
  if (next === side()) return;
  const [x, y] = about ?? [(x0 + x1) / 2, (y0 + y1) / 2];
  const left = Math.round(x - ((x - x0) / (x1 - x0)) * next);
  const top = Math.round(y - ((y - y0) / (y1 - y0)) * next);
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

function keys(event, i) {
  const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
  const arrow = arrows[event.key];
  const all = grips();
  const here = all.flatMap((grip, index) => (grip.view === shown[i].of ? [index] : []));
  if (arrow && event.altKey) pan(...arrow);
  else if (arrow && state.moves === 'pixel') lookAt(state.px[0] + arrow[0], state.px[1] + arrow[1]);
  else if (arrow) {
    state.chosen = chosenOn(i);
    const grip = all[state.chosen];
    const step = event.shiftKey && !state.lines ? 1 / SUB : 1;
    if (grip.nudge) grip.nudge(...arrow, event.shiftKey);
    else grip.place(grip.x + arrow[0] * step, grip.y + arrow[1] * step);
  } else if (event.key === ']' || event.key === '[') {
    const now = here.indexOf(chosenOn(i));
    Object.assign(state, { moves: 'corner', chosen: here[(now + (event.key === ']' ? 1 : here.length - 1)) % here.length] });
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
