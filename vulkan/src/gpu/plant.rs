//! Planted faults: what a wrong driver, or a failing one, would look like.

use crate::device::draw::{Draw, Failing};

/// A fault that is planted between the judge and the device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Plant {
    /// The viewport is moved right by 1/16 px: every sample lies that much further left.
    ShiftedSamples,
    /// Corners are moved right and down by a step of the lattice: samples on top and left edges are
    /// lost, those on bottom and right edges won.
    BottomRightRule,
    /// Every primitive is drawn twice.
    DrawsTwice,
    /// Attributes are interpolated without perspective.
    NoPerspective,
    /// Four samples lie elsewhere: the viewport is moved for them alone.
    ShiftedMasks,
    /// The device is lost at the third submission.
    Lost,
    /// Memory is short at the third submission.
    OutOfMemory,
}

impl Plant {
    /// All of them, by their names.
    pub const ALL: [(&'static str, Self); 7] = [
        ("shifted-samples", Self::ShiftedSamples),
        ("bottom-right-rule", Self::BottomRightRule),
        ("draws-twice", Self::DrawsTwice),
        ("no-perspective", Self::NoPerspective),
        ("shifted-masks", Self::ShiftedMasks),
        ("lost", Self::Lost),
        ("out-of-memory", Self::OutOfMemory),
    ];

    /// The submission that fails.
    #[must_use]
    pub fn failing(self) -> Option<Failing> {
        match self {
            Self::Lost => Some(Failing::Lost(3)),
            Self::OutOfMemory => Some(Failing::OutOfMemory(3)),
            _ => None,
        }
    }

    /// Spoils a list of draws; `samples` says that it is for masks, `step_px` is the lattice's step.
    pub(super) fn spoil(self, draws: &mut Vec<Draw>, samples: bool, step_px: f32) {
        match self {
            Self::ShiftedSamples => draws.iter_mut().for_each(|d| d.viewport[0] += 1.0 / 16.0),
            Self::ShiftedMasks if samples => {
                draws.iter_mut().for_each(|d| d.viewport[1] -= 1.0 / 16.0);
            }
            Self::BottomRightRule => {
                for d in draws {
                    d.viewport[0] += step_px;
                    d.viewport[1] += step_px;
                }
            }
            Self::DrawsTwice => *draws = draws.iter().flat_map(|d| [*d, *d]).collect(),
            _ => {}
        }
    }
}
