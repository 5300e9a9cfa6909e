//! For those who move the corners of a mesh to a grid of their own: what that breaks.
//!
//! A mesh is given twice, as it was and as it was snapped, triangle by triangle. A sample inside the mesh that fewer
//! triangles cover once it is snapped lies in a *crack*, and one that more triangles cover lies in a *fold*. The oracle counts both
//! exactly. Where the outline of the mesh moves across a sample, nothing is broken, and nothing is counted.
//!
//! ```
//! use rasterproof_verify::grid::PixelRect;
//! use rasterproof_verify::snapping::broken;
//!
//! // A corner q within the long edge of another triangle.
//! let q = [4.065213203430176, 2.2584519386291504];
//! let mesh = [
//!     [[0.0, 0.0], [9.0, 5.0], [0.0, 5.0]],
//!     [[0.0, 0.0], [9.0, 0.0], q],
//!     [[9.0, 0.0], [9.0, 5.0], q],
//! ];
//! // To 1/256 px.
//! let snap = |v: f64| (v * 256.0).round() / 256.0;
//! let snapped = mesh.map(|triangle| triangle.map(|point| point.map(snap)));
//! let found = broken(&mesh, &snapped, PixelRect::window(9, 5))?;
//! assert_eq!((found.cracks.len(), found.folds.len()), (1, 0));
//! assert_eq!(found.cracks[0].pixel, [4, 2]);
//! assert_eq!(found.cracks[0].triangles, [0, 2]);
//! # Ok::<(), rasterproof_verify::snapping::BadMesh>(())
//! ```

use std::cmp::Ordering;
use std::fmt;

use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::RasterizeExact as _;
use rasterproof_core::frame::Frame;
use rasterproof_core::geometry::AROUND;
use rasterproof_core::grid::{PixelRect, Refusal};
use rasterproof_core::triangle::FreeCorners;

use crate::oracle::Oracle;
use crate::oracle::rational::edge_value;

/// `[x, y]` of three corners in pixels, y down.
pub type Triangle = [[f64; 2]; 3];

/// A pixel whose sample lies inside the mesh as it was given.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct BrokenPixel {
    /// Column and row.
    pub pixel: [i32; 2],
    /// How many triangles cover it as they were given, and how many once they are snapped.
    pub hits: [usize; 2],
    /// Those that surround a crack, as they were given, or those that cover a fold once they are snapped: by their
    /// places in the list.
    pub triangles: Vec<usize>,
}

/// What snapping breaks in a mesh.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SnappingDamage {
    /// Pixels that fewer triangles cover, from the top left.
    pub cracks: Vec<BrokenPixel>,
    /// Pixels that more triangles cover, from the top left.
    pub folds: Vec<BrokenPixel>,
    /// Triangles that are turned over or have no area any more, by their places in the list.
    pub turned: Vec<usize>,
}

impl SnappingDamage {
    /// Whether no pixel is lost or covered too often.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        self.cracks.is_empty() && self.folds.is_empty()
    }
}

/// Why two meshes cannot be compared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BadMesh {
    /// They have so many triangles.
    Lengths([usize; 2]),
    /// A triangle has a corner that is not finite, or outside the domain.
    Corner {
        /// Its place in the list.
        triangle: usize,
        /// What is wrong with the corner.
        refusal: Refusal,
    },
}

impl fmt::Display for BadMesh {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Lengths([given, snapped]) => {
                write!(f, "the mesh has {given} triangles, and {snapped} once it is snapped")
            }
            Self::Corner { triangle, refusal } => {
                write!(f, "a corner of triangle {triangle} {refusal}")
            }
        }
    }
}

impl std::error::Error for BadMesh {}

/// Finds what is broken between a mesh as it was given and as it was snapped, triangle by triangle, in a window.
///
/// A sample lies inside the mesh where the eight points of a square around it are all covered by the same number of triangles, at
/// least by one. The square reaches by 1.7 times as far as the corner that moves most, so that an outline that can reach
/// the sample runs between these points.
///
/// # Errors
/// [`BadMesh`].
pub fn broken(
    given: &[Triangle],
    snapped: &[Triangle],
    window: PixelRect,
) -> Result<SnappingDamage, BadMesh> {
    if given.len() != snapped.len() {
        return Err(BadMesh::Lengths([given.len(), snapped.len()]));
    }
    let [before, after] = [hits(given, window)?, hits(snapped, window)?];
    let mut reach = 0f64;
    for (before, after) in given.as_flattened().iter().zip(snapped.as_flattened()) {
        reach = reach.max((before[0] - after[0]).abs()).max((before[1] - after[1]).abs());
    }
    let mut found = SnappingDamage::default();
    for (y, row) in before.rows() {
        for ((x, before), after) in (window.x0..).zip(row).zip(after.row(y)) {
            if before == after {
                continue;
            }
            let Some((depth, around)) = inside(given, [x, y], 1.7 * reach) else { continue };
            let (pixel, hits) = ([x, y], [depth, *after]);
            if *after < depth {
                found.cracks.push(BrokenPixel { pixel, hits, triangles: around });
            } else if *after > depth {
                let triangles = covering(snapped, pixel);
                found.folds.push(BrokenPixel { pixel, hits, triangles });
            }
        }
    }
    let winding = |[a, b, c]: Triangle| edge_value(a, b, c).0;
    let both = given.iter().zip(snapped).enumerate();
    let turned = both.filter(|(_, (before, after))| {
        winding(**before) != Ordering::Equal && winding(**before) != winding(**after)
    });
    found.turned = turned.map(|(place, _)| place).collect();
    Ok(found)
}

/// How many triangles cover each pixel.
fn hits(mesh: &[Triangle], window: PixelRect) -> Result<Frame<usize>, BadMesh> {
    let mut hits = Frame::new(window, 0);
    for (triangle, corners) in mesh.iter().enumerate() {
        let bad = |refusal| BadMesh::Corner { triangle, refusal };
        let corners = FreeCorners::new(*corners).map_err(bad)?;
        Oracle.cover_exact(&corners, window, |span| {
            for hits in hits.span_mut(span.y_px, span.x0_px, span.x1_px) {
                *hits += 1;
            }
        });
    }
    Ok(hits)
}

/// The triangles that cover a pixel, by their places in the list.
fn covering(mesh: &[Triangle], [x, y]: [i32; 2]) -> Vec<usize> {
    let pixel = PixelRect { x0: x, y0: y, x1: x + 1, y1: y + 1 };
    let mut triangles = Vec::new();
    for (place, corners) in mesh.iter().enumerate() {
        // All of them were accepted before.
        if let Ok(corners) = FreeCorners::new(*corners) {
            Oracle.cover_exact(&corners, pixel, |_| triangles.push(place));
        }
    }
    triangles
}

/// By how many triangles the points around a sample are covered, if it is the same number everywhere and not 0, and which these
/// are.
fn inside(mesh: &[Triangle], pixel: [i32; 2], reach: f64) -> Option<(usize, Vec<usize>)> {
    let [x, y] = pixel.map_array(|px| f64::from(px) + 0.5);
    let mut counts = [0; AROUND.len()];
    let mut triangles = Vec::new();
    for (place, triangle) in mesh.iter().enumerate() {
        let mut is_here = false;
        for (count, by) in counts.iter_mut().zip(AROUND) {
            let point = [x + by[0] * reach, y + by[1] * reach];
            match side_of(*triangle, point) {
                Ordering::Less => continue,
                // It lies on an edge: nothing is said of this sample.
                Ordering::Equal => return None,
                Ordering::Greater => {}
            }
            *count += 1;
            is_here = true;
        }
        if is_here {
            triangles.push(place);
        }
    }
    let first = counts[0];
    (first > 0 && counts.iter().all(|count| *count == first)).then_some((first, triangles))
}

/// Whether a point lies inside a triangle of either winding, on its border, or outside, decided exactly.
fn side_of([a, b, c]: Triangle, point: [f64; 2]) -> Ordering {
    let winding = edge_value(a, b, c).0;
    if winding == Ordering::Equal {
        return Ordering::Less;
    }
    let sides = [(a, b), (b, c), (c, a)].map(|(from, to)| {
        let side = edge_value(from, to, point).0;
        if winding == Ordering::Greater { side } else { side.reverse() }
    });
    sides.into_iter().min().unwrap_or(Ordering::Less)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn on_grid(mesh: &[Triangle], steps: f64) -> Vec<Triangle> {
        let place = |v: f64| (v * steps).round_ties_even() / steps;
        mesh.iter().map(|of| of.map_array(|p| p.map_array(place))).collect()
    }

    fn pixels(broken: &[BrokenPixel]) -> Vec<([i32; 2], [usize; 2])> {
        broken.iter().map(|broken| (broken.pixel, broken.hits)).collect()
    }

    /// Six triangles in a plane, two of which are narrower than a step of the grid.
    #[test]
    fn a_fold_is_found_and_so_is_what_turned_over() {
        let (o, e, r, s) = ([0.0, 0.0], [9.0, 0.0], [9.0, 5.0], [0.0, 5.0]);
        let (m, n) =
            ([2.664979934692383, 1.479642391204834], [2.6087121963500977, 1.449805736541748]);
        let mesh = [[o, e, m], [e, r, m], [o, m, n], [m, r, n], [o, n, s], [n, r, s]];
        let window = PixelRect::window(9, 5);
        let found = broken(&mesh, &on_grid(&mesh, 256.0), window).unwrap();
        assert_eq!(found.cracks, []);
        assert_eq!(pixels(&found.folds), [([4, 2], [1, 3])]);
        assert_eq!((&found.folds[0].triangles, &found.turned), (&vec![1, 3, 5], &vec![2, 3]));
        assert!(!found.is_whole());
        // A finer grid has none, and neither has the same mesh without the narrow part.
        assert!(broken(&mesh, &on_grid(&mesh, 65536.0), window).unwrap().is_whole());
        let mesh = [[o, e, m], [e, r, m], [o, m, s], [m, r, s]];
        assert!(broken(&mesh, &on_grid(&mesh, 256.0), window).unwrap().is_whole());
    }

    /// A square whose outline moves across samples is whole.
    #[test]
    fn an_outline_that_moves_is_no_crack() {
        let [o, e, r, s] = [[0.498, 0.498], [3.502, 0.498], [3.502, 3.502], [0.498, 3.502]];
        let mesh = [[o, e, r], [o, r, s]];
        let snapped = on_grid(&mesh, 4.0);
        let window = PixelRect::window(4, 4);
        let all = |mesh: &[Triangle]| {
            hits(mesh, window).unwrap().rows().flat_map(|(_, row)| row.to_vec()).sum::<usize>()
        };
        assert_ne!(all(&mesh), all(&snapped));
        assert_eq!(broken(&mesh, &snapped, window).unwrap(), SnappingDamage::default());
    }

    #[test]
    fn bad_meshes_are_refused() {
        let mesh = [[[0.0, 0.0], [1.0, 0.0], [0.0, f64::NAN]]];
        let window = PixelRect::window(2, 2);
        assert_eq!(broken(&mesh, &[], window), Err(BadMesh::Lengths([1, 0])));
        let error = broken(&mesh, &mesh, window).unwrap_err();
        assert_eq!(error.to_string(), "a corner of triangle 0 is not a number (NaN)");
    }
}
