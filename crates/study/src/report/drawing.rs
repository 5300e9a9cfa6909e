//! What is said of a scene that was drawn: a picture, or two that are compared.

use std::error::Error;
use std::path::Path;
use std::time::Duration;

use rasterproof_core::frame::Frame;
use rasterproof_host::text::printable_path;
use rasterproof_models::Origin;
use rasterproof_registry::engines::Engine;
use rasterproof_registry::undecided::{self, EngineFrame};
use rasterproof_render::effects::Effect;
use rasterproof_render::effects::depth_ties::ByRounding;
use rasterproof_render::effects::plan::Plan;
use rasterproof_render::effects::render::{PaidMap, Rendered};
use rasterproof_render::pipeline::Counters;
use rasterproof_render::pipeline::target::{Colour, Target};
use rasterproof_render::scene::{Hidden, Scene};
use rasterproof_report::frame_comparison::{self, Amount, Comparison, Times};
use rasterproof_report::html::{Chapter, Outcome, PictureLayer, PictureView, Report};
use rasterproof_report::picture;
use rasterproof_report::table::{Row, Table};
use rasterproof_report::words::{self, thousands};
use rasterproof_tiles::frames::HandedOver;

use super::plan;
use crate::corner_grid::CornerGrid;
use crate::snapping::{self, BySnapping};

/// A frame of one rasterizer, with what was found of its plan.
pub struct Drawing {
    pub name: &'static str,
    pub rendered: Rendered,
    pub time: Duration,
    /// Holds every depth, where two rasterizers are compared.
    pub target: Target,
    /// Pixels that are others where every depth and sample is there, which is a fault.
    pub unplanned: u64,
    /// Pixels that the plan of a file, or effects that were switched off, change.
    pub changed: u64,
    /// Whether the target has every depth of every sample.
    pub is_complete: bool,
}

/// The data of a report on drawings, of which counters and plan are those of the first.
#[derive(serde::Serialize)]
pub struct Data<'a> {
    pub scene: &'a str,
    pub engines: Vec<&'static str>,
    pub times: &'a Times,
    pub counters: &'a Counters,
    pub plan: &'a Plan,
    pub comparison: &'a Option<Comparison>,
    pub by_rounding: Option<&'a ByRounding>,
    pub by_snapping: Option<&'a BySnapping>,
    pub grid: Option<&'a ByGrid>,
}

/// The rasterizers, in the order in which they drew.
pub fn names(drawings: &[Drawing]) -> Vec<&'static str> {
    drawings.iter().map(|drawing| drawing.name).collect()
}

/// Whether two rasterizers have drawn no pixel at all, so that two backgrounds would be compared.
pub fn is_nothing_drawn(drawings: &[Drawing]) -> bool {
    drawings.len() > 1 && drawings.iter().all(|drawing| drawing.rendered.is_blank())
}

/// Pixels that the plan of a file, or effects that were switched off, change.
pub fn changed(drawings: &[Drawing]) -> u64 {
    drawings.iter().map(|drawing| drawing.changed).max().unwrap_or(0)
}

/// Whether two frames are alike, and nothing but their plan is wrong.
pub fn is_plan_alone(c: &Comparison, drawings: &[Drawing]) -> bool {
    c.wrong_depths == 0 && c.wrong_pixels > 0 && c.wrong_pixels == changed(drawings)
}

/// Compares two drawings, where there is something to compare; ties are looked for where there are depths to look at.
pub fn compare(
    scene: &Scene,
    drawings: &[Drawing],
    follows_plan: bool,
) -> Result<Option<Comparison>, Box<dyn Error + Send + Sync>> {
    let [a, b] = drawings else { return Ok(None) };
    if is_nothing_drawn(drawings) {
        return Ok(None);
    }
    // Where a depth is missing, since the plan needed none there, no tie can be looked for.
    let drawn = [(Engine::Scanline, a), (Engine::EdgeFunction, b)];
    let drawn = drawn.map(|(engine, drawing)| EngineFrame { engine, target: &drawing.target });
    let is_complete = a.is_complete && b.is_complete;
    let ties = is_complete.then(|| undecided::find(scene, drawn)).transpose()?;
    let (first, second) = ((&a.rendered.picture, &a.target), (&b.rendered.picture, &b.target));
    // What a plan changes is wrong in one of the two, even if both follow it.
    let mut comparison = frame_comparison::compare(first, second, ties.as_ref());
    comparison.wrong_pixels += a.unplanned + b.unplanned;
    if follows_plan {
        // Two rasterizers that follow one wrong plan agree with each other, not with the scene.
        comparison.wrong_pixels += changed(drawings);
    }
    Ok(Some(comparison))
}

/// Pixels in which rounding alone decides which surface is seen, and those that snapping breaks, as `study` counts them.
pub fn undecided_and_broken(
    scene: &Scene,
    origins: &[Origin],
    target: &Target,
    grid: CornerGrid,
) -> Result<(ByRounding, BySnapping), Box<dyn Error + Send + Sync>> {
    // Without a depth buffer no depth decides.
    if scene.hidden == Hidden::Painter {
        return Ok(Default::default());
    }
    let (classes, by_snapping) = snapping::look(scene, origins, target, grid)?;
    let first = classes.first.map(|pair| pair.pixel.into());
    Ok((ByRounding { pixels: classes.by_rounding, first }, by_snapping))
}

/// What another grid changes in a picture.
#[derive(serde::Serialize)]
pub struct ByGrid {
    /// Pixels that have another colour than on the usual grid, and the first of them.
    pub pixels: u64,
    pub first: Option<[i32; 2]>,
    #[serde(skip)]
    pub picture: Frame<Colour>,
}

impl ByGrid {
    /// Compares the picture on the usual grid with a drawing on another one.
    pub fn between((usual, usual_target): (&Frame<Colour>, &Target), drawing: &Drawing) -> Self {
        // Ties are not looked for: what a grid changes is told whatever decides it.
        let (picture, target) = (&drawing.rendered.picture, &drawing.target);
        let compared = frame_comparison::compare((usual, usual_target), (picture, target), None);
        let mut first = None;
        for (y, row) in usual.rows() {
            for (x, own) in (0..).zip(row) {
                if first.is_none() && picture.get(x, y) != Some(*own) {
                    first = Some([x, y]);
                }
            }
        }
        Self {
            pixels: frame_comparison::differing(usual, picture),
            first,
            picture: compared.picture,
        }
    }
}

/// The same in words.
pub fn grid_notes(
    found: &ByGrid,
    grid: CornerGrid,
    place: Option<impl std::fmt::Display>,
) -> Vec<String> {
    // Where the differences were drawn to a file, its name.
    let place = place.map(|place| format!(", drawn in {place}")).unwrap_or_default();
    let usual = CornerGrid::USUAL;
    let sentence = match found.first {
        None => format!(
            "GRID: with corners {grid} no pixel differs from the picture with corners {usual}"
        ),
        Some([x, y]) => {
            let pixels = match found.pixels {
                1 => "1 pixel differs".to_owned(),
                many => format!("{} pixels differ", thousands(many)),
            };
            format!(
                "GRID: with corners {grid} {pixels} from the picture with corners {usual}, the first at {x}, {y}{place}"
            )
        }
    };
    vec![sentence]
}

/// What snapping breaks in words, a line each, and the command that names faces and cures.
pub fn snapped(found: BySnapping, grid: CornerGrid, study: &str) -> Vec<String> {
    let cracks = "in cracks, which show what is behind a surface";
    let folds = "in folds, where a surface is drawn too often";
    // A line for each kind that occurs, then where to read more.
    let mut lines = Vec::new();
    lines.extend(snapped_pixels(found.cracks, found.first_crack, cracks, grid));
    lines.extend(snapped_pixels(found.folds, found.first_fold, folds, grid));
    if let Some(first) = found.first_turned {
        let BySnapping { turned_over, flattened, .. } = found;
        lines.push(format!(
            "SNAPPING: once corners are {grid}, {} turned over and {flattened} flattened; the first is of face {first}",
            words::count(turned_over, "triangle is", "triangles are")
        ));
    }
    if let Some(first) = found.first_nearly_meeting {
        lines.push(format!(
            "SEAMS: corners nearly meet in {}, which are open borders for whoever compares bits; the first is at face {first}",
            words::count(found.nearly_meeting, "place", "places")
        ));
    }
    if !lines.is_empty() {
        lines.push(format!("the faces there, and what mends them: {study}"));
    }
    lines
}

/// How many pixels are broken in one way, and the first; nothing where there is none.
fn snapped_pixels(
    count: u64,
    first: Option<[i32; 2]>,
    what: &str,
    grid: CornerGrid,
) -> Option<String> {
    let [x, y] = first?;
    let pixels = words::count(count, "pixel", "pixels");
    Some(format!("SNAPPING: {pixels} {what} once its corners are {grid}; the first is at {x}, {y}"))
}

/// What decides which surface is seen, and how far it reaches, in words: for every rasterizer, and for tiles.
pub const ROUNDING: [&str; 2] = ["rounding alone", "snapped corners move a depth"];
pub const ROUNDING_IN_TILES: [&str; 2] =
    ["rounding to f32 or snapping", "snapping and f32 move a depth"];

/// The same in words; nothing where nothing is.
pub fn rounding(found: ByRounding, [what, reach]: [&str; 2]) -> Option<String> {
    let (x, y) = found.first?;
    let pixels = match found.pixels {
        1 => "1 pixel has",
        count => &format!("{count} pixels have"),
    };
    Some(format!(
        "ROUNDING: {pixels} two surfaces nearer to each other than {reach}; {what} decides which one is \
         seen; the first is at {x}, {y} (see docs/ties.md)"
    ))
}

/// What two drawings come to, or that nothing was drawn.
pub fn outcome(
    drawings: &[Drawing],
    comparison: Option<&Comparison>,
    difference: Option<String>,
) -> Option<Outcome> {
    let Some(c) = comparison else {
        return is_nothing_drawn(drawings).then(Outcome::nothing_drawn);
    };
    // Alike, alike but for the plan, or different: the first two need no second look at the engines.
    let names = names(drawings).join(" and ");
    let Comparison { wrong_pixels: wrong, pixels, wrong_depths, depths, .. } = c;
    let sentence = if c.agrees() {
        format!("{names}, {pixels} pixels and {depths} depths, 0 differ")
    } else if is_plan_alone(c, drawings) {
        format!("{names} draw alike, and by this plan {wrong} of {pixels} pixels wrong; plan again")
    } else {
        let place = difference.map(|path| format!(", drawn in {path}")).unwrap_or_default();
        let depths = format!("{wrong_depths} of {depths} depths differ{place}");
        format!("{names}: {wrong} of {pixels} pixels and {depths}")
    };
    Some(Outcome::of(c.agrees(), sentence))
}

/// What a page has besides: the frames side by side, and the plan that was followed.
pub fn add_to_page(
    report: &mut Report,
    command: String,
    scene: &Scene,
    drawings: &[Drawing],
    comparison: Option<&Comparison>,
) {
    let layer = |d: &Drawing| PictureLayer::new(d.name, &picture::of_frame(&d.rendered.picture));
    // A third layer, where there is something to mark.
    let marked = comparison.filter(|c| !c.agrees() || leaves_open(c));
    let marked = marked.map(|c| {
        let picture = picture::of_frame(&c.picture);
        PictureLayer::map("what differs", &picture, &frame_comparison::marks())
    });
    report.title = format!("The scene {}", scene.name);
    report.command.clone_from(&command);
    // The plan comes before the tables that are there.
    let plan = drawings.first().map(|d| plan::table(&d.rendered.plan.decisions));
    report.tables.splice(0..0, plan);
    report.frames = vec![PictureView {
        name: scene.name.clone(),
        about: scene.about.clone(),
        command,
        chapter: Chapter { title: "chapter 9, the pipeline", path: "ch09.md" },
        layers: drawings.iter().map(layer).chain(marked).collect(),
    }];
}

/// Whether some pixels are right in either of two colours.
pub fn leaves_open(c: &Comparison) -> bool {
    c.undecided > 0 || c.far_texture > 0
}

/// What was drawn, how long that took, and what is right in either of two colours.
pub fn notes(
    scene: &Scene,
    drawings: &[Drawing],
    times: &Times,
    comparison: Option<&Comparison>,
    [output, difference]: [Option<&Path>; 2],
) -> Vec<String> {
    // The counters are those of the first rasterizer, whose plan is shown as well.
    let c = &drawings[0].rendered.counters;
    let mut notes = vec![
        format!(
            "vertices {}, triangles {} (rejected {}, clipped {}), in the window {}, culled {}",
            c.vertices, c.triangles, c.rejected, c.clipped, c.pieces, c.culled
        ),
        format!(
            "fragments {}, depth tests {} (failed {}), shaded {}",
            c.fragments, c.depth_tests, c.depth_failed, c.shaded
        ),
    ];
    // Only a scene that says how many layers it keeps leaves any out.
    if let (Some(most), true) = (scene.layers, c.layers > 0) {
        notes.push(format!(
            "layers {}, of which {} lie behind the {most} nearest of their sample and are left out",
            c.layers, c.layers_left_out
        ));
    }
    notes.push(times_text(times, &names(drawings)));
    notes.extend(output.map(|output| format!("drawn in {}", printable_path(output))));
    let changed = changed(drawings);
    if changed > 0 {
        notes.push(format!("what is switched off is called for: it changes {changed} pixels"));
    }
    // What follows is of two pictures that were compared.
    let Some(c) = comparison else { return notes };
    let Comparison { undecided, undecided_differ, far_texture, .. } = c;
    if *undecided > 0 {
        let place = difference.map(|path| format!(", drawn in {}", printable_path(path)));
        let place = place.unwrap_or_default();
        notes.push(format!(
            "UNDECIDED: {undecided} pixels are undecided by either, {undecided_differ} of them differ: \
             surfaces that tie{place} (see docs/ties.md)"
        ));
    }
    if *far_texture > 0 {
        notes.push(format!(
            "UNDECIDED: {far_texture} pixels differ by large texture coordinates, whose bound holds \
             several texels (see docs/ties.md)"
        ));
    }
    notes
}

/// `loaded in 12 ms; drawn in 3.1 ms by scanline, 4.0 ms by edge-function`.
pub fn times_text(times: &Times, names: &[&str]) -> String {
    let shown = |seconds: f64| match seconds * 1e3 {
        ms if ms < 10.0 => format!("{ms:.1} ms"),
        ms if ms < 1e3 => format!("{ms:.0} ms"),
        _ => format!("{seconds:.2} s"),
    };
    let loaded = times.loading_s.map(|time| format!("loaded in {}; ", shown(time)));
    let by = times.drawing_s.iter().zip(names);
    let drawn: Vec<_> = by.map(|(&time, name)| format!("{} by {name}", shown(time))).collect();
    format!("{}drawn in {}", loaded.unwrap_or_default(), drawn.join(", "))
}

/// How many pixels pay for each effect, and how much the fragments of a pixel pay.
pub fn paid(map: &PaidMap) -> Table {
    let row = |effect: Effect| {
        let paid = frame_comparison::paid(&map.effects, effect);
        Row::of(&[&effect.name(), &thousands(paid)])
    };
    let amounts = [("fragments", &map.fragments), ("effects of fragments", &map.payments)];
    let notes = amounts.map(|(what, counts)| {
        let Amount { mean, most, at: [x, y], pixels } = Amount::of(counts);
        format!(
            "{what}: {mean:.2} a pixel on average, at most {most} (in {pixels} px, first {x},{y})"
        )
    });
    let rows = frame_comparison::mapped().map(row).collect();
    Table::new("", "effect 15 | >px 9", rows).noted(notes.to_vec())
}

/// Why triangles were not drawn in tiles, a line for each reason.
pub fn handed_over(handed_over: &HandedOver, all: usize) -> Vec<String> {
    let beyond_f32 = "are of an item with values beyond 2^62, which may overflow in f32";
    let reasons = [
        (handed_over.in_shadows, "are in a scene with shadows"),
        (handed_over.not_opaque, "are of a material that is not opaque"),
        (
            handed_over.other_effects,
            "are of a physical material, or ask for an effect that tiles do not have",
        ),
        (handed_over.beyond_f32, beyond_f32),
    ];
    let of_reason = |(count, reason): (usize, &str)| {
        (count > 0).then(|| format!("{count} of {all} triangles {reason}: handed to scanline"))
    };
    reasons.into_iter().filter_map(of_reason).collect()
}
