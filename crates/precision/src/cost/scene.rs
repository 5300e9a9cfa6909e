//! The classes of scenes, each of which isolates one cost or one danger.
//!
//! A scene is a pure function of (class, seed, size), on every machine: additions, multiplications
//! and square roots only, all of which round alike everywhere. Corners are exactly f32, so that no
//! choice in f32 starts with a rounding of its input; but for half of the corners of `tie` and `mesh`,
//! which are any f64, since an f64 choice cannot fail on corners of 24 bits.

use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::random::Rng;
use rasterproof_core::triangle::FreeCorners;

/// Triangles that every choice of a group is measured on.
#[derive(Clone, Debug)]
pub struct Scene {
    pub name: &'static str,
    pub about: &'static str,
    pub bounds: PixelRect,
    pub triangles: Vec<FreeCorners>,
    /// w of each corner, in [1, ratio]; f32.
    pub w: Vec<[f64; 3]>,
    /// A value at each corner; none at all where values are made of the positions.
    pub values: Vec<[f64; 3]>,
    /// Where the triangles tile a region by shared edges: pixels well inside of it.
    pub interior: Option<PixelRect>,
}

impl Scene {
    /// Classes whose names begin so differ from the others by their w alone.
    pub(super) fn is_of_coverage(&self) -> Result<(), String> {
        match self.name.starts_with("w ") {
            true => Err("coverage does not depend on w".to_owned()),
            false => Ok(()),
        }
    }
}

/// How large a scene is: its window in pixels and about how much of it is covered.
#[derive(Clone, Copy, Debug)]
pub struct Size {
    pub side_px: u32,
    pub pixels: u64,
}

type Point = [f64; 2];
type Corners = [Point; 3];

/// A class: its name, what it is, the largest w, and how it is made.
type Class = (&'static str, &'static str, f64, fn(&mut Rng, &Size) -> Vec<Corners>);

const CLASSES: [Class; 12] = [
    ("large", "a tenth of the window each", 4.0, large),
    ("25 px", "25 px each", 4.0, |rng, size| compact(rng, size, 25.0)),
    ("<8 px", "under 8 px each", 4.0, small),
    ("sliver", "half a window long, 1/2 to 2 px wide", 4.0, sliver),
    ("half", "corners on pixel centres: ties everywhere", 4.0, half),
    ("tie", "an edge through a sample, an end moved by at most an ulp of f32 or f64", 4.0, tie),
    ("far", "1000 px each, 2^14 px from the origin", 4.0, thousand),
    ("mesh", MESH, 4.0, mesh),
    ("w 1", "1000 px each, equal w", 1.0, thousand),
    ("w 4", "1000 px each, w ratio up to 4", 4.0, thousand),
    ("w 100", "1000 px each, w ratio up to 100", 100.0, thousand),
    ("w 1e4", "1000 px each, w ratio up to 10,000", 1e4, thousand),
];

const MESH: &str = "a net of shared edges, many through or past a sample by an ulp of f32 or f64";

/// All classes, of one size.
pub fn scenes(seed: u64, size: Size) -> Vec<Scene> {
    CLASSES.iter().map(|class| scene(class, seed, size)).collect()
}

fn scene(&(name, about, ratio, make): &Class, seed: u64, size: Size) -> Scene {
    let mut rng = Rng::new(name, seed, 0);
    let corners = make(&mut rng, &size);
    let offset = if name == "far" { FAR_PX } else { 0 };
    let has_ties = matches!(name, "tie" | "mesh");
    let round = |v: f64| if has_ties { v } else { f32_of(v) };
    let to = offset + size.side_px as i32;
    let triangles: Vec<_> = corners
        .into_iter()
        .map(|corners| corners.map_array(|p| p.map_array(|v| round(v + f64::from(offset)))))
        .filter_map(|corners| FreeCorners::new(corners).ok())
        .collect();
    let w = triangles.iter().map(|_| [(); 3].map_array(|()| spread(&mut rng, ratio))).collect();
    Scene {
        name,
        about,
        bounds: PixelRect { x0: offset, y0: offset, x1: to, y1: to },
        triangles,
        w,
        values: Vec::new(),
        interior: (name == "mesh").then(|| interior(&size)),
    }
}

/// How far from the origin the window of the class `far` begins.
const FAR_PX: i32 = 1 << 14;

/// A w in [1, ratio], often one of the ends, since the whole ratio is the danger.
fn spread(rng: &mut Rng, ratio: f64) -> f64 {
    match rng.int(0, 2) {
        0 => 1.0,
        1 => ratio,
        _ => f32_of(1.0 + (ratio - 1.0) * rng.unit()),
    }
}

/// The nearest number of 24 bits.
fn f32_of(v: f64) -> f64 {
    f64::from(v as f32)
}

/// Triangles of a tenth of the window each.
fn large(rng: &mut Rng, size: &Size) -> Vec<Corners> {
    let side = f64::from(size.side_px);
    compact(rng, size, side * side / 10.0)
}

/// Areas of 1 to 8 px.
fn small(rng: &mut Rng, size: &Size) -> Vec<Corners> {
    placed(rng, size, size.pixels / 4, |rng| {
        let area_px = 1.0 + 7.0 * rng.unit();
        shape(rng, area_px)
    })
}

/// Triangles of 1000 px each.
fn thousand(rng: &mut Rng, size: &Size) -> Vec<Corners> {
    compact(rng, size, 1000.0)
}

/// As many triangles of an area as cover about the pixels that are asked for, at least two.
fn compact(rng: &mut Rng, size: &Size, area_px: f64) -> Vec<Corners> {
    let count = (size.pixels / area_px as u64).max(2);
    placed(rng, size, count, |rng| shape(rng, area_px))
}

/// A triangle of the given area that is not thin: three points of a square, scaled.
fn shape(rng: &mut Rng, area_px: f64) -> Corners {
    loop {
        let [a, b, c] = [(); 3].map_array(|()| [rng.unit(), rng.unit()]);
        let area = ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs() / 2.0;
        // The largest triangle in the unit square has area 1/2.
        if area > 0.25 {
            let scale = (area_px / area).sqrt();
            return [a, b, c].map_array(|p| p.map_array(|v| v * scale));
        }
    }
}

/// So many shapes, each put somewhere in the window, a pixel away from its border at least.
fn placed(
    rng: &mut Rng,
    size: &Size,
    count: u64,
    shape: impl Fn(&mut Rng) -> Corners,
) -> Vec<Corners> {
    let place = |_| {
        let shape = shape(rng);
        let mut offset = |axis: usize| {
            let [a, b, c] = shape.map_array(|p| p[axis]);
            let (min, max) = (a.min(b).min(c), a.max(b).max(c));
            1.0 - min + rng.unit() * (f64::from(size.side_px) - 2.0 - (max - min)).max(0.0)
        };
        let (dx, dy) = (offset(0), offset(1));
        shape.map_array(|[x, y]| [x + dx, y + dy])
    };
    (0..count).map(place).collect()
}

/// Triangles half a window long and 1/2 to 2 px wide.
fn sliver(rng: &mut Rng, size: &Size) -> Vec<Corners> {
    let length = f64::from(size.side_px) / 2.0;
    // A quarter of the pixels: the bounding box of a sliver holds many times more.
    let count = (size.pixels as f64 / (length * 2.4)).max(8.0) as u64;
    placed(rng, size, count, |rng| {
        // Within the unit circle, so that no direction is preferred.
        loop {
            let (x, y) = (rng.signed(), rng.signed());
            let norm = (x * x + y * y).sqrt();
            if norm > 0.1 && norm < 1.0 {
                let (x, y, half) = (x / norm, y / norm, (0.5 + 1.5 * rng.unit()) / 2.0);
                return [[x * length, y * length], [-y * half, x * half], [y * half, -x * half]];
            }
        }
    })
}

/// Corners on centres within a box of 32 px.
fn half(rng: &mut Rng, size: &Size) -> Vec<Corners> {
    (0..size.pixels / 80)
        .map(|_| {
            let shape = [(); 3].map_array(|()| [(); 2].map_array(|()| rng.int(0, 31) as f64));
            let mut corner = || rng.int(1, i64::from(size.side_px) - 34) as f64 + 0.5;
            let (dx, dy) = (corner(), corner());
            shape.map_array(|[x, y]| [x + dx, y + dy])
        })
        .collect()
}

/// The float that a corner is rounded to, and by whose steps it is nudged.
#[derive(Clone, Copy)]
enum Grain {
    F32,
    F64,
}

impl Grain {
    fn any(rng: &mut Rng) -> Self {
        if rng.chance(2) { Self::F32 } else { Self::F64 }
    }

    fn round(self, v: f64) -> f64 {
        match self {
            Self::F32 => f32_of(v),
            Self::F64 => v,
        }
    }

    fn nudge(self, rng: &mut Rng, v: f64) -> f64 {
        let choice = rng.int(0, 2) as usize;
        match self {
            Self::F32 => {
                let v = v as f32;
                f64::from([v.next_down(), v, v.next_up()][choice])
            }
            Self::F64 => [v.next_down(), v, v.next_up()][choice],
        }
    }

    /// The point as far behind the sample `s` as `a` is before it, or twice as far; nudged. (At equal
    /// distances the products of an edge function are equal however they round.)
    fn mirror(self, rng: &mut Rng, a: Point, s: Point, times: f64) -> Point {
        let [x, y] = [0, 1].map_array(|i| self.round(s[i] + times * (s[i] - a[i])));
        [self.nudge(rng, x), self.nudge(rng, y)]
    }
}

/// Triangles of which one edge runs through a sample, or past it by a step of a float.
fn tie(rng: &mut Rng, size: &Size) -> Vec<Corners> {
    let side = i64::from(size.side_px);
    (0..size.pixels / 130)
        .map(|_| {
            let s = [(); 2].map_array(|()| rng.int(26, side - 27) as f64 + 0.5);
            let grain = Grain::any(rng);
            let near =
                |rng: &mut Rng, reach: f64| s.map_array(|v| grain.round(v + reach * rng.signed()));
            let a = near(rng, 12.0);
            let times = rng.int(1, 2) as f64;
            let b = grain.mirror(rng, a, s, times);
            let mut corners = [a, b, near(rng, 24.0)];
            corners.rotate_left(rng.int(0, 2) as usize);
            corners
        })
        .collect()
}

/// The side of a cell of the net.
const CELL_PX: f64 = 16.0;

/// How many cells the net has on a side.
fn cells(size: &Size) -> usize {
    let most = f64::from(size.side_px.max(48) - 16) / CELL_PX;
    ((size.pixels as f64).sqrt() / CELL_PX).clamp(2.0, most) as usize
}

/// The pixels of the net that its outline cannot reach: vertices are within 6 px of their places, a
/// sample's rounding and a neighbour's offset tripled.
fn interior(size: &Size) -> PixelRect {
    let end = 8 + 16 * cells(size) as i32;
    PixelRect { x0: 8 + 7, y0: 8 + 7, x1: end - 7, y1: end - 7 }
}

/// A net of cells of about 16 px. Every second vertex is its neighbour mirrored at a sample, so that
/// the edge between them passes through the sample, or past it by an ulp.
fn mesh(rng: &mut Rng, size: &Size) -> Vec<Corners> {
    let cells = cells(size);
    let mut net: Vec<Vec<Point>> = Vec::new();
    for j in 0..=cells {
        let mut row: Vec<Point> = Vec::new();
        for i in 0..=cells {
            let at = [i, j].map_array(|k| 8.0 + CELL_PX * k as f64);
            let grain = Grain::any(rng);
            let free = at.map_array(|v| grain.round(v + 1.5 * rng.signed()));
            let times = rng.int(1, 2) as f64;
            // How far before this vertex the sample lies.
            let back = CELL_PX * times / (1.0 + times);
            let neighbour = match (i, j) {
                _ if (i + j) % 2 == 0 => None,
                (0, _) => Some((net[j - 1][i], [at[0], at[1] - back])),
                _ => Some((row[i - 1], [at[0] - back, at[1]])),
            };
            row.push(match neighbour {
                None => free,
                Some((a, s)) => grain.mirror(rng, a, s.map_array(|v| v.floor() + 0.5), times),
            });
        }
        net.push(row);
    }
    let mut corners = Vec::new();
    for j in 0..cells {
        for i in 0..cells {
            let [a, b, c, d] = [net[j][i], net[j][i + 1], net[j + 1][i + 1], net[j + 1][i]];
            corners.extend([[a, b, c], [a, c, d]]);
        }
    }
    corners
}
