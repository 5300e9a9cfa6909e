//! Whoever is judged, a message has the smallest case, what was drawn beside what is expected, a cause or that none is known, and
//! what repeats it. Devices are in `planted_faults_are_caught` of the crate `vulkan`, browsers in `a_finding_is_shown` of `your_gpu`.

use rasterproof_faults::planted::exact::ExactMutant;
use rasterproof_faults::planted::{LineMutant, TriangleMutant};
use rasterproof_verify::comparison::tolerance;
use rasterproof_verify::comparison::{
    Options, judge_coverage, judge_exact, judge_line_values, judge_values,
};
use rasterproof_verify::partition::{self, Polygon, Triangle, judge_partitions};

use crate::program::{Folder, PROGRAM, Run};

/// Checks a message for its parts: the words before the case, beside the picture, and before what repeats it.
#[track_caller]
fn is_whole(message: &str, [case, picture, repeat]: [&str; 3]) {
    let found = message.find(case).zip(message.find(picture)).zip(message.find(repeat));
    assert!(found.is_some_and(|((case, picture), _)| case < picture), "{message}");
    let causes = [
        "probable cause",
        "by its convention: ",
        "it looks as if",
        "no cause was recognised",
        "no known mistake",
    ];
    assert!(causes.iter().any(|words| message.contains(words)), "{message}");
}

#[test]
fn messages_about_engines_and_tessellators_are_whole() {
    let parts = [", shrunk)\n", "  judged ", "repeat with: Options"];
    let options = Options::default().cases(40);
    let verdict = judge_coverage(&TriangleMutant::InclusiveEdges, &options).unwrap();
    is_whole(&verdict.check().unwrap_err().to_string(), parts);
    let verdict = judge_line_values(&LineMutant::DirectedTies, &options).unwrap();
    is_whole(&verdict.check().unwrap_err().to_string(), parts);
    // Of this one the search recognises no cause, because small triangles are right.
    let verdict = judge_exact(&ExactMutant::PlainF64, &options).unwrap();
    let message = verdict.check().unwrap_err().to_string();
    is_whole(&message, parts);
    assert!(message.contains("no cause was recognised"), "{message}");
    let verdict =
        judge_values(&TriangleMutant::AffineAttributes, tolerance::SCANLINE, &options).unwrap();
    is_whole(&verdict.check().unwrap_err().to_string(), parts);

    let first = |polygon: &Polygon| -> Vec<Triangle> {
        let contour = &polygon.contours[0];
        (2..contour.len()).map(|i| [contour[0], contour[i - 1], contour[i]]).collect()
    };
    let report = judge_partitions(&first, &partition::Options::default().cases(20)).unwrap();
    let message = report.check().unwrap_err().to_string();
    is_whole(&message, ["the smallest polygon", "#", "found in: Options"]);
}

#[test]
fn messages_about_programs_and_steps_are_whole() {
    let folder = Folder::new("subjects");
    for engine in ["inclusive-edges", "line-directed-ties", "affine-attributes"] {
        let words = ["judge", "--cases", "20", "--", PROGRAM, "engine", engine];
        let Run { out, .. } = folder.check(words, 1);
        is_whole(&out, ["shrunk)\n", "\n  judged ", "repeat with: "]);
    }
    let words = ["course", "check", "top-left", "--cases", "24", "--"];
    let words = [&words[..], &[PROGRAM, "engine", "inclusive-edges"]].concat();
    let Run { out, .. } = folder.check(words, 1);
    is_whole(&out, ["smallest found", "yours", "repeat with: "]);
}

#[test]
fn messages_about_invariants_are_whole() {
    let folder = Folder::new("subjects-invariants");
    for (plant, invariant) in
        [("inclusive-edges", "engines-agree"), ("line-misses-end", "one-per-step")]
    {
        let words = ["verify", "--invariant", invariant, "--cases", "200", "--plant", plant];
        let Run { out, .. } = folder.check(words, 1);
        is_whole(&out, [", shrunk)\n", "  expected\n", "repeat with: "]);
    }
}
