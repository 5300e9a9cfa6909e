//! Pixels that show one of several triangles, as a test of depth shows it.

use std::collections::HashMap;
use std::marker::PhantomData;
use std::sync::Arc;

use super::learnable::{Learnable, LearnableOf, LearnedCase, of_case, spread};
use crate::ask::Asked;
use crate::declared::Declared;
use crate::stages::depth::{DepthTest, Layer, Pile};
use crate::stages::search::{Stage as _, both, said_of, singles};
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::SUBPIXELS;
use rasterproof_verify::cases::Case;
use rasterproof_verify::cases::facts::{Topic, depth};
use rasterproof_verify::learn::rows::{
    Condition, ConditionTerms, Examples, NONE, Quantities, Unit, Vocabulary, value,
};
use rasterproof_verify::learn::trial::Work;
use rasterproof_verify::mistakes::values::depths;

/// Which of several triangles is seen at each pixel.
pub struct Depths;

/// A pixel with the triangles that cover it, of which the nearest may be shown.
pub struct PixelOfList<'a> {
    asked: &'a LearnedCase,
    pile: Pile<'a>,
    /// How much farther than the nearest a triangle may be that is shown.
    allowance: f64,
    tiles: Arc<Tiles>,
}

/// Sides of the tiles by which triangles may be sorted into bins, and their words.
const TILES: [(i32, &str); 4] = [(4, "4 px"), (8, "8 px"), (16, "16 px"), (32, "32 px")];

/// Which triangles of a list cover a pixel of each tile, as bits; a map for each of [`TILES`].
struct Tiles([HashMap<[i32; 2], u64>; TILES.len()]);

impl Tiles {
    /// The triangles of each tile, from all pixels of an answer.
    fn of(piles: &[Pile<'_>]) -> Self {
        let mut tiles = TILES.map(|_| HashMap::new());
        for pile in piles {
            let mut covering = 0;
            for layer in &pile.layers {
                covering |= bit(layer.number);
            }
            for ((side, _), tiles) in TILES.into_iter().zip(&mut tiles) {
                *tiles.entry(tile(pile.spot.at, side)).or_insert(0) |= covering;
            }
        }
        Self(tiles)
    }

    /// The place of a triangle, from 1, among those that cover a pixel of the tile of a pixel, for each of [`TILES`].
    fn places(&self, at: [i32; 2], number: usize) -> [i64; TILES.len()] {
        // The bits of all triangles that come before this one.
        let before = bit(number).wrapping_sub(1);
        std::array::from_fn(|of| {
            let covering = self.0[of].get(&tile(at, TILES[of].0)).copied().unwrap_or(0);
            i64::from((covering & before).count_ones()) + 1
        })
    }
}

/// The bit of a triangle by its number in the list; the protocol has at most 64 in a list.
fn bit(number: usize) -> u64 {
    1u64.checked_shl(number as u32).unwrap_or(0)
}

/// The tile of a pixel, by its column and its row of tiles.
fn tile(at: [i32; 2], side: i32) -> [i32; 2] {
    at.map(|at| at.div_euclid(side))
}

/// What a program may do in place of showing the nearest triangle.
#[derive(Clone)]
pub enum Change {
    /// Another test of depth.
    Test(DepthTest),
    /// Triangles of which a condition holds are left out; the words say which.
    Without(Condition, String),
    /// No triangle is shown.
    Nothing,
    /// The second nearest triangle is shown, or nothing where there is one alone.
    Second,
}

impl PixelOfList<'_> {
    /// The layer with the least depth among some, if there is any; of equal depths the first.
    fn nearest_of(&self, is_kept: &dyn Fn(&Layer<'_>) -> bool) -> Option<&Layer<'_>> {
        let mut nearest: Option<&Layer<'_>> = None;
        for layer in &self.pile.layers {
            let is_nearer =
                nearest.is_none_or(|nearest| layer.depth.total_cmp(&nearest.depth).is_lt());
            if is_kept(layer) && is_nearer {
                nearest = Some(layer);
            }
        }
        nearest
    }

    /// Whether a triangle is the one that is shown; `shown` counts from 1, and 0 is none.
    fn is_shown(&self, layer: &Layer<'_>) -> bool {
        layer.number + 1 == self.pile.shown
    }

    /// The layer that is shown, if it is one of those that cover the pixel.
    fn shown(&self) -> Option<&Layer<'_>> {
        self.pile.layers.iter().find(|layer| self.is_shown(layer))
    }

    /// Whether what is shown is the nearest of some layers, or nothing where there are none.
    fn shows_nearest(&self, is_kept: &dyn Fn(&Layer<'_>) -> bool) -> bool {
        let Some(nearest) = self.nearest_of(is_kept) else { return self.pile.shown == 0 };
        let farthest = nearest.depth + self.allowance;
        self.pile
            .layers
            .iter()
            .any(|layer| self.is_shown(layer) && is_kept(layer) && layer.depth <= farthest)
    }

    /// The nearest triangle, which is right.
    fn first(&self) -> Option<&Layer<'_>> {
        self.nearest_of(&|_| true)
    }

    /// The nearest one but that.
    fn second(&self) -> Option<&Layer<'_>> {
        let first = self.first()?.number;
        self.nearest_of(&|layer| layer.number != first)
    }

    /// The layer of a triangle, if it covers the pixel.
    fn by_number(&self, number: usize) -> Option<&Layer<'_>> {
        self.pile.layers.iter().find(|layer| layer.number == number)
    }

    /// The triangle that a change shows; without one, that which is shown.
    fn alternative(&self, change: Option<&Change>) -> Option<&Layer<'_>> {
        match change {
            None => self.by_number(self.pile.shown.checked_sub(1)?),
            Some(Change::Test(test)) => {
                // The lowest bit is that of nothing, the next ones those of the triangles.
                let first = test.shown(&self.pile).trailing_zeros() as usize;
                self.by_number(first.checked_sub(1)?)
            }
            Some(Change::Without(condition, _)) => {
                self.nearest_of(&|layer| !condition.holds(&self.row_of(layer)))
            }
            Some(Change::Nothing) => None,
            Some(Change::Second) => self.second(),
        }
    }

    /// The quantities of the question and of one of the triangles.
    fn row_of(&self, layer: &Layer<'_>) -> Vec<i64> {
        // The quantities of the question come first, then the pixel, then the triangle.
        let mut out = Quantities::after(self.asked.facts.clone());
        self.of_place(&mut out);
        self.of_layer(Some(layer), IT, &mut out);
        out.values
    }

    /// The place of the pixel in the window, and how many triangles it has.
    fn of_place(&self, out: &mut Quantities) {
        let [x, y] = self.pile.spot.at.map(i64::from);
        let window = self.pile.spot.window;
        out.number(Unit::Paired, x, &["the column"]);
        out.number(Unit::Paired, y, &["the row"]);
        let right = i64::from(window.x1) - 1 - x;
        out.number(Unit::Paired, right, &["the number of columns to its right in the window"]);
        let below = i64::from(window.y1) - 1 - y;
        out.number(Unit::Paired, below, &["the number of rows below it in the window"]);
        let count = self.pile.layers.len() as i64;
        out.number(Unit::Count, count, &["the number of triangles at the pixel"]);
    }

    /// The quantities of a triangle at the pixel; `whose` is said before them, such as 'its ', or after them.
    fn of_layer(
        &self,
        layer: Option<&Layer<'_>>,
        [whose, who, of_whom]: Whose,
        out: &mut Quantities,
    ) {
        let Some(l) = layer else { return self.of_no_layer([whose, who, of_whom], out) };
        let [x, y] = self.pile.spot.at;
        // Its place among the others, in drawing order.
        let (mut before, mut after) = (0, 0);
        for other in &self.pile.layers {
            before += i64::from(other.number < l.number);
            after += i64::from(other.number > l.number);
        }
        // The box around its corners.
        let (mut least, mut most) = ([i32::MAX; 2], [i32::MIN; 2]);
        for corner in l.triangle.corners() {
            for (axis, v) in [corner.x, corner.y].into_iter().enumerate() {
                least[axis] = least[axis].min(v);
                most[axis] = most[axis].max(v);
            }
        }
        let row = |v: i32| i64::from(v.div_euclid(SUBPIXELS));
        // Where it stands in the list, in its row and in its box.
        let number = l.number as i64;
        for (v, noun) in [
            (number + 1, "place in the list (from 1)"),
            (self.list_length() - number, "place in the list, counted from its end,"),
            (before + 1, "place among the triangles at the pixel (from 1)"),
            (after, "number of later triangles at the pixel"),
            ((x - l.first).into(), "number of columns from the first pixel of the row"),
            ((l.end - 1 - x).into(), "number of columns to the last pixel of the row"),
            (i64::from(y) - row(least[1]), "number of rows from the top corner"),
            (row(most[1]) - i64::from(y), "number of rows to the bottom corner"),
        ] {
            out.number(Unit::Count, v, &[whose, noun, of_whom]);
        }
        // Who draws by groups may forget the last ones.
        let noun = "place in the list (from 1) beyond the whole groups of ";
        for (group, word) in [(2, "2"), (4, "4"), (8, "8"), (16, "16")] {
            let beyond = number + 1 - self.list_length() / group * group;
            out.number(Unit::Count, beyond, &[whose, noun, word, of_whom]);
        }
        // A bin of a tile may be full.
        let noun = "place among the triangles that cover a pixel of its tile of ";
        for ((_, side), place) in TILES.into_iter().zip(self.tiles.places([x, y], l.number)) {
            out.number(Unit::Count, place, &[whose, noun, side, of_whom]);
        }
        // Its size, its winding, and whether it is flat or leaves the window.
        let area = twice_area(&l.triangle.corners());
        out.number(Unit::Subpixels, (most[0] - least[0]).into(), &[whose, "width", of_whom]);
        out.number(Unit::Subpixels, (most[1] - least[1]).into(), &[whose, "height", of_whom]);
        out.number(Unit::Area, area.unsigned_abs() as i64, &[whose, "area", of_whom]);
        let [a, b, c] = depths(l.triangle);
        let sides = [self.pile.spot.window.x1, self.pile.spot.window.y1];
        let leaves = (0..2).any(|i| least[i] < 0 || most[i] > sides[i] * SUBPIXELS);
        for (holds, yes, no) in [
            (area > 0, " is clockwise", " is not clockwise"),
            (a == b && b == c, " has one depth everywhere", " has different depths at its corners"),
            (leaves, " leaves the window", " lies within the window"),
        ] {
            out.holds(holds, who, [yes, no]);
        }
        // Its depths, at the pixel and at its corners.
        let (near, far) = (a.min(b).min(c), a.max(b).max(c));
        for (v, noun) in [
            (l.depth, "depth at the pixel"),
            (near, "least depth"),
            (far, "greatest depth"),
            (far - near, "difference of depths between corners"),
        ] {
            out.number(Unit::Value, value(v), &[whose, noun, of_whom]);
        }
    }

    /// As many quantities of no triangle, of which no test holds.
    fn of_no_layer(&self, whose: Whose, out: &mut Quantities) {
        let start = out.values.len();
        match self.pile.layers.first() {
            Some(any) => self.of_layer(Some(any), whose, out),
            None => out.values.extend([NONE; OF_LAYER]),
        }
        out.values[start..].fill(NONE);
    }

    /// How many triangles the question has.
    fn list_length(&self) -> i64 {
        match &self.asked.question.of {
            Asked::Depth(list) => list.len() as i64,
            _ => 0,
        }
    }
}

/// What is said before a quantity of a triangle, for the triangle, and after the quantity.
type Whose = [&'static str; 3];
const IT: Whose = ["its ", "it", ""];
const NEAREST: Whose = ["the ", "the nearest triangle", " of the nearest triangle"];
const SHOWN: Whose = ["the ", "the one shown instead", " of the one shown instead"];
/// How many quantities `of_layer` gives of a triangle.
const OF_LAYER: usize = 26;

impl Learnable for Depths {
    type Part<'a> = PixelOfList<'a>;
    type Change = Change;
    const TOPIC: &'static Topic = &depth::TOPIC;
    const PART: &'static str = "pixel";

    fn of_question(_: &Case, _: &mut Quantities) {}

    fn parts<'a>(asked: &'a LearnedCase, declared: &Declared) -> Vec<PixelOfList<'a>> {
        let Asked::Depth(list) = &asked.question.of else { return Vec::new() };
        // How much farther a triangle may lie that is shown: twice the tolerance, since both depths may be off.
        let largest = list.iter().flat_map(depths).fold(0.0, |m: f64, v| m.max(v.abs()));
        let allowance = (2.0 * declared.tolerance + 16.0 * f64::EPSILON) * largest;
        let noise = declared.tolerance.clamp(DepthTest::NOISE[0], DepthTest::NOISE[1]);
        let piles = DepthTest::parts(&asked.question, &asked.answer, declared, noise);
        let tiles = Arc::new(Tiles::of(&piles));
        let mut parts = Vec::new();
        for pile in piles {
            parts.push(PixelOfList { asked, pile, allowance, tiles: Arc::clone(&tiles) });
        }
        parts
    }

    fn is_right(part: &PixelOfList<'_>) -> bool {
        part.shows_nearest(&|_| true)
    }

    fn explains(change: &Change, part: &PixelOfList<'_>) -> bool {
        match change {
            Change::Test(test) => test.explains(&part.pile),
            Change::Without(condition, _) => {
                part.shows_nearest(&|layer| !condition.holds(&part.row_of(layer)))
            }
            Change::Nothing => part.pile.shown == 0,
            Change::Second => {
                let first = part.first().map(|layer| layer.number);
                part.shows_nearest(&|layer| Some(layer.number) != first)
            }
        }
    }

    fn of_part(part: &PixelOfList<'_>, change: Option<&Change>, out: &mut Quantities) {
        part.of_place(out);
        let (first, other) = (part.first(), part.alternative(change));
        part.of_layer(first, NEAREST, out);
        part.of_layer(other, SHOWN, out);
        // How far the one shown instead lies from the nearest one; nothing where one of both is missing.
        let (mut places, mut depths) = (NONE, NONE);
        if let (Some(first), Some(other)) = (first, other) {
            places = other.number as i64 - first.number as i64;
            depths = value(other.depth - first.depth);
        }
        let noun = "the place in the list of the one shown instead less that of the nearest";
        out.number(Unit::Count, places, &[noun]);
        let noun = "the depth of the one shown instead less that of the nearest";
        out.number(Unit::Value, depths, &[noun]);
    }

    fn changes(wrong: &[&PixelOfList<'_>], right: &[&PixelOfList<'_>], work: &Work) -> Vec<Change> {
        let piles: Vec<&Pile<'_>> = wrong.iter().map(|part| &part.pile).collect();
        let mut all = vec![Change::Nothing, Change::Second];
        all.extend(left_out(wrong, right, work));
        all.extend(singles::<DepthTest>(&piles).into_iter().map(Change::Test));
        all
    }

    fn both(a: &Change, b: &Change) -> Option<Change> {
        let (Change::Test(a), Change::Test(b)) = (a, b) else { return None };
        both(a, b).map(Change::Test)
    }

    fn says(change: &Change) -> String {
        match change {
            Change::Test(test) => said_of(test, "").does,
            Change::Without(_, words) => format!("does not draw a triangle where {words}"),
            Change::Nothing => "shows no triangle".to_owned(),
            Change::Second => "shows the nearest triangle but one, or nothing,".to_owned(),
        }
    }
}

/// Which triangles are left out, where those that should be seen and are not have something in common.
fn left_out(wrong: &[&PixelOfList<'_>], right: &[&PixelOfList<'_>], work: &Work) -> Option<Change> {
    // A condition that holds of the lost triangles and of no shown one says which are left out.
    let mut examples = Examples::default();
    // Lost is what lies before the triangle that is shown, or any where none is; it should be left out.
    for part in wrong {
        let shown = part.shown();
        for layer in &part.pile.layers {
            if shown.is_none_or(|shown| layer.depth + part.allowance < shown.depth) {
                examples.should(part.row_of(layer), part.asked.number);
            }
        }
    }
    // What is shown is not left out.
    for part in wrong.iter().chain(&spread(right, 2 * wrong.len())) {
        if let Some(layer) = part.shown() {
            examples.should_not(part.row_of(layer));
        }
    }
    // The names of the quantities are those of any triangle.
    let part = wrong.first()?;
    let mut out =
        of_case(&LearnableOf::<Depths>(PhantomData), &part.asked.case, &Declared::default(), true);
    part.of_place(&mut out);
    part.of_layer(part.pile.layers.first(), IT, &mut out);
    let names = Vocabulary::of(out);
    let wanted = ConditionTerms { facts: 3, questions: 3, slack: 0 };
    let condition = examples.best(&names, wanted, work)?;
    let words = condition.words(&names);
    Some(Change::Without(condition, words))
}
