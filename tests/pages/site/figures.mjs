import assert from 'node:assert/strict';

import { inSite } from '../driver/site.mjs';

/** For the page, before any script: withholds the first answer of the engines, as on a slow line, and notes what moves. */
const held = () => {
  Object.defineProperty(globalThis, 'rasterproofEngines', {
    set(take) {
      window.release = (text) => take(text);
      window.held ??= [];
    },
    get() { return (text) => window.held.push(text); },
    configurable: true,
  });
  window.moved = [];
  const side = ({ x, y, width, height }) => [x, y, width, height].join();
  const place = ({ node, previousRect: from, currentRect: to }) =>
    `${node?.nodeName} ${node?.className ?? node?.textContent}: ${side(from)} to ${side(to)}`;
  const note = (list) => window.moved.push(...list.getEntries().map((entry) => [entry.value, ...entry.sources.map(place)]));
  new PerformanceObserver(note).observe({ type: 'layout-shift', buffered: true });
};

export default {
  says: 'Figures stand there before the engines are loaded, which are not before one comes near, and nothing moves when these have come',
  page: 'nothing',
  async check(tab) {
    await tab.call('Page.addScriptToEvaluateOnNewDocument', { source: `(${held})()` });
    let far = 0;
    for (const width of [360, 1280]) {
      for (const page of ['en/index.html', 'en/ch02.html', 'zh/ch06.html']) {
        await tab.resize(width, 740);
        await tab.go(inSite(page));
        await tab.draw();
        const [isFar, isAsked] = await tab.value(() => [document.querySelector('rp-figure').getBoundingClientRect().top > 2 * innerHeight, window.held !== undefined]);
        assert(!isFar || !isAsked, `${page} at ${width} px loads engines for a figure that is far away`);
        far += isFar;
        await tab.value('document.querySelector("rp-figure").scrollIntoView({ block: "center", behavior: "instant" })');
        await tab.when('window.held?.length === 1');
        const first = await tab.value(() => {
          const { shadowRoot: root } = document.querySelector('rp-figure');
          return [root.querySelector('.stage svg') !== null, root.querySelector('.controls').childElementCount > 0, root.querySelector('.waits') === null];
        });
        assert.deepEqual(first, [true, true, true], page);
        await tab.value('(release(held[0]), 0)');
        await tab.when('document.querySelector("rp-figure").exports !== undefined');
        await tab.draw();
        const moved = await tab.value('window.moved');
        const sum = moved.reduce((sum, [value]) => sum + value, 0);
        assert(sum < 0.02, `${page} at ${width} px moves by ${sum}: ${JSON.stringify(moved)}`);
      }
    }
    assert(far > 0, 'no figure is far away');
  },
};
