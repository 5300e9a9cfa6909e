fn main() {
    use rasterproof::contract::RasterizeExact;
    use rasterproof::grid::PixelRect;
    use rasterproof::raster::edge_function_exact::EdgeFunctionExact;
    use rasterproof::raster::scanline_exact::ScanlineExact;
    use rasterproof::triangle::{FreeCorners, Span};

    fn pixels(engine: &impl RasterizeExact, corners: [[f64; 2]; 3]) -> (i32, u64) {
        let corners = FreeCorners::new(corners).unwrap();
        let mut count = 0;
        let decisions = engine
            .cover_exact(&corners, PixelRect::window(4, 4), |s: Span| count += s.x1_px - s.x0_px);
        (count, decisions.by_fallback)
    }

    // The diagonal goes through the centres of four pixels, and the smallest f64 moves it off them.
    let diagonal = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0]];
    let moved = [[f64::from_bits(1), 0.0], [4.0, 0.0], [4.0, 4.0]];
    assert_eq!(pixels(&ScanlineExact, diagonal), (10, 4));
    assert_eq!(pixels(&ScanlineExact, moved), (6, 4));
    assert_eq!(pixels(&EdgeFunctionExact, diagonal).0, 10);
    assert_eq!(pixels(&EdgeFunctionExact, moved).0, 6);
}
