//! Numbers, plurals, verdicts and how near a value came to its bound, in words.

/// With commas between groups of three digits.
pub fn thousands(n: u64) -> String {
    let digits = n.to_string();
    // From the right, so that the first group is the short one.
    let groups = digits.as_bytes().rchunks(3).rev();
    groups.map(|group| String::from_utf8_lossy(group)).collect::<Vec<_>>().join(",")
}

/// A text whose whole numbers have commas, as [`thousands`] writes them. Numbers that are parts of words, such as `f64` and `fan#2000`, of
/// fractions and of numbers that have commas already stay as they are.
pub fn grouped(text: &str) -> String {
    let (mut out, mut rest) = (String::new(), text);
    while let Some(start) = rest.find(|c: char| c.is_ascii_digit()) {
        let digits: String = rest[start..].chars().take_while(char::is_ascii_digit).collect();
        out += &rest[..start];
        rest = &rest[start + digits.len()..];
        // What stands before and after it says whether it is a number by itself.
        let is_part = out.ends_with(|c: char| c.is_alphanumeric() || ".,_#/^=".contains(c))
            || rest.starts_with(|c: char| {
                c.is_alphabetic()
                    || "_/,.".contains(c) && rest[1..].starts_with(|c: char| c.is_alphanumeric())
            });
        match digits.parse() {
            Ok(number) if !is_part => out += &thousands(number),
            _ => out += &digits,
        }
    }
    out + rest
}

/// The same for a text of a page's data.
pub fn serialize_grouped<S: serde::Serializer>(
    text: &str,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(&grouped(text))
}

/// A number with what is counted: `1 kind`, `2 kinds`.
pub fn count(number: u64, one: &str, several: &str) -> String {
    format!("{} {}", thousands(number), noun(number, one, several))
}

/// The noun behind a number: the singular behind 1 alone.
pub fn noun<'a>(number: u64, one: &'a str, several: &'a str) -> &'a str {
    if number == 1 { one } else { several }
}

/// The verdict of a comparison in a word.
pub fn word(agrees: bool) -> &'static str {
    if agrees { "AGREES" } else { "DISAGREES" }
}

/// The same for two programs, neither of which is right by definition.
pub fn same(agrees: bool) -> &'static str {
    if agrees { "SAME" } else { "DIFFERENT" }
}

/// A tick or a cross, coloured where that can be seen.
pub fn mark(is_right: bool, colour: bool) -> &'static str {
    match (is_right, colour) {
        (true, false) => "✓",
        (true, true) => "\x1b[32m✓\x1b[0m",
        (false, false) => "✗",
        (false, true) => "\x1b[1;31m✗\x1b[0m",
    }
}

/// How near a difference of values came to the bound that is derived for it.
pub fn of_bound(worst: f64) -> String {
    match worst {
        w if w <= 1.0 => format!("at most {:.0}% of the bound", (100.0 * w).ceil()),
        w if w < 1e4 => format!("up to {w:.1} times the bound"),
        w => format!("up to {w:.0e} times the bound"),
    }
}

/// A number in less than `width` characters: three digits where these fit.
pub fn number(value: f64, width: usize) -> String {
    let digits = if width < 8 { 0 } else { 1 };
    match value.abs() {
        0.0 => "0".to_owned(),
        v if !v.is_finite() => "inf".to_owned(),
        v if v < 99_999.5 && v.fract() == 0.0 => format!("{value:.0}"),
        v if v >= 99_999.5 => format!("{value:.*e}", digits),
        v if v >= 99.95 => format!("{value:.0}"),
        v if v >= 9.995 => format!("{value:.1}"),
        v if v >= 0.0995 => format!("{value:.2}"),
        v if v >= 0.000_995 && width >= 8 => format!("{value:.4}"),
        _ => format!("{value:.*e}", digits),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_numbers_are_grouped() {
        let sentence = "16111 wrong pixels in 10774 triangles, 8,152 of 8335, and 0 lines.";
        let right = "16,111 wrong pixels in 10,774 triangles, 8,152 of 8,335, and 0 lines.";
        assert_eq!(grouped(sentence), right);
        for kept in ["0.12345", "f64x16000", "fan#2000", "1e2222", "1/65536", "2^14000", "12345.5"]
        {
            assert_eq!(grouped(kept), kept);
        }
    }

    #[test]
    fn digits_in_groups() {
        assert_eq!([0, 999, 1000, 1_234_567].map(thousands), ["0", "999", "1,000", "1,234,567"]);
    }

    #[test]
    fn bounds_in_words() {
        assert_eq!(of_bound(0.034), "at most 4% of the bound");
        assert_eq!(of_bound(1.0), "at most 100% of the bound");
        assert_eq!(of_bound(2.5), "up to 2.5 times the bound");
        assert_eq!(of_bound(f64::INFINITY), "up to inf times the bound");
    }

    #[test]
    fn numbers_are_short() {
        for (value, text) in [
            (0.0, "0"),
            (0.1234, "0.12"),
            (12.34, "12.3"),
            (1234.4, "1234"),
            (0.0012, "0.0012"),
            (1.28e7, "1.3e7"),
            (3.2e-8, "3.2e-8"),
            (0.5, "0.50"),
            (99.97, "100"),
        ] {
            assert_eq!(number(value, 10), text);
        }
        assert_eq!(number(1.28e7, 7), "1e7");
        for exponent in -300..300 {
            assert!(number(9.996 * 10f64.powi(exponent), 7).len() <= 6);
        }
    }
}
