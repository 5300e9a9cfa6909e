//! The scenes, through the whole pipeline: both rasterizers draw the same pictures, a plan of effects
//! changes no bit, and what is left out where it is called for shows.

use std::num::NonZeroU32;
use std::sync::Arc;

use glam::{DMat4, DVec2, DVec3, DVec4};
use proptest::prelude::*;
use proptest::test_runner::Config;
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::PixelRect;
use rasterproof_registry::engines::Drawer;
use rasterproof_render::effects::plan::{Canvas, Clear, Order, Pieces, Plan, Samples};
use rasterproof_render::effects::render::Rendered;
use rasterproof_render::effects::{Effect, Effects, Mode};
use rasterproof_render::pipeline::Counters;
use rasterproof_render::pipeline::assemble::Cull;
use rasterproof_render::pipeline::depth::DepthFormat;
use rasterproof_render::pipeline::fog::{Fog, Growth};
use rasterproof_render::pipeline::highlight::Specular;
use rasterproof_render::pipeline::opacity::{AlphaMode, Opacity, OpacityMap};
use rasterproof_render::pipeline::physical::{Map, Physical};
use rasterproof_render::pipeline::present::DoubleBuffer;
use rasterproof_render::pipeline::punctual::{Kind, PunctualLight};
use rasterproof_render::pipeline::shade::Light;
use rasterproof_render::pipeline::target::{Antialias, Colour, Target};
use rasterproof_render::pipeline::texture::{Filter, Texture, Wrap};
use rasterproof_render::pipeline::transform::{look_at, perspective};
use rasterproof_render::scene::Shadows;
use rasterproof_render::scene::chapters::{entries, scene};
use rasterproof_render::scene::{
    Attribute, Corner, Hidden, Item, Material, Mesh, Scene, Shading, meshes, random, shapes,
    textures,
};
use rasterproof_report::frame_comparison::{self, Comparison};
use rasterproof_report::picture;
use rayon::prelude::*;
use serde_json::{Value, json};

use crate::illustrations::headed;
use crate::snapshots::{check_picture, check_words, each};

const SMOOTHINGS: [Antialias; 4] = [
    Antialias::None,
    Antialias::Multisample4,
    Antialias::Supersample(2),
    Antialias::Supersample(4),
];

/// What a target holds before a frame must not show: it is filled with this first.
const LAST_FRAME: [u8; 4] = [255, 0, 255, 255];

fn target(antialias: Antialias) -> Target {
    target_of(80, 60, antialias)
}

pub fn target_of(width: u32, height: u32, antialias: Antialias) -> Target {
    let mut target = Target::new(width, height, antialias, DepthFormat::Unorm32).unwrap();
    target.clear_colour(LAST_FRAME, &mut Default::default());
    for plane in &mut target.planes {
        plane.depth.fill(0);
    }
    target
}

/// A scene of the chapters, as it is before it turns.
pub fn still(name: &str) -> Scene {
    scene(name, 4.0 / 3.0, 0.0).unwrap()
}

fn draw(scene: &Scene, drawer: Drawer, effects: Effects, antialias: Antialias) -> Rendered {
    drawer.render(scene, &effects, &mut target(antialias)).unwrap()
}

/// The engines with all kinds of smoothing.
fn pairs() -> impl Iterator<Item = (Drawer, Antialias)> {
    Drawer::ALL.into_iter().flat_map(|drawer| SMOOTHINGS.map(|antialias| (drawer, antialias)))
}

/// One of them in turn.
fn pair(number: u64) -> (Drawer, Antialias) {
    (Drawer::ALL[number as usize % 2], SMOOTHINGS[number as usize / 2 % 4])
}

fn no_random_scene(count: u64, differs: impl Fn(&u64) -> bool + Sync + Send) {
    let wrong: Vec<u64> = (0..count).into_par_iter().filter(differs).collect();
    assert!(wrong.is_empty(), "{} random scenes differ, first {}", wrong.len(), wrong[0]);
}

/// A frame by each rasterizer, everything paid for, and how they compare.
fn by_both(scene: &Scene, antialias: Antialias) -> ([Rendered; 2], Comparison) {
    let mut targets = [target(antialias), target(antialias)];
    let [a, b] = &mut targets;
    let first = Drawer::Scanline.render(scene, &Effects::ALWAYS, a).unwrap();
    let second = Drawer::EdgeFunction.render(scene, &Effects::ALWAYS, b).unwrap();
    let comparison = frame_comparison::compare((&first.picture, a), (&second.picture, b), None);
    ([first, second], comparison)
}

fn scenes() -> impl Iterator<Item = Scene> {
    [0.0, 0.37]
        .into_iter()
        .flat_map(|turn| entries().map(move |entry| scene(entry.name, 4.0 / 3.0, turn).unwrap()))
}

/// With two of the four kinds of smoothing before a scene turns, and with the other two after it, or with `all` four.
fn check_both(all: bool) {
    let count = entries().count();
    for (number, scene) in scenes().enumerate() {
        let is_tried = |at: usize| all || at % 2 == (number + number / count) % 2;
        for (_, antialias) in SMOOTHINGS.into_iter().enumerate().filter(|(at, _)| is_tried(*at)) {
            let ([first, second], comparison) = by_both(&scene, antialias);
            assert!(comparison.agrees(), "{} {antialias:?}: {comparison:?}", scene.name);
            assert!(comparison.depths >= 4800);
            // One of the two has words of several widths.
            let wide = first.counters.wide;
            let second = Counters { wide, ..second.counters };
            assert_eq!(first.counters, second, "{} {antialias:?}", scene.name);
        }
    }
}

#[test]
fn scenes_are_the_same_by_both_rasterizers() {
    check_both(false);
}

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn scenes_are_the_same_by_both_rasterizers_with_any_smoothing() {
    check_both(true);
}

#[test]
fn scenes_look_as_kept() {
    each(&entries().collect::<Vec<_>>(), |entry| {
        let scene = still(entry.name);
        let [scanline, edges] = [Drawer::Scanline, Drawer::EdgeFunction].map(|drawer| {
            let mut target = target_of(480, 360, Antialias::None);
            drawer.render(&scene, &Effects::PLANNED, &mut target).unwrap().picture
        });
        assert!(scanline == edges, "{}", entry.name);
        let head = format!("{}, by scanline and by edge-function: the same", entry.name);
        let picture = headed(&head, &picture::of_frame(&scanline));
        check_picture(&format!("scene-{}", entry.name), &picture);
    });
}

/// Each scene with the engines and kinds of smoothing with which it is tried: all of them, or one of eight, in turn.
fn tried(all: bool) -> Vec<(Scene, Vec<(Drawer, Antialias)>)> {
    let of = |number: usize| pairs().enumerate().filter(move |(at, _)| all || at % 8 == number % 8);
    // A scene that has turned is tried with another pair.
    let count = entries().count();
    let tried =
        |(number, scene)| (scene, of(number + number / count).map(|(_, pair)| pair).collect());
    scenes().enumerate().map(tried).collect()
}

/// Plans in which one effect differs from the rest are of two kinds. A scene before it turns is drawn by one kind, and the turned
/// one by the other kind; with the next pair they are exchanged.
fn check_pictures(all: bool) {
    let count = entries().count();
    tried(all).into_par_iter().enumerate().for_each(|(number, (scene, pairs))| {
        for (at, (drawer, antialias)) in pairs.into_iter().enumerate() {
            let is_first = (number < count) == (at % 2 == 0);
            let whole = draw(&scene, drawer, Effects::ALWAYS, antialias).picture;
            let check = |effects: Effects, what: &str| {
                let planned = draw(&scene, drawer, effects, antialias).picture;
                let name = drawer.name();
                assert!(planned == whole, "{} {name} {antialias:?} {what}", scene.name);
            };
            check(Effects::PLANNED, "planned");
            check(Effects::USUAL, "usual");
            for effect in Effect::ALL {
                let name = effect.name();
                let one_differs = match is_first {
                    true => Effects::ALWAYS.with(effect, Mode::Planned),
                    false => Effects::PLANNED.with(effect, Mode::Always),
                };
                check(one_differs, name);
            }
        }
    });
}

#[test]
fn plans_change_no_bit() {
    check_pictures(false);
}

#[test]
#[ignore = "takes seconds; .ci/run --all runs it"]
fn plans_change_no_bit_with_any_smoothing() {
    check_pictures(true);
}

/// What was counted is what the plan says, where it leaves nothing open.
fn check_account(plan: &Plan, counters: &Counters, name: &str) {
    let sums = |effect: Effect| {
        let own = plan.decisions.iter().filter(move |d| d.effect == effect);
        own.fold([0; 2], |[on, open], d| [on + d.on, open + d.open])
    };
    let c = counters;
    for (effect, counted) in [
        (Effect::Clip, c.clipped),
        (Effect::WideWords, c.wide),
        (Effect::DepthBuffer, c.depths_cleared),
        (Effect::Samples, c.expanded),
        (Effect::Clear, c.cleared),
        (Effect::SecondBuffer, c.presented),
    ] {
        let [on, open] = sums(effect);
        assert!(open > 0 || on == counted, "{name} {}: {on}, {counted}", effect.name());
    }
    // The colours of corners are counted with all attributes.
    for effect in Effect::ALL.into_iter().filter(|effect| *effect != Effect::Colour) {
        let counted = effect.calls(counters);
        assert!(sums(effect) != [0; 2] || counted == 0, "{name} {}: {counted}", effect.name());
    }
}

/// A map that is read at second texture coordinates shows what it shows at first ones that are the same.
#[test]
fn maps_are_read_at_coordinates_of_their_own() {
    let mut read = [0; 2];
    for index in 0..120 {
        let mut scene = random::with_effects(8, index);
        for item in &mut scene.items {
            item.material.texture = None;
            item.material.opacity = None;
            let triangles = &item.mesh.triangles;
            let second = (0..triangles.len()).map(|i| triangles.at(i).map(|corner| corner.uv));
            let triangles =
                triangles.clone().with_second_uvs(Attribute::OfCorners(second.collect()));
            Arc::make_mut(&mut item.mesh).triangles = triangles;
            if let Some(surface) = &mut item.material.physical {
                Arc::make_mut(surface).second = [false; 4];
            }
        }
        let mut moved = scene.clone();
        for item in &mut moved.items {
            Arc::make_mut(&mut item.mesh).triangles.change_corners(|corner| {
                corner.uv = corner.uv * 3.0 + DVec2::X;
            });
            if let Some(surface) = &mut item.material.physical {
                Arc::make_mut(surface).second = [true; 4];
            }
        }
        let (drawer, antialias) = pair(index);
        for effects in [Effects::ALWAYS, Effects::PLANNED] {
            let [expected, drawn] =
                [&scene, &moved].map(|scene| draw(scene, drawer, effects, antialias));
            assert!(drawn.picture == expected.picture, "{index} {}", drawer.name());
            for (sum, pays) in read.iter_mut().zip([drawn.counters.levels, drawn.counters.texels]) {
                *sum += pays;
            }
        }
    }
    assert!(read[0] > 1000 && read[1] > 1000, "{read:?}");
}

/// A plan made before drawing is the one that the frame reports; written down and read again it
/// draws the same frame at the same cost, which is what it says.
fn check_plan(scene: &Scene, drawer: Drawer, effects: Effects, antialias: Antialias) {
    let name = format!("{} {} {antialias:?}", scene.name, drawer.name());
    let rendered = draw(scene, drawer, effects, antialias);
    let mut target = target(antialias);
    let plan = drawer.plan(scene, &effects, &Canvas::of(&target)).unwrap();
    // A frame does not take the digest of its own scene.
    let reported = Plan { scene: plan.scene, ..rendered.plan.clone() };
    assert!(plan == reported && plan.scene.is_some(), "{name}: {plan:?} {:?}", rendered.plan);
    let read: Plan = serde_json::from_str(&serde_json::to_string(&plan).unwrap()).unwrap();
    assert!(read == plan, "{name}: {read:?}");
    let executed = drawer.execute(&read, scene, &mut target).unwrap();
    assert!(executed.picture == rendered.picture, "{name}");
    assert_eq!(executed.counters, rendered.counters, "{name}");
    if effects == Effects::PLANNED {
        check_account(&plan, &rendered.counters, &name);
    }
}

fn check_plans(all: bool) {
    tried(all).into_par_iter().for_each(|(scene, pairs)| {
        for (drawer, antialias) in pairs {
            for effects in [Effects::PLANNED, Effects::USUAL, Effects::ALWAYS] {
                check_plan(&scene, drawer, effects, antialias);
            }
        }
    });
    (0..if all { 200 } else { 40 }).into_par_iter().for_each(|index| {
        let (drawer, antialias) = pair(index);
        check_plan(&random::with_effects(4, index), drawer, Effects::PLANNED, antialias);
    });
}

#[test]
fn plans_are_known_before_drawing() {
    check_plans(false);
}

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn plans_are_known_before_drawing_with_any_smoothing() {
    check_plans(true);
}

/// The rule by which pieces are drawn as they come, instead of a list of them.
pub fn as_they_come(interpolates: &Value) -> Value {
    json!({"as-they-come": {
        "interpolates": interpolates,
        "where_it_varies": true,
        "perspective": "planned",
        "depth": true,
        "specular": "planned",
        "reflection": "planned",
        "punctual": "planned",
        "normal_maps": "planned",
        "occlusion": "planned",
        "emission": "planned",
        "mip_maps": "planned",
        "shadows": "planned",
        "anisotropy": "planned",
        "fog": "planned",
        "alpha_test": "planned",
        "blending": "planned",
        "layers": "planned",
    }})
}

#[test]
fn an_edited_plan_is_followed() {
    let edit = |name: &str, drawer: Drawer, antialias: Antialias, words: &[(&str, &str)]| {
        let scene = still(name);
        let mut target = target(antialias);
        let plan = drawer.plan(&scene, &Effects::PLANNED, &Canvas::of(&target)).unwrap();
        let mut text = serde_json::to_string(&plan).unwrap();
        for (from, to) in words {
            assert!(text.contains(from), "{name}: no {from} in {text}");
            text = text.replace(from, to);
        }
        let mut json: Value = serde_json::from_str(&text).unwrap();
        if words.iter().any(|(_, to)| to.contains("never")) {
            // Other pieces than were listed.
            json["items"][0]["pieces"] = as_they_come(&json["items"][0]["carries"]);
        }
        let plan: Plan = serde_json::from_value(json).unwrap();
        let rendered = drawer.execute(&plan, &scene, &mut target).unwrap();
        assert!(rendered.plan == plan);
        (rendered, draw(&scene, drawer, Effects::PLANNED, antialias))
    };
    let (none, scan) = (Antialias::None, Drawer::Scanline);
    let (depth, perspective) =
        (r#""depth":true"#, (r#""perspective":true"#, r#""perspective":false"#));
    // As if the effect had been switched off.
    let never = |name: &str, effect| {
        draw(&still(name), scan, Effects::PLANNED.with(effect, Mode::Never), none).picture
    };
    let (edited, planned) = edit("cycle", scan, none, &[(depth, r#""depth":false"#)]);
    assert!(edited.picture == never("cycle", Effect::Depth) && edited.picture != planned.picture);
    assert_eq!(edited.counters.depth_tests, 0);
    let (edited, planned) = edit("tilted", scan, none, &[perspective]);
    assert!(edited.picture == never("tilted", Effect::Perspective));
    assert!(edited.picture != planned.picture);
    let colour = r#""interpolates":["colour"]"#;
    let (edited, planned) = edit("spinning", scan, none, &[(colour, r#""interpolates":[]"#)]);
    assert!(edited.picture == never("spinning", Effect::Interpolation));
    assert!(edited.picture != planned.picture);
    let clip = (r#""clip":"planned""#, r#""clip":"never""#);
    assert!(edit("frustum", scan, none, &[clip]).0.picture == never("frustum", Effect::Clip));
    let cull = (r#""cull":"planned""#, r#""cull":"never""#);
    assert_eq!(edit("culled", scan, none, &[cull]).0.counters.culled, 0);
    let clear = (r#""clear":"everything""#, r#""clear":"nothing""#);
    let (edited, _) = edit("cycle", scan, none, &[clear]);
    assert_eq!((edited.picture.get(0, 0), edited.counters.cleared), (Some(LAST_FRAME), 0));
    let depths = (r#""clear_depths":true"#, r#""clear_depths":false"#);
    let (edited, _) = edit("cycle", scan, none, &[depths]);
    assert_eq!(edited.counters.depth_failed, edited.counters.depth_tests, "last frame is nearer");
    let second = (r#""second_buffer":false"#, r#""second_buffer":true"#);
    assert_eq!(edit("cycle", scan, none, &[second]).0.counters.presented, 4800);
    let words = (r#""wide_words":"planned""#, r#""wide_words":"always""#);
    assert!(edit("cycle", Drawer::EdgeFunction, none, &[words]).0.counters.wide >= 3);
    // What the painter draws last is drawn first.
    let scene = Scene { hidden: Hidden::Painter, ..near_and_far(0.5) };
    let mut target = target(none);
    let mut plan = scan.plan(&scene, &Effects::PLANNED, &Canvas::of(&target)).unwrap();
    let painted = scan.execute(&plan, &scene, &mut target).unwrap().picture;
    plan.frame.order = Order::Submission;
    assert!(scan.execute(&plan, &scene, &mut target).unwrap().picture != painted);
    // Samples: the same picture at other costs.
    let over = Antialias::Supersample(4);
    let policy = r#"{"on-demand":{"flat-px":32,"varying-columns":64}}"#;
    let small = r#"{"on-demand":{"flat-px":4800,"varying-columns":64}}"#;
    let (edited, planned) = edit("facets", scan, over, &[(policy, small)]);
    assert!(edited.picture == planned.picture);
    assert!(edited.counters.expanded > planned.counters.expanded);
    let each = [
        (policy, r#""each""#),
        (r#""clear":"nothing""#, r#""clear":"everything""#),
        (r#""clear_depths":false"#, r#""clear_depths":true"#),
    ];
    let (edited, planned) = edit("facets", scan, over, &each);
    assert!(edited.picture == planned.picture && edited.counters.expanded == 4800);
}

/// A plan of another scene or target is refused, before anything is drawn.
#[test]
fn a_plan_of_something_else_is_refused() {
    let (cube, panels) = (still("cube"), still("panels"));
    let mut other = target(Antialias::None);
    let before = other.resolve();
    let plan = Drawer::Scanline.plan(&cube, &Effects::PLANNED, &Canvas::of(&other)).unwrap();
    let refused = |plan: &Plan, scene: &Scene, target: &mut Target| {
        Drawer::Scanline.execute(plan, scene, target).unwrap_err().to_string()
    };
    assert!(refused(&plan, &panels, &mut other).contains("the plan has 1 items, and the scene 24"));
    let mut large = target_of(81, 60, Antialias::None);
    let words = refused(&plan, &cube, &mut large);
    assert!(words.contains("80 x 60") && words.contains("81 x 60"), "{words}");
    // Other places, other samples and another version are refused in `plans.rs`.
    let mut short = plan.clone();
    let Pieces::Listed(runs) = &mut short.items[0].pieces else { panic!("{plan:?}") };
    runs[0].0 = u64::MAX;
    assert!(refused(&short, &cube, &mut other).contains("pieces of item 0, which has"));
    let mut outside = plan.clone();
    outside.frame.clear = Clear::Tiles(vec![PixelRect { x0: 60, y0: 0, x1: 92, y1: 32 }]);
    assert!(refused(&outside, &cube, &mut other).contains("(60, 0) to (92, 32)"));
    let mut scene = cube.clone();
    scene.items[0].model = DMat4::from_scale(DVec3::splat(f64::NAN));
    assert!(refused(&plan, &scene, &mut other).contains("item 0: vertex 0"));
    assert!(other.resolve() == before);
}

/// Samples on demand step aside where too little would stay whole for what it costs to ask. The mesh
/// is drawn at sizes where the other choice is slower by a tenth at least, as measured.
#[test]
fn samples_on_demand_step_aside() {
    let samples = |scene: &Scene, (width, height), antialias| {
        let canvas = Canvas::of(&target_of(width, height, antialias));
        let plan = Drawer::Scanline.plan(scene, &Effects::PLANNED, &canvas).unwrap();
        matches!(plan.frame.samples, Samples::OnDemand { .. })
    };
    let (small, large) = ((160, 120), (640, 480));
    let (over, multi) = (Antialias::Supersample(2), Antialias::Multisample4);
    assert!(samples(&still("facets"), small, over) && samples(&still("cycle"), small, over));
    let inside = still("inside");
    assert!(!samples(&inside, small, over), "not a pixel of background, all in one texture");
    let near = meshes::scene("bumps-4000").unwrap();
    let mut far = near.clone();
    far.items[0].model = DMat4::from_scale(DVec3::splat(0.1)) * far.items[0].model;
    far.items[0].model.w_axis = DVec4::new(0.0, 0.0, 8.0, 1.0);
    for antialias in [over, multi] {
        assert!(!samples(&near, large, antialias), "{antialias:?}: small pieces all over it");
        assert!(samples(&far, large, antialias), "{antialias:?}: most of it is background");
    }
    assert!(!samples(&far, (80, 60), multi), "as many pieces, and little background");
}

/// Random scenes, 10,000 or as many as `RASTERPROOF_SCENES` says, through both rasterizers: planned and
/// everything-on pictures have the same bits, and so have the two rasterizers'.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn random_scenes_planned_change_no_bit() {
    let count = std::env::var("RASTERPROOF_SCENES").ok().and_then(|n| n.parse().ok());
    let differs = |index: &u64| {
        let scene = random::with_effects(1, *index);
        let antialias = SMOOTHINGS[*index as usize % 4];
        let effect = Effect::ALL[*index as usize / 4 % Effect::ALL.len()];
        let draw = |drawer: Drawer, effects: Effects| {
            // Wide enough for pieces that are whole in pixels of four planes.
            let width = if antialias == Antialias::Multisample4 { 112 } else { 28 };
            let mut target = target_of(width, 21, antialias);
            drawer.render(&scene, &effects, &mut target).unwrap().picture
        };
        let whole = draw(Drawer::Scanline, Effects::ALWAYS);
        let same = draw(Drawer::Scanline, Effects::PLANNED) == whole
            && draw(Drawer::EdgeFunction, Effects::PLANNED) == whole
            && draw(Drawer::EdgeFunction, Effects::ALWAYS.with(effect, Mode::Planned)) == whole;
        !same
    };
    no_random_scene(count.unwrap_or(10_000), differs);
}

/// The picture of a plan in which large pieces are checked in squares of so many samples.
fn in_parts(
    scene: &Scene,
    drawer: Drawer,
    size: (u32, u32),
    antialias: Antialias,
    side: u32,
) -> Frame<Colour> {
    let mut target = target_of(size.0, size.1, antialias);
    let mut plan = drawer.plan(scene, &Effects::PLANNED, &Canvas::of(&target)).unwrap();
    for parts in plan.items.iter_mut().filter_map(|item| item.parts.as_mut()) {
        parts.side = side;
    }
    drawer.execute(&plan, scene, &mut target).unwrap().picture
}

fn check_parts(scenes: u64) {
    let wrong = |index: &u64| {
        let scene = random::with_effects(5, *index);
        let (drawer, antialias) = pair(*index);
        let side = [1, 2, 3, 5, 8, 16][*index as usize % 6];
        let size = [(40, 30), (160, 120)][*index as usize / 8 % 2];
        let mut target = target_of(size.0, size.1, antialias);
        let whole = drawer.render(&scene, &Effects::ALWAYS, &mut target).unwrap().picture;
        in_parts(&scene, drawer, size, antialias, side) != whole
    };
    no_random_scene(scenes, wrong);
}

/// Pieces that are planned square by square, down to squares of one sample, have the bits of everything-on.
#[test]
fn parts_of_pieces_change_no_bit() {
    check_parts(240);
}

#[test]
#[ignore = "takes half a minute; .ci/run --all runs it"]
fn parts_of_pieces_of_many_scenes_change_no_bit() {
    check_parts(4000);
}

/// A scene that violates the condition of one effect by `by`, and not at all for 0. Clip space is
/// the scene's own space where `w` is not asked for.
struct Counterexample {
    effect: Effect,
    scene: fn(by: f64) -> Scene,
    drawer: Drawer,
    antialias: Antialias,
    size: (u32, u32),
    rest: Effects,
}

impl Counterexample {
    /// What is seen of the scene with one mode of the effect.
    fn picture(&self, by: f64, mode: Mode) -> Frame<Colour> {
        let (scene, effects) = ((self.scene)(by), self.rest.with(self.effect, mode));
        let mut target = target_of(self.size.0, self.size.1, self.antialias);
        if self.effect != Effect::SecondBuffer {
            return self.drawer.render(&scene, &effects, &mut target).unwrap().picture;
        }
        // The screen shows the same scene, finished, until the first look after the clearing.
        let mut screen = DoubleBuffer::new(target);
        let finished = self.drawer.render(&scene, &effects, &mut screen.back).unwrap();
        screen.present(finished.picture, &mut Counters::default());
        let mut seen = Vec::new();
        let mut look = |frame: &Frame<Colour>| seen.push(frame.clone());
        self.drawer.render_watched(&scene, &effects, &mut screen, &mut look).unwrap();
        seen.swap_remove(0)
    }
}

fn plain(items: Vec<Item>) -> Scene {
    Scene { items, ..Scene::new("counterexample", "", DMat4::IDENTITY) }
}

fn one(mesh: Mesh, material: Material) -> Scene {
    plain(vec![Item::new(mesh, material)])
}

/// The whole screen up to `right`, at depths z of the left and the right side.
fn screen(right: f64, z: [f64; 2]) -> Mesh {
    shapes::quad([
        DVec3::new(-1.0, -1.0, z[0]),
        DVec3::new(right, -1.0, z[1]),
        DVec3::new(right, 1.0, z[1]),
        DVec3::new(-1.0, 1.0, z[0]),
    ])
}

/// The whole screen, of which corners have something else.
fn screen_with(change: impl FnMut(&mut Corner)) -> Mesh {
    let mut mesh = screen(1.0, [0.0; 2]);
    mesh.triangles.change_corners(change);
    mesh
}

/// Grey that lets so much through; nothing of what lies behind it where it is 1.
fn glass(value: f64, factor: f64) -> Material {
    let opacity = (factor < 1.0).then_some(Opacity { factor, map: None, mode: AlphaMode::Blend });
    Material { opacity, ..grey(value) }
}

/// The whole screen at one depth; in clip space z grows with the distance.
fn pane(z: f64, value: f64, factor: f64) -> Item {
    Item::new(screen(1.0, [z; 2]), glass(value, factor))
}

/// The colour of a frame that has no other, by each engine with all kinds of smoothing, with what it counted.
fn check_colour(scene: &Scene, [r, g, b]: [u8; 3], check: impl Fn(&Counters, Antialias)) {
    for (drawer, antialias) in pairs() {
        let drawn = draw(scene, drawer, Effects::PLANNED, antialias);
        let is_right = |colour: &Colour| *colour == [r, g, b, 255];
        let mut rows = drawn.picture.rows();
        assert!(rows.all(|(_, row)| row.iter().all(is_right)), "{} {antialias:?}", drawer.name());
        check(&drawn.counters, antialias);
    }
}

/// What is mixed writes no depth: of two sheets of one item the farther, which comes later, is drawn over the nearer.
#[test]
fn a_pane_hides_nothing() {
    let (mut mesh, far) = (screen(1.0, [-0.5; 2]), screen(1.0, [0.5; 2]));
    let first = mesh.positions.len() as u32;
    Arc::make_mut(&mut mesh.positions).extend_from_slice(&far.positions);
    for mut triangle in far.triangles.iter() {
        triangle.iter_mut().for_each(|corner| corner.position += first);
        mesh.triangles.push(triangle);
    }
    let scene = one(mesh, glass(1.0, 0.5));
    let over = |b: u8| ((128 * 255 + 127 * u32::from(b) + 127) / 255) as u8;
    check_colour(&scene, [0, 1, 2].map(|i| over(over(scene.background[i]))), |_, _| ());
}

/// Panes that are submitted from the nearest to the farthest are drawn the other way round, after what is opaque, over
/// each other, and each pixel is what the formula says; what lies between hides those behind it.
#[test]
fn panes_are_drawn_from_the_farthest() {
    let near_first = vec![pane(-0.5, 1.0, 0.25), pane(0.5, 0.0, 0.5), pane(0.9, 1.0, 1.0)];
    let over = |a: u32, c: u32, b: u32| (a * c + (255 - a) * b + 127) / 255;
    let expected = over(64, 255, over(128, 0, 255)) as u8;
    check_colour(&plain(near_first.clone()), [expected; 3], |_, _| ());
    // The far pane is behind a wall.
    let with_wall = [near_first, vec![pane(0.0, 0.4, 1.0)]].concat();
    check_colour(&plain(with_wall), [over(64, 255, 102) as u8; 3], |_, _| ());
}

/// With layers, the order of items and triangles decides nothing where everything is mixed; without, it does. So many layers
/// as are allowed are the nearest ones.
#[test]
fn layers_do_not_depend_on_the_order_of_drawing() {
    let mut differ_without = 0;
    for index in 0..60 {
        let mut scene = random::scene(7, index);
        scene.hidden = Hidden::DepthBuffer;
        for (i, item) in scene.items.iter_mut().enumerate() {
            item.material.opacity = glass(1.0, 0.3 + 0.1 * i as f64).opacity;
        }
        let mut reversed = scene.clone();
        reversed.items.reverse();
        for item in &mut reversed.items {
            Arc::make_mut(&mut item.mesh).triangles.reverse();
        }
        let (drawer, antialias) = pair(index);
        for layers in [None, NonZeroU32::new(1), NonZeroU32::new(3), NonZeroU32::new(u32::MAX)] {
            let drawn = [&scene, &reversed].map(|scene| {
                let scene = Scene { layers, ..scene.clone() };
                let drawn = draw(&scene, drawer, Effects::PLANNED, antialias);
                let left_out = drawn.counters.layers_left_out;
                assert!(left_out == 0 || layers != NonZeroU32::new(u32::MAX));
                drawn.picture
            });
            assert!(layers.is_none() || drawn[0] == drawn[1], "{index} {layers:?}");
            differ_without += usize::from(layers.is_none() && drawn[0] != drawn[1]);
        }
    }
    assert!(differ_without > 10, "{differ_without}");
}

/// Three panes from the nearest on, of which a sample shows as many as it may: each pixel is what the formula says.
#[test]
fn the_nearest_layers_are_shown() {
    // Farther ones come last, of one distance by the middle of their boxes.
    let items = [(0.9, 0.0, 1.0), (-0.5, 1.0, 0.5), (0.0, 0.0, 0.5), (0.5, 0.4, 0.5)]
        .map(|(z, value, factor)| pane(z, value, factor));
    let over = |c: u32, b: u32| (128 * c + 127 * b + 127) / 255;
    let shown = [over(255, 0), over(255, over(0, 0)), over(255, over(0, over(102, 0)))];
    for (most, shown) in (1..=3).zip(shown) {
        let scene = Scene { layers: NonZeroU32::new(most), ..plain(items.to_vec()) };
        check_colour(&scene, [shown as u8; 3], |counters, antialias| {
            let samples = 80 * 60 * antialias.samples();
            let counted = [counters.layers, counters.layers_left_out];
            assert_eq!(counted, [3 * samples, (3 - u64::from(most)) * samples], "{most}");
        });
    }
}

fn grey(value: f64) -> Material {
    Material { colour: DVec3::splat(value), ..Material::default() }
}

fn counterexamples() -> Vec<Counterexample> {
    let none = Antialias::None;
    let make = |effect, antialias, scene| Counterexample {
        effect,
        scene,
        drawer: Drawer::Scanline,
        antialias,
        size: (80, 60),
        rest: Effects::ALWAYS,
    };
    vec![
        make(Effect::Clip, none, |by| {
            // The left side moves in front of the near plane.
            one(screen(1.0, [-1.0 - by, 0.5]), grey(0.5))
        }),
        make(Effect::Cull, none, |by| {
            let cull = if by > 0.0 { Cull::CounterClockwise } else { Cull::None };
            plain(vec![Item { cull, ..Item::new(screen(1.0, [0.0; 2]), grey(0.5)) }])
        }),
        make(Effect::Perspective, none, |by| {
            // w = z: the right side moves away from the eye.
            let projection =
                DMat4::from_cols(DVec4::X, DVec4::Y, DVec4::new(0., 0., 0.5, 1.), DVec4::ZERO);
            let mut mesh = screen(1.0, [1.0, 1.0 + by]);
            mesh.triangles.change_corners(|corner| corner.colour = DVec3::splat(corner.uv.x));
            let material = Material { vertex_colours: true, ..grey(1.0) };
            Scene { projection, ..one(mesh, material) }
        }),
        make(Effect::Depth, none, near_and_far),
        make(Effect::Colour, none, |by| {
            let mesh = screen_with(|corner| corner.colour = DVec3::splat(1.0 - by));
            one(mesh, Material { vertex_colours: by > 0.0, ..grey(1.0) })
        }),
        make(Effect::Light, none, |by| {
            let light = Light { ambient: 1.0 - by, ..Light::NONE };
            let material = Material { shading: Shading::Phong, ..grey(1.0) };
            Scene { light, ..one(screen(1.0, [0.0; 2]), material) }
        }),
        make(Effect::Specular, none, |by| {
            // The normals are at a right angle to the eye and to the light behind it; one turns towards them.
            let mut mesh = screen_with(|corner| corner.normal = DVec3::X);
            mesh.triangles.change(0, |corners| corners[1].normal = DVec3::new(1.0, 0.0, -by));
            let light = Light { towards: -DVec3::Z, ambient: 0.5, diffuse: 0.5 };
            let specular = Specular { colour: DVec3::ONE, shininess: 1.0 };
            let material = Material { specular, shading: Shading::Phong, ..grey(1.0) };
            Scene { light, ..one(mesh, material) }
        }),
        make(Effect::Specular, none, |by| {
            // The same of a physical surface that faces away from a light at the side.
            let away = DVec3::new(-1.0, 0.0, -1.0);
            let mut mesh = screen_with(|corner| corner.normal = away);
            mesh.triangles.change(0, |corners| corners[1].normal -= DVec3::Z * by);
            let mut scene = reflecting(mesh, Physical::default());
            scene.light.towards = DVec3::X;
            scene.items[0].material.specular = Specular { colour: DVec3::ONE, shininess: 1.0 };
            scene
        }),
        make(Effect::Reflection, none, |by| {
            // All normals are at a right angle to the light, and one turns towards it.
            let mut mesh = screen_with(|corner| corner.normal = DVec3::X);
            mesh.triangles.change(0, |corners| corners[1].normal = DVec3::new(1.0, 0.0, -by));
            reflecting(mesh, Physical { metal: 1.0, ..Physical::default() })
        }),
        make(Effect::PunctualLights, none, |by| {
            // All normals are at a right angle to a direction, and one turns towards it.
            let mut mesh = screen_with(|corner| corner.normal = DVec3::X);
            mesh.triangles.change(0, |corners| corners[1].normal = DVec3::new(1.0, 0.0, -by));
            let sun = PunctualLight::new(Kind::Directional, DVec3::ONE, 3.0);
            Scene {
                punctual: vec![PunctualLight { at: -DVec4::Z, ..sun }],
                ..reflecting(mesh, Physical::default())
            }
        }),
        make(Effect::NormalMaps, none, |by| {
            // The right side reads beyond the flat one of two texels.
            reflecting(beyond(by), mapped(Map::Normal, [[128, 128, 255], [255, 128, 128]]))
        }),
        make(Effect::Occlusion, none, |by| {
            reflecting(beyond(by), mapped(Map::Occlusion, [[255; 3], [0; 3]]))
        }),
        make(Effect::Emission, none, |by| {
            reflecting(beyond(by), mapped(Map::Emission, [[0; 3], [255; 3]]))
        }),
        make(Effect::Shadows, none, |by| {
            // A smaller screen moves from the large one towards the light, which is behind the eye; its shadow is wider
            // by what the filter reads. The depths of the map reach to a third one.
            let light = Light { towards: -DVec3::Z, ambient: 0.5, diffuse: 0.5 };
            let material = || Material { shading: Shading::Flat, ..grey(1.0) };
            let items = [screen(1.0, [0.0; 2]), screen(0.0, [-by; 2]), screen(1.0, [0.5; 2])]
                .map(|mesh| Item::new(mesh, material()));
            let shadows = Some(Shadows { size: 32, bits: 32 });
            Scene { light, shadows, ..plain(items.to_vec()) }
        }),
        make(Effect::MipMaps, none, |by| {
            // A texel a pixel of the 80 x 60, and by so much more; black and white texels in turn.
            let size = DVec2::new(80.0, 60.0) / 16.0 * (1.0 - 0.5f64.powi(19) + by);
            chequered(Texture::with_mip_map, size)
        }),
        make(Effect::Anisotropy, none, |by| {
            // A footprint of 2 by 3 texels, of black and white ones in turn, and longer by so much.
            let longer = 3.0 * (1.0 - 0.5f64.powi(19) + by);
            let size = DVec2::new(2.0 * 80.0, longer * 60.0) / 16.0;
            chequered(|texture| texture.with_anisotropy(2), size)
        }),
        make(Effect::Fog, none, |by| {
            // In clip space the distance is z; fog begins at 0.
            let growth = Growth::Linear { start: 0.0, end: 1.0 };
            let fog = Some(Fog { colour: [0; 3], growth });
            Scene { fog, ..one(screen(1.0, [0.0, by]), grey(1.0)) }
        }),
        make(Effect::AlphaTest, none, |by| {
            // The right side reads beyond the opaque one of two texels.
            let map = Texture::grey(2, 1, vec![u8::MAX, 0]).unwrap();
            let map = Some(Arc::new(OpacityMap::new(map.with(Filter::Nearest, Wrap::Clamp))));
            let mode = AlphaMode::Test { threshold: 0.5 };
            let opacity = Some(Opacity { factor: 1.0, map, mode });
            let mesh = screen_with(|corner| corner.uv.x *= 0.5 * (1.0 + by));
            one(mesh, Material { opacity, ..grey(1.0) })
        }),
        make(Effect::Blending, none, |by| {
            let opacity = Some(Opacity { factor: 1.0 - by, map: None, mode: AlphaMode::Blend });
            one(screen(1.0, [0.0; 2]), Material { opacity, ..grey(1.0) })
        }),
        make(Effect::Layers, none, |by| {
            // The left pane comes nearer from far away, so that its middle lies behind the right one, which moves over it.
            let pane = |x: [f64; 2], z: [f64; 2], value: f64| {
                let corners = [(0, -1.0), (1, -1.0), (1, 1.0), (0, 1.0)];
                let mesh = shapes::quad(corners.map(|(side, y)| DVec3::new(x[side], y, z[side])));
                Item::new(mesh, glass(value, 0.5))
            };
            let panes = vec![
                pane([-1.0, 0.0125], [0.9, -0.5], 1.0),
                pane([0.0125 - by, 1.0], [0.0; 2], 0.0),
            ];
            Scene { layers: NonZeroU32::new(2), ..plain(panes) }
        }),
        make(Effect::Texture, none, |by| {
            let texel = textures::generate(1, |_, _| DVec3::splat(1.0 - by));
            let texture = (by > 0.0).then(|| Arc::new(texel));
            one(screen(1.0, [0.0; 2]), Material { texture, ..grey(1.0) })
        }),
        make(Effect::Interpolation, none, |by| {
            let mut mesh = screen(1.0, [0.0; 2]);
            mesh.triangles.change(0, |corners| corners[1].colour -= by);
            one(mesh, Material { vertex_colours: true, ..grey(1.0) })
        }),
        make(Effect::Samples, Antialias::Supersample(4), narrower_screen),
        make(Effect::Samples, Antialias::Multisample4, narrower_screen),
        make(Effect::Clear, none, narrower_screen),
        make(Effect::SecondBuffer, none, |by| one(screen(2.0 * by - 1.0, [0.0; 2]), grey(0.5))),
        // What is not tested needs no depths of before.
        Counterexample { rest: Effects::PLANNED, ..make(Effect::DepthBuffer, none, near_and_far) },
        Counterexample {
            drawer: Drawer::EdgeFunction,
            size: (16384, 520),
            rest: Effects::PLANNED,
            ..make(Effect::WideWords, none, |by| {
                // 510 rows need 32 bits.
                let y = 1.0 - 2.0 * (510.0 + 10.0 * by) / 520.0;
                let corners = [(-1.0, 1.0), (-1.0, y), (1.0, 1.0)];
                let corners = corners.map(|(x, y)| DVec3::new(x, y, 0.0));
                one(shapes::triangle(corners, [DVec3::ONE; 3]), grey(0.5))
            })
        },
    ]
}

/// A screen of grey in linear light, with the light behind the eye.
fn reflecting(mesh: Mesh, physical: Physical) -> Scene {
    let light = Light { towards: -DVec3::Z, ambient: 0.5, diffuse: 0.5 };
    let physical = Some(Arc::new(physical));
    let material = Material { physical, shading: Shading::Phong, ..grey(0.5) };
    Scene { light, ..one(shapes::with_tangents(mesh), material) }
}

/// The screen with the left one of two texels, and so much of the right one.
fn beyond(by: f64) -> Mesh {
    screen_with(|corner| {
        corner.uv.x *= 0.5 * (1.0 + by);
        corner.normal = -DVec3::Z;
    })
}

/// A surface with a map of two texels.
fn mapped(map: Map, texels: [[u8; 3]; 2]) -> Physical {
    let texture = Texture::new(2, 1, &texels).unwrap().with(Filter::Nearest, Wrap::Clamp);
    let mut physical = Physical { emission: DVec3::ONE, ..Physical::default() };
    physical.maps[Map::Emission as usize] = Some(Arc::new(Texture::new(1, 1, &[[0; 3]]).unwrap()));
    physical.maps[map as usize] = Some(Arc::new(texture));
    physical
}

/// The normal that a map makes of that of a back is the reversed one of the front.
#[test]
fn bumps_of_a_back_are_reversed() {
    let texel = [204, 50, 230];
    let surface = |mesh: Mesh, map: Option<[u8; 3]>| {
        let texture = map.map(|texel| Arc::new(Texture::new(1, 1, &[texel]).unwrap()));
        let mut physical = Physical::default();
        physical.maps[Map::Normal as usize] = texture;
        let mut scene = reflecting(mesh, physical);
        scene.light.towards = DVec3::new(-0.5, 0.4, -0.6).normalize();
        scene
    };
    let facing = |corners: [[f64; 2]; 4], normal: DVec3| {
        let mut mesh = shapes::quad(corners.map(|[x, y]| DVec3::new(x, y, 0.0)));
        mesh.triangles.change_corners(|corner| {
            corner.normal = normal;
            let DVec3 { x, y, .. } = mesh.positions[corner.position as usize];
            corner.uv = (DVec2::new(x, y) + 1.0) / 2.0;
        });
        mesh
    };
    // Along x, n x t, and away from the eye.
    let [x, y, z] = texel.map(|byte| 2.0 * f64::from(byte) / 255.0 - 1.0);
    let turned = DVec3::new(x, y, z);
    let front = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let back = [[-1.0, -1.0], [-1.0, 1.0], [1.0, 1.0], [1.0, -1.0]];
    let expected = surface(facing(front, -turned), None);
    let mut seen = surface(facing(back, DVec3::Z), Some(texel));
    seen.items[0].two_sided = true;
    let middle = |scene: &Scene| {
        let drawn = draw(scene, Drawer::Scanline, Effects::PLANNED, Antialias::None);
        drawn.picture.get(40, 30).unwrap()
    };
    let [expected, seen] = [&expected, &seen].map(middle);
    let is_near = expected.iter().zip(seen).all(|(a, b)| a.abs_diff(b) <= 1);
    assert!(is_near && expected[0] > 180, "{expected:?} {seen:?}");
}

/// A screen with a texture of black and white texels in turn, repeated so often.
fn chequered(kind: fn(Texture) -> Texture, repeated: DVec2) -> Scene {
    let texture = textures::generate(16, |x, y| DVec3::splat(f64::from((x + y) % 2)));
    let texture = Some(Arc::new(kind(texture.with(Filter::Nearest, Wrap::Repeat))));
    one(screen_with(|corner| corner.uv *= repeated), Material { texture, ..grey(1.0) })
}

/// A quad that leaves a strip of the screen to the background.
fn narrower_screen(by: f64) -> Scene {
    one(screen(1.0 - by, [0.0; 2]), grey(0.5))
}

/// The near one first; the far one moves over it.
fn near_and_far(by: f64) -> Scene {
    let far = shapes::quad([
        DVec3::new(0.25 - by, -1.0, 0.5),
        DVec3::new(1.0, -1.0, 0.5),
        DVec3::new(1.0, 1.0, 0.5),
        DVec3::new(0.25 - by, 1.0, 0.5),
    ]);
    // A border on a row of centres.
    let near = screen(0.2, [-0.5; 2]);
    plain(vec![Item::new(near, grey(0.9)), Item::new(far, grey(0.3))])
}

/// For each condition: at 0 it holds, and leaving the effect out changes nothing; then it is
/// violated by less and less, and for every violation that shows, the plan pays for the effect.
#[test]
fn every_condition_has_its_counterexample() {
    let mut lines = Vec::new();
    let examples = counterexamples();
    for effect in Effect::ALL {
        assert!(examples.iter().any(|example| example.effect == effect), "{}", effect.name());
    }
    for example in examples {
        let name = example.effect.name();
        // Whether leaving the effect out changes a pixel, and planning it does not.
        let differs = |by: f64| {
            let always = example.picture(by, Mode::Always);
            let differs = example.picture(by, Mode::Never) != always;
            assert!(!differs || example.picture(by, Mode::Planned) == always, "{name} {by:e}");
            differs
        };
        assert!(!differs(0.0), "{name}: left out where it is not called for");
        // Large pictures take their time.
        let count = if example.effect == Effect::WideWords { 4 } else { 60 };
        let (mut smallest, mut k) = (None, 0);
        while k < count {
            let shows = differs(0.5f64.powi(k));
            smallest = if shows { Some(k) } else { smallest };
            // Below the first violation that changes no pixel, one of eight is tried.
            k += if shows || smallest.is_none() { 1 } else { 8 };
        }
        let Some(k) = smallest else { panic!("{name}: no violation changes a pixel") };
        let samples = match example.antialias {
            Antialias::None => String::new(),
            antialias => format!(" of {} samples a pixel", antialias.samples()),
        };
        lines.push(format!("{name}{samples}: a violation by 2^-{k} changes a pixel"));
    }
    let text = lines.join("\n");
    check_words("counterexamples", &text);
}

/// A closed mesh seen from inside leaves no background, wherever the eye is and however near the
/// planes are; both rasterizers agree.
#[test]
fn closed_meshes_from_inside_leave_no_hole() {
    let background = [255, 0, 255, 255];
    let planes = [(1e-6, 1e6), (1e-3, 100.0), (0.5, 50.0)];
    for (i, mesh) in [
        shapes::sphere(DVec3::ZERO, 3.0, 24, 12),
        shapes::cuboid(-DVec3::splat(2.0), DVec3::splat(2.0)),
    ]
    .into_iter()
    .enumerate()
    {
        for (near, far) in planes {
            for k in 0..12 {
                // Up to a hair from the wall, but never with the near plane through it.
                let along = f64::from(k) / 12.0 * (1.9 - 2.0 * near);
                let eye = DVec3::new(along, -along / 3.0, along / 7.0) * 0.9;
                let angle = f64::from(k) * 0.7;
                let towards = eye + DVec3::new(angle.cos(), 0.3 * angle.sin(), angle.sin());
                let mut scene =
                    Scene::new("inside", "", perspective(1.2, 4.0 / 3.0, near, far).unwrap());
                scene.view = look_at(eye, towards, DVec3::Y).unwrap();
                scene.background = background;
                scene.items = vec![Item::new(mesh.clone(), grey(0.5))];
                let [a, b] = Drawer::ALL
                    .map(|drawer| draw(&scene, drawer, Effects::PLANNED, Antialias::None).picture);
                assert!(a == b, "mesh {i}, eye {k}, near {near}");
                let holes = a.rows().flat_map(|(_, row)| row).filter(|c| **c == background).count();
                assert_eq!(holes, 0, "mesh {i}, eye {k}, near {near}");
            }
        }
    }
}

/// The near plane through a mesh, w from 1e-6 to 1e6, the mesh far outside or huge: no panic, and
/// the same picture by both.
#[test]
fn torture_is_the_same_by_both() {
    let mesh = shapes::sphere(DVec3::ZERO, 1.0, 24, 12);
    let shading = Material {
        shading: Shading::Phong,
        texture: Some(Arc::new(textures::checkerboard())),
        ..grey(1.0)
    };
    for (k, (centre, size, near, far)) in [
        (DVec3::new(0.0, 0.0, 1.0), 1.0, 1.0, 10.0),
        (DVec3::new(0.3, 0.2, 1e-6), 1e6, 1e-6, 1e6),
        (DVec3::new(0.0, 0.0, 5e5), 5e5, 1e-6, 1e6),
        (DVec3::new(1e6, 0.0, 10.0), 1.0, 1e-6, 1e6),
        (DVec3::new(0.0, 0.0, -10.0), 1.0, 1e-3, 1e3),
        (DVec3::new(0.0, 0.0, 1e6), 1e12, 1e-6, 1e7),
        (DVec3::new(1e-7, 0.0, 2e-6), 1e-6, 1e-6, 1.0),
    ]
    .into_iter()
    .enumerate()
    {
        let mut scene = Scene::new("torture", "", perspective(1.0, 4.0 / 3.0, near, far).unwrap());
        let model = DMat4::from_scale_rotation_translation(
            DVec3::splat(size),
            glam::DQuat::from_rotation_y(0.3),
            centre,
        );
        scene.light = Light { towards: -DVec3::Z, ambient: 0.2, diffuse: 0.8 };
        scene.items = vec![Item { model, ..Item::new(mesh.clone(), shading.clone()) }];
        for antialias in SMOOTHINGS {
            let (_, comparison) = by_both(&scene, antialias);
            assert!(comparison.agrees(), "{k} {antialias:?}: {comparison:?}");
        }
    }
}

proptest! {
    #![proptest_config(Config { failure_persistence: None, ..Config::default() })]

    /// Any mixture of effects, each planned or always paid for, changes no bit, nor do all of them planned; any at all, with
    /// some left out, draws something and does not panic. A failure shrinks to fewer items.
    #[test]
    fn any_mixture_of_effects_draws(
        index in any::<u32>(),
        items in 1..6usize,
        kind in 0..4usize,
        modes in proptest::array::uniform25(0..3u8),
        some_never in any::<bool>(),
    ) {
        let mut scene = random::with_effects(3, index.into());
        scene.items.truncate(items);
        let mut effects = Effects::ALWAYS;
        for (effect, mode) in Effect::ALL.into_iter().zip(modes) {
            effects = effects.with(effect, match mode {
                0 => Mode::Planned,
                1 if some_never => Mode::Never,
                _ => Mode::Always,
            });
        }
        for drawer in Drawer::ALL {
            let mixed = draw(&scene, drawer, effects, SMOOTHINGS[kind]).picture;
            if !some_never {
                let whole = draw(&scene, drawer, Effects::ALWAYS, SMOOTHINGS[kind]).picture;
                prop_assert!(mixed == whole, "{} of random scene {index}", drawer.name());
                let planned = draw(&scene, drawer, Effects::PLANNED, SMOOTHINGS[kind]).picture;
                prop_assert!(planned == whole, "{} of random scene {index}", drawer.name());
            }
        }
    }
}

#[test]
fn map_shows_what_pixels_pay_for() {
    let check = |name: &str, antialias: Antialias, effect: Effect, expected: u64| {
        let scene = still(name);
        let (rendered, map) = Drawer::Scanline
            .render_mapped(&scene, &Effects::PLANNED, &mut target(antialias))
            .unwrap();
        let paying =
            map.effects.rows().flat_map(|(_, row)| row).filter(|p| **p & 1 << effect as u32 != 0);
        assert_eq!(paying.count() as u64, expected, "{name} {}", effect.name());
        rendered
    };
    let over = Antialias::Supersample(4);
    let facets = still("facets");
    let apart = draw(&facets, Drawer::Scanline, Effects::PLANNED, over).counters.expanded;
    assert!(apart > 100 && apart < 2000, "{apart}");
    check("facets", over, Effect::Samples, apart);
    check("facets", over, Effect::Texture, 0);
    check("panels", Antialias::None, Effect::Depth, 0);
    // The floor and two spheres: all that is not background.
    let rendered = check("everything", Antialias::None, Effect::Cull, 0);
    let background = rendered.picture.get(0, 0).unwrap();
    let drawn = rendered.picture.rows().flat_map(|(_, row)| row).filter(|c| **c != background);
    check("everything", Antialias::None, Effect::Texture, drawn.count() as u64);
    check("everything", Antialias::None, Effect::Specular, 0);
}
