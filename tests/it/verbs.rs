//! The starters draw what is optional, where a function is written for it.

use std::fs;
use std::process::Command;

use crate::program::{Folder, has};

/// In each starter a function is written in the stead of what it lacks: by twice the area beside the segment, and along it.
const WIDE_IN_STARTERS: [(&str, &str, &str, &str); 3] = [
    (
        "py",
        "python3",
        "values = samples = depth = clip = clip_attributes = wide_line = area = formula = None",
        "
values = samples = depth = clip = clip_attributes = area = formula = None
def wide_line(x0, y0, x1, y1, line_width, width, height, set_pixel):
    dx, dy = x1 - x0, y1 - y0
    for y in range(height):
        for x in range(width):
            sx, sy = x + 0.5 - x0, y + 0.5 - y0
            beside, along, length = dx * sy - dy * sx, dx * sx + dy * sy, dx * dx + dy * dy
            if length and 4 * beside * beside <= line_width * line_width * length and 0 <= along <= length:
                set_pixel(x, y)
",
    ),
    (
        "cpp",
        "c++",
        "static const rasterproof_wide_line wide_line = nullptr;",
        "
static void wide_line(double x0, double y0, double x1, double y1, double line_width, int width, int height,
                      rasterproof_set_pixel set_pixel) {
    const double dx = x1 - x0, dy = y1 - y0, length = dx * dx + dy * dy;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            const double sx = x + 0.5 - x0, sy = y + 0.5 - y0, beside = dx * sy - dy * sx, along = dx * sx + dy * sy;
            if (length > 0 && 4 * beside * beside <= line_width * line_width * length && 0 <= along && along <= length)
                set_pixel(x, y);
        }
}
",
    ),
    (
        "rs",
        "rustc",
        "const WIDE_LINE: Option<WideLine> = None;",
        "
const WIDE_LINE: Option<WideLine> = Some(wide_line);
fn wide_line([a, b]: [(f64, f64); 2], line_width: f64, width: i32, height: i32, set_pixel: &mut dyn FnMut(i32, i32)) {
    let (dx, dy) = (b.0 - a.0, b.1 - a.1);
    let length = dx * dx + dy * dy;
    for (y, x) in (0..height).flat_map(|y| (0..width).map(move |x| (y, x))) {
        let (sx, sy) = (f64::from(x) + 0.5 - a.0, f64::from(y) + 0.5 - a.1);
        let (beside, along) = (dx * sy - dy * sx, dx * sx + dy * sy);
        if length > 0.0 && 4.0 * beside * beside <= line_width * line_width * length && (0.0..=length).contains(&along) {
            set_pixel(x, y);
        }
    }
}
",
    ),
];

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn starters_draw_wide_lines() {
    let mut judged = 0;
    for (ending, tool, place, body) in WIDE_IN_STARTERS.into_iter().filter(|of| has(of.1)) {
        let folder = Folder::new(&format!("verbs-{ending}"));
        let adapters = concat!(env!("CARGO_MANIFEST_DIR"), "/adapters");
        let text = fs::read_to_string(format!("{adapters}/starter.{ending}")).unwrap();
        assert!(text.contains(place), "{ending}");
        let text = text
            .replace(place, body.trim_start())
            .replace("\"batch=64", "\"rule=inclusive range=4096 batch=64");
        folder.put(&format!("starter.{ending}"), &text);
        fs::copy(format!("{adapters}/rasterproof.h"), folder.join("rasterproof.h")).unwrap();
        let built = match tool {
            "python3" => true,
            "c++" => Command::new("c++")
                .args(["-O2", "starter.cpp", "-o", "mine"])
                .current_dir(&*folder)
                .status()
                .unwrap()
                .success(),
            _ => Command::new("rustc")
                .args(["-O", "--edition", "2024", "starter.rs", "-o", "mine"])
                .current_dir(&*folder)
                .status()
                .unwrap()
                .success(),
        };
        assert!(built, "{ending}");
        let command =
            if tool == "python3" { vec!["python3", "starter.py"] } else { vec!["./mine"] };
        let words: Vec<&str> = [
            "judge",
            "--cases",
            "300",
            "--family",
            "wide-line",
            "--family",
            "wide-line-design",
            "--",
        ]
        .into_iter()
        .chain(command)
        .collect();
        folder.check(words, 0).prints("wide-line-design");
        judged += 1;
    }
    assert!(judged > 0);
}
