//! Clip: cutting a triangle by a plane.
//!
//! Left out for each plane that has no corner of the triangle on its other side (outcodes). The
//! clipper walks the polygon and adds a corner at each change of side: without a change it returns
//! what it got.

use super::survey::of_frame;
use crate::effects::plan::{Decision, Plan};
use crate::effects::{Effect, Effects, Mode};
use crate::pipeline::Counters;

/// The decision, with what assembly counted, or before it.
pub fn explain(
    effects: &Effects,
    plan: &Plan,
    triangles: u64,
    seen: Option<&Counters>,
) -> Decision {
    let mode = plan.items.first().map_or(effects.mode(Effect::Clip), |item| item.clip);
    let decide = |counts, reason: String| of_frame(effects, Effect::Clip, counts, reason);
    let Some(&Counters { clipped, rejected, .. }) = seen else {
        let counts = match mode {
            Mode::Planned | Mode::Material => [0, 0, triangles],
            Mode::Always => [triangles, 0, 0],
            Mode::Never => [0, triangles, 0],
        };
        return decide(counts, "each triangle is cut by the planes that it crosses".to_owned());
    };
    let reason = match (clipped, rejected) {
        (0, 0) => "no corner lies outside the view volume".to_owned(),
        (0, _) => format!("{rejected} triangles lie outside one plane altogether; none is cut"),
        _ => format!("{clipped} of {triangles} triangles cross a plane, {rejected} lie outside"),
    };
    let on = match mode {
        Mode::Planned | Mode::Material => clipped,
        Mode::Always => triangles - rejected,
        Mode::Never => 0,
    };
    decide([on, triangles - on, 0], reason)
}
