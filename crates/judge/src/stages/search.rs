//! The search for a mistake as a value: the right value with one field changed, with two, or changed in some places alone.

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
    type Part<'a>;

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

    /// What may decide where a program is wrong.
    fn quantities<'a>() -> Vec<Quantity<Self::Part<'a>>>;

    /// What is said of wrong parts where no mistake is found.
    fn observations<'a>() -> Vec<Quantity<Self::Part<'a>>> {
        Self::quantities()
    }

    /// A sentence with its '{}' filled in.
    fn filled(&self, does: &str) -> String;
}

/// A number of a part of an answer.
pub struct Quantity<P> {
    pub of: fn(&P) -> f64,
    /// What it is, after 'where'; or what is said of a part that has 1 and of one that has 0, which may be nothing.
    pub says: Says,
}

impl<P> Quantity<P> {
    pub fn number(name: &'static str, of: fn(&P) -> f64) -> Self {
        Self { of, says: Says::Number(name) }
    }
}

#[derive(Clone, Copy)]
pub enum Says {
    Number(&'static str),
    Whether([&'static str; 2]),
}

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
        let (least, most) =
            inside.iter().fold((f64::MAX, f64::MIN), |(a, b), v| (a.min(*v), b.max(*v)));
        let mut all = vec![Self::Is(least)];
        all.extend([2.0, 4.0, 8.0, 16.0].map(|by| Self::Rest(by, least.rem_euclid(by))));
        let below = outside.iter().copied().filter(|v| *v < least).reduce(f64::max);
        let above = outside.iter().copied().filter(|v| *v > most).reduce(f64::min);
        all.extend(below.map(|below| Self::AtLeast(values::simplest(least, below))));
        all.extend(above.map(|above| Self::AtMost(values::simplest(most, above))));
        all.retain(|test| inside.iter().all(|v| test.holds(*v)));
        all
    }
}

/// That a quantity passes a test: where a program is wrong.
pub struct Fact<P> {
    quantity: Quantity<P>,
    test: Test,
}

impl<P> Fact<P> {
    fn holds(&self, part: &P) -> bool {
        self.test.holds((self.quantity.of)(part))
    }

    /// How it is said; nothing where it says nothing.
    fn words(&self) -> Option<String> {
        let name = match (self.quantity.says, self.test) {
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

/// What holds of all wrong parts, as sentences about `whom`.
pub fn common<P>(whom: &str, wrong: &[&P], quantities: Vec<Quantity<P>>) -> Vec<String> {
    let mut said = Vec::new();
    for quantity in quantities {
        let values: Vec<f64> = wrong.iter().map(|part| (quantity.of)(part)).collect();
        let tests = Test::all(&values, &[]).into_iter();
        let is_plain = |test: &Test| matches!(test, Test::Is(_) | Test::Rest(2.0, _));
        if let Some(test) = tests.clone().find(is_plain) {
            let words = Fact { quantity, test }.words();
            said.extend(words.map(|words| format!("All wrong {whom} are {words}.")));
        }
    }
    said
}

/// A wrong value, in all places or in those where some facts hold.
pub struct Mistake<'a, S: Stage> {
    pub value: S,
    facts: Vec<Fact<S::Part<'a>>>,
}

impl<'a, S: Stage> Mistake<'a, S> {
    pub fn plain(value: S) -> Self {
        Self { value, facts: Vec::new() }
    }

    pub fn explains(&self, part: &S::Part<'a>) -> bool {
        match self.facts.iter().all(|fact| fact.holds(part)) {
            true => self.value.explains(part),
            false => S::default().explains(part),
        }
    }

    pub fn says(&self) -> Explanation {
        let said = self.value.said();
        let does: Vec<_> = said.iter().map(|said| said.does.as_str()).collect();
        let mut repairs: Vec<_> = said.iter().map(|said| said.repair).collect();
        repairs.dedup();
        let mut does = self.value.filled(&does.join(", and "));
        let facts: Vec<_> = self.facts.iter().filter_map(Fact::words).collect();
        if !facts.is_empty() {
            does += &format!(" {}", facts.join(" and "));
        }
        let name = said.first().map_or("", |said| said.name);
        Explanation::new(name, does, repairs.join("; "), S::PAGE, S::REFUTED)
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

/// The right value with one field changed, with what is read off all answers or off some.
pub fn singles<S: Stage>(parts: &[&S::Part<'_>]) -> Vec<S> {
    let mut all = S::options();
    all.extend(S::default().solved(parts));
    all
}

/// The mistakes that may explain answers, the simplest first.
pub fn search<'a, S: Stage>(cases: &[Vec<S::Part<'a>>], is_wrong: &[bool]) -> Vec<Mistake<'a, S>> {
    let right = S::default();
    let chosen: Vec<_> = chosen_by(is_wrong).iter().flat_map(|&i| &cases[i]).collect();
    let (right_parts, wrong): (Vec<_>, Vec<_>) =
        chosen.into_iter().partition(|part| right.explains(part));
    let (right_parts, wrong) = (mixed(right_parts), mixed(wrong));
    // What is wrong comes first, so that what explains little is left soon.
    let parts: Vec<_> = wrong.iter().chain(&right_parts).copied().collect();
    let mut singles: Vec<S> = singles(&parts);
    let explains = |value: &S| parts.iter().all(|part| value.explains(part));
    let looked_at = &wrong[..wrong.len().min(LOOKED_AT)];
    singles
        .sort_by_cached_key(|value| looked_at.iter().filter(|part| !value.explains(part)).count());
    let best = singles.iter().take(MOST_SINGLES).cloned();
    let explaining: Vec<_> = best.clone().filter(explains).map(Mistake::plain).collect();
    if wrong.is_empty() || !explaining.is_empty() {
        return explaining;
    }
    // Those that explain less may be leads.
    let mut found: Vec<_> = best.take(MOST_LEADS).map(Mistake::plain).collect();
    let some_right = &right_parts[..right_parts.len().min(MOST_PARTS)];
    found.extend(singles.iter().filter_map(|value| in_places(value, &wrong, some_right)));
    let solved = singles.iter().take(BEAM).flat_map(|value| value.solved(&parts));
    let pairs = singles
        .iter()
        .enumerate()
        .flat_map(|(i, first)| singles[i + 1..].iter().map(move |second| (first, second)));
    // Of two changes of one field there is one.
    let both = pairs.take(MOST_PAIRS).map(|(first, second)| (first.with(second), second));
    let both = both.filter(|(both, second)| both != *second).map(|(both, _)| both);
    found.extend(solved.chain(both).filter(explains).map(Mistake::plain));
    found
}

/// Neighbours are alike, so that some from everywhere come first.
fn mixed<T>(all: Vec<T>) -> Vec<T> {
    let count = all.len().max(1);
    let mut all: Vec<_> = all.into_iter().enumerate().collect();
    all.sort_by_key(|(i, _)| i * 7919 % count);
    all.into_iter().map(|(_, part)| part).collect()
}

/// A value in the places in which it explains what is wrong, where it explains all of that and other places are right.
fn in_places<'a, S: Stage>(
    value: &S,
    wrong: &[&S::Part<'a>],
    right: &[&S::Part<'a>],
) -> Option<Mistake<'a, S>> {
    if !wrong.iter().all(|part| value.explains(part)) {
        return None;
    }
    let mut outside: Vec<_> = right.iter().filter(|part| !value.explains(part)).collect();
    let mut facts = Vec::new();
    while !outside.is_empty() && facts.len() < MOST_FACTS {
        let mut best: Option<(usize, Fact<_>)> = None;
        for quantity in S::quantities() {
            let [inside, others] = [
                wrong.iter().map(|part| (quantity.of)(part)).collect::<Vec<_>>(),
                outside.iter().map(|part| (quantity.of)(part)).collect(),
            ];
            for test in Test::all(&inside, &others) {
                let left = others.iter().filter(|v| test.holds(**v)).count();
                let fact = Fact { quantity: Quantity { ..quantity }, test };
                let is_better = best.as_ref().is_none_or(|(least, _)| left < *least);
                if left < outside.len() && is_better && fact.words().is_some() {
                    best = Some((left, fact));
                }
            }
        }
        let (_, fact) = best?;
        outside.retain(|part| fact.holds(part));
        facts.push(fact);
    }
    outside.is_empty().then(|| Mistake { value: value.clone(), facts })
}

/// A pixel of a triangle in a window.
#[derive(Clone, Copy)]
pub struct Spot {
    pub at: [i32; 2],
    pub is_clockwise: bool,
    pub window: PixelRect,
}

/// The quantities of a pixel.
pub fn of_pixels<P: AsRef<Spot>>() -> Vec<Quantity<P>> {
    let number = |name, of: fn(&P) -> f64| Quantity { of, says: Says::Number(name) };
    let whether = |of: fn(&P) -> f64, yes, no| Quantity { of, says: Says::Whether([yes, no]) };
    vec![
        whether(
            |p: &P| f64::from(u8::from(p.as_ref().is_clockwise)),
            "of clockwise triangles",
            "of counterclockwise triangles",
        ),
        number("the column", |p| p.as_ref().at[0].into()),
        number("the row", |p| p.as_ref().at[1].into()),
        number("column + row", |p| p.as_ref().at.iter().sum::<i32>().into()),
        whether(|p| is(p, |[_, y], w| y == w.y0), "in the first row of the window", ""),
        whether(|p| is(p, |[_, y], w| y == w.y1 - 1), "in the last row of the window", ""),
        whether(|p| is(p, |[x, _], w| x == w.x0), "in the first column of the window", ""),
        whether(|p| is(p, |[x, _], w| x == w.x1 - 1), "in the last column of the window", ""),
    ]
}

fn is<P: AsRef<Spot>>(part: &P, holds: fn([i32; 2], PixelRect) -> bool) -> f64 {
    let Spot { at, window, .. } = *part.as_ref();
    f64::from(u8::from(holds(at, window)))
}
