//! Linear light: what glTF computes in, and the encoding of sRGB (IEC 61966-2-1), in which pictures are stored and shown.

use std::sync::LazyLock;

use glam::DVec3;

use super::depth::OFF_FRACTION;
use super::sample::Colour;
use rasterproof_core::arrays::MapArray as _;

/// The linear light of a channel in [0, 1] that is encoded.
#[must_use]
pub fn decoded(channel: f64) -> f64 {
    if channel <= 0.040_45 { channel / 12.92 } else { libm::pow((channel + 0.055) / 1.055, 2.4) }
}

/// For each byte but the first, the least light that is nearer to it than to the one before.
static STEPS: LazyLock<[f64; 255]> = LazyLock::new(|| {
    std::array::from_fn(|byte| decoded((byte as f64 + 0.5 - OFF_FRACTION) / 255.0))
});

/// The byte whose encoding is nearest to that of this light; beyond [0, 1] the nearer end, of NaN 0. It is found by comparisons
/// alone, so that two engines that differ in the last bit of a light differ here only on a threshold.
#[must_use]
pub fn encoded_byte(light: f64) -> u8 {
    STEPS.partition_point(|step| *step <= light) as u8
}

/// The colour that shows this light.
#[must_use]
pub fn encoded(light: DVec3) -> Colour {
    let [r, g, b] = light.to_array().map_array(encoded_byte);
    [r, g, b, u8::MAX]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_byte_is_encoded_as_it_was_decoded() {
        for byte in 0..=u8::MAX {
            let light = decoded(f64::from(byte) / 255.0);
            assert_eq!(encoded_byte(light), byte);
        }
        // By the table of the standard: half of the light is 188, a fifth 124, and one step in the line at the start is 0.0003.
        assert_eq!([0.5, 0.2, 0.0003, 0.000_45].map(encoded_byte), [188, 124, 1, 1]);
        assert_eq!([-1.0, 2.0, f64::NAN, f64::INFINITY].map(encoded_byte), [0, 255, 0, 255]);
    }
}
