//! What to do about a picture, a text or a table that is not as it was.

/// The next commands, and the page to read.
pub const NEXT: &str = "\
old beside new, pixel by pixel, and how to accept what is right: cargo run -- review
the smallest case that is wrong, with its chapter: cargo run -- verify
how to read both: docs/verdict.md; each named case in a sentence: cargo run -- list";
