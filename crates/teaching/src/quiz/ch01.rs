//! Chapter 1: pixels, the window and the lattice.

use super::answer::pixel;
use super::tools::{Px, hits, published, truth};
use super::{Answer, Chapter, Exercise, Solution};
use rasterproof_core::grid::{PixelRect, SUBPIXELS, SubpixelPoint, snap};
use rasterproof_faults::published::games101_strict::Games101Strict;
use rasterproof_report::ascii;

pub const CHAPTER: Chapter = Chapter {
    page: "ch01",
    title: ["pixels, the window and the lattice", "像素、窗口与格点"],
    exercises: &[NEGATIVE, TIE, SMALL, BASE],
};

const NEGATIVE: Exercise = Exercise {
    question: ["Which pixel holds the point (-0.3, 0.2)?", "点 (-0.3, 0.2) 落在哪个像素里？"],
    choices: &[["(0, 0)"; 2], ["(-1, 0)"; 2], ["(-1, -1)"; 2], ["(0, 1)"; 2]],
    solve: |choices| {
        let point = SubpixelPoint::from_px(-0.3, 0.2).expect("within the domain");
        let holds = [point.x, point.y].map(|sub| sub.div_euclid(SUBPIXELS));
        let all: Vec<_> = choices.iter().map(|text| pixel(text[0]) == Some(holds)).collect();
        Solution::new(Answer::only(&all)).figure(point.x).figure(-0.3f64 as i32)
    },
    why: [
        "Rounding down, not towards zero: x snaps to {} subpixels, and that is in column -1. A cast to int gives \
         column {}, so everything between -1 and 1 lands in one column.",
        "要向下取整，而不是向零取整：x 吸附到 {} 个子像素处，在第 -1 列。强制转换成 int 会得到第 {} 列，\
         于是 -1 与 1 之间的一切都落进同一列。",
    ],
};

const TIE: Exercise = Exercise {
    question: [
        "A vertex lies at x = 2.5/256 px, halfway between two points of the lattice. Which whole number of \
         subpixels does `snap` give?",
        "一个顶点在 x = 2.5/256 像素处，恰好在两个格点的正中间。`snap` 给出的子像素数是几？",
    ],
    choices: &[],
    solve: |_| {
        let to = |sub: f64| snap(sub / f64::from(SUBPIXELS)).expect("within the domain");
        let value = f64::from(to(2.5));
        Solution::new(Answer::Number { value, decimals: 0 })
            .figure(to(1.5))
            .figure(to(2.5))
            .figure(to(3.5))
    },
    why: [
        "A tie goes to the even neighbour, so it drifts to neither side: 1.5 becomes {}, 2.5 becomes {} and 3.5 \
         becomes {}.",
        "向偶数舍入，所以不会偏向任何一边：1.5 变成 {}，2.5 变成 {}，3.5 变成 {}。",
    ],
};

const BETWEEN: Px = [[0.9, 0.9], [1.4, 0.9], [0.9, 1.4]];

const SMALL: Exercise = Exercise {
    question: [
        "How many pixels does the triangle (0.9, 0.9) (1.4, 0.9) (0.9, 1.4) cover?",
        "三角形 (0.9, 0.9) (1.4, 0.9) (0.9, 1.4) 覆盖几个像素？",
    ],
    choices: &[],
    solve: |_| {
        let window = PixelRect::window(4, 4);
        let right = truth(&[BETWEEN], window);
        let cast = Games101Strict { whole_samples: true, true_w: false };
        let cast = published(&cast, &[BETWEEN], window);
        Solution::new(Answer::count(right.covered()))
            .figure(cast.covered())
            .grid("games101-int", ascii::grid(&cast, &right))
            .grid("oracle", ascii::grid(&right, &right))
    },
    why: [
        "A pixel is asked at its centre, and no centre lies in the triangle; the corner (1, 1) of a pixel does. A \
         program that keeps the sample position in an int asks there and draws {} pixel too many (`+`).",
        "只在像素的中心提问，而三角形里没有任何中心，只有像素的一个角 (1, 1)。把采样位置存进 int 的程序就在角上提问，\
         多画了 {} 个像素（`+`）。",
    ],
};

const STANDING: Px = [[1.5, 3.5], [6.5, 3.5], [4.0, 0.5]];
const HANGING: Px = [[1.5, 3.5], [6.5, 3.5], [4.0, 6.5]];

const BASE: Exercise = Exercise {
    question: [
        "Two triangles share the edge from (1.5, 3.5) to (6.5, 3.5), which runs through the centres of row 3: one \
         has its apex above, at (4, 0.5), the other below, at (4, 6.5). Who owns the pixels of row 3?",
        "两个三角形共用从 (1.5, 3.5) 到 (6.5, 3.5) 的边，它恰好穿过第 3 行的像素中心：一个的顶点在上方 (4, 0.5)，\
         另一个在下方 (4, 6.5)。第 3 行的像素归谁？",
    ],
    choices: &[
        ["the upper one", "上面的"],
        ["the lower one", "下面的"],
        ["both", "两个都有"],
        ["neither", "都没有"],
    ],
    solve: |_| {
        let window = PixelRect::window(8, 8);
        let [upper, lower] = [STANDING, HANGING].map(|triangle| truth(&[triangle], window));
        let owns = |coverage| (1..7).any(|x| hits(coverage, [x, 3]) > 0);
        let (above, below) = (owns(&upper), owns(&lower));
        let all = [above && !below, below && !above, above && below, !above && !below];
        let row = lower.row(3).iter().map(|&n| u32::from(n)).sum::<u32>();
        Solution::new(Answer::only(&all))
            .figure(row)
            .grid("upper", ascii::grid(&upper, &upper))
            .grid("lower", ascii::grid(&lower, &lower))
    },
    why: [
        "For the lower triangle the edge is a top edge, and top and left edges own what lies on them; all {} pixels \
         go to it, and none is drawn twice or left out.",
        "对下面的三角形来说这条边是上边，而上边和左边拥有落在边上的采样点；{} 个像素全归它，\
         没有一个画了两次，也没有一个漏掉。",
    ],
};
