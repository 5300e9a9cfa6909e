//! What an answer of the line protocol is made of.

use std::io::Write as _;

use rasterproof_core::grid::Refusal;
use rasterproof_core::triangle::{Span, refused_number};

/// The letter of an answer, its count and what is counted; or the reason why there is none.
pub type Reply = Result<(char, usize, Vec<u8>), String>;

/// A refusal of a number, with the name of the number before it.
pub fn named(name: &str) -> impl FnOnce(Refusal) -> String {
    move |refusal| refused_number(name, refusal)
}

/// Appends whole numbers, a space before each.
pub fn write_words<const N: usize>(out: &mut Vec<u8>, words: [i32; N]) {
    for word in words {
        // Writing to a vector does not fail.
        let _ = write!(out, " {word}");
    }
}

/// Appends a run in the order of the protocol.
pub fn write_run(out: &mut Vec<u8>, span: Span) {
    write_words(out, [span.y_px, span.x0_px, span.x1_px]);
}
