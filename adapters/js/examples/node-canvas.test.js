// node-canvas, by cairo, paths without antialiasing: `npm install canvas`, which is built with Debian's libcairo2-dev libpango1.0-dev.
import { test } from 'vitest';
import { createCanvas } from 'canvas';
import { assertLines, assertRasterizer } from 'rasterproof';

function drawn([first, ...rest], [width, height], paint) {
  const context = createCanvas(width, height).getContext('2d');
  context.antialias = 'none';
  context.moveTo(...first);
  for (const corner of rest) context.lineTo(...corner);
  context[paint]();
  const { data } = context.getImageData(0, 0, width, height);
  // Of booleans it cannot be seen whether a pixel is drawn twice.
  return Array.from({ length: width * height }, (_, i) => data[4 * i + 3] > 0);
}

const fill = (corners, window) => drawn(corners, window, 'fill');
// From centre to centre of two pixels.
const stroke = (ends, window) => drawn(ends.map((end) => end.map((px) => px + 0.5)), window, 'stroke');

test('fill', () => assertRasterizer(fill, { declare: 'range=4096' }));
test('stroke', () => assertLines(stroke, { declare: 'range=4096' }));
