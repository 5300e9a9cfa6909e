fn main() {
    use rasterproof::contract::Interpolate;
    use rasterproof::grid::PixelRect;
    use rasterproof::raster::edge_function::EdgeFunction;
    use rasterproof::raster::scanline::Scanline;
    use rasterproof::triangle::{Fragment, ScreenTriangle, ScreenVertex};

    fn pixels(engine: &impl Interpolate, w_right: f64) -> Vec<Fragment<f64>> {
        let vertex = |x_px, y_px, w, value| ScreenVertex::new(x_px, y_px, value, w, value).unwrap();
        let vertices = [
            vertex(0.5, 0.5, 1.0, 0.0),
            vertex(6.5, 0.5, w_right, 1.0),
            vertex(0.5, 6.5, 1.0, 0.0),
        ];
        let mut list = Vec::new();
        engine.fragments(&ScreenTriangle { vertices }, PixelRect::window(8, 8), |f| list.push(f));
        list
    }

    // Depth and varying are 0, 1 and 0 at the corners. Two thirds along the upper edge, R = 4: the
    // depth is 2/3, the varying 1/3. The difference is the bound (sqrt R - 1)/(sqrt R + 1), attained.
    for list in [pixels(&EdgeFunction, 4.0), pixels(&Scanline, 4.0)] {
        let f = list.iter().find(|f| (f.x_px, f.y_px) == (4, 0)).unwrap();
        assert!((f.depth - 2.0 / 3.0).abs() < 1e-15 && (f.varying - 1.0 / 3.0).abs() < 1e-15);
        let r = 4.0f64;
        let bound = (r.sqrt() - 1.0) / (r.sqrt() + 1.0);
        assert!(list.iter().all(|f| (f.depth - f.varying).abs() <= bound + 1e-15));
    }

    // Equal w: the varying has the same bits as the depth, which is affine.
    assert!(pixels(&EdgeFunction, 1.0).iter().all(|f| f.varying.to_bits() == f.depth.to_bits()));

    // The book's formula (8) in f32 at t' = 1, where the value is v_b = 1: R = 10^7 gives 0.8.
    let (wa, wb, va, vb, t) = (0.1f32, 1e6f32, 0.0f32, 1.0f32, 1.0f32);
    let value = (wb * va + (wa * vb - wb * va) * t) / (wb + (wa - wb) * t);
    assert!((value - 0.8).abs() < 1e-6);
}
