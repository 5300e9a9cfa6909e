/// Corners lie on a grid of 256 steps to a pixel.
const STEPS: i64 = 256;

/// The edge function: positive where p lies on the inner side of the edge from a to b.
fn edge(a: [i64; 2], b: [i64; 2], p: [i64; 2]) -> i128 {
    let product = |x: i64, y: i64| i128::from(x) * i128::from(y);
    product(b[0] - a[0], p[1] - a[1]) - product(b[1] - a[1], p[0] - a[0])
}

/// Whether a sample exactly on the edge from a to b belongs to the triangle: on top and left edges.
fn keeps(a: [i64; 2], b: [i64; 2]) -> bool {
    b[1] < a[1] || b[1] == a[1] && b[0] > a[0]
}

/// Every pixel of the window x0, y0, x1, y1 that a triangle covers, with the three edge functions at its
/// centre: the one at place i belongs to the edge opposite corner i.
pub fn cover(
    corners: [[i64; 2]; 3],
    [x0, y0, x1, y1]: [i64; 4],
    mut emit: impl FnMut(i64, i64, [i128; 3]),
) {
    let [a, mut b, mut c] = corners;
    let area = edge(a, b, c);
    if area == 0 {
        return;
    }
    if area < 0 {
        (b, c) = (c, b);
    }
    let low = |i: usize| a[i].min(b[i]).min(c[i]).div_euclid(STEPS);
    let high = |i: usize| a[i].max(b[i]).max(c[i]).div_euclid(STEPS) + 1;
    for y in y0.max(low(1))..y1.min(high(1)) {
        for x in x0.max(low(0))..x1.min(high(0)) {
            let p = [x * STEPS + STEPS / 2, y * STEPS + STEPS / 2];
            let inside = [(b, c), (c, a), (a, b)].map(|(from, to)| {
                let value = edge(from, to, p);
                (value, value > 0 || value == 0 && keeps(from, to))
            });
            if inside.iter().all(|(_, inside)| *inside) {
                let [u, v, w] = inside.map(|(value, _)| value);
                emit(x, y, if area < 0 { [u, w, v] } else { [u, v, w] });
            }
        }
    }
}

/// Triangle i of a fan of twelve around a point, and its colour.
fn blade(i: usize) -> ([[i64; 2]; 3], Rgb<u8>) {
    let rim = |i: usize| {
        let angle = i as f64 * std::f64::consts::TAU / 12.0;
        let place = |centre: f64, part: f64| ((centre + 50.0 * part) * STEPS as f64).round() as i64;
        [place(80.5, angle.cos()), place(60.5, angle.sin())]
    };
    let centre = [80 * STEPS + STEPS / 2, 60 * STEPS + STEPS / 2];
    let colour = Rgb([60 + 15 * i as u8, 220 - 15 * i as u8, 90 + 60 * (i as u8 % 2)]);
    ([centre, rim(i), rim(i + 1)], colour)
}

/// Sets a pixel, white if it was set before.
fn set_once(picture: &mut RgbImage, x: i64, y: i64, colour: Rgb<u8>) {
    let is_second = *picture.get_pixel(x as u32, y as u32) != BACKGROUND;
    set(picture, x, y, if is_second { Rgb([255; 3]) } else { colour });
}

/// A fan of twelve triangles. A pixel that two of them cover would be white.
pub fn stage2b() -> RgbImage {
    let mut picture = empty();
    for (corners, colour) in (0..12).map(blade) {
        cover(corners, [0, 0, WIDTH, HEIGHT], |x, y, _| set_once(&mut picture, x, y, colour));
    }
    picture
}
