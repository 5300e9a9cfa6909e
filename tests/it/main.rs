//! The tests other than the differential table, in one binary.

mod book;
mod commands;
mod house;
mod mutants;
mod protocol;
mod recorded;
mod snapshots;
mod specimens;
