//! Tables as values, from which both the text of a terminal and the tables of a page are written.

use std::fmt::{Display, Write as _};

use super::words::mark;

/// A table with a header and a row head in its first column.
#[must_use]
#[derive(Clone, Debug, Default)]
pub struct Table {
    /// Nothing for a table that belongs to the one above it.
    pub caption: String,
    pub columns: Vec<Column>,
    pub rows: Vec<Row>,
    /// What is said below it, a line each.
    pub notes: Vec<String>,
    /// What the short heads of a terminal mean; a page has the long ones.
    pub legend: String,
    /// Whether each row was judged, so that a tick or a cross stands before it in a terminal.
    pub is_judged: bool,
}

/// A column, with what a terminal and a page say over it.
#[must_use]
#[derive(Clone, Debug, Default)]
pub struct Column {
    pub label: String,
    /// What stands over it in a terminal, where the label would be too wide.
    short: String,
    /// The head in more words, or nothing.
    pub about: String,
    /// Numbers stand at the right of their column, so that digits line up.
    pub is_number: bool,
    /// Whether the label stands before each cell that stands below its row.
    is_labelled: bool,
    /// How many characters it has at least in a terminal; 0 where its cells stand below the row there.
    least: usize,
}

/// Columns as a line, parted by ` | `. Each has a label, its least width in a terminal, and what it is about. Before the
/// label stand `>` where the cells are numbers and `~` where a terminal has no head; without a width the cells stand below
/// their row there, with `:` each behind the label.
pub fn columns(all: &str) -> Vec<Column> {
    all.split(" | ").map(column).collect()
}

fn column(text: &str) -> Column {
    let (is_number, text) = without_sign(text, '>');
    let (is_labelled, text) = without_sign(text, ':');
    let (is_headless, text) = without_sign(text, '~');
    // The first word that is a number is the width; what follows it is what the column is about.
    let words: Vec<&str> = text.split(' ').collect();
    let width = words.iter().position(|word| word.parse::<usize>().is_ok());
    let at = width.unwrap_or(words.len());
    let label = words[..at].join(" ");
    Column {
        short: if is_headless { String::new() } else { label.clone() },
        label,
        about: words.get(at + 1..).unwrap_or_default().join(" "),
        is_number,
        is_labelled,
        least: words.get(at).and_then(|word| word.parse().ok()).unwrap_or_default(),
    }
}

/// Whether a text begins with a sign, and what follows it.
fn without_sign(text: &str, sign: char) -> (bool, &str) {
    match text.strip_prefix(sign) {
        Some(rest) => (true, rest),
        None => (false, text),
    }
}

impl Column {
    pub fn words(label: &str) -> Self {
        Self { label: label.to_owned(), short: label.to_owned(), ..Self::default() }
    }

    /// A column of numbers; `about` says what is counted.
    pub fn numbers(label: &str, about: &str) -> Self {
        Self { about: about.to_owned(), is_number: true, ..Self::words(label) }
    }

    /// The same with a column in a terminal, of so many characters at least.
    pub fn least(self, least: usize) -> Self {
        Self { least, ..self }
    }

    /// The same with another head in a terminal.
    pub fn short(self, label: impl Into<String>) -> Self {
        Self { short: label.into(), ..self }
    }
}

/// A row, with what a page makes of it.
#[must_use]
#[derive(Clone, Debug, Default)]
pub struct Row {
    /// Where there are fewer cells than columns, the last one takes the rest of the row.
    pub cells: Vec<String>,
    /// Whether something is wrong in it, or it is a sum.
    pub mark: Mark,
    /// What to search the cases for when its head is chosen, if anything.
    pub search: Option<String>,
    /// How many of its pixels are wrong: the length of its bar on a page.
    pub wrong: u64,
    /// The columns of its cells that are as good as can be, shown in green.
    pub good: Vec<usize>,
}

impl Row {
    pub fn of(cells: &[&dyn Display]) -> Self {
        Self::from(cells.iter().map(ToString::to_string).collect::<Vec<_>>())
    }

    /// The same with the mark of a row that was judged.
    pub fn marked(self, is_right: bool) -> Self {
        Self { mark: if is_right { Mark::Plain } else { Mark::Wrong }, ..self }
    }
}

impl From<Vec<String>> for Row {
    fn from(cells: Vec<String>) -> Self {
        Self { cells, ..Self::default() }
    }
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mark {
    #[default]
    Plain,
    /// Shown even where a page hides most of many rows.
    Wrong,
    /// As the sum of the others; always shown.
    Sum,
}

impl Table {
    /// A table with columns as [`columns`] reads them.
    pub fn new(caption: &str, columns: &str, rows: Vec<Row>) -> Self {
        Self::of(caption, self::columns(columns), rows)
    }

    pub fn of(caption: &str, columns: Vec<Column>, rows: Vec<Row>) -> Self {
        Self { caption: caption.to_owned(), columns, rows, ..Self::default() }
    }

    pub fn noted(self, notes: Vec<String>) -> Self {
        Self { notes, ..self }
    }

    /// The same with a tick or a cross before each row, by its mark.
    pub fn judged(self) -> Self {
        Self { is_judged: true, ..self }
    }

    /// A caption and notes, without rows.
    pub fn of_notes(caption: &str, notes: Vec<String>) -> Self {
        Self { caption: caption.to_owned(), notes, ..Self::default() }
    }

    /// The table in a terminal: a line of heads, and for each row a line of cells side by side, then a line for
    /// each of its other cells that is not empty. Rows begin at column `rows`, their other cells at column `below`.
    pub fn text(&self, [rows, below]: [usize; 2], colour: bool) -> String {
        // A line of heads, then one for each row, which is moved to the right and marked in its first cell.
        let mut heads = Vec::new();
        for column in &self.columns {
            heads.push(if column.least == 0 { String::new() } else { column.short.clone() });
        }
        let mut lines: Vec<Vec<String>> = vec![heads];
        for row in &self.rows {
            let mut cells = row.cells.clone();
            if let Some(first) = cells.first_mut() {
                let is_right = row.mark != Mark::Wrong;
                let mark = if self.is_judged { mark(is_right, false) } else { "" };
                let gap = if self.is_judged { " " } else { "" };
                *first = format!("{:rows$}{mark}{gap}{first}", "");
            }
            lines.push(cells);
        }
        // A column is as wide as its widest cell, but for rows whose last cell takes the rest.
        let is_whole = |cells: &&Vec<String>| cells.len() == self.columns.len();
        let mut widths: Vec<usize> = self.columns.iter().map(|column| column.least).collect();
        for cells in lines.iter().filter(is_whole) {
            for (width, cell) in widths.iter_mut().zip(cells) {
                if *width > 0 {
                    *width = cell.chars().count().max(*width);
                }
            }
        }
        let mut out = String::new();
        for (number, cells) in lines.iter().enumerate() {
            // The first line is that of the heads.
            let row = number.checked_sub(1).map(|row| &self.rows[row]);
            let is_green = |i| colour && row.is_some_and(|row| row.good.contains(&i));
            let mut line = String::new();
            let mut others = String::new();
            for (i, ((cell, column), &width)) in
                cells.iter().zip(&self.columns).zip(&widths).enumerate()
            {
                let gap = if i > 0 { " " } else { "" };
                // A last cell that has no column of its own is not padded.
                let takes_rest = i + 1 == cells.len() && !is_whole(&cells);
                // A cell below its row says what it is about.
                let label = if column.is_labelled && !takes_rest {
                    &*format!("{}: ", column.label)
                } else {
                    ""
                };
                let _ = match (width, column.is_number && !takes_rest) {
                    (0, _) => cell.lines().enumerate().try_for_each(|(number, part)| {
                        let label = if number == 0 { label } else { "" };
                        writeln!(others, "{:below$}{label}{part}", "")
                    }),
                    (_, true) if is_green(i) => write!(line, "{gap}\x1b[32m{cell:>width$}\x1b[0m"),
                    (_, true) => write!(line, "{gap}{cell:>width$}"),
                    (_, false) => write!(line, "{gap}{cell:<width$}"),
                };
            }
            if let Some(row) = row.filter(|_| self.is_judged && colour) {
                let is_right = row.mark != Mark::Wrong;
                line = line.replacen(mark(is_right, false), mark(is_right, true), 1);
            }
            // Columns without heads have no line of heads.
            if !line.trim_end().is_empty() {
                let _ = writeln!(out, "{}", line.trim_end());
            }
            out += &others;
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_stands_in_columns() {
        let rows = vec![
            Row::of(&[&"a", &12345, &"one\ntwo"]),
            Row::of(&[&"b", &"not run"]),
            Row::of(&[&"c", &7, &""]),
        ];
        let mut table = Table::new("", "name 6 | >pixels 3 covered ones | :why", rows);
        assert_eq!((table.columns[1].is_number, &*table.columns[1].about), (true, "covered ones"));
        table.columns[1].short = "px".to_owned();
        let text =
            "name      px\n  a    12345\n    why: one\n    two\n  b    not run\n  c        7\n";
        assert_eq!(table.text([2, 4], false), text);
    }
}
