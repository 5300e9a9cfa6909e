fn main() {
    use glam::DVec3;
    use rasterproof::contract::Interpolate;
    use rasterproof::grid::PixelRect;
    use rasterproof::oracle::values::ExactTriangle;
    use rasterproof::raster::edge_function::EdgeFunction;
    use rasterproof::raster::scanline::Scanline;
    use rasterproof::triangle::{ScreenTriangle, ScreenVertex};

    // Red, green and blue at the corners: the colour of a pixel is its three weights. Depth is constant.
    let vertex = |x_px, y_px, colour| ScreenVertex::new(x_px, y_px, 0.1, 1.0, colour).unwrap();
    let vertices =
        [vertex(1.0, 0.5, DVec3::X), vertex(14.25, 3.0, DVec3::Y), vertex(4.0, 15.0, DVec3::Z)];
    let triangle = ScreenTriangle { vertices };
    let exact = ExactTriangle::new(
        &triangle.corners(),
        vertices.map(|v| v.depth),
        vertices.map(|v| v.inv_w),
        vertices.map(|v| v.varying.to_array()),
    )
    .unwrap();

    // D = M = 1 for each colour.
    let (u, window) = (f64::EPSILON / 2.0, PixelRect::window(16, 16));
    let mut pixels = [0, 0];
    EdgeFunction.fragments(&triangle, window, |f| {
        let (_, weights) = exact.at(f.x_px, f.y_px);
        for k in 0..3 {
            assert!(weights[k].distance(f.varying[k]) <= u * (13.0 + 1.0));
        }
        assert_eq!(f.depth, 0.1, "a constant stays exact");
        pixels[0] += 1;
    });
    Scanline.fragments(&triangle, window, |f| {
        let (_, weights) = exact.at(f.x_px, f.y_px);
        for k in 0..3 {
            assert!(weights[k].distance(f.varying[k]) <= u * (15.0 + 2.0));
        }
        assert_eq!(f.depth, 0.1);
        pixels[1] += 1;
    });
    assert_eq!(pixels[0], pixels[1]);

    // The textbook sum does not keep a constant: here the weights are 1/5, 2/5 and 2/5.
    let sum: f64 = [1.0, 2.0, 2.0].iter().map(|e| e / 5.0 * 0.1).sum();
    assert_eq!(sum, 0.10000000000000002);
}
