//! A scene to a plan: the rules of its items, a survey of its triangles, and what the conditions make of both.

use super::assembled::Assembled;
use super::conditions::account::Account;
use super::conditions::{self, clear, clip, depth, depth_buffer, layers, samples, second_buffer};
use super::plan::{
    Canvas, Clear, Decision, FramePlan, ItemPlan, Order, Parts, Pieces, Plan, Rule, VERSION,
};
use super::primitive::BadScene;
use super::survey::{Survey, WordBits};
use super::{Effect, Effects};
use crate::pipeline::Counters;
use crate::scene::{Hidden, Scene};

/// Plans a frame. What was assembled on the way is not assembled again.
pub(super) fn plan<'a>(
    scene: &'a Scene,
    canvas: &Canvas,
    effects: &Effects,
    word_bits: WordBits<'_>,
) -> Result<(Plan, Assembled<'a>), BadScene> {
    let (mut plan, rules) = outset(scene, canvas, effects);
    let survey = Survey::new(scene, effects, &plan, &rules, word_bits)?;
    let Survey { mut assembled, facts, overlapping, mut estimate, has_widths } = survey;

    let known = (facts.is_some(), has_widths);
    let mut accounts: Vec<Account<'_>> = (0..scene.items.len())
        .map(|i| Account::new(scene, effects, i, plan.items[i].carries, known))
        .collect();
    let mut is_tested = depth::pays(scene, effects, true);
    if let Some(facts) = facts {
        let mut plans = Vec::with_capacity(facts.len());
        let mut runs = vec![Vec::new(); scene.items.len()];
        for ((index, piece), facts) in assembled.pieces().iter().zip(&facts) {
            let plan = conditions::plan(&rules[*index], facts);
            match runs[*index].last_mut() {
                Some((count, last)) if *last == plan => *count += 1,
                _ => runs[*index].push((1, plan)),
            }
            accounts[*index].count(facts, plan);
            if let Some(estimate) = &mut estimate {
                estimate.see(&piece.corners(), plan);
            }
            plans.push(plan);
        }
        for (item, runs) in plan.items.iter_mut().zip(runs) {
            item.pieces = Pieces::Listed(runs);
        }
        is_tested = plans.iter().any(|plan| plan.depth);
        assembled.plan(plans, plan.frame.order);
    }

    let drawn = plan.drawn();
    let samples = samples::decide(canvas, effects, estimate.as_ref());
    plan.frame.samples = samples;
    let first = assembled.pieces.as_deref().map(|pieces| (pieces, &assembled.plans[..]));
    plan.frame.clear = clear::decide(effects, &drawn, samples, first);
    plan.frame.clear_depths = depth_buffer::clears(effects, is_tested, samples);

    let mut decisions = Vec::with_capacity(8 * accounts.len() + 5);
    for account in &accounts {
        conditions::explain(account, overlapping, &mut decisions);
    }
    let seen = assembled.pieces.as_ref().map(|_| &assembled.counters);
    decisions.extend(of_frame(scene, effects, &plan, seen, is_tested));
    plan.decisions = decisions;
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

/// What is known without looking at triangles, and the rule of each item.
fn outset(scene: &Scene, canvas: &Canvas, effects: &Effects) -> (Plan, Vec<Rule>) {
    let order = match scene.hidden {
        Hidden::Painter => Order::FarthestFirst,
        Hidden::DepthBuffer => Order::Submission,
    };
    let item = |item| {
        let (carries, rule) = conditions::rule(scene, item, effects);
        let (clip, cull) = (effects.mode(Effect::Clip), effects.mode(Effect::Cull));
        let parts = Parts::of(&rule, item, canvas.antialias);
        let pieces = Pieces::AsTheyCome(rule);
        (ItemPlan { clip, cull, carries, pieces, parts }, rule)
    };
    let (items, rules) = scene.items.iter().map(item).unzip();
    let plan = Plan {
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
        items,
        decisions: Vec::new(),
    };
    (plan, rules)
}

/// The account of effects that are decided for the whole frame.
fn of_frame(
    scene: &Scene,
    effects: &Effects,
    plan: &Plan,
    seen: Option<&Counters>,
    is_tested: bool,
) -> [Decision; 5] {
    let (canvas, frame) = (&plan.drawn(), &plan.frame);
    let has_layers = layers::is_in_use(scene, effects);
    [
        clip::explain(effects, plan, scene.triangles() as u64, seen),
        depth_buffer::explain(scene, effects, canvas, frame, is_tested),
        samples::explain(&plan.canvas, effects, frame.samples, has_layers),
        clear::explain(effects, canvas, frame),
        second_buffer::explain(canvas, effects),
    ]
}
