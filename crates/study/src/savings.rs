//! What planning the effects of a scene saves: the times of whole frames by every mixture of planned effects and of those that are
//! always paid for.

use std::cell::RefCell;
use std::time::Duration;

use rasterproof_precision::cost::{Clock, Pass, Ratio, Spread, Times, Timing, compare};
use rasterproof_registry::engines::Drawer;
use rasterproof_render::effects::plan::Canvas;
use rasterproof_render::effects::render::{BadScene, Rendered, survey_again};
use rasterproof_render::effects::{Effect, Effects, Mode};
use rasterproof_render::pipeline::target::Target;
use rasterproof_render::scene::Scene;

use crate::effects::{PLANS, differing, frame_pass};

/// A frame by a mixture of effects, whose times are of the same rounds as those of the others.
#[derive(Clone, Debug, serde::Serialize)]
pub struct Measured {
    pub effects: String,
    pub rounds: usize,
    /// Of processor time, the median, and quartiles.
    pub time_us: f64,
    pub quartiles_us: [f64; 2],
    /// Whether the picture has the bits of the one that pays for everything.
    pub same: bool,
    #[serde(skip)]
    times: Times,
}

impl Measured {
    fn new((mixture, times): (&Mixture, &Times)) -> Self {
        let Spread { low, median, high } = times.spread().times(1e-3);
        Self {
            effects: mixture.name.clone(),
            rounds: times.rounds(),
            time_us: median,
            quartiles_us: [low, high],
            same: mixture.same,
            times: times.clone(),
        }
    }

    /// How many times as long it takes as another frame.
    #[must_use]
    pub fn over(&self, other: &Self) -> Ratio {
        self.times.over(&other.times).unwrap_or(Ratio::ONE)
    }
}

/// What planning an effect saves beside others.
#[derive(Clone, Copy, Debug, serde::Serialize)]
pub struct Saves {
    /// How much less of its work is done, by the counter of the effect.
    pub work: u64,
    /// How many times as long the frame takes that pays for it; none where its work is the same, since what is measured then is noise.
    pub times: Option<Ratio>,
}

impl Saves {
    /// A share of the time, or that there is nothing to save.
    #[must_use]
    pub fn words(&self) -> String {
        self.times.map_or("no work".to_owned(), |ratio| ratio.saving())
    }
}

/// What planning one effect saves.
#[derive(Clone, Debug, serde::Serialize)]
pub struct Saving {
    pub effect: Effect,
    /// Of a frame that pays for everything: it alone is planned.
    pub alone: Saves,
    /// Of the planned frame: it alone had been paid for.
    pub last: Saves,
    /// Pixels that change when it is left out everywhere.
    pub wrong_without: u64,
}

/// What planning saves, as a whole and by effect.
#[derive(Clone, Debug, serde::Serialize)]
pub struct Savings {
    pub everything: Measured,
    pub usual: Measured,
    pub planned: Measured,
    /// How many times as long everything takes as the plan, and as usual.
    pub times: [Ratio; 2],
    /// The ratio of two equal frames in the same rounds, where there were enough.
    pub noise: Option<Ratio>,
    pub effects: Vec<Saving>,
    /// Those whose work is not that of everything or of the plan.
    pub mixtures: Vec<Measured>,
    /// Mixtures that were not timed and changed the picture all the same.
    pub changed: Vec<String>,
}

impl Savings {
    /// The three whole frames, then the mixtures.
    pub fn all(&self) -> impl Iterator<Item = &Measured> {
        [&self.everything, &self.usual, &self.planned].into_iter().chain(&self.mixtures)
    }

    /// The mixtures with another picture.
    pub fn different(&self) -> impl Iterator<Item = &str> {
        let timed = self.all().filter(|mixture| !mixture.same).map(|mixture| &*mixture.effects);
        timed.chain(self.changed.iter().map(String::as_str))
    }
}

/// A mixture of effects that may be timed.
struct Mixture {
    name: String,
    effects: Effects,
    /// Whether its picture has the bits of the one that pays for everything.
    same: bool,
}

/// Rounds of all frames that differ in work, or of the whole ones alone: the times, the frame that pays for everything, and the
/// planned one. `drawn` is called after each frame.
///
/// # Errors
/// [`BadScene`].
pub fn measure(
    (scene, drawer): (&Scene, Drawer),
    target: &mut Target,
    rounds: Option<u32>,
    is_whole: bool,
    drawn: &dyn Fn(),
) -> Result<(Savings, [Rendered; 2]), BadScene> {
    // Each mixture is drawn once for its picture and its counters before any is timed.
    let mut draw = |effects: &Effects| {
        let rendered = drawer.render(scene, effects, target)?;
        drawn();
        Ok::<_, BadScene>(rendered)
    };
    let (mut frames, mut timed) = (Vec::new(), Vec::new());
    for (name, effects, _) in PLANS {
        let rendered = draw(&effects)?;
        let first = frames.first().unwrap_or(&rendered);
        let same = rendered.picture == first.picture;
        timed.push(Mixture { name: name.to_owned(), effects, same });
        frames.push(rendered);
    }
    // The slower one of each pair is named first.
    let mut pairs: Vec<Pair> = vec![[EVERYTHING, PLANNED], [USUAL, PLANNED]];
    let mut changed = Vec::new();
    let is_slow = rounds.is_none() && is_slow(&mut draw)?;
    let effects = if is_whole || is_slow { &[][..] } else { &Effect::ALL };
    // Of each effect how much work it saves alone and as the last one, with the pair of frames that shows what time.
    let mut found: Vec<[(u64, Option<Pair>); 2]> = Vec::new();
    for &effect in effects {
        let mut compared = |name: String, base: usize, effects: Effects| {
            let rendered = draw(&effects)?;
            let calls = |rendered: &Rendered| effect.calls(&rendered.counters);
            let work = calls(&rendered).abs_diff(calls(&frames[base]));
            let same = rendered.picture == frames[EVERYTHING].picture;
            if work == 0 {
                changed.extend((!same).then_some(name));
                return Ok((0, None));
            }
            let other = timed.len();
            timed.push(Mixture { name, effects, same });
            let pair = if base == EVERYTHING { [base, other] } else { [other, base] };
            pairs.push(pair);
            Ok((work, Some(pair)))
        };
        let name = effect.name();
        let alone = Effects::ALWAYS.with(effect, Mode::Planned);
        let last = Effects::PLANNED.with(effect, Mode::Always);
        found.push([
            compared(format!("all, {name} planned"), EVERYTHING, alone)?,
            compared(format!("planned,+{name}"), PLANNED, last)?,
        ]);
    }
    // All frames take turns in the same rounds, and are compared by pairs.
    let share = if is_whole { 0.5 } else { 1.0 };
    let rounds = rounds.map(|rounds| rounds as usize);
    let timing = Timing { rounds, ..PLAN }.within(share);
    let times = {
        let target = RefCell::new(&mut *target);
        let mut passes: Vec<Pass<'_>> = Vec::with_capacity(timed.len());
        for mixture in &timed {
            passes.push(frame_pass((scene, drawer), mixture.effects, &target));
        }
        let sets: Vec<Vec<usize>> = pairs.iter().map(|pair| pair.to_vec()).collect();
        compare(&mut passes, timing, &sets, &|_| drawn())
    };
    // From here on nothing is timed: pairs of frames become ratios.
    let all: Vec<Measured> = timed.iter().zip(&times).map(Measured::new).collect();
    let over = |[a, b]: Pair| all[a].over(&all[b]);
    // Last, a picture without each effect, which says whether it was needed at all.
    let mut savings = Vec::new();
    for (&effect, of_both) in effects.iter().zip(found) {
        let without = drawer.render_without(scene, effect, target)?;
        let changed = differing(&without.picture, &frames[EVERYTHING].picture, 0).count() as u64;
        let [alone, last] = of_both.map(|(work, pair)| Saves { work, times: pair.map(over) });
        savings.push(Saving { effect, alone, last, wrong_without: changed });
    }
    let savings = Savings {
        times: [over(pairs[0]), over(pairs[1])],
        noise: times[EVERYTHING].noise(),
        effects: savings,
        everything: all[EVERYTHING].clone(),
        usual: all[USUAL].clone(),
        planned: all[PLANNED].clone(),
        mixtures: all[PLANS.len()..].to_vec(),
        changed,
    };
    let planned = frames.swap_remove(PLANNED);
    Ok((savings, [frames.swap_remove(EVERYTHING), planned]))
}

/// Two frames, of which the first one is expected to take longer.
type Pair = [usize; 2];

/// The places of the three plans in [`PLANS`], by which their times are found.
const EVERYTHING: usize = 0;
const USUAL: usize = 1;
const PLANNED: usize = 2;

/// How long frames are compared where no number of rounds is given.
const PLAN: Timing =
    Timing { slice: Timing::QUICK.slice, budget: Duration::from_secs(10), rounds: None };

/// Whether rounds of all mixtures would take far more than the budget, so that only whole frames are compared.
fn is_slow(draw: &mut dyn FnMut(&Effects) -> Result<Rendered, BadScene>) -> Result<bool, BadScene> {
    let start = Clock::Thread.now();
    draw(&Effects::PLANNED)?;
    draw(&Effects::ALWAYS)?;
    let round_s = (Clock::Thread.now() - start) / 1e9 * Effect::ALL.len() as f64;
    Ok(round_s > PLAN.budget.as_secs_f64() / 2.0)
}

/// Microseconds that a planned frame looks at triangles for the reason of depth, the median; none where it lists all.
///
/// # Errors
/// [`BadScene`].
pub fn survey_us(scene: &Scene, target: &Target) -> Result<Option<f64>, BadScene> {
    let timing = Timing { rounds: Some(9), ..PLAN };
    let mut us = None;
    survey_again(scene, &Canvas::of(target), &mut |survey| {
        let times = compare(&mut [Pass::new(survey)], timing, &[], &|_| ());
        us = times.first().map(|times| times.median() / 1e3);
    })?;
    Ok(us)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasterproof_render::pipeline::depth::DepthFormat;
    use rasterproof_render::pipeline::target::Antialias;
    use rasterproof_render::scene::chapters;

    /// Made-up times in which a frame takes half as long without an effect.
    #[test]
    fn savings_are_shares_of_the_time() {
        let times = Times::of(vec![vec![2.0; 8], vec![1.0; 8]], None);
        let saves = Saves { work: 7, times: times[0].over(&times[1]) };
        assert_eq!(saves.words(), "50% (46 to 53)");
    }

    /// Where the work of a frame does not differ, no time is compared.
    #[test]
    fn what_does_no_work_saves_nothing() {
        let scene = chapters::scene("panels", 4.0 / 3.0, 0.0).unwrap();
        let mut target = Target::new(40, 30, Antialias::None, DepthFormat::Unorm32).unwrap();
        let subject = (&scene, Drawer::Scanline);
        let (savings, _) = measure(subject, &mut target, Some(1), false, &|| ()).unwrap();
        let saves = savings.effects.iter().flat_map(|saving| [saving.alone, saving.last]);
        let (working, idle): (Vec<_>, Vec<_>) = saves.partition(|saves| saves.work > 0);
        assert!(working.iter().all(|saves| saves.times.is_some()) && !working.is_empty());
        assert!(idle.iter().all(|saves| saves.words() == "no work") && !idle.is_empty());
        assert_eq!(savings.mixtures.len(), working.len());
    }
}
