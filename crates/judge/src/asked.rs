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
    let is_asked = |family: &&'static Family| {
        let Some(topic) = family.design() else { return false };
        // What is counted over all families has a row of its own.
        let check = match topic.name {
            name if name == facts::values::TOPIC.name => Some(Check::Values),
            name if name == facts::samples::TOPIC.name => Some(Check::Samples),
            name if name == facts::near::TOPIC.name => Some(Check::Carried),
            _ => None,
        };
        let is_judged =
            |row: &&Row| row.name == family.name || (check.is_some() && row.check == check);
        rows.iter().filter(is_judged).any(|row| !row.stopped)
    };
    let families = adapt_case::families(&options.families).into_iter().filter(is_asked);
    DesignShare::of_families(families, options.seed, &options.numbers(), &limits)
}
