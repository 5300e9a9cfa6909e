import assert from 'node:assert/strict';

import { grip } from '../driver/playground.mjs';

/** For the page: moves the pointer in each of 120 frames, and tells what that made. */
async function drag(x, y) {
  const next = () => new Promise(requestAnimationFrame);
  const { frame } = view.shown[0];
  const table = $('look').querySelector('table'), once = ask, asked = [], gaps = [];
  ask = (question) => {
    asked.push(question.ask);
    return once(question);
  };
  frames.length = 0;
  for (let i = 0, last = await next(); i < 120; i += 1) {
    const move = { clientX: x - i / 2, clientY: y + i, pointerId: 1, pointerType: 'mouse', bubbles: true };
    // Two moves of one frame.
    frame.dispatchEvent(new PointerEvent('pointermove', { ...move, clientX: move.clientX + 1 }));
    frame.dispatchEvent(new PointerEvent('pointermove', move));
    const now = await next();
    gaps.push(now - last);
    last = now;
  }
  ask = once;
  gaps.sort((a, b) => a - b);
  const count = (kind) => asked.filter((one) => one === kind).length;
  return { drawn: frames.length, draws: count('draw'), looks: count('look'), isKept: table.isConnected, p95: gaps[113] };
}

export default {
  // The times are printed and not judged, since they depend on all else that runs on this machine.
  says: 'A corner that is dragged at 64 x 64 pixels with four panels, on a processor made four times as slow, is drawn once for each frame, and explained ten times a second by one table',
  page: 'playground #t=3.5,2.5_60.25,10.5_20.5,60.5&window=0,0,64,64&by=scanline,exclusive-edges,oracle,games101-strict',
  async check(tab) {
    await tab.settle();
    assert.equal(await tab.value('view.shown.length'), 4);
    const [x, y] = await grip(tab, 0, 'B');
    await tab.mouse('mousePressed', [x, y]);
    await tab.call('Emulation.setCPUThrottlingRate', { rate: 4 });
    await tab.call('Performance.enable', { timeDomain: 'threadTicks' });
    const measured = async () => {
      const { metrics } = await tab.call('Performance.getMetrics');
      return ['TaskDuration', 'LayoutCount'].map((wanted) => metrics.find(({ name }) => name === wanted).value);
    };
    const before = await measured();
    const { drawn, draws, looks, isKept, p95 } = await tab.value(drag, x, y);
    const [processor, layouts] = (await measured()).map((value, i) => value - before[i]);
    assert(drawn >= 110 && draws === drawn, `${drawn} frames, ${draws} pictures`);
    assert(looks > 0 && looks < drawn / 2, `${looks} explanations in ${drawn} frames`);
    assert(isKept, 'the table beside is another one');
    // Nothing reads the layout after it has changed something.
    assert(layouts < 1.5 * drawn, `laid out ${layouts} times`);
    assert(await tab.value('state.triangles[0][1].x < 55'), 'the corner followed');
    console.log(`playground at a fourth of the speed: 64 x 64 pixels, four panels: p95 of a frame ${p95.toFixed(1)} ms, ${
      ((1000 * processor) / drawn).toFixed(1)} ms of it on the processor in the mean, ${looks} explanations`);
  },
};
