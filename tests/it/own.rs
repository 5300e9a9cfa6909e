//! The program of the page 'Write your own': each stage is compiled from the files up to its own and
//! draws its picture, and the judge finds it right.

use std::fmt::Write as _;
use std::process::Command;

use image::RgbImage;
use rasterproof_core::contract::{DrawLine as _, Interpolate, Rasterize};
use rasterproof_core::grid::PixelRect;
use rasterproof_core::line::bresenham::Bresenham;
use rasterproof_core::triangle::{
    Corners, Fragment, LineEnd, PixelPoint, ScreenLine, ScreenTriangle, Span, Varying,
};
use rasterproof_verify::comparison::tolerance::{Bound, Tolerance};
use rasterproof_verify::comparison::{Options, judge_coverage, judge_values};

use crate::pages::{read, root};
use crate::program::{Folder, has};
use crate::snapshots::{check_picture, each};

/// A module for each stage, of its own file and of all those before it.
macro_rules! stages {
    ([$($file:literal)*]) => {};
    ([$($file:literal)*] $name:ident: $own:literal, $($rest:tt)*) => {
        #[allow(dead_code, reason = "later stages use what this one does not")]
        mod $name {
            $(include!(concat!("../../docs/own/", $file));)*
            include!(concat!("../../docs/own/", $own));
        }
        stages!([$($file)* $own] $($rest)*);
    };
}

stages! {
    []
    stage1: "01-pixels.rs",
    stage2a: "02a-lines.rs",
    stage2b: "02b-triangles.rs",
    stage2c: "02c-scanline.rs",
    stage3: "03-values.rs",
    stage4: "04-space.rs",
    stage5: "05-perspective.rs",
    stage6: "06-depth.rs",
    stage7: "07-clipping.rs",
    stage8: "08-window.rs",
    stage9: "09-pipeline.rs",
    stage10: "10-matrices.rs",
    stage11: "11-light.rs",
    stage12: "12-samples.rs",
    stage13: "13-levels.rs",
}

type DrawStage = fn() -> RgbImage;

#[test]
fn own_stages_draw_their_pictures() {
    let stages: [(&str, DrawStage); 15] = [
        ("1", stage1::stage1),
        ("2a", stage2a::stage2a),
        ("2b", stage2b::stage2b),
        // Another way to the same pixels.
        ("2b", stage2c::stage2c),
        ("3", stage3::stage3),
        ("4", stage4::stage4),
        ("5", stage5::stage5),
        ("6", stage6::stage6),
        ("7", stage7::stage7),
        ("8", stage8::stage8),
        ("9", stage9::stage9),
        ("10", stage10::stage10),
        ("11", stage11::stage11),
        ("12", stage12::stage12),
        ("13", stage13::stage13),
    ];
    each(stages, |(number, draw)| check_picture(&format!("own-{number}"), &draw()));
}

/// The stages that have files in Python and C++, too: their numbers, files and pictures. The course examines the others.
const IN_OTHER_LANGUAGES: [(&str, &str, DrawStage); 8] = [
    ("1", "01-pixels", stage1::stage1),
    ("4", "04-space", stage4::stage4),
    ("8", "08-window", stage8::stage8),
    ("9", "09-pipeline", stage9::stage9),
    ("10", "10-matrices", stage10::stage10),
    ("11", "11-light", stage11::stage11),
    ("12", "12-samples", stage12::stage12),
    ("13", "13-levels", stage13::stage13),
];

/// A program of the files of stages, put together as the page says: stage 1, the solution of the course, the other stages.
fn program_of_stages(ending: &str) -> String {
    let [first, others @ ..] =
        IN_OTHER_LANGUAGES.map(|(_, file, _)| read(format!("docs/own/{file}.{ending}")));
    let solution = read(format!("adapters/course/solution.{ending}"));
    format!("{first}\n{solution}\n{}", others.join("\n"))
}

/// The pixels of a stored picture of the usual size, three bytes each.
fn stored_pixels(folder: &Folder, number: &str) -> Vec<u8> {
    let stored = std::fs::read(folder.join(format!("{number}.ppm"))).unwrap();
    stored.strip_prefix(b"P6\n160 120\n255\n").expect("a picture of 160 x 120").to_vec()
}

/// Runs a program that stores the pictures of all stages in a folder, and compares them with those of Rust, pixel by pixel.
fn draws_as_in_rust(folder: &Folder, run: &mut Command) {
    let status = run.current_dir(&**folder).status().unwrap();
    assert!(status.success(), "{run:?}: {status}");
    for (number, _, draw) in IN_OTHER_LANGUAGES {
        let differ = stored_pixels(folder, number)
            .chunks(3)
            .zip(draw().pixels())
            .filter(|(other, rust)| *other != rust.0)
            .count();
        assert_eq!(differ, 0, "{run:?}: pixels of stage {number} that differ from Rust");
    }
}

#[test]
fn own_stages_draw_the_same_in_python() {
    if !has("python3") {
        return;
    }
    let folder = Folder::new("own-python");
    let mut program = program_of_stages("py");
    for (number, ..) in IN_OTHER_LANGUAGES {
        writeln!(program, "save(stage{number}(), '{number}.ppm')").unwrap();
    }
    folder.put("own.py", program);
    draws_as_in_rust(&folder, Command::new("python3").args(["-B", "own.py"]));
}

#[test]
fn own_stages_draw_the_same_in_cpp() {
    if !has("c++") {
        return;
    }
    let folder = Folder::new("own-cpp");
    let mut program = "#include \"rasterproof.h\"\n".to_owned() + &program_of_stages("cpp");
    program += "int main() {\n";
    for (number, ..) in IN_OTHER_LANGUAGES {
        writeln!(program, "stage{number}(); save(\"{number}.ppm\");").unwrap();
    }
    folder.put("own.cpp", program + "}\n");
    let mut build = Command::new("c++");
    build.args(["-std=c++11", "-O1", "-o", "own", "own.cpp", "-I"]).arg(root().join("adapters"));
    assert!(build.current_dir(&*folder).status().unwrap().success(), "{build:?}");
    draws_as_in_rust(&folder, &mut Command::new(folder.join("own")));
}

/// Every line of a grid, in both directions, is the one that the project's own drawers light.
#[test]
fn own_lines_are_right() {
    let places = || (0..12).flat_map(|x| (0..12).map(move |y| [x, y]));
    for (from, to) in places().flat_map(|from| places().map(move |to| (from, to))) {
        let end = |[x, y]: [i64; 2]| LineEnd {
            pixel: PixelPoint::new(x as i32, y as i32),
            depth: 0.0,
            varying: 0.0,
        };
        let (mut own, mut right) = (Vec::new(), Vec::new());
        stage2a::line(from, to, |x, y| own.push((x as i32, y as i32)));
        let line = ScreenLine { ends: [end(from), end(to)] };
        Bresenham.draw(&line, PixelRect::window(16, 16), |f| right.push((f.x_px, f.y_px)));
        own.sort_unstable();
        right.sort_unstable();
        assert_eq!(own, right, "from {from:?} to {to:?}");
    }
}

/// The triangles and values of stage 5, as the judge calls them.
struct Own;

fn window(bounds: PixelRect) -> [i64; 4] {
    [bounds.x0, bounds.y0, bounds.x1, bounds.y1].map(i64::from)
}

impl Rasterize for Own {
    fn cover(&self, corners: Corners, bounds: PixelRect, mut emit: impl FnMut(Span)) {
        let corners = corners.map(|corner| [corner.x, corner.y].map(i64::from));
        stage2b::cover(corners, window(bounds), |x, y, _| {
            emit(Span { y_px: y as i32, x0_px: x as i32, x1_px: x as i32 + 1 });
        });
    }
}

impl Interpolate for Own {
    fn fragments<V: Varying>(
        &self,
        triangle: &ScreenTriangle<V>,
        bounds: PixelRect,
        mut emit: impl FnMut(Fragment<V>),
    ) {
        let [a, b, c] = &triangle.vertices;
        let corners = [a, b, c].map(|v| [v.position.x, v.position.y].map(i64::from));
        stage5::cover(corners, window(bounds), |x, y, edges| {
            let weights = stage5::weights(edges);
            let [depth] = stage5::mix(weights, [[a.depth], [b.depth], [c.depth]]);
            let [u, v, w] = stage5::in_space(weights, [a, b, c].map(|v| 1.0 / v.inv_w));
            let varying = a.varying * u + b.varying * v + c.varying * w;
            emit(Fragment { x_px: x as i32, y_px: y as i32, depth, varying });
        });
    }
}

/// The triangles of stage 2c, as the judge calls them.
struct OwnRows;

impl Rasterize for OwnRows {
    fn cover(&self, corners: Corners, bounds: PixelRect, mut emit: impl FnMut(Span)) {
        let corners = corners.map(|corner| [corner.x, corner.y].map(i64::from));
        stage2c::rows(corners, window(bounds), |y, from, to| {
            emit(Span { y_px: y as i32, x0_px: from as i32, x1_px: to as i32 });
        });
    }
}

#[test]
fn own_triangles_are_right() {
    let options = Options::default().cases(300);
    let by_signs = judge_coverage(&Own, &options).unwrap();
    let by_rows = judge_coverage(&OwnRows, &options).unwrap();
    for verdict in [by_signs, by_rows] {
        assert!(verdict.agrees(), "{:?}", verdict.failures.first().map(ToString::to_string));
    }
}

/// In units of rounding, relative: an edge function 1, their sum 1, the quotient 1: 3 for a weight in the
/// window. 1/w has 1 and is divided by once more, 2, then the quotient, 1: 6. The sum of three 8, the
/// quotient of the two 15, the product with a value 16. The two additions round what is at most M.
const TOLERANCE: Tolerance =
    Tolerance { attribute: Bound { d: 0.0, m: 18.0 }, depth: Bound { d: 0.0, m: 6.0 } };

#[test]
fn own_values_are_right() {
    let options = Options::default().cases(100);
    let verdict = judge_values(&Own, TOLERANCE, &options).unwrap();
    assert!(verdict.agrees(), "{:?}", verdict.failures.first().map(ToString::to_string));
}
