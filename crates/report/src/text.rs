//! A [`Report`] as text for a terminal.

use std::fmt::Write as _;

use super::html::{Answer, Report};
use super::lettering;
use super::table::Table;

/// Columns of a terminal that a first screen has.
const SCREEN: usize = 80;

/// Columns of everything else.
pub const WIDTH: usize = 100;

/// What it is about, the answers, and below them the first screen or all of it.
#[must_use]
pub fn text(report: &Report, all: bool) -> String {
    let mut out = format!("{}\n\n{}\n", report.about, answers(&report.answers));
    out += &match all {
        true => tables(&report.tables, WIDTH),
        false => tables(&report.first_screen, SCREEN),
    };
    if all {
        for note in &report.notes {
            lines(&mut out, note, WIDTH, ["", "  "]);
        }
    }
    out.truncate(out.trim_end().len());
    out + "\n"
}

/// Answers, and below each the command that says more.
fn answers(answers: &[Answer]) -> String {
    let mut out = String::new();
    for Answer { about, sentence, command } in answers {
        lines(&mut out, sentence, SCREEN, [&format!("{about:<12}"), &" ".repeat(12)]);
        if !command.is_empty() {
            let _ = writeln!(out, "{:<12}$ {command}", "");
        }
    }
    out
}

/// Tables below each other, each with its caption and notes.
#[must_use]
pub fn tables(tables: &[Table], width: usize) -> String {
    let mut out = String::new();
    for table in tables {
        if !table.caption.is_empty() {
            let _ = writeln!(out, "{}", table.caption);
        }
        if !table.rows.is_empty() {
            out += &table.text([2, 4]);
        }
        for note in &table.notes {
            lines(&mut out, note, width, ["  ", "    "]);
        }
        out.push('\n');
    }
    out
}

/// Words in lines of at most `width` columns: the first begins with one word, the others with another. A command is not
/// broken, so that it can be copied.
fn lines(out: &mut String, words: &str, width: usize, [first, rest]: [&str; 2]) {
    if words.starts_with("rasterproof ") {
        let _ = writeln!(out, "{rest}{words}");
        return;
    }
    let room = width - first.chars().count().max(rest.chars().count());
    let all = lettering::lines(words, room, |line| line.chars().count());
    for (number, line) in all.iter().enumerate() {
        let _ = writeln!(out, "{}{line}", if number == 0 { first } else { rest });
    }
}
