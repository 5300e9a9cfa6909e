//! The pipeline of the book around a rasterizer: [`pipeline`] has its stages, [`scene`] what is drawn, and
//! [`effects`] decides which effects a scene calls for and draws it without the others.
// What only whole frames on several threads call.
#![cfg_attr(not(feature = "parallel"), allow(dead_code))]

pub mod effects;
pub mod pipeline;
pub mod scene;
