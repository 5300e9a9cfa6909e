// What is shown: the state of the page, and what can be dragged.

const SUB = 256;
const LETTERS = 'ABCDEFGHIJKLMNOPQRSTUVWXYZ';
const state = { lang: 'en', scene: 'triangle' };
let names = null; // what there is to choose from
let last = { answer: null, look: null };

function begin(scene, from = {}) {
  clearInterval(state.playing);
  for (const key of Object.keys(state)) if (key !== 'lang') delete state[key];
  Object.assign(state, { scene, snap: true, four: false, numbers: false, chosen: 0, step: 0 });
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

/** All that can be dragged: corners, and what a scene adds. A grip is {name, x, y, place, nudge?, says?, from?, view?};
 * it lies on the panels of its view. */
function grips() {
  const corners = handles().map((handle, i) => ({ ...handle, name: corner(i), place: (x, y) => place(handle, x, y) }));
  return [...corners, ...(scene().grips?.() ?? [])];
}

/** Puts a handle somewhere, on the lattice where corners snap, on a whole pixel for lines. */
function place(handle, x, y) {
  const limit = (v) => clamp(v, -4096, 4096);
  if (scene().place) scene().place(handle, x, y);
  else if (state.lines) {
    handle.members[0][0] = limit(Math.floor(x));
    handle.members[0][1] = limit(Math.floor(y));
  } else {
    const to = (v) => limit(state.snap ? Math.round(v * SUB) / SUB : v);
    for (const corner of handle.members) Object.assign(corner, { x: to(x), y: to(y) });
  }
  forget();
  redraw();
}

/** What is shown has no name any more. */
function forget() {
  delete state.named;
  delete state.generated;
}
