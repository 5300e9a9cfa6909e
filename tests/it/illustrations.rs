//! Pictures that only the pages need: what one picture of a scene or a case alone does not show.

use glam::{DVec2, DVec3};
use image::{Rgb, RgbImage, imageops};
use rasterproof_core::contract::DrawLine as _;
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::line::dda::Dda;
use rasterproof_core::triangle::{Fragment, LineEnd, PixelPoint, ScreenLine};
use rasterproof_faults::planted::exact::ExactMutant;
use rasterproof_faults::published::book_final::BookFinal;
use rasterproof_faults::published::{Published as _, RealVertex};
use rasterproof_registry::engines::{Drawer, ExactEngine};
use rasterproof_render::effects::{Effect, Effects, Mode};
use rasterproof_render::pipeline::target::Antialias;
use rasterproof_render::pipeline::transform::frustum;
use rasterproof_render::scene::{shapes, textures};
use rasterproof_report::lettering::{self, Size};
use rasterproof_report::{frame_comparison, panels, picture};
use rasterproof_verify::cases::Case;
use rasterproof_verify::cases::unsnapped::FAMILIES;
use rasterproof_verify::comparison::Tally;
use rasterproof_verify::comparison::exact_coverage;

use crate::pages::{read, root};
use crate::scenes::{still, target_of};
use crate::snapshots::{check_picture, check_sheet, each};

const PAPER: Rgb<u8> = Rgb([250, 250, 247]);
const WIDTH: u32 = 480;
const HEIGHT: u32 = 360;

/// A picture under a line of text.
pub fn headed(head: &str, picture: &RgbImage) -> RgbImage {
    const STRIP: u32 = 16;
    let (width, height) = picture.dimensions();
    assert!(lettering::width(head, Size::Small) <= width, "{head}");
    let mut sheet = RgbImage::from_pixel(width, height + STRIP, PAPER);
    lettering::write(&mut sheet, (0, 1), head, Size::Small, Rgb([60, 60, 60]));
    imageops::replace(&mut sheet, picture, 0, STRIP.into());
    sheet
}

/// Pictures of one size side by side under their names, with a strip of paper between them.
fn beside(pictures: &[(&str, &RgbImage)]) -> RgbImage {
    let panels: Vec<_> = pictures.iter().map(|(head, picture)| headed(head, picture)).collect();
    let (width, height) = panels[0].dimensions();
    let gap = 8;
    let all = (width + gap) * panels.len() as u32 - gap;
    let mut sheet = RgbImage::from_pixel(all, height, PAPER);
    for (i, panel) in (0..).zip(&panels) {
        imageops::replace(&mut sheet, panel, i * i64::from(width + gap), 0);
    }
    sheet
}

fn larger(picture: &RgbImage, zoom: u32) -> RgbImage {
    let (width, height) = picture.dimensions();
    imageops::resize(picture, width * zoom, height * zoom, imageops::FilterType::Nearest)
}

fn rendered(name: &str, effects: Effects, antialias: Antialias) -> RgbImage {
    let mut target = target_of(WIDTH, HEIGHT, antialias);
    let drawn = Drawer::Scanline.render(&still(name), &effects, &mut target);
    picture::of_frame(&drawn.unwrap().picture)
}

/// A part of the homework's scene, where both triangles have an edge: one sample a pixel, four.
#[test]
fn picture_of_the_homework_smoothed() {
    let part = |antialias| {
        let whole = rendered("homework", Effects::PLANNED, antialias);
        larger(&imageops::crop_imm(&whole, 290, 90, 60, 45).to_image(), 8)
    };
    let [before, after] = [Antialias::None, Antialias::Supersample(2)].map(part);
    assert_ne!(before, after);
    let panels = [("one sample a pixel", &before), ("2 x 2 samples a pixel", &after)];
    check_picture("homework-smoothed", &beside(&panels));
}

/// A box by the order of its triangles alone, without its back faces, and with a depth test.
#[test]
fn picture_before_the_depth_test() {
    let no_depth = Effects::PLANNED.with(Effect::Depth, Mode::Never);
    let panels = [no_depth.with(Effect::Cull, Mode::Never), no_depth, Effects::PLANNED];
    let [order, culled, tested] = panels.map(|effects| rendered("cube", effects, Antialias::None));
    assert_ne!(order, culled, "back faces over front faces");
    assert_eq!(culled, tested, "of a convex body nothing else is hidden");
    let panels = [
        ("in the order of the triangles", &order),
        ("front faces alone", &culled),
        ("with a depth test", &tested),
    ];
    check_picture("before-depth", &beside(&panels));
    let no_order = rendered("everything", no_depth, Antialias::None);
    let whole = rendered("everything", Effects::PLANNED, Antialias::None);
    assert_ne!(no_order, whole);
    let panels = [("in the order of the triangles", &no_order), ("with a depth test", &whole)];
    check_picture("before-depth-everything", &beside(&panels));
}

/// Where samples are told apart, and what else each pixel pays for, an effect a picture.
#[test]
fn picture_of_what_is_paid_for() {
    let sheets = [("facets", Antialias::Supersample(4)), ("everything", Antialias::None)].map(
        |(name, antialias)| {
            let mut target = target_of(WIDTH, HEIGHT, antialias);
            let drawn =
                Drawer::Scanline.render_mapped(&still(name), &Effects::PLANNED, &mut target);
            let (rendered, map) = drawn.unwrap();
            let head = match antialias.samples() {
                1 => format!("{name}, one sample a pixel"),
                many => format!("{name}, {many} samples a pixel"),
            };
            frame_comparison::map_picture(&head, &rendered.picture, &map)
        },
    );
    check_picture("effects-map", &picture::stack(&sheets));
}

/// Each effect beyond the book in a scene that asks for it, with and without it.
#[test]
fn pictures_of_what_files_ask_for() {
    let scenes = [
        (Effect::Specular, "highlights"),
        (Effect::Reflection, "metal"),
        (Effect::PunctualLights, "lights"),
        (Effect::NormalMaps, "surfaces"),
        (Effect::Occlusion, "surfaces"),
        (Effect::Emission, "surfaces"),
        (Effect::Shadows, "shadows"),
        (Effect::MipMaps, "mip-maps"),
        (Effect::Anisotropy, "anisotropy"),
        (Effect::Fog, "fog"),
        (Effect::AlphaTest, "cut-outs"),
        (Effect::Blending, "panes"),
        (Effect::Layers, "layers"),
    ];
    let page = read(root().join("docs/asks.md"));
    each(scenes, |(effect, scene)| {
        let without = Effects::PLANNED.with(effect, Mode::Never);
        let [with, without] = [Effects::PLANNED, without].map(|effects| {
            let mut target = target_of(192, 144, Antialias::None);
            let drawn = Drawer::Scanline.render(&still(scene), &effects, &mut target);
            picture::of_frame(&drawn.unwrap().picture)
        });
        assert_ne!(with, without, "{scene}");
        let name = format!("asks-{}", effect.name());
        assert!(page.contains(&format!("snapshots/{name}.snap.png")), "{name}");
        check_picture(&name, &beside(&[("with", &with), ("without", &without)]));
    });
}

/// Corners off the lattice: what snapping first changes, and what floats without a filter get wrong.
#[test]
fn picture_off_the_lattice() {
    let family = FAMILIES.iter().find(|family| family.name == "f64-near-tie").unwrap();
    let faults = [ExactMutant::SnapsInside, ExactMutant::PlainF64].map(ExactEngine::Mutant);
    let engines = [faults[0], faults[1], ExactEngine::Scanline];
    let hits = |engine: ExactEngine, case: &Case| {
        exact_coverage(&engine, case.free_corners(), case.window).unwrap().0
    };
    let wrong = |engine: ExactEngine, case: &Case| {
        Tally::between(&hits(engine, case), &hits(ExactEngine::Oracle, case)).total()
    };
    // The case with the most wrong pixels among those that both get wrong.
    let worst = (0..1000)
        .map(|index| family.case(1, index))
        .max_by_key(|case| {
            let both = [0, 1].map(|i| wrong(engines[i], case));
            (both[0].min(both[1]), both[0] + both[1])
        })
        .unwrap();
    assert!([0, 1].iter().all(|&i| wrong(engines[i], &worst) > 0));
    assert_eq!(wrong(ExactEngine::Scanline, &worst), 0);
    let drawn = engines.map(|engine| hits(engine, &worst));
    let names = ["snapped first", "f64, no filter", "scanline-exact"];
    let named: Vec<_> = names.map(str::to_owned).into_iter().zip(drawn).collect();
    let target = hits(ExactEngine::Oracle, &worst);
    let title = "Corners off the lattice, nearly on the centres of pixels";
    check_sheet("off-the-lattice", &panels::of_case(title, &worst, &named, &target));
}

/// From (0, 0) to (3, 9): a pixel for each column leaves gaps, a pixel for each row does not.
#[test]
fn picture_of_the_broken_line() {
    let end = |x, y| LineEnd { pixel: PixelPoint::new(x, y), depth: 0.0, varying: 0.0 };
    let window = PixelRect::window(6, 12);
    let mut whole = Vec::new();
    let line = ScreenLine { ends: [end(1, 1), end(4, 10)] };
    Dda.draw(&line, window, |f| whole.push((f.x_px, f.y_px)));
    let broken: Vec<_> = (0..=3).map(|step| (1 + step, 1 + 3 * step)).collect();
    assert_eq!((broken.len(), whole.len()), (4, 10));
    let touch = |pixels: &[(i32, i32)]| {
        pixels.windows(2).all(|p| (p[1].0 - p[0].0).abs().max((p[1].1 - p[0].1).abs()) == 1)
    };
    assert!(touch(&whole) && !touch(&broken));
    let panel = |pixels: &[(i32, i32)]| {
        RgbImage::from_fn(6 * 16, 12 * 16, |x, y| {
            let pixel = ((x / 16) as i32, (y / 16) as i32);
            match (x % 16 == 15 || y % 16 == 15, pixels.contains(&pixel)) {
                (true, _) => Rgb([225, 225, 220]),
                (_, true) => Rgb([60, 90, 140]),
                _ => PAPER,
            }
        })
    };
    let panels = [("by columns", &panel(&broken)), ("by rows", &panel(&whole))];
    check_picture("broken-line", &beside(&panels));
}

/// A textured ball by the book's final triangle, front faces only. In a texture made for a model each
/// face is an island, and what lies beside it is not meant to be seen; here that is bright. Returns how
/// many fragments have coordinates beyond those of their corners.
pub fn ball(exercise: bool) -> (RgbImage, u32) {
    const SIDE: u32 = 96;
    let mesh = shapes::sphere(DVec3::new(0.0, 0.0, 4.0), 1.5, 14, 9);
    let projection = frustum(-0.6, 0.6, -0.6, 0.6, 1.0, 20.0).unwrap();
    let texture = textures::checkerboard();
    let mut picture = Frame::new(PixelRect::window(SIDE, SIDE), [18, 18, 24]);
    let mut beyond = 0;
    for corners in mesh.triangles.iter() {
        let triangle = corners.map(|corner| {
            let p = projection * mesh.positions[corner.position as usize].extend(1.0);
            let (x, y) = (p.x / p.w + 1.0, 1.0 - p.y / p.w);
            let position_px = DVec2::new(x, y) / 2.0 * f64::from(SIDE);
            RealVertex { position_px, depth: p.z / p.w, w: p.w, varying: corner.uv }
        });
        let [a, b, c] = triangle.map(|v| v.position_px);
        // With rows that run down, what faces the eye turns with a negative area.
        if (b - a).perp_dot(c - a) >= 0.0 {
            continue;
        }
        let uvs = triangle.map(|v| v.varying);
        let low = uvs[0].min(uvs[1]).min(uvs[2]) - 1e-9;
        let high = uvs[0].max(uvs[1]).max(uvs[2]) + 1e-9;
        BookFinal { exercise }
            .fragments(&triangle, picture.bounds(), &mut |f: Fragment<DVec2>| {
                let is_in = f.varying.cmpge(low).all() && f.varying.cmple(high).all();
                beyond += u32::from(!is_in);
                let beside = DVec3::new(1.0, 0.4, 0.2);
                let colour = if is_in { texture.at(f.varying) } else { beside };
                let bytes = (colour * 255.0).round().to_array().map(|c| c as u8);
                picture.span_mut(f.y_px, f.x_px, f.x_px + 1)[0] = bytes;
            })
            .unwrap();
    }
    let at = |x: u32, y: u32| Rgb(picture.row(y as i32)[x as usize]);
    (larger(&RgbImage::from_fn(SIDE, SIDE, at), 4), beyond)
}

/// The hairs of figure 11-3, before and after the exercise of section 11.4, which takes most away.
#[test]
fn picture_of_the_hairs() {
    let [(before, hairs), (after, left)] = [false, true].map(ball);
    assert!(hairs > left && left > 0, "{hairs} fragments beyond their corners, {left} after");
    println!("{hairs} fragments beyond their corners, {left} after the exercise");
    check_picture(
        "hairs",
        &beside(&[("as published", &before), ("with the exercise of 11.4", &after)]),
    );
}
