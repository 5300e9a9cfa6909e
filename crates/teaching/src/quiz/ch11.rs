//! Chapter 11: light, texture, models.

use glam::{DVec2, DVec3};

use super::{Answer, Chapter, Exercise, Solution};
use rasterproof_render::pipeline::shade::Light;
use rasterproof_render::pipeline::texture::{Filter, Texture, Wrap};

pub const CHAPTER: Chapter = Chapter {
    page: "ch11",
    title: ["light, texture, models", "光照、纹理、模型"],
    exercises: &[AWAY, SHORT, BEYOND, BETWEEN],
};

const LIGHT: Light = Light { towards: DVec3::Z, ambient: 0.2, diffuse: 0.8 };

const AWAY: Exercise = Exercise {
    question: [
        "The light from everywhere is 0.2, the light from one direction 0.8. How bright is a surface whose normal points \
         straight away from the light?",
        "环境光是 0.2，来自一个方向的光是 0.8。法向量正好背向光源的表面有多亮？",
    ],
    choices: &[],
    solve: |_| {
        let value = LIGHT.intensity(DVec3::NEG_Z);
        let without = LIGHT.ambient + LIGHT.diffuse * DVec3::NEG_Z.dot(LIGHT.towards);
        Solution::new(Answer::Number { value, decimals: 1 }).figure(format!("{without:.1}"))
    },
    why: [
        "max(0, n . l) is 0 there, and the light from everywhere remains. Without the maximum it would be {}.",
        "那里 max(0, n · l) 为 0，只剩环境光。没有这个 max 就会是 {}。",
    ],
};

const SHORT: Exercise = Exercise {
    question: [
        "Two unit normals at a right angle are interpolated. How many per cent too dark is the middle, if nobody brings \
         the normal back to length 1 (in whole per cent, without light from everywhere)?",
        "两个互相垂直的单位法向量作插值。若不把法向量恢复到长度 1，正中间会暗百分之几（取整数，不计环境光）？",
    ],
    choices: &[],
    solve: |_| {
        let normal = (DVec3::X + DVec3::Z) / 2.0;
        let light = Light { ambient: 0.0, diffuse: 1.0, ..LIGHT };
        // What the dot product alone says, over what it should be.
        let share = normal.dot(light.towards) / light.intensity(normal);
        let value = 100.0 * (1.0 - share);
        Solution::new(Answer::Number { value: value.round(), decimals: 0 })
            .figure(format!("{:.3}", normal.length()))
    },
    why: ["In the middle the mean of the two has length {}.", "正中间，两者的平均长度是 {}。"],
};

/// A black and a white texel side by side.
fn two_texels() -> Texture {
    Texture::new(2, 1, &[[0; 3], [255; 3]]).expect("two texels")
}

const BEYOND: Exercise = Exercise {
    question: [
        "A texture has two texels, left black, right white, and repeats. What does nearest lookup give at u = 1.1?",
        "一张纹理有两个纹素，左黑右白，可以重复。在 u = 1.1 处取最近的纹素，得到什么？",
    ],
    choices: &[["black", "黑"], ["white", "白"]],
    solve: |_| {
        let red = |u| two_texels().with(Filter::Nearest, Wrap::Repeat).at(DVec2::new(u, 0.5)).x;
        Solution::new(Answer::only(&[red(1.1) == 0.0, red(1.1) == 1.0]))
    },
    why: [
        "Beyond the picture it begins again: 1.1 is 0.1, in the left texel. With its border going on it would be white.",
        "超出画面就从头开始：1.1 就是 0.1，在左边的纹素里。若是边界延伸出去，就是白的。",
    ],
};

const BETWEEN: Exercise = Exercise {
    question: [
        "The same texture, bilinear, its border going on. How white is it at u = 0.5, from 0 to 1?",
        "同一张纹理，双线性，边界延伸。在 u = 0.5 处有多白（0 到 1）？",
    ],
    choices: &[],
    solve: |_| {
        let smooth = two_texels().with(Filter::Bilinear, Wrap::Clamp);
        let at = |u| smooth.at(DVec2::new(u, 0.5)).x;
        Solution::new(Answer::Number { value: at(0.5), decimals: 1 })
            .figure(at(0.25))
            .figure(at(0.75))
    },
    why: [
        "Texels carry their colour in the middle, at u = 0.25 ({}) and 0.75 ({}); halfway both weigh the same.",
        "纹素的颜色在它的正中间，u = 0.25 处是 {}，0.75 处是 {}；在两者正中间，权重相等。",
    ],
};
