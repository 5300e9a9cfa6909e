//! Letters on pictures, from a fixed bitmap of 8 x 8 for each character; ASCII and Latin-1. One line
//! at a time: no wrapping, no kerning, no other scripts (a character without a bitmap is a box).

use font8x8::{BASIC_FONTS, LATIN_FONTS, UnicodeFonts as _};
use image::{Rgb, RgbImage};

/// Side of a character's cell at scale 1, in picture pixels.
pub const CELL: u32 = 8;
/// What stands for a character that has no bitmap.
const BOX: [u8; CELL as usize] = [0x7f, 0x41, 0x41, 0x41, 0x41, 0x41, 0x7f, 0];

/// Width of a line of text in picture pixels; the largest `u32` where it is wider.
#[must_use]
pub fn width(text: &str, scale: u32) -> u32 {
    let count = u32::try_from(text.chars().count()).unwrap_or(u32::MAX);
    count.saturating_mul(CELL).saturating_mul(scale)
}

/// Writes a line of text with the left top corner of its first cell at `left_top`, each bitmap pixel
/// a square of `scale` picture pixels. What lies beyond the picture is cut off. Returns [`width`].
pub fn write(
    image: &mut RgbImage,
    left_top: (i64, i64),
    text: &str,
    scale: u32,
    ink: Rgb<u8>,
) -> u32 {
    let scale_px = i64::from(scale);
    let (mut left, top) = left_top;
    for character in text.chars() {
        if left >= i64::from(image.width()) {
            break;
        }
        for (y, row) in (0..).zip(glyph(character)) {
            for x in (0..i64::from(CELL)).filter(|x| row >> x & 1 == 1) {
                let at = |start: i64, cell: i64| start.saturating_add(cell * scale_px);
                square(image, (at(left, x), at(top, y)), scale_px, ink);
            }
        }
        left = left.saturating_add(i64::from(CELL) * scale_px);
    }
    width(text, scale)
}

/// Rows from the top; the lowest bit is the leftmost pixel.
fn glyph(character: char) -> [u8; CELL as usize] {
    // The bitmaps of control characters are empty: they would vanish.
    let drawn = Some(character).filter(|c| !c.is_control());
    drawn.and_then(|c| BASIC_FONTS.get(c).or_else(|| LATIN_FONTS.get(c))).unwrap_or(BOX)
}

fn square(image: &mut RgbImage, left_top: (i64, i64), side: i64, ink: Rgb<u8>) {
    let within = |start: i64, size: u32| {
        let limit = |v: i64| v.clamp(0, size.into()) as u32;
        limit(start)..limit(start.saturating_add(side))
    };
    for y in within(left_top.1, image.height()) {
        for x in within(left_top.0, image.width()) {
            image.put_pixel(x, y, ink);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAPER: Rgb<u8> = Rgb([255, 255, 255]);
    const INK: Rgb<u8> = Rgb([1, 2, 3]);

    fn drawn(size: (u32, u32), left_top: (i64, i64), text: &str, scale: u32) -> RgbImage {
        let mut image = RgbImage::from_pixel(size.0, size.1, PAPER);
        assert_eq!(write(&mut image, left_top, text, scale, INK), width(text, scale));
        image
    }

    fn rows(image: &RgbImage) -> Vec<String> {
        let mark = |p: &Rgb<u8>| if *p == INK { '#' } else { '.' };
        image.rows().map(|row| row.map(mark).collect()).collect()
    }

    #[test]
    fn an_l_is_an_l_and_stands_upright() {
        let expected = [
            "####....", ".##.....", ".##.....", ".##.....", ".##...#.", ".##..##.", "#######.",
            "........",
        ];
        assert_eq!(rows(&drawn((8, 8), (0, 0), "L", 1)), expected);
    }

    #[test]
    fn a_scale_repeats_each_pixel() {
        let (small, large) = (drawn((16, 8), (0, 0), "aé", 1), drawn((48, 24), (0, 0), "aé", 3));
        for (x, y, pixel) in large.enumerate_pixels() {
            assert_eq!(pixel, small.get_pixel(x / 3, y / 3), "({x}, {y})");
        }
    }

    #[test]
    fn beyond_the_border_is_cut_off() {
        let whole = drawn((40, 16), (8, 4), "abc", 1);
        for (dx, dy) in [(12, 0), (0, 6), (-20, -9), (30, 0)] {
            let part = drawn((40, 16), (8 + dx, 4 + dy), "abc", 1);
            for (x, y, pixel) in part.enumerate_pixels() {
                let (from_x, from_y) = (i64::from(x) - dx, i64::from(y) - dy);
                let inside = (0..40).contains(&from_x) && (0..16).contains(&from_y);
                let expected =
                    if inside { *whole.get_pixel(from_x as u32, from_y as u32) } else { PAPER };
                assert_eq!(*pixel, expected, "({x}, {y}) moved by ({dx}, {dy})");
            }
        }
    }

    #[test]
    fn what_has_no_bitmap_is_a_box_and_not_nothing() {
        let boxed = drawn((8, 8), (0, 0), "\u{4e09}", 1);
        assert_eq!(rows(&boxed)[..2], ["#######.", "#.....#."]);
        assert_eq!(drawn((8, 8), (0, 0), "\n", 1), boxed);
        assert_ne!(drawn((8, 8), (0, 0), "B", 1), boxed);
    }

    #[test]
    fn absurd_places_and_scales_do_no_harm() {
        for at in [i64::MIN, -1, 0, i64::MAX] {
            for scale in [0, 1, u32::MAX] {
                drawn((8, 8), (at, at), "wide", scale);
            }
        }
        assert_eq!(width("ab", u32::MAX), u32::MAX);
        assert_eq!(rows(&drawn((8, 8), (0, 0), "L", 0)).concat().find('#'), None);
        // One pixel of the letter covers the whole picture.
        assert_eq!(rows(&drawn((2, 2), (0, 0), "L", 99)), ["##", "##"]);
    }
}
