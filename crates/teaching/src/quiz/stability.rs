//! Stability: which check notices which fault.

use super::tools::{Px, corners};
use super::{Answer, Chapter, Exercise, Solution};
use rasterproof_core::contract::Rasterize as _;
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_core::triangle::Corners;
use rasterproof_faults::planted::{Mutant, TriangleMutant};
use rasterproof_invariants::find;
use rasterproof_invariants::subject::Subject;
use rasterproof_verify::comparison::Tally;
use rasterproof_verify::oracle::Oracle;

pub const CHAPTER: Chapter = Chapter {
    page: "stability",
    title: ["invariants and planted faults", "不变量与埋下的错误"],
    exercises: &[NOTICES, ORDERS, MOVED, METRIC],
};

/// Names of invariants, as the choices of [`NOTICES`].
const ASKED: [&str; 3] = ["constant-attribute", "contiguous-rows", "closed-fan"];

const NOTICES: Exercise = Exercise {
    question: [
        "A rasterizer takes every sample with all edge functions >= 0, so both sides own a shared edge. Which of these \
         statements is untrue of it?",
        "有个光栅化器取所有边函数 >= 0 的采样点，于是公共边归两边所有。下面哪条性质对它不成立？",
    ],
    choices: &[
        ["a constant attribute comes out bit for bit", "常数属性逐位原样得出"],
        [
            "what a triangle covers of a row is one run of pixels",
            "三角形在一行里覆盖的是连续的一段像素",
        ],
        ["a closed fan hits each pixel inside exactly once", "封闭扇形恰好命中里面的每个像素一次"],
    ],
    solve: |_| {
        let subject = Subject::with(Mutant::Triangle(TriangleMutant::InclusiveEdges));
        let kills = |name| find(name).expect("an invariant's name").kills(&subject, 1, 42);
        Solution::new(Answer::only(&ASKED.map(kills)))
    },
    why: [
        "One triangle alone looks well: its rows are runs, its values are right. Only neighbours show that an edge has two \
         owners; so the checks draw meshes.",
        "单看一个三角形毫无破绽：每行是一段，值也对。只有相邻的三角形才显出一条边有两个主人；所以检验要画网格。",
    ],
};

const TRIANGLE: Px = [[1.2, 1.1], [6.3, 2.4], [2.7, 6.6]];

fn covered(mutant: TriangleMutant, corners: Corners, window: PixelRect) -> Coverage {
    let mut hits = Coverage::new(window, 0);
    mutant.cover(corners, window, |span| hits.hit(span.y_px, span.x0_px, span.x1_px));
    hits
}

const ORDERS: Exercise = Exercise {
    question: [
        "A rasterizer draws a triangle only if its corners run clockwise. In how many of the six orders of its corners \
         does it draw?",
        "有个光栅化器只画顶点按顺时针排列的三角形。三个顶点有六种排列，它在其中几种下会画？",
    ],
    choices: &[],
    solve: |_| {
        let [a, b, c] = corners(TRIANGLE);
        let orders = [[a, b, c], [b, c, a], [c, a, b], [a, c, b], [c, b, a], [b, a, c]];
        let window = PixelRect::window(8, 8);
        let draws = |&order: &Corners| {
            covered(TriangleMutant::CullsOneWinding, order, window).covered() > 0
        };
        Solution::new(Answer::count(orders.iter().filter(|order| draws(order)).count() as u64))
    },
    why: [
        "Turning the corners round keeps the winding, exchanging two reverses it: three of each. The invariant \
         `vertex-order` asks all six.",
        "轮换顶点不改变绕向，交换两个则反转：各三种。不变量 `vertex-order` 六种都问。",
    ],
};

/// Whether a rasterizer that cuts towards zero is wrong about the triangle moved by whole pixels.
fn is_wrong_moved(x_px: i32) -> bool {
    let moved = TRIANGLE.map(|[x, y]| [x + f64::from(x_px), y]);
    let corners: [SubpixelPoint; 3] = corners(moved);
    let window = PixelRect { x0: x_px, y0: 0, x1: x_px + 8, y1: 8 };
    let mut right = Coverage::new(window, 0);
    Oracle.cover(corners, window, |span| right.hit(span.y_px, span.x0_px, span.x1_px));
    let actual = covered(TriangleMutant::TruncatesTowardsZero, corners, window);
    Tally::between(&actual, &right).total() > 0
}

const MOVED: Exercise = Exercise {
    question: [
        "A rasterizer casts to int, which cuts towards zero, and is right about a triangle near the origin. Where is it wrong \
         about the same triangle?",
        "有个光栅化器强制转换成 int，即向零截断；原点右下方的一个三角形它画得对。把同一个三角形移到哪里，它就画错？",
    ],
    choices: &[
        ["20 pixels to the right", "向右 20 像素"],
        ["20 pixels to the left", "向左 20 像素"],
        ["4,000 pixels to the right", "向右 4000 像素"],
    ],
    solve: |_| {
        assert!(!is_wrong_moved(0), "the question says so");
        Solution::new(Answer::only(&[20, -20, 4000].map(is_wrong_moved)))
    },
    why: [
        "Left of the origin towards zero is up instead of down. The invariant `translation` moves triangles across zero \
         and far away, by whole pixels, and wants the same pixels.",
        "在原点左边，向零就是向上取整，而不是向下。不变量 `translation` 把三角形移过零点、移到远处，\
         每次移整数个像素，要求像素不变。",
    ],
};

/// Pixels along a side of the frame.
const SIDE: u32 = 256;

const METRIC: Exercise = Exercise {
    question: [
        "One of 256 x 256 pixels is white where it should be black. What is the peak signal-to-noise ratio, in whole \
         decibels?",
        "256 x 256 个像素里有一个本该是黑的却是白的。峰值信噪比是多少分贝（取整数）？",
    ],
    choices: &[],
    solve: |_| {
        let window = PixelRect::window(SIDE, SIDE);
        let target = Coverage::new(window, 0);
        let mut actual = target.clone();
        actual.hit(100, 100, 101);
        let wrong = Tally::between(&actual, &target).total();
        let mean_square_error = wrong as f64 / f64::from(SIDE * SIDE);
        let value = (-10.0 * mean_square_error.log10()).round();
        Solution::new(Answer::Number { value, decimals: 0 }).figure(wrong)
    },
    why: [
        "10 log10 (256 times 256), since the mean square error is 1/65536 of the square of white. Pictures of 40 dB pass \
         for good copies; here {} wrong pixel is a disagreement, and no metric has a say.",
        "10 log10 (256 乘 256)，因为均方误差是白色平方的 1/65536。40 dB 的图像就算很好的复制品了；\
         在这里，{} 个错误像素就是不一致，任何图像指标都不参与判定。",
    ],
};
