// What a page takes of the processor in each frame. The times are printed and not judged: they depend on the machine.

/** Runs `act`; what the main thread of the page worked for each frame of it, in milliseconds of the thread, the least first. */
export async function workOfFrames(tab, act) {
  const events = [], hear = tab.hear;
  let end;
  const complete = new Promise((done) => { end = done; });
  tab.hear = (message) => {
    if (message.method === 'Tracing.dataCollected') events.push(...message.params.value);
    else if (message.method === 'Tracing.tracingComplete') end();
    else hear.call(tab, message);
  };
  await tab.call('Tracing.start', { categories: 'devtools.timeline,disabled-by-default-devtools.timeline', transferMode: 'ReportEvents' });
  const result = await act();
  await tab.call('Tracing.end');
  await complete;
  tab.hear = hear;
  const { pid, tid } = events.find(({ name }) => name === 'FireAnimationFrame');
  const own = events.filter((event) => event.ph === 'X' && event.pid === pid && event.tid === tid).sort((a, b) => a.ts - b.ts);
  const outer = own.filter(({ name }) => name === 'RunTask');
  // A frame ends with the task that hands it over.
  const work = [0];
  for (const task of outer) {
    work[work.length - 1] += task.tdur / 1000;
    if (own.some(({ name, ts }) => name === 'Commit' && ts >= task.ts && ts < task.ts + task.dur)) work.push(0);
  }
  return { result, work: work.slice(1, -1).sort((a, b) => a - b) };
}

/** How many times as slow the processor is made: four times only for who asks for times, since a loaded machine takes too long for that. */
export const RATES = process.env.RASTERPROOF_TIMES ? [4, 1] : [1];

/** The value that 95 of a hundred do not exceed. */
export const p95 = (sorted) => sorted[Math.floor(0.95 * sorted.length)].toFixed(1);

/** How often the page was laid out so far. */
export async function layouts(tab) {
  const { metrics } = await tab.call('Performance.getMetrics');
  return metrics.find(({ name }) => name === 'LayoutCount').value;
}
