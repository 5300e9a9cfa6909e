//! What came of comparing two programs, as text.

use std::fmt::Write as _;

use super::judge_text::{causes, complaints, failures, hanging, incidents};
use super::summary;
use super::table::{Column, Table};
use rasterproof_judge::against::names;
use rasterproof_judge::declared::Declared;
use rasterproof_judge::run::{Row, Sides};
use rasterproof_judge::verdict::Verdict;

/// The verdict on two programs: whether they differ, which of both is right where they do, the families, the smallest
/// cases, and the verdict in a word.
#[must_use]
pub fn text(
    verdict: &Verdict,
    second: &Declared,
    repeat_all: &str,
    repeat: &dyn Fn(&str, u64) -> String,
    colour: bool,
) -> String {
    let agrees = verdict.agrees();
    let names = names([&verdict.declared, second]);
    let mut out = format!(
        "{} rasterproof {}, seed {}: {}\n\n",
        summary::mark(agrees, colour),
        env!("CARGO_PKG_VERSION"),
        verdict.seed,
        headline(verdict, &names)
    );
    who_is_right(&mut out, &verdict.sides(), &names);
    for (name, declared) in names.iter().zip([&verdict.declared, second]) {
        let said = format!("{name} speaks version {}: {declared}", declared.version);
        let _ = writeln!(out, "{}", hanging(&said, "", "  "));
        if !declared.unknown.is_empty() {
            let _ = writeln!(out, "  not understood, left aside: {}", declared.unknown.join(" "));
        }
    }
    out += "asked is what both can answer; each is judged by what it declares\n\n";
    causes(&mut out, verdict);
    table(&mut out, verdict);
    incidents(&mut out, verdict, repeat);
    failures(&mut out, verdict, &[&names[0], &names[1]], repeat);
    complaints(&mut out, verdict);
    let _ = writeln!(out, "\nrepeat with: {repeat_all}");
    let word = if agrees { "SAME" } else { "DIFFERENT" };
    let _ = writeln!(out, "{word}: {}", headline(verdict, &names));
    out
}

/// Whether both answer the same.
#[must_use]
pub fn headline(verdict: &Verdict, [first, second]: &[String; 2]) -> String {
    let rows = &verdict.found.rows;
    let sum = |of: fn(&Row) -> u64| rows.iter().map(of).sum::<u64>();
    let cases = summary::thousands(sum(|row| row.cases));
    let until = if verdict.found.out_of_time { " until the time was up" } else { "" };
    match sum(|row| row.wrong_cases) {
        0 => format!("{first} and {second} answer the same in {cases} cases{until}"),
        n => format!(
            "{first} and {second} differ in {} of {cases} cases{until}",
            summary::thousands(n)
        ),
    }
}

fn who_is_right(out: &mut String, sides: &Sides, [first, second]: &[String; 2]) {
    let lines = [
        (sides.first, format!("{first} is right and {second} is not")),
        (sides.second, format!("{second} is right and {first} is not")),
        (sides.neither, "neither is right".to_owned()),
        (sides.both, "both are right as they declare".to_owned()),
        (sides.same_but_wrong, "they answer the same, and it is wrong".to_owned()),
    ];
    for (n, what) in lines.iter().filter(|(n, _)| *n > 0) {
        let _ = writeln!(out, "{:>9} cases: {what}", summary::thousands(*n));
    }
    if lines.iter().any(|(n, _)| *n > 0) {
        out.push('\n');
    }
}

fn table(out: &mut String, verdict: &Verdict) {
    let numbers = ["cases", "differ", "1st right", "2nd right", "neither", "both"];
    let columns = [Column::words("property").least(16)].into_iter();
    let columns = columns.chain(numbers.map(|label| Column::numbers(label, "").least(7))).collect();
    let row = |row: &Row| {
        let sides = row.sides.unwrap_or_default();
        let numbers =
            [row.cases, row.wrong_cases, sides.first, sides.second, sides.neither, sides.both];
        let mut cells = vec![row.name.to_owned()];
        cells.extend(numbers.map(|n| n.to_string()));
        cells.into()
    };
    let mut rows: Vec<_> = verdict.found.rows.iter().collect();
    rows.sort_by(|a, b| b.share().total_cmp(&a.share()));
    let rows = rows.into_iter().map(row).collect();
    *out += &Table { columns, rows, ..Table::default() }.text([0; 2]);
}
