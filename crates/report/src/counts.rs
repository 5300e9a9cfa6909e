//! The verdict, the survey and the refused inputs as tables of the report page, worst row first.

use super::html::{Column, Mark, Outcome, Row, Table};
use super::table;
use rasterproof_core::contract::Decisions;
use rasterproof_core::grid::SubpixelPoint;
use rasterproof_registry::published_check::SpecimenReport;
use rasterproof_render::scene::named;
use rasterproof_verify::cases::named::Input;
use rasterproof_verify::comparison::unsnapped::{ExactFamilyReport, ExactVerdict};
use rasterproof_verify::comparison::{FamilyReport, Verdict};

/// The verdict in a word and a sentence, with the counts that `verify` prints.
#[must_use]
pub fn outcome(verdict: &Verdict, off_grid: &ExactVerdict) -> Outcome {
    let good = verdict.agrees() && off_grid.agrees();
    let (triangles, lines) = (verdict.sum(false, |f| f.shapes), verdict.sum(true, |f| f.shapes));
    let mut judged = format!("{triangles} triangles and {lines} lines");
    if off_grid.triangles() > 0 {
        judged += &format!(", {} triangles off the grid", off_grid.triangles());
    }
    let wrong = verdict.mismatches() + off_grid.mismatches();
    let sentence = match (good, wrong) {
        (true, _) => format!("Every engine drew what the oracle drew: {judged}, 0 wrong pixels."),
        (false, 0) => {
            let pairs = verdict.families.iter().flat_map(|f| &f.pairs).map(|p| p.wrong_cases);
            let engines = off_grid.families.iter().flat_map(|f| &f.engines).map(|e| e.wrong_cases);
            let cases: u64 = pairs.chain(engines).sum();
            let what = match verdict.comparisons().fragments.total() {
                0 => "panic or leave a value's bound",
                _ => "panic, leave a value's bound or have fragments unlike their coverage",
            };
            format!("No wrong pixels, but {cases} cases {what}: {judged}.")
        }
        (false, _) => format!("{wrong} wrong pixels in {judged}."),
    };
    Outcome::of(good, sentence)
}

/// Wrong pixels by family and pair: triangles, lines, triangles off the lattice.
pub fn of_verdict(verdict: &Verdict, off_grid: &ExactVerdict) -> Vec<Table> {
    let on_grid = [false, true].into_iter().filter_map(|lines| {
        let families: Vec<_> = verdict.families.iter().filter(|f| f.lines == lines).collect();
        (!families.is_empty()).then(|| on_grid(&families, lines))
    });
    on_grid.chain((!off_grid.families.is_empty()).then(|| off_lattice(off_grid))).collect()
}

fn on_grid(families: &[&FamilyReport], lines: bool) -> Table {
    let shapes = if lines { "lines" } else { "triangles" };
    let mut columns = vec![
        Column::words("family"),
        Column::numbers("cases", "cases judged"),
        Column::numbers(shapes, "shapes judged"),
        Column::numbers("pixels", "covered pixels, by the oracle"),
        Column::numbers("ties", "cases in which a sample lies exactly on an edge"),
    ];
    for pair in &families[0].pairs {
        let label = format!("{} : {}", pair.actual, pair.target);
        columns.push(Column::numbers(&label, "wrong pixels of the first, judged by the second"));
    }
    columns.push(Column::numbers(
        "closest to bound",
        "the largest difference of a value from the exact one, as a fraction of its bound",
    ));
    let mut sorted = families.to_vec();
    let closest = |f: &FamilyReport| {
        let judged = f.pairs.iter().filter(|p| p.target == "oracle" && p.values > 0);
        judged.map(|p| p.worst()).fold(0.0, f64::max)
    };
    let wrong = |f: &FamilyReport| {
        let counts = f
            .pairs
            .iter()
            .map(|p| (p.tally.total() + p.fragments.total() + p.panics, p.wrong_cases));
        counts.fold((0, 0), |sum, (pixels, cases)| (sum.0 + pixels, sum.1 + cases))
    };
    sorted.sort_by(|a, b| wrong(b).cmp(&wrong(a)).then(closest(b).total_cmp(&closest(a))));
    let row = |f: &FamilyReport, mark: Mark| {
        let mut cells = vec![f.family.clone()];
        cells.extend([f.cases, f.shapes, f.pixels, f.tie_cases].map(|n| n.to_string()));
        cells.extend(f.pairs.iter().map(|p| match p.panics {
            0 => p.tally.total().to_string(),
            n => format!("{}, {n} panics", p.tally.total()),
        }));
        let values: u64 = f.pairs.iter().filter(|p| p.target == "oracle").map(|p| p.values).sum();
        cells.push(if values == 0 { "-".to_owned() } else { format!("{:.2}", closest(f)) });
        let search = (mark != Mark::Sum).then(|| f.family.clone());
        Row { cells, mark, search }
    };
    let sum = table::sum(families);
    let rows = sorted.iter().map(|f| {
        row(f, if wrong(f).1 > 0 || f.oracle_overlap > 0 { Mark::Wrong } else { Mark::Plain })
    });
    let caption = format!("Wrong pixels: {shapes}, by family and pair, worst first");
    Table { caption, columns, rows: [row(&sum, Mark::Sum)].into_iter().chain(rows).collect() }
}

fn off_lattice(verdict: &ExactVerdict) -> Table {
    let mut columns = vec![
        Column::words("family"),
        Column::numbers("cases", "cases judged"),
        Column::numbers("triangles", "triangles judged"),
        Column::numbers("pixels", "covered pixels, by the oracle"),
        Column::numbers("ties", "cases in which a sample lies exactly on an edge"),
    ];
    let engines = verdict.families.first().map_or(&[][..], |f| f.engines.as_slice());
    for engine in engines {
        let label = format!("{} : oracle-exact", engine.engine);
        columns.push(Column::numbers(&label, "wrong pixels"));
        let about = "decisions that took exact arithmetic, of all decisions";
        columns.push(Column::numbers(&format!("{} in doubt", engine.engine), about));
    }
    let wrong = |f: &ExactFamilyReport| {
        let counts = f.engines.iter().map(|e| (e.tally.total() + e.panics, e.wrong_cases));
        counts.fold((0, 0), |sum, (pixels, cases)| (sum.0 + pixels, sum.1 + cases))
    };
    let doubts =
        |f: &ExactFamilyReport| f.engines.iter().map(|e| e.decisions.by_fallback).sum::<u64>();
    let mut sorted: Vec<_> = verdict.families.iter().collect();
    sorted.sort_by_key(|f| std::cmp::Reverse((wrong(f), doubts(f))));
    let row = |f: &ExactFamilyReport, mark: Mark| {
        let mut cells = vec![f.family.clone()];
        cells.extend([f.cases, f.triangles, f.pixels, f.tie_cases].map(|n| n.to_string()));
        for e in &f.engines {
            cells.push(match e.panics {
                0 => e.tally.total().to_string(),
                n => format!("{}, {n} panics", e.tally.total()),
            });
            let Decisions { by_filter, by_fallback } = e.decisions;
            cells.push(format!("{by_fallback} of {}", by_filter + by_fallback));
        }
        let search = (mark != Mark::Sum).then(|| f.family.clone());
        Row { cells, mark, search }
    };
    let mut rows = Vec::new();
    if let Some((first, others)) = verdict.families.split_first() {
        let mut sum = ExactFamilyReport { family: "all".to_owned(), ..first.clone() };
        others.iter().for_each(|f| sum += f.clone());
        rows.push(row(&sum, Mark::Sum));
    }
    rows.extend(sorted.into_iter().map(|f| {
        row(f, if wrong(f).1 > 0 || f.oracle_faults > 0 { Mark::Wrong } else { Mark::Plain })
    }));
    let caption = "Wrong pixels: triangles off the grid, by family and engine, worst first";
    Table { caption: caption.to_owned(), columns, rows }
}

/// Named inputs that must be refused, with the reason they are.
pub fn refused() -> Table {
    let rows = named::named().into_iter().filter_map(|named| {
        let Input::Refused(triangles) = named.input else { return None };
        let mut reasons: Vec<String> = triangles
            .iter()
            .flatten()
            .filter_map(|&[x, y]| SubpixelPoint::from_px(x, y).err().map(|r| r.to_string()))
            .collect();
        reasons.sort();
        reasons.dedup();
        let cells = vec![named.name.to_owned(), named.about.to_owned(), reasons.join("; ")];
        Some(Row { cells, ..Row::default() })
    });
    Table {
        caption: "Inputs that are refused, with the reason given".to_owned(),
        columns: ["case", "input", "answer"].map(Column::words).to_vec(),
        rows: rows.collect(),
    }
}

/// The survey of the specimens, the most often wrong first.
pub fn of_specimens(reports: &[SpecimenReport]) -> Table {
    let mut sorted: Vec<_> = reports.iter().collect();
    sorted.sort_by(|a, b| b.all.percent().total_cmp(&a.all.percent()));
    let rows = sorted.into_iter().map(|r| {
        let all = &r.all;
        let count = |n: u64| if all.shapes == 0 { "-".to_owned() } else { n.to_string() };
        let percent =
            if all.shapes == 0 { "-".to_owned() } else { format!("{:.1}", all.percent()) };
        let cells = vec![
            r.name.to_owned(),
            r.source.to_owned(),
            percent,
            count(all.tally.missing),
            count(all.tally.extra),
            count(all.tally.twice),
            count(all.shared),
            r.fault.to_owned(),
            r.cure.to_owned(),
        ];
        Row { cells, mark: Mark::Plain, search: Some(r.name.to_owned()) }
    });
    Table {
        caption: "Published algorithms and how often each is wrong, worst first".to_owned(),
        columns: vec![
            Column::words("specimen"),
            Column::words("from"),
            Column::numbers("wrong %", "percent of the triangles or lines that are wrong"),
            Column::numbers("missing", "missing pixels"),
            Column::numbers("extra", "pixels outside the shape"),
            Column::numbers("twice", "hits beyond the first, each triangle for itself"),
            Column::numbers("shared", "hits on edges of a mesh that a second triangle has too"),
            Column::words("fault"),
            Column::words("cure"),
        ],
        rows: rows.collect(),
    }
}
