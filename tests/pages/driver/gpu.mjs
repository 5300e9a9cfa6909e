// What checks of the page for GPUs have in common.

import assert from 'node:assert/strict';

/** Without a card Chromium draws WebGL by SwiftShader, and WebGPU where it is told to. */
export const SWIFTSHADER = ['--disable-gpu-sandbox', '--enable-unsafe-swiftshader', '--enable-unsafe-webgpu', '--use-webgpu-adapter=swiftshader'];

/**
 * The faults with the check that finds them, its batch, and its word for WebGL 2 and for WebGPU: what the specification leaves open
 * is found, and called free.
 */
export const PLANTS = [
  ['moved', 'lattice', 0, ['allowed', 'allowed']],
  ['coarse', 'lattice', 0, ['outside', 'allowed']],
  ['nudged', 'coverage', 0, ['outside', 'outside']],
  ['dropped', 'coverage', 3, ['outside', 'outside']],
  ['twice', 'coverage', 0, ['outside', 'outside']],
  ['nudged', 'reach', 0, ['outside', 'outside']],
  ['twice', 'tiling', 0, ['outside', 'outside']],
  ['first-corner', 'tiling', 0, ['outside', 'allowed']],
  ['first-corner', 'order', 0, ['outside', 'outside']],
  ['winding', 'facing', 0, ['outside', 'outside']],
  ['lines-moved', 'lines', 0, ['outside', 'allowed']],
  ['farther', 'depth', 0, ['outside', 'outside']],
  ['w-ignored', 'values', 0, ['outside', 'outside']],
  ['no-near-plane', 'near-plane', 0, ['outside', 'outside']],
  ['samples-moved', 'samples', 0, ['allowed', 'outside']],
];

const numbered = (check, count) => Array.from({ length: count }, (_, number) => [check, number]);

/** One batch of each check, and each family of coverage. */
export const PARTS = [
  ...['lattice', 'reach', 'tiling', 'order', 'facing', 'lines', 'depth', 'values', 'samples', 'twice'].map((check) => [check, 0]),
  ...numbered('coverage', 12),
  ...numbered('near-plane', 4),
];

/** Judges with a fault, or none; the rows of each interface as {check: [word, sentence]}. */
export async function rows(tab, plant, options) {
  await tab.value(`(state.plant = ${JSON.stringify(plant)}, judgeAll(${JSON.stringify(options)}), null)`);
  await tab.when('!state.running');
  const rows = await tab.value(`state.results.map(result => Object.fromEntries(Object.entries(result.rows).map(
    ([check, row]) => [check, [row.word, word('details')[check](row.tally, row.facts)]])))`);
  const notes = JSON.stringify(await tab.value('state.results.map(result => result.notes.map(said))'));
  assert(!notes.includes('The interface failed'), notes);
  return rows;
}

/** Whether each interface has a note of this kind. */
export const haveNote = (tab, kind) => tab.value(`state.results.map(r => r.notes.some(([key]) => key === '${kind}'))`);

/** Checks that everything is as promised or free, but for a corner in the plane w = 0, which one of the renderers does not draw. */
export async function isRight(tab, rows, api) {
  console.log(`${api}: ${JSON.stringify(rows)}`);
  assert.equal(Object.keys(rows).length, 12, `${api} answers every check`);
  for (const [check, [word, sentence]] of Object.entries(rows)) {
    const isKnown = check === 'near-plane' && await tab.value(
      `state.results.find(r => r.name === '${api}').rows['near-plane'].broken?.[0].some(v => v[3] === 0) === true`);
    assert(word !== 'outside' || isKnown, `${api}, ${check}: ${sentence}`);
  }
  for (const check of ['coverage', 'reach', 'tiling', 'order', 'facing', 'values', 'samples', 'twice']) {
    assert.equal(rows[check][0], 'equal', `${api}, ${check}`);
  }
}
