// The page draws what the compiled engines answer, and listens. It computes no pixel of its own.
// The compiled module: questions and answers.

let engines = null;
let compiled = null;

function instantiate() {
  engines = new WebAssembly.Instance(compiled, {}).exports;
}

/** Asks the engines; an answer, or an error as its text. A module that stopped is started again. */
function ask(question) {
  const text = new TextEncoder().encode(JSON.stringify(question));
  try {
    const at = engines.room(text.length);
    new Uint8Array(engines.memory.buffer, at, text.length).set(text);
    const length = engines.answer();
    const bytes = new Uint8Array(engines.memory.buffer, engines.text(), length);
    return JSON.parse(new TextDecoder().decode(bytes));
  } catch (error) {
    instantiate();
    return { error: `${word('crash')} (${error.message})` };
  }
}
