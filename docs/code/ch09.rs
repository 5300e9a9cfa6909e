fn main() {
    use glam::{DMat4, DVec3};
    use rasterproof::raster::edge_function::EdgeFunction;
    use rasterproof_render::pipeline::ClipVertex;
    use rasterproof_render::pipeline::assemble::Cull;
    use rasterproof_render::pipeline::draw::{DrawError, Renderer};
    use rasterproof_render::pipeline::target::{Antialias, Target, to_colour};
    use rasterproof_render::pipeline::transform::frustum;

    let projection = frustum(-0.8, 0.8, -0.6, 0.6, 1.0, 20.0).unwrap();
    let target = Target::new(64, 48, Antialias::None, Default::default()).unwrap();
    let mut renderer = Renderer::new(EdgeFunction, target);
    let quad = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let triangles = [[0, 1, 2], [0, 2, 3]];

    // The two stages of this picture: a wave, coloured by its height.
    let vertex = |&(x, y): &(f64, f64)| {
        let p = DVec3::new(x, y, 4.0 + x * y);
        ClipVertex { position: projection * DMat4::IDENTITY * p.extend(1.0), varying: p.z }
    };
    let fragment = |height: &f64| to_colour(DVec3::splat((height - 3.0) / 2.0));

    renderer.draw(&quad, &triangles, vertex, fragment).unwrap();
    let drawn = renderer.counters.fragments;
    assert!(drawn > 400 && renderer.counters.culled == 0);

    // Seen from in front they run counter-clockwise; leaving those out leaves nothing.
    renderer.clear([0, 0, 0, 255]);
    renderer.cull = Cull::CounterClockwise;
    renderer.draw(&quad, &triangles, vertex, fragment).unwrap();
    assert_eq!((renderer.counters.culled, renderer.counters.fragments), (2, drawn));

    // A triangle that names a vertex which is not there draws nothing at all.
    let error = renderer.draw(&quad, &[[0, 1, 4]], vertex, fragment).unwrap_err();
    assert_eq!(error, DrawError::Index { triangle: 0, index: 4 });
}
