import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';

import { isTroubled, show } from '../driver/playground.mjs';
import { folder, PROGRAM, reportOf } from '../driver/program.mjs';

const FAN = 'document.getElementById("shape-fan").click()';
const DRAG = 'grips()[1].place(3.5, 7.25)';
const FREE = '#snap=0&t=0.1,0.2_5.3,0.7_2.123456789,6.1;1e-7,4_5.3,0.7_-1.5,9.75&by=oracle,scanline';
// The bottom edge runs through samples that are its neighbour's.
const TIE = '#snap=0&t=0.5,5.5_5.5,5.5_2.1,1.3&by=edge-function,inclusive-edges';

// An address, what is done to the page, and what stands in the command then.
const COMMANDS = [
  ['#scene=triangle', '0', '--plant exclusive-edges'],
  ['#by=oracle,scanline', FAN, '--window 0,0,14x14'],
  ['#by=oracle,edge-function', '(grips()[0].place(-3.5, 2), view.zoom(1))', '--window'],
  [FREE, '0', '--exact'],
  [TIE, '0', '--plant exact-inclusive-ties'],
  ['#case=T2&by=oracle,sysu-inclusive', '0', 'inspect T2 --specimen sysu-inclusive'],
  ['#case=T2&by=oracle,scanline', 'view.pan(2, -1)', '--window 2,-1,'],
  ['#case=T2&by=oracle,scanline&snap=0', '0', 'inspect T2 --exact'],
  ['#case=double_row&by=oracle,scanline', '0', '--window'],
  ['#case=f32-tie%235&seed=3&by=oracle,scanline', '0', "'f32-tie#5' --seed 3"],
  ['#case=fan%235&seed=3&by=oracle,scanline', DRAG, '--window'],
  ['#case=w-100%235&seed=3&by=oracle,scanline', DRAG, '--window'],
  ['#case=uniform%235&seed=3&by=oracle,scanline&snap=0', '0', '--seed 3 --exact'],
  ['#scene=line&by=dda,book-dda', '0', '--line'],
  ['#scene=line&case=L9', DRAG, '--line'],
  ['#scene=perspective', '0', '--specimen book-affine'],
  ['#scene=depth', '0', '--window'],
  ['#scene=samples', DRAG, '--window'],
  ['#scene=culling', '0', '--window'],
];

/** Pixels and their hits, as a report page packs them, as digits. */
function digits(runs) {
  let text = '';
  for (let i = 0; i < runs.length; i += 2) text += String(Math.min(runs[i + 1], 9)).repeat(runs[i]);
  return text;
}

/** Who is on the panels, with the hits of each pixel as digits; off the lattice by the names of the exact forms. */
function panels() {
  const [x0, y0, x1, y1] = state.window, { truth, panels = [] } = last.answer;
  const digits = (pixels) => {
    const hits = new Array((x1 - x0) * (y1 - y0)).fill(0);
    for (const [x, y] of pixels.flat()) hits[(y - y0) * (x1 - x0) + x - x0] += 1;
    return hits.join('');
  };
  const names = { oracle: 'oracle', 'inclusive-edges': 'exact-inclusive-ties' };
  const exact = (name) => names[name] ?? `${name}-exact`;
  return [['oracle', truth], ...panels.map((panel) => [panel.name, panel.hits ?? panel.pixels])]
    .map(([name, hits]) => [state.snap ? name : exact(name), state.lines ? digits(hits) : hits])
    .filter(([, hits]) => typeof hits === 'string');
}

/** The case of the report that a shell writes for a command. */
function caseOf(command, cwd) {
  const words = command.replace(/^rasterproof /, '');
  const { status, stderr } = spawnSync('sh', ['-c', `"$0" ${words} --report`, PROGRAM], { cwd, encoding: 'utf8' });
  assert.equal(status, words.includes('--plant') ? 1 : 0, `${command}: ${stderr}`);
  const page = fs.readFileSync(reportOf('inspect', { folder: cwd }), 'utf8');
  return JSON.parse(page.split('id="data">')[1].split('</script>')[0]).cases[0];
}

export default {
  says: 'The command beside the panels shows the same to a shell: corners, window, and who hits which pixel',
  page: 'playground',
  async check(tab) {
    const cwd = folder();
    for (const [address, change, options] of COMMANDS) {
      await show(tab, `${address}&lang=en`);
      await tab.value(`(${change}, 0)`);
      await tab.settle();
      assert.equal(await isTroubled(tab), false, address);
      const command = await tab.text('#command');
      assert(command.startsWith('rasterproof ') && command.includes(options), `${address}: ${command}`);
      // A corner without values has others to the command line than one with w = 1.
      const commas = command.split(' ').filter((word) => !word.includes('x')).map((word) => word.split(',').length - 1);
      assert(!(commas.includes(1) && commas.some((count) => count > 1)), command);
      const reported = caseOf(command, cwd), { window } = reported;
      assert.deepEqual(await tab.value('state.window'), ['x0', 'y0', 'x1', 'y1'].map((side) => window[side]), command);
      const places = await tab.value(
        'state.lines ?? state.triangles.map(t => t.map(c => state.snap ? [c.x * 256, c.y * 256] : [c.x, c.y]))');
      assert.deepEqual(reported.shape.points, places, command);
      const compared = await tab.value(panels);
      for (const [name, hits] of compared) {
        const layer = reported.layers.find(({ names }) => names.includes(name));
        assert(layer, `${command}: nobody is called ${name}`);
        assert.equal(digits(layer.runs), hits, `${command}: ${name}`);
      }
      const showsHits = !/perspective|depth|samples|culling/.test(address);
      assert.equal(compared.length >= 3, showsHits, `${command}: ${compared}`);
    }
  },
};
