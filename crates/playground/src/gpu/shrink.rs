//! The subjects that are a step smaller than one that fails. The page draws them all in one picture, and goes
//! on from the first that still fails.

use super::subjects::triangle;
use super::{Check, Device, Subject};
use rasterproof_core::grid::{PixelRect, SUBPIXELS};
use rasterproof_core::triangle::Corners;
use rasterproof_verify::cases::named::plain_triangle;
use rasterproof_verify::cases::shrink::smaller_cases;
use rasterproof_verify::cases::{Case, Shape};

/// Those whose corners lie on the device's lattice and in the cell. None of checks whose subjects are more
/// than the positions of their triangles.
pub(super) fn smaller(check: Check, device: Device, subject: &Subject, cell: i32) -> Vec<Subject> {
    let step = match check {
        Check::Lattice => 1,
        Check::Coverage | Check::Reach | Check::Order | Check::Facing | Check::Samples => {
            device.step()
        }
        _ => return Vec::new(),
    };
    let list = subject.corners().into_iter().map(plain_triangle).collect();
    let window = PixelRect::window(cell as u32, cell as u32);
    let case = Case { window, shape: Shape::Triangles { list, disjoint: false } };
    let corners = |case: Case| match case.shape {
        Shape::Triangles { list, .. } => list.iter().map(|t| t.corners()).collect::<Vec<_>>(),
        Shape::Lines(_) => Vec::new(),
    };
    let fits = |v: i32| {
        let range = if check == Check::Reach { -7 * cell..=8 * cell } else { 0..=cell };
        v % step == 0 && (range.start() * SUBPIXELS..=range.end() * SUBPIXELS).contains(&v)
    };
    let fits = |all: &Vec<Corners>| all.iter().flatten().all(|p| fits(p.x) && fits(p.y));
    smaller_cases(&case)
        .into_iter()
        .filter(|smaller| smaller.window == window)
        .map(corners)
        .filter(fits)
        .map(|all| Subject(all.into_iter().map(triangle).collect()))
        .collect()
}
