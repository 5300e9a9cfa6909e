//! Cull: asking for the winding.
//!
//! Left out where nobody asked for it. Leaving out the back faces of a closed body is *not*
//! inferred: at the silhouette front and back may have equal depths, so it can change a pixel.

use super::survey::Survey;
use crate::effects::plan::Decision;
use crate::effects::{Effect, Mode};
use crate::pipeline::assemble::Cull;

pub fn explain(survey: &Survey<'_>) -> Decision {
    let cull = survey.item.cull;
    let reason = match cull {
        Cull::None => "not asked for",
        Cull::Clockwise => "asked for: clockwise pieces are left out",
        Cull::CounterClockwise => "asked for: counter-clockwise pieces are left out",
    };
    let asks = match survey.effects.mode(Effect::Cull) {
        Mode::Planned | Mode::Material => cull != Cull::None,
        Mode::Always => true,
        Mode::Never => false,
    };
    survey.decide_triangles(Effect::Cull, asks, reason)
}
