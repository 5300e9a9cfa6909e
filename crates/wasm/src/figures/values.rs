//! Figures about values of pixels: weights, perspective, depth.

use glam::DVec2;

use super::drawing::{Drawing, Panel, Point};
use super::{FigureInput, LiveFigure, Predict, number, snapped, with_triangles};
use crate::answer::along;
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

fn triangle(corners: [Corner; 3]) -> Result<ScreenTriangle<DVec2>, String> {
    let vertex = |[x, y, w, depth, u, v]: Corner| {
        ScreenVertex::new(x, y, depth, w, DVec2::new(u, v)).map_err(|refusal| refusal.to_string())
    };
    let [a, b, c] = corners;
    Ok(ScreenTriangle { vertices: [vertex(a)?, vertex(b)?, vertex(c)?] })
}

/// The fragments of triangles in a window, the last one of each pixel.
fn values(
    engine: Engine,
    triangles: &[[Corner; 3]],
    window: PixelRect,
) -> Result<Frame<Option<Fragment<DVec2>>>, String> {
    let mut frame = Frame::new(window, None);
    for &corners in triangles {
        engine.fragments(&triangle(corners)?, window, |f| keep(&mut frame, f));
    }
    Ok(frame)
}

fn published(
    specimen: &dyn Published,
    triangles: &[[Corner; 3]],
    window: PixelRect,
) -> Result<Frame<Option<Fragment<DVec2>>>, String> {
    let mut frame = Frame::new(window, None);
    for &corners in triangles {
        specimen
            .fragments(&from_screen(&triangle(corners)?), window, &mut |f| keep(&mut frame, f))
            .map_err(|refused| refused.to_string())?;
    }
    Ok(frame)
}

fn keep(frame: &mut Frame<Option<Fragment<DVec2>>>, f: Fragment<DVec2>) {
    frame.span_mut(f.y_px, f.x_px, f.x_px + 1)[0] = Some(f);
}

fn grey(value: f64) -> glam::DVec3 {
    glam::DVec3::splat(value)
}

/// The weights of the corners at a pixel, as areas.
pub(super) fn weights(given: &FigureInput<'_>) -> Result<LiveFigure, String> {
    let p = given.at[0];
    let corners = [[0.0, 0.0], [8.0, 0.0], [0.0, 8.0]];
    let panel = Panel::middle(9, 8, 28.0, 26.0);
    let pixel = p.map(|v| v.floor() as i32);
    let edges = edges_at(&snapped(&[corners])?[0], pixel[0], pixel[1]);
    let edges = edges.ok_or_else(|| "the triangle has no area".to_owned())?.map(|e| e.value);
    let sum: i128 = edges.iter().sum();
    let shares = edges.map(|edge| edge as f64 / sum as f64);
    // The values 100, 20 and 60 as parts of 100.
    let [a, b, c] = corners;
    let valued = [[a, [1.0, 0.0]], [b, [0.2, 0.0]], [c, [0.6, 0.0]]]
        .map(|[[x, y], [u, v]]| [x, y, 1.0, 0.0, u, v]);
    let frame = values(given.fill, &[valued], panel.window)?;
    let value = frame.get(pixel[0], pixel[1]).flatten().map(|f| f.varying.x);
    let mut drawing = Drawing::new(panel.bottom() + 26.0, given.is_answered);
    if given.is_answered && value.is_some() {
        for (part, class) in [([p, b, c], "one"), ([p, c, a], "two"), ([p, a, b], "twice")] {
            drawing.outline(&panel, class, &part, true);
        }
    }
    drawing.grid(&panel);
    drawing.outline(&panel, "ink", &corners, true);
    if given.is_answered {
        for corner in corners {
            drawing.outline(&panel, "soft", &[p, corner], false);
        }
    }
    for (corner, anchor, [dx, dy], says) in [
        (a, "end", [-6.0, 4.0], "A 100"),
        (b, "middle", [0.0, -8.0], "B 20"),
        (c, "end", [-6.0, 14.0], "C 60"),
    ] {
        let [x, y] = panel.place(corner);
        drawing.text([x + dx, y + dy], anchor, says);
    }
    drawing.named_grip(panel.place(p), [panel.unit; 2], "P");
    let [wa, wb, wc] = shares.map(|share| number(share * 100.0, 2));
    // Twice the areas in square pixels: a subpixel is 1/256 px wide.
    let [pa, pb, pc] = edges.map(|edge| number(edge as f64 / 65536.0, 2));
    let plane = 100.0 * shares[0] + 20.0 * shares[1] + 60.0 * shares[2];
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
            ("value", number(value.map_or(plane, |value| value * 100.0), 2)),
        ],
        link: with_triangles(
            "weights",
            &[[[0.0, 0.0, 1.0, 0.0, 1.0], [8.0, 0.0, 1.0, 0.0, 0.2], [0.0, 8.0, 1.0, 0.0, 0.6]]],
            &format!("&window=0,0,9,8&px={},{}", pixel[0], pixel[1]),
        ),
    })
}

/// Colours that wander to another corner, since each weight is given to a wrong one.
pub(super) fn wrong_corner(given: &FigureInput<'_>) -> Result<LiveFigure, String> {
    let corners = [given.at[0], [6.0, 1.0], [10.5, 8.5]];
    let colours = [[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]];
    let valued = [0, 1, 2].map(|i| {
        let ([x, y], [u, v]) = (corners[i], colours[i]);
        [x, y, 1.0, 0.0, u, v]
    });
    let left = Panel::new([9.0, 30.0], 14.0, [0, 0, 12, 11]);
    let right = Panel { corner: [183.0, 30.0], ..left };
    let wrong = published(&SysuWeights, &[valued], left.window)?;
    let ours = values(given.fill, &[valued], left.window)?;
    let mut drawing = Drawing::new(left.bottom() + 30.0, given.is_answered);
    for (panel, frame) in [(&left, &wrong), (&right, &ours)] {
        for pixel in panel.pixels() {
            if let Some(DVec2 { x, y }) = frame.get(pixel[0], pixel[1]).flatten().map(|f| f.varying)
            {
                drawing.colour(panel, pixel, glam::DVec3::new(x, y, 1.0 - x - y));
            }
        }
        drawing.grid(panel);
        drawing.outline(panel, "ink", &corners, true);
        for (corner, (letter, dy)) in corners.iter().zip([("A", 22.0), ("B", -8.0), ("C", 20.0)]) {
            let [x, y] = panel.place(*corner);
            drawing.text([x, y + dy], "middle", letter);
        }
    }
    drawing.grip(left.place(corners[0]), [left.unit; 2]);
    // The pixel nearest to each corner, and how red it is.
    let redness = corners.map(|corner| {
        let fragments = left.pixels().filter_map(|p| wrong.get(p[0], p[1]).flatten());
        let far = |f: &Fragment<DVec2>| {
            DVec2::new(f64::from(f.x_px) + 0.5, f64::from(f.y_px) + 0.5).distance(corner.into())
        };
        fragments.min_by(|a, b| far(a).total_cmp(&far(b))).map_or(0.0, |f| f.varying.x)
    });
    let red = (0..3).max_by(|&a, &b| redness[a].total_cmp(&redness[b])).unwrap_or(0);
    Ok(LiveFigure {
        drawing,
        predict: Predict::Choice(red),
        values: vec![("red", ["A", "B", "C"][red].to_owned())],
        link: with_triangles("weights", &[valued], "&window=0,0,12,11&by=sysu-weights,scanline"),
    })
}

/// A floor whose pattern is interpolated without w, beside the right one.
pub(super) fn affine_kink(given: &FigureInput<'_>) -> Result<LiveFigure, String> {
    let far = given.at[0][0];
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
    let is_dark = |f: Fragment<DVec2>| {
        ((f.varying.x * 4.0 + 1e-9).floor() + (f.varying.y * 4.0 + 1e-9).floor()) % 2.0 != 0.0
    };
    let mut drawing = Drawing::new(left.bottom() + 44.0, given.is_answered);
    let mut differ = 0;
    for pixel in left.pixels() {
        let [wrong, right_one] =
            [&affine, &ours].map(|frame| frame.get(pixel[0], pixel[1]).flatten().map(is_dark));
        differ += usize::from(wrong != right_one);
        for (panel, dark) in [(&left, wrong), (&right, right_one)] {
            if let Some(dark) = dark {
                drawing.pixel(panel, pixel, if dark { "dark" } else { "pale" }, "");
            }
        }
    }
    for panel in [&left, &right] {
        drawing.outline(panel, "ink", &floor.map(|[x, y, ..]| [x, y]), true);
        if !given.is_answered {
            drawing.outline(panel, "soft", &[[2.0, 29.0], [20.0, 4.0]], false);
        }
    }
    drawing.slider(given, 0, left.bottom() + 24.0, &format!("w = {}", number(far, 2)));
    Ok(LiveFigure {
        drawing,
        predict: Predict::Choice(if far == 1.0 { 2 } else { 0 }),
        values: vec![("differ", differ.to_string())],
        link: with_triangles(
            "perspective",
            &triangles,
            "&window=0,0,32,32&by=book-affine,scanline",
        ),
    })
}

/// The pixels along an edge: its value by the share on the screen, and by the share in space.
pub(super) fn value_midway(given: &FigureInput<'_>) -> Result<LiveFigure, String> {
    let far = given.at[0][0];
    let pairs = along(given.pen, [1.0, far], 12)?;
    let mut drawing = Drawing::new(200.0, given.is_answered);
    let middle = pairs[6][1];
    for (row, top, says) in [(0, 34.0, "v"), (1, 100.0, "(v/w) / (1/w)")] {
        let panel = Panel::middle(13, 1, 26.0, top);
        for (x, pair) in (0..).zip(&pairs) {
            drawing.colour(&panel, [x, 0], grey(pair[row]));
        }
        drawing.grid(&panel);
        drawing.text([12.0, top - 8.0], "start", says);
        let [x, y] = panel.place([6.5, 1.0]);
        drawing.path("ink", &[[x - 6.0, y + 12.0], [x, y + 3.0], [x + 6.0, y + 12.0]], true);
    }
    drawing.slider(given, 0, 176.0, &format!("w = {}", number(far, 1)));
    Ok(LiveFigure {
        drawing,
        predict: Predict::Number(middle * 100.0, 0),
        values: vec![("value", number(middle * 100.0, 0))],
        link: None,
    })
}

/// A rod from above, and where its middle appears in the picture.
pub(super) fn rod_middle(given: &FigureInput<'_>) -> Result<LiveFigure, String> {
    let (near, far) = (given.at[0][0], given.at[1][0]);
    let shares = along(given.pen, [near, far], 12)?;
    let off = |pair: &[f64; 2]| (pair[1] - 0.5).abs();
    let right = (0..13).min_by(|&a, &b| off(&shares[a]).total_cmp(&off(&shares[b]))).unwrap_or(0);
    // From above: x to the right, z up; the eye looks along z through the film at z = 1.
    let above = |x: f64, z: f64| [172.0 + x * 24.0, 188.0 - z * 24.0];
    let panel = Panel::middle(13, 1, 26.0, 212.0);
    let mut drawing = Drawing::new(panel.bottom() + 10.0, given.is_answered);
    for (x, pair) in (0..).zip(&shares) {
        let class = if x == right as i32 {
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
        drawing.path("grid", &[above(end, 1.0), panel.place([column, 0.0])], false);
        drawing.path("soft", &[above(0.0, 0.0), above(end * 7.0, 7.0)], false);
    }
    drawing.path("ink", &[above(-1.0, 1.0), above(1.0, 1.0)], false);
    let (a, b) = (above(-near, near), above(far, far));
    drawing.path("ink", &[a, b], false);
    drawing.dot(above(0.0, 0.0), 4.0);
    let middle = [(a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0];
    drawing.dot(middle, 4.0);
    drawing.text([middle[0] + 4.0, middle[1] - 8.0], "middle", "m");
    if given.is_answered {
        drawing.path("soft", &[middle, above(0.0, 0.0)], false);
    }
    drawing.grip(a, [-24.0, 0.0]);
    drawing.grip(b, [24.0, 0.0]);
    let share = far / (near + far);
    Ok(LiveFigure {
        drawing,
        predict: Predict::Pixels(panel, (0..13).map(|x| ([x, 0], x == right as i32)).collect()),
        values: vec![("share", number(share * 100.0, 0))],
        link: None,
    })
}

/// Two flat quads over a row of pixels, with depths at their left and right ends.
fn quad(width: f64, [left, right]: [f64; 2]) -> [[Corner; 3]; 2] {
    let corner = |x: f64, y: f64, depth: f64| [x, y, 1.0, depth, 0.0, 0.0];
    let [a, b] = [corner(0.0, 0.0, left), corner(width, 0.0, right)];
    let [c, d] = [corner(width, 1.0, right), corner(0.0, 1.0, left)];
    [[a, b, c], [a, c, d]]
}

/// Which of two surfaces the depth buffer shows in each pixel of a row; `first` is drawn first.
fn in_front(
    engine: Engine,
    first: [f64; 2],
    second: [f64; 2],
    panel: &Panel,
) -> Result<Vec<bool>, String> {
    let width = f64::from(panel.window.width());
    let keys = |depths| -> Result<Vec<u64>, String> {
        let frame = values(engine, &quad(width, depths), panel.window)?;
        let key =
            |x| frame.get(x, 0).flatten().map_or(u64::MAX, |f| DepthFormat::Unorm24.key(f.depth));
        Ok((panel.window.x0..panel.window.x1).map(key).collect())
    };
    let (first, second) = (keys(first)?, keys(second)?);
    Ok(first.iter().zip(&second).map(|(stored, key)| key < stored).collect())
}

fn depth_link(width: u32, first: [f64; 2], second: [f64; 2]) -> String {
    let width = f64::from(width);
    let quads = [quad(width, first), quad(width, second)].concat();
    let corner = |c: &Corner| format!("{},{},1,{}", c[0], c[1], c[3]);
    let triangle = |t: &[Corner; 3]| t.iter().map(corner).collect::<Vec<_>>().join("_");
    let all: Vec<_> = quads.iter().map(triangle).collect();
    format!("#scene=depth&window=0,0,{width},4&t={}", all.join(";"))
}

/// A slanted surface and an upright one, pixel by pixel.
pub(super) fn nearer(given: &FigureInput<'_>) -> Result<LiveFigure, String> {
    let b = given.at[0][1];
    // With the near plane at 10 and the far plane at 200: 0 at 10, 1 at 200.
    let depth = |z: f64| 200.0 / 190.0 * (1.0 - 10.0 / z);
    let a_ends = [60.0 / 5.5, 120.0];
    let distances = [12.0, 15.0, 20.0, 30.0, 60.0];
    let panel = Panel::middle(5, 1, 44.0, 170.0);
    let painter = Panel { corner: [panel.corner[0], 232.0], ..panel };
    let up = |z: f64| 150.0 - z * 2.0;
    // The painter draws what is farther in the mean first. So does the depth buffer here, in which the first stays at a tie.
    let is_b_last = b < distances.iter().sum::<f64>() / 5.0;
    let mut order = [a_ends.map(depth), [depth(b); 2]];
    if !is_b_last {
        order.reverse();
    }
    let shows_last = in_front(given.fill, order[0], order[1], &panel)?;
    let shows_b: Vec<_> = shows_last.iter().map(|&is_last| is_last == is_b_last).collect();
    let mut drawing = Drawing::new(painter.bottom() + 10.0, given.is_answered);
    let mut wrong = 0;
    for (x, &is_b) in (0..).zip(&shows_b) {
        let paint = |is_b: bool| if is_b { ("two", "B") } else { ("one", "A") };
        let (class, letter) = paint(is_b);
        drawing.pixel(&panel, [x, 0], class, letter);
        let (class, letter) = paint(is_b_last);
        drawing.pixel(&painter, [x, 0], class, letter);
        wrong += usize::from(is_b != is_b_last);
    }
    let [left, _] = panel.corner;
    let right = left + 5.0 * panel.unit;
    for z in [10.0, 30.0, 50.0] {
        drawing.path("grid", &[[left, up(z)], [right, up(z)]], false);
        drawing.text([left - 6.0, up(z) + 5.0], "end", &number(z, 0));
    }
    let at = |i: usize, z: f64| [left + (i as f64 + 0.5) * panel.unit, up(z)];
    let slanted: Vec<Point> = distances.iter().enumerate().map(|(i, &z)| at(i, z)).collect();
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
        predict: Predict::Pixels(panel, (0..).zip(&shows_b).map(|(x, &is)| ([x, 0], is)).collect()),
        values: vec![
            ("last", if is_b_last { "B" } else { "A" }.to_owned()),
            ("wrong", wrong.to_string()),
        ],
        link: Some(depth_link(5, order[0], order[1])),
    })
}

/// Two surfaces less than a step of the stored depth apart.
pub(super) fn z_fighting(given: &FigureInput<'_>) -> Result<LiveFigure, String> {
    let gap = given.at[0][0];
    let step = 1.0 / f64::from((1u32 << 24) - 1);
    // The depth rises by 0.3 of a step from pixel to pixel.
    let first = [0.9, 0.9 + 16.0 * 0.3 * step];
    let second = first.map(|depth| depth - gap * step);
    let panel = Panel::middle(16, 1, 21.0, 20.0);
    let shows_near = in_front(given.fill, first, second, &panel)?;
    let mut drawing = Drawing::new(panel.bottom() + 54.0, given.is_answered);
    for (x, &is_near) in (0..).zip(&shows_near) {
        let (class, letter) = if is_near { ("one", "N") } else { ("two", "F") };
        drawing.pixel(&panel, [x, 0], class, letter);
    }
    drawing.grid(&panel);
    drawing.slider(given, 0, panel.bottom() + 30.0, &format!("Δ = {}", number(gap, 2)));
    let seen = shows_near.iter().filter(|&&is_near| is_near).count();
    Ok(LiveFigure {
        drawing,
        predict: Predict::Number(seen as f64, 0),
        values: vec![("seen", seen.to_string()), ("share", number(seen as f64 / 16.0, 2))],
        link: Some(depth_link(16, first, second)),
    })
}
