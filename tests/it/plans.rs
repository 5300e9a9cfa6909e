//! What plans leave out and list, and the table of effects on their page. Files of plans are in `tests/transcripts/plans.md`.

use std::sync::Arc;

use glam::{DMat4, DVec3};
use rasterproof_registry::engines::Drawer;
use rasterproof_render::effects::plan::{Canvas, Pieces};
use rasterproof_render::effects::{Effect, Effects, Mode};
use rasterproof_render::pipeline::target::Antialias;
use rasterproof_render::scene::chapters::SCENES;
use rasterproof_render::scene::{Corner, Item, Material, Scene, shapes};

use crate::pages::{Renewal, read};
use crate::scenes::{still, target_of};

/// A triangle in the window, and one that lies outside a plane altogether.
fn one_inside_one_outside() -> Scene {
    let triangle = |x: f64| {
        let corners = [DVec3::ZERO, DVec3::X * 0.5, DVec3::Y * 0.5].map(|p| p + DVec3::X * x);
        Item::new(shapes::triangle(corners, [DVec3::ONE; 3]), Material::default())
    };
    let mut scene = Scene::new("outside", "", DMat4::IDENTITY);
    scene.items = vec![triangle(-0.2), triangle(5.0)];
    // In front of the near plane, where its picture would lie in the window.
    let mut near = triangle(-0.9);
    near.model = DMat4::from_translation(DVec3::Z * -3.0);
    scene.items.push(near);
    scene
}

#[test]
fn what_is_not_called_for_can_be_switched_off() {
    let scene = one_inside_one_outside();
    for drawer in Drawer::ALL {
        let draw = |effects: &Effects| {
            drawer.render(&scene, effects, &mut target_of(80, 60, Antialias::None)).unwrap()
        };
        let planned = draw(&Effects::PLANNED);
        let clip = planned.plan.decisions.iter().find(|d| d.effect == Effect::Clip).unwrap();
        assert_eq!((clip.on, clip.off, clip.open), (0, 1, 0), "{clip:?}");
        assert!(clip.reason.ends_with("2 more are rejected, outside one plane altogether"));
        let off = draw(&Effects::PLANNED.with(Effect::Clip, Mode::Never));
        assert!(off.picture == planned.picture, "{}", drawer.name());
        assert_eq!((off.counters.rejected, off.counters.clipped), (2, 0));
    }
}

#[test]
fn reasons_and_counts_say_the_same() {
    for (entry, antialias) in
        SCENES.iter().flat_map(|entry| [(entry, Antialias::None), (entry, Antialias::Multisample4)])
    {
        let (scene, canvas) = (still(entry.name), Canvas::of(&target_of(160, 120, antialias)));
        let plan = Drawer::EdgeFunction.plan(&scene, &Effects::PLANNED, &canvas);
        for d in plan.unwrap().decisions.into_iter().filter(|d| d.item.is_some()) {
            let agrees = match d.reason.split(' ').next().unwrap() {
                "every" => d.on > 0 && d.off == 0,
                "some" => d.on > 0 && d.off > 0,
                "no" => d.on == 0,
                _ => true,
            };
            assert!(agrees, "{}: {d:?}", scene.name);
            let is_counted = d.reason.starts_with(|first: char| first.is_ascii_digit());
            assert!(!is_counted || d.effect == Effect::WideWords, "{}: {d:?}", scene.name);
        }
    }
}

/// Pieces are listed where it may pay: where triangles are few, or where the first of some item are apart.
#[test]
fn what_overlaps_at_first_sight_is_not_listed() {
    let squares = |x: f64, step: f64, count: u32| {
        let mut mesh = rasterproof_render::scene::Mesh::default();
        for i in 0..count {
            let (i, j) = (f64::from(i % 20) * step, f64::from(i / 20) * step);
            let at = DVec3::new(x - 0.95 + 0.08 * i, -0.95 + 0.08 * j, 0.0);
            let corner = |dx: f64, dy: f64| at + DVec3::new(dx, dy, 0.0);
            let quad = [corner(0.0, 0.0), corner(0.06, 0.0), corner(0.06, 0.06), corner(0.0, 0.06)];
            let quad = shapes::quad(quad);
            let first = mesh.positions.len() as u32;
            Arc::make_mut(&mut mesh.positions).extend_from_slice(&quad.positions);
            mesh.triangles.extend(quad.triangles.iter().map(|triangle| {
                triangle.map(|corner| Corner { position: corner.position + first, ..corner })
            }));
        }
        Item::new(mesh, Material::default())
    };
    let is_listed = |items: Vec<Item>| {
        let mut scene = Scene::new("squares", "", DMat4::IDENTITY);
        scene.items = items;
        let canvas = Canvas::of(&target_of(400, 400, Antialias::None));
        let plan = Drawer::Scanline.plan(&scene, &Effects::PLANNED, &canvas).unwrap();
        plan.items.iter().all(|item| matches!(item.pieces, Pieces::Listed(_)))
    };
    assert!(is_listed(vec![squares(0.0, 1.0, 300)]));
    assert!(!is_listed(vec![squares(0.0, 0.5, 300)]));
    assert!(is_listed(vec![squares(0.0, 0.5, 128)]), "256 triangles");
    assert!(!is_listed(vec![squares(0.0, 0.5, 100), squares(0.5, 0.5, 100)]));
    // One square alone may be apart.
    assert!(is_listed(vec![squares(0.0, 0.5, 300), squares(1.8, 1.0, 1)]));
}

/// The table on the page of effects has a row for each, in the order of the pipeline. When a usual renderer pays for it and by how
/// little its condition can be violated are those of the program. `RASTERPROOF_RENEW=1 cargo test --test it effects_table` writes them.
#[test]
fn effects_table_is_that_of_the_conditions() {
    let kept = read("snapshots/counterexamples.snap");
    let powers = |effect: Effect| {
        let begins = [":", " "].map(|end| effect.name().to_owned() + end);
        let lines = kept.lines().filter(|line| begins.iter().any(|begin| line.starts_with(begin)));
        let mut powers: Vec<_> =
            lines.flat_map(|line| line.split(' ').find(|word| word.starts_with("2^"))).collect();
        powers.dedup();
        powers.join(", ")
    };
    let mut renewal = Renewal::default();
    for (path, words) in [
        ("docs/effects.md", ["where called for", "where the material asks", "everywhere"]),
        ("docs/zh/effects.md", ["需要之处", "材质要求之处", "一律"]),
    ] {
        let (mut named, mut lines) = (Vec::new(), Vec::new());
        for line in read(path).lines() {
            let name = line.strip_prefix("| `").and_then(|rest| rest.split('`').next());
            let Some(effect) =
                name.and_then(|name| Effect::ALL.into_iter().find(|effect| effect.name() == name))
            else {
                lines.push(line.to_owned());
                continue;
            };
            let cells: Vec<_> = line.split(" | ").collect();
            let [what, condition, knowing, _, violation] = cells[..] else {
                panic!("{path}: {line}")
            };
            let usual = match Effects::USUAL.mode(effect) {
                Mode::Planned => words[0],
                Mode::Material => words[1],
                Mode::Always | Mode::Never => words[2],
            };
            let (_, violation) = violation.split_once(": ").unwrap();
            let powers = powers(effect);
            lines.push(
                [what, condition, knowing, usual, &format!("{powers}: {violation}")].join(" | "),
            );
            named.push(effect);
        }
        assert_eq!(named, Effect::ALL, "{path}");
        renewal.is(path, &(lines.join("\n") + "\n"));
    }
    renewal.check("effects_table");
}
