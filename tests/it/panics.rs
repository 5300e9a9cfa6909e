//! An engine that panics in every case is a verdict of a few lines: its first panic is shown, others are
//! counted, and panics that are none of its own are shown as ever.
//!
//! The panic hook belongs to the process, so each of these is a process of its own: this test binary, in which
//! one ignored test runs.

use std::panic::catch_unwind;
use std::process::Command;
use std::sync::atomic::{AtomicU64, Ordering};

use rasterproof_core::contract::{DrawLine, Rasterize};
use rasterproof_core::grid::PixelRect;
use rasterproof_core::raster::scanline::Scanline;
use rasterproof_core::triangle::{Corners, Fragment, ScreenLine, Span, Varying};
use rasterproof_verify::comparison::{
    Options, judge_coverage, judge_coverage_of, judge_line_values,
};

use crate::program::Run;

struct Panicking;

impl Rasterize for Panicking {
    fn cover(&self, corners: Corners, _: PixelRect, _: impl FnMut(Span)) {
        panic!("the engine gives up at {corners:?}");
    }
}

impl DrawLine for Panicking {
    fn draw<V: Varying>(&self, _: &ScreenLine<V>, _: PixelRect, _: impl FnMut(Fragment<V>)) {
        panic!("the line drawer gives up");
    }
}

/// Set where a test below is started as a program of its own. Among others it would count their panics.
const STARTED: &str = "RASTERPROOF_PANICS_ARE_COUNTED";

fn is_started() -> bool {
    std::env::var_os(STARTED).is_some()
}

/// Standard error of one of the ignored tests below, run alone.
fn errors_of(test: &str, backtrace: &str) -> String {
    let mut command = Command::new(std::env::current_exe().unwrap());
    let test = format!("panics::{test}");
    command.args(["--exact", &test, "--ignored", "--nocapture"]).env("RUST_BACKTRACE", backtrace);
    command.env(STARTED, "1");
    let run = Run::of(&mut command);
    assert_eq!(run.status, Some(0), "{run}");
    assert!(run.out.contains("1 passed"), "{run}");
    run.errors
}

/// Every family, 500 cases of each.
#[test]
fn a_panicking_engine_does_not_flood_the_terminal() {
    // A backtrace has the frames of the pool of threads, with their types.
    for (backtrace, most_bytes) in [("0", 2_000), ("1", 200_000)] {
        let errors = errors_of("always_panics", backtrace);
        assert_eq!(errors.matches("the engine gives up").count(), 1, "{errors}");
        assert_eq!(errors.matches("the line drawer gives up").count(), 1, "{errors}");
        assert_eq!(errors.matches("stack backtrace:").count(), 2 * usize::from(backtrace == "1"));
        assert!(errors.len() < most_bytes, "{} bytes", errors.len());
    }
}

#[test]
#[ignore = "is a program that another test starts"]
fn always_panics() {
    if !is_started() {
        return;
    }
    let options = Options::default().cases(500);
    let verdict = judge_coverage(&Panicking, &options).unwrap();
    let cases: u64 = verdict.families.iter().map(|family| family.cases).sum();
    let message = verdict.check().unwrap_err().to_string();
    let said = format!("it panics in {cases} cases; only the first of these panics was shown");
    assert!(cases > 5_000 && message.contains(&said), "{message}");
    assert!(judge_line_values(&Panicking, &options).unwrap().check().is_err());
}

/// Other threads panic while engines are judged, and everybody panics before and after.
#[test]
fn panics_of_others_are_shown() {
    let errors = errors_of("panics_beside", "0");
    assert_eq!(errors.matches("the engine gives up").count(), 4, "{errors}");
    assert_eq!(errors.matches("somebody else").count(), 40, "{errors}");
    assert_eq!(errors.matches("in the hook").count(), 44, "{errors}");
}

#[test]
#[ignore = "is a program that another test starts"]
fn panics_beside() {
    if !is_started() {
        return;
    }
    static SEEN: AtomicU64 = AtomicU64::new(0);
    let default = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |info| {
        SEEN.fetch_add(1, Ordering::Relaxed);
        eprintln!("in the hook");
        default(info);
    }));
    let panics = || assert!(catch_unwind(|| panic!("somebody else")).is_err());
    let options = Options::default().cases(30);
    let judges = || assert!(judge_coverage(&Panicking, &options).unwrap().check().is_err());
    std::thread::scope(|scope| {
        // Two judgements overlap; each shows one panic.
        scope.spawn(judges);
        scope.spawn(judges);
        scope.spawn(|| (0..20).for_each(|_| panics()));
        scope.spawn(|| {
            for _ in 0..19 {
                judge_coverage(&Scanline, &Options::default().cases(1)).unwrap().check().unwrap();
                panics();
            }
        });
    });
    // One case alone, often: the hook of the user is what it was, however often ours was there.
    let case = rasterproof_verify::cases::families().next().unwrap().case(1, 0);
    (0..1000).for_each(|_| assert!(!judge_coverage_of(&Scanline, &case).is_wrong()));
    assert!(judge_coverage_of(&Panicking, &case).is_wrong());
    panics();
    let corners = [rasterproof_core::grid::SubpixelPoint::new(0, 0); 3];
    assert!(catch_unwind(|| Panicking.cover(corners, PixelRect::window(1, 1), |_| ())).is_err());
    assert_eq!(SEEN.load(Ordering::Relaxed), 44);
}
