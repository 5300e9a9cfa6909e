//! Oracles with a planted fault each: what the engines are judged by can be wrong too.

use super::each_sample;
use rasterproof_core::contract::{Interpolate, Rasterize};
use rasterproof_core::geometry::centre_of;
use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_core::triangle::{Corners, Fragment, ScreenTriangle, Span, Varying};
use rasterproof_verify::oracle::Oracle;

planted! {
    OracleMutant {
        TiesGoLeft "oracle-ties-go-left": "of an oracle: right edges own their samples",
        PlanesInF32 "oracle-planes-in-f32": "of an oracle: sides are signs computed in f32",
        AffineValues "oracle-affine-values": "of an oracle: values ignore w",
    }
}

impl OracleMutant {
    /// Whether the edge from `upper` to `lower` crosses the row left of a sample, by this mutant.
    fn is_left(self, upper: SubpixelPoint, lower: SubpixelPoint, sample: SubpixelPoint) -> bool {
        // As the oracle has it, but for the comparison at the end.
        let [ux, uy, lx, ly, sx, sy] =
            [upper.x, upper.y, lower.x, lower.y, sample.x, sample.y].map(i128::from);
        if self == Self::PlanesInF32 {
            // dy x - dx y - c >= 0, each number rounded to 24 bits.
            let (a, b) = ((ly - uy) as f32, (ux - lx) as f32);
            let c = a * ux as f32 + b * uy as f32;
            return a * sx as f32 + b * sy as f32 >= c;
        }
        (sy - uy) * (lx - ux) < (sx - ux) * (ly - uy)
    }
}

impl Rasterize for OracleMutant {
    fn cover(&self, corners: Corners, bounds: PixelRect, mut emit: impl FnMut(Span)) {
        if *self == Self::AffineValues {
            return Oracle.spans(corners, bounds, &mut emit);
        }
        let inside = |x_px, y_px| {
            let sample = centre_of(x_px, y_px);
            let mut is_inside = false;
            for i in 0..3 {
                let (a, b) = (corners[i], corners[(i + 1) % 3]);
                // A sample is inside after an odd number of crossings.
                is_inside ^= match (a.y <= sample.y, b.y <= sample.y) {
                    (true, false) => self.is_left(a, b, sample),
                    (false, true) => self.is_left(b, a, sample),
                    _ => false,
                };
            }
            is_inside
        };
        each_sample(bounds, &inside, &mut emit);
    }
}

impl Interpolate for OracleMutant {
    fn fragments<V: Varying>(
        &self,
        triangle: &ScreenTriangle<V>,
        bounds: PixelRect,
        emit: impl FnMut(Fragment<V>),
    ) {
        let mut spoilt = *triangle;
        if *self == Self::AffineValues {
            for vertex in &mut spoilt.vertices {
                vertex.inv_w = 1.0;
            }
        }
        Oracle.fragments(&spoilt, bounds, emit);
    }
}
