//! The scenes, through the whole pipeline: both rasterizers draw the same pictures, a plan of effects
//! changes no bit, and what is left out where it is called for shows.

use rasterproof::effects::render::Rendered;
use rasterproof::effects::{Effect, Effects, Mode};
use rasterproof::lineup::Drawer;
use rasterproof::pipeline::depth::DepthFormat;
use rasterproof::pipeline::target::{Antialias, Target};
use rasterproof::report::frames;
use rasterproof::scene::Scene;
use rasterproof::scene::chapters::{SCENES, scene};

const SMOOTHINGS: [Antialias; 4] = [
    Antialias::None,
    Antialias::Multisample4,
    Antialias::Supersample(2),
    Antialias::Supersample(4),
];

/// What a target holds before a frame must not show: it is filled with this first.
const LAST_FRAME: [u8; 4] = [255, 0, 255, 255];

fn target(antialias: Antialias) -> Target {
    let mut target = Target::new(80, 60, antialias, DepthFormat::Unorm32).unwrap();
    target.clear_colour(LAST_FRAME, &mut Default::default());
    for plane in &mut target.planes {
        plane.depth.fill(0);
    }
    target
}

fn draw(scene: &Scene, drawer: Drawer, effects: Effects, antialias: Antialias) -> Rendered {
    drawer.render(scene, &effects, &mut target(antialias)).unwrap()
}

fn scenes() -> impl Iterator<Item = Scene> {
    [0.0, 0.37].into_iter().flat_map(|turn| {
        SCENES.iter().map(move |entry| scene(entry.name, 4.0 / 3.0, turn).unwrap())
    })
}

#[test]
fn scenes_are_the_same_by_both_rasterizers() {
    for scene in scenes() {
        for antialias in SMOOTHINGS {
            let mut targets = [target(antialias), target(antialias)];
            let [a, b] = &mut targets;
            let first = Drawer::Scanline.render(&scene, &Effects::ALWAYS, a).unwrap();
            let second = Drawer::EdgeFunction.render(&scene, &Effects::ALWAYS, b).unwrap();
            let comparison = frames::compare((&first.picture, a), (&second.picture, b));
            assert!(comparison.agrees(), "{} {antialias:?}: {comparison:?}", scene.name);
            assert!(comparison.depths >= 4800);
            assert_eq!(first.counters, second.counters, "{} {antialias:?}", scene.name);
        }
    }
}

#[test]
fn plans_change_no_bit() {
    for scene in scenes() {
        for drawer in Drawer::ALL {
            for antialias in SMOOTHINGS {
                let whole = draw(&scene, drawer, Effects::ALWAYS, antialias).picture;
                let check = |effects: Effects, what: &str| {
                    let planned = draw(&scene, drawer, effects, antialias).picture;
                    let name = drawer.name();
                    assert!(planned == whole, "{} {name} {antialias:?} {what}", scene.name);
                };
                check(Effects::PLANNED, "planned");
                if antialias != Antialias::Supersample(4) {
                    for effect in Effect::ALL {
                        let name = effect.name();
                        check(Effects::ALWAYS.with(effect, Mode::Planned), name);
                        check(Effects::PLANNED.with(effect, Mode::Always), name);
                    }
                }
            }
        }
    }
}
