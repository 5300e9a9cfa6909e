//! Invariants 1 to 20: coverage. Every tolerance is zero but that of 19, which is a theorem.

use std::ops::RangeInclusive;

use robust::{Coord, orient2d};

use super::Outcome;
use super::exact::{self, Nudge, TOP_LEFT, U, around, owns, pixels};
use super::implementations::{Engine, Implementations, hits};
use super::source::{Fan, Position, Quad, TriangleInput};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::frame::Coverage;
use rasterproof_core::geometry::{ORDERS, centre, centre_of, twice_area};
use rasterproof_core::grid::{DOMAIN_PX, HALF_PIXEL, PixelRect, Refusal, SUBPIXELS, SubpixelPoint};
use rasterproof_core::parallel;
use rasterproof_core::raster::edge_function::WordWidth;
use rasterproof_core::triangle::Corners;
use rasterproof_render::pipeline::assemble::Cull;

/// Compares hit counts; both show the same window. The number of pixels, or the first difference.
fn same(actual: &Coverage, target: &Coverage, what: &str) -> Outcome {
    let bounds = actual.bounds();
    if actual == target {
        return Ok(u64::from(bounds.width()) * u64::from(bounds.height()));
    }
    let (x, y) = first_difference(actual, target, bounds).unwrap_or((bounds.x0, bounds.y0));
    let [actual, target] = [actual, target].map_array(|c| c.get(x, y).unwrap_or(0));
    Err(format!("hits pixel ({x}, {y}) {actual} times, {what} {target} times"))
}

/// The first pixel of a window, row after row, that two coverages hit differently often.
fn first_difference(a: &Coverage, b: &Coverage, window: PixelRect) -> Option<(i32, i32)> {
    pixels(window).find(|&(x, y)| a.get(x, y) != b.get(x, y))
}

/// Whether an engine covers what the signs of three edge functions in checked arithmetic say.
fn is_owned(engine: &Engine, corners: Corners, window: PixelRect) -> Outcome {
    let mut target = Coverage::new(window, 0);
    for (x, y) in pixels(around(&corners, window)) {
        if owns(&corners, x, y, TOP_LEFT) {
            target.hit(y, x, x + 1);
        }
    }
    same(&engine.hits(corners, window), &target, "checked arithmetic")
}

/// The sign of the area of three points, decided exactly.
fn sign(a: Coord<f64>, b: Coord<f64>, c: Coord<f64>) -> i32 {
    let turn = orient2d(a, b, c);
    if turn == 0.0 { 0 } else { turn.signum() as i32 }
}

/// 1: each engine against the oracle, so against each other too.
pub(super) fn engines_agree(subject: &Implementations, input: &TriangleInput) -> Outcome {
    let (corners, window) = (input.triangle.corners(), input.window);
    // Each engine is compared with the oracle, so two that agree with it agree with each other.
    let truth = hits(&*subject.oracle, [corners], window);
    subject.each_engine(|engine| same(&engine.hits(corners, window), &truth, "the oracle"))
}

/// 2: three signs of `robust::orient2d` at each centre decide what the oracle must say.
pub(super) fn oracle_sign(subject: &Implementations, input: &TriangleInput) -> Outcome {
    let (corners, window) = (input.triangle.corners(), input.window);
    // Every i32 and every centre is a whole number below 2^32: exact in f64, and so is the sign.
    let [a, b, c] = corners.map_array(|p| Coord { x: f64::from(p.x), y: f64::from(p.y) });
    let winding = sign(a, b, c);
    let [a, b, c] = if winding < 0 { [a, c, b] } else { [a, b, c] };
    let mut target = Coverage::new(window, 0);
    for (x, y) in pixels(around(&corners, window)) {
        let sample = Coord { x: centre(x) as f64, y: centre(y) as f64 };
        // Clockwise, with y down: a left edge runs up, and a top edge to the right.
        let mut is_inside = winding != 0;
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let is_top_left = to.y < from.y || (to.y == from.y && to.x > from.x);
            let side = sign(from, to, sample);
            is_inside &= side > 0 || (side == 0 && is_top_left);
        }
        if is_inside {
            target.hit(y, x, x + 1);
        }
    }
    same(&hits(&*subject.oracle, [corners], window), &target, "robust says")
        .map_err(|message| format!("the oracle {message}"))
}

/// The pixels of the domain, which is too large to be looked through.
const DOMAIN: PixelRect =
    PixelRect { x0: -DOMAIN_PX, y0: -DOMAIN_PX, x1: DOMAIN_PX, y1: DOMAIN_PX };

/// 3: the set does not depend on the order of the vertices.
pub(super) fn vertex_order(subject: &Implementations, input: &TriangleInput) -> Outcome {
    let (corners, window) = (input.triangle.corners(), input.window);
    subject.each_engine(|engine| {
        let first = engine.hits(corners, window);
        let mut compared = 0;
        for order in &ORDERS[1..] {
            let other = engine.hits(order.map_array(|i| corners[i]), window);
            compared += same(&other, &first, &format!("in order {order:?} and in 0 1 2"))?;
        }
        Ok(compared)
    })
}

/// Moves a window by whole pixels, or nothing where that leaves the range of i32.
fn shift_rect(rect: PixelRect, dx: i32, dy: i32) -> Option<PixelRect> {
    Some(PixelRect {
        x0: rect.x0.checked_add(dx)?,
        y0: rect.y0.checked_add(dy)?,
        x1: rect.x1.checked_add(dx)?,
        y1: rect.y1.checked_add(dy)?,
    })
}

/// Moves by whole pixels, or nothing where that leaves the domain.
fn shift(corners: Corners, dx_px: i32, dy_px: i32) -> Option<Corners> {
    let mut moved = corners;
    for p in &mut moved {
        p.x = p.x.checked_add(dx_px.checked_mul(SUBPIXELS)?)?;
        p.y = p.y.checked_add(dy_px.checked_mul(SUBPIXELS)?)?;
    }
    Some(moved)
}

/// 4: by a pixel, across zero, and to where floats lose their subpixels.
pub(super) fn translation(subject: &Implementations, input: &TriangleInput) -> Outcome {
    let (corners, window) = (input.triangle.corners(), input.window);
    // The third one moves the middle of the window to zero.
    let half = (window.width() / 2) as i32;
    let shifts = [
        (1, 0),
        (0, 1),
        (-window.x0 - half, -window.y0 - half),
        (1 << 11, -(1 << 11)),
        (-(1 << 14), 1 << 14),
        (DOMAIN_PX / 2, -DOMAIN_PX / 2),
    ];
    subject.each_engine(|engine| {
        let still = engine.hits(corners, window);
        let mut compared = 0;
        for (dx, dy) in shifts {
            let moved = shift(corners, dx, dy).zip(shift_rect(window, dx, dy));
            let Some((moved, there)) = moved else { continue };
            let moved = engine.hits(moved, there);
            // Row by row: the windows differ, what is in them must not.
            for ((_, a), (_, b)) in moved.rows().zip(still.rows()) {
                if a != b {
                    return Err(format!("draws another set after ({dx}, {dy}) px"));
                }
                compared += a.len() as u64;
            }
        }
        Ok(compared)
    })
}

/// The mirrors and turns of the square but for the identity, as matrices by rows.
const SYMMETRIES: [[[i32; 2]; 2]; 7] = [
    [[-1, 0], [0, 1]],
    [[1, 0], [0, -1]],
    [[-1, 0], [0, -1]],
    [[0, 1], [1, 0]],
    [[0, -1], [1, 0]],
    [[0, 1], [-1, 0]],
    [[0, -1], [-1, 0]],
];

/// 5: the image of a triangle covers what the original covers by the rule that the same map turns
/// into top-left: with M the map, samples of the original are nudged by the inverse of M.
pub(super) fn conjugate_rules(subject: &Implementations, input: &TriangleInput) -> Outcome {
    let (corners, window) = (input.triangle.corners(), input.window);
    if window.is_empty() || corners.iter().any(|p| p.x == i32::MIN || p.y == i32::MIN) {
        // The mirror image of the domain's first column lies outside the domain.
        return Ok(0);
    }
    subject.each_engine(|engine| {
        let mut compared = 0;
        for map @ [mx, my] in SYMMETRIES {
            let image = corners.map_array(|p| {
                SubpixelPoint::new(mx[0] * p.x + mx[1] * p.y, my[0] * p.x + my[1] * p.y)
            });
            // The window of the image, from the images of its first and its last pixel.
            let (x0, y0) = mapped_pixel(map, window.x0, window.y0);
            let (x1, y1) = mapped_pixel(map, window.x1 - 1, window.y1 - 1);
            let there = PixelRect {
                x0: x0.min(x1),
                y0: y0.min(y1),
                x1: x0.max(x1) + 1,
                y1: y0.max(y1) + 1,
            };
            // The inverse of an orthogonal matrix is its transpose: columns are rows.
            let nudge = Nudge { first: mx, second: my };
            let mut target = Coverage::new(there, 0);
            for (x, y) in pixels(around(&corners, window)) {
                if owns(&corners, x, y, nudge) {
                    let (x, y) = mapped_pixel(map, x, y);
                    target.hit(y, x, x + 1);
                }
            }
            let what = format!("mapped by {map:?}, the conjugate rule");
            compared += same(&engine.hits(image, there), &target, &what)?;
        }
        Ok(compared)
    })
}

/// Where one of the [`SYMMETRIES`] takes a pixel: pixel i of a mirrored axis is pixel -1 - i.
fn mapped_pixel(map: [[i32; 2]; 2], x: i32, y: i32) -> (i32, i32) {
    let [x, y] = map.map_array(|row| {
        let (at, sign) = if row[0] != 0 { (x, row[0]) } else { (y, row[1]) };
        if sign > 0 { at } else { -1 - at }
    });
    (x, y)
}

/// 6: both ways to split give the same union, and no pixel twice.
pub(super) fn quad_split(subject: &Implementations, input: &Quad) -> Outcome {
    let ([a, b, c, d], window) = (input.corners, input.window);
    subject.each_engine(|engine| {
        // A pixel on the diagonal may belong to either triangle, but to one.
        let one = hits(&*engine.fill, [[a, b, c], [a, c, d]], window);
        let other = hits(&*engine.fill, [[a, b, d], [b, c, d]], window);
        if let Some((x, y)) = pixels(window).find(|&(x, y)| one.get(x, y) > Some(1)) {
            return Err(format!("hits pixel ({x}, {y}) twice"));
        }
        same(&one, &other, "split on the other diagonal")
    })
}

/// The triangles between a point and each side of a closed polygon.
fn fan_triangles(centre: SubpixelPoint, ring: &[SubpixelPoint]) -> Vec<Corners> {
    let mut triangles = Vec::new();
    for (i, from) in ring.iter().enumerate() {
        triangles.push([centre, *from, ring[(i + 1) % ring.len()]]);
    }
    triangles
}

/// 7: the triangles of a closed fan cover what its outline winds round once, once each.
pub(super) fn closed_fan(subject: &Implementations, input: &Fan) -> Outcome {
    let triangles = fan_triangles(input.centre, &input.ring);
    if triangles.iter().any(|corners| twice_area(corners) <= 0) {
        return Ok(0);
    }
    let mut target = Coverage::new(input.window, 0);
    for (x, y) in pixels(input.window) {
        for _ in 0..exact::winding(&input.ring, x, y) {
            target.hit(y, x, x + 1);
        }
    }
    // A pixel that is hit twice lies on a shared edge, and so does one that is missed.
    subject.each_engine(|engine| {
        let fan = hits(&*engine.fill, triangles.iter().copied(), input.window);
        same(&fan, &target, "the outline winds round it")
    })
}

/// How often each pixel of a window is hit by triangles that are clockwise, less the hits of the others.
fn signed_hits(engine: &Engine, triangles: &[Corners], window: PixelRect) -> Vec<i32> {
    // Row after row, as the pixels of the window are counted.
    let mut sums = vec![0; window.width() as usize * window.height() as usize];
    for &corners in triangles {
        let sign = twice_area(&corners).signum() as i32;
        let hits = engine.hits(corners, window);
        for (sum, count) in sums.iter_mut().zip(hits.rows().flat_map(|(_, row)| row)) {
            *sum += sign * i32::from(*count);
        }
    }
    sums
}

/// 8: two fans over one outline, one of them turned inside out, are closed; one of them is a disk,
/// folded where the apex lies outside.
pub(super) fn signed_hit_count(subject: &Implementations, input: &Fan) -> Outcome {
    // Signed hits of the closed mesh cancel, wherever both apexes lie.
    let disk = fan_triangles(input.apex, &input.ring);
    let mut closed = disk.clone();
    for [a, b, c] in fan_triangles(input.centre, &input.ring) {
        closed.push([a, c, b]);
    }
    subject.each_engine(|engine| {
        let on_disk = signed_hits(engine, &disk, input.window);
        let on_closed = signed_hits(engine, &closed, input.window);
        for (i, (x, y)) in pixels(input.window).enumerate() {
            let target = exact::winding(&input.ring, x, y);
            if on_disk[i] != target || on_closed[i] != 0 {
                return Err(format!(
                    "hits pixel ({x}, {y}) {} times on the disk and {} times on the closed mesh, signed; right are {target} and 0",
                    on_disk[i], on_closed[i]
                ));
            }
        }
        Ok(2 * on_disk.len() as u64)
    })
}

/// 9: what is covered of a row is one run.
pub(super) fn contiguous_rows(subject: &Implementations, input: &TriangleInput) -> Outcome {
    subject.each_engine(|engine| {
        let hits = engine.hits(input.triangle.corners(), input.window);
        // Runs come row by row, so that two of one row follow each other.
        let mut last_row = None;
        for (y_px, ..) in hits.runs() {
            if last_row.replace(y_px) == Some(y_px) {
                return Err(format!("leaves a hole in row {y_px}"));
            }
        }
        Ok(u64::from(input.window.height()))
    })
}

/// The subpixels from the first to the last column of the corners, and from the first to the last row.
fn box_of(corners: &Corners) -> (RangeInclusive<i64>, RangeInclusive<i64>) {
    (extent(corners.map_array(|p| p.x)), extent(corners.map_array(|p| p.y)))
}

/// From the least of three coordinates to the largest.
fn extent(values: [i32; 3]) -> RangeInclusive<i64> {
    let [a, b, c] = values.map(i64::from);
    a.min(b).min(c)..=a.max(b).max(c)
}

/// Whether a point is inside of a clockwise triangle, or on one of its edges.
fn holds([a, b, c]: &Corners, p: SubpixelPoint) -> bool {
    let (x, y) = (i64::from(p.x), i64::from(p.y));
    exact::edge(*a, *b, x, y) >= 0
        && exact::edge(*b, *c, x, y) >= 0
        && exact::edge(*c, *a, x, y) >= 0
}

/// 10: nothing outside the snapped box, everything strictly inside.
pub(super) fn inside_the_box(subject: &Implementations, input: &TriangleInput) -> Outcome {
    let (corners, window) = (input.triangle.corners(), input.window);
    // Without an area there is no inside, and the box alone is checked.
    let (columns, rows) = box_of(&corners);
    let oriented = exact::clockwise(&corners);
    subject.each_engine(|engine| {
        let hits = engine.hits(corners, window);
        for (x, y) in pixels(window) {
            let covered = hits.get(x, y) > Some(0);
            let in_box = columns.contains(&centre(x)) && rows.contains(&centre(y));
            if covered && !in_box {
                return Err(format!("covers ({x}, {y}), outside the box"));
            }
            if let (Some(oriented), true) = (&oriented, in_box && !covered)
                && exact::edges(oriented, x, y).iter().all(|&e| e > 0)
            {
                return Err(format!("misses ({x}, {y}), strictly inside"));
            }
        }
        Ok(u64::from(window.width()) * u64::from(window.height()))
    })
}

/// 11: triangles cut out of a triangle cover a part of it.
pub(super) fn nesting(subject: &Implementations, input: &TriangleInput) -> Outcome {
    let (outer, window) = (input.triangle.corners(), input.window);
    let Some([a, b, c]) = exact::clockwise(&outer) else { return Ok(0) };
    let salt = i64::from(input.salt);
    // A point inside, and the middles of the sides.
    let inner = between(between(a, b, salt % 17), c, salt / 17 % 17);
    let [ab, bc, ca] = [between(a, b, 8), between(b, c, 8), between(c, a, 8)];
    subject.each_engine(|engine| {
        let whole = engine.hits(outer, window);
        let mut compared = 0;
        for part in [[a, b, inner], [inner, b, c], [ab, bc, ca], [a, ab, inner]] {
            // Rounding to the lattice may have left the outer triangle.
            if !part.iter().all(|p| holds(&[a, b, c], *p)) {
                continue;
            }
            let hits = engine.hits(part, window);
            if let Some((x, y)) = pixels(window).find(|&(x, y)| hits.get(x, y) > whole.get(x, y)) {
                return Err(format!("covers ({x}, {y}) by {part:?} but not by {outer:?}"));
            }
            compared += 1;
        }
        Ok(compared)
    })
}

/// A point so many sixteenths of the way from p to q, on the lattice.
fn between(p: SubpixelPoint, q: SubpixelPoint, parts: i64) -> SubpixelPoint {
    let [x, y] = [(p.x, q.x), (p.y, q.y)]
        .map_array(|(p, q)| (i64::from(p) + (i64::from(q) - i64::from(p)) * parts / 16) as i32);
    SubpixelPoint::new(x, y)
}

/// 12: flat triangles made of the input's corners: a point twice, three times, three on a line.
pub(super) fn zero_area(subject: &Implementations, input: &TriangleInput) -> Outcome {
    let ([a, b, _], window) = (input.triangle.corners(), input.window);
    // A third point on the line through a and b: b mirrored at a, if it lies in the domain.
    let x = i32::try_from(2 * i64::from(a.x) - i64::from(b.x));
    let y = i32::try_from(2 * i64::from(a.y) - i64::from(b.y));
    let mut flat = vec![[a, a, b], [a, b, a], [b, a, a], [a, a, a]];
    if let (Ok(x), Ok(y)) = (x, y) {
        let c = SubpixelPoint::new(x, y);
        flat.extend([[a, b, c], [b, c, a], [c, b, a]]);
    }
    if twice_area(&input.triangle.corners()) == 0 {
        flat.push(input.triangle.corners());
    }
    subject.each_engine(|engine| {
        for corners in &flat {
            // Coverage and values are separate ways through an engine.
            let covered = engine.hits(*corners, window).covered();
            let mut triangle = input.triangle;
            for (vertex, position) in triangle.vertices.iter_mut().zip(corners) {
                vertex.position = *position;
            }
            let fragments = engine.fragments(&triangle, window).len();
            if covered > 0 || fragments > 0 {
                return Err(format!(
                    "covers {covered} pixels and emits {fragments} fragments of {corners:?}"
                ));
            }
        }
        Ok(flat.len() as u64)
    })
}

/// 13: a triangle and the same one seen from behind.
pub(super) fn windings(subject: &Implementations, input: &TriangleInput) -> Outcome {
    let ([a, b, c], window) = (input.triangle.corners(), input.window);
    // Culling sees the sign of the area alone; coverage does not see it.
    let sign = twice_area(&[a, b, c]).signum();
    for (corners, sign) in [([a, b, c], sign), ([c, b, a], -sign)] {
        let removed = [Cull::None, Cull::Clockwise, Cull::CounterClockwise]
            .map_array(|cull| (subject.culls)(cull, corners));
        let expected = [false, sign > 0, sign < 0];
        if removed != expected {
            return Err(format!("culling none, clockwise, counter-clockwise: {removed:?}"));
        }
    }
    subject.each_engine(|engine| {
        let front = engine.hits([a, b, c], window);
        same(&engine.hits([c, b, a], window), &front, "with the other winding")
    })
}

/// 14: the window cut into tiles, drawn on several threads, gives the window; so do the values.
pub(super) fn crop(subject: &Implementations, input: &TriangleInput) -> Outcome {
    let (triangle, window) = (&input.triangle, input.window);
    // Tiles of 1 to 19 px, cut off at the right and the lower border.
    let side = 1 + (input.salt % 19) as i32;
    let mut tiles = Vec::new();
    for y0 in (window.y0..window.y1).step_by(side as usize) {
        for x0 in (window.x0..window.x1).step_by(side as usize) {
            let (x1, y1) = ((x0 + side).min(window.x1), (y0 + side).min(window.y1));
            tiles.push(PixelRect { x0, y0, x1, y1 });
        }
    }
    subject.each_engine(|engine| {
        // What the whole window shows is the truth about each tile.
        let whole = engine.hits(triangle.corners(), window);
        let fragments = engine.fragments(triangle, window);
        let check = |number: usize| {
            let tile = tiles[number];
            let hits = engine.hits(triangle.corners(), tile);
            if let Some((x, y)) = first_difference(&hits, &whole, tile) {
                return Err(format!("differs at ({x}, {y}) in a tile of {side} px"));
            }
            // The last fragment of a tile is where a walk from another start has gone farthest.
            let inside = engine.fragments(triangle, tile);
            for f in inside.first().into_iter().chain(inside.last()) {
                let (x, y) = (f.x_px, f.y_px);
                if fragments.iter().find(|other| (other.x_px, other.y_px) == (x, y)) != Some(f) {
                    return Err(format!("has another value at ({x}, {y}) in a tile of {side} px"));
                }
            }
            Ok(hits.covered() + 1)
        };
        parallel::map(tiles.len(), check).into_iter().sum()
    })
}

/// The eight arms of a fan in clockwise order (y down).
const ARMS: [[i32; 2]; 8] = [[1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1]];

/// What a rule, as a set of directions whose edges own their samples, does in the two figures of
/// [`identifies_the_rule`]: bit i of the first number is triangle i of the fan, which has an edge
/// out along arm i and one back along the arm after it; bit i of the second is an edge along arm i
/// with the sample in its middle.
fn fingerprint(owns: u8) -> (u8, u8) {
    let mut fan = 0;
    for arm in 0..8 {
        // The edge back along the next arm runs in the direction that is opposite to it.
        let (out, back) = (owns >> arm & 1, owns >> ((arm + 5) % 8) & 1);
        fan |= (out & back) << arm;
    }
    (fan, owns)
}

/// Left edges go up, top edges go right: arms 5, 6, 7 and 0.
const TOP_LEFT_ARMS: u8 = 0b1110_0001;

/// 15: eight triangles around a centre, and eight edges through one. Of the 256 sets of directions
/// only top-left has this fingerprint; of the 16 consistent ones (one of two opposite directions
/// owns) the fan alone tells it from the others.
pub(super) fn identifies_the_rule(subject: &Implementations, input: &TriangleInput) -> Outcome {
    let target = fingerprint(TOP_LEFT_ARMS);
    for rule in (0..=u8::MAX).filter(|&rule| rule != TOP_LEFT_ARMS) {
        let consistent = rule ^ rule.rotate_left(4) == u8::MAX;
        if fingerprint(rule) == target || (consistent && fingerprint(rule).0 == target.0) {
            return Err(format!("the figures cannot tell the rule {rule:08b} from top-left"));
        }
    }
    // Any pixel, any size of the arms: both from the salt. The window is that pixel alone, since its centre is the sample.
    let (x_px, y_px) = ((input.salt % 13) as i32, (input.salt / 13 % 13) as i32);
    let arm_sub = 3 + (input.salt / 169 % 125) as i32;
    let window = PixelRect { x0: x_px, y0: y_px, x1: x_px + 1, y1: y_px + 1 };
    let sample = centre_of(x_px, y_px);
    let tips =
        ARMS.map(|[dx, dy]| SubpixelPoint::new(sample.x + dx * arm_sub, sample.y + dy * arm_sub));
    subject.each_engine(|engine| {
        // A bit for each triangle and each edge that has the sample.
        let (mut fan, mut edges) = (0u8, 0u8);
        for i in 0..8 {
            let of_fan = engine.hits([sample, tips[i], tips[(i + 1) % 8]], window);
            fan |= u8::from(of_fan.covered() > 0) << i;
            // From the opposite arm to arm i, the third corner a right angle clockwise of it.
            let of_edge = engine.hits([tips[(i + 4) % 8], tips[i], tips[(i + 2) % 8]], window);
            edges |= u8::from(of_edge.covered() > 0) << i;
        }
        if (fan, edges) == target {
            Ok(16)
        } else {
            let (target_fan, target_edges) = target;
            Err(format!(
                "has fan {fan:08b}, edges {edges:08b}; top-left has {target_fan:08b}, {target_edges:08b}"
            ))
        }
    })
}

/// The first column whose centre is not left of the crossing of the edge from a down to b with a
/// row of centres: ceil((x - S/2) / S), in one exact division.
fn first_column(a: SubpixelPoint, b: SubpixelPoint, y_sub: i64) -> i128 {
    let [ax, ay, bx, by] = [a.x, a.y, b.x, b.y].map(i128::from);
    let (dx, dy) = (bx - ax, by - ay);
    let numerator = (ax - i128::from(HALF_PIXEL)) * dy + (i128::from(y_sub) - ay) * dx;
    -(-numerator).div_euclid(i128::from(SUBPIXELS) * dy)
}

/// Whether the centre of a column lies right of a downward edge, where its function is not positive.
fn is_right_of(a: SubpixelPoint, b: SubpixelPoint, column: i128, y_sub: i64) -> bool {
    let x = column as i64 * i64::from(SUBPIXELS) + i64::from(HALF_PIXEL);
    exact::edge(a, b, x, y_sub) <= 0
}

/// 16: each half-plane of a row starts at the ceiling of the crossing, by its sign as by division;
/// so a row of a triangle is what lies between its two ceilings.
pub(super) fn edge_lemma(subject: &Implementations, input: &TriangleInput) -> Outcome {
    let (corners, window) = (input.triangle.corners(), input.window);
    let mut compared = 0;
    for y_px in window.y0..window.y1 {
        let y = centre(y_px);
        // The columns at which the edges cross this row: two, or none where it misses the triangle.
        let mut columns = Vec::new();
        for (i, j) in [(0, 1), (1, 2), (2, 0)] {
            let (p, q) = (corners[i], corners[j]);
            let (a, b) = if p.y <= q.y { (p, q) } else { (q, p) };
            if !(i64::from(a.y) <= y && y < i64::from(b.y)) {
                continue;
            }
            let column = first_column(a, b, y);
            if !is_right_of(a, b, column, y) || is_right_of(a, b, column - 1, y) {
                return Err(format!(
                    "row {y_px}: the ceiling {column} of {a:?} {b:?} is no sign change"
                ));
            }
            columns.push(column);
        }
        columns.sort_unstable();
        for engine in &subject.engines {
            let row = PixelRect { y0: y_px, y1: y_px + 1, ..window };
            let actual = engine.hits(corners, row);
            for x in row.x0..row.x1 {
                let is_between = matches!(columns[..], [l, r] if l <= x.into() && r > x.into());
                if (actual.get(x, y_px) == Some(1)) != is_between {
                    let name = engine.name;
                    return Err(format!("{name} errs at ({x}, {y_px}); ceilings {columns:?}"));
                }
            }
            compared += 1;
        }
    }
    Ok(compared)
}

/// 17: sizes up to the widest, around the thresholds of the words. The functions are bounded by
/// the box at its corners (they are linear, so everywhere in it), the chosen word holds them with
/// one step more, and the engines neither panic nor err.
pub(super) fn edge_bound(subject: &Implementations, input: &TriangleInput) -> Outcome {
    let corners = sized(input);
    let (columns, rows) = box_of(&corners);
    let [width, height] = [&columns, &rows].map(|ends| (ends.end() - ends.start()) as u32);
    let bound = i128::from(width) * i128::from(height);
    // The four corners of the box, and their neighbours inside of it.
    let touched = around(&corners, DOMAIN);
    for x in [touched.x0, touched.x0 + 1, touched.x1 - 2, touched.x1 - 1] {
        for y in [touched.y0, touched.y0 + 1, touched.y1 - 2, touched.y1 - 1] {
            let values = (subject.edge_values)(&corners, x, y);
            let is_inside = columns.contains(&centre(x)) && rows.contains(&centre(y));
            if is_inside && values.iter().any(|e| e.abs() > bound) {
                return Err(format!("|E| of {values:?} exceeds {width} x {height} at ({x}, {y})"));
            }
        }
    }
    // In the box |E| <= Wx Wy is attained; a step past it adds at most S Wx or S Wy, or both.
    let padded =
        (i128::from(width) + i128::from(SUBPIXELS)) * (i128::from(height) + i128::from(SUBPIXELS));
    let fits = match (subject.word_width)(width, height) {
        WordWidth::I32 => padded / i128::from(SUBPIXELS) < 1 << 31,
        WordWidth::I64 => padded < 1 << 63,
        WordWidth::I128 => true,
    };
    if !fits {
        return Err(format!("{width} x {height} subpixels do not fit the chosen word"));
    }
    // A few pixels of the box, which itself may be as large as the domain.
    let near = PixelRect {
        x0: touched.x0.max(touched.x1.saturating_sub(12)),
        y0: touched.y0,
        x1: touched.x1,
        y1: touched.y1.min(touched.y0.saturating_add(12)),
    };
    subject.each_engine(|engine| {
        Ok(is_owned(engine, corners, near)? + is_owned(engine, corners, input.window)?)
    })
}

/// The input's triangle, or one whose box has a size at a threshold of some word.
fn sized(input: &TriangleInput) -> Corners {
    let salt = input.salt;
    // Up to 40 to either side of each threshold.
    let spread = i64::from(salt / 6 % 80) - 40;
    let side = match salt % 6 {
        0 => 46_340 + spread,
        1 => 2_896 * 256 - 256 + spread,
        2 => 3_037_000_499 - 256 + spread,
        3 => i64::from(u32::MAX),
        _ => return input.triangle.corners(),
    };
    // The box from (low, low) to (low + side, low + side), the long edge falling or rising.
    let low = if side > i64::from(i32::MAX) { i64::from(i32::MIN) } else { -side / 2 };
    let [low, high] = [low as i32, (low + side) as i32];
    let p = SubpixelPoint::new;
    if salt & 64 == 0 {
        [p(low, low), p(high, low), p(high, high)]
    } else {
        [p(low, high), p(high, low), p(high, high)]
    }
}

/// 18: half a subpixel at most, ties to even, moved with whole pixels; the rest is refused.
pub(super) fn snapping(subject: &Implementations, input: &Position) -> Outcome {
    let Position { px, shift_px } = *input;
    let scale = f64::from(SUBPIXELS);
    let snap = subject.snap;
    let Ok(sub) = snap(px) else { return Err(format!("{px:?} px is refused")) };
    // Exact: px has a mantissa of at most 44 bits, and a factor of 256 moves the exponent only.
    let moved_by = (px * scale - f64::from(sub)).abs();
    if moved_by > 0.5 || (moved_by == 0.5 && sub % 2 != 0) {
        return Err(format!("{px:?} px = {:?} subpixels snaps to {sub}", px * scale));
    }
    // Moved by whole pixels it snaps to a point that is moved as far, unless the sum is rounded or leaves the domain.
    let shifted = px + f64::from(shift_px);
    if shifted - f64::from(shift_px) == px && shifted.abs() < f64::from(DOMAIN_PX - 1) {
        let there = snap(shifted);
        if there != Ok(sub + shift_px * SUBPIXELS) {
            return Err(format!("{px:?} px snaps to {sub}, {shift_px} px further to {there:?}"));
        }
    }
    let refused = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::from(DOMAIN_PX), 1e22, -1e22];
    for px in refused {
        let answer = snap(px);
        let right = match answer {
            Err(Refusal::NotANumber) => px.is_nan(),
            Err(Refusal::Infinite) => px.is_infinite(),
            Err(Refusal::OutOfDomain(_)) => px.is_finite(),
            _ => false,
        };
        if !right {
            return Err(format!("{px:?} px gives {answer:?} instead of a reason"));
        }
    }
    Ok(2 + refused.len() as u64)
}

/// 19: pixels against area. A convex region of area A and perimeter P, in general position to the
/// lattice (the nudge puts it there), has A - P/2 < N < A + P/2 + 1 lattice points (Nosarzewska
/// 1948), so |N - A| < P/2 + 1.
pub(super) fn area(subject: &Implementations, input: &TriangleInput) -> Outcome {
    // Larger triangles would take long, and show nothing else.
    const MOST_PX: u32 = 512;
    let corners = input.triangle.corners();
    let window = around(&corners, DOMAIN);
    if window.width() > MOST_PX || window.height() > MOST_PX {
        return Ok(0);
    }
    // Sides of at most 512 px: twice the area is a whole number below 2^36, exact in f64. The
    // sides have a relative error of 2 u each, as have their sum and the comparison.
    let s = f64::from(SUBPIXELS);
    let area_px = twice_area(&corners).abs() as f64 / (2.0 * s * s);
    let side = |i: usize, j: usize| {
        let (p, q) = (corners[i], corners[j]);
        let (x, y) = (f64::from(p.x - q.x) / s, f64::from(p.y - q.y) / s);
        (x * x + y * y).sqrt()
    };
    let perimeter_px = (side(0, 1) + side(1, 2) + side(2, 0)) * (1.0 + 8.0 * U);
    subject.each_engine(|engine| {
        let covered = engine.hits(corners, window).covered();
        if area_px > 0.0 && (covered as f64 - area_px).abs() > perimeter_px / 2.0 + 1.0 {
            return Err(format!(
                "covers {covered} pixels of an area of {area_px} and a perimeter of {perimeter_px}"
            ));
        }
        Ok(1)
    })
}

/// 20: N x N samples a pixel, as N^2 shifted triangles, are the pixels of the triangle N times as
/// large. N is 2 or 4: the samples lie at odd multiples of S / 2N, on the lattice.
pub(super) fn supersampling(subject: &Implementations, input: &TriangleInput) -> Outcome {
    let (corners, window) = (input.triangle.corners(), input.window);
    let n: i32 = if input.salt.is_multiple_of(2) { 2 } else { 4 };
    let small = |v: i32| v.unsigned_abs() < 1 << 27;
    if !corners.iter().all(|p| small(p.x) && small(p.y)) || !small(window.x0 * SUBPIXELS) {
        return Ok(0);
    }
    // Sample (i, j) of a pixel is pixel (n x + i, n y + j) of the larger triangle.
    let scaled = corners.map_array(|p| SubpixelPoint::new(p.x * n, p.y * n));
    let there =
        PixelRect { x0: window.x0 * n, y0: window.y0 * n, x1: window.x1 * n, y1: window.y1 * n };
    subject.each_engine(|engine| {
        let large = engine.hits(scaled, there);
        for sample in 0..n * n {
            let (i, j) = (sample % n, sample / n);
            // From the sample to the centre.
            let [dx, dy] = [i, j].map_array(|k| HALF_PIXEL - (2 * k + 1) * SUBPIXELS / (2 * n));
            let moved = corners.map_array(|p| SubpixelPoint::new(p.x + dx, p.y + dy));
            let hits = engine.hits(moved, window);
            for (x, y) in pixels(window) {
                if hits.get(x, y) != large.get(x * n + i, y * n + j) {
                    return Err(format!("differs at sample {i},{j} of {n} x {n} of ({x}, {y})"));
                }
            }
        }
        Ok(u64::from(there.width()) * u64::from(there.height()))
    })
}
