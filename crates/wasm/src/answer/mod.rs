//! What the playground asks, and the answers: JSON in, JSON out, computed by the engines themselves.
//!
//! The page draws and listens; whatever it shows comes from here. The same functions answer natively,
//! which is how the tests hold the compiled module to the program.

mod digest;
mod explain_pixel;
mod lines;
mod picture;
mod pipeline;
mod pixels;
mod search;
mod values;

pub(crate) use lines::{Pen, strangers};
pub(crate) use picture::line_between;
pub(crate) use pixels::cover;
pub(crate) use values::along;

use serde::Deserialize;
use serde_json::Value;

use crate::no_answer::NoAnswer;

/// A question; what each answer holds stands beside the function that makes it.
#[derive(Deserialize)]
#[serde(tag = "ask", rename_all = "kebab-case", deny_unknown_fields)]
enum Request {
    /// Names of everything there is to choose from.
    List,
    Named {
        name: String,
    },
    Generated {
        family: String,
        seed: u64,
        index: u64,
    },
    /// Triangles as several engines cover them.
    Draw(pixels::Draw),
    /// Three edge values, two walks and the values at one pixel.
    Look(explain_pixel::Look),
    /// Lines as several drawers set their pixels, in order.
    Lines(lines::Lines),
    /// The values of triangles, pixel by pixel.
    Values(values::Values),
    /// Which triangle is in front, by depth and by order.
    Depth(values::Front),
    /// How far along an edge in space, for each pixel along it on the screen.
    Along(values::Along),
    /// What the near plane leaves of a triangle.
    Near(pipeline::Near),
    /// Samples covered in each pixel, for 1, 4 and 16 of them.
    Samples(pipeline::Samples),
    Cull(pipeline::Culling),
    /// The next generated case on which somebody disagrees with the oracle.
    Search(search::Search),
    /// The ever smaller cases that still fail.
    Shrink(search::Shrink),
    /// A digest of what the engines draw of the first cases of all families.
    Digest {
        seed: u64,
        cases: u64,
    },
    /// The batches that a browser's GPU is to draw, in order.
    GpuPlan(crate::gpu::Plan),
    /// The vertices that the GPU draws into one picture.
    GpuBatch(Box<crate::gpu::Batch>),
    /// The verdict about the pixels that the GPU drew in one picture.
    GpuJudge(Box<crate::gpu::Judge>),
    /// Why triangles are drawn wrongly, picture by picture.
    GpuCause(Box<crate::gpu::Judge>),
    /// The smaller cases that the GPU draws next, of a search for the smallest one that fails.
    GpuSmaller(Box<crate::gpu::Judge>),
}

/// The answer to a question, or why it makes no sense or cannot be drawn.
pub(crate) fn answer_value(question: Value) -> Result<Value, NoAnswer> {
    match serde_json::from_value(question)? {
        Request::List => Ok(search::list()),
        Request::Named { name } => search::named(&name),
        Request::Generated { family, seed, index } => search::generated(&family, seed, index),
        Request::Draw(draw) => draw.answer(),
        Request::Look(look) => look.answer(),
        Request::Lines(lines) => lines.answer(),
        Request::Values(values) => values.answer(),
        Request::Depth(front) => front.answer(),
        Request::Along(along) => along.answer(),
        Request::Near(near) => near.answer(),
        Request::Samples(samples) => samples.answer(),
        Request::Cull(culling) => culling.answer(),
        Request::Search(search) => search.answer(),
        Request::Shrink(shrink) => shrink.answer(),
        Request::Digest { seed, cases } => Ok(digest::digest(seed, cases)),
        Request::GpuPlan(plan) => Ok(plan.answer()),
        Request::GpuBatch(batch) => batch.answer(),
        Request::GpuJudge(judge) => judge.answer(),
        Request::GpuCause(judge) => judge.cause(),
        Request::GpuSmaller(judge) => judge.smaller(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::question::answer;
    use serde_json::json;

    fn asked(question: &Value) -> Value {
        serde_json::from_str(&answer(&question.to_string())).unwrap()
    }

    /// T2, a square on centres in two triangles: 25 pixels; the strict rule misses those on edges, the
    /// inclusive one hits the diagonal twice.
    #[test]
    fn rules_of_a_square_by_hand() {
        let case = asked(&json!({ "ask": "named", "name": "T2" }))["picture"].clone();
        let by = ["scanline", "exclusive-edges", "inclusive-edges"];
        let drawn = asked(&json!({ "ask": "draw", "picture": case, "by": by }));
        let panel = |i: usize| &drawn["panels"][i];
        assert_eq!(panel(0)["covered"], 25);
        assert_eq!((&panel(0)["missing"], &panel(0)["extra"]), (&json!(0), &json!(0)));
        // Of 6 x 6 samples on or in the square, 4 x 4 are inside, 4 of them on the diagonal.
        assert_eq!(panel(1)["covered"], 12);
        assert_eq!(panel(2)["covered"], 36);
        assert_eq!(panel(2)["hits"].as_str().unwrap().matches('2').count(), 6);
        assert_eq!(panel(2)["twice"], 6);
        // Off the lattice the rules are the same ones.
        let mut free = case;
        free["snap"] = json!(false);
        let exact = asked(&json!({ "ask": "draw", "picture": free, "by": by }));
        assert_eq!(exact["panels"], drawn["panels"]);
    }

    /// Questions that make no sense get an answer that says so.
    #[test]
    fn bad_questions_are_refused() {
        let error = |text: &str| {
            let answer: Value = serde_json::from_str(&answer(text)).unwrap();
            answer["error"].as_str().unwrap_or_else(|| panic!("{text}: {answer}")).to_owned()
        };
        error("");
        error(r#"{"ask":"fly"}"#);
        assert!(error(r#"{"ask":"named","name":"T99"}"#).contains("T99"));
        let draw = |window: &str, x: &str, by: &str| {
            format!(
                r#"{{"ask":"draw","by":["{by}"],"picture":{{"window":{window},"snap":true,
                "triangles":[[{{"x":{x},"y":0}},{{"x":4,"y":0}},{{"x":0,"y":4}}]]}}}}"#
            )
        };
        assert!(error(&draw("[0,0,9999,8]", "0", "scanline")).contains("window"));
        assert!(error(&draw("[0,0,8,8]", "1e9", "scanline")).contains("domain"));
        let panels: Value =
            serde_json::from_str(&answer(&draw("[0,0,8,8]", "0", "panics-on-flat-bottom")))
                .unwrap();
        assert!(panels["panels"][0]["refused"].is_string(), "planted panics stay out: {panels}");
    }

    /// The search finds what a specimen is known for, and shrinking ends in a smaller case that fails: on the lattice, and
    /// off it, where an edge is missed by less than floats can tell.
    #[test]
    fn a_specimen_is_found_and_shrunk() {
        for (family, snap) in [("half-integer", true), ("f32-tie", false)] {
            let found = asked(&json!({ "ask": "search", "by": "games101-strict",
                "family": family, "seed": 1, "from": 0, "count": 200 }));
            assert!(found["found"].is_u64(), "{found}");
            let shrunk = asked(&json!({ "ask": "shrink", "by": "games101-strict",
                "picture": found["picture"] }));
            let steps = shrunk["steps"].as_array().unwrap();
            let last = steps.last().unwrap();
            assert!(steps.len() > 1 && last["snap"] == snap, "{shrunk}");
            let drawn =
                asked(&json!({ "ask": "draw", "picture": last, "by": ["games101-strict"] }));
            assert!(drawn["panels"][0]["missing"].as_u64().unwrap() > 0, "{drawn}");
        }
    }

    /// By hand: the sample (1/2, 1/2) lies 2^-60 px from an edge, which f64 cannot tell from on it.
    #[test]
    fn a_pixel_is_explained_off_the_lattice() {
        let corner = |x: f64, y: f64| json!({ "x": x, "y": y });
        let x = 2f64.powi(-60);
        let picture = json!({ "window": [0, 0, 4, 4], "snap": false,
            "triangles": [[corner(x, 0.0), corner(3.0, 0.0), corner(3.0, 3.0)]] });
        let looked = asked(&json!({ "ask": "look", "picture": picture, "px": [0, 0] }));
        let triangle = &looked["triangles"][0];
        let edge = &triangle["edges"][1];
        assert_eq!((&edge["ends"], &edge["byFilter"]), (&json!([2, 0]), &json!(false)));
        assert_eq!((&edge["sign"], &triangle["covered"]), (&json!(-1), &json!(false)), "{looked}");
        let crossing = &triangle["crossings"][0];
        assert_eq!((&crossing["by_filter"], &crossing["column"]), (&json!(false), &json!(1)));
    }

    /// The digest depends on the seed and on nothing else.
    #[test]
    fn digest_is_of_the_cases() {
        let digest = |seed| digest::digest(seed, 40)["digest"].clone();
        assert_eq!(digest(1), digest(1));
        assert_ne!(digest(1), digest(2));
    }
}
