//! How this program recognises a file that it wrote before: by a mark at one exact place of the file.
//!
//! A name that the program chooses may be that of somebody else's file, which must not be lost. The
//! mark stands where the format allows text that is not shown:
//!
//! | file | mark |
//! |---|---|
//! | PNG | a text chunk after the header: `Software`, `rasterproof` |
//! | GIF | a comment after the header and the colours of the whole file |
//! | SVG | a comment before the picture |
//! | HTML | a comment after the document type |
//!
//! The tables of the league are recognised by their first words, since they have no place for a mark.

use std::borrow::Cow;

/// Bytes of a file that hold its mark: the longest are the 781 bytes before that of a GIF.
pub(crate) const HEAD_BYTES: u64 = 1024;

const PNG: &[u8] = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR";
/// Signature, and the first chunk with its length, name and checksum.
const PNG_HEADER_BYTES: usize = 33;
/// A chunk: length, name, content, checksum.
const PNG_MARK: &[u8] = b"\0\0\0\x14tEXtSoftware\0rasterproof\xa5\x65\xcc\xec";
const GIF: &[u8] = b"GIF89a";
const GIF_MARK: &[u8] = b"\x21\xfe\x0brasterproof\0";
const SVG: &[u8] = b"<svg ";
const HTML: &[u8] = b"<!DOCTYPE html>\n";
const COMMENT: &[u8] = b"<!-- made by rasterproof -->\n";

/// The first words of `league.json` and of its two tables.
const LEAGUE: [&str; 3] =
    ["{\n  \"rasterproof\": \"", "Made by rasterproof ", "\u{7531} rasterproof "];

/// The mark of a file that begins so and where it stands, or nothing for a kind that has none.
fn place(head: &[u8]) -> Option<(usize, &'static [u8])> {
    if head.starts_with(PNG) && head.len() >= PNG_HEADER_BYTES {
        return Some((PNG_HEADER_BYTES, PNG_MARK));
    }
    if head.starts_with(GIF) && head.len() >= 13 {
        // The highest bit says whether there are colours, the lowest three how many.
        let flags = head[10];
        let colours = if flags & 0x80 == 0 { 0 } else { 2 << (flags & 7) };
        return Some((13 + 3 * colours, GIF_MARK)).filter(|(at, _)| *at <= head.len());
    }
    if head.starts_with(HTML) {
        return Some((HTML.len(), COMMENT));
    }
    (head.starts_with(SVG) || head.starts_with(COMMENT)).then_some((0, COMMENT))
}

/// Whether a file that begins so has the mark of this program.
pub(crate) fn is_marked(head: &[u8]) -> bool {
    LEAGUE.iter().any(|words| head.starts_with(words.as_bytes()))
        || place(head).is_some_and(|(at, mark)| head[at..].starts_with(mark))
}

/// The content of a file with its mark, where its kind has one.
pub(crate) fn marked(bytes: &[u8]) -> Cow<'_, [u8]> {
    match place(bytes) {
        Some((at, mark)) if !bytes[at..].starts_with(mark) => {
            Cow::Owned([&bytes[..at], mark, &bytes[at..]].concat())
        }
        _ => Cow::Borrowed(bytes),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A PNG of one grey pixel up to its first chunk of data, whose checksum no reader needs here.
    fn png() -> Vec<u8> {
        [PNG, b"\0\0\0\x01\0\0\0\x01\x08\0\0\0\0\x3a\x7e\x9b\x55", b"\0\0\0\x0aIDAT"].concat()
    }

    fn gif(flags: u8) -> Vec<u8> {
        let colours = if flags & 0x80 == 0 { 0 } else { 3 * (2 << (flags & 7)) };
        [b"GIF89a\x01\0\x01\0".as_slice(), &[flags, 0, 0], &vec![7; colours], b"\x21\xff"].concat()
    }

    #[test]
    fn every_kind_is_recognised_by_its_mark_alone() {
        let svg = b"<svg xmlns=\"http://www.w3.org/2000/svg\"></svg>".to_vec();
        let html = b"<!DOCTYPE html>\n<html lang=\"en\"></html>".to_vec();
        for bytes in [png(), gif(0), gif(0x80), gif(0xf7), svg, html] {
            assert!(!is_marked(&bytes));
            let with = marked(&bytes).into_owned();
            assert!(is_marked(&with) && is_marked(&with[..with.len().min(HEAD_BYTES as usize)]));
            // A second mark is not added, and nothing but the mark is.
            assert_eq!(marked(&with), with);
            let (at, mark) = place(&bytes).unwrap();
            assert_eq!([&with[..at], &with[at + mark.len()..]].concat(), bytes);
            // Somewhere else in the file it says nothing.
            assert!(!is_marked(&[&bytes[..], b"\n", mark].concat()));
            for cut in 0..bytes.len() {
                assert!(!is_marked(&marked(&bytes[..cut])) || cut >= at, "{cut}");
            }
        }
        for other in ["", "{}", "notes\n", "%PDF", "<!-- made by hand -->\n<svg></svg>"] {
            assert!(!is_marked(other.as_bytes()) && marked(other.as_bytes()) == other.as_bytes());
        }
    }

    /// The checksum of PNG, bit by bit as its specification defines it.
    #[test]
    fn the_chunk_of_a_png_has_its_checksum() {
        let (length, rest) = PNG_MARK.split_at(4);
        let (content, sum) = rest.split_at(rest.len() - 4);
        assert_eq!(length, ((content.len() - 4) as u32).to_be_bytes());
        let crc = content.iter().fold(!0u32, |crc, &byte| {
            (0..8).fold(crc ^ u32::from(byte), |c, _| (c >> 1) ^ (0xedb8_8320 * (c & 1)))
        });
        assert_eq!(sum, (!crc).to_be_bytes(), "{:02x?}", (!crc).to_be_bytes());
    }
}
