//! Faults in the stages of the pipeline: clipping, culling, effects.

use glam::DVec2;

use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::SubpixelPoint;
use rasterproof_core::triangle::Corners;
use rasterproof_render::effects::{Effect, Effects, Mode};
use rasterproof_render::pipeline::ClipVertex;
use rasterproof_render::pipeline::assemble::Cull;
use rasterproof_render::pipeline::clip::{self, ClipPlane, Outcode};

planted! {
    StageMutant {
        ForgetsNear "clip-forgets-near": "clipping forgets the near plane",
        FromStartToEnd "clip-from-start-to-end": "a crossing depends on the direction of its edge",
        NotAssigned "clip-not-assigned":
            "a crossing keeps its interpolated coordinate, not the plane's",
        DropsLast "clip-drops-last": "clipping loses the last vertex of the polygon",
        DividesFirst "clip-divides-first": "positions are divided by w before they are clipped",
        CullSwapped "cull-swapped": "culling mixes up the two windings",
        CullByFloatArea "cull-by-float-area": "culling asks a float area with a threshold",
        EffectsIgnored "effects-ignored": "every effect is paid for, whatever was asked",
        ClearsAlways "effects-clear-always": "buffers are cleared, whatever was asked",
    }
}

/// Clips a triangle by the planes whose bits are set, and gives the polygon that is left.
type ClipStage = fn(&[ClipVertex<DVec2>; 3], Outcode) -> Vec<ClipVertex<DVec2>>;
/// Decides whether a triangle is removed.
type CullStage = fn(Cull, Corners) -> bool;
/// Chooses the effects of a frame from those that the user has set.
type ChooseStage = fn(Effects) -> Effects;

impl StageMutant {
    /// Puts the fault in the place of the stage it belongs to.
    pub fn replace(self, clip: &mut ClipStage, culls: &mut CullStage, choose: &mut ChooseStage) {
        match self {
            Self::ForgetsNear => *clip = |t, planes| real(t, planes & !ClipPlane::Near.bit()),
            Self::FromStartToEnd => *clip = |t, planes| textbook(t, planes, true, false),
            Self::NotAssigned => *clip = |t, planes| textbook(t, planes, false, true),
            Self::DropsLast => {
                *clip = |t, planes| {
                    let mut polygon = real(t, planes);
                    if polygon.len() > 3 {
                        polygon.pop();
                    }
                    polygon
                };
            }
            Self::DividesFirst => {
                *clip = |t, planes| {
                    let mut polygon = real(t, planes);
                    for vertex in &mut polygon {
                        vertex.position /= vertex.position.w;
                    }
                    polygon
                };
            }
            Self::CullSwapped => {
                *culls = |cull, [a, b, c]| cull.removes([a, c, b]);
            }
            Self::CullByFloatArea => *culls = by_float_area,
            Self::EffectsIgnored => *choose = |_| Effects::ALWAYS,
            Self::ClearsAlways => *choose = |asked| asked.with(Effect::Clear, Mode::Always),
        }
    }
}

fn real(triangle: &[ClipVertex<DVec2>; 3], planes: Outcode) -> Vec<ClipVertex<DVec2>> {
    clip::clip(triangle, planes).0.vertices().copied().collect()
}

/// |2A| < 1 px^2 counts as no winding, as floats with a threshold do.
fn by_float_area(cull: Cull, corners: Corners) -> bool {
    let [a, b, c] = corners.map_array(|p: SubpixelPoint| p.to_px());
    let area = (b.0 - a.0) * (c.1 - a.1) - (b.1 - a.1) * (c.0 - a.0);
    match cull {
        Cull::None => false,
        Cull::Clockwise => area > 1.0,
        Cull::CounterClockwise => area < -1.0,
    }
}

/// Sutherland and Hodgman as in most textbooks: sides asked anew at every plane, crossings from
/// start to end, coordinates as interpolated.
fn textbook(
    triangle: &[ClipVertex<DVec2>; 3],
    planes: Outcode,
    assigns: bool,
    inside_out: bool,
) -> Vec<ClipVertex<DVec2>> {
    let mut polygon = triangle.to_vec();
    for plane in ClipPlane::ALL.into_iter().filter(|plane| planes & plane.bit() != 0) {
        // One plane after the other; each may cut what the one before has made.
        let mut kept = Vec::new();
        for (i, start) in polygon.iter().enumerate() {
            let end = &polygon[(i + 1) % polygon.len()];
            let (from, to) = (plane.distance(start), plane.distance(end));
            if from >= 0.0 {
                kept.push(*start);
            }
            if (from >= 0.0) != (to >= 0.0) {
                // Always from the inner end, which is the right way to count.
                let turned = inside_out && from < 0.0;
                let (a, b, t) = if turned {
                    (end, start, to / (to - from))
                } else {
                    (start, end, from / (from - to))
                };
                let mut vertex = ClipVertex {
                    position: a.position + (b.position - a.position) * t,
                    varying: a.varying + (b.varying - a.varying) * t,
                };
                // The coordinate that the plane gives is exact, and the interpolated one is rounded.
                if assigns {
                    let p = &mut vertex.position;
                    match plane {
                        ClipPlane::MinW => {}
                        ClipPlane::Near => p.z = -p.w,
                        ClipPlane::Far => p.z = p.w,
                        ClipPlane::Left => p.x = -p.w,
                        ClipPlane::Right => p.x = p.w,
                        ClipPlane::Bottom => p.y = -p.w,
                        ClipPlane::Top => p.y = p.w,
                    }
                }
                kept.push(vertex);
            }
        }
        polygon = kept;
    }
    polygon
}
