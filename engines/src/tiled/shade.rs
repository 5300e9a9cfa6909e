//! The pixels of a triangle in a tile: depth test, attributes and colour, sixteen at a time.
//!
//! Sums and products are written out and never fused, so that every instruction set rounds alike.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x4, f32x16, i32x16, mask32x16, u32x4, u32x16};
use glam::DVec2;

use super::buffer::Buffer;
use super::planes::{Plane, Planes};
use super::samples::{CENTRE, Masks};
use crate::effects::whole::Skin;
use crate::pipeline::multisample::SAMPLES;
use crate::pipeline::shade::Light;
use crate::pipeline::texture::{Texture, Wrap};
use crate::tile::{Block, Piece, SIDE_PX};

type Lanes<S> = f32x16<S>;

/// Columns of a row, from its first.
const ROW: [f32; 16] = [0., 1., 2., 3., 4., 5., 6., 7., 8., 9., 10., 11., 12., 13., 14., 15.];
/// Columns and rows of a cell.
const CELL_X: [f32; 16] = [0., 1., 2., 3., 0., 1., 2., 3., 0., 1., 2., 3., 0., 1., 2., 3.];
const CELL_Y: [f32; 16] = [0., 0., 0., 0., 1., 1., 1., 1., 2., 2., 2., 2., 3., 3., 3., 3.];

/// How the pixels of a triangle are coloured.
pub(super) struct Brush<'a> {
    pub skin: &'a Skin<'a>,
    pub planes: Planes<8>,
    pub depth_test: bool,
}

impl Brush<'_> {
    /// Draws what is covered, one sample a pixel.
    #[inline(always)]
    pub fn piece<S: Simd>(&self, simd: S, covered: &Piece, buffer: &mut Buffer) {
        let (columns, rows) = match covered {
            Piece::Cell(cell) => {
                self.cell(simd, cell.x_px, cell.y_px, cell.pixels, buffer);
                return;
            }
            Piece::Tile(tile) => (tile.x_px..tile.x_px + 1, tile.y_px..tile.y_px + SIDE_PX),
            Piece::Block(Block { rect, .. }) => {
                (rect.x0 & !(SIDE_PX - 1)..rect.x1, rect.y0..rect.y1)
            }
        };
        for x_px in columns.step_by(SIDE_PX as usize) {
            for y_px in rows.clone() {
                let mask = match covered {
                    Piece::Tile(tile) => tile.rows[(y_px - tile.y_px) as usize & 15],
                    Piece::Block(Block { rect, .. }) => {
                        let from = (rect.x0 - x_px).max(0);
                        let to = (rect.x1 - x_px).min(SIDE_PX);
                        ((1u32 << to) - (1 << from)) as u16
                    }
                    Piece::Cell(_) => 0,
                };
                if mask != 0 {
                    self.row(simd, x_px, y_px, mask, buffer);
                }
            }
        }
    }

    /// Pixels of 4 x 4, bit 4 j + i for (i, j).
    #[inline(always)]
    fn cell<S: Simd>(&self, simd: S, x_px: i32, y_px: i32, mask: u16, buffer: &mut Buffer) {
        let (x, y) = self.beside_first(simd, &CELL_X, &CELL_Y, x_px, y_px);
        let (left, top) = (x_px - buffer.rect.x0, y_px - buffer.rect.y0);
        let plane = &mut buffer.planes[0];
        let mut visible = mask32x16::from_bitmask(simd, u64::from(mask));
        if self.depth_test {
            let pitch = plane.depths.pitch();
            let depths = plane.depths.tail_mut(left, top);
            let depth = along(&self.planes.depth, x, y);
            let before = f32x4::from_slice(simd, &depths[..4])
                .combine(f32x4::from_slice(simd, &depths[pitch..][..4]))
                .combine(
                    f32x4::from_slice(simd, &depths[2 * pitch..][..4])
                        .combine(f32x4::from_slice(simd, &depths[3 * pitch..][..4])),
                );
            visible &= depth.simd_lt(before);
            let (above, below) = visible.select(depth, before).split();
            let ((a, b), (c, d)) = (above.split(), below.split());
            a.store_slice(&mut depths[..4]);
            b.store_slice(&mut depths[pitch..][..4]);
            c.store_slice(&mut depths[2 * pitch..][..4]);
            d.store_slice(&mut depths[3 * pitch..][..4]);
        }
        let mask = visible.to_bitmask() as u32;
        if mask == 0 {
            return;
        }
        let colours = self.colours(simd, x, y, mask);
        let pitch = plane.colours.pitch();
        let runs = plane.colours.tail_mut(left, top);
        let before = u32x4::from_slice(simd, &runs[..4])
            .combine(u32x4::from_slice(simd, &runs[pitch..][..4]))
            .combine(
                u32x4::from_slice(simd, &runs[2 * pitch..][..4])
                    .combine(u32x4::from_slice(simd, &runs[3 * pitch..][..4])),
            );
        let (above, below) = visible.select(colours, before).split();
        let ((a, b), (c, d)) = (above.split(), below.split());
        a.store_slice(&mut runs[..4]);
        b.store_slice(&mut runs[pitch..][..4]);
        c.store_slice(&mut runs[2 * pitch..][..4]);
        d.store_slice(&mut runs[3 * pitch..][..4]);
    }

    /// Sixteen pixels of a row, those of `mask`.
    #[inline(always)]
    fn row<S: Simd>(&self, simd: S, x_px: i32, y_px: i32, mask: u16, buffer: &mut Buffer) {
        let (x, y) = self.beside_first(simd, &ROW, &[0.0; 16], x_px, y_px);
        let (left, top) = (x_px - buffer.rect.x0, y_px - buffer.rect.y0);
        let plane = &mut buffer.planes[0];
        let mut visible = mask32x16::from_bitmask(simd, u64::from(mask));
        if self.depth_test {
            let depths = &mut plane.depths.tail_mut(left, top)[..16];
            let depth = along(&self.planes.depth, x, y);
            let before = Lanes::from_slice(simd, depths);
            visible &= depth.simd_lt(before);
            visible.select(depth, before).store_slice(depths);
        }
        let mask = visible.to_bitmask() as u32;
        if mask == 0 {
            return;
        }
        let colours = self.colours(simd, x, y, mask);
        let run = &mut plane.colours.tail_mut(left, top)[..16];
        visible.select(colours, u32x16::from_slice(simd, run)).store_slice(run);
    }

    /// Draws four samples a pixel, shaded once: at the centre where it is covered, else at the first
    /// sample that is visible, so that no value is extrapolated.
    #[inline(always)]
    pub fn samples<S: Simd>(&self, simd: S, masks: &Masks, buffer: &mut Buffer) {
        let mut columns = 0;
        for row in &masks.rows[masks.first.min(masks.end)..masks.end] {
            columns |= row[0] | row[1] | row[2] | row[3];
        }
        if columns == 0 {
            return;
        }
        let (first, end) = (columns.trailing_zeros(), 64 - columns.leading_zeros());
        for top in masks.first..masks.end {
            let row = &masks.rows[top];
            for left in (first..end).step_by(SIDE_PX as usize) {
                let part = [
                    (row[0] >> left) as u16,
                    (row[1] >> left) as u16,
                    (row[2] >> left) as u16,
                    (row[3] >> left) as u16,
                    (row[CENTRE] >> left) as u16,
                ];
                if part[0] | part[1] | part[2] | part[3] != 0 {
                    self.sample_row(simd, left as i32, top as i32, part, buffer);
                }
            }
        }
    }

    /// Sixteen pixels of a row; columns and rows of the tile.
    #[inline(always)]
    fn sample_row<S: Simd>(
        &self,
        simd: S,
        left: i32,
        top: i32,
        masks: [u16; CENTRE + 1],
        buffer: &mut Buffer,
    ) {
        let (x_px, y_px) = (left + buffer.rect.x0, top + buffer.rect.y0);
        let (x, y) = self.beside_first(simd, &ROW, &[0.0; 16], x_px, y_px);
        let mut visible = [mask32x16::from_bitmask(simd, 0); CENTRE];
        let zero = Lanes::splat(simd, 0.0);
        let (mut at_x, mut at_y) = (zero, zero);
        let mut any = visible[0];
        // From the last, so that the first that is visible is where a pixel is shaded.
        for sample in (0..CENTRE).rev() {
            let mut seen = mask32x16::from_bitmask(simd, u64::from(masks[sample]));
            let [right, down] = from_centre(SAMPLES[sample]);
            if self.depth_test {
                let depths = &mut buffer.planes[sample].depths.tail_mut(left, top)[..16];
                let depth = along(&self.planes.depth, x + right, y + down);
                let before = Lanes::from_slice(simd, depths);
                seen &= depth.simd_lt(before);
                seen.select(depth, before).store_slice(depths);
            }
            at_x = seen.select(Lanes::splat(simd, right), at_x);
            at_y = seen.select(Lanes::splat(simd, down), at_y);
            any |= seen;
            visible[sample] = seen;
        }
        let mask = any.to_bitmask() as u32;
        if mask == 0 {
            return;
        }
        let centre = mask32x16::from_bitmask(simd, u64::from(masks[CENTRE]));
        let (at_x, at_y) = (centre.select(zero, at_x), centre.select(zero, at_y));
        let colours = self.colours(simd, x + at_x, y + at_y, mask);
        for (plane, visible) in buffer.planes.iter_mut().zip(visible).take(CENTRE) {
            let run = &mut plane.colours.tail_mut(left, top)[..16];
            let before = u32x16::from_slice(simd, run);
            visible.select(colours, before).store_slice(run);
        }
    }

    /// Pixels as planes count them.
    #[inline(always)]
    fn beside_first<S: Simd>(
        &self,
        simd: S,
        columns: &[f32; 16],
        rows: &[f32; 16],
        x_px: i32,
        y_px: i32,
    ) -> (Lanes<S>, Lanes<S>) {
        let [x0, y0] = self.planes.first_px;
        let x = Lanes::load_array_ref(simd, columns) + (x_px - x0) as f32;
        (x, Lanes::load_array_ref(simd, rows) + (y_px - y0) as f32)
    }

    /// base x colour of the corners x texel x light, as bytes, where `mask` has bits.
    #[inline(always)]
    fn colours<S: Simd>(&self, simd: S, x: Lanes<S>, y: Lanes<S>, mask: u32) -> u32x16<S> {
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
            let (u, v) = (along(&over_w[6], x, y) * w, along(&over_w[7], x, y) * w);
            let texel = texels(simd, texture, u, v, mask);
            (r, g, b) = (r * texel[0], g * texel[1], b * texel[2]);
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

/// From the centre of a pixel to a sample, in pixels.
fn from_centre((x_16th, y_16th): (i32, i32)) -> [f32; 2] {
    [(x_16th - 8) as f32 / 16.0, (y_16th - 8) as f32 / 16.0]
}

/// A plane at (x, y), as [`Plane::at`] has it.
#[inline(always)]
fn along<S: Simd>(plane: &Plane, x: Lanes<S>, y: Lanes<S>) -> Lanes<S> {
    x * plane.right + (y * plane.down + plane.start)
}

/// The texels at (u, v), where `mask` has bits.
#[inline(always)]
fn texels<S: Simd>(
    simd: S,
    texture: &Texture,
    u: Lanes<S>,
    v: Lanes<S>,
    mask: u32,
) -> [Lanes<S>; 3] {
    if let Some(bytes) = texture.nearest_bytes() {
        return bytes_at(simd, bytes, texture, u, v);
    }
    let (u, v) = (u.to_array(), v.to_array());
    let mut texels = [[0.0; 16]; 3];
    let mut left = mask;
    while left != 0 {
        let lane = left.trailing_zeros() as usize & 15;
        left &= left - 1;
        let texel = texture.at(DVec2::new(u[lane].into(), v[lane].into())).as_vec3();
        (texels[0][lane], texels[1][lane], texels[2][lane]) = (texel.x, texel.y, texel.z);
    }
    [
        Lanes::load_array_ref(simd, &texels[0]),
        Lanes::load_array_ref(simd, &texels[1]),
        Lanes::load_array_ref(simd, &texels[2]),
    ]
}

/// Of texels as bytes.
#[inline(always)]
fn bytes_at<S: Simd>(
    simd: S,
    bytes: &[u32],
    texture: &Texture,
    u: Lanes<S>,
    v: Lanes<S>,
) -> [Lanes<S>; 3] {
    let (width, height) = texture.size();
    let column = nearest(u, width as i32, texture.wrap);
    let row = nearest(Lanes::splat(simd, 1.0) - v, height as i32, texture.wrap);
    let at = (row * (width as i32) + column).to_array();
    let mut found = [0; 16];
    for (found, at) in found.iter_mut().zip(at) {
        // Masks and limits leave nothing else.
        *found = bytes.get(at as usize).map_or(0, |&texel| texel as i32);
    }
    let found = i32x16::load_array_ref(simd, &found);
    let (r, g, b) = (found & 0xff, (found >> 8) & 0xff, found >> 16);
    let step = 1.0 / 255.0;
    let (r, g, b): (Lanes<S>, Lanes<S>, Lanes<S>) = (r.to_float(), g.to_float(), b.to_float());
    [r * step, g * step, b * step]
}

/// The column or row that is read at a coordinate, as [`Texture::at`] has it: rounded to 1/256 texel.
#[inline(always)]
fn nearest<S: Simd>(coordinate: Lanes<S>, side: i32, wrap: Wrap) -> i32x16<S> {
    const FAR: f32 = (1 << 30) as f32;
    let moved = (coordinate * (side * 256) as f32 + 0.5).floor();
    let whole: i32x16<S> = moved.max_precise(-FAR).min(FAR).to_int();
    let texel = whole >> 8;
    match wrap {
        Wrap::Repeat => texel & (side - 1),
        Wrap::Clamp => texel.max(0).min(side - 1),
    }
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
