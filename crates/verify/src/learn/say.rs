//! What is said of a model, in words.

use super::border::{Crossing, Distance, From, Product, Slope, Tie};
use super::change::{Change, How, Points, Rule};
use super::drawer::Drawer;
use super::model::{GuardedBorder, GuardedStep, Model, Step, Vocabulary, Wrong};
use super::quantity::{Name, ORDINALS, RATIO};
use super::question::Unit;
use super::rule::{Conjunction, Fact, Of, Test};

/// A number of a quantity, in px or px² where it is one.
pub(super) fn number(unit: Unit, v: i64) -> String {
    let (per, word) = match unit {
        Unit::Subpixels | Unit::Length => (256.0, " px"),
        Unit::Area => (131_072.0, " square pixels"),
        Unit::Ratio => (RATIO as f64, ""),
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
        // Between a number and the next one, the rounder one is said.
        Test::AtMost(v) if is_rounder(v, v + 1) => {
            format!("{noun} is {} or less", number(unit, v))
        }
        Test::AtMost(v) => format!("{noun} is less than {}", number(unit, v + 1)),
        Test::AtLeast(v) if !is_count && is_rounder(v - 1, v) => {
            format!("{noun} is more than {}", number(unit, v - 1))
        }
        Test::AtLeast(v) => format!("{noun} is {} or more", number(unit, v)),
        _ => unreachable!("other tests have words of their own"),
    }
}

fn is_rounder(a: i64, b: i64) -> bool {
    a != 0 && a.trailing_zeros() > b.trailing_zeros()
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
        (Test::InSecondHalf(by, is_second), _) => {
            let half = ["first", "second"][usize::from(is_second)];
            format!("{noun} is in the {half} half of each {}", step(by))
        }
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
        test @ (Test::Remainder(..) | Test::NoMultiple(_) | Test::InSecondHalf(..)) => {
            modular(noun, *unit, test)
        }
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
    out.extend(model.borders.iter().map(|guarded| border(guarded, is_line, vocabulary)));
    out.extend(model.rows.words());
    for step in &model.steps {
        let said = pixels(step, vocabulary);
        // A step is about what the steps before it draw.
        let is_first = out.is_empty();
        out.push(if is_first { said } else { said.replacen("It ", "Of what is left, it ", 1) });
    }
    out
}

/// What mends the known wrong ways in a model.
pub(super) fn repairs(model: &Model, drawer: &dyn Drawer) -> Vec<String> {
    let rules = model.chain.iter().filter_map(|guarded| match guarded.base.rule {
        Rule::Convention(number) => Some(number),
        _ => None,
    });
    let repairs = rules.map(|rule| drawer.repair(rule).to_owned());
    repairs.filter(|repair| !repair.is_empty()).collect()
}

fn base(
    guarded: &GuardedStep,
    is_other: bool,
    is_line: bool,
    drawer: &dyn Drawer,
    vocabulary: &Vocabulary,
) -> String {
    let parts: Vec<String> = guarded.base.changes.iter().map(|c| change(c, is_line)).collect();
    let (rule, is_way) = match &guarded.base.rule {
        Rule::Convention(number) => (&*drawer.rules()[*number], *number >= drawer.conventions()),
        Rule::Edges(_) | Rule::Walk(_) => ("", false),
    };
    let is_nothing = guarded.base.is_nothing();
    let mut parts = if is_nothing { Vec::new() } else { parts };
    match &guarded.base.rule {
        Rule::Convention(_) => {}
        Rule::Edges(test) => parts.extend(test.words(drawer.rules())),
        Rule::Walk(walk) => parts.extend(walk.words()),
    }
    let mut how = String::from(if is_nothing { "draws nothing" } else { "draws" });
    if is_way {
        rule.clone_into(&mut how);
    } else if !rule.is_empty() {
        how += &format!(" {rule}");
    }
    if !parts.is_empty() {
        how += &format!(" as if {}", parts.join(" and "));
    }
    let when = |all: &[Conjunction]| any(all, &vocabulary.names);
    match (&guarded.when, is_other) {
        (Some(all), false) => format!("It {how} where {}.", when(all)),
        (Some(all), true) => format!("Elsewhere, it {how} where {}.", when(all)),
        (None, false) => format!("It {how}."),
        (None, true) => format!("Elsewhere, it {how}."),
    }
}

/// Where one of some conjunctions holds.
fn any(all: &[Conjunction], names: &[Name]) -> String {
    let all = all.iter().map(|f| facts(f, names));
    all.collect::<Vec<_>>().join("; or where ")
}

fn border(guarded: &GuardedBorder, is_line: bool, vocabulary: &Vocabulary) -> String {
    let what = match (is_line, guarded.ends) {
        (true, _) => "the side steps of its pixels",
        (_, [true, true]) => "the ends of rows",
        (_, [true, false]) => "the left ends of rows",
        _ => "the right ends of rows",
    };
    let how = formula(&guarded.crossing, guarded.ends, is_line).join(" and ");
    match &guarded.when {
        Some(when) => {
            format!(
                "It computes {what} as if {how}, where {}.",
                any(when, &vocabulary.of_borders())
            )
        }
        None => format!("It computes {what} as if {how}."),
    }
}

/// What is not as it should be in a formula of a border.
fn formula(crossing: &Crossing, ends: [bool; 2], is_line: bool) -> Vec<String> {
    let edge = if is_line { "the line" } else { "the edge" };
    let side = if is_line { "side" } else { "x" };
    let px = |v: i64| number(Unit::Subpixels, v);
    let mut said = Vec::new();
    match crossing.from {
        From::Before => {}
        From::After if is_line => said.push("it began at the right or lower end".to_owned()),
        From::After => said.push("the edge began at its lower end".to_owned()),
        From::First => said.push(format!("{edge} began at the end that is given first")),
        From::Second => said.push(format!("{edge} began at the end that is given last")),
    }
    let names = ["its side place", if is_line { "its place" } else { "its height" }];
    for (start, name) in crossing.start.iter().zip(names) {
        said.extend(
            start.map(|t| {
                format!("the start of {edge} had {name} rounded {} to whole px", t.words())
            }),
        );
    }
    for (side, name) in crossing.sides.iter().zip([side, if is_line { "length" } else { "y" }]) {
        said.extend(side.map(|t| {
            let ends = format!("between ends whose {name} is rounded {} to whole px", t.words());
            format!("the slope of {edge} were that {ends}")
        }));
    }
    if crossing.rise != 0 {
        let length = if is_line { "its length" } else { "the height of the edge" };
        said.push(format!("the slope were divided by {length} plus {} px", crossing.rise));
    }
    match crossing.slope {
        Slope::Exact => {}
        Slope::None => said.push(format!("the slope of {edge} were 0")),
        Slope::Reversed => said.push(format!("the slope of {edge} had the other sign")),
        Slope::Twice => said.push(format!("the slope of {edge} were doubled")),
        Slope::Float { bits } => {
            said.push(format!("the slope of {edge} and its place were floats of {bits} bits"));
        }
        Slope::Added { bits } => {
            said.push(format!(
                "the slope of {edge} were added up row by row in floats of {bits} bits"
            ));
        }
        Slope::Reciprocal { fraction, toward: way } => said.push(format!(
            "the slope of {edge} were a product with a reciprocal of {fraction} bits of fraction, rounded {}",
            way.words()
        )),
        Slope::Short { bits, toward: way } => said.push(format!(
            "the slope of {edge} were a product with a reciprocal of {bits} significant bits, rounded {}",
            way.words()
        )),
        Slope::Word { bits, is_signed } => {
            let kind = if is_signed { "a signed" } else { "an unsigned" };
            said.push(format!("the shorter side of {edge} were in {kind} word of {bits} bits"));
        }
        Slope::Fixed { fraction, toward: way, word } => {
            let word = word.map_or_else(String::new, |bits| format!(", in a word of {bits} bits"));
            said.push(format!(
                "the slope of {edge} had {fraction} bits of fraction, rounded {}{word}",
                way.words()
            ));
        }
    }
    match crossing.distance {
        Distance::Exact => {}
        Distance::Rows => {
            said.push("the way from the corner to the first sample were left out".into())
        }
        Distance::FromTop => {
            said.push("the way were counted from the start of the whole shape".into())
        }
    }
    match crossing.product {
        Product::Exact => {}
        Product::Word(bits) => {
            said.push(format!("slope times distance were in a signed word of {bits} bits"));
        }
        Product::Rounded(step, way) => said.push(format!(
            "slope times distance were rounded {}, to multiples of {}",
            way.words(),
            multiple(step, 65536.0)
        )),
    }
    if crossing.later != 0 {
        said.push(format!("it were computed {} farther along", px(crossing.later)));
    }
    if crossing.shift != 0 {
        said.push(format!("it were moved by {}", px(crossing.shift)));
    }
    if crossing.from_window {
        said.push(format!("the part of {edge} before the window were left out"));
    }
    if crossing.exchanged {
        said.push(format!("the ends of {edge} had exchanged their {side} coordinates"));
    }
    if let Some((step, way)) = crossing.sum {
        let multiple = multiple(step, 65536.0);
        said.push(format!("the result were rounded {}, to multiples of {multiple}", way.words()));
    }
    if let Some((pixels, way)) = crossing.group {
        said.push(format!("its pixel were rounded {}, to multiples of {pixels}", way.words()));
    }
    let has_formula = crossing.changes() > 0;
    let both = if ends == [true, true] && crossing.ties[0] != crossing.ties[1] {
        [" at the left end", " at the right end"]
    } else {
        ["", ""]
    };
    for end in (0..2).filter(|end| ends[*end]) {
        let said_before = end == 1 && ends[0] && both[1].is_empty();
        if !(said_before || is_line && has_formula) {
            said.extend(tied(crossing.ties[end], is_line).map(|tie| tie + both[end]));
        }
    }
    said
}

/// What becomes of a sample exactly on a border, where that is not usual.
fn tied(tie: Tie, is_line: bool) -> Option<String> {
    let to = match tie {
        Tie::Down => return None,
        Tie::Up if !is_line => return Some("a sample exactly on it lay on its other side".into()),
        Tie::Up => "up",
        Tie::Back => "back, seen from the left or upper end",
        Tie::On => "on, seen from the left or upper end",
        Tie::BackFromFirst => "back, seen from the first end",
        Tie::OnFromFirst => "on, seen from the first end",
    };
    Some(format!("a tie went {to}"))
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
        Change::Visit(visit) => return visit.words(),
        Change::Gather(gather) => return gather.words(),
        Change::Memory(memory) => return memory.words(),
        Change::Exchange => return "x and y were exchanged".to_owned(),
        Change::Shift(axes) => {
            let axis = match axes {
                [true, true] => "x and y are",
                [true, false] => "x is",
                _ => "y is",
            };
            return format!("it were moved as a whole so that its smallest {axis} not negative");
        }
        Change::Reverse => return "its ends were exchanged".to_owned(),
        Change::Read { axes, how } => {
            let axis = match axes {
                [true, true] => "the column and the row",
                [true, false] => "the column",
                _ => "the row",
            };
            let how = transformed(*how, 1.0);
            return format!("each pixel had the answer of the one whose place is {axis}, {how}");
        }
        Change::Write { axes, how } => {
            let axis = match axes {
                [true, true] => "the column and the row of each pixel were",
                [true, false] => "the column of each pixel was",
                _ => "the row of each pixel was",
            };
            return format!("{axis}, when it is written, {}", transformed(*how, 1.0));
        }
        Change::Cut { points, toward: way, all_sides } => {
            let beyond = if *all_sides { "" } else { " along the longer axis" };
            let of = match points {
                Points::All => "each end, where it is beyond the window",
                Points::Given(0) => "the first end, where it is beyond the window",
                _ => "the second end, where it is beyond the window",
            };
            let rounded = format!("rounded {} to a whole pixel", way.words());
            return format!(
                "{of}{beyond}, was replaced by the point where the line enters the window, {rounded}"
            );
        }
        Change::Clip(clip) => {
            let names = ["left", "right", "upper", "lower"];
            let borders = clip.order.map(|border| names[border]).join(", ");
            let way = clip.toward.words();
            let end = ["first", "last"][usize::from(clip.last_first)];
            let margin = ["", ", which lie one pixel after its last"][usize::from(clip.margin > 0)];
            return format!(
                "the line was clipped in whole numbers at the borders of the window{margin}, in the order {borders}, the {end} \
                 end first, each new end rounded {way} and the next one computed from it"
            );
        }
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
        Points::Given(i) => format!("of the {} {point}", ORDINALS[*i]),
        Points::ByHeight(i) => format!("of the {} {point}", ["top", "middle", "bottom"][*i]),
    };
    let verb = if axes == &[true, true] { "were" } else { "was" };
    format!("{axis} {of} {verb} {}", transformed(*how, if is_line { 1.0 } else { 256.0 }))
}

fn transformed(how: How, one: f64) -> String {
    let px = |v: i64| format!("{} px", v as f64 / one);
    let power = |bits: u32| px(1 << bits);
    match how {
        How::Snap(step, way) => {
            let multiple = multiple(step, one);
            format!("rounded {}, to multiples of {multiple}", way.words())
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
        How::Around(sides) => {
            let band =
                if sides == 1 { "the side of the window".into() } else { format!("{sides} sides") };
            format!("clamped to a guard band as wide as {band} around the window")
        }
        How::Wrap(bits, true) => {
            format!("wrapped into the range from -{} to {}", power(bits - 1), power(bits - 1))
        }
        How::Wrap(bits, false) => format!("wrapped into the range from 0 to {}", power(bits)),
        How::Saturate(bits) => {
            format!("limited to the range from -{} to {}", power(bits - 1), power(bits - 1))
        }
        How::Limit(most) => format!("limited to the range from -{} to {}", px(most), px(most)),
        How::Absolute => "without its sign".to_owned(),
        How::AddBelow(by) => format!("moved by {} where negative", px(by)),
        How::SnapNear(step, within) => format!(
            "moved to a multiple of {} where it is at most {} away",
            multiple(step, one),
            px(within)
        ),
        How::Mirror(less) => format!(
            "mirrored: the side of the window{} less the coordinate",
            lessened(&px(less), less)
        ),
        How::AboutFirst => "on the other side of the first point".to_owned(),
        How::Scale(times) => format!("multiplied by {}", times as f64 / 256.0),
    }
}

fn multiple(step: i64, one: f64) -> String {
    match step as f64 >= one {
        true => format!("{} px", step as f64 / one),
        false => format!("1/{} px", one as i64 / step),
    }
}

fn lessened(px: &str, less: i64) -> String {
    match less {
        0 => String::new(),
        less if less < 0 => format!(" plus {}", px.trim_start_matches('-')),
        _ => format!(" less {px}"),
    }
}
