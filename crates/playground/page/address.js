// Address and command.

const FIELDS = ['x', 'y', 'w', 'depth', 'u', 'v'];

/** A corner with its values, at least so many; what is as everywhere is left out: w = 1, and values of 0. */
function withValues(c, least = 2) {
  const values = FIELDS.map((f) => c[f] ?? (f === 'w' ? 1 : 0));
  return values.slice(0, 1 + values.findLastIndex((value, i) => i < least || value !== (i === 2 ? 1 : 0))).join(',');
}

function address() {
  const words = new URLSearchParams({ scene: state.scene });
  if (state.named) words.set('case', state.named);
  else if (state.generated) {
    words.set('case', `${state.generated.family}#${state.generated.index}`);
    words.set('seed', state.generated.seed);
  }
  else if (state.lines) words.set('lines', state.lines.map((line) => line.flat().join(',')).join(';'));
  else if (state.triangles) words.set('t', state.triangles.map((t) => t.map((c) => withValues(c)).join('_')).join(';'));
  for (const key of ['window', 'by', 'px']) if (state[key]) words.set(key, state[key].join(','));
  if (!state.snap || state.named) words.set('snap', Number(state.snap));
  if (state.numbers) words.set('numbers', '1');
  for (const key of scene().keeps ?? []) words.set(key, typeof state[key] === 'object' ? JSON.stringify(state[key]) : state[key]);
  if (state.lang !== 'en') words.set('lang', state.lang);
  return `#${words.toString().replaceAll('%2C', ',').replaceAll('%3B', ';')}`;
}

const addressLater = delayed();
/** Browsers refuse addresses that change at every frame. */
const keepAddress = () => addressLater(() => history.replaceState(null, '', address()), 250);

/**
 * Restores what an address says; what it does not say is as the scene begins. Of an address that asks for what cannot be
 * drawn only the scene is kept, and the page says why.
 */
function restore(hash) {
  const words = new URLSearchParams(hash.replace(/^#/, ''));
  state.lang = words.get('lang') ?? (navigator.language.startsWith('zh') ? 'zh' : 'en');
  if (!Object.hasOwn(WORDS, state.lang)) state.lang = 'en';
  const wanted = Object.hasOwn(SCENES, words.get('scene') ?? '') ? words.get('scene') : 'triangle';
  begin(wanted);
  let refused;
  try {
    refused = read(words) ?? scene().ask().error;
  } catch (error) {
    refused = error.message;
  }
  if (refused) {
    begin(wanted);
    state.refused = refused;
  }
}

/** Whether a value has the form of another: the same types, keys and lengths, and finite numbers. */
function isLike(model, value) {
  if (typeof model === 'number') return typeof value === 'number' && Number.isFinite(value);
  if (typeof model !== 'object' || model === null) return typeof value === typeof model;
  if (typeof value !== 'object' || value === null || Array.isArray(value) !== Array.isArray(model)) return false;
  const keys = Object.keys(model);
  return keys.length === Object.keys(value).length && keys.every((key) => Object.hasOwn(value, key) && isLike(model[key], value[key]));
}

/** Takes the words of an address into the state; returns why a case cannot be shown, or nothing. */
function read(words) {
  const numbers = (text) => text.split(',').map(Number);
  const wanted = words.get('case');
  if (wanted) {
    const [family, index] = wanted.split('#');
    const seed = Number(words.get('seed') ?? 1);
    const found = index === undefined ? ask({ ask: 'named', name: wanted }) : ask({ ask: 'generated', family, seed, index: Number(index) });
    if (found.error) return found.error;
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
  const choices = scene().choices?.().map((one) => [one].flat()[0]) ?? [];
  const by = words.get('by')?.split(',').filter((name) => choices.includes(name)) ?? [];
  if (by.length) {
    state.by = [...by, ...(by.length < 2 ? state.by.filter((name) => name !== by[0]) : [])].slice(0, Math.max(2, Math.min(4, by.length)));
    state.four = by.length > 3;
  }
  const px = words.get('px') && numbers(words.get('px'));
  if (px?.length === 2 && good(px)) state.px = px;
  if (words.has('snap')) state.snap = words.get('snap') !== '0';
  state.numbers = words.get('numbers') === '1';
  for (const key of scene().keeps ?? []) {
    const text = words.get(key);
    if (text === null) continue;
    const value = typeof state[key] === 'string' ? text : JSON.parse(text);
    if (isLike(state[key], value)) state[key] = value;
  }
  if (!state.snap && !scene().unsnapped) return word('snapped');
  keepPixel();
  if (!words.has('px') && (wanted || words.has('t')) && state.scene === 'triangle') state.by.some(pointAtWrong);
  return undefined;
}

/** The corners and lines that are shown, as words of `inspect`; nothing where it knows no such thing. */
function subject() {
  if (state.named) return [state.named];
  if (state.generated) return [`'${state.generated.family}#${state.generated.index}'`, `--seed ${state.generated.seed}`];
  if (state.lines) return ['--line', ...state.lines.flat().map((end) => end.join(','))];
  const corners = state.triangles?.flat();
  // Without values a corner has simple ones to the command line, which cover the same pixels.
  return corners?.map((c) => (scene().values ? withValues(c, 3) : `${c.x},${c.y}`));
}

/** Rules are planted faults to the command line, which has one more for corners that are not snapped. */
const PLANTS = [{ 'inclusive-edges': 'exact-inclusive-ties' }, { 'inclusive-edges': 'inclusive-edges', 'exclusive-edges': 'exclusive-edges' }];

/** What shows the same on the command line, and whom it is shown by; nothing where there is no such command. */
function command() {
  const what = subject();
  if (!what) return '';
  const words = ['rasterproof inspect', ...what];
  if (!state.snap && !names.offFamilies.some(({ name }) => name === state.generated?.family)) words.push('--exact');
  const [x0, y0, x1, y1] = state.window;
  // A recorded input has a screen of its own; what is larger than a panel was cut.
  const isWhole = side() < FARTHEST_PX && !names.recorded.some(({ name }) => name === state.named);
  if (!(isWhole && String(state.own) === String(state.window) && (state.named || state.generated))) {
    words.push(`--window ${x0},${y0},${x1 - x0}x${y1 - y0}`);
  }
  const specimen = state.by?.find((name) => entry(name).specimen);
  if (specimen) words.push(`--specimen ${specimen}`);
  const plant = state.by?.map((name) => PLANTS[Number(state.snap)][name]).find(Boolean);
  if (plant) words.push(`--plant ${plant}`);
  return words.join(' ');
}
