// What both pages are made with.

const word = (key) => WORDS[state.lang][key] ?? key;
const $ = (id) => document.getElementById(id);

/** An element with properties, attributes (as `attr`) and children. */
function make(tag, properties = {}, ...children) {
  const { attr = {}, ...rest } = properties;
  const element = Object.assign(document.createElement(tag), rest);
  for (const [name, value] of Object.entries(attr)) element.setAttribute(name, value);
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}
