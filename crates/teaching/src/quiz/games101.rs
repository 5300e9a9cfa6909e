//! GAMES101 homework 2: samples, averages, the box, the depth.

use glam::{DVec2, DVec3};

use super::tools::draw;
use super::{Answer, Chapter, Exercise, Solution};
use rasterproof_faults::published::{games101_box, games101_depth};
use rasterproof_render::pipeline::Counters;
use rasterproof_render::pipeline::target::{Antialias, Colour, Target};

pub const CHAPTER: Chapter = Chapter {
    page: "games101",
    title: ["GAMES101 homework 2", "GAMES101 作业 2"],
    exercises: &[SHADED, AVERAGE, BOX, DEPTH],
};

/// How often the fragment stage runs for pixel (3, 3), which lies wholly inside a triangle.
fn shaded(antialias: Antialias) -> usize {
    let corners = [[1.0, 1.0], [7.0, 1.5], [2.0, 7.0]];
    let positions = corners.map(|[x, y]| DVec3::new(x / 4.0 - 1.0, 1.0 - y / 4.0, 0.0));
    let (_, places) = draw(&positions, &[[0, 1, 2]], 8, antialias);
    places.into_iter().filter(|place| place.floor() == DVec2::splat(3.0)).count()
}

const SHADED: Exercise = Exercise {
    question: [
        "A pixel lies wholly inside a triangle whose colour varies. How often does the fragment stage run for it, with \
         2 x 2 samples supersampled, and with 4 samples multisampled?",
        "一个像素整个在颜色渐变的三角形里。2 x 2 超采样时，片元着色器为它运行几次？4 个采样点的多重采样呢？",
    ],
    choices: &[
        ["4 times and 4 times", "4 次和 4 次"],
        ["4 times and once", "4 次和 1 次"],
        ["once and 4 times", "1 次和 4 次"],
        ["once and once", "1 次和 1 次"],
    ],
    solve: |_| {
        let counts = [Antialias::Supersample(2), Antialias::Multisample4].map(shaded);
        let all = [[4, 4], [4, 1], [1, 4], [1, 1]];
        Solution::new(Answer::only(&all.map(|pair| pair == counts)))
    },
    why: [
        "Supersampling (SSAA) shades every sample. Multisampling (MSAA) keeps coverage and depth for every sample and \
         shades once for each triangle, at the centre of the pixel.",
        "超采样（SSAA）为每个采样点着色。多重采样（MSAA）给每个采样点记覆盖与深度，每个三角形只在像素中心着色一次。",
    ],
};

/// One pixel of 2 x 2 samples; each is drawn with the colour at its place, or left black.
fn resolved(samples: [Option<Colour>; 4]) -> Colour {
    let mut target =
        Target::new(1, 1, Antialias::Supersample(2), Default::default()).expect("a small target");
    target.clear_colour([0, 0, 0, u8::MAX], &mut Counters::default());
    for ((x, y), colour) in [(0, 0), (1, 0), (0, 1), (1, 1)].into_iter().zip(samples) {
        if let Some(colour) = colour {
            target.planes[0].write(x, y, colour);
        }
    }
    target.pixel(0, 0)
}

const AVERAGE: Exercise = Exercise {
    question: [
        "Of the 2 x 2 samples of a pixel one belongs to a green triangle (0, 255, 0), three to a blue one (0, 0, 255), \
         which is drawn last. How much green has the pixel, if one average is taken at the end?",
        "一个像素的 2 x 2 个采样点里，一个属于绿色三角形 (0, 255, 0)，三个属于后画的蓝色三角形 (0, 0, 255)。\
         最后统一取一次平均，这个像素的绿色分量是多少？",
    ],
    choices: &[],
    solve: |_| {
        let (green, blue) = (Some([0, 255, 0, 255]), Some([0, 0, 255, 255]));
        let whole = resolved([green, blue, blue, blue]);
        // As published, blue's own average over black replaces what green left.
        let last = resolved([None, blue, blue, blue]);
        Solution::new(Answer::count(u64::from(whole[1]))).figure(last[1]).figure(last[2])
    },
    why: [
        "A quarter of 255. If each triangle averages its own samples over black and the last one wins, {} of the green is \
         left and {} of the blue: a dark seam along the edge.",
        "255 的四分之一。若每个三角形各自与黑色平均，后画的覆盖先画的，绿色就只剩 {}，蓝色只有 {}：沿边出现一道暗缝。",
    ],
};

const BOX: Exercise = Exercise {
    question: [
        "A buffer holds a window 8 pixels wide, row after row, and nobody cuts the bounding box to the window. Which \
         pixel does a fragment at (11, 4) overwrite?",
        "缓冲区逐行存放 8 像素宽的窗口，包围盒没有裁剪到窗口内。位于 (11, 4) 的片元会改写哪个像素？",
    ],
    choices: &[],
    solve: |_| {
        let (x, y) = games101_box::lands(11, 4, 8);
        Solution::new(Answer::Pixel([x, y])).figure(4 * 8 + 11)
    },
    why: [
        "Its index is 4 times 8 + 11 = {}, which is column 3 of the next row: what leaves at the right comes in at the left.",
        "它的下标是 4 乘 8 加 11，等于 {}，那是下一行的第 3 列：从右边出去的，又从左边进来。",
    ],
};

const DEPTH: Exercise = Exercise {
    question: [
        "An edge leads from w = 1, z/w = -1 to w = 4, z/w = 1. In its middle on the screen z/w is 0. Which depth does the \
         published repair give there, which weighs z/w by 1/w?",
        "一条边从 w = 1、z/w = -1 通到 w = 4、z/w = 1。在屏幕上它的正中间，z/w 是 0。那份公开的修正用 1/w 给 z/w 加权，\
         在那里得到的深度是多少？",
    ],
    choices: &[],
    solve: |_| {
        let value = games101_depth::published([-1.0, 1.0], [1.0, 4.0], 0.5);
        Solution::new(Answer::Number { value, decimals: 1 })
    },
    why: [
        "(-1/1 + 1/4) / (1/1 + 1/4). z/w is linear in the window already; to divide a second time bends it towards the \
         nearer end.",
        "(-1/1 + 1/4) / (1/1 + 1/4)。z/w 在窗口里本来就是线性的；再除一次，就把它弯向较近的一端。",
    ],
};
