//! Hard cases: what breaks rasterizers, as generated families and as named cases.
//!
//! Uniformly random triangles prove little: on the 1/256-px lattice two or three in ten thousand have
//! a sample exactly on an edge, so random draws hardly ever refute a wrong tie rule. Each family here
//! aims at one danger. A case is a pure function of (family, seed, index), on every machine:
//! whole-number arithmetic, no trigonometry.

mod clip;
#[doc(hidden)]
pub mod facts;
#[doc(hidden)]
pub mod formulas;
pub mod lines;
pub mod named;
#[doc(hidden)]
pub mod near_plane;
#[doc(hidden)]
pub mod shrink;
pub mod triangles;
pub mod unsnapped;
#[doc(hidden)]
pub mod wide;

use std::error::Error;
use std::fmt;
use std::str::FromStr;

use glam::DVec2;

use rasterproof_core::grid::{HALF_PIXEL, PixelRect, SubpixelPoint};
#[doc(inline)]
pub use rasterproof_core::random::Rng;
use rasterproof_core::triangle::{FreeCorners, PixelPoint, ScreenLine, ScreenTriangle};

use crate::oracle::formula::Formula;
use facts::{Topic, design};

/// A triangle as the harness draws it: two attributes besides depth.
pub type Triangle = ScreenTriangle<DVec2>;
/// A line as the harness draws it.
pub type Line = ScreenLine<DVec2>;

/// What a case draws.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Triangles, to be judged one by one and together.
    Triangles {
        /// The triangles.
        list: Vec<Triangle>,
        /// Whether their interiors are disjoint by construction, so that no pixel may be hit twice.
        disjoint: bool,
    },
    /// Lines, to be judged one by one.
    Lines(Vec<Line>),
    /// Triangles whose corners are not snapped.
    Unsnapped {
        /// The triangles.
        list: Vec<FreeCorners>,
        /// Whether they tile a region around the window, so that every pixel of it must be hit exactly once.
        is_tiling: bool,
    },
    /// Numbers for a formula of the pipeline, in which the window has no part.
    #[doc(hidden)]
    Numbers {
        /// Which formula is asked.
        formula: Formula,
        /// The numbers that it is given, in the order of the request.
        numbers: Vec<f64>,
    },
}

/// The kinds of [`Shape`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "lowercase"))]
pub enum Kind {
    /// Triangles on the lattice.
    #[default]
    Triangles,
    /// Lines.
    Lines,
    /// Triangles that are not snapped to the lattice.
    Unsnapped,
}

impl Kind {
    /// Every kind, with its families.
    pub const ALL: [(Self, &'static [Family]); 3] = [
        (Self::Triangles, triangles::FAMILIES),
        (Self::Lines, lines::FAMILIES),
        (Self::Unsnapped, unsnapped::FAMILIES),
    ];
}

/// Something to draw, and the window to draw it in.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// The pixels that are looked at.
    pub window: PixelRect,
    /// What is drawn.
    pub shape: Shape,
}

impl Case {
    /// A case of triangles that are not snapped.
    #[must_use]
    pub fn unsnapped(window: PixelRect, list: Vec<FreeCorners>) -> Self {
        Self { window, shape: Shape::Unsnapped { list, is_tiling: false } }
    }

    /// The triangles on the lattice; none where the case has other shapes.
    #[must_use]
    pub fn triangles(&self) -> &[Triangle] {
        if let Shape::Triangles { list, .. } = &self.shape { list } else { &[] }
    }

    /// The triangles that are not snapped; none where the case has other shapes.
    #[must_use]
    pub fn free_corners(&self) -> &[FreeCorners] {
        if let Shape::Unsnapped { list, .. } = &self.shape { list } else { &[] }
    }
}

/// A way to make cases that share a danger.
#[derive(Clone, Copy)]
pub struct Family {
    /// Its name on the command line.
    pub name: &'static str,
    /// What it threatens, in a few words.
    pub about: &'static str,
    source: Source,
}

/// Where the cases of a family come from.
#[derive(Clone, Copy)]
enum Source {
    /// Each is drawn at random, without the others.
    Drawn(fn(&mut Rng) -> Case),
    /// A covering design chooses them one after the other.
    Designed(Topic),
}

impl Family {
    /// The case number `index` of this family under `seed`.
    #[must_use]
    pub fn case(&self, seed: u64, index: u64) -> Case {
        self.case_within(seed, index, &Limits::default())
    }

    /// The same for a rasterizer that does not draw everything: a drawn case is put where it draws, and a design covers
    /// what can be asked of it.
    #[must_use]
    pub fn case_within(&self, seed: u64, index: u64, limits: &Limits) -> Case {
        match &self.source {
            Source::Drawn(make) => limits.put(make(&mut Rng::new(self.name, seed, index))),
            Source::Designed(topic) => design::case(topic, seed, index, limits),
        }
    }

    /// The kind of question whose facts a covering design chooses the cases by; none where each is drawn for itself.
    #[must_use]
    pub fn design(&self) -> Option<&Topic> {
        match &self.source {
            Source::Drawn(_) => None,
            Source::Designed(topic) => Some(topic),
        }
    }
}

const fn family(name: &'static str, about: &'static str, make: fn(&mut Rng) -> Case) -> Family {
    Family { name, about, source: Source::Drawn(make) }
}

const fn designed(topic: Topic, about: &'static str) -> Family {
    Family { name: topic.name, about, source: Source::Designed(topic) }
}

/// What a rasterizer can be asked, in steps of the lattice where nothing else is said: its coordinates and its windows.
#[derive(Clone, Debug, PartialEq)]
pub struct Limits {
    /// Where in a pixel the sample lies, from the pixel's upper left corner.
    pub sample: [i32; 2],
    /// Coordinates of corners are multiples of this.
    pub step: i64,
    /// The least and the largest coordinate of a corner.
    pub least: i64,
    /// See `least`.
    pub most: i64,
    /// Ends of lines lie in [-range, range) px.
    pub line_range_px: Option<i32>,
    /// The largest window, in pixels.
    pub window: Option<[u32; 2]>,
}

impl Default for Limits {
    /// The whole domain.
    fn default() -> Self {
        Self {
            sample: [HALF_PIXEL; 2],
            step: 1,
            least: i32::MIN.into(),
            most: i32::MAX.into(),
            line_range_px: None,
            window: None,
        }
    }
}

impl Limits {
    /// Puts a case inside: what lay on a pixel's centre lies on the sample, then every coordinate is rounded to the grid and
    /// kept within the limits. Ties stay ties where the grid holds the sample. A mesh may be folded by that.
    #[must_use]
    pub fn put(&self, mut case: Case) -> Case {
        if *self == Self::default() {
            return case;
        }
        if let Some([width, height]) = self.window {
            case.window.x1 = case.window.x1.min(width as i32);
            case.window.y1 = case.window.y1.min(height as i32);
        }
        match &mut case.shape {
            Shape::Triangles { list, .. } => {
                for vertex in list.iter_mut().flat_map(|triangle| &mut triangle.vertices) {
                    let SubpixelPoint { x, y } = vertex.position;
                    vertex.position = SubpixelPoint::new(self.place(x, 0), self.place(y, 1));
                }
            }
            Shape::Lines(lines) => {
                let Some(most) = self.line_range_px else { return case };
                // The centre of a pixel lies half a pixel further.
                for end in lines.iter_mut().flat_map(|line| &mut line.ends) {
                    let [x, y] = [end.pixel.x, end.pixel.y].map(|px| px.clamp(-most, most - 1));
                    end.pixel = PixelPoint::new(x, y);
                }
            }
            Shape::Unsnapped { .. } | Shape::Numbers { .. } => {}
        }
        case
    }

    fn place(&self, sub: i32, axis: usize) -> i32 {
        let moved = i64::from(sub) + i64::from(self.sample[axis] - HALF_PIXEL);
        let on_grid = (moved + self.step / 2).div_euclid(self.step) * self.step;
        on_grid.clamp(self.least, self.most) as i32
    }

    /// Whether corners lie within the limits.
    #[must_use]
    pub fn takes(&self, list: &[Triangle]) -> bool {
        let is_on = |v: i32| {
            (self.least..=self.most).contains(&v.into()) && i64::from(v).rem_euclid(self.step) == 0
        };
        list.iter().flat_map(|triangle| triangle.corners()).all(|p| is_on(p.x) && is_on(p.y))
    }
}

macro_rules! family_names {
    ($($variant:ident $name:literal)*) => {
        /// The name of a family of triangles or lines, on the lattice or off it. It is parsed from, and shown as, the
        /// word of the command line.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[non_exhaustive]
        pub enum FamilyName {
            $(#[doc = concat!("`", $name, "`")] $variant,)*
        }

        impl FamilyName {
            /// Every name, in the order of the catalogue.
            pub const ALL: &'static [Self] = &[$(Self::$variant,)*];

            /// The word of the command line.
            #[must_use]
            pub fn as_str(self) -> &'static str {
                match self {
                    $(Self::$variant => $name,)*
                }
            }
        }
    };
}

family_names! {
    Uniform "uniform" HalfInteger "half-integer" Rectangle "rectangle" Fan "fan" Strip "strip" Sliver "sliver"
    NearHorizontal "near-horizontal" NearVertical "near-vertical" Tiny "tiny" Flat "flat" Degenerate "degenerate"
    PartlyOff "partly-off" OffScreen "off-screen" Huge "huge" NearTie "near-tie" Far "far"
    WEqual "w-equal" W4 "w-4" W100 "w-100" W1e4 "w-1e4" W1e6 "w-1e6" WExtreme "w-extreme"
    Design "design" WDesign "w-design"
    LineOctants "line-octants" LineTies "line-ties" LineAxis "line-axis" LinePoints "line-points"
    LineClipped "line-clipped" LineFar "line-far" LineDesign "line-design"
    F32Random "f32-random" F32Sliver "f32-sliver" F32NearTie "f32-near-tie" F32Tie "f32-tie" F32Fan "f32-fan"
    F32Cut "f32-cut" F32Tiny "f32-tiny" F32Mixed "f32-mixed" F32Denormal "f32-denormal" F32Far "f32-far"
    F32Huge "f32-huge" F64NearTie "f64-near-tie" F64Huge "f64-huge" F64Denormal "f64-denormal"
}

impl fmt::Display for FamilyName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}

/// A word that names no family.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownFamily(pub String);

impl fmt::Display for UnknownFamily {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let known: Vec<_> = FamilyName::ALL.iter().map(|name| name.as_str()).collect();
        write!(f, "no family is called {:?}; expected one of {}", self.0, known.join(", "))
    }
}

impl Error for UnknownFamily {}

impl FromStr for FamilyName {
    type Err = UnknownFamily;

    fn from_str(word: &str) -> Result<Self, UnknownFamily> {
        let found = Self::ALL.iter().find(|name| name.as_str() == word);
        found.copied().ok_or_else(|| UnknownFamily(word.to_owned()))
    }
}

/// The families on the lattice: those of triangles first, then those of lines.
pub fn families() -> impl Iterator<Item = &'static Family> {
    triangles::FAMILIES.iter().chain(lines::FAMILIES)
}

/// All families, in the order of [`Kind::ALL`].
pub fn all_families() -> impl Iterator<Item = &'static Family> {
    Kind::ALL.iter().flat_map(|(_, families)| *families)
}

/// A point given in whole subpixels.
fn sub(x: i64, y: i64) -> SubpixelPoint {
    SubpixelPoint::new(x as i32, y as i32)
}

/// A pixel given in whole numbers.
fn pixel(x: i64, y: i64) -> PixelPoint {
    PixelPoint::new(x as i32, y as i32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_family_has_its_name() {
        let families: Vec<_> = all_families().map(|family| family.name).collect();
        let names: Vec<_> = FamilyName::ALL.iter().map(|name| name.as_str()).collect();
        assert_eq!(names, families);
        for name in FamilyName::ALL {
            assert_eq!(name.to_string().parse(), Ok(*name));
        }
        let error = "slivver".parse::<FamilyName>().unwrap_err().to_string();
        assert!(error.contains("\"slivver\"; expected one of uniform, "), "{error}");
    }
}
