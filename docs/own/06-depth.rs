/// A picture, and for each pixel the depth of what it shows.
struct Canvas {
    picture: RgbImage,
    depths: Vec<f64>,
}

impl Canvas {
    fn new() -> Self {
        Self { picture: empty(), depths: vec![f64::INFINITY; (WIDTH * HEIGHT) as usize] }
    }

    /// Shows a fragment if it is nearer than what is there.
    fn show(&mut self, x: i64, y: i64, depth: f64, colour: impl FnOnce() -> Rgb<u8>) {
        let stored = &mut self.depths[(y * WIDTH + x) as usize];
        if depth < *stored {
            *stored = depth;
            set(&mut self.picture, x, y, colour());
        }
    }
}

/// Two triangles that pass through each other. Depth is linear in the window, so it needs no 1/w.
pub fn stage6() -> RgbImage {
    let mut canvas = Canvas::new();
    let triangles = [
        ([[10, 20], [150, 60], [10, 100]], [0.2, 0.8, 0.2], [0.9, 0.5, 0.2]),
        ([[150, 20], [10, 60], [150, 100]], [0.2, 0.8, 0.2], [0.3, 0.6, 0.9]),
    ];
    for (corners, depths, paint) in triangles {
        let corners = corners.map(|corner| corner.map(|px| px * STEPS));
        cover(corners, [0, 0, WIDTH, HEIGHT], |x, y, edges| {
            let [depth] = mix(weights(edges), depths.map(|depth| [depth]));
            canvas.show(x, y, depth, || colour(paint));
        });
    }
    canvas.picture
}
