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
use super::html::{Outcome, PictureLayer, PictureView, Report};
use super::summary::thousands;
use super::table::{Column, Table};

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
    let mut out = match found.cases.len() {
        0 => "hard cases: none\n".to_owned(),
        _ => hard_table(subject, found, costs).text([2, 4]),
    };
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
        let table = cost_table(group);
        let _ = write!(out, "{}\n{}", table.caption, table.text([2, 4]));
        for line in advice(subject, group) {
            let _ = writeln!(out, "  {line}");
        }
        if group.not_judged > 0 {
            let count = thousands(group.not_judged);
            let why = "single precision does not hold a value or 1/w of a corner";
            let _ = writeln!(out, "  not judged: {count} pieces, since {why}");
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
            "not_judged": group.not_judged,
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
    let mut out = needs_table(needs, true).text([2, 4]);
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
    tables.extend([true, false].map(|is_called_for| needs_table(found.needs, is_called_for)));
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
        let (mut place, command) = match case.triangles.first() {
            Some(&triangle) => (subject.place(triangle), subject.command(triangle)),
            None => (String::new(), String::new()),
        };
        if !case.note.is_empty() {
            let _ = write!(place, "; {}", case.note);
        }
        let wrong = match wrong_on(found, case.kind, costs).as_slice() {
            [] => String::new(),
            rungs => format!("wrong on such triangles:\n  {}", rungs.join("\n  ")),
        };
        let [count, pixels] = [case.count, case.pixels].map(thousands);
        let (kind, about) = (case.kind.name().to_owned(), case.kind.about().to_owned());
        vec![kind, count, pixels, about, place, command, wrong].into()
    };
    Table {
        caption: match compared_in(costs) {
            Some(words) => format!("Hard cases; {words}"),
            None => "Hard cases".to_owned(),
        },
        columns: vec![
            Column::words("kind").short("hard cases").least(32),
            Column::numbers("count", "how many there are").least(11),
            Column::numbers("pixels", "pixels of the picture that they touch").least(13),
            Column::words("what one sees"),
            Column::words("where"),
            Column::words("command"),
            Column::words("rungs"),
        ],
        rows: found.cases.iter().map(row).collect(),
    }
}

/// The effects that are called for, or those that are not.
fn needs_table(needs: &Needs, is_called_for: bool) -> Table {
    let row = |need: &Need| {
        let time = takes(needs, need).map_or("noise".to_owned(), |ms| number(ms, 9));
        let pixels = need.pixels.map_or("-".to_owned(), thousands);
        let (name, wrong) = (need.effect.name().to_owned(), thousands(need.wrong));
        let who = by_whom(need);
        let who = if who.is_empty() { who } else { format!("by {who}") };
        vec![name, pixels, wrong, time, who, reasons(need)].into()
    };
    let is_here = |need: &&Need| need.is_called_for == is_called_for;
    let not = if is_called_for { "" } else { "not " };
    Table {
        caption: format!("Effects {not}called for"),
        columns: vec![
            Column::words("effect").short("effects called for").least(18),
            Column::numbers("pixels", "pixels that pay for it").least(13),
            Column::numbers("wrong without", "pixels that change when it is switched off")
                .least(17),
            Column::numbers("takes ms", "what it takes of a planned frame").least(11),
            Column::words("by"),
            Column::words("why"),
        ],
        rows: needs.needs.iter().filter(is_here).map(row).collect(),
    }
}

fn cost_table(group: &Group) -> Table {
    let least = group.cheapest(&|_| true).and_then(|best| group.choices[best].time);
    let row = |choice: &Choice| {
        let mut cells = vec![choice.name.clone()];
        if let Some(why) = &choice.refused {
            cells.push(format!("not run: {why}"));
            return cells.into();
        }
        let or_none =
            |value: Option<f64>, width| value.map_or("-".to_owned(), |value| number(value, width));
        cells.extend(choice.errors.iter().map(|error| or_none(*error, 9)));
        cells.extend(match choice.time.zip(least) {
            Some((time, least)) => {
                let [low, median, high] =
                    [time.low, time.median, time.high].map(|ns| number(ns / 1e6, 7));
                [median, format!("{low}-{high}"), number(time.median / least.median, 6)]
            }
            None => Default::default(),
        });
        cells.push(or_none(choice.bytes.map(|bytes| bytes as f64 / 1e6), 7));
        cells.into()
    };
    let mut columns = vec![Column::words("choice").short("").least(23)];
    columns.extend(group.measures.iter().map(|m| Column::numbers(m.short, m.title).least(9)));
    let quartiles = "a quarter of the rounds took less, a quarter more, in ms";
    let bytes = "at the peak, from the sizes of its buffers; the scene is not in it";
    columns.extend([
        Column::numbers("ms", "median").least(7),
        Column::numbers("quartiles", quartiles).least(13),
        Column::numbers("times", "times the cheapest").least(6),
        Column::numbers("MB", bytes).least(6),
    ]);
    let [items, pixels] = group.timed.map(thousands);
    let caption = format!("{}, ms for {items} triangles and {pixels} pixels", group.title);
    Table { caption, columns, rows: group.choices.iter().map(row).collect() }
}
