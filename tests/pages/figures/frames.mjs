import assert from 'node:assert/strict';

import { answer, gripOf, inFigure } from '../driver/figures.mjs';
import { layouts, p95, RATES, workOfFrames } from '../driver/frames.mjs';

/** For the page: moves a grip in a circle for 120 frames; how often the figure was drawn, and what was between two frames. */
async function drag(figure, x, y) {
  const next = () => new Promise(requestAnimationFrame);
  const { frame } = figure.view.shown[0], once = figure.draw, boxOf = frame.getBoundingClientRect, gaps = [], heights = [];
  let [drawn, boxes] = [0, 0];
  frame.getBoundingClientRect = () => {
    boxes += 1;
    return boxOf.call(frame);
  };
  figure.draw = () => {
    drawn += 1;
    once.call(figure);
  };
  for (let i = 0, last = await next(); i < 120; i += 1) {
    const move = { clientX: x + 60 * Math.sin(i / 12), clientY: y + 60 * Math.cos(i / 12) - 60, pointerId: 1, pointerType: 'mouse', bubbles: true };
    frame.dispatchEvent(new PointerEvent('pointermove', move));
    const now = await next();
    gaps.push(now - last);
    heights.push(figure.clientHeight);
    last = now;
  }
  delete figure.draw;
  delete frame.getBoundingClientRect;
  return { drawn, boxes, shrinks: heights.filter((high, i) => high < heights[i - 1]).length, gaps: gaps.sort((a, b) => a - b) };
}

export default {
  says: 'A grip of a figure that is dragged draws the figure once for each move, asks for no layout, and what stands below stays there; the page is laid out once at most for each frame',
  page: 'made figures en',
  async check(tab) {
    await tab.call('Performance.enable');
    for (const [name, rate] of RATES.flatMap((rate) => ['one-sample', 'weights', 'row-span'].map((name) => [name, rate]))) {
      await tab.call('Emulation.setCPUThrottlingRate', { rate: 1 });
      await tab.open();
      await answer(tab, name);
      const [x, y] = await gripOf(tab, name, 0);
      await tab.mouse('mousePressed', [x, y]);
      await tab.call('Emulation.setCPUThrottlingRate', { rate });
      const before = await layouts(tab);
      const { work, result: { drawn, boxes, shrinks, gaps } } = await workOfFrames(tab, () => inFigure(tab, name, drag, x, y));
      const laidOut = (await layouts(tab)) - before;
      assert.equal(drawn, 120, name);
      assert.deepEqual([boxes, shrinks], [0, 0], `${name}: asked for the layout, or became lower`);
      assert(laidOut <= 1.1 * gaps.length, `${name}: laid out ${laidOut} times in ${gaps.length} frames`);
      console.log(`${name}, the processor made ${rate} times as slow: 95 of a hundred frames come within ${
        p95(gaps)} ms and take ${p95(work)} ms of the processor; laid out ${laidOut} times`);
    }
  },
};
