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

use crate::cost::{FRAMES, Group, JudgedChoice, Part};
use crate::effects::{Adds, Need, Needs, State};
use crate::grid::GridPrice;
use crate::hard::{HardCase, HardCases, Kind};
use crate::shift::Shifted;
use crate::ties::{Class, Classes, TiedPair};
use crate::{face_of, triangle_of};
use image::{Rgb, RgbImage};
use rasterproof_host::text::printable_short;
use rasterproof_models::Origin;
use rasterproof_precision::cost::{CELLS, Ladder, Ratio, RatioKind, Times};
use rasterproof_render::scene::Scene;

use rasterproof_report::canvas;
use rasterproof_report::chapter::Chapter;
use rasterproof_report::html::{Figure, Outcome, PictureLayer, PictureView, Report, Statement};
use rasterproof_report::picture;
use rasterproof_report::table::{self, Column, Row, Table};
use rasterproof_report::words::{count, number, thousands};

#[derive(Clone, Copy)]
pub struct Places<'a> {
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

    pub fn command(&self, triangle: u32) -> String {
        (self.inspect)(face_of(self.scene, self.origins, triangle))
    }

    fn face(&self, triangle: u32) -> String {
        format!("face {}", face_of(self.scene, self.origins, triangle))
    }
}

/// By group the choices that get triangles of a kind wrong, with how many samples.
fn wrong_on(found: &HardCases, kind: Kind, costs: &[Group]) -> Vec<String> {
    let of_group = |group: &Group| {
        let of_choice = |choice: &JudgedChoice| {
            let of_kind = |pair: &[u32; 2]| pair.iter().any(|one| found.is(*one, kind));
            let of_kind = choice.wrong.iter().filter(|(pair, _)| of_kind(pair));
            let count: u64 = of_kind.map(|(_, count)| count).sum();
            (count > 0).then(|| format!("{} {}", choice.name(), thousands(count)))
        };
        let wrong: Vec<String> = group.choices.iter().filter_map(of_choice).collect();
        let unit = group.measures.iter().find_map(|measure| measure.unit).unwrap_or("px");
        (!wrong.is_empty()).then(|| format!("{} ({unit}): {}", group.title, wrong.join(", ")))
    };
    costs.iter().filter_map(of_group).collect()
}

/// In how many pixels of hard cases values were compared; nothing where in all of them.
fn compared_in(costs: &[Group]) -> Option<String> {
    let looked_at = costs.iter().find_map(|group| group.looked_at)?;
    (!looked_at.is_all()).then(|| {
        let [some, all] = [looked_at.part, looked_at.of].map(thousands);
        format!("values were compared in {some} of the {all} px of these faces")
    })
}

/// What is said of all hard cases together, a line each.
fn about_hard_cases(subject: &Places<'_>, found: &HardCases, costs: &[Group]) -> Vec<String> {
    let mut lines: Vec<String> = compared_in(costs).into_iter().collect();
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
    if let Some([near, far]) = found.w {
        let [near, far] = [near, far].map(|w| number(w, 9));
        lines.push(format!("w, the distance from the eye, in the window: {near} to {far}"));
    }
    let shifted = |shifted: Shifted, unit: &str| {
        let Shifted { by, pixel: [x, y], triangle } = shifted;
        format!("by {by:.1e}{unit} at {x},{y} on {}", subject.face(triangle))
    };
    let shift = &found.shift;
    let values: Vec<String> = [
        ("a depth", shift.depth, ""),
        ("texture coordinates", shift.texels, " texels"),
        ("a colour of corners", shift.colour, " of 255"),
        ("a normal", shift.normal, " degrees"),
    ]
    .into_iter()
    .filter_map(|(what, largest, unit)| Some(format!("{what} {}", shifted(largest?, unit))))
    .collect();
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

fn ms(ns: f64) -> String {
    number(ns / 1e6, 9)
}

/// The three questions of a study, each answered in a sentence or two, and the commands that say more.
fn answers(
    subject: &Places<'_>,
    found: &StudyFindings<'_>,
    commands: [String; 3],
) -> Vec<Statement> {
    let stability = stability(subject, found.hard) + &z_fighting(found.costs);
    let sentences = [accuracy(found.costs), stability, effects(found)];
    let questions = ["accuracy", "hard cases", "effects"];
    let all = questions.into_iter().zip(sentences).zip(commands);
    let answer = |((about, sentence), command)| Statement { about, sentence, command };
    all.map(answer).collect()
}

/// A choice that was timed, with its group.
#[derive(Clone, Copy)]
struct TimedChoice<'a> {
    group: &'a Group,
    judged: &'a JudgedChoice,
    time: &'a Times,
}

impl TimedChoice<'_> {
    fn name(&self) -> String {
        format!("{} by {}", self.judged.name(), self.group.title.trim_start_matches(COVERAGE))
    }

    /// How many pixels are wrong, against corners as given or snapped, whatever is better.
    fn wrong(&self) -> f64 {
        self.judged.errors.iter().flatten().copied().fold(f64::MAX, f64::min)
    }

    /// Those that are wrong against the corners as given.
    fn wrong_as_given(&self) -> u64 {
        self.judged.errors.first().copied().flatten().unwrap_or(0.0) as u64
    }

    fn promises(&self, measure: usize) -> bool {
        self.judged.choice.promises.contains(&measure)
    }

    fn over(&self, other: &Self) -> Ratio {
        self.time.over(other.time).unwrap_or(Ratio::ONE)
    }
}

/// What exact coverage costs, and what is wrong.
fn accuracy(groups: &[Group]) -> String {
    let of_coverage: Vec<&Group> =
        groups.iter().filter(|group| group.title.starts_with(COVERAGE)).collect();
    if of_coverage.iter().all(|group| group.timed_pixels.of == 0) {
        return "No pixel is covered in this view, so nothing was compared.".to_owned();
    }
    let mut all = Vec::new();
    for group in of_coverage {
        let timed = group.choices.iter().filter(|judged| judged.refused.is_none());
        all.extend(
            timed.filter_map(|judged| {
                Some(TimedChoice { group, judged, time: judged.time.as_ref()? })
            }),
        );
    }
    let least = |of: &dyn Fn(&TimedChoice<'_>) -> bool| {
        let of = all.iter().filter(|one| of(one));
        of.min_by(|a, b| a.time.median().total_cmp(&b.time.median()))
    };
    let certain = least(&|one| !one.judged.choice.promises.is_empty() && one.wrong() == 0.0);
    let (Some(cheapest), Some(certain)) = (least(&|_| true), certain) else {
        return "No choice of coverage that is exact for every model takes these triangles."
            .to_owned();
    };
    let unit = cheapest.group.measures[0].unit.unwrap_or("px");
    let is_snapped = certain.promises(1);
    let snapped = if is_snapped { " once its corners are snapped" } else { "" };
    let name = certain.name();
    let ratio = certain.over(cheapest);
    let mut sentence = if ratio.said() == RatioKind::NoDifference {
        format!(
            "Exact coverage costs nothing here: no choice is cheaper than {name}, exact for every model{snapped}."
        )
    } else {
        let is = match cheapest.wrong() {
            0.0 => "happens to be exact here".to_owned(),
            wrong => format!("is wrong in {} {unit}", thousands(wrong as u64)),
        };
        format!(
            "Exact coverage by {name}, exact for every model{snapped}, against the cheapest choice, {}, which {is}: {}.",
            cheapest.name(),
            ratio.words(LONG)
        )
    };
    let as_given = least(&|one| one.promises(0));
    if let Some(as_given) = as_given.filter(|_| is_snapped && certain.wrong_as_given() > 0) {
        let differ =
            count(certain.wrong_as_given(), &format!("{unit} differs"), &format!("{unit} differ"));
        let words = as_given.over(cheapest).words(LONG);
        let _ = write!(
            sentence,
            " {differ} from the corners as given; exact for those is {}: {words}.",
            as_given.name()
        );
    }
    let are_wrong: Vec<_> = all.iter().filter(|one| one.wrong() > 0.0).collect();
    let worst = are_wrong.iter().max_by(|a, b| a.wrong().total_cmp(&b.wrong()));
    let _ = match worst {
        None => write!(sentence, " None of the {} choices is wrong here.", all.len()),
        Some(worst) => write!(
            sentence,
            " Of {} choices {} {}, in {} {unit}.",
            all.len(),
            count(are_wrong.len() as u64, "is wrong here:", "are wrong here, most of all"),
            worst.name(),
            thousands(worst.wrong() as u64)
        ),
    };
    sentence
}

const LONG: &str = "long";

/// Which depth buffers show another surface than exact depths do; nothing where none does.
fn z_fighting(groups: &[Group]) -> String {
    let Some(group) = groups.iter().find(|group| group.title == Ladder::Depth.title()) else {
        return String::new();
    };
    let wrong =
        |choice: &JudgedChoice| choice.errors.first().copied().flatten().unwrap_or(0.0) as u64;
    let wrong: Vec<String> = group
        .choices
        .iter()
        .filter(|choice| wrong(choice) > 0)
        .map(|choice| format!("{} in {}", choice.name(), thousands(wrong(choice))))
        .collect();
    let unit = group.measures.iter().find_map(|measure| measure.unit).unwrap_or("px");
    match &wrong[..] {
        [] => String::new(),
        wrong => format!(" Depth buffers that show another surface: {} {unit}.", wrong.join(", ")),
    }
}

const COVERAGE: &str = "Coverage by ";

/// What rounding decides in this view, and which hard cases are seen besides.
fn stability(subject: &Places<'_>, found: &HardCases) -> String {
    let classes = &found.classes;
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
    let others: Vec<_> = found.in_view().filter(|case| case.kind != Kind::Rounding).collect();
    let most = others.iter().max_by_key(|case| case.pixels);
    let _ = match most {
        None => write!(sentence, " No other hard case is seen in this view."),
        Some(most) => {
            let (name, pixels) = (most.kind.name(), thousands(most.pixels));
            let seen = "seen in this view";
            match others.len() {
                1 => write!(
                    sentence,
                    " One other kind of hard case is {seen}: {name}, in {pixels} px."
                ),
                kinds => write!(
                    sentence,
                    " {kinds} other kinds of hard cases are {seen}, most of all {name}, in {pixels} px."
                ),
            }
        }
    };
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
    let called: Vec<_> = all.iter().filter(|need| need.state() == State::CalledFor).collect();
    let mut sentence = format!("{} of {} effects are called for.", called.len(), all.len());
    let of_pixels = called.iter().filter(|need| need.pixels.is_some());
    if let Some(most) = of_pixels.max_by_key(|need| need.wrong) {
        let (name, wrong) = (most.effect.name(), thousands(most.wrong));
        let _ = write!(sentence, " Without {name}, {wrong} px are wrong.");
    }
    let frames = found.costs.iter().find(|group| group.title == FRAMES);
    let time = |name: &str| frames?.choices.iter().find(|one| one.name() == name)?.time.as_ref();
    let times = time("scanline all").zip(time("scanline planned"));
    if let Some(ratio) = times.and_then(|(every, planned)| every.over(planned)) {
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

/// What is seen, what is called for, and the cheapest exact choices: a table for each question.
fn first_screen(subject: &Places<'_>, found: &StudyFindings<'_>) -> Vec<Table> {
    let short = |columns: &str, mut rows: Vec<Row>, note: Option<String>| {
        let left_out = rows.len().saturating_sub(MOST_ROWS);
        rows.truncate(MOST_ROWS);
        let more = (left_out > 0).then(|| format!("and {left_out} more"));
        Table::new("", columns, rows).noted(more.into_iter().chain(note).collect())
    };
    let listed = |about: &str, all: &[String]| {
        (!all.is_empty()).then(|| format!("{about}: {}", all.join(", ")))
    };
    let mut seen: Vec<_> = found.hard.in_view().collect();
    seen.sort_by_key(|case| std::cmp::Reverse(case.pixels));
    let row = |case: &&HardCase| {
        let face = case.triangles.first().map_or(String::new(), |one| subject.face(*one));
        let [number, pixels] = [case.in_view, case.pixels].map(thousands);
        Row::of(&[&case.kind.name(), &number, &pixels, &face])
    };
    let columns = "hard cases in this view 32 | >number 11 | >px 11 | first or worst 14";
    let hidden = found.hard.cases.iter().filter(|case| case.in_view == 0);
    let hidden: Vec<_> =
        hidden.map(|case| format!("{} {}", thousands(case.count), case.kind.name())).collect();
    let hidden = listed("only in the mesh", &hidden);
    // These are few pixels mostly, and in none of the rows then; what mends them is said here.
    let is_broken = |case: &&&HardCase| [Kind::Crack, Kind::Fold].contains(&case.kind);
    let broken = seen.iter().filter(is_broken).flat_map(|case| {
        let about = format!("{}: {}; {}", case.kind.name(), case.note, case.kind.about());
        let command = case.triangles.first().map(|one| subject.command(*one));
        std::iter::once(about).chain(command)
    });
    let broken: Vec<String> = broken.collect();
    let mut seen = short(columns, seen.iter().map(row).collect(), hidden);
    seen.notes.extend(broken);
    let of = |state: State| found.needs.needs.iter().filter(move |need| need.state() == state);
    let row = |need: &Need| {
        Row::of(&[&need.effect.name(), &thousands(need.wrong), &takes(found.needs, need)])
    };
    let columns = "effects called for 24 | >px wrong without 16 | takes of the planned frame 32";
    let mut called: Vec<_> = of(State::CalledFor).collect();
    called.sort_by_key(|need| std::cmp::Reverse(need.wrong));
    let safe: Vec<_> = of(State::ToBeSafe).map(|need| need.effect.name().to_owned()).collect();
    let safe = listed("paid for to be safe, though no pixel changes here", &safe);
    let called = short(columns, called.into_iter().map(row).collect(), safe);
    let mut rows = Vec::new();
    let is_coverage = |group: &&Group| group.title.starts_with(COVERAGE);
    let coverage: Vec<&Group> = found.costs.iter().filter(is_coverage).collect();
    if let Some(first) = coverage.first() {
        for (number, measure) in first.measures.iter().enumerate() {
            rows.push(cheapest_row(&coverage, number, &format!("Coverage, {}", measure.short)));
        }
    }
    for group in found.costs.iter().filter(|group| !is_coverage(group)) {
        rows.push(cheapest_row(&[group], 0, group.title));
    }
    let columns =
        "what exactness costs 27 | cheapest exact 27 | >ms 7 | times 14 the cheapest of all";
    let note = "same: no difference; 2-12?: cannot be told; +2: two as fast; more: --all";
    let costs = Table::new("", columns, rows).noted(vec![note.to_owned()]);
    vec![seen, called, costs]
}

/// The cheapest choice that a measure calls exact of groups that do the same job, and what it takes.
fn cheapest_row(groups: &[&Group], measure: usize, title: &str) -> Row {
    let (mut exact, mut all) = (Vec::new(), Vec::new());
    for &group in groups {
        for judged in &group.choices {
            let Some(time) = judged.time.as_ref() else { continue };
            all.push(time);
            if group.is_exact(judged, measure) {
                exact.push(TimedChoice { group, judged, time });
            }
        }
    }
    let least = all.into_iter().min_by(|a, b| a.median().total_cmp(&b.median()));
    let best = exact.iter().min_by(|a, b| a.time.median().total_cmp(&b.time.median()));
    let Some((best, least)) = best.zip(least) else {
        let is_compared = groups.iter().any(|group| group.judged.part > 0);
        let none = if is_compared { "none" } else { "no pixel was compared" };
        return Row::of(&[&title, &none, &"-", &"-"]);
    };
    let is_rival = |other: &&TimedChoice<'_>| {
        let ratio = other.over(best);
        ratio != Ratio::ONE && ratio.said() != RatioKind::Holds && ratio.low <= 1.0
    };
    let rivals = exact.iter().filter(is_rival).count();
    let mut name = best.judged.name().to_owned();
    if groups.len() > 1 {
        let kind = best.group.title.trim_start_matches(COVERAGE).split(' ').next();
        name = format!("{} {name}", kind.unwrap_or_default());
    }
    if rivals > 0 {
        let _ = write!(name, " +{rivals}");
    }
    let times = best.time.over(least).map_or("-".to_owned(), |ratio| ratio.to_string());
    Row::of(&[&title, &name, &ms(best.time.median()), &times])
}

/// The cheapest exact choice of a group, and what is said of those that are cheaper and wrong, or exact by chance.
pub fn advice(subject: &Places<'_>, group: &Group) -> Vec<String> {
    let mut lines = Vec::new();
    let mut limit: Option<&Times> = None;
    for (number, measure) in group.measures.iter().enumerate() {
        let Some(best) = group.cheapest_exact(number) else {
            lines.push(match group.judged.part {
                0 => "no pixel was compared, so nothing is called exact".to_owned(),
                _ => format!("none is exact ({})", measure.short),
            });
            continue;
        };
        lines.extend(compared(group, number));
        let time = group.choices[best].time.as_ref();
        limit = match (limit, time) {
            (Some(known), Some(time)) if time.median() >= known.median() => Some(known),
            (known, time) => time.or(known),
        };
    }
    if !group.judged.is_all() && group.judged.part > 0 {
        let [part, of] = [group.judged.part, group.judged.of].map(thousands);
        lines.push(format!("exact and wrong are of a sample: {part} of {of} px were compared"));
    }
    for choice in &group.choices {
        let is_cheaper = choice.time.as_ref().zip(limit).is_some_and(|(time, limit)| {
            time.over(limit)
                .is_some_and(|ratio| ratio.said() == RatioKind::Holds && ratio.high < 1.0)
        });
        let goal = |i: usize| group.measures[i].goal.unwrap_or(f64::INFINITY);
        let mut errors = choice.errors.iter().enumerate();
        let is_wrong = errors.all(|(i, error)| error.is_some_and(|error| error > goal(i)));
        match (choice.margin, choice.first_wrong) {
            (Some(margin), _) if !is_wrong && choice.refused.is_none() => {
                let luck = if margin < 1.0 { ": it might have been wrong" } else { "" };
                lines.push(format!(
                    "{} is exact here; the nearest decision is {} times its error bound away from 0{luck}",
                    choice.name(),
                    number(margin, 9)
                ));
            }
            (_, Some((triangle, [x, y])))
                if is_wrong && (is_cheaper || choice.margin.is_some()) =>
            {
                let cheaper = if is_cheaper { "cheaper and " } else { "" };
                let place = triangle.map(|one| format!(": {}", subject.place(one)));
                let place = place.unwrap_or_default();
                lines.push(format!("{} is {cheaper}wrong, first at {x},{y}{place}", choice.name()));
                lines.extend(triangle.map(|one| subject.command(one)));
            }
            _ => {}
        }
    }
    if group.not_judged > 0 {
        let count = thousands(group.not_judged);
        let why = "single precision does not hold a value or 1/w of a corner";
        lines.push(format!("not judged: {count} pieces, since {why}"));
    }
    lines
}

/// The cheapest exact choice, or that there is no difference between those that are exact.
fn compared(group: &Group, measure: usize) -> Vec<String> {
    let Some(best) = group.compared(measure) else { return Vec::new() };
    let names = |all: &[usize]| {
        all.iter().map(|one| group.choices[*one].name()).collect::<Vec<_>>().join(", ")
    };
    let short = &group.measures[measure].short;
    let exact = |choice: &&JudgedChoice| choice.time.is_some() && group.is_exact(choice, measure);
    let is_all = group.choices.iter().filter(exact).count() == best.equal.len() + 1;
    if is_all && !best.equal.is_empty() {
        let all = names(&[&[best.choice], &*best.equal].concat());
        return vec![format!("no difference between the exact choices ({short}): {all}")];
    }
    let mut lines = vec![format!("cheapest exact ({short}): {}", names(&[best.choice]))];
    if !best.equal.is_empty() {
        lines.push(format!("no difference: {}", names(&best.equal)));
    }
    if !best.undecided.is_empty() {
        let (rounds, others) = (best.rounds, names(&best.undecided));
        lines.push(format!("undecided after {rounds} rounds, as fast or not: {others}"));
    }
    lines
}

/// How it is decided which surface is seen, in a sentence or two.
fn ties(subject: &Places<'_>, classes: &Classes) -> String {
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
        Adds::DrawsLess => "less is drawn without it".to_owned(),
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
    let name = |(name, pixels): &(String, u64)| {
        let name = printable_short(name, 40);
        match need.pixels {
            Some(_) => format!("{name} ({} px)", thousands(*pixels)),
            None => name,
        }
    };
    let mut names: Vec<_> = need.materials.iter().take(MOST).map(name).collect();
    let more = need.materials.len().saturating_sub(MOST);
    if more > 0 {
        names.push(format!("{more} more"));
    }
    if names.is_empty() { String::new() } else { format!("by {}", names.join(", ")) }
}

/// What follows from the effects, a sentence each.
pub fn effects_advice(needs: &Needs) -> Vec<String> {
    let mut lines = Vec::new();
    let is_idle = |need: &&Need| !need.is_paid_for && need.adds_ms(&needs.planned).is_some();
    let more = |need: &Need| match need.adds(&needs.planned) {
        Adds::Times(ratio) => {
            format!("{} {:.0}%", need.effect.name(), 100.0 * (ratio.median - 1.0))
        }
        Adds::NoWork | Adds::DrawsLess => need.effect.name().to_owned(),
    };
    let idle: Vec<_> = needs.needs.iter().filter(is_idle).map(more).collect();
    if !idle.is_empty() {
        lines.push(format!(
            "not called for, and if they were paid for all the same, the frame would take more: {}",
            idle.join(", ")
        ));
    }
    let time = |name: &str| Some(needs.antialiasing.iter().find(|(other, _)| *other == name)?.1);
    for texture in &needs.textures {
        let name = printable_short(&texture.material, 40);
        let mut line = format!("texture of {name}: {} texels a pixel", number(texture.texels, 9));
        for (antialiasing, far) in &texture.far {
            let share = 100.0 * *far as f64 / texture.pixels.max(1) as f64;
            let _ =
                write!(line, "; {antialiasing} leaves {share:.1}% of its pixels far from ssaa8");
            if let Some(ratio) = time(antialiasing).filter(|_| *antialiasing != "none") {
                let _ = write!(line, "; time against none: {}", ratio.words(LONG));
            }
        }
        lines.push(line);
    }
    lines
}

pub struct StudyFindings<'a> {
    pub hard: &'a HardCases,
    /// What each grid changes and takes; nothing where that was not measured.
    pub grids: &'a [GridPrice],
    pub needs: &'a Needs,
    pub costs: &'a [Group],
    pub not_drawn: &'a str,
    pub pieces: usize,
    /// How long the file was read, where there is one.
    pub loading_s: Option<f64>,
}

/// Plots of a study: error against time, and effects.
fn figures(found: &StudyFindings<'_>) -> Vec<Figure> {
    let bar = |need: &Need| {
        let ms = need.adds_ms(&found.needs.planned);
        let saved = ms.is_some() && !need.is_paid_for;
        (ms.is_some() || need.wrong > 0).then(|| (need.effect.name(), ms, saved, need.wrong))
    };
    let bars: Vec<_> = found.needs.needs.iter().filter_map(bar).collect();
    let mut figures = vec![
        canvas::figure(
            "Error against time of each choice on the triangles of this view",
            [2, 1].map(|in_row| cost_plots::pareto_of_model(found.costs, in_row)),
        ),
        canvas::figure(
            "What each effect takes or saves, and the pixels that are wrong without it",
            [800.0, 400.0].map(|width| cost_plots::effects(&bars, width)),
        ),
    ];
    if !found.grids.is_empty() {
        figures.push(canvas::figure(
            "Pixels in which another triangle is seen than without a grid, against the time of coverage",
            [2, 1].map(|in_row| cost_plots::pareto_of_grids(found.grids, in_row)),
        ));
    }
    figures
}

/// What each grid changes and takes.
fn grids(prices: &[GridPrice]) -> Option<Table> {
    let row = |price: &GridPrice| {
        let name = price
            .bits
            .map_or("no grid".to_owned(), |bits| format!("{bits} bits, 1/{} px", 1u32 << bits));
        let first = price.first.map_or(String::new(), |[x, y]| format!("{x},{y}"));
        let [scanline, edge_function] =
            [price.scanline_ms, price.edge_function_ms].map(|ms| number(ms, 9));
        Row::of(&[&name, &thousands(price.changed), &first, &scanline, &edge_function])
    };
    let columns =
        "grid 22 | >px that change 15 | first 12 | >scanline ms 13 | >edge-function ms 18";
    let how = "another triangle is seen than without a grid; times are those of the coverage of all triangles, by whole \
               numbers up to 8 bits, by the exact engines beyond";
    (!prices.is_empty()).then(|| {
        Table::new("What the grid of corners changes", columns, prices.iter().map(row).collect())
            .noted(vec![how.to_owned()])
    })
}

/// Pixels of a mark around a pixel that stands alone, which would not be seen otherwise.
const MARK_PX: i32 = 5;

/// The picture, dark, with the pixels in which hard cases are seen in red, and a ring around those that stand alone.
fn marked(hard: &HardCases, picture: &RgbImage) -> RgbImage {
    const RED: Rgb<u8> = Rgb([230, 60, 40]);
    let mut marked = picture.clone();
    for pixel in marked.pixels_mut() {
        *pixel = Rgb(pixel.0.map(|channel| channel / 2));
    }
    for (x, y, _) in picture.enumerate_pixels() {
        let [x_px, y_px] = [x as i32, y as i32];
        if !hard.touches(x_px, y_px) {
            continue;
        }
        marked.put_pixel(x, y, RED);
        let around =
            (-MARK_PX..=MARK_PX).flat_map(|dy| (-MARK_PX..=MARK_PX).map(move |dx| (dx, dy)));
        let near = around.clone().filter(|(dx, dy)| hard.touches(x_px + dx, y_px + dy)).count();
        if near > MARK_PX as usize {
            continue;
        }
        for (dx, dy) in around.filter(|(dx, dy)| (17..=26).contains(&(dx * dx + dy * dy))) {
            let at = [x_px + dx, y_px + dy].map(u32::try_from);
            if let [Ok(x), Ok(y)] = at
                && let Some(pixel) = marked.get_pixel_mut_checked(x, y)
            {
                *pixel = Rgb([250, 220, 60]);
            }
        }
    }
    marked
}

/// Everything that was found. `about` says of what, `commands` say more about each question, and `command` repeats it.
pub fn report(
    subject: &Places<'_>,
    found: &StudyFindings<'_>,
    about: String,
    commands: [String; 3],
    command: String,
) -> Report {
    let classes = &found.hard.classes;
    let in_view = found.hard.in_view().count();
    let outcome = match in_view {
        0 => Outcome::new(true, "CLEAN", "No hard case is seen in this view."),
        1 => Outcome::new(false, "HARD CASES", "One kind of hard case is seen in this view."),
        kinds => {
            let sentence = format!("{kinds} kinds of hard cases are seen in this view.");
            Outcome::new(false, "HARD CASES", sentence)
        }
    };
    let mut hard = hard_cases(subject, found.hard, found.costs);
    hard.notes.push(ties(subject, classes));
    let mut tables = vec![hard];
    tables.extend(State::ALL.map(|state| needs_table(found.needs, state)));
    tables.retain(|table| !table.rows.is_empty() || !table.notes.is_empty());
    if let Some(effects) = tables.last_mut() {
        effects.notes.extend(effects_advice(found.needs));
        if !found.not_drawn.is_empty() {
            effects.notes.push(format!("called for and not supported: {}", found.not_drawn));
        }
    }
    tables.extend(costs(subject, found.costs));
    tables.extend(grids(found.grids));
    let answers = answers(subject, found, commands);
    let picture = picture::of_frame(&found.hard.picture);
    let marked = marked(found.hard, &picture);
    let decided = picture::painted(picture.width(), picture.height(), |x, y| {
        match classes.map.get(x as i32, y as i32).unwrap_or_default() {
            Class::Empty => Rgb([18, 18, 24]),
            Class::Decided => Rgb([120, 130, 140]),
            Class::ByOrder => Rgb([40, 140, 220]),
            Class::ByRounding => Rgb([240, 150, 40]),
            Class::Equal => Rgb([190, 80, 220]),
        }
    });
    Report {
        title: format!("A study of {}", subject.scene.name),
        outcome: Some(outcome),
        about,
        answers,
        first_screen: first_screen(subject, found),
        command: command.clone(),
        tables,
        figures: figures(found),
        frames: vec![PictureView {
            name: subject.scene.name.clone(),
            about:
                "The picture; pixels in which hard cases are seen, in red; where rounding alone decides \
                    which surface is seen, in orange, where it does between equal depths, in violet, \
                    and where the order of faces drawn twice does, in blue."
                    .to_owned(),
            command,
            chapter: Chapter { title: "a study of your own model", path: "study.md" },
            layers: vec![
                PictureLayer::new("picture", &picture),
                PictureLayer::map("hard cases", &marked),
                PictureLayer::map("decided", &decided),
            ],
        }],
        ..Report::default()
    }
}

/// The hard cases with what is said of them, and the choices that are wrong on them where costs were measured.
pub fn hard_cases(subject: &Places<'_>, found: &HardCases, costs: &[Group]) -> Table {
    let row = |case: &HardCase| {
        let first = case.triangles.first();
        let mut place = first.map_or(String::new(), |one| subject.place(*one));
        let command = first.map_or(String::new(), |one| subject.command(*one));
        if !case.note.is_empty() {
            let _ = write!(place, "; {}", case.note);
        }
        let wrong = match wrong_on(found, case.kind, costs).as_slice() {
            [] => String::new(),
            choices => format!("wrong on such triangles:\n  {}", choices.join("\n  ")),
        };
        let [in_view, others, pixels] =
            [case.in_view, case.count - case.in_view, case.pixels].map(thousands);
        let (kind, about) = (case.kind.name(), case.kind.about());
        Row::of(&[&kind, &in_view, &others, &pixels, &about, &place, &command, &wrong])
    };
    let caption = if found.cases.is_empty() { "Hard cases: none" } else { "Hard cases" };
    let columns = "kind 32 | >in view 11 how many are seen | >only in the mesh 17 how many are culled, hidden or outside | \
                   >pixels 11 pixels of the picture in which they are seen | what one sees | where | command | wrong choices";
    let rows = found.cases.iter().map(row).collect();
    Table::new(caption, columns, rows).noted(about_hard_cases(subject, found, costs))
}

fn needs_table(needs: &Needs, state: State) -> Table {
    let row = |need: &Need| {
        let time = takes(needs, need);
        let (name, wrong) = (need.effect.name(), thousands(need.wrong));
        let pixels = need.pixels.map_or("-".to_owned(), thousands);
        let reasons: Vec<_> = need.reasons.iter().map(|(reason, _)| reason.as_str()).collect();
        Row::of(&[&name, &pixels, &wrong, &time, &by_whom(need), &reasons.join("; ")])
    };
    let is_here = |need: &&Need| need.state() == state;
    let columns = "effect 28 | >pixels 11 pixels that pay for it | >wrong without 17 pixels that change when it is \
                   switched off | takes 22 what it takes of a planned frame, in ms and of its time | by | why";
    let rows = needs.needs.iter().filter(is_here).map(row).collect();
    Table::new(&format!("Effects {}", state.name()), columns, rows)
}

/// What each choice costs, a table for each group, with what to choose.
pub fn costs(subject: &Places<'_>, groups: &[Group]) -> Vec<Table> {
    groups.iter().map(|group| cost_table(subject, groups, group)).collect()
}

fn cost_table(subject: &Places<'_>, groups: &[Group], group: &Group) -> Table {
    let least = group.cheapest_of_job(groups);
    let row = |choice: &JudgedChoice| {
        if let Some(why) = &choice.refused {
            return Row::of(&[&choice.name(), &format!("not run: {why}")]);
        }
        let mut cells = vec![choice.name().to_owned()];
        let or_none =
            |value: Option<f64>, width| value.map_or("-".to_owned(), |value| number(value, width));
        cells.extend(choice.errors.iter().map(|error| or_none(*error, 9)));
        let over = choice.time.as_ref().zip(least).and_then(|(time, least)| time.over(least));
        cells.extend(match choice.time.as_ref().zip(over) {
            Some((time, over)) => {
                let spread = time.spread();
                let [low, high] = [spread.low, spread.high].map(ms);
                [ms(spread.median), format!("{low}-{high}"), over.to_string()]
            }
            None => Default::default(),
        });
        cells.push(or_none(choice.bytes.map(|bytes| bytes as f64 / 1e6), 7));
        cells.push(choice.choice.about.to_string());
        cells.into()
    };
    let mut columns = table::columns("~choice 23");
    columns.extend(group.measures.iter().map(|m| Column::numbers(&m.short, &m.title).least(9)));
    columns.extend(table::columns(
        ">ms 7 of processor time, median | >quartiles 13 a quarter of the rounds took less, a quarter more, in ms \
         | >times 16 the cheapest, with an interval | >MB 6 at the peak, from the sizes of its buffers; the scene is not in it | how",
    ));
    let part = |part: Part| match part.is_all() {
        true => thousands(part.of),
        false => format!("a sample of {} of {}", thousands(part.part), thousands(part.of)),
    };
    let [items, pixels] = [group.timed, group.timed_pixels].map(part);
    let caption = format!("{}, ms for {items} triangles and {pixels} pixels", group.title);
    let measures = group.measures.iter();
    let mut notes: Vec<_> = measures.map(|m| format!("{}: {}", m.short, m.title)).collect();
    notes.push(format!("times: {CELLS}"));
    notes.extend(group.choices.iter().filter_map(|choice| {
        let wall = choice.time.as_ref()?.wall_ns?;
        Some(format!("{}: {} ms pass meanwhile, on all threads", choice.name(), ms(wall)))
    }));
    let noise = least.and_then(Times::noise);
    notes
        .extend(noise.map(|noise| {
            format!("two equal passes in the same rounds: {:.3} times", noise.median)
        }));
    notes.extend(advice(subject, group));
    Table::of(&caption, columns, group.choices.iter().map(row).collect()).noted(notes)
}
