//! A choice between two values without a branch, where the standard library has a function for it.

/// `if_true` or `if_false`. The function of the standard library is younger than the oldest compiler of this crate, and
/// saves time in frames of small triangles alone: who draws those asks for the feature `select`.
#[cfg(not(feature = "select"))]
#[inline]
pub(crate) fn select_unpredictable<T>(condition: bool, if_true: T, if_false: T) -> T {
    if condition { if_true } else { if_false }
}

#[cfg(feature = "select")]
#[expect(clippy::incompatible_msrv, reason = "the feature asks for Rust 1.88")]
#[inline]
pub(crate) fn select_unpredictable<T>(condition: bool, if_true: T, if_false: T) -> T {
    std::hint::select_unpredictable(condition, if_true, if_false)
}
