//! How long the lines of a program may be: one that walks along each pixel, inside the window or not, takes seconds for the
//! longest ones, and would be found to hang.

use std::time::{Duration, Instant};

use super::ask::{Answer, Asked, Question, Subject};
use rasterproof_core::triangle::PixelPoint;

/// The first length that is tried, in steps, and by how much the next one is longer.
const FIRST: i32 = 1 << 10;
const GROWTH: i32 = 8;
/// No line is longer: twice the domain.
const MOST: i32 = 1 << 24;
/// What is too short to be told from the time of any answer.
const SHORT: Duration = Duration::from_millis(50);
/// How long the longest line of a run may take to draw: a run has hundreds of them.
const ALLOWED: Duration = Duration::from_millis(30);

/// The longest line that a program draws in 30 ms, in steps; nothing where it draws any.
pub fn reach(program: &mut dyn Subject) -> Option<i32> {
    let declared = program.declared();
    if !declared.line {
        return None;
    }
    let most = declared.range.map_or(MOST, |range| range.saturating_mul(2));
    let whole = declared.grid() == 1;
    let mut time = |steps: i32| {
        let ends = [PixelPoint::new(-steps / 2, 1), PixelPoint::new(steps / 2 - 1, 1)];
        let question = Question { width: 16, height: 16, of: Asked::Line { ends, whole } };
        let start = Instant::now();
        let answers = program.ask(&[question], 1);
        matches!(answers.first(), Some(Answer::Line(_))).then(|| start.elapsed())
    };
    let usual = time(2)?;
    let mut steps = FIRST;
    while steps <= most {
        let Some(taken) = time(steps) else {
            // It was refused, or did not end in time.
            return (steps > FIRST).then_some(steps / GROWTH);
        };
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
