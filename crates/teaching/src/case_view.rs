//! A case as each engine draws it: hit counts, grids of characters, a picture; and what it is.

use image::RgbImage;

use rasterproof_core::frame::Coverage;
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::PixelRect;
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

/// A case as each engine draws it, beside what the oracle says.
pub struct CaseDrawing {
    engines: Vec<(String, Hits)>,
    target: Coverage,
}

/// Draws a case by all engines that are judged, and by the oracle.
pub fn draw(case: &Case, judged: &EnginesToJudge) -> CaseDrawing {
    CaseDrawing { engines: judged.hits(case), target: oracle_hits(case) }
}

impl CaseDrawing {
    /// Puts a published algorithm before the engines.
    ///
    /// # Errors
    /// It draws neither triangles nor lines, or not these.
    pub fn add(&mut self, entry: &Entry, case: &Case) -> Result<(), String> {
        let hits = drawn::by_specimen(entry, case);
        let refused = || format!("{} does not draw what this case holds", entry.name);
        self.engines.insert(0, (entry.name.to_owned(), hits.ok_or_else(refused)?));
        Ok(())
    }

    /// Puts somebody else before the engines, who draws the case so; and how it differs.
    pub fn add_drawn(&mut self, name: &str, hits: Coverage) -> Tally {
        // What it draws wrong, by the oracle.
        let tally = Tally::between(&hits, &self.target);
        self.engines.insert(0, (name.to_owned(), Ok(hits)));
        tally
    }

    pub fn is_empty(&self) -> bool {
        self.engines.is_empty()
    }

    /// Whether nobody draws a pixel, and nobody panics.
    pub fn is_blank(&self) -> bool {
        let is_empty = |hits: &Hits| hits.as_ref().is_ok_and(|hits| hits.covered() == 0);
        self.target.covered() == 0 && self.engines.iter().all(|(_, hits)| is_empty(hits))
    }

    /// How often each engine draws a pixel, and how often it should be drawn.
    pub fn hits(&self, at: PixelPoint) -> String {
        let mut all = Vec::new();
        for (name, hits) in &self.engines {
            all.push(match hits {
                Ok(hits) => format!("{name} {}", hits.get(at.x, at.y).unwrap_or(0)),
                Err(_) => format!("{name} panics"),
            });
        }
        all.push(format!("oracle {}", self.target.get(at.x, at.y).unwrap_or(0)));
        all.join(", ")
    }

    /// A titled grid for each engine; one that panicked has its message instead.
    pub fn blocks(&self) -> Vec<(String, Vec<String>)> {
        let mut blocks = Vec::new();
        for (name, hits) in &self.engines {
            blocks.push(match hits {
                Ok(hits) => {
                    let (covered, tally) = (hits.covered(), Tally::between(hits, &self.target));
                    let title = format!("{name}: {covered} px, {} wrong", tally.total());
                    (title, ascii::grid(hits, &self.target))
                }
                Err(message) => (format!("{name}: panics"), vec![message.clone()]),
            });
        }
        let title = format!("oracle: {} px", self.target.covered());
        blocks.push((title, ascii::grid(&self.target, &self.target)));
        blocks
    }

    /// The grid of one engine and the oracle's, where coverage differs or an engine panicked.
    pub fn judged_blocks(&self, name: &str) -> Option<Vec<(String, Vec<String>)>> {
        // The oracle's block is the last one.
        let at = self.engines.iter().position(|(n, _)| n == name)?;
        let blocks = self.blocks();
        Some(vec![blocks[at].clone(), blocks.last()?.clone()])
    }

    /// A panel for each engine that did not panic, then the oracle.
    pub fn picture(&self, title: &str, case: &Case) -> RgbImage {
        panels::of_case(title, case, &self.drawn(), &self.target)
    }

    /// What each engine draws, without those that panicked.
    fn drawn(&self) -> Vec<panels::EnginePicture> {
        let drawn = self.engines.iter();
        drawn.filter_map(|(name, hits)| Some((name.clone(), hits.clone().ok()?))).collect()
    }
}

/// What a case is, a line for each of its triangles or lines.
pub fn facts(case: &Case) -> Vec<String> {
    const MOST: usize = 8;
    match &case.shape {
        Shape::Triangles { list, .. } => {
            let mut facts = Vec::new();
            for triangle in list.iter().take(MOST) {
                facts.push(facts_of_triangle(triangle, case.window));
            }
            if let Some(more @ 1..) = list.len().checked_sub(MOST) {
                facts.push(format!("and {more} more triangles"));
            }
            facts
        }
        Shape::Lines(lines) => lines.iter().map(facts_of_line).collect(),
        Shape::Unsnapped { .. } => vec![format!("triangles {}", shrink::describe(case))],
        Shape::Numbers { .. } => vec![shrink::describe(case)],
    }
}

/// Winding, area, the numbers that its edges need, and how many ties it has.
fn facts_of_triangle(triangle: &Triangle, window: PixelRect) -> String {
    let corners = triangle.corners();
    // Twice the area in square subpixels, of which a square pixel has 65536.
    let area = twice_area(&corners);
    let winding = match area.signum() {
        1 => "clockwise",
        -1 => "counter-clockwise",
        _ => "degenerate",
    };
    // The engine chooses its numbers by the sides of the bounding box.
    let (width, height) = (extent(corners.map(|p| p.x)), extent(corners.map(|p| p.y)));
    let word = match WordWidth::of(width, height) {
        WordWidth::I32 => "32 bits",
        WordWidth::I64 => "64 bits",
        WordWidth::I128 => "128 bits",
    };
    let ties = count(samples_on_boundary(&corners, window) as u64, "sample", "samples");
    let (points, area) = (corners.map(point).join(" "), area as f64 / 131_072.0);
    format!(
        "triangle {points}: {winding}, area {area} px, edge functions in {word}, {ties} on its boundary"
    )
}

/// How far apart the outer two of three coordinates are.
fn extent([a, b, c]: [i32; 3]) -> u32 {
    a.max(b).max(c).abs_diff(a.min(b).min(c))
}

/// How many steps a line has, and along which axis.
fn facts_of_line(line: &Line) -> String {
    let [a, b] = line.ends.map(|end| end.pixel);
    let (dx, dy) = (a.x.abs_diff(b.x), a.y.abs_diff(b.y));
    // A line has a pixel for each step along its longer axis.
    let (steps, along) = (dx.max(dy), if dx >= dy { "x" } else { "y" });
    format!("line ({}, {}) to ({}, {}): {steps} steps along {along}", a.x, a.y, b.x, b.y)
}
