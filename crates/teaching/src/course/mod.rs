//! The course: twelve steps from a pixel to four samples, each judged by cases of the families.
//!
//! [`STEPS`] has the cases of each step, the page that explains it, and three hints. [`examine`] sends the cases to a
//! program, [`misconceptions`] says what its answers have in common, [`sandbox`] limits how that program runs, and [`verdict`] says how
//! it did. [`progress`] is the file beside the student's code, and [`grade`] gives points by step.

pub mod examine;
pub mod grade;
pub mod misconceptions;
pub mod progress;
pub mod sandbox;
pub mod show;
pub mod verdict;

use std::sync::LazyLock;

use glam::DVec2;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer};

use rasterproof_judge::adapt_case;
use rasterproof_judge::check::Check;
use rasterproof_report::html::Report;
use rasterproof_report::table::{Row, Table};
use rasterproof_verify::cases::{Case, Shape};
use rasterproof_verify::comparison::line_has_tie;

use progress::Progress;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Step {
    pub name: String,
    pub title: String,
    /// The page that tells why, in the repository.
    pub page: String,
    pub judged: String,
    /// From a nudge to nearly the answer.
    pub hints: [String; 3],
    #[serde(rename = "exercise")]
    pub exercises: Vec<Exercise>,
}

impl PartialEq for Step {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Exercise {
    pub check: Check,
    pub families: Vec<String>,
    #[serde(default)]
    pub convention: String,
    /// Makes a case of the family one of the step; nothing where it has no use. What it has made,
    /// it leaves as it is.
    #[serde(deserialize_with = "prepare")]
    pub prepare: Prepare,
}

type Prepare = fn(Case) -> Option<Case>;

fn prepare<'de, D: Deserializer<'de>>(from: D) -> Result<Prepare, D::Error> {
    Ok(match String::deserialize(from)?.as_str() {
        "inside" => inside,
        "outside" => outside,
        "anywhere" => anywhere,
        "point" => point,
        "no_ties" => no_ties,
        "attributes_alone" => attributes_alone,
        "depth_alone" => depth_alone,
        name => return Err(D::Error::custom(format!("no function prepares cases as {name}"))),
    })
}

fn inside(case: Case) -> Option<Case> {
    (!adapt_case::leaves_window(&case)).then_some(case)
}

fn anywhere(case: Case) -> Option<Case> {
    Some(case)
}

/// Lines from their first pixel to itself.
fn point(mut case: Case) -> Option<Case> {
    if let Shape::Lines(lines) = &mut case.shape {
        lines.iter_mut().for_each(|line| line.ends[1] = line.ends[0]);
    }
    Some(case)
}

/// Lines inside the window that never pass halfway between two pixels.
fn no_ties(case: Case) -> Option<Case> {
    let Shape::Lines(lines) = &case.shape else { return None };
    if lines.iter().any(line_has_tie) { None } else { inside(case) }
}

/// Depth left out: nothing but the two attributes is at stake.
fn attributes_alone(mut case: Case) -> Option<Case> {
    if let Shape::Triangles { list, .. } = &mut case.shape {
        list.iter_mut().flat_map(|t| &mut t.vertices).for_each(|v| v.depth = 0.0);
    }
    inside(case)
}

/// Attributes left out: nothing but depth is at stake.
fn depth_alone(mut case: Case) -> Option<Case> {
    if let Shape::Triangles { list, .. } = &mut case.shape {
        list.iter_mut().flat_map(|t| &mut t.vertices).for_each(|v| v.varying = DVec2::ZERO);
    }
    inside(case)
}

/// Triangles that reach out of their window.
fn outside(case: Case) -> Option<Case> {
    adapt_case::leaves_window(&case).then_some(case)
}

/// The step of a name, or of a number from 1.
pub fn find(word: &str) -> Option<&'static Step> {
    let number = word.parse::<usize>().ok();
    let is_it = |(at, step): &(usize, &Step)| step.name == word || number == Some(at + 1);
    STEPS.iter().enumerate().find(is_it).map(|(_, step)| step)
}

pub fn number(step: &Step) -> usize {
    STEPS.iter().position(|other| other.name == step.name).map_or(0, |at| at + 1)
}

/// The steps as a table; those passed are marked where the progress is known.
pub fn listed(progress: Option<&Progress>) -> Report {
    let row = |step: &Step| {
        let mark = match progress {
            Some(progress) if progress.has_passed(step) => "+",
            Some(progress) if progress.current() == step => ">",
            _ => "",
        };
        let mut families: Vec<_> =
            step.exercises.iter().flat_map(|e| &e.families).map(String::as_str).collect();
        families.sort_unstable();
        families.dedup();
        let page = format!("{} ({})", step.title, step.page);
        let (number, families) = (number(step), families.join(", "));
        Row::of(&[&mark, &number, &step.name, &page, &step.judged, &families])
    };
    let columns = "~state 1 | >~number 2 | ~step 14 | ~page 1 | what is judged | :families";
    let (next, marks) = match progress {
        Some(_) => ("check", " (+ passed, > current)"),
        None => ("start --language python mine", ""),
    };
    Report {
        about: format!(
            "Twelve steps to a rasterizer of your own{marks}; next: rasterproof course {next}\n\
             Each is judged by requests that your program answers: L lines, T triangles, I values in them, D depths, N the \
             near plane, S four samples; see docs/protocol.md"
        ),
        tables: vec![Table::new("", columns, STEPS.iter().map(row).collect())],
        ..Report::default()
    }
}

/// The twelve steps, in order, from `steps.toml`, which the tests read too.
pub static STEPS: LazyLock<Vec<Step>> = LazyLock::new(|| {
    #[derive(Deserialize)]
    struct Steps {
        step: Vec<Step>,
    }
    let steps: Steps = toml::from_str(include_str!("steps.toml")).expect("the steps are whole");
    steps.step
});

#[cfg(test)]
mod tests {
    use super::*;

    /// Every step has cases, and what prepares them has nothing left to do the second time: what is
    /// shrunk stays a case of the step.
    #[test]
    fn every_exercise_has_cases() {
        for exercise in STEPS.iter().flat_map(|step| &step.exercises) {
            for name in &exercise.families {
                let families = adapt_case::families(std::slice::from_ref(name));
                assert_eq!(families.len(), 1, "{name}");
                let cases =
                    (0..60).filter_map(|index| (exercise.prepare)(families[0].case(1, index)));
                let cases: Vec<_> = cases.collect();
                assert!(cases.len() >= 10, "{name}: {}", cases.len());
                for case in cases {
                    assert_eq!((exercise.prepare)(case.clone()).as_ref(), Some(&case), "{name}");
                }
            }
        }
    }

    #[test]
    fn steps_are_found() {
        assert_eq!(find("1").map(|s| &*s.name), Some("pixel"));
        assert_eq!(find("samples").map(number), Some(12));
        assert!(find("0").is_none() && find("13").is_none() && find("").is_none());
    }
}
