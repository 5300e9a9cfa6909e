//! Plots of what accuracy costs: error against time, and the price of exactness.
//!
//! A panel is a class of scenes, or a part of the work on a model. Both axes are logarithmic; the shelf below holds the
//! choices without any error, each in a row of its own. A line joins what is best at each price. Labels stand beside their
//! dots and never overlap.

use super::canvas::{self, Drawing, GRID, INK, Ink, SOFT};
use super::lettering;
use super::words::{number, thousands};
use rasterproof_precision::cost::{Board, Ladder, Price, Priced, prices};
use rasterproof_study::cost::Group;

const WIDTH: f64 = 800.0;
const SHELF: Ink = [233, 245, 236];
const GOOD: Ink = [20, 110, 50];
const OTHER: Ink = [31, 84, 170];
const CRACKED: Ink = [205, 30, 30];
const FRONTIER: Ink = [190, 160, 90];

const ROW: f64 = 13.0;
/// Height of the part of a panel where errors are not zero.
const SCATTER: f64 = 150.0;
/// Room left of a panel for its axis, over it for its name, and below for the other axis.
const AXIS: f64 = 48.0;
const HEAD: f64 = 70.0;
const FOOT: f64 = 46.0;
const RADIUS: f64 = 3.5;

struct Dot {
    label: String,
    time: f64,
    /// First and last quartile of the time.
    quartiles: [f64; 2],
    /// `None` on the shelf.
    error: Option<f64>,
    good: bool,
    /// Good against the snapped vertices only.
    hollow: bool,
    cracked: bool,
    /// Whether it is the cheapest exact one.
    best: bool,
}

struct Panel {
    head: String,
    up: String,
    right: String,
    /// An error that is drawn as a line, since many dots would have it.
    snapping: Option<f64>,
    dots: Vec<Dot>,
}

/// Error against time, a panel for each class of scenes, as many in a row as are said: two, or one for narrow pages. The
/// first measure that ranks is the error. The line through a dot spans the quartiles of its time.
pub fn pareto(board: &Board, in_row: usize) -> Drawing {
    let panel = |column: usize| Panel {
        head: format!("{}: {}", board.columns[column].name, board.columns[column].about),
        up: board.measures[0].title.to_string(),
        right: "time in ns for each pixel".to_owned(),
        snapping: snapping(board, column),
        dots: dots(board, column),
    };
    let title = format!("{}: error against time", board.ladder.title());
    drawn(&title, legend(board), board.columns_run().map(panel).collect(), in_row)
}

/// The same of a model, a panel for each part of the work.
pub fn pareto_of_model(groups: &[Group], in_row: usize) -> Drawing {
    let panel = |group: &Group| {
        let best = group.best.iter().flatten().map(|best| best.choice).collect::<Vec<_>>();
        let dot = |(number, choice): (usize, &rasterproof_study::cost::Choice)| {
            let time = choice.time.filter(|_| choice.refused.is_none())?;
            let first = choice.errors.first().copied().flatten()?;
            let is_exact = |measure: usize| group.is_exact(choice, measure);
            // As on a board: what is exact once corners are snapped stands on the shelf.
            let hollow = !is_exact(0) && group.measures.len() > 1 && is_exact(1);
            Some(Dot {
                label: choice.name.clone(),
                time: time.median / 1e6,
                quartiles: [time.low / 1e6, time.high / 1e6],
                error: (first > 0.0 && !hollow).then_some(first),
                good: hollow || is_exact(0),
                hollow,
                cracked: false,
                best: best.contains(&number),
            })
        };
        Panel {
            head: group.title.to_owned(),
            up: group.measures[0].title.to_owned(),
            right: "time in ms".to_owned(),
            snapping: None,
            dots: group.choices.iter().enumerate().filter_map(dot).collect(),
        }
    };
    let legend = "green: exact here, as a ring once corners are snapped; blue: wrong\n\
                  a circle around it: the cheapest exact choice\n\
                  line: the least error at each price; bars: the middle half of the times";
    drawn("Error against time", legend, groups.iter().map(panel).collect(), in_row)
}

/// Bars of effects: the milliseconds that each takes, or saves where it is left out, and the pixels that are wrong without
/// it.
pub fn effects(rows: &[(&str, Option<f64>, bool, u64)], width: f64) -> Drawing {
    let title = "Effects: time, and pixels that are wrong without";
    let legend = "left: ms, blue taken by what is paid for, green saved by what is left out";
    let lines: Vec<_> =
        [title, legend].iter().flat_map(|line| wrapped(line, width - 24.0)).collect();
    let head = 26.0 + 16.0 * lines.len() as f64;
    let mut drawing = Drawing::new(title, [width, head + 20.0 * rows.len() as f64 + 12.0]);
    for (line, text) in lines.iter().enumerate() {
        drawing.text([12.0, 16.0 + 16.0 * line as f64], text, if line == 0 { INK } else { SOFT });
    }
    let names = rows.iter().map(|(name, ..)| canvas::width(name)).fold(0.0, f64::max) + 24.0;
    let room = (width - names) / 2.0;
    let bar = room - canvas::width("1,234,567 px") - 8.0;
    let most_ms = rows.iter().filter_map(|row| row.1).fold(1e-9, f64::max);
    let most_px = rows.iter().map(|row| row.3).max().unwrap_or(1).max(1) as f64;
    for (place, (name, ms, is_saved, wrong)) in rows.iter().enumerate() {
        let y = head + 20.0 * place as f64;
        drawing.text([12.0, y], name, INK);
        let mut draw = |x: f64, length: f64, text: &str, ink: Ink| {
            drawing.filled_box([x, y - 6.0], [length.max(1.0), 12.0], ink);
            drawing.text([x + length + 6.0, y], text, SOFT);
        };
        let ink = if *is_saved { GOOD } else { OTHER };
        match ms {
            Some(ms) => draw(names, bar * ms / most_ms, &number(*ms, 8), ink),
            None => draw(names, 0.0, "noise", SOFT),
        }
        let pixels = *wrong as f64;
        draw(names + room, bar * pixels / most_px, &format!("{} px", thousands(*wrong)), CRACKED);
    }
    drawing
}

fn drawn(title: &str, legend: &str, mut panels: Vec<Panel>, in_row: usize) -> Drawing {
    let width = WIDTH / 2.0 * in_row as f64;
    // A class that nothing ran on has nothing to show.
    panels.retain(|panel| !panel.dots.is_empty());
    let on_shelf = |panel: &Panel| panel.dots.iter().filter(|d| d.error.is_none()).count();
    let shelf = panels.iter().map(on_shelf).max().unwrap_or(0) as f64 * ROW;
    let shelf = if shelf > 0.0 { shelf + 8.0 } else { 0.0 };
    let panel_height = HEAD + SCATTER + shelf + FOOT;
    let legend: Vec<String> = legend.lines().flat_map(|line| wrapped(line, width - 24.0)).collect();
    let titles = wrapped(title, width - 24.0);
    let head = 10.0 + 16.0 * (titles.len() + legend.len()) as f64 + 12.0;
    let rows = panels.len().div_ceil(in_row) as f64;
    let mut drawing = Drawing::new(title, [width, head + rows * panel_height]);
    let lines = titles.iter().map(|text| (text, INK)).chain(legend.iter().map(|l| (l, SOFT)));
    for (line, (text, ink)) in lines.enumerate() {
        drawing.text([12.0, 16.0 + 16.0 * line as f64], text, ink);
    }
    for (i, panel) in panels.iter().enumerate() {
        let left = (i % in_row) as f64 * WIDTH / 2.0;
        draw_panel(&mut drawing, [left, head + (i / in_row) as f64 * panel_height], shelf, panel);
    }
    drawing
}

/// The text in lines of at most `room` units, broken at spaces.
fn wrapped(text: &str, room: f64) -> Vec<String> {
    lettering::lines(text, room, canvas::width)
}

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

fn dots(board: &Board, column: usize) -> Vec<Dot> {
    let mut dots = Vec::new();
    for (choice, info) in board.choices.iter().enumerate() {
        let Some(time) = board.time(choice, column) else { continue };
        let (time, quartiles) = (time.pixel_ns.median, [time.pixel_ns.low, time.pixel_ns.high]);
        let error = |measure: usize| board.error(choice, column, measure);
        let Some(first) = error(0) else { continue };
        // Measures that rank nothing and count pixels of a mesh: cracks.
        let cracks: f64 = match board.ladder {
            Ladder::Scanline | Ladder::EdgeFunction => (2..4).filter_map(error).sum(),
            _ => 0.0,
        };
        let cracked = cracks > 0.0;
        let label =
            if cracked { format!("{} ({cracks})", info.name) } else { info.name.to_string() };
        let good = board.meets(choice, column, 0) == Some(true);
        let snapped = info.promises.contains(&1) && !good;
        let above = (first > 0.0).then_some(first);
        // One that is exact after snapping stands on the shelf, as a ring: what it shows against the
        // vertices as given is the error of snapping, a line of its own.
        let label = if snapped { format!("{} (snapped)", info.name) } else { label };
        let error = above.filter(|_| !snapped);
        let (good, hollow) = (good || snapped, snapped);
        let best = board.best(column, 0).and_then(|best| best.good) == Some(choice);
        dots.push(Dot { label, time, quartiles, error, good, hollow, cracked, best });
    }
    dots
}

/// A logarithmic axis: values at either end, and where these lie.
struct Axis {
    values: [f64; 2],
    places: [f64; 2],
}

impl Axis {
    fn new(values: impl Iterator<Item = f64>, margin: f64, places: [f64; 2]) -> Self {
        let (low, high) = values
            .map(f64::log10)
            .fold((f64::MAX, f64::MIN), |(low, high), v| (low.min(v), high.max(v)));
        let (low, high) = if low > high { (0.0, 1.0) } else { (low, high) };
        Self { values: [low - margin, high + margin], places }
    }

    fn place(&self, value: f64) -> f64 {
        let [low, high] = self.values;
        let t = (value.log10() - low) / (high - low).max(1e-9);
        self.places[0] + (self.places[1] - self.places[0]) * t
    }

    /// Powers of ten, at most about `count` of them, or multiples by 2 and 5 where the range is small.
    fn ticks(&self, count: usize) -> Vec<f64> {
        let [low, high] = self.values;
        let (first, last) = (low.floor() as i32, high.ceil() as i32);
        let step = ((high - low) / count as f64).ceil().max(1.0) as i32;
        let factors: &[f64] = if high - low < 1.6 { &[1.0, 2.0, 5.0] } else { &[1.0] };
        let decades = (first..=last).filter(|e| e.rem_euclid(step) == 0);
        let all = decades.flat_map(|e| factors.iter().map(move |f| f * 10f64.powi(e)));
        all.filter(|v| (low..=high).contains(&v.log10())).collect()
    }
}

fn tick(value: f64) -> String {
    if (0.001..99_999.0).contains(&value) { format!("{value}") } else { format!("{value:.0e}") }
}

fn draw_panel(drawing: &mut Drawing, [left, top]: [f64; 2], shelf: f64, panel: &Panel) {
    let (x0, x1) = (left + AXIS + 6.0, left + WIDTH / 2.0 - 10.0);
    let (y0, y1) = (top + HEAD, top + HEAD + SCATTER);
    let bottom = y1 + shelf;
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
    let times = dots.iter().flat_map(|d| [d.quartiles[0], d.time, d.quartiles[1]]);
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
        drawing.text_before([x0 - 4.0, y1 + shelf / 2.0], "0", GOOD);
    }
    drawing.line([x0, y1], [x1, y1], SOFT);
    drawing.line([x0, bottom], [x1, bottom], SOFT);
    drawing.line([x0, y0], [x0, bottom], SOFT);
    frontier(drawing, dots, [&time, &error], y1);
    shelved(drawing, dots, &time, [x0, x1], y1);
    let mut taken = Vec::new();
    if let Some(value) = snapping {
        let (y, text) = (error.place(value), "error of snapping");
        drawing.line([x0, y], [x1, y], GOOD);
        let left = x1 - canvas::width(text) - 4.0;
        drawing.text([left, y - 8.0], text, GOOD);
        taken.extend([[left, y - 14.0, x1, y - 2.0], [x0, y - 1.0, x1, y + 1.0]]);
    }
    scattered(drawing, dots, [&time, &error], [[x0, y0], [x1, y1]], taken);
}

/// The error that snapping alone makes, which choices exact on the lattice share.
fn snapping(board: &Board, column: usize) -> Option<f64> {
    let choice = board.choices.iter().position(|choice| choice.promises.contains(&1))?;
    board.error(choice, column, 0).filter(|&error| error > 0.0)
}

fn ends(dot: &Dot, time: &Axis) -> [f64; 2] {
    dot.quartiles.map(|t| if t > 0.0 { time.place(t) } else { time.place(dot.time) })
}

/// A line from the first to the last quartile of a dot's time.
fn spread(drawing: &mut Drawing, dot: &Dot, time: &Axis, y: f64) {
    let [from, to] = ends(dot, time).map(|x| [x, y]);
    drawing.wide_line(from, to, SOFT);
}

fn mark(drawing: &mut Drawing, at: [f64; 2], dot: &Dot) -> Ink {
    let ink = if dot.good { GOOD } else { OTHER };
    match dot.hollow {
        true => drawing.ring(at, RADIUS - 0.5, ink),
        false => drawing.disc(at, RADIUS, ink),
    }
    if dot.best {
        drawing.ring(at, RADIUS + 3.0, ink);
    }
    if dot.cracked {
        drawing.ring(at, RADIUS + 3.0, CRACKED);
        return CRACKED;
    }
    ink
}

/// Joins the choices to which none is as fast and more accurate: from each there is a step to the next.
fn frontier(drawing: &mut Drawing, dots: &[Dot], [time, error]: [&Axis; 2], shelf: f64) {
    let mut all: Vec<&Dot> = dots.iter().filter(|dot| dot.time > 0.0).collect();
    all.sort_by(|a, b| a.time.total_cmp(&b.time));
    let mut before: Option<&Dot> = None;
    for dot in all {
        let of = |dot: &Dot| dot.error.unwrap_or(0.0);
        if before.is_some_and(|before| of(dot) >= of(before)) {
            continue;
        }
        if let Some(from) =
            before.and_then(|before| Some([time.place(before.time), error.place(before.error?)]))
        {
            // The first on the shelf is the fastest there.
            let y = dot.error.map_or(shelf + 10.0, |value| error.place(value));
            let corner = [time.place(dot.time), from[1]];
            drawing.wide_line(from, corner, FRONTIER);
            drawing.wide_line(corner, [corner[0], y], FRONTIER);
        }
        before = Some(dot);
    }
}

/// The choices without error, one below the other, the fastest first.
fn shelved(drawing: &mut Drawing, dots: &[Dot], time: &Axis, [x0, x1]: [f64; 2], top: f64) {
    let mut shelved: Vec<&Dot> = dots.iter().filter(|d| d.error.is_none()).collect();
    shelved.sort_by(|a, b| a.time.total_cmp(&b.time));
    for (i, dot) in shelved.into_iter().enumerate() {
        let at = [time.place(dot.time), top + 10.0 + ROW * i as f64];
        spread(drawing, dot, time, at[1]);
        let ink = mark(drawing, at, dot);
        let room = canvas::width(&dot.label) + 10.0;
        let [low, high] = ends(dot, time);
        if high + room <= x1 || low - room < x0 {
            // Where the quartiles leave no room on either side, across them.
            let left = (high + 9.0).min(x1 - canvas::width(&dot.label));
            drawing.text([left, at[1]], &dot.label, ink);
        } else {
            drawing.text_before([low - 9.0, at[1]], &dot.label, ink);
        }
    }
}

/// Left, top, right and bottom.
type Area = [f64; 4];

fn overlap(a: &Area, b: &Area) -> bool {
    a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]
}

/// The choices with errors. Each label takes the nearest free place beside its dot.
fn scattered(
    drawing: &mut Drawing,
    dots: &[Dot],
    [time, error]: [&Axis; 2],
    [[x0, y0], [x1, y1]]: [[f64; 2]; 2],
    mut taken: Vec<Area>,
) {
    let mut placed: Vec<(&Dot, [f64; 2])> = dots
        .iter()
        .filter_map(|dot| Some((dot, [time.place(dot.time), error.place(dot.error?)])))
        .collect();
    placed.sort_by(|a, b| a.1[1].total_cmp(&b.1[1]));
    let around = |[x, y]: [f64; 2]| [x - 6.0, y - 6.0, x + 6.0, y + 6.0];
    taken.extend(placed.iter().map(|(_, at)| around(*at)));
    for (dot, at) in &placed {
        let room = canvas::width(&dot.label);
        // Beside the dot, then higher and lower by half lines, on both sides.
        let shifts = (0..56).flat_map(|i| {
            let down = f64::from((i + 1) / 2) * ROW / 2.0 * if i % 2 == 0 { 1.0 } else { -1.0 };
            // Where neither side has room, above or below.
            let over = (at[0] - room / 2.0).clamp(x0 + 2.0, (x1 - room - 2.0).max(x0 + 2.0));
            // Clear of the quartiles where it stands beside the dot.
            let [low, high] = if i == 0 { ends(dot, time) } else { [at[0]; 2] };
            [high + 10.0, low - 10.0 - room, over].map(|x| [x, at[1] + down])
        });
        let area = |[x, y]: [f64; 2]| [x, y - 6.0, x + room, y + 6.0];
        let leader = |place: [f64; 2]| {
            if place[0] > at[0] {
                [*at, [place[0] - 2.0, place[1]]]
            } else if place[0] + room < at[0] {
                [*at, [place[0] + room + 2.0, place[1]]]
            } else {
                let edge = if place[1] > at[1] { -6.0 } else { 6.0 };
                [*at, [at[0], place[1] + edge]]
            }
        };
        let is_free = |place: [f64; 2], strict: bool| {
            let area = area(place);
            let inside = area[0] >= x0 && area[2] <= x1 && area[1] >= y0 && area[3] <= y1;
            let inside = inside && !overlap(&area, &around(*at));
            let clear =
                |other: &Area| !(overlap(&area, other) || strict && crosses(leader(place), other));
            inside && taken.iter().filter(|other| **other != around(*at)).all(clear)
        };
        spread(drawing, dot, time, at[1]);
        let ink = mark(drawing, *at, dot);
        // Better a line across something than no label.
        let found = [true, false]
            .into_iter()
            .find_map(|strict| shifts.clone().find(|&place| is_free(place, strict)));
        if let Some(place) = found {
            if (place[1] - at[1]).abs() > 1.0 {
                let [from, to] = leader(place);
                drawing.line(from, to, SOFT);
            }
            drawing.text(place, &dot.label, ink);
            taken.push(area(place));
        }
    }
}

/// Whether a line from a dot crosses an area, looked at in short steps.
fn crosses([from, to]: [[f64; 2]; 2], area: &Area) -> bool {
    (0..=32).map(|i| f64::from(i) / 32.0).any(|t| {
        let [x, y] = [0, 1].map(|k| from[k] + (to[k] - from[k]) * t);
        overlap(&[x, y, x + 0.1, y + 0.1], area)
    })
}

/// What exact coverage costs over the cheapest choice, for each class of scenes: the one picture.
pub fn price(boards: &[Board]) -> Drawing {
    const BAND: f64 = 48.0;
    let prices = prices(boards);
    let (x0, x1, head) = (84.0, WIDTH - 24.0, 104.0);
    let bottom = head + BAND * prices.len() as f64;
    let title = "What exact coverage costs over the cheapest choice";
    let mut drawing = Drawing::new(title, [WIDTH, bottom + 44.0]);
    drawing.text([12.0, 16.0], title, INK);
    let legend = "time over that of the cheapest choice of any accuracy, by class of scenes";
    drawing.text([12.0, 32.0], legend, SOFT);
    for (row, kind) in KINDS.iter().enumerate() {
        let y = 50.0 + 15.0 * row as f64;
        kind.mark(&mut drawing, [17.0, y]);
        drawing.text([28.0, y], kind.about, kind.ink);
    }
    let all = prices.iter().flat_map(|p| KINDS.each_ref().map(|kind| (kind.of)(p)));
    let ratios = all.flatten().map(|p| p.ratio);
    // Room for a label right of the last mark.
    let axis = Axis::new(ratios.chain([1.0, 4.0]), 0.0, [x0 + 8.0, x1 - 210.0]);
    for value in [1.0, 2.0, 3.0, 5.0, 10.0, 20.0, 50.0] {
        if axis.place(value) <= x1 {
            let x = axis.place(value);
            drawing.line([x, head - 6.0], [x, bottom], GRID);
            let text = format!("{value}x");
            drawing.text_about([x, bottom + 12.0], &text, SOFT);
        }
    }
    drawing.line([x0, bottom], [x1, bottom], SOFT);
    for (i, price) in prices.iter().enumerate() {
        band(&mut drawing, &axis, x1, head + BAND * i as f64, price);
    }
    drawing
}

/// What a mark of the picture stands for.
struct Kind {
    about: &'static str,
    of: fn(&Price) -> Option<&Priced>,
    ink: Ink,
    is_ring: bool,
}

const KINDS: [Kind; 3] = [
    Kind {
        about: "the cheapest choice that promises nothing (floats)",
        of: |price| price.unpromised.as_ref(),
        ink: OTHER,
        is_ring: false,
    },
    Kind {
        about: "the cheapest that is exact on the 1/256-px lattice (snaps)",
        of: |price| price.snapped.as_ref(),
        ink: GOOD,
        is_ring: true,
    },
    Kind {
        about: "the cheapest that is exact for the vertices as given",
        of: |price| price.given.as_ref(),
        ink: GOOD,
        is_ring: false,
    },
];

impl Kind {
    fn mark(&self, drawing: &mut Drawing, at: [f64; 2]) {
        match self.is_ring {
            true => drawing.ring(at, RADIUS, self.ink),
            false => drawing.disc(at, RADIUS + 1.0, self.ink),
        }
    }
}

fn band(drawing: &mut Drawing, axis: &Axis, x1: f64, top: f64, price: &Price) {
    drawing.line([12.0, top - 6.0], [x1, top - 6.0], GRID);
    drawing.text([12.0, top + 15.0], &price.column, INK);
    let start = axis.place(1.0);
    for (row, kind) in KINDS.iter().enumerate() {
        let Some(Priced { name, ratio, pixel_ns }) = (kind.of)(price) else { continue };
        let at = [axis.place(*ratio), top + 3.0 + ROW * row as f64];
        drawing.wide_line([start, at[1]], at, [200, 214, 206]);
        kind.mark(drawing, at);
        let label = if *ratio == 1.0 {
            format!("{name} {} ns/px", number(*pixel_ns, 8))
        } else {
            format!("{name} {ratio:.2}x")
        };
        drawing.text([at[0] + 10.0, at[1]], &label, kind.ink);
    }
}
