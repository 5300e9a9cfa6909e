//! What planning the effects of a scene saves: the times of whole frames by every mixture of planned effects and of those that are
//! always paid for.

use std::time::{Duration, Instant};

use rasterproof_registry::engines::Drawer;
use rasterproof_render::effects::plan::Canvas;
use rasterproof_render::effects::render::{BadScene, Rendered, survey_again};
use rasterproof_render::effects::{Effect, Effects, Mode};
use rasterproof_render::pipeline::target::Target;
use rasterproof_render::scene::Scene;

use crate::effects::differing;

#[derive(Clone, Debug, serde::Serialize)]
pub struct Measured {
    pub effects: String,
    pub rounds: usize,
    pub time_us: f64,
    /// The fastest round and the slowest.
    pub range_us: [f64; 2],
    /// A quarter of the rounds is faster than the first, a quarter slower than the second.
    pub quartiles_us: [f64; 2],
    /// Whether the picture has the bits of the one that pays for everything.
    pub same: bool,
}

/// The fewest rounds of which quartiles are compared.
const FEWEST_ROUNDS: usize = 4;

impl Measured {
    /// Whether the middle halves of their rounds overlap, or the rounds are too few to say.
    fn is_noise(&self, other: &Self) -> bool {
        let ([a0, a1], [b0, b1]) = (self.quartiles_us, other.quartiles_us);
        self.rounds.min(other.rounds) < FEWEST_ROUNDS || a0 <= b1 && b0 <= a1
    }
}

#[derive(Clone, Debug, serde::Serialize)]
pub struct Saving {
    pub effect: Effect,
    /// Time of the frame in which it is planned and everything else paid for, and what share that
    /// is less than to pay for everything, and whether the difference is within the noise.
    pub alone_us: f64,
    pub saves_alone: f64,
    pub noise_alone: bool,
    /// Time of the frame in which it is paid for and everything else planned, and what share of it is saved when this effect is
    /// planned, too.
    pub all_but_us: f64,
    pub saves_last: f64,
    pub noise_last: bool,
    /// Pixels that change when it is left out everywhere.
    pub wrong_without: u64,
}

#[derive(Clone, Debug, serde::Serialize)]
pub struct Savings {
    pub everything: Measured,
    pub usual: Measured,
    pub planned: Measured,
    pub effects: Vec<Saving>,
    pub mixtures: Vec<Measured>,
}

impl Savings {
    pub fn all(&self) -> impl Iterator<Item = &Measured> {
        [&self.everything, &self.usual, &self.planned].into_iter().chain(&self.mixtures)
    }

    /// How many times as fast the plan is as everything on, and as usual.
    #[must_use]
    pub fn factors(&self) -> [f64; 2] {
        [&self.everything, &self.usual].map(|other| other.time_us / self.planned.time_us)
    }

    /// The same in words. No number is given where no difference was measured: the middle halves of the rounds overlap, or the
    /// factor rounds to 1.
    #[must_use]
    pub fn phrases(&self) -> [String; 2] {
        let phrase = |other: &Measured| {
            let factor = format!("{:.1}", other.time_us / self.planned.time_us);
            let has_quartiles = self.planned.rounds.min(other.rounds) >= FEWEST_ROUNDS;
            match has_quartiles && self.planned.is_noise(other) || factor == "1.0" {
                true => "as fast".to_owned(),
                false => format!("{factor} times as fast"),
            }
        };
        [&self.everything, &self.usual].map(phrase)
    }
}

const WHOLE: [(&str, Effects); 3] =
    [("all", Effects::ALWAYS), ("usual", Effects::USUAL), ("planned", Effects::PLANNED)];

/// Everything on, as usual, everything planned, then for each effect that one planned, and all the others planned.
fn mixtures() -> Vec<(String, Effects)> {
    let of = |effect: Effect| {
        let name = effect.name();
        [
            (format!("all, {name} planned"), Effects::ALWAYS.with(effect, Mode::Planned)),
            (format!("planned,+{name}"), Effects::PLANNED.with(effect, Mode::Always)),
        ]
    };
    let whole = WHOLE.map(|(name, effects)| (name.to_owned(), effects));
    whole.into_iter().chain(Effect::ALL.into_iter().flat_map(of)).collect()
}

/// How many rounds are measured where no number is given, and how long they may take all together.
const USUAL_ROUNDS: u32 = 9;
const BUDGET: Duration = Duration::from_secs(10);

/// How many rounds fit into the budget, and with how many mixtures: all of them, or the whole ones alone
/// if not even two rounds of all fit. `warm` is the time of one round of the whole ones.
fn fitting(warm: Duration, mixtures: usize) -> (u32, usize) {
    let of = |count: usize| warm.as_secs_f64() * count as f64 / WHOLE.len() as f64;
    let rounds = |count: usize| (BUDGET.as_secs_f64() / of(count).max(1e-9)) as u32;
    match rounds(mixtures) {
        // One of them warms up.
        0 | 1 => (rounds(WHOLE.len()).clamp(1, USUAL_ROUNDS), WHOLE.len()),
        some => ((some - 1).min(USUAL_ROUNDS), mixtures),
    }
}

/// Interleaved rounds of every mixture, or of the whole ones alone: the times, the frame that pays for everything, and the planned
/// one. `drawn` is called after each frame.
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
    let mut mixtures = mixtures();
    if is_whole {
        mixtures.truncate(WHOLE.len());
    }
    let mut draw = |effects: &Effects| {
        let start = Instant::now();
        let rendered = drawer.render(scene, effects, target)?;
        drawn();
        Ok::<_, BadScene>((start.elapsed(), rendered))
    };
    // The first round warms up and compares the pictures. Only those are kept that are shown.
    let [first, usual, last] =
        [draw(&Effects::ALWAYS)?, draw(&Effects::USUAL)?, draw(&Effects::PLANNED)?];
    let warm = first.0 + usual.0 + last.0;
    let (everything, planned) = (first.1, last.1);
    let whole = [&everything, &usual.1, &planned];
    let mut same = whole.map(|one| one.picture == everything.picture).to_vec();
    let (rounds, kept) = match rounds {
        Some(rounds) => (rounds, mixtures.len()),
        None => fitting(warm, mixtures.len()),
    };
    mixtures.truncate(kept);
    for (_, effects) in &mixtures[WHOLE.len()..] {
        same.push(draw(effects)?.1.picture == everything.picture);
    }
    let mut times: Vec<Vec<Duration>> = vec![Vec::new(); mixtures.len()];
    for round in 1..=rounds {
        for k in 0..mixtures.len() {
            // Another one begins each round, so that none always follows the same.
            let i = (k + round as usize) % mixtures.len();
            times[i].push(draw(&mixtures[i].1)?.0);
        }
    }
    times.iter_mut().for_each(|times| times.sort_unstable());
    let measured = |i: usize| {
        let (effects, rounds, same) = (mixtures[i].0.clone(), times[i].len(), same[i]);
        let us = |rank: usize| times[i][rank].as_secs_f64() * 1e6;
        let (time_us, range_us) = (us(rounds / 2), [us(0), us(rounds - 1)]);
        let quartiles_us = [1, 3].map(|n| us((rounds - 1) * n / 4));
        Measured { effects, rounds, time_us, range_us, quartiles_us, same }
    };
    let mut savings = Savings {
        everything: measured(0),
        usual: measured(1),
        planned: measured(2),
        effects: Vec::new(),
        mixtures: (WHOLE.len()..mixtures.len()).map(measured).collect(),
    };
    // As many as were measured: none of a large model.
    for (effect, pair) in Effect::ALL.into_iter().zip(savings.mixtures.chunks_exact(2)) {
        let without = drawer.render_without(scene, effect, target)?;
        savings.effects.push(Saving {
            effect,
            alone_us: pair[0].time_us,
            saves_alone: 1.0 - pair[0].time_us / savings.everything.time_us,
            noise_alone: pair[0].is_noise(&savings.everything),
            all_but_us: pair[1].time_us,
            saves_last: 1.0 - savings.planned.time_us / pair[1].time_us,
            noise_last: pair[1].is_noise(&savings.planned),
            wrong_without: differing(&without.picture, &everything.picture, 0).count() as u64,
        });
    }
    Ok((savings, [everything, planned]))
}

/// Microseconds that a planned frame looks at triangles for the reason of depth, the median; none where it lists all.
///
/// # Errors
/// [`BadScene`].
pub fn survey_us(scene: &Scene, target: &Target) -> Result<Option<f64>, BadScene> {
    const ROUNDS: usize = 9;
    let mut times = Vec::with_capacity(ROUNDS);
    survey_again(scene, &Canvas::of(target), &mut |survey| {
        for _ in 0..ROUNDS {
            let start = Instant::now();
            survey();
            times.push(start.elapsed().as_secs_f64() * 1e6);
        }
    })?;
    times.sort_by(f64::total_cmp);
    Ok(times.get(ROUNDS / 2).copied())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn measured(time_us: f64, quartiles_us: [f64; 2], rounds: usize) -> Measured {
        let (effects, range_us) = (String::new(), quartiles_us);
        Measured { effects, rounds, time_us, range_us, quartiles_us, same: true }
    }

    /// A number is said of what differs alone.
    #[test]
    fn what_does_not_differ_has_no_factor() {
        let phrases = |usual: Measured, rounds: usize| {
            let savings = Savings {
                everything: measured(85.0, [80.0, 90.0], rounds),
                usual,
                planned: measured(10.0, [9.0, 11.0], rounds),
                effects: Vec::new(),
                mixtures: Vec::new(),
            };
            savings.phrases()
        };
        let slow = "8.5 times as fast".to_owned();
        let like = [slow.clone(), "as fast".to_owned()];
        assert_eq!(phrases(measured(12.0, [10.0, 14.0], 9), 9), like, "within the noise");
        assert_eq!(phrases(measured(10.3, [10.0, 10.6], 1), 1), like, "1.0 times");
        let faster = [slow, "1.2 times as fast".to_owned()];
        assert_eq!(phrases(measured(12.0, [11.5, 14.0], 9), 9), faster);
        // Too few rounds for quartiles.
        assert_eq!(phrases(measured(12.0, [10.0, 14.0], 1), 1), faster);
    }
}
