//! What a program draws at a step, as pictures: the same requests go to the program and to this project's engines, and
//! one function turns either's answers into pixels.
//!
//! Scenes go through the project's pipeline: transform, clip, cull, viewport. The program gets the triangles of the window
//! with two attributes that are 1 at one corner and 0 at the others. These are the weights of the corners, so that any
//! number of attributes follows from what it answers; depths are compared and colours computed here.

use std::ops::Range;

use glam::{DVec2, DVec3};
use image::{Rgb, RgbImage, imageops};

use rasterproof_core::angle::{cos, sin};
use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_core::triangle::{Fragment, PixelPoint, ScreenVertex, Span};
use rasterproof_judge::ask::{Answer, Asked, Question, Subject};
use rasterproof_judge::declared::Declared;
use rasterproof_judge::in_process::Inside;
use rasterproof_judge::run::MOST_DEATHS;
use rasterproof_registry::engines::ENTRIES;
use rasterproof_render::effects::geometry::{Surface, SurfaceMaterial, Whole};
use rasterproof_render::effects::primitive::BadScene;
use rasterproof_render::pipeline::target::to_colour;
use rasterproof_render::scene::Scene;
use rasterproof_report::html::{Outcome, PictureLayer, PictureView, Report};
use rasterproof_report::{panels, picture, words};
use rasterproof_verify::cases::Triangle;
use rasterproof_verify::oracle::formula::Formula;

use super::Step;

/// A picture as the program draws it and as this project's engines draw it.
pub struct ProgramPicture {
    pub title: &'static str,
    pub yours: RgbImage,
    pub right: RgbImage,
    /// Pixels that differ by more than [`VISIBLE`].
    pub differing: u64,
    /// Requests that were refused, or came to no answer.
    pub unanswered: u64,
}

/// Steps of 255 that two channels may differ by: values have a tolerance, colours are rounded.
pub const VISIBLE: u8 = 2;

const BACKGROUND: Rgb<u8> = Rgb([18, 18, 24]);
/// The colour of pixels that two triangles of a mosaic draw.
const TWICE: Rgb<u8> = Rgb([255; 3]);
/// The colours of lines and triangles, in turn.
const INK: [Rgb<u8>; 4] =
    [Rgb([240, 200, 60]), Rgb([120, 200, 255]), Rgb([240, 130, 110]), Rgb([150, 220, 140])];
/// The size of a large picture; smaller ones are a half or a quarter of it.
const WIDTH: u32 = 160;
const HEIGHT: u32 = 120;

/// This project's engines behind the interface of a program: lines by one entry, triangles by another.
struct Right {
    lines: Inside,
    triangles: Inside,
    formulas: Inside,
}

impl Right {
    fn new() -> Self {
        Self {
            lines: inside("bresenham"),
            triangles: inside("edge-function"),
            formulas: inside("oracle"),
        }
    }
}

/// The engine of this name, as a program would be.
fn inside(name: &str) -> Inside {
    let entry = ENTRIES.iter().find(|entry| entry.name == name);
    Inside::new(entry.expect("the engine has an entry"))
}

impl Subject for Right {
    fn declared(&self) -> &Declared {
        self.triangles.declared()
    }

    fn ask(&mut self, questions: &[Question], most_deaths: u64) -> Vec<Answer> {
        let mut answers = Vec::with_capacity(questions.len());
        for question in questions {
            let engine = match question.of {
                Asked::Line { .. } => &mut self.lines,
                Asked::Formula(..) => &mut self.formulas,
                _ => &mut self.triangles,
            };
            answers.extend(engine.ask(std::slice::from_ref(question), most_deaths));
        }
        answers
    }
}

/// Turns the answers of a program into pictures, and counts the requests that had no usable answer.
struct Studio<'a> {
    asked: &'a mut dyn Subject,
    unanswered: u64,
}

impl Studio<'_> {
    /// An answer for each request, in batches; nothing for those that were refused or never came.
    fn ask(&mut self, width: u32, height: u32, all: Vec<Asked>) -> Vec<Option<Answer>> {
        let questions: Vec<_> = all.into_iter().map(|of| Question { width, height, of }).collect();
        let mut answers = Vec::with_capacity(questions.len());
        for batch in questions.chunks(256) {
            let end = answers.len() + batch.len();
            // A program that failed often enough in earlier pictures is not asked any more.
            if self.unanswered < MOST_DEATHS {
                answers.extend(self.asked.ask(batch, MOST_DEATHS).into_iter().map(Some));
            }
            // It may stop early, and each answer has to stay beside its request.
            answers.resize(end, None);
        }
        for answer in &mut answers {
            if matches!(answer, None | Some(Answer::Refused(_) | Answer::Died(_))) {
                self.unanswered += 1;
                *answer = None;
            }
        }
        answers
    }

    /// Lines between pixels; their colours change in turn.
    fn lines(&mut self, width: u32, height: u32, lines: &[[[i32; 2]; 2]]) -> RgbImage {
        let mut asked = Vec::new();
        for ends in lines {
            let ends = ends.map(|[x, y]| PixelPoint::new(x, y));
            asked.push(Asked::Line { ends, whole: false });
        }
        let answers = self.ask(width, height, asked);
        // An answer of another kind than was asked for draws nothing.
        let mut image = picture::plain(width, height, BACKGROUND);
        for (number, answer) in answers.iter().enumerate() {
            let Some(Answer::Line(pixels)) = answer else { continue };
            for &(x, y) in pixels {
                put(&mut image, x, y, INK[number % INK.len()]);
            }
        }
        image
    }

    /// Triangles side by side, each in the next colour; what is drawn twice is white.
    fn mosaic(&mut self, width: u32, height: u32, triangles: &[[[f64; 2]; 3]]) -> RgbImage {
        let asked = triangles.iter().map(|t| Asked::Coverage(t.map(point))).collect();
        let answers = self.ask(width, height, asked);
        let mut image = picture::plain(width, height, BACKGROUND);
        for (number, answer) in answers.iter().enumerate() {
            let Some(Answer::Coverage(runs)) = answer else { continue };
            for run in runs {
                let (row, columns) = pixels(run, width, height);
                for x in columns {
                    let is_first = *image.get_pixel(x, row) == BACKGROUND;
                    let colour = if is_first { INK[number % INK.len()] } else { TWICE };
                    image.put_pixel(x, row, colour);
                }
            }
        }
        image
    }

    /// The fragments of triangles through a shader, without a depth test.
    fn values(
        &mut self,
        width: u32,
        height: u32,
        triangles: Vec<Triangle>,
        shade: fn(&Fragment<DVec2>) -> DVec3,
    ) -> RgbImage {
        // Without a depth test, later triangles are drawn over earlier ones.
        let answers = self.ask(width, height, triangles.into_iter().map(Asked::Values).collect());
        let mut image = picture::plain(width, height, BACKGROUND);
        for answer in answers {
            let Some(Answer::Values(fragments)) = answer else { continue };
            for f in fragments {
                put(&mut image, f.x_px, f.y_px, rgb(shade(&f)));
            }
        }
        image
    }

    /// A pixel for each point of the edges of a cube, at the place that its numbers become, and the darker the larger the depth.
    fn wireframe(
        &mut self,
        formula: Formula,
        numbers: fn([f64; 3]) -> Vec<f64>,
        place: fn(&[f64]) -> Option<[f64; 3]>,
    ) -> RgbImage {
        let mut asked = Vec::new();
        for point in cube_edges() {
            asked.push(Asked::Formula(formula, numbers(point)));
        }
        let mut image = picture::plain(WIDTH, HEIGHT, BACKGROUND);
        for answer in self.ask(WIDTH, HEIGHT, asked) {
            let Some(Answer::Numbers(numbers)) = answer else { continue };
            let Some([x, y, depth]) = place(&numbers) else { continue };
            // Near edges are bright, and those at the far plane are black.
            let colour = DVec3::new(1.0, 0.85, 0.4) * (1.0 - depth.clamp(0.0, 1.0));
            put(&mut image, x.floor() as i32, y.floor() as i32, rgb(colour));
        }
        image
    }

    /// A window in which each pixel asks a formula, and shows the first number as a colour.
    fn shaded(
        &mut self,
        formula: Formula,
        numbers: fn([f64; 2]) -> Option<Vec<f64>>,
        shade: fn(f64) -> DVec3,
    ) -> RgbImage {
        let (width, height) = (WIDTH / 2, HEIGHT / 2);
        // Where the formula has no numbers, nothing is asked, so the place of each request is kept beside it.
        let (mut places, mut asked) = (Vec::new(), Vec::new());
        for y in 0..height as i32 {
            for x in 0..width as i32 {
                let centre = [f64::from(x) + 0.5, f64::from(y) + 0.5];
                if let Some(numbers) = numbers(centre) {
                    places.push([x, y]);
                    asked.push(Asked::Formula(formula, numbers));
                }
            }
        }
        let answers = self.ask(width, height, asked);
        let mut image = picture::plain(width, height, BACKGROUND);
        for ([x, y], answer) in places.into_iter().zip(answers) {
            let Some(Answer::Numbers(numbers)) = answer else { continue };
            let Some(number) = numbers.first() else { continue };
            put(&mut image, x, y, rgb(shade(*number)));
        }
        image
    }

    /// A scene after assembly: the program rasterizes its pieces, depths are compared and colours computed here.
    fn scene(&mut self, whole: &Whole<'_>, background: Rgb<u8>) -> RgbImage {
        let (width, height) = (whole.window.width(), whole.window.height());
        let mut image = picture::plain(width, height, background);
        let mut nearest = vec![f64::INFINITY; width as usize * height as usize];
        for run in whole.runs(256) {
            // The pieces of the window, and a request for each in which two attributes are the weights of its corners.
            let mut surfaces = Vec::new();
            whole.outlines(&run, &mut |outline| surfaces.push(whole.surface(&outline)));
            let mut asked = Vec::with_capacity(surfaces.len());
            for surface in &surfaces {
                let [a, b, c] = &surface.corners;
                asked.push(Asked::Values(Triangle {
                    vertices: [
                        a.with_varying(DVec2::X),
                        b.with_varying(DVec2::Y),
                        c.with_varying(DVec2::ZERO),
                    ],
                }));
            }
            // Of the fragments at a pixel, the nearest one is seen, whoever drew them.
            for (surface, answer) in surfaces.iter().zip(self.ask(width, height, asked)) {
                let Some(Answer::Values(fragments)) = answer else { continue };
                for f in fragments {
                    let inside =
                        (0..width as i32).contains(&f.x_px) && (0..height as i32).contains(&f.y_px);
                    let at = f.y_px as usize * width as usize + f.x_px as usize;
                    if inside && f.depth < nearest[at] {
                        nearest[at] = f.depth;
                        put(&mut image, f.x_px, f.y_px, rgb(shade(surface, f.varying)));
                    }
                }
            }
        }
        image
    }
}

/// The colour of a surface where its first two corners have these weights.
fn shade(surface: &Surface<'_>, weights: DVec2) -> DVec3 {
    // The scenes of the course have neither highlights nor fog.
    let SurfaceMaterial { base, colours, light, texture, .. } = surface.material;
    let l = [weights.x, weights.y, 1.0 - weights.x - weights.y];
    // Every value of the surface there: a colour, a normal, texture coordinates.
    let mut values = [0.0; 8];
    for (i, value) in values.iter_mut().enumerate() {
        *value = (0..3).map(|corner| l[corner] * surface.values[corner][i]).sum();
    }
    let [r, g, b, nx, ny, nz, u, v] = values;
    let mut colour = base.as_dvec3() / 255.0;
    if *colours {
        colour *= DVec3::new(r, g, b);
    }
    if let Some(texture) = texture {
        colour *= texture.at(DVec2::new(u, v));
    }
    if let Some(light) = light {
        // Interpolated normals are shorter than 1.
        let normal = DVec3::new(nx, ny, nz).normalize_or_zero();
        let cosine = normal.dot(light.towards.as_dvec3()).max(0.0);
        colour *= f64::from(light.ambient) + f64::from(light.diffuse) * cosine;
    }
    colour
}

/// The pictures of a step, by the program and by this project's engines.
pub fn step(program: &mut dyn Subject, step: &Step) -> Vec<ProgramPicture> {
    /// Draws a picture by whoever answers.
    type Draw = fn(&mut Studio<'_>) -> RgbImage;
    let pictures: &[(&'static str, Draw)] = match step.name.as_str() {
        "pixel" => &[("pixels of a circle; some lie outside", circle)],
        "dda" => &[("lines in all octants", octants)],
        "bresenham" => &[("lines with ties, and lines that leave the window", ties)],
        "scanline" => &[("a triangle", one_triangle)],
        "edge-function" => &[("slivers of both windings", slivers)],
        "top-left" => &[("squares with corners at the centres of pixels", squares)],
        "fans" => &[("a fan without cracks", fan)],
        "values" => &[("z as red, a as green, b as blue", three_values)],
        "perspective" => &[
            ("a textured floor", checkered_floor),
            ("the same with every w set to 1: no division", undivided_floor),
        ],
        "depth" => &[
            ("triangles that go through one another", pile),
            ("z as brightness, on the floor of step 5", depths_of_floor),
        ],
        "clipping" => &[("a floor that begins behind the eye", cut_floor)],
        "projection" => &[("the edges of a cube on the film", cube_on_film)],
        "window" => &[("the same edges in the window, darker with the depth", cube_in_window)],
        "culling" => &[("triangles to each pixel: clockwise ones are light", windings)],
        "matrices" => &[("the edges of a cube, turned about its centre", turned_cube)],
        "light" => &[("a ball in the light", ball), ("a row of texels: nearest", texels)],
        "levels" => &[("levels of a floor, darker from level to level", levels_of_floor)],
        _ => &[("edges as bright as the share of their samples", spokes)],
    };
    let mut drawn = Vec::new();
    for (title, draw) in pictures {
        drawn.push(both(program, title, &mut |studio| draw(studio)));
    }
    drawn
}

/// Each pixel of a circle is a line from it to itself.
fn circle(studio: &mut Studio<'_>) -> RgbImage {
    let mut lines = Vec::new();
    for i in 0..24 {
        let end = turned(f64::from(i) / 24.0, [8.0, 6.0], 6.8).map(|v| v.floor() as i32);
        lines.push([end, end]);
    }
    studio.lines(16, 12, &lines)
}

/// Lines in all directions, steep and flat.
fn octants(studio: &mut Studio<'_>) -> RgbImage {
    studio.lines(48, 36, &star([23, 17], 15, 6))
}

/// Lines that pass between two pixels, and lines whose ends lie outside the window.
fn ties(studio: &mut Studio<'_>) -> RgbImage {
    let mut lines = star([24, 18], 16, 8);
    lines.extend([[[-100, 0], [100, 2]], [[100, 35], [-100, 33]], [[0, 200], [2, -200]]]);
    studio.lines(48, 36, &lines)
}

/// A triangle whose corners lie between pixels.
fn one_triangle(studio: &mut Studio<'_>) -> RgbImage {
    studio.mosaic(32, 24, &[[[3.3, 2.2], [28.7, 8.4], [9.6, 21.8]]])
}

/// Thin triangles around a middle, of both windings in turn.
fn slivers(studio: &mut Studio<'_>) -> RgbImage {
    let middle = [24.0, 18.0];
    let mut triangles = Vec::new();
    for i in 0..9 {
        let from = f64::from(i);
        let [a, b] = [from, from + 0.16].map(|part| turned(part / 9.0, middle, 17.0));
        // Every second one runs the other way.
        triangles.push(if i % 2 == 0 { [middle, a, b] } else { [middle, b, a] });
    }
    studio.mosaic(48, 36, &triangles)
}

/// Three rows of four squares, each of two halves, which share their edges.
fn squares(studio: &mut Studio<'_>) -> RgbImage {
    let mut halves = Vec::new();
    for i in 0..12 {
        let (x, y) = (2.5 + 6.0 * f64::from(i % 4), 2.5 + 6.0 * f64::from(i / 4));
        let (right, bottom) = (x + 6.0, y + 6.0);
        halves.push([[x, y], [right, y], [x, bottom]]);
        halves.push([[right, y], [right, bottom], [x, bottom]]);
    }
    studio.mosaic(32, 24, &halves)
}

/// Twelve triangles around a middle, which share their long edges.
fn fan(studio: &mut Studio<'_>) -> RgbImage {
    let middle = [80.5, 60.5];
    let mut triangles = Vec::new();
    for i in 0..12 {
        let [a, b] = [i, i + 1].map(|i| turned(f64::from(i) / 12.0, middle, 50.0));
        triangles.push([middle, a, b]);
    }
    studio.mosaic(WIDTH, HEIGHT, &triangles)
}

/// Depth and both attributes as the three parts of a colour.
fn three_values(studio: &mut Studio<'_>) -> RgbImage {
    let vertices = [
        vertex([80.0, 8.0], 1.0, 1.0, DVec2::ZERO),
        vertex([150.0, 110.0], 0.0, 1.0, DVec2::X),
        vertex([10.0, 110.0], 0.0, 1.0, DVec2::Y),
    ];
    let shade = |f: &Fragment<DVec2>| DVec3::new(f.depth, f.varying.x, f.varying.y);
    studio.values(WIDTH, HEIGHT, vec![Triangle { vertices }], shade)
}

/// Texture coordinates in perspective, as squares.
fn checkered_floor(studio: &mut Studio<'_>) -> RgbImage {
    studio.values(WIDTH, HEIGHT, floor(true), checkered)
}

/// The same without perspective, which bends its lines.
fn undivided_floor(studio: &mut Studio<'_>) -> RgbImage {
    studio.values(WIDTH, HEIGHT, floor(false), checkered)
}

/// The depth of the same floor as brightness.
fn depths_of_floor(studio: &mut Studio<'_>) -> RgbImage {
    studio.values(WIDTH, HEIGHT, floor(true), |f| DVec3::splat(f.depth))
}

/// Three triangles that go through one another.
fn pile(studio: &mut Studio<'_>) -> RgbImage {
    let pile = [
        [[10.0, 20.0, 0.1], [150.0, 30.0, 0.9], [20.0, 110.0, 0.3]],
        [[150.0, 10.0, 0.1], [140.0, 105.0, 0.4], [8.0, 70.0, 0.9]],
        [[70.0, 5.0, 0.5], [110.0, 115.0, 0.5], [50.0, 115.0, 0.5]],
    ];
    let pile = pile.map(|corners| Triangle {
        vertices: corners.map(|[x, y, z]| vertex([x, y], z, 1.0, DVec2::ZERO)),
    });
    let answers = studio.ask(WIDTH, HEIGHT, vec![Asked::Depth(pile.into())]);
    let mut image = picture::plain(WIDTH, HEIGHT, BACKGROUND);
    if let [Some(Answer::Seen(runs))] = &answers[..] {
        for (run, number) in runs {
            let (row, columns) = pixels(run, WIDTH, HEIGHT);
            for x in columns {
                image.put_pixel(x, row, INK[usize::from(*number) % INK.len()]);
            }
        }
    }
    image
}

/// A floor that begins behind the eye: cut by the program at the near plane, then drawn by it.
fn cut_floor(studio: &mut Studio<'_>) -> RgbImage {
    let [a, b, c, d] = [[-3.0, -4.0], [-3.0, 12.0], [3.0, 12.0], [3.0, -4.0]].map(|[x, z]| {
        let [x, y, z, w] = on_floor(x, z);
        // As `clip_corners` reads them: w is an attribute.
        vertex([x, y], z, 1.0, DVec2::new(w, 0.0))
    });
    let asked = [[a, b, c], [a, c, d]].map(|vertices| Asked::Near(Triangle { vertices }));
    let mut pieces = Vec::new();
    for answer in studio.ask(WIDTH, HEIGHT, asked.into()) {
        let Some(Answer::Polygon(polygon)) = answer else { continue };
        // The polygon as a fan around its first corner.
        for pair in polygon.get(1..).unwrap_or_default().windows(2) {
            let piece = [polygon[0], pair[0], pair[1]];
            // What was not cut has no place in the window.
            if piece.iter().all(|[_, _, _, w, _]| *w > 0.0) {
                let vertices = piece.map(|[x, y, z, w, _]| in_window([x, y, z, w]));
                pieces.push(Triangle { vertices });
            }
        }
    }
    studio.values(WIDTH, HEIGHT, pieces, checkered)
}

/// The edges of a cube as [`Formula::Project`] gives them: x and y on the film.
fn cube_on_film(studio: &mut Studio<'_>) -> RgbImage {
    let place = |film: &[f64]| match *film {
        [x, y, _] => Some([80.0 + 40.0 * x, 60.0 - 40.0 * y, 0.0]),
        _ => None,
    };
    studio.wireframe(Formula::Project, |[x, y, z]| vec![2.0, x, y, z], place)
}

/// The same edges by [`Formula::Window`]: places in the window, and depths.
fn cube_in_window(studio: &mut Studio<'_>) -> RgbImage {
    let numbers = |[x, y, z]: [f64; 3]| vec![WIDTH.into(), HEIGHT.into(), 1.5, 8.0, x, y, z];
    studio.wireframe(Formula::Window, numbers, |place| place.try_into().ok())
}

/// The edges after a turn by [`Formula::Turn`], projected here.
fn turned_cube(studio: &mut Studio<'_>) -> RgbImage {
    let numbers = |[x, y, z]: [f64; 3]| vec![1.0, 0.8, 0.6, 0.0, 0.0, 4.0, x, y, z];
    let place = |point: &[f64]| match *point {
        [x, y, z] if z > 0.0 => Some([80.0 + 80.0 * x / z, 60.0 - 80.0 * y / z, (z - 2.0) / 6.0]),
        _ => None,
    };
    studio.wireframe(Formula::Turn, numbers, place)
}

/// A triangle from each pixel to two fixed points, as light as its winding says.
fn windings(studio: &mut Studio<'_>) -> RgbImage {
    let corners = |[x, y]: [f64; 2]| Some(vec![x, y, 20.0, 10.0, 60.0, 45.0]);
    studio.shaded(Formula::Winding, corners, |sign| DVec3::splat(0.5 + 0.4 * sign))
}

/// A ball that is lit by [`Formula::Light`] at each pixel.
fn ball(studio: &mut Studio<'_>) -> RgbImage {
    fn numbers([x, y]: [f64; 2]) -> Option<Vec<f64>> {
        let [x, y] = [(x - 40.0) / 25.0, (30.0 - y) / 25.0];
        // The square of z on a ball of radius 1; outside of it there is none.
        let square = 1.0 - x * x - y * y;
        let z = -square.max(0.0).sqrt();
        (square > 0.0).then(|| vec![x, y, z, 0.48, 0.6, -0.64, 0.2, 0.8])
    }
    studio.shaded(Formula::Light, numbers, DVec3::splat)
}

/// What the nearest look-up reads along the window.
fn texels(studio: &mut Studio<'_>) -> RgbImage {
    let numbers = |[x, _]: [f64; 2]| Some(vec![(x - 8.5) / 64.0, 10.0, 30.0, 20.0, 40.0]);
    studio.shaded(Formula::Texel, numbers, |value| DVec3::splat(value / 50.0))
}

/// The level of a floor's texture at each pixel.
fn levels_of_floor(studio: &mut Studio<'_>) -> RgbImage {
    fn numbers([x, y]: [f64; 2]) -> Option<Vec<f64>> {
        // The farther down in the window, the nearer: w is 100 over the row.
        let mut numbers = vec![64.0, 64.0];
        for (x, row) in [(-40.0, 6.0), (40.0, 6.0), (0.0, 60.0)] {
            numbers.extend([40.0 + x, row, 100.0 / row, x / row, 16.0 / row]);
        }
        numbers.extend([x, y]);
        // Above its upper edge there is no floor.
        (y > 6.0).then_some(numbers)
    }
    studio.shaded(Formula::Level, numbers, |level| DVec3::splat(1.0 - level / 8.0))
}

/// Triangles whose edges are as bright as the share of their samples.
fn spokes(studio: &mut Studio<'_>) -> RgbImage {
    let (width, height) = (WIDTH / 4, HEIGHT / 4);
    let middle = [20.0, 15.0];
    let mut asked = Vec::new();
    for i in 0..6 {
        let [a, b] = [0.0, 0.35].map(|part| turned(f64::from(i) / 6.0 + part / 6.0, middle, 14.0));
        asked.push(Asked::Samples([middle, a, b].map(point)));
    }
    let mut image = picture::plain(width, height, BACKGROUND);
    for answer in studio.ask(width, height, asked) {
        let Some(Answer::Samples(runs)) = answer else { continue };
        for (run, mask) in &runs {
            let share = f64::from(mask.count_ones()) / 4.0;
            let (row, columns) = pixels(run, width, height);
            for x in columns {
                brighten(image.get_pixel_mut(x, row), share);
            }
        }
    }
    image
}

/// Adds a share of what the first ink is brighter than the background.
fn brighten(pixel: &mut Rgb<u8>, share: f64) {
    for (i, channel) in pixel.0.iter_mut().enumerate() {
        let whole = f64::from(INK[0].0[i]) - f64::from(BACKGROUND.0[i]);
        let mixed = f64::from(*channel) + share * whole;
        *channel = mixed.round().clamp(0.0, 255.0) as u8;
    }
}

/// A scene through the pipeline, rasterized by the program and by this project's engine.
///
/// # Errors
/// The scene has a vertex that the pipeline refuses.
pub fn scene(
    program: &mut dyn Subject,
    title: &'static str,
    scene: &Scene,
    size: (u32, u32),
) -> Result<ProgramPicture, BadScene> {
    let whole = Whole::new(scene, PixelRect::window(size.0, size.1))?;
    let [r, g, b, _] = scene.background;
    Ok(both(program, title, &mut |studio| studio.scene(&whole, Rgb([r, g, b]))))
}

/// Draws a picture twice, by the program and by this project's engines, and counts where they differ.
fn both(
    program: &mut dyn Subject,
    title: &'static str,
    draw: &mut dyn FnMut(&mut Studio<'_>) -> RgbImage,
) -> ProgramPicture {
    let mut studio = Studio { asked: program, unanswered: 0 };
    let yours = draw(&mut studio);
    let unanswered = studio.unanswered;
    let right = draw(&mut Studio { asked: &mut Right::new(), unanswered: 0 });
    let mut differing = 0;
    for (a, b) in yours.pixels().zip(right.pixels()) {
        differing += u64::from(differs(*a, *b));
    }
    ProgramPicture { title, yours, right, differing, unanswered }
}

/// Whether the colours of a pixel differ by more than rounding.
fn differs(a: Rgb<u8>, b: Rgb<u8>) -> bool {
    a.0.iter().zip(b.0).any(|(a, b)| a.abs_diff(b) > VISIBLE)
}

/// The colours of a picture of differences, and what each means to the student.
const DIFFERENCES: [(Rgb<u8>, &str); 3] = [
    (Rgb([214, 60, 60]), "your program drew nothing here"),
    (Rgb([240, 160, 40]), "only your program drew here"),
    (Rgb([170, 90, 210]), "the colours differ"),
];

impl ProgramPicture {
    /// Dark where both agree; else one of the colours of the differences.
    pub fn difference(&self) -> RgbImage {
        picture::painted(self.right.width(), self.right.height(), |x, y| {
            let (yours, right) = (*self.yours.get_pixel(x, y), *self.right.get_pixel(x, y));
            match (yours == BACKGROUND, right == BACKGROUND) {
                _ if !differs(yours, right) => Rgb(right.0.map(|channel| 20 + channel / 5)),
                (true, _) => DIFFERENCES[0].0,
                (_, true) => DIFFERENCES[1].0,
                _ => DIFFERENCES[2].0,
            }
        })
    }

    /// The three pictures side by side with their names, enlarged.
    pub fn sheet(&self) -> RgbImage {
        let zoom = (320 / self.right.width()).max(1);
        let (width, height) = (self.right.width() * zoom, self.right.height() * zoom);
        let difference = self.difference();
        let mut pictures = Vec::new();
        for (name, image) in
            [("yours", &self.yours), ("right", &self.right), ("difference", &difference)]
        {
            let large = imageops::resize(image, width, height, imageops::FilterType::Nearest);
            pictures.push((name, large));
        }
        panels::beside(self.title, &pictures)
    }
}

/// Whether no pixel of these pictures differs, and no request is without an answer.
pub fn agree(pictures: &[(String, ProgramPicture)]) -> bool {
    pictures.iter().all(|(_, picture)| picture.differing + picture.unanswered == 0)
}

/// Pictures, each with what it is of: how many pixels differ, and all three of each to look into.
pub fn report(title: String, pictures: &[(String, ProgramPicture)]) -> Report {
    let mut report = Report { about: title.clone(), title, ..Report::default() };
    let agree = agree(pictures);
    // On the page, the pictures that differ most come first.
    let mut on_page = Vec::new();
    for (label, picture) in pictures {
        // What a terminal prints of a picture is also its caption on the page.
        let of = picture.right.width() * picture.right.height();
        let refused = match picture.unanswered {
            0 => String::new(),
            n => format!("; {n} requests refused or not answered"),
        };
        let about = format!("{} of {of} pixels differ{refused}", picture.differing);
        let name = format!("{label}: {}", picture.title);
        report.notes.push(format!("{name}: {about}"));
        let layers = vec![
            PictureLayer::new("yours", &picture.yours),
            PictureLayer::new("right", &picture.right),
            PictureLayer::map("difference", &picture.difference(), &DIFFERENCES),
        ];
        let view = PictureView { name, about, layers, ..PictureView::default() };
        on_page.push((picture.differing, view));
    }
    // The sort keeps the order of the pictures that differ equally.
    on_page.sort_by_key(|(differing, _)| std::cmp::Reverse(*differing));
    report.frames = on_page.into_iter().map(|(_, view)| view).collect();
    let sentence = "what your program draws, beside what this project's engines draw";
    // Of a model that is not seen, two backgrounds would be compared.
    let is_blank = pictures.iter().all(|(_, picture)| picture::is_plain(picture.right.pixels()));
    report.outcome = Some(match is_blank && agree {
        true => Outcome::nothing_drawn(),
        false => Outcome {
            answer: match pictures.iter().map(|(_, picture)| picture.differing).sum() {
                0 if agree => "no pixel differs".to_owned(),
                0 => "requests are refused or not answered".to_owned(),
                pixels => words::count(pixels, "pixel differs", "pixels differ"),
            },
            ..Outcome::of(agree, sentence)
        },
    });
    report
}

/// Points along the edges of a cube of side 2, about 4 before the eye.
fn cube_edges() -> Vec<[f64; 3]> {
    let mut points = Vec::new();
    for axis in 0..3 {
        for corner in 0..4 {
            for along in -20..=20 {
                let mut point = [0.0; 3];
                point[axis] = f64::from(along) / 20.0;
                point[(axis + 1) % 3] = f64::from(corner % 2 * 2 - 1);
                point[(axis + 2) % 3] = f64::from(corner / 2 * 2 - 1);
                // No corner lies on the border of two pixels.
                points.push([point[0] + 0.013, point[1] + 0.007, point[2] + 4.0]);
            }
        }
    }
    points
}

/// Sets a pixel where it lies in the picture: a program may answer with any pixel.
fn put(image: &mut RgbImage, x: i32, y: i32, colour: Rgb<u8>) {
    if let (Ok(x), Ok(y)) = (u32::try_from(x), u32::try_from(y))
        && x < image.width()
        && y < image.height()
    {
        image.put_pixel(x, y, colour);
    }
}

/// The row of a run, and its columns in the window; none where the row is not in it.
fn pixels(run: &Span, width: u32, height: u32) -> (u32, Range<u32>) {
    match u32::try_from(run.y_px) {
        Ok(row) if row < height => {
            (row, run.x0_px.max(0) as u32..run.x1_px.clamp(0, width as i32) as u32)
        }
        _ => (0, 0..0),
    }
}

/// A colour from 0 to 1 as bytes, without its opacity.
fn rgb(colour: DVec3) -> Rgb<u8> {
    let [r, g, b, _] = to_colour(colour);
    Rgb([r, g, b])
}

/// A point of the grid; the pictures have none that does not fit.
fn point([x, y]: [f64; 2]) -> SubpixelPoint {
    SubpixelPoint::from_px(x, y).unwrap_or(SubpixelPoint::new(0, 0))
}

/// A vertex of the window, as a request names it.
fn vertex(place: [f64; 2], depth: f64, w: f64, varying: DVec2) -> ScreenVertex<DVec2> {
    ScreenVertex { position: point(place), depth, inv_w: 1.0 / w, varying }
}

/// A point of a circle, at a share of a full turn.
fn turned(share: f64, [x, y]: [f64; 2], radius: f64) -> [f64; 2] {
    let angle = share * std::f64::consts::TAU;
    [x + radius * cos(angle), y + radius * sin(angle)]
}

/// Sixteen lines from a middle; `across` is how far the flatter ones rise.
fn star([x, y]: [i32; 2], along: i32, across: i32) -> Vec<[[i32; 2]; 2]> {
    let steep = 2 * across - 1;
    let mut lines = Vec::new();
    for [dx, dy] in [[along, 0], [along, across], [along, along], [steep.min(along), along]] {
        // Each arm, and the same turned by one, two and three quarters.
        for [dx, dy] in [[dx, dy], [-dy, dx], [-dx, -dy], [dy, -dx]] {
            lines.push([[x, y], [x + dx, y + dy]]);
        }
    }
    lines
}

/// A point of the floor in clip space: the eye is one unit above it and looks along z.
fn on_floor(x: f64, z: f64) -> [f64; 4] {
    // The usual projection: z runs from -w at the near plane to w at the far one.
    let (near, far) = (1.0, 20.0);
    let depth = ((far + near) * z - 2.0 * far * near) / (far - near);
    [1.5 * x, -2.0, depth, z]
}

/// A point of clip space in the window; texture coordinates as those of the floor that is there.
fn in_window([x, y, z, w]: [f64; 4]) -> ScreenVertex<DVec2> {
    // The window has y down, clip space has y up.
    let place = [(x / w + 1.0) / 2.0 * f64::from(WIDTH), (1.0 - y / w) / 2.0 * f64::from(HEIGHT)];
    vertex(place, z / w, w, DVec2::new(x / 9.0 + 0.5, w / 12.0))
}

/// The floor before the eye, as two triangles of the window; with w = 1 everywhere, nothing is divided by it.
fn floor(divides: bool) -> Vec<Triangle> {
    let places = [[-3.0, 2.5], [3.0, 2.5], [3.0, 12.0], [-3.0, 12.0]];
    let [a, b, c, d] = places.map(|[x, z]| {
        let corner = in_window(on_floor(x, z));
        ScreenVertex { inv_w: if divides { corner.inv_w } else { 1.0 }, ..corner }
    });
    vec![Triangle { vertices: [a, b, c] }, Triangle { vertices: [a, c, d] }]
}

/// Light and dark squares, eight along each texture coordinate.
fn checkered(f: &Fragment<DVec2>) -> DVec3 {
    // No border lies at a simple fraction, where the last bit of a value would choose the colour.
    let cell = |v: f64| (8.0 * v + 0.0137).floor();
    let is_light = (cell(f.varying.x) + cell(f.varying.y)).rem_euclid(2.0) == 0.0;
    if is_light { DVec3::new(0.9, 0.85, 0.7) } else { DVec3::new(0.25, 0.3, 0.45) }
}
