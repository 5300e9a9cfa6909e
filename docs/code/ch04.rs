fn main() {
    use glam::{DVec3, DVec4};
    use rasterproof::grid::PixelRect;
    use rasterproof_render::pipeline::ClipVertex;
    use rasterproof_render::pipeline::assemble::Viewport;
    use rasterproof_render::pipeline::transform::frustum;

    // A film from -1 to 1 at distance 1, and a window of 8 x 8 pixels.
    let projection = frustum(-1.0, 1.0, -1.0, 1.0, 1.0, 10.0).unwrap();
    let project = |p: DVec3| projection * p.extend(1.0);
    assert_eq!(project(DVec3::new(2.0, 1.0, 4.0)).w, 4.0);

    let place = |position: DVec4| {
        let vertex = ClipVertex { position, varying: () };
        Viewport::new(PixelRect::window(8, 8)).place(&vertex).unwrap().position
    };
    // x/z = 1/2 and y/z = 1/4: three quarters to the right, three eighths down (y points down there).
    let p = place(project(DVec3::new(2.0, 1.0, 4.0)));
    assert_eq!((p.x, p.y), (6 * 256, 3 * 256));
    // Any multiple of a homogeneous point is the same point.
    assert_eq!(place(project(DVec3::new(2.0, 1.0, 4.0)) * 3.0), p);

    // Halfway in space, from distance 2 to distance 6, is three quarters of the way on the film:
    // t' = 6 t / (2 + 4 t).
    let (near, far) = (DVec3::new(-2.0, 0.0, 2.0), DVec3::new(6.0, 0.0, 6.0));
    let [a, middle, b] = [near, (near + far) / 2.0, far].map(|p| place(project(p)).x as f64);
    assert_eq!((middle - a) / (b - a), 0.75);
}
