//! Where nothing was judged, the library returns an error. What the program says is in `tests/transcripts/not-judged.md`.

use rasterproof_registry::engines::{Engine, LineEngine};
use rasterproof_verify::cases::FamilyName;
use rasterproof_verify::comparison::{
    NothingJudged, Options, Shard, judge_coverage, judge_line_values,
};

#[test]
fn the_library_returns_an_error() {
    let lines = Options::default().family(FamilyName::LineTies);
    let error = judge_coverage(&Engine::Scanline, &lines).unwrap_err();
    let error: Box<dyn std::error::Error> = Box::new(error);
    assert!(error.to_string().contains("line-ties hold other shapes"), "{error}");
    let none = Options::default().cases(0);
    let error = judge_line_values(&LineEngine::JUDGED[0], &none).unwrap_err();
    assert_eq!(error, NothingJudged::NoCases);
    assert!("unifrom".parse::<FamilyName>().is_err() && Shard::new(0, 0).is_err());
}
