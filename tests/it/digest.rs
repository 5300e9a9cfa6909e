//! The digest of the engines is the one in the repository: the same bits as on the machines before.

use crate::program::{Run, shared};

const WORDS: &str = "--seed 1 --cases 4";

fn digest(words: &str) -> Run {
    Run::of(shared().command(format!("digest {words}")).env("RAYON_NUM_THREADS", "2"))
}

#[test]
fn digest_is_as_kept() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/digest.txt");
    let kept = std::fs::read_to_string(path).unwrap();
    let Run { status, out: text, errors, .. } = digest(WORDS);
    assert_eq!((status, errors.as_str()), (Some(0), ""));
    assert!(text.lines().all(|line| line.len() <= 100), "{text}");
    // Where a change of an engine or of a family is meant, the new text belongs into the file; where
    // none was made, this machine computes other bits.
    assert_eq!(text, kept, "rasterproof digest {} prints something else", WORDS);
}

#[test]
fn digest_of_one_engine_as_json() {
    let Run { status, out: json, .. } = digest("--cases 1 --engine dda --json");
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(
        (status, json["cases"].as_u64(), json["seed"].as_u64()),
        (Some(0), Some(1), Some(1))
    );
    let parts = json["parts"].as_array().unwrap();
    assert_eq!((parts.len(), parts[0]["what"].as_str()), (1, Some("lines")));
    for sha256 in [&json["sha256"], &parts[0]["sha256"]] {
        assert_eq!(sha256.as_str().unwrap().len(), 64);
    }
}

#[test]
fn digest_refuses_what_it_has_not() {
    digest("--engine nobody").has(2).says("nobody");
    digest("--cases 0").has(2).says("0");
}
