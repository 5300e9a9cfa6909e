//! Models that the program draws, and files whose names and places are made here. What readers make of a file is in `model_cases`.

use std::fs;
use std::path::Path;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use glam::{DVec2, DVec3};
use image::{Rgb, RgbImage};
use rasterproof_core::random::Rng;
use rasterproof_models::{BadFile, LoadOptions, Model, load_texture};
use rasterproof_render::scene::{Shading, shapes};

use crate::model_cases::FOLDER;
use crate::program::Folder;

pub fn load(path: &Path, shading: Shading) -> Result<Model, BadFile> {
    rasterproof_models::load(path, LoadOptions { shading, ..LoadOptions::default() })
}

/// The model of this text.
fn read(folder: &Folder, text: &str, shading: Shading) -> Model {
    load(&folder.put("m.obj", text), shading).unwrap()
}

/// The one warning of a model.
#[track_caller]
pub fn warning(model: &Model) -> &str {
    let [warning] = &model.warnings[..] else { panic!("{:?}", model.warnings) };
    warning
}

#[test]
fn files_that_cannot_be_read_are_named() {
    let folder = Folder::new("models-unread");
    let cause = |path: &Path| load(path, Shading::Phong).unwrap_err().cause;
    assert!(cause(&folder).contains("directory"), "{}", cause(&folder));
    let missing = folder.join("none.obj");
    assert!(cause(&missing).contains("cannot be read"), "{}", cause(&missing));
}

#[test]
fn broken_textures_are_named() {
    let folder = Folder::new("models-textures");
    let picture = folder.join("a.png");
    RgbImage::from_fn(64, 64, |x, y| Rgb([x as u8, y as u8, 7])).save(&picture).unwrap();
    let bytes = fs::read(&picture).unwrap();
    assert!(load_texture(&picture).is_ok());
    for length in [0, 1, 8, 20, bytes.len() / 2, bytes.len() - 20] {
        fs::write(&picture, &bytes[..length]).unwrap();
        let error = load_texture(&picture).expect_err("a truncated picture is read");
        assert!(error.to_string().contains("a.png"), "{error}");
    }
}

/// The picture that the program draws of a model, and what it says on standard error.
fn drawn(folder: &Folder, words: &str) -> (RgbImage, String) {
    let words = format!("render --size 96x72 --engine scanline -o out.png {words}");
    let errors = folder.check(words, 0).errors;
    (image::open(folder.join("out.png")).unwrap().into_rgb8(), errors)
}

#[test]
fn textures_are_found_and_decoded_or_a_warning() {
    let folder = Folder::new("models-find");
    fs::create_dir(folder.join("Maps")).unwrap();
    let picture = RgbImage::from_fn(2, 1, |x, _| Rgb([255 - x as u8 * 255, 0, x as u8 * 255]));
    for name in ["Maps/Bare Name.tga", "b.TIFF", "c.webp", "it's \"d\".png"] {
        picture.save(folder.join(name)).unwrap();
    }
    folder.put("broken.png", b"no picture");
    let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt .25 .5\nusemtl a\nf 1/1 2/1 3/1\n";
    let read = |line: &str| {
        folder.put("m.mtl", format!("newmtl a\nKd 0 1 0\n{line}\n"));
        read(&folder, &format!("mtllib m.mtl\n{triangle}"), Shading::Unlit)
    };
    for name in [
        "Maps/Bare Name.tga",
        "maps\\bare name.TGA",
        "\"Maps/Bare Name.tga\"",
        "-s 1 1 1 -mm 0 1 Maps/Bare Name.tga",
        "b.tiff",
        "C:\\Users\\someone\\B.tiff",
        "/nowhere/on/this/machine/c.webp",
        "it's \"d\".png",
    ] {
        let model = read(&format!("map_Kd {name}"));
        assert_eq!((&model.warnings[..], model.not_drawn.as_str()), (&[][..], ""), "{name}");
        let item = &model.items[0];
        let texture = item.material.texture.as_ref().unwrap_or_else(|| panic!("{name}"));
        let colour = texture.at(item.mesh.triangles.at(0)[0].uv);
        assert_eq!(colour.to_array(), [1.0, 0.0, 0.0], "{name}");
    }
    for name in ["nowhere.png", "broken.png", "d\u{1b}[31m.png"] {
        let model = read(&format!("map_Kd {name}"));
        let warning = warning(&model);
        for part in [".png: ", "material 'a' is drawn in its colour"] {
            assert!(warning.contains(part), "{warning:?}");
        }
        assert!(!warning.contains('\u{1b}'), "{warning:?}");
        let material = &model.items[0].material;
        assert!(material.texture.is_none() && material.colour == DVec3::Y, "{name}");
    }
    // Options are applied, or named as not drawn.
    let moved = read("map_Kd -s 2 1 -o 0.25 0 -clamp on c.webp");
    let item = &moved.items[0];
    assert_eq!(item.mesh.triangles.at(0)[0].uv.to_array(), [0.75, 0.5]);
    let texture = item.material.texture.as_ref().unwrap();
    assert_eq!(texture.at(DVec2::new(1.5, 0.5)).to_array(), [0.0, 0.0, 1.0]);
    let option = read("map_Kd -mm 0.5 2 -blendu off c.webp");
    assert_eq!(option.not_drawn, "option -blendu of 1 texture, option -mm of 1 texture");
}

/// A name with a space before or after it is the name of a file with one or without.
#[test]
fn names_of_pictures_of_a_gltf_are_found() {
    let folder = Folder::new("models-names");
    let picture = fs::read(format!("{FOLDER}/gltf/plain.png")).unwrap();
    for name in [" before.png", "after.png ", "plain.png"] {
        folder.put(name, &picture);
    }
    let text = fs::read_to_string(format!("{FOLDER}/gltf/nulls.gltf")).unwrap();
    let inside = format!(" data:image/png;base64,{} ", STANDARD.encode(picture));
    for uri in [
        "plain.png?v=3",
        "Plain.PNG#a",
        "./plain%2Epng",
        " before.png",
        "%20before.png",
        "after.png ",
        "after.png%20",
        " plain.png ",
        "plain.png",
        &inside,
    ] {
        let named = text.replace("file:///nowhere/plain.png", uri);
        let model = load(&folder.put("m.gltf", named), Shading::Phong).unwrap();
        assert!(model.items[0].material.texture.is_some(), "{uri:?}: {:?}", model.warnings);
    }
}

/// The same quad with its front and with its back to the eye.
#[test]
fn a_double_sided_material_is_lit_on_either_side() {
    let folder = Folder::new("models-double-sided");
    let files = [
        ("front.gltf", include_str!("../data/models/double-sided-front.gltf")),
        ("back.gltf", include_str!("../data/models/double-sided-back.gltf")),
    ];
    let [front, back] = files.map(|(name, text)| {
        folder.put(name, text);
        let (picture, said) = drawn(&folder, name);
        assert!(!said.contains("backs") && !said.contains("not drawn"), "{said}");
        picture
    });
    assert!(front == back);
    let lit = front.pixels().filter(|pixel| pixel.0[0] > 100).count();
    assert!(lit > 500, "{lit} pixels are bright");
}

/// A square with a picture of a clear and an opaque column many times beside each other: its opacity is read at the level of its
/// colour, where it is a half everywhere; without a mip map each pixel is either.
#[test]
fn holes_have_the_level_of_their_colours() {
    let folder = Folder::new("models-holes");
    let text = include_str!("../data/drawn/holes.gltf");
    let columns =
        image::RgbaImage::from_fn(2, 2, |x, _| image::Rgba([255, 255, 255, 255 * x as u8]));
    columns.save(folder.join("columns.png")).unwrap();
    let share = |sampler: u32, cutoff: f64, words: &str| {
        let text = text.replace("SAMPLER", &sampler.to_string());
        folder.put("holes.gltf", text.replace("CUTOFF", &cutoff.to_string()));
        let (picture, _) = drawn(&folder, &format!("holes.gltf {words}"));
        let seen = picture.pixels().filter(|pixel| pixel.0[0] > 100).count();
        folder.check("render holes.gltf --size 96x72 -o out.png", 0).prints("AGREES");
        seen
    };
    let all = share(9987, 0.0, "");
    assert!(all > 500, "{all}");
    for words in ["", "--effects all", "--effects usual"] {
        assert_eq!([0.4, 0.6].map(|cutoff| share(9987, cutoff, words)), [all, 0], "{words}");
        let some = share(9729, 0.6, words);
        assert!(some > all / 4 && some < 3 * all / 4, "{some} of {all}");
    }
}

/// A square of one unit in the light of its file, computed by hand in its middle; others of its lights reach it nowhere.
#[test]
fn lights_of_a_file_are_those_of_the_picture() {
    let folder = Folder::new("models-lights");
    let drawn = |name: &str| {
        fs::copy(format!("{FOLDER}/gltf/light-{name}.gltf"), folder.join("m.gltf")).unwrap();
        drawn(&folder, "m.gltf --camera 1")
    };
    for (name, arriving) in [
        ("directional", 0.25),
        ("directional-from-behind", 0.0),
        ("point", 0.5),
        ("point-behind", 0.0),
        // (2 / 4)^4 is a sixteenth.
        ("point-of-range-4", 0.5 * 15.0 / 16.0),
        ("point-of-range-1.5", 0.0),
        ("spot", 0.5),
        ("spot-elsewhere", 0.0),
    ] {
        let (picture, said) = drawn(name);
        assert!(said.contains("the light is that of 1 light of the file; ambient"), "{said}");
        assert!(!said.contains("not drawn"), "{said}");
        let linear: f64 = 0.25 + arriving;
        let expected = 255.0 * (1.055 * linear.powf(1.0 / 2.4) - 0.055);
        let [r, g, b] = picture.get_pixel(48, 36).0;
        // A pixel lies beside the middle.
        let is_right = (f64::from(r) - expected).abs() < 1.0 && r == g && g == b;
        assert!(is_right, "{name}: {r}, {expected}");
    }
    // Colours have red first, and other surfaces are lit by the view.
    let (picture, _) = drawn("red");
    let [r, g, b] = picture.get_pixel(48, 36).0;
    assert!(r > g && g == b, "{r} {g} {b}");
    let run = folder.check("render m.gltf --size 32x24 --shadows 64 -o o.png", 0);
    run.prints("AGREES").shows("1 light of the file, and nothing keeps it from anything;");
    let run = folder.check("render m.gltf --size 32x24 --shading gouraud -o o.png", 0);
    run.shows("light of the file, without metal and roughness, of 1 primitive");
    for name in ["unknown", "bad-colour", "number"] {
        drawn(name);
        folder.check("render m.gltf --size 32x24 -o o.png", 0).shows("not drawn: 1 light");
    }
}

/// Two repeats of a texture that is mirrored: symmetric about the middle.
#[test]
fn a_mirrored_texture_is_drawn_mirrored() {
    let folder = Folder::new("models-mirrored");
    folder.put("m.gltf", include_str!("../data/models/mirrored-repeat.gltf"));
    let (picture, said) = drawn(&folder, "m.gltf --yaw 0 --pitch 0 --shading unlit");
    assert!(!said.contains("not drawn"), "{said}");
    let (width, height) = picture.dimensions();
    let mirrored = |x: u32, y: u32| {
        picture.get_pixel(x, y) == picture.get_pixel(width - 1 - x, y)
            && picture.get_pixel(x, y) == picture.get_pixel(x, height - 1 - y)
    };
    let differ = (0..width).flat_map(|x| (0..height).map(move |y| (x, y)));
    assert_eq!(differ.filter(|&(x, y)| !mirrored(x, y)).count(), 0);
    let colours: std::collections::HashSet<_> = picture.pixels().collect();
    assert!(colours.len() > 2, "{colours:?}");
}

/// A second opinion: `tobj` reads the same triangles of a file of triangles, in doubles here and in single
/// precision there.
#[test]
fn another_reader_reads_the_same() {
    let folder = Folder::new("models-second");
    let centre = DVec3::new(0.5, -2.0, 3.0);
    let mesh = shapes::sphere(centre, 1.5, 24, 12);
    let mut text = String::new();
    for p in mesh.positions.iter() {
        let n = *p - centre;
        text +=
            &format!("v {} {} {}\nvn {} {} {}\nvt {} {}\n", p.x, p.y, p.z, n.x, n.y, n.z, p.x, p.y);
    }
    for (number, t) in mesh.triangles.iter().enumerate() {
        let [a, b, c] = t.map(|corner| corner.position + 1);
        if number % 50 == 0 {
            text += &format!("g part{number}\n");
        }
        text += &format!("f {a}/{b}/{c} {c}/{a}/{b} {b}/{c}/{a}\n");
    }
    let model = read(&folder, &text, Shading::Phong);
    let options = tobj::LoadOptions::default();
    let materials = |_: &Path| Err(tobj::LoadError::OpenFileFailed);
    let (others, _) = tobj::load_obj_buf(&mut text.as_bytes(), &options, materials).unwrap();
    assert_eq!(model.items.len(), others.len());
    for (item, other) in model.items.iter().zip(&others) {
        let corners: Vec<_> = item.mesh.triangles.corners().collect();
        let other = &other.mesh;
        assert_eq!(corners.len(), other.indices.len());
        for (at, corner) in corners.iter().enumerate() {
            let three = |list: &[f32], index: u32| {
                let v = &list[3 * index as usize..][..3];
                DVec3::new(v[0].into(), v[1].into(), -f64::from(v[2]))
            };
            let position = item.mesh.positions[corner.position as usize];
            assert!(position.distance(three(&other.positions, other.indices[at])) < 1e-6);
            let normal = three(&other.normals, other.normal_indices[at]).normalize();
            assert!(corner.normal.distance(normal) < 1e-6);
            let uv = &other.texcoords[2 * other.texcoord_indices[at] as usize..][..2];
            assert!(corner.uv.distance(DVec2::new(uv[0].into(), uv[1].into())) < 1e-6);
        }
    }
}

/// Polygons in space that do not lie in a plane: all of their outline is the outline of their triangles.
#[test]
fn folded_polygons_keep_their_triangles() {
    let folder = Folder::new("models-folded");
    let square = "v -5 0 5\nv 5 0 5\nv 5 0 -5\nv -5 0 -5\n";
    // The area of what a polygon with these further corners becomes.
    let check = |more: &str| {
        let count = 4 + more.lines().count() as u32;
        let corners: String = (1..=count).map(|corner| format!(" {corner}")).collect();
        let model = read(&folder, &format!("{square}{more}f{corners}\n"), Shading::Flat);
        let mesh = &model.items[0].mesh;
        let triangles = mesh.triangles.positions();
        assert_eq!(triangles.len() as u32, count - 2, "{more}");
        for corner in 0..count {
            let edge = (corner, (corner + 1) % count);
            let has = |[a, b, c]: &&[u32; 3]| [(*a, *b), (*b, *c), (*c, *a)].contains(&edge);
            assert_eq!(triangles.iter().filter(has).count(), 1, "{more}: {edge:?} {triangles:?}");
        }
        let area = |corners: &[u32; 3]| {
            let [a, b, c] = corners.map(|corner| mesh.positions[corner as usize]);
            (b - a).cross(c - a).length() / 2.0
        };
        (triangles.iter().map(area).sum::<f64>(), model.warnings.join("\n"))
    };
    // Above or below the edge before it: seen along the normal it lies on that edge.
    let fan =
        "m.obj:6: the face is not planar, so it is drawn as triangles around its first corner";
    for more in ["v 0 5 -5\n", "v 0 -5 -5\n"] {
        let (area, said) = check(more);
        assert!((area - 100.0 - 25.0 * 2f64.sqrt()).abs() < 1e-9, "{more}: {area}");
        assert!(said.contains(fan), "{more}: {said}");
    }
    // Each corner at another place outside the plane of the square.
    let mut rng = Rng::new("folded polygons", 0, 0);
    for case in 0..2_000 {
        let mut more = String::new();
        for corner in 1..2 + case % 4 {
            let [x, z, sign] = [rng.int(-2, 2), rng.int(-2, 2), rng.int(0, 1)];
            more += &format!("v {} {} {}\n", 5 * x, (1 - 2 * sign) * corner, 5 * z);
        }
        check(&more);
    }
    // Seen along its normal nothing lies over anything else.
    let (area, said) = check("v -7 3 0\n");
    assert!(area > 100.0 && said.is_empty(), "{area}: {said}");
    // A corner on an edge in the plane loses nothing, whatever rounding did to the plane.
    let text = "v 0 0 0\nv 4 0 1.333333\nv 4 4 0\nv 2 0 .666667\nv 0 4 -1.333333\nf 1 2 3 4 5\n";
    let model = read(&folder, text, Shading::Flat);
    assert!(model.warnings.is_empty(), "{:?}", model.warnings);
}

/// The linear light of a channel in [0, 1] that is encoded as sRGB, and the reverse.
fn decoded(channel: f64) -> f64 {
    if channel <= 0.04045 { channel / 12.92 } else { ((channel + 0.055) / 1.055).powf(2.4) }
}

fn encoded(light: f64) -> f64 {
    if light <= 0.003_130_8 { light * 12.92 } else { 1.055 * light.powf(1.0 / 2.4) - 0.055 }
}

/// Whether a byte is what a light comes to that may be this much off.
fn is_byte_of(byte: u8, light: f64, off: f64) -> bool {
    let [least, most] =
        [light - off, light + off].map(|light| encoded(light.clamp(0.0, 1.0)) * 255.0);
    (least - 0.501..=most + 0.501).contains(&f64::from(byte))
}

/// A picture of 5 x 3 texels on 56 x 42 pixels, and colours of corners in its place: each pixel has the mean of amounts of
/// light, whatever the shading is. The coordinates of a texel are rounded to 1/256, so each mean may be off by half of that.
#[test]
fn what_is_unlit_is_filtered_and_interpolated_in_linear_light() {
    let folder = Folder::new("models-unlit");
    let text = include_str!("../data/models/unlit.gltf");
    let document: serde_json::Value = serde_json::from_str(text).unwrap();
    let uri = document["images"][0]["uri"].as_str().unwrap();
    let png = STANDARD.decode(uri.rsplit(',').next().unwrap()).unwrap();
    let texels = image::load_from_memory(&png).unwrap().into_rgb8();
    let factor = [0.5, 0.3, 0.9];
    let picture = |words: &str| {
        folder.check(format!("render m.gltf --camera 1 --size 64x48 -o out.png {words}"), 0);
        image::open(folder.join("out.png")).unwrap().into_rgb8()
    };
    folder.put("m.gltf", text);
    for words in ["", "--shading flat", "--shading gouraud", "--effects all"] {
        let drawn = picture(words);
        for (x, y) in (3..45).flat_map(|y| (4..60).map(move |x| (x, y))) {
            // From the centre of the first texel; what lies beyond is on the other side of the picture.
            let u = (f64::from(x) + 0.5 - 4.0) / 56.0 * 5.0 - 0.5;
            let v = (f64::from(y) + 0.5 - 3.0) / 42.0 * 3.0 - 0.5;
            for channel in 0..3 {
                let texel = |du: i32, dv: i32| {
                    let x = (u.floor() as i32 + du).rem_euclid(5) as u32;
                    let y = (v.floor() as i32 + dv).rem_euclid(3) as u32;
                    decoded(f64::from(texels[(x, y)][channel]) / 255.0) * factor[channel]
                };
                let [a, b, c, d] = [texel(0, 0), texel(1, 0), texel(0, 1), texel(1, 1)];
                let (right, down) = (u - u.floor(), v - v.floor());
                let mean = (a * (1.0 - right) + b * right) * (1.0 - down)
                    + (c * (1.0 - right) + d * right) * down;
                let steep = (b - a).abs().max((d - c).abs()) + (c - a).abs().max((d - b).abs());
                let byte = drawn[(x, y)][channel];
                assert!(is_byte_of(byte, mean, steep / 512.0), "{words} {x},{y}: {byte}, {mean}");
            }
        }
    }
    // White and black corners: between them, the light of a pixel grows by a 56th of all from column to column.
    folder.put("m.gltf", include_str!("../data/drawn/coloured.gltf"));
    for words in ["", "--shading gouraud"] {
        let drawn = picture(words);
        for (x, y) in (3..45).flat_map(|y| (4..60).map(move |x| (x, y))) {
            let light = (f64::from(x) + 0.5 - 4.0) / 56.0;
            for channel in 0..3 {
                let byte = drawn[(x, y)][channel];
                assert!(is_byte_of(byte, light * factor[channel], 0.0), "{words} {x},{y}: {byte}");
            }
        }
    }
}
