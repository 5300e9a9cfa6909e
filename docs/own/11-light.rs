/// Brightness by Lambert's law: the cosine between the normal and the way to the light, and a little
/// light from everywhere.
fn brightness(normal: [f64; 3]) -> f64 {
    let towards = [-0.4, 0.7, -0.6];
    let dot = |a: [f64; 3], b: [f64; 3]| -> f64 { (0..3).map(|i| a[i] * b[i]).sum() };
    let cosine = dot(normal, towards) / (dot(normal, normal) * dot(towards, towards)).sqrt();
    0.25 + 0.75 * cosine.max(0.0)
}

/// The cube, lit, textured and depth-tested.
pub fn stage11() -> RgbImage {
    let mut canvas = Canvas::new();
    let shade = |[u, v, x, y, z]: [f64; 5]| {
        colour(checker([u, v]).map(|channel| channel * brightness([x, y, z])))
    };
    draw_cube(&mut canvas, &pose(0.6, -0.5, 4.5), &shade);
    canvas.picture
}
