import assert from 'node:assert/strict';
import fs from 'node:fs';
import http from 'node:http';
import path from 'node:path';
import zlib from 'node:zlib';

import { inSite } from '../driver/site.mjs';

/** A line of 1.6 Mbit/s brings so many bytes in a second. */
const BYTES_PER_SECOND = 200_000;
/** What comes before the first picture of a figure, compressed: style sheets and scripts above the text, and the text. */
const MOST_BYTES = 60_000;

const TYPES = { '.html': 'text/html; charset=utf-8', '.js': 'text/javascript; charset=utf-8', '.css': 'text/css', '.svg': 'image/svg+xml', '.png': 'image/png' };

/** A server of the site on this machine, which compresses texts or does not. */
async function serve(isCompressed) {
  const server = http.createServer(({ url }, answer) => {
    const file = inSite(decodeURI(url.split('?')[0]).slice(1)), type = TYPES[path.extname(file)];
    if (!fs.existsSync(file)) {
      answer.writeHead(404).end();
      return;
    }
    const zips = isCompressed && type !== 'image/png', body = fs.readFileSync(file);
    answer.writeHead(200, { ...(type && { 'content-type': type }), ...(zips && { 'content-encoding': 'gzip' }), 'cache-control': 'no-store' });
    answer.end(zips ? zlib.gzipSync(body) : body);
  });
  await new Promise((done) => { server.listen(0, '127.0.0.1', done); });
  return server;
}

/** For the page, before any script: when the first picture of a figure is painted, and what moves. */
const watch = () => {
  window.moved = 0;
  new PerformanceObserver((list) => { for (const { value } of list.getEntries()) window.moved += value; }).observe({ type: 'layout-shift', buffered: true });
  const look = () => {
    if (!document.querySelector('rp-figure')?.shadowRoot?.querySelector('.stage svg')) requestAnimationFrame(look);
    else requestAnimationFrame(() => setTimeout(() => { window.seen = Math.round(performance.now()); }));
  };
  look();
};

export default {
  // The times are printed and not judged, since they depend on all else that runs on this machine.
  says: 'On a line of 1.6 Mbit/s little comes before the first picture of a figure, and nothing moves until all is there',
  page: 'nothing',
  async check(tab) {
    await tab.call('Network.enable');
    await tab.call('Page.addScriptToEvaluateOnNewDocument', { source: `(${watch})()` });
    for (const page of ['en/index.html', 'en/ch02-edge-functions.html', 'zh/ch06.html']) {
      const text = fs.readFileSync(inSite(page), 'utf8'), [head] = text.split('</head>');
      const first = [...head.matchAll(/<(?:script|link rel="stylesheet")[^>]* (?:src|href)="([^"]*)"/g)].map(([, name]) => path.join(path.dirname(page), name));
      const sizes = [page, ...first].map((name) => fs.readFileSync(inSite(name))).map((bytes) => [bytes.length, zlib.gzipSync(bytes).length]);
      const [plain, compressed] = [0, 1].map((i) => sizes.reduce((sum, size) => sum + size[i], 0));
      assert(first.length > 5 && compressed < MOST_BYTES, `${page}: ${compressed} bytes in ${first.length + 1} files before the first picture`);
      for (const [isCompressed, width] of [[true, 360], [true, 1280], [false, 1280]]) {
        const server = await serve(isCompressed);
        await tab.resize(width, 740);
        await tab.call('Network.emulateNetworkConditions', { offline: false, latency: 20, downloadThroughput: BYTES_PER_SECOND, uploadThroughput: BYTES_PER_SECOND });
        await tab.call('Page.navigate', { url: `http://127.0.0.1:${server.address().port}/${page}` });
        await tab.when('window.seen !== undefined && document.readyState === "complete"');
        await tab.settle();
        const [seen, moved] = await tab.value('[window.seen, window.moved]');
        console.log(`${page} at ${width} px: ${isCompressed ? compressed : plain} bytes before the first picture, which is seen after ${seen} ms`);
        assert(moved < 0.02, `${page} at ${width} px moves by ${moved}`);
        // It asks for no picture any more.
        await tab.call('Page.navigate', { url: 'about:blank' });
        server.close();
      }
    }
    // A tab whose line is slow is sometimes never closed.
    await tab.call('Network.disable');
  },
};
