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

/** Asks the engines; an answer, or an error as its text. Pixels are bytes of ASCII. */
function ask(question, bytes) {
  const whole = bytes ? { ...question, pixels: new TextDecoder().decode(bytes) } : question;
  const text = new TextEncoder().encode(JSON.stringify(whole));
  try {
    const at = engines.room(text.length);
    new Uint8Array(engines.memory.buffer, at, text.length).set(text);
    const length = engines.answer();
    return JSON.parse(new TextDecoder().decode(new Uint8Array(engines.memory.buffer, engines.text(), length)));
  } catch (error) {
    instantiate();
    return { error: `The engine stopped, and was started again. 引擎停了，已重新启动。 (${error.message})` };
  }
}
