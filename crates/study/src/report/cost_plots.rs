//! Plots: error against time, and bars.
//!
//! A panel is a class of scenes, or a part of the work on a model. Both axes are logarithmic; the shelf below holds the
//! choices without any error, each in a row of its own. A line joins what is best at each price. Labels stand beside their
//! dots and never overlap.

use crate::grid::GridPrice;
use rasterproof_precision::cost::{Board, JudgedChoice, Ladder, Price, Priced, Ratio, fastest};
use rasterproof_report::canvas::{self, BLUE, Drawing, GREEN, GRID, INK, Ink, RED, SAND, SOFT};
use rasterproof_report::words::{grouped, number, thousands};
use rasterproof_verify::judge::ascii;

/// The widths of a drawing on a wide page, in a file and on a narrow page: that of three panels, two, or one.
pub const WIDTHS: [f64; 3] = [1200.0, 800.0, 400.0];
/// The colour behind the choices without any error.
const SHELF: Ink = [233, 245, 236];

/// The height of a line of text, a bar, or a choice on the shelf, in px.
const ROW: f64 = 13.0;
/// The height of the part of a panel where errors are not zero.
const SCATTER: f64 = 150.0;
/// Room left of a panel for its axis, over it for its name, and below for the other axis.
const AXIS: f64 = 48.0;
const HEAD: f64 = 70.0;
const FOOT: f64 = 46.0;
/// Of a dot.
const RADIUS: f64 = 3.5;

/// A choice in a panel.
struct Dot {
    label: String,
    /// Quartiles: a line from the first to the last one, and a disc at the median.
    time: [f64; 3],
    /// `None` on the shelf.
    error: Option<f64>,
    /// Green where it is good, as a ring where it is so against the snapped vertices only.
    ink: Ink,
    is_hollow: bool,
    /// A circle around it: of the cheapest exact one, or a red one where a mesh has cracks.
    around: Option<Ink>,
}

/// A plot of its own, with what stands above it and at its axes.
struct Panel {
    head: String,
    up: String,
    right: &'static str,
    /// An error that is drawn as a line, since many dots would have it.
    snapping: Option<f64>,
    dots: Vec<Dot>,
}

/// Error against time, a panel for each column of each board, as many in a row as are said, or fewer and wider ones. The
/// first measure is the error.
pub fn pareto(boards: &[Board], in_row: usize) -> Drawing {
    let mut panels = Vec::new();
    for board in boards {
        panels.extend(board.columns_run().map(|column| panel(board, column)));
    }
    match boards {
        [board] if board.columns.iter().all(|column| column.sampling.is_none()) => {
            let title = format!("{}: error against time", board.ladder.title());
            drawn(&title, legend(board), panels, in_rows_of(in_row))
        }
        _ => drawn("Error against time", LEGEND, panels, in_rows_of(in_row)),
    }
}

/// The panel of a column, which is a model, whose pixels are counted, or a class of scenes.
fn panel(board: &Board, column: usize) -> Panel {
    let info = &board.columns[column];
    let up = board.measures[0].title.to_string();
    // Of a model each measure has its best choice, of a class of scenes the first one alone.
    let best = |measure| board.cheapest_exact(column, measure);
    if info.sampling.is_some() {
        let best: Vec<_> = board.ranking().filter_map(best).collect();
        let (head, dots) = (board.ladder.title().to_owned(), dots(board, column, &best));
        return Panel { head, up, right: "time in ms", snapping: None, dots };
    }
    Panel {
        head: format!("{}: {}", info.name, info.about),
        up,
        right: "time in ns for each pixel",
        snapping: snapping(board, column),
        dots: dots(board, column, best(0).as_slice()),
    }
}

/// What the colours mean in panels of a model, where an exact choice is the goal of each job.
const LEGEND: &str = "green: exact here, as a ring once corners are snapped; blue: wrong\n\
                      a circle around it: the cheapest exact choice\n\
                      line: the least error at each price; bars: the middle half of the times";

/// The answer in one picture: both groups of coverage on a model, which do the same job, in one panel of this width.
pub fn coverage_of_model(boards: &[Board], width: f64) -> Drawing {
    let coverage: Vec<&Board> = boards.iter().filter(|board| board.ladder.is_coverage()).collect();
    // By each measure the best choice of both groups has a circle.
    let mut best = Vec::new();
    for measure in coverage.first().into_iter().flat_map(|board| board.ranking()) {
        best.extend(fastest(coverage.iter().flat_map(|board| board.exact(0, measure))));
    }
    let mut all = Vec::new();
    for board in &coverage {
        for dot in dots(board, 0, &best) {
            // Both groups have choices of one name.
            all.push(Dot { label: format!("{} {}", board.ladder.short(), dot.label), ..dot });
        }
    }
    let panel = Panel {
        head: String::new(),
        up: "wrong pixels of this view".to_owned(),
        right: "time in ms",
        snapping: None,
        dots: all,
    };
    drawn("Coverage: error against time", LEGEND, vec![panel], (width, 1))
}

/// The width of a drawing with so many panels in a row, and their number.
fn in_rows_of(in_row: usize) -> (f64, usize) {
    (WIDTHS[2] * in_row as f64, in_row)
}

/// Pixels that change against time, a dot for each grid and a panel for each engine.
pub fn pareto_of_grids(prices: &[GridPrice], in_row: usize) -> Drawing {
    let mut panels = Vec::from(["scanline", "edge function"].map(|engine| Panel {
        head: format!("Coverage by {engine}"),
        up: "px that change".to_owned(),
        right: "time in ms",
        snapping: None,
        dots: Vec::new(),
    }));
    for price in prices {
        let times = [price.scanline_ms, price.edge_function_ms];
        for (panel, time) in panels.iter_mut().zip(times) {
            panel.dots.push(Dot {
                label: price.bits.map_or("unsnapped".to_owned(), |bits| format!("{bits} bits")),
                time: [time; 3],
                error: (price.changed > 0).then_some(price.changed as f64),
                ink: if price.changed == 0 { GREEN } else { BLUE },
                is_hollow: false,
                around: None,
            });
        }
    }
    let legend = "each dot a grid: bits below the pixel; shelf: no pixel changes here\n\
                  up to 8 bits by whole numbers, beyond by the exact engines";
    drawn("Pixels that the grid changes, against time", legend, panels, in_rows_of(in_row))
}

/// A bar: its share of the longest, its colour, and what stands behind it.
pub type Bar = (f64, Ink, String);

/// Rows of bars below each other, each row with its name, under a legend of their colours.
pub fn bars(title: &str, legend: &[(Ink, &str)], rows: &[(&str, Vec<Bar>)], width: f64) -> Drawing {
    // The head is as high as its lines: of the title, then of the legend.
    let titles = wrapped(title, width - 24.0);
    let mut lines = Vec::new();
    for (ink, words) in legend {
        for (line, text) in wrapped(words, width - 52.0).into_iter().enumerate() {
            // The colour stands before the first line.
            lines.push(((line == 0).then_some(*ink), text));
        }
    }
    let head = 24.0 + 16.0 * (titles.len() + lines.len()) as f64;
    // Bars get what names and labels leave of the width.
    let (mut names, mut labels) = (0.0f64, 0.0f64);
    for (name, bars) in rows {
        names = names.max(canvas::width(name));
        for (_, _, label) in bars {
            labels = labels.max(canvas::width(label));
        }
    }
    // On a narrow page names stand over their bars.
    let (left, down) = if width < WIDTHS[1] { (12.0, 14.0) } else { (names + 28.0, 0.0) };
    let room = width - left - labels - 18.0;
    let heights = rows.iter().map(|(_, bars)| down + ROW * bars.len() as f64 + 6.0);
    let mut drawing = Drawing::new(title, [width, head + heights.sum::<f64>() + 6.0]);
    // Everything is drawn from the top down; y is where the next line begins.
    let mut y = 16.0;
    for text in &titles {
        drawing.text([12.0, y], text, INK);
        y += 16.0;
    }
    for (ink, text) in &lines {
        if let Some(ink) = ink {
            drawing.filled_box([14.0, y - 4.0], [18.0, 8.0], *ink);
        }
        drawing.text([40.0, y], text, SOFT);
        y += 16.0;
    }
    y = head + 6.0;
    for (name, bars) in rows {
        drawing.text([12.0, y], name, INK);
        y += down;
        for (share, ink, label) in bars {
            let length = (room * share).max(1.0);
            drawing.filled_box([left, y - 5.0], [length, 10.0], *ink);
            drawing.text([left + length + 6.0, y], label, SOFT);
            y += ROW;
        }
        y += 6.0;
    }
    drawing
}

/// What is drawn of an effect.
pub struct EffectBars {
    pub name: &'static str,
    /// What it takes, or what is saved where it is left out; nothing where that cannot be told.
    pub ms: Option<f64>,
    pub is_saved: bool,
    /// Pixels that are wrong without it.
    pub wrong: u64,
}

/// The milliseconds that each effect takes, or saves where it is left out, and the pixels that are wrong without it.
pub fn effects(effects: &[EffectBars], width: f64) -> Drawing {
    let legend = [
        (BLUE, "ms that it takes, where it is paid for"),
        (GREEN, "ms that are saved, where it is left out"),
        (RED, "pixels that are wrong without it"),
    ];
    // The longest bar of each kind is as long as there is room.
    let most_ms = effects.iter().filter_map(|effect| effect.ms).fold(1e-9, f64::max);
    let most_px = effects.iter().map(|effect| effect.wrong).fold(1, u64::max) as f64;
    let mut rows = Vec::new();
    for &EffectBars { name, ms, is_saved, wrong } in effects {
        let ink = if is_saved { GREEN } else { BLUE };
        let time = match ms {
            Some(ms) => (ms / most_ms, ink, format!("{} ms", number(ms, 8))),
            None => (0.0, SOFT, "no time".to_owned()),
        };
        let pixels = (wrong as f64 / most_px, RED, format!("{} px", thousands(wrong)));
        rows.push((name, vec![time, pixels]));
    }
    bars("Effects: time, and pixels that are wrong without", &legend, &rows, width)
}

/// What exact coverage costs over the cheapest choice, for each class of scenes: the one picture.
pub fn price(prices: &[Price], width: f64) -> Drawing {
    let legend = [
        (BLUE, "the cheapest choice that promises nothing (floats)"),
        (GREEN, "the cheapest that is exact on the 1/256-px lattice (snaps)"),
        (SAND, "the cheapest that is exact for the vertices as given"),
    ];
    // The longest bar of all classes has the whole room.
    let mut most: f64 = 1.0;
    for priced in prices.iter().flat_map(kinds).flatten() {
        most = most.max(priced.ratio.median);
    }
    let mut rows: Vec<(&str, Vec<Bar>)> = Vec::new();
    for price in prices {
        let mut row = Vec::new();
        for (priced, (ink, _)) in kinds(price).into_iter().zip(legend) {
            let Some(Priced { name, ratio, pixel_ns }) = priced else { continue };
            // The cheapest of all has no ratio to itself, so its time is said.
            let label = match *ratio == Ratio::ONE {
                true => format!("{name} {} ns/px", number(*pixel_ns, 8)),
                false => format!("{name} {ratio}"),
            };
            row.push((ratio.median / most, ink, label));
        }
        rows.push((&price.column, row));
    }
    // What a label with a mark means is said where there is one.
    let is_doubtful = rows.iter().flat_map(|(_, row)| row).any(|(.., label)| label.ends_with('?'));
    let title = match is_doubtful {
        true => {
            "Time of exact coverage over that of the cheapest choice of any accuracy, by class of scenes; 1-2?: cannot be told"
        }
        false => {
            "Time of exact coverage over that of the cheapest choice of any accuracy, by class of scenes"
        }
    };
    bars(title, &legend, &rows, width)
}

/// What is compared of a class of scenes, in the order of the legend.
fn kinds(price: &Price) -> [&Option<Priced>; 3] {
    [&price.unpromised, &price.snapped, &price.given]
}

/// Panels side by side under a title and a legend, on a drawing of this width with at most so many in a row.
fn drawn(
    title: &str,
    legend: &str,
    mut panels: Vec<Panel>,
    (width, in_row): (f64, usize),
) -> Drawing {
    // A class that nothing ran on has nothing to show.
    panels.retain(|panel| !panel.dots.is_empty());
    let in_row = in_row.min(panels.len()).max(1);
    let panel_width = width / in_row as f64;
    // All shelves are as high as the one with the most choices.
    let on_shelf = |panel: &Panel| panel.dots.iter().filter(|d| d.error.is_none()).count();
    let shelf = panels.iter().map(on_shelf).max().unwrap_or(0) as f64 * ROW;
    let shelf = if shelf > 0.0 { shelf + 8.0 } else { 0.0 };
    // A panel alone needs no name beside that of the drawing.
    let room = if panels.iter().all(|panel| panel.head.is_empty()) { HEAD / 2.0 } else { HEAD };
    let panel_height = room + SCATTER + shelf + FOOT;
    let legend: Vec<String> = legend.lines().flat_map(|line| wrapped(line, width - 24.0)).collect();
    let titles = wrapped(title, width - 24.0);
    let head = 10.0 + 16.0 * (titles.len() + legend.len()) as f64 + 12.0;
    let rows = panels.len().div_ceil(in_row) as f64;
    // Title and legend share one list of lines, and the panels follow from left to right, row by row.
    let mut drawing = Drawing::new(title, [width, head + rows * panel_height]);
    for (line, text) in titles.iter().chain(&legend).enumerate() {
        let ink = if line < titles.len() { INK } else { SOFT };
        drawing.text([12.0, 16.0 + 16.0 * line as f64], text, ink);
    }
    for (i, panel) in panels.iter().enumerate() {
        let left = (i % in_row) as f64 * panel_width;
        let top = head + (i / in_row) as f64 * panel_height + room - HEAD;
        draw_panel(&mut drawing, [left, top, left + panel_width], shelf, panel);
    }
    drawing
}

/// The lines of a text in a room of this width.
fn wrapped(text: &str, room: f64) -> Vec<String> {
    ascii::lines(text, room, canvas::width)
}

/// What the colours mean in the panels of classes of scenes, which differs from job to job.
fn legend(board: &Board) -> &'static str {
    match board.ladder {
        Ladder::Scanline | Ladder::EdgeFunction => {
            "shelf: no error, green rings: none after snapping\n\
             red rings: holes and double hits inside a mesh, with their number\n\
             bars: the middle half of the times"
        }
        Ladder::Interpolation => {
            "green: within half a step of 8 bits (1/512)\nbars: the middle half of the times"
        }
        _ => "shelf: no error\nbars: the middle half of the times",
    }
}

/// The choices of a column, and which of them are the best.
fn dots(board: &Board, column: usize, best: &[JudgedChoice<'_>]) -> Vec<Dot> {
    let of_model = board.columns[column].sampling.is_some();
    let is_coverage = board.ladder.is_coverage();
    let dot = |choice: JudgedChoice<'_>| {
        // Milliseconds of a model, nanoseconds a pixel of a class of scenes.
        let spread = match of_model {
            true => choice.times()?.spread().times(1e-6),
            false => choice.run.time.as_ref()?.pixel_ns,
        };
        // Without an error by the first measure there is no place for it.
        let first = choice.error(0)?;
        // One that is exact after snapping stands on the shelf, as a ring: what it shows against the
        // vertices as given is the error of snapping, of classes of scenes a line of its own.
        let is_snapped = if of_model { choice.is_exact(1) } else { choice.promises(1) };
        let is_hollow = is_coverage && is_snapped && !choice.is_exact(0);
        // Measures that rank nothing and count pixels of a mesh: cracks.
        let counts = if is_coverage { 2..4 } else { 0..0 };
        let cracks: f64 = counts.filter_map(|measure| choice.error(measure)).sum();
        let ink = if is_hollow || choice.is_exact(0) { GREEN } else { BLUE };
        let is_best = best.iter().any(|best| best.is(&choice));
        let name = choice.name();
        Some(Dot {
            label: match (is_hollow && !of_model, cracks > 0.0) {
                (true, _) => format!("{name} (snapped)"),
                (_, true) => format!("{name} ({cracks})"),
                _ => name.to_owned(),
            },
            time: [spread.low, spread.median, spread.high],
            error: (first > 0.0 && !is_hollow).then_some(first),
            ink,
            is_hollow,
            around: if cracks > 0.0 { Some(RED) } else { is_best.then_some(ink) },
        })
    };
    board.ran(column).filter_map(dot).collect()
}

/// A logarithmic axis: values at either end, and where these lie.
struct Axis {
    values: [f64; 2],
    places: [f64; 2],
}

impl Axis {
    fn new(values: impl Iterator<Item = f64>, margin: f64, places: [f64; 2]) -> Self {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for value in values.map(f64::log10) {
            (low, high) = (low.min(value), high.max(value));
        }
        // An axis without values is drawn, too.
        let [low, high] = if low <= high { [low, high] } else { [0.0, 1.0] };
        Self { values: [low - margin, high + margin], places }
    }

    /// Where a value lies in the drawing.
    fn place(&self, value: f64) -> f64 {
        let [low, high] = self.values;
        // An axis with one value has no length; the value is then drawn at its beginning.
        let t = (value.log10() - low) / (high - low).max(1e-9);
        self.places[0] + (self.places[1] - self.places[0]) * t
    }

    /// Powers of ten, at most about `count` of them, or multiples by 2 and 5 where the range is small.
    fn ticks(&self, count: usize) -> Vec<f64> {
        let [low, high] = self.values;
        let (first, last) = (low.floor() as i32, high.ceil() as i32);
        let step = ((high - low) / count as f64).ceil().max(1.0) as i32;
        let factors: &[f64] = if high - low < 1.6 { &[1.0, 2.0, 5.0] } else { &[1.0] };
        let mut ticks = Vec::new();
        for decade in (first..=last).filter(|decade| decade.rem_euclid(step) == 0) {
            for factor in factors {
                let value = factor * 10f64.powi(decade);
                if (low..=high).contains(&value.log10()) {
                    ticks.push(value);
                }
            }
        }
        ticks
    }
}

/// A number at an axis, with commas, or with an exponent where it would be long.
fn tick(value: f64) -> String {
    if (0.001..99_999.0).contains(&value) {
        grouped(&format!("{value}"))
    } else {
        format!("{value:.0e}")
    }
}

/// Draws a panel from its upper left corner to its right end: texts, axes, the line of what is best, and the dots.
fn draw_panel(drawing: &mut Drawing, [left, top, end]: [f64; 3], shelf: f64, panel: &Panel) {
    let (x0, x1) = (left + AXIS + 6.0, end - 10.0);
    let (y0, y1) = (top + HEAD, top + HEAD + SCATTER);
    let bottom = y1 + shelf;
    // Texts around the plot first: its name, and what grows upwards and to the right.
    let dots = &panel.dots;
    for (line, text) in wrapped(&panel.head, x1 - left - 14.0).iter().take(2).enumerate() {
        drawing.text([left + 12.0, top + 14.0 + 14.0 * line as f64], text, INK);
    }
    let up = wrapped(&format!("up: {}", panel.up), x1 - left - 14.0);
    for (text, line) in up.iter().rev().take(2).zip([12.0, 26.0]) {
        drawing.text([left + 12.0, y0 - line], text, SOFT);
    }
    let right = format!("right: {}", panel.right);
    drawing.text_before([x1, y1 + shelf + 24.0], &right, SOFT);
    drawing.filled_box([x0, y1], [x1 - x0, shelf], SHELF);
    // Axes that hold all quartiles and all errors, with a margin.
    let times = dots.iter().flat_map(|dot| dot.time);
    let time = Axis::new(times.filter(|t| *t > 0.0), 0.12, [x0, x1]);
    let snapping = panel.snapping;
    let error = Axis::new(dots.iter().filter_map(|d| d.error).chain(snapping), 0.4, [y1, y0]);
    for value in time.ticks(5) {
        let x = time.place(value);
        drawing.line([x, y0], [x, bottom], GRID);
        let text = tick(value);
        // The last one may stand at the border of the picture.
        let x = x.min(x1 - canvas::width(&text) / 2.0);
        drawing.text_about([x, bottom + 9.0], &text, SOFT);
    }
    if snapping.is_some() || dots.iter().any(|d| d.error.is_some()) {
        for value in error.ticks(5) {
            let y = error.place(value);
            drawing.line([x0, y], [x1, y], GRID);
            drawing.text_before([x0 - 4.0, y], &tick(value), SOFT);
        }
    }
    if shelf > 0.0 {
        drawing.text_before([x0 - 4.0, y1 + shelf / 2.0], "0", GREEN);
    }
    // The frame: the floor of the errors, that of the shelf, and the axis on the left.
    drawing.line([x0, y1], [x1, y1], SOFT);
    drawing.line([x0, bottom], [x1, bottom], SOFT);
    drawing.line([x0, y0], [x0, bottom], SOFT);
    // What is best at each price lies under the dots, and the error of snapping between both.
    let placed = places(dots, [&time, &error], y1);
    frontier(drawing, &placed);
    let mut taken = Taken::default();
    if let Some(value) = snapping {
        let (y, text) = (error.place(value), "error of snapping");
        drawing.line([x0, y], [x1, y], GREEN);
        let left = x1 - canvas::width(text) - 4.0;
        drawing.text([left, y - 8.0], text, GREEN);
        taken.words.push([left, y - 14.0, x1, y - 2.0]);
        taken.marks.push([x0, y - 1.0, x1, y + 1.0]);
    }
    labelled(drawing, placed, &time, Plot { x: [x0, x1], y: [y0, y1, bottom] }, &mut taken);
}

/// The choices with their places, the fastest first: those without an error stand on the shelf, one below the other.
fn places<'a>(dots: &'a [Dot], [time, error]: [&Axis; 2], shelf: f64) -> Vec<(&'a Dot, [f64; 2])> {
    let mut all: Vec<&Dot> = dots.iter().collect();
    all.sort_by(|a, b| a.time[1].total_cmp(&b.time[1]));
    let mut rows = 0;
    let mut placed = Vec::with_capacity(all.len());
    for dot in all {
        let y = match dot.error {
            Some(of_dot) => error.place(of_dot),
            None => shelf + 10.0 + ROW * f64::from(rows),
        };
        rows += i32::from(dot.error.is_none());
        placed.push((dot, [time.place(dot.time[1]), y]));
    }
    placed
}

/// The error that snapping alone makes, which choices exact on the lattice share.
fn snapping(board: &Board, column: usize) -> Option<f64> {
    let choice = board.choices.iter().position(|choice| choice.promises.contains(&1))?;
    board.error(choice, column, 0).filter(|&error| error > 0.0)
}

/// Where the first and the last quartile lie.
fn ends(dot: &Dot, time: &Axis) -> [f64; 2] {
    let [low, median, high] = dot.time;
    [low, high].map(|t| time.place(if t > 0.0 { t } else { median }))
}

/// Draws a dot, and returns the colour of its label.
fn mark(drawing: &mut Drawing, at: [f64; 2], dot: &Dot) -> Ink {
    match dot.is_hollow {
        true => drawing.ring(at, RADIUS - 0.5, dot.ink),
        false => drawing.disc(at, RADIUS, dot.ink),
    }
    if let Some(ink) = dot.around {
        drawing.ring(at, RADIUS + 3.0, ink);
    }
    dot.around.unwrap_or(dot.ink)
}

/// Joins the choices to which none is as fast and more accurate: from each there is a step to the next.
fn frontier(drawing: &mut Drawing, placed: &[(&Dot, [f64; 2])]) {
    let mut before: Option<(&Dot, [f64; 2])> = None;
    for &(dot, at) in placed {
        if dot.time[1] <= 0.0 {
            continue;
        }
        if let Some((last, from)) = before {
            // Slower, and no more accurate than the last one on the line.
            if dot.error.unwrap_or(0.0) >= last.error.unwrap_or(0.0) {
                continue;
            }
            let corner = [at[0], from[1]];
            drawing.wide_line(from, corner, SAND);
            drawing.wide_line(corner, at, SAND);
        }
        before = Some((dot, at));
    }
}

/// Left, top, right and bottom.
type Area = [f64; 4];

/// Whether two areas have a part in common; touching is not enough.
fn overlap(a: &Area, b: &Area) -> bool {
    a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]
}

/// Where the dots and labels of a panel may lie.
#[derive(Clone, Copy)]
struct Plot {
    /// Its left and its right side, in px of the drawing.
    x: [f64; 2],
    /// From above: where the part with errors begins, where the shelf begins, and where the shelf ends.
    y: [f64; 3],
}

impl Plot {
    /// Whether a label lies inside, on the shelf or above it.
    fn holds(&self, area: &Area, is_on_shelf: bool) -> bool {
        let [top, bottom] =
            if is_on_shelf { [self.y[1], self.y[2]] } else { [self.y[0], self.y[1]] };
        area[0] >= self.x[0] && area[2] <= self.x[1] && area[1] >= top && area[3] <= bottom
    }
}

/// The areas that are drawn on before a label is placed.
#[derive(Default)]
struct Taken {
    /// Labels, and the name of the line of the error of snapping: no label may lie on one.
    words: Vec<Area>,
    /// Dots, and that line: a label may lie on one if no other place is left.
    marks: Vec<Area>,
}

/// Each choice with its label, which takes the nearest free place beside its dot, and a line from the first to the last
/// quartile of its time. What has no error stands on the shelf.
fn labelled(
    drawing: &mut Drawing,
    mut placed: Vec<(&Dot, [f64; 2])>,
    time: &Axis,
    plot: Plot,
    taken: &mut Taken,
) {
    placed.sort_by(|a, b| a.1[1].total_cmp(&b.1[1]));
    for (_, at) in &placed {
        taken.marks.push(area_around(*at));
    }
    for (dot, at) in &placed {
        let quartiles @ [low, high] = ends(dot, time);
        drawing.wide_line([low, at[1]], [high, at[1]], SOFT);
        let ink = mark(drawing, *at, dot);
        let label = Label { at: *at, room: canvas::width(&dot.label) };
        // Places inside the plot where no word lies. If there is none, the label goes over its own dot, whatever lies there.
        let mut places = label.places(quartiles, plot.x);
        places.retain(|place| {
            let area = label.area(*place);
            plot.holds(&area, dot.error.is_none())
                && taken.words.iter().all(|word| !overlap(&area, word))
        });
        // Best is a place whose line from the dot crosses nothing; better a line across something than a label on a dot.
        let is_clear = |place: &&[f64; 2]| label.is_clear(**place, taken);
        let is_off = |place: &&[f64; 2]| label.is_off(**place, &taken.marks);
        let found =
            places.iter().find(is_clear).or_else(|| places.iter().find(is_off)).or(places.first());
        let place = found.copied().unwrap_or_else(|| label.over(plot.x));
        if (place[1] - at[1]).abs() > 1.0 {
            let [from, to] = label.leader(place);
            drawing.line(from, to, SOFT);
        }
        drawing.text(place, &dot.label, ink);
        taken.words.push(label.area(place));
    }
}

/// The area of a dot.
fn area_around([x, y]: [f64; 2]) -> Area {
    [x - 6.0, y - 6.0, x + 6.0, y + 6.0]
}

/// A label on its way to a place: where its dot is, and how wide it is.
struct Label {
    at: [f64; 2],
    room: f64,
}

impl Label {
    /// Where its text may begin, the best place first: beside the dot, then higher and lower by half lines, on both sides.
    fn places(&self, quartiles: [f64; 2], between: [f64; 2]) -> Vec<[f64; 2]> {
        let Self { at, room } = *self;
        // Where neither side has room, above or below.
        let over = self.over(between)[0];
        let mut places = Vec::new();
        for i in 0..56 {
            let down = f64::from((i + 1) / 2) * ROW / 2.0 * if i % 2 == 0 { 1.0 } else { -1.0 };
            // Clear of the quartiles where it stands beside the dot.
            let [low, high] = if i == 0 { quartiles } else { [at[0]; 2] };
            for x in [high + 10.0, low - 10.0 - room, over] {
                places.push([x, at[1] + down]);
            }
        }
        places
    }

    /// In the row of its dot, about it as far as the sides of the plot let it.
    fn over(&self, [x0, x1]: [f64; 2]) -> [f64; 2] {
        let right = (x1 - self.room - 2.0).max(x0 + 2.0);
        [(self.at[0] - self.room / 2.0).clamp(x0 + 2.0, right), self.at[1]]
    }

    /// Whether no mark lies below the text.
    fn is_off(&self, place: [f64; 2], marks: &[Area]) -> bool {
        marks.iter().all(|mark| !overlap(&self.area(place), mark))
    }

    /// Whether, besides, the line from the dot crosses no word and no mark but its own.
    fn is_clear(&self, place: [f64; 2], taken: &Taken) -> bool {
        let own = area_around(self.at);
        let mut others = taken.words.iter().chain(taken.marks.iter().filter(|mark| **mark != own));
        self.is_off(place, &taken.marks) && others.all(|area| !crosses(self.leader(place), area))
    }

    /// What the text covers, if it begins there.
    fn area(&self, [x, y]: [f64; 2]) -> Area {
        [x, y - 6.0, x + self.room, y + 6.0]
    }

    /// The line from the dot to the nearest end of the text, or to its middle where it stands above or below.
    fn leader(&self, [x, y]: [f64; 2]) -> [[f64; 2]; 2] {
        let at = self.at;
        let edge = if y > at[1] { -6.0 } else { 6.0 };
        let to = match (x > at[0], x + self.room < at[0]) {
            (true, _) => [x - 2.0, y],
            (_, true) => [x + self.room + 2.0, y],
            _ => [at[0], y + edge],
        };
        [at, to]
    }
}

/// Whether a line from a dot crosses an area, looked at in short steps.
fn crosses([from, to]: [[f64; 2]; 2], area: &Area) -> bool {
    for i in 0..=32 {
        let t = f64::from(i) / 32.0;
        let [x, y] = [from[0] + (to[0] - from[0]) * t, from[1] + (to[1] - from[1]) * t];
        if overlap(&[x, y, x + 0.1, y + 0.1], area) {
            return true;
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasterproof_core::random::Rng;

    const NAMES: [&str; 6] = [
        "scanline big integers",
        "edge function (snapped)",
        "exact f64, adaptive",
        "f32",
        "book by scanline",
        "rational numbers (12)",
    ];

    /// From 1 to ten to this power, as likely in each decade.
    fn within(rng: &mut Rng, powers: i64) -> f64 {
        let mut value = 1.0 + 9.0 * rng.unit();
        for _ in 1..rng.int(1, powers) {
            value *= 10.0;
        }
        value
    }

    /// A choice at a random time, mostly without an error, since these crowd.
    fn random_dot(rng: &mut Rng, number: usize) -> Dot {
        let median = within(rng, 4);
        Dot {
            label: NAMES[number % NAMES.len()].to_owned(),
            time: [0.9 * median, median, 1.2 * median],
            error: rng.chance(3).then(|| within(rng, 12)),
            ink: GREEN,
            is_hollow: false,
            around: None,
        }
    }

    /// In random panels no label lies over another, and none leaves the plot, which is as narrow as on a phone.
    #[test]
    fn no_labels_lie_over_one_another() {
        for seed in 0..400 {
            let mut rng = Rng::new("labels", seed, 0);
            let dots: Vec<Dot> =
                (0..4 + seed as usize % 14).map(|k| random_dot(&mut rng, k)).collect();
            let on_shelf = dots.iter().filter(|dot| dot.error.is_none()).count();
            let plot = Plot { x: [54.0, 390.0], y: [70.0, 220.0, 228.0 + ROW * on_shelf as f64] };
            let time = Axis::new(dots.iter().flat_map(|dot| dot.time), 0.12, plot.x);
            let error =
                Axis::new(dots.iter().filter_map(|dot| dot.error), 0.4, [plot.y[1], plot.y[0]]);
            let placed = places(&dots, [&time, &error], plot.y[1]);
            let mut taken = Taken::default();
            labelled(&mut Drawing::new("", [400.0, 500.0]), placed, &time, plot, &mut taken);
            assert_eq!(taken.words.len(), dots.len());
            for (k, word) in taken.words.iter().enumerate() {
                let others = &taken.words[k + 1..];
                assert!(
                    others.iter().all(|other| !overlap(word, other)),
                    "seed {seed}: {:?}",
                    taken.words
                );
                let [left, top, right, bottom] = *word;
                let is_inside = left >= plot.x[0]
                    && right <= plot.x[1]
                    && top >= plot.y[0]
                    && bottom <= plot.y[2];
                assert!(is_inside, "seed {seed}: {word:?} leaves the plot");
            }
        }
    }
}
