//! A device on a group of coverage: its wrong pixels and its time beside those of the choices.

use std::sync::Arc;

use super::cells::draw_of;
use super::engine::Gpu;
use super::look;
use crate::device::Error;
use crate::device::draw::{Draw, Painter};
use crate::device::kind::{Kind, PAGE_PX};
use crate::device::open::Opened;
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::{FreeCorners, Span};
use rasterproof_judge::ask::runs_of;
use rasterproof_precision::cost::{Choice, ExternalChoice};

/// Triangles that are drawn at once to be judged.
const AT_ONCE: usize = 1024;

/// A device beside the choices of a group, which are timed in turns.
pub struct OnLadder {
    gpu: Gpu,
    opened: Arc<Opened>,
}

impl OnLadder {
    /// Opens the device of this name, which stays open: to open it is no part of a time.
    pub fn new(engine: &str) -> Result<Self, Error> {
        let mut gpu = Gpu::named(engine)?;
        let opened = Arc::clone(gpu.ready()?.device());
        Ok(Self { gpu, opened })
    }
}

/// The pixels of a triangle and a few around.
fn window_around(corners: &FreeCorners, bounds: PixelRect) -> PixelRect {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for corner in corners.px() {
        for axis in 0..2 {
            low[axis] = low[axis].min(corner[axis]);
            high[axis] = high[axis].max(corner[axis]);
        }
    }
    // `as` saturates.
    let [x0, y0] = low.map(|px| (px.floor() as i32).saturating_sub(2));
    let [x1, y1] = high.map(|px| (px.ceil() as i32).saturating_add(2));
    PixelRect { x0, y0, x1, y1 }.intersect(&bounds)
}

/// The spans of a picture; pixels that were hit n times are in n of them.
fn spans_of(hits: &Coverage) -> Vec<Span> {
    let mut spans = Vec::new();
    let x0 = hits.bounds().x0;
    for (y_px, row) in hits.rows() {
        for (run, times) in runs_of(y_px, row) {
            let span = Span { y_px, x0_px: x0 + run.x0_px, x1_px: x0 + run.x1_px };
            spans.extend(std::iter::repeat_n(span, usize::from(times)));
        }
    }
    spans
}

impl ExternalChoice for OnLadder {
    fn choice(&self) -> Choice {
        let about = self.gpu.about();
        let bits = about.subpixel_bits;
        let text = format!(
            "{} {}: snaps to {bits} bits; cleared, drawn, waited for",
            about.driver, about.version
        );
        Choice::new(about.short(), text, &[])
    }

    fn spans(
        &mut self,
        triangles: &[FreeCorners],
        bounds: PixelRect,
    ) -> Result<Vec<Vec<Span>>, String> {
        let mut all = Vec::with_capacity(triangles.len());
        // A few cells at a time, so that pages of large windows do not fill the memory.
        for some in triangles.chunks(AT_ONCE) {
            let jobs: Vec<_> =
                some.iter().map(|c| (vec![c.px()], window_around(c, bounds))).collect();
            let drawn = look::coverages_px(&mut self.gpu, &jobs).map_err(|e| e.to_string())?;
            all.extend(drawn.iter().map(spans_of));
        }
        Ok(all)
    }

    fn pass(
        &mut self,
        triangles: &[FreeCorners],
        bounds: PixelRect,
    ) -> Result<Box<dyn FnMut()>, String> {
        let (width, height) = (bounds.width(), bounds.height());
        // What is timed is one page, cleared and drawn, without reading it back.
        if (bounds.x0, bounds.y0) != (0, 0) || width.max(height) > PAGE_PX {
            return Err(format!("a page has {PAGE_PX} x {PAGE_PX} px"));
        }
        let half = self.gpu.viewport_px() / 2.0;
        let draw = |corners: &FreeCorners| {
            let vertices = look::seen_from(&corners.px(), (0, 0), half)?;
            Ok(Draw { window: [width, height], ..draw_of(0, vertices, 2.0 * half) })
        };
        let said = |error: Error| error.to_string();
        let draws: Vec<Draw> =
            triangles.iter().map(draw).collect::<Result<_, _>>().map_err(said)?;
        let mut painter = Painter::new(&self.opened, None).map_err(said)?;
        let prepared = painter.prepare(Kind::Flat, &draws).map_err(said)?;
        painter.run_prepared(&prepared).map_err(said)?;
        // Better no board than the time of a device that draws nothing.
        Ok(Box::new(move || painter.run_prepared(&prepared).expect("what was drawn before")))
    }
}
