//! Figures about lines.

use super::drawing::{Drawing, Panel};
use super::{FigureInput, LiveFigure, Predict};
use rasterproof_core::contract::DrawLine as _;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::PixelPoint;
use rasterproof_faults::published::PublishedLine as _;
use rasterproof_faults::published::sysu_bresenham::SysuBresenham;
use rasterproof_verify::cases::named::plain_line;

type Pixels = Vec<[i32; 2]>;

pub(super) fn drawn(
    given: &FigureInput<'_>,
    from: [i32; 2],
    to: [i32; 2],
    window: PixelRect,
) -> Pixels {
    let line = plain_line(PixelPoint::new(from[0], from[1]), PixelPoint::new(to[0], to[1]));
    let mut pixels = Vec::new();
    given.pen.draw(&line, window, |f| pixels.push([f.x_px, f.y_px]));
    pixels
}

/// A line drawn both ways, by a drawer whose ties depend on the direction.
pub(super) fn there_and_back(given: &FigureInput<'_>) -> Result<LiveFigure, String> {
    let end = given.at[0].map(|v| v as i32);
    let panel = Panel::middle(10, 6, 34.0, 10.0);
    let published = |from: [i32; 2], to: [i32; 2]| -> Result<Pixels, String> {
        let mut pixels = Vec::new();
        let ends = [from, to].map(|p| p.map(|v| f64::from(v) + 0.5));
        SysuBresenham
            .draw(ends, panel.window, &mut |x, y| pixels.push([x, y]))
            .map_err(|refused| refused.to_string())?;
        Ok(pixels)
    };
    let (there, back) = (published([0, 0], end)?, published(end, [0, 0])?);
    let differ = |there: &Pixels, back: &Pixels| {
        let lacks = |a: &Pixels, b: &Pixels| a.iter().filter(|p| !b.contains(p)).count();
        lacks(there, back) + lacks(back, there)
    };
    let ours = [drawn(given, [0, 0], end, panel.window), drawn(given, end, [0, 0], panel.window)];
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
    let middle = |p: [i32; 2]| p.map(|v| f64::from(v) + 0.5);
    drawing.outline(&panel, "ink", &[middle([0, 0]), middle(end)], false);
    drawing.grip(panel.place(middle(end)), [panel.unit; 2]);
    let count = differ(&there, &back);
    let [x, y] = end;
    Ok(LiveFigure {
        drawing,
        predict: Predict::Number(count as f64, 0),
        values: vec![
            ("differ", count.to_string()),
            ("ours", differ(&ours[0], &ours[1]).to_string()),
        ],
        link: Some(format!(
            "#scene=line&lines=0,0,{x},{y};{x},{y},0,0&window=0,0,10,6&by=sysu-bresenham,dda&step=99"
        )),
    })
}

/// Asks which pixels a line from pixel (0, 0) to the grip draws.
pub(super) fn line_pixels(given: &FigureInput<'_>) -> Result<LiveFigure, String> {
    let end = given.at[0].map(|v| v as i32);
    let panel = Panel::middle(9, 6, 36.0, 10.0);
    let line = drawn(given, [0, 0], end, panel.window);
    let mut drawing = Drawing::new(panel.bottom() + 10.0, given.is_answered);
    for &pixel in &line {
        drawing.pixel(&panel, pixel, "on", "");
    }
    drawing.grid(&panel);
    drawing.samples(&panel);
    let middle = |p: [i32; 2]| p.map(|v| f64::from(v) + 0.5);
    drawing.outline(&panel, "ink", &[middle([0, 0]), middle(end)], false);
    drawing.grip(panel.place(middle(end)), [panel.unit; 2]);
    let pixels = panel.pixels().map(|pixel| (pixel, line.contains(&pixel))).collect();
    let [x, y] = end;
    Ok(LiveFigure {
        drawing,
        predict: Predict::Pixels(panel, pixels),
        values: vec![("count", line.len().to_string())],
        link: Some(format!(
            "#scene=line&lines=0,0,{x},{y}&window=0,0,9,6&by=dda,bresenham&step=99"
        )),
    })
}
