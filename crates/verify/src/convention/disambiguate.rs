//! Hypotheses are told apart: triangles are looked for on which they differ, and asked.

use super::bench::Bench;
use super::candidate::Candidate;
use super::general::drawable;
use super::quantum::{Quantum, Rounding};
use super::rule::Windings;
use super::search::Scored;
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::SubpixelPoint;
use rasterproof_core::triangle::Corners;

/// Hypotheses that are told apart by further questions.
const MOST_SURVIVORS: usize = 48;
/// Rounds of questions, and questions in a round.
const ROUNDS: usize = 6;
const A_ROUND: usize = 24;
/// Triangles that are tried in search of one on which two hypotheses differ.
const TRIES: usize = 2000;

impl Bench<'_> {
    /// Those of the hypotheses that further questions do not refute, the simplest first. All that
    /// explain the answers so far are asked about, or the best alone.
    pub(super) async fn separate(&mut self, scored: &[Scored], draws: Windings) -> Vec<Candidate> {
        let least = scored.first().map_or(0, |(errors, _)| *errors);
        let mut survivors: Vec<Candidate> = Vec::new();
        for (errors, candidate) in scored {
            if *errors == least && survivors.len() < MOST_SURVIVORS {
                survivors.push(*candidate);
            }
        }
        // What rounds down may as well round toward zero, until a negative corner tells.
        let mut negative = false;
        for i in 0..survivors.len() {
            let mut twin = survivors[i];
            if twin.quantum.step > 1 && twin.quantum.rounding == Rounding::Down {
                twin.quantum = Quantum { rounding: Rounding::TowardZero, ..twin.quantum };
                survivors.push(twin);
                negative = true;
            }
        }
        for _ in 0..ROUNDS {
            let questions = self.telling(&survivors, draws, negative);
            let answers = self.draw(&questions).await;
            if answers.is_empty() {
                break;
            }
            let errors: Vec<_> =
                survivors.iter().map(|c| c.errors(&answers, self.window, u32::MAX)).collect();
            // Where none is right, the nearest go on; the share explained will tell.
            let least = errors.iter().copied().min().unwrap_or(0);
            let mut errors = errors.into_iter();
            survivors.retain(|_| errors.next() == Some(least));
        }
        survivors
    }

    /// Questions on which the simplest hypothesis differs from others.
    fn telling(&mut self, all: &[Candidate], draws: Windings, negative: bool) -> Vec<Corners> {
        let Some((first, rest)) = all.split_first() else { return Vec::new() };
        let mut open: Vec<_> = rest.iter().collect();
        let mut questions = Vec::new();
        for _ in 0..TRIES {
            if open.is_empty() || questions.len() == A_ROUND {
                break;
            }
            let corners = drawable(self.odd(negative), draws);
            if twice_area(&corners) == 0 {
                continue;
            }
            // A question counts if it tells one more hypothesis from the first.
            let before = open.len();
            open.retain(|other| !first.differs(other, &corners, self.window));
            if open.len() < before {
                questions.push(corners);
            }
        }
        questions
    }

    /// A triangle whose corners lie halfway between those of some grid, or anywhere; left of and
    /// above the window too, if that is asked for.
    fn odd(&mut self, negative: bool) -> Corners {
        let mut corners = self.general();
        let step = 1 << self.rng.int(2, 8);
        let halves = !self.rng.chance(3);
        let shift = if negative { self.rng.int(0, 12) as i32 * 256 } else { 0 };
        for corner in &mut corners {
            let fit = |v: i32| {
                let v =
                    if halves && step / 2 >= self.grain { v / step * step + step / 2 } else { v };
                v - shift
            };
            *corner = SubpixelPoint::new(fit(corner.x), fit(corner.y));
        }
        corners
    }
}
