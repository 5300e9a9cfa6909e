//! A case as each engine draws it: hit counts, grids of characters, a picture; and what it is.

use image::RgbImage;

use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_core::raster::edge_function::WordWidth;
use rasterproof_core::triangle::PixelPoint;
use rasterproof_registry::comparison::{EnginesToJudge, Hits};
use rasterproof_registry::engines::Entry;
use rasterproof_report::words::count;
use rasterproof_report::{drawn, panels};
use rasterproof_verify::cases::{Case, Line, Shape, Triangle};
use rasterproof_verify::comparison::{Tally, oracle_hits, shrink};
use rasterproof_verify::judge::ascii;
use rasterproof_verify::oracle::coverage::samples_on_boundary;

use crate::explain::point;

/// Everybody who is judged, or a planted fault alone.
pub fn judged(plant: Option<&str>) -> EnginesToJudge {
    plant.map_or_else(EnginesToJudge::all, EnginesToJudge::planted)
}

/// The hits in a window; none where the other one has no pixels.
pub fn crop(hits: &Coverage, window: PixelRect) -> Coverage {
    let mut cropped = Coverage::new(window, 0);
    for y in window.y0..window.y1 {
        for (x, cell) in (window.x0..).zip(cropped.row_mut(y)) {
            *cell = hits.get(x, y).unwrap_or(0);
        }
    }
    cropped
}

pub struct CaseDrawing {
    engines: Vec<(String, Hits)>,
    target: Coverage,
}

pub fn draw(case: &Case, judged: &EnginesToJudge) -> CaseDrawing {
    CaseDrawing { engines: judged.hits(case), target: oracle_hits(case) }
}

impl CaseDrawing {
    pub fn add(&mut self, entry: &Entry, case: &Case) -> Result<(), String> {
        let hits = drawn::by_specimen(entry, case);
        let refused = || format!("{} does not draw what this case holds", entry.name);
        self.engines.insert(0, (entry.name.to_owned(), hits.ok_or_else(refused)?));
        Ok(())
    }

    /// Puts somebody else before the engines, who draws the case so; and how it differs.
    pub fn add_drawn(&mut self, name: &str, hits: Coverage) -> Tally {
        let tally = Tally::between(&hits, &self.target);
        self.engines.insert(0, (name.to_owned(), Ok(hits)));
        tally
    }

    pub fn is_empty(&self) -> bool {
        self.engines.is_empty()
    }

    /// Whether nobody draws a pixel, and nobody panics.
    pub fn is_blank(&self) -> bool {
        let draws_nothing = |hits: &Hits| hits.as_ref().is_ok_and(|hits| hits.covered() == 0);
        self.target.covered() == 0 && self.engines.iter().all(|(_, hits)| draws_nothing(hits))
    }

    pub fn hits(&self, at: PixelPoint) -> String {
        let of = |hits: &Coverage| hits.get(at.x, at.y).unwrap_or(0);
        let engines = self.engines.iter().map(|(name, hits)| match hits {
            Ok(hits) => format!("{name} {}", of(hits)),
            Err(_) => format!("{name} panics"),
        });
        let oracle = format!("oracle {}", of(&self.target));
        engines.chain([oracle]).collect::<Vec<_>>().join(", ")
    }

    /// A titled grid for each engine; one that panicked has its message instead.
    pub fn blocks(&self) -> Vec<(String, Vec<String>)> {
        let blocks = self.engines.iter().map(|(name, hits)| match hits {
            Ok(hits) => {
                let (covered, tally) = (hits.covered(), Tally::between(hits, &self.target));
                let title = format!("{name}: {covered} px, {} wrong", tally.total());
                (title, ascii::grid(hits, &self.target))
            }
            Err(message) => (format!("{name}: panics"), vec![message.clone()]),
        });
        let oracle = (
            format!("oracle: {} px", self.target.covered()),
            ascii::grid(&self.target, &self.target),
        );
        blocks.chain([oracle]).collect()
    }

    /// The grid of one engine and the oracle's, where coverage differs or an engine panicked.
    pub fn judged_blocks(&self, name: &str) -> Option<Vec<(String, Vec<String>)>> {
        let at = self.engines.iter().position(|(n, _)| n == name)?;
        let blocks = self.blocks();
        Some(vec![blocks[at].clone(), blocks.last()?.clone()])
    }

    /// A panel for each engine that did not panic, then the oracle.
    pub fn picture(&self, title: &str, case: &Case) -> RgbImage {
        panels::of_case(title, case, &self.drawn(), &self.target)
    }

    fn drawn(&self) -> Vec<panels::EnginePicture> {
        let drawn = self.engines.iter();
        drawn.filter_map(|(name, hits)| Some((name.clone(), hits.clone().ok()?))).collect()
    }
}

pub fn facts(case: &Case) -> Vec<String> {
    const MOST: usize = 8;
    let of_triangle = |triangle: &Triangle| {
        let corners = triangle.corners();
        let [a, b, c] = corners;
        let d = |p: SubpixelPoint| {
            (i128::from(p.x) - i128::from(a.x), i128::from(p.y) - i128::from(a.y))
        };
        let ((bx, by), (cx, cy)) = (d(b), d(c));
        let area = bx * cy - by * cx;
        let extent = |[a, b, c]: [i32; 3]| a.max(b).max(c).abs_diff(a.min(b).min(c));
        let word = match WordWidth::of(extent(corners.map(|p| p.x)), extent(corners.map(|p| p.y))) {
            WordWidth::I32 => "32 bits",
            WordWidth::I64 => "64 bits",
            WordWidth::I128 => "128 bits",
        };
        let points = corners.map(point).join(" ");
        let winding = match area.signum() {
            1 => "clockwise",
            -1 => "counter-clockwise",
            _ => "degenerate",
        };
        let ties = samples_on_boundary(&corners, case.window) as u64;
        let (area, ties) = (area as f64 / 131_072.0, count(ties, "sample", "samples"));
        format!(
            "triangle {points}: {winding}, area {area} px, edge functions in {word}, {ties} on its boundary"
        )
    };
    match &case.shape {
        Shape::Triangles { list, .. } => {
            let more = list.len().saturating_sub(MOST);
            let more = (more > 0).then(|| format!("and {more} more triangles"));
            list.iter().take(MOST).map(of_triangle).chain(more).collect()
        }
        Shape::Lines(lines) => {
            let of_line = |line: &Line| {
                let [a, b] = line.ends.map(|end| end.pixel);
                let (dx, dy) = (a.x.abs_diff(b.x), a.y.abs_diff(b.y));
                let (steps, along) = (dx.max(dy), if dx >= dy { "x" } else { "y" });
                let [a, b] = [a, b].map(|end| format!("({}, {})", end.x, end.y));
                format!("line {a} to {b}: {steps} steps along {along}")
            };
            lines.iter().map(of_line).collect()
        }
        Shape::Unsnapped { .. } => vec![format!("triangles {}", shrink::describe(case))],
        Shape::Numbers { .. } => vec![shrink::describe(case)],
    }
}
