// The course, solved. What the companion program of docs/own.md has too is between the two marks, as it is there.

// ---- from docs/own: 02b-triangles.rs, 03-values.rs, 05-perspective.rs ----

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
fn cover(
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

/// The weights of the three corners at a sample, which add up to 1.
fn weights(edges: [i128; 3]) -> [f64; 3] {
    let area: i128 = edges.iter().sum();
    edges.map(|value| value as f64 / area as f64)
}

/// The weighted mean of the values of three corners.
fn mix<const N: usize>(weights: [f64; 3], corners: [[f64; N]; 3]) -> [f64; N] {
    std::array::from_fn(|i| (0..3).map(|corner| weights[corner] * corners[corner][i]).sum())
}

/// The weights in space at a sample with these weights in the window: each corner counts with its 1/w.
fn in_space(window: [f64; 3], w: [f64; 3]) -> [f64; 3] {
    let shares: [f64; 3] = std::array::from_fn(|i| window[i] / w[i]);
    shares.map(|share| share / shares.iter().sum::<f64>())
}

/// A position in pixels on the grid of the corners.
fn snap(place: [f64; 2]) -> [i64; 2] {
    place.map(|px| (px * STEPS as f64).round_ties_even() as i64)
}

// ---- end of docs/own ----

const VALUES: Option<Values> = Some(values);
const SAMPLES: Option<Samples> = Some(samples);
const DEPTH: Option<Depth> = Some(depth);
const CLIP: Option<Clip<4>> = Some(clip);
const CLIP_ATTRIBUTES: Option<Clip<5>> = Some(clip);
const WIDE_LINE: Option<WideLine> = None;
const AREA: Option<Samples> = None;
const SAMPLE_VALUES: Option<SampleValues> = None;
const FORMULA: Option<Formula> = Some(formula);

fn line(
    from: (i32, i32),
    to: (i32, i32),
    width: i32,
    height: i32,
    set_pixel: &mut dyn FnMut(i32, i32),
) {
    let pixel = |(x, y): (i32, i32)| [i128::from(x), i128::from(y)];
    let ([x0, y0], [x1, y1]) = (pixel(from), pixel(to));
    let steep = (y1 - y0).abs() > (x1 - x0).abs();
    let turn = |[x, y]: [i128; 2]| if steep { [y, x] } else { [x, y] };
    let (mut start, mut end) = (turn([x0, y0]), turn([x1, y1]));
    let is_turned = end[0] < start[0];
    if is_turned {
        (start, end) = (end, start);
    }
    let (du, dv) = (end[0] - start[0], (end[1] - start[1]).abs());
    let sign = if end[1] < start[1] { -1 } else { 1 };
    let [across, along] = turn([height.into(), width.into()]);
    // Only the steps inside the window.
    let (first, last) = (0.max(-start[0]), du.min(along - 1 - start[0]));
    for i in first..=last {
        let k = if is_turned { first + last - i } else { i };
        let v = start[1] + sign * if du == 0 { 0 } else { (2 * k * dv + du) / (2 * du) };
        if (0..across).contains(&v) {
            let [x, y] = turn([start[0] + k, v]);
            set_pixel(x as i32, y as i32);
        }
    }
}

fn triangle(
    corners: [(f64, f64); 3],
    width: i32,
    height: i32,
    set_pixel: &mut dyn FnMut(i32, i32),
) {
    let corners = corners.map(|(x, y)| snap([x, y]));
    cover(corners, [0, 0, width.into(), height.into()], |x, y, _| set_pixel(x as i32, y as i32));
}

fn values(
    corners: [[f64; 6]; 3],
    width: i32,
    height: i32,
    set_pixel: &mut dyn FnMut(i32, i32, [f64; 3]),
) {
    let places = corners.map(|[x, y, ..]| snap([x, y]));
    cover(places, [0, 0, width.into(), height.into()], |x, y, edges| {
        let window = weights(edges);
        let [z] = mix(window, corners.map(|[_, _, z, ..]| [z]));
        let [a, b] = mix(in_space(window, corners.map(|c| c[3])), corners.map(|c| [c[4], c[5]]));
        set_pixel(x as i32, y as i32, [z, a, b]);
    });
}

fn samples(
    corners: [(f64, f64); 3],
    width: i32,
    height: i32,
    set_pixel: &mut dyn FnMut(i32, i32, u8),
) {
    let mut masks = vec![0; (width * height) as usize];
    for (s, [dx, dy]) in [[96, 32], [224, 96], [32, 160], [160, 224]].into_iter().enumerate() {
        // The triangle moved so that the sample comes to lie on the centre.
        let moved = corners.map(|(x, y)| snap([x, y])).map(|[x, y]| [x + 128 - dx, y + 128 - dy]);
        cover(moved, [0, 0, width.into(), height.into()], |x, y, _| {
            masks[(y * i64::from(width) + x) as usize] |= 1 << s;
        });
    }
    for (at, mask) in (0..).zip(masks) {
        set_pixel(at % width, at / width, mask);
    }
}

fn depth(
    triangles: &[[[f64; 3]; 3]],
    width: i32,
    height: i32,
    set_pixel: &mut dyn FnMut(i32, i32, usize),
) {
    let mut nearest = vec![(f64::INFINITY, 0); (width * height) as usize];
    for (t, corners) in triangles.iter().enumerate() {
        let places = corners.map(|[x, y, _]| snap([x, y]));
        cover(places, [0, 0, width.into(), height.into()], |x, y, edges| {
            let [z] = mix(weights(edges), corners.map(|[_, _, z]| [z]));
            let at = (y * i64::from(width) + x) as usize;
            if z < nearest[at].0 {
                nearest[at] = (z, t);
            }
        });
    }
    for (at, (z, t)) in (0..).zip(nearest) {
        if z < f64::INFINITY {
            set_pixel(at % width, at / width, t);
        }
    }
}

fn clip<const N: usize>(corners: [[f64; N]; 3]) -> Vec<[f64; N]> {
    let mut left = Vec::new();
    for i in 0..3 {
        let (a, b) = (corners[i], corners[(i + 1) % 3]);
        let (from, to) = (a[2] + a[3], b[2] + b[3]);
        if from >= 0.0 {
            left.push(a);
        }
        if (from >= 0.0) != (to >= 0.0) {
            left.push(std::array::from_fn(|k| a[k] + (b[k] - a[k]) * from / (from - to)));
        }
    }
    left
}

fn project([n, x, y, z]: [f64; 4]) -> Vec<f64> {
    vec![n * x / z, n * y / z, z]
}

fn window([width, height, n, f, x, y, z]: [f64; 7]) -> Vec<f64> {
    let depth = ((f + n) * z - 2.0 * n * f) / (f - n) / z;
    let place = [(n * x / z + 1.0) / 2.0 * width, (1.0 - n * y / z) / 2.0 * height];
    vec![place[0], place[1], (depth + 1.0) / 2.0]
}

fn winding([ax, ay, bx, by, cx, cy]: [f64; 6]) -> Vec<f64> {
    let [a, b, c] = [[ax, ay], [bx, by], [cx, cy]].map(snap);
    vec![edge(a, b, c).signum() as f64]
}

fn turn([axis, cos, sin, cx, cy, cz, x, y, z]: [f64; 9]) -> Vec<f64> {
    let (centre, mut point) = ([cx, cy, cz], vec![x, y, z]);
    let [i, j] = [1, 2].map(|next| (axis as usize + next) % 3);
    let (u, v) = (point[i] - centre[i], point[j] - centre[j]);
    point[i] = centre[i] + cos * u - sin * v;
    point[j] = centre[j] + sin * u + cos * v;
    point
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn normal(numbers: [f64; 12]) -> Vec<f64> {
    let [a, b, c, n] = [0, 3, 6, 9].map(|i| [numbers[i], numbers[i + 1], numbers[i + 2]]);
    // The rows of the inverse, transposed, times the determinant.
    let rows = [cross(b, c), cross(c, a), cross(a, b)];
    rows.map(|row| dot(row, n) / dot(a, rows[0])).to_vec()
}

fn light([n0, n1, n2, l0, l1, l2, ambient, diffuse]: [f64; 8]) -> Vec<f64> {
    let normal = [n0, n1, n2];
    let length = dot(normal, normal).sqrt();
    let cosine = if length > 0.0 { dot(normal, [l0, l1, l2]) / length } else { 0.0 };
    vec![ambient + diffuse * cosine.max(0.0)]
}

fn texel(u: f64, texels: &[f64]) -> Vec<f64> {
    let at = |i: f64| texels[i.rem_euclid(texels.len() as f64) as usize];
    let place = u * texels.len() as f64;
    let left = (place - 0.5).floor();
    let share = place - 0.5 - left;
    vec![at(place.floor()), at(left) + (at(left + 1.0) - at(left)) * share]
}

/// Of the plane through three values at the corners: how much it grows to the right, and downwards.
fn slopes([a, b, c]: [[f64; 5]; 3], values: [f64; 3]) -> [f64; 2] {
    let [dx1, dy1, dx2, dy2] = [b[0] - a[0], b[1] - a[1], c[0] - a[0], c[1] - a[1]];
    let (df1, df2) = (values[1] - values[0], values[2] - values[0]);
    let area = dx1 * dy2 - dx2 * dy1;
    [(df1 * dy2 - df2 * dy1) / area, (df2 * dx1 - df1 * dx2) / area]
}

fn level(numbers: [f64; 19]) -> Vec<f64> {
    let corners = [2, 7, 12].map(|i: usize| std::array::from_fn(|k| numbers[i + k]));
    let (width, height, x, y) = (numbers[0], numbers[1], numbers[17], numbers[18]);
    let plane = |of: fn([f64; 5]) -> f64| {
        let values = corners.map(|corner: [f64; 5]| of(corner) / corner[2]);
        let [right, down] = slopes(corners, values);
        [values[0] + right * (x - corners[0][0]) + down * (y - corners[0][1]), right, down]
    };
    let (q, u, v) = (plane(|_| 1.0), plane(|corner| corner[3]), plane(|corner| corner[4]));
    let derivative = |over_w: [f64; 3], way: usize| (over_w[way] - over_w[0] / q[0] * q[way]) / q[0];
    let steps = [1, 2].map(|way| (derivative(u, way) * width).hypot(derivative(v, way) * height));
    vec![steps[0].max(steps[1]).log2()]
}

fn formula(name: &str, numbers: &[f64]) -> Vec<f64> {
    fn list<const N: usize>(numbers: &[f64]) -> [f64; N] {
        numbers.try_into().expect("as many numbers as the formula takes")
    }
    match name {
        "project" => project(list(numbers)),
        "window" => window(list(numbers)),
        "winding" => winding(list(numbers)),
        "turn" => turn(list(numbers)),
        "normal" => normal(list(numbers)),
        "light" => light(list(numbers)),
        "texel" => texel(numbers[0], &numbers[1..]),
        "level" => level(list(numbers)),
        _ => Vec::new(),
    }
}
