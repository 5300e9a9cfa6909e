//! For people who learn and teach: the eighteen steps of the [`course`], the [`quiz`], whose answers the engines
//! compute, the examples of the chapters ([`by_hand`]), the published faults as [`specimens`], and why a pixel
//! is covered, which [`explain`] says step by step. What belongs to a chapter has its number, by the [`spine`].

pub mod by_hand;
pub mod case_view;
pub mod course;
pub mod explain;
pub mod quiz;
pub mod specimens;
pub mod spine;
