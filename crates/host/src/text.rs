//! Text that other people wrote, made safe to show on a terminal.

use std::borrow::Cow;
use std::path::Path;

/// Whether a character changes what a terminal shows of the text around it: control characters,
/// marks of writing direction, line separators, and characters without width.
#[must_use]
pub fn is_hidden(character: char) -> bool {
    character.is_control()
        || matches!(character,
            '\u{ad}' | '\u{61c}' | '\u{180e}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}'
            | '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{fff9}'..='\u{fffb}' | '\u{e0000}'..='\u{e007f}')
}

/// Text in which what `escape` returns stands for each hidden character, but for those that are kept.
pub fn escaped<'a>(text: &'a str, kept: &str, escape: impl Fn(char) -> String) -> Cow<'a, str> {
    let is_wrong = |character: char| is_hidden(character) && !kept.contains(character);
    if !text.contains(is_wrong) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len() + 8);
    for character in text.chars() {
        if is_wrong(character) {
            shown += &escape(character);
        } else {
            shown.push(character);
        }
    }
    Cow::Owned(shown)
}

/// An escape that people read: `\t` and `\n`, and else as `\u{1b}`.
#[must_use]
pub fn in_words(character: char) -> String {
    match character {
        '\t' | '\n' | '\r' => character.escape_default().collect(),
        hidden => hidden.escape_unicode().collect(),
    }
}

/// One line of text as it can be shown.
#[must_use]
pub fn printable(text: &str) -> Cow<'_, str> {
    escaped(text, "", in_words)
}

/// Text of several lines as it can be shown: the ends of lines and tabs are kept.
#[must_use]
pub fn printable_lines(text: &str) -> Cow<'_, str> {
    escaped(text, "\n\t", in_words)
}

/// At most `most` characters of [`printable`] text; three dots stand for the rest.
#[must_use]
pub fn printable_short(text: &str, most: usize) -> String {
    // What is cut away need not be made printable: it can be long.
    let head: String = text.chars().take(most + 1).collect();
    let shown = printable(&head);
    if shown.chars().count() <= most {
        return shown.into_owned();
    }
    shown.chars().take(most.saturating_sub(3)).chain("...".chars()).collect()
}

/// A path as it can be shown. Bytes that are not UTF-8 stand there as U+FFFD.
#[must_use]
pub fn printable_path(path: &Path) -> String {
    printable(&path.to_string_lossy()).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hidden_characters_are_shown_as_escapes() {
        assert_eq!(printable("kerze \u{e9} \u{4e2d}"), "kerze \u{e9} \u{4e2d}");
        assert_eq!(printable("\u{1b}[31mred\u{9b}0m"), "\\u{1b}[31mred\\u{9b}0m");
        assert_eq!(printable("a\r\nb\tc\u{7f}"), "a\\r\\nb\\tc\\u{7f}");
        assert_eq!(printable("x\u{202e}gnp.\u{200b}"), "x\\u{202e}gnp.\\u{200b}");
        assert_eq!(printable_lines("a\tb\n\u{1b}c\n"), "a\tb\n\\u{1b}c\n");
        assert_eq!(printable_path(Path::new("a\nb")), "a\\nb");
    }

    #[test]
    fn long_text_is_cut() {
        assert_eq!(printable_short("abcdef", 6), "abcdef");
        assert_eq!(printable_short("abcdefg", 6), "abc...");
        assert_eq!(printable_short("\u{1b}\u{1b}", 6), "\\u{...");
    }
}
