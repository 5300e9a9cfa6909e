//! Values: what engines interpolate, which triangle is in front, and how space runs along a line.

use glam::DVec2;
use serde::Deserialize;
use serde_json::{Value, json};

use super::picture::Picture;
use super::pixels::Painter;
use rasterproof_core::contract::{DrawLine as _, Interpolate as _};
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::{Fragment, LineEnd, MAX_W, MIN_W, PixelPoint, ScreenLine};
use rasterproof_registry::engines::{Engine, LineEngine};
use rasterproof_render::pipeline::depth::DepthFormat;

/// The values of a picture by one engine: depth, u, v of each fragment, in the order of the picture.
fn fragments(
    name: &str,
    picture: &Picture,
    emit: &mut dyn FnMut(usize, Fragment<DVec2>),
) -> Result<(), String> {
    let window = picture.window()?;
    match Painter::find(name, true)? {
        Painter::Lattice(engine) => {
            for (i, triangle) in picture.on_lattice()?.iter().enumerate() {
                engine.fragments(triangle, window, |f| emit(i, f));
            }
        }
        Painter::Published(specimen) => {
            for (i, triangle) in picture.as_real()?.iter().enumerate() {
                specimen
                    .fragments(triangle, window, &mut |f| emit(i, f))
                    .map_err(|refused| refused.to_string())?;
            }
        }
        Painter::Free(_) | Painter::FreeStrict => {
            return Err(format!("{name} interpolates nothing"));
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
    pub fn answer(&self) -> Result<Value, String> {
        let window = self.picture.window()?;
        let frame = |name: &str| -> Result<Frame<Option<[f64; 3]>>, String> {
            let mut frame = Frame::new(window, None);
            fragments(name, &self.picture, &mut |_, f| {
                frame.row_mut(f.y_px)[(f.x_px - window.x0) as usize] =
                    Some([f.depth, f.varying.x, f.varying.y]);
            })?;
            Ok(frame)
        };
        // The oracle's quotients of big integers take longer than a frame; its neighbour is held to it.
        let truth = frame(Engine::EdgeFunction.name())?;
        let panel = |name: &String| match frame(name) {
            Ok(frame) => json!({
                "name": name, "worst": worst(&frame, &truth), "values": flat(&frame),
            }),
            Err(refused) => json!({ "name": name, "refused": refused }),
        };
        let panels: Vec<_> = self.by.iter().map(panel).collect();
        Ok(json!({ "panels": panels, "outlines": self.picture.outlines()? }))
    }
}

/// Depth, u, v of every pixel, row by row.
fn flat(frame: &Frame<Option<[f64; 3]>>) -> Vec<Option<[f64; 3]>> {
    frame.rows().flat_map(|(_, row)| row.iter().copied()).collect()
}

/// The largest differences of depth, u, v where both have a value.
fn worst(a: &Frame<Option<[f64; 3]>>, b: &Frame<Option<[f64; 3]>>) -> [f64; 3] {
    let mut worst = [0.0f64; 3];
    for ((_, a), (_, b)) in a.rows().zip(b.rows()) {
        for (a, b) in a.iter().zip(b) {
            let (Some(a), Some(b)) = (a, b) else { continue };
            for i in 0..3 {
                worst[i] = worst[i].max((a[i] - b[i]).abs());
            }
        }
    }
    worst
}

/// Asks which triangle is seen: by the depth buffer, and by the painter's order.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Front {
    picture: Picture,
    by: Vec<String>,
}

impl Front {
    pub fn answer(&self) -> Result<Value, String> {
        let window = self.picture.window()?;
        let format = DepthFormat::Unorm24;
        let panel = |name: &String| {
            let mut keys = Frame::new(window, u64::MAX);
            let (mut nearest, mut last) = (Frame::new(window, b'.'), Frame::new(window, b'.'));
            let drawn = fragments(name, &self.picture, &mut |i, f| {
                let at = (f.x_px - window.x0) as usize;
                let letter = b'a' + (i % 26) as u8;
                last.row_mut(f.y_px)[at] = letter;
                let key = format.key(f.depth);
                if key < keys.row(f.y_px)[at] {
                    keys.row_mut(f.y_px)[at] = key;
                    nearest.row_mut(f.y_px)[at] = letter;
                }
            });
            match drawn {
                Ok(()) => json!({
                    "name": name, "nearest": letters(&nearest), "last": letters(&last),
                }),
                Err(refused) => json!({ "name": name, "refused": refused }),
            }
        };
        let panels: Vec<_> = self.by.iter().map(panel).collect();
        Ok(json!({ "panels": panels, "outlines": self.picture.outlines()? }))
    }
}

fn letters(frame: &Frame<u8>) -> String {
    frame.rows().flat_map(|(_, row)| row.iter().map(|&letter| char::from(letter))).collect()
}

/// Asks how far along an edge in space the pixels of its image lie: t against t'.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Along {
    w: [f64; 2],
    steps: u16,
}

impl Along {
    pub fn answer(&self) -> Result<Value, String> {
        Ok(json!({ "pairs": along(LineEngine::Dda, self.w, self.steps)? }))
    }
}

/// The shares of the way on the screen and in space, at each pixel of a line that carries (1/w, t/w).
pub(crate) fn along(pen: LineEngine, w: [f64; 2], steps: u16) -> Result<Vec<[f64; 2]>, String> {
    if !w.iter().all(|w| (MIN_W..=MAX_W).contains(w)) || steps == 0 {
        return Err("w must be positive, and there must be a step".to_owned());
    }
    let length = i32::from(steps);
    let [near, far] = w.map(|w| 1.0 / w);
    let end = |x, inv_w, t: f64| LineEnd {
        pixel: PixelPoint::new(x, 0),
        depth: t,
        varying: DVec2::new(inv_w, t * inv_w),
    };
    let line = ScreenLine { ends: [end(0, near, 0.0), end(length, far, 1.0)] };
    let window = PixelRect { x0: 0, y0: 0, x1: length + 1, y1: 1 };
    let mut pairs = Vec::new();
    // The depth is linear on the screen, so it is t'.
    pen.draw(&line, window, |f| pairs.push([f.depth, f.varying.y / f.varying.x]));
    Ok(pairs)
}
