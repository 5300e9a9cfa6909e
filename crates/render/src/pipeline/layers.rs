//! Layers: mixed fragments that wait until all surfaces are drawn, so that the order of drawing does not decide what
//! lies over what.
//!
//! When the frame is drawn, each sample takes its layers that are nearer than what is opaque there, at most so many of the
//! nearest, and mixes them from the farthest to the nearest ([`over`]). Of layers with equal keys of depth the less opaque one
//! counts as nearer, and then the one whose colour comes first as bytes. So the result is a function of the set of layers.

use super::opacity::over;
use super::target::{Colour, SamplePlane};

/// A fragment that waits. The order is that of samples, and in each from the nearest on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Layer {
    pub plane: u8,
    pub y_px: i32,
    pub x_px: i32,
    /// Of [`super::depth::DepthFormat`].
    pub key: u64,
    pub opacity: u8,
    pub colour: Colour,
}

/// The layers of all samples, in the order of drawing.
#[derive(Clone, Debug, Default)]
pub(super) struct Layers(pub Vec<Layer>);

impl Layers {
    /// Mixes the nearest layers of each sample, at most so many, with what is there; how many more were to be seen.
    pub fn mix(&mut self, most: u32, planes: &mut [SamplePlane]) -> u64 {
        let mut left_out = 0;
        self.0.sort_unstable();
        for layers in self.0.chunk_by(|a, b| (a.plane, a.y_px, a.x_px) == (b.plane, b.y_px, b.x_px))
        {
            let Layer { plane, y_px, x_px, .. } = layers[0];
            let plane = &mut planes[usize::from(plane)];
            let stored = plane.depth.span_mut(y_px, x_px, x_px + 1)[0];
            let colour = &mut plane.colour.span_mut(y_px, x_px, x_px + 1)[0];
            left_out += mix_sample(layers, most, stored, colour);
        }
        self.0.clear();
        left_out
    }
}

/// Mixes the layers of one sample, sorted, with the colour of what is opaque there, whose key of depth is `stored`; how many
/// more than `most` were to be seen.
pub fn mix_sample(layers: &[Layer], most: u32, stored: u64, colour: &mut Colour) -> u64 {
    let nearer = layers.partition_point(|layer| layer.key < stored);
    let mixed = nearer.min(most as usize);
    for layer in layers[..mixed].iter().rev() {
        *colour = over(layer.colour, *colour, layer.opacity);
    }
    (nearer - mixed) as u64
}
