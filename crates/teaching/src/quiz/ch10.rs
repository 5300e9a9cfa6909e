//! Chapter 10: matrices.

use std::f64::consts::FRAC_PI_2;

use glam::{DMat4, DVec3};

use super::{Answer, Chapter, Exercise, Solution};
use rasterproof_core::angle::turn_x;
use rasterproof_faults::published::book_rotate::{Turn, published};

pub const CHAPTER: Chapter = Chapter {
    page: "ch10",
    title: ["matrices", "矩阵"],
    exercises: &[FIRST, QUARTER, COMPANION, NORMAL],
};

const FIRST: Exercise = Exercise {
    question: [
        "S scales by 2, T moves by 1 along x; matrices stand before columns. Which product takes x = 1 to x = 3?",
        "S 放大 2 倍，T 沿 x 移动 1；矩阵写在列向量左边。哪个乘积把 x = 1 变成 x = 3？",
    ],
    choices: &[["T S"; 2], ["S T"; 2]],
    solve: |_| {
        let (s, t) = (DMat4::from_scale(DVec3::splat(2.0)), DMat4::from_translation(DVec3::X));
        let x = [t * s, s * t].map(|m| m.transform_point3(DVec3::ONE).x);
        Solution::new(Answer::only(&x.map(|x| x == 3.0))).figure(x[1])
    },
    why: [
        "The right one is applied first: scale to 2, then move to 3. The other product gives {}.",
        "右边的先作用：先放大到 2，再移到 3。另一个乘积得 {}。",
    ],
};

/// The axis that is nearest to a direction: x, -x, y, -y, z, -z.
fn is_near(p: DVec3, axis: DVec3) -> bool {
    (p - axis).length() < 1e-12
}

const QUARTER: Exercise = Exercise {
    question: [
        "Where does a quarter turn about x, in the ring x, y, z, take the y axis?",
        "每根轴都转向 x、y、z、x 这一圈里的下一根。绕 x 轴转四分之一圈，y 轴转到哪里？",
    ],
    choices: &[["z"; 2], ["-z"; 2], ["x"; 2]],
    solve: |_| {
        let y = turn_x(FRAC_PI_2).transform_vector3(DVec3::Y);
        let book = published(Turn::X, FRAC_PI_2, DVec3::Y);
        let all = [DVec3::Z, DVec3::NEG_Z, DVec3::X].map(|axis| is_near(y, axis));
        let name = if is_near(book, DVec3::NEG_Z) { "-z" } else { "z" };
        Solution::new(Answer::only(&all)).figure(name)
    },
    why: [
        "Each axis goes towards the next in the ring: a turn about x takes y to z. As the book prints it, its table \
         takes y to {}.",
        "每根轴转向这一圈里的下一根：绕 x 转，y 到 z。书中印出的表把 y 转到 {}。",
    ],
};

const COMPANION: Exercise = Exercise {
    question: [
        "The companion code's RotateX sets [1][1] to the cosine, then to the sine, and never sets [1][2]. What becomes \
         of (0, 1, 0) under a turn by 0?",
        "配套代码的 RotateX 先把 [1][1] 设成余弦，再设成正弦，[1][2] 则从未设过。转 0 度，(0, 1, 0) 变成什么？",
    ],
    choices: &[["(0, 1, 0)"; 2], ["(0, 0, 0)"; 2], ["(0, 0, 1)"; 2]],
    solve: |_| {
        let p = published(Turn::CodeX, 0.0, DVec3::Y);
        let all = [DVec3::Y, DVec3::ZERO, DVec3::Z].map(|point| is_near(p, point));
        Solution::new(Answer::only(&all))
    },
    why: [
        "y is multiplied by the sine of 0 alone. A turn by 0 must change nothing: the smallest test finds it.",
        "y 只乘了 0 的正弦。转 0 度本该什么也不变：最小的测试就能发现。",
    ],
};

const NORMAL: Exercise = Exercise {
    question: [
        "A surface is stretched to 4 times its width. Which matrix keeps its normals perpendicular, if M is the \
         stretching?",
        "一个表面被拉宽到 4 倍，M 是这个拉伸。哪个矩阵能让法向量仍然垂直于表面？",
    ],
    choices: &[
        ["M"; 2],
        ["the inverse of M, transposed", "M 的逆的转置"],
        ["the transpose of M", "M 的转置"],
    ],
    solve: |_| {
        let m = DMat4::from_scale(DVec3::new(4.0, 1.0, 1.0));
        let along = m.transform_vector3(DVec3::new(1.0, -1.0, 0.0));
        let dot = |n: DMat4| along.dot(n.transform_vector3(DVec3::new(1.0, 1.0, 0.0)));
        let dots = [m, m.inverse().transpose(), m.transpose()].map(dot);
        Solution::new(Answer::only(&dots.map(|dot| dot == 0.0))).figure(dots[0])
    },
    why: [
        "A tangent (1, -1, 0) becomes (4, -1, 0). Its product with the normal (1, 1, 0) under M is {}; only the inverse \
         transpose gives 0.",
        "切向量 (1, -1, 0) 变成 (4, -1, 0)。它与 M 变换后的法向量 (1, 1, 0) 的点积是 {}；只有逆的转置给出 0。",
    ],
};
