//! What a formula gives to those who believe something else: in floats, as a student computes it.

use rasterproof_verify::oracle::formula::Formula;

/// The numbers that a misconception leads to; nothing where it says nothing.
pub(super) type Wrong = fn(&[f64]) -> Option<Vec<f64>>;

/// What a right program computes, changed afterwards.
fn right(formula: Formula, numbers: &[f64]) -> Option<Vec<f64>> {
    Some(formula.of(numbers)?.iter().map(|given| given.exact.to_f64()).collect())
}

pub(super) const UNDIVIDED: [Wrong; 2] = [
    |numbers| project(numbers, |n, [x, y, z]| [n * x, n * y, z]),
    |numbers| project(numbers, |_, point| point),
];
pub(super) const FILM_FORGOTTEN: [Wrong; 1] =
    [|numbers| project(numbers, |_, [x, y, z]| [x / z, y / z, z])];
pub(super) const BY_DISTANCE: [Wrong; 2] = [
    |numbers| project(numbers, |n, point| by(n, point, point[2])),
    |numbers| project(numbers, |n, point| by(n, point, length(point))),
];
pub(super) const W_LOST: [Wrong; 1] =
    [|numbers| project(numbers, |n, [x, y, z]| [n * x / z, n * y / z, 1.0])];

fn project(numbers: &[f64], of: fn(f64, [f64; 3]) -> [f64; 3]) -> Option<Vec<f64>> {
    let &[n, x, y, z] = numbers else { return None };
    Some(of(n, [x, y, z]).to_vec())
}

/// Divided by the length of the way from the eye, with this w.
fn by(n: f64, [x, y, z]: [f64; 3], w: f64) -> [f64; 3] {
    let far = length([x, y, z]);
    [n * x / far, n * y / far, w]
}

fn length(vector: [f64; 3]) -> f64 {
    dot(vector, vector).sqrt()
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) const SIZE_LESS_1: [Wrong; 1] = [|numbers| {
    let mut numbers = numbers.to_vec();
    numbers[0] -= 1.0;
    numbers[1] -= 1.0;
    window(&numbers, |place| place)
}];
pub(super) const Y_NOT_TURNED: [Wrong; 1] = [|numbers| {
    let height = *numbers.get(1)?;
    Some(
        window(numbers, |place| place)?
            .into_iter()
            .zip(0..)
            .map(|(v, i)| if i == 1 { height - v } else { v })
            .collect(),
    )
}];
pub(super) const DEPTH_NOT_HALVED: [Wrong; 1] =
    [|numbers| window(numbers, |[x, y, d]| [x, y, 2.0 * d - 1.0])];
pub(super) const LINEAR_DEPTH: [Wrong; 1] = [|numbers| {
    let &[_, _, n, f, _, _, z] = numbers else { return None };
    let mut place = window(numbers, |place| place)?;
    place[2] = (z - n) / (f - n);
    Some(place)
}];
pub(super) const FILM_AT_1: [Wrong; 1] = [|numbers| {
    let n = *numbers.get(2)?;
    let mut moved = numbers.to_vec();
    moved[4] /= n;
    moved[5] /= n;
    window(&moved, |place| place)
}];

fn window(numbers: &[f64], of: fn([f64; 3]) -> [f64; 3]) -> Option<Vec<f64>> {
    let &[width, height, n, f, x, y, z] = numbers else { return None };
    let x_px = (n * x / z + 1.0) / 2.0 * width;
    let y_px = (1.0 - n * y / z) / 2.0 * height;
    let depth = (((f + n) * z - 2.0 * n * f) / (f - n) / z + 1.0) / 2.0;
    Some(of([x_px, y_px, depth]).to_vec())
}

pub(super) const UNSNAPPED: [Wrong; 1] = [|numbers| Some(vec![sign(twice_area(numbers)?, 0.0)])];
pub(super) const WINDING_Y_UP: [Wrong; 1] =
    [|numbers| Some(right(Formula::Winding, numbers)?.iter().map(|sign| 0.0 - sign).collect())];
pub(super) const AREA_THRESHOLD: [Wrong; 6] = [
    |numbers| Some(vec![sign(twice_area(&snapped(numbers))?, 1e-4)]),
    |numbers| Some(vec![sign(twice_area(&snapped(numbers))?, 1e-3)]),
    |numbers| Some(vec![sign(twice_area(&snapped(numbers))?, 1e-2)]),
    |numbers| Some(vec![sign(twice_area(numbers)?, 1e-4)]),
    |numbers| Some(vec![sign(twice_area(numbers)?, 1e-3)]),
    |numbers| Some(vec![sign(twice_area(numbers)?, 1e-2)]),
];
pub(super) const AREA_RETURNED: [Wrong; 3] = [
    |numbers| Some(vec![twice_area(numbers)?]),
    |numbers| Some(vec![twice_area(&snapped(numbers))?]),
    |numbers| Some(vec![twice_area(&snapped(numbers))? * 65536.0]),
];

fn snapped(numbers: &[f64]) -> Vec<f64> {
    numbers.iter().map(|px| (px * 256.0).round() / 256.0).collect()
}

fn twice_area(numbers: &[f64]) -> Option<f64> {
    let &[ax, ay, bx, by, cx, cy] = numbers else { return None };
    Some((bx - ax) * (cy - ay) - (by - ay) * (cx - ax))
}

/// 1, -1, or 0 for what is not larger than a threshold.
fn sign(area: f64, threshold: f64) -> f64 {
    if area.abs() > threshold { area.signum() } else { 0.0 }
}

pub(super) const TURNED_BACK: [Wrong; 1] = [|numbers| turned(numbers, |_| -1.0, 1.0)];
pub(super) const ABOUT_Y_BACK: [Wrong; 1] =
    [|numbers| turned(numbers, |axis| if axis == 1.0 { -1.0 } else { 1.0 }, 1.0)];
pub(super) const ABOUT_ORIGIN: [Wrong; 1] = [|numbers| turned(numbers, |_| 1.0, 0.0)];
pub(super) const CENTRE_BACK: [Wrong; 1] = [|numbers| turned(numbers, |_| 1.0, -1.0)];
pub(super) const NOT_MOVED_BACK: [Wrong; 1] = [|numbers| {
    let mut point = turned(numbers, |_| 1.0, 1.0)?;
    point.iter_mut().zip(&numbers[3..]).for_each(|(part, centre)| *part -= centre);
    Some(point)
}];

/// The turn with the sine and the centre multiplied.
fn turned(numbers: &[f64], sine: fn(f64) -> f64, centre: f64) -> Option<Vec<f64>> {
    let mut numbers = numbers.to_vec();
    numbers[2] *= sine(*numbers.first()?);
    numbers[3..6].iter_mut().for_each(|part| *part *= centre);
    right(Formula::Turn, &numbers)
}

type Rows = [[f64; 3]; 3];

pub(super) const NORMAL_AS_POINT: [Wrong; 1] = [|numbers| moved(numbers, Some)];
pub(super) const TRANSPOSED_ALONE: [Wrong; 1] =
    [|numbers| moved(numbers, |rows| Some(transposed(rows)))];
pub(super) const INVERTED_ALONE: [Wrong; 1] =
    [|numbers| moved(numbers, |rows| inverse_transposed(rows).map(transposed))];

/// The normal, multiplied with what is made of the matrix.
fn moved(numbers: &[f64], matrix: fn(Rows) -> Option<Rows>) -> Option<Vec<f64>> {
    let row = |i: usize| <[f64; 3]>::try_from(numbers.get(3 * i..3 * i + 3)?).ok();
    let normal = row(3)?;
    Some(matrix([row(0)?, row(1)?, row(2)?])?.map(|row| dot(row, normal)).to_vec())
}

fn transposed(rows: Rows) -> Rows {
    [0, 1, 2].map(|j| [0, 1, 2].map(|i: usize| rows[i][j]))
}

fn inverse_transposed(rows: Rows) -> Option<Rows> {
    let numbers = rows.as_flattened();
    let column = |normal: [f64; 3]| {
        <[f64; 3]>::try_from(right(Formula::Normal, &[numbers, &normal].concat())?).ok()
    };
    let columns = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    Some(transposed([column(columns[0])?, column(columns[1])?, column(columns[2])?]))
}

pub(super) const DARK_LIGHT: [Wrong; 2] = [
    |numbers| lit(numbers, |cosine, _, [a, k]| a + k * cosine),
    |numbers| lit(numbers, |cosine, _, [a, k]| (a + k * cosine).max(0.0)),
];
pub(super) const LIT_BEHIND: [Wrong; 1] =
    [|numbers| lit(numbers, |cosine, _, [a, k]| a + k * cosine.abs())];
pub(super) const LONG_NORMAL: [Wrong; 2] = [
    |numbers| lit(numbers, |_, dot, [a, k]| a + k * dot.max(0.0)),
    |numbers| lit(numbers, |_, dot, [a, k]| a + k * dot.clamp(0.0, 1.0)),
];

/// By the cosine between normal and light, and their dot product; a normal of length 0 has a cosine of 0.
fn lit(numbers: &[f64], of: fn(f64, f64, [f64; 2]) -> f64) -> Option<Vec<f64>> {
    let &[n0, n1, n2, l0, l1, l2, a, k] = numbers else { return None };
    let (normal, light) = ([n0, n1, n2], [l0, l1, l2]);
    let product = dot(normal, light);
    let cosine = if length(normal) > 0.0 { product / length(normal) } else { 0.0 };
    Some(vec![of(cosine, product, [a, k])])
}

pub(super) const TEXEL_CORNERS: [Wrong; 1] = [|numbers| read(numbers, |u, n| u * n, 0.0, repeat)];
pub(super) const CLAMPED: [Wrong; 1] = [|numbers| read(numbers, |u, n| u * n, 0.5, clamp)];
pub(super) const TEXELS_LESS_1: [Wrong; 2] = [
    |numbers| read(numbers, |u, n| u * (n - 1.0), 0.5, repeat),
    |numbers| read(numbers, |u, n| u * (n - 1.0), 0.0, repeat),
];

/// Nearest and bilinear at a place, where a texel has its value so far from its left border.
fn read(
    numbers: &[f64],
    place: fn(f64, f64) -> f64,
    middle: f64,
    at: fn(f64, usize) -> usize,
) -> Option<Vec<f64>> {
    let (&u, texels) = numbers.split_first()?;
    let place = place(u, texels.len() as f64);
    let texel = |index: f64| texels[at(index, texels.len())];
    let left = (place - middle).floor();
    let share = place - middle - left;
    let mixed = texel(left) + (texel(left + 1.0) - texel(left)) * share;
    Some(vec![texel(place.floor()), mixed])
}

fn repeat(index: f64, count: usize) -> usize {
    index.rem_euclid(count as f64) as usize
}

fn clamp(index: f64, count: usize) -> usize {
    index.clamp(0.0, count as f64 - 1.0) as usize
}

pub(super) const LEVEL_IN_WINDOW: [Wrong; 1] = [|numbers| {
    let mut flat = numbers.to_vec();
    // Without w, u and v change evenly in the window.
    [4, 9, 14].iter().for_each(|w| flat[*w] = 1.0);
    right(Formula::Level, &flat)
}];
pub(super) const ONE_DIRECTION: [Wrong; 2] =
    [|numbers| level_of(steps(numbers)?[0]), |numbers| level_of(steps(numbers)?[1])];
pub(super) const SHORTER_DIRECTION: [Wrong; 2] = [
    |numbers| level_of(steps(numbers)?.into_iter().fold(f64::INFINITY, f64::min)),
    |numbers| level_of(steps(numbers)?.iter().sum()),
];
pub(super) const OTHER_LOGARITHM: [Wrong; 2] = [
    |numbers| Some(vec![libm::log(steps(numbers)?.into_iter().fold(0.0, f64::max))]),
    |numbers| Some(vec![steps(numbers)?.into_iter().fold(0.0, f64::max)]),
];
pub(super) const SIZE_FORGOTTEN: [Wrong; 1] = [|numbers| {
    let mut small = numbers.to_vec();
    small[..2].fill(1.0);
    right(Formula::Level, &small)
}];
pub(super) const WHOLE_LEVEL: [Wrong; 3] = [
    |numbers| Some(right(Formula::Level, numbers)?.iter().map(|level| level.floor()).collect()),
    |numbers| Some(right(Formula::Level, numbers)?.iter().map(|level| level.round()).collect()),
    |numbers| Some(right(Formula::Level, numbers)?.iter().map(|level| level.max(0.0)).collect()),
];

/// The level of a step in texels; nothing of one that has no length.
fn level_of(step: f64) -> Option<Vec<f64>> {
    (step > 0.0).then(|| vec![libm::log2(step)])
}

/// How many texels the place in the texture moves by a pixel to the right, and by a pixel downwards.
fn steps(numbers: &[f64]) -> Option<[f64; 2]> {
    let corner = |i: usize| <[f64; 5]>::try_from(numbers.get(2 + 5 * i..7 + 5 * i)?).ok();
    let corners = [corner(0)?, corner(1)?, corner(2)?];
    let [a, b, c] = corners;
    let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    let plane = |f: [f64; 3]| {
        let [df1, df2] = [f[1] - f[0], f[2] - f[0]];
        let by_x = (df1 * (c[1] - a[1]) - df2 * (b[1] - a[1])) / area;
        let by_y = (df2 * (b[0] - a[0]) - df1 * (c[0] - a[0])) / area;
        [f[0] + by_x * (numbers[17] - a[0]) + by_y * (numbers[18] - a[1]), by_x, by_y]
    };
    let [q, u, v] = [
        plane(corners.map(|corner| 1.0 / corner[2])),
        plane(corners.map(|corner| corner[3] / corner[2])),
        plane(corners.map(|corner| corner[4] / corner[2])),
    ];
    Some([1, 2].map(|slope: usize| {
        let by = |over_w: [f64; 3]| (over_w[slope] - over_w[0] / q[0] * q[slope]) / q[0];
        length([by(u) * numbers[0], by(v) * numbers[1], 0.0])
    }))
}
