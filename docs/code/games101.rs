fn main() {
    use rasterproof::grid::{PixelRect, SubpixelPoint};
    use rasterproof::raster::edge_function::EdgeFunction;
    use rasterproof::raster::scanline::Scanline;
    use rasterproof_render::pipeline::Counters;
    use rasterproof_render::pipeline::depth::DepthFormat;
    use rasterproof_render::pipeline::multisample::masks;
    use rasterproof_render::pipeline::target::{Antialias, Target};

    // The upper left half of pixel (0, 0) holds samples 0 and 2; the lower right half the other two.
    let p = |x, y| SubpixelPoint::new(x * 256, y * 256);
    let window = PixelRect::window(1, 1);
    let mask = |corners| masks(&Scanline, corners, window).unwrap().get(0, 0).unwrap();
    assert_eq!(mask([p(0, 0), p(1, 0), p(0, 1)]), 0b0101);
    assert_eq!(mask([p(1, 0), p(1, 1), p(0, 1)]), 0b1010);
    let other = masks(&EdgeFunction, [p(0, 0), p(1, 0), p(0, 1)], window).unwrap();
    assert_eq!(other.get(0, 0), Some(0b0101));

    // A quarter green, three quarters blue: one average, after both.
    let (green, blue) = ([0, 255, 0, 255], [0, 0, 255, 255]);
    let mut target = Target::new(1, 1, Antialias::Supersample(2), DepthFormat::Unorm32).unwrap();
    target.clear_colour([0, 0, 0, 255], &mut Counters::default());
    for (x, y) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
        let (depth, colour) = if (x, y) == (0, 0) { (0.3, green) } else { (0.7, blue) };
        let key = target.format.key(depth);
        assert!(target.planes[0].test_and_write(x, y, key, || colour));
    }
    assert_eq!(target.resolve().get(0, 0), Some([0, 64, 191, 255]));
    // Behind what is there: nothing is drawn, and the colour is not even asked for.
    let far = target.format.key(0.9);
    assert!(!target.planes[0].test_and_write(1, 1, far, || unreachable!()));
}
