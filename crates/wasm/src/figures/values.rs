//! Figures about values of pixels: weights, perspective, depth.

use glam::{DVec2, DVec3};

use super::drawing::{Drawing, FromAbove, Panel, Point, centre};
use super::{
    FigureInput, LiveFigure, Predict, count, in_address, number, snapped_triangle, with_triangles,
};
use crate::answer::along;
use crate::no_answer::NoAnswer;
use rasterproof_core::contract::Interpolate as _;
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::raster::edge_function::probe::edges_at;
use rasterproof_core::triangle::{Fragment, ScreenTriangle, ScreenVertex};
use rasterproof_faults::published::book_affine::BookAffine;
use rasterproof_faults::published::sysu_weights::SysuWeights;
use rasterproof_faults::published::{Published, from_screen};
use rasterproof_registry::engines::Engine;
use rasterproof_render::pipeline::depth::DepthFormat;

/// A corner: x, y, w, depth, u, v, as an address of the playground has them.
type Corner = [f64; 6];

/// The last fragment of each pixel.
type Values = Frame<Option<Fragment<DVec2>>>;

/// The triangle of three such corners, if the lattice has a place for them.
fn triangle(corners: [Corner; 3]) -> Result<ScreenTriangle<DVec2>, NoAnswer> {
    let [a, b, c] =
        corners.map(|[x, y, w, depth, u, v]| ScreenVertex::new(x, y, depth, w, DVec2::new(u, v)));
    Ok(ScreenTriangle { vertices: [a?, b?, c?] })
}

/// What one of our engines interpolates.
fn values(
    engine: Engine,
    triangles: &[[Corner; 3]],
    window: PixelRect,
) -> Result<Values, NoAnswer> {
    let mut frame = Frame::new(window, None);
    for &corners in triangles {
        engine.fragments(&triangle(corners)?, window, |f| keep(&mut frame, f));
    }
    Ok(frame)
}

/// What published code interpolates.
fn published(
    specimen: &dyn Published,
    triangles: &[[Corner; 3]],
    window: PixelRect,
) -> Result<Values, NoAnswer> {
    let mut frame = Frame::new(window, None);
    for &corners in triangles {
        let triangle = from_screen(&triangle(corners)?);
        specimen.fragments(&triangle, window, &mut |f| keep(&mut frame, f))?;
    }
    Ok(frame)
}

/// A fragment takes the place of the one before in its pixel: nothing is compared.
fn keep(frame: &mut Values, f: Fragment<DVec2>) {
    frame.span_mut(f.y_px, f.x_px, f.x_px + 1)[0] = Some(f);
}

/// The first of the fragments whose centres are nearest to a position.
fn nearest_fragment(frame: &Values, position: Point) -> Option<Fragment<DVec2>> {
    let (mut nearest, mut least) = (None, f64::INFINITY);
    for (_, row) in frame.rows() {
        for fragment in row.iter().flatten() {
            let centre: DVec2 = centre([fragment.x_px, fragment.y_px]).into();
            let far = centre.distance(position.into());
            if far < least {
                (nearest, least) = (Some(*fragment), far);
            }
        }
    }
    nearest
}

/// The letters of three corners with the values there.
fn label_corners(drawing: &mut Drawing, panel: &Panel, [a, b, c]: [Point; 3]) {
    // Words stand where they hide no pixel.
    for (corner, anchor, [dx, dy], says) in [
        (a, "end", [-6.0, 4.0], "A 100"),
        (b, "middle", [0.0, -8.0], "B 20"),
        (c, "end", [-6.0, 14.0], "C 60"),
    ] {
        let [x, y] = panel.place(corner);
        drawing.text([x + dx, y + dy], anchor, says);
    }
}

/// The weights of the corners at a pixel, as areas. Asks for that of A: the share of the part opposite to it.
pub(super) fn weights(given: &FigureInput<'_>) -> Result<LiveFigure, NoAnswer> {
    let p = given.at[0];
    let corners = [[0.0, 0.0], [8.0, 0.0], [0.0, 8.0]];
    let panel = Panel::middle(9, 8, 28.0, 26.0);
    let pixel = p.map(|v| v.floor() as i32);
    // Each edge function there is twice the area of the part between the edge and P.
    let edges = edges_at(&snapped_triangle(&corners)?, pixel[0], pixel[1]);
    let edges = edges.ok_or("the triangle has no area")?.map(|edge| edge.value);
    let sum: i128 = edges.iter().sum();
    let shares = edges.map(|edge| edge as f64 / sum as f64);
    // The values 100, 20 and 60 as parts of 100.
    let [a, b, c] = corners;
    let valued = [[a, [1.0, 0.0]], [b, [0.2, 0.0]], [c, [0.6, 0.0]]]
        .map(|[[x, y], [u, v]]| [x, y, 1.0, 0.0, u, v]);
    let frame = values(given.fill, &[valued], panel.window)?;
    let fragment = frame.get(pixel[0], pixel[1]).flatten();
    let mut drawing = Drawing::new(panel.bottom() + 26.0, given.is_answered);
    // The three parts, in the colours of the corners opposite to them.
    if given.is_answered && fragment.is_some() {
        for (part, class) in [([p, b, c], "one"), ([p, c, a], "two"), ([p, a, b], "twice")] {
            drawing.outline(&panel, class, &part, true);
        }
    }
    // The lines that part the triangle go beyond it where P does.
    drawing.grid(&panel);
    drawing.outline(&panel, "ink", &corners, true);
    if given.is_answered {
        for corner in corners {
            drawing.outline(&panel, "soft", &[p, corner], false);
        }
    }
    label_corners(&mut drawing, &panel, corners);
    drawing.named_grip(panel.place(p), [panel.unit; 2], "P");
    let [wa, wb, wc] = shares.map(|share| number(share * 100.0, 2));
    // Twice the areas in square pixels: a subpixel is 1/256 px wide.
    let [pa, pb, pc] = edges.map(|edge| number(edge as f64 / 65536.0, 2));
    // Outside of the triangle no engine has a value, and the plane through the three goes on.
    let value = match fragment {
        Some(fragment) => fragment.varying.x * 100.0,
        None => 100.0 * shares[0] + 20.0 * shares[1] + 60.0 * shares[2],
    };
    Ok(LiveFigure {
        drawing,
        predict: Predict::Number(shares[0] * 100.0, 0),
        values: vec![
            ("wa", wa),
            ("wb", wb),
            ("wc", wc),
            ("pa", pa),
            ("pb", pb),
            ("pc", pc),
            ("value", number(value, 2)),
        ],
        link: with_triangles(
            "weights",
            &[[[0.0, 0.0, 1.0, 0.0, 1.0], [8.0, 0.0, 1.0, 0.0, 0.2], [0.0, 8.0, 1.0, 0.0, 0.6]]],
            &format!("&window=0,0,9,8&px={},{}", pixel[0], pixel[1]),
        ),
    })
}

/// Colours that wander to another corner, since each weight is given to a wrong one. Asks at which corner the picture is red,
/// which belongs to A.
pub(super) fn wrong_corner(given: &FigureInput<'_>) -> Result<LiveFigure, NoAnswer> {
    let corners = [given.at[0], [6.0, 1.0], [10.5, 8.5]];
    let colours = [[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]];
    let valued = [0, 1, 2].map(|i| {
        let ([x, y], [u, v]) = (corners[i], colours[i]);
        [x, y, 1.0, 0.0, u, v]
    });
    // Published code on the left, the engine beside it.
    let left = Panel::new([9.0, 30.0], 14.0, [0, 0, 12, 11]);
    let right = Panel { corner: [183.0, 30.0], ..left };
    let wrong = published(&SysuWeights, &[valued], left.window)?;
    let ours = values(given.fill, &[valued], left.window)?;
    let mut drawing = Drawing::new(left.bottom() + 30.0, given.is_answered);
    for (panel, frame) in [(&left, &wrong), (&right, &ours)] {
        for pixel in panel.pixels() {
            if let Some(Some(fragment)) = frame.get(pixel[0], pixel[1]) {
                // The values are red and green; blue is what is left of the weights.
                let DVec2 { x, y } = fragment.varying;
                drawing.colour(panel, pixel, DVec3::new(x, y, 1.0 - x - y));
            }
        }
        drawing.grid(panel);
        drawing.outline(panel, "ink", &corners, true);
        // Above the corner in the middle, below the others.
        for (corner, (letter, dy)) in corners.iter().zip([("A", 22.0), ("B", -8.0), ("C", 20.0)]) {
            let [x, y] = panel.place(*corner);
            drawing.text([x, y + dy], "middle", letter);
        }
    }
    drawing.grip(left.place(corners[0]), [left.unit; 2]);
    // The reddest of the pixels nearest to the corners; of two that are as red, the last one.
    let (mut red, mut most) = (0, f64::NEG_INFINITY);
    for (i, corner) in corners.into_iter().enumerate() {
        let redness = nearest_fragment(&wrong, corner).map_or(0.0, |f| f.varying.x);
        if redness >= most {
            (red, most) = (i, redness);
        }
    }
    Ok(LiveFigure {
        drawing,
        predict: Predict::Choice(red),
        values: vec![("red", ["A", "B", "C"][red].to_owned())],
        link: with_triangles("weights", &[valued], "&window=0,0,12,11&by=sysu-weights,scanline"),
    })
}

/// Whether a fragment lies in a dark square of a board of 4 x 4 squares.
fn is_dark(f: Fragment<DVec2>) -> bool {
    let [column, row] = [f.varying.x, f.varying.y].map(|v| (v * 4.0 + 1e-9).floor());
    (column + row) % 2.0 != 0.0
}

/// A floor whose pattern is interpolated without w, beside the right one. Asks where the lines of the pattern have a kink: along
/// the diagonal, unless w is 1 everywhere.
pub(super) fn affine_kink(given: &FigureInput<'_>) -> Result<LiveFigure, NoAnswer> {
    let far = given.at[0][0];
    // Each corner with x, y, w, depth, u and v: u across the floor, v away from the eye.
    let floor = [
        [2.0, 29.0, 1.0, 0.0, 0.0, 0.0],
        [12.0, 4.0, far, 0.0, 0.0, 1.0],
        [20.0, 4.0, far, 0.0, 1.0, 1.0],
        [30.0, 29.0, 1.0, 0.0, 1.0, 0.0],
    ];
    let [a, b, c, d] = floor;
    let triangles = [[a, b, c], [a, c, d]];
    let left = Panel::new([10.0, 10.0], 5.0, [0, 0, 32, 32]);
    let right = Panel { corner: [190.0, 10.0], ..left };
    let affine = published(&BookAffine, &triangles, left.window)?;
    let ours = values(given.fill, &triangles, left.window)?;
    let mut drawing = Drawing::new(left.bottom() + 44.0, given.is_answered);
    // How many pixels have a square of the other colour, or of none.
    let mut differ = 0;
    for pixel in left.pixels() {
        let [wrong, right_one] =
            [&affine, &ours].map(|frame| frame.get(pixel[0], pixel[1]).flatten().map(is_dark));
        differ += usize::from(wrong != right_one);
        // A pixel outside of the floor stays empty.
        for (panel, dark) in [(&left, wrong), (&right, right_one)] {
            if let Some(dark) = dark {
                drawing.pixel(panel, pixel, if dark { "dark" } else { "pale" }, "");
            }
        }
    }
    // The diagonal, at which the two triangles meet, is seen only before the answer.
    for panel in [&left, &right] {
        drawing.outline(panel, "ink", &floor.map(|[x, y, ..]| [x, y]), true);
        if !given.is_answered {
            drawing.outline(panel, "soft", &[[2.0, 29.0], [20.0, 4.0]], false);
        }
    }
    drawing.slider(given, 0, left.bottom() + 24.0, &format!("w = {}", number(far, 2)));
    Ok(LiveFigure {
        drawing,
        // The first option is the diagonal, the third that there is none.
        predict: Predict::Choice(if far == 1.0 { 2 } else { 0 }),
        values: vec![("differ", differ.to_string())],
        link: with_triangles(
            "perspective",
            &triangles,
            "&window=0,0,32,32&by=book-affine,scanline",
        ),
    })
}

/// The pixels along an edge: its value by the share on the screen, and by the share in space. Asks for that in the middle of the
/// picture.
pub(super) fn value_midway(given: &FigureInput<'_>) -> Result<LiveFigure, NoAnswer> {
    let far = given.at[0][0];
    let pairs = along(given.pen, [1.0, far], 12)?;
    let mut drawing = Drawing::new(200.0, given.is_answered);
    // The seventh of 13 pixels is the middle on the screen.
    let middle = pairs[6][1];
    // The shares on the screen are evenly spaced, those in space are not.
    for (row, top, says) in [(0, 34.0, "v"), (1, 100.0, "(v/w) / (1/w)")] {
        let panel = Panel::middle(13, 1, 26.0, top);
        for (x, pair) in (0..).zip(&pairs) {
            drawing.colour(&panel, [x, 0], DVec3::splat(pair[row]));
        }
        drawing.grid(&panel);
        drawing.text([12.0, top - 8.0], "start", says);
        drawing.middle_mark(&panel);
    }
    drawing.slider(given, 0, 176.0, &format!("w = {}", number(far, 1)));
    Ok(LiveFigure {
        drawing,
        predict: Predict::Number(middle * 100.0, 0),
        values: vec![("value", number(middle * 100.0, 0))],
        link: None,
    })
}

/// A rod from above. Asks in which pixel its middle appears: not in the middle of the picture unless both ends are equally far.
pub(super) fn rod_middle(given: &FigureInput<'_>) -> Result<LiveFigure, NoAnswer> {
    let (near, far) = (given.at[0][0], given.at[1][0]);
    let shares = along(given.pen, [near, far], 12)?;
    // The pixel whose share of the way in space is nearest to a half.
    let (mut right, mut least) = (0, f64::INFINITY);
    for (x, [_, in_space]) in (0..).zip(&shares) {
        let off = (in_space - 0.5).abs();
        if off < least {
            (right, least) = (x, off);
        }
    }
    // The eye looks along z through the film at z = 1.
    let space = FromAbove { eye: [172.0, 188.0], unit: 24.0 };
    // Each pixel has the colour of the half of the rod that it shows.
    let panel = Panel::middle(13, 1, 26.0, 212.0);
    let mut drawing = Drawing::new(panel.bottom() + 10.0, given.is_answered);
    for (x, pair) in (0..).zip(&shares) {
        let class = if x == right {
            "twice"
        } else if pair[1] < 0.5 {
            "one"
        } else {
            "two"
        };
        drawing.pixel(&panel, [x, 0], class, "");
    }
    drawing.grid(&panel);
    for (end, column) in [(-1.0, 0.0), (1.0, 13.0)] {
        drawing.path("grid", &[space.place(end, 1.0), panel.place([column, 0.0])], false);
        drawing.path("soft", &[space.place(0.0, 0.0), space.place(end * 7.0, 7.0)], false);
    }
    drawing.path("ink", &[space.place(-1.0, 1.0), space.place(1.0, 1.0)], false);
    // The ends of the rod lie on the borders of what the eye sees, so that it fills the picture.
    let (a, b) = (space.place(-near, near), space.place(far, far));
    drawing.path("ink", &[a, b], false);
    drawing.dot(space.place(0.0, 0.0), 4.0);
    // In space the middle is the mean of the ends; the ray from it to the eye says where it appears.
    let middle = [(a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0];
    drawing.dot(middle, 4.0);
    drawing.text([middle[0] + 4.0, middle[1] - 8.0], "middle", "m");
    if given.is_answered {
        drawing.path("soft", &[middle, space.place(0.0, 0.0)], false);
    }
    drawing.grip(a, [-24.0, 0.0]);
    drawing.grip(b, [24.0, 0.0]);
    // From the left: in space t = 1 / 2 where t' / far = (1 - t') / near on the screen.
    let share = far / (near + far);
    Ok(LiveFigure {
        drawing,
        predict: Predict::among(panel, &[[right, 0]]),
        values: vec![("share", number(share * 100.0, 0))],
        link: None,
    })
}

/// A flat quadrangle over a row of pixels in two triangles, with depths at its left and right ends.
fn quad(width: f64, [left, right]: [f64; 2]) -> [[Corner; 3]; 2] {
    let corner = |x: f64, y: f64, depth: f64| [x, y, 1.0, depth, 0.0, 0.0];
    let [a, b] = [corner(0.0, 0.0, left), corner(width, 0.0, right)];
    let [c, d] = [corner(width, 1.0, right), corner(0.0, 1.0, left)];
    [[a, b, c], [a, c, d]]
}

/// The stored depths of a surface in a row of pixels, with depths at its left and right ends.
fn depth_keys(engine: Engine, ends: [f64; 2], panel: &Panel) -> Result<Vec<u64>, NoAnswer> {
    let width = f64::from(panel.window.width());
    let frame = values(engine, &quad(width, ends), panel.window)?;
    let mut keys = Vec::new();
    for fragment in frame.row(panel.window.y0) {
        // Where the surface is not, everything is nearer.
        keys.push(fragment.map_or(u64::MAX, |f| DepthFormat::Unorm24.key(f.depth)));
    }
    Ok(keys)
}

/// In which pixels of a row the depth buffer shows the second of two surfaces, which is drawn over the first.
fn in_front(
    engine: Engine,
    first: [f64; 2],
    second: [f64; 2],
    panel: &Panel,
) -> Result<Vec<bool>, NoAnswer> {
    let (stored, new) = (depth_keys(engine, first, panel)?, depth_keys(engine, second, panel)?);
    Ok(stored.iter().zip(&new).map(|(stored, key)| key < stored).collect())
}

/// The address of the scene with both surfaces. Depths differ in their last bits, so no digit is left out.
fn depth_link(width: u32, first: [f64; 2], second: [f64; 2]) -> String {
    let quads = [quad(width.into(), first), quad(width.into(), second)];
    let mut triangles = Vec::new();
    for corners in quads.as_flattened() {
        triangles.push(corners.map(|[x, y, w, depth, ..]| [x, y, w, depth]));
    }
    let list = in_address(&triangles, |value| value.to_string());
    format!("#scene=depth&window=0,0,{width},4&t={list}")
}

/// The depth of a distance between the near plane at 10 and the far plane at 200: 0 at 10, 1 at 200.
fn depth_of(z: f64) -> f64 {
    200.0 / 190.0 * (1.0 - 10.0 / z)
}

/// The class and the letter of the slanted surface A, or of the upright one B.
fn paint(is_b: bool) -> (&'static str, &'static str) {
    if is_b { ("two", "B") } else { ("one", "A") }
}

/// A slanted surface and an upright one. Asks in which pixels the upright one is seen, as the depth buffer says; a second row
/// shows what the painter's order makes of it.
pub(super) fn nearer(given: &FigureInput<'_>) -> Result<LiveFigure, NoAnswer> {
    let b = given.at[0][1];
    // Half a pixel outside of the first and the last of the distances below: 1 / z is linear on the screen.
    let a_ends = [60.0 / 5.5, 120.0];
    let distances = [12.0, 15.0, 20.0, 30.0, 60.0];
    let panel = Panel::middle(5, 1, 44.0, 170.0);
    let painter = Panel { corner: [panel.corner[0], 232.0], ..panel };
    // From above, 2 px of the drawing for a unit of distance.
    let up = |z: f64| 150.0 - z * 2.0;
    // The painter draws what is farther in the mean first. So does the depth buffer here, in which the first stays at a tie.
    let is_b_last = b < distances.iter().sum::<f64>() / 5.0;
    // The values of a depth buffer are linear on the screen, so those of the ends make the whole surface.
    let mut order = [a_ends.map(depth_of), [depth_of(b); 2]];
    if !is_b_last {
        order.reverse();
    }
    let shows_last = in_front(given.fill, order[0], order[1], &panel)?;
    // Above what the depth buffer shows, below what the painter does.
    let mut drawing = Drawing::new(painter.bottom() + 10.0, given.is_answered);
    let (mut wrong, mut shows_b) = (0, Vec::new());
    for (x, is_last) in (0..).zip(shows_last) {
        let is_b = is_last == is_b_last;
        let (class, letter) = paint(is_b);
        drawing.pixel(&panel, [x, 0], class, letter);
        let (class, letter) = paint(is_b_last);
        drawing.pixel(&painter, [x, 0], class, letter);
        wrong += usize::from(is_b != is_b_last);
        shows_b.push(is_b);
    }
    // From above: lines at some distances, A through the middles of its pixels, B across all.
    let [left, _] = panel.corner;
    let right = left + 5.0 * panel.unit;
    for z in [10.0, 30.0, 50.0] {
        drawing.path("grid", &[[left, up(z)], [right, up(z)]], false);
        drawing.text([left - 6.0, up(z) + 5.0], "end", &number(z, 0));
    }
    let mut slanted = Vec::new();
    for (x, z) in (0..).zip(distances) {
        slanted.push([left + (f64::from(x) + 0.5) * panel.unit, up(z)]);
    }
    drawing.path("ink", &slanted, false);
    for point in &slanted {
        drawing.dot(*point, 3.0);
    }
    drawing.text([slanted[4][0] + 10.0, slanted[4][1] + 16.0], "start", "A");
    drawing.path("ink", &[[left, up(b)], [right, up(b)]], false);
    drawing.named_grip([right, up(b)], [0.0, -2.0], "B");
    drawing.grid(&panel);
    if given.is_answered {
        drawing.grid(&painter);
    }
    Ok(LiveFigure {
        drawing,
        predict: Predict::Pixels(panel, shows_b),
        values: vec![
            ("last", if is_b_last { "B" } else { "A" }.to_owned()),
            ("wrong", wrong.to_string()),
        ],
        link: Some(depth_link(5, order[0], order[1])),
    })
}

/// Two surfaces less than a step of the stored depth apart. Asks in how many of 16 pixels the nearer one is seen.
pub(super) fn z_fighting(given: &FigureInput<'_>) -> Result<LiveFigure, NoAnswer> {
    let gap = given.at[0][0];
    let step = 1.0 / f64::from((1u32 << 24) - 1);
    // The depth rises by 0.3 of a step from pixel to pixel.
    let first = [0.9, 0.9 + 16.0 * 0.3 * step];
    // Nearer by a gap that is the same in each pixel.
    let second = first.map(|depth| depth - gap * step);
    let panel = Panel::middle(16, 1, 21.0, 20.0);
    // The farther one is drawn first and stays wherever both are stored alike.
    let shows_near = in_front(given.fill, first, second, &panel)?;
    let mut drawing = Drawing::new(panel.bottom() + 54.0, given.is_answered);
    for (x, &is_near) in (0..).zip(&shows_near) {
        let (class, letter) = if is_near { ("one", "N") } else { ("two", "F") };
        drawing.pixel(&panel, [x, 0], class, letter);
    }
    drawing.grid(&panel);
    drawing.slider(given, 0, panel.bottom() + 30.0, &format!("Δ = {}", number(gap, 2)));
    let seen = count(&shows_near);
    Ok(LiveFigure {
        drawing,
        predict: Predict::Number(seen as f64, 0),
        values: vec![("seen", seen.to_string()), ("share", number(seen as f64 / 16.0, 2))],
        link: Some(depth_link(16, first, second)),
    })
}
