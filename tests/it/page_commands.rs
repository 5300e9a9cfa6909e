//! The command on a page makes the same page again: it holds every option that was given.

use std::collections::BTreeSet;
use std::process::Command;

use crate::program::{Folder, PROGRAM, Run, table};

/// Runs the program; the command that its page shows.
fn shown(folder: &Folder, words: &[String]) -> String {
    let run = Run::of(folder.command(words).env_remove("CARGO"));
    assert!(matches!(run.status, Some(0 | 1)), "{run}");
    let text = folder.text(&format!("pages/{}.html", words[0]));
    let after = text.rsplit("<p class=\"command\"><code>").next().unwrap();
    let command = after.split("</code>").next().unwrap();
    command.replace("&#39;", "'").replace("&quot;", "\"").replace("&amp;", "&").replace("&lt;", "<")
}

/// The words of a command, as a shell reads them.
pub fn words_of(command: &str) -> Vec<String> {
    // Assignments before a command are words only as arguments of another one.
    let script = format!("for word in {command}; do printf '%s\\0' \"$word\"; done");
    let output = Command::new("bash").args(["-c", &script]).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    text.split_terminator('\0').map(str::to_owned).collect()
}

/// Options that are refused together with `--report`, and the one for help.
const WITHOUT_PAGE: [&str; 6] = ["--help", "--map", "--show", "--spin", "--views", "--without"];

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn every_option_is_on_the_page() {
    let folder = Folder::new("page-commands");
    folder.put("a 'model'.obj", "v -1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let seen = include_str!("../data/models/double-sided-front.gltf")
        .replace(r#""nodes": [{"mesh": 0}]"#, r#""nodes": [{"mesh": 0, "camera": 0}], "animations": [{"channels": [], "samplers": []}], "cameras": [{"orthographic": {"ymag": 2, "znear": -1, "zfar": 1}}]"#);
    folder.put("camera.gltf", seen);
    folder.put("plan.json", folder.check("plan panels --size 32x24 --rounds 1 --json", 0).out);
    let model = "\"a 'model'.obj\" --size 32x24 --aa msaa4 --cull cw --shading flat --depth unorm24 --yaw=-30 \
                 --pitch 10.5 --zoom 2 --fov 50 --up z --normals flat --specular 0.5,30 --opacity 0.5 --layers 4 \
                 --alpha-threshold 0.5 --fog 0,1 --shadows 64 --mip-maps --anisotropy 8 --two-sided";
    let judge =
        "--cases 5 --family sliver --timeout 9 --jobs 2 --seed 2 --declare 'rule=top-left mask'";
    let mut tried = BTreeSet::new();
    for [name, options] in table("page-commands") {
        let options = options.replace("MODEL", model).replace("JUDGE", judge);
        let options = options.replace("PROGRAM", PROGRAM);
        let typed = words_of(&format!("{name} --report --out pages --force {options}"));
        tried.extend(
            typed.iter().map(|word| (name.clone(), word.split('=').next().unwrap().to_owned())),
        );
        let again = words_of(&shown(&folder, &typed)).split_off(1);
        let sorted = |words: &[String]| {
            let mut words = words.to_vec();
            words.sort();
            words
        };
        // Some put the seed and the number of cases first.
        assert_eq!(sorted(&again), sorted(&typed), "{again:?}");
        assert_eq!(again[0], name);
        let judged =
            |words: &[String]| words.iter().position(|w| w == "--").map(|at| words[at..].to_vec());
        assert_eq!(judged(&again), judged(&typed));
    }
    for name in ["render", "plan", "study"] {
        let help = folder.check([name, "--help"], 0).out;
        let listed = help.lines().filter(|line| line.trim_start().starts_with('-'));
        let name_of =
            |line: &str| line.split_once("--").unwrap().1.split(' ').next().unwrap().to_owned();
        let options: Vec<_> = listed.map(|line| format!("--{}", name_of(line))).collect();
        assert!(options.len() > 12, "{help}");
        for option in options.iter().filter(|option| !WITHOUT_PAGE.contains(&option.as_str())) {
            assert!(
                tried.contains(&(name.to_owned(), option.clone())),
                "{name} {option} is not tried"
            );
        }
    }
}
