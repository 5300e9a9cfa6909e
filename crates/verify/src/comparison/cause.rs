//! Why an engine is wrong: the convention that explains what it draws, recognised by asking it more.

use std::fmt;

use super::Convention;
use crate::ask::Search;
use crate::convention::{
    Confidence, Declarations, Diagnosis, LineAsker, LineDiagnosis, LineQuestion, TriangleAsker,
    TriangleQuestion,
};
use crate::mistakes::{self, LearnTriangles, Mistakes};
use rasterproof_core::frame::Coverage;

/// What was recognised, or that nothing was.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Cause {
    /// Whether a convention explains what was drawn.
    pub is_known: bool,
    /// What the engine does, or the nearest convention and how much it explains.
    pub sentence: String,
    /// An expression of Rust: what to declare if that is meant. Nothing where no declaration says it.
    pub declare: Option<String>,
}

/// The search for the cause why triangles are drawn wrongly.
#[doc(hidden)]
pub type CauseSearch = Search<'static, TriangleQuestion, Option<Coverage>, Cause>;

/// The questions are the same in every run.
const SEED: u64 = 1;

impl Cause {
    /// Asks for about 1,900 triangles in a small window.
    pub(super) fn of_triangles(
        declared: &Convention,
        mut draw: impl FnMut(&TriangleQuestion) -> Option<Coverage>,
    ) -> Self {
        let search =
            Self::search(Declarations::from(declared), *declared, Some(mistakes::learn_triangles));
        search.answered_by(|questions| questions.iter().map(&mut draw).collect())
    }

    /// The search for the cause, which asks in batches. Without `learn` nothing is learned where no known mistake explains it.
    #[doc(hidden)]
    #[must_use]
    pub fn search(
        known: Declarations,
        declared: Convention,
        learn: Option<LearnTriangles>,
    ) -> CauseSearch {
        Search::new(async move |asker: TriangleAsker| {
            let found = crate::convention::diagnose(&asker, &known, SEED).await;
            let declaration = Self::declaration(&found, &declared);
            let cause = Self::of(found.confidence, &found.sentence(), declaration);
            cause.with(mistakes::of_triangles(&asker, &known, Some(&found), &[], learn).await)
        })
    }

    /// Asks for about 1,100 lines in a small window.
    pub(super) fn of_lines(mut draw: impl FnMut(&LineQuestion) -> Option<Vec<[i32; 2]>>) -> Self {
        let search = Search::new(async |asker: LineAsker| {
            let known = Declarations::default();
            let found: LineDiagnosis =
                crate::convention::diagnose_lines(&asker, known.side_px(), true, SEED).await;
            let cause = Self::of(found.confidence, &found.sentence(), None);
            cause.with(mistakes::of_lines(&asker, &known, Some(&found), &[]).await)
        });
        search.answered_by(|questions| questions.iter().map(&mut draw).collect())
    }

    /// With what is wrong beyond the convention, or instead of one.
    pub(super) fn with(mut self, mistakes: Option<Mistakes>) -> Self {
        let Some(mistakes) = mistakes else { return self };
        let is_named = mistakes.is_known();
        self.sentence = match self.is_known {
            true if is_named => format!("{} Beyond that: {mistakes}", self.sentence),
            true => self.sentence,
            // A mistake says more than the nearest convention.
            false if is_named => mistakes.to_string(),
            false => format!("{} {mistakes}", self.sentence),
        };
        self.is_known |= is_named;
        self
    }

    /// What to declare; an empty expression where it draws as it declares.
    fn declaration(found: &Diagnosis, declared: &Convention) -> Option<String> {
        let declaration = found.declaration(declared)?;
        let is_declared = declaration == *declared && found.as_declared == found.as_found;
        Some(if is_declared { String::new() } else { declaration.to_string() })
    }

    fn of(confidence: Confidence, sentence: &str, declare: Option<String>) -> Self {
        let is_declared = declare.as_ref().is_some_and(String::is_empty);
        let sentence = match is_declared {
            true => "The pixels of small triangles within the window are as declared.".to_owned(),
            false => sentence.to_owned(),
        };
        let is_known = confidence != Confidence::Unexplained && !is_declared;
        Self { is_known, sentence, declare: declare.filter(|_| is_known) }
    }
}

impl Cause {
    /// The cause in a line, or that none was recognised.
    #[must_use]
    pub fn headline(&self) -> String {
        let what = if self.is_known { "probable cause" } else { "no cause was recognised" };
        format!("{what}: {}", self.sentence)
    }
}

impl fmt::Display for Cause {
    /// The cause, and what to declare if it is meant.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.headline())?;
        match &self.declare {
            Some(declare) => write!(
                f,
                "\nif that is meant, declare it: Options::default().convention({declare})"
            ),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases::FamilyName;
    use crate::comparison::{Options, Rule, Winding, judge_coverage, judge_values, tolerance};
    use rasterproof_core::contract::{Interpolate, Rasterize};
    use rasterproof_core::grid::{HALF_PIXEL, PixelRect, SUBPIXELS, SubpixelPoint};
    use rasterproof_core::raster::scanline::Scanline;
    use rasterproof_core::triangle::{
        Corners, Fragment, ScreenTriangle, ScreenVertex, Span, Varying,
    };

    /// Draws what has to be drawn by a convention. Corners reach a coarser grid by cutting them down, or by rounding.
    #[derive(Clone, Copy, Debug)]
    struct By {
        convention: Convention,
        down: bool,
    }

    impl Rasterize for By {
        fn cover(&self, corners: Corners, bounds: PixelRect, emit: impl FnMut(Span)) {
            let step = SUBPIXELS >> self.convention.subpixel_bits;
            let ahead = if self.down { 0 } else { step / 2 };
            let snap = |v: i32| v.saturating_add(ahead).div_euclid(step) * step;
            let corners = corners.map(|p| SubpixelPoint::new(snap(p.x), snap(p.y)));
            self.convention.expected(&corners, bounds).must.into_iter().for_each(emit);
        }
    }

    /// Every seventh of all combinations, which has every rule, place and winding on one grid or another.
    fn candidates() -> impl Iterator<Item = By> {
        let mut all = Vec::new();
        for (bits, down) in [(8, false), (6, false), (6, true), (4, false), (4, true)] {
            for (_, rule) in Rule::ALL.into_iter().filter(|(_, rule)| *rule != Rule::Unspecified) {
                for [x, y] in [[1, 1], [0, 0], [0, 2], [2, 0], [2, 2]] {
                    for winding in [Winding::Both, Winding::Clockwise, Winding::CounterClockwise] {
                        let convention = Convention::default().rule(rule).winding(winding);
                        let convention = convention.sample(x * HALF_PIXEL, y * HALF_PIXEL);
                        all.push(By { convention: convention.subpixel_bits(bits), down });
                    }
                }
            }
        }
        all.into_iter().step_by(7)
    }

    fn families(options: Options) -> Options {
        let names = [
            FamilyName::HalfInteger,
            FamilyName::Rectangle,
            FamilyName::PartlyOff,
            FamilyName::Far,
        ];
        names.into_iter().fold(options.cases(10), Options::family)
    }

    /// Every convention is told from every other one, and is what has to be declared.
    #[test]
    fn conventions_are_recognised() {
        let mut known = 0;
        for by in candidates() {
            let verdict = judge_coverage(&by, &families(Options::default())).unwrap();
            let Some(cause) = &verdict.cause else {
                assert!(verdict.agrees(), "{by:?}");
                continue;
            };
            assert!(cause.is_known, "{by:?}: {cause}");
            assert_eq!(cause.declare, Some(by.convention.to_string()), "{cause}");
            known += 1;
        }
        assert!(known > 60, "{known}");
    }

    /// Who draws as declared agrees, and nobody else.
    #[test]
    fn conventions_are_judged() {
        for by in candidates() {
            let convention = by.convention;
            let options = families(Options::default().convention(convention));
            let verdict = judge_coverage(&by, &options).unwrap();
            assert!(verdict.agrees(), "{convention}: {}", verdict.check().unwrap_err());
            let other =
                if convention.rule == Rule::TopRight { Rule::BottomLeft } else { Rule::TopRight };
            let options = families(Options::default().convention(convention.rule(other)));
            let verdict = judge_coverage(&by, &options).unwrap();
            assert!(!verdict.agrees(), "{convention} is not told from {other:?}");
        }
        // The same engine, for one whose y axis points up.
        let below = By { convention: Convention::default().rule(Rule::BottomLeft), down: false };
        let options = families(Options::default().convention(Convention::default().y_up()));
        assert!(judge_coverage(&below, &options).unwrap().agrees());
        // Nothing is promised of samples on edges: every rule will do, and a wrong sample place will not.
        let open =
            families(Options::default().convention(Convention::default().rule(Rule::Unspecified)));
        for by in candidates().filter(|by| by.convention.subpixel_bits == 8) {
            let Convention { sample, winding, .. } = by.convention;
            let is_right = sample == [HALF_PIXEL; 2] && winding == Winding::Both;
            let verdict = judge_coverage(&by, &open).unwrap();
            assert_eq!(verdict.agrees(), is_right, "{}", by.convention);
        }
    }

    /// Wrong values have a cause of their own, beside that of the pixels.
    #[test]
    fn wrong_values_are_explained() {
        struct Affine;
        impl Rasterize for Affine {
            fn cover(&self, corners: Corners, bounds: PixelRect, emit: impl FnMut(Span)) {
                Scanline.cover(corners, bounds, emit);
            }
        }
        impl Interpolate for Affine {
            fn fragments<V: Varying>(
                &self,
                triangle: &ScreenTriangle<V>,
                bounds: PixelRect,
                mut emit: impl FnMut(Fragment<V>),
            ) {
                let [a, b, c] = &triangle.vertices;
                Scanline.fragments(triangle, bounds, |mut f| {
                    let flat = |v: &ScreenVertex<V>| ScreenVertex { inv_w: 1.0, ..*v };
                    let affine = ScreenTriangle { vertices: [flat(a), flat(b), flat(c)] };
                    let pixel =
                        PixelRect { x0: f.x_px, y0: f.y_px, x1: f.x_px + 1, y1: f.y_px + 1 };
                    Scanline.fragments(&affine, pixel, |g| f.varying = g.varying);
                    emit(f);
                });
            }
        }
        let options = Options::default().cases(20).family(FamilyName::W100);
        let verdict = judge_values(&Affine, tolerance::SCANLINE, &options).unwrap();
        let cause = verdict.cause.unwrap().to_string();
        assert!(
            cause.starts_with("probable cause: It interpolates attributes linearly on the screen"),
            "{cause}"
        );
        let right = judge_values(&Scanline, tolerance::SCANLINE, &options).unwrap();
        assert!(right.agrees() && right.cause.is_none());
    }

    /// A fault that small triangles do not show has no convention for its cause, and is named as a mistake.
    #[test]
    fn what_is_no_convention_is_not_called_one() {
        struct ForgetsLargeOnes;
        impl Rasterize for ForgetsLargeOnes {
            fn cover(&self, corners: Corners, bounds: PixelRect, emit: impl FnMut(Span)) {
                if corners.iter().all(|p| p.x.abs() < 1 << 16) {
                    Scanline.cover(corners, bounds, emit);
                }
            }
        }
        let verdict = judge_coverage(&ForgetsLargeOnes, &families(Options::default())).unwrap();
        let cause = verdict.cause.unwrap();
        assert!(cause.declare.is_none(), "{cause}");
        let said = "probable cause: It does not draw triangles whose ";
        assert!(cause.to_string().starts_with(said), "{cause}");
    }
}
