//! Invariants 36 to 41: the pixels of lines, against whole-number arithmetic only.

use glam::DVec2;

use super::Outcome;
use super::implementations::{Drawer, Implementations};
use super::source::LineInput;
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::geometry::greatest_divisor;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::{Fragment, PixelPoint};
use rasterproof_verify::cases::Line;
use rasterproof_verify::cases::named::plain_line;

/// The same line at most 300 pixels long and near the origin, for checks that look at every pixel
/// of it.
fn near(line: &Line) -> Line {
    let [a, b] = line.ends.map_array(|end| end.pixel);
    let start = PixelPoint::new(a.x % 64, a.y % 64);
    // In 64 bits, since both may lie at opposite ends of the domain.
    let dx = (i64::from(b.x) - i64::from(a.x)) % 301;
    let dy = (i64::from(b.y) - i64::from(a.y)) % 301;
    let mut line = *line;
    line.ends[0].pixel = start;
    line.ends[1].pixel = PixelPoint::new(start.x + dx as i32, start.y + dy as i32);
    line
}

/// A window that holds the whole line, with pixels to spare for a drawer that errs.
fn around(line: &Line) -> PixelRect {
    let [a, b] = line.ends.map_array(|end| end.pixel);
    PixelRect {
        x0: a.x.min(b.x) - 2,
        y0: a.y.min(b.y) - 2,
        x1: a.x.max(b.x) + 3,
        y1: a.y.max(b.y) + 3,
    }
}

/// Where fragments are, in the order in which they are drawn.
fn pixels(fragments: &[Fragment<DVec2>]) -> Vec<[i64; 2]> {
    fragments.iter().map(|f| [f.x_px.into(), f.y_px.into()]).collect()
}

/// The pixels that a drawer lights of the whole line, in its order.
fn all_pixels(drawer: &Drawer, line: &Line) -> Vec<[i64; 2]> {
    pixels(&drawer.fragments(line, around(line)))
}

/// The pixels of both ends, in numbers whose products do not overflow.
fn ends(line: &Line) -> [[i64; 2]; 2] {
    line.ends.map_array(|end| [end.pixel.x.into(), end.pixel.y.into()])
}

/// Index of the longer axis; x where they are equal.
fn major_of([a, b]: &[[i64; 2]; 2]) -> usize {
    usize::from((b[1] - a[1]).abs() > (b[0] - a[0]).abs())
}

/// Twice the distance along the minor axis from a pixel to the ideal line, times the length:
/// 2 (du v - dv u), positive where the pixel lies farther along than the line; with the length.
fn deviation(line: &[[i64; 2]; 2], pixel: [i64; 2]) -> (i128, i128) {
    let major = major_of(line);
    // From the end with the smaller major coordinate.
    let [a, b] = if line[1][major] < line[0][major] { [line[1], line[0]] } else { *line };
    let (du, dv) = (b[major] - a[major], b[1 - major] - a[1 - major]);
    let (u, v) = (pixel[major] - a[major], pixel[1 - major] - a[1 - major]);
    let [du, dv, u, v] = [du, dv, u, v].map(i128::from);
    (2 * (du * v - dv * u) * if dv < 0 { -1 } else { 1 }, du)
}

/// Whether a pixel is the one of its step that is nearest to the ideal line, a tie being decided for the one farther along.
fn is_nearest(line: &[[i64; 2]; 2], pixel: [i64; 2]) -> bool {
    let (twice, du) = deviation(line, pixel);
    if du == 0 { pixel == line[0] } else { -du < twice && twice <= du }
}

/// 36: |2 (dx y - x dy)| <= dx, and at equality the pixel farther along.
pub(super) fn nearest_pixel(subject: &Implementations, input: &LineInput) -> Outcome {
    let line = near(&input.line);
    let whole = ends(&line);
    subject.each_drawer(|drawer| {
        let drawn = all_pixels(drawer, &line);
        match drawn.iter().find(|&&pixel| !is_nearest(&whole, pixel)) {
            None => Ok(drawn.len() as u64),
            Some(pixel) => {
                let (twice, du) = deviation(&whole, *pixel);
                Err(format!("lights {pixel:?}, {twice}/{du} half pixels off"))
            }
        }
    })
}

/// 37: one pixel for each step, neighbours touch, and both ends are the ends.
pub(super) fn one_per_step(subject: &Implementations, input: &LineInput) -> Outcome {
    let line = near(&input.line);
    let whole = ends(&line);
    let [a, b] = whole;
    let major = major_of(&whole);
    let length = (b[major] - a[major]).abs();
    subject.each_drawer(|drawer| {
        // As many pixels as steps and one more, from one end to the other.
        let drawn = all_pixels(drawer, &line);
        if drawn.len() as i64 != length + 1 {
            return Err(format!("lights {} pixels on {length} steps", drawn.len()));
        }
        if drawn.first() != Some(&a) || drawn.last() != Some(&b) {
            return Err(format!("runs from {:?} to {:?}", drawn.first(), drawn.last()));
        }
        for two in drawn.windows(2) {
            let step = [(two[1][0] - two[0][0]).abs(), (two[1][1] - two[0][1]).abs()];
            if step[major] != 1 || step[1 - major] > 1 {
                return Err(format!("steps from {:?} to {:?}", two[0], two[1]));
            }
        }
        Ok(drawn.len() as u64)
    })
}

/// The height of a line at a step, rounded half away from the end that it is counted from.
fn directed(step: i64, du: i64, dv: i64) -> i64 {
    (2 * dv * step + du) / (2 * du.max(1))
}

/// 38: backwards, the same pixels. The control: rounding half away from the first end, whichever
/// that is, gives another set exactly where the length over the common divisor is even.
pub(super) fn reversal(subject: &Implementations, input: &LineInput) -> Outcome {
    let line = near(&input.line);
    let mut back = line;
    back.ends.reverse();
    let [a, b] = ends(&line);
    let (dx, dy) = ((b[0] - a[0]).abs(), (b[1] - a[1]).abs());
    let (du, dv) = (dx.max(dy), dx.min(dy));
    // du steps along the longer axis and dv along the shorter one. Height at step i from either end; the two differ in their
    // ties only.
    let mut differs = false;
    for i in 0..=du {
        differs |= directed(i, du, dv) != dv - directed(du - i, du, dv);
    }
    let even = dv > 0 && (du / greatest_divisor(du, dv)) % 2 == 0;
    if differs != even {
        return Err(format!("the control on {du}, {dv}: differs {differs}, even {even}"));
    }
    subject.each_drawer(|drawer| {
        // The order in which they are drawn is the other one, so sets are compared.
        let mut there = all_pixels(drawer, &line);
        let mut back = all_pixels(drawer, &back);
        there.sort_unstable();
        back.sort_unstable();
        match there.iter().zip(&back).find(|(a, b)| a != b) {
            None if there.len() == back.len() => Ok(there.len() as u64),
            None => Err(format!("lights {} and {} pixels", there.len(), back.len())),
            Some((a, b)) => Err(format!("lights {a:?} on the way, {b:?} back")),
        }
    })
}

/// An octant around a pixel: whether y is its longer axis, and the signs of the steps along the longer and the shorter one.
#[derive(Clone, Copy)]
struct Octant {
    origin: [i64; 2],
    is_steep: bool,
    signs: [i64; 2],
}

impl Octant {
    /// Where it has the point that is u steps along the longer axis and v along the shorter one.
    fn image(&self, [u, v]: [i64; 2]) -> [i64; 2] {
        let ([x, y], [u, v]) = (self.origin, [self.signs[0] * u, self.signs[1] * v]);
        if self.is_steep { [x + v, y + u] } else { [x + u, y + v] }
    }

    /// The line from its origin to that point.
    fn line_to(&self, point: [i64; 2]) -> Line {
        let ([x0, y0], [x1, y1]) = (self.origin, self.image(point));
        plain_line(PixelPoint::new(x0 as i32, y0 as i32), PixelPoint::new(x1 as i32, y1 as i32))
    }
}

/// 39: the other seven octants are images of the first; where the major axis is mirrored the end
/// that decides a tie is the other one, so a tie goes the other way.
pub(super) fn octants(subject: &Implementations, input: &LineInput) -> Outcome {
    let [a, b] = ends(&near(&input.line));
    let (dx, dy) = ((b[0] - a[0]).abs(), (b[1] - a[1]).abs());
    let (du, dv) = (dx.max(dy), dx.min(dy));
    let origin = Octant { origin: a, is_steep: false, signs: [1, 1] };
    subject.each_drawer(|drawer| {
        let first = all_pixels(drawer, &origin.line_to([du, dv]));
        let mut compared = 0;
        for is_steep in [false, true] {
            // With equal axes the major one is x, so there is no steep octant.
            if is_steep && du == dv {
                continue;
            }
            for signs in [[1, 1], [-1, 1], [1, -1], [-1, -1]] {
                let octant = Octant { is_steep, signs, ..origin };
                let other = all_pixels(drawer, &octant.line_to([du, dv]));
                let mut target = Vec::new();
                for [x, y] in &first {
                    let (u, v) = (x - a[0], y - a[1]);
                    let is_tie = du > 0 && (2 * (du * v - dv * u)).abs() == du;
                    target.push(octant.image([u, v - i64::from(is_tie && signs[0] < 0)]));
                }
                if other != target {
                    let to = octant.image([du, dv]);
                    return Err(format!("on {a:?} to {to:?} is no image of the first octant"));
                }
                compared += other.len() as u64;
            }
        }
        Ok(compared)
    })
}

/// 40: pixels and values of a window are those of the whole line there; of a line of any length no
/// more pixels come out than the window is long, all of them nearest.
pub(super) fn clipped_line(subject: &Implementations, input: &LineInput) -> Outcome {
    let line = near(&input.line);
    let window = PixelRect { x0: 5, y0: -7, x1: 33, y1: 21 };
    subject.each_drawer(|drawer| {
        // Where it is drawn as a whole, the fragments in the window are known.
        let whole = drawer.fragments(&line, around(&line));
        let target = whole.into_iter().filter(|f| window.contains(f.x_px, f.y_px));
        let inside = drawer.fragments(&line, window);
        if !inside.iter().copied().eq(target) {
            return Err("draws another line in the window than the window of the line".to_owned());
        }
        // The line as it was given may be as long as the domain; only a window of it is looked at.
        let far = drawer.fragments(&input.line, input.window);
        let most = input.window.width().max(input.window.height()) as usize;
        if far.len() > most {
            return Err(format!("emits {} pixels in {most} steps", far.len()));
        }
        let whole = ends(&input.line);
        if let Some(pixel) = pixels(&far).into_iter().find(|&pixel| !is_nearest(&whole, pixel)) {
            return Err(format!("lights {pixel:?}, not nearest to the unclipped line"));
        }
        Ok(1 + (inside.len() + far.len()) as u64)
    })
}

/// Lines on which published drawers are known to err, from (0,0): f32 heights at x = 9, f64 heights
/// at x = 9, 16.16 heights at x = 3, f32 heights at x = 342.
const KNOWN: [[i32; 2]; 4] = [[12, 2], [12, 10], [6, 1], [353, 337]];

/// 41: the pixels that differ from exact rounding, as a complete list. For the drawers here it is
/// empty; a drawer that steps in floats shows its list in the message.
pub(super) fn listed_differences(subject: &Implementations, input: &LineInput) -> Outcome {
    let origin = PixelPoint::new(0, 0);
    // Those on which others err, and the one of this case.
    let known = KNOWN.map(|[x, y]| plain_line(origin, PixelPoint::new(x, y)));
    let mut lines = Vec::from(known);
    lines.push(near(&input.line));
    subject.each_drawer(|drawer| {
        let mut compared = 0;
        for line in &lines {
            let whole = ends(line);
            let drawn = all_pixels(drawer, line);
            let wrong: Vec<_> = drawn.iter().filter(|&&pixel| !is_nearest(&whole, pixel)).collect();
            if !wrong.is_empty() {
                let shown = &wrong[..wrong.len().min(5)];
                return Err(format!(
                    "on {:?} to {:?}: {} of {} pixels differ, first {shown:?}",
                    whole[0],
                    whole[1],
                    wrong.len(),
                    drawn.len()
                ));
            }
            compared += drawn.len() as u64;
        }
        Ok(compared)
    })
}
