//! A choice with what it does to the input of a column, and the columns of scenes.

use std::cell::{OnceCell, RefCell};

use super::scene::{Scene, Size, scenes};
use super::{Choice, Column, CostOptions, Pass, Run};
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::PixelRect;

type Judge<I> = dyn Fn(&I) -> Result<Run, String>;
type MakePass<I> = dyn for<'a> Fn(&'a I) -> Result<Pass<'a>, String>;

/// A choice with what it does to the input of a column: any choice of any group.
pub struct Entry<I> {
    pub choice: Choice,
    judge: Box<Judge<I>>,
    pass: Box<MakePass<I>>,
}

impl<I> Entry<I> {
    pub(super) fn new(
        choice: Choice,
        judge: impl Fn(&I) -> Result<Run, String> + 'static,
        pass: impl for<'a> Fn(&'a I) -> Result<Pass<'a>, String> + 'static,
    ) -> Self {
        Self { choice, judge: Box::new(judge), pass: Box::new(pass) }
    }

    /// What the choice gets wrong of an input, against the oracle.
    ///
    /// # Errors
    /// The reason why the choice takes no such input.
    pub fn judge(&self, input: &I) -> Result<Run, String> {
        (self.judge)(input)
    }

    /// All of the work once: what is timed.
    ///
    /// # Errors
    /// The reason why the choice takes no such input, as [`Entry::judge`] has it.
    pub fn pass<'a>(&self, input: &'a I) -> Result<Pass<'a>, String> {
        (self.pass)(input)
    }
}

/// The frame to which all passes of a column paint, made when the first pass is.
pub(super) struct Canvas<T> {
    bounds: PixelRect,
    frame: OnceCell<RefCell<Frame<T>>>,
}

impl<T: Copy + Default> Canvas<T> {
    pub fn new(bounds: PixelRect) -> Self {
        Self { bounds, frame: OnceCell::new() }
    }

    pub fn pass<'a>(&'a self, mut paint: impl FnMut(&mut Frame<T>) + 'a) -> Pass<'a> {
        let new = || RefCell::new(Frame::new(self.bounds, T::default()));
        let frame = self.frame.get_or_init(new);
        Pass::new(move || paint(&mut frame.borrow_mut()))
    }
}

/// Columns with what choices are given there, or why none is run on them.
pub(super) trait PreparedColumns<I>:
    ExactSizeIterator<Item = (Column, Result<I, String>)>
{
}

impl<I, All: ExactSizeIterator<Item = (Column, Result<I, String>)>> PreparedColumns<I> for All {}

/// The classes of scenes as columns, in windows of a size and with so many pixels, fewer where it has to be quick. `make` may say
/// otherwise what a class is; it returns what choices are given, with its numbers of items and pixels, or why none is run.
pub(super) fn classes<I>(
    options: &CostOptions,
    (side_px, [quick, usual]): (u32, [u64; 2]),
    make: impl Fn(&mut Scene) -> Result<(I, [usize; 2]), String>,
) -> impl PreparedColumns<I> {
    let pixels = if options.quick { quick } else { usual };
    scenes(options.seed, Size { side_px, pixels }).into_iter().map(move |mut scene| {
        let made = make(&mut scene);
        let none = [scene.triangles.len(), 0];
        let [items, pixels] = made.as_ref().map_or(none, |(_, counts)| *counts);
        let column = Column::new(scene.name, scene.about, items as u64, pixels as u64);
        (column, made.map(|(input, _)| input))
    })
}

/// The same classes after columns of a group that has its own, on which it is not run.
pub(super) fn and_no_class<I>(
    options: &CostOptions,
    columns: impl Iterator<Item = (Column, I)>,
    why: &'static str,
) -> impl PreparedColumns<I> {
    let none = classes(options, (64, [0, 0]), |class| {
        class.triangles.clear();
        Err(why.to_owned())
    });
    let own = columns.map(|(column, input)| (column, Ok(input)));
    own.chain(none).collect::<Vec<_>>().into_iter()
}

/// A choice that draws tiles of pixels to a buffer and marks each pixel; `errors` counts the marks.
pub(super) fn tiled<I: 'static, T: Copy + 'static>(
    choice: Choice,
    buffer: fn(&I) -> Vec<T>,
    draw: fn(&I, &mut [T], &mut [u8]),
    errors: fn(&I, &[u8]) -> Vec<Option<f64>>,
) -> Entry<I> {
    Entry::new(
        choice,
        move |input| {
            let mut buffer = buffer(input);
            let mut marks = vec![0; buffer.len()];
            draw(input, &mut buffer, &mut marks);
            Ok(Run::of(errors(input, &marks)))
        },
        move |input| {
            let mut buffer = buffer(input);
            let mut marks = vec![0; buffer.len()];
            Ok(Pass::new(move || {
                draw(std::hint::black_box(input), &mut buffer, &mut marks);
                std::hint::black_box(&buffer);
            }))
        },
    )
}
