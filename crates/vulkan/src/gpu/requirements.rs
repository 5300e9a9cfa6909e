//! What is asked besides the families: snapping, clipping, values without perspective, and the same
//! twice; depths are in [`super::depth`], lines in [`super::lines`].

use super::cells::{
    WINDOW, draw_of, floats, hits_of, in_perspective, pixels, plain, twice_area_px2, valued,
};
use super::engine::Gpu;
use super::known::{self, KnownFault};
use super::outcome::{Errors, Outcome, Requirement};
use super::{depth, lines};
use crate::device::Error;
use crate::device::draw::Vertex;
use crate::device::kind::{CELL_PX, Kind, PAGE_PX};
use rasterproof_core::contract::Rasterize as _;
use rasterproof_core::frame::Coverage;
use rasterproof_core::geometry::{centre_of, twice_area};
use rasterproof_core::grid::{PixelRect, SUBPIXELS, SubpixelPoint};
use rasterproof_core::random::Rng;
use rasterproof_core::triangle::Corners;
use rasterproof_judge::adapt_case;
use rasterproof_judge::ask::Subject as _;
use rasterproof_verify::cases::{self, Shape};
use rasterproof_verify::comparison::single_precision::linear_bounds;
use rasterproof_verify::oracle::Oracle;
use rasterproof_verify::oracle::values::ExactTriangle;
use rasterproof_verify::specification::{Standing, VULKAN};

/// Runs every stage; what the device does not answer is said in its place. The names and their order are those of the report.
pub fn all(gpu: &mut Gpu, seed: u64, cases: u64, known: &[KnownFault]) -> Vec<Requirement> {
    // Without strict lines a device may choose between two other shapes.
    let lines_rule = if gpu.about().strict_lines { "rectangles" } else { "loose-lines" };
    vec![
        finding("snapping", "snapping", snapping(gpu, seed, cases)),
        finding("noperspective", "linear", linear(gpu, seed, cases)),
        finding("depths, 16 bits", "depths", depth::stored(gpu, seed, cases, Kind::Depths16)),
        finding("depths, f32", "depths", depth::stored(gpu, seed, cases, Kind::Depths)),
        finding("depth test", "depth-test", depth::nearer(gpu, seed, cases)),
        finding("near and far plane", "clipping", depth::clipped(gpu, seed, cases)),
        finding("clipped, near", "clipping", clipping(gpu, seed, cases, false)),
        finding("clipped, far", "clipping", clipping(gpu, seed, cases, true)),
        finding("lines", lines_rule, lines::apart(gpu, seed, cases, Kind::Lines)),
        finding(
            "lines, rectangular",
            "rectangles",
            lines::apart(gpu, seed, cases, Kind::RectangularLines),
        ),
        finding(
            "lines, Bresenham",
            "bresenham",
            lines::apart(gpu, seed, cases, Kind::BresenhamLines),
        ),
        finding("the same twice", "repeatability", twice(gpu, seed, cases)),
        finding(LARGE, "polygons", large(gpu, seed, cases, known)),
        finding(lines::JOINED, "joined", lines::joined(gpu, seed, cases, known)),
    ]
}

/// What came of a stage, with the rule by which it was judged.
fn finding(name: &str, rule: &str, outcome: Result<Outcome, Error>) -> Requirement {
    let (class, detail) = match outcome {
        Ok(outcome) => outcome,
        Err(Error::Unsupported(what)) => (Standing::NotOffered, what),
        Err(other) => (Standing::NoAnswer, other.to_string()),
    };
    Requirement { name: name.to_owned(), rule: VULKAN.clause(rule), class, detail }
}

/// Known faults name this stage, as they name families.
const LARGE: &str = "far up and left";

/// A random position on the device's lattice, both coordinates between two whole steps.
fn random_point(rng: &mut Rng, (low, high): (i64, i64), step: i32) -> SubpixelPoint {
    let x = rng.int(low, high) as i32 * step;
    let y = rng.int(low, high) as i32 * step;
    SubpixelPoint::new(x, y)
}

/// A step of the lattice of corners, in subpixels.
fn step(gpu: &Gpu) -> i32 {
    (gpu.step_px() * SUBPIXELS as f32) as i32
}

/// Triangles within the viewport that reach from the window far beyond its upper left corner. Nothing is
/// clipped, so each has the oracle's pixels.
fn large(gpu: &mut Gpu, seed: u64, cases: u64, known: &[KnownFault]) -> Result<Outcome, Error> {
    let step = step(gpu);
    let per_px = i64::from(SUBPIXELS / step);
    let reach = gpu.viewport_px() as i64 / 2 * per_px;
    let mut rng = Rng::new("vulkan-large", seed, 0);
    let mut triangles: Vec<Corners> = Vec::new();
    for _ in 0..cases {
        // One corner in the window, two up to half a viewport away from it.
        let inside = random_point(&mut rng, (0, 64 * per_px), step);
        let mut far = || random_point(&mut rng, (-reach, 0), step);
        triangles.push([inside, far(), far()]);
    }
    let half = gpu.viewport_px() / 2.0;
    // A picture of its own for each: see `engine::hits_kind`.
    let pictures = gpu.draw_each(Kind::Alone, triangles.iter().map(|t| plain(t, half)))?;
    let (mut wrong, mut wrong_px, mut large, mut least) = (0, 0, 0, f64::INFINITY);
    let mut judged: Vec<(f64, bool)> = Vec::new();
    for (cell, corners) in triangles.iter().enumerate() {
        let (drawn, right) = (hits_of(&pictures, cell), oracle(corners));
        let different = pixels().filter(|&(x, y)| drawn.get(x, y) != right.get(x, y)).count();
        // Known faults begin at an area, so each triangle is noted with its own.
        let px2 = twice_area_px2(corners);
        judged.push((px2, different == 0));
        large += u64::from(px2 >= LARGE_PX2);
        if different > 0 {
            wrong += 1;
            wrong_px += different;
            least = px2.min(least);
        }
    }
    let mut said = format!(
        "{} triangles, {large} with twice an area of 2^23 px^2 or more; {wrong} differ, in {wrong_px} px",
        triangles.len(),
    );
    if least.is_finite() {
        said += &format!(", the smallest with {least:.0} px^2");
    }
    Ok((known::class_of_areas(known, LARGE, &judged), said))
}

/// The hits that a triangle has in a window, by the oracle.
fn oracle(corners: &Corners) -> Coverage {
    let mut hits = Coverage::new(WINDOW, 0);
    Oracle.cover(*corners, WINDOW, |s| hits.hit(s.y_px, s.x0_px, s.x1_px));
    hits
}

/// A way to round a position to the lattice, given in halves of a step, to whole steps.
type Rounding = fn(i32) -> i32;

const ROUNDINGS: [(&str, Rounding); 4] = [
    ("half to even", |halves| toward(halves, 0)),
    ("half to odd", |halves| toward(halves, 1)),
    ("half up", |halves| (halves + 1).div_euclid(2)),
    ("half down", |halves| halves.div_euclid(2)),
];

/// The nearest whole step, of two the one with this remainder.
fn toward(halves: i32, parity: i32) -> i32 {
    let below = halves.div_euclid(2);
    below + i32::from(halves.rem_euclid(2) == 1 && below.rem_euclid(2) != parity)
}

/// Corners halfway between two positions of the lattice, near pixel centres, where it shows.
fn snapping(gpu: &mut Gpu, seed: u64, cases: u64) -> Result<Outcome, Error> {
    let step = step(gpu);
    // Coordinates are counted in halves of a step, of which a pixel has so many.
    let per_px = 2 * SUBPIXELS / step;
    let mut rng = Rng::new("vulkan-snapping", seed, 0);
    let mut triangles = Vec::new();
    for _ in 0..cases {
        let mut corners = [[0; 2]; 3];
        for halves in corners.as_flattened_mut() {
            let centre = rng.int(0, 23) as i32 * per_px + per_px / 2;
            *halves = centre + rng.int(-3, 3) as i32;
        }
        triangles.push(corners);
    }
    let half_px = gpu.viewport_px() / 2.0;
    let vertices = |corners: &[[i32; 2]; 3]| {
        corners.map(|p| Vertex::flat(p.map(|halves| halves as f32 / per_px as f32 / half_px)))
    };
    let pictures = gpu.draw_each(Kind::Hits, triangles.iter().map(vertices))?;
    // How many triangles each way to round explains; the specification leaves the way open.
    let total = triangles.len();
    let (mut counts, mut explains) = (Vec::new(), None);
    for (name, round) in ROUNDINGS {
        let mut right = 0;
        for (cell, corners) in triangles.iter().enumerate() {
            let snapped =
                corners.map(|[x, y]| SubpixelPoint::new(round(x) * step, round(y) * step));
            right += usize::from(oracle(&snapped) == hits_of(&pictures, cell));
        }
        counts.push(format!("{name} {right}"));
        if right == total {
            explains = explains.or(Some(name));
        }
    }
    let counts = counts.join(", ");
    let said = format!("of {total} triangles with corners halfway, right are {counts}");
    Ok(match explains {
        Some("half to even") => (Standing::Equal, said),
        Some(name) => (Standing::Allowed, format!("positions are rounded {name}: {said}")),
        None => (Standing::Allowed, format!("no rounding explains all: {said}")),
    })
}

/// Triangles of the families in perspective, their attributes drawn without it.
fn linear(gpu: &mut Gpu, seed: u64, cases: u64) -> Result<Outcome, Error> {
    let triangles = in_perspective(gpu.declared(), seed, cases);
    let half = gpu.viewport_px() / 2.0;
    let pictures = gpu.draw_each(Kind::Linear, triangles.iter().map(|t| valued(t, half)))?;
    let mut errors = Errors::default();
    for (cell, triangle) in (0..).zip(&triangles) {
        let v = &triangle.vertices;
        let attributes = v.map(|v| v.varying.to_array());
        // With w = 1 everywhere, what is exact is linear on the screen. A triangle without an area has no values.
        let Some(exact) =
            ExactTriangle::new(&triangle.corners(), v.map(|v| v.inv_w), [1.0; 3], attributes)
        else {
            continue;
        };
        let bounds = linear_bounds(triangle, f64::from(PAGE_PX));
        // Every fifth pixel is enough, since exact values take most of the time.
        for (x, y) in pixels().filter(|(x, y)| (x + y) % 5 == 0) {
            let row = pictures.row(cell, y as u32, CELL_PX);
            let [inv_w, a, b, drawn] = floats(&row[16 * x as usize..]);
            if drawn == 0.0 {
                continue;
            }
            let (w, [e, f]) = exact.at(x, y);
            for (error, [bound, of_weights]) in
                [w.distance(inv_w), e.distance(a), f.distance(b)].into_iter().zip(bounds)
            {
                errors.add(error, bound, of_weights);
            }
        }
    }
    // The specification has a sum of weights and no bound on its error.
    Ok(errors.outcome("values", "that of weights"))
}

/// The viewport of what is clipped near: in the middle of a cell, so that what is drawn beyond it shows.
const NEAR_PX: i32 = 32;

/// Triangles whose corners lie beyond the viewport: near ones a viewport of 32 px, far ones all of it.
fn clipping(gpu: &mut Gpu, seed: u64, cases: u64, far: bool) -> Result<Outcome, Error> {
    // Sides are powers of two and corners multiples that f32 holds, so that only clipping rounds.
    let side = if far { gpu.viewport_px() } else { NEAR_PX as f32 };
    let reach_px = if far { 1 << 20 } else { 1 << 12 };
    let quantum = if far { SUBPIXELS } else { step(gpu) };
    let reach = i64::from(reach_px) * i64::from(SUBPIXELS / quantum);
    let mut rng = Rng::new("vulkan-clipping", seed, u64::from(far));
    let mut along = || {
        // As many near the window as far from it.
        let bits = rng.int(6, 62 - reach.leading_zeros() as i64);
        let most = (1i64 << bits).min(reach);
        (rng.int(-most, most) as i32).saturating_mul(quantum)
    };
    let mut triangles: Vec<Corners> = Vec::new();
    for _ in 0..cases {
        triangles.push([0; 3].map(|_| SubpixelPoint::new(along(), along())));
    }
    let (middle_px, shown) = match far {
        true => (0, WINDOW),
        false => {
            let (low, high) = ((CELL_PX as i32 - NEAR_PX) / 2, (CELL_PX as i32 + NEAR_PX) / 2);
            (CELL_PX as i32 / 2, PixelRect { x0: low, y0: low, x1: high, y1: high })
        }
    };
    let mut draws = Vec::new();
    for (cell, corners) in triangles.iter().enumerate() {
        let mut draw = draw_of(cell, plain(corners, side / 2.0), side);
        // Corners are counted from the middle of the viewport.
        draw.viewport[0] += middle_px as f32;
        draw.viewport[1] += middle_px as f32;
        draws.push(draw);
    }
    let pictures = gpu.draw(Kind::Hits, triangles.len(), draws)?;
    // New corners are f32 of what is clipped, four roundings, then snapped by half a step.
    let u = f64::from(f32::EPSILON) / 2.0;
    let bound_px = f64::from(gpu.step_px()) + 4.0 * u * f64::from(reach_px);
    let (mut different, mut wrong_px, mut furthest, mut beyond) = (0u64, 0u64, 0.0f64, 0u64);
    let mut large = 0u64;
    for (cell, corners) in (0..).zip(&triangles) {
        // The oracle's window begins at the corner of the cell.
        let middle = middle_px * SUBPIXELS;
        let corners = corners.map(|p| SubpixelPoint::new(p.x + middle, p.y + middle));
        large += u64::from(twice_area_px2(&corners) >= LARGE_PX2);
        let (drawn, right) = (hits_of(&pictures, cell), oracle(&corners));
        let mut differs = false;
        for (x, y) in pixels() {
            let is_shown = shown.contains(x, y);
            // Beyond the viewport nothing may be drawn at all; within it, clipping may move an edge a little.
            beyond += u64::from(!is_shown && drawn.get(x, y) != Some(0));
            if is_shown && drawn.get(x, y) != right.get(x, y) {
                differs = true;
                wrong_px += 1;
                furthest = furthest.max(from_edges_px(&corners, x, y));
            }
        }
        different += u64::from(differs);
    }
    let mut said = format!(
        "{different} of {cases} triangles with corners up to {reach_px} px away differ, in {wrong_px} \
         px, the furthest {furthest:.4} px from an edge; clipping explains {bound_px:.4}; {large} have \
         twice an area of 2^23 px^2 or more"
    );
    if beyond > 0 {
        said += &format!("; {beyond} px are drawn beyond the viewport");
    }
    let is_allowed = beyond == 0 && furthest <= bound_px;
    Ok((Standing::of(different + beyond == 0, is_allowed), said))
}

/// Twice the area from which a driver was seen to lose pixels.
const LARGE_PX2: f64 = 8_388_608.0;

/// The distance of a pixel's centre from the nearest of the lines through the edges, in px.
fn from_edges_px(corners: &Corners, x: i32, y: i32) -> f64 {
    let s = centre_of(x, y);
    let mut nearest = f64::INFINITY;
    for i in 0..3 {
        let (a, b) = (corners[i], corners[(i + 1) % 3]);
        let (x, y) = (f64::from(b.x - a.x), f64::from(b.y - a.y));
        let length = (x * x + y * y).sqrt();
        // The height of the triangle of the edge and the centre; an edge without a length has no line.
        let twice = twice_area(&[a, b, s]).unsigned_abs() as f64;
        if length > 0.0 {
            nearest = nearest.min(twice / length / f64::from(SUBPIXELS));
        }
    }
    nearest
}

/// The same list drawn twice, and once more on a device opened anew, of which the specification does
/// not speak.
fn twice(gpu: &mut Gpu, seed: u64, cases: u64) -> Result<Outcome, Error> {
    let declared = rasterproof_judge::ask::Subject::declared(gpu).clone();
    let half = gpu.viewport_px() / 2.0;
    let mut triangles = Vec::new();
    for family in cases::triangles::FAMILIES {
        // Corners of these lie beyond the viewport, or have a w that f32 does not hold.
        if ["far", "w-extreme"].contains(&family.name) {
            continue;
        }
        for index in 0..cases.div_ceil(64) {
            let case = adapt_case::case(family, seed, index, &declared);
            let Shape::Triangles { list, .. } = case.shape else { continue };
            triangles.extend(list.first().map(|t| valued(t, half)));
        }
    }
    let (mut again, mut anew) = (true, true);
    for kind in [Kind::Hits, Kind::Values] {
        let first = gpu.draw_each(kind, triangles.iter().copied())?;
        again &= first == gpu.draw_each(kind, triangles.iter().copied())?;
        gpu.close();
        anew &= first == gpu.draw_each(kind, triangles.iter().copied())?;
    }
    let cells = triangles.len();
    let said = format!("{cells} triangles, hits and values, drawn twice and after opening anew");
    Ok(match (again, anew) {
        (true, true) => (Standing::Equal, format!("{said}: the same bits")),
        (true, false) => (Standing::Allowed, format!("{said}: other bits after opening anew")),
        (false, _) => (Standing::Outside, format!("{said}: bits differ")),
    })
}
