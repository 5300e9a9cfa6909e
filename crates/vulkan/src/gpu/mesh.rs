//! A scene of one textured mesh as a device draws it: frames for a clock, and to look at.

use std::collections::HashMap;

use glam::{DMat3, DMat4, DVec4};

use crate::device::Error;
use crate::device::draw::Painter;
use crate::device::find::Listed;
use crate::device::mesh::{Corner, Surface, TexturedMesh};
use crate::device::open::Opened;
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::PixelRect;
use rasterproof_render::pipeline::target::Colour;
use rasterproof_render::scene::{Item, Scene, Shading};
use rasterproof_tiles::frames::Samples;

/// A scene on a device, with everything in buffers.
pub struct Filmed {
    // Before the painter that made it.
    mesh: TexturedMesh,
    painter: Painter,
    side_px: u32,
}

impl Filmed {
    /// Puts a scene on a device, for a square picture.
    ///
    /// # Errors
    /// It is not one mesh with a texture of the nearest texel, lit at each fragment; or what the device says.
    pub fn new(
        listed: &Listed,
        scene: &Scene,
        side_px: u32,
        samples: Samples,
    ) -> Result<Self, Error> {
        let mut painter = Painter::new(&Opened::new(listed)?, None)?;
        let mesh = painter.prepare_mesh(&surface(scene)?, side_px, samples == Samples::Four)?;
        Ok(Self { mesh, painter, side_px })
    }

    /// Submits a frame and waits until it is drawn.
    pub fn draw(&mut self) -> Result<(), Error> {
        self.painter.draw_mesh(&self.mesh)
    }

    /// Draws a frame and reads it back.
    pub fn picture(&mut self) -> Result<Frame<Colour>, Error> {
        self.draw()?;
        let (pixels, _) = self.painter.read_mesh(&mut self.mesh)?.as_chunks::<4>();
        let mut picture = Frame::new(PixelRect::window(self.side_px, self.side_px), [0; 4]);
        for (y, row) in (0..).zip(pixels.chunks_exact(self.side_px as usize)) {
            picture.row_mut(y).copy_from_slice(row);
        }
        Ok(picture)
    }
}

/// The mesh of a scene with its texture, light and matrix, rounded to f32.
fn surface(scene: &Scene) -> Result<Surface, Error> {
    let wrong = |what: &str| Error::Unsupported(format!("{}: {what}", scene.name));
    let [item] = &scene.items[..] else { return Err(wrong("more or less than one mesh")) };
    let texture = item.material.texture.as_deref().ok_or_else(|| wrong("no texture"))?;
    let texels = texture.nearest_bytes().ok_or_else(|| wrong("not a simple texture"))?;
    if item.material.shading != Shading::Phong || item.material.vertex_colours || scene.affine {
        return Err(wrong("not lit at each fragment alone"));
    }
    let has_highlights = item.material.specular.colour.max_element() > 0.0;
    let is_opaque = item.material.opacity.is_none();
    if has_highlights
        || texture.has_mip_map()
        || texture.anisotropy > 1
        || scene.fog.is_some()
        || !is_opaque
    {
        let what = "highlights, a mip map, fog or holes, which the shaders of this device lack";
        return Err(wrong(what));
    }
    let (columns, rows) = texture.size();
    let (corners, indices) = corners(item);
    // Ours has y upwards and z from -w to w, Vulkan's y downwards and z from 0 to w.
    let to_vulkan = DMat4::from_cols(
        DVec4::X,
        -DVec4::Y,
        DVec4::new(0.0, 0.0, 0.5, 0.0),
        DVec4::new(0.0, 0.0, 0.5, 1.0),
    );
    let light = (scene.light.towards * scene.light.diffuse).extend(scene.light.ambient);
    Ok(Surface {
        corners,
        indices,
        texture_px: [columns, rows],
        texels: texels.iter().map(|texel| texel.to_le_bytes()).collect(),
        matrix: (to_vulkan * scene.projection * scene.view * item.model).as_mat4().to_cols_array(),
        light: light.as_vec4().to_array(),
        background: scene.background,
    })
}

/// The corners of a mesh, each once, and the triangles between them.
fn corners(item: &Item) -> (Vec<Corner>, Vec<u32>) {
    let normals = DMat3::from_mat4(item.model).inverse().transpose();
    let (mut corners, mut numbers) = (Vec::new(), HashMap::new());
    let indices = item.mesh.triangles.corners().map(|corner| {
        let words = corner.normal.to_array().map(f64::to_bits);
        let key = (corner.position, words, corner.uv.to_array().map(f64::to_bits));
        *numbers.entry(key).or_insert_with(|| {
            let position = item.mesh.positions[corner.position as usize];
            corners.push(Corner {
                position: position.as_vec3().to_array(),
                normal: (normals * corner.normal).as_vec3().to_array(),
                uv: corner.uv.as_vec2().to_array(),
            });
            corners.len() as u32 - 1
        })
    });
    let indices = indices.collect();
    (corners, indices)
}
