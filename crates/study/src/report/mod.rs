//! A study of a model as a report, and the boards of `cost`.

pub mod around;
pub mod board;
pub mod cost_plots;
pub mod drawing;
pub mod engines;
pub mod json;
pub mod plan;
pub mod studied;

use std::fmt::Write as _;

use crate::effects::{Adds, Need, Needs, State};
use crate::grid::GridPrice;
use crate::hard::{HardCases, Kind};
use crate::shift::Shifted;
use crate::ties::{Class, Classes, TiedPair};
use crate::{face_of, triangle_of};
use image::{Rgb, RgbImage};
use rasterproof_host::text::printable_short;
use rasterproof_models::Origin;
use rasterproof_precision::cost::{
    Board, CELLS, Cell, Cheapest, JudgedChoice, Ladder, Part, Ratio, RatioKind, Spread, Time,
    Times, fastest,
};
use rasterproof_render::scene::Scene;

use rasterproof_report::canvas;
use rasterproof_report::chapter::Chapter;
use rasterproof_report::html::{
    Figure, PictureLayer, PictureView, PicturedAnswer, Report, Statement,
};
use rasterproof_report::picture;
use rasterproof_report::table::{self, Column, Row, Table};
use rasterproof_report::words::{self, count, number, thousands};

/// A scene, and how its triangles are named to a reader.
#[derive(Clone, Copy)]
pub struct Places<'a> {
    /// Triangles are numbered through all items of it, in drawing order.
    pub scene: &'a Scene,
    pub origins: &'a [Origin],
    /// The command that shows a face, by its number from 1.
    pub inspect: &'a dyn Fn(u32) -> String,
}

impl Places<'_> {
    /// Where a triangle is, in words.
    pub fn place(&self, triangle: u32) -> String {
        let place = triangle_of(self.scene, triangle)
            .and_then(|(item, number)| Some(self.origins.get(item)?.place(number)));
        place.unwrap_or_else(|| format!("triangle {}", u64::from(triangle) + 1))
    }

    /// The command that shows the face of a triangle.
    pub fn command(&self, triangle: u32) -> String {
        (self.inspect)(face_of(self.scene, self.origins, triangle))
    }

    /// The face of a triangle by its number, where its place would be too long.
    fn face(&self, triangle: u32) -> String {
        format!("face {}", face_of(self.scene, self.origins, triangle))
    }
}

/// By group the choices that get triangles of a kind wrong, with how many samples.
fn wrong_on(found: &HardCases, kind: Kind, costs: &[Board]) -> Vec<String> {
    let mut lines = Vec::new();
    for board in costs {
        let mut wrong = Vec::new();
        for choice in board.ran(0) {
            // Wrong samples are counted for pairs of triangles, either of which may be of the kind.
            let mut count = 0;
            for ([a, b], samples) in &choice.run.found.wrong {
                if found.is(*a, kind) || found.is(*b, kind) {
                    count += samples;
                }
            }
            if count > 0 {
                wrong.push(format!("{} {}", choice.name(), thousands(count)));
            }
        }
        // A group in which no choice is wrong on them has no line.
        if !wrong.is_empty() {
            let title = board.ladder.title();
            lines.push(format!("{title} ({}): {}", unit(board), wrong.join(", ")));
        }
    }
    lines
}

/// What the errors of a board count.
fn unit(board: &Board) -> &'static str {
    board.measures.iter().find_map(|measure| measure.unit).unwrap_or("px")
}

/// In how many pixels of hard cases values were compared; nothing where in all of them.
fn compared_in(costs: &[Board]) -> Option<String> {
    let looked_at = costs.iter().find_map(|board| board.columns[0].sampling?.looked_at)?;
    (!looked_at.is_all()).then(|| {
        let [some, all] = [looked_at.part, looked_at.of].map(thousands);
        format!("values were compared in {some} of the {all} px of these faces")
    })
}

/// What is said of all hard cases together, a line each.
fn about_hard_cases(subject: &Places<'_>, found: &HardCases, costs: &[Board]) -> Vec<String> {
    let mut lines: Vec<String> = compared_in(costs).into_iter().collect();
    // Kinds that do not occur are named, so that a reader knows that they were looked for.
    let missing = Kind::ALL.into_iter().filter(|kind| found.of(*kind).is_none());
    let missing: Vec<&str> = missing.map(Kind::name).collect();
    if !missing.is_empty() && !found.cases.is_empty() {
        lines.push(format!("none: {}", missing.join(", ")));
    }
    if found.is_cut_short {
        let why =
            "the model is so large that overlaps and T-junctions were looked for in a part of it";
        lines.push(why.to_owned());
    }
    // The farther both are apart, the less digits single precision has for 1/w.
    if let Some([near, far]) = found.w {
        let [near, far] = [near, far].map(|w| number(w, 9));
        lines.push(format!("w, the distance from the eye, in the window: {near} to {far}"));
    }
    // The largest change of each value, with the place at which it is seen.
    let shift = &found.shift;
    let mut values = Vec::new();
    for (what, largest, unit) in [
        ("a depth", shift.depth, ""),
        ("texture coordinates", shift.texels, " texels"),
        ("a colour of corners", shift.colour, " of 255"),
        ("a normal", shift.normal, " degrees"),
    ] {
        if let Some(Shifted { by, pixel: [x, y], triangle }) = largest {
            let face = subject.face(triangle);
            values.push(format!("{what} by {by:.1e}{unit} at {x},{y} on {face}"));
        }
    }
    if !values.is_empty() {
        lines.push(format!(
            "the most that snapped corners change of what is seen: {}",
            values.join("; ")
        ));
    }
    if found.f32_pixels > 0 {
        let pixels = thousands(found.f32_pixels);
        lines.push(format!("positions rounded to f32 change {pixels} px of the picture"));
    }
    lines
}

/// Nanoseconds as milliseconds.
fn ms(ns: f64) -> String {
    number(ns / 1e6, 9)
}

/// The three questions of a study, each answered in a sentence or two, and the commands that say more.
fn answers(
    subject: &Places<'_>,
    found: &StudyFindings<'_>,
    commands: [String; 3],
) -> Vec<Statement> {
    // Depth buffers are told with the hard cases, since rounding decides in both.
    let stability = stability(subject, found.hard) + &z_fighting(found.costs);
    let [of_accuracy, of_hard_cases, of_effects] = commands;
    let accuracy = accuracy(found.costs).concat();
    vec![
        Statement { about: "accuracy", sentence: accuracy, command: of_accuracy },
        Statement { about: "hard cases", sentence: stability, command: of_hard_cases },
        Statement { about: "effects", sentence: effects(found), command: of_effects },
    ]
}

/// The names of choices of one group.
fn names<'a>(choices: &[JudgedChoice<'a>]) -> Vec<&'a str> {
    choices.iter().map(JudgedChoice::name).collect()
}

/// A choice with its group.
fn full_name(choice: &JudgedChoice<'_>) -> String {
    format!("{} by {}", choice.name(), choice.board.ladder.title().trim_start_matches(COVERAGE))
}

/// How many pixels are wrong, against corners as given or snapped, whatever is better.
fn wrong(choice: &JudgedChoice<'_>) -> f64 {
    choice.run.errors.iter().flatten().copied().fold(f64::MAX, f64::min)
}

/// How many are wrong by the first measure: of coverage, against the corners as given.
fn wrong_first(choice: &JudgedChoice<'_>) -> u64 {
    choice.error(0).unwrap_or(0.0) as u64
}

/// How many times as long a choice takes as another one; once where either was not timed.
fn over(choice: &JudgedChoice<'_>, other: &JudgedChoice<'_>) -> Ratio {
    choice.over(other).unwrap_or(Ratio::ONE)
}

/// The boards of coverage, both of which do the same job.
fn coverage(boards: &[Board]) -> impl Iterator<Item = &Board> {
    boards.iter().filter(|board| board.ladder.is_coverage())
}

/// What exact coverage costs, above its picture; nothing where nothing was timed.
pub fn pictured(boards: &[Board]) -> Option<PicturedAnswer> {
    // The same plot for each width of a page.
    let drawn = cost_plots::WIDTHS.map(|width| cost_plots::coverage_of_model(boards, width));
    let figure = canvas::figure(
        "Each choice of coverage on the triangles of this view: wrong pixels against time",
        drawn,
    );
    let [sentence, _] = accuracy(boards);
    coverage(boards).any(|board| board.rounds > 0).then_some(PicturedAnswer { sentence, figure })
}

/// Whether a model has no pixel on which a board could judge anything.
fn is_without_pixels(board: &Board) -> bool {
    matches!(board.columns[0].sampling, Some(sampling) if sampling.pixels.of == 0)
}

/// Whether a choice is exact by promise: so for every model, and not by chance.
fn is_certain(choice: &JudgedChoice<'_>) -> bool {
    !choice.choice().promises.is_empty() && wrong(choice) == 0.0
}

/// What exact coverage costs, in a sentence; and what is wrong.
fn accuracy(boards: &[Board]) -> [String; 2] {
    if coverage(boards).all(is_without_pixels) {
        let none = "No pixel is covered in this view, so nothing was compared.".to_owned();
        return [none, String::new()];
    }
    let all: Vec<JudgedChoice<'_>> = coverage(boards).flat_map(|board| board.ran(0)).collect();
    let certain = fastest(all.iter().copied().filter(is_certain));
    let (Some(cheapest), Some(certain)) = (fastest(all.iter().copied()), certain) else {
        let none = "No choice of coverage that is exact for every model takes these triangles.";
        return [none.to_owned(), String::new()];
    };
    // The sentence names the cheapest of those that are exact by promise, against the cheapest of all.
    let unit = unit(cheapest.board);
    let is_snapped = certain.promises(1);
    let snapped = if is_snapped { " once its corners are snapped" } else { "" };
    let name = full_name(&certain);
    let ratio = over(&certain, &cheapest);
    let sentence = if ratio.said() == RatioKind::NoDifference {
        format!(
            "Exact coverage costs nothing here: no choice is cheaper than {name}, exact for every model{snapped}."
        )
    } else {
        let is = match wrong(&cheapest) {
            0.0 => "happens to be exact here".to_owned(),
            wrong => format!("is wrong in {} {unit}", thousands(wrong as u64)),
        };
        format!(
            "Exact coverage by {name}, exact for every model{snapped}, against the cheapest choice, {}, which {is}: {}.",
            full_name(&cheapest),
            ratio.words(LONG)
        )
    };
    let mut others = String::new();
    // Where snapping changes pixels, what it takes to be exact for the corners as given.
    let as_given = fastest(all.iter().copied().filter(|one| one.promises(0)));
    if let Some(as_given) = as_given.filter(|_| is_snapped && wrong_first(&certain) > 0) {
        let differ =
            count(wrong_first(&certain), &format!("{unit} differs"), &format!("{unit} differ"));
        let words = over(&as_given, &cheapest).words(LONG);
        let _ = write!(
            others,
            " {differ} from the corners as given; exact for those is {}: {words}.",
            full_name(&as_given)
        );
    }
    others += &who_is_wrong(&all, unit);
    [sentence, others]
}

/// How many choices are wrong, and the worst of them.
fn who_is_wrong(all: &[JudgedChoice<'_>], unit: &str) -> String {
    // A choice that no measure finds wrong is none of them.
    let (mut number, mut worst) = (0, None);
    for choice in all {
        number += u64::from(wrong(choice) > 0.0);
        // The last of equal ones.
        if wrong(choice) > 0.0 && worst.is_none_or(|worst| wrong(choice) >= wrong(worst)) {
            worst = Some(choice);
        }
    }
    let Some(worst) = worst else { return format!(" All {} choices are right here.", all.len()) };
    let (of, name) = (all.len(), full_name(worst));
    let are_wrong = match number {
        1 => format!("is wrong here: {name}"),
        _ => format!("are wrong here, most of all {name}"),
    };
    let pixels = thousands(wrong(worst) as u64);
    format!(" {} of {of} choices {are_wrong}, in {pixels} {unit}.", thousands(number))
}

/// The word that ratios of times are told with: so many times as long, and not as fast.
const LONG: &str = "long";

/// Which depth buffers show another surface than exact depths do; nothing where none does.
fn z_fighting(boards: &[Board]) -> String {
    let Some(board) = boards.iter().find(|board| board.ladder == Ladder::Depth) else {
        return String::new();
    };
    // Each format that errs, with its number of pixels.
    let mut wrong = Vec::new();
    for choice in board.ran(0) {
        if wrong_first(&choice) > 0 {
            wrong.push(format!("{} in {}", choice.name(), thousands(wrong_first(&choice))));
        }
    }
    if wrong.is_empty() {
        return String::new();
    }
    format!(" Depth buffers that show another surface: {} {}.", wrong.join(", "), unit(board))
}

/// What the titles of both groups of coverage begin with, which is left out where both are named.
const COVERAGE: &str = "Coverage by ";

/// What rounding decides in this view, and which hard cases are seen besides.
fn stability(subject: &Places<'_>, found: &HardCases) -> String {
    let classes = &found.classes;
    // First what rounding decides, with the first such pixel.
    let mut sentence = match classes.first {
        Some(TiedPair { pixel: [x, y], triangles }) => {
            let [a, b] = triangles.map(|one| subject.face(one));
            let pixels = count(classes.by_rounding, "px is", "px are");
            format!(
                "{pixels} decided by rounding alone, the first at {x},{y}, between {a} and {b}."
            )
        }
        None => "No pixel is decided by rounding alone.".to_owned(),
    };
    // Then the kind that is seen in the most pixels of all others.
    let others: Vec<_> = found.in_view().filter(|case| case.kind != Kind::Rounding).collect();
    if let Some(most) = others.iter().max_by_key(|case| case.pixels) {
        let are_seen = match others.len() {
            1 => "One other kind of hard case is seen in this view:".to_owned(),
            kinds => {
                format!("{kinds} other kinds of hard cases are seen in this view, most of all")
            }
        };
        let (name, pixels) = (most.kind.name(), thousands(most.pixels));
        let _ = write!(sentence, " {are_seen} {name}, in {pixels} px.");
    } else {
        sentence += " No other hard case is seen in this view.";
    }
    // A kind that is only in the mesh may be seen from another side.
    let hidden = found.cases.len() - found.in_view().count();
    if hidden > 0 {
        let kinds = count(hidden as u64, "kind is", "kinds are");
        let _ = write!(sentence, " {kinds} only in the mesh: culled, hidden or outside here.");
    }
    sentence
}

/// What the view calls for, and what it costs to pay for everything.
fn effects(found: &StudyFindings<'_>) -> String {
    let all = &found.needs.needs;
    // How many are needed, and the one that would be missed most.
    let called: Vec<_> = all.iter().filter(|need| need.state() == State::CalledFor).collect();
    let mut sentence = format!("{} of {} effects are called for.", called.len(), all.len());
    let of_pixels = called.iter().filter(|need| need.pixels.is_some());
    if let Some(most) = of_pixels.max_by_key(|need| need.wrong) {
        let (name, wrong) = (most.effect.name(), thousands(most.wrong));
        let _ = write!(sentence, " Without {name}, {wrong} px are wrong.");
    }
    // Whole frames are compared where the costs were measured.
    if let Some(frames) = found.costs.iter().find(|board| board.ladder == Ladder::Frames)
        && let Some(every) = frames.ran(0).find(|one| one.name() == "scanline all")
        && let Some(planned) = frames.ran(0).find(|one| one.name() == "scanline planned")
        && let Some(ratio) = every.over(&planned)
    {
        let _ = write!(
            sentence,
            " Paying for all {}, against what the plan pays for: {}.",
            all.len(),
            ratio.words(LONG)
        );
    }
    sentence
}

/// Rows of a table of cases or effects on a first screen, which has 40.
const MOST_ROWS: usize = 3;

/// The first rows of a table, with a note of how many there are more.
fn first_rows(columns: &str, mut rows: Vec<Row>) -> Table {
    // How many are left out is told, so that nobody takes the first ones for all.
    let left_out = rows.len().saturating_sub(MOST_ROWS);
    rows.truncate(MOST_ROWS);
    let more = (left_out > 0).then(|| format!("and {left_out} more"));
    Table::new("", columns, rows).noted(Vec::from_iter(more))
}

/// What is seen, what is called for, and the cheapest exact choices: a table for each question.
fn first_screen(subject: &Places<'_>, found: &StudyFindings<'_>) -> Vec<Table> {
    vec![seen_first(subject, found.hard), called_first(found.needs), exact_first(found.costs)]
}

/// The hard cases with the most pixels.
fn seen_first(subject: &Places<'_>, hard: &HardCases) -> Table {
    // The sort is stable: kinds with as many pixels stay in the order of the kinds.
    let mut seen: Vec<_> = hard.in_view().collect();
    seen.sort_by_key(|case| std::cmp::Reverse(case.pixels));
    let (mut rows, mut broken) = (Vec::new(), Vec::new());
    for case in seen {
        let first = case.triangles.first();
        let face = first.map_or(String::new(), |one| subject.face(*one));
        let [number, pixels] = [case.in_view, case.pixels].map(thousands);
        rows.push(Row::of(&[&case.kind.name(), &number, &pixels, &face]));
        // These are few pixels mostly, and in none of the rows then; what mends them is said here.
        if [Kind::Crack, Kind::Fold].contains(&case.kind) {
            broken.push(format!("{}: {}; {}", case.kind.name(), case.note, case.kind.about()));
            broken.extend(first.map(|one| subject.command(*one)));
        }
    }
    let columns = "hard cases in this view 32 | >number 11 | >px 11 | first or worst 14";
    let mut table = first_rows(columns, rows);
    // What this view does not show may be seen from another side.
    // A case counts as hidden where nothing of it is seen here.
    let mut hidden = Vec::new();
    for case in &hard.cases {
        if case.in_view == 0 {
            hidden.push(format!("{} {}", thousands(case.count), case.kind.name()));
        }
    }
    if !hidden.is_empty() {
        table.notes.push(format!("only in the mesh: {}", hidden.join(", ")));
    }
    table.notes.extend(broken);
    table
}

/// The effects without which the most pixels are wrong.
fn called_first(needs: &Needs) -> Table {
    let (mut called, mut safe) = (Vec::new(), Vec::new());
    for need in &needs.needs {
        match need.state() {
            State::CalledFor => called.push(need),
            State::ToBeSafe => safe.push(need.effect.name()),
            _ => {}
        }
    }
    called.sort_by_key(|need| std::cmp::Reverse(need.wrong));
    let mut rows = Vec::new();
    for need in called {
        let (name, wrong) = (need.effect.name(), thousands(need.wrong));
        rows.push(Row::of(&[&name, &wrong, &takes(needs, need)]));
    }
    let columns = "effects called for 24 | >px wrong without 16 | takes of the planned frame 32";
    let mut table = first_rows(columns, rows);
    if !safe.is_empty() {
        let about = "paid for to be safe, though no pixel changes here";
        table.notes.push(format!("{about}: {}", safe.join(", ")));
    }
    table
}

/// The cheapest exact choice of each job.
fn exact_first(costs: &[Board]) -> Table {
    let mut rows = Vec::new();
    // Both groups of coverage do one job, which each of their measures judges in its own way.
    let both: Vec<&Board> = coverage(costs).collect();
    if let Some(first) = both.first() {
        for (number, measure) in first.measures.iter().enumerate() {
            rows.push(cheapest_row(&both, number, &format!("Coverage, {}", measure.short)));
        }
    }
    for board in costs {
        if !board.ladder.is_coverage() {
            rows.push(cheapest_row(&[board], 0, board.ladder.title()));
        }
    }
    let columns =
        "what exactness costs 27 | cheapest exact 27 | >ms 7 | times 14 the cheapest of all";
    let note = "same: no difference; 2-12?: cannot be told; +2: two as fast; more: --all";
    Table::new("", columns, rows).noted(vec![note.to_owned()])
}

/// The cheapest choice that a measure calls exact of groups that do the same job, and what it takes.
fn cheapest_row(boards: &[&Board], measure: usize, title: &str) -> Row {
    // All exact choices of all boards compete; without times there is no cheapest one.
    // Times of both groups are comparable: they were measured in the same rounds.
    let exact: Vec<_> = boards.iter().flat_map(|board| board.exact(0, measure)).collect();
    let best = Cheapest::of(&exact).and_then(|best| Some((best.choice.times()?, best)));
    let Some((times, Cheapest { choice: best, equal, undecided })) = best else {
        let is_compared = boards
            .iter()
            .any(|board| board.columns[0].sampling.is_some_and(|of| of.judged.part > 0));
        let none = if is_compared { "none" } else { "no pixel was compared" };
        return Row::of(&[&title, &none, &"-", &"-"]);
    };
    // Choices that cannot be told from the best one by their times are counted behind its name.
    let rivals = equal.len() + undecided.len();
    let mut name = best.name().to_owned();
    if boards.len() > 1 {
        let kind = best.board.ladder.title().trim_start_matches(COVERAGE).split(' ').next();
        name = format!("{} {name}", kind.unwrap_or_default());
    }
    if rivals > 0 {
        let _ = write!(name, " +{rivals}");
    }
    let over = best.run.time.as_ref().map_or("-".to_owned(), |time| time.times.to_string());
    Row::of(&[&title, &name, &ms(times.median()), &over])
}

/// The cheapest exact choice of a group, and what is said of those that are cheaper and wrong, or exact by chance.
pub fn advice(subject: &Places<'_>, board: &Board) -> Vec<String> {
    let Some(sampling) = board.columns[0].sampling else { return Vec::new() };
    // First the choice to make, by each measure of the error.
    let mut lines = Vec::new();
    for (number, measure) in board.measures.iter().enumerate() {
        match board.compared(0, number) {
            Some(best) => lines.extend(compared(&best, number)),
            None if sampling.judged.part == 0 => {
                lines.push("no pixel was compared, so nothing is called exact".to_owned());
            }
            None => lines.push(format!("none is exact ({})", measure.short)),
        }
    }
    // What is faster than this is cheaper than being exact by any measure.
    let measures = 0..board.measures.len();
    let limit = fastest(measures.clone().filter_map(|one| board.cheapest_exact(0, one)));
    if !sampling.judged.is_all() && sampling.judged.part > 0 {
        let [part, of] = [sampling.judged.part, sampling.judged.of].map(thousands);
        lines.push(format!("exact and wrong are of a sample: {part} of {of} px were compared"));
    }
    // Then choices that tempt: those that are exact here and might not be, and those that are cheaper and wrong.
    for choice in board.ran(0) {
        let ratio = limit.and_then(|limit| choice.over(&limit));
        let is_cheaper =
            ratio.is_some_and(|ratio| ratio.said() == RatioKind::Holds && ratio.high < 1.0);
        // Wrong is what misses the goal of every measure.
        let mut is_wrong = true;
        for (number, measure) in board.measures.iter().enumerate() {
            let goal = measure.goal.unwrap_or(f64::INFINITY);
            is_wrong &= choice.error(number).is_some_and(|error| error > goal);
        }
        match (choice.run.found.margin, choice.run.found.first) {
            (Some(margin), _) if !is_wrong => {
                let luck = if margin < 1.0 { ": it might have been wrong" } else { "" };
                lines.push(format!(
                    "{} is exact here; the nearest decision is {} times its error bound away from 0{luck}",
                    choice.name(),
                    number(margin, 9)
                ));
            }
            (margin, Some((triangle, [x, y]))) if is_wrong && (is_cheaper || margin.is_some()) => {
                let cheaper = if is_cheaper { "cheaper and " } else { "" };
                let place = triangle.map(|one| format!(": {}", subject.place(one)));
                let place = place.unwrap_or_default();
                lines.push(format!("{} is {cheaper}wrong, first at {x},{y}{place}", choice.name()));
                lines.extend(triangle.map(|one| subject.command(one)));
            }
            _ => {}
        }
    }
    if sampling.not_judged > 0 {
        let pieces = count(sampling.not_judged, "piece", "pieces");
        let why = "single precision does not hold a value or 1/w of a corner";
        lines.push(format!("not judged: {pieces}, since {why}"));
    }
    lines
}

/// The cheapest exact choice, or that there is no difference between those that are exact.
fn compared(best: &Cheapest<'_>, measure: usize) -> Vec<String> {
    let Cheapest { choice, equal, undecided } = best;
    let board = choice.board;
    let short = &board.measures[measure].short;
    // If all exact choices take the same time, none of them is the cheapest.
    let timed = board.exact(0, measure).filter(|one| one.times().is_some());
    if !equal.is_empty() && timed.count() == equal.len() + 1 {
        let all = names(&[&[*choice], &equal[..]].concat()).join(", ");
        return vec![format!("no difference between the exact choices ({short}): {all}")];
    }
    // Others may be as fast, or cannot be told from it after these rounds.
    let mut lines = vec![format!("cheapest exact ({short}): {}", choice.name())];
    if !equal.is_empty() {
        lines.push(format!("no difference: {}", names(equal).join(", ")));
    }
    if !undecided.is_empty() {
        let (rounds, others) =
            (choice.times().map_or(0, Times::rounds), names(undecided).join(", "));
        lines.push(format!("undecided after {rounds} rounds, as fast or not: {others}"));
    }
    lines
}

/// How it is decided which surface is seen, in a sentence or two.
fn ties(subject: &Places<'_>, classes: &Classes) -> String {
    // Every pixel belongs to one class; those of equal depths are among those by rounding.
    let [decided, by_rounding, equal, by_order] =
        [classes.decided, classes.by_rounding, classes.equal, classes.by_order].map(thousands);
    let mut out = format!(
        "which surface is seen, before corners are snapped (see docs/ties.md): decided in {decided} px; by \
         rounding alone in {by_rounding} px, in {equal} of them between equal depths; by the order of faces that \
         are drawn twice in {by_order} px"
    );
    if let Some(TiedPair { pixel: [x, y], triangles }) = classes.first {
        let [a, b] = triangles.map(|triangle| subject.place(triangle));
        let _ = write!(out, "; by rounding first at {x},{y}: {a} and {b}");
    }
    out
}

/// What an effect takes of a planned frame: milliseconds and the share, where it is paid for.
fn takes(needs: &Needs, need: &Need) -> String {
    match need.adds(&needs.planned) {
        Adds::NoWork => "no work".to_owned(),
        // The time that is saved is not its own then.
        Adds::DrawsLess => "less is drawn without it".to_owned(),
        // Of what is not paid for, the time that it would add is measured all the same.
        Adds::Times(_) if !need.is_paid_for => match need.adds_ms(&needs.planned) {
            Some(ms) => format!("would add {} ms", number(ms, 9)),
            None => "would add nothing that can be told".to_owned(),
        },
        Adds::Times(ratio) => match need.adds_ms(&needs.planned) {
            Some(ms) => format!("{} ms, {}", number(ms, 9), ratio.saving()),
            None => ratio.saving(),
        },
    }
}

/// `by` the materials that call for an effect, the most visible first; nothing where none does.
fn by_whom(need: &Need) -> String {
    const MOST: usize = 3;
    // Their pixels are told where the effect pays by the pixel.
    let mut names = Vec::new();
    for (name, pixels) in need.materials.iter().take(MOST) {
        let name = printable_short(name, 40);
        names.push(match need.pixels {
            Some(_) => format!("{name} ({} px)", thousands(*pixels)),
            None => name,
        });
    }
    if names.is_empty() {
        return String::new();
    }
    if need.materials.len() > MOST {
        names.push(format!("{} more", need.materials.len() - MOST));
    }
    format!("by {}", names.join(", "))
}

/// What follows from the effects, a sentence each.
pub fn effects_advice(needs: &Needs) -> Vec<String> {
    let mut lines = Vec::new();
    // What is not called for and takes time that can be told.
    let mut idle = Vec::new();
    for need in &needs.needs {
        // What takes no time that can be told needs no advice.
        if need.is_paid_for || need.adds_ms(&needs.planned).is_none() {
            continue;
        }
        let name = need.effect.name();
        idle.push(match need.adds(&needs.planned) {
            Adds::Times(ratio) => format!("{name} {:.0}%", 100.0 * (ratio.median - 1.0)),
            Adds::NoWork | Adds::DrawsLess => name.to_owned(),
        });
    }
    if !idle.is_empty() {
        lines.push(format!(
            "not called for, and if they were paid for all the same, the frame would take more: {}",
            idle.join(", ")
        ));
    }
    // A line for each textured material, with what more samples change and take where its texture is fine.
    for texture in &needs.textures {
        let name = printable_short(&texture.material, 40);
        let mut line = format!("texture of {name}: {} texels a pixel", number(texture.texels, 9));
        for (antialiasing, far) in &texture.far {
            let share = 100.0 * *far as f64 / texture.pixels.max(1) as f64;
            let _ =
                write!(line, "; {antialiasing} leaves {share:.1}% of its pixels far from ssaa8");
            let time = needs.antialiasing.iter().find(|(name, _)| name == antialiasing);
            if let Some((_, ratio)) = time.filter(|(name, _)| *name != "none") {
                let _ = write!(line, "; time against none: {}", ratio.words(LONG));
            }
        }
        lines.push(line);
    }
    lines
}

/// What a study found, as the report and the file for machines need it.
pub struct StudyFindings<'a> {
    /// The difficult triangles and pixels, by their kinds.
    pub hard: &'a HardCases,
    /// What each grid changes and takes; nothing where that was not measured.
    pub grids: &'a [GridPrice],
    /// Which effects the view calls for.
    pub needs: &'a Needs,
    pub costs: &'a [Board],
    /// Effects that the model calls for and that the pipeline does not have.
    pub not_drawn: &'a str,
    /// Triangles in the window, of which one that is cut counts as its parts.
    pub pieces: usize,
    /// How long the file was read, where there is one.
    pub loading_s: Option<f64>,
}

/// Plots of a study: error against time, and effects.
fn figures(found: &StudyFindings<'_>) -> Vec<Figure> {
    // An effect that takes no time that can be told and changes no pixel has no bar.
    let mut bars = Vec::new();
    for need in &found.needs.needs {
        let ms = need.adds_ms(&found.needs.planned);
        if ms.is_some() || need.wrong > 0 {
            let is_saved = ms.is_some() && !need.is_paid_for;
            let (name, wrong) = (need.effect.name(), need.wrong);
            bars.push(cost_plots::EffectBars { name, ms, is_saved, wrong });
        }
    }
    // Panels stand three, two or one in a row, as the page is wide.
    let mut figures = vec![
        canvas::figure(
            "Error against time of each choice on the triangles of this view",
            [3, 2, 1].map(|in_row| cost_plots::pareto(found.costs, in_row)),
        ),
        canvas::figure(
            "What each effect takes or saves, and the pixels that are wrong without it",
            cost_plots::WIDTHS.map(|width| cost_plots::effects(&bars, width)),
        ),
    ];
    if !found.grids.is_empty() {
        figures.push(canvas::figure(
            "Pixels in which another triangle is seen than without a grid, against the time of coverage",
            [3, 2, 1].map(|in_row| cost_plots::pareto_of_grids(found.grids, in_row)),
        ));
    }
    figures
}

/// What each grid changes and takes; nothing where that was not measured.
fn grids(prices: &[GridPrice]) -> Option<Table> {
    let mut rows = Vec::new();
    for price in prices {
        let name = match price.bits {
            Some(bits) => format!("{bits} bits, 1/{} px", 1u32 << bits),
            None => "no grid".to_owned(),
        };
        // Without a pixel that changes there is no first one.
        let first = price.first.map_or(String::new(), |[x, y]| format!("{x},{y}"));
        let [scanline, edge_function] =
            [number(price.scanline_ms, 9), number(price.edge_function_ms, 9)];
        let changed = thousands(price.changed);
        rows.push(Row::of(&[&name, &changed, &first, &scanline, &edge_function]));
    }
    if rows.is_empty() {
        return None;
    }
    let columns =
        "grid 22 | >px that change 15 | first 12 | >scanline ms 13 | >edge-function ms 18";
    let how = "another triangle is seen than without a grid; times are those of the coverage of all triangles, by whole \
               numbers up to 8 bits, by the exact engines beyond";
    let table = Table::new("What the grid of corners changes", columns, rows);
    Some(table.noted(vec![how.to_owned()]))
}

/// Pixels of a mark around a pixel that stands alone, which would not be seen otherwise.
const MARK_PX: i32 = 5;

/// The colours of the two maps, which the page explains in a legend.
const HARD: Rgb<u8> = Rgb([230, 60, 40]);
const RING: Rgb<u8> = Rgb([250, 220, 60]);
const DECIDED: Rgb<u8> = Rgb([120, 130, 140]);
const BY_ORDER: Rgb<u8> = Rgb([40, 140, 220]);
const BY_ROUNDING: Rgb<u8> = Rgb([240, 150, 40]);
const EQUAL: Rgb<u8> = Rgb([190, 80, 220]);

/// The picture, dark, with the pixels in which hard cases are seen in red, and a ring around those that stand alone.
fn marked(hard: &HardCases, picture: &RgbImage) -> RgbImage {
    let mut marked = picture.clone();
    let ways = around_a_pixel();
    // Half as bright, so that the marks are seen on any picture.
    for pixel in marked.pixels_mut() {
        *pixel = Rgb(pixel.0.map(|channel| channel / 2));
    }
    for (x, y, _) in picture.enumerate_pixels() {
        let [x_px, y_px] = [x as i32, y as i32];
        if !hard.touches(x_px, y_px) {
            continue;
        }
        marked.put_pixel(x, y, HARD);
        // A pixel with others beside it is seen as it is.
        let mut near = 0;
        for [dx, dy] in &ways {
            near += i32::from(hard.touches(x_px + dx, y_px + dy));
        }
        if near > MARK_PX {
            continue;
        }
        // A ring of about five pixels, by the squares of its inner and its outer radius.
        for [dx, dy] in &ways {
            let at = [x_px + dx, y_px + dy].map(u32::try_from);
            if (17..=26).contains(&(dx * dx + dy * dy))
                && let [Ok(x), Ok(y)] = at
                && let Some(pixel) = marked.get_pixel_mut_checked(x, y)
            {
                *pixel = RING;
            }
        }
    }
    marked
}

/// The ways from a pixel to all of those that a mark may reach, in x and in y.
fn around_a_pixel() -> Vec<[i32; 2]> {
    let mut ways = Vec::new();
    for dy in -MARK_PX..=MARK_PX {
        for dx in -MARK_PX..=MARK_PX {
            ways.push([dx, dy]);
        }
    }
    ways
}

/// Everything that was found. `about` says of what, `commands` say more about each question, and `command` repeats it.
pub fn report(
    subject: &Places<'_>,
    found: &StudyFindings<'_>,
    about: String,
    commands: [String; 3],
    command: String,
) -> Report {
    // The tables from the model to the machine: hard cases, effects by their state, costs, grids.
    let classes = &found.hard.classes;
    let mut hard = hard_cases(subject, found.hard, found.costs);
    hard.notes.push(ties(subject, classes));
    let mut tables = vec![hard];
    tables.extend(State::ALL.map(|state| needs_table(found.needs, state)));
    tables.retain(|table| !table.rows.is_empty() || !table.notes.is_empty());
    // What is said of all effects together stands under the last of their tables.
    if let Some(effects) = tables.last_mut() {
        effects.notes.extend(effects_advice(found.needs));
        if !found.not_drawn.is_empty() {
            effects.notes.push(format!("called for and not supported: {}", found.not_drawn));
        }
    }
    tables.extend(costs(subject, found.costs));
    tables.extend(grids(found.grids));
    Report {
        title: format!("A study of {}", subject.scene.name),
        about,
        answers: answers(subject, found, commands),
        pictured: pictured(found.costs),
        first_screen: first_screen(subject, found),
        command: command.clone(),
        tables,
        figures: figures(found),
        // The picture once, with both maps over it.
        frames: vec![PictureView {
            name: subject.scene.name.clone(),
            about: "The picture, where hard cases are seen in it, and what decides which surface is seen."
                .to_owned(),
            command,
            chapter: Chapter { title: "a study of your own model", path: "study.md" },
            layers: layers(found.hard),
        }],
        ..Report::default()
    }
}

/// The picture and the two maps that lie over it.
fn layers(hard: &HardCases) -> Vec<PictureLayer> {
    // Both maps have the size of the picture, so that the page can lay them over it.
    let picture = picture::of_frame(&hard.picture);
    let marked = marked(hard, &picture);
    let decided = picture::painted(picture.width(), picture.height(), |x, y| {
        match hard.classes.map.get(x as i32, y as i32).unwrap_or_default() {
            Class::Empty => Rgb([18, 18, 24]),
            Class::Decided => DECIDED,
            Class::ByOrder => BY_ORDER,
            Class::ByRounding => BY_ROUNDING,
            Class::Equal => EQUAL,
        }
    });
    let of_hard = [(HARD, "a hard case is seen here"), (RING, "around one that stands alone")];
    let of_decided = [
        (DECIDED, "the depths decide"),
        (BY_ROUNDING, "rounding alone decides"),
        (EQUAL, "rounding decides between equal depths"),
        (BY_ORDER, "the order of faces drawn twice decides"),
    ];
    vec![
        PictureLayer::new("picture", &picture),
        PictureLayer::map("hard cases", &marked, &of_hard),
        PictureLayer::map("decided", &decided, &of_decided),
    ]
}

/// The hard cases with what is said of them, and the choices that are wrong on them where costs were measured.
pub fn hard_cases(subject: &Places<'_>, found: &HardCases, costs: &[Board]) -> Table {
    let mut rows = Vec::new();
    for case in &found.cases {
        let (mut place, mut command) = (String::new(), String::new());
        if let Some(first) = case.triangles.first() {
            place = subject.place(*first);
            command = subject.command(*first);
        }
        if !case.note.is_empty() {
            let _ = write!(place, "; {}", case.note);
        }
        // Which choices of arithmetic fail on just these triangles.
        let wrong = match wrong_on(found, case.kind, costs).as_slice() {
            [] => String::new(),
            choices => format!("wrong on such triangles:\n  {}", choices.join("\n  ")),
        };
        let [in_view, others, pixels] =
            [case.in_view, case.count - case.in_view, case.pixels].map(thousands);
        let (kind, about) = (case.kind.name(), case.kind.about());
        let row = [
            &kind as &dyn std::fmt::Display,
            &in_view,
            &others,
            &pixels,
            &about,
            &place,
            &command,
            &wrong,
        ];
        rows.push(Row::of(&row));
    }
    let caption = if found.cases.is_empty() { "Hard cases: none" } else { "Hard cases" };
    let columns = "kind 32 | >in view 11 how many are seen | >only in the mesh 17 how many are culled, hidden or outside | \
                   >pixels 11 pixels of the picture in which they are seen | what one sees | where | command | wrong choices";
    Table::new(caption, columns, rows).noted(about_hard_cases(subject, found, costs))
}

/// The effects of one state.
fn needs_table(needs: &Needs, state: State) -> Table {
    let mut rows = Vec::new();
    for need in needs.needs.iter().filter(|need| need.state() == state) {
        let time = takes(needs, need);
        let (name, wrong) = (need.effect.name(), thousands(need.wrong));
        let pixels = need.pixels.map_or("-".to_owned(), thousands);
        // Several decisions of the plan may have one reason, which is told once.
        let reasons: Vec<_> = need.reasons.iter().map(|(reason, _)| reason.as_str()).collect();
        rows.push(Row::of(&[&name, &pixels, &wrong, &time, &by_whom(need), &reasons.join("; ")]));
    }
    let columns = "effect 28 | >pixels 11 pixels that pay for it | >wrong without 17 pixels that change when it is \
                   switched off | takes 22 what it takes of a planned frame, in ms and of its time | by | why";
    Table::new(&format!("Effects {}", state.name()), columns, rows)
}

/// What each choice costs, a table for each group, with what to choose.
pub fn costs(subject: &Places<'_>, boards: &[Board]) -> Vec<Table> {
    boards.iter().map(|board| cost_table(subject, board)).collect()
}

/// A number of so many characters at most, or a dash.
fn or_dash(value: Option<f64>, width: usize) -> String {
    value.map_or("-".to_owned(), |value| words::number(value, width))
}

/// What a choice costs: its errors, its time, what it holds, and how it works.
fn cost_row(board: &Board, number: usize) -> Row {
    let choice = &board.choices[number];
    // What was not run has its reason in place of all numbers.
    let run = match &board.cells[number][0] {
        Cell::NotRun(why) => return Row::of(&[&choice.name, &format!("not run: {why}")]),
        Cell::Run(run) => run,
    };
    let mut cells = vec![choice.name.to_string()];
    for error in &run.errors {
        cells.push(or_dash(*error, 9));
    }
    // Three cells, which are empty where nothing was timed.
    cells.extend(match &run.time {
        Some(Time { rounds: Some(rounds), times, .. }) => {
            let Spread { low, median, high } = rounds.spread();
            [ms(median), format!("{}-{}", ms(low), ms(high)), times.to_string()]
        }
        _ => Default::default(),
    });
    cells.push(or_dash(run.found.bytes.map(|bytes| bytes as f64 / 1e6), 7));
    cells.push(choice.about.to_string());
    cells.into()
}

/// A number, or that it is one of a sample.
fn part(part: Part) -> String {
    match part.is_all() {
        true => thousands(part.of),
        false => format!("a sample of {} of {}", thousands(part.part), thousands(part.of)),
    }
}

/// The choices of a group, a row for each.
fn cost_table(subject: &Places<'_>, board: &Board) -> Table {
    // A column for each measure of the error stands between the name and the times.
    let mut columns = table::columns("~choice 23");
    for measure in &board.measures {
        columns.push(Column::numbers(&measure.short, &measure.title).least(9));
    }
    columns.extend(table::columns(
        ">ms 7 of processor time, median | >quartiles 13 a quarter of the rounds took less, a quarter more, in ms \
         | >times 16 the cheapest, with an interval | >MB 6 at the peak, from the sizes of its buffers; the scene is not in it | how",
    ));
    let column = &board.columns[0];
    let mut caption = board.ladder.title().to_owned();
    if let Some(sampling) = column.sampling {
        let [items, pixels] = [sampling.items, sampling.pixels].map(part);
        let _ = write!(caption, ", ms for {items} triangles and {pixels} pixels");
    }
    // What the heads of the columns mean, then what cannot be said in a cell, then what to choose.
    let mut notes = Vec::new();
    for measure in &board.measures {
        notes.push(format!("{}: {}", measure.short, measure.title));
    }
    notes.push(format!("times: {CELLS}"));
    for choice in board.ran(0) {
        if let Some(wall) = choice.times().and_then(|times| times.wall_ns) {
            notes.push(format!(
                "{}: {} ms pass meanwhile, on all threads",
                choice.name(),
                ms(wall)
            ));
        }
    }
    if let Some(noise) = &column.noise {
        // So much two times may differ without a reason.
        notes.push(format!("two equal passes in the same rounds: {:.3} times", noise.median));
    }
    notes.extend(advice(subject, board));
    let rows = (0..board.choices.len()).map(|number| cost_row(board, number)).collect();
    Table::of(&caption, columns, rows).noted(notes)
}
