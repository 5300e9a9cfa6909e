//! Makes a failing case small enough to read, while it goes on failing.
//!
//! The steps are those of `cases`, which needs no threads; this is their public name.

pub(super) use crate::cases::shrink::size;
#[doc(inline)]
pub use crate::cases::shrink::{describe, has_plain_values, shrink};
