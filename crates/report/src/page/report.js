// The report page: its cases and pictures in the viewer, which of them is shown and how, and the address that leads to it.
import { $, button, clamp, copyText, delayed, fill, make, plural, renew } from './dom.js';
import { GLYPHS, MOST_CORNERS, judge } from './paint.js';
import { FARTHEST_PX, viewWords } from './view.js';
import { aboutPixel } from './explain.js';
import { caseItem, cheapRule, colourOf, corners, cropOf, differIn, hitsOf, isTie, load, outlines, pictureItem, pixelsWhere } from './items.js';
import { ROLES, layerTable, rowTable } from './tables.js';

const within = (selector) => document.querySelector(selector);
const data = JSON.parse($('data').textContent);
const items = [...data.cases.map(caseItem), ...data.frames.map(pictureItem)];

const MODES = [['blink', 'blink'], ['slider', 'slider'], ['side', 'side by side'], ['onion', 'onion skin']];
const BLINK_MS = 700;
const stillness = matchMedia('(prefers-reduced-motion: reduce)');
const state = {
  item: null, a: 0, b: 1, mode: null, chosen: null, phase: 'A', paused: stillness.matches, split: null, whole: false, cursor: null, kind: 'all',
};
const view = $('view');

// ---- The view ----

/** A layer of the item as the viewer takes it. */
const layerOf = (item, layer) => {
  if (!item.isCase) return { image: layer.canvas };
  if (layer.refused) return {};
  const target = item.layers[item.oracle];
  return {
    mark: (x, y) => {
      const mark = judge(hitsOf(item, layer, x, y), hitsOf(item, target, x, y));
      return isTie(item, x, y) ? { ...mark, ring: true } : mark;
    },
  };
};

const SAME = { fill: 'same', glyph: '' };
/** Hits of A less hits of B, of pictures where they differ. */
const difference = ({ item, a, b }) => {
  const [la, lb] = [item.layers[a], item.layers[b]];
  if (!item.isCase) return { mark: (x, y) => (colourOf(la, x, y) === colourOf(lb, x, y) ? SAME : { fill: 'missing' }) };
  return {
    mark: (x, y) => {
      const more = hitsOf(item, la, x, y) - hitsOf(item, lb, x, y);
      if (more === 0) return hitsOf(item, la, x, y) ? SAME : null;
      const fill = more > 0 ? 'extra' : 'missing';
      return { fill, glyph: GLYPHS[fill] + Math.abs(more) };
    },
  };
};

const nameOf = (i) => {
  const { label, role } = state.item.layers[i];
  return role === 'specimen' || role === 'planted' ? `${label} (${ROLES[role]})` : label;
};

/** The panels of a mode; a caption is a list of names with the letters of A and B before them. */
const panels = () => {
  const { item, a, b, mode, phase } = state;
  const drawn = (i) => layerOf(item, item.layers[i]);
  const common = item.isCase ? { outlines: outlines(item), samples: [0.5, 0.5], corners: corners(item) } : {};
  // The border between the two.
  if (mode === 'slider') common.outlines = [...(common.outlines ?? []), [[state.split, item.box[1]], [state.split, item.box[3]]]];
  const panel = (layers, ...parts) => {
    const head = () => parts.map((part) => (part === 'A' || part === 'B' ? make('b', { className: `sign of-${part}` }, part) : ` ${part} `));
    const label = parts.join(' ');
    return { key: `${item.name} ${label}`, head, label, layers, ...common };
  };
  const [ofA, ofB] = [['A', nameOf(a)], ['B', nameOf(b)]];
  if (mode === 'blink') return [phase === 'A' ? panel([drawn(a)], ...ofA) : panel([drawn(b)], ...ofB)];
  if (mode === 'slider') return [panel([{ ...drawn(a), to: state.split }, { ...drawn(b), from: state.split }], ...ofA, '|', ...ofB)];
  if (mode === 'onion') return [panel([drawn(a), { ...drawn(b), veil: 1 - Number($('opacity').value) / 100 }], ...ofB, 'over', ...ofA)];
  const oracle = [-1, a, b].includes(item.oracle) ? [] : [panel([drawn(item.oracle)], nameOf(item.oracle))];
  // A picture whose colours mark pixels differs everywhere from one whose do not.
  const isMap = [a, b].some((i) => item.layers[i].is_map);
  const differs = isMap ? [] : [panel([difference(state)], item.isCase ? 'difference: A less B' : 'difference: where A and B differ')];
  return [panel([drawn(a)], ...ofA), panel([drawn(b)], ...ofB), ...oracle, ...differs];
};

/** Smaller frames are enlarged; others are shown as they are, where they have room. */
const SMALL_FRAME_PX = 200;

const show = () => {
  const { item, mode, cursor, whole } = state;
  if (!item) return;
  const part = whole ? item.box : cropOf(item, state.a, state.b);
  const isLarge = !item.isCase && Math.max(...item.box) >= SMALL_FRAME_PX;
  if (mode === 'slider') state.split ??= (part[0] + part[2]) / 2;
  const isPart = String(part) !== String(item.box);
  $('whole').hidden = !isPart && !whole;
  $('whole').textContent = whole ? 'crop' : 'whole window';
  const isSide = mode === 'side';
  view.classList.toggle('is-alone', isSide);
  Object.assign(view.dataset, { mode, phase: state.phase });
  view.show({
    title: item.name, about: item.found || item.about, part, bounds: item.box, numbers: true, isPicture: !item.isCase, cursor, onPoint: moveCursor, panels: panels(), legend: legend(item),
    high: isSide ? 0.42 : item.isCase ? 0.56 : 0.68, most: isLarge ? 1 : Math.max(112, 240 / Math.max(part[2] - part[0], part[3] - part[1])),
    grips: () => (mode !== 'slider' ? [] : [{
      name: 'A | B', says: `A to column ${Math.floor(state.split)}`, x: state.split, y: (part[1] + part[3]) / 2,
      place: (x) => { state.split = clamp(x, part[0], part[2]); show(); },
    }]),
  });
};

const MARKS = { agrees: '', missing: 'missing', extra: 'extra', twice: 'too often', overlap: 'rightly more than once' };
/** What the colours mean: of marks, or of the maps that are shown. */
const legend = ({ isCase, layers, oracle }) => (isCase
  ? Object.entries({ ...MARKS, agrees: layers[oracle].role === 'oracle' ? 'as the oracle' : 'as expected' }).map(([kind, text]) => [kind, GLYPHS[kind], text])
  : [...new Set([state.a, state.b])].flatMap((i) => (layers[i].legend ?? []).map(([colour, text]) => [colour, '', text])));

const announce = delayed();
const tellPixel = (delay) => {
  const { item, a, b, cursor } = state;
  if (!cursor) {
    fill($('about-pixel'), make('p', { className: 'quiet' }, 'Point at a pixel, or choose one with the arrow keys.'));
    return;
  }
  const { nodes, words } = aboutPixel(item, a, b, cursor);
  renew($('about-pixel'), nodes);
  announce(() => { if (delay) $('announce').textContent = words; }, delay);
};

const moveCursor = (x, y, byKeys) => {
  state.cursor = [x, y];
  tellPixel(byKeys ? 60 : 500);
  layerTable(state);
  show();
  remember();
};

// ---- Choosing ----

const describePair = () => {
  const { item, a, b } = state;
  const [la, lb] = [item.layers[a], item.layers[b]];
  const refused = [la, lb].find((layer) => layer.refused);
  const [width, height] = [item.box[2] - item.box[0], item.box[3] - item.box[1]];
  const count = pixelsWhere(item, differIn(item, la, lb)).length;
  let text = `A and B differ in ${plural(count, 'pixel')} of ${(width * height).toLocaleString('en')}.`;
  const map = [la, lb].find((layer) => layer.is_map);
  if (map) text = `${map.label}: its colours mark pixels, so it is not compared.`;
  else if (refused) text = `${refused.label} draws nothing: ${refused.refused}`;
  else if (count === 0) {
    text = `A and B agree in every pixel of ${width} x ${height}.`;
    const wrong = item.isCase && item.layers.some((layer) => layer.role === 'specimen' && layer.wrong > 0);
    if (wrong) text += ' Choose a published algorithm as A to see a fault.';
  }
  $('agreement').textContent = text;
  const r = cheapRule(item);
  const agrees = r && item.layers[item.oracle].hits.every((hits, i) => hits === r.hits[i]);
  const other = 'Expected is the exact picture of what the program declares, not of the top-left rule at the centre.';
  const words = item.pictured ? item.pictured : item.isCase && item.layers[item.oracle].role === 'expected' ? other : `The rule, computed by this page at every pixel, says ${agrees ? 'what' : 'something else than'} the oracle says.`;
  $('by-rule').textContent = r || item.pictured ? words : '';
};

const pairChanged = () => {
  $('pick-a').value = String(state.a);
  $('pick-b').value = String(state.b);
  $('case-playground').hidden = !(state.item.isCase && data.playground);
  $('no-playground').hidden = !state.item.isCase || data.playground;
  if (state.item.isCase) within('#case-playground a').href = `playground.html#${new URLSearchParams(playgroundWords(state.item))}`;
  show();
  describePair();
  layerTable(state);
  rowTable(state);
  tellPixel(0);
  remember();
};

const fillPickers = () => {
  const { item } = state;
  const label = (layer) => {
    if (!item.isCase) return layer.label;
    if (layer.refused) return `${layer.label} (draws nothing)`;
    return ['oracle', 'expected'].includes(layer.role) ? layer.label : `${layer.label} (${layer.wrong} wrong)`;
  };
  for (const picker of [$('pick-a'), $('pick-b')]) {
    const options = item.layers.map((layer, i) => make('option', { value: String(i) }, label(layer)));
    const published = options.filter((_, i) => item.layers[i].role === 'specimen');
    const others = options.filter((_, i) => item.layers[i].role !== 'specimen');
    picker.replaceChildren(...others);
    if (published.length > 0) picker.append(make('optgroup', { label: 'published, with their faults' }, ...published));
  }
};

const setMode = (mode) => {
  Object.assign(state, { mode, phase: 'A', split: null });
  for (const input of $('modes').elements) input.checked = input.value === mode;
  $('blink-controls').hidden = mode !== 'blink';
  $('opacity-controls').hidden = mode !== 'onion';
};

const setPaused = (paused) => {
  state.paused = paused;
  $('pause').textContent = paused ? 'start blinking' : 'pause';
  view.dataset.paused = String(paused);
};

const flip = () => {
  state.phase = state.phase === 'A' ? 'B' : 'A';
  show();
};

const matches = (item) => {
  if (state.kind !== 'all' && item.kind !== state.kind) return false;
  const text = [item.name, item.about, item.found, item.kind, ...item.layers.map((l) => l.everybody)].join(' ').toLowerCase();
  return $('search').value.toLowerCase().split(/\s+/).every((word) => text.includes(word));
};

const KINDS = { failing: 'failing', closest: 'closest to a bound', offgrid: 'off the grid', named: 'named', specimen: 'specimen', picture: 'picture' };

/** What a case stands under in the list: its family where it fails, else why it is shown. */
const groupOf = (item) => (item.kind === 'failing' ? item.name.split('#')[0] : KINDS[item.kind]);

/** The cases that are shown, group by group. */
const shownItems = () => {
  const shown = items.filter(matches);
  const groups = [...new Set(shown.map(groupOf))];
  return groups.flatMap((group) => shown.filter((item) => groupOf(item) === group));
};

const fillList = () => {
  const shown = shownItems();
  $('found').textContent = `${shown.length} of ${plural(items.length, 'case')}`;
  fill($('list'), shown.flatMap((item, i) => {
    const link = make('a', { href: linkTo(item) },
      make('span', { className: 'name' }, item.name),
      make('span', { className: 'what' }, item.found || item.about));
    if (item === state.item) link.setAttribute('aria-current', 'true');
    const group = groupOf(item);
    const isFirst = i === 0 || groupOf(shown[i - 1]) !== group;
    const text = item.kind === 'failing' ? `${group}, failing` : group;
    const head = make('li', { className: `group ${item.kind}` }, text);
    return [...(isFirst ? [head] : []), make('li', {}, link)];
  }));
  const at = shown.indexOf(state.item);
  $('place').textContent = at < 0 ? '' : `${at + 1} of ${shown.length}`;
  $('steps').hidden = shown.length < 2 && at >= 0;
  // The chosen one is in sight, without moving the page.
  const [list, chosen] = [$('list'), within('#list a[aria-current]')];
  const top = chosen ? chosen.getBoundingClientRect().top - list.getBoundingClientRect().top : 0;
  if (top < 0 || top > list.clientHeight - 60) list.scrollTop += top - list.clientHeight / 3;
};

/** The case that stands before or after the one that is open. */
const step = (by) => {
  const shown = shownItems();
  const at = shown.indexOf(state.item);
  const next = shown[(at + by + shown.length) % shown.length];
  if (next) location.hash = linkTo(next);
};

const fillFilters = () => {
  const kinds = ['all', ...Object.keys(KINDS).filter((kind) => items.some((item) => item.kind === kind))];
  fill($('filters'), kinds.map((kind) => {
    const count = kind === 'all' ? items.length : items.filter((item) => item.kind === kind).length;
    return button(`${KINDS[kind] ?? kind} ${count}`, () => {
      state.kind = kind;
      fillFilters();
      fillList();
    }, { 'aria-pressed': kind === state.kind, 'data-kind': kind, id: `filter-${kind}` });
  }));
};

// ---- Addresses: #case-NAME&mode=MODE&a=NAME&b=NAME&px=X,Y ----

const linkTo = (item) => `#case-${encodeURIComponent(item.name)}`;

const address = () => {
  const { item, mode, a, b, cursor } = state;
  const name = (i) => encodeURIComponent(item.layers[i].names[0]);
  return `${linkTo(item)}&mode=${mode}&a=${name(a)}&b=${name(b)}${cursor ? `&px=${cursor}` : ''}`;
};

const addressLater = delayed();
/** Puts what is shown into the address, some time after the last change. */
const remember = () => addressLater(() => history.replaceState(null, '', address()), 150);
/** What nobody chose is not in the address. */
const forget = () => addressLater(() => {}, 0);

/** What an address asks for; nothing where it names a part of the page, or nothing. */
const parseAddress = (url) => {
  const settings = Object.fromEntries(new URLSearchParams(new URL(url).hash.slice(1)));
  const [first = ''] = Object.keys(settings);
  if (first === '' || $(first)) return null;
  if (!first.startsWith('case-')) return { settings, lost: `This page has no place called ${first}` };
  const name = first.slice('case-'.length);
  const item = items.find((one) => one.name === name);
  return { item, settings, lost: item ? lostOf(item, settings) : `This page has no case called ${name}` };
};

/** What of an address a case does not have; an address may be older than the page. */
const lostOf = (item, { a, b, mode, px }) => {
  const isThere = (name) => item.layers.some((layer) => layer.names.includes(name));
  const nobody = [a, b].find((name) => name !== undefined && !isThere(name));
  if (nobody !== undefined) return `Nobody called ${nobody} draws this case`;
  if (mode !== undefined && !MODES.some(([name]) => name === mode)) return `There is no way to compare called ${mode}`;
  const [x0, y0, x1, y1] = item.box;
  const [x, y, more] = px?.split(',').map(Number) ?? [x0, y0];
  // How large a picture is, is known when it is there.
  const isIn = !item.isCase || (more === undefined && [x, y].every(Number.isInteger) && x >= x0 && x < x1 && y >= y0 && y < y1);
  return isIn ? '' : `This case has no pixel ${px}`;
};

/** The first pixel in which A and B differ, in the middle row of those that do; nothing in pictures. */
const firstDifferent = (item) => {
  if (!item.isCase) return null;
  const found = pixelsWhere(item, differIn(item, item.layers[state.a], item.layers[state.b]));
  return found[Math.floor((found.length - 1) / 2)] ?? null;
};

/** What opens a case in the playground: its name where it has one there, else its places. */
const playgroundWords = (item) => {
  const { kind, points } = item.shape;
  const by = [state.a, state.b].map((i) => item.layers[i].names[0]).join();
  const scene = kind === 'lines' ? 'line' : 'triangle';
  const [, name, seed] = / inspect '?([\w.-]+(?:#\d+)?)'?(?: --seed (\d+))?(?: --plant [\w-]+)?$/.exec(item.command) ?? [];
  if (name) return { scene, case: name, ...(seed && { seed }), by };
  const isTooLarge = Math.max(item.box[2] - item.box[0], item.box[3] - item.box[1]) > FARTHEST_PX;
  const [x0, y0, x1, y1] = isTooLarge ? cropOf(item, state.a, state.b) : item.box;
  const window = [x0, y0, Math.min(x1, x0 + FARTHEST_PX), Math.min(y1, y0 + FARTHEST_PX)].join();
  if (kind === 'lines') return { scene, lines: points.map((line) => line.flat().join()).join(';'), window, by };
  const place = (point) => (kind === 'free' ? point : point.map((sub) => sub / 256)).join();
  const t = points.map((triangle) => triangle.map(place).join('_')).join(';');
  return { scene, t, window, by, ...(kind === 'free' && { snap: 0 }) };
};

/** Where a case is explained: a link where the page knows the way to the docs. */
const chapterOf = (item) => {
  const { title, path } = item.chapter ?? {};
  if (!title) return [];
  const link = data.docs ? make('a', { href: data.docs + path }, title) : title;
  return ['Explained in ', link, data.docs ? '' : `, docs/${path.split('#')[0]}`, '.'];
};

/** A window from here on has room for three panels. */
const WIDE_PX = 960;

const open = async (item, settings = {}) => {
  state.opening = item;
  await load(item);
  // Somebody chose another one in the meantime.
  if (state.opening !== item) return;
  const place = (name, otherwise) => {
    const at = item.layers.findIndex((layer) => layer.names.includes(name));
    return at >= 0 ? at : otherwise;
  };
  const isNew = state.item !== item;
  state.item = item;
  state.a = place(settings.a, item.start[0]);
  state.b = place(settings.b, item.start[1]);
  if (isNew) Object.assign(state, { whole: false, split: null, cursor: firstDifferent(item), phase: 'A' });
  const [x, y] = (settings.px ?? '').split(',').map(Number);
  if (Number.isInteger(x) && Number.isInteger(y)) {
    state.cursor = [clamp(x, item.box[0], item.box[2] - 1), clamp(y, item.box[1], item.box[3] - 1)];
  }
  $('lost').hidden = true;
  $('case-title').textContent = item.name;
  $('case-kind').textContent = KINDS[item.kind];
  $('case-kind').className = `kind ${item.kind}`;
  $('case-chapter').replaceChildren(...chapterOf(item));
  const places = item.isCase ? corners(item) : [];
  $('case-corners').textContent = places.length > 0 && places.length <= MOST_CORNERS
    ? `Corners, in pixels: ${places.map(({ text }) => text).join('  ')}` : '';
  $('case-about').textContent = item.about;
  $('case-found').textContent = item.found;
  $('case-command').hidden = !item.command;
  within('#case-command code').textContent = item.command;
  if (MODES.some(([mode]) => mode === settings.mode)) state.chosen = settings.mode;
  // Where there is room, what is expected, what is drawn and the difference stand side by side.
  const isSmall = item.isCase || (Math.max(...item.box) < SMALL_FRAME_PX && !item.start.some((i) => item.layers[i].is_map));
  setMode(state.chosen ?? (isSmall && innerWidth >= WIDE_PX ? 'side' : 'blink'));
  fillPickers();
  fillList();
  pairChanged();
  document.body.dataset.ready = item.name;
};

/** Opens what an address names, and says so where there is no such case. */
const follow = async (url) => {
  const found = parseAddress(url);
  if (!found) return;
  forget();
  if (found.item || !state.item) await open(found.item ?? items[0], found.settings);
  if (found.lost) {
    forget();
    $('lost').textContent = `${found.lost}; this is ${state.item.name}.`;
    $('lost').hidden = false;
  }
  const { top } = $('viewer').getBoundingClientRect();
  if (top < 0 || top > window.innerHeight / 2) $('viewer').scrollIntoView({ block: 'start' });
};

// ---- Wiring ----

/** Another way to compare, chosen by the reader. */
const choose = (mode) => {
  state.chosen = mode;
  setMode(mode);
  show();
  remember();
};

const keyAnywhere = (event) => {
  const typing = event.target.closest?.('input[type="search"], select, textarea');
  if (typing || event.ctrlKey || event.altKey || event.metaKey || !$('keys-on').checked) return;
  const mode = MODES['1234'.indexOf(event.key)];
  if (event.key.length === 1 && mode) choose(mode[0]);
  else if (event.key === 'n') step(1);
  else if (event.key === 'p') step(-1);
  else if (event.key === 'b') {
    if (state.mode === 'blink') setPaused(!state.paused);
    else { choose('blink'); setPaused(false); }
  }
};

const listen = () => {
  document.addEventListener('click', ({ target }) => {
    const wanted = target.closest('button.find')?.dataset.search;
    if (wanted === undefined) return;
    const exact = items.find((item) => item.name === wanted);
    $('search').value = exact ? '' : wanted;
    fillList();
    const link = exact ? linkTo(exact) : within('#list a')?.getAttribute('href');
    if (link) location.hash = link;
    $('cases').scrollIntoView();
  });
  $('search').addEventListener('input', fillList);
  $('pick-a').addEventListener('change', (e) => { state.a = Number(e.target.value); pairChanged(); });
  $('pick-b').addEventListener('change', (e) => { state.b = Number(e.target.value); pairChanged(); });
  $('swap').addEventListener('click', () => { [state.a, state.b] = [state.b, state.a]; pairChanged(); });
  $('modes').addEventListener('change', (event) => choose(event.target.value));
  $('pause').addEventListener('click', () => setPaused(!state.paused));
  $('other').addEventListener('click', () => { setPaused(true); flip(); });
  $('opacity').addEventListener('input', show);
  $('whole').addEventListener('click', () => { state.whole = !state.whole; show(); });
  $('previous').addEventListener('click', () => step(-1));
  $('next').addEventListener('click', () => step(1));
  $('rows').addEventListener('toggle', () => rowTable(state));
  document.addEventListener('keydown', keyAnywhere);
  window.addEventListener('hashchange', (event) => follow(event.newURL));
  stillness.addEventListener('change', () => { if (stillness.matches) setPaused(true); });
  setInterval(() => {
    if (state.mode === 'blink' && !state.paused && !document.hidden && state.item) flip();
  }, BLINK_MS);
  // On paper nothing blinks.
  addEventListener('beforeprint', () => { if (view.shown.length === 1) choose('side'); });
};

const start = async () => {
  document.addEventListener('click', (event) => {
    const pressed = event.target.closest('button.copy');
    if (pressed) copyText(pressed.parentElement.querySelector('code').textContent, pressed, 'copied');
    event.target.closest('.plot button')?.parentElement.classList.toggle('is-wide');
  });
  document.addEventListener('keydown', ({ key }) => { if (key === 'Escape') within('.plot.is-wide')?.classList.remove('is-wide'); });
  if (items.length === 0) return;
  $('cases').hidden = false;
  $('chooser').hidden = items.length === 1;
  $('modes').append(...MODES.map(([value, text], i) => make('label', {},
    make('input', { type: 'radio', name: 'mode', value }), make('kbd', { 'aria-hidden': 'true' }, String(i + 1)), text)));
  $('keys-help').textContent = viewWords().keys;
  view.tools.append($('whole'));
  view.putTools($('controls'));
  setPaused(state.paused);
  fillFilters();
  listen();
  if (parseAddress(location.href)) await follow(location.href);
  else await open(items[0]).then(forget);
};

start();
