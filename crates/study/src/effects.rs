//! Which effects a scene calls for: by which materials, in which pixels, and what the picture is without them.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use glam::DVec2;
use rasterproof_core::frame::Frame;
use rasterproof_models::Origin;
use rasterproof_precision::cost::{Pass, Spread, Timing, time};
use rasterproof_registry::engines::Drawer;
use rasterproof_render::effects::render::BadScene;
use rasterproof_render::effects::{Effect, Effects, Mode};
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
    /// Nanoseconds of a planned frame with this effect switched off where it is paid for, and on everywhere where it is
    /// not.
    pub otherwise: Spread,
}

impl Need {
    #[must_use]
    pub fn state(&self) -> State {
        match (self.is_paid_for, self.wrong) {
            (_, 1..) => State::CalledFor,
            (true, 0) => State::ToBeSafe,
            (false, 0) => State::NotCalledFor,
        }
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

#[derive(Clone, Debug)]
pub struct Needs {
    pub needs: Vec<Need>,
    /// Nanoseconds of the planned frame.
    pub planned: Spread,
    pub textures: Vec<Fineness>,
    /// Nanoseconds of a frame by antialiasing, where it was drawn.
    pub antialiasing: Vec<(&'static str, f64)>,
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
    budget: Duration,
) -> Result<Needs, BadScene> {
    let drawer = Drawer::Scanline;
    let names = names(scene, origins);
    let items = seen_items(pieces, seen);
    let (rendered, map) = drawer.render_mapped(scene, &Effects::PLANNED, target)?;
    let mut needs = Vec::new();
    for effect in Effect::ALL {
        let picture = drawer.render_without(scene, effect, target)?.picture;
        let decisions = rendered.plan.decisions.iter().filter(|d| d.effect == effect);
        let mut reasons: BTreeMap<String, u64> = BTreeMap::new();
        let mut called = vec![false; scene.items.len()];
        let mut is_paid_for = false;
        for decision in decisions {
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
        let mut by_material: BTreeMap<&str, u64> = BTreeMap::new();
        for (item, _) in called.iter().enumerate().filter(|(_, is)| **is) {
            by_material.entry(&names[item]).or_default();
        }
        let mut pixels = 0;
        for (y, row) in map.effects.rows() {
            for (bits, item) in row.iter().zip(items.row(y)) {
                if bits & (1 << effect as u32) != 0 {
                    pixels += 1;
                    if let Some(name) = names.get(*item as usize)
                        && let Some(count) = by_material.get_mut(name.as_str())
                    {
                        *count += 1;
                    }
                }
            }
        }
        let mut materials: Vec<(String, u64)> =
            by_material.into_iter().map(|(name, pixels)| (name.to_owned(), pixels)).collect();
        materials.sort_by_key(|(_, pixels)| std::cmp::Reverse(*pixels));
        needs.push(Need {
            effect,
            materials,
            is_paid_for,
            reasons: reasons.into_iter().collect(),
            pixels: is_of_pixels.then_some(pixels),
            wrong: differing(&picture, &rendered.picture, 0).count() as u64,
            otherwise: Spread { low: 0.0, median: 0.0, high: 0.0 },
        });
    }
    let start = Instant::now();
    drawer.render(scene, &Effects::PLANNED, target)?;
    let all = start.elapsed().as_secs_f64() * (needs.len() + 1) as f64;
    let rounds = ((budget.as_secs_f64() / all.max(1e-6)) as usize).clamp(2, 31);
    let timing = if budget.is_zero() { Timing::ONCE } else { Timing { rounds, ..Timing::QUICK } };
    let planned = set_times(scene, &mut needs, target, timing);
    let mut found = Needs { needs, planned, textures: Vec::new(), antialiasing: Vec::new() };
    found.textures = textures(scene, &names, pieces, seen);
    if found.textures.iter().any(|texture| texture.texels > FINE) {
        antialias(scene, &names, (&items, &mut found), target)?;
    }
    Ok(found)
}

/// The name of each item's material, or what stands for it.
fn names(scene: &Scene, origins: &[Origin]) -> Vec<String> {
    let name = |item: usize| match origins.get(item) {
        Some(origin) if !origin.material.is_empty() => origin.material.clone(),
        Some(_) => "faces without a material".to_owned(),
        None => format!("item {item}"),
    };
    (0..scene.items.len()).map(name).collect()
}

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
        let pairs = (x0..).zip(row.iter().zip(b.row(y)));
        let far = pairs
            .filter(move |(_, (a, b))| a.iter().zip(b.iter()).any(|(a, b)| a.abs_diff(*b) > steps));
        far.map(move |(x, _)| (x, y))
    })
}

/// Times the planned frame, and those in which one effect is switched over.
fn set_times(scene: &Scene, needs: &mut [Need], target: &mut Target, timing: Timing) -> Spread {
    let mut all = vec![Effects::PLANNED];
    for need in &*needs {
        let mode = if need.is_paid_for { Mode::Never } else { Mode::Always };
        all.push(Effects::PLANNED.with(need.effect, mode));
    }
    let target = RefCell::new(target);
    let passes = all.into_iter().map(|effects| {
        let target = &target;
        let run = Box::new(move || {
            let drawn = Drawer::Scanline.render(scene, &effects, &mut target.borrow_mut());
            std::hint::black_box(drawn.is_ok());
        });
        Pass { column: 0, run }
    });
    let mut passes: Vec<Pass<'_>> = passes.collect();
    let spreads = time(&mut passes, timing, &|_| ());
    for (need, spread) in needs.iter_mut().zip(&spreads[1..]) {
        need.otherwise = *spread;
    }
    spreads[0]
}

/// How many texels of each textured material lie along the side of a pixel.
fn textures(scene: &Scene, names: &[String], pieces: &[Piece], seen: &Frame<u32>) -> Vec<Fineness> {
    let mut of_pieces: Vec<Option<(usize, f64)>> = vec![None; pieces.len()];
    for (of, piece) in of_pieces.iter_mut().zip(pieces) {
        let item = piece.item as usize;
        let Some(texture) = &scene.items[item].material.texture else { continue };
        let (width, height) = texture.size();
        let size = DVec2::new(width.into(), height.into());
        let texels = piece.triangle.vertices.map(|vertex| vertex.varying * size);
        let area = |[a, b, c]: [DVec2; 3]| (b - a).perp_dot(c - a).abs();
        let of_pixels = area(piece.px.map(DVec2::from));
        if of_pixels > 0.0 {
            *of = Some((item, (area(texels) / of_pixels).sqrt()));
        }
    }
    let mut by_material: BTreeMap<&str, Vec<f64>> = BTreeMap::new();
    for (_, row) in seen.rows() {
        for (item, texels) in row.iter().filter_map(|seen| *of_pieces.get(*seen as usize)?) {
            by_material.entry(&names[item]).or_default().push(texels);
        }
    }
    let fineness = |(name, mut all): (&str, Vec<f64>)| {
        let middle = all.len() / 2;
        let (_, median, _) = all.select_nth_unstable_by(middle, f64::total_cmp);
        let texels = *median;
        let (material, pixels) = (name.to_owned(), all.len() as u64);
        Fineness { material, pixels, texels, far: Vec::new() }
    };
    by_material.into_iter().map(fineness).collect()
}

/// Draws the scene with more and more samples, and counts for each fine texture the pixels that are far from 64.
fn antialias(
    scene: &Scene,
    names: &[String],
    (items, found): (&Frame<u32>, &mut Needs),
    target: &Target,
) -> Result<(), BadScene> {
    const ALL: [(&str, Antialias); 4] = [
        ("none", Antialias::None),
        ("ssaa2", Antialias::Supersample(2)),
        ("ssaa4", Antialias::Supersample(4)),
        ("ssaa8", Antialias::Supersample(8)),
    ];
    let size = target.size();
    let mut pictures = Vec::new();
    for (name, antialias) in ALL {
        // A picture too large to be drawn with so many samples is not compared.
        let Ok(mut target) = Target::new(size.width(), size.height(), antialias, target.format)
        else {
            return Ok(());
        };
        let start = Instant::now();
        let picture = Drawer::Scanline.render(scene, &Effects::PLANNED, &mut target)?.picture;
        found.antialiasing.push((name, start.elapsed().as_nanos() as f64));
        pictures.push((name, picture));
    }
    let Some((_, finest)) = pictures.pop() else { return Ok(()) };
    for (name, picture) in &pictures {
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
