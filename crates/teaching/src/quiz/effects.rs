//! Effects on demand: what a picture calls for, and what not.

use std::sync::Arc;

use glam::{DMat4, DVec3, DVec4};

use super::{Answer, Chapter, Exercise, Solution};
use rasterproof_registry::engines::Drawer;
use rasterproof_render::effects::Effects;
use rasterproof_render::effects::render::Rendered;
use rasterproof_render::pipeline::assemble::Cull;
use rasterproof_render::pipeline::target::{Antialias, Target};
use rasterproof_render::scene::{Item, Material, Scene, chapters, shapes, textures};

pub const CHAPTER: Chapter = Chapter {
    page: "effects",
    title: ["effects on demand", "按需的效果"],
    exercises: &[OVERLAP, DIVIDE, SAMPLES, BACK],
};

/// Columns and rows of the window.
const SIDE: u32 = 16;

/// A panel parallel to the screen, of one colour, from (x0, y0) to (x1, y1) in pixels.
fn panel([x0, y0, x1, y1]: [f64; 4]) -> Item {
    let to_cube = |px: f64| px * 2.0 / f64::from(SIDE) - 1.0;
    let at = |x, y| DVec3::new(to_cube(x), -to_cube(y), 0.0);
    Item::new(
        shapes::quad([at(x0, y1), at(x1, y1), at(x1, y0), at(x0, y0)]),
        Material { colour: DVec3::new(0.2, 0.4, 0.8), ..Material::default() },
    )
}

/// Draws into a window of [`SIDE`]; the positions are those of clip space where w is 1.
fn draw(items: Vec<Item>, effects: &Effects, antialias: Antialias) -> Rendered {
    let scene = Scene { items, ..Scene::new("exercise", "of a page", DMat4::IDENTITY) };
    draw_scene(&scene, effects, antialias)
}

fn draw_scene(scene: &Scene, effects: &Effects, antialias: Antialias) -> Rendered {
    let mut target =
        Target::new(SIDE, SIDE, antialias, Default::default()).expect("a small target");
    Drawer::Scanline.render(scene, effects, &mut target).expect("a sound scene")
}

const OVERLAP: Exercise = Exercise {
    question: [
        "Panels parallel to the screen, in a window of 16 x 16 pixels. For which of these frames does the plan test \
         depths?",
        "16 x 16 像素的窗口里有若干与屏幕平行的面板。画下面哪一帧时，计划会做深度测试？",
    ],
    choices: &[
        ["one panel, of two triangles", "一块面板，由两个三角形组成"],
        ["two panels, a column of pixels between them", "两块面板，中间隔着一列像素"],
        ["two panels that overlap by a column of pixels", "两块面板，重叠一列像素"],
    ],
    solve: |_| {
        let left = |end| panel([1.0, 1.0, end, 15.0]);
        let right = || panel([8.0, 1.0, 15.0, 15.0]);
        let frames = [vec![left(7.0)], vec![left(7.0), right()], vec![left(9.0), right()]];
        let tests = |effects: Effects| {
            let frames = frames.clone();
            frames.map(|items| draw(items, &effects, Antialias::None).counters.depth_tests)
        };
        let planned = tests(Effects::PLANNED);
        Solution::new(Answer::only(&planned.map(|count| count > 0)))
            .figure(tests(Effects::ALWAYS)[1])
            .figure(planned[1])
    },
    why: [
        "What no other piece's bounding box meets neither hides nor is hidden, and two halves that share an edge meet in \
         no sample. The panels that are apart would be compared {} times; the plan compares {} times.",
        "包围盒不与别的图元相交的，既不遮挡也不被遮挡；共用一条边的两半没有公共的采样点。分开的两块面板本来要比较 {} 次，\
         按计划是 {} 次。",
    ],
};

/// A triangle in the window, of two or of one colour at its corners, with w = 1 + `slope` x.
fn leaning(slope: f64, colours: [DVec3; 3]) -> Item {
    let corners = [DVec3::new(-0.5, -0.5, 0.0), DVec3::new(0.5, -0.5, 0.0), DVec3::Y * 0.5];
    let material = Material { vertex_colours: true, ..Material::default() };
    let mut item = Item::new(shapes::triangle(corners, colours), material);
    item.model.x_axis = DVec4::new(1.0, 0.0, 0.0, slope);
    item
}

const DIVIDE: Exercise = Exercise {
    question: [
        "For which of these triangles is the division by 1/w needed in every fragment?",
        "下面哪个三角形需要在每个片元里除以 1/w？",
    ],
    choices: &[
        ["all corners have the same w, their colours differ", "各顶点的 w 相同，颜色不同"],
        [
            "w differs by a thousandth, all corners have one colour",
            "w 相差千分之一，各顶点颜色相同",
        ],
        ["w differs by a thousandth, the colours differ", "w 相差千分之一，颜色不同"],
    ],
    solve: |_| {
        let (same, different) = ([DVec3::ONE; 3], [DVec3::X, DVec3::Y, DVec3::Z]);
        let cases = [(0.0, different), (0.001, same), (0.001, different)];
        let divisions = cases.map(|(slope, colours)| {
            let items = vec![leaning(slope, colours)];
            draw(items, &Effects::PLANNED, Antialias::None).counters.divisions
        });
        Solution::new(Answer::only(&divisions.map(|count| count > 0))).figure(divisions[2])
    },
    why: [
        "With equal w the shares in the window are those in space, bit for bit; and a mean of equal values is that value, \
         whatever the weights. Else every fragment divides, here {} of them: a thousandth is little, but it is not \
         nothing, and a condition must be sufficient.",
        "w 相同，窗口里的比例就是空间里的比例，逐位相同；相同的值不论怎么加权，平均都是它自己。否则每个片元都要除，\
         这里是 {} 个：千分之一虽小，却不是零，而条件必须是充分的。",
    ],
};

const SAMPLES: Exercise = Exercise {
    question: [
        "A window of 16 x 16 pixels with 4 x 4 samples each holds one panel, two triangles of one colour, from (2.5, 2.5) to \
         (13.5, 13.5). For how many of the 256 pixels are the samples told apart?",
        "16 x 16 像素的窗口，每像素 4 x 4 个采样点，里面只有一块面板，由两个同色的三角形组成，从 (2.5, 2.5) 到 (13.5, 13.5)。\
         256 个像素里，有几个要把采样点分开？",
    ],
    choices: &[],
    solve: |_| {
        let items = vec![panel([2.5, 2.5, 13.5, 13.5])];
        let counters = draw(items, &Effects::PLANNED, Antialias::Supersample(4)).counters;
        let border = 12 * 12 - 10 * 10;
        Solution::new(Answer::count(counters.expanded))
            .figure(border)
            .figure(counters.expanded - border)
            .figure(SIDE * SIDE * 16)
    },
    why: [
        "The border passes through a ring of 12 x 12 - 10 x 10 = {} pixels, which hold two colours. Inside, {} pixels on the \
         diagonal get a part from each triangle, and that both parts have one colour is known only when both are there. In \
         all the others none of the {} samples is looked at by itself.",
        "边界穿过 12 x 12 - 10 x 10 = {} 个像素的一圈，那里有两种颜色。里面，对角线上的 {} 个像素从两个三角形各得一部分，\
         两部分同色这件事，要等两个都画了才知道。其余的像素里，{} 个采样点一个也不必单独去看。",
    ],
};

const BACK: Exercise = Exercise {
    question: [
        "A closed textured box stands before the eye, and nobody asks for culling. How many of its 12 triangles does the \
         plan leave out because their backs are turned?",
        "眼前有一个封闭的带纹理的盒子，没有人要求剔除。它的 12 个三角形里，计划因为背面朝前而省去几个？",
    ],
    choices: &[],
    solve: |_| {
        let centre = DVec3::new(0.0, 0.0, 4.0);
        let material =
            Material { texture: Some(Arc::new(textures::checkerboard())), ..Material::default() };
        let mesh = shapes::cuboid(centre - DVec3::ONE, centre + DVec3::ONE);
        let culled = |cull| {
            let mut scene = chapters::scene("cube", 1.0, 0.0).expect("a scene of the book");
            scene.items = vec![Item { cull, ..Item::new(mesh.clone(), material.clone()) }];
            draw_scene(&scene, &Effects::PLANNED, Antialias::None).counters.culled
        };
        Solution::new(Answer::count(culled(Cull::None))).figure(culled(Cull::Clockwise))
    },
    why: [
        "Where a front and a back face meet at the silhouette, their depths may tie to the last bit, and then the order \
         decides: leaving the back out can change a pixel. So it stays a request; asked for, it removes {}.",
        "在轮廓处正面与背面相接，深度可能直到最后一位都相等，这时由先后决定：省去背面可能改变像素。\
         所以剔除只在有人要求时才做；要求了，就去掉 {} 个。",
    ],
};
