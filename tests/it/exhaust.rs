//! Proofs by exhaustion: the small ones in full, and that stopping, sharding and merging change
//! nothing, that planted faults are found, and that the certificates in the docs are of this code.

use std::fs;
use std::process::{Child, Stdio};
use std::sync::Mutex;
use std::time::Duration;

use rasterproof_exhaustive::certificate::{Certificate, Timing, merge};
use rasterproof_exhaustive::identity::Shard;
use rasterproof_exhaustive::run::{Progress, run};
use rasterproof_exhaustive::{Plan, edges, lines, triangles};

use crate::pages::{files, read, root};
use crate::program::Folder;

fn triangles(subpixel_bits: u32) -> triangles::Triangles {
    let (window_px, offset_px) = (4, [0, 0]);
    triangles::Triangles { window_px, subpixel_bits, offset_px, all_orders: false, plant: None }
}

fn lines(reach: u32) -> lines::Lines {
    lines::Lines { reach, offset_px: [0, 0], first_octant: false, plant: None }
}

fn edges(subpixel_bits: u32) -> edges::Edges {
    let (window_px, offset_px) = (4, [0, 0]);
    edges::Edges { window_px, subpixel_bits, offset_px, every_position: false, plant: None }
}

fn certify_part(plan: &Plan, shard: Shard) -> Certificate {
    plan.check().unwrap();
    let finished = run(Progress::new(plan, shard), Duration::from_secs(3600), &|_| {}, &|_| {});
    let mut certificate = Certificate::new(finished, 1);
    // What is left is the same in every run.
    certificate.timing = Timing::default();
    certificate
}

fn certify(plan: &Plan) -> Certificate {
    certify_part(plan, Shard::WHOLE)
}

/// All cases agree, and there are as many as the arithmetic of the caller says.
fn check(plan: &Plan, cases: u64) -> Certificate {
    let certificate = certify(plan);
    assert!(certificate.proved, "{}", certificate.to_json());
    assert_eq!((certificate.done.cases, certificate.expected.cases), (cases, cases));
    certificate
}

#[test]
fn exhaust_triangles_agree_at_one_and_two_bits() {
    // 9^2 choose 3 and 17^2 choose 3; the oracle's own code judges every one.
    let certificate = check(&Plan::Triangles(triangles(1)), 85_320);
    assert_eq!(certificate.done.oracle_checks, 85_320);
    assert_eq!(certificate.done.comparisons, 2 * 85_320);
    let certificate = check(&Plan::Triangles(triangles(2)), 3_981_264);
    assert_eq!(certificate.done.oracle_checks, 3_981_264);
}

#[test]
fn exhaust_triangles_agree_in_all_orders_and_elsewhere() {
    let all_orders = triangles::Triangles { all_orders: true, ..triangles(1) };
    let certificate = check(&Plan::Triangles(all_orders), 85_320);
    assert_eq!(certificate.done.comparisons, 12 * 85_320);
    for offset_px in [[2048, -2048], [-16_384, 16_384], [16_384, -16_384], [1 << 22, -(1 << 22)]] {
        check(&Plan::Triangles(triangles::Triangles { offset_px, ..triangles(1) }), 85_320);
    }
    // Mixed signs once more on the finer lattice.
    let finer = triangles::Triangles { offset_px: [-2048, 2048], ..triangles(2) };
    check(&Plan::Triangles(finer), 3_981_264);
    // 2 px at 3 bits is the lattice of 4 px at 2 bits, twice as fine: 17^2 choose 3 again. Of it,
    // 9^2 choose 3 lie on the sublattice that the oracle's code judges too.
    let small = triangles::Triangles { window_px: 2, ..triangles(3) };
    let certificate = check(&Plan::Triangles(small), 3_981_264);
    assert_eq!(certificate.done.oracle_checks, 85_320);
}

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn exhaust_triangles_agree_on_the_finer_lattice_in_the_other_direction() {
    let finer = triangles::Triangles { offset_px: [16_384, -16_384], ..triangles(2) };
    check(&Plan::Triangles(finer), 3_981_264);
}

#[test]
fn exhaust_lines_agree() {
    let certificate = check(&Plan::Lines(lines(128)), 257 * 257);
    assert_eq!(certificate.done.oracle_checks, 129 * 129);
    assert_eq!(certificate.done.comparisons, 13 * 257 * 257);
    let octant = lines::Lines { first_octant: true, ..lines(256) };
    check(&Plan::Lines(octant), 257 * 258 / 2);
    check(&Plan::Lines(lines::Lines { offset_px: [-16_384, 2048], ..lines(16) }), 33 * 33);
    check(&Plan::Lines(lines(1)), 9);
}

#[test]
fn exhaust_edges_agree() {
    // Counted by brute force: pairs of different points, by their undirected edge, up to shifts.
    for bits in [0, 1, 2] {
        let side = 1i32 << bits;
        let points: Vec<_> =
            (0..=4 * side).flat_map(|y| (0..=4 * side).map(move |x| (x, y))).collect();
        let mut seen = std::collections::HashSet::new();
        let mut all = 0;
        for (i, a) in points.iter().enumerate() {
            for b in &points[i + 1..] {
                let shift = (a.0.min(b.0).div_euclid(side), a.1.min(b.1).div_euclid(side));
                let moved = |p: &(i32, i32)| (p.0 - shift.0 * side, p.1 - shift.1 * side);
                seen.insert((moved(a), moved(b)));
                all += 1;
            }
        }
        check(&Plan::Edges(edges(bits)), seen.len() as u64);
        check(&Plan::Edges(edges::Edges { every_position: true, ..edges(bits) }), all);
    }
    assert!(certify(&Plan::Edges(edges(4))).proved);
    let far = edges::Edges { offset_px: [16_384, -2048], every_position: true, ..edges(3) };
    assert!(certify(&Plan::Edges(far)).proved);
}

/// At 8 bits the enumeration has the size that the lemma is about.
#[test]
fn exhaust_edges_expect_the_full_count() {
    // min and max of x: 256 * 1024 - 255 * 256 / 2 pairs; left to right, right to left, or equal.
    let pairs = 229_504;
    let expected = pairs * (2 * pairs + 256) + 256 * pairs;
    assert_eq!(Plan::Edges(edges(8)).enumeration().expected_cases(), expected);
    assert_eq!(expected, 105_461_678_080);
}

#[test]
fn exhaust_finds_planted_faults() {
    let found = |plan: Plan| {
        let certificate = certify(&plan);
        assert!(!certificate.proved && !certificate.agrees(), "{}", certificate.claim);
        assert!(!certificate.done.examples.is_empty());
    };
    for name in [
        "inclusive-edges",
        "exclusive-edges",
        "bottom-right-rule",
        "left-only-rule",
        "sample-off-by-one-subpixel",
        "drops-first-row",
        "culls-one-winding",
        "panics-on-flat-bottom",
        "leaves-window",
    ] {
        let plant = Some(name.to_owned());
        found(Plan::Triangles(triangles::Triangles { plant, ..triangles(1) }));
    }
    for name in ["line-directed-ties", "line-misses-end", "line-truncates", "line-draws-backwards"]
    {
        found(Plan::Lines(lines::Lines { plant: Some(name.to_owned()), ..lines(16) }));
    }
    let plant = Some(edges::PLANT.to_owned());
    found(Plan::Edges(edges::Edges { plant, ..edges(1) }));
}

/// Two hits are not one, and a pixel outside the window is not nothing.
#[test]
fn exhaust_wraps_in_i32_only_far_away() {
    let plant = Some("wraps-in-i32".to_owned());
    let near = triangles::Triangles { plant, ..triangles(1) };
    // The fault of 32-bit products does not show in so small a window: the proof is about what it
    // enumerates, and the families of `verify` are there for the rest.
    check(&Plan::Triangles(near), 85_320);
}

#[test]
fn exhaust_refuses_what_it_cannot_do() {
    for plan in [
        Plan::Triangles(triangles(5)),
        Plan::Triangles(triangles::Triangles { window_px: 5, ..triangles(1) }),
        Plan::Triangles(triangles::Triangles { window_px: 0, ..triangles(1) }),
        Plan::Triangles(triangles::Triangles { offset_px: [i32::MIN, 0], ..triangles(1) }),
        Plan::Triangles(triangles::Triangles { plant: Some("x".to_owned()), ..triangles(1) }),
        Plan::Edges(edges(9)),
        Plan::Lines(lines(0)),
        Plan::Lines(lines(1 << 14)),
    ] {
        assert!(plan.check().is_err(), "{plan:?}");
    }
}

fn samples() -> [Plan; 4] {
    let plant = Some("inclusive-edges".to_owned());
    [
        Plan::Triangles(triangles(1)),
        Plan::Triangles(triangles::Triangles { plant, ..triangles(1) }),
        Plan::Lines(lines(24)),
        Plan::Edges(edges(3)),
    ]
}

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn exhaust_resumes_to_the_same_certificate() {
    for plan in samples() {
        let whole = certify(&plan);
        // Keep the states of a run that saves after each chunk.
        let states = Mutex::new(Vec::new());
        let keep = |progress: &Progress| states.lock().unwrap().push(progress.clone());
        run(Progress::new(&plan, Shard::WHOLE), Duration::ZERO, &keep, &|_| {});
        let states = states.into_inner().unwrap();
        assert!(states.len() > 16, "{} states", states.len());
        for state in states.into_iter().step_by(7) {
            let text = serde_json::to_string(&state).unwrap();
            let resumed: Progress = serde_json::from_str(&text).unwrap();
            assert!(resumed.belongs_to(&plan, Shard::WHOLE));
            let left = Mutex::new(0);
            let step = |cases| *left.lock().unwrap() += cases;
            let before = resumed.tally.cases;
            let finished = run(resumed, Duration::from_secs(3600), &|_| {}, &step);
            let mut certificate = Certificate::new(finished, 1);
            certificate.timing = Timing::default();
            assert_eq!(certificate, whole);
            // It continued instead of beginning anew.
            assert_eq!(before + left.into_inner().unwrap(), whole.done.cases);
        }
    }
}

#[test]
fn exhaust_does_not_depend_on_the_number_of_threads() {
    for plan in samples() {
        let with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| certify(&plan).to_json())
        };
        assert_eq!(with(1), with(3));
    }
}

fn shards(plan: &Plan, parts: u64) -> Vec<(String, Certificate)> {
    (0..parts)
        .map(|part| (format!("{part}.json"), certify_part(plan, Shard { part, parts })))
        .collect()
}

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn exhaust_shards_merge_into_the_whole() {
    for plan in samples() {
        let whole = certify(&plan);
        for parts in [1, 2, 5] {
            let mut shards = shards(&plan, parts);
            assert!(parts == 1 || shards.iter().all(|(_, shard)| !shard.proved));
            shards.reverse();
            assert_eq!(merge(&shards).unwrap(), whole, "{parts} parts");
        }
    }
}

/// That a certificate is of this program and consistent is what `tests/transcripts/certificates.md` is about.
#[test]
fn exhaust_merge_refuses_what_does_not_fit() {
    let refused = |shards: &[(String, Certificate)], why: &str| {
        let message = merge(shards).unwrap_err();
        assert!(message.contains(why), "{message}");
    };
    let good = shards(&Plan::Triangles(triangles(1)), 3);
    refused(&[], "no certificates");
    refused(&good[..2], "missing: 2");
    refused(&[&good[..], &good[1..2]].concat(), "1.json and 1.json are both shard 1 of 3");
    let other = shards(&Plan::Triangles(triangles(0)), 3);
    refused(&[&good[..2], &other[2..]].concat(), "what they enumerate");
    let mut parts = good.clone();
    parts[2].1.shard.parts = 4;
    refused(&parts, "the number of shards");
    assert!(merge(&good).unwrap().proved);
}

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn exhaust_command_survives_a_kill() {
    let folder = Folder::new("exhaust-kill");
    let words = "exhaust triangles --subpixel-bits 3 --shard 0/8 --checkpoint c.json -o o.json";
    let mut child = folder.command(words).spawn().unwrap();
    // The first state is written at the start, the next after some seconds.
    let is_under_way = || {
        let text = fs::read_to_string(folder.join("c.json")).unwrap_or_default();
        serde_json::from_str::<Progress>(&text).is_ok_and(|state| !state.done.is_empty())
    };
    let mut finished = false;
    while !is_under_way() && !finished {
        std::thread::sleep(Duration::from_millis(20));
        finished = child.try_wait().unwrap().is_some();
    }
    let _ = child.kill();
    let _ = child.wait();
    folder.check(words, 0);
    let certificate = Certificate::from_json(&folder.text("o.json")).unwrap();
    assert!(certificate.agrees());
    let chunks = (0..1089u64).step_by(8).map(|i| 1088 - i);
    let cases: u64 = chunks.map(|left| left * left.saturating_sub(1) / 2).sum();
    assert_eq!(certificate.done.cases, cases);
}

/// The certificates in the docs are proofs about this code, and say what the program would say.
#[test]
fn exhaust_certificates_in_the_docs_are_of_this_code() {
    let files = files(&root().join("docs/certificates"), ".json");
    assert!(!files.is_empty(), "no certificates");
    for path in files {
        let certificate = Certificate::from_json(&read(&path)).unwrap();
        let name = path.display();
        assert!(certificate.proved && certificate.agrees() && certificate.is_complete(), "{name}");
        let progress = Progress::new(&certificate.identity.plan, Shard::WHOLE);
        let finished = Progress { tally: certificate.done.clone(), ..progress };
        let mut expected = Certificate::new(finished, 0);
        expected.timing = certificate.timing.clone();
        let renew = format!("renew it: {} -o {name}", certificate.repeat);
        assert_eq!(certificate, expected, "{name} is about other code; {renew}");
    }
}

/// A process that does not outlive its test.
struct Killed(Child);

impl Drop for Killed {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// The second process does not touch the state of the first, and says who has it.
#[test]
fn two_processes_do_not_share_a_checkpoint() {
    let folder = Folder::new("certificates-lock");
    let long = "exhaust edges --subpixel-bits 8 --checkpoint c.json -o long.json";
    let first = folder.command(long).stderr(Stdio::null()).spawn().unwrap();
    let mut first = Killed(first);
    while !folder.join("c.json").exists() {
        assert!(first.0.try_wait().unwrap().is_none(), "the first process has ended");
        std::thread::sleep(Duration::from_millis(20));
    }
    let second = folder.run("exhaust lines --reach 3 --restart --checkpoint ./c.json");
    second.has(2).says(&format!("c.json: is in use by another process {}; ", first.0.id()));
    assert!(folder.text("c.json").contains("\"edges\""));
    // What a killed process leaves is taken over.
    drop(first);
    folder.run("exhaust lines --reach 3 --restart --checkpoint c.json").has(0);
    assert!(!folder.join("c.json").exists() && !folder.join("c.json.lock").exists());
}
