//! The questions to the module as a whole: those of the playground, and those for a live figure, which is drawn from the
//! answers to others.

use serde::Deserialize;
use serde_json::{Value, json};

use crate::answer::answer_value;
use crate::figures;
use crate::no_answer::NoAnswer;

#[derive(Deserialize)]
#[serde(tag = "ask", rename_all = "kebab-case")]
enum Request {
    /// The picture and the texts of a live figure for a position of its grips.
    Figure(figures::Ask),
}

/// The answer to a question; `{"error": ...}` to one that makes no sense or cannot be drawn.
pub fn answer(question: &str) -> String {
    let answer = ask(question).unwrap_or_else(|error| json!({ "error": error.to_string() }));
    answer.to_string()
}

fn ask(question: &str) -> Result<Value, NoAnswer> {
    let question: Value = serde_json::from_str(question)?;
    match question["ask"].as_str() {
        Some("figure") => {
            let Request::Figure(figure) = serde_json::from_value(question)?;
            figure.answer()
        }
        // Figures are no concern of the engines, so their names join the list here.
        Some("list") => {
            let mut list = answer_value(question)?;
            list["figures"] = json!(figures::list());
            Ok(list)
        }
        _ => answer_value(question),
    }
}
