//! Figures about the stages around a rasterizer: clipping, the window, culling.

use glam::{DMat4, DVec2, DVec3, DVec4};
use serde_json::json;

use super::drawing::{Drawing, FromAbove, Panel, Point, WIDTH};
use super::lines::drawn;
use super::{
    FigureInput, LiveFigure, Predict, count, lacking, number, snapped, snapped_triangle,
    with_triangles,
};
use crate::answer::{Pen, answer_value, cover, strangers};
use crate::no_answer::NoAnswer;
use rasterproof_core::angle::turn_z;
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::PixelRect;
use rasterproof_render::pipeline::ClipVertex;
use rasterproof_render::pipeline::assemble::Viewport;
use rasterproof_render::pipeline::clip::{ClipPlane, clip};
use rasterproof_render::pipeline::transform::{about, frustum};

/// The side of the screen in the figure of the near plane, in pixels.
const SCREEN: u32 = 20;

/// Where space seen from the side begins on the drawing of the near plane, and how large it is.
const ASIDE: Point = [10.0, 30.0];
const ASIDE_SIDE: f64 = 165.0;

/// Space from the side: w to the right, and up as far as a ray to this height of the screen has come.
fn aside(w: f64, y: f64) -> Point {
    let [left, top] = ASIDE;
    [left + (w + 1.5) / 4.5 * ASIDE_SIDE, top + ASIDE_SIDE / 2.0 - y * w.abs() * 32.0]
}

/// A triangle seen from the side, what the near plane leaves of it, and that on the screen. Asks how many corners it then has.
pub(super) fn near_corners(given: &FigureInput<'_>) -> Result<LiveFigure, NoAnswer> {
    let (w, near) = (given.at[0][0], given.at[1][0]);
    let corners = [[-0.7, -0.8, 2.0], [0.8, 0.1, 2.6], [-0.1, 0.8, w]];
    let answer = answer_value(json!({
        "ask": "near", "side_px": SCREEN, "corners": corners, "near": near, "by": given.fill.name(),
    }))?;
    // The first panel is that of our own clipping.
    let kept = &answer["panels"][0];
    let outline: Vec<Point> = serde_json::from_value(kept["outline"].clone())?;
    let ([_, top], side) = (ASIDE, ASIDE_SIDE);
    let panel = Panel {
        corner: [WIDTH - 10.0 - side, top],
        unit: side / f64::from(SCREEN),
        window: PixelRect::window(SCREEN, SCREEN),
    };
    // On the right the screen, with the pixels of what is left and its outline.
    let mut drawing = Drawing::new(top + side + 12.0, given.is_answered);
    drawing.answered_hits(&panel, &kept["hits"]);
    drawing.border(&panel);
    if given.is_answered && !outline.is_empty() {
        drawing.outline(&panel, "ink", &outline, true);
    }
    // The rays to the borders of the screen, the near plane, the triangle, and the eye.
    drawing.path("grid", &[aside(0.0, 0.0), aside(3.0, 0.85)], false);
    drawing.path("grid", &[aside(0.0, 0.0), aside(3.0, -0.85)], false);
    let plane = aside(near, 0.0)[0];
    drawing.path("soft", &[[plane, top], [plane, top + side]], false);
    drawing.path("ink", &corners.map(|[_, y, w]| aside(w, y)), true);
    drawing.dot(aside(0.0, 0.0), 4.0);
    let eye = aside(0.0, 0.0);
    drawing.text([eye[0], eye[1] + 22.0], "middle", "w = 0");
    // The grips move along w alone: corner C at its height, the plane at its lower end.
    let spots = [aside(w, 0.8), [plane, top + side - 8.0]];
    for (spot, letter) in spots.iter().zip(["C", "n"]) {
        drawing.grip(*spot, [side / 4.5, 0.0]);
        drawing.text([spot[0] + 12.0, spot[1] + 1.0], "start", letter);
    }
    Ok(LiveFigure {
        drawing,
        predict: Predict::Number(outline.len() as f64, 0),
        values: vec![
            ("corners", outline.len().to_string()),
            ("covered", kept["covered"].to_string()),
        ],
        link: Some(format!(
            "#scene=near&window=0,0,{SCREEN},{SCREEN}&near={near}&points={}",
            json!(corners)
        )),
    })
}

/// Five equal boards along a road. Asks how tall the third is in the picture: as its distance says, not as its number.
pub(super) fn boards(given: &FigureInput<'_>) -> Result<LiveFigure, NoAnswer> {
    let spacing = given.at[0][0];
    // The window is square; its upper part, where the boards are, is shown.
    let size = PixelRect::window(48, 48);
    let panel = Panel::new([12.0, 10.0], 7.0, [0, 0, 48, 27]);
    let camera = frustum(-1.0, 1.0, -1.0, 1.0, 1.0, 100.0)?;
    let mut drawing = Drawing::new(panel.bottom() + 48.0, given.is_answered);
    let (mut heights, mut link) = (Vec::new(), Vec::new());
    for i in 0..5 {
        let z = 1.0 + spacing * f64::from(i);
        let mut board = [[0.7, 0.0], [0.9, 0.0], [0.9, 1.0], [0.7, 1.0]];
        for corner in &mut board {
            *corner = placed(size, camera * DVec4::new(corner[0], corner[1], z, 1.0))?;
        }
        let triangles = halves(board);
        let hits = cover(given.fill, &snapped(&triangles)?, panel.window);
        // Two colours in turn tell neighbours apart.
        let class = if i % 2 == 0 { "one" } else { "two" };
        // A board is as tall as it has rows with a pixel of it.
        let mut height = 0;
        for (y, row) in hits.rows() {
            for (x, _) in (0..).zip(row).filter(|(_, hits)| **hits > 0) {
                drawing.pixel(&panel, [x, y], class, "");
            }
            height += usize::from(row.iter().any(|hits| *hits > 0));
        }
        heights.push(height);
        link.extend(triangles);
        // The first board is outlined, with which the others are compared.
        if i == 0 {
            drawing.outline(&panel, "ink", &board, true);
        }
    }
    // The boards stand at the height of the eye, so their lower ends are on the horizon.
    let horizon = [[0.0, 24.0], [48.0, 24.0]];
    drawing.outline(&panel, "soft", &horizon, false);
    drawing.border(&panel);
    let says = format!("Δz = {}", number(spacing, 2));
    drawing.slider(given, 0, panel.bottom() + 26.0, &says);
    Ok(LiveFigure {
        drawing,
        predict: Predict::Number(heights[2] as f64, 0),
        // The third board is two spacings behind the first; a size of 1 at z = 1 is 24 px, half the window.
        values: vec![
            ("third", number(1.0 + 2.0 * spacing, 2)),
            ("tall", number(24.0 / (1.0 + 2.0 * spacing), 2)),
            ("first", heights[0].to_string()),
            ("height", heights[2].to_string()),
        ],
        link: with_triangles("triangle", &link, "&window=0,0,48,27"),
    })
}

/// The two triangles of a quadrangle.
fn halves([a, b, c, d]: [Point; 4]) -> [[Point; 3]; 2] {
    [[a, b, c], [a, c, d]]
}

/// Where a position in clip space lies in a window, in pixels.
fn placed(window: PixelRect, position: DVec4) -> Result<Point, NoAnswer> {
    let vertex = ClipVertex { position, varying: () };
    let placed = Viewport::new(window).place(&vertex)?;
    let (x, y) = placed.position.to_px();
    Ok([x, y])
}

/// An edge that may end behind the eye, in a picture of one row. Asks which pixels it covers; a second row shows what comes of
/// dividing by w before clipping.
pub(super) fn divide_first(given: &FigureInput<'_>) -> Result<LiveFigure, NoAnswer> {
    let end = given.at[0][1];
    let near = 1.0;
    let camera = frustum(-1.0, 1.0, -1.0, 1.0, near, 10.0)?;
    let [a, b] = [3.0, end].map(|z| ClipVertex {
        position: camera * DVec4::new(1.0, 0.0, z, 1.0),
        varying: DVec2::ZERO,
    });
    let panel = Panel::middle(13, 1, 26.0, 200.0);
    // Below, the row of the wrong order.
    let naive = Panel { corner: [panel.corner[0], 252.0], ..panel };
    // An edge is a triangle whose last corner comes twice.
    let (kept, _) = clip(&[a, b, b], ClipPlane::MinW.bit() | ClipPlane::Near.bit());
    let kept: Vec<DVec4> = kept.vertices().map(|vertex| vertex.position).collect();
    let right = clipped_pixels(given, &kept, panel.window)?;
    // At w = 0 there is no quotient.
    let wrong = match end {
        0.0 => Vec::new(),
        _ => divided_pixels(given, [a.position, b.position], panel.window)?,
    };
    let mut drawing = Drawing::new(naive.bottom() + 10.0, given.is_answered);
    for &pixel in &right {
        drawing.pixel(&panel, pixel, "on", "");
    }
    for &pixel in &wrong {
        drawing.pixel(&naive, pixel, if right.contains(&pixel) { "on" } else { "extra" }, "");
    }
    // The borders of what the eye sees, down to the row of pixels.
    let space = FromAbove { eye: [180.0, 116.0], unit: 30.0 };
    for (side, column) in [(-1.0, 0.0), (1.0, 13.0)] {
        drawing.path("grid", &[space.place(0.0, 0.0), space.place(side * 3.4, 3.4)], false);
        drawing.path("grid", &[space.place(side, near), panel.place([column, 0.0])], false);
    }
    drawing.path("soft", &[space.place(-4.0, near), space.place(4.0, near)], false);
    let [x, y] = space.place(-4.0, near);
    drawing.text([x, y - 6.0], "start", "z = 1");
    drawing.dot(space.place(0.0, 0.0), 4.0);
    // The edge itself, whose farther end is the grip.
    drawing.arrow("ink", space.place(1.0, 3.0), space.place(1.0, end));
    drawing.named_grip(space.place(1.0, end), [0.0, -30.0], &format!("z = {}", number(end, 2)));
    drawing.grid(&panel);
    if given.is_answered {
        drawing.grid(&naive);
        drawing.text([12.0, naive.corner[1] - 7.0], "start", "x / z");
    }
    Ok(LiveFigure {
        drawing,
        predict: Predict::among(panel, &right),
        values: vec![
            ("right", right.len().to_string()),
            ("wrong", strangers(&wrong, &right).to_string()),
            // Where the near plane z = 1 cuts the edge, which begins at z = 3.
            ("share", number(2.0 / (3.0 - end), 3)),
        ],
        link: None,
    })
}

/// The pixels of a row from the leftmost to the rightmost corner of what is left of an edge.
fn clipped_pixels(
    given: &FigureInput<'_>,
    corners: &[DVec4],
    window: PixelRect,
) -> Result<Vec<[i32; 2]>, NoAnswer> {
    let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
    for corner in corners {
        let [x, _] = placed(window, *corner)?;
        (least, most) = (least.min(x), most.max(x));
    }
    // The right border belongs to the last pixel.
    let [from, to] = [least, most].map(|x| (x.floor() as i32).min(12));
    drawn(Pen::Engine(given.pen), [from, 0], [to, 0], window)
}

/// The pixels of a row between two divided ends, whatever their w.
fn divided_pixels(
    given: &FigureInput<'_>,
    ends: [DVec4; 2],
    window: PixelRect,
) -> Result<Vec<[i32; 2]>, NoAnswer> {
    let columns = ends.map(|p| ((p.x / p.w + 1.0) / 2.0 * f64::from(window.width())).floor());
    // Near w = 0 they are far away; what is outside of the window is not seen.
    let [from, to] = columns.map(|x| x.clamp(-100.0, 100.0) as i32);
    drawn(Pen::Engine(given.pen), [from, 0], [to, 0], window)
}

/// A viewport that multiplies by the size less 1. Asks which pixels stay empty that the right one covers.
pub(super) fn viewport_size(given: &FigureInput<'_>) -> Result<LiveFigure, NoAnswer> {
    let [u, v] = given.at[0];
    let panel = Panel::middle(5, 5, 44.0, 10.0);
    // In device coordinates, from the lower left corner of the window to the grip.
    let square = [[-1.0, -1.0], [u, -1.0], [u, v], [-1.0, v]];
    let mut right = square;
    for corner in &mut right {
        *corner = placed(panel.window, DVec4::new(corner[0], corner[1], 0.0, 1.0))?;
    }
    // From the lower border up, in a window of 5 px with a scale of 4.
    let wrong = square.map(|[x, y]| [(x + 1.0) / 2.0 * 4.0, 5.0 - (y + 1.0) / 2.0 * 4.0]);
    let is = cover(given.fill, &snapped(&halves(wrong))?, panel.window);
    let should = cover(given.fill, &snapped(&halves(right))?, panel.window);
    let mut drawing = Drawing::new(panel.bottom() + 10.0, given.is_answered);
    drawing.hits(&panel, &is, &should);
    drawing.grid(&panel);
    drawing.samples(&panel);
    if given.is_answered {
        drawing.outline(&panel, "soft", &wrong, true);
    }
    drawing.outline(&panel, "ink", &right, true);
    let spot = panel.place(right[2]);
    // A unit of device coordinates is half the window, 2.5 px; y points up.
    let half = panel.unit * 2.5;
    drawing.grip(spot, [half, -half]);
    let missing = lacking(&panel, &is, &should);
    Ok(LiveFigure {
        drawing,
        values: vec![
            ("covered", should.covered().to_string()),
            ("missing", count(&missing).to_string()),
        ],
        predict: Predict::Pixels(panel, missing),
        link: None,
    })
}

/// Asks to which pixel a point in space projects.
pub(super) fn to_pixel(given: &FigureInput<'_>) -> Result<LiveFigure, NoAnswer> {
    let ([x, z], y) = (given.at[0], 1.0);
    let panel = Panel::new([186.0, 16.0], 32.0, [0, 0, 5, 5]);
    let camera = frustum(-1.0, 1.0, -1.0, 1.0, 1.0, 10.0)?;
    let point = placed(panel.window, camera * DVec4::new(x, y, z, 1.0))?;
    // A pixel reaches from its number to the next one, its upper and left borders included.
    let pixel = point.map(|v| v.floor() as i32);
    let is_inside = panel.window.contains(pixel[0], pixel[1]);
    let mut drawing = Drawing::new(192.0, given.is_answered);
    if is_inside {
        drawing.pixel(&panel, pixel, "on", "");
    }
    drawing.grid(&panel);
    // Where exactly it projects to is part of the answer.
    if given.is_answered && is_inside {
        drawing.dot(panel.place(point), 4.0);
    }
    // The borders of what the eye sees, the film at z = 1, the axis, and the ray to the point.
    let space = FromAbove { eye: [88.0, 176.0], unit: 24.0 };
    for side in [-1.0, 1.0] {
        drawing.path("grid", &[space.place(0.0, 0.0), space.place(side * 3.4, 3.4)], false);
    }
    drawing.path("ink", &[space.place(-1.0, 1.0), space.place(1.0, 1.0)], false);
    drawing.path("soft", &[space.place(0.0, 0.0), space.place(0.0, 6.6)], false);
    drawing.path("soft", &[space.place(0.0, 0.0), space.place(x, z)], false);
    drawing.dot(space.place(0.0, 0.0), 4.0);
    drawing.grip(space.place(x, z), [24.0, -24.0]);
    let [left, top] = space.place(x, z);
    drawing.text([left, top - 12.0], "middle", &format!("{}, {}", number(x, 2), number(z, 2)));
    Ok(LiveFigure {
        drawing,
        predict: Predict::among(panel, &[pixel]),
        values: vec![
            ("px", number(point[0], 3)),
            ("py", number(point[1], 3)),
            // On the film.
            ("fx", number(x / z, 3)),
            ("fy", number(y / z, 3)),
        ],
        link: None,
    })
}

/// Two triangles, of which those that run counter-clockwise are left out. Asks which: y points down, so a positive area means
/// clockwise.
pub(super) fn winding(given: &FigureInput<'_>) -> Result<LiveFigure, NoAnswer> {
    let c = given.at[0];
    // The right one runs counter-clockwise on the screen; the left one as its corner lies.
    let triangles = [[[2.0, 2.0], [9.0, 3.0], c], [[18.0, 2.0], [11.0, 7.0], [18.0, 8.0]]];
    let panel = Panel::middle(20, 10, 17.0, 10.0);
    // The question of the scene "culling", as the playground asks it.
    let list = triangles.map(|corners| corners.map(|[x, y]| json!({ "x": x, "y": y })));
    let answer = answer_value(json!({
        "ask": "cull", "removes": "counter-clockwise", "by": given.fill.name(),
        "picture": { "window": [0, 0, 20, 10], "snap": true, "triangles": list },
    }))?;
    let removed = [0, 1].map(|i| answer["areas"][i]["removed"] == true);
    let mut drawing = Drawing::new(panel.bottom() + 10.0, given.is_answered);
    drawing.answered_hits(&panel, &answer["hits"]);
    drawing.grid(&panel);
    for triangle in &triangles {
        drawing.arrows("ink", triangle.map(|p| panel.place(p)));
    }
    drawing.grip(panel.place(c), [panel.unit; 2]);
    // The left one, the right one, both, or none.
    let right = match removed {
        [true, false] => 0,
        [false, true] => 1,
        [true, true] => 2,
        [false, false] => 3,
    };
    // In square pixels: a subpixel is 1/256 px wide.
    let area: f64 = answer["areas"][0]["twiceArea"].as_str().unwrap_or("0").parse()?;
    Ok(LiveFigure {
        drawing,
        predict: Predict::Choice(right),
        values: vec![("area", number(area / 65536.0, 2))],
        link: with_triangles("culling", &triangles, "&window=0,0,20,10&removes=counter-clockwise"),
    })
}

/// Where a point of the thin triangle lies on its drawing: columns of pixels, rows of subpixels.
fn thin_place(x: f64, sub: f64) -> Point {
    [30.0 + x * 150.0, 24.0 + sub * 100.0]
}

/// A triangle thinner than a subpixel, which snapping turns round. Asks which way its corners run afterwards: as its area says,
/// with their sign, or not at all.
pub(super) fn thin_turn(given: &FigureInput<'_>) -> Result<LiveFigure, NoAnswer> {
    // The heights in subpixels.
    let heights = [0.0, given.at[0][1], 1.1];
    let corners = [0, 1, 2].map(|i| [i as f64, heights[i] / 256.0]);
    let snapped = snapped_triangle(&corners)?;
    let sign = twice_area(&snapped).signum();
    // Lines at whole subpixels, to which corners are snapped, with their numbers.
    let mut drawing = Drawing::new(184.0, given.is_answered);
    for row in [0.0, 1.0] {
        drawing.path("grid", &[thin_place(0.0, row), thin_place(2.0, row)], false);
        let [x, y] = thin_place(0.0, row);
        drawing.text([x - 8.0, y + 5.0], "end", &number(row, 0));
    }
    for column in [0.0, 1.0, 2.0] {
        drawing.path("grid", &[thin_place(column, 0.0), thin_place(column, 1.4)], false);
    }
    // Dashed as given, and as snapped once that is predicted.
    let exact = [0, 1, 2].map(|i| thin_place(i as f64, heights[i]));
    drawing.arrows("soft", exact);
    if given.is_answered {
        let drawn = snapped.map(|p| thin_place(f64::from(p.x) / 256.0, f64::from(p.y)));
        drawing.arrows("ink", drawn);
    }
    drawing.named_grip(exact[1], [0.0, 100.0], "b");
    // The area before and after, in pixels times subpixels.
    let before = heights[2] - 2.0 * heights[1];
    let square = twice_area(&snapped) as f64 / 256.0;
    Ok(LiveFigure {
        drawing,
        predict: Predict::Choice(match sign {
            1 => 0,
            -1 => 1,
            _ => 2,
        }),
        values: vec![("before", number(before, 2)), ("after", number(square, 0))],
        link: None,
    })
}

/// The corners of a quadrangle in the plane, transformed by a matrix.
fn transformed(corners: [Point; 4], matrix: DMat4) -> [Point; 4] {
    corners.map(|[x, y]| {
        let p = matrix.transform_point3(DVec3::new(x, y, 0.0));
        [p.x, p.y]
    })
}

/// A square that is moved and then scaled. Asks which pixels it covers; the other order is drawn dashed.
pub(super) fn order_matters(given: &FigureInput<'_>) -> Result<LiveFigure, NoAnswer> {
    let (by, times) = (given.at[0][0], given.at[1][0]);
    let shift = DMat4::from_translation(DVec3::new(by, 0.0, 0.0));
    let scale = DMat4::from_scale(DVec3::splat(times));
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    // A product applies its right factor first.
    let (asked, other) = (transformed(square, scale * shift), transformed(square, shift * scale));
    let panel = Panel::middle(11, 4, 31.0, 10.0);
    let hits = cover(given.fill, &snapped(&halves(asked))?, panel.window);
    // The square as it is, then as it is moved and scaled, dashed in the other order.
    let mut drawing = Drawing::new(panel.bottom() + 88.0, given.is_answered);
    drawing.hits(&panel, &hits, &hits);
    drawing.grid(&panel);
    drawing.samples(&panel);
    drawing.outline(&panel, "ink", &square, true);
    if given.is_answered {
        drawing.outline(&panel, "ink", &asked, true);
        drawing.outline(&panel, "soft", &other, true);
    }
    let below = panel.bottom();
    drawing.slider(given, 0, below + 26.0, &format!("+{}", number(by, 0)));
    drawing.slider(given, 1, below + 64.0, &format!("× {}", number(times, 1)));
    Ok(LiveFigure {
        drawing,
        predict: Predict::covered(panel, &hits),
        values: vec![
            ("left", number(times * by, 1)),
            ("right", number(times * (by + 1.0), 1)),
            ("other", number(by, 1)),
            ("end", number(times + by, 1)),
        ],
        link: with_triangles("triangle", &halves(asked), "&window=0,0,11,4"),
    })
}

/// Where a point in space lies in the window of 14 rows: y points up in space, and down in the window.
fn in_window(p: DVec3) -> Point {
    [p.x, 14.0 - p.y]
}

/// A triangle that turns about a centre; asks to which side it then points.
pub(super) fn turn_about(given: &FigureInput<'_>) -> Result<LiveFigure, NoAnswer> {
    let ([x, y], degrees) = (given.at[0], given.at[1][0]);
    let centre = DVec3::new(x, y, 0.0);
    // It moves the centre to the origin, turns, and moves it back.
    let turn = about(centre, turn_z(degrees.to_radians()));
    let panel = Panel::middle(14, 14, 15.0, 10.0);
    // It points to the right before it is turned.
    let shape =
        [[1.5, 0.0], [5.0, -1.5], [5.0, 1.5]].map(|[dx, dy]| centre + DVec3::new(dx, dy, 0.0));
    let turned = shape.map(|p| in_window(turn.transform_point3(p)));
    let hits = cover(given.fill, &snapped(&[turned])?, panel.window);
    let mut drawing = Drawing::new(panel.bottom() + 48.0, given.is_answered);
    drawing.hits(&panel, &hits, &hits);
    drawing.grid(&panel);
    drawing.outline(&panel, "soft", &shape.map(in_window), true);
    if given.is_answered {
        drawing.outline(&panel, "ink", &turned, true);
    }
    drawing.named_grip(panel.place(in_window(centre)), [panel.unit, -panel.unit], "c");
    let says = format!("{}°", number(degrees, 0));
    drawing.slider(given, 1, panel.bottom() + 26.0, &says);
    // Where a point to the right of the centre went decides: right, up, left or down.
    let to = turn.transform_point3(centre + DVec3::new(4.0, 0.0, 0.0)) - centre;
    let right = match (to.x.abs() >= to.y.abs(), to.x > 0.0, to.y > 0.0) {
        (true, true, _) => 0,
        (false, _, true) => 1,
        (true, false, _) => 2,
        (false, _, false) => 3,
    };
    Ok(LiveFigure {
        drawing,
        predict: Predict::Choice(right),
        values: Vec::new(),
        link: with_triangles("triangle", &[turned], "&window=0,0,14,14"),
    })
}
