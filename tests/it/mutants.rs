//! Planted faults: the harness must report every one of them, or it proves nothing.

use rasterproof_core::contract::{DrawLine, Interpolate, Rasterize};
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::{Corners, Fragment, ScreenTriangle, Span, Varying};
use rasterproof_faults::planted::{LineMutant, TriangleMutant};
use rasterproof_registry::comparison::EnginesToJudge;
use rasterproof_registry::engines::{Engine, LineEngine};
use rasterproof_report::text::{self, WIDTH};
use rasterproof_report::{differential, json};
use rasterproof_verify::cases::triangles::FAMILIES;
use rasterproof_verify::cases::{FamilyName, Shape, lines};
use rasterproof_verify::comparison::shrink::has_plain_values;
use rasterproof_verify::comparison::{Options, Tally, Verdict, caught, judge_values, tolerance};

/// As many cases as `tests/differential.rs` judges, or fewer.
fn options() -> Options {
    Options::default().cases(150)
}

#[test]
fn every_planted_rasterizer_fault_is_reported() {
    for mutant in TriangleMutant::ALL {
        let engines = EnginesToJudge::from(Engine::Mutant(mutant));
        // Most faults show in the first cases.
        let few = engines.judge(&options().cases(10), &|_| ());
        let verdict = if few.agrees() { engines.judge(&options(), &|_| ()) } else { few };
        assert!(!verdict.agrees(), "{} survives", mutant.name());
        let failure = verdict.failures.first().expect("a disagreement comes with a case");
        assert!(!failure.what.is_empty() && failure.what != "agrees", "{failure}");
    }
}

#[test]
fn every_planted_line_fault_is_reported() {
    for mutant in LineMutant::ALL {
        let verdict = EnginesToJudge::from(LineEngine::Mutant(mutant)).judge(&options(), &|_| ());
        assert!(!verdict.agrees(), "{} survives", mutant.name());
        assert!(!verdict.failures.is_empty());
    }
}

/// Hits of what was emitted, by pixel; nothing where an engine panics or leaves the window, which is
/// a finding of its own.
fn hits(window: PixelRect, draw: impl FnOnce(&mut dyn FnMut(i32, i32))) -> Option<Hits> {
    let mut hits = Hits::new();
    caught(|| draw(&mut |x, y| *hits.entry((x, y)).or_default() += 1)).ok()?;
    hits.keys().all(|&(x, y)| window.contains(x, y)).then_some(hits)
}

type Hits = std::collections::BTreeMap<(i32, i32), u64>;

/// Missing, extra and twice, counted pixel by pixel.
fn recount(actual: &Hits, target: &Hits, sums: &mut [u64; 3]) {
    let pixels: std::collections::BTreeSet<_> = actual.keys().chain(target.keys()).collect();
    for pixel in pixels {
        let [a, t] = [actual, target].map(|hits| hits.get(pixel).copied().unwrap_or(0));
        sums[0] += t.saturating_sub(a);
        sums[1] += u64::from(t == 0 && a > 0);
        sums[2] += a.saturating_sub(t.max(1));
    }
}

/// The verdict of every mutant says the same numbers everywhere, and they are those of a recount that
/// shares nothing with the judge: against the oracle, and nothing added to it.
fn same_everywhere(name: &str, verdict: &Verdict, sums: [u64; 3]) {
    let Tally { missing, extra, twice, order } = verdict.comparisons().oracle;
    assert_eq!([missing, extra, twice], sums, "{name}");
    let json = json::verdict(verdict, &[], &|_, _| String::new());
    let mismatches = missing + extra + twice + order;
    assert_eq!(json["mismatches"], mismatches, "{name}");
    let kinds = ["missing", "extra", "twice"];
    assert_eq!(kinds.map(|kind| json["comparisons"]["oracle"][kind].as_u64().unwrap()), sums);
    let families = json["families"].as_array().unwrap().iter();
    let by_family = |kind| {
        let counts = families.clone().map(|f| f["pairs"][0]["tally"][kind].as_u64().unwrap());
        counts.sum::<u64>()
    };
    assert_eq!(kinds.map(by_family), sums, "{name}");
    if mismatches > 0 {
        let sentence = differential::outcome(verdict).sentence;
        assert!(sentence.starts_with(&format!("{mismatches} wrong pixels in ")), "{sentence}");
    }
    // The terminal's table: the fourth column of counts.
    let mut printed = 0;
    for line in text::tables(&differential::tables(verdict), WIDTH, false)
        .lines()
        .map(str::trim)
        .filter(|line| !line.starts_with("all "))
    {
        let cells: Vec<_> = line.split_whitespace().collect();
        let is_row = cells.len() > 5 && cells[4].ends_with('%');
        printed += if is_row { cells[5].parse().unwrap_or(0) } else { 0 };
    }
    let panics = verdict.families.iter().any(|f| f.pairs[0].panics > 0);
    assert!(panics || printed == mismatches, "{name}: {printed} printed, {mismatches} counted");
}

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn counts_equal_a_recount() {
    const CASES: u64 = 8;
    let options = Options::default().cases(CASES);
    for mutant in TriangleMutant::ALL {
        let engines = EnginesToJudge::from(Engine::Mutant(mutant));
        let verdict = engines.judge(&options, &|_| ());
        let mut sums = [0; 3];
        for case in FAMILIES.iter().flat_map(|f| (0..CASES).map(|index| f.case(1, index))) {
            let Shape::Triangles { list, .. } = &case.shape else { unreachable!("triangles") };
            let all = |engine: &Engine| {
                hits(case.window, |hit| {
                    for triangle in list {
                        engine.cover(triangle.corners(), case.window, |s| {
                            (s.x0_px..s.x1_px).for_each(|x| hit(x, s.y_px));
                        });
                    }
                })
            };
            if let (Some(actual), Some(target)) =
                (all(&Engine::Mutant(mutant)), all(&Engine::Oracle))
            {
                recount(&actual, &target, &mut sums);
            }
        }
        same_everywhere(mutant.name(), &verdict, sums);
    }
    for mutant in LineMutant::ALL {
        let verdict = EnginesToJudge::from(LineEngine::Mutant(mutant)).judge(&options, &|_| ());
        let mut sums = [0; 3];
        for case in lines::FAMILIES.iter().flat_map(|f| (0..CASES).map(|index| f.case(1, index))) {
            let Shape::Lines(list) = &case.shape else { unreachable!("lines") };
            for line in list {
                let one = |engine: LineEngine| {
                    hits(case.window, |hit| engine.draw(line, case.window, |f| hit(f.x_px, f.y_px)))
                };
                if let (Some(actual), Some(target)) =
                    (one(LineEngine::Mutant(mutant)), one(LineEngine::Oracle))
                {
                    recount(&actual, &target, &mut sums);
                }
            }
        }
        same_everywhere(mutant.name(), &verdict, sums);
    }
}

/// An engine whose edges all own their samples draws too much, and misses nothing; its fragments are
/// those of its coverage.
#[test]
fn an_inclusive_engine_misses_nothing() {
    let engines = EnginesToJudge::from(Engine::Mutant(TriangleMutant::InclusiveEdges));
    let verdict = engines.judge(&options(), &|_| ());
    let sums = verdict.comparisons();
    assert!(sums.oracle.extra > 0 && sums.oracle.twice > 0, "{sums:?}");
    assert_eq!((sums.oracle.missing, sums.fragments.total()), (0, 0), "{sums:?}");
}

/// Fragments that are not those of the coverage are a finding, and no wrong pixels.
#[test]
fn stray_fragments_are_counted_apart() {
    struct Forgetful;
    impl Rasterize for Forgetful {
        fn cover(&self, corners: Corners, bounds: PixelRect, emit: impl FnMut(Span)) {
            Engine::Scanline.cover(corners, bounds, emit);
        }
    }
    impl Interpolate for Forgetful {
        fn fragments<V: Varying>(
            &self,
            triangle: &ScreenTriangle<V>,
            bounds: PixelRect,
            mut emit: impl FnMut(Fragment<V>),
        ) {
            let mut count = 0;
            Engine::Scanline.fragments(triangle, bounds, |f| {
                count += 1;
                if count > 1 {
                    emit(f);
                }
            });
        }
    }
    let options = Options::default().cases(20).family(FamilyName::Uniform);
    let verdict = judge_values(&Forgetful, tolerance::SCANLINE, &options).unwrap();
    let sums = verdict.comparisons();
    assert!(!verdict.agrees() && sums.oracle.total() == 0, "{sums:?}");
    let drawn = verdict.families[0].cases - verdict.families[0].empty_cases;
    assert_eq!((sums.fragments.missing, sums.fragments.total()), (drawn, drawn));
    let what = &verdict.failures[0].what;
    assert_eq!(what, "its fragments against its own coverage: 1 missing");
}

/// What is wrong with values is wrong with the plain ones, too, so that the corners alone repeat it.
#[test]
fn wrong_values_shrink_to_plain_ones() {
    let affine = EnginesToJudge::from(Engine::Mutant(TriangleMutant::AffineAttributes));
    let clipped = EnginesToJudge::from(LineEngine::Mutant(LineMutant::WeightsFromClip));
    for verdict in [affine, clipped].map(|engines| engines.judge(&options(), &|_| ())) {
        assert!(verdict.failures.len() > 3, "{}", verdict.failures.len());
        for failure in &verdict.failures {
            assert!(has_plain_values(&failure.case), "{failure}");
            assert!(failure.what.contains("an attribute off by"), "{failure}");
        }
    }
}

/// The smallest failure of every family that fails, smallest first, and the first of all on halves: a wrong tie rule shrinks to a
/// triangle of at most a pixel.
#[test]
fn each_family_has_its_smallest_failure() {
    let engines = EnginesToJudge::from(Engine::Mutant(TriangleMutant::InclusiveEdges));
    let verdict = engines.judge(&options(), &|_| ());
    let wrong: Vec<_> = verdict.families.iter().filter(|f| !f.pairs[0].agrees()).collect();
    let mut shown: Vec<_> = verdict.failures.iter().map(|f| f.family).collect();
    shown.sort_unstable();
    shown.dedup();
    assert_eq!((shown.len(), verdict.failures.len()), (wrong.len(), wrong.len()));
    let (mut odd, mut widths) = (Vec::new(), Vec::new());
    for failure in &verdict.failures {
        let Shape::Triangles { list, .. } = &failure.case.shape else { panic!("{failure}") };
        assert_eq!(list.len(), 1, "{failure}");
        let corners = list[0].corners();
        let all = corners.into_iter().flat_map(|p| [p.x, p.y]);
        odd.push(all.filter(|v| v % 128 != 0).count());
        let xs = corners.map(|corner| corner.x);
        widths.push(xs.iter().max().unwrap() - xs.iter().min().unwrap());
    }
    assert!(odd[0] == 0 && widths[0] <= 256, "{}", verdict.failures[0]);
    assert!(odd.is_sorted(), "{odd:?}");
    assert_eq!(verdict.failures[0].what, "1 extra");
}
