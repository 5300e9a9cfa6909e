/// A corner on its way: where it is in clip space, and five values: texture u, v and the normal.
#[derive(Clone, Copy)]
pub struct Vertex {
    clip: [f64; 4],
    values: [f64; 5],
}

/// How far a vertex lies beyond the near plane; negative on the side of the eye.
fn beyond_near(vertex: &Vertex) -> f64 {
    vertex.clip[2] + vertex.clip[3]
}

/// The part of a polygon beyond the near plane, where every w is positive.
fn clip_near(polygon: &[Vertex]) -> Vec<Vertex> {
    let mut kept = Vec::new();
    for (i, &to) in polygon.iter().enumerate() {
        let from = polygon[(i + polygon.len() - 1) % polygon.len()];
        let (a, b) = (beyond_near(&from), beyond_near(&to));
        if (a < 0.0) != (b < 0.0) {
            // Always cut from the inner end to the outer one: the neighbour cuts at the same point.
            let (inner, outer, a, b) = if a < 0.0 { (to, from, b, a) } else { (from, to, a, b) };
            let t = a / (a - b);
            let cut = |p: f64, q: f64| p + t * (q - p);
            kept.push(Vertex {
                clip: std::array::from_fn(|i| cut(inner.clip[i], outer.clip[i])),
                values: std::array::from_fn(|i| cut(inner.values[i], outer.values[i])),
            });
        }
        if b >= 0.0 {
            kept.push(to);
        }
    }
    kept
}

/// The outline of a floor that begins behind the eye, as far as it can be seen.
pub fn stage7() -> RgbImage {
    let mut picture = empty();
    let floor = [[-0.6, -0.4, -4.0], [-0.6, -0.4, 12.0], [0.6, -0.4, 12.0], [0.6, -0.4, -4.0]];
    let polygon = clip_near(&floor.map(|[x, y, z]| Vertex {
        clip: transform(&perspective(), [x, y, z, 1.0]),
        values: [0.0; 5],
    }));
    let pixels: Vec<_> =
        polygon.iter().map(|vertex| place(vertex.clip).map(|px| px.floor() as i64)).collect();
    for i in 0..pixels.len() {
        line(pixels[i], pixels[(i + 1) % pixels.len()], |x, y| {
            set(&mut picture, x, y, Rgb([230, 180, 120]));
        });
    }
    picture
}
