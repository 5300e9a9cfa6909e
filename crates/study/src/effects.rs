//! Which effects a scene calls for: by which materials, in which pixels, and what the picture is without them.

use std::cell::RefCell;
use std::collections::BTreeMap;

use glam::DVec2;
use rasterproof_core::frame::Frame;
use rasterproof_models::Origin;
use rasterproof_precision::cost::{Pass, Ratio, RatioKind, Times, Timing, compare};
use rasterproof_registry::engines::Drawer;
use rasterproof_render::effects::render::BadScene;
use rasterproof_render::effects::{Effect, Effects, Mode};
use rasterproof_render::pipeline::Counters;
use rasterproof_render::pipeline::target::{Antialias, Colour, Target};
use rasterproof_render::scene::Scene;

use crate::view::{NOTHING, Piece};

rasterproof_core::named! {
    /// Whether a scene needs an effect in a view.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum State {
        CalledFor = "called for",
        /// The plan cannot know beforehand that no pixel would change without it.
        ToBeSafe = "paid for to be safe",
        NotCalledFor = "not called for",
    }
}

/// What was found of an effect in a view.
#[derive(Clone, Debug)]
pub struct Need {
    pub effect: Effect,
    /// The materials that ask for it, with the pixels where each is seen and pays for it.
    pub materials: Vec<(String, u64)>,
    /// Whether it is planned for anything at all.
    pub is_paid_for: bool,
    /// What the plan says of it, with how many items it says it; that nothing asks for it where it says nothing.
    pub reasons: Vec<(String, u64)>,
    /// Pixels that pay for it; none for an effect that is not one of pixels.
    pub pixels: Option<u64>,
    /// Pixels that change when it is switched off.
    pub wrong: u64,
    /// How much less work of it a planned frame does with this effect switched off, where it is paid for, or how much more
    /// with it on everywhere, where it is not.
    pub work: u64,
    /// The time of such a frame; none where the work is the same, so that only noise could be seen.
    pub otherwise: Option<Times>,
    /// Whether fewer fragments are drawn without it, so that the time saved is not its own.
    pub draws_less: bool,
}

/// What an effect adds to the time of a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Adds {
    /// It does no work in this view.
    NoWork,
    /// Without it fewer fragments are drawn.
    DrawsLess,
    /// The frame with it over the frame without.
    Times(Ratio),
}

impl Need {
    /// What changes pixels is called for, also where the plan leaves it out, since the plan of an item may leave it out in others.
    #[must_use]
    pub fn state(&self) -> State {
        match (self.is_paid_for, self.wrong) {
            (_, 1..) => State::CalledFor,
            (true, 0) => State::ToBeSafe,
            (false, 0) => State::NotCalledFor,
        }
    }

    /// What it adds to a planned frame where it is paid for, and would add where it is not.
    #[must_use]
    pub fn adds(&self, planned: &Times) -> Adds {
        match self.otherwise.as_ref().filter(|_| self.work > 0) {
            None => Adds::NoWork,
            Some(_) if self.is_paid_for && self.draws_less => Adds::DrawsLess,
            Some(without) => {
                let ratio = planned.over(without).unwrap_or(Ratio::ONE);
                Adds::Times(if self.is_paid_for { ratio } else { ratio.inverse() })
            }
        }
    }

    /// The milliseconds of that, where they are more than noise.
    #[must_use]
    pub fn adds_ms(&self, planned: &Times) -> Option<f64> {
        let Adds::Times(ratio) = self.adds(planned) else { return None };
        let without = if self.is_paid_for { self.otherwise.as_ref()? } else { planned };
        let is_more = ratio.said() == RatioKind::Holds && ratio.low > 1.0;
        is_more.then(|| (ratio.median - 1.0) * without.median() / 1e6)
    }
}

/// A textured material, and how fine its texture is in the picture.
#[derive(Clone, Debug, serde::Serialize)]
pub struct Fineness {
    pub material: String,
    pub pixels: u64,
    /// Texels along the side of a pixel, the median of its pixels.
    pub texels: f64,
    /// By antialiasing, the pixels that are far from 64 samples.
    pub far: Vec<(&'static str, u64)>,
}

/// What was found of all effects, and of the textures.
#[derive(Clone, Debug)]
pub struct Needs {
    pub needs: Vec<Need>,
    /// The time of the planned frame, in the same rounds as all others.
    pub planned: Times,
    pub textures: Vec<Fineness>,
    /// How many times as long a frame takes by antialiasing, where it was drawn.
    pub antialiasing: Vec<(&'static str, Ratio)>,
}

/// A channel that is off by more than so many steps of 255 is far.
pub const FAR: u8 = 16;

/// Texels along the side of a pixel from which antialiasing is tried.
const FINE: f64 = 1.25;

/// Finds out what a scene calls for; `seen` says which piece is seen at each pixel.
pub fn survey(
    scene: &Scene,
    origins: &[Origin],
    (pieces, seen): (&[Piece], &Frame<u32>),
    target: &mut Target,
    timing: Timing,
) -> Result<Needs, BadScene> {
    // One rasterizer suffices: both engines draw the same picture and count the same work.
    let drawer = Drawer::Scanline;
    let names = names(scene, origins);
    let items = seen_items(pieces, seen);
    let (rendered, map) = drawer.render_mapped(scene, &Effects::PLANNED, target)?;
    let mut needs = Vec::new();
    for effect in Effect::ALL {
        let without = drawer.render_without(scene, effect, target)?;
        // What the plan says of this effect: why, and for which items it is on, or decided while they are drawn.
        let mut reasons: BTreeMap<String, u64> = BTreeMap::new();
        let mut called = vec![false; scene.items.len()];
        let mut is_paid_for = false;
        for decision in &rendered.plan.decisions {
            if decision.effect != effect {
                continue;
            }
            let is_on = decision.on + decision.open > 0;
            is_paid_for |= is_on;
            *reasons.entry(decision.reason.clone()).or_default() += 1;
            if let Some(item) = decision.item {
                called[item] = is_on;
            }
        }
        if reasons.is_empty() {
            reasons.insert("nothing in the scene asks for it".to_owned(), scene.items.len() as u64);
        }
        // Interpolation has no map: those of its attributes show it.
        let is_of_pixels = effect.map_colour().is_some() || effect == Effect::Interpolation;
        let (materials, pixels) = paying_materials(&names, &called, &items, &map.effects, effect);
        // What it would do the other way round: a frame without it, or one with it everywhere.
        let other = match is_paid_for {
            true => without.counters,
            false => drawer.render(scene, &otherwise(effect, false), target)?.counters,
        };
        needs.push(Need {
            effect,
            materials,
            is_paid_for,
            reasons: reasons.into_iter().collect(),
            pixels: is_of_pixels.then_some(pixels),
            wrong: differing(&without.picture, &rendered.picture, 0).count() as u64,
            work: effect.calls(&rendered.counters).abs_diff(effect.calls(&other)),
            otherwise: None,
            draws_less: visible(&without.counters) < visible(&rendered.counters),
        });
    }
    // All frames are timed in the same rounds, so that what changes on the machine changes all of them.
    let planned = set_times(scene, &mut needs, target, timing);
    let mut found = Needs { needs, planned, textures: Vec::new(), antialiasing: Vec::new() };
    found.textures = textures(scene, &names, pieces, seen);
    // More samples are tried only where a texture is so fine that one sample for each pixel misses some of it.
    if found.textures.iter().any(|texture| texture.texels > FINE) {
        antialias(scene, &names, (&items, &mut found), target, timing)?;
    }
    Ok(found)
}

/// The materials of the items that an effect is called for, each with the pixels where it is seen and pays, most pixels first;
/// and all pixels that pay, which may show other materials besides.
fn paying_materials(
    names: &[String],
    called: &[bool],
    items: &Frame<u32>,
    effects: &Frame<u32>,
    effect: Effect,
) -> (Vec<(String, u64)>, u64) {
    let mut by_material: BTreeMap<&str, u64> = BTreeMap::new();
    for (name, is_called) in names.iter().zip(called) {
        if *is_called {
            by_material.entry(name).or_default();
        }
    }
    let mut pixels = 0;
    for (y, row) in effects.rows() {
        for (bits, item) in row.iter().zip(items.row(y)) {
            if bits & (1 << effect as u32) == 0 {
                continue;
            }
            pixels += 1;
            if let Some(name) = names.get(*item as usize)
                && let Some(count) = by_material.get_mut(name.as_str())
            {
                *count += 1;
            }
        }
    }
    let mut materials = Vec::new();
    for (name, pixels) in by_material {
        materials.push((name.to_owned(), pixels));
    }
    materials.sort_by_key(|(_, pixels)| std::cmp::Reverse(*pixels));
    (materials, pixels)
}

/// The name of each item's material, or what stands for it.
fn names(scene: &Scene, origins: &[Origin]) -> Vec<String> {
    let mut names = Vec::with_capacity(scene.items.len());
    for item in 0..scene.items.len() {
        names.push(match origins.get(item) {
            Some(origin) if !origin.material.is_empty() => origin.material.clone(),
            Some(_) => "faces without a material".to_owned(),
            None => format!("item {item}"),
        });
    }
    names
}

/// The item that is seen at each pixel, by the piece that is.
fn seen_items(pieces: &[Piece], seen: &Frame<u32>) -> Frame<u32> {
    let mut items = Frame::new(seen.bounds(), NOTHING);
    for (y, row) in seen.rows() {
        for (item, seen) in items.row_mut(y).iter_mut().zip(row) {
            *item = pieces.get(*seen as usize).map_or(NOTHING, |piece| piece.item);
        }
    }
    items
}

/// Pixels in which a channel differs by more than so many steps.
pub(crate) fn differing<'a>(
    a: &'a Frame<Colour>,
    b: &'a Frame<Colour>,
    steps: u8,
) -> impl Iterator<Item = (i32, i32)> + 'a {
    let x0 = a.bounds().x0;
    a.rows().flat_map(move |(y, row)| {
        let pixels = (x0..).zip(row.iter().zip(b.row(y)));
        pixels.filter_map(move |(x, (a, b))| is_far(*a, *b, steps).then_some((x, y)))
    })
}

/// Whether two colours differ by more than so many steps of 255 in any channel.
fn is_far(a: Colour, b: Colour, steps: u8) -> bool {
    a.into_iter().zip(b).any(|(a, b)| a.abs_diff(b) > steps)
}

/// Fragments that passed the depth test.
fn visible(counters: &Counters) -> u64 {
    counters.fragments - counters.depth_failed
}

/// The plan with one effect switched over.
fn otherwise(effect: Effect, is_paid_for: bool) -> Effects {
    Effects::PLANNED.with(effect, if is_paid_for { Mode::Never } else { Mode::Always })
}

/// The mixtures of effects that a renderer may have without looking at a single one: name, effects, and what that is.
pub(crate) const PLANS: [(&str, Effects, &str); 3] = [
    ("all", Effects::ALWAYS, "every effect is computed everywhere"),
    ("usual", Effects::USUAL, "what a usual renderer leaves out is left out"),
    ("planned", Effects::PLANNED, "what changes no pixel, by a proof, is left out"),
];

/// Draws a frame: what is timed of it.
pub(crate) fn frame_pass<'a>(
    (scene, drawer): (&'a Scene, Drawer),
    effects: Effects,
    target: &'a RefCell<&mut Target>,
) -> Pass<'a> {
    Pass::new(move || {
        let rendered = drawer.render(scene, &effects, &mut target.borrow_mut());
        std::hint::black_box(rendered.is_ok());
    })
}

/// Times of passes, each of which is compared with the first.
fn over_first(mut passes: Vec<Pass<'_>>, timing: Timing) -> Vec<Times> {
    let pairs: Vec<_> = (1..passes.len()).map(|other| vec![other, 0]).collect();
    compare(&mut passes, timing, &pairs, &|_| ())
}

/// Times the planned frame, and those in which one effect is switched over that makes a difference in work.
fn set_times(scene: &Scene, needs: &mut [Need], target: &mut Target, timing: Timing) -> Times {
    let mut working: Vec<&mut Need> = needs.iter_mut().filter(|need| need.work > 0).collect();
    // The planned frame is the first one, with which all others are compared.
    let target = RefCell::new(target);
    let mut passes = vec![frame_pass((scene, Drawer::Scanline), Effects::PLANNED, &target)];
    for need in &working {
        let effects = otherwise(need.effect, need.is_paid_for);
        passes.push(frame_pass((scene, Drawer::Scanline), effects, &target));
    }
    let mut times = over_first(passes, timing).into_iter();
    let planned = times.next().expect("the planned frame is timed");
    for (need, times) in working.iter_mut().zip(times) {
        need.otherwise = Some(times);
    }
    planned
}

/// Twice the area of a triangle.
fn doubled_area([a, b, c]: [DVec2; 3]) -> f64 {
    (b - a).perp_dot(c - a).abs()
}

/// How many texels of each textured material lie along the side of a pixel.
fn textures(scene: &Scene, names: &[String], pieces: &[Piece], seen: &Frame<u32>) -> Vec<Fineness> {
    // Of a textured piece its item, and the root of how many texels there are to a pixel, by the areas of both triangles.
    let mut of_pieces: Vec<Option<(usize, f64)>> = vec![None; pieces.len()];
    for (of, piece) in of_pieces.iter_mut().zip(pieces) {
        let item = piece.item as usize;
        let Some(texture) = &scene.items[item].material.texture else { continue };
        let (width, height) = texture.size();
        let size = DVec2::new(width.into(), height.into());
        let texels = doubled_area(piece.triangle.vertices.map(|vertex| vertex.varying * size));
        let of_pixels = doubled_area(piece.px.map(DVec2::from));
        if of_pixels > 0.0 {
            *of = Some((item, (texels / of_pixels).sqrt()));
        }
    }
    // A number for each pixel, so that the median is that of what is seen.
    let mut by_material: BTreeMap<&str, Vec<f64>> = BTreeMap::new();
    for (_, row) in seen.rows() {
        for seen in row {
            if let Some(Some((item, texels))) = of_pieces.get(*seen as usize) {
                by_material.entry(&names[*item]).or_default().push(*texels);
            }
        }
    }
    let mut textures = Vec::new();
    for (name, mut all) in by_material {
        let middle = all.len() / 2;
        let (_, median, _) = all.select_nth_unstable_by(middle, f64::total_cmp);
        let texels = *median;
        let (material, pixels) = (name.to_owned(), all.len() as u64);
        textures.push(Fineness { material, pixels, texels, far: Vec::new() });
    }
    textures
}

/// Draws the scene with more and more samples, and counts for each fine texture the pixels that are far from 64.
fn antialias(
    scene: &Scene,
    names: &[String],
    (items, found): (&Frame<u32>, &mut Needs),
    target: &Target,
    timing: Timing,
) -> Result<(), BadScene> {
    const ALL: [(&str, Antialias); 4] = [
        ("none", Antialias::None),
        ("ssaa2", Antialias::Supersample(2)),
        ("ssaa4", Antialias::Supersample(4)),
        ("ssaa8", Antialias::Supersample(8)),
    ];
    let size = target.size();
    let mut pictures = Vec::new();
    let mut targets = Vec::new();
    for (name, antialias) in ALL {
        // A picture too large to be drawn with so many samples is not compared.
        let Ok(mut target) = Target::new(size.width(), size.height(), antialias, target.format)
        else {
            return Ok(());
        };
        let picture = Drawer::Scanline.render(scene, &Effects::PLANNED, &mut target)?.picture;
        pictures.push((name, picture));
        targets.push(target);
    }
    let targets: Vec<_> = targets.iter_mut().map(RefCell::new).collect();
    let pass = |target| frame_pass((scene, Drawer::Scanline), Effects::PLANNED, target);
    let times = over_first(targets.iter().map(pass).collect(), timing);
    for ((name, _), time) in ALL.iter().zip(&times) {
        if let Some(ratio) = time.over(&times[0]) {
            found.antialiasing.push((name, ratio));
        }
    }
    // The picture with the most samples is the one that all others are compared with.
    let Some((_, finest)) = pictures.pop() else { return Ok(()) };
    for (name, picture) in &pictures {
        // Pixels are counted by the material that is seen at their centres.
        let mut far: BTreeMap<&str, u64> = BTreeMap::new();
        for (x, y) in differing(picture, &finest, FAR) {
            if let Some(of) = items.get(x, y).and_then(|item| names.get(item as usize)) {
                *far.entry(of).or_default() += 1;
            }
        }
        for texture in &mut found.textures {
            texture.far.push((name, far.get(texture.material.as_str()).copied().unwrap_or(0)));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Made-up times in which a frame takes half as long with an effect switched over.
    #[test]
    fn what_does_no_work_adds_nothing() {
        let times = Times::of(vec![vec![2e6; 8], vec![1e6; 8], vec![4e6; 8]], None);
        let need = |work: u64, is_paid_for: bool, draws_less: bool| Need {
            effect: Effect::Shadows,
            materials: Vec::new(),
            is_paid_for,
            reasons: Vec::new(),
            pixels: None,
            wrong: 0,
            work,
            otherwise: Some(times[if is_paid_for { 1 } else { 2 }].clone()),
            draws_less,
        };
        assert_eq!(need(5, true, false).adds_ms(&times[0]), Some(1.0));
        assert_eq!(need(5, false, false).adds_ms(&times[0]), Some(2.0));
        assert_eq!(need(0, true, false).adds(&times[0]), Adds::NoWork);
        assert_eq!(need(0, false, false).adds_ms(&times[0]), None);
        assert_eq!(need(5, true, true).adds(&times[0]), Adds::DrawsLess);
    }
}
