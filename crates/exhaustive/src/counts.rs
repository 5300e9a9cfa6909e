//! How much a chunk holds: cases, comparisons and checks by the oracle's own code, by formulas and
//! without judging a case. What a file states about some chunks is compared with these sums.

use std::iter::Sum;

use rasterproof_core::grid::{SUBPIXEL_BITS, SUBPIXELS};
use rasterproof_core::raster::scanline::probe::first_centre;

use super::edges::Edges;
use super::lines::Lines;
use super::triangles::Triangles;
use super::{EXAMPLES, Enumeration as _, Example, Plan, Tally};

/// Bits of the sublattice of triangles on which the oracle's own code judges too.
const ORACLE_BITS: u32 = 2;
/// Reach of the lines that the oracle's own code judges too.
const ORACLE_REACH: u64 = 64;
/// Drawings of one line: one against the rule, then by two drawers in two directions in three
/// windows.
const DRAWINGS_OF_A_LINE: u64 = 1 + 2 * 2 * 3;

/// What some chunks hold. The names are those of [`Tally`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    pub cases: u64,
    pub comparisons: u64,
    /// Cases that the oracle's own code judges too.
    pub oracle_checks: u64,
}

impl Sum for Counts {
    fn sum<I: Iterator<Item = Self>>(counts: I) -> Self {
        let mut sum = Self::default();
        for one in counts {
            sum.cases += one.cases;
            sum.comparisons += one.comparisons;
            sum.oracle_checks += one.oracle_checks;
        }
        sum
    }
}

impl Counts {
    /// What these chunks of a plan hold together. The plan has passed [`Plan::check`], and each chunk
    /// comes once, so no sum overflows.
    pub fn of(plan: &Plan, chunks: impl Iterator<Item = u64>) -> Self {
        match plan {
            Plan::Triangles(triangles) => chunks.map(|chunk| of_triangles(triangles, chunk)).sum(),
            Plan::Lines(lines) => chunks.map(|chunk| of_lines(lines, chunk)).sum(),
            Plan::Edges(edges) => {
                let across = across(edges);
                chunks.map(|chunk| of_edges(edges, across, chunk)).sum()
            }
        }
    }
}

/// Comparisons of each case, where all cases have the same number.
const fn comparisons_of_a_case(plan: &Plan) -> Option<u64> {
    match plan {
        Plan::Triangles(triangles) => Some(if triangles.all_orders { 2 * 6 } else { 2 }),
        Plan::Lines(_) => Some(DRAWINGS_OF_A_LINE),
        Plan::Edges(_) => None,
    }
}

const fn pairs(n: u64) -> u64 {
    n * n.saturating_sub(1) / 2
}

/// Triangles whose first corner has the number of the chunk: pairs of points with higher numbers.
fn of_triangles(plan: &Triangles, chunk: u64) -> Counts {
    let side = |bits: u32| (u64::from(plan.window_px) << bits) + 1;
    let after = |side: u64, number: u64| pairs(side * side - 1 - number);
    let checked_bits = plan.subpixel_bits.min(ORACLE_BITS);
    let (all, checked) = (side(plan.subpixel_bits), side(checked_bits));
    let step = 1 << (plan.subpixel_bits - checked_bits);
    let (x, y) = (chunk % all, chunk / all);
    let is_checked = x % step == 0 && y % step == 0;
    let cases = after(all, chunk);
    Counts {
        cases,
        comparisons: cases * if plan.all_orders { 2 * 6 } else { 2 },
        // Points of the sublattice have the same order there.
        oracle_checks: if is_checked { after(checked, y / step * checked + x / step) } else { 0 },
    }
}

fn of_lines(plan: &Lines, chunk: u64) -> Counts {
    let reach = u64::from(plan.reach);
    let lines = |reach: u64| if plan.first_octant { chunk + 1 } else { 2 * reach + 1 };
    let dx = if plan.first_octant { chunk } else { chunk.abs_diff(reach) };
    let (cases, is_checked) = (lines(reach), dx <= ORACLE_REACH);
    Counts {
        cases,
        comparisons: cases * DRAWINGS_OF_A_LINE,
        oracle_checks: if is_checked { lines(reach.min(ORACLE_REACH)) } else { 0 },
    }
}

/// Points along a side of the lattice, but for one; and how many heights the upper end takes.
fn sides(plan: &Edges) -> (u64, u64) {
    let n = u64::from(plan.window_px) << plan.subpixel_bits;
    (n, if plan.every_position { n + 1 } else { 1 << plan.subpixel_bits })
}

/// Edges between two different heights, which are the same number for all pairs of heights: for each
/// run from -n to n, the columns that the left end takes.
fn across(plan: &Edges) -> u64 {
    let (n, lefts) = sides(plan);
    let columns = |run: u64| lefts.min(n - run + 1);
    columns(0) + 2 * (1..=n).map(columns).sum::<u64>()
}

/// Edges from one height down to a block of others, and with the first block the horizontal ones.
fn of_edges(plan: &Edges, across: u64, chunk: u64) -> Counts {
    let (n, uppers) = sides(plan);
    let blocks = plan.chunks() / uppers;
    let (block, upper) = (chunk / uppers, chunk % uppers);
    let spacing = 1 << (SUBPIXEL_BITS - plan.subpixel_bits);
    let row = |height: u64| first_centre(height as i32 * spacing + plan.offset_px[1] * SUBPIXELS);
    let first = row(upper);
    let lowers = (block * n / blocks).max(upper) + 1..(block + 1) * n / blocks + 1;
    let mut counts = Counts::default();
    for lower in lowers {
        counts.cases += across;
        counts.comparisons += across * u64::from(row(lower).abs_diff(first));
    }
    if block == 0 {
        let horizontal = uppers * n - pairs(uppers);
        counts.cases += horizontal;
        counts.comparisons += horizontal;
    }
    counts
}

impl Tally {
    /// Checks that a run of exactly these chunks can have found this. The cases of a chunk in which an
    /// engine panicked are not counted, so where something is wrong, cases may be missing.
    ///
    /// # Errors
    /// In words, which count is impossible, with the one that belongs there.
    pub fn check(
        &self,
        plan: &Plan,
        chunks: impl Iterator<Item = u64> + Clone,
    ) -> Result<(), String> {
        let expected = Counts::of(plan, chunks.clone());
        for (field, stated, expected) in [
            ("cases", self.cases, expected.cases),
            ("comparisons", self.comparisons, expected.comparisons),
            ("oracle_checks", self.oracle_checks, expected.oracle_checks),
        ] {
            if stated > expected || stated < expected && self.mismatches == 0 {
                return Err(format!("it says {stated} {field}, where {expected} belong"));
            }
        }
        // The first three are at most the expected ones, so nothing below overflows.
        let comparisons = comparisons_of_a_case(plan).map(|each| self.cases * each);
        if let Some(expected) = comparisons.filter(|expected| *expected != self.comparisons) {
            let Self { cases, comparisons, .. } = self;
            return Err(format!(
                "it says {comparisons} comparisons, where {expected} belong to its {cases} cases"
            ));
        }
        // Each comparison and each check can fail once, and each chunk can end by one panic.
        let most = self.comparisons + self.oracle_checks + chunks.clone().count() as u64;
        if self.mismatches > most {
            let stated = self.mismatches;
            return Err(format!("it says {stated} mismatches, where at most {most} are possible"));
        }
        let (stated, expected) = (self.examples.len(), self.mismatches.min(EXAMPLES as u64));
        if stated as u64 != expected {
            return Err(format!("it lists {stated} examples, where {expected} belong"));
        }
        for Example { chunk, .. } in &self.examples {
            if !chunks.clone().any(|one| one == *chunk) {
                return Err(format!(
                    "it lists an example of chunk {chunk}, which is no part of it"
                ));
            }
        }
        for pair in self.examples.windows(2) {
            if (pair[0].chunk, pair[0].number) >= (pair[1].chunk, pair[1].number) {
                return Err("its examples are not in their order".to_owned());
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangles(window_px: u32, subpixel_bits: u32, all_orders: bool) -> Plan {
        let offset_px = [-16, 2048];
        Plan::Triangles(Triangles { window_px, subpixel_bits, offset_px, all_orders, plant: None })
    }

    fn lines(reach: u32, first_octant: bool) -> Plan {
        Plan::Lines(Lines { reach, offset_px: [3, -5], first_octant, plant: None })
    }

    fn edges(window_px: u32, subpixel_bits: u32, every_position: bool) -> Plan {
        let offset_px = [7, -2048];
        Plan::Edges(Edges { window_px, subpixel_bits, offset_px, every_position, plant: None })
    }

    fn of_all(plan: &Plan) -> Counts {
        Counts::of(plan, 0..plan.enumeration().chunks())
    }

    /// Each chunk is judged, and has counted what the formulas say.
    #[test]
    fn the_formulas_are_what_the_drivers_count() {
        for plan in [
            triangles(1, 0, false),
            triangles(1, 3, false),
            triangles(1, 4, true),
            triangles(2, 1, true),
            triangles(3, 0, false),
            triangles(4, 1, false),
            lines(1, false),
            lines(9, true),
            lines(67, false),
            lines(70, true),
            edges(1, 0, false),
            edges(1, 3, true),
            edges(2, 2, false),
            edges(3, 1, true),
            edges(3, 3, false),
            edges(4, 2, true),
            edges(4, 3, false),
        ] {
            plan.check().unwrap();
            let judge = plan.enumeration().judge();
            for chunk in 0..plan.enumeration().chunks() {
                let found = judge(chunk);
                let counted = Counts {
                    cases: found.cases,
                    comparisons: found.comparisons,
                    oracle_checks: found.oracle_checks,
                };
                assert_eq!(Counts::of(&plan, [chunk].into_iter()), counted, "{plan:?} {chunk}");
                found.check(&plan, [chunk].into_iter()).unwrap();
            }
        }
    }

    /// The sums of runs that take minutes, as their certificates have them.
    #[test]
    fn the_sums_of_long_runs() {
        for (plan, sums) in [
            (triangles(4, 3, true), [214_652_064, 2_575_824_768, 3_981_264]),
            (triangles(4, 4, false), [12_560_891_200, 25_121_782_400, 3_981_264]),
            (edges(4, 6, true), [2_181_202_176, 3_018_175_104, 0]),
            (edges(4, 8, false), [105_461_678_080, 188_584_787_968, 0]),
            (lines(1024, false), [4_198_401, 54_579_213, 16_641]),
            (lines(4095, true), [8_390_656, 109_078_528, 2145]),
        ] {
            let [cases, comparisons, oracle_checks] = sums;
            assert_eq!(of_all(&plan), Counts { cases, comparisons, oracle_checks }, "{plan:?}");
        }
        for plan in
            [triangles(4, 4, true), lines(1 << 13, false), lines(1 << 13, true), edges(4, 8, true)]
        {
            let (counts, all) = (of_all(&plan), plan.enumeration());
            assert_eq!(counts.cases, all.expected_cases(), "{plan:?}");
            assert_eq!(counts.oracle_checks, all.expected_oracle_checks(), "{plan:?}");
        }
    }

    /// A tally that a run has found passes, and each count of it that is changed does not.
    #[test]
    fn impossible_tallies_are_refused() {
        let plant = Some("inclusive-edges".to_owned());
        let Plan::Triangles(right) = triangles(2, 1, false) else { unreachable!() };
        let plan = Plan::Triangles(Triangles { plant, ..right });
        let chunks = 0..plan.enumeration().chunks();
        let judge = plan.enumeration().judge();
        let mut found = Tally::default();
        chunks.clone().for_each(|chunk| found.add(judge(chunk)).unwrap());
        assert_eq!(found.check(&plan, chunks.clone()), Ok(()));
        let refused = |change: &dyn Fn(&mut Tally), why: &str| {
            let mut tally = found.clone();
            change(&mut tally);
            let message = tally.check(&plan, chunks.clone()).unwrap_err();
            assert!(message.contains(why), "{message}");
        };
        refused(&|tally| tally.cases += 1, "it says 2301 cases, where 2300 belong");
        refused(&|tally| tally.cases = u64::MAX, "where 2300 belong");
        refused(&|tally| tally.cases -= 1, "where 4598 belong to its 2299 cases");
        refused(&|tally| tally.comparisons = 0, "where 4600 belong to its 2300 cases");
        refused(&|tally| tally.oracle_checks += 1, "2301 oracle_checks");
        refused(&|tally| tally.mismatches = u64::MAX, "at most 6925 are possible");
        refused(&|tally| tally.mismatches = 4, "it lists 5 examples, where 4 belong");
        refused(&|tally| tally.examples.clear(), "it lists 0 examples, where 5 belong");
        refused(&|tally| tally.examples[4].chunk = 25, "chunk 25, which is no part of it");
        refused(&|tally| tally.examples.swap(1, 2), "not in their order");
        refused(
            &|tally| {
                (tally.mismatches, tally.cases, tally.comparisons) = (0, 2299, 4598);
            },
            "it says 2299 cases, where 2300 belong",
        );
    }

    #[test]
    fn sums_that_overflow_are_named() {
        let of = |field: usize, count: u64| {
            let mut counts = [0; 4];
            counts[field] = count;
            let [cases, comparisons, oracle_checks, mismatches] = counts;
            Tally { cases, comparisons, oracle_checks, mismatches, examples: Vec::new() }
        };
        for (field, name) in
            ["cases", "comparisons", "oracle_checks", "mismatches"].iter().enumerate()
        {
            let mut sum = of(field, 1 << 63);
            let error = sum.add(of(field, 1 << 63)).unwrap_err();
            assert!(error.starts_with(name), "{error}");
            let mut sum = of(field, u64::MAX);
            sum.add(Tally::default()).unwrap();
            assert_eq!(sum, of(field, u64::MAX));
        }
    }
}
