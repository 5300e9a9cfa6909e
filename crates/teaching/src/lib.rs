//! For people who learn and teach: the twelve steps of the [`course`], and the [`quiz`], whose answers the engines
//! compute.

pub mod course;
pub mod quiz;
