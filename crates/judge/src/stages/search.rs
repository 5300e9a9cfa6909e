//! The search for a mistake as a value: the right value with one field changed, with two, or changed in some places alone.
//!
//! A stage implements [`Stage`] with types of its own. The search sees it as [`AnswerParts`], which hides these types: so the search
//! is compiled once, and not once for each stage.

use std::any::Any;
use std::ops::Range;
use std::rc::Rc;

use rasterproof_core::grid::PixelRect;
use rasterproof_verify::mistakes::{Explanation, chosen_by, values};

use crate::ask::{Answer, Question};
use crate::declared::Declared;

/// What is said of a wrong value of a field: the kind of mistake, what a program does, after 'it', and what repairs it. A part of
/// the value on which this depends is '{}'.
pub struct StageWords {
    pub name: &'static str,
    pub does: String,
    pub repair: &'static str,
}

/// A field of a stage: it is right by default.
pub trait Field: Clone + Default + PartialEq {
    const NAME: &'static str;

    /// Its wrong values, except for those with numbers that are read off the answers.
    fn options() -> Vec<Self>;

    /// What is said of a wrong value, and the repair; nothing where other fields say it.
    fn says(&self) -> Option<(String, &'static str)>;
}

/// The fields of a stage, of which each is changed on its own.
pub trait Composed: Clone + Default + PartialEq {
    /// The right value with one field changed, in every way.
    fn options() -> Vec<Self>;

    /// This value with what is wrong in another one.
    fn with(&self, other: &Self) -> Self;

    /// What each wrong field says.
    fn said(&self) -> Vec<StageWords>;
}

macro_rules! composed {
    ($(#[$doc:meta])* pub struct $name:ident { $($field:ident: $kind:ty,)+ }) => {
        $(#[$doc])*
        #[derive(Clone, Debug, Default, PartialEq)]
        pub struct $name { $(pub $field: $kind,)+ }

        impl $crate::stages::search::Composed for $name {
            fn options() -> Vec<Self> {
                use $crate::stages::search::Field;
                let mut all = Vec::new();
                $(all.extend(<$kind as Field>::options().into_iter().map(|$field| Self { $field, ..Self::default() }));)+
                all
            }

            fn with(&self, other: &Self) -> Self {
                let (mut both, right) = (self.clone(), Self::default());
                $(if other.$field != right.$field {
                    both.$field = other.$field.clone();
                })+
                both
            }

            fn said(&self) -> Vec<$crate::stages::search::StageWords> {
                use $crate::stages::search::{Field, StageWords};
                let (mut all, right) = (Vec::new(), Self::default());
                $(if self.$field != right.$field {
                    let said = self.$field.says();
                    all.extend(said.map(|(does, repair)| StageWords { name: <$kind as Field>::NAME, does, repair }));
                })+
                all
            }
        }
    };
}
pub(super) use composed;

/// A field whose wrong values are a few words, with the repair of all of them.
macro_rules! choices {
    (
        $(#[$doc:meta])*
        pub enum $name:ident: $called:literal, $repair:literal {
            $right:ident,
            $($(#[$of_wrong:meta])* $wrong:ident = $does:literal,)+
        }
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub enum $name {
            #[default]
            $right,
            $($(#[$of_wrong])* $wrong,)+
        }

        impl $crate::stages::search::Field for $name {
            const NAME: &'static str = $called;

            fn options() -> Vec<Self> {
                vec![$(Self::$wrong),+]
            }

            fn says(&self) -> Option<(String, &'static str)> {
                let does = match self {
                    Self::$right => return None,
                    $(Self::$wrong => $does,)+
                };
                Some((does.to_owned(), $repair))
            }
        }
    };
}
pub(super) use choices;

/// A stage of a pipeline as it may be mistaken.
pub trait Stage: Composed + 'static {
    /// What is answered at once: a pixel, or a polygon. It holds the answer.
    type Part<'a>: 'a;

    /// The page of the book, and an observation that would refute a mistake.
    const PAGE: &'static str;
    const REFUTED: &'static str;
    /// How far numbers may be off by rounding, of programs in `f64` and in `f32`, where that matters.
    const NOISE: &'static [f64];
    /// What the parts are, in the plural.
    const WHOM: &'static str;

    fn parts<'a>(
        question: &'a Question,
        answer: &'a Answer,
        declared: &Declared,
        noise: f64,
    ) -> Vec<Self::Part<'a>>;

    /// Whether the answer is one that a program of this value gives.
    fn explains(&self, part: &Self::Part<'_>) -> bool;

    /// This value with numbers that are read off answers, as they would be if all else were as it is here.
    fn solved(&self, _: &[&Self::Part<'_>]) -> Vec<Self> {
        Vec::new()
    }

    /// What may decide where a program is wrong: the same quantities of each part, in the same order.
    fn quantities(part: &Self::Part<'_>) -> Vec<Quantity>;

    /// What is said of wrong parts where no mistake is found.
    fn observations(part: &Self::Part<'_>) -> Vec<Quantity> {
        Self::quantities(part)
    }

    /// A sentence with its '{}' filled in.
    fn filled(&self, does: &str) -> String;
}

/// A number of a part of an answer.
#[derive(Clone, Copy)]
pub struct Quantity {
    value: f64,
    /// What it is, after 'where'; or what is said of a part that has 1 and of one that has 0, which may be nothing.
    says: Says,
}

/// How a quantity is said: as a number with a name, or as what holds where it is 1 and where it is 0.
#[derive(Clone, Copy)]
enum Says {
    Number(&'static str),
    Whether([&'static str; 2]),
}

impl Quantity {
    /// A number with its name.
    pub fn number(name: &'static str, value: impl Into<f64>) -> Self {
        Self { value: value.into(), says: Says::Number(name) }
    }

    /// Whether something holds of the part: what is said of the parts where it does, and of the others.
    pub fn whether(holds: bool, yes: &'static str, no: &'static str) -> Self {
        Self { value: f64::from(u8::from(holds)), says: Says::Whether([yes, no]) }
    }
}

/// The quantities of a part, in the order of its stage.
type Row = Vec<Quantity>;

/// A value of any stage. Only the stage that made it looks into it.
pub type AnyValue = Rc<dyn Any>;

/// Parts of answers of one stage, and what the search asks of the stage. Each part is meant by its place in the list.
pub trait AnswerParts<'a> {
    fn count(&self) -> usize;

    /// Adds the parts of an answer.
    fn add(&mut self, question: &'a Question, answer: &'a Answer, declared: &Declared, noise: f64);

    /// The noises with which parts are made, the least first.
    fn noises(&self) -> &'static [f64];

    /// What the parts are, in the plural.
    fn whom(&self) -> &'static str;

    /// The value of a program that makes no mistake.
    fn right(&self) -> AnyValue;

    /// The right value with one field changed, with what is read off the parts at these places.
    fn singles(&self, places: &[usize]) -> Vec<AnyValue>;

    /// A value with what is wrong in another one; nothing where that is the other one alone, since both change one field.
    fn both(&self, first: &AnyValue, second: &AnyValue) -> Option<AnyValue>;

    fn explains(&self, value: &AnyValue, place: usize) -> bool;

    fn solved(&self, value: &AnyValue, places: &[usize]) -> Vec<AnyValue>;

    fn quantities(&self, place: usize) -> Row;

    fn observations(&self, place: usize) -> Row;

    /// What is said of a value, and `whereabouts` after it.
    fn says(&self, value: &AnyValue, whereabouts: &str) -> Explanation;
}

/// Hides the types of a stage.
struct PartsOf<'a, S: Stage>(Vec<S::Part<'a>>);

/// An empty list of the parts of a stage.
pub fn no_parts<'a, S: Stage>() -> Box<dyn AnswerParts<'a> + 'a> {
    Box::new(PartsOf::<'a, S>(Vec::new()))
}

/// The value as the stage knows it.
fn typed<S: Stage>(value: &AnyValue) -> &S {
    value.downcast_ref().expect("a value of this stage")
}

/// Values, or changes, whose type is hidden.
pub(super) fn hidden<T: Any>(values: Vec<T>) -> Vec<Rc<dyn Any>> {
    let mut all: Vec<Rc<dyn Any>> = Vec::new();
    for value in values {
        all.push(Rc::new(value));
    }
    all
}

/// The parts that stand at some places of a list.
pub(super) fn at_places<'a, P>(parts: &'a [P], places: &[usize]) -> Vec<&'a P> {
    places.iter().map(|place| &parts[*place]).collect()
}

impl<'a, S: Stage> AnswerParts<'a> for PartsOf<'a, S> {
    fn count(&self) -> usize {
        self.0.len()
    }

    fn add(&mut self, question: &'a Question, answer: &'a Answer, declared: &Declared, noise: f64) {
        self.0.append(&mut S::parts(question, answer, declared, noise));
    }

    fn noises(&self) -> &'static [f64] {
        S::NOISE
    }

    fn whom(&self) -> &'static str {
        S::WHOM
    }

    fn right(&self) -> AnyValue {
        Rc::new(S::default())
    }

    fn singles(&self, places: &[usize]) -> Vec<AnyValue> {
        hidden(singles::<S>(&at_places(&self.0, places)))
    }

    fn both(&self, first: &AnyValue, second: &AnyValue) -> Option<AnyValue> {
        let both = both(typed::<S>(first), typed::<S>(second))?;
        Some(Rc::new(both))
    }

    fn explains(&self, value: &AnyValue, place: usize) -> bool {
        typed::<S>(value).explains(&self.0[place])
    }

    fn solved(&self, value: &AnyValue, places: &[usize]) -> Vec<AnyValue> {
        hidden(typed::<S>(value).solved(&at_places(&self.0, places)))
    }

    fn quantities(&self, place: usize) -> Row {
        S::quantities(&self.0[place])
    }

    fn observations(&self, place: usize) -> Row {
        S::observations(&self.0[place])
    }

    fn says(&self, value: &AnyValue, whereabouts: &str) -> Explanation {
        said_of(typed::<S>(value), whereabouts)
    }
}

/// What is said of a value, and `whereabouts` after it.
pub fn said_of<S: Stage>(value: &S, whereabouts: &str) -> Explanation {
    // Each wrong field says what it does, and the repairs of several are one list.
    let said = value.said();
    let does: Vec<_> = said.iter().map(|said| said.does.as_str()).collect();
    let mut repairs: Vec<_> = said.iter().map(|said| said.repair).collect();
    repairs.dedup();
    let does = value.filled(&does.join(", and ")) + whereabouts;
    let name = said.first().map_or("", |said| said.name);
    Explanation::new(name, does, repairs.join("; "), S::PAGE, S::REFUTED)
}

/// A value with what is wrong in another one; nothing where that is the other one alone, since both change one field.
pub fn both<S: Stage>(first: &S, second: &S) -> Option<S> {
    let both = first.with(second);
    (both != *second).then_some(both)
}

/// The right value with one field changed, with what is read off all answers or off some.
pub fn singles<S: Stage>(parts: &[&S::Part<'_>]) -> Vec<S> {
    let mut all = S::options();
    all.append(&mut S::default().solved(parts));
    all
}

/// A test of a number, of which the simplest that tells wrong parts from right ones are tried.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Test {
    Is(f64),
    /// The rest of a division.
    Rest(f64, f64),
    AtLeast(f64),
    AtMost(f64),
}

impl Test {
    fn holds(self, v: f64) -> bool {
        match self {
            Self::Is(wanted) => v == wanted,
            Self::Rest(by, rest) => v.rem_euclid(by) == rest,
            Self::AtLeast(least) => v >= least,
            Self::AtMost(most) => v <= most,
        }
    }

    /// What all of these numbers pass, and some of the others do not.
    fn all(inside: &[f64], outside: &[f64]) -> Vec<Self> {
        let (mut least, mut most) = (f64::MAX, f64::MIN);
        for v in inside {
            (least, most) = (least.min(*v), most.max(*v));
        }
        // Equality, then the rest of a division by a small power of two, as in odd rows.
        let mut all = vec![Self::Is(least)];
        for by in [2.0, 4.0, 8.0, 16.0] {
            all.push(Self::Rest(by, least.rem_euclid(by)));
        }
        // A limit lies between these numbers and the nearest of the others, and is as simple as there is room for.
        let (mut below, mut above) = (None, None);
        for &v in outside {
            if v < least {
                below = Some(below.map_or(v, |nearest: f64| nearest.max(v)));
            } else if v > most {
                above = Some(above.map_or(v, |nearest: f64| nearest.min(v)));
            }
        }
        all.extend(below.map(|below| Self::AtLeast(values::simplest(least, below))));
        all.extend(above.map(|above| Self::AtMost(values::simplest(most, above))));
        all.retain(|test| inside.iter().all(|v| test.holds(*v)));
        all
    }
}

/// That a quantity passes a test: where a program is wrong.
struct Fact {
    /// The number of the quantity in a row.
    number: usize,
    says: Says,
    test: Test,
}

impl Fact {
    fn holds(&self, row: &Row) -> bool {
        self.test.holds(row[self.number].value)
    }

    /// How it is said; nothing where it says nothing.
    fn words(&self) -> Option<String> {
        // What holds or does not is said by its words alone; a number needs its name and the test.
        let name = match (self.says, self.test) {
            (Says::Whether([yes, no]), Test::Is(v)) => {
                let said = if v == 1.0 { yes } else { no };
                return (!said.is_empty()).then(|| said.to_owned());
            }
            (Says::Whether(_), _) => return None,
            (Says::Number(name), _) => name,
        };
        Some(match self.test {
            Test::Is(v) => format!("where {name} is {v}"),
            Test::Rest(2.0, 0.0) => format!("where {name} is even"),
            Test::Rest(2.0, _) => format!("where {name} is odd"),
            Test::Rest(by, rest) => format!("where {name} is {rest} modulo {by}"),
            Test::AtLeast(v) => format!("where {name} is at least {v}"),
            Test::AtMost(v) => format!("where {name} is at most {v}"),
        })
    }
}

/// The numbers of one quantity in some rows.
fn column(rows: &[Row], number: usize) -> Vec<f64> {
    rows.iter().map(|row| row[number].value).collect()
}

/// What holds of all wrong parts, as sentences about `whom`.
pub fn common(whom: &str, wrong: &[Row]) -> Vec<String> {
    let mut said = Vec::new();
    let Some(first) = wrong.first() else { return said };
    for (number, Quantity { says, .. }) in first.iter().enumerate() {
        // One value, or even or odd values; other tests would say little about parts that were not chosen.
        for test in Test::all(&column(wrong, number), &[]) {
            if matches!(test, Test::Is(_) | Test::Rest(2.0, _)) {
                let words = Fact { number, says: *says, test }.words();
                said.extend(words.map(|words| format!("All wrong {whom} are {words}.")));
                break;
            }
        }
    }
    said
}

/// A wrong value, in all places or in those where some facts hold.
pub struct Mistake {
    value: AnyValue,
    facts: Vec<Fact>,
}

impl Mistake {
    /// A value that is wrong in all places.
    fn everywhere(value: AnyValue) -> Self {
        Self { value, facts: Vec::new() }
    }

    /// Whether a program with this mistake answers a part as it was answered.
    pub fn explains(&self, parts: &dyn AnswerParts<'_>, place: usize) -> bool {
        if self.facts.is_empty() {
            return parts.explains(&self.value, place);
        }
        let row = parts.quantities(place);
        let is_wrong_here = self.facts.iter().all(|fact| fact.holds(&row));
        let value = if is_wrong_here { &self.value } else { &parts.right() };
        parts.explains(value, place)
    }

    /// What is said of the mistake, with the facts of the places where it is made.
    pub fn says(&self, parts: &dyn AnswerParts<'_>) -> Explanation {
        let facts: Vec<_> = self.facts.iter().filter_map(Fact::words).collect();
        let whereabouts = match facts[..] {
            [] => String::new(),
            _ => format!(" {}", facts.join(" and ")),
        };
        parts.says(&self.value, &whereabouts)
    }
}

/// Pairs of changes that are tried, and values of which the first ones are changed further by what is read off.
const MOST_PAIRS: usize = 400_000;
const BEAM: usize = 24;
/// Single changes that are weighed: those that explain most of what is wrong.
const MOST_SINGLES: usize = 100;
const MOST_LEADS: usize = 20;
/// Wrong parts by which changes are compared, facts of a place, and parts by which these are learned.
const LOOKED_AT: usize = 64;
const MOST_FACTS: usize = 3;
const MOST_PARTS: usize = 20_000;

/// Whether a value explains the parts at all of these places.
pub fn explains_all(parts: &dyn AnswerParts<'_>, value: &AnyValue, places: &[usize]) -> bool {
    places.iter().all(|place| parts.explains(value, *place))
}

/// The mistakes that may explain answers, the simplest first; each case has the parts in its range.
pub fn search(
    parts: &dyn AnswerParts<'_>,
    cases: &[Range<usize>],
    is_wrong: &[bool],
) -> Vec<Mistake> {
    // The parts of some cases are enough to choose by.
    // Right is what a program without a mistake may answer.
    let value = parts.right();
    let (mut right, mut wrong) = (Vec::new(), Vec::new());
    for case in chosen_by(is_wrong) {
        for place in cases[case].clone() {
            if parts.explains(&value, place) { &mut right } else { &mut wrong }.push(place);
        }
    }
    let (right, wrong) = (mixed(&right), mixed(&wrong));
    // What is wrong comes first, so that what explains little is left soon.
    let places = [&wrong[..], &right[..]].concat();
    // One field that is wrong: those that explain most of what is wrong come first.
    let mut singles = parts.singles(&places);
    let looked_at = &wrong[..wrong.len().min(LOOKED_AT)];
    singles.sort_by_cached_key(|value| {
        looked_at.iter().filter(|place| !parts.explains(value, **place)).count()
    });
    let best = &singles[..singles.len().min(MOST_SINGLES)];
    let mut found = Vec::new();
    for value in best {
        if explains_all(parts, value, &places) {
            found.push(Mistake::everywhere(Rc::clone(value)));
        }
    }
    if wrong.is_empty() || !found.is_empty() {
        return found;
    }
    // Those that explain less may be leads.
    for value in &best[..best.len().min(MOST_LEADS)] {
        found.push(Mistake::everywhere(Rc::clone(value)));
    }
    // A field that is wrong in some places alone.
    let some_right = &right[..right.len().min(MOST_PARTS)];
    for value in &singles {
        found.extend(in_places(parts, value, &wrong, some_right));
    }
    // Two wrong fields: the numbers of one are read off as they are where the other is wrong, or both are from the list.
    for value in singles.iter().take(BEAM) {
        for value in parts.solved(value, &places) {
            if explains_all(parts, &value, &places) {
                found.push(Mistake::everywhere(value));
            }
        }
    }
    let mut tried = 0;
    for (i, first) in singles.iter().enumerate() {
        for second in &singles[i + 1..] {
            if tried == MOST_PAIRS {
                return found;
            }
            tried += 1;
            let Some(both) = parts.both(first, second) else { continue };
            if explains_all(parts, &both, &places) {
                found.push(Mistake::everywhere(both));
            }
        }
    }
    found
}

/// Neighbours are alike, so that some from everywhere come first.
fn mixed(all: &[usize]) -> Vec<usize> {
    // Steps of a large prime, modulo the count, go through all of them in an order that looks random.
    let mut order: Vec<usize> = (0..all.len()).collect();
    order.sort_by_key(|i| i * 7919 % all.len());
    order.into_iter().map(|i| all[i]).collect()
}

/// A value in the places in which it explains what is wrong, where it explains all of that and other places are right.
fn in_places(
    parts: &dyn AnswerParts<'_>,
    value: &AnyValue,
    wrong: &[usize],
    right: &[usize],
) -> Option<Mistake> {
    if !explains_all(parts, value, wrong) {
        return None;
    }
    // The facts tell the wrong parts from those right ones that the value would make wrong.
    let inside: Vec<Row> = wrong.iter().map(|place| parts.quantities(*place)).collect();
    let mut outside: Vec<Row> = Vec::new();
    for place in right {
        if !parts.explains(value, *place) {
            outside.push(parts.quantities(*place));
        }
    }
    let mut facts = Vec::new();
    while !outside.is_empty() && facts.len() < MOST_FACTS {
        let fact = telling(&inside, &outside)?;
        outside.retain(|row| fact.holds(row));
        facts.push(fact);
    }
    outside.is_empty().then(|| Mistake { value: Rc::clone(value), facts })
}

/// The fact that holds of all rows inside and of the fewest outside, if it holds of some of these less than all.
fn telling(inside: &[Row], outside: &[Row]) -> Option<Fact> {
    let mut best = None;
    // A fact that holds of all rows outside tells nothing.
    let mut fewest = outside.len();
    for (number, Quantity { says, .. }) in inside.first()?.iter().enumerate() {
        let others = column(outside, number);
        for test in Test::all(&column(inside, number), &others) {
            let left = others.iter().filter(|v| test.holds(**v)).count();
            let fact = Fact { number, says: *says, test };
            if left < fewest && fact.words().is_some() {
                (best, fewest) = (Some(fact), left);
            }
        }
    }
    best
}

/// A pixel of a triangle in a window.
#[derive(Clone, Copy)]
pub struct Spot {
    pub at: [i32; 2],
    pub is_clockwise: bool,
    pub window: PixelRect,
}

impl Spot {
    /// The quantities of a pixel of a triangle.
    pub fn quantities(&self) -> Vec<Quantity> {
        // The winding comes before the place.
        let turn = Quantity::whether(
            self.is_clockwise,
            "of clockwise triangles",
            "of counterclockwise triangles",
        );
        let mut all = vec![turn];
        all.append(&mut self.place());
        all
    }

    /// Its place in the window.
    pub fn place(&self) -> Vec<Quantity> {
        let ([x, y], window) = (self.at, self.window);
        vec![
            Quantity::number("the column", x),
            Quantity::number("the row", y),
            Quantity::number("column + row", x + y),
            Quantity::whether(y == window.y0, "in the first row of the window", ""),
            Quantity::whether(y == window.y1 - 1, "in the last row of the window", ""),
            Quantity::whether(x == window.x0, "in the first column of the window", ""),
            Quantity::whether(x == window.x1 - 1, "in the last column of the window", ""),
        ]
    }
}
