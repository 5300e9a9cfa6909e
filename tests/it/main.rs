//! The tests other than the differential table, in one binary.

mod book;
mod commands;
mod cost;
mod exact;
mod exhaust;
mod house;
mod languages;
mod matrix;
mod models;
mod mutants;
mod page;
mod properties;
mod protocol;
mod recorded;
mod robustness;
mod scenes;
mod snapshots;
mod specimens;
mod surface;
