//! The questions to the module as a whole: those of the playground, and those for a live figure, which is drawn from the
//! answers to others.

use serde::Deserialize;
use serde_json::{Value, json};

use crate::answer::answer_value;
use crate::figures;

#[derive(Deserialize)]
#[serde(tag = "ask", rename_all = "kebab-case")]
enum Request {
    /// The picture and the texts of a live figure for a position of its grips.
    Figure(figures::Ask),
}

/// The answer to a question; `{"error": ...}` to one that makes no sense or cannot be drawn.
pub fn answer(question: &str) -> String {
    let answer = serde_json::from_str(question).map_err(|error| error.to_string()).and_then(ask);
    answer.unwrap_or_else(|error| json!({ "error": error })).to_string()
}

fn ask(question: Value) -> Result<Value, String> {
    match question["ask"].as_str() {
        Some("figure") => {
            let Request::Figure(figure) =
                serde_json::from_value(question).map_err(|error| error.to_string())?;
            figure.answer()
        }
        Some("list") => {
            let mut list = answer_value(question)?;
            list["figures"] = json!(figures::list());
            Ok(list)
        }
        _ => answer_value(question),
    }
}
