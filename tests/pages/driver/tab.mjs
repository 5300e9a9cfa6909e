// A tab of Chromium: it is opened, asked and touched, and what it complains of is collected.

import assert from 'node:assert/strict';
import { setTimeout as sleep } from 'node:timers/promises';
import { pathToFileURL } from 'node:url';

// An answer that takes longer never comes.
export const PATIENCE = 30_000;

// The key as the protocol takes it. What a key does by default needs its code.
const KEYS = {
  Tab: ['Tab', 9, ''], Enter: ['Enter', 13, '\r'], Escape: ['Escape', 27, ''], ' ': ['Space', 32, ' '],
  ArrowLeft: ['ArrowLeft', 37, ''], ArrowUp: ['ArrowUp', 38, ''], ArrowRight: ['ArrowRight', 39, ''], ArrowDown: ['ArrowDown', 40, ''],
};

/** The expression for a text, or for a function of the page and what it is called with. */
const expressionOf = (what, values) => (typeof what === 'function' ? `(${what})(...${JSON.stringify(values)})` : what);

/** What is asked of an open page, in whatever browser. `ask` answers an expression, and `undefined` where the page went away before. */
export class Questions {
  async value(what, ...values) {
    return this.ask(expressionOf(what, values));
  }

  /** Waits until an expression is true. */
  async when(what, ...values) {
    const expression = expressionOf(what, values), start = Date.now();
    while ((await this.ask(expression)) !== true) {
      assert(Date.now() - start < PATIENCE, `never true: ${expression}`);
      await sleep(30);
    }
  }

  text(selector) {
    return this.value((selector) => document.querySelector(selector).textContent, selector);
  }

  /** Clicks on the first element that a selector of CSS finds. */
  click(selector) {
    return this.value((selector) => document.querySelector(selector).click(), selector);
  }
}

export class Tab extends Questions {
  complaints = [];
  isOpened = false;

  /** A tab of its own profile in a browser, which `send` speaks to. */
  static async of(send) {
    const tab = new Tab();
    const { browserContextId } = await send('Target.createBrowserContext', {});
    const { targetId } = await send('Target.createTarget', { url: 'about:blank', browserContextId });
    const { sessionId } = await send('Target.attachToTarget', { targetId, flatten: true });
    tab.session = sessionId;
    const patiently = (method, parameters, session) => {
      const late = sleep(PATIENCE, null, { ref: false }).then(() => assert.fail(`the browser does not answer ${method}`));
      return Promise.race([send(method, parameters, session), late]);
    };
    tab.call = (method, parameters = {}) => patiently(method, parameters, sessionId);
    tab.close = () => patiently('Target.disposeBrowserContext', { browserContextId });
    for (const domain of ['Page', 'Runtime', 'Log']) await tab.call(`${domain}.enable`);
    return tab;
  }

  /** Keeps what the browser says of an error. */
  hear({ method, params }) {
    const isBad = method === 'Runtime.exceptionThrown'
      || (method === 'Runtime.consoleAPICalled' && ['error', 'warning', 'assert'].includes(params.type))
      || (method === 'Log.entryAdded' && params.entry.level === 'error');
    if (isBad) this.complaints.push(JSON.stringify(params));
  }

  /** A promise is waited for. */
  async ask(expression) {
    let answer;
    try {
      answer = await this.call('Runtime.evaluate', { expression, awaitPromise: true, returnByValue: true });
    } catch (error) {
      if (/navigated|context/.test(error.message)) return undefined;
      throw error;
    }
    assert(!answer.exceptionDetails, `${expression}: ${JSON.stringify(answer.exceptionDetails)}`);
    return answer.result.value;
  }

  /** Opens a file, with a fragment such as `#case-T2`, and waits until its case is drawn. */
  async open(fragment = '', file = this.file) {
    // A page with another fragment would not be loaded again.
    if (this.isOpened) await this.call('Page.navigate', { url: 'about:blank' });
    this.isOpened = true;
    this.file = file;
    await this.call('Page.navigate', { url: pathToFileURL(file).href + fragment });
    await this.when(() => document.readyState === 'complete'
      && (document.body.dataset.ready !== undefined || document.querySelector('#cases')?.hidden === true));
  }

  /** Goes to a page that nobody's script makes ready, as those of the site. */
  async go(file) {
    const url = pathToFileURL(file).href;
    this.isOpened = true;
    await this.call('Page.navigate', { url });
    // The first page of the site leads on by a script, after which nothing may be asked of it.
    const leadsOn = /site\/index\.html$/.test(url);
    await this.when((url, leadsOn) => document.readyState === 'complete' && !(leadsOn && location.href === url), url, leadsOn);
  }

  /** Gives the window a size, and waits until the page has been told and drawn at it. */
  async resize(width, height) {
    await this.call('Emulation.setDeviceMetricsOverride', { width, height, deviceScaleFactor: 1, mobile: false });
    await this.when((width, height) => innerWidth === width && innerHeight === height, width, height);
    await this.draw();
  }

  /** Waits for two frames: what was asked before has been handled and laid out in the first. */
  draw() {
    return this.value('new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))');
  }

  /** Two frames later everything that was asked for is drawn, and soon after it is explained; a page that can tells when. */
  async settle() {
    await this.draw();
    await sleep(150);
    await this.when(() => typeof isStill !== 'function' || isStill());
  }

  prefer(name, value) {
    return this.call('Emulation.setEmulatedMedia', { features: [{ name, value }] });
  }

  /** With Shift (8) or Alt (1) held. */
  async press(key, modifiers = 0) {
    const [code, windowsVirtualKeyCode, text] = KEYS[key] ?? ['', 0, key];
    for (const type of ['keyDown', 'keyUp']) {
      await this.call('Input.dispatchKeyEvent', { type, key, code, text, windowsVirtualKeyCode, modifiers });
    }
  }

  /** The mouse at a place of the tab, its button pressed, moved or released. */
  mouse(type, [x, y]) {
    return this.call('Input.dispatchMouseEvent', { type, x, y, button: 'left', buttons: 1, clickCount: 1 });
  }

  /** Lets so many fingers touch the tab from now on. */
  hasFingers(maxTouchPoints) {
    return this.call('Emulation.setTouchEmulationEnabled', { enabled: true, maxTouchPoints });
  }

  touch(type, spots) {
    return this.call('Input.dispatchTouchEvent', { type, touchPoints: spots.map(([x, y], id) => ({ x, y, id })) });
  }

  /** No scrolling sideways of the page as a whole. Plots are drawn anew for the width first. */
  fitsTheWidth() {
    return this.when(() => document.documentElement.scrollWidth <= document.documentElement.clientWidth);
  }

  /** Checks that whatever takes the focus has a role and a name, and where it has one a value; the roles. */
  async namesEveryControl(about) {
    const { nodes } = await this.call('Accessibility.getFullAXTree');
    const property = (node, name) => node.properties?.find((property) => property.name === name)?.value.value;
    const roles = new Set();
    for (const node of nodes.filter((node) => !node.ignored && property(node, 'focusable') === true)) {
      const [role, name, value] = ['role', 'name', 'value'].map((key) => String(node[key]?.value ?? ''));
      if (role === 'RootWebArea') continue;
      assert(name.trim() !== '', `${about}: a nameless ${role}: ${JSON.stringify(node)}`);
      assert(!['', 'generic', 'none'].includes(role), `${about}: ${name} is nothing`);
      const hasValue = role === 'checkbox' ? property(node, 'checked') !== undefined
        : value !== '' || !['slider', 'spinbutton', 'combobox'].includes(role);
      assert(hasValue, `${about}: ${role} ${name} without a value`);
      roles.add(role);
    }
    return roles;
  }
}
