import assert from 'node:assert/strict';

import { plantOn, rows, SWIFTSHADER } from '../driver/gpu.mjs';

/** For the page: draws what a bug report holds by nothing but its text, and compares with the pixels that it shows. */
async function drawsAlone() {
  const text = document.querySelector('#report').textContent;
  const wanted = text.split('\nDrawn:\n')[1].split('\n\n')[0];
  const [[x0, x1], [y0, y1]] = ['Columns', 'rows'].map((name) => text.match(`${name} (\\d+) to (\\d+)`).slice(1).map(Number));
  const side = Number(text.match(/ (\d+) x \d+ px/)[1]);
  let bytes, stride;
  if (text.includes('@vertex')) {
    const device = await (await navigator.gpu.requestAdapter()).requestDevice();
    const module = device.createShaderModule({ code: text.slice(text.lastIndexOf('\n\n// '), text.indexOf('\n\nPage: ')) });
    const add = { srcFactor: 'one', dstFactor: 'one' };
    const pipeline = device.createRenderPipeline({ layout: 'auto', vertex: { module, entryPoint: 'vertex' },
      fragment: { module, entryPoint: 'hits', targets: [{ format: 'r8unorm', blend: { color: add, alpha: add } }] } });
    const picture = device.createTexture({ size: [side, side], format: 'r8unorm', usage: GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.COPY_SRC });
    const read = device.createBuffer({ size: side * side, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
    const commands = device.createCommandEncoder();
    const pass = commands.beginRenderPass({ colorAttachments: [{ view: picture.createView(), loadOp: 'clear', storeOp: 'store' }] });
    pass.setPipeline(pipeline);
    pass.draw(Number(text.match(/draw\((\d+)\)/)[1]));
    pass.end();
    commands.copyTextureToBuffer({ texture: picture }, { buffer: read, bytesPerRow: side }, [side, side]);
    device.queue.submit([commands.finish()]);
    await read.mapAsync(GPUMapMode.READ);
    [bytes, stride] = [new Uint8Array(read.getMappedRange()), 1];
  } else {
    const gl = document.createElement('canvas').getContext('webgl2', { antialias: false });
    const [, vertex, fragment] = text.split('\n\nPage: ')[0].split('#version 300 es');
    const program = gl.createProgram();
    for (const [type, code] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, `#version 300 es${code}`);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    gl.useProgram(program);
    gl.bindFramebuffer(gl.FRAMEBUFFER, gl.createFramebuffer());
    gl.bindRenderbuffer(gl.RENDERBUFFER, gl.createRenderbuffer());
    gl.renderbufferStorage(gl.RENDERBUFFER, gl.RGBA8, side, side);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.RENDERBUFFER, gl.getParameter(gl.RENDERBUFFER_BINDING));
    gl.viewport(0, 0, side, side);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE);
    gl.drawArrays(gl.TRIANGLES, 0, Number(text.match(/drawArrays\(TRIANGLES, 0, (\d+)\)/)[1]));
    [bytes, stride] = [new Uint8Array(4 * side * side), 4];
    gl.readPixels(0, 0, side, side, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
  }
  const row = (y) => Array.from({ length: x1 - x0 + 1 }, (_, i) => bytes[stride * (side * y + x0 + i)] / 16).join('');
  return wanted === Array.from({ length: y1 - y0 + 1 }, (_, i) => row(y0 + i)).join('\n');
}

export default {
  says: 'The smallest case that was found is shown with its cause, its text for a report, and the address that repeats it',
  page: 'your-gpu #lang=en',
  options: SWIFTSHADER,
  async check(tab) {
    await rows(tab, 'nudged', { names: ['webgpu', 'webgl2'], only: [['coverage', 0]], bits: 4 });
    assert((await tab.text('[data-api=webgl2] .cause')).includes('probable cause: It samples at (0.4375, 0.4375) of the pixel'));
    // Below the headline of the first interface its finding stands, with pixels that can be seen and both pictures.
    const shown = await tab.value(() => {
      const { previousElementSibling: before, hidden } = document.getElementById('finding');
      return [hidden, before.className, before.parentElement.dataset.api, pixels.unit >= 24, pixels.shown.length];
    });
    assert.deepEqual(shown, [false, 'cause', 'webgpu', true, 2]);
    // The pixel is explained as on every page: a table of edges with the sides that decide.
    const why = await tab.value(() => [...document.querySelectorAll('#why .edges tbody tr')]
      .map((row) => [row.cells[1].textContent[0] === '-', row.cells[2].textContent]));
    assert(why.length > 0 && why.length % 3 === 0, `${why.length} edges`);
    for (const [isBelow, side] of why) assert.equal(side === 'outside', isBelow, JSON.stringify(why));
    await tab.click('[data-api=webgl2] [data-check=coverage] button');
    // The headline names the check, and the keyboard is where the case is.
    assert.equal(await tab.text('[data-api=webgl2] .verdict'), 'coverage: 1 check breaks a promise.');
    assert.equal(await tab.value('document.activeElement.textContent'), 'WebGL 2, coverage: The smallest case that was found');
    const report = await tab.text('#report');
    for (const part of ['Renderer: ANGLE', 'exactly one of the polygons', 'It samples at', 'gl_VertexID', 'Expected:', 'Drawn:', 'Page: ']) {
      assert(report.includes(part), `${part}: ${report}`);
    }
    const address = await tab.value('document.querySelector("#finding a").hash');
    const repeat = async (address, fault) => {
      await tab.open('#lang=en');
      await plantOn(tab, fault);
      await tab.value((hash) => { location.hash = hash; }, `${address}&lang=en`);
      await tab.when('document.body.dataset.done !== undefined');
    };
    await repeat(address, 'nudged');
    assert.equal(await tab.text('#one .outside'), 'This case breaks the promise here.');
    // The shaders hold the case and not the fault, so what they draw is something else.
    assert.equal(await tab.value(drawsAlone), false);
    // Without the fault the same case is right, and its shaders draw what the page has drawn.
    for (const alone of [address.replace('webgl2', 'webgpu'), address]) {
      await repeat(alone, null);
      assert.equal(await tab.text('#one .equal'), 'This case is as promised here.');
      assert.match(await tab.text('#finding h2'), /: A case, where nothing differs$/);
      assert.equal(await tab.value(drawsAlone), true, alone);
    }
  },
};
