// The compiled module: questions and answers. The page draws what it answers, and computes no pixel of its own.

let engines = null;
let compiled = null;

const bytesOf = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));

/** Starts the engines; those of a module that stopped are started again. */
function instantiate(module = compiled) {
  compiled = module;
  engines = new WebAssembly.Instance(compiled, {}).exports;
  return engines;
}

/**
 * Asks the engines; an answer, or an error as its text. Pixels are bytes of ASCII, and
 * become the text `pixels` of the question without being copied through one.
 */
function ask(question, pixels) {
  let text = new TextEncoder().encode(JSON.stringify(question));
  if (pixels) {
    const before = new TextEncoder().encode(`${JSON.stringify(question).slice(0, -1)},"pixels":"`);
    text = new Uint8Array(before.length + pixels.length + 2);
    text.set(before);
    text.set(pixels, before.length);
    text.set([0x22, 0x7d], before.length + pixels.length);
  }
  try {
    const at = engines.room(text.length);
    new Uint8Array(engines.memory.buffer, at, text.length).set(text);
    const length = engines.answer();
    const bytes = new Uint8Array(engines.memory.buffer, engines.text(), length);
    return JSON.parse(new TextDecoder().decode(bytes));
  } catch (error) {
    instantiate();
    return { error: `The engine stopped, and was started again. 引擎停了，已重新启动。 (${error.message})` };
  }
}
