// What checks of the playground have in common.

import assert from 'node:assert/strict';

import { ours } from './program.mjs';

export const SCENES = ['triangle', 'line', 'weights', 'perspective', 'depth', 'near', 'samples', 'culling', 'figure'];

/** Opens an address and waits until everything is drawn and explained. */
export async function show(tab, address) {
  await tab.open(address);
  await tab.settle();
}

export const isTroubled = (tab) => tab.value('document.getElementById("trouble").checkVisibility()');

/** What the page's engines answer, and what those of this program do. */
export const both = async (tab, question) => [await tab.value((question) => ask(question), question), await ours(question)];

/** Where what is called `name` lies on panel `i`, in pixels of the tab. */
export const grip = (tab, i, name) => tab.value((i, name) => {
  const { canvas } = view.shown[i];
  canvas.scrollIntoView({ block: 'center' });
  const { left, top } = canvas.getBoundingClientRect(), { x, y } = grips().find((grip) => grip.name === name);
  return [left + (x - view.seen[0]) * view.unit, top + (y - view.seen[1]) * view.unit];
}, i, name);

/** Gives the keyboard what is called so on the first panel that shows it. */
export const hold = (tab, name) => tab.value((name) => view.querySelector(`.knob[data-name="${name}"][tabindex="0"]`).focus(), name);

/** Drags from one place to another with the mouse. */
export async function drag(tab, [x, y], [dx, dy]) {
  await tab.mouse('mousePressed', [x, y]);
  for (let step = 1; step <= 10; step += 1) await tab.mouse('mouseMoved', [x + (step / 10) * dx, y + (step / 10) * dy]);
  await tab.mouse('mouseReleased', [x + dx, y + dy]);
  await tab.settle();
}

/** Checks that the page's engines answer a question as this program's own do; the answer. */
export async function answersAlike(tab, question, about) {
  const [theirs, own] = await both(tab, question);
  assert.deepEqual(theirs, own, about);
  return own;
}
