//! Where an animation brings nodes at a moment, as appendix C of the specification states it.

use glam::DQuat;
use serde::Deserialize;

use super::data::Data;
use super::document::{Node, entry};
use crate::Pose;

/// An animation, as the document describes it.
#[derive(Deserialize)]
struct Animation {
    channels: Vec<Channel>,
    samplers: Vec<Sampler>,
}

/// What is moved, and by which sampler.
#[derive(Deserialize)]
struct Channel {
    /// The number of what gives the values.
    sampler: usize,
    target: Target,
}

/// The node, and which of its parts.
#[derive(Deserialize)]
struct Target {
    node: Option<usize>,
    /// `translation`, `rotation`, `scale` or `weights`.
    path: String,
}

/// The accessors of moments and of values.
#[derive(Deserialize)]
struct Sampler {
    /// The accessor of the moments, in seconds.
    input: usize,
    /// The accessor of the values at them.
    output: usize,
    /// `LINEAR` where there is none.
    interpolation: Option<String>,
}

/// Moves the nodes of a document to where an animation has them.
pub(super) fn apply(data: &mut Data<'_>, pose: Pose) -> Result<(), String> {
    let place = format!("animations[{}]", pose.animation);
    let animation = data.root.animations.get(pose.animation);
    let animation = animation.ok_or_else(|| match data.root.animations.len() {
        0 => "has no animations".to_owned(),
        count => format!("has the animations 1 to {count}, and not {}", pose.animation + 1),
    })?;
    let animation: Animation =
        serde_json::from_value(animation.clone()).map_err(|error| format!("{place}: {error}"))?;
    for Channel { sampler: number, target } in &animation.channels {
        let sampler = entry(&animation.samplers, &format!("{place}.samplers"), *number)?;
        let (Some(node), path) = (target.node, target.path.as_str()) else { continue };
        let value = value(data, sampler, path, pose.time_s).map_err(|e| format!("{place}: {e}"))?;
        let missing = || format!("{place}: nodes[{node}] is not there");
        let node = data.root.nodes.get_mut(node).ok_or_else(missing)?;
        set(node, path, &value);
    }
    Ok(())
}

/// Replaces what a node has by what an animation gives.
fn set(node: &mut Node, path: &str, value: &[f64]) {
    let value: Vec<f32> = value.iter().map(|number| *number as f32).collect();
    match (path, &value[..]) {
        ("translation", &[x, y, z]) => node.translation = Some([x, y, z]),
        ("scale", &[x, y, z]) => node.scale = Some([x, y, z]),
        ("rotation", &[x, y, z, w]) => node.rotation = Some([x, y, z, w]),
        ("weights", _) => node.weights = Some(value),
        _ => return,
    }
    // A node that moves has no matrix.
    node.matrix = None;
}

/// What a sampler gives at a time: before the first and after the last of its moments what it has there.
fn value(data: &Data<'_>, sampler: &Sampler, path: &str, time: f64) -> Result<Vec<f64>, String> {
    let times: Vec<f64> = data.vectors::<1>(sampler.input)?.into_iter().flatten().collect();
    if !times.iter().all(|time| time.is_finite()) {
        return Err(format!("accessors[{}] has a time that is no finite number", sampler.input));
    }
    let output = sampler.output;
    let values: Vec<f64> = match path {
        "translation" | "scale" => data.vectors::<3>(output)?.into_flattened(),
        "rotation" => data.vectors::<4>(output)?.into_flattened(),
        _ => data.vectors::<1>(output)?.into_flattened(),
    };
    // A cubic spline has three values at each moment.
    let is_cubic = sampler.interpolation.as_deref() == Some("CUBICSPLINE");
    let parts = if is_cubic { 3 } else { 1 };
    let width = values.len().checked_div(times.len() * parts).unwrap_or(0);
    let (Some(&first), Some(&last), 1..) = (times.first(), times.last(), width) else {
        return Err(format!("accessors[{output}] has too few values"));
    };
    let time = time.clamp(first, last.max(first));
    // The part of a moment: of a cubic one the tangent before it, the value, and the tangent after it.
    let at = |key: usize, part: usize| &values[(key * parts + part) * width..][..width];
    let middle = usize::from(is_cubic);
    let key = times.partition_point(|moment| *moment <= time).max(1) - 1;
    let from = at(key, middle);
    let Some(next) = times.get(key + 1) else { return Ok(from.to_vec()) };
    // Between two moments, the time as a part of the way from one to the other.
    let (to, span) = (at(key + 1, middle), next - times[key]);
    let t = if span > 0.0 { (time - times[key]) / span } else { 0.0 };
    let mixed = |weigh: &dyn Fn(usize) -> f64| (0..width).map(weigh).collect::<Vec<f64>>();
    Ok(match sampler.interpolation.as_deref() {
        Some("STEP") => from.to_vec(),
        _ if is_cubic => {
            let (leaving, arriving) = (at(key, 2), at(key + 1, 0));
            let (t2, t3) = (t * t, t * t * t);
            mixed(&|i| {
                (2.0 * t3 - 3.0 * t2 + 1.0) * from[i]
                    + span * (t3 - 2.0 * t2 + t) * leaving[i]
                    + (3.0 * t2 - 2.0 * t3) * to[i]
                    + span * (t3 - t2) * arriving[i]
            })
        }
        _ if path == "rotation" => {
            let turn = |of: &[f64]| DQuat::from_slice(of).normalize();
            between(turn(from), turn(to), t).to_array().to_vec()
        }
        _ => mixed(&|i| from[i] + (to[i] - from[i]) * t),
    })
}

/// A rotation on the shorter way from one to another. The angle is computed by functions that are the same on every machine.
fn between(from: DQuat, to: DQuat, t: f64) -> DQuat {
    let to = if from.dot(to) < 0.0 { -to } else { to };
    let angle = libm::acos(from.dot(to).min(1.0));
    let whole = libm::sin(angle);
    // A straight line is off by less than the third power of the angle, which doubles do not hold then.
    if whole < 1e-9 {
        return from.lerp(to, t);
    }
    from * (libm::sin((1.0 - t) * angle) / whole) + to * (libm::sin(t * angle) / whole)
}
