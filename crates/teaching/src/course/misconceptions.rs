//! What a wrong program believes: for each typical misconception, the answers that it leads to.
//!
//! A misconception is named where all answers of a step that it speaks about are the ones that it predicts, and some of
//! them are wrong. Predictions are computed from the request alone: by [`rasterproof_verify::convention`] where a convention is
//! mistaken, by [`stages`] where values, depths, samples or the near plane are, by `wrong_formulas` of formulas, and here for the rest. A program with two mistakes at once
//! follows none of them, and nothing is named.

use std::ops::Range;

use super::wrong_formulas::{self, Wrong};
use Prediction::*;
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

/// What a program was found to believe.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Misconception {
    pub name: &'static str,
    /// What the program does, as said to the student.
    pub says: &'static str,
    /// What to think about before the first hint.
    pub ask: &'static str,
}

/// What a misconception makes of a request. Where a sample may lie on an edge, the name of a rule for such samples goes with it.
#[derive(Clone, Copy)]
enum Prediction {
    /// The answer of a function without a body, where it is to set pixels.
    NothingDrawn,
    /// A line between a pixel and itself has that pixel once for each end.
    PointTwice,
    /// A line is not cut to the window, or is cut along its longer axis alone.
    Uncut { is_major_cut: bool },
    /// Pixels of a line are left out at its ends.
    LineEnds(Ends),
    /// The second coordinate is rounded in another way.
    LineRounds(LineRounding),
    /// A line always begins at the end with the smaller coordinate along its longer axis.
    FromSmallerEnd,
    /// A line has a pixel for each column; halves go down the window, or on from the left end.
    AlongX { goes_on: bool },
    /// x and y of each pixel are exchanged; what then lies outside the window is left out, or drawn.
    LineExchanged { is_cut: bool },
    /// Another rule for samples on edges, and nothing else.
    Rule(&'static str),
    /// The whole picture is turned over, or x and y are exchanged in it.
    Mirrored(Mirror, &'static str),
    /// Triangles of one winding are drawn.
    OneWinding(Windings, &'static str),
    /// Samples at the same distance from the pixel's upper left corner in x and y.
    SampledAt(i32, &'static str),
    /// The corners are moved to whole pixels before anything is drawn.
    Cut(Rounding, &'static str),
    /// A triangle has every pixel of its bounding box, cut at the window.
    WholeBox,
    /// A formula is answered with an empty list.
    NoNumber,
    /// The numbers of a formula are those of a known mistake.
    Formula(Wrong),
}

/// A misconception, and what it leads to.
struct KnownMisconception {
    is: Misconception,
    /// Any one of these is to explain every answer.
    predicts: &'static [Prediction],
    /// The mistakes that the judge finds in whoever does this, of [`stages`].
    does: &'static [MistakeId],
}

/// Writes an entry for each misconception: its texts, then what it predicts in brackets, or the judge's mistakes in angle brackets, or
/// the mistakes about a formula in braces.
macro_rules! known {
    ($($name:literal, $says:literal, $ask:literal,
        $([$($predicts:expr),+ $(,)?])? $(<$($does:ident),+>)?
        $({$formula:ident: $($wrong:ident $(($threshold:literal))?),+})?;)*) => {
        &[$(KnownMisconception {
            is: Misconception { name: $name, says: $says, ask: $ask },
            predicts: &[
                $($($predicts),+)?
                $($(Formula(Wrong::$formula(wrong_formulas::$formula::$wrong $(($threshold))?))),+)?
            ],
            does: &[$($(MistakeId::$does),+)?],
        }),*]
    };
}

/// Every misconception that is known, the more particular ones first.
const KNOWN: &[KnownMisconception] = known![
    "nothing", "you draw nothing",
    "Your function returns and has set no pixel. Which pixel should the request above set first?",
    [NothingDrawn];

    "twice", "you draw a pixel twice where both ends of a line are the same pixel",
    "Both ends are drawn. How many pixels has a line that begins and ends in the same pixel?",
    [PointTwice];

    "outside", "you draw pixels outside the window",
    "Take a window that is 4 pixels wide. Which numbers have its columns, and what does your test say about -1 and about 4?",
    [Uncut { is_major_cut: false }, Uncut { is_major_cut: true }];

    "lost-end-pixel", "your line ends one pixel early",
    "How many pixels has a line from column 0 to column 5, and how often does your loop run?",
    [LineEnds(Ends::WithoutLast),
     LineEnds(Ends::WithoutFirst),
     LineEnds(Ends::WithoutRight)];

    "reversed-line", "your pixels come from the end with the smaller coordinate, whichever end was named first",
    "The request names two ends. Which of your pixels comes first for a line drawn from right to left?",
    [FromSmallerEnd];

    "truncated-line", "you cut the second coordinate instead of rounding it",
    "A line is at height 0.9 in some column. In which row is the nearest pixel, and which one does a cast to int give?",
    [LineRounds(LineRounding::Down),
     LineRounds(LineRounding::Toward(End::Small)),
     LineRounds(LineRounding::Toward(End::First))];

    "line-ties", "a tie of your lines depends on the direction of drawing, or goes the other way",
    "The line passes exactly between two pixels. Which one do you take on the way there, and which one on the way back?",
    [LineRounds(LineRounding::Nearest(LineTie::FirstGo)), LineRounds(LineRounding::Nearest(LineTie::FirstStay)),
     LineRounds(LineRounding::Nearest(LineTie::SmallStay)), LineRounds(LineRounding::Nearest(LineTie::Up)),
     LineRounds(LineRounding::Nearest(LineTie::Down)), LineRounds(LineRounding::Nearest(LineTie::Even))];

    "one-axis", "you always walk along x, so steep lines have gaps",
    "A line goes down 10 rows and across 2 columns. How many pixels does one step in x skip?",
    [AlongX { goes_on: false },
     AlongX { goes_on: true }];

    "transposed", "x and y are exchanged in your picture",
    "Which of the two numbers of a pixel comes first in the answer, and which one indexes a row of your array?",
    [LineExchanged { is_cut: true },
     LineExchanged { is_cut: false },
     Mirrored(Mirror::Exchanged, "top-left")];

    "strict", "you draw no sample that lies exactly on an edge",
    "Two triangles share an edge that passes through a pixel's centre. Which of them draws that pixel, if both do as you do?",
    [Rule("strict")];

    "inclusive", "you draw every sample that lies exactly on an edge",
    "Two triangles share an edge that passes through a pixel's centre. How often is that pixel drawn, if both do as you do?",
    [Rule("inclusive")];

    "y-up", "you use the rule of a y axis that points up: bottom and left edges instead of top and left ones",
    "Row 0 is at the top of the window. Which sign has the y step of an edge that runs up on the screen?",
    [Rule("bottom-left"),
     Mirrored(Mirror::UpsideDown, "top-left"),
     Mirrored(Mirror::UpsideDown, "inclusive")];

    "right-edges", "you keep samples on right edges and drop those on left ones",
    "Take the square from 0.5 to 3.5. Which three columns should it have, and which three has yours?",
    [Rule("top-right"), Rule("bottom-right")];

    "winding", "you draw triangles of one winding alone",
    "Exchange two corners of a triangle: which sign has the area now, and what does your test do with it?",
    [OneWinding(Windings::Clockwise, "top-left"),
     OneWinding(Windings::Clockwise, "inclusive"),
     OneWinding(Windings::Clockwise, "strict"),
     OneWinding(Windings::CounterClockwise, "top-left"),
     OneWinding(Windings::CounterClockwise, "inclusive"),
     OneWinding(Windings::CounterClockwise, "strict")];

    "corner-samples", "your samples are at the corners of pixels, not at their centres",
    "Where is the centre of the pixel in column 3? A triangle covers 3.2 to 3.9: does it cover that centre, and your sample?",
    [SampledAt(0, "top-left"), SampledAt(0, "inclusive"), SampledAt(0, "strict")];

    "half-off", "your samples are half a pixel too far: at the lower right corners of pixels",
    "How much do you add to the number of a column to come to the centre of its pixels?",
    [SampledAt(SUBPIXELS, "top-left"), SampledAt(SUBPIXELS, "inclusive"), SampledAt(SUBPIXELS, "strict")];

    "truncated-corners", "you cut the corners to whole pixels before you draw",
    "What becomes of a triangle whose corners are 0.25, 0.5 and 0.75 px from each other, once they are int?",
    [Cut(Rounding::TowardZero, "top-left"), Cut(Rounding::TowardZero, "inclusive"),
     Cut(Rounding::TowardZero, "strict"), Cut(Rounding::Down, "top-left"),
     Cut(Rounding::Down, "inclusive"), Cut(Rounding::Down, "strict")];

    "rounded-corners", "you round the corners to whole pixels before you draw",
    "Two corners are 0.3 px apart. Are they still two, once they are whole numbers?",
    [Cut(Rounding::Near, "top-left"), Cut(Rounding::Near, "inclusive"), Cut(Rounding::Near, "strict")];

    "clamped-weights", "you draw the whole bounding box: weights that are clamped to 0 and 1 are never outside",
    "What does a negative weight say about a sample, and what is left of it after clamping?",
    [WholeBox];

    "no-perspective", "your attributes are linear in the window: they are not divided by w",
    "An edge runs from w = 1 to w = 3. Is its middle in the window nearer to the first or to the second corner in space?",
    <Affine>;

    "one-division", "you divide the attributes by w and never by the interpolated 1/w",
    "An attribute is 1 at all three corners, which have w = 2. What does your formula give inside?",
    <NotDividedBack>;

    "times-w", "you multiply by w where you should divide",
    "Which of two corners should count more in the middle of the window: the near one with w = 1 or the far one with w = 3?",
    <WeightsByW>;

    "transposed-matrix", "the matrix that gives your weights is transposed",
    "A matrix takes a point to its three weights. Are the corners its rows or its columns, and what does it make of corner a?",
    <TransposedMatrix>;

    "swapped-weights", "for one winding you exchanged two corners and not their values",
    "You exchanged b and c to make the area positive. To which corner does the second weight belong now?",
    <ExchangedWeights>;

    "corner-values", "your values are those at the upper left corner of each pixel, not at its centre",
    "A value grows by 1 per pixel from 0 at x = 0. What is it at the centre of column 0?",
    <UpperLeftValues>;

    "depth-not-divided", "your depths are not divided by the area, so that large triangles seem far",
    "A triangle has z = 0.5 at all corners. What does your sum give before the division by its area?",
    <DepthNotDivided, DepthNotDividedBySign, UndividedDepthsCompared>;

    "depth-divided-twice", "you divide z by w again: the z of the request has been divided already",
    "z / w is linear in the window. What is linear about z / w / w?",
    <DepthDividedTwice>;

    "depth-in-perspective", "you interpolate z in perspective, like an attribute",
    "a is linear in space, z / w is linear in the window. Which of the two kinds is the z of the request?",
    <DepthInPerspective>;

    "last-wins", "the triangle that is drawn last is seen, whatever its depth",
    "Draw the near triangle first and the far one after it. Which one should be seen?",
    <LastShown>;

    "farthest-wins", "the greatest depth is seen instead of the least",
    "z is 0 at the near plane and 1 at the far one. Which of 0.2 and 0.8 hides the other?",
    <FarthestShown>;

    "mean-depth", "you order whole triangles by their mean depth",
    "Two triangles go through one another. Which of them is in front?",
    <SortedByMeanDepth>;

    "unclipped", "you return the triangle as it came: nothing is cut at the near plane",
    "A corner lies behind the eye. What is x / w there, and on which side of the picture does it appear?",
    <NotClipped>;

    "dropped", "you drop every triangle that has a corner on the eye's side of the near plane",
    "You stand on a large floor. Where are its corners, and what would be left of it?",
    <CutTrianglesDropped>;

    "plane-z-zero", "you cut at z = 0; the near plane is z = -w",
    "The near plane becomes z / w = -1. Which sum of z and w is zero there?",
    <ClippedAtZero>;

    "pixel-samples", "your four samples are all at the centre: a pixel has all of them or none",
    "Where is sample 1, if (14, 6) sixteenths are counted from the pixel's upper left corner?",
    <SamplesAtCentre>;

    "square-samples", "your samples lie in a square grid",
    "Draw the four places (6, 2), (14, 6), (2, 10), (10, 14) into a pixel. How many columns do they occupy?",
    <SamplesInSquare>;

    "reversed-bits", "you count the bits of the mask from the other end",
    "Which number has bit 0 set and no other bit?",
    <SamplesBackwards>;

    "no-number", "you return no number",
    "The answer of a formula is a list of numbers. Which is the first one for the request above?",
    [NoNumber];

    "undivided", "you do not divide by z",
    "Two poles stand one behind the other, at z = 2 and z = 4. At which two places of the film do you draw them?",
    {Project: TimesFilm, AsItCame};

    "film-forgotten", "you divide by z and leave out the distance of the film",
    "The film moves away, from distance 1 to distance 2. What becomes of the size of the picture?",
    {Project: FilmForgotten};

    "by-distance", "you divide by the way from the eye to the point, not by its distance along z",
    "A straight fence stands parallel to the film. Does your picture of it have the same height everywhere?",
    {Project: ByWay, ByWayAsW};

    "w-lost", "your w is 1, as if the point had been divided already",
    "Which number does the perspective of step 5 need that x/z and y/z no longer have?",
    {Project: WLost};

    "size-less-1", "you multiply by the size of the window less 1",
    "A window is 5 pixels wide. At which x does its right border lie?",
    {Window: SizeLess1};

    "y-not-turned", "your y counts from the bottom of the window",
    "A point is above the middle of the film. Is its row less or more than half of the height?",
    {Window: YNotTurned};

    "depth-not-halved", "your depth runs from -1 to 1",
    "z'/w' is -1 at the near plane. Which depth should be stored there?",
    {Window: DepthNotHalved};

    "linear-depth", "your depth is linear in z",
    "What has to be linear so that step 6 can interpolate it in the window: z, or a + b/z?",
    {Window: LinearDepth};

    "film-at-1", "you forget that the film stands at the near plane",
    "The film from -1 to 1 stands at the distance n. Where on it does a point at x = n, z = n lie?",
    {Window: FilmAt1};

    "unsnapped", "you decide by the corners before they are snapped",
    "Which triangle is drawn: the one that is asked for, or the one on the grid? Which of the two has to be a front?",
    {Winding: AsGiven(0.0)};

    "winding-y-up", "your signs are those of a y axis that points up",
    "Draw (1, 1), (4, 1), (1, 4) with y down. Which way do they run?",
    {Winding: YUp};

    "area-threshold", "you count triangles of a small area as having none",
    "A sliver is 100 px long and 1/256 px high. May a sample lie in it, and what is its area?",
    {Winding: Snapped(1e-4), Snapped(1e-3), Snapped(1e-2), AsGiven(1e-4), AsGiven(1e-3), AsGiven(1e-2)};

    "area-returned", "you return the area and not its sign",
    "The answer is 1, -1 or 0. Which of them is an area of 9?",
    {Winding: Area, AreaSnapped, AreaInSubpixels};

    "turned-back", "you turn the other way: your matrices are transposed",
    "A quarter turn about z takes the x axis to the y axis. Where does yours take (1, 0, 0)?",
    {Turn: Back};

    "about-y-back", "your turn about y goes from x to z; the others are right",
    "In the ring x, y, z, x: which axis comes after z? So where does a turn about y take z?",
    {Turn: AboutYBack};

    "about-origin", "you turn about the origin: the centre has no part in it",
    "What should become of the centre itself, and what becomes of it with you?",
    {Turn: AboutOrigin};

    "centre-back", "you move by the centre where you should move by its opposite, and back",
    "In the product of three matrices, which one acts first: the left or the right one?",
    {Turn: CentreBack};

    "not-moved-back", "you turn about the centre and do not move back",
    "After the first move the centre lies in the origin. Where does it lie in the end?",
    {Turn: NotMovedBack};

    "normal-as-point", "you multiply normals with the matrix, as if they were points",
    "A surface is stretched along x. Does it lean more or less, and what becomes of your normal?",
    {Normal: AsPoint};

    "transposed-alone", "you transpose the matrix for normals and do not invert it",
    "The matrix scales by 2. By what should it divide the normal?",
    {Normal: TransposedAlone};

    "inverted-alone", "you invert the matrix for normals and do not transpose it",
    "The inverse of a turn is its transpose. Which matrix do normals get under a turn?",
    {Normal: InvertedAlone};

    "dark-light", "what faces away from the light loses light",
    "The cosine is -0.5 and the ambient light 0.2. How bright is the surface?",
    {Light: Dark, DarkCut};

    "lit-behind", "what faces away from the light is lit, too",
    "Which sign has the cosine where the light comes from behind the surface?",
    {Light: LitBehind};

    "long-normal", "you do not divide by the length of the normal",
    "Two normals at a right angle are interpolated. How long is the one in the middle?",
    {Light: LongNormal, LongNormalCut};

    "texel-corners", "your texels have their values at their left borders",
    "Where in a texel does the bilinear look-up read exactly its value?",
    {Texel: Corners};

    "clamped-texels", "the borders of your texture go on; it should begin again",
    "Which texel lies to the left of the first one of a floor that repeats?",
    {Texel: Clamped};

    "texels-less-1", "you multiply u by the number of texels less 1",
    "A texture has 4 texels. How many texels from its left border is u = 1?",
    {Texel: Less1, Less1Corners};

    "level-in-window", "your u and v change evenly in the window",
    "Which of u, u/w and 1/w are linear in the window?",
    {Level: InWindow};

    "one-direction", "you look at the step to the next pixel in one direction alone",
    "A floor seen from low above: in which direction do the texels of two neighbours lie far apart?",
    {Level: AcrossAlone, DownAlone};

    "shorter-direction", "you take the shorter of both steps, or their sum",
    "A pixel meets a strip of 2 by 16 texels. At which level does a read no longer skip any of them?",
    {Level: Shorter, Sum};

    "other-logarithm", "you take another logarithm than that to the base 2, or none",
    "How much longer is a texel of the next level?",
    {Level: NaturalLogarithm, NoLogarithm};

    "size-forgotten", "you count in parts of the texture, not in texels",
    "u grows by 1/64 from pixel to pixel, in a texture of 256 texels. How many texels is that?",
    {Level: SizeForgotten};

    "whole-level", "you round the level, or hold it at 0",
    "Which level lies halfway between 1 and 2, and what does a program read there?",
    {Level: Floor, Round, NotBelow0};
];

/// The names of all, for those who list them.
pub fn all() -> impl Iterator<Item = &'static Misconception> {
    KNOWN.iter().map(|known| &known.is)
}

/// What explains the answers of a program to an exercise that it fails, if anything that is known does.
pub fn find(check: Check, asked: &[Answered], truth: &Truth) -> Option<&'static Misconception> {
    // Who is right believes nothing wrong.
    if !asked.iter().any(|case| case.is_wrong) {
        return None;
    }
    // Of a program that did not answer, the answers that are there say too little.
    // What the judge finds by itself, which it can where everything was answered.
    let mut answers = asked.iter().flat_map(|case| &case.answers);
    let does = match answers.any(|one| matches!(one, Answer::Died(_) | Answer::Refused(_))) {
        true => Vec::new(),
        false => stages::explaining(check, asked, truth),
    };
    // The first one that explains everything, for the more particular ones come first.
    for known in KNOWN {
        if known.predicts.iter().any(|predicted| predicted.explains(asked, truth))
            || known.does.iter().any(|mistake| does.contains(mistake))
        {
            return Some(&known.is);
        }
    }
    None
}

impl Prediction {
    /// Whether the program has answered what is predicted, wherever something is, and has been wrong there at least once.
    fn explains(self, asked: &[Answered], truth: &Truth) -> bool {
        // A misconception that predicts right answers alone explains nothing.
        let mut is_wrong = false;
        for case in asked {
            for (question, answer) in case.questions.iter().zip(&case.answers) {
                let Some(predicted) = self.answer(question, truth) else { continue };
                if !is_same(question, answer, &predicted) {
                    return false;
                }
                is_wrong |= case.is_wrong;
            }
        }
        is_wrong
    }

    /// The answer that it leads to; nothing for a request that it does not speak about.
    fn answer(self, question: &Question, truth: &Truth) -> Option<Answer> {
        let line = LineConvention::default();
        let right = TriangleConvention::default();
        match self {
            NothingDrawn => nothing(question),
            PointTwice => point_twice(question, truth),
            Uncut { is_major_cut } => uncut_line(question, is_major_cut),
            LineEnds(ends) => line_by(question, LineConvention { ends, ..line }),
            LineRounds(rounding) => line_by(question, LineConvention { rounding, ..line }),
            FromSmallerEnd => sorted_line(question, truth),
            AlongX { goes_on } => along_x(question, truth, goes_on),
            LineExchanged { is_cut } => exchanged_line(question, truth, is_cut),
            Rule(ties) => covered(question, ties, right),
            Mirrored(mirror, ties) => {
                covered(question, ties, TriangleConvention { mirror, ..right })
            }
            OneWinding(draws, ties) => {
                covered(question, ties, TriangleConvention { draws, ..right })
            }
            SampledAt(at, ties) => {
                let shape = Shape::Point { x: at, y: at };
                covered(question, ties, TriangleConvention { shape, ..right })
            }
            Cut(rounding, ties) => {
                let quantum = Quantum { step: SUBPIXELS, rounding };
                covered(question, ties, TriangleConvention { quantum, ..right })
            }
            WholeBox => whole_box(question),
            NoNumber if matches!(question.of, Asked::Formula(..)) => {
                Some(Answer::Numbers(Vec::new()))
            }
            NoNumber => None,
            Formula(wrong) => {
                let Asked::Formula(asked, numbers) = &question.of else { return None };
                wrong.of(*asked, numbers).map(Answer::Numbers)
            }
        }
    }
}

/// Whether two lists of numbers are the same within the tolerance of a formula, or of what they are themselves.
fn are_near(question: &Question, a: &[f64], b: &[f64]) -> bool {
    let Asked::Formula(formula, numbers) = &question.of else { return false };
    let Some(exact) = formula.of(numbers) else { return false };
    // What is no number is near to nothing, which `<=` says and `>` would not.
    let mut are_near = a.len() == b.len();
    for ((a, b), given) in a.iter().zip(b).zip(&exact) {
        are_near &= (a - b).abs() <= DEFAULT_TOLERANCE * given.scale.max(a.abs());
    }
    are_near
}

/// Whether two answers say the same, whatever words they say it in.
fn is_same(question: &Question, a: &Answer, b: &Answer) -> bool {
    let window = PixelRect::window(question.width, question.height);
    match (a, b) {
        (Answer::Line(a), Answer::Line(b)) => a == b,
        (Answer::Numbers(a), Answer::Numbers(b)) => are_near(question, a, b),
        // Runs may be cut in other places, and a pixel may be drawn twice.
        (Answer::Coverage(_), Answer::Coverage(_)) => {
            picture_of(a, window) == picture_of(b, window)
        }
        _ => a == b,
    }
}

/// The request for a line in the words of the conventions; nothing for other requests.
fn line_question(question: &Question) -> Option<LineQuestion> {
    let Asked::Line { ends, .. } = &question.of else { return None };
    let window = PixelRect::window(question.width, question.height);
    Some(LineQuestion { ends: ends.map(|end| [end.x, end.y]), window })
}

/// The pixels of a line by a convention, of a request for a line.
fn line_by(question: &Question, convention: LineConvention) -> Option<Answer> {
    line_answer(&line_question(question)?, &convention)
}

/// The pixels of a line in a window, as an answer.
fn line_answer(asked: &LineQuestion, convention: &LineConvention) -> Option<Answer> {
    let pixels = convention.pixels(asked)?;
    Some(Answer::Line(pixels.into_iter().map(|[x, y]| (x, y)).collect()))
}

/// An empty answer, for the requests whose answers are pixels.
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

/// The right pixels, and that of a point once more.
fn point_twice(question: &Question, truth: &Truth) -> Option<Answer> {
    let Some(Answer::Line(mut pixels)) = expected_answer(question, truth) else { return None };
    let [a, b] = line_question(question)?.ends;
    // The line of the right answer has this one pixel.
    if a == b {
        pixels.extend_from_within(..);
    }
    Some(Answer::Line(pixels))
}

/// The right pixels in a larger window.
fn uncut_line(question: &Question, is_major_cut: bool) -> Option<Answer> {
    let asked = line_question(question)?;
    let [a, b] = asked.ends;
    let major = longer_axis(asked.ends);
    // A window that holds the whole line, or its part within the columns or rows of the true one.
    let (mut low, mut high) = ([0; 2], [question.width as i32, question.height as i32]);
    for axis in 0..2 {
        let (first, end) = (a[axis].min(b[axis]), a[axis].max(b[axis]).checked_add(1)?);
        let is_cut = is_major_cut && axis == major;
        low[axis] = if is_cut { first.max(0) } else { first };
        high[axis] = if is_cut { end.min(high[axis]) } else { end };
    }
    let window = PixelRect { x0: low[0], y0: low[1], x1: high[0], y1: high[1] };
    line_answer(&LineQuestion { window, ..asked }, &LineConvention::default())
}

/// The axis along which the ends are farther apart: 0 for x, 1 for y.
fn longer_axis([a, b]: [[i32; 2]; 2]) -> usize {
    usize::from(a[1].abs_diff(b[1]) > a[0].abs_diff(b[0]))
}

/// The right pixels, those of some lines from the last to the first.
fn sorted_line(question: &Question, truth: &Truth) -> Option<Answer> {
    let Some(Answer::Line(mut pixels)) = expected_answer(question, truth) else { return None };
    let [a, b] = line_question(question)?.ends;
    let major = longer_axis([a, b]);
    if b[major] < a[major] {
        pixels.reverse();
    }
    Some(Answer::Line(pixels))
}

/// A pixel for each column, in the order of drawing.
fn along_x(question: &Question, truth: &Truth, goes_on: bool) -> Option<Answer> {
    let LineQuestion { ends: [a, b], window } = line_question(question)?;
    let [a, b] = [a, b].map(|end| end.map(i64::from));
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    // A flat line is drawn rightly, and a vertical one has a single column.
    if dx == 0 {
        return None;
    }
    if dy.abs() <= dx.abs() {
        return expected_answer(question, truth);
    }
    let (left, steps) = if dx < 0 { (b, -dx) } else { (a, dx) };
    // Of a mirrored line, half a step more is half a step less.
    // The row of column x is the left end's plus slope (x - left) / steps, rounded at a half.
    let slope = dy * dx.signum();
    let half = if goes_on && slope < 0 { steps - 1 } else { steps };
    let mut pixels = Vec::new();
    for x in (left[0]..=left[0] + steps).take(1 << 16) {
        let y = left[1] + (2 * slope * (x - left[0]) + half).div_euclid(2 * steps);
        if (0..i64::from(window.x1)).contains(&x) && (0..i64::from(window.y1)).contains(&y) {
            pixels.push((x as i32, y as i32));
        }
    }
    if dx < 0 {
        pixels.reverse();
    }
    Some(Answer::Line(pixels))
}

/// The right pixels with x and y exchanged, all of them or those that lie in the window then.
fn exchanged_line(question: &Question, truth: &Truth, is_cut: bool) -> Option<Answer> {
    let Some(Answer::Line(pixels)) = expected_answer(question, truth) else { return None };
    let mut exchanged = Vec::new();
    for (x, y) in pixels {
        // Where the window is not a square, some pixels leave it.
        if !is_cut || y < question.width as i32 && x < question.height as i32 {
            exchanged.push((y, x));
        }
    }
    Some(Answer::Line(exchanged))
}

/// The pixels of a triangle by a convention, with a rule for samples on edges.
fn covered(question: &Question, ties: &str, convention: TriangleConvention) -> Option<Answer> {
    let Asked::Coverage(corners) = &question.of else { return None };
    let convention = TriangleConvention { ties: Ties::named(ties)?, ..convention };
    let window = PixelRect::window(question.width, question.height);
    let drawn = convention.cover(corners, window)?;
    let runs = drawn.runs().map(|(y_px, x0_px, x1_px)| Span { y_px, x0_px, x1_px });
    Some(Answer::Coverage(runs.collect()))
}

/// The rows of the bounding box; nothing of a triangle that covers nothing anyway.
fn whole_box(question: &Question) -> Option<Answer> {
    let Asked::Coverage(corners) = &question.of else { return None };
    let columns = whole_pixels(corners.map(|corner| corner.x), question.width);
    let rows = whole_pixels(corners.map(|corner| corner.y), question.height);
    if twice_area(corners) == 0 || columns.is_empty() {
        return None;
    }
    let run = |y_px| Span { y_px, x0_px: columns.start, x1_px: columns.end };
    Some(Answer::Coverage(rows.map(run).collect()))
}

/// The columns or rows of a window that lie between coordinates, rounded outwards to whole pixels.
fn whole_pixels([a, b, c]: [i32; 3], size: u32) -> Range<i32> {
    let (low, high) = (a.min(b).min(c), a.max(b).max(c));
    // Rounded upwards, so that the last pixel that is touched belongs to the box.
    let ceiling = high.div_euclid(SUBPIXELS) + i32::from(high.rem_euclid(SUBPIXELS) > 0);
    low.div_euclid(SUBPIXELS).max(0)..ceiling.min(size as i32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasterproof_judge::declared::Declared;

    /// A rule that is misspelt would predict nothing, and its misconception would never be found.
    #[test]
    fn rules_have_names() {
        for predicted in KNOWN.iter().flat_map(|known| known.predicts) {
            if let Rule(ties)
            | Mirrored(_, ties)
            | OneWinding(_, ties)
            | SampledAt(_, ties)
            | Cut(_, ties) = predicted
            {
                assert!(Ties::named(ties).is_some(), "{ties}");
            }
        }
    }

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
