//! Wide words: integers of more than 32 bits for the edge functions.
//!
//! Left out where 32 bits hold the edge functions of a piece, which its bounding box says. The
//! numbers are whole: those that fit a word are the same in a wider one.

use super::account::Account;
use crate::effects::Effect;
use crate::effects::plan::Decision;

pub fn explain(account: &Account<'_>) -> Decision {
    if !account.has_widths {
        return account.decide(Effect::WideWords, 0, "the engine's integers have one width");
    }
    account.decide_each(
        Effect::WideWords,
        "the narrowest that hold each piece",
        [
            "32 bits hold the edge functions of every piece",
            "every piece is too large for 32 bits",
            "some pieces are too large for 32 bits",
        ],
    )
}
