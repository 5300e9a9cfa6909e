//! What a rasterizer promises where that differs from samples at centres, the top-left rule and either winding; and the
//! exact picture that follows.
//!
//! The four half-open rules are the oracle's top-left rule in a mirror: a triangle and its samples
//! mirrored left to right are drawn by the top-right rule exactly where the top-left rule draws the
//! mirror image. Another sample point is the triangle moved the other way. Which samples lie strictly
//! inside, and which inside or on the edge, is decided by the signs of three edge functions in wide
//! integers, here and in no engine.

use std::fmt;

use crate::cases::{Case, Family, Limits, Shape};
use crate::oracle::{Oracle, wide};
use rasterproof_core::contract::Rasterize;
use rasterproof_core::geometry::{centre_of, pixel_box, twice_area};
use rasterproof_core::grid::{HALF_PIXEL, PixelRect, SUBPIXEL_BITS, SUBPIXELS, SubpixelPoint};
use rasterproof_core::triangle::{Corners, Span, WideForm, WideLine};

/// Which samples exactly on an edge belong to a triangle, seen with the rasterizer's own y axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// Those on top and left edges, as Direct3D prescribes.
    TopLeft,
    /// Those on top and right edges.
    TopRight,
    /// Those on bottom and left edges.
    BottomLeft,
    /// Those on bottom and right edges.
    BottomRight,
    /// All: pixels of a shared edge are drawn twice.
    Inclusive,
    /// None: shared edges have holes.
    Strict,
    /// Nothing is promised: such a sample may be drawn or not.
    Unspecified,
}

impl Rule {
    /// Every rule, with its word in the line protocol.
    pub const ALL: [(&'static str, Self); 7] = [
        ("top-left", Self::TopLeft),
        ("top-right", Self::TopRight),
        ("bottom-left", Self::BottomLeft),
        ("bottom-right", Self::BottomRight),
        ("inclusive", Self::Inclusive),
        ("strict", Self::Strict),
        ("none", Self::Unspecified),
    ];

    /// The word of the line protocol.
    #[must_use]
    pub fn word(self) -> &'static str {
        Self::ALL.iter().find(|(_, rule)| *rule == self).map_or("", |(word, _)| word)
    }

    /// Whether a sample on an edge belongs to a shape that ends there in this direction, in a picture whose rows count from the
    /// top. Where nothing is promised, it may.
    #[doc(hidden)]
    #[must_use]
    pub fn owns(self, [x, y]: [i64; 2]) -> bool {
        match self {
            Self::TopLeft => x < 0 || (x == 0 && y < 0),
            Self::TopRight => x > 0 || (x == 0 && y < 0),
            Self::BottomLeft => x < 0 || (x == 0 && y > 0),
            Self::BottomRight => x > 0 || (x == 0 && y > 0),
            Self::Inclusive | Self::Unspecified => true,
            Self::Strict => false,
        }
    }
}

/// Which triangles are drawn at all, seen with the rasterizer's own y axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Winding {
    /// Clockwise alone.
    Clockwise,
    /// Counter-clockwise alone.
    CounterClockwise,
    /// Either.
    Both,
}

impl Winding {
    /// The word of the line protocol.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Clockwise => "cw",
            Self::CounterClockwise => "ccw",
            Self::Both => "both",
        }
    }
}

/// What a rasterizer promises. The default is what [`Rasterize`] asks for.
///
/// ```
/// use rasterproof_verify::comparison::{Convention, Options, Rule};
/// // A rasterizer that samples at the upper left corner of each pixel, with a bottom-left rule.
/// let its_own = Convention::default().sample(0, 0).rule(Rule::BottomLeft);
/// let options = Options::default().convention(its_own);
/// # let _ = options;
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Convention {
    /// Which samples on an edge belong.
    pub rule: Rule,
    /// Which triangles are drawn.
    pub winding: Winding,
    /// Where in a pixel the sample lies, in 1/256 px from the pixel's upper left corner.
    pub sample: [i32; 2],
    /// Whether its own y axis points up.
    pub y_up: bool,
    /// Coordinates are multiples of 2 to the power of minus this, in pixels.
    pub subpixel_bits: u32,
}

impl Default for Convention {
    fn default() -> Self {
        Self {
            rule: Rule::TopLeft,
            winding: Winding::Both,
            sample: [HALF_PIXEL; 2],
            y_up: false,
            subpixel_bits: SUBPIXEL_BITS,
        }
    }
}

impl Convention {
    /// The same with another fill rule.
    #[must_use]
    pub fn rule(self, rule: Rule) -> Self {
        Self { rule, ..self }
    }

    /// The same where only triangles of this winding are drawn.
    #[must_use]
    pub fn winding(self, winding: Winding) -> Self {
        Self { winding, ..self }
    }

    /// The same with the sample at another place of the pixel, in 1/256 px from its upper left corner; the centre is
    /// (128, 128).
    #[must_use]
    pub fn sample(self, x: i32, y: i32) -> Self {
        Self { sample: [x, y], ..self }
    }

    /// The same for a rasterizer whose origin is the lower left corner, so that its y axis points up. It gets the same
    /// numbers and emits the same rows; top and bottom, and the two windings, change places in what it declares.
    #[must_use]
    pub fn y_up(self) -> Self {
        Self { y_up: true, ..self }
    }

    /// The same with a coarser grid of corners, from whole pixels (0) to the 1/256 px of this crate (8).
    #[must_use]
    pub fn subpixel_bits(self, subpixel_bits: u32) -> Self {
        Self { subpixel_bits, ..self }
    }

    /// Why no rasterizer can be judged by it, with the remedy.
    pub(super) fn nonsense(&self) -> Option<String> {
        if self.subpixel_bits > SUBPIXEL_BITS {
            let bits = self.subpixel_bits;
            return Some(format!("subpixel_bits is {bits}; expected 0 to {SUBPIXEL_BITS}"));
        }
        let [x, y] = self.sample;
        let is_inside = |v: i32| (0..=SUBPIXELS).contains(&v);
        (!is_inside(x) || !is_inside(y))
            .then(|| format!("sample is ({x}, {y}); expected 0 to {SUBPIXELS}, in 1/256 px"))
    }

    /// The rule as it is seen in a picture whose rows count from the top.
    #[must_use]
    pub fn seen_rule(&self) -> Rule {
        match (self.y_up, self.rule) {
            (true, Rule::TopLeft) => Rule::BottomLeft,
            (true, Rule::TopRight) => Rule::BottomRight,
            (true, Rule::BottomLeft) => Rule::TopLeft,
            (true, Rule::BottomRight) => Rule::TopRight,
            (_, rule) => rule,
        }
    }

    /// The winding as it is seen in a picture whose rows count from the top.
    #[must_use]
    pub fn seen_winding(&self) -> Winding {
        match (self.y_up, self.winding) {
            (true, Winding::Clockwise) => Winding::CounterClockwise,
            (true, Winding::CounterClockwise) => Winding::Clockwise,
            (_, winding) => winding,
        }
    }

    /// Whether samples at centres and the top-left rule are meant.
    #[must_use]
    pub fn is_standard(&self) -> bool {
        self.sample == [HALF_PIXEL; 2] && self.seen_rule() == Rule::TopLeft
    }

    /// Whether a triangle of this area is drawn at all; nothing of a degenerate one is.
    #[must_use]
    pub fn draws(&self, area: i128) -> bool {
        match self.seen_winding() {
            Winding::Clockwise => area > 0,
            Winding::CounterClockwise => area < 0,
            Winding::Both => true,
        }
    }

    /// The triangle moved so that its samples lie at the centres.
    #[must_use]
    pub fn centred(&self, corners: &Corners) -> Corners {
        let [x, y] = self.sample.map(|sample| HALF_PIXEL - sample);
        corners.map(|p| SubpixelPoint::new(p.x.saturating_add(x), p.y.saturating_add(y)))
    }

    /// What has to be drawn of a triangle, and what may be.
    #[must_use]
    pub fn expected(&self, corners: &Corners, window: PixelRect) -> Expectation {
        let area = twice_area(corners);
        let rule = self.seen_rule();
        if !self.draws(area) {
            return Expectation::default();
        }
        let corners = self.centred(corners);
        let half_open = |x, y| Expectation { must: mirrored(&corners, window, x, y), may: None };
        match rule {
            // Whoever draws all samples on edges may draw those of a triangle that is nothing but edges.
            Rule::Inclusive | Rule::Unspecified if area == 0 => {
                Expectation { must: Vec::new(), may: Some(by_edges(&corners, window, true)) }
            }
            _ if area == 0 => Expectation::default(),
            Rule::TopLeft => half_open(false, false),
            Rule::TopRight => half_open(true, false),
            Rule::BottomLeft => half_open(false, true),
            Rule::BottomRight => half_open(true, true),
            Rule::Strict => Expectation { must: by_edges(&corners, window, false), may: None },
            Rule::Inclusive => Expectation { must: by_edges(&corners, window, true), may: None },
            Rule::Unspecified => {
                let may = by_edges(&corners, window, true);
                Expectation { must: by_edges(&corners, window, false), may: Some(may) }
            }
        }
    }

    /// The rule of samples that have to be drawn, and that of those that may be.
    #[doc(hidden)]
    #[must_use]
    pub fn of_border(&self) -> [Rule; 2] {
        let rule = self.seen_rule();
        [if rule == Rule::Unspecified { Rule::Strict } else { rule }, rule]
    }

    /// Whether a pixel has to be drawn of a line with a width, and whether it may be.
    #[doc(hidden)]
    #[must_use]
    pub fn expected_of_wide(&self, line: &WideLine, form: WideForm, at: [i32; 2]) -> [bool; 2] {
        let sample = [0, 1]
            .map(|k: usize| i64::from(at[k]) * i64::from(SUBPIXELS) + i64::from(self.sample[k]));
        self.of_border().map(|rule| wide::covers(line, form, sample, &|out| rule.owns(out)))
    }

    /// What such a rasterizer can be asked whose coordinates lie in [-range, range] px, or in the domain: with room at its ends
    /// for a mirror image where one is needed to know the truth.
    #[doc(hidden)]
    #[must_use]
    pub fn limits(&self, range_px: Option<i32>) -> Limits {
        let step = 1 << SUBPIXEL_BITS.saturating_sub(self.subpixel_bits);
        let room = if self.is_standard() { 0 } else { 1 << 23 };
        let (least, most) = (i64::from(i32::MIN) + room, i64::from(i32::MAX) - room);
        let range = range_px.map_or(i64::MAX, |px| i64::from(px) * i64::from(SUBPIXELS));
        Limits {
            sample: self.sample,
            step,
            least: -(-least.max(-range)).div_euclid(step) * step,
            most: most.min(range).div_euclid(step) * step,
            ..Limits::default()
        }
    }

    /// A case of a family, put where the rasterizer draws.
    pub(super) fn case(&self, family: &Family, seed: u64, index: u64) -> Case {
        let mut case = family.case_within(seed, index, &self.limits(None));
        // Rounding may have folded a mesh, and some rules draw pixels twice.
        let is_folded = *self != Self::default();
        if let Shape::Triangles { disjoint, .. } = &mut case.shape {
            *disjoint &= !is_folded;
        }
        case
    }

    /// Whether a case, shrunk perhaps, lies where the rasterizer draws.
    pub(super) fn holds(&self, case: &Case) -> bool {
        match &case.shape {
            Shape::Triangles { list, .. } => self.limits(None).takes(list),
            _ => true,
        }
    }
}

impl fmt::Display for Convention {
    /// As an expression of Rust.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (Self { rule, winding, sample: [x, y], .. }, default) = (self, Self::default());
        f.write_str("Convention::default()")?;
        if *rule != default.rule {
            write!(f, ".rule(Rule::{rule:?})")?;
        }
        if *winding != default.winding {
            write!(f, ".winding(Winding::{winding:?})")?;
        }
        if self.sample != default.sample {
            write!(f, ".sample({x}, {y})")?;
        }
        if self.y_up {
            f.write_str(".y_up()")?;
        }
        if self.subpixel_bits != default.subpixel_bits {
            write!(f, ".subpixel_bits({})", self.subpixel_bits)?;
        }
        Ok(())
    }
}

impl Rasterize for Convention {
    /// What has to be drawn.
    fn cover(&self, corners: Corners, bounds: PixelRect, mut emit: impl FnMut(Span)) {
        if self.is_standard() && self.winding == Winding::Both {
            Oracle.spans(corners, bounds, &mut emit);
        } else {
            self.expected(&corners, bounds).must.into_iter().for_each(emit);
        }
    }
}

/// The picture that is expected: every pixel of `must`, no pixel outside `may`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Expectation {
    /// Runs of pixels that have to be hit once.
    pub must: Vec<Span>,
    /// Runs of pixels that may be hit once, where they are more than those of `must`.
    pub may: Option<Vec<Span>>,
}

/// What the oracle draws of the mirror image, mirrored back.
fn mirrored(corners: &Corners, window: PixelRect, in_x: bool, in_y: bool) -> Vec<Span> {
    // About the middle of the window, so that it is its own image.
    let flip = |sub: i32, first: i32, end: i32| {
        let image = (i64::from(first) + i64::from(end)) * i64::from(SUBPIXELS) - i64::from(sub);
        image.clamp(i32::MIN.into(), i32::MAX.into()) as i32
    };
    let image = corners.map(|p| {
        let x = if in_x { flip(p.x, window.x0, window.x1) } else { p.x };
        SubpixelPoint::new(x, if in_y { flip(p.y, window.y0, window.y1) } else { p.y })
    });
    let mut runs = Vec::new();
    Oracle.spans(image, window, &mut |span| {
        let x = |px: i32| window.x0 + (window.x1 - px);
        let (x0_px, x1_px) =
            if in_x { (x(span.x1_px), x(span.x0_px)) } else { (span.x0_px, span.x1_px) };
        let y_px = if in_y { window.y0 + (window.y1 - 1 - span.y_px) } else { span.y_px };
        runs.push(Span { y_px, x0_px, x1_px });
    });
    if in_y {
        runs.reverse();
    }
    runs
}

/// Pixels whose centres lie inside, or with `closed` also on the boundary.
fn by_edges(corners: &Corners, window: PixelRect, closed: bool) -> Vec<Span> {
    let [a, mut b, mut c] = *corners;
    if twice_area(corners) < 0 {
        (b, c) = (c, b);
    }
    let least = i128::from(!closed);
    let range = |v: [i32; 3]| {
        let [a, b, c] = v;
        a.min(b).min(c)..=a.max(b).max(c)
    };
    let (columns, rows) = (range([a.x, b.x, c.x]), range([a.y, b.y, c.y]));
    let rect = pixel_box(corners, 0).intersect(&window);
    let mut runs: Vec<Span> = Vec::new();
    for y_px in rect.y0..rect.y1 {
        for x_px in rect.x0..rect.x1 {
            let p = centre_of(x_px, y_px);
            // The box matters where there is no area: then the edges are one line without ends.
            let is_in_box = columns.contains(&p.x) && rows.contains(&p.y);
            if is_in_box
                && twice_area(&[a, b, p]) >= least
                && twice_area(&[b, c, p]) >= least
                && twice_area(&[c, a, p]) >= least
            {
                match runs.last_mut() {
                    Some(run) if run.y_px == y_px && run.x1_px == x_px => run.x1_px += 1,
                    _ => runs.push(Span { y_px, x0_px: x_px, x1_px: x_px + 1 }),
                }
            }
        }
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases;

    const WINDOW: PixelRect = PixelRect::window(8, 8);

    fn px(points: [(f64, f64); 3]) -> Corners {
        points.map(|(x, y)| SubpixelPoint::from_px(x, y).unwrap())
    }

    fn by(rule: Rule) -> Convention {
        Convention::default().rule(rule)
    }

    fn pixels(runs: &[Span]) -> Vec<(i32, i32)> {
        runs.iter().flat_map(|r| (r.x0_px..r.x1_px).map(|x| (x, r.y_px))).collect()
    }

    fn drawn(convention: Convention, corners: &Corners) -> Vec<(i32, i32)> {
        pixels(&convention.expected(corners, WINDOW).must)
    }

    /// The triangle (0.5, 0.5) (2.5, 0.5) (0.5, 2.5) has one sample of its own at no corner and on
    /// no edge: none. Three are corners, (1.5, 0.5) lies on the top edge, (0.5, 1.5) on the left one,
    /// (1.5, 1.5) on the slope, which is a right edge. Worked out on paper.
    #[test]
    fn rules_by_hand() {
        let triangle = px([(0.5, 0.5), (2.5, 0.5), (0.5, 2.5)]);
        let expected: [(Rule, &[(i32, i32)]); 6] = [
            (Rule::TopLeft, &[(0, 0), (1, 0), (0, 1)]),
            (Rule::TopRight, &[(1, 0), (2, 0), (1, 1)]),
            (Rule::BottomLeft, &[(0, 1)]),
            (Rule::BottomRight, &[(1, 1)]),
            (Rule::Strict, &[]),
            (Rule::Inclusive, &[(0, 0), (1, 0), (2, 0), (0, 1), (1, 1), (0, 2)]),
        ];
        for (rule, pixels) in expected {
            let mut pixels = pixels.to_vec();
            pixels.sort_by_key(|(x, y)| (*y, *x));
            assert_eq!(drawn(by(rule), &triangle), pixels, "{rule:?}");
        }
        // Seen from below, the top-left rule is the bottom-left one.
        assert_eq!(drawn(by(Rule::TopLeft).y_up(), &triangle), [(0, 1)]);
        let open = by(Rule::Unspecified).expected(&triangle, WINDOW);
        assert!(open.must.is_empty() && pixels(&open.may.unwrap()).len() == 6);
    }

    #[test]
    fn sample_and_winding_by_hand() {
        // The same triangle with its corners on whole pixels, sampled there.
        let whole = px([(0.0, 0.0), (2.0, 0.0), (0.0, 2.0)]);
        let at_corner = Convention::default().sample(0, 0);
        assert_eq!(drawn(at_corner, &whole), [(0, 0), (1, 0), (0, 1)]);
        let clockwise = at_corner.winding(Winding::Clockwise);
        assert_eq!(drawn(clockwise, &whole).len(), 3);
        let [a, b, c] = whole;
        assert_eq!(drawn(clockwise, &[a, c, b]).len(), 0);
        // Seen from below it runs clockwise, and its left edge is the only one that keeps its samples.
        assert_eq!(drawn(clockwise.y_up(), &[a, c, b]), [(0, 1)]);
        let flat = px([(0.5, 0.5), (2.5, 2.5), (5.5, 5.5)]);
        assert_eq!(drawn(by(Rule::Strict), &flat), []);
        // All that a triangle without area may leave are the samples between its outer corners.
        let flat = by(Rule::Inclusive).expected(&flat, WINDOW);
        assert_eq!((flat.must.len(), pixels(&flat.may.unwrap()).len()), (0, 6));
    }

    /// Strictly inside is what opposite half-open rules agree on; what any of them draws is closed.
    #[test]
    fn rules_agree_with_each_other() {
        let families = ["half-integer", "near-tie", "sliver", "partly-off", "huge", "far"];
        let mut on_edges = 0;
        for family in cases::families().filter(|f| families.contains(&f.name)) {
            for index in 0..40 {
                let case = by(Rule::TopRight).case(family, 3, index);
                let Shape::Triangles { list, .. } = case.shape else { continue };
                let corners = list[0].corners();
                if twice_area(&corners) == 0 {
                    continue;
                }
                let sorted = |rule: Rule| pixels(&by(rule).expected(&corners, case.window).must);
                let (tl, br) = (sorted(Rule::TopLeft), sorted(Rule::BottomRight));
                let (tr, bl) = (sorted(Rule::TopRight), sorted(Rule::BottomLeft));
                let (strict, closed) = (sorted(Rule::Strict), sorted(Rule::Inclusive));
                let both = |p: &&(i32, i32)| br.contains(p);
                assert_eq!(strict, tl.iter().filter(both).copied().collect::<Vec<_>>());
                for rule in [&tl, &br, &tr, &bl] {
                    assert!(rule.iter().all(|p| closed.contains(p)));
                    assert!(strict.iter().all(|p| rule.contains(p)));
                }
                on_edges += closed.len() - strict.len();
            }
        }
        assert!(on_edges > 100, "{on_edges}");
    }

    /// Corners on centres come to lie on the sample, so that ties stay ties.
    #[test]
    fn cases_lie_where_they_are_declared() {
        for convention in [
            Convention::default(),
            Convention::default().subpixel_bits(0).sample(0, 0),
            Convention::default().subpixel_bits(4).rule(Rule::BottomRight),
            Convention::default().sample(224, 0).subpixel_bits(6),
        ] {
            for family in cases::families() {
                for index in 0..30 {
                    let case = convention.case(family, 1, index);
                    assert!(convention.holds(&case), "{convention}: {}#{index}", family.name);
                }
            }
        }
        let family = cases::families().find(|f| f.name == "half-integer").unwrap();
        let at_corner = Convention::default().sample(0, 0).subpixel_bits(0);
        let corner = |case: Case| match case.shape {
            Shape::Triangles { list, .. } => list[0].corners()[0],
            _ => unreachable!("a family of triangles"),
        };
        let (before, after) = (corner(family.case(1, 5)), corner(at_corner.case(family, 1, 5)));
        assert_eq!((after.x, after.y), (before.x - 128, before.y - 128));
        let unmoved = Convention::default().case(family, 1, 5);
        assert_eq!(unmoved, family.case(1, 5));
    }
}
