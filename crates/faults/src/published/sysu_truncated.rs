//! Specimen: pixel positions truncated after interpolation, a mistake that the report on SYSU
//! assignment 2 (task 6) describes.
//! Source: Sun Yat-sen University, Computer Graphics, assignment 2, and a published report (2022); see `docs/sources.md`.
//!
//! Symptom: a fragment's position is interpolated from the corners like any attribute and cut to whole numbers.
//! Weights rounded in f32 put it just below the pixel it came from, so it lands on the neighbour: holes inside
//! triangles, and neighbours drawn twice.

use super::sysu_inclusive::{front, samples};
use super::{DrawResult, Published, RealTriangle, Spans, to_int};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::Span;

#[derive(Clone, Copy, Debug)]
pub struct SysuTruncated;

impl Published for SysuTruncated {
    fn cover(&self, triangle: &RealTriangle, bounds: PixelRect, emit: Spans<'_>) -> DrawResult {
        let triangle = front(triangle)?;
        // The corners' positions in whole pixels, as f32.
        let [a, b, c] = triangle.map_array(|v| v.position_px.trunc().as_vec2());
        let mut result = Ok(());
        samples(&triangle, bounds, &mut |s| {
            let [ab, bc, ca] = s.edges.map_array(|f| f as f32 * s.inverse);
            let sum = bc * a + ca * b + ab * c;
            match (to_int(sum.x.into()), to_int(sum.y.into())) {
                (Ok(x), Ok(y)) => {
                    // Within i32, as `to_int` says.
                    let (x_px, y_px) = (x as i32, y as i32);
                    if bounds.contains(x_px, y_px) {
                        emit(Span { y_px, x0_px: x_px, x1_px: x_px + 1 });
                    }
                }
                (Err(refused), _) | (_, Err(refused)) => result = Err(refused),
            }
        })?;
        result
    }

    fn has_values(&self) -> bool {
        false
    }
}
