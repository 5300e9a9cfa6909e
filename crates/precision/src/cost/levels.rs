//! The group of levels of detail: how far the level of a pixel is from the exact one, and what it takes.
//!
//! Errors are taken against derivatives in quotients of big integers, of which the logarithm alone is rounded.

use super::entry::{Entry, PreparedColumns, classes};
use super::sampled::{self, CoveredTriangle, Emit, dress};
use super::scene::Scene;
use super::{Choice, CostOptions, Run};
use crate::ladder::interpolation::Values;
use crate::ladder::levels::{Derivatives, Differences, OfTriangle, SIDE, Textured};
use num_rational::BigRational;
use num_traits::{ToPrimitive as _, Zero as _};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::{PixelRect, SUBPIXELS, SubpixelPoint};

/// A part of a level that 8 bits between two levels can express, as the Vulkan specification wants at most.
pub(super) const STEP: f64 = 1.0 / 256.0;

/// Pixels of a class at which errors are taken.
const SAMPLES: usize = 400;

/// Triangles with the exact levels at a sample of their pixels.
type Input = sampled::Input<Textured, f64>;

/// The triangles of a scene on the lattice that cover anything, with texture coordinates made of their positions.
fn input(scene: &Scene) -> Input {
    let mut drawn = dress(scene, |_, corners, inv_w| {
        let made = |i: usize| {
            let SubpixelPoint { x, y } = corners[i];
            [x % 509 + i as i32, y % 503].map_array(|n| f64::from(n - 254) / 256.0)
        };
        Textured { corners, inv_w, uv: [0, 1, 2].map_array(made) }
    });
    drawn.retain(|of| !of.spans.is_empty());
    of(drawn, scene.bounds)
}

/// Triangles with the exact levels at the usual number of samples.
fn of(drawn: Vec<CoveredTriangle<Textured>>, bounds: PixelRect) -> Input {
    Input::new(drawn, bounds, SAMPLES, |&of| Some(move |x_px, y_px| exact(&of, x_px, y_px)))
}

/// A float as the quotient that it is.
fn exactly(value: f64) -> BigRational {
    BigRational::from_float(value).unwrap_or_else(BigRational::zero)
}

/// The exact level at the centre of a pixel; nothing where a texture coordinate is the same everywhere.
fn exact(Textured { corners, inv_w, uv }: &Textured, x_px: i32, y_px: i32) -> Option<f64> {
    let px = corners.map_array(|corner| {
        [corner.x, corner.y].map_array(|sub| exactly(f64::from(sub) / f64::from(SUBPIXELS)))
    });
    let [a, b, c] = &px;
    let edge = |p: &[BigRational; 2]| [&p[0] - &a[0], &p[1] - &a[1]];
    let (to_b, to_c) = (edge(b), edge(c));
    let to = edge(&[x_px, y_px].map_array(|px| exactly(f64::from(px) + 0.5)));
    let area = &to_b[0] * &to_c[1] - &to_b[1] * &to_c[0];
    // The value at the pixel and the slopes of what is linear.
    let plane = |of: &dyn Fn(usize) -> BigRational| {
        let (first, b, c) = (of(0), of(1) - of(0), of(2) - of(0));
        let by_x = (&b * &to_c[1] - &c * &to_b[1]) / &area;
        let by_y = (&c * &to_b[0] - &b * &to_c[0]) / &area;
        [first + &by_x * &to[0] + &by_y * &to[1], by_x, by_y]
    };
    // Texture coordinates times 1/w are linear, and 1/w is; the quotient rule makes slopes of the texture of them.
    let inv = plane(&|i| exactly(inv_w[i]));
    let square = |axis: usize| {
        let along = |coordinate: usize| {
            let over = plane(&|i| exactly(uv[i][coordinate] * SIDE) * exactly(inv_w[i]));
            let numerator = &over[axis] * &inv[0] - &over[0] * &inv[axis];
            numerator / (&inv[0] * &inv[0])
        };
        let (u, v) = (along(0), along(1));
        &u * &u + &v * &v
    };
    let square = square(1).max(square(2)).to_f64()?;
    (square > 0.0).then(|| 0.5 * libm::log2(square))
}

/// A choice of levels, which promises nothing.
fn entry(
    name: &'static str,
    about: &'static str,
    body: impl Values<Textured> + Copy + 'static,
) -> Entry<Input> {
    sampled::entry(Choice::new(name, about, &[]), body, judge)
}

/// The worst and the mean error of a choice, in levels.
fn judge(input: &Input, choice: Emit<'_, Textured>) -> Run {
    let (mut worst, mut sum) = (0f64, 0.0);
    input.at_samples(choice, &mut |_, exact, _, level| {
        let error = (level - exact).abs();
        // A triangle that is an edge in the texture has no area, and no level by it.
        let error = if error.is_finite() { error } else { f64::from(u8::MAX) };
        worst = worst.max(error);
        sum += error;
    });
    Run::of(vec![Some(worst), Some(sum / input.judged().part.max(1) as f64)])
}

/// The choices of the group, from the cheapest idea to the most accurate one.
pub(super) fn choices() -> Vec<Entry<Input>> {
    vec![
        entry("one a triangle", "by the areas in texels and in pixels", OfTriangle),
        entry(
            "differences f32",
            "of two pixels, for 2 x 2 at once, as hardware",
            Differences::<f32>::default(),
        ),
        entry("differences f64", "the same", Differences::<f64>::default()),
        entry("derivatives f32", "at each pixel", Derivatives::<f32>::default()),
        entry("derivatives f64", "at each pixel", Derivatives::<f64>::default()),
    ]
}

/// All classes of scenes: a level depends on the shape of a triangle as well as on its w.
pub(super) fn columns(options: &CostOptions) -> impl PreparedColumns<Input> {
    classes(options, (512, [20_000, 200_000]), |scene| Ok(input(scene).counted()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cost::scene::{Size, scenes};
    use rasterproof_core::triangle::Span;

    /// A square of 256 x 256 texels in 64 x 64 pixels that faces the eye: four texels a pixel.
    #[test]
    fn a_square_that_faces_the_eye_has_one_level() {
        let corner = |x: i32, y: i32| SubpixelPoint::new(x * SUBPIXELS, y * SUBPIXELS);
        let triangle = Textured {
            corners: [corner(0, 0), corner(64, 0), corner(0, 64)],
            inv_w: [0.5; 3],
            uv: [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]],
        };
        assert_eq!(exact(&triangle, 3, 7), Some(2.0));
        let spans = vec![Span { y_px: 7, x0_px: 1, x1_px: 6 }];
        let drawn = vec![CoveredTriangle { number: 0, triangle, spans }];
        let input = of(drawn, PixelRect::window(64, 64));
        assert_eq!(input.judged().part, 5);
        for choice in choices() {
            let worst = choice.judge(&input).unwrap().errors[0].unwrap();
            assert!(worst < 1e-5, "{}: {worst}", choice.choice.name);
        }
    }

    /// A choice that forgets the slope of 1/w is far off where w differs, and right where it does not.
    #[test]
    fn a_level_without_perspective_is_seen() {
        #[derive(Clone, Copy)]
        struct Affine;
        impl Values<Textured> for Affine {
            fn values(&self, triangle: &Textured, spans: &[Span], emit: impl FnMut(i32, i32, f64)) {
                let flat = Textured { inv_w: [1.0; 3], ..*triangle };
                Derivatives::<f64>::default().values(&flat, spans, emit);
            }
        }
        let scenes = scenes(1, Size { side_px: 256, pixels: 4_000 });
        let worst = |name: &str, choice: Entry<Input>| {
            let scene = scenes.iter().find(|scene| scene.name == name).unwrap();
            choice.judge(&input(scene)).unwrap().errors[0].unwrap()
        };
        let affine = || entry("affine", "", Affine);
        assert!(worst("w 1", affine()) < 1e-9 && worst("w 4", affine()) > 0.5);
        assert!(worst("w 1e4", entry("", "", Derivatives::<f64>::default())) < 1e-6);
        assert!(worst("w 100", entry("", "", Differences::<f64>::default())) > STEP);
    }
}
