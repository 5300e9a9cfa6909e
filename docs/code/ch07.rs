fn main() {
    use glam::DVec4;
    use rasterproof_render::pipeline::ClipVertex;
    use rasterproof_render::pipeline::clip::{ClipPlane, MOST_VERTICES, Outcode, clip, outcode};

    let vertex = |x, y, z, w, varying| ClipVertex { position: DVec4::new(x, y, z, w), varying };
    let a = vertex(0.0, 0.5, 0.0, 1.0, 0.0);
    let b = vertex(0.5, 0.0, 0.0, 1.0, 0.0);
    let behind = vertex(0.0, 0.0, -3.0, 1.0, 1.0);
    assert_eq!(outcode(&behind), ClipPlane::Near.bit());

    // z goes from 0 to -3 and the plane is z = -w = -1: a third of the way, for the varying too.
    let (polygon, _) = clip(&[a, b, behind], ClipPlane::Near.bit());
    let kept: Vec<_> = polygon.vertices().collect();
    assert_eq!(kept.len(), 4);
    assert_eq!((kept[2].position.z, kept[2].varying), (-1.0, 1.0 / 3.0));

    // The neighbour across the edge from b to `behind` runs the other way and gets the same bits.
    let (neighbour, _) = clip(&[behind, b, vertex(2.0, 3.0, 0.5, 4.0, 9.0)], Outcode::MAX);
    assert!(neighbour.vertices().any(|v| v == kept[2]));

    // Asking borders that nobody is outside of changes nothing.
    let (all, _) = clip(&[a, b, behind], Outcode::MAX);
    assert!(all.vertices().eq(polygon.vertices()));
    assert_eq!(MOST_VERTICES, 10);
}
