//! What the tests print where a table, a picture or a text is not as it was.

/// The commands and the page that help.
pub const NEXT: &str = "\
old beside new, pixel by pixel, and how to accept what is right: cargo run -- review
the smallest case that is wrong, with its chapter: cargo run -- verify
how to read both: docs/differential.md; each named case in a sentence: cargo run -- list";
