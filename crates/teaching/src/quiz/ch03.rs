//! Chapter 3: interpolation.

use super::tools::{Px, corners};
use super::{Answer, Chapter, Exercise, Solution};
use rasterproof_core::grid::PixelRect;
use rasterproof_faults::published::sysu_weights::SysuWeights;
use rasterproof_faults::published::{Published as _, bare};
use rasterproof_verify::oracle::values::{ExactTriangle, along_line};

pub const CHAPTER: Chapter = Chapter {
    page: "ch03",
    title: ["interpolation", "插值"],
    exercises: &[ROD, WEIGHT, OUTSIDE, ORDER],
};

const ROD: Exercise = Exercise {
    question: [
        "A line of 8 steps has the value 2 at its first pixel and 10 at its last. What is the value after 3 steps?",
        "一条直线共 8 步，第一个像素的值是 2，最后一个是 10。走 3 步之后的值是多少？",
    ],
    choices: &[],
    solve: |_| {
        let value = along_line([2.0, 10.0], 3, 8).to_f64();
        Solution::new(Answer::Number { value, decimals: 0 })
    },
    why: [
        "The weights of the ends are 5/8 and 3/8, each the opposite part of the length: 2 times 5/8 and 10 times 3/8.",
        "两端的权重是 5/8 和 3/8，各是对面那段的长度：2 乘 5/8 加 10 乘 3/8。",
    ],
};

const RIGHT_ANGLE: Px = [[0.0, 0.0], [8.0, 0.0], [0.0, 8.0]];

/// The three weights at the centre of a pixel, exact, as the values of three unit attributes.
fn weights(x_px: i32, y_px: i32) -> [f64; 3] {
    let units = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let exact = ExactTriangle::new(&corners(RIGHT_ANGLE), [0.0; 3], [1.0; 3], units);
    exact.expect("it has an area").at(x_px, y_px).1.map(|weight| weight.to_f64())
}

const WEIGHT: Exercise = Exercise {
    question: [
        "In the triangle (0, 0) (8, 0) (0, 8), which weight (barycentric coordinate) has the corner (0, 0) at the \
         centre of pixel (1, 2)?",
        "在三角形 (0, 0) (8, 0) (0, 8) 里，像素 (1, 2) 的中心处，顶点 (0, 0) 的权重（重心坐标）是多少？",
    ],
    choices: &[],
    solve: |_| {
        let [a, b, c] = weights(1, 2);
        Solution::new(Answer::Number { value: a, decimals: 2 }).figure(b).figure(c)
    },
    why: [
        "The centre is (1.5, 2.5). The other two weights are {} and {}, the shares 1.5/8 and 2.5/8 of the way to \
         their corners, and the three add up to 1.",
        "中心是 (1.5, 2.5)。另外两个权重是 {} 和 {}，即走向各自顶点的 1.5/8 和 2.5/8；三者之和为 1。",
    ],
};

const OUTSIDE: Exercise = Exercise {
    question: [
        "At the centre of pixel (6, 6), beyond the slanted edge of the triangle (0, 0) (8, 0) (0, 8), how many of \
         the three weights are negative?",
        "像素 (6, 6) 的中心在三角形 (0, 0) (8, 0) (0, 8) 的斜边之外。三个权重里有几个是负的？",
    ],
    choices: &[],
    solve: |_| {
        let all = weights(6, 6);
        let negative = all.iter().filter(|&&weight| weight < 0.0).count();
        let solution = Solution::new(Answer::count(negative as u64));
        all.into_iter().fold(solution, |solution, weight| solution.figure(weight))
    },
    why: [
        "Areas have a sign, and only the one at the slanted edge, which weighs the corner (0, 0), has turned round: \
         {}, {} and {}, and still their sum is 1.",
        "面积有正负，只有斜边那一块翻了过来，它是顶点 (0, 0) 的权重：{}、{} 和 {}，加起来仍是 1。",
    ],
};

/// Whether weights in the wrong order change a value, and whether they change a pixel.
fn is_noticed(values: [f64; 3]) -> (bool, bool) {
    let mut triangle = bare([[1.5, 9.5], [9.5, 8.5], [4.5, 1.5]]);
    for (vertex, value) in triangle.iter_mut().zip(values) {
        vertex.varying.x = value;
    }
    let exact = ExactTriangle::new(
        &corners([[1.5, 9.5], [9.5, 8.5], [4.5, 1.5]]),
        [0.0; 3],
        [1.0; 3],
        values.map(|value| [value]),
    );
    let exact = exact.expect("it has an area");
    let (mut pixels, mut off) = ([0, 0], false);
    let window = PixelRect::window(11, 11);
    let emitted = SysuWeights.fragments(&triangle, window, &mut |f| {
        pixels[0] += 1;
        // The specimen counts in f32.
        off |= exact.at(f.x_px, f.y_px).1[0].distance(f.varying.x) > 1e-3;
    });
    let covered = SysuWeights.cover(&triangle, window, &mut |span| {
        pixels[1] += span.x1_px - span.x0_px;
    });
    assert_eq!((emitted, covered), (Ok(()), Ok(())));
    (off, pixels[0] != pixels[1])
}

const ORDER: Exercise = Exercise {
    question: [
        "A program gives the weights of corners 0, 1, 2 to the corners 1, 2, 0. Which test notices?",
        "有个程序把顶点 0、1、2 的权重给了顶点 1、2、0。哪种测试能发现？",
    ],
    choices: &[
        ["one that compares the covered pixels", "比较覆盖了哪些像素"],
        ["one with the same value at all corners", "三个顶点的值都相同"],
        ["one with three different values", "三个顶点的值各不相同"],
    ],
    solve: |_| {
        let (constant, _) = is_noticed([0.5; 3]);
        let (different, pixels) = is_noticed([0.0, 1.0, 3.0]);
        Solution::new(Answer::only(&[pixels, constant, different]))
    },
    why: [
        "Coverage does not depend on the weights, and a mean of equal values is that value in any order. Only \
         different values at the three corners show that one has wandered.",
        "覆盖与权重无关；相同的值不管怎么加权，平均都是它自己。只有三个顶点的值各不相同，才看得出值换了顶点。",
    ],
};
