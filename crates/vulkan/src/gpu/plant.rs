//! Planted faults: what a wrong driver, or a failing one, would look like.

use crate::device::draw::{Draw, Failing, Vertex};

rasterproof_core::named! {
    /// A fault that is planted between the judge and the device.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Plant {
        /// The viewport is moved right by 1/16 px: every sample lies that much further left.
        ShiftedSamples = "shifted-samples",
        /// Corners are moved right and down by a step of the lattice: samples on top and left edges are
        /// lost, those on bottom and right edges won.
        BottomRightRule = "bottom-right-rule",
        DrawsTwice = "draws-twice",
        /// Attributes are interpolated without perspective.
        NoPerspective = "no-perspective",
        /// Four samples lie elsewhere: the viewport is moved for them alone.
        ShiftedMasks = "shifted-masks",
        /// Triangles with twice an area of 2^23 px^2 or more are lost.
        LosesLarge = "loses-large",
        /// Depths are rounded to 1/4096 before they are drawn.
        CoarseDepths = "coarse-depths",
        /// What lies in front of the near plane is not clipped but drawn at the plane.
        NoNearPlane = "no-near-plane",
        /// The first triangle of every third submission is lost, so that answers change.
        ForgetsAtTimes = "forgets-at-times",
        /// The device is lost at the third submission.
        Lost = "lost",
        /// Memory is short at the third submission.
        OutOfMemory = "out-of-memory",
    }
}

impl Plant {
    /// The failure that the painter is made to have; other faults spoil what is drawn.
    pub fn failing(self) -> Option<Failing> {
        match self {
            Self::Lost => Some(Failing::Lost(3)),
            Self::OutOfMemory => Some(Failing::OutOfMemory(3)),
            _ => None,
        }
    }

    /// Spoils a list of draws; `samples` says that it is for masks, `step_px` is the lattice's step, and so many submissions came before.
    pub(super) fn spoil(self, draws: &mut Vec<Draw>, samples: bool, step_px: f32, before: u64) {
        match self {
            Self::DrawsTwice => *draws = draws.iter().flat_map(|d| [*d, *d]).collect(),
            Self::ForgetsAtTimes if before % 3 == 2 => {
                if let Some(first) = draws.first_mut() {
                    lose(first);
                }
            }
            _ => {
                for draw in draws {
                    self.spoil_one(draw, samples, step_px);
                }
            }
        }
    }

    /// Spoils a draw by a fault that each draw has for itself.
    fn spoil_one(self, draw: &mut Draw, samples: bool, step_px: f32) {
        match self {
            Self::ShiftedSamples => draw.viewport[0] += 1.0 / 16.0,
            Self::ShiftedMasks if samples => draw.viewport[1] -= 1.0 / 16.0,
            Self::BottomRightRule => {
                draw.viewport[0] += step_px;
                draw.viewport[1] += step_px;
            }
            Self::LosesLarge if twice_area_px2(draw) >= 8_388_608.0 => lose(draw),
            Self::CoarseDepths => {
                // Depth is z / w.
                for Vertex { clip: [.., z, w], .. } in &mut draw.vertices {
                    *z = (*z / *w * 4096.0).round() / 4096.0 * *w;
                }
            }
            Self::NoNearPlane => {
                for Vertex { clip: [.., z, _], .. } in &mut draw.vertices {
                    *z = z.max(0.0);
                }
            }
            _ => {}
        }
    }
}

/// Makes a triangle so thin that it has no pixel.
fn lose(draw: &mut Draw) {
    draw.vertices[1] = draw.vertices[0];
}

/// Twice the area on the screen, from clip coordinates.
fn twice_area_px2(draw: &Draw) -> f64 {
    let [.., width, height] = draw.viewport.map(f64::from);
    let [a, b, c] = draw.vertices.map(|v| {
        let [x, y, _, w] = v.clip.map(f64::from);
        [x / w * width / 2.0, y / w * height / 2.0]
    });
    ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs()
}
