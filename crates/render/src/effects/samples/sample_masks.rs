//! A pixel whose samples are of several pieces: which piece each sample is of, as masks.
//!
//! Neighbours in a mesh have no sample in common, and what lies behind is behind by more than a
//! pixel's range of depths. So most pixels at borders are settled by masks and intervals alone, and
//! no depth of a sample is ever computed.

use crate::pipeline::target::Colour;

/// The samples of a pixel that are of one piece.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SampleMask {
    /// The piece; none for the background.
    pub serial: Option<u32>,
    /// A bit for each sample.
    pub samples: u64,
    pub colour: Colour,
    /// Keys that no depth of these samples is nearer or farther than.
    pub nearest: u64,
    pub farthest: u64,
}

/// All samples of a pixel, in parts.
#[derive(Clone, Copy, Debug)]
pub struct Parts {
    parts: [SampleMask; Self::MOST],
    len: usize,
}

impl Parts {
    /// Pixels with more parts are drawn sample by sample.
    const MOST: usize = 4;

    pub fn of(whole: SampleMask) -> Self {
        Self { parts: [whole; Self::MOST], len: 1 }
    }

    pub fn iter(&self) -> impl Iterator<Item = &SampleMask> {
        self.parts[..self.len].iter()
    }

    /// Draws a piece, over what is there or where it is nearer. False, with nothing drawn, where the
    /// samples decide one by one, or where there would be too many parts.
    pub fn draw(&mut self, new: SampleMask, depth: bool) -> bool {
        let count = self.len;
        let parts = &self.parts[..count];
        let is_over = |part: &SampleMask| !depth || new.farthest < part.nearest;
        let meets = |part: &&SampleMask| part.samples & new.samples != 0;
        if parts.iter().filter(meets).any(|part| !is_over(part) && new.nearest < part.farthest) {
            return false;
        }
        let hidden = |part: &&SampleMask| meets(part) && !is_over(part);
        let behind = parts.iter().filter(hidden).fold(0, |all, part| all | part.samples);
        let samples = new.samples & !behind;
        let left = parts.iter().filter(|part| part.samples & !samples != 0).count();
        if left == Self::MOST && samples != 0 {
            return false;
        }
        self.len = 0;
        for i in 0..count {
            let part = self.parts[i];
            self.push(SampleMask { samples: part.samples & !samples, ..part });
        }
        self.push(SampleMask { samples, ..new });
        true
    }

    fn push(&mut self, part: SampleMask) {
        if part.samples != 0 {
            self.parts[self.len] = part;
            self.len += 1;
        }
    }

    /// Keys that no depth is nearer or farther than.
    pub fn range(&self) -> [u64; 2] {
        self.iter().fold([u64::MAX, 0], |[nearest, farthest], part| {
            [nearest.min(part.nearest), farthest.max(part.farthest)]
        })
    }

    /// The mean of the samples, as [`crate::pipeline::target::Target::pixel`] has it.
    pub fn mean(&self) -> Colour {
        let mut sum = [0u32; 4];
        let mut samples = 0;
        for part in self.iter() {
            let count = part.samples.count_ones();
            samples += count;
            sum = [0, 1, 2, 3].map(|i| sum[i] + count * u32::from(part.colour[i]));
        }
        // A mean of bytes is a byte.
        sum.map(|channel| ((channel + samples / 2) / samples) as u8)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn part(serial: u32, samples: u64, nearest: u64, farthest: u64) -> SampleMask {
        let colour = [serial as u8 * 10, 0, 0, 255];
        SampleMask { serial: Some(serial), samples, colour, nearest, farthest }
    }

    #[test]
    fn parts_by_hand() {
        let background = SampleMask { serial: None, ..part(0, 0b1111, u64::MAX, u64::MAX) };
        let mut pixel = Parts::of(background);
        let serials = |pixel: &Parts| -> Vec<_> {
            pixel.iter().map(|part| (part.serial, part.samples)).collect()
        };
        assert!(pixel.draw(part(1, 0b0011, 50, 60), true));
        assert!(pixel.draw(part(2, 0b0100, 50, 60), true), "beside the first");
        assert_eq!(serials(&pixel), [(None, 0b1000), (Some(1), 0b0011), (Some(2), 0b0100)]);
        assert_eq!(pixel.range(), [50, u64::MAX]);
        // (1 x 0 + 2 x 10 + 1 x 20) / 4.
        assert_eq!(pixel.mean(), [10, 0, 0, 255]);
        assert!(pixel.draw(part(3, 0b0110, 60, 70), true), "behind: an equal key is behind");
        assert_eq!(serials(&pixel), [(None, 0b1000), (Some(1), 0b0011), (Some(2), 0b0100)]);
        let before = serials(&pixel);
        assert!(!pixel.draw(part(4, 0b0110, 59, 70), true), "may be either");
        assert!(!pixel.draw(part(4, 0b0110, 10, 50), true), "may be equal");
        assert_eq!(serials(&pixel), before);
        assert!(pixel.draw(part(5, 0b1110, 10, 49), true), "nearer");
        assert_eq!(serials(&pixel), [(Some(1), 0b0001), (Some(5), 0b1110)]);
        assert!(pixel.draw(part(6, 0b0010, 90, 99), false), "over it");
        assert!(pixel.draw(part(7, 0b0100, 90, 99), false));
        assert_eq!(pixel.len, 4);
        assert_eq!(pixel.iter().map(|part| part.samples).fold(0, |a, b| a ^ b), 0b1111);
    }

    #[test]
    fn a_fifth_part_is_refused() {
        let mut pixel = Parts::of(part(0, 0xff, 90, 99));
        for serial in 1..4 {
            assert!(pixel.draw(part(serial, 1 << serial, 10, 20), true));
        }
        assert_eq!(pixel.len, 4);
        assert!(!pixel.draw(part(4, 1 << 4, 10, 20), true));
        assert!(pixel.draw(part(4, 0b1110, 1, 2), true), "in the place of three");
        assert_eq!(pixel.len, 2);
    }
}
