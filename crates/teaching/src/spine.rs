//! The chapters in the order in which they are read, and the one numbering of all that belongs to a chapter: its lesson, its stage of
//! a program of one's own, its steps of the course, and its quiz.

/// The page of each chapter, without its ending, and its number.
pub const CHAPTERS: [(&str, &str); 15] = [
    ("ch01", "1"),
    ("ch02", "2a"),
    ("ch02-edge-functions", "2b"),
    ("ch02-scanline", "2c"),
    ("ch03", "3"),
    ("ch04", "4"),
    ("ch05", "5"),
    ("ch06", "6"),
    ("ch07", "7"),
    ("ch08", "8"),
    ("ch09", "9"),
    ("ch10", "10"),
    ("ch11", "11"),
    ("samples", "12"),
    ("textures", "13"),
];

/// The number of the chapter with this page.
pub fn number(page: &str) -> Option<&'static str> {
    CHAPTERS.iter().find(|(chapter, _)| *chapter == page).map(|(_, number)| *number)
}
