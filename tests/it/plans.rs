//! Plans that are written and read by the program: of which scene they are, what is wrong with them, and
//! how they are shown.

use std::fs;
use std::sync::Arc;

use glam::{DMat4, DVec3};
use rasterproof_registry::engines::Drawer;
use rasterproof_render::effects::plan::{Canvas, Pieces};
use rasterproof_render::effects::{Effect, Effects, Mode};
use rasterproof_render::pipeline::target::Antialias;
use rasterproof_render::scene::chapters::SCENES;
use rasterproof_render::scene::{Corner, Item, Material, Scene, shapes};
use serde_json::{Value, json};

use crate::pages::{Renewal, read};
use crate::program::{Folder, Run};
use crate::scenes::{as_they_come, still, target_of};

/// Two squares that are apart as long as they are seen from the front.
const SQUARES: &str = "v -1 -.5 0\nv -.2 -.5 0\nv -.2 .5 0\nv -1 .5 0\nv .2 -.5 -1.5\nv 1 -.5 -1\n\
                       v 1 .5 -1\nv .2 .5 -1.5\nf 1 2 3\nf 1 3 4\nf 5 6 7\nf 5 7 8\n";

/// As many triangles at other places.
const OTHERS: &str = "v -1 -.5 0\nv -.2 -.5 0\nv -.2 .5 0\nv -1 .5 0\nv -.6 -.5 -1.5\nv 1 -.5 -1\n\
                      v 1 .5 -1\nv -.6 .5 -1.5\nf 1 2 3\nf 1 3 4\nf 5 6 7\nf 5 7 8\n";

const FRONT: [&str; 4] = ["--yaw", "0", "--pitch", "0"];

fn folder(name: &str) -> Folder {
    let folder = Folder::new(&format!("plans-{name}"));
    fs::write(folder.join("squares.obj"), SQUARES).unwrap();
    fs::write(folder.join("others.obj"), OTHERS).unwrap();
    folder
}

/// The plan of a model, small and from the front unless the words say otherwise.
fn plan(folder: &Folder, words: &[&str]) -> Value {
    let words = [&["plan", "--json", "--rounds", "1", "--size", "160x120"], words].concat();
    let out = folder.run(&words[..]).has(0).out;
    serde_json::from_str::<Value>(&out).unwrap()["plan"].take()
}

fn render(folder: &Folder, plan: &Value, words: &[&str]) -> Run {
    fs::write(folder.join("plan.json"), plan.to_string()).unwrap();
    let words = [&["render", "--plan", "plan.json", "-o", "a.png", "--size", "160x120"], words];
    folder.run(words.concat())
}

fn with<'a>(model: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    [&[model], &FRONT[..], more].concat()
}

#[test]
fn a_plan_is_of_one_scene_seen_from_one_place() {
    let folder = folder("scene");
    let plan = plan(&folder, &with("squares.obj", &[]));
    render(&folder, &plan, &with("squares.obj", &[])).has(0).prints("AGREES");
    // So can the plan that a drawn picture comes with.
    let out = render(&folder, &plan, &with("squares.obj", &["--json"])).out;
    let drawn: Value = serde_json::from_str(&out).unwrap();
    render(&folder, &drawn, &with("squares.obj", &[])).has(0);
    fs::remove_file(folder.join("a.png")).unwrap();
    let seen = |words: &[&'static str]| [&["squares.obj"], words].concat();
    for (words, part) in [
        (seen(&["--yaw", "40", "--pitch", "0"]), "for the same one seen otherwise"),
        (seen(&["--yaw", "0", "--pitch", "1"]), "for the same one seen otherwise"),
        (with("squares.obj", &["--zoom", "1.5"]), "for the same one seen otherwise"),
        (with("squares.obj", &["--shading", "flat"]), "for another scene"),
        (with("squares.obj", &["--cull", "cw"]), "for another scene"),
        (with("others.obj", &[]), "for another scene"),
        (with("squares.obj", &["--aa", "ssaa2"]), "so that the antialiasing differs"),
        (with("squares.obj", &["--depth", "f32"]), "so that the depth format differs"),
    ] {
        let run = render(&folder, &plan, &words).has(2).without_output();
        run.says("plan.json: ").says(part);
        assert!(!folder.join("a.png").exists(), "{words:?}: something was drawn");
    }
}

#[test]
fn a_wrong_plan_never_agrees() {
    let folder = folder("wrong");
    let words = with("others.obj", &[]);
    let mut plan = plan(&folder, &words);
    render(&folder, &plan, &words).has(0);
    for run in plan["items"][0]["pieces"]["listed"].as_array_mut().unwrap() {
        run[1]["depth"] = json!(false);
    }
    for piece in ["--engine=both", "--engine=scanline"] {
        let Run { status, out, errors, .. } =
            render(&folder, &plan, &[&words[..], &[piece]].concat());
        assert!(!out.contains("AGREES") || out.contains("DISAGREES"), "{out}");
        // One engine draws what the plan says.
        assert_eq!(status, Some(i32::from(piece.ends_with("both"))), "{out}{errors}");
    }
    let json = render(&folder, &plan, &[&words[..], &["--json"]].concat()).json();
    assert_ne!(json["comparison"]["wrong_pixels"], json!(0), "{json}");
}

#[test]
fn what_is_wrong_with_a_plan_is_named() {
    let folder = folder("named");
    let words = with("squares.obj", &[]);
    let whole = plan(&folder, &words);
    let rule = as_they_come(&json!(["normal"]));
    type Edit<'a> = &'a dyn Fn(&mut Value);
    let with_rule = |edit: &dyn Fn(&mut Value)| {
        let mut plan = whole.clone();
        plan["items"][0]["pieces"] = rule.clone();
        edit(&mut plan);
        plan
    };
    // What is not followed is not needed.
    let plan = with_rule(&|plan| drop(plan.as_object_mut().unwrap().remove("decisions")));
    render(&folder, &plan, &words).has(0);
    let edits: [(Edit<'_>, &str); 8] = [
        (&|plan| plan["items"][0]["carries"] = json!([]), "item 0 interpolate normal"),
        (
            &|plan| plan["items"][0]["pieces"]["as-they-come"]["depth"] = json!("yes"),
            "items[0].pieces.as-they-come.depth: ",
        ),
        (
            &|plan| plan["items"][0]["pieces"]["as-they-come"]["depht"] = json!(true),
            "items[0].pieces.as-they-come.depht: ",
        ),
        (
            &|plan| {
                plan["items"][0]["pieces"]["as-they-come"].as_object_mut().unwrap().remove("depth");
            },
            "items[0].pieces.as-they-come: missing field `depth`",
        ),
        (&|plan| plan["scene"] = json!("a"), "scene: a digest of a scene"),
        (&|plan| plan["scene"] = json!(null), "does not say which scene it is for"),
        (&|plan| plan["version"] = json!(7), "the form of version 7"),
        (&|plan| drop(plan.as_object_mut().unwrap().remove("version")), "not name its version"),
    ];
    for (edit, part) in edits {
        let run = render(&folder, &with_rule(edit), &words).has(2).without_output().says(part);
        assert!(!run.errors.contains("column"), "{run}");
    }
    // Text of the file reaches the terminal printable.
    let plan = with_rule(&|plan| plan["\u{1b}[31m"] = json!(1));
    let errors = render(&folder, &plan, &words).has(2).errors;
    assert!(!errors.contains('\u{1b}'), "{errors:?}");
}

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

#[test]
fn a_plan_is_shown_in_80_columns_with_units() {
    let folder = folder("shown");
    for words in [&["panels"][..], &["facets", "--aa", "ssaa4"], &["squares.obj"]] {
        let all = [&["plan", "--rounds", "1", "--size", "160x120"], words].concat();
        let out = folder.run(&all[..]).has(0).out;
        let table = out.lines().skip_while(|line| !line.starts_with("effect ")).skip(1);
        let rows: Vec<&str> = table.take_while(|line| !line.starts_with("  open:")).collect();
        assert!(rows.len() >= 26, "{out}");
        for line in &rows {
            assert!(line.chars().count() <= 80, "{line}");
        }
        let units = ["triangles", "pieces", "pixels", "samples"];
        for row in rows.iter().filter(|row| !row.starts_with("    ")) {
            assert!(units.iter().any(|unit| row.ends_with(unit)), "{row}");
        }
    }
    let words = ["plan", "squares.obj", "--rounds", "1", "--size", "80x60", "--shading", "gouraud"];
    folder.run(&words[..]).prints("Gouraud: the light is in the colours of the corners");
}

/// A piece of one colour has one stage between cover and write.
#[test]
fn stages_are_shown_in_80_columns() {
    let folder = folder("stages");
    for scene in ["panels", "everything", "layers"] {
        let mut command = folder.command(["plan", scene, "--show", "stages", "--size", "160x120"]);
        let out = Run::of(command.env("COLUMNS", "80")).has(0).out;
        assert!(out.contains("cover, "), "{out}");
        assert!(out.lines().all(|line| line.chars().count() <= 80), "{out}");
    }
    folder.run(["plan", "panels", "--show", "stages"]).prints("cover, one colour, write");
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

/// The file of a user is no scene of the book, whatever it is called, and the data repeat the words of the text.
#[test]
fn text_and_data_of_a_plan_say_the_same_of_a_model() {
    let folder = folder("words");
    fs::copy(folder.join("squares.obj"), folder.join("cube.obj")).unwrap();
    let words = ["plan", "cube.obj", "--whole", "--rounds", "1", "--size", "160x120"];
    let page = folder.run([&words[..], &["--report", "--out", "."]].concat()).has(0);
    let html = fs::read_to_string(folder.join("plan.html")).unwrap();
    assert!(html.contains("What the model cube calls for"), "{html:.300}");
    assert!(!page.out.contains("the scene cube"), "{}", page.out);
    let of_scene = ["plan", "panels", "--whole", "--rounds", "1", "--report", "--out", "."];
    folder.run(&of_scene[..]).has(0);
    let html = fs::read_to_string(folder.join("plan.html")).unwrap();
    assert!(html.contains("What the scene panels calls for"), "{html:.300}");
    let json = folder.run([&words[..], &["--json"]].concat()).has(0).json();
    assert_eq!(json["outcome"], "AGREES");
    assert!(page.out.contains("\nAGREES: Planned, it was drawn "), "{}", page.out);
    let sentence = json["sentence"].as_str().unwrap();
    assert!(sentence.starts_with("Planned, it was drawn "), "{sentence}");
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
