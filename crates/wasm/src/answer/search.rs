//! Cases: by name, by number, hunted until somebody disagrees with the oracle, and shrunk.

use std::cell::RefCell;

use serde::Deserialize;
use serde_json::{Value, json};

use super::lines::Pen;
use super::picture::Picture;
use super::pixels::{Painter, missing_and_extra, truth};
use rasterproof_core::grid::PixelRect;
use rasterproof_faults::published::catalogue::{RECORDED, RECORDED_SIDE_PX};
use rasterproof_registry::engines::{ENTRIES, Entry, LineEngine, SPECIMENS, Specimen};
use rasterproof_verify::cases::named::{self, Input};
use rasterproof_verify::cases::shrink::shrink;
use rasterproof_verify::cases::{self, Family, unsnapped};

/// Every name that the page offers.
pub(super) fn list() -> Value {
    let entry = |name: &str, about: &str| json!({ "name": name, "about": about });
    let families = |lines: bool| -> Vec<Value> {
        let list = if lines { cases::lines::FAMILIES } else { cases::triangles::FAMILIES };
        list.iter().map(|family| entry(family.name, family.about)).collect()
    };
    let off: Vec<_> = unsnapped::FAMILIES.iter().map(|f| entry(f.name, f.about)).collect();
    let named: Vec<_> = named::named()
        .iter()
        .filter(|case| matches!(case.input, Input::Drawn { .. }))
        .map(|case| entry(case.name, case.about))
        .collect();
    let recorded: Vec<_> = RECORDED.iter().map(|case| entry(case.name, case.specimen)).collect();
    let painter =
        |e: &Entry| json!({ "name": e.name, "about": e.about, "specimen": e.specimen.is_some() });
    let all = || ENTRIES.iter().chain(&SPECIMENS);
    let triangles: Vec<_> = all()
        .filter(|e| {
            let covers = e.engine.is_some() || e.exact_engine.is_some();
            covers || matches!(e.specimen, Some(Specimen::Triangle(_)))
        })
        .map(painter)
        .collect();
    let lines: Vec<_> = all()
        .filter(|e| e.line_engine.is_some() || matches!(e.specimen, Some(Specimen::Line(_))))
        .map(painter)
        .collect();
    json!({
        "families": families(false), "lineFamilies": families(true), "offFamilies": off,
        "named": named, "recorded": recorded, "triangles": triangles, "lines": lines,
    })
}

/// A named case, or a recorded input of the book's code.
pub(super) fn named(name: &str) -> Result<Value, String> {
    if let Some(case) = RECORDED.iter().find(|case| case.name == name) {
        let corner = |[x, y]: [f64; 2]| json!({ "x": x, "y": y });
        let triangles: Vec<_> = case.corners_px().iter().map(|t| t.map(corner)).collect();
        let side = RECORDED_SIDE_PX;
        let picture =
            json!({ "window": [0, 0, side, side], "snap": false, "triangles": triangles });
        return Ok(json!({ "name": name, "about": case.specimen, "picture": picture }));
    }
    let found = named::find(name).ok_or_else(|| format!("no case is called '{name}'"))?;
    match &found.input {
        Input::Drawn { case, .. } => Ok(json!({
            "name": found.name, "about": found.about, "picture": Picture::from(case),
        })),
        Input::Refused(_) => Err(format!("{name} is refused by every engine: {}", found.about)),
    }
}

pub(super) fn generated(name: &str, seed: u64, index: u64) -> Result<Value, String> {
    let family = family(name)?;
    let picture = Picture::from(&family.case(seed, index));
    Ok(json!({ "name": name, "about": family.about, "picture": picture }))
}

fn family(name: &str) -> Result<&'static Family, String> {
    let family = cases::all_families().find(|family| family.name == name);
    family.ok_or_else(|| format!("no family is called '{name}'"))
}

/// Whether somebody's pixels of a case differ from the oracle's; what is refused does not differ.
fn is_caught(by: &str, picture: &Picture) -> bool {
    let wrong = || -> Result<bool, String> {
        let window = picture.window()?;
        let lines = picture.lines();
        if lines.is_empty() {
            let hits = Painter::find(by, picture.snap)?.coverage(picture)?;
            return Ok(missing_and_extra(&hits, &truth(picture)?.0) != (0, 0));
        }
        let pen = Pen::find(by)?;
        let sorted = |pen: Pen, window: PixelRect| -> Result<Vec<_>, String> {
            let drawn: Result<Vec<_>, _> = lines.iter().map(|l| pen.pixels(l, window)).collect();
            let mut pixels = drawn?.concat();
            pixels.sort_unstable();
            Ok(pixels)
        };
        Ok(sorted(pen, window)? != sorted(Pen::Engine(LineEngine::Oracle), window)?)
    };
    wrong().unwrap_or(false)
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
    pub fn answer(&self) -> Result<Value, String> {
        let family = family(&self.family)?;
        let picture = |index| Picture::from(&family.case(self.seed, index));
        if picture(0).lines().is_empty() {
            Painter::find(&self.by, picture(0).snap)?;
        } else {
            Pen::find(&self.by)?;
        }
        let end = self.from.saturating_add(self.count.min(100_000));
        for index in self.from..end {
            let picture = picture(index);
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
    pub fn answer(&self) -> Result<Value, String> {
        if !is_caught(&self.by, &self.picture) {
            return Err(format!("{} draws this rightly, so there is nothing to shrink", self.by));
        }
        // What is tried and still fails is what is taken, so the trials tell the way.
        let steps = RefCell::new(vec![json!(self.picture)]);
        let fails = |picture: Picture| {
            let fails = is_caught(&self.by, &picture);
            if fails {
                steps.borrow_mut().push(json!(picture));
            }
            fails
        };
        shrink(self.picture.case()?, |smaller| fails(Picture::from(smaller)));
        Ok(json!({ "steps": steps.into_inner() }))
    }
}
