// The program whose pages are checked, the pages that it writes, and what its own engines answer.

import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import readline from 'node:readline';
import { fileURLToPath } from 'node:url';

export const { RASTERPROOF: PROGRAM, FOLDER } = process.env;
export const ROOT = fileURLToPath(new URL('../../..', import.meta.url));
export const SITE = path.join(ROOT, 'target/site');

/** Why a check cannot be made here. */
export class Missing extends Error {}

/** What is missing is an error where it is demanded, as in CI. */
export function missing(what, variable) {
  throw variable in process.env ? new Error(what) : new Missing(what);
}

const answers = readline.createInterface({ input: process.stdin })[Symbol.asyncIterator]();

/** What this program's own engines answer, or the page or the folder that the tests make for a name. */
export async function ours(question) {
  console.log(`?${JSON.stringify(question)}`);
  return JSON.parse((await answers.next()).value);
}

let folders = 0;

/** An empty folder, which stays until the next run. */
export function folder() {
  folders += 1;
  const made = path.join(FOLDER, String(folders));
  fs.mkdirSync(made, { recursive: true });
  return made;
}

/** Runs the program with words, in a folder of its own or in this one: its status, what it printed, and the folder. */
export function run(words, cwd = folder()) {
  const list = Array.isArray(words) ? words : words.split(' ').map((word) => (word === 'PROGRAM' ? PROGRAM : word));
  const { status, stdout, stderr } = spawnSync(PROGRAM, list, { cwd, encoding: 'utf8', maxBuffer: 1 << 28 });
  assert(!stderr.includes('panicked'), stderr);
  return { status, out: stdout, errors: stderr, folder: cwd };
}

/** The report that a run of this command wrote. */
export const reportOf = (command, { folder }) => path.join(folder, `target/rasterproof/${command}.html`);

const runs = new Map();

/** The same for words that were run before: a page is written once for all checks of it. */
function runOnce(words) {
  if (!runs.has(words)) runs.set(words, run(words));
  return runs.get(words);
}

function engines() {
  const module = path.join(ROOT, 'target/rasterproof/playground.wasm');
  if (!fs.existsSync(module)) missing(`no ${module}: run crates/playground/build`, 'RASTERPROOF_NEEDS_PLAYGROUND');
  return module;
}

/** The file of a page, and the run that wrote it. */
export async function pageOf(words) {
  const [first, ...rest] = words.split(' ');
  switch (first) {
    case 'made': {
      if (rest[0] === 'figures') engines();
      return { file: await ours({ page: rest.join(' ') }) };
    }
    case 'site': {
      const file = path.join(SITE, rest[0]);
      assert(fs.existsSync(file), `no ${file}: run docs/build`);
      return { file };
    }
    case 'playground':
    case 'your-gpu': {
      const printed = runOnce(`${first} --module ${engines()}`);
      assert.equal(printed.out, `${first}: target/rasterproof/${first}.html\n`, printed.errors);
      return { file: reportOf(first, printed), printed };
    }
    default: {
      const printed = runOnce(words);
      return { file: reportOf(first, printed), printed };
    }
  }
}
