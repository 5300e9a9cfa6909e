//! Second buffer: a front buffer that never shows an unfinished frame.
//!
//! Left out where the picture is looked at when it is finished.

use super::account::of_frame;
use crate::effects::plan::{Canvas, Decision};
use crate::effects::{Effect, Effects};

pub fn pays(canvas: &Canvas, effects: &Effects) -> bool {
    effects.pays(Effect::SecondBuffer, canvas.watched)
}

pub fn explain(canvas: &Canvas, effects: &Effects) -> Decision {
    let reason = if canvas.watched {
        "somebody looks while it is drawn"
    } else {
        "the picture is looked at when it is finished"
    };
    let pixels = canvas.pixels();
    let counts = if pays(canvas, effects) { [pixels, 0, 0] } else { [0, pixels, 0] };
    of_frame(effects, Effect::SecondBuffer, counts, reason.to_owned())
}
