//! A tessellator as a judged program: it sends the triangles of polygons, which are judged by
//! [`rasterproof_verify::partition`].

use std::sync::{Mutex, PoisonError};

use super::Options;
use super::ask::{Answer, Asked, Question, Subject};
use super::declared::Declared;
use super::run::{Found, MOST_DEATHS, Row};
use super::verdict::Judgement;
use super::windings::Windings;
use rasterproof_verify::partition::{self, Family, Polygon, Refused, Triangle};

/// The options of partitions for a program that declares this.
fn options(options: &Options, declared: &Declared) -> partition::Options {
    let (seed, cases) = (options.seed, options.cases);
    let wanted = |family: &Family| options.families.iter().any(|name| name == family.name());
    let mut all =
        partition::Options::default().seed(seed).cases(cases).terms(declared.tessellation);
    (all.only, all.families) = (options.only, Family::ALL.into_iter().filter(wanted).collect());
    all
}

/// Judges whoever answers polygons. An answer that begins with `unsupported` leaves a polygon out.
///
/// # Errors
/// No polygon was judged; why, in words.
pub fn judge(program: &mut dyn Subject, given: &Options) -> Result<partition::Verdict, String> {
    let options = options(given, program.declared());
    if options.families.is_empty() && !given.families.is_empty() {
        return Err("no case was judged: these families hold no polygons".to_owned());
    }
    let asked = Mutex::new((program, 0, String::new()));
    let answer = |polygon: &Polygon| -> Option<Result<Vec<Triangle>, Refused>> {
        let mut asked = asked.lock().unwrap_or_else(PoisonError::into_inner);
        let (program, deaths, last) = &mut *asked;
        if *deaths == MOST_DEATHS {
            let why = format!(
                "given up after {MOST_DEATHS} times without an answer; the last time it {last}"
            );
            return Some(Err(Refused(why)));
        }
        let question = Question { width: 1, height: 1, of: Asked::Polygon(polygon.clone()) };
        match program.ask(&[question], 1).pop() {
            Some(Answer::Triangles(triangles)) => Some(Ok(triangles)),
            Some(Answer::Refused(why)) if why.starts_with("unsupported") => None,
            Some(Answer::Refused(why)) => Some(Err(Refused(why))),
            Some(Answer::Died(what)) => {
                *deaths += 1;
                *last = what.to_string();
                Some(Err(Refused(format!("it {what}"))))
            }
            _ => Some(Err(Refused("it does not answer".to_owned()))),
        }
    };
    partition::judge_partitions_of(&answer, &options).map_err(|nothing| nothing.to_string())
}

/// The report as a verdict with a property for each family, for what is written for machines.
#[must_use]
pub fn verdict(declared: &Declared, options: &Options, report: &partition::Verdict) -> Judgement {
    let row = |family: &partition::Polygons| Row {
        name: family.family.name(),
        cases: family.polygons,
        shapes: family.triangles,
        wrong_cases: family.wrong,
        refused: family.left_out,
        ..Row::default()
    };
    let rows = report.families.iter().map(row).collect();
    let found = Found { rows, answered: report.sum().polygons, ..Found::default() };
    let (windings, none) = (Windings::default(), Vec::new());
    let declared = declared.clone();
    let mut verdict = Judgement::new(declared, options, windings, None, found, none, Vec::new());
    // The families of cases have a text of their own.
    for property in verdict.properties.iter_mut().filter(|property| property.about.is_empty()) {
        "every polygon is covered exactly once".clone_into(&mut property.about);
    }
    verdict
}
