//! Options by which nothing is judged: an error, since a verdict on nothing would agree.

use std::error::Error;
use std::fmt;

use super::{Options, Shard};
use crate::cases::{FamilyName, Kind};

/// Why a judge has no verdict: no case was judged by these [`Options`].
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum NothingJudged {
    /// Every family of [`Options::families`] holds shapes that this judge does not ask for.
    OtherShapes {
        /// The names in [`Options::families`].
        asked: Vec<FamilyName>,
        /// The families that this judge takes its cases from.
        fitting: Vec<&'static str>,
    },
    /// [`Options::cases`] is 0.
    NoCases,
    /// The case numbers of [`Options::shard`] are beyond [`Options::cases`], or not [`Options::only`].
    EmptyShard(Shard),
    /// No rasterizer can be judged by [`Options::convention`]: why, and what is expected.
    BadConvention(String),
    /// [`Options::convention`] is declared where shapes other than triangles on the lattice are judged.
    NoConventions,
    /// No case number is below [`Options::time_limit`] or the end of the case numbers.
    NoneReached,
    /// The tessellator accepts none of the polygons.
    NoneAccepted,
}

impl NothingJudged {
    /// Why `options` leave nothing to judge in the families of a kind, if they do.
    pub(super) fn by(options: &Options, kind: Kind) -> Result<(), Self> {
        let families = Kind::ALL.iter().filter(|(of, _)| *of == kind);
        let fitting: Vec<_> = families.flat_map(|(_, all)| *all).map(|f| f.name).collect();
        if let Some(why) = options.convention.nonsense() {
            return Err(Self::BadConvention(why));
        }
        if !fitting.iter().any(|name| options.wants(name)) {
            let asked = options.families.clone();
            return Err(Self::OtherShapes { asked, fitting });
        }
        let Shard { part, parts } = options.shard;
        match options.only {
            Some(index) if index % parts != part => Err(Self::EmptyShard(options.shard)),
            Some(_) => Ok(()),
            None if options.cases == 0 => Err(Self::NoCases),
            None if part >= options.cases => Err(Self::EmptyShard(options.shard)),
            None => Ok(()),
        }
    }
}

impl fmt::Display for NothingJudged {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("no case was judged: ")?;
        match self {
            Self::OtherShapes { asked, fitting } => {
                let asked: Vec<_> = asked.iter().map(|name| name.as_str()).collect();
                write!(
                    f,
                    "Options.families: {} hold other shapes than this judge compares; expected some of {}",
                    asked.join(", "),
                    fitting.join(", ")
                )
            }
            Self::NoCases => f.write_str("Options.cases is 0; expected at least 1"),
            Self::EmptyShard(Shard { part, parts }) => write!(
                f,
                "Options.shard, part {part} of {parts}, holds no case; case i belongs to part i mod {parts}, \
                 so give more cases or fewer parts"
            ),
            Self::BadConvention(why) => write!(f, "Options.convention: {why}"),
            Self::NoConventions => f.write_str(
                "Options.convention is declared, which is one of triangles on the lattice; lines and triangles off \
                 the lattice are judged without one",
            ),
            Self::NoneAccepted => f.write_str(
                "the tessellator accepts none of the polygons; name other families, or accept more",
            ),
            Self::NoneReached => f.write_str(
                "Options.time_limit ended before the first case of Options.shard, or Options.only \
                 is the largest number of all; allow more time, or name another case",
            ),
        }
    }
}

impl Error for NothingJudged {}

/// Numbers that are no part of a whole; see [`Shard::new`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoSuchShard {
    pub(super) part: u64,
    pub(super) parts: u64,
}

impl fmt::Display for NoSuchShard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { part, parts } = self;
        write!(
            f,
            "there is no part {part} of {parts}; parts count from 0, so it must be below their number"
        )
    }
}

impl Error for NoSuchShard {}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use rasterproof_core::line::dda::Dda;
    use rasterproof_core::raster::scanline::Scanline;
    use rasterproof_core::raster::scanline_exact::ScanlineExact;

    use crate::cases::{self, unsnapped};
    use crate::comparison::{
        Convention, Rule, judge_coverage, judge_exact, judge_lines, judge_values, tolerance,
    };

    /// What each judge says of right engines by these options.
    fn outcomes(options: &Options) -> [Result<bool, NothingJudged>; 4] {
        [
            judge_coverage(&Scanline, options).map(|v| v.agrees()),
            judge_values(&Scanline, tolerance::SCANLINE, options).map(|v| v.agrees()),
            judge_lines(&Dda, options).map(|v| v.agrees()),
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
