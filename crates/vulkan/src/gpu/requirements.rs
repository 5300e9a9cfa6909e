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

type Judge = fn(&mut Gpu, u64, u64) -> Result<Outcome, Error>;

const REQUIREMENTS: [(&str, &str, Judge); 12] = [
    ("snapping", "snapping", snapping),
    ("noperspective", "linear", linear),
    ("depths, 16 bits", "depths", |gpu, seed, cases| {
        depth::stored(gpu, seed, cases, Kind::Depths16)
    }),
    ("depths, f32", "depths", |gpu, seed, cases| depth::stored(gpu, seed, cases, Kind::Depths)),
    ("depth test", "depth-test", depth::nearer),
    ("near and far plane", "clipping", depth::clipped),
    ("clipped, near", "clipping", |gpu, seed, cases| clipping(gpu, seed, cases, false)),
    ("clipped, far", "clipping", |gpu, seed, cases| clipping(gpu, seed, cases, true)),
    ("lines", "rectangles", |gpu, seed, cases| lines::apart(gpu, seed, cases, Kind::Lines)),
    ("lines, rectangular", "rectangles", |gpu, seed, cases| {
        lines::apart(gpu, seed, cases, Kind::RectangularLines)
    }),
    ("lines, Bresenham", "bresenham", |gpu, seed, cases| {
        lines::apart(gpu, seed, cases, Kind::BresenhamLines)
    }),
    ("the same twice", "repeatability", twice),
];

/// Runs every stage; what the device does not answer is said in its place.
pub fn all(gpu: &mut Gpu, seed: u64, cases: u64, known: &[KnownFault]) -> Vec<Requirement> {
    let finding = |name: &str, rule: &str, outcome: Result<Outcome, Error>| {
        let (class, detail) = outcome.unwrap_or_else(|error| match error {
            Error::Unsupported(what) => (Standing::NotOffered, what),
            other => (Standing::NoAnswer, other.to_string()),
        });
        Requirement { name: name.to_owned(), rule: VULKAN.clause(rule), class, detail }
    };
    let mut findings: Vec<Requirement> = REQUIREMENTS
        .iter()
        .map(|(name, rule, stage)| {
            let strict = gpu.about().strict_lines;
            let rule = if *name == "lines" && !strict { "loose-lines" } else { *rule };
            finding(name, rule, stage(gpu, seed, cases))
        })
        .collect();
    findings.push(finding(LARGE, "polygons", large(gpu, seed, cases, known)));
    let joined = lines::joined(gpu, seed, cases, known);
    findings.push(finding(lines::JOINED, "joined", joined));
    findings
}

const LARGE: &str = "far up and left";

/// Triangles within the viewport that reach from the window far beyond its upper left corner. Nothing is
/// clipped, so each has the oracle's pixels.
fn large(gpu: &mut Gpu, seed: u64, cases: u64, known: &[KnownFault]) -> Result<Outcome, Error> {
    let step = (gpu.step_px() * SUBPIXELS as f32) as i32;
    let per_px = i64::from(SUBPIXELS / step);
    let reach = gpu.viewport_px() as i64 / 2 * per_px;
    let mut rng = Rng::new("vulkan-large", seed, 0);
    let mut point = |low: i64, high: i64| {
        let mut along = || rng.int(low, high) as i32 * step;
        SubpixelPoint::new(along(), along())
    };
    let triangles: Vec<Corners> =
        (0..cases).map(|_| [point(0, 64 * per_px), point(-reach, 0), point(-reach, 0)]).collect();
    let half = gpu.viewport_px() / 2.0;
    // A picture of its own for each: see `engine::hits_kind`.
    let pictures = gpu.draw_each(Kind::Alone, triangles.iter().map(|t| plain(t, half)))?;
    let mut wrong_px = 0u64;
    let judged: Vec<(f64, bool)> = (0..)
        .zip(&triangles)
        .map(|(cell, corners)| {
            let (drawn, right) = (hits_of(&pictures, cell), oracle(corners));
            let wrong = pixels().filter(|&(x, y)| drawn.get(x, y) != right.get(x, y)).count();
            wrong_px += wrong as u64;
            (twice_area_px2(corners), wrong == 0)
        })
        .collect();
    let wrong = judged.iter().filter(|(_, right)| !right);
    let least = wrong.clone().fold(f64::INFINITY, |least, (px2, _)| least.min(*px2));
    let large = judged.iter().filter(|(px2, _)| *px2 >= LARGE_PX2).count();
    let mut said = format!(
        "{} triangles, {large} with twice an area of 2^23 px^2 or more; {} differ, in {wrong_px} px",
        triangles.len(),
        wrong.count()
    );
    if least.is_finite() {
        said += &format!(", the smallest with {least:.0} px^2");
    }
    Ok((known::class_of_areas(known, LARGE, &judged), said))
}

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
    let step = (gpu.step_px() * SUBPIXELS as f32) as i32;
    let per_px = 2 * SUBPIXELS / step;
    let mut rng = Rng::new("vulkan-snapping", seed, 0);
    let mut halves = || {
        let centre = rng.int(0, 23) as i32 * per_px + per_px / 2;
        centre + rng.int(-3, 3) as i32
    };
    let triangles: Vec<[[i32; 2]; 3]> =
        (0..cases).map(|_| [0; 3].map(|_| [halves(), halves()])).collect();
    let half_px = gpu.viewport_px() / 2.0;
    let vertices = |corners: &[[i32; 2]; 3]| {
        corners.map(|p| Vertex::flat(p.map(|halves| halves as f32 / per_px as f32 / half_px)))
    };
    let pictures = gpu.draw_each(Kind::Hits, triangles.iter().map(vertices))?;
    let right = ROUNDINGS.map(|(name, round)| {
        let is_right = |(cell, corners): &(usize, &[[i32; 2]; 3])| {
            let snapped = corners.map(|p| {
                let [x, y] = p.map(|halves| round(halves) * step);
                SubpixelPoint::new(x, y)
            });
            oracle(&snapped) == hits_of(&pictures, *cell)
        };
        (name, (0..).zip(&triangles).filter(is_right).count())
    });
    let total = triangles.len();
    let said: Vec<String> = right.iter().map(|(name, n)| format!("{name} {n}")).collect();
    let said = format!("of {total} triangles with corners halfway, right are {}", said.join(", "));
    Ok(match right.iter().find(|(_, n)| *n == total) {
        Some(("half to even", _)) => (Standing::Equal, said),
        Some((name, _)) => (Standing::Allowed, format!("positions are rounded {name}: {said}")),
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
        let Some(exact) =
            ExactTriangle::new(&triangle.corners(), v.map(|v| v.inv_w), [1.0; 3], attributes)
        else {
            continue;
        };
        let bounds = linear_bounds(triangle, f64::from(PAGE_PX));
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
    let quantum = if far { SUBPIXELS } else { (gpu.step_px() * SUBPIXELS as f32) as i32 };
    let mut rng = Rng::new("vulkan-clipping", seed, u64::from(far));
    let mut corner = || {
        let reach = i64::from(reach_px) * i64::from(SUBPIXELS / quantum);
        let mut along = || {
            // As many near the window as far from it.
            let bits = rng.int(6, 62 - reach.leading_zeros() as i64);
            let most = (1i64 << bits).min(reach);
            (rng.int(-most, most) as i32).saturating_mul(quantum)
        };
        SubpixelPoint::new(along(), along())
    };
    let triangles: Vec<Corners> = (0..cases).map(|_| [0; 3].map(|_| corner())).collect();
    let (middle_px, shown) = match far {
        true => (0, WINDOW),
        false => {
            let (low, high) = ((CELL_PX as i32 - NEAR_PX) / 2, (CELL_PX as i32 + NEAR_PX) / 2);
            (CELL_PX as i32 / 2, PixelRect { x0: low, y0: low, x1: high, y1: high })
        }
    };
    let draws = (0..).zip(&triangles).map(|(cell, corners)| {
        let mut draw = draw_of(cell, plain(corners, side / 2.0), side);
        // Corners are counted from the middle of the viewport.
        draw.viewport[0] += middle_px as f32;
        draw.viewport[1] += middle_px as f32;
        draw
    });
    let pictures = gpu.draw(Kind::Hits, triangles.len(), draws.collect())?;
    // New corners are f32 of what is clipped, four roundings, then snapped by half a step.
    let u = f64::from(f32::EPSILON) / 2.0;
    let bound_px = f64::from(gpu.step_px()) + 4.0 * u * f64::from(reach_px);
    let (mut different, mut wrong_px, mut furthest, mut beyond) = (0u64, 0u64, 0.0f64, 0u64);
    let mut large = 0u64;
    for (cell, corners) in (0..).zip(&triangles) {
        let moved = |sub: i32| sub + middle_px * SUBPIXELS;
        let corners = corners.map(|p| SubpixelPoint::new(moved(p.x), moved(p.y)));
        large += u64::from(twice_area_px2(&corners) >= LARGE_PX2);
        let (drawn, right) = (hits_of(&pictures, cell), oracle(&corners));
        let mut differs = false;
        for (x, y) in pixels() {
            let is_shown = shown.contains(x, y);
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
    let distance = |i: usize| {
        let (a, b) = (corners[i], corners[(i + 1) % 3]);
        let (x, y) = (f64::from(b.x - a.x), f64::from(b.y - a.y));
        let length = (x * x + y * y).sqrt();
        let twice = twice_area(&[a, b, s]).unsigned_abs() as f64;
        if length > 0.0 { twice / length / f64::from(SUBPIXELS) } else { f64::INFINITY }
    };
    distance(0).min(distance(1)).min(distance(2))
}

/// The same list drawn twice, and once more on a device opened anew, of which the specification does
/// not speak.
fn twice(gpu: &mut Gpu, seed: u64, cases: u64) -> Result<Outcome, Error> {
    let declared = rasterproof_judge::ask::Subject::declared(gpu).clone();
    let half = gpu.viewport_px() / 2.0;
    let mut triangles = Vec::new();
    for family in
        cases::triangles::FAMILIES.iter().filter(|f| f.name != "far" && f.name != "w-extreme")
    {
        for index in 0..cases.div_ceil(64) {
            let case = adapt_case::case(family, seed, index, &declared);
            let Shape::Triangles { list, .. } = case.shape else { continue };
            triangles.extend(list.first().map(|t| valued(t, half)));
        }
    }
    let (mut again, mut anew) = (true, true);
    for kind in [Kind::Hits, Kind::Values] {
        let draw = |gpu: &mut Gpu| gpu.draw_each(kind, triangles.iter().copied());
        let first = draw(gpu)?;
        again &= first == draw(gpu)?;
        gpu.close();
        anew &= first == draw(gpu)?;
    }
    let cells = triangles.len();
    let said = format!("{cells} triangles, hits and values, drawn twice and after opening anew");
    Ok(match (again, anew) {
        (true, true) => (Standing::Equal, format!("{said}: the same bits")),
        (true, false) => (Standing::Allowed, format!("{said}: other bits after opening anew")),
        (false, _) => (Standing::Outside, format!("{said}: bits differ")),
    })
}
