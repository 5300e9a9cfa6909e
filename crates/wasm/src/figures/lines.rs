//! Figures about lines.

use super::drawing::{Drawing, Panel, centre};
use super::{FigureInput, LiveFigure, Predict};
use crate::answer::{Pen, line_between, strangers};
use crate::no_answer::NoAnswer;
use rasterproof_core::grid::PixelRect;
use rasterproof_faults::published::sysu_bresenham::SysuBresenham;

/// The pixels of a line between two pixels, in the order in which a pen sets them.
pub(super) fn drawn(
    pen: Pen,
    from: [i32; 2],
    to: [i32; 2],
    window: PixelRect,
) -> Result<Vec<[i32; 2]>, NoAnswer> {
    pen.pixels(&line_between(from, to), window)
}

/// A line drawn both ways, by a drawer whose ties depend on the direction. Asks how many pixels only one of the two has.
pub(super) fn there_and_back(given: &FigureInput<'_>) -> Result<LiveFigure, NoAnswer> {
    // The grip moves in whole pixels.
    let end = given.at[0].map(|v| v as i32);
    let panel = Panel::middle(10, 6, 34.0, 10.0);
    let published = Pen::Published(&SysuBresenham);
    let there = drawn(published, [0, 0], end, panel.window)?;
    let back = drawn(published, end, [0, 0], panel.window)?;
    // A pixel of both has no arrow on it.
    let mut drawing = Drawing::new(panel.bottom() + 10.0, given.is_answered);
    for pixel in panel.pixels() {
        match (there.contains(&pixel), back.contains(&pixel)) {
            (true, true) => drawing.pixel(&panel, pixel, "on", ""),
            (true, false) => drawing.pixel(&panel, pixel, "one", "→"),
            (false, true) => drawing.pixel(&panel, pixel, "two", "←"),
            (false, false) => {}
        }
    }
    drawing.grid(&panel);
    drawing.outline(&panel, "ink", &[centre([0, 0]), centre(end)], false);
    drawing.grip(panel.place(centre(end)), [panel.unit; 2]);
    let differ = strangers(&there, &back) + strangers(&back, &there);
    // Our own pen, for the sentence that compares.
    let pen = Pen::Engine(given.pen);
    let there = drawn(pen, [0, 0], end, panel.window)?;
    let back = drawn(pen, end, [0, 0], panel.window)?;
    let ours = strangers(&there, &back) + strangers(&back, &there);
    let [x, y] = end;
    Ok(LiveFigure {
        drawing,
        predict: Predict::Number(differ as f64, 0),
        values: vec![("differ", differ.to_string()), ("ours", ours.to_string())],
        link: Some(format!(
            "#scene=line&lines=0,0,{x},{y};{x},{y},0,0&window=0,0,10,6&by=sysu-bresenham,dda&step=99"
        )),
    })
}

/// Asks which pixels a line from pixel (0, 0) to the grip draws: one for each step along its longer axis.
pub(super) fn line_pixels(given: &FigureInput<'_>) -> Result<LiveFigure, NoAnswer> {
    let end = given.at[0].map(|v| v as i32);
    let panel = Panel::middle(9, 6, 36.0, 10.0);
    // In the order of the pen, which the figure does not show.
    let line = drawn(Pen::Engine(given.pen), [0, 0], end, panel.window)?;
    let mut drawing = Drawing::new(panel.bottom() + 10.0, given.is_answered);
    for &pixel in &line {
        drawing.pixel(&panel, pixel, "on", "");
    }
    drawing.grid(&panel);
    drawing.samples(&panel);
    drawing.outline(&panel, "ink", &[centre([0, 0]), centre(end)], false);
    drawing.grip(panel.place(centre(end)), [panel.unit; 2]);
    let [x, y] = end;
    Ok(LiveFigure {
        drawing,
        predict: Predict::among(panel, &line),
        values: vec![("count", line.len().to_string())],
        link: Some(format!(
            "#scene=line&lines=0,0,{x},{y}&window=0,0,9,6&by=dda,bresenham&step=99"
        )),
    })
}
