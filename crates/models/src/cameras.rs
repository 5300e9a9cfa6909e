//! Cameras of a file: where their eyes are, and what they see.

use glam::{DMat4, DVec3};
use rasterproof_host::text::printable_short;
use rasterproof_render::pipeline::transform::{NoProjection, look_along, parallel, perspective};

/// A camera, in the coordinates of the scene once a model is made of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// The name that the file gives to it; empty without one.
    pub name: String,
    pub eye: DVec3,
    /// The direction in which it looks, of any length.
    pub ahead: DVec3,
    /// The direction that is upwards in the picture, not along the view.
    pub up: DVec3,
    pub lens: Lens,
    /// The nearest and, where there is one, the farthest distance that it sees.
    pub near: f64,
    /// Nothing for a camera that sees infinitely far.
    pub far: Option<f64>,
}

/// What a camera sees of what is before it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lens {
    Perspective {
        /// The angle that it sees from below to above.
        angle_rad: f64,
    },
    /// A projection without perspective.
    Parallel {
        /// Half of what it sees from below to above.
        half_height: f64,
    },
}

impl Camera {
    /// The matrices from world to camera and from camera to clip space, for a model between two corners. The height of a picture
    /// shows what the camera sees from below to above, and `aspect` decides how much it shows beside that.
    pub fn matrices(
        &self,
        aspect: f64,
        [min, max]: [DVec3; 2],
    ) -> Result<[DMat4; 2], NoProjection> {
        let view = look_along(self.eye, self.ahead, self.up)?;
        let near = self.near;
        // A camera that sees infinitely far sees all of the model.
        let far = match self.far {
            Some(far) => far,
            None => {
                let mut farthest = 2.0 * near;
                for x in [min.x, max.x] {
                    for y in [min.y, max.y] {
                        for z in [min.z, max.z] {
                            let corner = view.transform_point3(DVec3::new(x, y, z));
                            farthest = farthest.max(corner.z);
                        }
                    }
                }
                // A little farther, so that no corner lies on the plane.
                1.01 * farthest
            }
        };
        let projection = match self.lens {
            Lens::Perspective { angle_rad } => perspective(angle_rad, aspect, near, far),
            Lens::Parallel { half_height } => parallel(half_height, aspect, near, far),
        }?;
        Ok([view, projection])
    }

    /// Moves it from the coordinates of its node, or of the file, to others.
    pub(crate) fn place(&mut self, matrix: DMat4) {
        self.eye = matrix.transform_point3(self.eye);
        self.ahead = matrix.transform_vector3(self.ahead);
        self.up = matrix.transform_vector3(self.up);
    }

    /// Makes all lengths longer by a factor.
    pub(crate) fn scale(&mut self, factor: f64) {
        self.eye *= factor;
        self.near *= factor;
        self.far = self.far.map(|far| far * factor);
        if let Lens::Parallel { half_height } = &mut self.lens {
            *half_height *= factor;
        }
    }
}

/// A note lists so many cameras or animations.
const MOST_LISTED: usize = 8;

/// Cameras or animations by number and name: `1 'front', 2`.
pub fn listed<'a>(names: impl ExactSizeIterator<Item = &'a str>) -> String {
    let count = names.len();
    let one = |(number, name): (usize, &str)| match name {
        "" => format!("{}", number + 1),
        name => format!("{} '{}'", number + 1, printable_short(name, 40)),
    };
    let mut list: Vec<String> = names.enumerate().take(MOST_LISTED).map(one).collect();
    if count > MOST_LISTED {
        list.push(format!("... {count}"));
    }
    list.join(", ")
}

/// The camera of this number, from 1, or else of this name.
pub fn find<'a>(cameras: &'a [Camera], wanted: &str) -> Result<&'a Camera, String> {
    let number = wanted.trim().parse::<usize>().ok().and_then(|number| number.checked_sub(1));
    let numbered = number.and_then(|number| cameras.get(number));
    let named = || cameras.iter().find(|camera| camera.name == wanted);
    numbered.or_else(named).ok_or_else(|| match cameras {
        [] => "the model has no cameras".to_owned(),
        _ => {
            let names = cameras.iter().map(|camera| camera.name.as_str());
            format!("the model has the cameras {}", listed(names))
        }
    })
}
