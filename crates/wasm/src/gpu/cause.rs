//! Why a browser covers other pixels than it may: the search for the cause lies here between two pictures.
//!
//! Nobody can wait here for a picture. The search says what to ask next; the page draws it, and the search goes on with the pixels.

use std::cell::RefCell;

use super::judge::{Judge, Pixels};
use super::subjects::triangle;
use super::{Batch, Device, Layout, Topic};
use crate::no_answer::NoAnswer;
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::SUBPIXELS;
use rasterproof_verify::ask::Step;
use rasterproof_verify::comparison::{self, CauseSearch, Convention};
use rasterproof_verify::convention::{Declarations, TriangleQuestion};
use serde_json::{Value, json};

/// Cells of the largest window that is asked for. Corners may lie [`REACH`] cells away.
const LAYOUT: Layout = Layout { side: 1024, cell: 32, margin: REACH, scissor: true };
const REACH: i32 = 3;

/// A search that waits for a picture.
struct WaitingSearch {
    search: CauseSearch,
    /// What it asks at once, which may need more than one picture, and the answers so far.
    questions: Vec<TriangleQuestion>,
    answers: Vec<Option<Coverage>>,
    /// How many questions were answered in all.
    answered: usize,
}

thread_local! {
    static WAITING: RefCell<Option<WaitingSearch>> = const { RefCell::new(None) };
}

impl WaitingSearch {
    /// A search that knows of the device the finest grid it may have, and how far corners may lie from their window.
    fn new(device: Device) -> Self {
        let declared = Convention::default();
        let finest = SUBPIXELS / device.step();
        let known = Declarations {
            grid: [256, 64, 16].into_iter().find(|grid| *grid <= finest).unwrap_or(1),
            range_px: REACH * LAYOUT.cell,
            window_px: (LAYOUT.cell as u32, LAYOUT.cell as u32),
            ..Declarations::from(&declared)
        };
        let search = comparison::Cause::search(known, declared, None);
        Self { search, questions: Vec::new(), answers: Vec::new(), answered: 0 }
    }

    /// The questions of the next picture, one for each cell.
    fn of_picture(&self) -> &[TriangleQuestion] {
        let rest = &self.questions[self.answers.len()..];
        &rest[..rest.len().min(LAYOUT.room())]
    }

    /// Reads the answers off a picture.
    fn take(&mut self, device: Device, pixels: &str) -> Result<(), NoAnswer> {
        let read = Pixels::read(Topic::Coverage, device, LAYOUT, pixels)?;
        let mut answers = Vec::new();
        for (index, question) in self.of_picture().iter().enumerate() {
            // A window may be smaller than its cell.
            let (cell, window) = (read.cell(index), question.window);
            let mut picture = Coverage::new(window, 0);
            for y in 0..window.y1 {
                picture.row_mut(y).copy_from_slice(&cell.row(y)[..window.x1 as usize]);
            }
            answers.push(Some(picture));
        }
        self.answered += answers.len();
        self.answers.extend(answers);
        Ok(())
    }

    /// Goes on until a picture is needed; the cause at the end.
    fn go_on(&mut self) -> Option<comparison::Cause> {
        while self.of_picture().is_empty() {
            self.search.answer(std::mem::take(&mut self.answers));
            match self.search.step() {
                Step::Asks(questions) => self.questions = questions,
                Step::Found(cause) => return Some(cause),
            }
        }
        None
    }
}

impl Judge {
    /// The next picture, or the cause where everything was answered. Without pixels a search begins; it goes on with the hits of the
    /// picture before, row by row, as digits from 0.
    pub fn cause(&self) -> Result<Value, NoAnswer> {
        let Self { batch: Batch { device, .. }, pixels, .. } = self;
        WAITING.with_borrow_mut(|waiting| {
            if pixels.is_empty() {
                *waiting = Some(WaitingSearch::new(*device));
            }
            let search = waiting.as_mut().ok_or("no search waits for a picture")?;
            if !pixels.is_empty() {
                search.take(*device, pixels)?;
            }
            if let Some(found) = search.go_on() {
                let asked = search.answered;
                *waiting = None;
                return Ok(json!({ "cause": found.headline(), "asked": asked }));
            }
            let drawn = search.of_picture().iter().map(|question| triangle(question.corners));
            Ok(device.picture(Topic::Coverage, LAYOUT, drawn))
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

    /// The question that begins a search.
    fn question(interface: &str, bits: u32) -> Value {
        let device = json!({ "interface": interface, "bits": bits, "samples_apart": true });
        let batch = json!({ "check": "coverage", "device": device, "seed": 1 });
        json!({ "ask": "gpu-cause", "batch": batch, "pixels": "", "tally": {} })
    }

    /// What is said of a device that moves corners before it draws them rightly, and in how many pictures.
    fn said(bits: u32, moves: &dyn Fn(Corners) -> Option<Corners>) -> (String, usize) {
        let mut question = question("webgpu", bits);
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
            let reply = answer(&question("webgl2", bits).to_string());
            assert!(reply.contains("vertices"), "{reply}");
        }
    }

    /// Neither what nobody waits for nor a picture of another size is taken, and a search that waits goes on afterwards.
    #[test]
    fn other_pictures_are_refused() {
        let ask = |pixels: &str| -> Value {
            let mut question = question("webgpu", 8);
            question["pixels"] = json!(pixels);
            serde_json::from_str(&answer(&question.to_string())).unwrap()
        };
        let whole = "0".repeat(1024 * 1024);
        assert_eq!(ask(&whole)["error"], "no search waits for a picture");
        let first = ask("");
        assert_eq!(ask("00")["error"], "2 bytes of pixels for 1024 x 1024 px");
        let second = ask(&whole);
        assert!(second["subjects"].is_number() && second["vertices"] != first["vertices"]);
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
