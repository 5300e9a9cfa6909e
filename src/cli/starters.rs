//! What a student begins with: the adapters' starters, their two examples replaced by empty places, or for teachers by
//! solutions.

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Language {
    /// rustc alone, no package.
    Rust,
    /// C++11 and a header.
    Cpp,
    /// Python 3.8, no package.
    Python,
}

#[derive(Debug)]
pub struct File {
    pub name: &'static str,
    pub text: String,
}

/// The lines of a starter between which its example stands.
const PLACE: &str = "---- YOUR PLACE";
const PROTOCOL: &str = "---- the line protocol";

/// The starter with another text in its place; the first lines say what to do.
fn put(starter: &str, place: &str) -> Option<String> {
    let line_start = |at: usize| starter[..at].rfind('\n').map_or(0, |end| end + 1);
    let first = line_start(starter.find(PLACE)?);
    let after = line_start(starter.find(PROTOCOL)?);
    // What says what to do in three points is said by the course in other words.
    let is_point = |line: &str| {
        let words = line.trim_start_matches(['/', '#', ' ']);
        ["1. ", "2. ", "3. "].iter().any(|point| words.starts_with(point))
    };
    let head: String =
        starter[..first].split_inclusive('\n').filter(|line| !is_point(line)).collect();
    Some(format!("{head}{place}\n{}", &starter[after..]))
}

/// The window tests of the starters, and what stands there in the course. There a pixel outside the window goes to the
/// judge: that a program leaves it out is asked in step 1, and could not be seen otherwise.
const WINDOW_TESTS: &[(&str, &str)] = &[
    (
        r#"        if 0 <= x < width and 0 <= y < height:
            if len(hits) == MOST_HITS:
                raise Refused(f"more than {MOST_HITS} pixels set")
            hits.append((y, x, *more))
"#,
        r#"        if len(hits) == MOST_HITS:
            raise Refused(f"more than {MOST_HITS} pixels set")
        hits.append((y, x, *more))
"#,
    ),
    (
        "fn drawn<T>(\n    width: i32,\n    height: i32,\n",
        "fn drawn<T>(\n    _width: i32,\n    _height: i32,\n",
    ),
    (
        "if (0..width).contains(&x) && (0..height).contains(&y) && hits.len() <= MOST_HITS {",
        "if hits.len() <= MOST_HITS {",
    ),
    (
        "    if (x < 0 || y < 0 || x >= rasterproof_plane.width || y >= rasterproof_plane.height) return;\n",
        "",
    ),
    ("outside the window it does nothing", "outside the window it is a mistake"),
];

/// A text of the adapters with each window test replaced by what the course has there.
fn without_window_test(text: &str) -> String {
    WINDOW_TESTS.iter().fold(text.to_owned(), |text, (test, none)| text.replace(test, none))
}

/// The starter of a language, with what it needs beside it: C++ has the protocol in a header.
pub fn files(language: Language, solution: bool) -> Vec<File> {
    macro_rules! starter {
        ($ending:literal) => {
            (
                concat!("starter.", $ending),
                include_str!(concat!("../../adapters/starter.", $ending)),
                include_str!(concat!("../../adapters/course/place.", $ending)),
                include_str!(concat!("../../adapters/course/solution.", $ending)),
            )
        };
    }
    let (name, starter, place, solved) = match language {
        Language::Rust => starter!("rs"),
        Language::Cpp => starter!("cpp"),
        Language::Python => starter!("py"),
    };
    let text = put(starter, if solution { solved } else { place });
    let text = without_window_test(&text.unwrap_or_else(|| starter.to_owned()));
    let header = without_window_test(include_str!("../../adapters/rasterproof.h"));
    let header = File { name: "rasterproof.h", text: header };
    let header = Some(header).filter(|_| language == Language::Cpp);
    [File { name, text }].into_iter().chain(header).collect()
}

/// The page of the steps, for those who have the program alone: without links, which lead to other pages.
pub fn steps_page() -> String {
    let page = include_str!("../../docs/steps.md");
    let mut parts = page.split("](");
    let mut out = parts.next().unwrap_or("").to_owned();
    for part in parts {
        // What was linked stays; its bracket and the address go.
        if let Some(open) = out.rfind('[') {
            out.remove(open);
        }
        out += part.split_once(')').map_or(part, |(_, rest)| rest);
    }
    out
}

/// What builds the program, if anything does, and what runs it.
pub fn commands(language: Language) -> (Vec<String>, Vec<String>) {
    let words = |text: &str| text.split_whitespace().map(str::to_owned).collect();
    let (build, run) = match language {
        Language::Rust => ("rustc -O --edition 2024 starter.rs", "./starter"),
        Language::Cpp => ("c++ -std=c++11 -O2 starter.cpp -o starter", "./starter"),
        Language::Python => ("", "python3 -B starter.py"),
    };
    (words(build), words(run))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each window test is in a file of the adapters, so that none is left in the course by a change of words.
    #[test]
    fn starters_leave_the_window_to_the_student() {
        let adapters = [
            include_str!("../../adapters/starter.py"),
            include_str!("../../adapters/starter.rs"),
            include_str!("../../adapters/rasterproof.h"),
        ];
        for (test, _) in WINDOW_TESTS {
            assert!(adapters.iter().any(|text| text.contains(test)), "{test}");
        }
    }

    /// The starters have the two lines that are looked for, and the example is gone.
    #[test]
    fn starters_have_a_place() {
        for language in [Language::Rust, Language::Cpp, Language::Python] {
            let files = files(language, false);
            let text = &files[0].text;
            assert!(text.contains(PROTOCOL), "{language:?}");
            assert!(!text.contains("As it stands") && text.contains("step 1"), "{language:?}");
            assert!(text.contains("samples") && text.contains("values"), "{language:?}");
        }
        let page = steps_page();
        assert!(page.contains("Further reading: chapter 1.") && !page.contains(".md)"), "{page}");
        assert!(page.contains("(96, 224, 32, 160)[s]"), "{page}");
    }
}
