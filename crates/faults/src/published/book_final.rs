//! Specimens: the final DrawTriangle of the book (part 3, chapter 11) with its clip and viewport,
//! before and after the last exercise (section 11.4).
//! Source: the book (yangzhenzhuozz/Renderer on GitHub) and its companion code; see `docs/sources.md`.
//!
//! Symptoms: the coverage of chapter 2, every fault of it; the area is judged in device coordinates, where
//! 1e-15 is some other size; a clipped triangle is a fan whose inner seams are drawn twice. Values (sections
//! 5.4 and 5.5, formulas 8 and 9) start at each edge with t' = 0 and at each row's truncated first pixel with
//! t' = 0, so t' overshoots 1: values leave the range of the corners, and a row between 9.75 and 10.25 divides
//! by zero. The exercise holds t' at 1 down the edges: that changes no coverage, leaves the rows as they are,
//! and does nothing for the depth.

use glam::{DVec2, DVec4};

use super::book_formulas as formulas;
use super::book_triangle::{AREA_LIMIT, Row, sorted, split, twice_area, walk};
use super::scene::{
    COLOURS, Image, SIDE, Setting, Version, clip_by_sign, clip_vertex, empty, fill_clipped,
};
use super::{
    BookScreen, ClipVertex, Columns, DrawResult, Fragments, NoResult, Published, RealTriangle,
    Spans, int_loop,
};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::Fragment;

#[derive(Clone, Copy, Debug)]
pub struct BookFinal {
    /// Whether t' is held at 1 down the edges, as the exercise of section 11.4 asks.
    pub exercise: bool,
}

/// The six borders in the book's order, as the function that is positive inside.
pub(super) const BORDERS: [fn(DVec4) -> f64; 6] =
    [|p| p.w + p.x, |p| p.w - p.x, |p| p.w + p.y, |p| p.w - p.y, |p| p.w + p.z, |p| p.w - p.z];

/// Clips a triangle by left, right, bottom, top, near and far, in this order (section 8.3).
///
/// # Errors
/// [`NoResult::ArrayOverflow`] where rounding makes a polygon larger than the published arrays.
pub fn clip(triangle: [ClipVertex; 3]) -> Result<Vec<ClipVertex>, NoResult> {
    let mut polygon = triangle.to_vec();
    for (border, place) in BORDERS.iter().enumerate() {
        // The published arrays have one element more for each border.
        let size = border + 4;
        let mut kept = Vec::new();
        for (i, a) in polygon.iter().enumerate() {
            let b = &polygon[(i + 1) % polygon.len()];
            let (from, to) = (place(a.position), place(b.position));
            if from >= 0.0 {
                kept.push(*a);
            }
            // One side below zero, the other not: nothing else is cut. NaN is neither.
            if (from < 0.0 && to >= 0.0) || (from >= 0.0 && to < 0.0) {
                let t = from / (from - to);
                kept.push(a.towards(b, t));
            }
        }
        if kept.len() > size {
            return Err(NoResult::ArrayOverflow(size));
        }
        polygon = kept;
    }
    Ok(polygon)
}

/// Steps from the first to the last pixel of the device. The book maps [-1, 1] to 0..=size - 1; the
/// device is the smallest that holds the window and has 2^k steps, so that mapping a window position
/// there and back adds no error which the book's code does not have.
fn device_steps(bounds: PixelRect) -> DVec2 {
    let steps = |side: u32| f64::from((side.max(2) - 1).next_power_of_two());
    DVec2::new(steps(bounds.width()), steps(bounds.height()))
}

/// A corner on the screen after the viewport: position in pixels, depth, w, varying.
#[derive(Clone, Copy)]
struct Corner {
    at: DVec2,
    /// z over w, as the depth buffer of the book holds it.
    z: f64,
    w: f64,
    varying: DVec2,
}

/// A row of the triangle, with the values at its left and its right end.
struct ValuedRow {
    row: Row,
    /// At its left and its right end, as w and the attributes are.
    z: [f64; 2],
    w: [f64; 2],
    varying: [DVec2; 2],
}

impl BookFinal {
    /// Clips, fans, maps to the screen and walks; the visitor gets every row.
    fn rows(
        self,
        triangle: &RealTriangle,
        bounds: PixelRect,
        visit: &mut dyn FnMut(ValuedRow) -> Result<(), NoResult>,
    ) -> Result<(), NoResult> {
        let screen = BookScreen { bounds };
        let steps = device_steps(bounds);
        let corners = triangle.map_array(|v| {
            let ndc = screen.position(v.position_px) / (steps / 2.0) - 1.0;
            let position = DVec4::new(ndc.x * v.w, ndc.y * v.w, v.depth * v.w, v.w);
            ClipVertex { position, varying: v.varying }
        });
        let polygon = clip(corners)?;
        for pair in polygon.get(1..).unwrap_or_default().windows(2) {
            let fan = [polygon[0], pair[0], pair[1]];
            let divided = fan.map_array(|v| v.position.truncate() / v.position.w);
            if twice_area(divided.map_array(|p| p.truncate())).abs() < AREA_LIMIT {
                continue;
            }
            let on_screen = [0, 1, 2].map_array(|i| Corner {
                at: (divided[i].truncate() + 1.0) / 2.0 * steps,
                z: divided[i].z,
                w: fan[i].position.w,
                varying: fan[i].varying,
            });
            self.triangle(on_screen, screen.size().1, visit)?;
        }
        Ok(())
    }

    fn triangle(
        self,
        corners: [Corner; 3],
        rows: i64,
        visit: &mut dyn FnMut(ValuedRow) -> Result<(), NoResult>,
    ) -> Result<(), NoResult> {
        // Split the long edge, with perspective for w and the varying and without for z.
        let [low, middle, high] = sorted(corners.map_array(|c| c.at)).map_array(|i| corners[i]);
        let (at, share) = split(low.at, middle.at, high.at);
        let split = Corner {
            at,
            z: low.z + (high.z - low.z) * share,
            w: formulas::w(low.w, high.w, share),
            varying: formulas::value(low.w, high.w, low.varying, high.varying, share),
        };
        let (left, right) =
            if middle.at.x > split.at.x { (split, middle) } else { (middle, split) };
        // Start and end of the left and the right side of each half.
        let sides = [[(low, left), (low, right)], [(left, high), (right, high)]];

        let mut half = usize::MAX;
        let mut z = [0.0; 2];
        let mut t = [0.0; 2];
        walk([low.at, left.at, right.at, high.at], true, rows, |row| {
            let sides = &sides[row.half];
            if half != row.half {
                half = row.half;
                z = sides.map_array(|(start, _)| start.z);
                t = [0.0; 2];
            }
            let (mut w, mut varying) = ([0.0; 2], [DVec2::ZERO; 2]);
            for (side, (a, b)) in sides.iter().enumerate() {
                w[side] = formulas::w(a.w, b.w, t[side]);
                varying[side] = formulas::value(a.w, b.w, a.varying, b.varying, t[side]);
            }
            visit(ValuedRow { row, z, w, varying })?;
            for side in [0, 1] {
                let (a, b) = &sides[side];
                t[side] += 1.0 / (b.at.y - a.at.y);
                if self.exercise && t[side] > 1.0 {
                    t[side] = 1.0;
                }
                z[side] += (b.z - a.z) / (b.at.y - a.at.y);
            }
            Ok(())
        })
    }
}

impl Published for BookFinal {
    fn cover(&self, triangle: &RealTriangle, bounds: PixelRect, emit: Spans<'_>) -> DrawResult {
        let screen = BookScreen { bounds };
        self.rows(triangle, bounds, &mut |ValuedRow { row, .. }| {
            if let Some((first, last)) = int_loop(row.left, row.right)?
                && let Some(span) = screen.span(row.y, first, last)
            {
                emit(span);
            }
            Ok(())
        })
    }

    /// Before the depth test, which drops a fragment farther than what was there.
    fn fragments(
        &self,
        triangle: &RealTriangle,
        bounds: PixelRect,
        emit: Fragments<'_>,
    ) -> DrawResult {
        let screen = BookScreen { bounds };
        let mut columns = Columns::default();
        self.rows(triangle, bounds, &mut |ValuedRow { row, z, w, varying }| {
            let Some((first, last)) = int_loop(row.left, row.right)? else { return Ok(()) };
            let Some(span) = screen.span(row.y, first, last) else { return Ok(()) };
            columns.add(first)?;
            let length = row.right - row.left;
            // t' is 0 at the first pixel, whose column was truncated, and not at the side of the triangle.
            let (dt, dz) = (1.0 / length, (z[1] - z[0]) / length);
            let (mut t, mut depth) = (0.0, z[0]);
            for x in first..=last.min(screen.size().0 - 1) {
                if x >= 0 {
                    let (x_px, _) = screen.pixel(x, row.y);
                    let varying = formulas::value(w[0], w[1], varying[0], varying[1], t);
                    emit(Fragment { x_px, y_px: span.y_px, depth, varying });
                }
                t += dt;
                depth += dz;
            }
            Ok(())
        })
    }
}

/// A triangle that holds nearly the whole screen and touches its corners but for the last bit, or
/// one that is cut at three borders.
pub fn draw_clip(version: Version, setting: Setting) -> Image {
    let triangle = match setting {
        Setting::Exposing => [
            [1.750189983469843, -1.750189983469843, 1.3190638062753726, 1.750189983469843],
            [-1.905683186406554, -1.0000000000000002, 0.41618974220568494, 1.0],
            [1.8917334344143573, 5.448163312758888, -0.8406224546287921, 1.8917334344143568],
        ]
        .map_array(|p| ClipVertex { position: p.into(), varying: DVec2::ZERO }),
        Setting::Harmless => {
            [(-1.5, -0.7), (1.5, -0.8), (0.2, 1.5)].map_array(|(x, y)| clip_vertex(x, y, 0.0, 1.0))
        }
    };
    let polygon = match version {
        // Memory is overwritten; nothing that could be drawn is defined.
        Version::Published => clip(triangle).unwrap_or_default(),
        Version::Repaired => {
            let mut polygon = triangle.to_vec();
            for border in &BORDERS {
                polygon = clip_by_sign(&polygon, border);
            }
            polygon
        }
    };
    let mut image = empty(SIDE);
    fill_clipped(&mut image, &polygon, COLOURS[0]);
    image
}
