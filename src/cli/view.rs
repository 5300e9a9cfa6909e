//! What is drawn and how it is seen, as a command line says it: a scene of the book, or a model with an eye and a light.
//!
//! A scene of the book has an eye and a light of its own, so options that would move them are refused. A model is turned about its
//! centre before an eye that is as far away as it takes to see all of it, unless a camera of its file is chosen.

use std::collections::HashMap;
use std::num::NonZeroU32;
use std::path::{Path, PathBuf};
use std::sync::{Arc, LazyLock};
use std::time::Instant;

use clap::Args as _;
use glam::{DMat4, DVec3};

use super::progress::Progress;
use super::typed::Typed;
use super::{InputError, Streams, did_you_mean, pair, program, usage};
use rasterproof_core::angle::{atan, cos, sin, tan, turn_y};
use rasterproof_host::text::{printable_path, printable_short};
use rasterproof_models::{LoadOptions, Model, Normals, Origin, Pose, Up, cameras};
use rasterproof_render::pipeline::assemble::Cull;
use rasterproof_render::pipeline::depth::DepthFormat;
use rasterproof_render::pipeline::fog::{Fog, Growth};
use rasterproof_render::pipeline::highlight::Specular;
use rasterproof_render::pipeline::opacity::{AlphaMode, Opacity};
use rasterproof_render::pipeline::shade::Light;
use rasterproof_render::pipeline::shadow;
use rasterproof_render::pipeline::target::{Antialias, Target, check_size};
use rasterproof_render::pipeline::texture::Texture;
use rasterproof_render::pipeline::transform::{about, look_at, perspective};
use rasterproof_render::scene::Shadows;
use rasterproof_render::scene::{Item, Scene, Shading, chapters};
use rasterproof_report::words::count;
use rasterproof_study::bounds::{FrameSize, Purpose};
use rasterproof_study::corner_grid::CornerGrid;
use rasterproof_study::facing;

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

/// The names of the options of [`ViewArguments`].
pub(super) static VIEW_OPTIONS: LazyLock<Vec<String>> = LazyLock::new(|| {
    let view = ViewArguments::augment_args(clap::Command::new("view"));
    view.get_arguments().filter_map(|option| option.get_long().map(str::to_owned)).collect()
});

/// The names of the options of [`GridArguments`].
pub(super) const GRID_OPTIONS: [&str; 2] = ["subpixel-bits", "unsnapped"];

/// Where corners are put.
#[derive(clap::Args, Debug)]
pub struct GridArguments {
    /// Put corners on a grid of so many bits below the pixel [default: 8]
    #[arg(long, value_name = "BITS", value_parser = super::one_of(BITS))]
    subpixel_bits: Option<u32>,
    /// Leave corners as they are, on no grid
    #[arg(long, conflicts_with = "subpixel_bits")]
    unsnapped: bool,
}

const BITS: [(&str, u32); 4] = [("4", 4), ("8", 8), ("12", 12), ("16", 16)];

impl GridArguments {
    /// The grid that is asked for, else the usual one.
    pub(super) fn grid(&self) -> CornerGrid {
        match self.subpixel_bits {
            _ if self.unsnapped => CornerGrid::Unsnapped,
            Some(bits) => CornerGrid::Bits(bits),
            None => CornerGrid::USUAL,
        }
    }
}

/// The options that a command about a view has in common with one on the same grid.
pub(super) fn view_and_grid() -> Vec<String> {
    VIEW_OPTIONS.iter().cloned().chain(GRID_OPTIONS.map(str::to_owned)).collect()
}

/// Those of them that say how scenes are drawn, too.
const OF_SCENES: [&str; 4] = ["size", "aa", "cull", "depth"];

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
    #[arg(long, value_name = "TAPS", value_parser = super::whole::<u8>(2..=16))]
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
    /// Light the backs of a model's faces by reversed normals, and draw them also where its file leaves them out
    #[arg(long)]
    two_sided: bool,
    /// How depths are stored
    #[arg(long, default_value = "unorm32", value_parser = super::one_of(DepthFormat::ALL.map(|depth| (depth.name(), depth))))]
    pub(super) depth: DepthFormat,
    /// Look through a camera of the model's file, by its number, from 1, or its name
    #[arg(long, value_name = "NUMBER|NAME", conflicts_with_all = ["yaw", "pitch", "zoom", "fov"])]
    camera: Option<String>,
    /// Draw the model as an animation of its file has it after so many seconds; without it the model is at rest
    #[arg(long, value_name = "SECONDS")]
    time: Option<f64>,
    /// The number of that animation, from 1 [default: 1]
    #[arg(long, value_name = "NUMBER", requires = "time", value_parser = super::whole::<u32>(1..=u32::MAX.into()))]
    animation: Option<u32>,
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

const ANTIALIAS: [(&str, Antialias); 5] = [
    ("none", Antialias::None),
    ("msaa4", Antialias::Multisample4),
    ("ssaa2", Antialias::Supersample(2)),
    ("ssaa4", Antialias::Supersample(4)),
    ("ssaa8", Antialias::Supersample(8)),
];
const WINDINGS: [(&str, Cull); 3] =
    [("none", Cull::None), ("cw", Cull::Clockwise), ("ccw", Cull::CounterClockwise)];
const SHADINGS: [(&str, Shading); 4] = [
    ("unlit", Shading::Unlit),
    ("flat", Shading::Flat),
    ("gouraud", Shading::Gouraud),
    ("phong", Shading::Phong),
];
const UPS: [(&str, Up); 2] = [("y", Up::Y), ("z", Up::Z)];
const NORMALS: [(&str, Normals); 3] =
    [("file", Normals::File), ("flat", Normals::Flat), ("smooth", Normals::Smooth)];

fn scene_names() -> Vec<&'static str> {
    chapters::entries().map(|entry| entry.name).collect()
}

/// A width and a height in pixels. How large they may be depends on what is drawn, and is checked with it.
pub(super) fn parse_size(text: &str) -> Result<(u32, u32), &'static str> {
    pair(text, &['x', 'X']).ok_or("expected WIDTHxHEIGHT, for example 1024x768")
}

/// A highlight that is white, since the option has no colour.
fn parse_specular(text: &str) -> Result<Specular, &'static str> {
    match pair::<f64, f64>(text, &[',']) {
        Some((strength, shininess))
            if (0.0..=1.0).contains(&strength) && shininess > 0.0 && shininess.is_finite() =>
        {
            Ok(Specular { colour: DVec3::splat(strength), shininess })
        }
        _ => Err("expected a strength from 0 to 1 and an exponent above 0, for example 0.5,30"),
    }
}

/// A share of light, from none to all of it.
fn parse_opacity(text: &str) -> Result<f64, &'static str> {
    match text.trim().parse() {
        Ok(opacity) if (0.0..=1.0).contains(&opacity) => Ok(opacity),
        _ => Err("expected a number from 0 to 1, for example 0.5"),
    }
}

/// Textures with mip maps by the addresses of those that they replace, each behind the replaced one: that is kept, so that no
/// other texture gets its address.
type MipMapped = HashMap<*const Texture, [Arc<Texture>; 2]>;

/// Gives all textures a mip map, and anisotropy where it is asked for; one that several items share is made once.
fn give_mip_maps(scene: &mut Scene, anisotropy: Option<u8>) {
    let (mut made, taps) = (MipMapped::new(), anisotropy.unwrap_or(1));
    for item in &mut scene.items {
        if let Some(texture) = &mut item.material.texture {
            give_mip_map(texture, taps, &mut made);
        }
        if let Some(physical) = &mut item.material.physical {
            for texture in Arc::make_mut(physical).maps.iter_mut().flatten() {
                give_mip_map(texture, taps, &mut made);
            }
        }
    }
}

/// Replaces a texture by one with levels of detail, of which `taps` are read along the longer axis of a footprint.
fn give_mip_map(texture: &mut Arc<Texture>, taps: u8, made: &mut MipMapped) {
    let [_, with] = made.entry(Arc::as_ptr(texture)).or_insert_with(|| {
        let with = Texture::clone(texture).with_mip_map().with_anisotropy(taps);
        [texture.clone(), Arc::new(with)]
    });
    *texture = with.clone();
}

/// The side of a shadow map. As the value may be left out, a file behind the option would be taken for it.
fn parse_shadows(text: &str) -> Result<u32, String> {
    match text.trim().parse() {
        Ok(size) if shadow::SIZES.contains(&size) => Ok(size),
        _ => {
            let (least, most) = (shadow::SIZES.start(), shadow::SIZES.end());
            Err(format!(
                "expected the texels along a side of the map, from {least} to {most}; a file is named before --shadows"
            ))
        }
    }
}

/// Two numbers are the start and the end of fog that grows with the distance, one is the density of fog without an end.
fn parse_fog(text: &str) -> Result<Growth, &'static str> {
    if let Some((start, end)) = pair::<f64, f64>(text, &[','])
        && start < end
        && start.is_finite()
        && end.is_finite()
    {
        return Ok(Growth::Linear { start, end });
    }
    match text.trim().parse::<f64>() {
        Ok(density) if density > 0.0 && density.is_finite() => Ok(Growth::Exponential { density }),
        _ => Err("expected a start and a larger end, for example 0,1, or a density above 0"),
    }
}

impl SceneArguments {
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

    /// A name for pictures of it: that of the scene, or of the file without its ending.
    pub(super) fn name(&self) -> String {
        match self.source() {
            Ok(name) => name.to_owned(),
            Err(path) => path.file_stem().unwrap_or_default().to_string_lossy().into_owned(),
        }
    }

    /// The scene, or the model in its view, refused where it is too much for its purpose.
    pub(super) fn maker(
        &self,
        typed: &Typed,
        purpose: Purpose,
        streams: &mut Streams<'_>,
    ) -> Result<Maker, InputError> {
        let view = &self.view;
        match self.source() {
            Ok(name) => {
                let aspect = view.aspect()?;
                // A scene has an eye and a light of its own: what would move them is refused, not ignored.
                let mut of_models = VIEW_OPTIONS.clone();
                of_models.retain(|option| !OF_SCENES.contains(&option.as_str()));
                if let Some(option) = typed.given(&of_models) {
                    return Err(usage(format!(
                        "--{option} is for models; the scene '{name}' has an eye and a light of its own"
                    )));
                }
                let scene = chapter(name, aspect, 0.0, view.cull);
                let maker = Maker { scene, model: Framed::default(), aspect, cull: view.cull };
                view.frame_size().refuse_too_much(name, &maker.scene, 0, purpose)?;
                Ok(maker)
            }
            // A word without an ending is meant as a name.
            Err(path) if path.extension().is_none() && !path.exists() => {
                let word = path.to_string_lossy();
                let hint = did_you_mean(&word, &scene_names());
                Err(usage(format!(
                    "{word} is neither a file nor a scene{hint} See: {} list",
                    program()
                )))
            }
            Err(path) => view.maker(path, purpose, streams),
        }
    }
}

impl ViewArguments {
    /// A picture of this size, of a model as it is drawn where nothing else is said.
    pub(super) fn of(size: (u32, u32)) -> Self {
        Self { size, ..Self::default() }
    }

    /// An empty target of the size and kind asked for.
    pub(super) fn target(&self) -> Result<Target, InputError> {
        let (width, height) = self.size;
        Target::new(width, height, self.aa, self.depth).map_err(usage)
    }

    /// What decides how much memory and time a frame takes.
    fn frame_size(&self) -> FrameSize {
        FrameSize { px: self.size, antialias: self.aa, shadows: self.shadows }
    }

    /// Width by height, of a picture that can be drawn.
    fn aspect(&self) -> Result<f64, InputError> {
        let (width, height) = self.size;
        check_size(width, height, self.aa)?;
        Ok(f64::from(width) / f64::from(height))
    }

    /// A model in this view, refused where it is too much for its purpose.
    pub(super) fn maker(
        &self,
        path: &Path,
        purpose: Purpose,
        streams: &mut Streams<'_>,
    ) -> Result<Maker, InputError> {
        let aspect = self.aspect()?;
        // Before the file is read, which may take long.
        self.frame_size().refuse_large_frames(purpose)?;
        let (mut scene, model) = self.frame_model(path, aspect, streams)?;
        cull(&mut scene, self.cull);
        let maker = Maker { scene, model, aspect, cull: self.cull };
        let name = printable_path(path).to_string();
        self.frame_size().refuse_too_much(&name, &maker.scene, maker.model.file_bytes, purpose)?;
        // Where most of what is seen are backs, the file is likely to wind its faces the other way.
        let backs = facing::share_of_backs(&maker.scene);
        if let Some(share) = backs.filter(|share| *share > 0.5) {
            // 100% only of all.
            let percent = (share * 100.0).floor();
            writeln!(
                streams.errors,
                "{percent}% of what is seen are backs of faces, lit by the normals of their fronts; --two-sided reverses these"
            )?;
        }
        Ok(maker)
    }

    /// Reads a model and puts it before the eye and into the light of this view.
    fn frame_model(
        &self,
        path: &Path,
        aspect: f64,
        streams: &mut Streams<'_>,
    ) -> Result<(Scene, Framed), InputError> {
        self.check_numbers()?;
        let start = Instant::now();
        let mut model = self.load(path, streams.progress)?;
        let loading_s = Some(start.elapsed().as_secs_f64());
        report_model(&model, self.up.is_some(), streams.errors)?;
        if self.time.is_some() && model.animations.is_empty() {
            return Err(usage("--time: the model has no animations".to_owned()));
        }
        self.report_choices(&model, streams.errors)?;
        let eye = self.eye(&model, aspect)?;
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        let mut scene = Scene::new(&name, "a model", eye.projection);
        scene.view = eye.view;
        scene.items = std::mem::take(&mut model.items);
        scene.layers = self.layers;
        // One light from above, on the side of the eye; where the file has lights, they shine in its place.
        scene.light = Light {
            towards: DVec3::new(-0.4, 0.7, -0.6).normalize(),
            ambient: 0.25,
            diffuse: 0.75,
        };
        let place = about(eye.centre, eye.turn);
        scene.punctual = model.lights.iter().map(|light| light.placed(place)).collect();
        for item in &mut scene.items {
            item.model = place;
            self.change_surface(item);
        }
        if self.mip_maps || self.anisotropy.is_some() {
            give_mip_maps(&mut scene, self.anisotropy);
        }
        scene.shadows = self.shadows.map(|size| Shadows { size, ..Shadows::default() });
        // What is far away fades into the background.
        if let Some(growth) = self.fog {
            let [r, g, b, _] = scene.background;
            scene.fog = Some(Fog { colour: [r, g, b], growth: eye.growth_in_distances(growth) });
        }
        let Model { origins, not_drawn, file_bytes, mut why_empty, .. } = model;
        if self.opacity.is_some() {
            // The file does not decide.
            why_empty.clear();
        }
        let centre = eye.centre;
        Ok((scene, Framed { centre, origins, not_drawn, why_empty, file_bytes, loading_s }))
    }

    fn zoom(&self) -> f64 {
        self.zoom.unwrap_or(1.0)
    }

    fn fov_deg(&self) -> f64 {
        self.fov.unwrap_or(40.0)
    }

    /// Refuses numbers by which nothing can be seen. The parser lets every double pass.
    fn check_numbers(&self) -> Result<(), InputError> {
        let (yaw, pitch, zoom, fov) = (self.yaw, self.pitch, self.zoom(), self.fov_deg());
        for (name, value) in [
            ("yaw", yaw),
            ("pitch", pitch),
            ("zoom", Some(zoom)),
            ("fov", Some(fov)),
            ("time", self.time),
        ] {
            if let Some(value) = value.filter(|value| !value.is_finite()) {
                return Err(usage(format!("--{name} {value} is not a finite number")));
            }
        }
        // Beyond, the distance to the model is lost in the rounding of a double, or overflows.
        if !(1e-6..=1e6).contains(&zoom) {
            return Err(usage(format!("--zoom {zoom} does not lie between 0.000001 and 1000000")));
        }
        if fov <= 0.0 || fov >= 180.0 {
            return Err(usage(format!("--fov {fov} does not lie between 0 and 180 degrees")));
        }
        Ok(())
    }

    /// Reads the file as these options ask for it.
    fn load(&self, path: &Path, on_terminal: bool) -> Result<Model, InputError> {
        // The first animation has number 1.
        let animation = self.animation.unwrap_or(1) as usize - 1;
        let options = LoadOptions {
            shading: self.shading.unwrap_or(Shading::Phong),
            normals: self.normals.unwrap_or_default(),
            up: self.up,
            pose: self.time.map(|time_s| Pose { animation, time_s }),
        };
        let _progress = Progress::new(on_terminal, "models read", None);
        Ok(rasterproof_models::load(path, options)?)
    }

    /// Says what the file has that an option would show, and what becomes of its lights.
    fn report_choices(
        &self,
        model: &Model,
        errors: &mut dyn std::io::Write,
    ) -> std::io::Result<()> {
        if self.time.is_none() && !model.animations.is_empty() {
            let count = count(model.animations.len() as u64, "animation", "animations");
            let listed = cameras::listed(model.animations.iter().map(String::as_str));
            let how = "--time 0.5 shows the first after half a second";
            writeln!(errors, "the file has {count}: {listed}; {how}")?;
        }
        if self.camera.is_none() && !model.cameras.is_empty() {
            let count = count(model.cameras.len() as u64, "camera", "cameras");
            let listed = cameras::listed(model.cameras.iter().map(|camera| &*camera.name));
            let how = "--camera 1 looks through the first";
            writeln!(errors, "the file has {count}: {listed}; {how}")?;
        }
        if !model.lights.is_empty() {
            let count = count(model.lights.len() as u64, "light", "lights");
            // A shadow map is made for the light of the view alone.
            let shadows =
                if self.shadows.is_some() { ", and nothing keeps it from anything" } else { "" };
            writeln!(
                errors,
                "the light is that of {count} of the file{shadows}; ambient light is that of the view"
            )?;
        }
        Ok(())
    }

    /// The eye from which all of the model is seen, or the camera of its file that was chosen.
    fn eye(&self, model: &Model, aspect: f64) -> Result<Eye, InputError> {
        // The box around the model, and the sphere around that, which stays the same when the model is turned.
        let bounds = model.items.iter().filter_map(|item| item.mesh.bounds());
        let (min, max) = bounds
            .reduce(|(a, b), (c, d)| (a.min(c), b.max(d)))
            .unwrap_or((DVec3::ZERO, DVec3::ONE));
        let centre = (min + max) / 2.0;
        // A point or a plane has a size too.
        let radius = ((max - min).length() / 2.0).max(f64::MIN_POSITIVE.sqrt());
        // The sphere touches the sides of the view along the shorter side of the picture.
        let angle = self.fov_deg().to_radians();
        let half = angle / 2.0;
        let narrow = half.min(atan(tan(half) * aspect));
        let distance = radius / sin(narrow) / self.zoom();
        // The model is turned to the side, and the eye rises to look down.
        let turn = turn_y(self.yaw.unwrap_or(30.0).to_radians());
        let pitch = self.pitch.unwrap_or(20.0).to_radians();
        let away = DVec3::new(0.0, sin(pitch), -cos(pitch));
        let up = DVec3::new(0.0, cos(pitch), sin(pitch));
        let view = look_at(centre + away * distance, centre, up)?;
        // No part of the model is nearer than the sphere. An eye inside it needs a distance above 0 all the same.
        let near = (distance - radius).max(distance * 1e-3).max(radius * 1e-3);
        let projection = perspective(angle, aspect, near, distance + radius * 1.01)?;
        let Some(wanted) = &self.camera else {
            return Ok(Eye { centre, radius, distance, turn, view, projection });
        };
        // A camera stands in the model as its file has it, not turned.
        let seen = cameras::find(&model.cameras, wanted).and_then(|camera| {
            camera.matrices(aspect, [min, max]).map_err(|error| error.to_string())
        });
        let [view, projection] = seen
            .map_err(|error| usage(format!("--camera {}: {error}", printable_short(wanted, 40))))?;
        let (turn, distance) = (DMat4::IDENTITY, view.transform_point3(centre).z);
        Ok(Eye { centre, radius, distance, turn, view, projection })
    }

    /// Changes what these options say of the surface of an item.
    fn change_surface(&self, item: &mut Item) {
        if self.two_sided {
            (item.two_sided, item.cull) = (true, Cull::None);
        }
        item.material.specular = self.specular.unwrap_or(item.material.specular);
        // A surface keeps the map of its opacity, by which parts of it stay more transparent than others.
        if let Some(factor) = self.opacity {
            let map = item.material.opacity.take().and_then(|opacity| opacity.map);
            item.material.opacity = Some(Opacity { factor, map, mode: AlphaMode::Blend });
        }
        // Where a surface is not opaque, by the file or by now, a threshold makes holes of it.
        if let (Some(threshold), Some(opacity)) = (self.alpha_threshold, &mut item.material.opacity)
        {
            opacity.mode = AlphaMode::Test { threshold };
        }
    }
}

/// How a model lies before an eye.
struct Eye {
    /// The centre of the model and the radius of the sphere around it.
    centre: DVec3,
    radius: f64,
    /// From the eye to the centre.
    distance: f64,
    /// What turns the model about its centre.
    turn: DMat4,
    view: DMat4,
    projection: DMat4,
}

impl Eye {
    /// Fog by distances from the eye: on the command line it is told in shares of the model's depth, so that the same words look
    /// alike for models of any size.
    fn growth_in_distances(&self, growth: Growth) -> Growth {
        let Self { distance, radius, .. } = *self;
        match growth {
            Growth::Linear { start, end } => {
                let [start, end] = [start, end].map(|at| distance + radius * (2.0 * at - 1.0));
                Growth::Linear { start, end }
            }
            Growth::Exponential { density } => {
                Growth::Exponential { density: density / (2.0 * radius) }
            }
        }
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
        let (taken, other) = if model.up == Up::Y { ("y", "z") } else { ("z", "y") };
        let why = if model.format.says_up() { "it does by the rule of" } else { "is usual in" };
        let format = model.format.name();
        writeln!(errors, "{taken} points up, as {why} {format}; --up {other} for the other")?;
    }
    Ok(())
}

/// What is known of the file of a model; of a scene of the book nothing.
#[derive(Default)]
pub(super) struct Framed {
    centre: DVec3,
    pub(super) origins: Vec<Origin>,
    /// What the file contains and is not drawn, in words.
    pub(super) not_drawn: String,
    /// Why nothing of it can be seen, in words; empty where something may be.
    pub(super) why_empty: String,
    file_bytes: u64,
    pub(super) loading_s: Option<f64>,
}

/// What makes the scenes that a command draws.
pub(super) struct Maker {
    /// As it stands where it is not turned, culled as asked.
    pub(super) scene: Scene,
    pub(super) model: Framed,
    aspect: f64,
    cull: Option<Cull>,
}

impl Maker {
    /// The scene, turned by a share of a full turn.
    pub(super) fn turned(&self, turn: f64) -> Scene {
        // A scene of the book turns as its chapter says.
        if self.model.loading_s.is_none() {
            return chapter(&self.scene.name, self.aspect, turn, self.cull);
        }
        // A model turns about its centre, after what it was turned by already.
        let mut scene = self.scene.clone();
        let turn = turn_y(turn * std::f64::consts::TAU);
        for item in &mut scene.items {
            item.model = about(self.model.centre, turn) * item.model;
        }
        scene
    }
}

/// A scene of the book at a share of a full turn.
fn chapter(name: &str, aspect: f64, turn: f64, asked: Option<Cull>) -> Scene {
    let mut scene = chapters::scene(name, aspect, turn)
        .unwrap_or_else(|| Scene::new(name, "", DMat4::IDENTITY));
    cull(&mut scene, asked);
    scene
}

/// Leaves out triangles by their winding as it is asked for, else as each item has it.
fn cull(scene: &mut Scene, asked: Option<Cull>) {
    for item in &mut scene.items {
        item.cull = asked.unwrap_or(item.cull);
    }
}
