//! Every Vulkan device that is there, on the stand; where there is none, the tests say so.
//!
//! `.ci/run` names two drivers that run on the processor, lavapipe and SwiftShader.
#![allow(
    clippy::disallowed_methods,
    reason = "tests and benches read and write files of their own"
)]

#[path = "../../../tests/it/json_schema.rs"]
mod json_schema;

use std::io::{BufRead as _, BufReader};
use std::path::{Path, PathBuf};
use std::process::Command;

use rasterproof_core::contract::{Rasterize as _, RasterizeExact as _};
use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_core::triangle::{FreeCorners, Span};
use rasterproof_judge::ask::{Subject, runs_of};
use rasterproof_judge::in_process::Inside;
use rasterproof_judge::verdict::{Scores as _, Shapes};
use rasterproof_judge::{Options, against};
use rasterproof_precision::cost::ExternalChoice as _;
use rasterproof_registry::engines;
use rasterproof_report::html::Report;
use rasterproof_report::text as terminal;
use rasterproof_verify::oracle::Oracle;
use rasterproof_verify::specification::Standing;
use rasterproof_vulkan::device::Error;
use rasterproof_vulkan::device::find::{self, About};
use rasterproof_vulkan::device::kind::{CELL_PX, Kind};
use rasterproof_vulkan::gpu::campaign::{self, DeviceReport};
use rasterproof_vulkan::gpu::cells::{draw_of, plain, twice_area_px2};
use rasterproof_vulkan::gpu::choice::OnLadder;
use rasterproof_vulkan::gpu::engine::{Gpu, hits_kind};
use rasterproof_vulkan::gpu::known;
use rasterproof_vulkan::gpu::text;

/// The names of all devices; says where there are none.
fn devices() -> Vec<String> {
    match find::list() {
        Ok(all) => all.iter().map(|d| format!("vulkan:{}", d.number)).collect(),
        Err(error) => {
            assert!(
                std::env::var_os("RASTERPROOF_NEEDS_VULKAN").is_none(),
                "a Vulkan device is needed here: {error}"
            );
            eprintln!("skipped: no Vulkan device: {error}");
            Vec::new()
        }
    }
}

fn options(cases: u64, families: &[&str]) -> Options {
    let families = families.iter().map(|f| (*f).to_owned());
    families.fold(Options::default().cases(cases), Options::family)
}

fn judged(engine: &str, options: &Options) -> DeviceReport {
    campaign::judge(Gpu::named(engine).unwrap(), options, &|_| ())
}

fn report(stand: &DeviceReport) -> Report {
    text::report(stand, "all", &|family, index| format!("{family}#{index}"))
}

fn said(stand: &DeviceReport) -> String {
    terminal::text(&report(stand), false, false, terminal::WIDTH)
}

/// The JSON of a device is that of a program, with what is known of the device.
fn is_as_its_schema_says(stand: &DeviceReport) {
    let data = report(stand).data;
    assert!(data["device"]["findings"].is_array());
    assert_eq!(json_schema::wrong("judge", &data), None);
}

fn class(stand: &DeviceReport, name: &str) -> Standing {
    stand.findings.iter().find(|f| f.name == name).unwrap_or_else(|| panic!("no {name}")).class
}

/// Whether it is one of the two drivers whose answers are known to be the oracle's.
fn is_known_right(about: &About) -> bool {
    ["lavapipe", "swiftshader"].iter().any(|word| about.words().contains(word))
}

/// Any two subjects are compared case by case, here a device and an engine of this project.
#[test]
fn a_device_is_compared_with_an_engine() {
    for name in devices() {
        let gpu = Gpu::named(&name).unwrap();
        if !is_known_right(gpu.about()) {
            continue;
        }
        let mut pair: [[Box<dyn Subject>; 2]; 1] =
            [[Box::new(gpu), Box::new(Inside::new(engines::find("scanline").unwrap()))]];
        let options = options(12, &["half-integer"]);
        let same = against::compare(&mut pair, &options, &|_| ());
        assert!(same.agrees() && same.sides().both == 0, "{:?}", same.sides());
        pair[0][1] = Box::new(Inside::new(engines::find("games101-strict").unwrap()));
        let verdict = against::compare(&mut pair, &options, &|_| ());
        let sides = verdict.sides();
        assert!(sides.first > 0 && sides.second + sides.neither == 0, "{name}: {sides:?}");
        assert!(!verdict.failures.is_empty());
    }
}

#[test]
fn every_device_is_judged() {
    for engine in devices() {
        let stand = judged(&engine, &options(48, &[]));
        let text = said(&stand);
        assert!(stand.agrees(), "{text}");
        assert!(stand.verdict.shapes(Shapes::Triangles) > 1000);
        if is_known_right(&stand.about) {
            for name in ["half-integer", "fan", "near-tie", "huge", "watertight", "samples4"] {
                assert_eq!(class(&stand, name), Standing::Equal, "{name}: {text}");
            }
            assert_eq!(class(&stand, "snapping"), Standing::Equal, "{text}");
            assert_eq!(class(&stand, "the same twice"), Standing::Equal, "{text}");
        }
        assert_eq!(report(&stand).data["agrees"], true);
        is_as_its_schema_says(&stand);
    }
}

/// Every planted fault is noticed where it shows, and a shrunk case of coverage has its grid.
#[test]
fn planted_faults_are_caught() {
    let faults = [
        ("shifted-samples", "near-tie", "near-tie", Standing::Outside),
        ("bottom-right-rule", "near-tie", "near-tie", Standing::Outside),
        ("draws-twice", "uniform", "uniform", Standing::Outside),
        ("no-perspective", "w-100", "values", Standing::Outside),
        ("shifted-masks", "half-integer", "samples4", Standing::Outside),
    ];
    for engine in devices() {
        for (plant, family, property, expected) in faults {
            let stand = judged(&format!("{engine}+{plant}"), &options(64, &[family]));
            let text = said(&stand);
            assert_eq!(class(&stand, property), expected, "{plant}: {text}");
            assert!(!stand.agrees());
            is_as_its_schema_says(&stand);
            let failure = &stand.verdict.failures.iter().find(|f| f.evidence.shows(property));
            let failure = failure.unwrap_or_else(|| panic!("{plant}: {text}"));
            if property == family {
                assert!(failure.evidence.picture.is_some(), "{plant}: {text}");
                for part in ["shrunk)\n", "judged   expected\n", "repeat with: "] {
                    assert!(text.contains(part), "{part}: {text}");
                }
                let is_explained =
                    stand.verdict.more.recognised.is_some() || !stand.verdict.cause.is_empty();
                assert!(
                    is_explained && (text.contains("it draws as") || text.contains("cause")),
                    "{text}"
                );
                // Shrunk: a fault of the sample is seen on few pixels.
                assert_eq!(failure.case.triangles().len(), 1);
            }
        }
    }
}

/// What is said of one answer is not true of the next: so it is said first, with both, and nothing is made smaller or explained.
#[test]
fn answers_that_change_are_shown() {
    for engine in devices() {
        let stand = judged(&format!("{engine}+forgets-at-times"), &options(64, &["uniform"]));
        let text = said(&stand);
        let verdict = &stand.verdict;
        assert!(!stand.agrees() && verdict.cause.is_empty(), "{text}");
        assert!(verdict.more.recognised.is_none(), "{text}");
        assert!(verdict.failures.iter().all(|f| f.evidence.changes), "{text}");
        for part in ["its answers change from one time to the next", ": first ", ", then "] {
            assert!(text.contains(part), "{part}: {text}");
        }
    }
}

#[test]
fn faults_of_stages_are_caught() {
    for engine in devices() {
        let bits = Gpu::named(&engine).unwrap().about().subpixel_bits;
        for (plant, names) in [
            ("coarse-depths", &["depths, 16 bits", "depths, f32"][..]),
            ("no-near-plane", &["near and far plane"]),
            ("shifted-samples", &["lines", "clipped, near", "near and far plane"]),
        ] {
            // Of 4 bits a shift by 1/16 px is a step, which rounding may explain there.
            if plant == "shifted-samples" && bits == 4 {
                continue;
            }
            let stand = judged(&format!("{engine}+{plant}"), &options(24, &["uniform"]));
            for name in names {
                let found = class(&stand, name);
                assert!(
                    [Standing::Outside, Standing::NotOffered].contains(&found),
                    "{plant}, {name}: {}",
                    said(&stand)
                );
            }
        }
    }
}

/// A device as a choice draws each triangle of a list as the oracle does, and wrongly with a fault.
#[test]
fn a_device_is_a_choice() {
    let bounds = PixelRect::window(200, 200);
    // Of 4 bits below the pixel, as every device has.
    let corner = |i: i32| [f64::from(i * 37 % 3200) / 16.0, f64::from(i * 1013 % 3200) / 16.0];
    let triangles: Vec<_> = (0..200)
        .map(|i| FreeCorners::new([corner(3 * i), corner(3 * i + 1), corner(3 * i + 2)]).unwrap())
        .collect();
    let right: Vec<u64> = triangles
        .iter()
        .map(|corners| {
            let mut pixels = 0;
            Oracle.cover_exact(corners, bounds, |s| pixels += u64::from(s.x0_px.abs_diff(s.x1_px)));
            pixels
        })
        .collect();
    for engine in devices() {
        let drawn = |plant: &str| {
            let mut choice = OnLadder::new(&format!("{engine}{plant}")).unwrap();
            choice.pass(&triangles, bounds).unwrap()();
            let spans = choice.spans(&triangles, bounds).unwrap();
            let pixels = |list: &Vec<Span>| -> u64 {
                list.iter().map(|s| u64::from(s.x0_px.abs_diff(s.x1_px))).sum()
            };
            spans.iter().map(pixels).collect::<Vec<_>>()
        };
        let wrong = |drawn: &[u64]| drawn.iter().zip(&right).filter(|(a, b)| a != b).count();
        if is_known_right(Gpu::named(&engine).unwrap().about()) {
            assert_eq!(wrong(&drawn("")), 0);
        }
        assert!(wrong(&drawn("+draws-twice")) > 100);
        assert!(wrong(&drawn("+shifted-samples")) > 20);
        let mut choice = OnLadder::new(&engine).unwrap();
        let far = FreeCorners::new([[0.0, 0.0], [1e6, 0.0], [0.0, 1.0]]).unwrap();
        let refused = choice.spans(&[far], bounds).unwrap_err();
        assert!(refused.contains("further than"), "{refused}");
    }
}

/// Of a fault that is known, cases are no news; other cases are, and so is that none fails any more.
#[test]
fn known_faults_are_no_news() {
    for engine in devices() {
        let about = Gpu::named(&engine).unwrap().about().clone();
        let line = |px2: u64| {
            let driver = about.words();
            let text =
                format!("{driver} | {} | huge | twice-area-px2 >= {px2} | lost", about.version);
            known::of(&known::parse(&text).unwrap(), &about)
        };
        let judged = |plant: &str, known: &[known::KnownFault]| {
            let gpu = Gpu::named(&format!("{engine}{plant}")).unwrap();
            let stand = campaign::judge_with(gpu, &options(96, &["huge"]), known, &|_| ());
            class(&stand, "huge")
        };
        assert_eq!(line(1).len(), 1);
        assert_eq!(judged("+loses-large", &[]), Standing::Outside);
        assert_eq!(judged("+loses-large", &line(1 << 23)), Standing::Known);
        // Some are larger than the file says: the others are news.
        assert_eq!(judged("+loses-large", &line(1 << 25)), Standing::Outside);
        if is_known_right(&about) {
            // So triangles of that size were judged, and are right.
            assert_eq!(judged("", &line(1 << 23)), Standing::Stale);
            assert_eq!(judged("", &[]), Standing::Equal);
        }
    }
}

/// A device that is lost, or short of memory, costs the answers in question and no more.
#[test]
fn a_failing_device_leaves_the_rest_of_the_verdict() {
    for engine in devices() {
        for (plant, words) in
            [("lost", "device lost while"), ("out-of-memory", "out of memory while")]
        {
            let stand = judged(&format!("{engine}+{plant}"), &options(16, &["uniform", "flat"]));
            let text = said(&stand);
            assert!(!stand.agrees());
            assert!(text.contains(words), "{text}");
            let lost = stand.findings.iter().filter(|f| f.class == Standing::NoAnswer).count();
            assert!((1..=4).contains(&lost), "{text}");
            let equal = stand.findings.iter().filter(|f| f.class == Standing::Equal).count();
            assert!(equal > 4, "{text}");
        }
    }
}

#[test]
fn what_is_not_there_is_said() {
    let Err(Error::NoLoader(why)) = find::list_by(Some(Path::new("no-such-loader.so"))) else {
        panic!("no such loader");
    };
    let text = Error::NoLoader(why).to_string();
    assert!(text.contains("no-such-loader.so") && text.contains("libvulkan1"), "{text}");
    for engine in devices().into_iter().take(1) {
        let wrong = |name: &str| Gpu::named(name).err().map(|e| e.to_string()).unwrap_or_default();
        assert!(wrong("vulkan:9999").contains(&engine), "{}", wrong("vulkan:9999"));
        assert!(wrong("vulkan:no such card").contains("VK_DRIVER_FILES"));
        let text = wrong(&format!("{engine}+nothing"));
        assert!(text.contains("shifted-samples"), "{text}");
    }
}

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/data").join(name)
}

fn records(name: &str) -> Vec<serde_json::Value> {
    let file = std::fs::File::open(data(name)).unwrap();
    let lines = BufReader::new(flate2::read::GzDecoder::new(file)).lines();
    lines.map(|line| serde_json::from_str(&line.unwrap()).unwrap()).collect()
}

fn ints(value: &serde_json::Value) -> Vec<i32> {
    value.as_array().unwrap().iter().map(|v| v.as_i64().unwrap() as i32).collect()
}

fn points(record: &serde_json::Value) -> Vec<SubpixelPoint> {
    let point = |v| {
        let p = ints(v);
        SubpixelPoint::new(p[0], p[1])
    };
    record["v"].as_array().unwrap().iter().map(point).collect()
}

/// What the oracle draws of a recorded triangle, with how often.
fn exact(record: &serde_json::Value) -> Vec<(Vec<i32>, u8)> {
    let points = points(record);
    let mut runs = Vec::new();
    let window = PixelRect::window(CELL_PX, CELL_PX);
    Oracle.cover([points[0], points[1], points[2]], window, |s| {
        runs.push((vec![s.y_px, s.x0_px, s.x1_px], 1));
    });
    runs
}

/// What was recorded of a driver, it still draws: coverage of single triangles, quads and fans.
#[test]
fn recordings_are_drawn_again() {
    for engine in devices() {
        let mut gpu = Gpu::named(&engine).unwrap();
        let about = gpu.about().clone();
        let driver = match (about.words(), about.version.as_str()) {
            (w, v) if w.contains("lavapipe") && v.contains("22.3.6") => "lavapipe",
            (w, "5.0.0") if w.contains("swiftshader") => "swiftshader",
            _ => {
                eprintln!("skipped: no recording of {}", text::device(&about));
                continue;
            }
        };
        let records = records(&format!("vulkan-coverage.{driver}.jsonl.gz"));
        let whole: Vec<_> = records.iter().filter(|r| r["clipped"] == 0).collect();
        let half = gpu.viewport_px() / 2.0;
        let (mut draws, mut alone) = (Vec::new(), Vec::new());
        for (cell, record) in whole.iter().enumerate() {
            let points = points(record);
            for corners in points.chunks_exact(3) {
                let corners = [corners[0], corners[1], corners[2]];
                let list = match hits_kind(twice_area_px2(&corners)) {
                    Kind::Alone => &mut alone,
                    _ => &mut draws,
                };
                list.push(draw_of(cell, plain(&corners, half), 2.0 * half));
            }
        }
        let lonely: Vec<usize> = alone.iter().map(|draw| draw.cell).collect();
        let pictures = gpu.draw(Kind::Hits, whole.len(), draws).unwrap();
        let alone = gpu.draw(Kind::Alone, whole.len(), alone).unwrap();
        let (mut checked, mut wrong) = (0, 0);
        for (cell, record) in whole.iter().enumerate() {
            let pictures = if lonely.contains(&cell) { &alone } else { &pictures };
            let rows = (0..CELL_PX).flat_map(|y| runs_of(y as i32, pictures.row(cell, y, CELL_PX)));
            let drawn: Vec<_> = rows.map(|(s, n)| (vec![s.y_px, s.x0_px, s.x1_px], n)).collect();
            let target: Vec<_> =
                record["runs"].as_array().unwrap().iter().map(|run| (ints(run), 1)).collect();
            assert_eq!(drawn, target, "{driver} draws {record} otherwise now");
            wrong += u32::from(drawn != exact(record));
            checked += 1;
        }
        assert!(checked > 600, "{checked}");
        // The known fault is one of them.
        eprintln!("{driver}: {wrong} of {checked} are not the oracle's");
    }
}

/// The SPIR-V is what glslang makes of the GLSL beside it.
#[test]
fn shaders_are_their_source() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/device/shaders");
    let there = Command::new("glslangValidator").arg("--version").output();
    if there.is_err() {
        eprintln!("skipped: no glslangValidator (Debian: glslang-tools)");
        return;
    }
    let out = Path::new(env!("CARGO_TARGET_TMPDIR")).join("shader.spv");
    let mut compared = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let source = entry.unwrap().path();
        let kept = source.with_extension(format!(
            "{}.spv",
            source.extension().and_then(|e| e.to_str()).unwrap_or_default()
        ));
        if source.extension().is_some_and(|e| e == "spv") {
            assert!(source.with_extension("").is_file(), "{} has no source", source.display());
            continue;
        }
        let made = Command::new("glslangValidator")
            .args(["-V", "--target-env", "vulkan1.0"])
            .arg(&source)
            .arg("-o")
            .arg(&out)
            .output()
            .unwrap();
        assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stdout));
        // The third word names the compiler and its version.
        let body = |path: &Path| {
            let bytes = std::fs::read(path).unwrap();
            [&bytes[..8], &bytes[12..]].concat()
        };
        assert_eq!(body(&out), body(&kept), "{}: compile it again", source.display());
        compared += 1;
    }
    assert_eq!(compared, 4);
}
