//! What is said of a model, in words.

use super::change::{Change, How, Points, Toward};
use super::drawer::Drawer;
use super::model::{GuardedStep, Model, Step, Vocabulary, Wrong};
use super::quantity::Name;
use super::question::Unit;
use super::rule::{Conjunction, Fact, Of, Test};

/// A number of a quantity, in px or px² where it is one.
fn number(unit: Unit, v: i64) -> String {
    let (per, word) = match unit {
        Unit::Subpixels => (256.0, " px"),
        Unit::Area => (131_072.0, " square pixels"),
        Unit::Ratio => (256.0, ""),
        Unit::Value => return format!("{}", (v as f64 / VALUE * 1e6).round() / 1e6),
        Unit::Pixels => (1.0, " px"),
        Unit::Flag | Unit::Count | Unit::Paired | Unit::Involved => (1.0, ""),
    };
    format!("{}{word}", v as f64 / per)
}

/// Steps of [`Unit::Value`].
const VALUE: f64 = (1_i64 << 20) as f64;

/// Counts read better as 'at most 7', lengths as 'less than 8 px'.
fn limited(noun: &str, unit: Unit, test: Test) -> String {
    let is_count = matches!(unit, Unit::Flag | Unit::Count | Unit::Paired | Unit::Involved);
    match test {
        Test::AtMost(-1) => format!("{noun} is negative"),
        Test::AtLeast(1) if !is_count => format!("{noun} is positive"),
        Test::AtMost(v) if is_count => format!("{noun} is at most {v}"),
        Test::AtMost(v) => format!("{noun} is less than {}", number(unit, v + 1)),
        Test::AtLeast(v) => format!("{noun} is {} or more", number(unit, v)),
        _ => unreachable!("other tests have words of their own"),
    }
}

fn modular(noun: &str, unit: Unit, test: Test) -> String {
    let step = |by: i64| number(unit, by);
    match (test, unit) {
        (Test::Remainder(256, 0), Unit::Subpixels) => format!("{noun} is a whole number of px"),
        (Test::NoMultiple(256), Unit::Subpixels) => format!("{noun} is no whole number of px"),
        (Test::Remainder(2, rest), Unit::Count | Unit::Paired | Unit::Involved | Unit::Pixels) => {
            format!("{noun} is {}", ["even", "odd"][rest as usize])
        }
        (Test::NoMultiple(2), Unit::Count | Unit::Paired | Unit::Involved | Unit::Pixels) => {
            format!("{noun} is odd")
        }
        (Test::Remainder(by, 0), _) => format!("{noun} is a multiple of {}", step(by)),
        (Test::Remainder(by, rest), _) => format!("{noun} is {rest} modulo {by}"),
        (Test::NoMultiple(by), _) => format!("{noun} is no multiple of {}", step(by)),
        _ => unreachable!("other tests have words of their own"),
    }
}

/// A comparison of two quantities.
fn compared(a: &str, b: &str, test: Test) -> String {
    let how = match test {
        Test::Is(_) => "equals",
        Test::IsNot(_) => "is not",
        Test::AtMost(0) => "is at most",
        Test::AtMost(_) => "is less than",
        Test::AtLeast(0) => "is at least",
        _ => "is greater than",
    };
    format!("{a} {how} {b}")
}

pub(super) fn fact(fact: &Fact, names: &[Name]) -> String {
    let i = match fact.of {
        Of::Difference(i, j) => return compared(&names[i].noun, &names[j].noun, fact.test),
        Of::One(i) => i,
    };
    let Name { unit, noun, zero: [yes, no] } = &names[i];
    match fact.test {
        // A flag has words for both.
        Test::Is(v) if *unit == Unit::Flag => {
            if v == 1 {
                noun.clone()
            } else {
                yes.clone()
            }
        }
        Test::Is(0) if !yes.is_empty() => yes.clone(),
        Test::IsNot(0) if !no.is_empty() => no.clone(),
        Test::Is(v) => format!("{noun} is {}", number(*unit, v)),
        Test::IsNot(v) => format!("{noun} is not {}", number(*unit, v)),
        test @ (Test::AtMost(_) | Test::AtLeast(_)) => limited(noun, *unit, test),
        test @ (Test::Remainder(..) | Test::NoMultiple(_)) => modular(noun, *unit, test),
    }
}

pub(super) fn facts(facts: &[Fact], names: &[Name]) -> String {
    facts.iter().map(|f| fact(f, names)).collect::<Vec<_>>().join(", and ")
}

/// What a model does: a sentence for each step.
pub(super) fn sentences(
    model: &Model,
    drawer: &dyn Drawer,
    vocabulary: &Vocabulary,
) -> Vec<String> {
    let is_line = vocabulary.names.iter().any(|name| name.noun == "dx");
    let mut out: Vec<String> = Vec::new();
    for (number, guarded) in model.chain.iter().enumerate() {
        out.push(base(guarded, number > 0, is_line, drawer, vocabulary));
    }
    for step in &model.steps {
        let said = pixels(step, vocabulary);
        // A step is about what the steps before it draw.
        let is_first = out.is_empty();
        out.push(if is_first { said } else { said.replacen("It ", "Of what is left, it ", 1) });
    }
    out
}

fn base(
    guarded: &GuardedStep,
    is_other: bool,
    is_line: bool,
    drawer: &dyn Drawer,
    vocabulary: &Vocabulary,
) -> String {
    let parts: Vec<String> = guarded.base.changes.iter().map(|c| change(c, is_line)).collect();
    let rule = &drawer.rules()[guarded.base.rule];
    let is_nothing = guarded.base.changes == [Change::Nothing];
    let parts = if is_nothing { Vec::new() } else { parts };
    let mut how = String::from(if is_nothing { "draws nothing" } else { "draws" });
    if !rule.is_empty() {
        how += &format!(" {rule}");
    }
    if !parts.is_empty() {
        how += &format!(" as if {}", parts.join(" and "));
    }
    let when = |all: &Vec<Conjunction>| {
        let all = all.iter().map(|f| facts(f, &vocabulary.names));
        all.collect::<Vec<_>>().join("; or where ")
    };
    match (&guarded.when, is_other) {
        (Some(all), false) => format!("It {how} where {}.", when(all)),
        (Some(all), true) => format!("Elsewhere, it {how} where {}.", when(all)),
        (None, false) => format!("It {how}."),
        (None, true) => format!("Elsewhere, it {how}."),
    }
}

fn pixels(step: &Step, vocabulary: &Vocabulary) -> String {
    let [of_question, of_pixel] = step.split(vocabulary);
    let names = &vocabulary.names;
    let does = match (step.wrong, of_pixel.is_empty()) {
        (Wrong::Missing, true) => "It draws nothing".to_owned(),
        (Wrong::Extra, true) => "It fills the window".to_owned(),
        (Wrong::Twice, true) => "It draws every pixel more than once".to_owned(),
        (Wrong::Missing, false) => {
            format!("It leaves out each pixel where {}", facts(&of_pixel, names))
        }
        (Wrong::Extra, false) => {
            format!("It draws, too, each pixel where {}", facts(&of_pixel, names))
        }
        (Wrong::Twice, false) => {
            format!("It draws more than once each pixel where {}", facts(&of_pixel, names))
        }
    };
    let when = match (of_question.is_empty(), of_pixel.is_empty()) {
        (true, _) => String::new(),
        (_, true) => format!(" where {}", facts(&of_question, names)),
        (_, false) => format!(", only where {}", facts(&of_question, names)),
    };
    format!("{does}{when}.")
}

fn change(change: &Change, is_line: bool) -> String {
    let (points, axes, how) = match change {
        Change::Nothing => return "nothing were given".to_owned(),
        Change::Exchange => return "x and y were exchanged".to_owned(),
        Change::Reverse => return "its ends were exchanged".to_owned(),
        Change::Move { points, axes, how } => (points, axes, how),
    };
    let axis = match axes {
        [true, true] => "x and y",
        [true, false] => "x",
        _ => "y",
    };
    let point = if is_line { "end" } else { "corner" };
    let of = match points {
        Points::All => format!("of every {point}"),
        Points::Given(i) => format!("of the {} {point}", ["first", "second", "third"][*i]),
        Points::ByHeight(i) => format!("of the {} {point}", ["top", "middle", "bottom"][*i]),
    };
    let verb = if axes == &[true, true] { "were" } else { "was" };
    format!("{axis} {of} {verb} {}", transformed(*how, if is_line { 1.0 } else { 256.0 }))
}

fn transformed(how: How, one: f64) -> String {
    let px = |v: i64| format!("{} px", v as f64 / one);
    let power = |bits: u32| px(1 << bits);
    match how {
        How::Snap(step, toward) => {
            let toward = match toward {
                Toward::Down => "down",
                Toward::Nearest => "to the nearest",
                Toward::Up => "up",
                Toward::Zero => "toward 0",
            };
            let multiple =
                if step as f64 >= one { px(step) } else { format!("1/{} px", one as i64 / step) };
            format!("rounded {toward}, to multiples of {multiple}")
        }
        How::Add(by) => format!("moved by {}", px(by)),
        How::AtLeast(least) => format!("at least {}", px(least)),
        How::AtMostSide(less) => {
            format!("at most the side of the window{}", lessened(&px(less), less))
        }
        How::IntoWindow(less) => format!(
            "clamped to the range from 0 to the side of the window{}",
            lessened(&px(less), less)
        ),
        How::Wrap(bits, true) => {
            format!("wrapped into the range from -{} to {}", power(bits - 1), power(bits - 1))
        }
        How::Wrap(bits, false) => format!("wrapped into the range from 0 to {}", power(bits)),
        How::Saturate(bits) => {
            format!("limited to the range from -{} to {}", power(bits - 1), power(bits - 1))
        }
        How::Absolute => "without its sign".to_owned(),
        How::Mirror(less) => format!(
            "mirrored: the side of the window{} less the coordinate",
            lessened(&px(less), less)
        ),
        How::AboutFirst => "on the other side of the first point".to_owned(),
        How::Scale(times) => format!("multiplied by {}", times as f64 / 256.0),
    }
}

fn lessened(px: &str, less: i64) -> String {
    match less {
        0 => String::new(),
        less if less < 0 => format!(" plus {}", px.trim_start_matches('-')),
        _ => format!(" less {px}"),
    }
}
