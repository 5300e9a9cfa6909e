//! No two files of a crate use each other, and no longer way leads from a file back to itself. Whoever uses a module uses
//! the files of the modules inside it too, since the module may hand on what they define. A file may use the modules that it
//! is inside of.

use std::collections::{BTreeMap, BTreeSet};

use crate::pages::{files, read, root};
use crate::workspace::{source_folders, without_tests};

/// The name of a module in its crate, empty for the crate itself: `a::b` of `a/b.rs` and of `a/b/mod.rs`.
type Module = Vec<String>;

/// Which files of each crate use which: the modules that the paths of their code lead to.
fn uses() -> BTreeMap<String, BTreeMap<Module, BTreeSet<Module>>> {
    let mut crates = BTreeMap::new();
    let mut folders = source_folders();
    folders.push("benches/peers/src".to_owned());
    for folder in folders {
        let base = root().join(&folder);
        let texts: BTreeMap<Module, String> = files(&base, ".rs")
            .into_iter()
            .map(|path| {
                let path = path.strip_prefix(&base).unwrap().with_extension("");
                let mut module: Module =
                    path.iter().map(|part| part.to_str().unwrap().to_owned()).collect();
                module.pop_if(|last| ["mod", "lib", "main"].contains(&last.as_str()));
                (module, path)
            })
            .map(|(module, path)| (module, read(base.join(path).with_extension("rs"))))
            .collect();
        let used = texts.iter().map(|(module, text)| {
            let paths = paths(without_tests(text)).into_iter();
            let found = paths.filter_map(|path| lead(module, &path, &texts));
            (module.clone(), found.collect::<BTreeSet<_>>())
        });
        let used = used.collect();
        crates.insert(folder, used);
    }
    crates
}

/// The module with a file to which a path leads from a module.
fn lead(from: &Module, path: &[String], files: &BTreeMap<Module, String>) -> Option<Module> {
    let mut at = match path.first()?.as_str() {
        "crate" => Module::new(),
        "self" => from.clone(),
        "super" => from[..from.len().checked_sub(1)?].to_vec(),
        _ => return None,
    };
    for name in &path[1..] {
        match name.as_str() {
            "super" => drop(at.pop()?),
            name => {
                at.push(name.to_owned());
                if !files.contains_key(&at) {
                    at.pop();
                    break;
                }
            }
        }
    }
    Some(at)
}

/// The paths of some code that begin with `crate`, `self` or `super`, with the groups in braces written out.
fn paths(text: &str) -> Vec<Vec<String>> {
    let code: String = text
        .lines()
        .filter(|line| !line.trim_start().starts_with("//"))
        .collect::<Vec<_>>()
        .join("\n");
    let is_name = |c: char| c.is_alphanumeric() || c == '_';
    let mut found = Vec::new();
    for start in ["crate::", "self::", "super::"] {
        for (at, _) in code.match_indices(start) {
            let before = code[..at].chars().next_back().unwrap_or(' ');
            if !is_name(before) && before != ':' {
                written_out(&mut code[at..].chars().peekable(), Vec::new(), &mut found);
            }
        }
    }
    found
}

/// Reads one path, or the rest of one, and every path of a group.
fn written_out(
    rest: &mut std::iter::Peekable<std::str::Chars<'_>>,
    mut path: Vec<String>,
    found: &mut Vec<Vec<String>>,
) {
    let skip_space = |rest: &mut std::iter::Peekable<std::str::Chars<'_>>| {
        while rest.next_if(|c| c.is_whitespace()).is_some() {}
    };
    loop {
        skip_space(rest);
        if rest.next_if_eq(&'{').is_some() {
            loop {
                skip_space(rest);
                if rest.next_if_eq(&'}').is_some() || rest.peek().is_none() {
                    return;
                }
                written_out(rest, path.clone(), found);
                skip_space(rest);
                // A name after `as`, or what separates the members of a group.
                while rest.next_if(|c| !matches!(c, '}' | ',')).is_some() {}
                let _ = rest.next_if_eq(&',');
            }
        }
        let mut name = String::new();
        while let Some(c) = rest.next_if(|c| c.is_alphanumeric() || *c == '_') {
            name.push(c);
        }
        if name.is_empty() {
            break;
        }
        path.push(name);
        if !(rest.next_if_eq(&':').is_some() && rest.next_if_eq(&':').is_some()) {
            break;
        }
    }
    found.push(path);
}

/// Whether the way goes on from one file to another: it uses that file, or has it inside and may hand on what it defines.
/// The modules that a file is inside of lead nowhere new.
fn leads_on(from: &Module, to: &Module, used: &BTreeSet<Module>) -> bool {
    let is_own = to.split_last().is_some_and(|(_, around)| around == from);
    is_own || used.contains(to) && !from.starts_with(to)
}

/// The modules from which a way leads back to themselves, each with those on its way.
fn circles(uses: &BTreeMap<Module, BTreeSet<Module>>) -> BTreeSet<BTreeSet<String>> {
    let others = |from: &Module| {
        let (from, used) = uses.get_key_value(from).unwrap();
        uses.keys().filter(move |to| leads_on(from, to, used))
    };
    let reached = |from: &Module| {
        let mut reached: BTreeSet<&Module> = BTreeSet::new();
        let mut next: Vec<&Module> = others(from).collect();
        while let Some(at) = next.pop() {
            if reached.insert(at) {
                next.extend(others(at));
            }
        }
        reached
    };
    let all: BTreeMap<&Module, BTreeSet<&Module>> =
        uses.keys().map(|module| (module, reached(module))).collect();
    let circle = |from: &&Module| {
        let back = all[from].iter().filter(|to| all[*to].contains(from));
        back.map(|to| to.join("::")).collect::<BTreeSet<_>>()
    };
    uses.keys().map(|from| circle(&from)).filter(|circle| !circle.is_empty()).collect()
}

#[test]
fn no_files_use_each_other() {
    let mut looked_at = 0;
    let mut found = Vec::new();
    for (folder, uses) in uses() {
        looked_at += uses.values().map(BTreeSet::len).sum::<usize>();
        found.extend(circles(&uses).into_iter().map(|circle| (folder.clone(), circle)));
    }
    assert!(looked_at > 500, "{looked_at} uses");
    assert!(found.is_empty(), "files that use each other: {found:#?}");
}

#[test]
fn circles_are_found() {
    let path = |text: &str| text.split("::").map(str::to_owned).collect::<Vec<_>>();
    let all = |texts: &[&str]| texts.iter().map(|text| path(text)).collect::<Vec<_>>();
    assert_eq!(
        paths("use super::{a::B, c::{self, D as E}};\nlet x = crate::f::g(); // super::no\n"),
        all(&["crate::f::g", "super::a::B", "super::c::self", "super::c::D", "super::no"])
    );
    let module = |name: &str| if name.is_empty() { Module::new() } else { path(name) };
    let graph = |edges: &[(&str, &str)]| {
        let mut uses: BTreeMap<Module, BTreeSet<Module>> = BTreeMap::new();
        for (from, to) in edges {
            uses.entry(module(to)).or_default();
            uses.entry(module(from)).or_default().insert(module(to));
        }
        circles(&uses)
    };
    assert!(graph(&[("a", "b"), ("b", "c"), ("a::x", "a"), ("a", "a::x")]).is_empty());
    assert_eq!(graph(&[("a", "b"), ("b", "c"), ("c", "a")]).len(), 1);
    // `a` hands on what its file `x` has, which uses `b`.
    assert_eq!(graph(&[("b", "a"), ("a::x", "b")]).len(), 1);
    assert!(graph(&[("b", "a::y"), ("a::x", "b"), ("a::y", "a")]).is_empty());
}
