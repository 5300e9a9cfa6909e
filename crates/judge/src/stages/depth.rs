//! Which of several triangles is seen, as a test of depth that may be mistaken.

use super::search::{Field, Quantity, Spot, Stage, composed};
use crate::ask::{Answer, Asked, Question};
use crate::declared::Declared;
use crate::expected::Expect as _;
use crate::pixels::masks_of;
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::{PixelRect, SUBPIXELS};
use rasterproof_verify::cases::Triangle;
use rasterproof_verify::comparison::Expectation;
use rasterproof_verify::mistakes::values::{self, depths, sum, weights};
use rasterproof_verify::mistakes::{Format, MistakeId};

composed! {
    /// A test of depth.
    pub struct DepthTest {
        place: Place,
        key: Key,
        bias: Bias,
        range: Range,
        wrap: Wrap,
        store: Store,
        compare: Compare,
        write: Write,
        whose: Whose,
    }
}

/// Where depth is computed, in pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Place {
    #[default]
    Centre,
    /// Away from the upper left corner of the pixel, and how that is said.
    At([f64; 2], &'static str),
    /// So far from the first pixel of a block of so many.
    Block(i32, f64),
    /// In the first pixel of the row, for all of it.
    FirstOfRow,
}

impl Field for Place {
    const NAME: &'static str = "the place of depth";

    fn options() -> Vec<Self> {
        let mut all = vec![Self::FirstOfRow];
        all.extend(values::PLACES[1..].iter().map(|(at, said)| Self::At(*at, said)));
        for side in [2, 4, 8] {
            all.extend([0.5, f64::from(side) / 2.0].map(|at| Self::Block(side, at)));
        }
        all
    }

    fn says(&self) -> Option<(String, &'static str)> {
        let does = match self {
            Self::Centre => return None,
            Self::At(_, said) => format!("computes depth{said}"),
            Self::Block(side, at) => format!(
                "computes depth once for a block of {side} x {side} px, in its {}",
                if *at == 0.5 { "first pixel" } else { "middle" }
            ),
            Self::FirstOfRow => {
                "computes depth in the first pixel of a row, for all of the row".to_owned()
            }
        };
        Some((does, "compute depth where coverage is sampled"))
    }
}

/// The number that is compared.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Key {
    #[default]
    Depth,
    /// The depth with its other sign, as an area with a wrong sign makes it.
    Negated,
    /// The same number for the whole triangle: the mean depth of its corners.
    Mean,
    /// That of its nearest corner.
    Nearest,
    /// That of the corner between both others.
    Middle,
    /// That of its farthest corner.
    Farthest,
    /// That of a corner by its place in the request.
    Corner(usize),
    /// The weighted sum before it is divided by the area.
    TimesArea,
    /// How far the depth lies from 1/2.
    FromHalf,
}

/// What repairs a program that sorts whole triangles: no order of these is right where they cross.
const SORTED: &str = "compare depths at every pixel";
/// The numbers, with their words and the repair.
const KEYS: [(Key, &str, &str); 10] = [
    (Key::Mean, MistakeId::SortedByMeanDepth.name(), SORTED),
    (Key::Nearest, "sorts whole triangles by their nearest corner", SORTED),
    (Key::Farthest, "sorts whole triangles by their farthest corner", SORTED),
    (Key::Middle, "sorts whole triangles by their middle corner", SORTED),
    (
        Key::TimesArea,
        MistakeId::UndividedDepthsCompared.name(),
        "divide the weighted sum by the area",
    ),
    (
        Key::FromHalf,
        "compares how far depths lie from 1/2, as where the sign of depths from -1 to 1 is lost",
        "compare the depths themselves",
    ),
    (Key::Negated, "turns the sign of depths", "divide the weighted sum by the area with its sign"),
    (
        Key::Corner(0),
        "compares the depth of the first corner for the whole triangle",
        "interpolate depth",
    ),
    (
        Key::Corner(1),
        "compares the depth of the second corner for the whole triangle",
        "interpolate depth",
    ),
    (
        Key::Corner(2),
        "compares the depth of the last corner for the whole triangle",
        "interpolate depth",
    ),
];

impl Field for Key {
    const NAME: &'static str = "order of depths";

    fn options() -> Vec<Self> {
        KEYS.iter().map(|(key, ..)| *key).collect()
    }

    fn says(&self) -> Option<(String, &'static str)> {
        let (_, does, repair) = KEYS.iter().find(|(key, ..)| key == self)?;
        Some(((*does).to_owned(), repair))
    }
}

/// A number that is added to the depth, once for each of something.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bias {
    /// The number that is read off, in units of depth.
    by: f64,
    /// What it is added for.
    of: BiasOf,
}

/// What a bias is added for.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum BiasOf {
    #[default]
    Triangle,
    /// For each triangle before it.
    Number,
    /// Only while it is compared with what is there.
    New,
    /// For each unit by which depth changes to the next pixel.
    Slope,
}

impl Field for Bias {
    const NAME: &'static str = "a bias of depth";

    /// Its numbers are read off.
    fn options() -> Vec<Self> {
        Vec::new()
    }

    fn says(&self) -> Option<(String, &'static str)> {
        let Self { by, of } = *self;
        let (does, to) = if by > 0.0 { ("adds", "to") } else { ("takes", "off") };
        let size = format!("{:e}", by.abs());
        // What is added, for what, and whether it brings a triangle nearer or farther.
        let does = match of {
            BiasOf::Triangle => format!("{does} {size} {to} the depth of a triangle"),
            BiasOf::Number => {
                format!("{does} {size} {to} the depth of a triangle for each one before it")
            }
            BiasOf::New if by < 0.0 => {
                format!("shows a later triangle that lies up to {size} farther")
            }
            BiasOf::New => format!("shows a later triangle only where it is nearer by {size}"),
            BiasOf::Slope => format!(
                "{does} {size} times the slope of depth {to} the depth of a triangle (a bias for shadows, or for lines on faces)"
            ),
        };
        Some((does, "compare the depths themselves"))
    }
}

/// The depths that are drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range([f64; 2]);

impl Default for Range {
    fn default() -> Self {
        Self([f64::MIN, f64::MAX])
    }
}

impl Field for Range {
    const NAME: &'static str = "a range of depth";

    /// Its ends are read off.
    fn options() -> Vec<Self> {
        Vec::new()
    }

    fn says(&self) -> Option<(String, &'static str)> {
        let does = match self.0 {
            [f64::MIN, most] => format!("draws nothing farther than about {most:.3}"),
            [least, _] => format!("draws nothing nearer than about {least:.3}"),
        };
        Some((does, "clear the buffer with the farthest depth, and clip at the planes alone"))
    }
}

/// So many times a depth begins again at 0 between 0 and 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wrap(Format);

impl Field for Wrap {
    const NAME: &'static str = "depth wraps around";

    fn options() -> Vec<Self> {
        (1..7).map(|times| Self(Format::Wrapped(1 << times))).collect()
    }

    fn says(&self) -> Option<(String, &'static str)> {
        let does = format!("keeps depth in {}", self.0);
        Some((does, "scale depths to what a word holds, and clamp what goes beyond"))
    }
}

/// The numbers in which depths are kept.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Store(Format);

impl Field for Store {
    const NAME: &'static str = "bits of depth";

    fn options() -> Vec<Self> {
        let all = Format::options().into_iter();
        all.filter(|format| !matches!(format, Format::Wrapped(_))).map(Self).collect()
    }

    fn says(&self) -> Option<(String, &'static str)> {
        let does = format!("keeps depth in {}", self.0);
        Some((does, "keep more bits of depth, or move the near plane away from the eye"))
    }
}

/// The bits of the orders that a new number may have against the one that is kept.
const LESS: u8 = 1;
const EQUAL: u8 = 2;
const GREATER: u8 = 4;

/// The orders in which a new number passes against the one that is kept: one bit for less, for equal and for greater.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Compare(u8);

impl Default for Compare {
    fn default() -> Self {
        Self(LESS)
    }
}

/// The repairs of comparisons that keep the wrong end, and of programs that compare nothing.
const TURNED: &str =
    "less depth is nearer: turn the comparison round, or clear the buffer with the farthest depth";
const COMPARED: &str = "compare depths before a pixel is written";
/// The comparisons, with their words and the repair.
const COMPARISONS: [(u8, &str, &str); 7] = [
    (GREATER, MistakeId::FarthestShown.name(), TURNED),
    (7, MistakeId::LastShown.name(), COMPARED),
    (0, "shows the triangle that was drawn first, without a test of depth", COMPARED),
    (
        LESS | EQUAL,
        "of equal depths shows the last drawn",
        "keep what is there where depths are equal",
    ),
    (GREATER | EQUAL, "shows the farthest triangle, and of equal depths the last drawn", TURNED),
    (LESS | GREATER, "shows the triangle that was drawn last, unless depths are equal", COMPARED),
    (EQUAL, "shows a later triangle only where depths are equal", COMPARED),
];

impl Field for Compare {
    const NAME: &'static str = "the comparison of depths";

    fn options() -> Vec<Self> {
        COMPARISONS.iter().map(|(orders, ..)| Self(*orders)).collect()
    }

    fn says(&self) -> Option<(String, &'static str)> {
        let (_, does, repair) = COMPARISONS.iter().find(|(orders, ..)| *orders == self.0)?;
        Some(((*does).to_owned(), repair))
    }
}

/// When the depth of a triangle is written.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Write {
    #[default]
    WhenShown,
    /// The depth of the first triangle stays.
    Never,
    /// Also where the test fails.
    Always,
}

impl Field for Write {
    const NAME: &'static str = "the buffer of depths";

    fn options() -> Vec<Self> {
        vec![Self::Never, Self::Always]
    }

    fn says(&self) -> Option<(String, &'static str)> {
        Some(match self {
            Self::WhenShown => return None,
            Self::Never => (
                "tests depths and does not write them: a pixel keeps the depth of its first triangle".to_owned(),
                "write the depth of each triangle that passes the test",
            ),
            Self::Always => (
                "writes the depth of a triangle also where the test fails".to_owned(),
                "write depths where the test passes, and nowhere else",
            ),
        })
    }
}

/// The triangles that are treated wrongly.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Whose {
    #[default]
    All,
    /// Whether clockwise.
    Turn(bool),
    /// By the rest of the number in the list.
    Number(usize),
    /// Whether all corners have one depth.
    Flat(bool),
}

impl Whose {
    /// Whether the triangle of a layer is one of those that are treated wrongly.
    fn holds(self, layer: &Layer<'_>) -> bool {
        let [a, b, c] = depths(layer.triangle);
        match self {
            Self::All => true,
            Self::Turn(is_clockwise) => (twice_area(&layer.triangle.corners()) > 0) == is_clockwise,
            Self::Number(rest) => layer.number % 2 == rest,
            Self::Flat(is_flat) => (a == b && b == c) == is_flat,
        }
    }
}

impl Field for Whose {
    const NAME: &'static str = "depth of some triangles";

    fn options() -> Vec<Self> {
        let of = |is: bool| [Self::Turn(is), Self::Number(usize::from(is)), Self::Flat(is)];
        [of(false), of(true)].concat()
    }

    fn says(&self) -> Option<(String, &'static str)> {
        None
    }
}

/// Triangles of a pixel at most: a question has no more.
const MOST_LAYERS: usize = 64;

/// What may be shown, and the layer whose depth may be kept meanwhile.
#[derive(Clone, Copy, PartialEq)]
struct DepthState {
    /// The place of the triangle among those that are drawn at the pixel.
    shown: usize,
    /// The place of the triangle whose depth the buffer holds.
    buffer: usize,
}

/// A triangle at a pixel.
pub struct Layer<'a> {
    /// The place of the triangle in the list, from 0.
    pub(super) number: usize,
    /// The depth of the triangle at the sample of the pixel.
    pub(super) depth: f64,
    /// The first pixel of its row, and the one after the last.
    pub(super) first: i32,
    /// The column after the last pixel of its row.
    pub(super) end: i32,
    pub(super) triangle: &'a Triangle,
}

/// A pixel with all that covers it, in drawing order, and what is shown: its number and one, or 0.
pub struct Pile<'a> {
    pub(super) spot: Spot,
    pub(super) layers: Vec<Layer<'a>>,
    /// The number of the triangle that is shown and one, or 0 where none is.
    pub(super) shown: usize,
    /// How far rounding may move a depth, as a share of it.
    noise: f64,
}

/// How fast depth changes along x or y, whichever is faster.
fn slope(t: &Triangle) -> f64 {
    let from = depth_at(t, [0.0, 0.0]);
    let along_x = (depth_at(t, [1.0, 0.0]) - from).abs();
    let along_y = (depth_at(t, [0.0, 1.0]) - from).abs();
    along_x.max(along_y)
}

/// The depth of the plane of a triangle at a place, in pixels.
fn depth_at(t: &Triangle, place: [f64; 2]) -> f64 {
    sum(weights(&t.corners(), place), depths(t))
}

/// States that are the same come to the same, so each is followed once.
fn add_once(states: &mut Vec<DepthState>, state: DepthState) {
    if !states.contains(&state) {
        states.push(state);
    }
}

impl DepthTest {
    /// The number that is compared, before it is brought to a format.
    fn key(&self, layer: &Layer<'_>, [x, y]: [i32; 2]) -> f64 {
        // A triangle that is treated rightly is compared by its depth.
        let t = layer.triangle;
        if !self.whose.holds(layer) {
            return layer.depth;
        }
        let at = |place| depth_at(t, place);
        let depth = match self.place {
            Place::Centre => layer.depth,
            Place::At([dx, dy], _) => at([f64::from(x) + dx, f64::from(y) + dy]),
            Place::Block(side, by) => at([x, y].map(|v| f64::from(v / side * side) + by)),
            Place::FirstOfRow => at([f64::from(layer.first) + 0.5, f64::from(y) + 0.5]),
        };
        // What is compared for a whole triangle is taken from its corners.
        let [a, b, c] = depths(t);
        let (least, most) = (a.min(b).min(c), a.max(b).max(c));
        match self.key {
            Key::Depth => depth,
            Key::Negated => -depth,
            Key::Mean => (a + b + c) / 3.0,
            Key::Nearest => least,
            Key::Middle => a + b + c - least - most,
            Key::Farthest => most,
            Key::Corner(i) => depths(t)[i],
            Key::TimesArea => depth * twice_area(&t.corners()).unsigned_abs() as f64,
            Key::FromHalf => (depth - 0.5).abs(),
        }
    }

    /// How often the bias is added.
    fn biased(of: BiasOf, layer: &Layer<'_>, is_new: bool) -> f64 {
        match of {
            BiasOf::Triangle => 1.0,
            BiasOf::Number => layer.number as f64,
            BiasOf::New => f64::from(u8::from(is_new)),
            BiasOf::Slope => slope(layer.triangle),
        }
    }

    /// The least and the greatest number that may be compared, as far as rounding goes.
    fn compared(&self, layer: &Layer<'_>, pile: &Pile<'_>, is_new: bool) -> [f64; 2] {
        // The number, with a bias where there is one.
        let mut key = self.key(layer, pile.spot.at);
        let is_changed = self.whose.holds(layer);
        if is_changed && self.bias.by != 0.0 {
            key += self.bias.by * Self::biased(self.bias.of, layer, is_new);
        }
        // As far as rounding goes, in the format in which it is kept.
        let noise = pile.noise * key.abs().max(1.0);
        let [a, b] = [key - noise, key + noise].map(|v| match is_changed {
            true => self.store.0.of(self.wrap.0.of(v)),
            false => v,
        });
        // What begins again in between may be anything.
        if a > b { [b.min(0.0), a.max(1.0)] } else { [a, b] }
    }

    /// The triangles that may be shown, one bit each.
    pub(super) fn shown(&self, pile: &Pile<'_>) -> u128 {
        let Range([least, most]) = self.range;
        let mut drawn: Vec<&Layer<'_>> = pile.layers.iter().collect();
        drawn.retain(|layer| {
            !self.whose.holds(layer) || (layer.depth >= least && layer.depth < most)
        });
        drawn.truncate(MOST_LAYERS);
        // Rounding leaves open which of two depths is less, so that several triangles may be shown and several depths be kept.
        let mut kept = [[0.0; 2]; MOST_LAYERS];
        let mut states = Vec::new();
        for (i, layer) in drawn.iter().enumerate() {
            kept[i] = self.compared(layer, pile, false);
            if i == 0 {
                states.push(DepthState { shown: 0, buffer: 0 });
                continue;
            }
            let new = self.compared(layer, pile, true);
            let compare = if self.whose.holds(layer) { self.compare.0 } else { LESS };
            let mut next = Vec::new();
            for DepthState { shown, buffer } in states {
                let order = orders(new, kept[buffer]);
                let passed = if self.write == Write::Never { buffer } else { i };
                let failed = if self.write == Write::Always { i } else { buffer };
                if order & compare != 0 {
                    add_once(&mut next, DepthState { shown: i, buffer: passed });
                }
                if order & !compare != 0 {
                    add_once(&mut next, DepthState { shown, buffer: failed });
                }
            }
            states = next;
        }
        if states.is_empty() {
            return 1;
        }
        let mut seen = 0;
        for DepthState { shown, .. } in states {
            seen |= 2_u128.checked_shl(drawn[shown].number as u32).unwrap_or(0);
        }
        seen
    }

    /// The bias of each kind with which all is as it is shown, and the same of some triangles alone.
    fn with_bias(&self, parts: &[&Pile<'_>]) -> Vec<Self> {
        // A bias says something only where less, or greater, is nearer.
        let sign = match self.compare.0 {
            LESS | 3 => 1.0,
            GREATER | 6 => -1.0,
            _ => return Vec::new(),
        };
        // Each kind of bias of the triangles that are wrong here, and one number for each of some triangles alone.
        let mut kinds = Vec::new();
        for of in [BiasOf::Number, BiasOf::New, BiasOf::Slope] {
            kinds.push((of, self.whose));
        }
        for whose in Whose::options() {
            kinds.push((BiasOf::Triangle, whose));
        }
        let mut all = Vec::new();
        for (of, whose) in kinds {
            let [least, most] = self.bias_range(parts, of, whose, sign);
            if let Some(by) = simplest_between(least, most) {
                all.push(Self { bias: Bias { by, of }, whose, ..self.clone() });
            }
        }
        all
    }

    /// The least and the greatest bias with which all is as it is shown; the least is greater where there is none. The sign is -1
    /// where greater depths are nearer.
    fn bias_range(&self, parts: &[&Pile<'_>], of: BiasOf, whose: Whose, sign: f64) -> [f64; 2] {
        let (mut least, mut most) = (f64::MIN, f64::MAX);
        for pile in parts {
            if least > most {
                break;
            }
            let Some(shown) = pile.layers.iter().position(|l| l.number + 1 == pile.shown) else {
                continue;
            };
            // Of more than two, what is compared depends on what went before.
            if of == BiasOf::New && pile.layers.len() > 2 {
                continue;
            }
            let key = |i: usize| self.key(&pile.layers[i], pile.spot.at);
            let times = |i: usize| match whose.holds(&pile.layers[i]) {
                true => Self::biased(of, &pile.layers[i], i > 0),
                false => 0.0,
            };
            // What is shown lies before each other triangle: that limits the bias by the room between both.
            for other in (0..pile.layers.len()).filter(|other| *other != shown) {
                let room = sign * (key(other) - key(shown));
                let by = sign * (times(shown) - times(other));
                if by > 0.0 {
                    most = most.min(room / by);
                } else if by < 0.0 {
                    least = least.max(room / by);
                }
            }
        }
        [least, most]
    }

    /// The depths beyond which nothing is shown.
    fn with_range(&self, parts: &[&Pile<'_>]) -> Vec<Self> {
        // The range of depths that are seen, and the depths that should be seen and are not.
        let (mut least, mut most) = (f64::MAX, f64::MIN);
        let mut lost = Vec::new();
        for pile in parts {
            let shown = pile.layers.iter().find(|layer| layer.number + 1 == pile.shown);
            if let Some(shown) = shown {
                (least, most) = (least.min(shown.depth), most.max(shown.depth));
            }
            for layer in &pile.layers {
                if shown.is_none_or(|shown| layer.depth < shown.depth) {
                    lost.push(layer.depth);
                }
            }
        }
        // A limit lies between what is seen and the nearest of what is lost on that side.
        let nearer = lost.iter().copied().filter(|v| *v < least).reduce(f64::max);
        let farther = lost.iter().copied().filter(|v| *v > most).reduce(f64::min);
        let mut all = Vec::new();
        if let Some(nearer) = nearer {
            let range = Range([values::simplest(nearer, least), f64::MAX]);
            all.push(Self { range, ..self.clone() });
        }
        if let Some(farther) = farther {
            let range = Range([f64::MIN, values::simplest(farther, most)]);
            all.push(Self { range, ..self.clone() });
        }
        all
    }
}

/// The simplest number that is not 0 and lies between two, of which one may be missing.
fn simplest_between(least: f64, most: f64) -> Option<f64> {
    // A number that is added at its limit makes depths equal.
    if least > most || (least <= 0.0 && most >= 0.0) {
        return None;
    }
    let [least, most] = match [least, most] {
        [f64::MIN, most] => [2.0 * most, most],
        [least, f64::MAX] => [least, 2.0 * least],
        both => both,
    };
    Some(values::simplest(least, most))
}

/// The orders that a new number and a kept one may have.
fn orders(new: [f64; 2], kept: [f64; 2]) -> u8 {
    if new == kept && new[0] == new[1] {
        return EQUAL;
    }
    let is_any = new[0] <= kept[1] && kept[0] <= new[1];
    let mut orders = if is_any { EQUAL } else { 0 };
    if new[0] < kept[1] {
        orders |= LESS;
    }
    if new[1] > kept[0] {
        orders |= GREATER;
    }
    orders
}

impl Stage for DepthTest {
    type Part<'a> = Pile<'a>;
    const PAGE: &'static str = "ch06";
    const REFUTED: &'static str = "a pixel that shows another triangle";
    const NOISE: &'static [f64] = &[16.0 * f64::EPSILON, 4.0 * f32::EPSILON as f64];
    const WHOM: &'static str = "pixels";

    fn parts<'a>(
        question: &'a Question,
        answer: &'a Answer,
        declared: &Declared,
        noise: f64,
    ) -> Vec<Pile<'a>> {
        let (Asked::Depth(list), Answer::Seen(runs)) = (&question.of, answer) else {
            return Vec::new();
        };
        let window = PixelRect::window(question.width, question.height);
        // A number for each triangle from 1 on, so that 0 is nothing.
        let numbers: Vec<_> = runs.iter().map(|(run, number)| (*run, number + 1)).collect();
        let mut piles = Vec::new();
        for (y, row) in masks_of(&numbers, window).rows() {
            for (x, shown) in (window.x0..).zip(row) {
                let spot = Spot { at: [x, y], is_clockwise: true, window };
                let shown = usize::from(*shown);
                piles.push(Pile { spot, layers: Vec::new(), shown, noise });
            }
        }
        // Then the triangles that cover each pixel, in drawing order.
        let sample = declared.convention.sample.map(|at| f64::from(at) / f64::from(SUBPIXELS));
        let place = |x: i32, y: i32| {
            (y - window.y0) as usize * window.width() as usize + (x - window.x0) as usize
        };
        // Pixels that a triangle may cover or not tell nothing.
        let mut is_open = vec![false; piles.len()];
        for (number, triangle) in list.iter().enumerate() {
            let corners = triangle.corners();
            let Some(Expectation { must, may }) = declared.picture(&corners, window) else {
                return Vec::new();
            };
            for span in must {
                for x in span.x0_px..span.x1_px {
                    let at = [x, span.y_px];
                    let at = [0, 1].map(|axis| f64::from(at[axis]) + sample[axis]);
                    let depth = sum(weights(&corners, at), depths(triangle));
                    let pile: &mut Pile<'_> = &mut piles[place(x, span.y_px)];
                    let (first, end) = (span.x0_px, span.x1_px);
                    pile.layers.push(Layer { number, depth, first, end, triangle });
                }
            }
            for span in may.into_iter().flatten() {
                for at in (span.x0_px..span.x1_px).map(|x| place(x, span.y_px)) {
                    is_open[at] |= piles[at].layers.last().is_none_or(|l| l.number != number);
                }
            }
        }
        // A pixel has the winding of its nearest triangle.
        for pile in &mut piles {
            let nearest = pile.layers.iter().min_by(|a, b| a.depth.total_cmp(&b.depth));
            pile.spot.is_clockwise = nearest.is_some_and(|l| twice_area(&l.triangle.corners()) > 0);
        }
        let mut open = is_open.into_iter();
        piles.retain(|pile| {
            open.next() == Some(false) && (pile.shown > 0 || !pile.layers.is_empty())
        });
        piles
    }

    fn explains(&self, part: &Pile<'_>) -> bool {
        self.shown(part).checked_shr(part.shown as u32).is_some_and(|shown| shown & 1 == 1)
    }

    fn solved(&self, parts: &[&Pile<'_>]) -> Vec<Self> {
        let mut all = self.with_bias(parts);
        all.extend(self.with_range(parts));
        all
    }

    fn quantities(pile: &Pile<'_>) -> Vec<Quantity> {
        let mut all = pile.spot.quantities();
        let count = pile.layers.len() as f64;
        all.push(Quantity::number("the number of triangles at a pixel", count));
        all
    }

    fn filled(&self, does: &str) -> String {
        let whose = match self.whose {
            Whose::All => return does.to_owned(),
            Whose::Turn(true) => "clockwise",
            Whose::Turn(false) => "counterclockwise",
            Whose::Number(0) => "the first, third and every second",
            Whose::Number(_) => "the second, fourth and every second",
            Whose::Flat(true) => "flat",
            Whose::Flat(false) => "leaning",
        };
        format!("{does} (of {whose} triangles alone)")
    }
}
