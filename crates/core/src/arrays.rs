//! Small arrays, item by item: what `[T; N]::map` does, in one function for each closure instead of six.
//!
//! The optimiser is given less to undo (see "What is generic, and why" in `docs/ARCHITECTURE.md`).

/// An array of two, three or four, each item of which becomes another.
pub trait MapArray<T> {
    /// As many of something else.
    type Of<U>;

    /// Calls `f` on the items in order.
    fn map_array<U>(self, f: impl FnMut(T) -> U) -> Self::Of<U>;
}

macro_rules! map_arrays {
    ($($count:literal: $($item:ident)*;)*) => {$(
        impl<T> MapArray<T> for [T; $count] {
            type Of<U> = [U; $count];

            #[inline(always)]
            fn map_array<U>(self, mut f: impl FnMut(T) -> U) -> [U; $count] {
                let [$($item),*] = self;
                [$(f($item)),*]
            }
        }
    )*};
}

map_arrays! { 2: a b; 3: a b c; 4: a b c d; }
