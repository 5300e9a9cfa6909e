//! Specimen: values interpolated on the screen as if there were no perspective, the textured square
//! of the book (part 2, chapter 5, section 5.3), drawn with the fill of chapter 3.
//! Source: the book (yangzhenzhuozz/Renderer on GitHub) and its companion code; see `docs/sources.md`.
//!
//! Symptom: w is not used at all; a tilted square's stripes break at its diagonal, by up to
//! (sqrt R - 1)/(sqrt R + 1) of the spread of the values, R being the ratio of the w.

/// Chapter 3's fill, on corners that were projected.
pub use super::book_triangle::BookChapter3 as BookAffine;
use super::scene::{Image, Setting, Version, chequered, floor, runs_out_below};

/// A chequered floor that recedes, or a triangle of one value.
pub fn draw(version: Version, setting: Setting) -> Image {
    match setting {
        Setting::Exposing => floor(&BookAffine, version, 4.0),
        Setting::Harmless => chequered(&BookAffine, version, &[runs_out_below()]),
    }
}
