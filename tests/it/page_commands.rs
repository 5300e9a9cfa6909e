//! The command on a page makes the same page again: it holds every option that was given.

use std::collections::BTreeSet;
use std::process::Command;

use crate::program::{Folder, PROGRAM, Run};

/// Runs the program; the command that its page shows.
fn shown(folder: &Folder, words: &[&str], page: &str) -> String {
    let run = Run::of(folder.command(words).env_remove("CARGO"));
    assert!(matches!(run.status, Some(0 | 1)), "{run}");
    let text = std::fs::read_to_string(folder.join(page)).unwrap();
    let after = text.rsplit("<p class=\"command\"><code>").next().unwrap();
    let command = after.split("</code>").next().unwrap();
    command.replace("&#39;", "'").replace("&quot;", "\"").replace("&amp;", "&").replace("&lt;", "<")
}

/// The words after the name of the program, as a shell reads them.
fn words_of(command: &str) -> Vec<String> {
    let script = format!("printf '%s\\0' {command}");
    let output = Command::new("bash").args(["-c", &script]).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    text.split_terminator('\0').skip(1).map(str::to_owned).collect()
}

/// Options that are refused together with `--report`, and the one for help.
const WITHOUT_PAGE: [&str; 5] = ["--help", "--map", "--spin", "--views", "--without"];

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn every_option_is_on_the_page() {
    let folder = Folder::new("page-commands");
    let model = "v -1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    std::fs::write(folder.join("a 'model'.obj"), model).unwrap();
    let view = "--size 32x24 --aa msaa4 --cull cw --shading flat --depth unorm24 --yaw=-30 \
                --pitch 10.5 --zoom 2 --fov 50 --up z --normals flat --specular 0.5,30 --opacity 0.5 --layers 4 --alpha-threshold 0.5 --fog 0,1 --shadows 64 --mip-maps --anisotropy 8";
    let report = "--report --out pages";
    let runs = [
        ("render", vec!["a 'model'.obj"], format!("{view} --engine both --effects all {report}")),
        (
            "plan",
            vec!["a 'model'.obj"],
            format!("{view} --engine edge-function --rounds 1 {report}"),
        ),
        // Options that do not go together with those above.
        (
            "render",
            vec![],
            format!("--scene panels --size 32x24 --wireframe --output drawn.png --json {report}"),
        ),
        ("render", vec!["panels"], format!("--size 32x24 --plan plan.json {report}")),
        ("plan", vec![], format!("--scene panels --size 32x24 --json --whole --rounds 1 {report}")),
        ("study", vec!["a 'model'.obj"], format!("{view} --quick {report}")),
        ("study", vec![], format!("--scene panels --size 32x24 --quick --json {report}")),
        ("inspect", vec!["-0.5,0.5", "5.5,0.5", "5.5,5.5"], {
            format!("--window 0,0,8x8 --plant inclusive-edges --pixel 1,1 {report}")
        }),
        ("specimens", vec![], format!("--seed 3 --cases 2 --specimen book-ch2 {report}")),
        ("verify", vec![], {
            format!(
                "--seed 3 --cases 20 --family sliver --shard 1/2 --plant exclusive-edges {report}"
            )
        }),
        ("cost", vec!["lines"], format!("--quick --seed 3 {report}")),
    ];
    let plan = folder
        .run(&["plan", "panels", "--size", "32x24", "--rounds", "1", "--json"][..])
        .has(0)
        .out;
    std::fs::write(folder.join("plan.json"), plan).unwrap();
    let mut tried = BTreeSet::new();
    for (name, positional, options) in runs {
        tried.extend(
            options
                .split_whitespace()
                .map(|word| (name, word.split('=').next().unwrap().to_owned())),
        );
        let options = options.split_whitespace();
        let words: Vec<_> =
            std::iter::once(name).chain(positional.iter().copied()).chain(options).collect();
        let again = words_of(&shown(&folder, &words, &format!("pages/{name}.html")));
        let sorted = |mut words: Vec<String>| {
            words.sort();
            words
        };
        let typed = words.iter().map(|&word| word.to_owned()).collect();
        // Some put the seed and the number of cases first.
        assert_eq!(sorted(again.clone()), sorted(typed), "{again:?}");
        assert_eq!(again[0], name);
    }
    for name in ["render", "plan", "study"] {
        let help = folder.run(&[name, "--help"][..]).has(0).out;
        let listed = help.lines().filter(|line| line.trim_start().starts_with('-'));
        let options: Vec<_> = listed
            .map(|line| {
                format!("--{}", line.split_once("--").unwrap().1.split(' ').next().unwrap())
            })
            .filter(|option| !WITHOUT_PAGE.contains(&option.as_str()))
            .collect();
        assert!(options.len() > 12, "{help}");
        for option in options {
            assert!(tried.contains(&(name, option.clone())), "{name} {option} is not tried");
        }
    }
    let judged = ["judge", "--cases", "5", "--family", "sliver", "--timeout", "9", "--jobs", "2"];
    let of_them = ["--seed", "2", "--declare", "rule=top left", "--report", "--out", "pages", "--"];
    let words = [&judged[..], &of_them, &[PROGRAM, "engine", "scanline"]].concat();
    let again = words_of(&shown(&folder, &words, "pages/judge.html"));
    let typed: Vec<_> = words.iter().map(|&word| word.to_owned()).collect();
    for word in &typed {
        assert!(again.contains(word), "{word}: {again:?}");
    }
    assert_eq!(again.len(), typed.len());
    let place =
        |words: &[String]| words.iter().skip_while(|w| *w != "--").cloned().collect::<Vec<_>>();
    assert_eq!(place(&again), place(&typed));
}
