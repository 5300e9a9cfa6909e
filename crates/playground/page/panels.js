// Panels: pixels, grid, outlines and handles on a canvas.

let colours = {};
function readColours() {
  const style = getComputedStyle(document.documentElement);
  for (const name of ['empty', 'grid', 'agrees', 'missing', 'extra', 'twice', 'edge', 'sample', 'cursor', 'glyph', 'a', 'b', 'c', 'd']) {
    colours[name] = style.getPropertyValue(`--px-${name}`).trim();
  }
}

function newPanel(i) {
  const caption = make('figcaption');
  const canvas = make('canvas', { tabIndex: 0, role: 'application', 'aria-describedby': 'keys' });
  const figure = make('figure', {}, caption, canvas);
  $('panels').append(figure);
  listen(canvas, i);
  return { figure, caption, canvas, said: '' };
}

/** A panel is {title | select, says, bad, pixel(i, x, y), outlines, over, view}. */
function drawPanel(panel, i, answer) {
  shown[i].of = panel.view;
  const { caption, canvas } = shown[i];
  const key = JSON.stringify([panel.title, panel.select, state.lang]);
  if (shown[i].said !== key) {
    shown[i].said = key;
    const head = panel.select ? chooser(i, panel.select) : make('strong', {}, panel.title);
    // What it says is said once, by the live region of the page.
    caption.replaceChildren(head, make('output', { 'aria-live': 'off' }));
  }
  const output = caption.lastChild;
  const says = panel.says ?? '';
  if (output.textContent !== says) {
    output.textContent = says;
    output.className = panel.bad === undefined ? '' : panel.bad ? 'bad' : 'good';
  }
  const label = [panel.title ?? caption.querySelector('option:checked')?.textContent, says].filter(Boolean).join(': ');
  if (canvas.getAttribute('aria-label') !== label) canvas.setAttribute('aria-label', label);
  const [x0, y0, x1, y1] = state.window;
  const ratio = devicePixelRatio || 1;
  const wide = Math.max(1, Math.round(shown[i].width * ratio));
  const high = Math.round((wide * (y1 - y0)) / (x1 - x0));
  if (canvas.width !== wide || canvas.height !== high) Object.assign(canvas, { width: wide, height: high });
  const unit = wide / (x1 - x0);
  const view = { unit, x0, y0, x: (px) => (px - x0) * unit, y: (px) => (px - y0) * unit, ratio };
  shown[i].view = view;
  const g = canvas.getContext('2d');
  g.fillStyle = colours.empty;
  g.fillRect(0, 0, wide, high);
  if (!panel.view) {
    drawPixels(g, view, panel);
    drawGrid(g, view);
  }
  for (const outline of panel.outlines ?? answer.outlines ?? []) drawOutline(g, view, outline);
  panel.over?.(g, view);
  drawGrips(g, view, panel);
}

function chooser(i, name) {
  const select = make('select', { attr: { 'aria-label': `${word('panel')} ${i + 1}` } });
  for (const [value, label] of scene().choices()) select.append(make('option', { value }, label));
  select.value = name;
  select.addEventListener('change', () => { state.by[i] = select.value; redraw(); });
  return select;
}

/** A colour as the 32 bits of a picture, by the browser's own reading of it. */
const bits = new Map();
const reader = make('canvas', { width: 1, height: 1 }).getContext('2d', { willReadFrequently: true });
function bitsOf(colour) {
  let found = bits.get(colour);
  if (found === undefined) {
    if (bits.size > 50000) bits.clear();
    reader.fillStyle = colour;
    reader.fillRect(0, 0, 1, 1);
    found = new Uint32Array(reader.getImageData(0, 0, 1, 1).data.buffer)[0];
    bits.set(colour, found);
  }
  return found;
}

/** All pixels as one small picture, enlarged: a rectangle for each of them took most of a frame. */
const small = make('canvas').getContext('2d');
function drawPixels(g, view, panel) {
  const [x0, y0, x1, y1] = state.window;
  const [width, height] = [x1 - x0, y1 - y0];
  const image = new ImageData(width, height);
  const data = new Uint32Array(image.data.buffer);
  const signs = [];
  for (let i = 0; i < data.length; i += 1) {
    const [x, y] = [x0 + (i % width), y0 + Math.floor(i / width)];
    const pixel = panel.pixel?.(i, x, y);
    if (!pixel) continue;
    data[i] = bitsOf(pixel.colour);
    if (pixel.ring || (pixel.glyph && view.unit > 7)) signs.push([x, y, pixel]);
  }
  Object.assign(small.canvas, { width, height });
  small.putImageData(image, 0, 0);
  g.imageSmoothingEnabled = false;
  g.drawImage(small.canvas, 0, 0, width * view.unit, height * view.unit);
  if (signs.length === 0) return;
  g.font = `600 ${Math.floor(view.unit * 0.6)}px ui-monospace, Consolas, monospace`;
  g.textAlign = 'center';
  g.textBaseline = 'middle';
  g.strokeStyle = colours.cursor;
  g.fillStyle = colours.glyph;
  g.lineWidth = Math.max(1, view.ratio);
  for (const [x, y, { glyph, ring }] of signs) {
    if (glyph) g.fillText(glyph, view.x(x + 0.5), view.y(y + 0.5));
    if (ring) {
      g.beginPath();
      g.arc(view.x(x + 0.5), view.y(y + 0.5), view.unit * 0.36, 0, 7);
      g.stroke();
    }
  }
}

function drawGrid(g, view) {
  const [x0, y0, x1, y1] = state.window;
  if (view.unit >= 4) {
    g.strokeStyle = colours.grid;
    g.lineWidth = 1;
    g.beginPath();
    for (let x = x0; x <= x1; x += 1) { g.moveTo(Math.floor(view.x(x)) + 0.5, 0); g.lineTo(Math.floor(view.x(x)) + 0.5, view.y(y1)); }
    for (let y = y0; y <= y1; y += 1) { g.moveTo(0, Math.floor(view.y(y)) + 0.5); g.lineTo(view.x(x1), Math.floor(view.y(y)) + 0.5); }
    g.stroke();
  }
  if (view.unit >= 12 * view.ratio && !scene().noSamples) {
    g.fillStyle = colours.sample;
    const dot = Math.max(1.5, view.ratio);
    for (let y = y0; y < y1; y += 1) {
      for (let x = x0; x < x1; x += 1) g.fillRect(view.x(x + 0.5) - dot / 2, view.y(y + 0.5) - dot / 2, dot, dot);
    }
  }
}

function drawOutline(g, view, points, colour = colours.edge) {
  g.strokeStyle = colour;
  g.lineWidth = 1.5 * view.ratio;
  g.beginPath();
  points.forEach(([x, y], i) => (i ? g.lineTo(view.x(x), view.y(y)) : g.moveTo(view.x(x), view.y(y))));
  g.closePath();
  g.stroke();
}

function drawGrips(g, view, panel) {
  const all = grips();
  g.font = `600 ${12 * view.ratio}px system-ui, sans-serif`;
  g.textAlign = 'center';
  g.textBaseline = 'middle';
  all.forEach((grip, i) => {
    if (grip.view !== panel.view) return;
    const chosen = state.moves === 'corner' && i === state.chosen;
    const [x, y] = [view.x(grip.x), view.y(grip.y)];
    if (grip.isPainted) {
      if (!chosen) return;
      g.beginPath();
      g.arc(x, y, 13 * view.ratio, 0, 7);
      g.strokeStyle = colours.edge;
      g.lineWidth = 2 * view.ratio;
      g.stroke();
      return;
    }
    const radius = (chosen ? 7 : 5) * view.ratio;
    if (grip.from) drawOutline(g, view, [grip.from, [grip.x, grip.y]]);
    g.beginPath();
    // A corner is round, a value of it is not.
    if (grip.nudge) g.rect(x - radius, y - radius, 2 * radius, 2 * radius);
    else g.arc(x, y, radius, 0, 7);
    g.fillStyle = chosen ? colours.edge : colours.empty;
    g.fill();
    g.strokeStyle = colours.edge;
    g.lineWidth = 2 * view.ratio;
    g.stroke();
    g.fillStyle = colours.cursor;
    if (all.length > LETTERS.length) return;
    // Beside the corner, and inside of the panel.
    const isLeft = x < g.canvas.width - (8 + 12 * grip.name.length) * view.ratio;
    g.textAlign = isLeft ? 'left' : 'right';
    const place = [grip.name, x + (isLeft ? 9 : -9) * view.ratio, y + (y > 18 * view.ratio ? -9 : 11) * view.ratio];
    g.strokeStyle = colours.empty;
    g.lineWidth = 3 * view.ratio;
    g.lineJoin = 'round';
    g.strokeText(...place);
    g.fillText(...place);
  });
  if (state.px) {
    g.strokeStyle = colours.cursor;
    g.lineWidth = (state.moves === 'pixel' ? 3 : 2) * view.ratio;
    g.strokeRect(view.x(state.px[0]), view.y(state.px[1]), view.unit, view.unit);
  }
}
