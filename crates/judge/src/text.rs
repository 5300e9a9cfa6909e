//! Words of the line protocol: numbers in, requests and answers out, and text of others made safe
//! to show.

use rasterproof_core::grid::SUBPIXELS;
use rasterproof_host::text::printable_short;

/// A decimal number, as the nearest double, or a C99 hex float that a double holds exactly. NaN and infinities are
/// read; who asks refuses them by name.
pub fn number(word: &str) -> Option<f64> {
    // The sign comes first, for decimals and for hex floats alike.
    let (sign, digits) = match word.as_bytes().first()? {
        b'-' => (-1.0, &word[1..]),
        b'+' => (1.0, &word[1..]),
        _ => (1.0, word),
    };
    if digits.starts_with("0x") || digits.starts_with("0X") {
        let parse = |text: &str| hexf_parse::parse_hexf64(text, false).ok();
        // The parser wants small letters and an exponent; C99 prints one, scanf does not ask for it.
        let other = || {
            let lower = digits.to_ascii_lowercase();
            parse(&if lower.contains('p') { lower } else { lower + "p0" })
        };
        return parse(digits).or_else(other).map(|value| sign * value);
    }
    // After a sign comes no second sign.
    (!digits.starts_with(['-', '+']))
        .then(|| digits.parse::<f64>().ok().map(|v| sign * v))
        .flatten()
}

/// At most `most` characters of what a program wrote, as they can be shown.
pub fn printable(bytes: &[u8], most: usize) -> String {
    // A character has at most four bytes: what lies beyond is not looked at.
    let few = &bytes[..bytes.len().min(4 * most + 4)];
    printable_short(&String::from_utf8_lossy(few), most)
}

/// Reads the words of a line without keeping anything.
pub struct Words<'a>(pub &'a [u8]);

impl<'a> Words<'a> {
    /// The next word, between white space.
    pub fn word(&mut self) -> Option<&'a [u8]> {
        let start = self.0.iter().position(|b| !b.is_ascii_whitespace())?;
        let rest = &self.0[start..];
        let end = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        self.0 = &rest[end..];
        Some(&rest[..end])
    }

    /// The next word as a whole number; nothing where it is none or does not fit.
    pub fn int(&mut self) -> Option<i32> {
        let word = std::str::from_utf8(self.word()?).ok()?;
        word.parse().ok().filter(|_| !word.starts_with('+'))
    }

    /// The next word as a number, also where it is none or infinite: that is judged, and not refused.
    pub fn float(&mut self) -> Option<f64> {
        number(std::str::from_utf8(self.word()?).ok()?)
    }

    /// Whether no word is left.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.iter().all(u8::is_ascii_whitespace)
    }
}

/// A coordinate in subpixels as pixels. It prints exactly: no shorter decimal reads back as the same number.
pub fn px(sub: i32) -> f64 {
    f64::from(sub) / f64::from(SUBPIXELS)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_are_written_exactly() {
        for sub in [0, 1, -1, 128, -129, 255, 256, 4097, i32::MAX, i32::MIN] {
            let text = px(sub).to_string();
            let decimals = text.split_once('.').map_or(0, |(_, decimals)| decimals.len());
            // 1/256 has eight decimals.
            assert!(decimals <= 8 && !text.contains('e'), "{text}");
            assert_eq!(text.parse::<f64>().unwrap() * 256.0, f64::from(sub), "{text}");
        }
    }

    #[test]
    fn whole_numbers_are_read_or_refused() {
        let mut words = Words(b" 12 -7 2147483647 -2147483648 ");
        let read: Vec<_> = (0..4).map(|_| words.int()).collect();
        assert_eq!(read, [Some(12), Some(-7), Some(i32::MAX), Some(i32::MIN)]);
        assert!(words.is_empty());
        for bad in ["", "x", "1.5", "2147483648", "-", "99999999999", "1e3", "--1"] {
            assert_eq!(Words(bad.as_bytes()).int(), None, "{bad}");
        }
    }

    #[test]
    fn text_of_others_is_harmless() {
        let shown = printable("a\u{1b}[31m\u{202e}\n\u{7f}é".as_bytes(), 40);
        assert_eq!(shown, "a\\u{1b}[31m\\u{202e}\\n\\u{7f}é");
        assert_eq!(printable(b"abcdefg", 6), "abc...");
        assert!(printable(&[0xff; 1 << 20], 10).len() < 100);
    }
}
