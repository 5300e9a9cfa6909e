//! Wide words: integers of more than 32 bits for the edge functions.
//!
//! Left out where 32 bits hold the edge functions of a piece, which its bounding box says. The
//! numbers are whole: those that fit a word are the same in a wider one.

use super::survey::Survey;
use crate::effects::Effect;
use crate::effects::plan::Decision;

pub fn explain(survey: &Survey<'_>) -> Decision {
    let Survey { has_widths, wide, pieces, .. } = *survey;
    if !has_widths {
        return survey.decide(Effect::WideWords, 0, "the engine's integers have one width");
    }
    if !survey.is_listed {
        return survey.leave_open(Effect::WideWords, "the narrowest that hold each piece");
    }
    let reason = match wide {
        0 => "32 bits hold the edge functions of every piece".to_owned(),
        _ if wide == pieces => "every piece is too large for 32 bits".to_owned(),
        _ => "some pieces are too large for 32 bits".to_owned(),
    };
    survey.decide(Effect::WideWords, wide, reason)
}
