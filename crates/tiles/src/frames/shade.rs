//! The pixels of a triangle in a tile: attributes and colour, sixteen at a time; of four samples a
//! pixel the depth test too.
//!
//! Sums and products are written out and never fused, so that every instruction set rounds alike.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16, i32x4, i32x16, mask32x16, u32x16};
use glam::{DVec2, DVec3};

use super::buffer::{Buffer, PAIR_PX, load_colours, load_depths, store_colours, store_depths};
use super::planes::{Depth, Planes, along};
use super::samples::{CENTRE, Masks, PLACES};
use super::visible::{PAIR, Place, beside};
use rasterproof_render::effects::geometry::{DirectionalLight, SurfaceMaterial};
use rasterproof_render::pipeline::fog::{Share, Veil};
use rasterproof_render::pipeline::footprint::Reading;
use rasterproof_render::pipeline::highlight::Highlight;
use rasterproof_render::pipeline::multisample::SAMPLES;
use rasterproof_render::pipeline::texture::{Texture, Wrap};

type Lanes<S> = f32x16<S>;

/// How the pixels of a triangle are coloured.
pub(super) struct Brush<'a> {
    pub material: &'a SurfaceMaterial<'a>,
    pub planes: Planes,
    pub fog: Option<Foggy<'a>>,
    /// Of [`Texture::nearest_bytes`], asked once and not for each pair: a call has to put all vectors into memory.
    pub texels: Option<&'a [u32]>,
    /// Of a texture that is read at levels of detail or several times.
    pub reading: Option<Reading>,
}

/// Which share of fog a triangle has, and the plane of depths by which its pixels differ.
pub(super) struct Foggy<'a> {
    pub veil: &'a Veil,
    pub share: Share,
    pub depth: Depth,
}

impl Brush<'_> {
    /// Colours of sixteen pixels in the order of a block, where `mask` has bits.
    #[inline(always)]
    pub fn block_colours<S: Simd>(
        &self,
        simd: S,
        place: &Place,
        at_px: [i32; 2],
        mask: u32,
    ) -> u32x16<S> {
        let (x, y) = beside(simd, place, self.planes.first_px, at_px);
        self.colours(simd, x, y, mask)
    }

    /// Draws four samples a pixel, shaded once: at the centre where it is covered, else at the first
    /// sample that is visible, so that no value is extrapolated.
    #[inline(always)]
    pub fn samples<S: Simd>(
        &self,
        simd: S,
        depth: Option<&Depth>,
        masks: &Masks<PLACES>,
        buffer: &mut Buffer,
    ) {
        let (first, rows) = masks.used();
        for (top, two) in (first as i32..).step_by(2).zip(rows.chunks(2)) {
            let (above, below) = (two[0], two.get(1).copied().unwrap_or([0; PLACES]));
            let any = |row: [u64; PLACES]| row[0] | row[1] | row[2] | row[3];
            let (mut any, mut left) = (any(above) | any(below), 0);
            while any != 0 {
                let next = any.trailing_zeros();
                left += next;
                let pair = |place: usize| {
                    let run = |row: u64| (row >> left) as u32 & 0xff;
                    run(above[place]) | run(below[place]) << PAIR_PX
                };
                let pairs = [pair(0), pair(1), pair(2), pair(3), pair(CENTRE)];
                self.sample_pair(simd, depth, [left as i32, top], pairs, buffer);
                any = any >> next >> PAIR_PX;
                left += PAIR_PX as u32;
            }
        }
    }

    /// A pair; columns and rows of the tile.
    #[inline(always)]
    fn sample_pair<S: Simd>(
        &self,
        simd: S,
        depth: Option<&Depth>,
        [left, top]: [i32; 2],
        masks: [u32; CENTRE + 1],
        buffer: &mut Buffer,
    ) {
        let at_px = [left + buffer.rect.x0, top + buffer.rect.y0];
        let (x, y) = beside(simd, &PAIR, self.planes.first_px, at_px);
        let mut visible = [mask32x16::from_bitmask(simd, 0); CENTRE];
        let zero = Lanes::splat(simd, 0.0);
        let (mut at_x, mut at_y) = (zero, zero);
        let mut any = visible[0];
        // From the last, so that the first that is visible is where a pixel is shaded.
        for sample in (0..CENTRE).rev() {
            let mut seen = mask32x16::from_bitmask(simd, u64::from(masks[sample]));
            let [right, down] = from_centre(SAMPLES[sample]);
            if let Some(depth) = depth {
                let plane = &mut buffer.planes[sample].depths;
                let before = load_depths::<S, PAIR_PX>(simd, plane, left, top);
                let depth = depth.at(x + right, y + down);
                seen &= depth.simd_lt(before);
                store_depths::<S, PAIR_PX>(seen.select(depth, before), plane, left, top);
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
            let before = load_colours::<S, PAIR_PX>(simd, &plane.colours, left, top);
            let after = visible.select(colours, before);
            store_colours::<S, PAIR_PX>(after, &mut plane.colours, left, top);
        }
    }

    /// base x colour of the corners x texel x light, in steps of 255, where `mask` has bits. A normal is
    /// brought back to length 1, so that it is not divided by 1/w before.
    #[inline(always)]
    fn colours<S: Simd>(&self, simd: S, x: Lanes<S>, y: Lanes<S>, mask: u32) -> u32x16<S> {
        let SurfaceMaterial { base, colours, light, texture, highlight, veil: _ } = self.material;
        if let Some(Foggy { veil, share: Share::Whole, .. }) = &self.fog {
            return u32x16::splat(simd, u32::from_le_bytes(veil.colour()));
        }
        let w = Lanes::splat(simd, 1.0) / along(&self.planes.inv_w, x, y);
        let over_w = |i: usize| self.planes.over_w(i);
        let mut r = Lanes::splat(simd, base.x);
        let mut g = Lanes::splat(simd, base.y);
        let mut b = Lanes::splat(simd, base.z);
        if *colours {
            r *= along(&over_w(0), x, y) * w;
            g *= along(&over_w(1), x, y) * w;
            b *= along(&over_w(2), x, y) * w;
        }
        if let Some(texture) = texture {
            let (u, v) = (along(&over_w(6), x, y) * w, along(&over_w(7), x, y) * w);
            let texel = match &self.reading {
                None => match self.texels {
                    Some(bytes) => bytes_at(simd, bytes, texture, u, v),
                    None => texels(simd, texture, [u, v], mask),
                },
                Some(reading) => texels_at_levels(simd, (texture, reading), [u, v, w], mask),
            };
            (r, g, b) = (r * texel[0], g * texel[1], b * texel[2]);
        }
        let mut shine = None;
        if let Some(light) = light {
            let normal =
                [along(&over_w(3), x, y), along(&over_w(4), x, y), along(&over_w(5), x, y)];
            let intensity = intensity(simd, light, normal);
            (r, g, b) = (r * intensity, g * intensity, b * intensity);
            if let Some(highlight) = highlight {
                shine = Some(highlights(simd, highlight, normal, mask));
            }
        }
        let opaque = u32x16::splat(simd, 0xff00_0000);
        let (mut r, mut g, mut b) = (byte(r), byte(g), byte(b));
        if let Some([shine_r, shine_g, shine_b]) = shine {
            (r, g, b) = ((r + shine_r).min(255), (g + shine_g).min(255), (b + shine_b).min(255));
        }
        let colours = r | (g << 8) | (b << 16) | opaque;
        match &self.fog {
            Some(Foggy { veil, share: Share::Mixed, depth }) => {
                fogged(simd, veil, depth.at(x, y), colours, mask)
            }
            _ => colours,
        }
    }
}

/// From the centre of a pixel to a sample, in pixels.
fn from_centre((x_16th, y_16th): (i32, i32)) -> [f32; 2] {
    [(x_16th - 8) as f32 / 16.0, (y_16th - 8) as f32 / 16.0]
}

/// The texels at (u, v), where `mask` has bits.
#[inline(always)]
fn texels<S: Simd>(simd: S, texture: &Texture, [u, v]: [Lanes<S>; 2], mask: u32) -> [Lanes<S>; 3] {
    let (u, v) = (u.to_array(), v.to_array());
    one_by_one(simd, mask, |lane| texture.at(DVec2::new(u[lane].into(), v[lane].into())))
}

/// The lanes of the bits of a mask, from the lowest on.
#[inline(always)]
fn lanes(mut mask: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let lane = (mask != 0).then(|| mask.trailing_zeros() as usize & 15)?;
        mask &= mask - 1;
        Some(lane)
    })
}

/// What a function says of each lane of a mask; 0 in the others.
#[inline(always)]
fn one_by_one<S: Simd>(simd: S, mask: u32, of: impl Fn(usize) -> DVec3) -> [Lanes<S>; 3] {
    let mut found = [[0.0; 16]; 3];
    for lane in lanes(mask) {
        let [x, y, z] = of(lane).as_vec3().to_array();
        (found[0][lane], found[1][lane], found[2][lane]) = (x, y, z);
    }
    let [x, y, z] = &found;
    [Lanes::load_array_ref(simd, x), Lanes::load_array_ref(simd, y), Lanes::load_array_ref(simd, z)]
}

/// The same at levels of detail and several times, where w is that of the footprint's 1/w.
#[inline(always)]
fn texels_at_levels<S: Simd>(
    simd: S,
    (texture, reading): (&Texture, &Reading),
    [u, v, w]: [Lanes<S>; 3],
    mask: u32,
) -> [Lanes<S>; 3] {
    let (u, v, w) = (u.to_array(), v.to_array(), w.to_array());
    one_by_one(simd, mask, |lane| {
        let uv = DVec2::new(u[lane].into(), v[lane].into());
        reading.texel(texture, uv, w[lane].into()).0
    })
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
    let column = nearest(u, width as i32, texture.wrap[0]);
    let row = nearest(Lanes::splat(simd, 1.0) - v, height as i32, texture.wrap[1]);
    let at = (row * (width as i32) + column).to_array();
    // Four by four: of sixteen numbers one by one the compiler makes sixteen masks.
    let four = |i: usize| {
        // From memory, one load each: left alone, the compiler takes them out of the vector, which is dearer. And four at a
        // time, since more are put into memory again.
        let at = std::hint::black_box(&at);
        // Masks and limits leave nothing else.
        let texel = |at: i32| bytes[at as u32 as usize] as i32;
        [texel(at[i]), texel(at[i + 1]), texel(at[i + 2]), texel(at[i + 3])]
    };
    let (a, b) = (i32x4::load_array(simd, four(0)), i32x4::load_array(simd, four(4)));
    let (c, d) = (i32x4::load_array(simd, four(8)), i32x4::load_array(simd, four(12)));
    let found = a.combine(b).combine(c.combine(d));
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
        // Mirrored textures have no bytes to read in this way.
        Wrap::Repeat | Wrap::Mirror => texel & (side - 1),
        Wrap::Clamp => texel.max(0).min(side - 1),
    }
}

/// ambient + diffuse max(0, n . l) for normals of any length; of length 0, ambient alone.
#[inline(always)]
fn intensity<S: Simd>(simd: S, light: &DirectionalLight, [x, y, z]: [Lanes<S>; 3]) -> Lanes<S> {
    let zero = Lanes::splat(simd, 0.0);
    let towards = light.towards;
    let length = (x * x + y * y + z * z).sqrt();
    let cosine = (x * towards.x + y * towards.y + z * towards.z) / length;
    let lit = length.simd_gt(zero).select(cosine, zero);
    lit.max(zero) * light.diffuse + light.ambient
}

/// Highlights in whole steps, where `mask` has bits. Few pixels have one, so each is computed by itself.
#[inline(always)]
fn highlights<S: Simd>(
    simd: S,
    highlight: &Highlight,
    [x, y, z]: [Lanes<S>; 3],
    mask: u32,
) -> [u32x16<S>; 3] {
    let (halfway, least) = highlight.cone();
    let halfway = halfway.as_vec3();
    let length = (x * x + y * y + z * z).sqrt();
    // A length of 0 makes NaN, which is not above.
    let cosine = (x * halfway.x + y * halfway.y + z * halfway.z) / length;
    let shining = cosine.simd_gt(least as f32).to_bitmask() as u32 & mask;
    let mut shine = [[0; 16]; 3];
    let cosine = cosine.to_array();
    for lane in lanes(shining) {
        let [r, g, b] = highlight.of(cosine[lane].into()).map(u32::from);
        (shine[0][lane], shine[1][lane], shine[2][lane]) = (r, g, b);
    }
    let [r, g, b] = &shine;
    [
        u32x16::load_array_ref(simd, r),
        u32x16::load_array_ref(simd, g),
        u32x16::load_array_ref(simd, b),
    ]
}

/// Colours in fog, where `mask` has bits.
#[inline(always)]
fn fogged<S: Simd>(
    simd: S,
    veil: &Veil,
    depths: Lanes<S>,
    colours: u32x16<S>,
    mask: u32,
) -> u32x16<S> {
    let (depths, mut colours) = (depths.to_array(), colours.to_array());
    for lane in lanes(mask) {
        let distance = veil.distance(depths[lane].into());
        colours[lane] = u32::from_le_bytes(veil.before(colours[lane].to_le_bytes(), distance));
    }
    u32x16::load_array_ref(simd, &colours)
}

/// The nearest of 256 steps; beyond them the nearer end.
#[inline(always)]
fn byte<S: Simd>(c: Lanes<S>) -> u32x16<S> {
    (c + 0.5).max(0.0).min(255.0).to_int()
}
