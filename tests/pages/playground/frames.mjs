import assert from 'node:assert/strict';

import { grip } from '../driver/playground.mjs';

/** Moves the pointer 120 times, a frame each; the seconds. */
async function move(x, y) {
  const next = () => new Promise(requestAnimationFrame);
  const { frame: canvas } = view.shown[0];
  frames.length = 0;
  const begun = await next();
  for (let i = 0; i < 120; i += 1) {
    const at = { clientX: x - i / 2, clientY: y + i, pointerId: 1, pointerType: 'mouse', bubbles: true };
    canvas.dispatchEvent(new PointerEvent('pointermove', at));
    await next();
  }
  return (await next() - begun) / 1000;
}

export default {
  // The rate is of this machine with all else that runs on it; the processor time of a frame is the page's own, script, layout and
  // painting: below 16.7 ms it keeps up with 60 frames a second. Both are printed, not judged.
  says: 'A corner that is dragged at 64 x 64 pixels with four panels is drawn in each frame',
  page: 'playground #t=3.5,2.5_60.25,10.5_20.5,60.5&window=0,0,64,64&by=scanline,exclusive-edges,oracle,games101-strict',
  async check(tab) {
    await tab.settle();
    assert.equal(await tab.value('view.shown.length'), 4);
    const [x, y] = await grip(tab, 0, 'B');
    await tab.mouse('mousePressed', [x, y]);
    await tab.call('Performance.enable', { timeDomain: 'threadTicks' });
    const processor = async () => (await tab.call('Performance.getMetrics')).metrics.find(({ name }) => name === 'TaskDuration').value;
    const before = await processor();
    const seconds = await tab.value(move, x, y);
    const taken = (await processor()) - before, frames = await tab.value('frames.length');
    assert(frames >= 110, `a frame for each move: ${frames}`);
    assert(await tab.value('state.triangles[0][1].x < 55'), 'the corner followed');
    console.log(`playground: 64 x 64 pixels, four panels: ${(121 / seconds).toFixed()} frames a second while dragging, ${
      ((1000 * taken) / frames).toFixed(1)} ms of processor time a frame`);
  },
};
