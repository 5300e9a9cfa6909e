//! Which options leave no case to the comparison.

use super::{NothingJudged, Options};
use crate::cases::Kind;

/// Why `options` leave nothing to judge in the families of a kind, if they do.
pub(super) fn check(options: &Options, kind: Kind) -> Result<(), NothingJudged> {
    let families = Kind::ALL.iter().filter(|(of, _)| *of == kind);
    let fitting: Vec<_> = families.flat_map(|(_, all)| *all).map(|f| f.name).collect();
    if let Some(why) = options.terms.nonsense() {
        return Err(NothingJudged::BadConvention(why));
    }
    if !fitting.iter().any(|name| options.wants(name)) {
        let asked = options.families.clone();
        return Err(NothingJudged::OtherShapes { asked, fitting });
    }
    options.check()
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use rasterproof_core::line::dda::Dda;
    use rasterproof_core::raster::scanline::Scanline;
    use rasterproof_core::raster::scanline_exact::ScanlineExact;

    use crate::cases::{self, unsnapped};
    use crate::comparison::{
        Convention, Rule, Shard, judge_coverage, judge_exact, judge_line_values, judge_values,
        tolerance,
    };

    /// What each judge says of right engines by these options.
    fn outcomes(options: &Options) -> [Result<bool, NothingJudged>; 4] {
        [
            judge_coverage(&Scanline, options).map(|v| v.agrees()),
            judge_values(&Scanline, tolerance::SCANLINE, options).map(|v| v.agrees()),
            judge_line_values(&Dda, options).map(|v| v.agrees()),
            judge_exact(&ScanlineExact, options).map(|v| v.agrees()),
        ]
    }

    fn few() -> Options {
        Options::default().cases(2)
    }

    fn all_say(options: &Options, expected: &NothingJudged, words: &[&str]) {
        for outcome in outcomes(options) {
            assert_eq!(outcome.as_ref(), Err(expected), "{options:?}");
        }
        let text = expected.to_string();
        for word in words {
            assert!(text.contains(word), "{word} in {text}");
        }
    }

    #[test]
    fn nothing_is_no_verdict() {
        let options = Options { cases: 0, ..few() };
        all_say(&options, &NothingJudged::NoCases, &["Options.cases is 0"]);
        for (part, parts) in [(0, 0), (3, 2), (2, 2), (u64::MAX, 0)] {
            let error = Shard::new(part, parts).unwrap_err();
            assert!(error.to_string().contains(&format!("no part {part} of {parts}")), "{error}");
        }
        let shard = Shard::new(2, 3).unwrap();
        let expected = NothingJudged::EmptyShard(shard);
        all_say(&few().shard(shard), &expected, &["Options.shard, part 2 of 3"]);
        all_say(&few().shard(shard).only(3), &expected, &[]);
        for (convention, words) in [
            (Convention::default().subpixel_bits(9), "expected 0 to 8"),
            (Convention::default().sample(0, 257), "sample is (0, 257)"),
        ] {
            let options = few().convention(convention);
            for outcome in outcomes(&options) {
                let error = outcome.unwrap_err().to_string();
                assert!(error.contains(words), "{error}");
            }
        }
        // Lines, and triangles off the lattice, are judged by one rule.
        let declared = few().convention(Convention::default().rule(Rule::TopRight));
        for outcome in &outcomes(&declared)[2..] {
            assert_eq!(*outcome, Err(NothingJudged::NoConventions));
        }
        let options = Options { only: Some(u64::MAX), ..few() };
        all_say(&options, &NothingJudged::NoneReached, &["Options.only"]);
        // The first round of cases is judged whatever the limit; this part begins after it.
        let time_limit = Some(Duration::ZERO);
        let last = Shard::new(1_999, 2_000).unwrap();
        let options = Options { time_limit, ..few().cases(2_000).shard(last) };
        all_say(&options, &NothingJudged::NoneReached, &["Options.time_limit"]);
    }

    #[test]
    fn a_family_of_other_shapes_is_no_verdict() {
        let family = |name: &str| few().family(name.parse().unwrap());
        let is_other =
            |outcome: &Result<bool, _>| matches!(outcome, Err(NothingJudged::OtherShapes { .. }));
        let lines = cases::lines::FAMILIES[0].name;
        let triangles = cases::triangles::FAMILIES[0].name;
        let free = unsnapped::FAMILIES[0].name;
        for (name, fits) in [
            (triangles, [true, true, false, false]),
            (lines, [false, false, true, false]),
            (free, [false, false, false, true]),
        ] {
            let outcomes = outcomes(&family(name));
            assert_eq!(outcomes.each_ref().map(|o| *o == Ok(true)), fits, "{name}");
            assert_eq!(outcomes.each_ref().map(is_other), fits.map(|fits| !fits), "{name}");
        }
    }

    #[test]
    fn what_is_judged_has_a_verdict() {
        assert_eq!(outcomes(&few()), [const { Ok(true) }; 4]);
        for options in [
            few().shard(Shard::new(1, 2).unwrap()),
            few().cases(0).only(7),
            Options { time_limit: Some(Duration::ZERO), ..few() },
        ] {
            assert_eq!(outcomes(&options), [const { Ok(true) }; 4], "{options:?}");
        }
    }
}
