//! What a failed assertion says to do next: a command and the page to read, by the file it stands in.
//! In the tests of every crate these macros stand for those of the same names.

use std::fmt;

/// What to do about a table, a picture or a text that is not as it was.
pub const NEXT: &str = "\
old beside new, pixel by pixel, and how to accept what is right: cargo run -- review
the smallest case that is wrong, with its chapter: cargo run -- verify
how to read both: docs/verdict.md; each named case in a sentence: cargo run -- list";

/// Parts of the paths of files, a command that shows more, and the page: the first that fits counts.
#[rustfmt::skip]
const ROWS: &[(&[&str], &str, &str)] = &[
    (&["_exact", "offgrid", "it/exact"], "verify", "docs/offgrid.md"),
    (&["ladder", "cost"], "cost --quick", "docs/cost.md"),
    (&["specimen", "it/book"], "specimens", "docs/specimens.md"),
    (&["convention"], "judge --help", "docs/conventions.md"),
    (&["judge/", "it/judge", "protocol", "league"], "judge --help", "docs/judge.md"),
    (&["invariant", "mutant", "it/matrix", "it/properties"], "mutants", "docs/stability.md"),
    (&["exhaust"], "exhaust triangles --subpixel-bits 2", "docs/exhaustion.md"),
    (&["digest"], "digest", "docs/machines.md"),
    (&["effects"], "plan panels", "docs/effects.md"),
    (&["src/tile", "src/paint", "it/tile"], "render cube --engine tiles", "docs/gpus.md"),
    (&["it/ties", "verify/ties"], "render cube", "docs/ties.md"),
    (&["pipeline/depth"], "render cube", "docs/ch06.md"),
    (&["pipeline/clip"], "render cube", "docs/ch07.md"),
    (&["pipeline/transform", "src/angle"], "render cube", "docs/ch10.md"),
    (&["texture", "shade", "scene/", "models"], "render cube", "docs/ch11.md"),
    (&["pipeline", "scenes"], "render cube", "docs/ch09.md"),
    (&["snapshots", "illustrations", "diagrams"], "review", "docs/report.md"),
    (&["report", "it/page.rs"], "verify --report", "docs/report.md"),
    (&["playground"], "playground", "docs/playground.md"),
    (&["course"], "course", "docs/course.md"),
    (&["quiz"], "quiz 2", "docs/index.md"),
    (&["house", "surface", "languages", "pages", "figures", "proof"], "list", "CONTRIBUTING.md"),
    (&["values", "interpolation", "near", "rational"], "verify", "docs/ch03.md"),
    (&["src/grid", "src/frame"], "verify", "docs/ch01.md"),
    (&["raster", "src/line", "oracle", "hazard"], "verify", "docs/ch02.md"),
    (&[""], "verify", "docs/verdict.md"),
];

/// The path of the source file that holds the assertion.
pub struct Next(pub &'static str);

impl fmt::Display for Next {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let fits = |parts: &[&str]| parts.iter().any(|part| self.0.contains(part));
        let row = ROWS.iter().find(|(parts, ..)| fits(parts));
        let (_, command, page) = row.unwrap_or(&(&[], "verify", "docs/verdict.md"));
        write!(f, "\n  look into it: cargo run -- {command}\n  read on in:   {page}")
    }
}

/// [`std::assert`], which says what to do next.
#[doc(hidden)]
#[macro_export]
macro_rules! assert {
    ($holds:expr $(,)?) => {
        ::std::assert!($holds, "{}{}", ::std::stringify!($holds), $crate::next::Next(::std::file!()))
    };
    ($holds:expr, $($why:tt)+) => {
        ::std::assert!($holds, "{}{}", ::std::format_args!($($why)+), $crate::next::Next(::std::file!()))
    };
}

/// [`std::assert_eq`], which says what to do next.
#[doc(hidden)]
#[macro_export]
macro_rules! assert_eq {
    ($left:expr, $right:expr $(,)?) => {
        ::std::assert_eq!($left, $right, "{}", $crate::next::Next(::std::file!()))
    };
    ($left:expr, $right:expr, $($why:tt)+) => {
        ::std::assert_eq!($left, $right, "{}{}", ::std::format_args!($($why)+), $crate::next::Next(::std::file!()))
    };
}
