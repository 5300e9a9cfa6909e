//! The way over a shape: pixels that a program never comes to, and tiles that it draws without a look at each pixel.

use super::edges::EdgeTest;
use super::picture::Picture;
use super::question::{AnyQuestion, first_sample};

/// How a program goes over the box of the corners.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Visit {
    Rows(RowVisit),
    Tiles(Tiles),
    /// From one pixel to its four neighbours, as long as they are inside.
    Flood(Seed),
}

/// Row by row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct RowVisit {
    /// 1 where it goes along rows, 0 where it goes along columns.
    pub(super) axis: usize,
    /// Whether every second row is walked backwards.
    pub(super) turns: bool,
    pub(super) begins: Begins,
    /// Whether a row ends at the first pixel outside after one inside.
    pub(super) stops: bool,
    pub(super) empty: Empty,
    pub(super) of: BoxOf,
}

/// What the box goes round.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum BoxOf {
    /// The pixels that hold a corner, and those between.
    Corners,
    /// The samples between the corners.
    Samples,
    /// The same, and one more column and row.
    OneMore,
}

/// Where a row begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Begins {
    AtBox,
    /// Where the walk along the row before ended.
    WhereLastEnded,
    /// At the first pixel of the row before.
    AtLastFirst,
}

/// What a row without pixels ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Empty {
    Nothing,
    /// The walk, where a row before it had pixels.
    AfterDrawn,
    Always,
}

/// Squares that are decided by a few of their points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Tiles {
    /// Pixels along a side; where that is not said, the power of two that holds the window.
    pub(super) size: Option<i32>,
    /// Whether they begin at the box of the corners, and not at the window.
    pub(super) from_box: bool,
    pub(super) probes: Probes,
    /// Whether the points are the corners of the square, and not samples of its pixels.
    pub(super) are_corners: bool,
    pub(super) decides: Decides,
}

/// The points of a square that are looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Probes {
    /// Of the upper left, upper right, lower left and lower right one those that are so.
    Corners([bool; 4]),
    Center,
    /// The middle of its samples, which may lie as far beyond an edge as it reaches.
    Reach(Reach),
}

/// How far a square reaches across an edge: half its side times a length of the edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Reach {
    /// The larger of |dx| and |dy|, which is less than it reaches.
    Larger,
    Smaller,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Decides {
    /// A square of which no point is inside is left out.
    Skips,
    /// The same, and a square that is not left out is cut into four, down to squares of 2 x 2 pixels.
    SkipsQuarters,
    /// A square of which all points are inside is drawn whole.
    Fills,
}

/// Where a flood begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Seed {
    /// The first pixel of the first row.
    FirstPixel,
    /// The pixel of the centroid.
    Centroid,
    /// The pixel that holds a corner, from the top down.
    Corner(usize),
}

const ALL_CORNERS: [bool; 4] = [true; 4];

/// A triangle whose pixels are come to.
pub(super) struct VisitedTriangle<'a> {
    pub(super) question: &'a AnyQuestion,
    pub(super) sample: [i64; 2],
    /// Of each direction that an edge may face, whether samples on it are drawn.
    pub(super) owned: [bool; 8],
}

impl VisitedTriangle<'_> {
    /// Whether the sample of a pixel is inside, in the window or not.
    fn has_sample(&self, at: [i32; 2]) -> bool {
        EdgeTest::RIGHT.draws(self.question, at, self.sample, self.owned)
    }

    /// Whether the upper left corner of a pixel is inside or on an edge.
    fn has_corner(&self, at: [i32; 2]) -> bool {
        let beyond = EdgeTest { looks_beyond: true, ..EdgeTest::RIGHT };
        beyond.draws(self.question, at, [0; 2], [true; 8])
    }

    /// Whether the middle of the samples of a square lies inside every edge, or no farther outside than it is said to reach.
    fn reaches(&self, at: [i32; 2], size: i32, reach: Reach) -> bool {
        let q = self.question;
        let turn = i128::from(q.twice_area().signum());
        let half = 128 * i64::from(size - 1);
        let middle = [0, 1].map(|axis| 256 * i64::from(at[axis]) + self.sample[axis] + half);
        (0..3).all(|i| {
            let ([ax, ay], sides) = (q.points[i], q.side_of(i, (i + 1) % 3));
            let [dx, dy] = sides.map(i128::from);
            let value = dx * i128::from(middle[1] - ay) - dy * i128::from(middle[0] - ax);
            let length = match reach {
                Reach::Larger => dx.abs().max(dy.abs()),
                Reach::Smaller => dx.abs().min(dy.abs()),
            };
            // A square that only touches holds samples on the edge at most, which the picture decides.
            turn * value + length * i128::from(half) >= 0
        })
    }

    /// The first pixel of the box of the corners in the window, and the first after it.
    fn bounds(&self, of: BoxOf) -> [[i32; 2]; 2] {
        let of = |axis: usize| {
            let range = self.question.range(axis);
            let samples = range.map(|v| first_sample(v, self.sample[axis]));
            let [first, end] = match of {
                BoxOf::Corners => [range[0].div_euclid(256), range[1].div_euclid(256) + 1],
                BoxOf::Samples => samples,
                BoxOf::OneMore => [samples[0], samples[1] + 1],
            };
            let side = i64::from(self.question.side[axis]);
            [first.clamp(0, side) as i32, end.clamp(0, side) as i32]
        };
        [of(0), of(1)]
    }
}

impl Visit {
    /// Every way over a triangle that leaves out or adds something.
    pub(super) fn all() -> Vec<Self> {
        let mut all = Vec::new();
        let ways = [
            (false, Begins::AtBox),
            (false, Begins::AtLastFirst),
            (true, Begins::AtBox),
            (true, Begins::WhereLastEnded),
        ];
        for axis in [1, 0] {
            for (turns, begins) in ways {
                for stops in [false, true] {
                    for empty in [Empty::Nothing, Empty::AfterDrawn, Empty::Always] {
                        // From the box on, nothing is missed.
                        if begins == Begins::AtBox && empty == Empty::Nothing {
                            continue;
                        }
                        for of in [BoxOf::Corners, BoxOf::Samples, BoxOf::OneMore] {
                            let rows = RowVisit { axis, turns, begins, stops, empty, of };
                            all.push(Self::Rows(rows));
                        }
                    }
                }
            }
        }
        let one = |i: usize| Probes::Corners([0, 1, 2, 3].map(|corner| corner == i));
        let without = |i: usize| Probes::Corners([0, 1, 2, 3].map(|corner| corner != i));
        let mut probes = vec![Probes::Corners(ALL_CORNERS), Probes::Center];
        probes.extend((0..4).flat_map(|i| [one(i), without(i)]));
        for first in 0..4 {
            for second in first + 1..4 {
                let pair = [0, 1, 2, 3].map(|corner| corner == first || corner == second);
                probes.push(Probes::Corners(pair));
            }
        }
        for reach in [Reach::Larger, Reach::Smaller] {
            for size in (2..=6).map(|bits| Some(1 << bits)).chain([None]) {
                for decides in [Decides::Skips, Decides::SkipsQuarters] {
                    let probes = Probes::Reach(reach);
                    let tiles =
                        Tiles { size, from_box: false, probes, are_corners: false, decides };
                    all.push(Self::Tiles(tiles));
                }
            }
        }
        for size in (1..=6).map(|bits| Some(1 << bits)) {
            for from_box in [false, true] {
                for &probes in &probes {
                    for are_corners in [false, true] {
                        for decides in [Decides::Skips, Decides::SkipsQuarters, Decides::Fills] {
                            let tiles = Tiles { size, from_box, probes, are_corners, decides };
                            all.push(Self::Tiles(tiles));
                        }
                    }
                }
            }
        }
        let corners = (0..3).map(Seed::Corner);
        all.extend([Seed::FirstPixel, Seed::Centroid].into_iter().chain(corners).map(Self::Flood));
        all
    }

    /// What becomes of a picture.
    pub(super) fn apply(self, before: &Picture, looked: &VisitedTriangle<'_>) -> Picture {
        match self {
            Self::Rows(rows) => rows.apply(before, looked),
            Self::Tiles(tiles) => tiles.apply(before, looked),
            Self::Flood(seed) => flood(before, seed, looked.question),
        }
    }

    /// How it goes, after 'as if'.
    pub(super) fn words(self) -> String {
        match self {
            Self::Rows(rows) => rows.words(),
            Self::Tiles(tiles) => tiles.words(),
            Self::Flood(seed) => {
                let from = match seed {
                    Seed::FirstPixel => "the first pixel of its first row",
                    Seed::Centroid => "the pixel of its centroid",
                    Seed::Corner(0) => "the pixel that holds the top corner",
                    Seed::Corner(1) => "the pixel that holds the middle corner",
                    Seed::Corner(_) => "the pixel that holds the bottom corner",
                };
                format!("it were filled from {from} on, from each pixel to its four neighbours")
            }
        }
    }
}

impl RowVisit {
    fn apply(self, before: &Picture, looked: &VisitedTriangle<'_>) -> Picture {
        let mut after = Picture::new(before.side);
        let bounds = looked.bounds(self.of);
        let ([first, end], rows) = (bounds[1 - self.axis], bounds[self.axis]);
        let (mut ended, mut last_first, mut has_drawn, mut is_back) = (first, first, false, false);
        for row in rows[0]..rows[1] {
            let mut place = match self.begins {
                Begins::AtBox if is_back => end - 1,
                Begins::AtBox => first,
                Begins::WhereLastEnded => ended,
                Begins::AtLastFirst => last_first,
            };
            let mut is_seen = false;
            while (first..end).contains(&place) {
                let at = if self.axis == 1 { [place, row] } else { [row, place] };
                if before.has(at) {
                    after.set(at, before.hits(at));
                    if !is_seen {
                        last_first = place;
                    }
                    is_seen = true;
                } else if is_seen && self.stops {
                    break;
                }
                place += if is_back { -1 } else { 1 };
            }
            ended = place.clamp(first, (end - 1).max(first));
            has_drawn |= is_seen;
            let is_end = match self.empty {
                Empty::Nothing => false,
                Empty::AfterDrawn => has_drawn,
                Empty::Always => true,
            };
            if !is_seen && is_end {
                break;
            }
            is_back ^= self.turns;
        }
        after
    }

    fn words(self) -> String {
        let line = ["column", "row"][self.axis];
        let of = match self.of {
            BoxOf::Corners => "the box of the corners",
            BoxOf::Samples => "the box of the samples between the corners",
            BoxOf::OneMore => {
                "the box of the samples between the corners, with one more on each axis,"
            }
        };
        let mut said = format!("{of} were walked {line} by {line}");
        if self.turns {
            said += ", there and back";
        }
        match self.begins {
            Begins::AtBox => {}
            Begins::WhereLastEnded => {
                said += &format!(", each {line} from where the one before ended");
            }
            Begins::AtLastFirst => {
                said += &format!(", each {line} from the first pixel of the one before");
            }
        }
        if self.stops {
            said += &format!(", and a {line} ended after its last pixel");
        }
        match self.empty {
            Empty::Nothing => {}
            Empty::AfterDrawn => {
                said += &format!(
                    ", and all ended with the first {line} without pixels after one with some"
                );
            }
            Empty::Always => {
                said += &format!(", and all ended with the first {line} without pixels")
            }
        }
        said
    }
}

impl Tiles {
    fn apply(self, before: &Picture, looked: &VisitedTriangle<'_>) -> Picture {
        let mut after = before.clone();
        let bounds = looked.bounds(BoxOf::Corners);
        let [width, height] = before.side;
        let size =
            self.size.unwrap_or((width.max(height).max(1) as u32).next_power_of_two() as i32);
        let starts = [0, 1].map(|axis| match self.from_box {
            true => bounds[axis][0],
            false => bounds[axis][0] / size * size,
        });
        for y in (starts[1]..bounds[1][1]).step_by(size as usize) {
            for x in (starts[0]..bounds[0][1]).step_by(size as usize) {
                self.decide([x, y], size, &mut after, looked);
            }
        }
        after
    }

    fn decide(
        self,
        [x, y]: [i32; 2],
        size: i32,
        after: &mut Picture,
        looked: &VisitedTriangle<'_>,
    ) {
        let (any, all) = self.probed([x, y], size, looked);
        match self.decides {
            Decides::Fills if all => set_square(after, [x, y], size, 1),
            Decides::Fills => {}
            Decides::Skips | Decides::SkipsQuarters if !any => set_square(after, [x, y], size, 0),
            Decides::SkipsQuarters if size > 2 => {
                let half = size / 2;
                for [right, down] in [[0, 0], [half, 0], [0, half], [half, half]] {
                    self.decide([x + right, y + down], half, after, looked);
                }
            }
            Decides::Skips | Decides::SkipsQuarters => {}
        }
    }

    /// Whether one of the points of a square is inside, and whether all are.
    fn probed(self, [x, y]: [i32; 2], size: i32, looked: &VisitedTriangle<'_>) -> (bool, bool) {
        let is_in =
            |at| if self.are_corners { looked.has_corner(at) } else { looked.has_sample(at) };
        // From the first corner to the farther ones.
        let far = if self.are_corners { size } else { size - 1 };
        match self.probes {
            Probes::Center => {
                let is_in = is_in([x + size / 2, y + size / 2]);
                (is_in, is_in)
            }
            Probes::Reach(reach) => {
                let reaches = looked.reaches([x, y], size, reach);
                (reaches, reaches)
            }
            Probes::Corners(looked_at) => {
                let corners = [[x, y], [x + far, y], [x, y + far], [x + far, y + far]];
                let (mut any, mut all) = (false, true);
                for (at, _) in
                    corners.into_iter().zip(looked_at).filter(|(_, is_looked)| *is_looked)
                {
                    let is_in = is_in(at);
                    any |= is_in;
                    all &= is_in;
                }
                (any, all)
            }
        }
    }

    fn words(self) -> String {
        let from = if self.from_box { ", from the box of the corners on," } else { "" };
        let tiles = match self.size {
            Some(size) => format!("tiles of {size} x {size} px{from}"),
            None => "tiles of the least power of two that holds the window".to_owned(),
        };
        let point = if self.are_corners { "corners" } else { "corner pixels" };
        let names = ["upper left", "upper right", "lower left", "lower right"];
        let named = |looked_at: [bool; 4]| {
            let all = names.iter().zip(looked_at).filter(|(_, is_one)| *is_one);
            all.map(|(name, _)| *name).collect::<Vec<_>>()
        };
        let which = match self.probes {
            Probes::Center if self.are_corners => "their middle".to_owned(),
            Probes::Center => "the pixel in their middle".to_owned(),
            Probes::Reach(reach) => {
                let length = match reach {
                    Reach::Larger => "the larger",
                    Reach::Smaller => "the smaller",
                };
                return format!(
                    "{tiles}{} were left out where their middle lies farther outside an edge than half a side times {length} of its |dx| and |dy|, not their sum",
                    self.quarters()
                );
            }
            Probes::Corners(ALL_CORNERS) => format!("their four {point}"),
            Probes::Corners(looked_at) => {
                let named = named(looked_at);
                let point = if named.len() == 1 { point.trim_end_matches('s') } else { point };
                format!("their {} {point}", named.join(", "))
            }
        };
        let is_one = self.probes == Probes::Center
            || matches!(self.probes, Probes::Corners(of) if named(of).len() == 1);
        match (self.decides, is_one) {
            (Decides::Fills, true) => format!("{tiles} were filled whole where {which} is inside"),
            (Decides::Fills, false) => {
                format!("{tiles} were filled whole where {which} are all inside")
            }
            (_, true) => {
                format!("{tiles}{} were left out where {which} is not inside", self.quarters())
            }
            (_, false) => {
                format!("{tiles}{} were left out where none of {which} is inside", self.quarters())
            }
        }
    }

    fn quarters(self) -> &'static str {
        match self.decides {
            Decides::SkipsQuarters => " and their quarters, down to 2 x 2 px,",
            _ => "",
        }
    }
}

/// Draws the pixels of a square in the window so often.
fn set_square(picture: &mut Picture, [x, y]: [i32; 2], size: i32, hits: u8) {
    for row in y..y + size {
        for column in x..x + size {
            if picture.shows([column, row]) {
                picture.set([column, row], hits);
            }
        }
    }
}

/// The pixels that are reached from one of them.
fn flood(before: &Picture, seed: Seed, q: &AnyQuestion) -> Picture {
    let mut after = Picture::new(before.side);
    let pixel = |p: [i64; 2]| p.map(|v| v.div_euclid(256).clamp(-1, 1 << 20) as i32);
    let seed = match seed {
        Seed::FirstPixel => before.pixels().find(|at| before.has(*at)),
        Seed::Centroid => {
            let sum = |axis: usize| q.points.iter().map(|p| p[axis]).sum::<i64>();
            Some(pixel([sum(0).div_euclid(3), sum(1).div_euclid(3)]))
        }
        Seed::Corner(place) => Some(pixel(q.points[q.by_height()[place]])),
    };
    let is_in = |at: [i32; 2]| before.shows(at) && before.has(at);
    let mut open: Vec<[i32; 2]> = seed.into_iter().filter(|at| is_in(*at)).collect();
    while let Some([x, y]) = open.pop() {
        if after.has([x, y]) {
            continue;
        }
        after.set([x, y], before.hits([x, y]));
        let beside = [[x + 1, y], [x - 1, y], [x, y + 1], [x, y - 1]];
        open.extend(beside.into_iter().filter(|at| is_in(*at) && !after.has(*at)));
    }
    after
}
