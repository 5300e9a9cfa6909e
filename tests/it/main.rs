//! The tests other than the differential table, in one binary.
#![allow(
    clippy::disallowed_methods,
    reason = "tests and benches read and write files of their own"
)]

mod book;
mod by_hand;
mod commands;
mod convention;
mod cost;
mod course;
mod delivery;
mod diagrams;
mod digest;
mod exact;
mod exhaust;
mod figures;
mod firefox;
mod fixtures;
mod hostile_certificates;
mod hostile_files;
mod hostile_submissions;
mod illustrations;
mod judge;
mod judge_shown;
mod languages;
mod league;
mod live_figures;
mod matrix;
mod model_files;
mod model_formats;
mod models;
mod mutants;
mod not_judged;
mod outside_text;
mod own;
mod page;
mod page_commands;
mod pages;
mod partition;
mod plans;
mod playground;
mod playground_hands;
mod printed_code;
mod program;
mod proof;
mod properties;
mod protocol;
mod quiz;
mod recorded;
mod review;
mod robustness;
mod scenes;
mod site;
mod snapshots;
mod specimens;
mod steps;
mod study;
mod surface;
mod terms;
mod threads;
mod ties;
mod tiled;
mod tiles;
mod tolerances;
mod workspace;
mod your_gpu;
