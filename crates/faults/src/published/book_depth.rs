//! Specimens: the depths that the book compares before it comes to z/w in chapter 8: w itself, with perspective
//! (part 2, chapter 6), and -1/w, linear (chapter 7).
//! Source: the book (yangzhenzhuozz/Renderer on GitHub) and its companion code; see `docs/sources.md`.
//!
//! Symptoms, of both and of z/w: the depth starts at the crossing and steps without regard to the samples, so a
//! nearly flat span throws it far out of the range of its corners, and what is drawn later vanishes behind
//! nothing; ties pass the test, and so does NaN. Chapter 6 besides needs the buffer cleared to a true distance,
//! and evaluates formula (8) for each pixel.

use glam::DVec2;

use super::book_final::BookFinal;
use super::{DrawResult, Fragments, Published, RealTriangle, Spans};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::Fragment;

/// The chapters that store a depth which is no z/w.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BookDepth {
    /// w, perspective-correct.
    Chapter6,
    /// -1/w, linear.
    Chapter7,
}

impl Published for BookDepth {
    fn cover(&self, triangle: &RealTriangle, bounds: PixelRect, emit: Spans<'_>) -> DrawResult {
        BookFinal { exercise: false }.cover(triangle, bounds, emit)
    }

    /// The fragments of the final triangle, the depth being the chapter's.
    fn fragments(
        &self,
        triangle: &RealTriangle,
        bounds: PixelRect,
        emit: Fragments<'_>,
    ) -> DrawResult {
        // z within [-1, 1] passes the clip and steps as z/w does; w travels as an attribute.
        let scale =
            triangle.iter().fold(1.0, |most: f64, v| most.max(self.depth_of(v.depth, v.w).abs()));
        let triangle = triangle.map_array(|v| {
            let depth = self.depth_of(v.depth, v.w);
            match self {
                Self::Chapter6 => {
                    super::RealVertex { depth: 0.0, varying: DVec2::splat(depth), ..v }
                }
                _ => super::RealVertex { depth: depth / scale, ..v },
            }
        });
        BookFinal { exercise: false }.fragments(&triangle, bounds, &mut |f| {
            let depth = if *self == Self::Chapter6 { f.varying.x } else { f.depth * scale };
            emit(Fragment { depth, ..f });
        })
    }

    fn depth_of(&self, _depth: f64, w: f64) -> f64 {
        match self {
            Self::Chapter6 => w,
            Self::Chapter7 => -1.0 / w,
        }
    }

    fn compares_w(&self) -> bool {
        *self == Self::Chapter6
    }
}
