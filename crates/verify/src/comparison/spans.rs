//! What an engine covers: as the spans it emitted, and as hits where a pixel is asked for.
//!
//! Two engines that agree mostly emit the same spans, and then nothing needs to be drawn.

use super::finding::Tally;
use crate::cases::{Case, Line, Shape, Triangle};
use crate::judge::{EnginePanic, caught};
use crate::oracle::Oracle;
use crate::oracle::rational::cover_and_count_ties;
use rasterproof_core::contract::{Decisions, DrawLine, Rasterize, RasterizeExact};
use rasterproof_core::frame::{Coverage, assert_inside};
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::{Fragment, FreeCorners, Span};

/// The spans of the triangles of a case, all of them in the window.
#[derive(Clone)]
pub struct Covered {
    window: PixelRect,
    spans: Vec<Span>,
    /// Where the spans of each triangle end.
    ends: Vec<usize>,
}

impl Covered {
    /// What an engine covers of the triangles.
    ///
    /// # Errors
    /// The message of the engine's panic, a pixel outside the window among them.
    pub fn by(
        engine: &impl Rasterize,
        triangles: &[Triangle],
        window: PixelRect,
    ) -> Result<Self, EnginePanic> {
        caught(|| {
            let mut covered =
                Self { window, spans: Vec::new(), ends: Vec::with_capacity(triangles.len()) };
            for triangle in triangles {
                engine.cover(triangle.corners(), window, |span| {
                    assert_inside(window, span.y_px, span.x0_px, span.x1_px);
                    covered.spans.push(span);
                });
                covered.ends.push(covered.spans.len());
            }
            covered
        })
    }

    pub fn window(&self) -> PixelRect {
        self.window
    }

    /// The truth `self` with those pixels that a rasterizer has drawn once and `may` draw.
    pub fn allowing(&self, drawn: &Self, may: impl Fn(usize) -> Vec<Span>) -> Self {
        let mut target = Self { window: self.window, spans: Vec::new(), ends: Vec::new() };
        for at in 0..self.ends.len() {
            let must = self.of(at);
            let holds = |spans: &[Span], x_px: i32, y_px: i32| {
                spans.iter().any(|s| s.y_px == y_px && (s.x0_px..s.x1_px).contains(&x_px))
            };
            target.spans.extend(must);
            for Span { y_px, x0_px, x1_px } in may(at) {
                let is_free =
                    |&x_px: &i32| holds(drawn.of(at), x_px, y_px) && !holds(must, x_px, y_px);
                let free = (x0_px..x1_px).filter(is_free);
                target.spans.extend(free.map(|x| Span { y_px, x0_px: x, x1_px: x + 1 }));
            }
            target.ends.push(target.spans.len());
        }
        target
    }

    /// The spans of a triangle.
    pub fn of(&self, triangle: usize) -> &[Span] {
        let start = if triangle == 0 { 0 } else { self.ends[triangle - 1] };
        &self.spans[start..self.ends[triangle]]
    }

    /// Pixels, each as often as it is hit.
    pub fn pixels(&self) -> u64 {
        self.spans.iter().map(Span::pixels).sum::<usize>() as u64
    }

    /// Pixels that are hit more than once.
    pub fn twice(&self) -> u64 {
        let after = |two: &[Span]| (two[0].y_px, two[0].x1_px) <= (two[1].y_px, two[1].x0_px);
        if self.spans.windows(2).all(after) {
            return 0;
        }
        self.hits().rows().flat_map(|(_, row)| row).filter(|&&hits| hits > 1).count() as u64
    }

    /// Compares with another coverage of the same window, pixel by pixel.
    pub fn against(&self, target: &Self) -> Tally {
        if self.spans == target.spans {
            return Tally::default();
        }
        Tally::between(&self.hits(), &target.hits())
    }

    /// How often each pixel is hit.
    pub fn hits(&self) -> Coverage {
        hits_of(&self.spans, self.window)
    }
}

fn hits_of(spans: &[Span], window: PixelRect) -> Coverage {
    let mut hits = Coverage::new(window, 0);
    spans.iter().for_each(|span| hits.hit(span.y_px, span.x0_px, span.x1_px));
    hits
}

/// The pixels of fragments against the same engine's spans of the same triangle.
pub fn fragments_against<V>(
    fragments: &[Fragment<V>],
    target: &[Span],
    window: PixelRect,
) -> Tally {
    if same_pixels(fragments, target) {
        return Tally::default();
    }
    let hits = caught(|| {
        let mut hits = Coverage::new(window, 0);
        fragments.iter().for_each(|f| hits.hit(f.y_px, f.x_px, f.x_px + 1));
        hits
    });
    match hits {
        Ok(hits) => Tally::between(&hits, &hits_of(target, window)),
        // A fragment outside the window.
        Err(_) => Tally { extra: 1, ..Tally::default() },
    }
}

/// Whether the fragments are the pixels of the spans, in the same order.
fn same_pixels<V>(fragments: &[Fragment<V>], spans: &[Span]) -> bool {
    let mut rest = fragments;
    for span in spans {
        let Some((run, others)) = rest.split_at_checked(span.pixels()) else { return false };
        if !run.iter().zip(span.x0_px..).all(|(f, x_px)| (f.x_px, f.y_px) == (x_px, span.y_px)) {
            return false;
        }
        rest = others;
    }
    rest.is_empty()
}

/// Hits of an engine over all triangles of a case.
///
/// # Errors
/// The message of the engine's panic, a pixel outside the window among them.
pub fn engine_coverage(
    engine: &impl Rasterize,
    triangles: &[Triangle],
    window: PixelRect,
) -> Result<Coverage, EnginePanic> {
    caught(|| hits_of_all(engine, triangles, window))
}

/// The same of a rasterizer that does not panic.
pub fn hits_of_all(engine: &impl Rasterize, triangles: &[Triangle], window: PixelRect) -> Coverage {
    let mut hits = Coverage::new(window, 0);
    for triangle in triangles {
        let hit = |span: Span| hits.hit(span.y_px, span.x0_px, span.x1_px);
        engine.cover(triangle.corners(), window, hit);
    }
    hits
}

/// Hits of the oracle over all triangles of a case.
#[must_use]
pub fn oracle_coverage(triangles: &[Triangle], window: PixelRect) -> Coverage {
    hits_of_all(&Oracle, triangles, window)
}

/// Pixels of each triangle or line of a case alone, by the oracle.
#[must_use]
pub fn oracle_pixels_each(case: &Case) -> Vec<u64> {
    match &case.shape {
        Shape::Triangles { list, .. } => {
            list.iter().map(|t| oracle_coverage(&[*t], case.window).covered()).collect()
        }
        Shape::Lines(lines) => {
            let count = |line| {
                let mut count = 0;
                Oracle.steps(line, case.window, &mut |_, _| count += 1);
                count
            };
            lines.iter().map(count).collect()
        }
        Shape::Unsnapped { list, .. } => {
            let alone = |t| unsnapped_truth(std::slice::from_ref(t), case.window).0.covered();
            list.iter().map(alone).collect()
        }
        Shape::Numbers { .. } => Vec::new(),
    }
}

/// Hits of the oracle over triangles that are not snapped, and its samples on edges.
pub fn unsnapped_truth(list: &[FreeCorners], window: PixelRect) -> (Coverage, u64) {
    let mut hits = Coverage::new(window, 0);
    let mut ties = 0;
    for corners in list {
        let mut hit = |span: Span| hits.hit(span.y_px, span.x0_px, span.x1_px);
        ties += cover_and_count_ties(corners, window, &mut hit);
    }
    (hits, ties)
}

/// Hits of the oracle over all shapes of a case.
#[must_use]
pub fn oracle_hits(case: &Case) -> Coverage {
    match &case.shape {
        Shape::Triangles { list, .. } => oracle_coverage(list, case.window),
        Shape::Lines(lines) => {
            let mut hits = Coverage::new(case.window, 0);
            for line in lines {
                Oracle.steps(line, case.window, &mut |at, _| hits.hit(at.y, at.x, at.x + 1));
            }
            hits
        }
        Shape::Unsnapped { list, .. } => unsnapped_truth(list, case.window).0,
        Shape::Numbers { .. } => Coverage::new(case.window, 0),
    }
}

/// Hits of an engine over triangles that are not snapped, and how it decided.
///
/// # Errors
/// As [`engine_coverage`].
pub fn exact_coverage(
    engine: &impl RasterizeExact,
    list: &[FreeCorners],
    window: PixelRect,
) -> Result<(Coverage, Decisions), EnginePanic> {
    caught(|| {
        let mut hits = Coverage::new(window, 0);
        let mut decisions = Decisions::default();
        for corners in list {
            let hit = |span: Span| hits.hit(span.y_px, span.x0_px, span.x1_px);
            decisions += engine.cover_exact(corners, window, hit);
        }
        (hits, decisions)
    })
}

/// Hits of a line drawer over all lines of a case.
///
/// # Errors
/// As [`engine_coverage`].
pub fn line_coverage(
    engine: &impl DrawLine,
    lines: &[Line],
    window: PixelRect,
) -> Result<Coverage, EnginePanic> {
    caught(|| {
        let mut hits = Coverage::new(window, 0);
        for line in lines {
            engine.draw(line, window, |f| hits.hit(f.y_px, f.x_px, f.x_px + 1));
        }
        hits
    })
}
