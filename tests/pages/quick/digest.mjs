import assert from 'node:assert/strict';

import { answersAlike, both } from '../driver/playground.mjs';
import { ours } from '../driver/program.mjs';

export default {
  says: 'The compiled engines draw 1,000 hazards as the program does: spans of both engines and the oracle, values to the last bit, lines',
  page: 'playground',
  async check(tab) {
    const question = { ask: 'digest', seed: 1, cases: 1000 };
    const own = await answersAlike(tab, question, 'run crates/playground/build again after a change of the engines');
    assert(own.fragments > 100_000, `${own.fragments}`);
    // The comparison can fail: other cases have another digest.
    const [other] = await both(tab, { ...question, seed: 2 });
    assert.notEqual(other.digest, own.digest);
    // Named cases too, by everybody that the page offers.
    const by = await tab.value('names.triangles.map(e => e.name)');
    for (const name of ['T1', 'T2', 'T6', 'T8', 'S11', 'O3']) {
      const { picture } = await ours({ ask: 'named', name });
      await answersAlike(tab, { ask: 'draw', picture, by }, name);
    }
  },
};
