//! Enums whose variants have names.

/// Declares an enum from the table of its variants and their names. `ALL` has the order of the table.
///
/// ```
/// rasterproof_core::named! {
///     /// The end of a line.
///     #[derive(Clone, Copy, Debug, PartialEq, Eq)]
///     pub enum End {
///         /// Where the line begins.
///         First = "the first end",
///         /// Where it ends.
///         Last = "the last end",
///     }
/// }
/// assert_eq!(End::ALL.map(End::name), ["the first end", "the last end"]);
/// ```
#[macro_export]
macro_rules! named {
    (
        $(#[$of_kind:meta])*
        pub enum $kind:ident { $($(#[$of_variant:meta])* $variant:ident = $name:literal,)+ }
    ) => {
        $(#[$of_kind])*
        pub enum $kind {
            $($(#[$of_variant])* $variant,)+
        }

        impl $kind {
            /// Every one, in the order of declaration.
            pub const ALL: [Self; [$($name),+].len()] = [$(Self::$variant),+];

            /// Its name.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name,)+
                }
            }
        }
    };
}
