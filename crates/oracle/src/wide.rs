//! Whether a line with a width covers a point, exactly, without the corners of its shape, which are irrational.
//!
//! Let d be the vector from the first end a to the second, and s that from a to the point. The point lies |d x s| / |d| beside the
//! segment, which is at most half the width w if 4 (d x s)^2 <= w^2 |d|^2. A parallelogram is as wide along the shorter axis: there
//! |d| is replaced by the longer side of the segment. A rectangle is cut off where d . s is 0 or |d|^2; a parallelogram where the
//! same holds of the part of d and of s along the longer axis.

use rasterproof_core::triangle::{WideForm, WideLine};

/// Whether it covers a point, in subpixels. Where the point lies on the border, `owns` decides by the direction in which the shape
/// ends there, for each edge that the point lies on. A segment of length 0 covers nothing.
#[must_use]
pub fn covers(
    line: &WideLine,
    form: WideForm,
    [x, y]: [i64; 2],
    owns: &dyn Fn([i64; 2]) -> bool,
) -> bool {
    let [a, b] = line.ends.map(|p| [i64::from(p.x), i64::from(p.y)]);
    let d = [b[0] - a[0], b[1] - a[1]];
    let s = [x - a[0], y - a[1]];
    let along = match form {
        WideForm::Rectangle => d,
        WideForm::Parallelogram if d[0].abs() >= d[1].abs() => [d[0], 0],
        WideForm::Parallelogram => [0, d[1]],
    };
    let (at, end) = (product(along, s), product(along, along));
    if d == [0, 0] || at < 0 || at > end {
        return false;
    }
    // Twice what the point lies beside the segment, times the length: more than 2^62 is beyond any width.
    let beside = 2 * product([-d[1], d[0]], s);
    let reach = i128::from(line.width).pow(2) * end;
    if beside.unsigned_abs() >= 1 << 62 || beside * beside > reach {
        return false;
    }
    let turn = if beside < 0 { -1 } else { 1 };
    (beside * beside < reach || owns([-d[1] * turn, d[0] * turn]))
        && (at > 0 || owns(along.map(|v| -v)))
        && (at < end || owns(along))
}

fn product(p: [i64; 2], q: [i64; 2]) -> i128 {
    i128::from(p[0]) * i128::from(q[0]) + i128::from(p[1]) * i128::from(q[1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasterproof_core::grid::SubpixelPoint;

    fn line(ends: [[i32; 2]; 2], width: i32) -> WideLine {
        WideLine { ends: ends.map(|[x, y]| SubpixelPoint::new(x, y)), width }
    }

    /// From (0, 0) to (8, 6) the length is 10. Half the width of 10 beside the middle (4, 3) lie (1, 7) and (7, -1).
    #[test]
    fn a_border_is_met_exactly() {
        let wide = line([[0, 0], [8, 6]], 10);
        let place = |at, form| {
            let [closed, open] = [true, false].map(|owned| covers(&wide, form, at, &|_| owned));
            (closed, open)
        };
        let rectangle = WideForm::Rectangle;
        assert_eq!(place([1, 7], rectangle), (true, false));
        assert_eq!(place([7, -1], rectangle), (true, false));
        assert_eq!(place([1, 8], rectangle), (false, false));
        assert_eq!(place([4, 3], rectangle), (true, true));
        // Both ends, and beyond them.
        assert_eq!([[0, 0], [8, 6]].map(|at| place(at, rectangle)), [(true, false); 2]);
        assert_eq!([[-1, 0], [8, 7]].map(|at| place(at, rectangle)), [(false, false); 2]);
        // The parallelogram is as wide along y: at x = 4 from -2 to 8, and its ends are upright.
        let other = WideForm::Parallelogram;
        assert_eq!([[4, -2], [4, 8]].map(|at| place(at, other)), [(true, false); 2]);
        assert_eq!([[4, -1], [4, 7]].map(|at| place(at, other)), [(true, true); 2]);
        assert_eq!([[0, 4], [8, 4]].map(|at| place(at, other)), [(true, false); 2]);
        assert_eq!([[-1, 0], [9, 6]].map(|at| place(at, other)), [(false, false); 2]);
        assert!(!covers(&line([[3, 3], [3, 3]], 10), rectangle, [3, 3], &|_| true));
    }

    /// The direction that is asked for points out of the shape.
    #[test]
    fn the_owner_is_asked_by_direction() {
        let wide = line([[0, 0], [8, 0]], 4);
        let asked = |at| {
            let out = std::cell::RefCell::new(Vec::new());
            let covered = covers(&wide, WideForm::Rectangle, at, &|facing| {
                out.borrow_mut().push(facing.map(i64::signum));
                true
            });
            assert!(covered);
            out.into_inner()
        };
        assert_eq!(asked([4, -2]), [[0, -1]]);
        assert_eq!(asked([4, 2]), [[0, 1]]);
        assert_eq!(asked([0, 1]), [[-1, 0]]);
        assert_eq!(asked([8, -2]), [[0, -1], [1, 0]]);
    }
}
