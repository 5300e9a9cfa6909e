// What checks of accessibility have in common: axe-core, which is one of the packages of the site.

import fs from 'node:fs';
import path from 'node:path';

import { ROOT } from './program.mjs';

/**
 * For the page: applies every rule that axe-core applies by default, and returns a line for each element that breaks one.
 *
 * Judging the contrast of a text takes long, and a page may show thousands of coloured words of code. Words of the same class
 * look the same, so one of each class in a code block is judged, and the others lose their colour.
 */
async function violations() {
  for (const block of document.querySelectorAll('pre code')) {
    const seen = new Set();
    for (const word of block.querySelectorAll('span')) {
      const look = `${word.className} in ${word.parentElement.className}`;
      if (seen.has(look)) word.replaceWith(...word.childNodes);
      seen.add(look);
    }
    block.normalize();
  }
  const { violations } = await axe.run(document, { resultTypes: ['violations'], preload: false });
  return violations.flatMap(({ id, nodes }) => nodes.map(({ target, any, all, none }) =>
    `${id}: ${target.join(' ')}: ${[...any, ...all, ...none].map(({ message }) => message).join('; ')}`));
}

/** Puts axe-core on every page that the tab opens from now on. */
export async function withAxe(tab) {
  const axe = fs.readFileSync(path.join(ROOT, 'target/site-tools/node_modules/axe-core/axe.min.js'), 'utf8');
  await tab.call('Page.addScriptToEvaluateOnNewDocument', { source: axe });
}

/** What is wrong on the page that is open, each line with the name of this view. */
export async function violationsOf(tab, view) {
  await tab.draw();
  return (await tab.value(violations)).map((violation) => `${view}: ${violation}`);
}

/** Gives the tab the width of a window and the colours that its reader prefers; their name. */
export async function look(tab, [width, scheme]) {
  await tab.resize(width, 900);
  await tab.prefer('prefers-color-scheme', scheme);
  return `${width} px, ${scheme}`;
}

/** A phone in light colours and a desktop in dark ones, in turn. */
export function inTurn(tab) {
  let turn = 0;
  return () => {
    turn += 1;
    return look(tab, turn % 2 === 1 ? [360, 'light'] : [1280, 'dark']);
  };
}

/** Opens everything on a page that opens. */
export const unfold = (tab) => tab.value('document.querySelectorAll("details").forEach(part => { part.open = true; })');
