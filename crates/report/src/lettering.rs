//! Letters on pictures: Noto Sans Mono, rastered beforehand; ASCII and Latin-1. One line at a time: no
//! wrapping, no kerning, no other scripts (a character without a bitmap is a question mark).

use image::{Rgb, RgbImage};
use noto_sans_mono_bitmap::{FontWeight, RasterHeight, RasterizedChar, get_raster};
use rasterproof_verify::judge::ascii::lines;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Size {
    /// Words beside a picture, numbers of rows and columns.
    Small,
    Heading,
}

/// Shades between paper and ink: few, so that a picture keeps a palette.
const SHADES: u32 = 4;

impl Size {
    /// Width and height of the cell of a character, in picture pixels.
    pub fn cell(self) -> [u32; 2] {
        match self {
            Self::Small => [7, 16],
            Self::Heading => [9, 20],
        }
    }

    /// The bitmap of a character, or that of a question mark.
    fn glyph(self, character: char) -> Option<RasterizedChar> {
        let raster = |drawn| match self {
            Self::Small => get_raster(drawn, FontWeight::Regular, RasterHeight::Size16),
            Self::Heading => get_raster(drawn, FontWeight::Bold, RasterHeight::Size20),
        };
        // The bitmaps of control characters are empty: they would vanish.
        Some(character).filter(|c| !c.is_control()).and_then(raster).or_else(|| raster('?'))
    }
}

/// Width of a line of text in picture pixels; the largest `u32` where it is wider.
pub fn width(text: &str, size: Size) -> u32 {
    u32::try_from(text.chars().count()).unwrap_or(u32::MAX).saturating_mul(size.cell()[0])
}

/// Writes a line of text with the left top corner of its first cell at `left_top`. What lies beyond
/// the picture is cut off.
pub fn write(image: &mut RgbImage, left_top: (i64, i64), text: &str, size: Size, ink: Rgb<u8>) {
    let [cell_width, cell_height] = size.cell();
    let (mut left, top) = left_top;
    for character in text.chars() {
        if left >= i64::from(image.width()) {
            break;
        }
        // How dark each pixel of the letter is, in few shades.
        let glyph = size.glyph(character);
        let share = |x: u32, y: u32| {
            let ink = glyph.as_ref().and_then(|glyph| glyph.pixel(x as usize, y as usize));
            (u32::from(ink.unwrap_or(0)) * SHADES + 127) / 255
        };
        for place in 0..cell_width * cell_height {
            let (x, y) = (place % cell_width, place / cell_width);
            let at = [left.saturating_add(x.into()), top.saturating_add(y.into())];
            let [Ok(at_x), Ok(at_y)] = at.map(u32::try_from) else { continue };
            // Letters may begin or end outside of the picture.
            let Some(pixel) = image.get_pixel_mut_checked(at_x, at_y) else { continue };
            let share = share(x, y);
            for (held, ink) in pixel.0.iter_mut().zip(ink.0) {
                let mixed = u32::from(*held) * (SHADES - share) + u32::from(ink) * share;
                *held = (mixed / SHADES) as u8;
            }
        }
        left = left.saturating_add(cell_width.into());
    }
}

/// The text in lines of at most `room` picture pixels, broken at spaces; a longer word has its own.
pub fn wrapped(text: &str, size: Size, room: u32) -> Vec<String> {
    lines(text, room, |line| width(line, size))
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAPER: Rgb<u8> = Rgb([255, 255, 255]);
    const INK: Rgb<u8> = Rgb([1, 2, 3]);

    fn drawn(sides: (u32, u32), left_top: (i64, i64), text: &str, size: Size) -> RgbImage {
        let mut image = RgbImage::from_pixel(sides.0, sides.1, PAPER);
        write(&mut image, left_top, text, size, INK);
        image
    }

    #[test]
    fn beyond_the_border_is_cut_off() {
        let whole = drawn((40, 24), (8, 4), "abc", Size::Small);
        for (dx, dy) in [(12, 0), (0, 6), (-20, -9), (30, 0)] {
            let part = drawn((40, 24), (8 + dx, 4 + dy), "abc", Size::Small);
            for (x, y, pixel) in part.enumerate_pixels() {
                let (from_x, from_y) = (i64::from(x) - dx, i64::from(y) - dy);
                let inside = (0..40).contains(&from_x) && (0..24).contains(&from_y);
                let expected =
                    if inside { *whole.get_pixel(from_x as u32, from_y as u32) } else { PAPER };
                assert_eq!(*pixel, expected, "({x}, {y}) moved by ({dx}, {dy})");
            }
        }
    }

    #[test]
    fn what_has_no_bitmap_is_a_question_mark_and_not_nothing() {
        for text in ["\u{4e09}", "\n"] {
            let marked = ["?", text].map(|text| drawn((7, 16), (0, 0), text, Size::Small));
            assert_eq!(marked[0], marked[1]);
            assert!(marked[1].pixels().any(|pixel| pixel.0[0] < 128));
        }
    }

    #[test]
    fn absurd_places_do_no_harm() {
        for at in [i64::MIN, -1, 0, i64::MAX] {
            let _ = [Size::Small, Size::Heading].map(|size| drawn((8, 8), (at, at), "wide", size));
        }
    }

    #[test]
    fn long_texts_are_broken_at_spaces() {
        let lines = wrapped("one two  three-and-more four", Size::Small, 7 * 9);
        assert_eq!(lines, ["one two", "three-and-more", "four"]);
        let chinese =
            |text, room| super::lines(text, room, rasterproof_verify::judge::ascii::columns);
        assert_eq!(chinese("像素在中心。答案是 12 个", 8), ["像素在中", "心。答案", "是 12 个"]);
        assert_eq!(chinese("像素在中心，", 10), ["像素在中", "心，"]);
    }
}
