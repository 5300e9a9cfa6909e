//! Each rule on pictures whose measure is computed by hand.

use glam::DVec2;

use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_core::triangle::{ScreenTriangle, ScreenVertex};
use rasterproof_faults::planted::TriangleMutant;
use rasterproof_verify::cases::Triangle;

use super::deqp::{self, Cover};
use super::drawing::{Rasterizer, Rendering, draw};
use super::perceptual::{Flip, lab_of_all, pixelmatch, ssim_error};
use super::rules::{RULES, RightPicture, View};
use super::scenes::{Paint, Scene};

const BLACK: [u8; 3] = [0; 3];
const WHITE: [u8; 3] = [255; 3];

fn triangle(corners_px: [[i32; 2]; 3]) -> Triangle {
    let vertex = |[x, y]: [i32; 2]| ScreenVertex {
        position: SubpixelPoint::new(x * 256, y * 256),
        depth: 0.5,
        inv_w: 1.0,
        varying: DVec2::new(0.5, 0.25),
    };
    ScreenTriangle { vertices: corners_px.map(vertex) }
}

fn scene(paint: Paint, side: u32, triangles: Vec<Triangle>) -> Scene {
    let window = PixelRect::window(side, side);
    Scene { of_suites: true, ..Scene::new("by hand".to_owned(), paint, window, triangles) }
}

fn accepts_of(rule: &str, scene: &Scene, right: &Rendering, drawn: &Rendering) -> Option<bool> {
    let seen = RightPicture::new(scene, right);
    let view = View { scene, seen: &seen, right, drawn, subject: &Rasterizer::Reference };
    RULES.iter().find(|own| own.name == rule).unwrap().accepts(&view)
}

/// Whether a rule accepts a picture of one colour after some pixels were changed.
fn accepts(rule: &str, side: u32, changed: &[(usize, [u8; 3])]) -> bool {
    let right = Rendering::of(side as usize, vec![BLACK; (side * side) as usize]);
    let mut drawn = right.clone();
    for (place, colour) in changed {
        drawn.pixels[*place] = *colour;
    }
    accepts_of(rule, &scene(Paint::Values, side, Vec::new()), &right, &drawn).unwrap()
}

#[test]
fn a_share_of_pixels_may_differ() {
    // 50 by 50 pixels: 0.2% are 5. A difference of one level is below 0.004.
    let wrong = |count: usize, colour| (0..count).map(|i| (i * 100, colour)).collect::<Vec<_>>();
    assert!(accepts("0.2%", 50, &wrong(5, [0, 2, 0])));
    assert!(!accepts("0.2%", 50, &wrong(6, [0, 2, 0])));
    assert!(accepts("0.2%", 50, &wrong(25, [1; 3])));
}

#[test]
fn channels_may_differ_by_two() {
    assert!(accepts("rgb-2", 4, &[(0, [2, 0, 2]), (7, [0, 2, 0])]));
    assert!(!accepts("rgb-2", 4, &[(7, [0, 3, 0])]));
    assert!(accepts("same-picture", 4, &[]));
    assert!(!accepts("same-picture", 4, &[(3, [0, 0, 1])]));
    assert!(accepts("same-fault", 4, &[(3, WHITE)]));
}

#[test]
fn samples_are_three_pixels() {
    // Of 4 by 4 pixels the first, the last, and the one at (2, 2) are looked at.
    let others = (0..16).filter(|place| ![0, 10, 15].contains(place));
    assert!(accepts("cts-samples", 4, &others.map(|place| (place, WHITE)).collect::<Vec<_>>()));
    for place in [0, 10, 15] {
        assert!(accepts("cts-samples", 4, &[(place, [1; 3])]));
        assert!(!accepts("cts-samples", 4, &[(place, [2; 3])]));
    }
}

#[test]
fn pixelmatch_counts_what_is_seen() {
    // One white pixel among black ones is not a smoothed edge: 1 of 100 is not fewer than 1%, 1 of 144 is.
    assert!(!accepts("pixelmatch-1%", 10, &[(55, WHITE)]));
    assert!(accepts("pixelmatch-1%", 12, &[(55, WHITE)]));
    // Grey of 26 has Y = 26 and 0.5053 * 26 * 26 = 341.6; the threshold is 352.15, which 27 exceeds with 368.4.
    let grey = |v: u8| (0..100).map(|place| (place, [v; 3])).collect::<Vec<_>>();
    assert!(accepts("pixelmatch-1%", 10, &grey(26)));
    assert!(!accepts("pixelmatch-1%", 10, &grey(27)));
    // A grey column between black and white is taken for a smoothed edge.
    let edge = |grey: u8| {
        let row = [BLACK, BLACK, BLACK, [grey; 3], WHITE, WHITE, WHITE];
        Rendering::of(7, row.repeat(7))
    };
    assert_eq!(pixelmatch(&edge(0), &edge(255), 0.1), 7);
    let mut smoothed = edge(0);
    smoothed.pixels[3 * 7 + 3] = [120; 3];
    assert_eq!(pixelmatch(&edge(0), &smoothed, 0.1), 0);
}

#[test]
fn flip_of_flat_pictures() {
    // Without edges FLIP is the colour's part alone. Black and white are 100 apart in L*; 100^0.7 = 25.1189, the largest
    // distance 308.0 of green and blue (after Hunt: L* 87.73 and 32.30) raised to 0.7 is 41.276, its 0.4 is 16.510, so
    // the error is 0.95 + 0.05 (25.1189 - 16.510) / (41.276 - 16.510) = 0.9674.
    let flat = |colour| vec![colour; 64];
    let black = Flip::new(8, &flat(BLACK));
    assert!((black.mean(8, &flat(WHITE)) - 0.9674).abs() < 1e-3, "{}", black.mean(8, &flat(WHITE)));
    assert!(black.mean(8, &flat(BLACK)).abs() < 1e-9);
    let all = |colour| (0..64).map(|place| (place, colour)).collect::<Vec<_>>();
    // Grey of 1 has L* = 0.2742, and 0.2742^0.7 * 0.95 / 16.510 = 0.0233; nothing is 0.
    assert!(!accepts("flip-0.02", 8, &all([1; 3])) && accepts("flip-0.02", 8, &all(BLACK)));
}

#[test]
fn ssim_of_flat_pictures() {
    // L* is 100 and 0, without variance: SSIM = (0 + 100) / (100 * 100 + 100) = 1/101 everywhere, 100/101 from 1. The
    // histogram is one bin, the 100th of 199, at a distance of sqrt(99/199) = 0.705, which is less.
    let flat = |colour| lab_of_all(&[colour; 64]);
    let error = ssim_error(8, &flat(BLACK), &flat(WHITE));
    assert!((error - 100.0 / 101.0).abs() < 1e-4, "{error}");
    assert!(ssim_error(8, &flat(WHITE), &flat(WHITE)) < 1e-12);
    let all: Vec<_> = (0..64).map(|place| (place, WHITE)).collect();
    assert!(!accepts("ssim-0.05", 8, &all) && accepts("ssim-0.05", 8, &[]));
    // One pixel in a corner of 64 by 64 is in the discs of 37 pixels; the square of 1 - SSIM is at most 4, so the root
    // mean square is at most sqrt(37 * 4 / 4096) = 0.19; L* 2.7 is far below the constants that keep SSIM steady.
    assert!(accepts("ssim-0.05", 64, &[(0, [10; 3])]));
}

/// The lower left half of 4 by 4 pixels: the long edge runs through the centres of the diagonal.
fn half() -> Scene {
    scene(Paint::White, 4, vec![triangle([[0, 0], [4, 0], [0, 4]])])
}

#[test]
fn deqp_leaves_pixels_near_edges_open() {
    let scene = half();
    let covers = deqp::covers(&scene.triangles, scene.window, 8);
    for (place, cover) in covers.iter().enumerate() {
        let expected = match place % 4 + place / 4 {
            0..3 => Cover::Full,
            3 => Cover::Partial,
            _ => Cover::None,
        };
        assert_eq!(*cover, expected, "pixel {place}");
    }
    let right = draw(&Rasterizer::Reference, &scene);
    let with = |places: &[usize], colour| {
        let mut drawn = right.clone();
        places.iter().for_each(|&place| drawn.pixels[place] = colour);
        ["deqp-strict", "deqp-weak"].map(|rule| accepts_of(rule, &scene, &right, &drawn).unwrap())
    };
    assert_eq!(with(&[3, 9], BLACK), [true, true]);
    assert_eq!(with(&[3, 9], WHITE), [true, true]);
    assert_eq!(with(&[0], BLACK), [false, true]);
    assert_eq!(with(&[15, 7], WHITE), [false, true]);
    // Six pixels are missing, which the weak mode would allow, but nothing at all is drawn.
    assert_eq!(with(&(0..16).collect::<Vec<_>>(), BLACK), [false, false]);
    // A column of 12 wrong pixels is more than 10.
    let tall = self::scene(Paint::White, 16, vec![triangle([[0, 0], [8, 0], [0, 8]])]);
    let covers = deqp::covers(&tall.triangles, tall.window, 8);
    let mut drawn = draw(&Rasterizer::Reference, &tall);
    (0..10).for_each(|y| drawn.pixels[y * 16 + 15] = WHITE);
    assert!(deqp::accepts(&covers, &drawn.pixels, deqp::WEAK));
    drawn.pixels[10 * 16 + 15] = WHITE;
    assert!(!deqp::accepts(&covers, &drawn.pixels, deqp::WEAK));
    assert_eq!(
        accepts_of("deqp-strict", &self::scene(Paint::Add, 4, vec![]), &right, &right),
        None
    );
}

#[test]
fn deqp_wants_shared_edges_filled() {
    // A square of 8 by 8 pixels in two halves. On the diagonal, (4, 3) is near the shared edge alone and has to be drawn;
    // (0, 7) is near two others and may be left out.
    let halves = [[[0, 0], [8, 0], [0, 8]], [[8, 0], [8, 8], [0, 8]]].map(triangle);
    let window = PixelRect::window(8, 8);
    let covers = deqp::covers(&halves, window, 8);
    assert_eq!((covers[3 * 8 + 4], covers[7 * 8]), (Cover::Full, Cover::Partial));
    assert_eq!(deqp::covers(&halves[..1], window, 8)[3 * 8 + 4], Cover::Partial);
}

#[test]
fn deqp_adds_once() {
    let (once, twice) = ([127; 3], [254; 3]);
    assert!(deqp::added_once(&[BLACK, once], false) && !deqp::added_once(&[BLACK, once], true));
    assert!(deqp::added_once(&[once, once], true) && !deqp::added_once(&[once, twice], false));
}

#[test]
fn the_own_rule_counts_hits_and_compares_values() {
    let halves = [[[0, 0], [8, 0], [0, 8]], [[8, 0], [8, 8], [0, 8]]].map(triangle).to_vec();
    let scene = scene(Paint::Values, 8, halves);
    let right = draw(&Rasterizer::Reference, &scene);
    let accepts = |change: &dyn Fn(&mut Rendering)| {
        let mut drawn = right.clone();
        change(&mut drawn);
        accepts_of("rasterproof", &scene, &right, &drawn).unwrap()
    };
    assert!(accepts(&|_| {}));
    // The picture is the same in each of these, and every other rule accepts it.
    assert!(!accepts(&|drawn| drawn.fragments.push(drawn.fragments[5])));
    assert!(!accepts(&|drawn| drawn.fragments[5].0 ^= 1));
    // Twice u (12 D + 2 M) with D = 0 and M = 1/2 is 2 u: the value, near which doubles are u apart, may move by one of
    // them, and not by three.
    let moved =
        |doubles: f64| accepts(&|drawn| drawn.fragments[5].1.depth += doubles * f64::EPSILON / 2.0);
    assert!(moved(1.0) && !moved(3.0));
    let planted = draw(&Rasterizer::Planted(TriangleMutant::InclusiveEdges), &scene);
    assert_eq!(accepts_of("same-picture", &scene, &right, &planted), Some(true));
    assert_eq!(accepts_of("rasterproof", &scene, &right, &planted), Some(false));
}

#[test]
fn a_program_that_panics_is_refused_by_every_rule() {
    let scene = scene(Paint::White, 8, vec![triangle([[4, 0], [8, 8], [0, 8]])]);
    let right = draw(&Rasterizer::Reference, &scene);
    let drawn = draw(&Rasterizer::Planted(TriangleMutant::PanicsOnFlatBottom), &scene);
    for rule in &RULES {
        assert!(accepts_of(rule.name, &scene, &right, &drawn).is_none_or(|accepts| !accepts));
    }
}
