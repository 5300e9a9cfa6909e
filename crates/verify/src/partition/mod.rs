//! Judges a tessellator: whether the triangles that it makes of a polygon cover the polygon exactly once.
//!
//! ```
//! use rasterproof_verify::partition::{Family, Options, Polygon, Triangle};
//!
//! /// A fan around the first vertex, right where the polygon is convex.
//! fn fan(polygon: &Polygon) -> Vec<Triangle> {
//!     let vertices = &polygon.contours[0];
//!     (2..vertices.len()).map(|i| [vertices[0], vertices[i - 1], vertices[i]]).collect()
//! }
//! let options = Options::default().cases(20).family(Family::Star);
//! let report = rasterproof_verify::partition::judge_partitions(&fan, &options)?;
//! println!("{}", report.check().unwrap_err()); // the smallest polygon, its triangles and what is wrong with them
//! # Ok::<(), rasterproof_verify::comparison::NothingJudged>(())
//! ```
//!
//! [`assert_partition!`](crate::assert_partition) does this in one line of a test. [`judge_partition`] is for one polygon of yours.
//!
//! # Which polygons are valid
//!
//! A [`Polygon`] is a list of closed contours. The [`FillRule`] says which points are inside: those around which the
//! contours run an odd number of times (the default), or a number of times that is not zero. Either direction of a
//! contour is valid. Coordinates are finite, and edges meet only at vertices of the polygon, or along each other: two edges that
//! cross elsewhere are an error, [`InvalidPolygon`], because their crossing is seldom a point that floating-point numbers can name.
//! Everything else is valid: repeated vertices, edges that come back the same way, contours that touch themselves or
//! others at vertices or along edges, and contours with fewer than three vertices, which enclose nothing.
//!
//! Coordinates are `f64` and exact. There is no tolerance. An `f32` is converted without a change.
//!
//! # What is decided
//!
//! Write *c*(*x*) for the number of triangles that contain the point *x*, and *r*(*x*) for 1 inside the region and 0 outside. The
//! triangles are a partition if *c* = *r* at every point that is on no edge. Four kinds of triangles spoil it:
//! [`FaultKind::Overlap`] (*c* > 1 inside), [`FaultKind::Gap`] (*c* = 0 inside), [`FaultKind::Outside`] (*c* > 0 outside). A triangle that
//! has another orientation than [`Options::winding`] declares is [`FaultKind::Flipped`], whatever it covers.
//!
//! Beside these there is [`FaultKind::TJunction`]: *c* = *r* holds, but a corner of a triangle or a vertex of the boundary lies
//! inside an edge of a triangle. As long as coordinates are exact, nothing is wrong. As soon as corners are rounded,
//! for instance to the grid of a rasterizer, that corner moves off the edge, and a slit opens. A triangle
//! without area, [`FaultKind::Degenerate`], covers nothing. Both are faults unless
//! [`Options::allow_t_junctions`] or [`Options::allow_degenerate_triangles`] declares that they are allowed.
//!
//! Points that the tessellator adds (Steiner points) are allowed inside the region, and counted in [`Faults::added_points`]. On the
//! boundary they lie exactly on an edge, or there is a gap or an overlap; and there they are T-junctions, since a neighbour of the polygon does not
//! have them.
//!
//! # Why cancelling edges decides it
//!
//! **Signs.** The orientation of a triangle (a, b, c) is the sign of (b - a) × (c - a), computed exactly. It says which triangles are
//! flipped or have no area. From here on every triangle with an area is turned counterclockwise, so that its winding number is 1 inside it and 0 outside. Then *c*
//! is the sum of the winding numbers of all triangles.
//!
//! **The boundary.** Contours are cut at all vertices that lie on them. No two of the resulting pieces cross, as the polygon is valid. So the winding
//! number of the contours is constant along each side of a piece, and orientations of vertices are enough to compute it:
//! go straight down from a point beside the piece, and add up the pieces that are passed, those running to the right as 1
//! and those running to the left as -1. The boundary consists of the pieces with the region on one side only, and each of
//! them is directed so that the region is on its left. Its winding number is *r*.
//!
//! **Cancelling.** Let *D* be the collection of all directed edges of the triangles and of the boundary's edges, reversed. Its winding number
//! at *x* is *c*(*x*) - *r*(*x*). On each line, add up the edges of *D* at each point, those in one direction as 1 and those in the
//! other as -1. Crossing the line at that point changes the winding number by this sum. Therefore:
//!
//! - If every sum is 0, the winding number never changes. It is 0 far away, so it is 0 everywhere, and *c* = *r*.
//! - If a sum is not 0, *c* - *r* differs on the two sides of the line there. It is not 0 on one of them at least, and *c* ≠ *r*.
//!
//! Sums change only at ends of edges. So the sums are compared on the pieces between neighbouring ends on one line, and that
//! needs no point that is not given: whether ends are on a line is a sign, and their order along it is a comparison of
//! coordinates. Where a sum is not 0, the two sides are looked at next to one point of the piece, in whole numbers of any size: how many
//! triangles and which, inside or outside. This tells overlaps and gaps from each other.
//!
//! **T-junctions.** First, edges between the same two points are cancelled. If nothing remains, the sums are 0 for a
//! reason that survives any movement of points: edges that cancel have the same ends, and still have them after both have moved. The moved triangles,
//! counted with the signs that they have then, cover every point as often as the moved boundary runs around it. If
//! something remains but every sum is 0, an edge is balanced by two or more shorter ones. Then an end of one edge lies inside
//! another, and this is a T-junction. A triangle without area takes part in this step, as its edges may close the slit.
//!
//! # What is generated
//!
//! [`Family`] lists the families of polygons. A failing polygon is shrunk: contours and vertices are removed and coordinates
//! get fewer digits, as long as a fault of the same kind remains. A tessellator that panics has that as its fault; one that does
//! not return, or that overflows the stack, ends the test with it.

mod cause;
mod decide;
#[doc(hidden)]
pub mod design;
mod exact;
mod families;
mod region;
mod report;
mod shrink;

use std::cmp::Ordering;
use std::error::Error;
use std::fmt;

use crate::judge;
pub use families::{Coordinates, Family};
pub use region::InvalidPolygon;
pub use report::{
    Disagreement, Failure, Polygons, Triangulated, Verdict, judge_partitions, judge_partitions_of,
    must_partition,
};

/// A point: x, then y.
pub type Point = [f64; 2];

/// A triangle by its corners.
pub type Triangle = [Point; 3];

/// Closed contours: the last vertex of each is connected to its first.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    /// The vertices of each contour.
    pub contours: Vec<Vec<Point>>,
}

impl Polygon {
    /// The polygon of these contours.
    #[must_use]
    pub fn new(contours: Vec<Vec<Point>>) -> Self {
        Self { contours }
    }
}

impl fmt::Display for Polygon {
    /// As Rust writes it, so that it can be pasted.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Polygon::new(vec![")?;
        for (number, contour) in self.contours.iter().enumerate() {
            let comma = if number > 0 { ", " } else { "" };
            write!(f, "{comma}vec!{contour:?}")?;
        }
        write!(f, "])")
    }
}

/// Which points are inside the contours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum FillRule {
    /// Those around which the contours run an odd number of times.
    #[default]
    EvenOdd,
    /// Those around which the contours run more often in one direction than in the other.
    NonZero,
}

impl FillRule {
    fn fills(self, rounds: i64) -> bool {
        match self {
            Self::EvenOdd => rounds % 2 != 0,
            Self::NonZero => rounds != 0,
        }
    }
}

/// The orientation that a tessellator gives its triangles, where y points up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Winding {
    /// The same for all triangles of a polygon, either of the two.
    #[default]
    Alike,
    /// Counterclockwise.
    Counterclockwise,
    /// Clockwise.
    Clockwise,
    /// Not stated: no triangle counts as flipped.
    Any,
}

/// Makes triangles of polygons. Closures that return the triangles implement it.
pub trait Tessellate {
    /// The triangles of a polygon.
    ///
    /// # Errors
    /// The tessellator refuses the polygon, and says why. The polygon is a valid one, so this counts as a fault.
    fn triangles(&self, polygon: &Polygon) -> Result<Vec<Triangle>, Refused>;

    /// Whether the tessellator promises anything about a polygon. Valid polygons without a promise are counted as
    /// [`Polygons::left_out`], and not judged.
    fn accepts(&self, polygon: &Polygon) -> bool {
        let _ = polygon;
        true
    }
}

impl<F: Fn(&Polygon) -> Vec<Triangle>> Tessellate for F {
    fn triangles(&self, polygon: &Polygon) -> Result<Vec<Triangle>, Refused> {
        Ok(self(polygon))
    }
}

/// What a tessellator says when it refuses a polygon.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refused(pub String);

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl Error for Refused {}

/// What is judged, and what the tessellator declares.
pub type Options = judge::Options<Family, Tessellation>;

/// What a tessellator promises.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Tessellation {
    /// Which points are inside.
    pub fill_rule: FillRule,
    /// The orientation of the triangles.
    pub winding: Winding,
    /// Which numbers the tessellator takes.
    pub coordinates: Coordinates,
    /// Whether a corner may lie inside an edge of another triangle.
    pub t_junctions: bool,
    /// Whether a triangle may have no area.
    pub degenerate: bool,
}

impl judge::Terms for Tessellation {
    const CASES: u64 = 2_000;
}

impl Options {
    /// The same with another fill rule.
    #[must_use]
    pub fn fill_rule(mut self, fill_rule: FillRule) -> Self {
        self.terms.fill_rule = fill_rule;
        self
    }

    /// The same with another orientation of the triangles.
    #[must_use]
    pub fn winding(mut self, winding: Winding) -> Self {
        self.terms.winding = winding;
        self
    }

    /// The same with coordinates that the tessellator takes without rounding them.
    #[must_use]
    pub fn coordinates(mut self, coordinates: Coordinates) -> Self {
        self.terms.coordinates = coordinates;
        self
    }

    /// The same, but a corner inside an edge of another triangle is no fault.
    #[must_use]
    pub fn allow_t_junctions(mut self) -> Self {
        self.terms.t_junctions = true;
        self
    }

    /// The same, but a triangle without area is no fault.
    #[must_use]
    pub fn allow_degenerate_triangles(mut self) -> Self {
        self.terms.degenerate = true;
        self
    }

    fn allows(&self, kind: FaultKind) -> bool {
        match kind {
            FaultKind::TJunction => self.terms.t_junctions,
            FaultKind::Degenerate => self.terms.degenerate,
            _ => false,
        }
    }
}

rasterproof_core::named! {
    /// What can be wrong with the triangles of a polygon. Grave ones come first.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
    #[non_exhaustive]
    pub enum FaultKind {
        /// The tessellator panicked.
        Panicked = "panic",
        /// The tessellator refused a valid polygon.
        Refused = "refused",
        /// A corner of a triangle is infinite or not a number.
        NotFinite = "not finite",
        /// Points inside are in two or more triangles.
        Overlap = "overlap",
        /// Points inside are in no triangle.
        Gap = "gap",
        /// Points outside are in a triangle.
        Outside = "outside",
        /// A triangle has another orientation than declared.
        Flipped = "flipped",
        /// A corner of a triangle, or a vertex of the boundary, lies inside an edge of a triangle.
        TJunction = "T-junction",
        /// The corners of a triangle lie on one line.
        Degenerate = "degenerate",
    }
}

impl FaultKind {
    /// What is said of polygons by their gravest fault.
    pub(crate) fn says(self) -> &'static str {
        match self {
            Self::Panicked => "make it panic",
            Self::Refused => "are refused or not answered",
            Self::NotFinite | Self::Overlap | Self::Gap | Self::Outside => {
                "are not covered exactly once"
            }
            Self::Flipped => "have triangles that turn the other way",
            Self::TJunction => "have T-junctions",
            Self::Degenerate => "have triangles without area",
        }
    }
}

/// One thing that is wrong with the triangles of a polygon.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Fault {
    /// What it is.
    pub kind: FaultKind,
    /// The triangles that it concerns, numbered from 0 in the order of the tessellator.
    pub triangles: Vec<usize>,
    /// A point of an overlap, of a gap or outside, rounded; the corners of a triangle; of a T-junction the corner and
    /// then the ends of the edge.
    pub points: Vec<Point>,
    /// The message of a panic or a refusal.
    pub said: Option<String>,
}

impl Fault {
    fn of_triangle(kind: FaultKind, number: usize, corners: &Triangle) -> Self {
        Self { kind, triangles: vec![number], points: corners.to_vec(), said: None }
    }

    fn saying(kind: FaultKind, said: String) -> Self {
        Self { kind, triangles: Vec::new(), points: Vec::new(), said: Some(said) }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let said = self.said.as_deref().unwrap_or("");
        let at = |i: usize| self.points.get(i).map_or(String::new(), |point| format!("{point:?}"));
        let numbers: Vec<_> = self.triangles.iter().map(usize::to_string).collect();
        let numbers = numbers.join(", ");
        match self.kind {
            FaultKind::Panicked => write!(f, "panic: {said}"),
            FaultKind::Refused => write!(f, "refused: {said}"),
            FaultKind::NotFinite => write!(f, "not finite: triangle {numbers}"),
            FaultKind::Overlap => {
                let times = self.triangles.len();
                write!(
                    f,
                    "overlap: the surroundings of {} are covered {times} times, by triangles {numbers}",
                    at(0)
                )
            }
            FaultKind::Gap => {
                write!(f, "gap: the surroundings of {} are covered by no triangle", at(0))
            }
            FaultKind::Outside => {
                let s = if self.triangles.len() == 1 { "" } else { "s" };
                write!(
                    f,
                    "outside: the surroundings of {} are covered by triangle{s} {numbers}",
                    at(0)
                )
            }
            FaultKind::Flipped => {
                write!(f, "flipped: triangle {numbers} turns the other way than declared")
            }
            FaultKind::TJunction => {
                write!(f, "T-junction: {} is inside the edge from {} to {}", at(0), at(1), at(2))
            }
            FaultKind::Degenerate => write!(f, "degenerate: triangle {numbers} has no area"),
        }
    }
}

/// What was found about the triangles of one polygon.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
#[must_use]
pub struct Faults {
    /// What is wrong.
    pub faults: Vec<Fault>,
    /// What would be wrong if it were not allowed.
    pub allowed: Vec<Fault>,
    /// How many corners of triangles are no vertices of the polygon.
    pub added_points: usize,
}

impl Faults {
    /// Nothing, or what a failing test has to print.
    ///
    /// # Errors
    /// The finding itself, where anything is wrong.
    pub fn check(self) -> Result<(), Self> {
        if self.faults.is_empty() { Ok(()) } else { Err(self) }
    }

    fn has(&self, kind: FaultKind) -> bool {
        self.faults.iter().any(|fault| fault.kind == kind)
    }

    /// Whether there are triangles that can be wrong: no panic, and no refusal.
    fn is_of_an_answer(&self) -> bool {
        !self.has(FaultKind::Panicked) && !self.has(FaultKind::Refused)
    }

    fn add(&mut self, fault: Fault, options: &Options) {
        let list = if options.allows(fault.kind) { &mut self.allowed } else { &mut self.faults };
        list.push(fault);
    }
}

/// Faults that a message lists.
const MOST_SHOWN: usize = 8;

impl fmt::Display for Faults {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.faults.is_empty() {
            return f.write_str("the triangles cover the polygon exactly once");
        }
        let lines: Vec<_> = self.faults.iter().take(MOST_SHOWN).map(Fault::to_string).collect();
        f.write_str(&lines.join("\n"))?;
        match self.faults.len().saturating_sub(MOST_SHOWN) {
            0 => Ok(()),
            more => write!(f, "\nand {more} more faults"),
        }
    }
}

impl Error for Faults {}

/// Decides whether triangles cover a polygon exactly once. Of `options`, it uses what the tessellator declares.
///
/// # Errors
/// The polygon is not a valid one.
pub fn judge_partition(
    polygon: &Polygon,
    triangles: &[Triangle],
    options: &Options,
) -> Result<Faults, InvalidPolygon> {
    let region = region::region(polygon, options.terms.fill_rule)?;
    let mut finding = decide::decide(&region.boundary, triangles, options);
    let given = distinct(polygon.contours.as_slice());
    for point in distinct(&[triangles.as_flattened()]) {
        if given.binary_search_by(|other| order(other, &point)).is_err() {
            finding.added_points += 1;
        }
    }
    Ok(finding)
}

/// All points of some lists in order, each once.
fn distinct<L: AsRef<[Point]>>(lists: &[L]) -> Vec<Point> {
    let mut points = all_points(lists);
    points.dedup();
    points
}

/// All points of some lists in order.
fn all_points<L: AsRef<[Point]>>(lists: &[L]) -> Vec<Point> {
    let mut points = Vec::new();
    for list in lists {
        for point in list.as_ref() {
            points.push(key(*point));
        }
    }
    points.sort_unstable_by(order);
    points
}

/// The edges of a contour, from each vertex to the next one.
fn edges_of(contour: &[Point]) -> impl Iterator<Item = [Point; 2]> + '_ {
    contour.iter().enumerate().map(|(i, a)| [*a, contour[(i + 1) % contour.len()]])
}

/// The least of some coordinates and the largest; of none, the one is above the other.
fn ends_of(points: &[Point], axis: usize) -> [f64; 2] {
    let [mut least, mut most] = [f64::INFINITY, f64::NEG_INFINITY];
    for point in points {
        (least, most) = (least.min(point[axis]), most.max(point[axis]));
    }
    [least, most]
}

/// The point without a negative zero, so that equal points have the same bits.
fn key(point: Point) -> Point {
    [point[0] + 0.0, point[1] + 0.0]
}

/// By x, then by y.
fn order(a: &Point, b: &Point) -> Ordering {
    a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1]))
}

#[cfg(test)]
mod tests;
