// WebGPU: the same for its interface.

const WGSL = `
struct Carried { @builtin(position) position: vec4f, @location(0) values: vec2f }
@vertex fn vertex(@location(0) position: vec4f, @location(1) values: vec2f) -> Carried {
  return Carried(position, values);
}
@fragment fn hits(in: Carried) -> @location(0) vec4f { return vec4f(in.values.x * ${HIT}.0 / 255.0); }
@fragment fn values(in: Carried) -> @location(0) vec4f { return vec4f(in.position.z, in.values, 1.0); }
`;
const WGSL_SAMPLES = `
@group(0) @binding(0) var picture: texture_multisampled_2d<f32>;
@group(0) @binding(1) var<storage, read_write> read: array<u32>;
@compute @workgroup_size(8, 8) fn samples(@builtin(global_invocation_id) at: vec3u) {
  let p = at.xy;
  let four = vec4f(textureLoad(picture, p, 0).r, textureLoad(picture, p, 1).r, textureLoad(picture, p, 2).r, textureLoad(picture, p, 3).r);
  read[p.y * textureDimensions(picture).x + p.x] = pack4x8unorm(four);
}`;

async function openWebgpu() {
  if (!navigator.gpu) return { refused: ['noWebgpu'] };
  const adapter = await navigator.gpu.requestAdapter({ powerPreference: 'high-performance' });
  if (!adapter) return { refused: ['noAdapter'] };
  let device;
  try {
    device = await adapter.requestDevice();
  } catch (error) {
    return { refused: ['noDevice', error.message] };
  }
  let lost = null;
  device.lost.then(({ reason }) => { lost = reason; });
  const { vendor = '', architecture = '', device: model = '', description = '', isFallbackAdapter } = adapter.info ?? {};
  const renderer = [vendor, architecture, model, description].filter(Boolean).join(' ') || word('unnamed');
  const module = device.createShaderModule({ code: WGSL });
  const once = kept();

  const pipeline = (kind) => once(`pipeline ${kind}`, () => device.createRenderPipeline({
    layout: 'auto',
    vertex: {
      module,
      entryPoint: 'vertex',
      buffers: [{ arrayStride: 24, attributes: [{ shaderLocation: 0, offset: 0, format: 'float32x4' }, { shaderLocation: 1, offset: 16, format: 'float32x2' }] }],
    },
    fragment: {
      module,
      entryPoint: kind === 'values' ? 'values' : 'hits',
      targets: [{
        format: kind === 'values' ? 'rgba32float' : 'r8unorm',
        ...(kind === 'values' || kind === 'depth' ? {} : { blend: { color: { srcFactor: 'one', dstFactor: 'one' }, alpha: { srcFactor: 'one', dstFactor: 'one' } } }),
      }],
    },
    primitive: { topology: kind === 'lines' ? 'line-list' : 'triangle-list', frontFace: 'ccw', cullMode: kind === 'facing' ? 'back' : 'none' },
    ...(kind === 'depth' ? { depthStencil: { format: 'depth32float', depthWriteEnabled: true, depthCompare: 'less' } } : {}),
    ...(kind === 'samples' ? { multisample: { count: 4 } } : {}),
  }));
  const texture = (format, side, usage, sampleCount = 1) => once(`texture ${format} ${side} ${sampleCount}`, () => (
    device.createTexture({ size: [side, side], format, sampleCount, usage: GPUTextureUsage.RENDER_ATTACHMENT | usage })));

  return {
    name: 'webgpu',
    renderer,
    bits: null,
    apart: true,
    isSoftware: Boolean(isFallbackAdapter ?? adapter.isFallbackAdapter) || SOFTWARE.test(renderer),
    notes: [['bitsInferred']],
    offers: () => true,
    async draw(batch) {
      const { kind, side, cell, draws } = batch;
      const vertices = numbers(batch.vertices);
      device.pushErrorScope('validation');
      const buffer = device.createBuffer({ size: Math.max(24, vertices.byteLength), usage: GPUBufferUsage.VERTEX | GPUBufferUsage.COPY_DST });
      device.queue.writeBuffer(buffer, 0, vertices);
      const size = kind === 'values' ? 16 : 1;
      const picture = kind === 'samples'
        ? texture('r8unorm', side, GPUTextureUsage.TEXTURE_BINDING, 4)
        : texture(kind === 'values' ? 'rgba32float' : 'r8unorm', side, GPUTextureUsage.COPY_SRC);
      const commands = device.createCommandEncoder();
      const pass = commands.beginRenderPass({
        colorAttachments: [{ view: picture.createView(), loadOp: 'clear', clearValue: [0, 0, 0, 0], storeOp: 'store' }],
        ...(kind === 'depth' ? { depthStencilAttachment: { view: texture('depth32float', side, 0).createView(), depthLoadOp: 'clear', depthClearValue: 1, depthStoreOp: 'store' } } : {}),
      });
      pass.setPipeline(pipeline(kind));
      pass.setVertexBuffer(0, buffer);
      if (draws.length === 0) pass.draw(vertices.length / 6);
      let first = 0;
      for (const [count, x, y] of draws) {
        pass.setScissorRect(x, y, cell, cell);
        pass.draw(count, 1, first);
        first += count;
      }
      pass.end();
      const length = side * side * (kind === 'samples' ? 4 : size);
      const read = device.createBuffer({ size: length, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
      if (kind === 'samples') {
        const four = once('samples', () => device.createComputePipeline({ layout: 'auto', compute: { module: device.createShaderModule({ code: WGSL_SAMPLES }), entryPoint: 'samples' } }));
        const store = once(`store ${length}`, () => device.createBuffer({ size: length, usage: GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC }));
        const loads = commands.beginComputePass();
        loads.setPipeline(four);
        loads.setBindGroup(0, device.createBindGroup({ layout: four.getBindGroupLayout(0), entries: [{ binding: 0, resource: picture.createView() }, { binding: 1, resource: { buffer: store } }] }));
        loads.dispatchWorkgroups(side / 8, side / 8);
        loads.end();
        commands.copyBufferToBuffer(store, 0, read, 0, length);
      } else commands.copyTextureToBuffer({ texture: picture }, { buffer: read, bytesPerRow: side * size }, [side, side]);
      device.queue.submit([commands.finish()]);
      const scope = device.popErrorScope();
      try {
        await read.mapAsync(GPUMapMode.READ);
      } catch (error) {
        if (lost !== null) throw new Lost('deviceLost');
        throw error;
      }
      const error = await scope;
      if (lost !== null) throw new Lost('deviceLost');
      if (error) throw new Error(error.message);
      const bytes = new Uint8Array(read.getMappedRange().slice(0));
      read.destroy();
      buffer.destroy();
      return kind === 'values' ? base64(bytes) : hits(bytes, 1, kind === 'depth' ? NUMBER : HIT);
    },
  };
}
