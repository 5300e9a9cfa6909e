//! Exact line pixels by membership: each pixel of the window is asked whether it belongs.
//!
//! With u along the major axis and v along the minor one, measured from the end with the smaller u,
//! the ideal line is v = u dv/du. Pixel (u, v) belongs iff 0 <= u <= du and v is the nearest whole
//! number: -du < 2 (du v - dv u) sign(dv) <= du. The two sides differ since a line that passes
//! halfway lights the pixel farther along; with dv = 0 nothing is halfway.

use super::Oracle;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::{PixelPoint, ScreenLine};

impl Oracle {
    /// Emits the pixels of the line in the window with the number of the step they belong to,
    /// counted from the first end, in that order.
    pub fn line_pixels<V: Copy>(
        &self,
        line: &ScreenLine<V>,
        bounds: PixelRect,
        mut emit: impl FnMut(PixelPoint, u64),
    ) {
        let [a, b] = line.ends.map(|end| [i64::from(end.pixel.x), i64::from(end.pixel.y)]);
        let major = usize::from((b[1] - a[1]).abs() > (b[0] - a[0]).abs());
        let minor = 1 - major;
        let reversed = b[major] < a[major];
        let (start, end) = if reversed { (b, a) } else { (a, b) };
        let (du, dv) = (end[major] - start[major], end[minor] - start[minor]);
        let low = [bounds.x0, bounds.y0].map(i64::from);
        let high = [bounds.x1, bounds.y1].map(i64::from);
        let columns = low[major].max(start[major])..high[major].min(end[major] + 1);
        let (v_low, v_high) = (start[minor].min(end[minor]), start[minor].max(end[minor]));
        let rows = low[minor].max(v_low)..high[minor].min(v_high + 1);
        // Both products stay below 2^61 where lengths do not exceed 2^30.
        let small = du < 1 << 30;
        let belongs = |u: i64, v: i64| {
            if small {
                let twice = 2 * (du * v - dv * u) * dv.signum();
                -du < twice && twice <= du && (dv != 0 || v == 0)
            } else {
                let [du, dv, u, v] = [du, dv, u, v].map(i128::from);
                let twice = 2 * (du * v - dv * u) * dv.signum();
                -du < twice && twice <= du && (dv != 0 || v == 0)
            }
        };
        let mut visit = |major_px: i64| {
            for minor_px in rows.clone() {
                let (u, v) = (major_px - start[major], minor_px - start[minor]);
                // A single point: no direction, and it belongs.
                if du == 0 || belongs(u, v) {
                    let step = if reversed { du - u } else { u };
                    // Inside the window, so both fit i32.
                    let (x, y) =
                        if major == 0 { (major_px, minor_px) } else { (minor_px, major_px) };
                    emit(PixelPoint::new(x as i32, y as i32), step as u64);
                }
            }
        };
        if reversed {
            columns.rev().for_each(&mut visit);
        } else {
            columns.for_each(&mut visit);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasterproof_core::triangle::LineEnd;

    /// (0,0) to (8,3) on paper: heights 0, 3/8, 6/8, 9/8, 12/8 (the tie, goes on), 15/8, ...
    #[test]
    fn a_line_by_hand() {
        let end = |x, y| LineEnd { pixel: PixelPoint::new(x, y), depth: 0.0, varying: 0.0 };
        let there = ScreenLine { ends: [end(0, 0), end(8, 3)] };
        let back = ScreenLine { ends: [end(8, 3), end(0, 0)] };
        let pixels = |line: &ScreenLine<f64>| {
            let mut pixels = Vec::new();
            Oracle.line_pixels(line, PixelRect::window(16, 16), |pixel, step| {
                pixels.push((pixel.x, pixel.y, step))
            });
            pixels
        };
        let rows = [0, 0, 1, 1, 2, 2, 2, 3, 3];
        let expected: Vec<_> = (0..9).map(|i| (i, rows[i as usize], i as u64)).collect();
        assert_eq!(pixels(&there), expected);
        let reversed: Vec<_> = (0..9).map(|i| (8 - i, rows[8 - i as usize], i as u64)).collect();
        assert_eq!(pixels(&back), reversed);
    }
}
