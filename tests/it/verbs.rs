//! Verbs of the protocol beside triangles and thin lines: right engines, what is declared, faults that are found and explained, and
//! the starters.

use std::fs;
use std::process::Command;

use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::{WideForm, WideLine};
use rasterproof_judge::ask::{Answer, Asked, Question, Subject};
use rasterproof_judge::declared::Declared;
use rasterproof_judge::verdict::Verdict;
use rasterproof_registry::engines::WideLines;

use crate::judge::{Answering, inside, judged, options, patient};
use crate::program::{Folder, has};

/// The families of a verb.
const WIDE: [&str; 2] = ["wide-line", "wide-line-design"];

/// What a program is judged that answers each question so.
fn judged_answers(
    words: &str,
    answer: impl Fn(&Question) -> Answer + Send + 'static,
    options: &rasterproof_judge::Options,
) -> Verdict {
    let declared = Declared::parse(&format!("HELLO 2 x {words}")).unwrap();
    let answers = move |questions: &[Question], _: u64| questions.iter().map(&answer).collect();
    judged(Box::new(Answering(declared, answers)), options)
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
        assert!(verdict.agrees() && verdict.cases == 2000, "{:?}", verdict.failures);
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

/// A fault of a program that draws wide lines, and what is said of it.
type WideFault = (fn(&Question) -> Answer, &'static str);

const WIDE_FAULTS: [WideFault; 8] = [
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
        "",
    ),
];

#[test]
fn faults_of_wide_lines_are_found_and_explained() {
    let right =
        judged_answers("wide-line", |q| wide(q, |line, form| (line, form)), &options(50, &WIDE));
    assert!(right.agrees(), "{:?}", right.failures);
    for (fault, wanted) in WIDE_FAULTS {
        let verdict = judged_answers("wide-line", fault, &patient(200, &WIDE));
        assert!(!verdict.agrees(), "{wanted}");
        let case = &verdict.failures[0].case;
        assert!(case.window.width() <= 8 && case.window.height() <= 8, "{wanted}: {case:?}");
        let said = causes(&verdict);
        println!("{wanted}\n  {said}");
        assert!(said.contains(wanted), "{wanted}: {said}");
    }
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
                let expect = &declared as &dyn rasterproof_judge::expected::Expect;
                Answer::Coverage(expect.wide(line, window).unwrap().must)
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

/// In each starter a function is written in the stead of what it lacks: by twice the area beside the segment, and along it.
const WIDE_IN_STARTERS: [(&str, &str, &str, &str); 3] = [
    (
        "py",
        "python3",
        "values = samples = depth = clip = clip_attributes = wide_line = None",
        "
values = samples = depth = clip = clip_attributes = None
def wide_line(x0, y0, x1, y1, line_width, width, height, set_pixel):
    dx, dy = x1 - x0, y1 - y0
    for y in range(height):
        for x in range(width):
            sx, sy = x + 0.5 - x0, y + 0.5 - y0
            beside, along, length = dx * sy - dy * sx, dx * sx + dy * sy, dx * dx + dy * dy
            if length and 4 * beside * beside <= line_width * line_width * length and 0 <= along <= length:
                set_pixel(x, y)
",
    ),
    (
        "cpp",
        "c++",
        "static const rasterproof_wide_line wide_line = nullptr;",
        "
static void wide_line(double x0, double y0, double x1, double y1, double line_width, int width, int height,
                      rasterproof_set_pixel set_pixel) {
    const double dx = x1 - x0, dy = y1 - y0, length = dx * dx + dy * dy;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            const double sx = x + 0.5 - x0, sy = y + 0.5 - y0, beside = dx * sy - dy * sx, along = dx * sx + dy * sy;
            if (length > 0 && 4 * beside * beside <= line_width * line_width * length && 0 <= along && along <= length)
                set_pixel(x, y);
        }
}
",
    ),
    (
        "rs",
        "rustc",
        "const WIDE_LINE: Option<WideLine> = None;",
        "
const WIDE_LINE: Option<WideLine> = Some(wide_line);
fn wide_line([a, b]: [(f64, f64); 2], line_width: f64, width: i32, height: i32, set_pixel: &mut dyn FnMut(i32, i32)) {
    let (dx, dy) = (b.0 - a.0, b.1 - a.1);
    let length = dx * dx + dy * dy;
    for (y, x) in (0..height).flat_map(|y| (0..width).map(move |x| (y, x))) {
        let (sx, sy) = (f64::from(x) + 0.5 - a.0, f64::from(y) + 0.5 - a.1);
        let (beside, along) = (dx * sy - dy * sx, dx * sx + dy * sy);
        if length > 0.0 && 4.0 * beside * beside <= line_width * line_width * length && (0.0..=length).contains(&along) {
            set_pixel(x, y);
        }
    }
}
",
    ),
];

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn starters_draw_wide_lines() {
    let mut judged = 0;
    for (ending, tool, place, body) in WIDE_IN_STARTERS.into_iter().filter(|of| has(of.1)) {
        let folder = Folder::new(&format!("verbs-{ending}"));
        let adapters = concat!(env!("CARGO_MANIFEST_DIR"), "/adapters");
        let text = fs::read_to_string(format!("{adapters}/starter.{ending}")).unwrap();
        assert!(text.contains(place), "{ending}");
        let text = text
            .replace(place, body.trim_start())
            .replace("\"batch=64", "\"rule=inclusive range=4096 batch=64");
        folder.put(&format!("starter.{ending}"), &text);
        fs::copy(format!("{adapters}/rasterproof.h"), folder.join("rasterproof.h")).unwrap();
        let built = match tool {
            "python3" => true,
            "c++" => Command::new("c++")
                .args(["-O2", "starter.cpp", "-o", "mine"])
                .current_dir(&*folder)
                .status()
                .unwrap()
                .success(),
            _ => Command::new("rustc")
                .args(["-O", "--edition", "2024", "starter.rs", "-o", "mine"])
                .current_dir(&*folder)
                .status()
                .unwrap()
                .success(),
        };
        assert!(built, "{ending}");
        let command =
            if tool == "python3" { vec!["python3", "starter.py"] } else { vec!["./mine"] };
        let words: Vec<&str> = [
            "judge",
            "--cases",
            "300",
            "--family",
            "wide-line",
            "--family",
            "wide-line-design",
            "--",
        ]
        .into_iter()
        .chain(command)
        .collect();
        folder.check(words, 0).prints("wide-line-design");
        judged += 1;
    }
    assert!(judged > 0);
}
