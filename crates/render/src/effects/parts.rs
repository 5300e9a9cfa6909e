//! Parts of large pieces: what is paid for somewhere in a piece is not paid for everywhere in it.
//!
//! The window is cut into squares. The conditions of a piece are checked again in each square of a large one, at
//! the four corners of the square in the plane of the piece, and what is left out there is left out of the square alone. A
//! rasterizer only crops to its bounds, so a piece that is drawn square by square has the bits of the whole.
//!
//! **Why the bits stay the same.** A fragment or sample of the piece in a square lies between the four corners of the square, so
//! in the one half of it or in the other, which are triangles in the plane of the piece. In such a triangle 1/w and
//! each attribute over w are linear, as in the piece itself. So what a condition says of fragments between three corners
//! it says of those in the half. Corners may lie beyond the piece, where attributes are continued; that makes the
//! intervals wider and no condition wrong.
//!
//! Texture coordinates alone are checked. What else a square has less than its piece, as a part without highlights, saved less than 3% of any
//! scene on average, and less than 15% of each, by instructions.
//!
//! A corner's texture coordinates are weighted means, with weights l_i q_i / q where l_i are the exact shares in the window, q_i the
//! 1/w of the piece's corners and q the sum of l_i q_i. Where the absolute values add up to at most `MOST_WEIGHT` times the
//! sum, each is off by at most 2^-45 of the largest value at the piece's corners: 8 times some 30 roundings. The conditions of
//! footprints have margins of 2^-40 ([`Footprint::longest_in`]), and the coordinates get 2^-40 here. Corners where the weights are
//! larger tell nothing: such a square is drawn as the piece is.

use glam::{DVec2, DVec3};

use super::Mode;
use super::conditions::mip_maps::{MOST_TEXELS, footprint, is_affine, is_near};
use super::conditions::samples_of;
use super::plan::{Attributes, Parts, PiecePlan, Rule};
use super::primitive::{Piece, Prepared, has_one_w, pixel_box, uvs};
use crate::pipeline::footprint::Footprint;
use crate::pipeline::opacity::Drawn;
use crate::pipeline::target::Antialias;
use crate::pipeline::texture::Texture;
use crate::scene::Item;
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::{PixelRect, SUBPIXELS};

/// Samples along the side of a square.
const SIDE: u32 = 16;

/// The same where each of four planes of samples is drawn by itself.
const LARGE_SIDE: u32 = 32;

/// The absolute weights of a corner's attributes add up to at most this.
const MOST_WEIGHT: f64 = 8.0;

impl Parts {
    /// Of the pieces of an item with this rule; nothing where nothing depends on where a fragment is. A plan has it also without a
    /// texture, where no piece is cut: what a plan says is a part of the digest of frames.
    pub(super) fn of(rule: &Rule, item: &Item, antialias: Antialias) -> Option<Self> {
        let varies = !rule.interpolates.without(Attributes(Attributes::COLOUR)).is_empty();
        let is_planned = [
            rule.specular,
            rule.shadows,
            rule.mip_maps,
            rule.anisotropy,
            rule.fog,
            rule.alpha_test,
            rule.blending,
        ]
        .contains(&Mode::Planned);
        let side = if antialias.planes() > 1 { LARGE_SIDE } else { SIDE };
        // Squares of physical surfaces are not checked.
        let is_checked = rule.where_it_varies && item.material.physical.is_none();
        (is_checked && (is_planned || varies)).then_some(Self { side, rule: *rule })
    }

    /// No more than fits whatever is computed of it.
    fn side(&self) -> i32 {
        self.side.min(1 << 12) as i32
    }

    /// Whether it pays to check the squares of a piece. In a small one the checks take longer than they save.
    #[inline]
    pub(super) fn are_checked(&self, piece: &Piece, plan: PiecePlan) -> bool {
        self.side != 0
            && plan.interpolates.has(Attributes::UV)
            && samples_of(piece) >= 4 * i64::from(self.side()).pow(2)
    }
}

/// A rectangle of the window in which a piece pays for what this plan says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Part {
    pub bounds: PixelRect,
    pub plan: PiecePlan,
    /// What all fragments read of the texture, where that is known.
    pub texel: Option<DVec3>,
}

/// The corners of a square in the plane of a piece.
struct Square {
    inv_w: [f64; 4],
    corners: [DVec2; 4],
    /// Texture coordinates between which all lie that are read.
    uv: [DVec2; 3],
}

/// A piece that is checked square by square.
pub(super) struct Whole<'a> {
    rule: &'a Rule,
    item: &'a Prepared<'a>,
    piece: &'a Piece,
    plan: PiecePlan,
    side: i32,
    /// Twice the signed area, in subpixels.
    area: i64,
    /// 1/w at the corners, by which attributes are interpolated.
    inv_w: [f64; 3],
    /// Nothing where no texture is read in each fragment.
    footprint: Option<Footprint>,
    /// Whether w is exact enough for conditions of levels and taps.
    is_exact: bool,
    /// The largest |u| and |v| at a corner.
    farthest: DVec2,
}

impl<'a> Whole<'a> {
    pub fn new(
        parts: &'a Parts,
        item: &'a Prepared<'_>,
        piece: &'a Piece,
        plan: PiecePlan,
    ) -> Self {
        let [a, b, c] = uvs(piece, false).map_array(|uv| uv.abs());
        let footprint = item
            .texture
            .filter(|_| plan.interpolates.has(Attributes::UV))
            .map(|texture| footprint((texture, false), piece, plan.perspective));
        let has_w = plan.perspective || has_one_w(piece);
        let inv_w = piece.vertices.map_array(|v| if has_w { v.inv_w } else { 1.0 });
        let area = edge(piece, 2, [piece.vertices[2].position.x, piece.vertices[2].position.y]);
        Self {
            rule: &parts.rule,
            item,
            piece,
            plan,
            side: parts.side(),
            area,
            inv_w,
            footprint: footprint.map(|(footprint, ..)| footprint),
            is_exact: is_near(item, piece) && !is_affine(piece, plan.perspective),
            farthest: a.max(b).max(c),
        }
    }

    /// Every rectangle of the piece in the window, with what is paid for in it.
    pub fn each(&self, window: PixelRect, margin_px: i32, draw: &mut dyn FnMut(&Part)) {
        let bounds = pixel_box(&self.piece.corners(), margin_px).intersect(&window);
        if bounds.is_empty() {
            return;
        }
        let side = self.side;
        let mut y0 = bounds.y0;
        while y0 < bounds.y1 {
            let y1 = bounds.y1.min((y0.div_euclid(side) + 1) * side);
            let mut x0 = bounds.x0;
            while x0 < bounds.x1 {
                let x1 = bounds.x1.min((x0.div_euclid(side) + 1) * side);
                let rect = PixelRect { x0, y0, x1, y1 };
                x0 = x1;
                let Some(shares) = self.shares(rect) else { continue };
                let own = self.square(shares).map(|square| self.plan(&square));
                let (plan, texel) = own.unwrap_or((self.plan, None));
                draw(&Part { bounds: rect, plan, texel });
            }
            y0 = y1;
        }
    }

    /// The shares of the piece's corners at the corners of a rectangle; nothing where the piece covers none of it: all four lie
    /// outside of one edge.
    fn shares(&self, rect: PixelRect) -> Option<[[f64; 3]; 4]> {
        let PixelRect { x0, y0, x1, y1 } = rect;
        let points = [[x0, y0], [x1, y0], [x0, y1], [x1, y1]];
        let sign = self.area.signum();
        let mut shares = [[0.0; 3]; 4];
        for number in 0..3 {
            let mut is_outside = true;
            for (point, shares) in points.iter().zip(&mut shares) {
                let share = edge(self.piece, number, point.map(|px| px * SUBPIXELS));
                is_outside &= share * sign < 0;
                shares[number] = share as f64 / self.area as f64;
            }
            if is_outside {
                return None;
            }
        }
        Some(shares)
    }

    /// What the piece has at points with these shares of its corners; nothing where that is not known well enough.
    fn square(&self, shares: [[f64; 3]; 4]) -> Option<Square> {
        let [a, b, c] = uvs(self.piece, false);
        let (mut inv_w, mut corners) = ([0.0; 4], [DVec2::ZERO; 4]);
        for (i, shares) in shares.into_iter().enumerate() {
            let parts = [0, 1, 2].map_array(|i: usize| shares[i] * self.inv_w[i]);
            let sum = parts[0] + parts[1] + parts[2];
            let weight = parts[0].abs() + parts[1].abs() + parts[2].abs();
            let of_corners = parts.map_array(|part| part / sum);
            let uv = of_corners[0] * a + of_corners[1] * b + of_corners[2] * c;
            // NaN is not known.
            if !(sum > 0.0 && weight <= MOST_WEIGHT * sum && uv.is_finite()) {
                return None;
            }
            (inv_w[i], corners[i]) = (sum, uv);
        }
        // What is read lies between the corners of the square, and between those of the piece.
        let margin = (DVec2::ONE + self.farthest) * 0.5f64.powi(40);
        let [p, q, r, s] = corners;
        let low = p.min(q).min(r.min(s)).max(a.min(b).min(c)) - margin;
        let high = p.max(q).max(r.max(s)).min(a.max(b).max(c)) + margin;
        Some(Square { inv_w, corners, uv: [low, high, low] })
    }

    /// What is paid for in a square, and the texel that all of its fragments read, where they read one.
    fn plan(&self, square: &Square) -> (PiecePlan, Option<DVec3>) {
        let Self { rule, item, mut plan, .. } = *self;
        let opacity = item.item.material.opacity.as_ref();
        if !plan.replaces_all()
            && let Some(opacity) = opacity
        {
            let drawn = opacity.between(square.uv, opacity.farthest());
            for (mode, own) in
                [(rule.alpha_test, &mut plan.alpha_test), (rule.blending, &mut plan.blending)]
            {
                if *own == Drawn::Mixed && mode.is_open() {
                    *own = drawn;
                }
            }
            plan.layers &= plan.blending == Drawn::Mixed;
            if plan.is_nothing() {
                return (plan, None);
            }
        }
        let texel = item.texture.and_then(|texture| self.texture(texture, square, &mut plan));
        if rule.perspective.is_open() {
            plan.perspective &= !plan.interpolates.is_empty();
        }
        (plan, texel)
    }

    /// Leaves out levels of detail, and where one texel is read everywhere taps and texture coordinates.
    fn texture(&self, texture: &Texture, square: &Square, plan: &mut PiecePlan) -> Option<DVec3> {
        let rule = self.rule;
        let mut longest = f64::INFINITY;
        if let Some(footprint) = &self.footprint {
            longest = footprint.longest_in(square.inv_w, square.corners, self.farthest);
            if self.is_exact && rule.mip_maps.is_open() {
                plan.mip_maps &= longest.is_nan() || longest > 1.0;
            }
        }
        // The opacity of a fragment may be read at these coordinates, too.
        if !plan.replaces_all()
            || [rule.mip_maps, rule.anisotropy].contains(&Mode::Always)
            || (plan.reads_around() && !(self.is_exact && longest < MOST_TEXELS))
        {
            return None;
        }
        let reach = if plan.anisotropy { longest / 2.0 } else { 0.0 };
        let level = if plan.mip_maps { libm::log2(longest) + 0.5f64.powi(20) } else { 0.0 };
        if !texture.is_plain_between(square.uv, reach, level) {
            return None;
        }
        (plan.mip_maps, plan.anisotropy) = (false, false);
        plan.interpolates = plan.interpolates.without(Attributes(Attributes::UV));
        Some(texture.at(square.uv[0]))
    }
}

/// Twice the signed area of the triangle between a point, in subpixels, and the edge that lies opposite to a corner.
fn edge(piece: &Piece, number: usize, [x, y]: [i32; 2]) -> i64 {
    let at = |number: usize| {
        let position = piece.vertices[number % 3].position;
        [i64::from(position.x), i64::from(position.y)]
    };
    let ([ax, ay], [bx, by]) = (at(number + 1), at(number + 2));
    (bx - ax) * (i64::from(y) - ay) - (by - ay) * (i64::from(x) - ax)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::conditions::{of_every_fragment, rule};
    use crate::effects::plan::Canvas;
    use crate::effects::primitive::pack;
    use crate::effects::{Effects, planner};
    use crate::pipeline::depth::DepthFormat;
    use crate::pipeline::shade::{Attributes as PackedAttributes, PLACED, Surface};
    use crate::scene::{Scene, random};
    use rasterproof_core::contract::Interpolate as _;
    use rasterproof_core::grid::SubpixelPoint;
    use rasterproof_core::raster::scanline::Scanline;
    use rasterproof_core::triangle::{ScreenTriangle, ScreenVertex};

    type Corners = fn(&Whole<'_>, [[f64; 3]; 4]) -> Option<Square>;

    /// How many fragments of the pieces of random scenes were looked at, and how many have texture coordinates beyond the corners of
    /// their square.
    fn tried(corners: Corners) -> [u64; 2] {
        let (width, height) = (120, 90);
        let canvas = Canvas {
            width,
            height,
            antialias: Antialias::None,
            depth: DepthFormat::Unorm32,
            watched: false,
        };
        let mut counts = [0; 2];
        for index in 0..90 {
            let scene = random::with_effects(6, index);
            let (plan, mut assembled) =
                planner::plan(&scene, &canvas, &Effects::PLANNED, &|_| None).unwrap();
            assembled.assemble(&scene);
            for (number, piece) in assembled.pieces() {
                let (item, parts) = (&assembled.items[*number], plan.items[*number].parts);
                let Some(parts) = parts.map(|parts| Parts { side: 8, ..parts }) else { continue };
                let own = of_every_fragment(&scene, item.item);
                let whole = Whole::new(&parts, item, piece, own);
                for (row, column) in
                    (0..12).flat_map(|row| (0..15).map(move |column| (row, column)))
                {
                    let (x0, y0) = (column * 8, row * 8);
                    let rect = PixelRect { x0, y0, x1: x0 + 8, y1: y0 + 8 };
                    let shares = whole.shares(rect);
                    let square = shares.and_then(|shares| corners(&whole, shares));
                    see(&whole, rect, (shares.is_some(), square), &mut counts);
                }
            }
        }
        counts
    }

    fn see(
        whole: &Whole<'_>,
        rect: PixelRect,
        (is_covered, square): (bool, Option<Square>),
        counts: &mut [u64; 2],
    ) {
        let packed = pack::<PLACED>(whole.piece, Attributes::EVERY);
        let visit = |fragment: rasterproof_core::triangle::Fragment<_>| {
            assert!(is_covered, "a fragment in a square that is not covered");
            let Some(square) = &square else { return };
            let Surface { uv, .. } = Surface::from(&fragment.varying);
            let [low, high, _] = square.uv;
            counts[0] += 1;
            counts[1] += u64::from(uv.max(low) != uv || uv.min(high) != uv);
        };
        if whole.plan.perspective {
            Scanline.fragments(&packed, rect, visit);
        } else {
            Scanline.affine_fragments(&packed, rect, visit);
        }
    }

    #[test]
    fn squares_are_checked_where_something_may_be_left_out_of_them() {
        let scenes = (0..60).map(|index| random::with_effects(6, index));
        let parts = |scene: Scene| {
            let rule = rule(&scene, &scene.items[0], &Effects::PLANNED).1;
            Parts::of(&rule, &scene.items[0], Antialias::None)
        };
        let parts = scenes.into_iter().find_map(parts).unwrap();
        let piece = |[x_px, y_px]: [i32; 2]| {
            let vertex = |x_px: i32, y_px: i32| ScreenVertex {
                position: SubpixelPoint::new(x_px * SUBPIXELS, y_px * SUBPIXELS),
                depth: 0.5,
                inv_w: 1.0,
                varying: PackedAttributes([0.0; PLACED]),
            };
            ScreenTriangle { vertices: [vertex(0, 0), vertex(x_px, 0), vertex(0, y_px)] }
        };
        let are_checked = |sides, bits: u8| {
            let plan = PiecePlan { interpolates: Attributes(bits), ..PiecePlan::default() };
            parts.are_checked(&piece(sides), plan)
        };
        assert!(are_checked([64, 64], Attributes::UV));
        assert!(!are_checked([64, 64], Attributes::NORMAL), "no square has less than a normal");
        assert!(!are_checked([32, 32], Attributes::UV), "small");
    }

    #[test]
    fn fragments_lie_between_the_corners_of_their_square() {
        let right: Corners = |whole, shares| whole.square(shares);
        let [seen, wrong] = tried(right);
        assert!(seen > 90_000 && wrong == 0, "{seen}, {wrong}");
        // Wrong ones: three corners of the four, all corners nearer to the middle, and attributes that are linear in the window.
        let three: Corners = |whole, [a, b, c, _]| whole.square([a, b, c, c]);
        let inner: Corners = |whole, shares| {
            let middle = |i: usize| shares.iter().map(|own| own[i]).sum::<f64>() / 4.0;
            let middle = [middle(0), middle(1), middle(2)];
            whole.square(
                shares.map(|own| [0, 1, 2].map_array(|i: usize| 0.8 * own[i] + 0.2 * middle[i])),
            )
        };
        let linear: Corners = |whole, shares| {
            let linear = Whole { inv_w: [1.0; 3], ..*whole };
            linear.square(shares)
        };
        for (number, corners) in [three, inner, linear].into_iter().enumerate() {
            assert!(tried(corners)[1] > 0, "wrong corners {number} survive");
        }
    }
}
