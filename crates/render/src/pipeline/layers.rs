//! Layers: mixed fragments that wait until all surfaces are drawn, so that the order of drawing does not decide what
//! lies over what.
//!
//! When the frame is drawn, each sample takes its layers that are nearer than what is opaque there, at most so many of the
//! nearest, and mixes them from the farthest to the nearest ([`over`]). Of layers with equal keys of depth the less opaque one
//! counts as nearer, and then the one whose colour comes first as bytes. So the result is a function of the set of layers.

use super::opacity::over;
use super::sample::{Colour, SamplePlane};

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

/// The fragments of all samples that wait to be mixed.
#[derive(Clone, Debug, Default)]
pub(super) struct Layers {
    /// In the order of drawing until they are sorted.
    pub all: Vec<Layer>,
    /// A second list for sorting, kept from frame to frame so that its memory is asked for once.
    sorted: Vec<Layer>,
}

/// Fewer layers are sorted as they are.
const FEW: usize = 1 << 12;

impl Layers {
    /// Mixes the nearest layers of each sample, at most so many, with what is there; how many more were to be seen.
    pub fn mix(&mut self, most: u32, planes: &mut [SamplePlane]) -> u64 {
        let mut left_out = 0;
        self.sort(planes);
        for layers in
            self.all.chunk_by(|a, b| (a.plane, a.y_px, a.x_px) == (b.plane, b.y_px, b.x_px))
        {
            let Layer { plane, y_px, x_px, .. } = layers[0];
            let plane = &mut planes[usize::from(plane)];
            let stored = plane.depth.span_mut(y_px, x_px, x_px + 1)[0];
            let colour = &mut plane.colour.span_mut(y_px, x_px, x_px + 1)[0];
            left_out += mix_sample(layers, most, stored, colour);
        }
        self.all.clear();
        left_out
    }

    /// Sorts layers: many of them by rows first, then each row by columns, and then the few of each sample.
    fn sort(&mut self, planes: &[SamplePlane]) {
        let Self { all: layers, sorted } = self;
        let Some(plane) = planes.first().filter(|_| layers.len() > FEW) else {
            layers.sort_unstable();
            return;
        };
        let bounds = plane.depth.bounds();
        let (width, height) = (bounds.width() as usize, bounds.height() as usize);
        sorted.clear();
        sorted.extend_from_slice(layers);
        let row = |layer: &Layer| {
            usize::from(layer.plane) * height + layer.y_px.abs_diff(bounds.y0) as usize
        };
        let mut ends = vec![0; height * planes.len() + 1];
        by_number(layers, sorted, &mut ends, row);
        let mut columns = vec![0; width + 1];
        let (mut from, mut own) = (0, Vec::new());
        for to in ends {
            let part = &mut sorted[from..to];
            from = to;
            own.clear();
            own.extend_from_slice(part);
            columns.fill(0);
            let column = |layer: &Layer| layer.x_px.abs_diff(bounds.x0) as usize;
            by_number(&own, part, &mut columns, column);
            part.chunk_by_mut(|a, b| a.x_px == b.x_px).for_each(<[Layer]>::sort_unstable);
        }
        std::mem::swap(layers, sorted);
    }
}

/// Puts items in the order of their numbers; afterwards `ends` has for each number where those after it begin. It is all 0 before,
/// and has one place more than there are numbers.
fn by_number(
    items: &[Layer],
    sorted: &mut [Layer],
    ends: &mut [usize],
    number: impl Fn(&Layer) -> usize,
) {
    for item in items {
        ends[number(item) + 1] += 1;
    }
    for i in 1..ends.len() {
        ends[i] += ends[i - 1];
    }
    for item in items {
        let place = &mut ends[number(item)];
        sorted[*place] = *item;
        *place += 1;
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pipeline::depth::DepthFormat;
    use crate::pipeline::target::{Antialias, Target};
    use rasterproof_core::random::Rng;

    #[test]
    fn many_layers_are_sorted_as_few_are() {
        let mut rng = Rng::new("layers", 1, 0);
        for antialias in [Antialias::None, Antialias::Multisample4] {
            let target = Target::new(23, 17, antialias, DepthFormat::Unorm32).unwrap();
            let mut layers = Layers::default();
            for _ in 0..3 * FEW {
                let mut byte = || rng.int(0, 3) as u8;
                let (plane, opacity, colour) = (byte(), byte(), [byte(), byte(), 0, 255]);
                let plane = plane % antialias.planes() as u8;
                let [y_px, x_px] = [rng.int(0, 16), rng.int(0, 22)].map(|at| at as i32);
                let key = rng.int(0, 4) as u64;
                layers.all.push(Layer { plane, y_px, x_px, key, opacity, colour });
            }
            let mut sorted = layers.all.clone();
            sorted.sort_unstable();
            layers.sort(&target.planes);
            assert!(layers.all == sorted, "{antialias:?}");
        }
    }
}
