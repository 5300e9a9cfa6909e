//! Answers: how they are printed, how one is read, and whether it is right.

use super::{Language, Text};

/// What is right, of one of three kinds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Right {
    /// One of the choices, counted from 0.
    Choice(usize),
    Pixel([i32; 2]),
    /// A number, asked to so many decimals.
    Number {
        value: f64,
        /// Digits after the point.
        decimals: usize,
    },
}

/// An answer that was read, of the kind that the question has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Given {
    /// One of the choices, counted from 0.
    Choice(usize),
    Pixel([i32; 2]),
    Number(f64),
}

impl Right {
    /// The one choice that holds.
    ///
    /// # Panics
    /// Unless exactly one does: then the question is none.
    pub(super) fn only(holds: &[bool]) -> Self {
        let right: Vec<_> = (0..holds.len()).filter(|&i| holds[i]).collect();
        assert_eq!(right.len(), 1, "of {holds:?} exactly one choice is right");
        Self::Choice(right[0])
    }

    /// As it is printed: a letter, a pixel or a number.
    pub fn text(&self) -> String {
        match *self {
            Self::Choice(i) => letter(i).to_string(),
            Self::Pixel([x, y]) => format!("({x}, {y})"),
            Self::Number { value, decimals } => format!("{value:.decimals$}"),
        }
    }

    /// What a question adds about the form of its answer: the digits of a number that is not whole.
    pub fn form(&self, language: Language) -> String {
        match (*self, language) {
            (Self::Number { decimals: 0, .. } | Self::Choice(_) | Self::Pixel(_), _) => {
                String::new()
            }
            (Self::Number { decimals: 1, .. }, Language::English) => " (To 1 decimal.)".to_owned(),
            (Self::Number { decimals, .. }, Language::English) => {
                format!(" (To {decimals} decimals.)")
            }
            (Self::Number { decimals, .. }, Language::Chinese) => {
                format!("（取 {decimals} 位小数。）")
            }
        }
    }

    /// Whether what was given is right: for a number, to the digits that were asked for.
    #[must_use]
    pub fn accepts(&self, given: Given) -> bool {
        match (*self, given) {
            (Self::Choice(right), Given::Choice(i)) => i == right,
            (Self::Pixel(right), Given::Pixel(pixel)) => pixel == right,
            (Self::Number { value, decimals }, Given::Number(number)) => {
                // A number that was rounded to the last digit is at most half a unit off, and a little more for rounding here.
                let unit = 0.1f64.powi(decimals as i32);
                (number - value).abs() <= if decimals == 0 { 0.0 } else { unit * 0.5000001 }
            }
            _ => false,
        }
    }

    /// Reads an answer of this kind: for choices a letter, a number counted from 1, or the pixel that
    /// a choice names; a pixel as `3,3`; a number, also as a fraction.
    ///
    /// # Errors
    /// What would have been an answer.
    pub fn read(&self, word: &str, choices: &[Text], language: Language) -> Result<Given, String> {
        let word = word.trim();
        let remedy = match self {
            Self::Choice(_) => {
                let last = letter(choices.len().saturating_sub(1));
                // A choice that names a pixel may be given by that pixel, where it is no letter and no number.
                let by_letter = (0..choices.len()).find(|&i| {
                    word.eq_ignore_ascii_case(&letter(i).to_string()) || word == (i + 1).to_string()
                });
                let by_pixel = || {
                    let wanted = pixel(word)?;
                    choices.iter().position(|text| pixel(&text[0]) == Some(wanted))
                };
                if let Some(i) = by_letter.or_else(by_pixel) {
                    return Ok(Given::Choice(i));
                }
                let count = choices.len();
                [
                    format!("one of a to {last}, or 1 to {count}"),
                    format!("a 到 {last}，或 1 到 {count}"),
                ]
            }
            Self::Pixel(_) => match pixel(word) {
                Some(pixel) => return Ok(Given::Pixel(pixel)),
                None => ["a pixel, column and row, such as 3,3", "像素的列和行，例如 3,3"]
                    .map(str::to_owned),
            },
            Self::Number { .. } => match number(word) {
                Some(number) => return Ok(Given::Number(number)),
                None => ["a number, such as 12, 0.25 or 1/4", "一个数，例如 12、0.25 或 1/4"]
                    .map(str::to_owned),
            },
        };
        // What would have been an answer, in the language of whoever gave this one.
        let remedy = &remedy[language as usize];
        Err(match language {
            Language::English => format!("'{word}' is no answer here; give {remedy}"),
            Language::Chinese => format!("这里不能答“{word}”；请答：{remedy}"),
        })
    }
}

/// The letter of a choice: a for the first one.
pub fn letter(choice: usize) -> char {
    (b'a' + choice as u8) as char
}

/// `3,3` or `(3, 3)`.
pub(super) fn pixel(word: &str) -> Option<[i32; 2]> {
    let word = word.trim();
    let word = word.strip_prefix('(').and_then(|w| w.strip_suffix(')')).unwrap_or(word);
    let (x, y) = word.split_once(',')?;
    Some([x.trim().parse().ok()?, y.trim().parse().ok()?])
}

/// A number, or a fraction of two; nothing for what is infinite or no number.
fn number(word: &str) -> Option<f64> {
    let value = match word.split_once('/') {
        Some((over, under)) => {
            over.trim().parse::<f64>().ok()? / under.trim().parse::<f64>().ok()?
        }
        None => word.parse().ok()?,
    };
    value.is_finite().then_some(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn answers_are_read_and_judged() {
        let pixels: &[Text] = &["(0, 3)", "(2, 2)"].map(|text| [text, text].map(str::to_owned));
        let choice = Right::only(&[false, true]);
        for word in ["b", "B", "2", "2,2", " (2, 2) "] {
            assert!(
                choice.accepts(choice.read(word, pixels, Language::English).unwrap()),
                "{word}"
            );
        }
        assert!(!choice.accepts(choice.read("0,3", pixels, Language::English).unwrap()));
        for word in ["c", "0", "3", "1,1", "", "bb"] {
            let refusal = |language| choice.read(word, pixels, language).unwrap_err();
            assert!(refusal(Language::English).contains("a to b"), "{word}");
            assert!(refusal(Language::Chinese).contains("a 到 b"), "{word}");
        }
        let third = Right::Number { value: 1.0 / 3.0, decimals: 2 };
        let right = ["1/3", "0.33", "0.333", ".334"];
        let read = |answer: &Right, word: &str| answer.read(word, &[], Language::English);
        let given = |word: &str| read(&third, word).unwrap();
        assert!(right.iter().all(|word| third.accepts(given(word))));
        assert!(!["0.32", "0.34", "-1/3", "33"].iter().any(|word| third.accepts(given(word))));
        assert!(["1/0", "nan", "inf", "x", "3,3"].iter().all(|w| read(&third, w).is_err()));
        let whole = Right::Number { value: 4.0, decimals: 0 };
        assert!(whole.accepts(Given::Number(4.0)) && !whole.accepts(Given::Number(4.4)));
        let pixel = Right::Pixel([4, -2]);
        assert!(pixel.accepts(read(&pixel, "4,-2").unwrap()));
        assert!(!pixel.accepts(read(&pixel, "-2,4").unwrap()) && read(&pixel, "4").is_err());
    }

    #[test]
    #[should_panic(expected = "exactly one")]
    fn two_right_choices_are_no_question() {
        let _ = Right::only(&[true, true]);
    }
}
