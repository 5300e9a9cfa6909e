//! What a wrong program believes: for each typical misconception, the answers that it leads to.
//!
//! A misconception is named where all answers of a step that it speaks about are the ones that it predicts, and some of
//! them are wrong. Predictions are computed from the request alone: by [`rasterproof_verify::convention`] where a convention is
//! mistaken, by [`stages`] where values, depths, samples or the near plane are, by `wrong_formulas` of formulas, and here for the rest. A program with two mistakes at once
//! follows none of them, and nothing is named.

use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::{PixelRect, SUBPIXELS};
use rasterproof_core::triangle::Span;
use rasterproof_judge::ask::{Answer, Asked, Question};
use rasterproof_judge::check::{Check, Truth, expected_answer};
use rasterproof_judge::declared::DEFAULT_TOLERANCE;
use rasterproof_judge::pixels::picture_of;
use rasterproof_judge::stages::{self, Answered};
use rasterproof_verify::convention::{
    End, Ends, LineConvention, LineQuestion, LineRounding, LineTie, Mirror, Quantum, Rounding,
    Shape, Ties, TriangleConvention, Windings,
};
use rasterproof_verify::mistakes::MistakeId;
use rasterproof_verify::oracle::formula::{ExactNumber, Formula};

use super::wrong_formulas::{self, Wrong};

/// What a program was found to believe.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Misconception {
    pub name: &'static str,
    /// What the program does, as said to the student.
    pub says: &'static str,
    /// What to think about before the first hint.
    pub ask: &'static str,
}

/// The answer that it leads to; nothing for a request that it does not speak about.
type Predict = fn(&Question, &Truth) -> Option<Answer>;

/// A misconception, and what it leads to: any one of these is to explain every answer.
struct KnownMisconception {
    is: Misconception,
    predict: &'static [Predict],
    /// The mistakes that the judge finds in whoever does this, of [`stages`].
    does: &'static [MistakeId],
    /// The formula that it concerns, and what somebody computes there who believes this.
    of_formula: Option<(Formula, &'static [Wrong])>,
}

macro_rules! known {
    ($($name:literal, $says:literal, $ask:literal, [$($predict:expr),* $(,)?]
        $([$($does:ident),+])? $({$formula:ident: $wrong:ident})?;)*) => {
        &[$(KnownMisconception {
            is: Misconception { name: $name, says: $says, ask: $ask },
            predict: &[$($predict),*],
            does: &[$($(MistakeId::$does),+)?],
            of_formula: known!(@formula $($formula $wrong)?),
        }),*]
    };
    (@formula) => { None };
    (@formula $formula:ident $wrong:ident) => {
        Some((Formula::$formula, &wrong_formulas::$wrong))
    };
}

/// Every misconception that is known, the more particular ones first.
const KNOWN: &[KnownMisconception] = known![
    "nothing", "you draw nothing",
    "Your function returns and has set no pixel. Which pixel should the request above set first?",
    [|q, _| nothing(q)];

    "twice", "you draw a pixel twice where both ends of a line are the same pixel",
    "Both ends are drawn. How many pixels has a line that begins and ends in the same pixel?",
    [|q, t| point_twice(q, t)];

    "outside", "you draw pixels outside the window",
    "Take a window that is 4 pixels wide. Which numbers have its columns, and what does your test say about -1 and about 4?",
    [|q, _| uncut_line(q, false), |q, _| uncut_line(q, true)];

    "lost-end-pixel", "your line ends one pixel early",
    "How many pixels has a line from column 0 to column 5, and how often does your loop run?",
    [|q, _| line(q, LineConvention { ends: Ends::WithoutLast, ..right_line() }),
     |q, _| line(q, LineConvention { ends: Ends::WithoutFirst, ..right_line() }),
     |q, _| line(q, LineConvention { ends: Ends::WithoutRight, ..right_line() })];

    "reversed-line", "your pixels come from the end with the smaller coordinate, whichever end was named first",
    "The request names two ends. Which of your pixels comes first for a line drawn from right to left?",
    [|q, t| sorted_line(q, t)];

    "truncated-line", "you cut the second coordinate instead of rounding it",
    "A line is at height 0.9 in some column. In which row is the nearest pixel, and which one does a cast to int give?",
    [|q, _| line(q, LineConvention { rounding: LineRounding::Down, ..right_line() }),
     |q, _| line(q, LineConvention { rounding: LineRounding::Toward(End::Small), ..right_line() }),
     |q, _| line(q, LineConvention { rounding: LineRounding::Toward(End::First), ..right_line() })];

    "line-ties", "a tie of your lines depends on the direction of drawing, or goes the other way",
    "The line passes exactly between two pixels. Which one do you take on the way there, and which one on the way back?",
    [|q, _| line_tie(q, LineTie::FirstGo), |q, _| line_tie(q, LineTie::FirstStay),
     |q, _| line_tie(q, LineTie::SmallStay), |q, _| line_tie(q, LineTie::Up),
     |q, _| line_tie(q, LineTie::Down), |q, _| line_tie(q, LineTie::Even)];

    "one-axis", "you always walk along x, so steep lines have gaps",
    "A line goes down 10 rows and across 2 columns. How many pixels does one step in x skip?",
    [|q, t| along_x(q, t, false),
     |q, t| along_x(q, t, true)];

    "transposed", "x and y are exchanged in your picture",
    "Which of the two numbers of a pixel comes first in the answer, and which one indexes a row of your array?",
    [|q, t| exchanged_line(q, t),
     |q, _| tied(q, |ties| TriangleConvention { mirror: Mirror::Exchanged, ties, ..TriangleConvention::default() }, 0)];

    "strict", "you draw no sample that lies exactly on an edge",
    "Two triangles share an edge that passes through a pixel's centre. Which of them draws that pixel, if both do as you do?",
    [|q, _| rule(q, "strict")];

    "inclusive", "you draw every sample that lies exactly on an edge",
    "Two triangles share an edge that passes through a pixel's centre. How often is that pixel drawn, if both do as you do?",
    [|q, _| rule(q, "inclusive")];

    "y-up", "you use the rule of a y axis that points up: bottom and left edges instead of top and left ones",
    "Row 0 is at the top of the window. Which sign has the y step of an edge that runs up on the screen?",
    [|q, _| rule(q, "bottom-left"),
     |q, _| tied(q, |ties| TriangleConvention { mirror: Mirror::UpsideDown, ties, ..TriangleConvention::default() }, 0),
     |q, _| tied(q, |ties| TriangleConvention { mirror: Mirror::UpsideDown, ties, ..TriangleConvention::default() }, 1)];

    "right-edges", "you keep samples on right edges and drop those on left ones",
    "Take the square from 0.5 to 3.5. Which three columns should it have, and which three has yours?",
    [|q, _| rule(q, "top-right"), |q, _| rule(q, "bottom-right")];

    "winding", "you draw triangles of one winding alone",
    "Exchange two corners of a triangle: which sign has the area now, and what does your test do with it?",
    [|q, _| tied(q, |ties| TriangleConvention { draws: Windings::Clockwise, ties, ..TriangleConvention::default() }, 0),
     |q, _| tied(q, |ties| TriangleConvention { draws: Windings::Clockwise, ties, ..TriangleConvention::default() }, 1),
     |q, _| tied(q, |ties| TriangleConvention { draws: Windings::Clockwise, ties, ..TriangleConvention::default() }, 2),
     |q, _| tied(q, |ties| TriangleConvention { draws: Windings::CounterClockwise, ties, ..TriangleConvention::default() }, 0),
     |q, _| tied(q, |ties| TriangleConvention { draws: Windings::CounterClockwise, ties, ..TriangleConvention::default() }, 1),
     |q, _| tied(q, |ties| TriangleConvention { draws: Windings::CounterClockwise, ties, ..TriangleConvention::default() }, 2)];

    "corner-samples", "your samples are at the corners of pixels, not at their centres",
    "Where is the centre of the pixel in column 3? A triangle covers 3.2 to 3.9: does it cover that centre, and your sample?",
    [|q, _| sampled(q, 0, 0), |q, _| sampled(q, 0, 1), |q, _| sampled(q, 0, 2)];

    "half-off", "your samples are half a pixel too far: at the lower right corners of pixels",
    "How much do you add to the number of a column to come to the centre of its pixels?",
    [|q, _| sampled(q, SUBPIXELS, 0), |q, _| sampled(q, SUBPIXELS, 1), |q, _| sampled(q, SUBPIXELS, 2)];

    "truncated-corners", "you cut the corners to whole pixels before you draw",
    "What becomes of a triangle whose corners are 0.25, 0.5 and 0.75 px from each other, once they are int?",
    [|q, _| cut(q, Rounding::TowardZero, 0), |q, _| cut(q, Rounding::TowardZero, 1),
     |q, _| cut(q, Rounding::TowardZero, 2), |q, _| cut(q, Rounding::Down, 0),
     |q, _| cut(q, Rounding::Down, 1), |q, _| cut(q, Rounding::Down, 2)];

    "rounded-corners", "you round the corners to whole pixels before you draw",
    "Two corners are 0.3 px apart. Are they still two, once they are whole numbers?",
    [|q, _| cut(q, Rounding::Near, 0), |q, _| cut(q, Rounding::Near, 1), |q, _| cut(q, Rounding::Near, 2)];

    "clamped-weights", "you draw the whole bounding box: weights that are clamped to 0 and 1 are never outside",
    "What does a negative weight say about a sample, and what is left of it after clamping?",
    [|q, _| boxed(q)];

    "no-perspective", "your attributes are linear in the window: they are not divided by w",
    "An edge runs from w = 1 to w = 3. Is its middle in the window nearer to the first or to the second corner in space?",
    [] [Affine];

    "one-division", "you divide the attributes by w and never by the interpolated 1/w",
    "An attribute is 1 at all three corners, which have w = 2. What does your formula give inside?",
    [] [NotDividedBack];

    "times-w", "you multiply by w where you should divide",
    "Which of two corners should count more in the middle of the window: the near one with w = 1 or the far one with w = 3?",
    [] [WeightsByW];

    "transposed-matrix", "the matrix that gives your weights is transposed",
    "A matrix takes a point to its three weights. Are the corners its rows or its columns, and what does it make of corner a?",
    [] [TransposedMatrix];

    "swapped-weights", "for one winding you exchanged two corners and not their values",
    "You exchanged b and c to make the area positive. To which corner does the second weight belong now?",
    [] [ExchangedWeights];

    "corner-values", "your values are those at the upper left corner of each pixel, not at its centre",
    "A value grows by 1 per pixel from 0 at x = 0. What is it at the centre of column 0?",
    [] [UpperLeftValues];

    "depth-not-divided", "your depths are not divided by the area, so that large triangles seem far",
    "A triangle has z = 0.5 at all corners. What does your sum give before the division by its area?",
    [] [DepthNotDivided, DepthNotDividedBySign, UndividedDepthsCompared];

    "depth-divided-twice", "you divide z by w again: the z of the request has been divided already",
    "z / w is linear in the window. What is linear about z / w / w?",
    [] [DepthDividedTwice];

    "depth-in-perspective", "you interpolate z in perspective, like an attribute",
    "a is linear in space, z / w is linear in the window. Which of the two kinds is the z of the request?",
    [] [DepthInPerspective];

    "last-wins", "the triangle that is drawn last is seen, whatever its depth",
    "Draw the near triangle first and the far one after it. Which one should be seen?",
    [] [LastShown];

    "farthest-wins", "the greatest depth is seen instead of the least",
    "z is 0 at the near plane and 1 at the far one. Which of 0.2 and 0.8 hides the other?",
    [] [FarthestShown];

    "mean-depth", "you order whole triangles by their mean depth",
    "Two triangles go through one another. Which of them is in front?",
    [] [SortedByMeanDepth];

    "unclipped", "you return the triangle as it came: nothing is cut at the near plane",
    "A corner lies behind the eye. What is x / w there, and on which side of the picture does it appear?",
    [] [NotClipped];

    "dropped", "you drop every triangle that has a corner on the eye's side of the near plane",
    "You stand on a large floor. Where are its corners, and what would be left of it?",
    [] [CutTrianglesDropped];

    "plane-z-zero", "you cut at z = 0; the near plane is z = -w",
    "The near plane becomes z / w = -1. Which sum of z and w is zero there?",
    [] [ClippedAtZero];

    "pixel-samples", "your four samples are all at the centre: a pixel has all of them or none",
    "Where is sample 1, if (14, 6) sixteenths are counted from the pixel's upper left corner?",
    [] [SamplesAtCentre];

    "square-samples", "your samples lie in a square grid",
    "Draw the four places (6, 2), (14, 6), (2, 10), (10, 14) into a pixel. How many columns do they occupy?",
    [] [SamplesInSquare];

    "reversed-bits", "you count the bits of the mask from the other end",
    "Which number has bit 0 set and no other bit?",
    [] [SamplesBackwards];

    "no-number", "you return no number",
    "The answer of a formula is a list of numbers. Which is the first one for the request above?",
    [|q, _| matches!(q.of, Asked::Formula(..)).then(|| Answer::Numbers(Vec::new()))];

    "undivided", "you do not divide by z",
    "Two poles stand one behind the other, at z = 2 and z = 4. At which two places of the film do you draw them?",
    [] {Project: UNDIVIDED};

    "film-forgotten", "you divide by z and leave out the distance of the film",
    "The film moves away, from distance 1 to distance 2. What becomes of the size of the picture?",
    [] {Project: FILM_FORGOTTEN};

    "by-distance", "you divide by the way from the eye to the point, not by its distance along z",
    "A straight fence stands parallel to the film. Does your picture of it have the same height everywhere?",
    [] {Project: BY_DISTANCE};

    "w-lost", "your w is 1, as if the point had been divided already",
    "Which number does the perspective of step 5 need that x/z and y/z no longer have?",
    [] {Project: W_LOST};

    "size-less-1", "you multiply by the size of the window less 1",
    "A window is 5 pixels wide. At which x does its right border lie?",
    [] {Window: SIZE_LESS_1};

    "y-not-turned", "your y counts from the bottom of the window",
    "A point is above the middle of the film. Is its row less or more than half of the height?",
    [] {Window: Y_NOT_TURNED};

    "depth-not-halved", "your depth runs from -1 to 1",
    "z'/w' is -1 at the near plane. Which depth should be stored there?",
    [] {Window: DEPTH_NOT_HALVED};

    "linear-depth", "your depth is linear in z",
    "What has to be linear so that step 6 can interpolate it in the window: z, or a + b/z?",
    [] {Window: LINEAR_DEPTH};

    "film-at-1", "you forget that the film stands at the near plane",
    "The film from -1 to 1 stands at the distance n. Where on it does a point at x = n, z = n lie?",
    [] {Window: FILM_AT_1};

    "unsnapped", "you decide by the corners before they are snapped",
    "Which triangle is drawn: the one that is asked for, or the one on the grid? Which of the two has to be a front?",
    [] {Winding: UNSNAPPED};

    "winding-y-up", "your signs are those of a y axis that points up",
    "Draw (1, 1), (4, 1), (1, 4) with y down. Which way do they run?",
    [] {Winding: WINDING_Y_UP};

    "area-threshold", "you count triangles of a small area as having none",
    "A sliver is 100 px long and 1/256 px high. May a sample lie in it, and what is its area?",
    [] {Winding: AREA_THRESHOLD};

    "area-returned", "you return the area and not its sign",
    "The answer is 1, -1 or 0. Which of them is an area of 9?",
    [] {Winding: AREA_RETURNED};

    "turned-back", "you turn the other way: your matrices are transposed",
    "A quarter turn about z takes the x axis to the y axis. Where does yours take (1, 0, 0)?",
    [] {Turn: TURNED_BACK};

    "about-y-back", "your turn about y goes from x to z; the others are right",
    "In the ring x, y, z, x: which axis comes after z? So where does a turn about y take z?",
    [] {Turn: ABOUT_Y_BACK};

    "about-origin", "you turn about the origin: the centre has no part in it",
    "What should become of the centre itself, and what becomes of it with you?",
    [] {Turn: ABOUT_ORIGIN};

    "centre-back", "you move by the centre where you should move by its opposite, and back",
    "In the product of three matrices, which one acts first: the left or the right one?",
    [] {Turn: CENTRE_BACK};

    "not-moved-back", "you turn about the centre and do not move back",
    "After the first move the centre lies in the origin. Where does it lie in the end?",
    [] {Turn: NOT_MOVED_BACK};

    "normal-as-point", "you multiply normals with the matrix, as if they were points",
    "A surface is stretched along x. Does it lean more or less, and what becomes of your normal?",
    [] {Normal: NORMAL_AS_POINT};

    "transposed-alone", "you transpose the matrix for normals and do not invert it",
    "The matrix scales by 2. By what should it divide the normal?",
    [] {Normal: TRANSPOSED_ALONE};

    "inverted-alone", "you invert the matrix for normals and do not transpose it",
    "The inverse of a turn is its transpose. Which matrix do normals get under a turn?",
    [] {Normal: INVERTED_ALONE};

    "dark-light", "what faces away from the light loses light",
    "The cosine is -0.5 and the ambient light 0.2. How bright is the surface?",
    [] {Light: DARK_LIGHT};

    "lit-behind", "what faces away from the light is lit, too",
    "Which sign has the cosine where the light comes from behind the surface?",
    [] {Light: LIT_BEHIND};

    "long-normal", "you do not divide by the length of the normal",
    "Two normals at a right angle are interpolated. How long is the one in the middle?",
    [] {Light: LONG_NORMAL};

    "texel-corners", "your texels have their values at their left borders",
    "Where in a texel does the bilinear look-up read exactly its value?",
    [] {Texel: TEXEL_CORNERS};

    "clamped-texels", "the borders of your texture go on; it should begin again",
    "Which texel lies to the left of the first one of a floor that repeats?",
    [] {Texel: CLAMPED};

    "texels-less-1", "you multiply u by the number of texels less 1",
    "A texture has 4 texels. How many texels from its left border is u = 1?",
    [] {Texel: TEXELS_LESS_1};

    "level-in-window", "your u and v change evenly in the window",
    "Which of u, u/w and 1/w are linear in the window?",
    [] {Level: LEVEL_IN_WINDOW};

    "one-direction", "you look at the step to the next pixel in one direction alone",
    "A floor seen from low above: in which direction do the texels of two neighbours lie far apart?",
    [] {Level: ONE_DIRECTION};

    "shorter-direction", "you take the shorter of both steps, or their sum",
    "A pixel meets a strip of 2 by 16 texels. At which level does a read no longer skip any of them?",
    [] {Level: SHORTER_DIRECTION};

    "other-logarithm", "you take another logarithm than that to the base 2, or none",
    "How much longer is a texel of the next level?",
    [] {Level: OTHER_LOGARITHM};

    "size-forgotten", "you count in parts of the texture, not in texels",
    "u grows by 1/64 from pixel to pixel, in a texture of 256 texels. How many texels is that?",
    [] {Level: SIZE_FORGOTTEN};

    "whole-level", "you round the level, or hold it at 0",
    "Which level lies halfway between 1 and 2, and what does a program read there?",
    [] {Level: WHOLE_LEVEL};
];

/// The names of all, for those who list them.
pub fn all() -> impl Iterator<Item = &'static Misconception> {
    KNOWN.iter().map(|known| &known.is)
}

/// What explains the answers of a program to an exercise that it fails, if anything that is known does.
pub fn find(check: Check, asked: &[Answered], truth: &Truth) -> Option<&'static Misconception> {
    if !asked.iter().any(|case| case.is_wrong) {
        return None;
    }
    let explains = |predict: &dyn Fn(&Question, &Truth) -> Option<Answer>| {
        let mut wrong = 0;
        for case in asked {
            for (question, answer) in case.questions.iter().zip(&case.answers) {
                let Some(predicted) = predict(question, truth) else { continue };
                if !is_same(question, answer, &predicted) {
                    return false;
                }
                wrong += u64::from(case.is_wrong);
            }
        }
        wrong > 0
    };
    let mut answers = asked.iter().flat_map(|case| &case.answers);
    let is_none = |answer: &Answer| matches!(answer, Answer::Died(_) | Answer::Refused(_));
    let does = match answers.any(is_none) {
        true => Vec::new(),
        false => stages::explaining(check, asked, truth),
    };
    let is_done = |known: &MistakeId| does.contains(known);
    let is_it = |known: &&KnownMisconception| {
        known.predict.iter().any(|predict| explains(predict))
            || known.does.iter().any(is_done)
            || known.of_formula.is_some_and(|(formula, wrong)| {
                wrong.iter().any(|wrong| explains(&|q, _| computed(q, formula, *wrong)))
            })
    };
    KNOWN.iter().find(is_it).map(|known| &known.is)
}

/// What somebody answers who computes a formula in this way.
fn computed(question: &Question, formula: Formula, wrong: Wrong) -> Option<Answer> {
    match &question.of {
        Asked::Formula(asked, numbers) if *asked == formula => wrong(numbers).map(Answer::Numbers),
        _ => None,
    }
}

/// Whether two lists of numbers are the same within the tolerance of a formula, or of what they are themselves.
fn are_near(question: &Question, a: &[f64], b: &[f64]) -> bool {
    let Asked::Formula(formula, numbers) = &question.of else { return false };
    let Some(exact) = formula.of(numbers) else { return false };
    let near = |((a, b), given): ((&f64, &f64), &ExactNumber)| {
        (a - b).abs() <= DEFAULT_TOLERANCE * given.scale.max(a.abs())
    };
    a.len() == b.len() && a.iter().zip(b).zip(&exact).all(near)
}

fn is_same(question: &Question, a: &Answer, b: &Answer) -> bool {
    let window = PixelRect::window(question.width, question.height);
    match (a, b) {
        (Answer::Line(a), Answer::Line(b)) => a == b,
        (Answer::Numbers(a), Answer::Numbers(b)) => are_near(question, a, b),
        (Answer::Coverage(_), Answer::Coverage(_)) => {
            picture_of(a, window) == picture_of(b, window)
        }
        _ => a == b,
    }
}

fn right_line() -> LineConvention {
    LineConvention::default()
}

fn line_question(question: &Question) -> Option<LineQuestion> {
    let Asked::Line { ends, .. } = &question.of else { return None };
    let window = PixelRect::window(question.width, question.height);
    Some(LineQuestion { ends: ends.map(|end| [end.x, end.y]), window })
}

fn as_line(pixels: Vec<[i32; 2]>) -> Answer {
    Answer::Line(pixels.into_iter().map(|[x, y]| (x, y)).collect())
}

fn line(question: &Question, convention: LineConvention) -> Option<Answer> {
    convention.pixels(&line_question(question)?).map(as_line)
}

/// The answer of a function without a body, where it is to set pixels.
fn nothing(question: &Question) -> Option<Answer> {
    Some(match question.of {
        Asked::Coverage(_) => Answer::Coverage(Vec::new()),
        Asked::Values(_) => Answer::Values(Vec::new()),
        Asked::Samples(_) => Answer::Samples(Vec::new()),
        Asked::Line { .. } => Answer::Line(Vec::new()),
        Asked::Depth(_) => Answer::Seen(Vec::new()),
        Asked::Near(_)
        | Asked::Carried(_)
        | Asked::Wide(_)
        | Asked::Area(_)
        | Asked::SampleValues(_)
        | Asked::Polygon(_)
        | Asked::Formula(..) => return None,
    })
}

/// The right pixels, and that of a line between a pixel and itself once for each end.
fn point_twice(question: &Question, truth: &Truth) -> Option<Answer> {
    let Some(Answer::Line(mut pixels)) = expected_answer(question, truth) else { return None };
    let [a, b] = line_question(question)?.ends;
    if a == b {
        pixels.extend_from_within(..);
    }
    Some(Answer::Line(pixels))
}

/// The pixels of a line that is not cut to the window, or is cut along its longer axis alone.
fn uncut_line(question: &Question, is_major_cut: bool) -> Option<Answer> {
    let asked = line_question(question)?;
    let [a, b] = asked.ends;
    let distance = |axis: usize| a[axis].abs_diff(b[axis]);
    let major = usize::from(distance(1) > distance(0));
    let columns_or_rows = |axis: usize, size: u32| {
        let (low, high) = (a[axis].min(b[axis]), a[axis].max(b[axis]).checked_add(1)?);
        let is_cut = is_major_cut && axis == major;
        Some(if is_cut { (low.max(0), high.min(size as i32)) } else { (low, high) })
    };
    let (x0, x1) = columns_or_rows(0, question.width)?;
    let (y0, y1) = columns_or_rows(1, question.height)?;
    let window = PixelRect { x0, y0, x1, y1 };
    right_line().pixels(&LineQuestion { window, ..asked }).map(as_line)
}

fn line_tie(question: &Question, tie: LineTie) -> Option<Answer> {
    line(question, LineConvention { rounding: LineRounding::Nearest(tie), ..right_line() })
}

/// The right pixels, always from the end with the smaller coordinate along the longer axis.
fn sorted_line(question: &Question, truth: &Truth) -> Option<Answer> {
    let Some(Answer::Line(mut pixels)) = expected_answer(question, truth) else { return None };
    let [a, b] = line_question(question)?.ends;
    let major =
        usize::from(i64::from(a[1]).abs_diff(b[1].into()) > i64::from(a[0]).abs_diff(b[0].into()));
    if b[major] < a[major] {
        pixels.reverse();
    }
    Some(Answer::Line(pixels))
}

/// A pixel for each column, of a line inside the window; halves go down the window, or on from the left end.
fn along_x(question: &Question, truth: &Truth, goes_on: bool) -> Option<Answer> {
    let LineQuestion { ends: [a, b], window } = line_question(question)?;
    let [a, b] = [a, b].map(|end| end.map(i64::from));
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    if dy.abs() <= dx.abs() || dx == 0 {
        return (dx != 0).then(|| expected_answer(question, truth)).flatten();
    }
    let (left, steps) = if dx < 0 { (b, -dx) } else { (a, dx) };
    // Of a mirrored line, half a step more is half a step less.
    let slope = dy * dx.signum();
    let half = if goes_on && slope < 0 { steps - 1 } else { steps };
    let pixel = |x: i64| [x, left[1] + (2 * slope * (x - left[0]) + half).div_euclid(2 * steps)];
    let inside = |[x, y]: &[i64; 2]| {
        (0..i64::from(window.x1)).contains(x) && (0..i64::from(window.y1)).contains(y)
    };
    let columns = (left[0]..=left[0] + steps).take(1 << 16).map(pixel).filter(inside);
    let mut pixels: Vec<_> = columns.map(|[x, y]| (x as i32, y as i32)).collect();
    if dx < 0 {
        pixels.reverse();
    }
    Some(Answer::Line(pixels))
}

fn exchanged_line(question: &Question, truth: &Truth) -> Option<Answer> {
    let Some(Answer::Line(pixels)) = expected_answer(question, truth) else { return None };
    let (width, height) = (question.width as i32, question.height as i32);
    let exchanged = pixels.into_iter().map(|(x, y)| (y, x));
    Some(Answer::Line(exchanged.filter(|(x, y)| *x < width && *y < height).collect()))
}

/// Rules for samples on edges that a mistake elsewhere may go with.
const TIES: [&str; 3] = ["top-left", "inclusive", "strict"];

fn coverage(question: &Question, convention: &TriangleConvention) -> Option<Answer> {
    let Asked::Coverage(corners) = &question.of else { return None };
    let window = PixelRect::window(question.width, question.height);
    let drawn = convention.cover(corners, window)?;
    let runs = drawn.runs().map(|(y_px, x0_px, x1_px)| Span { y_px, x0_px, x1_px });
    Some(Answer::Coverage(runs.collect()))
}

fn rule(question: &Question, name: &str) -> Option<Answer> {
    coverage(
        question,
        &TriangleConvention { ties: Ties::named(name)?, ..TriangleConvention::default() },
    )
}

fn tied(
    question: &Question,
    convention: fn(Ties) -> TriangleConvention,
    tie: usize,
) -> Option<Answer> {
    coverage(question, &convention(Ties::named(TIES[tie])?))
}

/// Samples at the same distance from the pixel's upper left corner in x and y.
fn sampled(question: &Question, at: i32, tie: usize) -> Option<Answer> {
    let ties = Ties::named(TIES[tie])?;
    coverage(
        question,
        &TriangleConvention {
            shape: Shape::Point { x: at, y: at },
            ties,
            ..TriangleConvention::default()
        },
    )
}

fn cut(question: &Question, rounding: Rounding, tie: usize) -> Option<Answer> {
    let (quantum, ties) = (Quantum { step: SUBPIXELS, rounding }, Ties::named(TIES[tie])?);
    coverage(question, &TriangleConvention { quantum, ties, ..TriangleConvention::default() })
}

/// Every pixel of the bounding box, rounded outwards to whole pixels.
fn boxed(question: &Question) -> Option<Answer> {
    let Asked::Coverage(corners) = &question.of else { return None };
    let ends = |of: fn(&rasterproof_core::grid::SubpixelPoint) -> i32, side: u32| {
        let values = corners.each_ref().map(of);
        let (low, high) = (values.iter().min()?, values.iter().max()?);
        let ceiling = high.div_euclid(SUBPIXELS) + i32::from(high.rem_euclid(SUBPIXELS) > 0);
        Some((low.div_euclid(SUBPIXELS).max(0), ceiling.min(side as i32)))
    };
    let ((x0_px, x1_px), (y0, y1)) =
        (ends(|p| p.x, question.width)?, ends(|p| p.y, question.height)?);
    if twice_area(corners) == 0 || x0_px >= x1_px {
        return None;
    }
    Some(Answer::Coverage((y0..y1).map(|y_px| Span { y_px, x0_px, x1_px }).collect()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasterproof_judge::declared::Declared;

    /// Without an answer every mistake explains all of them, so all that the judge may find is listed; and each is looked for.
    #[test]
    fn mistakes_that_are_looked_for_can_be_found() {
        let truth = Truth::of(&Declared::default());
        let checks = [Check::Values, Check::Samples, Check::Depth, Check::Near];
        let found: Vec<_> =
            checks.iter().flat_map(|check| stages::explaining(*check, &[], &truth)).collect();
        for id in MistakeId::ALL {
            let is_looked_for = KNOWN.iter().any(|known| known.does.contains(&id));
            assert!(found.contains(&id) && is_looked_for, "{id:?}");
        }
    }
}
