//! A scene's pieces with nothing left out, and what shades them: for what draws frames in a way of
//! its own.

use glam::DVec3;

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
    /// With the items they are of, in drawing order.
    pub pieces: Vec<(usize, Piece)>,
    /// The pixels they are drawn in.
    pub window: PixelRect,
    /// Whether nearer pieces win, or later ones.
    pub depth_test: bool,
}

/// Brings a scene into a window.
///
/// # Errors
/// [`BadScene`].
pub fn assemble(scene: &Scene, window: PixelRect) -> Result<Whole<'_>, BadScene> {
    let mut counters = Counters::default();
    let mut pieces = Vec::with_capacity(scene.triangles());
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
        prepared.assemble(scene, &mut counters, &mut |piece, _| pieces.push((index, *piece)));
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
        pieces.sort_by(|(_, a), (_, b)| distance(b).total_cmp(&distance(a)));
    }
    Ok(Whole { skins, pieces, window, depth_test })
}
