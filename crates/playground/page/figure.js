// Live figures: <rp-figure scene="NAME"> around a still picture with its caption. The compiled engines draw and judge
// (crates/wasm/src/figures); this script inserts what they answer and passes on what the reader does. They are
// loaded before the first figure comes into view, from engines.js beside this script, which calls
// rasterproofEngines with the module in base64: so it works from disk, too. data-playground on the script's own
// element names the page of the playground, if that is not playground.html beside it. A <script type="application/json">
// before a figure holds their first answer, with its pictures on a light and on a dark page: with it the question is there before the engines are.
// A figure that is `open` begins with its answer.
import { arrowOf, button, make, say } from './dom.js';

const WORDS = {
  en: {
    check: 'Check', show: 'Show the answer', again: 'Ask me again', open: 'The same in the playground', number: 'Your number',
    mark: 'Mark the pixels, then check. ', drag: 'Drag the blue points, or move them by arrow keys: ', pixel: (x, y) => `column ${x}, row ${y}`,
    right: 'Right.', missed: (n) => `not marked but right: ${n}`, wrong: (n) => `marked but wrong: ${n}`, no: (right) => `No: ${right}.`,
    lost: 'The live figure could not be loaded; this is its picture.',
  },
  zh: {
    check: '检查', show: '显示答案', again: '再问我一次', open: '在试验场中打开', number: '你的数',
    mark: '标出像素，然后检查。', drag: '拖动蓝点，或用方向键移动：', pixel: (x, y) => `第 ${x} 列，第 ${y} 行`,
    right: '对。', missed: (n) => `漏标：${n}`, wrong: (n) => `错标：${n}`, no: (right) => `不对，是 ${right}。`,
    lost: '互动图无法载入，这里是它的静态图。',
  },
};
const STYLE = `
  :host { display: block; margin: 1.5em 0; color-scheme: light; }
  .whole { margin: 0 auto; max-width: 34em; border: 1px solid #8885; border-radius: 8px; padding: 0.7em; box-sizing: border-box; }
  p { margin: 0.4em 0; }
  :is(.question, .verdict) { font-weight: 600; margin-top: 0; }
  :host([data-dark]) { color-scheme: dark; }
  rp-view { touch-action: manipulation; }
  rp-view .frame { border-color: transparent; justify-self: center; }
  rp-view:not(.is-wide) { position: relative; }
  rp-view:not(.is-wide) .view-tools { position: absolute; right: 0; bottom: -3em; margin: 0; }
  rp-view:not(.is-wide) .view-tools > :not([data-tool=enlarge]), rp-view figcaption { display: none; }
  .stage.waits { aspect-ratio: 360 / 240; background: #8882; }
  rp-view .frame > button:hover { background: #0b57d033; }
  rp-view .frame > button[aria-pressed=true] { background: #0b57d055; box-shadow: inset 0 0 0 3px #0b57d0; }
  rp-view .mark { pointer-events: none; box-shadow: inset 0 0 0 3px #0b57d0; }
  rp-view .mark.no { box-shadow: inset 0 0 0 3px #b3261e; }
  .controls { display: flex; flex-wrap: wrap; gap: 0.4em; align-items: center; margin: 0.5em 2.5em 0.5em 0; min-height: 2.4em; }
  .controls button { text-align: start; min-height: 2.4em; }
  .controls input { width: 5.5em; box-sizing: border-box; }
  .verdict:empty, .hint:empty, .answer:empty { display: none; }
  .hint, .links { font-size: 0.9em; opacity: 0.85; }
  a { color: inherit; }
  @media print { .whole { display: none; } slot[hidden] { display: contents !important; } }
`;
const own = document.currentScript;
const beside = (name) => new URL(name, own.src).href;

let module = null;
/** The compiled engines, loaded once for all figures. */
const loaded = () => (module ??= new Promise((resolve, reject) => {
  globalThis.rasterproofEngines = resolve;
  document.head.append(make('script', { src: beside('engines.js'), onerror: reject }));
}).then((text) => WebAssembly.compile(bytesOf(text))).then(instantiate));

/** Whether the page around an element is dark, whatever made it so. */
function isDark(element) {
  for (let e = element; e; e = e.parentElement) {
    const [r, g, b, a = 1] = getComputedStyle(e).backgroundColor.match(/[\d.]+/g)?.map(Number) ?? [0, 0, 0, 0];
    if (a > 0.5) return 0.3 * r + 0.6 * g + 0.1 * b < 128;
  }
  return matchMedia('(prefers-color-scheme: dark)').matches;
}

// A screen before it is seen.
const watching = new IntersectionObserver((entries) => {
  for (const { isIntersecting, target } of entries) {
    if (!isIntersecting) continue;
    watching.unobserve(target);
    target.begin();
  }
}, { rootMargin: '100% 0px' });
const live = new Set();

// A text that a drag changes keeps the lines that it once had: the page below it stays where it is.
const keepingLines = new ResizeObserver((entries) => {
  for (const { target, contentRect } of entries) target.style.minHeight = `${contentRect.height}px`;
});
addEventListener('resize', () => {
  for (const { question, says } of live) for (const text of [question, says]) text.style.minHeight = '';
});

/** The numbers in the prose of the page that belong to a figure, each behind a comment `n NAME.VALUE`. */
function numbersOf(name) {
  const comments = document.createTreeWalker(document.body, NodeFilter.SHOW_COMMENT);
  const found = [];
  while (comments.nextNode()) {
    const [, of, value] = comments.currentNode.data.match(/^n ([\w-]+)\.(\w+)$/) ?? [];
    if (of === name) found.push({ comment: comments.currentNode, value });
  }
  return found.map(({ comment, value }) => {
    const shown = make('span', { className: 'follows' }, comment.nextSibling);
    comment.after(shown);
    return { shown, value };
  });
}

const redraw = () => {
  for (const figure of live) {
    figure.isDark = isDark(figure);
    figure.draw();
  }
};
new MutationObserver(redraw).observe(document.documentElement, { attributes: true, attributeFilter: ['class', 'data-theme', 'style'] });
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', redraw);

class Figure extends HTMLElement {
  connectedCallback() {
    if (this.shadowRoot) return;
    this.language = (this.closest('[lang]')?.lang ?? '').startsWith('zh') ? 'zh' : 'en';
    this.words = WORDS[this.language];
    this.question = make('p', { className: 'question', id: 'question', textContent: this.querySelector('strong')?.textContent ?? '' });
    this.view = make('rp-view');
    this.stage = make('div', { className: 'stage waits' }, this.view);
    this.controls = make('div', { className: 'controls' });
    this.verdict = make('p', { className: 'verdict', role: 'status' });
    this.says = make('p', { className: 'answer', 'aria-live': 'polite' });
    this.hint = make('p', { className: 'hint' });
    this.link = make('a', { textContent: this.words.open });
    this.links = make('p', { className: 'links', hidden: true }, this.link);
    this.figure = make('figure', { className: 'whole', 'aria-labelledby': 'question' },
      this.question, this.stage, this.controls, this.verdict, this.says, this.hint, this.links);
    this.still = make('slot', { hidden: true });
    this.attachShadow({ mode: 'open' }).append(make('style', { textContent: VIEW_STYLE + STYLE }), this.figure, this.still);
    this.at = [];
    this.covers = [];
    this.isAnswered = this.hasAttribute('open');
    watching.observe(this);
    for (const text of [this.question, this.says]) keepingLines.observe(text);
    const before = this.previousElementSibling;
    if (!before?.matches('script[type="application/json"]')) return;
    this.first = JSON.parse(before.textContent);
    live.add(this);
    this.begun();
  }

  /** Loads the engines; whether they are there. */
  async begin() {
    try {
      this.exports ??= await loaded();
      live.add(this);
      if (this.first) this.draw();
      else this.begun();
      return true;
    } catch (error) {
      live.delete(this);
      console.warn(`rp-figure ${this.getAttribute('scene')}: ${error?.message ?? 'engines.js could not be loaded'}`);
      this.figure.replaceChildren(make('p', { className: 'hint', textContent: this.words.lost }));
      this.still.hidden = false;
      return false;
    }
  }

  /** Draws the beginning. */
  begun() {
    this.draw();
    if (this.isAnswered) this.answered('');
    else this.invite();
  }

  /** What the engines make of where the grips are, or, as long as they are not there, have made of the beginning. */
  answer() {
    if (!this.exports) return { ...this.first, svg: this.first.svg[Number(this.isDark)] };
    return ask({
      ask: 'figure', name: this.getAttribute('scene'), language: this.language, at: this.at, is_answered: this.isAnswered, is_dark: this.isDark,
    });
  }

  /** Draws the figure for where its grips are. */
  draw() {
    this.isDark ??= isDark(this);
    this.toggleAttribute('data-dark', this.isDark);
    const answer = this.answer();
    if (answer.error) throw new Error(answer.error);
    this.now = answer;
    this.at = answer.at;
    // What is shown is for these positions: the test compares both.
    this.dataset.at = JSON.stringify(answer.at);
    this.stage.classList.remove('waits');
    say(this.question, answer.question);
    say(this.says, this.isAnswered ? answer.answer : '');
    this.link.href = (own.dataset.playground ?? beside('playground.html')) + answer.link + (this.language === 'zh' ? '&lang=zh' : '');
    if (this.isAnswered) this.numbers ??= numbersOf(this.getAttribute('scene'));
    for (const { shown, value } of this.numbers ?? []) say(shown, answer.values[value]);
    this.show();
  }

  /** The picture with what lies on it; before the answer nothing can be dragged. */
  show() {
    const { svg, alt } = this.now;
    const part = svg.match(/viewBox="([^"]*)"/)[1].split(' ').map(Number);
    this.view.show({
      part, bounds: part, high: this.hasAttribute('open') ? 0.27 : 9, title: alt, isPicture: true, covers: this.covers,
      panels: [{ key: 'sheet', label: alt, svg, view: 'sheet' }],
      grips: () => (this.isAnswered ? figureGrips(this.now.grips, (i, value) => this.move(i, value)) : []),
    });
  }

  /** Puts elements over pixels of the picture, each given by its corner and its side. */
  cover(elements, cells) {
    this.covers.push(...elements.map((element, i) => ({ element, x: cells[i][0], y: cells[i][1], width: cells[i][2], height: cells[i][2] })));
    this.view.shown[0].frame.append(...elements);
    this.show();
  }

  uncover() {
    for (const { element } of this.covers) element.remove();
    this.covers = [];
    this.verdict.textContent = '';
  }

  /** Asks for a prediction: nothing else can be done before. */
  invite() {
    const { predict } = this.now;
    this.uncover();
    this.controls.replaceChildren();
    this.links.hidden = true;
    this.hint.textContent = predict.kind === 'pixels' ? this.words.mark : '';
    const show = button(this.words.show, () => this.reveal(''));
    if (predict.kind === 'pixels') {
      const cells = predict.cells.map((cell, i) => make('button', {
        type: 'button', tabIndex: i === 0 ? 0 : -1, 'aria-pressed': 'false', 'aria-label': this.words.pixel(cell[3], cell[4]),
      }));
      cells.forEach((cell, i) => {
        cell.addEventListener('click', () => cell.setAttribute('aria-pressed', String(cell.getAttribute('aria-pressed') !== 'true')));
        cell.addEventListener('keydown', (event) => this.walk(event, cells, i));
      });
      this.cover(cells, predict.cells);
      this.controls.append(button(this.words.check, () => this.judgePixels(cells)), show);
    } else if (predict.kind === 'choice') {
      this.controls.append(...predict.options.map((option, i) => button(option, () => {
        this.reveal(i === predict.right ? this.words.right : this.words.no(predict.options[predict.right]));
      })), show);
    } else {
      const input = make('input', { type: 'number', step: 'any', inputMode: 'decimal', 'aria-label': this.words.number });
      const judge = () => {
        if (input.value === '') { input.focus(); return; }
        const right = Number(input.value).toFixed(predict.decimals) === predict.right;
        this.reveal(right ? this.words.right : this.words.no(predict.right));
      };
      input.addEventListener('keydown', (event) => { if (event.key === 'Enter') judge(); });
      this.controls.append(input, button(this.words.check, judge), show);
    }
  }

  /** Arrow keys go from pixel to pixel. */
  walk(event, buttons, i) {
    const step = arrowOf(event);
    if (!step) return;
    const { cells } = this.now.predict;
    const next = cells.findIndex((cell) => cell[3] === cells[i][3] + step[0] && cell[4] === cells[i][4] + step[1]);
    if (next < 0) return;
    buttons[i].tabIndex = -1;
    buttons[next].tabIndex = 0;
    buttons[next].focus();
  }

  async judgePixels(buttons) {
    const { right, cells } = this.now.predict;
    const marked = buttons.map((button) => button.getAttribute('aria-pressed') === 'true');
    const wrong = marked.filter((mark, i) => mark && !right[i]).length;
    const missed = marked.filter((mark, i) => !mark && right[i]).length;
    const says = [wrong && this.words.wrong(wrong), missed && this.words.missed(missed)].filter(Boolean).join(', ');
    await this.reveal(says ? `${says}.` : this.words.right);
    const is = cells.flatMap((cell, i) => (marked[i] ? [[cell, right[i]]] : []));
    this.cover(is.map(([, isRight]) => make('div', { className: isRight ? 'mark' : 'mark no' })), is.map(([cell]) => cell));
  }

  /** Shows the answer with what is said about the prediction; from now on the grips can be dragged. */
  async reveal(verdict) {
    if (!this.exports && !await this.begin()) return;
    this.isAnswered = true;
    this.draw();
    this.answered(verdict);
    this.controls.lastElementChild.focus({ preventScroll: true });
  }

  /** What stands below the answer. */
  answered(verdict) {
    this.uncover();
    this.verdict.textContent = verdict;
    const names = this.now.grips.map((grip) => grip.name).join(this.language === 'zh' ? '、' : ', ');
    this.hint.textContent = `${this.words.drag}${names}${this.language === 'zh' ? '。' : '.'}`;
    this.links.hidden = false;
    this.controls.replaceChildren(button(this.words.again, () => {
      this.isAnswered = false;
      this.draw();
      this.invite();
      this.stage.querySelector('.frame button')?.focus();
    }));
  }

  move(i, value) {
    if (!this.exports) return;
    this.at = this.at.map((old, k) => (k === i ? value : old));
    this.uncover();
    this.draw();
  }
}

customElements.define('rp-figure', Figure);
