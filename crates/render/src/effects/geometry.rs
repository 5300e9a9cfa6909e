//! A scene with nothing left out, for what draws frames in a way of its own: the vertex stage and
//! assembly, on the threads of the pool that it is called in.
//!
//! A piece is its outline and a number: where it is and how near. What it looks like is found by the
//! number when it is to be seen, so most of what is hidden costs no attributes. A triangle that a
//! plane cuts is cut again then, to the same bits.

use std::ops::Range;

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::conditions;
use super::plan::{Attributes, ItemPlan, Pieces};
use super::primitive::{BadScene, Prepared, without_place};
use super::{Effects, Mode};
use crate::pipeline::clip::Outcode;
use crate::pipeline::fog::Veil;
use crate::pipeline::highlight::Highlight;
use crate::pipeline::shade::{ALL, Light};
use crate::pipeline::texture::Texture;
use crate::scene::{Hidden, Scene};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_core::parallel;
use rasterproof_core::triangle::{Corners, ScreenVertex};

/// What the pieces of an item have in common, as numbers of what draws them.
pub struct SurfaceMaterial<'a> {
    /// Everything is multiplied by this, in steps of 255.
    pub base: Vec3,
    /// Whether the colours of the corners are.
    pub colours: bool,
    pub light: Option<DirectionalLight>,
    pub texture: Option<&'a Texture>,
    pub highlight: Option<Highlight>,
    /// Nothing where the scene has no fog.
    pub veil: Option<Veil>,
}

/// A [`Light`].
pub struct DirectionalLight {
    /// Towards the light, length 1.
    pub towards: Vec3,
    pub ambient: f32,
    /// What a surface that faces the light gets on top.
    pub diffuse: f32,
}

/// A piece as far as tiles need to know it before it is seen.
#[derive(Clone, Copy)]
pub struct Outline {
    pub corners: Corners,
    /// The depths of the corners.
    pub depths: [f64; 3],
    /// No corner is nearer.
    pub nearest: f32,
    /// The triangle it is of, counted through the scene; above [`FACE_BITS`], 0 where it is whole,
    /// else which part of it.
    number: u32,
}

/// Bits of an [`Outline`]'s number that name the triangle: with seven planes at most eight parts of
/// it are left.
const FACE_BITS: u32 = 28;

/// A piece with all that it looks like.
pub struct Surface<'a> {
    /// What it has in common with others.
    pub material: &'a SurfaceMaterial<'a>,
    pub corners: [ScreenVertex<()>; 3],
    /// Colour, normal and texture coordinates of each corner.
    pub values: [[f64; ALL]; 3],
}

/// A scene in the window.
pub struct Whole<'a> {
    scene: &'a Scene,
    items: Vec<Item<'a>>,
    /// The pixels they are drawn in.
    pub window: PixelRect,
    /// Whether nearer pieces win, or later ones.
    pub depth_test: bool,
}

struct Item<'a> {
    material: SurfaceMaterial<'a>,
    prepared: Prepared<'a>,
    vertices: Vec<Vertex>,
    /// The number of its first triangle.
    first: usize,
}

/// A vertex in the window.
#[derive(Clone, Copy)]
struct Vertex {
    /// Anything where a plane cuts it off.
    place: ScreenVertex<()>,
    /// The planes that do, or [`NOWHERE`].
    code: Outcode,
    /// It must not be there at all.
    bad: bool,
}

/// Beyond the planes: a vertex that has no place all the same.
const NOWHERE: Outcode = 1 << 7;

/// Vertices that are worth a task.
const SHARE: usize = 1024;

impl<'a> Whole<'a> {
    /// Brings the vertices of a scene into a window.
    ///
    /// # Errors
    /// [`BadScene`].
    ///
    /// # Panics
    /// If there are 2^28 triangles or more.
    pub fn new(scene: &'a Scene, window: PixelRect) -> Result<Self, BadScene> {
        assert!(scene.triangles() < 1 << FACE_BITS, "a scene of {} triangles", scene.triangles());
        let mut items: Vec<Item<'a>> = Vec::with_capacity(scene.items.len());
        let mut first = 0;
        for (index, item) in scene.items.iter().enumerate() {
            items.push(Item::new(scene, index, first, window)?);
            first += item.mesh.triangles.len();
        }
        Ok(Self { scene, items, window, depth_test: scene.hidden == Hidden::DepthBuffer })
    }

    /// What is seen where nothing is drawn.
    pub fn background(&self) -> u32 {
        u32::from_le_bytes(self.scene.background)
    }

    /// Whether attributes are interpolated linearly in the window.
    pub fn affine(&self) -> bool {
        self.scene.affine
    }

    /// All triangles in drawing order, in runs of at most `most` of one item.
    pub fn runs(&self, most: usize) -> Vec<(usize, Range<usize>)> {
        let mut runs = Vec::new();
        for (number, item) in self.items.iter().enumerate() {
            let count = item.prepared.item.mesh.triangles.len();
            let starts = (0..count).step_by(most);
            runs.extend(starts.map(|start| (number, start..(start + most).min(count))));
        }
        runs
    }

    /// The pieces of a run of [`Whole::runs`] that are in the window and not culled.
    pub fn outlines(&self, (item, run): &(usize, Range<usize>), emit: &mut impl FnMut(Outline)) {
        let item = &self.items[*item];
        let (prepared, first) = (&item.prepared, item.first + run.start);
        let triangles = &prepared.item.mesh.triangles;
        let positions = &triangles.positions()[run.clone()];
        for (number, positions) in (first as u32..).zip(positions) {
            let [a, b, c] = positions.map_array(|number| &item.vertices[number as usize]);
            if a.code & b.code & c.code != 0 {
                continue;
            }
            if a.code | b.code | c.code != 0 {
                self.cut(item, number as usize - item.first, &mut |part, surface| {
                    emit(outline(&surface.corners, number | (part + 1) << FACE_BITS));
                });
                continue;
            }
            let outline = outline(&[a.place, b.place, c.place], number);
            if !prepared.item.cull.removes(outline.corners) {
                emit(outline);
            }
        }
    }

    /// All pieces, the farthest first; equal distances keep the drawing order.
    pub fn farthest_first(&self) -> Vec<Outline> {
        let runs = self.runs(SHARE);
        let order = |(a, _): &(f64, Outline), (b, _): &(f64, Outline)| b.total_cmp(a);
        let of_runs = parallel::map(runs.len(), |run| {
            let mut outlines = Vec::with_capacity(runs[run].1.len());
            self.outlines(&runs[run], &mut |outline| {
                outlines.push((outline.depths.iter().sum(), outline));
            });
            outlines.sort_by(order);
            outlines
        });
        // The sort of the standard library merges what is sorted already.
        let mut sorted: Vec<_> = of_runs.into_iter().flatten().collect();
        sorted.sort_by(order);
        sorted.into_iter().map(|(_, outline)| outline).collect()
    }

    /// What a piece looks like.
    #[inline]
    pub fn surface(&self, outline: &Outline) -> Surface<'_> {
        let (face, part) = (outline.number & ((1 << FACE_BITS) - 1), outline.number >> FACE_BITS);
        let item = match &self.items[..] {
            [item] => item,
            items => &items[items.partition_point(|item| item.first <= face as usize) - 1],
        };
        let triangle = face as usize - item.first;
        if part != 0 {
            return self.part(item, triangle, part - 1);
        }
        let positions = item.prepared.item.mesh.triangles.positions()[triangle];
        let corners = positions.map_array(|number| item.vertices[number as usize].place);
        let is_back = item.prepared.is_back(outline.corners);
        let varyings = item.prepared.varyings(self.scene, triangle, is_back);
        let values = [0, 1, 2].map_array(|i: usize| without_place(&varyings(i)));
        Surface { material: &item.material, corners, values }
    }

    /// A part of a triangle that a plane cuts.
    #[cold]
    fn part<'s>(&'s self, item: &'s Item<'_>, triangle: usize, number: u32) -> Surface<'s> {
        let mut found = None;
        self.cut(item, triangle, &mut |part, surface| {
            if part == number {
                found = Some(surface);
            }
        });
        found.unwrap_or_else(|| unreachable!("a triangle is cut as it was"))
    }

    /// The parts that are left of a triangle, with their numbers.
    #[cold]
    fn cut<'s>(
        &'s self,
        item: &'s Item<'_>,
        triangle: usize,
        emit: &mut dyn FnMut(u32, Surface<'s>),
    ) {
        let mut parts = 0;
        item.prepared.assemble_one(self.scene, triangle, &mut |piece| {
            let [a, b, c] = &piece.vertices;
            let values = [a, b, c].map_array(|vertex| without_place(&vertex.varying));
            let corners = [a.bare(), b.bare(), c.bare()];
            emit(parts, Surface { material: &item.material, corners, values });
            parts += 1;
        });
    }
}

impl<'a> Item<'a> {
    fn new(
        scene: &'a Scene,
        index: usize,
        first: usize,
        window: PixelRect,
    ) -> Result<Self, BadScene> {
        let item = &scene.items[index];
        let (carries, rule) = conditions::rule(scene, item, &Effects::PLANNED);
        let (clip, cull) = (Mode::Planned, Mode::Planned);
        let plan = ItemPlan { clip, cull, carries, pieces: Pieces::AsTheyCome(rule), parts: None };
        let prepared = Prepared::without_points(scene, index, &plan, window);
        let positions = item.mesh.positions.par_iter().with_min_len(SHARE);
        let vertices: Vec<Vertex> = positions.map(|&p| vertex(&prepared, p)).collect();
        if let Some(bad) = parallel::first(&vertices, |vertex| vertex.bad) {
            prepared.point(bad, item.mesh.positions[bad])?;
        }
        let material = SurfaceMaterial {
            base: (item.material.colour * 255.0).as_vec3(),
            colours: carries.has(Attributes::COLOUR),
            light: carries.has(Attributes::NORMAL).then(|| directional_light(&prepared.light)),
            texture: prepared.texture,
            highlight: (rule.specular != Mode::Never).then_some(prepared.highlight),
            veil: scene.fog.map(|_| prepared.veil),
        };
        Ok(Self { material, prepared, vertices, first })
    }
}

#[inline]
fn vertex(prepared: &Prepared<'_>, position: DVec3) -> Vertex {
    let nowhere =
        ScreenVertex { position: SubpixelPoint::new(0, 0), depth: 0.0, inv_w: 0.0, varying: () };
    let Ok(point) = prepared.point(0, position) else {
        return Vertex { place: nowhere, code: NOWHERE, bad: true };
    };
    match (point.code(), point.vertex()) {
        (_, Some(place)) => Vertex { place, code: 0, bad: false },
        (0, None) => Vertex { place: nowhere, code: NOWHERE, bad: false },
        (code, None) => Vertex { place: nowhere, code, bad: false },
    }
}

fn directional_light(&Light { towards, ambient, diffuse }: &Light) -> DirectionalLight {
    DirectionalLight {
        towards: towards.as_vec3(),
        ambient: ambient as f32,
        diffuse: diffuse as f32,
    }
}

#[inline]
fn outline([a, b, c]: &[ScreenVertex<()>; 3], number: u32) -> Outline {
    let depths = [a.depth, b.depth, c.depth];
    let nearest = below(a.depth.min(b.depth).min(c.depth));
    Outline { corners: [a.position, b.position, c.position], depths, nearest, number }
}

/// The largest f32 that is not larger.
#[inline]
pub fn below(value: f64) -> f32 {
    let near = value as f32;
    if f64::from(near) > value { near.next_down() } else { near }
}
