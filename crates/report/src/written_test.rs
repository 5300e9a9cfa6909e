//! The smallest case of each fault as a test in the user's language, which needs nothing of this project.
//!
//! The files beside this one hold what does not depend on the cases: a function to fill in for each verb, and the comparison. Here
//! are the cases, each with the call, the expected pixels, and a picture in a comment.

use std::path::Path;

use super::judge_text;
use rasterproof_core::grid::{SUBPIXELS, SubpixelPoint};
use rasterproof_core::triangle::WideLine;
use rasterproof_judge::ask::{Asked, Question};
use rasterproof_judge::check::Truth;
use rasterproof_judge::checkable::{Checkable, PlainPixel, checkable};
use rasterproof_judge::failures::Failure;
use rasterproof_judge::verdict::Verdict;
use rasterproof_verify::judge::ascii;

rasterproof_core::named! {
    /// A language of tests, with the name of its template.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Language {
        Python = "Python (pytest)",
        Rust = "Rust",
        C = "C99",
        JavaScript = "JavaScript (node:test)",
    }
}

/// Pixels of a case beyond which a test of it is no longer read by people.
const MOST_PIXELS: usize = 2000;
/// Columns of the code, as far as it can be broken.
const COLUMNS: usize = 100;

impl Language {
    /// The language of a file by its ending.
    ///
    /// # Errors
    /// What endings there are.
    pub fn of(path: &Path) -> Result<Self, String> {
        match path.extension().and_then(|ending| ending.to_str()) {
            Some("py") => Ok(Self::Python),
            Some("rs") => Ok(Self::Rust),
            Some("c") => Ok(Self::C),
            Some("js" | "mjs") => Ok(Self::JavaScript),
            _ => Err("the ending of its name says the language of the test: .py (pytest), .rs, .c (C99), \
                      .js or .mjs (node:test)"
                .to_owned()),
        }
    }

    /// The file beside this one that holds what does not depend on the cases.
    fn template(self) -> &'static str {
        match self {
            Self::Python => include_str!("written_test/python.txt"),
            Self::Rust => include_str!("written_test/rust.txt"),
            Self::C => include_str!("written_test/c.txt"),
            Self::JavaScript => include_str!("written_test/javascript.txt"),
        }
    }

    /// A section of the template.
    fn section(self, name: &str) -> &'static str {
        let begins = format!("@ {name}\n");
        let template = self.template();
        // A section begins with a line of its name, and ends before the next such line.
        let Some(at) = template.find(&begins) else { return "" };
        let section = &template[at + begins.len()..];
        section.find("\n@ ").map_or(section, |end| &section[..=end]).trim_matches('\n')
    }

    /// What begins a comment.
    fn comment(self) -> &'static str {
        if self == Self::Python { "#" } else { "//" }
    }
}

/// What came of the cases: the text of a file, where there is one to write, and what is not in it.
#[derive(Debug, Default)]
pub struct WrittenTest {
    /// Nothing where no case can become a test.
    pub text: Option<String>,
    /// Tests in it.
    pub count: usize,
    /// A sentence for each failing case that no test can be made of.
    pub left_out: Vec<String>,
}

/// The smallest failing cases of a verdict as a test. `repeat` makes the command that repeats a case.
pub fn write(
    verdict: &Verdict,
    language: Language,
    file: &str,
    repeat: &dyn Fn(&str, u64) -> String,
) -> WrittenTest {
    let mut out = WrittenTest::default();
    // Each request becomes a test of its own, and one that was asked before does not become another.
    let truth = Truth::of(&verdict.more.declared);
    let mut questions: Vec<&Question> = Vec::new();
    let mut tests = String::new();
    for failure in &verdict.failures {
        let place = format!("{} #{}", failure.family, failure.index);
        // The first reason for which no test could be made, in case none of its requests gives one.
        let mut why_not = None;
        let mut number = 0;
        for exchange in &failure.evidence.exchanges {
            let question = &exchange.question;
            if questions.contains(&question) {
                why_not.get_or_insert("it asks the same as another one");
                continue;
            }
            let plain = match checkable(question, &truth) {
                None if is_of_pixels(question) => Err("nothing is promised of this triangle"),
                None => Err("the corners that clipping leaves are no pixels"),
                Some(plain) if plain.expected.len() > MOST_PIXELS => Err("it has too many pixels"),
                Some(plain) if plain.refutes(question, &exchange.heard) => Ok(plain),
                Some(_) => Err(
                    "alone, each of its answers is right within the window: what is wrong is between them, or outside",
                ),
            };
            match plain {
                Err(why) => drop(why_not.get_or_insert(why)),
                Ok(plain) => {
                    number += 1;
                    // The first request of a case has the picture and the command in its comment.
                    let name = name(failure, number);
                    let about = if number == 1 { about(failure, repeat) } else { String::new() };
                    tests += &test(language, &name, &about, question, &plain);
                    questions.push(question);
                }
            }
        }
        if number == 0 {
            let why = why_not.unwrap_or("nothing was answered");
            out.left_out.push(format!("{place} ({}): {why}", failure.evidence.property));
        }
    }
    out.count = questions.len();
    if out.count > 0 {
        out.text = Some(file_of(verdict, language, file, &questions, &tests));
    }
    out
}

/// Whether a request is answered with pixels.
fn is_of_pixels(question: &Question) -> bool {
    !matches!(
        question.of,
        Asked::Near(_)
            | Asked::Carried(_)
            | Asked::SampleValues(_)
            | Asked::Polygon(_)
            | Asked::Formula(..)
    )
}

/// The functions to be filled in, in the order of the file.
const FUNCTIONS: [&str; 7] =
    ["triangle", "line", "values", "samples", "depth", "wide_line", "area"];

/// The function that answers a question.
fn function(question: &Question) -> &'static str {
    match question.of {
        Asked::Line { .. } => "line",
        Asked::Values(_) => "values",
        Asked::Samples(_) => "samples",
        Asked::Depth(_) => "depth",
        Asked::Wide(_) => "wide_line",
        Asked::Area(_) => "area",
        _ => "triangle",
    }
}

/// The whole file: what is to be filled in, the comparison, and the tests.
fn file_of(
    verdict: &Verdict,
    language: Language,
    file: &str,
    questions: &[&Question],
    tests: &str,
) -> String {
    let is_asked = |name: &&str| questions.iter().any(|question| function(question) == *name);
    let functions: Vec<&str> = FUNCTIONS.into_iter().filter(is_asked).collect();
    let declared = &verdict.more.declared;
    // Nothing that a program says of itself ends a comment.
    let program = declared.name.replace("*/", "* /");
    // The template, section by section, then the words that stand for something in it.
    let mut parts = vec![language.section("head").to_owned()];
    parts.extend(functions.iter().map(|name| language.section(name).to_owned()));
    parts.push(language.section("check").to_owned());
    // Python has two empty lines between functions.
    let gap = if language == Language::Python { "\n\n\n" } else { "\n\n" };
    let mut text = parts.join(gap).replace("{program}", &program).replace("{file}", file);
    text = text.replace("{function}", &functions.join(", "));
    text = text.replace("{counts_hits}", counts_hits(language, !declared.mask));
    text = text.replace("{levels}", &declared.levels.to_string());
    // The sentences of the template are about one function.
    if functions.len() > 1 {
        for [one, more] in [
            ["the function below", "the functions below"],
            ["in its place", "in their place"],
            ["your own in it", "your own in them"],
        ] {
            text = text.replace(one, more);
        }
    }
    // C needs a function for each kind of pixel, and each once.
    let mut setters: Vec<String> = functions.iter().map(|name| setter(name)).collect();
    setters.sort();
    setters.dedup();
    text = text.replace("{setters}", &setters.concat());
    text += &match language {
        // The tests stand inside of a function.
        Language::JavaScript => format!("\n{tests}{}", language.section("tail")),
        Language::C => format!("\n{tests}\n{}", main_of_c(tests)),
        Language::Python | Language::Rust => format!("\n{tests}"),
    };
    text.truncate(text.trim_end().len());
    text + "\n"
}

/// Whether a mask or a count is expected, as a constant of the language.
fn counts_hits(language: Language, counts: bool) -> &'static str {
    match (language, counts) {
        (Language::Python, true) => "True",
        (Language::Python, false) => "False",
        (Language::C, true) => "1",
        (Language::C, false) => "0",
        (_, true) => "true",
        (_, false) => "false",
    }
}

/// What a function of C is given to draw a pixel with.
fn setter(function: &str) -> String {
    let body = match function {
        "values" => return String::new(),
        "samples" => {
            "set_mask(int x, int y, int mask) {\n    if (mask != 0) set_values(x, y, mask, 0, 0);\n}"
        }
        "area" => {
            "set_level(int x, int y, int level) {\n    if (level != 0) set_values(x, y, level, 0, 0);\n}"
        }
        "depth" => "set_seen(int x, int y, int t) {\n    set_values(x, y, t, 0, 0);\n}",
        _ => "set_pixel(int x, int y) {\n    set_values(x, y, 0, 0, 0);\n}",
    };
    format!("static void {body}\n\n")
}

/// Calls every test of a file in C.
fn main_of_c(tests: &str) -> String {
    let mut calls = String::new();
    for line in tests.lines() {
        if let Some(rest) = line.strip_prefix("static void ")
            && let Some(name) = rest.strip_suffix("(void) {")
        {
            calls += &format!("    {name}();\n");
        }
    }
    format!("int main(void) {{\n{calls}    return failed > 0;\n}}\n")
}

/// The name of a test: the property where that is not the family, the family, the number of its case, and which of its requests it is.
fn name(failure: &Failure, number: usize) -> String {
    // A name that every language takes: letters, digits and underscores.
    let (property, family) = (failure.evidence.property, failure.family);
    let of = if property == family { family.to_owned() } else { format!("{property}_{family}") };
    let more = if number > 1 { format!("_{number}") } else { String::new() };
    format!("{}_{}{more}", of.replace(|c: char| !c.is_ascii_alphanumeric(), "_"), failure.index)
}

/// What is wrong, the picture of it, and the command that repeats the case.
fn about(failure: &Failure, repeat: &dyn Fn(&str, u64) -> String) -> String {
    let excerpt = judge_text::excerpt(failure, &["drawn"], repeat(failure.family, failure.index));
    let mut out = vec![excerpt.title];
    out.extend(excerpt.grid.lines().map(str::to_owned));
    out.extend(excerpt.notes);
    out.extend(excerpt.places.into_iter().map(|(what, command)| format!("{what}: {command}")));
    out.join("\n")
}

/// Text as a comment above a test. Pictures and commands stay as they are.
fn comment(language: Language, text: &str) -> String {
    let indent = if language == Language::JavaScript { "  " } else { "" };
    let mut out = String::new();
    for line in text.lines() {
        // A picture or a command that is broken is none.
        let stays = line.starts_with("  ") || line.contains("rasterproof");
        let lines = if stays {
            vec![line.to_owned()]
        } else {
            ascii::lines(line, COLUMNS - 8, ascii::columns)
        };
        for line in lines {
            // In C a line that ends so goes on in the next one.
            let line = line.trim_end_matches('\\');
            out += format!("{indent}{} {line}", language.comment()).trim_end();
            out.push('\n');
        }
    }
    out
}

/// A test with its comment: the call, and the pixels that are expected of it.
fn test(
    language: Language,
    name: &str,
    about: &str,
    question: &Question,
    plain: &Checkable,
) -> String {
    let none =
        |count: usize, name: &str| if count == 0 { "NULL".to_owned() } else { name.to_owned() };
    let mut either = Vec::new();
    for &[x, y] in &plain.either {
        either.push(match language {
            Language::Rust => format!("({x}, {y})"),
            _ => pixel(language, &PlainPixel { x, y, values: Vec::new() }),
        });
    }
    let pixels: Vec<String> = plain.expected.iter().map(|p| pixel(language, p)).collect();
    let (count, count_of_either) = (plain.expected.len(), plain.either.len());
    let bounds: Vec<String> = plain.bounds.iter().map(|bound| number(language, *bound)).collect();
    // The words of the template, and what stands in their place.
    let kind = Kind::of(question);
    // How far values may be off, or zeros where there are none.
    let bounds = match (bounds.is_empty(), language) {
        (true, Language::C) => "0".to_owned(),
        (true, _) => vec!["0.0"; kind.values].join(", "),
        (false, _) => bounds.join(", "),
    };
    let flag =
        |is: bool| if language == Language::C { u8::from(is).to_string() } else { is.to_string() };
    let words = [
        ("{name}", name.to_owned()),
        ("{function}", kind.function.to_owned()),
        ("{setter}", kind.setter.to_owned()),
        ("{taken}", kind.taken.to_owned()),
        ("{given}", kind.given.to_owned()),
        ("{count_of_values}", kind.values.to_string()),
        ("{first}", none(count, "pixels")),
        ("{first_either}", none(count_of_either, "either")),
        ("{count}", count.to_string()),
        ("{count_of_either}", count_of_either.to_string()),
        ("{in_order}", flag(plain.in_order)),
        ("{width}", question.width.to_string()),
        ("{height}", question.height.to_string()),
        ("{arguments}", arguments(language, question)),
        ("{bounds}", bounds),
        ("{either}", list(language, &either)),
        ("{pixels}", list(language, &pixels)),
    ];
    // A mask or a level of 0 is that of a pixel that is not drawn.
    let has_blank = matches!(question.of, Asked::Samples(_) | Asked::Area(_));
    let holds = |condition: &str| match condition {
        "pixels" => count > 0,
        "either" => count_of_either > 0,
        "bounds" => !plain.bounds.is_empty(),
        "order" => plain.in_order,
        "blank" => has_blank,
        _ => !has_blank,
    };
    // Lines of the template that are not needed are left out.
    let mut code = String::new();
    for line in language.section("test").lines() {
        // What follows a question mark says when the line is needed.
        let (line, condition) = line.split_once("  ?").unwrap_or((line, ""));
        if condition.is_empty() || holds(condition) {
            code += line;
            code.push('\n');
        }
    }
    for (word, text) in words {
        code = code.replace(word, &text);
    }
    let gap = if language == Language::Python { "\n\n" } else { "\n" };
    format!("{gap}{}{code}", comment(language, about))
}

/// What differs between the functions that are tested.
struct Kind {
    /// The name of the function that the reader fills in.
    function: &'static str,
    /// What it is given to draw a pixel with, in C.
    setter: &'static str,
    /// In Rust, what it gives to that, and what becomes of it.
    taken: &'static str,
    /// The values of a pixel, as the comparison takes them.
    given: &'static str,
    /// How many values a pixel has.
    values: usize,
}

impl Kind {
    /// The function that answers a request.
    fn of(question: &Question) -> Self {
        // A pixel of a mask, a depth or an area is a number; the comparison knows values only.
        let function = function(question);
        let (setter, taken, given, values) = match function {
            "values" => ("set_values", "x, y, values", "x, y, values", 3),
            "samples" => ("set_mask", "x, y, mask", "x, y, [f64::from(mask)]", 1),
            "depth" => ("set_seen", "x, y, t", "x, y, [t as f64]", 1),
            "area" => ("set_level", "x, y, level", "x, y, [f64::from(level)]", 1),
            _ => ("set_pixel", "x, y", "x, y, []", 0),
        };
        Self { function, setter, taken, given, values }
    }
}

/// A pixel with its values.
fn pixel(language: Language, pixel: &PlainPixel) -> String {
    let PlainPixel { x, y, values } = pixel;
    let values: Vec<String> = values.iter().map(|value| number(language, *value)).collect();
    let values = values.join(", ");
    let and = if values.is_empty() { "" } else { ", " };
    match language {
        Language::Python => format!("({x}, {y}{and}{values})"),
        Language::JavaScript => format!("[{x}, {y}{and}{values}]"),
        Language::Rust => format!("({x}, {y}, [{values}])"),
        Language::C if values.is_empty() => format!("{{{x}, {y}, {{0}}}}"),
        Language::C => format!("{{{x}, {y}, {{{values}}}}}"),
    }
}

fn brackets(language: Language) -> [&'static str; 2] {
    if language == Language::C { ["{", "}"] } else { ["[", "]"] }
}

/// Items in brackets.
fn joined(language: Language, items: &[String]) -> String {
    let [open, close] = brackets(language);
    format!("{open}{}{close}", items.join(", "))
}

/// The same in lines where they are many.
fn list(language: Language, items: &[String]) -> String {
    let [open, close] = brackets(language);
    let indent = match language {
        Language::Python | Language::Rust => "        ",
        Language::JavaScript => "      ",
        Language::C => "    ",
    };
    // A short list stays in one line.
    let one_line = items.join(", ");
    if one_line.len() <= COLUMNS - 30 {
        return format!("{open}{one_line}{close}");
    }
    let mut lines = vec![String::new()];
    for item in items {
        // As many items in a line as fit.
        let is_full = lines.last().is_some_and(|line| line.len() + item.len() + 2 > COLUMNS - 12);
        if is_full {
            lines.push(String::new());
        }
        if let Some(line) = lines.last_mut() {
            let gap = if line.is_empty() { "" } else { " " };
            *line += &format!("{gap}{item},");
        }
    }
    let lines = lines.join(&format!("\n{indent}    "));
    format!("{open}\n{indent}    {lines}\n{indent}{close}")
}

/// A number that the language reads as the same 64-bit float.
fn number(language: Language, value: f64) -> String {
    // With an exponent where it would be long, and of Rust always as a float.
    let is_long = value != 0.0 && !(1e-5..1e15).contains(&value.abs());
    if language == Language::Rust || is_long { format!("{value:?}") } else { format!("{value}") }
}

/// What the function of a question is given before the window.
fn arguments(language: Language, question: &Question) -> String {
    let tuple = |values: &[f64]| {
        let values: Vec<String> = values.iter().map(|value| number(language, *value)).collect();
        let values = values.join(", ");
        match language {
            Language::Python => format!("({values})"),
            Language::JavaScript | Language::Rust => format!("[{values}]"),
            Language::C => format!("{{{values}}}"),
        }
    };
    match &question.of {
        Asked::Line { ends, .. } => {
            let [[x0, y0], [x1, y1]] = ends.map(|end| [end.x, end.y]);
            match language {
                Language::Rust => format!("({x0}, {y0}), ({x1}, {y1})"),
                _ => format!("{x0}, {y0}, {x1}, {y1}"),
            }
        }
        Asked::Values(triangle) => {
            let mut corners = Vec::new();
            for v in &triangle.vertices {
                let (x, y) = v.position.to_px();
                corners.push(tuple(&[x, y, v.depth, 1.0 / v.inv_w, v.varying.x, v.varying.y]));
            }
            let corners = joined(language, &corners);
            match language {
                Language::C => format!("(const struct corner[]){corners}"),
                _ => corners,
            }
        }
        Asked::Depth(triangles) => {
            let mut all = Vec::new();
            for triangle in triangles {
                let mut corners = Vec::new();
                for v in &triangle.vertices {
                    let (x, y) = v.position.to_px();
                    corners.push(tuple(&[x, y, v.depth]));
                }
                all.push(joined(language, &corners));
            }
            let (count, all) = (all.len(), joined(language, &all));
            match language {
                Language::C => format!("(const struct point[][3]){all}, {count}"),
                Language::Rust => format!("&{all}"),
                _ => all,
            }
        }
        Asked::Coverage(corners) | Asked::Samples(corners) | Asked::Area(corners) => {
            points(language, corners)
        }
        Asked::Wide(WideLine { ends, width }) => {
            let width = number(language, f64::from(*width) / f64::from(SUBPIXELS));
            format!("{}, {width}", points(language, ends))
        }
        Asked::Near(_)
        | Asked::Carried(_)
        | Asked::SampleValues(_)
        | Asked::Polygon(_)
        | Asked::Formula(..) => String::new(),
    }
}

/// Positions in pixels, as arguments.
fn points(language: Language, all: &[SubpixelPoint]) -> String {
    let mut each = Vec::new();
    for point in all {
        let (x, y) = point.to_px();
        let [x, y] = [x, y].map(|v| number(language, v));
        each.push(match language {
            Language::Rust => format!("({x}, {y})"),
            _ => format!("{x}, {y}"),
        });
    }
    match language {
        Language::Rust => format!("[{}]", each.join(", ")),
        _ => each.join(", "),
    }
}
