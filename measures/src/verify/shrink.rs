//! Makes a failing case small enough to read, while it goes on failing.
//!
//! The steps are those of `hazard`, which needs no threads; this is their public name.

pub(super) use crate::hazard::shrink::size;
#[doc(inline)]
pub use crate::hazard::shrink::{describe, has_plain_values, shrink};
