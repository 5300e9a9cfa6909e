//! Frames by retrofire, whose rows go down and whose depths are reciprocals.

use glam::{Mat4, Vec3};
use rasterproof_core::frame::Frame;
use rasterproof_render::pipeline::target::Colour;
use retrofire_core::geom::{Tri, Vertex, vertex};
use retrofire_core::math::color::rgba;
use retrofire_core::math::mat::viewport;
use retrofire_core::math::vec::ProjVec3;
use retrofire_core::math::{Vec2, Vec3 as Normal, pt2, vec2, vec3};
use retrofire_core::render::{Colorbuf, Context, Frag, Framebuf, render, shader};
use retrofire_core::util::{Buf2, Dims, pixfmt::Xrgb8888};

use crate::mesh::{Mesh, unpack};

pub struct Retrofire<'a> {
    mesh: &'a Mesh,
    triangles: Vec<Tri<usize>>,
    vertices: Vec<crate::mesh::Vertex>,
    target: Framebuf<Colorbuf<Buf2<u32>, Xrgb8888>, Buf2<f32>>,
    side_px: u32,
}

impl<'a> Retrofire<'a> {
    pub fn new(mesh: &'a Mesh, side_px: u32) -> Self {
        let size = Dims(side_px, side_px);
        let index = |index: &u32| *index as usize;
        let corners = mesh.indices.chunks(3);
        Self {
            mesh,
            triangles: corners.map(|all| Tri([0, 1, 2].map(|i| index(&all[i])))).collect(),
            vertices: mesh.vertices.clone(),
            target: Framebuf {
                color_buf: Colorbuf::new(Buf2::new(size)),
                depth_buf: Buf2::new(size),
            },
            side_px,
        }
    }

    pub fn draw(&mut self, picture: &mut Frame<Colour>) {
        let Self { mesh, triangles, vertices, target, side_px } = self;
        let [r, g, b, _] = mesh.background;
        target.color_buf.buf.data_mut().fill(u32::from_be_bytes([0, r, g, b]));
        target.depth_buf.data_mut().fill(0.0);
        let matrix = Mat4::from_scale(Vec3::new(1.0, -1.0, 1.0)) * mesh.matrix;
        let shader = shader::new(
            |v: crate::mesh::Vertex, mesh: &Mesh| -> Vertex<ProjVec3, (Normal, Vec2)> {
                let _ = mesh;
                let clip = matrix * v.position.extend(1.0);
                let normal: Normal = vec3(v.normal.x, v.normal.y, v.normal.z);
                vertex(ProjVec3::new(clip.to_array()), (normal, vec2(v.uv[0], v.uv[1])))
            },
            |frag: Frag<(Normal, Vec2)>, mesh: &Mesh| {
                let (normal, uv) = frag.var;
                let [r, g, b, a] = mesh.shade(Vec3::from(normal.0), uv.0);
                rgba(r, g, b, a)
            },
        );
        let context =
            Context { color_clear: None, depth_clear: None, face_cull: None, ..Context::default() };
        let to_screen = viewport(pt2(0, 0)..pt2(*side_px, *side_px));
        render(triangles, vertices, &shader, *mesh, to_screen, target, &context);
        unpack(target.color_buf.buf.data(), picture);
        // Its pixels are 0x00RRGGBB.
        for y in 0..*side_px as i32 {
            for pixel in picture.row_mut(y) {
                *pixel = [pixel[2], pixel[1], pixel[0], 255];
            }
        }
    }
}
