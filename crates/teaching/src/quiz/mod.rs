//! Exercises: a question, its choices, and an answer that nobody types in: the engines and the
//! oracle compute it each time it is asked for.
//!
//! The texts are in `exercises.toml`. `docs/` ends each chapter with the same exercises, written by
//! [`page::section`]; a test compares. [`ask`] is the conversation in a
//! terminal.

/// Lists the functions of a page that compute answers, under the names that `exercises.toml` gives.
macro_rules! solvers {
    ($($name:ident),*) => {
        pub const SOLVE: &[(&str, super::Solve)] = &[$((stringify!($name), $name)),*];
    };
}

/// The functions of pages, each with the name of its module.
macro_rules! solvers_of {
    ($($page:ident),*) => { &[$((stringify!($page), $page::SOLVE)),*] };
}

mod answer;
pub mod ask;
mod ch01;
mod ch02;
mod ch02_edge_functions;
mod ch02_scanline;
mod ch03;
mod ch04;
mod ch05;
mod ch06;
mod ch07;
mod ch08;
mod ch09;
mod ch10;
mod ch11;
mod effects;
mod games101;
pub mod page;
mod samples;
mod stability;
mod sysu;
mod textures;
mod tools;

pub use answer::{Given, Right};

use std::sync::LazyLock;

use rasterproof_core::frame::Coverage;
use rasterproof_core::random::Rng;
use rasterproof_verify::judge::ascii;
use serde::Deserialize;

use crate::spine;

/// A text in both languages: English, Chinese.
pub type Text = [String; 2];

/// Computes the answer of an exercise from its choices.
pub type Solve = fn(&[Text]) -> Solution;

/// The language in which somebody is asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Language {
    English,
    Chinese,
}

impl Language {
    pub fn of(self, text: &Text) -> &str {
        &text[self as usize]
    }
}

/// A question of a page, with its choices and the reason of its answer.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Exercise {
    /// The name of the function that computes the answer, in [`SOLVERS`] under the exercise's page.
    solve: String,
    #[serde(skip)]
    solver: Option<Solve>,
    pub question: Text,
    /// What there is to choose from; empty where a number or a pixel is asked for.
    #[serde(default)]
    pub choices: Vec<Text>,
    /// Why; each `{}` stands for the next of [`Solution::figures`].
    pub why: Text,
}

/// What the project's code says about an exercise.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    pub answer: Right,
    pub figures: Vec<String>,
    /// Pixel grids with their titles, as of [`ascii`].
    pub grids: Vec<(String, Vec<String>)>,
}

impl Solution {
    /// An answer without figures and grids.
    fn new(answer: Right) -> Self {
        Self { answer, figures: Vec::new(), grids: Vec::new() }
    }

    /// A number, asked to so many decimals.
    fn number(value: f64, decimals: usize) -> Self {
        Self::new(Right::Number { value, decimals })
    }

    fn count(value: u64) -> Self {
        Self::number(value as f64, 0)
    }

    fn choice(holds: &[bool]) -> Self {
        Self::new(Right::only(holds))
    }

    /// Adds a number that the reason names.
    fn figure(mut self, figure: impl ToString) -> Self {
        self.figures.push(figure.to_string());
        self
    }

    /// What was drawn beside what is right.
    fn grid(mut self, title: &str, actual: &Coverage, right: &Coverage) -> Self {
        self.grids.push((title.to_owned(), ascii::grid(actual, right)));
        self
    }
}

impl Exercise {
    /// Asks the project's code.
    ///
    /// # Panics
    /// Where [`CHAPTERS`] did not find the function, which a test excludes.
    pub fn solution(&self) -> Solution {
        self.solver.expect("every exercise has a function")(&self.choices)
    }

    /// The question, and to how many digits its answer is asked for.
    pub fn question_with_form(&self, language: Language, solution: &Solution) -> String {
        language.of(&self.question).to_owned() + &solution.answer.form(language)
    }

    /// The reason, with the figures in their places.
    pub fn explanation(&self, language: Language, solution: &Solution) -> String {
        let mut figures = solution.figures.iter();
        let mut parts = language.of(&self.why).split("{}");
        let first = parts.next().unwrap_or("").to_owned();
        parts.fold(first, |text, part| text + figures.next().map_or("{}", String::as_str) + part)
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Chapter {
    /// The page's file under `docs/`, without its ending; `ch02` is also called `2a`.
    pub page: String,
    pub title: Text,
    #[serde(rename = "exercise")]
    pub exercises: Vec<Exercise>,
}

/// Every chapter that has exercises, in the order of reading.
pub static CHAPTERS: LazyLock<Vec<Chapter>> = LazyLock::new(chapters);

/// The functions that compute answers, by the module of a page and the name that `exercises.toml` gives.
const SOLVERS: &[(&str, &[(&str, Solve)])] = solvers_of!(
    ch01,
    ch02,
    ch02_edge_functions,
    ch02_scanline,
    ch03,
    ch04,
    ch05,
    ch06,
    ch07,
    ch08,
    ch09,
    ch10,
    ch11,
    samples,
    textures,
    games101,
    sysu,
    effects,
    stability
);

/// Reads the texts, and gives each exercise its function.
fn chapters() -> Vec<Chapter> {
    #[derive(Deserialize)]
    struct Texts {
        chapter: Vec<Chapter>,
    }
    let texts: Texts =
        toml::from_str(include_str!("exercises.toml")).expect("the tests read the same text");
    let mut chapters = texts.chapter;
    for chapter in &mut chapters {
        let module = chapter.module();
        let solvers = SOLVERS.iter().find(|(name, _)| *name == module);
        for exercise in &mut chapter.exercises {
            // A name without a function stays without one, which a test finds.
            let named =
                solvers.and_then(|(_, s)| s.iter().find(|(name, _)| *name == exercise.solve));
            exercise.solver = named.map(|(_, solve)| *solve);
        }
    }
    chapters
}

impl Chapter {
    /// What one calls it on the command line: the number of its chapter, `2a` for `ch02`, or the name of its page.
    pub fn word(&self) -> &str {
        spine::number(&self.page).unwrap_or(&self.page)
    }

    /// The name of the module that has its functions.
    fn module(&self) -> String {
        self.page.replace('-', "_")
    }

    /// What it is called in a sentence: `chapter 2a`, or the name of its page.
    pub fn name(&self, language: Language) -> String {
        match (spine::number(&self.page), language) {
            (Some(number), Language::English) => format!("chapter {number}"),
            (Some(number), Language::Chinese) => format!("第 {number} 章"),
            (None, _) => self.page.clone(),
        }
    }
}

/// The chapter of that name: `5`, `ch05`, or the name of a page. `2` is the first part of chapter 2.
pub fn chapter(word: &str) -> Option<&'static Chapter> {
    let word = if word == "2" { "2a" } else { word };
    CHAPTERS.iter().find(|chapter| chapter.page == word || chapter.word() == word)
}

/// The numbers 0..count in an order that the seed decides.
pub fn order(count: usize, seed: u64) -> Vec<usize> {
    let mut rng = Rng::new("quiz", seed, 0);
    let mut order: Vec<_> = (0..count).collect();
    // The shuffle of Fisher and Yates: each order is equally likely.
    for last in (1..count).rev() {
        order.swap(last, rng.int(0, last as i64) as usize);
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chapters_by_any_of_their_names() {
        for word in ["2", "2a", "ch02"] {
            assert_eq!(chapter(word).unwrap().page, "ch02");
        }
        let scanline = chapter("ch02-scanline").unwrap();
        assert_eq!(
            (scanline.word(), scanline.name(Language::English)),
            ("2c", "chapter 2c".to_owned())
        );
        assert_eq!(chapter("2c").unwrap().page, "ch02-scanline");
        assert!(["", "0", "14", "ch", "two"].iter().all(|word| chapter(word).is_none()));
    }

    /// A function without an exercise is not counted by the exercises, and an exercise without a function panics.
    #[test]
    fn exercises_and_functions_belong_together() {
        let texts =
            CHAPTERS.iter().flat_map(|c| c.exercises.iter().map(|e| (c.module(), &*e.solve)));
        let functions = SOLVERS
            .iter()
            .flat_map(|(module, s)| s.iter().map(|(name, _)| (module.to_string(), *name)));
        assert!(texts.eq(functions), "in the same order");
    }

    #[test]
    fn an_order_has_every_number_once() {
        let mut seen = order(20, 3);
        assert_ne!(seen, order(20, 4));
        seen.sort_unstable();
        assert!(seen.into_iter().eq(0..20));
    }
}
