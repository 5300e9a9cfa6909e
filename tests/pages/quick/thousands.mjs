import assert from 'node:assert/strict';

export default {
  says: 'What is said below a picture has thousands apart',
  page: 'made marks #case-one',
  async check(tab) {
    assert.equal(await tab.text('#case-about'), '198 of 19,200 pixels differ');
  },
};
