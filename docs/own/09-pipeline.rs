/// Draws a triangle: clip, divide, snap, leave out back faces, cover, interpolate, test, shade.
fn draw(canvas: &mut Canvas, triangle: [Vertex; 3], shade: &impl Fn([f64; 5]) -> Rgb<u8>) {
    let polygon = clip_near(&triangle);
    // A polygon with n corners is a fan of n - 2 triangles.
    for i in 2..polygon.len() {
        let corners = [polygon[0], polygon[i - 1], polygon[i]];
        let places = corners.map(|vertex| snap(place(vertex.clip)));
        if edge(places[0], places[1], places[2]) <= 0 {
            continue;
        }
        let w = corners.map(|vertex| vertex.clip[3]);
        cover(places, [0, 0, WIDTH, HEIGHT], |x, y, edges| {
            let window = weights(edges);
            let [depth] = mix(window, corners.map(|vertex| [vertex.clip[2] / vertex.clip[3]]));
            canvas.show(x, y, depth, || {
                shade(mix(in_space(window, w), corners.map(|vertex| vertex.values)))
            });
        });
    }
}

/// A floor that begins behind the eye, and a wall with its back to us, which is left out.
pub fn stage9() -> RgbImage {
    let mut canvas = Canvas::new();
    let vertex = |x: f64, y: f64, z: f64, u: f64, v: f64| Vertex {
        clip: transform(&perspective(), [x, y, z, 1.0]),
        values: [u, v, 0.0, 0.0, 0.0],
    };
    let floor = [
        vertex(-3.0, -1.0, -4.0, 0.0, 0.0),
        vertex(-3.0, -1.0, 12.0, 0.0, 1.0),
        vertex(3.0, -1.0, 12.0, 1.0, 1.0),
        vertex(3.0, -1.0, -4.0, 1.0, 0.0),
    ];
    let wall = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0)].map(|(x, y)| vertex(x, y, 6.0, 0.0, 0.0));
    let shade = |[u, v, ..]: [f64; 5]| colour(checker([u, v]));
    for [a, b, c] in [[0, 1, 2], [0, 2, 3]] {
        draw(&mut canvas, [floor[a], floor[b], floor[c]], &shade);
    }
    draw(&mut canvas, wall, &|_| Rgb([255; 3]));
    canvas.picture
}
