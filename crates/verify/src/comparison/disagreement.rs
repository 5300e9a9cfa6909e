//! What a test prints when it fails: the smallest case, what was drawn and expected, and what rule would explain it.

use std::error::Error;
use std::fmt;

use super::{
    Cause, Changed, Comparisons, Convention, Failure, LeftOut, ORACLE, Tally, Verdict, shrink,
};
use crate::cases::{FamilyName, Shape};
use crate::judge::ascii;
use rasterproof_core::frame::Coverage;

/// Lines of the list of families are no longer.
const MOST_COLUMNS: usize = 80;
/// Larger grids are left out of the message.
const MOST_SIDE_PX: u32 = 40;
/// Of more triangles or lines the message has the number only. What was shrunk has fewer.
const MOST_SHAPES: usize = 6;
/// Pixels that are listed where the grid is left out.
const MOST_PIXELS: usize = 6;

impl Changed {
    /// Both answers: beside each other, or where they are large the pixels in which they differ.
    fn write(&self, f: &mut fmt::Formatter<'_>, expected: &Coverage) -> fmt::Result {
        let [Some(first), Some(again)] = &self.drawn else {
            for (time, drawn) in ["the first time", "the second time"].iter().zip(&self.drawn) {
                let what = if drawn.is_some() { "draws it" } else { "panics on it" };
                writeln!(f, "  {time} {} {what}", self.engine)?;
            }
            return Ok(());
        };
        let bounds = first.bounds();
        if bounds.width().max(bounds.height()) <= MOST_SIDE_PX {
            return f.write_str(&ascii::beside(
                &["first", "again"],
                &[first, again],
                expected,
                MOST_COLUMNS,
            ));
        }
        let mut differ = 0;
        for ((y_px, first), (_, again)) in first.rows().zip(again.rows()) {
            for ((x_px, first), again) in (bounds.x0..).zip(first).zip(again) {
                if first == again {
                    continue;
                }
                differ += 1;
                if differ <= MOST_PIXELS {
                    writeln!(f, "  pixel {x_px},{y_px}: drawn {first} times, then {again} times")?;
                }
            }
        }
        match differ.saturating_sub(MOST_PIXELS) {
            0 => Ok(()),
            more => writeln!(f, "  and {more} more pixels"),
        }
    }
}

/// What was wrong in a verdict. Its text is the whole message: print it.
#[derive(Clone, Debug)]
pub struct Disagreement {
    /// Wrong pixels over all cases; of two compared engines those that differ.
    pub wrong_pixels: u64,
    /// Cases in which anything was wrong, and all cases.
    pub wrong_cases: [u64; 2],
    /// Cases in which the engine panicked.
    pub panics: u64,
    /// Families with wrong cases, and how many.
    pub families: Vec<(String, u64)>,
    /// The smallest failing case that was found. There is none where the oracle itself failed a check.
    pub smallest: Option<Failure>,
    /// Why it is wrong.
    pub cause: Option<Cause>,
    /// The convention that was declared.
    pub declared: Convention,
    /// What was not done, because the time was up.
    pub left_out: LeftOut,
}

impl Error for Disagreement {}

impl Disagreement {
    pub(super) fn of(verdict: &Verdict) -> Self {
        // Each family with the pair that is wrong most often.
        let (mut families, mut wrong, mut cases, mut panics) = (Vec::new(), 0, 0, 0);
        for family in &verdict.families {
            cases += family.cases;
            let mut most = 0;
            for pair in &family.pairs {
                most = most.max(pair.wrong_cases);
                if pair.is_by_oracle() {
                    panics += pair.panics;
                }
            }
            if most > 0 {
                wrong += most;
                families.push((family.family.clone(), most));
            }
        }
        let Comparisons { oracle, engines, .. } = verdict.comparisons();
        let pixels = if oracle == Tally::default() { engines } else { oracle };
        Self {
            wrong_pixels: pixels.total(),
            wrong_cases: [wrong, cases],
            panics,
            families,
            smallest: verdict.failures.first().cloned(),
            cause: verdict.cause.clone(),
            declared: verdict.options.terms,
            left_out: verdict.more,
        }
    }
}

impl fmt::Display for Disagreement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [wrong, all] = self.wrong_cases;
        let two = self.smallest.as_ref().filter(|failure| failure.evidence.pair[1] != ORACLE);
        let changed = self.smallest.as_ref().and_then(|failure| failure.evidence.changed.as_ref());
        if changed.is_some() {
            writeln!(
                f,
                "The answers change from one time to the next: asked again, a case that failed is"
            )?;
            writeln!(
                f,
                "drawn otherwise. So nothing was made smaller, and no cause was looked for.\n"
            )?;
        }
        let what = if two.is_some() { "pixels differ" } else { "wrong pixels" };
        writeln!(f, "{} {what}, in {wrong} of {all} cases", self.wrong_pixels)?;
        if self.panics > 0 {
            let panics = self.panics;
            writeln!(f, "it panics in {panics} cases; only the first of these panics was shown")?;
        }
        let left_out = self.left_out.to_string();
        if !left_out.is_empty() {
            writeln!(f, "{}", ascii::broken(&left_out, MOST_COLUMNS, ""))?;
        }
        if let Some(failure) = &self.smallest {
            let Failure { family, index, what, case, evidence, .. } = failure;
            let kind = if matches!(case.shape, Shape::Lines(_)) { "line" } else { "triangle" };
            let window = case.window;
            let shapes = match &case.shape {
                Shape::Triangles { list, .. } => list.len(),
                Shape::Lines(lines) => lines.len(),
                Shape::Unsnapped { list, .. } => list.len(),
                Shape::Numbers { .. } => 0,
            };
            let described = match shapes {
                few if few <= MOST_SHAPES => format!("{kind} {}", shrink::describe(case)),
                many => format!("{many} {kind}s"),
            };
            let [width, height] = [window.width(), window.height()];
            let shrunk = match changed {
                Some(_) => "as it is",
                None if self.left_out.shrinking => "shrunk until the time was up",
                None => "shrunk",
            };
            writeln!(f, "\n{family}: {what} (from {family} #{index}, {shrunk})")?;
            writeln!(f, "  {described} in a window of {width} x {height} px")?;
            if let Some(changed) = changed {
                changed.write(f, &evidence.expected)?;
            }
            let names: &[&str] = if two.is_some() { &["first", "second"] } else { &["judged"] };
            match &evidence.drawn {
                _ if changed.is_some() => {}
                Some(drawn) if width.max(height) <= MOST_SIDE_PX => {
                    let drawn: Vec<_> = [drawn].into_iter().chain(&evidence.other).collect();
                    let expected = &evidence.expected;
                    f.write_str(&ascii::beside(names, &drawn, expected, MOST_COLUMNS))?;
                }
                Some(_) => {}
                None => writeln!(f, "  the engine panics on it")?,
            }
            if two.is_some() && changed.is_none() {
                let [first, second] = [&failure.evidence.drawn, &failure.evidence.other]
                    .map(|drawn| drawn.as_ref() == Some(&failure.evidence.expected));
                let who = match (first, second) {
                    (true, false) => "the first is right here",
                    (false, true) => "the second is right here",
                    (false, false) => "neither is right here",
                    (true, true) => "both light the right pixels, in another order",
                };
                writeln!(f, "  {who}, by the oracle")?;
            }
            write!(f, "  repeat with: Options::default().seed({})", failure.seed)?;
            if let Ok(family) = family.parse::<FamilyName>() {
                write!(f, ".family(FamilyName::{family:?})")?;
            }
            if self.declared != Convention::default() {
                write!(f, ".convention({})", self.declared)?;
            }
            writeln!(f, ".only({index})")?;
        }
        if let Some(cause) = &self.cause {
            let of = two.map(|failure| format!("of the {}: ", failure.evidence.who_is_wrong()));
            let cause = format!("{}{cause}", of.unwrap_or_default());
            writeln!(f, "\n{}", ascii::broken(&cause, MOST_COLUMNS, ""))?;
        }
        if !self.families.is_empty() {
            f.write_str("\nwrong cases by family:")?;
            let mut column = MOST_COLUMNS;
            for (name, wrong) in &self.families {
                let word = format!(" {name} ({wrong})");
                if column + word.len() > MOST_COLUMNS {
                    f.write_str("\n ")?;
                    column = 1;
                }
                f.write_str(&word)?;
                column += word.len();
            }
            writeln!(f)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use crate::cases::FamilyName;
    use crate::comparison::{
        Convention, NothingJudged, Options, Rule, Verdict, compare_coverage, compare_lines,
        judge_coverage, judge_line_values,
    };
    use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
    use std::time::{Duration, Instant};

    use rasterproof_core::contract::{DrawLine, Rasterize};
    use rasterproof_core::grid::PixelRect;
    use rasterproof_core::line::bresenham::Bresenham;
    use rasterproof_core::line::dda::Dda;
    use rasterproof_core::raster::scanline::Scanline;
    use rasterproof_core::triangle::{Corners, Fragment, ScreenLine, Span, Varying};

    fn whole(verdict: Result<Verdict, NothingJudged>) -> String {
        verdict.unwrap().check().unwrap_err().to_string()
    }

    /// Of two engines that differ the message shows both, and with which of them the oracle agrees.
    #[test]
    fn two_engines_are_compared() {
        let strict = Convention::default().rule(Rule::Strict);
        let right = Convention::default();
        let options = Options::default().cases(40).family(FamilyName::HalfInteger);
        compare_coverage(&Scanline, &right, &options).unwrap().check().unwrap();
        // Both are wrong, and the same.
        compare_coverage(&strict, &strict, &options).unwrap().check().unwrap();
        let said = |verdict: Result<Verdict, _>| whole(verdict).replace('\n', " ");
        let message = said(compare_coverage(&right, &strict, &options));
        for part in [
            " pixels differ, in ",
            "first   second   expected",
            "the first is right here, by the oracle",
            "of the second: probable cause: It samples at the pixel's centre and draws nothing on an edge",
        ] {
            assert!(message.contains(part), "{part}: {message}");
        }
        let message = said(compare_coverage(&strict, &right, &options));
        assert!(message.contains("the second is right here, by the oracle"), "{message}");
        let message = said(compare_coverage(&Times(0), &Times(2), &options));
        assert!(message.contains("neither is right here, by the oracle"), "{message}");

        let lines = Options::default().cases(40).family(FamilyName::LineTies);
        compare_lines(&Dda, &Bresenham, &lines).unwrap().check().unwrap();
        let message = said(compare_lines(&Spoilt::Backwards, &Dda, &lines));
        assert!(message.contains("both light the right pixels, in another order"), "{message}");
    }

    /// Draws everything so often.
    struct Times(usize);
    impl Rasterize for Times {
        fn cover(&self, corners: Corners, bounds: PixelRect, mut emit: impl FnMut(Span)) {
            (0..self.0).for_each(|_| Scanline.cover(corners, bounds, &mut emit));
        }
    }

    /// Emits the spans of one row of each triangle with the ends exchanged.
    struct EndBeforeBeginning;
    impl Rasterize for EndBeforeBeginning {
        fn cover(&self, corners: Corners, bounds: PixelRect, mut emit: impl FnMut(Span)) {
            Scanline.cover(corners, bounds, |span| {
                let Span { y_px, x0_px, x1_px } = span;
                let is_exchanged = y_px == 3 && x0_px < x1_px;
                emit(if is_exchanged { Span { y_px, x0_px: x1_px, x1_px: x0_px } } else { span });
            });
        }
    }

    /// Both ends lie in the window; that was the end of the test without a verdict.
    #[test]
    fn a_span_that_ends_before_it_begins_is_a_finding() {
        let options = Options::default().cases(20).family(FamilyName::HalfInteger);
        let message = whole(judge_coverage(&EndBeforeBeginning, &options)).replace('\n', " ");
        for part in [
            "panics (the span of row 3 begins at column ",
            " and ends before it, at column ",
            " triangle ",
            "repeat with: Options::default().seed(1).family(FamilyName::HalfInteger).only(",
        ] {
            assert!(message.contains(part), "{part}: {message}");
        }
    }

    /// Leaves out the first pixel of every second triangle that it is given.
    struct EverySecond(AtomicU64);
    impl Rasterize for EverySecond {
        fn cover(&self, corners: Corners, bounds: PixelRect, mut emit: impl FnMut(Span)) {
            let mut left_out = self.0.fetch_add(1, Ordering::Relaxed) % 2;
            Scanline.cover(corners, bounds, |mut span| {
                span.x0_px += i32::from(std::mem::take(&mut left_out) > 0);
                emit(span);
            });
        }
    }

    /// The lines of [`Dda`], spoilt.
    enum Spoilt {
        /// Without the last pixel the first time, as of programs that keep something from before.
        Once(AtomicBool),
        Backwards,
    }

    impl DrawLine for Spoilt {
        fn draw<V: Varying>(
            &self,
            line: &ScreenLine<V>,
            bounds: PixelRect,
            emit: impl FnMut(Fragment<V>),
        ) {
            let mut pixels = Vec::new();
            Dda.draw(line, bounds, |pixel| pixels.push(pixel));
            match self {
                Self::Once(is_again) if is_again.swap(true, Ordering::Relaxed) => {}
                Self::Once(_) => drop(pixels.pop()),
                Self::Backwards => pixels.reverse(),
            }
            pixels.into_iter().for_each(emit);
        }
    }

    /// Every failing case is drawn again. What changes is said first, with both answers; nothing is shrunk or explained.
    #[test]
    fn answers_that_change_are_said_first() {
        let says_so = |message: &str, parts: &[&str]| {
            assert!(
                message.starts_with("The answers change from one time to the next"),
                "{message}"
            );
            for part in parts {
                assert!(message.contains(part), "{part}: {message}");
            }
            for part in ["shrunk", "probable cause", "no cause was recognised"] {
                assert!(!message.contains(part), "{part}: {message}");
            }
        };
        let options = Options::default().cases(40).family(FamilyName::HalfInteger);
        let answers = |said: &str| said.replace('\n', " ");
        let verdict = judge_coverage(&EverySecond(AtomicU64::new(0)), &options);
        let message = answers(&whole(verdict));
        says_so(
            &message,
            &[
                ": first 1 missing, then agrees (from half-integer #",
                "first ",
                "again ",
                "repeat with",
            ],
        );
        let lines = Options::default().cases(40).family(FamilyName::LineTies);
        let message =
            answers(&whole(judge_line_values(&Spoilt::Once(AtomicBool::new(false)), &lines)));
        says_so(&message, &[": first 1 missing, then agrees (from line-ties #"]);
        let second = EverySecond(AtomicU64::new(0));
        let message = answers(&whole(compare_coverage(&Scanline, &second, &options)));
        says_so(&message, &["first 1 extra, then agrees"]);
        // Who is wrong in the same way each time is explained.
        let strict = Convention::default().rule(Rule::Strict);
        let message = whole(judge_coverage(&strict, &options));
        assert!(message.contains("shrunk") && message.contains("probable cause"), "{message}");
    }

    /// Draws nothing on an edge, and takes its time.
    struct Slow;
    impl Rasterize for Slow {
        fn cover(&self, corners: Corners, bounds: PixelRect, emit: impl FnMut(Span)) {
            std::thread::sleep(Duration::from_millis(50));
            Convention::default().rule(Rule::Strict).cover(corners, bounds, emit);
        }
    }

    /// It had no verdict after four minutes: the limit was one of the cases alone.
    #[test]
    fn the_time_limit_covers_what_comes_after_a_failure() {
        let (start, limit) = (Instant::now(), Duration::from_secs(2));
        let options = Options::default().cases(5).time_limit(limit);
        let message = whole(judge_coverage(&Slow, &options)).replace('\n', " ");
        let elapsed = start.elapsed();
        // The cases of a mesh that is drawn then take a few seconds.
        assert!(elapsed < 5 * limit, "{elapsed:?}: {message}");
        for part in
            ["Left out, since the time limit of 2 s was up: ", " cases", "the cause", "repeat with"]
        {
            assert!(message.contains(part), "{part}: {message}");
        }
        assert!(!message.contains("probable cause"), "{message}");
    }

    /// Without a limit, what comes after the cases is bounded.
    #[test]
    fn without_a_limit_the_search_for_a_cause_ends() {
        let start = Instant::now();
        let options = Options::default().cases(1).family(FamilyName::Rectangle);
        let message = whole(judge_coverage(&Slow, &options)).replace('\n', " ");
        assert!(start.elapsed() < Duration::from_secs(30), "{:?}", start.elapsed());
        let said = "since the judged code has 10 s for what comes after a failure: ";
        assert!(message.contains(said) && message.contains("the cause."), "{message}");
        assert!(message.contains("wrong pixels, in 1 of 1 cases"), "{message}");
    }

    #[test]
    fn a_message_says_all() {
        let strict = Convention::default().rule(Rule::Strict);
        let options = Options::default()
            .cases(40)
            .family(FamilyName::HalfInteger)
            .family(FamilyName::Rectangle);
        let message = whole(judge_coverage(&strict, &options));
        for part in [
            "wrong pixels, in ",
            ", shrunk)\n",
            "judged   expected",
            "-",
            "probable cause: It samples at the pixel's centre and draws nothing on an edge:\nneighbours leave holes.",
            "if that is meant, declare it: Options::default().convention(Convention::default().rule(Rule::Strict))",
            "repeat with: Options::default().seed(1).family(FamilyName::",
        ] {
            assert!(message.contains(part), "{part}: {message}");
        }
        assert!(message.lines().all(|l| l.len() <= 80 || l.contains("::")), "{message}");
        let declared = options.clone().convention(Convention::default().rule(Rule::TopRight));
        let message = whole(judge_coverage(&strict, &declared));
        let repeat = ".convention(Convention::default().rule(Rule::TopRight)).only(";
        assert!(message.contains(repeat), "{message}");
        judge_coverage(&Scanline, &options).unwrap().check().unwrap();
    }
}
