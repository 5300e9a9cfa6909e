//! What the judge shows: pictures of every stage, what happens before the families, and no agreement where
//! there was nothing to judge.

use std::time::Duration;

use rasterproof_judge::ask::{Answer, Ask, Asked, Breach, Question};
use rasterproof_judge::declared::Declared;
use rasterproof_judge::in_process::Inside;
use rasterproof_judge::recognise::{Scope, recognise};
use rasterproof_judge::verdict::Outcome;
use rasterproof_judge::{Options, judge};
use rasterproof_registry::engines;
use rasterproof_report::html::page;
use rasterproof_report::judge_text as shown;
use rasterproof_verify::cases::Shape;
use rasterproof_verify::cases::near_plane::clip_corners;

#[cfg(target_os = "linux")]
use crate::judge::is_gone;
use crate::judge::{Answering, judged, of, options, property};
use crate::program::{PROGRAM, check};

/// Where nothing is expected, who draws nothing does not agree: there was no judgement.
#[test]
fn judge_refuses_an_empty_case() {
    let families = ["--family", "half-integer", "--declare", "range=1", "--declare", "window=1x1"];
    check(of(&families, &["scanline"]), 2).says("no pixel was expected");
    check(of(&["--family", "degenerate"], &["scanline"]), 0);
}

/// An engine that shows the first triangle of a pile everywhere, clips nothing, and covers all samples
/// of a pixel that it touches.
struct Careless(Inside);

impl Ask for Careless {
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
                (Asked::Near(triangle), Answer::Polygon(corners)) => {
                    *corners = clip_corners(triangle).to_vec();
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
    let options = Options { patience: Duration::from_secs(5), ..options(64, &STAGES) };
    let careless = Careless(Inside::new(engines::find("scanline").unwrap()));
    let verdict = judged(Box::new(careless), &options);
    for (property, of, triangles, bits) in [
        ("depth-order", "of the pile is seen", 2, 10),
        ("near-plane", "x and y of clip space", 1, 8),
        ("samples4", "a grid of 4 x 4 cells", 1, 12),
    ] {
        let failure = verdict.failures.iter().find(|f| f.property == property).unwrap();
        let picture = failure.picture.as_ref().unwrap();
        assert!(picture.of.contains(of) && picture.drawn != picture.expected, "{failure:?}");
        let Shape::Triangles { list, .. } = &failure.case.shape else { panic!("{property}") };
        let corners = list.iter().flat_map(|t| t.corners());
        let bits_of = |sub: i32| sub.unsigned_abs().count_ones();
        let used: u32 = corners.map(|p| bits_of(p.x) + bits_of(p.y)).sum();
        assert!(list.len() == triangles && used <= bits, "{property}: {used} {:?}", failure.case);
    }
    let repeat = |family: &str, index: u64| format!("{family} {index}");
    let text = shown::text(&verdict, "", &repeat, (false, false));
    let page = page(&shown::page(&verdict, "", &repeat));
    for part in ["depth-order#", "near-plane#", "The picture: the four samples", "ch07.md"] {
        assert!(page.contains(part), "{part}");
    }
    assert_eq!(text.matches("judged").count(), 3, "{text}");
    assert!(text.contains("(x and y of clip space, before the division; a cell is "), "{text}");
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
    let limit = Some(Duration::from_secs(6));
    let options = Options { time_limit: limit, ..options(100_000, &[]) };
    let start = std::time::Instant::now();
    let scope = Scope { triangles: true, lines: true, always: false };
    let recognise = |program: &mut dyn Ask| recognise(program, scope);
    let verdict = judge(&mut [Box::new(slow)], &options, &recognise, &|_| ());
    let took = start.elapsed();
    // Asked without a limit, 64 cases of each family alone take longer.
    assert!(took < Duration::from_secs(60), "{took:?}");
    let said = verdict.recognised.as_ref().unwrap();
    assert_eq!(said.sentences, ["The time was up before its convention was found."]);
    assert!(verdict.by_convention().is_none());
    let families = verdict.found.rows.iter().filter(|row| row.cases > 0).count();
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
    let text = shown::text(&verdict, "", &|_, _| String::new(), (false, false));
    assert!(
        text.contains("before the families: it crashes: signal 11\n  request:  T 1 "),
        "{text}"
    );
}
