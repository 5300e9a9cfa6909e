//! What accuracy costs in time: [`ladder`] does the same job in several arithmetics, and [`cost`] counts what each
//! gets wrong and measures how long it takes.

pub mod cost;
pub mod ladder;
