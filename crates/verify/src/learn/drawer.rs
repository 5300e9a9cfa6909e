//! Who answers and who knows the right answer: triangles and lines behind one trait.

use super::picture::{MARGIN, Picture};
use super::quantity::facts_of;
use super::question::{AnyQuestion, LONGEST_LINE_PX, Room};
use super::trial::Work;
use crate::convention::{
    Declarations, LineAsker, LineConvention, LineQuestion, LineRounding, LineTie, Mask, Mirror,
    RULES, Shape, Ties, TriangleAsker, TriangleConvention, TriangleQuestion,
};
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::{PixelRect, SUBPIXELS, SubpixelPoint};
use rasterproof_core::random::Rng;
use std::borrow::Cow;
use std::future::Future;
use std::pin::Pin;

/// A question with its answer and the right one.
#[derive(Clone)]
pub(super) struct LearnedAnswer {
    pub(super) question: AnyQuestion,
    pub(super) facts: Vec<i64>,
    pub(super) drawn: Picture,
    pub(super) right: Picture,
    /// Pixels that are drawn otherwise than they should be.
    pub(super) wrong_pixels: usize,
}

impl LearnedAnswer {
    pub(super) fn new(question: AnyQuestion, drawn: Picture, right: Picture) -> Self {
        let facts = facts_of(&question);
        let wrong_pixels = right.differs(&drawn);
        Self { question, facts, drawn, right, wrong_pixels }
    }

    pub(super) fn is_wrong(&self) -> bool {
        self.wrong_pixels > 0
    }
}

/// Pictures that are waited for.
pub(super) type Pictures<'a> = Pin<Box<dyn Future<Output = Vec<Picture>> + 'a>>;

/// The program under judgement, with what it should draw.
pub(super) trait Drawer {
    /// What a rule draws: the right one is number 0. Nothing where it says nothing.
    fn right(&self, question: &AnyQuestion, rule: usize) -> Option<Picture>;
    /// All pixels of a line by a rule, in the window or not: nothing where these are too many, and of triangles.
    fn whole_line(&self, _: &AnyQuestion, _: usize) -> Option<Vec<[i32; 2]>> {
        None
    }
    /// The answers; what is not answered is an empty picture.
    fn ask<'a>(&'a self, questions: &'a [AnyQuestion]) -> Pictures<'a>;
    /// Questions whose answers are known to be wrong.
    fn failing(&self) -> Vec<AnyQuestion>;
    /// As many questions of these as may be asked.
    fn at_most(&self, most: usize) -> usize;
    /// What is said of each rule: of a convention after 'it draws', nothing of the right one; of a known wrong way, which come after
    /// the conventions, after 'it'.
    fn rules(&self) -> &[String];
    /// How many rules are conventions.
    fn conventions(&self) -> usize;
    /// What mends a rule; nothing of conventions.
    fn repair(&self, rule: usize) -> &str;
    /// The number of the other convention that it was given.
    fn other(&self) -> usize;
    /// Of a rule, for each direction that an edge faces, whether samples exactly on it are drawn.
    fn ties(&self, rule: usize) -> [bool; 8];
    /// Where samples lie in their pixel, in subpixels.
    fn sample(&self) -> [i64; 2];
    /// Whether a pixel that is drawn twice is told from others.
    fn counts(&self) -> bool;
    fn room(&mut self) -> &mut Room;
    /// What may still be done with the answers: each picture that is drawn is counted.
    fn work(&self) -> &Work;
}

/// Steps of [`Work`] for a picture, besides one for each of its pixels.
const PICTURE: usize = 64;

/// The side of the windows that a convention draws at once.
const BLOCK_PX: i32 = 32;

/// The picture of a question with its margin, in blocks: `draw` gets the first pixel of a block and its window.
fn in_blocks(
    side: [i32; 2],
    draw: &dyn Fn([i32; 2], PixelRect) -> Option<Mask>,
) -> Option<Picture> {
    let mut picture = Picture::new(side);
    let starts = |side: i32| (-MARGIN..side + MARGIN).step_by(BLOCK_PX as usize);
    for top in starts(side[1]) {
        for left in starts(side[0]) {
            let [width, height] = [(left, side[0]), (top, side[1])]
                .map(|(start, side)| BLOCK_PX.min(side + MARGIN - start));
            let mask = draw([left, top], PixelRect::window(width as u32, height as u32))?;
            for y in 0..height {
                // From one pixel that is covered to the next.
                let mut row = mask.row(y) & (u32::MAX >> (BLOCK_PX - width));
                while row != 0 {
                    picture.set([left + row.trailing_zeros() as i32, top + y], 1);
                    row &= row - 1;
                }
            }
        }
    }
    Some(picture)
}

fn window_of(question: &AnyQuestion) -> PixelRect {
    PixelRect::window(question.side[0] as u32, question.side[1] as u32)
}

/// What is drawn, and what is drawn more than once; nothing where a way says nothing.
type DrawnTwice<'a, Q> = Box<dyn Fn(&Q) -> Option<[Mask; 2]> + 'a>;

/// A known wrong way to draw, which a program may follow beside other mistakes.
pub struct KnownWay<'a, Q> {
    /// What the program does, after 'it'.
    pub(crate) does: String,
    pub(crate) repair: Cow<'static, str>,
    pub(crate) draw: DrawnTwice<'a, Q>,
}

impl<Q> KnownWay<'_, Q> {
    /// The picture of a question, in the margin that of the right one.
    fn picture(&self, asked: &Q, right: Picture) -> Option<Picture> {
        if right.side.iter().any(|side| *side > BLOCK_PX) {
            return None;
        }
        let [drawn, twice] = (self.draw)(asked)?;
        let mut picture = right;
        for [x, y] in picture.pixels() {
            picture.set([x, y], u8::from(drawn.has(x, y)) + u8::from(twice.has(x, y)));
        }
        Some(picture)
    }
}

/// The largest window that may be asked for: known wrong ways have no answer in larger ones.
fn largest<Q>(window_px: (u32, u32), ways: &[KnownWay<'_, Q>]) -> [i64; 2] {
    let most = if ways.is_empty() { i64::MAX } else { BLOCK_PX.into() };
    [window_px.0, window_px.1].map(|side| i64::from(side).min(most))
}

/// Farther out nobody knows what a known way draws.
const FARTHEST_KNOWN: i64 = 1 << 28;

/// Whether a known way may be asked for a question.
fn is_near(question: &AnyQuestion) -> bool {
    question.points.as_flattened().iter().all(|v| v.abs() <= FARTHEST_KNOWN)
}

/// What is said of a convention, after 'it draws'.
fn by_convention(words: &str) -> String {
    format!("by another convention (it {words})")
}

/// A question about a triangle, which keeps to the range that is declared.
fn triangle(q: &AnyQuestion) -> TriangleQuestion {
    let corners =
        [0, 1, 2].map(|i| SubpixelPoint::new(q.points[i][0] as i32, q.points[i][1] as i32));
    TriangleQuestion { corners, window: window_of(q) }
}

/// A question about a line, likewise.
fn line(q: &AnyQuestion) -> LineQuestion {
    let ends = [0, 1].map(|i| q.points[i].map(|v| v as i32));
    LineQuestion { ends, window: window_of(q) }
}

/// A rasterizer of triangles.
pub(super) struct Triangles<'a> {
    asker: &'a TriangleAsker,
    conventions: Vec<TriangleConvention>,
    rules: Vec<String>,
    other: usize,
    room: Room,
    sample: [i64; 2],
    /// Whether a pixel drawn twice cannot be seen.
    is_mask: bool,
    ways: &'a [KnownWay<'a, TriangleQuestion>],
    work: &'a Work,
}

impl<'a> Triangles<'a> {
    /// Answers are wrong where they are not as the first convention says; the other one is tried, too. Nothing where pictures
    /// are turned over.
    pub(super) fn new(
        asker: &'a TriangleAsker,
        known: &Declarations,
        [expected, other]: [&TriangleConvention; 2],
        ways: &'a [KnownWay<'a, TriangleQuestion>],
        seed: u64,
        work: &'a Work,
    ) -> Option<Self> {
        let grid = known.grid.clamp(1, SUBPIXELS);
        let grain = if SUBPIXELS % grid == 0 { SUBPIXELS / grid } else { SUBPIXELS };
        let room = Room {
            rng: Rng::new("learn", seed, 0),
            is_line: false,
            side: largest(known.window_px, ways),
            grain: grain.into(),
            most: i64::from(known.range_px.clamp(1, 1 << 20)) * 256,
            longest: LONGEST_LINE_PX,
            is_far: false,
        };
        let sample = match expected.shape {
            Shape::Point { x, y }
            | Shape::Stepped { x, y }
            | Shape::Reach { x, y, .. }
            | Shape::Share { x, y, .. }
            | Shape::Samples { x, y, .. } => [x, y].map(i64::from),
            // Between the places that the two crossings of a row are compared at.
            Shape::Rows { left, right, y } => [(left + right) / 2, y].map(i64::from),
            Shape::Outline(_) | Shape::Scan(_) => [128; 2],
        };
        let mut conventions = vec![*expected];
        let mut rules = vec![String::new()];
        for rule in RULES {
            let Some(ties) = Ties::named(rule) else { continue };
            let convention = TriangleConvention { ties, ..*expected };
            if !conventions.contains(&convention) {
                conventions.push(convention);
                rules.push(format!("by the {rule} rule"));
            }
        }
        if other.mirror == Mirror::None && !conventions.contains(other) {
            conventions.push(*other);
            rules.push(by_convention(&other.words()));
        }
        let other = conventions.iter().position(|convention| convention == other).unwrap_or(0);
        rules.extend(ways.iter().map(|way| way.does.clone()));
        let is_plain = expected.mirror == Mirror::None;
        let is_mask = known.mask;
        let this = Self { asker, conventions, rules, other, room, sample, is_mask, ways, work };
        is_plain.then_some(this)
    }
}

impl Drawer for Triangles<'_> {
    fn right(&self, question: &AnyQuestion, rule: usize) -> Option<Picture> {
        self.work.spend(PICTURE + question.pixels());
        if let Some(way) = rule.checked_sub(self.conventions.len()) {
            let right = self.right(question, 0).filter(|_| is_near(question))?;
            return self.ways[way].picture(&triangle(question), right);
        }
        in_blocks(question.side, &|block, window| {
            let corner = |i: usize| {
                let [x, y] = [0, 1].map(|axis| {
                    let moved = question.points[i][axis] - 256 * i64::from(block[axis]);
                    // Changed questions may lie anywhere.
                    moved.clamp(-(1 << 30), 1 << 30) as i32
                });
                SubpixelPoint::new(x, y)
            };
            self.conventions[rule].mask(&[corner(0), corner(1), corner(2)], window)
        })
    }

    fn ask<'b>(&'b self, questions: &'b [AnyQuestion]) -> Pictures<'b> {
        let asked: Vec<TriangleQuestion> = questions.iter().map(triangle).collect();
        let most = if self.counts() { 2 } else { 1 };
        let picture = move |(q, answer): (&AnyQuestion, Option<Coverage>)| {
            let mut picture = Picture::new(q.side);
            if let Some(answer) = answer.filter(|answer| answer.bounds() == window_of(q)) {
                for at in picture.pixels() {
                    picture.set(at, answer.get(at[0], at[1]).unwrap_or(0).min(most));
                }
            }
            picture
        };
        Box::pin(async move {
            questions.iter().zip(self.asker.ask(&asked).await).map(picture).collect()
        })
    }

    fn failing(&self) -> Vec<AnyQuestion> {
        self.asker.failing().iter().map(AnyQuestion::from).collect()
    }

    fn at_most(&self, most: usize) -> usize {
        self.asker.at_most(most)
    }

    fn rules(&self) -> &[String] {
        &self.rules
    }

    fn conventions(&self) -> usize {
        self.conventions.len()
    }

    fn repair(&self, rule: usize) -> &str {
        rule.checked_sub(self.conventions.len()).map_or("", |way| &self.ways[way].repair)
    }

    fn other(&self) -> usize {
        self.other
    }

    fn ties(&self, rule: usize) -> [bool; 8] {
        self.conventions[rule].ties.edges
    }

    fn sample(&self) -> [i64; 2] {
        self.sample
    }

    fn counts(&self) -> bool {
        !self.is_mask
    }

    fn room(&mut self) -> &mut Room {
        &mut self.room
    }

    fn work(&self) -> &Work {
        self.work
    }
}

/// The longest line of which all pixels are looked at.
const LONGEST_WHOLE_PX: i64 = 1 << 14;

/// A line drawer. Pixels that come twice are not told from others.
pub(super) struct Lines<'a> {
    asker: &'a LineAsker,
    conventions: Vec<LineConvention>,
    rules: Vec<String>,
    other: usize,
    room: Room,
    ways: &'a [KnownWay<'a, LineQuestion>],
    work: &'a Work,
}

impl<'a> Lines<'a> {
    pub(super) fn new(
        asker: &'a LineAsker,
        known: &Declarations,
        [expected, other]: [&LineConvention; 2],
        ways: &'a [KnownWay<'a, LineQuestion>],
        seed: u64,
        work: &'a Work,
    ) -> Self {
        let room = Room {
            rng: Rng::new("learn", seed, 1),
            is_line: true,
            side: largest(known.window_px, ways),
            grain: 1,
            most: known.range_px.clamp(1, 1 << 30).into(),
            longest: LONGEST_LINE_PX,
            is_far: false,
        };
        let mut conventions = vec![*expected];
        let mut rules = vec![String::new()];
        for tie in LineTie::ALL {
            let convention = LineConvention { rounding: LineRounding::Nearest(tie), ..*expected };
            if !conventions.contains(&convention) {
                conventions.push(convention);
                rules.push(format!("as if its rule for ties were '{}'", tie.name()));
            }
        }
        if !conventions.contains(other) {
            conventions.push(*other);
            rules.push(by_convention(&other.words()));
        }
        let other = conventions.iter().position(|convention| convention == other).unwrap_or(0);
        rules.extend(ways.iter().map(|way| way.does.clone()));
        Self { asker, conventions, rules, other, room, ways, work }
    }
}

impl Drawer for Lines<'_> {
    fn right(&self, question: &AnyQuestion, rule: usize) -> Option<Picture> {
        self.work.spend(PICTURE + question.pixels());
        if let Some(way) = rule.checked_sub(self.conventions.len()) {
            let right = self.right(question, 0).filter(|_| is_near(question))?;
            return self.ways[way].picture(&line(question), right);
        }
        in_blocks(question.side, &|block, window| {
            let ends = [0, 1].map(|i| {
                [0, 1].map(|axis| {
                    let moved = question.points[i][axis] - i64::from(block[axis]);
                    moved.clamp(-(1 << 30), 1 << 30) as i32
                })
            });
            let pixels = self.conventions[rule].pixels(&LineQuestion { ends, window })?;
            let mut mask = Mask::default();
            let shown = pixels.into_iter().filter(|p| window.contains(p[0], p[1]));
            shown.for_each(|[x, y]| mask.set(x, y));
            Some(mask)
        })
    }

    fn whole_line(&self, question: &AnyQuestion, rule: usize) -> Option<Vec<[i32; 2]>> {
        let [[left, right], [top, bottom]] = [0, 1].map(|axis| question.range(axis));
        let [width, height] = [right - left + 1, bottom - top + 1];
        if width.max(height) > LONGEST_WHOLE_PX || rule >= self.conventions.len() {
            return None;
        }
        self.work.spend((width + height) as usize);
        let window = PixelRect::window(width as u32, height as u32);
        let ends = [0, 1].map(|i| {
            let [x, y] = question.points[i];
            [(x - left) as i32, (y - top) as i32]
        });
        let mut pixels = self.conventions[rule].pixels(&LineQuestion { ends, window })?;
        let moved = |[x, y]: [i32; 2]| [x + left as i32, y + top as i32];
        pixels.iter_mut().for_each(|at| *at = moved(*at));
        Some(pixels)
    }

    fn ask<'b>(&'b self, questions: &'b [AnyQuestion]) -> Pictures<'b> {
        let asked: Vec<LineQuestion> = questions.iter().map(line).collect();
        let picture = |(q, answer): (&AnyQuestion, Option<Vec<[i32; 2]>>)| {
            let mut picture = Picture::new(q.side);
            let pixels = answer.unwrap_or_default();
            let shown: Vec<_> = pixels.into_iter().filter(|p| picture.shows(*p)).collect();
            shown.into_iter().for_each(|at| picture.set(at, 1));
            picture
        };
        Box::pin(async move {
            questions.iter().zip(self.asker.ask(&asked).await).map(picture).collect()
        })
    }

    fn failing(&self) -> Vec<AnyQuestion> {
        self.asker.failing().iter().map(AnyQuestion::from).collect()
    }

    fn at_most(&self, most: usize) -> usize {
        self.asker.at_most(most)
    }

    fn rules(&self) -> &[String] {
        &self.rules
    }

    fn conventions(&self) -> usize {
        self.conventions.len()
    }

    fn repair(&self, rule: usize) -> &str {
        rule.checked_sub(self.conventions.len()).map_or("", |way| &self.ways[way].repair)
    }

    fn other(&self) -> usize {
        self.other
    }

    fn ties(&self, _: usize) -> [bool; 8] {
        [false; 8]
    }

    fn sample(&self) -> [i64; 2] {
        [0; 2]
    }

    fn counts(&self) -> bool {
        false
    }

    fn room(&mut self) -> &mut Room {
        &mut self.room
    }

    fn work(&self) -> &Work {
        self.work
    }
}
