//! Samples: telling the samples of a supersampled or multisampled pixel apart.
//!
//! Left out for a pixel that lies inside a triangle with all its samples, gets one colour from it,
//! and whose depths there do not overlap those of what is there: asked of each pixel while it is
//! drawn (`samples`). To ask costs something, so the plan first estimates how many pixels may stay
//! whole, and steps aside where they are too few.

use super::survey::of_frame;
use crate::each::Each as _;
use crate::effects::piece::{Prepared, touched};
use crate::effects::plan::{Canvas, Decision, PiecePlan, Samples};
use crate::effects::{Effect, Effects, Mode};
use crate::grid::{PixelRect, SubpixelPoint};
use crate::pipeline::ClipVertex;
use crate::pipeline::assemble::{Point, Viewport};
use crate::triangle::Corners;

/// Pieces that are drawn in one go, see [`Samples::OnDemand`]: to find out which of their pixels are
/// whole takes longer than it saves, as measured.
const POLICY: Samples = Samples::OnDemand { flat_px: 32, varying_columns: 64 };

/// Side of the squares in which pixels stay whole together.
const SQUARE_PX: i32 = 8;

/// Pixels that no small piece may touch, and how often small pieces may touch the others.
pub struct Estimate {
    canvas: Canvas,
    columns: usize,
    /// Squares that a small piece touches.
    busy: Vec<bool>,
    told_apart: u64,
}

impl Estimate {
    pub fn new(canvas: &Canvas) -> Self {
        let squares = |side: u32| side.div_ceil(SQUARE_PX as u32) as usize;
        let (columns, rows) = (squares(canvas.width), squares(canvas.height));
        Self { canvas: *canvas, columns, busy: vec![false; columns * rows], told_apart: 0 }
    }

    /// Takes a piece into account.
    pub fn see(&mut self, corners: &Corners, plan: PiecePlan) {
        self.see_box(touched(corners, self.canvas.antialias), plan);
    }

    fn see_box(&mut self, rect: PixelRect, plan: PiecePlan) {
        if !POLICY.tells_apart(rect, plan, self.canvas.antialias.planes()) {
            return;
        }
        let rect = rect.intersect(&self.canvas.size());
        self.told_apart += u64::from(rect.width()) * u64::from(rect.height());
        if rect.is_empty() {
            return;
        }
        let squares = |from: i32, to: i32| {
            (from / SQUARE_PX) as usize..((to + SQUARE_PX - 1) / SQUARE_PX) as usize
        };
        for row in squares(rect.y0, rect.y1) {
            let columns = squares(rect.x0, rect.x1);
            self.busy[row * self.columns..][columns].fill(true);
        }
    }

    /// Takes an item into account whose triangles are too many to be assembled twice: by the boxes
    /// of their corners, uncut.
    pub fn see_roughly(&mut self, item: &Prepared<'_>, plan: PiecePlan) {
        let viewport = Viewport::new(self.canvas.window());
        let place = |point: &Point| {
            let vertex = ClipVertex { position: point.position, varying: () };
            point.place().or_else(|| Some(viewport.place(&vertex).ok()?.position))
        };
        let corners: Vec<Option<SubpixelPoint>> = item.points.iter().map(place).collect();
        for [a, b, c] in &item.item.mesh.triangles {
            let [a, b, c] = [a, b, c].each(|corner| corners[corner.position as usize]);
            match (a, b, c) {
                (Some(a), Some(b), Some(c)) if item.item.cull.removes([a, b, c]) => {}
                (Some(a), Some(b), Some(c)) => self.see(&[a, b, c], plan),
                (None, None, None) => {}
                // Around the eye, and who knows where on the canvas.
                _ => self.see_box(self.canvas.size(), plan),
            }
        }
    }

    /// Whether enough pixels stay whole: each saves all its samples but one, and every pixel costs
    /// its state, once and each time a small piece asks for it.
    fn pays(&self) -> bool {
        let busy = self.busy.iter().filter(|busy| **busy).count() as u64;
        let square = u64::from(SQUARE_PX.unsigned_abs()).pow(2);
        let pixels = self.canvas.pixels();
        let whole = pixels.saturating_sub(busy * square);
        whole * (self.canvas.antialias.samples() - 1) >= pixels + self.told_apart
    }
}

/// How samples are treated where the estimate is this.
pub fn decide(canvas: &Canvas, effects: &Effects, estimate: Option<&Estimate>) -> Samples {
    let is_one = canvas.antialias.samples() == 1;
    match estimate {
        _ if effects.mode(Effect::Samples) == Mode::Never && !is_one => Samples::Middle,
        Some(estimate) if estimate.pays() => POLICY,
        _ => Samples::Each,
    }
}

/// Whether there is something to estimate. What is not cleared is seen through the samples.
pub fn may_be_on_demand(canvas: &Canvas, effects: &Effects) -> bool {
    canvas.antialias.samples() > 1
        && effects.mode(Effect::Samples) == Mode::Planned
        && effects.mode(Effect::Clear) != Mode::Never
        && effects.mode(Effect::DepthBuffer) != Mode::Never
}

pub fn explain(canvas: &Canvas, effects: &Effects, samples: Samples) -> Decision {
    let pixels = canvas.pixels();
    let (counts, reason) = match samples {
        _ if canvas.antialias.samples() == 1 => ([0, pixels, 0], "a pixel has one sample"),
        Samples::Each => ([pixels, 0, 0], "too few pixels would stay whole"),
        Samples::Middle => ([0, pixels, 0], ""),
        Samples::OnDemand { .. } => ([0, 0, pixels], "as soon as a pixel may hold two colours"),
    };
    of_frame(effects, Effect::Samples, counts, reason.to_owned())
}
