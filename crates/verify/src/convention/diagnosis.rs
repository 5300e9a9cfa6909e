//! What was found: the convention, how much it explains, and how sure that is.

use super::bench::{Bench, TriangleAnswer, TriangleQuestion};
use super::candidate::Candidate;
use super::fit::Fit;
use super::mirror::Mirror;
use super::rule::{Ties, TriangleConvention, Windings};
use super::search::Observation;
use super::ties::{Compass, Count};
use super::upright::mirror_of;
use super::{Declarations, TriangleAsker};
use rasterproof_core::frame::Coverage;

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum Confidence {
    /// It explains every fresh triangle in general position, and no other hypothesis does.
    Certain,
    /// It explains nearly all, or all but not alone: see [`Diagnosis::alternatives`].
    Likely,
    /// No hypothesis explains the answers. The nearest one is kept, and is not the convention.
    #[default]
    Unexplained,
}

/// How far answers agree with a convention.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Agreement {
    /// Triangles whose pixels are exactly the expected ones.
    pub triangles: Count,
    pub covered: u64,
    pub missing: u64,
    pub extra: u64,
}

impl Agreement {
    fn of(convention: &TriangleConvention, answers: &[TriangleAnswer], bench: &Bench<'_>) -> Self {
        let mut sum = Self::default();
        for answer in answers {
            let Some(mask) = convention.mask(&answer.corners, bench.window) else { continue };
            let (missing, extra) = (mask.beyond(&answer.drawn), answer.drawn.beyond(&mask));
            sum.triangles.add(missing + extra == 0);
            sum.covered += u64::from(mask.count());
            sum.missing += u64::from(missing);
            sum.extra += u64::from(extra);
        }
        sum
    }
}

/// The agreement on triangles in general position, and on those with samples on their edges.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Share {
    pub general: Agreement,
    pub ties: Agreement,
}

impl Share {
    fn is_exact(&self) -> bool {
        let is_exact = |a: &Agreement| a.triangles.drawn == a.triangles.of;
        is_exact(&self.general) && is_exact(&self.ties)
    }
}

/// The default is that of a program that leaves nothing to see.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Diagnosis {
    /// What it does; the nearest hypothesis where that is not known.
    pub convention: TriangleConvention,
    pub confidence: Confidence,
    /// Others that explain the answers equally well, the simplest first.
    pub alternatives: Vec<TriangleConvention>,
    pub compass: Compass,
    /// Triangles without area that leave pixels.
    pub flat: Count,
    /// Triangles that change when their corners are rotated.
    pub rotated: Count,
    /// Triangles that change when their winding is reversed; of none, where one winding is drawn.
    pub reversed: Count,
    /// Triangles with a pixel that was hit more than once; of none, where that cannot be seen.
    pub twice: Count,
    pub as_declared: Share,
    /// Agreement with the convention that was found, on answers that it was not found from.
    pub as_found: Share,
    pub asked: u64,
    /// Of these, those that were refused or not answered.
    pub refused: u64,
}

/// From this share of triangles on, a convention that does not explain all is likely.
const LIKELY_PERCENT: f64 = 95.0;

/// Triangles that hypotheses are fitted to, and fresh ones that the best is tried on.
const FITTED: usize = 80;
const FRESH: usize = 150;

/// Questions a rasterizer until its convention is known. Exact, and the same for the same seed and
/// answers. Asks about 700 triangles.
pub async fn diagnose(asker: &TriangleAsker, known: &Declarations, seed: u64) -> Diagnosis {
    let mut silent = Diagnosis { convention: known.declared, ..Diagnosis::default() };
    let Some(mut bench) = Bench::new(asker, known, seed) else { return silent };
    let (draws, pictures) = bench.windings().await;
    bench.mirror = mirror_of(&pictures, bench.window);
    if draws == Windings::Neither {
        silent.convention.draws = draws;
        (silent.asked, silent.refused) = (bench.asked, bench.refused);
        return silent;
    }
    let flips = bench.flips(draws).await;
    let fitted = bench.generals(FITTED, draws).await;
    let seen = Observation { answers: &fitted, window: bench.window, draws };
    let scored = Fit { seen, flips, grain: bench.grain }.hypotheses();
    let candidates = bench.separate(&scored, draws).await;
    let Some(&candidate) = candidates.first() else { return silent };
    let mut found = bench.conclude(&candidate, &candidates[1..], &fitted).await;
    found.convention.mirror = bench.mirror;
    found.alternatives.iter_mut().for_each(|other| other.mirror = bench.mirror);
    Diagnosis { asked: bench.asked, refused: bench.refused, ..found }
}

impl Bench<'_> {
    /// Everything that is asked once a hypothesis stands.
    async fn conclude(
        &mut self,
        candidate: &Candidate,
        others: &[Candidate],
        fitted: &[TriangleAnswer],
    ) -> Diagnosis {
        let draws = candidate.draws;
        // One set for the rule, one to try it on.
        let questions = self.tie_questions(candidate, 40);
        let mut ties = self.draw(&questions).await;
        ties.extend(fitted);
        let questions = self.tie_questions(candidate, 20);
        let tried = self.draw(&questions).await;
        let compass = self.compass(candidate, &ties);
        let flat = self.flat().await;
        let convention = |candidate: &Candidate, ties: Ties| TriangleConvention {
            draws,
            quantum: candidate.quantum,
            shape: candidate.shape,
            ties,
            mirror: Mirror::None,
            flat: flat.drawn > 0,
        };
        let mut found = convention(candidate, compass.ties());
        let fresh = self.generals(FRESH, draws).await;
        let share = |convention: &TriangleConvention, bench: &Self| Share {
            general: Agreement::of(convention, &fresh, bench),
            ties: Agreement::of(convention, &tried, bench),
        };
        let mut as_found = share(&found, self);
        let mut others = others;
        // Ties without a rule: the scan conversion of a library may say why.
        if !as_found.is_exact() {
            for scan in Candidate::scans(draws, &ties, self.window)
                .map(|scan| convention(&scan, compass.ties()))
            {
                let as_scan = share(&scan, self);
                if as_scan.is_exact() {
                    (found, as_found, others) = (scan, as_scan, &[]);
                }
            }
        }
        // Answers are taken back from their mirror, so what is declared is put into it.
        let as_declared =
            share(&TriangleConvention { mirror: self.mirror, ..self.known.declared }, self);
        let mut twice = Count::default();
        if !self.known.mask {
            fresh.iter().chain(&tried).for_each(|answer| twice.add(!answer.twice.is_empty()));
        }
        let ordered: Vec<_> =
            fresh.iter().take(15).chain(tried.iter().take(25)).map(|a| a.corners).collect();
        let [rotated, reversed] = self.orders(&ordered, draws).await;
        let alternatives: Vec<_> = others
            .iter()
            .filter(|other| !candidate.is_near(other))
            .map(|other| convention(other, compass.ties()))
            .collect();
        Diagnosis {
            convention: found,
            confidence: Confidence::of(as_found.general.triangles, alternatives.is_empty()),
            alternatives,
            compass,
            flat,
            rotated,
            reversed,
            twice,
            as_declared,
            as_found,
            asked: 0,
            refused: 0,
        }
    }
}

impl Confidence {
    /// How sure a hypothesis is that explains so many of the fresh answers. `is_alone` is whether no other one
    /// explains as many.
    pub(super) fn of(fresh: Count, is_alone: bool) -> Self {
        match fresh.percent() {
            Some(_) if is_alone && fresh.drawn == fresh.of => Self::Certain,
            Some(percent) if percent >= LIKELY_PERCENT => Self::Likely,
            _ => Self::Unexplained,
        }
    }
}

impl Diagnosis {
    /// The pixels that the convention expects, to judge again by what was found. None where it is
    /// not known, or says nothing.
    pub fn expected(&self, question: &TriangleQuestion) -> Option<Coverage> {
        (self.confidence != Confidence::Unexplained)
            .then(|| self.convention.cover(&question.corners, question.window))
            .flatten()
    }
}
