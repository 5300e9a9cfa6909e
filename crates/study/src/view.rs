//! The triangles of a scene in the window, with their corners before they are snapped and after.

use glam::{DMat4, DVec2, DVec3, DVec4, Vec4Swizzles as _};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::Interpolate as _;
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::raster::scanline::Scanline;
use rasterproof_core::triangle::{Corners, FreeCorners, ScreenTriangle, ScreenVertex, Varying};
use rasterproof_render::effects::render::BadScene;
use rasterproof_render::pipeline::ClipVertex;
use rasterproof_render::pipeline::assemble::{Viewport, check_vertex};
use rasterproof_render::pipeline::clip::{clip, outcode};
use rasterproof_render::pipeline::depth::DepthFormat;
use rasterproof_render::pipeline::multisample::{self, SAMPLES};
use rasterproof_render::pipeline::target::{Antialias, Target};
use rasterproof_render::scene::{Corner, Scene};

use crate::corner_grid::CornerGrid;
use crate::winding::{self, Change};

/// What clipping leaves of a triangle, or a part of it.
#[derive(Clone, Copy, Debug)]
pub struct Piece {
    /// Which triangle of the scene, from 0 in drawing order.
    pub face: u32,
    pub item: u32,
    /// Its corners in pixels, not snapped.
    pub px: [[f64; 2]; 3],
    pub w: [f64; 3],
    /// What the doubles of the vertex stage may be off, in pixels and in depth.
    pub px_error: f64,
    pub depth_error: f64,
    /// With texture coordinates.
    pub triangle: ScreenTriangle<DVec2>,
    /// How much of the second and of the third corner of its face each of its corners has.
    pub shares: [DVec2; 3],
}

impl Piece {
    /// The corners once they are snapped.
    pub fn corners(&self) -> Corners {
        self.triangle.corners()
    }

    /// The triangle with its depths alone.
    pub(crate) fn depth_only(&self) -> ScreenTriangle<f64> {
        carrying(&self.triangle, |_| 0.0)
    }

    /// What putting its corners on a grid does to it.
    pub(crate) fn change(&self, grid: CornerGrid) -> Change {
        winding::change(self.px, self.px_error, grid.winding(self.px))
    }

    /// The corners as they are; none beyond the domain of the engines.
    pub fn free(&self) -> Option<FreeCorners> {
        FreeCorners::new(self.px).ok()
    }
}

/// The same triangle whose vertices carry something else, made of what they carry.
fn carrying<V: Copy, U>(triangle: &ScreenTriangle<V>, of: fn(V) -> U) -> ScreenTriangle<U> {
    let vertices = triangle.vertices.map_array(|vertex| {
        let ScreenVertex { position, depth, inv_w, varying } = vertex;
        ScreenVertex { position, depth, inv_w, varying: of(varying) }
    });
    ScreenTriangle { vertices }
}

/// The pieces of a scene in drawing order, culled as the scene asks.
pub fn pieces(scene: &Scene, window: PixelRect) -> Result<Vec<Piece>, BadScene> {
    Ok(pieces_and_lost(scene, window, CornerGrid::USUAL)?.0)
}

/// The pieces of a scene, and those that culling removes only since their corners on the grid have turned them over.
pub(crate) fn pieces_and_lost(
    scene: &Scene,
    window: PixelRect,
    grid: CornerGrid,
) -> Result<(Vec<Piece>, Vec<Piece>), BadScene> {
    let (width, height) = (f64::from(window.width()), f64::from(window.height()));
    let mut pieces = Vec::with_capacity(scene.triangles());
    let mut lost = Vec::new();
    for (index, item) in scene.items.iter().enumerate() {
        let sums = absolute(scene, index);
        // Of each corner its texture coordinates and its shares.
        let varying = |corner: &Corner, number: usize| {
            let DVec2 { x, y } = corner.uv;
            let [_, second, third] = DVec3::AXES[number].to_array();
            DVec4::new(x, y, second, third)
        };
        each_cut(scene, index, window, varying, &mut |cut: Cut<'_, DVec4>| {
            // How large the terms of the sums in clip space are at most, at any of the three corners.
            let mut most = DVec4::ZERO;
            for corner in cut.corners {
                let position = item.mesh.positions[corner.position as usize];
                most = most.max(sums * position.abs().extend(1.0));
            }
            let least_w = cut.w[0].min(cut.w[1]).min(cut.w[2]);
            let off = MOST_OFF * most / least_w;
            // Within the window |x|, |y| and |z| are at most w; half of that is the side of the window.
            let px_error = (off.x.max(off.y) + off.w) * width.max(height) / 2.0;
            let depth_error = (off.z + off.w) / 2.0;
            let Cut { face, px, w, triangle, .. } = cut;
            let shares = triangle.vertices.map_array(|vertex| vertex.varying.zw());
            let triangle = carrying(&triangle, DVec4::xy);
            let item_number = index as u32;
            let piece =
                Piece { face, item: item_number, px, w, px_error, depth_error, triangle, shares };
            if !grid.is_removed(item.cull, px) {
                pieces.push(piece);
            } else if piece.change(grid) == Change::Over {
                lost.push(piece);
            }
        })?;
    }
    Ok((pieces, lost))
}

/// What clipping leaves of a triangle of an item, or a part of it, culled or not.
pub(crate) struct Cut<'a, V> {
    pub face: u32,
    /// The corners of the triangle, and its number in the item.
    pub corners: &'a [Corner; 3],
    pub number: usize,
    /// Its corners in pixels, not snapped.
    pub px: [[f64; 2]; 3],
    pub w: [f64; 3],
    pub triangle: ScreenTriangle<V>,
}

/// A vertex of a clipped triangle, in pixels and snapped.
#[derive(Clone, Copy)]
struct PlacedVertex<V> {
    px: [f64; 2],
    w: f64,
    snapped: ScreenVertex<V>,
}

/// Calls `see` with the parts of the triangles of an item that lie in the window. `varying` is what a corner carries, by the corner
/// and its number in the triangle.
pub(crate) fn each_cut<V: Varying>(
    scene: &Scene,
    item: usize,
    window: PixelRect,
    varying: impl Fn(&Corner, usize) -> V,
    see: &mut dyn FnMut(Cut<'_, V>),
) -> Result<(), BadScene> {
    let (width, height) = (f64::from(window.width()), f64::from(window.height()));
    let viewport = Viewport::new(window);
    let before: usize = scene.items[..item].iter().map(|item| item.mesh.triangles.len()).sum();
    let points = clip_points(scene, item)?;
    for (number, corners) in scene.items[item].mesh.triangles.iter().enumerate() {
        let vertices = [0, 1, 2].map_array(|i| ClipVertex {
            position: points[corners[i].position as usize],
            varying: varying(&corners[i], i),
        });
        // A triangle with all corners outside of one plane has no part in the window.
        let [a, b, c] = vertices.map_array(|vertex| outcode(&vertex));
        if a & b & c != 0 {
            continue;
        }
        // The polygon is cut into triangles around its first vertex, as the pipeline does.
        let (polygon, _) = clip(&vertices, a | b | c);
        let mut first = None;
        let mut previous = None;
        for vertex in polygon.vertices() {
            let Ok(snapped) = viewport.place(vertex) else { continue };
            let DVec4 { x, y, w, .. } = vertex.position;
            let px = [(x / w + 1.0) / 2.0 * width, (1.0 - y / w) / 2.0 * height];
            let next = PlacedVertex { px, w, snapped };
            if let (Some(first), Some(previous)) = (first, previous) {
                let of = [first, previous, next];
                let triangle = ScreenTriangle { vertices: of.map_array(|one| one.snapped) };
                let (px, w) = (of.map_array(|one| one.px), of.map_array(|one| one.w));
                let face = (before + number) as u32;
                see(Cut { face, corners: &corners, number, px, w, triangle });
            }
            previous = first.and(Some(next));
            first = first.or(Some(next));
        }
    }
    Ok(())
}

/// What a coordinate in clip space may be off, in what the same sums with positive terms alone come to. Three matrices
/// and a position are three sums of four products each: at most 4 u for each; and 2 u for the division and the window.
const MOST_OFF: f64 = 14.0 * (f64::EPSILON / 2.0);

/// The matrices of an item with positive numbers alone.
fn absolute(scene: &Scene, item: usize) -> DMat4 {
    let positive =
        |m: DMat4| DMat4::from_cols(m.x_axis.abs(), m.y_axis.abs(), m.z_axis.abs(), m.w_axis.abs());
    let model = scene.items.get(item).map_or(DMat4::IDENTITY, |item| item.model);
    positive(scene.projection) * positive(scene.view) * positive(model)
}

/// The positions of an item in clip space; an error where one of them is too large for the pipeline.
pub(crate) fn clip_points(scene: &Scene, item: usize) -> Result<Vec<DVec4>, BadScene> {
    let Some(of) = scene.items.get(item) else { return Ok(Vec::new()) };
    let matrix = scene.projection * scene.view * of.model;
    let mut points = Vec::with_capacity(of.mesh.positions.len());
    for (index, position) in of.mesh.positions.iter().enumerate() {
        let position = matrix * position.extend(1.0);
        if let Err(vertex) = check_vertex(index, &ClipVertex { position, varying: () }) {
            return Err(BadScene { item, vertex });
        }
        points.push(position);
    }
    Ok(points)
}

/// The pieces of a scene at the samples of a picture.
#[derive(Clone, Debug)]
pub struct Sampled {
    pub size: PixelRect,
    /// A window with one sample of each plane at the centre of each of its pixels: with supersampling larger than the
    /// picture.
    pub window: PixelRect,
    /// The pieces, moved so that the samples of a plane fall on the centres: four planes with multisampling, else one.
    pub planes: Vec<Vec<Piece>>,
    /// For each plane the pieces that culling removes only since snapping has turned them over.
    pub lost: Vec<Vec<Piece>>,
    /// The grid by which it is told what snapping does; what is seen is that of the usual one.
    pub grid: CornerGrid,
    /// The pieces in the pixels of the picture, where they are no plane, and those of them that are lost.
    centre: Option<[Vec<Piece>; 2]>,
}

impl Sampled {
    /// The pieces at the samples of a target, on the grid of the engines.
    pub fn of(scene: &Scene, target: &Target) -> Result<Self, BadScene> {
        Self::on(scene, target, CornerGrid::USUAL)
    }

    /// The same where what snapping does is that of another grid.
    pub fn on(scene: &Scene, target: &Target, grid: CornerGrid) -> Result<Self, BadScene> {
        let (size, window) = (target.size(), target.bounds());
        let (at_centres, lost) = pieces_and_lost(scene, size, grid)?;
        // Where the one sample of a pixel is its centre, the pieces there are the only plane.
        if target.antialias() == Antialias::None {
            let (planes, lost) = (vec![at_centres], vec![lost]);
            return Ok(Self { size, window, planes, lost, grid, centre: None });
        }
        let mut planes = (Vec::new(), Vec::new());
        if target.antialias() == Antialias::Multisample4 {
            for sample in SAMPLES {
                planes.0.push(all_moved(&at_centres, sample));
                planes.1.push(all_moved(&lost, sample));
            }
        } else {
            // A picture with more pixels, in which each sample is a centre.
            let (pieces, lost) = pieces_and_lost(scene, window, grid)?;
            planes = (vec![pieces], vec![lost]);
        }
        let centre = Some([at_centres, lost]);
        Ok(Self { size, window, planes: planes.0, lost: planes.1, grid, centre })
    }

    /// The pieces with pixel centres as samples, whatever the picture has.
    pub fn at_centres(&self) -> &[Piece] {
        self.centre.as_ref().map_or(&self.planes[0], |[pieces, _]| pieces)
    }

    /// The pieces at pixel centres that culling removes only since snapping has turned them over.
    pub fn lost_at_centres(&self) -> &[Piece] {
        self.centre.as_ref().map_or(&self.lost[0], |[_, lost]| lost)
    }

    /// The pieces at the samples that are shaded, and their window.
    pub fn shaded(&self) -> (&[Piece], PixelRect) {
        match self.planes.len() {
            1 => (&self.planes[0], self.window),
            _ => (self.at_centres(), self.size),
        }
    }

    /// The pieces of all planes: with multisampling each triangle is there four times.
    pub fn all(&self) -> impl Iterator<Item = &Piece> {
        self.planes.iter().flatten()
    }

    /// Whether a pixel has more than one sample.
    #[must_use]
    pub fn is_antialiased(&self) -> bool {
        self.centre.is_some()
    }

    /// What is counted, in the plural: `px` or `samples`.
    #[must_use]
    pub fn unit(&self) -> &'static str {
        if self.is_antialiased() { "samples" } else { "px" }
    }

    /// The same as a word: `pixels` or `samples`.
    #[must_use]
    pub fn counted(&self) -> &'static str {
        if self.is_antialiased() { "samples" } else { "pixels" }
    }

    /// The pixel of the picture that a sample belongs to.
    #[must_use]
    pub fn pixel(&self, sample: [i32; 2]) -> [i32; 2] {
        let scale = (self.window.width() / self.size.width().max(1)).max(1) as i32;
        sample.map(|at| at.div_euclid(scale))
    }
}

/// Calls `see` with the pieces at each plane of samples of a picture and those that are lost, as [`Sampled`] has them, one plane after
/// the other.
pub(crate) fn each_plane(
    scene: &Scene,
    target: &Target,
    grid: CornerGrid,
    see: &mut dyn FnMut(&[Piece], &[Piece]),
) -> Result<(), BadScene> {
    if target.antialias() != Antialias::Multisample4 {
        let (pieces, lost) = pieces_and_lost(scene, target.bounds(), grid)?;
        see(&pieces, &lost);
        return Ok(());
    }
    for sample in SAMPLES {
        // Made anew for each plane, since two lists of millions of pieces do not fit beside each other.
        let (mut pieces, mut lost) = pieces_and_lost(scene, target.size(), grid)?;
        for list in [&mut pieces, &mut lost] {
            // In place, since a copy would be a second list.
            list.retain_mut(|piece| {
                let moved = moved(piece, sample);
                *piece = moved.unwrap_or(*piece);
                moved.is_some()
            });
        }
        see(&pieces, &lost);
    }
    Ok(())
}

/// A piece moved so that a sample falls on the centre; none beyond the domain of the engines.
fn moved(piece: &Piece, sample: (i32, i32)) -> Option<Piece> {
    let triangle = multisample::moved(&piece.triangle, sample)?;
    // Samples are told in sixteenths of a pixel, of which the centre has eight.
    let by_x = 0.5 - f64::from(sample.0) / 16.0;
    let by_y = 0.5 - f64::from(sample.1) / 16.0;
    let px = piece.px.map_array(|[x, y]| [x + by_x, y + by_y]);
    Some(Piece { px, triangle, ..*piece })
}

/// Pieces as a plane has them.
fn all_moved(pieces: &[Piece], sample: (i32, i32)) -> Vec<Piece> {
    pieces.iter().filter_map(|piece| moved(piece, sample)).collect()
}

/// No piece.
pub const NOTHING: u32 = u32::MAX;

/// Which piece is seen at the centre of each pixel, by the depths of the scanline engine in a format, when the pieces
/// are drawn in an order.
pub fn seen(
    pieces: &[Piece],
    window: PixelRect,
    format: DepthFormat,
    order: &mut dyn Iterator<Item = usize>,
) -> Frame<u32> {
    let mut keys = Frame::new(window, u64::MAX);
    let mut seen = Frame::new(window, NOTHING);
    for number in order {
        Scanline.runs(&pieces[number].depth_only(), window, true, &mut |run| {
            let (x0, x1) = (run.x0_px, run.x1_px());
            let keys = keys.span_mut(run.y_px, x0, x1);
            let seen = seen.span_mut(run.y_px, x0, x1);
            for ((depth, key), seen) in run.depths.iter().zip(keys).zip(seen) {
                let new = format.key(*depth);
                if new < *key {
                    (*key, *seen) = (new, number as u32);
                }
            }
        });
    }
    seen
}
