//! The tests that `judge --write-test` writes run in four languages, fail with the program that was judged and pass with one that is
//! mended. A language whose tool is missing is skipped.

use std::process::{Command, Stdio};

use crate::program::{Folder, PROGRAM, Run};

/// How tests of a language are written and run.
struct Language {
    ending: &'static str,
    /// What stands in the place of the two functions that are to be filled in.
    bodies: [(&'static str, &'static str); 2],
    /// Yes and no.
    words: [&'static str; 2],
    /// Builds a file into `tests`, where it is built.
    build: &'static [&'static str],
    /// Runs the file, or what was built of it.
    run: &'static [&'static str],
}

/// Runs every function `test_...` of a file, as pytest does.
const EACH: &str = "import runpy, sys\nfailed = 0\nfor name, test in runpy.run_path(sys.argv[1]).items():\n    \
                    if name.startswith('test_'):\n        try:\n            test()\n        except Exception as error:\n            \
                    failed += 1\n            print(name, error)\nsys.exit(failed > 0)";

/// In each body, `MENDED` is whether the starter's mistake is repaired: of triangles that every edge belongs to them, of lines that a
/// tie goes to the larger coordinate.
const LANGUAGES: [Language; 5] = [
    Language {
        ending: "py",
        bodies: [
            (
                "    raise NotImplementedError(\"fill in triangle()\")",
                "    if (x1 - x0) * (y2 - y0) - (y1 - y0) * (x2 - x0) < 0:
        x1, y1, x2, y2 = x2, y2, x1, y1

    def holds(ax, ay, bx, by, x, y):
        e = (bx - ax) * (y - ay) - (by - ay) * (x - ax)
        return e > 0 or (e == 0 and (not MENDED or by < ay or (by == ay and bx > ax)))

    for y in range(height):
        for x in range(width):
            edges = ((x0, y0, x1, y1), (x1, y1, x2, y2), (x2, y2, x0, y0))
            if all(holds(*edge, x + 0.5, y + 0.5) for edge in edges):
                set_pixel(x, y)",
            ),
            (
                "    raise NotImplementedError(\"fill in line()\")",
                "    steep = abs(y1 - y0) > abs(x1 - x0)
    (u0, v0), (u1, v1) = ((y0, x0), (y1, x1)) if steep else ((x0, y0), (x1, y1))
    if MENDED and u1 < u0:
        points = [(u, v1 + (v0 - v1) * (u - u1) / (u0 - u1)) for u in range(u0, u1 - 1, -1)]
        rises = v0 > v1
    else:
        step = 1 if u1 >= u0 else -1
        points = [(u, v0 + (v1 - v0) * (u - u0) / ((u1 - u0) or 1)) for u in range(u0, u1 + step, step)]
        rises = v1 > v0
    for u, v in points:
        v = int((v + 0.5) // 1) if rises or not MENDED else -int((-v + 0.5) // 1)
        set_pixel(*((v, u) if steep else (u, v)))",
            ),
        ],
        words: ["True", "False"],
        build: &[],
        run: &["python3", "-B", "-c", EACH, "FILE"],
    },
    Language { ending: "js", ..JAVASCRIPT },
    JAVASCRIPT,
    Language {
        ending: "rs",
        bodies: [
            (
                "    todo!(\"fill in triangle()\")",
                "    let [a, mut b, mut c] = corners;
    let e = |a: (f64, f64), b: (f64, f64), p: (f64, f64)| (b.0 - a.0) * (p.1 - a.1) - (b.1 - a.1) * (p.0 - a.0);
    if e(a, b, c) < 0.0 {
        std::mem::swap(&mut b, &mut c);
    }
    for y in 0..height {
        for x in 0..width {
            let p = (f64::from(x) + 0.5, f64::from(y) + 0.5);
            let holds = |(a, b): ((f64, f64), (f64, f64))| {
                let owns = !MENDED || b.1 < a.1 || (b.1 == a.1 && b.0 > a.0);
                e(a, b, p) > 0.0 || (e(a, b, p) == 0.0 && owns)
            };
            if [(a, b), (b, c), (c, a)].into_iter().all(holds) {
                set_pixel(x, y);
            }
        }
    }",
            ),
            (
                "    todo!(\"fill in line()\")",
                "    let steep = (to.1 - from.1).abs() > (to.0 - from.0).abs();
    let turned = |(x, y): (i32, i32)| if steep { (y, x) } else { (x, y) };
    let ((u0, v0), (u1, v1)) = (turned(from), turned(to));
    let du = (u1 - u0).abs().max(1);
    let is_turned = MENDED && u1 < u0;
    let rises = if is_turned { v0 > v1 } else { v1 > v0 };
    for i in 0..=(u1 - u0).abs() {
        let v = f64::from(v0) + f64::from((v1 - v0) * i) / f64::from(du);
        let v = if rises || !MENDED { (v + 0.5).floor() } else { (v - 0.5).ceil() };
        let (x, y) = turned((u0 + i * (u1 - u0).signum(), v as i32));
        set_pixel(x, y);
    }",
            ),
        ],
        words: ["true", "false"],
        build: &["rustc", "--edition", "2021", "--test", "FILE", "-o", "tests"],
        run: &["./tests"],
    },
    Language {
        ending: "c",
        bodies: [
            (
                "    fputs(\"fill in triangle()\\n\", stderr);\n    exit(2);",
                "    double p[3][2] = {{x0, y0}, {x1, y1}, {x2, y2}};
    int x, y, i, is_inside;
    if ((x1 - x0) * (y2 - y0) - (y1 - y0) * (x2 - x0) < 0) {
        p[1][0] = x2, p[1][1] = y2, p[2][0] = x1, p[2][1] = y1;
    }
    for (y = 0; y < height; y++)
        for (x = 0; x < width; x++) {
            for (i = 0, is_inside = 1; i < 3; i++) {
                const double *a = p[i], *b = p[(i + 1) % 3];
                double e = (b[0] - a[0]) * (y + 0.5 - a[1]) - (b[1] - a[1]) * (x + 0.5 - a[0]);
                int owns = !MENDED || b[1] < a[1] || (b[1] == a[1] && b[0] > a[0]);
                is_inside = is_inside && (e > 0 || (e == 0 && owns));
            }
            if (is_inside) set_pixel(x, y);
        }",
            ),
            (
                "    fputs(\"fill in line()\\n\", stderr);\n    exit(2);",
                "    int steep = abs(y1 - y0) > abs(x1 - x0);
    int u0 = steep ? y0 : x0, v0 = steep ? x0 : y0, u1 = steep ? y1 : x1, v1 = steep ? x1 : y1;
    int du = abs(u1 - u0), dv = abs(v1 - v0), rises = MENDED && u1 < u0 ? v0 > v1 : v1 > v0, i;
    /* Which way a tie goes, seen along v from the first end. */
    int up = rises || !MENDED, away = v1 >= v0 ? up : !up;
    for (i = 0; i <= du; i++) {
        int s = du ? (2 * dv * i + du - !away) / (2 * du) : 0;
        int u = u0 + (u1 >= u0 ? i : -i), v = v0 + (v1 >= v0 ? s : -s);
        set_pixel(steep ? v : u, steep ? u : v);
    }",
            ),
        ],
        words: ["1", "0"],
        build: &["cc", "-std=c99", "-Wall", "-pedantic", "-Werror", "FILE", "-o", "tests"],
        run: &["./tests"],
    },
];

const JAVASCRIPT: Language = Language {
    ending: "mjs",
    bodies: [
        (
            "  throw new Error('fill in triangle()');",
            "  const e = ([ax, ay], [bx, by], [x, y]) => (bx - ax) * (y - ay) - (by - ay) * (x - ax);
  const p = [[x0, y0], [x1, y1], [x2, y2]];
  if (e(...p) < 0) p.reverse();
  const holds = (a, b, at) => {
    const owns = !MENDED || b[1] < a[1] || (b[1] === a[1] && b[0] > a[0]);
    return e(a, b, at) > 0 || (e(a, b, at) === 0 && owns);
  };
  for (let y = 0; y < height; y++) {
    for (let x = 0; x < width; x++) {
      if ([0, 1, 2].every((i) => holds(p[i], p[(i + 1) % 3], [x + 0.5, y + 0.5]))) setPixel(x, y);
    }
  }",
        ),
        (
            "  throw new Error('fill in line()');",
            "  const steep = Math.abs(y1 - y0) > Math.abs(x1 - x0);
  const [u0, v0, u1, v1] = steep ? [y0, x0, y1, x1] : [x0, y0, x1, y1];
  const rises = MENDED && u1 < u0 ? v0 > v1 : v1 > v0;
  const du = Math.abs(u1 - u0);
  for (let i = 0; i <= du; i++) {
    const exact = v0 + ((v1 - v0) * i) / (du || 1);
    const v = rises || !MENDED ? Math.floor(exact + 0.5) : Math.ceil(exact - 0.5);
    const u = u0 + i * Math.sign(u1 - u0);
    setPixel(steep ? v : u, steep ? u : v);
  }",
        ),
    ],
    words: ["true", "false"],
    build: &[],
    run: &["node", "--test", "FILE"],
};

fn has(tool: &str) -> bool {
    let mut command = Command::new(tool);
    let quiet = command.arg("--version").stdout(Stdio::null()).stderr(Stdio::null());
    quiet.status().is_ok_and(|status| status.success())
}

fn run(folder: &Folder, words: &[&str], file: &str) -> Run {
    let words: Vec<&str> =
        words.iter().map(|word| word.replace("FILE", file).leak() as &str).collect();
    let (name, arguments) = words.split_first().unwrap();
    let mut command =
        if name.starts_with("./") { Command::new(folder.join(name)) } else { Command::new(name) };
    Run::of(command.args(arguments).current_dir(folder).env_remove("NODE_TEST_CONTEXT"))
}

/// Builds and runs a text; the tests' result.
fn result(folder: &Folder, language: &Language, text: &str) -> Run {
    let file = format!("filled.{}", language.ending);
    folder.put(&file, text);
    if !language.build.is_empty() {
        run(folder, language.build, &file).has(0);
    }
    run(folder, language.run, &file)
}

/// The starter draws ties wrong, of triangles and of lines.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn written_tests_fail_with_the_wrong_program_and_pass_with_the_mended_one() {
    if !has("python3") {
        eprintln!("skipped: no python3");
        return;
    }
    let folder = Folder::new("written-test");
    folder.put("mine.py", include_str!("../../adapters/starter.py"));
    for language in &LANGUAGES {
        let Language { ending, bodies, words, build, run } = language;
        let tool = build.first().unwrap_or(&run[0]);
        if !has(tool) {
            eprintln!("skipped: no {tool}");
            continue;
        }
        let name = format!("mine_test.{ending}");
        let judge = "judge --cases 40 --family half-integer --family line-ties";
        let command = format!("{judge} --write-test {name} -- python3 -B mine.py");
        folder.check(&command, 1).says(&format!("2 tests in {}", name_of(ending)));
        let text = folder.text(&name);
        // A picture in a comment, and nothing of this project but its name.
        assert!(text.contains("drawn") && text.contains("(# agrees, - missing, + extra"), "{text}");
        // As it was written, it fails, and says what to do.
        let unfilled = result(&folder, language, &text);
        assert!(unfilled.status != Some(0), "{unfilled}");
        unfilled.shows("fill in triangle()");
        for (mended, word) in [(true, words[0]), (false, words[1])] {
            let mut filled = text.clone();
            for (stub, body) in bodies {
                assert!(filled.contains(stub), "{ending}: {stub}");
                filled = filled.replace(stub, &body.replace("MENDED", word));
            }
            let run = result(&folder, language, &filled);
            assert_eq!(run.status == Some(0), mended, "{ending}: {run}");
            // Wrong in both.
            for test in ["half_integer_", "line_ties_"] {
                assert!(mended || run.out.contains(test), "{ending}: {run}");
            }
        }
        // It is the user's from now on.
        let again = folder.check(&command, 2).without_output();
        again.says("exists, and may be edited by hand: give another name, or remove it");
        assert_eq!(folder.text(&name), text);
    }
}

fn name_of(ending: &str) -> &str {
    match ending {
        "py" => "Python (pytest)",
        "rs" => "Rust",
        "c" => "C99",
        _ => "JavaScript (node:test)",
    }
}

/// Values, samples and piles of triangles, exactly; `OWNS` is whether an edge has the samples on it.
const EXACT: [(&str, &str); 4] = [
    (
        "    raise NotImplementedError(\"fill in triangle()\")",
        "    for y in range(height):
        for x in range(width):
            if weights([(x0, y0), (x1, y1), (x2, y2)], x + 0.5, y + 0.5):
                set_pixel(x, y)",
    ),
    (
        "    raise NotImplementedError(\"fill in values()\")",
        "    for y in range(height):
        for x in range(width):
            found = weights(corners, x + 0.5, y + 0.5)
            if found:
                (_, _, z0, w0, a0, b0), (_, _, z1, w1, a1, b1), (_, _, z2, w2, a2, b2) = corners
                p, q, r = found
                over = [part / Fraction(w) for part, w in zip(found, (w0, w1, w2))]
                mixed = lambda *each: float(sum(part * Fraction(v) for part, v in zip(over, each)) / sum(over))
                z = p * Fraction(z0) + q * Fraction(z1) + r * Fraction(z2)
                set_pixel(x, y, float(z), mixed(a0, a1, a2), mixed(b0, b1, b2))",
    ),
    (
        "    raise NotImplementedError(\"fill in samples()\")",
        "    places = ((6, 2), (14, 6), (2, 10), (10, 14))
    for y in range(height):
        for x in range(width):
            corners = [(x0, y0), (x1, y1), (x2, y2)]
            hit = [bool(weights(corners, x + i / 16, y + j / 16)) << s for s, (i, j) in enumerate(places)]
            set_pixel(x, y, sum(hit))",
    ),
    (
        "    raise NotImplementedError(\"fill in depth()\")",
        "    for y in range(height):
        for x in range(width):
            seen = []
            for t, corners in enumerate(triangles):
                found = weights(corners, x + 0.5, y + 0.5)
                if found:
                    seen.append((sum(part * Fraction(z) for part, (_, _, z) in zip(found, corners)), t))
            if seen:
                set_pixel(x, y, min(seen)[1])",
    ),
];

/// The weights of the corners at a point, or nothing outside.
const WEIGHTS: &str = "
from fractions import Fraction

def weights(corners, x, y):
    p = [[Fraction(v) for v in corner[:2]] for corner in corners]
    x, y = Fraction(x), Fraction(y)
    e = lambda a, b: (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])
    area = (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0])
    if area == 0:
        return None
    found = []
    for i in range(3):
        a, b = p[(i + 1) % 3], p[(i + 2) % 3]
        if area < 0:
            a, b = b, a
        side = e(a, b)
        owns = OWNS and (b[1] < a[1] or (b[1] == a[1] and b[0] > a[0]))
        if side < 0 or (side == 0 and not owns):
            return None
        found.append(side / abs(area))
    return found
";

/// The same of values, samples and depths; the corners that clipping leaves are named as what is no test.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn every_kind_of_pixel_is_tested() {
    if !has("python3") {
        eprintln!("skipped: no python3");
        return;
    }
    let folder = Folder::new("written-test-kinds");
    let judge =
        "judge --cases 40 --family half-integer --family fan --family depth-order --family w-4";
    let command =
        |name: &str| format!("{judge} --write-test {name} -- {PROGRAM} engine exclusive-edges");
    folder.check(command("a_test.py"), 1);
    let text = folder.text("a_test.py");
    for (owns, passes) in [("True", true), ("False", false)] {
        let mut filled = WEIGHTS.replace("OWNS", owns) + &text;
        for (stub, body) in EXACT {
            assert!(filled.contains(stub), "{stub}: {text}");
            filled = filled.replace(stub, body);
        }
        let run = result(&folder, &LANGUAGES[0], &filled);
        assert_eq!(run.status == Some(0), passes, "{run}");
        if !passes {
            let count = text.matches("def test_").count();
            assert_eq!(run.out.lines().count(), count, "each test fails: {run}");
        }
    }
    // In the other languages the same cases compile.
    for language in &LANGUAGES[2..] {
        let tool = language.build.first().unwrap_or(&language.run[0]);
        if !has(tool) {
            eprintln!("skipped: no {tool}");
            continue;
        }
        let name = format!("a_test.{}", language.ending);
        folder.check(command(&name), 1);
        let run = result(&folder, language, &folder.text(&name));
        assert!(run.status != Some(0), "{run}");
        run.shows("fill in ");
    }
}
