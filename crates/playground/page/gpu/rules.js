// What the specifications say, from the table by which every judge goes: crates/verify/src/specification/clauses.md.
const CLAUSES = {{clauses}};

/** The rule of a check in the language of the page: its section, what it asks for and leaves open, and its own words where they are at hand. */
const ruleOf = (name, check, lang = state.lang) => {
  const { says, open, ...rest } = CLAUSES[name][check === 'reach' ? 'coverage' : check];
  const at = Number(lang === 'zh');
  return { says: says[at], open: open[at], ...rest };
};
/** The same as asked() for a report, in English. */
const inWords = ({ quote, says }) => (quote ? `“${quote[0]}” (${quote[1]}) ${WORDS.en.inShort}: ${says}` : `${WORDS.en.ownWords}: ${says}`);
