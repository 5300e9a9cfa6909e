//! Kernels: each piece is drawn by code that knows at compile time which attributes vary.
//!
//! What is switched off is not in its loop. What is left of a switched-off attribute is a constant,
//! in the same place of the same product, so the bits are the same.

use std::cell::{Cell, RefCell};

use glam::{DVec2, DVec3, DVec4};

use super::conditions::mip_maps::{footprint, is_affine};
use super::parts::Constants;
use super::plan::{Attributes, PiecePlan};
use super::primitive::{Piece, Prepared, WHITE, bare, pack, surfaces};
use super::samples::OnDemand;
use crate::pipeline::Counters;
use crate::pipeline::fill::{FragmentStage, Way, each, fill, fill_flat};
use crate::pipeline::fog::{Share, Veil};
use crate::pipeline::footprint::Reading;
use crate::pipeline::highlight::{Highlight, brightened};
use crate::pipeline::opacity::{Drawn, Opacity};
use crate::pipeline::physical::{Lights, Map, Parts, Physical, Point, TextureRead};
use crate::pipeline::punctual::PunctualLight;
use crate::pipeline::see_through::{self, Look};
use crate::pipeline::shade::{Attributes as PackedAttributes, Light, PLACED, Surface};
use crate::pipeline::shadow::{Receiver, ShadowMap, TAPS, dimmed};
use crate::pipeline::target::{Antialias, Colour, Target, to_colour};
use crate::pipeline::texture::{FourTexels, Texture};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::Interpolate;
use rasterproof_core::grid::PixelRect;

/// So many components have two attributes without a place in the light: most of what is seen through.
const SMALL: usize = 6;

/// In runs of fewer fragments each highlight and each share of fog is computed.
const SHORT: usize = 4;

/// Where a piece is drawn and how far, with the pixels where their samples are told apart on demand, and what is counted.
type To<'a> = (&'a mut Target, PixelRect, Option<&'a mut OnDemand>, &'a mut Counters);

/// What was counted before a piece was drawn.
struct Before {
    fragments: u64,
    shaded: u64,
}

impl Before {
    fn of(counters: &Counters) -> Self {
        Self { fragments: counters.fragments, shaded: counters.shaded }
    }
}

/// The colour of the first wanted fragment.
fn first(colours: &[Colour], wanted: u32) -> Colour {
    colours[wanted.trailing_zeros() as usize]
}

/// The highlight of all wanted fragments of a run, whose normals begin at component `normal`; nothing where it is not known that
/// they have one, or where the first has none.
fn one_shine<const N: usize>(
    highlight: &Highlight,
    varyings: &[PackedAttributes<N>],
    normal: usize,
    wanted: u32,
) -> Option<[u8; 3]> {
    let at = |i: usize| {
        let normal = varyings.get(i)?.0.get(normal..normal + 3)?;
        Some(DVec3::from_slice(normal))
    };
    let first = wanted.trailing_zeros() as usize;
    let last = (u32::BITS - 1 - wanted.leading_zeros()) as usize;
    if last < first + SHORT || highlight.at(at(first)?) == [0; 3] {
        return None;
    }
    let mut ends = [f64::INFINITY, f64::NEG_INFINITY];
    for i in (first..=last).filter(|i| wanted >> i & 1 != 0) {
        let cosine = highlight.cosine(at(i)?);
        if !cosine.is_finite() {
            return None;
        }
        ends = [ends[0].min(cosine), ends[1].max(cosine)];
    }
    highlight.one_between(ends[0], ends[1])
}

fn fill_wanted(colour: Colour, wanted: u32, colours: &mut [Colour]) {
    for (i, own) in colours.iter_mut().enumerate() {
        *own = if wanted >> i & 1 != 0 { colour } else { *own };
    }
}

/// How textures are read at levels of detail or several times; the veil gives w, which is 1 where there is none.
type HowRead<'a> = (Reading, Option<&'a Veil>);

/// Draws one piece: constants, and what is left to do in each fragment.
pub(super) struct Kernel<'a> {
    plan: PiecePlan,
    /// base x colour of the corners, where it does not vary.
    base: DVec3,
    texture: Option<&'a Texture>,
    /// The texel, where it does not vary.
    texel: DVec3,
    light: Light,
    /// The light and the normal, where they do not vary.
    intensity: f64,
    normal: DVec3,
    /// Where it is looked up which part of the light arrives.
    receiver: Option<Receiver<'a>>,
    /// The same, where it does not vary.
    lit: u32,
    /// Nothing where normals do not vary, or no highlight reaches them.
    highlight: Option<&'a Highlight>,
    /// The highlight, where it does not vary.
    shine: [u8; 3],
    /// Where each fragment has its own share of fog.
    veil: Option<&'a Veil>,
    /// Where textures are read at levels of detail or several times.
    reading: Option<HowRead<'a>>,
    /// How often the texture was read where it may be read several times.
    taps: Cell<u64>,
    /// The texels of the last fragment, where neighbours mostly read the same ones. Whoever draws a part of a piece keeps them:
    /// most kernels have none, and would be much larger with them.
    pub last: Option<&'a RefCell<FourTexels>>,
    /// The colour of a piece of which nothing but fog is seen.
    fogged: Option<Colour>,
    /// Of pieces that are not opaque everywhere.
    opacity: Option<&'a Opacity>,
    /// The opacity, where it does not vary and is not that of the first corner.
    first_opacity: Option<u8>,
    /// Whether it is checked if all fragments of a run have one colour in the fog or one highlight.
    checks_runs: bool,
    /// What a physical surface has; nothing of another one.
    coat: Option<&'a Coat<'a>>,
}

/// What a physical surface has beside base colour, normal and light.
pub(super) struct Coat<'a> {
    surface: &'a Physical,
    parts: Parts,
    punctual: &'a [PunctualLight],
    /// The maps that are read in each fragment.
    maps: [Option<&'a Texture>; Map::ALL.len()],
    /// How those at the second texture coordinates are read at levels of detail or several times.
    reading: Option<HowRead<'a>>,
    /// The texels of maps that have one colour where the piece reads them.
    texels: [DVec3; Map::ALL.len()],
    eye: DVec4,
    /// Place and tangent, where they do not vary.
    world: DVec3,
    tangent: DVec4,
}

impl<'a> Coat<'a> {
    /// Nothing for a surface that is not physical. It lies beside the kernel and not in it, since a kernel is copied.
    #[inline]
    pub fn of(
        item: &'a Prepared<'_>,
        piece: &Piece,
        plan: PiecePlan,
        counters: &mut Counters,
    ) -> Option<Self> {
        Some(Self::new(item, item.physical()?, piece, plan, counters))
    }

    fn new(
        item: &'a Prepared<'_>,
        surface: &'a Physical,
        piece: &Piece,
        plan: PiecePlan,
        counters: &mut Counters,
    ) -> Self {
        let first = Surface::from(&piece.vertices[0].varying);
        let (world, tangent) = (first.world, first.tangent);
        let [emission, reflection, occlusion, bumps] =
            [plan.emission, plan.reflection, plan.occlusion, plan.normal_maps];
        let (mut maps, mut texels) = ([None; Map::ALL.len()], Map::ALL.map(Map::missing));
        for (map, is_read) in Map::ALL.into_iter().zip([emission, reflection, occlusion, bumps]) {
            let Some(read) = surface.sampled(map).filter(|_| is_read) else { continue };
            let (texture, is_second) = read;
            if plan.interpolates.has(Attributes::uv(is_second)) {
                maps[map as usize] = Some(texture);
            } else if item.carries.has(Attributes::uv(is_second)) {
                counters.texels += 1;
                texels[map as usize] = texture.at(first.uv_of(is_second));
            }
        }
        let mut reading = None;
        if plan.reads_around() && plan.interpolates.has(Attributes::SECOND_UV) {
            // All are read in one way but for their sizes.
            reading = Some(how_read(item, (&WHITE, true), piece, plan));
        }
        let parts = Parts { emission, reflection, occlusion, bumps };
        let punctual = if plan.punctual { item.punctual } else { &[] };
        Self { surface, parts, punctual, maps, reading, texels, eye: item.eye, world, tangent }
    }

    /// Counts what so many evaluations have paid for.
    fn count(&self, shaded: u64, counters: &mut Counters) {
        let where_true = |pays: bool| if pays { shaded } else { 0 };
        counters.reflections += where_true(self.parts.reflection);
        counters.punctual += where_true(!self.punctual.is_empty());
        counters.bumped += where_true(self.parts.bumps);
        counters.occluded += where_true(self.parts.occlusion);
        counters.emitted += where_true(self.parts.emission);
        counters.texels += shaded * self.maps.iter().flatten().count() as u64;
    }
}

/// How textures of a piece are read at levels of detail or several times; the size in it is that of this one.
fn how_read<'a>(
    item: &'a Prepared<'_>,
    read: TextureRead<'_>,
    piece: &Piece,
    plan: PiecePlan,
) -> HowRead<'a> {
    let veil = (!is_affine(piece, plan.perspective)).then_some(&item.veil);
    let (footprint, ..) = footprint(read, piece, plan.perspective);
    let (at_levels, is_anisotropic) = (plan.mip_maps, plan.anisotropy);
    (Reading { footprint, at_levels, is_anisotropic }, veil)
}

impl<'a> Kernel<'a> {
    #[inline]
    pub fn new(
        item: &'a Prepared<'_>,
        piece: &Piece,
        plan: PiecePlan,
        map: Option<&'a ShadowMap>,
        part: Option<&Constants>,
        coat: Option<&'a Coat<'a>>,
        counters: &mut Counters,
    ) -> Self {
        let constants = part.copied().unwrap_or_default();
        let first = Surface::from(&piece.vertices[0].varying);
        let constant = |bit: u8| item.carries.has(bit) && !plan.interpolates.has(bit);
        let mut kernel = Self {
            plan,
            base: item.item.material.colour,
            texture: item.texture,
            texel: DVec3::ONE,
            light: item.light,
            intensity: 1.0,
            normal: first.normal,
            receiver: None,
            lit: constants.lit.unwrap_or(TAPS),
            first_opacity: constants.opacity,
            checks_runs: part.is_some(),
            highlight: None,
            shine: [0; 3],
            fogged: None,
            opacity: item.item.material.opacity.as_ref().filter(|_| !plan.replaces_all()),
            reading: None,
            taps: Cell::new(0),
            last: None,
            veil: (plan.fog != Share::None).then_some(&item.veil),
            coat: None,
        };
        if plan.fog == Share::Whole && plan.is_one_colour() && kernel.opacity.is_none() {
            kernel.veil = None;
            kernel.fogged = Some(item.veil.colour());
            return kernel;
        }
        if constant(Attributes::COLOUR) {
            kernel.base *= first.colour;
        }
        if let (Some(texture), true) =
            (item.texture, plan.reads_around() && plan.interpolates.has(Attributes::UV))
        {
            kernel.reading = Some(how_read(item, (texture, false), piece, plan));
        }
        if let (Some(texture), true) = (item.texture, constant(Attributes::UV)) {
            counters.texels += 1;
            kernel.texel = constants.texel.unwrap_or_else(|| texture.at(first.uv));
        }
        if let (Some(view), Some(map)) = (&item.light_view, map) {
            let places = surfaces(piece).map_array(|of| of.place);
            let receiver = view.receiver(map, places);
            if plan.interpolates.has(Attributes::PLACE) {
                kernel.receiver = Some(receiver);
            } else {
                counters.shadowed += 1;
                kernel.lit = receiver.lit(first.place);
            }
        }
        if constant(Attributes::NORMAL) {
            counters.lights += 1;
            kernel.intensity = item.light.intensity_in(first.normal, kernel.lit);
        }
        if plan.specular && plan.interpolates.has(Attributes::NORMAL) {
            kernel.highlight = Some(&item.highlight);
        } else if plan.specular && item.carries.has(Attributes::NORMAL) {
            counters.highlights += 1;
            kernel.shine = dimmed(item.highlight.at(first.normal), kernel.lit);
        }
        if let Some(coat) = coat {
            kernel.reading = kernel.reading.or(coat.reading);
            kernel.coat = Some(coat);
            if plan.is_one_colour() {
                coat.count(1, counters);
            }
        }
        kernel
    }

    pub fn draw(
        &self,
        engine: &impl Interpolate,
        piece: &Piece,
        bounds: PixelRect,
        target: &mut Target,
        samples: Option<&mut OnDemand>,
        counters: &mut Counters,
    ) {
        let to = (target, bounds, samples, counters);
        if let Some(opacity) = self.opacity {
            if self.plan.interpolates.components() <= SMALL {
                self.draw_see_through::<SMALL>(engine, piece, to, opacity);
            } else {
                self.draw_see_through::<PLACED>(engine, piece, to, opacity);
            }
            return;
        }
        if self.plan.is_one_colour() {
            self.draw_flat(engine, piece, to);
            return;
        }
        if self.coat.is_some() {
            match self.plan.interpolates.components() {
                0 => self.draw_any::<0>(engine, piece, to),
                1..=8 => self.draw_any::<8>(engine, piece, to),
                _ => self.draw_any::<PLACED>(engine, piece, to),
            }
            return;
        }
        let varies = self.plan.interpolates.has(Attributes::NORMAL);
        let is_partly_lit = self.receiver.is_some() || (varies && self.lit != TAPS);
        // Few pieces have more than two attributes or a part of the light: one stage is for them all.
        match (self.plan.interpolates.0, self.plan.interpolates.components()) {
            (1.., 0..=3) if is_partly_lit => self.draw_any::<3>(engine, piece, to),
            (1.., 0..=6) if is_partly_lit => self.draw_any::<6>(engine, piece, to),
            (0, _) => self.draw_as::<0, 0>(engine, piece, to),
            (1, _) => self.draw_as::<3, 1>(engine, piece, to),
            (2, _) => self.draw_as::<3, 2>(engine, piece, to),
            (3, _) => self.draw_as::<6, 3>(engine, piece, to),
            (4, _) => self.draw_as::<2, 4>(engine, piece, to),
            (5, _) => self.draw_as::<5, 5>(engine, piece, to),
            (6, _) => self.draw_as::<5, 6>(engine, piece, to),
            (_, 0..=8) => self.draw_any::<8>(engine, piece, to),
            _ => self.draw_any::<PLACED>(engine, piece, to),
        }
    }

    fn draw_flat(
        &self,
        engine: &impl Interpolate,
        piece: &Piece,
        (target, bounds, samples, counters): To<'_>,
    ) {
        let shade = || match self.coat {
            Some(_) => self.shade_all(&[], 0.0),
            None => brightened(self.shade::<0, 0, true>(&PackedAttributes([]), 0.0), self.shine),
        };
        let colour = self.fogged.unwrap_or_else(shade);
        let shaded = counters.shaded;
        if let Some(on_demand) = samples {
            on_demand.draw_flat(engine, piece, self.plan, colour, target, counters);
        } else if !self.plan.depth && target.antialias() != Antialias::Multisample4 {
            fill_flat(engine, piece.corners(), target, bounds, colour, counters);
        } else {
            let way = Way { affine: true, depth_test: self.plan.depth };
            let stage = each(|_, _| colour);
            fill(engine, &bare(piece), target, bounds, way, &stage, counters);
        }
        // A constant is no run of the fragment stage.
        counters.shaded = shaded;
    }

    /// Draws a piece that is not opaque everywhere and has attributes of at most `N` components.
    fn draw_see_through<const N: usize>(
        &self,
        engine: &impl Interpolate,
        piece: &Piece,
        (target, bounds, samples, counters): To<'_>,
        opacity: &Opacity,
    ) {
        let PiecePlan { interpolates, perspective, depth, layers, .. } = self.plan;
        if samples.is_some_and(|on_demand| {
            !on_demand.tell_box_apart(engine, piece, depth, target, counters)
        }) {
            return;
        }
        let packed = pack::<N>(piece, interpolates);
        let of_first = self
            .first_opacity
            .unwrap_or_else(|| opacity.of(Surface::from(&piece.vertices[0].varying).uv));
        let has_uv = interpolates.has(Attributes::UV);
        let last = self.last.is_some().then(|| RefCell::new(FourTexels::NONE));
        let levels = self.reading.as_ref().zip(opacity.levels());
        let start = self.start(Attributes::UV);
        let of = |values: &[f64], depth: f64| {
            let uv = DVec2::from_slice(&values[start..]);
            match (levels, &last) {
                (Some(((reading, veil), texture)), _) => {
                    let w = veil.map_or(1.0, |veil| veil.w(depth));
                    opacity.of_texel(reading.texel(texture, uv, w).0.x)
                }
                (None, Some(last)) => opacity.of_again(uv, &mut last.borrow_mut()),
                (None, None) => opacity.of(uv),
            }
        };
        let look = Look {
            constant: interpolates.is_empty().then_some(PackedAttributes([0.0; N])),
            is_kept: layers,
            opacity: &|varying, depth| if has_uv { of(&varying.0, depth) } else { of_first },
            colour: &|varying, depth| self.shade_all(&varying.0, depth),
        };
        let way = Way { affine: !perspective, depth_test: depth };
        let before = Before::of(counters);
        let visible = see_through::fill(engine, &packed, target, bounds, way, &look, counters);
        self.count(before, if interpolates.is_empty() { 0 } else { N }, counters);
        let of = |drawn: Drawn| if drawn == Drawn::Mixed { visible } else { 0 };
        counters.alpha_tests += of(self.plan.alpha_test);
        counters.blended += of(self.plan.blending);
    }

    /// Counts what the fragments since `before`, of so many components each, have paid for.
    #[inline]
    fn count(&self, before: Before, components: usize, counters: &mut Counters) {
        let fragments = counters.fragments - before.fragments;
        let shaded = counters.shaded - before.shaded;
        counters.components += fragments * components as u64;
        let where_true = |pays: bool, count: u64| if pays { count } else { 0 };
        counters.divisions += where_true(self.plan.perspective, fragments);
        counters.texels += where_true(self.varying_texture().is_some(), shaded);
        counters.highlights += where_true(self.highlight.is_some(), shaded);
        counters.shadowed += where_true(self.receiver.is_some(), shaded);
        counters.fogged += where_true(self.veil.is_some(), shaded);
        counters.levels += where_true(self.plan.mip_maps && self.reading.is_some(), shaded);
        counters.taps += self.taps.take();
        counters.lights += where_true(self.plan.interpolates.has(Attributes::NORMAL), shaded);
        if let Some(coat) = self.coat {
            coat.count(shaded, counters);
        }
    }

    /// The kernel for the `N` components of the attributes in `MASK`.
    fn draw_as<const N: usize, const MASK: u8>(
        &self,
        engine: &impl Interpolate,
        piece: &Piece,
        to: To<'_>,
    ) {
        let (plain, other) = (self.plain_stage::<N, MASK>(), self.stage::<N, MASK>());
        let stage: &FragmentStage<'_, PackedAttributes<N>> =
            if self.is_plain() { &plain } else { &other };
        self.draw_by(engine, piece, to, stage);
    }

    /// Whether a fragment has no highlight and no fog, and reads its texture once, without the texels of the last one.
    fn is_plain(&self) -> bool {
        let reads_once = self.reading.is_none() && self.last.is_none();
        reads_once && self.highlight.is_none() && self.shine == [0; 3] && self.veil.is_none()
    }

    /// The kernel for any attributes of at most `N` components.
    fn draw_any<const N: usize>(&self, engine: &impl Interpolate, piece: &Piece, to: To<'_>) {
        let stage = each(|varying: &PackedAttributes<N>, depth| self.shade_all(&varying.0, depth));
        self.draw_by::<N>(engine, piece, to, &stage);
    }

    /// One copy of the rasterizer's loops for all attributes of this size.
    fn draw_by<const N: usize>(
        &self,
        engine: &impl Interpolate,
        piece: &Piece,
        (target, bounds, samples, counters): To<'_>,
        stage: &FragmentStage<'_, PackedAttributes<N>>,
    ) {
        let packed = pack::<N>(piece, self.plan.interpolates);
        let way = Way { affine: !self.plan.perspective, depth_test: self.plan.depth };
        let before = Before::of(counters);
        if let Some(on_demand) = samples {
            on_demand.draw_varying(engine, piece, &packed, target, self.plan, stage, counters);
        } else {
            fill(engine, &packed, target, bounds, way, stage, counters);
        }
        self.count(before, N, counters);
    }

    /// The colour of any attributes, for what has no kernel of its own; `values` are those of a fragment as [`pack`] puts them.
    pub fn shade_all(&self, values: &[f64], depth: f64) -> Colour {
        let texel = self.varying_texture().map_or(self.texel, |texture| {
            self.texel(texture, DVec2::from_slice(&values[self.start(Attributes::UV)..]), depth)
        });
        self.shade_texel(values, depth, texel)
    }

    /// What a fragment reads of its texture, at a level of detail and several times where the plan pays for it.
    fn texel(&self, texture: &Texture, uv: DVec2, depth: f64) -> DVec3 {
        match (&self.reading, &self.last) {
            (None, None) => texture.at(uv),
            (None, Some(last)) => texture.at_again(uv, &mut last.borrow_mut()),
            (Some((reading, veil)), _) => {
                let w = veil.map_or(1.0, |veil| veil.w(depth));
                let (texel, taps) = reading.texel(texture, uv, w);
                if self.plan.anisotropy {
                    self.taps.set(self.taps.get() + u64::from(taps));
                }
                texel
            }
        }
    }

    /// Where an attribute begins among the numbers of a fragment, as [`pack`] puts them, if it is interpolated.
    fn start(&self, bit: u8) -> usize {
        self.plan.interpolates.both(Attributes(bit - 1)).components()
    }

    /// The texture, where each fragment has texture coordinates of its own.
    pub fn varying_texture(&self) -> Option<&'a Texture> {
        self.texture.filter(|_| self.plan.interpolates.has(Attributes::UV))
    }

    /// The same with this texel.
    pub fn shade_texel(&self, values: &[f64], depth: f64, texel: DVec3) -> Colour {
        let varies = |bit: u8| self.plan.interpolates.has(bit);
        let at = |bit: u8| DVec3::from_slice(&values[self.start(bit)..]);
        let normal = if varies(Attributes::NORMAL) { at(Attributes::NORMAL) } else { self.normal };
        let lit = self.receiver.map_or(self.lit, |receiver| receiver.lit(at(Attributes::PLACE)));
        let base = self.base;
        let colour = if varies(Attributes::COLOUR) { base * at(Attributes::COLOUR) } else { base };
        let shown = if let Some(coat) = self.coat {
            let world = if varies(Attributes::WORLD) { at(Attributes::WORLD) } else { coat.world };
            let tangent = if varies(Attributes::TANGENT) {
                DVec4::from_slice(&values[self.start(Attributes::TANGENT)..])
            } else {
                coat.tangent
            };
            let mut texels = coat.texels;
            for (number, texel) in texels.iter_mut().enumerate() {
                let Some(map) = coat.maps[number] else { continue };
                let is_second = coat.surface.second[number];
                let uv = DVec2::from_slice(&values[self.start(Attributes::uv(is_second))..]);
                let reading = if is_second { coat.reading.as_ref() } else { self.reading.as_ref() };
                *texel = match reading {
                    None => map.at(uv),
                    Some((reading, veil)) => {
                        let w = veil.map_or(1.0, |veil| veil.w(depth));
                        reading.texel(map, uv, w).0
                    }
                };
            }
            let to_eye = coat.eye.truncate() - world * coat.eye.w;
            let base = colour * texel;
            let share = f64::from(lit) / f64::from(TAPS);
            let point = Point { base, normal, tangent, to_eye, texels, lit: share, place: world };
            let lights = Lights { main: &self.light, punctual: coat.punctual };
            coat.surface.colour(lights, &point, coat.parts)
        } else {
            let intensity = if varies(Attributes::NORMAL) || self.receiver.is_some() {
                self.light.intensity_in(normal, lit)
            } else {
                self.intensity
            };
            to_colour(colour * texel * intensity)
        };
        let shine = match (self.highlight, self.receiver) {
            (Some(highlight), _) => dimmed(highlight.at(normal), lit),
            (None, Some(_)) => dimmed(self.shine, lit),
            (None, None) => self.shine,
        };
        let colour = brightened(shown, shine);
        self.veil.map_or(colour, |veil| veil.before(colour, veil.distance(depth)))
    }

    /// The fragment stage of the attributes in `MASK`, where [`Self::is_plain`]: a function of its own, so that there is one
    /// copy for all rasterizers.
    fn plain_stage<const N: usize, const MASK: u8>(
        &self,
    ) -> impl Fn(&[PackedAttributes<N>], &[f64], u32, &mut [Colour]) {
        each(|varying, depth| self.shade::<N, MASK, true>(varying, depth))
    }

    /// The same with all that only some scenes call for.
    fn stage<const N: usize, const MASK: u8>(
        &self,
    ) -> impl Fn(&[PackedAttributes<N>], &[f64], u32, &mut [Colour]) {
        let shade = each(|varying, depth| self.shade::<N, MASK, false>(varying, depth));
        move |varyings, depths, wanted, colours| {
            shade(varyings, depths, wanted, colours);
            if self.highlight.is_some() || self.shine != [0; 3] {
                let normal = if MASK & Attributes::COLOUR != 0 { 3 } else { 0 };
                self.brighten(varyings, normal, wanted, colours);
            }
            let Some(veil) = self.veil else { return };
            let is_alike = MASK == 0 && self.checks_runs && depths.len() >= SHORT;
            match is_alike.then(|| veil.one_before(first(colours, wanted), depths)).flatten() {
                Some(colour) => fill_wanted(colour, wanted, colours),
                None => veil.apply(depths, wanted, colours),
            }
        }
    }

    /// Adds the highlights of fragments, whose normals begin at component `normal`.
    fn brighten<const N: usize>(
        &self,
        varyings: &[PackedAttributes<N>],
        normal: usize,
        wanted: u32,
        colours: &mut [Colour],
    ) {
        if let (true, Some(highlight)) = (self.checks_runs, self.highlight)
            && let Some(shine) = one_shine(highlight, varyings, normal, wanted)
        {
            for (i, colour) in colours.iter_mut().enumerate() {
                if wanted >> i & 1 != 0 {
                    *colour = brightened(*colour, shine);
                }
            }
            return;
        }
        for (i, (PackedAttributes(values), colour)) in varyings.iter().zip(colours).enumerate() {
            if wanted >> i & 1 == 0 {
                continue;
            }
            let shine = match (self.highlight, values.get(normal..normal + 3)) {
                (Some(highlight), Some(normal)) => highlight.at(DVec3::from_slice(normal)),
                _ => self.shine,
            };
            *colour = brightened(*colour, shine);
        }
    }

    /// base x colour x texel x light; what is not in `MASK` is constant.
    #[inline]
    fn shade<const N: usize, const MASK: u8, const PLAIN: bool>(
        &self,
        varying: &PackedAttributes<N>,
        depth: f64,
    ) -> Colour {
        let mut rest = varying.0.iter().copied();
        let mut next = || rest.next().unwrap_or_default();
        let mut colour = self.base;
        if MASK & Attributes::COLOUR != 0 {
            colour *= DVec3::new(next(), next(), next());
        }
        let intensity = if MASK & Attributes::NORMAL != 0 {
            self.light.intensity(DVec3::new(next(), next(), next()))
        } else {
            self.intensity
        };
        let texel = match self.texture {
            Some(texture) if MASK & Attributes::UV != 0 => {
                let uv = DVec2::new(next(), next());
                if PLAIN { texture.at(uv) } else { self.texel(texture, uv, depth) }
            }
            _ => self.texel,
        };
        to_colour(colour * texel * intensity)
    }
}
