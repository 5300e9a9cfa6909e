//! A scene in a view, taken apart.

use std::error::Error;

use rasterproof_core::contract::Rasterize as _;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::raster::scanline::Scanline;
use rasterproof_models::Origin;
use rasterproof_render::pipeline::target::Target;
use rasterproof_render::scene::{Hidden, Scene};
use rasterproof_report::words::count;

use super::Places;
use crate::corner_grid::CornerGrid;
use crate::hard::{self, HardCases, Kind};
use crate::view::{Piece, Sampled};
use crate::{faces, triangle_of};

/// The pieces that a scene has in the window, and the hard cases among them.
pub struct Studied<'a> {
    pub scene: Scene,
    pub origins: &'a [Origin],
    pub sampled: Sampled,
    pub hard: HardCases,
}

impl<'a> Studied<'a> {
    /// Takes a scene apart and finds its hard cases, which need depths: what is drawn from back to front is refused.
    pub fn new(
        scene: Scene,
        origins: &'a [Origin],
        target: &mut Target,
        grid: CornerGrid,
    ) -> Result<Self, Box<dyn Error + Send + Sync>> {
        if scene.hidden == Hidden::Painter {
            return Err(
                "this scene is drawn from back to front, without a depth buffer: study another one"
                    .into(),
            );
        }
        let sampled = Sampled::on(&scene, target, grid)?;
        let hard = hard::find(&scene, origins, &sampled, target)?;
        Ok(Self { scene, origins, sampled, hard })
    }

    /// The scene for a report, whose triangles `inspect` makes a command for.
    pub fn subject<'s>(&'s self, inspect: &'s dyn Fn(u32) -> String) -> Places<'s> {
        Places { scene: &self.scene, origins: self.origins, inspect }
    }

    /// The first triangle of a face, a line for whatever is known of it, and its pieces in the window; nothing where
    /// no such face is drawn.
    pub fn face(&self, number: u32) -> Option<(u32, Vec<String>, Vec<&Piece>)> {
        let Self { scene, origins, sampled, hard } = self;
        // A face with more than three corners was read as several triangles.
        let mut triangles: Vec<u32> = Vec::new();
        for (triangle, face) in (0..).zip(faces(scene, origins)) {
            if face == number {
                triangles.push(triangle);
            }
        }
        let first = *triangles.first()?;
        // A line for each of its triangles, whose corners have all of their digits.
        let mut known = Vec::new();
        for (item, number) in triangles.iter().filter_map(|&one| triangle_of(scene, one)) {
            let mesh = &scene.items[item].mesh;
            let corners = mesh.triangles.positions()[number].map(|position| {
                // Scenes are left-handed, models are not.
                let [x, y, z] = mesh.positions[position as usize].to_array();
                format!("({x:?}, {y:?}, {:?})", -z)
            });
            known.push(format!("triangle, y up: {}", corners.join(" ")));
        }
        // A kind is one of the face where it is one of any of its triangles.
        let mut kinds = Vec::new();
        for kind in Kind::ALL {
            if triangles.iter().any(|&one| hard.is(one, kind)) {
                kinds.push(kind.name());
            }
        }
        let kinds = if kinds.is_empty() { "none".to_owned() } else { kinds.join(", ") };
        known.push(format!("hard cases that it has a part in: {kinds}"));
        // Of several samples in a pixel the piece at its centre is told.
        let mut pieces: Vec<&Piece> = Vec::new();
        for piece in sampled.at_centres() {
            if triangles.binary_search(&piece.face).is_ok() {
                pieces.push(piece);
            }
        }
        if !pieces.is_empty() {
            let count = count(pieces.len() as u64, "piece", "pieces");
            known.push(format!("in the window: {count}"));
        }
        Some((first, known, pieces))
    }

    /// How much of the scene is in the window, and whether there is anything to compare.
    pub fn head(&self) -> String {
        // Triangles are those of the scene, pieces those of them that the window shows.
        let Self { scene, sampled, .. } = self;
        let triangles = count(scene.triangles() as u64, "triangle", "triangles");
        let pieces = count(sampled.at_centres().len() as u64, "piece", "pieces");
        let none = match sampled.all().any(|piece| has_pixel(piece, sampled.window)) {
            true => "",
            false => {
                "\nNOT COMPARED: none of them has a pixel, so nothing was compared in what follows"
            }
        };
        format!("{}: {triangles}, {pieces} in the window{none}", scene.name)
    }
}

/// Whether a piece covers the centre of a pixel.
pub fn has_pixel(piece: &Piece, window: PixelRect) -> bool {
    let mut has_one = false;
    Scanline.cover(piece.corners(), window, |_| has_one = true);
    has_one
}
