//! The two groups of coverage: how many pixels a choice gets wrong, and what it takes.
//!
//! Wrong pixels are counted against two truths, both by the oracle: the triangle as it was given,
//! and the triangle with its corners snapped to 1/256 px. Choices on the lattice are exact against the
//! latter; what they show against the former is the price of snapping, an error of the input.

use std::cell::{OnceCell, RefCell};
use std::rc::Rc;

use super::entry::{Canvas, Entry, PreparedColumns, classes};
use super::scene::Scene;
use super::tiles::Lists;
use super::{Choice, Clock, CostOptions, Details, Ladder, Name, Pass, Run};
use crate::ladder::edges::{self, Integer, Ordered, Robust, Stepped};
use crate::ladder::scanline::{self, Accumulated, BigIntegers};
use crate::ladder::{Cover, Snapped, Unsnapped, Work, snap};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::{Rasterize, RasterizeExact};
use rasterproof_core::grid::PixelRect;
use rasterproof_core::raster::edge_function::EdgeFunction;
use rasterproof_core::raster::edge_function_exact::EdgeFunctionExact;
use rasterproof_core::raster::scanline::Scanline;
use rasterproof_core::raster::scanline_exact::ScanlineExact;
use rasterproof_core::triangle::{Corners, FreeCorners, Span};
use rasterproof_faults::published::book_triangle::BookChapter2;
use rasterproof_faults::published::{Published, bare};
use rasterproof_verify::oracle::Oracle;

/// Errors of coverage, by their number in [`Board::measures`](super::Board).
pub const GIVEN: usize = 0;
/// The measure of the error against the corners once they are snapped.
pub const SNAPPED: usize = 1;
const HOLES: usize = 2;
const TWICE: usize = 3;

#[derive(Clone, Copy, Debug)]
struct AsPublished(BookChapter2);

impl Cover for AsPublished {
    fn accepts(&self, free: &FreeCorners, bounds: PixelRect) -> Result<(), String> {
        self.0.cover(&bare(free.px()), bounds, &mut |_| ()).map_err(|refused| refused.to_string())
    }

    fn cover(&self, free: &FreeCorners, bounds: PixelRect, emit: impl FnMut(Span)) -> Option<Work> {
        // What it refuses was refused before; see `accepts`.
        let _ = self.0.cover_inlined(&bare(free.px()), bounds, emit);
        None
    }
}

/// Somebody who fills triangles, such as a graphics card, and is judged and timed as the choices are.
pub trait ExternalChoice {
    fn choice(&self) -> Choice;

    fn spans(
        &mut self,
        triangles: &[FreeCorners],
        bounds: PixelRect,
    ) -> Result<Vec<Vec<Span>>, String>;

    /// Gets ready to fill all of them; what is returned does so, and is timed.
    fn pass(
        &mut self,
        triangles: &[FreeCorners],
        bounds: PixelRect,
    ) -> Result<Box<dyn FnMut()>, String>;
}

/// Triangles that choices are given.
pub struct Input {
    scene: Scene,
    /// Takes long, and is made when the first choice is judged.
    truth: OnceCell<Truth>,
    canvas: Canvas<u32>,
}

impl Input {
    #[must_use]
    pub fn new(scene: Scene) -> Self {
        Self { truth: OnceCell::new(), canvas: Canvas::new(scene.bounds), scene }
    }

    fn truth(&self) -> &Truth {
        self.truth.get_or_init(|| Truth::of(&self.scene))
    }
}

/// Lists the pixels of a triangle as a choice sees it, and returns its counted work.
type Draw<'a> = &'a dyn Fn(&FreeCorners, PixelRect, &mut Vec<Span>) -> Result<Option<Work>, String>;

/// Two closures of each choice alone are compiled for it; all that counts is compiled once.
fn entry(
    name: &'static str,
    about: impl Into<Name>,
    promises: &[usize],
    body: impl Cover + Copy + 'static,
) -> Entry<Input> {
    let own_truth = usize::from(promises.contains(&SNAPPED));
    Entry::new(
        Choice::new(name, about, promises),
        move |input| {
            judge(input, own_truth, &|corners, bounds, spans| {
                body.accepts(corners, bounds)?;
                Ok(body.cover(corners, bounds, |span| spans.push(span)))
            })
        },
        move |Input { scene, canvas, .. }| {
            Ok(canvas.pass(move |target| {
                body.paint(std::hint::black_box(&scene.triangles), scene.bounds, target);
            }))
        },
    )
}

/// An external choice beside the others.
pub(super) fn external(other: Box<dyn ExternalChoice>) -> Entry<Input> {
    let choice = other.choice();
    let other = Rc::new(RefCell::new(other));
    let timed = Rc::clone(&other);
    Entry::new(
        choice,
        move |input: &Input| {
            let scene = &input.scene;
            let spans = other.borrow_mut().spans(&scene.triangles, scene.bounds)?;
            Ok(score(&spans, input, GIVEN))
        },
        move |Input { scene, .. }| {
            // A device works while the processor waits.
            let pass = timed.borrow_mut().pass(&scene.triangles, scene.bounds)?;
            Ok(Pass::new(pass).by(Clock::Wall))
        },
    )
}

/// The choices of one of the two groups.
#[must_use]
pub fn choices(ladder: Ladder) -> Vec<Entry<Input>> {
    match ladder {
        Ladder::Scanline => vec![
            entry("book", "as published, section 2.2, f64", &[], AsPublished(BookChapter2)),
            entry("f32 accumulated", "x += slope", &[], Accumulated::<f32>::default()),
            entry("f32 direct", CROSSING, &[], scanline::Direct::<f32>::default()),
            entry("f64 accumulated", "x += slope", &[], Accumulated::<f64>::default()),
            entry("f64 direct", CROSSING, &[], scanline::Direct::<f64>::default()),
            entry("24.8 DDA", "snaps; the engine scanline", &[SNAPPED], Snapped(Scanline)),
            entry("adaptive", "the engine scanline-exact", &[GIVEN], Unsnapped(ScanlineExact)),
            entry("big integers", "every crossing an exact quotient", &[GIVEN], BigIntegers),
        ],
        Ladder::EdgeFunction => vec![
            entry("f32 stepped", "E += step", &[], Stepped::<f32>::default()),
            entry("f32 direct", "E at every sample", &[], edges::Direct::<f32>::default()),
            entry("f32 ordered", "direct, from the smaller end", &[], Ordered::<f32>::default()),
            entry("f64 stepped", "E += step", &[], Stepped::<f64>::default()),
            entry("f64 direct", "E at every sample", &[], edges::Direct::<f64>::default()),
            entry("f64 ordered", "direct, from the smaller end", &[], Ordered::<f64>::default()),
            entry("i32", "snaps; E' stepped", &[SNAPPED], Integer::<i64, i32>::default()),
            entry("i64", "snaps; E' stepped", &[SNAPPED], Integer::<i64, i64>::default()),
            entry("i128", "snaps; E' stepped", &[SNAPPED], Integer::<i128, i128>::default()),
            entry("engine", BY_WIDTH, &[SNAPPED], Snapped(EdgeFunction)),
            tiles(),
            entry("adaptive", BY_FILTER, &[GIVEN], Unsnapped(EdgeFunctionExact)),
            entry("robust", "orient2d at every sample", &[GIVEN], Robust),
        ],
        _ => Vec::new(),
    }
}

/// The choice that holds all snapped corners at once.
fn tiles() -> Entry<Input> {
    let lists = Lists::default();
    let mut entry = entry("tiles i32 x 16", lists.about(), &[SNAPPED], lists);
    entry.choice.bytes[1] = size_of::<Corners>() as u64;
    entry
}

const CROSSING: &str = "x = ax + (yc - ay) dx / dy";
const BY_WIDTH: &str = "snaps; the engine edge-function, width by triangle";
const BY_FILTER: &str = "the engine edge-function-exact";

/// The spans of each triangle of a scene by both truths, as given and as snapped, and their pixels.
struct Truth {
    spans: Vec<[Vec<Span>; 2]>,
    pixels: [u64; 2],
}

impl Truth {
    fn of(scene: &Scene) -> Self {
        let mut truth = Self { spans: Vec::new(), pixels: [0; 2] };
        for free in &scene.triangles {
            let [mut given, mut snapped] = [Vec::new(), Vec::new()];
            Oracle.cover_exact(free, scene.bounds, |span| given.push(span));
            if let Some(corners) = snap(free) {
                Oracle.cover(corners, scene.bounds, |span| snapped.push(span));
            }
            let spans = [given, snapped];
            for (sum, spans) in truth.pixels.iter_mut().zip(&spans) {
                *sum += spans.iter().map(Span::pixels).sum::<usize>() as u64;
            }
            truth.spans.push(spans);
        }
        truth
    }
}

/// Differences of hit counts, summed over the pixels of `a` and `b`, and the first pixel that has one.
fn wrong_pixels(a: &[Span], b: &[Span]) -> (u64, Option<[i32; 2]>) {
    let (mut wrong, mut first) = (0, None);
    sweep(&[a, b], |hits, start, length| {
        let difference = u64::from(hits[0].abs_diff(hits[1]));
        wrong += difference * length;
        first = first.or((difference > 0).then_some(start));
    });
    (wrong, first)
}

/// Visits maximal runs of pixels that every list hits equally often, in order: hits by list, the first pixel, and the length.
fn sweep<const N: usize>(lists: &[&[Span]; N], mut visit: impl FnMut([u32; N], [i32; 2], u64)) {
    let mut events: Vec<(i32, i32, usize, bool)> = Vec::new();
    for (i, list) in lists.iter().enumerate() {
        for span in *list {
            events.push((span.y_px, span.x0_px, i, true));
            events.push((span.y_px, span.x1_px, i, false));
        }
    }
    events.sort_unstable();
    let mut hits = [0; N];
    let mut last = (0, 0);
    for (y_px, x_px, list, begins) in events {
        // Every span ends in its row, so nothing is open where the row changes.
        if y_px == last.0 && x_px > last.1 {
            visit(hits, [last.1, y_px], u64::from(x_px.abs_diff(last.1)));
        }
        // Where one span ends and the next begins, the end sorts first; both count before any visit.
        hits[list] = if begins { hits[list] + 1 } else { hits[list] - 1 };
        last = (y_px, x_px);
    }
}

/// Holes and double hits inside the mesh, where both truths hit once. At its outline a missing pixel
/// is wrong, but no crack.
fn cracks(truth: &Truth, spans: &[Vec<Span>], interior: PixelRect) -> (u64, u64) {
    let within = |span: &Span| {
        let (x0_px, x1_px) = (span.x0_px.max(interior.x0), span.x1_px.min(interior.x1));
        let shown = (interior.y0..interior.y1).contains(&span.y_px) && x0_px < x1_px;
        shown.then_some(Span { y_px: span.y_px, x0_px, x1_px })
    };
    let by_truth = |i: usize| truth.spans.iter().flat_map(move |of| &of[i]).filter_map(within);
    let [given, snapped] = [0, 1].map_array(|i| by_truth(i).collect::<Vec<_>>());
    let ours: Vec<Span> = spans.iter().flatten().filter_map(within).collect();
    let (mut holes, mut twice) = (0, 0);
    sweep(&[&given[..], &snapped, &ours], |[given, snapped, hits], _, length| {
        if given == 1 && snapped == 1 {
            holes += if hits == 0 { length } else { 0 };
            twice += if hits > 1 { length } else { 0 };
        }
    });
    (holes, twice)
}

fn judge(input: &Input, own_truth: usize, draw: Draw<'_>) -> Result<Run, String> {
    let mut work = Some(Work::default());
    let mut spans = Vec::new();
    for corners in &input.scene.triangles {
        let mut of_this = Vec::new();
        let counted = draw(corners, input.scene.bounds, &mut of_this)?;
        work = work.zip(counted).map(|(sum, counted)| sum + counted);
        spans.push(of_this);
    }
    Ok(Run { work, ..score(&spans, input, own_truth) })
}

/// What is wrong of each triangle. A choice that snaps has first and single wrong pixels by what it was given after that.
fn score(spans: &[Vec<Span>], input: &Input, own_truth: usize) -> Run {
    let truth = input.truth();
    let mut found = Details::default();
    for (number, (ours, truths)) in (0..).zip(spans.iter().zip(&truth.spans)) {
        let wrong = truths.each_ref().map_array(|truth| wrong_pixels(ours, truth));
        found.pixels = [0, 1].map_array(|i| found.pixels[i] + wrong[i].0);
        let (own, first) = wrong[own_truth];
        if own > 0 {
            found.wrong.push(([number; 2], own));
            found.first = found.first.or(first.map(|pixel| (Some(number), pixel)));
        }
    }
    let per_million = |i: usize| found.pixels[i] as f64 * 1e6 / truth.pixels[i].max(1) as f64;
    let mut errors = vec![Some(per_million(0)), Some(per_million(1)), None, None];
    if let Some(interior) = input.scene.interior {
        let (holes, twice) = cracks(truth, spans, interior);
        (errors[HOLES], errors[TWICE]) = (Some(holes as f64), Some(twice as f64));
    }
    Run { found, ..Run::of(errors) }
}

/// The classes of scenes, without those that differ in w alone.
pub(super) fn columns(options: &CostOptions) -> impl PreparedColumns<Input> {
    classes(options, (1024, [60_000, 800_000]), |scene| {
        scene.is_of_coverage()?;
        let input = Input::new(scene.clone());
        let counts = [scene.triangles.len(), input.truth().pixels[GIVEN] as usize];
        Ok((input, counts))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cost::scene::{Size, scenes};

    fn span(y_px: i32, x0_px: i32, x1_px: i32) -> Span {
        Span { y_px, x0_px, x1_px }
    }

    /// Missing, extra and twice, by hand.
    #[test]
    fn wrong_pixels_by_hand() {
        let wrong_pixels = |a: &[Span], b: &[Span]| super::wrong_pixels(a, b).0;
        let truth = [span(0, 0, 4), span(1, 2, 6)];
        assert_eq!(wrong_pixels(&truth, &truth), 0);
        assert_eq!(wrong_pixels(&[span(0, 0, 2), span(0, 2, 4), span(1, 2, 6)], &truth), 0);
        assert_eq!(wrong_pixels(&[span(0, 1, 5), span(1, 2, 6)], &truth), 2, "moved");
        assert_eq!(
            wrong_pixels(&[span(0, 0, 4), span(0, 0, 4), span(1, 2, 6)], &truth),
            4,
            "twice"
        );
        assert_eq!(wrong_pixels(&[], &truth), 8);
        assert_eq!(wrong_pixels(&[span(2, 0, 3)], &[]), 3);
    }

    #[test]
    fn cracks_by_hand() {
        let net = vec![vec![span(0, 0, 4)], vec![span(0, 4, 8)]];
        let both = |spans: &Vec<Span>| [spans.clone(), spans.clone()];
        let truth = Truth { spans: net.iter().map(both).collect(), pixels: [8, 8] };
        let all = PixelRect { x0: 0, y0: 0, x1: 8, y1: 1 };
        let cracks = |truth: &Truth, spans: &[Vec<Span>]| super::cracks(truth, spans, all);
        assert_eq!(cracks(&truth, &net), (0, 0));
        assert_eq!(cracks(&truth, &[vec![span(0, 0, 3)], vec![span(0, 4, 8)]]), (1, 0));
        assert_eq!(cracks(&truth, &[vec![span(0, 0, 6)], vec![span(0, 4, 9)]]), (0, 2));
    }

    fn of(body: impl Cover + Copy + 'static) -> Vec<(&'static str, Vec<Option<f64>>)> {
        let planted = entry("planted", "", &[], body);
        scenes(1, Size { side_px: 128, pixels: 4000 })
            .into_iter()
            .filter(|scene| scene.is_of_coverage().is_ok())
            .map(|scene| (scene.name, planted.judge(&Input::new(scene)).unwrap().errors))
            .collect()
    }

    /// Exact, but for one of the corners, which it takes a quarter of a pixel too far right; or
    /// without the last pixel of each row; or with one too many.
    #[derive(Clone, Copy)]
    struct Planted(Fault);

    type Fault = fn(&mut [[f64; 2]; 3], &mut Span);

    impl Cover for Planted {
        fn cover(
            &self,
            free: &FreeCorners,
            bounds: PixelRect,
            mut emit: impl FnMut(Span),
        ) -> Option<Work> {
            let mut px = free.px();
            (self.0)(&mut px, &mut span(0, 0, 0));
            let corners = FreeCorners::new(px).unwrap();
            Oracle.cover_exact(&corners, bounds, |mut span| {
                (self.0)(&mut [[0.0; 2]; 3], &mut span);
                if span.x0_px < span.x1_px {
                    emit(span);
                }
            });
            None
        }
    }

    /// What is planted is found, in every class, and by the count of cracks; what is exact is not.
    #[test]
    fn planted_faults_are_counted() {
        for (name, errors) in of(Planted(|_, _| ())) {
            assert_eq!(errors[GIVEN], Some(0.0), "{name}");
        }
        let faults: [Fault; 3] = [
            |corners, _| corners[1][0] += 0.25,
            |_, span| span.x1_px -= 1,
            |_, span| span.x1_px += 1,
        ];
        for (i, fault) in faults.into_iter().enumerate() {
            let errors = of(Planted(fault));
            for (name, errors) in &errors {
                assert!(errors[GIVEN] > Some(0.0) && errors[SNAPPED] > Some(0.0), "{i} {name}");
            }
            let mesh = &errors.last().unwrap().1;
            assert!(mesh[HOLES].unwrap() + mesh[TWICE].unwrap() > 0.0, "{i}");
        }
    }

    /// What does not fit a word is refused with a reason instead of drawn wrongly.
    #[test]
    fn words_have_a_range() {
        fn accepts(choice: impl Cover, corners: [[f64; 2]; 3]) -> Result<(), String> {
            choice.accepts(&FreeCorners::new(corners).unwrap(), PixelRect::window(8, 8))
        }
        let corners = |side: f64| [[0.0; 2], [side, 0.0], [0.0, side]];
        let (i32s, i64s) = (Integer::<i64, i32>::default(), Integer::<i64, i64>::default());
        assert!(accepts(i32s, corners(2895.0)).is_ok() && accepts(i32s, corners(2896.0)).is_err());
        assert!(accepts(i64s, corners(8_000_000.0)).is_ok());
        let widest = [[-8_388_608.0; 2], [8_388_607.0, -8_388_608.0], [0.0, 8_388_607.0]];
        assert!(accepts(i64s, widest).is_err());
        assert!(accepts(Integer::<i128, i128>::default(), widest).is_ok());
        let reason = accepts(i32s, corners(1e6)).unwrap_err();
        assert!(reason.contains("32 bits"), "{reason}");
    }

    /// Section A of the theory: f32 edge functions are exact on the lattice while Wx Wy <= 2^24, 16 px
    /// square, and f64 crossings are for coordinates up to 2^17 px.
    #[test]
    fn floats_are_exact_where_theory_says() {
        fn check(choice: impl Cover, corners: [[f64; 2]; 3]) {
            let window = PixelRect::window(16, 16);
            let corners = FreeCorners::new(corners).unwrap();
            let (mut ours, mut truth) = (Vec::new(), Vec::new());
            choice.cover(&corners, window, |span| ours.push(span));
            Oracle.cover_exact(&corners, window, |span| truth.push(span));
            assert_eq!(wrong_pixels(&ours, &truth), (0, None), "{corners:?}");
        }
        for index in 0..2000 {
            let mut rng = rasterproof_core::random::Rng::new("theory", 1, index);
            let px = |rng: &mut rasterproof_core::random::Rng, side: i64| {
                rng.int(0, side * 256) as f64 / 256.0
            };
            let small = [(); 3].map(|()| [px(&mut rng, 15), px(&mut rng, 15)]);
            let large = [(); 3].map(|()| [px(&mut rng, 1 << 17), px(&mut rng, 1 << 17)]);
            check(edges::Direct::<f32>::default(), small);
            check(Stepped::<f32>::default(), small);
            check(scanline::Direct::<f64>::default(), small);
            check(scanline::Direct::<f64>::default(), large);
            check(edges::Direct::<f64>::default(), large);
        }
    }
}
