// Frames: what is asked and drawn when something changed.

let pending = false;
// How many frames have been asked for, and with how many all that is shown has been said.
let [asked, told] = [0, 0];
function redraw() {
  asked += 1;
  if (pending) return;
  pending = true;
  requestAnimationFrame(() => {
    pending = false;
    drawFrame();
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
  explainSoon(answer, asked);
}

/** What is said beside the panels. Tables take longer than pixels, so they follow a drag some times a second, where frames leave time for them. */
const explainSoon = paced(explain, 100);
function explain(answer, frames) {
  last.look = null;
  if (state.px && state.triangles) {
    const look = ask({ ask: 'look', picture: picture(), px: state.px });
    last.look = look.error ? null : look;
  }
  const beside = scene().look && !answer.error ? scene().look(answer) : [];
  renew($('look'), beside);
  pressTools();
  drawCorners();
  // What is read aloud holds the tables, too, so it is said after them.
  settleLater(() => settled(frames), 100);
}

const isStill = () => asked === told;

/** What is said once nothing moves: the command, and what a screen reader reads aloud. */
const settleLater = delayed();
function settled(frames) {
  const same = command();
  say($('command'), same);
  $('as-command').hidden = same === '';
  const grip = grips()[state.chosen];
  const outputs = view.shown.map((panel) => panel.canvas.getAttribute('aria-label'));
  // Of triangles the reason, which is short; elsewhere the numbers are what there is to say.
  const explained = $('look').querySelectorAll(state.scene === 'triangle' ? 'h2, .say' : 'h2, p, tbody tr');
  const texts = [...explained].map(({ cells, textContent }) => (cells ? [...cells].map((cell) => cell.textContent).join(' ').trim() : textContent));
  const said = [grip ? grip.says ?? `${grip.name} ${grip.x}, ${grip.y}` : '', ...outputs, ...texts].filter(Boolean).map((text) => (/[.。?？]$/.test(text) ? text : `${text}.`)).join(' ');
  say($('announce'), said);
  told = frames;
}

const trouble = (text) => say($('trouble'), text ?? '');
