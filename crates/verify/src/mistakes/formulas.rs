//! Tests of a sample in floats: edge functions and barycentric weights by many formulas, rounded after every operation.
//!
//! All of these formulas are right in exact numbers. In floats each loses other bits: on an edge, where an edge function is exactly 0,
//! the weights may be 1/3, 2/3 and 0. In floats of 32 bits, 1 - 1/3 - 2/3 is -2^-24, so that a program that computes two weights and
//! takes the third one from 1 loses the sample. So the samples near edges that are drawn wrongly show which formula it is.

use super::fills::{Point, boxes, each_sample, points};
use super::format::rounded;
use crate::convention::{Mask, Ties, TriangleConvention, facing};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::Corners;

/// A point or a vector in pixels.
type Px = [f64; 2];

/// How a sample is tested. An edge runs from its first end to its second one.
#[derive(Clone, Copy)]
pub(super) enum Formula {
    /// The edge function from differences to the first end of the edge, as a difference of two products.
    FromFirstEnd,
    /// The same of coordinates that are not rounded before the differences are.
    FromExactCoordinates,
    /// The same with one of the products fused with the subtraction.
    Fused,
    /// The edge function from differences to the second end.
    FromSecondEnd,
    /// The edge function from differences to the sample.
    FromSample,
    /// The edge function as a x + b y + c.
    Line(Line),
    /// The edge function in steps from the first pixel of the window on, or of the box around the triangle.
    Stepped { from_box: bool },
    /// All three edge functions over the area, from differences to the sample or to the first end.
    ThreeWeights { from_sample: bool },
    /// Two of them, and the weight of the corner `rest` is what is left of 1.
    TwoWeights { from_sample: bool, is_reciprocal: bool, rest: usize },
    /// Two weights from differences to the corner `rest`.
    FromCorner { rest: usize, is_reciprocal: bool, third: Third },
    /// Two weights from dot products of the edges at the first corner.
    FromDots { is_reciprocal: bool, third: Third },
}

/// How a line is brought to a x + b y + c.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Line {
    /// c is computed once, from rounded a and b.
    Rounded,
    /// The same from the upper end of the edge, whatever its direction.
    FromUpperEnd,
    /// c is exact before it is rounded, as floats of 64 bits hold the products of coordinates.
    ExactC,
    /// a and b are divided by the length of the edge.
    Normalised,
}

/// What becomes of the weight that is not computed.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Third {
    /// The others are taken from 1 one after the other.
    Rest,
    /// The sum of the others may be 1 at most.
    AtMostOne,
    /// The sum of the others must be less than 1, and they may be 0: a rule for ties of its own.
    BelowOne,
}

/// What is said of each formula, after 'computes in floats of 32 bits'.
pub(super) const FORMULAS: [(&str, Formula); 35] = [
    ("the edge function as a difference of two products", Formula::FromFirstEnd),
    ("the edge function as a x + b y + c with c computed once", Formula::Line(Line::Rounded)),
    (
        "the edge function in steps that are added up pixel by pixel",
        Formula::Stepped { from_box: false },
    ),
    (
        "barycentric weights that are divided by the area first",
        Formula::ThreeWeights { from_sample: false },
    ),
    (
        "barycentric weights of which the third is 1 minus the others",
        Formula::TwoWeights { from_sample: false, is_reciprocal: false, rest: 2 },
    ),
    (
        "barycentric weights times the reciprocal of the area, the third being 1 minus the others",
        Formula::TwoWeights { from_sample: false, is_reciprocal: true, rest: 2 },
    ),
    ("the edge function with corners relative to the sample", Formula::FromSample),
    (
        "the products of the edge function, of differences that are exact",
        Formula::FromExactCoordinates,
    ),
    ("the edge function with a fused multiplication and addition", Formula::Fused),
    (
        "barycentric weights from corners relative to the sample, divided by the area first",
        Formula::ThreeWeights { from_sample: true },
    ),
    (
        "barycentric weights from corners relative to the sample, of which the third is 1 minus the others",
        Formula::TwoWeights { from_sample: true, is_reciprocal: false, rest: 2 },
    ),
    (
        "barycentric weights from differences to the first corner, whose weight is 1 minus the others",
        Formula::FromCorner { rest: 0, is_reciprocal: false, third: Third::Rest },
    ),
    (
        "barycentric weights from differences to the second corner, whose weight is 1 minus the others",
        Formula::FromCorner { rest: 1, is_reciprocal: false, third: Third::Rest },
    ),
    (
        "barycentric weights from differences to the last corner, whose weight is 1 minus the others",
        Formula::FromCorner { rest: 2, is_reciprocal: false, third: Third::Rest },
    ),
    (
        "barycentric weights from differences to the first corner, times the reciprocal of the area, its weight being 1 minus the others",
        Formula::FromCorner { rest: 0, is_reciprocal: true, third: Third::Rest },
    ),
    (
        "barycentric weights from differences to the last corner, times the reciprocal of the area, its weight being 1 minus the others",
        Formula::FromCorner { rest: 2, is_reciprocal: true, third: Third::Rest },
    ),
    (
        "barycentric weights from dot products of the edges, the first being 1 minus the others",
        Formula::FromDots { is_reciprocal: false, third: Third::Rest },
    ),
    (
        "barycentric weights from dot products of the edges and a reciprocal, the first being 1 minus the others",
        Formula::FromDots { is_reciprocal: true, third: Third::Rest },
    ),
    (
        "the edge function in steps that are added up from the first pixel of the box around the triangle on",
        Formula::Stepped { from_box: true },
    ),
    (
        "the edge function as a x + b y + c with c computed once, of each edge from its upper end",
        Formula::Line(Line::FromUpperEnd),
    ),
    ("the edge function with differences to the second end of each edge", Formula::FromSecondEnd),
    (
        "two barycentric weights from differences to the first corner, whose sum may be 1 at most",
        Formula::FromCorner { rest: 0, is_reciprocal: false, third: Third::AtMostOne },
    ),
    (
        "two barycentric weights from differences to the last corner, whose sum may be 1 at most",
        Formula::FromCorner { rest: 2, is_reciprocal: false, third: Third::AtMostOne },
    ),
    (
        "two barycentric weights from dot products of the edges, whose sum may be 1 at most",
        Formula::FromDots { is_reciprocal: false, third: Third::AtMostOne },
    ),
    (
        "the edge function as a x + b y + c with an exact c that is rounded once",
        Formula::Line(Line::ExactC),
    ),
    (
        "barycentric weights that are divided by the area, the first being 1 minus the others",
        Formula::TwoWeights { from_sample: false, is_reciprocal: false, rest: 0 },
    ),
    (
        "barycentric weights that are divided by the area, the second being 1 minus the others",
        Formula::TwoWeights { from_sample: false, is_reciprocal: false, rest: 1 },
    ),
    (
        "barycentric weights times the reciprocal of the area, the first being 1 minus the others",
        Formula::TwoWeights { from_sample: false, is_reciprocal: true, rest: 0 },
    ),
    (
        "barycentric weights times the reciprocal of the area, the second being 1 minus the others",
        Formula::TwoWeights { from_sample: false, is_reciprocal: true, rest: 1 },
    ),
    (
        "the edge function as a x + b y + c, where a and b are divided by the length of the edge",
        Formula::Line(Line::Normalised),
    ),
    (
        "two barycentric weights from dot products of the edges and a reciprocal, whose sum may be 1 at most",
        Formula::FromDots { is_reciprocal: true, third: Third::AtMostOne },
    ),
    (
        "two barycentric weights from differences to the first corner, of 0 at least, whose sum must be less than 1",
        Formula::FromCorner { rest: 0, is_reciprocal: false, third: Third::BelowOne },
    ),
    (
        "two barycentric weights from differences to the last corner, of 0 at least, whose sum must be less than 1",
        Formula::FromCorner { rest: 2, is_reciprocal: false, third: Third::BelowOne },
    ),
    (
        "two barycentric weights from dot products of the edges, of 0 at least, whose sum must be less than 1",
        Formula::FromDots { is_reciprocal: false, third: Third::BelowOne },
    ),
    (
        "two barycentric weights from dot products of the edges and a reciprocal, of 0 at least, whose sum must be less than 1",
        Formula::FromDots { is_reciprocal: true, third: Third::BelowOne },
    ),
];

impl Formula {
    /// The corner whose weight is left over, where ties follow from that weight and not from a convention.
    fn rest_with_own_rule(self) -> Option<usize> {
        match self {
            Self::FromCorner { rest, third: Third::BelowOne, .. } => Some(rest),
            Self::FromDots { third: Third::BelowOne, .. } => Some(0),
            _ => None,
        }
    }

    /// Whether its values are divided by the area: then they are positive inside, however the corners turn.
    fn has_weights(self) -> bool {
        matches!(
            self,
            Self::ThreeWeights { .. }
                | Self::TwoWeights { .. }
                | Self::FromCorner { .. }
                | Self::FromDots { .. }
        )
    }

    /// A point in pixels, rounded unless the formula takes differences before it rounds.
    fn px(self, floats: Floats, p: Point) -> Px {
        let [x, y] = [p[0] as f64 / 256.0, p[1] as f64 / 256.0];
        match self {
            Self::FromExactCoordinates | Self::Line(Line::ExactC) => [x, y],
            _ => [floats.round(x), floats.round(y)],
        }
    }
}

/// Arithmetic in floats of a precision (see [`rounded`]).
#[derive(Clone, Copy)]
struct Floats {
    precision: i64,
}

impl Floats {
    /// The nearest float; every operation below ends with it.
    fn round(self, v: f64) -> f64 {
        rounded(v, self.precision)
    }

    /// Each coordinate is rounded.
    fn minus(self, p: Px, q: Px) -> Px {
        [self.round(p[0] - q[0]), self.round(p[1] - q[1])]
    }

    /// Both products are rounded, and then their difference.
    fn cross(self, p: Px, q: Px) -> f64 {
        self.round(self.round(p[0] * q[1]) - self.round(p[1] * q[0]))
    }

    /// Both products are rounded, and then their sum.
    fn dot(self, p: Px, q: Px) -> f64 {
        self.round(self.round(p[0] * q[0]) + self.round(p[1] * q[1]))
    }

    /// The cross product with a fused multiplication: the first product is not rounded before the second is taken from it.
    fn fused_cross(self, p: Px, q: Px) -> f64 {
        let second = self.round(p[1] * q[0]);
        match self.precision {
            1 => p[0].mul_add(q[1], -second),
            // Products of two floats of 32 bits are exact in 64.
            _ => self.round(p[0] * q[1] - second),
        }
    }

    /// A quotient, or a product with the reciprocal that is rounded first.
    fn divided(self, v: f64, by: f64, is_reciprocal: bool) -> f64 {
        let quotient = if is_reciprocal { v * self.round(1.0 / by) } else { v / by };
        self.round(quotient)
    }
}

/// A triangle as a formula tests its samples. The edge number `i` begins at the corner with that number.
struct FloatTest {
    formula: Formula,
    floats: Floats,
    corners: [Px; 3],
    /// Twice the signed area, as it is computed.
    area: f64,
    /// What values are multiplied by, so that they are positive inside.
    sign: f64,
    /// Whether samples on an edge are drawn.
    owns: [bool; 3],
}

impl FloatTest {
    /// The ends of an edge.
    fn edge(&self, i: usize) -> [Px; 2] {
        [self.corners[i], self.corners[(i + 1) % 3]]
    }

    /// The edge function from differences to the first end of an edge.
    fn edge_from_first_end(&self, [p, q]: [Px; 2], at: Px) -> f64 {
        self.floats.cross(self.floats.minus(q, p), self.floats.minus(at, p))
    }

    /// The edge function from differences to the sample.
    fn edge_from_sample(&self, [p, q]: [Px; 2], at: Px) -> f64 {
        self.floats.cross(self.floats.minus(p, at), self.floats.minus(q, at))
    }

    /// The edge function as a x + b y + c.
    fn line(&self, kind: Line, [mut p, mut q]: [Px; 2], at: Px) -> f64 {
        let floats = self.floats;
        // An edge and its reverse then have the same numbers, but for their sign.
        let is_turned = kind == Line::FromUpperEnd && p[1] > q[1];
        if is_turned {
            (p, q) = (q, p);
        }
        // a and b: the vector at right angles to the edge.
        let mut normal = [floats.round(p[1] - q[1]), floats.round(q[0] - p[0])];
        // The value becomes a distance in pixels.
        if kind == Line::Normalised {
            let length = floats.round(floats.dot(normal, normal).sqrt());
            let part = floats.round(1.0 / length);
            normal = [floats.round(normal[0] * part), floats.round(normal[1] * part)];
        }
        let c = match kind {
            Line::ExactC => floats.round(p[0] * q[1] - p[1] * q[0]),
            _ => -floats.dot(normal, p),
        };
        let value = floats.round(floats.dot(normal, at) + c);
        if is_turned { -value } else { value }
    }

    /// The value of one edge by a formula that needs no other edge.
    fn value(&self, i: usize, at: Px) -> f64 {
        // What weights are made of: the edge function before it is divided.
        let edge @ [p, q] = self.edge(i);
        match self.formula {
            Formula::Line(kind) => self.line(kind, edge, at),
            Formula::Fused => {
                self.floats.fused_cross(self.floats.minus(q, p), self.floats.minus(at, p))
            }
            Formula::FromSecondEnd => -self.edge_from_first_end([q, p], at),
            Formula::FromSample
            | Formula::ThreeWeights { from_sample: true }
            | Formula::TwoWeights { from_sample: true, .. } => self.edge_from_sample(edge, at),
            _ => self.edge_from_first_end(edge, at),
        }
    }

    /// All edge functions at a point, or the weights of the corners opposite to the edges.
    fn values(&self, at: Px) -> [f64; 3] {
        let floats = self.floats;
        match self.formula {
            Formula::TwoWeights { is_reciprocal, rest, .. } => {
                let v = floats.divided(self.value((rest + 2) % 3, at), self.area, is_reciprocal);
                let w = floats.divided(self.value(rest, at), self.area, is_reciprocal);
                self.with_rest(rest, Third::Rest, v, w)
            }
            Formula::FromCorner { rest, is_reciprocal, third } => {
                // Everything relative to the corner whose weight is left over.
                let origin = self.corners[rest];
                let b = floats.minus(self.corners[(rest + 1) % 3], origin);
                let c = floats.minus(self.corners[(rest + 2) % 3], origin);
                let at = floats.minus(at, origin);
                let area = floats.cross(b, c);
                let v = floats.divided(floats.cross(at, c), area, is_reciprocal);
                let w = floats.divided(floats.cross(b, at), area, is_reciprocal);
                self.with_rest(rest, third, v, w)
            }
            Formula::FromDots { is_reciprocal, third } => {
                let [origin, b, c] = self.corners;
                let [b, c] = [floats.minus(b, origin), floats.minus(c, origin)];
                let at = floats.minus(at, origin);
                // Two equations for the two weights, solved by Cramer's rule.
                let (bb, bc, cc) = (floats.dot(b, b), floats.dot(b, c), floats.dot(c, c));
                let [ab, ac] = [floats.dot(at, b), floats.dot(at, c)];
                let whole = floats.cross([bb, bc], [bc, cc]);
                let v = floats.divided(floats.cross([cc, bc], [ac, ab]), whole, is_reciprocal);
                let w = floats.divided(floats.cross([bb, bc], [ab, ac]), whole, is_reciprocal);
                self.with_rest(0, third, v, w)
            }
            Formula::ThreeWeights { .. } => {
                let mut values = [0.0; 3];
                for (i, value) in values.iter_mut().enumerate() {
                    *value = floats.round(self.value(i, at) / self.area);
                }
                values
            }
            _ => [self.value(0, at), self.value(1, at), self.value(2, at)],
        }
    }

    /// The weights by edge, where `v` is that of the corner after `rest`, and `w` that of the one after this.
    fn with_rest(&self, rest: usize, third: Third, v: f64, w: f64) -> [f64; 3] {
        let floats = self.floats;
        let mut values = [w; 3];
        values[(rest + 1) % 3] = match third {
            Third::Rest => floats.round(floats.round(1.0 - v) - w),
            // A sum of at most 1 leaves 0 at least; the last step is not rounded, so it changes no sign.
            Third::AtMostOne | Third::BelowOne => 1.0 - floats.round(v + w),
        };
        values[(rest + 2) % 3] = v;
        values
    }

    /// Whether a sample with these values is drawn.
    fn passes(&self, values: [f64; 3]) -> bool {
        for (value, owns) in values.into_iter().zip(self.owns) {
            let is_inside = self.sign * value > 0.0 || (value == 0.0 && owns);
            if !is_inside {
                return false;
            }
        }
        true
    }

    /// Fills by edge functions that are computed at one sample; the others are reached by steps, which add up their errors.
    fn stepped(&self, [x0, y0]: [i32; 2], start: Px, window: PixelRect) -> Mask {
        let mut mask = Mask::default();
        // The values at the first sample of a row, and what a step along x and along y adds.
        let mut rows = [0.0; 3];
        let mut steps = [[0.0; 2]; 3];
        for i in 0..3 {
            let edge @ [p, q] = self.edge(i);
            rows[i] = self.edge_from_first_end(edge, start);
            steps[i] = [self.floats.round(p[1] - q[1]), self.floats.round(q[0] - p[0])];
        }
        for y in y0..window.y1 {
            let mut values = rows;
            for x in x0..window.x1 {
                if self.passes(values) {
                    mask.set(x, y);
                }
                for i in 0..3 {
                    values[i] = self.floats.round(values[i] + steps[i][0]);
                }
            }
            for i in 0..3 {
                rows[i] = self.floats.round(rows[i] + steps[i][1]);
            }
        }
        mask
    }
}

/// What one of `FORMULAS` draws, rounded after every operation. Where corners turn the other way, two of them are exchanged, or the
/// sign of every value is.
pub(super) fn by_formula(
    corners: &Corners,
    window: PixelRect,
    base: &TriangleConvention,
    number: usize,
    exchanges: bool,
    precision: i64,
) -> Mask {
    let (formula, floats) = (FORMULAS[number].1, Floats { precision });
    let own_rule = formula.rest_with_own_rule();
    let turns = twice_area(corners).signum();
    // Where the rule is its own, one base is enough: no other one predicts anything else.
    if turns == 0 || (own_rule.is_some() && Some(base.ties) != Ties::named("top-left")) {
        return Mask::default();
    }
    let mut ordered = points(corners);
    let mut sign = 1;
    if turns < 0 && exchanges {
        ordered.swap(1, 2);
    } else if turns < 0 {
        sign = -1;
    }
    // Which edges have the samples that lie on them.
    let mut owns = [false; 3];
    for (i, owns) in owns.iter_mut().enumerate() {
        let [p, q] = [ordered[i], ordered[(i + 1) % 3]];
        *owns = match own_rule {
            // The edge opposite to the corner whose weight is left over loses its samples.
            Some(rest) => i != (rest + 1) % 3,
            None => base.ties.edges[facing(sign * (p[1] - q[1]), sign * (q[0] - p[0]))],
        };
    }
    // The corners in pixels, as the formula takes them.
    let mut px = [[0.0; 2]; 3];
    for (px, p) in px.iter_mut().zip(ordered) {
        *px = formula.px(floats, p);
    }
    let mut test = FloatTest { formula, floats, corners: px, area: 0.0, sign: sign as f64, owns };
    test.area = test.edge_from_first_end(test.edge(0), px[2]);
    // A quotient of two numbers of one sign is positive.
    if formula.has_weights() {
        test.sign = 1.0;
    }
    let sample = super::sample_of(base);
    let Formula::Stepped { from_box } = formula else {
        return each_sample(window, sample, &|at| test.passes(test.values(formula.px(floats, at))));
    };
    // Stepping begins at the window, or at the box around the triangle.
    let mut first = [0, 0];
    if from_box {
        let [[x0, _], [y0, _]] = boxes(corners)[0];
        first = [x0.clamp(0, window.x1.into()) as i32, y0.clamp(0, window.y1.into()) as i32];
    }
    let start = [i64::from(first[0] * 256 + sample[0]), i64::from(first[1] * 256 + sample[1])];
    test.stepped(first, formula.px(floats, start), window)
}

/// Whether the areas that the sample makes with the sides add up to the whole, in floats: p mod 2 is the precision, p / 2 mod 2 is
/// whether areas are halved, and the sum may be off by `most`.
pub(super) fn by_areas(
    corners: &Corners,
    window: PixelRect,
    base: &TriangleConvention,
    most: f64,
    p: i64,
) -> Mask {
    let floats = Floats { precision: p % 2 };
    let [a, b, c] = points(corners).map_array(|point| Formula::FromFirstEnd.px(floats, point));
    // Halves are exact, so that they change what `most` means and no rounding.
    let part = if p / 2 % 2 == 0 { 1.0 } else { 0.5 };
    let area =
        |p: Px, q: Px, at: Px| floats.cross(floats.minus(p, at), floats.minus(q, at)).abs() * part;
    let whole = area(b, c, a);
    each_sample(window, super::sample_of(base), &|at| {
        let at = at.map_array(|v| v as f64 / 256.0);
        let two = floats.round(area(a, b, at) + area(b, c, at));
        let sum = floats.round(two + area(c, a, at));
        whole > 0.0 && floats.round(sum - whole).abs() <= most
    })
}
