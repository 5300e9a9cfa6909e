//! Figures about which pixels belong to a shape.

use super::drawing::{Drawing, Panel, Point};
use super::{FigureInput, LiveFigure, Predict, cover, number, snapped, with_triangles};
use rasterproof_core::frame::Coverage;
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::snap;
use rasterproof_faults::planted::TriangleMutant;
use rasterproof_faults::published::book_triangle::BookChapter2;
use rasterproof_faults::published::{Published as _, bare};
use rasterproof_registry::engines::Engine;

/// A square against the centres of the pixels.
pub(super) fn one_sample(given: &FigureInput<'_>) -> Result<LiveFigure, String> {
    let ([x, y], low) = (given.at[0], 0.6);
    let square = [[[low, low], [x, low], [x, y]], [[low, low], [x, y], [low, y]]];
    let panel = Panel::middle(5, 5, 44.0, 10.0);
    let hits = cover(given.fill, &snapped(&square)?, panel.window);
    let mut drawing = Drawing::new(panel.bottom() + 10.0, given.is_answered);
    drawing.hits(&panel, &hits, &hits);
    drawing.grid(&panel);
    drawing.samples(&panel);
    drawing.outline(&panel, "ink", &[[low, low], [x, low], [x, y], [low, y]], true);
    drawing.grip(panel.place([x, y]), [panel.unit; 2]);
    let pixels = panel.pixels().map(|p| (p, hits.get(p[0], p[1]) != Some(0))).collect();
    Ok(LiveFigure {
        drawing,
        predict: Predict::Pixels(panel, pixels),
        values: vec![
            ("covered", hits.covered().to_string()),
            ("area", number((x - low) * (y - low), 2)),
            ("wide", number(x - low, 2)),
            ("high", number(y - low, 2)),
        ],
        link: with_triangles("triangle", &square, "&window=0,0,5,5&by=scanline,oracle"),
    })
}

/// A position between points of the grid, and the point that it is snapped to.
pub(super) fn snap_to_even(given: &FigureInput<'_>) -> Result<LiveFigure, String> {
    let [x, y] = given.at[0];
    let sub = |v: f64| snap(v / 256.0).map_err(|refusal| refusal.to_string());
    let right = [sub(x)?, sub(y)?];
    // Each square holds what is nearest to the grid point in its middle.
    let panel = Panel::middle(6, 5, 44.0, 26.0);
    let middle = |[x, y]: Point| panel.place([x + 0.5, y + 0.5]);
    let mut drawing = Drawing::new(panel.bottom() + 10.0, given.is_answered);
    drawing.pixel(&panel, right, "on", "");
    drawing.grid(&panel);
    drawing.samples(&panel);
    for i in 0..6 {
        let [along, _] = middle([f64::from(i), 0.0]);
        drawing.text([along, 18.0], "middle", &i.to_string());
    }
    for j in 0..5 {
        let [_, down] = middle([0.0, f64::from(j)]);
        drawing.text([panel.corner[0] - 10.0, down + 5.0], "end", &j.to_string());
    }
    let spot = middle([x, y]);
    if given.is_answered {
        drawing.arrow("ink", spot, middle(right.map(f64::from)));
    }
    drawing.grip(spot, [panel.unit; 2]);
    Ok(LiveFigure {
        drawing,
        predict: Predict::Pixels(panel, panel.pixels().map(|p| (p, p == right)).collect()),
        values: vec![("sx", right[0].to_string()), ("sy", right[1].to_string())],
        link: None,
    })
}

/// Steps of a grid in a pixel, by the position of the grip that says how many bits it has.
fn steps(bits: Point) -> u32 {
    1 << bits[0] as u32
}

/// The corners of triangles on a grid of at most as many bits as that of the engines.
fn on_grid(triangles: &[[Point; 3]], bits: Point) -> Vec<[Point; 3]> {
    let steps = f64::from(steps(bits));
    let place = |point: Point| point.map(|v| (v * steps).round_ties_even() / steps);
    triangles.iter().map(|corners| corners.map(place)).collect()
}

/// A rectangle of 9 x 5 px in triangles, as they are given and on a grid; which of its pixels are hit by none or by several.
fn snapped_mesh(
    given: &FigureInput<'_>,
    triangles: &[[Point; 3]],
    (dragged, letter): (Point, &str),
    says: &str,
) -> Result<(Drawing, [usize; 2]), String> {
    let panel = Panel::middle(9, 5, 38.0, 10.0);
    let placed = on_grid(triangles, given.at[1]);
    let hits = cover(given.fill, &snapped(&placed)?, panel.window);
    let mut drawing = Drawing::new(panel.bottom() + 46.0, given.is_answered);
    drawing.hits(&panel, &hits, &Coverage::new(panel.window, 1));
    drawing.grid(&panel);
    drawing.samples(&panel);
    for triangle in triangles {
        drawing.outline(&panel, "soft", triangle, true);
    }
    if given.is_answered {
        for triangle in &placed {
            drawing.outline(&panel, "ink", triangle, true);
        }
    }
    drawing.named_grip(panel.place(dragged), [panel.unit, 0.0], letter);
    drawing.slider(given, 1, panel.bottom() + 26.0, says);
    let counted = |is: fn(u8) -> bool| {
        panel.pixels().filter(|p| hits.get(p[0], p[1]).is_some_and(is)).count()
    };
    Ok((drawing, [counted(|hits| hits == 0), counted(|hits| hits > 1)]))
}

/// A corner within the edge of another triangle, which is snapped without that edge.
pub(super) fn snapped_crack(given: &FigureInput<'_>) -> Result<LiveFigure, String> {
    let x = given.at[0][0];
    let q = [x, x * 5.0 / 9.0];
    let (o, e, r, s) = ([0.0, 0.0], [9.0, 0.0], [9.0, 5.0], [0.0, 5.0]);
    let triangles = [[o, r, s], [o, e, q], [e, r, q]];
    let (drawing, [holes, twice]) =
        snapped_mesh(given, &triangles, (q, "Q"), &format!("1/{} px", steps(given.at[1])))?;
    Ok(LiveFigure {
        drawing,
        predict: Predict::Number(holes as f64, 0),
        values: vec![
            ("qx", number(q[0], 4)),
            ("qy", number(q[1], 4)),
            ("steps", steps(given.at[1]).to_string()),
            ("holes", holes.to_string()),
            ("twice", twice.to_string()),
        ],
        link: None,
    })
}

/// A narrow part of a plane mesh without a corner on an edge, which snapping turns over.
pub(super) fn snapped_fold(given: &FigureInput<'_>) -> Result<LiveFigure, String> {
    let x = given.at[0][0];
    // To either side of the diagonal by 1/100 px, so that the narrow triangles between them have an area.
    let (m, n) = ([x, x * 5.0 / 9.0 - 0.01], [6.4, 6.4 * 5.0 / 9.0 + 0.01]);
    let (o, e, r, s) = ([0.0, 0.0], [9.0, 0.0], [9.0, 5.0], [0.0, 5.0]);
    let triangles = [[o, e, m], [e, r, m], [o, m, n], [m, r, n], [o, n, s], [n, r, s]];
    let placed = snapped(&on_grid(&triangles, given.at[1]))?;
    let turned = placed.iter().filter(|corners| twice_area(corners) <= 0).count();
    let (drawing, [holes, twice]) =
        snapped_mesh(given, &triangles, (m, "M"), &format!("1/{} px", steps(given.at[1])))?;
    Ok(LiveFigure {
        drawing,
        predict: Predict::Number(twice as f64, 0),
        values: vec![
            ("steps", steps(given.at[1]).to_string()),
            ("holes", holes.to_string()),
            ("twice", twice.to_string()),
            ("turned", turned.to_string()),
        ],
        link: None,
    })
}

pub(super) fn edge_sign(given: &FigureInput<'_>) -> Result<LiveFigure, String> {
    let [a, b] = [given.at[0], given.at[1]];
    let panel = Panel::middle(9, 7, 36.0, 10.0);
    let mut drawing = Drawing::new(panel.bottom() + 10.0, given.is_answered);
    let mut pixels = Vec::new();
    for pixel in panel.pixels() {
        let corners = snapped(&[[a, b, pixel.map(|v| f64::from(v) + 0.5)]])?[0];
        let sign = twice_area(&corners).signum();
        let (class, letter) = [("on", "−"), ("twice", "0"), ("one", "+")][(sign + 1) as usize];
        drawing.pixel(&panel, pixel, class, letter);
        pixels.push((pixel, sign == 0));
    }
    drawing.grid(&panel);
    if !given.is_answered {
        drawing.samples(&panel);
    }
    drawing.arrow("ink", panel.place(a), panel.place(b));
    for (point, letter) in [(a, "a"), (b, "b")] {
        drawing.named_grip(panel.place(point), [panel.unit; 2], letter);
    }
    let zeros = pixels.iter().filter(|(_, is_zero)| *is_zero).count();
    let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    Ok(LiveFigure {
        drawing,
        predict: Predict::Pixels(panel, pixels),
        values: vec![
            ("zeros", zeros.to_string()),
            ("dx", number(dx, 1)),
            ("dy", number(dy, 1)),
            ("first", number(dx * (0.5 - a[1]) - dy * (0.5 - a[0]), 2)),
        ],
        link: None,
    })
}

/// What a strict rule leaves empty along the edge that two triangles share.
pub(super) fn shared_edge(given: &FigureInput<'_>) -> Result<LiveFigure, String> {
    let corner = given.at[0];
    let square = [[[1.0, 1.0], [5.0, 1.0], corner], [[1.0, 1.0], corner, [1.0, 5.0]]];
    let panel = Panel::middle(6, 6, 36.0, 10.0);
    let corners = snapped(&square)?;
    let right = cover(given.fill, &corners, panel.window);
    let strict = cover(Engine::Mutant(TriangleMutant::ExclusiveEdges), &corners, panel.window);
    let mut drawing = Drawing::new(panel.bottom() + 10.0, given.is_answered);
    drawing.hits(&panel, &strict, &right);
    drawing.grid(&panel);
    drawing.samples(&panel);
    drawing.outline(&panel, "ink", &square[0], true);
    drawing.outline(&panel, "ink", &square[1], true);
    drawing.grip(panel.place(corner), [panel.unit; 2]);
    let is_hole = |[x, y]: [i32; 2]| strict.get(x, y) < right.get(x, y);
    let pixels: Vec<_> = panel.pixels().map(|pixel| (pixel, is_hole(pixel))).collect();
    let missing = pixels.iter().filter(|(_, is_hole)| *is_hole).count();
    Ok(LiveFigure {
        drawing,
        predict: Predict::Pixels(panel, pixels),
        values: vec![("missing", missing.to_string()), ("covered", right.covered().to_string())],
        link: with_triangles("triangle", &square, "&window=0,0,6,6&by=scanline,exclusive-edges"),
    })
}

/// Which of two triangles has the samples on their common edge.
pub(super) fn edge_owner(given: &FigureInput<'_>) -> Result<LiveFigure, String> {
    let (p, q) = ([1.5, 3.5], given.at[0]);
    let triangles = [[p, [4.0, 0.5], q], [p, q, [4.0, 6.5]]];
    let corners = snapped(&triangles)?;
    let panel = Panel::middle(8, 7, 36.0, 10.0);
    let [upper, lower] = [0, 1].map(|i| cover(given.fill, &corners[i..=i], panel.window));
    let mut drawing = Drawing::new(panel.bottom() + 10.0, given.is_answered);
    let (mut ties, mut first_tie) = ([0, 0], None);
    for pixel in panel.pixels() {
        let has = |hits: &Coverage| hits.get(pixel[0], pixel[1]) != Some(0);
        let centre = pixel.map(|v| f64::from(v) + 0.5);
        let is_tie = twice_area(&snapped(&[[p, q, centre]])?[0]) == 0;
        let letter = if is_tie { "0" } else { "" };
        for (i, (hits, class)) in [(&upper, "one"), (&lower, "two")].into_iter().enumerate() {
            if has(hits) {
                drawing.pixel(&panel, pixel, class, letter);
                ties[i] += usize::from(is_tie);
                first_tie = first_tie.or(is_tie.then_some(pixel));
            }
        }
    }
    drawing.grid(&panel);
    drawing.samples(&panel);
    for triangle in &triangles {
        drawing.outline(&panel, "ink", triangle, true);
    }
    drawing.grip(panel.place(q), [0.0, panel.unit]);
    // The playground says of this pixel whose it is.
    let explained = first_tie.map_or(String::new(), |[x, y]| format!("&px={x},{y}"));
    let owner = match ties {
        [0, 0] => 2,
        [0, _] => 1,
        _ => 0,
    };
    Ok(LiveFigure {
        drawing,
        predict: Predict::Choice(owner),
        values: vec![("upper", ties[0].to_string()), ("lower", ties[1].to_string())],
        link: with_triangles("triangle", &triangles, &format!("&window=0,0,8,7{explained}")),
    })
}

/// The pixels of one row between two edges.
pub(super) fn row_span(given: &FigureInput<'_>) -> Result<LiveFigure, String> {
    let corner = [given.at[0][0], 4.0];
    let triangle = [[0.0, 0.0], [0.0, 4.0], corner];
    let panel = Panel::middle(6, 5, 44.0, 10.0);
    let hits = cover(given.fill, &snapped(&[triangle])?, panel.window);
    let row = 2;
    let mut drawing = Drawing::new(panel.bottom() + 10.0, given.is_answered);
    let has = |x: i32| hits.get(x, row) != Some(0);
    let columns = panel.window.x0..panel.window.x1;
    for x in columns.clone().filter(|&x| has(x)) {
        drawing.pixel(&panel, [x, row], "on", "");
    }
    drawing.grid(&panel);
    drawing.samples(&panel);
    drawing.outline(&panel, "ink", &triangle, true);
    let height = f64::from(row) + 0.5;
    drawing.outline(&panel, "soft", &[[0.0, height], [6.0, height]], false);
    drawing.grip(panel.place(corner), [panel.unit, 0.0]);
    let crossing = corner[0] * height / 4.0;
    Ok(LiveFigure {
        drawing,
        predict: Predict::Pixels(panel, columns.clone().map(|x| ([x, row], has(x))).collect()),
        values: vec![
            ("crossing", number(crossing, 4)),
            ("count", columns.filter(|&x| has(x)).count().to_string()),
        ],
        link: with_triangles("triangle", &[triangle], "&window=0,0,6,5&px=1,2"),
    })
}

/// The row of the middle corner, which a triangle cut in two parts draws twice.
pub(super) fn middle_row(given: &FigureInput<'_>) -> Result<LiveFigure, String> {
    let middle = given.at[0];
    let triangle = [[2.5, 11.5], middle, [2.5, 4.5]];
    let panel = Panel::new([24.0, 10.0], 26.0, [1, 3, 13, 13]);
    let mut hits = Coverage::new(panel.window, 0);
    BookChapter2
        .cover(&bare(triangle), panel.window, &mut |span| {
            hits.hit(span.y_px, span.x0_px, span.x1_px);
        })
        .map_err(|refused| refused.to_string())?;
    let right = cover(given.fill, &snapped(&[triangle])?, panel.window);
    let mut drawing = Drawing::new(panel.bottom() + 10.0, given.is_answered);
    drawing.hits(&panel, &hits, &right);
    drawing.grid(&panel);
    drawing.samples(&panel);
    drawing.outline(&panel, "ink", &triangle, true);
    drawing.grip(panel.place(middle), [panel.unit; 2]);
    let twice = panel.pixels().filter(|p| hits.get(p[0], p[1]) > Some(1)).count();
    Ok(LiveFigure {
        drawing,
        predict: Predict::Number(twice as f64, 0),
        values: vec![("twice", twice.to_string())],
        link: with_triangles("triangle", &[triangle], "&window=1,3,13,13&by=scanline,book-ch2"),
    })
}
