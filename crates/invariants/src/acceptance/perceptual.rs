//! Models of measures that weigh differences by how visible they are: LDR-FLIP (Andersson et al. 2020), SSIM as VTK
//! computes it (Wang et al. 2004), and pixelmatch. Powers come from `libm`, so that they are the same on every machine.

use std::f64::consts::PI;

use super::drawing::Rendering;
use rasterproof_core::arrays::MapArray as _;

/// Pixels for each degree of the field of view: a 0.7 m wide screen of 3840 pixels seen from 0.7 m.
const PIXELS_PER_DEGREE: f64 = 3840.0 * PI / 180.0;
/// X, Y and Z of the standard daylight D65.
const WHITE: [f64; 3] = [0.950_428_545, 1.0, 1.088_900_371];

/// A channel of sRGB as linear light, from 0 to 1.
fn linear(byte: u8) -> f64 {
    let v = f64::from(byte) / 255.0;
    if v > 0.040_45 { libm::pow((v + 0.055) / 1.055, 2.4) } else { v / 12.92 }
}

/// The pixels of a picture in linear light. Powers take long, and there are only 256 of them.
fn linear_of_all(pixels: &[[u8; 3]]) -> Vec<[f64; 3]> {
    let table: Vec<f64> = (0..=255).map(linear).collect();
    pixels.iter().map(|pixel| pixel.map_array(|byte| table[usize::from(byte)])).collect()
}

/// Linear RGB to XYZ, in units of the white.
fn to_xyz([r, g, b]: [f64; 3]) -> [f64; 3] {
    let [x, y, z] = [
        (10_135_552.0 * r + 8_788_810.0 * g + 4_435_075.0 * b) / 24_577_794.0,
        (2_613_072.0 * r + 8_788_810.0 * g + 887_015.0 * b) / 12_288_897.0,
        (1_425_312.0 * r + 8_788_810.0 * g + 70_074_185.0 * b) / 73_733_382.0,
    ];
    [x / WHITE[0], y / WHITE[1], z / WHITE[2]]
}

/// The inverse of [`to_xyz`], to nine digits.
fn from_xyz(of_white: [f64; 3]) -> [f64; 3] {
    let [x, y, z] = of_white;
    let (x, y, z) = (x * WHITE[0], y * WHITE[1], z * WHITE[2]);
    [
        3.241_003_275 * x - 1.537_398_934 * y - 0.498_615_861 * z,
        -0.969_224_334 * x + 1.875_930_071 * y + 0.041_554_224 * z,
        0.055_639_423 * x - 0.204_011_202 * y + 1.057_148_933 * z,
    ]
}

/// An opponent space of three numbers: lightness, red against green, yellow against blue.
fn opponent([x, y, z]: [f64; 3]) -> [f64; 3] {
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// L*a*b* of a colour in linear light.
fn lab(rgb: [f64; 3]) -> [f64; 3] {
    opponent(to_xyz(rgb).map_array(root_of_lab))
}

/// The cube root, and a line near 0, where the root would be too steep.
fn root_of_lab(v: f64) -> f64 {
    if v > 216.0 / 24_389.0 { libm::cbrt(v) } else { v * 841.0 / 108.0 + 4.0 / 29.0 }
}

/// The pixels of a picture in L*a*b*.
pub fn lab_of_all(pixels: &[[u8; 3]]) -> Vec<[f64; 3]> {
    linear_of_all(pixels).into_iter().map(lab).collect()
}

/// One number for each pixel, row after row.
type Channel = Vec<f64>;

/// The weights of the pixels from one radius before a pixel to one radius behind it.
type Kernel = Vec<f64>;

/// The kernel of a function of the distance.
fn kernel(radius: i32, of: impl Fn(f64) -> f64) -> Kernel {
    (-radius..=radius).map(|i| of(f64::from(i))).collect()
}

/// Filters with one kernel along rows and another along columns; pixels beyond the border are those of the border.
fn filtered(plane: &[f64], width: usize, along_rows: &[f64], along_columns: &[f64]) -> Channel {
    let height = plane.len() / width;
    let rows = filtered_along(plane, along_rows, width, 1);
    filtered_along(&rows, along_columns, height, width)
}

/// Filters along one axis, on which there are `length` pixels, each `stride` after the one before it.
fn filtered_along(from: &[f64], kernel: &[f64], length: usize, stride: usize) -> Channel {
    let radius = kernel.len() / 2;
    let mut filtered = Vec::with_capacity(from.len());
    for place in 0..from.len() {
        let at = place / stride % length;
        let first = place - at * stride;
        let mut sum = 0.0;
        for (k, weight) in kernel.iter().enumerate() {
            let near = (at + k).saturating_sub(radius).min(length - 1);
            sum += weight * from[first + near * stride];
        }
        filtered.push(sum);
    }
    filtered
}

/// What FLIP computes of one of its two pictures.
pub struct Flip {
    /// The filtered picture in L*a*b*, with colours less vivid where it is dark (Hunt).
    colours: Vec<[f64; 3]>,
    /// The strength of edges and of points.
    features: Vec<[f64; 2]>,
}

impl Flip {
    /// Everything that does not depend on the other picture.
    pub fn new(width: usize, pixels: &[[u8; 3]]) -> Self {
        // First the picture in an opponent space, whose channels the eye resolves differently well.
        let mut seen = Vec::with_capacity(pixels.len());
        for rgb in linear_of_all(pixels) {
            seen.push(opponent(to_xyz(rgb)));
        }
        let mut channels = [Channel::new(), Channel::new(), Channel::new()];
        for (i, channel) in channels.iter_mut().enumerate() {
            let plane: Channel = seen.iter().map(|v| v[i]).collect();
            *channel = contrast_filtered(&plane, width, CONTRAST[i]);
        }
        // What is left of it is looked at as a picture again.
        let mut colours = Vec::with_capacity(pixels.len());
        let [lightness, reds, blues] = &channels;
        for ((y, cx), cz) in lightness.iter().zip(reds).zip(blues) {
            let y = (y + 16.0) / 116.0;
            let rgb =
                from_xyz([y + cx / 500.0, y, y - cz / 200.0]).map_array(|v| v.clamp(0.0, 1.0));
            colours.push(hunt(lab(rgb)));
        }
        // Features are looked for in the lightness of the picture as it was.
        let grey: Channel = seen.iter().map(|v| (v[0] + 16.0) / 116.0).collect();
        let edges = strengths(&grey, width, false);
        let points = strengths(&grey, width, true);
        let features = edges.into_iter().zip(points).map(|(edge, point)| [edge, point]).collect();
        Self { colours, features }
    }

    /// The mean error of another picture, from 0 to 1.
    pub fn mean(&self, width: usize, pixels: &[[u8; 3]]) -> f64 {
        let other = Self::new(width, pixels);
        // The largest difference of colours on a screen is that of green and blue.
        let largest = libm::pow(hyab(hunt(lab([0.0, 1.0, 0.0])), hunt(lab([0.0, 0.0, 1.0]))), 0.7);
        let mut sum = 0.0;
        for p in 0..pixels.len() {
            let colour = libm::pow(hyab(self.colours[p], other.colours[p]), 0.7);
            // Errors up to 0.4 of the largest take up 0.95 of the scale.
            let knee = 0.4 * largest;
            let colour = match colour < knee {
                true => colour * 0.95 / knee,
                false => 0.95 + 0.05 * (colour - knee) / (largest - knee),
            };
            let ([edge, point], [other_edge, other_point]) = (self.features[p], other.features[p]);
            let difference = (edge - other_edge).abs().max((point - other_point).abs());
            let feature = (difference / std::f64::consts::SQRT_2).sqrt();
            // A feature that only one of both has makes an error of the colour weigh more.
            sum += libm::pow(colour, 1.0 - feature);
        }
        sum / pixels.len() as f64
    }
}

/// The sensitivities to contrast of the three channels, each a sum of two Gaussians of this weight and width.
const CONTRAST: [[[f64; 2]; 2]; 3] =
    [[[1.0, 0.0047], [0.0, 1e-5]], [[1.0, 0.0053], [0.0, 1e-5]], [[34.1, 0.04], [13.5, 0.025]]];

/// A channel as an eye sees it that does not resolve all of it: filtered with a sum of Gaussians whose weights come to 1.
fn contrast_filtered(plane: &[f64], width: usize, gaussians: [[f64; 2]; 2]) -> Channel {
    // As wide as the widest of all channels.
    let radius = (3.0 * (0.04 / (2.0 * PI * PI)).sqrt() * PIXELS_PER_DEGREE).ceil() as i32;
    let mut sum = vec![0.0; plane.len()];
    let mut weights = 0.0;
    for [weight, spread] in gaussians {
        if weight == 0.0 {
            continue;
        }
        let scale = -PI * PI / (spread * PIXELS_PER_DEGREE * PIXELS_PER_DEGREE);
        let kernel = kernel(radius, |x| libm::exp(scale * x * x));
        let weight = weight * (PI / spread).sqrt();
        let total: f64 = kernel.iter().sum();
        weights += weight * total * total;
        for (sum, v) in sum.iter_mut().zip(filtered(plane, width, &kernel, &kernel)) {
            *sum += weight * v;
        }
    }
    sum.iter().map(|v| v / weights).collect()
}

/// The strength of edges, or of points, in both directions together.
fn strengths(grey: &[f64], width: usize, points: bool) -> Channel {
    let deviation = 0.5 * 0.082 * PIXELS_PER_DEGREE;
    let radius = (3.0 * deviation).ceil() as i32;
    let bell = kernel(radius, |x| libm::exp(-x * x / (2.0 * deviation * deviation)));
    let across = kernel(radius, |x| {
        let bell = libm::exp(-x * x / (2.0 * deviation * deviation));
        // The first derivative of the bell answers to edges, the second one to points.
        bell * if points { x * x / (deviation * deviation) - 1.0 } else { -x }
    });
    // Positive and negative weights of the plane come to 1 each.
    let total: f64 = bell.iter().sum();
    let sum = |sign: f64| across.iter().filter(|&&v| v * sign > 0.0).sum::<f64>().abs() * total;
    let (positive, negative) = (sum(1.0), sum(-1.0));
    let across: Kernel =
        across.iter().map(|&v| v / if v < 0.0 { negative } else { positive }).collect();
    let x = filtered(grey, width, &across, &bell);
    let y = filtered(grey, width, &bell, &across);
    x.iter().zip(&y).map(|(x, y)| (x * x + y * y).sqrt()).collect()
}

/// Colours are less vivid where it is dark.
fn hunt([l, a, b]: [f64; 3]) -> [f64; 3] {
    [l, 0.01 * l * a, 0.01 * l * b]
}

/// How far two colours are apart, by a distance that also holds for large ones: lightness and the rest are added.
fn hyab(p: [f64; 3], q: [f64; 3]) -> f64 {
    let [l, a, b] = [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
    l.abs() + (a * a + b * b).sqrt()
}

/// Radius of the discs that SSIM looks at, in pixels.
const PATCH: i64 = 6;
/// The constants that keep SSIM from dividing by zero, for L*, a* and b*.
const STEADY: [[f64; 2]; 3] = [[100.0, 900.0], [650.25, 5852.25], [650.25, 5852.25]];
/// Of the histogram of SSIM, from -1 to 1.
const BINS: usize = 200;

/// How far SSIM is from 1, by VTK's tight measure: the root of the mean square, or the distance of the histogram, of the
/// worst channel.
pub fn ssim_error(width: usize, right: &[[f64; 3]], drawn: &[[f64; 3]]) -> f64 {
    (0..3).map(|channel| ssim_error_of(width, right, drawn, channel)).fold(0.0, f64::max)
}

/// The same of one channel alone, by its place in a colour.
fn ssim_error_of(width: usize, right: &[[f64; 3]], drawn: &[[f64; 3]], channel: usize) -> f64 {
    let height = (right.len() / width) as i64;
    // The pixels of a disc, by their ways from its centre.
    let mut disc = Vec::new();
    for y in -PATCH..=PATCH {
        for x in -PATCH..=PATCH {
            if x * x + y * y <= PATCH * PATCH {
                disc.push([x, y]);
            }
        }
    }
    let mut squares = 0.0;
    let mut histogram = [0u64; BINS];
    // Where both pictures are equal all around, SSIM is 1.
    let (mut least, mut most) = ([i64::MAX; 2], [i64::MIN; 2]);
    for place in (0..right.len()).filter(|&place| right[place] != drawn[place]) {
        let at = [(place % width) as i64, (place / width) as i64];
        for axis in 0..2 {
            least[axis] = least[axis].min(at[axis].saturating_sub(PATCH));
            most[axis] = most[axis].max(at[axis].saturating_add(PATCH));
        }
    }
    // SSIM of each pixel, from the sums over the part of the disc around it that lies in the picture.
    for place in 0..right.len() as i64 {
        let (x, y) = (place % width as i64, place / width as i64);
        if !(least[0]..=most[0]).contains(&x) || !(least[1]..=most[1]).contains(&y) {
            histogram[BINS - 1] += 1;
            continue;
        }
        let (mut count, mut sums, mut products) = (0.0, [0.0; 2], [0.0; 3]);
        for [dx, dy] in &disc {
            let (x, y) = (x + dx, y + dy);
            if (0..width as i64).contains(&x) && (0..height).contains(&y) {
                let at = (y * width as i64 + x) as usize;
                let (a, b) = (right[at][channel], drawn[at][channel]);
                count += 1.0;
                sums = [sums[0] + a, sums[1] + b];
                products = [products[0] + a * a, products[1] + b * b, products[2] + a * b];
            }
        }
        // Means, variances and the covariance of both pictures within the disc.
        let [m, n] = sums.map_array(|sum| sum / count);
        let [of_right, of_drawn, joint] =
            [products[0] / count - m * m, products[1] / count - n * n, products[2] / count - m * n];
        let [c1, c2] = STEADY[channel];
        let ssim = (2.0 * m * n + c1) * (2.0 * joint + c2)
            / ((m * m + n * n + c1) * (of_right + of_drawn + c2));
        squares += (1.0 - ssim) * (1.0 - ssim);
        let bin = (ssim + 1.0) / 2.0 * (BINS - 1) as f64;
        histogram[((bin + 0.5) as usize).min(BINS - 1)] += 1;
    }
    // How far the histogram is from one in which all pixels have the best value: the distance of both distributions.
    let count = right.len() as f64;
    let (mut below, mut distance) = (0.0, 0.0);
    for of_bin in &histogram[..BINS - 1] {
        below += *of_bin as f64;
        distance += below * below;
    }
    let histogram = (distance / (count * count * (BINS - 1) as f64)).sqrt();
    (squares / count).sqrt().max(histogram)
}

/// The number of pixels that pixelmatch counts as different at this threshold.
pub fn pixelmatch(right: &Rendering, drawn: &Rendering, threshold: f64) -> usize {
    let most = 35_215.0 * threshold * threshold;
    let mut count = 0;
    for place in 0..right.pixels.len() {
        let [y, i, q] = yiq(right.pixels[place], drawn.pixels[place]);
        // What either picture smooths along an edge is forgiven.
        let differs = 0.5053 * y * y + 0.299 * i * i + 0.1957 * q * q > most
            && !is_smoothed(right, drawn, place)
            && !is_smoothed(drawn, right, place);
        count += usize::from(differs);
    }
    count
}

/// The difference of two colours in lightness and in two numbers for the hue.
fn yiq(a: [u8; 3], b: [u8; 3]) -> [f64; 3] {
    let ([r, g, b], [other_r, other_g, other_b]) = (a.map_array(f64::from), b.map_array(f64::from));
    let (r, g, b) = (r - other_r, g - other_g, b - other_b);
    [
        r * 0.298_895_31 + g * 0.586_622_47 + b * 0.114_482_23,
        r * 0.595_977_99 - g * 0.274_176_10 - b * 0.321_801_89,
        r * 0.211_470_17 - g * 0.522_617_11 + b * 0.311_146_94,
    ]
}

/// The pixels around one, and whether it lies on the border.
fn around(picture: &Rendering, place: usize) -> (Vec<usize>, bool) {
    let (width, height) = (picture.width, picture.pixels.len() / picture.width);
    let (x, y) = (place % width, place / width);
    let (x0, x1) = (x.saturating_sub(1), (x + 1).min(width - 1));
    let (y0, y1) = (y.saturating_sub(1), (y + 1).min(height - 1));
    let mut places = Vec::with_capacity(8);
    for x in x0..=x1 {
        for y in y0..=y1 {
            if y * width + x != place {
                places.push(y * width + x);
            }
        }
    }
    (places, x == 0 || y == 0 || x == width - 1 || y == height - 1)
}

/// Whether pixelmatch takes a pixel for one of a smoothed edge.
fn is_smoothed(picture: &Rendering, other: &Rendering, place: usize) -> bool {
    let (places, on_border) = around(picture, place);
    // With three equal pixels around it a pixel lies in a plane of one colour, which the border counts as one of.
    let mut equal = usize::from(on_border);
    let (mut darkest, mut brightest) = ((0.0, place), (0.0, place));
    for near in places {
        let (own, its) = (picture.pixels[place], picture.pixels[near]);
        let delta = if own == its { 0.0 } else { yiq(own, its)[0] };
        if delta == 0.0 {
            equal += 1;
            if equal > 2 {
                return false;
            }
        } else if delta < darkest.0 {
            darkest = (delta, near);
        } else if delta > brightest.0 {
            brightest = (delta, near);
        }
    }
    if darkest.0 == 0.0 || brightest.0 == 0.0 {
        return false;
    }
    // It is smoothed where it lies between a darker and a brighter pixel, one of which is in a plane in both pictures.
    let mut is_even = false;
    for (_, place) in [darkest, brightest] {
        is_even |= has_siblings(picture, place) && has_siblings(other, place);
    }
    is_even
}

/// Whether three pixels around one have its colour.
fn has_siblings(picture: &Rendering, place: usize) -> bool {
    let (places, on_border) = around(picture, place);
    // As in [`is_smoothed`], the border counts as one.
    let mut count = usize::from(on_border);
    for near in places {
        count += usize::from(picture.pixels[near] == picture.pixels[place]);
    }
    count > 2
}
