//! An engine of the registry that is asked without a process: what it would answer over the protocol.

use super::ask::{Answer, Ask, Asked, Misbehaviour, Question};
use super::declared::{Declared, MOST_IN_FLIGHT};
use super::server::pipeline;
use rasterproof_core::contract::{
    DrawLine as _, Interpolate as _, Rasterize as _, RasterizeExact as _,
};
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::{LineEnd, ScreenLine};
use rasterproof_faults::published::{PublishedLine, from_lattice, from_screen};
use rasterproof_registry::engines::{Entry, Specimen};
use rasterproof_render::pipeline::multisample;
use rasterproof_verify::cases::near_plane::clip_corners;
use rasterproof_verify::comparison::caught;

/// The values of both engines lie within u (15 D + 2 M) of the exact ones (`verify::tolerance`),
/// where D is at most 2 M: 32 u M.
const OWN_TOLERANCE: f64 = 32.0 * (f64::EPSILON / 2.0);

impl From<&Entry> for Declared {
    /// What an engine of the registry says of itself. A specimen promises nothing.
    fn from(entry: &Entry) -> Self {
        let triangle = match entry.specimen {
            Some(Specimen::Triangle(specimen)) => Some(specimen),
            _ => None,
        };
        let is_engine = entry.engine.is_some();
        Self {
            name: entry.name.to_owned(),
            version: 2,
            coverage: is_engine || entry.exact_engine.is_some() || triangle.is_some(),
            line: entry.line_engine.is_some() || matches!(entry.specimen, Some(Specimen::Line(_))),
            attributes: is_engine || triangle.is_some_and(|specimen| specimen.has_values()),
            samples4: is_engine,
            depth: is_engine,
            clip: is_engine,
            batch: MOST_IN_FLIGHT / 4,
            tolerance: if is_engine { OWN_TOLERANCE } else { Self::default().tolerance },
            ..Self::default()
        }
    }
}

pub struct Inside {
    entry: Entry,
    declared: Declared,
}

impl Inside {
    /// The engine, line drawer or specimen of this entry.
    #[must_use]
    pub fn new(entry: &Entry) -> Self {
        Self { entry: *entry, declared: entry.into() }
    }

    fn answer(&self, question: &Question) -> Result<Answer, String> {
        let window = PixelRect::window(question.width, question.height);
        let entry = &self.entry;
        let triangle = match entry.specimen {
            Some(Specimen::Triangle(specimen)) => Some(specimen),
            _ => None,
        };
        match &question.of {
            Asked::Coverage(corners) => {
                let mut runs = Vec::new();
                if let Some(engine) = entry.engine {
                    engine.cover(*corners, window, |span| runs.push(span));
                } else if let Some(engine) = entry.exact_engine {
                    engine.cover_exact(&(*corners).into(), window, |span| runs.push(span));
                } else {
                    let specimen = triangle.ok_or("unsupported")?;
                    specimen
                        .cover(&from_lattice(*corners), window, &mut |span| runs.push(span))
                        .map_err(|refused| refused.to_string())?;
                }
                Ok(Answer::Coverage(runs))
            }
            Asked::Values(triangle_asked) => {
                let mut fragments = Vec::new();
                if let Some(engine) = entry.engine {
                    // The request names w, of which the engine takes the reciprocal.
                    let mut said = *triangle_asked;
                    said.vertices.iter_mut().for_each(|v| v.inv_w = 1.0 / (1.0 / v.inv_w));
                    engine.fragments(&said, window, |f| fragments.push(f));
                } else {
                    let specimen = triangle.ok_or("unsupported")?;
                    let said = from_screen(triangle_asked);
                    // As through the protocol, which counts the pixels first: some refuse those.
                    specimen
                        .cover(&said, window, &mut |_| ())
                        .and_then(|()| {
                            specimen.fragments(&said, window, &mut |f| fragments.push(f))
                        })
                        .map_err(|refused| refused.to_string())?;
                }
                Ok(Answer::Values(fragments))
            }
            Asked::Samples(corners) => {
                let engine = entry.engine.ok_or("unsupported")?;
                let masks = multisample::masks(&engine, *corners, window).ok_or("unsupported")?;
                let runs = masks.rows().flat_map(|(y, row)| runs_of(y, row)).collect();
                Ok(Answer::Samples(runs))
            }
            Asked::Depth(list) => {
                let engine = entry.engine.ok_or("unsupported")?;
                Ok(Answer::Seen(pipeline::seen(engine, list, window)?))
            }
            Asked::Near(triangle) => {
                entry.engine.ok_or("unsupported")?;
                Ok(Answer::Polygon(pipeline::clipped(clip_corners(triangle))))
            }
            Asked::Line { ends, .. } => {
                let mut pixels = Vec::new();
                if let Some(engine) = entry.line_engine {
                    let end = |pixel| LineEnd { pixel, depth: 0.0, varying: 0.0 };
                    let line = ScreenLine { ends: ends.map(end) };
                    engine.draw(&line, window, |f| pixels.push((f.x_px, f.y_px)));
                } else {
                    let Some(Specimen::Line(specimen)) = entry.specimen else {
                        return Err("unsupported".to_owned());
                    };
                    published_line(specimen, question, &mut pixels)?;
                }
                Ok(Answer::Line(pixels))
            }
        }
    }
}

fn published_line(
    specimen: &dyn PublishedLine,
    question: &Question,
    pixels: &mut Vec<(i32, i32)>,
) -> Result<(), String> {
    let Asked::Line { ends, .. } = &question.of else { return Ok(()) };
    let centre = ends.map(|p| [f64::from(p.x) + 0.5, f64::from(p.y) + 0.5]);
    let window = PixelRect::window(question.width, question.height);
    specimen
        .draw(centre, window, &mut |x, y| pixels.push((x, y)))
        .map_err(|refused| refused.to_string())
}

/// Runs of pixels of a row with the same samples covered.
pub fn runs_of(y_px: i32, row: &[u8]) -> Vec<(rasterproof_core::triangle::Span, u8)> {
    let mut x_px = 0;
    let mut runs = Vec::new();
    for run in row.chunk_by(|a, b| a == b) {
        let x1_px = x_px + run.len() as i32;
        if run[0] != 0 {
            runs.push((rasterproof_core::triangle::Span { y_px, x0_px: x_px, x1_px }, run[0]));
        }
        x_px = x1_px;
    }
    runs
}

impl Ask for Inside {
    fn declared(&self) -> &Declared {
        &self.declared
    }

    fn ask(&mut self, questions: &[Question], most_deaths: u64) -> Vec<Answer> {
        let (mut answers, mut deaths) = (Vec::with_capacity(questions.len()), 0);
        for question in questions {
            answers.push(match caught(|| self.answer(question)) {
                Ok(Ok(answer)) => answer,
                Ok(Err(reason)) => Answer::Refused(reason),
                Err(panic) => {
                    deaths += 1;
                    Answer::Died(Misbehaviour::Crashes(panic.0))
                }
            });
            if deaths >= most_deaths {
                break;
            }
        }
        answers
    }
}
