// What every page is made with.

export const $ = (id) => document.getElementById(id);

/** An element with properties or attributes, and children; text is set as text, never as HTML. */
export function make(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name in element) element[name] = value;
    else element.setAttribute(name, value);
  }
  if (children.length > 0) fill(element, children);
  return element;
}

/** New contents; what had the focus and is there again keeps it. */
export function fill(element, ...children) {
  const focused = element.contains(document.activeElement) ? document.activeElement.id : '';
  element.replaceChildren(...children.flat().filter((child) => child !== null && child !== undefined && child !== ''));
  if (focused) $(focused)?.focus();
}

/** Gives an element an attribute, where it is another one: what is set anew is styled anew. */
export function mark(element, name, value) {
  if (element.getAttribute(name) !== String(value)) element.setAttribute(name, value);
}

/** Says a text, where it is another one: what is set anew is laid out anew. */
export function say(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

/**
 * Makes an element like another one, and changes only what differs. For what follows a drag: a table that is put in anew is laid out as a
 * whole, one whose numbers change is not. What listens stays as it is, so both listen to the same.
 */
export function become(old, next) {
  for (const { name } of [...old.attributes]) if (!next.hasAttribute(name)) old.removeAttribute(name);
  for (const { name, value } of next.attributes) mark(old, name, value);
  const [before, after] = [old, next].map(({ childNodes }) => [...childNodes]);
  after.forEach((made, i) => {
    const there = before[i];
    if (!there) old.append(made);
    else if (there.nodeName !== made.nodeName) there.replaceWith(made);
    else if (made.nodeType === Node.ELEMENT_NODE) become(there, made);
    else if (there.data !== made.data) there.data = made.data;
  });
  for (const left of before.slice(after.length)) left.remove();
}

/** New contents like `fill`, made of what is there. */
export function renew(element, ...children) {
  const next = element.cloneNode(false);
  fill(next, ...children);
  become(element, next);
}

/** A text whose whole numbers have commas between groups of three digits; parts of fractions stay as they are. */
export const inGroups = (text) => text.replace(/(?<![\d/.,])\d{4,}(?!\d|\.\d)/g, (digits) => BigInt(digits).toLocaleString('en'));

/** A number with what it counts. */
export const plural = (n, one, many = `${one}s`) => `${n.toLocaleString('en')} ${n === 1 ? one : many}`;

/** The language of the page, one of two. */
export const pageLanguage = () => (document.documentElement.lang.startsWith('zh') ? 'zh' : 'en');

/** What may be wider than its place scrolls there, by the keyboard as well. */
export const scrolling = (...children) => make('div', { className: 'scroll', tabIndex: 0, role: 'group', 'aria-label': pageLanguage() === 'zh' ? '表格' : 'Table' }, ...children);

/** A table whose rows begin with their names; a row is a list of cells, or {cells, className}. Numbers stand at the right. */
export function table(heads, rows, { caption = '', ...more } = {}) {
  const kindOf = (cell) => ({ className: /^[-\u2212+]?[\d.,]+(e[-+]?\d+)?%?$/.test(cell) ? 'number' : '' });
  const rowOf = ({ cells, className = '' }) => make('tr', { className }, ...cells.map((cell, i) => (
    i === 0 ? make('th', { scope: 'row' }, cell) : make('td', kindOf(cell), cell))));
  const lists = rows.map((row) => (Array.isArray(row) ? { cells: row } : row));
  const head = heads.map((text, i) => make('th', { scope: 'col', ...kindOf(lists[0]?.cells[i] ?? '') }, text));
  return scrolling(make('table', more, ...(caption ? [make('caption', {}, caption)] : []),
    make('thead', {}, make('tr', {}, ...head)), make('tbody', {}, ...lists.map(rowOf))));
}

export function button(label, act, more = {}) {
  const made = make('button', { type: 'button', ...more }, label);
  made.addEventListener('click', act);
  return made;
}

/** A list to choose from; an option is its value, or value and text. */
export function select(options, value, act, more = {}) {
  const optionOf = ([value, text = value]) => make('option', { value }, text);
  const made = make('select', more, ...options.map((option) => optionOf([option].flat())));
  made.value = value;
  made.addEventListener('change', () => act(made.value));
  return made;
}

/** A value, or the end of a range that it is beyond. */
export const clamp = (value, low, high) => Math.max(low, Math.min(high, value));

/** What does a thing so many milliseconds later, unless it is asked for another one before. */
export function delayed() {
  let timer = 0;
  return (act, ms) => {
    clearTimeout(timer);
    timer = setTimeout(act, ms);
  };
}

/** Does a thing when half of a frame is left for it; Safari does not say what is left, so there it is done at once. */
export function whenIdle(act) {
  if (globalThis.requestIdleCallback) requestIdleCallback((rest) => (rest.timeRemaining() > 8 ? act() : whenIdle(act)));
  else act();
}

/**
 * What does a thing soon, but not again before so many milliseconds are over: then as it was asked for last. A drag on a slow machine leaves
 * no time between its frames: what only goes with the picture waits there until the drag pauses.
 */
export function paced(act, ms) {
  let [due, asked] = [0, null];
  const run = () => {
    const now = asked;
    [due, asked] = [performance.now() + ms, null];
    act(...now);
  };
  return (...next) => {
    if (!asked) setTimeout(() => whenIdle(run), Math.max(0, due - performance.now()));
    asked = next;
  };
}

/** Copies a text, where the page may not use the clipboard by a field that is selected, and says so on the button that was pressed. */
export async function copyText(text, pressed, says) {
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    const area = make('textarea', { value: text });
    document.body.append(area);
    area.select();
    document.execCommand('copy');
    area.remove();
  }
  const before = pressed.textContent;
  if (before === says) return;
  Object.assign(pressed, { ariaLive: 'polite', textContent: says });
  setTimeout(() => { pressed.textContent = before; }, 1500);
}

const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

/** The direction of an arrow key, which the page around then does not get: a book turns its pages by arrows. */
export function arrowOf(event) {
  const step = event.ctrlKey || event.metaKey ? undefined : ARROWS[event.key];
  if (step) {
    event.preventDefault();
    event.stopPropagation();
  }
  return step;
}
