//! Groups whose choices compute a value at each covered pixel. Spans come from the exact scanline and are not timed. Errors are
//! taken at a sample of the pixels.

use super::entry::{Canvas, Entry};
use super::scene::Scene;
use super::{Choice, Part, Run};
use crate::ladder::interpolation::Values;
use crate::ladder::snap;
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::Rasterize as _;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::raster::scanline::Scanline;
use rasterproof_core::triangle::{Corners, Span};

pub(super) use crate::ladder::interpolation::CoveredTriangle;

/// Emits the values of a choice on a triangle.
pub(super) type Emit<'a, T> = &'a dyn Fn(&CoveredTriangle<T>, &mut dyn FnMut(i32, i32, f64));

/// The triangles of a scene on the lattice that cover anything; `make` gets the place of each, its corners and 1/w of each corner.
pub(super) fn dress<T>(
    scene: &Scene,
    make: impl Fn(usize, Corners, [f64; 3]) -> T,
) -> Vec<CoveredTriangle<T>> {
    let triangles = scene.triangles.iter().zip(&scene.w).enumerate();
    let dressed = triangles.filter_map(|(number, (corners, w))| {
        let corners = snap(corners)?;
        let mut spans = Vec::new();
        Scanline.cover(corners, scene.bounds, |span| spans.push(span));
        let inv_w = w.map_array(|w| f64::from((1.0 / w) as f32));
        Some(CoveredTriangle { number, triangle: make(number, corners, inv_w), spans })
    });
    dressed.collect()
}

/// The value that is right at a pixel.
pub(super) struct Sample<E> {
    triangle: usize,
    number: usize,
    pub exact: E,
}

/// Triangles that choices are given, and the pixels at which their values are judged.
pub struct Input<T, E> {
    drawn: Vec<CoveredTriangle<T>>,
    samples: Vec<Sample<E>>,
    canvas: Canvas<f32>,
}

impl<T, E> Input<T, E> {
    /// About `count` samples of all pixels, evenly spread in drawing order; none of triangles that are timed alone. `exact` makes of
    /// a triangle what is right at its pixels.
    pub(super) fn new<F: Fn(i32, i32) -> Option<E>>(
        drawn: Vec<CoveredTriangle<T>>,
        bounds: PixelRect,
        count: usize,
        exact: impl Fn(&T) -> Option<F>,
    ) -> Self {
        let mut input = Self { drawn, samples: Vec::new(), canvas: Canvas::new(bounds) };
        if count == 0 {
            return input;
        }
        // Odd, so that a stride does not keep step with rows of even length.
        let stride = (input.pixels() / count).max(1) | 1;
        let mut before = 0;
        for (triangle, CoveredTriangle { triangle: of, spans, .. }) in
            input.drawn.iter().enumerate()
        {
            let pixels = spans.iter().flat_map(|s| (s.x0_px..s.x1_px).map(move |x| (x, s.y_px)));
            // What is right in a triangle is set up at its first sample, since most triangles have none.
            let mut exact_at = None;
            for (number, (x_px, y_px)) in pixels.enumerate() {
                if (before + number).is_multiple_of(stride) {
                    let exact_at = exact_at.get_or_insert_with(|| exact(of));
                    let exact = exact_at.as_ref().and_then(|at| at(x_px, y_px));
                    let sample = |exact| Sample { triangle, number, exact };
                    input.samples.extend(exact.map(sample));
                }
            }
            before += spans.iter().map(Span::pixels).sum::<usize>();
        }
        input
    }

    fn pixels(&self) -> usize {
        self.drawn.iter().flat_map(|of_this| &of_this.spans).map(Span::pixels).sum()
    }

    /// With the numbers of triangles and pixels.
    pub(super) fn counted(self) -> (Self, [usize; 2]) {
        let counts = [self.drawn.len(), self.pixels()];
        (self, counts)
    }

    /// The pixels in which values are judged, and all.
    #[must_use]
    pub fn judged(&self) -> Part {
        Part { part: self.samples.len() as u64, of: self.pixels() as u64 }
    }

    /// Calls `see` with each sample, its triangle and its pixel, and the value that a choice has there.
    pub(super) fn at_samples<'a>(
        &'a self,
        choice: Emit<'_, T>,
        see: &mut dyn FnMut(&'a CoveredTriangle<T>, &'a E, [i32; 2], f64),
    ) {
        // Samples are in drawing order, as the pixels are that a choice emits, so that one walk through both is enough.
        let mut samples = self.samples.iter().peekable();
        for (triangle, of_this) in self.drawn.iter().enumerate() {
            if samples.peek().is_none_or(|sample| sample.triangle != triangle) {
                continue;
            }
            let mut number = 0;
            choice(of_this, &mut |x_px, y_px, value| {
                let is_here = |one: &&Sample<E>| (one.triangle, one.number) == (triangle, number);
                if let Some(sample) = samples.next_if(is_here) {
                    see(of_this, &sample.exact, [x_px, y_px], value);
                }
                number += 1;
            });
        }
    }
}

/// Two closures of each choice alone are compiled for it; all that counts is compiled once.
pub(super) fn entry<T: 'static, E: 'static>(
    choice: Choice,
    body: impl Values<T> + Copy + 'static,
    judge: impl Fn(&Input<T, E>, Emit<'_, T>) -> Run + 'static,
) -> Entry<Input<T, E>> {
    Entry::new(
        choice,
        move |input| Ok(judge(input, &|of, emit| body.values(&of.triangle, &of.spans, emit))),
        move |Input { drawn, canvas, .. }| {
            Ok(canvas.pass(move |target| body.paint(std::hint::black_box(drawn), target)))
        },
    )
}
