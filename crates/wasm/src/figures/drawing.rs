//! The picture of a figure as SVG, on light and on dark paper.

use std::fmt::{Arguments, Write as _};

use glam::DVec3;
use serde_json::Value;

use super::{FigureInput, fill};
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::PixelRect;
use rasterproof_render::pipeline::target::to_colour;

/// x to the right and y down, in pixels of a window or in units of the drawing.
pub(super) type Point = [f64; 2];

/// Every drawing is as wide as a telephone shows without scaling it down much.
pub(super) const WIDTH: f64 = 360.0;

/// The colours by their names in [`RULES`], on light and on dark paper.
const COLOURS: [(&str, [&str; 2]); 11] = [
    ("paper", ["#fbfbf8", "#1b1f24"]),
    ("grid", ["#c3c6c0", "#444b54"]),
    ("ink", ["#24292f", "#e6edf3"]),
    ("soft", ["#6b727a", "#9aa3ad"]),
    ("on", ["#a3aeb7", "#6a7681"]),
    ("miss", ["#e07070", "#b03a3a"]),
    ("extra", ["#f0a028", "#a8691a"]),
    ("twice", ["#b878d8", "#8a48b0"]),
    ("one", ["#7fb2f0", "#3f74b8"]),
    ("two", ["#f2b66d", "#a06a24"]),
    ("grip", ["#0b57d0", "#7fb0ff"]),
];

/// What each class looks like; a colour in braces depends on the theme.
const RULES: &str = ".paper{fill:{paper}}.grid{fill:none;stroke:{grid}}.ink{fill:none;stroke:{ink};stroke-width:2}\
    .soft{fill:none;stroke:{soft};stroke-width:1.5;stroke-dasharray:5 4}.dot{fill:{ink}}\
    .on{fill:{on}}.miss{fill:{miss}}.extra{fill:{extra}}.twice{fill:{twice}}\
    .dark{fill:#3d4a57}.pale{fill:#e8c48a}.one{fill:{one}}.two{fill:{two}}.grip{fill:{grip};stroke:{paper};stroke-width:2}\
    text{fill:{ink};font:15px sans-serif}";

/// The rules of style with their colours.
fn rules(is_dark: bool) -> String {
    fill(RULES, &COLOURS.map(|(name, colours)| (name, colours[usize::from(is_dark)].to_owned())))
}

/// Pixels of a window as squares on the drawing.
#[derive(Clone, Copy)]
pub(super) struct Panel {
    /// Where the upper left corner of the window lies on the drawing.
    pub corner: Point,
    pub unit: f64,
    pub window: PixelRect,
}

impl Panel {
    /// Pixels of `unit` on the drawing, from the first column and row to the ones behind the last.
    pub fn new(corner: Point, unit: f64, [x0, y0, x1, y1]: [i32; 4]) -> Self {
        Self { corner, unit, window: PixelRect { x0, y0, x1, y1 } }
    }

    /// A window in the middle of the drawing, its upper border at `top`.
    pub fn middle(columns: i32, rows: i32, unit: f64, top: f64) -> Self {
        let left = (WIDTH - f64::from(columns) * unit) / 2.0;
        Self::new([left, top], unit, [0, 0, columns, rows])
    }

    /// Where a position in pixels lies on the drawing.
    pub fn place(&self, [x, y]: Point) -> Point {
        let (right, down) = (x - f64::from(self.window.x0), y - f64::from(self.window.y0));
        [self.corner[0] + right * self.unit, self.corner[1] + down * self.unit]
    }

    /// Every pixel of the window, row by row.
    pub fn pixels(&self) -> impl Iterator<Item = [i32; 2]> + use<> {
        let PixelRect { x0, y0, x1, y1 } = self.window;
        (y0..y1).flat_map(move |y| (x0..x1).map(move |x| [x, y]))
    }

    /// Where its lower border lies, below which other parts of the drawing begin.
    pub fn bottom(&self) -> f64 {
        self.corner[1] + f64::from(self.window.height()) * self.unit
    }
}

/// The centre of a pixel, where it is sampled, in pixels.
pub(super) fn centre(pixel: [i32; 2]) -> Point {
    pixel.map(|v| f64::from(v) + 0.5)
}

/// Space from above: x to the right, z up.
#[derive(Clone, Copy)]
pub(super) struct FromAbove {
    /// Where the eye lies on the drawing, from which x and z are counted.
    pub eye: Point,
    pub unit: f64,
}

impl FromAbove {
    /// Where a point at this x and z lies on the drawing.
    pub fn place(&self, x: f64, z: f64) -> Point {
        [self.eye[0] + x * self.unit, self.eye[1] - z * self.unit]
    }
}

/// A drawing; what only the answer shows is left out of it until the reader has made a prediction.
pub(super) struct Drawing {
    height: f64,
    pub is_answered: bool,
    /// The pixels, below all else.
    runs: Vec<Run>,
    body: String,
    /// Where each grip lies, and how far it moves for a step of 1 to the right and down; 0 where it does not move.
    pub grips: Vec<(Point, Point)>,
}

/// Neighbouring pixels of a row that are painted alike.
struct Run {
    paint: String,
    corner: Point,
    width: f64,
    unit: f64,
}

impl Drawing {
    pub fn new(height: f64, is_answered: bool) -> Self {
        Self { height, is_answered, runs: Vec::new(), body: String::new(), grips: Vec::new() }
    }

    fn add(&mut self, element: Arguments<'_>) {
        // Writing to a string does not fail.
        let _ = writeln!(self.body, "{element}");
    }

    /// A pixel of the answer, in the colour of a class, with a letter on it.
    pub fn pixel(&mut self, panel: &Panel, [x, y]: [i32; 2], class: &str, letter: &str) {
        self.square(panel, [x, y], class.to_owned());
        if self.is_answered && !letter.is_empty() {
            let [x, y] = panel.place(centre([x, y]));
            // The line on which letters stand is below their middle.
            self.text([x, y + 5.0], "middle", letter);
        }
    }

    /// A pixel of the answer in a colour that is computed.
    pub fn colour(&mut self, panel: &Panel, pixel: [i32; 2], rgb: DVec3) {
        let [r, g, b, _] = to_colour(rgb);
        self.square(panel, pixel, format!("#{r:02x}{g:02x}{b:02x}"));
    }

    /// Paints a pixel, if the answer is shown.
    fn square(&mut self, panel: &Panel, [x, y]: [i32; 2], paint: String) {
        if !self.is_answered {
            return;
        }
        let (corner, unit) = (panel.place([x, y].map(f64::from)), panel.unit);
        // A pixel that goes on a run makes it longer, so that a picture is small enough for a page.
        match self.runs.last_mut() {
            Some(run)
                if run.paint == paint && [run.corner[0] + run.width, run.corner[1]] == corner =>
            {
                run.width += unit;
            }
            _ => self.runs.push(Run { paint, corner, width: unit, unit }),
        }
    }

    /// All runs of a paint in one path.
    fn pixels(&self) -> String {
        let mut paths: Vec<(&str, String)> = Vec::new();
        for Run { paint, corner: [x, y], width, unit } in &self.runs {
            let known = paths.iter().position(|(other, _)| other == paint);
            let at = known.unwrap_or_else(|| {
                paths.push((paint, String::new()));
                paths.len() - 1
            });
            let [x, y, width] = [x, y, width].map(|v| (v * 100.0).round() / 100.0);
            let _ = write!(paths[at].1, "M{x} {y}h{width}v{unit}h-{width}z");
        }
        let mut all = String::new();
        for (paint, path) in paths {
            // A colour of its own stands in the path, a class in the rules.
            let paint = match paint.strip_prefix('#') {
                Some(_) => format!("class=\"px\" fill=\"{paint}\""),
                None => format!("class=\"px {paint}\""),
            };
            let _ = writeln!(all, "<path {paint} d=\"{path}\"/>");
        }
        all
    }

    /// The borders of the pixels, over them.
    pub fn grid(&mut self, panel: &Panel) {
        let PixelRect { x0, y0, x1, y1 } = panel.window;
        let [left, top] = panel.corner;
        let [right, bottom] = panel.place([x1, y1].map(f64::from));
        let mut path = String::new();
        for i in 0..=x1 - x0 {
            let _ = write!(path, "M{} {top}V{bottom}", left + f64::from(i) * panel.unit);
        }
        for i in 0..=y1 - y0 {
            let _ = write!(path, "M{left} {}H{right}", top + f64::from(i) * panel.unit);
        }
        self.add(format_args!("<path class=\"grid\" d=\"{path}\"/>"));
    }

    /// The centres of the pixels, where they are sampled.
    pub fn samples(&mut self, panel: &Panel) {
        let mut path = String::new();
        for pixel in panel.pixels() {
            let [x, y] = panel.place(centre(pixel));
            let _ = write!(path, "M{} {y}h3v3h-3z", x - 1.5);
        }
        self.add(format_args!(
            "<path class=\"dot\" transform=\"translate(0 -1.5)\" d=\"{path}\"/>"
        ));
    }

    /// A closed or open line through positions in pixels.
    pub fn outline(&mut self, panel: &Panel, class: &str, points: &[Point], is_closed: bool) {
        let points: Vec<_> = points.iter().map(|&point| panel.place(point)).collect();
        self.path(class, &points, is_closed);
    }

    /// A closed or open line through points of the drawing.
    pub fn path(&mut self, class: &str, points: &[Point], is_closed: bool) {
        let mut path = String::new();
        for (i, [x, y]) in points.iter().enumerate() {
            let _ = write!(path, "{}{x:.2} {y:.2}", if i == 0 { 'M' } else { 'L' });
        }
        let end = if is_closed { "Z" } else { "" };
        self.add(format_args!("<path class=\"{class}\" d=\"{path}{end}\"/>"));
    }

    /// A line with a point at its end.
    pub fn arrow(&mut self, class: &str, from: Point, to: Point) {
        let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
        let scale = 9.0 / (dx * dx + dy * dy).sqrt().max(1.0);
        let (x, y) = (dx * scale, dy * scale);
        // The barbs begin behind the point, each half as far to its side.
        let one = [to[0] - x - y * 0.5, to[1] - y + x * 0.5];
        let other = [to[0] - x + y * 0.5, to[1] - y - x * 0.5];
        self.path(class, &[from, to], false);
        self.path(class, &[one, to, other], false);
    }

    /// The border of a panel whose single pixels are too small for a grid.
    pub fn border(&mut self, panel: &Panel) {
        let PixelRect { x1, y1, .. } = panel.window;
        let [left, top] = panel.corner;
        let [right, bottom] = panel.place([x1, y1].map(f64::from));
        self.path("grid", &[[left, top], [right, top], [right, bottom], [left, bottom]], true);
    }

    /// A hook below the middle of a row of 13 pixels.
    pub fn middle_mark(&mut self, panel: &Panel) {
        let [x, y] = panel.place([6.5, 1.0]);
        self.path("ink", &[[x - 6.0, y + 12.0], [x, y + 3.0], [x + 6.0, y + 12.0]], true);
    }

    /// A disk that marks a point of the drawing.
    pub fn dot(&mut self, [x, y]: Point, radius: f64) {
        self.add(format_args!(
            "<circle class=\"dot\" cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{radius}\"/>"
        ));
    }

    /// Words at a point of the drawing, where they `start`, or where their `middle` or `end` is.
    pub fn text(&mut self, [x, y]: Point, anchor: &str, words: &str) {
        self.add(format_args!(
            "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{words}</text>"
        ));
    }

    /// Something to drag; `scale` is how far it moves for a step of 1 to the right and down.
    pub fn grip(&mut self, [x, y]: Point, scale: Point) {
        self.grips.push(([x, y], scale));
        // Before the answer it cannot be dragged, and is a point like others.
        let (class, radius) = if self.is_answered { ("grip", 8) } else { ("dot", 4) };
        self.add(format_args!(
            "<circle class=\"{class}\" cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{radius}\"/>"
        ));
    }

    /// A grip with its letter beside it.
    pub fn named_grip(&mut self, [x, y]: Point, scale: Point, letter: &str) {
        self.grip([x, y], scale);
        self.text([x + 12.0, y - 6.0], "start", letter);
    }

    /// A grip on a scale of its own below the picture, for a value that has no place in it.
    pub fn slider(&mut self, given: &FigureInput<'_>, grip: usize, top: f64, says: &str) {
        let ([low, _], [high, _]) = (given.grips[grip].low, given.grips[grip].high);
        // The words before it are as long as 100 px at most.
        let (left, right) = (110.0, WIDTH - 20.0);
        let scale = (right - left) / (high - low);
        let spot = [left + (given.at[grip][0] - low) * scale, top];
        self.text([12.0, top + 5.0], "start", says);
        self.path("soft", &[[left, top], [right, top]], false);
        self.grip(spot, [scale, 0.0]);
    }

    /// Arrows from each point of the drawing to the next one, and back to the first.
    pub fn arrows(&mut self, class: &str, points: [Point; 3]) {
        for i in 0..3 {
            self.arrow(class, points[i], points[(i + 1) % 3]);
        }
    }

    /// Hits beside the right ones: missing, too many, hit more than once.
    pub fn hits(&mut self, panel: &Panel, hits: &Coverage, right: &Coverage) {
        for pixel in panel.pixels() {
            let [hits, right] = [hits, right].map(|frame| frame.get(pixel[0], pixel[1]));
            let (class, letter) = match (hits.unwrap_or(0), right.unwrap_or(0)) {
                (0, 0) => continue,
                // Missing, too many where nothing should be, right, and again.
                (is, should) if is < should => ("miss", "−"),
                (1, 0) => ("extra", "+"),
                (1, _) => ("on", ""),
                _ => ("twice", "2"),
            };
            self.pixel(panel, pixel, class, letter);
        }
    }

    /// Hits as an answer has them: a digit for each pixel.
    pub fn answered_hits(&mut self, panel: &Panel, digits: &Value) {
        let digits = digits.as_str().unwrap_or("").bytes();
        for (pixel, _) in panel.pixels().zip(digits).filter(|(_, hits)| *hits > b'0') {
            self.pixel(panel, pixel, "on", "");
        }
    }

    /// The picture within a page, whose theme is known.
    pub fn inline(&self, is_dark: bool) -> String {
        let (Self { height, body, .. }, pixels) = (self, self.pixels());
        let rules = rules(is_dark);
        format!(
            "<svg viewBox=\"0 0 {WIDTH} {height}\" aria-hidden=\"true\"><style>{rules}</style>\
             <rect class=\"paper\" width=\"{WIDTH}\" height=\"{height}\"/>{pixels}{body}</svg>"
        )
    }

    /// The picture as a file, which is legible on light and on dark pages.
    pub fn file(&self) -> String {
        let (Self { height, body, .. }, pixels) = (self, self.pixels());
        let (light, dark) = (rules(false), rules(true));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" \
             width=\"{WIDTH}\" height=\"{height}\">\n\
             <style>{light}@media(prefers-color-scheme:dark){{{dark}}}</style>\n\
             <rect class=\"paper\" width=\"{WIDTH}\" height=\"{height}\"/>\n{pixels}{body}</svg>\n"
        )
    }
}
