//! A [`Report`] as text for a terminal.

use std::fmt::Write as _;

use super::html::{Excerpt, Outcome, Report, Statement};
use super::table::Table;
use super::words::mark;
use rasterproof_verify::judge::ascii;

/// Columns of a terminal that a first screen has.
pub(super) const SCREEN: usize = 80;

/// Columns of everything else, where a terminal has so many.
pub const WIDTH: usize = 100;

/// What it is about, the answers, below them the first screen or all of it, how to repeat it, and the verdict in a word, in
/// lines of at most so many columns.
pub fn text(report: &Report, all: bool, colour: bool, columns: usize) -> String {
    // No wider than what can be read without moving the head.
    let (screen, columns) = (columns.min(SCREEN), columns.min(WIDTH));
    let verdict = report.outcome.as_ref().filter(|outcome| outcome.is_verdict());
    // A verdict begins with its mark, so that it is seen before anything is read.
    let mut out = match verdict {
        Some(outcome) if !report.about.is_empty() => format!("{} ", mark(outcome.good, colour)),
        _ => String::new(),
    };
    // The verdict stands behind the first line of what it is about.
    let answer = verdict.map(|outcome| &outcome.answer).filter(|answer| !answer.is_empty());
    let mut answer = answer.map(|answer| format!(": {answer}"));
    for part in report.about.lines() {
        let first = format!("{part}{}", answer.take().unwrap_or_default());
        lines(&mut out, &first, columns, ["", "  "]);
    }
    if !report.answers.is_empty() {
        out += &format!("\n{}", answers(&report.answers, screen));
    }
    if !out.is_empty() {
        out.push('\n');
    }
    for one in &report.excerpts {
        out += &excerpt(one, columns);
    }
    // A first screen is short enough to be read at once.
    let all = all || report.first_screen.is_empty();
    out += &match all {
        true => tables(&report.tables, columns, colour),
        false => tables(&report.first_screen, screen, colour),
    };
    if all {
        for words in &report.notes {
            note(&mut out, words, columns, ["", "  "]);
        }
    }
    // Last of all what to do, and the verdict again, since the beginning may have scrolled away.
    let repeat = if report.repeat.is_empty() { &report.command } else { &report.repeat };
    if !repeat.is_empty() {
        let _ = writeln!(out, "repeat with: {repeat}");
    }
    if let Some(Outcome { word, sentence, .. }) = &report.outcome {
        lines(&mut out, &format!("{word}: {sentence}"), columns, ["", "  "]);
    }
    out.truncate(out.trim_end().len());
    out + "\n"
}

/// Answers, and below each the command that says more.
fn answers(answers: &[Statement], columns: usize) -> String {
    let mut out = String::new();
    for Statement { about, sentence, command } in answers {
        lines(&mut out, sentence, columns, [&format!("{about:<12}"), &" ".repeat(12)]);
        if !command.is_empty() {
            let _ = writeln!(out, "{:<12}$ {command}", "");
        }
    }
    out
}

/// A case with its pixels, what is said of it, and where to go on.
pub fn excerpt(of: &Excerpt, columns: usize) -> String {
    let mut out = String::new();
    for line in of.title.lines() {
        lines(&mut out, line, columns, ["", "  "]);
    }
    labelled(&mut out, &of.exchanges);
    if !of.grid.is_empty() {
        // The pixels stand apart from the title.
        let gap = if out.is_empty() || !of.exchanges.is_empty() { "" } else { "\n" };
        let _ = writeln!(out, "{gap}{}", of.grid.trim_end_matches('\n'));
    }
    for words in &of.notes {
        out.push('\n');
        note(&mut out, words, columns, ["", "  "]);
    }
    labelled(&mut out, &of.places);
    out + "\n"
}

/// Lines that are not broken, each behind what it is.
fn labelled(out: &mut String, lines: &[(&str, String)]) {
    let mut widest = 9;
    for (what, _) in lines {
        widest = widest.max(what.len() + 1);
    }
    for (what, line) in lines {
        let _ = writeln!(out, "  {:<widest$} {line}", format!("{what}:"));
    }
}

/// Tables below each other, each with its caption and notes.
pub fn tables<'a>(
    tables: impl IntoIterator<Item = &'a Table>,
    width: usize,
    colour: bool,
) -> String {
    let mut out = String::new();
    for table in tables {
        if !table.caption.is_empty() {
            lines(&mut out, &table.caption, width, ["", "  "]);
        }
        if !table.rows.is_empty() {
            // Numbers that are as wide as the terminal begin at its margin; words are broken.
            let is_wide = |line: &str| line.chars().count() > width;
            let is_wide = table.columns.last().is_some_and(|last| last.is_number)
                && table.text([2, 4], false).lines().any(is_wide);
            out += &table.text([if is_wide { 0 } else { 2 }, 4], colour);
        }
        // Below the table, what its heads mean and what is said of it.
        let legend = Some(&table.legend).filter(|legend| !legend.is_empty());
        for words in legend.into_iter().chain(&table.notes) {
            note(&mut out, words, width, ["  ", "    "]);
        }
        out.push('\n');
    }
    out
}

/// A note in lines; a command is not broken, so that it can be copied.
fn note(out: &mut String, words: &str, width: usize, indents: [&str; 2]) {
    // A note that is a command begins with the name of a program.
    let (program, more) = words.split_once(' ').unwrap_or((words, ""));
    if !more.is_empty() && (program.ends_with("rasterproof") || program == "cargo") {
        let _ = writeln!(out, "{}{words}", indents[1]);
    } else {
        lines(out, words, width, indents);
    }
}

/// Words in lines of at most `width` columns: the first begins with one word, the others with another.
fn lines(out: &mut String, words: &str, width: usize, [first, rest]: [&str; 2]) {
    // All lines are as long, whichever indent they have.
    let room = width - first.len().max(rest.len());
    for (number, line) in ascii::lines(words, room, ascii::columns).iter().enumerate() {
        let _ = writeln!(out, "{}{line}", if number == 0 { first } else { rest });
    }
}
