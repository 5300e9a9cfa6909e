//! The tests other than the differential table, in one binary.

mod book;
mod commands;
mod convention;
mod cost;
mod cost_tables;
mod course;
mod exact;
mod exhaust;
mod figures;
mod house;
mod illustrations;
mod judge;
mod languages;
mod matrix;
mod models;
mod mutants;
mod page;
mod pages;
mod properties;
mod protocol;
mod recorded;
mod robustness;
mod scenes;
mod snapshots;
mod specimens;
