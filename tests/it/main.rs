//! One binary for all integration tests but the differential table.

mod matrix;
mod properties;
