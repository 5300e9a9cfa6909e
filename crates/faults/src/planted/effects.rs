//! Faults in the formulas of effects: blending, layers, footprints of textures, shadows.

use glam::{DVec2, DVec3};

use rasterproof_core::arrays::MapArray as _;
use rasterproof_render::pipeline::footprint::{Footprint, Taps};
use rasterproof_render::pipeline::layers::{Layer, mix_sample};
use rasterproof_render::pipeline::opacity::over;
use rasterproof_render::pipeline::shadow::{LightView, ShadowMap};
use rasterproof_render::pipeline::target::Colour;

planted! {
    EffectMutant {
        OverShifts "over-shifts": "blending divides by 256 in place of 255",
        OverTruncates "over-truncates": "blending rounds down",
        LayersAsDrawn "layers-as-drawn": "layers are mixed in the order of drawing",
        LayersByDepthAlone "layers-by-depth-alone": "layers of one depth are mixed in the order of drawing",
        LayersThroughWalls "layers-through-walls": "layers behind an opaque surface are mixed too",
        TapsRoundedUp "taps-rounded-up": "a footprint is read as often as it is long over wide, rounded up",
        TapsAtFullLevel "taps-at-full-level": "each tap is read at the level of the whole footprint",
        LevelOfColumns "level-of-columns": "the level is that of the derivative by columns of pixels",
        ShadowWithoutSlope "shadow-without-slope": "the bias of a shadow does not follow the slope of the plane",
    }
}

/// Mixes the layers of one sample, in the order of drawing, with what is opaque there: at most so many, before this key of depth.
pub type MixStage = fn(&[Layer], u32, u64, Colour) -> Colour;
/// How a texture is read where (u, v) and w are these, at most so often.
pub type TapsStage = fn(&Footprint, DVec2, f64, u8) -> Taps;
/// How many of nine parts of the light reach a place in the plane through three.
pub type LitStage = fn(&LightView, &ShadowMap, [DVec3; 3], DVec3) -> u32;

/// The formulas of effects that have faults here.
#[derive(Clone, Copy)]
pub struct Formulas {
    /// Blends a colour over what was there before, by its opacity.
    pub over: fn(Colour, Colour, u8) -> Colour,
    /// Mixes what lies before the opaque surface of a sample, from the farthest layer on.
    pub mix: MixStage,
    /// How often a texture is read for a fragment, and at which level.
    pub taps: TapsStage,
    /// Decides how much light a place gets.
    pub lit: LitStage,
}

impl Formulas {
    /// The formulas of the pipeline, of which a mutant replaces one.
    pub const REAL: Self = Self {
        over,
        mix: |layers, most, stored, colour| {
            let mut layers = layers.to_vec();
            layers.sort_unstable();
            mixed(&layers, most, stored, colour)
        },
        taps: Footprint::taps,
        lit: |view, map, places, place| view.receiver(map, places).lit(place),
    };
}

/// The colour of a sample after its layers were mixed.
fn mixed(layers: &[Layer], most: u32, stored: u64, mut colour: Colour) -> Colour {
    mix_sample(layers, most, stored, &mut colour);
    colour
}

impl EffectMutant {
    /// The formulas with this fault in one of them.
    pub fn formulas(self) -> Formulas {
        let mut formulas = Formulas::REAL;
        match self {
            Self::OverShifts => {
                formulas.over = |colour, before, opacity| {
                    let [r, g, b] = weighted(colour, before, opacity).map_array(|sum| sum + 128);
                    [(r >> 8) as u8, (g >> 8) as u8, (b >> 8) as u8, u8::MAX]
                };
            }
            Self::OverTruncates => {
                formulas.over = |colour, before, opacity| {
                    let [r, g, b] = weighted(colour, before, opacity);
                    [(r / 255) as u8, (g / 255) as u8, (b / 255) as u8, u8::MAX]
                };
            }
            Self::LayersAsDrawn => {
                formulas.mix = |layers, most, stored, colour| {
                    let seen = layers.iter().copied().filter(|layer| layer.key < stored);
                    mixed(&seen.collect::<Vec<_>>(), most, stored, colour)
                };
            }
            Self::LayersByDepthAlone => {
                formulas.mix = |layers, most, stored, colour| {
                    let mut layers = layers.to_vec();
                    layers.sort_by_key(|layer| layer.key);
                    mixed(&layers, most, stored, colour)
                };
            }
            Self::LayersThroughWalls => {
                formulas.mix = |layers, most, _, colour| {
                    let mut layers = layers.to_vec();
                    layers.sort_unstable();
                    mixed(&layers, most, u64::MAX, colour)
                };
            }
            Self::TapsRoundedUp => {
                formulas.taps = |footprint, uv, w, most| {
                    let [x, y] = footprint.lengths(uv, w);
                    // The length of the footprint in its widths.
                    let ratio = x.max(y) / x.min(y).max(1.0);
                    let real = footprint.taps(uv, w, most);
                    let count = (ratio.ceil() as u8).clamp(1, most);
                    let level = libm::log2(x.max(y) / f64::from(count));
                    Taps { count, level, ..real }
                };
            }
            Self::TapsAtFullLevel => {
                formulas.taps = |footprint, uv, w, most| Taps {
                    level: footprint.level(uv, w),
                    ..footprint.taps(uv, w, most)
                };
            }
            Self::LevelOfColumns => {
                formulas.taps = |footprint, uv, w, most| {
                    let real = footprint.taps(uv, w, most);
                    let [x, _] = footprint.lengths(uv, w);
                    Taps { level: libm::log2(x / f64::from(real.count)), ..real }
                };
            }
            Self::ShadowWithoutSlope => {
                formulas.lit = |view, map, places, place| {
                    // As if the plane faced the light, so that the bias is too small for planes that do not.
                    let flat = places.map_array(|corner| DVec3 { z: places[0].z, ..corner });
                    view.receiver(map, flat).lit(place)
                };
            }
        }
        formulas
    }
}

/// 255 times the mixture of two colours by an opacity.
fn weighted(colour: Colour, before: Colour, opacity: u8) -> [u32; 3] {
    let a = u32::from(opacity);
    let mut sums = [0; 3];
    for (i, sum) in sums.iter_mut().enumerate() {
        *sum = a * u32::from(colour[i]) + (255 - a) * u32::from(before[i]);
    }
    sums
}
