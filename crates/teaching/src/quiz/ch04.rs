//! Chapter 4: homogeneous coordinates and projection.

use glam::{DVec3, DVec4};

use super::{Answer, Chapter, Exercise, Solution};
use rasterproof_render::pipeline::transform::frustum;

pub const CHAPTER: Chapter = Chapter {
    page: "ch04",
    title: ["homogeneous coordinates and projection", "齐次坐标与投影"],
    exercises: &[SAME, DISTANCE, FILM, HALFWAY],
};

const FOUR: [DVec4; 3] = [
    DVec4::new(2.0, 1.0, 4.0, 1.0),
    DVec4::new(4.0, 2.0, 8.0, 4.0),
    DVec4::new(3.0, 2.0, 5.0, 3.0),
];

const SAME: Exercise = Exercise {
    question: [
        "Which of these homogeneous points is the same point as (2, 1, 4, 2)?",
        "下面哪个齐次点与 (2, 1, 4, 2) 是同一个点？",
    ],
    choices: &[["(2, 1, 4, 1)"; 2], ["(4, 2, 8, 4)"; 2], ["(3, 2, 5, 3)"; 2]],
    solve: |_| {
        let place = |p: DVec4| p.truncate() / p.w;
        let there = place(DVec4::new(2.0, 1.0, 4.0, 2.0));
        let solution = Solution::new(Answer::only(&FOUR.map(|p| place(p) == there)));
        solution.figure(there.x).figure(there.y).figure(there.z)
    },
    why: [
        "Dividing by w brings the point back: ({}, {}, {}). All multiples of a homogeneous point are that point.",
        "除以 w 就回到原来的点：({}, {}, {})。齐次点的一切倍数都是同一个点。",
    ],
};

/// A point in clip space; the film is 1 before the eye and reaches from -1 to 1.
fn project(p: DVec3) -> DVec4 {
    frustum(-1.0, 1.0, -1.0, 1.0, 1.0, 10.0).expect("it is a frustum") * p.extend(1.0)
}

const DISTANCE: Exercise = Exercise {
    question: [
        "The eye is at the origin and looks along z. What is w of the projected point (2, 1, 4)?",
        "眼睛在原点，沿 z 看去。点 (2, 1, 4) 投影之后的 w 是多少？",
    ],
    choices: &[],
    solve: |_| {
        let w = project(DVec3::new(2.0, 1.0, 4.0)).w;
        Solution::new(Answer::Number { value: w, decimals: 0 })
    },
    why: [
        "w is the distance along z that the division is about to lose: the projection (nx, ny, ., z) keeps it.",
        "w 就是沿 z 的距离，除法会把它丢掉，而投影 (nx, ny, ·, z) 把它留住。",
    ],
};

const FILM: Exercise = Exercise {
    question: [
        "The film stands at distance 1. At which x does the point (2, 1, 4) fall on it?",
        "底片在距离 1 处。点 (2, 1, 4) 落在底片上的 x 是多少？",
    ],
    choices: &[],
    solve: |_| {
        let p = project(DVec3::new(2.0, 1.0, 4.0));
        Solution::new(Answer::Number { value: p.x / p.w, decimals: 2 })
    },
    why: ["Similar triangles: n x / z.", "相似三角形：n x / z。"],
};

const HALFWAY: Exercise = Exercise {
    question: [
        "A rod leads from distance 2 to distance 6. Which share of its picture on the film lies before its middle, \
         counted from the near end?",
        "一根杆从距离 2 伸到距离 6。从近端算起，它的中点在底片上走过了几分之几？",
    ],
    choices: &[],
    solve: |_| {
        let ends = [DVec3::new(-2.0, 0.0, 2.0), DVec3::new(6.0, 0.0, 6.0)];
        let on_film = |p: DVec3| project(p).x / project(p).w;
        let [a, middle, b] = [ends[0], (ends[0] + ends[1]) / 2.0, ends[1]].map(on_film);
        Solution::new(Answer::Number { value: (middle - a) / (b - a), decimals: 2 })
    },
    why: [
        "t' = w_b t / (w_a + (w_b - w_a) t) with t = 1/2: the near half takes three times the room of the far one.",
        "t' = w_b t / (w_a + (w_b - w_a) t)，t = 1/2：近的一半所占的地方是远的一半的三倍。",
    ],
};
