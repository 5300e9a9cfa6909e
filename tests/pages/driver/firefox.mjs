// Firefox with one tab, driven through its Marionette protocol: JSON with its length before it, over a socket.
//
// Firefox draws WebGL only where it has a display, so it gets one by Xvfb. Where either is missing a check says so and passes,
// unless `RASTERPROOF_NEEDS_FIREFOX` is set, as `.ci/run --all` does: nothing else needs them.

import assert from 'node:assert/strict';
import { spawn, spawnSync } from 'node:child_process';
import { once } from 'node:events';
import fs from 'node:fs';
import net from 'node:net';
import path from 'node:path';
import { setTimeout as sleep } from 'node:timers/promises';
import { pathToFileURL } from 'node:url';

import { folder, missing } from './program.mjs';
import { PATIENCE, Questions } from './tab.mjs';

const isThere = (name) => spawnSync('which', [name]).status === 0;

/** A port that is free now. */
async function freePort() {
  const server = net.createServer().listen(0, '127.0.0.1');
  await once(server, 'listening');
  const { port } = server.address();
  server.close();
  return port;
}

/** A connection to a port on which somebody will listen soon. */
async function connect(port) {
  const start = Date.now();
  for (;;) {
    const socket = net.connect(port, '127.0.0.1');
    try {
      await once(socket, 'connect');
      return socket;
    } catch (error) {
      assert(Date.now() - start < PATIENCE, `Firefox: ${error.message}`);
    }
    await sleep(100);
  }
}

/** The messages that come over a socket. */
async function* messages(socket) {
  let bytes = Buffer.alloc(0);
  for await (const chunk of socket) {
    bytes = Buffer.concat([bytes, chunk]);
    for (let colon; (colon = bytes.indexOf(':')) > 0;) {
      const end = colon + 1 + Number(bytes.subarray(0, colon));
      if (bytes.length < end) break;
      yield JSON.parse(bytes.subarray(colon + 1, end));
      bytes = bytes.subarray(end);
    }
  }
}

/** The page's own scripts see its constants; those of Marionette do not, and leave one behind to answer. */
const SCRIPT = `const script = document.createElement('script');
  script.textContent = arguments[0];
  document.head.append(script);
  script.remove();
  const { answer } = document.body.dataset;
  delete document.body.dataset.answer;
  return answer;`;

export class Firefox extends Questions {
  complaints = [];
  #last = 0;

  /** Starts Firefox. */
  static async start() {
    const program = ['firefox-esr', 'firefox'].find(isThere);
    if (!program || !isThere('Xvfb')) missing("no Firefox or no Xvfb; install Debian's firefox-esr and xvfb", 'RASTERPROOF_NEEDS_FIREFOX');
    const firefox = new Firefox(), profile = folder(), port = await freePort();
    fs.writeFileSync(path.join(profile, 'user.js'), `user_pref("marionette.port", ${port});\nuser_pref("webgl.force-enabled", true);\n`);
    const screen = ['-displayfd', '1', '-nolisten', 'tcp', '-screen', '0', '1280x1024x24'];
    firefox.display = spawn('Xvfb', screen, { stdio: ['ignore', 'pipe', 'ignore'] });
    const [number] = await once(firefox.display.stdout, 'data');
    const env = { ...process.env, DISPLAY: `:${String(number).trim()}`, HOME: profile, TMPDIR: profile };
    firefox.child = spawn(program, ['--marionette', '--no-remote', '--profile', profile], { stdio: 'ignore', env });
    firefox.socket = await connect(port);
    firefox.messages = messages(firefox.socket);
    // It greets first.
    await firefox.messages.next();
    await firefox.call('WebDriver:NewSession', {});
    return firefox;
  }

  async call(command, parameters) {
    this.#last += 1;
    const request = Buffer.from(JSON.stringify([0, this.#last, command, parameters]));
    this.socket.write(Buffer.concat([Buffer.from(`${request.length}:`), request]));
    const late = sleep(PATIENCE, null, { ref: false }).then(() => assert.fail(`Firefox does not answer ${command}`));
    const { value: answer } = await Promise.race([this.messages.next(), late]);
    assert(answer[1] === this.#last && answer[2] === null, `${command}: ${JSON.stringify(answer)}`);
    return answer[3].value;
  }

  async ask(expression) {
    const text = `document.body.dataset.answer = JSON.stringify(${expression}) ?? 'null'`;
    const answer = await this.call('WebDriver:ExecuteScript', { script: SCRIPT, args: [text] });
    assert(typeof answer === 'string', `no answer: ${expression}`);
    return JSON.parse(answer);
  }

  async open(fragment = '', file = this.file) {
    await this.call('WebDriver:Navigate', { url: pathToFileURL(file).href + fragment });
    await this.when('document.body.dataset.ready !== undefined');
  }

  /** The display has a size of its own. */
  async resize() {}

  async close() {
    for (const child of [this.child, this.display]) child.kill('SIGKILL');
    this.socket.destroy();
  }
}
