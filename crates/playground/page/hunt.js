// Break it: named and random cases, the search and the shrinking.

let hunt = null;

function load(found, from) {
  if (found.error) { trouble(found.error); return; }
  const { picture: drawn } = found;
  const kind = drawn.lines?.length ? 'line' : 'triangle';
  const by = state.scene === kind ? state.by : undefined;
  if (state.scene !== kind) { begin(kind); drawAll(); }
  forget();
  const { window, snap } = drawn;
  const places = kind === 'line' ? { lines: drawn.lines } : { triangles: drawn.triangles };
  Object.assign(state, by && { by }, places, from, { window, snap, chosen: 0, px: middle(window), step: 999, own: window });
  if ($('named')) {
    $('named').value = from.named ?? '';
    $('named-about').textContent = about(entry(from.named ?? ''));
  }
  pointAtWrong(state.by?.at(-1));
  redraw();
}

const middle = ([x0, y0, x1, y1]) => [Math.floor((x0 + x1) / 2), Math.floor((y0 + y1) / 2)];

/** The entry that a list of the engines calls `name`. */
const entry = (name) => Object.values(names).flat().find((one) => one.name === name) ?? { name };

/** A list to choose from, with a line below that says what the choice is about. */
function choice(id, label, options, value, act = () => {}) {
  const tell = (name) => { says.textContent = about(entry(name)); act(name); };
  const says = make('p', { id: `${id}-about`, className: 'quiet' }, about(entry(value)));
  const list = select(options, value, tell, { id, 'aria-describedby': `${id}-about` });
  return { list, parts: [make('label', { htmlFor: id }, label), list, says] };
}

function drawBreak() {
  if (!scene().breaks) { fill($('break'), []); return; }
  const { families, who, defaults } = scene().breaks();
  const options = (list) => list.map(({ name }) => name);
  const named = choice('named', word('named'), [['', word('choose')], ...options([...names.named, ...names.recorded])], state.named ?? '', (name) => {
    if (name) load(ask({ ask: 'named', name }), { named: name });
  });
  const by = select(who, defaults.by, () => {}, { id: 'who' });
  const { list: family, parts } = choice('family', word('family'), options(families), defaults.family);
  const says = make('p', { id: 'hunt', role: 'status' });
  const show = (found, index) => {
    load(found, { generated: { family: family.value, seed: 1, index } });
    if (!state.by.includes(by.value)) { state.by[state.by.length - 1] = by.value; redraw(); }
    pointAtWrong(by.value);
  };
  fill($('break'), [
    make('h2', { id: 'break-title' }, word('breakIt')),
    make('div', { className: 'form' }, ...named.parts, make('label', { htmlFor: 'who' }, word('who')), by, ...parts),
    make('p', {},
      button(word('search'), () => search(by.value, family.value, says, show), { id: 'search' }), ' ',
      button(word('random'), () => {
        const index = Math.floor(Math.random() * 1e6);
        show(ask({ ask: 'generated', family: family.value, seed: 1, index }), index);
        says.textContent = `${family.value}#${index}`;
      }, { id: 'random' }), ' ',
      button(word('shrink'), () => shrink(by.value, says), { id: 'shrink' }), ' ',
      button(word('stop'), () => { hunt = null; }, { id: 'stop' })),
    says,
  ]);
}

/** Points at the pixel nearest to the middle that somebody gets wrong, so that the column beside explains it; says
 * whether there is one. */
function pointAtWrong(by) {
  if (!state.triangles) return false;
  const { panels, truth } = ask({ ask: 'draw', picture: picture(), by: [by] });
  const hits = panels?.[0]?.hits ?? '';
  const [x0, y0, x1] = state.window;
  const [cx, cy] = middle(state.window);
  const far = ([x, y]) => Math.hypot(x - cx, y - cy);
  const wrong = [...hits].flatMap((count, i) => (count === truth[i] ? [] : [[x0 + (i % (x1 - x0)), y0 + Math.floor(i / (x1 - x0))]]));
  if (wrong.length === 0) return false;
  state.px = wrong.reduce((best, px) => (far(px) < far(best) ? px : best));
  redraw();
  return true;
}

/** Looks at some cases a frame, so that the page stays alive, until one is caught or somebody says stop. */
function search(by, family, says, show) {
  const mine = {};
  hunt = mine;
  const begun = Math.floor(Math.random() * 1e6);
  let from = begun;
  const slice = () => {
    if (hunt !== mine) return;
    const until = performance.now() + 12;
    do {
      const answer = ask({ ask: 'search', by, family, seed: 1, from, count: 100 });
      if (answer.error) { says.textContent = answer.error; return; }
      from = answer.next;
      if (answer.found !== null) {
        hunt = null;
        show(answer, answer.found);
        shrink(by, says, word('caught', `${family}#${answer.found}`, from - begun));
        return;
      }
    } while (performance.now() < until);
    says.textContent = word('searched', from - begun);
    requestAnimationFrame(slice);
  };
  slice();
}

/** Plays the ever smaller cases, in some seconds however many they are; `caught` says where they come from. */
function shrink(by, says, caught = '') {
  const answer = ask({ ask: 'shrink', by, picture: picture() });
  if (answer.error) { says.textContent = answer.error; return; }
  const mine = {};
  hunt = mine;
  const calm = matchMedia('(prefers-reduced-motion: reduce)').matches;
  let at = calm ? answer.steps.length - 1 : 0;
  const next = () => {
    if (hunt !== mine) return;
    load({ picture: answer.steps[at] }, {});
    pointAtWrong(by);
    says.textContent = caught + word('shrunk', at);
    at += 1;
    if (at < answer.steps.length) setTimeout(next, at === 1 ? 800 : Math.min(250, 3000 / answer.steps.length));
    else hunt = null;
  };
  next();
}
