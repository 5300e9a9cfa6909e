//! The course: eighteen steps from a pixel to the levels of a texture, each judged by cases of the families.
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
mod wrong_formulas;

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

use crate::spine;
use progress::Progress;

/// A step of the course: what there is to write, and by which cases it is judged.
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

impl Step {
    /// The page of its chapter, as the spine names it.
    fn chapter(&self) -> &str {
        self.page.trim_start_matches("docs/").trim_end_matches(".md")
    }
}

impl PartialEq for Step {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

/// The cases of some families, and what a program is asked about them.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Exercise {
    pub check: Check,
    /// The names of the families, as the judge lists them.
    pub families: Vec<String>,
    /// Words of the convention by which the answers are judged, where it is not the usual one.
    #[serde(default)]
    pub convention: String,
    /// Makes a case of the family one of the step; nothing where it has no use. What it has made,
    /// it leaves as it is.
    #[serde(deserialize_with = "prepare")]
    pub prepare: Prepare,
}

type Prepare = fn(Case) -> Option<Case>;

/// Reads the name of a function from the file of the steps, so that a name without a function is an error there.
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

/// Cases that lie in their window, since clipping is a step of its own.
fn inside(case: Case) -> Option<Case> {
    (!adapt_case::leaves_window(&case)).then_some(case)
}

fn anywhere(case: Case) -> Option<Case> {
    Some(case)
}

/// Lines from their first pixel to itself.
fn point(mut case: Case) -> Option<Case> {
    if let Shape::Lines(lines) = &mut case.shape {
        for line in lines {
            line.ends[1] = line.ends[0];
        }
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
        for vertex in list.iter_mut().flat_map(|t| &mut t.vertices) {
            vertex.depth = 0.0;
        }
    }
    inside(case)
}

/// Attributes left out: nothing but depth is at stake.
fn depth_alone(mut case: Case) -> Option<Case> {
    if let Shape::Triangles { list, .. } = &mut case.shape {
        for vertex in list.iter_mut().flat_map(|t| &mut t.vertices) {
            vertex.varying = DVec2::ZERO;
        }
    }
    inside(case)
}

/// Triangles that reach out of their window.
fn outside(case: Case) -> Option<Case> {
    adapt_case::leaves_window(&case).then_some(case)
}

/// The step of a name or a number.
pub fn find(word: &str) -> Option<&'static Step> {
    STEPS.iter().find(|step| step.name == word || number(step) == word)
}

/// The number of its chapter, with its place among the steps of that chapter where there are several: `5`, `2a.1`.
pub fn number(step: &Step) -> String {
    let chapter = spine::number(step.chapter()).unwrap_or_default();
    // A chapter of one step gives it its own number.
    let of_chapter: Vec<_> = STEPS.iter().filter(|other| other.page == step.page).collect();
    match of_chapter.iter().position(|other| *other == step) {
        Some(at) if of_chapter.len() > 1 => format!("{chapter}.{}", at + 1),
        _ => chapter.to_owned(),
    }
}

/// All steps, each as its number and name, for a message.
pub fn known() -> String {
    let named = STEPS.iter().map(|step| format!("{} {}", number(step), step.name));
    named.collect::<Vec<_>>().join(", ")
}

/// The steps as a table; those passed are marked where the progress is known.
pub fn listed(progress: Option<&Progress>) -> Report {
    let row = |step: &Step| {
        // A plus for what was passed, an arrow for the current step.
        let mark = match progress {
            Some(progress) if progress.has_passed(step) => "+",
            Some(progress) if progress.current() == step => ">",
            _ => "",
        };
        // Several exercises may ask cases of one family.
        let mut families = Vec::new();
        for exercise in &step.exercises {
            families.extend(exercise.families.iter().map(String::as_str));
        }
        families.sort_unstable();
        families.dedup();
        let page = format!("{} ({})", step.title, step.page);
        let (number, families) = (number(step), families.join(", "));
        Row::of(&[&mark, &number, &step.name, &page, &step.judged, &families])
    };
    let columns = "~state 1 | >~number 4 | ~step 14 | ~page 1 | what is judged | :families";
    let (next, marks) = match progress {
        Some(_) => ("check", " (+ passed, > current)"),
        None => ("start --language python mine", ""),
    };
    Report {
        about: format!(
            "Eighteen steps to a rasterizer of your own{marks}; next: rasterproof course {next}\n\
             Each is judged by requests that your program answers: L lines, T triangles, I values in them, D depths, N the \
             near plane, S four samples, Q formulas; see docs/protocol.md"
        ),
        tables: vec![Table::new("", columns, STEPS.iter().map(row).collect())],
        ..Report::default()
    }
}

/// The eighteen steps, in order, from `steps.toml`, which the tests read too.
pub static STEPS: LazyLock<Vec<Step>> = LazyLock::new(|| {
    #[derive(Deserialize)]
    struct Steps {
        step: Vec<Step>,
    }
    // A step whose families or functions do not exist is found by the tests, which read the same text.
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
                let numbers = 0..examine::cases_of(families[0], 60);
                let cases =
                    numbers.filter_map(|index| (exercise.prepare)(families[0].case(1, index)));
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
        let of = |word| find(word).map(|step| &*step.name);
        assert_eq!(
            (of("1"), of("2a.2"), of("2c")),
            (Some("pixel"), Some("bresenham"), Some("scanline"))
        );
        assert_eq!((of("5"), of("samples")), (Some("perspective"), Some("samples")));
        // A chapter of several steps, and what is no number.
        assert!(["2", "2a", "2b.4", "14", "0", ""].iter().all(|word| find(word).is_none()));
    }

    /// The steps come in the order of the chapters, and no two have one number.
    #[test]
    fn steps_follow_the_chapters() {
        let place = |step: &Step| {
            spine::CHAPTERS.iter().position(|(page, _)| *page == step.chapter()).unwrap()
        };
        assert!(STEPS.is_sorted_by_key(place));
        let numbers: Vec<_> = STEPS.iter().map(number).collect();
        let right = [
            "1", "2a.1", "2a.2", "2b.1", "2b.2", "2b.3", "2c", "3", "4", "5", "6", "7", "8", "9",
            "10", "11", "12", "13",
        ];
        assert_eq!(numbers, right);
    }
}
