//! Why a browser covers other pixels than it may: the questions that an engine of this process is asked, whose answers come later.
//!
//! Nobody can wait here for a picture. The search for a cause is therefore begun anew with each one: it finds the answers
//! that are known, notes the questions that are not, and ends. The page draws these and asks again, until the search comes to its end.

use std::cell::RefCell;
use std::collections::HashMap;

use super::subjects::triangle;
use super::{Device, Layout, Topic};
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::SUBPIXELS;
use rasterproof_verify::comparison::{self, Convention};
use rasterproof_verify::convention::{Ask, Declarations, TriangleQuestion};
use serde::Deserialize;
use serde_json::{Value, json};

/// Asks for the next picture, or the cause where everything was answered.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Cause {
    device: Device,
    /// The hits of the picture before, row by row, as digits from 0; none begins a search.
    pixels: Option<String>,
}

/// Cells of the largest window that is asked for. Corners may lie [`REACH`] cells away.
const LAYOUT: Layout = Layout { side: 1024, cell: 32, margin: REACH, scissor: true };
const REACH: i32 = 3;

#[derive(Default)]
struct GivenAnswers {
    answered: HashMap<TriangleQuestion, Coverage>,
    /// Questions of the last picture, one for each cell.
    waiting: Vec<TriangleQuestion>,
}

thread_local! {
    static ASKED: RefCell<GivenAnswers> = RefCell::default();
}

impl GivenAnswers {
    fn take(&mut self, pixels: &str) -> Result<(), String> {
        let side = LAYOUT.side as usize;
        let pixels = pixels.as_bytes();
        if pixels.len() != side * side {
            return Err(format!("{} pixels for {side} x {side} px", pixels.len()));
        }
        for (index, question) in std::mem::take(&mut self.waiting).into_iter().enumerate() {
            let [x0, y0] = LAYOUT.origin(index);
            let mut picture = Coverage::new(question.window, 0);
            for y in 0..question.window.y1 {
                for x in 0..question.window.x1 {
                    let hits = pixels[(y0 + y) as usize * side + (x0 + x) as usize];
                    (0..hits.wrapping_sub(b'0').min(9)).for_each(|_| picture.hit(y, x, x + 1));
                }
            }
            self.answered.insert(question, picture);
        }
        Ok(())
    }
}

impl Ask for GivenAnswers {
    fn ask(&mut self, questions: &[TriangleQuestion]) -> Vec<Option<Coverage>> {
        if self.is_abandoned() {
            return Vec::new();
        }
        let answers: Vec<_> = questions.iter().map(|q| self.answered.get(q).cloned()).collect();
        let open = questions.iter().zip(&answers).filter(|(_, answer)| answer.is_none());
        self.waiting.extend(open.map(|(question, _)| *question).take(LAYOUT.room()));
        answers
    }

    /// As many as a picture holds, since each picture begins the search anew.
    fn at_once(&self) -> usize {
        LAYOUT.room()
    }

    /// After the first questions without an answer the search goes astray.
    fn is_abandoned(&self) -> bool {
        !self.waiting.is_empty()
    }
}

impl Cause {
    pub fn answer(&self) -> Result<Value, String> {
        ASKED.with_borrow_mut(|asked| {
            match &self.pixels {
                Some(pixels) => asked.take(pixels)?,
                None => *asked = GivenAnswers::default(),
            }
            let declared = Convention::default();
            let finest = SUBPIXELS / self.device.step();
            let known = Declarations {
                grid: [256, 64, 16].into_iter().find(|grid| *grid <= finest).unwrap_or(1),
                range_px: REACH * LAYOUT.cell,
                window_px: (LAYOUT.cell as u32, LAYOUT.cell as u32),
                ..Declarations::from(&declared)
            };
            let found = comparison::Cause::by_asking(asked, &known, &declared, None);
            if asked.waiting.is_empty() {
                return Ok(json!({ "cause": found.headline(), "asked": asked.answered.len() }));
            }
            let drawn = asked.waiting.iter().map(|question| triangle(question.corners));
            Ok(self.device.picture(Topic::Coverage, LAYOUT, drawn))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::question::answer;
    use base64::Engine as _;
    use base64::engine::general_purpose::STANDARD;
    use rasterproof_core::contract::Rasterize as _;
    use rasterproof_core::geometry::twice_area;
    use rasterproof_core::grid::{PixelRect, SubpixelPoint};
    use rasterproof_core::triangle::Corners;
    use rasterproof_verify::oracle::Oracle;

    /// What is said of a device that moves corners before it draws them rightly, and in how many pictures.
    fn said(bits: u32, moves: &dyn Fn(Corners) -> Option<Corners>) -> (String, usize) {
        let device = json!({ "interface": "webgpu", "bits": bits, "samples_apart": true });
        let mut question = json!({ "ask": "gpu-cause", "device": device });
        for pictures in 0.. {
            let reply: Value = serde_json::from_str(&answer(&question.to_string())).unwrap();
            assert!(reply["error"].is_null(), "{reply}");
            if let Some(cause) = reply["cause"].as_str() {
                return (cause.to_owned(), pictures);
            }
            let bytes = STANDARD.decode(reply["vertices"].as_str().unwrap()).unwrap();
            let numbers: Vec<f64> = bytes
                .chunks_exact(4)
                .map(|b| f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]])))
                .collect();
            let corner = |v: &[f64]| {
                let px = |ndc: f64| (ndc + 1.0) * 512.0;
                SubpixelPoint::from_px(px(v[0]), px(-v[1])).unwrap()
            };
            let corners: Vec<_> = numbers.chunks_exact(6).map(corner).collect();
            let mut pixels = vec![b'0'; 1024 * 1024];
            for (draw, corners) in
                reply["draws"].as_array().unwrap().iter().zip(corners.chunks_exact(3))
            {
                let [_, x0, y0] = [0, 1, 2].map(|i| draw[i].as_i64().unwrap() as i32);
                let cell = PixelRect { x0, y0, x1: x0 + 32, y1: y0 + 32 };
                let Some(corners) = moves([corners[0], corners[1], corners[2]]) else { continue };
                Oracle.cover(corners, cell, |s| {
                    for x in s.x0_px..s.x1_px {
                        pixels[s.y_px as usize * 1024 + x as usize] += 1;
                    }
                });
            }
            question["pixels"] = json!(String::from_utf8(pixels).unwrap());
        }
        unreachable!("the search ends")
    }

    #[test]
    fn any_number_of_bits_is_taken() {
        for bits in [0, 9, u32::MAX] {
            let device = json!({ "interface": "webgl2", "bits": bits, "samples_apart": false });
            let reply = answer(&json!({ "ask": "gpu-cause", "device": device }).to_string());
            assert!(reply.contains("vertices"), "{reply}");
        }
    }

    #[test]
    #[ignore = "takes seconds; .ci/run runs it"]
    fn a_device_hears_its_cause() {
        let cause = |bits, moves: &dyn Fn(Corners) -> Option<Corners>, wanted: &str| {
            let (cause, pictures) = said(bits, moves);
            assert!(cause.contains(wanted) && pictures < 60, "{pictures} pictures: {cause}");
        };
        cause(4, &Some, "The pixels of small triangles within the window are as declared.");
        let to = |by: fn(SubpixelPoint) -> SubpixelPoint| move |c: Corners| Some(c.map(by));
        cause(
            4,
            &to(|p| SubpixelPoint::new(p.x + 16, p.y)),
            "It samples at (0.4375, 0.5) of the pixel",
        );
        let coarse = |v: i32| (v + 32).div_euclid(64) * 64;
        let coarse =
            move |c: Corners| Some(c.map(|p| SubpixelPoint::new(coarse(p.x), coarse(p.y))));
        cause(8, &coarse, "It moves corners to 1/4 px");
        let small = |c: Corners| (twice_area(&c).abs() > 65_536).then_some(c);
        cause(8, &small, "It does not draw triangles whose area is below about 0.5");
    }
}
