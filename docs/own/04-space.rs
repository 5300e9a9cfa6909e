/// Four rows.
type Matrix = [[f64; 4]; 4];

fn transform(matrix: &Matrix, [x, y, z, w]: [f64; 4]) -> [f64; 4] {
    matrix.map(|[a, b, c, d]| a * x + b * y + c * z + d * w)
}

const NEAR: f64 = 1.0;
const FAR: f64 = 20.0;

/// The perspective projection of an eye at the origin that looks along z; w becomes the old z. The
/// picture shows what lies between -z / 2 and z / 2 above and below the eye.
fn perspective() -> Matrix {
    let (scale, span) = (2.0, FAR - NEAR);
    let aspect = WIDTH as f64 / HEIGHT as f64;
    [
        [scale / aspect, 0.0, 0.0, 0.0],
        [0.0, scale, 0.0, 0.0],
        [0.0, 0.0, (FAR + NEAR) / span, -2.0 * FAR * NEAR / span],
        [0.0, 0.0, 1.0, 0.0],
    ]
}

/// The place of a point of clip space in the window, in pixels: divided by w, then stretched.
fn place([x, y, _, w]: [f64; 4]) -> [f64; 2] {
    [(x / w + 1.0) / 2.0 * WIDTH as f64, (1.0 - y / w) / 2.0 * HEIGHT as f64]
}

/// The corners of a cube of side 2, as bits: x is bit 0, y bit 1, z bit 2.
fn cube_corner(number: usize) -> [f64; 3] {
    [0, 1, 2].map(|axis| if number >> axis & 1 == 1 { 1.0 } else { -1.0 })
}

/// The twelve edges of a cube, straight ahead.
pub fn stage4() -> RgbImage {
    let mut picture = empty();
    let pixel = |number| {
        let [x, y, z] = cube_corner(number);
        place(transform(&perspective(), [x + 0.5, y - 0.3, z + 4.0, 1.0]))
            .map(|px| px.floor() as i64)
    };
    for corner in 0..8 {
        for axis in (0..3).filter(|axis| corner >> axis & 1 == 0) {
            line(pixel(corner), pixel(corner | 1 << axis), |x, y| {
                set(&mut picture, x, y, Rgb([160, 230, 160]));
            });
        }
    }
    picture
}
