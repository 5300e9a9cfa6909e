//! Diagrams of chapters 4 to 10: film, clipping, the cube, the hands.

use glam::{DVec3, DVec4};

use super::{Drawing, Point, between};
use rasterproof_render::pipeline::ClipVertex;
use rasterproof_render::pipeline::clip::{ClipPlane, clip};
use rasterproof_render::pipeline::transform::frustum;

/// Device coordinates of a point; the film is 1 before the eye and reaches from -1 to 1.
fn ndc(p: DVec3) -> DVec3 {
    let clip = frustum(-1.0, 1.0, -1.0, 1.0, 1.0, 6.0).expect("it is a frustum") * p.extend(1.0);
    clip.truncate() / clip.w
}

/// Halfway in space and halfway on the film, from above: x to the right, z up.
pub fn share() -> String {
    let at = |[x, z]: Point| [180.0 + x * 50.0, 350.0 - z * 50.0];
    let mut drawing = Drawing::new(540.0, 380.0);
    let rod: [Point; 2] = [[-2.0, 2.0], [6.0, 6.0]];
    let film = |[x, z]: Point| [ndc(DVec3::new(x, 0.0, z)).x, 1.0];
    let middle = between(rod[0], rod[1], 0.5);
    drawing.line("ink", at([-1.6, 1.0]), at([1.6, 1.0]));
    drawing.line("one", at(rod[0]), at(rod[1]));
    for p in [rod[0], middle, rod[1]] {
        drawing.line("soft", at([0.0, 0.0]), at(p));
        drawing.dot("dot1", at(p), 5.0);
        drawing.dot("dot2", at(film(p)), 5.0);
    }
    let [a, m, b] = [rod[0], middle, rod[1]].map(|p| film(p)[0]);
    drawing.label("end", at(middle), [-8.0, -8.0], "t = 0.5");
    drawing.label("start", at(film(middle)), [50.0, 22.0], &format!("t' = {}", (m - a) / (b - a)));
    for (name, p) in [("w = 2", rod[0]), ("w = 6", rod[1])] {
        drawing.label("middle", at(p), [0.0, -12.0], name);
    }
    drawing.dot("dot", at([0.0, 0.0]), 4.0);
    drawing.text("end", at([-1.7, 1.0]), "n = 1");
    drawing.svg()
}

/// Equal steps along an edge in space, from above, and where they appear in the picture.
pub fn steps() -> String {
    let at = |[x, z]: Point| [40.0 + x * 40.0, 250.0 - z * 70.0];
    let ends: [Point; 2] = [[0.0, 1.0], [12.0, 3.0]];
    let film = |[x, z]: Point| [x / z, 1.0];
    let mut drawing = Drawing::new(600.0, 290.0);
    drawing.line("ink", at([0.0, 1.0]), at([4.4, 1.0]));
    drawing.line("one", at(ends[0]), at(ends[1]));
    for quarter in 0..=4 {
        let t = f64::from(quarter) / 4.0;
        let p = between(ends[0], ends[1], t);
        drawing.line("soft", at([0.0, 0.0]), at(p));
        drawing.dot("dot1", at(p), 5.0);
        drawing.dot("dot2", at(film(p)), 5.0);
        if quarter > 0 {
            let [x, y] = at(p);
            drawing.text("middle", [x, y - 12.0], &format!("t = {t}"));
            let [x, _] = at(film(p));
            let [_, y] = at([0.0, 1.0]);
            let share = film(p)[0] / film(ends[1])[0];
            // The shares are close to each other: every other one is a line lower.
            let low = if quarter % 2 == 0 { 44.0 } else { 24.0 };
            drawing.text("middle", [x + 4.0, y + low], &format!("{share:.2}"));
        }
    }
    drawing.dot("dot", at([0.0, 0.0]), 4.0);
    drawing.text("end", [30.0, 185.0], "t'");
    drawing.svg()
}

/// The stored depth over the distance, for n = 1 and f = 100.
pub fn depth() -> String {
    let projection = frustum(-1.0, 1.0, -1.0, 1.0, 1.0, 100.0).expect("it is a frustum");
    let stored = |z: f64| {
        let p = projection * DVec3::new(0.0, 0.0, z).extend(1.0);
        (p.z / p.w + 1.0) / 2.0
    };
    let at = |[z, d]: Point| [60.0 + z * 5.0, 250.0 - d * 200.0];
    let mut drawing = Drawing::new(600.0, 290.0);
    drawing.arrow("ink", at([0.0, 0.0]), at([104.0, 0.0]));
    drawing.arrow("ink", at([0.0, 0.0]), at([0.0, 1.08]));
    drawing.line("soft", at([0.0, 1.0]), at([100.0, 1.0]));
    // Even steps of 1/z, so that the steep part has as many points as the flat one.
    let distance = |i: i32| 1.0 / (1.0 - 0.99 * f64::from(i) / 200.0);
    let curve: Vec<Point> = (0..=200).map(distance).map(|z| [z, stored(z)]).collect();
    for pair in curve.windows(2) {
        drawing.line("one", at(pair[0]), at(pair[1]));
    }
    for (z, label) in [(1.0, false), (2.0, true), (10.0, true), (50.0, true), (100.0, false)] {
        let d = stored(z);
        drawing.dot("dot2", at([z, d]), 4.0);
        let [x, y] = at([z, 0.0]);
        // The first two are too close for a number each.
        if z > 1.5 {
            drawing.text("middle", [x, y + 20.0], &format!("{z}"));
        }
        let [x, y] = at([z, d]);
        if label {
            drawing.text("start", [x + 8.0, y + 18.0], &format!("{d:.3}"));
        }
    }
    drawing.text("end", at([-2.0, 0.98]), "1");
    drawing.text("end", at([-2.0, -0.02]), "0");
    drawing.text("start", at([105.0, -0.02]), "z");
    drawing.text("middle", at([0.0, 1.1]), "d");
    drawing.svg()
}

/// A triangle with a corner behind the near plane, the points where it goes out and comes in.
pub fn near_plane() -> String {
    // Seen from the side: x upwards, z to the right; w is 1 and the border at z = -1.
    let at = |[z, x]: Point| [200.0 + z * 70.0, 190.0 - x * 70.0];
    let corners: [Point; 3] = [[1.5, 1.6], [2.5, -1.0], [-2.0, -0.4]];
    let vertex = |[z, x]: Point| ClipVertex { position: DVec4::new(x, 0.0, z, 1.0), varying: 0.0 };
    let (kept, _) = clip(&corners.map(vertex), ClipPlane::Near.bit());
    let kept: Vec<Point> = kept.vertices().map(|v| [v.position.z, v.position.x]).collect();
    let mut drawing = Drawing::new(420.0, 310.0);
    drawing.polygon("soft", &corners.map(at));
    let on_drawing: Vec<_> = kept.iter().map(|&p| at(p)).collect();
    drawing.polygon("fill1", &on_drawing);
    drawing.polygon("one", &on_drawing);
    drawing.line("ink", at([-1.0, 2.2]), at([-1.0, -1.5]));
    drawing.text("middle", at([-1.0, -1.65]), "w + z = 0");
    for (i, p) in corners.into_iter().enumerate() {
        let [x, y] = at(p);
        drawing.dot("dot", [x, y], 4.0);
        drawing.text("middle", [x, y - 10.0], ["a", "b", "c"][i]);
    }
    // Walking a, b, c: out on the way to c, in on the way back to a.
    let mut cuts: Vec<_> = kept.into_iter().filter(|p| p[0] == -1.0).collect();
    cuts.sort_by(|p, q| p[1].total_cmp(&q[1]));
    for (p, word) in cuts.into_iter().zip(["out 出点", "in 入点"]) {
        let [x, y] = at(p);
        drawing.dot("dot2", [x, y], 6.0);
        drawing.text("end", [x - 10.0, y + if word.starts_with("in") { -8.0 } else { 20.0 }], word);
    }
    drawing.svg()
}

/// The frustum with equal steps of depth, and where they land in the cube.
pub fn cube() -> String {
    let mut drawing = Drawing::new(600.0, 320.0);
    let left = |[x, z]: Point| [150.0 + x * 22.0, 300.0 - z * 45.0];
    let right = |[x, z]: Point| [450.0 + x * 110.0, 160.0 - z * 110.0];
    let (near, far) = ([[-1.0, 1.0], [1.0, 1.0]], [[6.0, 6.0], [-6.0, 6.0]]);
    let whole = [near[0], near[1], far[0], far[1]];
    let land = |[x, z]: Point| {
        let p = ndc(DVec3::new(x, 0.0, z));
        right([p.x, p.z])
    };
    for z in 1..=6 {
        let z = f64::from(z);
        drawing.line("soft", left([-z, z]), left([z, z]));
        drawing.line("soft", land([-z, z]), land([z, z]));
        let [x, y] = land([z, z]);
        // The far steps crowd: every other one is named.
        if z < 4.0 || z == 6.0 {
            drawing.text("start", [x + 8.0, y + 5.0], &format!("{z}"));
        }
        drawing.label("start", left([z, z]), [8.0, 5.0], &format!("{z}"));
    }
    drawing.polygon("one", &whole.map(left));
    drawing.polygon("one", &whole.map(land));
    drawing.line("ink", left([0.0, 0.0]), left([1.0, 1.0]));
    drawing.line("ink", left([0.0, 0.0]), left([-1.0, 1.0]));
    drawing.dot("dot", left([0.0, 0.0]), 4.0);
    drawing.arrow("ink", [298.0, 240.0], [332.0, 240.0]);
    drawing.text("middle", [450.0, 290.0], "z'/w' = −1: near 近平面");
    drawing.text("middle", [450.0, 40.0], "z'/w' = 1: far 远平面");
    drawing.svg()
}

pub fn handedness() -> String {
    let mut drawing = Drawing::new(440.0, 200.0);
    for (origin, z, sign) in
        [([90.0, 130.0], [60.0, -45.0], "+z"), ([320.0, 130.0], [-55.0, 45.0], "+z")]
    {
        let end = |[x, y]: Point| [origin[0] + x, origin[1] + y];
        drawing.arrow("one", origin, end([90.0, 0.0]));
        drawing.arrow("two", origin, end([0.0, -95.0]));
        drawing.arrow("ink", origin, end(z));
        drawing.text("start", end([94.0, 5.0]), "+x");
        drawing.text("middle", end([0.0, -102.0]), "+y");
        let [x, y] = end(z);
        drawing.text("middle", [x + z[0].signum() * 14.0, y + 5.0], sign);
    }
    drawing.text("middle", [110.0, 188.0], "left-handed 左手系");
    drawing.text("middle", [350.0, 188.0], "right-handed 右手系");
    drawing.svg()
}
