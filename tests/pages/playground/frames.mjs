import assert from 'node:assert/strict';

import { layouts, p95, workOfFrames } from '../driver/frames.mjs';
import { grip, show } from '../driver/playground.mjs';

/** For the page: moves the pointer in each of 120 frames, and tells what that made. */
async function drag(x, y) {
  const next = () => new Promise(requestAnimationFrame);
  const { frame } = view.shown[0];
  const table = $('look').querySelector('table'), once = [ask, drawFrame], asked = [], gaps = [];
  ask = (question) => {
    asked.push(question.ask);
    return once[0](question);
  };
  let drawn = 0;
  drawFrame = () => {
    drawn += 1;
    once[1]();
  };
  for (let i = 0, last = await next(); i < 120; i += 1) {
    const move = { clientX: x - i / 2, clientY: y + i, pointerId: 1, pointerType: 'mouse', bubbles: true };
    // Two moves of one frame.
    frame.dispatchEvent(new PointerEvent('pointermove', { ...move, clientX: move.clientX + 1 }));
    frame.dispatchEvent(new PointerEvent('pointermove', move));
    const now = await next();
    gaps.push(now - last);
    last = now;
  }
  [ask, drawFrame] = once;
  const count = (kind) => asked.filter((one) => one === kind).length;
  return { drawn, draws: count('draw'), looks: count('look'), isKept: table.isConnected, gaps: gaps.sort((a, b) => a - b) };
}

const CORNERS = '#t=3.5,2.5_60.25,10.5_20.5,60.5&window=0,0,64,64&by=scanline,exclusive-edges,oracle,games101-strict';

export default {
  says: 'A corner that is dragged at 64 x 64 pixels with four panels is drawn once for each frame, explained ten times a second by one table, and lays the page out no more often than it says something',
  page: `playground ${CORNERS}`,
  async check(tab) {
    await tab.call('Performance.enable');
    for (const rate of [4, 1]) {
      await show(tab, CORNERS);
      assert.equal(await tab.value('view.shown.length'), 4);
      const [x, y] = await grip(tab, 0, 'B');
      await tab.mouse('mousePressed', [x, y]);
      await tab.call('Emulation.setCPUThrottlingRate', { rate });
      const before = await layouts(tab);
      const { work, result: { drawn, draws, looks, isKept, gaps } } = await workOfFrames(tab, () => tab.value(drag, x, y));
      const laidOut = (await layouts(tab)) - before;
      assert(drawn >= 110 && draws === drawn, `${drawn} frames, ${draws} pictures`);
      assert(isKept, 'the table beside is another one');
      assert(await tab.value('state.triangles[0][1].x < 55'), 'the corner followed');
      console.log(`playground, the processor made ${rate} times as slow, 64 x 64 pixels, four panels: 95 of a hundred frames come within ${
        p95(gaps)} ms and take ${p95(work)} ms of the processor; ${looks} explanations, laid out ${laidOut} times`);
      // Frames of a slow machine are few in a second, of which each may say something.
      if (rate > 1) assert(looks > 0 && looks < drawn, `${looks} explanations in ${drawn} frames`);
      else assert(looks > 0 && looks < drawn / 2 && laidOut < 0.75 * drawn, `${looks} explanations, laid out ${laidOut} times in ${drawn} frames`);
      await tab.mouse('mouseReleased', [x, y]);
      await tab.call('Emulation.setCPUThrottlingRate', { rate: 1 });
    }
  },
};
