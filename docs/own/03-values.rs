/// The weights of the three corners at a sample, which add up to 1.
pub fn weights(edges: [i128; 3]) -> [f64; 3] {
    let area: i128 = edges.iter().sum();
    edges.map(|value| value as f64 / area as f64)
}

/// The weighted mean of the values of three corners.
pub fn mix<const N: usize>(weights: [f64; 3], corners: [[f64; N]; 3]) -> [f64; N] {
    std::array::from_fn(|i| (0..3).map(|corner| weights[corner] * corners[corner][i]).sum())
}

fn colour(channels: [f64; 3]) -> Rgb<u8> {
    Rgb(channels.map(|channel| (255.0 * channel).clamp(0.0, 255.0).round() as u8))
}

/// A triangle with a red, a green and a blue corner.
pub fn stage3() -> RgbImage {
    let mut picture = empty();
    let corners = [[80, 8], [150, 110], [10, 110]].map(|corner| corner.map(|px| px * STEPS));
    let colours = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    cover(corners, [0, 0, WIDTH, HEIGHT], |x, y, edges| {
        set(&mut picture, x, y, colour(mix(weights(edges), colours)));
    });
    picture
}
