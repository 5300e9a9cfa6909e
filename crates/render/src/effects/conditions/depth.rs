//! Depth: comparing with the depth buffer and writing to it.
//!
//! Left out where no other piece has a bounding box that meets this one's. Then nothing is in front
//! of it, and it is in front of nothing; the clear value is farther than every depth. Two pieces on
//! either side of an edge they share count as one: by the fill rule they meet nowhere.

use super::account::Account;
use crate::effects::plan::{Canvas, Decision};
use crate::effects::primitive::{Piece, Prepared, pixel_box};
use crate::effects::{Effect, Effects, Mode};
use crate::pipeline::target::Antialias;
use crate::scene::{Hidden, Scene};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_core::triangle::Corners;

/// Of scenes with more triangles only some are looked at: to list all would cost more than it saves.
const MOST_TRIANGLES: usize = 2048;

/// Comparisons for each box, on average, after which all are taken to overlap.
const MOST_COMPARISONS: usize = 64;

/// Boxes whose areas add up to so many times that of the window are all taken to overlap: boxes that are
/// apart add up to once at most.
const MOST_AREA: u64 = 2;

/// If nearly all of the first boxes, of each item or of the sweep, meet another, all are taken to.
const FIRST_BOXES: usize = 64;

/// Whether it pays to list the pieces before anything is drawn: triangles are few, or apart at first sight.
pub fn is_looked_at(
    scene: &Scene,
    effects: &Effects,
    items: &[Prepared<'_>],
    canvas: &Canvas,
) -> bool {
    scene.hidden == Hidden::DepthBuffer
        && effects.mode(Effect::Depth) == Mode::Planned
        && scene.triangles() <= MOST_TRIANGLES
        && (scene.triangles() <= 4 * FIRST_BOXES
            || !items.iter().all(|item| first_meet(item, margin_px(canvas))))
}

/// Whether a scene has so many triangles that it is not listed, whatever they are like.
pub fn is_surveyed(scene: &Scene) -> bool {
    scene.hidden == Hidden::DepthBuffer && scene.triangles() > MOST_TRIANGLES
}

/// Whether nearly all boxes of the first triangles of an item meet another one of theirs.
fn first_meet(item: &Prepared<'_>, margin_px: i32) -> bool {
    let place = |number: u32| item.points[number as usize].place();
    let corners = |&[a, b, c]: &[u32; 3]| Some([place(a)?, place(b)?, place(c)?]);
    let all = item.item.mesh.triangles.positions().iter();
    let first: Vec<_> = all.filter_map(corners).take(FIRST_BOXES).collect();
    let groups = groups(&first, margin_px);
    let meets_another = |group: &&BoxGroup| {
        let meets = |other: &BoxGroup| {
            other.pieces != group.pieces && !other.rect.intersect(&group.rect).is_empty()
        };
        groups.iter().any(meets)
    };
    are_nearly_all(groups.iter().filter(meets_another).count(), groups.len())
}

fn are_nearly_all(met: usize, boxes: usize) -> bool {
    met * 8 > boxes * 7
}

/// Samples lie up to 6/16 px off the centre.
pub fn margin_px(canvas: &Canvas) -> i32 {
    i32::from(canvas.antialias == Antialias::Multisample4)
}

/// Triangles of a scene too large to be listed that are looked at. They are compared with every eighth triangle, since a
/// survey is to take at most 5% of a frame, with every fourth it took up to 5.7%, and with all triangles 13%.
const SURVEYED: usize = 16;
const STRIDE: usize = 8;

/// How many triangles were looked at, evenly spread over a scene, and how many of their boxes meet that of one of every
/// eighth triangle with which they share no corner.
pub fn survey(scene: &Scene, items: &[Prepared<'_>], canvas: &Canvas) -> [usize; 2] {
    let margin_px = margin_px(canvas);
    let rect = |item: &Prepared<'_>, triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|number| item.points[number as usize].place());
        Some(pixel_box(&[a?, b?, c?], margin_px))
    };
    let stride = scene.triangles().div_ceil(SURVEYED).max(1);
    let mut open: Vec<(usize, [u32; 3], PixelRect)> = Vec::with_capacity(SURVEYED);
    let mut next = 0;
    for (index, item) in items.iter().enumerate() {
        let triangles = item.item.mesh.triangles.positions();
        while let Some(triangle) = triangles.get(next) {
            if let Some(rect) = rect(item, triangle) {
                open.push((index, *triangle, rect));
            }
            next += stride;
        }
        next -= triangles.len();
    }
    let looked_at = open.len();
    for (index, item) in items.iter().enumerate() {
        for triangle in item.item.mesh.triangles.positions().iter().step_by(STRIDE) {
            if open.is_empty() {
                return [looked_at, looked_at];
            }
            let Some(other) = rect(item, triangle) else { continue };
            open.retain(|(of, positions, rect)| {
                let shares = |number: &u32| positions.contains(number);
                rect.intersect(&other).is_empty() || (*of == index && triangle.iter().any(shares))
            });
        }
    }
    [looked_at, looked_at - open.len()]
}

/// Whether a piece pays that may overlap another or not.
pub fn pays(scene: &Scene, effects: &Effects, overlaps: bool) -> bool {
    scene.hidden == Hidden::DepthBuffer && effects.pays(Effect::Depth, overlaps)
}

pub fn explain(account: &Account<'_>, looked_at: Option<[usize; 2]>) -> Decision {
    let (pieces, depth) = (account.pieces, account.paid(Effect::Depth));
    if account.asked.scene.hidden == Hidden::Painter {
        return account.decide(Effect::Depth, 0, "the scene is drawn from back to front");
    }
    if !account.is_listed {
        let on = if pays(account.asked.scene, account.asked.effects, true) { pieces } else { 0 };
        let reason = match looked_at {
            None => "the first triangles overlap, and all are taken to".to_owned(),
            Some([0, _]) => "all are taken to overlap".to_owned(),
            Some([all, met]) => format!(
                "of {all} triangles compared with every eighth, {met} may overlap one that they share \
                 no corner with"
            ),
        };
        return account.decide(Effect::Depth, on, reason);
    }
    let reason = match depth {
        0 => "no bounding box of another piece meets this item's".to_owned(),
        _ if depth == pieces => "every piece may overlap another".to_owned(),
        _ => "some pieces may overlap others".to_owned(),
    };
    account.decide(Effect::Depth, depth, reason)
}

/// Pieces whose boxes are compared as one: a piece, or two on either side of a shared edge.
struct BoxGroup {
    pieces: std::ops::Range<usize>,
    rect: PixelRect,
}

/// Which pieces may hide or be hidden: compares all bounding boxes, by a sweep along the axis where
/// they are shorter.
pub fn overlaps(pieces: &[(usize, Piece)], canvas: &Canvas) -> Vec<bool> {
    let corners: Vec<Corners> = pieces.iter().map(|(_, piece)| piece.corners()).collect();
    let mut groups = groups(&corners, margin_px(canvas));
    let window = canvas.window();
    let area = |rect: &PixelRect| u64::from(rect.width()) * u64::from(rect.height());
    let boxes: u64 = groups.iter().map(|group| area(&group.rect.intersect(&window))).sum();
    if groups.len() > FIRST_BOXES && boxes > MOST_AREA * area(&window) {
        return vec![true; pieces.len()];
    }
    let sum = |side: fn(&PixelRect) -> u32| -> u64 {
        groups.iter().map(|group| u64::from(side(&group.rect))).sum()
    };
    if sum(PixelRect::height) < sum(PixelRect::width) {
        for BoxGroup { rect: PixelRect { x0, y0, x1, y1 }, .. } in &mut groups {
            std::mem::swap(x0, y0);
            std::mem::swap(x1, y1);
        }
    }
    groups.sort_unstable_by_key(|group| group.rect.x0);
    let mut overlaps = vec![false; pieces.len()];
    let (mut comparisons, mut met) = (0, 0);
    for (i, group) in groups.iter().enumerate() {
        let meets = groups[i + 1..].iter().take_while(|other| other.rect.x0 < group.rect.x1);
        for other in meets {
            comparisons += 1;
            if other.rect.y0 < group.rect.y1 && group.rect.y0 < other.rect.y1 {
                overlaps[group.pieces.clone()].fill(true);
                overlaps[other.pieces.clone()].fill(true);
            }
        }
        met += usize::from(overlaps[group.pieces.start]);
        let nearly_all = i + 1 >= FIRST_BOXES && are_nearly_all(met, i + 1);
        if comparisons > MOST_COMPARISONS * groups.len() || nearly_all {
            overlaps.fill(true);
            break;
        }
    }
    overlaps
}

fn groups(corners: &[Corners], margin_px: i32) -> Vec<BoxGroup> {
    let mut groups: Vec<BoxGroup> = Vec::with_capacity(corners.len());
    let mut i = 0;
    while i < corners.len() {
        let mut rect = pixel_box(&corners[i], margin_px);
        let mut end = i + 1;
        if let Some(next) = corners.get(end)
            && share_an_edge(&corners[i], next)
        {
            let other = pixel_box(next, margin_px);
            rect = PixelRect {
                x0: rect.x0.min(other.x0),
                y0: rect.y0.min(other.y0),
                x1: rect.x1.max(other.x1),
                y1: rect.y1.max(other.y1),
            };
            end += 1;
        }
        groups.push(BoxGroup { pieces: i..end, rect });
        i = end;
    }
    groups
}

/// Whether two triangles have two corners in common and the third ones on either side.
pub fn share_an_edge(a: &Corners, b: &Corners) -> bool {
    let [third_a, third_b] = [(a, b), (b, a)].map_array(|(own, other)| {
        let mut alone = own.iter().filter(|corner| !other.contains(corner));
        alone.next().filter(|_| alone.next().is_none())
    });
    let (Some(third_a), Some(third_b)) = (third_a, third_b) else { return false };
    let mut shared = a.iter().filter(|corner| *corner != third_a);
    let (Some(p), Some(q)) = (shared.next(), shared.next()) else { return false };
    let side = |r: &SubpixelPoint| twice_area(&[*p, *q, *r]).signum();
    side(third_a) * side(third_b) < 0
}
