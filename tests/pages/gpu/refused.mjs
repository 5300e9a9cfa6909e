import assert from 'node:assert/strict';

import { rows, SWIFTSHADER } from '../driver/gpu.mjs';

const NO_GPU = 'Object.defineProperty(Navigator.prototype, "gpu", { value: undefined })';
const NO_GL = 'HTMLCanvasElement.prototype.getContext = () => null';
// What is taken away, of which interface, and what the page says.
const REFUSED = [
  ['Object.getPrototypeOf(navigator.gpu).requestAdapter = async () => null', 'webgpu', 'gave no adapter'],
  ['GPUAdapter.prototype.requestDevice = async () => { throw new Error("limits") }', 'webgpu', 'refused to make a device (limits)'],
  [NO_GPU, 'webgpu', 'has no WebGPU'],
  [NO_GL, 'webgl2', 'gives no WebGL 2'],
];

export default {
  says: 'An interface that is missing or refused is said, and the other one is judged; with neither the page says what to do',
  page: 'your-gpu #lang=en',
  options: SWIFTSHADER,
  async check(tab) {
    const options = { only: [['coverage', 3]], bits: 4, shrinks: false };
    for (const [take, api, says] of REFUSED) {
      await tab.open('#lang=en');
      await tab.value(`(${take}, null)`);
      const judged = await rows(tab, null, options);
      const shown = await tab.text(`[data-api=${api}]`);
      assert(shown.includes(says), `${take}: ${shown}`);
      const [refused, other] = api === 'webgpu' ? judged.reverse() : judged;
      assert.deepEqual(refused, {}, take);
      assert.equal(other.coverage[0], 'equal', take);
      assert(!(await tab.text('#results')).includes('Nothing could be judged'), take);
    }
    await tab.open('#lang=en');
    await tab.value(`(${NO_GL}, ${NO_GPU}, null)`);
    await rows(tab, null, options);
    assert.match(await tab.text('#results'), /Turn on hardware acceleration/);
  },
};
