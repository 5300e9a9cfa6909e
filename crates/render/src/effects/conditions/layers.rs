//! Ordered transparency: keeping fragments that are mixed, and mixing them in the order of their depths when all surfaces
//! are drawn.
//!
//! Left out where the scene does not ask for it or the material does not blend, for a piece whose fragments are all opaque or
//! all clear, and for one whose depths are not tested or whose box meets no other piece of an item that blends
//! ([`depth::overlaps`]). Of such a piece each sample has one layer at most: two pieces on either side of an edge that they
//! share meet in no sample. What is opaque there is drawn before it, since items that blend come last, and so the
//! mixture at once is that of the one layer at the end.

use super::account::{Condition, ItemQuestion};
use super::blending::is_blended;
use super::depth::{margin_px, overlaps};
use crate::effects::plan::{Attributes, Canvas};
use crate::effects::primitive::{Piece, Prepared, pixel_box};
use crate::effects::{Effect, Effects, Mode};
use crate::scene::Scene;
use rasterproof_core::grid::PixelRect;

fn is_asked_for(asked: &ItemQuestion<'_>) -> bool {
    asked.scene.layers.is_some() && is_blended(asked.item)
}

pub const CONDITION: Condition = Condition {
    effect: Effect::Layers,
    needs: 0,
    is_possible: is_asked_for,
    is_asked_for,
    missing: |_| None,
    by_material: "the material blends",
    open: "where fragments are mixed",
    reasons: |_| {
        [
            "no piece is mixed where another one blends",
            "every piece may be mixed where another one blends",
            "some pieces may be mixed where others blend",
        ]
    },
};

/// Whether any item may have layers.
pub fn is_in_use(scene: &Scene, effects: &Effects) -> bool {
    let asked = |item| ItemQuestion { scene, item, carries: Attributes::NONE, effects };
    scene.items.iter().any(|item| CONDITION.mode(&asked(item)) != Mode::Never)
}

/// Of more items that blend, all pieces are compared with all.
const MOST_ITEMS: usize = 64;

/// Which pieces of items that blend have boxes that meet one another.
pub fn meets(items: &[Prepared<'_>], pieces: &[(usize, Piece)], canvas: &Canvas) -> Vec<bool> {
    let is_blended = |i: &usize| is_blended(items[pieces[*i].0].item);
    let blended: Vec<usize> = (0..pieces.len()).filter(is_blended).collect();
    among(&blended, pieces, canvas)
}

/// Of some pieces, which have boxes that meet one another.
fn among(blended: &[usize], pieces: &[(usize, Piece)], canvas: &Canvas) -> Vec<bool> {
    let mut meets = vec![false; pieces.len()];
    for group in groups(blended, pieces, canvas) {
        let of_group: Vec<_> = group.iter().map(|i| pieces[*i]).collect();
        for (i, is_met) in group.iter().zip(overlaps(&of_group, canvas)) {
            meets[*i] = is_met;
        }
    }
    meets
}

/// Pieces by their numbers: those of each item that is apart from the others, and the rest. [`overlaps`] takes all pieces
/// that it is given to meet where most of them do, so what is apart is not given together with what is not.
fn groups(blended: &[usize], pieces: &[(usize, Piece)], canvas: &Canvas) -> Vec<Vec<usize>> {
    let mut boxes: Vec<(usize, PixelRect, Vec<usize>)> = Vec::new();
    for &i in blended {
        let (item, piece) = &pieces[i];
        let rect = pixel_box(&piece.corners(), margin_px(canvas));
        match boxes.iter().position(|(other, ..)| other == item) {
            Some(at) => {
                let (_, whole, of_item) = &mut boxes[at];
                *whole = PixelRect {
                    x0: whole.x0.min(rect.x0),
                    y0: whole.y0.min(rect.y0),
                    x1: whole.x1.max(rect.x1),
                    y1: whole.y1.max(rect.y1),
                };
                of_item.push(i);
            }
            None if boxes.len() == MOST_ITEMS => return vec![blended.to_vec()],
            None => boxes.push((*item, rect, vec![i])),
        }
    }
    let is_apart = |item: usize, rect: &PixelRect| {
        boxes.iter().all(|(other, whole, _)| *other == item || rect.intersect(whole).is_empty())
    };
    let (mut groups, mut rest) = (Vec::new(), Vec::new());
    for (item, rect, of_item) in &boxes {
        if is_apart(*item, rect) {
            groups.push(of_item.clone());
        } else {
            rest.extend(of_item);
        }
    }
    groups.push(rest);
    groups
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::planner;
    use crate::pipeline::depth::DepthFormat;
    use crate::pipeline::target::Antialias;
    use crate::scene::random;
    use rasterproof_core::contract::Rasterize as _;
    use rasterproof_core::frame::Frame;
    use rasterproof_core::raster::scanline::Scanline;

    /// Which of all pieces, with the items they are of, may have a second layer.
    type Condition = fn(&[(usize, Piece)], &Canvas) -> Vec<bool>;

    /// How many pieces have a second layer nowhere, of how many a condition knows it, and how often it is wrong.
    fn tried(condition: Condition) -> [u32; 3] {
        let canvas = Canvas {
            width: 80,
            height: 60,
            antialias: Antialias::None,
            depth: DepthFormat::Unorm32,
            watched: false,
        };
        let mut counts = [0; 3];
        for index in 0..200 {
            let scene = random::scene(11, index);
            let (_, mut assembled) =
                planner::plan(&scene, &canvas, &Effects::PLANNED, &|_| None).unwrap();
            assembled.assemble(&scene);
            let pieces = assembled.pieces.unwrap();
            let mut layers = Frame::new(canvas.size(), 0u32);
            for (_, piece) in &pieces {
                Scanline.cover(piece.corners(), canvas.size(), |span| {
                    for count in layers.span_mut(span.y_px, span.x0_px, span.x1_px) {
                        *count += 1;
                    }
                });
            }
            for ((_, piece), meets) in pieces.iter().zip(condition(&pieces, &canvas)) {
                let mut most = 0;
                Scanline.cover(piece.corners(), canvas.size(), |span| {
                    let counts = layers.span_mut(span.y_px, span.x0_px, span.x1_px);
                    most = counts.iter().fold(most, |most, count| most.max(*count));
                });
                let is_alone = most <= 1;
                for (count, is) in counts.iter_mut().zip([is_alone, !meets, !meets && !is_alone]) {
                    *count += u32::from(is);
                }
            }
        }
        counts
    }

    #[test]
    fn a_piece_that_meets_no_other_has_one_layer() {
        let [alone, known, wrong] =
            tried(|pieces, canvas| among(&(0..pieces.len()).collect::<Vec<_>>(), pieces, canvas));
        assert!(wrong == 0 && known > 100, "{known} of {alone}, {wrong} wrong");
        // Wrong ones: the triangles of one item do not meet; two meet only if a corner of one lies in the box of the other;
        // and it is enough to look at the next piece in the order of drawing.
        let other_items: Condition = |pieces, canvas| {
            let meets = |(item, piece): &(usize, Piece)| {
                let others = pieces.iter().filter(|(other, _)| other != item);
                let pair = others.map(|other| [(*item, *piece), *other]);
                pair.into_iter().any(|pair| overlaps(&pair, canvas)[0])
            };
            pieces.iter().map(meets).collect()
        };
        let corners: Condition = |pieces, _| {
            let boxes: Vec<_> =
                pieces.iter().map(|(_, piece)| pixel_box(&piece.corners(), 0)).collect();
            let has_corner = |of: usize, within: usize| {
                let rect = &boxes[within];
                pieces[of].1.corners().iter().any(|corner| {
                    let [x, y] = [corner.x, corner.y].map(|sub| sub >> 8);
                    (rect.x0..rect.x1).contains(&x) && (rect.y0..rect.y1).contains(&y)
                })
            };
            let others = |i: usize| (0..pieces.len()).filter(move |j| *j != i);
            (0..pieces.len())
                .map(|i| others(i).any(|j| has_corner(i, j) || has_corner(j, i)))
                .collect()
        };
        let next: Condition = |pieces, canvas| {
            let pairs =
                |i: usize| pieces.get(i..i + 2).is_some_and(|pair| overlaps(pair, canvas)[0]);
            (0..pieces.len()).map(|i| pairs(i) || i > 0 && pairs(i - 1)).collect()
        };
        for (number, condition) in [other_items, corners, next].into_iter().enumerate() {
            let [_, _, wrong] = tried(condition);
            assert!(wrong > 0, "wrong condition {number} survives");
        }
    }
}
