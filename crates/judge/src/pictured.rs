//! The answers to a case as one picture, beside the one that was expected: what people are shown.
//!
//! What is no picture of pixels is made one. Of a pile it is the triangle with most wrong pixels, where
//! it is seen; of four samples a grid four times as fine, in whose cells' middles the samples lie; of a
//! polygon of clip space what it covers in x and y, before the division.

use super::ask::{Answer, Asked, Question};
use super::check::{Check, Truth, expected_answer};
use super::depth::Pile;
use super::judged::CaseJudgement;
use super::pixels::{hits_of, mesh_of, picture_of};
use super::{difference, mesh, near_plane, outline};
use rasterproof_core::frame::Coverage;
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::{PixelRect, SUBPIXELS, SubpixelPoint};
use rasterproof_core::triangle::{Corners, Span};
use rasterproof_render::pipeline::multisample;
use rasterproof_verify::cases::{Case, Shape};
use rasterproof_verify::oracle::Oracle;

/// Two pictures side by side: what was drawn, and what was expected or what another program drew.
#[derive(Clone, Debug, PartialEq)]
pub struct Pictured {
    /// What was drawn, by hits.
    pub drawn: Coverage,
    /// What the second of two compared programs drew.
    pub other: Option<Coverage>,
    pub expected: Coverage,
    /// What the picture is of, where it is not of the window as it was asked.
    pub of: String,
    /// The triangles as they lie in it, where that is not as they were asked.
    pub moved: Option<Vec<Corners>>,
}

/// The answers as one picture, and beside it what was expected; for checks that compare answers with
/// each other the first and the one that differs. Where the two are the same, it says what is wrong.
pub fn pictured(check: Check, case: &Case, answers: &[Answer], truth: &Truth) -> Option<Pictured> {
    let mut questions = Vec::new();
    check.questions(case, truth, &mut questions);
    // Of two programs, the picture of each is made on its own, and one stands where the expected one would.
    let mut picture = match &truth.of_two {
        Some(of_two) => {
            let [first, second] = difference::sides(answers);
            let of = |answers: &[Answer], truth| picture(check, case, (&questions, answers), truth);
            let second = of(&second, &of_two[1])?;
            let first = of(&first, &of_two[0])?;
            Pictured { other: Some(second.drawn).filter(|_| second.of == first.of), ..first }
        }
        None => picture(check, case, (&questions, answers), truth)?,
    };
    // Where both pictures are the same, words have to say what is wrong.
    let beside = picture.other.as_ref().unwrap_or(&picture.expected);
    if picture.drawn == *beside {
        let what = if answers.len() < questions.len() {
            // The program ended at one of them.
            Some("a request that is not answered".to_owned())
        } else {
            let judged = check.judge(case, answers, truth);
            judged.is_wrong().then(|| unseen(check, case, answers, &judged))
        };
        if let Some(what) = what {
            let space = if picture.of.is_empty() { "" } else { "; " };
            picture.of += &format!("{space}both pictures are the same; what differs is {what}");
        }
    }
    Some(picture)
}

/// What is wrong with answers whose picture is right.
fn unseen(check: Check, case: &Case, answers: &[Answer], judged: &CaseJudgement) -> String {
    let mut outside = 0;
    for answer in answers {
        if let Some((_, beyond)) = hits_of(answer, case.window) {
            outside += beyond;
        }
    }
    // What no picture shows: numbers, pixels outside of it, an order, a second hit, a value.
    let mut parts = Vec::new();
    match check {
        Check::Near => parts.push("z, w or the way round".to_owned()),
        Check::Carried => parts.push("an attribute, z, w or the way round".to_owned()),
        _ => {}
    }
    if let Some(Span { y_px, x0_px, x1_px }) = judged.backward {
        parts.push(format!("a run of row {y_px} from column {x0_px} to column {x1_px}"));
    } else if outside > 0 {
        parts.push(format!("{outside} pixels outside the window"));
    }
    if judged.finding.tally.order > 0 && check != Check::Depth {
        parts.push("the order in which the pixels come".to_owned());
    }
    if judged.finding.tally.twice > 0 {
        parts.push(format!("{} pixels that come twice", judged.finding.tally.twice));
    }
    if let Some((x, y)) = judged.worst_at.filter(|_| judged.finding.worst() > 1.0) {
        parts.push(format!("a value, at pixel ({x}, {y})"));
    }
    if judged.refused + judged.died.len() as u64 > 0 {
        parts.push("a request that is not answered".to_owned());
    }
    if parts.is_empty() { judged.describe(check) } else { parts.join(", ") }
}

/// The picture of a check, of one program. Each check has its own, since what is compared differs.
fn picture(
    check: Check,
    case: &Case,
    (questions, answers): (&[Question], &[Answer]),
    truth: &Truth,
) -> Option<Pictured> {
    // Most checks show the pixels of the window as they are.
    let plain = |drawn, expected| {
        Some(Pictured { drawn, other: None, expected, of: String::new(), moved: None })
    };
    let drawn: Vec<Coverage> = answers.iter().filter_map(|a| picture_of(a, case.window)).collect();
    match check {
        Check::Order | Check::Direction => {
            // Answers of the same program: the first one, and the first that differs from it.
            let (first, others) = drawn.split_first()?;
            let other = others.iter().find(|other| *other != first)?;
            plain(other.clone(), first.clone())
        }
        Check::Samples => Some(samples(questions, answers, case.window, truth)),
        Check::Near | Check::Carried => near(questions, answers, truth.declared.near_is_zero),
        Check::Watertight => {
            let Shape::Triangles { list, .. } = &case.shape else { return None };
            let drawn = mesh_of(answers, case.window)?;
            let corners: Vec<Corners> = list.iter().map(|t| t.corners()).collect();
            let expected = mesh::mended(&corners, &drawn);
            let of = "the triangles of the mesh together; expected is the same without holes and doubles";
            Some(Pictured { drawn, other: None, expected, of: of.to_owned(), moved: None })
        }
        Check::Outline => {
            let [drawn, expected] = outline::pictures(answers, case.window)?;
            let of = "the fill; expected is what the outline encloses, and on the outline the fill itself";
            Some(Pictured { drawn, other: None, expected, of: of.to_owned(), moved: None })
        }
        Check::Depth => pile(questions.first()?, answers.first()?, truth),
        _ => {
            // What was drawn and what was expected, each summed over all requests of the case.
            let expected = questions.iter().filter_map(|q| expected_answer(q, truth));
            let expected: Vec<_> = expected.filter_map(|e| picture_of(&e, case.window)).collect();
            plain(sum(&drawn, case.window)?, sum(&expected, case.window)?)
        }
    }
}

/// Several pictures as one: hits of the same pixel add up. Nothing where there is none.
fn sum(pictures: &[Coverage], window: PixelRect) -> Option<Coverage> {
    let mut whole = Coverage::new(window, 0);
    for (y, row) in pictures.iter().flat_map(Coverage::rows) {
        for (sum, hits) in whole.row_mut(y).iter_mut().zip(row) {
            *sum = sum.saturating_add(*hits);
        }
    }
    (!pictures.is_empty()).then_some(whole)
}

/// The triangle of a pile with most wrong pixels; an answer that names none shows none.
fn pile(question: &Question, answer: &Answer, truth: &Truth) -> Option<Pictured> {
    let Asked::Depth(list) = &question.of else { return None };
    let window = PixelRect::window(question.width, question.height);
    let runs = if let Answer::Seen(runs) = answer { &runs[..] } else { &[] };
    let pile = Pile::new(list, window, &*truth.expect, &truth.declared)?;
    let (triangle, [drawn, expected]) = pile.pictures(runs)?;
    let of =
        format!("where triangle {triangle} of the pile is seen, the one with most wrong pixels");
    Some(Pictured { drawn, other: None, expected, of, moved: None })
}

/// Cells of a pixel's side, so that each sample lies in the middle of one.
const FINER: i32 = 4;

/// The samples of all triangles, each in a cell of its own.
fn samples(
    questions: &[Question],
    answers: &[Answer],
    window: PixelRect,
    truth: &Truth,
) -> Pictured {
    // Both pictures are of a window that is as much finer as a pixel has cells.
    let finer = PixelRect {
        x0: window.x0 * FINER,
        y0: window.y0 * FINER,
        x1: window.x1 * FINER,
        y1: window.y1 * FINER,
    };
    let (mut drawn, mut expected) = (Coverage::new(finer, 0), Coverage::new(finer, 0));
    let mut moved = Vec::new();
    for (question, answer) in questions.iter().zip(answers) {
        let Asked::Samples(corners) = &question.of else { continue };
        moved.push(corners.map(|corner| {
            SubpixelPoint::new(corner.x.saturating_mul(FINER), corner.y.saturating_mul(FINER))
        }));
        // What is expected is exact, by the winding that is drawn.
        let is_drawn = truth.declared.convention.draws(twice_area(corners));
        let masks = multisample::masks(&Oracle, *corners, window).filter(|_| is_drawn);
        for (y, row) in masks.iter().flat_map(|masks| masks.rows()) {
            for (x, mask) in (window.x0..).zip(row) {
                hit_samples(&mut expected, x, y, *mask);
            }
        }
        let runs = if let Answer::Samples(runs) = answer { &runs[..] } else { &[] };
        for (run, mask) in runs {
            if !(window.y0..window.y1).contains(&run.y_px) {
                continue;
            }
            for x in run.x0_px.max(window.x0)..run.x1_px.min(window.x1) {
                hit_samples(&mut drawn, x, run.y_px, *mask);
            }
        }
    }
    let of = "the four samples of each pixel, in a grid of 4 x 4 cells for a pixel".to_owned();
    Pictured { drawn, other: None, expected, of, moved: Some(moved) }
}

/// Hits the cells of the samples of a pixel that a mask has.
fn hit_samples(picture: &mut Coverage, x_px: i32, y_px: i32, mask: u8) {
    for (bit, (x_16th, y_16th)) in multisample::SAMPLES.into_iter().enumerate() {
        let (x, y) = (x_px * FINER + x_16th / FINER, y_px * FINER + y_16th / FINER);
        picture.hit(y, x, x + i32::from(mask >> bit & 1));
    }
}

/// Cells that the longer side of a triangle of clip space spans at least.
const FEW_CELLS: f64 = 12.0;

/// What a polygon covers in x and y: an affine image of it, whatever w is.
fn near(questions: &[Question], answers: &[Answer], near_is_zero: bool) -> Option<Pictured> {
    let (question, answer) = (questions.first()?, answers.first()?);
    let triangle = &near_plane::asked(&question.of)?;
    let corners = triangle.corners().map(|p| p.to_px());
    let [mut x0, mut y0] = [f64::INFINITY; 2];
    let [mut x1, mut y1] = [f64::NEG_INFINITY; 2];
    for (x, y) in corners {
        (x0, x1) = (x0.min(x), x1.max(x));
        (y0, y1) = (y0.min(y), y1.max(y));
    }
    // The size of a cell depends on the triangle, since clip space has no pixels.
    let longer = (x1 - x0).max(y1 - y0);
    // The largest power of two of which it spans so many; corners stay on the lattice.
    let mut cell = 256.0;
    while longer / cell < FEW_CELLS && cell > 1.0 / 256.0 {
        cell /= 2.0;
    }
    let cells = |v: f64| (v / cell).floor() as i32;
    let window =
        PixelRect { x0: cells(x0) - 1, y0: cells(y0) - 1, x1: cells(x1) + 2, y1: cells(y1) + 2 };
    // What is left by the exact clipper, and what was answered, in x and y alone.
    let mut exact = Vec::new();
    for [x, y, ..] in near_plane::polygon(triangle, near_is_zero) {
        exact.push([x.to_f64(), y.to_f64()]);
    }
    let mut answered = Vec::new();
    for [x, y, ..] in answer.polygon().unwrap_or_default() {
        answered.push([*x, *y]);
    }
    let expected = fan(&exact, cell, window);
    let drawn = fan(&answered, cell, window);
    let [left, top] = [window.x0, window.y0].map(|v| f64::from(v) * cell);
    let of = format!(
        "x and y of clip space, before the division; a cell is {cell}, the first begins at {left}, {top}"
    );
    let on_cells = on_cells(&corners.map(|(x, y)| [x, y]), cell);
    let moved = on_cells.and_then(|corners| Some(vec![Corners::try_from(corners).ok()?]));
    Some(Pictured { drawn, other: None, expected, of, moved })
}

/// Positions in cells as positions in pixels; nothing where one is too far away or no number.
fn on_cells(corners: &[[f64; 2]], cell: f64) -> Option<Vec<SubpixelPoint>> {
    let mut points = Vec::new();
    for [x, y] in corners {
        let [x, y] = [x, y].map(|v| (v / cell * f64::from(SUBPIXELS)).round());
        // A number that is none is not less than any other.
        let is_in_reach = x.abs().max(y.abs()) < FARTHEST && !x.is_nan() && !y.is_nan();
        if !is_in_reach {
            return None;
        }
        points.push(SubpixelPoint::new(x as i32, y as i32));
    }
    Some(points)
}

/// How far from the origin a position in cells may lie, in subpixels.
const FARTHEST: f64 = (1 << 28) as f64;

/// A polygon as triangles around its first corner; nothing of one that cannot be drawn.
fn fan(corners: &[[f64; 2]], cell: f64, window: PixelRect) -> Coverage {
    let mut picture = Coverage::new(window, 0);
    let corners = on_cells(corners, cell).unwrap_or_default();
    // Each triangle of the fan has the first corner and two neighbours.
    let Some((first, rest)) = corners.split_first() else { return picture };
    for pair in rest.windows(2) {
        let mut hit = |span: Span| picture.hit(span.y_px, span.x0_px, span.x1_px);
        Oracle.spans([*first, pair[0], pair[1]], window, &mut hit);
    }
    picture
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::declared::Declared;
    use rasterproof_verify::cases::Triangle;
    use rasterproof_verify::cases::near_plane::{ClipCorner, FAMILIES, clip_corners};
    use rasterproof_verify::oracle::values::Exact;

    fn pictures(check: Check, case: &Case, answers: &[Answer]) -> Pictured {
        let truth = Truth::of(&Declared::default());
        pictured(check, case, answers, &truth).unwrap()
    }

    /// The right polygon is the picture that is expected; a part of the triangle is missing or extra in
    /// that of no clipping at all, and of a corner left out.
    #[test]
    fn polygons_are_pictures() {
        let mut differ = [0; 2];
        for index in 0..100 {
            let case = FAMILIES[1].case(1, index);
            let Shape::Triangles { list, .. } = &case.shape else { panic!("triangles") };
            let corners = clip_corners(&list[0]);
            let exact: Vec<ClipCorner> = near_plane::polygon(&list[0], false)
                .iter()
                .map(|c| c.each_ref().map(Exact::to_f64))
                .collect();
            let of = |polygon: &[ClipCorner]| {
                pictures(Check::Carried, &case, &[Answer::Carried(polygon.to_vec())])
            };
            let right = of(&exact);
            assert_eq!(right.drawn, right.expected, "{index}");
            let few = FEW_CELLS as u32;
            let side = right.drawn.bounds().width().max(right.drawn.bounds().height());
            assert!((few..2 * few + 6).contains(&side), "{index}: {side}");
            let [whole, cut] = [&corners[..], &exact[..exact.len().min(2)]].map(of);
            differ[0] += usize::from(whole.drawn != whole.expected);
            differ[1] += usize::from(cut.drawn != cut.expected);
        }
        assert!(differ.iter().all(|n| *n > 50), "{differ:?}");
    }

    /// In the finer grid the samples are centres of cells: what the mask says of one, the oracle says of
    /// its cell.
    #[test]
    fn samples_are_cells() {
        let p = |x, y| SubpixelPoint::from_px(x, y).unwrap();
        let vertex = |position| rasterproof_core::triangle::ScreenVertex {
            position,
            depth: 0.0,
            inv_w: 1.0,
            varying: glam::DVec2::ZERO,
        };
        let triangle = Triangle { vertices: [p(0.0, 0.0), p(2.5, 0.0), p(0.0, 1.75)].map(vertex) };
        let case = Case {
            window: PixelRect::window(3, 2),
            shape: Shape::Triangles { list: vec![triangle], disjoint: false },
        };
        let all = Answer::Samples(vec![
            (Span { y_px: 0, x0_px: 0, x1_px: 3 }, 15),
            (Span { y_px: 1, x0_px: 0, x1_px: 3 }, 15),
        ]);
        let picture = pictures(Check::Samples, &case, &[all]);
        let corners = picture.moved.as_ref().unwrap()[0];
        let mut cells = Coverage::new(picture.drawn.bounds(), 0);
        Oracle.spans(corners, cells.bounds(), &mut |s| cells.hit(s.y_px, s.x0_px, s.x1_px));
        let mut covered = 0;
        for ((_, all), ((_, cells), (_, expected))) in
            picture.drawn.rows().zip(cells.rows().zip(picture.expected.rows()))
        {
            for ((all, cell), expected) in all.iter().zip(cells).zip(expected) {
                assert_eq!(*expected, all * cell);
                covered += u64::from(*expected);
            }
        }
        assert_eq!(picture.drawn.covered(), 24);
        assert!(covered > 5 && covered < 20, "{covered}");
    }
}
