//! Which of several triangles is seen, by the exact depths at the sample of each pixel.
//!
//! Less depth is nearer. A program may be off by its tolerance times the largest depth, at the triangle
//! that it shows and at the nearest one: so a triangle may be seen that is at most twice that behind.
//! At equal depths nothing is promised: a sum of weighted depths is rounded otherwise in each.

use super::declared::Declared;
use super::expected::{Expect, exact_values};
use super::judged::{CaseJudgement, push};
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::Span;
use rasterproof_verify::cases::Triangle;
use rasterproof_verify::comparison::Expectation;
use rasterproof_verify::comparison::pixels::{hits, mix};
use rasterproof_verify::oracle::values::ExactTriangle;

/// One triangle of a pile: the pixels that it has to cover, those that it may, and its depths.
struct Layer {
    /// The pixels that the triangle covers by every reading of the convention.
    must: Coverage,
    /// Those, and the pixels of which nothing is promised.
    may: Coverage,
    /// Its exact depths; nothing of a triangle without area.
    depths: Option<ExactTriangle<2>>,
}

/// What is sure of a pile.
#[derive(Default)]
pub(super) struct SurePixels {
    /// Each with the number of the triangle that is seen there.
    pub seen: Vec<([i32; 2], usize)>,
    /// Pixels of which nothing is sure.
    pub open: Vec<[i32; 2]>,
}

/// What may be seen at a pixel.
struct SeenTriangles {
    /// The triangles that may be seen, nearest first.
    triangles: Vec<usize>,
    /// Whether one of them has to be.
    has_to_be: bool,
}

/// The triangles of a question about depth, with what may be seen of each.
pub(super) struct Pile {
    layers: Vec<Layer>,
    window: PixelRect,
    /// How much farther than the nearest a triangle may lie that is seen.
    allowance: f64,
}

impl Pile {
    /// The pile under a convention; nothing where that promises nothing of one of its triangles.
    pub fn new(
        list: &[Triangle],
        window: PixelRect,
        expect: &dyn Expect,
        declared: &Declared,
    ) -> Option<Self> {
        // What each triangle has to cover and may cover, and the largest depth of all.
        let (mut layers, mut largest) = (Vec::new(), 0.0_f64);
        for triangle in list {
            let Expectation { must, may } = expect.picture(&triangle.corners(), window)?;
            let must = hits(&must, window).0;
            let may = match may {
                Some(may) => hits(&may, window).0,
                None => must.clone(),
            };
            layers.push(Layer { must, may, depths: exact_values(triangle, declared) });
            for vertex in &triangle.vertices {
                largest = largest.max(vertex.depth.abs());
            }
        }
        // Beside the tolerances: exact depths are compared as the nearest floats.
        let rounding = 2.0 * f64::EPSILON;
        let allowance = (2.0 * declared.tolerance + rounding) * largest;
        Some(Self { layers, window, allowance })
    }

    /// What may be seen at a pixel.
    fn seen(&self, x: usize, y: i32) -> SeenTriangles {
        let (mut may, mut must) = (Vec::new(), Vec::new());
        for (number, layer) in self.layers.iter().enumerate() {
            if layer.may.row(y)[x] > 0 {
                may.push(number);
            }
            if layer.must.row(y)[x] > 0 {
                must.push(number);
            }
        }
        let has_to_be = !must.is_empty();
        // One alone needs no depth, which takes long to compute exactly.
        if may.len() < 2 {
            return SeenTriangles { triangles: may, has_to_be };
        }
        // The nearest of those that have to be there hides whatever lies farther than a program may be off.
        let mut nearest = f64::INFINITY;
        for number in must {
            nearest = nearest.min(self.depth(number, x, y));
        }
        let mut by_depth: Vec<(f64, usize)> = Vec::new();
        for number in may {
            let depth = self.depth(number, x, y);
            if depth <= nearest + self.allowance {
                by_depth.push((depth, number));
            }
        }
        by_depth.sort_by(|a, b| a.0.total_cmp(&b.0));
        SeenTriangles {
            triangles: by_depth.into_iter().map(|(_, number)| number).collect(),
            has_to_be,
        }
    }

    /// The depth of a triangle at a pixel; one without depths lies behind all others.
    fn depth(&self, triangle: usize, x: usize, y: i32) -> f64 {
        match &self.layers[triangle].depths {
            Some(depths) => depths.at(self.window.x0 + x as i32, y).0.to_f64(),
            None => f64::INFINITY,
        }
    }

    /// The pixels at which one triangle alone may be seen and has to be, apart from those at which several may, or none.
    pub fn sure(&self) -> SurePixels {
        let mut out = SurePixels::default();
        for y_px in self.window.y0..self.window.y1 {
            for x in 0..self.window.width() as usize {
                let pixel = [self.window.x0 + x as i32, y_px];
                let SeenTriangles { triangles, has_to_be } = self.seen(x, y_px);
                match triangles[..] {
                    [] => {}
                    [one] if has_to_be => out.seen.push((pixel, one)),
                    _ => out.open.push(pixel),
                }
            }
        }
        out
    }

    /// What is seen, as runs of pixels with the number of their triangle.
    pub fn runs(&self) -> Vec<(Span, u8)> {
        let mut runs: Vec<(Span, u8)> = Vec::new();
        for y_px in self.window.y0..self.window.y1 {
            for x in 0..self.window.width() as usize {
                let SeenTriangles { triangles, has_to_be } = self.seen(x, y_px);
                if let (Some(&first), true) = (triangles.first(), has_to_be) {
                    push(&mut runs, self.window.x0 + x as i32, y_px, first as u8);
                }
            }
        }
        runs
    }

    /// Counts the pixels that show nothing, what is not there, or what lies behind.
    pub fn compare(&self, judged: &mut CaseJudgement, runs: &[(Span, u8)]) {
        judged.shapes += self.layers.len() as u64;
        let all: Vec<Span> = runs.iter().map(|(run, _)| *run).collect();
        // A pixel outside of the window shows a triangle where there is nothing to see.
        let (counts, outside) = hits(&all, self.window);
        judged.finding.tally.extra += outside;
        for (y, row) in counts.rows() {
            for (x, &count) in row.iter().enumerate() {
                let SeenTriangles { triangles: seen, has_to_be: must } = self.seen(x, y);
                judged.pixels += u64::from(must);
                judged.finding.tally.twice += u64::from(count.saturating_sub(1));
                judged.finding.tally.missing += u64::from(count == 0 && must);
                judged.finding.tally.extra += u64::from(count > 0 && seen.is_empty());
                let shown = shown(runs, self.window.x0 + x as i32, y);
                // Wrong is also a triangle that covers the pixel and lies behind another one.
                let is_behind = !seen.is_empty() && shown.is_some_and(|t| !seen.contains(&t));
                judged.finding.tally.order += u64::from(is_behind);
                if count > 1 || is_behind || (count == 0) == (must || seen.is_empty()) {
                    for word in [y as u64, x as u64, u64::from(count)] {
                        mix(&mut judged.mark, word);
                    }
                }
            }
        }
    }

    /// The triangle with most wrong pixels, where it is seen, and where it should be.
    pub fn pictures(&self, runs: &[(Span, u8)]) -> Option<(usize, [Coverage; 2])> {
        let mut worst = None;
        let mut most = 0;
        for triangle in 0..self.layers.len() {
            let pictures = self.picture(triangle, runs);
            let wrong = differing(&pictures);
            // Of as many wrong pixels, the last triangle is shown.
            if worst.is_none() || wrong >= most {
                (worst, most) = (Some((triangle, pictures)), wrong);
            }
        }
        worst
    }

    /// Where a triangle is seen, and where it should be.
    fn picture(&self, triangle: usize, runs: &[(Span, u8)]) -> [Coverage; 2] {
        let mut drawn = Coverage::new(self.window, 0);
        let mut expected = Coverage::new(self.window, 0);
        for y in self.window.y0..self.window.y1 {
            for x in 0..self.window.width() as usize {
                let x_px = self.window.x0 + x as i32;
                let SeenTriangles { triangles, has_to_be } = self.seen(x, y);
                let shown = shown(runs, x_px, y);
                // What is right is expected as it is; else the nearest triangle, if one has to be there.
                let should = match shown {
                    Some(number) if triangles.contains(&number) => shown,
                    _ if has_to_be => triangles.first().copied(),
                    _ => None,
                };
                drawn.hit(y, x_px, x_px + i32::from(shown == Some(triangle)));
                expected.hit(y, x_px, x_px + i32::from(should == Some(triangle)));
            }
        }
        [drawn, expected]
    }
}

/// In how many pixels two pictures differ.
fn differing([first, second]: &[Coverage; 2]) -> usize {
    let mut count = 0;
    for ((_, first), (_, second)) in first.rows().zip(second.rows()) {
        count += first.iter().zip(second).filter(|(a, b)| a != b).count();
    }
    count
}

/// The triangle that an answer shows at a pixel: the first, where it names several.
fn shown(runs: &[(Span, u8)], x_px: i32, y_px: i32) -> Option<usize> {
    let here = |run: &Span| run.y_px == y_px && (run.x0_px..run.x1_px).contains(&x_px);
    runs.iter().find(|(run, _)| here(run)).map(|(_, t)| usize::from(*t))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::server::pipeline;
    use rasterproof_core::contract::Interpolate as _;
    use rasterproof_core::raster::scanline::Scanline;
    use rasterproof_registry::engines::{self, Engine};
    use rasterproof_verify::cases::Shape;
    use rasterproof_verify::cases::near_plane::FAMILIES;

    /// The triangle of each pixel by a choice among those that cover it, with their depths.
    fn chosen(list: &[Triangle], window: PixelRect, wins: fn(f64, f64) -> bool) -> Vec<(Span, u8)> {
        let mut buffer = std::collections::BTreeMap::new();
        for (number, triangle) in (0..).zip(list) {
            Scanline.fragments(triangle, window, |f| {
                let held = buffer.entry((f.y_px, f.x_px)).or_insert((f.depth, number));
                if wins(f.depth, held.0) {
                    *held = (f.depth, number);
                }
            });
        }
        let mut runs = Vec::new();
        buffer.into_iter().for_each(|((y, x), (_, number))| push(&mut runs, x, y, number));
        runs
    }

    /// Sorted as a whole by the mean depth of their corners, the far ones first.
    fn painted(list: &[Triangle], window: PixelRect) -> Vec<(Span, u8)> {
        let mean = |t: &usize| -list[*t].vertices.iter().map(|v| v.depth).sum::<f64>();
        let mut order: Vec<usize> = (0..list.len()).collect();
        order.sort_by(|a, b| mean(a).total_cmp(&mean(b)));
        let sorted: Vec<Triangle> = order.iter().map(|&t| list[t]).collect();
        let runs = chosen(&sorted, window, |_, _| true);
        runs.into_iter().map(|(run, t)| (run, order[usize::from(t)] as u8)).collect()
    }

    /// What of 200 piles is found wrong.
    fn wrong(answer: impl Fn(&[Triangle], PixelRect) -> Vec<(Span, u8)>) -> usize {
        let declared = Declared { tolerance: 1e-9, ..Declared::default() };
        let is_wrong = |index: &u64| {
            let case = FAMILIES[0].case(1, *index);
            let Shape::Triangles { list, .. } = &case.shape else { return true };
            let expect = declared.convention;
            let Some(pile) = Pile::new(list, case.window, &expect, &declared) else { return true };
            let mut judged = CaseJudgement::default();
            let runs = answer(list, case.window);
            pile.compare(&mut judged, &runs);
            let (_, [drawn, expected]) = pile.pictures(&runs).unwrap();
            // What is wrong is seen in the picture, unless it is a pixel drawn twice.
            assert!(
                judged.finding.tally.twice > 0 || judged.is_wrong() == (drawn != expected),
                "{index}"
            );
            judged.is_wrong()
        };
        (0..200).filter(is_wrong).count()
    }

    /// Of equal depths either may be seen; every fault is found.
    #[test]
    fn orders_are_told_apart() {
        let scanline = scanline_engine();
        assert_eq!(wrong(|list, window| pipeline::seen(scanline, list, window).unwrap()), 0);
        assert_eq!(wrong(|list, window| chosen(list, window, |new, held| new <= held)), 0);
        let faults = [
            wrong(|list, window| chosen(list, window, |new, held| new > held)),
            wrong(|list, window| chosen(list, window, |_, _| true)),
            wrong(|list, window| chosen(list, window, |_, _| false)),
            wrong(painted),
            wrong(|list, window| {
                [chosen(list, window, |_, _| true), chosen(list, window, |a, b| a < b)].concat()
            }),
            wrong(|_, _| Vec::new()),
        ];
        assert!(faults.iter().all(|found| *found > 40), "{faults:?}");
    }

    fn scanline_engine() -> Engine {
        engines::find("scanline").and_then(|entry| entry.engine).unwrap()
    }

    /// Under every declaration what is expected agrees with itself.
    #[test]
    fn expectations_agree_with_themselves() {
        for words in [
            "",
            "origin=0,0",
            "rule=none",
            "rule=strict winding=cw",
            "origin=0.25,1 rule=bottom-right",
        ] {
            let declared = Declared::parse(&format!("HELLO 2 x depth {words}")).unwrap();
            for index in 0..20 {
                let case = FAMILIES[0].case(2, index);
                let Shape::Triangles { list, .. } = &case.shape else { panic!("triangles") };
                let expect = declared.convention;
                let Some(pile) = Pile::new(list, case.window, &expect, &declared) else { continue };
                let mut judged = CaseJudgement::default();
                pile.compare(&mut judged, &pile.runs());
                assert!(!judged.is_wrong(), "{words} {index}: {:?}", judged.finding.tally);
            }
        }
    }
}
