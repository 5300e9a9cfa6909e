/// The weights in space at a sample with these weights in the window: each corner counts with its 1/w.
pub fn in_space(window: [f64; 3], w: [f64; 3]) -> [f64; 3] {
    let shares: [f64; 3] = std::array::from_fn(|i| window[i] / w[i]);
    shares.map(|share| share / shares.iter().sum::<f64>())
}

/// A position in pixels on the grid of the corners.
fn snap(place: [f64; 2]) -> [i64; 2] {
    place.map(|px| (px * STEPS as f64).round_ties_even() as i64)
}

/// Light and dark squares, eight on each side.
fn checker([u, v]: [f64; 2]) -> [f64; 3] {
    let is_light = ((8.0 * u).floor() + (8.0 * v).floor()).rem_euclid(2.0) == 0.0;
    if is_light { [0.9, 0.85, 0.7] } else { [0.25, 0.3, 0.45] }
}

/// A floor of two triangles.
pub fn stage5() -> RgbImage {
    let mut picture = empty();
    let floor = [[-3.0, -1.0, 2.5], [3.0, -1.0, 2.5], [3.0, -1.0, 12.0], [-3.0, -1.0, 12.0]];
    let uvs = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let clip = floor.map(|[x, y, z]| transform(&perspective(), [x, y, z, 1.0]));
    for corners in [[0, 1, 2], [0, 2, 3]] {
        let places = corners.map(|i| snap(place(clip[i])));
        cover(places, [0, 0, WIDTH, HEIGHT], |x, y, edges| {
            let weights = in_space(weights(edges), corners.map(|i| clip[i][3]));
            set(&mut picture, x, y, colour(checker(mix(weights, corners.map(|i| uvs[i])))));
        });
    }
    picture
}
