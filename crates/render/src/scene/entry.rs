//! A scene that has a name, and what many of them are made of.

use glam::{DMat4, DVec3};

use super::{Item, Scene};
use crate::pipeline::shade::Light;
use crate::pipeline::transform::about;

#[derive(Clone, Copy, Debug)]
pub struct Entry {
    pub name: &'static str,
    /// What it shows, with the book's section.
    pub about: &'static str,
    /// Makes it for a picture of width / height, turned by a share of a full turn.
    pub(super) build: fn(Scene, f64) -> Scene,
}

pub(super) const fn entry(
    name: &'static str,
    about: &'static str,
    build: fn(Scene, f64) -> Scene,
) -> Entry {
    Entry { name, about, build }
}

pub(super) fn with(mut scene: Scene, items: impl IntoIterator<Item = Item>) -> Scene {
    scene.items.extend(items);
    scene
}

pub(super) fn turned(item: Item, centre: DVec3, turn: DMat4) -> Item {
    Item { model: about(centre, turn) * item.model, ..item }
}

pub(super) const AHEAD: DVec3 = DVec3::new(0.0, 0.0, 4.0);

/// From behind the eye, above and to the left.
pub(super) fn daylight() -> Light {
    Light { towards: DVec3::new(-0.5, 0.7, -0.6).normalize(), ambient: 0.45, diffuse: 0.55 }
}
