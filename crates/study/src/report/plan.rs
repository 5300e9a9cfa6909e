//! The account of a plan, and what it saves.

use rasterproof_precision::cost::CELLS;
use rasterproof_render::effects::Effect;
use rasterproof_render::effects::plan::{Decision, Plan, SceneDigest, Unit};
use rasterproof_render::effects::render::{Rendered, StagedPieces};
use rasterproof_render::pipeline::Counters;
use rasterproof_render::scene::Scene;
use rasterproof_report::html::{Chapter, Outcome, PictureLayer, PictureView, Report, Statement};
use rasterproof_report::json::value;
use rasterproof_report::picture;
use rasterproof_report::table::{Row, Table};
use rasterproof_report::words::{count, number, thousands};
use serde_json::Value;

use crate::savings::{Measured, Saving, Savings};

/// A decision that some items share, or one about the frame.
struct Line<'a> {
    effect: Effect,
    reason: &'a str,
    unit: Unit,
    counts: [u64; 3],
    items: Vec<usize>,
}

impl Line<'_> {
    /// Which items, in short: ranges, or their number where there are too many of them.
    fn items(&self) -> String {
        const MOST: usize = 9;
        let mut runs = Vec::new();
        for run in self.items.chunk_by(|a, b| a + 1 == *b) {
            runs.push(match run {
                [first, .., last] => format!("{first}-{last}"),
                _ => run[0].to_string(),
            });
        }
        // Items are counted where their ranges would not fit into a column.
        let text = runs.join(",");
        match text.len() {
            0 => "frame".to_owned(),
            1..=MOST => text,
            _ => format!("{} items", self.items.len()),
        }
    }

    /// Whether the same is said of other items: for the same reason, with the same counts that are not 0.
    fn is_like(&self, other: &Self) -> bool {
        (self.effect, self.reason, self.unit) == (other.effect, other.reason, other.unit)
            && self.counts.map(|count| count > 0) == other.counts.map(|count| count > 0)
    }
}

/// Decisions that several items share become one line, in the order of the pipeline: those with one
/// reason that are paid for by all, by none or by some.
fn grouped(decisions: &[Decision]) -> Vec<Line<'_>> {
    let mut lines: Vec<Line<'_>> = Vec::new();
    for Decision { effect, item, unit, on, off, open, reason } in decisions {
        let items = Vec::from_iter(*item);
        let new = Line { effect: *effect, reason, unit: *unit, counts: [*on, *off, *open], items };
        // What is said of the frame stays a line of its own.
        let known = lines.iter_mut().find(|line| item.is_some() && line.is_like(&new));
        let Some(line) = known else {
            lines.push(new);
            continue;
        };
        for (sum, count) in line.counts.iter_mut().zip(new.counts) {
            *sum += count;
        }
        line.items.extend(new.items);
    }
    // The sort is stable, so that lines of one effect stay in the order of their decisions.
    lines.sort_by_key(|line| line.effect);
    lines
}

/// How much of each effect is on, off, or decided while it is drawn, and why.
pub fn table(decisions: &[Decision]) -> Table {
    let mut rows = Vec::new();
    for line in grouped(decisions) {
        let ([on, off, open], unit) = (line.counts, format!(" {}", line.unit.name()));
        let (effect, items) = (line.effect.name(), line.items());
        rows.push(Row::of(&[&effect, &items, &on, &off, &open, &unit, &line.reason]));
    }
    let columns = "effect 13 | item 9 | >on 8 how many of the unit | >off 8 how many of the unit | >open 8 how many of the unit \
                   | ~unit 6 | reason";
    let note = "open: decided while it is drawn; several items: the sums of them";
    Table::new("Effects, in order", columns, rows).noted(vec![note.to_owned()])
}

/// Why an effect is paid for or not, a line for each reason.
pub fn reasons(decisions: &[Decision], effect: Effect) -> Vec<String> {
    let mut lines = Vec::new();
    for line in grouped(decisions).into_iter().filter(|line| line.effect == effect) {
        lines.push(match line.items().as_str() {
            "frame" => format!("of the frame: {}", line.reason),
            items => format!("of item {items}: {}", line.reason),
        });
    }
    lines
}

/// What becomes of the fragments of each piece, in order: a row for each list of stages, and the same as data.
pub fn stages(scene: &Scene, staged: &[StagedPieces]) -> Report {
    // Pieces of an item with the same stages are one row.
    let mut rows = Vec::new();
    for StagedPieces { item, pieces, stages } in staged {
        rows.push(Row::of(&[item, &thousands(*pieces), &stages.join(", ")]));
    }
    let notes = [
        "what is not in a list costs its pieces nothing; x multiplies and + adds to what is there",
        "squares of large pieces may have shorter lists",
    ];
    let columns = "item 5 | >pieces 9 | stages";
    let table = Table::new("Stages of each fragment, in order", columns, rows);
    Report {
        about: format!("{}: {}", scene.name, scene.about),
        tables: vec![table.noted(notes.map(str::to_owned).to_vec())],
        data: value(&Staged { scene: &scene.name, stages: staged }),
        ..Report::default()
    }
}

/// The stages for machines.
#[derive(serde::Serialize)]
struct Staged<'a> {
    scene: &'a str,
    stages: &'a [StagedPieces],
}

/// What planning the effects of a scene saves, with the frames that were drawn to find it.
pub struct Measurement<'a> {
    pub scene: &'a Scene,
    /// `model` where the scene was read from a file, else `scene`.
    pub kind: &'a str,
    /// Drawn with everything, and planned.
    pub frames: [&'a Rendered; 2],
    pub savings: &'a Savings,
    /// What it takes to look for the reason of depth.
    pub survey_us: Option<f64>,
    /// Whether the whole alone was measured, and no single effect.
    pub is_whole: bool,
}

impl Measurement<'_> {
    /// Whether no mixture of effects changed the picture.
    pub fn is_same(&self) -> bool {
        self.savings.different().next().is_none()
    }

    /// What the measurement comes to, on the screen and in the data.
    fn outcome(&self) -> Outcome {
        // Two empty frames are the same whatever the plan does, so that says nothing.
        let same = self.is_same();
        if same && self.frames[0].is_blank() {
            return Outcome::nothing_drawn();
        }
        let sentence = match same {
            true => "Planned, it was drawn with the same bits.",
            false => "A plan changed the picture.",
        };
        Outcome::of(same, sentence)
    }

    /// What is called for, and what the rest costs, a sentence or two each.
    fn answers(&self) -> Vec<Statement> {
        // An effect is paid for where it is on for anything, or decided while it is drawn.
        let mut paid = std::collections::BTreeSet::new();
        for decision in &self.frames[1].plan.decisions {
            if decision.on + decision.open > 0 {
                paid.insert(decision.effect);
            }
        }
        // The first sentence is about the plan, the second about what would change without it.
        let (paid, all) = (paid.len(), Effect::ALL.len());
        let mut sentence =
            format!("{paid} of {all} effects are paid for in this view, as planned.");
        let of_each = &self.savings.effects;
        if !of_each.is_empty() {
            let called = of_each.iter().filter(|saving| saving.wrong_without > 0).count();
            let are = count(called as u64, "is called for", "are called for");
            sentence += &format!(" Of all, {are}: without it pixels change.");
        }
        // Both ratios are those of the same rounds.
        let [everything, usual] = self.savings.times.map(|ratio| ratio.words("fast"));
        let time = if self.frames[0].counters.fragments == 0 {
            "No triangle covers a pixel, so times say nothing of effects.".to_owned()
        } else {
            format!(
                "The planned frame against everything on: {everything}. Against the usual way: {usual}."
            )
        };
        // Neither has a command of its own.
        vec![
            Statement { about: "effects", sentence, command: String::new() },
            Statement { about: "time", sentence: time, command: String::new() },
        ]
    }

    /// The tables of the plan, and the frames as layers where there is a page.
    pub fn report(&self, command: String, is_page: bool) -> Report {
        let Self { scene, kind, frames, savings, survey_us, is_whole } = *self;
        // From what was decided to what it saves: decisions, counted work, single effects, the whole.
        let mut tables = vec![table(&frames[1].plan.decisions), counts(frames)];
        tables.extend((!savings.effects.is_empty()).then(|| of_each(savings)));
        tables.push(whole(savings, survey_us, is_whole));
        let view = is_page.then(|| view(command.clone(), scene, frames));
        Report {
            title: format!("What the {kind} {} calls for", scene.name),
            about: format!("{}: {}", scene.name, scene.about),
            outcome: Some(self.outcome()),
            answers: self.answers(),
            command,
            tables,
            frames: Vec::from_iter(view),
            ..Report::default()
        }
    }

    /// The data of the report, with a plan that holds its scene, so that `render --plan` can draw by it.
    pub fn data(&self) -> Value {
        let Self { scene, frames: [everything, planned], savings, survey_us, .. } = *self;
        // A plan for `render --plan` names its scene, so that it is not followed for another one.
        let is_compared = !everything.is_blank() || !self.is_same();
        let Outcome { word, sentence, .. } = self.outcome();
        value(&Data {
            scene: &scene.name,
            plan: Plan { scene: Some(SceneDigest::of(scene)), ..planned.plan.clone() },
            everything: &everything.counters,
            planned: &planned.counters,
            measured: savings,
            survey_us,
            same: is_compared.then(|| self.is_same()),
            answers: self.answers(),
            outcome: word,
            sentence,
        })
    }
}

/// The measurement for machines.
#[derive(serde::Serialize)]
struct Data<'a> {
    scene: &'a str,
    plan: Plan,
    everything: &'a Counters,
    planned: &'a Counters,
    measured: &'a Savings,
    survey_us: Option<f64>,
    /// Nothing where no fragment was drawn, so that two backgrounds would be compared.
    same: Option<bool>,
    answers: Vec<Statement>,
    /// The last words of the text, and what follows them.
    outcome: String,
    sentence: String,
}

/// A row for each effect: what planning it saves, alone and as the last one.
fn of_each(savings: &Savings) -> Table {
    let mut rows = Vec::new();
    for Saving { effect, alone, last, wrong_without } in &savings.effects {
        // Work that is not done is told beside the time, which may be too short to be told apart.
        let works = [thousands(alone.work), thousands(last.work)];
        let (name, wrong) = (effect.name(), thousands(*wrong_without));
        rows.push(Row::of(&[&name, &works[0], &alone.words(), &works[1], &last.words(), &wrong]));
    }
    let caption = "What planning one effect saves: alone, the rest always paid for; as the last, the rest planned";
    let columns = "planned 14 | >alone 10 how much less of its work is done, by its counter | >saves 17 of the time of the frame \
                       that pays for everything | >last 10 the same of the planned frame | >saves 17 of the time of the frame \
                       that pays for it and plans the rest | >wrong without 14 pixels that change when it is left out everywhere";
    let notes = [
        "alone, last: how much less of its work is done, by its counter; no work: there is nothing to save, and no time is compared",
        "saves: the median over the rounds and its interval; ?: cannot be told here",
        "wrong without: pixels that change when it is left out everywhere; --without EFFECT draws them",
    ];
    Table::new(caption, columns, rows).noted(notes.map(str::to_owned).to_vec())
}

/// The times of everything, usual and planned, and the mixtures that changed the picture.
fn whole(savings: &Savings, survey_us: Option<f64>, is_whole: bool) -> Table {
    let [everything, usual] = savings.times.map(|ratio| ratio.to_string());
    let rows = vec![
        row_of_frame("everything", &savings.everything, &everything),
        row_of_frame("usual", &savings.usual, &usual),
        row_of_frame("planned", &savings.planned, "-"),
    ];
    // First what would be a fault, then what the numbers are, then what was not measured.
    let mut notes = Vec::new();
    for name in savings.different() {
        notes.push(format!("DIFFERENT PICTURE with the effects {name}"));
    }
    notes.push(
        "usual: what a renderer does without a planner (cuts what crosses, culls, one depth test)"
            .to_owned(),
    );
    notes.push(format!("times: {CELLS}"));
    if let Some(noise) = &savings.noise {
        let (rounds, noise) = (savings.planned.rounds, number(noise.median, 9));
        notes.push(format!(
            "two equal frames in the same {rounds} rounds: {noise} times, by which intervals are widened"
        ));
    }
    if savings.effects.is_empty() && !is_whole {
        notes.push(
            "one effect at a time is not measured, since a round of all mixtures takes too long \
             here: --rounds 9 measures them"
                .to_owned(),
        );
    }
    if let Some(us) = survey_us {
        // Each planned frame pays for the look, so it is told as a share of one.
        let share = 100.0 * us / savings.planned.time_us;
        notes.push(format!(
            "looking at triangles for the reason of depth: {us:.0} us, {share:.1}% of the planned frame"
        ));
    }
    let columns = "paid for 14 | >us 10 of processor time, median of the rounds | >quartiles 14 a quarter of the rounds took less, \
                   a quarter more | >times planned 18 how many times as long as the planned frame";
    Table::new("The frame as a whole", columns, rows).noted(notes)
}

/// A whole frame: its time, and how many times as long it took as the planned one.
fn row_of_frame(name: &str, frame: &Measured, ratio: &str) -> Row {
    let [low, high] = frame.quartiles_us;
    Row::of(&[&name, &format!("{:.0}", frame.time_us), &format!("{low:.0}-{high:.0}"), &ratio])
}

/// What both frames counted, side by side.
fn counts([everything, planned]: [&Rendered; 2]) -> Table {
    // Both have the same counters in the same order.
    let mut rows = Vec::new();
    for ((name, all), (_, planned)) in
        everything.counters.shown().into_iter().zip(planned.counters.shown())
    {
        rows.push(Row::of(&[&name, &thousands(all), &thousands(planned)]));
    }
    Table::new("What was counted", "~counts 20 | >everything 12 | >planned 12", rows)
}

/// Both frames as layers, which have the same bits unless a plan is wrong.
fn view(command: String, scene: &Scene, frames: [&Rendered; 2]) -> PictureView {
    let [everything, planned] = frames.map(|frame| picture::of_frame(&frame.picture));
    PictureView {
        name: scene.name.clone(),
        about: scene.about.clone(),
        command,
        chapter: Chapter { title: "effects", path: "effects.md" },
        layers: vec![
            PictureLayer::new("everything", &everything),
            PictureLayer::new("planned", &planned),
        ],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn decision(item: usize, [on, off]: [u64; 2]) -> Decision {
        let (effect, unit, reason) = (Effect::Depth, Unit::Pieces, "asked for".to_owned());
        Decision { effect, item: Some(item), unit, on, off, open: 0, reason }
    }

    #[test]
    fn unlike_items_are_not_merged() {
        let decisions =
            [decision(0, [2, 0]), decision(1, [0, 5]), decision(2, [3, 0]), decision(3, [1, 1])];
        let lines: Vec<_> = grouped(&decisions).iter().map(|l| (l.items(), l.counts)).collect();
        let expected = [("0,2", [5, 0, 0]), ("1", [0, 5, 0]), ("3", [1, 1, 0])];
        assert_eq!(lines, expected.map(|(items, counts)| (items.to_owned(), counts)));
    }

    #[test]
    fn items_are_ranges_or_a_number() {
        let items = |items: &[usize]| {
            let decisions: Vec<_> = items.iter().map(|item| decision(*item, [1, 0])).collect();
            grouped(&decisions)[0].items()
        };
        assert_eq!(items(&[0, 1, 2, 5]), "0-2,5");
        assert_eq!(items(&[4]), "4");
        assert_eq!(items(&[0, 2, 4, 6, 8, 10]), "6 items");
    }
}
