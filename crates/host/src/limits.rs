//! Limits of size and time, each stated once.

/// Models: 1 GiB, since 5 million triangles take about a third of it.
pub const MODEL_BYTES: u64 = 1 << 30;

/// One texture file, before it is decoded.
pub const TEXTURE_BYTES: u64 = 1 << 28;

/// All material files of a model together: a million materials are some 50 MB.
pub const MATERIAL_BYTES: u64 = 1 << 26;

/// One texture after decoding: 16,384 x 16,384 px in RGBA take 1 GiB, so this allows half of that.
pub const DECODED_TEXTURE_BYTES: u64 = 1 << 29;

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
