//! SYSU assignment 2: lines, clipping, culling, weights.

use glam::{DVec2, DVec4};

use super::tools::{Px, corners};
use super::{Right, Solution, Text};
use rasterproof_core::contract::{DrawLine as _, Rasterize as _};
use rasterproof_core::grid::PixelRect;
use rasterproof_core::line::bresenham::Bresenham;
use rasterproof_core::triangle::PixelPoint;
use rasterproof_faults::published::sysu_bresenham::SysuBresenham;
use rasterproof_faults::published::sysu_weights::SysuWeights;
use rasterproof_faults::published::{
    ClipVertex, Published as _, PublishedLine as _, bare, sysu_simple_clip,
};
use rasterproof_registry::engines::Drawer;
use rasterproof_render::effects::Effects;
use rasterproof_render::pipeline::Counters;
use rasterproof_render::pipeline::assemble::{Assembler, Cull};
use rasterproof_render::pipeline::target::{Antialias, Target};
use rasterproof_render::scene::chapters;
use rasterproof_verify::cases::named::plain_line;
use rasterproof_verify::oracle::Oracle;
use rasterproof_verify::oracle::values::along_line;

solvers!(decision, backwards, dropped, turned, corner);

/// The rows of a line from (0, 0), one for each of its columns.
fn rows(to: [i32; 2]) -> Vec<i32> {
    let line = plain_line(PixelPoint::new(0, 0), PixelPoint::new(to[0], to[1]));
    let mut rows = Vec::new();
    Bresenham.draw(&line, PixelRect::window(16, 16), |f| rows.push(f.y_px));
    rows
}

/// The decision variable of Bresenham's line in column 1, from the exact height of the line.
fn decision(_: &[Text]) -> Solution {
    let rows = rows([8, 3]);
    // dx times the difference of the distances to the two rows of the next column.
    let height = along_line([0.0, 3.0], 2, 8).to_f64();
    let lower = height - f64::from(rows[1]);
    Solution::number(8.0 * (lower - (1.0 - lower)), 0).figure(rows[2])
}

/// The row of column 1 on a line between (0, 0) and (2, 1), as published.
fn published_row(ends: [[f64; 2]; 2]) -> i32 {
    let mut row = None;
    let mut emit = |x, y| row = if x == 1 { Some(y) } else { row };
    let drawn = SysuBresenham.draw(ends, PixelRect::window(3, 2), &mut emit);
    assert_eq!(drawn, Ok(()));
    row.expect("every column is lit")
}

/// The pixel of the middle column on the way back.
fn backwards(_: &[Text]) -> Solution {
    let (first, last) = ([0.5, 0.5], [2.5, 1.5]);
    let [there, back] = [[first, last], [last, first]].map(published_row);
    // The question gives the way there.
    assert_eq!(there, 1);
    Solution::new(Right::Pixel([1, back])).figure(rows([2, 1])[1])
}

/// Corners on the screen, where w is 1 and visible is -1 to 1.
type Screen = [[f64; 2]; 3];

/// The window lies inside the triangle, the triangle lies partly in the window, and it lies beside it.
const AROUND: Screen = [[-9.0, -3.0], [9.0, -3.0], [0.0, 9.0]];
const ACROSS: Screen = [[0.0, 0.0], [3.0, 0.0], [0.0, 3.0]];
const BESIDE: Screen = [[2.0, 0.0], [3.0, 0.0], [2.0, 1.0]];

/// Whether the published choice drops a triangle of which something is visible.
fn is_lost(triangle: Screen) -> bool {
    let vertices = triangle
        .map(|[x, y]| ClipVertex { position: DVec4::new(x, y, 0.0, 1.0), varying: DVec2::ZERO });
    let window = PixelRect::window(8, 8);
    let mut visible = false;
    // The pipeline clips, and the oracle finds whether any of the pieces covers a pixel.
    let assembler = Assembler::new(window, Cull::None);
    let points = vertices.map(|v| assembler.point(v.position));
    assembler.assemble(
        points.each_ref(),
        |_| [0.0; 3],
        &mut Counters::default(),
        |piece| {
            Oracle.cover(piece.corners(), window, |_| visible = true);
        },
    );
    visible && sysu_simple_clip::kept(vertices).is_empty()
}

/// Which of three triangles is lost although it is seen.
fn dropped(_: &[Text]) -> Solution {
    Solution::choice(&[ACROSS, AROUND, BESIDE].map(is_lost))
}

/// How many triangles of the book's cube are culled, of those that are tested.
fn turned(_: &[Text]) -> Solution {
    let scene = chapters::scene("cube", 4.0 / 3.0, 0.0).expect("a scene of the book");
    let mut target =
        Target::new(32, 24, Antialias::None, Default::default()).expect("a small target");
    let drawn = Drawer::EdgeFunction.render(&scene, &Effects::PLANNED, &mut target);
    let counters = drawn.expect("a sound scene").counters;
    Solution::count(counters.culled).figure(counters.cull_tests)
}

/// Its third corner is the sample of a pixel.
const COLOURED: Px = [[1.5, 9.5], [9.5, 8.5], [4.5, 1.5]];

/// The published weight of a corner at the sample that is corner c.
fn weight_at_c(corner: usize) -> f64 {
    // An attribute that is 1 at this corner and 0 at the others.
    let mut triangle = bare(COLOURED);
    triangle[corner].varying = DVec2::X;
    let mut value = None;
    let drawn = SysuWeights.fragments(&triangle, PixelRect::window(11, 11), &mut |f| {
        if (f.x_px, f.y_px) == (4, 1) {
            value = Some(f.varying.x);
        }
    });
    assert_eq!(drawn, Ok(()));
    value.expect("the corner is a sample, and every edge counts as inside")
}

/// Whose colour corner c has as published.
fn corner(_: &[Text]) -> Solution {
    let values = [0, 1, 2].map(weight_at_c);
    assert_eq!(corners(COLOURED)[2].to_px(), (4.5, 1.5), "the corner is the sample");
    let strongest = values.into_iter().fold(0.0, f64::max);
    Solution::choice(&values.map(|value| value == strongest))
}
