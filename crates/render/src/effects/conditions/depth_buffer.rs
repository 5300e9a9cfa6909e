//! Depth buffer: clearing it before the frame.
//!
//! Left out where no piece is tested.

use super::account::of_frame;
use crate::effects::plan::{Canvas, Decision, FramePlan, Samples};
use crate::effects::{Effect, Effects};
use crate::scene::{Hidden, Scene};

/// Whether the buffer is cleared; samples on demand start farthest away.
pub fn clears(effects: &Effects, is_tested: bool, samples: Samples) -> bool {
    effects.pays(Effect::DepthBuffer, is_tested && !matches!(samples, Samples::OnDemand { .. }))
}

pub fn explain(
    scene: &Scene,
    effects: &Effects,
    canvas: &Canvas,
    frame: &FramePlan,
    is_tested: bool,
) -> Decision {
    let reason = match (scene.hidden, is_tested) {
        (Hidden::Painter, _) => "the scene is drawn from back to front",
        (_, false) => "no depth is tested",
        (_, true) => "depths are tested",
    };
    let on_demand = matches!(frame.samples, Samples::OnDemand { .. }) && is_tested;
    let on = if on_demand { canvas.pixels() } else { 0 }
        + if frame.clear_depths { canvas.samples() } else { 0 };
    let off = canvas.samples().saturating_sub(on);
    of_frame(effects, Effect::DepthBuffer, [on, off, 0], reason.to_owned())
}
