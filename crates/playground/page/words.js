// The words of the page in both languages, and in Chinese what cases and painters are about. A key that a language lacks would show as itself.
const WORDS = {{words}};

/** Words in the language of the page, with values where they have `{}`. */
function word(key, ...values) {
  const text = WORDS[state.lang][key] ?? pixelWords()[key] ?? key;
  return values.reduce((filled, value) => filled.replace('{}', () => value), text);
}

/** What an entry of the engines' lists is about: in English the engines say it. */
const about = ({ name, about: said = '' }) => WORDS[state.lang].cases[name] ?? said;
