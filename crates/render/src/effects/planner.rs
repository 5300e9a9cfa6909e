//! A scene to a plan: asks the conditions in the order in which they depend on each other.

use super::assembled::{Assembled, plan_of};
use super::conditions::survey::Survey;
use super::conditions::{
    alpha_test, anisotropy, attributes, blending, clear, clip, cull, depth, depth_buffer, fog,
    interpolation, layers, mip_maps, perspective, samples, second_buffer, shadows, specular,
    wide_words,
};
use super::plan::{
    Canvas, Clear, Decision, FramePlan, ItemPlan, Order, PiecePlan, Pieces, Plan, Rule, VERSION,
};
use super::primitive::{BadScene, Piece, Prepared};
use super::{Effect, Effects, Mode};
use crate::pipeline::Counters;
use crate::pipeline::fog::Share;
use crate::pipeline::opacity::Drawn;
use crate::scene::{Hidden, Scene};
use rasterproof_core::triangle::Corners;

/// How many bits an engine decides a triangle in, where it has several widths.
pub(super) type WordBits<'a> = &'a dyn Fn(&Corners) -> Option<u32>;

/// Plans a frame. What was assembled on the way is not assembled again.
pub(super) fn plan<'a>(
    scene: &'a Scene,
    canvas: &Canvas,
    effects: &Effects,
    word_bits: WordBits<'_>,
) -> Result<(Plan, Assembled<'a>), BadScene> {
    let mut plan = outset(scene, canvas, effects);
    let drawn = plan.drawn();
    let mut assembled = Assembled::new(scene, &plan)?;
    let is_listed = plan.frame.order == Order::FarthestFirst
        || depth::is_looked_at(scene, effects, &assembled.items, &drawn);
    let mut surveys: Vec<Survey<'_>> = (0..scene.items.len())
        .map(|i| Survey::new(scene, effects, i, plan.items[i].carries, is_listed))
        .collect();
    // Layers are kept for each sample.
    let has_layers = layers::is_in_use(scene, effects);
    let estimates = !has_layers && samples::may_be_on_demand(&drawn, effects);
    let mut estimate = estimates.then(|| samples::Estimate::new(&drawn));
    let mut is_tested = depth::pays(scene, effects, true);
    if is_listed {
        assembled.assemble(scene);
        let pieces = assembled.pieces.as_deref().unwrap_or_default();
        let plans = list(scene, effects, &mut plan, &assembled.items, pieces);
        is_tested = plans.iter().any(|plan| plan.depth);
        for ((index, piece), plan) in pieces.iter().zip(&plans) {
            surveys[*index].count(piece, *plan, word_bits(&piece.corners()));
            if let Some(estimate) = &mut estimate {
                estimate.see(&piece.corners(), *plan);
            }
        }
        assembled.plans = plans;
        assembled.sort(plan.frame.order);
    } else if let Some(estimate) = &mut estimate {
        let has_fog = fog::mode(scene, effects) != Mode::Never;
        let fog_at_most = if has_fog { Share::Mixed } else { Share::None };
        for item in &assembled.items {
            let interpolates = interpolation::at_most(item.item, item.carries);
            let at_most = |mode| if mode == Mode::Never { Drawn::All } else { Drawn::Mixed };
            let plan = PiecePlan {
                interpolates,
                perspective: true,
                depth: is_tested,
                specular: false,
                shadows: false,
                mip_maps: false,
                anisotropy: false,
                fog: fog_at_most,
                alpha_test: at_most(alpha_test::mode(item.item, effects)),
                blending: at_most(blending::mode(item.item, effects)),
                layers: false,
            };
            estimate.see_roughly(item, plan);
        }
    }
    let nothing = rasterproof_core::grid::SubpixelPoint::new(0, 0);
    for survey in &mut surveys {
        survey.has_widths = word_bits(&[nothing; 3]).is_some();
    }
    let samples = samples::decide(canvas, effects, estimate.as_ref());
    plan.frame.samples = samples;
    let first = assembled.pieces.as_deref().map(|pieces| (pieces, &assembled.plans[..]));
    plan.frame.clear = clear::decide(effects, &drawn, samples, first);
    plan.frame.clear_depths = depth_buffer::clears(effects, is_tested, samples);
    let looked_at = (!is_listed && depth::is_surveyed(scene))
        .then(|| depth::survey(scene, &assembled.items, &drawn));
    let found = (assembled.pieces.as_ref().map(|_| &assembled.counters), is_tested);
    plan.decisions = account(scene, effects, &plan, &surveys, looked_at, found);
    Ok((plan, assembled))
}

/// See [`super::render::survey_again`].
pub(super) fn survey_again(
    scene: &Scene,
    canvas: &Canvas,
    timed: &mut dyn FnMut(&dyn Fn()),
) -> Result<bool, BadScene> {
    let (plan, assembled) = plan(scene, canvas, &Effects::PLANNED, &|_| None)?;
    let is_surveyed = assembled.pieces.is_none() && depth::is_surveyed(scene);
    if is_surveyed {
        timed(&|| {
            std::hint::black_box(depth::survey(scene, &assembled.items, &plan.drawn()));
        });
    }
    Ok(is_surveyed)
}

/// What is known without looking at triangles.
fn outset(scene: &Scene, canvas: &Canvas, effects: &Effects) -> Plan {
    let order = match scene.hidden {
        Hidden::Painter => Order::FarthestFirst,
        Hidden::DepthBuffer => Order::Submission,
    };
    let item = |item| {
        let carries = attributes::carries(scene, item, effects);
        let (interpolates, where_it_varies) = interpolation::rule(item, carries, effects);
        let perspective = perspective::mode(scene, effects);
        let depth = depth::pays(scene, effects, true);
        let specular = specular::mode(scene, item, carries, effects);
        let shadows = shadows::mode(scene, item, carries, effects);
        let fog = fog::mode(scene, effects);
        let mip_maps = mip_maps::mode(item, carries, effects);
        let anisotropy = anisotropy::mode(item, carries, effects);
        let alpha_test = alpha_test::mode(item, effects);
        let blending = blending::mode(item, effects);
        let layers = layers::mode(scene, item, effects);
        let rule = Rule {
            interpolates,
            where_it_varies,
            perspective,
            depth,
            specular,
            shadows,
            mip_maps,
            anisotropy,
            fog,
            alpha_test,
            blending,
            layers,
        };
        ItemPlan {
            clip: effects.mode(Effect::Clip),
            cull: effects.mode(Effect::Cull),
            carries,
            pieces: Pieces::AsTheyCome(rule),
        }
    };
    Plan {
        version: VERSION,
        scene: None,
        canvas: *canvas,
        frame: FramePlan {
            order,
            wide_words: effects.mode(Effect::WideWords),
            samples: samples::decide(canvas, effects, None),
            clear: Clear::Everything,
            clear_depths: true,
            second_buffer: second_buffer::pays(canvas, effects),
        },
        items: scene.items.iter().map(item).collect(),
        decisions: Vec::new(),
    }
}

/// Lists what each piece pays for in the plan of its item.
fn list(
    scene: &Scene,
    effects: &Effects,
    plan: &mut Plan,
    items: &[Prepared<'_>],
    pieces: &[(usize, Piece)],
) -> Vec<PiecePlan> {
    let apart =
        effects.mode(Effect::Depth) == Mode::Planned && plan.frame.order == Order::Submission;
    let overlaps = apart.then(|| depth::overlaps(pieces, &plan.drawn()));
    let rules: Vec<Option<Rule>> = plan
        .items
        .iter()
        .map(|item| match item.pieces {
            Pieces::AsTheyCome(rule) => Some(rule),
            Pieces::Listed(_) => None,
        })
        .collect();
    let mut plans = Vec::with_capacity(pieces.len());
    for item in &mut plan.items {
        item.pieces = Pieces::Listed(Vec::new());
    }
    let has_layers = rules.iter().flatten().any(|rule| rule.layers != Mode::Never);
    let meets = (has_layers && layers::may_be_left_out(effects))
        .then(|| layers::meets(items, pieces, &plan.drawn()));
    for (i, (index, piece)) in pieces.iter().enumerate() {
        let (Some(rule), Pieces::Listed(runs)) = (&rules[*index], &mut plan.items[*index].pieces)
        else {
            continue;
        };
        let depth = rule.depth && overlaps.as_ref().is_none_or(|overlaps| overlaps[i]);
        let plan = PiecePlan { depth, ..plan_of(rule, scene, &items[*index], piece) };
        let is_met = meets.as_ref().is_none_or(|meets| meets[i]);
        let plan = PiecePlan { layers: plan.layers && depth && is_met, ..plan };
        match runs.last_mut() {
            Some((count, last)) if *last == plan => *count += 1,
            _ => runs.push((1, plan)),
        }
        plans.push(plan);
    }
    plans
}

/// The account of a plan, to read.
fn account(
    scene: &Scene,
    effects: &Effects,
    plan: &Plan,
    surveys: &[Survey<'_>],
    looked_at: Option<[usize; 2]>,
    (seen, is_tested): (Option<&Counters>, bool),
) -> Vec<Decision> {
    let (canvas, frame) = (&plan.drawn(), &plan.frame);
    let mut decisions = Vec::with_capacity(8 * surveys.len() + 5);
    for survey in surveys {
        decisions.push(cull::explain(survey));
        decisions.push(wide_words::explain(survey));
        decisions.push(perspective::explain(survey));
        decisions.push(depth::explain(survey, looked_at));
        decisions.extend(attributes::explain(survey));
        decisions.extend(specular::explain(survey));
        decisions.extend(shadows::explain(survey));
        decisions.extend(mip_maps::explain(survey));
        decisions.extend(anisotropy::explain(survey));
        decisions.extend(fog::explain(survey));
        decisions.extend(alpha_test::explain(survey));
        decisions.extend(blending::explain(survey));
        decisions.extend(layers::explain(survey));
        decisions.push(interpolation::explain(survey));
    }
    let triangles = scene.triangles() as u64;
    decisions.push(clip::explain(effects, plan, triangles, seen));
    decisions.push(depth_buffer::explain(scene, effects, canvas, frame, is_tested));
    decisions.push(samples::explain(
        &plan.canvas,
        effects,
        frame.samples,
        layers::is_in_use(scene, effects),
    ));
    decisions.push(clear::explain(effects, canvas, frame));
    decisions.push(second_buffer::explain(canvas, effects));
    decisions
}
