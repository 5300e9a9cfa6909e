// What both interfaces share: bytes to text, and faults that are planted between the judge and the device.

/** Renderers that run on the processor, by their names. */
const SOFTWARE = /swiftshader|llvmpipe|softpipe|software|lavapipe|basic render|warp/i;

/** What was read back so far: pictures, and bytes that are no whole number of hits. A device is asked alone. */
const readBack = { pictures: 0, uneven: 0 };

/** Noise against fingerprinting, planted: pixels that differ from one drawing to the next, or slightly in every drawing. */
function addNoise(bytes, plant) {
  readBack.pictures += 1;
  if (plant === 'noise' && readBack.pictures % 2 === 0) {
    const first = bytes.findIndex((byte) => byte > 0);
    if (first >= 0) bytes[first] = 0;
  }
  if (plant === 'faint-noise') for (let at = 0; at < bytes.length; at += 97) if (bytes[at] > 0) bytes[at] ^= 1;
}

/** Bytes as hits, as ASCII: one of every `stride`, where a hit is so many steps. */
function hits(bytes, stride, step, plant) {
  addNoise(bytes, plant);
  const text = new Uint8Array(bytes.length / stride);
  const half = step >> 1;
  for (let i = 0, at = 0; at < bytes.length; i += 1, at += stride) {
    text[i] = 48 + Math.floor((bytes[at] + half) / step);
    if (bytes[at] % step !== 0 && bytes[at] < 255) readBack.uneven += 1;
  }
  return text;
}

function base64(bytes) {
  let text = '';
  for (let at = 0; at < bytes.length; at += 0x8000) text += String.fromCharCode(...bytes.subarray(at, at + 0x8000));
  return new TextEncoder().encode(btoa(text));
}

const numbers = (text) => new Float32Array(bytesOf(text).buffer);

/** Faults of positions: each changes a vertex, given {v, at, px, step, kind, first, z}, as a wrong vertex stage would. */
const PLANTS = {
  moved: ({ move }) => move(1 / 256, 1 / 256),
  nudged: ({ move, step }) => move(step, step),
  'samples-moved': ({ move, kind }) => kind === 'samples' && move(1 / 16, 0),
  'first-corner': ({ move, step, index, kind }) => kind !== 'lines' && index % 3 === 0 && move(step, 0),
  'lines-moved': ({ move, kind }) => kind === 'lines' && move(2, 0),
  coarse: ({ v, at, side }) => {
    for (const axis of [0, 1]) v[at + axis] = (Math.round((v[at + axis] / v[at + 3]) * side * 4) / (side * 4)) * v[at + 3];
  },
  'w-ignored': ({ v, at }) => {
    const w = v[at + 3];
    if (w > 0) for (const i of [0, 1, 2, 3]) v[at + i] /= w;
  },
  'no-near-plane': ({ v, at, name }) => { v[at + 2] = Math.max(v[at + 2], name === 'webgl2' ? -v[at + 3] : 0); },
  // Smaller than half a square pixel.
  dropped: ({ v, at, index, side, kind }) => {
    if (kind === 'lines' || index % 3 !== 0) return;
    const [a, b, c] = [0, 6, 12].map((next) => [v[at + next] / v[at + next + 3], v[at + next + 1] / v[at + next + 3]]);
    const twice = Math.abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) * (side / 2) ** 2;
    if (twice < 1) v.copyWithin(at + 6, at, at + 6);
  },
  // By other means, where a pipeline is made or read.
  twice: null, winding: null, farther: null, noise: null, 'faint-noise': null, lost: null,
};

/** The vertices of a batch, with a fault where one is planted. */
function spoiled({ vertices, side, kind }, plant, { name, bits }) {
  const v = numbers(vertices);
  const spoil = PLANTS[plant];
  if (!spoil) return v;
  for (let at = 0, index = 0; at < v.length; at += 6, index += 1) {
    const move = (x, y) => {
      v[at] += ((2 * x) / side) * v[at + 3];
      v[at + 1] += ((name === 'webgl2' ? 2 : -2) * y / side) * v[at + 3];
    };
    spoil({ v, at, index, side, kind, name, move, step: 2 ** -Math.min(bits ?? 4, 8) });
  }
  return v;
}
