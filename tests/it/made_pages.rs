//! Pages that no command writes, for the checks in `tests/pages`.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use image::{Rgb, RgbImage};
use rasterproof_playground as pages;
use rasterproof_report::html::{
    Figure, Outcome, PictureLayer, PictureView, Report, Statement, TextDiff, page,
};
use rasterproof_report::table::{Column, Row, Table};
use rasterproof_report::{canvas, picture};
use rasterproof_view::{script, style};
use rasterproof_wasm::figures::{self, Language};

use crate::pages::{read, root};
use crate::program::{Folder, Run, shared};
use crate::snapshots::ELSEWHERE;

/// Writes the page of this name; where it is.
pub fn made(name: &str) -> PathBuf {
    let folder = shared().join("made").join(name.replace(' ', "-"));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    let text = match name {
        "every-section" => page(&every_section()),
        "plots" => page(&plots()),
        "marks" => page(&marks()),
        "view" => view(),
        "figures en" => all_figures(&folder, "en", Language::En),
        "figures zh" => all_figures(&folder, "zh", Language::Zh),
        "review" => return changed_snapshot(&folder),
        name => panic!("no page is called {name}"),
    };
    let path = folder.join("index.html");
    fs::write(&path, text).unwrap();
    path
}

/// What a name must not be able to do.
const HOSTILE: &str = "</script><img src=x onerror=\"document.title='broken into'\">&{{data}}'";

fn two_pictures() -> Vec<PictureLayer> {
    let old = RgbImage::from_pixel(7, 5, Rgb([10, 20, 30]));
    let mut new = old.clone();
    new.put_pixel(4, 2, Rgb([200, 20, 30]));
    vec![PictureLayer::new("scanline", &old), PictureLayer::new(HOSTILE, &new)]
}

pub fn every_section() -> Report {
    let hostile = || HOSTILE.to_owned();
    Report {
        title: hostile(),
        about: hostile(),
        outcome: Some(Outcome {
            good: true,
            word: hostile(),
            answer: hostile(),
            sentence: hostile(),
        }),
        answers: vec![Statement { about: HOSTILE, sentence: hostile(), command: hostile() }],
        command: hostile(),
        notes: vec![hostile()],
        tables: vec![Table {
            caption: hostile(),
            columns: vec![Column::words(HOSTILE), Column::numbers("n", HOSTILE)],
            rows: vec![Row {
                cells: vec![hostile(), hostile()],
                search: Some(hostile()),
                ..Row::default()
            }],
            notes: vec![hostile()],
            ..Table::default()
        }],
        frames: vec![PictureView {
            name: hostile(),
            about: hostile(),
            command: hostile(),
            layers: two_pictures(),
            ..PictureView::default()
        }],
        figures: vec![Figure {
            caption: hostile(),
            svg: "<svg xmlns='http://www.w3.org/2000/svg' width='60' height='20'/>".to_owned(),
            others: vec![],
        }],
        diffs: vec![TextDiff {
            name: hostile(),
            about: hostile(),
            command: hostile(),
            old: Some("same\nold\n".to_owned()),
            new: format!("same\n{HOSTILE}\n"),
        }],
        ..Report::default()
    }
}

/// A plot that is drawn for the width of its page: wide, usual, and for a phone.
fn plots() -> Report {
    let drawn = [1200.0, 800.0, 400.0].map(|width| canvas::Drawing::new("a plot", [width, 90.0]));
    Report { figures: vec![canvas::figure("a plot", drawn)], ..Report::default() }
}

/// A picture beside one whose colours are marks, and a plot.
fn marks() -> Report {
    let [old, new] = [[10, 20, 30], [200, 20, 30]].map(|c| RgbImage::from_pixel(7, 5, Rgb(c)));
    let marks = [(Rgb([200, 20, 30]), "where it is wrong")];
    let layers = vec![PictureLayer::new("picture", &old), PictureLayer::map("marks", &new, &marks)];
    let [name, about] = ["one", "198 of 19200 pixels differ"].map(str::to_owned);
    let frames = vec![PictureView { name, about, layers, ..PictureView::default() }];
    let svg = "<svg xmlns='http://www.w3.org/2000/svg' width='60' height='20'/>".to_owned();
    let figures = vec![Figure { caption: "a plot".to_owned(), svg, others: vec![] }];
    Report { frames, figures, ..Report::default() }
}

/// The viewer alone, with the checks that lie beside it.
fn view() -> String {
    let (style, script) = (style(&[]), script(&[&read("tests/pages/driver/viewer.js")]));
    format!(
        "<!DOCTYPE html><html lang=en><meta charset=utf-8><title>view</title><style>{style}</style>\
         <body data-ready><script>{script}</script>"
    )
}

/// All live figures, beside the script, the engines, and the playground to which they lead.
fn all_figures(folder: &Path, tag: &str, language: Language) -> String {
    let built = root().join("target/rasterproof");
    fs::write(folder.join("figure.js"), pages::figure_script()).unwrap();
    fs::copy(built.join("engines.js"), folder.join("engines.js")).unwrap();
    let module = fs::read(built.join("playground.wasm")).unwrap();
    let playground = pages::page(&pages::PLAYGROUND, &module).unwrap();
    fs::write(folder.join("playground.html"), playground).unwrap();
    let still = |figure: &figures::Figure| {
        // As Markdown becomes HTML, but for the picture.
        let open = figure.block(language).unwrap().replacen("\n\n**", "\n\n<p><strong>", 1);
        let figured = open.replacen("**", "</strong>", 1).replacen("\n\n</rp", "</p></rp", 1);
        let numbers = figure.numbers().unwrap().into_iter();
        let numbers = numbers.map(|(of, _)| format!("<!--n {}.{of}-->?<!--/n--> ", figure.name));
        format!("{figured}<p>In the prose: {}</p>", numbers.collect::<String>())
    };
    let stills: Vec<_> = figures::ALL.iter().map(still).collect();
    read("tests/data/pages/figures.html")
        .replace("LANGUAGE", tag)
        .replace("FIGURES", &stills.join("\n"))
}

/// Gives a folder `snapshots` with one picture of the project, of which one pixel is changed.
fn spoil_a_snapshot(folder: &Path) {
    let (from, to) = (root().join("snapshots"), folder.join("snapshots"));
    fs::create_dir_all(&to).unwrap();
    fs::copy(from.join("verdict.snap"), to.join("verdict.snap")).unwrap();
    let mut image = image::open(from.join("verdict.snap.png")).unwrap().to_rgb8();
    image.put_pixel(20, 30, Rgb([214, 60, 60]));
    fs::write(to.join("verdict.snap.png"), picture::png(&image)).unwrap();
}

/// Runs the test of that picture on the spoilt snapshots; whether it passes, and what it says.
fn run_its_test(folder: &Path, update: &str) -> (bool, String) {
    let output = Command::new(std::env::current_exe().unwrap())
        .args(["--exact", "snapshots::picture_of_a_verdict"])
        .env(ELSEWHERE, folder.join("snapshots"))
        .env("INSTA_UPDATE", update)
        .env_remove("INSTA_FORCE_PASS")
        .env_remove("INSTA_PENDING_DIR")
        .output()
        .unwrap();
    let text = [output.stdout, output.stderr].concat();
    (output.status.success(), String::from_utf8_lossy(&text).into_owned())
}

fn review(folder: &Path) -> (i32, String) {
    let run = Run::of(shared().command("review").current_dir(folder));
    (run.status.unwrap(), run.out + &run.errors)
}

/// The page of `review` after the test of that picture has failed.
fn changed_snapshot(folder: &Path) -> PathBuf {
    spoil_a_snapshot(folder);
    assert_eq!(review(folder).0, 0);
    let (passes, said) = run_its_test(folder, "new");
    assert!(!passes && said.contains("cargo run -- review"), "{said}");
    let (status, said) = review(folder);
    assert_eq!(status, 1, "{said}");
    for line in [
        "snapshots/verdict.snap: 1 of 559989 pixels of the picture changed, from 20,30 to 20,30\n",
        "  accept: cargo insta accept --snapshot snapshots/verdict.snap",
        "INSTA_UPDATE=always cargo test --test it snapshots::",
        "1 changed snapshot waits for review in snapshots.",
    ] {
        assert!(said.contains(line), "{line}: {said}");
    }
    folder.join("target/rasterproof/review.html")
}

/// From a changed picture to its acceptance. What the page shows in between is checked in `tests/pages`.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn a_changed_snapshot_is_accepted() {
    let folder = Folder::new("accepted");
    changed_snapshot(&folder);
    // The test writes its picture as accepted, and nothing waits any more.
    let (passes, said) = run_its_test(&folder, "always");
    assert!(passes, "{said}");
    let (status, said) = review(&folder);
    assert_eq!(status, 0, "{said}");
}
