//! A study of a model as text and as JSON.

use std::fmt::Write as _;

use image::{Rgb, RgbImage};
use rasterproof_host::text::printable_short;
use rasterproof_models::Origin;
use rasterproof_render::scene::Scene;
use rasterproof_study::cost::{Choice, Group};
use rasterproof_study::effects::{Fineness, Need, Needs};
use rasterproof_study::hard::{HardCase, HardCases, Kind};
use rasterproof_study::ties::{Class, Classes, TiedPair};
use rasterproof_study::{face_of, triangle_of};
use serde_json::{Value, json};

use super::board::number;
use super::chapter::Chapter;
use super::html::{Column, Outcome, PictureLayer, PictureView, Report, Row, Table};
use super::summary::thousands;

#[derive(Clone, Copy)]
pub struct Subject<'a> {
    pub scene: &'a Scene,
    pub origins: &'a [Origin],
    /// The command that shows a face, by its number from 1.
    pub inspect: &'a dyn Fn(u32) -> String,
}

impl Subject<'_> {
    /// Where a triangle is, in words.
    pub fn place(&self, triangle: u32) -> String {
        let place = triangle_of(self.scene, triangle)
            .and_then(|(item, number)| Some(self.origins.get(item)?.place(number)));
        place.unwrap_or_else(|| format!("triangle {}", u64::from(triangle) + 1))
    }

    pub fn command(&self, triangle: u32) -> String {
        (self.inspect)(face_of(self.scene, self.origins, triangle))
    }
}

/// By ladder the rungs that get triangles of a kind wrong, with how many samples.
fn wrong_on(found: &HardCases, kind: Kind, costs: &[Group]) -> Vec<String> {
    let of_group = |group: &Group| {
        let of_choice = |choice: &Choice| {
            let of_kind = |pair: &[u32; 2]| pair.iter().any(|one| found.is(*one, kind));
            let of_kind = choice.wrong.iter().filter(|(pair, _)| of_kind(pair));
            let count: u64 = of_kind.map(|(_, count)| count).sum();
            (count > 0).then(|| format!("{} {}", choice.name, thousands(count)))
        };
        let wrong: Vec<String> = group.choices.iter().filter_map(of_choice).collect();
        let unit = group.measures.iter().find_map(|measure| measure.unit).unwrap_or("px");
        (!wrong.is_empty()).then(|| format!("{} ({unit}): {}", group.title, wrong.join(", ")))
    };
    costs.iter().filter_map(of_group).collect()
}

/// In how many pixels of hard cases values were compared; nothing where in all of them.
fn compared_in(costs: &[Group]) -> Option<String> {
    let [some, all] = costs.iter().find_map(|group| group.looked_at)?;
    (some < all).then(|| {
        let [some, all] = [some, all].map(thousands);
        format!("values were compared in {some} of the {all} px of these faces")
    })
}

pub fn hard_cases(subject: &Subject<'_>, found: &HardCases, costs: &[Group]) -> String {
    let mut out = String::new();
    if found.cases.is_empty() {
        out += "hard cases: none\n";
    } else {
        let _ = writeln!(out, "{:<32}{:>12}{:>14}", "hard cases", "count", "pixels");
    }
    for case in &found.cases {
        let (count, pixels) = (thousands(case.count), thousands(case.pixels));
        let _ = writeln!(out, "  {:<30}{count:>12}{pixels:>14}", case.kind.name());
        let _ = writeln!(out, "    {}", case.kind.about());
        let Some(&face) = case.triangles.first() else { continue };
        let note = if case.note.is_empty() { String::new() } else { format!("; {}", case.note) };
        let _ = writeln!(out, "    {}{note}", subject.place(face));
        let _ = writeln!(out, "    {}", subject.command(face));
        let wrong = wrong_on(found, case.kind, costs);
        if !wrong.is_empty() {
            out += "    wrong on such triangles:\n";
        }
        for line in wrong {
            let _ = writeln!(out, "      {line}");
        }
    }
    let missing: Vec<&str> = Kind::ALL
        .into_iter()
        .filter(|kind| found.cases.iter().all(|case| case.kind != *kind))
        .map(Kind::name)
        .collect();
    if let Some(line) = compared_in(costs) {
        let _ = writeln!(out, "{line}");
    }
    if !missing.is_empty() && !found.cases.is_empty() {
        let _ = writeln!(out, "none: {}", missing.join(", "));
    }
    if found.is_cut_short {
        out +=
            "the model is so large that overlaps and T-junctions were looked for in a part of it\n";
    }
    if let Some([near, far]) = found.w {
        let _ = writeln!(out, "w in the window: {near:.3e} to {far:.3e}");
    }
    if found.f32_pixels > 0 {
        let pixels = thousands(found.f32_pixels);
        let _ = writeln!(out, "positions rounded to f32 change {pixels} px of the picture");
    }
    out
}

pub fn hard_cases_json(subject: &Subject<'_>, found: &HardCases) -> Value {
    let face = |&triangle: &u32| {
        let origin = triangle_of(subject.scene, triangle)
            .and_then(|(item, number)| Some((subject.origins.get(item)?, number)));
        json!({
            "face": face_of(subject.scene, subject.origins, triangle),
            "line": origin.and_then(|(origin, number)| origin.lines.get(number)),
            "part": origin.map(|(origin, _)| &origin.part),
            "material": origin.map(|(origin, _)| &origin.material),
            "command": subject.command(triangle),
        })
    };
    let cases = found.cases.iter().map(|case| {
        json!({
            "kind": case.kind.name(),
            "count": case.count,
            "pixels": case.pixels,
            "note": case.note,
            "faces": case.triangles.iter().map(face).collect::<Vec<_>>(),
        })
    });
    json!({
        "cases": cases.collect::<Vec<_>>(),
        "w": found.w,
        "f32_pixels": found.f32_pixels,
        "is_cut_short": found.is_cut_short,
    })
}

fn ms(ns: f64) -> String {
    number(ns / 1e6, 9)
}

/// What each choice costs, by group; and what to choose.
pub fn costs(subject: &Subject<'_>, groups: &[Group]) -> String {
    let mut out = String::new();
    for group in groups {
        let [items, pixels] = group.timed.map(thousands);
        let _ = writeln!(out, "{}, ms for {items} triangles and {pixels} pixels", group.title);
        let _ = write!(out, "{:23}", "");
        for measure in &group.measures {
            let _ = write!(out, "{:>10}", measure.short);
        }
        let _ = writeln!(out, "{:>8} {:>13}{:>7}{:>7}", "ms", "quartiles", "times", "MB");
        let least = group.cheapest(&|_| true).and_then(|best| group.choices[best].time);
        for choice in &group.choices {
            let _ = write!(out, "  {:21}", choice.name);
            if let Some(why) = &choice.refused {
                let _ = writeln!(out, " not run: {why}");
                continue;
            }
            for error in &choice.errors {
                let text = error.map_or("-".to_owned(), |error| number(error, 9));
                let _ = write!(out, "{text:>10}");
            }
            if let (Some(time), Some(least)) = (choice.time, least) {
                let [low, high] = [time.low, time.high].map(|ns| number(ns / 1e6, 7));
                let times = number(time.median / least.median, 6);
                let range = format!("{low}-{high}");
                let _ = write!(out, "{:>8} {range:>13}{times:>7}", number(time.median / 1e6, 7));
            }
            let bytes = choice.bytes.map_or("-".to_owned(), |bytes| number(bytes as f64 / 1e6, 7));
            let _ = write!(out, "{bytes:>7}");
            out.push('\n');
        }
        for line in advice(subject, group) {
            let _ = writeln!(out, "  {line}");
        }
        out.push('\n');
    }
    out
}

/// The cheapest exact choice of a group, and what is said of those that are cheaper and wrong, or exact by chance.
pub fn advice(subject: &Subject<'_>, group: &Group) -> Vec<String> {
    let mut lines = Vec::new();
    let mut limit = f64::INFINITY;
    for (number, measure) in group.measures.iter().enumerate() {
        let Some(best) = group.cheapest_exact(number) else {
            lines.push(format!("none is exact ({})", measure.short));
            continue;
        };
        let choice = &group.choices[best];
        lines.push(format!("cheapest exact ({}): {}", measure.short, choice.name));
        lines.extend(compared(group, number));
        limit = limit.min(choice.time.map_or(f64::INFINITY, |time| time.median));
    }
    for choice in &group.choices {
        let is_cheaper = choice.time.is_some_and(|time| time.median < limit);
        let goal = |i: usize| group.measures[i].goal.unwrap_or(f64::INFINITY);
        let mut errors = choice.errors.iter().enumerate();
        let is_wrong = errors.all(|(i, error)| error.is_some_and(|error| error > goal(i)));
        match (choice.margin, choice.first_wrong) {
            (Some(margin), _) if !is_wrong && choice.refused.is_none() => {
                let luck = if margin < 1.0 { ", so it was lucky" } else { "" };
                lines.push(format!(
                    "{} is exact here; the smallest margin is {} times its error bound{luck}",
                    choice.name,
                    number(margin, 9)
                ));
            }
            (_, Some((triangle, [x, y])))
                if is_wrong && (is_cheaper || choice.margin.is_some()) =>
            {
                let cheaper = if is_cheaper { "cheaper and " } else { "" };
                let mut line = format!("{} is {cheaper}wrong, first at {x},{y}", choice.name);
                if let Some(triangle) = triangle {
                    let _ = write!(line, ": {}", subject.place(triangle));
                    lines.push(line);
                    lines.push(format!("  {}", subject.command(triangle)));
                } else {
                    lines.push(line);
                }
            }
            _ => {}
        }
    }
    lines
}

/// Which choices are as fast as the cheapest exact one, and which may be; nothing where it is the only one.
fn compared(group: &Group, measure: usize) -> Vec<String> {
    let Some(Some(best)) = group.best.get(measure) else { return Vec::new() };
    let names = |all: &[usize]| {
        all.iter().map(|one| &*group.choices[*one].name).collect::<Vec<_>>().join(", ")
    };
    let mut lines = Vec::new();
    if !best.equal.is_empty() {
        lines.push(format!("  equally fast within 3%: {}", names(&best.equal)));
    }
    if !best.undecided.is_empty() {
        let (rounds, others) = (best.rounds, names(&best.undecided));
        lines.push(format!("  undecided after {rounds} rounds, within 3% or not: {others}"));
    }
    lines
}

pub fn costs_json(subject: &Subject<'_>, groups: &[Group]) -> Value {
    let group = |group: &Group| {
        let choice = |choice: &Choice| {
            let first = choice.first_wrong.map(|(of, [x, y])| {
                let face = of.map(|triangle| face_of(subject.scene, subject.origins, triangle));
                json!({ "pixel": [x, y], "face": face })
            });
            let time = choice.time.map(|time| [time.low, time.median, time.high]);
            let measures = 0..group.measures.len();
            let exact: Vec<_> = measures.filter(|one| group.is_exact(choice, *one)).collect();
            json!({
                "name": choice.name,
                "about": choice.about,
                "errors": choice.errors,
                "exact": exact,
                "first_wrong": first,
                "margin": choice.margin.filter(|margin| margin.is_finite()),
                "time_ns": time,
                "bytes": choice.bytes,
                "refused": choice.refused,
            })
        };
        let measures: Vec<_> = group.measures.iter().map(|measure| measure.title).collect();
        let name = |number: usize| group.choices[number].name.clone();
        let best = (0..measures.len()).map(|number| group.cheapest_exact(number).map(name));
        let names = |all: &[usize]| all.iter().map(|&number| name(number)).collect::<Vec<_>>();
        let compared = group.best.iter().map(|best| {
            best.as_ref().map(|best| {
                json!({
                    "choice": name(best.choice),
                    "equally_fast": names(&best.equal),
                    "undecided": names(&best.undecided),
                    "rounds": best.rounds,
                })
            })
        });
        json!({
            "title": group.title,
            "measures": measures,
            "timed": { "triangles": group.timed[0], "pixels": group.timed[1] },
            "choices": group.choices.iter().map(choice).collect::<Vec<_>>(),
            "cheapest_exact": best.collect::<Vec<_>>(),
            "compared": compared.collect::<Vec<_>>(),
        })
    };
    groups.iter().map(group).collect()
}

/// How it is decided which surface is seen, as text.
pub fn ties(subject: &Subject<'_>, classes: &Classes) -> String {
    let [decided, by_rounding, equal] =
        [classes.decided, classes.by_rounding, classes.equal].map(thousands);
    let mut out = format!(
        "which surface is seen, before corners are snapped: decided in {decided} px,\n  \
         by rounding alone in {by_rounding} px, equal in {equal} px (see docs/ties.md)\n"
    );
    for (what, pair) in [("by rounding", classes.first_by_rounding), ("equal", classes.first_equal)]
    {
        let Some(TiedPair { pixel: [x, y], triangles }) = pair else { continue };
        let [a, b] = triangles.map(|triangle| subject.place(triangle));
        let _ = writeln!(out, "  {what} first at {x},{y}: {a} and {b}");
    }
    out
}

/// Milliseconds that an effect takes of a planned frame; none within the noise.
fn takes(needs: &Needs, need: &Need) -> Option<f64> {
    let (planned, without) = (needs.planned, need.otherwise);
    (need.is_called_for && planned.low > without.high)
        .then(|| (planned.median - without.median) / 1e6)
}

/// The materials that call for an effect, the most visible first.
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
    names.join(", ")
}

fn reasons(need: &Need) -> String {
    let reasons: Vec<_> = need.reasons.iter().map(|(reason, _)| reason.as_str()).collect();
    reasons.join("; ")
}

/// What a scene calls for, as text; `not_drawn` is what its file asks for besides.
pub fn needs(needs: &Needs, not_drawn: &str) -> String {
    let mut out = format!(
        "{:<17}{:>14}{:>18}{:>12}\n",
        "effects called for", "pixels", "wrong without", "takes ms"
    );
    for need in needs.needs.iter().filter(|need| need.is_called_for) {
        let pixels = need.pixels.map_or("-".to_owned(), thousands);
        let time = takes(needs, need).map_or("noise".to_owned(), |ms| number(ms, 9));
        let (name, wrong) = (need.effect.name(), thousands(need.wrong));
        let _ = writeln!(out, "  {name:<16}{pixels:>14}{wrong:>18}{time:>12}");
        let who = by_whom(need);
        if !who.is_empty() {
            let _ = writeln!(out, "    by {who}");
        }
        let _ = writeln!(out, "    {}", reasons(need));
    }
    for need in needs.needs.iter().filter(|need| !need.is_called_for) {
        let _ = writeln!(out, "not called for: {}: {}", need.effect.name(), reasons(need));
        if need.wrong > 0 {
            let _ = writeln!(out, "    but {} px change without it", thousands(need.wrong));
        }
    }
    if !not_drawn.is_empty() {
        let _ = writeln!(out, "called for and not supported: {not_drawn}");
    }
    for line in effects_advice(needs) {
        let _ = writeln!(out, "{line}");
    }
    out
}

/// What follows from the effects, a sentence each.
pub fn effects_advice(needs: &Needs) -> Vec<String> {
    let mut lines = Vec::new();
    let idle: Vec<_> = needs
        .needs
        .iter()
        .filter(|need| !need.is_called_for && need.otherwise.low > needs.planned.high)
        .map(|need| {
            let more = need.otherwise.median / needs.planned.median - 1.0;
            format!("{} {:.0}%", need.effect.name(), 100.0 * more)
        })
        .collect();
    if !idle.is_empty() {
        lines.push(format!(
            "not called for, and if they were paid for all the same, the frame would take more: {}",
            idle.join(", ")
        ));
    }
    let time = |name: &str| {
        let found = needs.antialiasing.iter().find(|(other, _)| *other == name);
        found.map(|(_, ns)| *ns)
    };
    for texture in &needs.textures {
        let name = printable_short(&texture.material, 40);
        let mut line = format!("texture of {name}: {} texels a pixel", number(texture.texels, 9));
        for (antialiasing, far) in &texture.far {
            let share = 100.0 * *far as f64 / texture.pixels.max(1) as f64;
            let _ =
                write!(line, "; {antialiasing} leaves {share:.1}% of its pixels far from ssaa8");
            if let (Some(one), Some(this)) = (time("none"), time(antialiasing))
                && *antialiasing != "none"
            {
                let _ = write!(line, " and takes {:.1} times the time", this / one);
            }
        }
        lines.push(line);
    }
    lines
}

pub fn needs_json(needs: &Needs, not_drawn: &str) -> Value {
    let one = |need: &Need| {
        json!({
            "effect": need.effect.name(),
            "called_for": need.is_called_for,
            "materials": need.materials,
            "reasons": need.reasons,
            "pixels": need.pixels,
            "wrong_without": need.wrong,
            "otherwise_ns": [need.otherwise.low, need.otherwise.median, need.otherwise.high],
        })
    };
    let texture = |texture: &Fineness| {
        json!({
            "material": texture.material,
            "pixels": texture.pixels,
            "texels": texture.texels,
            "far": texture.far,
        })
    };
    json!({
        "effects": needs.needs.iter().map(one).collect::<Vec<_>>(),
        "planned_ns": [needs.planned.low, needs.planned.median, needs.planned.high],
        "textures": needs.textures.iter().map(texture).collect::<Vec<_>>(),
        "not_supported": not_drawn,
    })
}

pub fn ties_json(classes: &Classes) -> Value {
    json!({
        "decided": classes.decided,
        "by_rounding": classes.by_rounding,
        "equal": classes.equal,
    })
}

pub struct Found<'a> {
    pub hard: &'a HardCases,
    pub classes: &'a Classes,
    pub needs: &'a Needs,
    pub costs: &'a [Group],
    pub not_drawn: &'a str,
}

#[must_use]
pub fn page(subject: &Subject<'_>, found: &Found<'_>, command: &str) -> Report {
    let cases = &found.hard.cases;
    let sentence = match cases.len() {
        0 => "No hard case was found in this view.".to_owned(),
        1 => "One kind of hard case was found.".to_owned(),
        count => format!("{count} kinds of hard cases were found."),
    };
    let called_for = found.needs.needs.iter().filter(|need| need.is_called_for).count();
    let frame = found.costs.last().and_then(|frames| {
        let choice = &frames.choices[frames.cheapest_exact(0)?];
        Some(format!(" The cheapest exact frame: {}, {} ms.", choice.name, ms(choice.time?.median)))
    });
    let sentence = format!(
        "{sentence} Of {} effects {called_for} are called for.{}",
        found.needs.needs.len(),
        frame.unwrap_or_default()
    );
    let mut tables = Vec::new();
    if !cases.is_empty() {
        tables.push(hard_table(subject, found.hard, found.costs));
    }
    tables.push(needs_table(found.needs));
    let mut notes = vec![
        ties(subject, found.classes).replace('\n', " "),
        "A face is shown by the command beside it; the same judgements alone: verify and cost with \
         the file."
            .to_owned(),
    ];
    notes.extend(effects_advice(found.needs));
    if !found.not_drawn.is_empty() {
        notes.push(format!("Called for and not supported: {}.", found.not_drawn));
    }
    for group in found.costs {
        tables.push(cost_table(group));
        let advice = advice(subject, group);
        notes.push(format!("{}: {}.", group.title, advice.join("; ")));
    }
    let picture = super::frame_comparison::rgb(&found.hard.picture);
    let marked = RgbImage::from_fn(picture.width(), picture.height(), |x, y| {
        match found.hard.touches(x as i32, y as i32) {
            true => Rgb([230, 60, 40]),
            false => Rgb(picture.get_pixel(x, y).0.map(|channel| channel / 2)),
        }
    });
    let decided = RgbImage::from_fn(picture.width(), picture.height(), |x, y| {
        match found.classes.map.get(x as i32, y as i32).unwrap_or_default() {
            Class::Empty => Rgb([18, 18, 24]),
            Class::Decided => Rgb([120, 130, 140]),
            Class::ByRounding => Rgb([240, 150, 40]),
            Class::Equal => Rgb([190, 80, 220]),
        }
    });
    Report {
        title: format!("A study of {}", subject.scene.name),
        outcome: Some(Outcome {
            good: cases.is_empty(),
            word: if cases.is_empty() { "CLEAN" } else { "HARD CASES" }.to_owned(),
            sentence,
        }),
        command: command.to_owned(),
        notes,
        tables,
        frames: vec![PictureView {
            name: subject.scene.name.clone(),
            about:
                "The picture; pixels that hard cases touch, in red; where rounding alone decides \
                    which surface is seen, in orange, and where depths are equal, in violet."
                    .to_owned(),
            command: command.to_owned(),
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

fn hard_table(subject: &Subject<'_>, found: &HardCases, costs: &[Group]) -> Table {
    let row = |case: &HardCase| {
        let (place, command) = match case.triangles.first() {
            Some(&triangle) => (subject.place(triangle), subject.command(triangle)),
            None => (String::new(), String::new()),
        };
        let cells = vec![
            case.kind.name().to_owned(),
            thousands(case.count),
            thousands(case.pixels),
            case.kind.about().to_owned(),
            wrong_on(found, case.kind, costs).join("; "),
            if case.note.is_empty() { place } else { format!("{place}; {}", case.note) },
            command,
        ];
        Row { cells, ..Row::default() }
    };
    Table {
        caption: match compared_in(costs) {
            Some(words) => format!("Hard cases; {words}"),
            None => "Hard cases".to_owned(),
        },
        columns: vec![
            Column::words("kind"),
            Column::numbers("count", "how many there are"),
            Column::numbers("pixels", "pixels of the picture that they touch"),
            Column::words("what one sees"),
            Column::words("rungs that are wrong there"),
            Column::words("where"),
            Column::words("command"),
        ],
        rows: found.cases.iter().map(row).collect(),
    }
}

fn needs_table(needs: &Needs) -> Table {
    let row = |need: &Need| {
        let time = takes(needs, need).map_or("noise".to_owned(), |ms| number(ms, 9));
        let cells = vec![
            need.effect.name().to_owned(),
            if need.is_called_for { "yes" } else { "no" }.to_owned(),
            need.pixels.map_or("-".to_owned(), thousands),
            thousands(need.wrong),
            time,
            by_whom(need),
            reasons(need),
        ];
        Row { cells, ..Row::default() }
    };
    Table {
        caption: "Effects".to_owned(),
        columns: vec![
            Column::words("effect"),
            Column::words("called for"),
            Column::numbers("pixels", "pixels that pay for it"),
            Column::numbers("wrong", "pixels that change when it is switched off"),
            Column::numbers("ms", "what it takes of a planned frame"),
            Column::words("by"),
            Column::words("why"),
        ],
        rows: needs.needs.iter().map(row).collect(),
    }
}

fn cost_table(group: &Group) -> Table {
    let has_bytes = group.choices.iter().any(|choice| choice.bytes.is_some());
    let least = group.cheapest(&|_| true).and_then(|best| group.choices[best].time);
    let row = |choice: &Choice| {
        let mut cells = vec![choice.name.clone()];
        let error = |error: &Option<f64>| error.map_or("-".to_owned(), |error| number(error, 9));
        match &choice.refused {
            Some(why) => {
                cells.push(format!("not run: {why}"));
                cells.resize(group.measures.len() + 1, String::new());
            }
            None => cells.extend(choice.errors.iter().map(error)),
        }
        let time = choice.time.zip(least);
        cells.push(time.map_or(String::new(), |(time, _)| ms(time.median)));
        cells.push(time.map_or(String::new(), |(t, _)| format!("{}-{}", ms(t.low), ms(t.high))));
        cells.push(time.map_or(String::new(), |(t, l)| format!("{:.2}", t.median / l.median)));
        if has_bytes {
            cells.push(choice.bytes.map_or(String::new(), thousands));
        }
        Row { cells, ..Row::default() }
    };
    let mut columns = vec![Column::words("choice")];
    columns.extend(group.measures.iter().map(|m| Column::numbers(m.short, m.title)));
    columns.extend([
        Column::numbers("ms", "median"),
        Column::numbers("quartiles", "a quarter of the rounds took less, a quarter more, in ms"),
        Column::numbers("times", "times the cheapest"),
    ]);
    if has_bytes {
        columns.push(Column::numbers(
            "bytes",
            "at the peak, from the sizes of its buffers; the scene is not in it",
        ));
    }
    let [items, pixels] = group.timed.map(thousands);
    let caption = format!("{}, timed on {items} triangles and {pixels} pixels", group.title);
    Table { caption, columns, rows: group.choices.iter().map(row).collect() }
}
