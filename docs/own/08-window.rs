/// How far a point of clip space lies inside the six borders of the view volume; negative beyond one of them.
fn borders([x, y, z, w]: [f64; 4]) -> [f64; 6] {
    [w + x, w - x, w + y, w - y, w + z, w - z]
}

/// The place in a window x0, y0, x1, y1 of the picture, in pixels, and the depth from 0 to 1.
fn in_window([x, y, z, w]: [f64; 4], [x0, y0, x1, y1]: [f64; 4]) -> [f64; 3] {
    let across = x0 + (x / w + 1.0) / 2.0 * (x1 - x0);
    let down = y0 + (1.0 - y / w) / 2.0 * (y1 - y0);
    [across, down, (z / w + 1.0) / 2.0]
}

/// Points in rows, columns and layers, seen in two windows. What is outside the view volume is left out, and what is far is dark.
pub fn stage8() -> RgbImage {
    let mut picture = empty();
    for window in [[5.0, 5.0, 65.0, 115.0], [75.0, 30.0, 155.0, 90.0]] {
        for i in 0..1000 {
            let [layer, row, column] = [i / 100, i / 10 % 10, i % 10].map(f64::from);
            let point = [0.9 * (column - 4.5), 0.9 * (row - 4.5), 19.5 - 2.0 * layer, 1.0];
            let clip = transform(&perspective(), point);
            if borders(clip).iter().any(|distance| *distance < 0.0) {
                continue;
            }
            let [x, y, depth] = in_window(clip, window);
            let light = (90.0 + 900.0 * (1.0 - depth)).min(255.0) as u8;
            set(&mut picture, x.floor() as i64, y.floor() as i64, Rgb([light, light, 90]));
        }
    }
    picture
}
