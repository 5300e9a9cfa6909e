//! Items to pieces: the vertex stage and assembly, with the effects that a plan names for an item.

use std::fmt;
use std::sync::{Arc, LazyLock};

use glam::{DMat3, DMat4, DVec2, DVec3, DVec4};

use super::Mode;
use super::plan::{Attributes, ItemPlan};
use crate::pipeline::assemble::{Assembler, BadVertex, ClipPoint, check_vertex};
use crate::pipeline::fog::Veil;
use crate::pipeline::highlight::Highlight;
use crate::pipeline::physical::{Map, Physical, TextureRead};
use crate::pipeline::punctual::PunctualLight;
use crate::pipeline::shade::{ALL, Attributes as PackedAttributes, Light, PLACED, Surface};
use crate::pipeline::shadow::LightView;
use crate::pipeline::target::Antialias;
use crate::pipeline::texture::Texture;
use crate::pipeline::{ClipVertex, Counters};
use crate::scene::{Item, Scene, Shading};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::{HALF_PIXEL, PixelRect, SUBPIXEL_BITS, SubpixelPoint};
use rasterproof_core::triangle::{Corners, ScreenTriangle, ScreenVertex};

/// A triangle in the window with all attributes.
pub(crate) type Piece = ScreenTriangle<PackedAttributes<PLACED>>;

/// Whether the three 1/w are equal to the bit.
pub(super) fn has_one_w(piece: &Piece) -> bool {
    let [a, b, c] = &piece.vertices;
    a.inv_w == b.inv_w && b.inv_w == c.inv_w
}

#[inline]
pub(super) fn surfaces(piece: &Piece) -> [Surface; 3] {
    let [a, b, c] = &piece.vertices;
    [Surface::from(&a.varying), Surface::from(&b.varying), Surface::from(&c.varying)]
}

/// The first or the second texture coordinates of the corners of a piece.
#[inline]
pub(super) fn uvs(piece: &Piece, is_second: bool) -> [DVec2; 3] {
    surfaces(piece).map_array(|of| of.uv_of(is_second))
}

/// A vertex of an item that has no place in clip space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BadScene {
    pub item: usize,
    /// Which of its positions, and why.
    pub vertex: BadVertex,
}

impl fmt::Display for BadScene {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "item {}: {}", self.item, self.vertex)
    }
}

impl std::error::Error for BadScene {}

/// One item, its positions in clip space and in the window.
pub(super) struct Prepared<'a> {
    pub item: &'a Item,
    pub points: Vec<ClipPoint>,
    pub carries: Attributes,
    pub texture: Option<&'a Texture>,
    pub light: Light,
    pub punctual: &'a [PunctualLight],
    pub highlight: Highlight,
    pub veil: Veil,
    /// Nothing where no light is looked up.
    pub light_view: Option<Arc<LightView>>,
    /// The eye in world space, or the direction to it where w is 0, as it is from everywhere.
    pub eye: DVec4,
    index: usize,
    assembler: Assembler,
    /// From object to clip space.
    matrix: DMat4,
    /// From object to world space for normals.
    normals: DMat3,
    /// The same for tangents, and the sign of what it does to a cross product.
    tangents: (DMat3, f64),
    /// Whether its corners have texture coordinates that are read.
    has_uv: bool,
}

/// What is looked up where texture is paid for and there is none.
pub(super) static WHITE: LazyLock<Texture> = LazyLock::new(Texture::white);

/// Whether light depends on the fragment or triangle: Gouraud's is a colour of the corners.
pub(super) fn is_lit(scene: &Scene, item: &Item) -> bool {
    let has_light = scene.light != Light::NONE || !punctual(scene, item).is_empty();
    matches!(item.material.shading, Shading::Flat | Shading::Phong) && has_light
}

/// The punctual lights of an item: they light physical surfaces alone.
pub(super) fn punctual<'a>(scene: &'a Scene, item: &Item) -> &'a [PunctualLight] {
    if item.material.physical.is_some() { &scene.punctual } else { &[] }
}

/// Whether it matters where in the world a fragment is: from there something is seen, or lit, in a direction of its own.
pub(super) fn has_places(scene: &Scene) -> bool {
    eye(scene).w != 0.0 || scene.punctual.iter().any(|light| light.at.w != 0.0)
}

/// The light of an item. Where there are punctual lights, nothing of it depends on a direction.
pub(super) fn light(scene: &Scene, item: &Item) -> Light {
    match punctual(scene, item) {
        [] => scene.light,
        _ => Light { diffuse: 0.0, ..scene.light },
    }
}

/// The direction against that of the viewing axis. Camera space has z away from the eye.
fn towards_eye(scene: &Scene) -> DVec3 {
    let [x, y, z] =
        [scene.view.x_axis, scene.view.y_axis, scene.view.z_axis].map_array(|axis| axis.z);
    -DVec3::new(x, y, z).normalize_or_zero()
}

/// The highlights of an item in the light of its scene.
pub(super) fn highlight(scene: &Scene, item: &Item) -> Highlight {
    Highlight::new(&item.material.specular, &light(scene, item), towards_eye(scene))
}

/// The eye, where w of clip space grows with the distance; else the direction to it.
pub(super) fn eye(scene: &Scene) -> DVec4 {
    if scene.projection.z_axis.w == 0.0 {
        return towards_eye(scene).extend(0.0);
    }
    scene.view.inverse().w_axis
}

impl<'a> Prepared<'a> {
    /// Transforms the positions of an item and checks them.
    pub fn new(
        scene: &'a Scene,
        index: usize,
        plan: &ItemPlan,
        window: PixelRect,
        counters: &mut Counters,
    ) -> Result<Self, BadScene> {
        let mut prepared = Self::without_points(scene, index, plan, window);
        let positions = &prepared.item.mesh.positions;
        let mut points = Vec::with_capacity(positions.len());
        for (i, &p) in positions.iter().enumerate() {
            points.push(prepared.point(i, p)?);
        }
        counters.vertices += points.len() as u64;
        prepared.points = points;
        Ok(prepared)
    }

    /// The same before a position is transformed.
    pub fn without_points(
        scene: &'a Scene,
        index: usize,
        plan: &ItemPlan,
        window: PixelRect,
    ) -> Self {
        let item = &scene.items[index];
        let texture = item.material.texture.as_deref().unwrap_or(&WHITE);
        let model = DMat3::from_mat4(item.model);
        Self {
            item,
            points: Vec::new(),
            carries: plan.carries,
            texture: plan.carries.has(Attributes::UV).then_some(texture),
            light: if is_lit(scene, item) { light(scene, item) } else { Light::NONE },
            punctual: if is_lit(scene, item) { punctual(scene, item) } else { &[] },
            highlight: highlight(scene, item),
            veil: Veil::new(scene.fog.as_ref(), &scene.projection),
            light_view: None,
            eye: eye(scene),
            index,
            assembler: assembler(item, plan, window),
            matrix: scene.projection * scene.view * item.model,
            normals: model.inverse().transpose(),
            tangents: (model, if model.determinant() < 0.0 { -1.0 } else { 1.0 }),
            has_uv: item.material.textures().next().is_some() || item.material.has_opacity_map(),
        }
    }

    /// A map of the item, where it is physical and has it.
    pub fn map(&self, map: Map) -> Option<TextureRead<'a>> {
        self.physical().and_then(|physical| physical.sampled(map))
    }

    /// Its texture, which is read at the first coordinates.
    pub fn colour(&self) -> Option<TextureRead<'a>> {
        self.texture.map(|texture| (texture, false))
    }

    pub fn physical(&self) -> Option<&'a Physical> {
        self.item.material.physical.as_deref()
    }

    /// The number of the item in its scene.
    pub fn index(&self) -> usize {
        self.index
    }

    /// Transforms position `i`, which is `p`, and checks it.
    #[inline]
    pub fn point(&self, i: usize, p: DVec3) -> Result<ClipPoint, BadScene> {
        let position = self.matrix * p.extend(1.0);
        check_vertex(i, &ClipVertex { position, varying: () })
            .map_err(|vertex| BadScene { item: self.index, vertex })?;
        Ok(self.assembler.point(position))
    }

    /// The vertex stage of the corners of a triangle: all but their positions. What the material has no use for is not read.
    /// The normals of a back are reversed.
    #[inline]
    pub fn varyings(
        &self,
        scene: &Scene,
        triangle: usize,
        is_back: bool,
    ) -> impl Fn(usize) -> PackedAttributes<PLACED> + use<'_> {
        let (material, mesh) = (&self.item.material, &self.item.mesh);
        let (triangles, positions) = (&mesh.triangles, mesh.triangles.positions()[triangle]);
        let mut colours =
            if material.vertex_colours { triangles.colours(triangle) } else { [DVec3::ONE; 3] };
        let mut normals = [DVec3::ZERO; 3];
        let matrix = if is_back { self.normals * -1.0 } else { self.normals };
        match material.shading {
            Shading::Unlit => {}
            Shading::Flat => normals = [matrix * mesh.face_normal(positions); 3],
            Shading::Phong => {
                normals = triangles.normals(triangle).map_array(|normal| matrix * normal);
            }
            Shading::Gouraud => {
                // Light of the corners is light too.
                for (colour, normal) in colours.iter_mut().zip(triangles.normals(triangle)) {
                    *colour *= scene.light.intensity(matrix * normal);
                }
            }
        }
        let uvs = if self.has_uv { triangles.uvs(triangle) } else { [DVec2::ZERO; 3] };
        let has_more = !self.carries.without(Attributes::FIRST).is_empty();
        move |i: usize| {
            let (colour, normal, uv) = (colours[i], normals[i], uvs[i]);
            let mut surface = Surface { colour, normal, uv, ..Surface::NONE };
            if has_more {
                self.add_more(triangle, i, is_back, &mut surface);
            }
            surface.into()
        }
    }

    /// Computes what few items carry of a corner.
    #[inline(never)]
    fn add_more(&self, triangle: usize, corner: usize, is_back: bool, to: &mut Surface) {
        let mesh = &self.item.mesh;
        let position = mesh.triangles.positions()[triangle][corner];
        if let Some(view) = &self.light_view {
            to.place = view.place(self.index, position);
        }
        if self.carries.has(Attributes::WORLD) {
            to.world = self.item.model.transform_point3(mesh.positions[position as usize]);
        }
        if self.carries.has(Attributes::TANGENT) {
            let DVec4 { x, y, z, w } = mesh.triangles.tangents(triangle)[corner];
            let (matrix, sign) = self.tangents;
            // Of a back the turned normal is reversed, and so are all three directions that it is made of.
            let back = if is_back { -1.0 } else { 1.0 };
            to.tangent = (matrix * DVec3::new(x, y, z)).extend(sign * w) * back;
        }
        if self.carries.has(Attributes::SECOND_UV) {
            to.second_uv = mesh.triangles.second_uvs(triangle)[corner];
        }
    }

    /// Whether a piece in the window is lit as a back.
    #[inline]
    pub fn is_back(&self, corners: Corners) -> bool {
        self.assembler.is_back(corners)
    }

    /// Emits the pieces of one triangle, whose positions are transformed for it alone.
    pub fn assemble_one(&self, scene: &Scene, triangle: usize, emit: &mut dyn FnMut(&Piece)) {
        let mesh = &self.item.mesh;
        let point = |number: u32| self.point(number as usize, mesh.positions[number as usize]);
        let [Ok(a), Ok(b), Ok(c)] = mesh.triangles.positions()[triangle].map(point) else { return };
        let varyings = |is_back| self.varyings(scene, triangle, is_back);
        self.assembler.assemble_each([&a, &b, &c], varyings, &mut Counters::default(), emit);
    }

    /// Emits the pieces of every triangle.
    pub fn assemble(
        &self,
        scene: &Scene,
        counters: &mut Counters,
        emit: &mut dyn FnMut(&Piece, &mut Counters),
    ) {
        let mut fills = Counters::default();
        for (triangle, positions) in self.item.mesh.triangles.positions().iter().enumerate() {
            let points = positions.map_array(|number| &self.points[number as usize]);
            let varyings = |is_back| self.varyings(scene, triangle, is_back);
            let emit = |piece: &Piece| emit(piece, &mut fills);
            self.assembler.assemble_each(points, varyings, counters, emit);
        }
        *counters += fills;
    }
}

fn assembler(item: &Item, plan: &ItemPlan, window: PixelRect) -> Assembler {
    let assembler = Assembler::new(window, item.cull).with_two_sides(item.two_sided);
    let assembler = match plan.clip {
        Mode::Planned | Mode::Material => assembler,
        Mode::Always => assembler.with_every_plane(),
        Mode::Never => assembler.without_planes(u8::MAX),
    };
    match plan.cull {
        Mode::Planned | Mode::Material => assembler,
        Mode::Always => assembler.asking_for_winding(),
        Mode::Never => assembler.without_culling(),
    }
}

/// The attributes of a corner that tiles draw.
#[inline]
pub(super) fn without_place(PackedAttributes(all): &PackedAttributes<PLACED>) -> [f64; ALL] {
    std::array::from_fn(|i| all[i])
}

/// The piece with position, depth and w at its corners, and no attributes.
pub(super) fn bare(piece: &Piece) -> ScreenTriangle<PackedAttributes<0>> {
    pack(piece, Attributes::NONE)
}

/// The piece with some attributes alone, in the first of `N` numbers. No fragment reads the numbers after them.
#[inline]
pub(super) fn pack<const N: usize>(
    piece: &Piece,
    some: Attributes,
) -> ScreenTriangle<PackedAttributes<N>> {
    let places = some.places();
    let of = |vertex: &ScreenVertex<PackedAttributes<PLACED>>| {
        let ScreenVertex { position, depth, inv_w, varying: PackedAttributes(all) } = vertex;
        let varying = PackedAttributes(std::array::from_fn(|i| all[usize::from(places[i])]));
        ScreenVertex { position: *position, depth: *depth, inv_w: *inv_w, varying }
    };
    let [a, b, c] = &piece.vertices;
    ScreenTriangle { vertices: [of(a), of(b), of(c)] }
}

/// Pixels that a triangle may touch: those whose centres lie in [min, max), by the fill rule.
pub(super) fn pixel_box(corners: &Corners, margin_px: i32) -> PixelRect {
    let range = |coordinate: fn(&SubpixelPoint) -> i32| {
        let (mut min, mut max) = (i32::MAX, i32::MIN);
        for corner in corners {
            let c = coordinate(corner);
            (min, max) = (min.min(c), max.max(c));
        }
        let first = |sub: i32| (i64::from(sub) + i64::from(HALF_PIXEL - 1)) >> SUBPIXEL_BITS;
        (first(min) as i32 - margin_px, first(max) as i32 + margin_px)
    };
    let ((x0, x1), (y0, y1)) = (range(|corner| corner.x), range(|corner| corner.y));
    PixelRect { x0, y0, x1, y1 }
}

/// Pixels that a triangle in the window of an antialiased picture may touch.
pub(super) fn touched(corners: &Corners, antialias: Antialias) -> PixelRect {
    // In planes of samples, a moved piece lies up to half a pixel off.
    let samples = pixel_box(corners, i32::from(antialias.planes() > 1));
    let scale = antialias.scale() as i32;
    let down = |x: i32| x.div_euclid(scale);
    let up = |x: i32| (x + scale - 1).div_euclid(scale);
    PixelRect { x0: down(samples.x0), y0: down(samples.y0), x1: up(samples.x1), y1: up(samples.y1) }
}
