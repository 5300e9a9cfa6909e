//! Options by which nothing is judged: an error, since a verdict on nothing would agree.

use std::error::Error;
use std::fmt;

use super::Options;
use crate::cases::{self, Family, unsnapped};

/// Why a judge has no verdict: no case was judged by these [`Options`].
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum NothingJudged {
    /// There is no engine to judge.
    NoEngine,
    /// [`Options::families`] holds a name that no family has.
    UnknownFamily(String),
    /// Every family of [`Options::families`] holds shapes that this judge does not ask for.
    OtherShapes {
        /// The names in [`Options::families`].
        asked: Vec<String>,
        /// The families that this judge takes its cases from.
        fitting: Vec<&'static str>,
    },
    /// [`Options::cases`] is 0.
    NoCases,
    /// [`Options::shard`] is no part of a whole: the part must be below the number of parts.
    BadShard(u64, u64),
    /// The case numbers of [`Options::shard`] are beyond [`Options::cases`], or not [`Options::only`].
    EmptyShard(u64, u64),
    /// No case number is below [`Options::time_limit`] or the end of the case numbers.
    NoneReached,
}

impl NothingJudged {
    /// Why `options` leave nothing to judge where cases come from the families `fitting`, if they do.
    pub(super) fn by(options: &Options, fitting: &[&'static str]) -> Result<(), Self> {
        let (part, parts) = options.shard;
        let is_known = |name: &String| all_names().any(|known| known == name);
        if let Some(name) = options.families.iter().find(|name| !is_known(name)) {
            return Err(Self::UnknownFamily(name.clone()));
        }
        if !fitting.iter().any(|name| options.wants(name)) {
            let asked = options.families.clone();
            return Err(Self::OtherShapes { asked, fitting: fitting.to_vec() });
        }
        if part >= parts {
            return Err(Self::BadShard(part, parts));
        }
        match options.only {
            Some(index) if index % parts != part => Err(Self::EmptyShard(part, parts)),
            Some(_) => Ok(()),
            None if options.cases == 0 => Err(Self::NoCases),
            None if part >= options.cases => Err(Self::EmptyShard(part, parts)),
            None => Ok(()),
        }
    }
}

/// Names of families, in the order of the catalogue.
pub(super) fn names(families: &'static [Family]) -> Vec<&'static str> {
    families.iter().map(|family| family.name).collect()
}

fn all_names() -> impl Iterator<Item = &'static str> {
    cases::families().map(|f| f.name).chain(unsnapped::FAMILIES.iter().map(|f| f.name))
}

impl fmt::Display for NothingJudged {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("no case was judged: ")?;
        match self {
            Self::NoEngine => f.write_str("the list of engines is empty; name at least one"),
            Self::UnknownFamily(name) => {
                let known = all_names().collect::<Vec<_>>().join(", ");
                write!(
                    f,
                    "Options.families: no family is called {name:?}; expected some of {known}"
                )
            }
            Self::OtherShapes { asked, fitting } => write!(
                f,
                "Options.families: {} hold other shapes than this judge compares; expected some of {}",
                asked.join(", "),
                fitting.join(", ")
            ),
            Self::NoCases => f.write_str("Options.cases is 0; expected at least 1"),
            Self::BadShard(part, parts) => write!(
                f,
                "Options.shard is ({part}, {parts}); expected (part, parts) with part below parts, \
                 such as (0, 4)"
            ),
            Self::EmptyShard(part, parts) => write!(
                f,
                "Options.shard ({part}, {parts}) holds no case; case i belongs to part i mod {parts}, \
                 so give more cases or fewer parts"
            ),
            Self::NoneReached => f.write_str(
                "Options.time_limit ended before the first case of Options.shard, or Options.only \
                 is the largest number of all; allow more time, or name another case",
            ),
        }
    }
}

impl Error for NothingJudged {}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use rasterproof_core::line::dda::Dda;
    use rasterproof_core::raster::scanline::Scanline;
    use rasterproof_core::raster::scanline_exact::ScanlineExact;

    use crate::comparison::unsnapped::judge_exact;
    use crate::comparison::{judge_coverage, judge_lines, judge_values, tolerance};

    /// What each judge says of right engines by these options.
    fn outcomes(options: &Options) -> [Result<bool, NothingJudged>; 4] {
        let exact = [("candidate", ScanlineExact)];
        [
            judge_coverage(&Scanline, options).map(|v| v.agrees()),
            judge_values(&Scanline, tolerance::SCANLINE, options).map(|v| v.agrees()),
            judge_lines(&Dda, options).map(|v| v.agrees()),
            judge_exact(&exact, options, &|_| ()).map(|v| v.agrees()),
        ]
    }

    fn few() -> Options {
        Options { cases: 2, ..Options::default() }
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
        let options = Options { families: vec!["unifrom".to_owned()], ..few() };
        let expected = NothingJudged::UnknownFamily("unifrom".to_owned());
        all_say(&options, &expected, &["\"unifrom\"", "uniform", "Options.families"]);
        // A right name beside it does not make a misspelt one right.
        let families = ["uniform", "unifrom"].map(str::to_owned).to_vec();
        all_say(&Options { families, ..few() }, &expected, &[]);
        for shard in [(0, 0), (3, 2), (2, 2), (u64::MAX, 0)] {
            let expected = NothingJudged::BadShard(shard.0, shard.1);
            all_say(&Options { shard, ..few() }, &expected, &["Options.shard", "part below parts"]);
        }
        let expected = NothingJudged::EmptyShard(2, 3);
        all_say(&Options { shard: (2, 3), ..few() }, &expected, &["Options.shard (2, 3)"]);
        all_say(&Options { shard: (2, 3), only: Some(3), ..few() }, &expected, &[]);
        let options = Options { only: Some(u64::MAX), ..few() };
        all_say(&options, &NothingJudged::NoneReached, &["Options.only"]);
        // The first round of cases is judged whatever the limit; this part begins after it.
        let time_limit = Some(Duration::ZERO);
        let options = Options { cases: 2_000, shard: (1_999, 2_000), time_limit, ..few() };
        all_say(&options, &NothingJudged::NoneReached, &["Options.time_limit"]);
    }

    #[test]
    fn a_family_of_other_shapes_is_no_verdict() {
        let family = |name: &str| Options { families: vec![name.to_owned()], ..few() };
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
    fn no_engine_is_no_verdict() {
        let none: [(&str, ScanlineExact); 0] = [];
        let outcome = judge_exact(&none, &few(), &|_| ()).map(|v| v.agrees());
        assert_eq!(outcome, Err(NothingJudged::NoEngine));
    }

    #[test]
    fn what_is_judged_has_a_verdict() {
        assert_eq!(outcomes(&few()), [const { Ok(true) }; 4]);
        for options in [
            Options { shard: (1, 2), ..few() },
            Options { only: Some(7), cases: 0, ..few() },
            Options { time_limit: Some(Duration::ZERO), ..few() },
        ] {
            assert_eq!(outcomes(&options), [const { Ok(true) }; 4], "{options:?}");
        }
    }
}
