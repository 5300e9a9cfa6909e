//! The tests other than the differential table, in one binary.

mod commands;
mod exact;
mod exhaust;
mod house;
mod mutants;
mod protocol;
mod recorded;
mod snapshots;
