import assert from 'node:assert/strict';

import { plantOn, SWIFTSHADER } from '../driver/gpu.mjs';

/** For the page: judges six batches, of which so many are drawn, and counts them. */
function judgeSome(most) {
  const open = APIS.webgl2;
  window.pictures = 0;
  APIS.webgl2 = async () => {
    const api = await open();
    const draw = api.draw.bind(api);
    api.draw = (...picture) => {
      window.pictures += 1;
      return window.pictures > most ? new Promise(() => {}) : draw(...picture);
    };
    return api;
  };
  judgeAll({ names: ['webgl2'], only: [0, 1, 2, 3, 4, 5].map((number) => ['coverage', number]), shrinks: false });
  return null;
}

export default {
  says: 'A page that is closed goes on where it was when it is opened again, and comes to the same',
  page: 'your-gpu #lang=en',
  options: SWIFTSHADER,
  async check(tab) {
    const rows = () => tab.value('JSON.stringify(state.results[0].rows)');
    const judge = async (most) => {
      await plantOn(tab, 'nudged');
      await tab.value(judgeSome, most);
    };
    await judge(1e9);
    await tab.when('!state.running');
    const expected = await rows();
    await tab.open('#lang=en');
    await judge(4);
    await tab.when('window.pictures === 5');
    await tab.open('#lang=en');
    await judge(1e9);
    await tab.when('!state.running');
    assert.equal(await rows(), expected);
    assert.equal(await tab.value('window.pictures'), 2);
    const notes = await tab.value('state.results[0].notes.map(said)');
    assert.equal(notes.at(-1), 'The page was closed before: the first 4 batches were judged then.');
    // What came to its end is judged anew.
    await tab.open('#lang=en');
    await judge(1e9);
    await tab.when('!state.running');
    assert.deepEqual([await rows(), await tab.value('window.pictures')], [expected, 6]);
  },
};
