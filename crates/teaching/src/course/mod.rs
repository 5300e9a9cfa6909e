//! The course: twelve steps from a pixel to four samples, each judged by cases of the families.
//!
//! [`STEPS`] has the cases of each step, the page that explains it, and three hints. [`examine`] sends the cases to a
//! program, [`sandbox`] limits how that program runs, and [`verdict`] says how it did. [`progress`] is the file beside the
//! student's code.

pub mod examine;
pub mod progress;
pub mod sandbox;
pub mod verdict;

use glam::DVec2;

use rasterproof_judge::adapt_case;
use rasterproof_judge::check::Check;
use rasterproof_verify::cases::{Case, Shape};

#[derive(Debug)]
pub struct Step {
    /// Its name on the command line.
    pub name: &'static str,
    pub title: &'static str,
    /// The page that tells why, in the repository.
    pub page: &'static str,
    pub judged: &'static str,
    pub exercises: &'static [Exercise],
    /// From a nudge to nearly the answer.
    pub hints: [&'static str; 3],
}

impl PartialEq for Step {
    /// A step is its name.
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

#[derive(Debug)]
pub struct Exercise {
    pub check: Check,
    pub families: &'static [&'static str],
    /// The convention it is judged by, in the protocol's words; what is not said is top-left at the
    /// centre of the pixel.
    pub convention: &'static str,
    /// Makes a case of the family one of the step; nothing where it has no use. What it has made,
    /// it leaves as it is.
    pub prepare: fn(Case) -> Option<Case>,
}

/// A case as it is, inside its window.
fn inside(case: Case) -> Option<Case> {
    (!adapt_case::leaves_window(&case)).then_some(case)
}

fn anywhere(case: Case) -> Option<Case> {
    Some(case)
}

/// Lines from their first pixel to itself.
fn point(mut case: Case) -> Option<Case> {
    if let Shape::Lines(lines) = &mut case.shape {
        lines.iter_mut().for_each(|line| line.ends[1] = line.ends[0]);
    }
    Some(case)
}

/// Lines inside the window that never pass halfway between two pixels.
fn no_ties(case: Case) -> Option<Case> {
    let Shape::Lines(lines) = &case.shape else { return None };
    let has_tie = lines.iter().any(|line| {
        let [a, b] = line.ends.map(|end| end.pixel);
        let (dx, dy) = (u64::from(a.x.abs_diff(b.x)), u64::from(a.y.abs_diff(b.y)));
        let (mut common, mut rest) = (dx.max(dy), dx.min(dy));
        while rest > 0 {
            (common, rest) = (rest, common % rest);
        }
        // Halfway are steps of half a period, which are whole where the period is even.
        common > 0 && (dx.max(dy) / common).is_multiple_of(2)
    });
    if has_tie { None } else { inside(case) }
}

/// Depth left out: nothing but the two attributes is at stake.
fn attributes_alone(mut case: Case) -> Option<Case> {
    if let Shape::Triangles { list, .. } = &mut case.shape {
        list.iter_mut().flat_map(|t| &mut t.vertices).for_each(|v| v.depth = 0.0);
    }
    inside(case)
}

/// Attributes left out: nothing but depth is at stake.
fn depth_alone(mut case: Case) -> Option<Case> {
    if let Shape::Triangles { list, .. } = &mut case.shape {
        list.iter_mut().flat_map(|t| &mut t.vertices).for_each(|v| v.varying = DVec2::ZERO);
    }
    inside(case)
}

/// Triangles that reach out of their window.
fn outside(case: Case) -> Option<Case> {
    adapt_case::leaves_window(&case).then_some(case)
}

/// The step of a name, or of a number from 1.
#[must_use]
pub fn find(word: &str) -> Option<&'static Step> {
    let number = word.parse::<usize>().ok();
    let is_it = |(at, step): &(usize, &Step)| step.name == word || number == Some(at + 1);
    STEPS.iter().enumerate().find(is_it).map(|(_, step)| step)
}

#[must_use]
pub fn number(step: &Step) -> usize {
    STEPS.iter().position(|other| other.name == step.name).map_or(0, |at| at + 1)
}

const LINE_FAMILIES: &[&str] =
    &["line-points", "line-axis", "line-octants", "line-ties", "line-clipped", "line-far"];

/// The twelve steps, in order.
pub static STEPS: [Step; 12] = [
    Step {
        name: "pixel",
        title: "a pixel",
        page: "docs/ch01.md",
        judged: "L from a pixel to itself: that pixel, and nothing where it lies outside the window",
        exercises: &[Exercise {
            check: Check::Line,
            families: &["line-points", "line-clipped"],
            convention: "",
            prepare: point,
        }],
        hints: [
            "A line from a pixel to itself is one pixel. What does your program print for it?",
            "x counts columns to the right, y rows down; answers name x first. Both ends are drawn.",
            "If both ends are the same pixel: set_pixel(x0, y0) once if 0 <= x0 < width and \
             0 <= y0 < height.",
        ],
    },
    Step {
        name: "dda",
        title: "DDA",
        page: "docs/ch02.md",
        judged: "L inside the window where no pixel is a tie: the nearest pixel of each step, in order",
        exercises: &[Exercise {
            check: Check::Line,
            families: &["line-points", "line-axis", "line-octants"],
            convention: "",
            prepare: no_ties,
        }],
        hints: [
            "Walk along the longer of dx and dy: a step along the shorter one leaves gaps.",
            "There are max(|dx|, |dy|) steps and one pixel more, both ends included, in drawing order.",
            "For i in 0..=n, n = max(|dx|, |dy|): set_pixel(floor(x0 + dx i / n + 1/2), \
             floor(y0 + dy i / n + 1/2)); n = 0 is step 1.",
        ],
    },
    Step {
        name: "bresenham",
        title: "Bresenham",
        page: "docs/ch02.md",
        judged: "L everywhere: ties, borders, ends 2^31 px away; and a line drawn backwards is the same",
        exercises: &[
            Exercise {
                check: Check::Line,
                families: LINE_FAMILIES,
                convention: "",
                prepare: anywhere,
            },
            Exercise {
                check: Check::Direction,
                families: &["line-ties", "line-octants", "line-clipped"],
                convention: "",
                prepare: anywhere,
            },
        ],
        hints: [
            "Whole numbers only: a rounded height drifts, and a tie must not depend on the direction.",
            "Seen from the end with the smaller major coordinate, a tie goes to the pixel farther along \
             in the minor direction. Lines reach 2^31 px: start where the window starts.",
            "From the smaller end (a mirrored line has dv < 0: mirror v first) pixel u has \
             v = floor((2 u dv + du) / (2 du)); drawn backwards it is the same pixels the other way \
             round. Use 128 bits, and only the u inside the window.",
        ],
    },
    Step {
        name: "scanline",
        title: "scanline",
        page: "docs/ch02.md",
        judged: "T inside the window, row by row; samples exactly on an edge are free",
        exercises: &[Exercise {
            check: Check::Coverage,
            families: &["uniform", "flat", "near-horizontal", "strip", "tiny"],
            convention: "rule=none",
            prepare: inside,
        }],
        hints: [
            "A pixel is drawn if its centre (x + 0.5, y + 0.5) is inside, not if the triangle touches it.",
            "Row y is cut at y + 0.5: sort the corners by y; the long edge is one end of the row, one of \
             the two short edges the other.",
            "For each y with y0 < y + 0.5 < y2, x = xa + (y + 0.5 - ya)(xb - xa)/(yb - ya) on both edges; \
             draw the pixels with left < x + 0.5 < right, computed from the edge in each row, not added up.",
        ],
    },
    Step {
        name: "edge-function",
        title: "edge function",
        page: "docs/ch02.md",
        judged: "T of both windings, slivers and ties; samples on an edge are free, but no order of the \
                 vertices may change the picture",
        exercises: &[
            Exercise {
                check: Check::Coverage,
                families: &["uniform", "sliver", "near-vertical", "near-tie", "half-integer"],
                convention: "rule=none",
                prepare: inside,
            },
            Exercise {
                check: Check::Order,
                families: &["uniform", "half-integer", "sliver"],
                convention: "rule=none",
                prepare: inside,
            },
        ],
        hints: [
            "Three signs decide: on which side of each edge is the centre? The two windings have opposite \
             signs.",
            "edge(a, b, p) = (bx - ax)(py - ay) - (by - ay)(px - ax), at p = (x + 0.5, y + 0.5). \
             Corners are multiples of 1/256 px: times 256 (centres 256 x + 128) everything is whole.",
            "If edge(a, b, c) < 0, exchange b and c. Then draw where edge(a, b, p), edge(b, c, p) and \
             edge(c, a, p) are all > 0, with no division and no epsilon anywhere.",
        ],
    },
    Step {
        name: "top-left",
        title: "top-left rule",
        page: "docs/ch02.md",
        judged: "T where samples lie on edges and corners: drawn on top and left edges alone; nothing of \
                 a triangle without area",
        exercises: &[Exercise {
            check: Check::Coverage,
            families: &["half-integer", "rectangle", "flat", "near-tie", "degenerate"],
            convention: "rule=top-left",
            prepare: inside,
        }],
        hints: [
            "A sample on the edge of two neighbours must be drawn by one of them: by whose edge is it on top \
             or on the left?",
            "With y down and the corners clockwise (edge(a, b, c) > 0), an edge from a to b is a top edge if \
             it is level and runs to the right, and a left edge if it runs up.",
            "An edge with e = 0 counts as inside if by < ay, or by = ay and bx > ax; so test e > 0, or e = 0 \
             and that. Area 0 draws nothing.",
        ],
    },
    Step {
        name: "fans",
        title: "fans",
        page: "docs/ch02.md",
        judged: "T of each triangle of a mesh: together no holes, and no pixel drawn by two",
        exercises: &[Exercise {
            check: Check::Watertight,
            families: &["fan", "strip", "rectangle"],
            convention: "",
            prepare: inside,
        }],
        hints: [
            "Both neighbours must come to the same decision about the edge they share.",
            "The shared edge runs the other way in the neighbour: edge(a, b, p) = -edge(b, a, p) must hold \
             exactly, which rounded products do not promise.",
            "Compute the edge function in whole subpixels in 64 bits (128 for far corners), and decide ties \
             by the direction of the edge alone, as in step 6.",
        ],
    },
    Step {
        name: "values",
        title: "values",
        page: "docs/ch03.md",
        judged: "I with equal w: z, a and b at the centre of each pixel, within 1e-4 of the largest",
        exercises: &[Exercise {
            check: Check::Values,
            families: &["w-equal"],
            convention: "",
            prepare: inside,
        }],
        hints: [
            "Each covered pixel gets the value at its centre, not at its corner, and not at the row's end.",
            "The weight of a corner is the edge function of the opposite edge at the centre, divided by the \
             area; the three add up to 1.",
            "l0 = edge(b, c, p) / edge(a, b, c), l1 = edge(c, a, p) / edge(a, b, c), l2 = 1 - l0 - l1; \
             a = l0 a0 + l1 a1 + l2 a2, the same for z and b.",
        ],
    },
    Step {
        name: "perspective",
        title: "perspective",
        page: "docs/ch05.md",
        judged: "I with w ratios up to 100: a and b in perspective, within 1e-4 of the largest; z is 0",
        exercises: &[Exercise {
            check: Check::Values,
            families: &["w-4", "w-100"],
            convention: "",
            prepare: attributes_alone,
        }],
        hints: [
            "The middle of an edge in the window is not its middle in space: the nearer half looks larger.",
            "a / w and 1 / w are linear in the window; a is not.",
            "With the weights l of step 8: q = l0/w0 + l1/w1 + l2/w2, and \
             a = (l0 a0/w0 + l1 a1/w1 + l2 a2/w2) / q.",
        ],
    },
    Step {
        name: "depth",
        title: "depth order",
        page: "docs/ch06.md",
        judged: "D: of several triangles the nearest at each pixel, whatever order they come in; and I: z is \
                 linear in the window, whatever w is (a and b are 0)",
        exercises: &[
            Exercise {
                check: Check::Depth,
                families: &["depth-order"],
                convention: "",
                prepare: inside,
            },
            Exercise {
                check: Check::Values,
                families: &["w-4", "w-100"],
                convention: "",
                prepare: depth_alone,
            },
        ],
        hints: [
            "Which of two triangles is in front is decided at each pixel, not for a triangle as a whole: they \
             may go through each other.",
            "Keep the least z of each pixel and who drew it; begin with infinity. z has been divided already: \
             it is linear in the window.",
            "z = l0 z0 + l1 z1 + l2 z2 with the plain weights l of step 8, whatever w is. For each pixel of \
             triangle t: if z < nearest[y][x], then nearest[y][x] = z and seen[y][x] = t.",
        ],
    },
    Step {
        name: "clipping",
        title: "clipping at a plane",
        page: "docs/ch07.md",
        judged: "N: the polygon that the near plane z = -w leaves of a triangle of clip space; and T and I of \
                 triangles that reach out of the window, some to 2^23 px",
        exercises: &[
            Exercise {
                check: Check::Near,
                families: &["near-plane"],
                convention: "",
                prepare: anywhere,
            },
            Exercise {
                check: Check::Coverage,
                families: &["partly-off", "off-screen", "huge"],
                convention: "",
                prepare: outside,
            },
            Exercise {
                check: Check::Values,
                families: &["partly-off"],
                convention: "",
                prepare: outside,
            },
        ],
        hints: [
            "Go round the triangle edge by edge: keep the corners with z + w >= 0, and where an edge changes \
             sides, put a new corner. For the window: pixels inside are the same as without a window.",
            "With d = z + w of both ends, the new corner is a + (b - a) da / (da - db), w like x, y and z. Do \
             not move corners to the window's border: a cut corner is rounded, and the edge turns.",
            "For i in 0..3, a = corner i, b = corner i + 1 mod 3: if da >= 0, add a; if (da >= 0) != (db >= 0), \
             add the new corner. T: visit the part of the box inside the window; edge functions of far \
             corners reach 2^65 in subpixels: take 128 bits. Values use the corners that were given.",
        ],
    },
    Step {
        name: "samples",
        title: "four samples",
        page: "docs/games101.md",
        judged: "S: for each pixel which of four samples are covered, by the top-left rule",
        exercises: &[Exercise {
            check: Check::Samples,
            families: &["uniform", "half-integer", "strip", "sliver", "partly-off"],
            convention: "",
            prepare: anywhere,
        }],
        hints: [
            "The test of steps 5 and 6 four times a pixel: the sample's place instead of the centre.",
            "The samples lie at (6, 2), (14, 6), (2, 10), (10, 14) of 1/16 px; bit s of the mask is sample s. \
             A pixel with mask 0 is not in the answer.",
            "In subpixels of 1/256 px sample s is at 256 x + (96, 224, 32, 160)[s], \
             256 y + (32, 96, 160, 224)[s]; the box of pixels must reach as far as samples do: use floor of \
             the least and ceil of the largest corner.",
        ],
    },
];

#[cfg(test)]
mod tests {
    use super::*;

    /// Every step has cases, and what prepares them has nothing left to do the second time: what is
    /// shrunk stays a case of the step.
    #[test]
    fn every_exercise_has_cases() {
        for exercise in STEPS.iter().flat_map(|step| step.exercises) {
            for name in exercise.families {
                let families = adapt_case::families(&[(*name).to_owned()]);
                assert_eq!(families.len(), 1, "{name}");
                let cases =
                    (0..60).filter_map(|index| (exercise.prepare)(families[0].case(1, index)));
                let cases: Vec<_> = cases.collect();
                assert!(cases.len() >= 10, "{name}: {}", cases.len());
                for case in cases {
                    assert_eq!((exercise.prepare)(case.clone()).as_ref(), Some(&case), "{name}");
                }
            }
        }
    }

    #[test]
    fn steps_are_found() {
        assert_eq!(find("1").map(|s| s.name), Some("pixel"));
        assert_eq!(find("samples").map(number), Some(12));
        assert!(find("0").is_none() && find("13").is_none() && find("").is_none());
    }
}
