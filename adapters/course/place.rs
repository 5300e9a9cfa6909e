// The course. Write the function of your step, then: rasterproof course check

// ---- YOUR PLACE: seven functions, empty as they stand ----
const VALUES: Option<Values> = Some(values);
const SAMPLES: Option<Samples> = Some(samples);
const DEPTH: Option<Depth> = Some(depth);
const CLIP: Option<Clip<4>> = Some(clip);
/// To be judged with attributes, too, let it be a function of corners x, y, z, w, a (step 7).
const CLIP_ATTRIBUTES: Option<Clip<5>> = None;
const WIDE_LINE: Option<WideLine> = None;
const AREA: Option<Samples> = None;
const SAMPLE_VALUES: Option<SampleValues> = None;
const FORMULA: Option<Formula> = Some(formula);

/// Whole pixels from one to another, both drawn, in drawing order, and nothing outside the window (steps 1 and 2a).
fn line(
    from: (i32, i32),
    to: (i32, i32),
    width: i32,
    height: i32,
    set_pixel: &mut dyn FnMut(i32, i32),
) {
}

/// Corners in pixels, y down; set_pixel(x, y) for every pixel drawn (steps 2b, 2c and 7).
fn triangle(
    corners: [(f64, f64); 3],
    width: i32,
    height: i32,
    set_pixel: &mut dyn FnMut(i32, i32),
) {
}

/// Corners are x, y, z, w, a, b; set_pixel(x, y, [z, a, b]) for every pixel drawn (steps 3 to 7).
fn values(
    corners: [[f64; 6]; 3],
    width: i32,
    height: i32,
    set_pixel: &mut dyn FnMut(i32, i32, [f64; 3]),
) {
}

/// As triangle, with four samples: set_pixel(x, y, mask), bit s of the mask is sample s (step 12).
fn samples(
    corners: [(f64, f64); 3],
    width: i32,
    height: i32,
    set_pixel: &mut dyn FnMut(i32, i32, u8),
) {
}

/// Triangles of three corners x, y, z; set_pixel(x, y, t) once where triangle t is nearest (step 6).
fn depth(
    triangles: &[[[f64; 3]; 3]],
    width: i32,
    height: i32,
    set_pixel: &mut dyn FnMut(i32, i32, usize),
) {
}

/// Three corners x, y, z, w of clip space; the corners of what z >= -w leaves of them (step 7).
fn clip(corners: [[f64; 4]; 3]) -> Vec<[f64; 4]> {
    Vec::new()
}

/// What the formula "project", "window" and so on gives for these numbers (steps 4, 8 to 11 and 13).
fn formula(name: &str, numbers: &[f64]) -> Vec<f64> {
    Vec::new()
}
