//! SYSU assignment 2: lines, clipping, culling, weights.

use glam::{DVec2, DVec4};

use super::tools::{Px, corners};
use super::{Answer, Chapter, Exercise, Solution};
use rasterproof_core::contract::{DrawLine as _, Rasterize as _};
use rasterproof_core::grid::PixelRect;
use rasterproof_core::line::bresenham::Bresenham;
use rasterproof_core::triangle::{LineEnd, PixelPoint, ScreenLine};
use rasterproof_faults::published::sysu_bresenham::SysuBresenham;
use rasterproof_faults::published::sysu_weights::SysuWeights;
use rasterproof_faults::published::{
    ClipVertex, Published as _, PublishedLine as _, bare, sysu_simple_clip,
};
use rasterproof_registry::engines::Drawer;
use rasterproof_render::effects::Effects;
use rasterproof_render::pipeline::Counters;
use rasterproof_render::pipeline::assemble::{Assembler, Cull};
use rasterproof_render::pipeline::target::{Antialias, Target};
use rasterproof_render::scene::chapters;
use rasterproof_verify::oracle::Oracle;
use rasterproof_verify::oracle::values::along_line;

pub const CHAPTER: Chapter = Chapter {
    page: "sysu",
    title: ["SYSU assignment 2", "中山大学作业 2"],
    exercises: &[DECISION, BACKWARDS, DROPPED, TURNED, CORNER],
};

/// The rows of a line from (0, 0), one for each of its columns.
fn rows(to: [i32; 2]) -> Vec<i32> {
    let end = |[x, y]: [i32; 2]| LineEnd { pixel: PixelPoint::new(x, y), depth: 0.0, varying: 0.0 };
    let mut rows = Vec::new();
    let line = ScreenLine { ends: [end([0, 0]), end(to)] };
    Bresenham.draw(&line, PixelRect::window(16, 16), |f| rows.push(f.y_px));
    rows
}

const DECISION: Exercise = Exercise {
    question: [
        "From (0, 0) to (8, 3) the decision begins with p_0 = 2 dy - dx = -2, so column 1 keeps its row. What is p_1?",
        "从 (0, 0) 到 (8, 3)，判别量从 p_0 = 2 dy - dx = -2 开始，所以第 1 列留在本行。p_1 是多少？",
    ],
    choices: &[],
    solve: |_| {
        let (dx, rows) = (8.0, rows([8, 3]));
        // dx times the difference of the distances to the two rows, from the exact height.
        let decision = |u: i32| {
            let height = along_line([0.0, 3.0], u64::from(u.unsigned_abs()) + 1, 8).to_f64();
            let lower = height - f64::from(rows[u as usize]);
            dx * (lower - (1.0 - lower))
        };
        Solution::new(Answer::Number { value: decision(1), decimals: 0 }).figure(rows[2])
    },
    why: [
        "p_0 + 2 dy = -2 + 6, and no 2 dx, for there was no step sideways. It is positive: column 2 is lit in row {}.",
        "p_0 + 2 dy = -2 + 6；没有横移，所以不减 2 dx。它是正的：第 2 列点亮的是第 {} 行。",
    ],
};

/// The row of column 1 on a line between (0, 0) and (2, 1), as published.
fn published_row(ends: [[f64; 2]; 2]) -> i32 {
    let mut row = None;
    let mut emit = |x, y| row = if x == 1 { Some(y) } else { row };
    let drawn = SysuBresenham.draw(ends, PixelRect::window(3, 2), &mut emit);
    assert_eq!(drawn, Ok(()));
    row.expect("every column is lit")
}

const BACKWARDS: Exercise = Exercise {
    question: [
        "The report's code stays in its row while p < 0. From (0, 0) to (2, 1) it lights (1, 1). Which pixel of column 1 \
         does it light from (2, 1) back to (0, 0)?",
        "报告的代码在 p < 0 时留在本行。从 (0, 0) 画到 (2, 1)，它点亮 (1, 1)。从 (2, 1) 画回 (0, 0)，\
         第 1 列点亮的是哪个像素？",
    ],
    choices: &[],
    solve: |_| {
        let (first, last) = ([0.5, 0.5], [2.5, 1.5]);
        let [there, back] = [[first, last], [last, first]].map(published_row);
        // The question gives the way there.
        assert_eq!(there, 1);
        Solution::new(Answer::Pixel([1, back])).figure(rows([2, 1])[1])
    },
    why: [
        "The height is 1/2 there, p is 0, and 0 is not < 0: the step is taken, whichever way one comes. A drawer that \
         fixes the side of ties on the sorted ends lights row {} both ways.",
        "那里的高度是 1/2，p 为 0，而 0 并不 < 0：不论从哪边来都会横移。按排好序的两端固定平局归属，\
         两个方向点亮的都是第 {} 行。",
    ],
};

/// Corners on the screen, where w is 1 and visible is -1 to 1.
type Screen = [[f64; 2]; 3];

const AROUND: Screen = [[-9.0, -3.0], [9.0, -3.0], [0.0, 9.0]];
const ACROSS: Screen = [[0.0, 0.0], [3.0, 0.0], [0.0, 3.0]];
const BESIDE: Screen = [[2.0, 0.0], [3.0, 0.0], [2.0, 1.0]];

/// Whether the published choice drops a triangle of which something is visible.
fn is_lost(triangle: Screen) -> bool {
    let vertices = triangle
        .map(|[x, y]| ClipVertex { position: DVec4::new(x, y, 0.0, 1.0), varying: DVec2::ZERO });
    let window = PixelRect::window(8, 8);
    let mut visible = false;
    let assembler = Assembler::new(window, Cull::None);
    let points = vertices.map(|v| assembler.point(v.position));
    assembler.assemble(
        points.each_ref(),
        |_| 0.0,
        &mut Counters::default(),
        |piece| {
            Oracle.cover(piece.corners(), window, |_| visible = true);
        },
    );
    visible && sysu_simple_clip::kept(vertices).is_empty()
}

const DROPPED: Exercise = Exercise {
    question: [
        "A simple clip keeps a triangle if one of its corners is inside the view volume. Which of these does it lose \
         although some of it is visible?",
        "简单裁剪：三个顶点里有一个落在视锥体内，整个三角形就留下。下面哪个三角形明明看得见，却被丢掉？",
    ],
    choices: &[
        ["one corner inside, two outside", "一个顶点在内，两个在外"],
        ["three corners outside, around the whole screen", "三个顶点都在外，围住整个屏幕"],
        ["three corners beyond the right border", "三个顶点都在右边界之外"],
    ],
    solve: |_| Solution::new(Answer::only(&[ACROSS, AROUND, BESIDE].map(is_lost))),
    why: [
        "That no corner is inside does not mean that nothing is. Only what lies outside one plane with all its corners is \
         invisible for certain, like the last.",
        "没有顶点在内，不等于什么都不在内。只有全部顶点都在同一个平面之外，才一定看不见，例如最后一个。",
    ],
};

const TURNED: Exercise = Exercise {
    question: [
        "A box stands before the eye so that three of its faces show. How many of its 12 triangles does culling remove?",
        "眼前的盒子露出三个面。剔除会去掉它 12 个三角形中的几个？",
    ],
    choices: &[],
    solve: |_| {
        let scene = chapters::scene("cube", 4.0 / 3.0, 0.0).expect("a scene of the book");
        let mut target =
            Target::new(32, 24, Antialias::None, Default::default()).expect("a small target");
        let drawn = Drawer::EdgeFunction.render(&scene, &Effects::PLANNED, &mut target);
        let counters = drawn.expect("a sound scene").counters;
        Solution::new(Answer::count(counters.culled)).figure(counters.cull_tests)
    },
    why: [
        "Each of {} triangles is asked for the sign of its area; three faces turn their backs, of two triangles each.",
        "问过 {} 个三角形的面积正负；三个面背对着眼睛，每个面两个三角形。",
    ],
};

const COLOURED: Px = [[1.5, 9.5], [9.5, 8.5], [4.5, 1.5]];

const CORNER: Exercise = Exercise {
    question: [
        "A triangle abc is red at a, green at b and blue at c. A program weighs the colours of a, b, c by the functions of \
         the edges ab, bc, ca. Which colour appears at corner c?",
        "三角形 abc 的 a 红、b 绿、c 蓝。有个程序用边 ab、bc、ca 的边函数依次给 a、b、c 的颜色加权。\
         顶点 c 处出现什么颜色？",
    ],
    choices: &[["red", "红"], ["green", "绿"], ["blue", "蓝"]],
    solve: |_| {
        let at_c = |channel: usize| {
            let mut triangle = bare(COLOURED);
            triangle[channel].varying = DVec2::X;
            let mut value = None;
            let drawn = SysuWeights.fragments(&triangle, PixelRect::window(11, 11), &mut |f| {
                if (f.x_px, f.y_px) == (4, 1) {
                    value = Some(f.varying.x);
                }
            });
            assert_eq!(drawn, Ok(()));
            value.expect("the corner is a sample, and every edge counts as inside")
        };
        let values = [0, 1, 2].map(at_c);
        assert_eq!(corners(COLOURED)[2].to_px(), (4.5, 1.5), "the corner is the sample");
        let strongest = values.into_iter().fold(0.0, f64::max);
        Solution::new(Answer::only(&values.map(|value| value == strongest)))
    },
    why: [
        "The function of ab is 0 along ab and largest at c, opposite it: it is the weight of c, and here it is given to a. \
         Every colour has moved one corner on.",
        "边 ab 的函数沿 ab 为 0，在对面的 c 处最大：它是 c 的权重，这里却给了 a。每种颜色都挪了一个顶点。",
    ],
};
