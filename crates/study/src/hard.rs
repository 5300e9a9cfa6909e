//! The hard cases of a scene in a view: how often, where, and in how many pixels.

use std::num::NonZeroU32;
use std::sync::Arc;

use glam::{DMat4, DVec2, DVec3};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::{DrawLine as _, Rasterize as _};
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::{HALF_PIXEL, PixelRect, SUBPIXEL_BITS, SUBPIXELS, SubpixelPoint};
use rasterproof_core::line::bresenham::Bresenham;
use rasterproof_core::parallel;
use rasterproof_core::raster::scanline::Scanline;
use rasterproof_core::triangle::{LineEnd, PixelPoint, ScreenLine};
use rasterproof_models::Origin;
use rasterproof_registry::engines::Drawer;
use rasterproof_render::effects::Effects;
use rasterproof_render::effects::render::BadScene;
use rasterproof_render::pipeline::ClipVertex;
use rasterproof_render::pipeline::assemble::Viewport;
use rasterproof_render::pipeline::clip::{clip, outcode};
use rasterproof_render::pipeline::depth::DepthFormat;
use rasterproof_render::pipeline::target::{Colour, Target};
use rasterproof_render::scene::{Corner, Item, Material, Mesh, Scene};

use crate::effects::differing;
use crate::face_of;
use crate::shape::{Edge, Gap, SLIVER, Shape};
use crate::shift::{Shift, shift};
use crate::snapping;
use crate::ties::{Class, Classes, Surfaces, TiedPair, blends};
use crate::view::{NOTHING, Piece, Sampled, pieces};
use crate::winding::Change;
use crate::work::Work;

rasterproof_core::named! {
    /// A kind of hard case. Its name is what is counted, in the plural.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
    pub enum Kind {
        NoArea = "triangles without area",
        Sliver = "slivers",
        Concave = "concave faces",
        Duplicate = "duplicate faces",
        Overlap = "coplanar overlaps",
        TJunction = "T-junctions",
        Gap = "gaps between borders",
        Border = "open borders",
        Crowded = "edges of more than two faces",
        OnEdge = "samples on edges",
        Rounding = "pixels decided by rounding",
        Order = "pixels by drawing order",
        WideW = "wide ranges of w",
        SinglePrecision = "positions lost by f32",
        FarTexture = "texture coordinates far out",
        Crack = "cracks by snapping",
        Fold = "folds by snapping",
        Turned = "triangles turned by snapping",
        Near = "corners that nearly meet",
    }
}

impl Kind {
    /// What it means for whoever draws the model, and what is seen of it.
    pub fn about(self) -> &'static str {
        match self {
            Self::NoArea => "corners on one line: not drawn; who divides by the area divides by 0",
            Self::Sliver => {
                "longer than 100 times their height: dotted lines, values off by rounding"
            }
            Self::Concave => "cut around one corner, as many readers do, they cover pixels outside",
            Self::Duplicate => {
                "the corners of an earlier face: the first drawn is seen, or flicker"
            }
            Self::Overlap => {
                "faces in one plane: rounding decides who is seen, hatching and flicker"
            }
            Self::TJunction => {
                "a corner within the edge of another face: these pixels show the background"
            }
            Self::Gap => "seams of other corners on either side: one sees through in these pixels",
            Self::Border => "edges of one face: a hole, or the inside seen from behind",
            Self::Crowded => "no inside and outside there: culling and shadow volumes fail",
            Self::OnEdge => "snapped, the fill rule alone decides: other rules leave holes",
            Self::Rounding => "two surfaces closer than rounding moves them: either may be seen",
            Self::Order => "another order of the faces, another picture",
            Self::WideW => "over 4096 within a triangle: 1/w in f32 may be a visible step off",
            Self::SinglePrecision => "as f32 a corner moves by over 1/256 px: shapes are distorted",
            Self::FarTexture => "as f32 they miss half a texel: textures in blocks",
            Self::Crack => {
                "lost between snapped corners: split a long edge where a corner lies on it"
            }
            Self::Fold => {
                "hit too often once snapped, wrong where it blends: split edges, merge thin triangles"
            }
            Self::Turned => {
                "thinner than a step of the grid, turned over or flattened: culled, or reversed"
            }
            Self::Near => {
                "no one corner for those who compare bits: weld them, or borders are open"
            }
        }
    }

    /// Its place in a set of kinds, which is a number of 32 bits.
    fn bit(self) -> u32 {
        1 << self as u16
    }
}

/// Kinds that are seen wherever a triangle of theirs is.
const OF_TRIANGLES: [Kind; 5] =
    [Kind::Sliver, Kind::Concave, Kind::WideW, Kind::SinglePrecision, Kind::FarTexture];

/// All that a scene has of one kind.
#[derive(Clone, Debug)]
pub struct HardCase {
    pub kind: Kind,
    /// How many there are, seen or not.
    pub count: u64,
    /// How many of them are seen in this view: those that are culled, hidden or outside are not.
    pub in_view: u64,
    /// Pixels of the picture in which they are seen.
    pub pixels: u64,
    /// Something about the worst one.
    pub note: String,
    /// Triangles by their numbers, from 0 in drawing order, worst or first ones first; at most three. They are seen where any
    /// are.
    pub triangles: Vec<u32>,
}

/// The hard cases of a scene, and what else was found on the way.
#[derive(Clone, Debug)]
pub struct HardCases {
    /// Those that occur, in the order of [`Kind::ALL`].
    pub cases: Vec<HardCase>,
    /// For each pixel which kinds are seen there, as bits.
    touched: Frame<u32>,
    pub picture: Frame<Colour>,
    /// How it is decided which surface is seen at each pixel.
    pub classes: Classes,
    /// For each triangle of the scene which kinds it is of, as bits.
    marks: Vec<u32>,
    /// What corners on the grid move of the values that are seen.
    pub shift: Shift,
    /// The smallest and the largest w in the window.
    pub w: Option<[f64; 2]>,
    /// Pixels that change when positions are rounded to f32.
    pub f32_pixels: u64,
    /// Whether the mesh is too large for all overlaps and T-junctions to be looked for.
    pub is_cut_short: bool,
}

impl HardCases {
    /// Those of which some are seen.
    pub fn in_view(&self) -> impl Iterator<Item = &HardCase> {
        self.cases.iter().filter(|case| case.in_view > 0)
    }

    /// What was found of a kind; none where it does not occur.
    #[must_use]
    pub fn of(&self, kind: Kind) -> Option<&HardCase> {
        self.cases.iter().find(|case| case.kind == kind)
    }

    /// Whether a hard case is seen in a pixel.
    #[must_use]
    pub fn touches(&self, x_px: i32, y_px: i32) -> bool {
        self.touched.get(x_px, y_px).unwrap_or(0) != 0
    }

    /// Whether a triangle has a part in a hard case of any kind.
    #[must_use]
    pub fn is_hard(&self, triangle: u32) -> bool {
        self.marks_of(triangle) != 0
    }

    /// Whether a triangle has a part in a hard case of a kind.
    #[must_use]
    pub fn is(&self, triangle: u32, kind: Kind) -> bool {
        self.marks_of(triangle) & kind.bit() != 0
    }

    /// The kinds of a triangle as bits; none beyond the last one.
    fn marks_of(&self, triangle: u32) -> u32 {
        self.marks.get(triangle as usize).copied().unwrap_or(0)
    }
}

/// Where w differs by more than this within a triangle, 1/w in f32 may be off by half a step of 8 bits: the bound is
/// 8 u M times the ratio, with u = 2^-24 and M the largest value.
const WIDE_W: f64 = (1 << 24) as f64 / (8.0 * 512.0);

/// Finds the hard cases of a scene as `target` shows it. It is drawn into `target`.
pub fn find(
    scene: &Scene,
    origins: &[Origin],
    sampled: &Sampled,
    target: &mut Target,
) -> Result<HardCases, BadScene> {
    let pieces = sampled.at_centres();
    let window = target.size();
    let mut surfaces = Vec::with_capacity(sampled.planes.len());
    for pieces in &sampled.planes {
        surfaces.push(Surfaces::of(scene, pieces, sampled.window));
    }
    let mut search = Search {
        scene,
        origins,
        pieces,
        sampled,
        surfaces,
        marks: vec![0; scene.triangles()],
        is_seen: vec![false; scene.triangles()],
        seen_at: Frame::new(window, NOTHING),
        touched: Frame::new(window, 0),
        found: Vec::new(),
    };
    // What the mesh shows wherever it is seen from takes about as long as what this view shows, so both are looked for at once.
    // Edges and faces are noted after that, since they need the shape as well as what is seen.
    let drawn = || {
        // The first step finds out which triangles are seen, which the steps after it use.
        let classes = search.look();
        search.samples_on_edges();
        search.broken();
        search.turned();
        let shift = shift(scene, &search.surfaces, sampled);
        search.wide_w();
        search.far_textures();
        let picture = draw(scene, target)?;
        search.drawing_order(&picture, target)?;
        let f32_pixels = search.single_precision(&picture, target)?;
        Ok((classes, picture, f32_pixels, shift))
    };
    let (shape, drawn) = parallel::join(|| Shape::of(scene, origins), drawn);
    let (classes, picture, f32_pixels, shift) = drawn?;
    search.triangles(&shape, origins);
    search.pairs(&shape, origins);
    search.lines(&shape);
    search.gaps(&shape, target)?;
    // No step touches a pixel after this, so that the pixels of each kind can be counted.
    let Search { marks, mut found, touched, .. } = search;
    for case in &mut found {
        case.pixels = pixels_of(&touched, case.kind);
    }
    found.sort_by_key(|case| case.kind);
    // The least and the largest w of all corners in the window, none where nothing is in it.
    let mut w: Option<[f64; 2]> = None;
    for of_corner in pieces.iter().flat_map(|piece| piece.w) {
        let [least, most] = w.unwrap_or([f64::MAX, 0.0]);
        w = Some([least.min(of_corner), most.max(of_corner)]);
    }
    let is_cut_short = shape.is_cut_short;
    Ok(HardCases {
        cases: found,
        touched,
        picture,
        classes,
        marks,
        shift,
        w,
        f32_pixels,
        is_cut_short,
    })
}

/// In how many pixels a kind is seen.
fn pixels_of(touched: &Frame<u32>, kind: Kind) -> u64 {
    let mut count = 0;
    for (_, row) in touched.rows() {
        for bits in row {
            count += u64::from(bits & kind.bit() != 0);
        }
    }
    count
}

/// Marks a pixel, in which some kinds are seen, given as bits.
fn touch(touched: &mut Frame<u32>, [x, y]: [i32; 2], bits: u32) {
    touched.span_mut(y, x, x + 1)[0] |= bits;
}

/// A picture of a scene, with every effect where the plan finds it necessary.
fn draw(scene: &Scene, target: &mut Target) -> Result<Frame<Colour>, BadScene> {
    Ok(Drawer::Scanline.render(scene, &Effects::PLANNED, target)?.picture)
}

/// The same scene with all triangles in the opposite order.
fn turned(scene: &Scene) -> Scene {
    // Items are drawn in their order, and triangles in that of their mesh.
    let mut turned = scene.clone();
    turned.items.reverse();
    for item in &mut turned.items {
        let mut mesh = Mesh::clone(&item.mesh);
        mesh.triangles.reverse();
        item.mesh = mesh.into();
    }
    turned
}

/// Of pixels, those in which two scenes still have different colours.
fn still_differing(
    pixels: &[(i32, i32)],
    scenes: [&Scene; 2],
    target: &mut Target,
) -> Result<Vec<(i32, i32)>, BadScene> {
    let [a, b] = [draw(scenes[0], target)?, draw(scenes[1], target)?];
    let differs = |&(x, y): &(i32, i32)| a.get(x, y) != b.get(x, y);
    Ok(pixels.iter().copied().filter(differs).collect())
}

/// Samples of what blends up to which a scene is drawn with layers, which are 48 bytes each.
const MOST_BLENDED: u64 = 1 << 22;

/// Layers that are enough for most scenes.
const LAYERS: Option<NonZeroU32> = NonZeroU32::new(64);

/// The search for hard cases on its way.
struct Search<'a> {
    scene: &'a Scene,
    origins: &'a [Origin],
    /// The pieces at the centres of pixels.
    pieces: &'a [Piece],
    sampled: &'a Sampled,
    /// What is seen at the samples of each plane.
    surfaces: Vec<Surfaces<'a>>,
    /// For each triangle which kinds it is of, and for each pixel which are seen there, as bits.
    marks: Vec<u32>,
    /// For each triangle whether it is seen at a sample.
    is_seen: Vec<bool>,
    /// Which triangle is seen in each pixel.
    seen_at: Frame<u32>,
    touched: Frame<u32>,
    found: Vec<HardCase>,
}

/// A hard case on the way: how many were counted, and triangles to show.
struct Noted {
    kind: Kind,
    count: u64,
    in_view: u64,
    /// The first triangles that are not seen, and that are.
    first: [Vec<u32>; 2],
}

impl Noted {
    fn new(kind: Kind) -> Self {
        Self { kind, count: 0, in_view: 0, first: Default::default() }
    }

    /// Adds one with its triangles; the worst or first ones first.
    fn add(&mut self, marks: &mut [u32], triangles: &[u32], in_view: bool) {
        self.count += 1;
        self.in_view += u64::from(in_view);
        let first = &mut self.first[usize::from(in_view)];
        for triangle in triangles {
            marks[*triangle as usize] |= self.kind.bit();
            if first.len() < 3 && !first.contains(triangle) {
                first.push(*triangle);
            }
        }
    }
}

impl Search<'_> {
    /// Adds a kind to those that were found, unless none was counted. The triangles to show are those that are seen, if any are.
    fn note(&mut self, noted: Noted, note: String) {
        let Noted { kind, count, in_view, first: [hidden, seen] } = noted;
        let triangles = if in_view > 0 { seen } else { hidden };
        if count > 0 {
            self.found.push(HardCase { kind, count, in_view, pixels: 0, note, triangles });
        }
    }

    /// Notes triangles, the worst ones first.
    fn note_triangles(&mut self, kind: Kind, all: &mut dyn Iterator<Item = u32>, note: String) {
        let mut noted = Noted::new(kind);
        for triangle in all {
            noted.add(&mut self.marks, &[triangle], self.is_seen[triangle as usize]);
        }
        self.note(noted, note);
    }

    /// Notes triangles with how bad each is, in any order; in `note` that of the worst one takes the place of `{}`.
    fn note_worst(&mut self, kind: Kind, mut found: Vec<(f64, u32)>, note: &str) {
        // The sort is stable: of equally bad ones the first in drawing order stays in front.
        found.sort_by(|a, b| b.0.total_cmp(&a.0));
        let (worst, _) = found.first().copied().unwrap_or_default();
        let all = &mut found.iter().map(|(_, triangle)| *triangle);
        self.note_triangles(kind, all, note.replace("{}", &short(worst)));
    }

    /// Finds out which triangles are seen, and how it is decided.
    fn look(&mut self) -> Classes {
        let mut classes = Classes::new(self.sampled.size);
        let mut noted = Noted::new(Kind::Rounding);
        for (surfaces, pieces) in self.surfaces.iter().zip(&self.sampled.planes) {
            surfaces.seen(&mut |sample, [piece, front], class| {
                let pixel @ [x, y] = self.sampled.pixel(sample);
                // Both may be the same one; the other one of a pair that competes counts as seen, too.
                let [piece, front] = [piece, front].map_array(|one| pieces[one as usize].face);
                classes.add(TiedPair { pixel, triangles: [front, piece] }, class);
                self.is_seen[piece as usize] = true;
                self.seen_at.span_mut(y, x, x + 1)[0] = front;
                if class >= Class::ByRounding {
                    for triangle in [front, piece] {
                        self.marks[triangle as usize] |= Kind::Rounding.bit();
                    }
                    touch(&mut self.touched, pixel, Kind::Rounding.bit());
                }
            });
        }
        let classes = classes.counted();
        if let Some(TiedPair { pixel: [x, y], triangles }) = classes.first {
            // Pixels are counted, and not the pairs that compete in them.
            noted.add(&mut self.marks, &triangles, true);
            (noted.count, noted.in_view) = (classes.by_rounding, classes.by_rounding);
            self.note(noted, format!("the first at {x},{y}"));
        }
        classes
    }

    /// Notes what single triangles and faces are, and marks the pixels in which such triangles are seen.
    fn triangles(&mut self, shape: &Shape, origins: &[Origin]) {
        // What has no area is drawn nowhere.
        let mut noted = Noted::new(Kind::NoArea);
        for triangle in &shape.no_area {
            noted.add(&mut self.marks, &[*triangle], false);
        }
        self.note(noted, String::new());
        let worst = shape.slivers.first().map_or(SLIVER, |(aspect, _)| *aspect);
        let note = format!("the longest one is {} times as long as high", short(worst));
        self.note_triangles(Kind::Sliver, &mut shape.slivers.iter().map(|(_, one)| *one), note);
        // Readers say which triangles of an item a concave face was cut into; here they are numbered in the scene.
        let mut concave = Vec::new();
        let mut first = 0;
        for (item, origin) in self.scene.items.iter().zip(origins) {
            for number in &origin.concave {
                concave.push(first + number);
            }
            first += item.mesh.triangles.len() as u32;
        }
        // The triangles of one face are one case, and stand side by side.
        let mut noted = Noted::new(Kind::Concave);
        let face = |triangle: &u32| shape.face_of[*triangle as usize];
        for of_face in concave.chunk_by(|a, b| face(a) == face(b)) {
            let in_view = of_face.iter().any(|one| self.is_seen[*one as usize]);
            noted.add(&mut self.marks, of_face, in_view);
        }
        self.note(noted, String::new());
        // Nothing of a triangle alone is found after this.
        let bits = OF_TRIANGLES.iter().fold(0, |bits, kind| bits | kind.bit());
        for (surfaces, pieces) in self.surfaces.iter().zip(&self.sampled.planes) {
            surfaces.seen(&mut |sample, [piece, _], _| {
                let marks = self.marks[pieces[piece as usize].face as usize];
                touch(&mut self.touched, self.sampled.pixel(sample), marks & bits);
            });
        }
    }

    /// Notes pairs of faces, which are seen where both compete for a sample.
    fn pairs(&mut self, shape: &Shape, origins: &[Origin]) {
        // First which pairs compete anywhere: by order, by rounding or with equal depths.
        let kinds = [(Kind::Duplicate, &shape.duplicates), (Kind::Overlap, &shape.overlaps)];
        let mut is_seen = kinds.map(|(_, pairs)| vec![false; pairs.len()]);
        for (surfaces, pieces) in self.surfaces.iter().zip(&self.sampled.planes) {
            surfaces.seen(&mut |sample, [piece, front], class| {
                if class < Class::ByOrder {
                    return;
                }
                let face = |piece: u32| shape.face_of[pieces[piece as usize].face as usize];
                // As the shape lists it: the later face first.
                let pair = [face(piece).max(face(front)), face(piece).min(face(front))];
                for ((kind, pairs), is_seen) in kinds.iter().zip(&mut is_seen) {
                    if let Ok(place) = pairs.binary_search(&pair) {
                        is_seen[place] = true;
                        touch(&mut self.touched, self.sampled.pixel(sample), kind.bit());
                    }
                }
            });
        }
        for ((kind, pairs), is_seen) in kinds.into_iter().zip(&is_seen) {
            // Then a note about the first pair that is seen, or about the first one of all.
            let what = if kind == Kind::Duplicate { "has the corners of" } else { "overlaps" };
            let first = is_seen.iter().position(|is| *is).unwrap_or(0);
            let mut note = String::new();
            if let Some([_, other]) = pairs.get(first) {
                note = format!("it {what} face {}", face_of(self.scene, origins, *other));
            }
            let mut noted = Noted::new(kind);
            for (pair, is_seen) in pairs.iter().zip(is_seen) {
                // The earlier one of duplicates is a face as good as any other.
                let of = if kind == Kind::Duplicate { &pair[..1] } else { &pair[..] };
                for face in of {
                    // A face is named by its first triangle, and its others follow.
                    let mut triangle = *face as usize;
                    while shape.face_of.get(triangle) == Some(face) {
                        self.marks[triangle] |= kind.bit();
                        triangle += 1;
                    }
                }
                noted.add(&mut self.marks, of, *is_seen);
            }
            self.note(noted, note);
        }
    }

    /// Notes edges, which are seen where a triangle of theirs is seen beside them.
    fn lines(&mut self, shape: &Shape) {
        let most = shape.crowded.first().map_or(0, |edge| edge.triangles.len());
        let crowded = format!("the most crowded one has {most}");
        let near = format!("at most {:.1e} apart", shape.near_apart);
        // An edge has no pixels of its own, so it is drawn as a line, and seen where one of its triangles is seen beside it.
        let place = Place::new(self.scene, self.sampled.size);
        for (kind, edges, note) in [
            (Kind::TJunction, &shape.t_junctions, String::new()),
            (Kind::Border, &shape.borders, String::new()),
            (Kind::Crowded, &shape.crowded, crowded),
            (Kind::Near, &shape.near, near),
        ] {
            // Of places with two corners or more, the pixels of what lies between edges there are counted.
            let is_a_place = [Kind::TJunction, Kind::Near].contains(&kind);
            let mut noted = Noted::new(kind);
            for edge in edges {
                // An edge outside of the window has no line, and is counted as not seen.
                let mut in_view = false;
                if let Some(line) = place.line(edge) {
                    Bresenham.draw(&line, self.sampled.size, |f| {
                        let pixel = [f.x_px, f.y_px];
                        if is_seen_beside(&self.seen_at, pixel, &edge.triangles) {
                            in_view = true;
                            let bits = if is_a_place { 0 } else { kind.bit() };
                            touch(&mut self.touched, pixel, bits);
                        }
                    });
                }
                noted.add(&mut self.marks, &edge.triangles, in_view);
            }
            self.note(noted, note);
        }
    }

    /// Notes gaps, and marks the pixels of what lies between edges at other hard cases.
    fn gaps(&mut self, shape: &Shape, target: &Target) -> Result<(), BadScene> {
        self.see_through((Kind::TJunction, &shape.at_t_junctions), target)?;
        self.see_through((Kind::Near, &shape.at_near), target)?;
        let in_view = self.see_through((Kind::Gap, &shape.gaps), target)?;
        let mut noted = Noted::new(Kind::Gap);
        for (gap, in_view) in shape.gaps.iter().zip(in_view) {
            noted.add(&mut self.marks, &gap.triangles, in_view);
        }
        self.note(noted, String::new());
        Ok(())
    }

    /// Marks the pixels that closing gaps would cover, and says which gaps have some: each is closed by triangles around its first
    /// corner, and a sample lies within where an odd number of them covers it.
    fn see_through(
        &mut self,
        (kind, gaps): (Kind, &[Gap]),
        target: &Target,
    ) -> Result<Vec<bool>, BadScene> {
        let mut in_view = vec![false; gaps.len()];
        if gaps.is_empty() {
            return Ok(in_view);
        }
        // A scene of the triangles that close all gaps, with the gap of each.
        let corner = |position| Corner {
            position,
            colour: DVec3::ONE,
            normal: DVec3::ZERO,
            uv: DVec2::ZERO,
        };
        let mut positions = Vec::new();
        let (mut triangles, mut of) = (Vec::new(), Vec::new());
        for (number, gap) in gaps.iter().enumerate() {
            let first = positions.len() as u32;
            positions.extend_from_slice(&gap.polygon);
            for last in first + 2..positions.len() as u32 {
                triangles.push([first, last - 1, last].map(corner));
                of.push(number);
            }
        }
        // Seen by the same camera, it has pieces at the same samples as the scene.
        let mesh = Mesh { positions: positions.into(), triangles: triangles.into_iter().collect() };
        let mut closing = self.scene.clone();
        let model = Place::new(self.scene, self.sampled.size).model;
        closing.items = vec![Item { model, ..Item::new(mesh, Material::default()) }];
        let closing = Sampled::of(&closing, target)?;
        // Planes of samples correspond, so what would close a gap is compared with what is seen at the same samples.
        for (surfaces, pieces) in self.surfaces.iter().zip(&closing.planes) {
            let of_piece = |piece: &Piece| of[piece.face as usize];
            for gap in pieces.chunk_by(|a, b| of_piece(a) == of_piece(b)) {
                let mut samples = Vec::new();
                for piece in gap {
                    Scanline.cover(piece.corners(), closing.window, |span| {
                        for x in span.x0_px..span.x1_px {
                            let sample = [x, span.y_px];
                            // Open is where nothing is seen, or only what certainly lies behind.
                            let before = surfaces.before(piece, sample);
                            let is_open = before.is_none_or(|[by, off]| by < -off);
                            samples.push((sample, is_open));
                        }
                    });
                }
                // A sample outside of the polygon is covered by an even number of its triangles.
                samples.sort_unstable();
                for same in samples.chunk_by(|a, b| a.0 == b.0) {
                    if same.len() % 2 == 1 && same.iter().all(|(_, is_open)| *is_open) {
                        in_view[of_piece(&gap[0])] = true;
                        touch(&mut self.touched, self.sampled.pixel(same[0].0), kind.bit());
                    }
                }
            }
        }
        Ok(in_view)
    }

    /// Pixels with a sample on an edge of a piece after snapping; seen where the piece is not hidden.
    fn samples_on_edges(&mut self) {
        // A sample counts once for each edge that it lies on.
        let mut noted = Noted::new(Kind::OnEdge);
        for (surfaces, pieces) in self.surfaces.iter().zip(&self.sampled.planes) {
            for piece in pieces {
                samples_on_boundary(piece.corners(), self.sampled.window, &mut |x, y| {
                    let before = surfaces.before(piece, [x, y]);
                    let is_seen = before.is_none_or(|[by, off]| by <= off);
                    noted.add(&mut self.marks, &[piece.face], is_seen);
                    if is_seen {
                        touch(&mut self.touched, self.sampled.pixel([x, y]), Kind::OnEdge.bit());
                    }
                });
            }
        }
        self.note(noted, String::new());
    }

    /// Cracks and folds that snapping makes, seen where nothing that hides them lies in front.
    fn broken(&mut self) {
        // Of each kind what is counted, and a note about the first one that is seen.
        let mut all = [Kind::Crack, Kind::Fold].map_array(|kind| (Noted::new(kind), String::new()));
        for (surfaces, lost) in self.surfaces.iter().zip(&self.sampled.lost) {
            for broken in snapping::broken(self.scene, surfaces, lost, self.sampled.grid) {
                let (noted, note) = &mut all[usize::from(!broken.is_crack)];
                let faces: Vec<u32> = broken.pieces.iter().map(|piece| piece.face).collect();
                noted.add(&mut self.marks, &faces, broken.is_seen);
                if broken.is_seen {
                    let pixel @ [x, y] = self.sampled.pixel(broken.sample);
                    touch(&mut self.touched, pixel, noted.kind.bit());
                    if note.is_empty() {
                        *note = format!("the first at {x},{y}, of faces {}", self.faces(&faces));
                    }
                }
            }
        }
        for (noted, note) in all {
            self.note(noted, note);
        }
    }

    /// The faces of the first three triangles of a list, by their numbers.
    fn faces(&self, triangles: &[u32]) -> String {
        let mut names = Vec::new();
        for triangle in triangles.iter().take(3) {
            names.push(face_of(self.scene, self.origins, *triangle).to_string());
        }
        names.join(", ")
    }

    /// Triangles that snapping turns over or flattens.
    fn turned(&mut self) {
        // A triangle may be turned without being seen, which is counted apart.
        let mut noted = Noted::new(Kind::Turned);
        // Triangles are counted at pixel centres, whatever samples the picture has.
        let mut flat = 0;
        let (pieces, lost) = (self.sampled.at_centres(), self.sampled.lost_at_centres());
        for (piece, change) in snapping::turned(pieces, lost, self.sampled.grid) {
            flat += u64::from(change == Change::Flat);
            noted.add(&mut self.marks, &[piece.face], self.is_seen[piece.face as usize]);
        }
        let note = format!("{} turned over, {flat} flattened", noted.count - flat);
        self.note(noted, note);
    }

    /// Pieces in which w varies so much that 1/w in single precision may be a visible step off.
    fn wide_w(&mut self) {
        // A part of a triangle that was cut has a range of w of its own.
        let mut wide: Vec<(f64, u32)> = Vec::new();
        for piece in self.pieces {
            let [a, b, c] = piece.w;
            let ratio = a.max(b).max(c) / a.min(b).min(c);
            if ratio > WIDE_W {
                wide.push((ratio, piece.face));
            }
        }
        self.note_worst(Kind::WideW, wide, "the widest one has a ratio of {}");
    }

    /// Triangles of textured materials with a coordinate whose rounding to f32 may be half a texel.
    fn far_textures(&mut self) {
        // Triangles are numbered through all items, textured or not.
        let mut far: Vec<(f64, u32)> = Vec::new();
        let mut face = 0;
        for item in &self.scene.items {
            let Some(texture) = &item.material.texture else {
                face += item.mesh.triangles.len() as u32;
                continue;
            };
            let (width, height) = texture.size();
            for triangle in item.mesh.triangles.iter() {
                let mut largest: f64 = 0.0;
                for corner in &triangle {
                    let [u, v] = corner.uv.abs().to_array();
                    largest = largest.max(u * f64::from(width)).max(v * f64::from(height));
                }
                // From here on, floats of 24 bits are a whole texel apart.
                if largest >= f64::from(1 << 23) {
                    far.push((largest, face));
                }
                face += 1;
            }
        }
        self.note_worst(Kind::FarTexture, far, "the farthest one is {} texels from 0");
    }

    /// Pixels that have another colour when all triangles are drawn in the opposite order, and why: what no longer does with
    /// layers is mixed in another order, and what no longer does with depths in f64 has equal depths in the format alone.
    fn drawing_order(
        &mut self,
        picture: &Frame<Colour>,
        target: &mut Target,
    ) -> Result<(), BadScene> {
        // Where the order does not matter, both pictures have the same colour.
        let mut other = turned(self.scene);
        let turned = draw(&other, target)?;
        let mut pixels: Vec<_> = differing(picture, &turned, 0).collect();
        pixels.sort_unstable();
        if pixels.is_empty() {
            return Ok(());
        }
        // Layers mix what blends by depth: the pixels that no longer differ did so by blending.
        let mut scene = self.scene.clone();
        let mut left = pixels.clone();
        let blended = Work::of(self.scene, self.sampled.window).blended;
        if self.scene.layers.is_none() && blended > 0 {
            for scene in [&mut scene, &mut other] {
                if blended <= MOST_BLENDED {
                    scene.layers = LAYERS;
                } else {
                    // What is opaque alone: the rest differs by what blends.
                    scene.items.retain(|item| !blends(item));
                }
            }
            left = still_differing(&pixels, [&scene, &other], target)?;
        }
        // In f64, depths are equal only where the surfaces are: the others are equal in the format of the target alone.
        let format = std::mem::replace(&mut target.format, DepthFormat::F64);
        let exact = still_differing(&left, [&scene, &other], target);
        target.format = format;
        // What snapping folds is no fault of the model.
        let (mut folds, mut equal) = (0, 0);
        for (x, y) in exact? {
            let bits = self.touched.get(x, y).unwrap_or_default();
            if bits & Kind::Fold.bit() != 0 {
                folds += 1;
            } else {
                equal += 1;
            }
        }
        let in_format =
            format!("by depths that are equal in {}: --depth f64 tells them apart", format.name());
        // Each pixel has one cause: the four counts add up to all pixels.
        let mut causes = Vec::new();
        for (count, why) in [
            (pixels.len() - left.len(), "by blending: --layers mixes by depth"),
            (folds, "where snapping folds a surface: see folds by snapping"),
            (equal, "by equal depths: faces in one place, to be mended in the model"),
            (left.len() - equal - folds, &in_format),
        ] {
            if count > 0 {
                causes.push(format!("{count} px {why}"));
            }
        }
        self.note_order(&pixels, causes.join("; "));
        Ok(())
    }

    /// Notes the pixels that the order of drawing changes, with the triangles that are seen there.
    fn note_order(&mut self, pixels: &[(i32, i32)], note: String) {
        // Of each pixel one triangle is known: the one that the first drawing shows.
        let mut faces = Vec::new();
        for &(x, y) in pixels {
            touch(&mut self.touched, [x, y], Kind::Order.bit());
            faces.extend(self.seen_at.get(x, y).filter(|face| *face != NOTHING));
        }
        faces.sort_unstable();
        faces.dedup();
        let mut noted = Noted::new(Kind::Order);
        for face in faces {
            noted.add(&mut self.marks, &[face], true);
        }
        // Pixels are counted, and not triangles.
        (noted.count, noted.in_view) = (pixels.len() as u64, pixels.len() as u64);
        self.note(noted, note);
    }

    /// Triangles of which a corner moves by more than a subpixel when positions are rounded to f32; returns how many
    /// pixels then change.
    fn single_precision(
        &mut self,
        picture: &Frame<Colour>,
        target: &mut Target,
    ) -> Result<u64, BadScene> {
        // Meshes that f32 holds as they are keep their memory.
        let mut rounded = self.scene.clone();
        let mut is_rounded = false;
        for item in &mut rounded.items {
            let exact = |p: &DVec3| p.as_vec3().as_dvec3() == *p;
            if !item.mesh.positions.iter().all(exact) {
                let mut mesh = Mesh::clone(&item.mesh);
                for position in Arc::make_mut(&mut mesh.positions) {
                    *position = position.as_vec3().as_dvec3();
                }
                item.mesh = mesh.into();
                is_rounded = true;
            }
        }
        if !is_rounded {
            return Ok(0);
        }
        // The pieces of both scenes are in drawing order, so that those of one triangle are found side by side.
        let moved = pieces(&rounded, self.sampled.size)?;
        let mut after = moved.as_slice();
        let mut far: Vec<(f64, u32)> = Vec::new();
        for before in self.pieces.chunk_by(|a, b| a.face == b.face) {
            let face = before[0].face;
            after = &after[after.partition_point(|piece| piece.face < face)..];
            // Cut in another number of pieces, or gone: nothing to measure.
            let now = &after[..after.partition_point(|piece| piece.face == face)];
            if now.len() != before.len() {
                continue;
            }
            // How far any corner moves in x or in y.
            let mut most: f64 = 0.0;
            for (before, now) in before.iter().zip(now) {
                for ([ax, ay], [bx, by]) in before.px.into_iter().zip(now.px) {
                    most = most.max((ax - bx).abs()).max((ay - by).abs());
                }
            }
            if most * f64::from(SUBPIXELS) > 1.0 {
                far.push((most, face));
            }
        }
        self.note_worst(Kind::SinglePrecision, far, "the farthest corner moves by {} px");
        Ok(differing(picture, &draw(&rounded, target)?, 0).count() as u64)
    }
}

/// Where the points of a shape are in the picture.
struct Place {
    /// Moves a point to the world: where items are moved differently, points are there already.
    model: DMat4,
    matrix: DMat4,
    viewport: Viewport,
}

impl Place {
    /// For points as the shape of the scene has them.
    fn new(scene: &Scene, window: PixelRect) -> Self {
        // The shape has points of the world only where items are moved differently.
        let mut models = scene.items.iter().map(|item| item.model);
        let first = models.next().unwrap_or(DMat4::IDENTITY);
        let model = if models.all(|model| model == first) { first } else { DMat4::IDENTITY };
        let matrix = scene.projection * scene.view * model;
        Self { model, matrix, viewport: Viewport::new(window) }
    }

    /// The part of an edge that is in the window.
    fn line(&self, edge: &Edge) -> Option<ScreenLine<f64>> {
        let [a, b] = edge.ends.map_array(|point| ClipVertex {
            position: self.matrix * point.extend(1.0),
            varying: 0.0,
        });
        // Far away, a product of matrices may exceed what a double holds.
        if !a.position.is_finite() || !b.position.is_finite() {
            return None;
        }
        // An edge whose ends both lie outside of one border is not in the window.
        let [outside_a, outside_b] = [outcode(&a), outcode(&b)];
        if outside_a & outside_b != 0 {
            return None;
        }
        // A triangle with two corners in one place is cut as its edge is.
        let (polygon, _) = clip(&[a, b, b], outside_a | outside_b);
        // Its vertices lie on one line, so the first and the last pixel by x, then y, are its ends.
        let mut ends: Option<[[i32; 2]; 2]> = None;
        for vertex in polygon.vertices() {
            let Ok(at) = self.viewport.place(vertex) else { continue };
            let pixel = [at.position.x, at.position.y].map_array(|sub| sub.div_euclid(SUBPIXELS));
            let [least, most] = ends.unwrap_or([pixel; 2]);
            ends = Some([least.min(pixel), most.max(pixel)]);
        }
        let ends = ends?.map_array(|[x, y]| LineEnd {
            pixel: PixelPoint::new(x, y),
            depth: 0.0,
            varying: 0.0,
        });
        Some(ScreenLine { ends })
    }
}

/// Whether one of some triangles is seen in a pixel or in one of the eight around it.
fn is_seen_beside(seen_at: &Frame<u32>, [x, y]: [i32; 2], triangles: &[u32]) -> bool {
    for dy in -1..=1 {
        for dx in -1..=1 {
            if seen_at.get(x + dx, y + dy).is_some_and(|seen| triangles.contains(&seen)) {
                return true;
            }
        }
    }
    false
}

/// The centre of a pixel in subpixels.
fn centre(px: i32) -> i64 {
    i64::from(px) * i64::from(SUBPIXELS) + i64::from(HALF_PIXEL)
}

/// The pixels from `first` to `last`, in subpixels, whose centres lie between these, both included, within a range.
fn centres_between(first: i64, last: i64, [low, high]: [i32; 2]) -> impl Iterator<Item = i32> {
    let [first_px, last_px] = [first, last].map_array(|sub| (sub >> SUBPIXEL_BITS) as i32);
    let pixels = first_px.max(low)..=last_px.min(high - 1);
    pixels.filter(move |px| (first..=last).contains(&centre(*px)))
}

/// Calls `emit` with each pixel whose centre lies on an edge; once for each edge.
fn samples_on_boundary(
    corners: [SubpixelPoint; 3],
    window: PixelRect,
    emit: &mut dyn FnMut(i32, i32),
) {
    let columns = [window.x0, window.x1];
    for (i, j) in [(0, 1), (1, 2), (2, 0)] {
        let [ax, ay, bx, by] =
            [corners[i].x, corners[i].y, corners[j].x, corners[j].y].map(i64::from);
        for y_px in centres_between(ay.min(by), ay.max(by), [window.y0, window.y1]) {
            // A level edge runs through all centres between its ends.
            if ay == by {
                for x_px in centres_between(ax.min(bx), ax.max(bx), columns) {
                    emit(x_px, y_px);
                }
                continue;
            }
            // Any other edge crosses the row once, and hits a centre only where that is at a whole subpixel.
            let across = i128::from(centre(y_px) - ay) * i128::from(bx - ax);
            let dy = i128::from(by - ay);
            if across % dy == 0 {
                let x = ax + (across / dy) as i64;
                for x_px in centres_between(x, x, columns) {
                    emit(x_px, y_px);
                }
            }
        }
    }
}

/// A number with three digits.
fn short(value: f64) -> String {
    match value {
        v if v >= 100_000.0 => format!("{v:.1e}"),
        v if v >= 100.0 => format!("{v:.0}"),
        v if v >= 1.0 => format!("{v:.1}"),
        v => format!("{v:.3}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;
    use rasterproof_render::pipeline::depth::DepthFormat;
    use rasterproof_render::pipeline::target::Antialias;
    use rasterproof_render::pipeline::texture::Texture;
    use rasterproof_render::pipeline::transform::perspective;
    use rasterproof_render::scene::{Corner, Item, Material};

    fn triangle(corners: [[f64; 3]; 3], uv: f64) -> Item {
        let positions = Arc::new(corners.map(DVec3::from_array).to_vec());
        let corner = |position: u32| Corner {
            position,
            colour: DVec3::ONE,
            normal: DVec3::Z,
            uv: DVec2::splat(uv * f64::from(position)),
        };
        let texture = Texture::new(2, 2, &[[255, 0, 0], [0, 255, 0], [0, 0, 255], [0; 3]]);
        let material = Material { texture: texture.map(Into::into), ..Material::default() };
        let triangles = [[corner(0), corner(1), corner(2)]].into_iter().collect();
        let mesh = Mesh { positions, triangles };
        Item::new(mesh, material)
    }

    fn found(items: Vec<Item>) -> HardCases {
        let mut scene = Scene::new("test", "", perspective(1.0, 1.0, 1e-5, 1e6).unwrap());
        scene.items = items;
        let mut target = Target::new(64, 64, Antialias::None, DepthFormat::Unorm32).unwrap();
        let sampled = Sampled::of(&scene, &target).unwrap();
        find(&scene, &[], &sampled, &mut target).unwrap()
    }

    fn kinds(items: Vec<Item>) -> (Vec<(Kind, Vec<u32>)>, HardCases) {
        let found = found(items);
        let kinds = found.cases.iter().map(|case| (case.kind, case.triangles.clone()));
        (kinds.filter(|(kind, _)| *kind != Kind::Border).collect(), found)
    }

    #[test]
    fn a_w_range_of_a_milliard_is_found() {
        let near = triangle([[-0.3, -0.4, 1.0], [0.35, -0.4, 1.0], [0.1, 0.45, 2.0]], 1.0);
        assert_eq!(kinds(vec![near.clone()]).0, []);
        let (found, all) = kinds(vec![
            near,
            triangle([[0.0, -1e-4, 2e-4], [5e4, -1e4, 2e5], [-5e4, -1e4, 2e5]], 1.0),
        ]);
        assert_eq!(found, [(Kind::WideW, vec![1])]);
        let [least, most] = all.w.unwrap();
        assert!(most / least >= 0.99e9, "{least} {most}");
    }

    /// A closed mesh whose one corner is a milliard times as near as the others: the three faces there are found, and
    /// nothing else is.
    #[test]
    fn a_w_range_of_a_milliard_in_a_clean_mesh_is_found() {
        let positions =
            [[0.0, -1e-4, 2e-4], [5e4, -1e4, 2e5], [-5e4, -1e4, 2e5], [0.0, -4e4, 2.5e5]];
        let of = |nearest: [f64; 3]| {
            let mut item = triangle([nearest, positions[1], positions[2]], 1.0);
            let mut mesh = Mesh::clone(&item.mesh);
            Arc::make_mut(&mut mesh.positions).push(DVec3::from_array(positions[3]));
            let face = |corners: [u32; 3]| {
                corners.map(|position| Corner { position, ..mesh.triangles.at(0)[0] })
            };
            let faces = [[1, 3, 2], [0, 1, 2], [0, 3, 1], [0, 2, 3]].map(face);
            mesh.triangles = faces.into_iter().collect();
            item.mesh = mesh.into();
            found(vec![item])
        };
        assert!(of([0.0, -1e-4, 1e5]).cases.is_empty());
        let found = of(positions[0]);
        let kinds: Vec<_> = found.cases.iter().map(|case| (case.kind, case.count)).collect();
        assert_eq!(kinds, [(Kind::WideW, 3)]);
        assert!(!found.is_hard(0) && [1, 2, 3].iter().all(|face| found.is(*face, Kind::WideW)));
        let [least, most] = found.w.unwrap();
        assert!(most / least >= 1e9, "{least} {most}");
    }

    #[test]
    fn texture_coordinates_that_f32_cannot_hold_are_found() {
        let corners = [[-0.3, -0.4, 1.0], [0.35, -0.4, 1.0], [0.1, 0.45, 2.0]];
        assert_eq!(kinds(vec![triangle(corners, 1e6)]).0, []);
        assert_eq!(kinds(vec![triangle(corners, 1e7)]).0, [(Kind::FarTexture, vec![0])]);
    }

    /// The same as the count of the oracle, but for corners, which lie on two edges.
    #[test]
    fn samples_on_edges_are_those_of_the_oracle() {
        let p = |x: i32, y: i32| SubpixelPoint::new(x * 64, y * 64);
        let window = PixelRect::window(32, 32);
        for (corners, corners_on) in [
            ([p(2, 2), p(42, 2), p(2, 42)], 3),
            ([p(1, 2), p(41, 22), p(11, 62)], 0),
            ([p(-6, -6), p(154, 26), p(14, 94)], 1),
        ] {
            let mut count = 0;
            samples_on_boundary(corners, window, &mut |_, _| count += 1);
            let inside =
                corners.iter().filter(|c| window.contains(c.x >> 8, c.y >> 8)).count() as u64;
            assert!(corners_on <= inside);
            let expected =
                rasterproof_verify::oracle::coverage::samples_on_boundary(&corners, window);
            assert_eq!(count - corners_on, expected, "{corners:?}");
        }
    }
}
