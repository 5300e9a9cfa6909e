//! What a text of characters is made of. Coverage as characters: `#` agrees, `-` missing, `+` extra, `2` twice, `.` outside both.

use rasterproof_core::frame::Coverage;

pub const LEGEND: &str =
    "# agrees, - missing, + extra, 2 twice, * rightly more than once, . neither";

/// Largest grid that is printed whole; a larger window is cropped around what is drawn.
pub const MOST_COLUMNS: u32 = 96;
pub const MOST_ROWS: u32 = 48;

/// The character of a pixel with these hits.
#[must_use]
pub fn mark(actual: u8, target: u8) -> char {
    match (actual, target) {
        (0, 0) => '.',
        (a, t) if a > t && a > 1 => '2',
        (a, t) if a > t => '+',
        (a, t) if a < t => '-',
        (1, _) => '#',
        // More than one hit, rightly so: triangles of the case overlap.
        _ => '*',
    }
}

/// The grid of `actual` judged by `target`, one line for each row, without line ends.
#[must_use]
pub fn grid(actual: &Coverage, target: &Coverage) -> Vec<String> {
    let (x, y) = shown(actual, target);
    let rows = actual.rows().zip(target.rows()).skip(y.start).take(y.len());
    rows.map(|((_, a), (_, t))| {
        a.iter().zip(t).skip(x.start).take(x.len()).map(|(&a, &t)| mark(a, t)).collect()
    })
    .collect()
}

/// The columns and rows worth showing, counted from the window's corner.
fn shown(actual: &Coverage, target: &Coverage) -> (std::ops::Range<usize>, std::ops::Range<usize>) {
    let bounds = actual.bounds();
    let (width, height) = (bounds.width() as usize, bounds.height() as usize);
    let (most_x, most_y) = (MOST_COLUMNS as usize, MOST_ROWS as usize);
    if width <= most_x && height <= most_y {
        return (0..width, 0..height);
    }
    // Start just before the first pixel that differs, else before the first one that is hit.
    let find = |wanted: &dyn Fn(u8, u8) -> bool| {
        let mut found: Option<(usize, usize)> = None;
        let mut left = usize::MAX;
        for (j, ((_, a), (_, t))) in actual.rows().zip(target.rows()).enumerate() {
            if let Some(i) = a.iter().zip(t).position(|(&a, &t)| wanted(a, t)) {
                found = found.or(Some((i, j)));
                left = left.min(i);
            }
        }
        found.map(|first| (first, left))
    };
    let differs = |((x, y), left): ((usize, usize), usize)| {
        // Further left where others differ, as long as the first one stays in sight.
        (if x < left + most_x / 2 { left } else { x }, y)
    };
    let is_hit = |((_, y), left): ((usize, usize), usize)| (left, y);
    let differing = find(&|a, t| a != t).map(differs);
    let (x, y) = differing.or_else(|| find(&|a, t| a > 0 || t > 0).map(is_hit)).unwrap_or((0, 0));
    let start =
        |at: usize, size: usize, most: usize| at.saturating_sub(2).min(size.saturating_sub(most));
    let (x, y) = (start(x, width, most_x), start(y, height, most_y));
    (x..width.min(x + most_x), y..height.min(y + most_y))
}

/// What was drawn by each of those named beside what is expected, with the legend.
#[must_use]
pub fn beside(names: &[&str], drawn: &[&Coverage], expected: &Coverage, columns: usize) -> String {
    let drawn =
        names.iter().zip(drawn).map(|(by, drawn)| ((*by).to_owned(), grid(drawn, expected)));
    let blocks: Vec<_> = drawn.chain([("expected".to_owned(), grid(expected, expected))]).collect();
    let lines = side_by_side(&blocks, columns);
    let lines = lines.lines().map(|line| format!("  {line}").trim_end().to_owned() + "\n");
    lines.collect::<String>() + &format!("  ({LEGEND})\n")
}

/// Puts blocks of lines beside each other under their titles, as many as fit `columns`.
#[must_use]
pub fn side_by_side(blocks: &[(String, Vec<String>)], columns: usize) -> String {
    let mut out = String::new();
    let width = |(title, lines): &(String, Vec<String>)| {
        lines.iter().map(|l| l.chars().count()).chain([title.chars().count()]).max().unwrap_or(0)
    };
    let mut rest = blocks;
    while !rest.is_empty() {
        let mut count = 0;
        let mut used = 0;
        while count < rest.len() && (count == 0 || used + width(&rest[count]) <= columns) {
            used += width(&rest[count]) + 3;
            count += 1;
        }
        let (now, later) = rest.split_at(count);
        let height = now.iter().map(|(_, lines)| lines.len()).max().unwrap_or(0);
        for row in 0..=height {
            let cells = now.iter().map(|block| {
                let text = if row == 0 { Some(&block.0) } else { block.1.get(row - 1) };
                format!("{:w$}", text.map_or("", String::as_str), w = width(block))
            });
            out.push_str(cells.collect::<Vec<_>>().join("   ").trim_end());
            out.push('\n');
        }
        rest = later;
    }
    out
}

/// The text in lines that `width` finds no wider than `room`, broken at blanks, and between Chinese characters, but not before a
/// mark such as a full stop.
#[must_use]
pub fn lines<T: PartialOrd>(text: &str, room: T, width: impl Fn(&str) -> T) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        let may_begin = |(_, c): &(usize, char)| is_wide(*c) && !"，。、；：？！）”".contains(*c);
        let breaks = word.char_indices().skip(1).filter(may_begin).map(|(at, _)| at);
        let mut from = 0;
        for to in breaks.chain([word.len()]) {
            let (gap, piece) = (if from == 0 { " " } else { "" }, &word[from..to]);
            let longer = lines.last().map(|line| format!("{line}{gap}{piece}"));
            match (longer.filter(|longer| width(longer) <= room), lines.last_mut()) {
                (Some(longer), Some(line)) => *line = longer,
                _ => lines.push(piece.to_owned()),
            }
            from = to;
        }
    }
    lines
}

fn is_wide(c: char) -> bool {
    ('\u{2e80}'..='\u{ffe6}').contains(&c)
}

/// Columns of a text in a terminal, where a Chinese character takes two.
#[must_use]
pub fn columns(text: &str) -> usize {
    text.chars().map(|c| 1 + usize::from(is_wide(c))).sum()
}

/// A text whose lines are broken at so many columns, those with code left whole, all but the first behind `indent`.
#[must_use]
pub fn broken(text: &str, room: usize, indent: &str) -> String {
    let of_line = |line: &str| match line.contains("::") {
        true => line.to_owned(),
        false => lines(line, room - indent.len(), columns).join(&format!("\n{indent}")),
    };
    text.lines().map(of_line).collect::<Vec<_>>().join(&format!("\n{indent}"))
}
