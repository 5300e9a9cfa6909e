//! Coverage: the same triangles by several engines, each compared with the oracle.

use serde::Deserialize;
use serde_json::{Value, json};

use super::picture::Picture;
use rasterproof_core::contract::{Rasterize as _, RasterizeExact as _};
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::raster::edge_function_exact::probe::edges_at;
use rasterproof_core::triangle::FreeCorners;
use rasterproof_faults::planted::exact::ExactMutant;
use rasterproof_faults::published::Published;
use rasterproof_registry::engines::{self, Engine, ExactEngine, Specimen};
use rasterproof_verify::cases::Triangle;
use rasterproof_verify::oracle::coverage::samples_on_boundary;
use rasterproof_verify::oracle::rational::cover_and_count_ties;

/// The planted faults that the page offers, as rules: engines otherwise right.
const RULES: [&str; 2] = ["exclusive-edges", "inclusive-edges"];

/// The rasterizer of this name, or the planted fault.
pub(super) fn lattice_engine(name: &str) -> Result<Engine, String> {
    let entry = engines::find(name).copied().or_else(|| engines::find_planted(name));
    let engine = entry.and_then(|entry| entry.engine);
    engine.ok_or_else(|| format!("no rasterizer is called {name}"))
}

/// Who covers pixels on this page.
#[derive(Clone, Copy)]
pub(super) enum Painter {
    Lattice(Engine),
    /// Corners as they are given.
    Free(ExactEngine),
    /// The strict rule for corners as they are given: inside of all three edges, by their exact sides.
    FreeStrict,
    Published(&'static dyn Published),
}

impl Painter {
    /// The one of this name; off the lattice an engine stands for its exact form.
    pub fn find(name: &str, snap: bool) -> Result<Self, String> {
        match name {
            "exclusive-edges" if !snap => return Ok(Self::FreeStrict),
            "inclusive-edges" if !snap => {
                return Ok(Self::Free(ExactEngine::Mutant(ExactMutant::InclusiveTies)));
            }
            _ => {}
        }
        let rule = RULES.contains(&name).then(|| engines::find_planted(name)).flatten();
        let entry = engines::find(name).copied().or(rule);
        let entry = entry.ok_or_else(|| format!("nobody is called {name}"))?;
        if let Some(Specimen::Triangle(specimen)) = entry.specimen {
            return Ok(Self::Published(specimen));
        }
        if let Some(exact) = entry.exact_engine {
            return Ok(Self::Free(exact));
        }
        match entry.engine {
            Some(engine) if snap => Ok(Self::Lattice(engine)),
            Some(_) => {
                let exact = engines::find(&format!("{name}-exact"));
                exact
                    .and_then(|entry| entry.exact_engine)
                    .map(Self::Free)
                    .ok_or_else(|| format!("{name} draws on the lattice only"))
            }
            None => Err(format!("{name} draws no triangles")),
        }
    }

    /// Hits in the window.
    pub fn coverage(self, picture: &Picture) -> Result<Coverage, String> {
        let window = picture.window()?;
        let mut hits = Coverage::new(window, 0);
        match self {
            Self::Lattice(engine) => {
                for triangle in picture.on_lattice()? {
                    engine.cover(triangle.corners(), window, |s| {
                        hits.hit(s.y_px, s.x0_px, s.x1_px);
                    });
                }
            }
            Self::Free(engine) => {
                for corners in free(picture)? {
                    engine.cover_exact(&corners, window, |s| hits.hit(s.y_px, s.x0_px, s.x1_px));
                }
            }
            Self::FreeStrict => {
                for corners in picture.as_given()? {
                    let is_inside = |x_px: i32, y_px: i32| {
                        edges_at(&corners, x_px, y_px)
                            .is_some_and(|edges| edges.iter().all(|edge| edge.side.is_gt()))
                    };
                    for y_px in window.y0..window.y1 {
                        for x_px in (window.x0..window.x1).filter(|&x_px| is_inside(x_px, y_px)) {
                            hits.hit(y_px, x_px, x_px + 1);
                        }
                    }
                }
            }
            Self::Published(specimen) => {
                for triangle in picture.as_real()? {
                    specimen
                        .cover(&triangle, window, &mut |s| hits.hit(s.y_px, s.x0_px, s.x1_px))
                        .map_err(|refused| refused.to_string())?;
                }
            }
        }
        Ok(hits)
    }
}

/// The corners of a picture for the exact forms: snapped first, where it snaps.
fn free(picture: &Picture) -> Result<Vec<FreeCorners>, String> {
    if !picture.snap {
        return picture.as_given();
    }
    Ok(picture.on_lattice()?.iter().map(|t| FreeCorners::from(t.corners())).collect())
}

/// The oracle's hits, and how many samples lie on a boundary.
pub(super) fn truth(picture: &Picture) -> Result<(Coverage, u64), String> {
    let window = picture.window()?;
    if picture.snap {
        let list: Vec<Triangle> = picture.on_lattice()?;
        let ties = list.iter().map(|t| samples_on_boundary(&t.corners(), window)).sum();
        return Ok((Painter::Lattice(Engine::Oracle).coverage(picture)?, ties));
    }
    let mut hits = Coverage::new(window, 0);
    let mut ties = 0;
    for corners in picture.as_given()? {
        ties += cover_and_count_ties(&corners, window, &mut |s| hits.hit(s.y_px, s.x0_px, s.x1_px));
    }
    Ok((hits, ties))
}

/// Hits as digits, row by row; 9 stands for 9 and more.
pub(super) fn digits(hits: &Coverage) -> String {
    let digit = |hits: &u8| char::from(b'0' + (*hits).min(9));
    hits.rows().flat_map(|(_, row)| row.iter().map(digit)).collect()
}

/// Pixels that are hit too seldom, and too often.
pub(super) fn missing_and_extra(hits: &Coverage, truth: &Coverage) -> (u64, u64) {
    let (mut missing, mut extra) = (0, 0);
    for ((_, row), (_, right)) in hits.rows().zip(truth.rows()) {
        for (hits, right) in row.iter().zip(right) {
            missing += u64::from(hits < right);
            extra += u64::from(hits > right);
        }
    }
    (missing, extra)
}

/// Those of the pixels hit too often that are hit more than once.
fn again(hits: &Coverage, truth: &Coverage) -> usize {
    let both = hits.rows().zip(truth.rows());
    both.flat_map(|((_, row), (_, right))| row.iter().zip(right))
        .filter(|&(hits, right)| hits > right && *hits > 1)
        .count()
}

/// Asks for the pixels of a picture by several engines.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Draw {
    picture: Picture,
    by: Vec<String>,
}

impl Draw {
    pub fn answer(&self) -> Result<Value, String> {
        let (target, ties) = truth(&self.picture)?;
        let outlines = match self.picture.snap {
            true => self.picture.outlines()?,
            false => self.picture.as_given()?.iter().map(FreeCorners::px).collect(),
        };
        let panels: Vec<_> = self.by.iter().map(|name| self.panel(name, &target)).collect();
        Ok(json!({
            "panels": panels, "truth": digits(&target), "covered": target.covered(),
            "ties": ties, "outlines": outlines,
        }))
    }

    fn panel(&self, name: &str, target: &Coverage) -> Value {
        let snap = self.picture.snap;
        let hits = Painter::find(name, snap).and_then(|painter| painter.coverage(&self.picture));
        match hits {
            Ok(hits) => {
                let (missing, extra) = missing_and_extra(&hits, target);
                json!({
                    "name": name, "hits": digits(&hits), "covered": hits.covered(),
                    "missing": missing, "extra": extra, "twice": again(&hits, target),
                })
            }
            Err(refused) => json!({ "name": name, "refused": refused }),
        }
    }
}

/// The window of a picture as far as a rectangle of pixels.
pub(super) fn row_of(window: PixelRect, y_px: i32) -> PixelRect {
    window.intersect(&PixelRect { y0: y_px, y1: y_px.saturating_add(1), ..window })
}
