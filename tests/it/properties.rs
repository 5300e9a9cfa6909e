//! Every invariant as a property: small whole numbers are mapped to geometry, so that a failure
//! shrinks to a triangle that can be read.
//!
//! Under `CI` the seed is fixed; elsewhere each run looks at other inputs. `PROPTEST_CASES` decides
//! how many.

use glam::DVec2;
use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestError, TestRng, TestRunner};
use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_core::triangle::{LineEnd, PixelPoint, ScreenLine, ScreenTriangle, ScreenVertex};
use rasterproof_invariants::implementations::Implementations;
use rasterproof_invariants::source::{
    ClipInput, Fan, Input, LineInput, Position, Quad, TriangleInput,
};
use rasterproof_invariants::{CATALOGUE, Invariant, Predicate};
use rasterproof_verify::cases::Triangle;

/// Side of the window of triangles, in pixels.
const SIDE_PX: u32 = 16;

/// A coordinate: a pixel, and in it mostly the centre or the border, else any subpixel.
fn coordinate() -> impl Strategy<Value = i32> {
    let part = prop_oneof![3 => Just(128), 1 => Just(0), 2 => 0..256];
    (-4..20i32, part).prop_map(|(px, part)| px * 256 + part)
}

fn point() -> impl Strategy<Value = SubpixelPoint> {
    (coordinate(), coordinate()).prop_map(|(x, y)| SubpixelPoint::new(x, y))
}

/// Depths and values in eighths, w from 1 to 64: numbers with few digits.
fn vertex() -> impl Strategy<Value = ScreenVertex<DVec2>> {
    (point(), 0..=8i32, 1..=64i32, -40..=40i32, -40..=40i32).prop_map(
        |(position, depth, w, a, b)| {
            let eighth = |n: i32| f64::from(n) / 8.0;
            ScreenVertex {
                position,
                depth: eighth(depth),
                inv_w: 1.0 / f64::from(w),
                varying: DVec2::new(eighth(a), eighth(b)),
            }
        },
    )
}

fn triangle() -> impl Strategy<Value = Triangle> {
    (vertex(), vertex(), vertex()).prop_map(|(a, b, c)| ScreenTriangle { vertices: [a, b, c] })
}

fn line() -> impl Strategy<Value = Input> {
    let pixel = || (-12..40i32, -12..40i32).prop_map(|(x, y)| PixelPoint::new(x, y));
    (pixel(), pixel()).prop_map(|(a, b)| {
        let end = |pixel, value: f64| LineEnd { pixel, depth: value, varying: DVec2::splat(value) };
        let line = ScreenLine { ends: [end(a, 0.0), end(b, 1.0)] };
        Input::Line(LineInput { line, window: PixelRect::window(24, 24) })
    })
}

/// The inputs of a check, or nothing where it takes no generated input.
fn inputs(check: &Predicate) -> Option<BoxedStrategy<Input>> {
    let window = PixelRect::window(SIDE_PX, SIDE_PX);
    Some(match check {
        Predicate::Triangle(_) => (triangle(), any::<u32>())
            .prop_map(move |(triangle, salt)| {
                Input::Triangle(TriangleInput { triangle, window, salt })
            })
            .boxed(),
        Predicate::Quad(_) => {
            let size = || prop_oneof![(0..11u16).prop_map(|px| px * 256 + 128), 0..2800u16];
            let part = || prop_oneof![Just(0), Just(255), any::<u8>()];
            ([size(), size(), size(), size()], [part(), part(), part(), part()])
                .prop_map(|(sides, along)| Input::Quad(Quad::inscribed(sides, along)))
                .boxed()
        }
        Predicate::Fan(_) => {
            let reach = prop_oneof![(1..6u16).prop_map(|half| half * 128), 1..800u16];
            (point(), proptest::array::uniform16(reach), 1..3usize, point())
                .prop_map(|(centre, reach, every, apex)| {
                    Input::Fan(Fan::new(centre, reach, every, apex))
                })
                .boxed()
        }
        Predicate::Line(_) => line().boxed(),
        Predicate::Position(_) => {
            let part = prop_oneof![Just(2048), 0..4096u16];
            (-100_000..100_000i32, part, -800..800i32)
                .prop_map(|(sub, part, shift)| Input::Position(Position::new(sub, part, shift)))
                .boxed()
        }
        Predicate::Clip(_) => {
            let vertex = || {
                (proptest::array::uniform3(-12..=12i32), -6..=12i32).prop_map(|([x, y, z], w)| {
                    // On a plane as often as not.
                    let on = |v: i32| match v.rem_euclid(4) {
                        0 => w,
                        1 => -w,
                        _ => v,
                    };
                    [on(x), on(y), on(z), w]
                })
            };
            [vertex(), vertex(), vertex()]
                .prop_map(|vertices| Input::Clip(ClipInput { vertices }))
                .boxed()
        }
        Predicate::Run(..) | Predicate::Matrix => return None,
    })
}

/// Failures become named cases, not files beside the tests.
fn config() -> Config {
    Config { failure_persistence: None, ..Config::default() }
}

fn with_seed() -> TestRunner {
    TestRunner::new_with_rng(config(), TestRng::from_seed(RngAlgorithm::ChaCha, &[7; 32]))
}

fn runner() -> TestRunner {
    if std::env::var_os("CI").is_some() { with_seed() } else { TestRunner::new(config()) }
}

fn check(invariant: &Invariant) {
    let subject = Implementations::real();
    let Some(strategy) = inputs(&invariant.check) else {
        // The harness itself: few cases, as generated.
        let report = invariant.run(&subject, 1, 1);
        assert!(report.failure.is_none(), "{}: {:?}", invariant.name, report.failure);
        return;
    };
    let result = runner().run(&strategy, |input| {
        let outcome = invariant.judge(&subject, &input);
        outcome.map(|_| ()).map_err(TestCaseError::fail)
    });
    let said = match result {
        Ok(()) => String::new(),
        Err(TestError::Fail(why, input)) => format!("{why}\nsmallest found: {input}"),
        Err(TestError::Abort(why)) => format!("gave up: {why}"),
    };
    assert!(said.is_empty(), "{}: {said}", invariant.name);
}

/// A test for each invariant that applies, under its name.
macro_rules! properties {
    ($($test:ident)*) => {
        $(#[test]
        fn $test() {
            let name = stringify!($test).replace('_', "-");
            check(rasterproof_invariants::find(&name).expect("a name of the catalogue"));
        })*

        #[test]
        fn every_invariant_has_a_test() {
            let tests = [$(stringify!($test)),*].map(|test| test.replace('_', "-"));
            // 42 is the matrix, which has a test and a snapshot of its own.
            let wanted = CATALOGUE.iter().filter(|i| i.number != 42);
            assert_eq!(wanted.map(|i| i.name).collect::<Vec<_>>(), tests);
        }
    };
}

properties! {
    engines_agree oracle_sign vertex_order translation conjugate_rules quad_split closed_fan
    signed_hit_count contiguous_rows inside_the_box nesting zero_area windings crop
    identifies_the_rule edge_lemma edge_bound snapping area supersampling
    edges_sum weights_sum perspective_values hull constant_attribute equal_w scaled_w
    rotated_vertices shared_edge flat_depth finite
    clip_inside clip_reversed clip_coverage clip_plane
    nearest_pixel one_per_step reversal octants clipped_line listed_differences
    quotas replay metrics_report_only disabled_effect lists over layers footprint plane_in_light
}

/// The same strategies find a planted fault, and the failure shrinks to small numbers. The seed is fixed, because from a few others
/// proptest stops before two corners are simple.
#[test]
fn a_planted_fault_shrinks() {
    let mutant = rasterproof_faults::planted::Mutant::find("exclusive-edges").expect("a mutant");
    let subject = Implementations::with(mutant);
    let invariant = rasterproof_invariants::find("engines-agree").expect("an invariant");
    let strategy = inputs(&invariant.check).expect("triangles");
    let result = with_seed().run(&strategy, |input| {
        invariant.judge(&subject, &input).map(|_| ()).map_err(TestCaseError::fail)
    });
    let Err(TestError::Fail(_, Input::Triangle(input))) = result else {
        panic!("the fault was not found: {result:?}");
    };
    let digits = |v: i32| v % 128 == 0;
    assert!(input.triangle.corners().iter().filter(|p| digits(p.x) && digits(p.y)).count() >= 2);
}
