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

use crate::answer::answer_value;
use drawing::{Drawing, Panel, Point};
use rasterproof_core::contract::Rasterize as _;
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::{PixelRect, SubpixelPoint};
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

enum Predict {
    /// Which of these pixels of a panel.
    Pixels(Panel, Vec<([i32; 2], bool)>),
    /// The right answer is the option with this index.
    Choice(usize),
    /// The right answer is a number, shown with so many decimals.
    Number(f64, usize),
}

struct LiveFigure {
    drawing: Drawing,
    predict: Predict,
    /// The computed numbers that replace the names in braces in the texts.
    values: Vec<(&'static str, String)>,
    /// Where a scene of the playground draws the same pixels, its address; elsewhere the playground shows the figure itself.
    link: Option<String>,
}

type Draw = fn(&FigureInput<'_>) -> Result<LiveFigure, String>;

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
    pub fn answer(&self) -> Result<Value, String> {
        let figure = find(&self.name)?;
        let text = figure.text(self.language);
        let (at, drawn) = figure.draw(&self.at, self.is_answered, self.by.as_deref())?;
        let words = figure.words(&at, &drawn);
        let fill = |text: &str| fill(text, &words);
        let predict = match &drawn.predict {
            Predict::Pixels(panel, pixels) => {
                let cell = |([x, y], _): &([i32; 2], bool)| {
                    let [left, top] = panel.place([*x, *y].map(f64::from));
                    json!([left, top, panel.unit, x, y])
                };
                json!({
                    "kind": "pixels", "cells": pixels.iter().map(cell).collect::<Vec<_>>(),
                    "right": pixels.iter().map(|(_, is_right)| is_right).collect::<Vec<_>>(),
                })
            }
            Predict::Choice(right) => {
                let options: Vec<_> = text.options.iter().map(|option| fill(option)).collect();
                json!({ "kind": "choice", "options": options, "right": right })
            }
            Predict::Number(value, decimals) => {
                json!({ "kind": "number", "decimals": decimals, "right": format!("{value:.decimals$}") })
            }
        };
        let grips = figure.grips.iter().zip(&text.grips).zip(&at).zip(&drawn.drawing.grips);
        let grips: Vec<_> = grips
            .map(|(((grip, name), value), (spot, scale))| {
                json!({
                    "name": name, "value": value, "spot": spot, "scale": scale,
                    "low": grip.low, "high": grip.high, "step": grip.step,
                })
            })
            .collect();
        let values: Map<_, _> =
            words.iter().map(|(name, text)| ((*name).to_owned(), json!(text))).collect();
        let link = drawn
            .link
            .unwrap_or_else(|| format!("#scene=figure&figure={}&at={}", figure.name, json!(at)));
        Ok(json!({
            "title": text.title, "question": fill(&text.question), "answer": fill(&text.answer),
            "alt": fill(&text.alt), "at": at, "svg": drawn.drawing.inline(self.is_dark), "predict": predict,
            "grips": grips, "link": link, "values": values,
        }))
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
        at: &[Point],
        is_answered: bool,
        by: Option<&str>,
    ) -> Result<(Vec<Point>, LiveFigure), String> {
        let place = |(i, grip): (usize, &Grip)| {
            let given = at.get(i).unwrap_or(&grip.start);
            let along = |axis: usize| {
                let (low, high) = (grip.low[axis], grip.high[axis]);
                let on_step = low + ((given[axis] - low) / grip.step).round() * grip.step;
                // Steps such as 0.1 leave a last bit behind.
                ((on_step * 1e6).round() / 1e6).clamp(low, high)
            };
            [along(0), along(1)]
        };
        let at: Vec<Point> = self.grips.iter().enumerate().map(place).collect();
        if at.as_flattened().iter().any(|v| v.is_nan()) {
            return Err(format!("{}: a grip is nowhere", self.name));
        }
        let (mut fill, mut pen) = (Engine::Scanline, LineEngine::Dda);
        if let Some(name) = by {
            let entry = engines::find(name).copied().or_else(|| engines::find_planted(name));
            let entry = entry.ok_or_else(|| format!("nobody is called {name}"))?;
            (fill, pen) = (entry.engine.unwrap_or(fill), entry.line_engine.unwrap_or(pen));
        }
        let given = FigureInput { grips: &self.grips, at: &at, is_answered, fill, pen };
        let draw = DRAWN_BY.iter().find(|(name, _)| *name == self.name);
        let (_, draw) = draw.ok_or_else(|| format!("nobody draws {}", self.name))?;
        let drawn = draw(&given)?;
        Ok((at, drawn))
    }

    /// What stands for the names in braces in the texts.
    fn words<'a>(&'a self, at: &[Point], drawn: &LiveFigure) -> Vec<(&'a str, String)> {
        let positions = self.grips.iter().zip(at).flat_map(|(grip, at)| grip.names.iter().zip(at));
        let positions = positions.map(|(name, value)| (name.as_str(), number(*value, 6)));
        positions.filter(|(name, _)| !name.is_empty()).chain(drawn.values.iter().cloned()).collect()
    }

    /// The numbers that the prose of its page may repeat, each by its name, where the grips begin.
    pub fn numbers(&self) -> Result<Vec<(String, f64)>, String> {
        let (at, drawn) = self.draw(&[], true, None)?;
        let words = self.words(&at, &drawn).into_iter();
        let number = |(name, text): (&str, String)| Some((name.to_owned(), text.parse().ok()?));
        Ok(words.filter_map(number).collect())
    }

    /// The picture of the figure with its answer, as a file.
    pub fn still(&self) -> Result<String, String> {
        Ok(self.draw(&[], true, None)?.1.drawing.file())
    }

    /// What a page says in the place of the figure, with everything for those who read without scripts.
    pub fn block(&self, language: Language) -> Result<String, String> {
        let (at, drawn) = self.draw(&[], true, None)?;
        let (text, words) = (self.text(language), self.words(&at, &drawn));
        let fill = |text: &str| fill(text, &words);
        let folder = if language == Language::En { "figures" } else { "../figures" };
        let name = &self.name;
        Ok(format!(
            "<rp-figure scene=\"{name}\">\n\n![{}]({folder}/live/{name}.svg)\n\n**{}** {}\n\n</rp-figure>",
            fill(&text.alt),
            fill(&text.question),
            fill(&text.answer),
        ))
    }
}

/// The names of all figures, with their titles, for the playground to choose from.
pub(crate) fn list() -> Vec<Value> {
    let entry = |f: &Figure| json!({ "name": f.name, "about": f.en.title, "zh": f.zh.title });
    ALL.iter().map(entry).collect()
}

pub fn find(name: &str) -> Result<&'static Figure, String> {
    let found = ALL.iter().find(|figure| figure.name == name);
    found.ok_or_else(|| format!("no figure is called {name}"))
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
fn snapped(triangles: &[[Point; 3]]) -> Result<Vec<Corners>, String> {
    let point = |[x, y]: Point| SubpixelPoint::from_px(x, y).map_err(|refusal| refusal.to_string());
    triangles.iter().map(|&[a, b, c]| Ok([point(a)?, point(b)?, point(c)?])).collect()
}

fn cover(engine: Engine, triangles: &[Corners], window: PixelRect) -> Coverage {
    let mut hits = Coverage::new(window, 0);
    for &corners in triangles {
        engine.cover(corners, window, |span| hits.hit(span.y_px, span.x0_px, span.x1_px));
    }
    hits
}

/// The address of a scene of the playground with triangles of x, y and what else each corner has.
fn with_triangles<const N: usize>(
    scene: &str,
    triangles: &[[[f64; N]; 3]],
    more: &str,
) -> Option<String> {
    let corner = |c: &[f64; N]| c.map(|value| number(value, 6)).join(",");
    let triangle = |t: &[[f64; N]; 3]| t.iter().map(corner).collect::<Vec<_>>().join("_");
    let all: Vec<_> = triangles.iter().map(triangle).collect();
    Some(format!("#scene={scene}&t={}{more}", all.join(";")))
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
