//! The tile engine against the oracle in every instruction set of this machine, at the borders of
//! its words, and what is painted from its pieces. Lists and their order are invariant 47.

use rasterproof_core::contract::Rasterize;
use rasterproof_core::frame::{Coverage, Frame};
use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_core::triangle::Corners;
use rasterproof_tiles::coverage::{CoverList, NARROW_EXTENT, NEAR_EXTENT, Piece, Tiles};
use rasterproof_tiles::paint;
use rasterproof_verify::cases::Shape;
use rasterproof_verify::cases::triangles::FAMILIES;
use rasterproof_verify::oracle::Oracle;

use crate::recorded::hits;

fn tiles(engine: &Tiles, list: &[Corners], window: PixelRect) -> (Vec<Coverage>, Vec<Piece>) {
    let mut hits: Vec<_> = list.iter().map(|_| Coverage::new(window, 0)).collect();
    let mut pieces = Vec::new();
    engine.cover_list(list, window, &mut |run| pieces.extend_from_slice(run));
    for piece in &pieces {
        match piece {
            Piece::Cell(cell) => assert!(cell.pixels != 0, "{cell:?}"),
            Piece::Quarter(quarter) => assert!(quarter.pixels != 0, "{quarter:?}"),
            Piece::Tile(tile) => assert!(tile.rows != [0; 16], "{tile:?}"),
            Piece::Block(block) => assert!(!block.rect.is_empty(), "{block:?}"),
        }
        let hits = &mut hits[piece.triangle() as usize];
        piece.spans(&mut |span| hits.hit(span.y_px, span.x0_px, span.x1_px));
    }
    (hits, pieces)
}

fn compare(list: &[Corners], window: PixelRect) {
    let truth: Vec<_> = list.iter().map(|&corners| hits(&Oracle, &[corners], window)).collect();
    for engine in Tiles::levels() {
        let (hits, _) = tiles(&engine, list, window);
        for ((corners, actual), truth) in list.iter().zip(&hits).zip(&truth) {
            assert!(actual == truth, "{}: {corners:?} in {window:?}", engine.instructions());
        }
    }
}

#[test]
fn every_instruction_set_is_exact() {
    for family in FAMILIES {
        for index in 0..60 {
            let case = family.case(0x74_69_6c_65, index);
            let Shape::Triangles { list, .. } = &case.shape else { unreachable!() };
            let list: Vec<Corners> = list.iter().map(|triangle| triangle.corners()).collect();
            compare(&list, case.window);
        }
    }
}

/// Large windows: whole tiles, groups of sixteen tiles, and a window that begins anywhere.
#[test]
fn large_windows_are_exact() {
    let family = FAMILIES.iter().find(|family| family.name == "uniform").unwrap();
    for index in 0..12 {
        let case = family.case(7, index);
        let Shape::Triangles { list, .. } = &case.shape else { unreachable!() };
        let larger = |p: SubpixelPoint| SubpixelPoint::new(p.x * 12 + 5, p.y * 9 - 300);
        let list: Vec<Corners> = list.iter().map(|t| t.corners().map(larger)).collect();
        compare(&list, PixelRect { x0: -3, y0: 5, x1: 601, y1: 430 });
    }
}

/// Triangles whose corners are corners of a box, and one on each of its sides: E takes its largest
/// values in those. Seen at the corners of the box.
fn at_the_corners_of_a_box(at: SubpixelPoint, width: i64, height: i64) {
    let along = |p: i32, by: i64| i32::try_from(i64::from(p) + by).ok();
    let (Some(x), Some(y)) = (along(at.x, width), along(at.y, height)) else { return };
    let box_corners = [[at.x, at.y], [x, at.y], [x, y], [at.x, y]];
    let middle = [along(at.x, width / 3).unwrap(), along(at.y, height / 5 * 2).unwrap()];
    let mut list = Vec::new();
    for i in 0..4 {
        let [a, b, c] = [0, 1, 2].map(|k| box_corners[(i + k) % 4]);
        let side = [if a[0] == b[0] { a[0] } else { middle[0] }, middle[1]];
        for [a, b, c] in [[a, b, c], [a, c, b], [a, c, side], [side, b, c], [b, side, a]] {
            list.push([a, b, c].map(|[x, y]| SubpixelPoint::new(x, y)));
        }
    }
    for corner in box_corners {
        let [x0, y0] = corner.map(|sub| (sub >> 8) - 3);
        compare(&list, PixelRect { x0, y0, x1: x0 + 7, y1: y0 + 7 });
    }
}

/// 11 and 180 px and just beyond, at all kinds of phases; what is stepped in i32 and just beyond that; and
/// the largest boxes there are, where extents wrap around in 32 bits.
#[test]
fn borders_of_the_words_are_exact() {
    let (near, narrow) = (i64::from(NEAR_EXTENT), i64::from(NARROW_EXTENT));
    let stepped = 733_263;
    let origin = SubpixelPoint::new;
    for phase in [0, 1, 127, 128, 129, 255] {
        for (more, less) in [(0, 0), (1, 0), (0, 1), (1, 1), (-1, 0), (300, -300)] {
            let at = origin(-77 * 256 + phase, 31 * 256 - phase);
            at_the_corners_of_a_box(at, near + more, near + less);
            at_the_corners_of_a_box(at, narrow + more, narrow + less);
            at_the_corners_of_a_box(at, stepped + more, stepped + less);
        }
        let low = origin(i32::MIN + phase, i32::MIN + phase);
        for extent in [(1 << 31) - 1, 1 << 31, (1 << 31) + 40_000, u32::MAX.into()] {
            at_the_corners_of_a_box(low, extent - i64::from(phase), extent - i64::from(phase));
            at_the_corners_of_a_box(low, extent - i64::from(phase), 40_000);
        }
        let high = origin(i32::MAX - 46_000 - phase, i32::MAX - 46_000 - phase);
        at_the_corners_of_a_box(high, 46_000, 46_000 + i64::from(phase));
    }
}

/// Triangles of 1 to 20 px a side at every corner of a window, so that cells and quarters of tiles
/// reach over its borders; and both winners of `paint` leave the same pixels.
#[test]
fn small_triangles_at_the_borders_are_exact() {
    let window = PixelRect { x0: 13, y0: -6, x1: 46, y1: 31 };
    let at = |x: i32, y: i32| SubpixelPoint::new(x, y);
    for side_px in 1..=20 {
        let side = side_px * 256 - 3;
        let mut list = Vec::new();
        for (x_px, y_px) in [(13, -6), (46, -6), (13, 31), (46, 31), (30, 12)] {
            for phase in [0, 77, 128, 200] {
                let (x, y) = (x_px * 256 - side / 2 + phase, y_px * 256 - side / 3 - phase);
                list.push([at(x, y), at(x + side, y + side / 4), at(x + side / 5, y + side)]);
                list.push([at(x, y), at(x, y + side), at(x + side, y + side)]);
            }
        }
        compare(&list, window);
        for engine in Tiles::levels() {
            let mut painted = Frame::new(window, 0);
            paint::fill(&engine, &list, 9, &mut painted);
            let mut truth = Frame::new(window, 0);
            for &corners in &list {
                Oracle.cover(corners, window, |span| {
                    truth.span_mut(span.y_px, span.x0_px, span.x1_px).fill(9);
                });
            }
            assert!(painted == truth, "{} in {}", side_px, engine.instructions());
        }
    }
}

/// Every pixel of the pieces and no other gets the colour, to the right border and the last row.
#[test]
fn paint_is_what_the_spans_are() {
    let window = PixelRect { x0: -5, y0: 2, x1: 70, y1: 61 };
    let family = FAMILIES.iter().find(|family| family.name == "partly-off").unwrap();
    for engine in Tiles::levels() {
        for index in 0..60 {
            let case = family.case(3, index);
            let Shape::Triangles { list, .. } = &case.shape else { unreachable!() };
            let list: Vec<Corners> = list.iter().map(|triangle| triangle.corners()).collect();
            let (hits, pieces) = tiles(&engine, &list, window);
            let mut painted = Frame::new(window, 0);
            engine.fill(&pieces, 9, &mut painted);
            for (y_px, row) in painted.rows() {
                for (x_px, &colour) in (window.x0..).zip(row) {
                    let hit = hits.iter().any(|hits| hits.get(x_px, y_px) != Some(0));
                    assert_eq!(colour, if hit { 9 } else { 0 }, "({x_px}, {y_px}) of {list:?}");
                }
            }
        }
    }
}

/// Nothing to do is nothing to take: empty lists, empty windows, windows elsewhere.
#[test]
fn nothing_is_handed_over_empty() {
    let corner = |x, y| SubpixelPoint::new(x, y);
    let list = [[corner(0, 0), corner(2560, 0), corner(0, 2560)]; 20];
    let elsewhere = PixelRect { x0: i32::MAX - 5, y0: 0, x1: i32::MAX, y1: 9 };
    let empty = PixelRect { x0: 4, y0: 4, x1: 4, y1: 9 };
    let inside_out = PixelRect { x0: 9, y0: 9, x1: i32::MIN, y1: 0 };
    let mut take = |_: &[Piece]| panic!("there is nothing to take");
    for engine in Tiles::levels() {
        engine.cover_list(&[], PixelRect::window(8, 8), &mut take);
        for window in [elsewhere, empty, inside_out] {
            engine.cover_list(&list, window, &mut take);
        }
    }
}
