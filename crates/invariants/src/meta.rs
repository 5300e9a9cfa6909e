//! Invariants 43 to 45: the cases themselves, that a run can be repeated, and that one wrong pixel is
//! never forgiven. (42 is [`super::matrix`].)

use super::Outcome;
use super::implementations::Implementations;
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::Rasterize;
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::{PixelRect, SUBPIXELS, SubpixelPoint};
use rasterproof_core::parallel;
use rasterproof_core::random::Rng;
use rasterproof_core::triangle::{Corners, Span};
use rasterproof_registry::comparison::EnginesToJudge;
use rasterproof_verify::cases::named::plain_triangle;
use rasterproof_verify::cases::{self, Case, Family, Shape};
use rasterproof_verify::comparison::{self, Options, QUOTAS, is_sliver, oracle_coverage};
use rasterproof_verify::oracle::Oracle;
use rasterproof_verify::oracle::coverage::samples_on_boundary;

/// 43: ties in a quarter of the cases, slivers in a tenth, nothing to draw in a twentieth.
pub(super) fn quotas(subject: &Implementations, seed: u64, cases: u64) -> Outcome {
    let jobs = jobs_of(cases::triangles::FAMILIES.iter(), cases);
    let of_each = parallel::map(jobs.len(), |number| {
        let (family, index) = jobs[number];
        facts_of(&(subject.make_case)(family, seed, index))
    });
    let mut sums = [0; 3];
    for facts in of_each {
        for (sum, holds) in sums.iter_mut().zip(facts) {
            *sum += u64::from(holds);
        }
    }
    // Each quota is a share of all cases in percent.
    let total = jobs.len() as u64;
    for ((what, least), found) in QUOTAS.into_iter().zip(sums) {
        if found * 100 < least * total {
            return Err(format!("{what}: {found} of {total} cases, quota {least}%"));
        }
    }
    Ok(total)
}

/// Whether a case has a tie, whether it has a sliver, and whether nothing of it is drawn.
fn facts_of(case: &Case) -> [bool; 3] {
    let Shape::Triangles { list, .. } = &case.shape else { return [false, false, true] };
    let (mut has_tie, mut has_sliver) = (false, false);
    for triangle in list {
        has_tie |= samples_on_boundary(&triangle.corners(), case.window) > 0;
        has_sliver |= is_sliver(&triangle.corners());
    }
    [has_tie, has_sliver, oracle_coverage(list, case.window).covered() == 0]
}

/// The first cases of each family: the family, and the number of the case in it.
fn jobs_of<'a>(families: impl Iterator<Item = &'a Family>, cases: u64) -> Vec<(&'a Family, u64)> {
    let mut jobs = Vec::new();
    for family in families {
        for index in 0..cases {
            jobs.push((family, index));
        }
    }
    jobs
}

/// The bits of a case, folded (FNV-1a).
fn fold(case: &Case) -> u64 {
    // Every number of the case as a word of 64 bits, in a fixed order.
    let PixelRect { x0, y0, x1, y1 } = case.window;
    let mut words = vec![x0 as u64, y0 as u64, x1 as u64, y1 as u64];
    match &case.shape {
        Shape::Triangles { list, .. } => {
            for v in list.iter().flat_map(|t| t.vertices) {
                words.extend([v.position.x as u64, v.position.y as u64]);
                words.extend([v.depth, v.inv_w, v.varying.x, v.varying.y].map(f64::to_bits));
            }
        }
        Shape::Lines(lines) => {
            for end in lines.iter().flat_map(|line| line.ends) {
                words.extend([end.pixel.x as u64, end.pixel.y as u64]);
                words.extend([end.depth, end.varying.x, end.varying.y].map_array(f64::to_bits));
            }
        }
        Shape::Unsnapped { list, .. } => {
            words.extend(list.iter().flat_map(|t| t.px()).flatten().map(f64::to_bits));
        }
        Shape::Numbers { numbers, .. } => words.extend(numbers.iter().map(|n| n.to_bits())),
    }
    let mut hash: u64 = 0xcbf2_9ce4_8422_2325;
    for byte in words.into_iter().flat_map(u64::to_le_bytes) {
        hash = (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3);
    }
    hash
}

/// Families whose first cases of seed 1 are pinned, so that debug, release and every machine must
/// agree on them. Whoever changes one of these families on purpose writes the new number here.
const PINNED: [(&str, u64); 3] = [
    ("uniform", 0x1873_6895_9080_eecd),
    ("w-1e6", 0xab58_5cd8_ebb3_106e),
    ("line-far", 0xf683_e1cd_7255_458c),
];

/// 44: the same case for the same seed and number, whenever and on whichever thread it is made, and
/// the same verdict on one thread and on three.
pub(super) fn replay(subject: &Implementations, seed: u64, cases: u64) -> Outcome {
    let make = |seed, family: &Family, index| fold(&(subject.make_case)(family, seed, index));
    // All of them, so that one run shows every number to write down.
    let mut wrong = Vec::new();
    for (name, target) in PINNED {
        let Some(family) = cases::families().find(|family| family.name == name) else { continue };
        let mut actual: u64 = 0;
        for index in 0..8 {
            actual = actual.rotate_left(7) ^ make(1, family, index);
        }
        if actual != target {
            wrong.push(format!("{name} folds to {actual:#x}, pinned {target:#x}"));
        }
    }
    if !wrong.is_empty() {
        return Err(format!("the first cases of seed 1 have changed: {}", wrong.join("; ")));
    }
    // The same cases from the first to the last, from the last to the first, and on all threads.
    let jobs = jobs_of(cases::families(), cases);
    let (mut forward, mut backward) = (Vec::new(), Vec::new());
    for (family, index) in &jobs {
        forward.push(make(seed, family, *index));
    }
    for (family, index) in jobs.iter().rev() {
        backward.push(make(seed, family, *index));
    }
    backward.reverse();
    let parallel = parallel::map(jobs.len(), |i| make(seed, jobs[i].0, jobs[i].1));
    for (i, (family, index)) in jobs.iter().enumerate() {
        if forward[i] != backward[i] || forward[i] != parallel[i] {
            let name = family.name;
            return Err(format!("{name}#{index} of seed {seed} is another case next time"));
        }
    }
    // Then whole verdicts, in pools of one thread and of three.
    let options = Options::default().seed(seed).cases(cases.min(4));
    let mut verdicts = Vec::new();
    for threads in [1, 3] {
        // Where the system refuses threads, there is nothing to compare.
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let Ok(pool) = pool else { return Ok(0) };
        verdicts.push(pool.install(|| EnginesToJudge::all().judge(&options, &|_| ()).families));
    }
    if verdicts[0] != verdicts[1] {
        return Err(format!("seed {seed}: one thread and three give different verdicts"));
    }
    Ok(jobs.len() as u64)
}

/// An engine that draws as the oracle does, except for one pixel.
struct OneWrong {
    at: (i32, i32),
    /// How often that pixel is hit too often; -1 where it is not hit at all.
    by: i32,
}

impl Rasterize for OneWrong {
    fn cover(&self, corners: Corners, bounds: PixelRect, mut emit: impl FnMut(Span)) {
        // All spans are the oracle's but that one, which is cut in two or followed by one too many.
        let (x, y) = self.at;
        let here = Span { y_px: y, x0_px: x, x1_px: x + 1 };
        Oracle.spans(corners, bounds, &mut |span| {
            if self.by < 0 && span.y_px == y && (span.x0_px..span.x1_px).contains(&x) {
                // What is left of the span on both sides of the missing pixel.
                for part in [Span { x1_px: x, ..span }, Span { x0_px: x + 1, ..span }] {
                    if part.x0_px < part.x1_px {
                        emit(part);
                    }
                }
            } else {
                emit(span);
            }
        });
        for _ in 0..self.by {
            emit(here);
        }
    }
}

/// 45: one pixel of a frame of 128 to 1024 pixels a side is missing, extra or hit twice. Over N
/// pixels the peak signal-to-noise ratio is 10 log10 N, 42 to 60 dB: every metric that averages
/// would let it pass. The coverages are not allowed to agree, and a run is not either.
pub(super) fn metrics_report_only(subject: &Implementations, seed: u64, cases: u64) -> Outcome {
    let mut compared = 0;
    for index in 0..cases {
        let side = 128 << (index % 4);
        // Frames of 128, 256, 512 and 1024 px in turn.
        let mut rng = Rng::new("one-wrong-pixel", seed, index);
        // The upper left half of the frame.
        let far = side * SUBPIXELS;
        let corners = [[0, 0], [far, 0], [0, far]].map_array(|[x, y]| SubpixelPoint::new(x, y));
        let triangle = plain_triangle(corners);
        let window = PixelRect::window(side as u32, side as u32);
        let last = i64::from(side) - 1;
        let at = (rng.int(0, last) as i32, rng.int(0, last) as i32);
        // A pixel can be missing only where there is one.
        let is_covered = at.0 + at.1 < side - 1;
        let by = if is_covered && index % 8 < 4 { -1 } else { 1 };
        let what = format!("pixel {at:?} of {side} x {side}, hits off by {by}");

        // First two coverages that differ in that pixel, then a judge who gets the engine that draws it.
        let target = oracle_coverage(&[triangle], window);
        let mut actual = Coverage::new(window, 0);
        let planted = OneWrong { at, by };
        planted.cover(triangle.corners(), window, |s| actual.hit(s.y_px, s.x0_px, s.x1_px));
        if (subject.coverage_agrees)(&actual, &target) {
            return Err(format!("the judge forgives {what}"));
        }
        if !(subject.coverage_agrees)(&target, &target) {
            return Err("the judge finds a coverage unlike itself".to_owned());
        }
        let case =
            Case { window, shape: Shape::Triangles { list: vec![triangle], disjoint: true } };
        let finding = comparison::judge_coverage_of(&planted, &case);
        if !finding.is_wrong() || finding.tally.total() != 1 {
            return Err(format!("a case with a wrong {what} {}", finding.describe()));
        }
        compared += 3 * u64::from(window.width()) * u64::from(window.height());
    }
    Ok(compared)
}
