//! A scene's pieces with nothing left out, and what shades them: for what draws frames in a way of
//! its own. Assembled on the threads of the pool that it is called in, in parts of a mesh.

use glam::DVec3;
use rayon::prelude::*;

use super::conditions::attributes;
use super::piece::{BadScene, Piece, Prepared};
use super::plan::{Attributes, ItemPlan, PiecePlan, Pieces};
use super::{Effects, Mode};
use crate::grid::PixelRect;
use crate::pipeline::Counters;
use crate::pipeline::shade::Light;
use crate::pipeline::texture::Texture;
use crate::scene::{Hidden, Scene};

/// What the pieces of an item have in common.
pub struct Skin<'a> {
    /// Everything is multiplied by this.
    pub base: DVec3,
    /// Whether the colours of the corners are.
    pub colours: bool,
    /// The light, where there is one.
    pub light: Option<Light>,
    /// The texture, where there is one.
    pub texture: Option<&'a Texture>,
}

/// A scene in the window.
pub struct Whole<'a> {
    /// One for each item.
    pub skins: Vec<Skin<'a>>,
    /// With the items they are of, in drawing order, in parts of any length.
    pub parts: Vec<Vec<(usize, Piece)>>,
    /// The pixels they are drawn in.
    pub window: PixelRect,
    /// Whether nearer pieces win, or later ones.
    pub depth_test: bool,
}

impl Whole<'_> {
    /// The piece in a part, and the item it is of.
    pub fn at(&self, [part, number]: [u32; 2]) -> &(usize, Piece) {
        &self.parts[part as usize][number as usize]
    }
}

/// Triangles of a part: enough to be worth a task.
const PART: usize = 512;

/// Brings a scene into a window.
///
/// # Errors
/// [`BadScene`].
pub fn assemble(scene: &Scene, window: PixelRect) -> Result<Whole<'_>, BadScene> {
    let mut counters = Counters::default();
    let mut parts: Vec<Vec<(usize, Piece)>> = Vec::new();
    let mut skins = Vec::with_capacity(scene.items.len());
    for (index, item) in scene.items.iter().enumerate() {
        let carries = attributes::carries(scene, item, &Effects::PLANNED);
        let of_pieces = Pieces::Listed(vec![(
            0,
            PiecePlan { interpolates: carries, perspective: true, depth: true },
        )]);
        let (clip, cull) = (Mode::Planned, Mode::Planned);
        let plan = ItemPlan { clip, cull, carries, pieces: of_pieces };
        let prepared = Prepared::new(scene, index, &plan, window, &mut counters)?;
        parts.par_extend(item.mesh.triangles.par_chunks(PART).map(|triangles| {
            let mut pieces = Vec::with_capacity(triangles.len());
            let mut emit = |piece: &Piece, _: &mut Counters| pieces.push((index, *piece));
            prepared.assemble_some(scene, triangles, &mut Counters::default(), &mut emit);
            pieces
        }));
        skins.push(Skin {
            base: item.material.colour,
            colours: carries.has(Attributes::COLOUR),
            light: carries.has(Attributes::NORMAL).then_some(prepared.light),
            texture: prepared.texture,
        });
    }
    let depth_test = scene.hidden == Hidden::DepthBuffer;
    if !depth_test {
        let distance = |piece: &Piece| piece.vertices.iter().map(|v| v.depth).sum::<f64>();
        let mut pieces = parts.concat();
        pieces.sort_by(|(_, a), (_, b)| distance(b).total_cmp(&distance(a)));
        parts = vec![pieces];
    }
    Ok(Whole { skins, parts, window, depth_test })
}
