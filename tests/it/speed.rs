//! The page on speed: its tables and plots are those of the recorded runs of `benches/peers`, which writes them.

#[path = "../../benches/peers/src/pages.rs"]
mod pages;

use serde_json::Value;

use crate::pages::{Renewal, read};

/// `RASTERPROOF_RENEW=1 cargo test --test it speed_pages` writes the tables and the plots, as `benches/peers/run --pages` does.
#[test]
fn speed_pages_hold_what_was_measured() {
    let runs = pages::RUNS.map(|path| serde_json::from_str::<Value>(&read(path)).unwrap());
    let mut renewal = Renewal::default();
    for (path, text) in pages::renewed(runs.each_ref(), |path| read(path)) {
        renewal.is(path, &text);
    }
    renewal.check("speed_pages");
    // Another number is noticed.
    let mut other = runs.clone();
    other[0]["frames"][0]["other"] = 12345.into();
    let (path, text) = &pages::renewed(other.each_ref(), |path| read(path))[0];
    assert_ne!(*text, read(path));
}
