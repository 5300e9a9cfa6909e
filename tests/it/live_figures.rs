//! The live figures of the pages stand there with their pictures and words. What a browser shows of them is checked in `tests/pages/figures`.

use std::collections::BTreeSet;
use std::fs;

use rasterproof_wasm::figures::{ALL, Figure, Language, find};
use rasterproof_wasm::question::answer;
use serde_json::{Value, json};

use crate::pages::{Renewal, read, root};

/// What a figure is for these positions of its grips, drawn by the oracle.
fn expected(figure: &Figure, language: &str, at: &Value, is_answered: bool) -> Value {
    let question = json!({ "ask": "figure", "name": figure.name, "language": language, "at": at,
        "is_answered": is_answered, "by": "oracle" });
    let answer: Value = serde_json::from_str(&answer(&question.to_string())).unwrap();
    assert!(answer["error"].is_null(), "{}: {}", figure.name, answer["error"]);
    answer
}

/// `RASTERPROOF_RENEW=1 cargo test --test it live_figures_stand` draws the still pictures and writes what stands
/// between `<rp-figure scene="...">` and `</rp-figure>` anew.
#[test]
fn live_figures_stand_on_their_pages() {
    let mut renewal = Renewal::default();
    for figure in ALL.iter() {
        let svg = figure.still().unwrap();
        assert!(svg.len() < 16_000, "{}: a picture of {} bytes", figure.name, svg.len());
        renewal.is(format!("docs/figures/live/{}.svg", figure.name), &svg);
        for (folder, language) in [("docs", Language::En), ("docs/zh", Language::Zh)] {
            let path = format!("{folder}/{}.md", figure.page);
            let page = read(&path);
            let begin = format!("<rp-figure scene=\"{}\">", figure.name);
            let parts: Vec<_> = page.split(&begin).collect();
            assert_eq!(parts.len(), 2, "{begin} belongs on {path} once");
            let (_, after) = parts[1].split_once("</rp-figure>").expect("a figure ends");
            let block = figure.block(language).unwrap();
            renewal.is(&path, &[parts[0], &block, after].concat());
        }
    }
    // The first page shows one of them again, with its answer.
    for (folder, language) in [("docs", Language::En), ("docs/zh", Language::Zh)] {
        let first = find("shared-edge").unwrap().block(language).unwrap();
        let open = first.replacen("\">", "\" open>", 1);
        assert!(
            read(format!("{folder}/index.md")).contains(&open),
            "{folder}/index.md has no {open}"
        );
    }
    // No picture is left over, and every chapter has two figures.
    let pictures = fs::read_dir(root().join("docs/figures/live")).unwrap().count();
    assert_eq!(pictures, ALL.len());
    renewal.check("live_figures_stand");
}

/// At every end of every grip: words with all numbers in them, a prediction that can be right, a picture.
#[test]
fn live_figures_are_whole() {
    for figure in ALL.iter() {
        let starts: Vec<_> = figure.grips().iter().map(|grip| grip.start).collect();
        let mut places = vec![starts.clone()];
        for (i, grip) in figure.grips().iter().enumerate() {
            for end in [grip.low, grip.high] {
                let mut at = starts.clone();
                at[i] = end;
                places.push(at);
            }
        }
        let mut predictions = BTreeSet::new();
        for (at, language) in places.iter().flat_map(|at| [(at, "en"), (at, "zh")]) {
            let drawn = expected(figure, language, &json!(at), true);
            let text = drawn.to_string();
            let told = |key: &str| drawn[key].as_str().unwrap().to_owned();
            for key in ["title", "question", "answer", "alt"] {
                let words = told(key);
                assert!(
                    !words.contains(['{', '}']) && !words.is_empty(),
                    "{}: {words}",
                    figure.name
                );
            }
            assert!(!text.contains("NaN") && !text.contains("inf\""), "{}: {text}", figure.name);
            assert_eq!(drawn["at"], json!(at), "{}", figure.name);
            assert_eq!(drawn["grips"].as_array().unwrap().len(), starts.len(), "{}", figure.name);
            assert!(told("link").starts_with("#scene="), "{}", figure.name);
            let predict = &drawn["predict"];
            match predict["kind"].as_str().unwrap() {
                "pixels" => {
                    let cells = predict["cells"].as_array().unwrap().len();
                    assert_eq!(cells, predict["right"].as_array().unwrap().len());
                    assert!((2..=64).contains(&cells), "{}: {cells} pixels", figure.name);
                }
                "choice" => {
                    let right = predict["right"].as_u64().unwrap() as usize;
                    assert!(
                        right < predict["options"].as_array().unwrap().len(),
                        "{}",
                        figure.name
                    );
                }
                _ => assert!(predict["right"].as_str().unwrap().parse::<f64>().is_ok()),
            }
            predictions.insert(predict["right"].to_string());
            // Before the answer nothing of it is drawn.
            let asked = expected(figure, language, &json!(at), false);
            assert!(!asked["svg"].as_str().unwrap().contains("class=\"px"), "{}", figure.name);
            assert_eq!(asked["predict"], *predict, "{}", figure.name);
        }
        // The corner that becomes red is the same one wherever the corners lie: that is the fault.
        let changes = predictions.len() > 1 || figure.name == "wrong-corner";
        assert!(changes, "{}: what is right never changes", figure.name);
    }
}
