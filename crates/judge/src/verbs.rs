//! Verbs beside triangles and thin lines: right engines, what is declared, and faults that are found and explained.

use rasterproof_core::contract::Rasterize as _;
use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_core::triangle::{Span, ValuePlace, WideForm, WideLine};
use rasterproof_registry::engines::{self, SampleValues, WideLines};
use rasterproof_verify::cases::formulas;
use rasterproof_verify::oracle::Oracle;
use rasterproof_verify::oracle::area::share;
use rasterproof_verify::oracle::formula::ExactNumber;

use super::ask::{ANSWER_LETTERS, Answer, Asked, Question, SampledValues, Subject, line};
use super::declared::{DEFAULT_TOLERANCE, Declared};
use super::expected::Expect as _;
use super::in_process::Inside;
use super::verdict::{Scores as _, Shapes, Verdict};
use super::{Asking, Options, judge};
use std::collections::BTreeSet;
use std::time::Duration;

/// A program that answers questions so.
struct Answering<F>(Declared, F);

impl<F: FnMut(&[Question], u64) -> Vec<Answer> + Send> Subject for Answering<F> {
    fn declared(&self) -> &Declared {
        &self.0
    }

    fn ask(&mut self, questions: &[Question], most_deaths: u64) -> Vec<Answer> {
        (self.1)(questions, most_deaths)
    }
}

/// With time to look for a cause.
fn patient(cases: u64, families: &[&str]) -> Options {
    families
        .iter()
        .map(|name| (*name).to_owned())
        .fold(Options::default().cases(cases), Options::family)
}

/// Without.
fn options(cases: u64, families: &[&str]) -> Options {
    patient(cases, families).terms(Asking { patience: Duration::ZERO, ..Asking::default() })
}

/// What comes of somebody who is judged without a look for a convention.
fn judged(asker: Box<dyn Subject>, options: &Options) -> Verdict {
    judge(&mut [asker], options, &|_| None, &|_| ())
}

/// An engine of the registry.
fn inside(name: &str) -> Box<dyn Subject> {
    Box::new(Inside::new(engines::find(name).unwrap()))
}

/// The families of a verb.
const WIDE: [&str; 2] = ["wide-line", "wide-line-design"];

/// What a program is judged that answers each question so.
fn judged_answers(
    words: &str,
    answer: impl Fn(&Question) -> Answer + Send + 'static,
    options: &Options,
) -> Verdict {
    let declared = Declared::parse(&format!("HELLO 2 x {words}")).unwrap();
    let answers = move |questions: &[Question], _: u64| questions.iter().map(&answer).collect();
    judged(Box::new(Answering(declared, answers)), options)
}

/// Whoever reads programs knows the letter of every answer.
#[test]
fn answers_begin_with_known_letters() {
    let run = Span { y_px: 0, x0_px: 0, x1_px: 1 };
    let answers = [
        Answer::Coverage(vec![run]),
        // Hits that are many are counted.
        Answer::Coverage(vec![run; 3]),
        Answer::Values(Vec::new()),
        Answer::Samples(Vec::new()),
        Answer::Line(Vec::new()),
        Answer::Seen(Vec::new()),
        Answer::Area(Vec::new()),
        Answer::SampleValues(Vec::new()),
        Answer::Polygon(Vec::new()),
        Answer::Carried(Vec::new()),
        Answer::Triangles(Vec::new()),
        Answer::Numbers(Vec::new()),
        Answer::Refused("no".to_owned()),
    ];
    // Each letter once; none may be missing in either list.
    let begun: BTreeSet<u8> = answers.iter().map(|answer| line(answer, 1).as_bytes()[0]).collect();
    assert_eq!(begun, ANSWER_LETTERS.iter().copied().collect());
}

/// What is said of why a program is wrong.
fn causes(verdict: &Verdict) -> String {
    let said =
        verdict.cause.iter().map(|why| format!("{}: {}", why.of, why.why.sentences().join(" ")));
    said.collect::<Vec<_>>().join("\n")
}

/// Runs of a line with a width, of a question about one.
fn wide(
    question: &Question,
    change: impl Fn(WideLine, WideForm) -> (WideLine, WideForm),
) -> Answer {
    let Asked::Wide(line) = &question.of else { return Answer::Refused(String::new()) };
    // The line as the fault takes it, drawn rightly.
    let (line, form) = change(*line, WideForm::Rectangle);
    let window = PixelRect::window(question.width, question.height);
    let mut runs = Vec::new();
    if line.width > 0 {
        WideLines { form }.cover(&line, window, &mut |run| runs.push(run));
    }
    Answer::Coverage(runs)
}

/// Each engine is right by its own form and wrong by the other.
#[test]
fn wide_lines_are_drawn_in_both_forms() {
    for (name, form) in [("wide-rectangles", "rectangle"), ("wide-parallelograms", "parallelogram")]
    {
        let verdict = judged(inside(name), &options(1000, &WIDE));
        assert!(verdict.agrees() && verdict.more.found.cases == 3000, "{:?}", verdict.failures);
        let as_other = |declared: &str| {
            let mut engine = inside(name);
            let declared =
                Declared::parse(&format!("HELLO 2 x wide-line wide={declared}")).unwrap();
            let answer = move |questions: &[Question], most| engine.ask(questions, most);
            judged(Box::new(Answering(declared, answer)), &patient(100, &WIDE))
        };
        assert!(as_other(form).agrees());
        let other = if form == "rectangle" { "parallelogram" } else { "rectangle" };
        let verdict = as_other(other);
        assert!(!verdict.agrees());
        let said = causes(&verdict);
        assert!(said.contains(&format!("draws lines with a width as {form}s")), "{said}");
    }
}

/// A program with a fault, and what is said of it.
type Fault = (fn(&Question) -> Answer, &'static str);

/// Each fault is found, on a small case, and said.
fn are_found_and_explained(words: &str, families: &[&str], faults: &[Fault]) {
    for &(fault, wanted) in faults {
        // The fault is found, its case is small, and the cause names it.
        let verdict = judged_answers(words, fault, &patient(200, families));
        assert!(!verdict.agrees(), "{wanted}");
        let case = &verdict.failures[0].case;
        assert!(case.window.width() <= 8 && case.window.height() <= 8, "{wanted}: {case:?}");
        let said = causes(&verdict);
        assert!(said.contains(wanted), "{wanted}: {said}");
    }
}

/// Widths, ends and forms that are wrong, and pixels that are lost or drawn twice.
const WIDE_FAULTS: [Fault; 8] = [
    (|q| wide(q, |line, form| (WideLine { width: 2 * line.width, ..line }, form)), "twice as wide"),
    (
        |q| {
            wide(q, |line, form| (WideLine { width: (line.width + 128) / 256 * 256, ..line }, form))
        },
        "rounded to whole pixels",
    ),
    (
        |q| wide(q, |line, form| (WideLine { width: line.width.max(256), ..line }, form)),
        "at least 1 px wide",
    ),
    (
        |q| {
            wide(q, |mut line, form| {
                for end in &mut line.ends {
                    (end.x, end.y) = (end.x & !15, end.y & !15);
                }
                (line, form)
            })
        },
        "from ends that are cut to 1/16 px",
    ),
    // Rectangles where the width is 2 px or more alone.
    (
        |q| {
            wide(q, |line, form| {
                (line, if line.width < 512 { WideForm::Parallelogram } else { form })
            })
        },
        "as parallelograms",
    ),
    // The last column of the window.
    (
        |q| {
            let mut answer = wide(q, |line, form| (line, form));
            if let Answer::Coverage(runs) = &mut answer {
                runs.iter_mut()
                    .for_each(|run| run.x1_px = run.x1_px.min(q.width as i32 - 1).max(run.x0_px));
            }
            answer
        },
        "does not draw",
    ),
    // Nothing of lines that go up.
    (
        |q| match (&q.of, wide(q, |line, form| (line, form))) {
            (Asked::Wide(line), _) if line.ends[1].y < line.ends[0].y => {
                Answer::Coverage(Vec::new())
            }
            (_, answer) => answer,
        },
        "does not draw",
    ),
    // A row is drawn twice.
    (
        |q| {
            let mut answer = wide(q, |line, form| (line, form));
            if let Answer::Coverage(runs) = &mut answer {
                runs.extend(runs.clone().into_iter().filter(|run| run.y_px == 3));
            }
            answer
        },
        "twice where the row is 3",
    ),
];

/// The same lines without a fault agree, so that each finding is of the fault.
#[test]
fn faults_of_wide_lines_are_found_and_explained() {
    let right =
        judged_answers("wide-line", |q| wide(q, |line, form| (line, form)), &options(50, &WIDE));
    assert!(right.agrees(), "{:?}", right.failures);
    are_found_and_explained("wide-line", &WIDE, &WIDE_FAULTS);
}

/// Every rule of samples on the border is declared, and judged.
#[test]
fn the_border_of_wide_lines_is_that_of_the_declared_rule() {
    for rule in ["top-right", "bottom-left", "bottom-right", "inclusive", "strict", "none"] {
        let declared = Declared::parse(&format!("HELLO 2 x wide-line rule={rule}")).unwrap();
        let verdict = judged_answers(
            &format!("wide-line rule={rule}"),
            move |q| {
                let Asked::Wide(line) = &q.of else { return Answer::Refused(String::new()) };
                let window = PixelRect::window(q.width, q.height);
                Answer::Coverage(declared.wide(line, window).unwrap().must)
            },
            &options(200, &WIDE),
        );
        assert!(verdict.agrees(), "{rule}: {:?}", verdict.failures);
        let top_left = judged_answers(
            &format!("wide-line rule={rule}"),
            |q| wide(q, |line, form| (line, form)),
            &options(200, &WIDE),
        );
        assert_eq!(top_left.agrees(), rule == "none", "{rule}");
    }
}

/// The families of shares.
const AREA: [&str; 2] = ["area", "area-design"];

/// Levels of a question about shares: what becomes of each share, in 255 steps.
fn levels(question: &Question, level: impl Fn(f64, [i32; 2]) -> f64) -> Answer {
    let Asked::Area(corners) = &question.of else { return Answer::Refused(String::new()) };
    let mut runs = Vec::new();
    for y_px in 0..question.height as i32 {
        for x_px in 0..question.width as i32 {
            let level = level(share(corners, x_px, y_px), [x_px, y_px]) as u8;
            if level > 0 {
                runs.push((Span { y_px, x0_px: x_px, x1_px: x_px + 1 }, level));
            }
        }
    }
    Answer::Area(runs)
}

/// The share of the samples of a pixel that are covered, in `n` rows of `n`.
fn sampled(question: &Question, n: i32) -> Answer {
    let Asked::Area(corners) = &question.of else { return Answer::Refused(String::new()) };
    levels(question, |_, [x_px, y_px]| {
        // Samples of a pixel are centres of pixels of a window that is finer.
        let finer =
            corners.map(|p| SubpixelPoint::new(p.x.saturating_mul(n), p.y.saturating_mul(n)));
        let window =
            PixelRect { x0: x_px * n, y0: y_px * n, x1: (x_px + 1) * n, y1: (y_px + 1) * n };
        let mut covered = 0;
        Oracle.cover(finer, window, |run| covered += run.x1_px - run.x0_px);
        (f64::from(covered) * 255.0 / f64::from(n * n)).round()
    })
}

/// Whoever rounds to the nearest step agrees, and whoever declares less gets more room.
#[test]
fn shares_are_judged_with_a_stated_tolerance() {
    let verdict = judged(inside("area"), &options(1000, &AREA));
    assert!(verdict.agrees() && verdict.more.found.cases == 3000, "{:?}", verdict.failures);
    let nearest = |share: f64, _: [i32; 2]| (share * 255.0).round();
    assert!(judged_answers("area", move |q| levels(q, nearest), &options(100, &AREA)).agrees());
    // Cut down, a level is off by less than a step: right where that is declared, and else wrong.
    let cut = |share: f64, _: [i32; 2]| (share * 255.0).floor();
    assert!(
        judged_answers("area area-tolerance=1", move |q| levels(q, cut), &options(100, &AREA))
            .agrees()
    );
    let verdict = judged_answers("area", move |q| levels(q, cut), &options(100, &AREA));
    let what = &verdict.failures[0].what;
    assert!(
        what.contains("of a level that is too small")
            && what.contains("the largest difference is "),
        "{what}"
    );
    // Fewer steps, and one winding.
    let coarse = |share: f64, _: [i32; 2]| (share * 4.0).round();
    assert!(
        judged_answers("area levels=4", move |q| levels(q, coarse), &options(100, &AREA)).agrees()
    );
    assert!(
        !judged_answers("area levels=5", move |q| levels(q, coarse), &options(100, &AREA)).agrees()
    );
    assert!(
        !judged_answers("area winding=cw", move |q| levels(q, nearest), &options(100, &AREA))
            .agrees()
    );
}

/// Levels that come of another share, of another rounding, or of no share at all.
const AREA_FAULTS: [Fault; 8] = [
    (|q| sampled(q, 4), "by 4 x 4 samples"),
    (|q| sampled(q, 1), "by the sample at the centre alone"),
    (|q| levels(q, |share, _| (share * 255.0).floor()), "rounds the share of a pixel down"),
    (
        |q| levels(q, |share, _| (share.sqrt() * 255.0).round()),
        "takes the square root of the share",
    ),
    (
        |q| levels(q, |share, _| if share > 0.0 { ((1.0 - share) * 255.0).round() } else { 0.0 }),
        "that is not covered",
    ),
    (|q| levels(q, |share, _| (share * 16.0).round()), "in steps of 1/16"),
    // What is hardly touched is lost.
    (
        |q| levels(q, |share, _| if share < 0.125 { 0.0 } else { (share * 255.0).round() }),
        "does not draw the share of a pixel",
    ),
    (
        |q| {
            let width = q.width as i32;
            levels(
                q,
                move |share, [x, _]| if x == width - 1 { 0.0 } else { (share * 255.0).round() },
            )
        },
        "does not draw the share of a pixel",
    ),
];

/// The same of levels.
#[test]
fn faults_of_shares_are_found_and_explained() {
    are_found_and_explained("area", &AREA, &AREA_FAULTS);
}

/// The families whose triangles have values.
const VALUED: [&str; 2] = ["w-4", "sample-value-design"];

/// Each engine is right by its own place and wrong by the others.
#[test]
fn values_of_samples_are_judged_where_they_are_declared() {
    for own in ValuePlace::ALL {
        let name = format!("values-at-{}s", own.name());
        let verdict = judged(inside(&name), &options(300, &VALUED));
        assert!(verdict.agrees(), "{name}: {:?}", verdict.failures);
        let values: u64 = verdict.families.iter().map(|row| row.values).sum();
        assert!(values > 1000, "{name}: {values}");
        for other in ValuePlace::ALL.into_iter().filter(|place| *place != own) {
            let mut engine = inside(&name);
            let declared = format!("HELLO 2 x sample-values values-at={}", other.name());
            let declared = Declared::parse(&declared).unwrap();
            let answer = move |questions: &[Question], most| engine.ask(questions, most);
            let verdict = judged(Box::new(Answering(declared, answer)), &patient(100, &VALUED));
            assert!(!verdict.agrees(), "{name} as {}", other.name());
            let said = causes(&verdict);
            let wanted = match own {
                ValuePlace::Centre => "computes the values of samples at the centre",
                ValuePlace::Sample => "computes the values of samples at the place of each",
                ValuePlace::Centroid => "computes the values of samples at the centroid",
            };
            assert!(said.contains(wanted), "{name} as {}: {said}", other.name());
        }
    }
}

/// The samples of a question with their values, each changed.
fn valued(question: &Question, change: impl Fn(&Question, &mut SampledValues) -> bool) -> Answer {
    let Asked::SampleValues(triangle) = &question.of else { return Answer::Refused(String::new()) };
    let window = PixelRect::window(question.width, question.height);
    let mut all = Vec::new();
    let drawn =
        SampleValues { at: ValuePlace::Centre }.cover(triangle, window, &mut |mask, values| {
            let mut one = SampledValues { mask, values };
            if change(question, &mut one) {
                all.push(one);
            }
        });
    drawn.map_or(Answer::Refused(String::new()), |()| Answer::SampleValues(all))
}

/// The attributes of the corners of a question, along an axis.
fn attributes(question: &Question, axis: usize) -> [f64; 3] {
    let Asked::SampleValues(triangle) = &question.of else { return [0.0; 3] };
    triangle.vertices.map(|v| v.varying[axis])
}

/// Values that are clamped or not corrected, and samples that are too many or lost.
const VALUE_FAULTS: [Fault; 5] = [
    // Nothing beyond what the corners have.
    (
        |q| {
            valued(q, |q, one| {
                for axis in 0..2 {
                    let [a, b, c] = attributes(q, axis);
                    let v = one.values.varying[axis];
                    one.values.varying[axis] = v.clamp(a.min(b).min(c), a.max(b).max(c));
                }
                let Asked::SampleValues(t) = &q.of else { return false };
                let [a, b, c] = t.vertices.map(|v| v.depth);
                one.values.depth = one.values.depth.clamp(a.min(b).min(c), a.max(b).max(c));
                true
            })
        },
        "clamps the values of samples to the range of the corners",
    ),
    // All w are 1.
    (
        |q| {
            let mut flat = q.clone();
            if let Asked::SampleValues(triangle) = &mut flat.of {
                triangle.vertices.iter_mut().for_each(|v| v.inv_w = 1.0);
            }
            valued(&flat, |_, _| true)
        },
        "without a correction for perspective",
    ),
    // As many samples as the triangle touches.
    (
        |q| {
            valued(q, |_, one| {
                one.mask = 15;
                true
            })
        },
        "draws all four samples of a touched pixel",
    ),
    (|q| valued(q, |_, one| one.values.y_px < 2), "does not draw the values of samples"),
    // A pixel that is covered in part alone is lost.
    (|q| valued(q, |_, one| one.mask == 15), "where the number of covered samples of the pixel is"),
];

#[test]
fn faults_of_values_of_samples_are_found_and_explained() {
    let right = judged_answers("sample-values", |q| valued(q, |_, _| true), &options(50, &VALUED));
    assert!(right.agrees(), "{:?}", right.failures);
    are_found_and_explained("sample-values", &VALUED, &VALUE_FAULTS);
}

/// The numbers of a formula, each off by so many tolerances.
fn computed(question: &Question, off: f64) -> Answer {
    let Asked::Formula(formula, numbers) = &question.of else {
        return Answer::Refused(String::new());
    };
    let given = formula.of(numbers).unwrap();
    let number = |given: &ExactNumber| given.exact.to_f64() + off * DEFAULT_TOLERANCE * given.scale;
    Answer::Numbers(given.iter().map(number).collect())
}

#[test]
fn formulas_are_judged_within_the_tolerance() {
    let families: Vec<_> = formulas::FAMILIES.iter().map(|family| family.name).collect();
    let options = options(50, &families);
    let oracle = judged(inside("oracle"), &options);
    assert!(oracle.agrees() && oracle.shapes(Shapes::Formulas) == 400, "{:?}", oracle.failures);
    for (off, agrees) in [(0.9, true), (-0.9, true), (1.1, false), (f64::NAN, false)] {
        let verdict = judged_answers("formulas", move |q| computed(q, off), &options);
        let wrong = verdict.families.iter().filter(|row| row.wrong_cases > 0).count();
        assert_eq!((verdict.agrees(), wrong), (agrees, if agrees { 0 } else { 8 }), "{off}");
    }
    // A number is missing, or one is too many.
    for count in [0, 4] {
        let cut = move |q: &Question| match computed(q, 0.0) {
            Answer::Numbers(mut numbers) => {
                numbers.resize(count, 0.0);
                Answer::Numbers(numbers)
            }
            other => other,
        };
        let verdict = judged_answers("formulas", cut, &options);
        assert!(verdict.families.iter().all(|row| row.wrong_cases == 50), "{count}");
    }
    // Who does not declare them is not asked.
    assert!(judged(inside("scanline"), &options).families.is_empty());
}
