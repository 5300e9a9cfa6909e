//! A choice with what it does to the input of a column: any choice of any group.

use super::{Choice, Column, CostOptions, Pass, Run, scene};

/// What happens to a choice on a column: what it gets wrong, and what is timed; or why it is not run.
pub type PreparedCell<'a> = Result<(Run, Option<Pass<'a>>), String>;

type Judge<'e, I> = dyn Fn(&I) -> Result<Run, String> + 'e;
type MakePass<'e, I> = dyn for<'a> Fn(&'a I) -> Result<Pass<'a>, String> + 'e;

/// A choice with what it does to the input of a column: any choice of any group.
pub struct Entry<'e, I> {
    pub choice: Choice,
    judge: Box<Judge<'e, I>>,
    pass: Box<MakePass<'e, I>>,
}

impl<'e, I> Entry<'e, I> {
    pub(super) fn new(
        choice: Choice,
        judge: impl Fn(&I) -> Result<Run, String> + 'e,
        pass: impl for<'a> Fn(&'a I) -> Result<Pass<'a>, String> + 'e,
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

/// Columns with what choices are given there, or why none is run on it.
pub(super) type Columns<I> = Vec<(Column, Result<I, String>)>;

/// The usual classes of scenes as columns, on which a group is not measured that has columns of its own.
pub(super) fn left_out<I>(options: &CostOptions, why: &str) -> Columns<I> {
    let classes = scene::scenes(options.seed, scene::Size { side_px: 64, pixels: 0 });
    let column = |class: scene::Scene| Column::new(class.name, class.about, 0, 0);
    classes.into_iter().map(|class| (column(class), Err(why.to_owned()))).collect()
}
