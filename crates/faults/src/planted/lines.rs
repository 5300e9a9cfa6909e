//! Line drawers with a planted fault each.

use rasterproof_core::contract::DrawLine;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::line::bresenham::Bresenham;
use rasterproof_core::triangle::{Fragment, PixelPoint, ScreenLine, Varying};

planted! {
    LineMutant {
        MissesEnd "line-misses-end": "the last pixel of a line is missing (the book's DrawLine)",
        DirectedTies "line-directed-ties": "a tie is decided by the drawing direction",
        DriftsInF32 "line-drifts-in-f32": "the height accumulates in f32",
        Truncates "line-truncates": "the height is truncated instead of rounded",
        WeightsFromClip "line-weights-from-clip":
            "attributes count from the clipped start of the line",
        DrawsBackwards "line-draws-backwards": "pixels come out from the second end to the first",
        SteepTiesFlipped "line-steep-ties-flipped": "in steep octants a tie goes the other way",
        FourConnected "line-four-connected": "a step along the minor axis is a pixel of its own",
        RestartsAtBorder "line-restarts-at-border":
            "the part inside the window is drawn as a line of its own",
    }
}

impl DrawLine for LineMutant {
    fn draw<V: Varying>(
        &self,
        line: &ScreenLine<V>,
        bounds: PixelRect,
        mut emit: impl FnMut(Fragment<V>),
    ) {
        self.stroke(line, bounds, &mut emit);
    }
}

/// How far a line that moves by `all` in all its steps has moved after some of them; what is added before the division
/// decides about halves.
fn moved(all: i64, step: i64, steps: i64, half: i64) -> i32 {
    (all.signum() * ((2 * all.abs() * step + half) / (2 * steps))) as i32
}

/// What is spoilt by most of the faults below.
fn bresenham<V: Varying>(
    line: &ScreenLine<V>,
    bounds: PixelRect,
    emit: &mut dyn FnMut(Fragment<V>),
) {
    Bresenham.draw(line, bounds, emit);
}

/// The fragments of the right line, for faults that change their order, their values or their number.
fn fragments_of<V: Varying>(line: &ScreenLine<V>, bounds: PixelRect) -> Vec<Fragment<V>> {
    let mut fragments = Vec::new();
    bresenham(line, bounds, &mut |f| fragments.push(f));
    fragments
}

impl LineMutant {
    /// The line with its fault, through `dyn`, so that Bresenham's loop is not compiled for each of the faults.
    pub fn stroke<V: Varying>(
        &self,
        line: &ScreenLine<V>,
        bounds: PixelRect,
        emit: &mut dyn FnMut(Fragment<V>),
    ) {
        let [a, b] = &line.ends;
        match self {
            Self::MissesEnd => bresenham(line, bounds, &mut |f| {
                if (f.x_px, f.y_px) != (b.pixel.x, b.pixel.y) {
                    emit(f);
                }
            }),
            Self::DrawsBackwards => {
                for f in fragments_of(line, bounds).into_iter().rev() {
                    emit(f);
                }
            }
            Self::WeightsFromClip => {
                let fragments = fragments_of(line, bounds);
                let last = fragments.len().saturating_sub(1).max(1) as f64;
                for (i, f) in fragments.into_iter().enumerate() {
                    // Counted from the first visible pixel, not from the end of the line.
                    let t = i as f64 / last;
                    let varying = a.varying + (b.varying - a.varying) * t;
                    emit(Fragment { depth: a.depth + (b.depth - a.depth) * t, varying, ..f });
                }
            }
            Self::FourConnected => {
                let mut last: Option<Fragment<V>> = None;
                bresenham(line, bounds, &mut |f| {
                    if let Some(last) = last.replace(f)
                        && last.x_px != f.x_px
                        && last.y_px != f.y_px
                    {
                        emit(Fragment { y_px: last.y_px, ..f });
                    }
                    emit(f);
                });
            }
            Self::RestartsAtBorder => {
                let inside = fragments_of(line, bounds);
                let mut visible = *line;
                if let [first, .., last] = &inside[..] {
                    for (end, f) in visible.ends.iter_mut().zip([first, last]) {
                        end.pixel = PixelPoint::new(f.x_px, f.y_px);
                    }
                }
                bresenham(&visible, bounds, emit);
            }
            Self::DirectedTies | Self::DriftsInF32 | Self::Truncates | Self::SteepTiesFlipped => {
                self.walk_all(line, bounds, emit);
            }
        }
    }

    /// Walks every step of a line of at most 2^16 pixels; longer ones are left to Bresenham, so
    /// that a mutant takes no longer than an engine.
    fn walk_all<V: Varying>(
        self,
        line: &ScreenLine<V>,
        bounds: PixelRect,
        emit: &mut dyn FnMut(Fragment<V>),
    ) {
        let [a, b] = &line.ends;
        let (dx, dy) = (
            i64::from(b.pixel.x) - i64::from(a.pixel.x),
            i64::from(b.pixel.y) - i64::from(a.pixel.y),
        );
        // One step for each pixel along the longer axis.
        let steps = dx.abs().max(dy.abs());
        if steps == 0 || steps > 1 << 16 {
            return bresenham(line, bounds, emit);
        }
        // What the book's line adds at each step, and where it is then.
        let (slope_x, slope_y) = (dx as f32 / steps as f32, dy as f32 / steps as f32);
        let (mut x, mut y) = (a.pixel.x as f32, a.pixel.y as f32);
        for i in 0..=steps {
            let (x_px, y_px) = match self {
                Self::DriftsInF32 => ((x + 0.5).floor() as i32, (y + 0.5).floor() as i32),
                Self::Truncates => {
                    (a.pixel.x + (dx * i / steps) as i32, a.pixel.y + (dy * i / steps) as i32)
                }
                Self::SteepTiesFlipped => {
                    // Half goes farther along, seen from the end with the smaller coordinate on
                    // the major axis; in steep octants, by mistake, seen from the other end.
                    let steep = dy.abs() > dx.abs();
                    let backwards = if steep { dy > 0 } else { dx < 0 };
                    let half = steps - i64::from(backwards);
                    (a.pixel.x + moved(dx, i, steps, half), a.pixel.y + moved(dy, i, steps, half))
                }
                _ => {
                    // Rounds half away from the first end, whichever end that is.
                    (a.pixel.x + moved(dx, i, steps, steps), a.pixel.y + moved(dy, i, steps, steps))
                }
            };
            (x, y) = (x + slope_x, y + slope_y);
            if bounds.contains(x_px, y_px) {
                let t = i as f64 / steps as f64;
                let varying = a.varying + (b.varying - a.varying) * t;
                emit(Fragment { x_px, y_px, depth: a.depth + (b.depth - a.depth) * t, varying });
            }
        }
    }
}
