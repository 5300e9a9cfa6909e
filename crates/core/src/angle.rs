//! Sine, cosine, tangent and rotations: the same bits on every machine.
//!
//! The C library behind `f64::sin` may round a last bit otherwise on another machine, or after an
//! update. These functions are compiled with the program, and have only what every machine rounds in
//! the same way: sums, products, quotients.

use glam::{DMat4, DVec4};

pub use libm::{atan, cos, sin, tan};

/// Sine and cosine of an angle in radians.
#[must_use]
pub fn sin_cos(angle_rad: f64) -> (f64, f64) {
    (sin(angle_rad), cos(angle_rad))
}

/// A rotation about the x axis, from y to z.
#[must_use]
pub fn turn_x(angle_rad: f64) -> DMat4 {
    let (sin, cos) = sin_cos(angle_rad);
    DMat4::from_cols(
        DVec4::X,
        DVec4::new(0.0, cos, sin, 0.0),
        DVec4::new(0.0, -sin, cos, 0.0),
        DVec4::W,
    )
}

/// A rotation about the y axis, from z to x.
#[must_use]
pub fn turn_y(angle_rad: f64) -> DMat4 {
    let (sin, cos) = sin_cos(angle_rad);
    DMat4::from_cols(
        DVec4::new(cos, 0.0, -sin, 0.0),
        DVec4::Y,
        DVec4::new(sin, 0.0, cos, 0.0),
        DVec4::W,
    )
}

/// A rotation about the z axis, from x to y.
#[must_use]
pub fn turn_z(angle_rad: f64) -> DMat4 {
    let (sin, cos) = sin_cos(angle_rad);
    DMat4::from_cols(
        DVec4::new(cos, sin, 0.0, 0.0),
        DVec4::new(-sin, cos, 0.0, 0.0),
        DVec4::Z,
        DVec4::W,
    )
}

#[cfg(test)]
#[expect(clippy::disallowed_methods, reason = "what these are compared with")]
mod tests {
    use super::*;

    /// Within two units in the last place of the C library, whichever there is; and one result to the
    /// bit: sin 0.37, by its series in 50 digits, is 0.361615431964961973896...
    #[test]
    fn close_to_the_other_ones() {
        for i in -1000..1000 {
            let x = f64::from(i) / 100.0;
            for (a, b) in [(sin(x), x.sin()), (cos(x), x.cos())] {
                assert!((a - b).abs() <= f64::EPSILON, "{x}: {a} {b}");
            }
            let turns = [
                (turn_x(x), DMat4::from_rotation_x(x)),
                (turn_y(x), DMat4::from_rotation_y(x)),
                (turn_z(x), DMat4::from_rotation_z(x)),
            ];
            for (a, b) in turns {
                assert!(a.abs_diff_eq(b, f64::EPSILON), "{x}: {a} {b}");
            }
        }
        assert_eq!(sin(0.37), 0.361_615_431_964_962);
        assert!((atan(1.0) * 4.0 - std::f64::consts::PI).abs() <= 4.0 * f64::EPSILON);
        assert!((tan(0.5) - 0.5f64.tan()).abs() <= f64::EPSILON);
    }
}
