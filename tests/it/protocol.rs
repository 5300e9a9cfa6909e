//! The line protocol, through the program itself: answers, refusals, robustness.

use std::io::Write;
use std::process::{Command, Stdio};

use crate::program::PROGRAM;

/// What the program answers to these bytes; it must end with status 0.
pub fn ask(engine: &str, requests: &[u8]) -> Vec<String> {
    let mut child = Command::new(PROGRAM)
        .args(["engine", engine])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    // Both at once: a pipe that is full in one direction must not stop the other.
    let mut stdin = child.stdin.take().unwrap();
    let output = std::thread::scope(|scope| {
        scope.spawn(move || stdin.write_all(requests).unwrap());
        child.wait_with_output().unwrap()
    });
    assert_eq!(output.status.code(), Some(0));
    String::from_utf8(output.stdout).unwrap().lines().map(str::to_owned).collect()
}

fn check(engine: &str, request: &str, answer: &str) {
    assert_eq!(ask(engine, format!("{request}\n").as_bytes()), [answer], "{engine}: {request}");
}

#[test]
fn hello_names_the_capabilities() {
    check("scanline", "HELLO 1", "HELLO 1 scanline coverage attributes samples4");
    check("bresenham", "HELLO 1", "HELLO 1 bresenham line");
    check("oracle", "HELLO 1", "HELLO 1 oracle coverage attributes samples4 line");
    let refusal = "E - this engine speaks versions 1 and 2: say HELLO 1 or HELLO 2";
    check("oracle", "HELLO 3", refusal);
    let line = "HELLO 2 dda line grid=256 origin=0.5,0.5 rule=top-left winding=both batch=1024";
    check("dda", "HELLO 2", line);
}

#[test]
fn coverage_of_a_triangle_on_centres() {
    for engine in ["scanline", "edge-function", "oracle"] {
        check(engine, "T a 8 8 0.5 0.5 5.5 0.5 5.5 5.5", "C a 5 0 0 5 1 1 5 2 2 5 3 3 5 4 4 5");
        check(
            engine,
            "T h 8 8 0x1p-1 0x.8p0 0x1.6p2 +0.5 5.5e0 0X1.6P+2",
            "C h 5 0 0 5 1 1 5 2 2 5 3 3 5 4 4 5",
        );
        check(engine, "T e 8 8 1 1 1 1 5 5", "C e 0");
    }
}

/// The upper left half of a pixel: its diagonal from (1, 0) to (0, 1) passes between the samples
/// (6, 2) and (2, 10) on one side and (14, 6) and (10, 14) on the other.
#[test]
fn samples_of_half_a_pixel() {
    for engine in ["scanline", "edge-function", "oracle"] {
        check(engine, "S a 2 2 0 0 1 0 0 1", "M a 1 0 0 1 5");
        check(engine, "S b 2 1 0 0 2 0 0 2", "M b 2 0 0 1 15 0 1 2 5");
    }
}

/// The second triangle has z = x / 2 and goes through the first, whose z is 1/2, at x = 1.
#[test]
fn the_nearest_triangle_is_seen() {
    let pile = "0 0 0.5 4 0 0.5 0 4 0.5 0 0 0 4 0 2 0 4 0";
    for engine in ["scanline", "edge-function", "oracle"] {
        check(engine, &format!("D a 2 1 {pile}"), "V a 2 0 0 1 1 0 1 2 0");
        check(engine, "D b 2 2 0 0 1 1 0 1 0 1 1", "V b 0");
    }
    let refusal = "E c D takes an id, width, height and 9 numbers for each of 1 to 64 triangles";
    check("oracle", "D c 2 1 0 0 0.5 4", &format!("{refusal}; 7 words follow"));
    check(
        "oracle",
        &format!("D c 2 1{}", " 1".repeat(65 * 9)),
        &format!("{refusal}; 588 words follow"),
    );
    let nan = format!("D d 2 1 {}", pile.replace("0 0 0 4 0 2", "0 0 0 4 0 nan"));
    check("oracle", &nan, "E d of triangle 1: z1 is not a number (NaN)");
    check("dda", &format!("D e 2 1 {pile}"), "E e unsupported");
}

/// Two corners are kept, and the edges to the third are halved: its z + w is -1, theirs is 1.
#[test]
fn the_near_plane_cuts() {
    for engine in ["scanline", "edge-function", "oracle"] {
        let quad = "G a 4 0 0 0 1 4 0 0 1 2 2 -1 1 0 2 -1 1";
        check(engine, "N a 0 0 0 1 4 0 0 1 0 4 -2 1", quad);
        check(engine, "N b 0 0 -2 1 4 0 -2 1 0 4 -2 1", "G b 0");
    }
    check("oracle", "N c 1 2", "E c N takes an id and 12 numbers; 3 words follow");
    check("oracle", "N d 0 0 0 inf 4 0 0 1 0 4 -2 1", "E d w0 is infinite");
    check("bresenham", "N e 0 0 0 1 4 0 0 1 0 4 -2 1", "E e unsupported");
}

#[test]
fn lines_in_drawing_order() {
    for engine in ["dda", "bresenham", "oracle"] {
        check(engine, "L 1 64 64 8 3 0 0", "P 1 9 8 3 7 3 6 2 5 2 4 2 3 1 2 1 1 0 0 0");
        check(engine, "L 2 64 64 0.5 0.5 8.5 3.5", "P 2 9 0 0 1 0 2 1 3 1 4 2 5 2 6 2 7 3 8 3");
        check(
            engine,
            "L 3 64 64 -1e9 -1e9 1e9 1e9",
            &format!("P 3 64{}", (0..64).map(|i| format!(" {i} {i}")).collect::<String>()),
        );
    }
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

#[test]
fn bad_requests_are_answered_and_survived() {
    let cases: [(&str, &str); 18] = [
        ("T b 8 8 nan 0 1 1 2 2", "E b x0 is not a number (NaN)"),
        ("T b 8 8 0 -inf 1 1 2 2", "E b y0 is infinite"),
        ("T b 8 8 0 0 1e300 1 2 2", "E b x1 1e300 px is outside the domain [-8388608, 8388608) px"),
        (
            "T b 8 8 0 0 1 1 2 8388607.998046875",
            "E b y2 8.388607998046875e6 px is outside the domain [-8388608, 8388608) px: rounded to 1/256 px it is 8388608",
        ),
        (
            "I b 8 8 0 0 0 1 0 0 4 0 0 0 0 0 0 4 0 1 0 0",
            "E b w1 0e0 is outside the accepted range [6.223015277861142e-61, 1.6069380442589903e60]",
        ),
        ("T b 8 8 0 0 1 1 2", "E b T takes an id, width, height and 6 numbers; 8 words follow"),
        (
            "T b 8 8 0 0 1 1 2 2 3",
            "E b T takes an id, width, height and 6 numbers; 10 words follow",
        ),
        ("T b 0 8 0 0 1 1 2 2", "E b width '0' is not a whole number from 1 to 16384"),
        (
            "T b 8 1000000000 0 0 1 1 2 2",
            "E b height '1000000000' is not a whole number from 1 to 16384",
        ),
        ("T b 8 1e9 0 0 1 1 2 2", "E b height '1e9' is not a whole number from 1 to 16384"),
        ("T b -8 8 0 0 1 1 2 2", "E b width '-8' is not a whole number from 1 to 16384"),
        ("T b 8 8 0 0 one 1 2 2", "E b number 3 'one' cannot be read"),
        ("T b 8 8 0 0 0x 1 2 2", "E b number 3 '0x' cannot be read"),
        ("T b 8 8 0 0 -+1 1 2 2", "E b number 3 '-+1' cannot be read"),
        ("X b 8 8", "E b unknown request 'X'; expected HELLO, T, L, I, S, D, N"),
        ("T", "E - T takes an id, width, height and 6 numbers; 0 words follow"),
        (
            "S b 8 8 0 0 1 1 8388607.9 2",
            "E b a corner lies within half a pixel of the domain's end, where samples have no place",
        ),
        (
            "I b 8 8 0 0 0 0 0 0 1 1 0 1 0 0 2 2 0 1 0 0",
            "E b w0 0e0 is outside the accepted range [6.223015277861142e-61, 1.6069380442589903e60]",
        ),
    ];
    let mut requests: Vec<u8> = Vec::new();
    for (request, _) in cases {
        requests.extend_from_slice(request.as_bytes());
        requests.push(b'\n');
    }
    requests.extend_from_slice(b"\xff\xfe T\n\n   \n");
    requests.extend(std::iter::repeat_n(b'7', 200_000));
    // The last line has no end.
    requests.extend_from_slice(b"\nT last 2 2 0 0 2 0 2 2");
    let answers = ask("edge-function", &requests);
    let mut expected: Vec<String> = cases.iter().map(|(_, answer)| (*answer).to_owned()).collect();
    expected.extend(
        [
            "E - the request is not UTF-8",
            "E - a request has at most 65536 bytes",
            "C last 2 0 0 2 1 1 2",
        ]
        .map(str::to_owned),
    );
    assert_eq!(answers, expected);
    check("dda", "T b 8 8 0 0 1 1 2 2", "E b unsupported");
    check("scanline-exact", "S b 8 8 0 0 1 1 2 2", "E b unsupported");
    check("scanline", "L b 8 8 0 0 1 1", "E b unsupported");
    check(
        "dda",
        "L b 8 8 0 0 1e300 1",
        "E b x1 1e300 is outside the domain of lines, [-2^31, 2^31) px",
    );
    check("dda", "L b 8 8 0 nan 1 1", "E b y0 is not a number (NaN)");
}

/// The oracle says no to what would take hours, the engines stream it.
#[test]
fn absurd_windows_are_bounded() {
    let request = "I big 16384 16384 0 0 0 1 0 0 16384 0 0 1 0 0 0 16384 0 1 0 0";
    check(
        "oracle",
        request,
        "E big more than 1048576 fragments, which is the most that the oracle computes for a request",
    );
}

/// What would take gigabytes or minutes is refused instead, with the limit.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn answers_are_bounded() {
    let corners = "-20000 -20000 0 40000 -20000 0 -20000 40000 0";
    check(
        "oracle",
        &format!("D d 16384 16384 {corners} {corners} {corners}"),
        "E d more than 1048576 fragments, which is the most of a request: ask for a smaller window",
    );
    check(
        "games101-strict",
        "T t 16384 16384 -20000 -20000 40000 -20000 -20000 40000",
        "E t 186918160 runs or pixels; a specimen answers with at most 4194304: ask for a smaller window",
    );
}

/// Specimens take positions as they are, hit pixels twice and say why they do not draw.
#[test]
fn specimens_speak_too() {
    check("book-ch2", "HELLO 1", "HELLO 1 book-ch2 coverage");
    check("book-ch11-fixed", "HELLO 1", "HELLO 1 book-ch11-fixed coverage attributes");
    check("book-dda", "HELLO 1", "HELLO 1 book-dda line");
    // A triangle that holds no sample, drawn twice.
    check("book-ch2", "T n 64 64 1.7 62.3 2.3 62.3 2 61.7", "C n 2 62 1 2 62 1 2");
    // Figure 2-4: a flat edge leaves the triangle, which chapter 2 clamps and chapter 3 does not.
    let flat = "T f 64 64 4.75 60.50001 4 60.49999 5.55 60.49999";
    check("book-ch2", flat, "C f 3 61 4 5 60 3 6 60 5 6");
    check("book-ch3", flat, "C f 3 61 4 5 60 0 64 60 3 6");
    check("book-dda", "L e 64 64 0.5 62.5 3.5 59.5", "P e 3 0 62 1 61 2 60");
    let overflow = "E o the published code converts 2.9999999995e9 to an int, which is undefined";
    check("book-ch2", "T o 64 64 3e9 63.5 3000000008 63.5 3e9 55.5", overflow);
    let far = "T h 64 64 -1e9 -1e9 1e9 1e9 3 2e9";
    assert!(
        ask("book-ch2", format!("{far}\n").as_bytes())[0].starts_with("E h the published loop")
    );
    check("book-ch2", "T x 8 8 0 nan 1 1 2 2", "E x y0 is not a number (NaN)");
    check("book-ch2", "I v 8 8 0 0 0 1 0 0 1 1 0 1 0 0 2 2 0 1 0 0", "E v unsupported");
    check(
        "book-ch11",
        "I w 8 8 0 0 0 0 0 0 1 1 0 1 0 0 2 2 0 1 0 0",
        "E w w0 0e0 is outside the accepted range [6.223015277861142e-61, 1.6069380442589903e60]",
    );
    // The smallest division by zero: pixel (10, 4) of the book's screen.
    let values =
        ask("book-ch11", b"I z 64 64 10.25 59.5 0 1 0 0 10.75 59.5 0 2 1 0 10.5 55.5 0 1 0 1\n");
    assert!(values[0].contains(" 10 59 0 inf "), "{}", values[0]);
}
