//! What a program says of itself in answer to HELLO: its capabilities, and the limits and the rule
//! it wants to be judged by.
//!
//! A word that is not known, or whose value cannot be used, is kept to be reported and has no
//! effect. What is not declared has the default of the protocol, version 2.

use std::fmt;

use super::text::{number, printable, px};
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::{DOMAIN_PX, MAX_SIDE_PX, SUBPIXELS};
use rasterproof_core::triangle::{Corners, ValuePlace, WideForm};
use rasterproof_verify::comparison::{Convention, Rule, Winding};
use rasterproof_verify::oracle::area::share;
use rasterproof_verify::partition::{self, Tessellation};

/// What a program declares; the default is what version 1 promises.
#[derive(Clone, Debug, PartialEq)]
pub struct Declared {
    /// Its name, printable.
    pub name: String,
    /// The version of the protocol it speaks, 1 or 2.
    pub version: u32,
    /// Answers T.
    pub coverage: bool,
    /// Answers L.
    pub line: bool,
    /// Answers I.
    pub attributes: bool,
    /// Answers S.
    pub samples4: bool,
    /// Answers D.
    pub depth: bool,
    /// Answers N.
    pub clip: bool,
    /// Answers A: clips corners that carry an attribute.
    pub clip_attributes: bool,
    /// Answers W: fills lines with a width.
    pub wide_line: bool,
    /// The shape of its lines with a width.
    pub wide: WideForm,
    /// Answers R: says how much of each pixel a triangle covers.
    pub area: bool,
    /// How many steps a pixel that is covered whole has.
    pub levels: u8,
    /// How many steps a share may be off.
    pub area_tolerance: f64,
    /// Answers X: gives the samples of a pixel values.
    pub sample_values: bool,
    /// Where the values of samples are computed.
    pub values_at: ValuePlace,
    /// Its rule, winding, sample and grid of corners, of 0, 4, 6 or 8 bits.
    pub convention: Convention,
    /// Which pixels belong to a triangle, its edges apart.
    pub shape: Shape,
    /// Coordinates lie in [-range, range] px; none means the whole domain.
    pub range: Option<i32>,
    /// The largest window it draws; none means any.
    pub window: Option<[u32; 2]>,
    /// Requests it may be sent before it has answered.
    pub batch: usize,
    /// A pixel drawn twice cannot be seen in its answers.
    pub mask: bool,
    /// The pixels of its lines come in no order.
    pub line_set: bool,
    /// How far a value may be off, in units of the largest magnitude at the vertices.
    pub tolerance: f64,
    /// Its near plane is z = 0, as Direct3D, Vulkan, Metal and WebGPU have it, and not z = -w, as OpenGL has it.
    pub near_is_zero: bool,
    /// Answers Q: computes the formulas of the pipeline.
    pub formulas: bool,
    /// Answers Y.
    pub partition: bool,
    /// What it promises of the triangles of a polygon.
    pub tessellation: Tessellation,
    /// How long its lines may be, in steps; measured and not declared. None means any length.
    pub reach: Option<i32>,
    /// How long sides of its triangles may be, in pixels, measured like that.
    pub side: Option<i32>,
    /// Words that are not known or cannot be used, printable.
    pub unknown: Vec<String>,
}

rasterproof_core::named! {
    /// Which pixels belong to a triangle, its edges apart.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Shape {
        /// The pixels whose sample lies in the triangle.
        Sample = "sample",
        /// The pixels of which any part lies in the triangle: outer conservative rasterization. A pixel that meets the triangle
        /// at its border alone may be drawn or not.
        Touched = "touched",
        /// The same with the border: a pixel that meets it is drawn.
        TouchedClosed = "touched-closed",
        /// The same without the border: a pixel that meets nothing else is not drawn.
        TouchedOpen = "touched-open",
        /// The pixels that lie in the triangle as a whole: inner conservative rasterization.
        Covered = "covered",
    }
}

/// The words for what a tessellator promises.
const FILL_RULES: [(&str, partition::FillRule); 2] =
    [("even-odd", partition::FillRule::EvenOdd), ("nonzero", partition::FillRule::NonZero)];
/// The words for the turn of its triangles.
const WINDINGS: [(&str, partition::Winding); 4] = [
    ("alike", partition::Winding::Alike),
    ("ccw", partition::Winding::Counterclockwise),
    ("cw", partition::Winding::Clockwise),
    ("any", partition::Winding::Any),
];
/// The words for the numbers in which it computes.
const COORDINATES: [(&str, partition::Coordinates); 3] = [
    ("f64", partition::Coordinates::F64),
    ("f32", partition::Coordinates::F32),
    ("integer", partition::Coordinates::Integer),
];

/// Words without a value.
const FLAGS: [&str; 17] = [
    "coverage",
    "line",
    "attributes",
    "samples4",
    "depth",
    "clip",
    "clip-attributes",
    "wide-line",
    "area",
    "sample-values",
    "formulas",
    "partition",
    "t-junctions",
    "degenerate",
    "yup",
    "mask",
    "line-set",
];

/// The values of words that have one of a few.
fn listed() -> [(&'static str, Vec<&'static str>); 10] {
    [
        ("rule", Rule::ALL.iter().map(|(word, _)| *word).collect()),
        ("winding", vec!["cw", "ccw", "both"]),
        ("grid", vec!["1", "16", "64", "256"]),
        ("shape", Shape::ALL.iter().map(|shape| shape.name()).collect()),
        ("near", vec!["zero", "minus-w"]),
        ("wide", WideForm::ALL.iter().map(|form| form.name()).collect()),
        ("values-at", ValuePlace::ALL.iter().map(|place| place.name()).collect()),
        ("fill-rule", FILL_RULES.iter().map(|(word, _)| *word).collect()),
        ("triangles", WINDINGS.iter().map(|(word, _)| *word).collect()),
        ("coordinates", COORDINATES.iter().map(|(word, _)| *word).collect()),
    ]
}

/// The form of words whose values are numbers.
fn numbered() -> [(&'static str, String); 7] {
    [
        ("origin", "origin=X,Y, each a multiple of 1/256 from -2 to 2".to_owned()),
        ("range", format!("range=N, a whole number from 1 to {}", DOMAIN_PX - 1)),
        ("window", format!("window=WxH, each from 1 to {MAX_SIDE_PX}")),
        ("batch", "batch=N, a whole number above 0".to_owned()),
        ("tolerance", "tolerance=T, a number from 0 to 1".to_owned()),
        ("levels", "levels=N, a whole number from 1 to 255".to_owned()),
        ("area-tolerance", "area-tolerance=T, a number of steps from 0 to 255".to_owned()),
    ]
}

/// What to write in place of a word that cannot be used.
fn meant_instead(key: &str, value: Option<&str>) -> String {
    // The key is right, and its value is a number that is not.
    if let Some((_, form)) = numbered().into_iter().find(|(known, _)| *known == key) {
        return format!("expected {form}");
    }
    let said = match value {
        Some(value) => format!("{key}={value}").to_lowercase(),
        None => key.to_lowercase(),
    };
    // The key is right, and its value is one of a few: one that resembles none of them gets them all.
    if let (Some(value), Some((_, values))) =
        (value, listed().into_iter().find(|(known, _)| *known == key))
        && !values.iter().any(|known| resembles(&value.to_lowercase(), known))
    {
        return format!("expected one of {key}={}", values.join(&format!(", {key}=")));
    }
    // All words that can be used; a number that somebody wrote is kept.
    let mut words: Vec<String> = FLAGS.map(str::to_owned).to_vec();
    for (known, values) in listed() {
        for value in values {
            words.push(format!("{known}={value}"));
        }
    }
    if let Some(value) = value {
        for (known, _) in numbered() {
            words.push(format!("{known}={value}"));
        }
    }
    words.retain(|word| Declared::default().declare(word).is_ok());
    let nearest = words.iter().min_by_key(|word| strsim::levenshtein(&said, word));
    if let Some(word) = nearest.filter(|word| resembles(&said, word)) {
        return format!("did you mean '{word}'?");
    }
    // None resembles it, so that all of them are named.
    let mut all = Vec::new();
    for (known, _) in listed() {
        all.push(format!("{known}=..."));
    }
    for (known, _) in numbered() {
        all.push(format!("{known}=..."));
    }
    all.extend(FLAGS.map(str::to_owned));
    format!("expected words such as {}", all.join(", "))
}

/// Whether at most half of the letters of a word have to change to make it another one.
fn resembles(word: &str, other: &str) -> bool {
    2 * strsim::levenshtein(word, other) <= word.len().max(other.len())
}

/// The key of a word, and its value where it has one.
fn parts_of(word: &str) -> (&str, Option<&str>) {
    match word.split_once('=') {
        Some((key, value)) => (key, Some(value)),
        None => (word, None),
    }
}

/// A whole number from 1 to a greatest one.
fn whole(word: &str, most: i32) -> Option<i32> {
    word.parse::<i32>().ok().filter(|number| (1..=most).contains(number))
}

/// A number from 0 to a greatest one.
fn up_to(word: &str, most: f64) -> Option<f64> {
    number(word).filter(|number| (0.0..=most).contains(number))
}

/// What a word stands for in a list.
fn meant<T: Copy>(list: &[(&str, T)], word: &str) -> Option<T> {
    list.iter().find(|(known, _)| *known == word).map(|(_, value)| *value)
}

/// The word of a list that stands for a value; each value has one.
fn word_of<T: PartialEq>(list: &[(&'static str, T)], value: &T) -> &'static str {
    list.iter().find(|(_, known)| known == value).map_or("", |(word, _)| word)
}

/// A tolerance for programs that compute in f32 and declare none.
pub const DEFAULT_TOLERANCE: f64 = 1e-4;
/// Rounding a share to the nearest step is off by half a step at most.
const HALF_A_STEP: f64 = 0.5;
/// Beside the tolerance, in steps: what lies just beside the middle of two steps may be rounded to either by a program that computes in
/// `f64`. There a cut of an edge that reaches to the end of the domain, 2^23 px, is rounded by 2^-30 px. Four cuts, one for each side of
/// a pixel, move a border by 2^-28 px at most, and 255 x 2^-28 is less than this.
const ROUNDING_OF_STEPS: f64 = 1e-6;
/// The most requests that are ever in flight.
pub const MOST_IN_FLIGHT: usize = 4096;
/// Words of an unknown meaning that are kept.
const MOST_UNKNOWN: usize = 8;

impl Default for Declared {
    fn default() -> Self {
        Self {
            name: String::new(),
            version: 1,
            coverage: false,
            line: false,
            attributes: false,
            samples4: false,
            depth: false,
            clip: false,
            clip_attributes: false,
            wide_line: false,
            wide: WideForm::default(),
            area: false,
            levels: u8::MAX,
            area_tolerance: HALF_A_STEP,
            sample_values: false,
            values_at: ValuePlace::default(),
            convention: Convention::default(),
            shape: Shape::Sample,
            range: None,
            window: None,
            batch: 1,
            mask: false,
            line_set: false,
            tolerance: DEFAULT_TOLERANCE,
            near_is_zero: false,
            formulas: false,
            partition: false,
            tessellation: Tessellation::default(),
            reach: None,
            side: None,
            unknown: Vec::new(),
        }
    }
}

impl Declared {
    /// Reads `HELLO 1 name word...` or `HELLO 2 name word...`; nothing for any other line.
    #[must_use]
    pub fn parse(line: &str) -> Option<Self> {
        // HELLO, the version and the name come first; every other word is a declaration.
        let mut words = line.split_ascii_whitespace();
        let version = match (words.next(), words.next()) {
            (Some("HELLO"), Some("1")) => 1,
            (Some("HELLO"), Some("2")) => 2,
            _ => return None,
        };
        let name = printable(words.next()?.as_bytes(), 40);
        let mut declared = Self { name, version, ..Self::default() };
        for word in words {
            declared.hear(word);
        }
        Some(declared)
    }

    /// Takes a word into account; one that cannot be used is kept as unknown.
    pub fn hear(&mut self, word: &str) {
        let (key, value) = parts_of(word);
        if self.take(key, value).is_none() && self.unknown.len() < MOST_UNKNOWN {
            self.unknown.push(printable(word.as_bytes(), 40));
        }
    }

    /// Takes the words into account that a caller declares for a program. Unlike a word of HELLO, which may come from a later
    /// version of the protocol, one that cannot be used is a slip: the error says what was probably meant.
    ///
    /// # Errors
    ///
    /// Where a word is not known or its value cannot be used.
    pub fn declare(&mut self, words: &str) -> Result<(), String> {
        for word in words.split_whitespace() {
            let (key, value) = parts_of(word);
            if self.take(key, value).is_none() {
                let shown = printable(word.as_bytes(), 40);
                return Err(format!("'{shown}' is not understood; {}", meant_instead(key, value)));
            }
        }
        Ok(())
    }

    /// Sets the field that a word is about; nothing where no field is, or where the value cannot be used.
    fn take(&mut self, key: &str, value: Option<&str>) -> Option<()> {
        // A word with a value and one without are told apart, so that a value too many is not ignored.
        match (key, value) {
            ("coverage", None) => self.coverage = true,
            ("line", None) => self.line = true,
            ("attributes", None) => self.attributes = true,
            ("samples4", None) => self.samples4 = true,
            ("depth", None) => self.depth = true,
            ("clip", None) => self.clip = true,
            ("clip-attributes", None) => self.clip_attributes = true,
            ("wide-line", None) => self.wide_line = true,
            ("area", None) => self.area = true,
            ("sample-values", None) => self.sample_values = true,
            ("values-at", Some(v)) => {
                self.values_at = ValuePlace::ALL.into_iter().find(|place| place.name() == v)?;
            }
            ("levels", Some(v)) => self.levels = whole(v, 255)? as u8,
            ("area-tolerance", Some(v)) => self.area_tolerance = up_to(v, 255.0)?,
            ("wide", Some(v)) => {
                self.wide = WideForm::ALL.into_iter().find(|form| form.name() == v)?
            }
            ("formulas", None) => self.formulas = true,
            ("partition", None) => self.partition = true,
            ("t-junctions", None) => self.tessellation.t_junctions = true,
            ("degenerate", None) => self.tessellation.degenerate = true,
            ("fill-rule", Some(v)) => self.tessellation.fill_rule = meant(&FILL_RULES, v)?,
            ("triangles", Some(v)) => self.tessellation.winding = meant(&WINDINGS, v)?,
            ("coordinates", Some(v)) => self.tessellation.coordinates = meant(&COORDINATES, v)?,
            ("yup", None) => self.convention.y_up = true,
            ("mask", None) => self.mask = true,
            ("line-set", None) => self.line_set = true,
            ("grid", Some(v)) => {
                // Grids are powers of two, of which these are in use.
                let grid = whole(v, SUBPIXELS).filter(|g| [1, 16, 64, 256].contains(g))?;
                self.convention.subpixel_bits = grid.ilog2();
            }
            ("origin", Some(v)) => {
                let (x, y) = v.split_once(',')?;
                self.convention.sample = [subpixels(x)?, subpixels(y)?];
            }
            ("rule", Some(v)) => {
                self.convention.rule = meant(&Rule::ALL, v)?;
            }
            ("shape", Some(v)) => {
                self.shape = Shape::ALL.into_iter().find(|shape| shape.name() == v)?;
            }
            ("near", Some("zero")) => self.near_is_zero = true,
            ("near", Some("minus-w")) => self.near_is_zero = false,
            ("winding", Some("cw")) => self.convention.winding = Winding::Clockwise,
            ("winding", Some("ccw")) => self.convention.winding = Winding::CounterClockwise,
            ("winding", Some("both")) => self.convention.winding = Winding::Both,
            ("range", Some(v)) => self.range = Some(whole(v, DOMAIN_PX - 1)?),
            ("window", Some(v)) => {
                // Both sides are limited on their own.
                let (w, h) = v.split_once('x')?;
                let most = MAX_SIDE_PX as i32;
                self.window = Some([whole(w, most)? as u32, whole(h, most)? as u32]);
            }
            ("batch", Some(v)) => {
                self.batch = v.parse::<usize>().ok().filter(|n| *n > 0)?.min(MOST_IN_FLIGHT);
            }
            ("tolerance", Some(v)) => self.tolerance = up_to(v, 1.0)?,
            _ => return None,
        }
        Some(())
    }

    /// The same, asked only what another can answer too. Its conventions stay its own.
    #[must_use]
    pub fn within(self, other: &Self) -> Self {
        let least = |a: Option<i32>, b: Option<i32>| a.into_iter().chain(b).min();
        // Of two limits the smaller one holds for both.
        let window = match (self.window, other.window) {
            (Some([w, h]), Some([x, y])) => Some([w.min(x), h.min(y)]),
            (a, b) => a.or(b),
        };
        Self {
            coverage: self.coverage && other.coverage,
            line: self.line && other.line,
            attributes: self.attributes && other.attributes,
            samples4: self.samples4 && other.samples4,
            depth: self.depth && other.depth,
            clip: self.clip && other.clip,
            clip_attributes: self.clip_attributes && other.clip_attributes,
            wide_line: self.wide_line && other.wide_line,
            area: self.area && other.area && self.levels == other.levels,
            area_tolerance: self.area_tolerance.max(other.area_tolerance),
            sample_values: self.sample_values
                && other.sample_values
                && self.values_at == other.values_at,
            formulas: self.formulas && other.formulas,
            partition: self.partition && other.partition,
            convention: self
                .convention
                .subpixel_bits(self.convention.subpixel_bits.min(other.convention.subpixel_bits)),
            range: least(self.range, other.range),
            reach: least(self.reach, other.reach),
            side: least(self.side, other.side),
            window,
            mask: self.mask || other.mask,
            line_set: self.line_set || other.line_set,
            tolerance: self.tolerance.max(other.tolerance),
            ..self
        }
    }

    /// Its coordinates are multiples of 1/grid px: 1, 16, 64 or 256.
    #[must_use]
    pub fn grid(&self) -> i32 {
        1 << self.convention.subpixel_bits
    }

    /// Whether it can be asked for the samples of a triangle: they have fixed places, so that the top-left rule must be meant.
    #[must_use]
    pub fn answers_samples(&self) -> bool {
        self.samples4 && self.has_standard_samples()
    }

    /// The same of samples with values.
    #[must_use]
    pub fn answers_sample_values(&self) -> bool {
        self.sample_values && self.has_standard_samples()
    }

    /// Whether samples lie where the protocol has them: the pixel is sampled at its centre by the top-left rule.
    fn has_standard_samples(&self) -> bool {
        self.shape == Shape::Sample && self.convention.is_standard()
    }

    /// How many steps a share may be off, with what roundings of floats add.
    #[must_use]
    pub fn steps_off(&self) -> f64 {
        self.area_tolerance + ROUNDING_OF_STEPS
    }

    /// How much of a pixel a triangle covers, exactly, in [0, 1]: nothing where its winding is not drawn.
    #[must_use]
    pub fn share(&self, corners: &Corners, [x_px, y_px]: [i32; 2]) -> f64 {
        match self.convention.draws(twice_area(corners)) {
            true => share(corners, x_px, y_px),
            false => 0.0,
        }
    }

    /// The words for the kinds of questions that it answers.
    pub fn capabilities(&self) -> Vec<&'static str> {
        let mut all = vec![
            ("coverage", self.coverage),
            ("attributes", self.attributes),
            ("samples4", self.samples4),
            ("line", self.line),
            ("depth", self.depth),
            ("clip", self.clip),
            ("clip-attributes", self.clip_attributes),
            ("wide-line", self.wide_line),
            ("area", self.area),
            ("sample-values", self.sample_values),
            ("formulas", self.formulas),
            ("partition", self.partition),
        ];
        all.retain(|(_, has)| *has);
        all.into_iter().map(|(word, _)| word).collect()
    }
}

/// A distance in px as subpixels; nothing where it is no whole number of them, or a pixel too far.
fn subpixels(word: &str) -> Option<i32> {
    let sub = number(word)? * f64::from(SUBPIXELS);
    (sub.fract() == 0.0 && sub.abs() <= f64::from(2 * SUBPIXELS)).then_some(sub as i32)
}

impl fmt::Display for Declared {
    /// The words after the name, as HELLO 2 has them.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.capabilities().join(" "))?;
        // A tessellator has words of its own, and none of a rasterizer.
        if self.partition {
            let Tessellation { fill_rule, winding, coordinates, t_junctions, degenerate, .. } =
                &self.tessellation;
            let fill_rule = word_of(&FILL_RULES, fill_rule);
            let winding = word_of(&WINDINGS, winding);
            let coordinates = word_of(&COORDINATES, coordinates);
            write!(f, " fill-rule={fill_rule} triangles={winding} coordinates={coordinates}")?;
            f.write_str(if *t_junctions { " t-junctions" } else { "" })?;
            return f.write_str(if *degenerate { " degenerate" } else { "" });
        }
        // The convention is always said, since a reader cannot know what is meant by leaving it out.
        let Convention { rule, winding, sample: [x, y], y_up, .. } = self.convention;
        write!(f, " grid={} origin={},{}", self.grid(), px(x), px(y))?;
        write!(f, " rule={} winding={}", rule.word(), winding.word())?;
        // Everything else is said where it is not what the protocol takes for granted.
        let flags = [("yup", y_up), ("mask", self.mask), ("line-set", self.line_set)];
        for (word, _) in flags.iter().filter(|(_, is_set)| *is_set) {
            write!(f, " {word}")?;
        }
        if self.shape != Shape::Sample {
            write!(f, " shape={}", self.shape.name())?;
        }
        if self.wide != WideForm::default() {
            write!(f, " wide={}", self.wide.name())?;
        }
        if self.area {
            write!(f, " levels={} area-tolerance={}", self.levels, self.area_tolerance)?;
        }
        if self.sample_values {
            write!(f, " values-at={}", self.values_at.name())?;
        }
        if self.near_is_zero {
            f.write_str(" near=zero")?;
        }
        if let Some(range) = self.range {
            write!(f, " range={range}")?;
        }
        if let Some([width, height]) = self.window {
            write!(f, " window={width}x{height}")?;
        }
        write!(f, " batch={}", self.batch)?;
        // A tolerance means something only where numbers are answered.
        let has_values = self.attributes || self.sample_values;
        if has_values || self.depth || self.clip || self.clip_attributes {
            write!(f, " tolerance={:e}", self.tolerance)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn declarations_are_read_and_said_again() {
        let line = "HELLO 2 mine coverage attributes depth clip clip-attributes grid=16 origin=0,0.25 rule=strict winding=ccw \
                    yup mask shape=touched near=zero range=4096 window=64x32 batch=8 tolerance=1e-5";
        let declared = Declared::parse(line).unwrap();
        assert_eq!((declared.grid(), declared.convention.sample), (16, [0, 64]));
        assert_eq!(
            (declared.convention.rule, declared.convention.seen_winding()),
            (Rule::Strict, Winding::Clockwise)
        );
        assert_eq!((declared.range, declared.window), (Some(4096), Some([64, 32])));
        assert!(declared.unknown.is_empty());
        let again = Declared::parse(&format!("HELLO 2 mine {declared}")).unwrap();
        assert_eq!(again, declared);
    }

    #[test]
    fn declarations_of_a_tessellator_are_said_again() {
        let said =
            "partition fill-rule=nonzero triangles=cw coordinates=f32 t-junctions degenerate";
        let declared = Declared::parse(&format!("HELLO 2 mine {said}")).unwrap();
        assert!(declared.unknown.is_empty() && declared.to_string() == said, "{declared}");
        let other = Declared::parse("HELLO 2 mine partition fill-rule=odd triangles=left").unwrap();
        assert_eq!(other.unknown.len(), 2);
        assert_eq!(
            other.to_string(),
            "partition fill-rule=even-odd triangles=alike coordinates=f64"
        );
    }

    #[test]
    fn a_misspelt_declaration_is_an_error_with_the_nearest_word() {
        let error = |words: &str| Declared::default().declare(words).unwrap_err();
        for (words, said) in [
            ("rule=topleft", "'rule=topleft' is not understood; did you mean 'rule=top-left'?"),
            (
                "range=4096 rul=strict",
                "'rul=strict' is not understood; did you mean 'rule=strict'?",
            ),
            ("rnage=4096", "'rnage=4096' is not understood; did you mean 'range=4096'?"),
            ("Winding=CW", "'Winding=CW' is not understood; did you mean 'winding=cw'?"),
            (
                "winding=clockwise",
                "'winding=clockwise' is not understood; expected one of winding=cw, winding=ccw, winding=both",
            ),
            ("y-up", "'y-up' is not understood; did you mean 'yup'?"),
            ("grid=2566", "'grid=2566' is not understood; did you mean 'grid=256'?"),
            ("window=8", "'window=8' is not understood; expected window=WxH, each from 1 to "),
            ("dance", "'dance' is not understood; expected words such as rule=..., "),
        ] {
            assert!(error(words).starts_with(said), "{}", error(words));
        }
        // Every word that is offered is one that is taken.
        for word in FLAGS {
            assert_eq!(Declared::default().declare(word), Ok(()));
        }
        for (key, values) in listed() {
            for value in values {
                assert_eq!(Declared::default().declare(&format!("{key}={value}")), Ok(()));
            }
        }
    }

    #[test]
    fn what_cannot_be_used_is_reported() {
        let line = "HELLO 2 a\u{1b}[2J coverage grid=3 origin=0.3,0 window=0x1 batch=0 dance";
        let declared = Declared::parse(line).unwrap();
        assert_eq!(declared.unknown.len(), 5, "{:?}", declared.unknown);
        assert!(declared.name.chars().all(|c| !c.is_control()));
        assert_eq!((declared.grid(), declared.batch), (256, 1));
        assert_eq!(Declared::parse("HELLO 3 x coverage"), None);
        assert_eq!(Declared::parse("HELLO 1"), None);
        let flipped = Declared::parse("HELLO 2 gl coverage rule=top-left yup").unwrap();
        assert_eq!(flipped.convention.seen_rule(), Rule::BottomLeft);
    }
}
