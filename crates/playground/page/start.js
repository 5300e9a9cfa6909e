// The whole: draws a scene anew, and starts the page.

function drawAll() {
  document.documentElement.lang = state.lang === 'zh' ? 'zh-CN' : 'en';
  for (const element of document.querySelectorAll('[data-word]')) element.textContent = word(element.dataset.word);
  $('scenes').setAttribute('aria-label', word('scenes'));
  $('tools').setAttribute('aria-label', word('tools'));
  fill($('scenes'), Object.keys(SCENES).map((name) => button(word(name), () => { begin(name); drawAll(); }, { 'aria-pressed': name === state.scene, id: `scene-${name}` })));
  $('about').textContent = WORDS[state.lang].about[state.scene];
  $('keys').textContent = viewWords().keys;
  view.speak();
  cornersFor = '';
  hunt = null;
  drawTools();
  drawBreak();
  redraw();
}

function start() {
  instantiate(new WebAssembly.Module(bytesOf($('module').textContent.trim())));
  names = ask({ ask: 'list' });
  restore(location.hash);
  drawAll();
  $('language').addEventListener('click', () => { state.lang = state.lang === 'en' ? 'zh' : 'en'; drawAll(); });
  const copied = (text) => ({ target }) => copyText(text(), target, word('copied'));
  $('copy').addEventListener('click', copied(() => $('command').textContent));
  $('copy-address').addEventListener('click', copied(() => new URL(address(), location.href).href));
  $('reset').addEventListener('click', () => { begin(state.scene); drawAll(); });
  addEventListener('hashchange', () => { restore(location.hash); drawAll(); });
  document.body.dataset.ready = '';
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', redraw);
}

start();
