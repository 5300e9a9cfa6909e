//! What commands print with `--json`, and what pages show, is what `docs/schema.json` says: no field is missing, renamed or undescribed.

use rasterproof_report::html::{self, Report};
use rasterproof_report::page_cases;
use rasterproof_wasm::figures;
use rasterproof_wasm::question::answer;
use serde_json::{Value, json};

use crate::json_schema::wrong;
use crate::made_pages::every_section;
use crate::pages::read;
use crate::program::{Folder, PROGRAM, table};

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn every_json_is_as_its_schema_says() {
    let folder = Folder::new("schema");
    folder.put("m.obj", read("tests/data/ties.obj"));
    folder.put("ties.mtl", read("tests/data/ties.mtl"));
    let mut found = Vec::new();
    for [name, words] in table("schema") {
        let run = folder.run(words.replace("PROGRAM", PROGRAM));
        found.extend(wrong(&name, &run.json()).map(|one| format!("{words}: {one}")));
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

/// What the viewer of a report is given, and what each live figure shows.
#[test]
fn what_pages_show_is_as_its_schema_says() {
    let cases = page_cases::of_specimens();
    let page = html::page(&Report { cases, ..every_section() });
    let (_, data) = page.split_once("id=\"data\">").unwrap();
    let data: Value = serde_json::from_str(data.split_once("</script>").unwrap().0).unwrap();
    for part in ["cases", "frames"] {
        assert_ne!(data[part], json!([]), "{part}");
    }
    assert_eq!(wrong("page", &data), None);
    let renamed = data.to_string().replacen("\"runs\"", "\"spans\"", 1);
    let renamed = serde_json::from_str(&renamed).unwrap();
    assert_eq!(
        wrong("page", &renamed).as_deref(),
        Some("page/cases/0/layers/0: \"runs\" is missing")
    );
    for figure in figures::ALL.iter() {
        let question = json!({ "ask": "figure", "name": figure.name, "language": "en" });
        let shown: Value = serde_json::from_str(&answer(&question.to_string())).unwrap();
        assert_eq!(wrong("figure", &shown), None, "{}", figure.name);
    }
}

/// A field that is missing, another name and another type are found, however deep.
#[test]
fn a_json_unlike_its_schema_is_found() {
    let good = json!({ "seed": 1, "cases": 2, "sha256": "0", "parts": [
        { "engine": "dda", "what": "lines", "sha256": "0" }
    ] });
    assert_eq!(wrong("digest", &good), None);
    type Spoil = fn(&mut Value);
    let spoils: [(Spoil, &str); 4] = [
        (|v| drop(v.as_object_mut().unwrap().remove("seed")), "digest: \"seed\" is missing"),
        (
            |v| drop(v["parts"][0].as_object_mut().unwrap().remove("what")),
            "digest/parts/0: \"what\" is missing",
        ),
        (|v| v["parts"][0]["hash"] = json!("0"), "digest/parts/0: hash is not known"),
        (|v| v["seed"] = json!("1"), "digest/seed: \"1\" is not what it should be"),
    ];
    for (spoil, says) in spoils {
        let mut value = good.clone();
        spoil(&mut value);
        assert_eq!(wrong("digest", &value).as_deref(), Some(says));
    }
}
