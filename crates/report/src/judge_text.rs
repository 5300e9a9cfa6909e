//! The verdict on a program that was judged through the line protocol, on two that were compared, and on a tessellator.

use std::fmt::Display;

use super::html::{Chapter, Excerpt, Outcome, Report, Statement};
use super::json;
use super::table::{Row, Table};
use super::text::SCREEN;
use super::words::{count, of_bound, same, thousands};
use super::{page_cases, summary};
use rasterproof_judge::against;
use rasterproof_judge::ask::{Breach, Complaints};
use rasterproof_judge::changes::Changes;
use rasterproof_judge::check::{Check, Counted};
use rasterproof_judge::declared::Declared;
use rasterproof_judge::failures::{Exchange, Exchanged, Failure};
use rasterproof_judge::pictured::Pictured;
use rasterproof_judge::polygons;
use rasterproof_judge::recognise::Why;
use rasterproof_judge::run::{
    MOST_DEATHS, MOST_DEATHS_IN_ALL, MOST_HANGS_IN_ALL, Row as FamilyRow, RunFindings, Sides,
};
use rasterproof_judge::verdict::{self, Count, Score, Scores as _, Verdict, per_million};
use rasterproof_verify::comparison::Tally;
use rasterproof_verify::judge::ascii;
use rasterproof_verify::partition::{self, Polygon};

/// Requests of a failing case that are shown.
const MOST_EXCHANGES: usize = 3;
/// Times that one kind of misbehaviour is shown.
const MOST_INCIDENTS: usize = 2;

/// The verdict as a terminal shows it: the answer, what each program says of itself, the smallest failing cases, why it is wrong, a row for each
/// danger, both scores, and the table of families where something is wrong or it is asked for.
pub fn report(
    verdict: &Verdict,
    repeat_all: &str,
    repeat: &dyn Fn(&str, u64) -> String,
    with_table: bool,
) -> Report {
    let (d, agrees) = (&verdict.more.declared, verdict.agrees());
    let names = names(verdict);
    // Who judged, and what each program says of itself.
    let mut about = vec![by(verdict.options.seed)];
    if let (Some([first, second]), Some(other)) = (&names, &verdict.more.against) {
        about.extend([speaks(first, d), speaks(second, other)]);
        about.push("asked is what both can answer; each is judged by what it declares".to_owned());
    } else {
        about.push(speaks(&d.name, d));
    }
    if let Some(reach) = verdict.more.reach {
        let most = thousands(reach.unsigned_abs().into());
        about.push(format!(
            "it walks along its lines, so lines of at most {most} steps are asked for"
        ));
    }
    // What is left out, why it is wrong, and what follows from that, in the order in which it is read.
    let mut first_screen: Vec<Table> = Vec::new();
    let left_out = verdict.more.left_out.to_string();
    if !left_out.is_empty() {
        first_screen.push(Table::of_notes("", vec![left_out]));
    }
    first_screen.extend(verdict.cause.iter().map(cause));
    match &names {
        Some(names) => first_screen.extend([who_is_right(&verdict.sides(), names), sides(verdict)]),
        None => {
            first_screen.extend([dangers(verdict), scores(verdict)]);
            if with_table || !agrees {
                first_screen.push(families(verdict));
            } else if let Some(last) = first_screen.last_mut() {
                last.notes.push("every family as a table: add --table".to_owned());
            }
        }
    }
    first_screen.extend(summary::asked(&verdict.more.asked));
    // What a baseline knows is counted, and not shown.
    if verdict.more.known > 0 {
        let known = thousands(verdict.more.known);
        let note = format!("not shown: {known} failing cases that the baseline knows");
        first_screen.push(Table::of_notes("", vec![note]));
    }
    // The report is put together from what was made above.
    let title = match &names {
        Some([first, second]) => format!("{first} against {second}"),
        None => format!("Verdict on {}", d.name),
    };
    Report {
        title,
        about: about.join("\n"),
        outcome: Some(outcome(verdict, names.as_ref())),
        excerpts: excerpts(verdict, repeat, None).into_iter().chain(complaints(verdict)).collect(),
        tables: first_screen.iter().cloned().chain([properties(verdict)]).collect(),
        first_screen,
        repeat: repeat_all.to_owned(),
        ..Report::default()
    }
}

/// The same with what JSON and a page hold beside it: everything that was found, and each failing case as it is drawn.
pub fn whole(
    verdict: &Verdict,
    repeat_all: &str,
    repeat: &dyn Fn(&str, u64) -> String,
    with_table: bool,
) -> Report {
    Report {
        cases: views(verdict, repeat),
        data: json::judgement(verdict, repeat_all, repeat),
        ..report(verdict, repeat_all, repeat, with_table)
    }
}

/// The verdict on a program that is judged whenever it changes, short enough for a screen: what is wrong or has changed, and one failing
/// case.
pub fn watched(
    verdict: &Verdict,
    faults: &[String],
    changes: Option<&Changes>,
    repeat_all: &str,
    repeat: &dyn Fn(&str, u64) -> String,
) -> Report {
    let mut answers = Vec::new();
    let mut say = |about: &'static str, what: &[String]| {
        if !what.is_empty() {
            answers.push(Statement { about, sentence: what.join("; "), command: String::new() });
        }
    };
    match changes {
        None => say("wrong:", faults),
        Some(changes) => {
            say("mended:", &changes.mended);
            say("still:", &changes.still);
            say("new:", &changes.new);
            let Changes { right_now, still_wrong, wrong_now, .. } = changes;
            let counts = [
                (right_now, "that failed are right"),
                (still_wrong, "still fail"),
                (wrong_now, "that were right fail"),
            ];
            let mut said = Vec::new();
            for (count, what) in counts {
                if *count > 0 {
                    said.push(format!("{} {what}", thousands(*count)));
                }
            }
            say("cases:", &said);
        }
    }
    // One case is enough to go on with.
    let mut excerpts = excerpts(verdict, repeat, None);
    let more = excerpts.len().saturating_sub(1);
    excerpts.truncate(1);
    if let Some(first) = excerpts.first_mut().filter(|_| more > 0) {
        first.places.push(("others", format!("{more}, without --watch")));
    }
    Report {
        about: by(verdict.options.seed),
        outcome: Some(outcome(verdict, None)),
        answers,
        excerpts,
        repeat: repeat_all.to_owned(),
        ..Report::default()
    }
}

/// The names of two programs that are compared.
fn names(verdict: &Verdict) -> Option<[String; 2]> {
    let second = verdict.more.against.as_ref()?;
    Some(against::names([&verdict.more.declared, second]))
}

/// Who judged.
fn by(seed: u64) -> String {
    format!("rasterproof {}, seed {seed}", env!("CARGO_PKG_VERSION"))
}

/// The verdict in a word and in a sentence, of one program or of two that are compared.
fn outcome(verdict: &Verdict, names: Option<&[String; 2]>) -> Outcome {
    let (good, name) = (verdict.agrees(), &verdict.more.declared.name);
    if let Some(names) = names {
        let answer = difference(verdict, names);
        return Outcome { answer: answer.clone(), ..Outcome::new(good, same(good), answer) };
    }
    let answer = match good {
        true => format!("{name} is right"),
        false => format!("{name} is not right{}", why_in_short(verdict)),
    };
    Outcome { answer, ..Outcome::of(good, closing(verdict)) }
}

/// The first mistake that is known, or what the convention is, or how it broke the protocol first, after a colon.
fn why_in_short(verdict: &Verdict) -> String {
    if verdict.failures.iter().any(|failure| failure.evidence.changes) {
        return ": its answers change from one time to the next".to_owned();
    }
    if let Some(does) = verdict.cause.iter().find_map(|Why { why, .. }| why.does()) {
        return format!(": it {does}");
    }
    // A convention that says nothing of edges explains whatever happens there. What was learned says more.
    let convention = verdict.more.recognised.as_ref().filter(|found| found.is_explained);
    let mostly = verdict.cause.iter().find_map(|Why { why, .. }| why.mostly_does());
    match (convention, mostly) {
        (Some(found), Some(does)) if found.is_open => format!(": mostly, it {does}"),
        (Some(found), _) => format!(". {}", found.sentences.join(" ")),
        (None, Some(does)) => format!(": mostly, it {does}"),
        (None, None) => {
            // Not wrong pixels but broken rules of the protocol are what is left.
            let incidents = verdict.more.found.incidents.iter().map(|incident| &incident.what);
            let first = incidents.chain(&verdict.more.found.strays).next();
            first.map(|what| format!(": it {}", what.breach.name())).unwrap_or_default()
        }
    }
}

/// Why a property fails, where that is known: what its answers do, the mistake in them, or the convention that explains them.
pub(super) fn why(verdict: &Verdict, property: &str) -> Option<String> {
    if verdict.failures.iter().any(|f| f.evidence.changes && f.evidence.shows(property)) {
        return Some("its answers change from one time to the next".to_owned());
    }
    // Else the cause of the check that the property belongs to.
    let row = verdict.families.iter().find(|row| row.name == property)?;
    let check = row.check?.of_its_cause();
    for of in &verdict.cause {
        if let (true, Some(does)) = (of.check == check, of.why.does()) {
            let who = if of.by.is_empty() { "it" } else { &of.by };
            return Some(format!("{who} {does}"));
        }
    }
    let is_explained = row.recognised_pixels > 0 && row.recognised.total() == 0;
    let convention = verdict.more.recognised.as_ref().filter(|_| is_explained);
    convention.map(|found| found.sentences.join(" "))
}

/// The verdict on a tessellator: what is wrong with the smallest polygons.
pub fn of_polygons(
    declared: &Declared,
    report: &partition::Verdict,
    repeat_all: &str,
    repeat: &dyn Fn(&str, u64) -> String,
) -> Report {
    let (sum, name) = (report.sum(), &declared.name);
    let agrees = sum.wrong == 0;
    let answer = format!("{name} is {}", if agrees { "right" } else { "not right" });
    let about = [by(report.options.seed), speaks(name, declared)].join("\n");
    // The smallest polygons that are wrong, in a terminal's words.
    let mut grid = String::new();
    if !agrees {
        // As most languages write lists.
        let show = |polygon: &Polygon| format!("{:?}", polygon.contours);
        let _ = report.write(&mut grid, &show, repeat);
    }
    // How far it came, and what was found.
    let until = match polygons::is_out_of_time(report) {
        true => format!(", of {} when the time was up", thousands(polygons::of_polygons(report))),
        false => String::new(),
    };
    let found = match agrees {
        true => "all are covered exactly once".to_owned(),
        false => sum.describe(""),
    };
    // What was asked is said where all of it was.
    // How many polygons there were, and how many of them the tessellator took.
    let is_whole = !polygons::is_out_of_time(report) && report.options.only.is_none();
    let has_design = report.families.iter().any(|of| of.family == partition::Family::Design);
    let asked = if is_whole && has_design { vec![polygons::asked(report)] } else { Vec::new() };
    let [polygons, triangles, left_out] =
        [sum.polygons, sum.triangles, sum.left_out].map(thousands);
    let sentence = format!(
        "{polygons} polygons, {triangles} triangles, {left_out} polygons not taken{until}; {found}"
    );
    Report {
        about,
        excerpts: if agrees { Vec::new() } else { vec![Excerpt { grid, ..Excerpt::default() }] },
        repeat: repeat_all.to_owned(),
        first_screen: Vec::from_iter(summary::asked(&asked)),
        tables: Vec::from_iter(summary::asked(&asked)),
        outcome: Some(Outcome { answer, ..Outcome::of(agrees, sentence) }),
        ..Report::default()
    }
}

/// What a program says of itself.
fn speaks(name: &str, declared: &Declared) -> String {
    let said = format!("{name} speaks version {}: {declared}", declared.version);
    match declared.unknown.as_slice() {
        [] => said,
        words => format!("{said}\nnot understood, left aside: {}", words.join(" ")),
    }
}

/// What it said on standard error, also if it is right: how much, what sanitizers found, and the last lines.
fn complaints(verdict: &Verdict) -> Option<Excerpt> {
    let Complaints { lines, shown } = &verdict.more.complaints;
    let title = match shown.len() as u64 {
        all if all == *lines => "its standard error:".to_owned(),
        some => format!("its standard error, {some} of {} lines:", thousands(*lines)),
    };
    let mut grid = String::new();
    for line in shown {
        // A long line is broken, and goes on below itself.
        let parts = match ascii::columns(line) <= SCREEN - 4 {
            true => vec![line.clone()],
            false => ascii::lines(line, SCREEN - 6, ascii::columns),
        };
        grid += &format!("  | {}\n", parts.join("\n  |   "));
    }
    (!shown.is_empty()).then(|| Excerpt { title, grid, ..Excerpt::default() })
}

/// A row for how it keeps the protocol, for its winding, for each danger and for each other check.
fn dangers(verdict: &Verdict) -> Table {
    let is_good =
        |name: &str| verdict.more.properties.iter().all(|p| p.name != name || p.outcome.is_good());
    let mut out = Vec::new();
    let winding = verdict.more.declared.convention.winding.word();
    // These two are of all answers, and of no family.
    for p in &verdict.more.properties {
        let what = match (p.name, p.outcome.is_good()) {
            ("winding", true) => &format!("{winding}, as it declares"),
            ("winding" | "protocol", _) => &p.detail,
            _ => continue,
        };
        out.push(summary::row(p.outcome.is_good(), p.name, what));
    }
    // Families that threaten the same thing are one row.
    let rows = &verdict.families;
    for danger in summary::DANGERS {
        let (mut sum, mut is_right, mut is_judged) = (summary::Sum::default(), true, false);
        for row in rows.iter().filter(|row| danger.families.contains(&row.name)) {
            sum.cases += row.cases;
            sum.wrong_cases += row.wrong_cases;
            sum.tally += row.tally;
            (is_right, is_judged) = (is_right && is_good(row.name), true);
        }
        if is_judged {
            out.push(summary::row(is_right, danger.name, &sum.describe()));
        }
    }
    for row in rows {
        if summary::DANGERS.iter().any(|danger| danger.families.contains(&row.name)) {
            continue;
        }
        // What is right needs no details.
        let what = match row.wrong_cases {
            0 => format!("{}, all right", count(row.cases, "case", "cases")),
            _ => verdict::sentence(row),
        };
        out.push(summary::row(is_good(row.name), row.name, &what));
    }
    summary::judged("", out)
}

/// A score in the words of what it counts.
fn score(what: Counted, of: Score) -> String {
    let share = per_million(of.wrong, of.pixels);
    format!("{} {}, {share:.0} in a million", of.wrong, what.words(of.wrong))
}

/// The score by a convention, with the wrong pixels of the shapes that it leaves out.
fn score_by_convention(of: Score, left_out_wrong: u64) -> String {
    // What a convention leaves open cannot be wrong by it.
    let unscored = match of.unscored {
        0 => String::new(),
        n => format!(
            "; {n} triangles or lines of which it says nothing are left out, with {left_out_wrong} wrong pixels as declared"
        ),
    };
    score(Counted::Pixels, of) + &unscored
}

/// What is wrong as declared: of pixels always, if any were judged; of other things where they are wrong, or nothing else was judged.
/// What answers have between each other comes of the same faults, and has no score.
fn as_declared(verdict: &Verdict) -> Vec<Count> {
    let counts = verdict.counts();
    let draws = counts.iter().any(|count| count.what == Counted::Pixels);
    counts.into_iter().filter(|count| is_shown(count, draws)).collect()
}

/// Whether a count is one of those that are wrong as declared.
fn is_shown(count: &Count, draws: bool) -> bool {
    match count.what {
        Counted::Pixels => true,
        Counted::Changes | Counted::Meshes | Counted::Outlines => false,
        _ => count.score.wrong > 0 || !draws,
    }
}

/// The score as declared and that by the convention that was recognised, with what that convention is.
fn scores(verdict: &Verdict) -> Table {
    let found = match (&verdict.more.recognised, verdict.by_convention()) {
        (None, _) => "the same: no other one was recognised".to_owned(),
        (Some(_), Some(found)) => score_by_convention(found, verdict.left_out_wrong()),
        (Some(_), None) => "unexplained, so there is no score".to_owned(),
    };
    let mut notes = Vec::new();
    // The convention in sentences, and the option by which the program would be judged by it.
    if let Some(recognised) = &verdict.more.recognised {
        notes.extend(recognised.sentences.iter().chain(&recognised.compass).cloned());
        if !recognised.declare.is_empty() {
            // A convention is named in the directions of the program, which may have y up.
            let turned =
                if verdict.more.declared.convention.y_up { " (in its words, y up)" } else { "" };
            let declare = &recognised.declare;
            notes.push(format!("to be judged by it: --declare '{declare}'{turned}"));
        }
    }
    let counts = as_declared(verdict);
    let draws = counts.iter().any(|count| count.what == Counted::Pixels);
    let mut rows: Vec<Row> = Vec::new();
    for Count { what, score: of } in counts {
        let title = if rows.is_empty() { "as declared:" } else { "" };
        rows.push(Row::of(&[&title, &score(what, of)]));
    }
    // A convention is one of pixels.
    if draws || verdict.more.recognised.is_some() {
        rows.push(Row::of(&[&"by its convention:", &found]));
    }
    Table::new("", "~score 22 | ~found 1", rows).noted(notes)
}

/// Why it is wrong, where that was looked for.
fn cause(why: &Why) -> Table {
    let known = if why.why.is_known() { "probable cause" } else { "no cause recognised" };
    Table::of_notes(&format!("{known}, of the wrong {}:", why.whose()), why.why.sentences())
}

/// Every family, with what was wrong.
fn families(verdict: &Verdict) -> Table {
    let columns = "property 18 | >cases 8 | >shapes 8 | >pixels 8 | >missing 8 | >extra 8 | >twice 8 | >order 8 | \
                   >refused 8 | >wrong 7";
    let mut rows = Vec::new();
    for row in by_share(verdict) {
        let FamilyRow { name, cases, shapes, pixels, refused, tally, .. } = row;
        let Tally { missing, extra, twice, order, .. } = tally;
        let share = format!("{:.2}%", 100.0 * row.share());
        let cells: [&dyn Display; 10] =
            [name, cases, shapes, pixels, missing, extra, twice, order, refused, &share];
        rows.push(Row::of(&cells));
    }
    // Below the table, what its columns count where that is not obvious.
    let mut notes = vec![
        "wrong: share of the cases with anything wrong; of meshes, missing are holes".to_owned(),
    ];
    // What other things than pixels are counted, of the checks that were made.
    let mut others = Vec::new();
    for (what, note) in [
        (Counted::Samples, "of four samples, samples are counted"),
        (Counted::Corners, "of the near plane, corners; order are polygons that run the other way"),
        (Counted::Seen, "of depth, order are pixels that show what lies behind"),
    ] {
        let mut checks = verdict.families.iter().filter_map(|row| row.check);
        if checks.any(|check| check.counted() == what) {
            others.push(note);
        }
    }
    if !others.is_empty() {
        notes.push(others.join("; "));
    }
    // How far values were from the exact ones, and who was given up.
    let tolerance = verdict.more.declared.tolerance;
    for FamilyRow { name, values, worst, .. } in verdict.families.iter().filter(|r| r.values > 0) {
        let worst = of_bound(*worst).replace("bound", "tolerance");
        notes.push(format!("{name}: {values} compared, {worst}, which is {tolerance:e}"));
    }
    for FamilyRow { name, .. } in verdict.families.iter().filter(|row| row.stopped) {
        notes.push(format!("{name}: given up after {MOST_DEATHS} times without an answer"));
    }
    // Why the rest was not asked.
    if verdict.more.found.gave_up {
        notes.push(format!(
            "given up for good: {MOST_DEATHS_IN_ALL} times without an answer, {MOST_HANGS_IN_ALL} answers that were \
             waited for, or no answer at all"
        ));
    }
    Table::new("", columns, rows).noted(notes)
}

/// What broke the protocol and the cases that fail: of one property, or of all.
pub(super) fn excerpts(
    verdict: &Verdict,
    repeat: &dyn Fn(&str, u64) -> String,
    property: Option<&str>,
) -> Vec<Excerpt> {
    let names = names(verdict);
    // The grids of a case are named after whoever drew them.
    let drawn_by = match &names {
        Some([first, second]) => vec![first.as_str(), second],
        None => vec!["judged"],
    };
    let mut excerpts = match property {
        None | Some("protocol") => incidents(verdict, repeat),
        Some(_) => Vec::new(),
    };
    for f in &verdict.failures {
        if property.is_none_or(|property| f.evidence.shows(property)) {
            excerpts.push(excerpt(f, &drawn_by, repeat(f.family, f.index)));
        }
    }
    excerpts
}

/// What broke the protocol: the first of each kind.
fn incidents(verdict: &Verdict, repeat: &dyn Fn(&str, u64) -> String) -> Vec<Excerpt> {
    let mut shown: Vec<&str> = Vec::new();
    let mut out = Vec::new();
    for incident in &verdict.more.found.incidents {
        // The same misbehaviour again and again would hide the others.
        let word = incident.what.breach.name();
        if shown.iter().filter(|w| **w == word).count() == MOST_INCIDENTS {
            continue;
        }
        shown.push(word);
        let (family, index) = (incident.family, incident.index);
        let (place, places) = match family {
            "" => ("before the families".to_owned(), Vec::new()),
            _ => (format!("{family} #{index}"), vec![("repeat with", repeat(family, index))]),
        };
        out.push(Excerpt {
            title: format!("{place}: it {}", incident.what),
            exchanges: vec![("request", incident.request.clone())],
            places,
            ..Excerpt::default()
        });
    }
    // Ends of the program that no single request caused.
    for stray in &verdict.more.found.strays {
        let title = match stray.breach {
            Breach::FailsAtEnd => format!("it {stray}"),
            _ => format!("with several requests in flight it {stray}; each alone was answered"),
        };
        out.push(Excerpt { title, ..Excerpt::default() });
    }
    out
}

/// A failing case: what was asked and answered, with its pixel grid. `drawn_by` names the one or the two programs; `command`
/// repeats it, or is empty.
pub fn excerpt(failure: &Failure, drawn_by: &[&str], command: String) -> Excerpt {
    let (family, index) = (failure.family, failure.index);
    let (property, what) = (failure.evidence.property, &failure.what);
    let changes = failure.evidence.changes;
    let drawn_by = if changes { &["first", "again"] } else { drawn_by };
    // Answers that change are shown twice, in the place of a second program's.
    let second = if changes { "again" } else { "other" };
    let mut exchanges = Vec::new();
    for exchange in failure.evidence.exchanges.iter().take(MOST_EXCHANGES) {
        let Exchange { request, answer, other, expected, .. } = exchange;
        for (what, line) in
            [("request", request), ("answer", answer), (second, other), ("expected", expected)]
        {
            if !line.is_empty() {
                exchanges.push((what, line.clone()));
            }
        }
    }
    // What stands below the case: how much is not shown, and where else it shows.
    let more = failure.evidence.exchanges.len().saturating_sub(MOST_EXCHANGES);
    let mut notes = Vec::new();
    if more > 0 {
        notes.push(format!("and {more} requests more"));
    }
    notes.extend(also(&failure.evidence).map(|also| format!("({also})")));
    let picture = failure.evidence.picture.as_ref();
    if let Some(of) = picture.map(|picture| &picture.of).filter(|of| !of.is_empty()) {
        notes.push(format!("({of})"));
    }
    Excerpt {
        title: format!(
            "{property}: {what} (from {family} #{index}, {})",
            failure.evidence.shrunk.name()
        ),
        exchanges,
        grid: picture.map_or(String::new(), |picture| grid(drawn_by, picture)),
        notes,
        places: Vec::from_iter((!command.is_empty()).then_some(("repeat with", command))),
    }
}

/// The other families or checks whose smallest case shows the same.
fn also(evidence: &Exchanged) -> Option<String> {
    let also = &evidence.also;
    match also.len() {
        0 => None,
        1 => Some(format!("the same in {}", also[0])),
        n => Some(format!("the same in {n} others: {}", also.join(", "))),
    }
}

/// What was drawn beside what was expected, as characters.
pub fn grid(drawn_by: &[&str], picture: &Pictured) -> String {
    let Pictured { drawn, other, expected, .. } = picture;
    let drawn: Vec<_> = [drawn].into_iter().chain(other).collect();
    ascii::beside(drawn_by, &drawn, expected, 78)
}

/// Whether both of two compared programs answer the same.
fn difference(verdict: &Verdict, [first, second]: &[String; 2]) -> String {
    let (mut cases, mut wrong_cases) = (0, 0);
    for row in &verdict.families {
        cases += row.cases;
        wrong_cases += row.wrong_cases;
    }
    let cases = thousands(cases);
    let until = if verdict.more.found.out_of_time { " until the time was up" } else { "" };
    match wrong_cases {
        0 => format!("{first} and {second} answer the same in {cases} cases{until}"),
        n => format!("{first} and {second} differ in {} of {cases} cases{until}", thousands(n)),
    }
}

/// Which of two programs is right where they differ.
fn who_is_right(sides: &Sides, [first, second]: &[String; 2]) -> Table {
    let mut rows = Vec::new();
    for (cases, what) in [
        (sides.first, format!("cases: {first} is right and {second} is not")),
        (sides.second, format!("cases: {second} is right and {first} is not")),
        (sides.neither, "cases: neither is right".to_owned()),
        (sides.both, "cases: both are right as they declare".to_owned()),
        (sides.same_but_wrong, "cases: they answer the same, and it is wrong".to_owned()),
    ] {
        if cases > 0 {
            rows.push(Row::of(&[&thousands(cases), &what]));
        }
    }
    Table::new("", ">~cases 9 | ~who is right 1", rows)
}

/// For each family which of two programs is right.
fn sides(verdict: &Verdict) -> Table {
    let columns =
        "property 18 | >cases 7 | >differ 7 | >1st right 7 | >2nd right 7 | >neither 7 | >both 7";
    let mut rows = Vec::new();
    for row in by_share(verdict) {
        let Sides { first, second, neither, both, .. } = row.sides.unwrap_or_default();
        let cells: [&dyn Display; 7] =
            [&row.name, &row.cases, &row.wrong_cases, &first, &second, &neither, &both];
        rows.push(Row::of(&cells));
    }
    Table::new("", columns, rows)
}

/// The families, those with the largest share of wrong cases first.
fn by_share(verdict: &Verdict) -> Vec<&FamilyRow> {
    let mut rows: Vec<_> = verdict.families.iter().collect();
    rows.sort_by(|a, b| b.share().total_cmp(&a.share()));
    rows
}

/// What is wrong, in counts, behind a comma; that nothing is, is said where all properties hold.
fn wrong(verdict: &Verdict) -> String {
    let counts = verdict.counts();
    // Of a clean picture that is not right, the other counts say why.
    let of_pictures = as_declared(verdict);
    let (is_right, is_clean) =
        (verdict.agrees(), of_pictures.iter().all(|count| count.score.wrong == 0));
    let counts = if is_clean && !is_right { counts } else { of_pictures };
    let mut said = String::new();
    for count in &counts {
        if count.score.wrong > 0 || is_right && is_clean {
            said += &format!(", {} {}", count.score.wrong, count.what.words(count.score.wrong));
        }
    }
    // Requests that came to no answer are none of these counts.
    let (mut refused, mut deaths) = (0, 0);
    for row in &verdict.families {
        refused += row.refused;
        deaths += row.deaths;
    }
    for (requests, what) in [(refused, "refused"), (deaths, "without an answer")] {
        if requests > 0 {
            said += &format!(", {requests} requests {what}");
        }
    }
    said
}

/// The verdict in a sentence: what was judged, what is wrong in it, and which properties fail.
fn closing(verdict: &Verdict) -> String {
    let (mut failing, mut expected) = (Vec::new(), 0);
    for p in &verdict.more.properties {
        if !p.outcome.is_good() {
            failing.push(p.name);
        }
        expected += u64::from(p.outcome == verdict::Outcome::ExpectedFailure);
    }
    let RunFindings { cases, of_cases, out_of_time, .. } = verdict.more.found;
    // A run that ended early says how far it came.
    let until = match out_of_time {
        true => format!(", {cases} of {of_cases} cases in full when the time was up"),
        false => String::new(),
    };
    let wrong = wrong(verdict);
    let what = format!("{}{wrong}{until}", verdict.judged_shapes());
    let known = match expected {
        0 => String::new(),
        n => format!(", {n} properties fail as the baseline says"),
    };
    // The properties that fail, by name.
    let (count, all) = (failing.len(), verdict.more.properties.len());
    match count {
        0 => format!("{what}{known}"),
        _ => format!("{what}{known}; {count} of {all} properties fail: {}", failing.join(", ")),
    }
}

/// What each program draws of each failing case.
fn views(verdict: &Verdict, repeat: &dyn Fn(&str, u64) -> String) -> Vec<page_cases::CaseView> {
    let names = names(verdict);
    let programs = match &names {
        Some([first, second]) => vec![first.as_str(), second],
        None => vec![verdict.more.declared.name.as_str()],
    };
    let mut views = Vec::new();
    for failure in &verdict.failures {
        views.push(view(failure, &programs, repeat(failure.family, failure.index)));
    }
    views
}

/// A failing case as the page shows it, with the page of the docs that explains its check.
fn view(failure: &Failure, programs: &[&str], command: String) -> page_cases::CaseView {
    let Failure { family, index, evidence, .. } = failure;
    let Exchanged { property, shrunk, picture, check, .. } = evidence;
    let name = format!("{family}#{index}");
    let also = also(evidence).map_or(String::new(), |also| format!("; {also}"));
    let about = format!("{property}: found in {family} #{index}, {}{also}", shrunk.name());
    let mut view = page_cases::of_program(name, about, &failure.case, programs, picture.as_ref());
    view.found.clone_from(&failure.what);
    view.command = command;
    // The chapters of edges and of lines are named by what the case draws.
    let chapter = match check {
        Check::Depth => Some(("chapter 6, depth", "ch06.md")),
        Check::Near | Check::Carried => Some(("chapter 7, clipping", "ch07.md")),
        Check::Samples => Some(("GAMES101, four samples", "games101.md")),
        _ => None,
    };
    if let Some((title, path)) = chapter {
        view.chapter = Chapter { title, path };
    }
    view
}

/// Every property with what was found, those that fail first and with a link to their cases.
fn properties(verdict: &Verdict) -> Table {
    let (mut rows, mut good) = (Vec::new(), Vec::new());
    for p in &verdict.more.properties {
        let is_good = p.outcome.is_good();
        let word = if is_good { "holds" } else { "fails" };
        let has_case = verdict.failures.iter().any(|f| f.evidence.shows(p.name));
        let mut row = Row::of(&[&p.name, &word, &p.about, &p.detail]).marked(is_good);
        row.search = has_case.then(|| p.name.to_owned());
        if is_good { good.push(row) } else { rows.push(row) }
    }
    rows.extend(good);
    let columns = "property 18 | holds 6 | what it says | found";
    Table::new("Properties, those that fail first", columns, rows)
}
