fn main() {
    use rasterproof::contract::Rasterize;
    use rasterproof::grid::{PixelRect, SubpixelPoint};
    use rasterproof::raster::scanline::Scanline;
    use rasterproof_render::pipeline::multisample::masks;

    let p = |x, y| SubpixelPoint::from_px(x, y).unwrap();
    let window = PixelRect::window(8, 8);
    let mut answer = Vec::new();
    Scanline.cover([p(0.5, 0.5), p(5.5, 0.5), p(5.5, 5.5)], window, |s| {
        answer.push((s.y_px, s.x0_px, s.x1_px))
    });
    assert_eq!(answer, [(0, 0, 5), (1, 1, 5), (2, 2, 5), (3, 3, 5), (4, 4, 5)]);

    let masks =
        masks(&Scanline, [p(0.0, 0.0), p(2.0, 0.0), p(0.0, 2.0)], PixelRect::window(2, 1)).unwrap();
    assert_eq!([0, 1].map(|x| masks.get(x, 0).unwrap()), [15, 5]);
    assert!(SubpixelPoint::from_px(f64::NAN, 0.0).is_err());
}
