//! Clip: cutting a triangle by a plane.
//!
//! Left out for each plane that has no corner of the triangle on its other side (outcodes). The
//! clipper walks the polygon and adds a corner at each change of side: without a change it returns
//! what it got.
//!
//! A triangle that lies outside one plane altogether is *rejected*, which is not cutting: it is counted
//! apart, and no mode of the effect switches it off.

use super::account::of_frame;
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
    let Some(&Counters { triangles, clipped, rejected, .. }) = seen else {
        let counts = match mode {
            Mode::Planned | Mode::Material => [0, 0, triangles],
            Mode::Always => [triangles, 0, 0],
            Mode::Never => [0, triangles, 0],
        };
        return decide(counts, "each triangle is cut by the planes that it crosses".to_owned());
    };
    let left = triangles.saturating_sub(rejected);
    let on = match mode {
        Mode::Planned | Mode::Material => clipped,
        Mode::Always => left,
        Mode::Never => 0,
    };
    let mut decision = decide(
        [on, left.saturating_sub(on), 0],
        if on == 0 { "no triangle crosses a plane" } else { "those that cross a plane" }.to_owned(),
    );
    if rejected > 0 {
        decision.reason += &format!("; {rejected} more are rejected, outside one plane altogether");
    }
    decision
}
