//! The hard cases of a scene in a view: how often, where, and in how many pixels.

use std::sync::Arc;

use glam::{DVec3, DVec4};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::{DrawLine as _, Rasterize as _};
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::{HALF_PIXEL, PixelRect, SUBPIXELS, SubpixelPoint};
use rasterproof_core::line::bresenham::Bresenham;
use rasterproof_core::parallel;
use rasterproof_core::raster::scanline::Scanline;
use rasterproof_core::triangle::{LineEnd, PixelPoint, ScreenLine};
use rasterproof_models::Origin;
use rasterproof_registry::engines::Drawer;
use rasterproof_render::effects::Effects;
use rasterproof_render::effects::render::BadScene;
use rasterproof_render::pipeline::ClipVertex;
use rasterproof_render::pipeline::assemble::Viewport;
use rasterproof_render::pipeline::clip::outcode;
use rasterproof_render::pipeline::target::{Colour, Target};
use rasterproof_render::scene::{Mesh, Scene};

use crate::effects::differing;
use crate::face_of;
use crate::shape::{Edge, SLIVER, Shape};
use crate::view::{Piece, Sampled, pieces, seen};

rasterproof_core::named! {
    /// A kind of hard case. Its name is what is counted, in the plural.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
    pub enum Kind {
        NoArea = "triangles without area",
        Sliver = "slivers",
        Concave = "concave faces",
        Duplicate = "duplicate faces",
        Overlap = "coplanar overlaps",
        TJunction = "T-junctions",
        Border = "open borders",
        Crowded = "edges of more than two faces",
        OnEdge = "samples on edges",
        Order = "pixels by drawing order",
        WideW = "wide ranges of w",
        SinglePrecision = "positions lost by f32",
        FarTexture = "texture coordinates far out",
    }
}

impl Kind {
    pub fn about(self) -> &'static str {
        match self {
            Self::NoArea => "corners on one line: not drawn; who divides by the area divides by 0",
            Self::Sliver => {
                "longer than 100 times their height: dotted lines, values off by rounding"
            }
            Self::Concave => "cut around one corner, as many readers do, they cover pixels outside",
            Self::Duplicate => {
                "the corners of an earlier face: the first drawn is seen, or flicker"
            }
            Self::Overlap => {
                "faces in one plane: rounding decides who is seen, hatching and flicker"
            }
            Self::TJunction => "a corner within the edge of another face: pixels of background",
            Self::Border => "edges of one face: a hole, or the inside seen from behind",
            Self::Crowded => "no inside and outside there: culling and shadow volumes fail",
            Self::OnEdge => "snapped, the fill rule alone decides: other rules leave holes",
            Self::Order => "equal depths in this format: another order, another picture",
            Self::WideW => "over 4096 within a triangle: 1/w in f32 may be a visible step off",
            Self::SinglePrecision => "as f32 a corner moves by over 1/256 px: shapes are distorted",
            Self::FarTexture => "as f32 they miss half a texel: textures in blocks",
        }
    }

    fn bit(self) -> u16 {
        1 << self as u16
    }
}

#[derive(Clone, Debug)]
pub struct HardCase {
    pub kind: Kind,
    pub count: u64,
    /// Pixels of the picture that the faces cover, hidden or not; of edges the pixels along them.
    pub pixels: u64,
    /// Something about the worst one.
    pub note: String,
    /// Triangles by their numbers, from 0 in drawing order, worst or first ones first; at most three.
    pub triangles: Vec<u32>,
}

/// The hard cases of a scene, and what else was found on the way.
#[derive(Clone, Debug)]
pub struct HardCases {
    /// Those that occur, in the order of [`Kind::ALL`].
    pub cases: Vec<HardCase>,
    /// For each pixel which kinds touch it, as bits.
    touched: Frame<u16>,
    pub picture: Frame<Colour>,
    /// For each triangle of the scene which kinds it is of, as bits.
    marks: Vec<u16>,
    /// The smallest and the largest w in the window.
    pub w: Option<[f64; 2]>,
    /// Pixels that change when positions are rounded to f32.
    pub f32_pixels: u64,
    /// Whether the mesh is too large for all overlaps and T-junctions to be looked for.
    pub is_cut_short: bool,
}

impl HardCases {
    /// Whether a hard case touches a pixel.
    #[must_use]
    pub fn touches(&self, x_px: i32, y_px: i32) -> bool {
        self.touched.get(x_px, y_px).is_some_and(|bits| bits != 0)
    }

    /// Whether a triangle has a part in a hard case of any kind.
    #[must_use]
    pub fn is_hard(&self, triangle: u32) -> bool {
        self.marks.get(triangle as usize).is_some_and(|marks| *marks != 0)
    }

    /// Whether a triangle has a part in a hard case of a kind.
    #[must_use]
    pub fn is(&self, triangle: u32, kind: Kind) -> bool {
        self.marks.get(triangle as usize).is_some_and(|marks| marks & kind.bit() != 0)
    }
}

/// Where w differs by more than this within a triangle, 1/w in f32 may be off by half a step of 8 bits: the bound is
/// 8 u M times the ratio, with u = 2^-24 and M the largest value.
const WIDE_W: f64 = (1 << 24) as f64 / (8.0 * 512.0);

/// Finds the hard cases of a scene as `target` shows it. It is drawn into `target`.
pub fn find(
    scene: &Scene,
    origins: &[Origin],
    sampled: &Sampled,
    target: &mut Target,
) -> Result<HardCases, BadScene> {
    let pieces = sampled.at_centres();
    let mut search = Search {
        scene,
        pieces,
        sampled,
        window: target.size(),
        marks: vec![0; scene.triangles()],
        found: Vec::new(),
        lines: Vec::new(),
    };
    let drawn = || {
        let on_edges = search.samples_on_edges();
        search.wide_w();
        search.far_textures();
        let picture = draw(scene, target)?;
        let order = search.drawing_order(&picture, target)?;
        let f32_pixels = search.single_precision(&picture, target)?;
        Ok((on_edges, picture, order, f32_pixels))
    };
    let (shape, drawn) = parallel::join(|| Shape::of(scene), drawn);
    let (on_edges, picture, order, f32_pixels) = drawn?;
    search.shape(&shape, origins);
    let mut touched = search.touched()?;
    for (kind, frame) in [(Kind::OnEdge, &on_edges), (Kind::Order, &order)] {
        for (y, row) in frame.rows() {
            for (pixel, _) in touched.row_mut(y).iter_mut().zip(row).filter(|(_, is)| **is) {
                *pixel |= kind.bit();
            }
        }
    }
    let Search { marks, mut found, .. } = search;
    for case in &mut found {
        let pixels = touched.rows().flat_map(|(_, row)| row);
        case.pixels = pixels.filter(|&&bits| bits & case.kind.bit() != 0).count() as u64;
    }
    found.sort_by_key(|case| case.kind);
    let all_w = || pieces.iter().flat_map(|piece| piece.w);
    let w = (!pieces.is_empty())
        .then(|| [all_w().fold(f64::MAX, f64::min), all_w().fold(0.0, f64::max)]);
    let is_cut_short = shape.is_cut_short;
    Ok(HardCases { cases: found, touched, picture, marks, w, f32_pixels, is_cut_short })
}

fn draw(scene: &Scene, target: &mut Target) -> Result<Frame<Colour>, BadScene> {
    Ok(Drawer::Scanline.render(scene, &Effects::PLANNED, target)?.picture)
}

struct Search<'a> {
    scene: &'a Scene,
    pieces: &'a [Piece],
    sampled: &'a Sampled,
    window: PixelRect,
    marks: Vec<u16>,
    found: Vec<HardCase>,
    lines: Vec<(Kind, Edge)>,
}

impl Search<'_> {
    /// Notes what was found of a kind: how many, and the faces concerned, worst or first ones first.
    fn note(&mut self, kind: Kind, count: usize, note: String, faces: impl Iterator<Item = u32>) {
        if count == 0 {
            return;
        }
        let mut first = Vec::new();
        for face in faces {
            self.marks[face as usize] |= kind.bit();
            if first.len() < 3 && !first.contains(&face) {
                first.push(face);
            }
        }
        self.found.push(HardCase { kind, count: count as u64, pixels: 0, note, triangles: first });
    }

    /// Notes faces with how bad each is, in any order; `note` gets that of the worst one.
    fn note_worst(&mut self, kind: Kind, mut found: Vec<(f64, u32)>, note: fn(&str) -> String) {
        found.sort_by(|a, b| b.0.total_cmp(&a.0));
        let worst = found.first().map_or(0.0, |(worst, _)| *worst);
        self.note(kind, found.len(), note(&short(worst)), found.iter().map(|(_, face)| *face));
    }

    fn shape(&mut self, shape: &Shape, origins: &[Origin]) {
        self.note(Kind::NoArea, shape.no_area.len(), String::new(), shape.no_area.iter().copied());
        let worst = shape.slivers.first().map_or(SLIVER, |(aspect, _)| *aspect);
        let note = format!("the longest one is {} times as long as high", short(worst));
        self.note(Kind::Sliver, shape.slivers.len(), note, shape.slivers.iter().map(|(_, f)| *f));
        let (mut concave, mut polygons) = (Vec::new(), 0);
        let mut first = 0;
        for (item, origin) in self.scene.items.iter().zip(origins) {
            concave.extend(origin.concave.iter().map(|number| first + number));
            let faces = origin.concave.iter().map(|&number| origin.face(number as usize));
            let mut faces: Vec<_> = faces.collect();
            faces.dedup();
            polygons += faces.len();
            first += item.mesh.triangles.len() as u32;
        }
        self.note(Kind::Concave, polygons, String::new(), concave.iter().copied());
        let scene = self.scene;
        let same = |pairs: &[[u32; 2]], what: &str| match pairs.first() {
            Some([_, other]) => {
                let face = face_of(scene, origins, *other);
                format!("the first one {what} face {face}")
            }
            None => String::new(),
        };
        let later = shape.duplicates.iter().map(|[face, _]| *face);
        self.note(
            Kind::Duplicate,
            shape.duplicates.len(),
            same(&shape.duplicates, "has the corners of"),
            later,
        );
        let both = shape.overlaps.iter().flatten().copied();
        self.note(Kind::Overlap, shape.overlaps.len(), same(&shape.overlaps, "overlaps"), both);
        let faces = |edges: &[Edge]| edges.iter().map(|edge| edge.face).collect::<Vec<_>>();
        let t = faces(&shape.t_junctions);
        self.note(Kind::TJunction, t.len(), String::new(), t.into_iter());
        let borders = faces(&shape.borders);
        self.note(Kind::Border, borders.len(), String::new(), borders.into_iter());
        let most = shape.crowded.first().map_or(0, |(count, _)| *count);
        let crowded = shape.crowded.iter().map(|(_, edge)| edge.face);
        let note = format!("the most crowded one has {most}");
        self.note(Kind::Crowded, shape.crowded.len(), note, crowded);
        let crowded = shape.crowded.iter().map(|(_, edge)| (Kind::Crowded, *edge));
        self.lines.extend(crowded);
        self.lines.extend(shape.borders.iter().map(|edge| (Kind::Border, *edge)));
        self.lines.extend(shape.t_junctions.iter().map(|edge| (Kind::TJunction, *edge)));
    }

    /// Pixels with a sample on an edge of a piece after snapping.
    fn samples_on_edges(&mut self) -> Frame<bool> {
        let mut on_edge = Frame::new(self.window, false);
        let mut faces = Vec::new();
        let mut count = 0;
        for piece in self.sampled.all() {
            let before = count;
            samples_on_boundary(piece.corners(), self.sampled.window, &mut |x, y| {
                count += 1;
                let [x_px, y_px] = self.sampled.pixel([x, y]);
                on_edge.span_mut(y_px, x_px, x_px + 1)[0] = true;
            });
            if count > before {
                faces.push(piece.face);
            }
        }
        self.note(Kind::OnEdge, count, String::new(), faces.into_iter());
        on_edge
    }

    fn wide_w(&mut self) {
        let ratio = |piece: &Piece| {
            let [a, b, c] = piece.w;
            a.max(b).max(c) / a.min(b).min(c)
        };
        let wide = self.pieces.iter().map(|p| (ratio(p), p.face)).filter(|(r, _)| *r > WIDE_W);
        let note = |worst: &str| format!("the widest one has a ratio of {worst}");
        self.note_worst(Kind::WideW, wide.collect(), note);
    }

    /// Faces of textured materials with a coordinate whose rounding to f32 may be half a texel.
    fn far_textures(&mut self) {
        let mut far: Vec<(f64, u32)> = Vec::new();
        let mut face = 0;
        for item in &self.scene.items {
            let Some(texture) = &item.material.texture else {
                face += item.mesh.triangles.len() as u32;
                continue;
            };
            let (width, height) = texture.size();
            let texels = |uv: glam::DVec2| {
                (uv.x.abs() * f64::from(width)).max(uv.y.abs() * f64::from(height))
            };
            for triangle in item.mesh.triangles.iter() {
                let [a, b, c] = triangle.map_array(|corner| texels(corner.uv));
                let largest = a.max(b).max(c);
                if largest >= f64::from(1 << 23) {
                    far.push((largest, face));
                }
                face += 1;
            }
        }
        let note = |worst: &str| format!("the farthest one is {worst} texels from 0");
        self.note_worst(Kind::FarTexture, far, note);
    }

    /// Pixels that have another colour when all triangles are drawn in the opposite order.
    fn drawing_order(
        &mut self,
        picture: &Frame<Colour>,
        target: &mut Target,
    ) -> Result<Frame<bool>, BadScene> {
        let mut turned = self.scene.clone();
        turned.items.reverse();
        for item in &mut turned.items {
            let mut mesh = Mesh::clone(&item.mesh);
            mesh.triangles.reverse();
            item.mesh = mesh.into();
        }
        let other = draw(&turned, target)?;
        let mut differs = Frame::new(self.window, false);
        let mut count = 0;
        for (x, y) in differing(picture, &other, 0) {
            differs.span_mut(y, x, x + 1)[0] = true;
            count += 1;
        }
        if count > 0 {
            let mut faces = Vec::new();
            for pieces in &self.sampled.planes {
                let order = &mut (0..pieces.len());
                let seen = seen(pieces, self.sampled.window, target.format, order);
                for (y, row) in seen.rows() {
                    for (x, id) in (seen.bounds().x0..).zip(row) {
                        let [x_px, y_px] = self.sampled.pixel([x, y]);
                        if differs.get(x_px, y_px) == Some(true) {
                            faces.extend(pieces.get(*id as usize).map(|piece| piece.face));
                        }
                    }
                }
            }
            faces.sort_unstable();
            faces.dedup();
            self.note(Kind::Order, count, String::new(), faces.into_iter());
        }
        Ok(differs)
    }

    /// Faces of which a corner moves by more than a subpixel when positions are rounded to f32; returns how many
    /// pixels then change.
    fn single_precision(
        &mut self,
        picture: &Frame<Colour>,
        target: &mut Target,
    ) -> Result<u64, BadScene> {
        let mut rounded = self.scene.clone();
        let mut is_rounded = false;
        for item in &mut rounded.items {
            let exact = |p: &DVec3| p.as_vec3().as_dvec3() == *p;
            if !item.mesh.positions.iter().all(exact) {
                let mut mesh = Mesh::clone(&item.mesh);
                let positions = Arc::make_mut(&mut mesh.positions);
                positions.iter_mut().for_each(|p| *p = p.as_vec3().as_dvec3());
                item.mesh = mesh.into();
                is_rounded = true;
            }
        }
        if !is_rounded {
            return Ok(0);
        }
        let moved = pieces(&rounded, self.window)?;
        let mut after = moved.as_slice();
        let mut far: Vec<(f64, u32)> = Vec::new();
        for before in self.pieces.chunk_by(|a, b| a.face == b.face) {
            let face = before[0].face;
            after = &after[after.partition_point(|piece| piece.face < face)..];
            // Cut in another number of pieces, or gone: nothing to measure.
            let now = &after[..after.partition_point(|piece| piece.face == face)];
            if now.len() == before.len() {
                let pairs = before.iter().zip(now);
                let corners = pairs.flat_map(|(a, b)| a.px.into_iter().zip(b.px));
                let most = corners.fold(0f64, |most, ([ax, ay], [bx, by])| {
                    most.max((ax - bx).abs()).max((ay - by).abs())
                });
                if most * f64::from(SUBPIXELS) > 1.0 {
                    far.push((most, face));
                }
            }
        }
        let note = |worst: &str| format!("the farthest corner moves by {worst} px");
        self.note_worst(Kind::SinglePrecision, far, note);
        Ok(differing(picture, &draw(&rounded, target)?, 0).count() as u64)
    }

    /// For each pixel the kinds of the faces that cover its centre, and of the edges that pass through it.
    fn touched(&self) -> Result<Frame<u16>, BadScene> {
        let along = Kind::TJunction.bit() | Kind::Border.bit() | Kind::Crowded.bit();
        let apart = along | Kind::OnEdge.bit() | Kind::Order.bit();
        let mut touched = Frame::new(self.window, 0);
        for piece in self.sampled.all() {
            let bits = self.marks[piece.face as usize] & !apart;
            if bits != 0 {
                Scanline.cover(piece.corners(), self.sampled.window, |span| {
                    let [first, y_px] = self.sampled.pixel([span.x0_px, span.y_px]);
                    let [last, _] = self.sampled.pixel([span.x1_px - 1, span.y_px]);
                    let pixels = touched.span_mut(y_px, first, last + 1);
                    pixels.iter_mut().for_each(|pixel| *pixel |= bits);
                });
            }
        }
        let viewport = Viewport::new(self.window);
        let matrices: Vec<_> = self
            .scene
            .items
            .iter()
            .map(|item| self.scene.projection * self.scene.view * item.model)
            .collect();
        let Some(first) = matrices.first() else { return Ok(touched) };
        // Where items are moved differently, the ends are in the world.
        let in_world = matrices.iter().any(|matrix| matrix != first);
        let matrix = if in_world { self.scene.projection * self.scene.view } else { *first };
        let place = |point: DVec3| {
            let position: DVec4 = matrix * point.extend(1.0);
            let vertex = ClipVertex { position, varying: () };
            let is_inside = position.is_finite() && outcode(&vertex) == 0;
            let at = if is_inside { viewport.place(&vertex).ok() } else { None }?.position;
            let pixel = |sub: i32| sub.div_euclid(SUBPIXELS);
            Some(LineEnd {
                pixel: PixelPoint::new(pixel(at.x), pixel(at.y)),
                depth: 0.0,
                varying: 0.0,
            })
        };
        for (kind, edge) in &self.lines {
            let [Some(a), Some(b)] = edge.ends.map_array(place) else { continue };
            Bresenham.draw(&ScreenLine { ends: [a, b] }, self.window, |f| {
                touched.span_mut(f.y_px, f.x_px, f.x_px + 1)[0] |= kind.bit();
            });
        }
        Ok(touched)
    }
}

/// Calls `emit` with each pixel whose centre lies on an edge; once for each edge.
fn samples_on_boundary(
    corners: [SubpixelPoint; 3],
    window: PixelRect,
    emit: &mut dyn FnMut(i32, i32),
) {
    let centre = |px: i32| i64::from(px) * i64::from(SUBPIXELS) + i64::from(HALF_PIXEL);
    let pixel = |sub: i64| {
        let from_centre = sub - i64::from(HALF_PIXEL);
        (from_centre.rem_euclid(i64::from(SUBPIXELS)) == 0)
            .then(|| from_centre.div_euclid(i64::from(SUBPIXELS)) as i32)
    };
    for (i, j) in [(0, 1), (1, 2), (2, 0)] {
        let [ax, ay, bx, by] =
            [corners[i].x, corners[i].y, corners[j].x, corners[j].y].map(i64::from);
        let [first, last] = [ay.min(by), ay.max(by)].map_array(|y| (y >> 8) as i32);
        for y_px in first.max(window.y0)..=last.min(window.y1 - 1) {
            let y = centre(y_px);
            if y < ay.min(by) || y > ay.max(by) {
                continue;
            }
            if ay == by {
                let [first, last] = [ax.min(bx), ax.max(bx)].map_array(|x| (x >> 8) as i32);
                for x_px in first.max(window.x0)..=last.min(window.x1 - 1) {
                    if (ax.min(bx)..=ax.max(bx)).contains(&centre(x_px)) {
                        emit(x_px, y_px);
                    }
                }
                continue;
            }
            let across = i128::from(y - ay) * i128::from(bx - ax);
            let dy = i128::from(by - ay);
            if across % dy != 0 {
                continue;
            }
            let x_px = pixel(ax + (across / dy) as i64);
            if let Some(x_px) = x_px.filter(|x| (window.x0..window.x1).contains(x)) {
                emit(x_px, y_px);
            }
        }
    }
}

/// A number with three digits.
fn short(value: f64) -> String {
    match value {
        v if v >= 100_000.0 => format!("{v:.1e}"),
        v if v >= 100.0 => format!("{v:.0}"),
        v if v >= 1.0 => format!("{v:.1}"),
        v => format!("{v:.3}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;
    use rasterproof_render::pipeline::depth::DepthFormat;
    use rasterproof_render::pipeline::target::Antialias;
    use rasterproof_render::pipeline::texture::Texture;
    use rasterproof_render::pipeline::transform::perspective;
    use rasterproof_render::scene::{Corner, Item, Material};

    fn triangle(corners: [[f64; 3]; 3], uv: f64) -> Item {
        let positions = Arc::new(corners.map(DVec3::from_array).to_vec());
        let corner = |position: u32| Corner {
            position,
            colour: DVec3::ONE,
            normal: DVec3::Z,
            uv: DVec2::splat(uv * f64::from(position)),
        };
        let texture = Texture::new(2, 2, &[[255, 0, 0], [0, 255, 0], [0, 0, 255], [0; 3]]);
        let material = Material { texture: texture.map(Into::into), ..Material::default() };
        let triangles = [[corner(0), corner(1), corner(2)]].into_iter().collect();
        let mesh = Mesh { positions, triangles };
        Item::new(mesh, material)
    }

    fn found(items: Vec<Item>) -> HardCases {
        let mut scene = Scene::new("test", "", perspective(1.0, 1.0, 1e-5, 1e6).unwrap());
        scene.items = items;
        let mut target = Target::new(64, 64, Antialias::None, DepthFormat::Unorm32).unwrap();
        let sampled = Sampled::of(&scene, &target).unwrap();
        find(&scene, &[], &sampled, &mut target).unwrap()
    }

    fn kinds(items: Vec<Item>) -> (Vec<(Kind, Vec<u32>)>, HardCases) {
        let found = found(items);
        let kinds = found.cases.iter().map(|case| (case.kind, case.triangles.clone()));
        (kinds.filter(|(kind, _)| *kind != Kind::Border).collect(), found)
    }

    #[test]
    fn a_w_range_of_a_milliard_is_found() {
        let near = triangle([[-0.3, -0.4, 1.0], [0.35, -0.4, 1.0], [0.1, 0.45, 2.0]], 1.0);
        assert_eq!(kinds(vec![near.clone()]).0, []);
        let (found, all) = kinds(vec![
            near,
            triangle([[0.0, -1e-4, 2e-4], [5e4, -1e4, 2e5], [-5e4, -1e4, 2e5]], 1.0),
        ]);
        assert_eq!(found, [(Kind::WideW, vec![1])]);
        let [least, most] = all.w.unwrap();
        assert!(most / least >= 0.99e9, "{least} {most}");
    }

    /// A closed mesh whose one corner is a milliard times as near as the others: the three faces there are found, and
    /// nothing else is.
    #[test]
    fn a_w_range_of_a_milliard_in_a_clean_mesh_is_found() {
        let positions =
            [[0.0, -1e-4, 2e-4], [5e4, -1e4, 2e5], [-5e4, -1e4, 2e5], [0.0, -4e4, 2.5e5]];
        let of = |nearest: [f64; 3]| {
            let mut item = triangle([nearest, positions[1], positions[2]], 1.0);
            let mut mesh = Mesh::clone(&item.mesh);
            Arc::make_mut(&mut mesh.positions).push(DVec3::from_array(positions[3]));
            let face = |corners: [u32; 3]| {
                corners.map(|position| Corner { position, ..mesh.triangles.at(0)[0] })
            };
            let faces = [[1, 3, 2], [0, 1, 2], [0, 3, 1], [0, 2, 3]].map(face);
            mesh.triangles = faces.into_iter().collect();
            item.mesh = mesh.into();
            found(vec![item])
        };
        assert!(of([0.0, -1e-4, 1e5]).cases.is_empty());
        let found = of(positions[0]);
        let kinds: Vec<_> = found.cases.iter().map(|case| (case.kind, case.count)).collect();
        assert_eq!(kinds, [(Kind::WideW, 3)]);
        assert!(!found.is_hard(0) && [1, 2, 3].iter().all(|face| found.is(*face, Kind::WideW)));
        let [least, most] = found.w.unwrap();
        assert!(most / least >= 1e9, "{least} {most}");
    }

    #[test]
    fn texture_coordinates_that_f32_cannot_hold_are_found() {
        let corners = [[-0.3, -0.4, 1.0], [0.35, -0.4, 1.0], [0.1, 0.45, 2.0]];
        assert_eq!(kinds(vec![triangle(corners, 1e6)]).0, []);
        assert_eq!(kinds(vec![triangle(corners, 1e7)]).0, [(Kind::FarTexture, vec![0])]);
    }

    /// The same as the count of the oracle, but for corners, which lie on two edges.
    #[test]
    fn samples_on_edges_are_those_of_the_oracle() {
        let p = |x: i32, y: i32| SubpixelPoint::new(x * 64, y * 64);
        let window = PixelRect::window(32, 32);
        for (corners, corners_on) in [
            ([p(2, 2), p(42, 2), p(2, 42)], 3),
            ([p(1, 2), p(41, 22), p(11, 62)], 0),
            ([p(-6, -6), p(154, 26), p(14, 94)], 1),
        ] {
            let mut count = 0;
            samples_on_boundary(corners, window, &mut |_, _| count += 1);
            let inside =
                corners.iter().filter(|c| window.contains(c.x >> 8, c.y >> 8)).count() as u64;
            assert!(corners_on <= inside);
            let expected =
                rasterproof_verify::oracle::coverage::samples_on_boundary(&corners, window);
            assert_eq!(count - corners_on, expected, "{corners:?}");
        }
    }
}
