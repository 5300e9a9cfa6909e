// What the specifications say, from the table by which every judge goes: crates/verify/src/specification/clauses.md.
const CLAUSES = {{clauses}};

/** The rule of a check in the language of the page: its section, what it asks for and leaves open, and its own words where they are at hand. */
const ruleOf = (name, check, lang = state.lang) => {
  const { says, open, ...rest } = CLAUSES[name][check === 'reach' ? 'coverage' : check];
  const at = Number(lang === 'zh');
  return { says: says[at], open: open[at], ...rest };
};
/** What a rule asks for: its own words where they are at hand, and ours. */
const inWords = ({ quote, says }, { inShort, ownWords } = WORDS[state.lang]) => (quote ? `“${quote[0]}” (${quote[1]}) ${inShort}: ${says}` : `${ownWords}: ${says}`);
