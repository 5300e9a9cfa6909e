//! A device that answers the judge: questions become draws of a few submissions, pixels answers.
//!
//! A corner p px from the window's corner has clip coordinate p / (side / 2), where side is that of a
//! viewport, a power of two, in whose middle the window's corner lies. Both are exact in f32 for
//! multiples of 1/256 px below 2^15 px, and so is what the viewport transform makes of them: the
//! device is asked about the corners that the oracle is asked about, wherever the cell lies.

use std::sync::Arc;

use glam::DVec2;

use super::cells::{draw_of, floats, plain, twice_area_px2, valued};
use super::plant::Plant;
use crate::device::Error;
use crate::device::draw::{Draw, Painter, Pictures, Vertex};
use crate::device::find::{self, About, Listed};
use crate::device::kind::{CELL_PX, Kind, PAGE_PX};
use crate::device::open::Opened;
use rasterproof_core::geometry::centre_of;
use rasterproof_core::triangle::{Fragment, Span};
use rasterproof_judge::ask::runs_of;
use rasterproof_judge::ask::{Answer, Asked, Breach, Complaints, Question, Subject};
use rasterproof_judge::declared::{Declared, MOST_IN_FLIGHT};
use rasterproof_verify::comparison::Convention;

/// The beginning of an engine's name that means a device.
pub const PREFIX: &str = "vulkan:";
/// Cases of a family that are asked at once: thousands of draws a submission.
const CASES_AT_ONCE: u64 = 512;

/// A device that is open, or is opened at the next question.
pub struct Gpu {
    listed: Listed,
    plant: Option<Plant>,
    /// None after a failure, since a lost device answers nothing more.
    painter: Option<Painter>,
    declared: Declared,
    /// What the device said where it failed.
    complaints: Vec<String>,
}

impl Gpu {
    /// The device that an engine's name means: `vulkan:0`, `vulkan:lavapipe`, with a planted fault
    /// `vulkan:0+shifted-samples`.
    ///
    /// # Errors
    /// There is no loader, driver or device of this name, or it cannot be made ready; nor a planted
    /// fault of this name.
    pub fn named(engine: &str) -> Result<Self, Error> {
        let mut word = engine.strip_prefix(PREFIX).unwrap_or(engine);
        let mut plant = None;
        if let Some((device, name)) = word.split_once('+') {
            word = device;
            plant = Plant::ALL.into_iter().find(|plant| plant.name() == name);
            if plant.is_none() {
                let names = Plant::ALL.map(Plant::name).join(", ");
                let why = format!("no planted fault is called '{name}'; see: {names}");
                return Err(Error::Unsupported(why));
            }
        }
        let listed = find::choose(word)?;
        let name = format!("{PREFIX}{}", listed.number);
        let declared = declared(&name, &listed.about);
        let mut gpu = Self { listed, plant, painter: None, declared, complaints: Vec::new() };
        gpu.ready()?;
        Ok(gpu)
    }

    pub fn about(&self) -> &About {
        &self.listed.about
    }

    pub fn plant_name(&self) -> Option<&'static str> {
        self.plant.map(Plant::name)
    }

    /// Submissions since the device was opened last.
    pub fn submissions(&self) -> u64 {
        self.painter.as_ref().map_or(0, Painter::submissions)
    }

    /// The painter of the device, which is opened where it is not.
    pub(super) fn ready(&mut self) -> Result<&mut Painter, Error> {
        if self.painter.is_none() {
            // A planted failure happens once.
            let failing = if self.complaints.is_empty() { self.plant } else { None };
            let opened: Arc<Opened> = Opened::new(&self.listed)?;
            self.painter = Some(Painter::new(&opened, failing.and_then(Plant::failing))?);
        }
        self.painter.as_mut().ok_or(Error::Lost("opening the device"))
    }

    /// Draws a list; after a failure the device is opened anew at the next one.
    pub fn draw(
        &mut self,
        kind: Kind,
        cells: usize,
        mut draws: Vec<Draw>,
    ) -> Result<Pictures, Error> {
        let step_px = self.step_px();
        let before = self.submissions();
        if let Some(plant) = self.plant {
            plant.spoil(&mut draws, kind == Kind::Samples, step_px, before);
        }
        let drawn = self.ready().and_then(|painter| painter.draw(kind, cells, &draws));
        drawn.inspect_err(|error| {
            // What a device does not offer leaves it as it is.
            if !matches!(error, Error::Unsupported(_)) {
                self.painter = None;
                self.complaints.push(error.to_string());
            }
        })
    }

    /// Draws each triangle in the middle of the viewport, in a cell of its own.
    pub fn draw_each(
        &mut self,
        kind: Kind,
        triangles: impl ExactSizeIterator<Item = [Vertex; 3]>,
    ) -> Result<Pictures, Error> {
        let (side, cells) = (self.viewport_px(), triangles.len());
        let draws = (0..).zip(triangles).map(|(cell, vertices)| draw_of(cell, vertices, side));
        self.draw(kind, cells, draws.collect())
    }

    /// Closes the device; the next list opens it anew.
    pub fn close(&mut self) {
        self.painter = None;
    }

    /// A step of the lattice on which the device puts corners.
    pub fn step_px(&self) -> f32 {
        1.0 / self.declared.grid() as f32
    }

    /// The side of the viewport in whose middle a window's corner lies.
    pub fn viewport_px(&self) -> f32 {
        viewport_px(&self.listed.about)
    }

    /// What draws the answer; nothing for what is not declared.
    fn kind(&self, asked: &Asked) -> Option<Kind> {
        Some(match asked {
            Asked::Coverage(corners) => hits_kind(twice_area_px2(corners)),
            Asked::Samples(_) => Kind::Samples,
            Asked::Values(_) if self.plant == Some(Plant::NoPerspective) => Kind::Linear,
            Asked::Values(_) => Kind::Values,
            Asked::Line { .. } => Kind::Lines,
            Asked::Depth(_)
            | Asked::Near(_)
            | Asked::Carried(_)
            | Asked::Wide(_)
            | Asked::Area(_)
            | Asked::SampleValues(_)
            | Asked::Polygon(_)
            | Asked::Formula(..) => {
                return None;
            }
        })
    }

    /// The answers of some questions of one kind, or why there are none.
    fn group(&mut self, kind: Kind, questions: &[&Question]) -> Result<Vec<Answer>, Error> {
        let side = self.viewport_px();
        // A cell for each question, empty where it is not declared.
        let mut draws = Vec::new();
        for (cell, question) in questions.iter().enumerate() {
            if let Some(vertices) = vertices(&question.of, side / 2.0) {
                let window = [question.width, question.height];
                draws.push(Draw { window, ..draw_of(cell, vertices, side) });
            }
        }
        let pictures = self.draw(kind, questions.len(), draws)?;
        Ok((0..).zip(questions).map(|(cell, q)| answer(&pictures, kind, cell, q)).collect())
    }
}

/// Twice the area in square pixels from which a triangle is drawn on a page of its own. A picture no larger
/// than the window is where drivers take other ways with triangles that reach far beyond it.
const ALONE_FROM_PX2: f64 = 65536.0;

/// What draws the hits of a triangle with twice this area: decided by the triangle alone, so that one that
/// is asked again is drawn in the same way.
pub fn hits_kind(twice_area_px2: f64) -> Kind {
    if twice_area_px2 < ALONE_FROM_PX2 { Kind::Hits } else { Kind::Alone }
}

/// The largest power of two that the limits allow, cells anywhere on a page.
fn viewport_px(about: &About) -> f32 {
    let [low, high] = about.viewport_bounds;
    let [width, height] = about.largest_viewport;
    let most = width.min(height).min(1 << 14);
    for side in (10..15).rev().map(|bits| 1 << bits) {
        let half = side as f32 / 2.0;
        if side <= most && -half >= low && half + PAGE_PX as f32 <= high {
            return side as f32;
        }
    }
    PAGE_PX as f32
}

/// What a device promises: its lattice, the pixel centre, the top-left rule.
fn declared(name: &str, about: &About) -> Declared {
    Declared {
        name: name.to_owned(),
        version: 2,
        coverage: true,
        attributes: true,
        samples4: about.four_samples && about.standard_samples,
        convention: Convention::default().subpixel_bits(about.subpixel_bits),
        // Within the viewport nothing is clipped.
        range: Some(viewport_px(about) as i32 / 2),
        window: Some([CELL_PX; 2]),
        batch: MOST_IN_FLIGHT,
        ..Declared::default()
    }
}

/// The corners that are drawn; nothing for what is not declared.
fn vertices(asked: &Asked, half_px: f32) -> Option<[Vertex; 3]> {
    Some(match asked {
        Asked::Coverage(corners) | Asked::Samples(corners) => plain(corners, half_px),
        Asked::Values(triangle) => valued(triangle, half_px),
        Asked::Line { ends: [a, b], .. } => {
            let [a, b] = [a, b].map(|p| centre_of(p.x, p.y));
            plain(&[a, b, b], half_px)
        }
        Asked::Depth(_)
        | Asked::Near(_)
        | Asked::Carried(_)
        | Asked::Wide(_)
        | Asked::Area(_)
        | Asked::SampleValues(_)
        | Asked::Polygon(_)
        | Asked::Formula(..) => return None,
    })
}

/// What was drawn in a cell, in the form of the question.
fn answer(pictures: &Pictures, kind: Kind, cell: usize, question: &Question) -> Answer {
    let (mut runs, mut fragments): (Vec<(Span, u8)>, _) = (Vec::new(), Vec::new());
    for y in 0..question.height {
        let (y_px, row) = (y as i32, pictures.row(cell, y, question.width));
        if !matches!(kind, Kind::Values | Kind::Linear) {
            runs.extend(runs_of(y_px, row));
            continue;
        }
        // Four floats a pixel.
        for (pixel, x_px) in row.chunks_exact(16).zip(0..) {
            let [depth, a, b, drawn] = floats(pixel);
            if drawn != 0.0 {
                fragments.push(Fragment { x_px, y_px, depth, varying: DVec2::new(a, b) });
            }
        }
    }
    match kind {
        Kind::Samples => Answer::Samples(runs),
        Kind::Values | Kind::Linear => Answer::Values(fragments),
        _ => {
            // A pixel that was hit n times is in n runs.
            let times = |(run, n): (Span, u8)| std::iter::repeat_n(run, usize::from(n));
            Answer::Coverage(runs.into_iter().flat_map(times).collect())
        }
    }
}

impl Subject for Gpu {
    fn declared(&self) -> &Declared {
        &self.declared
    }

    fn cases_at_once(&self) -> u64 {
        CASES_AT_ONCE
    }

    fn ask(&mut self, questions: &[Question], most_deaths: u64) -> Vec<Answer> {
        // Questions of one kind are one list of draws; their answers return to the places of the questions.
        let mut answers: Vec<Option<Answer>> = Vec::new();
        for question in questions {
            let refused = Answer::Refused("a device is not asked this".to_owned());
            answers.push(self.kind(&question.of).is_none().then_some(refused));
        }
        let mut deaths = 0;
        let kinds =
            [Kind::Hits, Kind::Alone, Kind::Samples, Kind::Values, Kind::Linear, Kind::Lines];
        for kind in kinds {
            let (mut places, mut list) = (Vec::new(), Vec::new());
            for (place, question) in questions.iter().enumerate() {
                if self.kind(&question.of) == Some(kind) {
                    places.push(place);
                    list.push(question);
                }
            }
            let mut first = 0;
            while first < list.len() && deaths < most_deaths {
                match self.group(kind, &list[first..]) {
                    Ok(drawn) => {
                        for (place, answer) in places[first..].iter().zip(drawn) {
                            answers[*place] = Some(answer);
                        }
                        first = list.len();
                    }
                    // Which draw it was is not known: the first one is given up, the others are asked
                    // of the device opened anew.
                    Err(error) => {
                        deaths += 1;
                        let what = Breach::Crashes.by(error.to_string());
                        answers[places[first]] = Some(Answer::Died(what));
                        first += 1;
                    }
                }
            }
        }
        // What follows the last death was not asked any more.
        answers.into_iter().map_while(|answer| answer).collect()
    }

    fn complaints(&self) -> Complaints {
        Complaints { lines: self.complaints.len() as u64, shown: self.complaints.clone() }
    }
}
