//! The command line, through the program itself: exit codes, messages, determinism.

use std::process::Command;

use rasterproof_faults::planted::exact::ExactMutant;

use crate::program::{Folder, PROGRAM, Run, check, shared};

#[test]
fn verify_agrees_and_says_how_to_repeat() {
    let Run { out, errors, .. } = check("--cases 40 --seed 5", 0)
        .prints("repeat with: rasterproof verify --seed 5 --cases 40");
    assert!(out.trim_end().ends_with(", 0 wrong pixels") && out.contains("\nAGREES: "), "{out}");
    assert!(
        out.lines().all(|line| line.chars().count() <= 100 || line.contains("see it with")),
        "{out}"
    );
    assert_eq!(errors, "", "no progress bar in a pipe");
}

/// Commands stay whole, and so do the tables of what is wrong; all else fits.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn text_fits_a_narrow_terminal() {
    let engine = format!("judge --cases 20 -- {PROGRAM} engine scanline");
    for words in [
        "--cases 20",
        "list",
        "course",
        "inspect T2 --pixel 3,3",
        "inspect 0.1,0.2 9.7,0.5 5.5,5.5 --pixel 3,3",
        "inspect --line 0,0 40,3",
        "render cube --size 32x32",
        &engine,
    ] {
        let out = Run::of(shared().command(words).env("COLUMNS", "60")).has(0).out;
        let fits = |line: &&str| line.chars().count() <= 60 || line.contains("rasterproof ");
        let wide: Vec<_> = out.lines().filter(|line| !fits(line)).collect();
        assert!(wide.is_empty() && out.lines().count() > 3, "{words:?}: {wide:#?}");
    }
}

/// What stands below the options was laid out by hand, for a usual terminal.
#[test]
fn examples_fit_eighty_columns() {
    for path in crate::pages::files(&crate::pages::root().join("src/cli/help"), ".txt") {
        let text = std::fs::read_to_string(&path).unwrap();
        let wide: Vec<_> = text.lines().filter(|line| line.chars().count() > 80).collect();
        assert!(wide.is_empty(), "{}: {wide:#?}", path.display());
    }
    // Who has not said enough sees how it is said.
    check("plan", 2).says("For example:\n  rasterproof plan panels ");
    check("judge", 2).says("For example:\n  rasterproof judge -- ./mine");
}

/// Help and messages are broken for a terminal of twenty columns, too, but for commands and the heads of options.
#[test]
fn help_and_messages_fit_twenty_columns() {
    for (words, status) in [
        ("--help", 0),
        ("inspect --help", 0),
        ("render nowhere.obj", 2),
        ("--frobnicate", 2),
        ("exhaust lines --reach 99999", 2),
    ] {
        let run = Run::of(shared().command(words).env("COLUMNS", "20")).has(status);
        let text = run.out + &run.errors;
        let fits = |line: &&str| {
            let words = line.split_whitespace().count();
            let is_whole = line.contains("rasterproof ") || line.trim_start().starts_with('-');
            line.chars().count() <= 20 || words < 2 || is_whole
        };
        let wide: Vec<_> = text.lines().filter(|line| !fits(line)).collect();
        assert!(wide.is_empty() && !text.is_empty(), "{words}: {wide:#?}");
    }
}

#[test]
fn verify_reports_a_panicking_engine() {
    let errors = check("--cases 40 --plant panics-on-flat-bottom", 1)
        .prints("panics (planted: slope of a flat edge)")
        .errors;
    assert_eq!(errors, "");
}

#[test]
fn verify_does_not_depend_on_the_number_of_threads() {
    let json = |threads: &str| {
        let words = "--cases 300 --json --family sliver --family line-far";
        Run::of(shared().command(words).env("RAYON_NUM_THREADS", threads)).has(0).out
    };
    assert!(json("1").contains("\"agrees\": true"));
    assert_eq!(json("1"), json("3"));
}

#[test]
fn verify_shards_add_up_to_the_whole() {
    let pixels = |shard: &str| {
        let out = check(format!("--cases 300 --family uniform --json --shard {shard}"), 0).out;
        let json: serde_json::Value = serde_json::from_str(&out).unwrap();
        json["families"][0]["pixels"].as_u64().unwrap()
    };
    assert_eq!(pixels("0/3") + pixels("1/3") + pixels("2/3"), pixels("0/1"));
}

#[test]
fn misspelt_names_get_a_suggestion() {
    check("--family slivr", 2).says("a similar value exists: 'sliver'");
    check("engine scanlin", 2).says("'scanline'");
    check("inspect slivr#3", 2).says("did you mean 'sliver'?");
    check("inspect T99", 2).says("no case is called 'T99'");
}

#[test]
fn bad_input_is_refused_with_a_reason() {
    for (words, reason) in [
        ("--cases 0", "expected a whole number from 1"),
        ("--cases many", "expected a whole number from 1"),
        ("--seed -1", "expected a whole number from 0"),
        ("--case 1e3", "expected a whole number from 0"),
        ("--seconds -1", "expected a number of seconds above 0"),
        ("judge --cases -1 -- x", "expected a whole number from 1"),
        ("inspect 1,2", "a point alone"),
        ("inspect sliver", "sliver#0"),
        ("--seconds nan", "expected a number of seconds above 0"),
        ("--shard 3/3", "I from 0 to N - 1"),
        ("--shard -1/2", "I from 0 to N - 1"),
        ("inspect T2 --exact --seed -3/4", "whole number from 0"),
        ("--engine dda --family uniform", "no case was judged"),
        ("inspect 1,2 3,4", "three corners"),
        ("inspect nan,2 3,4 5,6", "not a number"),
        ("inspect 1e22,2 3,4 5,6", "outside the domain"),
        ("inspect T2 --window 0x5", "sides from 1 to 2048"),
        ("inspect T2 --window 1000000000x1", "sides from 1 to 2048"),
        ("inspect T2 --window 2147483647,0,9x9", "sides from 1 to 2048"),
        ("inspect --line 0,0", "two points"),
        ("inspect --line 0,0 1e9,3", "whole numbers"),
        ("inspect sliver#x", "number of a case"),
        ("inspect --exact --line 0,0 8,3", "leave out --exact"),
        ("inspect --exact 0,0,2 8,3 1,7", "X,Y alone"),
        ("inspect 0,0 8,3 1,7 2,2", "three corners"),
        ("inspect T2 -o /proc/none/x.png", "/proc/none/x.png"),
    ] {
        check(words, 2).says(reason);
    }
}

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn inspect_explains_named_cases() {
    for named in rasterproof_render::scene::named::named() {
        let out = check(["inspect", named.name], 0).out;
        assert!(out.starts_with(&format!("✓ {}: ", named.name)), "{out}");
    }
}

#[test]
fn inspect_takes_coordinates_and_writes_a_picture() {
    let folder = Folder::new("commands-picture");
    folder
        .check("inspect -1.5,-1.5 4,0 0,4 --window -2,-2,8x8 -o a.png", 0)
        .prints("columns -2..6");
    let picture = image::open(folder.join("a.png")).unwrap();
    // Eight rows, and the words around them.
    assert!(picture.height() > 8 * 40, "{}", picture.height());
    check("inspect --line -5,3 9,-2", 0);
    check("inspect sliver#7 --seed 3", 0);
}

#[test]
fn help_shows_examples_and_exit_codes() {
    check("--help", 0).prints("Examples:").prints("Exit status: 0");
    check("engine --help", 0).prints("T id width height");
    let out = check("list", 0).prints("near-tie").prints("S11").prints("bresenham").out;
    assert!(out.lines().all(|line| line.chars().count() <= 100), "{out}");
}

/// A recorded input of the book's code: the engines agree, its specimen is shown beside them.
#[test]
fn inspect_shows_recorded_inputs_and_specimens() {
    check("inspect double_row -o double.png", 0)
        .prints("book-ch2, published: ")
        .prints("scanline-exact against oracle: agrees")
        .prints("drawn in double.png");
    check("inspect degenerate_drawn", 0).prints("book-ch2, published: 0 missing, 6 extra, 1 twice");
    check("inspect int_overflow_runaway", 0).prints("refused: ");
    check("inspect T3 --specimen sysu-inclusive", 0).prints("sysu-inclusive: ").prints(" wrong");
    check("inspect --line 0,0 9,3 --specimen book-dda", 0).prints("book-dda: ");
    check("inspect T3 --specimen book-dda", 2).says("book-dda does not draw what this case holds");
    check("inspect doubel_row", 2).says("did you mean 'double_row'?");
}

/// Cases off the lattice are drawn too; failures of the engines for them make a picture.
#[test]
fn off_grid_cases_are_drawn() {
    check("inspect f32-random#3 -o free.png", 0).prints("drawn in free.png");
    let mutant = ExactMutant::ALL[0].name();
    check(["verify", "--plant", mutant, "--cases", "40"], 1)
        .prints("drawn in target/rasterproof/failures.png");
    // A run without failures says nothing of it.
    check("verify --family f32-random --cases 40", 0).omits("drawn in");
}

/// What follows the answer is the smallest case: corners on halves, one pixel too many.
#[test]
fn a_planted_fault_is_told_first_and_smallest_first() {
    let out = check("--plant inclusive-edges --cases 40", 1).out;
    assert!(out.lines().next().unwrap().ends_with(": not every engine is right"), "{out}");
    let first = out.lines().nth(2).unwrap();
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
    check(command, 1).prints("inclusive-edges against oracle: 1 extra");
    // And the one that judges the case again.
    let repeat =
        |line: &str| line.trim().strip_prefix("repeat with: rasterproof ").map(str::to_owned);
    let repeat = out.lines().filter_map(repeat).find(|words| words.contains("--case ")).unwrap();
    check(repeat, 1);
    assert!(out.contains("\nDISAGREES: "), "{out}");
    assert!(out.lines().all(|line| line.chars().count() <= 110), "{out}");
}

/// What was not asked for may fail; the verdict is said.
#[test]
fn a_folder_that_cannot_be_written_costs_a_warning() {
    let folder = Folder::new("blocked");
    // A file stands where the folder of pictures would be.
    std::fs::write(folder.join("target"), "").unwrap();
    let words = "--cases 20 --family half-integer";
    folder.check(words, 0).prints("\nAGREES: ").says("warning: no picture: ");
    folder.check(format!("{words} --plant exclusive-edges"), 1).prints("\nDISAGREES: ");
    folder.check("inspect T2", 0).prints("agrees");
    // A page that was asked for is an error, after the verdict.
    folder.check(format!("{words} --report"), 2).prints("\nAGREES: ").says("error: ");
}

/// The answer in a few narrow lines; the table where it is asked for.
#[test]
fn a_right_verdict_is_short_and_narrow() {
    let words = "--cases 20 --seed 4";
    let out = check(words, 0).out;
    assert!(out.lines().next().unwrap().ends_with(": every engine is right"), "{out}");
    let groups: Vec<_> = out.lines().filter(|line| line.starts_with("  \u{2713} ")).collect();
    assert_eq!(groups.len(), 10, "{out}");
    assert!(groups.iter().all(|line| line.chars().count() <= 60), "{out}");
    assert!(out.contains("ties on edges             60 cases, all right"), "{out}");
    assert!(out.contains("% of the bound") && !out.contains("half-integer "), "{out}");
    check(format!("{words} --table"), 0).prints("\nhalf-integer ");
}

/// A pixel is explained by its edges: T2's corners lie on centres.
#[test]
fn inspect_explains_a_pixel() {
    let square = "inspect 0.5,0.5 5.5,0.5 5.5,5.5";
    // Long lines are broken.
    let whole = |text: String| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let explained = |pixel: &str| whole(check(format!("{square} --pixel {pixel}"), 0).out);
    let top = explained("3,0");
    assert!(top.contains("a tie: the sample lies on a top edge, which owns it: inside"), "{top}");
    assert!(top.contains("by the top-left rule: covered"), "{top}");
    assert!(top.contains("the scanline's span of row 0 is columns 0..5"), "{top}");
    assert!(top.contains("hits of (3, 0): scanline 1, edge-function 1, oracle 1"), "{top}");
    let right = explained("5,3");
    assert!(right.contains("on a right edge, which does not own it: outside"), "{right}");
    assert!(right.contains("by the top-left rule: not covered"), "{right}");
    check("inspect --line 0,0 8,4 --pixel 3,2", 0)
        .prints("passes y = 1 and 4/8, a tie")
        .prints("of the two the one farther along is lit: this one");
    // Off the grid by the exact forms: the case draws around its own corners.
    let free = "inspect f32-tie#0";
    let case = check(free, 0).out;
    let (_, rest) = case.split_once("window: columns ").unwrap();
    let first = |axis: &str| rest.split_once(axis).unwrap().1.split_once("..").unwrap().0;
    let pixel = format!("{},{}", rest.split_once("..").unwrap().0, first("rows "));
    check(format!("{free} --pixel {pixel}"), 0)
        .prints("by the top-left rule: ")
        .prints(" px^2, ")
        .prints("edge-function-exact: ")
        .prints("oracle ");
    check("inspect T2 --pixel 99,3", 2).says("lies outside the window");
}

/// Points as they are printed are read; faults and pages belong to `inspect`, too.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn inspect_takes_what_the_tool_prints() {
    check(["inspect", "(0.5, 0.5) (5.5, 0.5) (5.5, 5.5)"], 0)
        .prints("triangle (0.5, 0.5) (5.5, 0.5) (5.5, 5.5)");
    check(["inspect", "(0.5, 0.5)", "(5.5, 0.5)", "(5.5, 5.5)"], 0);
    check("inspect T2 --plant inclusive-edges", 1).prints("inclusive-edges against oracle: ");
    check("inspect T2 --plant line-truncates", 2).says("in no engine that draws this case");
    check("inspect T2 --report", 0).says("report: target/rasterproof/");
    // Several triangles, each by itself; a corner with values; corners that are not snapped.
    let square = "inspect 0.5,0.5 5.5,0.5 5.5,5.5 0.5,0.5 5.5,5.5 0.5,5.5";
    let out = check(square, 0).out;
    assert!(out.starts_with("✓ 2 triangles\n") && out.contains("oracle: 25 px"), "{out}");
    check("inspect 2,29,1 12,4,4,0,0,1 20,4,4,0.5,1,1", 0)
        .prints("edge-function against oracle: agrees; ");
    check("inspect 2,29,-1 12,4 20,4", 2).says("'2,29,-1': ");
    check("inspect --exact 0.1,0.2 5.3,0.7 2,6.1", 0)
        .prints("scanline-exact against oracle: agrees")
        .omits("edge-function against ");
    check("inspect --exact T2", 0).prints("oracle: 25 px");
    let out = check("inspect --line 0,0 5,0 5,0 5,5", 0).out;
    assert!(out.starts_with("✓ 2 lines\n"), "{out}");
    check("inspect 0,0 900,0 0,900", 0)
        .prints("cropped: the shape is 900 x 900 px, the window 64 x 64");
}

/// What would be ignored is refused, and a name's ending is a promise.
#[test]
fn options_without_an_effect_are_refused() {
    for (words, reason) in [
        ("render cube --zoom 0", "--zoom is for models"),
        ("render cube --fov nan", "--fov is for models"),
        ("render cube --yaw 10", "--yaw is for models"),
        ("render cube --shading flat", "--shading is for models"),
        ("render cbue", "did you mean 'cube'?"),
        ("render cube -o x.jpg", "end its name with .png"),
        ("render cube --spin 2 -o x.png", "end its name with .gif"),
        ("render cube --wireframe --effects all", "cannot be used with"),
        ("render cube --map --json", "cannot be used with"),
        ("render cube --spin 2 --json", "cannot be used with"),
        ("inspect T2 -o x.jpg", "end its name with .png"),
        ("--cases -1", "expected a whole number from 1"),
        ("--cases 1e6", "expected a whole number from 1"),
        ("--plant inclusive-edges --engine scanline", "cannot be used with"),
        ("inspect T99", ". See: rasterproof list"),
    ] {
        check(words, 2).says(reason);
    }
}

/// The planted faults are named and explained where one would look for them.
#[test]
fn planted_faults_are_listed() {
    let out = check("list", 0).out;
    for (name, about) in rasterproof_faults::planted::all() {
        assert!(out.lines().any(|line| line.contains(name) && line.contains(about)), "{name}");
    }
    assert!(check("--help", 0).out.contains("--plant <FAULT>"));
}

/// A command that is printed works as printed: through cargo where cargo started the program.
#[test]
#[cfg(unix)]
fn commands_are_printed_as_the_program_was_called() {
    let folder = Folder::new("called");
    let place = folder.join("target/release");
    std::fs::create_dir_all(&place).unwrap();
    std::os::unix::fs::symlink(PROGRAM, place.join("rasterproof")).unwrap();
    let printed = |cargo: Option<&str>| {
        let mut shell = Command::new("sh");
        shell.args(["-c", "exec target/release/rasterproof --cases 5 --family flat"]);
        match cargo {
            Some(path) => shell.env("CARGO", path),
            None => shell.env_remove("CARGO"),
        };
        Run::of(shell.current_dir(&*folder)).out
    };
    let out = printed(Some("/usr/bin/cargo"));
    assert!(out.contains("repeat with: cargo run --release -- verify --seed 1"), "{out}");
    let out = printed(None);
    assert!(out.contains("repeat with: target/release/rasterproof verify --seed 1"), "{out}");
}
