//! Invariant 46: an effect that is switched off, or not called for, makes no call at all.

use super::Outcome;
use super::subject::Subject;
use rasterproof_render::effects::{Effect, Effects, Mode};
use rasterproof_render::pipeline::Counters;
use rasterproof_render::pipeline::depth::DepthFormat;
use rasterproof_render::pipeline::target::{Antialias, Target};
use rasterproof_render::scene::random;

/// What an effect costs, by the counts that belong to it alone.
fn calls(effect: Effect, counters: &Counters) -> u64 {
    match effect {
        Effect::Clip => counters.plane_tests,
        Effect::Cull => counters.cull_tests,
        Effect::WideWords => counters.wide,
        Effect::Perspective => counters.divisions,
        Effect::Depth => counters.depth_tests,
        Effect::DepthBuffer => counters.depths_cleared,
        // The colours of corners and every attribute together are components.
        Effect::Colour | Effect::Interpolation => counters.components,
        Effect::Light => counters.lights,
        Effect::Specular => counters.highlights,
        Effect::MipMaps => counters.levels,
        Effect::Fog => counters.fogged,
        Effect::AlphaTest => counters.alpha_tests,
        Effect::Blending => counters.blended,
        Effect::Texture => counters.texels,
        Effect::Samples => counters.expanded,
        Effect::Clear => counters.cleared,
        Effect::SecondBuffer => counters.presented,
    }
}

/// 46: random scenes with one effect switched off, and scenes that call for nothing.
pub(super) fn disabled(subject: &Subject, seed: u64, cases: u64) -> Outcome {
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
            let calls = calls(effect, &counters);
            if calls != 0 {
                return Err(format!("scene {index}: {} off makes {calls} calls", effect.name()));
            }
            checked += 1;
        }
    }
    Ok(checked)
}
