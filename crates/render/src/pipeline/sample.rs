//! The samples of a picture: their colours and depths.

use super::depth::OFF_FRACTION;
use glam::DVec3;
use rasterproof_core::frame::Frame;

/// Red, green, blue and opacity, 8 bits each.
pub type Colour = [u8; 4];

/// The nearest [`Colour`] of red, green, blue in [0, 1]; beyond, the nearer end. The thresholds lie
/// off simple fractions, see [`super::depth`].
#[must_use]
#[inline]
pub fn to_colour(rgb: DVec3) -> Colour {
    // `as` takes what is below 0, and NaN, to 0 and what is above 255 to 255.
    let byte = |c: f64| (c * 255.0 + (0.5 + OFF_FRACTION)) as u8;
    [byte(rgb.x), byte(rgb.y), byte(rgb.z), u8::MAX]
}

/// Colour and depth of one sample of every pixel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SamplePlane {
    pub colour: Frame<Colour>,
    /// Keys of [`DepthFormat`](super::depth::DepthFormat), [`CLEAR`](super::depth::CLEAR) where nothing was drawn.
    pub depth: Frame<u64>,
}

impl SamplePlane {
    #[inline]
    pub fn write(&mut self, x_px: i32, y_px: i32, colour: Colour) {
        self.colour.span_mut(y_px, x_px, x_px + 1)[0] = colour;
    }

    #[inline]
    pub(crate) fn put(&mut self, x_px: i32, y_px: i32, key: u64, colour: Colour) {
        self.depth.span_mut(y_px, x_px, x_px + 1)[0] = key;
        self.write(x_px, y_px, colour);
    }

    /// Writes a fragment if it is nearer than what is there; says whether it was. The colour is
    /// asked for only then.
    #[inline]
    pub fn test_and_write(
        &mut self,
        x_px: i32,
        y_px: i32,
        key: u64,
        colour: impl FnOnce() -> Colour,
    ) -> bool {
        let stored = &mut self.depth.span_mut(y_px, x_px, x_px + 1)[0];
        let nearer = key < *stored;
        if nearer {
            *stored = key;
            self.colour.span_mut(y_px, x_px, x_px + 1)[0] = colour();
        }
        nearer
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_round_to_the_nearest() {
        assert_eq!(to_colour(DVec3::new(0.0, 1.0, 0.5)), [0, 255, 128, 255]);
        assert_eq!(to_colour(DVec3::new(-1.0, 2.0, f64::NAN)), [0, 255, 0, 255]);
        assert_eq!(to_colour(DVec3::splat(0.5f64.next_down())), [128, 128, 128, 255]);
    }
}
