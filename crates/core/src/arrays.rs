//! Small arrays, item by item: what `[T; N]::map` does, in one function for each closure instead of six.
//!
//! The optimiser is given less to undo (see "What is generic, and why" in `docs/ARCHITECTURE.md`).

/// An array of two or three, each item of which becomes another.
pub trait MapArray<T> {
    /// As many of something else.
    type Of<U>;

    /// Calls `f` on the items in order.
    fn map_array<U>(self, f: impl FnMut(T) -> U) -> Self::Of<U>;
}

impl<T> MapArray<T> for [T; 2] {
    type Of<U> = [U; 2];

    #[inline(always)]
    fn map_array<U>(self, mut f: impl FnMut(T) -> U) -> [U; 2] {
        let [a, b] = self;
        [f(a), f(b)]
    }
}

impl<T> MapArray<T> for [T; 3] {
    type Of<U> = [U; 3];

    #[inline(always)]
    fn map_array<U>(self, mut f: impl FnMut(T) -> U) -> [U; 3] {
        let [a, b, c] = self;
        [f(a), f(b), f(c)]
    }
}
