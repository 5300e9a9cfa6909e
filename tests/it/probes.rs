//! What the playground and the reports show of an engine's steps is what draws.

use rasterproof_core::contract::Rasterize as _;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::raster::edge_function::EdgeFunction;
use rasterproof_core::raster::edge_function::probe::edges_at;
use rasterproof_core::raster::edge_function_exact::probe::edges_at as exact_edges_at;
use rasterproof_core::raster::scanline::Scanline;
use rasterproof_core::raster::scanline::steps::walked_rows;
use rasterproof_core::raster::scanline_exact::probe::crossings_at;
use rasterproof_core::triangle::{Corners, Span};
use rasterproof_registry::engines::ExactEngine;
use rasterproof_verify::cases::unsnapped;
use rasterproof_verify::cases::{Shape, triangles};
use rasterproof_verify::comparison::exact_coverage;

use crate::recorded::hits;

/// Triangles of every family, with their windows.
fn hazards(cases: u64) -> impl Iterator<Item = (Corners, PixelRect)> {
    triangles::FAMILIES.iter().flat_map(move |family| {
        (0..cases).flat_map(|index| {
            let case = family.case(7, index);
            let Shape::Triangles { list, .. } = case.shape else { return Vec::new() };
            list.iter().map(|triangle| (triangle.corners(), case.window)).collect()
        })
    })
}

/// What is shown is what draws: the columns of the two walks are the ends of the engine's spans.
#[test]
fn walked_rows_are_the_engines() {
    for (corners, window) in hazards(40) {
        let mut drawn = Vec::new();
        Scanline.cover(corners, window, |span| drawn.push(span));
        let spans = walked_rows(corners, window).into_iter().filter_map(|row| {
            let (a, b) = (row.long.column, row.short.column);
            let (x0, x1) = (a.min(b).max(window.x0.into()), a.max(b).min(window.x1.into()));
            let span = Span { y_px: row.y_px, x0_px: x0 as i32, x1_px: x1 as i32 };
            (x0 < x1).then_some(span)
        });
        assert_eq!(spans.collect::<Vec<_>>(), drawn, "{corners:?}");
    }
}

/// The rule read off the three values is the engine's decision, at every pixel.
#[test]
fn edges_at_a_pixel_decide_as_the_engine() {
    for (corners, window) in hazards(8) {
        for (y_px, row) in hits(&EdgeFunction, &[corners], window).rows() {
            for (x_px, hit) in (window.x0..).zip(row) {
                let inside = edges_at(&corners, x_px, y_px).is_some_and(|edges| {
                    edges.iter().all(|e| e.value > 0 || e.value == 0 && e.is_top_left)
                });
                assert_eq!(inside, *hit == 1, "{corners:?} at {x_px}, {y_px}");
            }
        }
    }
}

/// The same for corners that are not snapped, with the sides and crossings that are shown.
#[test]
fn exact_probes_decide_as_the_engines() {
    let mut unsure = 0;
    for family in unsnapped::FAMILIES {
        for case in (0..20).map(|index| family.case(7, index)) {
            for corners in case.free_corners() {
                let alone = std::slice::from_ref(corners);
                let [by_edges, by_rows] = [ExactEngine::EdgeFunction, ExactEngine::Scanline]
                    .map(|engine| exact_coverage(&engine, alone, case.window).unwrap().0);
                for (y_px, row) in by_edges.rows() {
                    let columns = crossings_at(corners, y_px).map(|c| c.map(|c| c.column));
                    for (x_px, hit) in (case.window.x0..).zip(row) {
                        let edges = exact_edges_at(corners, x_px, y_px);
                        let inside = edges.is_some_and(|edges| {
                            edges.iter().all(|e| e.side.is_gt() || e.side.is_eq() && e.is_top_left)
                        });
                        assert_eq!(inside, *hit == 1, "{corners:?} at {x_px}, {y_px}");
                        let between =
                            columns.is_some_and(|[a, b]| a.min(b) <= x_px && x_px < a.max(b));
                        let drawn = by_rows.row(y_px)[(x_px - case.window.x0) as usize];
                        assert_eq!(between, drawn == 1, "{corners:?} at {x_px}, {y_px}");
                        let all = edges.iter().flatten();
                        unsure += all.filter(|e| e.estimate.abs() <= e.bound).count();
                    }
                }
            }
        }
    }
    assert!(unsure > 100, "{unsure} sides that floats cannot tell");
}
