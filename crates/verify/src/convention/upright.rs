//! Whether all pictures come out turned over: asked before anything else.

use super::bench::TriangleAnswer;
use super::mirror::Mirror;
use super::rule::TriangleConvention;
use rasterproof_core::grid::PixelRect;

/// Pictures are a mirror's if they have less than one in so many of the wrong pixels they have unmirrored.
const SHARE: u32 = 3;

/// The mirror that explains pictures of large triangles, by the samples at the centres: what a
/// program does else is small beside a picture that is turned over.
pub(super) fn mirror_of(answers: &[TriangleAnswer], window: PixelRect) -> Mirror {
    let own = TriangleConvention::default();
    let wrong = |mirror: Mirror| -> u32 {
        let one = |answer: &TriangleAnswer| {
            let drawn = answer.drawn.mirrored(mirror, window);
            let expected = own.mask(&answer.corners, window).unwrap_or_default();
            expected.beyond(&drawn) + drawn.beyond(&expected)
        };
        answers.iter().filter(|answer| !answer.drawn.is_empty()).map(one).sum()
    };
    let as_is = wrong(Mirror::None);
    let best = Mirror::ALL.into_iter().min_by_key(|mirror| wrong(*mirror));
    best.filter(|mirror| SHARE * wrong(*mirror) < as_is).unwrap_or(Mirror::None)
}
