// Tools and the table of corners.

/** What brings sliders and boxes to where their values are, which change elsewhere too. */
let sliding = [];

function check(label, key, then = () => {}) {
  const box = make('input', { type: 'checkbox', checked: state[key], 'data-state': key });
  box.addEventListener('change', () => { state[key] = box.checked; then(); redraw(); });
  sliding.push(() => { box.checked = state[key]; });
  return make('label', {}, box, ` ${label}`);
}

/** A slider for a value; the highest one may be a function. */
function slide(label, get, [low, high, step], set) {
  const most = () => String(typeof high === 'function' ? high() : high);
  const range = make('input', { type: 'range', min: low, max: most(), step, value: get() });
  const says = make('output', { 'aria-live': 'off' }, String(get()));
  range.addEventListener('input', () => { set(Number(range.value)); redraw(); });
  sliding.push(() => {
    const text = String(get());
    if (range.max !== most()) range.max = most();
    if (range.value !== text) range.value = text;
    say(says, text);
  });
  return make('label', { className: 'group' }, `${label} `, range, ' ', says);
}

function drawTools() {
  sliding = [];
  fill($('tools'), scene().tools?.() ?? []);
}

/** Buttons and sliders show what is chosen, wherever it was chosen. */
function pressTools() {
  for (const follow of sliding) follow();
  for (const button of $('tools').querySelectorAll('[data-by]')) {
    mark(button, 'aria-pressed', state.by?.[1] === button.dataset.by);
  }
}

/** Corners as numbers; built anew only when there are other ones, so that typing is not disturbed. */
let cornersFor = '';
function drawCorners() {
  const all = handles();
  const fields = scene().fields ?? [];
  const key = JSON.stringify([state.scene, state.lang, all.length, state.snap, fields.map((f) => f.key)]);
  if (key !== cornersFor) {
    cornersFor = key;
    buildCorners(all, fields);
  }
  for (const input of $('corners').querySelectorAll('input')) {
    const handle = all[Number(input.dataset.corner)];
    const value = fields.find((f) => f.key === input.dataset.key)?.get(handle) ?? handle[input.dataset.key];
    const text = String(state.lines ? Math.floor(value) : value);
    if (document.activeElement !== input && input.value !== text) input.value = text;
  }
  [...$('corners').querySelectorAll('tbody tr')].forEach((row, i) => row.classList.toggle('chosen', i === state.chosen));
}

function buildCorners(all, fields) {
  const columns = [{ key: 'x' }, { key: 'y' }, ...fields];
  const rows = all.map((handle, i) => {
    const inputs = columns.map((column) => {
      const step = state.lines ? 1 : column.step ?? (state.snap ? 1 / SUB : 'any');
      const input = make('input', { type: 'number', step, 'data-corner': i, 'data-key': column.key, 'aria-label': `${LETTERS[i % 26]} ${column.key}` });
      input.addEventListener('input', () => {
        const value = Number(input.value);
        const now = handles()[i];
        if (input.value === '' || !Number.isFinite(value) || !now) return;
        if (column.set) { column.set(now, value); redraw(); } else place(now, column.key === 'x' ? value : now.x, column.key === 'y' ? value : now.y);
      });
      input.addEventListener('focus', () => { state.chosen = i; });
      return input;
    });
    return [LETTERS[i % 26], ...inputs];
  });
  const heads = [word(state.lines ? 'end' : 'corner'), ...columns.map((column) => column.key)];
  fill($('corners'), all.length === 0 ? [] : [make('h2', { id: 'corners-title' }, word('corners')), table(heads, rows)]);
}
