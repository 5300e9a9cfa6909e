//! Chapter 7: clipping.

use glam::DVec4;

use super::{Answer, Chapter, Exercise, Solution};
use rasterproof_render::pipeline::ClipVertex;
use rasterproof_render::pipeline::clip::{ClipPlane, MOST_VERTICES, Outcode, clip, outcode};

pub const CHAPTER: Chapter = Chapter {
    page: "ch07",
    title: ["clipping", "裁剪"],
    exercises: &[SHARE, CORNERS, REJECTED, MOST],
};

fn vertex(x: f64, y: f64, z: f64, w: f64, varying: f64) -> ClipVertex<f64> {
    ClipVertex { position: DVec4::new(x, y, z, w), varying }
}

/// Two corners at z = 2, and one behind the near plane, at z = -2; w is 1, so g = w + z is 3 and -1.
fn behind() -> [ClipVertex<f64>; 3] {
    [
        vertex(0.0, 0.5, 2.0, 1.0, 0.0),
        vertex(0.5, 0.0, 2.0, 1.0, 0.0),
        vertex(0.0, 0.0, -2.0, 1.0, 1.0),
    ]
}

const SHARE: Exercise = Exercise {
    question: [
        "An edge has the distances g = 3 at its inner end and g = -1 at its outer end. At which share t of the way out \
         does it cross the border?",
        "一条边，内端的距离 g = 3，外端 g = -1。向外走到几分之几处（t）穿过边界？",
    ],
    choices: &[],
    solve: |_| {
        let (polygon, _) = clip(&behind(), ClipPlane::Near.bit());
        // The attribute runs from 0 to 1 along the edge, so that it is t at the crossing.
        let t = polygon.vertices().map(|v| v.varying).fold(0.0, f64::max);
        Solution::new(Answer::Number { value: t, decimals: 2 })
    },
    why: [
        "t = g_a / (g_a - g_b), from the inner end: 3 / (3 + 1), for the position and every attribute.",
        "从内端算起，t = g_a / (g_a - g_b)：3 / (3 + 1)，对位置和每个属性都一样。",
    ],
};

const CORNERS: Exercise = Exercise {
    question: [
        "One corner of a triangle lies behind the near plane, two before it. How many corners has what is left?",
        "三角形的一个顶点在近平面之后，两个在之前。剩下的部分有几个顶点？",
    ],
    choices: &[],
    solve: |_| {
        let (polygon, _) = clip(&behind(), ClipPlane::Near.bit());
        Solution::new(Answer::count(polygon.vertices().len() as u64))
    },
    why: [
        "Two inner corners, an exit point and an entry point: a quad, drawn as a fan of two triangles.",
        "两个在内的顶点，加一个出点和一个入点：四边形，当作两个三角形的扇形来画。",
    ],
};

/// Corners as (x, y); z is 0 and w is 1, so the borders are at -1 and 1.
const CASES: [[[f64; 2]; 3]; 3] = [
    [[-0.5, 0.0], [0.5, 0.0], [0.0, 0.5]],
    [[2.0, 0.0], [3.0, 1.0], [2.0, -3.0]],
    [[-3.0, 0.0], [0.0, 3.0], [3.0, 0.0]],
];

const REJECTED: Exercise = Exercise {
    question: [
        "With w = 1 and z = 0, which of these triangles (x, y) is rejected by its outcodes alone?",
        "设 w = 1、z = 0，下面哪个三角形 (x, y) 单凭区域码就能拒绝？",
    ],
    choices: &[
        ["(-0.5, 0) (0.5, 0) (0, 0.5)"; 2],
        ["(2, 0) (3, 1) (2, -3)"; 2],
        ["(-3, 0) (0, 3) (3, 0)"; 2],
    ],
    solve: |_| {
        let codes = CASES.map(|case| case.map(|[x, y]| outcode(&vertex(x, y, 0.0, 1.0, 0.0))));
        let rejected =
            codes.map(|code| code.iter().fold(Outcode::MAX, |all, code| all & code) != 0);
        Solution::new(Answer::only(&rejected))
    },
    why: [
        "Its corners have a bit in common, that of x > w. The first triangle has no bit at all; the third has every \
         corner outside, but of different borders, and it passes through the cube.",
        "它的三个顶点有一位相同，即 x > w 那一位。第一个三角形一位也没有；第三个的顶点都在外面，\
         却是在不同的边界之外，它穿过立方体。",
    ],
};

const MOST: Exercise = Exercise {
    question: [
        "Seven borders may cut a triangle. How many corners must the array for the result hold?",
        "三角形可能被七个边界裁剪。存放结果的数组要容得下几个顶点？",
    ],
    choices: &[],
    solve: |_| Solution::new(Answer::count(MOST_VERTICES as u64)).figure(ClipPlane::ALL.len()),
    why: [
        "Every border drops at least one corner and adds two, so it adds one at most: 3 + {}. The book's array for \
         nine counts on convexity, which rounding breaks.",
        "每个边界至少去掉一个顶点、添上两个，所以至多多出一个：3 + {}。书中容得下九个的数组指望多边形是凸的，\
         而舍入会破坏这一点。",
    ],
};
