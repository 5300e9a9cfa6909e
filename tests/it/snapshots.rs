//! Every named case: its pixels as the catalogue says, by every engine; a snapshot as text, and for
//! the small ones one as a picture.
//!
//! One pass stores every snapshot that changed. `tests/differential.rs` has all of them drawn where the
//! table disagrees, so that plain `cargo test` shows what a wrong line does.
//!
//! A picture is compared by its decoded pixels. Where it differs, `cargo run -- review` shows old and new pixel by pixel.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

use glam::{DVec2, DVec3};
use image::{Rgb, RgbImage};
use insta::internals::SnapshotContents;
use insta::{Comparator, Settings, Snapshot};
#[path = "../common/next.rs"]
mod next;
use next::NEXT;
use rasterproof_core::contract::Interpolate;
use rasterproof_core::frame::{Coverage, Frame};
use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_core::raster::edge_function::EdgeFunction;
use rasterproof_core::raster::scanline::Scanline;
use rasterproof_core::triangle::{ScreenTriangle, ScreenVertex};
use rasterproof_faults::planted::TriangleMutant;
use rasterproof_registry::comparison::EnginesToJudge;
use rasterproof_registry::engines::{Engine, LineEngine};
use rasterproof_registry::named::{find, named};
use rasterproof_report::panels;
use rasterproof_report::picture;
use rasterproof_verify::cases::named::{Input, NamedCase};
use rasterproof_verify::cases::{Case, Shape};
use rasterproof_verify::comparison::{
    Tally, engine_coverage, line_coverage, oracle_coverage, oracle_hits, oracle_pixels_each,
};
use rasterproof_verify::judge::ascii;

/// Largest sheet of a case that is kept, and picture of anything else.
const MOST_BYTES: usize = 32 << 10;
const MOST_BYTES_OF_SCENES: usize = 320 * 1024;

/// Names another folder for the snapshots: the test of the review has one that it spoils.
pub const ELSEWHERE: &str = "RASTERPROOF_SNAPSHOTS";

/// Snapshots live at the top level, named after their case alone.
pub fn settings() -> Settings {
    let mut settings = Settings::clone_current();
    let usual = concat!(env!("CARGO_MANIFEST_DIR"), "/snapshots").into();
    settings.set_snapshot_path(std::env::var_os(ELSEWHERE).unwrap_or(usual));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings
}

/// Checks all of them, whatever comes of the first, and says what to do about those that changed.
pub fn each<T>(items: impl IntoIterator<Item = T>, check: impl Fn(T)) {
    let kept = |item| catch_unwind(AssertUnwindSafe(|| check(item))).err();
    let failed: Vec<_> = items.into_iter().filter_map(kept).collect();
    let said = |payload: &Box<dyn Any + Send>| {
        let text = payload.downcast_ref::<&str>().map(|text| (*text).to_owned());
        text.or_else(|| payload.downcast_ref::<String>().cloned()).unwrap_or_default()
    };
    let messages: Vec<_> = failed.iter().map(said).collect();
    // It says itself what is next.
    let count = failed.len();
    std::assert!(failed.is_empty(), "{}\n{count} of them fail.\n{NEXT}", messages.join("\n"));
}

pub fn check_words(name: &str, words: &str) {
    each([words], |words| settings().bind(|| insta::assert_snapshot!(name, words)));
}

fn judged(case: &Case) -> (Vec<(String, Coverage)>, Coverage) {
    let hits =
        EnginesToJudge::all().hits(case).into_iter().map(|(name, hits)| (name, hits.unwrap()));
    (hits.collect(), oracle_hits(case))
}

fn text(named: &NamedCase, case: &Case) -> String {
    let (engines, target) = judged(case);
    let mut out = format!("{}: {}\n\n", named.name, named.about);
    let blocks: Vec<_> = engines
        .iter()
        .map(|(name, hits)| (format!("{name}: {} px", hits.covered()), ascii::grid(hits, &target)))
        .chain([(format!("oracle: {} px", target.covered()), ascii::grid(&target, &target))])
        .collect();
    out.push_str(&ascii::side_by_side(&blocks, 100));
    out
}

/// The picture of a named case that is small enough for one.
fn has_picture(case: &Case) -> bool {
    case.window.width() <= 64 && case.window.height() <= 80
}

fn check_text(named: &NamedCase) {
    let text = match &named.input {
        Input::Drawn { case, .. } => text(named, case),
        Input::Refused(corners) => {
            let lines: Vec<String> = corners
                .iter()
                .flatten()
                .filter_map(|&[x, y]| {
                    Some(format!("({x:?}, {y:?}) {}", SubpixelPoint::from_px(x, y).err()?))
                })
                .collect();
            format!("{}: {}\n\n{}\n", named.name, named.about, lines.join("\n"))
        }
    };
    settings().bind(|| insta::assert_snapshot!(format!("{}-text", named.name), text));
}

#[test]
fn snapshots_of_named_cases() {
    let cases = named();
    let drawn =
        |named: &&NamedCase| matches!(&named.input, Input::Drawn { case, .. } if has_picture(case));
    let pictures: Vec<_> = cases.iter().filter(drawn).collect();
    assert!(pictures.len() > 20, "{} pictures", pictures.len());
    let both = cases.iter().map(|named| (named, false));
    each(both.chain(pictures.into_iter().map(|named| (named, true))), |(named, is_picture)| {
        let Input::Drawn { case, .. } = &named.input else { return check_text(named) };
        if !is_picture {
            return check_text(named);
        }
        let (engines, target) = judged(case);
        let hits: Vec<_> =
            engines.into_iter().map(|(name, hits)| (name.to_owned(), hits)).collect();
        let title = format!("{}: {}", named.name, named.about);
        check_sheet(named.name, &panels::of_case(&title, case, &hits, &target));
    });
}

#[test]
fn named_cases_are_as_catalogued() {
    let judged = EnginesToJudge::all();
    for named in named() {
        match &named.input {
            Input::Drawn { case, pixels } => {
                for ([actual, target], finding) in judged.judge_case(case) {
                    assert!(
                        !finding.is_wrong(),
                        "{}: {actual} against {target}: {}",
                        named.name,
                        finding.describe()
                    );
                }
                if !pixels.is_empty() {
                    assert_eq!(&oracle_pixels_each(case), pixels, "{}", named.name);
                }
            }
            Input::Refused(corners) => {
                for triangle in corners {
                    let refused =
                        triangle.iter().any(|&[x, y]| SubpixelPoint::from_px(x, y).is_err());
                    assert!(refused, "{}: {triangle:?} is accepted", named.name);
                }
            }
        }
    }
}

/// Of whole meshes each pixel is hit once. How many there are is in the snapshots.
#[test]
fn named_meshes_hit_each_pixel_once() {
    for name in "T1 T2 T3 T4 T5 T6 T7 T8 S1 S6 S9 L9 O4 O5".split(' ') {
        let Input::Drawn { case, .. } = find(name).unwrap().input else { panic!("{name}") };
        let is_once = |row: &[u8]| row.iter().all(|hits| *hits <= 1);
        assert!(judged(&case).1.rows().all(|(_, row)| is_once(row)), "{name}");
    }
}

pub fn check_picture(name: &str, image: &RgbImage) {
    check_png(name, picture::png(image), MOST_BYTES_OF_SCENES);
}

pub fn check_sheet(name: &str, sheet: &RgbImage) {
    check_png(name, picture::png(sheet), MOST_BYTES);
}

#[derive(Clone)]
struct ByPixels;

impl Comparator for ByPixels {
    fn matches(&self, reference: &Snapshot, test: &Snapshot) -> bool {
        let decode = |snapshot: &Snapshot| match snapshot.contents() {
            SnapshotContents::Binary(Some(bytes)) => {
                image::load_from_memory(bytes).ok().map(|i| i.to_rgb8())
            }
            _ => None,
        };
        let is_same = decode(reference).is_some_and(|old| decode(test) == Some(old));
        if !is_same {
            eprintln!(
                "a picture looks different: see how, and how to accept it: cargo run -- review"
            );
        }
        is_same
    }

    fn dyn_clone(&self) -> Box<dyn Comparator> {
        Box::new(self.clone())
    }
}

fn check_png(name: &str, png: Vec<u8>, most_bytes: usize) {
    assert!(png.len() <= most_bytes, "{name}: {} bytes", png.len());
    let mut settings = settings();
    settings.set_comparator(Box::new(ByPixels));
    settings.bind(|| insta::assert_binary_snapshot!(&format!("{name}.png"), png));
}

fn vertex<V>(x_px: f64, y_px: f64, w: f64, varying: V) -> ScreenVertex<V> {
    ScreenVertex::new(x_px, y_px, 0.0, w, varying).unwrap()
}

/// A square of the picture for each pixel.
fn zoomed(width: u32, height: u32, zoom: u32) -> RgbImage {
    picture::plain(width * zoom, height * zoom, Rgb([250, 250, 247]))
}

fn square(image: &mut RgbImage, x_px: u32, y_px: u32, zoom: u32, colour: Rgb<u8>) {
    let side = if zoom > 4 { zoom - 1 } else { zoom };
    for y in 0..side {
        for x in 0..side {
            image.put_pixel(x_px * zoom + x, y_px * zoom + y, colour);
        }
    }
}

/// For chapter 3: red, green and blue corners, every pixel in its interpolated colour.
#[test]
fn picture_of_barycentric_interpolation() {
    let vertices = [
        vertex(2.0, 1.0, 1.0, DVec3::X),
        vertex(28.5, 6.0, 1.0, DVec3::Y),
        vertex(8.0, 30.0, 1.0, DVec3::Z),
    ];
    let mut image = zoomed(30, 31, 8);
    Scanline.fragments(&ScreenTriangle { vertices }, PixelRect::window(30, 31), |f| {
        let colour = Rgb((f.varying * 255.0).round().to_array().map(|c| c as u8));
        square(&mut image, f.x_px as u32, f.y_px as u32, 8, colour);
    });
    check_sheet("barycentric", &image);
}

/// For chapter 5: a receding square, perspective-correct, affine, and the size of the difference
/// (white is the bound of 1/3, attained at w = 1 to 4).
#[test]
fn picture_of_the_affine_error() {
    let corners = [
        (8.0, 88.0, 1.0, 0.0, 0.0),
        (88.0, 88.0, 1.0, 1.0, 0.0),
        (58.0, 8.0, 4.0, 1.0, 1.0),
        (38.0, 8.0, 4.0, 0.0, 1.0),
    ];
    let uv = |affine: bool| {
        let mut frame = Frame::new(PixelRect::window(96, 96), None);
        for split in [[0, 1, 2], [0, 2, 3]] {
            let vertices = split.map(|i| {
                let (x, y, w, u, v) = corners[i];
                vertex(x, y, if affine { 1.0 } else { w }, DVec2::new(u, v))
            });
            EdgeFunction.fragments(&ScreenTriangle { vertices }, frame.bounds(), |f| {
                frame.span_mut(f.y_px, f.x_px, f.x_px + 1)[0] = Some(f.varying);
            });
        }
        frame
    };
    let (right, wrong) = (uv(false), uv(true));
    let mut image = zoomed(96 * 3 + 8, 96, 3);
    let mut worst: f64 = 0.0;
    for y in 0..96 {
        for x in 0..96 {
            let (Some(a), Some(b)) = (right.get(x, y).flatten(), wrong.get(x, y).flatten()) else {
                continue;
            };
            let chequer = |uv: DVec2| {
                let cell = (uv * 8.0).floor();
                if (cell.x + cell.y) % 2.0 == 0.0 {
                    Rgb([60, 90, 140])
                } else {
                    Rgb([230, 225, 210])
                }
            };
            let error = (a - b).abs().max_element();
            worst = worst.max(error);
            let heat = (error * 3.0 * 255.0).round().min(255.0) as u8;
            let (x, y) = (x as u32, y as u32);
            square(&mut image, x, y, 3, chequer(a));
            square(&mut image, x + 100, y, 3, chequer(b));
            square(&mut image, x + 200, y, 3, Rgb([heat, heat / 2, 40]));
        }
    }
    // (sqrt 4 - 1) / (sqrt 4 + 1) = 1/3 bounds the error, and the edges come close to it.
    assert!(worst <= 1.0 / 3.0 && worst > 0.32, "{worst}");
    check_sheet("affine-error", &image);
}

/// For the README: a closed fan by the strict rule (holes), by the inclusive one (twice), by both
/// engines and by the oracle.
#[test]
fn picture_of_a_verdict() {
    let Input::Drawn { case, .. } = find("T6").unwrap().input else { panic!("T6 is drawn") };
    let Shape::Triangles { list, .. } = &case.shape else { panic!("T6 is a fan") };
    let engines = [
        ("strict edges", Engine::Mutant(TriangleMutant::ExclusiveEdges)),
        ("inclusive edges", Engine::Mutant(TriangleMutant::InclusiveEdges)),
        ("scanline", Engine::Scanline),
        ("edge function", Engine::EdgeFunction),
    ];
    let target = oracle_coverage(list, case.window);
    let hits = engines.map(|(name, engine)| {
        (name.to_owned(), engine_coverage(&engine, list, case.window).unwrap())
    });
    let wrong = hits.each_ref().map(|(_, hits)| Tally::between(hits, &target));
    assert!(wrong[0].missing > 0 && wrong[0].extra + wrong[0].twice == 0, "{wrong:?}");
    assert!(wrong[1].twice > 0 && wrong[1].missing == 0, "{wrong:?}");
    assert_eq!((wrong[2].total(), wrong[3].total()), (0, 0));
    let title =
        "A closed fan of twelve triangles: strict edges leave holes, inclusive ones draw twice";
    check_sheet("verdict", &panels::of_case(title, &case, &hits, &target));
}

/// For docs/stability.md: in each family the first case that the naive version gets visibly wrong,
/// naive on the left, the oracle on the right.
#[test]
fn pictures_of_naive_versions() {
    use rasterproof_faults::planted::LineMutant as L;
    use rasterproof_faults::planted::TriangleMutant as T;
    let triangles = [
        ("half-integer", T::ExclusiveEdges),
        ("rectangle", T::InclusiveEdges),
        ("sliver", T::RejectsThin),
        ("far", T::TruncatesTowardsZero),
        ("huge", T::WrapsInI32),
        ("flat", T::LastEdgeInclusive),
        ("near-vertical", T::SplitsAtRoundedPoint),
    ];
    each(triangles, |(family, mutant)| {
        naive(family, Engine::Mutant(mutant).name(), |case| {
            let Shape::Triangles { list, .. } = &case.shape else {
                panic!("{family} has triangles")
            };
            let hits = engine_coverage(&mutant, list, case.window).unwrap();
            (hits, oracle_coverage(list, case.window))
        });
    });
    let lines = [("line-ties", L::DirectedTies), ("line-octants", L::DriftsInF32)];
    each(lines, |(family, mutant)| {
        naive(family, LineEngine::Mutant(mutant).name(), |case| {
            let Shape::Lines(lines) = &case.shape else { panic!("{family} has lines") };
            let hits = line_coverage(&mutant, lines, case.window).unwrap();
            (hits, line_coverage(&LineEngine::Oracle, lines, case.window).unwrap())
        });
    });
}

/// A check that fails does not keep the next one from running, and the message leads on.
#[test]
fn each_check_runs_and_the_message_leads_on() {
    let run = std::cell::Cell::new(0);
    let checked = catch_unwind(AssertUnwindSafe(|| {
        each([1, 2, 3], |n| {
            run.set(run.get() + 1);
            assert_eq!(n, 2, "planted");
        });
    }));
    let message = *checked.unwrap_err().downcast::<String>().unwrap();
    assert_eq!(run.get(), 3);
    assert!(message.contains("2 of them fail") && message.contains(NEXT), "{message}");
}

fn naive(family: &str, mutant: &str, draw: impl Fn(&Case) -> (Coverage, Coverage)) {
    let family = rasterproof_verify::cases::families().find(|f| f.name == family).unwrap();
    // The case with the most wrong pixels among the first few hundred.
    let worst = (0..400)
        .map(|index| family.case(1, index))
        .max_by_key(|case| {
            let (hits, target) = draw(case);
            Tally::between(&hits, &target).total()
        })
        .unwrap();
    let (hits, target) = draw(&worst);
    assert!(Tally::between(&hits, &target).total() > 0, "{mutant} is right about {}", family.name);
    let title = format!("{}: {}", family.name, family.about);
    let sheet = panels::of_case(&title, &worst, &[(mutant.to_owned(), hits)], &target);
    check_sheet(&format!("naive-{}", family.name), &sheet);
}
