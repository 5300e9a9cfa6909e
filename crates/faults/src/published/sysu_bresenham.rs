//! Specimen: the line of SYSU assignment 2 (rasterize_wire_aux): Bresenham with the decision
//! `flag < 0`, where its text says p <= 0.
//! Source: Sun Yat-sen University, Computer Graphics, assignment 2, and a published report (2022); see `docs/sources.md`.
//!
//! Symptoms: a line that passes halfway between two pixels takes the step, so the side depends on the direction
//! of drawing: of the 4,225 lines from (0, 0) to (x, y), 0 <= x, y <= 64, 1,428 change when reversed. A point
//! has the weight 0/0. Pixels outside the window are walked and dropped one by one.

use super::{MOST_STEPS, NoResult, PublishedLine, to_int};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::PixelRect;

#[derive(Clone, Copy, Debug)]
pub struct SysuBresenham;

impl PublishedLine for SysuBresenham {
    fn draw(
        &self,
        ends_px: [[f64; 2]; 2],
        bounds: PixelRect,
        emit: &mut dyn FnMut(i32, i32),
    ) -> Result<(), NoResult> {
        // `ivec2(position + 0.5)` of the pixel's centre: towards zero.
        let [[x0, y0], [x1, y1]] = ends_px;
        let (from, to) = ([to_int(x0)?, to_int(y0)?], [to_int(x1)?, to_int(y1)?]);
        let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
        let (major, length, rise) =
            if dy.abs() <= dx.abs() { (0, dx.abs(), dy.abs()) } else { (1, dy.abs(), dx.abs()) };
        if length as f64 > MOST_STEPS {
            return Err(NoResult::TooFar(length as f64));
        }
        let step = [dx, dy].map_array(|d| if d < 0 { -1 } else { 1 });
        let (mut at, mut flag) = (from, 2 * rise - length);
        for _ in 0..=length {
            // Within i32: between two ends that are.
            let (x_px, y_px) = (at[0] as i32, at[1] as i32);
            if bounds.contains(x_px, y_px) {
                emit(x_px, y_px);
            }
            at[major] += step[major];
            if flag < 0 {
                flag += 2 * rise;
            } else {
                flag += 2 * rise - 2 * length;
                at[1 - major] += step[1 - major];
            }
        }
        Ok(())
    }
}
