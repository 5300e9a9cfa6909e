//! For people who learn and teach: the twelve steps of the [`course`], the [`quiz`], whose answers the engines
//! compute, and the published faults as [`specimens`].

pub mod course;
pub mod quiz;
pub mod specimens;
