//! The answers of specimens in the line protocol: positions are taken as they are, not snapped.
//!
//! A pixel that the published code sets twice appears in two runs. What it does not define, or would
//! not end, is answered `E id reason`.

use std::io::Write as _;

use glam::DVec2;
use rasterproof_host::limits::{self, REQUEST_FRAGMENTS, REQUEST_RUNS};

use crate::server::reply::{Reply, named, write_run, write_words};
use rasterproof_core::grid::{PixelRect, Refusal};
use rasterproof_core::triangle::{MAX_W, MIN_W, check_value};
use rasterproof_faults::published::{Published, PublishedLine, RealTriangle, RealVertex, bare};
use rasterproof_registry::engines::{Entry, Specimen};

/// The answer, unless it has more parts than are kept.
fn whole(letter: char, n: usize, runs: Vec<u8>) -> Reply {
    if n > limits::REQUEST_RUNS {
        return Err(format!(
            "{n} runs or pixels; a specimen answers with at most {REQUEST_RUNS}: ask for a smaller window"
        ));
    }
    Ok((letter, n, runs))
}

/// Answers a request of a kind that the specimen declares.
pub(crate) fn answer(entry: &Entry, verb: &str, window: PixelRect, numbers: &[f64]) -> Reply {
    match (entry.specimen, verb) {
        (Some(Specimen::Triangle(specimen)), "T") => cover(specimen, window, numbers),
        (Some(Specimen::Triangle(specimen)), "I") => values(specimen, window, numbers),
        (Some(Specimen::Line(specimen)), "L") => line(specimen, window, numbers),
        _ => Err("unsupported".to_owned()),
    }
}

/// Corner `i` of a request, as it is: a specimen takes every finite number.
fn point(numbers: &[f64], i: usize) -> Result<[f64; 2], String> {
    for (value, axis) in numbers.iter().zip(["x", "y"]) {
        let name = format!("{axis}{i}");
        if value.is_nan() {
            return Err(named(&name)(Refusal::NotANumber));
        } else if value.is_infinite() {
            return Err(named(&name)(Refusal::Infinite));
        }
    }
    Ok([numbers[0], numbers[1]])
}

/// T: the runs of a triangle, of which the first so many are kept.
fn cover(specimen: &dyn Published, window: PixelRect, numbers: &[f64]) -> Reply {
    let corners = [point(numbers, 0)?, point(&numbers[2..], 1)?, point(&numbers[4..], 2)?];
    let (mut runs, mut n) = (Vec::new(), 0);
    specimen
        .cover(&bare(corners), window, &mut |span| {
            n += 1;
            if n <= limits::REQUEST_RUNS {
                write_run(&mut runs, span);
            }
        })
        .map_err(|refused| refused.to_string())?;
    whole('C', n, runs)
}

/// L: the pixels of a line, of which the first so many are kept.
fn line(specimen: &dyn PublishedLine, window: PixelRect, numbers: &[f64]) -> Reply {
    let ends = [point(numbers, 0)?, point(&numbers[2..], 1)?];
    let (mut pixels, mut n) = (Vec::new(), 0);
    specimen
        .draw(ends, window, &mut |x_px, y_px| {
            n += 1;
            if n <= limits::REQUEST_RUNS {
                write_words(&mut pixels, [x_px, y_px]);
            }
        })
        .map_err(|refused| refused.to_string())?;
    whole('P', n, pixels)
}

/// I: the fragments of a triangle, which are counted before they are computed.
fn values(specimen: &dyn Published, window: PixelRect, numbers: &[f64]) -> Reply {
    let vertex = |i: usize| -> Result<RealVertex, String> {
        let [_, _, depth, w, a, b] = [0, 1, 2, 3, 4, 5].map(|k| numbers[6 * i + k]);
        for (name, value) in [("z", depth), ("a", a), ("b", b)] {
            check_value(value).map_err(named(&format!("{name}{i}")))?;
        }
        if !(MIN_W..=MAX_W).contains(&w) {
            return Err(named(&format!("w{i}"))(Refusal::OutOfRange {
                value: w,
                min: MIN_W,
                max: MAX_W,
            }));
        }
        let position_px = point(&numbers[6 * i..], i)?.into();
        Ok(RealVertex { position_px, depth, w, varying: DVec2::new(a, b) })
    };
    // The pixels are counted first, so that a request that has too many costs no memory.
    let triangle: RealTriangle = [vertex(0)?, vertex(1)?, vertex(2)?];
    // Overlapping runs count as often as they come.
    let mut pixels = 0;
    specimen
        .cover(&triangle, window, &mut |span| pixels += u64::from(span.x0_px.abs_diff(span.x1_px)))
        .map_err(|refused| refused.to_string())?;
    if pixels > limits::REQUEST_FRAGMENTS {
        return Err(format!(
            "{pixels} fragments; a specimen computes at most {REQUEST_FRAGMENTS} for a request"
        ));
    }
    let (mut fragments, mut n) = (Vec::new(), 0);
    specimen
        .fragments(&triangle, window, &mut |f| {
            n += 1;
            let (a, b) = (f.varying.x, f.varying.y);
            // Writing to a vector does not fail.
            let _ = write!(fragments, " {} {} {} {a} {b}", f.x_px, f.y_px, f.depth);
        })
        .map_err(|refused| refused.to_string())?;
    Ok(('F', n, fragments))
}
