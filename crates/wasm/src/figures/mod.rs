//! The live figures of the pages: what each shows for a position of its grips, which prediction is right,
//! and what is said about it. `figures.json` describes them: grips with their ranges, and the texts in both
//! languages. The script of the page inserts what is drawn here and computes no pixel.

mod coverage;
mod drawing;
mod light;
mod lines;
mod pipeline;
mod values;

use std::sync::LazyLock;

use serde::Deserialize;
use serde_json::{Map, Value, json};

use crate::no_answer::NoAnswer;
use drawing::{Drawing, Panel, Point};
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::SubpixelPoint;
use rasterproof_core::triangle::Corners;
use rasterproof_registry::engines::{self, Engine, LineEngine};

/// A figure as `figures.json` describes it.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Figure {
    pub name: String,
    pub page: String,
    grips: Vec<Grip>,
    en: Text,
    zh: Text,
}

/// Something to drag: where it begins, how far it goes, and in which steps.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Grip {
    pub start: Point,
    pub low: Point,
    pub high: Point,
    pub step: f64,
    /// What its position is called in the texts, in x and y; empty where they do not say it.
    #[serde(default)]
    names: [String; 2],
}

/// The words of a figure. `{name}` stands for the position of a grip, or for a number that the figure computes.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Text {
    title: String,
    /// What is to be seen, for those who do not see it.
    alt: String,
    question: String,
    #[serde(default)]
    options: Vec<String>,
    answer: String,
    /// The name of each grip, for screen readers.
    grips: Vec<String>,
}

/// Both have the same figures, with the same grips and numbers.
#[derive(Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Language {
    En,
    Zh,
}

/// Every figure, in the order of the pages.
pub static ALL: LazyLock<Vec<Figure>> = LazyLock::new(|| {
    serde_json::from_str(include_str!("figures.json")).expect("a test reads the same file")
});

/// The positions of the grips, whether the reader has predicted, and the engines that draw the pixels.
struct FigureInput<'a> {
    grips: &'a [Grip],
    at: &'a [Point],
    is_answered: bool,
    fill: Engine,
    pen: LineEngine,
}

/// What the reader predicts before the answer is shown, and what is right.
enum Predict {
    /// Which pixels of a panel; the right answer for each of them, row by row.
    Pixels(Panel, Vec<bool>),
    /// The right answer is the option with this index.
    Choice(usize),
    /// The right answer is a number, shown with so many decimals.
    Number(f64, usize),
}

impl Predict {
    /// The right pixels are those that are hit.
    fn covered(panel: Panel, hits: &Coverage) -> Self {
        let right = panel.pixels().map(|[x, y]| hits.get(x, y) != Some(0));
        Self::Pixels(panel, right.collect())
    }

    /// The right pixels are those of a list.
    fn among(panel: Panel, list: &[[i32; 2]]) -> Self {
        Self::Pixels(panel, panel.pixels().map(|pixel| list.contains(&pixel)).collect())
    }

    /// What the page needs to ask for a prediction, and to say whether it is right.
    fn answer(&self, text: &Text, words: &[(&str, String)]) -> Value {
        match self {
            Self::Pixels(panel, right) => {
                // Each cell with its corner and side on the drawing, to be clicked there.
                let mut cells = Vec::new();
                for [x, y] in panel.pixels() {
                    let [left, top] = panel.place([x, y].map(f64::from));
                    cells.push(json!([left, top, panel.unit, x, y]));
                }
                json!({ "kind": "pixels", "cells": cells, "right": right })
            }
            Self::Choice(right) => {
                let options: Vec<_> =
                    text.options.iter().map(|option| fill(option, words)).collect();
                json!({ "kind": "choice", "options": options, "right": right })
            }
            Self::Number(value, decimals) => {
                json!({ "kind": "number", "decimals": decimals, "right": format!("{value:.decimals$}") })
            }
        }
    }
}

/// What a figure shows for one position of its grips.
struct LiveFigure {
    drawing: Drawing,
    predict: Predict,
    /// The computed numbers that replace the names in braces in the texts.
    values: Vec<(&'static str, String)>,
    /// Where a scene of the playground draws the same pixels, its address; elsewhere the playground shows the figure itself.
    link: Option<String>,
}

/// A figure may be dragged where an engine refuses it; the page then says why.
type Draw = fn(&FigureInput<'_>) -> Result<LiveFigure, NoAnswer>;

/// Who draws each figure of `figures.json`, by its name there.
const DRAWN_BY: [(&str, Draw); 30] = [
    ("one-sample", coverage::one_sample),
    ("snap-to-even", coverage::snap_to_even),
    ("snapped-crack", coverage::snapped_crack),
    ("snapped-fold", coverage::snapped_fold),
    ("line-pixels", lines::line_pixels),
    ("there-and-back", lines::there_and_back),
    ("edge-sign", coverage::edge_sign),
    ("shared-edge", coverage::shared_edge),
    ("edge-owner", coverage::edge_owner),
    ("row-span", coverage::row_span),
    ("middle-row", coverage::middle_row),
    ("weights", values::weights),
    ("wrong-corner", values::wrong_corner),
    ("boards", pipeline::boards),
    ("rod-middle", values::rod_middle),
    ("affine-kink", values::affine_kink),
    ("value-midway", values::value_midway),
    ("nearer", values::nearer),
    ("z-fighting", values::z_fighting),
    ("near-corners", pipeline::near_corners),
    ("divide-first", pipeline::divide_first),
    ("viewport-size", pipeline::viewport_size),
    ("to-pixel", pipeline::to_pixel),
    ("winding", pipeline::winding),
    ("thin-turn", pipeline::thin_turn),
    ("order-matters", pipeline::order_matters),
    ("turn-about", pipeline::turn_about),
    ("brightest", light::brightest),
    ("short-normal", light::short_normal),
    ("texel", light::texel),
];

/// Asks for a figure as it is with its grips at these positions.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Ask {
    name: String,
    language: Language,
    /// Where its grips are; where they begin if nothing is said.
    #[serde(default)]
    at: Vec<Point>,
    #[serde(default)]
    is_answered: bool,
    #[serde(default)]
    is_dark: bool,
    /// Who draws instead of the scanline engine and the DDA: the tests ask for the oracle, and for faults.
    by: Option<String>,
}

impl Ask {
    /// The picture, what is asked and what is right, the texts with their numbers, and the grips with their ranges.
    pub fn answer(&self) -> Result<Value, NoAnswer> {
        let figure = find(&self.name)?;
        let text = figure.text(self.language);
        let (at, drawn) = figure.draw(&self.at, self.is_answered, self.by.as_deref())?;
        let words = figure.words(&at, &drawn);
        // A grip moves within its range in space, and its spot on the drawing moves with it.
        let mut grips = Vec::new();
        for (i, (spot, scale)) in drawn.drawing.grips.iter().enumerate() {
            let grip = &figure.grips[i];
            grips.push(json!({
                "name": text.grips[i], "value": at[i], "spot": spot, "scale": scale,
                "low": grip.low, "high": grip.high, "step": grip.step,
            }));
        }
        let mut values = Map::new();
        for (name, text) in &words {
            values.insert((*name).to_owned(), json!(text));
        }
        // Without a scene that draws the same, the playground shows the figure with its grips here.
        let link = match &drawn.link {
            Some(link) => link.clone(),
            None => format!("#scene=figure&figure={}&at={}", figure.name, json!(at)),
        };
        Ok(json!({
            "title": text.title, "question": fill(&text.question, &words),
            "answer": fill(&text.answer, &words), "alt": fill(&text.alt, &words), "at": at,
            "svg": drawn.drawing.inline(self.is_dark), "predict": drawn.predict.answer(text, &words),
            "grips": grips, "link": link, "values": values,
        }))
    }
}

impl Grip {
    /// The nearest step to a value along an axis that the grip can reach.
    fn on_step(&self, axis: usize, value: f64) -> f64 {
        let (low, high) = (self.low[axis], self.high[axis]);
        let on_step = low + ((value - low) / self.step).round() * self.step;
        // Steps such as 0.1 leave a last bit behind.
        ((on_step * 1e6).round() / 1e6).clamp(low, high)
    }
}

impl Figure {
    fn text(&self, language: Language) -> &Text {
        match language {
            Language::En => &self.en,
            Language::Zh => &self.zh,
        }
    }

    pub fn grips(&self) -> &[Grip] {
        &self.grips
    }

    /// Draws the figure; the positions of the grips are brought into their ranges and onto their steps.
    fn draw(
        &self,
        given: &[Point],
        is_answered: bool,
        by: Option<&str>,
    ) -> Result<(Vec<Point>, LiveFigure), NoAnswer> {
        // A grip of which nothing is said stays where it begins.
        let mut at = Vec::new();
        for (i, grip) in self.grips.iter().enumerate() {
            let [x, y] = *given.get(i).unwrap_or(&grip.start);
            at.push([grip.on_step(0, x), grip.on_step(1, y)]);
        }
        if at.as_flattened().iter().any(|v| v.is_nan()) {
            return Err(format!("{}: a grip is nowhere", self.name).into());
        }
        // Whoever draws only lines leaves triangles to the scanline engine, and the other way round.
        let (mut fill, mut pen) = (Engine::Scanline, LineEngine::Dda);
        if let Some(name) = by {
            let entry = engines::find(name).copied().or_else(|| engines::find_planted(name));
            let entry = entry.ok_or_else(|| format!("nobody is called {name}"))?;
            (fill, pen) = (entry.engine.unwrap_or(fill), entry.line_engine.unwrap_or(pen));
        }
        // The names of `figures.json` and those here may differ while one is written.
        let given = FigureInput { grips: &self.grips, at: &at, is_answered, fill, pen };
        let draw = DRAWN_BY.iter().find(|(name, _)| *name == self.name);
        let (_, draw) = draw.ok_or_else(|| format!("nobody draws {}", self.name))?;
        let drawn = draw(&given)?;
        Ok((at, drawn))
    }

    /// What stands for the names in braces in the texts.
    fn words<'a>(&'a self, at: &[Point], drawn: &LiveFigure) -> Vec<(&'a str, String)> {
        let mut words = Vec::new();
        for (grip, at) in self.grips.iter().zip(at) {
            for (name, value) in grip.names.iter().zip(at) {
                if !name.is_empty() {
                    words.push((name.as_str(), number(*value, 6)));
                }
            }
        }
        words.extend(drawn.values.iter().cloned());
        words
    }

    /// The numbers that the prose of its page may repeat, each by its name, where the grips begin.
    pub fn numbers(&self) -> Result<Vec<(String, f64)>, NoAnswer> {
        let (at, drawn) = self.draw(&[], true, None)?;
        let mut numbers = Vec::new();
        for (name, text) in self.words(&at, &drawn) {
            // What is a word and no number is not repeated.
            if let Ok(value) = text.parse() {
                numbers.push((name.to_owned(), value));
            }
        }
        Ok(numbers)
    }

    /// The picture of the figure with its answer, as a file: what a page shows where no script runs.
    pub fn still(&self) -> Result<String, NoAnswer> {
        Ok(self.draw(&[], true, None)?.1.drawing.file())
    }

    /// What a page says in the place of the figure, with everything for those who read without scripts.
    pub fn block(&self, language: Language) -> Result<String, NoAnswer> {
        let (at, drawn) = self.draw(&[], true, None)?;
        let (text, words) = (self.text(language), self.words(&at, &drawn));
        let [alt, question, answer] =
            [&text.alt, &text.question, &text.answer].map(|part| fill(part, &words));
        // The pages in Chinese lie one folder deeper, and show the same pictures.
        let folder = if language == Language::En { "figures" } else { "../figures" };
        let name = &self.name;
        Ok(format!(
            "<rp-figure scene=\"{name}\">\n\n![{alt}]({folder}/live/{name}.svg)\n\n**{question}** {answer}\n\n</rp-figure>"
        ))
    }
}

/// The names of all figures, with their titles, for the playground to choose from.
pub(crate) fn list() -> Vec<Value> {
    let entry = |f: &Figure| json!({ "name": f.name, "about": f.en.title, "zh": f.zh.title });
    ALL.iter().map(entry).collect()
}

/// The figure of this name; a page may have been written for another version.
pub fn find(name: &str) -> Result<&'static Figure, NoAnswer> {
    let found = ALL.iter().find(|figure| figure.name == name);
    Ok(found.ok_or_else(|| format!("no figure is called {name}"))?)
}

/// A text with values in the places of their names: `{n}`, or `{n:pixel:pixels}` where a word follows the number. A name
/// without a value stays, as do other braces.
fn fill(text: &str, values: &[(&str, String)]) -> String {
    let mut filled = String::new();
    for piece in text.split_inclusive('}') {
        match filled_place(piece, values) {
            Some(piece) => filled += &piece,
            None => filled += piece,
        }
    }
    filled
}

/// A piece of text that ends with a place for a value, with that value; nothing where it ends otherwise.
fn filled_place(piece: &str, values: &[(&str, String)]) -> Option<String> {
    let (before, place) = piece.strip_suffix('}')?.rsplit_once('{')?;
    let mut parts = place.split(':');
    let name = parts.next()?;
    let (_, value) = values.iter().find(|(of, _)| *of == name)?;
    // The word for one comes before that for many.
    let word = if value == "1" { parts.next() } else { parts.nth(1) };
    Some(match word {
        Some(word) => format!("{before}{value} {word}"),
        None => format!("{before}{value}"),
    })
}

/// A number with at most so many decimals.
fn number(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    if decimals == 0 {
        return text;
    }
    let text = text.trim_end_matches('0').trim_end_matches('.');
    // What rounds to 0 from below would keep its sign.
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// Triangles in pixels, snapped to the grid.
fn snapped(triangles: &[[Point; 3]]) -> Result<Vec<Corners>, NoAnswer> {
    triangles.iter().map(snapped_triangle).collect()
}

/// One of them.
fn snapped_triangle(corners: &[Point; 3]) -> Result<Corners, NoAnswer> {
    let [a, b, c] = corners.map(|[x, y]| SubpixelPoint::from_px(x, y));
    Ok([a?, b?, c?])
}

/// The pixels that are covered less often than they should be: the answer for each pixel of a panel, row by row.
fn lacking(panel: &Panel, hits: &Coverage, right: &Coverage) -> Vec<bool> {
    panel.pixels().map(|[x, y]| hits.get(x, y) < right.get(x, y)).collect()
}

/// How many of these hold.
fn count(each: &[bool]) -> usize {
    each.iter().filter(|holds| **holds).count()
}

/// The address of a scene of the playground with triangles of x, y and what else each corner has.
fn with_triangles<const N: usize>(
    scene: &str,
    triangles: &[[[f64; N]; 3]],
    more: &str,
) -> Option<String> {
    let list = in_address(triangles, |value| number(value, 6));
    Some(format!("#scene={scene}&t={list}{more}"))
}

/// The list of triangles in an address, with these words for each number.
fn in_address<const N: usize>(triangles: &[[[f64; N]; 3]], word: impl Fn(f64) -> String) -> String {
    let mut list = String::new();
    for corners in triangles {
        if !list.is_empty() {
            list.push(';');
        }
        // Commas between the numbers of a corner, a line between corners.
        list += &corners.map(|corner| corner.map(&word).join(",")).join("_");
    }
    list
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_follow_their_numbers() {
        let values = |n: &str| vec![("n", n.to_owned()), ("x", "2.5".to_owned())];
        let text = "At {n:pixel:pixels} of {x}, {lost}. .on{fill:{x}}.";
        assert_eq!(fill(text, &values("1")), "At 1 pixel of 2.5, {lost}. .on{fill:2.5}.");
        assert_eq!(fill(text, &values("0")), "At 0 pixels of 2.5, {lost}. .on{fill:2.5}.");
    }
}
