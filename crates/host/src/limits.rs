//! Limits of size and time of what comes from outside, each stated once.

use std::time::Duration;

/// Models: 2 GiB, since 5 million triangles of an STL in text take more than 1 GiB.
pub const MODEL_BYTES: u64 = 1 << 31;

/// What the meshes of a glTF may take where its file is small: a few bytes can ask for millions of copies.
pub const MODEL_CONTENTS_BYTES: u64 = 1 << 29;

/// The same for each byte of a larger file. A triangle without compression has 12 bytes or more, and takes some 200.
pub const MODEL_CONTENTS_BYTES_PER_BYTE: u64 = 64;

/// One texture file, before it is decoded.
pub const TEXTURE_BYTES: u64 = 1 << 28;

/// All material files of a model together: a million materials are some 50 MB.
pub const MATERIAL_BYTES: u64 = 1 << 26;

/// What is kept of the name of a part or a material of a model: thousands of parts may have one name.
pub const NAME_BYTES: usize = 1 << 10;

/// All texture files of a model together, before they are decoded: a hash of each of them is taken.
pub const ALL_TEXTURE_FILES_BYTES: u64 = 1 << 30;

/// One texture after decoding: 16,384 x 16,384 px in RGBA take 1 GiB, so this allows half of that.
pub const DECODED_TEXTURE_BYTES: u64 = 1 << 29;

/// All textures of a model together after decoding: with what draws them the program stays below 2 GiB.
pub const ALL_TEXTURES_BYTES: u64 = 1 << 30;

/// The frames of a command, with what is computed for each of their samples.
pub const FRAME_BYTES: u64 = 1 << 31;

/// Certificates: some 2 KB and five examples. All files of a merge are in memory together.
pub const CERTIFICATE_BYTES: u64 = 1 << 20;

/// Files that this program wrote itself: plans, checkpoints, baselines, snapshots.
pub const DOCUMENT_BYTES: u64 = 1 << 26;

/// Small files that people edit: answers of a quiz, the progress of a course.
pub const NOTE_BYTES: u64 = 1 << 20;

/// Source files and modules that are read to be shown, hashed or put into a page.
pub const SOURCE_BYTES: u64 = 1 << 25;

/// Seconds that a write may wait for the reader of a pipe or a device.
pub const STALLED_WRITE_SECONDS: u64 = 10;

/// One line of a judged program: a longer one is no answer. The largest windows of cases have about 100,000 pixels, and a program may
/// give each as a run of its own, in a dozen bytes.
pub const PROGRAM_LINE_BYTES: usize = 1 << 22;

/// Answers of a judged program to the questions that are asked at once, which are kept together. The cases of
/// a block need less than a tenth.
pub const PROGRAM_BLOCK_BYTES: usize = 32 << 20;

/// What a judged program may say before it answers HELLO.
pub const PROGRAM_CHATTER_BYTES: usize = 1 << 18;

/// What is kept of a judged program's standard error: its last lines, and as much again of what sanitizers found.
pub const PROGRAM_COMPLAINT_BYTES: usize = 4096;

/// One request of the line protocol; the rest of a longer line is not kept.
pub const REQUEST_BYTES: u64 = 1 << 16;

/// Fragments that are computed for one request, where the answer is collected or computed in big integers.
pub const REQUEST_FRAGMENTS: u64 = 1 << 20;

/// Runs or pixels of one answer. Some published algorithms make a run of every pixel, and the largest window
/// has 2^28 of them, so that an answer would take gigabytes.
pub const REQUEST_RUNS: usize = 1 << 22;

/// Seconds for the build of a submission where no option says otherwise.
pub const BUILD_SECONDS: u64 = 120;

/// MiB that the build of a submission may write to standard error where no option says otherwise.
pub const BUILD_OUTPUT_MIB: u64 = 16;

/// What is kept of what a build writes: its beginning.
pub const BUILD_SAID_BYTES: usize = 1 << 14;

/// The largest side of a picture that is shown on a page.
pub const SHOWN_SIDE_PX: u32 = 4096;

/// The longest text whose lines are compared with those of another.
pub const COMPARED_TEXT_BYTES: usize = 1 << 18;

/// Pixels of pictures that one review decodes: some seconds of work.
pub const REVIEWED_PX: u64 = 1 << 27;

pub const PAGE_BYTES: usize = 2_000_000;

/// Time to compare the lines of two texts, which grows with the square of what differs.
pub const DIFF_TIME: Duration = Duration::from_millis(500);

/// Time to compare all texts of a page.
pub const ALL_DIFFS_TIME: Duration = Duration::from_secs(2);
