import assert from 'node:assert/strict';

import { answer, dragGrip, expected, figures, fileName, link, pixels, put, stands } from '../driver/figures.mjs';

// The panels of the playground that show what a figure shows; none where it shows the figure itself.
const PANELS = {
  ...Object.fromEntries(['one-sample', 'line-pixels', 'there-and-back', 'edge-owner', 'row-span', 'boards', 'z-fighting', 'near-corners',
    'winding', 'order-matters', 'turn-about'].map((name) => [name, [0]])),
  'shared-edge': [1],
  'middle-row': [1],
  'wrong-corner': [0, 1],
  'affine-kink': [0, 1],
  nearer: [0, 1],
};

/** For the page: goes where the address leads, as a click on the link does, and says what the panels show there. */
const follow = (to) => new Promise((done) => {
  const look = () => {
    drawFrame();
    explained = 0;
    explain(last.answer);
    const [x0, y0, x1, y1] = state.window;
    const panels = scene().panels(last.answer).filter((panel) => panel.pixel).map((panel) => {
      const pixels = [];
      for (let y = y0; y < y1; y += 1) {
        for (let x = x0; x < x1; x += 1) {
          const pixel = panel.pixel((y - y0) * (x1 - x0) + x - x0, x, y);
          if (pixel) pixels.push([x, y, pixel.fill]);
        }
      }
      return pixels;
    });
    done({
      trouble: $('trouble').textContent, panels, svg: (last.answer.panels ?? []).map((panel) => panel.svg),
      weights: last.look?.triangles?.[0]?.edges?.map((edge) => edge.weight) ?? [],
    });
  };
  addressLater(() => {}, 0);
  if (location.hash === to) look();
  else {
    addEventListener('hashchange', look, { once: true });
    location.hash = to;
  }
});

/** For the page: the picture is on both panels, each as large as its place. */
const isOnBoth = `(() => {
  drawFrame();
  return view.shown.map(({ frame }, i) => {
    const host = document.body.appendChild(document.createElement('div'));
    host.innerHTML = last.answer.panels[i].svg;
    const [is, should] = [frame, host].map((root) => JSON.stringify((${pixels})(root)));
    host.remove();
    const svg = frame.querySelector('svg');
    return is === should && svg.childElementCount > 1 && svg.clientWidth === frame.clientWidth;
  });
})()`;

/** Pixels with what they are painted, counted from the first column and row that have any, as one text each. */
function fromTheFirst(pixels, unit) {
  const [x0, y0] = [0, 1].map((axis) => Math.min(...pixels.map((pixel) => pixel[axis])));
  const places = new Map(pixels.map(([x, y, paint]) => [`${Math.round((x - x0) / unit)},${Math.round((y - y0) / unit)}`, paint]));
  return [...places].map(([place, paint]) => `${place} ${paint}`).sort();
}

/** The pixels of a figure's picture, and the side of one. */
function pixelsOf(svg) {
  const pixels = [];
  let unit = Infinity;
  for (const [, paint, runs] of svg.matchAll(/<path class="px([^>]*?) d="([^"]*)"/g)) {
    const painted = paint.replace(/^[ "]+|[ "]+$/g, '').replace(/^fill="/, '');
    for (const run of runs.split('M').slice(1)) {
      const [x, y, width, side] = run.split(/[ hvz]/).map(Number);
      unit = Math.min(unit, side);
      for (let i = 0; i < Math.round(width / side); i += 1) pixels.push([x + i * side, y, painted]);
    }
  }
  return { pixels, unit };
}

/** What each panel of the playground has to be painted with, by the picture of a figure. */
function paintedBy(name, svg) {
  const { pixels, unit } = pixelsOf(svg);
  const isSecond = ([x, y]) => (name === 'nearer' ? y > 225 : ['wrong-corner', 'affine-kink'].includes(name) && x > 180);
  // Of two surfaces, the one that was drawn last; the painter, who is the second part, shows it alone.
  const last = pixels.find(isSecond)?.[2] ?? 'one';
  const paint = (is) => {
    if (['there-and-back', 'edge-owner', 'boards'].includes(name)) return 'on';
    if (['nearer', 'z-fighting'].includes(name)) return is === last ? 'last' : 'first';
    return is;
  };
  const named = pixels.map(([x, y, is]) => [x, y, paint(is)]);
  return [false, true].slice(0, PANELS[name].length).map((part) => fromTheFirst(named.filter((pixel) => isSecond(pixel) === part), unit));
}

/** What the playground paints a pixel with, in the words of the figure; nothing where the figure leaves it out. */
function asInTheFigure(name, y, paint) {
  if (name === 'row-span' && y !== 2) return undefined;
  if (name === 'there-and-back') return paint === 'missing' ? undefined : 'on';
  if (name === 'affine-kink') return paint === 'agrees' ? 'dark' : 'pale';
  if (['nearer', 'z-fighting'].includes(name)) return ['a', 'b'].includes(paint) ? 'first' : 'last';
  if (paint === 'agrees') return 'on';
  if (paint === 'missing') return 'miss';
  const rgb = paint.match(/^rgb\((.*)\)$/)?.[1];
  return rgb ? `#${rgb.split(' ').map((byte) => Number(byte).toString(16).padStart(2, '0')).join('')}` : paint;
}

/** Whether the playground shows what the figure shows. */
function isSame(name, { answer, svg }, seen) {
  if (name === 'weights') {
    const has = (weight) => answer.includes(` ${Number((weight * 100).toFixed(2))}%`);
    return seen.weights.length === 3 && seen.weights.every(has);
  }
  const panels = PANELS[name];
  if (!panels) return seen.svg.length === 2 && seen.svg.every((own) => own === svg);
  const painted = panels.map((panel) => {
    const pixels = seen.panels[panel].map(([x, y, paint]) => [x, y, asInTheFigure(name, y, paint)]);
    return fromTheFirst(pixels.filter(([, , paint]) => paint !== undefined), 1);
  });
  return JSON.stringify(painted) === JSON.stringify(paintedBy(name, svg));
}

/** The links of each figure as it begins, dragged, and at both ends of its grips, with what the oracle draws there. */
async function links(tab) {
  const found = [];
  for (const { name, ends } of await figures()) {
    await answer(tab, name);
    const note = async () => {
      const at = await stands(tab, name);
      found.push({ name, link: await link(tab, name), right: await expected(name, at) });
    };
    await note();
    await dragGrip(tab, name, ends.length - 1, [-61, -45]);
    await note();
    for (const end of [0, 1]) {
      await put(tab, name, ends.map((grip) => grip[end]));
      await note();
    }
  }
  return found;
}

export default {
  says: 'The link of each figure leads to the playground in the same state, and to no other',
  page: 'made figures en',
  async check(tab) {
    const all = await links(tab), [{ link: first }] = all, toldApart = new Set();
    await tab.call('Page.navigate', { url: first });
    await tab.when('document.body?.dataset.ready !== undefined');
    for (const { name, link, right } of all) {
      assert.equal(fileName(link), 'playground.html');
      const seen = await tab.value(follow, new URL(link).hash);
      assert.equal(seen.trouble, '', link);
      assert(isSame(name, right, seen), `${link}: ${JSON.stringify(seen)}`);
      if (all.some((other) => other.name === name && !isSame(name, other.right, seen))) toldApart.add(name);
      if (!PANELS[name] && name !== 'weights') assert.deepEqual(await tab.value(isOnBoth), [true, true], link);
    }
    assert.equal(toldApart.size, new Set(all.map(({ name }) => name)).size, 'the playground in another state');
  },
};
