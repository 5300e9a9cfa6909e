//! What a program was asked, as the share of everything that a question can be.

use super::Options;
use super::adapt_case;
use super::check::Check;
use super::declared::Declared;
use super::run::Row;
use rasterproof_verify::cases::facts::{self, asked::DesignShare};

/// The pairs and the triples of facts that the designs asked of a program, one entry for each design. `declared` restricts
/// what can be asked. Nothing where a single case was judged.
#[must_use]
pub(super) fn asked(options: &Options, rows: &[Row], declared: &Declared) -> Vec<DesignShare> {
    if options.only.is_some() {
        return Vec::new();
    }
    let limits = adapt_case::limits(declared);
    let mut all = Vec::new();
    for family in adapt_case::families(&options.families) {
        let Some(topic) = family.design() else { continue };
        // Values are counted over all families.
        let is_of_values = topic.name == facts::values::TOPIC.name;
        let is_judged = |row: &Row| {
            row.name == family.name || (is_of_values && row.check == Some(Check::Values))
        };
        if rows.iter().any(|row| is_judged(row) && !row.stopped) {
            all.push(DesignShare::of(topic, options.seed, options.numbers(), &limits));
        }
    }
    all
}
