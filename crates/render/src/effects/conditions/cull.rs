//! Cull: asking for the winding.
//!
//! Left out where nobody asked for it. Leaving out the back faces of a closed body is *not*
//! inferred: at the silhouette front and back may have equal depths, so it can change a pixel.

use super::account::Account;
use crate::effects::Effect;
use crate::effects::plan::Decision;
use crate::pipeline::assemble::Cull;

pub fn explain(account: &Account<'_>) -> Decision {
    let cull = account.asked.item.cull;
    let reason = match cull {
        Cull::None => "not asked for",
        Cull::Clockwise => "asked for: clockwise pieces are left out",
        Cull::CounterClockwise => "asked for: counter-clockwise pieces are left out",
    };
    let asks = account.asked.effects.pays(Effect::Cull, cull != Cull::None);
    account.decide_triangles(Effect::Cull, asks, reason)
}
