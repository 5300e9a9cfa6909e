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

pub struct Gpu {
    listed: Listed,
    plant: Option<Plant>,
    painter: Option<Painter>,
    declared: Declared,
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
        let word = engine.strip_prefix(PREFIX).unwrap_or(engine);
        let (word, plant) = match word.split_once('+') {
            Some((word, name)) => (word, Some(name)),
            None => (word, None),
        };
        let known = |name: &str| Plant::ALL.into_iter().find(|plant| plant.name() == name);
        let plant = match plant {
            Some(name) => Some(known(name).ok_or_else(|| {
                let names = Plant::ALL.map(Plant::name).join(", ");
                Error::Unsupported(format!("no planted fault is called '{name}'; see: {names}"))
            })?),
            None => None,
        };
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
        let draw = |(cell, question): (usize, &&Question)| {
            let window = [question.width, question.height];
            Some(Draw { window, ..draw_of(cell, vertices(&question.of, side / 2.0)?, side) })
        };
        let draws = (0..).zip(questions).filter_map(draw).collect();
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
    let most = about.largest_viewport.into_iter().min().unwrap_or(0).min(1 << 14);
    let fits = |side: &u32| {
        let half = *side as f32 / 2.0;
        *side <= most && -half >= low && half + PAGE_PX as f32 <= high
    };
    (10..15).rev().map(|bits| 1 << bits).find(fits).unwrap_or(PAGE_PX) as f32
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

fn answer(pictures: &Pictures, kind: Kind, cell: usize, question: &Question) -> Answer {
    let rows = (0..question.height).map(|y| (y as i32, pictures.row(cell, y, question.width)));
    match kind {
        Kind::Samples => Answer::Samples(rows.flat_map(|(y, row)| runs_of(y, row)).collect()),
        Kind::Values | Kind::Linear => {
            let pixels =
                rows.flat_map(|(y, row)| (0..).zip(row.chunks_exact(16)).map(move |p| (y, p)));
            let fragment = |(y_px, (x_px, pixel)): (i32, (i32, &[u8]))| {
                let [depth, a, b, drawn] = floats(pixel);
                let varying = DVec2::new(a, b);
                (drawn != 0.0).then_some(Fragment { x_px, y_px, depth, varying })
            };
            Answer::Values(pixels.filter_map(fragment).collect())
        }
        _ => {
            // A pixel that was hit n times is in n runs.
            let runs = rows.flat_map(|(y, row)| runs_of(y, row));
            let times = |(run, n): (Span, u8)| std::iter::repeat_n(run, usize::from(n));
            Answer::Coverage(runs.flat_map(times).collect())
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
        let refused = |q: &Question| {
            let word = "a device is not asked this".to_owned();
            self.kind(&q.of).is_none().then_some(Answer::Refused(word))
        };
        let mut answers: Vec<Option<Answer>> = questions.iter().map(refused).collect();
        let mut deaths = 0;
        let kinds =
            [Kind::Hits, Kind::Alone, Kind::Samples, Kind::Values, Kind::Linear, Kind::Lines];
        for kind in kinds {
            let is_of = |(_, q): &(usize, &Question)| self.kind(&q.of) == Some(kind);
            let mine: Vec<(usize, &Question)> =
                questions.iter().enumerate().filter(is_of).collect();
            let mut rest = &mine[..];
            while !rest.is_empty() && deaths < most_deaths {
                let list: Vec<&Question> = rest.iter().map(|(_, q)| *q).collect();
                match self.group(kind, &list) {
                    Ok(drawn) => {
                        rest.iter().zip(drawn).for_each(|((at, _), a)| answers[*at] = Some(a));
                        rest = &[];
                    }
                    // Which draw it was is not known: the first one is given up, the others are asked
                    // of the device opened anew.
                    Err(error) => {
                        deaths += 1;
                        let what = Breach::Crashes.by(error.to_string());
                        answers[rest[0].0] = Some(Answer::Died(what));
                        rest = &rest[1..];
                    }
                }
            }
        }
        answers.into_iter().map_while(|answer| answer).collect()
    }

    fn complaints(&self) -> Complaints {
        Complaints { lines: self.complaints.len() as u64, shown: self.complaints.clone() }
    }
}
