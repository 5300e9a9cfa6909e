//! A diagnosis in plain words.

use super::bench::LEAST_SIDE_PX;
use super::diagnosis::{Confidence, Diagnosis};
use super::lines::{LineConvention, LineDiagnosis, LineRounding, Steps};
use super::outline::End;
use super::place::FACINGS;
use super::quantum::Quantum;
use super::rule::{TriangleConvention, Windings};
use super::shape::Shape;
use super::ties::{Compass, Count};

/// Subpixels as a decimal number of pixels.
fn px(sub: i32) -> String {
    format!("{}", f64::from(sub) / 256.0)
}

/// A place in a pixel, in words.
fn position(x: i32, y: i32) -> String {
    match (x, y) {
        (128, 128) => "at the pixel's centre".to_owned(),
        (0, 0) => "at the pixel's upper left corner".to_owned(),
        (256, 0) => "at the pixel's upper right corner".to_owned(),
        (0, 256) => "at the pixel's lower left corner".to_owned(),
        (256, 256) => "at the pixel's lower right corner".to_owned(),
        _ => format!("at ({}, {}) of the pixel", px(x), px(y)),
    }
}

/// What happens to a corner, or nothing.
fn quantum(quantum: Quantum) -> String {
    let grid = match quantum.step {
        1 => return String::new(),
        256 => "whole pixels".to_owned(),
        step => format!("1/{} px", 256 / step),
    };
    let how = quantum.rounding.name();
    format!("moves corners to {grid} ({how}), ")
}

/// What is drawn of a triangle once its corners are on their grid.
fn shape(shape: Shape) -> String {
    match shape {
        Shape::Point { x, y } => format!("samples {}", position(x, y)),
        Shape::Rows { left, right, y } => format!(
            "fills row by row at height {}, from the first column whose {} lies right of the left \
             crossing to the last whose {} lies left of the right one",
            px(y),
            px(left),
            px(right)
        ),
        Shape::Stepped { x, y } => format!(
            "fills row by row, samples {}, and moves the crossings in fixed-point steps (the first \
             cut to 1/64 px)",
            position(x, y)
        ),
        Shape::Reach { x: 128, y: 128, reach: 128, square: true } => {
            "draws every pixel that the triangle touches".to_owned()
        }
        Shape::Reach { x, y, reach, square } => format!(
            "samples {} and draws what lies within {} px of the triangle{}",
            position(x, y),
            px(reach),
            if square { ", in both axes at once" } else { "" }
        ),
        Shape::Share { x, y, percent } => {
            let area = if (x, y) == (128, 128) {
                String::new()
            } else {
                format!(" (of an area centred {})", position(x, y))
            };
            format!("draws a pixel if at least {percent} % of its area{area} is covered")
        }
        Shape::Samples { x, y, pattern, least } => {
            let how = pattern.name();
            let middle = if (x, y) == (128, 128) {
                String::new()
            } else {
                format!(", about a middle {}", position(x, y))
            };
            let many = match least {
                1 => "any",
                2 => "two",
                3 => "three",
                _ => "all",
            };
            format!("draws a pixel if {many} of its four samples ({how}{middle}) are covered")
        }
        Shape::Scan(scan) => scan.name().to_owned(),
        Shape::Outline(tie) => format!(
            "fills between whole pixels, and draws the three sides as lines; a line halfway \
             between two pixels goes {}",
            tie.name()
        ),
    }
}

/// Who owns what lies on an edge.
fn ties(convention: &TriangleConvention, compass: &Compass) -> String {
    let seen = compass.seen();
    if matches!(convention.shape, Shape::Stepped { .. } | Shape::Outline(_) | Shape::Scan(_)) {
        return String::new();
    }
    if let Shape::Share { .. } = convention.shape {
        return match compass.level {
            Count { of: 0, .. } => String::new(),
            count if !count.is_decided() => ", exactly that share in no fixed way".to_owned(),
            _ if convention.ties.level => ", exactly that share included".to_owned(),
            _ => ", exactly that share excluded".to_owned(),
        };
    }
    if !seen.contains(&true) {
        return String::new();
    }
    // Each direction with its share.
    if !compass.is_decided() {
        let list: Vec<_> = (0..8)
            .filter_map(|i| Some(format!("{} {:.0} %", FACINGS[i], compass.edges[i].percent()?)))
            .collect();
        return format!("; what lies on an edge is drawn in no fixed way ({})", list.join(", "));
    }
    // Neighbours that share an edge share no pixel by these.
    let is_of_points = matches!(convention.shape, Shape::Point { .. } | Shape::Rows { .. });
    match convention.ties.name(seen) {
        Some("inclusive") if !is_of_points => ", its border included".to_owned(),
        Some("strict") if !is_of_points => ", its border not included".to_owned(),
        Some("inclusive") => {
            " and draws everything on an edge: neighbours are drawn twice".to_owned()
        }
        Some("strict") => " and draws nothing on an edge: neighbours leave holes".to_owned(),
        Some(name) => format!(" and follows the {name} rule"),
        None => {
            let list: Vec<_> =
                (0..8).filter(|&i| convention.ties.edges[i]).map(|i| FACINGS[i]).collect();
            format!(" and draws what lies on an edge that faces {}", list.join(", "))
        }
    }
}

/// All parts of a convention in one sentence, after 'it'.
fn convention(of: &TriangleConvention, compass: &Compass) -> String {
    let (mirror, winding) = (of.mirror.name(), of.draws.name());
    let (quantum, ties) = (quantum(of.quantum), ties(of, compass));
    format!("{mirror}{winding}{quantum}{}{ties}", shape(of.shape))
}

impl TriangleConvention {
    /// What it does, after 'it'.
    #[must_use]
    pub fn words(&self) -> String {
        // Every facing counts as seen.
        let all = Compass { edges: [Count { drawn: 1, of: 1 }; 8], ..Compass::default() };
        convention(self, &all)
    }
}

impl LineConvention {
    /// What it does, after 'it'.
    #[must_use]
    pub fn words(&self) -> String {
        line_convention(self)
    }
}

impl Diagnosis {
    /// What it does, how sure that is, and what else was seen.
    pub fn sentence(&self) -> String {
        match (self.asked, self.asked == self.refused) {
            (0, _) => {
                return format!("Not asked: a window or range of {LEAST_SIDE_PX} px is needed.");
            }
            (asked, true) => return format!("Unexplained: it answered none of {asked} questions."),
            _ if self.convention.draws == Windings::Neither => {
                return "It draws nothing.".to_owned();
            }
            _ => {}
        }
        let words = convention(&self.convention, &self.compass);
        let exact = self.as_found.general.triangles;
        let share = exact.percent().map_or("none".to_owned(), |p| format!("{p:.1} %"));
        let mut text = match self.confidence {
            Confidence::Certain => format!("It {words}."),
            Confidence::Likely => format!("It {words}; that explains {share} of its triangles."),
            Confidence::Unexplained => {
                return format!(
                    "Unexplained. The nearest hypothesis explains {share} of its triangles: it {words}."
                );
            }
        };
        if self.rotated.drawn + self.reversed.drawn > 0 {
            text += " The order of the corners changes the answer.";
        }
        if self.flat.drawn > 0 {
            text += " Triangles without area leave pixels.";
        }
        if self.twice.drawn > 0 {
            text += " It hits pixels of one triangle twice.";
        }
        if let Some(other) = self.alternatives.first() {
            text += &format!(" It may as well be that it {}.", convention(other, &self.compass));
        }
        text
    }
}

/// The pixel of a step, the ends, and what lies between two steps.
fn line_convention(of: &LineConvention) -> String {
    let pixel = match of.rounding {
        LineRounding::Nearest(tie) => {
            format!("draws the nearest pixel of each step, a tie goes {}", tie.name())
        }
        LineRounding::Behind => {
            return "draws at each step the pixel that holds the minor coordinate of the step before, \
                    in 1/65536 px, seen from the end with the smaller major coordinate, which is not \
                    drawn"
                .to_owned();
        }
        LineRounding::Ahead => {
            return "cuts the minor coordinate down, half a step ahead where it grows, in 1/65536 px, \
                    seen from the end with the smaller major coordinate; both ends are drawn"
                .to_owned();
        }
        LineRounding::Down => "cuts the minor coordinate down".to_owned(),
        LineRounding::Up => "cuts the minor coordinate up".to_owned(),
        LineRounding::Toward(end) => format!("cuts the minor coordinate toward {}", end.name()),
        LineRounding::Away(end) => {
            format!("rounds the minor coordinate away from {}", end.name())
        }
    };
    let ends = of.ends.name();
    let between = |axis: &str, end: End| {
        let end = end.name();
        format!("; diagonal steps go along the {axis} axis first, seen from {end}: 4-connected")
    };
    let steps = match of.steps {
        Steps::Corners => String::new(),
        Steps::MajorFirst(end) => between("major", end),
        Steps::MinorFirst(end) => between("minor", end),
    };
    format!("{pixel}; {ends}{steps}")
}

impl LineDiagnosis {
    /// The same of a line drawer.
    pub fn sentence(&self) -> String {
        let words = line_convention(&self.convention);
        let share = self.as_found.percent().map_or("none".to_owned(), |p| format!("{p:.1} %"));
        let mut text = match self.confidence {
            Confidence::Certain => format!("It {words}."),
            Confidence::Likely => format!("It {words}; that explains {share} of its lines."),
            Confidence::Unexplained => format!(
                "Unexplained. The nearest hypothesis explains {share} of its lines: it {words}."
            ),
        };
        if self.both_ways.drawn < self.both_ways.of {
            let percent = self.both_ways.percent().unwrap_or(0.0);
            text += &format!(" {percent:.0} % of its lines are the same from either end.");
        }
        if self.twice.drawn > 0 {
            text += " It draws pixels of one line twice.";
        }
        if self.in_order.drawn < self.in_order.of {
            text += " Its pixels do not come in order from the first end.";
        }
        if let Some(other) = self.alternatives.first() {
            text += &format!(" It may as well be that it {}.", line_convention(other));
        }
        text
    }
}
