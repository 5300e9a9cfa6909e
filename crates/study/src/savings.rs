//! What planning the effects of a scene saves: the times of whole frames by every mixture of planned effects and of those that are
//! always paid for.

use std::cell::RefCell;
use std::time::Duration;

use rasterproof_precision::cost::{Clock, Pair, Pass, Ratio, Spread, Times, Timing, compare};
use rasterproof_registry::engines::Drawer;
use rasterproof_render::effects::plan::Canvas;
use rasterproof_render::effects::render::{BadScene, Rendered, survey_again};
use rasterproof_render::effects::{Effect, Effects, Mode};
use rasterproof_render::pipeline::target::Target;
use rasterproof_render::scene::Scene;

use crate::effects::differing;

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
    fn new(effects: &str, times: &Times, same: bool) -> Self {
        let Spread { low, median, high } = times.spread().times(1e-3);
        let (effects, times) = (effects.to_owned(), times.clone());
        Self {
            effects,
            rounds: times.rounds(),
            time_us: median,
            quartiles_us: [low, high],
            same,
            times,
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
    fn new(work: u64, times: Option<Ratio>) -> Self {
        Self { work, times: times.filter(|_| work > 0) }
    }

    /// A share of the time, or that there is nothing to save.
    #[must_use]
    pub fn words(&self) -> String {
        self.times.map_or("no work".to_owned(), |ratio| ratio.saving())
    }
}

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
    pub fn all(&self) -> impl Iterator<Item = &Measured> {
        [&self.everything, &self.usual, &self.planned].into_iter().chain(&self.mixtures)
    }

    /// The mixtures with another picture.
    pub fn different(&self) -> impl Iterator<Item = &str> {
        let timed = self.all().filter(|mixture| !mixture.same).map(|mixture| &*mixture.effects);
        timed.chain(self.changed.iter().map(String::as_str))
    }
}

const WHOLE: [(&str, Effects); 3] =
    [("all", Effects::ALWAYS), ("usual", Effects::USUAL), ("planned", Effects::PLANNED)];

/// A frame that was drawn once: what it did, and whether it has the bits of the one that pays for everything.
struct TriedMixture {
    name: String,
    effects: Effects,
    /// Of the effect that is switched over in it.
    work: u64,
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
    let mut draw = |effects: &Effects| {
        let rendered = drawer.render(scene, effects, target)?;
        drawn();
        Ok::<_, BadScene>(rendered)
    };
    // Only those are kept that are shown.
    let [everything, usual, planned] =
        [draw(&Effects::ALWAYS)?, draw(&Effects::USUAL)?, draw(&Effects::PLANNED)?];
    let mut timing = Timing { rounds: rounds.map(|rounds| rounds as usize), ..PLAN };
    let mut mixtures = Vec::new();
    let effects =
        if is_whole || (rounds.is_none() && is_slow(&mut draw)?) { &[][..] } else { &Effect::ALL };
    for &effect in effects {
        let name = effect.name();
        for (base, name, effects) in [
            (
                &everything,
                format!("all, {name} planned"),
                Effects::ALWAYS.with(effect, Mode::Planned),
            ),
            (&planned, format!("planned,+{name}"), Effects::PLANNED.with(effect, Mode::Always)),
        ] {
            let rendered = draw(&effects)?;
            let work = effect.calls(&rendered.counters).abs_diff(effect.calls(&base.counters));
            let same = rendered.picture == everything.picture;
            mixtures.push(TriedMixture { name, effects, work, same });
        }
    }
    // The whole frames, and those whose work differs from that of the frame that they are compared with.
    let mut timed = WHOLE.map(|(_, effects)| effects).to_vec();
    let mut pairs: Vec<Pair> = vec![[0, 2], [1, 2]];
    let places: Vec<Option<usize>> = (0..mixtures.len())
        .map(|number| {
            let TriedMixture { effects, work, .. } = &mixtures[number];
            (*work > 0).then(|| {
                timed.push(*effects);
                // Everything is compared with the even ones, and the odd ones with the plan.
                let last = timed.len() - 1;
                pairs.push(if number.is_multiple_of(2) { [0, last] } else { [last, 2] });
                last
            })
        })
        .collect();
    let shared = RefCell::new(target);
    let pass = |effects: Effects| {
        let shared = &shared;
        Pass::new(move || {
            let rendered = drawer.render(scene, &effects, &mut shared.borrow_mut());
            std::hint::black_box(rendered.is_ok());
        })
    };
    let mut passes: Vec<Pass<'_>> = timed.into_iter().map(pass).collect();
    if is_whole {
        timing = timing.within(0.5);
    }
    let times = compare(&mut passes, timing, &|_| pairs.clone(), &|_| drawn());
    drop(passes);
    let target = shared.into_inner();
    let whole = [&everything, &usual, &planned];
    let whole = [0, 1, 2]
        .map(|i| Measured::new(WHOLE[i].0, &times[i], whole[i].picture == everything.picture));
    let mut savings = Savings {
        times: [0, 1].map(|i| whole[i].over(&whole[2])),
        noise: times[0].noise(),
        effects: Vec::new(),
        mixtures: Vec::new(),
        changed: Vec::new(),
        everything: whole[0].clone(),
        usual: whole[1].clone(),
        planned: whole[2].clone(),
    };
    let [all, _, plan] = &whole;
    let saves: Vec<Saves> = mixtures
        .iter()
        .zip(&places)
        .enumerate()
        .map(|(number, (TriedMixture { name, work, same, .. }, place))| {
            let Some(place) = place else {
                savings.changed.extend((!same).then(|| name.clone()));
                return Saves::new(0, None);
            };
            let mixture = Measured::new(name, &times[*place], *same);
            let ratio =
                if number.is_multiple_of(2) { all.over(&mixture) } else { mixture.over(plan) };
            savings.mixtures.push(mixture);
            Saves::new(*work, Some(ratio))
        })
        .collect();
    for (&effect, pair) in effects.iter().zip(saves.chunks_exact(2)) {
        let without = drawer.render_without(scene, effect, target)?;
        savings.effects.push(Saving {
            effect,
            alone: pair[0],
            last: pair[1],
            wrong_without: differing(&without.picture, &everything.picture, 0).count() as u64,
        });
    }
    Ok((savings, [everything, planned]))
}

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
        let times = compare(&mut [Pass::new(survey)], timing, &|_| Vec::new(), &|_| ());
        us = times.first().map(|times| times.median() / 1e3);
    })?;
    Ok(us)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Made-up times in which a frame takes half as long without an effect: it saves that where it does work, and nothing where it
    /// does none.
    #[test]
    fn what_does_no_work_saves_nothing() {
        let times = Times::of(vec![vec![2.0; 8], vec![1.0; 8]], None);
        let ratio = times[0].over(&times[1]);
        assert_eq!(Saves::new(7, ratio).words(), "50% (46 to 53)");
        assert_eq!(Saves::new(0, ratio).words(), "no work");
    }
}
