//! One type of error for the whole crate, so that `?` hands on whatever an engine refuses.

/// Why a question makes no sense or cannot be drawn, in words for the reader of the page.
pub type NoAnswer = Box<dyn std::error::Error>;
