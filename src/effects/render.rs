//! A scene to a picture, through any rasterizer, with the effects that are paid for.
//!
//! Each triangle is drawn by a kernel that knows at compile time which attributes vary; what is
//! switched off is not in its loop. What is left of a switched-off attribute is a constant, in the
//! same place of the same product, so the bits are the same.

use std::fmt;
use std::sync::LazyLock;

use glam::{DMat3, DVec3, DVec4};

use super::plan::{Depths, Plan, Tally, tiles_to_clear};
use super::samples::OnDemand;
use super::{Effect, Effects, Mode};
use crate::contract::{DrawLine, Interpolate};
use crate::frame::Frame;
use crate::grid::PixelRect;
use crate::pipeline::assemble::{Assembler, BadVertex, check_vertex};
use crate::pipeline::fill::{Way, fill, fill_flat};
use crate::pipeline::present::DoubleBuffer;
use crate::pipeline::shade::{ALL, Attributes, Light, Surface};
use crate::pipeline::target::{Antialias, Colour, Target, to_colour};
use crate::pipeline::texture::Texture;
use crate::pipeline::wireframe::draw_edges;
use crate::pipeline::{ClipVertex, Counters};
use crate::scene::{Corner, Hidden, Item, Scene, Shading};
use crate::triangle::{ScreenTriangle, ScreenVertex};

/// Attributes of a [`Surface`] as bits of a mask.
pub(super) mod bit {
    pub const COLOUR: u8 = 1;
    pub const NORMAL: u8 = 2;
    pub const UV: u8 = 4;
}

/// A triangle in the window with all attributes.
pub(super) type Piece = ScreenTriangle<Attributes<ALL>>;

/// A vertex of an item that has no place in clip space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BadScene {
    /// Which item.
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

/// A frame, what it cost and why.
#[derive(Clone, Debug)]
pub struct Rendered {
    /// The pixels, resolved.
    pub picture: Frame<Colour>,
    /// What was done.
    pub counters: Counters,
    /// What was paid for, and why.
    pub plan: Plan,
}

/// Draws a scene into a target; what the target held before is last frame's.
///
/// Clears, draws, resolves. The depths are in the target afterwards, except where the depth buffer
/// was not called for, or samples were not told apart; with [`Effect::Samples`] off, a picture with
/// several samples a pixel leaves the target as it was.
///
/// # Errors
/// [`BadScene`] before anything is drawn.
pub fn render(
    scene: &Scene,
    engine: &impl Interpolate,
    effects: &Effects,
    target: &mut Target,
) -> Result<Rendered, BadScene> {
    draw(scene, engine, effects, target, &mut Onlooker::None)
}

/// As [`render`], while somebody looks: `look` is shown what is on the screen after the clearing,
/// after each item, and at the end. With [`Effect::SecondBuffer`] that is the front buffer, which
/// changes when the frame is finished; without, the frame as it is drawn.
///
/// # Errors
/// As [`render`].
pub fn render_watched(
    scene: &Scene,
    engine: &impl Interpolate,
    effects: &Effects,
    screen: &mut DoubleBuffer,
    look: &mut dyn FnMut(&Frame<Colour>),
) -> Result<Rendered, BadScene> {
    let (front, back) = screen.split();
    let mut onlooker = Onlooker::Viewer { front, look };
    draw(scene, engine, effects, back, &mut onlooker)
}

/// As [`render`], and for each pixel the effects that its fragments paid for, as bits of
/// [`Effect`] in the order of [`Effect::ALL`].
///
/// # Errors
/// As [`render`].
pub fn render_mapped(
    scene: &Scene,
    engine: &impl Interpolate,
    effects: &Effects,
    target: &mut Target,
) -> Result<(Rendered, Frame<u16>), BadScene> {
    let mut map = Frame::new(target.size(), 0);
    let rendered = draw(scene, engine, effects, target, &mut Onlooker::Map(&mut map))?;
    Ok((rendered, map))
}

/// Draws the edges of a scene's triangles by a line drawer, with the colours of its fragments.
///
/// # Errors
/// As [`render`].
pub fn render_wireframe(
    scene: &Scene,
    drawer: &impl DrawLine,
    target: &mut Target,
) -> Result<Rendered, BadScene> {
    let effects = Effects::PLANNED;
    let mut counters = Counters::default();
    let items = prepare(scene, &effects, target.bounds(), &mut counters)?;
    target.clear_colour(scene.background, &mut counters);
    target.clear_depth(&mut counters);
    let (bounds, format) = (target.bounds(), target.format);
    for item in &items {
        item.assemble(scene, &mut counters, |piece, fills| {
            let plan = PiecePlan { varies: item.reads, affine: scene.affine, depth: true };
            let kernel = Kernel::new(item, piece, plan, fills);
            draw_edges(drawer, piece, bounds, |f| {
                fills.fragments += 1;
                let colour = to_colour(kernel.shade_all(&f.varying));
                for plane in &mut target.planes {
                    plane.test_and_write(f.x_px, f.y_px, format.key(f.depth), || colour);
                }
            });
        });
    }
    let tallies = vec![Tally::default(); items.len()];
    let plan = Plan::new(scene, &items, &tallies, &effects, target, &counters);
    Ok(Rendered { picture: target.resolve(), counters, plan })
}

/// Who wants to know more than the finished picture.
enum Onlooker<'a> {
    None,
    /// Notes for each pixel what it paid for.
    Map(&'a mut Frame<u16>),
    /// Looks at the screen meanwhile.
    Viewer {
        front: &'a mut Frame<Colour>,
        look: &'a mut dyn FnMut(&Frame<Colour>),
    },
}

fn draw(
    scene: &Scene,
    engine: &impl Interpolate,
    effects: &Effects,
    target: &mut Target,
    onlooker: &mut Onlooker<'_>,
) -> Result<Rendered, BadScene> {
    if effects.mode(Effect::Samples) == Mode::Never && target.antialias().samples() > 1 {
        // One sample, in the middle of the pixel.
        return draw(scene, engine, effects, &mut target.single(), onlooker);
    }
    let mut counters = Counters::default();
    let items = prepare(scene, effects, target.bounds(), &mut counters)?;
    let mut frame = Stage {
        onlooker,
        scene,
        engine,
        effects,
        target,
        counters,
        tallies: vec![Tally::default(); items.len()],
        on_demand: None,
        depth_is_called_for: true,
    };
    let collects = scene.hidden == Hidden::Painter
        || effects.mode(Effect::Depth) == Mode::Planned
            && scene.triangles() <= Depths::MOST_TRIANGLES;
    if collects {
        frame.draw_collected(&items)
    } else {
        frame.draw_streaming(&items)
    };
    Ok(frame.finish(&items))
}

/// One item, ready to be assembled.
pub(super) struct Prepared<'a> {
    pub item: &'a Item,
    positions: Vec<DVec4>,
    assembler: Assembler,
    /// From object to world space for normals.
    normals: DMat3,
    /// Attributes that are carried along.
    pub reads: u8,
    texture: Option<&'a Texture>,
    light: Light,
}

/// What is looked up where texture is paid for and there is none.
static WHITE: LazyLock<Texture> = LazyLock::new(Texture::white);

fn prepare<'a>(
    scene: &'a Scene,
    effects: &Effects,
    bounds: PixelRect,
    counters: &mut Counters,
) -> Result<Vec<Prepared<'a>>, BadScene> {
    let camera = scene.projection * scene.view;
    let prepared = |(index, item): (usize, &'a Item)| {
        let matrix = camera * item.model;
        let positions: Vec<DVec4> =
            item.mesh.positions.iter().map(|p| matrix * p.extend(1.0)).collect();
        counters.vertices += positions.len() as u64;
        for (i, &position) in positions.iter().enumerate() {
            check_vertex(i, &ClipVertex { position, varying: () })
                .map_err(|vertex| BadScene { item: index, vertex })?;
        }
        let material = &item.material;
        let pays = |effect, called_for| effects.pays(effect, called_for);
        let colour = material.vertex_colours || material.shading == Shading::Gouraud;
        let light = is_lit(scene, item);
        let mut reads = 0;
        reads |= if pays(Effect::Colour, colour) { bit::COLOUR } else { 0 };
        reads |= if pays(Effect::Light, light) { bit::NORMAL } else { 0 };
        reads |= if pays(Effect::Texture, material.texture.is_some()) { bit::UV } else { 0 };
        let texture = material.texture.as_deref().unwrap_or(&WHITE);
        let mut assembler = Assembler::new(bounds, item.cull);
        match effects.mode(Effect::Clip) {
            Mode::Planned => {}
            Mode::Always => assembler = assembler.with_every_plane(),
            Mode::Never => assembler = assembler.without_planes(u8::MAX),
        }
        match effects.mode(Effect::Cull) {
            Mode::Planned => {}
            Mode::Always => assembler = assembler.asking_for_winding(),
            Mode::Never => assembler = assembler.without_culling(),
        }
        Ok(Prepared {
            item,
            positions,
            assembler,
            normals: DMat3::from_mat4(item.model).inverse().transpose(),
            reads,
            texture: (reads & bit::UV != 0).then_some(texture),
            light: if light { scene.light } else { Light::NONE },
        })
    };
    scene.items.iter().enumerate().map(prepared).collect()
}

/// Whether light depends on the fragment or triangle: Gouraud's is a colour of the corners.
pub(super) fn is_lit(scene: &Scene, item: &Item) -> bool {
    matches!(item.material.shading, Shading::Flat | Shading::Phong) && scene.light != Light::NONE
}

impl Prepared<'_> {
    /// The vertex stage of one corner.
    fn corner(&self, scene: &Scene, corner: &Corner, face: DVec3) -> ClipVertex<Attributes<ALL>> {
        let material = &self.item.material;
        let mut colour = if material.vertex_colours { corner.colour } else { DVec3::ONE };
        if material.shading == Shading::Gouraud {
            let normal = self.normals * corner.normal;
            // Light of the corners is light too.
            colour *= scene.light.intensity(normal);
        }
        let normal = match material.shading {
            Shading::Flat => self.normals * face,
            Shading::Phong => self.normals * corner.normal,
            Shading::Unlit | Shading::Gouraud => DVec3::ZERO,
        };
        let uv = if material.texture.is_some() { corner.uv } else { glam::DVec2::ZERO };
        ClipVertex {
            position: self.positions[corner.position as usize],
            varying: Surface { colour, normal, uv }.into(),
        }
    }

    /// Emits the pieces of every triangle.
    fn assemble(
        &self,
        scene: &Scene,
        counters: &mut Counters,
        mut emit: impl FnMut(&Piece, &mut Counters),
    ) {
        let mut fills = Counters::default();
        for triangle in &self.item.mesh.triangles {
            let face = match self.item.material.shading {
                Shading::Flat => self.item.mesh.face_normal(triangle),
                _ => DVec3::ZERO,
            };
            let corners = [0, 1, 2].map(|i| self.corner(scene, &triangle[i], face));
            self.assembler.assemble(&corners, counters, |piece| emit(piece, &mut fills));
        }
        *counters += fills;
    }
}

/// What is constant over one piece, and what is not.
#[derive(Clone, Copy)]
pub(super) struct PiecePlan {
    /// Attributes that vary.
    pub varies: u8,
    pub affine: bool,
    pub depth: bool,
}

impl PiecePlan {
    /// What a fragment pays for, as bits of [`Effect`].
    fn paid(self) -> u16 {
        let varies = |bit: u8| self.varies & bit != 0;
        [
            (Effect::Perspective, self.varies != 0 && !self.affine),
            (Effect::Depth, self.depth),
            (Effect::Colour, varies(bit::COLOUR)),
            (Effect::Light, varies(bit::NORMAL)),
            (Effect::Texture, varies(bit::UV)),
            (Effect::Interpolation, self.varies != 0),
        ]
        .into_iter()
        .filter(|(_, pays)| *pays)
        .fold(0, |bits, (effect, _)| bits | 1 << effect as u16)
    }
}

/// A frame being drawn.
struct Stage<'a, 'b, E> {
    scene: &'a Scene,
    engine: &'a E,
    effects: &'a Effects,
    target: &'a mut Target,
    counters: Counters,
    tallies: Vec<Tally>,
    on_demand: Option<OnDemand>,
    onlooker: &'a mut Onlooker<'b>,
    depth_is_called_for: bool,
}

impl<E: Interpolate> Stage<'_, '_, E> {
    /// Draws each piece as it comes; every one may overlap another.
    fn draw_streaming(&mut self, items: &[Prepared<'_>]) {
        self.begin(None);
        for (index, item) in items.iter().enumerate() {
            let mut counters = std::mem::take(&mut self.counters);
            item.assemble(self.scene, &mut counters, |piece, fills| {
                self.draw(index, item, piece, true, fills);
            });
            self.counters += counters;
            self.look();
        }
    }

    /// Gathers all pieces first, to see which overlap, or to sort them.
    fn draw_collected(&mut self, items: &[Prepared<'_>]) {
        let mut pieces: Vec<(usize, Piece)> = Vec::new();
        let mut counters = std::mem::take(&mut self.counters);
        for (index, item) in items.iter().enumerate() {
            item.assemble(self.scene, &mut counters, |piece, _| pieces.push((index, *piece)));
        }
        self.counters = counters;
        if self.scene.hidden == Hidden::Painter {
            // Stable, so that equal distances keep the order of submission.
            let distance = |piece: &Piece| piece.vertices.map(|v| v.depth).iter().sum::<f64>();
            pieces.sort_by(|a, b| distance(&b.1).total_cmp(&distance(&a.1)));
        }
        let depths = Depths::of(&pieces, self.target.antialias());
        self.depth_is_called_for = depths.any();
        self.begin(Some(&pieces));
        let mut fills = Counters::default();
        for (i, (index, piece)) in pieces.iter().enumerate() {
            self.draw(*index, &items[*index], piece, depths.overlaps(i), &mut fills);
            if pieces.get(i + 1).is_none_or(|(next, _)| next != index) {
                self.look();
            }
        }
        self.counters += fills;
    }

    /// Clears what is called for, and sets up samples on demand.
    fn begin(&mut self, pieces: Option<&[(usize, Piece)]>) {
        let Self { effects, target, counters, scene, .. } = self;
        let uses_depth = effects.pays(Effect::Depth, self.depth_is_called_for)
            && scene.hidden == Hidden::DepthBuffer;
        let [colours, depths] = [Effect::Clear, Effect::DepthBuffer].map(|e| effects.mode(e));
        if target.antialias().samples() > 1
            && effects.mode(Effect::Samples) == Mode::Planned
            && colours != Mode::Never
            && depths != Mode::Never
        {
            let pixels = target.pixel_count();
            counters.cleared += pixels;
            counters.depths_cleared += if uses_depth { pixels } else { 0 };
            self.on_demand = Some(OnDemand::new(target, scene.background));
        }
        let is_clear = self.on_demand.is_some();
        if colours == Mode::Always || colours == Mode::Planned && !is_clear {
            let tiles = pieces
                .filter(|_| colours == Mode::Planned)
                .and_then(|pieces| tiles_to_clear(self.engine, pieces, target));
            match tiles {
                Some(tiles) => target.clear_tiles(&tiles, scene.background, counters),
                None => target.clear_colour(scene.background, counters),
            }
        }
        if depths == Mode::Always || depths == Mode::Planned && uses_depth && !is_clear {
            target.clear_depth(counters);
        }
        self.look();
    }

    /// Shows a viewer what is on the screen meanwhile.
    fn look(&mut self) {
        let Onlooker::Viewer { front, look } = &mut *self.onlooker else { return };
        if self.effects.pays(Effect::SecondBuffer, true) {
            look(front);
        } else {
            look(&resolve(self.on_demand.as_ref(), self.target));
        }
    }

    /// Decides what one piece calls for, and draws it.
    fn draw(
        &mut self,
        index: usize,
        item: &Prepared<'_>,
        piece: &Piece,
        overlaps: bool,
        counters: &mut Counters,
    ) {
        let plan = self.plan_piece(item, piece, overlaps);
        let word_bits = self.engine.word_bits(&piece.corners());
        counters.wide += u64::from(word_bits > Some(i32::BITS));
        self.tallies[index].count(piece, item.reads, plan, word_bits);
        if let Onlooker::Map(map) = &mut *self.onlooker {
            let paid = plan.paid();
            let scale = self.target.antialias().scale() as i32;
            self.engine.cover(piece.corners(), self.target.bounds(), |span| {
                let (x0_px, x1_px) = (span.x0_px / scale, (span.x1_px - 1) / scale + 1);
                for pixel in map.span_mut(span.y_px / scale, x0_px, x1_px) {
                    *pixel |= paid;
                }
            });
        }
        let kernel = Kernel::new(item, piece, plan, counters);
        kernel.draw(self.engine, piece, self.target, self.on_demand.as_mut(), counters);
    }

    fn plan_piece(&self, item: &Prepared<'_>, piece: &Piece, overlaps: bool) -> PiecePlan {
        let [a, b, c] = &piece.vertices;
        let varies = match self.effects.mode(Effect::Interpolation) {
            Mode::Always => item.reads,
            Mode::Never => 0,
            Mode::Planned => item.reads & varying(piece),
        };
        let one_w = a.inv_w == b.inv_w && b.inv_w == c.inv_w;
        PiecePlan {
            varies,
            affine: self.scene.affine
                || !self.effects.pays(Effect::Perspective, !one_w && varies != 0),
            depth: self.scene.hidden == Hidden::DepthBuffer
                && self.effects.pays(Effect::Depth, overlaps),
        }
    }

    fn finish(self, items: &[Prepared<'_>]) -> Rendered {
        let Self { mut counters, effects, .. } = self;
        let pixels = self.target.pixel_count();
        let has_samples = self.target.antialias().samples() > 1;
        counters.expanded += if has_samples && self.on_demand.is_none() { pixels } else { 0 };
        let picture = resolve(self.on_demand.as_ref(), self.target);
        let is_watched = matches!(self.onlooker, Onlooker::Viewer { .. });
        let presents = effects.pays(Effect::SecondBuffer, is_watched);
        counters.presented += if presents { pixels } else { 0 };
        // What is presented is a copy: the back buffer goes on to the next frame.
        let picture = if presents { picture.clone() } else { picture };
        match self.onlooker {
            Onlooker::None => {}
            Onlooker::Map(map) => {
                if has_samples {
                    mark_samples(map, self.on_demand.as_ref());
                }
            }
            Onlooker::Viewer { front, look } => {
                front.clone_from(&picture);
                look(front);
            }
        }
        let plan = Plan::new(self.scene, items, &self.tallies, effects, self.target, &counters);
        Rendered { picture, counters, plan }
    }
}

/// The picture so far.
fn resolve(on_demand: Option<&OnDemand>, target: &Target) -> Frame<Colour> {
    on_demand.map_or_else(|| target.resolve(), |on_demand| on_demand.resolve(target))
}

/// Marks the pixels whose samples were told apart.
fn mark_samples(map: &mut Frame<u16>, on_demand: Option<&OnDemand>) {
    let bounds = map.bounds();
    for y_px in bounds.y0..bounds.y1 {
        for (x_px, pixel) in (bounds.x0..).zip(map.row_mut(y_px)) {
            if on_demand.is_none_or(|on_demand| on_demand.was_apart(x_px, y_px)) {
                *pixel |= 1 << Effect::Samples as u16;
            }
        }
    }
}

/// The attributes that are not the same bits at the three vertices.
#[inline]
fn varying(piece: &Piece) -> u8 {
    let [a, b, c] = piece.vertices.map(|vertex| vertex.varying.0.map(f64::to_bits));
    let differs = |range: std::ops::Range<usize>| {
        a[range.clone()] != b[range.clone()] || b[range.clone()] != c[range]
    };
    let mut mask = 0;
    mask |= if differs(0..3) { bit::COLOUR } else { 0 };
    mask |= if differs(3..6) { bit::NORMAL } else { 0 };
    mask |= if differs(6..8) { bit::UV } else { 0 };
    mask
}

/// Draws one piece: constants, and what is left to do in each fragment.
struct Kernel<'a> {
    plan: PiecePlan,
    /// base x colour of the corners, where it does not vary.
    base: DVec3,
    texture: Option<&'a Texture>,
    /// The texel, where it does not vary.
    texel: DVec3,
    light: Light,
    /// The light, where it does not vary.
    intensity: f64,
}

impl<'a> Kernel<'a> {
    fn new(item: &Prepared<'a>, piece: &Piece, plan: PiecePlan, counters: &mut Counters) -> Self {
        let first = Surface::from(piece.vertices[0].varying);
        let constant = |bit: u8| item.reads & bit != 0 && plan.varies & bit == 0;
        let mut kernel = Self {
            plan,
            base: item.item.material.colour,
            texture: item.texture,
            texel: DVec3::ONE,
            light: item.light,
            intensity: 1.0,
        };
        if constant(bit::COLOUR) {
            kernel.base *= first.colour;
        }
        if let (Some(texture), true) = (item.texture, constant(bit::UV)) {
            counters.texels += 1;
            kernel.texel = texture.at(first.uv);
        }
        if constant(bit::NORMAL) {
            counters.lights += 1;
            kernel.intensity = item.light.intensity(first.normal);
        }
        kernel
    }

    fn draw(
        &self,
        engine: &impl Interpolate,
        piece: &Piece,
        target: &mut Target,
        samples: Option<&mut OnDemand>,
        counters: &mut Counters,
    ) {
        match self.plan.varies {
            0 => self.draw_flat(engine, piece, target, samples, counters),
            1 => self.draw_as::<3, 1>(engine, piece, target, samples, counters),
            2 => self.draw_as::<3, 2>(engine, piece, target, samples, counters),
            3 => self.draw_as::<6, 3>(engine, piece, target, samples, counters),
            4 => self.draw_as::<2, 4>(engine, piece, target, samples, counters),
            5 => self.draw_as::<5, 5>(engine, piece, target, samples, counters),
            6 => self.draw_as::<5, 6>(engine, piece, target, samples, counters),
            _ => self.draw_as::<ALL, 7>(engine, piece, target, samples, counters),
        }
    }

    /// One colour.
    fn draw_flat(
        &self,
        engine: &impl Interpolate,
        piece: &Piece,
        target: &mut Target,
        samples: Option<&mut OnDemand>,
        counters: &mut Counters,
    ) {
        let colour = to_colour(self.shade::<0, 0>(&Attributes([])));
        let shaded = counters.shaded;
        if let Some(on_demand) = samples {
            on_demand.draw_flat(engine, piece, self.plan.depth, colour, target, counters);
        } else if !self.plan.depth && target.antialias() != Antialias::Multisample4 {
            fill_flat(engine, piece.corners(), target, colour, counters);
        } else {
            let way = Way { affine: true, depth_test: self.plan.depth };
            let bounds = target.bounds();
            fill(engine, &pack::<0, 0>(piece), target, bounds, way, |_| colour, counters);
        }
        // A constant is no run of the fragment stage.
        counters.shaded = shaded;
    }

    /// The kernel for the `N` components of the attributes in `MASK`.
    fn draw_as<const N: usize, const MASK: u8>(
        &self,
        engine: &impl Interpolate,
        piece: &Piece,
        target: &mut Target,
        samples: Option<&mut OnDemand>,
        counters: &mut Counters,
    ) {
        let packed = pack::<N, MASK>(piece);
        let way = Way { affine: self.plan.affine, depth_test: self.plan.depth };
        let before = *counters;
        let stage = |varying: &Attributes<N>| to_colour(self.shade::<N, MASK>(varying));
        if let Some(on_demand) = samples {
            on_demand.draw_varying(engine, piece, &packed, target, way, stage, counters);
        } else {
            fill(engine, &packed, target, target.bounds(), way, stage, counters);
        }
        let (fragments, shaded) =
            (counters.fragments - before.fragments, counters.shaded - before.shaded);
        counters.components += fragments * N as u64;
        counters.divisions += if way.affine { 0 } else { fragments };
        counters.texels += if MASK & bit::UV != 0 { shaded } else { 0 };
        counters.lights += if MASK & bit::NORMAL != 0 { shaded } else { 0 };
    }

    /// The colour of all attributes, for what has no kernel of its own.
    fn shade_all(&self, varying: &Attributes<ALL>) -> DVec3 {
        let Surface { colour, normal, uv } = (*varying).into();
        let varies = |bit: u8| self.plan.varies & bit != 0;
        let texel = self.texture.filter(|_| varies(bit::UV)).map_or(self.texel, |t| t.at(uv));
        let intensity =
            if varies(bit::NORMAL) { self.light.intensity(normal) } else { self.intensity };
        let colour = if varies(bit::COLOUR) { self.base * colour } else { self.base };
        colour * texel * intensity
    }

    /// base x colour x texel x light; what is not in `MASK` is constant.
    #[inline]
    fn shade<const N: usize, const MASK: u8>(&self, varying: &Attributes<N>) -> DVec3 {
        let mut rest = varying.0.iter().copied();
        let mut next = || rest.next().unwrap_or_default();
        let mut colour = self.base;
        if MASK & bit::COLOUR != 0 {
            colour *= DVec3::new(next(), next(), next());
        }
        let intensity = if MASK & bit::NORMAL != 0 {
            self.light.intensity(DVec3::new(next(), next(), next()))
        } else {
            self.intensity
        };
        let texel = match self.texture {
            Some(texture) if MASK & bit::UV != 0 => texture.at(glam::DVec2::new(next(), next())),
            _ => self.texel,
        };
        colour * texel * intensity
    }
}

/// The piece with the attributes of `MASK` alone.
pub(super) fn pack<const N: usize, const MASK: u8>(piece: &Piece) -> ScreenTriangle<Attributes<N>> {
    let vertices = piece.vertices.map(|vertex| {
        let all = &vertex.varying.0;
        let mut packed = [0.0; N];
        let mut at = 0;
        for (mask, range) in [(bit::COLOUR, 0..3), (bit::NORMAL, 3..6), (bit::UV, 6..8)] {
            if MASK & mask != 0 {
                packed[at..at + range.len()].copy_from_slice(&all[range.clone()]);
                at += range.len();
            }
        }
        ScreenVertex {
            position: vertex.position,
            depth: vertex.depth,
            inv_w: vertex.inv_w,
            varying: Attributes(packed),
        }
    });
    ScreenTriangle { vertices }
}
