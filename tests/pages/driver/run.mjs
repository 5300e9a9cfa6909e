// Runs checks of pages, whose files are the arguments: `tests/it/page_checks.rs` does, and answers the lines that begin with `?`.
//
// A check exports by default what it is about: `says`, one sentence; `page`, what is opened; `size` of the window, 1280 x 900 where
// it says nothing; `options` of Chromium, or another `browser`; and `check`, which is given the tab and throws where the sentence
// is not true.
//
// A page is `made NAME`, which the tests write; `site PATH` in target/site; `playground` or `your-gpu` with the compiled engines; or
// the words of a command that writes a report. ` #...` at its end is the fragment of its address. `nothing` is no page.

import assert from 'node:assert/strict';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

import chromium from '../../../adapters/chromium.js';
import { Firefox } from './firefox.mjs';
import { Missing, missing, pageOf, ROOT } from './program.mjs';
import { Tab } from './tab.mjs';

/** Browsers by their options. */
const browsers = new Map();

async function newTab(options) {
  const key = options.join(' ');
  if (!browsers.has(key)) {
    if (!chromium.find()) missing("no Chromium: install Debian's package chromium", 'RASTERPROOF_NEEDS_CHROMIUM');
    const tabs = new Map();
    const heard = (message) => tabs.get(message.sessionId)?.hear(message);
    const start = ['--disable-dev-shm-usage', '--no-first-run', ...options];
    browsers.set(key, { send: chromium.start(start, heard), tabs });
  }
  const { send, tabs } = browsers.get(key);
  const tab = await Tab.of(send);
  tabs.set(tab.session, tab);
  return tab;
}

/** Makes one check: `ok`, or why it could not be made or fails. */
async function verdict(file) {
  const { says, page, size = [1280, 900], options = ['--disable-gpu'], browser, check } = (await import(pathToFileURL(file).href)).default;
  assert(says && page && check, `${file}: a check has \`says\`, \`page\` and \`check\``);
  const [words, fragment] = page.split(/ (?=#)/);
  let tab;
  try {
    const opened = words === 'nothing' ? {} : await pageOf(words);
    tab = browser === 'firefox' ? await Firefox.start() : await newTab(options);
    Object.assign(tab, opened);
    await tab.resize(...size);
    if (words.startsWith('site')) await tab.go(tab.file);
    else if (words !== 'nothing') await tab.open(fragment);
    await check(tab);
    assert.deepEqual(tab.complaints, [], 'the page complains');
  } catch (error) {
    if (error instanceof Missing) return `SKIPPED: ${error.message}`;
    isRight = false;
    return `FAILED. ${says}: this is not true.\n${error.stack}`;
  } finally {
    await tab?.close();
  }
  return 'ok';
}

let isRight = true;
for (const file of process.argv.slice(2)) {
  const start = Date.now();
  const said = await verdict(file);
  console.log(`${path.relative(ROOT, file)}: ${said} (${((Date.now() - start) / 1000).toFixed(1)} s)`);
}
process.exit(isRight ? 0 : 1);
