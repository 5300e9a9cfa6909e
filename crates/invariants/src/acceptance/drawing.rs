//! Who draws, and what comes of it.

use std::collections::HashMap;

use glam::DVec2;

use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::{Interpolate as _, Rasterize as _};
use rasterproof_core::grid::{HALF_PIXEL, PixelRect, SUBPIXEL_BITS, SUBPIXELS};
use rasterproof_core::triangle::{Fragment, Span};
use rasterproof_faults::planted::TriangleMutant;
use rasterproof_faults::published::{Published, from_screen};
use rasterproof_registry::engines::{Engine, SPECIMENS, Specimen};
use rasterproof_verify::cases::Triangle;
use rasterproof_verify::comparison::{Convention, Rule, caught};

use super::scenes::{Paint, Scene};

/// Whose pictures the rules decide about.
#[derive(Clone, Copy, Debug)]
pub enum Rasterizer {
    /// The scanline engine: the picture that rules compare with.
    Reference,
    Planted(TriangleMutant),
    /// A published algorithm with its faults, under its name.
    Published(&'static str, &'static dyn Published),
    /// A right rasterizer, and how it differs from the reference.
    Right(&'static str, Permitted),
}

/// A difference that the specifications of OpenGL and Vulkan permit.
#[derive(Clone, Copy, Debug)]
pub struct Permitted {
    /// Which samples that lie on an edge belong to the triangle.
    rule: Rule,
    /// Bits below the pixel; Vulkan asks for at least 4.
    bits: u32,
    single: bool,
}

const fn permitted(rule: Rule, bits: u32, single: bool) -> Permitted {
    Permitted { rule, bits, single }
}

/// Right rasterizers. The second engine is among them, since its values may differ in the last bit.
const RIGHT: [(&str, Permitted); 6] = [
    ("top-right rule", permitted(Rule::TopRight, SUBPIXEL_BITS, false)),
    ("bottom-left rule", permitted(Rule::BottomLeft, SUBPIXEL_BITS, false)),
    ("bottom-right rule", permitted(Rule::BottomRight, SUBPIXEL_BITS, false)),
    ("values in f32", permitted(Rule::TopLeft, SUBPIXEL_BITS, true)),
    ("grid of 1/16 px", permitted(Rule::TopLeft, 4, false)),
    ("grid of 1/16 px, bottom-left", permitted(Rule::BottomLeft, 4, true)),
];

impl Rasterizer {
    /// Those with a fault, and those that are right.
    pub fn all() -> Vec<Self> {
        // These two are faults by what this project declares. Specifications permit both, and they are among the right
        // rasterizers here.
        let permitted = [TriangleMutant::BottomRightRule, TriangleMutant::ValuesThroughF32];
        let mut all = Vec::new();
        for mutant in TriangleMutant::ALL {
            if !permitted.contains(&mutant) {
                all.push(Self::Planted(mutant));
            }
        }
        for entry in &SPECIMENS {
            if let Some(Specimen::Triangle(specimen)) = entry.specimen {
                all.push(Self::Published(entry.name, specimen));
            }
        }
        for (name, permitted) in RIGHT {
            all.push(Self::Right(name, permitted));
        }
        all
    }

    /// Under this name it stands in the tables.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Reference => "scanline",
            Self::Planted(mutant) => mutant.name(),
            Self::Published(name, _) | Self::Right(name, _) => name,
        }
    }

    /// Whether what it draws is right by a permitted convention.
    #[must_use]
    pub fn is_right(&self) -> bool {
        matches!(self, Self::Reference | Self::Right(..))
    }

    /// Bits below the pixel, as a device reports them.
    pub fn subpixel_bits(&self) -> u32 {
        match self {
            Self::Right(_, permitted) => permitted.bits,
            _ => SUBPIXEL_BITS,
        }
    }

    /// Whether it declares that its values are computed in f32.
    #[must_use]
    pub fn is_single(&self) -> bool {
        matches!(self, Self::Right(_, Permitted { single: true, .. }))
    }

    /// Whether a scene is within its domain: f32 does not hold every w that f64 holds.
    #[must_use]
    pub fn can_draw(&self, scene: &Scene) -> bool {
        let mut vertices = scene.triangles.iter().flat_map(|triangle| &triangle.vertices);
        !self.is_single() || vertices.all(|vertex| (1e-30..1e30).contains(&vertex.inv_w))
    }

    /// The fill rule that a right rasterizer declares; the default one of all others.
    pub fn convention(&self) -> Convention {
        match self {
            Self::Right(_, permitted) => Convention::default().rule(permitted.rule),
            _ => Convention::default(),
        }
    }

    /// The triangle with its corners on the grid of the device, halves rounded towards larger coordinates.
    pub fn placed(&self, triangle: &Triangle) -> Triangle {
        let step = 1i64 << SUBPIXEL_BITS.saturating_sub(self.subpixel_bits());
        let mut placed = *triangle;
        for vertex in &mut placed.vertices {
            for at in [&mut vertex.position.x, &mut vertex.position.y] {
                let snapped = (i64::from(*at) + step / 2).div_euclid(step) * step;
                *at = snapped.clamp(i32::MIN.into(), i32::MAX.into()) as i32;
            }
        }
        placed
    }

    /// Emits its fragments of a triangle; `false` where it cannot draw it.
    fn fragments(
        &self,
        triangle: &Triangle,
        scene: &Scene,
        emit: &mut dyn FnMut(Fragment<DVec2>),
    ) -> bool {
        let window = scene.window;
        match self {
            Self::Reference => Engine::Scanline.fragments(triangle, window, emit),
            // Pixels of a triangle without area have no values, and are drawn where the scene shows no values.
            Self::Planted(mutant) if !scene.shows_values() => {
                let mut spans = Vec::new();
                mutant.spans(triangle.corners(), window, &mut |span| spans.push(span));
                fill(triangle, window, &spans, false, emit);
            }
            Self::Planted(mutant) => mutant.values(triangle, window, emit),
            Self::Published(_, specimen) => {
                let real = from_screen(triangle);
                if specimen.has_values() {
                    return specimen.fragments(&real, window, emit).is_ok();
                }
                let mut spans = Vec::new();
                let covered = specimen.cover(&real, window, &mut |span| spans.push(span)).is_ok();
                fill(triangle, window, &spans, false, emit);
                return covered;
            }
            Self::Right(_, permitted) => {
                let placed = self.placed(triangle);
                let mut spans = Vec::new();
                self.convention().cover(placed.corners(), window, |span| spans.push(span));
                fill(&placed, window, &spans, permitted.single, emit);
            }
        }
        true
    }
}

/// Fragments for the pixels of spans: the values of an engine where it has any, else those of [`at_pixel`].
fn fill(
    triangle: &Triangle,
    window: PixelRect,
    spans: &[Span],
    single: bool,
    emit: &mut dyn FnMut(Fragment<DVec2>),
) {
    // Pixels that the engine does not cover by its own rule have values of their own below.
    let mut known = HashMap::new();
    if !single {
        let mut keep = |f: Fragment<DVec2>| {
            known.insert((f.x_px, f.y_px), f);
        };
        Engine::EdgeFunction.fragments(triangle, window, &mut keep as &mut dyn FnMut(_));
    }
    for span in spans {
        for x_px in span.x0_px..span.x1_px {
            let fragment = known.get(&(x_px, span.y_px)).copied();
            emit(fragment.unwrap_or_else(|| at_pixel(triangle, [x_px, span.y_px], single)));
        }
    }
}

/// The values at the centre of a pixel: weights are areas, those of attributes divided by w. Colours have 8 bits, so
/// plain arithmetic suffices where f32 is not wanted.
fn at_pixel(triangle: &Triangle, [x_px, y_px]: [i32; 2], single: bool) -> Fragment<DVec2> {
    // A double has more than twice the digits of a float, so that a sum, product or quotient of floats that is rounded to a
    // double and then to a float is the same as one that is rounded to a float at once.
    let round = |v: f64| if single { f64::from(v as f32) } else { v };
    let centre =
        [x_px, y_px].map_array(|px| f64::from(px) + f64::from(HALF_PIXEL) / f64::from(SUBPIXELS));
    let v = &triangle.vertices;
    let px = v.each_ref().map_array(|v| {
        let (x, y) = v.position.to_px();
        [round(x - centre[0]), round(y - centre[1])]
    });
    // The area opposite to each corner.
    let mut areas = [0.0; 3];
    for (i, area) in areas.iter_mut().enumerate() {
        let ([ax, ay], [bx, by]) = (px[(i + 1) % 3], px[(i + 2) % 3]);
        *area = round(round(ax * by) - round(ay * bx));
    }
    let blend = |weights: [f64; 3], values: [f64; 3]| {
        let products = [0, 1, 2].map_array(|i| round(weights[i] * values[i]));
        let sum = round(round(weights[0] + weights[1]) + weights[2]);
        round(round(round(products[0] + products[1]) + products[2]) / sum)
    };
    let over_w = [0, 1, 2].map_array(|i| round(areas[i] * round(v[i].inv_w)));
    let varying = DVec2::new(
        blend(over_w, v.each_ref().map_array(|v| round(v.varying.x))),
        blend(over_w, v.each_ref().map_array(|v| round(v.varying.y))),
    );
    Fragment {
        x_px,
        y_px,
        depth: blend(areas, v.each_ref().map_array(|v| round(v.depth))),
        varying,
    }
}

/// A picture, and every fragment that went into it.
#[derive(Clone, Debug)]
pub struct Rendering {
    /// Pixels in a row; the rows follow each other without a gap.
    pub width: usize,
    pub pixels: Vec<[u8; 3]>,
    /// The number of its triangle, and the fragment, in drawing order.
    pub fragments: Vec<(usize, Fragment<DVec2>)>,
    /// Whether the program panicked, or what it does is undefined.
    pub failed: bool,
}

impl Rendering {
    /// A picture that was not drawn here.
    pub fn of(width: usize, pixels: Vec<[u8; 3]>) -> Self {
        Self { width, pixels, fragments: Vec::new(), failed: false }
    }
}

/// What comes of a scene where it is drawn by a rasterizer.
#[must_use]
pub fn draw(subject: &Rasterizer, scene: &Scene) -> Rendering {
    let mut fragments = Vec::new();
    // A fragment is kept with the number of its triangle; a program that panics has drawn what it drew before.
    let drawing = caught(|| {
        let mut is_drawn = true;
        for (i, triangle) in scene.triangles.iter().enumerate() {
            is_drawn =
                is_drawn && subject.fragments(triangle, scene, &mut |f| fragments.push((i, f)));
        }
        is_drawn
    });
    let (width, height) = (scene.window.width() as usize, scene.window.height() as usize);
    let mut drawn = Rendering {
        width,
        pixels: vec![[0; 3]; width * height],
        fragments,
        failed: !matches!(drawing, Ok(true)),
    };
    // Fragments become a picture in drawing order, nearer ones in front where the scene asks for a depth test.
    let mut nearest = vec![f64::INFINITY; width * height];
    for (_, fragment) in &drawn.fragments {
        // A pixel right of the window is the first of the next row, as in a buffer of rows one after the other.
        let x = i64::from(fragment.x_px) - i64::from(scene.window.x0);
        let y = i64::from(fragment.y_px) - i64::from(scene.window.y0);
        let place = usize::try_from(y * width as i64 + x).ok();
        let Some(place) = place.filter(|&place| place < nearest.len()) else { continue };
        if scene.depth_test && fragment.depth >= nearest[place] {
            continue;
        }
        nearest[place] = fragment.depth;
        drawn.pixels[place] = painted(scene.paint, drawn.pixels[place], fragment.varying);
    }
    drawn
}

/// The colour of a pixel after a fragment is drawn there.
fn painted(paint: Paint, under: [u8; 3], varying: DVec2) -> [u8; 3] {
    // A conversion to an integer saturates, and turns what is no number into 0.
    let byte = |v: f64| (v * 255.0 + 0.5) as u8;
    match paint {
        Paint::White => [255; 3],
        Paint::Add => under.map_array(|v| v.saturating_add(127)),
        Paint::Values => [varying.x, varying.y, 1.0 - varying.x - varying.y].map_array(byte),
        Paint::Checker => {
            let odd = ((varying.x * 8.0).floor() + (varying.y * 8.0).floor()) as i64 & 1;
            if odd == 1 { [230, 220, 190] } else { [40, 60, 90] }
        }
    }
}
