//! Where the docs explain what a page shows.

use serde::Serialize;

/// A page of the docs that explains something.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Chapter {
    /// In words; nothing where there is no such place.
    pub title: &'static str,
    /// A file below `docs`, with a fragment.
    pub path: &'static str,
}

/// The page of the docs about the source of a published algorithm, such as `book 3.2`.
pub fn chapter_of_source(source: &str) -> Chapter {
    /// The pages of sources, by how their names begin.
    const PAGES: [(&str, &str, &str); 12] = [
        ("book 2", "chapter 2", "ch02.md"),
        ("book 3", "chapter 3", "ch03.md"),
        ("book 4", "chapter 4", "ch04.md"),
        ("book 5", "chapter 5", "ch05.md"),
        ("book 6", "chapter 6", "ch06.md"),
        ("book 7", "chapter 7", "ch07.md"),
        ("book 8", "chapter 8", "ch08.md"),
        ("book 9", "chapter 9", "ch09.md"),
        ("book 10", "chapter 10", "ch10.md"),
        ("book 11", "chapter 11", "ch11.md"),
        ("GAMES101", "GAMES101 homework 2", "games101.md"),
        ("SYSU", "SYSU assignment 2", "sysu.md"),
    ];
    // A source that no page is about leads to none.
    let page = PAGES.iter().find(|(from, ..)| source.starts_with(from));
    page.map_or(Chapter::default(), |&(_, title, path)| Chapter { title, path })
}
