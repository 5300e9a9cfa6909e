// Runs the checks: asks the module for batches, lets the interface draw them, and has the module judge the pixels.

const state = { lang: 'en', seed: 1, running: false };
const APIS = { webgl2: openWebgl2, webgpu: openWebgpu };
const TITLES = { webgl2: 'WebGL 2', webgpu: 'WebGPU' };
const WORST = ['equal', 'allowed', 'outside'];

function must(answer) {
  if (answer.error) throw new Error(answer.error);
  return answer;
}

/** What the module is told of the device. WebGPU promises no lattice, so there half a pixel is all that positions are held to. */
const deviceOf = (api, check) => ({
  interface: api.name, bits: check === 'lattice' && api.name === 'webgpu' ? 1 : Math.min(api.bits ?? 1, 8), samples_apart: api.apart,
});

/** The pixels of a picture that the module asked for; of the check for repeatability those of two drawings, by turns. */
async function drawn(api, check, picture) {
  const pixels = await api.draw({ ...picture, check });
  if (check !== 'twice') return pixels;
  const again = await api.draw({ ...picture, check });
  return Uint8Array.from({ length: 2 * pixels.length }, (_, i) => (i % 2 ? again : pixels)[i >> 1]);
}

/** Draws a batch and has it judged; `what` is {check, number} or {check, only}. */
async function judged(api, what, tally = {}) {
  const batch = { device: deviceOf(api, what.check), seed: state.seed, ...what };
  const pixels = await drawn(api, what.check, must(ask({ ask: 'gpu-batch', ...batch })));
  return must(ask({ ask: 'gpu-judge', batch, tally }, pixels));
}

/** From a case that fails to the smallest that is found in some seconds. */
async function shrunk(api, check, subject) {
  const batch = { check, device: deviceOf(api, check), seed: state.seed };
  const question = { ask: 'gpu-smaller', batch, tally: {} };
  const end = performance.now() + 10000;
  let picture = must(ask({ ...question, batch: { ...batch, only: subject }, pixels: '' }));
  while (picture.subjects > 0 && state.running && performance.now() < end) {
    picture = must(ask(question, await drawn(api, check, picture)));
  }
  return (await judged(api, { check, only: picture.smallest })).view;
}

/** Checks of pixels, for which a cause is looked for. */
const OF_PIXELS = ['lattice', 'coverage', 'reach', 'tiling', 'order'];

/** Why pixels are wrong: the module asks for triangles, picture by picture, until it knows or gives up. */
async function causeOf(api, title) {
  const batch = { check: 'coverage', device: deviceOf(api, 'coverage'), seed: state.seed };
  const question = { ask: 'gpu-cause', batch, tally: {} };
  let reply = must(ask({ ...question, pixels: '' }));
  for (let at = 1; reply.cause === undefined; at += 1) {
    if (!state.running) return null;
    await tell(word('asking')(title, at));
    reply = must(ask(question, await api.draw(reply)));
  }
  return reply;
}

/** What was judged of an interface so far. The browser keeps it, so that a page that was closed goes on from there. */
const keptBy = (name) => `rasterproof-your-gpu-${name}`;

/** What the browser's memory answers; nothing where it keeps nothing: then the page judges all the same. */
function inMemory(act) {
  try {
    return act(localStorage);
  } catch {
    return null;
  }
}

/** What was kept of the same batches on the same renderer. */
function keptBefore(name, of) {
  const before = inMemory((memory) => JSON.parse(memory.getItem(keptBy(name))));
  return before?.of === of ? before : null;
}

const keep = (name, judged) => inMemory((memory) => memory.setItem(keptBy(name), JSON.stringify(judged)));

/** Says what is done, and lets the page draw it. */
async function tell(text, part = 1) {
  state.progress = { text, part };
  drawProgress();
  await new Promise((done) => { setTimeout(done, 0); });
}

/** Judges one interface into a result; draws the page as it goes. An address may ask for one check alone, a test for some batches on a lattice that it knows. */
async function judgeApi(name, { check: alone = null, only, bits = null, shrinks = true }) {
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
  const { refused, renderer, isSoftware, notes = [] } = api;
  Object.assign(result, { title: TITLES[name], refused, renderer, isSoftware, notes: [...notes] });
  if (refused) return;
  const plan = must(ask({ ask: 'gpu-plan' }));
  const batches = plan.batches.filter(({ check, number: n }) => (
    (!alone || check === alone) && (!only || only.some(([c, i]) => c === check && i === n))));
  // The lattice on which the other checks put their cases is a check of its own.
  if (alone && api.bits === null) api.bits = (await judged(api, { check: 'lattice', number: 0 })).facts.bits;
  const start = performance.now();
  let losses = 0;
  readBack.uneven = 0;
  const of = JSON.stringify([state.seed, renderer, $('module').textContent.length, batches]);
  const before = keptBefore(name, of);
  if (before) {
    Object.assign(result, { rows: before.rows, bits: before.bits });
    api.bits ??= before.bits;
    result.notes.push(['resumed', before.at]);
  }
  for (let at = before?.at ?? 0; at < batches.length && state.running; at += 1) {
    const { check, number } = batches[at];
    await tell(word('progress')(result.title, word('checks')[check], at + 1, batches.length), at / batches.length);
    if (!api.offers(check)) {
      result.rows[check] = { word: 'not-offered' };
      continue;
    }
    try {
      const before = result.rows[check];
      const answer = await judged(api, { check, number }, before?.tally);
      // The first case of a kind is kept.
      result.rows[check] = { ...answer, broken: before?.broken ?? answer.broken, free: before?.free ?? answer.free };
      if (check === 'lattice' && name === 'webgpu') {
        api.bits = answer.facts.bits;
        result.bits = api.bits;
      }
      keep(name, { of, at: at + 1, rows: result.rows, bits: result.bits });
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
  inMemory((memory) => memory.removeItem(keptBy(name)));
  result.seconds = (performance.now() - start) / 1000;
  for (const [check, row] of Object.entries(result.rows)) {
    result.triangles += check === 'lines' || check === 'twice' ? 0 : (row.tally?.shapes ?? 0) * (check === 'order' ? 6 : 1);
  }
  if (readBack.uneven > 0) result.notes.push(['uneven', readBack.uneven]);
  if (!state.running) result.notes.push(['stopped']);
  if (!shrinks || losses > 1) return;
  const { free: differ = 0, broken: differWrongly = 0 } = result.rows.twice?.tally ?? {};
  // What is found in one drawing is not true of the next: then nothing is made smaller or explained.
  const changes = differ + differWrongly > 0;
  try {
    for (const [check, { broken, free }] of Object.entries(result.rows)) {
      if (!state.running || !(broken || free)) continue;
      await tell(word('shrinking')(result.title, word('checks')[check]));
      result.views[check] = broken && !changes
        ? await shrunk(api, check, broken) : (await judged(api, { check, only: broken ?? free })).view;
    }
    if (!changes && OF_PIXELS.some((check) => result.rows[check]?.word === 'outside')) result.cause = await causeOf(api, result.title);
  } catch (error) {
    if (!(error instanceof Lost)) throw error;
    result.notes.push(['lostAgain', error.message, batches.length]);
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
  Object.assign(state, { running: false, progress: null, shown: firstBroken(state.results) });
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
    const { word: verdict, view, facts } = await judged(api, { check, only: subject });
    state.results = [{ name, title: TITLES[name], renderer: api.renderer, rows: {}, views: { [check]: view }, notes: [] }];
    Object.assign(state.one, { verdict, view, facts });
    state.shown = [0, check];
  } catch (error) {
    state.one.error = error.message;
  }
  Object.assign(state, { running: false, progress: null });
  document.body.dataset.done = '';
  drawAll();
}
