//! The pixels of a piece in a tile: depth test, attributes and colour, sixteen at a time.
//!
//! Sums and products are written out and never fused, so that every instruction set rounds alike.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16, mask32x16, u32x16};
use glam::DVec2;

use super::buffer::Buffer;
use super::planes::{Plane, Planes};
use crate::effects::whole::Skin;
use crate::pipeline::shade::Light;
use crate::tile::{Piece, SIDE_PX};

type Lanes<S> = f32x16<S>;

const COUNT: [f32; 16] = [0., 1., 2., 3., 4., 5., 6., 7., 8., 9., 10., 11., 12., 13., 14., 15.];

/// Draws what is covered.
#[inline(always)]
pub(super) fn piece<S: Simd>(
    simd: S,
    covered: &Piece,
    skin: &Skin<'_>,
    planes: &Planes<8>,
    depth_test: bool,
    buffer: &mut Buffer,
) {
    let brush = Brush { skin, planes, depth_test };
    match covered {
        Piece::Tile(tile) => {
            for (y_px, &mask) in (tile.y_px..).zip(&tile.rows) {
                if mask != 0 {
                    brush.row(simd, tile.x_px, y_px, mask, buffer);
                }
            }
        }
        Piece::Block(block) => {
            let rect = block.rect;
            for y_px in rect.y0..rect.y1 {
                let first = rect.x0 & !(SIDE_PX - 1);
                for x_px in (first..rect.x1).step_by(SIDE_PX as usize) {
                    let from = (rect.x0 - x_px).max(0);
                    let to = (rect.x1 - x_px).min(SIDE_PX);
                    let mask = ((1u32 << to) - (1 << from)) as u16;
                    brush.row(simd, x_px, y_px, mask, buffer);
                }
            }
        }
    }
}

struct Brush<'a> {
    skin: &'a Skin<'a>,
    planes: &'a Planes<8>,
    depth_test: bool,
}

impl Brush<'_> {
    /// Sixteen pixels of a row, those of `mask`.
    #[inline(always)]
    fn row<S: Simd>(&self, simd: S, x_px: i32, y_px: i32, mask: u16, buffer: &mut Buffer) {
        let [x0, y0] = self.planes.first_px;
        let x = Lanes::load_array_ref(simd, &COUNT) + (x_px - x0) as f32;
        let y = (y_px - y0) as f32;
        let at = buffer.at(x_px, y_px);
        let mut visible = mask32x16::from_bitmask(simd, u64::from(mask));
        if self.depth_test {
            let depth = along(&self.planes.depth, x, y);
            let depths = &mut buffer.depths[at].0;
            let before = Lanes::load_array_ref(simd, depths);
            visible &= depth.simd_lt(before);
            *depths = visible.select(depth, before).to_array();
        }
        let mask = visible.to_bitmask() as u16;
        if mask == 0 {
            return;
        }
        let colours = self.colours(simd, x, y, mask);
        let runs = &mut buffer.colours[at].0;
        *runs = visible.select(colours, u32x16::load_array_ref(simd, runs)).to_array();
    }

    /// base x colour of the corners x texel x light, as bytes.
    #[inline(always)]
    fn colours<S: Simd>(&self, simd: S, x: Lanes<S>, y: f32, mask: u16) -> u32x16<S> {
        let Skin { base, colours, light, texture } = self.skin;
        let w = Lanes::splat(simd, 1.0) / along(&self.planes.inv_w, x, y);
        let mut r = Lanes::splat(simd, base.x as f32);
        let mut g = Lanes::splat(simd, base.y as f32);
        let mut b = Lanes::splat(simd, base.z as f32);
        let over_w = &self.planes.over_w;
        if *colours {
            r *= along(&over_w[0], x, y) * w;
            g *= along(&over_w[1], x, y) * w;
            b *= along(&over_w[2], x, y) * w;
        }
        if let Some(texture) = texture {
            let u = (along(&over_w[6], x, y) * w).to_array();
            let v = (along(&over_w[7], x, y) * w).to_array();
            let mut texels = [[0.0; 16]; 3];
            let mut left = u32::from(mask);
            while left != 0 {
                let lane = left.trailing_zeros() as usize & 15;
                left &= left - 1;
                let texel = texture.at(DVec2::new(u[lane].into(), v[lane].into())).as_vec3();
                (texels[0][lane], texels[1][lane], texels[2][lane]) = (texel.x, texel.y, texel.z);
            }
            r *= Lanes::load_array_ref(simd, &texels[0]);
            g *= Lanes::load_array_ref(simd, &texels[1]);
            b *= Lanes::load_array_ref(simd, &texels[2]);
        }
        if let Some(light) = light {
            let normal = [
                along(&over_w[3], x, y) * w,
                along(&over_w[4], x, y) * w,
                along(&over_w[5], x, y) * w,
            ];
            let intensity = intensity(simd, light, normal);
            (r, g, b) = (r * intensity, g * intensity, b * intensity);
        }
        let opaque = u32x16::splat(simd, 0xff00_0000);
        byte(r) | (byte(g) << 8) | (byte(b) << 16) | opaque
    }
}

/// A plane in a row, as [`Plane::at`] has it.
#[inline(always)]
fn along<S: Simd>(plane: &Plane, x: Lanes<S>, y: f32) -> Lanes<S> {
    x * plane.right + (plane.start + plane.down * y)
}

/// ambient + diffuse max(0, n . l) for normals of any length; of length 0, ambient alone.
#[inline(always)]
fn intensity<S: Simd>(simd: S, light: &Light, [x, y, z]: [Lanes<S>; 3]) -> Lanes<S> {
    let zero = Lanes::splat(simd, 0.0);
    let towards = light.towards.as_vec3();
    let length = (x * x + y * y + z * z).sqrt();
    let cosine = (x * towards.x + y * towards.y + z * towards.z) / length;
    let lit = length.simd_gt(zero).select(cosine, zero);
    lit.max(zero) * light.diffuse as f32 + light.ambient as f32
}

/// The nearest of 256 steps; beyond [0, 1] the nearer end.
#[inline(always)]
fn byte<S: Simd>(c: Lanes<S>) -> u32x16<S> {
    (c * 255.0 + 0.5).max(0.0).min(255.0).to_int()
}
