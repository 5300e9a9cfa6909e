// What checks of live figures have in common: what the oracle draws for a figure, and what stands in the browser.

import assert from 'node:assert/strict';
import path from 'node:path';

import { ours } from './program.mjs';

/** All live figures: their names, the ends of their grips, the names of their numbers. */
export const figures = () => ours({ list: 'figures' });

/** What a figure is for these positions of its grips, drawn by the oracle; the page's engines draw by others. */
export async function expected(name, at, { language = 'en', isAnswered = true } = {}) {
  const answer = await ours({ ask: 'figure', name, language, at, is_answered: isAnswered, by: 'oracle' });
  assert(!answer.error, `${name}: ${answer.error}`);
  return answer;
}

/** Calls a function of the page with the element of a figure and with values. */
export const inFigure = (tab, name, what, ...values) =>
  tab.value(`(${what})(document.querySelector('rp-figure[scene="${name}"]'), ...${JSON.stringify(values)})`);

/** Scrolls to a figure and waits until it asks. Taking a picture of the page moves it, so it scrolls again. */
export const visit = (tab, name) => tab.when((name) => {
  const figure = document.querySelector(`rp-figure[scene="${name}"]`);
  figure.scrollIntoView({ block: 'center', behavior: 'instant' });
  return figure.shadowRoot.querySelector('.controls').childElementCount > 0;
}, name);

/** Visits a figure and lets it show its answer. */
export async function answer(tab, name) {
  await visit(tab, name);
  await inFigure(tab, name, (figure) => figure.controls.lastChild.click());
}

export const stands = (tab, name) => inFigure(tab, name, (figure) => JSON.parse(figure.dataset.at));

export const link = (tab, name) => inFigure(tab, name, (figure) => figure.link.href);

/** Puts the grips of a figure somewhere. */
export const put = (tab, name, at) => inFigure(tab, name, (figure, at) => {
  figure.at = at;
  figure.draw();
}, at);

/** Where a grip of a figure lies in the tab. */
export const gripOf = (tab, name, i) => inFigure(tab, name, (figure, i) => {
  const grip = figure.shadowRoot.querySelectorAll('[role=slider]')[i];
  grip.scrollIntoView({ block: 'center', behavior: 'instant' });
  const { left, top, width, height } = grip.getBoundingClientRect();
  return [left + width / 2, top + height / 2];
}, i);

/** Drags a grip with the mouse. */
export async function dragGrip(tab, name, i, [dx, dy]) {
  const [x, y] = await gripOf(tab, name, i), to = [x + dx, y + dy];
  await tab.mouse('mousePressed', [x, y]);
  await tab.mouse('mouseMoved', to);
  await tab.mouse('mouseReleased', to);
}

/**
 * For the page: the pixels of a picture with the colours that the browser gives them. The corner of each on the sheet, its side,
 * red, green, blue. A path holds runs of pixels.
 */
export const pixels = (root) => [...root.querySelectorAll('.px')].flatMap((path) =>
  [...path.getAttribute('d').matchAll(/M([\d.]+) ([\d.]+)h([\d.]+)v([\d.]+)/g)].flatMap(([, ...run]) => {
    const [x, y, width, side] = run.map(Number), colour = getComputedStyle(path).fill.match(/\d+/g).map(Number);
    return Array.from({ length: Math.round(width / side) }, (_, i) => [x + i * side, y, side, ...colour]);
  }));

/** For the page: which pixels of a picture are not on a screenshot of the stage: none of five spots in them has their colour. */
const lostPixels = (pixels) => `async (svg, png, spots) => {
  const host = document.body.appendChild(document.createElement('div')), root = host.attachShadow({ mode: 'open' });
  root.innerHTML = svg;
  const all = (${pixels})(root);
  host.remove();
  const image = new Image();
  image.src = 'data:image/png;base64,' + png;
  await image.decode();
  const { width, height } = image, canvas = new OffscreenCanvas(width, height), context = canvas.getContext('2d');
  context.drawImage(image, 0, 0);
  const { data } = context.getImageData(0, 0, width, height), zoom = width / 360;
  // What is dragged lies on the picture, and may hide the pixel under it.
  const isHidden = ([left, top, side]) => spots.some(([x, y]) => Math.hypot(x - left - side / 2, y - top - side / 2) < 12);
  const isThere = ([left, top, side, ...colour]) => [[0.2, 0.2], [0.8, 0.2], [0.2, 0.8], [0.8, 0.8], [0.5, 0.2]].some(([right, down]) => {
    const [x, y] = [left + right * side, top + down * side].map((at) => Math.floor(at * zoom));
    return x < width && y < height && colour.every((byte, i) => data[4 * (y * width + x) + i] === byte);
  });
  // Of what is drawn twice at one place, the last is seen.
  const last = new Map(all.map((pixel) => [pixel.slice(0, 2).join(), pixel]));
  return [...last.values()].filter((pixel) => !isThere(pixel) && !isHidden(pixel)).length;
}`;

/** What is wrong with a figure as it stands in the browser, beside the oracle for the state that it says. */
export async function wrong(tab, { name, numbers }) {
  const shown = await inFigure(tab, name, ({ dataset, now, link, numbers }) => ({
    at: JSON.parse(dataset.at), svg: now.svg, answer: now.answer, link: link.href.split('/').pop(),
    numbers: Object.fromEntries(numbers.map(({ shown, value }) => [value, shown.textContent])),
  }));
  const right = await expected(name, shown.at);
  const values = Object.fromEntries(numbers.map((number) => [number, right.values[number]]));
  const wrong = [];
  for (const [what, is, should] of [
    ['the numbers in the prose', shown.numbers, values],
    ['the picture', shown.svg, right.svg],
    ['the words', shown.answer, right.answer],
    ['the link', shown.link, `playground.html${right.link}`],
  ]) {
    try {
      assert.deepEqual(is, should);
    } catch {
      wrong.push(`${name}: ${what} at ${JSON.stringify(shown.at)}`);
    }
  }
  // What is on the screen: each pixel has its colour somewhere in its corners, which lines and letters leave free.
  const clip = await inFigure(tab, name, (figure) => {
    const svg = figure.view.shown[0].frame.querySelector('svg');
    svg.scrollIntoView({ block: 'center', behavior: 'instant' });
    const { left, top, width, height } = svg.getBoundingClientRect();
    return { x: left + scrollX, y: top + scrollY, width, height, scale: 1 };
  });
  const { data } = await tab.call('Page.captureScreenshot', { clip });
  const spots = right.grips.map(({ spot }) => spot);
  const lost = await tab.value(`(${lostPixels(pixels)})(...${JSON.stringify([right.svg, data, spots])})`);
  return lost > 0 ? [...wrong, `${name}: ${lost} pixels are not on the screen`] : wrong;
}

export const fileName = (address) => path.basename(new URL(address).pathname);
