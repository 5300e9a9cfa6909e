//! Values: what engines interpolate, which triangle is in front, and how space runs along a line.

use glam::DVec2;
use serde::Deserialize;
use serde_json::{Value, json};

use super::picture::{Picture, flat, panels};
use super::pixels::Painter;
use crate::no_answer::NoAnswer;
use rasterproof_core::contract::{DrawLine as _, Interpolate as _};
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::{Fragment, LineEnd, MAX_W, MIN_W, PixelPoint, ScreenLine};
use rasterproof_registry::engines::{Engine, LineEngine};
use rasterproof_render::pipeline::depth::DepthFormat;

/// Emits the values of a picture by one engine: depth, u, v of each fragment, with the number of its triangle, in the order of
/// the picture. Values need a place on the lattice, or real numbers; the exact forms have coverage alone.
fn fragments(
    name: &str,
    picture: &Picture,
    emit: &mut dyn FnMut(usize, Fragment<DVec2>),
) -> Result<(), NoAnswer> {
    let window = picture.window()?;
    match Painter::find(name, true)? {
        Painter::Lattice(engine) => {
            for (i, triangle) in picture.on_lattice()?.iter().enumerate() {
                engine.fragments(triangle, window, |f| emit(i, f));
            }
        }
        Painter::Published(specimen) => {
            for (i, triangle) in picture.as_real()?.iter().enumerate() {
                specimen.fragments(triangle, window, &mut |f| emit(i, f))?;
            }
        }
        Painter::Free(_) | Painter::FreeStrict => {
            return Err(format!("{name} interpolates nothing").into());
        }
    }
    Ok(())
}

/// Asks for the values of a picture on the lattice.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Values {
    picture: Picture,
    by: Vec<String>,
}

impl Values {
    /// Panels with depth, u and v of each pixel, and their worst distances from the exact ones.
    pub fn answer(&self) -> Result<Value, NoAnswer> {
        // The oracle's quotients of big integers take longer than a frame; its neighbour is held to it.
        let truth = values(Engine::EdgeFunction.name(), &self.picture)?;
        let panels = panels(&self.by, |name| {
            let frame = values(name, &self.picture)?;
            Ok(json!({ "worst": worst(&frame, &truth), "values": flat(&frame) }))
        });
        Ok(json!({ "panels": panels, "outlines": self.picture.outlines()? }))
    }
}

/// Depth, u, v of the last fragment of each pixel.
fn values(name: &str, picture: &Picture) -> Result<Frame<Option<[f64; 3]>>, NoAnswer> {
    let mut frame = Frame::new(picture.window()?, None);
    fragments(name, picture, &mut |_, f| {
        frame.span_mut(f.y_px, f.x_px, f.x_px + 1)[0] = Some([f.depth, f.varying.x, f.varying.y]);
    })?;
    Ok(frame)
}

/// The largest differences of depth, u, v where both have a value.
fn worst(a: &Frame<Option<[f64; 3]>>, b: &Frame<Option<[f64; 3]>>) -> [f64; 3] {
    let mut worst = [0.0f64; 3];
    for (a, b) in flat(a).into_iter().zip(flat(b)) {
        let (Some(a), Some(b)) = (a, b) else { continue };
        for i in 0..3 {
            worst[i] = worst[i].max((a[i] - b[i]).abs());
        }
    }
    worst
}

/// Asks which triangle is seen in each pixel: by the depth buffer, and by the painter's order.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Front {
    picture: Picture,
    by: Vec<String>,
}

impl Front {
    /// Panels with a letter for each pixel, `a` for the first triangle, and a point where there is none.
    pub fn answer(&self) -> Result<Value, NoAnswer> {
        let panels = panels(&self.by, |name| seen(name, &self.picture));
        Ok(json!({ "panels": panels, "outlines": self.picture.outlines()? }))
    }
}

/// In each pixel the letter of the triangle that is nearest, and of the one that is drawn last.
fn seen(name: &str, picture: &Picture) -> Result<Value, NoAnswer> {
    let window = picture.window()?;
    let mut keys = Frame::new(window, u64::MAX);
    let (mut nearest, mut last) = (Frame::new(window, b'.'), Frame::new(window, b'.'));
    fragments(name, picture, &mut |i, f| {
        let at = (f.x_px - window.x0) as usize;
        let letter = b'a' + (i % 26) as u8;
        last.row_mut(f.y_px)[at] = letter;
        // At the same stored depth the first stays.
        let key = DepthFormat::Unorm24.key(f.depth);
        if key < keys.row(f.y_px)[at] {
            keys.row_mut(f.y_px)[at] = key;
            nearest.row_mut(f.y_px)[at] = letter;
        }
    })?;
    Ok(json!({ "nearest": letters(&nearest), "last": letters(&last) }))
}

/// The letters of all pixels, row by row.
fn letters(frame: &Frame<u8>) -> String {
    flat(frame).into_iter().map(char::from).collect()
}

/// Asks how far along an edge in space the pixels of its image lie: t against t'.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Along {
    w: [f64; 2],
    steps: u16,
}

impl Along {
    /// The pairs of t' on the screen and t in space, in the order of the pixels.
    pub fn answer(&self) -> Result<Value, NoAnswer> {
        Ok(json!({ "pairs": along(LineEngine::Dda, self.w, self.steps)? }))
    }
}

/// The shares of the way on the screen and in space, at each pixel of a line that carries (1/w, t/w).
pub(crate) fn along(pen: LineEngine, w: [f64; 2], steps: u16) -> Result<Vec<[f64; 2]>, NoAnswer> {
    if !w.iter().all(|w| (MIN_W..=MAX_W).contains(w)) || steps == 0 {
        return Err("w must be positive, and there must be a step".into());
    }
    let length = i32::from(steps);
    let [near, far] = w.map(|w| 1.0 / w);
    // Both are linear on the screen; their quotient t is linear in space.
    let [start, end] = [DVec2::new(near, 0.0), DVec2::new(far, far)];
    let line = ScreenLine {
        ends: [
            LineEnd { pixel: PixelPoint::new(0, 0), depth: 0.0, varying: start },
            LineEnd { pixel: PixelPoint::new(length, 0), depth: 1.0, varying: end },
        ],
    };
    let window = PixelRect { x0: 0, y0: 0, x1: length + 1, y1: 1 };
    // A pixel for each step, the two ends among them.
    let mut pairs = Vec::new();
    // The depth is linear on the screen, so it is t'.
    pen.draw(&line, window, |f| pairs.push([f.depth, f.varying.y / f.varying.x]));
    Ok(pairs)
}
