//! What the near plane leaves of a triangle, as a clipper that may be mistaken.

use super::search::{Composed as _, Field, Quantity, Stage, choices, composed};
use crate::ask::{Answer, Question};
use crate::declared::Declared;
use crate::near_plane::{asked, bounds, is_round};
use rasterproof_verify::cases::near_plane::{ClipCorner, clip_corners};
use rasterproof_verify::mistakes::{Format, MistakeId};

composed! {
    /// A clipper at the near plane.
    pub struct NearCut {
        divided: Divided,
        plane: Plane,
        kept: KeptCorners,
        new: New,
        part: Part,
        counted: EdgeStart,
        order: Order,
        numbers: Numbers,
        edges: Edges,
    }
}

choices! {
    /// Whether corners are divided by w, and when.
    pub enum Divided: "a division by w", "clip in clip space, and leave the division to the stage after it" {
        Not,
        Before = "divides x, y, z and w of each corner by its own w before it clips",
        After = "divides x, y, z and w by w where only the clipped polygon should be divided",
    }
}

/// The plane: what is kept has z, w and 1, times these numbers, of at least 0 in sum.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Plane {
    /// The one that is declared.
    #[default]
    Near,
    /// Any plane, by its three coefficients.
    At([f64; 3]),
    /// z = -|w|.
    Unsigned,
}

impl Plane {
    /// How far a corner lies before the plane, below 0 behind it. `is_zero` says which plane is declared.
    fn distance(self, [_, _, z, w, _]: ClipCorner, is_zero: bool) -> f64 {
        match self {
            Self::Near => z + if is_zero { 0.0 } else { w },
            Self::At([a, b, c]) => a * z + b * w + c,
            Self::Unsigned => z + w.abs(),
        }
    }
}

impl Field for Plane {
    const NAME: &'static str = "the near plane";

    fn options() -> Vec<Self> {
        // z = -w and z = 0 may be the one that is declared, and differ from it where they are not.
        let mut all = vec![Self::Unsigned];
        for k in 0..27 {
            let [z, w, one] = [k / 9, k / 3 % 3, k % 3].map(|digit| f64::from(digit - 1));
            if z != 0.0 || w != 0.0 {
                all.push(Self::At([z, w, one]));
            }
        }
        all
    }

    fn says(&self) -> Option<(String, &'static str)> {
        // Whatever plane it is, the repair is the same.
        let repair = "clip at the near plane that is declared";
        let [z, w, c] = match *self {
            Self::Near => return None,
            Self::Unsigned => {
                return Some((
                    "clips to z >= -|w|: the sign of w is lost".to_owned(),
                    "clip to z >= -w, and keep the sign of w",
                ));
            }
            Self::At(plane) => plane,
        };
        // The plane is said by z, or by w where z has no part in it.
        let (of, by) = if z == 0.0 { ("w", w) } else { ("z", z) };
        let sign = if by > 0.0 { ">=" } else { "<=" };
        let rest = |v: f64| (-v / by * 1e6).round() / 1e6 + 0.0;
        // What it is compared with: a multiple of w and a number.
        let times_w = match rest(w) {
            _ if z == 0.0 => None,
            0.0 => None,
            1.0 => Some("w".to_owned()),
            -1.0 => Some("-w".to_owned()),
            by => Some(format!("{by} w")),
        };
        let at = match (times_w, rest(c)) {
            (None, c) => format!("{c}"),
            (Some(w), 0.0) => w,
            (Some(w), c) => format!("{w} {} {}", if c < 0.0 { "-" } else { "+" }, c.abs()),
        };
        // The planes that people take by mistake have names.
        let known = match *self {
            Self::At([1.0, 0.0, 0.0]) => ", as Direct3D and Vulkan have it",
            Self::At([1.0, 1.0, 0.0]) => ", as OpenGL has it",
            Self::At([-1.0, 1.0, 0.0]) => ", the far plane",
            Self::At([-1.0, -1.0, 0.0]) => ": it keeps the part behind",
            _ => "",
        };
        Some((format!("clips to {of} {sign} {at}{known}"), repair))
    }
}

/// Which triangles are clipped, and what becomes of the others.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum KeptCorners {
    #[default]
    Clipped,
    /// Nothing is cut, and nothing dropped.
    All,
    /// Every triangle is dropped.
    Nothing,
    /// What has no corner behind.
    Whole,
    /// What has a corner before.
    Seen,
    /// Corners behind are moved onto the plane; what lies wholly behind is left out, or not.
    Clamped { is_culled: bool },
}

/// What becomes of triangles, with its words and the repair.
const KEPT: [(KeptCorners, &str, &str); 6] = [
    (KeptCorners::Nothing, "drops the triangle", "keep the part before the plane"),
    (KeptCorners::All, MistakeId::NotClipped.name(), "clip at the near plane before the division"),
    (KeptCorners::Whole, MistakeId::CutTrianglesDropped.name(), "keep the part before the plane"),
    (
        KeptCorners::Seen,
        "drops triangles that lie wholly behind and clips no others",
        "cut what crosses the plane",
    ),
    (
        KeptCorners::Clamped { is_culled: false },
        "moves corners behind the plane onto it (clamps z) and cuts nothing",
        "divide the edges",
    ),
    (
        KeptCorners::Clamped { is_culled: true },
        "moves corners behind the plane onto it (clamps z) and cuts nothing, and drops what lies wholly behind",
        "divide the edges",
    ),
];

impl Field for KeptCorners {
    const NAME: &'static str = "what is clipped";

    fn options() -> Vec<Self> {
        KEPT.iter().map(|(kept, ..)| *kept).collect()
    }

    fn says(&self) -> Option<(String, &'static str)> {
        let (_, does, repair) = KEPT.iter().find(|(kept, ..)| kept == self)?;
        Some(((*does).to_owned(), repair))
    }
}

/// What repairs a new corner, whichever of its numbers is wrong.
const NEW_REPAIR: &str = "a new corner divides the edge as the distances of its ends do, in all of x, y, z, w and attributes";

/// The part of the way from the corner that stays to the one that goes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Part {
    #[default]
    Right,
    /// The right part in fewer bits.
    Kept(Format),
    /// Counted from the other end.
    Back,
    /// The square of the right part, which is smaller.
    Squared,
    /// The right part, or 1/2 where it is more.
    AtMostHalf,
    /// The right part, or 1/2 where it is less.
    AtLeastHalf,
    /// Of the sum of the distances.
    OfSum,
    /// By other distances: z, w, and that after the division.
    ByZ,
    ByW,
    Divided,
}

/// The parts, with their words.
const PARTS: [(Part, &str); 8] = [
    (Part::Back, "a part that is counted from the wrong end (t is 1 - t)"),
    (Part::Squared, "a part that is squared"),
    (Part::AtMostHalf, "a part that is 1/2 at most"),
    (Part::AtLeastHalf, "a part that is 1/2 at least"),
    (Part::OfSum, "a part of the sum of the distances, where their difference is right"),
    (Part::ByZ, "z alone, as if the plane were z = 0"),
    (Part::ByW, "w alone, as if the plane were w = 0"),
    (Part::Divided, "distances after the division by w"),
];

impl Field for Part {
    const NAME: &'static str = "the part of an edge";

    fn options() -> Vec<Self> {
        let formats = Format::options().into_iter().map(Self::Kept);
        PARTS.iter().map(|(part, _)| *part).chain(formats).collect()
    }

    fn says(&self) -> Option<(String, &'static str)> {
        let part = match self {
            Self::Kept(format) => format!("a part that is kept in {format}"),
            part => (*PARTS.iter().find(|(known, _)| known == part)?.1).to_owned(),
        };
        Some((format!("divides {{}} of an edge by {part}"), NEW_REPAIR))
    }
}

choices! {
    /// From where the part is counted.
    pub enum EdgeStart: "the end of an edge",
        "a new corner divides the edge as the distances of its ends do, in all of x, y, z, w and attributes" {
        FromKept,
        FromFirst = "counts the part from the first end of the edge",
    }
}

/// What a new corner gets.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum New {
    #[default]
    Right,
    /// The number of the corner that stays.
    Kept,
    /// The number of the corner that is cut off.
    Lost,
    /// That of the first end of the edge, whichever stays.
    First,
    /// That of the second end.
    Second,
    /// Halfway between both ends, wherever the plane cuts the edge.
    Mean,
    /// As pixels interpolate attributes, which is right after the division by w alone.
    Perspective,
    /// Divided by w at both ends, interpolated, and left like that.
    OverW,
    /// The same, multiplied by the w of the new corner.
    OverWAndBack,
    /// Multiplied by w at both ends, and divided by the w of the new corner.
    TimesWAndBack,
    /// The right number divided by the w of the new corner.
    DividedByW,
    /// The right number times the w of the new corner.
    TimesW,
    /// x and y exchanged.
    Exchanged,
    /// Always the same number.
    Is(f64),
    /// The right number without its sign.
    Unsigned,
    /// The right number, raised to a least one.
    AtLeast(f64),
    /// The right number, clamped to 0 to 1.
    InUnit,
    /// The right number in fewer bits.
    Format(Format),
}

impl New {
    /// A number of the new corner of an edge, with that of its place.
    fn of(self, edge: &Edge, k: usize) -> f64 {
        let Edge { kept, lost, t, is_forward } = *edge;
        // The right number, and the same of numbers that are divided by w.
        let at = |k: usize| interpolated(kept[k], lost[k], t);
        let over_w = interpolated(kept[k] / kept[3], lost[k] / lost[3], t);
        match self {
            Self::Right => at(k),
            Self::Kept => kept[k],
            Self::Lost => lost[k],
            Self::First if is_forward => kept[k],
            Self::First => lost[k],
            Self::Second if is_forward => lost[k],
            Self::Second => kept[k],
            Self::Mean => (kept[k] + lost[k]) / 2.0,
            Self::Perspective => {
                let (a, b) = ((1.0 - t) / kept[3], t / lost[3]);
                (a * kept[k] + b * lost[k]) / (a + b)
            }
            Self::OverW => over_w,
            Self::OverWAndBack => over_w * at(3),
            Self::TimesWAndBack => interpolated(kept[k] * kept[3], lost[k] * lost[3], t) / at(3),
            Self::DividedByW => at(k) / at(3),
            Self::TimesW => at(k) * at(3),
            Self::Exchanged => at([1, 0, 2, 3, 4][k]),
            Self::Is(v) => v,
            Self::Unsigned => at(k).abs(),
            Self::AtLeast(least) => at(k).max(least),
            Self::InUnit => at(k).clamp(0.0, 1.0),
            Self::Format(format) => format.of(at(k)),
        }
    }
}

/// The number at a part of the way from one number to another.
fn interpolated(from: f64, to: f64, t: f64) -> f64 {
    from + (to - from) * t
}

/// What a new corner gets, with its words.
const NEW: [(New, &str); 19] = [
    (New::Kept, "keeps {} of the corner that stays at a new corner"),
    (New::Lost, "keeps {} of the corner that is cut off at a new corner"),
    (New::First, "keeps {} of the first end of an edge at a new corner"),
    (New::Second, "keeps {} of the second end of an edge at a new corner"),
    (New::Mean, "gives a new corner the mean of both ends for {}"),
    (New::Perspective, "interpolates {} at a new corner with a correction for perspective"),
    (
        New::OverWAndBack,
        "divides {} by w before it interpolates at a new corner, and multiplies by the new w",
    ),
    (New::Is(0.0), "gives a new corner 0 for {}"),
    (New::Is(1.0), "gives a new corner 1 for {}"),
    (
        New::OverW,
        "divides {} by w before it interpolates at a new corner, and does not multiply back",
    ),
    (
        New::TimesWAndBack,
        "multiplies {} by w before it interpolates at a new corner, and divides by the new w",
    ),
    (New::Unsigned, "loses the sign of {} of a new corner"),
    (New::DividedByW, "divides {} of a new corner by its w"),
    (New::TimesW, "multiplies {} of a new corner by its w"),
    (New::AtLeast(0.1), "raises {} of a new corner to 0.1 at least"),
    (New::AtLeast(0.01), "raises {} of a new corner to 0.01 at least"),
    (New::AtLeast(1.0), "raises {} of a new corner to 1 at least"),
    (New::InUnit, "clamps {} of a new corner to 0 to 1"),
    (New::Exchanged, "exchanges {} of a new corner"),
];

impl Field for New {
    const NAME: &'static str = "a new corner";

    fn options() -> Vec<Self> {
        let formats = Format::options().into_iter().map(Self::Format);
        NEW.iter().map(|(new, _)| *new).chain(formats).collect()
    }

    fn says(&self) -> Option<(String, &'static str)> {
        if let Self::Format(format) = self {
            return Some((format!("keeps {{}} of a new corner in {format}"), NEW_REPAIR));
        }
        let (_, does) = NEW.iter().find(|(new, _)| new == self)?;
        Some(((*does).to_owned(), NEW_REPAIR))
    }
}

/// The corners of what is left, and the way round.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Order {
    #[default]
    Right,
    /// The corners go round the other way.
    Reversed,
    /// Two corners of a quadrilateral are exchanged.
    Crossed,
    /// What comes after the third corner is dropped.
    AtMostThree,
    /// A quadrilateral loses a corner.
    Lost(usize),
    /// An edge gets no new corner.
    Uncut(usize),
}

impl Field for Order {
    const NAME: &'static str = "the corners that are left";

    fn options() -> Vec<Self> {
        let mut all = vec![Self::AtMostThree, Self::Reversed, Self::Crossed];
        for i in 0..3 {
            all.extend([Self::Lost(i), Self::Uncut(i)]);
        }
        all
    }

    fn says(&self) -> Option<(String, &'static str)> {
        let names = ["first", "second", "third", "first"];
        // What repairs a lost corner.
        let quadrilateral = "a triangle that is cut can have four corners";
        Some(match *self {
            Self::Right => return None,
            Self::Reversed => (
                "gives the corners of what is left the other way round, so that it turns its back"
                    .to_owned(),
                "go round the triangle in the order of its corners",
            ),
            Self::Crossed => (
                "gives the corners of a quadrilateral in a wrong order, so that its sides cross"
                    .to_owned(),
                "go round the triangle, and make each new corner where its edge crosses the plane",
            ),
            Self::AtMostThree => (
                "keeps at most three corners, so that a quadrilateral loses one".to_owned(),
                quadrilateral,
            ),
            Self::Lost(i) => {
                (format!("loses the {} corner of a quadrilateral", names[i]), quadrilateral)
            }
            Self::Uncut(i) => (
                format!(
                    "does not cut the edge from the {} corner to the {}",
                    names[i],
                    names[i + 1]
                ),
                "cut all three edges",
            ),
        })
    }
}

/// The numbers of a new corner that are wrong: of x, y, z, w and the attribute.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Numbers([bool; 5]);

impl Default for Numbers {
    fn default() -> Self {
        Self([true; 5])
    }
}

impl Field for Numbers {
    const NAME: &'static str = "some numbers of a new corner";

    /// They are read off.
    fn options() -> Vec<Self> {
        Vec::new()
    }

    fn says(&self) -> Option<(String, &'static str)> {
        None
    }
}

/// The edges that are wrong: those of which the second end is cut off, or the first.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Edges {
    #[default]
    All,
    /// Those whose second end is cut off.
    Leaving,
    /// Those whose first end is cut off.
    Back,
}

impl Field for Edges {
    const NAME: &'static str = "some edges";

    fn options() -> Vec<Self> {
        vec![Self::Leaving, Self::Back]
    }

    fn says(&self) -> Option<(String, &'static str)> {
        None
    }
}

/// An edge that is cut: the corner that stays, the one that goes, the part of the way between them, and whether the one that
/// stays comes first.
#[derive(Clone)]
pub(super) struct Edge {
    pub(super) kept: ClipCorner,
    pub(super) lost: ClipCorner,
    pub(super) t: f64,
    pub(super) is_forward: bool,
}

impl Edge {
    /// The edge between two corners at these distances from the plane, where it is cut.
    fn cut(from: ClipCorner, to: ClipCorner, a: f64, b: f64) -> Option<Self> {
        match (a >= 0.0, b >= 0.0) {
            (true, false) => Some(Self { kept: from, lost: to, t: a / (a - b), is_forward: true }),
            (false, true) => Some(Self { kept: to, lost: from, t: b / (b - a), is_forward: false }),
            _ => None,
        }
    }
}

/// The coefficients of a plane that is read off are multiples of this: each is off by half of it, and what is less is 0.
const STEP: f64 = 1e-6;

/// A triangle and what was left of it.
#[derive(Clone)]
pub struct Cut<'a> {
    /// The corners as they were asked.
    pub(super) corners: [ClipCorner; 3],
    /// The polygon that was answered.
    pub(super) left: &'a [ClipCorner],
    /// Whether the declared plane is z = 0.
    is_zero: bool,
    /// How far a number may be off, as a share of the largest one asked.
    tolerance: f64,
}

/// A new corner of what is left, with the number of its edge.
pub(super) struct NewCorner {
    /// Its place in what is left, by the right clipper.
    pub(super) place: usize,
    /// The number of the edge, from the corner of the same number to the next one.
    pub(super) number: usize,
    pub(super) edge: Edge,
}

impl Cut<'_> {
    /// How many corners lie behind the plane.
    fn behind(&self) -> usize {
        self.corners.iter().filter(|p| Plane::Near.distance(**p, self.is_zero) < 0.0).count()
    }

    /// Whether both are the same corners one way round; what has fewer than three may be left out.
    fn is(&self, polygon: &[ClipCorner], times: f64) -> bool {
        self.is_but_for(polygon, times, [false; 5])
    }

    /// The same, where some numbers may be anything.
    fn is_but_for(&self, polygon: &[ClipCorner], times: f64, free: [bool; 5]) -> bool {
        let tolerance = times * self.tolerance;
        // A number may be off by its bound, and by its own size times the tolerance.
        let bounds = bounds(&self.corners, tolerance);
        let near = |p: &ClipCorner, q: &ClipCorner| {
            // Wrong numbers may be larger than those of the corners.
            (0..5).all(|k| free[k] || (p[k] - q[k]).abs() <= bounds[k].max(tolerance * p[k].abs()))
        };
        let has_area = |polygon: &[ClipCorner]| polygon.len() > 2;
        (!has_area(polygon) && !has_area(self.left))
            || is_round(polygon.len(), self.left.len(), &|i, j| near(&polygon[i], &self.left[j]))
    }

    /// The corners that are left by the right clipper, each with the one that is given in its place; nothing where there are
    /// others, or another number of them.
    pub(super) fn aligned(&self) -> Option<Vec<ClipCorner>> {
        let right = NearCut::default().polygon(self, true);
        let count = right.len();
        if count < 3 || self.left.len() != count {
            return None;
        }
        // What is given may begin at any corner. The corners of the triangle have to have their places; of the turns in which they do,
        // the one is kept with most of the new corners in theirs, and of equal ones the last.
        let bounds = bounds(&self.corners, self.tolerance);
        let mut best = None;
        let mut most = 0;
        for turn in 0..count {
            let given = [&self.left[turn..], &self.left[..turn]].concat();
            let (mut matching, mut fits) = (0, true);
            for (p, q) in right.iter().zip(&given) {
                let is_near = (0..5).all(|k| (p[k] - q[k]).abs() <= bounds[k]);
                matching += usize::from(is_near);
                fits &= is_near || !self.corners.contains(p);
            }
            if fits && matching >= most {
                (best, most) = (Some(given), matching);
            }
        }
        best
    }

    /// The new corners of the right clipper.
    pub(super) fn new_of_right(&self) -> Vec<NewCorner> {
        let mut all = Vec::new();
        let mut place = 0;
        for number in 0..3 {
            let [from, to] = [number, (number + 1) % 3].map(|i| self.corners[i]);
            let a = Plane::Near.distance(from, self.is_zero);
            let b = Plane::Near.distance(to, self.is_zero);
            // A corner that is kept has its own place, before the new one of the edge that begins at it.
            place += usize::from(a >= 0.0);
            if let Some(edge) = Edge::cut(from, to, a, b) {
                all.push(NewCorner { place, number, edge });
                place += 1;
            }
        }
        all
    }

    /// Whether two numbers of a corner are the same.
    pub(super) fn is_number(&self, k: usize, given: f64, predicted: f64) -> bool {
        let bound = bounds(&self.corners, self.tolerance)[k];
        (given - predicted).abs() <= bound.max(self.tolerance * predicted.abs())
    }

    /// The corners that the triangle does not have.
    fn new_corners(&self) -> impl Iterator<Item = &ClipCorner> {
        self.left.iter().filter(|p| self.corners.iter().all(|corner| corner[..4] != p[..4]))
    }
}

impl NearCut {
    /// What is left; a corner in the plane may be given once more as a new one with the numbers of that, or not.
    pub(super) fn polygon(&self, cut: &Cut<'_>, is_twice: bool) -> Vec<ClipCorner> {
        let by_w = |[x, y, z, w, a]: ClipCorner| [x / w, y / w, z / w, 1.0, a];
        // What is clipped, and by which distances.
        let corners = match self.divided {
            Divided::Before => cut.corners.map(by_w),
            _ => cut.corners,
        };
        let distance = |p: ClipCorner| self.plane.distance(p, cut.is_zero);
        let behind = corners.iter().filter(|p| distance(**p) < 0.0).count();
        let clamped = |p: ClipCorner| [p[0], p[1], p[2] - distance(p).min(0.0), p[3], p[4]];
        let mut left = match self.kept {
            KeptCorners::Clipped => self.clipped(corners, cut.is_zero, is_twice),
            KeptCorners::Nothing => Vec::new(),
            KeptCorners::Whole if behind > 0 => Vec::new(),
            KeptCorners::Seen | KeptCorners::Clamped { is_culled: true } if behind == 3 => {
                Vec::new()
            }
            KeptCorners::All | KeptCorners::Whole | KeptCorners::Seen => corners.to_vec(),
            KeptCorners::Clamped { .. } => corners.map(clamped).to_vec(),
        };
        // Then the order of the corners that are left.
        let is_quadrilateral = left.len() > 3;
        match self.order {
            Order::Reversed => left.reverse(),
            Order::Crossed if is_quadrilateral => left.swap(2, 3),
            Order::AtMostThree => left.truncate(3),
            Order::Lost(i) if is_quadrilateral => {
                left.remove(i);
            }
            _ => {}
        }
        // And the division, where it comes too early for the stage after the clipper.
        if self.divided == Divided::After {
            left = left.into_iter().map(by_w).collect();
        }
        left
    }

    /// Sutherland and Hodgman.
    fn clipped(&self, corners: [ClipCorner; 3], is_zero: bool, is_twice: bool) -> Vec<ClipCorner> {
        let mut left = Vec::new();
        for (i, &from) in corners.iter().enumerate() {
            let to = corners[(i + 1) % 3];
            let [a, b] = [from, to].map(|p| self.plane.distance(p, is_zero));
            if a >= 0.0 {
                left.push(from);
            }
            let Some(right) = Edge::cut(from, to, a, b).filter(|_| self.order != Order::Uncut(i))
            else {
                continue;
            };
            let is_forward = right.is_forward;
            let is_changed = match self.edges {
                Edges::All => true,
                Edges::Leaving => is_forward,
                Edges::Back => !is_forward,
            };
            // The numbers that are wrong are computed by the wrong part of the edge, the others by the right one.
            let wrong = Edge { t: self.part_of(&right), ..right };
            let mut corner = [0.0; 5];
            for (k, number) in corner.iter_mut().enumerate() {
                *number = match is_changed && self.numbers.0[k] && (is_twice || right.t > 0.0) {
                    true => self.new.of(&wrong, k),
                    false => New::Right.of(&right, k),
                };
            }
            left.push(corner);
        }
        left
    }

    /// The part of an edge at which the new corner is made, counted from the corner that is kept.
    fn part_of(&self, edge: &Edge) -> f64 {
        match self.counted {
            EdgeStart::FromFirst if !edge.is_forward => 1.0 - self.part_at(edge, 1.0 - edge.t),
            _ => self.part_at(edge, edge.t),
        }
    }

    /// What becomes of the right part `t`.
    fn part_at(&self, edge: &Edge, t: f64) -> f64 {
        // Some parts are of other distances than those from the plane.
        let Edge { kept, lost, .. } = edge;
        match self.part {
            Part::Right => t,
            Part::Kept(format) => format.of(t),
            Part::Back => 1.0 - t,
            Part::Squared => t * t,
            Part::AtMostHalf => t.min(0.5),
            Part::AtLeastHalf => t.max(0.5),
            Part::OfSum => t / (2.0 * t - 1.0),
            Part::ByZ => part_by(kept[2], lost[2]),
            Part::ByW => part_by(kept[3], lost[3]),
            Part::Divided => part_by(kept[2] / kept[3] + 1.0, lost[2] / lost[3] + 1.0),
        }
    }

    /// The plane on which all new corners lie.
    fn with_plane(&self, parts: &[&Cut<'_>]) -> Vec<Self> {
        let new: Vec<_> = parts.iter().flat_map(|cut| cut.new_corners()).collect();
        let Some(first) = new.first() else { return Vec::new() };
        // The plane goes through the first new corner and the one that lies farthest from it.
        let away = |p: &ClipCorner| (p[2] - first[2]).abs() + (p[3] - first[3]).abs();
        let far = new.iter().max_by(|a, b| away(a).total_cmp(&away(b)));
        let Some(far) = far.filter(|far| away(far) > 0.0) else { return Vec::new() };
        // Its coefficients, the larger one of z and w 1 or less, each rounded to a multiple of the step.
        let (z, w) = (first[3] - far[3], far[2] - first[2]);
        let size = z.abs().max(w.abs());
        let [z, w] = [z, w].map(|v| if v.abs() < STEP * size { 0.0 } else { v / size });
        let by = if z == 0.0 { w } else { z };
        let simple = |v: f64| (v / by / STEP).round() * STEP;
        let plane = [z, w, -z * first[2] - w * first[3]].map(simple);
        // No new corner is farther from the first than the one that the plane goes through as well. So where each corner is off by
        // the tolerance, the plane is off by three times as much at any of them, and the corner itself by one more.
        let tolerance = parts.first().map_or(0.0, |cut| cut.tolerance);
        let steepness = plane[0].abs() + plane[1].abs();
        let off = 4.0 * tolerance * steepness + STEP / 2.0;
        let is_on = |p: &&ClipCorner| {
            Plane::At(plane).distance(**p, false).abs() <= off * (1.0 + p[2].abs() + p[3].abs())
        };
        if new.len() <= 8 || !new.iter().all(is_on) {
            return Vec::new();
        }
        [plane, plane.map(|v| -v)]
            .map(|plane| Self { plane: Plane::At(plane), ..self.clone() })
            .to_vec()
    }

    /// The fewest numbers of new corners that are wrong, where all others are right.
    fn wrong_numbers(parts: &[&Cut<'_>]) -> Option<Numbers> {
        let right = Self::default();
        let predicted: Vec<_> = parts.iter().map(|cut| right.polygon(cut, false)).collect();
        // Sets of one number first, then of two, and so on: a set has a bit for each number, and none has all of them.
        for count in 1..5 {
            for set in 1..31_u32 {
                let numbers = Numbers([0, 1, 2, 3, 4].map(|k| set >> k & 1 == 1));
                let explains = |(cut, polygon): (&&Cut<'_>, &Vec<ClipCorner>)| {
                    cut.is_but_for(polygon, 1.0, numbers.0)
                };
                if set.count_ones() == count && parts.iter().zip(&predicted).all(explains) {
                    return Some(numbers);
                }
            }
        }
        None
    }
}

/// The part of an edge by the distances of its ends.
fn part_by(kept: f64, lost: f64) -> f64 {
    kept / (kept - lost)
}

impl Stage for NearCut {
    type Part<'a> = Cut<'a>;
    const PAGE: &'static str = "ch07";
    const REFUTED: &'static str = "a triangle of which something else is left";
    const NOISE: &'static [f64] = &[0.0];
    const WHOM: &'static str = "triangles";

    fn parts<'a>(
        question: &'a Question,
        answer: &'a Answer,
        declared: &Declared,
        _: f64,
    ) -> Vec<Cut<'a>> {
        let (Some(triangle), Some(left)) = (asked(&question.of), answer.polygon()) else {
            return Vec::new();
        };
        let (is_zero, tolerance) = (declared.near_is_zero, declared.tolerance);
        vec![Cut { corners: clip_corners(&triangle), left, is_zero, tolerance }]
    }

    fn explains(&self, cut: &Cut<'_>) -> bool {
        [true, false].into_iter().any(|is_twice| {
            let polygon = self.polygon(cut, is_twice);
            if *self == Self::default() {
                return cut.is(&polygon, 1.0);
            }
            // What divides by 0 answers a number that is none, too: else it would explain every wrong answer.
            let is_finite =
                |polygon: &[ClipCorner]| polygon.iter().flatten().all(|v| v.is_finite());
            if !is_finite(&polygon) {
                return !is_finite(cut.left);
            }
            let is_right = |times| cut.is(&Self::default().polygon(cut, false), times);
            // Predictions are rounded too; but what is as near to the right polygon explains nothing.
            cut.is(&polygon, 1.0) || (cut.is(&polygon, 10.0) && !is_right(10.0))
        })
    }

    fn solved(&self, parts: &[&Cut<'_>]) -> Vec<Self> {
        // Planes are read off as all else is here, and wrong numbers where all else is right.
        let mut all = self.with_plane(parts);
        let numbers = if *self == Self::default() { Self::wrong_numbers(parts) } else { None };
        if let Some(numbers) = numbers {
            // Each mistake is tried in these numbers alone.
            all.extend(Self::options().into_iter().map(|value| Self { numbers, ..value }));
        }
        all
    }

    fn quantities(cut: &Cut<'_>) -> Vec<Quantity> {
        let behind = cut.behind() as f64;
        let is_negative = cut.corners.iter().any(|corner| corner[3] < 0.0);
        vec![
            Quantity::number("the number of corners behind the near plane", behind),
            Quantity::whether(is_negative, "where a corner has a negative w", ""),
        ]
    }

    fn filled(&self, does: &str) -> String {
        let names = ["x", "y", "z", "w", "attributes"];
        // The numbers that are wrong, as a list in words.
        let some: Vec<_> = (0..5).filter(|k| self.numbers.0[*k]).map(|k| names[k]).collect();
        let numbers = match some[..] {
            [_, _, _, _, _] => "all numbers".to_owned(),
            [ref others @ .., a, b] if !others.is_empty() => {
                format!("{}, {a} and {b}", others.join(", "))
            }
            _ => some.join(" and "),
        };
        let edges = match self.edges {
            Edges::All => "",
            Edges::Leaving => " (of edges that leave alone)",
            Edges::Back => " (of edges that come back alone)",
        };
        does.replace("{}", &numbers) + edges
    }
}
