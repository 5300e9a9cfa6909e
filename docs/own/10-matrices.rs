fn product(a: &Matrix, b: &Matrix) -> Matrix {
    let column = |j: usize| transform(a, [b[0][j], b[1][j], b[2][j], b[3][j]]);
    let columns = [0, 1, 2, 3].map(column);
    std::array::from_fn(|i| columns.map(|column| column[i]))
}

/// A turn about the y axis, then one about the x axis, then a move away from the eye.
fn pose(yaw: f64, pitch: f64, distance: f64) -> Matrix {
    let ((s, c), (t, d)) = (yaw.sin_cos(), pitch.sin_cos());
    let about_y = [[c, 0.0, s, 0.0], [0.0, 1.0, 0.0, 0.0], [-s, 0.0, c, 0.0], [0.0, 0.0, 0.0, 1.0]];
    let about_x = [[1.0, 0.0, 0.0, 0.0], [0.0, d, -t, 0.0], [0.0, t, d, 0.0], [0.0, 0.0, 0.0, 1.0]];
    let mut pose = product(&about_x, &about_y);
    pose[2][3] = distance;
    pose
}

/// Draws a cube of side 2: six faces, each with its normal and its texture coordinates.
fn draw_cube(canvas: &mut Canvas, pose: &Matrix, shade: &impl Fn([f64; 5]) -> Rgb<u8>) {
    for face in 0..6 {
        let (axis, end) = (face / 2, face % 2);
        let mut normal = [0.0; 4];
        normal[axis] = [-1.0, 1.0][end];
        let [nx, ny, nz, _] = transform(pose, normal);
        // The four corners of the face, clockwise as seen from outside.
        let (p, q) = (1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3));
        let around = if end == 1 { [0, p, p | q, q] } else { [0, q, p | q, p] };
        let vertices = around.map(|corner| {
            let [x, y, z] = cube_corner(corner | end << axis);
            let uv = [p, q].map(|bit| if corner & bit == 0 { 0.0 } else { 1.0 });
            Vertex {
                clip: transform(&perspective(), transform(pose, [x, y, z, 1.0])),
                values: [uv[0], uv[1], nx, ny, nz],
            }
        });
        for [a, b, c] in [[0, 1, 2], [0, 2, 3]] {
            draw(canvas, [vertices[a], vertices[b], vertices[c]], shade);
        }
    }
}

/// A cube, turned; its colours are its normals.
pub fn stage10() -> RgbImage {
    let mut canvas = Canvas::new();
    let shade = |[_, _, x, y, z]: [f64; 5]| colour([x, y, z].map(|part| (1.0 - part) / 2.0));
    draw_cube(&mut canvas, &pose(0.6, -0.5, 4.5), &shade);
    canvas.picture
}
