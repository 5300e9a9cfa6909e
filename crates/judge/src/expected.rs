//! The exact picture of a triangle under a declared sample point, rule and winding.
//!
//! The four half-open rules are the oracle's top-left rule in a mirror: a triangle and its samples
//! mirrored left to right are drawn by the top-right rule exactly where the top-left rule draws the
//! mirror image. Another sample point is the triangle moved the other way. Which samples lie strictly
//! inside, and which inside or on the edge, is decided by the signs of three edge functions in wide
//! integers, here and in no engine.

use super::declared::{Declared, Rule, Winding};
use rasterproof_core::contract::Rasterize as _;
use rasterproof_core::grid::{HALF_PIXEL, PixelRect, SUBPIXELS, SubpixelPoint};
use rasterproof_core::triangle::{Corners, PixelPoint, Span};
use rasterproof_verify::cases::Triangle;
use rasterproof_verify::cases::named::plain_line;
use rasterproof_verify::oracle::Oracle;
use rasterproof_verify::oracle::values::ExactTriangle;

/// The picture that is expected: every pixel of `must`, no pixel outside `may`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Picture {
    /// Runs of pixels that have to be hit once.
    pub must: Vec<Span>,
    /// Runs of pixels that may be hit once, where they are more than those of `must`.
    pub may: Option<Vec<Span>>,
}

/// Knows what is expected of a triangle.
pub trait Expect: Send + Sync {
    /// The picture in a window at the origin; nothing where nothing is promised.
    fn picture(&self, corners: &Corners, window: PixelRect) -> Option<Picture>;

    /// The pixels of a line in drawing order; nothing where nothing is promised.
    fn line(&self, ends: &[PixelPoint; 2], window: PixelRect) -> Option<Vec<(i32, i32)>>;

    /// How far depth and both attributes may be off at a pixel; nothing where the declared tolerance
    /// is meant.
    fn bounds(&self, _triangle: &Triangle, _pixel: (i32, i32)) -> Option<[f64; 3]> {
        None
    }

    /// Whether the pixels of a line are expected in that order.
    fn keeps_order(&self) -> bool {
        true
    }
}

/// The expectation of a declaration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Declaration {
    /// The rule as it is seen with y down.
    pub rule: Rule,
    /// The windings as they are seen with y down.
    pub winding: Winding,
    /// The sample, in subpixels from the pixel's upper left corner.
    pub origin: [i32; 2],
}

impl From<&Declared> for Declaration {
    fn from(declared: &Declared) -> Self {
        let (rule, winding) = (declared.seen_rule(), declared.seen_winding());
        Self { rule, winding, origin: declared.origin }
    }
}

/// Twice the area, positive where the corners run clockwise on a screen with y down.
#[must_use]
pub fn area2(&[a, b, c]: &Corners) -> i128 {
    edge(a, b, c)
}

fn edge(a: SubpixelPoint, b: SubpixelPoint, p: SubpixelPoint) -> i128 {
    // Written out, not mapped: this is asked of every triangle, in a crate that inlines little.
    let (dx, dy) = (i64::from(b.x) - i64::from(a.x), i64::from(b.y) - i64::from(a.y));
    let (px, py) = (i64::from(p.x) - i64::from(a.x), i64::from(p.y) - i64::from(a.y));
    i128::from(dx) * i128::from(py) - i128::from(dy) * i128::from(px)
}

impl Declaration {
    /// Whether a triangle of this area is drawn at all; nothing of a degenerate one is.
    #[must_use]
    pub fn draws(&self, area: i128) -> bool {
        match self.winding {
            Winding::Clockwise => area > 0,
            Winding::CounterClockwise => area < 0,
            Winding::Both => true,
        }
    }

    /// The triangle moved so that its samples lie at the centres.
    #[must_use]
    pub fn centred(&self, corners: &Corners) -> Corners {
        let [x, y] = self.origin.map(|origin| HALF_PIXEL - origin);
        corners.map(|p| SubpixelPoint::new(p.x.saturating_add(x), p.y.saturating_add(y)))
    }
}

impl Expect for Declaration {
    fn picture(&self, corners: &Corners, window: PixelRect) -> Option<Picture> {
        let area = area2(corners);
        if area == 0 && matches!(self.rule, Rule::Inclusive | Rule::Unspecified) {
            return None;
        }
        if area == 0 || !self.draws(area) {
            return Some(Picture::default());
        }
        let corners = self.centred(corners);
        let half_open = |x, y| Some(Picture { must: mirrored(&corners, window, x, y), may: None });
        match self.rule {
            Rule::TopLeft => half_open(false, false),
            Rule::TopRight => half_open(true, false),
            Rule::BottomLeft => half_open(false, true),
            Rule::BottomRight => half_open(true, true),
            Rule::Strict => Some(Picture { must: by_edges(&corners, window, false), may: None }),
            Rule::Inclusive => Some(Picture { must: by_edges(&corners, window, true), may: None }),
            Rule::Unspecified => {
                let may = by_edges(&corners, window, true);
                Some(Picture { must: by_edges(&corners, window, false), may: Some(may) })
            }
        }
    }

    fn line(&self, ends: &[PixelPoint; 2], window: PixelRect) -> Option<Vec<(i32, i32)>> {
        let line = plain_line(ends[0], ends[1]);
        let mut pixels = Vec::new();
        Oracle.line_pixels(&line, window, |pixel, _| pixels.push((pixel.x, pixel.y)));
        Some(pixels)
    }
}

/// The exact values at the declared sample; w is the one that the request names.
#[must_use]
pub fn exact_values(triangle: &Triangle, declared: &Declared) -> Option<ExactTriangle<2>> {
    let corners = Declaration::from(declared).centred(&triangle.corners());
    let v = &triangle.vertices;
    let inv_w = v.map(|v| 1.0 / (1.0 / v.inv_w));
    ExactTriangle::new(&corners, v.map(|v| v.depth), inv_w, v.map(|v| v.varying.to_array()))
}

/// What the oracle draws of the mirror image, mirrored back.
fn mirrored(corners: &Corners, window: PixelRect, in_x: bool, in_y: bool) -> Vec<Span> {
    // About the middle of the window, so that it is its own image.
    let flip = |sub: i32, size_px: u32| {
        let far = size_px as i32 * SUBPIXELS;
        far.saturating_sub(sub)
    };
    let (width, height) = (window.width(), window.height());
    let image = corners.map(|p| {
        let x = if in_x { flip(p.x, width) } else { p.x };
        SubpixelPoint::new(x, if in_y { flip(p.y, height) } else { p.y })
    });
    let mut runs = Vec::new();
    Oracle.cover(image, window, |span| {
        let (x0_px, x1_px) = if in_x {
            (width as i32 - span.x1_px, width as i32 - span.x0_px)
        } else {
            (span.x0_px, span.x1_px)
        };
        let y_px = if in_y { height as i32 - 1 - span.y_px } else { span.y_px };
        runs.push(Span { y_px, x0_px, x1_px });
    });
    if in_y {
        runs.reverse();
    }
    runs
}

/// Pixels whose centres lie inside, or with `closed` also on the boundary.
fn by_edges(corners: &Corners, window: PixelRect, closed: bool) -> Vec<Span> {
    let [a, mut b, mut c] = *corners;
    if area2(corners) < 0 {
        (b, c) = (c, b);
    }
    let least = i128::from(!closed);
    let px = |sub: i32| sub.div_euclid(SUBPIXELS);
    let range = |v: [i32; 3]| {
        (v.into_iter().min().map_or(0, px), v.into_iter().max().map_or(0, px).saturating_add(1))
    };
    let ((x0, x1), (y0, y1)) = (range([a.x, b.x, c.x]), range([a.y, b.y, c.y]));
    let rect = PixelRect { x0, y0, x1, y1 }.intersect(&window);
    let mut runs: Vec<Span> = Vec::new();
    for y_px in rect.y0..rect.y1 {
        for x_px in rect.x0..rect.x1 {
            let at = |px: i32| px * SUBPIXELS + HALF_PIXEL;
            let p = SubpixelPoint::new(at(x_px), at(y_px));
            if edge(a, b, p) >= least && edge(b, c, p) >= least && edge(c, a, p) >= least {
                match runs.last_mut() {
                    Some(run) if run.y_px == y_px && run.x1_px == x_px => run.x1_px += 1,
                    _ => runs.push(Span { y_px, x0_px: x_px, x1_px: x_px + 1 }),
                }
            }
        }
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasterproof_verify::cases::{self, Shape};

    const WINDOW: PixelRect = PixelRect::window(8, 8);

    fn px(points: [(f64, f64); 3]) -> Corners {
        points.map(|(x, y)| SubpixelPoint::from_px(x, y).unwrap())
    }

    fn declaration(rule: Rule) -> Declaration {
        Declaration { rule, winding: Winding::Both, origin: [HALF_PIXEL; 2] }
    }

    fn pixels(runs: &[Span]) -> Vec<(i32, i32)> {
        runs.iter().flat_map(|r| (r.x0_px..r.x1_px).map(|x| (x, r.y_px))).collect()
    }

    fn drawn(declaration: Declaration, corners: &Corners) -> Vec<(i32, i32)> {
        pixels(&declaration.picture(corners, WINDOW).unwrap().must)
    }

    /// The triangle (0.5, 0.5) (2.5, 0.5) (0.5, 2.5) has one sample of its own at no corner and on
    /// no edge: none. Three are corners, (1.5, 0.5) lies on the top edge, (0.5, 1.5) on the left one,
    /// (1.5, 1.5) on the slope, which is a right edge. Worked out on paper.
    #[test]
    fn rules_by_hand() {
        let triangle = px([(0.5, 0.5), (2.5, 0.5), (0.5, 2.5)]);
        let expected: [(Rule, &[(i32, i32)]); 6] = [
            (Rule::TopLeft, &[(0, 0), (1, 0), (0, 1)]),
            (Rule::TopRight, &[(1, 0), (2, 0), (1, 1)]),
            (Rule::BottomLeft, &[(0, 1)]),
            (Rule::BottomRight, &[(1, 1)]),
            (Rule::Strict, &[]),
            (Rule::Inclusive, &[(0, 0), (1, 0), (2, 0), (0, 1), (1, 1), (0, 2)]),
        ];
        for (rule, pixels) in expected {
            let mut pixels = pixels.to_vec();
            pixels.sort_by_key(|(x, y)| (*y, *x));
            assert_eq!(drawn(declaration(rule), &triangle), pixels, "{rule:?}");
        }
        let open = declaration(Rule::Unspecified).picture(&triangle, WINDOW).unwrap();
        assert!(open.must.is_empty() && pixels(&open.may.unwrap()).len() == 6);
    }

    #[test]
    fn origin_and_winding_by_hand() {
        // The same triangle with its corners on whole pixels, sampled there.
        let whole = px([(0.0, 0.0), (2.0, 0.0), (0.0, 2.0)]);
        let at_corner = Declaration { origin: [0, 0], ..declaration(Rule::TopLeft) };
        assert_eq!(drawn(at_corner, &whole), [(0, 0), (1, 0), (0, 1)]);
        let clockwise = Declaration { winding: Winding::Clockwise, ..at_corner };
        assert_eq!(drawn(clockwise, &whole).len(), 3);
        let [a, b, c] = whole;
        assert_eq!(drawn(clockwise, &[a, c, b]).len(), 0);
        let flat = px([(0.5, 0.5), (2.5, 2.5), (5.5, 5.5)]);
        assert_eq!(drawn(declaration(Rule::Strict), &flat), []);
        assert_eq!(declaration(Rule::Inclusive).picture(&flat, WINDOW), None);
    }

    /// Strictly inside is what opposite half-open rules agree on; what any of them draws is closed.
    #[test]
    fn rules_agree_with_each_other() {
        let families = ["half-integer", "near-tie", "sliver", "partly-off", "huge"];
        let mut on_edges = 0;
        for family in cases::families().filter(|f| families.contains(&f.name)) {
            for index in 0..40 {
                let case = family.case(3, index);
                let Shape::Triangles { list, .. } = case.shape else { continue };
                // Mirroring needs room at the end of the domain.
                let room = |v: i32| v.clamp(i32::MIN / 2, i32::MAX / 2);
                let corners = list[0].corners().map(|p| SubpixelPoint::new(room(p.x), room(p.y)));
                if area2(&corners) == 0 {
                    continue;
                }
                let sorted = |rule: Rule| {
                    let must = declaration(rule).picture(&corners, case.window).unwrap().must;
                    pixels(&must)
                };
                let (tl, br) = (sorted(Rule::TopLeft), sorted(Rule::BottomRight));
                let (tr, bl) = (sorted(Rule::TopRight), sorted(Rule::BottomLeft));
                let (strict, closed) = (sorted(Rule::Strict), sorted(Rule::Inclusive));
                let both = |p: &&(i32, i32)| br.contains(p);
                assert_eq!(strict, tl.iter().filter(both).copied().collect::<Vec<_>>());
                for rule in [&tl, &br, &tr, &bl] {
                    assert!(rule.iter().all(|p| closed.contains(p)));
                    assert!(strict.iter().all(|p| rule.contains(p)));
                }
                on_edges += closed.len() - strict.len();
            }
        }
        assert!(on_edges > 100, "{on_edges}");
    }
}
