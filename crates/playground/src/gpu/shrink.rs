//! The subjects that are a step smaller than one that fails. The page draws them all in one picture, and goes
//! on from the first that still fails.

use super::subjects::{from_whole, triangle, whole};
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
        Check::NearPlane => return smaller_whole(subject),
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

/// Of a triangle in clip space: a coordinate nearer to 0, of which few bits are kept. No corner comes to lie in
/// the near plane, or nearer than w = 1 before the eye: those are dangers of their own.
fn smaller_whole(subject: &Subject) -> Vec<Subject> {
    let Some(corners) = whole(subject) else { return Vec::new() };
    let coordinates = (0..3).flat_map(|corner| (0..4).map(move |axis| (corner, axis)));
    coordinates
        .flat_map(|(corner, axis)| {
            let v: i64 = corners[corner][axis];
            let simpler = [0, v / 2, v / 64 * 64, v / 8 * 8, v - v.signum()];
            simpler.into_iter().filter(move |smaller| *smaller != v).map(move |smaller| {
                let mut corners = corners;
                corners[corner][axis] = smaller;
                corners
            })
        })
        .filter(|corners| corners.iter().all(|[.., z, w]| *z != 0 && (*w <= 0 || *w >= 64)))
        .map(|corners| Subject(vec![corners.map(from_whole).to_vec()]))
        .collect()
}
