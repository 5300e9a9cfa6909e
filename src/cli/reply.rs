//! What an answer of the line protocol is made of.

use crate::grid::Refusal;

/// The letter of an answer, its count and what is counted; or the reason why there is none.
pub type Reply = Result<(char, usize, String), String>;

/// A refusal with the name of the number that is refused.
pub fn named(name: &str) -> impl FnOnce(Refusal) -> String {
    move |refusal| format!("{name} {refusal}")
}
