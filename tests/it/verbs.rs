//! The starters draw what is optional, where a function is written for it.

use std::fs;
use std::process::Command;

use crate::program::{Folder, has};

/// A function that is written in the stead of what a starter lacks.
struct Written {
    /// The ending of the starter's name, and the tool that builds or runs it.
    ending: &'static str,
    tool: &'static str,
    /// What stands in the starter, and what comes in its place.
    place: &'static str,
    body: &'static str,
}

/// The functions for a verb in all starters, the words by which they are declared, and the families by which they are judged.
struct Verb {
    written: [Written; 3],
    declares: &'static str,
    families: [&'static str; 2],
}

/// By twice the area beside the segment, and along it.
const WIDE_LINES: Verb = Verb {
    declares: "rule=inclusive range=4096 batch=64",
    families: ["wide-line", "wide-line-design"],
    written: [
        Written {
            ending: "py",
            tool: "python3",
            place: "values = samples = depth = clip = clip_attributes = wide_line = area = sample_values = formula = None",
            body: "
values = samples = depth = clip = clip_attributes = area = sample_values = formula = None
def wide_line(x0, y0, x1, y1, line_width, width, height, set_pixel):
    dx, dy = x1 - x0, y1 - y0
    for y in range(height):
        for x in range(width):
            sx, sy = x + 0.5 - x0, y + 0.5 - y0
            beside, along, length = dx * sy - dy * sx, dx * sx + dy * sy, dx * dx + dy * dy
            if length and 4 * beside * beside <= line_width * line_width * length and 0 <= along <= length:
                set_pixel(x, y)
",
        },
        Written {
            ending: "cpp",
            tool: "c++",
            place: "static const rasterproof_wide_line wide_line = nullptr;",
            body: "
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
        },
        Written {
            ending: "rs",
            tool: "rustc",
            place: "const WIDE_LINE: Option<WideLine> = None;",
            body: "
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
        },
    ],
};

/// Each covered sample with the values of its own place, by edge functions.
const SAMPLE_VALUES: Verb = Verb {
    declares: "values-at=sample range=4096 batch=64",
    families: ["w-4", "sample-value-design"],
    written: [
        Written {
            ending: "py",
            tool: "python3",
            place: "values = samples = depth = clip = clip_attributes = wide_line = area = sample_values = formula = None",
            body: "
values = samples = depth = clip = clip_attributes = wide_line = area = formula = None
def sample_values(corners, width, height, set_samples):
    def side(a, b, x, y):
        return (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])
    area = side(corners[0], corners[1], *corners[2][:2])
    if area == 0:
        return
    for y in range(height):
        for x in range(width):
            for s, (i, j) in enumerate(((6, 2), (14, 6), (2, 10), (10, 14))):
                parts = []
                for k in range(3):
                    a, b = corners[(k + 1) % 3], corners[(k + 2) % 3]
                    part = side(a, b, x + i / 16, y + j / 16) / area
                    dx, dy = (b[0] - a[0], b[1] - a[1]) if area > 0 else (a[0] - b[0], a[1] - b[1])
                    if part < 0 or (part == 0 and not (dy < 0 or (dy == 0 and dx > 0))):
                        break
                    parts.append(part)
                else:
                    over = [part / corner[3] for part, corner in zip(parts, corners)]
                    mixed = lambda n: sum(w * corner[n] for w, corner in zip(over, corners)) / sum(over)
                    set_samples(x, y, 1 << s, sum(p * c[2] for p, c in zip(parts, corners)), mixed(4), mixed(5))
",
        },
        Written {
            ending: "cpp",
            tool: "c++",
            place: "static const rasterproof_sample_values sample_values = nullptr;",
            body: "
static void sample_values(const rasterproof_corner corners[3], int width, int height, rasterproof_set_sampled set_samples) {
    static const int places[4][2] = {{6, 2}, {14, 6}, {2, 10}, {10, 14}};
    const auto side = [](const rasterproof_corner &a, const rasterproof_corner &b, double x, double y) {
        return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
    };
    const double area = side(corners[0], corners[1], corners[2].x, corners[2].y);
    if (area == 0) return;
    for (int at = 0; at < 4 * width * height; at++) {
        const int x = at / 4 % width, y = at / 4 / width, s = at % 4;
        double z = 0, a = 0, b = 0, over_w = 0;
        bool is_inside = true;
        for (int k = 0; k < 3 && is_inside; k++) {
            const rasterproof_corner &v = corners[k], &p = corners[(k + 1) % 3], &q = corners[(k + 2) % 3];
            const double part = side(p, q, x + places[s][0] / 16.0, y + places[s][1] / 16.0) / area;
            const double dx = area > 0 ? q.x - p.x : p.x - q.x, dy = area > 0 ? q.y - p.y : p.y - q.y;
            is_inside = part > 0 || (part == 0 && (dy < 0 || (dy == 0 && dx > 0)));
            z += part * v.z, a += part / v.w * v.a, b += part / v.w * v.b, over_w += part / v.w;
        }
        if (is_inside) set_samples(x, y, 1 << s, z, a / over_w, b / over_w);
    }
}
",
        },
        Written {
            ending: "rs",
            tool: "rustc",
            place: "const SAMPLE_VALUES: Option<SampleValues> = None;",
            body: "
const SAMPLE_VALUES: Option<SampleValues> = Some(sample_values);
fn sample_values(corners: [[f64; 6]; 3], width: i32, height: i32, set_samples: &mut dyn FnMut(i32, i32, u8, [f64; 3])) {
    let side = |a: [f64; 6], b: [f64; 6], x: f64, y: f64| (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
    let area = side(corners[0], corners[1], corners[2][0], corners[2][1]);
    let places = [(6.0, 2.0), (14.0, 6.0), (2.0, 10.0), (10.0, 14.0)];
    for (y, x, s) in (0..height).flat_map(|y| (0..width).flat_map(move |x| (0..4).map(move |s| (y, x, s)))) {
        let (px, py) = (f64::from(x) + places[s].0 / 16.0, f64::from(y) + places[s].1 / 16.0);
        let (mut sums, mut is_inside) = ([0.0; 4], area != 0.0);
        for k in 0..3 {
            let (v, p, q) = (corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3]);
            let part = side(p, q, px, py) / area;
            let (dx, dy) = ((q[0] - p[0]) * area, (q[1] - p[1]) * area);
            is_inside = is_inside && (part > 0.0 || (part == 0.0 && (dy < 0.0 || (dy == 0.0 && dx > 0.0))));
            let over = part / v[3];
            for (sum, more) in sums.iter_mut().zip([part * v[2], over * v[4], over * v[5], over]) {
                *sum += more;
            }
        }
        if is_inside {
            let [z, a, b, over_w] = sums;
            set_samples(x, y, 1 << s, [z, a / over_w, b / over_w]);
        }
    }
}
",
        },
    ],
};

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn starters_draw_wide_lines() {
    judge_starters(&WIDE_LINES);
}

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn starters_give_samples_values() {
    judge_starters(&SAMPLE_VALUES);
}

/// Judges every starter whose tool is there, through a pipe.
fn judge_starters(Verb { written, declares, families }: &Verb) {
    let mut judged = 0;
    for Written { ending, tool, place, body } in written.iter().filter(|of| has(of.tool)) {
        let folder = Folder::new(&format!("verbs-{}-{ending}", families[0]));
        let adapters = concat!(env!("CARGO_MANIFEST_DIR"), "/adapters");
        let text = fs::read_to_string(format!("{adapters}/starter.{ending}")).unwrap();
        assert!(text.contains(place), "{ending}");
        let text = text.replace(place, body.trim_start());
        let text = text.replace("\"batch=64", &format!("\"{declares}"));
        folder.put(&format!("starter.{ending}"), &text);
        fs::copy(format!("{adapters}/rasterproof.h"), folder.join("rasterproof.h")).unwrap();
        let build: &[&str] = match *tool {
            "python3" => &[],
            "c++" => &["-O2", "starter.cpp", "-o", "mine"],
            _ => &["-O", "--edition", "2024", "starter.rs", "-o", "mine"],
        };
        let is_built = build.is_empty()
            || Command::new(tool).args(build).current_dir(&*folder).status().unwrap().success();
        assert!(is_built, "{ending}");
        let mut words = vec!["judge", "--cases", "300"];
        families.iter().for_each(|family| words.extend(["--family", family]));
        words.push("--");
        match *tool {
            "python3" => words.extend(["python3", "starter.py"]),
            _ => words.push("./mine"),
        }
        folder.check(words, 0).prints(" cases, all right");
        judged += 1;
    }
    assert!(judged > 0);
}
