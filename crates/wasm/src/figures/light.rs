//! Figures about light and textures.

use glam::{DVec2, DVec3};

use super::drawing::{Drawing, Panel, Point};
use super::{FigureInput, LiveFigure, Predict, number};
use crate::no_answer::NoAnswer;
use rasterproof_core::angle::sin_cos;
use rasterproof_core::contract::DrawLine as _;
use rasterproof_core::triangle::{LineEnd, PixelPoint, ScreenLine};
use rasterproof_render::pipeline::shade::Light;
use rasterproof_render::pipeline::texture::{Filter, Texture, Wrap};

/// The direction at so many degrees to the right of upwards, in the plane of the drawing.
fn direction(degrees: f64) -> DVec3 {
    let (sin, cos) = sin_cos(degrees.to_radians());
    DVec3::new(sin, cos, 0.0)
}

/// The direction of the normal of half a cylinder at a pixel of a row of 13, in degrees to the right of upwards.
fn normal_degrees(x: i32) -> f64 {
    f64::from(x - 6) * 15.0
}

/// A point so far from the axis of the cylinder, which is seen from its end.
fn around(degrees: f64, radius: f64) -> Point {
    let towards = direction(degrees);
    [180.0 + towards.x * radius, 132.0 - towards.y * radius]
}

/// Half of a cylinder with its normals. Asks which pixel is the brightest: the one whose normal points to the light.
pub(super) fn brightest(given: &FigureInput<'_>) -> Result<LiveFigure, NoAnswer> {
    let angle = given.at[0][0];
    // A fifth of the light comes from everywhere.
    let light = Light { towards: direction(angle), ambient: 0.2, diffuse: 0.8 };
    let panel = Panel::middle(13, 1, 26.0, 150.0);
    let mut drawing = Drawing::new(panel.bottom() + 48.0, given.is_answered);
    // Each normal belongs to the pixel of the same place in the row.
    let (mut bright, mut arc) = (Vec::new(), Vec::new());
    for x in 0..13 {
        let value = light.intensity(direction(normal_degrees(x)));
        drawing.colour(&panel, [x, 0], DVec3::splat(value));
        bright.push(value);
        arc.push(around(normal_degrees(x), 56.0));
    }
    let most = bright.iter().copied().fold(0.0, f64::max);
    drawing.grid(&panel);
    drawing.path("ink", &arc, true);
    for (x, foot) in (0..).zip(arc) {
        drawing.path("grid", &[foot, around(normal_degrees(x), 72.0)], false);
    }
    // The light comes from outside.
    drawing.arrow("ink", around(angle, 122.0), around(angle, 76.0));
    drawing.slider(given, 0, panel.bottom() + 26.0, &format!("{}°", number(angle, 0)));
    // Two pixels are equally bright where the light comes from between their normals; what is away from it has the ambient 0.2.
    let brightest = bright.iter().map(|value| *value >= most - 1e-9).collect();
    let dark = bright.iter().filter(|&&value| value <= 0.2 + 1e-9).count();
    Ok(LiveFigure {
        drawing,
        predict: Predict::Pixels(panel, brightest),
        values: vec![("dark", dark.to_string())],
        link: None,
    })
}

/// A normal between two others, as it is and brought back to length 1. Asks how bright the middle is with the one that is too
/// short, as the mean of two directions is.
pub(super) fn short_normal(given: &FigureInput<'_>) -> Result<LiveFigure, NoAnswer> {
    let angle = given.at[0][0];
    let [a, b] = [direction(-angle / 2.0), direction(angle / 2.0)];
    // All light comes from above, so that the brightness is the cosine alone.
    let light = Light { towards: DVec3::Y, ambient: 0.0, diffuse: 1.0 };
    let end = |x, varying| LineEnd { pixel: PixelPoint::new(x, 0), depth: 0.0, varying };
    let line = ScreenLine { ends: [end(0, a), end(12, b)] };
    let rows = [Panel::middle(13, 1, 26.0, 104.0), Panel::middle(13, 1, 26.0, 162.0)];
    let mut normals = Vec::new();
    given.pen.draw(&line, rows[0].window, |f| normals.push(f.varying));
    let mut drawing = Drawing::new(rows[1].bottom() + 48.0, given.is_answered);
    // Above with the length that interpolation leaves, below with length 1.
    for (x, normal) in (0..).zip(&normals) {
        let short = normal.dot(light.towards).max(0.0);
        for (panel, value) in rows.iter().zip([short, light.intensity(*normal)]) {
            drawing.colour(panel, [x, 0], DVec3::splat(value));
        }
    }
    // Every third normal over its pixel, as long as it is.
    for (x, normal) in (0..).zip(&normals).step_by(3) {
        let [left, _] = rows[0].place([f64::from(x) + 0.5, 0.0]);
        drawing.arrow("ink", [left, 62.0], [left + normal.x * 30.0, 62.0 - normal.y * 30.0]);
    }
    for (panel, says) in rows.iter().zip(["n · l", "n · l / |n|"]) {
        drawing.grid(panel);
        drawing.text([12.0, panel.corner[1] - 7.0], "start", says);
        drawing.middle_mark(panel);
    }
    drawing.slider(given, 0, rows[1].bottom() + 30.0, &format!("{}°", number(angle, 0)));
    // The seventh of 13 pixels is the middle.
    let middle = normals[6].dot(light.towards) * 100.0;
    Ok(LiveFigure {
        drawing,
        predict: Predict::Number(middle, 0),
        values: vec![
            ("short", number(middle, 0)),
            ("whole", number(light.intensity(normals[6]) * 100.0, 0)),
        ],
        link: None,
    })
}

/// The brightness, from 0 to 255, that a texture of one row has at u.
fn looked_up(texture: &Texture, u: f64) -> f64 {
    texture.at(DVec2::new(u, 0.5)).x * 255.0
}

/// A place between two texels. Asks what the bilinear look-up reads there; the nearest one stands beside it.
pub(super) fn texel(given: &FigureInput<'_>) -> Result<LiveFigure, NoAnswer> {
    let u = given.at[0][0];
    let texels = [10, 20, 30, 40].map(|value| [value; 3]);
    // The same texture for both ways of looking it up.
    let mut ways = Vec::new();
    for filter in [Filter::Nearest, Filter::Bilinear] {
        let texture = Texture::new(4, 1, &texels).ok_or("four texels are a texture")?;
        ways.push(texture.with(filter, Wrap::Clamp));
    }
    let rows = [Panel::middle(16, 1, 21.0, 96.0), Panel::middle(16, 1, 21.0, 146.0)];
    let mut drawing = Drawing::new(rows[1].bottom() + 46.0, given.is_answered);
    // The texels with their brightness and their centre.
    let [left, _] = rows[0].corner;
    for i in 0..4 {
        let x = left + f64::from(i) * 84.0;
        drawing.path("grid", &[[x, 14.0], [x + 84.0, 14.0], [x + 84.0, 56.0], [x, 56.0]], true);
        drawing.text([x + 42.0, 34.0], "middle", &((i + 1) * 10).to_string());
        drawing.dot([x + 42.0, 46.0], 2.5);
    }
    // Where u is on them: four texels of 84 px.
    let here = left + u * 336.0;
    // Above and below the numbers, so that it hides none.
    for [top, bottom] in [[6.0, 20.0], [38.0, 62.0]] {
        drawing.path("ink", &[[here, top], [here, bottom]], false);
    }
    for ((panel, texture), says) in rows.iter().zip(&ways).zip(["nearest", "bilinear"]) {
        for x in 0..16 {
            let value = looked_up(texture, (f64::from(x) + 0.5) / 16.0);
            // Brightnesses from 10 to 40, told apart by eye.
            drawing.colour(panel, [x, 0], DVec3::splat(value / 45.0));
        }
        drawing.grid(panel);
        drawing.text([12.0, panel.corner[1] - 6.0], "start", says);
    }
    drawing.slider(given, 0, rows[1].bottom() + 24.0, &format!("u = {}", number(u, 2)));
    let (nearest, mixed) = (looked_up(&ways[0], u), looked_up(&ways[1], u));
    Ok(LiveFigure {
        drawing,
        predict: Predict::Number(mixed, 0),
        values: vec![
            ("nearest", number(nearest, 0)),
            ("mixed", number(mixed, 0)),
            ("place", number(4.0 * u, 2)),
        ],
        link: None,
    })
}
