//! Every triangle on the lattice of a small window: both engines against the oracle.
//!
//! Unordered triples of different lattice points, degenerate ones included. No symmetry is used:
//! neither shifts nor mirrors nor a chosen winding reduce the set. Each triangle is presented in
//! all six orders of its corners, or in the one that the sum of its three point numbers modulo 6
//! picks, so that every order is drawn about equally often.
//!
//! The oracle is tabulated. It counts, for each sample, the edges that cross the sample's height to
//! its left, and asks whether the count is odd (see [`rasterproof_verify::oracle::coverage`]). Whether one edge
//! does so depends on that edge and the sample alone. So for each pair of points a mask says for
//! which samples of the window it does, and the coverage of a triangle is the exclusive or of three
//! masks. That this is the oracle is shown in each run: on all triangles of the sublattice with at
//! most two subpixel bits (for such runs: on all triangles) it is compared with the oracle's code.

use serde::{Deserialize, Serialize};

use super::{Enumeration, Source, Tally, common_words};
use rasterproof_core::contract::Rasterize;
use rasterproof_core::grid::{HALF_PIXEL, PixelRect, SUBPIXEL_BITS, SUBPIXELS, SubpixelPoint};
use rasterproof_core::raster::edge_function::EdgeFunction;
use rasterproof_core::raster::scanline::Scanline;
use rasterproof_core::source_text;
use rasterproof_core::triangle::{Corners, Span};
use rasterproof_faults::planted::TriangleMutant;
use rasterproof_verify::oracle::Oracle;

/// Bits of the sublattice on which the oracle's own code judges too.
const ORACLE_BITS: u32 = 2;
/// Samples in a row of the mask, whatever the window.
const MASK_WIDTH: i32 = 4;
/// Beyond the 16 samples of a mask: a pixel was hit twice.
const HIT_TWICE: u32 = 1 << 16;
/// Beyond the 16 samples of a mask: a span was empty or left the window.
const BAD_SPAN: u32 = 1 << 17;

const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]];

#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Triangles {
    /// Side of the window in pixels, 1 to 4.
    pub window_px: u32,
    /// Bits below the pixel, at most 4.
    pub subpixel_bits: u32,
    pub offset_px: [i32; 2],
    /// Every order of the corners instead of one.
    pub all_orders: bool,
    /// A mutant in the place of the scanline engine.
    pub plant: Option<String>,
}

/// n choose 3.
fn triples(n: u64) -> u64 {
    n * (n - 1) * (n - 2) / 6
}

impl Enumeration for Triangles {
    fn claim(&self) -> String {
        let (bits, side) = (self.subpixel_bits, self.window_px);
        let order = if self.all_orders {
            "in each of the six orders of its corners"
        } else {
            "in one order of its corners, all six in turn"
        };
        let [x, y] = self.offset_px;
        let checked = bits.min(ORACLE_BITS);
        format!(
            "For every unordered triangle with three different corners on the lattice with {bits} subpixel bits in a \
             {side}x{side} px window at ({x}, {y}) px, {order}: the scanline and the edge-function engine hit exactly \
             the samples of the window that the tabulated oracle says, once each. The table is compared in this run \
             with the oracle's own code on all triangles of the sublattice with {checked} subpixel bits \
             (oracle_checks). Each comparison is one drawing by one engine."
        )
    }

    fn chunks(&self) -> u64 {
        self.points()
    }

    fn expected_cases(&self) -> u64 {
        triples(self.points())
    }

    fn expected_oracle_checks(&self) -> u64 {
        let checked = Self { subpixel_bits: self.subpixel_bits.min(ORACLE_BITS), ..self.clone() };
        checked.expected_cases()
    }

    fn judge(&self) -> Box<dyn Fn(u64) -> Tally + Sync + Send + '_> {
        let table = Table::new(self);
        let mutant =
            TriangleMutant::ALL.into_iter().find(|m| Some(m.name()) == self.plant.as_deref());
        match mutant {
            None => Box::new(move |chunk| self.chunk(chunk, &table, &Scanline)),
            Some(mutant) => Box::new(move |chunk| self.chunk(chunk, &table, &mutant)),
        }
    }

    fn words(&self) -> String {
        let orders = if self.all_orders { " --all-orders" } else { "" };
        let common = common_words(self.offset_px, self.plant.as_deref());
        format!(
            "triangles --window {} --subpixel-bits {}{orders}{common}",
            self.window_px, self.subpixel_bits
        )
    }

    fn sources(&self) -> Vec<Source> {
        vec![
            Source::file("src/grid.rs", source_text::GRID),
            Source {
                path: "src/raster/scanline.rs",
                text: source_text::SCANLINE,
                items: &[
                    "impl Rasterize for Scanline",
                    "fn sort_by_height",
                    "fn walk",
                    "fn first_centre",
                    "fn centre",
                    "fn floor_div",
                    "struct EdgeWalk",
                    "impl EdgeWalk",
                ],
            },
            Source {
                path: "src/raster/edge_function.rs",
                text: source_text::EDGE_FUNCTION,
                items: &[
                    "impl Rasterize for EdgeFunction",
                    "enum WordWidth",
                    "impl WordWidth",
                    "fn extents",
                    "trait Exact",
                    "impl Exact for i64",
                    "impl Exact for i128",
                    "trait Word",
                    "macro_rules! word",
                    "word!(",
                    "fn centre",
                    "struct Edge",
                    "impl Edge",
                    "fn pixel_box",
                    "fn twice_area",
                    "fn edges",
                    "fn cover_in",
                    "fn walk",
                ],
            },
            Source::file(
                "src/oracle/coverage.rs",
                rasterproof_verify::source_text::ORACLE_COVERAGE,
            ),
            Source::file("src/exhaust/triangles.rs", include_str!("triangles.rs")),
        ]
    }
}

impl Triangles {
    /// Points of the lattice along a side of the window.
    fn side(&self) -> u64 {
        (u64::from(self.window_px) << self.subpixel_bits) + 1
    }

    fn points(&self) -> u64 {
        self.side() * self.side()
    }

    /// The point of this number in the window at the origin; numbers go row by row.
    fn point(&self, number: usize) -> SubpixelPoint {
        let side = self.side() as usize;
        let spacing = 1 << (SUBPIXEL_BITS - self.subpixel_bits);
        SubpixelPoint::new((number % side) as i32 * spacing, (number / side) as i32 * spacing)
    }

    fn bounds(&self) -> PixelRect {
        let [x0, y0] = self.offset_px;
        let side = self.window_px as i32;
        PixelRect { x0, y0, x1: x0 + side, y1: y0 + side }
    }

    /// All triangles whose first point has the number of the chunk.
    fn chunk<A: Rasterize>(&self, chunk: u64, table: &Table, first: &A) -> Tally {
        let bounds = self.bounds();
        let i = chunk as usize;
        let mut tally = Tally::default();
        for j in i + 1..table.points.len() {
            for k in j + 1..table.points.len() {
                let truth = table.coverage(i, j, k);
                let corners = [i, j, k].map(|number| table.points[number]);
                let picked = (i + j + k) % ORDERS.len();
                let orders =
                    if self.all_orders { &ORDERS[..] } else { &ORDERS[picked..picked + 1] };
                for order in orders {
                    let corners = order.map(|corner| corners[corner]);
                    let drawn =
                        [hits(first, corners, bounds), hits(&EdgeFunction, corners, bounds)];
                    tally.comparisons += 2;
                    if drawn != [truth; 2] {
                        tally.wrong(chunk, || {
                            format!("{corners:?}: oracle {truth:#x}, scanline and edge function {drawn:#x?}")
                        });
                    }
                }
                if table.is_checked[i] && table.is_checked[j] && table.is_checked[k] {
                    tally.oracle_checks += 1;
                    let oracle = hits(&Oracle, corners, bounds);
                    if oracle != truth {
                        tally.wrong(chunk, || {
                            format!(
                                "{corners:?}: the oracle says {oracle:#x}, its table {truth:#x}"
                            )
                        });
                    }
                }
                tally.cases += 1;
            }
        }
        tally
    }
}

/// The samples that an engine hits, as a mask, with [`HIT_TWICE`] and [`BAD_SPAN`].
#[inline]
fn hits<E: Rasterize>(engine: &E, corners: Corners, bounds: PixelRect) -> u32 {
    let mut mask = 0;
    engine.cover(corners, bounds, |Span { y_px, x0_px, x1_px }| {
        let inside = (bounds.y0..bounds.y1).contains(&y_px)
            && bounds.x0 <= x0_px
            && x0_px < x1_px
            && x1_px <= bounds.x1;
        if !inside {
            mask |= BAD_SPAN;
            return;
        }
        let run = (1u32 << (x1_px - x0_px)) - 1;
        let run = run << ((y_px - bounds.y0) * MASK_WIDTH + x0_px - bounds.x0);
        if mask & run != 0 {
            mask |= HIT_TWICE;
        }
        mask |= run;
    });
    mask
}

struct Table {
    points: Vec<SubpixelPoint>,
    /// Points of the sublattice on which the oracle's own code judges too.
    is_checked: Vec<bool>,
    /// For each pair of points, the samples that the edge between them passes to the left.
    left: Vec<u16>,
}

impl Table {
    fn new(window: &Triangles) -> Self {
        let numbers = 0..window.points() as usize;
        let origin: Vec<_> = numbers.map(|number| window.point(number)).collect();
        let sublattice = 1 << (SUBPIXEL_BITS - window.subpixel_bits.min(ORACLE_BITS));
        let pairs = origin.iter().flat_map(|a| origin.iter().map(|b| passes_left(*a, *b)));
        let mut left: Vec<u16> = pairs.collect();
        // A sample outside a smaller window is nobody's.
        let side = window.window_px as i32;
        let samples = (0..16).filter(|s| s % MASK_WIDTH < side && s / MASK_WIDTH < side);
        let window_mask = samples.fold(0, |mask, sample| mask | 1 << sample);
        left.iter_mut().for_each(|mask| *mask &= window_mask);
        let [x, y] = window.offset_px.map(|px| px * SUBPIXELS);
        Self {
            is_checked: origin
                .iter()
                .map(|p| p.x % sublattice == 0 && p.y % sublattice == 0)
                .collect(),
            points: origin.iter().map(|p| SubpixelPoint::new(p.x + x, p.y + y)).collect(),
            left,
        }
    }

    /// Samples with an odd number of edges to their left.
    #[inline]
    fn coverage(&self, i: usize, j: usize, k: usize) -> u32 {
        let count = self.points.len();
        let (from_i, from_j) = (&self.left[i * count..], &self.left[j * count..]);
        u32::from(from_i[j] ^ from_j[k] ^ from_i[k])
    }
}

/// For which samples (xs, ys) of a window at the origin the edge between `a` and `b` crosses the
/// height of the sample, nudged right by eps and down by eps^2, to its left: one end has y <= ys,
/// the other has not, and the crossing lies at x <= xs. With the upper end u and the lower end v
/// that is (ys - u.y) (v.x - u.x) <= (xs - u.x) (v.y - u.y).
fn passes_left(a: SubpixelPoint, b: SubpixelPoint) -> u16 {
    let (u, v) = if a.y <= b.y { (a, b) } else { (b, a) };
    let mut mask = 0;
    for sample in 0..MASK_WIDTH * MASK_WIDTH {
        let xs = sample % MASK_WIDTH * SUBPIXELS + HALF_PIXEL;
        let ys = sample / MASK_WIDTH * SUBPIXELS + HALF_PIXEL;
        let crosses = u.y <= ys && ys < v.y;
        if crosses && (ys - u.y) * (v.x - u.x) <= (xs - u.x) * (v.y - u.y) {
            mask |= 1 << sample;
        }
    }
    mask
}
