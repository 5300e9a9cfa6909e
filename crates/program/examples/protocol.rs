//! Both sides of the line protocol without the rest of the program, for `proof/check`, which would otherwise wait for all of it to be
//! compiled. The arguments are those of `rasterproof` that `proof/check` uses:
//!   protocol engine NAME
//!   protocol judge --cases N --declare WORDS -- CMD...

use std::process::ExitCode;

use rasterproof_judge::ask::Subject;
use rasterproof_judge::recognise::{Scope, recognise};
use rasterproof_judge::verdict::Scores as _;
use rasterproof_judge::{Options, judge, server};
use rasterproof_program::{Limits, Program, group};
use rasterproof_registry::engines;

const USAGE: &str =
    "usage: protocol engine NAME, or protocol judge --cases N --declare WORDS -- CMD...";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words[..] {
        ["engine", name] => answer(name),
        ["judge", "--cases", cases, "--declare", declare, "--", ..] => {
            let cases = cases.parse().expect("--cases takes a whole number");
            ask(cases, declare, &arguments[6..])
        }
        _ => {
            eprintln!("{USAGE}");
            ExitCode::from(2)
        }
    }
}

fn answer(name: &str) -> ExitCode {
    let Some(engine) = engines::find(name) else {
        eprintln!("no engine is called '{name}'");
        return ExitCode::from(2);
    };
    match server::serve(engine, &mut std::io::stdin().lock(), &mut std::io::stdout().lock()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("the answers cannot be written: {error}");
            ExitCode::FAILURE
        }
    }
}

fn ask(cases: u64, declare: &str, command: &[String]) -> ExitCode {
    group::end_all_on_ctrl_c();
    let declared: Vec<String> = declare.split_whitespace().map(str::to_owned).collect();
    let program = match Program::start(command, &declared, Limits::default()) {
        Ok(program) => program,
        Err(what) => {
            eprintln!("the program {what}\n  {}", what.remedy());
            return ExitCode::from(2);
        }
    };
    let scope = Scope { triangles: true, lines: true, always: false, patience: None };
    let mut askers = [Box::new(program) as Box<dyn Subject>];
    let options = Options::default().cases(cases);
    let verdict = judge(&mut askers, &options, &|program| recognise(program, scope), &|_| {});
    let pixels: u64 = verdict.families.iter().map(|row| row.pixels).sum();
    for property in verdict.more.properties.iter().filter(|property| !property.outcome.is_good()) {
        println!("{}: {}", property.name, property.detail);
    }
    let agrees = verdict.agrees() && pixels > 0;
    let said = if agrees { "agrees" } else { "does not agree" };
    println!("as declared: {said}, {pixels} pixels expected in {cases} cases of each family");
    ExitCode::from(u8::from(!agrees))
}
