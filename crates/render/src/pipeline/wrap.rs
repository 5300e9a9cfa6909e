//! What a texture is beyond its borders.

use std::ops::RangeInclusive;

/// What lies beyond [0, 1].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub enum Wrap {
    /// The texture again.
    #[default]
    Repeat,
    /// Its border.
    Clamp,
    /// The texture again, every other time mirrored.
    Mirror,
}

/// The same in u and in v.
impl From<Wrap> for [Wrap; 2] {
    fn from(wrap: Wrap) -> Self {
        [wrap; 2]
    }
}

/// The column or row that is read in place of `at`. Sides are mostly powers of two, and then the
/// remainder is a mask: a division by a number that is not known before takes longer than the rest.
#[inline]
pub(super) fn wrapped(wrap: Wrap, at: i64, side: i64) -> i64 {
    match wrap {
        Wrap::Repeat if side & (side - 1) == 0 => at & (side - 1),
        Wrap::Repeat => at.rem_euclid(side),
        Wrap::Clamp => at.clamp(0, side - 1),
        Wrap::Mirror => {
            let at = at.rem_euclid(2 * side);
            at.min(2 * side - 1 - at)
        }
    }
}

/// Columns or rows in a side, of texels that are counted beyond the borders too: one range, or two where the texture begins
/// again between them.
pub(super) fn within(
    wrap: Wrap,
    [first, last]: [i64; 2],
    side: i64,
) -> [Option<RangeInclusive<usize>>; 2] {
    let range = |first: i64, last: i64| Some(first as usize..=last as usize);
    match wrap {
        Wrap::Clamp => [range(first.clamp(0, side - 1), last.clamp(0, side - 1)), None],
        Wrap::Repeat | Wrap::Mirror if last - first >= side - 1 => [range(0, side - 1), None],
        Wrap::Repeat => {
            let start = first.rem_euclid(side);
            let end = start + (last - first);
            if end < side {
                [range(start, end), None]
            } else {
                [range(start, side - 1), range(0, end - side)]
            }
        }
        Wrap::Mirror => {
            let [a, b] = [first, last].map(|end| wrapped(wrap, end, side));
            let copy = first.div_euclid(side);
            match (copy == last.div_euclid(side), copy % 2 == 0) {
                (true, _) => [range(a.min(b), a.max(b)), None],
                // They turn back at a border.
                (false, true) => [range(a.min(b), side - 1), None],
                (false, false) => [range(0, a.max(b)), None],
            }
        }
    }
}
