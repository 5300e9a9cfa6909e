//! The results as text.

use std::fmt::Write as _;

use crate::fills::Errors;
use crate::{Machine, Results, frames as drawn, growth};

/// Everything that a run found; its tables have at most 80 columns.
pub fn text(results: &Results) -> String {
    let mut text = String::new();
    write(&mut text, results).expect("text has room");
    text
}

pub fn machine(machine: &Machine) -> String {
    let Machine { command, processor, cores, system, instructions, day, commit } = machine;
    format!("{command}\n{processor}, {cores} cores, {instructions}; {system}; {day}, {commit}\n")
}

pub fn growth(rows: &[growth::Row]) -> String {
    let mut text = String::new();
    for row in rows {
        let growth::Row { what, at, engine, cores, samples, ms, megabytes } = row;
        let by = format!("{engine}, {samples} samples, {cores} cores");
        let line =
            format!("{what:<24} {at:>8} {by:<28} {:>8.2} ms {megabytes:>6.0} MB\n", ms.median);
        text += &line;
    }
    text
}

fn write(text: &mut String, results: &Results) -> std::fmt::Result {
    *text += &machine(&results.machine);
    for version in &results.versions {
        writeln!(text, "  {version}")?;
    }
    for missing in &results.missing {
        writeln!(text, "  missing: {} ({})", missing.name, missing.why)?;
    }
    if !results.fills.is_empty() {
        fills(text, results)?;
    }
    if !results.frames.is_empty() {
        frames(text, results)?;
    }
    Ok(())
}

fn fills(text: &mut String, results: &Results) -> std::fmt::Result {
    writeln!(
        text,
        "\nFills, 1024 x 1024 px, one core, ns for each triangle: medians of {} rounds in turns,\n\
         +-: half the distance of the quartiles; x ours: times as fast as ours of this quality\n",
        results.fill_rounds
    )?;
    writeln!(text, "class   filled by                   ns  +- %  x ours  wrong")?;
    for (i, row) in results.fills.iter().enumerate() {
        let first = i == 0 || results.fills[i - 1].class != row.class;
        let class = if first { row.class } else { "" };
        let ns = row.ns.median / row.triangles as f64;
        let factor = results.ours(row).ns.median / row.ns.median;
        let wrong = match row.errors {
            Errors::Pixels { missing, extra } => format!("{missing} missing, {extra} extra"),
            Errors::Areas { rms, worst } => format!("rms {rms:.2}, most {worst:.0} of 255"),
        };
        let (name, percent) = (&row.name, row.ns.percent());
        writeln!(text, "{class:<7} {name:<19} {ns:>10.1} {percent:>5.0} {factor:>7.2}  {wrong}")?;
    }
    Ok(())
}

fn frames(text: &mut String, results: &Results) -> std::fmt::Result {
    let side = results.frames[0].side_px;
    writeln!(
        text,
        "\nFrames, {side} x {side} px, textured and lit, ms: medians of {} rounds in turns;\n\
         x tiles: times as fast as the tiles on as many cores\n",
        results.frame_rounds
    )?;
    writeln!(text, "mesh        samples cores drawn by         ms  +- % x tiles uncovered  other")?;
    for (i, row) in results.frames.iter().enumerate() {
        let first = i == 0 || results.frames[i - 1].mesh != row.mesh;
        let mesh = if first { row.mesh.as_str() } else { "" };
        let drawn::Row { samples, cores, name, ms, uncovered, other, .. } = row;
        let factor = results.tiles(row).ms.median / ms.median;
        writeln!(
            text,
            "{mesh:<11} {samples:>7} {cores:>5} {name:<12} {:>8.2} {:>5.0} {factor:>7.2} {uncovered:>9} {other:>6}",
            ms.median,
            ms.percent(),
        )?;
    }
    Ok(())
}
