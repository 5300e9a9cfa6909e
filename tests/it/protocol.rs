//! The line protocol, through the program itself: answers, refusals, robustness.

use crate::program::shared;
use crate::snapshots::check_words;

/// What the program answers to these bytes; it must end with status 0.
pub fn ask(engine: &str, requests: &[u8]) -> Vec<String> {
    let run = shared().run_on(requests, ["engine", engine]).has(0);
    run.out.lines().map(str::to_owned).collect()
}

/// Engines, and a request that each of them answers alike, in a conversation of its own.
const REQUESTS: &str = "\
# What an engine can do, in both versions
scanline bresenham oracle dda scanline-exact edge-function-exact oracle-exact: HELLO 1
oracle: HELLO 3
dda: HELLO 2
book-ch2 book-ch11-fixed book-dda: HELLO 1

# Corners on centres, in decimal and in hexadecimal; a triangle without area
scanline edge-function oracle: T a 8 8 0.5 0.5 5.5 0.5 5.5 5.5
scanline edge-function oracle: T h 8 8 0x1p-1 0x.8p0 0x1.6p2 +0.5 5.5e0 0X1.6P+2
scanline edge-function oracle: T e 8 8 1 1 1 1 5 5

# The upper left half of a pixel: its diagonal from (1, 0) to (0, 1) passes between the samples (6, 2) and (2, 10) on one
# side and (14, 6) and (10, 14) on the other.
scanline edge-function oracle: S a 2 2 0 0 1 0 0 1
scanline edge-function oracle: S b 2 1 0 0 2 0 0 2

# The second triangle has z = x / 2 and goes through the first, whose z is 1/2, at x = 1.
scanline edge-function oracle: D a 2 1 0 0 0.5 4 0 0.5 0 4 0.5 0 0 0 4 0 2 0 4 0
scanline edge-function oracle: D b 2 2 0 0 1 1 0 1 0 1 1
oracle: D c 2 1 0 0 0.5 4
oracle: D d 2 1 0 0 0.5 4 0 0.5 0 4 0.5 0 0 0 4 0 nan 0 4 0
dda: D e 2 1 0 0 0.5 4 0 0.5 0 4 0.5 0 0 0 4 0 2 0 4 0

# Two corners are kept, and the edges to the third are halved: its z + w is -1, theirs is 1.
scanline edge-function oracle: N a 0 0 0 1 4 0 0 1 0 4 -2 1
scanline edge-function oracle: N b 0 0 -2 1 4 0 -2 1 0 4 -2 1
oracle: N c 1 2
oracle: N d 0 0 0 inf 4 0 0 1 0 4 -2 1
bresenham: N e 0 0 0 1 4 0 0 1 0 4 -2 1

# A hundredth of a subpixel beside the centres of the diagonal: snapping would make it a tie.
scanline: T a 4 4 0.00004 0 4 0 4.00004 4
scanline-exact edge-function-exact oracle-exact: T a 4 4 0.00004 0 4 0 4.00004 4
scanline-exact edge-function-exact oracle-exact: T b 4 4 -0x1p-149 0 4 0 4 4
scanline-exact edge-function-exact oracle-exact: T c 4 4 0 0 nan 0 4 4
scanline-exact edge-function-exact oracle-exact: T d 4 4 0 0 4 0 4 -inf
scanline-exact edge-function-exact oracle-exact: T e 4 4 8388608 0 4 0 4 4
scanline-exact edge-function-exact oracle-exact: T f 4 4 0 0 4 0 4
scanline-exact edge-function-exact oracle-exact: L g 4 4 0 0 4 4
scanline-exact edge-function-exact oracle-exact: I h 4 4 0 0 0 1 0 0 4 0 0 1 0 0 4 4 0 1 0 0

# Lines in the order in which they are drawn
dda bresenham oracle: L 1 64 64 8 3 0 0
dda bresenham oracle: L 2 64 64 0.5 0.5 8.5 3.5
dda bresenham oracle: L 3 64 64 -1e9 -1e9 1e9 1e9
dda: L b 8 8 0 0 1e300 1
dda: L b 8 8 0 nan 1 1

# What an engine does not do
dda: T b 8 8 0 0 1 1 2 2
scanline-exact: S b 8 8 0 0 1 1 2 2
scanline: L b 8 8 0 0 1 1
book-ch2: I v 8 8 0 0 0 1 0 0 1 1 0 1 0 0 2 2 0 1 0 0

# The oracle says no to what would take hours; engines stream it.
oracle: I big 16384 16384 0 0 0 1 0 0 16384 0 0 1 0 0 0 16384 0 1 0 0

# Specimens take positions as they are: a triangle that holds no sample is drawn twice. Figure 2-4: a flat edge leaves the
# triangle, which chapter 2 clamps and chapter 3 does not.
book-ch2: T n 64 64 1.7 62.3 2.3 62.3 2 61.7
book-ch2: T f 64 64 4.75 60.50001 4 60.49999 5.55 60.49999
book-ch3: T f 64 64 4.75 60.50001 4 60.49999 5.55 60.49999
book-dda: L e 64 64 0.5 62.5 3.5 59.5

# They say why they do not draw. The smallest division by zero is at pixel (10, 4) of the book's screen.
book-ch2: T o 64 64 3e9 63.5 3000000008 63.5 3e9 55.5
book-ch2: T h 64 64 -1e9 -1e9 1e9 1e9 3 2e9
book-ch2: T x 8 8 0 nan 1 1 2 2
book-ch11: I w 8 8 0 0 0 0 0 0 1 1 0 1 0 0 2 2 0 1 0 0
book-ch11: I z 64 64 10.25 59.5 0 1 0 0 10.75 59.5 0 2 1 0 10.5 55.5 0 1 0 1
";

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
    let requests = "\
T b 8 8 nan 0 1 1 2 2
T b 8 8 0 -inf 1 1 2 2
T b 8 8 0 0 1e300 1 2 2
T b 8 8 0 0 1 1 2 8388607.998046875
I b 8 8 0 0 0 1 0 0 4 0 0 0 0 0 0 4 0 1 0 0
T b 8 8 0 0 1 1 2
T b 8 8 0 0 1 1 2 2 3
T b 0 8 0 0 1 1 2 2
T b 8 1000000000 0 0 1 1 2 2
T b 8 1e9 0 0 1 1 2 2
T b -8 8 0 0 1 1 2 2
T b 8 8 0 0 one 1 2 2
T b 8 8 0 0 0x 1 2 2
T b 8 8 0 0 -+1 1 2 2
X b 8 8
T
S b 8 8 0 0 1 1 8388607.9 2
I b 8 8 0 0 0 0 0 0 1 1 0 1 0 0 2 2 0 1 0 0
";
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
