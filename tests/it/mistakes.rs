//! Wrong programs, written apart from the table of mistakes, and the mistake that is named for each.

use glam::DVec2;
use rayon::prelude::*;

use crate::pages::read;
use crate::program::{self, every};
use crate::snapshots::check_words;
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::{Interpolate as _, Rasterize as _};
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_core::raster::scanline::Scanline;
use rasterproof_core::triangle::{Corners, Fragment, Span};
use rasterproof_faults::planted::exact::ExactMutant;
use rasterproof_faults::planted::{LineMutant, Mutant, TriangleMutant};
use rasterproof_invariants::implementations::{Component, Implementations, component_of, hits};
use rasterproof_judge as judge;
use rasterproof_judge::ask::{Answer, Asked, Question, Subject};
use rasterproof_judge::declared::Declared;
use rasterproof_judge::in_process::Inside;
use rasterproof_judge::recognise::{Scope, recognise};
use rasterproof_judge::verdict::Scores as _;
use rasterproof_registry::engines;
use rasterproof_render::pipeline::ClipVertex;
use rasterproof_render::pipeline::assemble::Cull;
use rasterproof_render::pipeline::clip::ClipPlane;
use rasterproof_render::pipeline::multisample::{SAMPLES, masks_at};
use rasterproof_verify::ask::Search;
use rasterproof_verify::cases::Triangle;
use rasterproof_verify::cases::near_plane::{ClipCorner, clip_corners};
use rasterproof_verify::convention::{
    Declarations, LineConvention, LineQuestion, Quantum, Rounding, Shape, Ties, TriangleConvention,
    TriangleQuestion, Windings, diagnose, diagnose_lines,
};
use rasterproof_verify::mistakes::{self, Explanation, Mistakes, values};
use rasterproof_verify::oracle::values::ExactTriangle;

pub type Fill = fn(Corners, PixelRect, &mut Coverage);
/// The ends, and the last pixel of the window.
pub type Stroke = fn([[i32; 2]; 2], [i32; 2], &mut dyn FnMut(i32, i32));

pub fn right(corners: Corners, window: PixelRect, picture: &mut Coverage) {
    Scanline.cover(corners, window, |s| picture.hit(s.y_px, s.x0_px, s.x1_px));
}

fn light(picture: &mut Coverage, x: i32, y: i32) {
    if picture.bounds().contains(x, y) && picture.get(x, y) == Some(0) {
        picture.hit(y, x, x + 1);
    }
}

/// Draws the pixels of the window of which it is true.
fn fill_where(picture: &mut Coverage, holds: impl Fn(i32, i32) -> bool) {
    let window = picture.bounds();
    for y in window.y0..window.y1 {
        (window.x0..window.x1).filter(|x| holds(*x, y)).for_each(|x| light(picture, x, y));
    }
}

fn shifted(c: Corners, x: i32, y: i32) -> Corners {
    c.map_array(|p| SubpixelPoint::new(p.x.saturating_add(x), p.y.saturating_add(y)))
}

/// The picture without the pixels of which it is false.
fn only(picture: &mut Coverage, kept: impl Fn(i32, i32) -> bool) {
    let all: Vec<_> = picture.runs().flat_map(|(y, a, b)| (a..b).map(move |x| (x, y))).collect();
    let window = picture.bounds();
    *picture = Coverage::new(window, 0);
    all.into_iter().filter(|&(x, y)| kept(x, y)).for_each(|(x, y)| light(picture, x, y));
}

fn area(c: Corners) -> i64 {
    let at = |i: usize| (i64::from(c[i].x), i64::from(c[i].y));
    let ((ax, ay), (bx, by), (cx, cy)) = (at(0), at(1), at(2));
    (bx - ax).saturating_mul(cy - ay).saturating_sub((by - ay).saturating_mul(cx - ax))
}

/// Tests each sample at the centre by signed products, positive inside, of the edges in the given order.
fn tested(
    c: Corners,
    picture: &mut Coverage,
    product: impl Fn([i64; 2], [i64; 2], [i64; 2]) -> i64,
    inside: impl Fn(usize, i64, [i64; 2]) -> bool,
) {
    fill_where(picture, |x, y| {
        let at = [i64::from(x) * 256 + 128, i64::from(y) * 256 + 128];
        is_inside(c, at, &product, &inside)
    });
}

/// The same test of one point; nothing is inside of a triangle without area.
fn is_inside(
    c: Corners,
    at: [i64; 2],
    product: &impl Fn([i64; 2], [i64; 2], [i64; 2]) -> i64,
    inside: &impl Fn(usize, i64, [i64; 2]) -> bool,
) -> bool {
    let p = c.map_array(|p| [i64::from(p.x), i64::from(p.y)]);
    let turns = product(p[0], p[1], p[2]).signum();
    turns != 0
        && (0..3).all(|i| {
            let (from, to) = (p[i], p[(i + 1) % 3]);
            let along = [0, 1].map(|k| turns * (to[k] - from[k]));
            inside(i, turns * product(from, to, at), along)
        })
}

fn exactly(a: [i64; 2], b: [i64; 2], p: [i64; 2]) -> i64 {
    (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
}

/// Clockwise with y down: a top edge runs to the right, a left one up.
fn owns([dx, dy]: [i64; 2]) -> bool {
    dy < 0 || (dy == 0 && dx > 0)
}

/// Whether an exact test by the rule of top and left edges takes a point for inside.
fn covers(c: Corners, at: [i64; 2]) -> bool {
    is_inside(c, at, &exactly, &|_, e, along| e > 0 || (e == 0 && owns(along)))
}

/// The same, but every point of an edge is inside.
fn touches(c: Corners, at: [i64; 2]) -> bool {
    is_inside(c, at, &exactly, &|_, e, _| e >= 0)
}

/// The heights of the corners, the least first.
fn heights(c: Corners) -> [i32; 3] {
    let mut y = c.map_array(|p| p.y);
    y.sort_unstable();
    y
}

fn extent(c: Corners, axis: usize) -> [i32; 2] {
    let v = c.map_array(|p| [p.x, p.y][axis]);
    [v.into_iter().min().unwrap(), v.into_iter().max().unwrap()]
}

pub const FILLS: &[(&str, Fill)] = &[
    ("neighbours of covered pixels", |c, w, out| {
        // Only pixels whose upper and lower neighbours are covered, too.
        let pictures = [0, 256, -256].map(|by| {
            let mut picture = Coverage::new(w, 0);
            right(shifted(c, 0, by), w, &mut picture);
            picture
        });
        right(c, w, out);
        only(out, |x, y| pictures.iter().all(|p| p.get(x, y).is_some_and(|hits| hits > 0)));
    }),
    ("every second row or column is moved", |c, w, out| {
        let mut other = Coverage::new(w, 0);
        right(shifted(c, 0, -128), w, &mut other);
        right(c, w, out);
        only(out, |x, _| x % 2 == 1);
        for (y, from, to) in other.runs() {
            (from..to).filter(|x| x % 2 == 0).for_each(|x| light(out, x, y));
        }
    }),
    ("the search for pixels ends too early", |c, w, out| {
        // The end of a row is looked for leftwards, beginning at the end of the row before.
        let mut most = w.x1;
        Scanline.cover(c, w, |s| {
            most = most.min(s.x1_px);
            (s.x0_px..most).for_each(|x| light(out, x, s.y_px));
        });
    }),
    ("the search for pixels ends too early", |c, w, out| {
        let mut last = None;
        Scanline.cover(c, w, |s| {
            if last.is_none_or(|last| s.y_px <= last + 1) {
                last = Some(s.y_px);
                out.hit(s.y_px, s.x0_px, s.x1_px);
            }
        });
    }),
    ("rows keep their length at the window", |c, w, out| {
        let wide = PixelRect { x0: -(1 << 22), x1: 1 << 22, ..w };
        Scanline.cover(c, wide, |s| {
            let from = s.x0_px.max(0);
            let to = (from + (s.x1_px - s.x0_px)).min(w.x1);
            (from..to).for_each(|x| light(out, x, s.y_px));
        });
    }),
    ("tiles are skipped", |c, w, out| {
        // Blocks of 4 that are not full are drawn by a loop that ends a row too early.
        right(c, w, out);
        let full = out.clone();
        let has = |x: i32, y: i32| full.get(x, y).is_some_and(|hits| hits > 0);
        only(out, |x, y| {
            let (x, y0) = (x & !3, y & !3);
            y % 4 < 3 || [(x, y0), (x + 3, y0), (x, y), (x + 3, y)].iter().all(|p| has(p.0, p.1))
        });
    }),
    ("the rest of a group", |c, w, out| {
        // Both ends of a row are cut down to a multiple of 4.
        Scanline.cover(c, w, |s| (s.x0_px & !3..s.x1_px & !3).for_each(|x| light(out, x, s.y_px)));
    }),
    ("the box misses a corner", |c, w, out| {
        // The columns come from the last two corners alone.
        let [a, b] = [c[1].x.min(c[2].x) >> 8, c[1].x.max(c[2].x) >> 8];
        right(c, w, out);
        only(out, |x, _| (a..=b).contains(&x));
    }),
    ("parts of the window are never drawn", |c, w, out| {
        right(c, w, out);
        only(out, |x, y| (x + y) % 2 == 0);
    }),
    ("rounding of floats", |c, _, out| {
        // The test of a point by two vectors and their dot products, as many copy it.
        let p = c.map_array(|p| [p.x as f32 / 256.0, p.y as f32 / 256.0]);
        let minus = |p: [f32; 2], q: [f32; 2]| [p[0] - q[0], p[1] - q[1]];
        let dot = |p: [f32; 2], q: [f32; 2]| p[0] * q[0] + p[1] * q[1];
        let [v0, v1] = [minus(p[2], p[0]), minus(p[1], p[0])];
        let inverse = 1.0 / (dot(v0, v0) * dot(v1, v1) - dot(v0, v1) * dot(v0, v1));
        fill_where(out, |x, y| {
            let v2 = minus([x as f32 + 0.5, y as f32 + 0.5], p[0]);
            let u = (dot(v1, v1) * dot(v0, v2) - dot(v0, v1) * dot(v1, v2)) * inverse;
            let v = (dot(v0, v0) * dot(v1, v2) - dot(v0, v1) * dot(v0, v2)) * inverse;
            area(c) != 0 && u >= 0.0 && v >= 0.0 && u + v < 1.0
        });
    }),
    ("triangles are left out by size", |c, w, out| {
        // Slivers: twice the area is less than a tenth of the square of the longest side.
        let side = |i: usize| {
            let (a, b) = (c[i], c[(i + 1) % 3]);
            (f64::from(a.x) - f64::from(b.x)).powi(2) + (f64::from(a.y) - f64::from(b.y)).powi(2)
        };
        if area(c).abs() as f64 >= 0.1 * side(0).max(side(1)).max(side(2)) {
            right(c, w, out);
        }
    }),
    ("rule by winding", |c, _, out| {
        let strict = area(c) > 0;
        tested(c, out, exactly, |_, e, _| e > 0 || (e == 0 && !strict));
    }),
    ("rule by winding", |c, _, out| {
        // The corners are not brought into one winding before top and left are told apart.
        let flip = area(c).signum();
        tested(c, out, exactly, |_, e, [dx, dy]| e > 0 || (e == 0 && owns([flip * dx, flip * dy])));
    }),
    ("rule by order", |c, _, out| {
        tested(c, out, exactly, |i, e, _| if i == 1 { e > 0 } else { e >= 0 });
    }),
    ("rule after the shift", |c, _, out| {
        tested(c, out, exactly, |_, e, along| (e >> 6) - i64::from(!owns(along)) >= 0);
    }),
    ("rule after the shift", |c, _, out| {
        tested(c, out, exactly, |_, e, _| e / 1024 >= 0);
    }),
    ("an epsilon in the test", |c, _, out| {
        // In square pixels, inside.
        tested(c, out, exactly, |_, e, _| e as f64 / 65536.0 > 0.01);
    }),
    ("an edge is not tested", |c, _, out| {
        tested(c, out, exactly, |i, e, along| i == 2 || e > 0 || (e == 0 && owns(along)));
    }),
    ("product overflows", |c, _, out| {
        let narrow = |a: [i64; 2], b: [i64; 2], p: [i64; 2]| {
            let [ax, ay, bx, by, px, py] = [a[0], a[1], b[0], b[1], p[0], p[1]].map(|v| v as i32);
            let d = |a: i32, b: i32| a.wrapping_sub(b);
            let first = d(bx, ax).wrapping_mul(d(py, ay));
            i64::from(first.wrapping_sub(d(by, ay).wrapping_mul(d(px, ax))))
        };
        tested(c, out, narrow, |_, e, along| e > 0 || (e == 0 && owns(along)));
    }),
    ("coordinates overflow", |c, w, out| {
        // 12.4 in 16 bits.
        let word = |v: i32| i32::from((v / 16) as i16) * 16 + v % 16;
        right(c.map_array(|p| SubpixelPoint::new(word(p.x), word(p.y))), w, out);
    }),
    ("coordinates in short floats", |c, w, out| {
        let half = |v: i32| {
            let bits = (v as f32).to_bits();
            f32::from_bits((bits + 0xfff + (bits >> 13 & 1)) & !0x1fff) as i32
        };
        right(c.map_array(|p| SubpixelPoint::new(half(p.x), half(p.y))), w, out);
    }),
    ("each axis on a grid of its own", |c, w, out| {
        right(c.map_array(|p| SubpixelPoint::new(p.x / 64 * 64, p.y)), w, out);
    }),
    ("corners are clamped", |c, w, out| {
        right(c.map_array(|p| SubpixelPoint::new(p.x.max(0), p.y.max(0))), w, out);
    }),
    ("split at a rounded corner", |mut c, w, out| {
        c.sort_by_key(|p| p.y);
        let [a, b, z] = c;
        if z.y == a.y {
            return;
        }
        let x = f64::from(a.x) + f64::from(z.x - a.x) * f64::from(b.y - a.y) / f64::from(z.y - a.y);
        let cut = SubpixelPoint::new(((x / 64.0 + 0.5).floor() * 64.0) as i32, b.y);
        if a.y == b.y || b.y == z.y {
            return right(c, w, out);
        }
        for half in [[a, b, cut], [b, cut, z]] {
            let mut part = Coverage::new(w, 0);
            right(half, w, &mut part);
            for (y, x0, x1) in part.runs() {
                (x0..x1).for_each(|x| light(out, x, y));
            }
        }
    }),
    ("triangles are left out by size", |c, w, out| {
        let [low, high] = extent(c, 0);
        if i64::from(high) - i64::from(low) >= 3 * 256 {
            right(c, w, out);
        }
    }),
    ("triangles are left out by size", |c, w, out| {
        if area(c).abs() < 300 * 131_072 {
            right(c, w, out);
        }
    }),
    ("triangles are left out by kind", |c, w, out| {
        let y = heights(c);
        if y[1] != y[2] || y[0] == y[1] {
            right(c, w, out);
        }
    }),
    ("a half is missing", |c, w, out| {
        let y = heights(c);
        right(c, w, out);
        only(out, |_, row| row * 256 + 128 >= y[1]);
    }),
    ("ends of rows or columns", |c, w, out| {
        Scanline.cover(c, w, |s| {
            if s.x1_px - s.x0_px > 1 {
                out.hit(s.y_px, s.x0_px, s.x1_px - 1);
            }
        });
    }),
    ("ends of rows or columns", |c, w, out| {
        Scanline.cover(c, w, |s| out.hit(s.y_px, s.x0_px, (s.x1_px + 1).min(w.x1)));
    }),
    ("the border of the window", |c, w, out| {
        right(c, w, out);
        only(out, |x, _| x + 1 < w.x1);
    }),
    ("the box is too small", |c, w, out| {
        let [[_, right_end], [_, lower_end]] = [extent(c, 0), extent(c, 1)];
        right(c, w, out);
        only(out, |x, y| x < right_end >> 8 && y < lower_end >> 8);
    }),
    ("tiles are skipped", |c, w, out| {
        right(c, w, out);
        let full = out.clone();
        only(out, |x, y| {
            let at = [x & !7, y & !7].map(|v| v + 4);
            full.get(at[0].min(w.x1 - 1), at[1].min(w.y1 - 1)).is_some_and(|hits| hits > 0)
        });
    }),
    ("parts of the window are never drawn", |c, w, out| {
        right(c, w, out);
        only(out, |x, _| x % 8 != 7);
    }),
    ("rounding of floats", |c, _, out| {
        let px = c.map_array(|p| [p.x as f32 / 256.0, p.y as f32 / 256.0]);
        let turns = area(c) as f32;
        if area(c) == 0 {
            return;
        }
        fill_where(out, |x, y| {
            let at = [x as f32 + 0.5, y as f32 + 0.5];
            (0..3).all(|i| {
                let (p, q) = (px[i], px[(i + 1) % 3]);
                let s = turns.signum();
                let e = s * ((q[0] - p[0]) * (at[1] - p[1]) - (q[1] - p[1]) * (at[0] - p[0]));
                e >= 0.0
            })
        });
    }),
    ("rounding of floats", |mut c, _, out| {
        // Weights divided by the area, the third from the other two.
        if area(c) == 0 {
            return;
        }
        if area(c) < 0 {
            c.swap(1, 2);
        }
        let px = c.map_array(|p| [p.x as f32 / 256.0, p.y as f32 / 256.0]);
        let edge = |p: [f32; 2], q: [f32; 2], at: [f32; 2]| {
            (q[0] - p[0]) * (at[1] - p[1]) - (q[1] - p[1]) * (at[0] - p[0])
        };
        let whole = edge(px[0], px[1], px[2]);
        fill_where(out, |x, y| {
            let at = [x as f32 + 0.5, y as f32 + 0.5];
            let (u, v) = (edge(px[1], px[2], at) / whole, edge(px[2], px[0], at) / whole);
            u >= 0.0 && v >= 0.0 && 1.0 - u - v >= 0.0
        });
    }),
    ("crossings are stepped", |mut c, w, out| {
        // A 16.16 slope that is cut and added row by row.
        c.sort_by_key(|p| p.y);
        let first = |y: i32| (y + 127).div_euclid(256);
        if first(c[2].y) <= first(c[0].y) || first(c[0].y) < -65_536 {
            return;
        }
        let start = |a: SubpixelPoint, b: SubpixelPoint| {
            let dy = i64::from((b.y - a.y).max(1));
            let slope = i64::from(b.x - a.x) * 65536 / dy;
            let ahead = i64::from(first(a.y)) * 256 + 128 - i64::from(a.y);
            (i64::from(a.x) * 256 + ((slope * ahead) >> 8), slope)
        };
        let (mut x, slope) = start(c[0], c[2]);
        for [a, b] in [[c[0], c[1]], [c[1], c[2]]] {
            let (mut other, other_slope) = start(a, b);
            for y in first(a.y)..first(b.y) {
                let pixel = |x: i64| ((x + 32767) >> 16) as i32;
                if (w.y0..w.y1).contains(&y) {
                    let (l, r) = (pixel(x.min(other)), pixel(x.max(other)));
                    (l.max(0)..r.min(w.x1)).for_each(|x| light(out, x, y));
                }
                (x, other) = (x + slope, other + other_slope);
                if y >= w.y1 {
                    return;
                }
            }
        }
    }),
    ("whole pixels between crossings", |c, w, out| {
        // The last row is drawn, and a crossing loses its fraction by a cast.
        let corners = c.map(|p| [p.x >> 8, p.y >> 8].map(f64::from));
        let ys = corners.map(|p| p[1]);
        let [top, bottom] = [
            ys.iter().copied().fold(f64::MAX, f64::min),
            ys.iter().copied().fold(f64::MIN, f64::max),
        ];
        for y in w.y0.max(top as i32)..w.y1.min(bottom as i32 + 1) {
            let at = f64::from(y);
            let mut crossings = Vec::new();
            for (from, to) in [(0, 1), (1, 2), (2, 0)].map(|(i, j)| (corners[i], corners[j])) {
                let crosses = (from[1] <= at) != (to[1] <= at);
                let ends = at == bottom && from[1] != to[1] && at == from[1].max(to[1]);
                if crosses || ends {
                    let over = (at - from[1]) * (to[0] - from[0]) + from[0] * (to[1] - from[1]);
                    crossings.push((over / (to[1] - from[1])) as i32);
                }
            }
            crossings.sort_unstable();
            for pair in crossings.chunks_exact(2) {
                (pair[0].max(w.x0)..(pair[1] + 1).min(w.x1)).for_each(|x| light(out, x, y));
            }
        }
    }),
    ("whole pixels by integer divisions", |c, w, out| {
        // The loop of libraries for small displays, with rounded corners.
        let mut p = c.map_array(|p| [(p.x + 128) >> 8, (p.y + 128) >> 8].map(i64::from));
        p.sort_by_key(|p| p[1]);
        let mut row = |y: i64, a: i64, b: i64| {
            if (0..i64::from(w.y1)).contains(&y) {
                let (a, b) = (a.min(b).max(0), a.max(b).min(i64::from(w.x1) - 1));
                (a..=b).for_each(|x| light(out, x as i32, y as i32));
            }
        };
        let [[x0, y0], [x1, y1], [x2, y2]] = p;
        if y0 == y2 {
            return row(y0, x0.min(x1).min(x2), x0.max(x1).max(x2));
        }
        let last = if y1 == y2 { y1 } else { y1 - 1 };
        for y in y0.max(-1)..=last.min(64) {
            row(
                y,
                x0 + (x1 - x0) * (y - y0) / (y1 - y0).max(1),
                x0 + (x2 - x0) * (y - y0) / (y2 - y0),
            );
        }
        for y in y1.max(-1)..=y2.min(64) {
            if y1 < y2 {
                row(
                    y,
                    x1 + (x2 - x1) * (y - y1) / (y2 - y1),
                    x0 + (x2 - x0) * (y - y0) / (y2 - y0),
                );
            }
        }
    }),
    // In 16 bits, corners too.
    ("whole pixels by integer divisions", |c, _, out| {
        let mut p = c.map_array(|p| [p.x.div_euclid(256) as i16, p.y.div_euclid(256) as i16]);
        p.sort_by_key(|p| p[1]);
        let [[x0, y0], [x1, y1], [x2, y2]] = p;
        let mut row = |y: i16, a: i16, b: i16| {
            (a.min(b).max(0)..=a.max(b).min(64)).for_each(|x| light(out, x.into(), y.into()));
        };
        if y0 == y2 {
            return row(y0, x0.min(x1).min(x2), x0.max(x1).max(x2));
        }
        let at = |x: i16, dx: i16, ahead: i16, dy: i16| {
            x.wrapping_add(dx.wrapping_mul(ahead).wrapping_div(dy))
        };
        for y in y0.max(0)..=y2.min(64) {
            let long = at(x0, x2.wrapping_sub(x0), y.wrapping_sub(y0), y2.wrapping_sub(y0));
            if y < y1 || y1 == y2 {
                let short = if y1 == y0 {
                    x1
                } else {
                    at(x0, x1.wrapping_sub(x0), y.wrapping_sub(y0), y1.wrapping_sub(y0))
                };
                row(y, short, long);
            } else {
                row(y, at(x1, x2.wrapping_sub(x1), y.wrapping_sub(y1), y2.wrapping_sub(y1)), long);
            }
        }
    }),
    ("each axis on a grid of its own", |c, w, out| {
        // x up and y toward zero, to 1/16 px.
        let to =
            |p: SubpixelPoint| SubpixelPoint::new((p.x + 15).div_euclid(16) * 16, p.y / 16 * 16);
        right(c.map_array(to), w, out);
    }),
    ("edges are moved", |c, _, out| {
        // 1/8 px out, at right angles.
        let wide = c.map_array(|p| [f64::from(p.x), f64::from(p.y)]);
        tested(c, out, exactly, |i, e, _| {
            let lengths = [0, 1, 2].map(|k: usize| {
                let [p, q] = [wide[k], wide[(k + 1) % 3]];
                ((q[0] - p[0]).powi(2) + (q[1] - p[1]).powi(2)).sqrt()
            });
            e as f64 + lengths[i] * 32.0 > 0.0
        });
    }),
    ("weights are cut", |c, _, out| {
        // 8 bits, cut toward zero.
        let whole = area(c).abs();
        tested(c, out, exactly, |_, e, _| i128::from(e) * 256 / i128::from(whole.max(1)) >= 0);
    }),
    ("corners are clamped", |c, w, out| {
        // A guard band of 1024 px.
        let to = |v: i32| v.clamp(-1024 * 256, 1023 * 256);
        right(c.map_array(|p| SubpixelPoint::new(to(p.x), to(p.y))), w, out);
    }),
    ("product overflows", |c, w, out| {
        // The words of the products overflow, those of their difference do not; in the box of the corners.
        let product = |a: [i64; 2], b: [i64; 2], p: [i64; 2]| {
            let d = |a: i64, b: i64| (a - b) as i32;
            let first = d(b[0], a[0]).wrapping_mul(d(p[1], a[1]));
            i64::from(first) - i64::from(d(b[1], a[1]).wrapping_mul(d(p[0], a[0])))
        };
        let turns = area(c).signum();
        let ([x0, x1], [y0, y1]) = (extent(c, 0), extent(c, 1));
        let p = c.map_array(|p| [i64::from(p.x), i64::from(p.y)]);
        for y in w.y0.max(y0 >> 8)..w.y1.min((y1 >> 8) + 1) {
            for x in w.x0.max(x0 >> 8)..w.x1.min((x1 >> 8) + 1) {
                let at = [i64::from(x) * 256 + 128, i64::from(y) * 256 + 128];
                let holds = (0..3).all(|i| {
                    let (from, to) = (p[i], p[(i + 1) % 3]);
                    let e = turns * product(from, to, at);
                    e > 0 || (e == 0 && owns([0, 1].map(|k| turns * (to[k] - from[k]))))
                });
                if turns != 0 && holds {
                    light(out, x, y);
                }
            }
        }
    }),
    ("rule by order", |mut c, _, out| {
        // Counterclockwise corners are exchanged, and the first edge of the result owns all of its samples.
        if area(c) < 0 {
            c.swap(1, 2);
        }
        tested(c, out, exactly, |i, e, along| e > 0 || (e == 0 && (i == 0 || owns(along))));
    }),
    ("an edge is not tested", |mut c, w, out| {
        // The second one, once the first and the last corner are exchanged; in the box.
        if area(c) < 0 {
            c.swap(0, 2);
        }
        let ([x0, x1], [y0, y1]) = (extent(c, 0), extent(c, 1));
        let mut all = Coverage::new(w, 0);
        tested(c, &mut all, exactly, |i, e, along| i == 1 || e > 0 || (e == 0 && owns(along)));
        only(&mut all, |x, y| (x0 >> 8..=x1 >> 8).contains(&x) && (y0 >> 8..=y1 >> 8).contains(&y));
        *out = all;
    }),
    ("triangles are left out by kind", |c, w, out| {
        // Backs are told apart by corners in whole pixels.
        let whole = c.map_array(|p| SubpixelPoint::new(p.x & !255, p.y & !255));
        if area(whole).signum() == area(c).signum() {
            right(c, w, out);
        }
    }),
    ("a half is missing", |c, w, out| {
        // The row of the middle corner.
        let y = heights(c);
        right(c, w, out);
        only(out, |_, row| row != (y[1] + 127).div_euclid(256));
    }),
    ("tiles are skipped", |c, w, out| {
        // Tiles of 4 pixels with no corner inside.
        right(c, w, out);
        only(out, |x, y| {
            [[0, 0], [4, 0], [0, 4], [4, 4]].iter().any(|[dx, dy]| {
                touches(c, [(x & !3) + dx, (y & !3) + dy].map(|v| i64::from(v) * 256))
            })
        });
    }),
    ("blocks are drawn whole", |c, w, out| {
        // Quads of pixels share the first one's answer.
        let mut first = Coverage::new(w, 0);
        right(c, w, &mut first);
        fill_where(out, |x, y| first.get(x & !1, y & !1).is_some_and(|hits| hits > 0));
    }),
    ("the rest of a group", |c, w, out| {
        // Rows are drawn in whole groups of 4.
        Scanline.cover(c, w, |s| {
            let end = s.x0_px + (s.x1_px - s.x0_px) / 4 * 4;
            (s.x0_px..end).for_each(|x| light(out, x, s.y_px));
        });
    }),
    ("the rest of a group", |c, w, out| {
        // The box of the corners begins at a multiple of 8.
        let first = ((extent(c, 0)[0] >> 8).max(0) + 7) / 8 * 8;
        right(c, w, out);
        only(out, |x, _| x >= first);
    }),
    ("pixels are drawn twice", |c, w, out| {
        let y = heights(c);
        let middle = (y[1] + 127).div_euclid(256);
        Scanline.cover(c, w, |s| {
            for _ in 0..if s.y_px == middle { 2 } else { 1 } {
                out.hit(s.y_px, s.x0_px, s.x1_px);
            }
        });
    }),
    ("edges in whole numbers", |c, _, out| {
        // Steps in 1/4 px.
        let turns = area(c).signum();
        let p = c.map_array(|p| [i64::from(p.x), i64::from(p.y)]);
        let at = [0, 1].map(|axis| i64::from((extent(c, axis)[0] >> 8).max(0)) * 256 + 128);
        fill_where(out, |x, y| {
            let holds = (0..3).all(|i| {
                let (from, to) = (p[i], p[(i + 1) % 3]);
                let along = [0, 1].map(|k| turns * (to[k] - from[k]));
                let step = along.map(|v| v / 64 * 64);
                let e = step[0] * (at[1] - from[1]) - step[1] * (at[0] - from[0]);
                let [dx, dy] =
                    [(x, at[0]), (y, at[1])].map(|(v, at)| i64::from(v) * 256 + 128 - at);
                let e = e + step[0] * dy - step[1] * dx;
                e > 0 || (e == 0 && owns(along))
            });
            turns != 0 && holds
        });
    }),
    ("rounding of floats", |c, _, out| {
        // Ericson's weights from dot products.
        if area(c) == 0 {
            return;
        }
        let p = c.map_array(|p| [p.x as f32 / 256.0, p.y as f32 / 256.0]);
        let minus = |p: [f32; 2], q: [f32; 2]| [p[0] - q[0], p[1] - q[1]];
        let dot = |p: [f32; 2], q: [f32; 2]| p[0] * q[0] + p[1] * q[1];
        let (v0, v1) = (minus(p[1], p[0]), minus(p[2], p[0]));
        let (d00, d01, d11) = (dot(v0, v0), dot(v0, v1), dot(v1, v1));
        let denominator = d00 * d11 - d01 * d01;
        fill_where(out, |x, y| {
            let v2 = minus([x as f32 + 0.5, y as f32 + 0.5], p[0]);
            let (d20, d21) = (dot(v2, v0), dot(v2, v1));
            let v = (d11 * d20 - d01 * d21) / denominator;
            let w = (d00 * d21 - d01 * d20) / denominator;
            1.0 - v - w >= 0.0 && v >= 0.0 && w >= 0.0
        });
    }),
    ("crossings are stepped", |c, w, out| {
        // Steps above the window are forgotten, and slopes have 12 bits that are rounded.
        let bits = |a: SubpixelPoint, b: SubpixelPoint| {
            let dy = f64::from((b.y - a.y).max(1));
            (f64::from(b.x - a.x) / dy * 4096.0 + 0.5).floor() / 4096.0
        };
        walked(c, w, out, &|row, a, b| {
            let first = (a.y + 127).div_euclid(256);
            let ahead = (f64::from(first) + 0.5) * 256.0 - f64::from(a.y);
            let start = f64::from(a.x) / 256.0 + (bits(a, b) * 16.0 * ahead).floor() / 4096.0;
            start + bits(a, b) * f64::from(row - first.max(0))
        });
    }),
    ("crossings are stepped", |mut c, w, out| {
        // From the lowest row upwards, by slopes that are divided, with samples at whole numbers.
        c.sort_by_key(|p| -p.y);
        let p = c.map_array(|p| [p.x, p.y].map(|v| v as f32 / 256.0 - 0.5));
        let rows = p.map_array(|p| p[1].ceil() as i32);
        let slope = |i: usize, k: usize| match p[i][1] - p[k][1] {
            0.0 => 0.0,
            height => (p[i][0] - p[k][0]) / height,
        };
        let first = |i: usize, slope: f32| p[i][0] - slope * (p[i][1] - (rows[i] - 1) as f32);
        let mut long = first(0, slope(0, 2));
        for (i, k) in [(0, 1), (1, 2)] {
            let mut short = first(i, slope(i, k));
            for y in (rows[k]..rows[i]).rev() {
                let ends = [long.min(short), long.max(short)].map(|v| v.ceil() as i32);
                if (0..w.y1).contains(&y) {
                    (ends[0].max(0)..ends[1].min(w.x1)).for_each(|x| light(out, x, y));
                }
                (long, short) = (long - slope(0, 2), short - slope(i, k));
            }
        }
    }),
    ("crossings are stepped", |c, w, out| {
        // It is clipped in numbers from -1 to 1 and filled downwards, by products with a reciprocal. Where each side is level or
        // upright within half a pixel, it is a box.
        let flat =
            |a: SubpixelPoint, b: SubpixelPoint| (a.x - b.x).abs() < 128 || (a.y - b.y).abs() < 128;
        if flat(c[0], c[1]) && flat(c[1], c[2]) && flat(c[2], c[0]) {
            let mut ends = c;
            ends.sort_by_key(|p| p.x + p.y);
            for y in (ends[0].y / 256).max(0)..(ends[2].y / 256).min(w.y1) {
                let row = (ends[0].x / 256).max(0)..(ends[2].x / 256).min(w.x1);
                row.for_each(|x| light(out, x, y));
            }
            return;
        }
        let side = [w.x1 as f32, w.y1 as f32];
        let mut polygon: Vec<[f32; 2]> =
            c.iter().map(|p| [p.x, p.y].map(|v| v as f32 / 256.0)).collect();
        polygon.iter_mut().for_each(|p| *p = [0, 1].map(|k| 2.0 / side[k] * p[k] - 1.0));
        for (k, border) in [(0, 1.0_f32), (0, -1.0), (1, -1.0), (1, 1.0)] {
            let within = |p: [f32; 2]| 1.0 - border * p[k];
            let mut kept = Vec::new();
            for (i, to) in polygon.iter().enumerate() {
                let from = polygon[(i + polygon.len() - 1) % polygon.len()];
                if (within(from) < 0.0) != (within(*to) < 0.0) {
                    let part = within(from) / (within(from) - within(*to));
                    kept.push([0, 1].map(|k| from[k] * (1.0 - part) + to[k] * part));
                }
                if within(*to) >= 0.0 {
                    kept.push(*to);
                }
            }
            polygon = kept;
        }
        polygon.iter_mut().for_each(|p| {
            *p = [0, 1].map(|k| side[k] / 2.0 + p[k] * (side[k] / 2.0));
        });
        for i in 2..polygon.len() {
            let mut p = [polygon[0], polygon[i - 1], polygon[i]];
            p.sort_by(|a, b| a[1].total_cmp(&b[1]));
            let row = |i: usize| (p[i][1] - 0.5).ceil();
            let slope = |i: usize, k: usize| match p[k][1] - p[i][1] {
                0.0 => 0.0,
                height => (p[k][0] - p[i][0]) * (1.0 / height),
            };
            let first = |i: usize, slope: f32| p[i][0] + slope * (row(i) + 0.5 - p[i][1]);
            let mut long = first(0, slope(0, 2));
            for (i, k) in [(0, 1), (1, 2)] {
                let mut short = first(i, slope(i, k));
                for y in row(i) as i32..row(k) as i32 {
                    let ends = [long.min(short), long.max(short)].map(|v| (v - 0.5).ceil() as i32);
                    (ends[0].max(0)..ends[1].min(w.x1)).for_each(|x| light(out, x, y));
                    (long, short) = (long + slope(0, 2), short + slope(i, k));
                }
            }
        }
    }),
    ("corners are sorted by whole rows", |mut c, w, out| {
        c.sort_by_key(|p| p.y >> 8);
        walked_between(c, w, out, &|y, a, b| {
            let part =
                (f64::from(y) + 0.5 - f64::from(a.y) / 256.0) / (f64::from(b.y - a.y) / 256.0);
            f64::from(a.x) / 256.0 + f64::from(b.x - a.x) / 256.0 * part
        });
    }),
    ("blocks are drawn whole", |c, _, out| {
        // Two rows of four pixels are drawn as their middle is covered.
        fill_where(out, |x, y| {
            covers(c, [i64::from(x / 4 * 4 + 2) * 256, i64::from(y / 2 * 2 + 1) * 256])
        });
    }),
    ("the box misses a corner", |c, w, out| {
        right(c, w, out);
        let last = c[0].y.max(c[2].y) >> 8;
        only(out, |_, y| y <= last);
    }),
    ("width and height are exchanged", |c, w, out| {
        right(c, w, out);
        only(out, |x, _| x < w.y1);
    }),
    ("areas are compared", |c, _, out| {
        // Half of each cross product, with 1/1000 between.
        let p = c.map_array(|p| [p.x as f32 / 256.0, p.y as f32 / 256.0]);
        let part = |a: [f32; 2], b: [f32; 2], at: [f32; 2]| {
            ((a[0] - at[0]) * (b[1] - at[1]) - (a[1] - at[1]) * (b[0] - at[0])).abs() * 0.5
        };
        let whole = part(p[1], p[2], p[0]);
        fill_where(out, |x, y| {
            let at = [x as f32 + 0.5, y as f32 + 0.5];
            let sum = part(p[0], p[1], at) + part(p[1], p[2], at) + part(p[2], p[0], at);
            whole > 0.0 && (sum - whole).abs() <= 1e-3
        });
    }),
    ("corners are clamped", |c, w, out| {
        // To 300 px, x alone.
        right(c.map_array(|p| SubpixelPoint::new(p.x.clamp(-76_800, 76_800), p.y)), w, out);
    }),
    ("triangles are left out by kind", |c, w, out| {
        // The winding is that of one product.
        let [a, b, p] = c.map_array(|p| [i64::from(p.x), i64::from(p.y)]);
        if ((b[0] - a[0]) * (p[1] - a[1]) >= 0) == (area(c) > 0) {
            right(c, w, out);
        }
    }),
    ("the rest of a group", |c, w, out| {
        // From the multiple of 8 before the box on, whole groups alone.
        let first = (extent(c, 0)[0] >> 8).max(0) / 8 * 8;
        let end = ((extent(c, 0)[1] >> 8) + 1).min(w.x1);
        right(c, w, out);
        only(out, |x, _| x < first + (end - first) / 8 * 8);
    }),
    ("crossings are stepped", |c, w, out| {
        // A reciprocal of the height with 16 bits.
        walked(c, w, out, &|row, a, b| {
            let slope = i64::from(b.x - a.x) * (65536 / i64::from((b.y - a.y).max(1)));
            let ahead = f64::from(row) + 0.5 - f64::from(a.y) / 256.0;
            f64::from(a.x) / 256.0 + slope as f64 / 65536.0 * ahead
        });
    }),
    ("crossings are stepped", |c, w, out| {
        // Of whole pixels, with slopes in 1/1024 px, and with both ends and the last row drawn.
        let mut p = c.map_array(|p| [i64::from(p.x >> 8), i64::from(p.y >> 8)]);
        p.sort_by_key(|p| p[1]);
        let at = |a: [i64; 2], b: [i64; 2], y: i64| {
            let slope = (b[0] - a[0]) * 1024 / (b[1] - a[1]).max(1);
            (a[0] * 1024 + 512 + slope * (y - a[1])) >> 10
        };
        for y in p[0][1].max(0)..(p[2][1] + 1).min(w.y1.into()) {
            let short = if y < p[1][1] { at(p[0], p[1], y) } else { at(p[1], p[2], y) };
            let long = at(p[0], p[2], y);
            let ends = [long.min(short).max(0), (long.max(short) + 1).min(w.x1.into())];
            (ends[0]..ends[1]).for_each(|x| light(out, x as i32, y as i32));
        }
    }),
    ("rows end elsewhere", |c, w, out| {
        // Of rounded corners, from the pixel of the left crossing to the one before that of the right one, which is cut
        // toward zero, and the long edge is a row behind in the lower half.
        let mut p = c.map_array(|p| [(p.x + 128) >> 8, (p.y + 128) >> 8].map(f64::from));
        p.sort_by(|a, b| a[1].total_cmp(&b[1]));
        let at = |a: [f64; 2], b: [f64; 2], y: f64| {
            a[0] + (b[0] - a[0]) * ((y - a[1]) / (b[1] - a[1]).max(1.0))
        };
        for y in (p[0][1] as i32).max(0)..(p[2][1] as i32).min(w.y1) {
            let row = f64::from(y);
            let (short, long) = match row < p[1][1] {
                true => (at(p[0], p[1], row), at(p[0], p[2], row)),
                false => (at(p[1], p[2], row), at(p[0], p[2], row - 1.0)),
            };
            let end = |v: f64| v.floor().clamp(0.0, f64::from(w.x1)) as i32;
            (end(long.min(short))..end(long.max(short))).for_each(|x| light(out, x, y));
        }
    }),
    ("each axis on a grid of its own", |c, w, out| {
        // As an emulator has it: x in 1/16 px, y up to a whole row.
        let snapped = c.map_array(|p| {
            SubpixelPoint::new((p.x + 8).div_euclid(16) * 16, (p.y + 255).div_euclid(256) * 256)
        });
        right(snapped, w, out);
    }),
    ("ends of rows or columns", |c, w, out| {
        // The last row is missing, and the first one is drawn twice: one mistake beside the other.
        right(c, w, out);
        let rows: Vec<i32> = out.runs().map(|(y, ..)| y).collect();
        let (first, last) = (rows.first().copied(), rows.last().copied());
        only(out, |_, y| Some(y) != last);
        let runs: Vec<_> = out.runs().filter(|(y, ..)| Some(*y) == first).collect();
        runs.into_iter().for_each(|(y, a, b)| out.hit(y, a, b));
    }),
    ("blocks are drawn whole", |c, w, out| {
        // A hierarchy that takes a block for covered if three of its corner pixels are.
        right(c, w, out);
        let mut around = Coverage::new(PixelRect { x1: w.x1 + 3, y1: w.y1 + 3, ..w }, 0);
        right(c, around.bounds(), &mut around);
        let has = |x: i32, y: i32| i32::from(around.get(x, y).unwrap_or(0) > 0);
        for (y, x) in (w.y0..w.y1).flat_map(|y| (w.x0..w.x1).map(move |x| (y, x))) {
            let (left, top) = (x / 4 * 4, y / 4 * 4);
            if has(left, top) + has(left + 3, top) + has(left, top + 3) + has(left + 3, top + 3) > 2
            {
                light(out, x, y);
            }
        }
    }),
    ("rows end elsewhere", |c, w, out| {
        // No sub-pixel correction: rows are counted from the one that holds a corner.
        walked(c, w, out, &|y, from, to| {
            let slope = f64::from(to.x - from.x) / f64::from(to.y - from.y);
            f64::from(from.x) / 256.0 + slope * f64::from(y - from.y.div_euclid(256))
        });
    }),
    ("rows end elsewhere", |mut c, w, out| {
        // A pixel at least in each row, so that thin parts have no gaps.
        right(c, w, out);
        c.sort_by_key(|p| p.y);
        let first = |p: SubpixelPoint| (p.y + 127).div_euclid(256);
        let at = |y: i32, from: SubpixelPoint, to: SubpixelPoint| {
            let part = f64::from(y * 256 + 128 - from.y) / f64::from(to.y - from.y);
            (f64::from(from.x) + f64::from(to.x - from.x) * part) / 256.0
        };
        for y in first(c[0]).max(0)..first(c[2]).min(w.y1) {
            let short = if y < first(c[1]) { at(y, c[0], c[1]) } else { at(y, c[1], c[2]) };
            let x = (short.min(at(y, c[0], c[2])) - 0.5).ceil();
            light(out, x.clamp(-1.0, 9999.0) as i32, y);
        }
    }),
    ("the whole box is filled", |c, _, out| {
        let ([x0, x1], [y0, y1]) = (extent(c, 0), extent(c, 1));
        fill_where(out, |x, y| {
            let (u, v) = (x * 256 + 128, y * 256 + 128);
            area(c) != 0 && u >= x0 && u < x1 && v >= y0 && v < y1
        });
    }),
    ("two halves from their tips", |mut c, w, out| {
        // In floats of 64 bits, between whole corners; only the lower half draws the row between.
        c = c.map_array(|p| {
            let whole = |v: i32| (v + 128).div_euclid(256) * 256;
            SubpixelPoint::new(whole(p.x), whole(p.y))
        });
        c.sort_by_key(|p| p.y);
        let [top, middle, bottom] = c.map_array(|p| [p.x, p.y].map(|v| f64::from(v) / 256.0));
        let mut row = |y: f64, a: f64, b: f64| {
            let [first, last] = [a.min(b), a.max(b)].map(|v| v.floor().clamp(-1.0, 40.0) as i32);
            if y >= 0.0 && y < f64::from(w.y1) {
                (first..=last).for_each(|x| light(out, x, y as i32));
            }
        };
        let mut half = |tip: [f64; 2], a: [f64; 2], b: [f64; 2], step: f64, rows: f64| {
            let [da, db] = [a, b].map(|p| (p[0] - tip[0]) / (p[1] - tip[1]) * step);
            let (mut y, mut at) = (tip[1], [tip[0]; 2]);
            for _ in 0..rows.min(1e5) as i32 {
                row(y, at[0], at[1]);
                (y, at) = (y + step, [at[0] + da, at[1] + db]);
            }
        };
        if middle[1] == bottom[1] {
            return half(top, middle, bottom, 1.0, middle[1] - top[1]);
        }
        if top[1] == middle[1] {
            return half(bottom, top, middle, -1.0, bottom[1] - middle[1] + 1.0);
        }
        let part = (middle[1] - top[1]) / (bottom[1] - top[1]);
        let cut = [top[0] + part * (bottom[0] - top[0]), middle[1]];
        half(top, middle, cut, 1.0, middle[1] - top[1]);
        half(bottom, middle, cut, -1.0, bottom[1] - middle[1] + 1.0);
    }),
    ("all that edges touch", |c, w, out| {
        // Column by column, whatever the sides pass there; by the bottom-right rule inside.
        tested(c, out, exactly, |_, e, along| e > 0 || (e == 0 && !owns(along)));
        let points = c.map_array(|p| [p.x, p.y].map(|v| f64::from(v) / 256.0));
        for i in 0..3 {
            let [mut a, mut b] = [points[i], points[(i + 1) % 3]];
            if a[0] > b[0] {
                (a, b) = (b, a);
            }
            let mut column = |x: f64, from: f64, to: f64| {
                let rows = from.max(0.0) as i32..=to.clamp(-1.0, 40.0) as i32;
                (to >= 0.0).then(|| rows.for_each(|y| light(out, x as i32, y)));
            };
            if a[1].floor() == b[1].floor() {
                let columns = a[0].floor().max(0.0) as i32..=b[0].floor().min(40.0) as i32;
                columns.for_each(|x| light(out, x, a[1].floor() as i32));
                continue;
            }
            if a[0].floor() == b[0].floor() {
                column(a[0].floor(), a[1].min(b[1]).floor(), a[1].max(b[1]).floor());
                continue;
            }
            // From side to side of pixels, at least a little in each step.
            let slope = (b[1] - a[1]) / (b[0] - a[0]);
            let [mut x, mut y] = a;
            if x < 0.0 {
                (x, y) = (0.0, y - x * slope);
            }
            while x < b[0].min(f64::from(w.x1)) {
                light(out, x as i32, y.floor() as i32);
                let (dx, row) = ((x + 1.0).floor() - x, y.floor());
                let dy = match (y + dx * slope).floor() == row {
                    true => dx * slope,
                    false if slope < 0.0 => (row - y).min(-1e-9),
                    false => (row + 1.0 - y).max(1e-9),
                };
                (x, y) = if dy == dx * slope { (x + dx, y + dy) } else { (x + dy / slope, y + dy) };
            }
        }
    }),
    ("triangles are left out by size", |c, w, out| {
        if (0..2).all(|axis| extent(c, axis)[1].abs_diff(extent(c, axis)[0]) >= 384) {
            right(c, w, out);
        }
    }),
    ("rule by order", |c, _, out| {
        // All ties of the second edge, of clockwise triangles alone.
        let all = area(c) > 0;
        tested(c, out, exactly, |i, e, along| {
            e > 0 || (e == 0 && (owns(along) || (all && i == 1)))
        });
    }),
    ("weights are cut", |c, _, out| {
        // By a reciprocal of 32 bits, to 12 bits.
        let whole = area(c).abs();
        tested(c, out, exactly, |_, e, _| whole > 0 && (e * ((1_i64 << 32) / whole)) >> 20 >= 0);
    }),
    ("rounding of floats", |c, _, out| {
        // The products of the corners are exact, and rounded once.
        let edge = |a: [i64; 2], b: [i64; 2], p: [i64; 2]| {
            let [du, dv] = [a[1] - b[1], b[0] - a[0]].map(|v| v as f32);
            let rest = (a[0] * b[1] - a[1] * b[0]) as f32;
            ((du * p[0] as f32 + dv * p[1] as f32) + rest) as i64
        };
        tested(c, out, edge, |_, e, along| e > 0 || (e == 0 && owns(along)));
    }),
    ("tiles are skipped", |c, w, out| {
        // What does not lie in the triangle with all four corners.
        right(c, w, out);
        only(out, |x, y| {
            let [x, y] = [x & !3, y & !3].map(i64::from);
            [(0, 0), (3, 0), (0, 3), (3, 3)]
                .iter()
                .all(|(dx, dy)| touches(c, [(x + dx) * 256 + 128, (y + dy) * 256 + 128]))
        });
    }),
    ("rows end elsewhere", |c, w, out| {
        // Column by column, from the pixel of one crossing to that of the other.
        let mut turned = c.map_array(|p| SubpixelPoint::new(p.y, p.x));
        turned.sort_by_key(|p| p.y);
        let first = |p: SubpixelPoint| (p.y + 127).div_euclid(256);
        for x in first(turned[0]).max(0)..first(turned[2]).min(w.x1) {
            let at = |a: SubpixelPoint, b: SubpixelPoint| {
                let part = f64::from(x * 256 + 128 - a.y) / f64::from(b.y - a.y);
                (f64::from(a.x) + part * f64::from(b.x - a.x)) / 256.0
            };
            let short = if x < first(turned[1]) {
                at(turned[0], turned[1])
            } else {
                at(turned[1], turned[2])
            };
            let long = at(turned[0], turned[2]);
            let [low, high] =
                [long.min(short), long.max(short)].map(|v| v.floor().clamp(-1.0, 40.0) as i32);
            (low..=high).for_each(|y| light(out, x, y));
        }
    }),
];

/// Row by row, between the crossings that `at` gives for a row and an edge from its upper end on.
fn walked(
    mut c: Corners,
    w: PixelRect,
    out: &mut Coverage,
    at: &dyn Fn(i32, SubpixelPoint, SubpixelPoint) -> f64,
) {
    c.sort_by_key(|p| p.y);
    walked_between(c, w, out, at);
}

/// The same where the corners are in an order that may be another one.
fn walked_between(
    c: Corners,
    w: PixelRect,
    out: &mut Coverage,
    at: &dyn Fn(i32, SubpixelPoint, SubpixelPoint) -> f64,
) {
    let first = |p: SubpixelPoint| (p.y + 127).div_euclid(256);
    for y in first(c[0]).max(0)..first(c[2]).min(w.y1) {
        let short = if y < first(c[1]) { at(y, c[0], c[1]) } else { at(y, c[1], c[2]) };
        let long = at(y, c[0], c[2]);
        let end = |v: f64| (v - 0.5).ceil().clamp(0.0, f64::from(w.x1)) as i32;
        (end(long.min(short))..end(long.max(short))).for_each(|x| light(out, x, y));
    }
}

/// Bresenham's loop as mostly printed.
fn bresenham([[mut x, mut y], [x1, y1]]: [[i32; 2]; 2], emit: &mut dyn FnMut(i32, i32)) {
    let (dx, dy) = ((x1 - x).abs(), -(y1 - y).abs());
    let (sx, sy) = ((x1 - x).signum(), (y1 - y).signum());
    let mut error = dx + dy;
    loop {
        emit(x, y);
        if (x, y) == (x1, y1) {
            return;
        }
        let twice = 2 * error;
        if twice >= dy {
            error += dy;
            x += sx;
        }
        if twice <= dx {
            error += dx;
            y += sy;
        }
    }
}

/// Each end that is beyond a side is moved to it along the line as it is then. Of the sum of its place and the way, the fraction
/// is cut, or of the way alone: as `is_sum` says, which hears whether it is the far end of a line across the window.
fn cut(
    [mut p, mut q]: [[i32; 2]; 2],
    last: [i32; 2],
    is_sum: &dyn Fn(bool) -> bool,
    emit: &mut dyn FnMut(i32, i32),
) {
    for k in [0, 1] {
        let slope = f64::from(q[1 - k] - p[1 - k]) / f64::from(q[k] - p[k]);
        if (p[k] < 0 && q[k] < 0) || (p[k] > last[k] && q[k] > last[k]) {
            return;
        }
        let across = p[k] < 0 && q[k] > last[k];
        for (end, is_far_end_across) in [(&mut p, false), (&mut q, across)] {
            let to = end[k].clamp(0, last[k]);
            if end[k] != to {
                let way = slope * f64::from(to - end[k]);
                end[1 - k] = match is_sum(is_far_end_across) {
                    true => (f64::from(end[1 - k]) + way) as i32,
                    false => end[1 - k] + way as i32,
                };
                end[k] = to;
            }
        }
    }
    bresenham([p, q], emit);
}

/// The longer side and the shorter one.
fn sides([a, b]: [[i32; 2]; 2]) -> [i32; 2] {
    let [dx, dy] = [(b[0] - a[0]).abs(), (b[1] - a[1]).abs()];
    [dx.max(dy), dx.min(dy)]
}

/// A step along the longer side after each pixel, and along the shorter one where `is_across`.
fn stepped(
    [a, b]: [[i32; 2]; 2],
    is_across: &mut dyn FnMut() -> bool,
    emit: &mut dyn FnMut(i32, i32),
) {
    let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    let is_steep = dy.abs() > dx.abs();
    let [mut x, mut y] = a;
    for _ in 0..=dx.abs().max(dy.abs()) {
        emit(x, y);
        let across = is_across();
        x += if !is_steep || across { dx.signum() } else { 0 };
        y += if is_steep || across { dy.signum() } else { 0 };
    }
}

/// A coordinate of the line after so many of its steps.
fn part([a, b]: [[i32; 2]; 2], k: usize, step: i32, steps: i32) -> f64 {
    f64::from(a[k]) + f64::from(b[k] - a[k]) * f64::from(step) / f64::from(steps.max(1))
}

pub const STROKES: &[(&str, Stroke)] = &[
    ("the error term is off", |ends, _, emit| {
        // It begins at a quarter of the longer side.
        let [long, short] = sides(ends);
        let mut error = long / 4;
        let mut is_across = || {
            error -= short;
            let across = error < 0;
            error += if across { long } else { 0 };
            across
        };
        stepped(ends, &mut is_across, emit);
    }),
    ("lines are left out by kind", |[a, b], _, emit| {
        // Upright lines are a loop from the first row up to the last one.
        if a[0] == b[0] {
            (a[1]..=b[1]).for_each(|y| emit(a[0], y));
        } else {
            bresenham([a, b], emit);
        }
    }),
    ("pixels at the ends", |[a, b], _, emit| {
        // Level and upright lines are rectangles of the width and the height.
        if a[1] == b[1] {
            (a[0].min(b[0])..a[0].max(b[0])).for_each(|x| emit(x, a[1]));
        } else if a[0] == b[0] {
            (a[1].min(b[1])..a[1].max(b[1])).for_each(|y| emit(a[0], y));
        } else {
            bresenham([a, b], emit);
        }
    }),
    ("ends overflow", |ends, _, emit| {
        bresenham(ends.map_array(|end| end.map_array(|v| i32::from(v as u8))), emit);
    }),
    ("each axis is rounded in its own way", |ends, _, emit| {
        let [steps, _] = sides(ends);
        for i in 0..=steps {
            let [x, y] = [0, 1].map(|k| part(ends, k, i, steps));
            emit((x + 0.5).floor() as i32, y.floor() as i32);
        }
    }),
    ("steps without the sign", |ends, _, emit| {
        let [a, b] = ends;
        let steps = (b[0] - a[0]).max(b[1] - a[1]);
        for i in 0..=steps {
            let [x, y] = [0, 1].map(|k| (part(ends, k, i, steps) + 0.5).floor() as i32);
            emit(x, y);
        }
    }),
    ("long lines end early", |ends, _, emit| {
        let mut left = 500;
        bresenham(ends, &mut |x, y| {
            if left > 0 {
                emit(x, y);
            }
            left -= 1;
        });
    }),
    ("ends are clamped to the window", |ends, _, emit| {
        bresenham(ends.map_array(|[x, y]| [x.clamp(-256, 255), y.clamp(-256, 255)]), emit);
    }),
    ("x and y are exchanged", |[a, b], _, emit| {
        let is_turned = (b[1] - a[1]).abs() > (b[0] - a[0]).abs() && b[0] < a[0];
        bresenham([a, b], &mut |x, y| if is_turned { emit(y, x) } else { emit(x, y) });
    }),
    ("pixels of the line are left out", |ends, _, emit| {
        let mut number = 0;
        bresenham(ends, &mut |x, y| {
            if number % 16 < 15 {
                emit(x, y);
            }
            number += 1;
        });
    }),
    ("drawn from both ends", |[mut a, mut b], _, emit| {
        let [dx, dy] = [0, 1].map(|k| (b[k] - a[k]).abs());
        let (steps, side, steep) = (dx.max(dy), dx.min(dy), dy > dx);
        let way = [0, 1].map(|k| (b[k] - a[k]).signum());
        let mut error = steps / 2;
        for _ in 0..=steps / 2 {
            emit(a[0], a[1]);
            emit(b[0], b[1]);
            error -= side;
            let across = error < 0;
            error += if across { steps } else { 0 };
            for k in [0, 1] {
                if (k == 1) == steep || across {
                    a[k] += way[k];
                    b[k] -= way[k];
                }
            }
        }
    }),
    ("the slope is cut", |[a, b], _, emit| {
        // 12 bits, and the last pixel is not drawn.
        let d = [0, 1].map(|k| i64::from(b[k] - a[k]));
        let steps = d[0].abs().max(d[1].abs());
        for i in 0..steps {
            let at =
                |k: usize| ((i64::from(a[k]) * 4096 + 2048 + d[k] * 4096 / steps * i) >> 12) as i32;
            emit(at(0), at(1));
        }
    }),
    ("every pixel that is touched", |[a, b], _, emit| {
        // By the times at which the line crosses the sides of pixels.
        let d = [0, 1].map(|k| f64::from((b[k] - a[k]).abs()));
        let (mut at, mut next) = (a, d.map(|d| 0.5 / d));
        emit(at[0], at[1]);
        for _ in 0..(d[0] + d[1]) as i32 {
            let k = usize::from(next[0] > next[1]);
            at[k] += (b[k] - a[k]).signum();
            next[k] += 1.0 / d[k];
            emit(at[0], at[1]);
        }
    }),
    ("steps are added up in floats", |[a, b], _, emit| {
        let steps = (b[0] - a[0]).abs().max((b[1] - a[1]).abs());
        for i in 0..=steps {
            let t = i as f32 / steps.max(1) as f32;
            let at = |k: usize| (a[k] as f32 * (1.0 - t) + b[k] as f32 * t) as i32;
            emit(at(0), at(1));
        }
    }),
    ("ends are clamped to the window", |ends, _, emit| {
        bresenham(ends.map(|end| end.map(|v| v.max(0))), emit);
    }),
    ("lines are left out by kind", |ends, _, emit| {
        if (ends[0][1] - ends[1][1]).abs() <= (ends[0][0] - ends[1][0]).abs() {
            bresenham(ends, emit);
        }
    }),
    ("every pixel that is touched", |[[x0, y0], [x1, y1]], _, emit| {
        // From the left end, and diagonally through corners.
        let ([mut x, mut y], [x1, y1]) =
            if (x0, y0) <= (x1, y1) { ([x0, y0], [x1, y1]) } else { ([x1, y1], [x0, y0]) };
        let (dx, dy) = (i64::from(x1 - x), i64::from((y1 - y).abs()));
        let down = (y1 - y).signum();
        let (mut i, mut j) = (0, 0);
        emit(x, y);
        while i < dx || j < dy {
            let side = (2 * i + 1) * dy - (2 * j + 1) * dx;
            if side <= 0 {
                x += 1;
                i += 1;
            }
            if side >= 0 {
                y += down;
                j += 1;
            }
            emit(x, y);
        }
    }),
    ("the slope is cut", |[[x0, y0], [x1, y1]], _, emit| {
        // 24.8 numbers.
        let steps = (x1 - x0).abs().max((y1 - y0).abs());
        let (sx, sy) = match steps {
            0 => (0, 0),
            _ => ((x1 - x0) * 256 / steps, (y1 - y0) * 256 / steps),
        };
        let (mut x, mut y) = (x0 * 256 + 128, y0 * 256 + 128);
        for _ in 0..=steps {
            emit(x >> 8, y >> 8);
            x += sx;
            y += sy;
        }
    }),
    ("steps are added up in floats", |[[x0, y0], [x1, y1]], _, emit| {
        let steps = (x1 - x0).abs().max((y1 - y0).abs());
        let by = |d: i32| if steps == 0 { 0.0 } else { d as f32 / steps as f32 };
        let (sx, sy) = (by(x1 - x0), by(y1 - y0));
        let (mut x, mut y) = (x0 as f32, y0 as f32);
        for _ in 0..=steps {
            emit(x.round() as i32, y.round() as i32);
            x += sx;
            y += sy;
        }
    }),
    ("steps along x alone", |[[x0, y0], [x1, y1]], _, emit| {
        let n = (x1 - x0).abs();
        for i in 0..=n {
            let t = if n == 0 { 0.0 } else { f64::from(i) / f64::from(n) };
            let y = (f64::from(y0) + t * f64::from(y1 - y0) + 0.5).floor();
            emit(x0 + i * (x1 - x0).signum(), y as i32);
        }
    }),
    ("ends overflow", |ends, _, emit| {
        bresenham(ends.map(|end| end.map(|v| i32::from(v as i16))), emit);
    }),
    ("pixels at the ends", |ends, _, emit| {
        bresenham(ends, &mut |x, y| {
            if ends[1][0] >= ends[0][0] || [x, y] != ends[1] {
                emit(x, y);
            }
        });
    }),
    ("lines are cut in whole numbers", |[a, b], last, emit| {
        // Cohen and Sutherland, with divisions that are cut.
        let (mut a, mut b) = (a.map(i64::from), b.map(i64::from));
        let last = last.map(i64::from);
        for _ in 0..8 {
            let outside = |p: [i64; 2], k: usize| p[k] < 0 || p[k] > last[k];
            let beyond = |k: usize| (a[k] < 0 && b[k] < 0) || (a[k] > last[k] && b[k] > last[k]);
            if beyond(0) || beyond(1) {
                return;
            }
            let Some(k) = [1, 0].into_iter().find(|k| outside(a, *k) || outside(b, *k)) else {
                return bresenham([a, b].map(|p| p.map(|v| v as i32)), emit);
            };
            let border = |v: i64| if v < 0 { 0 } else { last[k] };
            if outside(a, k) {
                let to = border(a[k]);
                let other = a[1 - k] + (b[1 - k] - a[1 - k]) * (to - a[k]) / (b[k] - a[k]);
                (a[k], a[1 - k]) = (to, other);
            } else {
                let to = border(b[k]);
                let other = a[1 - k] + (b[1 - k] - a[1 - k]) * (to - a[k]) / (b[k] - a[k]);
                (b[k], b[1 - k]) = (to, other);
            }
        }
    }),
    ("x and y are exchanged", |[a, b], _, emit| {
        let steep = (b[1] - a[1]).abs() > (b[0] - a[0]).abs();
        bresenham([a, b], &mut |x, y| if steep { emit(y, x) } else { emit(x, y) });
    }),
    ("steps are added up in floats", |[[x0, y0], [x1, y1]], _, emit| {
        // The half is added once, at the start.
        let steps = (x1 - x0).abs().max((y1 - y0).abs());
        let by = |d: i32| if steps == 0 { 0.0 } else { d as f32 / steps as f32 };
        let (mut x, mut y) = (x0 as f32 + 0.5, y0 as f32 + 0.5);
        for _ in 0..=steps {
            emit(x.floor() as i32, y.floor() as i32);
            x += by(x1 - x0);
            y += by(y1 - y0);
        }
    }),
    ("two pixels wide", |ends, _, emit| {
        bresenham(ends, &mut |x, y| {
            emit(x, y);
            emit(x, y + 1);
        });
    }),
    ("the error term is off", |ends, _, emit| {
        // It begins at dy - dx in place of 2 dy - dx.
        let [long, short] = sides(ends);
        let mut error = short - long;
        let mut is_across = || {
            let across = error > 0;
            error += 2 * short - if across { 2 * long } else { 0 };
            across
        };
        stepped(ends, &mut is_across, emit);
    }),
    ("the error term overflows", |ends, _, emit| {
        // Half the steps, in 8 bits.
        let [long, short] = sides(ends);
        let mut error = (long / 2) as i8;
        let mut is_across = || {
            error = error.wrapping_sub(short as i8);
            let across = error < 0;
            error = error.wrapping_add(if across { long as i8 } else { 0 });
            across
        };
        stepped(ends, &mut is_across, emit);
    }),
    ("steps are added up in floats", |[a, b], _, emit| {
        // y = m x + b.
        let steep = (b[1] - a[1]).abs() > (b[0] - a[0]).abs();
        let turned = |p: [i32; 2]| if steep { [p[1], p[0]] } else { p };
        let [a, b] = [a, b].map(turned);
        let slope = if a[0] == b[0] { 0.0 } else { (b[1] - a[1]) as f32 / (b[0] - a[0]) as f32 };
        let height = a[1] as f32 - slope * a[0] as f32;
        for u in a[0].min(b[0])..=a[0].max(b[0]) {
            let [x, y] = turned([u, (slope * u as f32 + height).round() as i32]);
            emit(x, y);
        }
    }),
    ("lines are cut in whole numbers", |[a, b], last, emit| {
        // By the parts of the way at which the window begins and ends, one pixel after it; their distances are cut down.
        let way = [0, 1].map(|k| f64::from(b[k] - a[k]));
        let (mut from, mut to) = (0.0_f64, 1.0_f64);
        for k in [0, 1] {
            let ends = [0, last[k] + 1].map(|side| f64::from(side - a[k]) / way[k]);
            if way[k] != 0.0 {
                (from, to) = (from.max(ends[0].min(ends[1])), to.min(ends[0].max(ends[1])));
            } else if a[k] < 0 || a[k] > last[k] + 1 {
                return;
            }
        }
        let at = |t: f64| [0, 1].map(|k| a[k] + (way[k] * t).floor() as i32);
        if from <= to {
            bresenham([at(from), at(to)], emit);
        }
    }),
    ("lines are cut in whole numbers", |[mut a, mut b], last, emit| {
        // Where x leaves the window, whatever becomes of y.
        let (first, second) = (a, b);
        if (a[0] < 0 && b[0] < 0) || (a[0] > last[0] && b[0] > last[0]) {
            return;
        }
        for (end, other) in [(&mut a, second), (&mut b, first)] {
            let side = end[0].clamp(0, last[0]);
            if side != end[0] {
                let part = f64::from(other[1] - end[1]) * f64::from(side - end[0])
                    / f64::from(other[0] - end[0]);
                *end = [side, end[1] + part as i32];
            }
        }
        bresenham([a, b], emit);
    }),
    ("ties by direction", |ends, _, emit| {
        // On where lines run up or are steep and run to the left.
        let ([a, b], [long, short]) = (ends, sides(ends));
        let is_steep = (b[1] - a[1]).abs() > (b[0] - a[0]).abs();
        let is_on = b[1] < a[1] || (is_steep && b[0] < a[0]);
        let mut error = 2 * short - long;
        let mut is_across = || {
            let across = error > 0 || (is_on && error == 0);
            error += 2 * short - if across { 2 * long } else { 0 };
            across
        };
        stepped(ends, &mut is_across, emit);
    }),
    ("halved again and again", |[a, b], _, emit| {
        fn halves(a: [i32; 2], b: [i32; 2], emit: &mut dyn FnMut(i32, i32)) {
            let middle = [0, 1].map(|k| (a[k] + b[k]) >> 1);
            if middle == a || middle == b {
                emit(a[0], a[1]);
                return emit(b[0], b[1]);
            }
            halves(a, middle, emit);
            halves(middle, b, emit);
        }
        halves(a, b, emit);
    }),
    ("steps are added up in floats", |[a, b], _, emit| {
        // One step too many.
        let steps = (b[0] - a[0]).abs().max((b[1] - a[1]).abs());
        for i in 0..=steps {
            let at = |k: usize| {
                f64::from(a[k]) + f64::from(b[k] - a[k]) * (f64::from(i) / f64::from(steps + 1))
            };
            emit((at(0) + 0.5).floor() as i32, (at(1) + 0.5).floor() as i32);
        }
    }),
    ("ends overflow", |[a, b], _, emit| {
        bresenham([a, [0, 1].map(|k| a[k] + i32::from((b[k] - a[k]) as i8))], emit);
    }),
    ("lines are cut in whole numbers", |ends, last, emit| {
        // As gd does: each end is moved by a part that is cut, from itself.
        cut(ends, last, &|_| false, emit);
    }),
    ("lines are cut in whole numbers", |ends, last, emit| {
        // As older versions of gd do, and what was made of them: the sum is cut.
        cut(ends, last, &|_| true, emit);
    }),
    ("lines are cut in whole numbers", |ends, last, emit| {
        // As gd does: the sum is cut for the far ends of lines across the window, and a part for the others.
        cut(ends, last, &|is_far_end_across| is_far_end_across, emit);
    }),
    ("steps are added up in floats", |[a, b], last, emit| {
        // Through numbers from -1 to 1, clipped by the four sides in turn, to pixels with a half that is added; from end to end.
        let side = last.map(|v| (v + 1) as f32);
        let unit = |p: [i32; 2]| [0, 1].map(|k| 2.0 / side[k] * (p[k] as f32 + 0.5) - 1.0);
        let (a, b) = (unit(a), unit(b));
        let (mut p, mut q) = (a, b);
        for k in [0, 1] {
            for border in [-1.0_f32, 1.0] {
                let beyond = |v: f32| if border < 0.0 { v < border } else { v > border };
                if beyond(p[k]) && beyond(q[k]) {
                    return;
                }
                let at = (border - a[k]) / (b[k] - a[k]);
                let cut = [0, 1].map(|k| a[k] + at * (b[k] - a[k]));
                if beyond(p[k]) {
                    p = cut;
                } else if beyond(q[k]) {
                    q = cut;
                }
            }
        }
        let back = |p: [f32; 2]| {
            [0, 1].map(|k| (side[k] / 2.0 + p[k] * (side[k] / 2.0) + 0.5).floor() - 1.0)
        };
        let (from, to) = (back(p), back(q));
        let steps = (to[0] - from[0]).abs().max((to[1] - from[1]).abs());
        let mut at = from.map(|v| v + 0.5);
        for _ in 0..=steps as i32 {
            emit(at[0] as i32, at[1] as i32);
            at = [0, 1].map(|k| at[k] + (to[k] - from[k]) / steps.max(1.0));
        }
    }),
    ("one step at a time", |[[mut x, mut y], [x1, y1]], _, emit| {
        let [dx, dy] = [i64::from((x1 - x).abs()), i64::from((y1 - y).abs())];
        let (sx, sy, mut error) = ((x1 - x).signum(), (y1 - y).signum(), dx - dy);
        emit(x, y);
        for _ in 0..dx + dy {
            if 2 * error > -dy {
                (x, error) = (x + sx, error - dy);
            } else {
                (y, error) = (y + sy, error + dx);
            }
            emit(x, y);
        }
    }),
    ("the sign of a step", |[[x0, y0], [x1, y1]], _, emit| {
        bresenham([[x0, y0], [x1, y0 + (y1 - y0).abs()]], emit);
    }),
];

fn of_fill(fill: impl Fn(Corners, PixelRect, &mut Coverage)) -> Option<Mistakes> {
    of_fill_in(Declarations::default().window_px, fill)
}

/// The same of a program with windows of at most this size.
fn of_fill_in(
    window_px: (u32, u32),
    fill: impl Fn(Corners, PixelRect, &mut Coverage),
) -> Option<Mistakes> {
    let draw = |q: &TriangleQuestion| {
        let mut picture = Coverage::new(q.window, 0);
        fill(q.corners, q.window, &mut picture);
        Some(picture)
    };
    let known = Declarations { window_px, ..Declarations::default() };
    let search = Search::new(async |asker| {
        let found = diagnose(&asker, &known, 1).await;
        let learn: mistakes::LearnTriangles = mistakes::learn_triangles;
        mistakes::of_triangles(&asker, &known, Some(&found), &[], Some(learn)).await
    });
    search.answered_by(|questions| questions.iter().map(draw).collect())
}

/// What is said of a program that draws right by a convention, in windows of at most this size.
fn of_convention(convention: &TriangleConvention, window_px: (u32, u32)) -> Option<Mistakes> {
    of_fill_in(window_px, |corners, window, picture| {
        if let Some(drawn) = convention.cover(&corners, window) {
            *picture = drawn;
        }
    })
}

fn of_stroke(
    stroke: impl Fn([[i32; 2]; 2], [i32; 2], &mut dyn FnMut(i32, i32)),
) -> Option<Mistakes> {
    let draw = |q: &LineQuestion| {
        let mut pixels = Vec::new();
        stroke(q.ends, [q.window.x1 - 1, q.window.y1 - 1], &mut |x, y| {
            if q.window.contains(x, y) && !pixels.contains(&[x, y]) {
                pixels.push([x, y]);
            }
        });
        Some(pixels)
    };
    let known = Declarations::default();
    let search = Search::new(async |asker| {
        let found = diagnose_lines(&asker, 32, true, 1).await;
        mistakes::of_lines(&asker, &known, Some(&found), &[]).await
    });
    search.answered_by(|questions| questions.iter().map(draw).collect())
}

/// Every fifth program with its number, and at night each of them.
fn tried<P: Sync>(programs: &[P]) -> Vec<(usize, &P)> {
    programs.iter().enumerate().step_by(every(5)).collect()
}

/// What is said of each program, by its number, with the mistake that it has: all must have its name, or what was learned, which
/// predicts every answer.
fn check(name: &str, programs: Vec<(usize, &str, Option<Mistakes>)>) {
    let mut table = String::new();
    let mut unnamed = Vec::new();
    for (number, expected, found) in programs {
        let is_named = |found: &Mistakes| {
            let is_learned = found.learned.as_ref().is_some_and(|learned| learned.is_certain);
            is_learned || found.causes.iter().any(|c| c.name == expected)
        };
        let said = found.as_ref().map_or("nothing is wrong".to_owned(), ToString::to_string);
        table += &format!("{number}, {expected}: {said}\n");
        if !found.as_ref().is_some_and(is_named) {
            unnamed.push(format!("{number}, {expected}: {said}"));
        }
    }
    assert!(unnamed.is_empty(), "{}", unnamed.join("\n"));
    if every(5) == 1 {
        return check_words(name, &table);
    }
    let kept = read(format!("snapshots/{name}.snap"));
    for line in table.lines() {
        assert!(kept.lines().any(|kept| kept == line), "not in {name}: {line}");
    }
}

/// Every mistake that may draw nothing would explain it, so that none of them is named.
#[test]
fn what_draws_nothing_is_told_so() {
    for found in [of_stroke(|_, _, _| {}), of_fill(|_, _, _| {})] {
        let found = found.unwrap();
        assert_eq!(found.does().unwrap(), "draws nothing");
        assert_eq!(found.causes.len(), 1);
    }
}

/// Every mistake is named for a program that has it, with a parameter of its own.
#[test]
#[ignore = "takes a minute; .ci/run runs it"]
fn mistakes_in_triangles_are_named() {
    let programs = tried(FILLS);
    let found = programs.par_iter().map(|(number, (name, fill))| (*number, *name, of_fill(fill)));
    check("mistakes-in-triangles", found.collect());
}

/// The same for lines.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn mistakes_in_lines_are_named() {
    let programs = tried(STROKES);
    let found =
        programs.par_iter().map(|(number, (name, stroke))| (*number, *name, of_stroke(stroke)));
    check("mistakes-in-lines", found.collect());
}

/// Every mistake of the table has a program in this file, but for those that need a window or a declaration of their own, and areas,
/// which are compared with exact ones where they are computed.
#[test]
fn mistakes_of_the_table_are_tried() {
    let tried = |name: &str| {
        FILLS.iter().map(|(n, _)| n).chain(STROKES.iter().map(|(n, _)| n)).any(|n| *n == name)
    };
    let untried: Vec<_> =
        mistakes::table().into_iter().map(|m| m.name).filter(|name| !tried(name)).collect();
    let elsewhere = [
        "corners made by clipping are rounded",
        "small ones are drawn from behind",
        "coverage by area",
        "a stroke of area",
    ];
    assert_eq!(untried, elsewhere);
}

/// The Chinese page explains every mistake, and `list --mistakes` prints it with its repair.
#[test]
fn mistakes_of_the_table_are_on_the_page() {
    let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let page = words(include_str!("../../docs/zh/conventions.md"));
    for Explanation { name, .. } in mistakes::table() {
        assert!(page.contains(&format!("`{name}`")), "{name}");
    }
    let printed = words(&program::check("list --mistakes", 0).out);
    for Explanation { name, repair, .. } in mistakes::table() {
        assert!(printed.contains(&words(name)) && printed.contains(&words(&repair)), "{name}");
    }
}

/// The pages that mistakes name are there.
#[test]
fn mistakes_name_pages_that_exist() {
    for Explanation { name, page, .. } in mistakes::table() {
        assert!(std::path::Path::new("docs").join(format!("{page}.md")).exists(), "{name}: {page}");
    }
}

/// A convention is no mistake: none is named, whichever is drawn by.
#[test]
fn mistakes_are_not_named_for_conventions() {
    for step in [1, 16, 256] {
        for (i, rule) in ["top-left", "inclusive", "strict", "bottom-right"].into_iter().enumerate()
        {
            let [x, y] = [[128, 128], [0, 0], [64, 192], [256, 128]][(i + step as usize) % 4];
            let convention = TriangleConvention {
                quantum: Quantum { step, rounding: Rounding::Down },
                shape: Shape::Point { x, y },
                ties: Ties::named(rule).unwrap(),
                ..TriangleConvention::default()
            };
            let found = of_convention(&convention, Declarations::default().window_px);
            let causes = found.map(|found| found.causes).unwrap_or_default();
            assert!(causes.is_empty(), "{convention:?}: {causes:?}");
        }
    }
    // In a window of one pixel no convention is certain.
    let strict = TriangleConvention {
        ties: Ties::named("strict").unwrap(),
        ..TriangleConvention::default()
    };
    let found = of_convention(&strict, (1, 1)).unwrap();
    assert!(found.causes.is_empty() && found.to_string().contains("strict rule"), "{found}");
    let strokes = [LineConvention::default(), LineConvention::BEHIND, LineConvention::AHEAD];
    for convention in strokes {
        let stroke = |ends: [[i32; 2]; 2], _: [i32; 2], emit: &mut dyn FnMut(i32, i32)| {
            let window = PixelRect::window(32, 32);
            let pixels = convention.pixels(&LineQuestion { ends, window }).unwrap_or_default();
            pixels.into_iter().for_each(|[x, y]| emit(x, y));
        };
        let causes = of_stroke(stroke).map(|found| found.causes).unwrap_or_default();
        assert!(causes.is_empty(), "{convention:?}: {causes:?}");
    }
}

/// Of 2,000 programs that draw right by a convention none is given a cause. `RASTERPROOF_CONVENTIONS=FROM,TO` names others than
/// the few that are drawn here.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn mistakes_are_not_named_for_thousands_of_conventions() {
    let numbers: Vec<usize> = match std::env::var("RASTERPROOF_CONVENTIONS") {
        Ok(range) => {
            let (from, to) = range.split_once(',').expect("FROM,TO");
            (from.parse().unwrap()..to.parse().unwrap()).collect()
        }
        // The last two were given a cause once.
        Err(_) => (0..12).step_by(every(12)).chain([460, 984]).collect(),
    };
    let rules = ["top-left", "top-right", "bottom-left", "bottom-right", "inclusive", "strict"];
    let roundings = [Rounding::Near, Rounding::HalfEven, Rounding::Down, Rounding::TowardZero];
    let windings = [Windings::Both, Windings::Clockwise, Windings::CounterClockwise];
    for i in numbers {
        // A step that shares no factor with the number of combinations meets each of them once.
        let mut rest = i * 7919;
        let mut one_of = |n: usize| {
            let digit = rest % n;
            rest /= n;
            digit
        };
        let convention = TriangleConvention {
            ties: Ties::named(rules[one_of(6)]).unwrap(),
            quantum: Quantum { step: 1 << one_of(9), rounding: roundings[one_of(4)] },
            shape: Shape::Point { x: 64 * one_of(5) as i32, y: 64 * one_of(5) as i32 },
            draws: windings[one_of(3)],
            ..TriangleConvention::default()
        };
        let found = of_convention(&convention, Declarations::default().window_px);
        let causes = found.map(|found| found.causes).unwrap_or_default();
        assert!(causes.is_empty(), "{i}, {convention:?}: {causes:?}");
    }
}

type Change = dyn Fn(&Question, Answer) -> Answer + Send;

/// A right program but for the answers that `changed` gives.
struct Wrong {
    right: Inside,
    declared: Declared,
    changed: Box<Change>,
}

impl Subject for Wrong {
    fn declared(&self) -> &Declared {
        &self.declared
    }

    fn ask(&mut self, questions: &[Question], most_deaths: u64) -> Vec<Answer> {
        let answers = self.right.ask(questions, most_deaths);
        questions
            .iter()
            .zip(answers)
            .map(|(question, answer)| (self.changed)(question, answer))
            .collect()
    }
}

/// The name and the sentence of the causes that the judge finds, as one text, for a program that says these words of itself.
fn judged(
    words: &str,
    changed: impl Fn(&Question, Answer) -> Answer + Send + 'static,
    families: &[&str],
) -> String {
    let least = Declared { tolerance: everything().tolerance, ..Declared::default() };
    let declared = declared(least, words);
    let verdict = verdict(declared, changed, families, &|_| None);
    let said = verdict.cause.iter().map(|cause| format!("{}: {}", cause.of, cause.why));
    said.collect::<Vec<_>>().join("\n")
}

fn declared(mut declared: Declared, words: &str) -> Declared {
    words.split_whitespace().for_each(|word| declared.hear(word));
    declared
}

/// What an engine of this project says of itself: it answers every question.
fn everything() -> Declared {
    Subject::declared(&Inside::new(engines::find("scanline").unwrap())).clone()
}

/// So many cases of each family, and a minute for a cause.
fn unhurried(cases: u64) -> judge::Options {
    let mut options = judge::Options::default().cases(cases);
    options.terms.patience = std::time::Duration::from_secs(60);
    options
}

fn verdict(
    declared: Declared,
    changed: impl Fn(&Question, Answer) -> Answer + Send + 'static,
    families: &[&str],
    recognise: judge::Recognise<'_>,
) -> judge::verdict::Verdict {
    let right = Inside::new(engines::find("scanline").unwrap());
    let mut options = unhurried(100);
    options.families = families.iter().map(|name| (*name).to_owned()).collect();
    let mut askers =
        [Box::new(Wrong { right, declared, changed: Box::new(changed) }) as Box<dyn Subject>];
    judge::judge(&mut askers, &options, recognise, &|_| ())
}

/// A program that says these words of itself, and changes its answers so, is told this.
fn is_told(
    wanted: &str,
    words: &str,
    families: &[&str],
    changed: impl Fn(&Question, Answer) -> Answer + Send + 'static,
) {
    let said = judged(words, changed, families);
    assert!(said.contains(wanted), "{wanted}: {said}");
}

/// Values that are changed at each pixel of a triangle.
fn values_by(
    change: impl Fn(&Triangle, &mut Fragment<DVec2>) + Send + 'static,
) -> impl Fn(&Question, Answer) -> Answer + Send + 'static {
    move |question, answer| match (&question.of, answer) {
        (Asked::Values(t), Answer::Values(mut fragments)) => {
            fragments.iter_mut().for_each(|f| change(t, f));
            Answer::Values(fragments)
        }
        (_, answer) => answer,
    }
}

/// Polygons that are changed, of the corners that are asked for.
fn polygons_by(
    change: impl Fn([ClipCorner; 3], Vec<ClipCorner>) -> Vec<ClipCorner> + Send + 'static,
) -> impl Fn(&Question, Answer) -> Answer + Send + 'static {
    move |question, answer| match (judge::near_plane::asked(&question.of), answer) {
        (Some(t), Answer::Polygon(left)) => Answer::Polygon(change(clip_corners(&t), left)),
        (_, answer) => answer,
    }
}

/// Mistakes beside coverage are named, too: in values, samples, depths and at the near plane.
#[test]
fn mistakes_of_stages_are_named() {
    programs_of_depth_and_clipping(1);
}

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn more_mistakes_of_depth_and_clipping_are_named() {
    programs_of_depth_and_clipping(usize::MAX);
}

/// Of each table at most so many programs.
fn programs_of_depth_and_clipping(most: usize) {
    // Attributes and depth at the upper left corner of the pixel, where the rest is right.
    is_told(
        "values: It computes right values, at the upper left corner",
        "attributes",
        &["w-100", "uniform"],
        values_by(|t, f| {
            let corners = shifted(t.corners(), 128, 128);
            let [depths, inverses] = [t.vertices.map(|v| v.depth), t.vertices.map(|v| v.inv_w)];
            let values = t.vertices.map(|v| v.varying.to_array());
            if let Some(exact) = ExactTriangle::new(&corners, depths, inverses, values) {
                let (depth, [a, b]) = exact.at(f.x_px, f.y_px);
                f.depth = depth.to_f64();
                f.varying = [a.to_f64(), b.to_f64()].into();
            }
        }),
    );
    // The bits of the samples in the reverse order.
    is_told("samples: It numbers the samples 3, 2, 1, 0", "samples4", &["uniform"], |_, answer| {
        match answer {
            Answer::Samples(runs) => Answer::Samples(
                runs.into_iter().map(|(run, mask)| (run, mask.reverse_bits() >> 4)).collect(),
            ),
            answer => answer,
        }
    });
    // The last triangle that covers a pixel is seen.
    is_told(
        "depths: It shows the triangle that was drawn last",
        "depth",
        &["depth-order"],
        |question, answer| match (&question.of, answer) {
            (Asked::Depth(list), Answer::Seen(_)) => {
                let window = PixelRect::window(question.width, question.height);
                let mut seen = std::collections::BTreeMap::new();
                for (number, t) in (0..).zip(list) {
                    Scanline.cover(t.corners(), window, |s| {
                        for x in s.x0_px..s.x1_px {
                            seen.insert((s.y_px, x), number);
                        }
                    });
                }
                let run =
                    |((y_px, x0_px), number)| (Span { y_px, x0_px, x1_px: x0_px + 1 }, number);
                Answer::Seen(seen.into_iter().map(run).collect())
            }
            (_, answer) => answer,
        },
    );
    // Depths are moved by the order of the triangles.
    let biased = |question: &Question, answer| {
        by_key(question, answer, &|depth, number| depth - 0.002 * number as f64, false)
    };
    is_told("depths: It takes 2e-3 off the depth of a triangle", "depth", &["depth-order"], biased);
    // Depths that wrap around.
    let wrapped = |question: &Question, answer| {
        by_key(question, answer, &|depth, _| (depth * 8.0).fract(), false)
    };
    is_told(
        "depths: It keeps depth in numbers that begin again at 0 after every 1/8",
        "depth",
        &["depth-order"],
        wrapped,
    );
    // No test of depth in every second column.
    is_told(
        "depths: It shows the triangle that was drawn last, without a test of depth where the column is even",
        "depth",
        &["depth-order"],
        |question, answer| {
            seen(question, answer, &|_, f, _| f.depth, &|kept, new, x| {
                if new.0 < kept.0 || x % 2 == 0 {
                    *kept = new;
                }
            })
        },
    );
    // A pixel keeps the depth of its first triangle.
    is_told(
        "depths: It tests depths and does not write them",
        "depth",
        &["depth-order"],
        |question, answer| {
            let depth = |t: &Triangle, f: &Fragment<DVec2>, _| {
                let at = [f.x_px, f.y_px].map(|v| f64::from(v) + 0.5);
                values::sum(values::weights(&t.corners(), at), t.vertices.map(|v| v.depth))
            };
            seen(question, answer, &depth, &|kept, new, _| {
                if new.0 < kept.0 {
                    kept.1 = new.1;
                }
            })
        },
    );
    // A quadrilateral loses its last corner.
    is_told("near plane: It keeps at most three corners", "clip", &["near-plane"], |_, answer| {
        match answer {
            Answer::Polygon(mut corners) => {
                corners.truncate(3);
                Answer::Polygon(corners)
            }
            answer => answer,
        }
    });
    // The bits of a depth buffer are told: planes that are the same in so many bits show what was drawn first or last.
    for (bits, is_last) in [(16, true), (12, false), (20, false)].into_iter().take(most) {
        let said = judged(
            "depth",
            move |question, answer| in_bits(question, answer, bits, is_last),
            &["depth-near-tie"],
        );
        let last = if is_last { ", and of equal depths shows the last drawn" } else { "." };
        let wanted = format!("keeps depth in {bits} bits of fraction, cut down{last}");
        assert!(said.contains(&wanted), "{bits}: {said}");
    }
    // Clippers that are right but for what new corners carry.
    for (attribute, wanted) in [
        (
            (|kept: ClipCorner, _: ClipCorner, _: f64| kept[4])
                as fn(ClipCorner, ClipCorner, f64) -> f64,
            "keeps attributes of the corner that stays",
        ),
        (|_, lost, _| lost[4], "keeps attributes of the corner that is cut off"),
        (
            |kept, lost, t| kept[4] + (lost[4] - kept[4]) * (t * 256.0).floor() / 256.0,
            "divides attributes of an edge by a part that is kept in 8 bits of fraction, cut down",
        ),
        (
            |kept, lost, t| t * kept[4] + (1.0 - t) * lost[4],
            "divides attributes of an edge by a part that is counted from the wrong end",
        ),
    ]
    .into_iter()
    .take(most)
    {
        let said = judged(
            "clip clip-attributes",
            move |question, answer| carrying(question, answer, attribute, false),
            &["near-plane"],
        );
        assert!(said.contains(&format!("attributes of clipped corners: It {wanted}")), "{said}");
        assert!(!said.contains("near plane: "), "verb N is answered rightly: {said}");
        // The same where the near plane is declared to be z = 0.
        let zero = judged(
            "clip clip-attributes near=zero",
            move |question, answer| carrying(question, answer, attribute, true),
            &["near-plane"],
        );
        let cause = |said: &str| said.split(" This explains").next().map(str::to_owned);
        assert_eq!(cause(&zero), cause(&said));
    }
    let linear = |kept: ClipCorner, lost: ClipCorner, t: f64| kept[4] + (lost[4] - kept[4]) * t;
    assert_eq!(
        judged(
            "clip clip-attributes",
            move |question, answer| carrying(question, answer, linear, false),
            &["near-plane"]
        ),
        ""
    );
    // A right program has no cause.
    assert_eq!(
        judged(
            "coverage attributes samples4 depth clip clip-attributes",
            |_, answer| answer,
            &["uniform", "w-100", "depth-order", "depth-near-tie", "near-plane"]
        ),
        ""
    );
}

/// The nearest triangle by depths that are cut down to so many bits.
fn in_bits(question: &Question, answer: Answer, bits: i32, is_last: bool) -> Answer {
    by_key(question, answer, &|depth, _| (depth * f64::from(1 << bits)).floor(), is_last)
}

/// The triangle with the least key, from its depth and its number.
fn by_key(
    question: &Question,
    answer: Answer,
    key: &dyn Fn(f64, u64) -> f64,
    is_last: bool,
) -> Answer {
    seen(question, answer, &|_, f, number| key(f.depth, number.into()), &|kept, new, _| {
        if new.0 < kept.0 || (is_last && new.0 == kept.0) {
            *kept = new;
        }
    })
}

/// A depth and the number of a triangle.
type Held = (f64, u8);

/// What is seen of triangles whose depths are those of `depth`. `keep` says what becomes of the depth and the number that a pixel
/// holds, for each triangle after its first one. It also gets what the new triangle has, and the column.
fn seen(
    question: &Question,
    answer: Answer,
    depth: &dyn Fn(&Triangle, &Fragment<DVec2>, u8) -> f64,
    keep: &dyn Fn(&mut Held, Held, i32),
) -> Answer {
    let (Asked::Depth(list), Answer::Seen(_)) = (&question.of, &answer) else { return answer };
    let window = PixelRect::window(question.width, question.height);
    let mut seen = std::collections::BTreeMap::new();
    for (number, t) in (0..).zip(list) {
        let mut show = |f: Fragment<DVec2>| {
            let new = (depth(t, &f, number), number);
            keep(seen.entry((f.y_px, f.x_px)).or_insert(new), new, f.x_px);
        };
        Scanline.fragments(t, window, &mut show);
    }
    let run = |((y_px, x0_px), (_, number))| (Span { y_px, x0_px, x1_px: x0_px + 1 }, number);
    Answer::Seen(seen.into_iter().map(run).collect())
}

/// A right polygon whose new corners carry what this makes of the corner that stays, the one that goes, and the part of
/// the way.
fn carrying(
    question: &Question,
    answer: Answer,
    attribute: fn(ClipCorner, ClipCorner, f64) -> f64,
    is_zero: bool,
) -> Answer {
    let Some(triangle) = judge::near_plane::asked(&question.of) else { return answer };
    let carries = matches!(question.of, Asked::Carried(_));
    let corners = clip_corners(&triangle);
    let side = |c: &ClipCorner| c[2] + if is_zero { 0.0 } else { c[3] };
    let mut left = Vec::new();
    for i in 0..3 {
        let (from, to) = (corners[i], corners[(i + 1) % 3]);
        if side(&from) >= 0.0 {
            left.push(from);
        }
        if (side(&from) >= 0.0) != (side(&to) >= 0.0) {
            let (kept, lost) = if side(&from) >= 0.0 { (from, to) } else { (to, from) };
            let t = side(&kept) / (side(&kept) - side(&lost));
            let mut new = [0, 1, 2, 3, 4].map(|k| kept[k] + (lost[k] - kept[k]) * t);
            new[4] = if carries { attribute(kept, lost, t) } else { 0.0 };
            left.push(new);
        }
    }
    if carries { Answer::Carried(left) } else { Answer::Polygon(left) }
}

/// Every planted fault of a rasterizer or a line drawer is named: by its own name, by a mistake that predicts the same
/// answers, or as a convention. The others are listed, with why no answer tells them.
#[test]
#[ignore = "takes a minute; .ci/run runs it"]
fn mistakes_that_are_planted_are_named() {
    let planted = TriangleMutant::ALL.map(|mutant| mutant.name());
    let planted_lines = LineMutant::ALL.map(|mutant| mutant.name());
    let mut unnamed = Vec::new();
    let names: Vec<&str> = planted.into_iter().chain(planted_lines).step_by(every(6)).collect();
    for &name in &names {
        let entry = engines::find_planted(name).unwrap();
        let options = unhurried(120);
        let scope = Scope { triangles: true, lines: true, always: false, patience: None };
        let mut askers = [Box::new(Inside::new(&entry)) as Box<dyn Subject>];
        let verdict =
            judge::judge(&mut askers, &options, &|program| recognise(program, scope), &|_| ());
        let is_named = verdict.cause.iter().any(|cause| cause.why.is_known());
        let is_convention = verdict.by_convention().is_some_and(|score| score.wrong == 0);
        if !is_named && !is_convention {
            unnamed.push(name);
        }
    }
    let untold = UNTOLD.iter().map(|(name, _)| *name).filter(|name| names.contains(name));
    let untold: Vec<_> = untold.collect();
    assert_eq!(unnamed, untold);
}

/// Planted faults that no answer of the line protocol tells, and why.
const UNTOLD: [(&str, &str); 6] = [
    ("panics-on-flat-bottom", "the judge stops asking after three panics, and shows their message"),
    ("truncates-towards-zero", "windows begin at the origin, so no column is negative"),
    ("seam-between-tiles", "windows are narrower than two of its tiles"),
    ("naive-barycentric", "its values lie within the tolerance"),
    (
        "line-truncates",
        "lines of more than 65,536 px are left to another rule, which too few answers show",
    ),
    ("line-weights-from-clip", "lines have no values in the protocol"),
];

/// What is named of an answer is named for parameters that no entry has as an example, and for parts of it.
#[test]
fn mistakes_of_values_samples_and_clipping_are_named() {
    programs_of_values_and_samples(1);
}

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn more_mistakes_of_values_and_samples_are_named() {
    programs_of_values_and_samples(usize::MAX);
}

/// Samples that lie in no triangle.
const FAR: [(i32, i32); 4] = [(1_000_000, 1_000_000); 4];

/// Of each table at most so many programs.
fn programs_of_values_and_samples(most: usize) {
    type Change = fn(&Triangle, &mut Fragment<DVec2>);
    let halves: Change = |_, f| {
        // 10 bits after the first one, rounded.
        let half = |v: f64| {
            let bits = (v as f32).to_bits();
            f64::from(f32::from_bits((bits + (1 << 12)) >> 13 << 13))
        };
        f.varying = DVec2::new(half(f.varying.x), half(f.varying.y));
    };
    let flat: Change = |t, f| f.varying = t.vertices[2].varying;
    let six: Change = |_, f| {
        let bits = |v: f64| (v.clamp(0.0, 1.0) * 63.0).round() / 63.0;
        f.varying = DVec2::new(bits(f.varying.x), bits(f.varying.y));
    };
    let inverse: Change = |t, f| {
        let exact =
            ExactTriangle::new(&t.corners(), t.vertices.map(|v| v.inv_w), [1.0; 3], [[0.0; 2]; 3]);
        f.depth = exact.map_or(f.depth, |exact| exact.at(f.x_px, f.y_px).0.to_f64());
    };
    let turned: Change = |_, f| f.varying.x = 1.5 - 2.0 * f.varying.x;
    let coarse: Change = |t, f| {
        let exact =
            ExactTriangle::new(&t.corners(), t.vertices.map(|v| v.inv_w), [1.0; 3], [[0.0; 2]; 3]);
        let inverse = exact.map_or(1.0, |exact| exact.at(f.x_px, f.y_px).0.to_f64());
        f.varying *= inverse / ((inverse * 1024.0).floor() / 1024.0);
    };
    fn weighted(t: &Triangle, at: [f64; 2], weight: impl Fn(usize, f64) -> f64) -> DVec2 {
        let l = values::weights(&t.corners(), at);
        let parts = [0, 1, 2].map(|i| weight(i, l[i]));
        let of = |part: fn(DVec2) -> f64| {
            values::sum(parts, t.vertices.map(|v| part(v.varying))) / parts.iter().sum::<f64>()
        };
        DVec2::new(of(|v| v.x), of(|v| v.y))
    }
    fn at(f: &Fragment<DVec2>) -> [f64; 2] {
        [f.x_px, f.y_px].map(|v| f64::from(v) + 0.5)
    }
    // Attributes are linear where depths in w differ by less than a half.
    let near_affine: Change = |t, f| {
        let w = t.vertices.map(|v| 1.0 / v.inv_w);
        let most = w.into_iter().fold(0.0, f64::max);
        if most < 1.5 * w.into_iter().fold(most, f64::min) {
            f.varying = weighted(t, at(f), |_, l| l);
        }
    };
    let by_depth: Change = |t, f| f.varying = weighted(t, at(f), |i, l| l / t.vertices[i].depth);
    let squared: Change = |t, f| {
        f.varying = weighted(t, at(f), |i, l| l * l * t.vertices[i].inv_w);
        let l = values::weights(&t.corners(), at(f)).map(|l| l * l);
        f.depth = values::sum(l, t.vertices.map(|v| v.depth)) / l.iter().sum::<f64>();
    };
    let roots: Change = |t, f| {
        let mut rooted = *t;
        for v in &mut rooted.vertices {
            v.varying =
                v.varying.signum() * DVec2::new(v.varying.x.abs().sqrt(), v.varying.y.abs().sqrt());
        }
        let roots = weighted(&rooted, at(f), |i, l| l * t.vertices[i].inv_w);
        f.varying = roots * roots.abs();
    };
    let four_bits: Change = |t, f| {
        let mut short = *t;
        for v in &mut short.vertices {
            v.varying = (v.varying * 16.0).floor() / 16.0;
        }
        f.varying = weighted(&short, at(f), |i, l| l * t.vertices[i].inv_w);
    };
    // The first row has the values of the height of the top corner.
    let from_top: Change = |t, f| {
        let top = t.corners().map(|c| f64::from(c.y) / 256.0).into_iter().fold(1e9, f64::min);
        let [x, y] = at(f);
        let y = y - ((top - 0.5).ceil() + 0.5 - top);
        f.varying = weighted(t, [x, y], |i, l| l * t.vertices[i].inv_w);
    };
    // Linear between the perspective values at both ends of a row, which are where the crossings are.
    let between_edges: Change = |t, f| {
        let [x, y] = at(f);
        let mut ends = Vec::new();
        for i in 0..3 {
            let [a, b] = [i, (i + 1) % 3].map(|i| t.vertices[i]);
            let [p, q] = [a, b].map(|v| [v.position.x, v.position.y].map(|v| f64::from(v) / 256.0));
            if (p[1] <= y) != (q[1] <= y) {
                let part = (y - p[1]) / (q[1] - p[1]);
                let [u, v] = [(1.0 - part) * a.inv_w, part * b.inv_w];
                let value = (a.varying * u + b.varying * v) / (u + v);
                ends.push((p[0] + (q[0] - p[0]) * part, value));
            }
        }
        if let [(from, first), (to, last)] = ends[..] {
            f.varying = first + (last - first) * ((x - from) / (to - from));
        }
    };
    for (change, wanted) in [
        (
            near_affine,
            "It interpolates attributes linearly on the screen and ignores w (affine), of triangles whose largest w is at most about 1.",
        ),
        (by_depth, "It weights the corners by 1/z where 1/w is right"),
        (squared, "It squares the weights of the corners"),
        (
            roots,
            "It raises attributes of corners to the power of 1/2, interpolates, and undoes that",
        ),
        (
            four_bits,
            "It keeps the attributes of corners in whole numbers and 4 bits of fraction, cut down",
        ),
        (
            from_top,
            "It gives the first row the values of the top corner's height (attributes alone",
        ),
        (between_edges, "It corrects attributes for perspective along the edges"),
        (turned, "It gives -2 x the first attribute + 1.5"),
        (coarse, "It keeps 1/w at a pixel in whole numbers and 10 bits of fraction, cut down"),
        (halves, "It keeps values in floats with 10 bits after the first one, rounded"),
        (
            flat,
            "It gives every pixel the values of the last corner (attributes alone: depth is right)",
        ),
        (inverse, "It gives 1/w as depth"),
        (six, "It keeps values in 6 bits between 0 and 1, rounded (attributes alone"),
    ]
    .into_iter()
    .take(most)
    {
        let said = judged(
            "attributes tolerance=1e-4",
            values_by(change),
            &["w-100", "uniform"],
        );
        assert!(said.contains(&format!("values: {wanted}")), "{wanted}: {said}");
    }
    // Places of samples that no table has, all four samples of a pixel where any is covered, and samples that are wrong in some pixels
    // alone.
    type Places = fn(Corners, [i32; 2]) -> [(i32, i32); 4];
    type Gate = fn(u8) -> u8;
    let usual: Places = |_, _| SAMPLES;
    let all: Gate = |mask| mask;
    let cases: [(Places, Gate, &str); 7] = [
        (
            usual,
            |mask| if mask == 13 { 15 } else { mask },
            "It draws samples 0 and 1 and 2 and 3 for 0 and 2 and 3, whatever the place",
        ),
        (
            |_, [x, _]| if x % 2 == 1 { SAMPLES.map(|(x, y)| (x, 16 - y)) } else { SAMPLES },
            all,
            "It tests all four samples mirrored upside down where the column is odd",
        ),
        (
            |_, _| [(3, 5), (12, 2), (5, 11), (11, 13)],
            all,
            "It tests samples at (3, 5), (12, 2), (5, 11) and (11, 13) of 1/16 px",
        ),
        (
            usual,
            |mask| if mask == 0 { 0 } else { 15 },
            "It draws all four samples of a pixel where any is covered, and not elsewhere",
        ),
        (usual, |mask| mask & 11, "It never draws the sample with the number 2"),
        (
            |c, _| if area(c) > 0 { [(8, 8); 4] } else { SAMPLES },
            all,
            "It tests all four samples at the centre of clockwise triangles",
        ),
        (
            |_, [x, y]| if (x + y) % 2 == 0 { FAR } else { SAMPLES },
            all,
            "It never draws all four samples where column + row is even",
        ),
    ];
    for (places, gate, wanted) in cases.into_iter().take(most.saturating_mul(2)) {
        let said = judged(
            "samples4",
            move |question, answer| {
                let Asked::Samples(corners) = question.of else { return answer };
                let window = PixelRect::window(question.width, question.height);
                let mut runs = Vec::new();
                for (y, x) in
                    (window.y0..window.y1).flat_map(|y| (0..window.x1).map(move |x| (y, x)))
                {
                    let at = places(corners, [x, y]);
                    let pixel = PixelRect { x0: x, y0: y, x1: x + 1, y1: y + 1 };
                    let mask = masks_at(&Scanline, corners, pixel, &at).unwrap().get(x, y);
                    let mask = if at == FAR { 0 } else { gate(mask.unwrap_or(0) & 15) };
                    if mask > 0 {
                        runs.push((Span { y_px: y, x0_px: x, x1_px: x + 1 }, mask));
                    }
                }
                Answer::Samples(runs)
            },
            &["uniform", "half-integer"],
        );
        assert!(said.contains(&format!("samples: {wanted}")), "{wanted}: {said}");
    }
    // A planted fault that draws nothing of these triangles does not explain their values.
    let said = judged(
        "attributes",
        values_by(|t, f| {
            if area(t.corners()) < 0 {
                f.varying = -f.varying;
            }
        }),
        &["w-100", "uniform"],
    );
    let wanted = "It gives minus the right value where the value is not depth, and its winding: anticlockwise.";
    assert!(said.contains(wanted), "{said}");
    // Values of which no mistake is known: what all wrong pixels have in common is said.
    let said = judged(
        "attributes tolerance=1e-4",
        values_by(|t, f| {
            if f.y_px % 2 == 1 && area(t.corners()) > 0 {
                f.varying.y += 0.1 + f64::from(f.x_px % 7 * (f.x_px % 5)) / 10.0;
            }
        }),
        &["w-100", "uniform"],
    );
    for wanted in [
        "All wrong pixels are of clockwise triangles.",
        "All wrong pixels are where the row is odd.",
        "All wrong pixels are of right depth.",
        "All wrong pixels are of a right first attribute.",
    ] {
        assert!(said.contains(wanted), "{wanted}: {said}");
    }
    assert!(!said.contains("even") && !said.contains("right second attribute"), "{said}");
    // A plane that is in no table is read off the new corners.
    is_told(
        "near plane: It clips to w >= 0.3.",
        "clip",
        &["near-plane"],
        polygons_by(|corners, _| {
            let mut left = Vec::new();
            for (i, from) in corners.iter().enumerate() {
                let to = corners[(i + 1) % 3];
                let [a, b] = [from[3] - 0.3, to[3] - 0.3];
                if a >= 0.0 {
                    left.push(*from);
                }
                if (a < 0.0) != (b < 0.0) {
                    left.push([0, 1, 2, 3, 4].map(|k| from[k] + (to[k] - from[k]) * (a / (a - b))));
                }
            }
            left
        }),
    );
    // New corners with w = 1, and triangles of which two corners lie behind.
    is_told(
        "near plane: It gives a new corner 1 for w",
        "clip",
        &["near-plane"],
        polygons_by(|asked, mut left| {
            let is_new = |c: &ClipCorner| asked.iter().all(|a| a[..4] != c[..4]);
            left.iter_mut().filter(|c| is_new(c)).for_each(|c| c[3] = 1.0);
            left
        }),
    );
    is_told(
        "near plane: It drops the triangle where the number of corners behind the near plane is 2",
        "clip",
        &["near-plane"],
        polygons_by(|asked, left| {
            let behind = asked.iter().filter(|c| c[2] + c[3] < 0.0).count();
            if behind == 2 { Vec::new() } else { left }
        }),
    );
}

/// The answer of a part of this project, with a planted fault, where the protocol has a question for it.
fn planted_answer(mutant: Mutant, question: &Question, answer: Answer) -> Answer {
    let subject = Implementations::with(mutant);
    let window = PixelRect::window(question.width, question.height);
    let spans = |picture: &Coverage| {
        Answer::Coverage(
            picture.runs().map(|(y_px, x0_px, x1_px)| Span { y_px, x0_px, x1_px }).collect(),
        )
    };
    match (component_of(&mutant), &question.of) {
        (Component::Oracle, Asked::Coverage(corners)) => {
            spans(&hits(&*subject.oracle, [*corners], window))
        }
        (Component::Oracle, Asked::Values(triangle)) => {
            let mut fragments = Vec::new();
            subject.oracle.values(triangle, window, &mut |f| fragments.push(f));
            Answer::Values(fragments)
        }
        (Component::Lists, Asked::Coverage(corners)) => {
            let mut picture = Coverage::new(window, 0);
            subject.lists[0].1.cover_list(&[*corners], window, &mut |pieces| {
                for piece in pieces {
                    piece.spans(&mut |s| picture.hit(s.y_px, s.x0_px, s.x1_px));
                }
            });
            spans(&picture)
        }
        (Component::Cull, Asked::Coverage(corners)) => {
            // The program declares one winding.
            match (subject.culls)(Cull::CounterClockwise, *corners) {
                true => Answer::Coverage(Vec::new()),
                false => answer,
            }
        }
        (Component::Clip, Asked::Near(_) | Asked::Carried(_)) => {
            let triangle = judge::near_plane::asked(&question.of).unwrap();
            let corners = clip_corners(&triangle).map(|[x, y, z, w, a]| ClipVertex {
                position: [x, y, z, w].into(),
                varying: DVec2::new(a, 0.0),
            });
            let left = (subject.clip)(&corners, ClipPlane::Near.bit());
            let left = left.iter().map(|v| {
                let [x, y, z, w] = v.position.to_array();
                [x, y, z, w, v.varying.x]
            });
            match question.of {
                Asked::Near(_) => {
                    Answer::Polygon(left.map(|[x, y, z, w, _]| [x, y, z, w, 0.0]).collect())
                }
                _ => Answer::Carried(left.collect()),
            }
        }
        _ => answer,
    }
}

/// The planted faults of all other parts: named, a convention, or one that no answer tells, and why.
#[test]
#[ignore = "takes a minute; .ci/run runs it"]
fn mistakes_planted_elsewhere_are_named() {
    let mut table = String::new();
    for mutant in Mutant::all() {
        let (families, words): (&[&str], _) = match component_of(&mutant) {
            Component::Engine | Component::Drawer => continue,
            Component::Oracle => (&["uniform", "half-integer", "near-tie", "huge", "w-100"], ""),
            Component::Lists => (&["uniform", "near-tie", "huge", "sliver"], ""),
            Component::Cull => (&["uniform", "tiny", "sliver", "half-integer"], "winding=cw"),
            Component::Clip => (&["near-plane"], ""),
            other => {
                table += &format!("{}: no question is about {other:?}\n", mutant.name());
                continue;
            }
        };
        let scope = Scope { triangles: true, lines: false, always: false, patience: None };
        let change = move |question: &Question, answer| planted_answer(mutant, question, answer);
        let verdict = verdict(declared(everything(), words), change, families, &|program| {
            recognise(program, scope)
        });
        table += &format!("{}: {}\n", mutant.name(), told(&verdict));
    }
    for name in ExactMutant::ALL.map(ExactMutant::name) {
        let entry = engines::find_planted(name).unwrap();
        let mut askers = [Box::new(Inside::new(&entry)) as Box<dyn Subject>];
        let options = unhurried(100);
        let scope = Scope { triangles: true, lines: false, always: false, patience: None };
        let verdict =
            judge::judge(&mut askers, &options, &|program| recognise(program, scope), &|_| ());
        table += &format!("{name}: {}\n", told(&verdict));
    }
    check_words("mistakes-planted-elsewhere", &table);
}

/// The name of the causes, the convention, or that all answers are right.
fn told(verdict: &judge::verdict::Verdict) -> String {
    let named: Vec<_> = verdict
        .cause
        .iter()
        .flat_map(|why| why.why.causes.iter().map(|cause| format!("{}, {}", why.of, cause.name)))
        .collect();
    if !named.is_empty() {
        return named.join("; ");
    }
    match &verdict.more.recognised {
        Some(said) if verdict.cause.is_empty() => said.sentences.join(" "),
        _ if verdict.agrees() => "all answers are right".to_owned(),
        _ if verdict.cause.is_empty() => "another winding than declared".to_owned(),
        _ => "wrong, and no cause is named".to_owned(),
    }
}

/// Columns or rows that are kept in 8 bits are only seen in a window of more than 256 pixels.
#[test]
fn mistakes_beyond_small_windows_are_found() {
    let verdict = verdict(
        everything(),
        |_, answer| match answer {
            Answer::Coverage(spans) => {
                let wrapped = spans.into_iter().flat_map(|s| {
                    (s.x0_px..s.x1_px).map(move |x| {
                        let x = i32::from(x as u8);
                        Span { y_px: s.y_px, x0_px: x, x1_px: x + 1 }
                    })
                });
                Answer::Coverage(wrapped.collect())
            }
            answer => answer,
        },
        &[],
        &|_| None,
    );
    let wrong: Vec<_> =
        verdict.families.iter().filter(|row| row.wrong_cases > 0).map(|row| row.name).collect();
    // The design has such windows, too.
    assert!(wrong.contains(&"wide-window"), "{wrong:?}");
    assert!(wrong.iter().all(|name| ["design", "wide-window"].contains(name)), "{wrong:?}");
    let said: Vec<_> = verdict.cause.iter().flat_map(|cause| cause.why.sentences()).collect();
    let said = said.join(" ");
    assert!(said.contains("triangles are wrong from column 256 on"), "{said}");
}
