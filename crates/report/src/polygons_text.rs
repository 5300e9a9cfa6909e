//! What came of judging a tessellator, as text.

use std::fmt::Write as _;

use super::summary;
use rasterproof_judge::declared::Declared;
use rasterproof_verify::partition::{Family, Polygon, Report};

/// The verdict on a tessellator: what is wrong with the smallest polygons, and the verdict in a word.
#[must_use]
pub fn text(
    declared: &Declared,
    report: &Report,
    repeat_all: &str,
    repeat: &dyn Fn(&str, u64) -> String,
    colour: bool,
) -> String {
    let (sum, name) = (report.sum(), &declared.name);
    let agrees = sum.wrong == 0;
    let answer = if agrees { "is right" } else { "is not right" };
    let mut out = format!(
        "{} rasterproof {}, seed {}: {name} {answer}\n\n{name} speaks version {}: {declared}\n",
        summary::mark(agrees, colour),
        env!("CARGO_PKG_VERSION"),
        report.options.seed,
        declared.version,
    );
    if !declared.unknown.is_empty() {
        let _ = writeln!(out, "not understood, left aside: {}", declared.unknown.join(" "));
    }
    if !agrees {
        out.push('\n');
        // As most languages write lists.
        let show = |polygon: &Polygon| format!("{:?}", polygon.contours);
        let of = |family: Family, index| repeat(family.name(), index);
        let _ = report.write(&mut out, &show, &of);
    }
    let _ = writeln!(out, "\nrepeat with: {repeat_all}");
    let [polygons, triangles, left_out, wrong] =
        [sum.polygons, sum.triangles, sum.left_out, sum.wrong].map(summary::thousands);
    let _ = writeln!(
        out,
        "{}: {polygons} polygons, {triangles} triangles, {left_out} polygons not taken; {wrong} are not covered exactly once",
        summary::word(agrees)
    );
    out
}
