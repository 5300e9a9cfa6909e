//! The line protocol, through the program itself: answers, refusals, robustness.

use crate::program::shared;
use crate::snapshots::check_words;

/// What the program answers to these bytes; it must end with status 0.
pub fn ask(engine: &str, requests: &[u8]) -> Vec<String> {
    let run = shared().run_on(requests, ["engine", engine]).has(0);
    run.out.lines().map(str::to_owned).collect()
}

/// Engines, and a request that each of them answers alike, in a conversation of its own.
const REQUESTS: &str = include_str!("../data/protocol.txt");

#[test]
fn requests_are_answered_as_kept() {
    let mut spoken = String::new();
    for line in REQUESTS.lines() {
        spoken += &format!("{line}\n");
        let Some((engines, request)) = line.split_once(": ").filter(|_| !line.starts_with('#'))
        else {
            continue;
        };
        let answered = |engine| ask(engine, format!("{request}\n").as_bytes()).join("\n");
        let mut answers: Vec<_> = engines.split(' ').map(answered).collect();
        // Only greetings name the engine.
        if !request.starts_with("HELLO") {
            assert!(answers.windows(2).all(|two| two[0] == two[1]), "{line}: {answers:?}");
            answers.truncate(1);
        }
        spoken += &format!("< {}\n", answers.join("\n< "));
    }
    check_words("protocol", &spoken);
}

#[test]
fn values_are_perspective_correct() {
    // Worked out by hand in `oracle::values`: v = 8/23 and depth 25/4 at pixel (1, 0).
    for engine in ["scanline", "edge-function", "oracle"] {
        let answers = ask(engine, b"I 7 4 4 0 0 0 1 0 5 4 0 10 2 1 5 0 4 20 4 2 5\n");
        let words: Vec<&str> = answers[0].split(' ').collect();
        assert_eq!(words[..3], ["F", "7", "6"], "{engine}");
        let at = words[3..].chunks(5).find(|f| f[0] == "1" && f[1] == "0").expect("pixel (1, 0)");
        let number = |i: usize| at[i].parse::<f64>().unwrap();
        assert!((number(2) - 6.25).abs() < 1e-13, "{engine}: {at:?}");
        assert!((number(3) - 8.0 / 23.0).abs() < 1e-15, "{engine}: {at:?}");
        assert!((number(4) - 5.0).abs() < 1e-14, "{engine}: {at:?}");
    }
}

/// One conversation: each is answered in its turn, after whatever came before.
#[test]
fn bad_requests_are_survived() {
    let requests = include_str!("../data/protocol-bad.txt");
    // What is no text, blank lines, a line that is too long, and a last one that has no end.
    let long = "7".repeat(200_000);
    let rest = [b"\xff\xfe T\n\n   \n", long.as_bytes(), b"\nT last 2 2 0 0 2 0 2 2"].concat();
    let answers = ask("edge-function", &[requests.as_bytes(), &rest].concat());
    let shown = ["(no text)", "(too long)", "T last 2 2 0 0 2 0 2 2"];
    let spoken = requests.lines().chain(shown).zip(&answers);
    let spoken: String =
        spoken.map(|(request, answer)| format!("{request}\n< {answer}\n")).collect();
    assert_eq!(answers.len(), requests.lines().count() + shown.len(), "{spoken}");
    check_words("protocol-bad", &spoken);
}

/// What would take gigabytes or minutes is refused instead, with the limit.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn answers_are_bounded() {
    let corners = "-20000 -20000 0 40000 -20000 0 -20000 40000 0";
    let many = " 1".repeat(65 * 9);
    for (engine, request, answer) in [
        (
            "oracle",
            format!("D d 16384 16384 {corners} {corners} {corners}"),
            "E d more than 1048576 fragments, which is the most of a request: ask for a smaller window",
        ),
        (
            "games101-strict",
            "T t 16384 16384 -20000 -20000 40000 -20000 -20000 40000".to_owned(),
            "E t 186918160 runs or pixels; a specimen answers with at most 4194304: ask for a smaller window",
        ),
        (
            "oracle",
            format!("D c 2 1{many}"),
            "E c D takes an id, width, height and 9 numbers for each of 1 to 64 triangles; 588 words follow",
        ),
    ] {
        assert_eq!(ask(engine, format!("{request}\n").as_bytes()), [answer], "{engine}: {request}");
    }
}
