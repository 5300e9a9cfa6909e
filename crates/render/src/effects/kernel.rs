//! Kernels: each piece is drawn by code that knows at compile time which attributes vary.
//!
//! What is switched off is not in its loop. What is left of a switched-off attribute is a constant,
//! in the same place of the same product, so the bits are the same.

use std::cell::Cell;

use glam::{DVec2, DVec3};

use super::conditions::mip_maps::{footprint, is_affine};
use super::plan::{Attributes, PiecePlan};
use super::primitive::{Piece, Prepared, pack};
use super::samples::OnDemand;
use crate::pipeline::Counters;
use crate::pipeline::fill::{FragmentStage, Way, each, fill, fill_flat};
use crate::pipeline::fog::{Share, Veil};
use crate::pipeline::footprint::Reading;
use crate::pipeline::highlight::{Highlight, brightened};
use crate::pipeline::opacity::{Drawn, Opacity};
use crate::pipeline::see_through::{self, Look};
use crate::pipeline::shade::{ALL, Attributes as Packed, Light, PLACED, Surface};
use crate::pipeline::shadow::{Receiver, ShadowMap, TAPS, dimmed};
use crate::pipeline::target::{Antialias, Colour, Target, to_colour};
use crate::pipeline::texture::Texture;
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::Interpolate;

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
    /// Where the texture is read at levels of detail or several times; the veil gives w, which is 1 where there is none.
    reading: Option<(Reading, Option<&'a Veil>)>,
    /// How often the texture was read where it may be read several times.
    taps: Cell<u64>,
    /// The colour of a piece of which nothing but fog is seen.
    fogged: Option<Colour>,
    /// Of pieces that are not opaque everywhere.
    opacity: Option<&'a Opacity>,
}

impl<'a> Kernel<'a> {
    pub fn new(
        item: &'a Prepared<'_>,
        piece: &Piece,
        plan: PiecePlan,
        map: Option<&'a ShadowMap>,
        counters: &mut Counters,
    ) -> Self {
        let first = Surface::from(piece.vertices[0].varying);
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
            lit: TAPS,
            highlight: None,
            shine: [0; 3],
            fogged: None,
            opacity: item.item.material.opacity.as_ref().filter(|_| !plan.replaces_all()),
            reading: None,
            taps: Cell::new(0),
            veil: (plan.fog != Share::None).then_some(&item.veil),
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
            let veil = (!is_affine(piece, plan.perspective)).then_some(&item.veil);
            let reading = Reading {
                footprint: footprint(texture, piece, plan.perspective).0,
                at_levels: plan.mip_maps,
                most: if plan.anisotropy { texture.anisotropy } else { 1 },
            };
            kernel.reading = Some((reading, veil));
        }
        if let (Some(texture), true) = (item.texture, constant(Attributes::UV)) {
            counters.texels += 1;
            kernel.texel = texture.at(first.uv);
        }
        if let (Some(view), Some(map)) = (&item.light_view, map) {
            let places = piece.vertices.map_array(|vertex| Surface::from(vertex.varying).place);
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
        kernel
    }

    pub fn draw(
        &self,
        engine: &impl Interpolate,
        piece: &Piece,
        target: &mut Target,
        samples: Option<&mut OnDemand>,
        counters: &mut Counters,
    ) {
        if let Some(opacity) = self.opacity {
            self.draw_see_through(engine, piece, target, samples, counters, opacity);
            return;
        }
        let is_partly_lit = self.receiver.is_some() || self.lit != TAPS;
        if self.plan.is_one_colour() {
            self.draw_flat(engine, piece, target, samples, counters);
            return;
        }
        match self.plan.interpolates.0 {
            1.. if is_partly_lit => self.draw_all(engine, piece, target, samples, counters),
            0 => self.draw_as::<0, 0>(engine, piece, target, samples, counters),
            1 => self.draw_as::<3, 1>(engine, piece, target, samples, counters),
            2 => self.draw_as::<3, 2>(engine, piece, target, samples, counters),
            3 => self.draw_as::<6, 3>(engine, piece, target, samples, counters),
            4 => self.draw_as::<2, 4>(engine, piece, target, samples, counters),
            5 => self.draw_as::<5, 5>(engine, piece, target, samples, counters),
            6 => self.draw_as::<5, 6>(engine, piece, target, samples, counters),
            _ => self.draw_all(engine, piece, target, samples, counters),
        }
    }

    /// Draws a piece with all attributes: one copy for those that few pieces have.
    fn draw_all(
        &self,
        engine: &impl Interpolate,
        piece: &Piece,
        target: &mut Target,
        samples: Option<&mut OnDemand>,
        counters: &mut Counters,
    ) {
        let way = Way { affine: !self.plan.perspective, depth_test: self.plan.depth };
        let before = *counters;
        let stage = each(|varying, depth| self.shade_all(varying, depth));
        if let Some(on_demand) = samples {
            on_demand.draw_varying(engine, piece, piece, target, self.plan, &stage, counters);
        } else {
            fill(engine, piece, target, target.bounds(), way, &stage, counters);
        }
        self.count(&before, self.components(), counters);
    }

    /// Numbers that are interpolated where all attributes are.
    fn components(&self) -> usize {
        match self.plan.interpolates {
            none if none.is_empty() => 0,
            with_place if with_place.has(Attributes::PLACE) => PLACED,
            _ => ALL,
        }
    }

    fn draw_flat(
        &self,
        engine: &impl Interpolate,
        piece: &Piece,
        target: &mut Target,
        samples: Option<&mut OnDemand>,
        counters: &mut Counters,
    ) {
        let shade = || brightened(self.shade::<0, 0, false>(&Packed([]), 0.0), self.shine);
        let colour = self.fogged.unwrap_or_else(shade);
        let shaded = counters.shaded;
        if let Some(on_demand) = samples {
            on_demand.draw_flat(engine, piece, self.plan, colour, target, counters);
        } else if !self.plan.depth && target.antialias() != Antialias::Multisample4 {
            fill_flat(engine, piece.corners(), target, colour, counters);
        } else {
            let way = Way { affine: true, depth_test: self.plan.depth };
            let bounds = target.bounds();
            let stage = each(|_, _| colour);
            fill(engine, &pack::<0, 0>(piece), target, bounds, way, &stage, counters);
        }
        // A constant is no run of the fragment stage.
        counters.shaded = shaded;
    }

    /// Draws a piece that is not opaque everywhere: with all attributes, so that one copy draws any of them.
    fn draw_see_through(
        &self,
        engine: &impl Interpolate,
        piece: &Piece,
        target: &mut Target,
        samples: Option<&mut OnDemand>,
        counters: &mut Counters,
        opacity: &Opacity,
    ) {
        let PiecePlan { interpolates, perspective, depth, layers, .. } = self.plan;
        if samples.is_some_and(|on_demand| {
            !on_demand.tell_box_apart(engine, piece, depth, target, counters)
        }) {
            return;
        }
        let first = piece.vertices[0].varying;
        let has_uv = interpolates.has(Attributes::UV);
        let look = Look {
            constant: interpolates.is_empty().then_some(first),
            is_kept: layers,
            opacity: &|varying| opacity.of(Surface::from(if has_uv { *varying } else { first }).uv),
            colour: &|varying, depth| self.shade_all(varying, depth),
        };
        let way = Way { affine: !perspective, depth_test: depth };
        let before = *counters;
        let bounds = target.bounds();
        let visible = see_through::fill(engine, piece, target, bounds, way, &look, counters);
        self.count(&before, self.components(), counters);
        let of = |drawn: Drawn| if drawn == Drawn::Mixed { visible } else { 0 };
        counters.alpha_tests += of(self.plan.alpha_test);
        counters.blended += of(self.plan.blending);
    }

    /// Counts what the fragments since `before`, of so many components each, have paid for.
    fn count(&self, before: &Counters, components: usize, counters: &mut Counters) {
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
        let way = Way { affine: !self.plan.perspective, depth_test: self.plan.depth };
        let before = *counters;
        // One copy of the rasterizer's loops for all attributes of this size.
        let (plain, levels) = (self.stage::<N, MASK, false>(), self.stage::<N, MASK, true>());
        let stage: &FragmentStage<'_, Packed<N>> =
            if self.reading.is_some() { &levels } else { &plain };
        if let Some(on_demand) = samples {
            on_demand.draw_varying(engine, piece, &packed, target, self.plan, stage, counters);
        } else {
            fill(engine, &packed, target, target.bounds(), way, stage, counters);
        }
        self.count(&before, N, counters);
    }

    /// The colour of all attributes, for what has no kernel of its own.
    pub fn shade_all(&self, varying: &Packed<PLACED>, depth: f64) -> Colour {
        let uv = Surface::from(*varying).uv;
        let texel = self.varying_texture().map_or(self.texel, |t| self.texel(t, uv, depth));
        self.shade_texel(varying, depth, texel)
    }

    /// What a fragment reads of its texture, at a level of detail and several times where the plan pays for it.
    fn texel(&self, texture: &Texture, uv: DVec2, depth: f64) -> DVec3 {
        match &self.reading {
            None => texture.at(uv),
            Some((reading, veil)) => {
                let w = veil.map_or(1.0, |veil| veil.w(depth));
                let (texel, taps) = reading.texel(texture, uv, w);
                if self.plan.anisotropy {
                    self.taps.set(self.taps.get() + u64::from(taps));
                }
                texel
            }
        }
    }

    /// The texture, where each fragment has texture coordinates of its own.
    pub fn varying_texture(&self) -> Option<&'a Texture> {
        self.texture.filter(|_| self.plan.interpolates.has(Attributes::UV))
    }

    /// The same with this texel.
    pub fn shade_texel(&self, varying: &Packed<PLACED>, depth: f64, texel: DVec3) -> Colour {
        let Surface { colour, normal, place, .. } = (*varying).into();
        let varies = |bit: u8| self.plan.interpolates.has(bit);
        let normal = if varies(Attributes::NORMAL) { normal } else { self.normal };
        let lit = self.receiver.map_or(self.lit, |receiver| receiver.lit(place));
        let intensity = if varies(Attributes::NORMAL) || self.receiver.is_some() {
            self.light.intensity_in(normal, lit)
        } else {
            self.intensity
        };
        let colour = if varies(Attributes::COLOUR) { self.base * colour } else { self.base };
        let shine = match (self.highlight, self.receiver) {
            (Some(highlight), _) => dimmed(highlight.at(normal), lit),
            (None, Some(_)) => dimmed(self.shine, lit),
            (None, None) => self.shine,
        };
        let colour = brightened(to_colour(colour * texel * intensity), shine);
        self.veil.map_or(colour, |veil| veil.before(colour, veil.distance(depth)))
    }

    /// The fragment stage of the attributes in `MASK`: a function of its own, so that there is one
    /// copy for all rasterizers. What only some scenes call for comes after the loop that all have.
    fn stage<const N: usize, const MASK: u8, const LEVELS: bool>(
        &self,
    ) -> impl Fn(&[Packed<N>], &[f64], u32, &mut [Colour]) {
        let shade = each(|varying, depth| self.shade::<N, MASK, LEVELS>(varying, depth));
        move |varyings, depths, wanted, colours| {
            shade(varyings, depths, wanted, colours);
            if self.highlight.is_some() || self.shine != [0; 3] {
                let normal = if MASK & Attributes::COLOUR != 0 { 3 } else { 0 };
                self.brighten(varyings, normal, wanted, colours);
            }
            if let Some(veil) = self.veil {
                veil.apply(depths, wanted, colours);
            }
        }
    }

    /// Adds the highlights of fragments, whose normals begin at component `normal`.
    fn brighten<const N: usize>(
        &self,
        varyings: &[Packed<N>],
        normal: usize,
        wanted: u32,
        colours: &mut [Colour],
    ) {
        for (i, (Packed(values), colour)) in varyings.iter().zip(colours).enumerate() {
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
    fn shade<const N: usize, const MASK: u8, const LEVELS: bool>(
        &self,
        varying: &Packed<N>,
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
                if LEVELS { self.texel(texture, uv, depth) } else { texture.at(uv) }
            }
            _ => self.texel,
        };
        to_colour(colour * texel * intensity)
    }
}
