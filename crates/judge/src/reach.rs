//! How long the lines of a program may be, and the sides of its triangles: one that walks along each pixel or row, inside the
//! window or not, takes seconds for the longest ones, and would be found to hang.

use std::time::{Duration, Instant};

use super::ask::{Answer, Asked, Question, Subject};
use rasterproof_core::grid::{SUBPIXELS, SubpixelPoint};
use rasterproof_core::triangle::PixelPoint;

/// The first length that is tried, in steps, and by how much the next one is longer.
const FIRST: i32 = 1 << 10;
const GROWTH: i32 = 8;
/// The longest lines that are asked for: twice the domain, in pixels.
const MOST: i32 = 1 << 24;
/// The same of the sides of triangles.
const MOST_SIDE: i32 = MOST / 4;
/// What is too short to be told from the time of any answer.
const SHORT: Duration = Duration::from_millis(50);
/// How long the longest line of a run, or the largest triangle, may take to draw: a run has hundreds of them.
const ALLOWED: Duration = Duration::from_millis(30);

/// The longest line that a program draws in 30 ms, in steps; nothing where it draws any.
pub fn reach(program: &mut dyn Subject) -> Option<i32> {
    let declared = program.declared();
    let whole = declared.grid() == 1;
    let is_asked = declared.line;
    longest(program, is_asked, MOST, &|steps| {
        let ends = [PixelPoint::new(-steps / 2, 1), PixelPoint::new(steps / 2 - 1, 1)];
        vec![Asked::Line { ends, whole }]
    })
}

/// The same of the shorter sides of right-angled triangles, in pixels.
pub fn side(program: &mut dyn Subject) -> Option<i32> {
    let is_asked = program.declared().coverage;
    longest(program, is_asked, MOST_SIDE, &|side| {
        // Around the origin, so that most of the triangle lies outside of the window.
        let [low, high] = [-side / 2, side / 2].map(|v| v * SUBPIXELS);
        let [a, b, c] =
            [[low, low], [high, low], [low, high]].map(|[x, y]| SubpixelPoint::new(x, y));
        // Many draw one winding alone.
        [[a, b, c], [a, c, b]].map(Asked::Coverage).into()
    })
}

/// The length up to which a program answers soon, found by lengths that grow by [`GROWTH`]; nothing where it draws any length in
/// time,
/// or is not asked for such shapes.
fn longest(
    program: &mut dyn Subject,
    is_asked: bool,
    most: i32,
    question: &dyn Fn(i32) -> Vec<Asked>,
) -> Option<i32> {
    if !is_asked {
        return None;
    }
    // Nothing is asked beyond what it declares.
    let most = program.declared().range.map_or(most, |range| range.saturating_mul(2).min(most));
    let mut time = |steps: i32| {
        let questions = question(steps).into_iter();
        let questions: Vec<_> =
            questions.map(|of| Question { width: 16, height: 16, of }).collect();
        let start = Instant::now();
        let answers = program.ask(&questions, 1);
        let is_drawn = |answer: &Answer| matches!(answer, Answer::Line(_) | Answer::Coverage(_));
        let are_drawn = answers.len() == questions.len() && answers.iter().all(is_drawn);
        are_drawn.then(|| program.took().unwrap_or_else(|| start.elapsed()))
    };
    // The shortest length tells how long any answer takes.
    let usual = time(2)?;
    let mut steps = FIRST;
    while steps <= most {
        let Some(taken) = time(steps) else {
            // It was refused, or did not end in time.
            return (steps > FIRST).then_some(steps / GROWTH);
        };
        // Where the length begins to cost time, the cost of each step gives the length that may be asked.
        let more = taken.saturating_sub(usual);
        if more > SHORT && taken > 2 * usual {
            let each_s = more.as_secs_f64() / f64::from(steps);
            let reach = (ALLOWED.as_secs_f64() / each_s) as i32;
            return Some(1 << reach.clamp(FIRST, MOST).ilog2());
        }
        steps = steps.saturating_mul(GROWTH);
    }
    None
}
