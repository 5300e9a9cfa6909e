// Runs the checks: asks the module for batches, lets the interface draw them, and has the module judge the pixels.

const state = { lang: 'en', plant: null, seed: 1, running: false };
const APIS = { webgl2: openWebgl2, webgpu: openWebgpu };
const WORST = ['promised', 'free', 'broken'];

function must(answer) {
  if (answer.error) throw new Error(answer.error);
  return answer;
}

/** What the module is told of the device. WebGPU promises no lattice, so there half a pixel is all that positions are held to. */
const deviceOf = (api, check) => ({
  interface: api.name, bits: check === 'lattice' && api.name === 'webgpu' ? 1 : Math.min(api.bits ?? 1, 8), samples_apart: api.apart,
});

/** Draws a batch and has it judged; `what` is {check, number} or {check, only} or {check, smaller}. */
async function judged(api, what, tally = {}) {
  const batch = { device: deviceOf(api, what.check), seed: state.seed, ...what };
  const drawn = must(ask({ ask: 'gpu-batch', ...batch }));
  const pixels = await api.draw({ ...drawn, check: what.check }, state.plant);
  return must(ask({ ask: 'gpu-judge', batch, tally }, pixels));
}

/** Whether a batch drawn again has the same pixels; those that differ are counted. */
async function drawnTwice(api, what) {
  const drawn = must(ask({ ask: 'gpu-batch', device: deviceOf(api, what.check), seed: state.seed, ...what }));
  const first = await api.draw(drawn, state.plant);
  const second = await api.draw(drawn, state.plant);
  if (state.plant === 'noise') second[Math.floor(second.length / 3)] ^= 1;
  const differ = first.reduce((sum, byte, i) => sum + Number(byte !== second[i]), 0);
  return { word: differ ? (api.name === 'webgl2' ? 'broken' : 'free') : 'promised', tally: { differ, pixels: first.length }, facts: null };
}

/** From a case that fails to the smallest that is found: of the smaller ones the first that still fails, again and again. */
async function shrunk(api, check, subject) {
  let smallest = subject;
  for (let steps = 0; steps < 400; steps += 1) {
    const { broken } = await judged(api, { check, smaller: smallest });
    if (!broken) break;
    smallest = broken;
  }
  return (await judged(api, { check, only: smallest })).view;
}

const breathe = () => new Promise((done) => { setTimeout(done, 0); });

/** Judges one interface into a result; draws the page as it goes. A test may ask for some batches alone, on a lattice that it knows. */
async function judgeApi(name, { only, bits = null, shrinks = true }) {
  const result = { name, rows: {}, views: {}, notes: [], triangles: 0 };
  state.results.push(result);
  const open = async () => {
    const api = await APIS[name]();
    if (api.refused) return api;
    // A new context knows what the old one found.
    api.bits ??= result.bits ?? bits;
    return api;
  };
  let api = await open();
  Object.assign(result, { title: { webgl2: 'WebGL 2', webgpu: 'WebGPU' }[name], refused: api.refused });
  if (api.refused) return;
  Object.assign(result, { renderer: api.renderer, isSoftware: api.isSoftware, apart: api.apart });
  result.notes.push(...api.notes);
  const plan = must(ask({ ask: 'gpu-plan' }));
  const batches = plan.batches.filter(({ check, number: n }) => !only || only.some(([c, i]) => c === check && i === n));
  const start = performance.now();
  let losses = 0;
  for (let at = 0; at < batches.length && state.running; at += 1) {
    const { check, number } = batches[at];
    state.progress = { text: word('progress')(result.title, word('checks')[check], at + 1, batches.length), part: at / batches.length };
    drawProgress();
    await breathe();
    if (!api.offers(check)) {
      result.rows[check] = { word: 'not-offered' };
      continue;
    }
    try {
      if (state.plant === 'lost' && at === Math.min(7, batches.length - 1) && losses === 0) api.lose();
      const before = result.rows[check];
      const answer = await judged(api, { check, number }, before?.tally);
      // The first case of a kind is kept.
      result.rows[check] = { ...answer, broken: before?.broken ?? answer.broken, free: before?.free ?? answer.free };
      if (check === 'lattice' && name === 'webgpu') {
        api.bits = answer.facts.bits;
        result.bits = api.bits;
      }
      if (check === 'coverage' && number === 0) result.rows.twice = await drawnTwice(api, { check, number });
    } catch (error) {
      if (!(error instanceof Lost)) throw error;
      losses += 1;
      result.notes.push([losses === 1 ? 'lostOnce' : 'lostAgain', error.message, at + 1]);
      if (losses > 1) break;
      api = await open();
      if (api.refused) {
        result.notes.push(api.refused);
        break;
      }
      at -= 1;
    }
  }
  result.seconds = (performance.now() - start) / 1000;
  for (const [check, row] of Object.entries(result.rows)) {
    result.triangles += check === 'lines' ? 0 : (row.tally?.shapes ?? 0) * (check === 'order' ? 6 : 1);
  }
  if (!state.running) result.notes.push(['stopped']);
  for (const [check, { broken, free }] of Object.entries(result.rows)) {
    if (!shrinks || losses > 1 || !(broken || free)) continue;
    state.progress = { text: word('shrinking')(result.title, word('checks')[check]), part: 1 };
    drawProgress();
    await breathe();
    try {
      result.views[check] = broken ? await shrunk(api, check, broken) : (await judged(api, { check, only: free })).view;
    } catch (error) {
      if (!(error instanceof Lost)) throw error;
      result.notes.push(['lostAgain', error.message, batches.length]);
      break;
    }
  }
}

/** Judges both interfaces. */
async function judgeAll({ names = Object.keys(APIS), ...options } = {}) {
  if (state.running) return;
  Object.assign(state, { running: true, results: [], one: null, shown: null });
  delete document.body.dataset.done;
  drawAll();
  for (const name of names) {
    try {
      if (state.running) await judgeApi(name, options);
    } catch (error) {
      state.results.at(-1).notes.push(['failed', error.message]);
    }
  }
  Object.assign(state, { running: false, progress: null });
  document.body.dataset.done = '';
  drawAll();
}

/** Draws the one case of an address. */
async function judgeOne({ name, check, subject }) {
  Object.assign(state, { running: true, results: [], one: { name, check }, shown: null });
  drawAll();
  try {
    const api = await APIS[name]();
    if (api.refused) throw new Error(said(api.refused));
    if (api.bits === null) api.bits = (await judged(api, { check: 'lattice', number: 0 })).facts.bits;
    const { word: verdict, view } = await judged(api, { check, only: subject });
    state.results = [{ name, title: api.title, renderer: api.renderer, rows: {}, views: { [check]: view }, notes: [] }];
    Object.assign(state.one, { verdict, view });
    state.shown = [0, check];
  } catch (error) {
    state.one.error = error.message;
  }
  Object.assign(state, { running: false, progress: null });
  document.body.dataset.done = '';
  drawAll();
}
