//! A scene whose corners lie on another grid than the engines', or on none.
//!
//! The engines count in 1/256 px, and so does the pipeline between them. Another grid therefore needs no second pipeline: both exact
//! engines decide which pixels each triangle covers once its corners are put on that grid, and each pixel of a triangle becomes a small
//! triangle of its own around the pixel's centre, with the values that the whole one has there. What is drawn is that scene, with all
//! effects, by the same two engines. Nothing of the engines is changed, and neither engine decides alone what the other one draws.

use std::cell::Cell;

use glam::{DMat4, DVec2, DVec3, DVec4};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::{Rasterize, RasterizeExact};
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_core::raster::edge_function::EdgeFunction;
use rasterproof_core::raster::edge_function_exact::EdgeFunctionExact;
use rasterproof_core::raster::scanline::Scanline;
use rasterproof_core::raster::scanline_exact::ScanlineExact;
use rasterproof_core::triangle::{Corners, FreeCorners, ScreenTriangle, Span, Varying};
use rasterproof_precision::cost::{Pass, Timing, compare};
use rasterproof_render::effects::render::BadScene;
use rasterproof_render::scene::{Attribute, Corner, Hidden, Item, Mesh, Normals, Scene};
use rasterproof_render::scene::{Shading, Triangles};
use rasterproof_report::words::thousands;

use crate::corner_grid::CornerGrid;
use crate::ties::DepthPlane;
use crate::view::{Cut, NOTHING, Piece, each_cut, pieces_and_lost};

/// Cells that a scene may have: each takes some 300 bytes.
const MOST_CELLS: u64 = 1 << 22;

/// How far the corners of a cell are from the centre of its pixel, in 1/256 px; smaller where the larger ones would lie behind the eye.
const REACHES: [f64; 3] = [16.0, 4.0, 1.0];

/// The corners of a cell around a centre, clockwise as seen, in its reach. Its edges run through no centre.
const CELL: [[f64; 2]; 3] = [[-1.0, -1.0], [1.0, -1.0], [0.0, 1.0]];

/// A scene of a cell for each pixel of each triangle.
pub struct Cells {
    pub scene: Scene,
    /// Pixels of triangles, hidden ones counted, that one exact engine covers and the other does not: a fault.
    pub disagreeing: u64,
}

/// Makes the cells of a scene whose corners lie on a grid, for a window with one sample at the centre of each pixel.
///
/// # Errors
/// A sentence where cells cannot stand for the scene.
pub fn cells(scene: &Scene, window: PixelRect, grid: CornerGrid) -> Result<Cells, String> {
    check_scene(scene)?;
    let mut cells = Scene { items: Vec::with_capacity(scene.items.len()), ..scene.clone() };
    let (mut disagreeing, mut count) = (0, 0);
    for (index, item) in scene.items.iter().enumerate() {
        let mut builder = Builder::new(scene, item, window);
        // Each part of a triangle becomes the cells of the pixels that both exact engines find in it.
        let mut cut = |cut: Cut<'_, DVec3>| {
            let corners = grid.place(cut.px);
            let winding = grid.winding(cut.px);
            let Ok(free) = FreeCorners::new(corners) else { return };
            if winding == 0.0 || grid.is_removed(item.cull, cut.px) || count > MOST_CELLS {
                return;
            }
            let pixels = covered_pixels(&ScanlineExact, &free, window);
            let other = covered_pixels(&EdgeFunctionExact, &free, window);
            disagreeing += without(&pixels, &other) + without(&other, &pixels);
            count += pixels.len() as u64;
            for pixel in pixels {
                builder.add(&cut, corners, winding, pixel);
            }
        };
        // The shares of the three corners, by which all that a corner has is mixed.
        let varying = |_: &Corner, i: usize| DVec3::AXES[i];
        each_cut(scene, index, window, varying, &mut cut).map_err(|error| error.to_string())?;
        cells.items.push(builder.item());
    }
    if count > MOST_CELLS {
        return Err(format!(
            "a grid of its own is drawn pixel by pixel, and the triangles in this window have more than {} pixels, hidden ones counted: \
             give a smaller --size",
            thousands(MOST_CELLS)
        ));
    }
    Ok(Cells { scene: cells, disagreeing })
}

/// Refuses what needs whole triangles: an order of triangles, a map of them from the light, and light that is mixed from corners.
fn check_scene(scene: &Scene) -> Result<(), String> {
    let [what, instead] = if scene.hidden == Hidden::Painter {
        ["drawing from back to front", "choose another scene"]
    } else if scene.shadows.is_some() {
        ["a shadow map", "leave out --shadows"]
    } else if scene.items.iter().any(|item| item.material.shading == Shading::Gouraud) {
        ["light of corners", "choose --shading flat or phong"]
    } else {
        return Ok(());
    };
    Err(format!(
        "a grid of its own is drawn pixel by pixel, which {what} is not made for: {instead}"
    ))
}

/// The pixels that an engine covers, from the top left.
fn covered_pixels(
    engine: &impl RasterizeExact,
    corners: &FreeCorners,
    window: PixelRect,
) -> Vec<[i32; 2]> {
    let mut pixels = Vec::new();
    engine.cover_exact(corners, window, |span| {
        for x in span.x0_px..span.x1_px {
            pixels.push([x, span.y_px]);
        }
    });
    pixels.sort_unstable_by_key(|[x, y]| [*y, *x]);
    pixels
}

/// How many of some pixels are not among others; both from the top left.
fn without(some: &[[i32; 2]], others: &[[i32; 2]]) -> u64 {
    if some == others {
        return 0;
    }
    // Mostly both are the same; the search is for the few triangles on which engines disagree.
    let mut count = 0;
    for [x, y] in some {
        count += u64::from(others.binary_search_by_key(&[*y, *x], |[x, y]| [*y, *x]).is_err());
    }
    count
}

/// The cells of an item on the way.
struct Builder<'a> {
    item: &'a Item,
    size: [f64; 2],
    /// From clip to object space.
    back: DMat4,
    /// What a corner of a cell has: position, colour, normal, tangent and both texture coordinates.
    positions: Vec<DVec3>,
    colours: Vec<[DVec3; 3]>,
    normals: Vec<[DVec3; 3]>,
    tangents: Vec<[DVec4; 3]>,
    uvs: Vec<[DVec2; 3]>,
    second_uvs: Vec<[DVec2; 3]>,
}

impl<'a> Builder<'a> {
    /// Without cells yet.
    fn new(scene: &Scene, item: &'a Item, window: PixelRect) -> Self {
        Self {
            item,
            size: [f64::from(window.width()), f64::from(window.height())],
            back: (scene.projection * scene.view * item.model).inverse(),
            positions: Vec::new(),
            colours: Vec::new(),
            normals: Vec::new(),
            tangents: Vec::new(),
            uvs: Vec::new(),
            second_uvs: Vec::new(),
        }
    }

    /// Adds the cell of a pixel that a part of a triangle covers, whose corners on the grid are given with a number of the sign of their
    /// area.
    fn add(&mut self, cut: &Cut<'_, DVec3>, corners: [[f64; 2]; 3], winding: f64, pixel: [i32; 2]) {
        // The largest reach whose corners all lie in front of the eye; a cell without any is not drawn.
        let mut cells = REACHES.into_iter().filter_map(|reach| cell(cut, corners, pixel, reach));
        let Some([a, b, c]) = cells.next() else { return };
        // A cell is seen from the side that its triangle is seen from.
        let cell = if winding > 0.0 { [a, b, c] } else { [a, c, b] };
        // The way of the pipeline backwards: from the window to clip space, times w, and from there to the object.
        let [width, height] = self.size;
        for Value { px: [x, y], depth, w, .. } in cell {
            let clip =
                DVec4::new(2.0 * x / width - 1.0, 1.0 - 2.0 * y / height, 2.0 * depth - 1.0, 1.0);
            let position = self.back * (clip * w);
            self.positions.push(position.truncate() / position.w);
        }
        // What a corner of the cell has is mixed from the corners of the triangle by their shares there.
        let mesh = &self.item.mesh;
        let shares = cell.map_array(|value| value.varying.to_array());
        let of = cut.corners;
        self.colours.push(mixed(shares, of.map_array(|of| of.colour)));
        let normals = match self.item.material.shading {
            Shading::Flat => [mesh.face_normal(of.map_array(|of| of.position)); 3],
            _ => of.map_array(|of| of.normal),
        };
        self.normals.push(mixed(shares, normals));
        self.uvs.push(mixed(shares, of.map_array(|of| of.uv)));
        // The corners of a part have neither tangents nor second coordinates, so these come from the mesh.
        let (tangents, uvs) =
            (mesh.triangles.tangents(cut.number), mesh.triangles.second_uvs(cut.number));
        self.tangents.push(mixed(shares, tangents));
        self.second_uvs.push(mixed(shares, uvs));
    }

    /// The item with its cells in place of its triangles: three corners of their own for each.
    fn item(self) -> Item {
        let Self { item, positions, colours, normals, tangents, uvs, second_uvs, .. } = self;
        let numbers = (0..positions.len() as u32).collect();
        let normals = Normals::Given(Attribute::OfCorners(normals));
        let triangles = Triangles::new(
            numbers,
            Attribute::OfCorners(colours),
            normals,
            Attribute::OfCorners(uvs),
        );
        let triangles = triangles
            .with_tangents(Attribute::OfCorners(tangents))
            .with_second_uvs(Attribute::OfCorners(second_uvs));
        let mut item =
            Item { mesh: Mesh { positions: positions.into(), triangles }.into(), ..item.clone() };
        if item.material.shading == Shading::Flat {
            // Each cell has the normal of its face, at all of its corners.
            item.material.shading = Shading::Phong;
        }
        item
    }
}

/// What a part of a triangle, whose corners lie on the grid, has at the corners of a cell; nothing where one lies behind the eye.
fn cell(
    cut: &Cut<'_, DVec3>,
    corners: [[f64; 2]; 3],
    pixel: [i32; 2],
    reach: f64,
) -> Option<[Value<DVec3>; 3]> {
    let [x, y] = pixel.map_array(|px| f64::from(px) + 0.5);
    let [a, b, c] = CELL.map_array(|[right, down]| {
        let px = [x + right * reach / 256.0, y + down * reach / 256.0];
        Value::at(px, &cut.triangle, corners)
    });
    Some([a?, b?, c?])
}

/// What a part of a triangle has at a place in the window.
#[derive(Clone, Copy)]
pub(crate) struct Value<V> {
    pub px: [f64; 2],
    pub depth: f64,
    pub w: f64,
    pub varying: V,
}

impl<V: Varying> Value<V> {
    /// The value at a place of a part whose corners lie elsewhere than its vertices; nothing where it lies behind the eye.
    pub fn at(px: [f64; 2], triangle: &ScreenTriangle<V>, corners: [[f64; 2]; 3]) -> Option<Self> {
        // The areas opposite to the corners are their shares in the window; divided by w they are those in space.
        let [a, b, c] = corners;
        let parts = [product(b, c, px), product(c, a, px), product(a, b, px)];
        let all = parts[0] + parts[1] + parts[2];
        let [p, q, r] = parts.map_array(|part| part / all);
        let [one, two, three] = &triangle.vertices;
        let [of_one, of_two, of_three] = [p * one.inv_w, q * two.inv_w, r * three.inv_w];
        let inv_w = of_one + of_two + of_three;
        let varying = one.varying * of_one + two.varying * of_two + three.varying * of_three;
        let depth = p * one.depth + q * two.depth + r * three.depth;
        (inv_w > 0.0 && inv_w.is_finite() && depth.is_finite()).then(|| Self {
            px,
            depth,
            w: 1.0 / inv_w,
            varying: varying * (1.0 / inv_w),
        })
    }
}

/// Twice the area of two corners and a point, within two roundings of the product of its differences.
fn product(a: [f64; 2], b: [f64; 2], p: [f64; 2]) -> f64 {
    let ([ax, ay], [bx, by]) = ([a[0] - p[0], a[1] - p[1]], [b[0] - p[0], b[1] - p[1]]);
    let second = ay * bx;
    // What the product was rounded by is added again.
    let rounded = (-ay).mul_add(bx, second);
    ax.mul_add(by, -second) + rounded
}

/// For each corner of a cell the sum of three values by their shares there.
fn mixed<V>(shares: [[f64; 3]; 3], [a, b, c]: [V; 3]) -> [V; 3]
where
    V: Copy + std::ops::Mul<f64, Output = V> + std::ops::Add<Output = V>,
{
    shares.map_array(|[p, q, r]| a * p + b * q + c * r)
}

/// What a grid changes in a view, and how long the coverage of all triangles takes on it.
#[derive(Clone, Debug, serde::Serialize)]
pub struct GridPrice {
    /// Bits below the pixel; nothing without a grid.
    pub bits: Option<u32>,
    /// Pixels in which another triangle is seen than without a grid.
    pub changed: u64,
    /// The first of them.
    pub first: Option<[i32; 2]>,
    /// Median times of both engines, in ms.
    pub scanline_ms: f64,
    pub edge_function_ms: f64,
}

/// The price of each grid. The coverage of all grids is timed in the same rounds, so many times.
pub fn prices(scene: &Scene, window: PixelRect, rounds: usize) -> Result<Vec<GridPrice>, BadScene> {
    // What changes is found first, and then all grids are timed together.
    let (mut prices, mut outlines) = (Vec::new(), Vec::new());
    let mut unsnapped: Option<Frame<u32>> = None;
    // From the finest grid to the coarsest: the first one does not snap, and all others are compared with it.
    for grid in CornerGrid::ALL.into_iter().rev() {
        let (pieces, _) = pieces_and_lost(scene, window, grid)?;
        let seen = seen(&pieces, window, grid);
        let truth = unsnapped.get_or_insert_with(|| seen.clone());
        let (mut changed, mut first) = (0, None);
        for (y, row) in seen.rows() {
            for (x, face) in (window.x0..).zip(row) {
                if truth.get(x, y) != Some(*face) {
                    changed += 1;
                    first = first.or(Some([x, y]));
                }
            }
        }
        outlines.push(Outlines::new(&pieces, grid));
        let [scanline_ms, edge_function_ms] = [0.0; 2];
        prices.push(GridPrice { bits: grid.bits(), changed, first, scanline_ms, edge_function_ms });
    }
    // The pixels that were covered, so that no pass is left out as idle.
    let covered = Cell::new(0);
    let add = |pixels: usize| covered.set(covered.get() + pixels);
    // Two passes for each grid, whose times come back in this order. None is compared with another one: medians are enough.
    let mut passes = Vec::new();
    for outlines in &outlines {
        passes.push(Pass::new(move || add(outlines.covered(&Scanline, &ScanlineExact, window))));
        passes.push(Pass::new(move || {
            add(outlines.covered(&EdgeFunction, &EdgeFunctionExact, window))
        }));
    }
    let timing = Timing { rounds: Some(rounds.max(1)), ..Timing::USUAL };
    let times = compare(&mut passes, timing, &[], &|_| ());
    for (price, times) in prices.iter_mut().zip(times.chunks(2)) {
        price.scanline_ms = times[0].median() / 1e6;
        price.edge_function_ms = times[1].median() / 1e6;
    }
    std::hint::black_box(covered.get());
    prices.reverse();
    Ok(prices)
}

/// The corners of all pieces on a grid: whole numbers where the engines' words hold them, else floats.
enum Outlines {
    Whole(Vec<Corners>),
    Free(Vec<FreeCorners>),
}

impl Outlines {
    /// A piece that a grid puts beyond the domain of the engines is left out, as the engines leave it out.
    fn new(pieces: &[Piece], grid: CornerGrid) -> Self {
        let (mut whole, mut free) = (Vec::new(), Vec::new());
        for piece in pieces {
            let placed = grid.place(piece.px);
            if grid.is_whole() {
                let points = placed.map_array(|[x, y]| SubpixelPoint::from_px(x, y).ok());
                if let [Some(a), Some(b), Some(c)] = points {
                    whole.push([a, b, c]);
                }
            } else {
                free.extend(FreeCorners::new(placed).ok());
            }
        }
        if grid.is_whole() { Self::Whole(whole) } else { Self::Free(free) }
    }

    /// Pixels that an engine covers.
    fn covered(
        &self,
        whole: &impl Rasterize,
        free: &impl RasterizeExact,
        window: PixelRect,
    ) -> usize {
        let mut count = 0;
        let mut add = |span: Span| count += span.pixels();
        match self {
            Self::Whole(all) => {
                for corners in all {
                    whole.cover(*corners, window, &mut add);
                }
            }
            Self::Free(all) => {
                for corners in all {
                    free.cover_exact(corners, window, &mut add);
                }
            }
        }
        count
    }
}

/// Which triangle is seen in each pixel, by the depths of the planes before corners are put on a grid.
fn seen(pieces: &[Piece], window: PixelRect, grid: CornerGrid) -> Frame<u32> {
    // Of equal depths the first piece stays.
    let mut seen = Frame::new(window, NOTHING);
    let mut nearest = Frame::new(window, f64::INFINITY);
    for piece in pieces {
        let Some(plane) = DepthPlane::of(piece) else { continue };
        grid.cover(piece.px, window, &mut |span| {
            for x in span.x0_px..span.x1_px {
                let [z, ..] = plane.at(x, span.y_px);
                let held = &mut nearest.span_mut(span.y_px, x, x + 1)[0];
                if z < *held {
                    *held = z;
                    seen.span_mut(span.y_px, x, x + 1)[0] = piece.face;
                }
            }
        });
    }
    seen
}
