//! What snapping breaks: triangles that it turns over or flattens, samples of a surface that no triangle covers after it, and samples
//! that more triangles cover than before.
//!
//! Two exact engines count how many pieces cover each sample: one with the corners as they are given, one with the snapped ones. Where the
//! counts differ, an outline of the model may just have moved across the sample, which is no fault. A corner moves by at most half a step
//! of the grid in x and in y. The eight points of a square around the sample, `RING` steps from it, therefore tell: an outline that can
//! reach the sample runs between them, so that not all of them are covered equally often. Where they are, the sample lies inside a
//! surface, and a crack or a fold is what snapping made there.
//!
//! A wall that is seen from its edge may lie between the points unseen, and it is as thin after snapping as before, somewhere else. So a
//! sample with a piece that no point tells of has no fold, unless snapping has turned that piece over: a fold without a corner on an edge
//! consists of pieces that are turned over and their neighbours.

use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::RasterizeExact as _;
use rasterproof_core::frame::Frame;
use rasterproof_core::geometry::AROUND;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::parallel;
use rasterproof_core::raster::scanline_exact::ScanlineExact;
use rasterproof_core::triangle::Span;
use rasterproof_models::Origin;
use rasterproof_render::effects::render::BadScene;
use rasterproof_render::pipeline::assemble::Cull;
use rasterproof_render::pipeline::target::{Antialias, Target};
use rasterproof_render::scene::Scene;

use crate::corner_grid::CornerGrid;
use crate::face_of;
use crate::shape::Shape;
use crate::ties::{Classes, Surfaces};
use crate::view::{Piece, each_plane, pieces_and_lost};
use crate::winding::{Change, area};

/// How far the points around a sample are from it in x and in y, in steps of the grid: more than half of one, which is how far a corner
/// moves, and no multiple of one, so that edges on the grid seldom run through them.
const RING: f64 = 256.0 / 300.0;

/// A sample inside a surface that snapping broke.
pub(crate) struct BrokenSample<'a> {
    pub sample: [i32; 2],
    /// Whether fewer pieces cover it than before, else more.
    pub is_crack: bool,
    /// Whether nothing lies in front that hides it.
    pub is_seen: bool,
    /// The pieces around it as given for a crack, those that cover it for a fold.
    pub pieces: Vec<&'a Piece>,
}

/// What is known of a sample whose counts differ.
struct Candidate<'a> {
    sample: [i32; 2],
    /// How many pieces cover each point around it as they are given; nothing once doubles could not tell.
    around: Option<[u32; AROUND.len()]>,
    given_here: Vec<&'a Piece>,
    snapped_here: Vec<&'a Piece>,
}

/// Whether a piece is part of the surface as given. What culling would remove if nothing was snapped is drawn, and no part of it.
fn is_given(piece: &Piece, scene: &Scene, grid: CornerGrid) -> bool {
    let is_culled = scene.items[piece.item as usize].cull != Cull::None;
    !is_culled || piece.change(grid) != Change::Over
}

/// Whether a piece is one of these very pieces.
fn is_among(piece: &Piece, pieces: &[&Piece]) -> bool {
    pieces.iter().any(|other| std::ptr::eq(*other, piece))
}

/// The samples of a plane that snapping broke, from the top left. `lost` are the pieces that culling removes only since snapping has
/// turned them over.
pub(crate) fn broken<'a>(
    scene: &Scene,
    surfaces: &Surfaces<'a>,
    lost: &'a [Piece],
    grid: CornerGrid,
) -> Vec<BrokenSample<'a>> {
    let Some(step) = grid.step_px() else { return Vec::new() };
    let ring = RING * step;
    let Surfaces { pieces, window, .. } = *surfaces;
    // First, a count for each sample: by how many pieces more it is covered once they are snapped.
    let mut more = Frame::new(window, 0i32);
    for piece in pieces {
        count_piece(&mut more, piece, grid, Some(is_given(piece, scene, grid)));
    }
    for piece in lost {
        count_piece(&mut more, piece, grid, None);
    }
    // Where it is not 0, an outline has moved across the sample, or a surface is broken.
    let mut candidates = Vec::new();
    for (y, row) in more.rows() {
        for (x, more) in (window.x0..).zip(row) {
            if *more != 0 {
                let (sample, around) = ([x, y], Some([0; AROUND.len()]));
                let (given_here, snapped_here) = (Vec::new(), Vec::new());
                candidates.push(Candidate { sample, around, given_here, snapped_here });
            }
        }
    }
    // Only these few samples are looked at closely: which pieces cover the points around them as given, and which the sample
    // itself once snapped.
    for piece in pieces.iter().filter(|piece| is_given(piece, scene, grid)).chain(lost) {
        for candidate in candidates_near(&mut candidates, piece) {
            look_around(candidate, piece, ring);
        }
    }
    for piece in pieces {
        for candidate in candidates_near(&mut candidates, piece) {
            let [x, y] = candidate.sample;
            let pixel = PixelRect { x0: x, y0: y, x1: x + 1, y1: y + 1 };
            grid.cover(piece.px, pixel, &mut |_| candidate.snapped_here.push(piece));
        }
    }
    let mut broken = Vec::new();
    for Candidate { sample, around, given_here, snapped_here } in candidates {
        let Some(around) = around else { continue };
        let (given, snapped) = (around[0], snapped_here.len() as u32);
        let is_inside = given > 0 && around.iter().all(|count| *count == given);
        let is_crack = snapped < given;
        // Of a fold each piece must be one that the points tell of, or one that is turned over.
        let mut is_known = true;
        for piece in &snapped_here {
            is_known &= piece.change(grid) == Change::Over || is_among(piece, &given_here);
        }
        if !is_inside || snapped == given || !is_crack && !is_known {
            continue;
        }
        // It is seen where one of its pieces is not certainly behind what is nearest there.
        let pieces = if is_crack { given_here } else { snapped_here };
        let mut is_seen = false;
        for piece in &pieces {
            is_seen |= surfaces.before(piece, sample).is_none_or(|[by, off]| by <= off);
        }
        broken.push(BrokenSample { sample, is_crack, is_seen, pieces });
    }
    broken
}

/// Takes 1 from each sample that a piece covers as it is given, and adds 1 to each that it covers once snapped. `is_given` is whether
/// the piece is part of the surface as given, and nothing for one that snapping has lost, which is part of that alone.
fn count_piece(more: &mut Frame<i32>, piece: &Piece, grid: CornerGrid, is_given: Option<bool>) {
    let Some(step) = grid.step_px() else { return };
    let samples = samples_near(piece, RING * step).intersect(&more.bounds());
    let Some(corners) = piece.free().filter(|_| !samples.is_empty()) else { return };
    // Of corners on the grid, which snapping leaves, both counts are the same.
    if is_given == Some(true) && corners.px() == grid.place(piece.px) {
        return;
    }
    if is_given != Some(false) {
        ScanlineExact.cover_exact(&corners, samples, |span| add(more, span, -1));
    }
    if is_given.is_some() {
        grid.cover(piece.px, samples, &mut |span| add(more, span, 1));
    }
}

/// Adds to the counts of the samples of a span.
fn add(counts: &mut Frame<i32>, span: Span, by: i32) {
    for count in counts.span_mut(span.y_px, span.x0_px, span.x1_px) {
        *count += by;
    }
}

/// What snapping breaks in a picture, with the first of each kind. Pixels of cracks and folds are those that are seen; a
/// triangle is told by the number of its face.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct BySnapping {
    pub cracks: u64,
    pub folds: u64,
    pub first_crack: Option<[i32; 2]>,
    pub first_fold: Option<[i32; 2]>,
    /// Parts of triangles in the window that snapping turns over, and those that it flattens.
    pub turned_over: u64,
    pub flattened: u64,
    pub first_turned: Option<u32>,
    /// Places where corners nearly meet, which may be snapped apart.
    pub nearly_meeting: u64,
    pub first_nearly_meeting: Option<u32>,
}

/// The pieces that snapping turns over or flattens.
pub(crate) fn turned<'a>(
    pieces: &'a [Piece],
    lost: &'a [Piece],
    grid: CornerGrid,
) -> impl Iterator<Item = (&'a Piece, Change)> {
    pieces.iter().chain(lost).filter_map(move |piece| match piece.change(grid) {
        Change::None => None,
        change => Some((piece, change)),
    })
}

impl BySnapping {
    /// Adds those of some pieces that snapping turns over or flattens.
    fn count_turned(&mut self, pieces: &[Piece], lost: &[Piece], grid: CornerGrid) {
        for (piece, change) in turned(pieces, lost, grid) {
            let count =
                if change == Change::Flat { &mut self.flattened } else { &mut self.turned_over };
            *count += 1;
            let first = self.first_turned.map_or(piece.face, |first| first.min(piece.face));
            self.first_turned = Some(first);
        }
    }
}

/// What decides the pixels of a scene as a target shows it: which of them snapping breaks, and [`Classes`]. One plane of samples after
/// the other is held.
pub fn look(
    scene: &Scene,
    origins: &[Origin],
    target: &Target,
    grid: CornerGrid,
) -> Result<(Classes, BySnapping), BadScene> {
    // Corners that nearly meet are those of the mesh, whatever is seen of it, so both are looked for at once.
    let (near, looked) = parallel::join(
        || Shape::nearly_meeting(scene, origins),
        || look_at_planes(scene, target, grid),
    );
    let (classes, mut found) = looked?;
    found.nearly_meeting = near.len() as u64;
    // A reader knows faces, not triangles in drawing order.
    let first = near.first().map(|place| place.triangles[0]);
    [found.first_nearly_meeting, found.first_turned] =
        [first, found.first_turned].map(|triangle| Some(face_of(scene, origins, triangle?)));
    Ok((classes, found))
}

/// The same without corners that nearly meet; the first triangle that is turned is its number in drawing order.
fn look_at_planes(
    scene: &Scene,
    target: &Target,
    grid: CornerGrid,
) -> Result<(Classes, BySnapping), BadScene> {
    let scale = target.antialias().scale() as i32;
    let mut classes = Classes::new(target.size());
    // The pixels of folds, then those of cracks.
    let mut pixels = [Vec::new(), Vec::new()];
    let mut found = BySnapping::default();
    let is_antialiased = target.antialias() != Antialias::None;
    each_plane(scene, target, grid, &mut |pieces, lost| {
        let surfaces = Surfaces::of(scene, pieces, target.bounds());
        classes.look(&surfaces, scale);
        for broken in broken(scene, &surfaces, lost, grid) {
            if broken.is_seen {
                let [x, y] = broken.sample.map_array(|at| at.div_euclid(scale));
                pixels[usize::from(broken.is_crack)].push([y, x]);
            }
        }
        if !is_antialiased {
            found.count_turned(pieces, lost, grid);
        }
    })?;
    if is_antialiased {
        // Triangles are counted in pixels, whatever the samples are.
        let (pieces, lost) = pieces_and_lost(scene, target.size(), grid)?;
        found.count_turned(&pieces, &lost, grid);
    }
    // A pixel counts once, however many of its samples are broken; the first one is the leftmost of the upper row.
    for pixels in &mut pixels {
        pixels.sort_unstable();
        pixels.dedup();
    }
    let [folds, cracks] = &pixels;
    (found.cracks, found.first_crack) = (cracks.len() as u64, first_of(cracks));
    (found.folds, found.first_fold) = (folds.len() as u64, first_of(folds));
    Ok((classes.counted(), found))
}

/// The first of pixels whose rows come before their columns.
fn first_of(pixels: &[[i32; 2]]) -> Option<[i32; 2]> {
    let [y, x] = *pixels.first()?;
    Some([x, y])
}

/// The least and the largest coordinate of the corners of a piece, in x (0) or in y (1).
fn extent(piece: &Piece, axis: usize) -> [f64; 2] {
    let [a, b, c] = piece.px.map_array(|corner| corner[axis]);
    [a.min(b).min(c), a.max(b).max(c)]
}

/// The pixels whose samples a piece may cover as it is given or snapped.
fn samples_near(piece: &Piece, ring: f64) -> PixelRect {
    let ([left, right], [top, bottom]) = (extent(piece, 0), extent(piece, 1));
    PixelRect {
        x0: (left - 0.5 - ring).ceil() as i32,
        y0: (top - 0.5 - ring).ceil() as i32,
        x1: (right - 0.5 + ring).floor() as i32 + 1,
        y1: (bottom - 0.5 + ring).floor() as i32 + 1,
    }
}

/// The candidates in or beside the box of a piece.
fn candidates_near<'c, 'a>(
    candidates: &'c mut [Candidate<'a>],
    piece: &Piece,
) -> impl Iterator<Item = &'c mut Candidate<'a>> {
    // A pixel more on both sides is more than snapping and the points around a sample need.
    let ([left, right], [top, bottom]) = (extent(piece, 0), extent(piece, 1));
    let (x0, x1) = (left.floor() as i32 - 1, right.ceil() as i32 + 1);
    let (y0, y1) = (top.floor() as i32 - 1, bottom.ceil() as i32 + 1);
    // They are sorted by row.
    let first = candidates.partition_point(|candidate| candidate.sample[1] < y0);
    let end = candidates.partition_point(|candidate| candidate.sample[1] <= y1);
    let rows = candidates[first..end.max(first)].iter_mut();
    rows.filter(move |candidate| (x0..=x1).contains(&candidate.sample[0]))
}

/// Counts the points around a sample that a piece covers as it is given.
fn look_around<'a>(candidate: &mut Candidate<'a>, piece: &'a Piece, ring: f64) {
    let Some(around) = &mut candidate.around else { return };
    let [a, b, c] = piece.px;
    let sign = area(piece.px).signum();
    if area(piece.px) == 0.0 {
        return;
    }
    // A point lies within where it is on the same side of all three edges.
    let mut is_here = false;
    for (count, by) in around.iter_mut().zip(AROUND) {
        let [x, y] = candidate.sample.map_array(|at| f64::from(at) + 0.5);
        let point = [x + by[0] * ring, y + by[1] * ring];
        let sides = [[a, b, point], [b, c, point], [c, a, point]].map_array(|of| area(of) * sign);
        if sides.iter().any(|side| *side < 0.0) {
            continue;
        }
        if sides.contains(&0.0) {
            // It lies on an edge, or doubles cannot tell: nothing is said of this sample.
            candidate.around = None;
            return;
        }
        *count += 1;
        is_here = true;
    }
    if is_here {
        candidate.given_here.push(piece);
    }
}
