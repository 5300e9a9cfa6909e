fn main() {
    use rasterproof::contract::Rasterize;
    use rasterproof::frame::Coverage;
    use rasterproof::grid::{PixelRect, SubpixelPoint};
    use rasterproof::oracle::Oracle;
    use rasterproof::raster::edge_function::EdgeFunction;
    use rasterproof::raster::scanline::Scanline;

    fn draw(engine: &impl Rasterize, triangles: &[[(f64, f64); 3]]) -> Coverage {
        let window = PixelRect::window(8, 8);
        let mut hits = Coverage::new(window, 0);
        for corners in triangles {
            let corners = corners.map(|(x, y)| SubpixelPoint::from_px(x, y).unwrap());
            engine.cover(corners, window, |span| hits.hit(span.y_px, span.x0_px, span.x1_px));
        }
        hits
    }

    // T8: the square 0..4, split. The diagonal runs through four centres; each belongs to one half.
    let square = [[(0.0, 0.0), (4.0, 0.0), (4.0, 4.0)], [(0.0, 0.0), (4.0, 4.0), (0.0, 4.0)]];
    let hits = draw(&Scanline, &square);
    assert_eq!(hits.covered(), 16);
    assert!(hits.rows().all(|(_, row)| row.iter().all(|&n| n <= 1)));
    assert_eq!(hits, draw(&EdgeFunction, &square));
    assert_eq!(hits, draw(&Oracle, &square));

    // The published tests on the same square: strict leaves 4 holes, inclusive draws 4 pixels twice.
    let (mut strict, mut inclusive) = (0, 0);
    for (x, y) in (0..16).map(|i| (f64::from(i % 4) + 0.5, f64::from(i / 4) + 0.5)) {
        for [a, b, c] in square {
            let e = [(a, b), (b, c), (c, a)]
                .map(|((ax, ay), (bx, by))| (bx - ax) * (y - ay) - (by - ay) * (x - ax));
            strict += i32::from(e.iter().all(|&e| e > 0.0));
            inclusive += i32::from(e.iter().all(|&e| e >= 0.0));
        }
    }
    assert_eq!((strict, inclusive), (12, 20));
}
