//! Tables as values, from which both the text of a terminal and the tables of a page are written.

use std::fmt::Write as _;

/// A table with a header and a row head in its first column.
#[derive(Clone, Debug, Default)]
pub struct Table {
    pub caption: String,
    pub columns: Vec<Column>,
    pub rows: Vec<Row>,
    /// What is said below it, a line each.
    pub notes: Vec<String>,
}

#[derive(Clone, Debug, Default)]
pub struct Column {
    pub label: String,
    /// What stands over it in a terminal, where the label would be too wide.
    short: String,
    /// The head in more words, or nothing.
    pub about: String,
    pub is_number: bool,
    /// How many characters it has at least in a terminal; 0 where its cells stand below the row there.
    least: usize,
}

impl Column {
    #[must_use]
    pub fn words(label: &str) -> Self {
        Self { label: label.to_owned(), short: label.to_owned(), ..Self::default() }
    }

    /// A column of numbers; `about` says what is counted.
    #[must_use]
    pub fn numbers(label: &str, about: &str) -> Self {
        Self { about: about.to_owned(), is_number: true, ..Self::words(label) }
    }

    /// The same with a column in a terminal, of so many characters at least.
    #[must_use]
    pub fn least(self, least: usize) -> Self {
        Self { least, ..self }
    }

    /// The same with another head in a terminal.
    #[must_use]
    pub fn short(self, label: impl Into<String>) -> Self {
        Self { short: label.into(), ..self }
    }
}

#[derive(Clone, Debug, Default)]
pub struct Row {
    /// Where there are fewer cells than columns, the last one takes the rest of the row.
    pub cells: Vec<String>,
    pub mark: Mark,
    /// What to search the cases for when its head is chosen, if anything.
    pub search: Option<String>,
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
    Wrong,
    /// As the sum of the others; always shown.
    Sum,
}

impl Table {
    /// The table in a terminal: a line of heads, and for each row a line of cells side by side, then a line for
    /// each of its other cells that is not empty. Rows begin at column `rows`, their other cells at column `below`.
    #[must_use]
    pub fn text(&self, [rows, below]: [usize; 2]) -> String {
        let heads = self.columns.iter().map(|column| match column.least {
            0 => String::new(),
            _ => column.short.clone(),
        });
        let indented = |row: &Row| {
            let mut cells = row.cells.clone();
            if let Some(first) = cells.first_mut() {
                first.insert_str(0, &" ".repeat(rows));
            }
            cells
        };
        let lines: Vec<Vec<String>> =
            std::iter::once(heads.collect()).chain(self.rows.iter().map(indented)).collect();
        let is_whole = |cells: &&Vec<String>| cells.len() == self.columns.len();
        let width = |(i, column): (usize, &Column)| {
            let cells = lines.iter().filter(is_whole).map(|cells| cells[i].chars().count());
            if column.least == 0 { 0 } else { cells.fold(column.least, usize::max) }
        };
        let widths: Vec<usize> = self.columns.iter().enumerate().map(width).collect();
        let mut out = String::new();
        for cells in &lines {
            let mut line = String::new();
            let mut others = String::new();
            for (i, ((cell, column), &width)) in
                cells.iter().zip(&self.columns).zip(&widths).enumerate()
            {
                let gap = if i > 0 { " " } else { "" };
                let takes_rest = i + 1 == cells.len() && !is_whole(&cells);
                let _ = match (width, column.is_number && !takes_rest) {
                    (0, _) => {
                        cell.lines().try_for_each(|part| writeln!(others, "{:below$}{part}", ""))
                    }
                    (_, true) => write!(line, "{gap}{cell:>width$}"),
                    (_, false) => write!(line, "{gap}{cell:<width$}"),
                };
            }
            let _ = writeln!(out, "{}", line.trim_end());
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
        let columns = vec![
            Column::words("name").least(6),
            Column::numbers("pixels", "").short("px").least(3),
            Column::words("why"),
        ];
        let row =
            |cells: &[&str]| Row::from(cells.iter().map(ToString::to_string).collect::<Vec<_>>());
        let rows =
            vec![row(&["a", "12345", "one\ntwo"]), row(&["b", "not run"]), row(&["c", "7", ""])];
        let table = Table { columns, rows, ..Table::default() };
        let text = "name      px\n  a    12345\n    one\n    two\n  b    not run\n  c        7\n";
        assert_eq!(table.text([2, 4]), text);
    }
}
