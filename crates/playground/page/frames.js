// Frames: what is asked and drawn when something changed.

let pending = false;
function redraw() {
  if (pending) return;
  pending = true;
  requestAnimationFrame(() => {
    pending = false;
    const begun = performance.now();
    drawFrame();
    frames.push(performance.now() - begun);
    if (frames.length > 1000) frames.shift();
  });
  keepAddress();
}

function drawFrame() {
  const answer = scene().ask();
  trouble(answer.error ?? (state.refused && `${word('refusedAddress')} ${state.refused}`));
  if (!answer.error) {
    last.answer = answer;
    view.show(shownOf(answer));
  }
  pressTools();
  clearTimeout(explaining);
  explaining = setTimeout(() => explain(answer), Math.max(0, explained + 100 - performance.now()));
}

/** What is said beside the panels. Tables take longer than pixels, so they come behind the frame, and follow a drag ten times a second. */
let explained = 0;
let explaining = 0;
function explain(answer) {
  explained = performance.now();
  drawCorners();
  const same = command();
  if ($('command').textContent !== same) $('command').textContent = same;
  $('as-command').hidden = same === '';
  last.look = null;
  if (state.px && state.triangles) {
    const look = ask({ ask: 'look', picture: picture(), px: state.px });
    last.look = look.error ? null : look;
  }
  fill($('look'), scene().look && !answer.error ? scene().look(answer) : []);
  const grip = grips()[state.chosen];
  const outputs = view.shown.map((panel) => panel.canvas.getAttribute('aria-label'));
  // Of triangles the reason, which is short; elsewhere the numbers are what there is to say.
  const told = $('look').querySelectorAll(state.scene === 'triangle' ? 'h2, .say' : 'h2, p, tbody tr');
  const texts = [...told].map(({ cells, textContent }) => (cells ? [...cells].map((cell) => cell.textContent).join(' ').trim() : textContent));
  const said = [grip ? grip.says ?? `${grip.name} ${grip.x}, ${grip.y}` : '', ...outputs, ...texts].filter(Boolean).map((text) => (/[.。?？]$/.test(text) ? text : `${text}.`)).join(' ');
  if ($('announce').textContent !== said) $('announce').textContent = said;
}

function trouble(text) {
  $('trouble').hidden = !text;
  $('trouble').textContent = text ?? '';
}
