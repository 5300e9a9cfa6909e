// WebGL 2: draws the batches that the module asks for, and reads them back.

/** A hit adds this many steps of 255: a rounding of the blending unit, or noise, does not make another number of it. */
const HIT = 16;
/** The steps of a number of a triangle in the depth test: there are 64 at most, and the nearest replaces the others. */
const NUMBER = 3;

const fragment = (colour) => `#version 300 es
precision highp float;
in vec2 carried;
out vec4 colour;
void main() { colour = ${colour}; }`;
const GLSL = {
  vertex: `#version 300 es
in vec4 position;
in vec2 values;
out vec2 carried;
void main() { gl_Position = position; carried = values; }`,
  hits: fragment(`vec4(carried.x * ${HIT}.0 / 255.0)`),
  // The picture is the mean of four samples, so a hit of one is an eighth of 64 steps.
  samples: `#version 300 es
#extension GL_OES_sample_variables : require
precision highp float;
out vec4 colour;
void main() { colour = vec4(equal(ivec4(gl_SampleID), ivec4(0, 1, 2, 3))) * 32.0 / 255.0; }`,
  values: fragment('vec4(gl_FragCoord.z, carried, 1.0)'),
};

class Lost extends Error {}

function openWebgl2() {
  const canvas = document.createElement('canvas');
  const gl = canvas.getContext('webgl2', { antialias: false, powerPreference: 'high-performance' });
  if (!gl) return { refused: ['noWebgl2'] };
  const names = gl.getExtension('WEBGL_debug_renderer_info');
  const renderer = names ? gl.getParameter(names.UNMASKED_RENDERER_WEBGL) : gl.getParameter(gl.RENDERER);
  const bits = gl.getParameter(gl.SUBPIXEL_BITS);
  const apart = Boolean(gl.getExtension('OES_sample_variables'));
  const floats = Boolean(gl.getExtension('EXT_color_buffer_float'));
  const once = kept();

  const shader = (type, text) => {
    const made = gl.createShader(type);
    gl.shaderSource(made, text);
    gl.compileShader(made);
    return made;
  };
  const program = (name) => once(`program ${name}`, () => {
    const made = gl.createProgram();
    gl.attachShader(made, shader(gl.VERTEX_SHADER, GLSL.vertex));
    gl.attachShader(made, shader(gl.FRAGMENT_SHADER, GLSL[name]));
    gl.bindAttribLocation(made, 0, 'position');
    gl.bindAttribLocation(made, 1, 'values');
    gl.linkProgram(made);
    if (!gl.isContextLost() && !gl.getProgramParameter(made, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(made));
    return made;
  });
  /** A picture of a kind: framebuffers to draw to and to read from. */
  const target = (name, side) => once(`target ${name}`, () => {
    const buffer = (format, samples) => {
      const made = gl.createRenderbuffer();
      gl.bindRenderbuffer(gl.RENDERBUFFER, made);
      gl.renderbufferStorageMultisample(gl.RENDERBUFFER, samples, format, side, side);
      return made;
    };
    const frame = (samples, format, depth) => {
      const made = gl.createFramebuffer();
      gl.bindFramebuffer(gl.FRAMEBUFFER, made);
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.RENDERBUFFER, buffer(format, samples));
      if (depth) gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, buffer(gl.DEPTH_COMPONENT24, samples));
      return made;
    };
    const format = name === 'values' ? gl.RGBA32F : gl.RGBA8;
    const draw = frame(name === 'samples' ? 4 : 0, format, name === 'hits');
    return { draw, read: name === 'samples' ? frame(0, format, false) : draw };
  });

  return {
    name: 'webgl2',
    renderer,
    bits,
    apart,
    isSoftware: SOFTWARE.test(renderer),
    notes: [['bitsSaid', bits], !apart && ['samplesSummed'], !floats && ['noFloats']].filter(Boolean),
    /** Whether a check can be asked at all. */
    offers: (check) => check !== 'values' || floats,
    async draw(batch) {
      const { kind, side, cell, draws } = batch;
      const vertices = numbers(batch.vertices);
      const { draw, read } = target({ samples: 'samples', values: 'values' }[kind] ?? 'hits', side);
      gl.bindFramebuffer(gl.FRAMEBUFFER, draw);
      gl.useProgram(program({ values: 'values', samples: apart ? 'samples' : 'hits' }[kind] ?? 'hits'));
      gl.bindBuffer(gl.ARRAY_BUFFER, once('buffer', () => gl.createBuffer()));
      gl.bufferData(gl.ARRAY_BUFFER, vertices, gl.STREAM_DRAW);
      gl.enableVertexAttribArray(0);
      gl.vertexAttribPointer(0, 4, gl.FLOAT, false, 24, 0);
      gl.enableVertexAttribArray(1);
      gl.vertexAttribPointer(1, 2, gl.FLOAT, false, 24, 16);
      gl.viewport(0, 0, side, side);
      gl.disable(gl.DITHER);
      const set = (what, on) => (on ? gl.enable(what) : gl.disable(what));
      set(gl.BLEND, kind !== 'depth' && kind !== 'values');
      gl.blendFunc(gl.ONE, gl.ONE);
      set(gl.DEPTH_TEST, kind === 'depth');
      gl.depthFunc(gl.LESS);
      gl.clearDepth(1);
      set(gl.CULL_FACE, kind === 'facing');
      gl.cullFace(gl.BACK);
      gl.disable(gl.SCISSOR_TEST);
      gl.clearColor(0, 0, 0, 0);
      gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
      const mode = kind === 'lines' ? gl.LINES : gl.TRIANGLES;
      if (draws.length === 0) gl.drawArrays(mode, 0, vertices.length / 6);
      else {
        gl.enable(gl.SCISSOR_TEST);
        let first = 0;
        for (const [count, x, y] of draws) {
          gl.scissor(x, y, cell, cell);
          gl.drawArrays(mode, first, count);
          first += count;
        }
        gl.disable(gl.SCISSOR_TEST);
      }
      if (read !== draw) {
        gl.bindFramebuffer(gl.READ_FRAMEBUFFER, draw);
        gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, read);
        gl.blitFramebuffer(0, 0, side, side, 0, 0, side, side, gl.COLOR_BUFFER_BIT, gl.NEAREST);
        gl.bindFramebuffer(gl.FRAMEBUFFER, read);
      }
      const floating = kind === 'values';
      const bytes = new Uint8Array(side * side * (floating ? 16 : 4));
      gl.readPixels(0, 0, side, side, gl.RGBA, floating ? gl.FLOAT : gl.UNSIGNED_BYTE, floating ? new Float32Array(bytes.buffer) : bytes);
      if (gl.isContextLost()) throw new Lost('contextLost');
      const error = gl.getError();
      if (error) throw new Error(`WebGL: 0x${error.toString(16)}`);
      if (floating) return base64(bytes);
      if (kind === 'samples') return apart ? hits(bytes, 1, 8) : hits(bytes, 4, HIT / 4);
      return hits(bytes, 4, kind === 'depth' ? NUMBER : HIT);
    },
  };
}
