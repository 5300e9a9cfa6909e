import assert from 'node:assert/strict';

import { pageOf, PROGRAM, reportOf, run } from '../driver/program.mjs';
import { data } from '../driver/report.mjs';

/** The sentences of the summary that state a cause. */
const causesOf = (tab) => tab.value(() => [...document.querySelectorAll('h3.caption')]
  .filter((head) => head.textContent.startsWith('probable cause')).map((head) => head.nextElementSibling.textContent));

export default {
  says: 'The cause stands at the top of a page as in the terminal, the summary says the same one, and blinking begins with what was drawn',
  page: 'verify --cases 60 --plant inclusive-edges --report --json',
  size: [400, 800],
  async check(tab) {
    // On a phone two pictures blink, and the first is not the oracle. The clock stands still, however long it takes to ask.
    await tab.call('Page.addScriptToEvaluateOnNewDocument', { source: 'window.setInterval = () => 0' });
    await tab.open();
    assert.deepEqual([await data(tab, 'mode'), await data(tab, 'phase')], ['blink', 'A']);
    assert.match(await tab.text('rp-view figcaption'), /^A ?inclusive-edges/);
    const cause = /is not right\. It samples at the pixel's centre and draws everything on an edge/;
    assert.match((await pageOf('verify --cases 60 --plant inclusive-edges --report')).printed.out.replace(/\s+/g, ' '), cause);
    assert.match(await tab.text('#verdict'), cause);
    for (const subject of ['games101-strict', 'exclusive-edges']) {
      const printed = run(['judge', '--cases', '20', '--report', '--', PROGRAM, 'engine', subject]);
      assert.equal(printed.status, 1, printed.errors);
      await tab.open('', reportOf('judge', printed));
      const [, said] = (await tab.text('#verdict')).match(/is not right: (.*)$/);
      const sentence = said[0].toUpperCase() + said.slice(1);
      const causes = await causesOf(tab);
      assert(causes.some((cause) => cause.startsWith(sentence)), `${subject}: '${sentence}' is none of ${causes.join('\n')}`);
      assert(!(await tab.text('body')).includes('in no fixed way'), subject);
    }
  },
};
