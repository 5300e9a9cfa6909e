//! Specimen: the weights in the wrong order, a mistake that the report on SYSU assignment 2 (task 6)
//! describes.
//!
//! Symptom: the function of edge ab, which belongs to the corner opposite, weighs corner a, and so
//! on round: every value wanders to another corner and colours break at shared edges.
//! Cure: an edge's function weighs the corner opposite. Exposed by any triangle whose corners have
//! different values; harmless where they are equal. Coverage is that of [`super::sysu_inclusive`].

use glam::DVec2;

use super::sysu_inclusive::{SysuInclusive, front, lerp, samples};
use super::{Published, RealTriangle, Refused};
use crate::grid::PixelRect;
use crate::triangle::{Fragment, Span};

/// The rasterizer with its weights in the wrong order.
#[derive(Clone, Copy, Debug)]
pub struct SysuWeights;

impl Published for SysuWeights {
    fn cover(
        &self,
        triangle: &RealTriangle,
        bounds: PixelRect,
        emit: impl FnMut(Span),
    ) -> Result<(), Refused> {
        SysuInclusive.cover(triangle, bounds, emit)
    }

    fn fragments(
        &self,
        triangle: &RealTriangle,
        bounds: PixelRect,
        mut emit: impl FnMut(Fragment<DVec2>),
    ) -> Result<(), Refused> {
        let triangle = front(triangle)?;
        samples(&triangle, bounds, |s| {
            let (depth, varying) = lerp(&triangle, s.edges.map(|f| f as f32 * s.inverse));
            emit(Fragment { x_px: s.x_px, y_px: s.y_px, depth, varying });
        })
    }
}
