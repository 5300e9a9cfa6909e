fn main() {
    use glam::{DVec3, DVec4};
    use rasterproof::contract::Rasterize;
    use rasterproof::grid::PixelRect;
    use rasterproof::raster::scanline::Scanline;
    use rasterproof_render::pipeline::ClipVertex;
    use rasterproof_render::pipeline::assemble::Viewport;
    use rasterproof_render::pipeline::clip::{ClipPlane, Outcode, clip, outcode};
    use rasterproof_render::pipeline::transform::frustum;

    // The scene of the lesson: each of the six planes has a corner outside, and nine corners are left.
    let projection = frustum(-0.8, 0.8, -0.6, 0.6, 1.0, 20.0).unwrap();
    let triangle = [[7.4, 12.0, 24.5], [10.3, -11.3, 4.2], [-2.9, 2.1, 0.3]]
        .map(|p| ClipVertex { position: projection * DVec3::from(p).extend(1.0), varying: 0.0 });
    let outside = triangle.iter().map(outcode).fold(0, |a, b| a | b);
    assert_eq!(
        outside,
        (Outcode::MAX >> 1) & !ClipPlane::MinW.bit(),
        "w stays positive: all but one"
    );
    assert_eq!(clip(&triangle, outside).0.vertices().count(), 9);

    // A square over the whole screen covers every pixel once: 4 x 3 of them.
    let window = PixelRect::window(4, 3);
    let at = |x, y| {
        let vertex = ClipVertex { position: DVec4::new(x, y, 0.0, 1.0), varying: 0.0 };
        Viewport::new(window).place(&vertex).unwrap().position
    };
    let [a, b, c, d] = [at(-1.0, -1.0), at(1.0, -1.0), at(1.0, 1.0), at(-1.0, 1.0)];
    let mut covered = 0;
    for corners in [[a, b, c], [a, c, d]] {
        Scanline.cover(corners, window, |span| covered += span.x1_px - span.x0_px);
    }
    assert_eq!(covered, 12);

    // Dividing first: this corner is behind the eye and looks as if it were in the middle of the cube.
    let behind = ClipVertex { position: DVec4::new(0.5, 0.5, 0.5, -2.0), varying: 0.0 };
    assert!((behind.position / behind.position.w).truncate().abs().max_element() < 1.0);
    assert_ne!(outcode(&behind) & ClipPlane::MinW.bit(), 0);
}
