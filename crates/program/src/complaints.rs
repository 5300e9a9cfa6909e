//! What a program writes on standard error: the lines in which a sanitizer says what it found, the last ones, and how
//! many there were.
//!
//! The report of AddressSanitizer begins with what is wrong and ends with a legend that is the same every time. What
//! comes between a summary and the next process is counted, and not kept.

use std::collections::VecDeque;

use rasterproof_judge::ask::Complaints;
use rasterproof_judge::text::printable;

/// The number of a summary in [`FINDINGS`].
const SUMMARY: usize = 1;
/// Lines from the end that are kept.
const LAST: usize = 8;
/// Bytes of a line that are kept.
const LINE_BYTES: usize = rasterproof_host::limits::PROGRAM_COMPLAINT_BYTES / LAST;
/// Characters of a line that are shown; of a finding more, since it ends with the function.
const SHOWN: usize = 90;
const SHOWN_OF_A_FINDING: usize = 240;

/// What the lines have that say a finding, and how many of each are kept; a line belongs to the first that it has.
/// `ERROR` is that of AddressSanitizer and LeakSanitizer, `runtime error` that of UndefinedBehaviorSanitizer. The threads'
/// and the memory's one begin with a warning. Valgrind, too, writes a summary.
const FINDINGS: [(&str, usize); 4] =
    [("ERROR: ", 1), ("SUMMARY: ", 4), ("runtime error: ", 4), ("Sanitizer: ", 1)];

#[derive(Clone, Debug, Default)]
pub struct StandardError {
    /// Lines so far, the unfinished one not among them.
    lines: u64,
    /// Lines with a finding.
    findings: Vec<Line>,
    last: VecDeque<Line>,
    /// The beginning of the line that has no end yet.
    unfinished: Vec<u8>,
    /// Whether the summary of a report came, and nothing new since.
    is_legend: bool,
}

#[derive(Clone, Debug)]
struct Line {
    text: Vec<u8>,
    /// The number of its kind in [`FINDINGS`], if it is one.
    finding: Option<usize>,
}

impl StandardError {
    /// Another process of the program begins.
    pub fn begin(&mut self) {
        self.hear(b"\n");
        self.is_legend = false;
    }

    /// Takes the next bytes into account.
    pub fn hear(&mut self, bytes: &[u8]) {
        for part in bytes.split_inclusive(|byte| *byte == b'\n') {
            let room = LINE_BYTES - self.unfinished.len();
            self.unfinished.extend(part.iter().take(room));
            if part.ends_with(b"\n") {
                let line = std::mem::take(&mut self.unfinished);
                self.keep(line);
            }
        }
    }

    fn keep(&mut self, line: Vec<u8>) {
        let text = line.trim_ascii_end();
        if text.is_empty() {
            return;
        }
        let finding = FINDINGS.iter().position(|(mark, _)| holds(text, mark));
        let line = Line { text: text.to_vec(), finding };
        self.lines += 1;
        if let Some(kind) = finding {
            let mut of_it = 0;
            let mut is_known = false;
            for other in &self.findings {
                of_it += usize::from(other.finding == finding);
                is_known |= other.text == line.text;
            }
            if !is_known && of_it < FINDINGS[kind].1 {
                self.findings.push(line.clone());
            }
        }
        self.is_legend &= finding.is_none();
        if !self.is_legend {
            self.last.push_back(line);
        }
        if self.last.len() > LAST {
            self.last.pop_front();
        }
        self.is_legend |= finding == Some(SUMMARY);
    }

    /// The findings, then the last lines, each once. A line without an end counts as one.
    pub fn complaints(&self) -> Complaints {
        let mut whole = self.clone();
        whole.hear(b"\n");
        let mut shown = Vec::new();
        for line in &whole.findings {
            if whole.last.iter().all(|last| last.text != line.text) {
                shown.push(line.shown());
            }
        }
        shown.extend(whole.last.iter().map(Line::shown));
        Complaints { lines: whole.lines, shown }
    }
}

impl Line {
    fn shown(&self) -> String {
        let most = if self.finding.is_some() { SHOWN_OF_A_FINDING } else { SHOWN };
        printable(&self.text, most)
    }
}

fn holds(text: &[u8], mark: &str) -> bool {
    text.windows(mark.len()).any(|part| part == mark.as_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn heard(pieces: &[&str]) -> Complaints {
        let mut error = StandardError::default();
        pieces.iter().for_each(|piece| error.hear(piece.as_bytes()));
        error.complaints()
    }

    #[test]
    fn the_last_lines_are_kept_and_all_are_counted() {
        let text: String = (0..100).map(|i| format!("line {i}\n\n")).collect();
        let heard = heard(&[&text[..55], &text[55..], "no end"]);
        let last = ["line 93", "line 94", "line 95", "line 96", "line 97", "line 98", "line 99"];
        assert_eq!(
            (heard.lines, &heard.shown[..7], &*heard.shown[7]),
            (101, &last.map(str::to_owned)[..], "no end")
        );
        assert_eq!(super::StandardError::default().complaints(), Complaints::default());
    }

    /// The report of AddressSanitizer as GCC writes it, twice, since the program is started again.
    #[test]
    fn what_a_sanitizer_found_is_kept() {
        let legend: String = (0..30).map(|i| format!("  {i:02x}: 00 00 fa fa\n")).collect();
        let report = |pid: u32| {
            format!(
                "=====\n=={pid}==ERROR: AddressSanitizer: heap-buffer-overflow on address 0x602 at pc 0x55\n\
                 WRITE of size 1\n#0 0x55 in triangle mine.cpp:17\n\
                 SUMMARY: AddressSanitizer: heap-buffer-overflow mine.cpp:17 in triangle\n\
                 {legend}=={pid}==ABORTING\n"
            )
        };
        let undefined = "mine.cpp:7:20: runtime error: signed integer overflow\n";
        let mut error = StandardError::default();
        for pid in 10..20 {
            error.begin();
            error.hear(undefined.as_bytes());
            error.hear(report(pid).as_bytes());
        }
        let heard = error.complaints();
        assert_eq!((heard.lines, heard.shown.len()), (370, 9));
        let ends = [
            "==10==ERROR: AddressSanitizer: heap-buffer-overflow on address 0x602 at pc 0x55",
            "#0 0x55 in triangle mine.cpp:17",
            "SUMMARY: AddressSanitizer: heap-buffer-overflow mine.cpp:17 in triangle",
        ];
        assert_eq!([0, 7, 8].map(|at| &*heard.shown[at]), ends);
        assert!(heard.shown.contains(&undefined.trim_end().to_owned()));
        // What a program says after it was started again is no legend.
        error.begin();
        error.hear(b"No module named numpy");
        assert_eq!(error.complaints().shown.last().unwrap(), "No module named numpy");
    }

    #[test]
    fn endless_lines_need_no_memory() {
        let mut error = StandardError::default();
        (0..1000).for_each(|_| error.hear(&[b'x'; 4096]));
        assert_eq!(error.unfinished.len(), LINE_BYTES);
        assert_eq!(error.complaints().lines, 1);
    }
}
