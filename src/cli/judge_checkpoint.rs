//! `judge --checkpoint FILE`: the answers of the program are kept in a file, and a judgement that was broken off goes on from there.

use std::path::Path;
use std::time::Duration;

use rasterproof_host::output::{Output, Over};
use rasterproof_host::text::printable_path;
use rasterproof_host::{input, limits};
use rasterproof_judge::Options;
use rasterproof_judge::ask::Subject;
use rasterproof_judge::record::RecordedSubject;
use rasterproof_verify::comparison::pixels::mix;

use super::{InputError, usage, write_file};

/// How often the answers are written.
const SAVE_EVERY: Duration = Duration::from_secs(3);
/// The longest record that is read.
const RECORD_BYTES: u64 = 1 << 30;

/// The program, asked only what it has not answered before.
pub fn resume(
    program: Box<dyn Subject>,
    path: &Path,
    command: &[String],
    options: &Options,
) -> Result<Box<dyn Subject>, InputError> {
    let text = match input::read_text(path, RECORD_BYTES) {
        Err(error) if error.missing => String::new(),
        read => read.map_err(|error| usage(format!("the checkpoint {error}")))?,
    };
    // The first lines of the file say which answers these are; those of another judgement are refused.
    let of = answers_of(&*program, command, options);
    let state = Output { path: path.to_owned(), over: Over::Updated };
    // A full disk must not end the judgement; the next save may succeed.
    let save = move |text: &str| drop(write_file(&state, text.as_bytes()));
    let recorded = RecordedSubject::new(program, &of, text, SAVE_EVERY, Box::new(save));
    let recorded = recorded.map_err(|why| {
        usage(format!(
            "the checkpoint {} {why}; remove it, or name another file",
            printable_path(path)
        ))
    })?;
    // Find out at once, not after an hour, whether it can be written.
    let state = Output { path: path.to_owned(), over: Over::Updated };
    write_file(&state, recorded.text().as_bytes())?;
    Ok(Box::new(recorded))
}

/// What the answers depend on, in a line: the options, what the program says of itself, its command, and the files that this names.
fn answers_of(program: &dyn Subject, command: &[String], options: &Options) -> String {
    // A program that was built anew has other answers, so the content of its files counts.
    let mut files = 0xcbf2_9ce4_8422_2325;
    for word in command {
        let bytes = input::read(Path::new(word), limits::DOCUMENT_BYTES).unwrap_or_default();
        bytes.iter().for_each(|byte| mix(&mut files, u64::from(*byte)));
        mix(&mut files, bytes.len() as u64);
    }
    let Options { seed, cases, families, only, .. } = options;
    let declared = program.declared();
    format!("{seed} {cases} {families:?} {only:?} {command:?} {files:x} {declared:?}")
}
