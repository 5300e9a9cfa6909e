//! When an effect may be left out: one file for each effect, with the condition, what is known of it
//! before drawing, and the reason to read.
//!
//! A condition sees the scene, the canvas and pieces; never an engine, never a pixel.

pub(super) mod alpha_test;
pub(super) mod anisotropy;
pub(super) mod attributes;
pub(super) mod blending;
pub(super) mod clear;
pub(super) mod clip;
pub(super) mod cull;
pub(super) mod depth;
pub(super) mod depth_buffer;
pub(super) mod fog;
pub(super) mod interpolation;
pub(super) mod layers;
pub(super) mod mip_maps;
pub(super) mod perspective;
pub(super) mod samples;
pub(super) mod second_buffer;
pub(super) mod shadows;
pub(super) mod specular;
pub(super) mod survey;
pub(super) mod wide_words;
