//! The acceptance rules, each a model of what a published test suite does, with the place where it does so.

use std::collections::HashMap;

use rasterproof_core::contract::Rasterize as _;
use rasterproof_verify::cases::Triangle;
use rasterproof_verify::comparison::single_precision::perspective_bounds;
use rasterproof_verify::comparison::tolerance;

use super::deqp::{self, Cover};
use super::drawing::{Rasterizer, Rendering};
use super::perceptual;
use super::scenes::{Paint, Scene};

/// What a rule decides by: a picture beside the right one.
pub struct View<'a> {
    pub scene: &'a Scene,
    pub seen: &'a RightPicture,
    /// What the scanline engine draws of the scene.
    pub right: &'a Rendering,
    /// The picture to be accepted or refused.
    pub drawn: &'a Rendering,
    /// Whose it is, for what a device reports about itself.
    pub subject: &'a Rasterizer,
}

/// What several rules compute of the right picture, once for all that are compared with it.
pub struct RightPicture {
    /// dEQP's three kinds of pixels, for devices with 8 and with 4 bits below the pixel.
    covers: Option<[Vec<Cover>; 2]>,
    flip: perceptual::Flip,
    lab: Vec<[f64; 3]>,
}

impl RightPicture {
    /// Computes it of the reference's picture.
    pub fn new(scene: &Scene, right: &Rendering) -> Self {
        // Only pictures of white triangles are judged by kinds of pixels.
        let covers = (scene.paint == Paint::White)
            .then(|| [8, 4].map(|bits| deqp::covers(&scene.triangles, scene.window, bits)));
        let flip = perceptual::Flip::new(right.width, &right.pixels);
        Self { covers, flip, lab: perceptual::lab_of_all(&right.pixels) }
    }
}

/// A model of a rule by which a test suite accepts or refuses a picture.
#[derive(serde::Serialize)]
pub struct Rule {
    #[serde(rename = "rule")]
    pub name: &'static str,
    /// What it accepts, in one sentence for the tables.
    #[serde(rename = "accepts")]
    pub about: &'static str,
    /// The file that applies it, and the place in the file.
    pub source: &'static str,
    /// Whether it accepts a picture; `None` for scenes that it is not about.
    #[serde(skip)]
    decide: fn(&View<'_>) -> Option<bool>,
}

impl Rule {
    /// Whether it accepts; no rule accepts a program that draws nothing, since a suite counts a crash as a failure.
    #[must_use]
    pub fn accepts(&self, view: &View<'_>) -> Option<bool> {
        (self.decide)(view).map(|accepts| accepts && !view.drawn.failed)
    }
}

/// Every rule, in the order of the tables. The last is this project's own.
pub const RULES: [Rule; 12] = [
    Rule {
        name: "deqp-strict",
        about: "no wrong pixel, but any where an edge passes within 3 subpixels of the centre",
        source: "KhronosGroup/VK-GL-CTS framework/common/tcuRasterizationVerifier.cpp, \
                 verifyTriangleGroupRasterization, VERIFICATIONMODE_STRICT",
        decide: |view| Some(deqp::accepts(view.covers()?, &view.drawn.pixels, 0)),
    },
    Rule {
        name: "deqp-weak",
        about: "the same with at most 10 wrong pixels",
        source: "the same file, VERIFICATIONMODE_WEAK, weakVerificationThreshold",
        decide: |view| Some(deqp::accepts(view.covers()?, &view.drawn.pixels, deqp::WEAK)),
    },
    Rule {
        name: "deqp-fill-rule",
        about: "no pixel is added twice; none is missing where the window is filled",
        source: "KhronosGroup/VK-GL-CTS modules/gles3/functional/es3fRasterizationTests.cpp, FillRuleCase::iterate",
        decide: |view| {
            let fits = view.scene.paint == Paint::Add;
            fits.then(|| deqp::added_once(&view.drawn.pixels, view.scene.fills_window))
        },
    },
    Rule {
        name: "cts-samples",
        about: "two opposite corners and the middle of the picture, within 1 of 255",
        source: "gpuweb/cts src/webgpu/api/operation/render_pipeline/culling_tests.spec.ts, checkCornerPixels, \
                 maxDiffULPsForNormFormat: 1; the middle is ours",
        decide: |view| Some(samples_agree(view.right, view.drawn)),
    },
    Rule {
        name: "0.2%",
        about: "at most 0.2% of the pixels differ by more than 0.004 in a channel",
        source: "AcademySoftwareFoundation/OpenImageIO testsuite/python-imagebufalgo/run.py, failthresh, failpercent",
        decide: |view| {
            let differing = view.count(|a, b| largest(a, b) > 1);
            Some(differing as f64 <= 0.002 * view.right.pixels.len() as f64)
        },
    },
    Rule {
        name: "pixelmatch-1%",
        about: "fewer than 1% of the pixels differ visibly, smoothed edges left out",
        source: "mrdoob/three.js test/e2e/puppeteer.js, pixelThreshold, maxFailedPixels; mapbox/pixelmatch index.js",
        decide: |view| {
            let differing = perceptual::pixelmatch(view.right, view.drawn, 0.1);
            Some((differing as f64) < 0.01 * view.right.pixels.len() as f64)
        },
    },
    Rule {
        name: "flip-0.02",
        about: "the mean of LDR-FLIP is at most 0.02",
        source: "gfx-rs/wgpu examples/src/shadow/mod.rs, ComparisonType::Mean(0.02); NVlabs/flip python/flip_api.py",
        decide: |view| {
            Some(view.same() || view.seen.flip.mean(view.drawn.width, &view.drawn.pixels) <= 0.02)
        },
    },
    Rule {
        name: "ssim-0.05",
        about: "the mean and histogram distance of SSIM in Lab from 1 is at most 0.05",
        source: "Kitware/VTK Imaging/Core/vtkImageSSIM.cxx, ComputeErrorMetrics, tight; \
                 Documentation/release/dev/imaging-testing-framework.md of Kitware/ParaView, TIGHT_VALID",
        decide: |view| {
            let lab = || perceptual::lab_of_all(&view.drawn.pixels);
            Some(
                view.same()
                    || perceptual::ssim_error(view.drawn.width, &view.seen.lab, &lab()) <= 0.05,
            )
        },
    },
    Rule {
        name: "rgb-2",
        about: "no channel of any pixel differs by more than 2 of 255",
        source: "web-platform-tests/wpt docs/writing-tests/reftests.md, Fuzzy Matching, maxDifference; \
                 html/canvas/tools/gentestutilsunion.py, _expand_test_code, has the limit of 2",
        decide: |view| Some(view.count(|a, b| largest(a, b) > 2) == 0),
    },
    Rule {
        name: "same-picture",
        about: "identical to the picture of the version before, which was right",
        source: "mesa/piglit replayer/README.md, Traces definition file, checksum; in the same way Skia Gold, \
                 ui/base/test/skia_gold_matching_algorithm.h of chromium/src, exact",
        decide: |view| Some(view.same()),
    },
    Rule {
        name: "same-fault",
        about: "identical to the picture of the version before, which had the fault already",
        source: "the same",
        decide: |_| Some(true),
    },
    Rule {
        name: "rasterproof",
        about: "every hit of every triangle as declared; values within the derived bounds",
        source: "this project's comparison (docs/verdict.md)",
        decide: |view| Some(own(view)),
    },
];

impl View<'_> {
    /// dEQP's kinds of pixels for the device that drew; none for scenes that it is not about.
    fn covers(&self) -> Option<&[Cover]> {
        let covers = self.seen.covers.as_ref()?;
        Some(&covers[usize::from(self.subject.subpixel_bits() == 4)])
    }

    /// Whether both pictures are identical, which every rule accepts.
    fn same(&self) -> bool {
        self.right.pixels == self.drawn.pixels
    }

    /// In how many pixels the two colours differ, by what a rule calls different.
    fn count(&self, differs: fn([u8; 3], [u8; 3]) -> bool) -> usize {
        self.right.pixels.iter().zip(&self.drawn.pixels).filter(|(a, b)| differs(**a, **b)).count()
    }
}

/// The largest difference in a channel.
fn largest(a: [u8; 3], b: [u8; 3]) -> u8 {
    a[0].abs_diff(b[0]).max(a[1].abs_diff(b[1])).max(a[2].abs_diff(b[2]))
}

/// Whether the first, the middle and the last pixel are as good as the same.
fn samples_agree(right: &Rendering, drawn: &Rendering) -> bool {
    // In a picture of an even height, the middle is below and right of the centre.
    let height = right.pixels.len() / right.width;
    let middle = height / 2 * right.width + right.width / 2;
    let places = [0, middle, right.pixels.len() - 1];
    places.into_iter().all(|place| largest(right.pixels[place], drawn.pixels[place]) <= 1)
}

/// This project's comparison of one scene: hits with the exact ones under the declared convention, and values where both
/// have one. Both engines lie within their bounds of the exact value, so they differ by at most the sum.
fn own(view: &View<'_>) -> bool {
    // How often each triangle hits each pixel more than it should.
    let convention = view.subject.convention();
    let mut hits: HashMap<(usize, i32, i32), i32> = HashMap::new();
    for (i, fragment) in &view.drawn.fragments {
        *hits.entry((*i, fragment.x_px, fragment.y_px)).or_default() += 1;
    }
    for (i, triangle) in view.scene.triangles.iter().enumerate() {
        let corners = view.subject.placed(triangle).corners();
        convention.cover(corners, view.scene.window, |span| {
            for x_px in span.x0_px..span.x1_px {
                *hits.entry((i, x_px, span.y_px)).or_default() -= 1;
            }
        });
    }
    if hits.values().any(|&difference| difference != 0) {
        return false;
    }
    if !view.scene.shows_values() {
        return true;
    }
    // A coarser grid moves the corners, so its values are those of another triangle.
    if view.subject.subpixel_bits() < 8 {
        return true;
    }
    // The right fragment of each pixel of each triangle.
    let mut right = HashMap::new();
    for (i, fragment) in &view.right.fragments {
        right.insert((*i, fragment.x_px, fragment.y_px), fragment);
    }
    // Bounds in f32 depend on how large coordinates are, so on the window.
    let side = f64::from(view.scene.window.width().max(view.scene.window.height()));
    for (i, fragment) in &view.drawn.fragments {
        let Some(right) = right.get(&(*i, fragment.x_px, fragment.y_px)) else { continue };
        let triangle = &view.scene.triangles[*i];
        let bounds = match view.subject.is_single() {
            true => perspective_bounds(triangle, (fragment.x_px, fragment.y_px), side),
            false => double_bounds(triangle),
        };
        let off = (fragment.varying - right.varying).abs();
        let off = [(fragment.depth - right.depth).abs(), off.x, off.y];
        // What is no number lies within no bound.
        if !off.iter().zip(bounds).all(|(off, bound)| *off <= bound) {
            return false;
        }
    }
    true
}

/// What the values of two right engines may differ by: depth, then both attributes.
fn double_bounds(triangle: &Triangle) -> [f64; 3] {
    let v = &triangle.vertices;
    // Of one engine, and so twice that.
    let tolerance::Tolerance { depth, attribute, .. } = tolerance::SCANLINE;
    let depths = depth.at(v.each_ref().map(|v| v.depth));
    let x = attribute.at(v.each_ref().map(|v| v.varying.x));
    let y = attribute.at(v.each_ref().map(|v| v.varying.y));
    [depths + depths, x + x, y + y]
}
