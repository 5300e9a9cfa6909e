//! The two line drawers. Like the two rasterizers they are strangers to each other, and to the
//! oracle: each derives its own pixels, its own way of entering the window, its own weights.

pub mod bresenham;
pub mod dda;
