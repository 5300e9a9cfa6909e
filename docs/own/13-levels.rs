/// A square texture of grey texels, row by row.
type Texture = Vec<Vec<f64>>;

/// The next level: half as wide and half as high, with the means of four texels.
fn halved(texture: &Texture) -> Texture {
    let half = texture.len() / 2;
    let mean = |x: usize, y: usize| {
        let [upper, lower] = [&texture[2 * y], &texture[2 * y + 1]];
        (upper[2 * x] + upper[2 * x + 1] + lower[2 * x] + lower[2 * x + 1]) / 4.0
    };
    (0..half).map(|y| (0..half).map(|x| mean(x, y)).collect()).collect()
}

/// The nearest texel of a texture that repeats.
fn texel_at(texture: &Texture, uv: [f64; 2]) -> f64 {
    let size = texture.len();
    let [x, y] = uv.map(|part| ((part * size as f64).floor() as i64).rem_euclid(size as i64));
    texture[y as usize][x as usize]
}

/// What is read at a level between two: the nearest texel of both, mixed by the fraction.
fn read(levels: &[Texture], uv: [f64; 2], level: f64) -> f64 {
    let level = level.clamp(0.0, (levels.len() - 1) as f64);
    let near = texel_at(&levels[level.floor() as usize], uv);
    near + (texel_at(&levels[level.ceil() as usize], uv) - near) * level.fract()
}

/// Of the plane through three values at the corners: its value at a place, and how much it grows to the right and down.
fn plane([a, b, c]: [[f64; 2]; 3], f: [f64; 3], at: [f64; 2]) -> [f64; 3] {
    let [dx1, dy1, dx2, dy2] = [b[0] - a[0], b[1] - a[1], c[0] - a[0], c[1] - a[1]];
    let (df1, df2, area) = (f[1] - f[0], f[2] - f[0], dx1 * dy2 - dx2 * dy1);
    let (right, down) = ((df1 * dy2 - df2 * dy1) / area, (df2 * dx1 - df1 * dx2) / area);
    [f[0] + right * (at[0] - a[0]) + down * (at[1] - a[1]), right, down]
}

/// The level at a place: the logarithm of how many texels the texture moves by, from this pixel to the next one.
fn level(size: f64, places: [[f64; 2]; 3], w: [f64; 3], uvs: [[f64; 2]; 3], at: [f64; 2]) -> f64 {
    let over_w = |values: [f64; 3]| plane(places, [0, 1, 2].map(|i| values[i] / w[i]), at);
    let [q, u, v] = [[1.0; 3], uvs.map(|uv| uv[0]), uvs.map(|uv| uv[1])].map(over_w);
    let derivative = |f: [f64; 3], way: usize| (f[way] - f[0] / q[0] * q[way]) / q[0] * size;
    let steps = [1, 2].map(|way| derivative(u, way).hypot(derivative(v, way)));
    steps[0].max(steps[1]).log2()
}

/// A floor that goes far: on the left by the texture alone, on the right by its levels.
pub fn stage13() -> RgbImage {
    let mut picture = empty();
    let squares = |x, y| if (x / 4 + y / 4) % 2 == 0 { 0.9 } else { 0.2 };
    let mut levels: Vec<Texture> =
        vec![(0..32).map(|y| (0..32).map(|x| squares(x, y)).collect()).collect()];
    while levels[levels.len() - 1].len() > 1 {
        levels.push(halved(&levels[levels.len() - 1]));
    }
    let floor = [[-8.0, -1.0, 2.0], [8.0, -1.0, 2.0], [8.0, -1.0, 60.0], [-8.0, -1.0, 60.0]];
    let uvs = [[0.0, 0.0], [3.0, 0.0], [3.0, 11.0], [0.0, 11.0]];
    let clip = floor.map(|[x, y, z]| transform(&perspective(), [x, y, z, 1.0]));
    for corners in [[0, 1, 2], [0, 2, 3]] {
        let (places, w) = (corners.map(|i| place(clip[i])), corners.map(|i| clip[i][3]));
        let uvs = corners.map(|i| uvs[i]);
        cover(places.map(snap), [0, 0, WIDTH, HEIGHT], |x, y, edges| {
            let uv = mix(in_space(weights(edges), w), uvs);
            let at = [x as f64 + 0.5, y as f64 + 0.5];
            let level = if x < WIDTH / 2 { 0.0 } else { level(32.0, places, w, uvs, at) };
            set(&mut picture, x, y, colour([read(&levels, uv, level); 3]));
        });
    }
    picture
}
