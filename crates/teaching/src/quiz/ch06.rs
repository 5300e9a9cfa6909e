//! Chapter 6: depth.

use glam::DVec3;

use super::{Answer, Chapter, Exercise, Solution};
use rasterproof_render::pipeline::depth::DepthFormat;
use rasterproof_render::pipeline::target::{Antialias, Target};
use rasterproof_render::pipeline::transform::frustum;

pub const CHAPTER: Chapter =
    Chapter { page: "ch06", title: ["depth", "深度"], exercises: &[EQUAL, HALF, APART, ORDER] };

/// Draws fragments (key, grey) one after another into one pixel; the grey that is left.
fn drawn(fragments: &[(u64, u8)]) -> u8 {
    let mut target = Target::new(1, 1, Antialias::None, DepthFormat::Unorm32).expect("one pixel");
    for &(key, grey) in fragments {
        target.planes[0].test_and_write(0, 0, key, || [grey, grey, grey, 255]);
    }
    target.pixel(0, 0)[0]
}

const EQUAL: Exercise = Exercise {
    question: [
        "Two fragments of the same depth reach a pixel, first a black one, then a white one. What does the pixel show?",
        "两个深度相同的片元来到同一个像素，先黑后白。像素显示什么？",
    ],
    choices: &[["black", "黑"], ["white", "白"], ["grey", "灰"]],
    solve: |_| {
        let shown = drawn(&[(7, 0), (7, 255)]);
        Solution::new(Answer::only(&[shown == 0, shown == 255, shown == 128]))
    },
    why: [
        "Only what is strictly nearer replaces what is there; equal depths keep what was first.",
        "只有严格更近的才换掉原有的；深度相等时，先来的留下。",
    ],
};

const ORDER: Exercise = Exercise {
    question: [
        "Fragments with depths 5, 3 and 8 reach a pixel, in any of the six orders. How many different pictures are \
         there?",
        "深度为 5、3、8 的三个片元来到同一个像素，先后次序有六种。会得到几种不同的画面？",
    ],
    choices: &[],
    solve: |_| {
        let all = [(5, 50), (3, 30), (8, 80)];
        let orders = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
        let mut shown = orders.map(|order| drawn(&order.map(|i: usize| all[i]))).to_vec();
        shown.sort_unstable();
        shown.dedup();
        Solution::new(Answer::count(shown.len() as u64))
    },
    why: [
        "With a depth buffer the nearest stays, in whatever order they come. The painter's algorithm would need the \
         right order.",
        "有了深度缓冲，不论次序如何，留下的总是最近的。画家算法则必须排对次序。",
    ],
};

/// The stored depth of a point at distance z, near plane 0.1, far plane 1000.
fn depth(z: f64) -> f64 {
    let projection = frustum(-1.0, 1.0, -1.0, 1.0, 0.1, 1000.0).expect("it is a frustum");
    let p = projection * DVec3::new(0.0, 0.0, z).extend(1.0);
    (p.z / p.w + 1.0) / 2.0
}

const HALF: Exercise = Exercise {
    question: [
        "The near plane is at 0.1, the far plane at 1000, depth runs from 0 to 1. Which depth has a point at distance \
         0.2?",
        "近平面在 0.1，远平面在 1000，深度从 0 到 1。距离 0.2 处的点，深度是多少？",
    ],
    choices: &[],
    solve: |_| {
        let solution = Solution::new(Answer::Number { value: depth(0.2), decimals: 1 });
        solution.figure(format!("{:.4}", depth(10.0)))
    },
    why: [
        "Half of the range lies between n and 2n; at distance 10 the depth is {} already.",
        "范围的一半都花在 n 与 2n 之间；到距离 10 时，深度已经是 {}。",
    ],
};

const APART: Exercise = Exercise {
    question: [
        "With the same planes, which of these formats tells distances 990 and 990.1 apart?",
        "平面同上，下面哪种格式分得清距离 990 和 990.1？",
    ],
    choices: &[["unorm24"; 2], ["f32"; 2], ["f32-reversed"; 2]],
    solve: |choices| {
        let format =
            |text: &super::Text| DepthFormat::ALL.into_iter().find(|f| f.name() == text[0]);
        let apart = |text| {
            let format = format(text).expect("the choices are formats");
            format.key(depth(990.0)) != format.key(depth(990.1))
        };
        Solution::new(Answer::only(&choices.iter().map(apart).collect::<Vec<_>>()))
    },
    why: [
        "At that distance a step of 2^-24 is about 0.59 wide. A float is fine near 0, and storing 1 - d puts its fine \
         steps where the projection's are coarse.",
        "在那个距离上，2^-24 的一级约有 0.59 宽。浮点数在 0 附近最细；存 1 - d，细的级就落在投影粗的地方。",
    ],
};
