//! Exercises: a question, its choices, and an answer that nobody types in: the engines and the
//! oracle compute it each time it is asked for.
//!
//! `docs/` ends each chapter with the same exercises, written by [`page::section`]; a test compares.

mod answer;
mod ch01;
mod ch02;
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
mod stability;
mod sysu;
mod tools;

pub use answer::{Answer, Given};

use rasterproof_verify::cases::Rng;

/// The same words in English and in Chinese.
pub type Text = [&'static str; 2];

/// The languages of [`Text`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Language {
    /// The first.
    English,
    /// The second.
    Chinese,
}

impl Language {
    /// The words in this language.
    #[must_use]
    pub fn of(self, text: Text) -> &'static str {
        text[self as usize]
    }
}

/// A question, and how its answer is found.
#[derive(Clone, Copy, Debug)]
pub struct Exercise {
    pub question: Text,
    /// What there is to choose from; empty where a number or a pixel is asked for.
    pub choices: &'static [Text],
    /// Computes the answer from the choices.
    pub solve: fn(&[Text]) -> Solution,
    /// Why; each `{}` stands for the next of [`Solution::figures`].
    pub why: Text,
}

/// What the project's code says about an exercise.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    pub answer: Answer,
    /// Computed figures for the explanation.
    pub figures: Vec<String>,
    /// Pixel grids with their titles, as of [`rasterproof_report::ascii`].
    pub grids: Vec<(String, Vec<String>)>,
}

impl Solution {
    fn new(answer: Answer) -> Self {
        Self { answer, figures: Vec::new(), grids: Vec::new() }
    }

    fn figure(mut self, figure: impl ToString) -> Self {
        self.figures.push(figure.to_string());
        self
    }

    fn grid(mut self, title: &str, lines: Vec<String>) -> Self {
        self.grids.push((title.to_owned(), lines));
        self
    }
}

impl Exercise {
    /// Asks the project's code.
    #[must_use]
    pub fn solution(&self) -> Solution {
        (self.solve)(self.choices)
    }

    /// The question, and to how many digits its answer is asked for.
    #[must_use]
    pub fn question_with_form(&self, language: Language, solution: &Solution) -> String {
        language.of(self.question).to_owned() + &solution.answer.form(language)
    }

    /// The explanation with its figures in place.
    #[must_use]
    pub fn explanation(&self, language: Language, solution: &Solution) -> String {
        let mut figures = solution.figures.iter();
        let mut parts = language.of(self.why).split("{}");
        let first = parts.next().unwrap_or("").to_owned();
        parts.fold(first, |text, part| text + figures.next().map_or("{}", String::as_str) + part)
    }
}

/// The exercises of one page.
#[derive(Clone, Copy, Debug)]
pub struct Chapter {
    /// The page's file under `docs/`, without its ending; `ch02` is also called `2`.
    pub page: &'static str,
    /// What the page is about.
    pub title: Text,
    /// In the order of the page.
    pub exercises: &'static [Exercise],
}

/// Every chapter that has exercises, in the order of reading.
pub static CHAPTERS: &[Chapter] = &[
    ch01::CHAPTER,
    ch02::CHAPTER,
    ch03::CHAPTER,
    ch04::CHAPTER,
    ch05::CHAPTER,
    ch06::CHAPTER,
    ch07::CHAPTER,
    ch08::CHAPTER,
    ch09::CHAPTER,
    ch10::CHAPTER,
    ch11::CHAPTER,
    games101::CHAPTER,
    sysu::CHAPTER,
    effects::CHAPTER,
    stability::CHAPTER,
];

impl Chapter {
    /// What one calls it on the command line: `2` for `ch02`.
    #[must_use]
    pub fn word(&self) -> &'static str {
        self.page.strip_prefix("ch").map_or(self.page, |number| number.trim_start_matches('0'))
    }

    /// What it is called in a sentence: `chapter 2`, or the name of its page.
    #[must_use]
    pub fn name(&self, language: Language) -> String {
        match (self.page.starts_with("ch"), language) {
            (true, Language::English) => format!("chapter {}", self.word()),
            (true, Language::Chinese) => format!("第 {} 章", self.word()),
            (false, _) => self.page.to_owned(),
        }
    }
}

/// The chapter of that name: `2`, `02`, `ch02`, or the name of a page.
#[must_use]
pub fn chapter(word: &str) -> Option<&'static Chapter> {
    let bare = word.strip_prefix("ch").unwrap_or(word).trim_start_matches('0');
    CHAPTERS.iter().find(|chapter| chapter.page == word || chapter.word() == bare)
}

/// The numbers 0..count in an order that the seed decides.
#[must_use]
pub fn order(count: usize, seed: u64) -> Vec<usize> {
    let mut rng = Rng::new("quiz", seed, 0);
    let mut order: Vec<_> = (0..count).collect();
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
        for word in ["2", "02", "ch02"] {
            assert_eq!(chapter(word).unwrap().page, "ch02");
        }
        assert!(["", "0", "12", "ch", "two"].iter().all(|word| chapter(word).is_none()));
    }

    #[test]
    fn an_order_has_every_number_once() {
        let mut seen = order(20, 3);
        assert_ne!(seen, order(20, 4));
        seen.sort_unstable();
        assert!(seen.into_iter().eq(0..20));
    }
}
