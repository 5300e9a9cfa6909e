//! `rasterproof render`: a scene or a model to a picture, by either rasterizer or by both.

use std::fmt::Write as _;
use std::num::NonZeroU32;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use glam::{DMat4, DVec3};
use image::codecs::gif::{GifEncoder, Repeat};
use rasterproof_host::text::{printable, printable_path};
use rasterproof_host::{input, limits};

use super::files::{Use, distinct};
use super::page::{PageArguments, as_file, write_page};
use super::plan_table::plan_rows;
use super::progress::Progress;
use super::typed::Typed;
use super::{Failure, Status, Streams, exit, program, usage};
use rasterproof_core::angle::{atan, cos, sin, tan, turn_y};
use rasterproof_core::frame::Frame;
use rasterproof_models::{Model, Normals, Options, Origin, Up};
use rasterproof_registry::engines::{Drawer, Engine};
use rasterproof_registry::undecided::{self, Drawn as DrawnBy};
use rasterproof_render::effects::depth_ties::{ByRounding, Cause, TiedPieces};
use rasterproof_render::effects::plan::{Plan, SceneDigest, VERSION};
use rasterproof_render::effects::render::{PlanError, Rendered};
use rasterproof_render::effects::{Effect, Effects, Mode};
use rasterproof_render::pipeline::Counters;
use rasterproof_render::pipeline::assemble::Cull;
use rasterproof_render::pipeline::depth::DepthFormat;
use rasterproof_render::pipeline::fog::{Fog, Growth};
use rasterproof_render::pipeline::highlight::Specular;
use rasterproof_render::pipeline::opacity::{AlphaMode, Opacity};
use rasterproof_render::pipeline::present::DoubleBuffer;
use rasterproof_render::pipeline::shade::Light;
use rasterproof_render::pipeline::shadow::{self, Shadows};
use rasterproof_render::pipeline::target::{Antialias, Colour, Target, check_size};
use rasterproof_render::pipeline::texture::Texture;
use rasterproof_render::pipeline::transform::{about, look_at, perspective};
use rasterproof_render::scene::chapters;
use rasterproof_render::scene::{Scene, Shading};
use rasterproof_report::frame_comparison::{self, Amount, Comparison, Times};
use rasterproof_report::html::{Chapter, Outcome, PictureLayer, PictureView, Report};
use rasterproof_report::picture;
use rasterproof_tiles::frames;

pub const HELP: &str = include_str!("help/render.txt").trim_ascii_end();

#[derive(clap::Args, Debug)]
#[command(after_help = HELP)]
pub struct RenderArguments {
    #[command(flatten)]
    what: SceneArguments,
    /// The rasterizer, or both to compare them; tiles are fast, exact in coverage alone
    #[arg(long, value_enum, default_value_t = Drawn::Both)]
    engine: Drawn,
    /// Draw edges only, by DDA and by Bresenham, whichever goes with the rasterizer
    #[arg(long)]
    wireframe: bool,
    /// What is paid for: planned, usual, all, or +EFFECT and -EFFECT, separated by commas
    #[arg(long, value_name = "EFFECTS", allow_hyphen_values = true, conflicts_with = "wireframe")]
    effects: Option<Effects>,
    /// Draw by the plan in this file, from plan --json, edited or not
    #[arg(long, value_name = "FILE", conflicts_with_all = ["effects", "wireframe", "map", "spin"])]
    plan: Option<PathBuf>,
    /// Draw a small picture for each effect instead: which pixels paid for it
    #[arg(long, conflicts_with_all = ["wireframe", "spin", "report"])]
    map: bool,
    /// A full turn in this many frames, as an animated GIF
    #[arg(long, value_name = "FRAMES", conflicts_with = "report", value_parser = clap::value_parser!(u32).range(2..=1000))]
    spin: Option<u32>,
    /// The picture [default: NAME.png or .gif in the folder of --out]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    page: PageArguments,
    /// Counters as JSON on standard output
    #[arg(long, conflicts_with_all = ["map", "spin"])]
    json: bool,
}

#[derive(clap::Args, Debug)]
pub struct SceneArguments {
    /// A scene of the book by name, or a model in GLB, glTF, OBJ (with its MTL), PLY or STL
    #[arg(value_name = "SCENE|MODEL", required_unless_present = "scene", conflicts_with = "scene")]
    what: Option<PathBuf>,
    /// The scene of this name, whatever files there are; see: rasterproof list
    #[arg(long, value_name = "NAME", value_parser = scene_names())]
    scene: Option<String>,
    #[command(flatten)]
    pub(super) view: ViewArguments,
}

pub(super) const VIEW_OPTIONS: [&str; 19] = [
    "size",
    "aa",
    "cull",
    "shading",
    "specular",
    "alpha-threshold",
    "opacity",
    "layers",
    "mip-maps",
    "shadows",
    "anisotropy",
    "fog",
    "up",
    "normals",
    "depth",
    "yaw",
    "pitch",
    "zoom",
    "fov",
];

/// How a scene or a model is seen.
#[derive(clap::Args, Debug, Default)]
pub struct ViewArguments {
    /// Size of the picture in pixels
    #[arg(long, value_name = "WxH", default_value = "640x480", value_parser = parse_size)]
    size: (u32, u32),
    /// Antialiasing
    #[arg(long, default_value = "none", value_parser = super::one_of(ANTIALIAS))]
    pub(super) aa: Antialias,
    /// Leave out triangles by their winding as the eye sees them
    #[arg(long, value_parser = super::one_of(WINDINGS))]
    cull: Option<Cull>,
    /// How light is laid on a model [default: phong]
    #[arg(long, value_name = "SHADING", value_parser = super::one_of(SHADINGS))]
    shading: Option<Shading>,
    /// Highlights of a model in place of its own: a strength from 0 to 1, and an exponent above 0
    #[arg(long, value_name = "STRENGTH,EXPONENT", value_parser = parse_specular)]
    specular: Option<Specular>,
    /// From which opacity on a model's surfaces that are not opaque are drawn, from 0 to 1, in place of its own; below it
    /// they have holes [default: as the file says, else 0.5]
    #[arg(long, value_name = "OPACITY", value_parser = parse_opacity)]
    alpha_threshold: Option<f64>,
    /// How opaque the surfaces of a model are, from 0 to 1, in place of its own: below 1 they blend with what is behind them
    #[arg(long, value_name = "OPACITY", value_parser = parse_opacity)]
    opacity: Option<f64>,
    /// How many surfaces that are not opaque a sample of a model shows at most, in the order of their depths, from 1 on; without it
    /// they are mixed in the order of drawing
    #[arg(long, value_name = "COUNT")]
    layers: Option<NonZeroU32>,
    /// Read all textures of a model at levels of detail, also where its file does not ask for it
    #[arg(long)]
    mip_maps: bool,
    /// Read all textures of a model up to so many times along the longer axis of a pixel's footprint, from 2 to 16, at levels of
    /// detail
    #[arg(long, value_name = "TAPS", value_parser = clap::value_parser!(u8).range(2..=16))]
    anisotropy: Option<u8>,
    /// Let the surfaces of a model keep the light from others, by a shadow map of SIZE x SIZE texels [default SIZE: 1024]
    #[arg(long, value_name = "SIZE", num_args = 0..=1, default_missing_value = "1024", value_parser = parse_shadows)]
    shadows: Option<u32>,
    /// Fog in the colour of the background, of a model: its start and end, where 0 is the front of the model and 1
    /// the back; or one number, its density over the depth of the model, from the eye on
    #[arg(long, value_name = "START,END|DENSITY", allow_negative_numbers = true, value_parser = parse_fog)]
    fog: Option<Growth>,
    /// The axis of the model's file that points up [default: the usual one of its format, which is printed]
    #[arg(long, value_name = "AXIS", value_parser = super::one_of(UPS))]
    up: Option<Up>,
    /// Normals of a model: those of its file, where a face without any is flat unless the file groups it as
    /// smooth; flat everywhere; or those of the file, and smooth where there are none [default: file]
    #[arg(long, value_name = "FROM", value_parser = super::one_of(NORMALS))]
    normals: Option<Normals>,
    /// How depths are stored
    #[arg(long, default_value = "unorm32", value_parser = super::one_of(DEPTHS))]
    depth: DepthFormat,
    /// Turn the model by this many degrees, to the right [default: 30]
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true)]
    yaw: Option<f64>,
    /// Look down on the model by this many degrees [default: 20]
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true)]
    pitch: Option<f64>,
    /// Come nearer to the model by this factor; large ones end inside it [default: 1]
    #[arg(long, value_name = "FACTOR", allow_negative_numbers = true)]
    zoom: Option<f64>,
    /// Vertical angle of view in degrees, of a model [default: 40]
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true)]
    fov: Option<f64>,
}

#[derive(clap::ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
enum Drawn {
    Scanline,
    EdgeFunction,
    Tiles,
    Both,
}

const ANTIALIAS: &[(&str, Antialias)] = &[
    ("none", Antialias::None),
    ("msaa4", Antialias::Multisample4),
    ("ssaa2", Antialias::Supersample(2)),
    ("ssaa4", Antialias::Supersample(4)),
    ("ssaa8", Antialias::Supersample(8)),
];
const WINDINGS: &[(&str, Cull)] =
    &[("none", Cull::None), ("cw", Cull::Clockwise), ("ccw", Cull::CounterClockwise)];
const SHADINGS: &[(&str, Shading)] = &[
    ("unlit", Shading::Unlit),
    ("flat", Shading::Flat),
    ("gouraud", Shading::Gouraud),
    ("phong", Shading::Phong),
];
const DEPTHS: &[(&str, DepthFormat)] = &[
    ("unorm32", DepthFormat::Unorm32),
    ("unorm24", DepthFormat::Unorm24),
    ("f32", DepthFormat::F32),
    ("f32-reversed", DepthFormat::F32Reversed),
    ("f64", DepthFormat::F64),
];
const UPS: &[(&str, Up)] = &[("y", Up::Y), ("z", Up::Z)];
const NORMALS: &[(&str, Normals)] =
    &[("file", Normals::File), ("flat", Normals::Flat), ("smooth", Normals::Smooth)];

fn scene_names() -> Vec<&'static str> {
    chapters::entries().map(|entry| entry.name).collect()
}

pub(super) fn parse_size(text: &str) -> Result<(u32, u32), String> {
    let sides = text.split_once(['x', 'X']);
    let parsed = sides.and_then(|(w, h)| Some((w.parse().ok()?, h.parse().ok()?)));
    parsed.ok_or_else(|| "expected WIDTHxHEIGHT, for example 1024x768".to_owned())
}

fn parse_specular(text: &str) -> Result<Specular, String> {
    let numbers = text.split_once(',');
    let parsed = numbers.and_then(|(s, e)| Some((s.trim().parse().ok()?, e.trim().parse().ok()?)));
    let fits = |(strength, exponent): &(f64, f64)| {
        (0.0..=1.0).contains(strength) && *exponent > 0.0 && exponent.is_finite()
    };
    let specular = parsed
        .filter(fits)
        .map(|(strength, shininess)| Specular { colour: DVec3::splat(strength), shininess });
    specular.ok_or_else(|| {
        "expected a strength from 0 to 1 and an exponent above 0, for example 0.5,30".to_owned()
    })
}

fn parse_opacity(text: &str) -> Result<f64, String> {
    let opacity = text.trim().parse().ok().filter(|number| (0.0..=1.0).contains(number));
    opacity.ok_or_else(|| "expected a number from 0 to 1, for example 0.5".to_owned())
}

/// Gives all textures a mip map, and anisotropy where it is asked for; one that several items share is made once.
fn give_mip_maps(scene: &mut Scene, anisotropy: Option<u8>) {
    let mut made: Vec<[Arc<Texture>; 2]> = Vec::new();
    for item in &mut scene.items {
        let Some(texture) = &mut item.material.texture else { continue };
        let known = made.iter().find(|[before, _]| Arc::ptr_eq(before, texture));
        let with = match known {
            Some([_, with]) => with.clone(),
            None => {
                let with = Texture::clone(texture).with_mip_map();
                let with = Arc::new(with.with_anisotropy(anisotropy.unwrap_or(1)));
                made.push([texture.clone(), with.clone()]);
                with
            }
        };
        *texture = with;
    }
}

fn parse_shadows(text: &str) -> Result<u32, String> {
    let size = text.trim().parse().ok().filter(|size| shadow::SIZES.contains(size));
    size.ok_or_else(|| {
        let (least, most) = (shadow::SIZES.start(), shadow::SIZES.end());
        format!("expected the texels along a side of the map, from {least} to {most}; a file is named before --shadows")
    })
}

fn parse_fog(text: &str) -> Result<Growth, String> {
    let number = |word: &str| word.trim().parse::<f64>().ok().filter(|number| number.is_finite());
    let growth = match text.split_once(',') {
        Some((start, end)) => number(start)
            .zip(number(end))
            .and_then(|(start, end)| (start < end).then_some(Growth::Linear { start, end })),
        None => number(text)
            .filter(|density| *density > 0.0)
            .map(|density| Growth::Exponential { density }),
    };
    growth.ok_or_else(|| {
        "expected a start and a larger end, for example 0,1, or a density above 0".to_owned()
    })
}

impl SceneArguments {
    /// A model of a file, as it is drawn where nothing else is said.
    pub(super) fn of_model(path: &Path, size: (u32, u32)) -> Self {
        let view = ViewArguments { size, ..ViewArguments::default() };
        Self { what: Some(path.to_owned()), scene: None, view }
    }

    /// An empty target of the size and kind asked for.
    pub(super) fn target(&self) -> Result<Target, Failure> {
        self.view.target()
    }

    /// The name of the scene, or the path of the model.
    pub(super) fn source(&self) -> Result<&str, &Path> {
        if let Some(name) = &self.scene {
            return Ok(name);
        }
        let path = self.what.as_deref().unwrap_or(Path::new(""));
        let scene = chapters::entries().find(|entry| path == Path::new(entry.name));
        // What is there as a file is meant as a file.
        scene.filter(|_| !path.is_file()).map_or(Err(path), |entry| Ok(entry.name))
    }

    pub(super) fn name(&self) -> String {
        let stem = |path: &Path| path.file_stem().unwrap_or_default().to_string_lossy().into();
        self.source().map_or_else(stem, str::to_owned)
    }

    /// The scene, turned by a share of a full turn, as a function that makes it.
    pub(super) fn maker(&self, streams: &mut Streams<'_>) -> Result<Maker, Failure> {
        let view = &self.view;
        match self.source() {
            Ok(name) => {
                let aspect = view.aspect()?;
                view.refuse_eye(name)?;
                Ok(Maker { base: Base::Chapter(name.to_owned()), aspect, cull: view.cull })
            }
            Err(path) if path.extension().is_none() && !path.exists() => {
                let word = path.to_string_lossy();
                let near = scene_names().into_iter().filter(|name| {
                    let steps = strsim::levenshtein(&word.to_ascii_lowercase(), name);
                    steps * 2 <= name.len().max(word.len())
                });
                let nearest = near.min_by_key(|name| strsim::levenshtein(&word, name));
                let hint =
                    nearest.map_or(".".to_owned(), |name| format!("; did you mean '{name}'?"));
                Err(usage(format!(
                    "{word} is neither a file nor a scene{hint} See: {} list",
                    program()
                )))
            }
            Err(path) => view.maker(path, streams),
        }
    }
}

impl ViewArguments {
    /// An empty target of the size and kind asked for.
    pub(super) fn target(&self) -> Result<Target, Failure> {
        let (width, height) = self.size;
        Target::new(width, height, self.aa, self.depth).map_err(usage)
    }

    fn aspect(&self) -> Result<f64, Failure> {
        let (width, height) = self.size;
        check_size(width, height, self.aa).map_err(usage)?;
        Ok(f64::from(width) / f64::from(height))
    }

    pub(super) fn maker(&self, path: &Path, streams: &mut Streams<'_>) -> Result<Maker, Failure> {
        let aspect = self.aspect()?;
        let base = Base::Model(Box::new(self.frame_model(path, aspect, streams)?));
        Ok(Maker { base, aspect, cull: self.cull })
    }

    /// A scene has an eye and a light of its own: what would move them is refused, not ignored.
    fn refuse_eye(&self, scene: &str) -> Result<(), Failure> {
        let given = [
            ("--yaw", self.yaw.is_some()),
            ("--pitch", self.pitch.is_some()),
            ("--zoom", self.zoom.is_some()),
            ("--fov", self.fov.is_some()),
            ("--shading", self.shading.is_some()),
            ("--specular", self.specular.is_some()),
            ("--alpha-threshold", self.alpha_threshold.is_some()),
            ("--opacity", self.opacity.is_some()),
            ("--layers", self.layers.is_some()),
            ("--mip-maps", self.mip_maps),
            ("--anisotropy", self.anisotropy.is_some()),
            ("--shadows", self.shadows.is_some()),
            ("--fog", self.fog.is_some()),
            ("--up", self.up.is_some()),
            ("--normals", self.normals.is_some()),
        ];
        match given.iter().find(|(_, is_given)| *is_given) {
            Some((option, _)) => Err(usage(format!(
                "{option} is for models; the scene '{scene}' has an eye and a light of its own"
            ))),
            None => Ok(()),
        }
    }

    fn frame_model(
        &self,
        path: &Path,
        aspect: f64,
        streams: &mut Streams<'_>,
    ) -> Result<Framed, Failure> {
        let shading = self.shading.unwrap_or(Shading::Phong);
        let (yaw, pitch) = (self.yaw.unwrap_or(30.0), self.pitch.unwrap_or(20.0));
        let (zoom, fov) = (self.zoom.unwrap_or(1.0), self.fov.unwrap_or(40.0));
        let numbers = [("--yaw", yaw), ("--pitch", pitch), ("--zoom", zoom), ("--fov", fov)];
        if let Some((name, value)) = numbers.iter().find(|(_, value)| !value.is_finite()) {
            return Err(usage(format!("{name} {value} is not a finite number")));
        }
        // Beyond, the distance to the model is lost in the rounding of a double, or overflows.
        if !(1e-6..=1e6).contains(&zoom) {
            let cause = format!("--zoom {zoom} does not lie between 0.000001 and 1000000");
            return Err(usage(cause));
        }
        if fov <= 0.0 || fov >= 180.0 {
            return Err(usage(format!("--fov {fov} does not lie between 0 and 180 degrees")));
        }
        let normals = self.normals.unwrap_or_default();
        let options = Options { shading, normals, up: self.up };
        let progress = Progress::new(streams.progress, "models read", None);
        let start = Instant::now();
        let mut model = rasterproof_models::load(path, options).map_err(usage)?;
        let loading = start.elapsed();
        drop(progress);
        report_model(&model, self.up.is_some(), streams.errors)?;
        let bounds = model.items.iter().filter_map(|item| item.mesh.bounds());
        let (min, max) = bounds
            .reduce(|(a, b), (c, d)| (a.min(c), b.max(d)))
            .unwrap_or((DVec3::ZERO, DVec3::ONE));
        let centre = (min + max) / 2.0;
        // A point or a plane has a size too.
        let radius = ((max - min).length() / 2.0).max(f64::MIN_POSITIVE.sqrt());
        let half = fov.to_radians() / 2.0;
        let narrow = half.min(atan(tan(half) * aspect));
        let distance = radius / sin(narrow) / zoom;
        let (pitch, yaw) = (pitch.to_radians(), yaw.to_radians());
        let turn = turn_y(yaw);
        let away = DVec3::new(0.0, sin(pitch), -cos(pitch));
        let up = DVec3::new(0.0, cos(pitch), sin(pitch));
        let view = look_at(centre + away * distance, centre, up).map_err(usage)?;
        let near = (distance - radius).max(distance * 1e-3).max(radius * 1e-3);
        let projection =
            perspective(fov.to_radians(), aspect, near, distance + radius * 1.01).map_err(usage)?;
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        let mut scene = Scene::new(&name, "a model", projection);
        scene.view = view;
        scene.items = std::mem::take(&mut model.items);
        scene.layers = self.layers;
        scene.light = Light {
            towards: DVec3::new(-0.4, 0.7, -0.6).normalize(),
            ambient: 0.25,
            diffuse: 0.75,
        };
        for item in &mut scene.items {
            item.model = about(centre, turn);
            item.material.specular = self.specular.unwrap_or(item.material.specular);
            if let Some(factor) = self.opacity {
                let map = item.material.opacity.take().and_then(|opacity| opacity.map);
                item.material.opacity = Some(Opacity { factor, map, mode: AlphaMode::Blend });
            }
            if let (Some(threshold), Some(opacity)) =
                (self.alpha_threshold, &mut item.material.opacity)
            {
                opacity.mode = AlphaMode::Test { threshold };
            }
        }
        if self.mip_maps || self.anisotropy.is_some() {
            give_mip_maps(&mut scene, self.anisotropy);
        }
        scene.shadows = self.shadows.map(|size| Shadows { size, ..Shadows::default() });
        let [r, g, b, _] = scene.background;
        // From shares of the model's depth to distances.
        let growth = self.fog.map(|growth| match growth {
            Growth::Linear { start, end } => {
                let [start, end] = [start, end].map(|at| distance + radius * (2.0 * at - 1.0));
                Growth::Linear { start, end }
            }
            Growth::Exponential { density } => {
                Growth::Exponential { density: density / (2.0 * radius) }
            }
        });
        scene.fog = growth.map(|growth| Fog { colour: [r, g, b], growth });
        let Model { origins, not_drawn, .. } = model;
        Ok(Framed { scene, centre, origins, not_drawn, loading })
    }
}

/// Says what is missing of a model, what is not drawn, and which axis was taken to point up.
fn report_model(
    model: &Model,
    up_is_given: bool,
    errors: &mut dyn std::io::Write,
) -> std::io::Result<()> {
    for warning in &model.warnings {
        writeln!(errors, "warning: {warning}")?;
    }
    if !model.not_drawn.is_empty() {
        writeln!(errors, "not drawn: {}", model.not_drawn)?;
    }
    if !up_is_given {
        let (taken, other) = match model.up {
            Up::Y => ("y", "z"),
            Up::Z => ("z", "y"),
        };
        let why = if model.format.says_up() { "it does by the rule of" } else { "is usual in" };
        let (format, other) = (model.format.name(), format!("--up {other} for the other"));
        writeln!(errors, "{taken} points up, as {why} {format}; {other}")?;
    }
    Ok(())
}

struct Framed {
    scene: Scene,
    centre: DVec3,
    origins: Vec<Origin>,
    /// What the file contains and is not drawn.
    not_drawn: String,
    /// How long it took to read the file.
    loading: Duration,
}

enum Base {
    Chapter(String),
    Model(Box<Framed>),
}

pub(super) struct Maker {
    base: Base,
    aspect: f64,
    cull: Option<Cull>,
}

impl Maker {
    /// How long it took to read the model; nothing for a scene of the book.
    pub(super) fn loading(&self) -> Option<Duration> {
        match &self.base {
            Base::Chapter(_) => None,
            Base::Model(framed) => Some(framed.loading),
        }
    }

    /// What the file of a model contains and is not drawn, in words.
    pub(super) fn not_drawn(&self) -> &str {
        match &self.base {
            Base::Chapter(_) => "",
            Base::Model(framed) => &framed.not_drawn,
        }
    }

    /// Where each item of a model comes from; nothing for a scene of the book.
    pub(super) fn origins(&self) -> &[Origin] {
        match &self.base {
            Base::Chapter(_) => &[],
            Base::Model(framed) => &framed.origins,
        }
    }

    pub(super) fn scene(&self, turn: f64) -> Scene {
        let mut scene = match &self.base {
            Base::Chapter(name) => chapters::scene(name, self.aspect, turn)
                .unwrap_or_else(|| Scene::new(name, "", DMat4::IDENTITY)),
            Base::Model(framed) => {
                let mut scene = framed.scene.clone();
                let turn = turn_y(turn * std::f64::consts::TAU);
                for item in &mut scene.items {
                    item.model = about(framed.centre, turn) * item.model;
                }
                scene
            }
        };
        if let Some(cull) = self.cull {
            for item in &mut scene.items {
                item.cull = cull;
            }
        }
        scene
    }
}

struct Drawing {
    name: &'static str,
    rendered: Rendered,
    time: Duration,
    /// Holds every depth, where two rasterizers are compared.
    target: Target,
    /// Pixels that are others where every depth and sample is there, which is a fault.
    unplanned: u64,
    /// Pixels that the plan of a file, or effects that were switched off, change.
    changed: u64,
    is_complete: bool,
}

pub fn run(arguments: &RenderArguments, typed: &Typed, streams: &mut Streams<'_>) -> Status {
    let what = &arguments.what;
    let extension = if arguments.spin.is_some() { "gif" } else { "png" };
    let default = || arguments.page.place.out.join(format!("{}.{extension}", what.name()));
    let output = arguments.output.clone().unwrap_or_else(default);
    let ending = output.extension().and_then(|ending| ending.to_str()).unwrap_or("");
    if !ending.eq_ignore_ascii_case(extension) {
        return Err(usage(format!(
            "{}: {} is written as {}: end its name with .{extension}",
            printable_path(&output),
            if extension == "gif" { "a full turn" } else { "the picture" },
            extension.to_ascii_uppercase()
        )));
    }
    let difference = output.with_extension("difference.png");
    let page = arguments.page.page("render.html");
    let files = [
        what.source().err().map(|path| ("the model", path, Use::Reads)),
        arguments.plan.as_deref().map(|path| ("--plan", path, Use::Reads)),
        Some(("--output", output.as_path(), Use::Writes)),
        Some(("the picture of differences", difference.as_path(), Use::Writes)),
        as_file(&page),
    ];
    distinct(&files.into_iter().flatten().collect::<Vec<_>>())?;
    let maker = what.maker(streams)?;
    let drawers = if arguments.engine == Drawn::Both { 2 } else { 1 };
    let pictures = u64::from(arguments.spin.unwrap_or(1)) * drawers;
    let progress = Progress::new(streams.progress, "pictures", Some(pictures));
    if arguments.engine == Drawn::Tiles {
        return draw_in_tiles(arguments, &maker, &output, streams);
    }
    if let Some(frames) = arguments.spin {
        return spin(arguments, &maker, frames, &output, &progress, streams);
    }
    let scene = maker.scene(0.0);
    if arguments.map {
        return map(arguments, &scene, &output, streams);
    }
    let mut drawings = draw(arguments, &scene, &progress)?;
    let picture = frame_comparison::png(&drawings[0].rendered.picture)?;
    let comparison = compare(&scene, &drawings, arguments.plan.is_some())?;
    let by_rounding = match arguments.wireframe {
        true => None,
        false => Some(by_rounding(&scene, &drawings[0].target, Cause::Snapping)?),
    };
    drop(progress);
    let drawn_in = streams.save(&output, &picture).then_some(output.as_path());
    // What a plan changes in both frames alike is no difference between them.
    let is_drawn = |c: &&Comparison| !(c.agrees() || is_plan_alone(c, &drawings)) || leaves_open(c);
    let mut difference_in = None;
    if let Some(comparison) = comparison.as_ref().filter(is_drawn) {
        let picture = frame_comparison::png(&comparison.picture)?;
        difference_in = streams.save(&difference, &picture).then_some(difference.as_path());
    }
    let times = Times {
        loading_s: maker.loading().map(|time| time.as_secs_f64()),
        drawing_s: drawings.iter().map(|drawing| drawing.time.as_secs_f64()).collect(),
    };
    if arguments.json {
        // With its scene the plan can be drawn by.
        drawings[0].rendered.plan.scene = Some(SceneDigest::of(&scene));
        let json = frame_comparison::json(
            &scene.name,
            &names(&drawings),
            &drawings[0].rendered,
            &comparison,
            &by_rounding,
            &times,
        );
        writeln!(streams.output, "{json}")?;
    } else {
        let files = [drawn_in, difference_in];
        let mut text = describe(&scene, &drawings, &times, comparison.as_ref(), files);
        text += &rounding_text(by_rounding.unwrap_or_default(), SNAPPED);
        streams.output.write_all(text.as_bytes())?;
    }
    streams.output.flush()?;
    if let Some(path) = page {
        let report = report_page(typed, &scene, &drawings, comparison.as_ref(), by_rounding);
        write_page(&path, report, streams);
    }
    Ok(comparison.map_or(exit::AGREES, |c| if c.agrees() { exit::AGREES } else { exit::DISAGREES }))
}

fn names(drawings: &[Drawing]) -> Vec<&'static str> {
    drawings.iter().map(|drawing| drawing.name).collect()
}

/// Pixels that the plan of a file, or effects that were switched off, change.
fn changed(drawings: &[Drawing]) -> u64 {
    drawings.iter().map(|drawing| drawing.changed).max().unwrap_or(0)
}

/// Whether two frames are alike, and nothing but their plan is wrong.
fn is_plan_alone(c: &Comparison, drawings: &[Drawing]) -> bool {
    c.wrong_depths == 0 && c.wrong_pixels > 0 && c.wrong_pixels == changed(drawings)
}

/// Compares two drawings; ties are looked for where there are depths to look at.
fn compare(
    scene: &Scene,
    drawings: &[Drawing],
    follows_plan: bool,
) -> Result<Option<Comparison>, Failure> {
    let [a, b] = drawings else { return Ok(None) };
    let ties = if a.is_complete && b.is_complete {
        let engines = [Engine::Scanline, Engine::EdgeFunction];
        let drawn = [0, 1].map(|i| DrawnBy { engine: engines[i], target: &drawings[i].target });
        Some(undecided::find(scene, drawn).map_err(usage)?)
    } else {
        None
    };
    let (first, second) = ((&a.rendered.picture, &a.target), (&b.rendered.picture, &b.target));
    let mut comparison = frame_comparison::compare(first, second, ties.as_ref());
    comparison.wrong_pixels += a.unplanned + b.unplanned;
    if follows_plan {
        // Two rasterizers that follow one wrong plan agree with each other, not with the scene.
        comparison.wrong_pixels += changed(drawings);
    }
    Ok(Some(comparison))
}

fn by_rounding(scene: &Scene, target: &Target, cause: Cause) -> Result<ByRounding, Failure> {
    let tied = TiedPieces::new(scene, target).map_err(usage)?;
    Ok(tied.by_rounding(cause))
}

/// How far the corners that are snapped alike reach, in words.
const SNAPPED: &str = "snapped corners move a depth";

/// The same in words, as two lines; nothing where nothing is. `reach` says how far rounding reaches.
fn rounding(found: ByRounding, reach: &str) -> Option<[String; 2]> {
    let (x, y) = found.first?;
    let pixels = match found.pixels {
        1 => "1 pixel has".to_owned(),
        count => format!("{count} pixels have"),
    };
    Some([
        format!("{pixels} two surfaces nearer to each other than {reach};"),
        format!("rounding alone decides which one is seen; the first is at {x}, {y}"),
    ])
}

fn rounding_text(found: ByRounding, reach: &str) -> String {
    rounding(found, reach).map_or(String::new(), |[first, second]| {
        format!("ROUNDING: {first}\n  {second} (see docs/ties.md)\n")
    })
}

/// The frames side by side, with the plan that was followed.
fn report_page(
    typed: &Typed,
    scene: &Scene,
    drawings: &[Drawing],
    comparison: Option<&Comparison>,
    by_rounding: Option<ByRounding>,
) -> Report {
    let command = typed.line();
    let decided =
        by_rounding.and_then(|found| rounding(found, SNAPPED)).map(|lines| lines.join(" "));
    let outcome = comparison.map(|c| {
        let open = [undecided(c), far_texture(c), decided].into_iter().flatten();
        let open: String = open.map(|words| format!(" {words}.")).collect();
        let (names, pixels) = (names(drawings).join(" and "), c.pixels);
        let (wrong, wrong_depths, depths) = (c.wrong_pixels, c.wrong_depths, c.depths);
        let pixels = format!("{wrong} of {pixels} pixels");
        let sentence =
            format!("{names}: {pixels} and {wrong_depths} of {depths} depths differ.{open}");
        Outcome::of(c.agrees(), sentence)
    });
    let layer =
        |d: &Drawing| PictureLayer::new(d.name, &frame_comparison::rgb(&d.rendered.picture));
    let marked = comparison.filter(|c| !c.agrees() || leaves_open(c));
    let marked =
        marked.map(|c| PictureLayer::new("what differs", &frame_comparison::rgb(&c.picture)));
    let view = PictureView {
        name: scene.name.clone(),
        about: scene.about.clone(),
        command: command.clone(),
        chapter: Chapter { title: "chapter 9, the pipeline", path: "ch09.md" },
        layers: drawings.iter().map(layer).chain(marked).collect(),
    };
    Report {
        title: format!("The scene {}", scene.name),
        outcome,
        command,
        frames: vec![view],
        plan: drawings.first().map_or(Vec::new(), |d| plan_rows(&d.rendered.plan.decisions)),
        ..Report::default()
    }
}

/// A plan from a file: the plan alone, or all that `plan --json` writes.
fn read_plan(path: &Path) -> Result<Plan, Failure> {
    let refused = |error: &dyn std::fmt::Display| {
        usage(format!("{}: {}", printable_path(path), printable(&error.to_string())))
    };
    let text = input::read_text(path, limits::DOCUMENT_BYTES).map_err(usage)?;
    let whole = serde_json::from_str::<serde_json::Value>(&text).map_err(|e| refused(&e))?;
    let plan = whole.get("plan").unwrap_or(&whole);
    // Before anything else: the words of another version are not misspelt.
    let version = plan.get("version").and_then(serde_json::Value::as_u64);
    if version != Some(VERSION.into()) {
        return Err(refused(&PlanError::Version(version)));
    }
    serde_path_to_error::deserialize(plan).map_err(|error| refused(&error))
}

/// Draws one frame by each rasterizer asked for.
fn draw(
    arguments: &RenderArguments,
    scene: &Scene,
    progress: &Progress,
) -> Result<Vec<Drawing>, Failure> {
    let effects = arguments.effects.unwrap_or(Effects::PLANNED);
    let plan = arguments.plan.as_deref().map(read_plan).transpose()?;
    let is_free = arguments.effects.is_none() && plan.is_none();
    // To compare every depth, every depth must be there, of every sample.
    let complete =
        Effects::PLANNED.with(Effect::Depth, Mode::Always).with(Effect::Samples, Mode::Always);
    let engines: &[Drawer] = match arguments.engine {
        Drawn::Scanline => &[Drawer::Scanline],
        Drawn::EdgeFunction => &[Drawer::EdgeFunction],
        Drawn::Both => &Drawer::ALL,
        // Drawn before this.
        Drawn::Tiles => &[],
    };
    let drawing = |drawer: &Drawer| {
        let mut target = arguments.what.target()?;
        let start = Instant::now();
        let incomplete = |name, rendered, time, target, changed| {
            Ok(Drawing { name, rendered, time, target, unplanned: 0, changed, is_complete: false })
        };
        if arguments.wireframe {
            let rendered = drawer.render_wireframe(scene, &mut target).map_err(usage)?;
            return incomplete(drawer.line_name(), rendered, start.elapsed(), target, 0);
        }
        let asked = |target: &mut Target| match (&plan, &arguments.plan) {
            (Some(plan), Some(path)) => drawer
                .execute(plan, scene, target)
                .map_err(|error| usage(format!("{}: {error}", printable_path(path)))),
            _ => drawer.render(scene, &effects, target).map_err(usage),
        };
        let (name, rendered) = (drawer.name(), asked(&mut target)?);
        let time = start.elapsed();
        if engines.len() < 2 {
            return incomplete(name, rendered, time, target, 0);
        }
        let whole = drawer.render(scene, &complete, &mut target).map_err(usage)?;
        let unplanned = frame_comparison::differing(&rendered.picture, &whole.picture);
        if is_free || unplanned == 0 {
            return Ok(Drawing {
                name,
                rendered,
                time,
                target,
                unplanned,
                changed: 0,
                is_complete: true,
            });
        }
        // What was asked for changes the picture: the frame is compared as it is, without ties.
        let rendered = asked(&mut target)?;
        incomplete(name, rendered, time, target, unplanned)
    };
    engines.iter().map(drawing).inspect(|_| progress.done(1)).collect()
}

/// Whether some pixels are right in either of two colours.
fn leaves_open(c: &Comparison) -> bool {
    c.undecided > 0 || c.far_texture > 0
}

/// What is undecided by either, in words; nothing where nothing is.
fn undecided(c: &Comparison) -> Option<String> {
    let Comparison { undecided, undecided_differ, .. } = c;
    (*undecided > 0).then(|| {
        format!("{undecided} pixels are undecided by either, {undecided_differ} of them differ")
    })
}

/// What texture coordinates leave open, in words; nothing where they do not.
fn far_texture(c: &Comparison) -> Option<String> {
    (c.far_texture > 0).then(|| {
        let count = c.far_texture;
        format!(
            "{count} pixels differ by large texture coordinates, whose bound holds several texels"
        )
    })
}

fn describe(
    scene: &Scene,
    drawings: &[Drawing],
    times: &Times,
    comparison: Option<&Comparison>,
    [output, difference]: [Option<&Path>; 2],
) -> String {
    let mut text = String::new();
    let c = &drawings[0].rendered.counters;
    let _ = writeln!(text, "{}: {}", scene.name, scene.about);
    let _ = writeln!(
        text,
        "  vertices {}, triangles {} (rejected {}, clipped {}), in the window {}, culled {}",
        c.vertices, c.triangles, c.rejected, c.clipped, c.pieces, c.culled
    );
    let _ = writeln!(
        text,
        "  fragments {}, depth tests {} (failed {}), shaded {}",
        c.fragments, c.depth_tests, c.depth_failed, c.shaded
    );
    if let (Some(most), true) = (scene.layers, c.layers > 0) {
        let _ = writeln!(
            text,
            "  layers {}, of which {} lie behind the {most} nearest of their sample and are left out",
            c.layers, c.layers_left_out
        );
    }
    text += &times_text(times, &names(drawings));
    if let Some(output) = output {
        let _ = writeln!(text, "  drawn in {}", printable_path(output));
    }
    if is_empty(&drawings[0].rendered) {
        let _ = writeln!(text, "  EMPTY: nothing of it is seen; the picture is background alone");
    }
    let changed = changed(drawings);
    if changed > 0 {
        let _ = writeln!(text, "  what is switched off is called for: it changes {changed} pixels");
    }
    if let Some(c) = comparison {
        let names = names(drawings).join(" and ");
        let (wrong, pixels, wrong_depths, depths) =
            (c.wrong_pixels, c.pixels, c.wrong_depths, c.depths);
        let _ = if c.agrees() {
            writeln!(text, "AGREES: {names}, {pixels} pixels and {depths} depths, 0 differ")
        } else if is_plan_alone(c, drawings) {
            writeln!(
                text,
                "DISAGREES: {names} draw alike, and by this plan {wrong} of {pixels} pixels wrong; \
                 plan again"
            )
        } else {
            let place = difference.map(|path| format!(", drawn in {}", printable_path(path)));
            writeln!(
                text,
                "DISAGREES: {names}: {wrong} of {pixels} pixels and {wrong_depths} of {depths} depths \
                 differ{}",
                place.unwrap_or_default()
            )
        };
    }
    if let Some(words) = comparison.and_then(undecided) {
        let place = difference.map(|path| format!(", drawn in\n  {}", printable_path(path)));
        let place = place.unwrap_or_default();
        let _ = writeln!(text, "UNDECIDED: {words}: surfaces that tie{place} (see docs/ties.md)");
    }
    if let Some((first, rest)) =
        comparison.and_then(far_texture).as_deref().and_then(|words| words.split_once(", "))
    {
        let _ = writeln!(text, "UNDECIDED: {first},\n  {rest} (see docs/ties.md)");
    }
    text
}

/// `  loaded in 12 ms; drawn in 3.1 ms by scanline, 4.0 ms by edge-function`, as one line.
fn times_text(times: &Times, names: &[&str]) -> String {
    let shown = |seconds: f64| match seconds * 1e3 {
        ms if ms < 10.0 => format!("{ms:.1} ms"),
        ms if ms < 1e3 => format!("{ms:.0} ms"),
        _ => format!("{seconds:.2} s"),
    };
    let loaded = times.loading_s.map(|time| format!("loaded in {}; ", shown(time)));
    let by = times.drawing_s.iter().zip(names);
    let drawn: Vec<_> = by.map(|(&time, name)| format!("{} by {name}", shown(time))).collect();
    format!("  {}drawn in {}\n", loaded.unwrap_or_default(), drawn.join(", "))
}

/// Whether every pixel of the picture has the colour of the first.
fn is_empty(rendered: &Rendered) -> bool {
    let mut pixels = rendered.picture.rows().flat_map(|(_, row)| row);
    let first = pixels.next();
    pixels.all(|pixel| Some(pixel) == first)
}

/// One frame in tiles: a picture and nothing else.
fn draw_in_tiles(
    arguments: &RenderArguments,
    maker: &Maker,
    output: &Path,
    streams: &mut Streams<'_>,
) -> Status {
    let refused = [
        (
            "--aa other than none and msaa4",
            !matches!(arguments.what.view.aa, Antialias::None | Antialias::Multisample4),
        ),
        ("--depth", arguments.what.view.depth != DepthFormat::Unorm32),
        ("--effects", arguments.effects.is_some()),
        ("--json", arguments.json),
        ("--map", arguments.map),
        ("--plan", arguments.plan.is_some()),
        ("--report", arguments.page.report),
        ("--spin", arguments.spin.is_some()),
        ("--wireframe", arguments.wireframe),
    ];
    if let Some((option, _)) = refused.iter().find(|(_, given)| *given) {
        return Err(usage(format!("{option} is not for --engine tiles; name another engine")));
    }
    let target = arguments.what.target()?;
    let size = target.size();
    let samples = match arguments.what.view.aa {
        Antialias::Multisample4 => frames::Samples::Four,
        _ => frames::Samples::One,
    };
    let scene = &maker.scene(0.0);
    let exact = || {
        let mut target = arguments.what.target()?;
        let exact = Drawer::Scanline.render(scene, &Effects::PLANNED, &mut target);
        Ok::<_, Failure>(exact.map_err(usage)?.picture)
    };
    let not_drawn = frames::not_drawn(scene);
    let (handed_over, reason) = match not_drawn {
        0 => {
            let beyond = frames::beyond_f32(scene, size.width(), size.height()).map_err(usage)?;
            (beyond, "have values beyond 2^62, which may\n  overflow in f32")
        }
        _ => (not_drawn, "are not opaque or receive shadows, which tiles do not\n  draw"),
    };
    let start = Instant::now();
    let picture = match handed_over {
        0 => frames::render(scene, size.width(), size.height(), samples).map_err(usage)?,
        _ => exact()?,
    };
    let times = Times {
        loading_s: maker.loading().map(|time| time.as_secs_f64()),
        drawing_s: vec![start.elapsed().as_secs_f64()],
    };
    writeln!(streams.output, "{}: {}", scene.name, scene.about)?;
    let name = if handed_over == 0 { "tiles" } else { "scanline" };
    write!(streams.output, "{}", times_text(&times, &[name]))?;
    if handed_over > 0 {
        let path = printable_path(output);
        let drawn_in = match streams.save(output, &frame_comparison::png(&picture)?) {
            true => format!(", drawn in {path}"),
            false => String::new(),
        };
        writeln!(
            streams.output,
            "  {handed_over} of {} triangles {reason}: handed to scanline{drawn_in}",
            scene.triangles()
        )?;
        return Ok(exit::AGREES);
    }
    if streams.save(output, &frame_comparison::png(&picture)?) {
        let (side, path) = (frames::SIDE_PX, printable_path(output));
        writeln!(streams.output, "  drawn in tiles of {side} x {side} px in {path}")?;
    }
    let differing = frame_comparison::differing(&picture, &exact()?);
    if differing > 0 {
        let pixels = u64::from(size.width()) * u64::from(size.height());
        writeln!(streams.output, "  {differing} of {pixels} pixels differ from those of scanline")?;
    }
    let found = by_rounding(scene, &target, Cause::PlanesInF32)?;
    let reach = "snapping and f32 move a depth";
    streams.output.write_all(rounding_text(found, reach).as_bytes())?;
    Ok(exit::AGREES)
}

fn map(
    arguments: &RenderArguments,
    scene: &Scene,
    output: &Path,
    streams: &mut Streams<'_>,
) -> Status {
    let mut target = arguments.what.target()?;
    let edges = arguments.engine == Drawn::EdgeFunction;
    let drawer = if edges { Drawer::EdgeFunction } else { Drawer::Scanline };
    let effects = arguments.effects.unwrap_or(Effects::PLANNED);
    let (rendered, map) = drawer.render_mapped(scene, &effects, &mut target).map_err(usage)?;
    let title = format!("{}: what each pixel pays for", scene.name);
    let picture = picture::png(&frame_comparison::map_picture(&title, &rendered.picture, &map));
    let drawn_in = match streams.save(output, &picture) {
        true => format!(", drawn in {}", printable_path(output)),
        false => String::new(),
    };
    writeln!(streams.output, "{}: effects paid for{drawn_in}", scene.name)?;
    for effect in frame_comparison::mapped() {
        writeln!(
            streams.output,
            "  {:<12} {} px",
            effect.name(),
            frame_comparison::paid(&map.effects, effect)
        )?;
    }
    for (what, counts) in [("fragments", &map.fragments), ("effects of fragments", &map.payments)] {
        let Amount { mean, most, at: [x, y], pixels } = Amount::of(counts);
        writeln!(
            streams.output,
            "{what}: {mean:.2} a pixel on average, at most {most} (in {pixels} px, first {x},{y})"
        )?;
    }
    Ok(exit::AGREES)
}

/// Frames of a full turn, into one GIF, which sees the front buffer alone: finished frames.
fn spin(
    arguments: &RenderArguments,
    maker: &Maker,
    frames: u32,
    output: &Path,
    progress: &Progress,
    streams: &mut Streams<'_>,
) -> Status {
    let mut bytes = Vec::new();
    let (mut wrong, mut undecided, mut far) = (0, 0, 0);
    let mut screen = DoubleBuffer::new(arguments.what.target()?);
    let mut counters = Counters::default();
    {
        let mut encoder = GifEncoder::new_with_speed(&mut bytes, 10);
        let failed = |error: image::ImageError| usage(format!("the GIF: {error}"));
        encoder.set_repeat(Repeat::Infinite).map_err(failed)?;
        for frame in 0..frames {
            let scene = maker.scene(f64::from(frame) / f64::from(frames));
            let drawings = draw(arguments, &scene, progress)?;
            if let Some(c) = compare(&scene, &drawings, false)? {
                wrong += c.wrong_pixels + c.wrong_depths;
                undecided += c.undecided;
                far += c.far_texture;
            }
            if let Some(first) = drawings.into_iter().next() {
                screen.back = first.target;
                screen.present(first.rendered.picture, &mut counters);
            }
            let picture = rgba(screen.front());
            let delay = image::Delay::from_saturating_duration(Duration::from_millis(40));
            let frame = image::Frame::from_parts(picture, 0, 0, delay);
            encoder.encode_frame(frame).map_err(failed)?;
        }
    }
    let drawn_in = match streams.save(output, &bytes) {
        true => format!(", drawn in {}", printable_path(output)),
        false => String::new(),
    };
    writeln!(streams.output, "{frames} frames{drawn_in}")?;
    if undecided > 0 {
        writeln!(streams.output, "UNDECIDED: {undecided} pixels, where surfaces tie")?;
    }
    if far > 0 {
        writeln!(streams.output, "UNDECIDED: {far} pixels, by large texture coordinates")?;
    }
    match (arguments.engine, wrong) {
        (Drawn::Both, 0) => writeln!(streams.output, "AGREES: 0 pixels and depths differ")?,
        (Drawn::Both, wrong) => {
            writeln!(streams.output, "DISAGREES: {wrong} pixels and depths differ")?;
            return Ok(exit::DISAGREES);
        }
        _ => {}
    }
    Ok(exit::AGREES)
}

fn rgba(picture: &Frame<Colour>) -> image::RgbaImage {
    let bounds = picture.bounds();
    image::RgbaImage::from_fn(bounds.width(), bounds.height(), |x, y| {
        image::Rgba(picture.row(y as i32)[x as usize])
    })
}
