//! Pixels decided by the three edges of a triangle: what a program computes of a sample and an edge is a product, and each
//! part of it has a format.

use super::border::{Toward, add_changed, float, round, wrap};
use super::picture::Picture;
use super::quantity::ORDINALS;
use super::question::AnyQuestion;
use crate::convention::facing;

/// How a sample is held against the edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    /// The product of an edge with the way to the sample from its first end or from its second.
    FromEnd(usize),
    /// a x + b y + c, where the products of the ends in c cancel.
    Plane,
    /// The same, added up pixel by pixel from the first one of the box.
    Stepped,
    /// Products over twice the area, where the one of an edge is what the two others leave of 1.
    Weights(usize),
    /// Weights of the second and third corner by dot products, and what they leave of 1.
    Dots,
    /// The areas of three triangles with the sample in it, compared with the whole.
    Areas,
}

/// Where a number is too large for its word, of so many bits: differences in 1/256 px, the others in 1/65536 px².
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Word {
    Differences(u32),
    Products(u32),
    Sums(u32),
}

/// So many bits that are lost of products in 1/65536 px², or of their difference.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cut {
    Products(u32, Toward),
    Sums(u32, Toward),
}

impl Form {
    /// After 'as if'; nothing of the usual form in whole numbers, where the end makes no difference.
    fn words(self, is_float: bool) -> Option<&'static str> {
        Some(match self {
            Self::FromEnd(0) if !is_float => return None,
            Self::FromEnd(0) => {
                "a pixel were tested by the cross product of each edge with the way from its first end"
            }
            Self::FromEnd(_) => {
                "a pixel were tested by the cross product of each edge with the way from its second end"
            }
            Self::Plane => "a pixel were tested by a x + b y + c of each edge",
            Self::Stepped => {
                "a pixel were tested by edge functions that are added up from the first pixel of the box"
            }
            Self::Weights(_) => {
                "a pixel were tested by two weights (products over the area) and what they leave of 1"
            }
            Self::Dots => "a pixel were tested by weights from dot products",
            Self::Areas => {
                "a pixel were tested by the areas of the three triangles that it makes with the corners, compared with the whole"
            }
        })
    }
}

/// So many bits of 1/65536 px².
fn area(bits: u32) -> String {
    format!("{} px²", f64::from(2).powi(bits as i32 - 16))
}

impl Word {
    fn words(self) -> String {
        let (what, most) = match self {
            Self::Differences(bits) => {
                let most = f64::from(2).powi(bits as i32 - 9);
                return format!(
                    "differences of coordinates were in words from -{most} to {most} px"
                );
            }
            Self::Products(bits) => ("products of coordinates", area(bits - 1)),
            Self::Sums(bits) => ("edge functions", area(bits - 1)),
        };
        format!("{what} were in words from -{most} to {most}")
    }
}

impl Cut {
    fn words(self) -> String {
        let (what, bits, way, when) = match self {
            Self::Products(bits, way) => ("products of coordinates", bits, way, ""),
            Self::Sums(bits, way) => ("edge functions", bits, way, ", before the fill rule"),
        };
        format!("{what} were rounded {}, to multiples of {}{when}", way.words(), area(bits))
    }
}

/// How a program decides whether a sample is inside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct EdgeTest {
    pub(super) form: Form,
    /// All numbers are floats of so many bits, and lengths are in px.
    pub(super) float: Option<u32>,
    pub(super) word: Option<Word>,
    pub(super) cut: Option<Cut>,
    /// The rule for samples exactly on an edge, by its number.
    pub(super) ties: usize,
    /// An edge whose samples exactly on it are decided the other way, in the order given.
    pub(super) odd_tie: Option<usize>,
    /// How far below 0 a number may be, in px², or in parts of 1 where the form has weights.
    pub(super) slack: f64,
    /// An edge that is not looked at, in the order given.
    pub(super) untested: Option<usize>,
    /// The corners that change places where they run counterclockwise.
    pub(super) exchanges: Option<[usize; 2]>,
    /// Whether the winding is that of an area computed in the same way.
    pub(super) turns_by_area: bool,
    /// Whether pixels beyond the box of the corners are looked at.
    pub(super) looks_beyond: bool,
}

/// What is computed once of a triangle, for all of its samples.
#[derive(Clone, Copy)]
pub(super) struct Numbers<'a> {
    test: &'a EdgeTest,
    /// The corners in 1/256 px, exchanged where the test exchanges them.
    corners: [[i64; 2]; 3],
    /// 1 where the corners run clockwise with y down, or -1.
    turn: i64,
    /// The first and the last column of the box of the corners, and its rows likewise.
    bounds: [[i64; 2]; 2],
}

/// Coordinates beyond this are drawn as if they were there: products of all others fit into 62 bits.
const FARTHEST: i64 = 1 << 29;

impl EdgeTest {
    pub(super) const RIGHT: Self = Self {
        form: Form::FromEnd(0),
        float: None,
        word: None,
        cut: None,
        ties: 0,
        odd_tie: None,
        slack: 0.0,
        untested: None,
        exchanges: None,
        turns_by_area: false,
        looks_beyond: false,
    };

    /// Fields that are not as in the right test. Which corners change places shows only where something else is wrong, and is no
    /// change by itself.
    pub(super) fn changes(&self) -> usize {
        let right = Self::RIGHT;
        [
            self.form != right.form && (self.float.is_none() || self.form == Form::Areas),
            self.float.is_some(),
            self.word.is_some(),
            self.cut.is_some(),
            self.ties != right.ties,
            self.odd_tie.is_some(),
            self.slack != right.slack,
            self.untested.is_some(),
            self.turns_by_area,
            self.looks_beyond,
        ]
        .into_iter()
        .filter(|is_changed| *is_changed)
        .count()
    }

    /// All tests with one other field, of so many rules for ties.
    pub(super) fn variants(&self, rules: usize) -> Vec<Self> {
        let mut all = Vec::new();
        let mut with = |change: &dyn Fn(&mut Self)| add_changed(&mut all, self, change);
        let mut forms = vec![Form::FromEnd(0), Form::FromEnd(1), Form::Plane, Form::Areas];
        // What is added up or divided is the same in whole numbers.
        for form in &forms {
            with(&|t| (t.form, t.float) = (*form, None));
        }
        forms.extend([Form::Stepped, Form::Dots]);
        forms.extend([0, 1, 2].map(Form::Weights));
        for form in forms {
            for bits in [24, 53] {
                with(&|t| (t.form, t.float, t.word, t.cut) = (form, Some(bits), None, None));
            }
        }
        with(&|t| t.word = None);
        with(&|t| t.cut = None);
        for bits in 11..=24 {
            with(&|t| (t.float, t.word) = (None, Some(Word::Differences(bits))));
        }
        for bits in 20..=50 {
            with(&|t| (t.float, t.word) = (None, Some(Word::Products(bits))));
            with(&|t| (t.float, t.word) = (None, Some(Word::Sums(bits))));
        }
        for bits in 1..=18 {
            for toward in [Toward::Down, Toward::Zero, Toward::Nearest] {
                with(&|t| (t.float, t.cut) = (None, Some(Cut::Products(bits, toward))));
                with(&|t| (t.float, t.cut) = (None, Some(Cut::Sums(bits, toward))));
            }
        }
        for rule in 0..rules {
            with(&|t| t.ties = rule);
        }
        with(&|t| t.slack = 0.0);
        let powers = (-16..=2).map(|power| f64::from(2).powi(power));
        let decimals = (1..=9).map(|power| f64::from(10).powi(-power));
        for slack in powers.chain(decimals).flat_map(|v| [v, -v]) {
            with(&|t| t.slack = slack);
        }
        for edge in [None, Some(0), Some(1), Some(2)] {
            with(&|t| t.untested = edge);
            with(&|t| t.odd_tie = edge);
        }
        for pair in [None, Some([1, 2]), Some([0, 2]), Some([0, 1])] {
            with(&|t| t.exchanges = pair);
        }
        with(&|t| t.turns_by_area = !t.turns_by_area);
        with(&|t| t.looks_beyond = !t.looks_beyond);
        all
    }

    /// What is not as it should be, after 'as if'.
    pub(super) fn words(&self, rules: &[String]) -> Vec<String> {
        let mut said = Vec::new();
        said.extend(self.form.words(self.float.is_some()).map(str::to_owned));
        said.extend(self.float.map(|bits| format!("its numbers were floats of {bits} bits")));
        said.extend(self.word.map(Word::words));
        said.extend(self.cut.map(Cut::words));
        if self.ties > 0 {
            said.push(format!("a sample on an edge were decided {}", rules[self.ties]));
        }
        if let Some(edge) = self.odd_tie {
            said.push(format!("one on the {} edge the other way", ORDINALS[edge]));
        }
        if self.slack != 0.0 {
            let unit = match self.form {
                Form::Weights(_) | Form::Dots => "",
                _ => " px²",
            };
            said.push(format!("a number had to be at least {}{unit}", -self.slack));
        }
        if let Some(edge) = self.untested {
            said.push(format!("the {} edge were not tested", ORDINALS[edge]));
        }
        if let Some([a, b]) = self.exchanges {
            let (a, b) = (ORDINALS[a], ORDINALS[b]);
            said.push(format!(
                "of counterclockwise ones the {a} and the {b} corner changed places"
            ));
        }
        if self.turns_by_area {
            said.push("the winding came from the area, computed likewise".to_owned());
        }
        if self.looks_beyond {
            said.push("pixels beyond the box of the corners were looked at".to_owned());
        }
        said
    }

    /// The picture that it draws; of each direction that an edge may face, its rule for ties says whether samples on it are `owned`.
    pub(super) fn draw(&self, q: &AnyQuestion, sample: [i64; 2], owned: [bool; 8]) -> Picture {
        let mut picture = Picture::new(q.side);
        let Some(numbers) = self.numbers(q) else { return picture };
        for at in picture.all() {
            if numbers.draws(at, sample, owned) {
                picture.set(at, 1);
            }
        }
        picture
    }

    /// The same for one pixel, without a picture.
    pub(super) fn draws(
        &self,
        q: &AnyQuestion,
        at: [i32; 2],
        sample: [i64; 2],
        owned: [bool; 8],
    ) -> bool {
        self.numbers(q).is_some_and(|numbers| numbers.draws(at, sample, owned))
    }

    /// What it computes of a triangle, whatever its samples; nothing where none of them is drawn.
    pub(super) fn numbers(&self, q: &AnyQuestion) -> Option<Numbers<'_>> {
        Numbers::of(self, q)
    }
}

fn cross(a: [i64; 2], b: [i64; 2]) -> i64 {
    a[0] * b[1] - a[1] * b[0]
}

fn way(from: [i64; 2], to: [i64; 2]) -> [i64; 2] {
    [to[0] - from[0], to[1] - from[1]]
}

impl<'a> Numbers<'a> {
    /// Nothing where no pixel is drawn: of a triangle without area.
    fn of(test: &'a EdgeTest, q: &AnyQuestion) -> Option<Self> {
        let near = |[x, y]: [i64; 2]| [x.clamp(-FARTHEST, FARTHEST), y.clamp(-FARTHEST, FARTHEST)];
        let mut corners = [near(q.points[0]), near(q.points[1]), near(q.points[2])];
        let mut area = cross(way(corners[0], corners[1]), way(corners[0], corners[2]));
        if let Some([a, b]) = test.exchanges.filter(|_| area < 0) {
            corners.swap(a, b);
            area = -area;
        }
        let bounds = |axis: usize| {
            let [a, b, c] = [corners[0][axis], corners[1][axis], corners[2][axis]];
            [a.min(b).min(c).div_euclid(256), a.max(b).max(c).div_euclid(256)]
        };
        let bounds = [bounds(0), bounds(1)];
        let mut numbers = Self { test, corners, turn: area.signum(), bounds };
        if test.turns_by_area {
            numbers.turn = match test.float {
                Some(bits) => {
                    // Weights need the area before they are weights, and nobody adds up an area pixel by pixel.
                    let form = match test.form {
                        Form::Stepped | Form::Weights(_) | Form::Dots => Form::FromEnd(0),
                        other => other,
                    };
                    let area = numbers.in_floats(form, corners[2], bits)[0];
                    i64::from(area > 0.0) - i64::from(area < 0.0)
                }
                None => numbers.in_words(0, corners[2]).signum(),
            };
        }
        (area != 0 && numbers.turn != 0).then_some(numbers)
    }

    /// Whether a pixel is drawn.
    pub(super) fn draws(&self, [x, y]: [i32; 2], sample: [i64; 2], owned: [bool; 8]) -> bool {
        let at = [i64::from(x), i64::from(y)];
        if !self.test.looks_beyond && !self.is_in_box(at) {
            return false;
        }
        let point = [256 * at[0] + sample[0], 256 * at[1] + sample[1]];
        match self.test.float {
            Some(bits) => self.is_inside_in_floats(point, bits, owned),
            None => self.is_inside_in_words(point, owned),
        }
    }

    fn is_in_box(&self, at: [i64; 2]) -> bool {
        (0..2).all(|axis| (self.bounds[axis][0]..=self.bounds[axis][1]).contains(&at[axis]))
    }

    /// Whether a sample on an edge is drawn.
    fn owns(&self, edge: usize, owned: [bool; 8]) -> bool {
        let [dx, dy] = way(self.corners[edge], self.corners[(edge + 1) % 3]);
        owned[facing(-self.turn * dy, self.turn * dx)] != (self.test.odd_tie == Some(edge))
    }

    fn is_tested(&self, edge: usize) -> bool {
        self.test.untested != Some(edge)
    }

    fn is_inside_in_words(&self, point: [i64; 2], owned: [bool; 8]) -> bool {
        let slack = (self.test.slack * 65536.0).round() as i64;
        let all = [self.in_words(0, point), self.in_words(1, point), self.in_words(2, point)];
        if self.test.form == Form::Areas {
            let whole = self.in_words(0, self.corners[2]).abs();
            return whole - all.map(i64::abs).iter().sum::<i64>() >= -slack;
        }
        let lost = match self.test.cut {
            Some(Cut::Sums(bits, _)) => bits,
            _ => 0,
        };
        (0..3).all(|edge| {
            let least = i64::from(!self.owns(edge, owned)) - (slack >> lost);
            !self.is_tested(edge) || self.turn * all[edge] >= least
        })
    }

    /// The product of an edge and a point in whole numbers, in 1/65536 px².
    fn in_words(&self, edge: usize, point: [i64; 2]) -> i64 {
        let (a, b) = (self.corners[edge], self.corners[(edge + 1) % 3]);
        let wrapped = |v: i64, bits: Option<u32>| match bits {
            Some(bits) => wrap(v.into(), bits) as i64,
            None => v,
        };
        let (mut of_differences, mut of_products, mut of_sums) = (None, None, None);
        match self.test.word {
            Some(Word::Differences(bits)) => of_differences = Some(bits),
            Some(Word::Products(bits)) => of_products = Some(bits),
            Some(Word::Sums(bits)) => of_sums = Some(bits),
            None => {}
        }
        let product = |u: i64, v: i64| {
            let product = wrapped(u * v, of_products);
            match self.test.cut {
                Some(Cut::Products(bits, toward)) => {
                    round(product.into(), 1 << bits, toward) as i64
                }
                _ => product,
            }
        };
        let difference = |from, to| {
            let [dx, dy] = way(from, to);
            [wrapped(dx, of_differences), wrapped(dy, of_differences)]
        };
        let side = difference(a, b);
        let sum = match self.test.form {
            Form::Plane => {
                let by_point = product(-side[1], point[0]) + product(side[0], point[1]);
                by_point + product(side[1], a[0]) - product(side[0], a[1])
            }
            Form::FromEnd(1) => {
                let to = difference(b, point);
                product(side[0], to[1]) - product(side[1], to[0])
            }
            _ => {
                let to = difference(a, point);
                product(side[0], to[1]) - product(side[1], to[0])
            }
        };
        let sum = wrapped(sum, of_sums);
        match self.test.cut {
            Some(Cut::Sums(bits, toward)) => round(sum.into(), 1 << bits, toward) as i64,
            _ => sum,
        }
    }

    fn is_inside_in_floats(&self, point: [i64; 2], bits: u32, owned: [bool; 8]) -> bool {
        let slack = self.test.slack;
        let all = self.in_floats(self.test.form, point, bits);
        if self.test.form == Form::Areas {
            let whole = self.in_floats(Form::Areas, self.corners[2], bits)[0].abs();
            let of = |v: f64| float(v, bits);
            let sum = of(of(all[0].abs() + all[1].abs()) + all[2].abs());
            return of(whole - sum) >= -slack;
        }
        // Weights have their sign from the division.
        let turn = match self.test.form {
            Form::Weights(_) | Form::Dots => 1.0,
            _ => self.turn as f64,
        };
        (0..3).all(|edge| {
            let value = turn * all[edge];
            let is_in = match slack == 0.0 {
                true => value > 0.0 || value == 0.0 && self.owns(edge, owned),
                false => value >= -slack,
            };
            !self.is_tested(edge) || is_in
        })
    }

    /// What is computed of each edge in floats, in px² or as a weight.
    fn in_floats(&self, form: Form, point: [i64; 2], bits: u32) -> [f64; 3] {
        let floats = Floats(bits);
        let corners = self.corners.map(|corner| floats.px(corner));
        let p = floats.px(point);
        let edge = |i: usize, from: usize, p: [f64; 2]| {
            let (a, b) = (corners[i], corners[(i + 1) % 3]);
            floats.cross(floats.minus(b, a), floats.minus(p, [a, b][from]))
        };
        match form {
            Form::FromEnd(from) => [0, 1, 2].map(|i| edge(i, from, p)),
            Form::Areas => [0, 1, 2].map(|i| edge(i, 0, p)),
            Form::Plane => [0, 1, 2].map(|i| {
                let (a, b) = (corners[i], corners[(i + 1) % 3]);
                let [dx, dy] = floats.minus(b, a);
                let by_point = floats.of(floats.of(-dy * p[0]) + floats.of(dx * p[1]));
                floats.of(by_point + floats.cross(a, b))
            }),
            Form::Stepped => self.stepped(point, floats, &|i, p| edge(i, 0, p)),
            Form::Weights(rest) => {
                let area = edge(0, 0, corners[2]);
                let mut weights = [0, 1, 2].map(|i| floats.of(edge(i, 0, p) / area));
                let [first, second] = [1, 2].map(|more| weights[(rest + more) % 3]);
                weights[rest] = floats.of(floats.of(1.0 - first) - second);
                weights
            }
            Form::Dots => {
                let [to_second, to_third, to_point] =
                    [corners[1], corners[2], p].map(|q| floats.minus(q, corners[0]));
                let [ss, st, tt] =
                    [(to_second, to_second), (to_second, to_third), (to_third, to_third)]
                        .map(|(u, v)| floats.dot(u, v));
                let [sp, tp] = [to_second, to_third].map(|u| floats.dot(u, to_point));
                let over = floats.of(1.0 / floats.of(floats.of(ss * tt) - floats.of(st * st)));
                let weight = |a: f64, b: f64, c: f64, d: f64| {
                    floats.of(floats.of(floats.of(a * b) - floats.of(c * d)) * over)
                };
                let of_third = weight(ss, tp, st, sp);
                let of_second = weight(tt, sp, st, tp);
                // The edge opposite a corner has its weight.
                [of_third, floats.of(1.0 - floats.of(of_second + of_third)), of_second]
            }
        }
    }

    /// Each edge's number at the first pixel of the box, with one step added for each row and column to another.
    fn stepped(
        &self,
        point: [i64; 2],
        floats: Floats,
        edge: &dyn Fn(usize, [f64; 2]) -> f64,
    ) -> [f64; 3] {
        let sample = point.map(|v| v.rem_euclid(256));
        // A loop over the box begins in the window.
        let start = [0, 1].map(|axis| 256 * self.bounds[axis][0].max(0) + sample[axis]);
        let [columns, rows] = [0, 1].map(|axis| (point[axis] - start[axis]) / 256);
        [0, 1, 2].map(|i| {
            let (a, b) = (self.corners[i], self.corners[(i + 1) % 3]);
            let [dx, dy] = floats.minus(floats.px(b), floats.px(a));
            let mut value = edge(i, floats.px(start));
            for _ in 0..rows {
                value = floats.of(value + dx);
            }
            for _ in 0..columns {
                value = floats.of(value - dy);
            }
            value
        })
    }
}

/// Arithmetic in floats of so many bits: every result is rounded.
#[derive(Clone, Copy)]
struct Floats(u32);

impl Floats {
    fn of(self, v: f64) -> f64 {
        float(v, self.0)
    }

    fn px(self, p: [i64; 2]) -> [f64; 2] {
        p.map(|v| self.of(v as f64 / 256.0))
    }

    fn minus(self, u: [f64; 2], v: [f64; 2]) -> [f64; 2] {
        [self.of(u[0] - v[0]), self.of(u[1] - v[1])]
    }

    fn cross(self, u: [f64; 2], v: [f64; 2]) -> f64 {
        self.of(self.of(u[0] * v[1]) - self.of(u[1] * v[0]))
    }

    fn dot(self, u: [f64; 2], v: [f64; 2]) -> f64 {
        self.of(self.of(u[0] * v[0]) + self.of(u[1] * v[1]))
    }
}
