//! The named hard cases: T ties, S slivers, O size and overflow, L lines.
//!
//! Each has its source and the result it must give. `owner#n` is the public issue a case comes
//! from. Positions are window pixels, y down; what does not lie on the lattice is snapped to it.

use glam::DVec2;

use super::{Case, Line, Shape, Triangle};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_core::triangle::{LineEnd, PixelPoint, ScreenLine, ScreenTriangle, ScreenVertex};

/// A hard case with a name.
#[derive(Clone, Debug)]
pub struct NamedCase {
    /// Its name on the command line.
    pub name: &'static str,
    /// Where it comes from and what it threatens.
    pub about: &'static str,
    /// What is put in, and what must come out.
    pub input: Input,
}

/// What a named case puts in.
#[derive(Clone, Debug)]
pub enum Input {
    /// Something to draw, with the number of pixels each triangle or line must light in the window.
    Drawn {
        /// What is drawn.
        case: Case,
        /// Pixels for each triangle or line, in order.
        pixels: Vec<u64>,
    },
    /// Corners in pixels that must be refused with a reason.
    Refused(Vec<[[f64; 2]; 3]>),
}

/// Every named case, in the order of the catalogue.
#[must_use]
pub fn named() -> Vec<NamedCase> {
    [ties(), slivers(), sizes(), lines()].concat()
}

/// The named case called `name`.
#[must_use]
pub fn find(name: &str) -> Option<NamedCase> {
    named().into_iter().find(|case| case.name.eq_ignore_ascii_case(name))
}

type Px = (f64, f64);

/// A triangle with simple values: depth 0, 1/2, 1; w 1, 2, 4; attributes that tell the corners apart.
#[must_use]
pub fn plain_triangle(corners: [SubpixelPoint; 3]) -> Triangle {
    let values = [(0.0, 1.0, DVec2::ZERO), (0.5, 0.5, DVec2::X), (1.0, 0.25, DVec2::Y)];
    ScreenTriangle {
        vertices: [0, 1, 2].map_array(|i| {
            let (depth, inv_w, varying) = values[i];
            ScreenVertex { position: corners[i], depth, inv_w, varying }
        }),
    }
}

/// A line with simple values: depth and the first attribute from 0 to 1.
#[must_use]
pub fn plain_line(a: PixelPoint, b: PixelPoint) -> Line {
    ScreenLine {
        ends: [
            LineEnd { pixel: a, depth: 0.0, varying: DVec2::ZERO },
            LineEnd { pixel: b, depth: 1.0, varying: DVec2::new(1.0, 100.0) },
        ],
    }
}

fn at((x, y): Px) -> SubpixelPoint {
    // The catalogue below holds positions inside the domain only.
    SubpixelPoint::from_px(x, y).expect("a catalogued position lies in the domain")
}

/// A list of named cases from a table: name, what it is about, window, triangles or lines, and the pixels of each of them
/// where they are stated.
macro_rules! table {
    ($draw:ident: $($name:literal, $about:literal, $window:expr, $shapes:expr, $pixels:expr;)*) => {
        vec![$(drawn($name, $about, $window, $draw($shapes), &$pixels)),*]
    };
}

fn drawn(
    name: &'static str,
    about: &'static str,
    window: PixelRect,
    shape: Shape,
    pixels: &[u64],
) -> NamedCase {
    let input = Input::Drawn { case: Case { window, shape }, pixels: pixels.to_vec() };
    NamedCase { name, about, input }
}

fn meshed(triangles: &[[Px; 3]], disjoint: bool) -> Shape {
    let list = triangles.iter().map(|corners| plain_triangle(corners.map_array(at))).collect();
    Shape::Triangles { list, disjoint }
}

fn disjoint(triangles: &[[Px; 3]]) -> Shape {
    meshed(triangles, true)
}

fn overlapping(triangles: &[[Px; 3]]) -> Shape {
    meshed(triangles, false)
}

fn segments(lines: &[[i32; 4]]) -> Shape {
    let point = PixelPoint::new;
    let lines = lines.iter().map(|&[ax, ay, bx, by]| plain_line(point(ax, ay), point(bx, by)));
    Shape::Lines(lines.collect())
}

/// The closed fan around `centre` through the given spokes.
fn fan(centre: Px, spokes: &[Px]) -> Vec<[Px; 3]> {
    let tip = |i: usize| {
        let (x, y) = spokes[i % spokes.len()];
        (centre.0 + x, centre.1 + y)
    };
    (0..spokes.len()).map(|i| [centre, tip(i), tip(i + 1)]).collect()
}

/// The eight triangles of T1, arms of three subpixels.
fn octants(centre: Px) -> Vec<[Px; 3]> {
    const A: f64 = 3.0 / 256.0;
    fan(centre, &[(A, 0.0), (A, A), (0.0, A), (-A, A), (-A, 0.0), (-A, -A), (0.0, -A), (A, -A)])
}

fn square((x, y): Px, side: f64) -> [Px; 4] {
    [(x, y), (x + side, y), (x + side, y + side), (x, y + side)]
}

const fn win(width: u32, height: u32) -> PixelRect {
    PixelRect::window(width, height)
}

fn ties() -> Vec<NamedCase> {
    let sub = 1.0 / 256.0;
    // One shifted fan in each of eight pixels, two apart.
    let shifts = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1)];
    let shifted: Vec<_> = (0..8)
        .flat_map(|i| {
            let (dx, dy) = shifts[i];
            octants((0.5 + 2.0 * i as f64 + f64::from(dx) * sub, 0.5 + f64::from(dy) * sub))
        })
        .collect();
    let s = 3f64.sqrt() * 3.0;
    let quarter = [(6.0, 0.0), (s, 3.0), (3.0, s)];
    let turns: [fn(Px) -> Px; 4] = [|p| p, |(x, y)| (-y, x), |(x, y)| (-x, -y), |(x, y)| (y, -x)];
    let twelve: Vec<Px> = turns.into_iter().flat_map(|turn| quarter.map(turn)).collect();
    let [a, b, c, d] = square((0.0, 0.0), 4.0);
    let [e, f, g, h] = square((6.0, 0.0), 4.0);
    let [p, q, r, o] = [
        (0.07318455, 0.33821934),
        (0.2277621, 0.6909972),
        (0.65824705, 0.83747554),
        (0.023455322, 0.97718465),
    ]
    .map(|(x, y): Px| (x * 64.0, y * 64.0));
    table![disjoint:
        "T1", "eight triangles meet in the centre (0.5, 0.5), arms 3/256: exactly one of them owns it",
            win(2, 2), &octants((0.5, 0.5)), [1, 0, 0, 0, 0, 0, 0, 0];
        "T2", "a square with corners on centres, split: 15 + 10",
            win(8, 8), &[[(0.5, 0.5), (5.5, 0.5), (5.5, 5.5)], [(0.5, 5.5), (0.5, 0.5), (5.5, 5.5)]], [15, 10];
        "T3", "DRTK#9 moved by half a pixel and snapped: two halves of a 6 x 6 square, overlap 0",
            win(8, 8),
            &[[(1.0, 0.99993896484375), (1.0, 7.0), (7.00006103515625, 0.99993896484375)],
              [(7.00006103515625, 0.99993896484375), (1.0, 7.0), (7.00006103515625, 7.0)]],
            [15, 21];
        "T4", "two triangles share a flat edge on a row of centres: 820 + 480, row 30 has 40",
            win(64, 76), &[[(10.5, 30.5), (50.5, 30.5), (30.5, 70.5)], [(10.5, 30.5), (50.5, 30.5), (30.5, 5.5)]],
            [820, 480];
        "T5", "euc#17, times 64: three triangles around a common corner",
            win(64, 64), &[[p, q, r], [p, q, o], [q, r, o]], [];
        "T6", "a closed fan of twelve spokes around the centre (8.5, 8.5), radius 6: 110 pixels, each once",
            win(17, 17), &fan((8.5, 8.5), &twelve), [];
        "T7", "T1 moved by a subpixel in each of eight directions: one hit each",
            win(17, 2), &shifted, [];
        "T8", "the square 0..4 split on either diagonal: 16 pixels, each once",
            win(11, 5), &[[a, b, c], [a, c, d], [e, f, h], [f, g, h]], [];
    ]
}

fn slivers() -> Vec<NamedCase> {
    let sub = 1.0 / 256.0;
    let needles: Vec<[Px; 3]> = (0..8)
        .map(|k| {
            let k = f64::from(k);
            [(0.0, k), (0.0, k + 1.0), (64.0, k + 0.5)]
        })
        .collect();
    let boxes = |side: f64, corner: &dyn Fn(f64, f64) -> Px| -> Vec<[Px; 3]> {
        (0..64)
            .flat_map(|n| {
                let (i, j) = (f64::from(n % 8), f64::from(n / 8));
                let [a, b, c, d] = square(corner(i, j), side);
                [[a, b, c], [a, c, d]]
            })
            .collect()
    };
    let phases = boxes(0.5, &|i, j| (2.0 * i + i / 8.0, 2.0 * j + j / 8.0));
    let [a, b, c, d] = square((0.6, 0.6), 0.8);
    table![disjoint:
        "S1", "AMDVLK#246: needles from the left border, 64 px each",
            win(64, 8), &needles, [64; 8];
        "S2", "63 px long, one subpixel high: no pixel",
            win(64, 2), &[[(0.0, 0.0), (63.0, sub), (63.0, 0.0)]], [0];
        "S3", "three corners on a line: no pixel",
            win(9, 9), &[[(0.0, 0.0), (4.0, 4.0), (8.0, 8.0)]], [0];
        "S4", "two corners coincide on a centre: no pixel",
            win(4, 4), &[[(0.5, 0.5), (0.5, 0.5), (3.0, 3.0)]], [0];
        "S5", "assimp PR456: a height of 0.0001 px, flat after snapping",
            win(4, 4), &[[(0.0, 0.68), (1.8, 0.6799), (1.8, 0.68)]], [0];
        "S6", "nvdiffrast#89: half-pixel boxes at every phase of an eighth: 16 pixels",
            win(18, 18), &phases, [];
        "S7", "a box between centres: no pixel",
            win(3, 3), &[[a, b, c], [a, c, d]], [0, 0];
        "S8", "the winding of (0,0)(1,.001)(2,.0019) does not survive snapping: flat, no pixel",
            win(4, 2), &[[(0.0, 0.0), (1.0, 0.001), (2.0, 0.0019)]], [0];
        "S9", "a T-junction: (0,0)-(10,3) split at (5, 1.5) one subpixel too low; the gap holds no centre",
            win(12, 9),
            &[[(0.0, 0.0), (10.0, 0.0), (10.0, 3.0)],
              [(0.0, 0.0), (5.0, 1.5 + sub), (0.0, 8.0)],
              [(5.0, 1.5 + sub), (10.0, 3.0), (0.0, 8.0)]],
            [];
        "S10", "zero height on a row of centres: no pixel",
            win(12, 6), &[[(2.0, 3.5), (9.0, 3.5), (5.0, 3.5)]], [0];
        "S11", "the book's figure 2-4, moved by half a pixel: flat after snapping, where the unclamped book code reaches from column -37,495 to 40,004",
            win(8, 6), &[[(4.75, 3.49999), (4.0, 3.50001), (5.55, 3.50001)]], [0];
    ]
}

fn sizes() -> Vec<NamedCase> {
    let far = PixelRect { x0: 16384, y0: 0, x1: 16484, y1: 300 };
    let (nan, inf, tiny) = (f64::NAN, f64::INFINITY, f64::MIN_POSITIVE / 2.0);
    let base = [[1.0, 2.0], [9.0, 3.0], [4.0, 8.0]];
    let spoilt = |bad: f64| {
        (0..6).map(move |i| {
            let mut corners = base;
            corners[i / 2][i % 2] = bad;
            corners
        })
    };
    let refused = |name, about, corners| NamedCase { name, about, input: Input::Refused(corners) };
    let overlapping = table![overlapping:
        "O1", "twice the area overflows i32 at 182 px, not at 181: 16,471 and 16,290 px",
            win(184, 184), &[[(0.0, 0.0), (182.0, 0.0), (0.0, 182.0)], [(0.0, 0.0), (181.0, 0.0), (0.0, 181.0)]],
            [16_471, 16_290];
    ];
    let large = table![disjoint:
        "O2", "a large oblique triangle: 13,394 px",
            win(320, 240), &[[(314.0, 11.0), (14.0, 200.0), (97.0, 237.0)]], [13_394];
        "O3", "at 16,384 px from the origin an f32 plane equation has 0.8% wrong signs",
            PixelRect { x0: 16384, y0: 16384, x1: 16416, y1: 16416 },
            &[[(16385.3, 16386.7), (16413.1, 16390.2), (16399.9, 16414.6)]], [];
        "O4", "two triangles on an edge through (17.5, 47.5) almost: f32 edge functions hit it twice",
            win(32, 64),
            &[[(25.630945, 61.71053), (5.298825, 26.17589), (5.298825, 61.71053)],
              [(25.630945, 61.71053), (5.298825, 26.17589), (25.630945, 26.17589)]],
            [];
        "O5", "two triangles on an edge through (29.5, 18.5) almost: f32 edge functions leave a crack",
            win(56, 40),
            &[[(6.329233, 35.83448), (51.395065, 2.1198945), (6.329233, 2.1198945)],
              [(6.329233, 35.83448), (51.395065, 2.1198945), (51.395065, 35.83448)]],
            [];
        "O6", "an edge from (16384, 0) to (16484, 300): f32 stepping gets 99 of 300 rows wrong",
            far, &[[(16384.0, 0.0), (16484.0, 300.0), (16384.0, 300.0)]], [];
        "O7", "keeperfx PR4668: x = -32768 and 32768",
            win(64, 64), &[[(-32768.0, 0.0), (32768.0, 10.0), (0.0, 60.0)]], [];
    ];
    let refused = vec![
        refused(
            "O8",
            "tiny-skia#167: a corner 693,631,800 px away is outside the domain",
            vec![[[1221.5938, 534.0], [1224.7139, -693_631_800.0], [1225.0, 534.0]]],
        ),
        refused(
            "O9",
            "xemu PR2510: coordinates of 1e22",
            vec![[[0.0, 0.0], [1e22, 0.0], [0.0, 1e22]], [[-1e22, 5.0], [3.0, 0.0], [0.0, 9.0]]],
        ),
        refused(
            "O10",
            "NaN and infinities in every component (-0 and denormals snap to 0 and are drawn: O10Z)",
            [nan, inf, -inf].into_iter().flat_map(spoilt).collect(),
        ),
    ];
    let drawn_again = table![disjoint:
        "O10Z", "-0 and denormals are the point 0: the half square of 4 px, 10 centres less the 4 on its right edge",
            win(5, 5), &[[(-0.0, tiny), (4.0, -tiny), (-tiny, 4.0)]], [6];
        "O11", "8,000 px wide, where Mesa 22.3's lavapipe loses pixels: the whole window",
            win(64, 64), &[[(0.0, 0.0), (8000.0, 0.0), (0.0, 8000.0)]], [4096];
    ];
    [overlapping, large, refused, drawn_again].concat()
}

fn lines() -> Vec<NamedCase> {
    table![segments:
        "L1", "(0,0) to (8,3) and back: the same nine pixels",
            win(10, 5), &[[0, 0, 8, 3], [8, 3, 0, 0]], [9, 9];
        "L2", "(-100,20) to (30,40) and back, clipped at the left border: columns 0 to 30",
            win(64, 48), &[[-100, 20, 30, 40], [30, 40, -100, 20]], [31, 31];
        "L3", "(0,6) to (6,0): a diagonal upwards",
            win(8, 8), &[[0, 6, 6, 0]], [7];
        "L4", "(0,0) to (10,1): one step, at the tie in column 5",
            win(12, 3), &[[0, 0, 10, 1]], [11];
        "L5", "(0,10) to (255,10): horizontal",
            win(256, 12), &[[0, 10, 255, 10]], [256];
        "L6", "(0,0) to (6,1): a 16.16 DDA is wrong at column 3",
            win(8, 3), &[[0, 0, 6, 1]], [7];
        "L7", "(0,0) to (353,337): an f32 DDA gives row 327 at column 342, exact is 326",
            win(354, 338), &[[0, 0, 353, 337]], [354];
        "L8", "zero length: one pixel, weight 0",
            win(8, 8), &[[3, 4, 3, 4]], [1];
        "L9", "the outline of a rectangle, each side one pixel short: corners once",
            win(12, 10), &[[2, 2, 8, 2], [9, 2, 9, 6], [9, 7, 3, 7], [2, 7, 2, 3]], [7, 5, 7, 5];
        "L10", "ends a billion pixels outside, bounded work: the diagonal of the window moved by 10",
            win(64, 64), &[[-1_000_000_000, -999_999_990, 1_000_000_000, 1_000_000_010]], [54];
    ]
}
