//! Chapter 8: the view volume and the window.

use glam::DVec4;

use super::tools::{Px, truth};
use super::{Answer, Chapter, Exercise, Solution};
use rasterproof_core::grid::PixelRect;
use rasterproof_render::pipeline::ClipVertex;
use rasterproof_render::pipeline::assemble::Viewport;
use rasterproof_render::pipeline::clip::outcode;
use rasterproof_render::pipeline::transform::frustum;
use rasterproof_report::ascii;

pub const CHAPTER: Chapter = Chapter {
    page: "ch08",
    title: ["the view volume and the window", "视锥体与窗口"],
    exercises: &[PLACE, SIZE, BEHIND, MIDDLE],
};

const PLACE: Exercise = Exercise {
    question: [
        "At which x, in pixels, does x = 0.5 of the device coordinates (NDC) land in a window 8 pixels wide?",
        "设备坐标（NDC）的 x = 0.5 落在 8 像素宽的窗口的哪个 x（像素）处？",
    ],
    choices: &[],
    solve: |_| {
        let vertex = ClipVertex { position: DVec4::new(0.5, 0.0, 0.0, 1.0), varying: () };
        let placed =
            Viewport::new(PixelRect::window(8, 6)).place(&vertex).expect("within the window");
        Solution::new(Answer::Number { value: placed.position.to_px().0, decimals: 1 })
    },
    why: [
        "(0.5 + 1) / 2 times 8. The window is 8 pixels wide: pixel 0 begins at 0 and pixel 7 ends at 8.",
        "(0.5 + 1) / 2 乘 8。窗口宽 8 像素：第 0 个像素从 0 开始，第 7 个到 8 为止。",
    ],
};

/// The square from -1 to 1 in a window of 4 x 3, times (size - 1), y up.
const SQUEEZED: [Px; 2] =
    [[[0.0, 3.0], [3.0, 3.0], [3.0, 1.0]], [[0.0, 3.0], [3.0, 1.0], [0.0, 1.0]]];

const SIZE: Exercise = Exercise {
    question: [
        "A program maps -1 ... 1 to the window by times (size - 1), y up, with its samples at centres. How many of the 4 x 3 \
         pixels does the square over the whole screen cover?",
        "有个程序把 -1 … 1 乘以（尺寸 - 1）映射到窗口，y 向上，采样点在像素中心。铺满屏幕的正方形覆盖 4 x 3 个像素中的几个？",
    ],
    choices: &[],
    solve: |_| {
        let window = PixelRect::window(4, 3);
        let whole = [[[0.0, 3.0], [4.0, 3.0], [4.0, 0.0]], [[0.0, 3.0], [4.0, 0.0], [0.0, 0.0]]];
        let [squeezed, right] = [truth(&SQUEEZED, window), truth(&whole, window)];
        Solution::new(Answer::count(squeezed.covered()))
            .grid("size - 1", ascii::grid(&squeezed, &right))
            .grid("size", ascii::grid(&right, &right))
    },
    why: [
        "The square ends at 3 and at 2 instead of 4 and 3: a column and a row stay empty (`-`).",
        "正方形只到 3 和 2，而不是 4 和 3：空出一列和一行（`-`）。",
    ],
};

const BEHIND: Exercise = Exercise {
    question: [
        "A corner has the clip coordinates (0.5, 0.5, 0.5, -2). Is it in the view volume?",
        "一个顶点的裁剪坐标是 (0.5, 0.5, 0.5, -2)。它在视锥体里吗？",
    ],
    choices: &[
        ["yes, for divided by w it is in the cube", "在，因为除以 w 之后在立方体里"],
        ["no, it is behind the eye", "不在，它在眼睛后面"],
    ],
    solve: |_| {
        let position = DVec4::new(0.5, 0.5, 0.5, -2.0);
        let inside = outcode(&ClipVertex { position, varying: 0.0 }) == 0;
        let divided = position.truncate() / position.w;
        Solution::new(Answer::only(&[inside, !inside]))
            .figure(divided.x)
            .figure(divided.y)
            .figure(divided.z)
    },
    why: [
        "Divided it looks like ({}, {}, {}), in the middle of the cube: for w < 0 the comparisons turn round. \
         So the six borders are asked before the division.",
        "除完之后看上去是 ({}, {}, {})，就在立方体里：w < 0 时比较全都反过来。所以六个边界要在除法之前问。",
    ],
};

const MIDDLE: Exercise = Exercise {
    question: [
        "The near plane is at 1, the far plane at 10. Which distance lands in the middle of the cube, at z = 0?",
        "近平面在 1，远平面在 10。哪个距离落在立方体的正中间，即 z = 0？",
    ],
    choices: &[],
    solve: |_| {
        let projection = frustum(-1.0, 1.0, -1.0, 1.0, 1.0, 10.0).expect("it is a frustum");
        let back = projection.inverse() * DVec4::new(0.0, 0.0, 0.0, 1.0);
        Solution::new(Answer::Number { value: back.z / back.w, decimals: 2 })
    },
    why: [
        "z' = 0 where (f + n) z = 2 n f: at 2nf / (f + n), close to 2n. What is near gets most of the box.",
        "z' = 0 即 (f + n) z = 2 n f：在 2nf / (f + n) 处，接近 2n。立方体的大半都给了近处。",
    ],
};
