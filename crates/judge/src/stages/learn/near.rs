//! What the near plane leaves, as a clipper leaves it: polygons, and the numbers of their new corners each on its own.

use std::rc::Rc;

use super::learnable::{Learnable, LearnedCase};
use crate::declared::Declared;
use crate::stages::near::{Cut, Edge, NearCut};
use crate::stages::search::{Stage as _, both, said_of, singles};
use rasterproof_verify::cases::Case;
use rasterproof_verify::cases::facts::{Topic, near};
use rasterproof_verify::cases::near_plane::{ClipCorner, clip_corners};
use rasterproof_verify::learn::rows::{NONE, Quantities, Unit, value};
use rasterproof_verify::learn::trial::Work;

/// The polygons that the near plane leaves.
pub struct Polygons;

/// A polygon, or one number of a new corner of it.
pub struct PartOfPolygon<'a> {
    cut: Cut<'a>,
    new: Option<NewNumber>,
}

/// A number of a new corner.
struct NewNumber {
    /// The place of the corner in the right polygon.
    place: usize,
    /// The number of the edge that the corner divides.
    of_edge: usize,
    edge: Edge,
    /// Of x, y, z, w and the attribute.
    which: usize,
    /// The right polygon.
    polygon: Rc<[ClipCorner]>,
    /// The number that was answered.
    given: f64,
}

/// The corners of the triangle, in words.
const ORDINALS: [&str; 3] = ["first", "second", "third"];
/// The numbers of a corner, in words.
const NUMBERS: [&str; 5] = ["x", "y", "z", "w", "the attribute"];

impl Learnable for Polygons {
    type Part<'a> = PartOfPolygon<'a>;
    type Change = NearCut;
    const TOPIC: &'static Topic = &near::TOPIC;
    const PART: &'static str = "corner";

    fn of_question(case: &Case, out: &mut Quantities) {
        let Some(triangle) = case.triangles().first() else { return };
        // Each number of each corner, and what clippers compute of them.
        let corners = clip_corners(triangle);
        for (corner, ordinal) in corners.iter().zip(ORDINALS) {
            for (number, name) in corner.iter().zip(NUMBERS) {
                out.number(Unit::Value, value(*number), &[name, " of the ", ordinal, " corner"]);
            }
            for (name, of) in COMBINED {
                out.number(
                    Unit::Value,
                    value(of(*corner)),
                    &[name, " of the ", ordinal, " corner"],
                );
            }
        }
        // Then how many corners are cut off, and the range of what decides it.
        let behind = corners.map(|corner| corner[2] + corner[3] < 0.0);
        let count = behind.iter().filter(|is| **is).count() as i64;
        out.number(Unit::Count, count, &["the number of corners behind z = -w"]);
        let single: [Combined; 2] = [("z", |p| p[2]), ("w", |p| p[3])];
        for (name, of) in single.into_iter().chain(COMBINED) {
            let all = corners.map(of);
            // Of 0 / 0 there is no order.
            let is_ordered = !all.iter().any(|v| v.is_nan());
            let [a, b, c] = if is_ordered { all } else { [f64::NAN; 3] };
            out.number(Unit::Value, value(a.min(b).min(c)), &["the smallest ", name]);
            out.number(Unit::Value, value(a.max(b).max(c)), &["the largest ", name]);
        }
    }

    fn parts<'a>(asked: &'a LearnedCase, declared: &Declared) -> Vec<PartOfPolygon<'a>> {
        let Some(cut) = NearCut::parts(&asked.question, &asked.answer, declared, 0.0).pop() else {
            return Vec::new();
        };
        // Where the polygon has the right corners, each number of a new one is a part.
        let mut parts = Vec::new();
        let aligned = cut.aligned();
        if let Some(given) = &aligned {
            let polygon: Rc<[ClipCorner]> = NearCut::default().polygon(&cut, true).into();
            for new in cut.new_of_right() {
                for which in 0..5 {
                    let (place, of_edge, edge) = (new.place, new.number, new.edge.clone());
                    let (polygon, given) = (Rc::clone(&polygon), given[place][which]);
                    let new = Some(NewNumber { place, of_edge, edge, which, polygon, given });
                    parts.push(PartOfPolygon { cut: cut.clone(), new });
                }
            }
        }
        // Where all corners have their place, numbers alone are wrong.
        if aligned.is_none() || NearCut::default().explains(&cut) {
            parts.push(PartOfPolygon { cut, new: None });
        }
        parts
    }

    fn is_right(part: &PartOfPolygon<'_>) -> bool {
        match &part.new {
            None => NearCut::default().explains(&part.cut),
            Some(new) => {
                part.cut.is_number(new.which, new.given, new.polygon[new.place][new.which])
            }
        }
    }

    fn explains(change: &NearCut, part: &PartOfPolygon<'_>) -> bool {
        let Some(new) = &part.new else { return change.explains(&part.cut) };
        // The change must leave the same corners, so that the number has its place.
        let predicted = change.polygon(&part.cut, true);
        // Another polygon has no such corner.
        let is_aligned = predicted.len() == new.polygon.len()
            && predicted
                .iter()
                .zip(&*new.polygon)
                .all(|(p, right)| p == right || !part.cut.corners.contains(right));
        is_aligned && part.cut.is_number(new.which, new.given, predicted[new.place][new.which])
    }

    fn of_part(part: &PartOfPolygon<'_>, _: Option<&NearCut>, out: &mut Quantities) {
        // Which number is compared; of a whole polygon none is.
        let new = part.new.as_ref();
        out.flag(new.is_some(), &["it is a new corner"], "it is a whole polygon");
        let which = new.map_or(5, |new| new.which);
        for (k, name) in NUMBERS.iter().enumerate() {
            out.holds(which == k, name, [" is compared", " is not compared"]);
        }
        // The edge that the corner divides, and both of its ends.
        let of_edge = out.values.len();
        let edge = new.map(|new| &new.edge);
        let number = new.map_or(0, |new| new.of_edge as i64 + 1);
        out.number(Unit::Count, number, &["the number of the edge (from 1)"]);
        let is_forward = edge.is_some_and(|edge| edge.is_forward);
        out.flag(is_forward, &["the edge leaves"], "the edge comes back");
        let t = edge.map_or(0.0, |edge| edge.t);
        out.number(Unit::Value, value(t), &["the part of the edge that stays"]);
        for (whom, of) in [
            ("the end of the edge that stays", edge.map(|edge| edge.kept)),
            ("the end of the edge that is cut off", edge.map(|edge| edge.lost)),
        ] {
            let of = of.unwrap_or_default();
            for (k, name) in NUMBERS.iter().enumerate() {
                out.number(Unit::Value, value(of[k]), &[name, " of ", whom]);
            }
            let distance = of[2] + of[3];
            out.number(Unit::Value, value(distance), &["z + w of ", whom]);
        }
        if new.is_none() {
            // No test of the quantities of an edge holds.
            out.values[of_edge..].fill(NONE);
        }
    }

    fn changes(wrong: &[&PartOfPolygon<'_>], _: &[&PartOfPolygon<'_>], _: &Work) -> Vec<NearCut> {
        let cuts: Vec<&Cut<'_>> = wrong.iter().map(|part| &part.cut).collect();
        singles(&cuts)
    }

    fn both(a: &NearCut, b: &NearCut) -> Option<NearCut> {
        both(a, b)
    }

    fn says(change: &NearCut) -> String {
        said_of(change, "").does
    }
}

/// What is computed of a corner, with its name.
type Combined = (&'static str, fn(ClipCorner) -> f64);
/// What clippers compute of a corner on the way.
const COMBINED: [Combined; 4] = [
    ("z + w", |p| p[2] + p[3]),
    ("z / w", |p| p[2] / p[3]),
    ("x / w", |p| p[0] / p[3]),
    ("y / w", |p| p[1] / p[3]),
];
