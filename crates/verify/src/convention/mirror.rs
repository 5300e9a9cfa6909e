//! Pictures that come out turned over: a y axis that points up where rows are stored, x and y
//! exchanged. Taken back before anything is compared.

use rasterproof_core::grid::PixelRect;

rasterproof_core::named! {
    /// How the whole picture is turned over, about the middle of its window.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
    pub enum Mirror {
        None = "",
        /// Row y is row height - 1 - y.
        UpsideDown = "draws its picture upside down, ",
        /// Column x is column width - 1 - x.
        LeftToRight = "draws its picture with left and right exchanged, ",
        HalfTurn = "draws its picture turned by half a turn, ",
        Exchanged = "draws its picture with x and y exchanged, ",
    }
}

impl Mirror {
    /// Where the pixel that belongs at (x, y) is drawn. Its own inverse.
    pub(super) fn at(self, x: i32, y: i32, window: PixelRect) -> [i32; 2] {
        let [across, down] = [window.x0 + window.x1 - 1 - x, window.y0 + window.y1 - 1 - y];
        match self {
            Self::None => [x, y],
            Self::UpsideDown => [x, down],
            Self::LeftToRight => [across, y],
            Self::HalfTurn => [across, down],
            Self::Exchanged => [y, x],
        }
    }

    /// The window in which belongs what is drawn in `window`.
    pub(super) fn window(self, window: PixelRect) -> PixelRect {
        match self {
            Self::Exchanged => {
                PixelRect { x0: window.y0, y0: window.x0, x1: window.y1, y1: window.x1 }
            }
            _ => window,
        }
    }
}
