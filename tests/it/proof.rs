//! The machine-checked proof and the code stay in step: which models need another look.
//!
//! `proof/check` checks the proofs and runs the models; it needs Coq. Here is what needs none: each
//! Rust file that a model in `proof/` follows is as it was when the two were last compared, and what
//! the pages say about the proof names theorems that exist.

use sha2::{Digest as _, Sha256};

use crate::pages::read;

/// The hash of a file's code, without lines that are only comment and without its tests, as
/// `proof/looked-at` takes it.
fn hash_of_code(text: &str) -> String {
    let lines = text.lines().take_while(|line| !line.starts_with("#[cfg(test)]"));
    let code = lines.filter(|line| !line.trim_start_matches(' ').starts_with("//"));
    format!("{:x}", Sha256::digest(code.flat_map(|line| [line, "\n"]).collect::<String>()))
}

/// The files of `proof/modelled` whose code is not the code that the models were held against.
fn outdated(modelled: &str, code: impl Fn(&str) -> String) -> Vec<String> {
    let rows = modelled.lines().map(|row| row.split(' ').collect::<Vec<_>>());
    rows.filter(|row| hash_of_code(&code(row[0])) != row[1])
        .map(|row| format!("{} changed: look at {}", row[0], row[2..].join(", ")))
        .collect()
}

#[test]
fn proof_models_are_of_this_code() {
    let modelled = read("proof/modelled");
    let outdated = outdated(&modelled, |path| read(path));
    assert!(
        outdated.is_empty(),
        "{}\nWhere the model in proof/ still says what the code does, run proof/looked-at; where it \
         does not, change it until proof/check passes.",
        outdated.join("\n")
    );
    for row in modelled.lines() {
        let words: Vec<_> = row.split(' ').collect();
        for model in &words[2..] {
            let opening = read(format!("proof/{model}"));
            let opening = opening.split("*)").next().unwrap();
            assert!(opening.contains(words[0]), "{model} does not open with {}", words[0]);
        }
    }
}

/// A change of code is noticed with the models that it concerns; one of comments and tests is not.
#[test]
fn proof_notices_a_change() {
    let code = "//! A\nfn f() {}\n#[cfg(test)]\nmod tests {}\n";
    let modelled = format!("src/a.rs {} A.v B.v\n", hash_of_code(code));
    let after = |text: &'static str| outdated(&modelled, |_| text.to_owned());
    assert_eq!(after("// B\nfn f() {}\n    // C\n#[cfg(test)]\nmod more {}\n"), [""; 0]);
    assert_eq!(after("fn g() {}\n"), ["src/a.rs changed: look at A.v, B.v"]);
}

/// What a page calls a theorem, with the file that it links to: [`name`](../proof/File.v).
fn named(page: &str) -> Vec<(&str, &str)> {
    let links = page.match_indices("`](");
    let link = |at: usize| page[at + 3..].split(')').next().unwrap_or("");
    links
        .filter(|&(at, _)| link(at).contains("proof/") && link(at).ends_with(".v"))
        .map(|(at, _)| {
            (page[..at].rsplit('`').next().unwrap(), link(at).rsplit('/').next().unwrap())
        })
        .collect()
}

fn is_stated(name: &str, proofs: &str) -> bool {
    let in_word = |c: char| c.is_alphanumeric() || c == '_';
    ["Theorem", "Corollary"].iter().any(|kind| {
        let statement = format!("\n{kind} {name}");
        proofs
            .match_indices(&statement)
            .any(|(at, found)| !proofs[at + found.len()..].starts_with(in_word))
    })
}

/// Theorems that the pages name are stated, and proved, in the file that the page links to.
#[test]
fn proof_theorems_of_the_pages_exist() {
    let theorems = read("proof/Theorems.v");
    assert!(is_stated("engines_agree", &theorems) && !is_stated("engines_agre", &theorems));
    for name in ["docs/proof.md", "docs/zh/proof.md"] {
        let page = read(name);
        let named = named(&page);
        assert!(named.len() >= 40, "{name} names {named:?}");
        for (theorem, file) in named {
            assert!(
                is_stated(theorem, &read(format!("proof/{file}"))),
                "{name}: {theorem}, {file}"
            );
        }
    }
}
