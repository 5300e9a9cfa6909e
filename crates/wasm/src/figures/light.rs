//! Figures about light and textures.

use glam::{DVec2, DVec3};

use super::drawing::{Drawing, Panel};
use super::{FigureInput, LiveFigure, Predict, number};
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

/// Half of a cylinder, its normals, and how bright its pixels are.
pub(super) fn brightest(given: &FigureInput<'_>) -> Result<LiveFigure, String> {
    let angle = given.at[0][0];
    let light = Light { towards: direction(angle), ambient: 0.2, diffuse: 0.8 };
    let panel = Panel::middle(13, 1, 26.0, 150.0);
    let mut drawing = Drawing::new(panel.bottom() + 48.0, given.is_answered);
    let degrees = |i: i32| f64::from(i - 6) * 15.0;
    let bright: Vec<f64> = (0..13).map(|i| light.intensity(direction(degrees(i)))).collect();
    let most = bright.iter().copied().fold(0.0, f64::max);
    for (x, &value) in (0..).zip(&bright) {
        drawing.colour(&panel, [x, 0], DVec3::splat(value));
    }
    drawing.grid(&panel);
    // The cylinder from its end; each normal belongs to the pixel of the same place in the row.
    let around = |degrees: f64, radius: f64| {
        let d = direction(degrees);
        [180.0 + d.x * radius, 132.0 - d.y * radius]
    };
    let arc: Vec<_> = (0..13).map(|i| around(degrees(i), 56.0)).collect();
    drawing.path("ink", &arc, true);
    for i in 0..13 {
        drawing.path("grid", &[around(degrees(i), 56.0), around(degrees(i), 72.0)], false);
    }
    drawing.arrow("ink", around(angle, 122.0), around(angle, 76.0));
    drawing.slider(given, 0, panel.bottom() + 26.0, &format!("{}°", number(angle, 0)));
    let pixels = (0..).zip(&bright).map(|(x, &value)| ([x, 0], value >= most - 1e-9)).collect();
    let dark = bright.iter().filter(|&&value| value <= 0.2 + 1e-9).count();
    Ok(LiveFigure {
        drawing,
        predict: Predict::Pixels(panel, pixels),
        values: vec![("dark", dark.to_string())],
        link: None,
    })
}

/// A normal between two others, as it is and brought back to length 1.
pub(super) fn short_normal(given: &FigureInput<'_>) -> Result<LiveFigure, String> {
    let angle = given.at[0][0];
    let [a, b] = [direction(-angle / 2.0), direction(angle / 2.0)];
    let light = Light { towards: DVec3::Y, ambient: 0.0, diffuse: 1.0 };
    let end = |x, varying| LineEnd { pixel: PixelPoint::new(x, 0), depth: 0.0, varying };
    let line = ScreenLine { ends: [end(0, a), end(12, b)] };
    let rows = [Panel::middle(13, 1, 26.0, 104.0), Panel::middle(13, 1, 26.0, 162.0)];
    let mut normals = Vec::new();
    given.pen.draw(&line, rows[0].window, |f| normals.push(f.varying));
    let mut drawing = Drawing::new(rows[1].bottom() + 48.0, given.is_answered);
    for (x, normal) in (0..).zip(&normals) {
        let short = normal.dot(light.towards).max(0.0);
        for (panel, value) in rows.iter().zip([short, light.intensity(*normal)]) {
            drawing.colour(panel, [x, 0], DVec3::splat(value));
        }
    }
    for (x, normal) in (0..).zip(&normals).step_by(3) {
        let [left, _] = rows[0].place([f64::from(x) + 0.5, 0.0]);
        drawing.arrow("ink", [left, 62.0], [left + normal.x * 30.0, 62.0 - normal.y * 30.0]);
    }
    for (panel, says) in rows.iter().zip(["n · l", "n · l / |n|"]) {
        drawing.grid(panel);
        drawing.text([12.0, panel.corner[1] - 7.0], "start", says);
        let [x, y] = panel.place([6.5, 1.0]);
        drawing.path("ink", &[[x - 6.0, y + 12.0], [x, y + 3.0], [x + 6.0, y + 12.0]], true);
    }
    drawing.slider(given, 0, rows[1].bottom() + 30.0, &format!("{}°", number(angle, 0)));
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

/// A place between two texels, looked up in both ways.
pub(super) fn texel(given: &FigureInput<'_>) -> Result<LiveFigure, String> {
    let u = given.at[0][0];
    let texels = [10, 20, 30, 40].map(|value| [value; 3]);
    let texture = || {
        let texture = Texture::new(4, 1, &texels);
        texture.ok_or_else(|| "four texels are a texture".to_owned())
    };
    let ways = [
        texture()?.with(Filter::Nearest, Wrap::Clamp),
        texture()?.with(Filter::Bilinear, Wrap::Clamp),
    ];
    let at = |texture: &Texture, u: f64| texture.at(DVec2::new(u, 0.5)).x * 255.0;
    let rows = [Panel::middle(16, 1, 21.0, 96.0), Panel::middle(16, 1, 21.0, 146.0)];
    let mut drawing = Drawing::new(rows[1].bottom() + 46.0, given.is_answered);
    let [left, _] = rows[0].corner;
    for i in 0..4 {
        let x = left + f64::from(i) * 84.0;
        drawing.path("grid", &[[x, 14.0], [x + 84.0, 14.0], [x + 84.0, 56.0], [x, 56.0]], true);
        drawing.text([x + 42.0, 34.0], "middle", &((i + 1) * 10).to_string());
        drawing.dot([x + 42.0, 46.0], 2.5);
    }
    let here = left + u * 336.0;
    // Above and below the numbers, so that it hides none.
    for [top, bottom] in [[6.0, 20.0], [38.0, 62.0]] {
        drawing.path("ink", &[[here, top], [here, bottom]], false);
    }
    for ((panel, texture), says) in rows.iter().zip(&ways).zip(["nearest", "bilinear"]) {
        for x in 0..16 {
            let value = at(texture, (f64::from(x) + 0.5) / 16.0);
            // Brightnesses from 10 to 40, told apart by eye.
            drawing.colour(panel, [x, 0], DVec3::splat(value / 45.0));
        }
        drawing.grid(panel);
        drawing.text([12.0, panel.corner[1] - 6.0], "start", says);
    }
    drawing.slider(given, 0, rows[1].bottom() + 24.0, &format!("u = {}", number(u, 2)));
    let [nearest, mixed] = [at(&ways[0], u), at(&ways[1], u)];
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
