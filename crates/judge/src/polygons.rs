//! A tessellator as a judged program: it sends the triangles of polygons, which are judged by
//! [`rasterproof_verify::partition`].

use std::sync::{Mutex, PoisonError};
use std::time::Instant;

use super::Options;
use super::ask::{Answer, Asked, Question, Subject};
use super::declared::Declared;
use super::run::{MOST_DEATHS, Row, RunFindings};
use super::timed::Timed;
use super::verdict::{self, Particulars, Verdict};
use rasterproof_verify::cases::facts::asked::DesignShare;
use rasterproof_verify::partition::{self, Family, Polygon, Refused, Triangle};

/// The options of partitions for a program that declares this.
fn options(options: &Options, declared: &Declared) -> partition::Options {
    let (seed, cases) = (options.seed, options.cases);
    let wanted = |family: &Family| options.families.iter().any(|name| name == family.name());
    let mut all =
        partition::Options::default().seed(seed).cases(cases).terms(declared.tessellation);
    (all.only, all.families) = (options.only, Family::ALL.into_iter().filter(wanted).collect());
    // The last tenth is for smaller polygons, and for the cause.
    all.time_limit = options.time_limit.map(|limit| limit - limit / 10);
    all
}

/// How many polygons there are by these options.
#[must_use]
pub fn of_polygons(report: &partition::Verdict) -> u64 {
    let (options, families) = (&report.options, report.families.len() as u64);
    let each = if options.only.is_some() { 1 } else { options.cases };
    each.saturating_mul(families)
}

/// Whether the time was up before all of them were judged.
#[must_use]
pub fn is_out_of_time(report: &partition::Verdict) -> bool {
    let sum = report.sum();
    report.options.time_limit.is_some() && sum.polygons + sum.left_out < of_polygons(report)
}

/// Judges whoever answers polygons. An answer that begins with `unsupported` leaves a polygon out.
///
/// # Errors
/// No polygon was judged; why, in words.
pub fn judge(program: &mut dyn Subject, given: &Options) -> Result<partition::Verdict, String> {
    // Families that hold no polygons leave nothing to judge.
    let options = options(given, program.declared());
    if options.families.is_empty() && !given.families.is_empty() {
        return Err("no case was judged: these families hold no polygons".to_owned());
    }
    let end = given.time_limit.map(|limit| Instant::now() + limit);
    program.end_at(end);
    // The program, how often it died, and what it did the last time. The judge of polygons asks from several threads.
    let asked = Mutex::new((Timed::new(program, end), 0, String::new()));
    let answer = |polygons: &[Polygon]| -> Vec<Option<Result<Vec<Triangle>, Refused>>> {
        let mut asked = asked.lock().unwrap_or_else(PoisonError::into_inner);
        let (program, deaths, last) = &mut *asked;
        let of = |polygon: &Polygon| Asked::Polygon(polygon.clone());
        let questions: Vec<_> =
            polygons.iter().map(|p| Question { width: 1, height: 1, of: of(p) }).collect();
        let left = MOST_DEATHS.saturating_sub(*deaths);
        let mut answers = if left > 0 { program.ask(&questions, left) } else { Vec::new() };
        // What no polygon does alone is said of the last one.
        if let (Some(what), Some(answer)) = (program.strays().pop(), answers.last_mut()) {
            *answer = Answer::Died(what);
        }
        // Polygons that were not asked for want of time have no answer; those that a program would not answer have a refusal.
        let asked = if program.is_late { answers.len() } else { polygons.len() };
        let mut answers = answers.into_iter();
        let made = polygons[..asked].iter().map(|_| match answers.next() {
            Some(Answer::Triangles(triangles)) => Some(Ok(triangles)),
            Some(Answer::Refused(why)) if why.starts_with("unsupported") => None,
            Some(Answer::Refused(why)) => Some(Err(Refused(why))),
            Some(Answer::Died(what)) => {
                *deaths += 1;
                *last = what.to_string();
                Some(Err(Refused(format!("it {what}"))))
            }
            None if *deaths >= MOST_DEATHS => Some(Err(Refused(format!(
                "given up after {MOST_DEATHS} times without an answer; the last time it {last}"
            )))),
            _ => Some(Err(Refused("it does not answer".to_owned()))),
        });
        made.collect()
    };
    let mut judged = partition::judge_partitions_of(&answer, &options);
    if let Ok(report) = &mut judged {
        report.more.option = given.terms.time_limit_option();
    }
    let (mut program, ..) = asked.into_inner().unwrap_or_else(PoisonError::into_inner);
    program.end_at(None);
    judged.map_err(|nothing| match given.time_limit.filter(|_| program.is_late) {
        Some(limit) => verdict::nothing_within(limit, given),
        None => nothing.to_string(),
    })
}

/// The family and the number of the first generated polygon that this request, written with the id 1, holds.
#[must_use]
pub fn polygon_that_asks(
    request: &str,
    given: &Options,
    declared: &Declared,
) -> Option<(&'static str, u64)> {
    let options = options(given, declared);
    // Without names, all families are meant.
    let families = match options.families.as_slice() {
        [] => Family::ALL.to_vec(),
        some => some.to_vec(),
    };
    for family in families {
        for index in options.numbers() {
            // Polygons are made again from the seed, until one asks the same.
            let polygon = family.polygon(options.seed, index, declared.tessellation.coordinates);
            let question = Question { width: 1, height: 1, of: Asked::Polygon(polygon) };
            if question.text(1) == request {
                return Some((family.name(), index));
            }
        }
    }
    None
}

/// What the polygons of the design ask.
#[must_use]
pub fn asked(report: &partition::Verdict) -> DesignShare {
    let options = &report.options;
    partition::design::asked(options.seed, options.numbers(), options.terms.coordinates)
}

/// The report as a verdict with a property for each family, for what is written for machines.
pub fn verdict(declared: &Declared, options: &Options, report: &partition::Verdict) -> Verdict {
    // The families of polygons become rows like those of cases.
    let row = |family: &partition::Polygons| Row {
        name: family.family.name(),
        cases: family.polygons,
        shapes: family.triangles,
        wrong_cases: family.wrong,
        refused: family.left_out,
        ..Row::default()
    };
    let rows = report.families.iter().map(row).collect();
    let sum = report.sum();
    let found = RunFindings {
        rows,
        answered: sum.polygons,
        cases: sum.polygons + sum.left_out,
        of_cases: of_polygons(report),
        out_of_time: is_out_of_time(report),
        ..RunFindings::default()
    };
    let (declared, left_out) = (declared.clone(), report.more);
    let more = Particulars { declared, found, left_out, ..Particulars::default() };
    let mut verdict = verdict::verdict(options, more, Vec::new(), Vec::new());
    // What the design asked is said only where all of it was judged.
    let is_whole = !is_out_of_time(report) && options.only.is_none();
    if is_whole && report.families.iter().any(|of| of.family == Family::Design) {
        verdict.more.asked = vec![asked(report)];
    }
    // The families of cases have a text of their own.
    for family in &report.families {
        let name = family.family.name();
        for property in verdict.more.properties.iter_mut().filter(|one| one.name == name) {
            "every polygon is triangulated as declared".clone_into(&mut property.about);
            if family.wrong > 0 {
                property.detail = family.describe(&format!(" of {} polygons", family.polygons));
            }
        }
    }
    verdict
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ask::{Breach, Misbehaviour};

    /// Answers no polygon rightly. It does not answer the fifth of a block, or each alone but not all of them.
    struct Bad {
        declared: Declared,
        asked: Vec<usize>,
        is_alone: bool,
    }

    impl Subject for Bad {
        fn declared(&self) -> &Declared {
            &self.declared
        }

        fn ask(&mut self, questions: &[Question], _: u64) -> Vec<Answer> {
            self.asked.push(questions.len());
            let mut answers = vec![Answer::Triangles(Vec::new()); questions.len()];
            if !self.is_alone {
                answers[4] = Answer::Died(Breach::Hangs.by("fifth"));
            }
            answers
        }

        fn strays(&mut self) -> Vec<Misbehaviour> {
            if self.is_alone { vec![Breach::Exits.by("together")] } else { Vec::new() }
        }
    }

    #[test]
    fn polygons_are_asked_in_blocks_until_three_have_no_answer() {
        for (is_alone, how) in [(false, "hangs: fifth"), (true, "exits early: together")] {
            let mut bad = Bad { declared: Declared::default(), asked: Vec::new(), is_alone };
            let given = Options::default().cases(128);
            let report = judge(&mut bad, &given).unwrap();
            // What fails and has an answer is asked a second time, before or after the next block begins.
            let is_block = |asked: &usize| [64, 63].contains(asked);
            assert_eq!(bad.asked.len(), 3);
            assert!(bad.asked[0] == 64 && bad.asked.iter().all(is_block), "{:?}", bad.asked);
            assert_eq!(report.sum().wrong, 128 * Family::ALL.len() as u64);
            let said = report.check().unwrap_err().to_string();
            assert!(said.contains(&format!("the last time it {how}")), "{said}");
        }
    }
}
