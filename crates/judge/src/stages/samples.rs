//! Which of the four samples of a pixel are covered, as a mask that may be mistaken.

use crate::declared::Declared;
use std::ops::RangeInclusive;
use std::sync::LazyLock;

use super::grids::on_grid;
use super::search::{Field, Quantity, Spot, Stage, composed};
use crate::ask::{Answer, Asked, Question};
use crate::pixels::masks_of;
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::{PixelRect, SUBPIXELS};
use rasterproof_core::triangle::Corners;
use rasterproof_render::pipeline::multisample::SAMPLES;
use rasterproof_verify::convention::RULES;
use rasterproof_verify::convention::{Quantum, Rounding, Ties};

composed! {
    /// A mask of samples.
    pub struct SampleMask {
        pattern: Pattern,
        order: Order,
        grid: Grid,
        rule: Rule,
        gate: Gate,
        table: Table,
        only: Only,
    }
}

/// Places in 1/16 px from the upper left corner of the pixel, in the order of their bits; and how they are said.
#[derive(Clone, Debug, PartialEq)]
pub struct Pattern([(i32, i32); 4], Option<&'static str>);

impl Default for Pattern {
    fn default() -> Self {
        Self(SAMPLES, None)
    }
}

/// A place of a sample in place of the right one.
type MovedPlace = fn((i32, i32)) -> (i32, i32);
/// The rules by which all places may be moved, with their words.
const MOVED: [(MovedPlace, &str); 7] = [
    (|_| (8, 8), "tests {} at the centre"),
    (|(x, y)| (16 - x, y), "tests {} mirrored left to right"),
    (|(x, y)| (x, 16 - y), "tests {} mirrored upside down"),
    (|(x, y)| (y, x), "tests {} with x and y exchanged"),
    (|(x, y)| (x - 8, y - 8), "tests {} around the upper left corner of the pixel"),
    (|(x, _)| (x, 8), "tests {} at the height of the centre"),
    (|(_, y)| (8, y), "tests {} in the column of the centre"),
];

impl Field for Pattern {
    const NAME: &'static str = "places of the samples";

    fn options() -> Vec<Self> {
        // The right places, each moved by one rule, and one other pattern.
        let mut all = Vec::new();
        for (moved, said) in MOVED {
            all.push(Self(SAMPLES.map(moved), Some(said)));
        }
        let by_quarters = [(4, 4), (12, 4), (4, 12), (12, 12)];
        let said = "tests {} two by two, at quarters of the pixel";
        all.insert(1, Self(by_quarters, Some(said)));
        all
    }

    fn says(&self) -> Option<(String, &'static str)> {
        let [a, b, c, d] = self.0.map(|(x, y)| format!("({x}, {y})"));
        let found = format!("tests samples at {a}, {b}, {c} and {d} of 1/16 px");
        Some((self.1.map_or(found, str::to_owned), "test each sample at its own place"))
    }
}

/// The numbers of the places, in the order of the bits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Order([usize; 4]);

impl Default for Order {
    fn default() -> Self {
        Self([0, 1, 2, 3])
    }
}

impl Field for Order {
    const NAME: &'static str = "order of the samples";

    fn options() -> Vec<Self> {
        let mut all = Vec::new();
        // Two bits of the code for each number; it is an order where each number comes once.
        for code in 0..256_usize {
            let order = [code >> 6, code >> 4 & 3, code >> 2 & 3, code & 3];
            let [a, b, c, d] = order;
            let numbers = 1 << a | 1 << b | 1 << c | 1 << d;
            if numbers == 0b1111 && Self(order) != Self::default() {
                all.push(Self(order));
            }
        }
        all
    }

    fn says(&self) -> Option<(String, &'static str)> {
        let [a, b, c, d] = self.0;
        Some((
            format!("numbers the samples {a}, {b}, {c}, {d}"),
            "number the samples as the bits that the protocol states",
        ))
    }
}

on_grid! {
    /// The grid of corners before samples are tested.
    pub struct Grid: "corners of the samples", "tests {{}} of corners that are {}",
        "test samples of the corners by which pixels are covered",
        [Down, Near, HalfEven, HalfAway, TowardZero]
}

/// The fill rules of clockwise triangles and of the others.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rule([usize; 2]);

/// The rules of the protocol, of which the first one is right.
pub(super) static TIES: LazyLock<Vec<Ties>> =
    LazyLock::new(|| RULES.iter().filter_map(|name| Ties::named(name)).collect());

impl Field for Rule {
    const NAME: &'static str = "rule for samples";

    fn options() -> Vec<Self> {
        let mut all = Vec::new();
        for clockwise in 0..TIES.len() {
            for other in 0..TIES.len() {
                let rule = Self([clockwise, other]);
                if rule != Self::default() {
                    all.push(rule);
                }
            }
        }
        all
    }

    fn says(&self) -> Option<(String, &'static str)> {
        // One rule for both windings is said once.
        let [clockwise, other] = self.0.map(|rule| RULES[rule]);
        let does = match clockwise == other {
            true => format!("follows the {clockwise} rule for {{}} on edges"),
            false => format!(
                "follows the {clockwise} rule for {{}} on edges of clockwise triangles and the {other} rule for those of others"
            ),
        };
        Some((does, "test each sample by the rule that pixels follow"))
    }
}

/// What becomes of a mask in the pixels of which something holds, or in the others.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Gate {
    #[default]
    None,
    /// Samples are drawn there alone.
    Only(If),
    /// All samples are drawn there, and none elsewhere, or those elsewhere that are covered.
    Whole(If),
    WholeToo(If),
    /// None is drawn there.
    Not(If),
}

/// Points of a pixel in 1/16 px that may be tested in place of its samples.
pub(super) const POINTS: [((i32, i32), &str); 8] = [
    ((0, 0), "the upper left corner"),
    ((16, 0), "the upper right corner"),
    ((0, 16), "the lower left corner"),
    ((16, 16), "the lower right corner"),
    ((0, 8), "the middle of the left side"),
    ((16, 8), "the middle of the right side"),
    ((8, 0), "the middle of the upper side"),
    ((8, 16), "the middle of the lower side"),
];

/// What may have to hold of a pixel before its samples are drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum If {
    /// The centre is covered, by whatever rule the samples follow.
    Centre,
    /// The point of this number in [`POINTS`] is covered, wherever the samples lie.
    Point(usize),
    /// So many samples at least are covered.
    Covered(u32),
    /// The centre lies within these sides of the box around the corners, or also on them.
    Box { sides: u8, is_open: bool },
}

impl If {
    /// Whether it holds of a pixel, of whose samples those in the mask are covered.
    fn holds(self, mask: u8, pixel: &Masked<'_>) -> bool {
        match self {
            Self::Centre => pixel.is_centre_covered,
            Self::Point(point) => pixel.has_point(POINTS[point].0),
            Self::Covered(least) => mask.count_ones() >= least,
            Self::Box { sides, is_open } => {
                has_bits(sides).into_iter().all(|side| is_within_side(pixel, side, is_open))
            }
        }
    }

    /// What is said of it, after a pixel.
    fn words(self) -> String {
        match self {
            Self::Centre => "whose centre is covered".to_owned(),
            Self::Point(point) => format!("of which {} is covered", POINTS[point].1),
            Self::Covered(0) => "of any kind".to_owned(),
            Self::Covered(least) => {
                // From one sample on.
                let least = ["any is", "two are", "three are", "all four are"][least as usize - 1];
                format!("where {least} covered")
            }
            Self::Box { sides, is_open } => {
                // In the order of the bits of the sides.
                let names = ["left", "upper", "right", "lower"];
                let sides: Vec<_> = has_bits(sides).into_iter().map(|side| names[side]).collect();
                let border = if is_open { "in" } else { "in, or on the border of," };
                format!(
                    "whose centre lies {border} the box around the triangle ({} side)",
                    sides.join(", ")
                )
            }
        }
    }
}

/// The numbers of the bits that a mask of four has.
fn has_bits(mask: u8) -> Vec<usize> {
    let mut bits = Vec::new();
    for bit in 0..4 {
        if mask >> bit & 1 == 1 {
            bits.push(bit);
        }
    }
    bits
}

/// Whether the centre of a pixel lies within one side of the box around the corners of its triangle, or also on it. The sides are
/// left, top, right and bottom: of the last two everything is turned round, so that each is the least coordinate of a corner.
fn is_within_side(pixel: &Masked<'_>, side: usize, is_open: bool) -> bool {
    let (axis, sign) = (side % 2, if side < 2 { 1 } else { -1 });
    let centre = sign * i64::from(pixel.spot.at[axis] * SUBPIXELS + SUBPIXELS / 2);
    for corner in pixel.corners {
        let corner = sign * i64::from([corner.x, corner.y][axis]);
        if corner < centre || (!is_open && corner == centre) {
            return true;
        }
    }
    false
}

impl Field for Gate {
    const NAME: &'static str = "pixels whose samples are drawn";

    fn options() -> Vec<Self> {
        let mut tests = vec![If::Centre];
        tests.extend((0..POINTS.len()).map(If::Point));
        tests.extend((0..=4).map(If::Covered));
        for is_open in [false, true] {
            tests.extend((1..16).map(|sides| If::Box { sides, is_open }));
        }
        let mut all = Vec::new();
        for test in tests {
            // What holds of every pixel decides nothing, but that samples may be drawn always or never.
            if test != If::Covered(0) {
                all.push(Self::Only(test));
            }
            all.extend([Self::Whole(test), Self::WholeToo(test), Self::Not(test)]);
        }
        all
    }

    fn says(&self) -> Option<(String, &'static str)> {
        let does = match self {
            Self::None => return None,
            Self::Not(If::Covered(0)) => "never draws {}".to_owned(),
            Self::Only(test) => format!("tests {{}} in pixels {}, and in no others", test.words()),
            Self::Whole(test) => {
                format!("draws {{}} of a pixel {}, and not elsewhere", test.words())
            }
            Self::WholeToo(test) => {
                format!("draws {{}} of a pixel {}, and what is covered elsewhere", test.words())
            }
            Self::Not(test) => format!("does not draw {{}} of a pixel {}", test.words()),
        };
        Some((does, "test each sample for itself in every pixel"))
    }
}

/// The mask that is drawn for each right one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Table([u8; 16]);

impl Default for Table {
    fn default() -> Self {
        Self([0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15])
    }
}

impl Field for Table {
    const NAME: &'static str = "masks of samples";

    /// It is read off.
    fn options() -> Vec<Self> {
        Vec::new()
    }

    fn says(&self) -> Option<(String, &'static str)> {
        let repair = "draw the samples that are covered";
        // A sample that is never drawn is said in one word, whatever else the table holds.
        for bit in 0..4 {
            if (0..16_u8).all(|right| self.0[usize::from(right)] == right & !(1 << bit)) {
                return Some((format!("never draws the sample with the number {bit}"), repair));
            }
        }
        let mut changed = Vec::new();
        for right in 0..16_u8 {
            let drawn = self.0[usize::from(right)];
            if drawn != right {
                changed.push(format!("{} for {}", numbers_of(drawn), numbers_of(right)));
            }
        }
        let more = match changed.len().saturating_sub(3) {
            0 => String::new(),
            more => format!(", and {more} others"),
        };
        changed.truncate(3);
        Some((format!("draws samples {}{more}, whatever the place", changed.join(", ")), repair))
    }
}

/// The numbers of the samples of a mask, in words.
fn numbers_of(mask: u8) -> String {
    match &has_bits(mask)[..] {
        [] => "none".to_owned(),
        bits => bits.iter().map(usize::to_string).collect::<Vec<_>>().join(" and "),
    }
}

/// The one sample that is wrong.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Only(Option<u8>);

impl Field for Only {
    const NAME: &'static str = "one sample";

    fn options() -> Vec<Self> {
        (0..4).map(|bit| Self(Some(bit))).collect()
    }

    fn says(&self) -> Option<(String, &'static str)> {
        None
    }
}

/// A pixel with its mask, and the right one.
pub struct Masked<'a> {
    pub(super) spot: Spot,
    corners: &'a Corners,
    /// The samples that were answered.
    pub(super) drawn: u8,
    /// The samples that are covered.
    pub(super) right: u8,
    pub(super) is_centre_covered: bool,
}

impl Masked<'_> {
    /// Whether a point of the pixel in 1/16 px is covered.
    pub(super) fn has_point(&self, at: (i32, i32)) -> bool {
        covers(self.corners, self.spot.at, at, &TIES[0])
    }

    /// How far a sample lies inside the nearest edge in steps of the lattice, below 0 outside; and whether it is exactly on one.
    pub(super) fn inside(&self, bit: u8) -> (i64, bool) {
        let (x, y) = SAMPLES[usize::from(bit)];
        let at = [(self.spot.at[0], x), (self.spot.at[1], y)]
            .map(|(v, part)| i64::from(v * SUBPIXELS + part * (SUBPIXELS / 16)));
        // Edges are walked clockwise, so that the inside lies on the same hand of each.
        let turn = i64::from(twice_area(self.corners).signum() as i8);
        let (mut nearest, mut is_on) = (i64::MAX, false);
        for i in 0..3 {
            let [a, b] =
                [i, (i + 1) % 3].map(|i| self.corners[i]).map(|c| [c.x, c.y].map(i64::from));
            let by = [0, 1].map(|k| (b[k] - a[k]) * turn);
            let side = by[0] * (at[1] - a[1]) - by[1] * (at[0] - a[0]);
            let length = ((by[0] as f64).powi(2) + (by[1] as f64).powi(2)).sqrt() as i64;
            nearest = nearest.min(side.div_euclid(length.max(1)));
            is_on |= side == 0;
        }
        (nearest, is_on && nearest >= 0)
    }
}

/// A direction as one of eight, from north on, clockwise.
pub(super) fn facing(direction: [i64; 2]) -> usize {
    match direction.map(i64::signum) {
        [0, -1] => 0,
        [1, -1] => 1,
        [1, 0] => 2,
        [1, 1] => 3,
        [0, 1] => 4,
        [-1, 1] => 5,
        [-1, 0] => 6,
        _ => 7,
    }
}

/// Whether a triangle covers a place of a pixel, in 1/16 px.
fn covers(corners: &Corners, pixel: [i32; 2], (x, y): (i32, i32), ties: &Ties) -> bool {
    let at = [(pixel[0], x), (pixel[1], y)]
        .map(|(v, part)| i64::from(v) * i64::from(SUBPIXELS) + i64::from(part * (SUBPIXELS / 16)));
    // In exact integers: a sample lies inside where it is on the inner side of each edge, or on one that the rule draws.
    let turn = i64::from(twice_area(corners).signum() as i8);
    for i in 0..3 {
        let [a, b] = [corners[i], corners[(i + 1) % 3]].map(|c| [i64::from(c.x), i64::from(c.y)]);
        let step = [0, 1].map(|k| (b[k] - a[k]) * turn);
        let product = |k: usize| i128::from(step[k]) * i128::from(at[1 - k] - a[1 - k]);
        let side = product(0) - product(1);
        // The outward normal of a clockwise edge.
        if side < 0 || (side == 0 && !ties.edges[facing([step[1], -step[0]])]) {
            return false;
        }
    }
    turn != 0
}

impl SampleMask {
    /// The samples that are covered at the places, before a gate.
    fn covered(&self, pixel: &Masked<'_>) -> u8 {
        if self.pattern == Pattern::default()
            && self.grid == Grid::default()
            && self.rule == Rule::default()
        {
            // Where nothing else is wrong, the right samples are there already, in another order.
            let mut mask = 0;
            for (bit, number) in self.order.0.into_iter().enumerate() {
                mask |= (pixel.right >> number & 1) << bit;
            }
            return mask;
        }
        let corners = self.corners(pixel);
        let ties = self.ties(&corners);
        let mut mask = 0;
        for (bit, number) in self.order.0.into_iter().enumerate() {
            let is_covered = covers(&corners, pixel.spot.at, self.pattern.0[number], ties);
            mask |= u8::from(is_covered) << bit;
        }
        mask
    }

    /// The corners of the triangle on the grid.
    fn corners(&self, pixel: &Masked<'_>) -> Corners {
        self.grid.0.snap(pixel.corners)
    }

    /// The rule of a triangle, by its winding.
    fn ties(&self, corners: &Corners) -> &'static Ties {
        &TIES[self.rule.0[usize::from(twice_area(corners) < 0)]]
    }

    /// The mask that is drawn.
    pub(super) fn mask(&self, pixel: &Masked<'_>) -> u8 {
        // The gate decides by what is covered; the table changes whatever is left, and a single wrong sample leaves the others
        // right.
        let covered = self.covered(pixel);
        let mask = match self.gate {
            Gate::None => covered,
            Gate::Only(test) if test.holds(covered, pixel) => covered,
            Gate::Whole(test) | Gate::WholeToo(test) if test.holds(covered, pixel) => 15,
            Gate::Only(_) | Gate::Whole(_) => 0,
            Gate::Not(test) if test.holds(covered, pixel) => 0,
            Gate::WholeToo(_) | Gate::Not(_) => covered,
        };
        let mask = self.table.0[usize::from(mask)];
        match self.only.0 {
            None => mask,
            Some(bit) => mask & 1 << bit | pixel.right & !(1 << bit),
        }
    }

    /// The places at which the samples seem to be tested, each on its own.
    fn with_pattern(&self, parts: &[&Masked<'_>]) -> Option<Self> {
        // Every place in the pixel, and the right places of the eight pixels around it.
        let mut places = Vec::new();
        for y in 0..=16 {
            for x in 0..=16 {
                places.push((x, y));
            }
        }
        for k in (0..9).filter(|k| *k != 4) {
            let (dx, dy) = (k % 3 * 16 - 16, k / 3 * 16 - 16);
            places.extend(SAMPLES.map(|(x, y)| (x + dx, y + dy)));
        }
        // Of each place the samples that are drawn wherever it is covered, and nowhere else; a place without one is left out.
        let mut left: Vec<_> = places.into_iter().map(|place| (place, 15_u8)).collect();
        for pixel in parts.iter().take(SOLVED_BY) {
            let corners = self.corners(pixel);
            let ties = self.ties(&corners);
            for (place, bits) in &mut left {
                let is_covered = covers(&corners, pixel.spot.at, *place, ties);
                *bits &= if is_covered { pixel.drawn } else { !pixel.drawn };
            }
            left.retain(|(_, bits)| *bits > 0);
        }
        // Each sample is tested at the first place that is left for it.
        let mut found = [(0, 0); 4];
        for (bit, found) in found.iter_mut().enumerate() {
            (*found, _) = *left.iter().find(|(_, bits)| bits >> bit & 1 == 1)?;
        }
        let pattern = Pattern(found, None);
        (pattern.0 != SAMPLES).then(|| Self { pattern, order: Order::default(), ..self.clone() })
    }

    /// The mask that is drawn for each one, where there is such a table; as it is where none was seen.
    fn with_table(&self, parts: &[&Masked<'_>]) -> Option<Self> {
        // Each mask must be drawn in one way wherever it comes.
        let mut table: [Option<u8>; 16] = [None; 16];
        for pixel in parts {
            let mask = usize::from(self.mask(pixel));
            if *table[mask].get_or_insert(pixel.drawn) != pixel.drawn {
                return None;
            }
        }
        let mut masks = Table::default();
        for (mask, seen) in masks.0.iter_mut().zip(table) {
            *mask = seen.unwrap_or(*mask);
        }
        Some(Self { table: masks, ..self.clone() })
    }
}

/// Pixels around a triangle that are looked at.
const AROUND_PX: i32 = 2;
/// Pixels by which places are told apart.
const SOLVED_BY: usize = 4_000;

/// The columns, or the rows, from some before the first corner to some behind the last one.
fn around([a, b, c]: [i32; 3]) -> RangeInclusive<i32> {
    let (least, most) = (a.min(b).min(c), a.max(b).max(c));
    least.div_euclid(SUBPIXELS) - AROUND_PX..=most.div_euclid(SUBPIXELS) + AROUND_PX
}

impl Stage for SampleMask {
    type Part<'a> = Masked<'a>;
    const PAGE: &'static str = "games101";
    const REFUTED: &'static str = "a pixel of which other samples are drawn";
    const NOISE: &'static [f64] = &[0.0];
    const WHOM: &'static str = "pixels";

    fn parts<'a>(
        question: &'a Question,
        answer: &'a Answer,
        _: &Declared,
        _: f64,
    ) -> Vec<Masked<'a>> {
        let (Asked::Samples(corners), Answer::Samples(runs)) = (&question.of, answer) else {
            return Vec::new();
        };
        // Every pixel in and around the triangle: mistakes move samples by a pixel or two.
        let window = PixelRect::window(question.width, question.height);
        let mut parts = Vec::new();
        let (ties, is_clockwise) = (&TIES[0], twice_area(corners) > 0);
        let (xs, ys) = (around(corners.map(|c| c.x)), around(corners.map(|c| c.y)));
        for (y, row) in masks_of(runs, window).rows() {
            for (x, &drawn) in (window.x0..).zip(row) {
                // Nothing is drawn there by any of the mistakes.
                if drawn == 0 && !(xs.contains(&x) && ys.contains(&y)) {
                    continue;
                }
                let is_covered = |place| covers(corners, [x, y], place, ties);
                let mut right = 0;
                for (bit, place) in SAMPLES.into_iter().enumerate() {
                    right |= u8::from(is_covered(place)) << bit;
                }
                let spot = Spot { at: [x, y], is_clockwise, window };
                parts.push(Masked {
                    spot,
                    corners,
                    drawn,
                    right,
                    is_centre_covered: is_covered((8, 8)),
                });
            }
        }
        parts
    }

    fn explains(&self, part: &Masked<'_>) -> bool {
        self.mask(part) == part.drawn
    }

    fn solved(&self, parts: &[&Masked<'_>]) -> Vec<Self> {
        // Places are read off masks as they are covered, so that neither a gate nor a table may lie between.
        let is_open = self.gate == Gate::None
            && self.table == Table::default()
            && self.only == Only::default();
        let pattern = if is_open { self.with_pattern(parts) } else { None };
        pattern.into_iter().chain(self.with_table(parts)).collect()
    }

    fn quantities(pixel: &Masked<'_>) -> Vec<Quantity> {
        let mut all = pixel.spot.quantities();
        all.push(Quantity::number("the number of covered samples", pixel.right.count_ones()));
        all
    }

    fn observations(pixel: &Masked<'_>) -> Vec<Quantity> {
        let (drawn, right) = (pixel.drawn, pixel.right);
        let mut all = Self::quantities(pixel);
        let lacks_some = "without some samples, and have none too many";
        all.push(Quantity::whether(drawn & !right == 0, lacks_some, ""));
        let has_more = "with samples too many, and lack none";
        all.push(Quantity::whether(right & !drawn == 0, has_more, ""));
        // Where several samples are wrong, no number passes a test.
        let wrong = right ^ drawn;
        let number = if wrong.is_power_of_two() { f64::from(wrong.ilog2()) } else { f64::NAN };
        all.push(Quantity::number("the number of the wrong sample", number));
        all
    }

    fn filled(&self, does: &str) -> String {
        let whose = self.only.0.map(|bit| format!("the sample with the number {bit}"));
        does.replace("{}", whose.as_deref().unwrap_or("all four samples"))
    }
}
