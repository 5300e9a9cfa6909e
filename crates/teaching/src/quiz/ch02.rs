//! Chapter 2: lines and triangles.

use super::answer::pixel;
use super::tools::{Px, hits, published, truth};
use super::{Answer, Chapter, Exercise, Solution};
use rasterproof_core::contract::DrawLine as _;
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::line::bresenham::Bresenham;
use rasterproof_core::triangle::{LineEnd, PixelPoint, ScreenLine};
use rasterproof_faults::published::games101_strict::Games101Strict;
use rasterproof_faults::published::sysu_inclusive::SysuInclusive;
use rasterproof_report::ascii;

pub const CHAPTER: Chapter = Chapter {
    page: "ch02",
    title: ["lines and triangles", "直线与三角形"],
    exercises: &[LONGER, HALFWAY, TWICE, HOLES, OWNED],
};

/// The pixels of a line, for a grid too.
fn line(from: [i32; 2], to: [i32; 2], window: PixelRect) -> Coverage {
    let end = |[x, y]: [i32; 2]| LineEnd { pixel: PixelPoint::new(x, y), depth: 0.0, varying: 0.0 };
    let mut lit = Coverage::new(window, 0);
    let line = ScreenLine { ends: [end(from), end(to)] };
    Bresenham.draw(&line, window, |f| lit.hit(f.y_px, f.x_px, f.x_px + 1));
    lit
}

const LONGER: Exercise = Exercise {
    question: [
        "How many pixels light up on the line from pixel (0, 0) to pixel (3, 9), both ends included?",
        "从像素 (0, 0) 到像素 (3, 9) 的直线，连同两端一共点亮几个像素？",
    ],
    choices: &[],
    solve: |_| {
        let lit = line([0, 0], [3, 9], PixelRect::window(4, 10));
        Solution::new(Answer::count(lit.covered())).grid("0,0 3,9", ascii::grid(&lit, &lit))
    },
    why: [
        "The walk is along the longer axis, here down, with one pixel for each of its steps: max(|dx|, |dy|) + 1.",
        "沿较长的轴走，这里是向下，一步一个像素：max(|dx|, |dy|) + 1。",
    ],
};

const HALFWAY: Exercise = Exercise {
    question: [
        "The line from pixel (0, 0) to pixel (8, 3) has height 12/8 at column 4, halfway between two rows. Which \
         pixel of column 4 is lit? Answer with column and row, such as 2,1.",
        "从像素 (0, 0) 到像素 (8, 3) 的直线在第 4 列的高度是 12/8，恰好在两行正中间。第 4 列点亮的是哪个像素？\
         请写出列和行，例如 2,1。",
    ],
    choices: &[],
    solve: |_| {
        let window = PixelRect::window(9, 4);
        let [there, back] = [line([0, 0], [8, 3], window), line([8, 3], [0, 0], window)];
        let row = (0..4).find(|&y| hits(&there, [4, y]) > 0).expect("every column is lit");
        // Either direction must light it.
        assert_eq!(there, back, "a line does not depend on its direction");
        Solution::new(Answer::Pixel([4, row])).grid("0,0 8,3", ascii::grid(&there, &there))
    },
    why: [
        "A tie lights the pixel farther along in the minor direction, seen from the end with the smaller major \
         coordinate; so the line from (8, 3) back to (0, 0) has the same pixels.",
        "平局时，从主轴坐标较小的一端看去，点亮次轴方向上走得更远的那个；所以从 (8, 3) 画回 (0, 0)，像素相同。",
    ],
};

/// A square of two halves with its corners on centres.
const CENTRED: [Px; 2] =
    [[[0.5, 0.5], [4.5, 0.5], [4.5, 4.5]], [[0.5, 0.5], [4.5, 4.5], [0.5, 4.5]]];

const TWICE: Exercise = Exercise {
    question: [
        "The square (0.5, 0.5) to (4.5, 4.5) is split along the diagonal from (0.5, 0.5), and both halves take every sample with \
         all edge functions >= 0. Which of these pixels is hit twice?",
        "正方形 (0.5, 0.5) 到 (4.5, 4.5) 沿过 (0.5, 0.5) 的对角线分成两半，两半都取所有边函数 >= 0 的采样点。\
         下面哪个像素被命中两次？",
    ],
    choices: &[["(0, 3)"; 2], ["(1, 2)"; 2], ["(2, 2)"; 2], ["(3, 0)"; 2]],
    solve: |choices| {
        let window = PixelRect::window(6, 6);
        let inclusive = published(&SysuInclusive, &CENTRED, window);
        let right = truth(&CENTRED, window);
        let twice = |text: &super::Text| pixel(text[0]).is_some_and(|p| hits(&inclusive, p) == 2);
        let all: Vec<_> = choices.iter().map(twice).collect();
        let doubles = inclusive.rows().flat_map(|(_, row)| row).filter(|&&n| n == 2).count();
        Solution::new(Answer::only(&all))
            .figure(doubles)
            .grid("sysu-inclusive", ascii::grid(&inclusive, &right))
            .grid("oracle", ascii::grid(&right, &right))
    },
    why: [
        "The diagonal passes through the centres of the pixels (0, 0) to (4, 4), where both halves say yes: {} \
         pixels are drawn twice (`2`).",
        "对角线穿过像素 (0, 0) 到 (4, 4) 的中心，两半在那里都说“是”：{} 个像素画了两次（`2`）。",
    ],
};

const HOLES: Exercise = Exercise {
    question: [
        "Which of these three rules leaves a hole inside a square of two triangles whose corners are pixel centres?",
        "由两个三角形拼成、顶点都在像素中心的正方形，下面三条规则中哪一条会在里面留下空洞？",
    ],
    choices: &[
        ["all edge functions > 0", "所有边函数 > 0"],
        ["all edge functions >= 0", "所有边函数 >= 0"],
        ["> 0, and = 0 on top and left edges", "> 0，上边和左边也取 = 0"],
    ],
    solve: |_| {
        let window = PixelRect::window(6, 6);
        let right = truth(&CENTRED, window);
        let strict = Games101Strict { whole_samples: false, true_w: false };
        let strict = published(&strict, &CENTRED, window);
        let inclusive = published(&SysuInclusive, &CENTRED, window);
        let is_hole = |(a, t): (&u8, &u8)| *a == 0 && *t > 0;
        let has_hole = |c: &Coverage| {
            c.rows().zip(right.rows()).any(|((_, a), (_, t))| a.iter().zip(t).any(is_hole))
        };
        let all = [&strict, &inclusive, &right].map(has_hole);
        Solution::new(Answer::only(&all))
            .figure(right.covered() - strict.covered())
            .grid("games101-strict", ascii::grid(&strict, &right))
            .grid("sysu-inclusive", ascii::grid(&inclusive, &right))
            .grid("oracle", ascii::grid(&right, &right))
    },
    why: [
        "With > 0 nobody owns a sample on an edge: {} pixels are missing (`-`), the diagonal among them. With >= 0 \
         nothing is missing, but edges are drawn by both sides and beyond.",
        "用 > 0，边上的采样点没有人要：少了 {} 个像素（`-`），对角线也在其中。用 >= 0 什么也不缺，\
         但公共边两边都画，外侧也多画。",
    ],
};

const RIGHT_ANGLE: Px = [[0.5, 0.5], [4.5, 0.5], [0.5, 4.5]];

const OWNED: Exercise = Exercise {
    question: [
        "How many pixels does the triangle (0.5, 0.5) (4.5, 0.5) (0.5, 4.5) cover under the top-left rule? All three \
         edges run through pixel centres.",
        "按左上规则，三角形 (0.5, 0.5) (4.5, 0.5) (0.5, 4.5) 覆盖几个像素？三条边都穿过像素中心。",
    ],
    choices: &[],
    solve: |_| {
        let window = PixelRect::window(6, 6);
        let right = truth(&[RIGHT_ANGLE], window);
        let strict = Games101Strict { whole_samples: false, true_w: false };
        let strict = published(&strict, &[RIGHT_ANGLE], window);
        let inclusive = published(&SysuInclusive, &[RIGHT_ANGLE], window);
        Solution::new(Answer::count(right.covered()))
            .figure(strict.covered())
            .figure(inclusive.covered())
            .grid("oracle", ascii::grid(&right, &right))
            .grid("sysu-inclusive", ascii::grid(&inclusive, &right))
    },
    why: [
        "Centres on the upper and on the left edge belong to it, those on the slanted edge do not, for it is a right \
         one. Strict tests keep {} pixels, inclusive ones {}.",
        "上边和左边上的中心归它，斜边上的不归它，因为斜边是右边。严格的判断留下 {} 个像素，不严格的则有 {} 个。",
    ],
};
