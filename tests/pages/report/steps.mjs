import assert from 'node:assert/strict';

import { namesListed, VERDICT } from '../driver/report.mjs';

export default {
  says: 'The next and the previous case are a key away, and an address that leads nowhere says so',
  page: VERDICT,
  async check(tab) {
    const names = await namesListed(tab);
    assert.equal(await tab.text('#case-title'), names[0]);
    for (const [key, at] of [['n', 1], ['n', 2], ['p', 1], ['p', 0], ['p', names.length - 1]]) {
      await tab.press(key);
      await tab.when((name) => document.body.dataset.ready === name, names[at]);
      assert.equal(await tab.text('#place'), `${at + 1} of ${names.length}`);
    }
    for (const [fragment, lost, at] of [
      ['#no-such', 'This page has no place called no-such', names[0]],
      ['#case-T2&a=nobody', 'Nobody called nobody draws this case', 'T2'],
      ['#case-T2&mode=fast', 'There is no way to compare called fast', 'T2'],
      ['#case-T2&px=99,0', 'This case has no pixel 99,0', 'T2'],
      ['#case-no%20such&mode=side', 'This page has no case called no such', names[0]],
    ]) {
      await tab.open(fragment);
      assert.equal(await tab.text('#lost'), `${lost}; this is ${at}.`);
      assert.equal(await tab.value('document.querySelector("#lost").hidden'), false);
    }
    await tab.press('n');
    await tab.when('document.querySelector("#lost").hidden');
  },
};
