//! Chapter 5: interpolation in perspective.

use super::tools::{fragment, fragments};
use super::{Answer, Chapter, Exercise, Solution};
use rasterproof_core::grid::PixelRect;

pub const CHAPTER: Chapter = Chapter {
    page: "ch05",
    title: ["interpolation in perspective", "透视插值"],
    exercises: &[MIDDLE, LINEAR, WORST, CONSTANT],
};

const WINDOW: PixelRect = PixelRect::window(8, 8);

/// A triangle with its upper edge through the centres of row 0, from (0.5, 0.5) to (6.5, 0.5).
fn triangle(w: [f64; 2], values: [f64; 2]) -> [[f64; 4]; 3] {
    [[0.5, 0.5, w[0], values[0]], [6.5, 0.5, w[1], values[1]], [0.5, 6.5, w[0], values[0]]]
}

const MIDDLE: Exercise = Exercise {
    question: [
        "An edge leads from w = 1 with the value 0 to w = 3 with the value 1. What is the value in the middle of the \
         edge in the window?",
        "一条边从 w = 1、值 0 通到 w = 3、值 1。在窗口里，这条边正中间的值是多少？",
    ],
    choices: &[],
    solve: |_| {
        let f = fragment(triangle([1.0, 3.0], [0.0, 1.0]), WINDOW, [3, 0]);
        Solution::new(Answer::Number { value: f.varying, decimals: 2 }).figure(f.depth)
    },
    why: [
        "t = w_a t' / (w_b + (w_a - w_b) t') = 0.5 / (3 - 1). The affine mean would be {}: the near half fills more \
         than half of the picture.",
        "t = w_a t' / (w_b + (w_a - w_b) t') = 0.5 / (3 - 1)。仿射的平均会是 {}：近的一半占了画面的一大半。",
    ],
};

/// Whether numbers at equal steps lie on a straight line.
fn is_straight(values: &[f64]) -> bool {
    values.windows(3).all(|v| (v[0] - 2.0 * v[1] + v[2]).abs() < 1e-12)
}

const LINEAR: Exercise = Exercise {
    question: [
        "A value v is linear in space. Which of these is linear in the window?",
        "值 v 在空间里是线性的。下面哪个在窗口里是线性的？",
    ],
    choices: &[["v"; 2], ["w"; 2], ["v / w"; 2], ["v w"; 2]],
    solve: |_| {
        let row = |values| {
            let all = fragments(triangle([1.0, 4.0], values), WINDOW);
            all.into_iter().filter(|f| f.y_px == 0).map(|f| f.varying).collect::<Vec<f64>>()
        };
        // The distance is a value like any other.
        let (v, w) = (row([2.0, 1.0]), row([1.0, 4.0]));
        let both = |f: fn(f64, f64) -> f64| v.iter().zip(&w).map(|(&v, &w)| f(v, w)).collect();
        let all: [Vec<f64>; 4] =
            [both(|v, _| v), both(|_, w| w), both(|v, w| v / w), both(|v, w| v * w)];
        Solution::new(Answer::only(&all.map(|values| is_straight(&values))))
    },
    why: [
        "v/w and 1/w are linear in the window; the value is their quotient, taken in every pixel.",
        "v/w 和 1/w 在窗口里是线性的；值是它们的商，逐像素相除。",
    ],
};

const WORST: Exercise = Exercise {
    question: [
        "The values at the ends of an edge are 0 and 1, and one end is 4 times as far away as the other. How wrong can \
         affine interpolation be?",
        "一条边两端的值是 0 和 1，一端的距离是另一端的 4 倍。仿射插值最多会错多少？",
    ],
    choices: &[],
    solve: |_| {
        let all = fragments(triangle([1.0, 4.0], [0.0, 1.0]), WINDOW);
        // Depth is interpolated without w; at the worst place, t' = 2/3, lies the centre of a pixel.
        let worst = all.iter().map(|f| (f.depth - f.varying).abs()).fold(0.0, f64::max);
        let at = all.iter().find(|f| (f.depth - f.varying).abs() == worst);
        let pixel = at.map_or(String::new(), |f| format!("({}, {})", f.x_px, f.y_px));
        Solution::new(Answer::Number { value: worst, decimals: 2 }).figure(pixel)
    },
    why: [
        "(sqrt R - 1) / (sqrt R + 1) with R = 4. From (0.5, 0.5) to (6.5, 0.5) pixel {} attains it: two thirds of \
         the way in the window, one third in space.",
        "(√R - 1) / (√R + 1)，R = 4。从 (0.5, 0.5) 到 (6.5, 0.5)，像素 {} 恰好达到：在窗口里走了三分之二，\
         在空间里走了三分之一。",
    ],
};

const CONSTANT: Exercise = Exercise {
    question: [
        "In which of these cases may the division be left out, without changing a value?",
        "在下面哪种情形里，可以省掉除法而不改变任何值？",
    ],
    choices: &[
        ["all corners have the same w", "各顶点的 w 相同"],
        ["all values are between 0 and 1", "所有的值都在 0 与 1 之间"],
        ["the triangle is small", "三角形很小"],
    ],
    solve: |_| {
        let changes = |triangle| fragments(triangle, WINDOW).iter().any(|f| f.varying != f.depth);
        let small = [[0.5, 0.5, 1.0, 0.0], [2.5, 0.5, 4.0, 1.0], [0.5, 2.5, 1.0, 0.0]];
        let cases = [triangle([3.0, 3.0], [0.0, 1.0]), triangle([1.0, 4.0], [0.0, 1.0]), small];
        Solution::new(Answer::only(&cases.map(|case| !changes(case))))
    },
    why: [
        "With equal w the shares in the window are those in space, bit for bit here. A small triangle may still reach \
         far into the distance.",
        "w 相同，窗口里的比例就是空间里的比例，在这里逐位相同。小三角形仍可能伸得很远。",
    ],
};
