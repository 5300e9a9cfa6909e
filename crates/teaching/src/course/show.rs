//! What a program draws at a step, as pictures: the same requests go to the program and to this project's engines, and
//! one function turns either's answers into pixels.
//!
//! Scenes go through the project's pipeline: transform, clip, cull, viewport. The program gets the triangles of the window
//! with two attributes that are 1 at one corner and 0 at the others. These are the weights of the corners, so that any
//! number of attributes follows from what it answers; depths are compared and colours computed here.

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
const TWICE: Rgb<u8> = Rgb([255; 3]);
const INK: [Rgb<u8>; 4] =
    [Rgb([240, 200, 60]), Rgb([120, 200, 255]), Rgb([240, 130, 110]), Rgb([150, 220, 140])];
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
        let inside = |name: &str| {
            let entry = ENTRIES.iter().find(|entry| entry.name == name);
            Inside::new(entry.expect("the engine has an entry"))
        };
        let [lines, triangles, formulas] = ["bresenham", "edge-function", "oracle"].map(inside);
        Self { lines, triangles, formulas }
    }
}

impl Subject for Right {
    fn declared(&self) -> &Declared {
        self.triangles.declared()
    }

    fn ask(&mut self, questions: &[Question], most_deaths: u64) -> Vec<Answer> {
        let one = |question: &Question| match question.of {
            Asked::Line { .. } => self.lines.ask(std::slice::from_ref(question), most_deaths),
            Asked::Formula(..) => self.formulas.ask(std::slice::from_ref(question), most_deaths),
            _ => self.triangles.ask(std::slice::from_ref(question), most_deaths),
        };
        questions.iter().flat_map(one).collect()
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
            let mut here: Vec<_> = if self.unanswered < MOST_DEATHS {
                self.asked.ask(batch, MOST_DEATHS).into_iter().map(Some).collect()
            } else {
                Vec::new()
            };
            here.resize(batch.len(), None);
            answers.extend(here);
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
        let asked = lines.iter().map(|ends| Asked::Line {
            ends: ends.map(|[x, y]| PixelPoint::new(x, y)),
            whole: false,
        });
        let answers = self.ask(width, height, asked.collect());
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
            for (x, y) in runs.iter().flat_map(|run| pixels(run, width, height)) {
                let is_first = *image.get_pixel(x, y) == BACKGROUND;
                image.put_pixel(x, y, if is_first { INK[number % INK.len()] } else { TWICE });
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
        numbers: impl Fn([f64; 3]) -> Vec<f64>,
        place: impl Fn(&[f64]) -> Option<[f64; 3]>,
    ) -> RgbImage {
        let asked = cube_edges().into_iter().map(|point| Asked::Formula(formula, numbers(point)));
        let answers = self.ask(WIDTH, HEIGHT, asked.collect());
        let mut image = picture::plain(WIDTH, HEIGHT, BACKGROUND);
        for answer in answers {
            let Some(Answer::Numbers(numbers)) = answer else { continue };
            let Some([x, y, depth]) = place(&numbers) else { continue };
            let colour = DVec3::new(1.0, 0.85, 0.4) * (1.0 - depth.clamp(0.0, 1.0));
            put(&mut image, x.floor() as i32, y.floor() as i32, rgb(colour));
        }
        image
    }

    /// A window in which each pixel asks a formula, and shows the first number as a colour.
    fn shaded(
        &mut self,
        formula: Formula,
        numbers: impl Fn([f64; 2]) -> Option<Vec<f64>>,
        shade: impl Fn(f64) -> DVec3,
    ) -> RgbImage {
        let (width, height) = (WIDTH / 2, HEIGHT / 2);
        let (mut places, mut asked) = (Vec::new(), Vec::new());
        for (x, y) in (0..height as i32).flat_map(|y| (0..width as i32).map(move |x| (x, y))) {
            let Some(numbers) = numbers([f64::from(x) + 0.5, f64::from(y) + 0.5]) else { continue };
            places.push((x, y));
            asked.push(Asked::Formula(formula, numbers));
        }
        let answers = self.ask(width, height, asked);
        let mut image = picture::plain(width, height, BACKGROUND);
        for ((x, y), answer) in places.into_iter().zip(answers) {
            let Some(Answer::Numbers(numbers)) = answer else { continue };
            let Some(number) = numbers.first() else { continue };
            put(&mut image, x, y, rgb(shade(*number)));
        }
        image
    }

    /// A floor that begins behind the eye: cut by the program at the near plane, then drawn by it.
    fn cut_floor(&mut self) -> RgbImage {
        let corners =
            [[-3.0, -4.0], [-3.0, 12.0], [3.0, 12.0], [3.0, -4.0]].map(|[x, z]| on_floor(x, z));
        let halves = [[0, 1, 2], [0, 2, 3]].map(|half| half.map(|i: usize| corners[i]));
        let asked = halves.map(|half| {
            // As `clip_corners` reads them.
            let vertex = |[x, y, z, w]: [f64; 4]| vertex([x, y], z, 1.0, DVec2::new(w, 0.0));
            Asked::Near(Triangle { vertices: half.map(vertex) })
        });
        let answers = self.ask(WIDTH, HEIGHT, asked.into());
        let mut pieces = Vec::new();
        for answer in answers {
            let Some(Answer::Polygon(polygon)) = answer else { continue };
            for pair in polygon.get(1..).unwrap_or_default().windows(2) {
                let piece = [polygon[0], pair[0], pair[1]];
                // What was not cut has no place in the window.
                if piece.iter().all(|[_, _, _, w, _]| *w > 0.0) {
                    pieces.push(Triangle {
                        vertices: piece.map(|[x, y, z, w, _]| in_window([x, y, z, w])),
                    });
                }
            }
        }
        self.values(WIDTH, HEIGHT, pieces, checkered)
    }

    /// Two triangles that go through one another.
    fn pair(&mut self) -> RgbImage {
        let triangle = |corners: [[f64; 3]; 3]| Triangle {
            vertices: corners.map(|[x, y, z]| vertex([x, y], z, 1.0, DVec2::ZERO)),
        };
        let pile = vec![
            triangle([[10.0, 20.0, 0.1], [150.0, 30.0, 0.9], [20.0, 110.0, 0.3]]),
            triangle([[150.0, 10.0, 0.1], [140.0, 105.0, 0.4], [8.0, 70.0, 0.9]]),
            triangle([[70.0, 5.0, 0.5], [110.0, 115.0, 0.5], [50.0, 115.0, 0.5]]),
        ];
        let answers = self.ask(WIDTH, HEIGHT, vec![Asked::Depth(pile)]);
        let mut image = picture::plain(WIDTH, HEIGHT, BACKGROUND);
        if let [Some(Answer::Seen(runs))] = &answers[..] {
            for (run, number) in runs {
                for (x, y) in pixels(run, WIDTH, HEIGHT) {
                    image.put_pixel(x, y, INK[usize::from(*number) % INK.len()]);
                }
            }
        }
        image
    }

    /// Triangles whose edges are as bright as the share of their samples.
    fn smooth(&mut self) -> RgbImage {
        let (width, height) = (WIDTH / 4, HEIGHT / 4);
        let spokes = (0..6).map(|i| {
            let [a, b] =
                [0.0, 0.35].map(|part| turned(f64::from(i) / 6.0 + part / 6.0, [20.0, 15.0], 14.0));
            [[20.0, 15.0], a, b]
        });
        let asked = spokes.map(|t| Asked::Samples(t.map(point))).collect();
        let answers = self.ask(width, height, asked);
        let mut image = picture::plain(width, height, BACKGROUND);
        for answer in &answers {
            let Some(Answer::Samples(runs)) = answer else { continue };
            for (run, mask) in runs {
                let share = f64::from(mask.count_ones()) / 4.0;
                for (x, y) in pixels(run, width, height) {
                    let old = image.get_pixel(x, y).0;
                    let mixed = [0, 1, 2].map(|i| {
                        f64::from(old[i])
                            + share * (f64::from(INK[0].0[i]) - f64::from(BACKGROUND.0[i]))
                    });
                    image.put_pixel(x, y, Rgb(mixed.map(|v| v.round().clamp(0.0, 255.0) as u8)));
                }
            }
        }
        image
    }

    /// A scene after assembly: the program rasterizes its pieces, depths are compared and colours computed here.
    fn scene(&mut self, whole: &Whole<'_>, background: Rgb<u8>) -> RgbImage {
        let (width, height) = (whole.window.width(), whole.window.height());
        let mut image = picture::plain(width, height, background);
        let mut nearest = vec![f64::INFINITY; width as usize * height as usize];
        for run in whole.runs(256) {
            let mut surfaces = Vec::new();
            whole.outlines(&run, &mut |outline| surfaces.push(whole.surface(&outline)));
            let weights = [DVec2::X, DVec2::Y, DVec2::ZERO];
            let asked = surfaces.iter().map(|surface| {
                let vertices = [0, 1, 2].map(|i| surface.corners[i].with_varying(weights[i]));
                Asked::Values(Triangle { vertices })
            });
            let answers = self.ask(width, height, asked.collect());
            for (surface, answer) in surfaces.iter().zip(answers) {
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
    let value = |i: usize| (0..3).map(|corner| l[corner] * surface.values[corner][i]).sum::<f64>();
    let mut colour = base.as_dvec3() / 255.0;
    if *colours {
        colour *= DVec3::new(value(0), value(1), value(2));
    }
    if let Some(texture) = texture {
        colour *= texture.at(DVec2::new(value(6), value(7)));
    }
    if let Some(light) = light {
        let normal = DVec3::new(value(3), value(4), value(5)).normalize_or_zero();
        let cosine = normal.dot(light.towards.as_dvec3()).max(0.0);
        colour *= f64::from(light.ambient) + f64::from(light.diffuse) * cosine;
    }
    colour
}

/// The pictures of a step, by the program and by this project's engines.
pub fn step(program: &mut dyn Subject, step: &Step) -> Vec<ProgramPicture> {
    type Draw = fn(&mut Studio<'_>) -> RgbImage;
    let pictures: &[(&'static str, Draw)] = match step.name.as_str() {
        "pixel" => &[("pixels of a circle; some lie outside", |s| s.lines(16, 12, &circle()))],
        "dda" => &[("lines in all octants", |s| s.lines(48, 36, &star([23, 17], 15, 6)))],
        "bresenham" => &[("lines with ties, and lines that leave the window", |s| {
            let mut lines = star([24, 18], 16, 8);
            lines.extend([[[-100, 0], [100, 2]], [[100, 35], [-100, 33]], [[0, 200], [2, -200]]]);
            s.lines(48, 36, &lines)
        })],
        "scanline" => {
            &[("a triangle", |s| s.mosaic(32, 24, &[[[3.3, 2.2], [28.7, 8.4], [9.6, 21.8]]]))]
        }
        "edge-function" => &[("slivers of both windings", |s| {
            let sliver = |i: usize| {
                let [a, b] =
                    [0.0, 0.16].map(|part| turned((i as f64 + part) / 9.0, [24.0, 18.0], 17.0));
                if i.is_multiple_of(2) { [[24.0, 18.0], a, b] } else { [[24.0, 18.0], b, a] }
            };
            s.mosaic(48, 36, &(0..9).map(sliver).collect::<Vec<_>>())
        })],
        "top-left" => &[("squares with corners at the centres of pixels", |s| {
            let square = |i: usize| {
                let (x, y) = (2.5 + 6.0 * (i % 4) as f64, 2.5 + 6.0 * (i / 4) as f64);
                let at = |dx: f64, dy: f64| [x + 6.0 * dx, y + 6.0 * dy];
                [
                    [at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0)],
                    [at(1.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)],
                ]
            };
            s.mosaic(32, 24, &(0..12).flat_map(square).collect::<Vec<_>>())
        })],
        "fans" => &[("a fan without cracks", |s| {
            let rim = |i: usize| turned(i as f64 / 12.0, [80.5, 60.5], 50.0);
            let fan = (0..12).map(|i| [[80.5, 60.5], rim(i), rim(i + 1)]);
            s.mosaic(WIDTH, HEIGHT, &fan.collect::<Vec<_>>())
        })],
        "values" => &[("z as red, a as green, b as blue", |s| {
            let corners = [
                vertex([80.0, 8.0], 1.0, 1.0, DVec2::ZERO),
                vertex([150.0, 110.0], 0.0, 1.0, DVec2::X),
                vertex([10.0, 110.0], 0.0, 1.0, DVec2::Y),
            ];
            let shade = |f: &Fragment<DVec2>| DVec3::new(f.depth, f.varying.x, f.varying.y);
            s.values(WIDTH, HEIGHT, vec![Triangle { vertices: corners }], shade)
        })],
        "perspective" => &[
            ("a textured floor", |s| s.values(WIDTH, HEIGHT, floor(true), checkered)),
            ("the same with every w set to 1: no division", |s| {
                s.values(WIDTH, HEIGHT, floor(false), checkered)
            }),
        ],
        "depth" => &[
            ("triangles that go through one another", |s| s.pair()),
            ("z as brightness, on the floor of step 5", |s| {
                s.values(WIDTH, HEIGHT, floor(true), |f| DVec3::splat(f.depth))
            }),
        ],
        "clipping" => &[("a floor that begins behind the eye", |s| s.cut_floor())],
        "projection" => &[("the edges of a cube on the film", |s| {
            let numbers = |[x, y, z]: [f64; 3]| vec![2.0, x, y, z];
            s.wireframe(Formula::Project, numbers, |film| match *film {
                [x, y, _] => Some([80.0 + 40.0 * x, 60.0 - 40.0 * y, 0.0]),
                _ => None,
            })
        })],
        "window" => &[("the same edges in the window, darker with the depth", |s| {
            let [width, height] = [WIDTH, HEIGHT].map(f64::from);
            let numbers = |[x, y, z]: [f64; 3]| vec![width, height, 1.5, 8.0, x, y, z];
            s.wireframe(Formula::Window, numbers, |place| <[f64; 3]>::try_from(place).ok())
        })],
        "culling" => &[("triangles to each pixel: clockwise ones are light", |s| {
            let corners = |[x, y]: [f64; 2]| Some(vec![x, y, 20.0, 10.0, 60.0, 45.0]);
            s.shaded(Formula::Winding, corners, |sign| DVec3::splat(0.5 + 0.4 * sign))
        })],
        "matrices" => &[("the edges of a cube, turned about its centre", |s| {
            let numbers = |[x, y, z]: [f64; 3]| vec![1.0, 0.8, 0.6, 0.0, 0.0, 4.0, x, y, z];
            s.wireframe(Formula::Turn, numbers, |point| match *point {
                [x, y, z] if z > 0.0 => {
                    Some([80.0 + 80.0 * x / z, 60.0 - 80.0 * y / z, (z - 2.0) / 6.0])
                }
                _ => None,
            })
        })],
        "light" => &[
            ("a ball in the light", |s| {
                let numbers = |[x, y]: [f64; 2]| {
                    let [x, y] = [(x - 40.0) / 25.0, (30.0 - y) / 25.0];
                    let square = 1.0 - x * x - y * y;
                    let normal = [x, y, -square.max(0.0).sqrt()];
                    let light = [0.48, 0.6, -0.64, 0.2, 0.8];
                    (square > 0.0).then(|| [&normal[..], &light].concat())
                };
                s.shaded(Formula::Light, numbers, DVec3::splat)
            }),
            ("a row of texels: nearest", |s| {
                let numbers =
                    |[x, _]: [f64; 2]| Some(vec![(x - 8.5) / 64.0, 10.0, 30.0, 20.0, 40.0]);
                s.shaded(Formula::Texel, numbers, |value| DVec3::splat(value / 50.0))
            }),
        ],
        "levels" => &[("levels of a floor, darker from level to level", |s| {
            let numbers = |[x, y]: [f64; 2]| {
                let corner = |x: f64, s: f64| [40.0 + x, s, 100.0 / s, x / s, 16.0 / s];
                let corners = [corner(-40.0, 6.0), corner(40.0, 6.0), corner(0.0, 60.0)];
                (y > 6.0).then(|| [&[64.0, 64.0][..], corners.as_flattened(), &[x, y]].concat())
            };
            s.shaded(Formula::Level, numbers, |level| DVec3::splat(1.0 - level / 8.0))
        })],
        _ => &[("edges as bright as the share of their samples", |s| s.smooth())],
    };
    pictures.iter().map(|(title, draw)| both(program, title, &mut |studio| draw(studio))).collect()
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

fn both(
    program: &mut dyn Subject,
    title: &'static str,
    draw: &mut dyn FnMut(&mut Studio<'_>) -> RgbImage,
) -> ProgramPicture {
    let mut studio = Studio { asked: program, unanswered: 0 };
    let yours = draw(&mut studio);
    let unanswered = studio.unanswered;
    let right = draw(&mut Studio { asked: &mut Right::new(), unanswered: 0 });
    let differing =
        yours.pixels().zip(right.pixels()).filter(|(a, b)| differs(**a, **b)).count() as u64;
    ProgramPicture { title, yours, right, differing, unanswered }
}

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
        let ground = |image: &RgbImage, x, y| *image.get_pixel(x, y) == BACKGROUND;
        picture::painted(self.right.width(), self.right.height(), |x, y| {
            let (yours, right) = (*self.yours.get_pixel(x, y), *self.right.get_pixel(x, y));
            match (ground(&self.yours, x, y), ground(&self.right, x, y)) {
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
        let (wide, high) = (self.right.width() * zoom, self.right.height() * zoom);
        let large =
            |image: &RgbImage| imageops::resize(image, wide, high, imageops::FilterType::Nearest);
        let [yours, right, difference] = [&self.yours, &self.right, &self.difference()].map(large);
        let pictures = [("yours", yours), ("right", right), ("difference", difference)];
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

fn put(image: &mut RgbImage, x: i32, y: i32, colour: Rgb<u8>) {
    if let (Ok(x), Ok(y)) = (u32::try_from(x), u32::try_from(y))
        && x < image.width()
        && y < image.height()
    {
        image.put_pixel(x, y, colour);
    }
}

fn pixels(run: &Span, width: u32, height: u32) -> impl Iterator<Item = (u32, u32)> {
    let y = u32::try_from(run.y_px).ok().filter(|y| *y < height);
    let (x0, x1) = (run.x0_px.max(0) as u32, run.x1_px.clamp(0, width as i32) as u32);
    y.into_iter().flat_map(move |y| (x0..x1).map(move |x| (x, y)))
}

fn rgb(colour: DVec3) -> Rgb<u8> {
    let [r, g, b, _] = to_colour(colour);
    Rgb([r, g, b])
}

fn point([x, y]: [f64; 2]) -> SubpixelPoint {
    SubpixelPoint::from_px(x, y).unwrap_or(SubpixelPoint::new(0, 0))
}

fn vertex(place: [f64; 2], depth: f64, w: f64, varying: DVec2) -> ScreenVertex<DVec2> {
    ScreenVertex { position: point(place), depth, inv_w: 1.0 / w, varying }
}

/// A point of a circle, at a share of a full turn.
fn turned(share: f64, [x, y]: [f64; 2], radius: f64) -> [f64; 2] {
    let angle = share * std::f64::consts::TAU;
    [x + radius * cos(angle), y + radius * sin(angle)]
}

/// Each a line from a pixel to itself.
fn circle() -> Vec<[[i32; 2]; 2]> {
    let at = |i: u32| turned(f64::from(i) / 24.0, [8.0, 6.0], 6.8).map(|v| v.floor() as i32);
    (0..24).map(at).map(|end| [end, end]).collect()
}

/// Sixteen lines from a middle; `across` is how far the flatter ones rise.
fn star([x, y]: [i32; 2], along: i32, across: i32) -> Vec<[[i32; 2]; 2]> {
    let steep = 2 * across - 1;
    let arms = [[along, 0], [along, across], [along, along], [steep.min(along), along]];
    let all = arms.into_iter().flat_map(|[dx, dy]| [[dx, dy], [-dy, dx], [-dx, -dy], [dy, -dx]]);
    all.map(|[dx, dy]| [[x, y], [x + dx, y + dy]]).collect()
}

/// A point of the floor in clip space: the eye is one unit above it and looks along z.
fn on_floor(x: f64, z: f64) -> [f64; 4] {
    let (near, far) = (1.0, 20.0);
    let depth = ((far + near) * z - 2.0 * far * near) / (far - near);
    [1.5 * x, -2.0, depth, z]
}

/// A point of clip space in the window; texture coordinates as those of the floor that is there.
fn in_window([x, y, z, w]: [f64; 4]) -> ScreenVertex<DVec2> {
    let place = [(x / w + 1.0) / 2.0 * f64::from(WIDTH), (1.0 - y / w) / 2.0 * f64::from(HEIGHT)];
    vertex(place, z / w, w, DVec2::new(x / 9.0 + 0.5, w / 12.0))
}

fn floor(divides: bool) -> Vec<Triangle> {
    let corners = [[-3.0, 2.5], [3.0, 2.5], [3.0, 12.0], [-3.0, 12.0]]
        .map(|[x, z]| in_window(on_floor(x, z)));
    let flat = |v: ScreenVertex<DVec2>| if divides { v } else { ScreenVertex { inv_w: 1.0, ..v } };
    let half = |half: [usize; 3]| Triangle { vertices: half.map(|i| flat(corners[i])) };
    vec![half([0, 1, 2]), half([0, 2, 3])]
}

/// Light and dark squares, eight along each texture coordinate.
fn checkered(f: &Fragment<DVec2>) -> DVec3 {
    // No border lies at a simple fraction, where the last bit of a value would choose the colour.
    let cell = |v: f64| (8.0 * v + 0.0137).floor();
    let is_light = (cell(f.varying.x) + cell(f.varying.y)).rem_euclid(2.0) == 0.0;
    if is_light { DVec3::new(0.9, 0.85, 0.7) } else { DVec3::new(0.25, 0.3, 0.45) }
}
