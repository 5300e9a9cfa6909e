(async () => {
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
})()
