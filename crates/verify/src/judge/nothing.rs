//! Options by which nothing is judged: an error, since a verdict on nothing would agree.

use std::error::Error;
use std::fmt;

use super::Shard;
use crate::cases::FamilyName;

/// Why a judge has no verdict: no case was judged by these [`Options`](super::Options).
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum NothingJudged {
    /// Every family of [`Options::families`](super::Options::families) holds shapes that this judge does not ask for.
    OtherShapes {
        /// The names in [`Options::families`](super::Options::families).
        asked: Vec<FamilyName>,
        /// The families that this judge takes its cases from.
        fitting: Vec<&'static str>,
    },
    /// [`Options::cases`](super::Options::cases) is 0.
    NoCases,
    /// The case numbers of [`Options::shard`](super::Options::shard) are beyond [`Options::cases`](super::Options::cases), or not [`Options::only`](super::Options::only).
    EmptyShard(Shard),
    /// No rasterizer can be judged by `Options::convention`: why, and what is expected.
    BadConvention(String),
    /// `Options::convention` is declared where shapes other than triangles on the lattice are judged.
    NoConventions,
    /// No case number is below [`Options::time_limit`](super::Options::time_limit) or the end of the case numbers.
    NoneReached,
    /// The tessellator accepts none of the polygons.
    NoneAccepted,
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
