//! What the acceptance rules of other people's test suites let through: each [`rules::Rule`] decides about pictures of
//! faults that are known, and of right rasterizers with another permitted convention.
//!
//! The pictures are drawn here, so every rule sees the same ones. A rule refuses a program where it refuses one of its
//! pictures.

pub mod deqp;
pub mod drawing;
pub mod perceptual;
pub mod rules;
pub mod scenes;

use rasterproof_core::parallel;

use drawing::{Rasterizer, Rendering, draw};
use rules::{RULES, View};
use scenes::{Scene, scenes};
use serde::Serialize;

/// What a rule accepted and refused of a set of pictures.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Row {
    pub rule: &'static str,
    /// Faults that the rule refuses in at least one picture.
    pub caught: Vec<&'static str>,
    /// Faults that it accepts in every picture that it looks at.
    pub passed: Vec<Passed>,
    /// Pictures of faults that differ from the right picture and that the rule looks at.
    pub wrong_pictures: u64,
    /// Of these, the ones that it refuses.
    pub refused_pictures: u64,
    /// The accepted picture with the largest share of wrong pixels.
    pub worst_picture: Option<WrongPicture>,
    /// Pictures that the rule is not used on, since it refuses the right one.
    pub unusable_pictures: u64,
    /// Right rasterizers of which it refuses at least one picture.
    pub refused_right: Vec<&'static str>,
    /// Pictures of right rasterizers that it looks at, and those of them that it refuses.
    pub right_pictures: u64,
    pub refused_right_pictures: u64,
}

/// A fault that a rule let through, and how much it got wrong.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Passed {
    #[serde(rename = "fault")]
    pub name: &'static str,
    /// Pixels of all pictures of the set in which it differs from the right picture.
    pub wrong_pixels: u64,
    pub pixels: u64,
}

/// An accepted picture that differs from the right one.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct WrongPicture {
    #[serde(rename = "fault")]
    pub name: &'static str,
    pub scene: String,
    pub wrong_pixels: u64,
    pub pixels: u64,
}

impl WrongPicture {
    /// The wrong pixels as a share of all.
    fn share(&self) -> f64 {
        self.wrong_pixels as f64 / self.pixels as f64
    }
}

impl Row {
    /// The accepted fault with the fewest wrong pixels, at least one.
    pub fn smallest(&self) -> Option<&Passed> {
        self.passed.iter().filter(|fault| fault.wrong_pixels > 0).min_by_key(|f| f.wrong_pixels)
    }

    /// The accepted fault with the most wrong pixels.
    pub fn most_harmful(&self) -> Option<&Passed> {
        self.passed.iter().filter(|fault| fault.wrong_pixels > 0).max_by_key(|f| f.wrong_pixels)
    }
}

/// What all rules accepted and refused, on both sets of pictures.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Acceptance {
    pub faults: Vec<&'static str>,
    pub right: Vec<&'static str>,
    /// Scenes such as test suites use, one row for each of [`RULES`].
    pub suites: Vec<Row>,
    /// Hard cases of this project, alike.
    pub hard: Vec<Row>,
    /// How many scenes the suites' set has, and the set of hard cases.
    pub scenes: [usize; 2],
    /// Faults that differ from the right picture in at least one picture of the set.
    pub visible: [usize; 2],
}

/// What the picture of one rasterizer came to in one scene.
struct SceneJudgement {
    wrong_pixels: u64,
    pixels: u64,
    /// For each rule whether it accepts, where it looks at such a scene.
    accepts: Vec<Option<bool>>,
}

/// Computes the report; a pure function of the seed. `step` is called for every scene.
#[must_use]
pub fn report(seed: u64, step: &(dyn Fn() + Sync)) -> Acceptance {
    let (subjects, list) = (Rasterizer::all(), scenes(seed));
    let judged = parallel::map(list.len(), |i| {
        let judged = judge(&list[i], &subjects);
        step();
        judged
    });
    let mut report = Acceptance::default();
    for subject in &subjects {
        let of = if subject.is_right() { &mut report.right } else { &mut report.faults };
        of.push(subject.name());
    }
    for (set, of_suites) in [(0, true), (1, false)] {
        // The scenes of this set, with what all subjects drew there, and which rules accept the right picture.
        let mut of_set: Vec<(&Scene, &[SceneJudgement])> = Vec::new();
        let mut usable: Vec<&[Option<bool>]> = Vec::new();
        for (scene, (judgements, accepts_right)) in list.iter().zip(&judged) {
            if scene.of_suites == of_suites {
                of_set.push((scene, judgements));
                usable.push(accepts_right);
            }
        }
        let rows = if of_suites { &mut report.suites } else { &mut report.hard };
        for (number, rule) in RULES.iter().enumerate() {
            let refused = usable.iter().filter(|accepts| accepts[number] == Some(false));
            let unusable_pictures = refused.count() as u64;
            let row = row(number, &subjects, &of_set);
            rows.push(Row { rule: rule.name, unusable_pictures, ..row });
        }
        report.scenes[set] = of_set.len();
        for (s, subject) in subjects.iter().enumerate() {
            let changes = of_set.iter().any(|(_, judged)| judged[s].wrong_pixels > 0);
            report.visible[set] += usize::from(changes && !subject.is_right());
        }
    }
    report
}

/// What each subject's picture of a scene came to, and for each rule whether it accepts the right picture.
fn judge(scene: &Scene, subjects: &[Rasterizer]) -> (Vec<SceneJudgement>, Vec<Option<bool>>) {
    let right = draw(&Rasterizer::Reference, scene);
    let seen = rules::RightPicture::new(scene, &right);
    // A rule that refuses the right picture is of no use in this scene.
    let subject = &Rasterizer::Reference;
    let usable = decisions(&View { scene, seen: &seen, right: &right, drawn: &right, subject });
    let mut all = Vec::new();
    for subject in subjects {
        if !subject.can_draw(scene) {
            all.push(SceneJudgement {
                wrong_pixels: 0,
                pixels: 0,
                accepts: vec![None; RULES.len()],
            });
            continue;
        }
        let drawn = draw(subject, scene);
        let view = View { scene, seen: &seen, right: &right, drawn: &drawn, subject };
        let mut accepts = decisions(&view);
        // Who writes a suite sees that the right picture is refused, and leaves the scene out.
        for (accepts, usable) in accepts.iter_mut().zip(&usable) {
            *accepts = accepts.filter(|_| *usable == Some(true));
        }
        let (wrong_pixels, pixels) = (differing(&right, &drawn), right.pixels.len() as u64);
        all.push(SceneJudgement { wrong_pixels, pixels, accepts });
    }
    (all, usable)
}

/// For each rule whether it accepts a picture.
fn decisions(view: &View<'_>) -> Vec<Option<bool>> {
    RULES.iter().map(|rule| rule.accepts(view)).collect()
}

/// The number of pixels that differ; all of them where there is no picture.
fn differing(right: &Rendering, drawn: &Rendering) -> u64 {
    if drawn.failed {
        return right.pixels.len() as u64;
    }
    right.pixels.iter().zip(&drawn.pixels).filter(|(a, b)| a != b).count() as u64
}

/// What a rule, by its number, accepts and refuses of the pictures that subjects drew of scenes.
fn row(rule: usize, subjects: &[Rasterizer], scenes: &[(&Scene, &[SceneJudgement])]) -> Row {
    let mut row = Row::default();
    for (s, subject) in subjects.iter().enumerate() {
        let (mut refused, mut seen, mut wrong, mut pixels) = (0, 0, 0, 0);
        for (scene, judged) in scenes {
            let judged = &judged[s];
            wrong += judged.wrong_pixels;
            pixels += judged.pixels;
            let Some(accepts) = judged.accepts[rule] else { continue };
            seen += 1;
            refused += u64::from(!accepts);
            if subject.is_right() || judged.wrong_pixels == 0 {
                continue;
            }
            // From here on the picture is wrong: one that is accepted is the worst where it has the largest share of wrong pixels.
            row.wrong_pictures += 1;
            row.refused_pictures += u64::from(!accepts);
            if accepts {
                let picture = WrongPicture {
                    name: subject.name(),
                    scene: scene.name.clone(),
                    wrong_pixels: judged.wrong_pixels,
                    pixels: judged.pixels,
                };
                if row.worst_picture.as_ref().is_none_or(|worst| worst.share() < picture.share()) {
                    row.worst_picture = Some(picture);
                }
            }
        }
        match (subject.is_right(), refused > 0) {
            (true, is_refused) => {
                row.right_pictures += seen;
                row.refused_right_pictures += refused;
                row.refused_right.extend(is_refused.then_some(subject.name()));
            }
            (false, true) => row.caught.push(subject.name()),
            (false, false) => {
                row.passed.push(Passed { name: subject.name(), wrong_pixels: wrong, pixels });
            }
        }
    }
    row
}

#[cfg(test)]
mod tests;
