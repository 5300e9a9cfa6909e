//! Cases: by name, by number, hunted until somebody disagrees with the oracle, and shrunk.

use std::cell::RefCell;

use serde::Deserialize;
use serde_json::{Value, json};

use super::lines::Pen;
use super::picture::Picture;
use super::pixels::{Painter, truth};
use crate::no_answer::NoAnswer;
use rasterproof_faults::published::catalogue::{RECORDED, RECORDED_SIDE_PX};
use rasterproof_registry::engines::{ENTRIES, LineEngine, SPECIMENS, Specimen};
use rasterproof_verify::cases::named::{self, Input};
use rasterproof_verify::cases::shrink::shrink;
use rasterproof_verify::cases::{self, Family, unsnapped};

/// A name that the page offers, with what it is about.
fn entry(name: &str, about: &str) -> Value {
    json!({ "name": name, "about": about })
}

/// The entries of a list of families.
fn family_entries(families: &[Family]) -> Vec<Value> {
    families.iter().map(|family| entry(family.name, family.about)).collect()
}

/// Every name that the page offers.
pub(super) fn list() -> Value {
    let mut named = Vec::new();
    for case in named::named() {
        // What every engine refuses has no picture.
        if matches!(case.input, Input::Drawn { .. }) {
            named.push(entry(case.name, case.about));
        }
    }
    // What the book's code was run on natively, once.
    let recorded: Vec<_> = RECORDED.iter().map(|case| entry(case.name, case.specimen)).collect();
    // Some draw both, most of them one.
    let (mut triangles, mut lines) = (Vec::new(), Vec::new());
    for by in ENTRIES.iter().chain(&SPECIMENS) {
        let mut shown = entry(by.name, by.about);
        shown["specimen"] = json!(by.specimen.is_some());
        let covers = by.engine.is_some() || by.exact_engine.is_some();
        if covers || matches!(by.specimen, Some(Specimen::Triangle(_))) {
            triangles.push(shown.clone());
        }
        if by.line_engine.is_some() || matches!(by.specimen, Some(Specimen::Line(_))) {
            lines.push(shown);
        }
    }
    json!({
        "families": family_entries(cases::triangles::FAMILIES),
        "lineFamilies": family_entries(cases::lines::FAMILIES),
        "offFamilies": family_entries(unsnapped::FAMILIES),
        "named": named, "recorded": recorded, "triangles": triangles, "lines": lines,
    })
}

/// A named case, or a recorded input of the book's code.
pub(super) fn named(name: &str) -> Result<Value, NoAnswer> {
    if let Some(case) = RECORDED.iter().find(|case| case.name == name) {
        let mut triangles = Vec::new();
        for corners in case.corners_px() {
            triangles.push(corners.map(|[x, y]| json!({ "x": x, "y": y })));
        }
        let side = RECORDED_SIDE_PX;
        let picture =
            json!({ "window": [0, 0, side, side], "snap": false, "triangles": triangles });
        return Ok(json!({ "name": name, "about": case.specimen, "picture": picture }));
    }
    // All others are cases by name, of which those that are refused have no picture.
    let found = named::find(name).ok_or_else(|| format!("no case is called '{name}'"))?;
    match &found.input {
        Input::Drawn { case, .. } => Ok(json!({
            "name": found.name, "about": found.about, "picture": Picture::from(case),
        })),
        Input::Refused(_) => {
            Err(format!("{name} is refused by every engine: {}", found.about).into())
        }
    }
}

/// The case of a family with this seed and number.
pub(super) fn generated(name: &str, seed: u64, index: u64) -> Result<Value, NoAnswer> {
    let family = family(name)?;
    // The window is cut where it is larger than the page shows, as it is while searching.
    let picture = Picture::from(&family.case(seed, index));
    Ok(json!({ "name": name, "about": family.about, "picture": picture }))
}

/// The family of this name, of triangles, of lines, or off the lattice.
fn family(name: &str) -> Result<&'static Family, NoAnswer> {
    let family = cases::all_families().find(|family| family.name == name);
    Ok(family.ok_or_else(|| format!("no family is called '{name}'"))?)
}

/// Whether somebody's pixels of a case differ from the oracle's; what is refused does not differ.
fn is_caught(by: &str, picture: &Picture) -> bool {
    differs(by, picture).unwrap_or(false)
}

/// Whether they differ: of triangles in how often a pixel is hit, of lines in which pixels are set, and how often.
fn differs(by: &str, picture: &Picture) -> Result<bool, NoAnswer> {
    if picture.lines().is_empty() {
        let hits = Painter::find(by, picture.snap)?.coverage(picture)?;
        return Ok(hits != truth(picture)?.0);
    }
    let drawn = sorted_pixels(Pen::find(by)?, picture)?;
    Ok(drawn != sorted_pixels(Pen::Engine(LineEngine::Oracle), picture)?)
}

/// The pixels of all lines: the order in which they are set does not matter here.
fn sorted_pixels(pen: Pen, picture: &Picture) -> Result<Vec<[i32; 2]>, NoAnswer> {
    let mut pixels = pen.each(&picture.lines(), picture.window()?)?.concat();
    pixels.sort_unstable();
    Ok(pixels)
}

/// Asks for the first of `count` cases from number `from` on which somebody is caught.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Search {
    by: String,
    family: String,
    seed: u64,
    from: u64,
    count: u64,
}

impl Search {
    /// The number of the case in `found`, null where none was, and the number to go on from in `next`.
    pub fn answer(&self) -> Result<Value, NoAnswer> {
        let family = family(&self.family)?;
        // Who draws nothing of this family is refused at once, since nothing is found afterwards.
        let first = Picture::from(&family.case(self.seed, 0));
        if first.lines().is_empty() {
            Painter::find(&self.by, first.snap)?;
        } else {
            Pen::find(&self.by)?;
        }
        // The page asks again from `next` on, and stays answerable in between.
        let end = self.from.saturating_add(self.count.min(100_000));
        for index in self.from..end {
            let picture = Picture::from(&family.case(self.seed, index));
            // The first one is enough; the page shrinks it next.
            if is_caught(&self.by, &picture) {
                return Ok(json!({ "found": index, "next": index + 1, "picture": picture }));
            }
        }
        Ok(json!({ "found": null, "next": end }))
    }
}

/// Asks for the ever smaller cases on which somebody is still caught.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Shrink {
    by: String,
    picture: Picture,
}

impl Shrink {
    /// The picture of each case that still failed, the smallest last.
    pub fn answer(&self) -> Result<Value, NoAnswer> {
        if !is_caught(&self.by, &self.picture) {
            return Err(
                format!("{} draws this rightly, so there is nothing to shrink", self.by).into()
            );
        }
        // What is tried and still fails is what is taken, so the trials tell the way.
        let steps = RefCell::new(vec![json!(self.picture)]);
        shrink(self.picture.case()?, |smaller| {
            let picture = Picture::from(smaller);
            let fails = is_caught(&self.by, &picture);
            if fails {
                steps.borrow_mut().push(json!(picture));
            }
            fails
        });
        Ok(json!({ "steps": steps.into_inner() }))
    }
}
