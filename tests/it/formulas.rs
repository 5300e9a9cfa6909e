//! The formulas of verb Q: the pipeline computes the same where it uses them, and a request that has no answer gets a reason.

use glam::{DMat3, DMat4, DVec2, DVec3};
use rasterproof_core::angle::{turn_x, turn_y, turn_z};
use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_core::triangle::Corners;
use rasterproof_render::pipeline::ClipVertex;
use rasterproof_render::pipeline::assemble::{Cull, Viewport};
use rasterproof_render::pipeline::footprint::Footprint;
use rasterproof_render::pipeline::shade::Light;
use rasterproof_render::pipeline::texture::{Filter, Texture, Wrap};
use rasterproof_render::pipeline::transform::{about, frustum};
use rasterproof_verify::cases::{Shape, formulas};
use rasterproof_verify::oracle::formula::Formula;

use crate::protocol::ask;

/// What the pipeline makes of the numbers of a formula.
fn pipeline(formula: Formula, n: &[f64]) -> Vec<f64> {
    let point = |at: usize| DVec3::new(n[at], n[at + 1], n[at + 2]);
    match formula {
        Formula::Project => {
            let projection = frustum(-1.0, 1.0, -1.0, 1.0, n[0], 2.0 * n[0]).unwrap();
            let clip = projection * point(1).extend(1.0);
            vec![clip.x / clip.w, clip.y / clip.w, clip.w]
        }
        Formula::Window => {
            let projection = frustum(-1.0, 1.0, -1.0, 1.0, n[2], n[3]).unwrap();
            let vertex = ClipVertex { position: projection * point(4).extend(1.0), varying: 0.0 };
            let window = PixelRect::window(n[0] as u32, n[1] as u32);
            let placed = Viewport::new(window).place(&vertex).unwrap();
            let (x, y) = placed.position.to_px();
            vec![x, y, placed.depth]
        }
        Formula::Winding => {
            let corners = [0, 2, 4].map(|i| SubpixelPoint::from_px(n[i], n[i + 1]).unwrap());
            let is = |cull: Cull| f64::from(u8::from(cull.removes(corners)));
            vec![is(Cull::Clockwise) - is(Cull::CounterClockwise)]
        }
        Formula::Turn => {
            let turn: fn(f64) -> DMat4 = [turn_x, turn_y, turn_z][n[0] as usize];
            let turn = turn(libm::atan2(n[2], n[1]));
            about(point(3), turn).transform_point3(point(6)).to_array().to_vec()
        }
        Formula::Normal => {
            let rows = DMat3::from_cols(point(0), point(3), point(6));
            // Its rows were taken as columns, so that it is transposed already.
            (rows.inverse() * point(9)).to_array().to_vec()
        }
        Formula::Light => {
            let light = Light { towards: point(3), ambient: n[6], diffuse: n[7] };
            vec![light.intensity(point(0))]
        }
        Formula::Texel => {
            let grey = n[1..].iter().map(|texel| *texel as u8).collect::<Vec<_>>();
            let texture = Texture::grey(grey.len() as u32, 1, grey).unwrap();
            let read = |filter| {
                let texture = texture.clone().with(filter, [Wrap::Repeat; 2]);
                texture.at(DVec2::new(n[0], 0.5)).x * 255.0
            };
            vec![read(Filter::Nearest), read(Filter::Bilinear)]
        }
        Formula::Level => {
            let at = |corner: usize| &n[2 + 5 * corner..7 + 5 * corner];
            let corners: Corners =
                [0, 1, 2].map(|i| SubpixelPoint::from_px(at(i)[0], at(i)[1]).unwrap());
            let inv_w = [0, 1, 2].map(|i| 1.0 / at(i)[2]);
            let uv = [0, 1, 2].map(|i| DVec2::new(at(i)[3], at(i)[4]));
            // The weights of the place, by areas.
            let [a, b, c] = [0, 1, 2].map(|i| DVec2::new(at(i)[0], at(i)[1]));
            let place = DVec2::new(n[17], n[18]);
            let area = (b - a).perp_dot(c - a);
            let weights = [(b, c), (c, a), (a, b)]
                .map(|(from, to)| (to - from).perp_dot(place - from) / area);
            let q: f64 = (0..3).map(|i| weights[i] * inv_w[i]).sum();
            let here = (0..3).map(|i| uv[i] * (weights[i] * inv_w[i])).sum::<DVec2>() / q;
            let footprint = Footprint::new(corners, inv_w, uv, (n[0] as u32, n[1] as u32));
            vec![footprint.level(here, 1.0 / q)]
        }
    }
}

#[test]
fn formulas_are_those_of_the_pipeline() {
    let mut asked = [0; Formula::ALL.len()];
    for family in formulas::FAMILIES {
        for index in 0..300 {
            let Shape::Numbers { formula, numbers } = family.case(1, index).shape else {
                panic!("{}", family.name)
            };
            let exact = formula.of(&numbers).unwrap();
            let computed = pipeline(formula, &numbers);
            assert_eq!(exact.len(), computed.len());
            for (at, (exact, computed)) in exact.iter().zip(computed).enumerate() {
                // A place in the window is on the grid.
                let step = if formula == Formula::Window && at < 2 { 1.0 / 512.0 } else { 0.0 };
                let bound = 1e-9 * exact.scale + step;
                let off = exact.exact.distance(computed);
                assert!(off <= bound, "{} {numbers:?}: {computed}, off by {off}", formula.name());
            }
            asked[formula as usize] += 1;
        }
    }
    assert_eq!(asked, [300; 8]);
}

/// A request that cannot be answered says why.
#[test]
fn formulas_are_refused_with_a_reason() {
    let asked = "Q 1 project 1 2 1 4\nQ 2 project 1 2 1\nQ 3 project 1 2 1 0\nQ 4 lens 1\nQ 5 light x\nQ 6\n";
    let said = ask("oracle", asked.as_bytes());
    assert_eq!(
        said,
        [
            "O 1 3 0.5 0.25 4",
            "E 2 these are no numbers for project",
            "E 3 these are no numbers for project",
            "E 4 no formula is called 'lens'; expected one of project, window, winding, turn, normal, light, texel, level",
            "E 5 number 1 'x' cannot be read",
            "E 6 Q takes an id, a name and numbers",
        ]
    );
    assert_eq!(ask("scanline", b"Q 1 project 1 2 1 4\n"), ["E 1 unsupported"]);
}
