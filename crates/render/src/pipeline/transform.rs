//! Matrices: projection, rotation about a point, the camera (the book's chapters 4, 8 and 10).
//!
//! Refuses what has no perspective: planes in the wrong order, at or behind the eye, or not finite.

use std::fmt;

use glam::{DMat4, DVec3, DVec4};

use rasterproof_core::angle::tan;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoProjection(&'static str);

impl fmt::Display for NoProjection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0)
    }
}

impl std::error::Error for NoProjection {}

/// The book's left-handed frustum (section 8.2): the eye at the origin looks along +z, the near
/// plane z = near shows x from left to right and y from bottom to top, and w = z.
///
/// z/w is -1 at the near and 1 at the far plane. All six in units of the scene.
///
/// ```
/// use glam::{DVec3, DVec4};
/// use rasterproof_render::pipeline::transform::frustum;
/// let projection = frustum(-2.0, 2.0, -1.5, 1.5, 1.0, 3.0)?;
/// assert_eq!(projection * DVec3::new(2.0, 1.5, 1.0).extend(1.0), DVec4::new(1.0, 1.0, -1.0, 1.0));
/// assert_eq!(projection * DVec3::new(0.0, 0.0, 3.0).extend(1.0), DVec4::new(0.0, 0.0, 3.0, 3.0));
/// # Ok::<(), rasterproof_render::pipeline::transform::NoProjection>(())
/// ```
///
/// # Errors
/// [`NoProjection`] unless left < right, bottom < top and 0 < near < far, all finite.
pub fn frustum(
    left: f64,
    right: f64,
    bottom: f64,
    top: f64,
    near: f64,
    far: f64,
) -> Result<DMat4, NoProjection> {
    if ![left, right, bottom, top, near, far].iter().all(|v| v.is_finite()) {
        return Err(NoProjection("a side of the frustum is not finite"));
    }
    if left >= right || bottom >= top {
        return Err(NoProjection("the frustum needs left < right and bottom < top"));
    }
    if !(0.0 < near && near < far) {
        return Err(NoProjection("the frustum needs 0 < near < far"));
    }
    let (width, height, length) = (right - left, top - bottom, far - near);
    Ok(DMat4::from_cols(
        DVec4::new(2.0 * near / width, 0.0, 0.0, 0.0),
        DVec4::new(0.0, 2.0 * near / height, 0.0, 0.0),
        DVec4::new(-(right + left) / width, -(top + bottom) / height, (far + near) / length, 1.0),
        DVec4::new(0.0, 0.0, -2.0 * near * far / length, 0.0),
    ))
}

/// A symmetric [`frustum`] from the vertical angle of view, in radians, and width / height.
///
/// # Errors
/// As [`frustum`]; the angle must lie strictly between 0 and pi.
pub fn perspective(
    angle_rad: f64,
    aspect: f64,
    near: f64,
    far: f64,
) -> Result<DMat4, NoProjection> {
    if !(angle_rad > 0.0 && angle_rad < std::f64::consts::PI) {
        return Err(NoProjection("the angle of view lies strictly between 0 and 180 degrees"));
    }
    let top = near * tan(angle_rad / 2.0);
    frustum(-top * aspect, top * aspect, -top, top, near, far)
}

/// A projection without perspective: w is 1, and z/w grows with the distance, from -1 at the near to 1 at the far plane. The
/// window shows `half_height` above and below the axis.
///
/// # Errors
/// [`NoProjection`] unless `half_height` is above 0 and near < far, all finite.
pub fn parallel(half_height: f64, aspect: f64, near: f64, far: f64) -> Result<DMat4, NoProjection> {
    if ![half_height, aspect, near, far].iter().all(|v| v.is_finite()) {
        return Err(NoProjection("a side of the view is not finite"));
    }
    if half_height <= 0.0 || aspect <= 0.0 || near >= far {
        return Err(NoProjection("the view needs a height above 0 and near < far"));
    }
    let length = far - near;
    Ok(DMat4::from_cols(
        DVec4::new(1.0 / (half_height * aspect), 0.0, 0.0, 0.0),
        DVec4::new(0.0, 1.0 / half_height, 0.0, 0.0),
        DVec4::new(0.0, 0.0, 2.0 / length, 0.0),
        DVec4::new(0.0, 0.0, -(far + near) / length, 1.0),
    ))
}

/// The model matrix that turns things about a point instead of about the origin: there and back
/// again (section 10.5).
///
/// ```
/// use glam::DVec3;
/// use rasterproof_core::angle::turn_y;
/// use rasterproof_render::pipeline::transform::about;
/// let centre = DVec3::new(0.0, 0.0, 4.0);
/// let turned = about(centre, turn_y(1.0));
/// assert_eq!(turned.transform_point3(centre), centre);
/// ```
#[must_use]
pub fn about(centre: DVec3, turn: DMat4) -> DMat4 {
    DMat4::from_translation(centre) * turn * DMat4::from_translation(-centre)
}

/// The view matrix of an eye that looks at a target: moves the world so that the eye is at the
/// origin and looks along +z, left-handed.
///
/// # Errors
/// [`NoProjection`] where eye and target coincide, or `up` points along the view.
pub fn look_at(eye: DVec3, target: DVec3, up: DVec3) -> Result<DMat4, NoProjection> {
    look_along(eye, target - eye, up)
}

/// The same of an eye that looks in a direction.
///
/// # Errors
/// [`NoProjection`] where there is no direction, or `up` points along it.
pub fn look_along(eye: DVec3, ahead: DVec3, up: DVec3) -> Result<DMat4, NoProjection> {
    let forward =
        ahead.try_normalize().ok_or(NoProjection("the eye must not be where it looks at"))?;
    let right = up
        .cross(forward)
        .try_normalize()
        .ok_or(NoProjection("the view must not point along 'up'"))?;
    let up = forward.cross(right);
    let rotation = DMat4::from_cols(
        DVec4::new(right.x, up.x, forward.x, 0.0),
        DVec4::new(right.y, up.y, forward.y, 0.0),
        DVec4::new(right.z, up.z, forward.z, 0.0),
        DVec4::W,
    );
    Ok(rotation * DMat4::from_translation(-eye))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_perspective_the_corners_of_a_box_are_those_of_clip_space() {
        let projection = parallel(2.0, 1.5, 1.0, 5.0).unwrap();
        for (point, clip) in
            [([3.0, 2.0, 5.0], [1.0, 1.0, 1.0]), ([-3.0, 0.0, 1.0], [-1.0, 0.0, -1.0])]
        {
            let found = projection * DVec3::from_array(point).extend(1.0);
            assert_eq!(found, DVec3::from_array(clip).extend(1.0));
        }
        for [height, near, far] in [[0.0, 1.0, 2.0], [1.0, 2.0, 2.0], [1.0, 0.0, f64::NAN]] {
            assert!(parallel(height, 1.0, near, far).is_err());
        }
    }

    #[test]
    fn frustum_is_the_books() {
        // Section 8.2 written out for one point: l, r, b, t, n, f = -1, 3, -2, 1, 2, 10.
        let (x, y, z) = (0.5, -0.25, 4.0);
        let p = frustum(-1.0, 3.0, -2.0, 1.0, 2.0, 10.0).unwrap() * DVec4::new(x, y, z, 1.0);
        let expected = DVec4::new(
            2.0 * 2.0 * x / 4.0 - 2.0 / 4.0 * z,
            2.0 * 2.0 * y / 3.0 - -1.0 / 3.0 * z,
            12.0 / 8.0 * z - 40.0 / 8.0,
            z,
        );
        // Three operations each, of numbers below 8.
        assert!((p - expected).abs().max_element() <= 8.0 * 4.0 * f64::EPSILON);
    }

    #[test]
    fn what_has_no_projection_is_refused() {
        for sides in [
            [1.0, -1.0, -1.0, 1.0, 1.0, 2.0],
            [-1.0, 1.0, -1.0, 1.0, 0.0, 2.0],
            [-1.0, 1.0, -1.0, 1.0, 2.0, 1.0],
            [-1.0, 1.0, f64::NAN, 1.0, 1.0, 2.0],
        ] {
            let [l, r, b, t, n, f] = sides;
            assert!(frustum(l, r, b, t, n, f).is_err(), "{sides:?}");
        }
        assert!(perspective(0.0, 1.0, 1.0, 2.0).is_err());
        assert!(look_at(DVec3::ONE, DVec3::ONE, DVec3::Y).is_err());
        assert!(look_at(DVec3::ZERO, DVec3::Y, DVec3::Y).is_err());
    }

    #[test]
    fn camera_looks_along_z() {
        let view = look_at(DVec3::new(0.0, 0.0, -5.0), DVec3::ZERO, DVec3::Y).unwrap();
        assert_eq!(view.transform_point3(DVec3::ZERO), DVec3::new(0.0, 0.0, 5.0));
        assert_eq!(view.transform_point3(DVec3::X), DVec3::new(1.0, 0.0, 5.0));
    }
}
