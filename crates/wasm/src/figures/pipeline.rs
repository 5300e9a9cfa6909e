//! Figures about the stages around a rasterizer: clipping, the window, culling.

use glam::{DMat4, DVec2, DVec3, DVec4};
use serde_json::json;

use super::drawing::{Drawing, Panel, Point, WIDTH};
use super::lines::drawn;
use super::{
    FigureInput, LiveFigure, Predict, answer_value, cover, number, snapped, with_triangles,
};
use rasterproof_core::angle::turn_z;
use rasterproof_core::frame::Coverage;
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::PixelRect;
use rasterproof_render::pipeline::ClipVertex;
use rasterproof_render::pipeline::assemble::Viewport;
use rasterproof_render::pipeline::clip::{ClipPlane, clip};
use rasterproof_render::pipeline::transform::{about, frustum};

/// The side of the screen in the figure of the near plane, in pixels.
const SCREEN: u32 = 20;

/// A triangle seen from the side, what the near plane leaves of it, and that on the screen.
pub(super) fn near_corners(given: &FigureInput<'_>) -> Result<LiveFigure, String> {
    let (w, near) = (given.at[0][0], given.at[1][0]);
    let corners = [[-0.7, -0.8, 2.0], [0.8, 0.1, 2.6], [-0.1, 0.8, w]];
    let answer = answer_value(json!({
        "ask": "near", "side_px": SCREEN, "corners": corners, "near": near, "by": given.fill.name(),
    }))?;
    let kept = &answer["panels"][0];
    let outline: Vec<Point> =
        serde_json::from_value(kept["outline"].clone()).map_err(|error| error.to_string())?;
    // From the side: w to the right, and up as far as a ray to this height of the screen has come.
    let (left, top, side) = (10.0, 30.0, 165.0);
    let aside =
        |w: f64, y: f64| [left + (w + 1.5) / 4.5 * side, top + side / 2.0 - y * w.abs() * 32.0];
    let panel = Panel {
        corner: [WIDTH - 10.0 - side, top],
        unit: side / f64::from(SCREEN),
        window: PixelRect::window(SCREEN, SCREEN),
    };
    let mut drawing = Drawing::new(top + side + 12.0, given.is_answered);
    drawing.answered_hits(&panel, &kept["hits"]);
    let screen = panel.corner;
    let far = [screen[0] + side, screen[1] + side];
    drawing.path("grid", &[screen, [far[0], screen[1]], far, [screen[0], far[1]]], true);
    if given.is_answered && !outline.is_empty() {
        drawing.outline(&panel, "ink", &outline, true);
    }
    drawing.path("grid", &[aside(0.0, 0.0), aside(3.0, 0.85)], false);
    drawing.path("grid", &[aside(0.0, 0.0), aside(3.0, -0.85)], false);
    let plane = aside(near, 0.0)[0];
    drawing.path("soft", &[[plane, top], [plane, top + side]], false);
    drawing.path("ink", &corners.map(|[_, y, w]| aside(w, y)), true);
    drawing.dot(aside(0.0, 0.0), 4.0);
    let eye = aside(0.0, 0.0);
    drawing.text([eye[0], eye[1] + 22.0], "middle", "w = 0");
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

/// Five equal boards along a road.
pub(super) fn boards(given: &FigureInput<'_>) -> Result<LiveFigure, String> {
    let spacing = given.at[0][0];
    let size = PixelRect::window(48, 48);
    let panel = Panel::new([12.0, 10.0], 7.0, [0, 0, 48, 27]);
    let camera = frustum(-1.0, 1.0, -1.0, 1.0, 1.0, 100.0).map_err(|error| error.to_string())?;
    let mut drawing = Drawing::new(panel.bottom() + 48.0, given.is_answered);
    let (mut heights, mut link) = (Vec::new(), Vec::new());
    for i in 0..5 {
        let z = 1.0 + spacing * f64::from(i);
        let at = |x: f64, y: f64| placed(size, camera * DVec4::new(x, y, z, 1.0));
        let board = [at(0.7, 0.0)?, at(0.9, 0.0)?, at(0.9, 1.0)?, at(0.7, 1.0)?];
        let triangles = halves(board);
        let hits = cover(given.fill, &snapped(&triangles)?, panel.window);
        let class = if i % 2 == 0 { "one" } else { "two" };
        let is_hit = |p: &[i32; 2]| hits.get(p[0], p[1]) != Some(0);
        for pixel in panel.pixels().filter(is_hit) {
            drawing.pixel(&panel, pixel, class, "");
        }
        let is_row = |y: &i32| (0..48).any(|x| is_hit(&[x, *y]));
        heights.push((0..27).filter(is_row).count());
        link.extend(triangles);
        if i == 0 {
            drawing.outline(&panel, "ink", &board, true);
        }
    }
    let horizon = [[0.0, 24.0], [48.0, 24.0]];
    drawing.outline(&panel, "soft", &horizon, false);
    let [left, top] = panel.corner;
    let [right, bottom] = panel.place([48.0, 27.0]);
    drawing.path("grid", &[[left, top], [right, top], [right, bottom], [left, bottom]], true);
    let says = format!("Δz = {}", number(spacing, 2));
    drawing.slider(given, 0, panel.bottom() + 26.0, &says);
    Ok(LiveFigure {
        drawing,
        predict: Predict::Number(heights[2] as f64, 0),
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
fn placed(window: PixelRect, position: DVec4) -> Result<Point, String> {
    let vertex = ClipVertex { position, varying: () };
    let placed = Viewport::new(window).place(&vertex).map_err(|refusal| refusal.to_string())?;
    let (x, y) = placed.position.to_px();
    Ok([x, y])
}

/// An edge that may end behind the eye, in a picture of one row.
pub(super) fn divide_first(given: &FigureInput<'_>) -> Result<LiveFigure, String> {
    let end = given.at[0][1];
    let near = 1.0;
    let camera = frustum(-1.0, 1.0, -1.0, 1.0, near, 10.0).map_err(|error| error.to_string())?;
    let [a, b] = [3.0, end].map(|z| ClipVertex {
        position: camera * DVec4::new(1.0, 0.0, z, 1.0),
        varying: DVec2::ZERO,
    });
    let panel = Panel::middle(13, 1, 26.0, 200.0);
    let naive = Panel { corner: [panel.corner[0], 252.0], ..panel };
    // An edge is a triangle whose last corner comes twice.
    let (kept, _) = clip(&[a, b, b], ClipPlane::MinW.bit() | ClipPlane::Near.bit());
    let columns = |positions: &[DVec4]| -> Result<Vec<i32>, String> {
        let places = positions.iter().map(|&position| placed(panel.window, position));
        let places: Vec<f64> =
            places.collect::<Result<Vec<_>, _>>()?.iter().map(|p| p[0]).collect();
        let least = places.iter().copied().fold(f64::INFINITY, f64::min);
        let most = places.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        // The right border belongs to the last pixel.
        let [from, to] = [least, most].map(|x| (x.floor() as i32).min(12));
        Ok(drawn(given, [from, 0], [to, 0], panel.window).iter().map(|p| p[0]).collect())
    };
    let kept: Vec<DVec4> = kept.vertices().map(|vertex| vertex.position).collect();
    let right = columns(&kept)?;
    // At w = 0 there is no quotient.
    let divided = [a, b].map(|vertex| vertex.position);
    let wrong = if end == 0.0 { Vec::new() } else { naive_columns(given, &divided, panel.window) };
    let mut drawing = Drawing::new(naive.bottom() + 10.0, given.is_answered);
    for &x in &right {
        drawing.pixel(&panel, [x, 0], "on", "");
    }
    for &x in &wrong {
        drawing.pixel(&naive, [x, 0], if right.contains(&x) { "on" } else { "extra" }, "");
    }
    // From above: x to the right, z up.
    let above = |x: f64, z: f64| [180.0 + x * 30.0, 116.0 - z * 30.0];
    for (side, column) in [(-1.0, 0.0), (1.0, 13.0)] {
        drawing.path("grid", &[above(0.0, 0.0), above(side * 3.4, 3.4)], false);
        drawing.path("grid", &[above(side, near), panel.place([column, 0.0])], false);
    }
    drawing.path("soft", &[above(-4.0, near), above(4.0, near)], false);
    let [x, y] = above(-4.0, near);
    drawing.text([x, y - 6.0], "start", "z = 1");
    drawing.dot(above(0.0, 0.0), 4.0);
    drawing.arrow("ink", above(1.0, 3.0), above(1.0, end));
    drawing.named_grip(above(1.0, end), [0.0, -30.0], &format!("z = {}", number(end, 2)));
    drawing.grid(&panel);
    if given.is_answered {
        drawing.grid(&naive);
        drawing.text([12.0, naive.corner[1] - 7.0], "start", "x / z");
    }
    let pixels = (0..13).map(|x| ([x, 0], right.contains(&x))).collect();
    Ok(LiveFigure {
        drawing,
        predict: Predict::Pixels(panel, pixels),
        values: vec![
            ("right", right.len().to_string()),
            ("wrong", wrong.iter().filter(|x| !right.contains(x)).count().to_string()),
            ("share", number(2.0 / (3.0 - end), 3)),
        ],
        link: None,
    })
}

/// The columns between two divided ends, whatever their w.
fn naive_columns(given: &FigureInput<'_>, ends: &[DVec4; 2], window: PixelRect) -> Vec<i32> {
    let columns = ends.map(|p| ((p.x / p.w + 1.0) / 2.0 * f64::from(window.width())).floor());
    let [from, to] = columns.map(|x| x.clamp(-100.0, 100.0) as i32);
    drawn(given, [from, 0], [to, 0], window).iter().map(|p| p[0]).collect()
}

/// A viewport that multiplies by the size less 1.
pub(super) fn viewport_size(given: &FigureInput<'_>) -> Result<LiveFigure, String> {
    let [u, v] = given.at[0];
    let panel = Panel::middle(5, 5, 44.0, 10.0);
    let square = [[-1.0, -1.0], [u, -1.0], [u, v], [-1.0, v]];
    let at = |[x, y]: Point| placed(panel.window, DVec4::new(x, y, 0.0, 1.0));
    let right = [at(square[0])?, at(square[1])?, at(square[2])?, at(square[3])?];
    let wrong = square.map(|[x, y]| [(x + 1.0) / 2.0 * 4.0, 5.0 - (y + 1.0) / 2.0 * 4.0]);
    let hits = |corners| -> Result<Coverage, String> {
        Ok(cover(given.fill, &snapped(&halves(corners))?, panel.window))
    };
    let (is, should) = (hits(wrong)?, hits(right)?);
    let mut drawing = Drawing::new(panel.bottom() + 10.0, given.is_answered);
    drawing.hits(&panel, &is, &should);
    drawing.grid(&panel);
    drawing.samples(&panel);
    if given.is_answered {
        drawing.outline(&panel, "soft", &wrong, true);
    }
    drawing.outline(&panel, "ink", &right, true);
    let spot = panel.place(right[2]);
    let half = panel.unit * 2.5;
    drawing.grip(spot, [half, -half]);
    let missing = |[x, y]: [i32; 2]| is.get(x, y) < should.get(x, y);
    let pixels: Vec<_> = panel.pixels().map(|pixel| (pixel, missing(pixel))).collect();
    let count = pixels.iter().filter(|(_, is_missing)| *is_missing).count();
    Ok(LiveFigure {
        drawing,
        predict: Predict::Pixels(panel, pixels),
        values: vec![("covered", should.covered().to_string()), ("missing", count.to_string())],
        link: None,
    })
}

pub(super) fn to_pixel(given: &FigureInput<'_>) -> Result<LiveFigure, String> {
    let ([x, z], y) = (given.at[0], 1.0);
    let panel = Panel::new([186.0, 16.0], 32.0, [0, 0, 5, 5]);
    let camera = frustum(-1.0, 1.0, -1.0, 1.0, 1.0, 10.0).map_err(|error| error.to_string())?;
    let point = placed(panel.window, camera * DVec4::new(x, y, z, 1.0))?;
    let pixel = point.map(|v| v.floor() as i32);
    let is_inside = panel.window.contains(pixel[0], pixel[1]);
    let mut drawing = Drawing::new(192.0, given.is_answered);
    if is_inside {
        drawing.pixel(&panel, pixel, "on", "");
    }
    drawing.grid(&panel);
    if given.is_answered && is_inside {
        drawing.dot(panel.place(point), 4.0);
    }
    // From above: x to the right, z up.
    let above = |x: f64, z: f64| [88.0 + x * 24.0, 176.0 - z * 24.0];
    for side in [-1.0, 1.0] {
        drawing.path("grid", &[above(0.0, 0.0), above(side * 3.4, 3.4)], false);
    }
    drawing.path("ink", &[above(-1.0, 1.0), above(1.0, 1.0)], false);
    drawing.path("soft", &[above(0.0, 0.0), above(0.0, 6.6)], false);
    drawing.path("soft", &[above(0.0, 0.0), above(x, z)], false);
    drawing.dot(above(0.0, 0.0), 4.0);
    drawing.grip(above(x, z), [24.0, -24.0]);
    let [left, top] = above(x, z);
    drawing.text([left, top - 12.0], "middle", &format!("{}, {}", number(x, 2), number(z, 2)));
    Ok(LiveFigure {
        drawing,
        predict: Predict::Pixels(panel, panel.pixels().map(|p| (p, p == pixel)).collect()),
        values: vec![
            ("px", number(point[0], 3)),
            ("py", number(point[1], 3)),
            ("fx", number(x / z, 3)),
            ("fy", number(y / z, 3)),
        ],
        link: None,
    })
}

/// Two triangles, of which those that run counter-clockwise are left out.
pub(super) fn winding(given: &FigureInput<'_>) -> Result<LiveFigure, String> {
    let c = given.at[0];
    let triangles = [[[2.0, 2.0], [9.0, 3.0], c], [[18.0, 2.0], [11.0, 7.0], [18.0, 8.0]]];
    let panel = Panel::middle(20, 10, 17.0, 10.0);
    let corner = |p: &Point| json!({ "x": p[0], "y": p[1] });
    let list: Vec<_> = triangles.iter().map(|t| t.iter().map(corner).collect::<Vec<_>>()).collect();
    let answer = answer_value(json!({
        "ask": "cull", "removes": "counter-clockwise", "by": given.fill.name(),
        "picture": { "window": [0, 0, 20, 10], "snap": true, "triangles": list },
    }))?;
    let removed = [0, 1].map(|i| answer["areas"][i]["removed"] == json!(true));
    let mut drawing = Drawing::new(panel.bottom() + 10.0, given.is_answered);
    drawing.answered_hits(&panel, &answer["hits"]);
    drawing.grid(&panel);
    for triangle in &triangles {
        drawing.arrows("ink", triangle.map(|p| panel.place(p)));
    }
    drawing.grip(panel.place(c), [panel.unit; 2]);
    let right = match removed {
        [true, false] => 0,
        [false, true] => 1,
        [true, true] => 2,
        [false, false] => 3,
    };
    // In square pixels: a subpixel is 1/256 px wide.
    let area = answer["areas"][0]["twiceArea"].as_str().and_then(|text| text.parse::<f64>().ok());
    Ok(LiveFigure {
        drawing,
        predict: Predict::Choice(right),
        values: vec![("area", number(area.unwrap_or(0.0) / 65536.0, 2))],
        link: with_triangles("culling", &triangles, "&window=0,0,20,10&removes=counter-clockwise"),
    })
}

/// A triangle thinner than a subpixel, which snapping turns round.
pub(super) fn thin_turn(given: &FigureInput<'_>) -> Result<LiveFigure, String> {
    // The heights in subpixels.
    let heights = [0.0, given.at[0][1], 1.1];
    let corners = [0, 1, 2].map(|i| [i as f64, heights[i] / 256.0]);
    let snapped = snapped(&[corners])?[0];
    let sign = twice_area(&snapped).signum();
    let place = |x: f64, sub: f64| [30.0 + x * 150.0, 24.0 + sub * 100.0];
    let mut drawing = Drawing::new(184.0, given.is_answered);
    for row in [0.0, 1.0] {
        drawing.path("grid", &[place(0.0, row), place(2.0, row)], false);
        let [x, y] = place(0.0, row);
        drawing.text([x - 8.0, y + 5.0], "end", &number(row, 0));
    }
    for column in [0.0, 1.0, 2.0] {
        drawing.path("grid", &[place(column, 0.0), place(column, 1.4)], false);
    }
    let exact = [0, 1, 2].map(|i| place(i as f64, heights[i]));
    drawing.arrows("soft", exact);
    if given.is_answered {
        let drawn = snapped.map(|p| place(f64::from(p.x) / 256.0, f64::from(p.y)));
        drawing.arrows("ink", drawn);
    }
    drawing.named_grip(exact[1], [0.0, 100.0], "b");
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

/// A square that is moved and scaled.
pub(super) fn order_matters(given: &FigureInput<'_>) -> Result<LiveFigure, String> {
    let (by, times) = (given.at[0][0], given.at[1][0]);
    let shift = DMat4::from_translation(DVec3::new(by, 0.0, 0.0));
    let scale = DMat4::from_scale(DVec3::splat(times));
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let moved = |matrix: DMat4| {
        square.map(|[x, y]| {
            let p = matrix.transform_point3(DVec3::new(x, y, 0.0));
            [p.x, p.y]
        })
    };
    let (asked, other) = (moved(scale * shift), moved(shift * scale));
    let panel = Panel::middle(11, 4, 31.0, 10.0);
    let hits = cover(given.fill, &snapped(&halves(asked))?, panel.window);
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
    let pixels = panel.pixels().map(|p| (p, hits.get(p[0], p[1]) != Some(0))).collect();
    Ok(LiveFigure {
        drawing,
        predict: Predict::Pixels(panel, pixels),
        values: vec![
            ("left", number(times * by, 1)),
            ("right", number(times * (by + 1.0), 1)),
            ("other", number(by, 1)),
            ("end", number(times + by, 1)),
        ],
        link: with_triangles("triangle", &halves(asked), "&window=0,0,11,4"),
    })
}

pub(super) fn turn_about(given: &FigureInput<'_>) -> Result<LiveFigure, String> {
    let ([x, y], degrees) = (given.at[0], given.at[1][0]);
    let centre = DVec3::new(x, y, 0.0);
    let turn = about(centre, turn_z(degrees.to_radians()));
    // y points up in space, and down in the window.
    let panel = Panel::middle(14, 14, 15.0, 10.0);
    let window = |p: DVec3| [p.x, 14.0 - p.y];
    let shape =
        [[1.5, 0.0], [5.0, -1.5], [5.0, 1.5]].map(|[dx, dy]| centre + DVec3::new(dx, dy, 0.0));
    let turned = shape.map(|p| window(turn.transform_point3(p)));
    let hits = cover(given.fill, &snapped(&[turned])?, panel.window);
    let mut drawing = Drawing::new(panel.bottom() + 48.0, given.is_answered);
    drawing.hits(&panel, &hits, &hits);
    drawing.grid(&panel);
    drawing.outline(&panel, "soft", &shape.map(window), true);
    if given.is_answered {
        drawing.outline(&panel, "ink", &turned, true);
    }
    drawing.named_grip(panel.place(window(centre)), [panel.unit, -panel.unit], "c");
    let says = format!("{}°", number(degrees, 0));
    drawing.slider(given, 1, panel.bottom() + 26.0, &says);
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
