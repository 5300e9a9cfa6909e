//! Cameras of a file: where their eyes are, and what they see.

use glam::{DMat4, DVec3};

/// A camera, in the coordinates of the scene once a model is made of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// The name that the file gives to it; empty without one.
    pub name: String,
    pub eye: DVec3,
    /// The direction in which it looks, of any length.
    pub ahead: DVec3,
    pub up: DVec3,
    pub lens: Lens,
    /// The nearest and, where there is one, the farthest distance that it sees.
    pub near: f64,
    pub far: Option<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lens {
    Perspective {
        angle_rad: f64,
    },
    /// A projection without perspective.
    Parallel {
        /// Half of what it sees from below to above.
        half_height: f64,
    },
}

impl Camera {
    pub(crate) fn place(&mut self, matrix: DMat4) {
        self.eye = matrix.transform_point3(self.eye);
        self.ahead = matrix.transform_vector3(self.ahead);
        self.up = matrix.transform_vector3(self.up);
    }

    pub(crate) fn scale(&mut self, factor: f64) {
        self.eye *= factor;
        self.near *= factor;
        self.far = self.far.map(|far| far * factor);
        if let Lens::Parallel { half_height } = &mut self.lens {
            *half_height *= factor;
        }
    }
}
