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
    let as_is = wrong_pixels(answers, window, &own, Mirror::None);
    // The first of equal ones.
    let (mut best, mut least) = (Mirror::None, as_is);
    for mirror in Mirror::ALL {
        let wrong = wrong_pixels(answers, window, &own, mirror);
        if wrong < least {
            (best, least) = (mirror, wrong);
        }
    }
    if SHARE * least < as_is { best } else { Mirror::None }
}

/// Pixels that are wrong if pictures come out of such a mirror; those of empty pictures are not counted.
fn wrong_pixels(
    answers: &[TriangleAnswer],
    window: PixelRect,
    own: &TriangleConvention,
    mirror: Mirror,
) -> u32 {
    let mut wrong = 0;
    for answer in answers {
        if answer.drawn.is_empty() {
            continue;
        }
        let drawn = answer.drawn.mirrored(mirror, window);
        let expected = own.mask(&answer.corners, window).unwrap_or_default();
        wrong += expected.beyond(&drawn) + drawn.beyond(&expected);
    }
    wrong
}
