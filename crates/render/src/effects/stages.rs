//! Stages: what becomes of the fragments of a piece is a list of steps, and what a piece does not call for is not in its list.
//!
//! Fragments come in runs of at most [`RUN`]. For each number of a fragment there is a register, which holds that number of all
//! fragments of the run, and a stage is a loop over registers: it reads some, and writes one. A list is made for each piece
//! ([`Program::new`]). A stage whose registers are the same in all fragments is computed then, once, and leaves no step in the
//! list. So a piece of one colour has a list of one stage, which fills it. What is left out of a product is exactly 1, and the factors
//! keep their order, so the bits are the same.

use glam::{DVec2, DVec3, DVec4};

use super::conditions::mip_maps::{footprint, is_affine};
use super::plan::{Attributes, PiecePlan};
use super::primitive::{Piece, Prepared, WHITE, bare, pack, surfaces};
use super::samples::OnDemand;
use crate::pipeline::Counters;
use crate::pipeline::fill::{FragmentStage, Lanes, Over, Way, each, fill, fill_flat};
use crate::pipeline::fog::{Share, Veil};
use crate::pipeline::footprint::Reading;
use crate::pipeline::highlight::{Highlight, brightened};
use crate::pipeline::opacity::{Drawn, OPAQUE, Opacity};
use crate::pipeline::physical::{self, Lights, Map, Physical, Point, TextureRead};
use crate::pipeline::shade::{Attributes as PackedAttributes, Light, PLACED, Surface};
use crate::pipeline::shadow::{Receiver, ShadowMap, TAPS, dimmed};
use crate::pipeline::target::{Antialias, Colour, Target, to_colour};
use crate::pipeline::texture::Texture;
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::{Interpolate, RUN};
use rasterproof_core::grid::PixelRect;

/// One number of each fragment of a run.
type Register = [f64; RUN];

/// The first registers of what stages read and write. Before them are the numbers that are interpolated, as [`pack`] puts them.
mod first {
    use super::{Map, PLACED};

    /// Attributes that all fragments have in common.
    pub const NORMAL: usize = PLACED;
    pub const WORLD: usize = NORMAL + 3;
    pub const TANGENT: usize = WORLD + 3;
    /// The product as far as all fragments have it in common.
    pub const BASE: usize = TANGENT + 4;
    /// Base colour, colour of the corners, texel and light, as far as they are multiplied.
    pub const PRODUCT: usize = BASE + 3;
    /// What is read of each map of a physical surface.
    pub const MAPS: usize = PRODUCT + 3;
    pub const END: usize = MAPS + 3 * Map::ALL.len();
}

/// What the stages of a piece read and write, for the fragments of one run.
pub(super) struct Registers {
    numbers: [Register; first::END],
    /// Of nine, the parts of the light that arrive.
    lit: [u32; RUN],
}

impl Registers {
    pub fn new() -> Self {
        Self { numbers: [[0.0; RUN]; first::END], lit: [TAPS; RUN] }
    }

    /// Writes the interpolated numbers of each fragment to the first registers.
    #[inline]
    fn load<const N: usize>(&mut self, values: &[PackedAttributes<N>]) {
        for (i, PackedAttributes(numbers)) in values.iter().take(RUN).enumerate() {
            for (register, number) in self.numbers.iter_mut().zip(numbers) {
                register[i] = *number;
            }
        }
    }

    /// Writes to registers from this one on what all fragments have in common.
    fn set_all(&mut self, at: usize, numbers: &[f64]) {
        for (register, number) in self.numbers[at..].iter_mut().zip(numbers) {
            *register = [*number; RUN];
        }
    }

    /// The numbers of one fragment in `N` registers from this one on.
    #[inline]
    fn of<const N: usize>(&self, at: usize, i: usize) -> [f64; N] {
        let registers = &self.numbers[at..at + N];
        std::array::from_fn(|number| registers[number][i])
    }

    #[inline]
    fn three(&self, at: usize, i: usize) -> DVec3 {
        self.of::<3>(at, i).into()
    }

    #[inline]
    fn uv(&self, at: usize, i: usize) -> DVec2 {
        self.of::<2>(at, i).into()
    }

    #[inline]
    fn put(&mut self, at: usize, i: usize, numbers: DVec3) {
        let registers = &mut self.numbers[at..at + 3];
        (registers[0][i], registers[1][i], registers[2][i]) = (numbers.x, numbers.y, numbers.z);
    }
}

/// One step of the fragments of a piece. Numbers say which registers it reads, `from` where the product so far is.
#[derive(Clone, Copy)]
enum Stage<'a> {
    /// The product begins with the colour of the material times that of the corners.
    Colour { base: DVec3 },
    /// The product is multiplied by what is read of the texture.
    Texture { from: usize, texture: &'a Texture, uv: usize },
    /// The product is multiplied by what all fragments have.
    Factor { from: usize, factor: DVec3 },
    /// A map of a physical surface is read.
    Map { map: Map, read: TextureRead<'a>, uv: usize },
    /// It is looked up which part of the light arrives.
    Shadow { receiver: Receiver<'a>, place: usize },
    /// The product is multiplied by the light, all of it or the part that arrives, and becomes a colour of 8 bits.
    Light { from: usize, light: &'a Light, normal: usize, is_part: bool },
    /// The colour of a physical surface, of 8 bits.
    Physical(PhysicalStage<'a>),
    /// The product becomes a colour of 8 bits.
    Round,
    /// All fragments get one colour, which was computed when the list was made.
    Fill(Colour),
    /// As much of the highlight is added as arrives of the light.
    Highlight { highlight: &'a Highlight, normal: usize },
    /// The same of a highlight that does not vary.
    OneHighlight([u8; 3]),
    /// The colour is mixed with that of the fog, the more the farther the fragment is.
    Fog(&'a Veil),
}

/// What a physical surface has beside what registers hold.
#[derive(Clone, Copy)]
struct PhysicalStage<'a> {
    from: usize,
    surface: &'a Physical,
    parts: physical::Parts,
    lights: Lights<'a>,
    eye: &'a DVec4,
    normal: usize,
    world: usize,
    tangent: usize,
}

impl PhysicalStage<'_> {
    fn colour(&self, registers: &Registers, i: usize) -> Colour {
        let place = registers.three(self.world, i);
        let maps: [usize; Map::ALL.len()] = [0, 1, 2, 3];
        let point = Point {
            base: registers.three(self.from, i),
            normal: registers.three(self.normal, i),
            tangent: registers.of::<4>(self.tangent, i).into(),
            to_eye: self.eye.truncate() - place * self.eye.w,
            texels: maps.map_array(|map| registers.three(first::MAPS + 3 * map, i)),
            lit: f64::from(registers.lit[i]) / f64::from(TAPS),
            place,
        };
        self.surface.colour(self.lights, &point, self.parts)
    }

    /// Counts what so many evaluations have paid for.
    fn count(&self, shaded: u64, counters: &mut Counters) {
        let where_true = |pays: bool| if pays { shaded } else { 0 };
        counters.reflections += where_true(self.parts.reflection);
        counters.punctual += where_true(!self.lights.punctual.is_empty());
        counters.bumped += where_true(self.parts.bumps);
        counters.occluded += where_true(self.parts.occlusion);
        counters.emitted += where_true(self.parts.emission);
    }
}

impl Stage<'_> {
    /// What it does, as `plan --show stages` prints it.
    fn name(&self) -> &'static str {
        match self {
            Self::Colour { .. } => "colour of the corners",
            Self::Texture { .. } => "x texture",
            Self::Factor { .. } => "x constant",
            Self::Map { map: Map::Emission, .. } => "emission map",
            Self::Map { map: Map::Metal, .. } => "map of metal and roughness",
            Self::Map { map: Map::Occlusion, .. } => "occlusion map",
            Self::Map { map: Map::Normal, .. } => "normal map",
            Self::Shadow { .. } => "shadow",
            Self::Light { is_part: false, .. } => "x light to 8 bits",
            Self::Light { is_part: true, .. } => "x light that arrives to 8 bits",
            Self::Physical(_) => "metal and roughness",
            Self::Round => "to 8 bits",
            Self::Fill(_) => "one colour",
            Self::Highlight { .. } => "+ highlight",
            Self::OneHighlight(_) => "+ constant highlight",
            Self::Fog(_) => "fog",
        }
    }

    /// Counts what so many fragments have paid for.
    fn count(&self, shaded: u64, counters: &mut Counters) {
        match self {
            Self::Texture { .. } | Self::Map { .. } => counters.texels += shaded,
            Self::Shadow { .. } => counters.shadowed += shaded,
            Self::Physical(stage) => stage.count(shaded, counters),
            Self::Highlight { .. } => counters.highlights += shaded,
            Self::Fog(_) => counters.fogged += shaded,
            Self::Colour { .. }
            | Self::Factor { .. }
            | Self::Light { .. }
            | Self::Round
            | Self::Fill(_)
            | Self::OneHighlight(_) => {}
        }
    }
}

/// The most stages that a piece has.
const MOST: usize = 13;

/// How textures are read at levels of detail or several times; the veil gives w, which is 1 where there is none.
type HowRead<'a> = (Reading, Option<&'a Veil>);

/// What becomes of the fragments of a piece.
#[derive(Clone, Copy)]
pub(super) struct Program<'a> {
    plan: PiecePlan,
    stages: [Option<Stage<'a>>; MOST],
    count: usize,
    /// How textures are read at the first and at the second texture coordinates; nothing where they are read once and at level 0.
    readings: [Option<HowRead<'a>>; 2],
    /// Of pieces that are not opaque everywhere, with the opacity of all fragments where they have one.
    opacity: Option<(&'a Opacity, Option<u8>)>,
}

/// Makes the list of a piece, and writes to the registers what is the same in all of its fragments.
struct Builder<'a, 'b> {
    item: &'a Prepared<'a>,
    piece: &'b Piece,
    /// The first corner, which has what does not vary.
    first: Surface,
    /// What all fragments read of the texture, where they are known to read the same.
    texel: Option<DVec3>,
    registers: &'b mut Registers,
    counters: &'b mut Counters,
    program: Program<'a>,
}

impl<'a> Builder<'a, '_> {
    fn push(&mut self, stage: Stage<'a>) {
        self.program.stages[self.program.count] = Some(stage);
        self.program.count += 1;
    }

    fn varies(&self, bit: u8) -> bool {
        self.program.plan.interpolates.has(bit)
    }

    /// From which register on an attribute is read. One that does not vary is written there.
    fn register(&mut self, bit: u8) -> usize {
        if self.varies(bit) {
            return self.program.plan.interpolates.both(Attributes(bit - 1)).components();
        }
        let at = match bit {
            Attributes::NORMAL => first::NORMAL,
            Attributes::WORLD => first::WORLD,
            _ => first::TANGENT,
        };
        let PackedAttributes(numbers) = &self.piece.vertices[0].varying;
        self.registers.set_all(at, &numbers[Attributes::range(bit)]);
        at
    }

    /// Where a stage finds the product so far, which all fragments have in common or have not.
    fn product(&mut self, common: Option<DVec3>) -> usize {
        let Some(product) = common else { return first::PRODUCT };
        self.registers.set_all(first::BASE, &product.to_array());
        first::BASE
    }

    /// Whether it has an attribute, and all fragments the same.
    fn is_constant(&self, bit: u8) -> bool {
        self.item.carries.has(bit) && !self.varies(bit)
    }

    /// Whether textures are read at levels of detail or several times, and how.
    fn readings(&mut self) {
        let PiecePlan { perspective, mip_maps: at_levels, anisotropy: is_anisotropic, .. } =
            self.program.plan;
        let veil = (!is_affine(self.piece, perspective)).then_some(&self.item.veil);
        // All are read in one way but for their sizes.
        let textures = [self.item.texture, Some(&*WHITE)];
        for (is_second, texture) in [false, true].into_iter().zip(textures) {
            if self.varies(Attributes::uv(is_second))
                && let Some(texture) = texture
            {
                let (footprint, ..) = footprint((texture, is_second), self.piece, perspective);
                let reading = Reading { footprint, at_levels, is_anisotropic };
                self.program.readings[usize::from(is_second)] = Some((reading, veil));
            }
        }
    }

    /// Colour of the material and the corners, and texel; their product where all fragments have the same.
    fn base(&mut self) -> Option<DVec3> {
        let base = self.item.item.material.colour;
        let mut product = Some(base);
        if self.varies(Attributes::COLOUR) {
            self.push(Stage::Colour { base });
            product = None;
        } else if self.is_constant(Attributes::COLOUR) {
            product = Some(base * self.first.colour);
        }
        let Some(texture) = self.item.texture else { return product };
        if self.varies(Attributes::UV) {
            let (from, uv) = (self.product(product), self.register(Attributes::UV));
            self.push(Stage::Texture { from, texture, uv });
            return None;
        }
        self.counters.texels += 1;
        self.multiply(product, self.texel.unwrap_or_else(|| texture.at(self.first.uv)))
    }

    /// Multiplies the product so far by what all fragments have.
    fn multiply(&mut self, product: Option<DVec3>, factor: DVec3) -> Option<DVec3> {
        if product.is_none() && factor != DVec3::ONE {
            self.push(Stage::Factor { from: first::PRODUCT, factor });
        }
        product.map(|product| product * factor)
    }

    /// Of nine, the parts of the light that arrive; nothing where that varies.
    fn shadow(&mut self, map: Option<&'a ShadowMap>) -> Option<u32> {
        let mut lit = TAPS;
        if let (Some(view), Some(map)) = (&self.item.light_view, map) {
            let receiver = view.receiver(map, surfaces(self.piece).map_array(|of| of.place));
            if self.varies(Attributes::PLACE) {
                let place = self.register(Attributes::PLACE);
                self.push(Stage::Shadow { receiver, place });
                return None;
            }
            self.counters.shadowed += 1;
            lit = receiver.lit(self.first.place);
        }
        self.registers.lit = [lit; RUN];
        Some(lit)
    }

    /// The light of a surface that is not physical; its colour where all fragments have the same.
    fn light(&mut self, product: Option<DVec3>, lit: Option<u32>) -> Option<Colour> {
        let light = &self.item.light;
        let Some(lit) = lit.filter(|_| !self.varies(Attributes::NORMAL)) else {
            let (from, normal) = (self.product(product), self.register(Attributes::NORMAL));
            self.push(Stage::Light { from, light, normal, is_part: lit != Some(TAPS) });
            return None;
        };
        let mut product = product;
        if self.item.carries.has(Attributes::NORMAL) {
            self.counters.lights += 1;
            let intensity = light.intensity_in(self.first.normal, lit);
            product = self.multiply(product, DVec3::splat(intensity));
        }
        if product.is_none() {
            self.push(Stage::Round);
        }
        product.map(to_colour)
    }

    /// A physical surface in its light; its colour where all fragments have the same.
    fn physical(&mut self, product: Option<DVec3>, surface: &'a Physical) -> Option<Colour> {
        let plan = self.program.plan;
        let PiecePlan { emission, reflection, occlusion, normal_maps: bumps, .. } = plan;
        let parts = physical::Parts { emission, reflection, occlusion, bumps };
        let punctual = if plan.punctual { self.item.punctual } else { &[] };
        let lights = Lights { main: &self.item.light, punctual };
        let attributes = [Attributes::NORMAL, Attributes::WORLD, Attributes::TANGENT];
        let [normal, world, tangent] = attributes.map(|bit| self.register(bit));
        let eye = &self.item.eye;
        let from = self.product(product);
        let stage = PhysicalStage { from, surface, parts, lights, eye, normal, world, tangent };
        for (map, is_read) in Map::ALL.into_iter().zip([emission, reflection, occlusion, bumps]) {
            if is_read {
                self.map(map, surface);
            }
        }
        self.counters.lights += u64::from(self.is_constant(Attributes::NORMAL));
        if plan.interpolates.is_empty() {
            stage.count(1, self.counters);
            return Some(stage.colour(self.registers, 0));
        }
        self.push(Stage::Physical(stage));
        None
    }

    /// Reads a map in each fragment, or once.
    fn map(&mut self, map: Map, surface: &'a Physical) {
        let mut texel = map.missing();
        if let Some((texture, is_second)) = surface.sampled(map) {
            let bit = Attributes::uv(is_second);
            if self.varies(bit) {
                let (read, uv) = ((texture, is_second), self.register(bit));
                self.push(Stage::Map { map, read, uv });
                return;
            }
            if self.is_constant(bit) {
                self.counters.texels += 1;
                texel = texture.at(self.first.uv_of(is_second));
            }
        }
        self.registers.set_all(first::MAPS + 3 * map as usize, &texel.to_array());
    }

    /// Highlight and fog, over one colour or over those of the fragments.
    fn finish(&mut self, mut colour: Option<Colour>, lit: Option<u32>) {
        let (item, plan) = (self.item, self.program.plan);
        let mut highlight = None;
        if plan.specular && self.varies(Attributes::NORMAL) {
            let normal = self.register(Attributes::NORMAL);
            highlight = Some(Stage::Highlight { highlight: &item.highlight, normal });
        } else if plan.specular && self.is_constant(Attributes::NORMAL) {
            self.counters.highlights += 1;
            let shine = item.highlight.at(self.first.normal);
            match (&mut colour, lit) {
                (Some(colour), Some(lit)) => *colour = brightened(*colour, dimmed(shine, lit)),
                _ if shine != [0; 3] => highlight = Some(Stage::OneHighlight(shine)),
                _ => {}
            }
        }
        let fog = (plan.fog != Share::None).then_some(Stage::Fog(&item.veil));
        for stage in [colour.map(Stage::Fill), highlight, fog].into_iter().flatten() {
            self.push(stage);
        }
    }
}

impl<'a> Program<'a> {
    /// The list of a piece, or of a part of it in which all fragments read one texel.
    #[inline]
    pub fn new(
        item: &'a Prepared<'a>,
        piece: &Piece,
        plan: PiecePlan,
        map: Option<&'a ShadowMap>,
        texel: Option<DVec3>,
        registers: &mut Registers,
        counters: &mut Counters,
    ) -> Self {
        let first = Surface::from(&piece.vertices[0].varying);
        let opacity = item.item.material.opacity.as_ref().filter(|_| !plan.replaces_all());
        let of_all = |opacity: &Opacity| {
            let varies = plan.interpolates.has(Attributes::UV);
            (!varies).then(|| opacity.of(first.uv))
        };
        let program = Self {
            plan,
            stages: [const { None }; MOST],
            count: 0,
            readings: [None; 2],
            opacity: opacity.map(|opacity| (opacity, of_all(opacity))),
        };
        let mut builder = Builder { item, piece, first, texel, registers, counters, program };
        if plan.fog == Share::Whole && plan.is_one_colour() && opacity.is_none() {
            builder.push(Stage::Fill(item.veil.colour()));
            return builder.program;
        }
        if plan.reads_around() {
            builder.readings();
        }
        let product = builder.base();
        let lit = builder.shadow(map);
        let colour = match item.physical() {
            Some(surface) => builder.physical(product, surface),
            None => builder.light(product, lit),
        };
        builder.finish(colour, lit);
        builder.program
    }

    fn stages(&self) -> impl Iterator<Item = &Stage<'a>> {
        self.stages[..self.count].iter().flatten()
    }

    /// The colour of all fragments, where they have one.
    fn one_colour(&self) -> Option<Colour> {
        match self.stages[..self.count] {
            [Some(Stage::Fill(colour))] => Some(colour),
            _ => None,
        }
    }

    /// The texture, where each fragment has texture coordinates of its own.
    pub fn texture(&self) -> Option<&'a Texture> {
        self.stages().find_map(|stage| match stage {
            Stage::Texture { texture, .. } => Some(*texture),
            _ => None,
        })
    }

    /// The same list with this texel in the place of what is read of the texture.
    pub fn with_texel(&self, factor: DVec3) -> Self {
        let stages = self.stages.map(|stage| match stage {
            Some(Stage::Texture { from, .. }) => Some(Stage::Factor { from, factor }),
            other => other,
        });
        Self { stages, ..*self }
    }

    /// What is interpolated, what a fragment is tested for, and what it is written as, around the stages: to read.
    pub fn names(&self) -> Vec<String> {
        let PiecePlan { interpolates, perspective, depth, alpha_test, blending, layers, .. } =
            self.plan;
        if self.plan.is_nothing() {
            return vec!["nothing".to_owned()];
        }
        let mut names = vec!["cover".to_owned()];
        if depth {
            names.push("depth test".to_owned());
        }
        if !interpolates.is_empty() {
            names.push(format!("interpolate {interpolates}"));
        }
        if perspective {
            names.push("divide by 1/w".to_owned());
        }
        if self.opacity.is_some() {
            names.push("opacity".to_owned());
        }
        if alpha_test == Drawn::Mixed {
            names.push("alpha test".to_owned());
        }
        names.extend(self.stages().map(|stage| stage.name().to_owned()));
        names.push(match (blending, layers) {
            (Drawn::Mixed, true) => "keep as a layer".to_owned(),
            (Drawn::Mixed, false) => "blend".to_owned(),
            _ => "write".to_owned(),
        });
        names
    }

    /// The list with the registers on which it works, in which [`Self::new`] has written what fragments have in common.
    pub fn on<'b>(&'b self, registers: &'b mut Registers) -> Shader<'a, 'b> {
        Shader { program: self, registers, taps: 0 }
    }

    fn way(&self) -> Way {
        let PiecePlan { perspective, depth, layers, .. } = self.plan;
        let over = match self.opacity {
            None => Over::Replace,
            Some(_) if layers => Over::Keep,
            Some(_) => Over::Mix,
        };
        Way { affine: !perspective, depth_test: depth, over }
    }

    /// Draws a piece: with one copy of the rasterizer's loops for each size of what is interpolated.
    pub fn draw(&self, engine: &impl Interpolate, piece: &Piece, to: To<'_>) {
        match (self.one_colour(), self.plan.interpolates.components()) {
            (Some(colour), _) if self.opacity.is_none() => {
                self.draw_flat(engine, piece, colour, to)
            }
            (_, 0) => self.draw_sized::<0>(engine, piece, to),
            (_, ..=2) => self.draw_sized::<2>(engine, piece, to),
            (_, 3) => self.draw_sized::<3>(engine, piece, to),
            (_, ..=5) => self.draw_sized::<5>(engine, piece, to),
            (_, 6) => self.draw_sized::<6>(engine, piece, to),
            (_, ..=8) => self.draw_sized::<8>(engine, piece, to),
            _ => self.draw_sized::<PLACED>(engine, piece, to),
        }
    }

    fn draw_flat(&self, engine: &impl Interpolate, piece: &Piece, colour: Colour, to: To<'_>) {
        let To { target, bounds, samples, counters, .. } = to;
        let shaded = counters.shaded;
        let (way, bare) = (Way { affine: true, ..self.way() }, bare(piece));
        let stage = &mut each(|_, _| colour);
        if let Some(on_demand) = samples {
            let piece = (piece, &bare, self.plan);
            on_demand.draw(engine, piece, (Some(colour), stage), way, target, counters);
        } else if !self.plan.depth && target.antialias() != Antialias::Multisample4 {
            fill_flat(engine, piece.corners(), target, bounds, colour, counters);
        } else {
            fill(engine, &bare, target, bounds, way, stage, counters);
        }
        // A constant is no run of the fragment stage.
        counters.shaded = shaded;
    }

    fn draw_sized<const N: usize>(&self, engine: &impl Interpolate, piece: &Piece, to: To<'_>) {
        let To { target, bounds, samples, registers, counters } = to;
        let packed = pack::<N>(piece, self.plan.interpolates);
        let before = (counters.fragments, counters.shaded);
        let (way, mut shader) = (self.way(), self.on(registers));
        let visible = match samples {
            Some(on_demand) => {
                let piece = (piece, &packed, self.plan);
                on_demand.draw(engine, piece, (None, &mut shader), way, target, counters)
            }
            None => fill(engine, &packed, target, bounds, way, &mut shader, counters),
        };
        counters.taps += shader.taps;
        self.count(counters.fragments - before.0, counters.shaded - before.1, visible, counters);
    }

    /// Counts what the fragments of a piece have paid for.
    fn count(&self, fragments: u64, shaded: u64, visible: u64, counters: &mut Counters) {
        let where_true = |pays: bool, count: u64| if pays { count } else { 0 };
        let PiecePlan { interpolates, perspective, mip_maps, alpha_test, blending, .. } = self.plan;
        counters.components += fragments * interpolates.components() as u64;
        counters.divisions += where_true(perspective, fragments);
        counters.lights += where_true(interpolates.has(Attributes::NORMAL), shaded);
        let is_read_around = self.readings.iter().any(Option::is_some);
        counters.levels += where_true(mip_maps && is_read_around, shaded);
        counters.alpha_tests += where_true(alpha_test == Drawn::Mixed, visible);
        counters.blended += where_true(blending == Drawn::Mixed, visible);
        self.stages().for_each(|stage| stage.count(shaded, counters));
    }
}

/// What a fragment reads at a level of detail or several times, and how often.
fn read_around(how: &HowRead<'_>, texture: &Texture, uv: DVec2, depth: f64) -> (DVec3, u8) {
    let (reading, veil) = how;
    reading.texel(texture, uv, veil.map_or(1.0, |veil| veil.w(depth)))
}

/// What a fragment reads of a texture.
fn read(how: Option<&HowRead<'_>>, texture: &Texture, uv: DVec2, depth: f64) -> DVec3 {
    how.map_or_else(|| texture.at(uv), |how| read_around(how, texture, uv, depth).0)
}

/// Where a piece is drawn and how far, with the pixels whose samples are drawn one by one on demand, and what is counted.
pub(super) struct To<'a> {
    pub target: &'a mut Target,
    pub bounds: PixelRect,
    pub samples: Option<&'a mut OnDemand>,
    pub registers: &'a mut Registers,
    pub counters: &'a mut Counters,
}

/// A list of stages with the registers on which it works.
pub(super) struct Shader<'a, 'b> {
    program: &'b Program<'a>,
    registers: &'b mut Registers,
    /// How often textures were read that may be read several times.
    taps: u64,
}

impl Shader<'_, '_> {
    /// The colour of one fragment with all attributes of the plan.
    pub fn one(&mut self, values: &PackedAttributes<PLACED>, depth: f64) -> Colour {
        let mut colour = [[0; 4]];
        let values = std::slice::from_ref(values);
        self.colours(Lanes { values, depths: &[depth], wanted: 1 }, &mut colour);
        colour[0]
    }

    /// All stages of the fragments of a run whose attributes are there.
    #[inline(never)]
    fn run(&mut self, depths: &[f64], wanted: u32, colours: &mut [Colour]) {
        let Self { program, registers, taps } = self;
        let count = depths.len().min(RUN);
        let colours = &mut colours[..count];
        for stage in program.stages() {
            match *stage {
                Stage::Colour { base } => {
                    for i in lanes(wanted, count) {
                        // Colours are the first of all attributes.
                        let product = base * registers.three(0, i);
                        registers.put(first::PRODUCT, i, product);
                    }
                }
                Stage::Texture { from, texture, uv } => match &program.readings[0] {
                    None => {
                        for i in lanes(wanted, count) {
                            let texel = texture.at(registers.uv(uv, i));
                            let product = registers.three(from, i) * texel;
                            registers.put(first::PRODUCT, i, product);
                        }
                    }
                    Some(reading) => {
                        for i in lanes(wanted, count) {
                            let uv = registers.uv(uv, i);
                            let (texel, read) = read_around(reading, texture, uv, depths[i]);
                            let product = registers.three(from, i) * texel;
                            registers.put(first::PRODUCT, i, product);
                            *taps += if program.plan.anisotropy { u64::from(read) } else { 0 };
                        }
                    }
                },
                Stage::Factor { from, factor } => {
                    for i in lanes(wanted, count) {
                        let product = registers.three(from, i) * factor;
                        registers.put(first::PRODUCT, i, product);
                    }
                }
                Stage::Map { map, read: (texture, is_second), uv } => {
                    let reading = &program.readings[usize::from(is_second)];
                    for i in lanes(wanted, count) {
                        let texel = read(reading.as_ref(), texture, registers.uv(uv, i), depths[i]);
                        registers.put(first::MAPS + 3 * map as usize, i, texel);
                    }
                }
                Stage::Shadow { receiver, place } => {
                    for i in lanes(wanted, count) {
                        registers.lit[i] = receiver.lit(registers.three(place, i));
                    }
                }
                Stage::Light { from, light, normal, .. } => {
                    for i in lanes(wanted, count) {
                        let normal = registers.three(normal, i);
                        let intensity = light.intensity_in(normal, registers.lit[i]);
                        colours[i] = to_colour(registers.three(from, i) * intensity);
                    }
                }
                Stage::Physical(stage) => {
                    for i in lanes(wanted, count) {
                        colours[i] = stage.colour(registers, i);
                    }
                }
                Stage::Round => {
                    for i in lanes(wanted, count) {
                        colours[i] = to_colour(registers.three(first::PRODUCT, i));
                    }
                }
                Stage::Fill(colour) => {
                    for i in lanes(wanted, count) {
                        colours[i] = colour;
                    }
                }
                Stage::Highlight { highlight, normal } => {
                    for i in lanes(wanted, count) {
                        let shine = highlight.at(registers.three(normal, i));
                        if shine != [0; 3] {
                            colours[i] = brightened(colours[i], dimmed(shine, registers.lit[i]));
                        }
                    }
                }
                Stage::OneHighlight(shine) => {
                    for i in lanes(wanted, count) {
                        colours[i] = brightened(colours[i], dimmed(shine, registers.lit[i]));
                    }
                }
                Stage::Fog(veil) => {
                    for i in lanes(wanted, count) {
                        colours[i] = veil.before(colours[i], veil.distance(depths[i]));
                    }
                }
            }
        }
    }
}

/// The numbers of the fragments whose bits are set, of so many.
#[inline]
fn lanes(wanted: u32, count: usize) -> impl Iterator<Item = usize> {
    (0..count).filter(move |i| wanted >> i & 1 != 0)
}

impl<const N: usize> FragmentStage<PackedAttributes<N>> for Shader<'_, '_> {
    fn colours(&mut self, run: Lanes<'_, PackedAttributes<N>>, colours: &mut [Colour]) {
        self.registers.load(run.values);
        self.run(run.depths, run.wanted, colours);
    }

    fn opacities(&mut self, run: Lanes<'_, PackedAttributes<N>>, opacities: &mut [u8]) {
        let program = self.program;
        let (opacity, of_all) = match program.opacity {
            None => (None, Some(OPAQUE)),
            Some((opacity, of_all)) => (Some(opacity), of_all),
        };
        let Some(opacity) = opacity.filter(|_| of_all.is_none()) else {
            opacities.fill(of_all.unwrap_or(OPAQUE));
            return;
        };
        self.registers.load(run.values);
        let uv = program.plan.interpolates.both(Attributes(Attributes::UV - 1)).components();
        for i in lanes(run.wanted, run.values.len()) {
            let uv = self.registers.uv(uv, i);
            opacities[i] = match (&program.readings[0], opacity.levels()) {
                (Some(how), Some(texture)) => {
                    opacity.of_texel(read_around(how, texture, uv, run.depths[i]).0.x)
                }
                _ => opacity.of(uv),
            };
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::effects::plan::Canvas;
    use crate::effects::render::{render, stages};
    use crate::effects::{Effect, Effects, Mode};
    use crate::pipeline::depth::DepthFormat;
    use crate::pipeline::target::{Antialias, Target};
    use crate::scene::chapters::scene;
    use rasterproof_core::arrays::MapArray as _;
    use rasterproof_core::raster::scanline::Scanline;

    /// Effects, with a stage that only who pays for them has, and a scene that calls for it.
    const STAGES: [(Effect, &str, &str); 10] = [
        (Effect::Depth, "depth test", "everything"),
        (Effect::Colour, "colour of the corners", "frustum"),
        (Effect::Texture, "x texture", "everything"),
        (Effect::Light, "x light to 8 bits", "everything"),
        (Effect::Specular, "+ highlight", "highlights"),
        (Effect::Shadows, "shadow", "shadows"),
        (Effect::Fog, "fog", "fog"),
        (Effect::AlphaTest, "alpha test", "cut-outs"),
        (Effect::Blending, "blend", "panes"),
        (Effect::Layers, "keep as a layer", "layers"),
    ];

    /// What a scene calls for is in the lists of its pieces, what is switched off is in none, and each piece has a list.
    #[test]
    fn what_is_not_called_for_is_in_no_list() {
        for (effect, stage, name) in STAGES {
            let scene = scene(name, 4.0 / 3.0, 0.0).unwrap();
            let mut target = Target::new(160, 120, Antialias::None, DepthFormat::Unorm32).unwrap();
            let mut has_stage = |mode: Mode| {
                let effects = Effects::PLANNED.with(effect, mode);
                let staged = stages(&scene, &Scanline, &effects, &Canvas::of(&target)).unwrap();
                let drawn = render(&scene, &Scanline, &effects, &mut target).unwrap();
                let pieces: u64 = staged.iter().map(|staged| staged.pieces).sum();
                assert_eq!(pieces, drawn.counters.pieces - drawn.counters.culled, "{name}");
                staged.iter().any(|staged| staged.stages.iter().any(|own| own == stage))
            };
            let found = [Mode::Planned, Mode::Never].map_array(&mut has_stage);
            assert_eq!(found, [true, false], "{stage} in {name}");
        }
    }
}
