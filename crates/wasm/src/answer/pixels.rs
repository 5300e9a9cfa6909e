//! Coverage: the same triangles by several engines, each compared with the oracle.

use serde::Deserialize;
use serde_json::{Value, json};

use super::picture::{Picture, flat, panels};
use crate::no_answer::NoAnswer;
use rasterproof_core::contract::{Rasterize as _, RasterizeExact as _};
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::raster::edge_function_exact::probe::edges_at;
use rasterproof_core::triangle::{Corners, FreeCorners};
use rasterproof_faults::planted::exact::ExactMutant;
use rasterproof_faults::published::Published;
use rasterproof_registry::engines::{self, Engine, ExactEngine, Specimen};
use rasterproof_verify::cases::Triangle;
use rasterproof_verify::oracle::coverage::samples_on_boundary;
use rasterproof_verify::oracle::rational::cover_and_count_ties;

/// The planted faults that the page offers, as rules: engines otherwise right.
const RULES: [&str; 2] = ["exclusive-edges", "inclusive-edges"];

/// The rasterizer of this name, or the planted fault.
pub(super) fn lattice_engine(name: &str) -> Result<Engine, NoAnswer> {
    let entry = engines::find(name).copied().or_else(|| engines::find_planted(name));
    let engine = entry.and_then(|entry| entry.engine);
    Ok(engine.ok_or_else(|| format!("no rasterizer is called {name}"))?)
}

/// How often an engine hits each pixel of a window.
pub(crate) fn cover(engine: Engine, triangles: &[Corners], window: PixelRect) -> Coverage {
    let mut hits = Coverage::new(window, 0);
    for &corners in triangles {
        engine.cover(corners, window, |s| hits.hit(s.y_px, s.x0_px, s.x1_px));
    }
    hits
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
    pub fn find(name: &str, snap: bool) -> Result<Self, NoAnswer> {
        // Off the lattice the two planted rules have exact forms of their own.
        match name {
            "exclusive-edges" if !snap => return Ok(Self::FreeStrict),
            "inclusive-edges" if !snap => {
                return Ok(Self::Free(ExactEngine::Mutant(ExactMutant::InclusiveTies)));
            }
            _ => {}
        }
        // Of the planted faults only these rules are offered, so that a name in an address finds no other.
        let rule = RULES.contains(&name).then(|| engines::find_planted(name)).flatten();
        let entry = engines::find(name).copied().or(rule);
        let entry = entry.ok_or_else(|| format!("nobody is called {name}"))?;
        // Published code takes real numbers, and an exact engine any: they need no lattice.
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
                match exact.and_then(|entry| entry.exact_engine) {
                    Some(exact) => Ok(Self::Free(exact)),
                    None => Err(format!("{name} draws on the lattice only").into()),
                }
            }
            None => Err(format!("{name} draws no triangles").into()),
        }
    }

    /// Hits in the window, of all triangles of the picture together.
    pub fn coverage(self, picture: &Picture) -> Result<Coverage, NoAnswer> {
        let window = picture.window()?;
        let mut hits = Coverage::new(window, 0);
        match self {
            Self::Lattice(engine) => {
                let list = picture.on_lattice()?;
                let corners: Vec<_> = list.iter().map(Triangle::corners).collect();
                hits = cover(engine, &corners, window);
            }
            Self::Free(engine) => {
                for corners in free(picture)? {
                    engine.cover_exact(&corners, window, |s| hits.hit(s.y_px, s.x0_px, s.x1_px));
                }
            }
            Self::FreeStrict => {
                for corners in picture.as_given()? {
                    cover_strictly(&corners, &mut hits);
                }
            }
            Self::Published(specimen) => {
                for triangle in picture.as_real()? {
                    specimen.cover(&triangle, window, &mut |s| {
                        hits.hit(s.y_px, s.x0_px, s.x1_px);
                    })?;
                }
            }
        }
        Ok(hits)
    }
}

/// Hits the pixels whose samples lie inside of all three edges.
fn cover_strictly(corners: &FreeCorners, hits: &mut Coverage) {
    let PixelRect { x0, y0, x1, y1 } = hits.bounds();
    for y_px in y0..y1 {
        for x_px in x0..x1 {
            // A triangle without area has no edges and no inside.
            let Some(edges) = edges_at(corners, x_px, y_px) else { return };
            if edges.iter().all(|edge| edge.side.is_gt()) {
                hits.hit(y_px, x_px, x_px + 1);
            }
        }
    }
}

/// The corners of a picture for the exact forms: snapped first, where it snaps.
fn free(picture: &Picture) -> Result<Vec<FreeCorners>, NoAnswer> {
    if !picture.snap {
        return picture.as_given();
    }
    Ok(picture.on_lattice()?.iter().map(|t| FreeCorners::from(t.corners())).collect())
}

/// The oracle's hits, and how many samples lie on a boundary.
pub(super) fn truth(picture: &Picture) -> Result<(Coverage, u64), NoAnswer> {
    let window = picture.window()?;
    if picture.snap {
        let list: Vec<Triangle> = picture.on_lattice()?;
        let ties = list.iter().map(|t| samples_on_boundary(&t.corners(), window)).sum();
        return Ok((Painter::Lattice(Engine::Oracle).coverage(picture)?, ties));
    }
    // Off the lattice both come of one walk, whose numbers are fractions.
    let mut hits = Coverage::new(window, 0);
    let mut ties = 0;
    for corners in picture.as_given()? {
        ties += cover_and_count_ties(&corners, window, &mut |s| hits.hit(s.y_px, s.x0_px, s.x1_px));
    }
    Ok((hits, ties))
}

/// Hits as digits, row by row; 9 stands for 9 and more.
pub(super) fn digits(hits: &Coverage) -> String {
    flat(hits).into_iter().map(|hits| char::from(b'0' + hits.min(9))).collect()
}

/// Hits beside the right ones.
fn compared(hits: &Coverage, truth: &Coverage) -> Value {
    let (mut missing, mut extra, mut twice) = (0, 0, 0);
    for (hits, right) in flat(hits).into_iter().zip(flat(truth)) {
        missing += u64::from(hits < right);
        extra += u64::from(hits > right);
        // Of those too many, the ones that are hit again.
        twice += u64::from(hits > right && hits > 1);
    }
    json!({
        "hits": digits(hits), "covered": hits.covered(),
        "missing": missing, "extra": extra, "twice": twice,
    })
}

/// Asks for the pixels of a picture by several engines.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Draw {
    picture: Picture,
    by: Vec<String>,
}

impl Draw {
    /// Panels with the hits of each engine as digits, and how many pixels are `missing`, `extra` and hit `twice`; the oracle's hits in
    /// `truth`, the samples on boundaries in `ties`, the triangles as they were drawn in `outlines`.
    pub fn answer(&self) -> Result<Value, NoAnswer> {
        let snap = self.picture.snap;
        // The oracle's pixels, with which each panel is compared.
        let (target, ties) = truth(&self.picture)?;
        let outlines = match snap {
            true => self.picture.outlines()?,
            false => self.picture.as_given()?.iter().map(FreeCorners::px).collect(),
        };
        let panels = panels(&self.by, |name| {
            let hits = Painter::find(name, snap)?.coverage(&self.picture)?;
            Ok(compared(&hits, &target))
        });
        Ok(json!({
            "panels": panels, "truth": digits(&target), "covered": target.covered(),
            "ties": ties, "outlines": outlines,
        }))
    }
}

/// The window of a picture as far as a rectangle of pixels.
pub(super) fn row_of(window: PixelRect, y_px: i32) -> PixelRect {
    window.intersect(&PixelRect { y0: y_px, y1: y_px.saturating_add(1), ..window })
}
