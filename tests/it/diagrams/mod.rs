//! The diagrams of the pages as SVG: legible on light and on dark paper, labels as text, numbers from the code that the
//! page is about. A page has what is drawn here, byte for byte.

mod coverage;
mod light;
mod space;

use std::fmt::Write as _;

use crate::pages::{Renewal, files, read, root};

struct Diagram {
    /// The file's name under `docs/figures/`, without its ending.
    name: &'static str,
    draw: fn() -> String,
}

const ALL: [Diagram; 16] = [
    Diagram { name: "split", draw: coverage::split },
    Diagram { name: "edge-sign", draw: coverage::edge_sign },
    Diagram { name: "owners", draw: coverage::owners },
    Diagram { name: "dda-row", draw: coverage::dda_row },
    Diagram { name: "barycentric-areas", draw: coverage::areas },
    Diagram { name: "snapping", draw: coverage::snapping },
    Diagram { name: "share", draw: space::share },
    Diagram { name: "steps", draw: space::steps },
    Diagram { name: "depth", draw: space::depth },
    Diagram { name: "near-plane", draw: space::near_plane },
    Diagram { name: "cube", draw: space::cube },
    Diagram { name: "winding", draw: coverage::winding },
    Diagram { name: "handedness", draw: space::handedness },
    Diagram { name: "n-l", draw: light::cosine },
    Diagram { name: "samples", draw: light::samples },
    Diagram { name: "lattices", draw: coverage::lattices },
];

/// The paper brings its own colours, since a picture does not inherit those of its page.
const STYLE: &str = "<style>\
    .paper{fill:#fbfbf8}.ink{stroke:#24292f}.soft{stroke:#8c959f;stroke-dasharray:4 4}\
    .grid{stroke:#d0d7de}.one{stroke:#0969da}.two{stroke:#bc4c00}\
    .ink,.soft,.grid,.one,.two{fill:none;stroke-width:1.5}.grid{stroke-width:1}.one,.two{stroke-width:2.5}\
    .fill1{fill:#0969da;fill-opacity:.22}.fill2{fill:#bc4c00;fill-opacity:.22}\
    .fill3{fill:#8250df;fill-opacity:.22}\
    .dot{fill:#24292f}.dot1{fill:#0969da}.dot2{fill:#bc4c00}.ring{fill:#fbfbf8;stroke:#8c959f}\
    text{fill:#24292f;font:14px sans-serif}\
    @media(prefers-color-scheme:dark){.paper{fill:#161b22}.ink{stroke:#e6edf3}.soft{stroke:#8b949e}\
    .grid{stroke:#30363d}.one{stroke:#58a6ff}.two{stroke:#f0883e}\
    .fill1{fill:#58a6ff;fill-opacity:.3}.fill2{fill:#f0883e;fill-opacity:.3}\
    .fill3{fill:#bc8cff;fill-opacity:.3}\
    .dot{fill:#e6edf3}.dot1{fill:#58a6ff}.dot2{fill:#f0883e}.ring{fill:#161b22;stroke:#8b949e}\
    text{fill:#e6edf3}}</style>";

/// A point of the drawing, or of the drawing's own coordinates.
type Point = [f64; 2];

/// A drawing of a diagram; positions are in its own units from the upper left.
struct Drawing {
    width: f64,
    height: f64,
    body: String,
}

impl Drawing {
    fn new(width: f64, height: f64) -> Self {
        Self { width, height, body: String::new() }
    }

    fn add(&mut self, element: std::fmt::Arguments<'_>) {
        // Writing to a string does not fail.
        let _ = writeln!(self.body, "{element}");
    }

    fn line(&mut self, class: &str, [x0, y0]: Point, [x1, y1]: Point) {
        self.add(format_args!("<path class=\"{class}\" d=\"M{x0:.1} {y0:.1}L{x1:.1} {y1:.1}\"/>"));
    }

    fn arrow(&mut self, class: &str, from: Point, to: Point) {
        self.line(class, from, to);
        let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
        let scale = 9.0 / (dx * dx + dy * dy).sqrt();
        for turn in [-0.5, 0.5] {
            let (x, y) = (dx * scale, dy * scale);
            self.line(class, to, [to[0] - x + y * turn, to[1] - y - x * turn]);
        }
    }

    fn polygon(&mut self, class: &str, corners: &[Point]) {
        let points: Vec<_> = corners.iter().map(|[x, y]| format!("{x:.1},{y:.1}")).collect();
        self.add(format_args!("<polygon class=\"{class}\" points=\"{}\"/>", points.join(" ")));
    }

    fn dot(&mut self, class: &str, [x, y]: Point, radius: f64) {
        self.add(format_args!(
            "<circle class=\"{class}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\"/>"
        ));
    }

    /// Words around a point: `start`, `middle` or `end` of them stands there.
    fn text(&mut self, anchor: &str, [x, y]: Point, words: &str) {
        let words = words.replace('&', "&amp;").replace('<', "&lt;");
        self.add(format_args!(
            "<text text-anchor=\"{anchor}\" x=\"{x:.1}\" y=\"{y:.1}\">{words}</text>"
        ));
    }

    /// Words beside a point.
    fn label(&mut self, anchor: &str, [x, y]: Point, [right, down]: Point, words: &str) {
        self.text(anchor, [x + right, y + down], words);
    }

    fn grid(&mut self, [x0, y0]: Point, side: f64, columns: u32, rows: u32) {
        let (right, below) = (x0 + side * f64::from(columns), y0 + side * f64::from(rows));
        for i in 0..=columns {
            let x = x0 + side * f64::from(i);
            self.line("grid", [x, y0], [x, below]);
        }
        for j in 0..=rows {
            let y = y0 + side * f64::from(j);
            self.line("grid", [x0, y], [right, y]);
        }
    }

    fn svg(self) -> String {
        let Self { width, height, body } = self;
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" \
             height=\"{height}\">\n{STYLE}\n<rect class=\"paper\" width=\"{width}\" height=\"{height}\"/>\n\
             {body}</svg>\n"
        )
    }
}

fn between(a: Point, b: Point, t: f64) -> Point {
    [a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t]
}

/// `RASTERPROOF_RENEW=1 cargo test --test it diagrams_are` writes them anew.
#[test]
fn diagrams_are_what_is_drawn() {
    let mut renewal = Renewal::default();
    for diagram in ALL {
        renewal.is(format!("docs/figures/{}.svg", diagram.name), &(diagram.draw)());
    }
    renewal.check("diagrams_are");
}

#[test]
fn diagrams_stand_on_pages() {
    let pages: String = files(&root().join("docs"), ".md").into_iter().map(read).collect();
    for diagram in ALL {
        let (name, svg) = (diagram.name, (diagram.draw)());
        assert!(pages.contains(&format!("](figures/{name}.svg)")), "{name}");
        assert!(svg.contains("prefers-color-scheme:dark") && svg.contains("<text"), "{name}");
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{name}");
    }
}
