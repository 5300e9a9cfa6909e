//! Samples: telling the samples of a supersampled or multisampled pixel apart.
//!
//! Left out for a pixel that lies inside a triangle with all its samples, gets one colour from it,
//! and whose depths there do not overlap those of what is there: asked of each pixel while it is
//! drawn (`samples`). To ask costs something, so the plan first estimates how many pixels may stay
//! whole, and steps aside where they are too few.

use super::account::of_frame;
use crate::effects::plan::{Canvas, Decision, PiecePlan, Samples};
use crate::effects::primitive::{Prepared, touched};
use crate::effects::{Effect, Effects, Mode};
use crate::pipeline::ClipVertex;
use crate::pipeline::assemble::{ClipPoint, Viewport};
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::{PixelRect, SUBPIXELS};
use rasterproof_core::triangle::Corners;

/// Pieces that are drawn in one go, see [`Samples::OnDemand`]: to find out which of their pixels are
/// whole takes longer than it saves, as measured.
const POLICY: Samples = Samples::OnDemand { flat_px: 32, varying_columns: 64 };

/// Side of the squares in which pixels stay whole together.
const SQUARE_PX: i32 = 8;

/// What samples on demand cost, in what a sample that is not drawn saves: about 0.8 ns, as measured
/// over 240 scenes at random (docs/effects.md). So much each pixel in the box of a small piece, and
/// as much each one of a square that such a piece touches.
const ASKED: u64 = 7;

/// So much the two ends of a row of a large piece, if its attributes vary: their samples are drawn
/// apart from the row.
const ROW_ENDS: u64 = 350;

/// So much each pixel at the border of a large flat piece, of which there are about as many as its box
/// has columns and rows. Slivers, hair and blades of grass consist of nothing else.
const BORDER: u64 = 12;

/// Of a scene of many triangles every fourth is looked at, for four.
const SEEN_FOR: u64 = 4;

/// What pieces would save and cost: how often small ones ask for pixels, and which; how much the
/// others draw.
pub struct Estimate {
    canvas: Canvas,
    columns: usize,
    /// Squares that a small piece touches.
    busy: Vec<bool>,
    /// Pixels in the boxes of small pieces, each as often as it is in one.
    asked: u64,
    /// Pixels of the other pieces, as far as they may stay whole.
    drawn: u64,
    /// Pixels at the borders of flat ones.
    borders: u64,
    /// Rows of those whose attributes vary.
    varying_rows: u64,
    /// For how many pieces each one stands that is looked at.
    weight: u64,
}

impl Estimate {
    pub fn new(canvas: &Canvas) -> Self {
        let squares = |side: u32| side.div_ceil(SQUARE_PX as u32) as usize;
        let (columns, rows) = (squares(canvas.width), squares(canvas.height));
        let busy = vec![false; columns * rows];
        Self {
            canvas: *canvas,
            columns,
            busy,
            asked: 0,
            drawn: 0,
            borders: 0,
            varying_rows: 0,
            weight: 1,
        }
    }

    /// Takes a piece into account.
    pub fn see(&mut self, corners: &Corners, plan: PiecePlan) {
        let rect = touched(corners, self.canvas.antialias);
        if plan.is_nothing() || self.see_box(rect, plan) {
            return;
        }
        let rect = rect.intersect(&self.canvas.size());
        // The window of a supersampled picture has `scale` subpixels more on each side of a pixel.
        let side = u64::from(SUBPIXELS.unsigned_abs() * self.canvas.antialias.scale());
        let twice = u64::try_from(twice_area(corners).unsigned_abs()).unwrap_or(u64::MAX);
        let (width, height) = (u64::from(rect.width()), u64::from(rect.height()));
        let area = (width * height).min(twice / (2 * side.pow(2)));
        if plan.is_one_colour() {
            self.borders += self.weight * (width + height);
            self.drawn += self.weight * area.saturating_sub(width + height);
        } else {
            self.drawn += self.weight * area;
            self.varying_rows += self.weight * height;
        }
    }

    /// Whether it is the box of a small piece.
    fn see_box(&mut self, rect: PixelRect, plan: PiecePlan) -> bool {
        if !POLICY.tells_apart(rect, plan, self.canvas.antialias.planes()) {
            return false;
        }
        let rect = rect.intersect(&self.canvas.size());
        if rect.is_empty() {
            return true;
        }
        self.asked += self.weight * u64::from(rect.width()) * u64::from(rect.height());
        let squares = |from: i32, to: i32| {
            (from / SQUARE_PX) as usize..((to + SQUARE_PX - 1) / SQUARE_PX) as usize
        };
        for row in squares(rect.y0, rect.y1) {
            let columns = squares(rect.x0, rect.x1);
            self.busy[row * self.columns..][columns].fill(true);
        }
        true
    }

    /// Takes an item into account whose triangles are too many to be assembled twice: by the boxes of the corners of some,
    /// uncut.
    pub fn see_roughly(&mut self, item: &Prepared<'_>, plan: PiecePlan) {
        let viewport = Viewport::new(self.canvas.window());
        let place = |number: u32| {
            let point: &ClipPoint = &item.points[number as usize];
            let vertex = ClipVertex { position: point.position, varying: () };
            point.place().or_else(|| Some(viewport.place(&vertex).ok()?.position))
        };
        self.weight = SEEN_FOR;
        for of in item.item.mesh.triangles.positions().iter().step_by(SEEN_FOR as usize) {
            if self.is_hopeless() {
                break;
            }
            match of.map(place) {
                [Some(a), Some(b), Some(c)] if item.item.cull.removes([a, b, c]) => {}
                [Some(a), Some(b), Some(c)] => self.see(&[a, b, c], plan),
                [None, None, None] => {}
                // Around the eye, and who knows where on the canvas.
                _ => {
                    self.see_box(self.canvas.size(), plan);
                }
            }
        }
        self.weight = 1;
    }

    /// Whether the small pieces so far cost four times what clearing and resolving may save: many more
    /// pieces are not looked at then.
    fn is_hopeless(&self) -> bool {
        ASKED * self.asked > 4 * self.canvas.pixels() * self.canvas.antialias.samples()
    }

    /// Whether it saves more than it costs: each pixel all samples but one, once when it is cleared
    /// and resolved, drawn or not, and again each time a large piece draws it.
    fn pays(&self) -> bool {
        let busy = self.busy.iter().filter(|busy| **busy).count() as u64;
        let busy = busy * u64::from(SQUARE_PX.unsigned_abs()).pow(2);
        // Where as many borders as pixels are drawn, hardly a pixel stays whole for what comes later.
        let pixels = self.canvas.pixels();
        let split = (self.borders + 2 * self.varying_rows).min(pixels);
        let saved = (pixels + self.drawn) * (self.canvas.antialias.samples() - 1);
        let saved =
            (u128::from(saved) * u128::from(pixels - split) / u128::from(pixels.max(1))) as u64;
        let borders = BORDER * self.borders + ROW_ENDS * self.varying_rows;
        // A quarter more than the costs: a scene at which the estimate is wrong loses more than one gains.
        4 * saved >= 5 * (ASKED * (self.asked + busy) + borders)
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

pub fn explain(canvas: &Canvas, effects: &Effects, samples: Samples, has_layers: bool) -> Decision {
    let pixels = canvas.pixels();
    let (counts, reason) = match samples {
        _ if canvas.antialias.samples() == 1 => ([0, pixels, 0], "a pixel has one sample"),
        Samples::Each if has_layers => ([pixels, 0, 0], "layers are kept for each sample"),
        Samples::Each => ([pixels, 0, 0], "too few pixels would stay whole"),
        Samples::Middle => ([0, pixels, 0], ""),
        Samples::OnDemand { .. } => ([0, 0, pixels], "as soon as a pixel may hold two colours"),
    };
    of_frame(effects, Effect::Samples, counts, reason.to_owned())
}
