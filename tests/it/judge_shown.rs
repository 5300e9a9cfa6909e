//! What the judge shows: pictures of every stage, what happens before the families, and no agreement where
//! there was nothing to judge.

use std::collections::BTreeSet;
use std::sync::Mutex;
use std::time::Duration;

use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::PixelRect;
use rasterproof_faults::planted::{LineMutant, TriangleMutant};
use rasterproof_judge::ask::{Answer, Asked, Breach, Question, Subject};
use rasterproof_judge::check::Check;
use rasterproof_judge::declared::Declared;
use rasterproof_judge::failures::Failure;
use rasterproof_judge::in_process::Inside;
use rasterproof_judge::near_plane::asked;
use rasterproof_judge::recognise::{Scope, recognise};
use rasterproof_judge::run::cases_of;
use rasterproof_judge::verdict::Outcome;
use rasterproof_judge::verdict::Scores as _;
use rasterproof_judge::{Options, Step, adapt_case, judge};
use rasterproof_registry::engines;
use rasterproof_report::html::page;
use rasterproof_report::judge_text as shown;
use rasterproof_report::text::{WIDTH, text};
use rasterproof_teaching::quiz::{self, Language, page as quiz_page};
use rasterproof_verify::cases::near_plane::clip_corners;
use rasterproof_verify::cases::{FamilyName, Shape};
use rasterproof_verify::comparison::{Convention, Rule, judge_coverage};
use rasterproof_verify::judge::ascii;

#[cfg(target_os = "linux")]
use crate::judge::is_gone;
use crate::judge::{Answering, inside, judged, of_misbehaving, options, patient, property};
use crate::program::{PROGRAM, Run, check, shared};

/// An engine that shows the first triangle of a pile everywhere, clips nothing, and covers all samples
/// of a pixel that it touches.
struct Careless(Inside);

impl Subject for Careless {
    fn declared(&self) -> &Declared {
        self.0.declared()
    }

    fn ask(&mut self, questions: &[Question], most_deaths: u64) -> Vec<Answer> {
        let mut answers = self.0.ask(questions, most_deaths);
        for (question, answer) in questions.iter().zip(&mut answers) {
            match (&question.of, answer) {
                (Asked::Depth(_), Answer::Seen(runs)) => runs.iter_mut().for_each(|r| r.1 = 0),
                (Asked::Samples(_), Answer::Samples(runs)) => {
                    runs.iter_mut().for_each(|r| r.1 = 15)
                }
                (of @ Asked::Near(_), Answer::Polygon(corners)) => {
                    *corners = clip_corners(&asked(of).unwrap()).to_vec();
                }
                _ => {}
            }
        }
        answers
    }
}

/// Piles, polygons and samples are shown as pixels like anything else, shrunk, in the text and on the
/// page.
#[test]
fn judge_pictures_every_stage() {
    let options = patient(64, &STAGES);
    let careless = Careless(Inside::new(engines::find("scanline").unwrap()));
    let verdict = judged(Box::new(careless), &options);
    for (property, of, triangles, bits) in [
        ("depth-order", "of the pile is seen", 2, 10),
        ("near-plane", "x and y of clip space", 1, 8),
        ("samples4", "a grid of 4 x 4 cells", 1, 12),
    ] {
        let failure = verdict.failures.iter().find(|f| f.evidence.property == property).unwrap();
        let picture = failure.evidence.picture.as_ref().unwrap();
        assert!(picture.of.contains(of) && picture.drawn != picture.expected, "{failure:?}");
        let Shape::Triangles { list, .. } = &failure.case.shape else { panic!("{property}") };
        let corners = list.iter().flat_map(|t| t.corners());
        let bits_of = |sub: i32| sub.unsigned_abs().count_ones();
        let used: u32 = corners.map(|p| bits_of(p.x) + bits_of(p.y)).sum();
        assert!(list.len() == triangles && used <= bits, "{property}: {used} {:?}", failure.case);
    }
    let repeat = |family: &str, index: u64| format!("{family} {index}");
    let report = shown::whole(&verdict, "", &repeat, false);
    let (text, page) = (text(&report, false, false, WIDTH), page(&report));
    for part in ["depth-order#", "near-plane#", "The picture: the four samples", "ch07.md"] {
        assert!(page.contains(part), "{part}");
    }
    assert_eq!(text.matches("judged").count(), 3, "{text}");
    // The cause first, then the counts.
    let (_, verdict) = page.split_once("id=\"verdict\"").unwrap();
    let (answer, counts) = verdict.split_once("id=\"counts\"").unwrap();
    assert!(answer.contains(" is not right") && !answer.contains("wrong corners"), "{answer}");
    assert!(counts.lines().next().unwrap().contains("wrong corners"), "{counts}");
    assert!(text.contains("(x and y of clip space, before the division; a cell is "), "{text}");
}

/// A score counts what its check judges, in the words of that check, and so does the last line.
#[test]
fn scores_count_what_is_judged() {
    let shown = |program: Box<dyn Subject>, options: &Options| {
        let verdict = judged(program, options);
        let report = shown::report(&verdict, "", &|_, _| String::new(), false);
        (verdict.agrees(), text(&report, false, false, 1000))
    };
    let program = |words: &str, spoil: fn(&mut Careless, &[Question], u64) -> Vec<Answer>| {
        let mut engine = Careless(Inside::new(engines::find("scanline").unwrap()));
        let declared = Declared::parse(&format!("HELLO 2 x {words}")).unwrap();
        Box::new(Answering(declared, move |questions: &[Question], most| {
            spoil(&mut engine, questions, most)
        }))
    };
    let last =
        |text: &str| text.lines().rfind(|line| line.contains("AGREES: ")).unwrap().to_owned();
    let spoilt: fn(&mut Careless, &[Question], u64) -> Vec<Answer> = |engine, questions, most| {
        let mut answers = engine.ask(questions, most);
        for answer in &mut answers {
            if let Answer::Values(fragments) = answer {
                fragments.iter_mut().for_each(|f| f.varying.x += 1.0);
            }
        }
        answers
    };
    for (capability, what) in [
        ("depth", "pixels that show the wrong triangle"),
        ("attributes", "values beyond the tolerance"),
        ("clip", "wrong corners"),
        ("samples4", "wrong samples"),
    ] {
        let (agrees, text) = shown(program(capability, spoilt), &options(40, &[]));
        let last = last(&text);
        let count = last.split(", ").find_map(|part| part.split("; ").next()?.strip_suffix(what));
        let count: u64 = count.unwrap_or_else(|| panic!("{what}: {last}")).trim().parse().unwrap();
        assert!(!agrees && count > 0 && !last.contains(" 0 wrong"), "{last}");
        assert!(text.contains(&format!("{count} {what}, ")), "{text}");
        // Values have pixels of their own, which are right.
        assert_eq!(text.contains("0 wrong pixels"), capability == "attributes", "{text}");
        let right = program(capability, |engine, questions, most| engine.0.ask(questions, most));
        let (agrees, text) = shown(right, &options(40, &[]));
        let right = if capability == "attributes" { "wrong pixels" } else { what };
        assert!(agrees && ends_with_none(&text, right), "{text}");
    }
    // Whose pictures may be as they are, and have holes together.
    let mut strict = Inside::new(&engines::find_planted("exclusive-edges").unwrap());
    let declared = Declared::parse("HELLO 2 x coverage rule=none").unwrap();
    let answer = move |questions: &[Question], most| strict.ask(questions, most);
    let (agrees, text) = shown(Box::new(Answering(declared, answer)), &options(40, &[]));
    let last = last(&text);
    assert!(!agrees && last.contains(" holes and doubles of meshes; "), "{last}");
}

fn ends_with_none(text: &str, what: &str) -> bool {
    let line = text.lines().find(|line| line.contains("AGREES: "));
    line.is_some_and(|line| line.trim_end().ends_with(&format!(", 0 {what}")))
}

/// Cases that show the same are shown once, with the families that have them; what shows something else is shown beside it.
#[test]
fn each_kind_of_failing_case_is_shown_once() {
    for (name, line) in [("exclusive-edges", false), ("book-dda", true)] {
        let verdict = judged(inside(name), &patient(60, &[]));
        let pictures = verdict.failures.iter().filter_map(|f| {
            let picture = f.evidence.picture.as_ref()?;
            let grid = ascii::grid(&picture.drawn, &picture.expected);
            Some((f.evidence.check, grid.concat().replace(['.', '#'], "")))
        });
        let mut seen: Vec<(Check, String)> = Vec::new();
        for picture in pictures {
            assert!(!seen.contains(&picture), "{name}: {picture:?} twice");
            seen.push(picture);
        }
        let of = if line { Check::Line } else { Check::Coverage };
        let first = verdict.failures.iter().find(|f| f.evidence.check == of).unwrap();
        assert!(first.evidence.also.len() >= 3, "{name}: {:?}", first.evidence.also);
        let report = shown::report(&verdict, "", &|_, _| String::new(), false);
        let said = format!("the same in {} others: ", first.evidence.also.len());
        assert!(text(&report, false, false, WIDTH).contains(&said), "{name}");
    }
}

/// What leaves its group and outlives its program is ended with the judge.
#[cfg(target_os = "linux")]
#[test]
fn judge_ends_what_left_its_group() {
    let line = "setsid sleep 600 & echo child $! >&2; exec \"$0\" engine scanline";
    let program = PROGRAM;
    let words = ["judge", "--cases", "8", "--family", "tiny", "--", "sh", "-c", line, program];
    let out = check(words, 0).out;
    let pid = out.lines().find_map(|line| line.trim().strip_prefix("| child ")).unwrap();
    assert!(is_gone(pid), "{pid} lives on");
}

/// A limited time is kept with a slow program too, and every family is asked.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn judge_keeps_its_time() {
    let mut engine = Inside::new(engines::find("games101-strict").unwrap());
    let slow = Answering(engine.declared().clone(), move |questions: &[Question], most| {
        std::thread::sleep(Duration::from_millis(10) * questions.len() as u32);
        engine.ask(questions, most)
    });
    let options = options(100_000, &[]).time_limit(Duration::from_secs(6));
    let start = std::time::Instant::now();
    let scope = Scope { triangles: true, lines: true, always: false, patience: None };
    let recognise = |program: &mut dyn Subject| recognise(program, scope);
    let verdict = judge(&mut [Box::new(slow)], &options, &recognise, &|_| ());
    let took = start.elapsed();
    // Asked without a limit, 64 cases of each family alone take longer than a minute.
    assert!(took < Duration::from_secs(12), "{took:?}");
    let said = verdict.more.recognised.as_ref().unwrap();
    assert_eq!(said.sentences, ["The time was up before its convention was found."]);
    assert!(verdict.by_convention().is_none());
    let families = verdict.families.iter().filter(|row| row.cases > 0).count();
    assert!(families > 15, "{families}");
}

const STAGES: [&str; 3] = ["depth-order", "near-plane", "uniform"];

/// What happens before the families are asked counts too.
#[test]
fn judge_sees_the_first_request() {
    let mut engine = Inside::new(engines::find("scanline").unwrap());
    // It crashes once, at the first request of all.
    let mut has_died = false;
    let dies = Answering(engine.declared().clone(), move |questions: &[Question], most| {
        let mut answers = engine.ask(questions, most);
        if !std::mem::replace(&mut has_died, true) {
            answers[0] = Answer::Died(Breach::Crashes.by("signal 11"));
        }
        answers
    });
    let verdict = judged(Box::new(dies), &options(8, &["uniform"]));
    assert_eq!(property(&verdict, "protocol"), Outcome::Fail);
    let text =
        text(&shown::report(&verdict, "", &|_, _| String::new(), false), false, false, WIDTH);
    assert!(
        text.contains("before the families: it crashes: signal 11\n  request:  T 1 "),
        "{text}"
    );
}

/// The time is that of everything that is asked, however many requests may be in flight, and what was not done is
/// said.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn judge_ends_in_time() {
    for (engine, batch) in [("scanline", "batch=1"), ("games101-strict", "batch=1024")] {
        let is_right = engine == "scanline";
        let one = ["--family", "half-integer", "--case", "0"];
        let limited =
            [&["--seconds", "4", "--declare", batch][..], if is_right { &[] } else { &one }]
                .concat();
        let start = std::time::Instant::now();
        let words = of_misbehaving(&limited, engine, "slow");
        let run = Run::of(&mut shared().command(words)).has(u8::from(!is_right));
        let took = start.elapsed();
        // Of a limit of 5 s it took 18 s and 61 s. A slow machine needs a second to start the program.
        assert!(took < Duration::from_secs(10), "{took:?} {run}");
        if is_right {
            run.prints("The time was up before its convention was found.")
                .prints(" cases in full when the time was up");
        } else {
            run.prints(", not made smaller: the time was up)").prints("missing");
        }
    }
    let words = of_misbehaving(&["--seconds", "0.1"], "scanline", "slow");
    check(words, 2).says("nothing was judged within --seconds 0.1");
}

/// What is counted as judged is judged: of all families, within the window and beyond it, and not of those that the
/// program does not draw.
#[test]
fn progress_counts_what_is_judged() {
    for words in [
        "coverage",
        "line",
        "coverage attributes samples4 depth clip clip-attributes line",
        "depth",
        "attributes clip",
    ] {
        let declared = Declared::parse(&format!("HELLO 2 x {words}")).unwrap();
        let options = options(13, &[]);
        let mut by_hand = 0;
        for family in adapt_case::families(&[]) {
            by_hand += adapt_case::numbers(&options, family.design())
                .filter(|index| {
                    let case = adapt_case::case(family, 1, *index, &declared);
                    !Check::of(family.name, &case, *index, &declared).is_empty()
                })
                .count() as u64;
        }
        assert_eq!(cases_of(&options, &declared), by_hand, "{words}");
    }
    let steps = Mutex::new(Vec::new());
    let mut askers = [inside("bresenham")];
    let verdict =
        judge(&mut askers, &options(70, &[]), &|_| None, &|step| steps.lock().unwrap().push(step));
    let steps = steps.into_inner().unwrap();
    let judged: u64 =
        steps.iter().map(|step| if let Step::Judged(n) = step { *n } else { 0 }).sum();
    assert_eq!((steps[0], *steps.last().unwrap()), (Step::Rule, Step::Smaller));
    let rows = verdict.families.iter().filter(|row| row.name != "line-direction");
    let cases: u64 = rows.map(|row| row.cases).sum();
    assert!(
        judged == cases && judged == verdict.more.found.of_cases && judged > 100,
        "{judged} {cases}"
    );
}

/// Everybody who is wrong.
fn wrong_ones() -> Vec<&'static str> {
    let triangles = TriangleMutant::ALL.iter().map(|mutant| mutant.name());
    let lines = LineMutant::ALL.iter().map(|mutant| mutant.name());
    let specimens = engines::SPECIMENS.iter().map(|entry| entry.name);
    triangles.chain(lines).chain(specimens).collect()
}

/// Cases whose fault is seen come first; of the others it is said what differs, and each character of a picture
/// has its meaning beside it.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn judge_shows_what_differs() {
    let (mut unseen, mut pictures) = (0, 0);
    let mut characters = BTreeSet::new();
    for name in wrong_ones() {
        let verdict = judged(inside(name), &options(24, &[]));
        let differs =
            |f: &Failure| f.evidence.picture.as_ref().is_some_and(|p| p.drawn != p.expected);
        let seen: Vec<bool> = verdict.failures.iter().map(differs).collect();
        assert!(seen.is_sorted_by(|a, b| a >= b), "{name}: {seen:?}");
        for failure in &verdict.failures {
            let Some(picture) = &failure.evidence.picture else { continue };
            pictures += 1;
            if picture.drawn == picture.expected {
                unseen += 1;
                let said = "both pictures are the same; what differs is ";
                assert!(picture.of.contains(said), "{name}: {failure:?}");
            }
            let text = shown::grid(&["judged"], picture);
            let grids = [
                ascii::grid(&picture.drawn, &picture.expected),
                ascii::grid(&picture.expected, &picture.expected),
            ];
            let used: BTreeSet<char> = grids.iter().flatten().flat_map(|row| row.chars()).collect();
            assert!(
                used.iter().all(|c| text.contains(&format!("{c} "))),
                "{name}: {used:?} {text}"
            );
            characters.extend(used);
        }
    }
    assert!(unseen > 3 && pictures > 100, "{unseen} of {pictures}");
    assert!("#+-.2".chars().all(|c| characters.contains(&c)), "{characters:?}");
}

/// Each mark that a pixel can have is in the legend, in the help of `inspect` and in that of a test that fails.
#[test]
fn legends_name_every_character() {
    let help = std::fs::read_to_string("src/cli/help/inspect.txt").unwrap();
    for (actual, target) in (0..=u8::MAX).flat_map(|a| (0..=u8::MAX).map(move |t| (a, t))) {
        let mark = format!("{} ", ascii::mark(actual, target));
        assert!(ascii::LEGEND.contains(&mark) && help.contains(&mark), "{mark}");
    }
    for exercise in quiz::CHAPTERS.iter().flat_map(|chapter| &chapter.exercises) {
        let solution = exercise.solution();
        for language in [Language::English, Language::Chinese] {
            let Some(legend) = quiz_page::legend(&solution, language) else { continue };
            let mut used =
                solution.grids.iter().flat_map(|(_, rows)| rows).flat_map(|row| row.chars());
            assert!(used.all(|c| legend.contains(&format!("{c} "))), "{legend}");
        }
    }
    let strict = Convention::default().rule(Rule::Inclusive);
    let options =
        rasterproof_verify::comparison::Options::default().cases(60).family(FamilyName::Fan);
    let message = judge_coverage(&strict, &options).unwrap().check().unwrap_err().to_string();
    assert!(message.contains(ascii::LEGEND), "{message}");
}

/// A window larger than what is printed shows a pixel that differs, wherever others are.
#[test]
fn a_part_of_a_picture_shows_a_difference() {
    let window = PixelRect::window(400, 300);
    let (mut drawn, expected) = (Coverage::new(window, 0), Coverage::new(window, 0));
    drawn.hit(2, 390, 391);
    drawn.hit(290, 1, 2);
    let grid = ascii::grid(&drawn, &expected);
    assert!(grid.iter().any(|row| row.contains('+')), "{grid:?}");
}
