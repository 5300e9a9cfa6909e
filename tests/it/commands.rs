//! The command line, through the program itself: exit codes, messages, determinism.

use std::process::{Command, Output};

use rasterproof_faults::planted::exact::ExactMutant;

fn command(words: &[&str]) -> Command {
    let folder = std::env::temp_dir().join(format!("rasterproof-commands-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    // Pictures go to the working folder's target/.
    let mut command = Command::new(env!("CARGO_BIN_EXE_rasterproof"));
    command.args(words).current_dir(folder).env_remove("COLUMNS");
    command
}

fn run(words: &[&str]) -> Output {
    command(words).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

fn check(words: &[&str], status: i32) -> (String, String) {
    let output = run(words);
    let (out, errors) = (text(&output.stdout), text(&output.stderr));
    assert_eq!(output.status.code(), Some(status), "{words:?}\n{out}\n{errors}");
    (out, errors)
}

#[test]
fn verify_agrees_and_says_how_to_repeat() {
    let (out, errors) = check(&["--cases", "40", "--seed", "5"], 0);
    assert!(out.contains("repeat with: rasterproof verify --seed 5 --cases 40"), "{out}");
    assert!(out.trim_end().ends_with(", 0 wrong pixels") && out.contains("\nAGREES: "), "{out}");
    assert!(
        out.lines().all(|line| line.chars().count() <= 100 || line.contains("see it with")),
        "{out}"
    );
    assert_eq!(errors, "", "no progress bar in a pipe");
}

/// Commands stay whole, and so do the tables of what is wrong; all else fits.
#[test]
fn text_fits_a_narrow_terminal() {
    let engine =
        ["judge", "--cases", "20", "--", env!("CARGO_BIN_EXE_rasterproof"), "engine", "scanline"];
    for words in [
        &["--cases", "20"][..],
        &["list"],
        &["course"],
        &["inspect", "T2", "--pixel", "3,3"],
        &["inspect", "0.1,0.2", "9.7,0.5", "5.5,5.5", "--pixel", "3,3"],
        &["inspect", "--line", "0,0", "40,3"],
        &["render", "cube", "--size", "32x32"],
        &engine,
    ] {
        let output = command(words).env("COLUMNS", "60").output().unwrap();
        let out = text(&output.stdout);
        assert_eq!(output.status.code(), Some(0), "{words:?}: {out}");
        let fits = |line: &&str| line.chars().count() <= 60 || line.contains("rasterproof ");
        let wide: Vec<_> = out.lines().filter(|line| !fits(line)).collect();
        assert!(wide.is_empty() && out.lines().count() > 3, "{words:?}: {wide:#?}");
    }
}

#[test]
fn verify_reports_a_planted_fault() {
    let (out, _) = check(&["--cases", "40", "--plant", "exclusive-edges"], 1);
    assert!(out.contains("\nDISAGREES: "), "{out}");
    assert!(out.contains("exclusive-edges against oracle: 1 missing on "), "{out}");
    let repeat =
        out.lines().find(|l| l.contains("repeat with: ") && l.contains("--case ")).unwrap();
    let words: Vec<&str> =
        repeat.trim().trim_start_matches("repeat with: rasterproof ").split(' ').collect();
    check(&words, 1);
}

#[test]
fn verify_reports_a_panicking_engine() {
    let (out, errors) = check(&["--cases", "40", "--plant", "panics-on-flat-bottom"], 1);
    assert!(out.contains("panics (planted: slope of a flat edge)"), "{out}");
    assert_eq!(errors, "");
}

#[test]
fn verify_does_not_depend_on_the_number_of_threads() {
    let json = |threads: &str| {
        let output = Command::new(env!("CARGO_BIN_EXE_rasterproof"))
            .args(["--cases", "300", "--json", "--family", "sliver", "--family", "line-far"])
            .env("RAYON_NUM_THREADS", threads)
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(0));
        text(&output.stdout)
    };
    assert!(json("1").contains("\"agrees\": true"));
    assert_eq!(json("1"), json("3"));
}

#[test]
fn verify_shards_add_up_to_the_whole() {
    let pixels = |shard: &str| {
        let (out, _) =
            check(&["--cases", "300", "--family", "uniform", "--json", "--shard", shard], 0);
        let json: serde_json::Value = serde_json::from_str(&out).unwrap();
        json["families"][0]["pixels"].as_u64().unwrap()
    };
    assert_eq!(pixels("0/3") + pixels("1/3") + pixels("2/3"), pixels("0/1"));
}

#[test]
fn misspelt_names_get_a_suggestion() {
    let (_, errors) = check(&["--family", "slivr"], 2);
    assert!(errors.contains("a similar value exists: 'sliver'"), "{errors}");
    let (_, errors) = check(&["engine", "scanlin"], 2);
    assert!(errors.contains("'scanline'"), "{errors}");
    let (_, errors) = check(&["inspect", "slivr#3"], 2);
    assert!(errors.contains("did you mean 'sliver'?"), "{errors}");
    let (_, errors) = check(&["inspect", "T99"], 2);
    assert!(errors.contains("no case is called 'T99'"), "{errors}");
}

#[test]
fn bad_input_is_refused_with_a_reason() {
    for (words, reason) in [
        (&["--cases", "0"][..], "expected a whole number from 1"),
        (&["--cases", "many"], "expected a whole number from 1"),
        (&["--seed", "-1"], "expected a whole number from 0"),
        (&["--case", "1e3"], "expected a whole number from 0"),
        (&["--seconds", "-1"], "expected a number above 0"),
        (&["judge", "--cases", "-1", "--", "x"], "expected a whole number from 1"),
        (&["inspect", "1,2"], "a point alone"),
        (&["inspect", "sliver"], "sliver#0"),
        (&["--seconds", "nan"], "--seconds NaN"),
        (&["--shard", "3/3"], "I from 0 to N - 1"),
        (&["--shard", "-1/2"], "I from 0 to N - 1"),
        (&["inspect", "T2", "--exact", "--seed", "-3/4"], "whole number from 0"),
        (&["--engine", "dda", "--family", "uniform"], "no case was judged"),
        (&["inspect", "1,2", "3,4"], "three corners"),
        (&["inspect", "nan,2", "3,4", "5,6"], "not a number"),
        (&["inspect", "1e22,2", "3,4", "5,6"], "outside the domain"),
        (&["inspect", "T2", "--window", "0x5"], "sides from 1 to 2048"),
        (&["inspect", "T2", "--window", "1000000000x1"], "sides from 1 to 2048"),
        (&["inspect", "T2", "--window", "2147483647,0,9x9"], "sides from 1 to 2048"),
        (&["inspect", "--line", "0,0"], "two points"),
        (&["inspect", "--line", "0,0", "1e9,3"], "whole numbers"),
        (&["inspect", "sliver#x"], "number of a case"),
        (&["inspect", "--exact", "--line", "0,0", "8,3"], "leave out --exact"),
        (&["inspect", "--exact", "0,0,2", "8,3", "1,7"], "X,Y alone"),
        (&["inspect", "0,0", "8,3", "1,7", "2,2"], "three corners"),
        (&["inspect", "T2", "-o", "/proc/none/x.png"], "/proc/none/x.png"),
    ] {
        let (_, errors) = check(words, 2);
        assert!(errors.contains(reason), "{words:?}: {errors}");
    }
}

#[test]
fn inspect_explains_named_cases() {
    for named in rasterproof_render::scene::named::named() {
        let (out, _) = check(&["inspect", named.name], 0);
        assert!(out.starts_with(&format!("{}: ", named.name)), "{out}");
    }
}

#[test]
fn inspect_takes_coordinates_and_writes_a_picture() {
    let path = std::env::temp_dir().join(format!("rasterproof-{}.png", std::process::id()));
    let name = path.to_str().unwrap();
    let (out, _) =
        check(&["inspect", "-1.5,-1.5", "4,0", "0,4", "--window", "-2,-2,8x8", "-o", name], 0);
    assert!(out.contains("columns -2..6"), "{out}");
    let picture = image::open(&path).unwrap();
    // Eight rows, and the words around them.
    assert!(picture.height() > 8 * 40, "{}", picture.height());
    std::fs::remove_file(path).unwrap();
    check(&["inspect", "--line", "-5,3", "9,-2"], 0);
    check(&["inspect", "sliver#7", "--seed", "3"], 0);
}

#[test]
fn help_shows_examples_and_exit_codes() {
    let (out, _) = check(&["--help"], 0);
    assert!(out.contains("Examples:") && out.contains("Exit status: 0"), "{out}");
    let (out, _) = check(&["engine", "--help"], 0);
    assert!(out.contains("T id width height"), "{out}");
    let (out, _) = check(&["list"], 0);
    assert!(out.contains("near-tie") && out.contains("S11") && out.contains("bresenham"), "{out}");
    assert!(out.lines().all(|line| line.chars().count() <= 100), "{out}");
}

/// A recorded input of the book's code: the engines agree, its specimen is shown beside them.
#[test]
fn inspect_shows_recorded_inputs_and_specimens() {
    let (out, _) = check(&["inspect", "double_row", "-o", "double.png"], 0);
    assert!(out.contains("book-ch2, published: "), "{out}");
    assert!(out.contains("scanline-exact against oracle-exact: agrees"), "{out}");
    assert!(out.contains("drawn in double.png"), "{out}");
    let (out, _) = check(&["inspect", "degenerate_drawn"], 0);
    assert!(out.contains("book-ch2, published: 0 missing, 6 extra, 1 twice"), "{out}");
    let (out, _) = check(&["inspect", "int_overflow_runaway"], 0);
    assert!(out.contains("refused: "), "{out}");
    let (out, _) = check(&["inspect", "T3", "--specimen", "sysu-inclusive"], 0);
    assert!(out.contains("sysu-inclusive: ") && out.contains(" wrong"), "{out}");
    let (out, _) = check(&["inspect", "--line", "0,0", "9,3", "--specimen", "book-dda"], 0);
    assert!(out.contains("book-dda: "), "{out}");
    let (_, errors) = check(&["inspect", "T3", "--specimen", "book-dda"], 2);
    assert!(errors.contains("book-dda does not draw what this case holds"), "{errors}");
    let (_, errors) = check(&["inspect", "doubel_row"], 2);
    assert!(errors.contains("did you mean 'double_row'?"), "{errors}");
}

/// Cases off the lattice are drawn too; failures of the engines for them make a picture.
#[test]
fn off_grid_cases_are_drawn() {
    let (out, _) = check(&["inspect", "f32-random#3", "-o", "free.png"], 0);
    assert!(out.contains("drawn in free.png"), "{out}");
    let mutant = ExactMutant::ALL[0].name();
    let (out, _) = check(&["verify", "--plant", mutant, "--cases", "40"], 1);
    assert!(out.contains("drawn in target/rasterproof/failures-off-grid.png"), "{out}");
    // A run without failures says nothing of it.
    let (out, _) = check(&["verify", "--family", "f32-random", "--cases", "40"], 0);
    assert!(!out.contains("drawn in"), "{out}");
}

/// The first thing that is printed is the smallest case: corners on halves, one pixel too many.
#[test]
fn a_planted_fault_is_told_first_and_smallest_first() {
    let (out, _) = check(&["--plant", "inclusive-edges", "--cases", "40"], 1);
    let first = out.lines().next().unwrap();
    let rest = first.strip_prefix("inclusive-edges against oracle: 1 extra on ").expect(first);
    let corners = rest.split(" (from ").next().unwrap();
    let numbers: Vec<f64> = corners.split([' ', ',']).map(|n| n.parse().unwrap()).collect();
    assert!(numbers.len() == 6 && numbers.iter().all(|n| (2.0 * n).fract() == 0.0), "{first}");
    let told = |line: &&str| line.contains(" missing") && !line.starts_with("# agrees");
    assert_eq!(out.lines().find(told), None, "{out}");
    assert!(out.contains("read on in:  docs/ch02.md"), "{out}");
    // The command that explains it says so, too.
    let command =
        out.lines().find_map(|l| l.trim().strip_prefix("explain it:  rasterproof ")).unwrap();
    let words: Vec<&str> = command.split(' ').collect();
    let (explained, _) = check(&words, 1);
    assert!(explained.contains("inclusive-edges against oracle: 1 extra"), "{explained}");
    assert!(out.lines().all(|line| line.chars().count() <= 110), "{out}");
}

/// What was not asked for may fail; the verdict is said.
#[test]
fn a_folder_that_cannot_be_written_costs_a_warning() {
    let folder = std::env::temp_dir().join(format!("rasterproof-blocked-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    // A file stands where the folder of pictures would be.
    std::fs::write(folder.join("target"), "").unwrap();
    let run = |words: &[&str]| {
        let program = env!("CARGO_BIN_EXE_rasterproof");
        let output = Command::new(program).args(words).current_dir(&folder).output().unwrap();
        (output.status.code(), text(&output.stdout), text(&output.stderr))
    };
    let words = ["--cases", "20", "--family", "half-integer"];
    let (status, out, errors) = run(&words);
    assert!(status == Some(0) && out.contains("\nAGREES: "), "{out}{errors}");
    assert!(errors.contains("warning: no picture: "), "{errors}");
    let (status, out, _) = run(&[&words[..], &["--plant", "exclusive-edges"]].concat());
    assert!(status == Some(1) && out.contains("\nDISAGREES: "), "{out}");
    let (status, out, _) = run(&["inspect", "T2"]);
    assert!(status == Some(0) && out.contains("agrees"), "{out}");
    // A page that was asked for is an error, after the verdict.
    let (status, out, errors) = run(&[&words[..], &["--report"]].concat());
    assert!(status == Some(2) && out.contains("\nAGREES: ") && errors.contains("error: "), "{out}");
    std::fs::remove_dir_all(folder).unwrap();
}

/// The answer in a few narrow lines; the table where it is asked for.
#[test]
fn a_right_verdict_is_short_and_narrow() {
    let words = ["--cases", "20", "--seed", "4"];
    let (out, _) = check(&words, 0);
    assert!(out.lines().next().unwrap().ends_with(": every engine is right"), "{out}");
    let groups: Vec<_> = out.lines().filter(|line| line.starts_with("  \u{2713} ")).collect();
    assert_eq!(groups.len(), 9, "{out}");
    assert!(groups.iter().all(|line| line.chars().count() <= 60), "{out}");
    assert!(out.contains("ties on edges             60 cases, all right"), "{out}");
    assert!(out.contains("% of the bound") && !out.contains("half-integer "), "{out}");
    let (out, _) = check(&[&words[..], &["--table"]].concat(), 0);
    assert!(out.contains("\nhalf-integer "), "{out}");
}

/// A pixel is explained by its edges: T2's corners lie on centres.
#[test]
fn inspect_explains_a_pixel() {
    let square = ["inspect", "0.5,0.5", "5.5,0.5", "5.5,5.5", "--pixel"];
    // Long lines are broken.
    let whole = |text: String| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let explained = |pixel: &str| whole(check(&[&square[..], &[pixel]].concat(), 0).0);
    let top = explained("3,0");
    assert!(top.contains("a tie: the sample lies on a top edge, which owns it: inside"), "{top}");
    assert!(top.contains("by the top-left rule: covered"), "{top}");
    assert!(top.contains("the scanline's span of row 0 is columns 0..5"), "{top}");
    assert!(top.contains("hits of (3, 0): scanline 1, edge-function 1, oracle 1"), "{top}");
    let right = explained("5,3");
    assert!(right.contains("on a right edge, which does not own it: outside"), "{right}");
    assert!(right.contains("by the top-left rule: not covered"), "{right}");
    let (line, _) = check(&["inspect", "--line", "0,0", "8,4", "--pixel", "3,2"], 0);
    assert!(line.contains("passes y = 1 and 4/8, a tie"), "{line}");
    assert!(line.contains("of the two the one farther along is lit: this one"), "{line}");
    // Off the grid by the exact forms: the case draws around its own corners.
    let free = ["inspect", "f32-tie#0"];
    let (case, _) = check(&free, 0);
    let (_, rest) = case.split_once("window: columns ").unwrap();
    let first = |axis: &str| rest.split_once(axis).unwrap().1.split_once("..").unwrap().0;
    let pixel = format!("{},{}", rest.split_once("..").unwrap().0, first("rows "));
    let (out, _) = check(&[&free[..], &["--pixel", &pixel]].concat(), 0);
    assert!(out.contains("by the top-left rule: ") && out.contains(" px^2, "), "{out}");
    assert!(out.contains("edge-function-exact: ") && out.contains("oracle-exact "), "{out}");
    let (_, errors) = check(&["inspect", "T2", "--pixel", "99,3"], 2);
    assert!(errors.contains("lies outside the window"), "{errors}");
}

/// Points as they are printed are read; faults and pages belong to `inspect`, too.
#[test]
fn inspect_takes_what_the_tool_prints() {
    let (printed, _) = check(&["inspect", "(0.5, 0.5) (5.5, 0.5) (5.5, 5.5)"], 0);
    assert!(printed.contains("triangle (0.5, 0.5) (5.5, 0.5) (5.5, 5.5)"), "{printed}");
    check(&["inspect", "(0.5, 0.5)", "(5.5, 0.5)", "(5.5, 5.5)"], 0);
    let (out, _) = check(&["inspect", "T2", "--plant", "inclusive-edges"], 1);
    assert!(out.contains("inclusive-edges against oracle: "), "{out}");
    let (_, errors) = check(&["inspect", "T2", "--plant", "line-truncates"], 2);
    assert!(errors.contains("in no engine that draws this case"), "{errors}");
    let (out, _) = check(&["inspect", "T2", "--report"], 0);
    assert!(out.contains("report: target/rasterproof/"), "{out}");
    // Several triangles, each by itself; a corner with values; corners that are not snapped.
    let square = ["inspect", "0.5,0.5", "5.5,0.5", "5.5,5.5", "0.5,0.5", "5.5,5.5", "0.5,5.5"];
    let (out, _) = check(&square, 0);
    assert!(out.starts_with("2 triangles\n") && out.contains("oracle: 25 px"), "{out}");
    let (out, _) = check(&["inspect", "2,29,1", "12,4,4,0,0,1", "20,4,4,0.5,1,1"], 0);
    assert!(out.contains("edge-function against oracle: agrees; "), "{out}");
    let (_, errors) = check(&["inspect", "2,29,-1", "12,4", "20,4"], 2);
    assert!(errors.contains("'2,29,-1': "), "{errors}");
    let (out, _) = check(&["inspect", "--exact", "0.1,0.2", "5.3,0.7", "2,6.1"], 0);
    assert!(
        out.contains("scanline-exact against oracle-exact: agrees") && !out.contains("oracle: "),
        "{out}"
    );
    let (out, _) = check(&["inspect", "--exact", "T2"], 0);
    assert!(out.contains("oracle-exact: 25 px"), "{out}");
    let (out, _) = check(&["inspect", "--line", "0,0", "5,0", "5,0", "5,5"], 0);
    assert!(out.starts_with("2 lines\n"), "{out}");
    let (out, _) = check(&["inspect", "0,0", "900,0", "0,900"], 0);
    assert!(out.contains("cropped: the shape is 900 x 900 px, the window 64 x 64"), "{out}");
}

/// What would be ignored is refused, and a name's ending is a promise.
#[test]
fn options_without_an_effect_are_refused() {
    for (words, reason) in [
        (&["render", "cube", "--zoom", "0"][..], "--zoom is for models"),
        (&["render", "cube", "--fov", "nan"], "--fov is for models"),
        (&["render", "cube", "--yaw", "10"], "--yaw is for models"),
        (&["render", "cube", "--shading", "flat"], "--shading is for models"),
        (&["render", "cbue"], "did you mean 'cube'?"),
        (&["render", "cube", "-o", "x.jpg"], "end its name with .png"),
        (&["render", "cube", "--spin", "2", "-o", "x.png"], "end its name with .gif"),
        (&["inspect", "T2", "-o", "x.jpg"], "end its name with .png"),
        (&["--cases", "-1"], "expected a whole number from 1"),
        (&["--cases", "1e6"], "expected a whole number from 1"),
        (&["--plant", "inclusive-edges", "--engine", "scanline"], "cannot be used with"),
        (&["inspect", "T99"], ". See: rasterproof list"),
    ] {
        let (_, errors) = check(words, 2);
        assert!(errors.contains(reason), "{words:?}: {errors}");
    }
}

/// The planted faults are named and explained where one would look for them.
#[test]
fn planted_faults_are_listed() {
    let (out, _) = check(&["list"], 0);
    for (name, about) in rasterproof_faults::planted::about::all() {
        assert!(out.lines().any(|line| line.contains(name) && line.contains(about)), "{name}");
    }
    assert!(check(&["--help"], 0).0.contains("--plant <FAULT>"));
}

/// A command that is printed works as printed: through cargo where cargo started the program.
#[test]
#[cfg(unix)]
fn commands_are_printed_as_the_program_was_called() {
    let folder = std::env::temp_dir().join(format!("rasterproof-called-{}", std::process::id()));
    let place = folder.join("target/release");
    std::fs::create_dir_all(&place).unwrap();
    std::os::unix::fs::symlink(env!("CARGO_BIN_EXE_rasterproof"), place.join("rasterproof"))
        .unwrap();
    let printed = |cargo: Option<&str>| {
        let mut shell = Command::new("sh");
        shell.args(["-c", "exec target/release/rasterproof --cases 5 --family flat"]);
        match cargo {
            Some(path) => shell.env("CARGO", path),
            None => shell.env_remove("CARGO"),
        };
        text(&shell.current_dir(&folder).output().unwrap().stdout)
    };
    let out = printed(Some("/usr/bin/cargo"));
    assert!(out.contains("repeat with: cargo run --release -- verify --seed 1"), "{out}");
    let out = printed(None);
    assert!(out.contains("repeat with: target/release/rasterproof verify --seed 1"), "{out}");
    std::fs::remove_dir_all(folder).unwrap();
}
