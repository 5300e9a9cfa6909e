//! Line conventions are recognised: made-up drawers for every hypothesis, and noise.

use rasterproof_verify::convention::{
    Confidence, End, Ends, LineConvention, LineDiagnosis, LineQuestion, LineRounding, Steps,
};

use rayon::prelude::*;

use super::synthetic::{hash, on_line};

/// A made-up drawer, in floats that are exact for such small numbers.
struct Drawer {
    convention: LineConvention,
    /// Of 1,000 pixels so many move by one.
    noise: u64,
}

/// What is found of such a drawer.
fn diagnosed(convention: LineConvention, noise: u64, side_px: i32) -> LineDiagnosis {
    let drawer = Drawer { convention, noise };
    super::diagnosed_lines(side_px, true, 5, |question| Some(drawer.draw(question.ends)))
}

/// Whether that end of the line from a to b is a; u is its major axis.
fn starts_at(end: End, a: [f64; 2], b: [f64; 2], u: usize) -> bool {
    match end {
        End::First => true,
        End::Small => a[u] < b[u],
        End::Left => (a[0], a[1]) < (b[0], b[1]),
        End::Top => a[1] < b[1],
    }
}

impl Drawer {
    /// The minor coordinate in column (or row) `at` of the line from a to b.
    fn minor(&self, a: [f64; 2], b: [f64; 2], u: usize, at: f64) -> f64 {
        let v = 1 - u;
        let slope = if a[u] == b[u] { 0.0 } else { (b[v] - a[v]) / (b[u] - a[u]) };
        // Divided last, so that whole and half results are exact.
        let ideal =
            if slope == 0.0 { a[v] } else { a[v] + (b[v] - a[v]) * (at - a[u]) / (b[u] - a[u]) };
        let toward = |end: f64| if end <= ideal { ideal.floor() } else { ideal.ceil() };
        match self.convention.rounding {
            LineRounding::Behind | LineRounding::Ahead => {
                unreachable!("they have steps of their own")
            }
            LineRounding::Down => ideal.floor(),
            LineRounding::Up => ideal.ceil(),
            LineRounding::Toward(end) => toward(if starts_at(end, a, b, u) { a[v] } else { b[v] }),
            LineRounding::Away(end) => toward(if starts_at(end, a, b, u) { b[v] } else { a[v] }),
            LineRounding::Nearest(tie) => {
                let mut pixel = [at, at];
                [ideal.floor(), ideal.ceil()]
                    .into_iter()
                    .find(|&candidate| {
                        pixel[v] = candidate;
                        on_line(a, b, pixel, tie)
                    })
                    .unwrap()
            }
        }
    }

    fn draw(&self, ends: [[i32; 2]; 2]) -> Vec<[i32; 2]> {
        let [a, b] = ends.map(|end| end.map(f64::from));
        if self.convention == LineConvention::BEHIND {
            return self.noisy(ends, behind(a, b));
        }
        if self.convention == LineConvention::AHEAD {
            return self.noisy(ends, ahead(a, b));
        }
        let u = usize::from((b[1] - a[1]).abs() > (b[0] - a[0]).abs());
        let count = (b[u] - a[u]).abs() as i32;
        let at = |v: f64, along: f64| if u == 0 { [along, v] } else { [v, along] };
        let mut pixels: Vec<[f64; 2]> = (0..=count)
            .map(|i| a[u] + f64::from(i) * (b[u] - a[u]).signum())
            .map(|along| at(self.minor(a, b, u, along), along))
            .collect();
        let major_first = match self.convention.steps {
            Steps::Corners => None,
            Steps::MajorFirst(end) => Some(starts_at(end, a, b, u)),
            Steps::MinorFirst(end) => Some(!starts_at(end, a, b, u)),
        };
        if let Some(major_first) = major_first {
            let mut all = vec![pixels[0]];
            for pair in pixels.windows(2) {
                let (p, q) = (pair[0], pair[1]);
                if p[0] != q[0] && p[1] != q[1] {
                    all.push(if major_first == (u == 0) { [q[0], p[1]] } else { [p[0], q[1]] });
                }
                all.push(q);
            }
            pixels = all;
        }
        let right = if (b[0], b[1]) > (a[0], a[1]) { b } else { a };
        let pixels = pixels
            .into_iter()
            .filter(|&p| match self.convention.ends {
                Ends::Both => true,
                Ends::WithoutLast => p != b,
                Ends::WithoutFirst => p != a,
                Ends::WithoutRight => p != right,
                Ends::Neither => p != a && p != b,
            })
            .collect();
        self.noisy(ends, pixels)
    }

    fn noisy(&self, ends: [[i32; 2]; 2], pixels: Vec<[f64; 2]>) -> Vec<[i32; 2]> {
        let mut pixels: Vec<_> = pixels.into_iter().map(|p| p.map(|v| v as i32)).collect();
        for p in &mut pixels {
            let key =
                ends.as_flattened().iter().chain(p.iter()).fold(3, |h, &v| hash(h ^ v as u64));
            p[0] += i32::from(key % 1000 < self.noise);
        }
        pixels
    }
}

/// The pixels of a line by its major axis, from one end to the other: one for each of these steps from the lower end.
fn stepped(
    [a, b]: [[f64; 2]; 2],
    u: usize,
    steps: std::ops::RangeInclusive<i32>,
    height: impl Fn(f64) -> f64,
) -> Vec<[f64; 2]> {
    let pixel = |step: i32| {
        let along = a[u].min(b[u]) + f64::from(step);
        let height = height(f64::from(step)).floor();
        if u == 0 { [along, height] } else { [height, along] }
    };
    let mut pixels: Vec<_> = steps.map(pixel).collect();
    if a[u] > b[u] {
        pixels.reverse();
    }
    pixels
}

/// Each column (or row) past the first takes the height of the one before.
fn behind(a: [f64; 2], b: [f64; 2]) -> Vec<[f64; 2]> {
    let u = usize::from((b[1] - a[1]).abs() >= (b[0] - a[0]).abs());
    let (low, high) = if a[u] <= b[u] { (a, b) } else { (b, a) };
    let slope = ((high[1 - u] - low[1 - u]) / (high[u] - low[u]) * 65536.0).trunc() / 65536.0;
    let height = |step: f64| low[1 - u] + 0.5 + (step - 1.0) * slope;
    stepped([a, b], u, 1..=(high[u] - low[u]) as i32, height)
}

/// Each height is cut down, after half a step more where it grows.
fn ahead(a: [f64; 2], b: [f64; 2]) -> Vec<[f64; 2]> {
    let u = usize::from((b[1] - a[1]).abs() > (b[0] - a[0]).abs());
    let (low, high) = if a[u] <= b[u] { (a, b) } else { (b, a) };
    let length = (high[u] - low[u]).max(1.0);
    let slope = ((high[1 - u] - low[1 - u]) / length * 65536.0).trunc() / 65536.0;
    let more = if slope > 0.0 { (slope * 32768.0).ceil() / 65536.0 } else { 0.0 };
    let height = |step: f64| low[1 - u] + more + step * slope;
    stepped([a, b], u, 0..=(high[u] - low[u]) as i32, height)
}

/// A step behind, or half a step ahead, is named, and not with noise.
#[test]
fn conventions_of_lines_behind_are_named() {
    let both = [LineConvention::BEHIND, LineConvention::AHEAD];
    for (convention, noise) in both.into_iter().flat_map(|c| [(c, 0), (c, 20), (c, 200)]) {
        let found = diagnosed(convention, noise, 32);
        let is_named = found.convention == convention && found.confidence == Confidence::Certain;
        assert_eq!(is_named, noise == 0, "{noise}: {}", found.sentence());
        super::assert_chinese(&found.sentence());
    }
}

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn conventions_of_lines_made_up_are_named() {
    let all: Vec<_> = LineRounding::all()
        .flat_map(|rounding| Ends::ALL.map(|ends| (rounding, ends)))
        .flat_map(|(rounding, ends)| Steps::all().map(move |steps| (rounding, ends, steps)))
        .map(|(rounding, ends, steps)| LineConvention { rounding, ends, steps })
        .collect();
    // A prime stride reaches every rounding, ending and step.
    let named = |number: usize| {
        let convention = all[number * 59 % all.len()];
        let found = diagnosed(convention, 0, 32);
        let sentence = found.sentence();
        super::assert_chinese(&sentence);
        let is_named = found.convention == convention;
        (found.confidence, is_named, format!("{convention:?}: {sentence}"))
    };
    super::check_named(&(0..160).into_par_iter().map(named).collect::<Vec<_>>());
}

#[test]
fn conventions_of_noisy_lines_are_unexplained() {
    for noise in [30, 100, 500] {
        let convention = LineConvention::default();
        let found = diagnosed(convention, noise, 40);
        assert_eq!(found.confidence, Confidence::Unexplained, "{noise}: {}", found.sentence());
        assert!(found.sentence().starts_with("Unexplained"));
        let question = LineQuestion {
            ends: [[1, 1], [5, 3]],
            window: rasterproof_core::grid::PixelRect::window(8, 8),
        };
        assert_eq!(found.expected(&question), None);
    }
}
