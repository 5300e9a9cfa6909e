//! Borders computed otherwise: where an edge crosses the samples of a row, or which pixel a line has in a column.
//!
//! What a program computes is a formula, `start + slope * distance`, and each part of it has a format. A formula is tried on
//! single borders, which are read off the answers, so that it is found even where it holds for some edges alone: which these
//! are is learned as any other fact.

use super::picture::{MARGIN, Picture};
use super::quantity::{AXES, EDGES, Quantities};
use super::question::{AnyQuestion, Unit};

/// Where a number is rounded to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Toward {
    Down,
    Nearest,
    /// The same, but a half goes down.
    NearestDown,
    Up,
    Zero,
    /// To the nearest, and a half away from 0, as the function `round` of many languages.
    HalfAway,
    /// To the nearest, and a half to the even number, as processors round.
    HalfEven,
}

impl Toward {
    /// Those that programs use.
    pub(super) const ALL: [Self; 6] =
        [Self::Down, Self::Nearest, Self::Up, Self::Zero, Self::HalfAway, Self::HalfEven];

    /// Which way, as it is said after 'rounded'.
    pub(super) fn words(self) -> &'static str {
        match self {
            Self::Down => "down",
            Self::Nearest => "to the nearest",
            Self::NearestDown => "to the nearest (a half down)",
            Self::Up => "up",
            Self::Zero => "toward 0",
            Self::HalfAway => "to the nearest (a half away from 0)",
            Self::HalfEven => "to the nearest (a half to the even one)",
        }
    }
}

/// Which of two pixels of a line is taken that are as near: of a row, whether a sample exactly on its border lies in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Tie {
    Down,
    Up,
    /// The one that the line comes from or goes to, seen from its left or upper end.
    Back,
    On,
    /// The same, seen from the end that is given first.
    BackFromFirst,
    OnFromFirst,
}

impl Tie {
    pub(super) const ALL: [Self; 6] =
        [Self::Down, Self::Up, Self::Back, Self::On, Self::BackFromFirst, Self::OnFromFirst];
}

/// The point that the distance is counted from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum From {
    /// The end that comes first in the order of rows, or of columns.
    Before,
    After,
    /// The end that is given first.
    First,
    Second,
}

impl From {
    /// Whether whoever goes from one place to another begins at the other one.
    pub(super) fn is_turned<T: PartialOrd>(self, from: T, to: T) -> bool {
        match self {
            Self::Before => from > to,
            Self::After => from < to,
            Self::First => false,
            Self::Second => true,
        }
    }
}

/// Adds a formula that differs from this one by a change, unless it is the same.
pub(super) fn add_changed<F: Copy + PartialEq>(
    all: &mut Vec<F>,
    this: &F,
    change: &dyn Fn(&mut F),
) {
    let mut other = *this;
    change(&mut other);
    if other != *this {
        all.push(other);
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Slope {
    Exact,
    /// So many bits of fraction, and so many bits in all if they are limited.
    Fixed {
        fraction: u32,
        toward: Toward,
        word: Option<u32>,
    },
    /// The shorter side in a word of so many bits.
    Word {
        bits: u32,
        is_signed: bool,
    },
    /// A float of so many bits, in which slope times distance and the sum are computed, too.
    Float {
        bits: u32,
    },
    /// A float of so many bits that is added row by row, or column by column.
    Added {
        bits: u32,
    },
    /// A product with the reciprocal of the length, which has so many bits of fraction (of 1/px).
    Reciprocal {
        fraction: u32,
        toward: Toward,
    },
    /// The same, where the reciprocal has so many bits from its first one on.
    Short {
        bits: u32,
        toward: Toward,
    },
    /// It is as if the edge went straight.
    None,
    /// The other way.
    Reversed,
    Twice,
}

/// How far the row is from the start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Distance {
    Exact,
    /// Rows from the first one: the way from the corner to the first sample is left out.
    Rows,
    /// From the top of the whole shape.
    FromTop,
}

/// The format of slope times distance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Product {
    Exact,
    /// A signed word of so many bits.
    Word(u32),
    /// A multiple of so many 1/65536 px.
    Rounded(i64, Toward),
}

/// A formula of a border. All lengths are in 1/256 px.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Crossing {
    pub(super) from: From,
    /// The coordinates of the start along the border's axis and across it, rounded to whole pixels.
    pub(super) start: [Option<Toward>; 2],
    /// Whether the run of the edge, and its rise, are measured between coordinates that are rounded to whole pixels.
    pub(super) sides: [Option<Toward>; 2],
    /// Pixels that the length of the edge is too long by.
    pub(super) rise: i64,
    pub(super) slope: Slope,
    pub(super) distance: Distance,
    pub(super) product: Product,
    /// Whether what lies between the start and the window is left out.
    pub(super) from_window: bool,
    /// Whether its two ends have each other's place along the row.
    pub(super) exchanged: bool,
    /// What is added to the distance and to the result.
    pub(super) later: i64,
    pub(super) shift: i64,
    /// The multiple of so many 1/65536 px that the result is rounded to.
    pub(super) sum: Option<(i64, Toward)>,
    /// The multiple of so many pixels that the pixel is rounded to.
    pub(super) group: Option<(i64, Toward)>,
    /// Of the first and of the last end of a row; a line has the first alone.
    pub(super) ties: [Tie; 2],
}

impl Crossing {
    pub(super) const RIGHT: Self = Self {
        from: From::Before,
        start: [None; 2],
        sides: [None; 2],
        rise: 0,
        slope: Slope::Exact,
        distance: Distance::Exact,
        product: Product::Exact,
        from_window: false,
        exchanged: false,
        later: 0,
        shift: 0,
        sum: None,
        group: None,
        ties: [Tie::Down; 2],
    };

    /// Fields that are not as in the right formula, apart from its ties.
    pub(super) fn changes(&self) -> usize {
        let right = Self::RIGHT;
        [
            self.from != right.from,
            self.start[0].is_some(),
            self.start[1].is_some(),
            self.sides[0].is_some(),
            self.sides[1].is_some(),
            self.rise != 0,
            self.slope != right.slope,
            self.distance != right.distance,
            self.product != right.product,
            self.from_window,
            self.exchanged,
            self.later != 0,
            self.shift != 0,
            self.sum.is_some(),
            self.group.is_some(),
        ]
        .into_iter()
        .filter(|is_changed| *is_changed)
        .count()
    }

    /// All formulas with one more field changed, or with another tie.
    pub(super) fn neighbours(&self) -> Vec<Self> {
        let mut all = self.variants();
        let more = self.changes() + 1;
        all.retain(|other| other.changes() == more || Self { ties: self.ties, ..*other } == *self);
        all
    }

    /// All formulas with one other field.
    pub(super) fn variants(&self) -> Vec<Self> {
        let right = Self::RIGHT;
        let mut all = Vec::new();
        let mut with = |change: &dyn Fn(&mut Self)| add_changed(&mut all, self, change);
        // Each field as in the right formula.
        with(&|c| c.from = right.from);
        for way in [0, 1] {
            with(&|c| c.start[way] = None);
            with(&|c| c.sides[way] = None);
        }
        with(&|c| c.rise = right.rise);
        with(&|c| c.slope = right.slope);
        with(&|c| c.distance = right.distance);
        with(&|c| c.product = right.product);
        with(&|c| c.from_window = right.from_window);
        with(&|c| c.exchanged = right.exchanged);
        with(&|c| c.later = right.later);
        with(&|c| c.shift = right.shift);
        with(&|c| c.sum = right.sum);
        with(&|c| c.group = right.group);
        for pixels in [2, 4, 8, 16] {
            for toward in [Toward::Down, Toward::Up] {
                with(&|c| c.group = Some((pixels, toward)));
            }
        }
        for from in [From::After, From::First, From::Second] {
            with(&|c| c.from = from);
        }
        for toward in Toward::ALL {
            for way in [0, 1] {
                with(&|c| c.start[way] = Some(toward));
                with(&|c| c.sides[way] = Some(toward));
            }
        }
        for rise in [-2, -1, 1, 2] {
            with(&|c| c.rise = rise);
        }
        let floats =
            [24, 53].into_iter().flat_map(|bits| [Slope::Float { bits }, Slope::Added { bits }]);
        for slope in [Slope::None, Slope::Reversed, Slope::Twice].into_iter().chain(floats) {
            with(&|c| c.slope = slope);
        }
        for fraction in [0, 1, 2, 4, 6, 8, 10, 12, 14, 16] {
            for toward in Toward::ALL {
                with(&|c| c.slope = Slope::Fixed { fraction, toward, word: None });
                for word in [fraction + 8, 16, 32] {
                    let word = Some(word);
                    with(&|c| c.slope = Slope::Fixed { fraction, toward, word });
                }
            }
        }
        for toward in [Toward::Down, Toward::Nearest] {
            for fraction in [6, 8, 10, 12, 14, 15, 16] {
                with(&|c| c.slope = Slope::Reciprocal { fraction, toward });
            }
            for bits in [8, 9, 11, 12, 16] {
                with(&|c| c.slope = Slope::Short { bits, toward });
            }
        }
        for bits in 4..=20 {
            with(&|c| c.slope = Slope::Word { bits, is_signed: false });
            with(&|c| c.slope = Slope::Word { bits, is_signed: true });
        }
        for distance in [Distance::Rows, Distance::FromTop] {
            with(&|c| c.distance = distance);
        }
        with(&|c| c.from_window = true);
        with(&|c| c.exchanged = true);
        for bits in [16, 20, 24, 28, 31, 32] {
            with(&|c| c.product = Product::Word(bits));
        }
        for step in (0..=8).map(|bits| 1 << (2 * bits)) {
            for toward in Toward::ALL {
                with(&|c| c.product = Product::Rounded(step, toward));
                with(&|c| c.sum = Some((step, toward)));
            }
        }
        for by in [128, 256, 512, 1024, 2048].into_iter().flat_map(|by| [by, -by]) {
            with(&|c| c.later = by);
            with(&|c| c.shift = by);
        }
        // Ties are no change, but which they are may change with the rest.
        for end in [0, 1] {
            for tie in Tie::ALL.into_iter().filter(|tie| *tie != self.ties[end]) {
                let mut other = *self;
                other.ties[end] = tie;
                all.push(other);
            }
        }
        all
    }
}

/// A fraction as a whole number.
pub(super) fn round(num: i128, den: i128, toward: Toward) -> i128 {
    let (num, den) = if den < 0 { (-num, -den) } else { (num, den) };
    match toward {
        Toward::Down => floor(num, den),
        Toward::Up => -floor(-num, den),
        Toward::Nearest => floor(2 * num + den, 2 * den),
        Toward::NearestDown => -floor(den - 2 * num, 2 * den),
        Toward::Zero => num.signum() * floor(num.abs(), den),
        Toward::HalfAway => num.signum() * floor(2 * num.abs() + den, 2 * den),
        Toward::HalfEven => {
            let up = floor(2 * num + den, 2 * den);
            let is_half = 2 * den * up == 2 * num + den;
            if is_half { up - up.rem_euclid(2) } else { up }
        }
    }
}

/// A fraction with a positive denominator, rounded down. Most numbers have 64 bits, which are divided many times faster than 128.
fn floor(num: i128, den: i128) -> i128 {
    match (i64::try_from(num), i64::try_from(den)) {
        (Ok(num), Ok(den)) => num.div_euclid(den).into(),
        _ => num.div_euclid(den),
    }
}

/// A number as a float of 24 or 53 bits.
#[inline]
pub(super) fn float(v: f64, bits: u32) -> f64 {
    if bits == 24 { f64::from(v as f32) } else { v }
}

/// Bits of fraction that a float's value is taken with: all that a number of at least 1/256 px has.
const FRACTION: u32 = 60;

/// Rows after which a slope is no longer added.
const MOST_ADDED: i128 = 1 << 13;

fn fraction_of(v: f64) -> i128 {
    (v * (1_u64 << FRACTION) as f64) as i128
}

pub(super) fn wrap(v: i128, bits: u32) -> i128 {
    // The bits that do not fit are shifted out, and the sign comes back.
    v << (i128::BITS - bits) >> (i128::BITS - bits)
}

/// A border of a question: an edge where it crosses a row, or a line where it crosses a column or a row.
#[derive(Clone, Copy, Debug)]
pub(super) struct Site {
    /// 1 where the place is a row, 0 where it is a column.
    pub(super) axis: usize,
    pub(super) place: i64,
    /// Which end of the row it is; of a line, its pixel.
    pub(super) end: usize,
    /// The points of the edge.
    pub(super) points: [usize; 2],
}

impl Site {
    /// The pixel: the first of a row, or the first after it; of a line, the one that it has. Nothing where the formula has no
    /// number.
    pub(super) fn evaluate(
        &self,
        formula: &Crossing,
        q: &AnyQuestion,
        sample: [i64; 2],
    ) -> Option<i64> {
        let (axis, along) = (self.axis, 1 - self.axis);
        let one = 256 / q.one();
        let point = |i: usize| {
            let [x, y] = q.points[i];
            [i128::from(x * one), i128::from(y * one)]
        };
        let (mut a, mut b) = (point(self.points[0]), point(self.points[1]));
        let is_forward = a[axis] < b[axis];
        if formula.from.is_turned(a[axis], b[axis]) {
            std::mem::swap(&mut a, &mut b);
        }
        if formula.exchanged {
            (a[along], b[along]) = (b[along], a[along]);
        }
        let snapped =
            |v: i128, toward: Option<Toward>| toward.map_or(v, |t| round(v, 256, t) * 256);
        let side = |way: usize, toward| snapped(b[way], toward) - snapped(a[way], toward);
        let [run, mut rise] = [side(along, formula.sides[0]), side(axis, formula.sides[1])];
        rise += rise.signum() * 256 * i128::from(formula.rise);
        if rise == 0 {
            return None;
        }
        let start = [snapped(a[along], formula.start[0]), snapped(a[axis], formula.start[1])];
        let at = i128::from(self.place * 256 + sample[axis]);
        // The place of the start: the first sample that is not before it.
        let place = -(i128::from(sample[axis]) - start[1]).div_euclid(256);
        let mut distance = match formula.distance {
            Distance::Exact => at - start[1],
            Distance::Rows => 256 * (i128::from(self.place) - place),
            Distance::FromTop => at - i128::from(q.range(axis)[0] * one),
        } + i128::from(formula.later);
        let mut first = place;
        if formula.from_window {
            first = place.clamp(0, i128::from(q.side[axis]) - 1);
            distance -= 256 * (first - place);
        }
        let (num, den) = match formula.slope {
            Slope::Exact => (run * distance, rise),
            Slope::None => (0, 1),
            Slope::Reversed => (-run * distance, rise),
            Slope::Twice => (2 * run * distance, rise),
            Slope::Float { bits } => {
                // In px, as a program computes it; the start is taken off again, since it is added below.
                let px = |v: i128| v as f64 / 256.0;
                let slope = float(px(run) / px(rise), bits);
                let way = float(slope * px(distance), bits);
                let sum = float(float(px(start[0]), bits) + way, bits);
                (fraction_of(sum) - (start[0] << (FRACTION - 8)), 1 << (FRACTION - 8))
            }
            Slope::Added { bits } => {
                let px = |v: i128| v as f64 / 256.0;
                let slope = float(px(run) / px(rise), bits);
                // From the first row on; what lies before it is one product.
                let rows = i128::from(self.place) - first;
                let way = distance - 256 * rows;
                if !(0..=MOST_ADDED).contains(&rows) {
                    return None;
                }
                let mut sum = float(float(px(start[0]), bits) + float(slope * px(way), bits), bits);
                for _ in 0..rows {
                    sum = float(sum + slope, bits);
                }
                (fraction_of(sum) - (start[0] << (FRACTION - 8)), 1 << (FRACTION - 8))
            }
            Slope::Word { bits, is_signed } => {
                // Lines count whole pixels.
                let unit = i128::from(one);
                let size = run.abs() / unit;
                let size = if is_signed { wrap(size, bits) } else { size & ((1 << bits) - 1) };
                (run.signum() * size * unit * distance, rise)
            }
            Slope::Reciprocal { fraction, toward } => {
                let over = round(256 << fraction, rise, toward);
                (run * over * distance, 256 << fraction)
            }
            Slope::Short { bits, toward } => {
                // 2^place is the part of the reciprocal that its last bit counts.
                let length = rise.unsigned_abs().max(1);
                let place = FRACTION.saturating_sub(length.ilog2() + bits);
                let step = 1 << place;
                let over = round(1 << FRACTION, rise * step, toward) * step;
                (run * over * distance, 1 << FRACTION)
            }
            Slope::Fixed { fraction, toward, word } => {
                let slope = round(run << fraction, rise, toward);
                (word.map_or(slope, |bits| wrap(slope, bits)) * distance, 1 << fraction)
            }
        };
        let (num, den) = match formula.product {
            Product::Exact => (num, den),
            Product::Word(bits) => {
                // Lines count whole pixels.
                let unit = i128::from(one * one);
                (wrap(floor(num, unit), bits) * unit, den)
            }
            Product::Rounded(step, toward) => {
                let step = i128::from(step);
                (round(256 * num, den * step, toward) * step, 256)
            }
        };
        let value = start[0] * den + num + i128::from(formula.shift) * den;
        let (value, den) = if den < 0 { (-value, -den) } else { (value, den) };
        let (value, den) = match formula.sum {
            Some((step, toward)) => {
                let step = i128::from(step);
                (round(256 * value, den * step, toward) * step, 256)
            }
            None => (value, den),
        };
        // A row begins at the first sample that is not before the crossing; a line has the pixel that is nearest.
        let sample = i128::from(if q.is_line() { 128 } else { sample[along] });
        // Whether the line goes up in its shorter direction, seen from its left or upper end.
        let climbs = (run > 0) == (b[axis] > a[axis]);
        let is_up = match formula.ties[self.end] {
            Tie::Down => false,
            Tie::Up => true,
            Tie::On => climbs,
            Tie::Back => !climbs,
            Tie::OnFromFirst => climbs == is_forward,
            Tie::BackFromFirst => climbs != is_forward,
        };
        let pixel = match (is_up, q.is_line()) {
            (true, true) => floor(value + 128 * den, 256 * den),
            (true, false) => floor(value - sample * den, 256 * den) + 1,
            (false, _) => -floor(sample * den - value, 256 * den),
        };
        let pixel = formula.group.map_or(pixel, |(pixels, toward)| {
            let pixels = i128::from(pixels);
            round(pixel, pixels, toward) * pixels
        });
        i64::try_from(pixel).ok()
    }

    /// The quantities of its edge, beside those of the pixel there.
    pub(super) fn quantities(&self, q: &AnyQuestion, out: &mut Quantities) {
        let edge = EDGES.iter().position(|points| *points == self.points);
        out.number(Unit::Count, edge.map_or(0, |i| i as i64 + 1), &["the number of its edge"]);
        let [from, to] = self.points;
        let is_long = !q.is_line() && ![from, to].contains(&q.by_height()[1]);
        out.flag(
            is_long,
            &["its edge joins the top and the bottom corner"],
            "its edge does not join the top and the bottom corner",
        );
        let sides = q.side_of(from, to);
        for axis in [0, 1] {
            let noun = ["d", AXES[axis], " of its edge in the order given"];
            out.number(Unit::Subpixels, sides[axis] * (256 / q.one()), &noun);
        }
    }

    /// A site of a question, whose quantities have the names of all.
    pub(super) fn sample() -> Self {
        Self { axis: 1, place: 0, end: 0, points: EDGES[0] }
    }

    /// What a picture has there: of a row of which no pixel is drawn, or which has a gap, nothing.
    pub(super) fn seen(&self, picture: &Picture, is_line: bool) -> Option<i64> {
        let [first, after] = span(picture, self.axis, self.place as i32)?;
        if is_line && after != first + 1 {
            return None;
        }
        Some(i64::from([first, after][self.end]))
    }

    /// A pixel beside it, of which facts are looked at.
    pub(super) fn pixel(&self, border: i64, picture: &Picture) -> [i32; 2] {
        let along = 1 - self.axis;
        let last = i64::from(picture.side[along] + MARGIN - 1);
        let at = (border - self.end as i64).clamp(i64::from(-MARGIN), last) as i32;
        let mut pixel = [self.place as i32; 2];
        pixel[along] = at;
        pixel
    }
}

/// The first pixel of a row or a column in the window, and the first after it.
fn span(picture: &Picture, axis: usize, place: i32) -> Option<[i32; 2]> {
    let at = |v: i32| if axis == 1 { [v, place] } else { [place, v] };
    let mut drawn = (0..picture.side[1 - axis]).filter(|v| picture.has(at(*v)));
    let first = drawn.next()?;
    let (mut after, mut count) = (first + 1, 1);
    for v in drawn {
        (after, count) = (v + 1, count + 1);
    }
    (after - first == count).then_some([first, after])
}

/// All borders of a question in its window and its margin, where the heights of the corners are rounded to whole pixels or not.
pub(super) fn sites(q: &AnyQuestion, sample: [i64; 2], heights: Option<Toward>) -> Vec<Site> {
    let q = with_heights(q, heights);
    let mut all = Vec::new();
    if q.is_line() {
        let [dx, dy] = q.side_of(0, 1).map(i64::abs);
        let axis = usize::from(dy > dx);
        let [least, most] = q.range(axis);
        let window = i64::from(q.side[axis] + MARGIN);
        for place in least.max(i64::from(-MARGIN))..=most.min(window - 1) {
            all.push(Site { axis, place, end: 0, points: [0, 1] });
        }
        return all;
    }
    let places = i64::from(-MARGIN)..i64::from(q.side[1] + MARGIN);
    all.extend(places.filter_map(|place| row_sites(&q, sample, place)).flatten());
    all
}

/// With the heights of its points rounded to whole pixels, or not.
pub(super) fn with_heights(q: &AnyQuestion, heights: Option<Toward>) -> AnyQuestion {
    let mut q = q.clone();
    if let Some(toward) = heights {
        for point in &mut q.points {
            point[1] = round(point[1].into(), 256, toward) as i64 * 256;
        }
    }
    q
}

/// The two borders of a row of a triangle, in the window or not; nothing where it has no samples between them.
fn row_sites(q: &AnyQuestion, sample: [i64; 2], place: i64) -> Option<[Site; 2]> {
    let at = place * 256 + sample[1];
    let mut crossed = EDGES.into_iter().filter(|edge| {
        let [a, b] = edge.map(|i| q.points[i][1] <= at);
        a != b
    });
    let mut site = || Some(Site { axis: 1, place, end: 0, points: crossed.next()? });
    let [mut a, mut b] = [site()?, site()?];
    if left_of(&b, &a, q, at) {
        std::mem::swap(&mut a, &mut b);
    }
    Some([a, Site { end: 1, ..b }])
}

/// The first pixel of a row of a triangle, in the window or not, and the first after it.
pub(super) fn row_ends(q: &AnyQuestion, sample: [i64; 2], place: i64) -> Option<[i64; 2]> {
    let [first, last] = row_sites(q, sample, place)?;
    let [first, end] = [first, last].map(|site| site.evaluate(&Crossing::RIGHT, q, sample));
    Some([first?, end?])
}

/// Whether one edge crosses a row left of another.
fn left_of(a: &Site, b: &Site, q: &AnyQuestion, at: i64) -> bool {
    let crossing = |site: &Site| {
        let [from, to] = site.points.map(|i| q.points[i].map(i128::from));
        let (rise, distance) = (to[1] - from[1], i128::from(at) - from[1]);
        let sign = rise.signum();
        (sign * (from[0] * rise + (to[0] - from[0]) * distance), sign * rise)
    };
    let ((x, by), (other, other_by)) = (crossing(a), crossing(b));
    x * other_by < other * by
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers of 64 bits and of more are rounded to the same.
    #[test]
    fn fractions_are_rounded_as_their_definitions_say() {
        for (num, den) in (-40..40).flat_map(|num| [1, 2, 3, 4, 7, 8].map(|den| (num, den))) {
            let exact = num as f64 / den as f64;
            for (toward, expected) in [
                (Toward::Down, exact.floor()),
                (Toward::Up, exact.ceil()),
                (Toward::Zero, exact.trunc()),
                (Toward::Nearest, (exact + 0.5).floor()),
                (Toward::NearestDown, (exact - 0.5).ceil()),
                (Toward::HalfAway, exact.round()),
                (Toward::HalfEven, exact.round_ties_even()),
            ] {
                for far in [1, 1 << 70] {
                    let rounded = round(num * far, den * far, toward);
                    assert_eq!(rounded, expected as i128, "{num}/{den} {toward:?} {far}");
                    assert_eq!(round(-num * far, -den * far, toward), rounded, "{num}/{den}");
                }
            }
        }
    }

    #[test]
    fn words_keep_their_last_bits() {
        for v in [-1 << 70, -300, -129, -128, -1, 0, 127, 128, 255, 256, (1 << 90) + 5] {
            let word = wrap(v, 8);
            assert!((-128..128).contains(&word) && (v - word) % 256 == 0, "{v} {word}");
        }
    }
}
