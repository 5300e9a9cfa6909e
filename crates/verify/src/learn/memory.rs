//! Pixels that are put elsewhere: rows beyond the window into its first or last one, and pixels in a memory by another length
//! of rows.

use super::border;
use super::drawer::Drawer;
use super::picture::Picture;
use super::question::AnyQuestion;

/// What is put into the first and the last row of the window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Gather {
    /// 1 where it is rows that are put there, 0 where it is columns.
    pub(super) axis: usize,
    /// Whether those before the window are, and those after it.
    pub(super) ends: [bool; 2],
    pub(super) how: GatherHow,
}

/// How many places a row has in a memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum RowLength {
    /// As many as the window has columns.
    Width,
    OneLess,
    OneMore,
    /// The same, rounded down to a multiple of so many.
    DownTo(i32),
}

impl RowLength {
    fn of(self, width: i32) -> i32 {
        match self {
            Self::Width => width,
            Self::OneLess => width - 1,
            Self::OneMore => width + 1,
            Self::DownTo(multiple) => width / multiple * multiple,
        }
    }

    fn words(self) -> String {
        match self {
            Self::Width => String::new(),
            Self::OneLess => ", whose rows are one place too short".to_owned(),
            Self::OneMore => ", whose rows are one place too long".to_owned(),
            Self::DownTo(multiple) => format!(
                ", whose rows have the width of the window, rounded down to a multiple of {multiple}"
            ),
        }
    }
}

/// Where pixels are kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Memory {
    pub(super) row: RowLength,
    /// Whether pixels beside the window are left out.
    pub(super) checks: bool,
}

/// What becomes of pixels that come together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum GatherHow {
    Once,
    /// They are drawn more than once.
    Twice,
    /// All between the first and the last of them are drawn.
    Between,
}

/// Rows that are drawn at once beyond the window, and how many of such parts at most.
const PART_PX: i32 = 32;
const MOST_PARTS: i64 = 512;

impl Gather {
    /// The picture with what lies before and after the window; nothing where that is too much.
    pub(super) fn apply(
        self,
        mut picture: Picture,
        q: &AnyQuestion,
        rule: usize,
        drawer: &dyn Drawer,
    ) -> Option<Picture> {
        if self.how == GatherHow::Between {
            return self.between(picture, q, drawer.sample());
        }
        let (axis, one) = (self.axis, q.one());
        let [least, most] = q.range(axis).map(|v| v.div_euclid(one));
        let side = i64::from(q.side[axis]);
        // The parts before the window end where it begins.
        let parts = [(-least).max(0), (most + 1 - side).max(0)];
        for end in (0..2).filter(|end| self.ends[*end]) {
            let count = (parts[end] + i64::from(PART_PX) - 1) / i64::from(PART_PX);
            if count > MOST_PARTS {
                return None;
            }
            for part in 0..count {
                let start = match end {
                    0 => -(part + 1) * i64::from(PART_PX),
                    _ => side + part * i64::from(PART_PX),
                };
                let mut there = q.clone();
                there.points.iter_mut().for_each(|point| point[axis] -= start * one);
                there.side[axis] = PART_PX;
                let drawn = drawer.right(&there, rule)?;
                for at in drawn.pixels().filter(|at| drawn.has(*at)) {
                    let mut to = at;
                    to[axis] = if end == 0 { 0 } else { q.side[axis] - 1 };
                    let most = if self.how == GatherHow::Twice { 2 } else { 1 };
                    picture.set(to, (picture.hits(to) + 1).min(most));
                }
            }
        }
        Some(picture)
    }

    /// The picture with all between the least and the greatest border of the rows that come together; of rows of triangles.
    fn between(self, mut picture: Picture, q: &AnyQuestion, sample: [i64; 2]) -> Option<Picture> {
        let last = i64::from(q.side[1]) - 1;
        let [least, most] = q.range(1).map(|v| v.div_euclid(256));
        if self.axis == 0 || q.is_line() || most - least > MOST_PARTS * i64::from(PART_PX) {
            return None;
        }
        for (end, row) in [0, last].into_iter().enumerate().filter(|(end, _)| self.ends[*end]) {
            let rows = if end == 0 { least..1 } else { last..most + 1 };
            let [mut first, mut after] = [i64::MAX, i64::MIN];
            for place in rows {
                let Some(ends) = border::row_ends(q, sample, place) else { continue };
                (first, after) = (first.min(ends[0]), after.max(ends[1]));
            }
            for x in first.max(0)..after.min(q.side[0].into()) {
                picture.set([x as i32, row as i32], 1);
            }
        }
        Some(picture)
    }

    /// What is put where, after 'as if'.
    pub(super) fn words(self) -> String {
        let line = ["columns", "rows"][self.axis];
        let (first, last) =
            (format!("{line} before the window"), format!("{line} after the window"));
        let said = match self.ends {
            [true, true] => {
                format!("{first} were put into its first one, and those after it into its last")
            }
            [true, false] => format!("{first} were put into its first one"),
            _ => format!("{last} were put into its last one"),
        };
        let how = match self.how {
            GatherHow::Once => "",
            GatherHow::Twice => ", and drawn there once more",
            GatherHow::Between => ", which is then filled from its least to its greatest column",
        };
        said + how
    }
}

/// Pixels beyond the window, on each side, that are looked at of a triangle.
const MOST_BESIDE: i64 = 96;

/// All pixels of a shape, in the window or not; nothing where it goes too far beyond it.
fn whole(q: &AnyQuestion, rule: usize, drawer: &dyn Drawer) -> Option<Vec<[i32; 2]>> {
    if q.is_line() {
        return drawer.whole_line(q, rule);
    }
    let mut beyond = 0;
    for axis in [0, 1] {
        let [least, most] = q.range(axis).map(|v| v.div_euclid(q.one()));
        beyond = beyond.max(-least).max(most + 1 - i64::from(q.side[axis]));
    }
    if beyond > MOST_BESIDE {
        return None;
    }
    let mut wide = q.clone();
    wide.points.iter_mut().for_each(|point| *point = point.map(|v| v + beyond * q.one()));
    let beyond = beyond as i32;
    wide.side = q.side.map(|side| side + 2 * beyond);
    let drawn = drawer.right(&wide, rule)?;
    let is_drawn = drawn.pixels().filter(|at| drawn.has(*at));
    Some(is_drawn.map(|at| at.map(|v| v - beyond)).collect())
}

impl Memory {
    /// What the places of the window's pixels hold; nothing where the shape goes too far beyond it.
    pub(super) fn apply(
        self,
        picture: Picture,
        q: &AnyQuestion,
        rule: usize,
        drawer: &dyn Drawer,
    ) -> Option<Picture> {
        let [width, height] = q.side;
        let length = self.row.of(width);
        let mut kept = vec![0; (length.max(0) * height + width).max(0) as usize];
        let mut keep = |[x, y]: [i32; 2], hits: u8| {
            let place = usize::try_from(y * length + x).ok();
            if let Some(kept) = place.and_then(|place| kept.get_mut(place)) {
                *kept = hits.max(*kept);
            }
        };
        if self.checks {
            for at in picture.pixels().filter(|at| picture.has(*at)) {
                keep(at, picture.hits(at));
            }
        } else {
            for at in whole(q, rule, drawer)? {
                keep(at, 1);
            }
        }
        let mut after = Picture::new(q.side);
        for [x, y] in picture.pixels() {
            let place = usize::try_from(y * length + x).ok();
            after.set([x, y], place.and_then(|place| kept.get(place)).copied().unwrap_or(0));
        }
        Some(after)
    }

    /// How pixels are kept, after 'as if'.
    pub(super) fn words(self) -> String {
        let mut said = String::from("pixels were kept in one memory, row by row");
        said += &self.row.words();
        if !self.checks {
            said += ", and a column beyond the window were not left out";
        }
        said
    }
}
