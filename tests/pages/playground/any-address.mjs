import assert from 'node:assert/strict';

import { show } from '../driver/playground.mjs';

const REFUSED = [
  '#scene=triangle&window=0,0,300,300',
  '#scene=triangle&window=5,5,5,5',
  '#scene=line&window=0,0,-1e9,4',
  '#scene=triangle&t=0,0_1e9,0_0,1e300',
  '#scene=line&lines=0,0,1e300,5',
  '#case=no-such-case',
  '#case=sliver%23-1&seed=x',
  '#scene=culling&removes=everything',
  '#scene=weights&snap=0',
];
const TAKEN = [
  '#scene=near&points=null&near=[]',
  '#scene=near&points=[[1,2,3],[1,2,null],[1]]&near="x"',
  '#scene=line&step={}',
  '#scene=constructor&lang=__proto__',
  '#scene=triangle&by=nobody&px=1e300,nan&snap=x&numbers=2',
  '#scene=triangle&t=;;_&window=a,b,c,d',
  '#%%%&&=&scene',
];

export default {
  says: 'An address may hold anything: what cannot be drawn is said, the scene is shown as it begins, and nothing is thrown',
  page: 'playground',
  async check(tab) {
    for (const address of [...REFUSED, ...TAKEN]) {
      await show(tab, `${address}&lang=en`);
      assert.deepEqual(await tab.value('[view.shown.length > 0, last.answer?.error ?? null]'), [true, null], address);
      const trouble = await tab.text('#trouble');
      assert.equal(trouble.includes('cannot be shown'), REFUSED.includes(address), `${address}: ${trouble}`);
    }
  },
};
