//! The meshes as peers take them: corners in f32, with normals in the world.

use std::collections::HashMap;
use std::io::Write as _;
use std::path::Path;

use glam::{DMat3, DVec2, Mat4, Vec3};
use rasterproof_core::frame::Frame;
use rasterproof_render::pipeline::target::Colour;
use rasterproof_render::scene::Scene;

/// Columns and rows of the meshes' texture: a power of two.
pub const SIDE_TEXELS: i32 = 8;

#[derive(Clone, Copy)]
pub struct Vertex {
    pub position: Vec3,
    pub normal: Vec3,
    pub uv: [f32; 2],
}

impl Vertex {
    fn numbers(&self) -> [f32; 8] {
        let ([x, y, z], [nx, ny, nz]) = (self.position.to_array(), self.normal.to_array());
        [x, y, z, nx, ny, nz, self.uv[0], self.uv[1]]
    }
}

pub struct Mesh {
    pub vertices: Vec<Vertex>,
    pub indices: Vec<u32>,
    pub matrix: Mat4,
    pub towards: Vec3,
    pub ambient: f32,
    pub diffuse: f32,
    /// Texels in [0, 1], row by row from the top.
    pub texels: Vec<Vec3>,
    pub background: Colour,
}

impl Mesh {
    /// A scene of one mesh, textured and lit.
    pub fn new(scene: &Scene) -> Self {
        let item = &scene.items[0];
        let normals = DMat3::from_mat4(item.model).inverse().transpose();
        let (mut vertices, mut numbers) = (Vec::new(), HashMap::new());
        let corners = item.mesh.triangles.corners();
        let indices = corners.map(|corner| {
            let vertex = Vertex {
                position: item.mesh.positions[corner.position as usize].as_vec3(),
                normal: (normals * corner.normal).as_vec3(),
                uv: corner.uv.as_vec2().to_array(),
            };
            *numbers.entry(vertex.numbers().map(f32::to_bits)).or_insert_with(|| {
                vertices.push(vertex);
                vertices.len() as u32 - 1
            })
        });
        let indices = indices.collect();
        let texture = item.material.texture.as_deref().expect("meshes are textured");
        let centre = |texel: i32| f64::from(2 * texel + 1) / f64::from(2 * SIDE_TEXELS);
        let all =
            (0..SIDE_TEXELS).flat_map(|row| (0..SIDE_TEXELS).map(move |column| (column, row)));
        let texels = all.map(|(column, row)| {
            texture.at(DVec2::new(centre(column), 1.0 - centre(row))).as_vec3()
        });
        Self {
            vertices,
            indices,
            matrix: (scene.projection * scene.view * item.model).as_mat4(),
            towards: scene.light.towards.as_vec3(),
            ambient: scene.light.ambient as f32,
            diffuse: scene.light.diffuse as f32,
            texels: texels.collect(),
            background: scene.background,
        }
    }

    /// The corners one by one, for peers that share no vertices.
    pub fn corners(&self) -> Vec<Vertex> {
        self.indices.iter().map(|&index| self.vertices[index as usize]).collect()
    }

    /// The colour of a fragment, by the texel that contains its coordinates and the light on its normal.
    #[inline(always)]
    pub fn shade(&self, normal: Vec3, [u, v]: [f32; 2]) -> [u8; 4] {
        let at =
            |coordinate: f32| (coordinate * SIDE_TEXELS as f32).floor() as i32 & (SIDE_TEXELS - 1);
        let texel = self.texels[(at(1.0 - v) * SIDE_TEXELS + at(u)) as usize];
        let light = normal.normalize_or_zero().dot(self.towards).max(0.0);
        let colour = texel * (self.ambient + self.diffuse * light) * 255.0 + 0.5;
        [colour.x as u8, colour.y as u8, colour.z as u8, 255]
    }

    /// Writes the file that `gles.c` reads.
    pub fn write(&self, path: &Path) -> std::io::Result<()> {
        let mut bytes = Vec::new();
        let mut put = |numbers: &[f32]| bytes.extend(numbers.iter().flat_map(|n| n.to_le_bytes()));
        put(&self.matrix.to_cols_array());
        put(&self.towards.to_array());
        put(&[self.ambient, self.diffuse]);
        put(&self.background.map(|byte| f32::from(byte) / 255.0));
        for count in [SIDE_TEXELS as usize, self.vertices.len(), self.indices.len()] {
            bytes.extend((count as u32).to_le_bytes());
        }
        for texel in &self.texels {
            bytes.extend((*texel * 255.0 + 0.5).to_array().map(|c| c as u8));
            bytes.push(255);
        }
        for vertex in &self.vertices {
            bytes.extend(vertex.numbers().iter().flat_map(|n| n.to_le_bytes()));
        }
        bytes.extend(self.indices.iter().flat_map(|index| index.to_le_bytes()));
        std::fs::File::create(path)?.write_all(&bytes)
    }
}

/// Pixels that are background in one picture alone, and others of another colour.
pub fn wrong(picture: &Frame<Colour>, truth: &Frame<Colour>, background: Colour) -> [u64; 2] {
    let (mut uncovered, mut other) = (0, 0);
    for ((_, row), (_, truth)) in picture.rows().zip(truth.rows()) {
        for (a, b) in row.iter().zip(truth) {
            let far = (0..3).any(|i| a[i].abs_diff(b[i]) > 2);
            if (*a == background) != (*b == background) {
                uncovered += 1;
            } else if far {
                other += 1;
            }
        }
    }
    [uncovered, other]
}

/// Copies packed pixels into a picture.
pub fn unpack(pixels: &[u32], picture: &mut Frame<Colour>) {
    let side = picture.bounds().width() as usize;
    for (y, row) in (0..).zip(pixels.chunks(side)) {
        for (pixel, colour) in picture.row_mut(y).iter_mut().zip(row) {
            *pixel = colour.to_le_bytes();
        }
    }
}
