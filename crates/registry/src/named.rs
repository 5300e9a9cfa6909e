//! The named hard cases that need more than corners in the window: P perspective and clipping, given
//! in clip space and brought to the window by the pipeline; M samples, moved onto the centres.
//!
//! [`named`] is the whole catalogue, these after those of [`rasterproof_verify::cases::named`].

use glam::{DVec2, DVec4};

use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_render::pipeline::assemble::{Assembler, Cull};
use rasterproof_render::pipeline::counters::Counters;
use rasterproof_render::pipeline::multisample::{SAMPLES, onto_centre};
use rasterproof_verify::cases::named::{Input, NamedCase, plain_triangle};
use rasterproof_verify::cases::{self, Case, Shape, Triangle};

#[must_use]
pub fn named() -> Vec<NamedCase> {
    [cases::named::named(), perspective(), samples()].concat()
}

/// The named case called `name`.
#[must_use]
pub fn find(name: &str) -> Option<NamedCase> {
    named().into_iter().find(|case| case.name.eq_ignore_ascii_case(name))
}

/// x, y, z and w of a corner in clip space.
type Clip = (f64, f64, f64, f64);
type Px = (f64, f64);

/// A square of 16 x 16 px: clip coordinates of 1/8 w are pixels.
const WINDOW: PixelRect = PixelRect::window(16, 16);

/// A list of named cases from a table: name, what it is about, and what makes the case, with the pixels of each triangle.
macro_rules! table {
    ($($name:literal, $about:literal, $case:expr, $pixels:expr;)*) => {
        vec![$(NamedCase {
            name: $name,
            about: $about,
            input: Input::Drawn { case: $case, pixels: $pixels.to_vec() },
        }),*]
    };
}

/// What the pipeline makes of triangles in clip space.
fn clipped(triangles: &[[Clip; 3]]) -> Case {
    let mut list: Vec<Triangle> = Vec::new();
    for corners in triangles {
        let assembler = Assembler::new(WINDOW, Cull::None);
        let points = corners.map_array(|(x, y, z, w)| assembler.point(DVec4::new(x, y, z, w)));
        let varyings = |_| [DVec2::ZERO, DVec2::X, DVec2::Y];
        let mut counters = Counters::default();
        assembler.assemble(points.each_ref(), varyings, &mut counters, |p| list.push(*p));
    }
    drawn(WINDOW, list)
}

/// A case of triangles whose interiors do not meet.
fn drawn(window: PixelRect, list: Vec<Triangle>) -> Case {
    Case { window, shape: Shape::Triangles { list, disjoint: true } }
}

fn at((x, y): Px) -> SubpixelPoint {
    // The catalogue holds positions inside the domain only.
    SubpixelPoint::from_px(x, y).expect("a catalogued position lies in the domain")
}

/// The same triangle with all coordinates times `scale`: the same place.
fn scaled(corners: [Clip; 3], scale: f64) -> [Clip; 3] {
    corners.map_array(|(x, y, z, w)| (x * scale, y * scale, z * scale, w * scale))
}

/// The cases that begin in clip space: w of other signs and sizes, and planes that cut.
fn perspective() -> Vec<NamedCase> {
    // Small enough that 1/w would overflow a 32-bit grid.
    let eps = 0.5f64.powi(30);
    let hex = f64::from_bits;
    // Corners of the square from (4, 4) to (12, 12) px, from the upper left clockwise.
    let [a, b, c, d] = [(-0.5, 0.5), (0.5, 0.5), (0.5, -0.5), (-0.5, -0.5)];
    // A corner of the square at a depth and a distance, which stays at its place.
    let with = |(x, y): Px, z: f64, w: f64| (x * w, y * w, z * w, w);
    let plain = [with(a, 0.0, 1.0), with(b, 0.0, 1.0), with(c, 0.0, 1.0)];
    let edge = |z: f64, w: f64| [with(a, z, w), with(c, z, w)];
    let [shared_from, shared_to] = edge(0.0, 1.0);
    let tiny = [(16384.48, 0.48), (16384.541, 0.48), (16384.48, 0.541)];
    let far_window = PixelRect { x0: 16380, y0: 0, x1: 16388, y1: 4 };
    // `clip_stack_overflow` of tests/data/book-bugs.json: corners within ulps of planes.
    let overflow = [
        (
            -hex(0x3fdb_eb36_ea27_ad99),
            -hex(0x3fdb_eb36_ea27_ad99),
            hex(0x3fd6_0b72_ae50_45a0),
            hex(0x3fdb_eb36_ea27_ad98),
        ),
        (
            hex(0x3ff5_4745_ca4b_7662),
            -hex(0x3ff5_4745_ca4b_765f),
            -hex(0x4002_9900_398c_6241),
            hex(0x3ff5_4745_ca4b_7661),
        ),
        (
            hex(0x3fea_24f4_4fcf_6ffe),
            -hex(0x4005_be88_0eb6_5e2d),
            -hex(0x3ff9_6287_b229_276d),
            hex(0x3ff9_6287_b229_276d),
        ),
    ];
    let mut flat = plain_triangle([at((0.0, 0.0)), at((16.0, 0.0)), at((0.0, 16.0))]);
    for vertex in &mut flat.vertices {
        vertex.depth = 0.1;
    }
    // Both triangles cover the same pixels.
    // The fields that the table cannot state are changed here.
    let mut twice = clipped(&[scaled(plain, 1e-23), scaled(plain, 1e20)]);
    if let Shape::Triangles { disjoint, .. } = &mut twice.shape {
        *disjoint = false;
    }
    let opposite = [(0.5, 0.5), (8.5, 0.5), (0.5, 8.5)];
    table![
        "P1", "w = 1, 1e-6, 1: the place of w = 1 throughout",
            clipped(&[[with(a, 0.0, 1.0), with(b, 0.0, 1e-6), with(c, 0.0, 1.0)]]), [36];
        "P2", "w = 1, 2^-30, -1: cut before w = 0, nothing from behind the eye",
            clipped(&[[with(d, 0.0, 1.0), with((0.0, 0.5), 0.0, eps), with(c, 0.0, -1.0)]]), [16, 38, 22];
        "P3", "coordinates times 1e-23 and 1e20: products of z leave f32, not the domain here",
            twice, [36, 36];
        "P4", "nvdiffrast#225: of a pair with a shared edge one is clipped, the other is not",
            clipped(&[[shared_from, with(b, 0.0, 1.0), shared_to], [shared_from, shared_to, with(d, -3.0, 1.0)]]),
            [36, 7, 6];
        "P5", "a corner on the near plane, exactly: inside, nothing is cut",
            clipped(&[[with(a, -1.0, 1.0), with(b, 0.0, 1.0), with(c, 0.0, 1.0)]]), [36];
        "P5S", "all six planes and the three edges leave a side: nine corners",
            clipped(&[[(9.25, 20.0, 24.97, 24.5), (12.875, -18.83, 2.54, 4.2), (-3.625, 3.5, -1.77, 0.3)]]),
            [10, 60, 36, 32, 46, 16, 0];
        "P5U", "book-bugs clip_stack_overflow: corners within ulps of planes",
            clipped(&[overflow]), [0];
        "P6", "a triangle .061 px wide, 2^14 px from the origin: one pixel",
            drawn(far_window, vec![plain_triangle(tiny.map_array(at))]), [1];
        "P7", "nvdiffrast 20c4135: samples on the edge opposite a corner: weights add up to 1",
            drawn(WINDOW, vec![plain_triangle(opposite.map_array(at))]), [36];
        "P8", "PCSX2#2980: the same depth at the corners is that depth, to the bit",
            drawn(WINDOW, vec![flat]), [120];
        "P9", "xemu#665: the last two corners fall on one point, w = 1 and w = -0.1",
            clipped(&[[with(a, 0.0, 1.0), with(c, 0.0, 1.0), with(c, 0.0, -0.1)]]), [0, 0, 0];
    ]
}

/// The cases in which a pixel has several samples, each moved onto the centre in turn.
fn samples() -> Vec<NamedCase> {
    // Around pixel (1 + 3 s, 1) a square whose diagonal passes through sample s; moved so that the
    // centres are the samples.
    let mut through: Vec<Triangle> = Vec::new();
    for (s, (x_16th, y_16th)) in SAMPLES.into_iter().enumerate() {
        let x = 1.0 + 3.0 * s as f64 + f64::from(x_16th) / 16.0;
        let y = 1.0 + f64::from(y_16th) / 16.0;
        let corners =
            [(x - 1.0, y - 1.0), (x + 1.0, y - 1.0), (x + 1.0, y + 1.0), (x - 1.0, y + 1.0)];
        let [a, b, c, d] = corners.map_array(|corner| {
            onto_centre(at(corner), (x_16th, y_16th)).expect("far from the domain's end")
        });
        through.extend([plain_triangle([a, b, c]), plain_triangle([a, c, d])]);
    }
    // Edges that rise by two pixels in 64: many centres lie close to them.
    let strip = [
        [(0.0, 0.3), (64.0, 0.3), (64.0, 2.35)],
        [(0.0, 0.3), (64.0, 2.35), (0.0, 2.1)],
        [(0.0, 2.1), (64.0, 2.35), (64.0, 4.0)],
        [(0.0, 2.1), (64.0, 4.0), (0.0, 4.0)],
    ];
    // A pixel as 2 x 2 samples: one belongs to the first triangle, three to the rest.
    let pixel = [
        [(0.0, 0.0), (1.2, 0.0), (0.0, 1.2)],
        [(2.0, 2.0), (0.0, 2.0), (0.0, 1.2)],
        [(2.0, 2.0), (0.0, 1.2), (1.2, 0.0)],
        [(2.0, 2.0), (1.2, 0.0), (2.0, 0.0)],
    ];
    // A list without samples or planes of its own.
    let plain = |list: [[Px; 3]; 4]| {
        list.map_array(|corners| plain_triangle(corners.map_array(at))).to_vec()
    };
    table![
        "M1", "an edge through each of the four sample positions: each sample is hit once",
            drawn(PixelRect::window(13, 4), through), [3, 1, 3, 1, 3, 1, 3, 1];
        "M2", "seams at grazing angles: no sample is lost or drawn twice",
            drawn(PixelRect::window(64, 4), plain(strip)), [85, 43, 68, 60];
        "M3", "a pixel as 2 x 2 samples, a quarter and three quarters: black edges if averaged early",
            drawn(PixelRect::window(2, 2), plain(pixel)), [1, 1, 1, 1];
    ]
}
