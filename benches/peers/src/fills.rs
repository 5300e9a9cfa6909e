//! Fills of the five classes of triangles, with one sample a pixel and antialiased.
//!
//! What is timed: filling every triangle of a class, one by one, with one opaque colour. What is
//! prepared before: each one's natural input, as corners on the lattice or as a path.
//!
//! - `scanline`, `edge-function`: the engines, as a loop over spans. `list`: [`paint::fill`].
//! - tiny-skia, raqote, Skia, Blend2D: a path for each triangle and one paint. Skia plays back a
//!   picture of a turn's paths, so that no call of Python is timed; Blend2D is called once for each.
//! - euc: one list of vertices in clip coordinates; culling, depth and varyings are off.
//! - vello_cpu: the paths of a turn and one rendering, which writes the whole target.
//! - zeno, ab_glyph_rasterizer (the algorithm of font-rs): a mask of the triangle's box, which
//!   the loop that antialiases for ours mixes into the target.
//!
//! All get the same numbers: positions are multiples of 1/256 px, and so exact as `f32`. Everyone
//! fills the same few triangles in turn, then the next few, so that a machine that changes its
//! clock or is shared treats all alike. A turn fills its triangles twice and times the second time,
//! with warm caches. Cold, the writes to memory cost everyone alike and the ratios are smaller.
//!
//! With one sample, pixels are counted against the oracle, triangle by triangle. Antialiased, the
//! alpha is compared with the exact area of the pixel that the triangle covers.

use std::ops::Range;
use std::time::Instant;

use ab_glyph_rasterizer::{Rasterizer, point};
use euc::Pipeline;
use euc::buffer::Buffer2d;
use euc::rasterizer::{BackfaceCullingDisabled, Triangles};
use rasterproof_core::contract::Rasterize;
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_core::raster::edge_function::EdgeFunction;
use rasterproof_core::raster::scanline::Scanline;
use rasterproof_core::triangle::Corners;
use rasterproof_precision::ladder::area;
use rasterproof_tiles::coverage::Tiles;
use rasterproof_tiles::paint::{self, fill_run};
use rasterproof_verify::oracle::Oracle;
use serde::Serialize;
use tiny_skia::{FillRule, Paint, PathBuilder, Pixmap, Transform};
use vello_cpu::kurbo::BezPath;

use crate::common::{self, COLOUR, SIDE_PX, Scene};
use crate::filler::Filler;
use crate::outside::Children;
use crate::spread::Spread;

/// Turns of everyone in a round, each with a part of the triangles. Turns of about a millisecond
/// and less mostly run undisturbed on a busy machine, whoever's they are.
const TURNS: usize = 8;
const SIDE: usize = SIDE_PX as usize;

/// Time and errors of one renderer in one class.
#[derive(Serialize)]
pub struct Row {
    pub class: &'static str,
    pub triangles: usize,
    pub pixels: u64,
    pub name: String,
    /// Nanoseconds of all triangles of the class together.
    pub ns: Spread,
    pub errors: Errors,
}

#[derive(Serialize, Debug, PartialEq)]
#[serde(rename_all = "snake_case")]
pub enum Errors {
    /// With one sample a pixel, against the oracle.
    Pixels { missing: u64, extra: u64 },
    /// Antialiased, in steps of 1/255: the root of the mean square over the pixels that an edge
    /// passes through, and the largest.
    Areas { rms: f64, worst: f64 },
}

/// Those of this process.
fn candidates(scene: &Scene) -> Vec<Candidate<'_>> {
    let engine = |name, filler| Candidate { name: String::from(name), smooth: false, filler };
    let mut all = vec![
        engine("scanline", Box::new(Engine::new(Scanline, scene)) as Box<dyn Filler>),
        engine("edge-function", Box::new(Engine::new(EdgeFunction, scene))),
        engine("list", Box::new(List::new(scene))),
    ];
    for smooth in [false, true] {
        let mut add = |name: &str, filler| {
            all.push(Candidate { name: name.to_owned(), smooth, filler });
        };
        add("tiny-skia", Box::new(TinySkia::new(scene, smooth)));
        add("raqote", Box::new(Raqote::new(scene, smooth)));
        add("vello_cpu", Box::new(Vello::new(scene, smooth)));
        if smooth {
            add("4 x 4 samples", Box::new(SampledScanline::new(scene)));
            add("exact area", Box::new(Areas::new(scene)));
            add("zeno", Box::new(Zeno::new(scene)));
            add("ab_glyph_rasterizer", Box::new(AbGlyph::new(scene)));
        } else {
            add("euc", Box::new(Euc::new(scene)));
        }
    }
    all
}

pub fn measure(scene: &Scene, rounds: usize, children: &mut Children) -> Vec<Row> {
    let mut all = candidates(scene);
    all.extend(children.fillers(scene).into_iter().map(|(name, smooth, child)| Candidate {
        name,
        smooth,
        filler: Box::new(child),
    }));
    all.sort_by_key(|candidate| candidate.smooth);
    let errors: Vec<Errors> = all.iter_mut().map(|candidate| candidate.errors(scene)).collect();
    for (candidate, errors) in all.iter().zip(&errors).take(3) {
        let none = Errors::Pixels { missing: 0, extra: 0 };
        assert_eq!(*errors, none, "{} on {}", candidate.name, scene.name);
    }
    let times = times(&mut all, scene.triangles.len(), rounds);
    let rows = all.into_iter().zip(times).zip(errors);
    rows.map(|((Candidate { name, .. }, ns), errors)| Row {
        class: scene.name,
        triangles: scene.triangles.len(),
        pixels: scene.pixels(),
        name,
        ns,
        errors,
    })
    .collect()
}

/// Fills a class so often, antialiased where there are both, by someone of this process.
pub fn only(class: &str, name: &str, count: u32) -> Result<(), String> {
    let scenes = common::scenes();
    let scene = scenes.iter().find(|scene| scene.name == class);
    let scene = scene.ok_or_else(|| format!("{class} is no class"))?;
    let mut all = candidates(scene).into_iter().rev();
    let found = all.find(|candidate| candidate.name == name);
    let mut found = found.ok_or_else(|| format!("{name} does not fill in this process"))?;
    (0..count).for_each(|_| _ = found.filler.time_ns(0..scene.triangles.len()));
    Ok(())
}

struct Candidate<'a> {
    name: String,
    smooth: bool,
    filler: Box<dyn Filler + 'a>,
}

/// Everyone's time for all triangles: the sums of the quartiles of their turns.
fn times(all: &mut [Candidate<'_>], triangles: usize, rounds: usize) -> Vec<Spread> {
    let mut turns = vec![vec![Vec::new(); all.len()]; TURNS];
    for _ in 0..rounds {
        for (turn, times) in turns.iter_mut().enumerate() {
            let part = triangles * turn / TURNS..triangles * (turn + 1) / TURNS;
            for (candidate, times) in all.iter_mut().zip(times) {
                times.push(candidate.filler.time_ns(part.clone()));
            }
        }
    }
    let of = |i: usize| turns.iter().map(|times| Spread::of(&times[i])).sum();
    (0..all.len()).map(of).collect()
}

/// One in this process, with a target of its own.
trait Local {
    fn fill(&mut self, part: Range<usize>);
    /// The alpha of a pixel, row by row.
    fn alpha(&self, index: usize) -> u8;
    fn erase(&mut self, index: usize);
}

impl<T: Local> Filler for T {
    fn time_ns(&mut self, part: Range<usize>) -> f64 {
        // What the others left in the caches is not timed.
        self.fill(part.clone());
        let start = Instant::now();
        self.fill(part);
        start.elapsed().as_nanos() as f64
    }

    fn take(&mut self, triangle: usize, rect: PixelRect) -> Vec<u8> {
        self.fill(triangle..triangle + 1);
        let columns = rect.x0 as usize..rect.x1 as usize;
        let rows = rect.y0 as usize..rect.y1 as usize;
        let indices = rows.flat_map(|y| columns.clone().map(move |x| y * SIDE + x));
        indices
            .map(|index| {
                let alpha = self.alpha(index);
                self.erase(index);
                alpha
            })
            .collect()
    }

    fn left(&mut self) -> u64 {
        (0..SIDE * SIDE).filter(|&index| self.alpha(index) != 0).count() as u64
    }
}

impl Candidate<'_> {
    /// Looks at each triangle by itself, so that no error hides below another triangle.
    fn errors(&mut self, scene: &Scene) -> Errors {
        let (mut missing, mut extra) = (0, 0);
        let (mut squares, mut edges, mut worst) = (0.0, 0u64, 0.0_f64);
        for (index, corners) in scene.triangles.iter().enumerate() {
            let near = neighbourhood(corners);
            let drawn = self.filler.take(index, near);
            if self.smooth {
                let mut truth = Frame::new(near, 0.0);
                area::shares(corners, near, |Range { start, end }, y_px, share| {
                    truth.span_mut(y_px, start, end).fill(share);
                });
                let shares = truth.rows().flat_map(|(_, row)| row);
                for (&share, alpha) in shares.zip(drawn) {
                    let error = (f64::from(alpha) - share * 255.0).abs();
                    worst = worst.max(error);
                    // Outside, what was drawn counts as well.
                    if share > 0.0 && share < 1.0 || error > 0.0 {
                        squares += error * error;
                        edges += 1;
                    }
                }
            } else {
                let mut truth = Frame::new(near, false);
                Oracle.cover(*corners, near, |span| {
                    truth.span_mut(span.y_px, span.x0_px, span.x1_px).fill(true)
                });
                let covered = truth.rows().flat_map(|(_, row)| row);
                for (&covered, alpha) in covered.zip(drawn) {
                    missing += u64::from(covered && alpha == 0);
                    extra += u64::from(alpha != 0 && !covered);
                }
            }
        }
        // What was drawn beyond the neighbourhoods is still there.
        let left = self.filler.left();
        if self.smooth {
            assert_eq!(left, 0, "{} draws far from its triangles", self.name);
            return Errors::Areas { rms: (squares / edges.max(1) as f64).sqrt(), worst };
        }
        Errors::Pixels { missing, extra: extra + left }
    }
}

/// The pixels around a triangle where errors are expected, two pixels beyond its bounding box.
fn neighbourhood(corners: &Corners) -> PixelRect {
    let range = |subs: [i32; 3]| {
        let [low, high] =
            [subs.iter().min(), subs.iter().max()].map(|sub| sub.map_or(0, |sub| sub >> 8));
        (low - 2, high + 3)
    };
    let (x0, x1) = range(corners.map(|corner| corner.x));
    let (y0, y1) = range(corners.map(|corner| corner.y));
    PixelRect { x0, y0, x1, y1 }.intersect(&common::window())
}

/// A target of packed pixels, as ours and those of masks have it.
struct Canvas(Frame<u32>);

impl Canvas {
    fn new() -> Self {
        Self(Frame::new(common::window(), 0))
    }

    fn alpha(&self, index: usize) -> u8 {
        (self.0.row((index / SIDE) as i32)[index % SIDE] >> 24) as u8
    }

    fn erase(&mut self, index: usize) {
        self.0.row_mut((index / SIDE) as i32)[index % SIDE] = 0;
    }
}

/// The colour over a pixel, with an alpha of 0 to 255, in the arithmetic of premultiplied bytes.
#[inline]
fn mix(pixel: &mut u32, alpha: u8) {
    match alpha {
        0 => {}
        255 => *pixel = COLOUR,
        _ => *pixel = scaled(COLOUR, u32::from(alpha)) + scaled(*pixel, 255 - u32::from(alpha)),
    }
}

/// Pixels beside each other: what covers them hides what was there.
#[inline]
fn mix_run(pixels: &mut [u32], alpha: u8) {
    match alpha {
        255 => fill_run(pixels, COLOUR),
        _ => pixels.iter_mut().for_each(|pixel| mix(pixel, alpha)),
    }
}

/// Four bytes times a share of 255, each rounded to the nearest.
#[inline]
fn scaled(pixel: u32, share: u32) -> u32 {
    // x / 255 is (x + 128 + (x + 128) / 256) / 256, two bytes at a time.
    let two = |bytes: u32| {
        let x = bytes * share + 0x80_0080;
        ((x + (x >> 8 & 0xff_00ff)) >> 8) & 0xff_00ff
    };
    two(pixel & 0xff_00ff) | two(pixel >> 8 & 0xff_00ff) << 8
}

macro_rules! on_a_canvas {
    () => {
        fn alpha(&self, index: usize) -> u8 {
            self.target.alpha(index)
        }
        fn erase(&mut self, index: usize) {
            self.target.erase(index);
        }
    };
}

struct Engine<E> {
    engine: E,
    triangles: Vec<Corners>,
    target: Canvas,
}

impl<E: Rasterize> Engine<E> {
    fn new(engine: E, scene: &Scene) -> Self {
        Self { engine, triangles: scene.triangles.clone(), target: Canvas::new() }
    }
}

impl<E: Rasterize> Local for Engine<E> {
    fn fill(&mut self, part: Range<usize>) {
        for corners in &self.triangles[part] {
            common::fill(&self.engine, *corners, &mut self.target.0);
        }
    }
    on_a_canvas!();
}

struct List {
    tiles: Tiles,
    triangles: Vec<Corners>,
    target: Canvas,
}

impl List {
    fn new(scene: &Scene) -> Self {
        Self { tiles: Tiles::default(), triangles: scene.triangles.clone(), target: Canvas::new() }
    }
}

impl Local for List {
    fn fill(&mut self, part: Range<usize>) {
        paint::fill(&self.tiles, &self.triangles[part], COLOUR, &mut self.target.0);
    }
    on_a_canvas!();
}

/// The scanline on a grid four times as fine, its pixels counted.
struct SampledScanline {
    triangles: Vec<Corners>,
    /// Samples of a row of pixels, and the pixels in which there are any.
    row: Vec<u8>,
    target: Canvas,
}

impl SampledScanline {
    fn new(scene: &Scene) -> Self {
        let finer = |p: SubpixelPoint| SubpixelPoint::new(4 * p.x, 4 * p.y);
        let triangles = scene.triangles.iter().map(|corners| corners.map(finer)).collect();
        Self { triangles, row: vec![0; SIDE], target: Canvas::new() }
    }
}

/// The row of pixels that is counted.
struct CountedRow {
    y_px: i32,
    /// From the first column that has a sample past the last one.
    touched: [usize; 2],
    /// Rows of samples so far, and the columns of which they have all.
    rows: u32,
    whole: [usize; 2],
}

impl CountedRow {
    fn new(y_px: i32) -> Self {
        Self { y_px, touched: [SIDE, 0], rows: 0, whole: [0, SIDE] }
    }

    /// Mixes the samples into the target and forgets them.
    fn mix(&self, row: &mut [u8], target: &mut Canvas) {
        let [x0, x1] = self.touched;
        if x0 >= x1 {
            return;
        }
        let [from, to] = self.whole;
        let [from, to] = if self.rows == 4 && from < to { [from, to] } else { [x1; 2] };
        let pixels = target.0.row_mut(self.y_px);
        mix_run(&mut pixels[from..to], 255);
        for part in [x0..from, to..x1] {
            for (count, pixel) in row[part.clone()].iter().zip(&mut pixels[part]) {
                mix(pixel, (u32::from(*count) * 255 / 16) as u8);
            }
        }
        row[x0..x1].fill(0);
    }
}

impl Local for SampledScanline {
    fn fill(&mut self, part: Range<usize>) {
        let Self { triangles, row, target } = self;
        let bounds = PixelRect::window(4 * SIDE_PX, 4 * SIDE_PX);
        for corners in &triangles[part] {
            let mut counted = CountedRow::new(0);
            Scanline.cover(*corners, bounds, |span| {
                if span.y_px >> 2 != counted.y_px {
                    counted.mix(row, target);
                    counted = CountedRow::new(span.y_px >> 2);
                }
                let (x0, x1) = (span.x0_px as usize, span.x1_px as usize);
                let (first, last) = (x0 >> 2, (x1 - 1) >> 2);
                let CountedRow { touched, rows, whole, .. } = &mut counted;
                *touched = [touched[0].min(first), touched[1].max(last + 1)];
                *rows += 1;
                *whole = [whole[0].max((x0 + 3) >> 2), whole[1].min(x1 >> 2)];
                row[first..=last].iter_mut().for_each(|count| *count += 4);
                row[first] -= (x0 & 3) as u8;
                row[last] -= (3 - ((x1 - 1) & 3)) as u8;
            });
            counted.mix(row, target);
        }
    }
    on_a_canvas!();
}

/// The exact area of each pixel that is covered, rounded to 1/255.
struct Areas {
    triangles: Vec<Corners>,
    target: Canvas,
}

impl Areas {
    fn new(scene: &Scene) -> Self {
        Self { triangles: scene.triangles.clone(), target: Canvas::new() }
    }
}

impl Local for Areas {
    fn fill(&mut self, part: Range<usize>) {
        for corners in &self.triangles[part] {
            area::shares(corners, common::window(), |Range { start, end }, y_px, share| {
                let alpha = (share * 255.0 + 0.5) as u8;
                mix_run(self.target.0.span_mut(y_px, start, end), alpha);
            });
        }
    }
    on_a_canvas!();
}

struct TinySkia {
    paths: Vec<tiny_skia::Path>,
    paint: Paint<'static>,
    target: Pixmap,
}

impl TinySkia {
    fn new(scene: &Scene, smooth: bool) -> Self {
        let path = |corners: &Corners| {
            let [a, b, c] = corners.map(exact_f32);
            let mut builder = PathBuilder::new();
            builder.move_to(a[0], a[1]);
            builder.line_to(b[0], b[1]);
            builder.line_to(c[0], c[1]);
            builder.close();
            builder.finish().expect("three finite corners make a path")
        };
        let mut paint = Paint { anti_alias: smooth, ..Paint::default() };
        let [r, g, b, a] = COLOUR.to_le_bytes();
        paint.set_color_rgba8(r, g, b, a);
        let target = Pixmap::new(SIDE_PX, SIDE_PX).expect("a side within tiny-skia's range");
        Self { paths: scene.triangles.iter().map(path).collect(), paint, target }
    }
}

impl Local for TinySkia {
    fn fill(&mut self, part: Range<usize>) {
        // The view of the target is made once, as a user would who draws many shapes.
        let mut target = self.target.as_mut();
        for path in &self.paths[part] {
            target.fill_path(path, &self.paint, FillRule::Winding, Transform::identity(), None);
        }
    }
    fn alpha(&self, index: usize) -> u8 {
        self.target.data()[4 * index + 3]
    }
    fn erase(&mut self, index: usize) {
        self.target.data_mut()[4 * index..][..4].fill(0);
    }
}

struct Raqote {
    paths: Vec<raqote::Path>,
    options: raqote::DrawOptions,
    target: raqote::DrawTarget,
}

impl Raqote {
    fn new(scene: &Scene, smooth: bool) -> Self {
        let path = |corners: &Corners| {
            let [a, b, c] = corners.map(exact_f32);
            let mut path = raqote::PathBuilder::new();
            path.move_to(a[0], a[1]);
            path.line_to(b[0], b[1]);
            path.line_to(c[0], c[1]);
            path.close();
            path.finish()
        };
        let antialias =
            if smooth { raqote::AntialiasMode::Gray } else { raqote::AntialiasMode::None };
        let options = raqote::DrawOptions { antialias, ..raqote::DrawOptions::new() };
        let target = raqote::DrawTarget::new(SIDE_PX as i32, SIDE_PX as i32);
        Self { paths: scene.triangles.iter().map(path).collect(), options, target }
    }
}

impl Local for Raqote {
    fn fill(&mut self, part: Range<usize>) {
        let [r, g, b, a] = COLOUR.to_le_bytes();
        let source = raqote::Source::Solid(raqote::SolidSource { r, g, b, a });
        for path in &self.paths[part] {
            self.target.fill(path, &source, &self.options);
        }
    }
    fn alpha(&self, index: usize) -> u8 {
        (self.target.get_data()[index] >> 24) as u8
    }
    fn erase(&mut self, index: usize) {
        self.target.get_data_mut()[index] = 0;
    }
}

struct Vello {
    paths: Vec<BezPath>,
    smooth: bool,
    context: vello_cpu::RenderContext,
    resources: vello_cpu::Resources,
    target: vello_cpu::Pixmap,
}

impl Vello {
    fn new(scene: &Scene, smooth: bool) -> Self {
        let path = |corners: &Corners| {
            let [a, b, c] = corners.map(|corner| corner.to_px());
            let mut path = BezPath::new();
            path.move_to(a);
            path.line_to(b);
            path.line_to(c);
            path.close_path();
            path
        };
        let side = SIDE_PX as u16;
        Self {
            paths: scene.triangles.iter().map(path).collect(),
            smooth,
            context: vello_cpu::RenderContext::new(side, side),
            resources: vello_cpu::Resources::new(),
            target: vello_cpu::Pixmap::new(side, side),
        }
    }
}

impl Local for Vello {
    fn fill(&mut self, part: Range<usize>) {
        self.context.reset();
        // A pixel is drawn if half of it is covered: this is not a sample, and counted as it is.
        self.context.set_aliasing_threshold((!self.smooth).then_some(127));
        let [r, g, b, a] = COLOUR.to_le_bytes();
        self.context.set_paint(vello_cpu::color::AlphaColor::from_rgba8(r, g, b, a));
        for path in &self.paths[part] {
            self.context.fill_path(path);
        }
        self.context.flush();
        self.context.render(&mut self.target, &mut self.resources);
    }
    fn alpha(&self, index: usize) -> u8 {
        self.target.data()[index].a
    }
    /// The next rendering writes every pixel.
    fn erase(&mut self, index: usize) {
        self.target.data_mut()[index].a = 0;
    }
}

struct Zeno {
    paths: Vec<[zeno::Command; 4]>,
    scratch: zeno::Scratch,
    mask: Vec<u8>,
    target: Canvas,
}

impl Zeno {
    fn new(scene: &Scene) -> Self {
        use zeno::Command::{Close, LineTo, MoveTo};
        let path = |corners: &Corners| {
            let [a, b, c] = corners.map(exact_f32).map(|[x, y]| zeno::Vector::new(x, y));
            [MoveTo(a), LineTo(b), LineTo(c), Close]
        };
        Self {
            paths: scene.triangles.iter().map(path).collect(),
            scratch: zeno::Scratch::new(),
            mask: Vec::new(),
            target: Canvas::new(),
        }
    }
}

impl Local for Zeno {
    fn fill(&mut self, part: Range<usize>) {
        let Self { paths, scratch, mask, target } = self;
        for path in &paths[part] {
            let mut drawn = zeno::Mask::with_scratch(&path[..], scratch);
            drawn.inspect(|_, width, height| {
                mask.clear();
                mask.resize((width * height) as usize, 0);
            });
            let place = drawn.render_into(mask, None);
            let (x0, width) = (place.left as usize, place.width as usize);
            for (y, row) in (place.top..).zip(mask.chunks(width)) {
                let pixels = &mut target.0.row_mut(y)[x0..x0 + width];
                pixels.iter_mut().zip(row).for_each(|(pixel, alpha)| mix(pixel, *alpha));
            }
        }
    }
    on_a_canvas!();
}

struct AbGlyph {
    triangles: Vec<Corners>,
    rasterizer: Rasterizer,
    target: Canvas,
}

impl AbGlyph {
    fn new(scene: &Scene) -> Self {
        Self {
            triangles: scene.triangles.clone(),
            rasterizer: Rasterizer::new(0, 0),
            target: Canvas::new(),
        }
    }
}

impl Local for AbGlyph {
    fn fill(&mut self, part: Range<usize>) {
        let Self { triangles, rasterizer, target } = self;
        for corners in &triangles[part] {
            let [xs, ys] = [corners.map(|p| p.x), corners.map(|p| p.y)];
            let low = |[a, b, c]: [i32; 3]| a.min(b).min(c) >> 8;
            let size = |v: [i32; 3]| (((v[0].max(v[1]).max(v[2]) + 255) >> 8) - low(v)) as usize;
            let (x0, y0) = (low(xs), low(ys));
            rasterizer.reset(size(xs), size(ys));
            let [a, b, c] =
                corners.map(exact_f32).map(|[x, y]| point(x - x0 as f32, y - y0 as f32));
            rasterizer.draw_line(a, b);
            rasterizer.draw_line(b, c);
            rasterizer.draw_line(c, a);
            rasterizer.for_each_pixel_2d(|x, y, share| {
                let alpha = (share.min(1.0) * 255.0 + 0.5) as u8;
                mix(&mut target.0.row_mut(y0 + y as i32)[x0 as usize + x as usize], alpha);
            });
        }
    }
    on_a_canvas!();
}

struct Euc {
    vertices: Vec<[f32; 2]>,
    target: Buffer2d<u32>,
}

/// euc's stages: positions are in clip coordinates already, and every fragment has one colour.
struct Flat;

impl Pipeline for Flat {
    type Vertex = [f32; 2];
    type VsOut = ();
    type Pixel = u32;

    #[inline(always)]
    fn vert(&self, [x, y]: &[f32; 2]) -> ([f32; 4], ()) {
        ([*x, *y, 0.0, 1.0], ())
    }
    #[inline(always)]
    fn frag(&self, (): &()) -> u32 {
        COLOUR
    }
    #[inline(always)]
    fn get_depth_strategy(&self) -> euc::DepthStrategy {
        euc::DepthStrategy::None
    }
}

impl Euc {
    fn new(scene: &Scene) -> Self {
        // The side is a power of two, so this is exact too: euc's errors are its own.
        let half = SIDE_PX as f32 / 2.0;
        let vertex = |corner| {
            let [x, y] = exact_f32(corner);
            [x / half - 1.0, 1.0 - y / half]
        };
        let vertices = scene.triangles.iter().flatten().map(|corner| vertex(*corner)).collect();
        Self { vertices, target: Buffer2d::new([SIDE, SIDE], 0) }
    }
}

impl Local for Euc {
    fn fill(&mut self, part: Range<usize>) {
        let vertices = &self.vertices[3 * part.start..3 * part.end];
        Flat.draw::<Triangles<Buffer2d<f32>, BackfaceCullingDisabled>, _>(
            vertices,
            &mut self.target,
            None,
        );
    }
    fn alpha(&self, index: usize) -> u8 {
        (self.target.as_ref()[index] >> 24) as u8
    }
    fn erase(&mut self, index: usize) {
        self.target.as_mut()[index] = 0;
    }
}

/// A corner in pixels: at most 10 bits before the point and 8 behind it, exact in 24.
fn exact_f32(corner: SubpixelPoint) -> [f32; 2] {
    let (x, y) = corner.to_px();
    [x as f32, y as f32]
}
