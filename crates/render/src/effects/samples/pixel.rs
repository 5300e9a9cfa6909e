//! A pixel that is whole, in parts, or apart, and what becomes of it under a piece.

use super::pattern::Pattern;
use super::sample_masks::{Parts, SampleMask};
use crate::pipeline::depth::CLEAR;
use crate::pipeline::target::Colour;

/// Keys that no sample's depth in a pixel is nearer than, and none farther.
pub type Interval = [u64; 2];

/// That of a pixel in which nothing was drawn.
pub const EMPTY: Interval = [CLEAR; 2];

/// A pixel that is not in parts yet.
#[derive(Clone, Copy)]
pub struct Pixel {
    pub colour: Colour,
    pub state: State,
    pub interval: Interval,
}

/// Where a pixel's samples come from.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum State {
    Background,
    /// All samples are of this piece.
    Whole(u32),
    /// The samples are of several pieces, here in the pool of parts.
    Parts(u32),
    /// The samples are in the target.
    Apart,
}

/// What becomes of a pixel that a piece touches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Meeting {
    /// Nothing: everything there is nearer.
    Hidden,
    /// It is of the piece as a whole.
    Whole,
    /// Its samples decide one by one.
    Apart,
}

impl Pixel {
    /// Draws a piece on some of its samples; its place in the pool afterwards. None, with nothing
    /// drawn, where they are apart or must be.
    pub fn draw(
        self,
        part: SampleMask,
        depth: bool,
        pool: &mut Pool,
        pattern: &Pattern,
    ) -> Option<u32> {
        let Self { colour, state, interval: [nearest, farthest] } = self;
        let serial = match state {
            State::Apart => return None,
            State::Parts(index) => {
                return pool.parts[index as usize].draw(part, depth).then_some(index);
            }
            State::Whole(serial) => Some(serial),
            State::Background => None,
        };
        let whole = SampleMask { serial, samples: pattern.all(), colour, nearest, farthest };
        let mut parts = Parts::of(whole);
        parts.draw(part, depth).then(|| pool.add(parts))
    }
}

/// What becomes of a pixel under a piece that covers all its samples or some of them, at depths
/// between two keys, or drawn over whatever is there.
#[inline]
pub fn meet(interval: &mut Interval, covered: bool, keys: Option<Interval>) -> Meeting {
    let Some([nearest, farthest]) = keys else {
        if covered {
            *interval = [0, 0];
            return Meeting::Whole;
        }
        return Meeting::Apart;
    };
    if nearest >= interval[1] {
        return Meeting::Hidden;
    }
    if covered && farthest < interval[0] {
        *interval = [nearest, farthest];
        return Meeting::Whole;
    }
    // Nothing that is drawn moves a sample away from the eye, and where all samples are covered
    // none is left behind the piece.
    interval[0] = interval[0].min(nearest);
    if covered {
        interval[1] = interval[1].min(farthest);
    }
    Meeting::Apart
}

/// The parts of all pixels that have several.
#[derive(Default)]
pub struct Pool {
    pub parts: Vec<Parts>,
    /// Places that are of no pixel any more.
    pub spare: Vec<u32>,
}

impl Pool {
    /// The place of new parts.
    pub fn add(&mut self, parts: Parts) -> u32 {
        if let Some(index) = self.spare.pop() {
            self.parts[index as usize] = parts;
            return index;
        }
        self.parts.push(parts);
        self.parts.len() as u32 - 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pixel_is_hidden_whole_or_apart() {
        let met = |covered: bool, keys: &[Option<(u64, u64)>]| {
            let mut interval = EMPTY;
            let mut last = Meeting::Hidden;
            for keys in keys {
                last = meet(&mut interval, covered, keys.map(Interval::from));
            }
            (last, interval[0], interval[1])
        };
        assert_eq!(met(true, &[Some((5, 9))]), (Meeting::Whole, 5, 9));
        assert_eq!(met(false, &[Some((5, 9))]), (Meeting::Apart, 5, CLEAR));
        assert_eq!(met(true, &[Some((5, 9)), Some((9, 12))]), (Meeting::Hidden, 5, 9));
        assert_eq!(met(true, &[Some((5, 9)), Some((8, 12))]), (Meeting::Apart, 5, 9));
        assert_eq!(met(true, &[Some((5, 9)), Some((2, 5))]), (Meeting::Apart, 2, 5));
        assert_eq!(met(true, &[Some((5, 9)), Some((2, 4))]), (Meeting::Whole, 2, 4));
        assert_eq!(met(true, &[Some((5, 9)), None]).0, Meeting::Whole);
        assert_eq!(met(false, &[None]).0, Meeting::Apart);
    }
}
