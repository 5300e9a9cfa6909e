//! Changed questions: what is drawn is the right picture of another question.
//!
//! A change is a map of numbers, for some of the points and for one axis or both. The numbers in it, such as an offset, are
//! solved for: tried from coarse to fine, by how near the pictures come to the answers.

use super::border::{self, Toward};
use super::drawer::{Drawer, LearnedAnswer};
use super::edges::EdgeTest;
use super::memory::{Gather, GatherHow, Memory, RowLength};
use super::picture::Picture;
use super::question::AnyQuestion;
use super::visit::{Visit, VisitedTriangle};
use super::walk::Walk;

/// Which points are changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Points {
    All,
    /// In the order in which they are given.
    Given(usize),
    /// In the order from the top down.
    ByHeight(usize),
}

/// What becomes of a coordinate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum How {
    /// A multiple of so many steps.
    Snap(i64, Toward),
    Add(i64),
    /// The same of negative ones alone.
    AddBelow(i64),
    /// To the nearest multiple of so many steps, where it is at most so many away.
    SnapNear(i64, i64),
    AtLeast(i64),
    /// Not beyond the side of the window less so many steps.
    AtMostSide(i64),
    /// Both of [`How::AtLeast`] 0 and [`How::AtMostSide`].
    IntoWindow(i64),
    /// Not farther from the window than so many of its sides.
    Around(i64),
    /// A word of so many bits, which may be signed.
    Wrap(u32, bool),
    /// Limited to a signed word of so many bits.
    Saturate(u32),
    /// Limited to so many steps on both sides of 0.
    Limit(i64),
    Absolute,
    /// The side of the window less so many steps and less the coordinate.
    Mirror(i64),
    /// On the other side of the first point.
    AboutFirst,
    /// Times so many 256ths.
    Scale(i64),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Change {
    Move {
        points: Points,
        axes: [bool; 2],
        how: How,
    },
    /// Each pixel has the answer of another one.
    Read {
        axes: [bool; 2],
        how: How,
    },
    /// Each pixel is written elsewhere.
    Write {
        axes: [bool; 2],
        how: How,
    },
    /// x and y change places.
    Exchange,
    /// The shape is moved so that its smallest coordinates are not negative.
    Shift([bool; 2]),
    /// An end beyond the window comes to its border along the line, the place there rounded to whole pixels: to all sides
    /// of the window, or to those along the longer axis.
    Cut {
        points: Points,
        toward: Toward,
        all_sides: bool,
    },
    /// The ends come to the borders of the window one after another, in whole numbers, as Cohen and Sutherland do: at each
    /// step the end that lies beyond it, along the line between both ends as they are then.
    Clip(Clip),
    /// Pixels that are never come to, and tiles that are drawn without a look; of triangles.
    Visit(Visit),
    /// Rows beyond the window, or columns, are put into its first or its last one.
    Gather(Gather),
    /// Pixels are kept in one memory, row by row, by another length of rows or without a look at the column.
    Memory(Memory),
    /// All points become one, so that nothing is drawn.
    Nothing,
    /// The points come in the other order.
    Reverse,
}

/// By what a changed question is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Rule {
    /// One of the conventions of a [`Drawer`]; the right one is number 0.
    Convention(usize),
    /// A triangle whose samples are held against its edges in some arithmetic.
    Edges(EdgeTest),
    /// A line that is walked pixel by pixel in some arithmetic.
    Walk(Walk),
}

impl Rule {
    pub(super) const RIGHT: Self = Self::Convention(0);
}

/// How a line is clipped, step by step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Clip {
    /// The borders in the order in which they are looked at: left, right, upper, lower.
    pub(super) order: [usize; 4],
    /// Where the way along a border is rounded to.
    pub(super) toward: Toward,
    /// Whether the second end comes first where both lie beyond the window.
    pub(super) last_first: bool,
    /// Pixels between the last one of the window and its border.
    pub(super) margin: i64,
}

/// The picture of a question after some changes, by a rule.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Base {
    pub(super) changes: Vec<Change>,
    pub(super) rule: Rule,
}

/// A coordinate that no window has.
const FAR_AWAY: i64 = 1 << 20;

impl How {
    fn apply(self, v: i64, side: i64, one: i64, first: i64) -> i64 {
        match self {
            Self::Snap(step, toward) => border::round(v.into(), step.into(), toward) as i64 * step,
            Self::Add(by) => v + by,
            Self::AddBelow(by) => v + if v < 0 { by } else { 0 },
            Self::SnapNear(step, within) => {
                let near = border::round(v.into(), step.into(), Toward::Nearest) as i64 * step;
                if (v - near).abs() <= within { near } else { v }
            }
            Self::AtLeast(least) => v.max(least),
            Self::AtMostSide(less) => v.min(side * one - less),
            Self::IntoWindow(less) => v.max(0).min(side * one - less),
            Self::Around(sides) => v.clamp(-sides * side * one, (sides + 1) * side * one),
            Self::Wrap(bits, true) => {
                let half = 1 << (bits - 1);
                (v + half).rem_euclid(1 << bits) - half
            }
            Self::Wrap(bits, false) => v.rem_euclid(1 << bits),
            Self::Saturate(bits) => v.clamp(-(1 << (bits - 1)), (1 << (bits - 1)) - 1),
            Self::Limit(most) => v.clamp(-most.abs(), most.abs()),
            Self::Absolute => v.abs(),
            Self::Mirror(less) => side * one - less - v,
            Self::AboutFirst => 2 * first - v,
            Self::Scale(times) => (v * times).div_euclid(256),
        }
    }
}

impl Change {
    fn apply(self, q: &mut AnyQuestion) {
        let one = q.one();
        match self {
            Self::Exchange => q.points.iter_mut().for_each(|point| point.reverse()),
            Self::Reverse => q.points.reverse(),
            Self::Shift(axes) => {
                for axis in (0..2).filter(|axis| axes[*axis]) {
                    let by = (-q.range(axis)[0]).max(0);
                    q.points.iter_mut().for_each(|point| point[axis] += by);
                }
            }
            // A line of one point is a pixel, which lies beyond every window.
            Self::Nothing => q.points.iter_mut().for_each(|point| *point = [-FAR_AWAY; 2]),
            // It is the picture that changes.
            Self::Write { .. }
            | Self::Read { .. }
            | Self::Visit(_)
            | Self::Gather(_)
            | Self::Memory(_) => {}
            Self::Cut { points, toward, all_sides } => cut(q, points, toward, all_sides),
            Self::Clip(clip) => clip.apply(q),
            Self::Move { points, axes, how } => {
                let order = if q.is_line() { [0, 1, 1] } else { q.by_height() };
                let first = q.points[0];
                for i in 0..q.points.len() {
                    let is_meant = points.include(i, order);
                    for axis in (0..2).filter(|axis| is_meant && axes[*axis]) {
                        let side = q.side[axis].into();
                        let v = &mut q.points[i][axis];
                        *v = how.apply(*v, side, one, first[axis]);
                    }
                }
            }
        }
    }
}

impl Points {
    fn include(self, i: usize, order: [usize; 3]) -> bool {
        match self {
            Self::All => true,
            Self::Given(number) => number == i,
            Self::ByHeight(place) => order[place] == i,
        }
    }
}

/// Cuts a line at the window, one side after another.
fn cut(q: &mut AnyQuestion, points: Points, toward: Toward, all_sides: bool) {
    let whole = [q.points[0], q.points[1]];
    let [dx, dy] = q.extent();
    let longer = usize::from(dy > dx);
    for i in (0..2).filter(|i| points.include(*i, [0, 1, 1])) {
        let (here, there) = (whole[i], whole[1 - i]);
        for axis in (0..2).filter(|axis| all_sides || *axis == longer) {
            let limit = q.points[i][axis].clamp(0, i64::from(q.side[axis]) - 1);
            let by = there[axis] - here[axis];
            if limit == q.points[i][axis] || by == 0 {
                continue;
            }
            let along =
                here[1 - axis] * by + (limit - here[axis]) * (there[1 - axis] - here[1 - axis]);
            // Of two pixels that are as near, the line goes on to one, seen from its left or upper end.
            let goes_down = (there[1 - axis] < here[1 - axis]) == (by > 0);
            let toward = match toward {
                Toward::Nearest if goes_down => Toward::NearestDown,
                Toward::NearestDown if goes_down => Toward::Nearest,
                other => other,
            };
            q.points[i][axis] = limit;
            q.points[i][1 - axis] = border::round(along.into(), by.into(), toward) as i64;
        }
    }
}

impl Clip {
    fn apply(&self, q: &mut AnyQuestion) {
        let most = q.side.map(|side| i64::from(side) - 1 + self.margin);
        // Which borders an end lies beyond, in order.
        let beyond = |p: [i64; 2]| {
            self.order.map(|border| match border {
                0 => p[0] < 0,
                1 => p[0] > most[0],
                2 => p[1] < 0,
                _ => p[1] > most[1],
            })
        };
        // Each end crosses each border once at most, but for rounding.
        for _ in 0..MOST_CUTS {
            let of_ends = [beyond(q.points[0]), beyond(q.points[1])];
            if (0..4).any(|i| of_ends[0][i] && of_ends[1][i]) {
                return Change::Nothing.apply(q);
            }
            let turns = if self.last_first { [1, 0] } else { [0, 1] };
            let Some(end) = turns.into_iter().find(|end| of_ends[*end].contains(&true)) else {
                return;
            };
            let place = (0..4).find(|i| of_ends[end][*i]).unwrap_or(0);
            let (axis, is_far) = (self.order[place] / 2, self.order[place] % 2 == 1);
            let limit = if is_far { most[axis] } else { 0 };
            let [a, b] = [q.points[0], q.points[1]];
            let by = b[axis] - a[axis];
            if by == 0 {
                return;
            }
            let way = (b[1 - axis] - a[1 - axis]) * (limit - a[axis]);
            let along = a[1 - axis] + border::round(way.into(), by.into(), self.toward) as i64;
            q.points[end][axis] = limit;
            q.points[end][1 - axis] = along;
        }
    }
}

/// Steps after which a line is as it is.
const MOST_CUTS: usize = 8;

/// Where a pixel is written to, or read from.
fn elsewhere(at: [i32; 2], axes: [bool; 2], how: How, side: [i32; 2]) -> [i32; 2] {
    [0, 1].map(|axis| match axes[axis] {
        true => how.apply(at[axis].into(), side[axis].into(), 1, 0) as i32,
        false => at[axis],
    })
}

/// A picture whose pixels have the answers of others.
fn read(before: &Picture, axes: [bool; 2], how: How) -> Picture {
    let mut after = Picture::new(before.side);
    for at in before.all() {
        after.set(at, before.hits(elsewhere(at, axes, how, before.side)));
    }
    after
}

/// A picture whose pixels are written elsewhere: where two come together, the pixel is drawn twice.
fn written(before: &Picture, axes: [bool; 2], how: How) -> Picture {
    let mut after = Picture::new(before.side);
    for at in before.pixels().filter(|at| before.has(*at)) {
        let to = elsewhere(at, axes, how, before.side);
        after.set(to, (after.hits(to) + before.hits(at)).min(2));
    }
    after
}

/// Steps of [`super::trial::Work`] for a pixel that is held against three edges.
pub(super) const EDGES_OF_A_PIXEL: usize = 4;

impl Base {
    /// What it draws where something was answered.
    pub(super) fn draw(&self, a: &LearnedAnswer, drawer: &dyn Drawer) -> Option<Picture> {
        let mut q = a.question.clone();
        self.changes.iter().for_each(|change| change.apply(&mut q));
        let mut picture = match &self.rule {
            // The right picture is known.
            Rule::Convention(0) if q == a.question => a.right.clone(),
            Rule::Convention(number) => drawer.right(&q, *number)?,
            Rule::Edges(test) => {
                drawer.work().spend(EDGES_OF_A_PIXEL * q.pixels());
                test.draw(&q, drawer.sample(), drawer.ties(test.ties))
            }
            Rule::Walk(walk) => {
                let [width, height] = q.extent();
                drawer.work().spend(q.pixels() / 8 + width.max(height) as usize / 4);
                walk.draw(&q)?
            }
        };
        for change in &self.changes {
            match change {
                Change::Write { axes, how } => picture = written(&picture, *axes, *how),
                Change::Read { axes, how } => picture = read(&picture, *axes, *how),
                Change::Visit(visit) => {
                    drawer.work().spend(q.pixels());
                    let owned = drawer.ties(0);
                    let looked = VisitedTriangle { question: &q, sample: drawer.sample(), owned };
                    picture = visit.apply(&picture, &looked);
                }
                Change::Gather(gather) => {
                    picture = gather.apply(picture, &q, self.convention()?, drawer)?;
                }
                Change::Memory(memory) => {
                    picture = memory.apply(picture, &q, self.convention()?, drawer)?;
                }
                _ => {}
            }
        }
        Some(if drawer.counts() { picture } else { picture.once() })
    }

    /// The number of the convention that it draws by, if it does.
    fn convention(&self) -> Option<usize> {
        match self.rule {
            Rule::Convention(number) => Some(number),
            Rule::Edges(_) | Rule::Walk(_) => None,
        }
    }

    /// Whether it says that nothing is drawn.
    pub(super) fn is_nothing(&self) -> bool {
        self.changes == [Change::Nothing]
    }

    pub(super) fn cost(&self) -> usize {
        let moved = self.changes.iter().map(|change| match change {
            Change::Move { points: Points::All, .. } | Change::Nothing => 1,
            _ => 2,
        });
        let of_rule = match &self.rule {
            Rule::Convention(number) => usize::from(*number > 0),
            Rule::Edges(test) => test.changes(),
            Rule::Walk(walk) => walk.changes(),
        };
        moved.sum::<usize>() + of_rule
    }
}

const AXES: [[bool; 2]; 3] = [[true, true], [true, false], [false, true]];

/// All changes whose numbers are known: every map of numbers, for all points and for each of them, for both axes and for
/// each; and every rule.
pub(super) fn all(is_line: bool, rules: usize) -> Vec<Base> {
    let one = if is_line { 1 } else { 256 };
    let mut hows = vec![How::AtLeast(0), How::Absolute, How::AboutFirst];
    let lesses: &[i64] = if is_line { &[0, 1, 2] } else { &[0, 1, 128, 256, 512] };
    hows.extend(
        lesses
            .iter()
            .flat_map(|&less| [How::AtMostSide(less), How::IntoWindow(less), How::Mirror(less)]),
    );
    hows.extend([1, 2].map(How::Around));
    let words = if is_line { 6..=16 } else { 11..=21 };
    for bits in words {
        hows.extend([How::Wrap(bits, true), How::Wrap(bits, false), How::Saturate(bits)]);
    }
    let steps = if is_line { 1..=3 } else { 1..=9 };
    for step in steps.map(|bits| 1 << bits) {
        hows.extend(Toward::ALL.map(|toward| How::Snap(step, toward)));
    }
    hows.extend([-1, 1].map(|by| How::Add(by * one)));
    hows.extend([-1, 1].map(How::AddBelow));
    if !is_line {
        hows.extend([-256, -128, 128, 256].map(How::AddBelow));
        for step in [128, 256] {
            hows.extend([1, 2, 4, 8, 16, 32].map(|within| How::SnapNear(step, within)));
        }
    }
    let mut points = vec![Points::All];
    points.extend((0..if is_line { 2 } else { 3 }).map(Points::Given));
    if !is_line {
        points.extend((0..3).map(Points::ByHeight));
    }
    let mut bases: Vec<Base> = (1..rules)
        .map(|number| Base { changes: Vec::new(), rule: Rule::Convention(number) })
        .collect();
    bases.extend(AXES.map(|axes| Base { changes: vec![Change::Shift(axes)], rule: Rule::RIGHT }));
    bases.extend(
        [Change::Nothing, Change::Exchange, Change::Reverse]
            .map(|change| Base { changes: vec![change], rule: Rule::RIGHT }),
    );
    let ends = [Points::All, Points::Given(0), Points::Given(1)];
    for points in ends.into_iter().filter(|_| is_line) {
        use Toward::{Down, Nearest, NearestDown, Up, Zero};
        for toward in [Down, Nearest, NearestDown, Up, Zero] {
            for all_sides in [true, false] {
                let change = Change::Cut { points, toward, all_sides };
                bases.push(Base { changes: vec![change], rule: Rule::RIGHT });
            }
        }
    }
    if is_line {
        for order in ORDERS {
            for toward in [Toward::Zero, Toward::Down, Toward::Nearest, Toward::HalfAway] {
                for last_first in [false, true] {
                    for margin in [0, 1] {
                        let clip = Clip { order, toward, last_first, margin };
                        bases.push(Base { changes: vec![Change::Clip(clip)], rule: Rule::RIGHT });
                    }
                }
            }
        }
    }
    let mut places: Vec<How> = (1..=6)
        .flat_map(|bits| [How::Wrap(bits, false), How::Snap(1 << bits, Toward::Down)])
        .collect();
    places.extend([How::AtMostSide(2), How::Mirror(1), How::Mirror(0)]);
    places.extend([-2, -1, 1, 2].map(How::Add));
    for axis in [0, 1] {
        for ends in [[true, true], [true, false], [false, true]] {
            for how in [GatherHow::Once, GatherHow::Twice, GatherHow::Between] {
                let change = Change::Gather(Gather { axis, ends, how });
                bases.push(Base { changes: vec![change], rule: Rule::RIGHT });
            }
        }
    }
    let down_to = [2, 4, 8, 16].map(RowLength::DownTo);
    let lengths = [RowLength::Width, RowLength::OneLess, RowLength::OneMore];
    for row in lengths.into_iter().chain(down_to) {
        // Rows as wide as the window, and a look at the column, are right.
        let is_right = row == RowLength::Width;
        for checks in [true, false].into_iter().filter(|checks| !(is_right && *checks)) {
            let change = Change::Memory(Memory { row, checks });
            bases.push(Base { changes: vec![change], rule: Rule::RIGHT });
        }
    }
    let visits = if is_line { Vec::new() } else { Visit::all() };
    let visits = visits.into_iter().map(Change::Visit);
    bases.extend(visits.map(|change| Base { changes: vec![change], rule: Rule::RIGHT }));
    for how in (1..=4).map(|bits| How::Snap(1 << bits, Toward::Down)) {
        let all = AXES.map(|axes| Change::Read { axes, how });
        bases.extend(all.map(|change| Base { changes: vec![change], rule: Rule::RIGHT }));
    }
    for how in places {
        let all = AXES.map(|axes| Change::Write { axes, how });
        bases.extend(all.map(|change| Base { changes: vec![change], rule: Rule::RIGHT }));
    }
    for &how in &hows {
        for &points in &points {
            let moved = AXES.map(|axes| Change::Move { points, axes, how });
            bases.extend(moved.map(|change| Base { changes: vec![change], rule: Rule::RIGHT }));
        }
    }
    bases
}

/// Orders of borders that programs use: one axis after the other, and either border of each first.
const ORDERS: [[usize; 4]; 8] = [
    [0, 1, 2, 3],
    [0, 1, 3, 2],
    [1, 0, 2, 3],
    [1, 0, 3, 2],
    [2, 3, 0, 1],
    [2, 3, 1, 0],
    [3, 2, 0, 1],
    [3, 2, 1, 0],
];

/// How near a base comes to some answers: those that it predicts, and the pixels that it misses, each answer's limited.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Nearness {
    pub(super) exact: usize,
    /// Less than none.
    pub(super) pixels: i64,
}

/// Pixels of an answer beyond which no more are counted.
pub(super) const MOST_PIXELS: usize = 24;
/// Answers after which a base is left that predicted none, and comes no nearer than the right picture does.
const FIRST: usize = 12;

pub(super) fn nearness(base: &Base, answers: &[&LearnedAnswer], drawer: &dyn Drawer) -> Nearness {
    let mut near = Nearness::default();
    let mut of_right = 0;
    for (number, a) in answers.iter().enumerate() {
        let missed = base.draw(a, drawer).map_or(MOST_PIXELS, |p| p.differs(&a.drawn));
        near.exact += usize::from(missed == 0);
        near.pixels -= missed.min(MOST_PIXELS) as i64;
        of_right -= a.wrong_pixels.min(MOST_PIXELS) as i64;
        if number == FIRST && near.exact == 0 && near.pixels <= of_right {
            near.pixels -= (MOST_PIXELS * (answers.len() - number)) as i64;
            break;
        }
    }
    near
}

/// Offsets and scales that come nearest: tried in coarse steps, then in finer ones about the best so far.
pub(super) fn solved(is_line: bool, answers: &[&LearnedAnswer], drawer: &dyn Drawer) -> Vec<Base> {
    let mut out = Vec::new();
    out.extend(limits(is_line, answers, drawer));
    for how in [How::Add as fn(i64) -> How, How::Mirror, How::Scale] {
        let mut of_axes = Vec::new();
        for axes in AXES {
            let change = |v: i64| Change::Move { points: Points::All, axes, how: how(v) };
            let base = |v: i64| Base { changes: vec![change(v)], rule: Rule::RIGHT };
            let start = if how(0) == How::Scale(0) { 256 } else { 0 };
            if how(0) == How::Scale(0) && is_line {
                continue;
            }
            let steps = steps_of(is_line, start != 0);
            // Fine steps are told apart by few answers, so all are looked at.
            let near = |v: i64, step: i64| {
                let some = if step > 4 { answers.len().min(COARSE) } else { answers.len() };
                nearness(&base(v), &answers[..some], drawer)
            };
            let best = finest(steps, start, &near);
            of_axes.push(change(best));
            out.push(base(best));
        }
        // Each axis by its own number.
        if let [_, x, y] = of_axes[..] {
            out.push(Base { changes: vec![x, y], rule: Rule::RIGHT });
        }
    }
    out
}

/// The limit of coordinates that comes nearest: tried at each power of two and between, then ever more finely about the best.
fn limits(is_line: bool, answers: &[&LearnedAnswer], drawer: &dyn Drawer) -> Vec<Base> {
    let one = if is_line { 1 } else { 256 };
    let base = |v: i64| {
        let how = How::Limit(v);
        let change = Change::Move { points: Points::All, axes: [true; 2], how };
        Base { changes: vec![change], rule: Rule::RIGHT }
    };
    let far = |a: &&&LearnedAnswer| a.question.points.iter().flatten().any(|v| v.abs() > 16 * one);
    let answers: Vec<&LearnedAnswer> = answers.iter().filter(far).take(COARSE).copied().collect();
    if answers.len() < 6 {
        return Vec::new();
    }
    let near = |v: i64| nearness(&base(v), &answers, drawer);
    let powers = (4..=14).flat_map(|bits| [4, 5, 6, 7].map(|part| (one << bits) / 4 * part));
    let coarse = powers.map(|v| (near(v), v)).max().map_or(one << 10, |(_, v)| v);
    let steps: Vec<i64> =
        std::iter::successors(Some(coarse / 16), |step| (*step > 0).then_some(step / 4)).collect();
    let steps: Vec<i64> = steps.into_iter().filter(|step| *step > 0).collect();
    vec![base(finest(&steps, coarse, &|v, _| near(v)))]
}

/// Answers that coarse steps are compared by.
const COARSE: usize = 24;

/// From coarse to fine.
fn steps_of(is_line: bool, is_scale: bool) -> &'static [i64] {
    match (is_line, is_scale) {
        (true, _) => &[1],
        (_, true) => &[32, 8, 2, 1],
        _ => &[256, 64, 16, 4, 1],
    }
}

/// The number with the best nearness.
fn finest(steps: &[i64], start: i64, near: &dyn Fn(i64, i64) -> Nearness) -> i64 {
    let mut best = (Nearness::default(), start);
    for &step in steps {
        let center = best.1;
        best = (near(center, step), center);
        for v in (-6..=6).map(|i| center + i * step) {
            let nearness = near(v, step);
            if nearness > best.0 {
                best = (nearness, v);
            }
        }
    }
    best.1
}
