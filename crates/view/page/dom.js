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

export function button(label, act, more = {}) {
  const made = make('button', { type: 'button', ...more }, label);
  made.addEventListener('click', act);
  return made;
}

/** Copies a text, where the page may not use the clipboard by a field that is selected. */
export async function copyText(text) {
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    const area = make('textarea', { value: text });
    document.body.append(area);
    area.select();
    document.execCommand('copy');
    area.remove();
  }
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
