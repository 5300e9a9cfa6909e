//! Wrong fills row by row between the crossings of rows with edges, as functions of the corners in subpixels (1/256 px).
//!
//! A way of filling is a list of choices (see [`Scan`]), of which there are billions together. So the search goes in two steps: which rows
//! and pixels are drawn is found first, with exact crossings, as that decides about most pixels. How crossings are rounded decides about few, and is
//! found for the best of these.

use super::cells::{Place, places};
use super::fills::{Digits, MOST_ROWS, wrap};
use crate::convention::Mask;
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::geometry::sorted;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::Corners;

/// In which numbers the crossing of an edge with a row is computed.
#[derive(Clone, Copy, PartialEq)]
enum Slope {
    /// The slope is added row by row, in single precision or in double.
    Added(bool),
    /// The same in single precision, from a product with the reciprocal of the height.
    AddedReciprocal,
    /// Not added: computed for each row in single precision.
    Computed,
    /// The same, from a reciprocal of the height.
    Reciprocal,
    /// Interpolated between the corners for each row, in single precision or in double.
    Between(bool),
    /// The slope is a float of 16 bits; the rest is exact.
    Half,
    /// A product is divided by the height, by one of `DIVIDED`; in words of 16 bits or not.
    Divided { how: i64, wraps: bool },
    /// The slope is a product with the reciprocal of the height, which is cut to so many bits of fraction, the height being
    /// counted in subpixels.
    Inverse(u32),
    /// In single precision, with a reciprocal that has so many bits after the first one, cut.
    Mantissa(u32),
    /// In so many bits of fraction, the slope by one of `CUTS` and the first crossing by one of `STARTS`.
    Fixed { bits: u32, cut: i64, start: i64 },
}

/// The simplest first: where several explain the same, the first of them is named.
const SLOPES: [Slope; 22] = [
    Slope::Between(false),
    Slope::Added(true),
    Slope::Added(false),
    Slope::Computed,
    Slope::Reciprocal,
    Slope::Between(true),
    Slope::Half,
    Slope::Divided { how: 0, wraps: false },
    Slope::Divided { how: 1, wraps: false },
    Slope::Divided { how: 2, wraps: false },
    Slope::Divided { how: 0, wraps: true },
    Slope::Divided { how: 1, wraps: true },
    Slope::Divided { how: 2, wraps: true },
    Slope::Inverse(12),
    Slope::Inverse(16),
    Slope::Inverse(20),
    Slope::Inverse(24),
    Slope::Mantissa(8),
    Slope::Mantissa(11),
    Slope::Mantissa(12),
    Slope::Mantissa(16),
    Slope::AddedReciprocal,
];
/// Bits of fraction of slopes in fixed point.
const BITS: [u32; 6] = [16, 8, 10, 12, 14, 6];
const CUTS: [&str; 4] = [
    "cut toward zero",
    "cut down",
    "rounded to the nearest",
    "a product with a reciprocal that is cut",
];
/// How a division for each row is rounded.
const DIVIDED: [&str; 3] = ["toward zero", "down", "to the nearest"];
/// How the first crossing of an edge comes to fixed point.
const STARTS: [&str; 4] = [
    "",
    ", from a first crossing that is cut toward zero",
    ", from an exact first crossing that is cut toward zero",
    ", from a first crossing that is not cut",
];

impl Slope {
    /// Those in fixed point follow: each number of bits with each cut and each start.
    const COUNT: i64 = SLOPES.len() as i64 + 6 * 4 * 4;

    fn of(p: i64) -> Self {
        match p - SLOPES.len() as i64 {
            // Four starts, each with four cuts, for each number of bits.
            p @ 0.. => Self::Fixed { bits: BITS[(p / 16) as usize], cut: p % 4, start: p / 4 % 4 },
            _ => SLOPES[p as usize],
        }
    }

    /// Whether a step is added for each row, so that it matters where edges begin.
    fn is_added(self) -> bool {
        matches!(self, Self::Fixed { .. }) || self.is_added_in_floats()
    }

    /// Whether rounding adds up from row to row.
    fn is_added_in_floats(self) -> bool {
        matches!(self, Self::Added(_) | Self::AddedReciprocal)
    }

    /// Whether it is computed in single precision, without words of fewer bits.
    fn is_single(self) -> bool {
        matches!(
            self,
            Self::Added(true)
                | Self::AddedReciprocal
                | Self::Computed
                | Self::Reciprocal
                | Self::Between(true)
        )
    }

    fn about(self) -> String {
        let bits = |single| if single { 32 } else { 64 };
        match self {
            Self::Added(single) => {
                format!("adds the slope of an edge row by row in floats of {} bits", bits(single))
            }
            Self::AddedReciprocal => {
                "adds the slope of an edge, a product with the reciprocal of its height, row by row in floats of 32 bits"
                    .to_owned()
            }
            Self::Computed => {
                "computes each crossing from a slope that is rounded to floats of 32 bits"
                    .to_owned()
            }
            Self::Reciprocal => {
                "computes each crossing from the reciprocal of the height in floats of 32 bits"
                    .to_owned()
            }
            Self::Between(single) => format!(
                "interpolates between the corners for each row in floats of {} bits",
                bits(single)
            ),
            Self::Half => "rounds the slope of an edge to a float of 16 bits".to_owned(),
            // The division is exact but for its rounding; what wraps is the number that is divided.
            Self::Divided { how, wraps } => format!(
                "divides {} for each row{}",
                DIVIDED[how as usize],
                if wraps {
                    ", and the products (or sums of rows) wrap around in 16 bits"
                } else {
                    ""
                }
            ),
            Self::Inverse(bits) => format!(
                "multiplies by a reciprocal of the height that is cut to 1/{}",
                1_i64 << bits
            ),
            Self::Mantissa(bits) => format!(
                "multiplies by a reciprocal of the height that has {bits} bits after the first one"
            ),
            Self::Fixed { bits, cut, start } => format!(
                "adds the slope of an edge row by row in 1/{} px, {}{}",
                1_i64 << bits,
                CUTS[cut as usize],
                STARTS[start as usize]
            ),
        }
    }
}

/// How a triangle is filled row by row; each part is a digit of a parameter.
#[derive(Clone, Copy)]
pub(super) struct Scan {
    slope: Slope,
    /// What becomes of the long edge in the lower half: a place in `LOWER`.
    lower: i64,
    /// What becomes of rows above the window: 0, they are walked; 1, their steps are forgotten; 2, edges begin anew in row 0.
    above: i64,
    /// How corners come to whole pixels, one of `WHOLE`.
    whole: i64,
    /// Twice one of `FIRSTS`, and one more where the last row is drawn too.
    rows: i64,
    /// At which height of a row crossings are: one of `HEIGHTS`.
    height: i64,
    /// The first pixel and the last one: places in `LEFT` and `RIGHT`.
    left: i64,
    right: i64,
    /// What is drawn of a triangle in one row: 0, what the loop makes of it; 1, from its least to its greatest x; 2, nothing; 3, from
    /// the least pixel to the greatest.
    level: i64,
    /// The heights that corners are sorted by: 0, those that are drawn; or one of `SORTED`, or the exact ones where corners are cut.
    sorted: i64,
    /// 1 where each row gets a pixel at least, the one that would be its first.
    least: i64,
    /// 1 where edges begin at their lower ends and rows are walked upwards.
    up: i64,
    /// What is added to coordinates before they are rounded, so that samples lie at whole numbers: one of `MOVED`.
    moved: i64,
    /// 1 where a triangle whose sides are all nearly level or upright is filled as a box.
    boxes: i64,
    /// Which half has a row of the other one, too, between its edges prolonged: one of `SHARED`.
    shared: i64,
}

/// What is said of rows that both halves have.
const SHARED: [&str; 3] = [
    "",
    ", and begins the lower half one row early, between its edges prolonged",
    ", and ends the upper half one row late, between its edges prolonged",
];

/// What is said of corners in whole pixels.
const WHOLE: [&str; 5] = [
    "",
    "cuts corners down to whole pixels, ",
    "rounds corners to whole pixels, ",
    "cuts corners to whole pixels toward zero, ",
    "rounds corners up to whole pixels, ",
];
/// The row that a corner begins.
const FIRSTS: [&str; 4] = [
    "the first sample below a corner",
    "the row that holds a corner",
    "the first row that begins below a corner",
    "the rounded height of a corner",
];
/// Where in a row its crossing is taken.
const HEIGHTS: [&str; 4] = [
    "",
    ", by the crossings with the upper side of each row",
    ", beginning at the corner and not at the first row",
    ", counting rows from the one that holds the corner, whatever part of it lies above",
];
/// From which pixel on a row is filled.
const LEFT: [&str; 5] = [
    "the first sample right of the left crossing or on it",
    "the first sample right of the left crossing",
    "the pixel of the left crossing",
    "the first pixel that begins right of the left crossing",
    "the left crossing, cut toward zero,",
];
/// Up to which pixel a row is filled, that one included.
const RIGHT: [&str; 9] = [
    "the last sample left of the right crossing",
    "the last sample left of the right crossing or on it",
    "the pixel before that of the right crossing",
    "the last pixel that begins left of the right crossing",
    "one pixel beyond the last sample left of the right crossing",
    "one pixel beyond the last sample left of the right crossing or on it",
    "the pixel of the right crossing",
    "the first pixel that begins right of the right crossing",
    "the right crossing, cut toward zero",
];
/// How heights are brought to whole pixels before corners are sorted by them.
const SORTED: [&str; 4] = ["", "cut down", "rounded", "rounded up"];

/// What may be added to all coordinates, in pixels, and how that is said.
const MOVED: [(f64, &str); 3] = [
    (0.0, ""),
    (0.5, ", after half a pixel was added to all coordinates"),
    (-0.5, ", after half a pixel was taken from all coordinates"),
];

/// What becomes of the long edge in the lower half.
const LOWER: [&str; 4] = [
    "",
    ", begins anew at the middle corner",
    ", takes the crossing of the row before on the long edge below the middle corner",
    ", takes the crossing of the next row on the long edge below the middle corner",
];

/// How many values each digit has, in the order of the fields.
const DIGITS: Digits<15> = Digits([Slope::COUNT, 4, 3, 5, 8, 4, 5, 9, 4, 4, 2, 2, 3, 2, 3]);

/// Places of digits that are set by themselves.
const LEVEL: usize = 8;
const SORTED_BY: usize = 9;
const LEAST: usize = 10;
const UP: usize = 11;
const MOVED_BY: usize = 12;
const BOXES: usize = 13;
const SHARED_ROW: usize = 14;

/// What a digit counts.
const fn place_of(digit: usize) -> i64 {
    let (mut place, mut i) = (1, 0);
    while i < digit {
        place *= DIGITS.0[i];
        i += 1;
    }
    place
}

impl Scan {
    fn of(p: i64) -> Self {
        let [slope, lower, above, whole, rows, height, left, right, rest @ ..] = DIGITS.digits(p);
        // The last digits are seldom set, and stand alone then.
        let [level, sorted, least, up, moved, boxes, shared] = rest;
        let slope = Slope::of(slope);
        Self {
            slope,
            lower,
            above,
            whole,
            rows,
            height,
            left,
            right,
            level,
            sorted,
            least,
            up,
            moved,
            boxes,
            shared,
        }
    }

    /// The sentence, after 'it'.
    pub(super) fn sentence(p: i64) -> String {
        if p >= CLIPPED {
            return format!(
                "brings corners to numbers from -1 to 1, clips in them and comes back, all in floats of 32 bits, and {}",
                Self::sentence(p - CLIPPED)
            );
        }
        if p >= COLUMNS {
            return format!(
                "goes column by column, and with x and y exchanged {}",
                Self::sentence(p - COLUMNS)
            );
        }
        let Self { slope, lower, above, whole, rows, height, left, right, level, sorted, .. } =
            Self::of(p);
        let Self { least, up, moved, boxes, shared, .. } = Self::of(p);
        // What is done to the corners first.
        let mut words = WHOLE[whole as usize].to_owned();
        if sorted > 0 && whole > 0 {
            words += "sorts them by their exact heights, ";
        }
        if sorted > 0 && whole == 0 {
            words += &format!(
                "sorts the corners by their heights in whole pixels ({}), so that corners in one row keep the order in which they are given, and ",
                SORTED[sorted as usize]
            );
        } else if slope != SLOPES[0] {
            words += &slope.about();
            words += ["", ", upwards from the lower end of each edge"][up as usize];
            words += MOVED[moved as usize].1;
            words += [
                "",
                ", begins in row 0 with the crossing of a first row above the window",
                ", begins anew in row 0",
            ][above as usize];
            words += ", and ";
        }
        // Which pixels of a row are filled, and which rows there are.
        words += &format!("fills from {} to {}", LEFT[left as usize], RIGHT[right as usize]);
        words += ["", ", but one pixel at least"][least as usize];
        words += LOWER[lower as usize];
        words += SHARED[shared as usize];
        words += HEIGHTS[height as usize];
        words += &match (rows, whole) {
            (0, _) => String::new(),
            (_, 1..) => {
                [", without the row of the lowest corner", ", with the row of the lowest corner"]
                    [(rows % 2) as usize]
                    .to_owned()
            }
            _ => format!(
                ", in rows that begin with {}{}",
                FIRSTS[(rows / 2) as usize],
                if rows % 2 == 1 { " and end one too late" } else { "" }
            ),
        };
        words += [
            "",
            "; a level triangle is a row",
            "; a level triangle is nothing",
            "; a level triangle is a row with both ends",
        ][level as usize];
        words += [
            "",
            "; a triangle whose sides are all within 1/2 px of level or upright is filled as a box",
        ][boxes as usize];
        words
    }

    /// Whether crossings are rounded.
    pub(super) fn is_rounded(p: i64) -> bool {
        p % COLUMNS % Slope::COUNT > 0
    }

    /// Whether they are exact, and corners are sorted by their heights.
    pub(super) fn is_exact(p: i64) -> bool {
        !Self::is_rounded(p) && !Self::is_sorted_by_rows(p)
    }

    /// Whether corners are sorted by whole rows.
    pub(super) fn is_sorted_by_rows(p: i64) -> bool {
        let Self { sorted, whole, .. } = Self::of(p % COLUMNS);
        sorted > 0 && whole == 0
    }

    /// All of a frame: what is rounded, where edges begin, what level triangles are, and how corners are sorted.
    fn within(frame: i64) -> Vec<i64> {
        let base = Self::of(frame);
        let mut all = Vec::new();
        // Of whole corners there are level triangles, and corners that were sorted before.
        let [levels, orders] = if base.whole > 0 { [4, 2] } else { [1, 1] };
        for level in 0..levels {
            for order in 0..orders {
                let frame = frame + level * place_of(LEVEL) + order * place_of(SORTED_BY);
                Self::add_slopes(&mut all, frame, base.whole == 0);
                if base.whole == 0 {
                    for sorted in 1..4 {
                        all.push(frame + sorted * place_of(SORTED_BY));
                    }
                    all.push(frame + place_of(LEAST));
                    Self::add_ways(&mut all, frame);
                }
            }
        }
        all
    }

    /// All slopes, with all places where edges may begin and rows that both halves share.
    fn add_slopes(all: &mut Vec<i64>, frame: i64, has_fraction: bool) {
        for slope in 0..Slope::COUNT {
            // Where nothing is added, it does not matter where an edge begins; nor does it of whole corners, nearly.
            let is_added = Slope::of(slope).is_added() && has_fraction;
            for begins in 0..12 {
                let (lower, above) = (begins % 4, begins / 4);
                let is_tried = match lower {
                    0 => above == 0 || is_added,
                    1 => is_added,
                    _ => above == 0 && (has_fraction || slope < SLOPES.len() as i64),
                };
                if is_tried {
                    all.push(frame + slope + Slope::COUNT * begins);
                }
            }
        }
        for slope in 0..SLOPES.len() as i64 {
            for shared in [1, 2] {
                all.push(frame + slope + shared * place_of(SHARED_ROW));
            }
        }
    }

    /// Rows that are walked upwards, samples at whole numbers, and triangles that are clipped first.
    fn add_ways(all: &mut Vec<i64>, frame: i64) {
        for (number, slope) in (0..).zip(SLOPES) {
            // Where nothing is added, upwards is the same, nearly.
            // Clipping is done in floats of 32 bits, and goes with slopes in these.
            let is_added = slope.is_added_in_floats();
            for way in 0..if is_added { 6 } else { 1 } {
                let p = frame + number + way % 2 * place_of(UP) + way / 2 * place_of(MOVED_BY);
                if way > 0 {
                    all.push(p);
                }
                if slope.is_single() {
                    all.extend([p + CLIPPED, p + CLIPPED + place_of(BOXES)]);
                }
            }
        }
    }

    /// How many pixels of what was drawn it does not predict, up to a number.
    fn missed(self, drawn: &[DrawnTriangle], most: u32) -> u32 {
        let mut missed = 0;
        for (corners, window, seen) in drawn {
            missed += seen.differs(&scan(*corners, *window, self)).count();
            if missed >= most {
                break;
            }
        }
        missed
    }

    fn first_row(&self, y: f64) -> i64 {
        match self.rows / 2 {
            0 => up(y - 0.5),
            1 => down(y),
            2 => up(y),
            _ => down(y + 0.5),
        }
    }

    /// How far a row lies below the corner where an edge begins, in pixels.
    fn ahead(&self, row: i64, first_row: i64, from: f64) -> f64 {
        match self.height {
            0 => row as f64 + 0.5 - from,
            1 => row as f64 - from,
            2 => (row - first_row) as f64,
            _ => (row - down(from)) as f64,
        }
    }

    /// The height of an edge, which is not 0, in the direction in which rows are walked.
    fn height_of(&self, from: Place, to: Place) -> f64 {
        let dy = to[1] - from[1];
        if self.up == 1 { dy.min(-1.0 / 256.0) } else { dy.max(1.0 / 256.0) }
    }
}

/// A triangle with what was drawn of it.
pub(super) type DrawnTriangle = ([Place; 3], PixelRect, Mask);
/// The parameters of a frame: slopes, and where edges begin.
const WITHIN: i64 = place_of(3);
/// Frames that are tried with all ways of rounding, for each of two slopes.
const FRAMES: usize = 10;

/// The parameters whose frames (rows, heights and ends of rows) come nearest to what was drawn: with exact crossings, and with
/// the slope and the beginning that are best in the first of these.
pub(super) fn fitting(rows: &[DrawnTriangle]) -> Vec<i64> {
    let mut columns = Vec::with_capacity(rows.len());
    for (corners, window, drawn) in rows {
        columns.push((transposed_corners(*corners), transposed_window(*window), drawn.turned()));
    }
    let (least, all) = frames(rows, 0, u32::MAX);
    // Where crossings are rounded, both may miss as many.
    let (_, by_columns) = frames(&columns, 0, least / 4);
    if by_columns.is_empty() {
        return fitting_frames(rows, all);
    }
    let mut all = fitting_frames(&columns, by_columns);
    for p in &mut all {
        *p += COLUMNS;
    }
    all
}

/// All that is near the best frames with exact crossings.
fn fitting_frames(drawn: &[DrawnTriangle], mut all: Vec<i64>) -> Vec<i64> {
    // The slope and the beginning that fit the first frame best.
    let mut best = (u32::MAX, 0);
    for p in Scan::within(all[0]).into_iter().filter(|p| *p < COLUMNS) {
        let missed = Scan::of(p).missed(drawn, best.0);
        if missed < best.0 {
            best = (missed, p);
        }
    }
    // Too many that explain the same crowd out others.
    all.truncate(2);
    for p in frames(drawn, best.1 % WITHIN, u32::MAX).1 {
        all.push(p - p % WITHIN);
    }
    all.sort_unstable();
    all.dedup();
    all.into_iter().flat_map(Scan::within).collect()
}

/// The best frames with a slope and where edges begin, the best first, that miss fewer pixels than `most`; and how many the first
/// misses.
fn frames(drawn: &[DrawnTriangle], slope: i64, most: u32) -> (u32, Vec<i64>) {
    let mut best: Vec<(u32, i64)> = Vec::new();
    for frame in 0..place_of(LEVEL) / WITHIN {
        let frame = frame * WITHIN + slope;
        let how = Scan::of(frame);
        // Of whole corners rows are with the last one or without, and edges begin at the corner.
        let is_twice = how.height == 3 && how.rows / 2 == 1;
        if is_twice || how.whole > 0 && (how.rows > 1 || how.height > 1) {
            continue;
        }
        // A frame that misses more than the last one of the best is given up early.
        let most = best.get(FRAMES - 1).map_or(most, |(missed, _)| *missed);
        let missed = how.missed(drawn, most);
        if missed < most {
            let at = best.partition_point(|(other, _)| *other <= missed);
            best.insert(at, (missed, frame));
            best.truncate(FRAMES);
        }
    }
    // Frames that miss many more than the best one explain less.
    let least = best.first().map_or(u32::MAX, |(missed, _)| *missed);
    best.retain(|(missed, _)| *missed <= least.saturating_mul(2).saturating_add(4));
    (least, best.into_iter().map(|(_, frame)| frame).collect())
}

/// A crossing that is moved from row to row, in pixels.
struct Walk {
    /// The crossing with the row `row`.
    x: f64,
    /// What a step down adds, or what crossings are computed from.
    slope: f64,
    from: Place,
    to: Place,
    /// The first row of the edge, which need not be in the window.
    first_row: i64,
    /// The row of `x`.
    row: i64,
}

/// A number of 64 bits that is one of 32 bits.
fn single(v: f64) -> f64 {
    f64::from(v as f32)
}

/// A number rounded down, by casts: `f64::floor` is a call on some machines, and slow.
fn down(v: f64) -> i64 {
    let cut = v as i64;
    cut.saturating_sub(i64::from(cut as f64 > v))
}

/// A number rounded up.
fn up(v: f64) -> i64 {
    down(-v).saturating_neg()
}

/// A multiple of 1/256 px in subpixels.
fn subpixels(v: f64) -> i64 {
    (v * 256.0) as i64
}

impl Walk {
    /// Of an edge whose first row is given, from a later row on.
    fn new(from: Place, to: Place, [first_row, begin]: [i64; 2], how: &Scan) -> Self {
        let begin = if how.above == 2 { begin.max(0) } else { begin };
        let ahead = how.ahead(begin, first_row, from[1]);
        let [dx, dy] = [to[0] - from[0], how.height_of(from, to)];
        let start = from[0] + MOVED[how.moved as usize].0;
        // The crossing with the first row in single precision, from the corner.
        let first = |slope: f64| single(single(start) + single(slope * single(ahead)));
        let (x, slope) = match how.slope {
            Slope::Added(true) | Slope::Computed => {
                let slope = single(single(dx) / single(dy));
                (first(slope), slope)
            }
            Slope::AddedReciprocal | Slope::Reciprocal => {
                let slope = single(single(dx) * single(1.0 / single(dy)));
                (first(slope), slope)
            }
            // Computed for each row, so that no first crossing is needed.
            Slope::Half => (0.0, super::format::rounded(dx / dy, 2)),
            Slope::Inverse(bits) => {
                let unit = 1_i64 << bits;
                (0.0, dx * (unit / subpixels(dy)) as f64 * 256.0 / unit as f64)
            }
            Slope::Mantissa(bits) => {
                // The bits after the first one that are not kept are 0.
                let cut = f64::from(1.0 / dy as f32).to_bits() >> (52 - bits) << (52 - bits);
                (0.0, single(dx * f64::from_bits(cut)))
            }
            Slope::Fixed { bits, cut, start } => {
                let unit = 1_i128 << bits;
                let [wide, dx, dy, ahead] =
                    [from[0], dx, dy, ahead].map(|v| i128::from(subpixels(v)));
                // The slope for one row, in units of the fixed point.
                let slope = match cut {
                    0 => dx * unit / dy,
                    1 => (dx * unit).div_euclid(dy),
                    2 => (2 * dx * unit + dy).div_euclid(2 * dy),
                    _ => (dx * (256 * unit / dy)) >> 8,
                };
                // The first crossing: coordinates have 8 bits of fraction, and so has the distance.
                let x = match start {
                    0 => (wide * unit / 256 + ((slope * ahead) >> 8)) as f64,
                    1 => (wide * unit / 256 + slope * ahead / 256) as f64,
                    2 => ((wide * dy + dx * ahead) * unit / (256 * dy)) as f64,
                    _ => (wide * unit + slope * ahead) as f64 / 256.0,
                };
                (x / unit as f64, slope as f64 / unit as f64)
            }
            _ => (start + dx / dy * ahead, dx / dy),
        };
        // A row above the window is taken for row 0.
        let row = if how.above == 1 { begin.max(0) } else { begin };
        Self { x, slope, from, to, first_row, row }
    }

    /// The crossing with the row, in pixels: rows are asked for in order.
    fn at(&mut self, row: i64, how: &Scan) -> f64 {
        let moved = MOVED[how.moved as usize].0;
        let ahead = how.ahead(row, self.first_row, self.from[1]);
        let x = match how.slope {
            Slope::Computed | Slope::Reciprocal | Slope::Mantissa(_) => {
                single(self.from[0] + moved + single(self.slope * single(ahead)))
            }
            Slope::Half | Slope::Inverse(_) => self.from[0] + self.slope * ahead,
            Slope::Between(is_single) => {
                let r = |v: f64| if is_single { single(v) } else { v };
                let [from, to] = [self.from, self.to].map_array(|p| r(p[0] + moved));
                let part = r(ahead / r(how.height_of(self.from, self.to)));
                r(from + r(r(to - from) * part))
            }
            Slope::Divided { how: cut, wraps } => {
                // Of whole corners in pixels, of others in subpixels.
                let unit = if how.whole > 0 { 256 } else { 1 };
                let [dx, dy] = [self.to[0] - self.from[0], how.height_of(self.from, self.to)];
                let [dx, dy, ahead] = [dx, dy, ahead].map(|v| i128::from(subpixels(v)));
                // In 16 bits a product of whole pixels wraps around.
                let product = match wraps {
                    true => wrap(dx * ahead / 65536, 16) * 65536,
                    false => dx * ahead,
                };
                let by = dy * unit;
                let moved = match cut {
                    0 => product / by,
                    1 => product.div_euclid(by),
                    _ => (2 * product + by).div_euclid(2 * by),
                };
                self.from[0] + (moved * unit) as f64 / 256.0
            }
            Slope::Fixed { .. } => self.x + self.slope * (row - self.row) as f64,
            Slope::Added(_) | Slope::AddedReciprocal => {
                // One step for each row between, since each of them is rounded.
                let step = (row - self.row).signum();
                while self.row != row {
                    self.x += self.slope * step as f64;
                    if how.slope != Slope::Added(false) {
                        self.x = single(self.x);
                    }
                    self.row += step;
                }
                self.x
            }
        };
        x - moved
    }
}

/// Parameters from here on fill column by column, and those from the other one on clip first.
const COLUMNS: i64 = 1 << 40;
const CLIPPED: i64 = 1 << 41;

/// The picture of a way of filling row by row, or column by column.
pub(super) fn scanned(corners: &Corners, window: PixelRect, p: i64) -> Mask {
    // Below `COLUMNS` are the digits; what is done first comes above them.
    let how = Scan::of(p % COLUMNS);
    if how.boxes == 1 {
        let drawn = match p & COLUMNS {
            0 => boxed(places(corners), window, how),
            _ => boxed(transposed_corners(places(corners)), transposed_window(window), how)
                .map(|mask| mask.turned()),
        };
        if let Some(mask) = drawn {
            return mask;
        }
    }
    let mut mask = Mask::default();
    let parts = match p < CLIPPED {
        true => vec![places(corners)],
        false => clipped(places(corners), window, usize::from(p & COLUMNS == 0), how),
    };
    for part in parts {
        mask.add(&match p & COLUMNS {
            0 => scan(part, window, how),
            _ => scan(transposed_corners(part), transposed_window(window), how).turned(),
        });
    }
    mask
}

/// The box between the corners with the least and the greatest sum of coordinates; nothing of a triangle with another side.
fn boxed(corners: [Place; 3], window: PixelRect, how: Scan) -> Option<Mask> {
    let high = f64::from(window.y1);
    let moved = MOVED[how.moved as usize].0;
    let at =
        corners.map_array(|[x, y]| [x + moved, if how.up == 1 { high - y } else { y } + moved]);
    for (i, from) in at.iter().enumerate() {
        let to = at[(i + 1) % 3];
        if (to[0] - from[0]).abs() >= 0.5 && (to[1] - from[1]).abs() >= 0.5 {
            return None;
        }
    }
    // The corners that lie farthest to the upper left and to the lower right.
    let by_sum = |p: &&Place, q: &&Place| (p[0] + p[1]).total_cmp(&(q[0] + q[1]));
    let [from, to] = [at.iter().min_by(by_sum)?, at.iter().rev().max_by(by_sum)?]
        .map_array(|p| p.map_array(|v| v.trunc()));
    let mut mask = Mask::default();
    for y in from[1].max(0.0) as i32..to[1].min(high) as i32 {
        let row = if how.up == 1 { window.y1 - 1 - y } else { y };
        for x in from[0].max(0.0) as i32..to[0].min(window.x1.into()) as i32 {
            mask.set(x, row);
        }
    }
    Some(mask)
}

/// A triangle whose columns are the rows of this one.
fn transposed_corners(corners: [Place; 3]) -> [Place; 3] {
    corners.map_array(|[x, y]| [y, x])
}

fn transposed_window(window: PixelRect) -> PixelRect {
    PixelRect { x0: window.y0, y0: window.x0, x1: window.y1, y1: window.x1 }
}

/// The part of a triangle within the window, as triangles that share its first corner, in floats of 32 bits: coordinates go
/// through numbers from -1 to 1, in which it is clipped. `rows` is the axis across the rows.
fn clipped(corners: [Place; 3], window: PixelRect, rows: usize, how: Scan) -> Vec<[Place; 3]> {
    // The corners in numbers from -1 to 1.
    let sides = [window.x1, window.y1].map_array(|side| side as f32);
    let moved = MOVED[how.moved as usize].0 as f32;
    let mut polygon: Vec<[f32; 2]> =
        corners.iter().map(|p| [0, 1].map(|k| 2.0 / sides[k] * p[k] as f32 - 1.0)).collect();
    for (axis, sign) in [(0, 1.0), (0, -1.0), (1, -1.0), (1, 1.0)] {
        // Positive inside this side of the window.
        let inside = |p: [f32; 2]| 1.0 - sign * p[axis];
        let mut kept = Vec::new();
        for (i, &to) in polygon.iter().enumerate() {
            let from = polygon[(i + polygon.len() - 1) % polygon.len()];
            let [u, v] = [inside(from), inside(to)];
            if (u < 0.0) != (v < 0.0) {
                let part = u / (u - v);
                kept.push([0, 1].map(|k| from[k] * (1.0 - part) + to[k] * part));
            }
            kept.extend((v >= 0.0).then_some(to));
        }
        polygon = kept;
    }
    // Where rows are walked upwards, their axis begins at its other end.
    let back = |p: [f32; 2]| {
        [0, 1].map(|k| {
            let half = sides[k] / 2.0;
            let to_px = |v: f32| f64::from(half + v * half + moved) - f64::from(moved);
            let is_turned = how.up == 1 && k == rows;
            if is_turned { f64::from(sides[k]) - to_px(-p[k]) } else { to_px(p[k]) }
        })
    };
    let polygon: Vec<Place> = polygon.into_iter().map(back).collect();
    polygon.windows(2).skip(1).map(|side| [polygon[0], side[0], side[1]]).collect()
}

/// Fills a triangle row by row: corners are sorted by height, and each half is filled between the
/// long edge and a short one.
fn scan(corners: [Place; 3], window: PixelRect, how: Scan) -> Mask {
    let whole = |v: f64| match how.whole {
        0 => v,
        1 => down(v) as f64,
        2 => down(v + 0.5) as f64,
        3 => (v as i64) as f64,
        _ => up(v) as f64,
    };
    // The height by which a corner is sorted may be another one than that which is drawn.
    let exact = corners.map_array(|p| {
        let y = p[1];
        let height = match (how.whole, how.sorted) {
            (0, 0) | (1.., 1) => y,
            (1.., _) => whole(y),
            (_, 1) => down(y) as f64,
            (_, 2) => down(y + 0.5) as f64,
            _ => up(y) as f64,
        };
        (height, p)
    });
    let sorted = sorted(exact, |p, q| p.0.total_cmp(&q.0).is_gt());
    let sorted = sorted.map_array(|(_, p)| p.map_array(whole));
    let [top, middle, bottom] = sorted;
    let mut mask = Mask::default();
    let clamp = |v: i64| v.clamp(0, window.x1.into()) as i32;
    // Fills a row between two crossings, in either order.
    let mut fill = |y: i64, a: f64, b: f64| {
        let (left, right) = (a.min(b), a.max(b));
        let first = match how.left {
            0 => up(left - 0.5),
            1 => down(left + 0.5),
            2 => down(left),
            3 => up(left),
            _ => left as i64,
        };
        let end = match how.right {
            0 | 4 => up(right - 0.5),
            1 | 5 => down(right + 0.5),
            2 | 6 => down(right),
            3 | 7 => up(right),
            _ => right as i64,
        };
        let end = end.saturating_add(i64::from(how.right > 3));
        let end = if how.least == 1 { end.max(first.saturating_add(1)) } else { end };
        for x in clamp(first)..clamp(end) {
            mask.set(x, y as i32);
        }
    };
    // The rows that the corners begin; the last one is where the triangle ends.
    let mut starts = [top, middle, bottom].map_array(|p| how.first_row(p[1]));
    let end = starts[2] + how.rows % 2;
    // A level lower side leaves nothing for the lower half.
    if how.lower > 1 && middle[1] == bottom[1] {
        starts[1] = end;
    }
    // A level triangle has no crossings, and is a row from its least to its largest x.
    if top[1] == bottom[1] && how.level > 0 {
        let xs = sorted.map_array(|p| p[0]);
        let (least, most) = (xs[0].min(xs[1]).min(xs[2]), xs[0].max(xs[1]).max(xs[2]));
        if starts[0] < end && (0..i64::from(window.y1)).contains(&starts[0]) {
            match how.level {
                1 => fill(starts[0], least, most),
                3 => {
                    for x in clamp(least as i64)..clamp(most as i64 + 1) {
                        mask.set(x, starts[0] as i32);
                    }
                }
                _ => {}
            }
        }
        return mask;
    }
    if starts[0] >= end {
        return mask;
    }
    if how.up == 1 {
        upwards(sorted, [starts[0], starts[1], end], window, &how, &mut fill);
        return mask;
    }
    // From top to bottom: the long edge goes on, and each half has its own short edge.
    let mut long = Walk::new(top, bottom, [starts[0]; 2], &how);
    if how.slope.is_added_in_floats() && long.row < -MOST_ROWS {
        return mask;
    }
    let halves = [(top, middle, starts[0], starts[1]), (middle, bottom, starts[1], end)];
    for (half, (from, to, first, last)) in halves.into_iter().enumerate() {
        // Each half that has a height has its own rows, and perhaps one of the other's.
        let is_shared = |kind| how.shared == kind && from[1] != to[1];
        let first = first - i64::from(half == 1 && is_shared(1));
        let last = last + i64::from(half == 0 && is_shared(2));
        let mut short = Walk::new(from, to, [first; 2], &how);
        if half == 1 && how.lower == 1 {
            long = Walk::new(top, bottom, [starts[0], first], &how);
        }
        let moved = if half == 1 { [0, 0, -1, 1][how.lower as usize] } else { 0 };
        // Corners in a wrong order do not add rows.
        for y in first.max(starts[0]).max(0)..last.min(end).min(window.y1.into()) {
            let (a, b) = (long.at(y + moved, &how), short.at(y, &how));
            fill(y, a, b);
        }
    }
    mask
}

/// The rows of a triangle from its lowest one on, with edges that begin at their lower ends.
fn upwards(
    [top, middle, bottom]: [Place; 3],
    [first, second, end]: [i64; 3],
    window: PixelRect,
    how: &Scan,
    fill: &mut dyn FnMut(i64, f64, f64),
) {
    if end > MOST_ROWS {
        return;
    }
    // From bottom to top: edges begin at their lower ends.
    let mut long = Walk::new(bottom, top, [end - 1; 2], how);
    for (from, to, rows) in [(bottom, middle, second..end), (middle, top, first..second)] {
        let mut short = Walk::new(from, to, [rows.end - 1; 2], how);
        for y in (rows.start.max(first).max(0)..rows.end.min(end)).rev() {
            let (a, b) = (long.at(y, how), short.at(y, how));
            if y < window.y1.into() {
                fill(y, a, b);
            }
        }
    }
}
