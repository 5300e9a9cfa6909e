//! Arbitrary input: any bytes to the protocol, any bits as coordinates to every engine. No panic, no
//! hang, no pixel outside the window or hit twice; outside the domain a refusal with a reason.
//!
//! Overflow checks and debug assertions are on. `cargo test --test it -- --ignored ten_million` takes
//! ten million triangles instead of the few hundred thousand of every run.

use std::io::Cursor;

use glam::DVec2;
use proptest::prelude::*;
use rasterproof::cli::{self, Streams};
use rasterproof_core::contract::{DrawLine, Interpolate, RasterizeExact};
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::random::Rng;
use rasterproof_core::triangle::{
    FreeCorners, LineEnd, PixelPoint, ScreenLine, ScreenTriangle, ScreenVertex, check_value,
};
use rasterproof_registry::engines::{ENTRIES, Engine, ExactEngine, LineEngine};
use rayon::prelude::*;

use crate::recorded::hits;

/// Any bits at all: of an f32, of an f64, or of an f64 whose exponent makes it a coordinate.
fn number(rng: &mut Rng) -> f64 {
    let bits = rng.next();
    match bits & 7 {
        0 => f64::from_bits(rng.next()),
        1..=3 => f64::from(f32::from_bits(rng.next() as u32)),
        // Sign and fraction as they come, magnitude from 2^-8 to 2^24.
        _ => {
            let exponent = 1023 - 8 + (bits >> 8) % 32;
            f64::from_bits((rng.next() & !(0x7ff << 52)) | exponent << 52)
        }
    }
}

/// A window that is often near the origin and sometimes at the border of what i32 can say.
fn window(rng: &mut Rng) -> PixelRect {
    let at = |bits: u64| match bits & 15 {
        0 => i32::MAX - 12,
        1 => i32::MIN,
        2 => (bits >> 40) as i32 - (1 << 23),
        _ => (bits >> 60) as i32 - 8,
    };
    let (x0, y0) = (at(rng.next()), at(rng.next()));
    PixelRect { x0, y0, x1: x0 + 12, y1: y0 + 12 }
}

/// One triangle of arbitrary bits through every rasterizer: the pixels that it covers, or nothing where it is refused.
/// `Coverage::hit` refuses a pixel outside the window, so an engine that leaves it fails here.
fn triangle(rng: &mut Rng) -> Option<u64> {
    let numbers: [[f64; 6]; 3] = [(); 3].map(|()| [(); 6].map(|()| number(rng)));
    let window = window(rng);
    let corners_px = numbers.map(|n| [n[0], n[1]]);
    let agree = |hits: [Coverage; 3]| {
        assert!(hits[0] == hits[2] && hits[1] == hits[2], "{corners_px:?} in {window:?}");
        let [.., oracle] = hits;
        oracle
    };

    // Without snapping.
    match FreeCorners::new(corners_px) {
        Ok(corners) => {
            let engines = [ExactEngine::Scanline, ExactEngine::EdgeFunction, ExactEngine::Oracle];
            agree(engines.map(|engine| {
                let mut hits = Coverage::new(window, 0);
                engine.cover_exact(&corners, window, |s| hits.hit(s.y_px, s.x0_px, s.x1_px));
                hits
            }));
        }
        Err(refusal) => assert!(!refusal.to_string().is_empty()),
    }

    // On the lattice, with values where those are in the domain too.
    let vertex = |n: &[f64; 6]| {
        let value = |v: f64| if check_value(v).is_ok() { v } else { 0.5 };
        let w = if n[3].is_finite() && n[3].abs() > 1e-60 && n[3].abs() < 1e60 {
            n[3].abs()
        } else {
            1.0
        };
        let varying = DVec2::new(value(n[4]), value(n[5]));
        ScreenVertex::new(n[0], n[1], value(n[2]), w, varying)
    };
    let vertices = match (vertex(&numbers[0]), vertex(&numbers[1]), vertex(&numbers[2])) {
        (Ok(a), Ok(b), Ok(c)) => [a, b, c],
        (a, b, c) => {
            let refusal = [a, b, c].into_iter().find_map(Result::err)?;
            assert!(!refusal.to_string().is_empty());
            return None;
        }
    };
    let triangle = ScreenTriangle { vertices };
    let engines = [Engine::Scanline, Engine::EdgeFunction, Engine::Oracle];
    let covered = agree(engines.map(|engine| hits(&engine, &[triangle.corners()], window)));
    for engine in [Engine::Scanline, Engine::EdgeFunction] {
        let mut values = Coverage::new(window, 0);
        engine.fragments(&triangle, window, |f| {
            let is_finite = f.depth.is_finite() && f.varying.is_finite();
            assert!(is_finite, "{triangle:?} in {window:?}: {f:?}");
            values.hit(f.y_px, f.x_px, f.x_px + 1);
        });
        assert!(values == covered, "{} on {triangle:?}", engine.name());
    }
    Some(covered.covered())
}

/// Any two pixels of i32, through every line drawer.
fn line(rng: &mut Rng) -> u64 {
    let mut end = || {
        let far = rng.next();
        let coordinate = |bits: u64| (bits as i32) >> ((bits >> 59) as u32);
        let pixel = PixelPoint::new(coordinate(far), coordinate(rng.next()));
        LineEnd { pixel, depth: 0.25, varying: 1.0 }
    };
    let line = ScreenLine { ends: [end(), end()] };
    let window = window(rng);
    let pixels = [LineEngine::Dda, LineEngine::Bresenham, LineEngine::Oracle].map(|engine| {
        let mut pixels = Vec::new();
        engine.draw(&line, window, |f| pixels.push((f.x_px, f.y_px)));
        assert!(pixels.iter().all(|&(x, y)| window.contains(x, y)), "{line:?}");
        pixels
    });
    assert!(pixels[0] == pixels[2] && pixels[1] == pixels[2], "{line:?} in {window:?}");
    pixels[2].len() as u64
}

/// Neither everything is refused nor nothing, and pixels are drawn: the test looks at something.
fn check_many(triangles: u64) {
    const BLOCK: u64 = 1000;
    let block = |block| {
        let mut rng = Rng::new("bits", 0, block);
        let drawn: Vec<u64> = (0..BLOCK).filter_map(|_| triangle(&mut rng)).collect();
        [BLOCK - drawn.len() as u64, drawn.iter().sum()]
    };
    let add = |a: [u64; 2], b: [u64; 2]| [a[0] + b[0], a[1] + b[1]];
    let [refused, pixels] =
        (0..triangles / BLOCK).into_par_iter().map(block).reduce(|| [0; 2], add);
    println!("{triangles} triangles, {refused} refused, {pixels} pixels");
    assert!(refused > triangles / 4 && refused < triangles * 99 / 100, "{refused}");
    assert!(pixels > triangles / 100, "{pixels}");
}

#[test]
fn arbitrary_bits_as_triangles() {
    check_many(200_000);
}

#[test]
#[ignore = "takes minutes; the run is recorded in docs/stability.md"]
fn ten_million_triangles_of_arbitrary_bits() {
    check_many(10_000_000);
}

#[test]
fn arbitrary_bits_as_lines() {
    let mut rng = Rng::new("bits", 0, 7);
    let pixels: u64 = (0..50_000).map(|_| line(&mut rng)).sum();
    assert!(pixels > 1000, "{pixels}");
}

/// What an engine of the protocol answers to these bytes, in this process.
fn answers(name: &str, requests: &[u8]) -> Vec<String> {
    let (mut output, mut errors) = (Vec::new(), Vec::new());
    let mut streams = Streams {
        input: &mut Cursor::new(requests),
        output: &mut output,
        errors: &mut errors,
        progress: false,
        colour: false,
        columns: cli::outlet::USUAL,
        error_columns: usize::MAX,
        delivery: cli::Delivery::default(),
    };
    let words = ["rasterproof", "engine", name].map(str::to_owned);
    assert_eq!(
        cli::run(words, &mut streams),
        cli::exit::AGREES,
        "{}",
        String::from_utf8_lossy(&errors)
    );
    String::from_utf8(output).expect("answers are text").lines().map(str::to_owned).collect()
}

/// Each line that is not blank has one answer, and the engine goes on.
fn check_answers(name: &str, requests: &[u8]) -> Result<(), TestCaseError> {
    let mut all = requests.to_vec();
    all.extend_from_slice(b"\nHELLO 1\n");
    let answers = answers(name, &all);
    let asked = all
        .split(|&byte| byte == b'\n')
        .filter(|line| std::str::from_utf8(line).map_or(true, |text| !text.trim().is_empty()));
    prop_assert_eq!(answers.len(), asked.count());
    prop_assert!(answers.last().is_some_and(|answer| answer.starts_with("HELLO 1 ")));
    for answer in &answers {
        let letter = answer.split(' ').next().unwrap_or("");
        prop_assert!(["E", "C", "P", "F", "HELLO"].contains(&letter), "{}", answer);
    }
    Ok(())
}

/// Words that requests are made of, good and bad.
fn word() -> impl Strategy<Value = String> {
    prop_oneof![
        3 => Just(["T", "L", "I", "S", "HELLO", "t", "Q", "-"].map(str::to_owned).to_vec()).prop_flat_map(proptest::sample::select),
        6 => (-20..40i32).prop_map(|n| format!("{}", f64::from(n) / 2.0)),
        2 => any::<f64>().prop_map(|n| n.to_string()),
        2 => any::<f32>().prop_map(|n| format!("{n:e}")),
        1 => any::<u64>().prop_map(|n| format!("0x{n:x}p{}", n as i8)),
        1 => "[ -~]{0,12}",
    ]
}

fn engine_name() -> impl Strategy<Value = &'static str> {
    proptest::sample::select(ENTRIES.iter().map(|entry| entry.name).collect::<Vec<_>>())
}

proptest! {
    #[test]
    fn protocol_survives_any_bytes(name in engine_name(), bytes in proptest::collection::vec(any::<u8>(), 0..300)) {
        check_answers(name, &bytes)?;
    }

    #[test]
    fn protocol_survives_any_words(name in engine_name(), lines in proptest::collection::vec(proptest::collection::vec(word(), 0..22), 1..6)) {
        let text: Vec<String> = lines.iter().map(|words| words.join(" ")).collect();
        check_answers(name, text.join("\n").as_bytes())?;
    }

    /// Requests with the right number of words and any numbers: windows stay small, so that the
    /// oracle answers soon.
    #[test]
    fn protocol_survives_any_numbers(
        name in engine_name(),
        verb in proptest::sample::select(vec![("T", 6), ("L", 4), ("I", 18)]),
        side in 1..40u32,
        bits in any::<u64>(),
    ) {
        let mut rng = Rng::new("bits", 0, bits);
        let numbers: Vec<String> = (0..verb.1).map(|_| number(&mut rng).to_string()).collect();
        check_answers(name, format!("{} id {side} {side} {}", verb.0, numbers.join(" ")).as_bytes())?;
    }
}
