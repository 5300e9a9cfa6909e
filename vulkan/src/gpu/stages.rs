//! What is asked besides the families: snapping, clipping, values without perspective, lines, and the
//! same twice.

use super::engine::{Gpu, floats, plain, runs};
use super::rules::{self, Class, Finding, Rule};
use super::segment::{self, Fit, Pixels};
use super::specified::linear_bounds;
use crate::contract::Rasterize as _;
use crate::device::Error;
use crate::device::draw::{Draw, Pictures, Vertex};
use crate::device::stage::{CELL_PX, Kind};
use crate::frame::Coverage;
use crate::grid::{PixelRect, SUBPIXELS, SubpixelPoint};
use crate::hazard::{self, Rng, Shape, Triangle};
use crate::judge::{expected, place};
use crate::oracle::Oracle;
use crate::oracle::values::ExactTriangle;
use crate::triangle::Corners;

const WINDOW: PixelRect = PixelRect::window(CELL_PX, CELL_PX);

/// A stage, by its name.
type Stage = fn(&mut Gpu, u64, u64) -> Result<Outcome, Error>;
type Outcome = (Class, String);

/// All stages with their rules.
const STAGES: [(&str, Rule, Stage); 8] = [
    ("snapping", rules::SNAPPING, snapping),
    ("noperspective", rules::LINEAR, linear),
    ("clipped, near", rules::CLIPPING, |gpu, seed, cases| clipping(gpu, seed, cases, false)),
    ("clipped, far", rules::CLIPPING, |gpu, seed, cases| clipping(gpu, seed, cases, true)),
    ("lines", rules::RECTANGLES, |gpu, seed, cases| lines(gpu, seed, cases, Kind::Lines)),
    ("lines, rectangular", rules::RECTANGLES, |gpu, seed, cases| {
        lines(gpu, seed, cases, Kind::RectangularLines)
    }),
    ("lines, Bresenham", rules::BRESENHAM, |gpu, seed, cases| {
        lines(gpu, seed, cases, Kind::BresenhamLines)
    }),
    ("the same twice", rules::REPEATABILITY, twice),
];

/// Runs every stage; what the device does not answer is said in its place.
pub fn all(gpu: &mut Gpu, seed: u64, cases: u64) -> Vec<Finding> {
    let judged = STAGES.map(|(name, rule, stage)| {
        let strict = gpu.about().strict_lines;
        let rule = if name == "lines" && !strict { rules::LOOSE_LINES } else { rule };
        let (class, detail) = stage(gpu, seed, cases).unwrap_or_else(|error| match error {
            Error::Unsupported(what) => (Class::NotOffered, what),
            other => (Class::NoAnswer, other.to_string()),
        });
        Finding { name: name.to_owned(), rule, class, detail }
    });
    judged.to_vec()
}

fn draw_of(cell: usize, vertices: [Vertex; 3], side_px: f32) -> Draw {
    let half = side_px / 2.0;
    Draw { cell, vertices, viewport: [-half, -half, side_px, side_px], window: [CELL_PX; 2] }
}

fn hits_of(pictures: &Pictures, cell: usize) -> Coverage {
    let mut hits = Coverage::new(WINDOW, 0);
    for y in 0..CELL_PX {
        for (run, times) in runs(y as i32, pictures.row(cell, y, CELL_PX)) {
            (0..times).for_each(|_| hits.hit(run.y_px, run.x0_px, run.x1_px));
        }
    }
    hits
}

fn oracle(corners: &Corners) -> Coverage {
    let mut hits = Coverage::new(WINDOW, 0);
    Oracle.cover(*corners, WINDOW, |s| hits.hit(s.y_px, s.x0_px, s.x1_px));
    hits
}

/// A way to round a position to the lattice, given in halves of a step, to whole steps.
type Rounding = fn(i32) -> i32;

/// The ways that are told apart.
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
    let side = gpu.viewport_px();
    let draws = (0..).zip(&triangles).map(|(cell, corners)| {
        let vertices = corners.map(|p| {
            let [x, y] = p.map(|halves| halves as f32 / per_px as f32 / (side / 2.0));
            Vertex { clip: [x, y, 0.5, 1.0], attributes: [0.0; 2] }
        });
        draw_of(cell, vertices, side)
    });
    let pictures = gpu.draw(Kind::Hits, triangles.len(), draws.collect())?;
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
        Some(("half to even", _)) => (Class::Equal, said),
        Some((name, _)) => (Class::Allowed, format!("positions are rounded {name}: {said}")),
        None => (Class::Allowed, format!("no rounding explains all: {said}")),
    })
}

/// Triangles of the families in perspective, their attributes drawn without it.
fn linear(gpu: &mut Gpu, seed: u64, cases: u64) -> Result<Outcome, Error> {
    let declared = crate::judge::ask::Ask::declared(gpu).clone();
    let names = ["w-equal", "w-4", "w-100"].map(str::to_owned);
    let families = place::families(&names);
    let mut triangles: Vec<Triangle> = Vec::new();
    for family in families {
        for index in 0..cases / 3 {
            let case = place::put(family.case(seed, index), &declared);
            let Shape::Triangles { list, .. } = case.shape else { continue };
            triangles.extend(list.iter().take(1));
        }
    }
    let side = gpu.viewport_px();
    let draws = (0..)
        .zip(&triangles)
        .map(|(cell, t)| draw_of(cell, super::engine::valued(t, side / 2.0), side));
    let pictures = gpu.draw(Kind::Linear, triangles.len(), draws.collect())?;
    let (mut worst, mut values, mut over, mut outside) = (0.0f64, 0u64, 0u64, 0u64);
    for (cell, triangle) in (0..).zip(&triangles) {
        let v = &triangle.vertices;
        let attributes = v.map(|v| v.varying.to_array());
        let Some(exact) =
            ExactTriangle::new(&triangle.corners(), v.map(|v| v.inv_w), [1.0; 3], attributes)
        else {
            continue;
        };
        let bounds = linear_bounds(triangle);
        for (x, y) in (0..CELL_PX).flat_map(|y| (0..CELL_PX).map(move |x| (x, y))) {
            let row = pictures.row(cell, y, CELL_PX);
            let [inv_w, a, b, drawn] = floats(&row[16 * x as usize..]);
            if drawn == 0.0 || (x + y) % 5 != 0 {
                continue;
            }
            let (w, [e, f]) = exact.at(x as i32, y as i32);
            for (error, [bound, of_weights]) in
                [w.distance(inv_w), e.distance(a), f.distance(b)].into_iter().zip(bounds)
            {
                values += 1;
                over += u64::from(error > bound);
                outside += u64::from(error > of_weights);
                worst = worst.max(error / bound);
            }
        }
    }
    let said = format!("{values} values, the worst at {worst:.3} of the derived bound");
    // The specification has a sum of weights and no bound on its error.
    let beyond = format!("{said}, {over} beyond it, {outside} of them beyond that of weights");
    Ok(match (over, outside) {
        (0, _) => (Class::Equal, said),
        (_, 0) => (Class::Allowed, beyond),
        _ => (Class::Outside, beyond),
    })
}

/// Triangles whose corners lie beyond the viewport: near ones a viewport of 64 px, far ones all of it.
fn clipping(gpu: &mut Gpu, seed: u64, cases: u64, far: bool) -> Result<Outcome, Error> {
    // Sides are powers of two and corners multiples that f32 holds, so that only clipping rounds.
    let side = if far { gpu.viewport_px() } else { CELL_PX as f32 };
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
    let draws = (0..).zip(&triangles).map(|(cell, corners)| {
        let mut draw = draw_of(cell, plain(corners, side / 2.0), side);
        if !far {
            // Its middle is that of the viewport; corners are counted from there.
            draw.viewport = [0.0, 0.0, side, side];
        }
        draw
    });
    let pictures = gpu.draw(Kind::Hits, triangles.len(), draws.collect())?;
    let middle = if far { 0 } else { CELL_PX as i32 / 2 * SUBPIXELS };
    // New corners are f32 of what is clipped, four roundings, then snapped by half a step.
    let u = f64::from(f32::EPSILON) / 2.0;
    let bound_px = f64::from(gpu.step_px()) + 4.0 * u * f64::from(reach_px);
    let (mut different, mut wrong_px, mut furthest) = (0u64, 0u64, 0.0f64);
    for (cell, corners) in (0..).zip(&triangles) {
        let corners = corners.map(|p| SubpixelPoint::new(p.x + middle, p.y + middle));
        let (drawn, right) = (hits_of(&pictures, cell), oracle(&corners));
        different += u64::from(drawn != right);
        for ((y, a), (_, b)) in drawn.rows().zip(right.rows()) {
            for (x, _) in (0..).zip(a.iter().zip(b)).filter(|(_, (a, b))| a != b) {
                wrong_px += 1;
                furthest = furthest.max(from_edges_px(&corners, x, y));
            }
        }
    }
    let said = format!(
        "{different} of {cases} triangles with corners up to {reach_px} px away differ, in {wrong_px} \
         px, the furthest {furthest:.4} px from an edge; clipping explains {bound_px:.4}"
    );
    Ok(match different {
        0 => (Class::Equal, said),
        _ if furthest <= bound_px => (Class::Allowed, said),
        _ => (Class::Outside, said),
    })
}

/// The distance of a pixel's centre from the nearest of the lines through the edges, in px.
fn from_edges_px(corners: &Corners, x: i32, y: i32) -> f64 {
    let centre = |px: i32| px * SUBPIXELS + SUBPIXELS / 2;
    let s = SubpixelPoint::new(centre(x), centre(y));
    let distance = |i: usize| {
        let (a, b) = (corners[i], corners[(i + 1) % 3]);
        let length = f64::from(b.x - a.x).hypot(f64::from(b.y - a.y));
        let twice = expected::area2(&[a, b, s]).unsigned_abs() as f64;
        if length > 0.0 { twice / length / f64::from(SUBPIXELS) } else { f64::INFINITY }
    };
    distance(0).min(distance(1)).min(distance(2))
}

/// Pixels between lines and the sides of their window, so that one that lies a pixel away is seen.
const MARGIN_PX: i32 = 2;

/// Lines with ends anywhere on the lattice, on pixel centres and on corners of pixels.
fn lines(gpu: &mut Gpu, seed: u64, cases: u64, kind: Kind) -> Result<Outcome, Error> {
    let step = (gpu.step_px() * SUBPIXELS as f32) as i32;
    let steps_of_px = SUBPIXELS / step;
    let (low, high) = (MARGIN_PX, CELL_PX as i32 - MARGIN_PX);
    let mut rng = Rng::new("vulkan-lines", seed, 0);
    let mut int = |low: i32, high: i32| rng.int(i64::from(low), i64::from(high)) as i32;
    let mut along = |of: u64| match of % 3 {
        0 => int(low * steps_of_px, high * steps_of_px) * step,
        1 => int(low, high - 1) * SUBPIXELS + SUBPIXELS / 2,
        _ => int(low, high) * SUBPIXELS,
    };
    let mut end = |of| SubpixelPoint::new(along(of), along(of));
    let segments: Vec<segment::Ends> =
        (0..cases).map(|n| [end(n), end(n)]).filter(|[a, b]| a != b).collect();
    let side = gpu.viewport_px();
    let draws = (0..)
        .zip(&segments)
        .map(|(cell, [a, b])| draw_of(cell, plain(&[*a, *b, *b], side / 2.0), side));
    let pictures = gpu.draw(kind, segments.len(), draws.collect())?;
    let by = |rule: fn(&segment::Ends, &Pixels, i32, i32) -> Fit| {
        let mut fits = [0u64; 3];
        for (cell, ends) in (0..).zip(&segments) {
            fits[rule(ends, &lit(&pictures, cell), CELL_PX as i32, step) as usize] += 1;
        }
        fits
    };
    let rectangle = by(segment::rectangle);
    let diamond = by(|ends, lit, side, _| segment::diamond_exit(ends, lit, side));
    let said = |name, [equal, allowed, outside]: [u64; 3]| {
        format!("as {name}: {equal} equal, {allowed} within what is allowed, {outside} outside")
    };
    let said = format!(
        "{} lines; {}; {}",
        segments.len(),
        said("rectangles", rectangle),
        said("diamond-exit", diamond)
    );
    let class = |[_, allowed, outside]: [u64; 3]| match (outside, allowed) {
        (0, 0) => Class::Equal,
        (0, _) => Class::Allowed,
        _ => Class::Outside,
    };
    Ok(match kind {
        Kind::BresenhamLines => (class(diamond), said),
        // A parallelogram is neither; it is told, and not judged.
        Kind::Lines if !gpu.about().strict_lines => (class(rectangle).min(Class::Allowed), said),
        _ => (class(rectangle), said),
    })
}

fn lit(pictures: &Pictures, cell: usize) -> Pixels {
    let rows = (0..CELL_PX).flat_map(|y| runs(y as i32, pictures.row(cell, y, CELL_PX)));
    rows.flat_map(|(run, _)| (run.x0_px..run.x1_px).map(move |x| (x, run.y_px))).collect()
}

/// The same list drawn twice, and once more on a device opened anew.
fn twice(gpu: &mut Gpu, seed: u64, cases: u64) -> Result<Outcome, Error> {
    let declared = crate::judge::ask::Ask::declared(gpu).clone();
    let side = gpu.viewport_px();
    let mut draws = Vec::new();
    for family in
        hazard::triangles::FAMILIES.iter().filter(|f| f.name != "far" && f.name != "w-extreme")
    {
        for index in 0..cases.div_ceil(64) {
            let case = place::put(family.case(seed, index), &declared);
            let Shape::Triangles { list, .. } = case.shape else { continue };
            if let Some(t) = list.first() {
                draws.push(draw_of(draws.len(), super::engine::valued(t, side / 2.0), side));
            }
        }
    }
    let cells = draws.len();
    let mut values = Vec::new();
    for kind in [Kind::Hits, Kind::Values] {
        let first = gpu.draw(kind, cells, draws.clone())?;
        let second = gpu.draw(kind, cells, draws.clone())?;
        gpu.close();
        let third = gpu.draw(kind, cells, draws.clone())?;
        values.push(first == second && first == third);
    }
    let said = format!("{cells} triangles, hits and values, drawn twice and after opening anew");
    Ok(match values[..] {
        [true, true] => (Class::Equal, format!("{said}: the same bits")),
        _ => (Class::Outside, format!("{said}: bits differ")),
    })
}
