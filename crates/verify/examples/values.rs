//! Depths and attributes with a tolerance that is derived, and what happens to one that is only guessed.
//!
//! The rasterizer puts planes through the vertices: v(x, y) = v0 + (v1 - v0) b + (v2 - v0) c for v/w, 1/w and depth. Its
//! error grows with the ratio of the w values and with the size of a triangle, so no bound of the form u (d D + m M) holds.

use rasterproof_verify::cases::FamilyName;
use rasterproof_verify::comparison::tolerance::{Bound, Tolerance};
use rasterproof_verify::comparison::{NothingJudged, Options, judge_values};
use rasterproof_verify::contract::{Interpolate, Rasterize};
use rasterproof_verify::grid::PixelRect;
use rasterproof_verify::oracle::Oracle;
use rasterproof_verify::triangle::{Corners, Fragment, ScreenTriangle, Span, Varying};

/// Coverage as it should be, values by planes.
struct Planes;

impl Rasterize for Planes {
    fn cover(&self, corners: Corners, bounds: PixelRect, emit: impl FnMut(Span)) {
        Oracle.cover(corners, bounds, emit);
    }
}

impl Interpolate for Planes {
    fn fragments<V: Varying>(
        &self,
        triangle: &ScreenTriangle<V>,
        bounds: PixelRect,
        mut emit: impl FnMut(Fragment<V>),
    ) {
        let v = &triangle.vertices;
        let at = |i: usize| [f64::from(v[i].position.x), f64::from(v[i].position.y)];
        let [o, p, q] = [at(0), at(1), at(2)];
        let [px, py, qx, qy] = [p[0] - o[0], p[1] - o[1], q[0] - o[0], q[1] - o[1]];
        let area = px * qy - qx * py;
        self.cover(triangle.corners(), bounds, |span| {
            for x_px in span.x0_px..span.x1_px {
                let dx = f64::from(x_px) * 256.0 + 128.0 - o[0];
                let dy = f64::from(span.y_px) * 256.0 + 128.0 - o[1];
                // How much of each of the two other vertices the pixel has.
                let (b, c) = ((dx * qy - qx * dy) / area, (px * dy - dx * py) / area);
                let plane = |f: [f64; 3]| f[0] + (f[1] - f[0]) * b + (f[2] - f[0]) * c;
                let inv_w = plane([v[0].inv_w, v[1].inv_w, v[2].inv_w]);
                let over_w = |f: [f64; 3]| plane([0, 1, 2].map(|i| f[i] * v[i].inv_w)) / inv_w;
                let varying = V::by_number([v[0].varying, v[1].varying, v[2].varying], over_w);
                let depth = plane([v[0].depth, v[1].depth, v[2].depth]);
                emit(Fragment { x_px, y_px: span.y_px, depth, varying });
            }
        });
    }
}

pub fn main() -> Result<(), NothingJudged> {
    let options = Options::default().cases(100);
    let guessed =
        Tolerance { attribute: Bound { d: 15.0, m: 2.0 }, depth: Bound { d: 15.0, m: 2.0 } };
    let verdict = judge_values(&Planes, guessed, &options)?;
    for family in [FamilyName::Uniform, FamilyName::Sliver, FamilyName::W1e6] {
        let report = verdict.families.iter().find(|report| report.family == family.as_str());
        let [attribute, depth] =
            report.map_or([0.0; 2], |r| [r.pairs[0].worst_attribute, r.pairs[0].worst_depth]);
        println!("{family:<8} attributes {attribute:.1e}, depths {depth:.1e} times the bound");
    }
    println!("{}", verdict.check().expect_err("planes lose digits where w differs much"));
    Ok(())
}
