//! Fragments of a run, how they are kept, and who gives them their colours.

use super::opacity::OPAQUE;
use super::target::Colour;
use rasterproof_core::contract::Varyings;

/// How the fragments of a triangle are made and kept: what the fragment stage does not see.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Way {
    /// Interpolate linearly in the window: right where the three w are equal.
    pub affine: bool,
    /// Compare with the depth buffer and write to it; else every fragment is drawn.
    pub depth_test: bool,
    pub over: Over,
}

/// What becomes of what was there before a fragment.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Over {
    /// It is gone: the fragment is opaque.
    #[default]
    Replace,
    /// By the opacity of the fragment it is gone, mixed or left.
    Mix,
    /// The same, but what is mixed waits, to be mixed in the order of depths.
    Keep,
}

/// Adjacent fragments of a row, of which those are wanted whose bits are set, the lowest for the first.
pub struct Lanes<'a, V> {
    pub values: &'a [V],
    pub depths: &'a [f64],
    pub wanted: u32,
}

/// What gives fragments their colours.
pub trait FragmentStage<V> {
    /// The colours of the fragments that are wanted go to their places; others stay.
    fn colours(&mut self, run: Lanes<'_, V>, colours: &mut [Colour]);

    /// The same of their opacities, where 255 is opaque.
    fn opacities(&mut self, _: Lanes<'_, V>, opacities: &mut [u8]) {
        opacities.fill(OPAQUE);
    }
}

/// A stage of opaque fragments by themselves: their varyings and depths.
pub fn each<V, F: FnMut(&V, f64) -> Colour>(stage: F) -> F {
    stage
}

impl<V, F: FnMut(&V, f64) -> Colour> FragmentStage<V> for F {
    fn colours(&mut self, run: Lanes<'_, V>, colours: &mut [Colour]) {
        let fragments = run.values.iter().zip(run.depths).zip(colours).enumerate();
        for (i, ((varying, depth), colour)) in fragments {
            if run.wanted >> i & 1 != 0 {
                *colour = self(varying, *depth);
            }
        }
    }
}

/// The bits of the first `count` pixels, of which there is at least one.
#[inline]
pub(crate) fn all_of(count: usize) -> u32 {
    u32::MAX >> (u32::BITS as usize - count)
}

/// Shades the pixels of a run whose bits are set; `depths` and `colours` are those of the whole run.
#[inline]
pub(crate) fn shade<V>(
    (values, depths): (&mut dyn Varyings<V>, &[f64]),
    wanted: u32,
    stage: &mut dyn FragmentStage<V>,
    colours: &mut [Colour],
) {
    let from = wanted.trailing_zeros() as usize;
    let to = (u32::BITS - wanted.leading_zeros()) as usize;
    let (values, depths) = (values.varyings(from, to), &depths[from..to]);
    stage.colours(Lanes { values, depths, wanted: wanted >> from }, &mut colours[from..to]);
}
