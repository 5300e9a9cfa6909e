//! What a program was asked, as the share of everything that a question can be.

use super::Options;
use super::adapt_case;
use super::check::Check;
use super::declared::Declared;
use super::run::Row;
use rasterproof_verify::cases::Family;
use rasterproof_verify::cases::facts::{self, asked::DesignShare};

/// The pairs and the triples of facts that the designs asked of a program, one entry for each design. `declared` restricts
/// what can be asked. Nothing where a single case was judged.
#[must_use]
pub(super) fn asked(options: &Options, rows: &[Row], declared: &Declared) -> Vec<DesignShare> {
    if options.only.is_some() {
        return Vec::new();
    }
    let limits = adapt_case::limits(declared);
    let mut families = adapt_case::families(&options.families);
    families.retain(|family| is_judged(family, rows));
    let numbers = |topic: &_| adapt_case::numbers(options, Some(topic));
    DesignShare::of_families(families, options.seed, numbers, &limits)
}

/// Whether the cases of a design were all judged: of a row that was given up, some were not.
fn is_judged(family: &Family, rows: &[Row]) -> bool {
    let Some(topic) = family.design() else { return false };
    // What is counted over all families has a row of its own.
    let checks: &[Check] = match topic.name {
        name if name == facts::values::TOPIC.name => &[Check::Values],
        name if name == facts::samples::TOPIC.name => &[Check::Samples],
        name if name == facts::sample_values::TOPIC.name => &[Check::SampleValues],
        name if name == facts::near::TOPIC.name => &[Check::Carried],
        _ => &[],
    };
    for row in rows {
        let is_of_family =
            row.name == family.name || row.check.is_some_and(|check| checks.contains(&check));
        if is_of_family && !row.stopped {
            return true;
        }
    }
    false
}
