//! Simple drawings as SVG: lines, discs, rings, boxes and text.
//!
//! Own code instead of a plotting library: none of `plotters`, `charming` and `poloto` places labels so that they do not overlap,
//! which is most of the work here, and their colours are the same on dark paper. Here each colour has a class by which a dark page
//! gets another one, and text says its length, so that no font makes labels overlap.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use super::html::{Figure, escape};

pub type Ink = [u8; 3];

/// The black of titles and labels.
pub const INK: Ink = [34, 34, 34];
/// The grey of units and notes.
pub const SOFT: Ink = [110, 110, 110];
/// The light grey of the grid, which must not hide what is plotted.
pub const GRID: Ink = [226, 226, 226];
/// Three that eyes without red or green tell apart by their lightness, too, and one for a third kind of bar.
pub const GREEN: Ink = [20, 110, 50];
pub const BLUE: Ink = [31, 84, 170];
pub const RED: Ink = [205, 30, 30];
pub const SAND: Ink = [190, 160, 90];
const PAPER: Ink = [255, 255, 255];

/// A drawing, y down. What is drawn later lies over what is there.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    /// What it shows, for those who cannot see it.
    title: String,
    /// Width and height, in units of about a pixel.
    pub size: [f64; 2],
    /// The colours that occur, each of which needs a class.
    inks: BTreeSet<Ink>,
    /// The elements, in the order of drawing.
    body: String,
}

// Writing to a string does not fail.
impl Drawing {
    pub fn new(title: &str, size: [f64; 2]) -> Self {
        Self { title: escape(title), size, inks: [PAPER].into(), body: String::new() }
    }

    /// A colour by day, and a class that names the one by night.
    fn paint(&mut self, what: &str, ink: Ink) -> String {
        self.inks.insert(ink);
        format!("{what}=\"#{0}\" class=\"{1}{0}\"", hex(ink), &what[..1])
    }

    fn path(&mut self, [x1, y1]: [f64; 2], [x2, y2]: [f64; 2], width: u32, ink: Ink) {
        let stroke = self.paint("stroke", ink);
        let _ = writeln!(
            self.body,
            "<path d=\"M{x1:.1} {y1:.1}L{x2:.1} {y2:.1}\" {stroke} stroke-width=\"{width}\"/>"
        );
    }

    pub fn line(&mut self, from: [f64; 2], to: [f64; 2], ink: Ink) {
        self.path(from, to, 1, ink);
    }

    pub fn wide_line(&mut self, from: [f64; 2], to: [f64; 2], ink: Ink) {
        self.path(from, to, 2, ink);
    }

    /// A filled rectangle by its left upper corner, its width and its height.
    pub fn filled_box(&mut self, [x, y]: [f64; 2], [w, h]: [f64; 2], ink: Ink) {
        let fill = self.paint("fill", ink);
        let _ = writeln!(
            self.body,
            "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{w:.1}\" height=\"{h:.1}\" {fill}/>"
        );
    }

    /// A circle that is painted in this way.
    fn circle(&mut self, [x, y]: [f64; 2], radius: f64, paint: &str) {
        let _ = writeln!(self.body, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\" {paint}/>");
    }

    pub fn disc(&mut self, at: [f64; 2], radius: f64, ink: Ink) {
        let fill = self.paint("fill", ink);
        self.circle(at, radius, &fill);
    }

    /// A circle 2 units wide; the radius is that of the middle of its line.
    pub fn ring(&mut self, at: [f64; 2], radius: f64, ink: Ink) {
        let stroke = self.paint("stroke", ink);
        self.circle(at, radius, &format!("fill=\"none\" {stroke} stroke-width=\"2\""));
    }

    /// A line of text: its left end, at its middle height.
    pub fn text(&mut self, [x, y]: [f64; 2], text: &str, ink: Ink) {
        // The base line lies below the middle of the letters.
        let (fill, y, length) = (self.paint("fill", ink), y + 4.5, width(text));
        let _ = writeln!(
            self.body,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" textLength=\"{length}\" {fill}>{}</text>",
            escape(text)
        );
    }

    /// A line of text by its right end, as beside an axis.
    pub fn text_before(&mut self, at: [f64; 2], text: &str, ink: Ink) {
        self.text([at[0] - width(text), at[1]], text, ink);
    }

    /// A line of text by its middle, as below a mark.
    pub fn text_about(&mut self, at: [f64; 2], text: &str, ink: Ink) {
        self.text([at[0] - width(text) / 2.0, at[1]], text, ink);
    }
}

/// The width of a text, in units of the drawing: between that in Helvetica and that in DejaVu Sans, which is wide.
pub fn width(text: &str) -> f64 {
    // By the kind of letter, since no font can be measured here.
    let letter = |c: char| match c {
        'i' | 'j' | 'l' | '.' | ',' | ':' | ';' | '\'' | '|' | '!' => 3.5,
        ' ' | 'f' | 't' | 'r' | '(' | ')' | '[' | ']' | '/' | '-' | '"' => 4.6,
        'm' | 'M' | 'W' | '%' | '@' => 11.7,
        'A'..='Z' | 'w' | '+' | '=' | '<' | '>' | '~' => 9.4,
        '\u{2e80}'.. => 13.0,
        _ => 7.7,
    };
    text.chars().map(letter).sum()
}

/// The drawing as a document, with its colours for dark pages.
pub fn svg(drawing: &Drawing) -> String {
    let Drawing { title, size: [width, height], inks, body } = drawing;
    let mut classes = String::new();
    for ink in inks {
        let (name, dark) = (hex(*ink), hex(dark(*ink)));
        let _ = write!(classes, ".f{name}{{fill:#{dark}}}.s{name}{{stroke:#{dark}}}");
    }
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" \
         height=\"{height}\" font-family=\"system-ui, sans-serif\" font-size=\"13\">\n<title>{title}</title>\n\
         <style>@media (prefers-color-scheme: dark){{{classes}}}</style>\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\" class=\"fffffff\"/>\n{body}</svg>\n"
    )
}

/// The same drawing for wide pages, for files and for narrow pages, as a figure.
pub fn figure(caption: &str, [wide, usual, narrow]: [Drawing; 3]) -> Figure {
    // The browser takes the first version whose condition holds.
    let others = [("(min-width: 78rem)", svg(&wide)), ("(max-width: 40rem)", svg(&narrow))];
    Figure { caption: caption.to_owned(), svg: svg(&usual), others: others.into() }
}

fn hex([r, g, b]: Ink) -> String {
    format!("{r:02x}{g:02x}{b:02x}")
}

/// What a colour is on a dark page: light ones become dark, dark ones light, of the same hue.
fn dark([r, g, b]: Ink) -> Ink {
    // The hue stays where all three are mirrored at the same place.
    let (low, high) = (r.min(g).min(b), r.max(g).max(b));
    let mirror = |v: u8| {
        // The lightness is mirrored, and black text does not become pure white.
        let mirrored = i32::from(v) + 255 - i32::from(low) - i32::from(high);
        (28 + mirrored * 7 / 8).clamp(0, 255) as u8
    };
    [r, g, b].map(mirror)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dark_pages_turn_paper_and_ink_over() {
        let sum = |ink: Ink| ink.iter().map(|v| u32::from(*v)).sum::<u32>();
        assert_eq!(dark(PAPER), [28; 3]);
        assert!(sum(dark([0, 0, 0])) > 3 * 240 && sum(dark(INK)) > 3 * 200);
        let [r, g, b] = dark(GREEN);
        assert!(g > b && b > r && r > 100, "green stays green: {r} {g} {b}");
    }

    #[test]
    fn svg_is_escaped() {
        let mut drawing = Drawing::new("a < b", [40.0, 20.0]);
        drawing.disc([10.0, 10.0], 4.0, [0, 0, 255]);
        drawing.ring([30.0, 10.0], 5.0, [255, 0, 0]);
        drawing.text([1.0, 15.0], "<&", [0, 0, 0]);
        let svg = svg(&drawing);
        assert!(svg.contains("<title>a &lt; b</title>") && svg.contains(">&lt;&amp;</text>"));
        assert_eq!(svg.matches("<circle").count(), 2);
        assert!(svg.contains(".fffffff{fill:#1c1c1c}") && svg.contains("class=\"sff0000\""));
    }
}
