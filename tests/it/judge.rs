//! The judge of programs: engines through pipes and without, faults of drawing and of conversation,
//! conventions that are declared, what it prints for people and for machines.

use std::process::Command;
use std::time::Duration;

use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_core::triangle::{Corners, PixelPoint, Span};
use rasterproof_faults::planted::exact::ExactMutant;
use rasterproof_faults::planted::{LineMutant, TriangleMutant};
use rasterproof_judge::ask::{Answer, Asked, Misbehaviour, Question, Subject};
use rasterproof_judge::declared::Declared;
use rasterproof_judge::expected::Expect as _;
use rasterproof_judge::in_process::Inside;
use rasterproof_judge::recognise::{Scope, recognise};
use rasterproof_judge::verdict::{Outcome, Scores as _, Shapes, Verdict};
use rasterproof_judge::{Asking, Options, judge};
use rasterproof_program::{Limits, Program};
use rasterproof_registry::engines::{self, SPECIMENS};
use rasterproof_report::{judge_text, text};
use rasterproof_verify::comparison::{Convention, Rule, Winding};
use rayon::prelude::*;

use crate::misbehave;
use crate::program::{PROGRAM, Run, check, shared};

pub fn options(cases: u64, families: &[&str]) -> Options {
    let families = families.iter().map(|name| (*name).to_owned());
    let mut options = families.fold(Options::default().cases(cases), Options::family);
    // How small a failing case gets, and why it fails, is not looked at here.
    options.terms.patience = Duration::ZERO;
    options
}

/// The same, with time to look for a cause.
pub fn patient(cases: u64, families: &[&str]) -> Options {
    options(cases, families).terms(Asking::default())
}

pub fn judged(asker: Box<dyn Subject>, options: &Options) -> Verdict {
    judge(&mut [asker], options, &|_| None, &|_| ())
}

pub fn inside(name: &str) -> Box<dyn Subject> {
    let entry = engines::find(name).copied().or_else(|| engines::find_planted(name));
    Box::new(Inside::new(&entry.unwrap_or_else(|| panic!("{name}"))))
}

fn limits(answer_ms: u64) -> Limits {
    Limits { answer: Duration::from_millis(answer_ms), start: Duration::from_secs(20) }
}

fn process(words: &[&str], answer_ms: u64) -> Result<Program, Misbehaviour> {
    let command: Vec<String> =
        [PROGRAM, "engine"].iter().chain(words).map(|word| (*word).to_owned()).collect();
    Program::start(&command, &[], limits(answer_ms))
}

fn misbehaving(fault: &str, limits: Limits) -> Result<Program, Misbehaviour> {
    Program::start(&misbehave::command("scanline", fault), &[], limits)
}

pub fn property(verdict: &Verdict, name: &str) -> Outcome {
    let found = verdict.more.properties.iter().find(|p| p.name == name);
    found.unwrap_or_else(|| panic!("{name} was not judged")).outcome
}

#[test]
fn judge_agrees_with_the_engines() {
    for name in ["scanline", "edge-function", "oracle", "dda", "bresenham", "scanline-exact"] {
        let verdict = judged(inside(name), &options(40, &[]));
        let failures: Vec<_> =
            verdict.failures.iter().map(|f| (&f.evidence.property, &f.what)).collect();
        assert!(verdict.agrees(), "{name}: {failures:?}");
        assert!(verdict.shapes(Shapes::Triangles) + verdict.shapes(Shapes::Lines) > 200, "{name}");
    }
}

/// Faults that no request can show: the protocol's windows begin at the origin, and its lines have
/// no values; and one whose errors lie within 32 u M, the one tolerance that our engines declare for
/// all values, and outside the bound u (15 D + 2 M) of `verify` where all corners have one value.
const INVISIBLE: [&str; 4] =
    ["truncates-towards-zero", "seam-between-tiles", "line-weights-from-clip", "naive-barycentric"];

/// The verdict on a few cases of each family, or on 48 where these show no fault.
fn judged_twice(name: &str) -> Verdict {
    let few = judged(inside(name), &options(6, &[]));
    if few.agrees() { judged(inside(name), &options(48, &[])) } else { few }
}

/// What `verify` finds (`tests/it/mutants.rs`), the judge finds too.
#[test]
fn judge_catches_every_planted_fault() {
    let names = TriangleMutant::ALL.iter().map(|mutant| mutant.name());
    let names = names.chain(LineMutant::ALL.iter().map(|mutant| mutant.name()));
    let surprising = names.filter(|name| judged_twice(name).agrees() != INVISIBLE.contains(name));
    let surprising: Vec<_> = surprising.collect();
    assert!(surprising.is_empty(), "{surprising:?}");
}

#[test]
fn judge_catches_every_specimen() {
    for entry in &SPECIMENS {
        let verdict = judged_twice(entry.name);
        assert!(!verdict.agrees(), "{}", entry.name);
        assert!(!verdict.failures.is_empty(), "{}", entry.name);
    }
}

/// Through a pipe comes out what comes out without one, row for row, failure for failure: every engine,
/// every specimen, every planted fault.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn judge_finds_the_same_through_a_pipe() {
    let engines = engines::speaking().map(|entry| entry.name);
    let triangles = TriangleMutant::ALL.iter().map(|mutant| mutant.name());
    let lines = LineMutant::ALL.iter().map(|mutant| mutant.name());
    let exact = ExactMutant::ALL.iter().map(|mutant| mutant.name());
    let planted = triangles.chain(lines).chain(exact);
    let names: Vec<_> =
        engines.chain(planted.filter(|name| engines::find_planted(name).is_some())).collect();
    assert!(names.len() > 60, "{}", names.len());
    names.par_iter().for_each(|name| {
        let options = options(8, &[]);
        let without = judged(inside(name), &options);
        let through = judged(Box::new(process(&[name], 20_000).unwrap()), &options);
        assert_eq!(through.families, without.families, "{name}");
        assert_eq!(through.more.found.failing, without.more.found.failing, "{name}");
        assert_eq!(through.agrees(), without.agrees(), "{name}");
        assert_eq!(through.more.windings, without.more.windings, "{name}");
    });
}

/// Each way to break the protocol gets its word, and the rest is judged all the same.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn judge_names_misbehaviour() {
    for (fault, word) in [
        ("stalls", "hangs"),
        ("late", "answers late"),
        ("crashes", "crashes"),
        ("exits", "exits early"),
        ("nonsense", "prints nonsense"),
        ("lies", "prints nonsense"),
        ("twice", "answers twice"),
        ("out-of-order", "answers out of order"),
        ("other-id", "answers for another id"),
        ("floods", "floods its output"),
        ("floods-lines", "floods its output"),
        ("forks", "exits early"),
        ("moody", "crashes"),
    ] {
        let program = misbehaving(fault, limits(400)).unwrap();
        let verdict = judged(Box::new(program), &options(64, &["half-integer", "uniform"]));
        let incidents = verdict.more.found.incidents.iter().map(|i| &i.what);
        let words: Vec<_> =
            incidents.chain(&verdict.more.found.strays).map(|m| m.breach.name()).collect();
        assert!(words.contains(&word), "{fault}: {words:?}");
        assert_eq!(property(&verdict, "protocol"), Outcome::Fail, "{fault}");
        assert_eq!(property(&verdict, "uniform"), Outcome::Pass, "{fault}");
        let requests = verdict.more.found.incidents.iter().map(|i| &i.request);
        // The second answer is noticed at the next request, which is not the one it names.
        let is_late_notice = ["twice", "floods-lines"].contains(&fault);
        assert!(is_late_notice || requests.clone().all(|r| r.starts_with("T 1 16 16 ")), "{fault}");
        let uniform = verdict.families.iter().find(|row| row.name == "uniform").unwrap();
        assert_eq!((uniform.cases, uniform.wrong_cases), (64, 0), "{fault}");
        if requests.count() > 0 {
            let stopped = verdict.families.iter().find(|row| row.name == "half-integer");
            assert!(stopped.unwrap().stopped, "{fault}: a family stops at the third death");
        }
        #[cfg(target_os = "linux")]
        if fault == "forks" {
            let pids =
                verdict.more.complaints.shown.iter().filter_map(|line| line.strip_prefix("child "));
            let pids: Vec<_> = pids.collect();
            assert!(!pids.is_empty(), "{:?}", verdict.more.complaints);
            assert!(pids.iter().all(|pid| is_gone(pid)), "{pids:?} live on");
        }
    }
}

/// Whether a process has ended, reaped or not.
#[cfg(target_os = "linux")]
pub fn is_gone(pid: &str) -> bool {
    (0..100).any(|_| {
        std::thread::sleep(Duration::from_millis(10));
        let stat = std::fs::read_to_string(format!("/proc/{pid}/stat")).unwrap_or_default();
        stat.is_empty() || stat.contains(") Z ")
    })
}

#[test]
fn judge_refuses_who_never_says_hello() {
    for (fault, word, said) in [
        ("silent", "never says HELLO", "it says nothing"),
        ("rude", "never says HELLO", "E - say something else"),
        ("dead", "never says HELLO", "it exits: with status 7"),
        ("babbles", "floods its output", "bytes before HELLO, at last it says still loading"),
    ] {
        let limits = Limits { start: Duration::from_millis(700), ..limits(200) };
        let Err(misbehaviour) = misbehaving(fault, limits) else { panic!("{fault} says no HELLO") };
        assert_eq!(misbehaviour.breach.name(), word, "{fault}");
        assert!(misbehaviour.to_string().contains(said), "{fault}: {misbehaviour}");
    }
}

/// Leaks are found when a program ends, after the end of its input.
#[test]
fn judge_sees_how_a_program_ends() {
    for (fault, outcome) in [("leaks", Outcome::Fail), ("", Outcome::Pass)] {
        let program = Box::new(misbehaving(fault, limits(20_000)).unwrap());
        let verdict = judged(program, &options(8, &["half-integer"]));
        assert_eq!(
            (property(&verdict, "protocol"), verdict.agrees()),
            (outcome, outcome.is_good())
        );
        let report = judge_text::report(&verdict, "-", &|_, _| "-".to_owned(), false);
        let said = text::text(&report, false, false, text::WIDTH);
        for line in [
            "scanline is not right: it fails after the end of its input\n",
            "\nit fails after the end of its input: with status 1\n",
            "\n  | ==7==ERROR: LeakSanitizer: detected memory leaks\n",
        ] {
            assert_eq!(said.contains(line), fault == "leaks", "{said}");
        }
    }
}

/// The first hang costs the whole limit, to be sure; the others need not, and there are few of them.
#[test]
fn judge_waits_for_few_hangs() {
    let program = Box::new(misbehaving("stalls", limits(800)).unwrap());
    let families = ["half-integer", "rectangle", "fan", "flat", "needle", "uniform", "tiny"];
    let verdict = judged(program, &options(64, &families));
    let mut hangs = verdict.more.found.incidents.iter().map(|incident| incident.what.to_string());
    assert_eq!(hangs.next().unwrap(), "hangs: no answer within 0.8 s");
    let others: Vec<String> = hangs.collect();
    let is_short = |what: &String| what.ends_with(" (the first time: no answer within 0.8 s)");
    assert!(!others.is_empty() && others.iter().all(is_short), "{others:?}");
    assert!(others.len() < 16, "{others:?}");
}

/// What is no fault: version 1, a banner before HELLO, a loud standard error, runs with their numbers of hits.
#[test]
fn judge_bears_with_old_and_loud_programs() {
    for plant in ["old", "chatty", "noisy", "counts"] {
        let program = misbehaving(plant, limits(20_000)).unwrap();
        assert_eq!(program.declared().version, if plant == "old" { 1 } else { 2 });
        let verdict = judged(Box::new(program), &options(64, &["half-integer"]));
        assert!(verdict.agrees(), "{plant}");
        let said = verdict.more.complaints.shown.join("");
        assert_eq!(said.contains("\\u{1b}[31mred"), plant == "noisy", "{said}");
        assert!(!said.contains('\u{1b}'));
    }
}

/// A program that draws by any declared convention, exactly.
struct ByRule(Declared);

impl Subject for ByRule {
    fn declared(&self) -> &Declared {
        &self.0
    }

    fn ask(&mut self, questions: &[Question], _: u64) -> Vec<Answer> {
        let one = |q: &Question| {
            let Asked::Coverage(corners) = &q.of else { panic!("it covers only") };
            let corners_are_on_grid =
                corners.iter().all(|p| (p.x | p.y).rem_euclid(256 / self.0.grid()) == 0);
            assert!(corners_are_on_grid, "{q:?}");
            let picture = self.0.convention.picture(corners, PixelRect::window(q.width, q.height));
            Answer::Coverage(picture.map(|picture| picture.must).unwrap_or_default())
        };
        questions.iter().map(one).collect()
    }
}

/// A program that says this of itself, and answers by a function.
pub struct Answering<F>(pub Declared, pub F);

impl<F: FnMut(&[Question], u64) -> Vec<Answer> + Send> Subject for Answering<F> {
    fn declared(&self) -> &Declared {
        &self.0
    }

    fn ask(&mut self, questions: &[Question], most_deaths: u64) -> Vec<Answer> {
        (self.1)(questions, most_deaths)
    }
}

/// A program that draws by one convention and declares another.
fn drawing(drawn: Declared, declared: Declared) -> Box<dyn Subject> {
    let mut drawn = ByRule(drawn);
    let answer = move |questions: &[Question], most: u64| drawn.ask(questions, most);
    Box::new(Answering(declared, answer))
}

/// Under its declared rule each agrees, and what needs no convention tells the rules apart: strict
/// leaves holes, inclusive draws twice, the half-open ones do neither.
#[test]
fn judge_goes_by_what_is_declared() {
    for words in [
        "rule=top-left grid=1 origin=0,0",
        "rule=top-right",
        "rule=bottom-left grid=16 origin=0.25,0.75",
        "rule=bottom-right range=200",
        "rule=top-left yup",
        "rule=strict",
        "rule=inclusive grid=1 origin=0,0",
        "rule=none grid=64",
    ] {
        let declared = Declared::parse(&format!("HELLO 2 x coverage {words}")).unwrap();
        let verdict = judged(Box::new(ByRule(declared)), &options(60, &[]));
        let failing: Vec<_> = verdict
            .more
            .properties
            .iter()
            .filter(|p| !p.outcome.is_good())
            .map(|p| p.name)
            .collect();
        let is_closed = ["strict", "inclusive", "none"].iter().any(|rule| words.contains(rule));
        let expected: &[&str] = if is_closed { &["watertight"] } else { &[] };
        assert_eq!(failing, expected, "{words}");
        let row = verdict.families.iter().find(|row| row.name == "watertight").unwrap();
        assert_eq!(row.tally.missing > 0, words.contains("strict") || words.contains("none"));
        assert_eq!(row.tally.twice > 0, words.contains("inclusive"), "{words}");
    }
    // Declared wrongly, it does not agree.
    let mut declared = Declared::parse("HELLO 2 x coverage rule=top-right").unwrap();
    let drawn = declared.clone();
    declared.hear("rule=top-left");
    let verdict = judged(drawing(drawn, declared), &options(60, &["half-integer"]));
    assert_eq!(property(&verdict, "half-integer"), Outcome::Fail);
}

const EVERYTHING: Scope = Scope { triangles: true, lines: true, always: false, patience: None };

fn recognised(asker: Box<dyn Subject>, options: &Options) -> Verdict {
    judge(&mut [asker], options, &|program| recognise(program, EVERYTHING), &|_| ())
}

/// What is said of a program, and its wrong pixels as declared and by its convention.
fn said(verdict: &Verdict) -> (String, &str, u64, Option<u64>) {
    let said = verdict.more.recognised.as_ref().expect("something is recognised");
    let score = verdict.by_convention().map(|score| score.wrong);
    (said.sentences.join(" "), said.declare.as_str(), verdict.as_declared().wrong, score)
}

#[test]
fn judge_recognises_a_winding() {
    let verdict = recognised(inside("culls-one-winding"), &options(60, &["uniform"]));
    assert_eq!(property(&verdict, "draws"), Outcome::Pass);
    assert_eq!(property(&verdict, "winding"), Outcome::Fail);
    let (sentence, declare, declared, found) = said(&verdict);
    assert_eq!(declare, "winding=cw", "{sentence}");
    assert!(declared > 1000 && found == Some(0), "{declared} {found:?}");
    let words = "judge --cases 60 --declare winding=cw --";
    check(format!("{words} {PROGRAM} engine culls-one-winding"), 0)
        .prints("winding=cw")
        .prints("\nAGREES: ");
}

/// Families in which a convention shows, without corners so far away that homework overflows.
const NEAR: [&str; 5] = ["half-integer", "fan", "uniform", "tiny", "near-tie"];

/// Through a real process: the sentence, the words, and nothing wrong under what was found.
#[test]
fn judge_recognises_conventions() {
    for (name, sentence, declare) in [
        ("games101-strict", "draws nothing on an edge: neighbours leave holes", "rule=strict"),
        (
            "sysu-inclusive",
            "moves corners to whole pixels (toward zero), samples at the pixel's upper left corner \
             and draws everything on an edge: neighbours are drawn twice",
            "grid=1 origin=0,0 rule=inclusive",
        ),
    ] {
        let verdict = recognised(Box::new(process(&[name], 20_000).unwrap()), &options(60, &NEAR));
        let (found, words, declared, by_convention) = said(&verdict);
        assert!(found.contains(sentence), "{name}: {found}");
        assert!(words.starts_with(declare), "{name}: {words}");
        assert!(declared > 100 && by_convention == Some(0), "{name}: {declared} {by_convention:?}");
    }
    let near = NEAR.map(|family| ["--family", family]).concat();
    let out = check(of(&near, &["games101-strict"]), 1)
        .prints("to be judged by it: --declare 'rule=strict'")
        .out;
    assert!(out.lines().all(|l| l.chars().count() <= 100 || l.contains("repeat with: ")), "{out}");
}

/// One that declares nothing and draws by another rule; where y goes up, the words are turned over.
#[test]
fn judge_recognises_rules() {
    for (drawn, says, sentence, declare) in [
        ("rule=bottom-left", "", "follows the bottom-left rule", "rule=bottom-left"),
        ("rule=top-left", "yup", "follows the top-left rule", "rule=bottom-left"),
        ("rule=top-right winding=cw", "yup", "draws clockwise", "rule=bottom-right winding=ccw"),
        ("rule=strict origin=0.25,0.75", "", "at (0.25, 0.75)", "origin=0.25,0.75 rule=strict"),
        ("rule=bottom-right grid=16", "rule=none grid=16", "bottom-right", "rule=bottom-right"),
    ] {
        let of = |words| Declared::parse(&format!("HELLO 2 x coverage {words}")).unwrap();
        let verdict = recognised(drawing(of(drawn), of(says)), &options(60, &NEAR));
        let (found, words, _, by_convention) = said(&verdict);
        assert!(found.contains(sentence), "{drawn}: {found}");
        assert_eq!((words, by_convention), (declare, Some(0)), "{drawn}: {found}");
        // Declared so, it agrees, and nothing else is recognised.
        let mut declared = of(says);
        words.split(' ').for_each(|word| declared.hear(word));
        let again = recognised(drawing(of(drawn), declared), &options(60, &NEAR));
        assert!(again.more.recognised.is_none() && again.as_declared().wrong == 0, "{drawn}");
    }
}

/// Who draws as declared is looked at and not questioned; noise is called unexplained.
#[test]
fn judge_questions_no_more_than_needed() {
    let declared = Declared::parse("HELLO 2 x coverage").unwrap();
    let questioned = |is_noisy: bool| {
        let (mut drawn, mut asked) = (ByRule(declared.clone()), 0);
        let mut program = Answering(declared.clone(), |questions: &[Question], most: u64| {
            asked += questions.len();
            let mut answers = drawn.ask(questions, most);
            for answer in answers.iter_mut().filter(|_| is_noisy) {
                // Every other pixel of some rows.
                let Answer::Coverage(runs) = answer else { continue };
                runs.retain(|run| (run.x0_px ^ (run.x1_px * 3) ^ (run.y_px * 5)) % 4 != 0);
            }
            answers
        });
        let found = recognise(&mut program, EVERYTHING);
        drop(program);
        (found, asked)
    };
    let (found, right) = questioned(false);
    assert!(found.is_none() && (50..500).contains(&right), "{right}");
    let (found, noisy) = questioned(true);
    let found = found.unwrap();
    assert!(noisy > right && found.expect.is_none(), "{noisy}");
    assert!(found.said.sentences[0].starts_with("Triangles: unexplained."), "{:?}", found.said);
}

/// The command that judges an engine of our own, with these options.
pub fn of<'a>(options: &[&'a str], engine: &[&'a str]) -> Vec<&'a str> {
    [&["judge", "--cases", "40"], options, &["--", PROGRAM, "engine"], engine].concat()
}

/// The command that judges a program that misbehaves.
pub fn of_misbehaving(options: &[&str], engine: &str, fault: &str) -> Vec<String> {
    let words = [&["judge", "--cases", "40"], options, &["--"]].concat();
    let command = misbehave::command(engine, fault);
    words.into_iter().map(str::to_owned).chain(command).collect()
}

/// What a program says cannot command the terminal.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn judge_shows_nonsense_as_text() {
    let nonsense = of_misbehaving(&["--family", "half-integer"], "scanline", "nonsense");
    let out = check(nonsense, 1).prints("debug: \\u{1b}[31mx = 3\\u{7}").out;
    assert!(out.chars().all(|c| c == '\n' || !c.is_control()));
}

/// A misspelt word of the program's own is left aside.
#[test]
fn judge_leaves_what_it_does_not_understand() {
    let program = Box::new(misbehaving("dances", limits(20_000)).unwrap());
    let verdict = judged(program, &options(8, &["half-integer"]));
    assert!(verdict.agrees());
    let report = judge_text::report(&verdict, "-", &|_, _| "-".to_owned(), false);
    assert!(report.about.ends_with("not understood, left aside: rule=topleft"), "{}", report.about);
}

/// The judge needs no more memory for a program that answers as much as it may. All its answers to a
/// block of fans would be more than these addresses hold, and the judge would abort.
#[cfg(target_os = "linux")]
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn judge_is_bounded_itself() {
    let words = of_misbehaving(&["--family", "fan"], "scanline-exact", "bloats");
    let line = "ulimit -v 700000 && exec \"$@\"";
    let mut command = Command::new("sh");
    command.args(["-c", line, "sh", PROGRAM]).args(words).current_dir(&**shared());
    // Threads reserve addresses by the core.
    command.env("RAYON_NUM_THREADS", "2").env("MALLOC_ARENA_MAX", "2");
    Run::of(&mut command).has(1).prints("floods its output: ");
}

/// A question as a library puts it that changes the ends of lines first.
fn with_ends(
    question: &Question,
    change: fn([PixelPoint; 2], [i32; 2]) -> [PixelPoint; 2],
) -> Question {
    let last = [question.width as i32 - 1, question.height as i32 - 1];
    let of = match question.of.clone() {
        Asked::Line { ends, whole } => Asked::Line { ends: change(ends, last), whole },
        other => other,
    };
    Question { of, ..*question }
}

/// Ends outside are moved to the border, so that the slope changes.
fn clamped(ends: [PixelPoint; 2], [right, bottom]: [i32; 2]) -> [PixelPoint; 2] {
    ends.map(|p| PixelPoint::new(p.x.clamp(0, right), p.y.clamp(0, bottom)))
}

/// The line is cut at the border of the last pixels, and its new ends are rounded to whole pixels in the window.
fn cut(ends: [PixelPoint; 2], [right, bottom]: [i32; 2]) -> [PixelPoint; 2] {
    let [from, to] = ends.map(|p| [f64::from(p.x), f64::from(p.y)]);
    let (mut start, mut end) = (0.0_f64, 1.0_f64);
    for (axis, most) in [(0, right), (1, bottom)] {
        let delta = to[axis] - from[axis];
        if delta != 0.0 {
            let at = |border: f64| (border - from[axis]) / delta;
            let (a, b) = (at(-0.5), at(f64::from(most) + 0.5));
            (start, end) = (start.max(a.min(b)), end.min(a.max(b)));
        }
    }
    if start > end {
        return ends;
    }
    let point = |t: f64| {
        let at = |axis: usize, most: i32| {
            let new = from[axis] + t * (to[axis] - from[axis]);
            (new.round() as i32).clamp(0, most)
        };
        PixelPoint::new(at(0, right), at(1, bottom))
    };
    [point(start), point(end)]
}

/// What leaves the window and comes out otherwise by at most a pixel is counted, said and left out of the second score.
/// Where it comes out otherwise by more, it counts as wrong. Of who draws it as the rest, nothing is said.
#[test]
fn judge_tells_what_leaves_the_window() {
    let options = patient(30, &["line-octants", "line-clipped"]);
    let entry = engines::find("bresenham").unwrap();
    // Within the window it draws as it declares, so that it is questioned only where that is asked.
    let scope = Scope { triangles: false, lines: true, always: true, patience: None };
    let judged = |change: fn([PixelPoint; 2], [i32; 2]) -> [PixelPoint; 2]| {
        let mut engine = Inside::new(entry);
        let changes =
            Answering(engine.declared().clone(), move |questions: &[Question], most: u64| {
                engine
                    .ask(&questions.iter().map(|q| with_ends(q, change)).collect::<Vec<_>>(), most)
            });
        let mut changes: [Box<dyn Subject>; 1] = [Box::new(changes)];
        let verdict = judge(&mut changes, &options, &|program| recognise(program, scope), &|_| ());
        let text = verdict.more.recognised.as_ref().unwrap().sentences.concat();
        assert!(text.contains("Lines that leave the window come out otherwise ("), "{text}");
        (verdict, text)
    };
    let (verdict, text) = judged(cut);
    assert!(text.contains("by at most a pixel"), "{text}");
    let score = verdict.by_convention().unwrap();
    assert!(verdict.as_declared().wrong > 50 && score.wrong == 0, "{score:?}");
    assert!(
        score.unscored > 0 && verdict.left_out_wrong() == verdict.as_declared().wrong,
        "{score:?}"
    );
    let (verdict, text) = judged(clamped);
    assert!(text.contains("they count as wrong"), "{text}");
    let score = verdict.by_convention().unwrap();
    assert!(score.wrong > 50 && score.unscored == 0, "{score:?}");
    let cause = &verdict.cause[0].why.causes[0];
    assert_eq!(cause.name, "ends are clamped to the window");
    let verdict = recognised(inside("line-directed-ties"), &options);
    let text = verdict.more.recognised.as_ref().unwrap().sentences.concat();
    assert!(!text.contains("leave the window") && !text.is_empty(), "{text}");
    assert_eq!(verdict.by_convention().unwrap().unscored, 0);
}

#[cfg(target_os = "linux")]
#[test]
fn judge_leaves_nothing_running() {
    use rustix::process::{Pid, Signal, kill_process};
    let words = of_misbehaving(&["--timeout", "600"], "scanline", "stalls");
    let mut command = shared().command(words);
    let mut child = command.stdout(std::process::Stdio::null()).spawn().unwrap();
    let of_it = format!("/proc/{0}/task/{0}/children", child.id());
    let judged = (0..1000).find_map(|_| {
        std::thread::sleep(Duration::from_millis(10));
        let pids = std::fs::read_to_string(&of_it).unwrap_or_default();
        pids.split_whitespace().next().map(str::to_owned)
    });
    let judged = judged.expect("a program is started");
    kill_process(Pid::from_child(&child), Signal::INT).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert!(is_gone(&judged), "{judged} lives on");
}

/// A rasterizer that draws every pixel that a triangle touches: the area that it shares with the pixel is not 0.
fn conservative(corners: Corners, window: PixelRect) -> Vec<Span> {
    let mut runs = Vec::new();
    let touches = |x: i32, y: i32| {
        // The triangle cut by the four sides of the pixel.
        let mut polygon: Vec<[f64; 2]> =
            corners.iter().map(|p| [p.x, p.y].map(f64::from)).collect();
        for (axis, border, sign) in [(0, x, 1.0), (0, x + 1, -1.0), (1, y, 1.0), (1, y + 1, -1.0)] {
            let inside = |p: &[f64; 2]| sign * (p[axis] - f64::from(border) * 256.0);
            let mut kept = Vec::new();
            for (i, from) in polygon.iter().enumerate() {
                let to = &polygon[(i + 1) % polygon.len()];
                let (a, b) = (inside(from), inside(to));
                if a >= 0.0 {
                    kept.push(*from);
                }
                if (a >= 0.0) != (b >= 0.0) {
                    let t = a / (a - b);
                    kept.push([0, 1].map(|k| from[k] + t * (to[k] - from[k])));
                }
            }
            polygon = kept;
        }
        let area: f64 = (0..polygon.len())
            .map(|i| {
                let (p, q) = (polygon[i], polygon[(i + 1) % polygon.len()]);
                p[0] * q[1] - p[1] * q[0]
            })
            .sum();
        area.abs() > 1e-9
    };
    for y_px in window.y0..window.y1 {
        for x_px in (window.x0..window.x1).filter(|x| touches(*x, y_px)) {
            runs.push(Span { y_px, x0_px: x_px, x1_px: x_px + 1 });
        }
    }
    runs
}

/// Conservative rasterization is a shape that is declared: right where it is, wrong where it is not, and a name of its own.
#[test]
fn judge_takes_a_declared_shape() {
    let declared = |words: &str| Declared::parse(&format!("HELLO 2 x coverage {words}")).unwrap();
    let judged_as = |words: &str| {
        let answer = |questions: &[Question], _| {
            let draw = |question: &Question| match question.of {
                Asked::Coverage(corners) => Answer::Coverage(conservative(
                    corners,
                    PixelRect::window(question.width, question.height),
                )),
                _ => Answer::Refused(String::new()),
            };
            questions.iter().map(draw).collect()
        };
        judged(Box::new(Answering(declared(words), answer)), &options(12, &["uniform", "fan"]))
    };
    let verdict = judged_as("shape=touched range=1024");
    assert!(verdict.agrees(), "{:?}", verdict.failures);
    for wrong in ["shape=covered range=1024", "range=1024"] {
        assert!(judged_as(wrong).as_declared().wrong > 100, "{wrong}");
    }
}

/// Both readings of what touches: each engine of ours is right by its own, wrong by the other, and right where either may be drawn.
#[test]
fn judge_takes_both_readings_of_touching() {
    let judged_as = |name: &str, words: &str, cases: u64| {
        let mut engine = inside(name);
        let declared = Declared::parse(&format!("HELLO 2 x coverage {words}")).unwrap();
        let answer = move |questions: &[Question], most| engine.ask(questions, most);
        recognised(Box::new(Answering(declared, answer)), &options(cases, &[]))
    };
    for (name, other) in [("touched-closed", "touched-open"), ("touched-open", "touched-closed")] {
        for shape in [name, "touched"] {
            let verdict = judged_as(name, &format!("shape={shape}"), 20);
            assert!(verdict.agrees(), "{name} as {shape}: {:?}", verdict.failures);
        }
        let verdict = judged_as(name, &format!("shape={other}"), 20);
        assert!(verdict.as_declared().wrong > 100, "{name} as {other}");
        // What it does is recognised, with the word that says so.
        let found = verdict.more.recognised.unwrap();
        assert_eq!(found.declare, format!("shape={name}"), "{:?}", found.sentences);
    }
}

/// Of a program that fills and draws lines, the fill is what its own outline encloses, whatever the rule on edges is.
#[test]
fn judge_compares_fill_and_outline() {
    let fill_with = |convention: Convention, wider: i32| {
        let mut oracle = inside("oracle");
        let declared = Declared::parse("HELLO 2 both coverage line").unwrap();
        let answer = move |questions: &[Question], most| {
            let mut answers = oracle.ask(questions, most);
            for (question, answer) in questions.iter().zip(&mut answers) {
                if let Asked::Coverage(corners) = &question.of {
                    let window = PixelRect::window(question.width, question.height);
                    let mut runs = convention.expected(corners, window).must;
                    for run in &mut runs {
                        run.x0_px = (run.x0_px - wider).clamp(0, window.x1);
                        run.x1_px = (run.x1_px + wider).clamp(run.x0_px, window.x1);
                    }
                    *answer = Answer::Coverage(runs);
                }
            }
            answers
        };
        let verdict =
            judged(Box::new(Answering(declared, answer)), &options(200, &["half-integer"]));
        let row = verdict.families.iter().find(|row| row.name == "fill-and-outline").unwrap();
        assert_eq!(row.cases, 50);
        (row.wrong_cases, row.tally.missing, row.tally.extra)
    };
    let fill_by = |convention: Convention| fill_with(convention, 0).0;
    for rule in [Rule::TopLeft, Rule::BottomRight, Rule::Strict] {
        assert_eq!(fill_by(Convention::default().rule(rule)), 0, "{rule:?}");
    }
    assert!(fill_by(Convention::default().sample(128, 384)) > 30);
    assert!(fill_by(Convention::default().winding(Winding::Clockwise)) == 0);
    // What is filled outside counts, and what is left out inside, each without the other.
    let (_, missing, extra) = fill_with(Convention::default(), 1);
    assert!(missing == 0 && extra > 100, "{missing} {extra}");
    let (_, missing, extra) = fill_with(Convention::default(), -1);
    assert!(missing > 100 && extra == 0, "{missing} {extra}");
}

/// The near plane of Direct3D and Vulkan is declared.
#[test]
fn judge_takes_a_declared_near_plane() {
    let judged_as = |words: &str| {
        let declared = Declared::parse(&format!("HELLO 2 x clip {words}")).unwrap();
        let answer = |questions: &[Question], _| {
            let clip = |question: &Question| {
                let triangle = rasterproof_judge::near_plane::asked(&question.of).unwrap();
                let corners = rasterproof_verify::cases::near_plane::clip_corners(&triangle);
                let mut left = Vec::new();
                for i in 0..3 {
                    let (a, b) = (corners[i], corners[(i + 1) % 3]);
                    if a[2] >= 0.0 {
                        left.push(a);
                    }
                    if (a[2] >= 0.0) != (b[2] >= 0.0) {
                        let t = a[2] / (a[2] - b[2]);
                        left.push([0, 1, 2, 3, 4].map(|k| a[k] + t * (b[k] - a[k])));
                    }
                }
                Answer::Polygon(left)
            };
            questions.iter().map(clip).collect()
        };
        judged(Box::new(Answering(declared, answer)), &patient(100, &["near-plane"]))
    };
    assert!(judged_as("near=zero").agrees());
    let verdict = judged_as("");
    assert!(!verdict.agrees());
    assert!(verdict.cause[0].why.to_string().contains("clips to z >= 0"), "{:?}", verdict.cause);
}

/// Meshes across the border of the window show what clipping does to shared edges.
#[test]
fn judge_asks_for_meshes_across_the_border() {
    let mut engine = Inside::new(engines::find("scanline").unwrap());
    let answer = move |questions: &[Question], most: u64| {
        // Corners outside are moved to the border.
        let moved = |question: &Question| {
            let sides = [question.width, question.height].map(|side| side as i32 * 256);
            let of =
                match question.of.clone() {
                    Asked::Coverage(corners) => Asked::Coverage(corners.map(|p| {
                        SubpixelPoint::new(p.x.clamp(0, sides[0]), p.y.clamp(0, sides[1]))
                    })),
                    other => other,
                };
            Question { of, ..*question }
        };
        engine.ask(&questions.iter().map(moved).collect::<Vec<_>>(), most)
    };
    let declared = Declared::parse("HELLO 2 x coverage").unwrap();
    let verdict = judged(Box::new(Answering(declared, answer)), &options(100, &["mesh-border"]));
    assert_eq!(property(&verdict, "watertight"), Outcome::Fail);
    let verdict = judged(inside("scanline"), &options(200, &["mesh-border"]));
    assert!(verdict.agrees());
    let row = verdict.families.iter().find(|row| row.name == "watertight").unwrap();
    assert!(row.cases > 100, "{row:?}");
}

/// A program that walks along each pixel of a line is asked for lines that it draws in time, and the verdict says so.
#[test]
fn judge_measures_how_far_lines_are_walked() {
    let mut engine = Inside::new(engines::find("bresenham").unwrap());
    let answer = move |questions: &[Question], most: u64| {
        for question in questions {
            if let Asked::Line { ends: [a, b], .. } = question.of {
                let steps = a.x.abs_diff(b.x).max(a.y.abs_diff(b.y));
                std::thread::sleep(Duration::from_micros(u64::from(steps)));
            }
        }
        engine.ask(questions, most)
    };
    let declared = Declared::parse("HELLO 2 x line").unwrap();
    let verdict = judged(Box::new(Answering(declared, answer)), &options(3, &["line-far"]));
    let reach = verdict.more.reach.unwrap();
    assert!((1 << 10..=1 << 16).contains(&reach), "{reach}");
    assert!(verdict.agrees());
    assert_eq!(judged(inside("bresenham"), &options(3, &["line-octants"])).more.reach, None);
}

/// The same of triangles, whose rows outside the window are walked.
#[test]
fn judge_measures_how_large_triangles_are_walked() {
    let mut engine = Inside::new(engines::find("scanline").unwrap());
    let answer = move |questions: &[Question], most: u64| {
        for question in questions {
            if let Asked::Coverage(corners) = question.of {
                let y = corners.map(|c| c.y);
                let rows = y.iter().max().unwrap().abs_diff(*y.iter().min().unwrap()) / 256;
                std::thread::sleep(Duration::from_nanos(100 * u64::from(rows)));
            }
        }
        engine.ask(questions, most)
    };
    let declared = Declared::parse("HELLO 2 x coverage").unwrap();
    let verdict = judged(Box::new(Answering(declared, answer)), &options(3, &["huge"]));
    let side = verdict.more.side.unwrap();
    assert!((1 << 12..=1 << 20).contains(&side), "{side}");
    assert!(verdict.agrees());
    assert_eq!(judged(inside("scanline"), &options(3, &["uniform"])).more.side, None);
}
