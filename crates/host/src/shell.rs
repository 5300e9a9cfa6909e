//! Commands that a reader may copy into a shell.

use std::borrow::Cow;
use std::ffi::OsStr;

use crate::text::{escaped, is_hidden};

/// One word as a POSIX shell reads it back: as it is where it needs no quotes, else in single
/// quotes. A word with hidden characters, or that is not UTF-8, is written as `$'...'`, which bash, zsh and
/// ksh read.
#[must_use]
pub fn quote(word: &(impl AsRef<OsStr> + ?Sized)) -> Cow<'_, str> {
    let word = word.as_ref();
    if let Some(text) = word.to_str().filter(|text| !text.contains(is_hidden)) {
        let is_plain = |c: char| c.is_alphanumeric() || "-_./,:=+@%^".contains(c);
        if !text.is_empty() && !text.starts_with('=') && text.chars().all(is_plain) {
            return Cow::Borrowed(text);
        }
        return Cow::Owned(format!("'{}'", text.replace('\'', r"'\''")));
    }
    // Text as it is, but for what has to be escaped; of bytes that are no text each in digits.
    let mut shown = String::new();
    for chunk in word.as_encoded_bytes().utf8_chunks() {
        let text = chunk.valid().replace('\\', r"\\").replace('\'', r"\'");
        shown += &escaped(&text, "", |hidden| octal(hidden.encode_utf8(&mut [0; 4]).as_bytes()));
        shown += &octal(chunk.invalid());
    }
    Cow::Owned(format!("$'{shown}'"))
}

/// Three octal digits for each byte, so that a digit that follows cannot be taken for a fourth.
fn octal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("\\{byte:03o}")).collect()
}

/// A command line whose words are read back as they are.
#[must_use]
pub fn line(words: impl IntoIterator<Item = impl AsRef<OsStr>>) -> String {
    words.into_iter().map(|word| quote(&word).into_owned()).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_quoted_where_a_shell_needs_it() {
        assert_eq!(quote("a/b-1.snap"), "a/b-1.snap");
        assert_eq!(quote("--shard=1/2"), "--shard=1/2");
        assert_eq!(quote(""), "''");
        assert_eq!(quote("a'; touch PWNED; '.snap"), r"'a'\''; touch PWNED; '\''.snap'");
        assert_eq!(quote("$(x) `y` ~ * # !"), "'$(x) `y` ~ * # !'");
        assert_eq!(quote("\u{1b}1'"), "$'\\0331\\''");
        assert_eq!(line(["rm", "a b"]), "rm 'a b'");
        #[cfg(unix)]
        {
            use std::os::unix::ffi::OsStrExt as _;
            assert_eq!(quote(OsStr::from_bytes(b"a' \xff1")), r"$'a\' \3771'");
        }
    }

    #[cfg(unix)]
    #[test]
    fn a_shell_reads_the_same_word() {
        for word in [
            "",
            "a b",
            "a'b",
            "\\",
            "$x",
            "~",
            "{a,b}",
            "a\tb\n",
            "\u{1b}[31m'7",
            "\u{4e2d}\u{200b}",
        ] {
            let script = format!("printf %s {}", quote(word));
            let output = std::process::Command::new("bash").args(["-c", &script]).output();
            // Not every machine has bash.
            let Ok(output) = output else { return };
            assert_eq!(String::from_utf8(output.stdout).unwrap(), word, "{script}");
        }
    }
}
