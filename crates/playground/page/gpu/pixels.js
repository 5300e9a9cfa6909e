// What both interfaces share: bytes to text and back.

/** Renderers that run on the processor, by their names. */
const SOFTWARE = /swiftshader|llvmpipe|softpipe|software|lavapipe|basic render|warp/i;

/** What makes a thing by its name, once. */
const kept = (made = {}) => (name, make) => (made[name] ??= make());

/** Bytes that were read back so far and are no whole number of hits. A device is asked alone. */
const readBack = { uneven: 0 };

/** Bytes as hits, as ASCII: one of every `stride`, where a hit is so many steps. */
function hits(bytes, stride, step) {
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
