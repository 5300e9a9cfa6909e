//! A scene to a picture, through any rasterizer: [`plan`], then [`execute`], or both in one.

pub use super::execute::{PaidMap, PlanError, Rendered};
pub use super::primitive::BadScene;
use super::primitive::pack;

use super::Effects;
use super::conditions::{EVERY_FRAGMENT, of_every_fragment};
use super::execute::{Observer, draw, fit, plans};
use super::plan::{Canvas, PiecePlan, Plan, SceneDigest};
use super::planner;
use super::stages::{Program, Registers};
use crate::pipeline::Counters;
use crate::pipeline::present::DoubleBuffer;
use crate::pipeline::shade::PLACED;
use crate::pipeline::target::{Colour, Target};
use crate::pipeline::wireframe::draw_edges;
use crate::scene::Scene;
use rasterproof_core::contract::{DrawLine, Interpolate, Rasterize};
use rasterproof_core::frame::Frame;

/// What a scene calls for on a canvas. The same scene, canvas and effects give the same plan; of the
/// engine only the width of its words is asked.
///
/// # Errors
/// [`BadScene`].
pub fn plan(
    scene: &Scene,
    engine: &impl Rasterize,
    effects: &Effects,
    canvas: &Canvas,
) -> Result<Plan, BadScene> {
    let word_bits = |corners: &_| engine.word_bits(corners);
    let (plan, _) = planner::plan(scene, canvas, effects, &word_bits)?;
    Ok(Plan { scene: Some(SceneDigest::of(scene)), ..plan })
}

/// Hands to `timed` what [`plan`] does to look at triangles of a scene that is too large to be listed; returns whether it
/// is.
///
/// # Errors
/// [`BadScene`].
pub fn survey_again(
    scene: &Scene,
    canvas: &Canvas,
    timed: &mut dyn FnMut(&dyn Fn()),
) -> Result<bool, BadScene> {
    planner::survey_again(scene, canvas, timed)
}

/// Draws a scene into a target by a plan, word for word; what the target held before is last
/// frame's. The engine is the caller's, in the words that the plan names.
///
/// The depths are in the target afterwards, except where the plan does not test them, or tells
/// samples apart on demand; with [`super::plan::Samples::Middle`] the target stays as it was.
///
/// # Errors
/// [`PlanError`] before anything is drawn, where the plan is of another scene or target.
pub fn execute(
    plan: &Plan,
    scene: &Scene,
    engine: &impl Interpolate,
    target: &mut Target,
) -> Result<Rendered, PlanError> {
    let assembled = fit(plan, scene, target)?;
    Ok(draw(plan.clone(), assembled, scene, engine, target, Observer::None))
}

/// Plans a frame and draws it.
///
/// # Errors
/// [`BadScene`] before anything is drawn.
pub fn render(
    scene: &Scene,
    engine: &impl Interpolate,
    effects: &Effects,
    target: &mut Target,
) -> Result<Rendered, BadScene> {
    plan_and_draw(scene, engine, effects, target, Observer::None)
}

/// As [`render`], while somebody looks: `look` is shown what is on the screen after the clearing,
/// after each item, and at the end. With [`SecondBuffer`](super::Effect::SecondBuffer) that is the front buffer, which
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
    plan_and_draw(scene, engine, effects, back, Observer::Viewer { front, look })
}

/// As [`render`], and for each pixel what its fragments paid for.
///
/// # Errors
/// As [`render`].
pub fn render_mapped(
    scene: &Scene,
    engine: &impl Interpolate,
    effects: &Effects,
    target: &mut Target,
) -> Result<(Rendered, PaidMap), BadScene> {
    let mut map = PaidMap::new(target.size());
    let rendered = plan_and_draw(scene, engine, effects, target, Observer::Map(&mut map))?;
    Ok((rendered, map))
}

fn plan_and_draw(
    scene: &Scene,
    engine: &impl Interpolate,
    effects: &Effects,
    target: &mut Target,
    observer: Observer<'_>,
) -> Result<Rendered, BadScene> {
    let watched = matches!(observer, Observer::Viewer { .. });
    let canvas = Canvas { watched, ..Canvas::of(target) };
    let word_bits = |corners: &_| engine.word_bits(corners);
    let (plan, assembled) = planner::plan(scene, &canvas, effects, &word_bits)?;
    Ok(draw(plan, assembled, scene, engine, target, observer))
}

/// How many pieces of an item have the same list of stages.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct StagedPieces {
    pub item: usize,
    pub pieces: u64,
    /// What becomes of a fragment of these pieces, in order.
    pub stages: Vec<String>,
}

/// The list of stages of each piece that the plan of a frame makes, in the order of the items.
///
/// # Errors
/// [`PlanError`] of a scene that cannot be drawn.
pub fn stages(
    scene: &Scene,
    engine: &impl Interpolate,
    effects: &Effects,
    canvas: &Canvas,
) -> Result<Vec<StagedPieces>, PlanError> {
    let word_bits = |corners: &_| engine.word_bits(corners);
    let (plan, mut assembled) = planner::plan(scene, canvas, effects, &word_bits)?;
    if assembled.pieces.is_none() {
        assembled.assemble(scene);
        assembled.plans = plans(&plan, scene, &assembled)?;
    }
    let (registers, counters) = (&mut Registers::new(), &mut Counters::default());
    let mut all: Vec<StagedPieces> = Vec::new();
    for ((index, piece), plan) in assembled.pieces().iter().zip(&assembled.plans) {
        let item = &assembled.items[*index];
        let view = item.light_view.as_ref().filter(|_| plan.shadows);
        let map = view.map(|view| view.map(scene, engine));
        let program = Program::new(item, piece, *plan, map, None, registers, counters);
        let stages = program.names();
        match all.iter_mut().find(|known| known.item == *index && known.stages == stages) {
            Some(known) => known.pieces += 1,
            None => all.push(StagedPieces { item: *index, pieces: 1, stages }),
        }
    }
    all.sort_by_key(|known| known.item);
    Ok(all)
}

/// Draws the edges of a scene's triangles by a line drawer, with the colours of its fragments. What
/// any renderer does, and every depth is tested: lines have no inside to be planned for. They are opaque and in no shadow.
///
/// # Errors
/// As [`render`].
pub fn render_wireframe(
    scene: &Scene,
    drawer: &impl DrawLine,
    target: &mut Target,
) -> Result<Rendered, BadScene> {
    let canvas = Canvas::of(target);
    let (plan, assembled) = planner::plan(scene, &canvas, &EVERY_FRAGMENT, &|_| None)?;
    // What the painter assembled to be sorted is assembled again.
    let vertices = assembled.counters.vertices;
    let mut counters = Counters { vertices, ..Counters::default() };
    target.clear_colour(scene.background, &mut counters);
    target.clear_depth(&mut counters);
    let (bounds, format) = (target.bounds(), target.format);
    let registers = &mut Registers::new();
    for item in &assembled.items {
        item.assemble(scene, &mut counters, &mut |piece, fills| {
            // A line drawer draws no shadow map.
            let plan = PiecePlan { shadows: false, ..of_every_fragment(scene, item.item) };
            let program = Program::new(item, piece, plan, None, None, registers, fills);
            let mut shader = program.on(registers);
            draw_edges(drawer, &pack::<PLACED>(piece, plan.interpolates), bounds, |f| {
                fills.fragments += 1;
                let colour = shader.one(&f.varying, f.depth);
                for plane in &mut target.planes {
                    plane.test_and_write(f.x_px, f.y_px, format.key(f.depth), || colour);
                }
            });
        });
    }
    Ok(Rendered { picture: target.resolve(), counters, plan })
}
