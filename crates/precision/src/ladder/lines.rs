//! Choices of line drawing: the slope added once for each pixel, in 16.16 fixed point and in floats.
//!
//! All three start from the end with the smaller major coordinate and round to the nearest pixel,
//! half up, which is the promise of [`DrawLine`]; both ends are drawn.
//! What is left of the faults of published line drawers is the drift of the sum. They do not clip.

use std::marker::PhantomData;

use super::Real;
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::DrawLine;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::{LineEnd, PixelPoint, ScreenLine};

pub trait Draw {
    /// Whether the choice may be given this line; otherwise why not.
    fn accepts(&self, _ends: [PixelPoint; 2]) -> Result<(), String> {
        Ok(())
    }

    /// Emits one pixel for each step along the longer axis, in any direction. The window holds the
    /// line, so nothing is clipped.
    fn draw(&self, ends: [PixelPoint; 2], window: PixelRect, emit: impl FnMut(PixelPoint));
}

/// A slope of 16.16 bits, the classic of machines without floats. Absolute coordinates below 2^15.
#[derive(Clone, Copy, Debug, Default)]
pub struct FixedPoint;

/// y += dy / dx in floats.
#[derive(Clone, Copy, Debug, Default)]
pub struct Drifting<T>(PhantomData<T>);

#[derive(Clone, Copy, Debug, Default)]
pub struct Contracted<D>(pub D);

/// A line along its major axis: from the smaller major coordinate, with the minor one beside it.
struct Along {
    steep: bool,
    major: [i32; 2],
    minor: [i32; 2],
}

impl Along {
    #[inline]
    fn new([a, b]: [PixelPoint; 2]) -> Self {
        let steep = b.y.abs_diff(a.y) > b.x.abs_diff(a.x);
        let (mut major, mut minor) =
            if steep { ([a.y, b.y], [a.x, b.x]) } else { ([a.x, b.x], [a.y, b.y]) };
        if major[1] < major[0] {
            major.swap(0, 1);
            minor.swap(0, 1);
        }
        Self { steep, major, minor }
    }

    #[inline]
    fn pixel(&self, major: i32, minor: i32) -> PixelPoint {
        if self.steep { PixelPoint::new(minor, major) } else { PixelPoint::new(major, minor) }
    }

    /// Walks the major axis; `minor` gives the height in pixels at each step.
    #[inline]
    fn walk(&self, mut minor: impl FnMut() -> i32, mut emit: impl FnMut(PixelPoint)) {
        for major in self.major[0]..=self.major[1] {
            emit(self.pixel(major, minor()));
        }
    }

    /// Halfway rounds up where the line rises; where it falls, "farther along" is down, so heights
    /// are counted downwards.
    #[inline]
    fn rise(&self) -> (i32, i32) {
        let rise = self.minor[1] - self.minor[0];
        (rise.abs(), rise.signum())
    }
}

impl Draw for FixedPoint {
    fn accepts(&self, ends: [PixelPoint; 2]) -> Result<(), String> {
        let fits = |v: i32| v.unsigned_abs() < 1 << 15;
        if ends.iter().all(|p| fits(p.x) && fits(p.y)) {
            return Ok(());
        }
        Err("a coordinate does not fit 16.16".to_owned())
    }

    #[inline]
    fn draw(&self, ends: [PixelPoint; 2], _window: PixelRect, emit: impl FnMut(PixelPoint)) {
        let along = Along::new(ends);
        let (rise, sign) = along.rise();
        let length = i64::from(along.major[1] - along.major[0]).max(1);
        // Rounded to the nearest 2^-16.
        let slope = ((i64::from(rise) << 17) + length) / (2 * length);
        // The sum may exceed 15 bits by the last rounding, so it is kept in 64.
        let mut height = 1 << 15;
        let next = || {
            let minor = along.minor[0] + sign * (height >> 16) as i32;
            height += slope;
            minor
        };
        along.walk(next, emit);
    }
}

impl<T: Real> Draw for Drifting<T> {
    #[inline]
    fn draw(&self, ends: [PixelPoint; 2], _window: PixelRect, emit: impl FnMut(PixelPoint)) {
        let along = Along::new(ends);
        let (rise, sign) = along.rise();
        let length = (along.major[1] - along.major[0]).max(1);
        let slope = T::of(f64::from(rise)) / T::of(f64::from(length));
        let mut height = T::zero();
        let next = || {
            // Heights are not negative, so the conversion, which truncates, is a floor.
            let risen: i32 = (height + T::HALF).as_();
            height = height + slope;
            along.minor[0] + sign * risen
        };
        along.walk(next, emit);
    }
}

impl<D: DrawLine> Draw for Contracted<D> {
    #[inline]
    fn draw(&self, ends: [PixelPoint; 2], window: PixelRect, mut emit: impl FnMut(PixelPoint)) {
        let ends = ends.map_array(|pixel| LineEnd { pixel, depth: 0.0, varying: 0.0 });
        self.0.draw(&ScreenLine { ends }, window, |f| emit(PixelPoint::new(f.x_px, f.y_px)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    type Pixel = (i32, i32);

    fn pixels(choice: &impl Draw, a: Pixel, b: Pixel) -> Vec<Pixel> {
        let mut pixels = Vec::new();
        let ends = [PixelPoint::new(a.0, a.1), PixelPoint::new(b.0, b.1)];
        let window = PixelRect { x0: -64, y0: -64, x1: 64, y1: 64 };
        choice.draw(ends, window, |p| pixels.push((p.x, p.y)));
        pixels.sort_unstable();
        pixels
    }

    /// The smallest lines on which the sums drift (12/2 at x = 9 in f32, 12/10 in f64), and one on
    /// which nothing can.
    #[test]
    fn drifts_where_it_is_known_to() {
        let exact = Contracted(rasterproof_core::line::dda::Dda);
        let differ = |choice: &dyn Fn(Pixel, Pixel) -> Vec<Pixel>, b| {
            choice((0, 0), b) != pixels(&exact, (0, 0), b)
        };
        let f32s = |a, b| pixels(&Drifting::<f32>::default(), a, b);
        let f64s = |a, b| pixels(&Drifting::<f64>::default(), a, b);
        let fixed = |a, b| pixels(&FixedPoint, a, b);
        assert!(differ(&f32s, (12, 2)) && !differ(&f64s, (12, 2)));
        assert!(differ(&f64s, (12, 10)));
        for choice in [&f32s as &dyn Fn(_, _) -> _, &f64s, &fixed] {
            assert!(!differ(choice, (8, 3)) && !differ(choice, (8, 0)) && !differ(choice, (0, 0)));
            assert!(!differ(choice, (4, -3)) && !differ(choice, (-3, 8)));
        }
    }
}
