fn main() {
    use glam::DVec3;
    use rasterproof_render::pipeline::depth::DepthFormat;
    use rasterproof_render::pipeline::transform::frustum;

    let (near, far) = (0.1, 1000.0);
    let projection = frustum(-1.0, 1.0, -1.0, 1.0, near, far).unwrap();
    let depth = |z: f64| {
        let p = projection * DVec3::new(0.0, 0.0, z).extend(1.0);
        (p.z / p.w + 1.0) / 2.0
    };

    // Half of the range lies between n and 2n (here 1/20000 more, since f is not infinite).
    assert!((depth(2.0 * near) - 0.50005).abs() < 1e-8);

    // Where the k-th key after that of z = 990 begins, by bisection; eight steps, divided by eight.
    let gap = |format: DepthFormat| {
        let key = |z: f64| format.key(depth(z));
        let begins = |k: u64| {
            let (mut below, mut above) = (990.0, 1000.0);
            for _ in 0..100 {
                let middle = (below + above) / 2.0;
                *(if key(middle) >= key(990.0) + k { &mut above } else { &mut below }) = middle;
            }
            above
        };
        (begins(9) - begins(1)) / 8.0
    };
    let slope = |z: f64| far * near / ((far - near) * z * z);
    for (format, bits, measured) in [
        (DepthFormat::Unorm24, 24, 0.587),
        (DepthFormat::F32, 24, 0.587),
        (DepthFormat::Unorm32, 32, 0.00228),
        (DepthFormat::F32Reversed, 43, 1.11e-6),
        (DepthFormat::F64, 53, 1.07e-9),
    ] {
        let gap = gap(format);
        println!("{}: {gap:.3e}", format.name());
        assert!((gap / measured - 1.0).abs() < 0.01, "{}: {gap:e}", format.name());
        // In the middle of the eight steps; in f64 z/w itself is rounded by a step or so, hence 3%.
        let formula = 0.5f64.powi(bits) / slope(990.0 + 5.0 * gap);
        assert!((gap / formula - 1.0).abs() < 0.03, "{}: {gap:e}, {formula:e}", format.name());
    }
}
