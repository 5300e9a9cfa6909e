import assert from 'node:assert/strict';

import { layouts, p95, RATES, workOfFrames } from '../driver/frames.mjs';
import { grip, show } from '../driver/playground.mjs';

/**
 * For the page: moves the pointer in each of 120 frames, and counts what that made. A page `isBusy` where no frame leaves time for anything,
 * and where painting one panel takes as long as a frame may.
 */
async function drag(x, y, isBusy) {
  const next = () => new Promise(requestAnimationFrame);
  const { frame } = view.shown[0], boxOf = frame.getBoundingClientRect;
  const once = [ask, drawFrame, view.paintPanel], idle = window.requestIdleCallback, now = performance.now;
  const asked = [], painted = view.shown.map(() => 0), gaps = [];
  let [drawn, boxes, late] = [0, 0, 0];
  ask = (question) => {
    asked.push(question.ask);
    return once[0](question);
  };
  drawFrame = () => {
    drawn += 1;
    once[1]();
  };
  view.paintPanel = (shown) => {
    painted[view.shown.indexOf(shown)] += 1;
    once[2].call(view, shown);
  };
  frame.getBoundingClientRect = () => {
    boxes += 1;
    return boxOf.call(frame);
  };
  const waiting = [];
  if (isBusy) {
    window.requestIdleCallback = (act) => waiting.push(act);
    performance.now = () => now.call(performance) + (late += 10);
  }
  for (let i = 0, last = await next(); i < 120; i += 1) {
    const move = { clientX: x - i / 2, clientY: y + i / 2, pointerId: 1, pointerType: 'mouse', bubbles: true };
    // Two moves of one frame.
    frame.dispatchEvent(new PointerEvent('pointermove', { ...move, clientX: move.clientX + 1 }));
    frame.dispatchEvent(new PointerEvent('pointermove', move));
    const now = await next();
    gaps.push(now - last);
    last = now;
  }
  [ask, drawFrame] = once;
  Object.assign(window, { requestIdleCallback: idle });
  performance.now = now;
  delete view.paintPanel;
  delete frame.getBoundingClientRect;
  const counts = { drawn, draws: asked.filter((one) => one === 'draw').length, looks: asked.filter((one) => one === 'look').length, painted: [...painted] };
  for (const act of waiting) requestIdleCallback(act);
  return { ...counts, boxes, late: view.waiting.size, gaps: gaps.sort((a, b) => a - b) };
}

const EXPLAINED = 'document.querySelector("#look").textContent';
const HEAVIEST = '#t=3.5,2.5_60.25,10.5_20.5,60.5&window=0,0,64,64&by=scanline,exclusive-edges,oracle,games101-strict';

/** Drags a corner of a scene on a processor that is made so many times as slow. */
async function dragged(tab, address, rate, isBusy) {
  await show(tab, address);
  const [x, y] = await grip(tab, 0, 'B'), explained = await tab.value(EXPLAINED);
  await tab.value('window.before = document.querySelector("#look table"), 0');
  await tab.mouse('mousePressed', [x, y]);
  await tab.call('Emulation.setCPUThrottlingRate', { rate });
  const before = await layouts(tab);
  const { work, result } = await workOfFrames(tab, () => tab.value(drag, x, y, isBusy));
  const laidOut = (await layouts(tab)) - before;
  await tab.call('Emulation.setCPUThrottlingRate', { rate: 1 });
  await tab.mouse('mouseReleased', [x, y]);
  await tab.settle();
  assert(await tab.value('document.querySelector("#look table") === window.before'), 'the table beside is another one');
  assert.notEqual(await tab.value(EXPLAINED), explained, 'explained at last');
  assert.equal(await tab.value('view.waiting.size'), 0, 'all is painted at last');
  console.log(`${address}, the processor made ${rate} times as slow: 95 of a hundred frames come within ${
    p95(result.gaps)} ms and take ${p95(work)} ms of the processor; ${result.looks} explanations, laid out ${laidOut} times`);
  return { ...result, laidOut };
}

export default {
  says: 'A corner that is dragged is drawn once for each frame without asking for the layout; what is said of it waits until frames leave time, and panels that have no time take turns',
  page: 'playground',
  async check(tab) {
    await tab.call('Performance.enable');
    for (const address of ['#', HEAVIEST]) {
      for (const rate of RATES) {
        // Frames of a slow machine are few in a second, and each may leave time to say something.
        const { drawn, draws, looks, boxes, laidOut } = await dragged(tab, address, rate, false);
        assert(drawn >= 110 && draws === drawn, `${drawn} frames, ${draws} pictures`);
        assert.equal(boxes, 0, 'asked for the layout');
        assert(looks <= drawn && laidOut < 2.5 * drawn, `${looks} explanations, laid out ${laidOut} times in ${drawn} frames`);
      }
    }
    const { drawn, looks, laidOut, painted, late } = await dragged(tab, HEAVIEST, 1, true);
    assert.deepEqual([looks, late], [0, 3], 'explained, or painted, where there is no time');
    assert(laidOut < 0.1 * drawn, `laid out ${laidOut} times in ${drawn} frames`);
    assert(painted.length === 4 && painted.every((times) => Math.abs(times - drawn / 4) < 3), `${painted} of ${drawn}`);
  },
};
