//! Invariant 46: an effect that is switched off, or not called for, makes no call at all.

use super::Outcome;
use super::implementations::Implementations;
use rasterproof_render::effects::{Effect, Effects, Mode};
use rasterproof_render::pipeline::depth::DepthFormat;
use rasterproof_render::pipeline::target::{Antialias, Target};
use rasterproof_render::scene::random;

/// 46: random scenes with one effect switched off, and scenes that call for nothing.
pub(super) fn disabled(subject: &Implementations, seed: u64, cases: u64) -> Outcome {
    let mut checked = 0;
    for index in 0..cases {
        let scene = random::scene(seed, index);
        for effect in Effect::ALL {
            let mut effects = Effects::ALWAYS.with(effect, Mode::Never);
            if effect == Effect::Colour {
                // Alone among the attributes.
                effects =
                    effects.with(Effect::Light, Mode::Never).with(Effect::Texture, Mode::Never);
            }
            let antialias =
                if effect == Effect::Samples { Antialias::Supersample(2) } else { Antialias::None };
            let Ok(mut target) = Target::new(24, 18, antialias, DepthFormat::Unorm32) else {
                return Err("a small target is refused".to_owned());
            };
            let counters = (subject.render)(&scene, &(subject.choose)(effects), &mut target);
            let calls = effect.calls(&counters);
            if calls != 0 {
                return Err(format!("scene {index}: {} off makes {calls} calls", effect.name()));
            }
            checked += 1;
        }
    }
    Ok(checked)
}
