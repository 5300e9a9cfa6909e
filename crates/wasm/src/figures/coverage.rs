//! Figures about which pixels belong to a shape.

use super::drawing::{Drawing, Panel, Point, centre};
use super::{
    FigureInput, LiveFigure, Predict, count, lacking, number, snapped, snapped_triangle,
    with_triangles,
};
use crate::answer::cover;
use crate::no_answer::NoAnswer;
use rasterproof_core::frame::Coverage;
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::{PixelRect, snap};
use rasterproof_faults::planted::TriangleMutant;
use rasterproof_faults::published::book_triangle::BookChapter2;
use rasterproof_faults::published::{Published as _, bare};
use rasterproof_registry::engines::Engine;

/// A rectangle over the centres of the pixels. Asks which pixels it covers: those whose centre it contains, however much of them
/// it covers besides.
pub(super) fn one_sample(given: &FigureInput<'_>) -> Result<LiveFigure, NoAnswer> {
    let ([x, y], low) = (given.at[0], 0.6);
    // In two triangles, whose common edge is drawn nowhere.
    let square = [[[low, low], [x, low], [x, y]], [[low, low], [x, y], [low, y]]];
    let panel = Panel::middle(5, 5, 44.0, 10.0);
    // Nothing is missing and nothing too much: the hits are the right ones.
    let hits = cover(given.fill, &snapped(&square)?, panel.window);
    let mut drawing = Drawing::new(panel.bottom() + 10.0, given.is_answered);
    drawing.hits(&panel, &hits, &hits);
    drawing.grid(&panel);
    drawing.samples(&panel);
    drawing.outline(&panel, "ink", &[[low, low], [x, low], [x, y], [low, y]], true);
    drawing.grip(panel.place([x, y]), [panel.unit; 2]);
    Ok(LiveFigure {
        drawing,
        predict: Predict::covered(panel, &hits),
        values: vec![
            ("covered", hits.covered().to_string()),
            ("area", number((x - low) * (y - low), 2)),
            ("wide", number(x - low, 2)),
            ("high", number(y - low, 2)),
        ],
        link: with_triangles("triangle", &square, "&window=0,0,5,5&by=scanline,oracle"),
    })
}

/// A position between points of the grid. Asks to which point it is snapped: each coordinate by itself, halfway to the even one.
pub(super) fn snap_to_even(given: &FigureInput<'_>) -> Result<LiveFigure, NoAnswer> {
    let [x, y] = given.at[0];
    // The picture counts in subpixels, the engines in pixels.
    let right = [snap(x / 256.0)?, snap(y / 256.0)?];
    // Each square holds what is nearest to the grid point in its middle.
    let panel = Panel::middle(6, 5, 44.0, 26.0);
    let mut drawing = Drawing::new(panel.bottom() + 10.0, given.is_answered);
    drawing.pixel(&panel, right, "on", "");
    drawing.grid(&panel);
    drawing.samples(&panel);
    // Columns have their numbers above them, rows to the left.
    for i in 0..6 {
        let [along, _] = panel.place(centre([i, 0]));
        drawing.text([along, 18.0], "middle", &i.to_string());
    }
    for j in 0..5 {
        let [_, down] = panel.place(centre([0, j]));
        drawing.text([panel.corner[0] - 10.0, down + 5.0], "end", &j.to_string());
    }
    // The arrow leads to the point that it is snapped to.
    let spot = panel.place([x + 0.5, y + 0.5]);
    if given.is_answered {
        drawing.arrow("ink", spot, panel.place(centre(right)));
    }
    drawing.grip(spot, [panel.unit; 2]);
    Ok(LiveFigure {
        drawing,
        predict: Predict::among(panel, &[right]),
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

/// A mesh on a grid, and how many of its pixels are hit by none of its triangles and by several.
struct MeshOnGrid {
    drawing: Drawing,
    holes: usize,
    twice: usize,
}

/// A rectangle of 9 x 5 px in triangles, as they are given and on the grid of the second grip; the first one, with its letter,
/// drags a corner.
fn snapped_mesh(
    given: &FigureInput<'_>,
    triangles: &[[Point; 3]],
    dragged: Point,
    letter: &str,
) -> Result<MeshOnGrid, NoAnswer> {
    let panel = Panel::middle(9, 5, 38.0, 10.0);
    let placed = on_grid(triangles, given.at[1]);
    let hits = cover(given.fill, &snapped(&placed)?, panel.window);
    let mut drawing = Drawing::new(panel.bottom() + 46.0, given.is_answered);
    // A rectangle without cracks and folds is covered once everywhere.
    drawing.hits(&panel, &hits, &Coverage::new(panel.window, 1));
    drawing.grid(&panel);
    drawing.samples(&panel);
    // Dashed as given; after the prediction as snapped, too.
    for triangle in triangles {
        drawing.outline(&panel, "soft", triangle, true);
    }
    if given.is_answered {
        for triangle in &placed {
            drawing.outline(&panel, "ink", triangle, true);
        }
    }
    drawing.named_grip(panel.place(dragged), [panel.unit, 0.0], letter);
    let says = format!("1/{} px", steps(given.at[1]));
    drawing.slider(given, 1, panel.bottom() + 26.0, &says);
    let (mut holes, mut twice) = (0, 0);
    for [x, y] in panel.pixels() {
        match hits.get(x, y) {
            Some(0) => holes += 1,
            Some(2..) => twice += 1,
            _ => {}
        }
    }
    Ok(MeshOnGrid { drawing, holes, twice })
}

/// A corner within the edge of another triangle, which is snapped without that edge. Asks how many pixels of the crack between
/// them are hit by no triangle.
pub(super) fn snapped_crack(given: &FigureInput<'_>) -> Result<LiveFigure, NoAnswer> {
    let x = given.at[0][0];
    // On the diagonal before it is snapped.
    let q = [x, x * 5.0 / 9.0];
    // The upper triangle has the whole diagonal, the lower two have its parts.
    let (o, e, r, s) = ([0.0, 0.0], [9.0, 0.0], [9.0, 5.0], [0.0, 5.0]);
    let triangles = [[o, r, s], [o, e, q], [e, r, q]];
    let MeshOnGrid { drawing, holes, twice } = snapped_mesh(given, &triangles, q, "Q")?;
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

/// A narrow part of a plane mesh without a corner on an edge, which snapping turns over. Asks how many pixels are hit more than
/// once: nothing is lost, since all triangles have the same corners.
pub(super) fn snapped_fold(given: &FigureInput<'_>) -> Result<LiveFigure, NoAnswer> {
    let x = given.at[0][0];
    // To either side of the diagonal by 1/100 px, so that the narrow triangles between them have an area.
    let (m, n) = ([x, x * 5.0 / 9.0 - 0.01], [6.4, 6.4 * 5.0 / 9.0 + 0.01]);
    let (o, e, r, s) = ([0.0, 0.0], [9.0, 0.0], [9.0, 5.0], [0.0, 5.0]);
    let triangles = [[o, e, m], [e, r, m], [o, m, n], [m, r, n], [o, n, s], [n, r, s]];
    let placed = snapped(&on_grid(&triangles, given.at[1]))?;
    // All of them turn to the same side unless one is folded over, or has lost its area.
    let turned = placed.iter().filter(|corners| twice_area(corners) <= 0).count();
    let MeshOnGrid { drawing, holes, twice } = snapped_mesh(given, &triangles, m, "M")?;
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

/// Asks at which samples the edge function from a to b is 0.
pub(super) fn edge_sign(given: &FigureInput<'_>) -> Result<LiveFigure, NoAnswer> {
    let [a, b] = [given.at[0], given.at[1]];
    let panel = Panel::middle(9, 7, 36.0, 10.0);
    let mut drawing = Drawing::new(panel.bottom() + 10.0, given.is_answered);
    let mut is_zero = Vec::new();
    for pixel in panel.pixels() {
        // The edge function at a sample is twice the area of the triangle with it.
        let sign = twice_area(&snapped_triangle(&[a, b, centre(pixel)])?).signum();
        // Negative, zero, positive.
        let (class, letter) = [("on", "−"), ("twice", "0"), ("one", "+")][(sign + 1) as usize];
        drawing.pixel(&panel, pixel, class, letter);
        is_zero.push(sign == 0);
    }
    drawing.grid(&panel);
    if !given.is_answered {
        drawing.samples(&panel);
    }
    // The side on which the function is positive depends on the direction.
    drawing.arrow("ink", panel.place(a), panel.place(b));
    for (point, letter) in [(a, "a"), (b, "b")] {
        drawing.named_grip(panel.place(point), [panel.unit; 2], letter);
    }
    let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    Ok(LiveFigure {
        drawing,
        values: vec![
            ("zeros", count(&is_zero).to_string()),
            ("dx", number(dx, 1)),
            ("dy", number(dy, 1)),
            // The value at the first sample, by the formula of the page.
            ("first", number(dx * (0.5 - a[1]) - dy * (0.5 - a[0]), 2)),
        ],
        predict: Predict::Pixels(panel, is_zero),
        link: None,
    })
}

/// Asks what a strict rule leaves empty along the edge that two triangles share.
pub(super) fn shared_edge(given: &FigureInput<'_>) -> Result<LiveFigure, NoAnswer> {
    let corner = given.at[0];
    let square = [[[1.0, 1.0], [5.0, 1.0], corner], [[1.0, 1.0], corner, [1.0, 5.0]]];
    let panel = Panel::middle(6, 6, 36.0, 10.0);
    let corners = snapped(&square)?;
    // The strict rule is a planted fault: an engine that is right otherwise.
    let right = cover(given.fill, &corners, panel.window);
    let strict = cover(Engine::Mutant(TriangleMutant::ExclusiveEdges), &corners, panel.window);
    let mut drawing = Drawing::new(panel.bottom() + 10.0, given.is_answered);
    drawing.hits(&panel, &strict, &right);
    drawing.grid(&panel);
    drawing.samples(&panel);
    drawing.outline(&panel, "ink", &square[0], true);
    drawing.outline(&panel, "ink", &square[1], true);
    drawing.grip(panel.place(corner), [panel.unit; 2]);
    // A centre on the diagonal belongs to one of the two triangles, and the strict rule gives it to neither.
    let holes = lacking(&panel, &strict, &right);
    Ok(LiveFigure {
        drawing,
        values: vec![
            ("missing", count(&holes).to_string()),
            ("covered", right.covered().to_string()),
        ],
        predict: Predict::Pixels(panel, holes),
        link: with_triangles("triangle", &square, "&window=0,0,6,6&by=scanline,exclusive-edges"),
    })
}

/// Asks which of two triangles has the samples on their common edge by the top-left rule.
pub(super) fn edge_owner(given: &FigureInput<'_>) -> Result<LiveFigure, NoAnswer> {
    let (p, q) = ([1.5, 3.5], given.at[0]);
    let triangles = [[p, [4.0, 0.5], q], [p, q, [4.0, 6.5]]];
    let corners = snapped(&triangles)?;
    let panel = Panel::middle(8, 7, 36.0, 10.0);
    let upper = cover(given.fill, &corners[..1], panel.window);
    let lower = cover(given.fill, &corners[1..], panel.window);
    let mut drawing = Drawing::new(panel.bottom() + 10.0, given.is_answered);
    // How many of the samples on the common edge each of them has.
    let (mut ties, mut first_tie) = ([0, 0], None);
    for pixel in panel.pixels() {
        // A sample on the common edge makes a triangle without area with its ends.
        let is_tie = twice_area(&snapped_triangle(&[p, q, centre(pixel)])?) == 0;
        let letter = if is_tie { "0" } else { "" };
        for (i, hits) in [&upper, &lower].into_iter().enumerate() {
            if hits.get(pixel[0], pixel[1]) == Some(0) {
                continue;
            }
            drawing.pixel(&panel, pixel, ["one", "two"][i], letter);
            ties[i] += usize::from(is_tie);
            first_tie = first_tie.or(is_tie.then_some(pixel));
        }
    }
    drawing.grid(&panel);
    drawing.samples(&panel);
    for triangle in &triangles {
        drawing.outline(&panel, "ink", triangle, true);
    }
    drawing.grip(panel.place(q), [0.0, panel.unit]);
    // The playground says of this pixel whose it is, edge by edge.
    let mut more = "&window=0,0,8,7".to_owned();
    if let Some([x, y]) = first_tie {
        more += &format!("&px={x},{y}");
    }
    // The first option is the upper triangle, the second the lower one, the third that no sample lies on the edge.
    let owner = match ties {
        [0, 0] => 2,
        [0, _] => 1,
        _ => 0,
    };
    Ok(LiveFigure {
        drawing,
        predict: Predict::Choice(owner),
        values: vec![("upper", ties[0].to_string()), ("lower", ties[1].to_string())],
        link: with_triangles("triangle", &triangles, &more),
    })
}

/// Asks which pixels of one row lie between two edges: a centre on the left edge does, on the right one it does not.
pub(super) fn row_span(given: &FigureInput<'_>) -> Result<LiveFigure, NoAnswer> {
    let corner = [given.at[0][0], 4.0];
    let triangle = [[0.0, 0.0], [0.0, 4.0], corner];
    let panel = Panel::middle(6, 5, 44.0, 10.0);
    let hits = cover(given.fill, &snapped(&[triangle])?, panel.window);
    // Only the third row is asked about: its pixels are a panel of their own.
    let third = PixelRect { y0: 2, y1: 3, ..panel.window };
    let row = Panel { corner: panel.place([0.0, 2.0]), window: third, ..panel };
    let is_hit: Vec<_> = hits.row(2).iter().map(|hits| *hits > 0).collect();
    let mut drawing = Drawing::new(panel.bottom() + 10.0, given.is_answered);
    for x in (0..6).filter(|x| is_hit[*x as usize]) {
        drawing.pixel(&panel, [x, 2], "on", "");
    }
    drawing.grid(&panel);
    drawing.samples(&panel);
    drawing.outline(&panel, "ink", &triangle, true);
    let height = 2.5;
    drawing.outline(&panel, "soft", &[[0.0, height], [6.0, height]], false);
    drawing.grip(panel.place(corner), [panel.unit, 0.0]);
    // The edge rises to the corner over four rows.
    let crossing = corner[0] * height / 4.0;
    Ok(LiveFigure {
        drawing,
        values: vec![("crossing", number(crossing, 4)), ("count", count(&is_hit).to_string())],
        predict: Predict::Pixels(row, is_hit),
        link: with_triangles("triangle", &[triangle], "&window=0,0,6,5&px=1,2"),
    })
}

/// A triangle that published code cuts at its middle corner. Asks how many pixels it hits twice.
pub(super) fn middle_row(given: &FigureInput<'_>) -> Result<LiveFigure, NoAnswer> {
    let middle = given.at[0];
    let triangle = [[2.5, 11.5], middle, [2.5, 4.5]];
    // The part of the window around the triangle.
    let panel = Panel::new([24.0, 10.0], 26.0, [1, 3, 13, 13]);
    let mut hits = Coverage::new(panel.window, 0);
    BookChapter2.cover(&bare(triangle), panel.window, &mut |span| {
        hits.hit(span.y_px, span.x0_px, span.x1_px);
    })?;
    let right = cover(given.fill, &snapped(&[triangle])?, panel.window);
    let mut drawing = Drawing::new(panel.bottom() + 10.0, given.is_answered);
    drawing.hits(&panel, &hits, &right);
    drawing.grid(&panel);
    drawing.samples(&panel);
    drawing.outline(&panel, "ink", &triangle, true);
    drawing.grip(panel.place(middle), [panel.unit; 2]);
    // The two parts meet in the row of the middle corner, and both draw it.
    let twice = panel.pixels().filter(|p| hits.get(p[0], p[1]) > Some(1)).count();
    Ok(LiveFigure {
        drawing,
        predict: Predict::Number(twice as f64, 0),
        values: vec![("twice", twice.to_string())],
        link: with_triangles("triangle", &[triangle], "&window=1,3,13,13&by=scanline,book-ch2"),
    })
}
