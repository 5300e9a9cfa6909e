//! Chapter 9: stages, culling, frames.

use glam::DVec3;

use super::tools::{Px, corners, draw};
use super::{Answer, Chapter, Exercise, Solution};
use rasterproof_core::grid::SUBPIXELS;
use rasterproof_render::pipeline::assemble::{Cull, twice_area};
use rasterproof_render::pipeline::target::Antialias;

pub const CHAPTER: Chapter = Chapter {
    page: "ch09",
    title: ["stages, culling, frames", "阶段、剔除、帧"],
    exercises: &[WINDING, AREA, THIN, SHARED],
};

/// The way the corners run: clockwise, counter-clockwise, neither.
fn winding(triangle: Px) -> [bool; 3] {
    let [clockwise, counter] =
        [Cull::Clockwise, Cull::CounterClockwise].map(|cull| cull.removes(corners(triangle)));
    [clockwise, counter, !clockwise && !counter]
}

const WAYS: &[super::Text] = &[
    ["clockwise", "顺时针"],
    ["counter-clockwise", "逆时针"],
    ["neither: it has no area", "都不是：它没有面积"],
];

const RIGHT_ANGLE: Px = [[1.0, 1.0], [6.0, 1.0], [1.0, 6.0]];

const WINDING: Exercise = Exercise {
    question: [
        "In a window whose y points down, which way do the corners (1, 1), (6, 1), (1, 6) run, as one looks at it?",
        "窗口的 y 轴向下。看上去，顶点 (1, 1)、(6, 1)、(1, 6) 按哪个方向转？",
    ],
    choices: WAYS,
    solve: |_| Solution::new(Answer::only(&winding(RIGHT_ANGLE))),
    why: [
        "From the upper left to the right, then to the lower left: with the hands of a clock. In a window whose y \
         points up the same numbers run the other way.",
        "从左上到右，再到左下：与钟表的指针同向。若窗口的 y 轴向上，同样的数就反着转。",
    ],
};

const AREA: Exercise = Exercise {
    question: [
        "What is 2A, in square pixels, for the corners (1, 1), (6, 1), (1, 6)? Mind the sign.",
        "顶点 (1, 1)、(6, 1)、(1, 6) 的 2A 是多少平方像素？注意正负号。",
    ],
    choices: &[],
    solve: |_| {
        let square = f64::from(SUBPIXELS).powi(2);
        let value = twice_area(corners(RIGHT_ANGLE)) as f64 / square;
        Solution::new(Answer::Number { value, decimals: 0 })
    },
    why: [
        "(b_x - a_x)(c_y - a_y) - (b_y - a_y)(c_x - a_x) = 5 times 5 - 0 times 0; clockwise is positive, as y points \
         down.",
        "(b_x - a_x)(c_y - a_y) - (b_y - a_y)(c_x - a_x) = 5 乘 5 减 0 乘 0；y 轴向下，所以顺时针为正。",
    ],
};

const SLIVER: Px = [[1.0, 1.0], [1.0, 5.0], [1.001, 1.0]];

const THIN: Exercise = Exercise {
    question: [
        "The corners (1, 1), (1, 5), (1.001, 1) are snapped to 1/256 px. Which way does culling say they run?",
        "顶点 (1, 1)、(1, 5)、(1.001, 1) 吸附到 1/256 像素。剔除时认为它们按哪个方向转？",
    ],
    choices: WAYS,
    solve: |_| Solution::new(Answer::only(&winding(SLIVER))).figure(corners(SLIVER)[2].x),
    why: [
        "1.001 px snaps to {} subpixels, the column of the other two: what is drawn has no area, so nothing is drawn and \
         nothing need be culled. In floats it runs counter-clockwise.",
        "1.001 像素吸附到 {} 个子像素处，与另外两个同列：吸附之后没有面积，什么也不画，也就谈不上剔除。\
         用浮点数算，它是逆时针的。",
    ],
};

const SHARED: Exercise = Exercise {
    question: [
        "A cube has 8 corners, and 12 triangles that name them by index. How often does the vertex stage run for one \
         picture of it?",
        "立方体有 8 个顶点，12 个三角形按下标引用它们。画一次，顶点着色器运行几次？",
    ],
    choices: &[],
    solve: |_| {
        let cube: Vec<_> =
            (0..8).map(|i| DVec3::from([i & 1, i >> 1 & 1, i >> 2].map(f64::from)) / 2.0).collect();
        let faces =
            [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
        let triangles: Vec<[u32; 3]> =
            faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        let (counters, _) = draw(&cube, &triangles, 4, Antialias::None);
        Solution::new(Answer::count(counters.vertices)).figure(counters.triangles * 3)
    },
    why: [
        "Once for each vertex of the slice, however many triangles name it; three for each triangle would be {}.",
        "切片里的每个顶点一次，不论有多少三角形引用它；若每个三角形三次，就是 {} 次。",
    ],
};
