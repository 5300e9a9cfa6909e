//! Lines walked pixel by pixel: the numbers that a program adds up on its way, each with its start, its steps and its word.

use super::border::{From, Toward, float};
use super::picture::{MARGIN, Picture};
use super::question::AnyQuestion;

/// What tells when the line goes aside. `du` and `dv` are its lengths along the longer and the shorter axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Method {
    /// An error term: a step aside where it is positive.
    Error(Error),
    /// One error term for steps along both axes, each compared with twice the term.
    BothAxes {
        /// Whether the comparisons of x and of y are true of equal numbers.
        equal: [bool; 2],
        /// Whether the term is doubled anew for the second comparison.
        is_fresh: bool,
        /// What the term begins with, in parts of |dx| and of |dy|.
        start: [i64; 2],
    },
    /// Both coordinates are added up in floats of so many bits, and rounded for each pixel.
    Added { bits: u32, toward: Toward },
}

/// An error term, twice as large as of one that begins with half of `du`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Error {
    /// It begins with so many `du` and so many `dv`, plus a number.
    pub(super) start: [i64; 3],
    /// Whether half a length was rounded before it was doubled here.
    pub(super) is_halved: bool,
    /// It grows at each step by so many `dv`, plus a number.
    pub(super) gain: [i64; 2],
    /// It shrinks at each step aside by so many `du`, plus a number.
    pub(super) loss: [i64; 2],
    /// Whether there is a step aside where it is 0, too: of lines that go to larger coordinates along the longer axis, and of others.
    pub(super) is_enough: [bool; 2],
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Walk {
    pub(super) method: Method,
    /// The end that it begins at.
    pub(super) from: From,
    /// The axis that it steps along, whichever is longer; the longer one where that is not said.
    pub(super) along: Option<usize>,
    /// The word of the error term.
    pub(super) bits: Option<u32>,
}

/// Steps beyond which a line is not walked.
const MOST_STEPS: i64 = 1 << 17;

impl Walk {
    pub(super) const RIGHT: Self = Self {
        method: Method::Error(Error {
            start: [-1, 2, 0],
            is_halved: false,
            gain: [2, 0],
            loss: [2, 0],
            is_enough: [true; 2],
        }),
        from: From::Before,
        along: None,
        bits: None,
    };
    pub(super) const BOTH_AXES: Self = Self {
        method: Method::BothAxes { equal: [true; 2], is_fresh: false, start: [1, -1] },
        from: From::First,
        along: None,
        bits: None,
    };
    pub(super) const ADDED: Self = Self {
        method: Method::Added { bits: 24, toward: Toward::Nearest },
        from: From::First,
        along: None,
        bits: None,
    };

    /// Fields that are not as in a right walk. Programs begin at the end that is given first, or at the left or upper one; which
    /// of these, and what becomes of ties, is no change.
    pub(super) fn changes(&self) -> usize {
        let of_method = match self.method {
            Method::Error(error) => {
                let Method::Error(right) = Self::RIGHT.method else { return 1 };
                usize::from(error.start != right.start)
                    + usize::from(error.gain != right.gain)
                    + usize::from(error.loss != right.loss)
            }
            Method::BothAxes { is_fresh, start, .. } => {
                1 + usize::from(is_fresh) + usize::from(start != [1, -1])
            }
            Method::Added { .. } => 1,
        };
        let is_from_behind = matches!(self.from, From::After | From::Second);
        let others = [self.bits.is_some(), is_from_behind, self.along.is_some()];
        of_method + others.into_iter().filter(|is_changed| *is_changed).count()
    }

    /// All walks with one other field.
    pub(super) fn variants(&self) -> Vec<Self> {
        let mut all = Vec::new();
        for from in [From::Before, From::After, From::First, From::Second] {
            all.push(Self { from, ..*self });
        }
        for along in [None, Some(0), Some(1)] {
            all.push(Self { along, ..*self });
        }
        for bits in (6..=18).chain([24, 31, 32]).map(Some).chain([None]) {
            all.push(Self { bits, ..*self });
        }
        match self.method {
            Method::Error(error) => {
                let others = error.variants().into_iter().map(Method::Error);
                all.extend(others.map(|method| Self { method, ..*self }));
            }
            Method::BothAxes { equal: [x, y], is_fresh, start } => {
                let mut with = |equal, is_fresh, start| {
                    let method = Method::BothAxes { equal, is_fresh, start };
                    all.push(Self { method, ..*self });
                };
                with([!x, y], is_fresh, start);
                with([x, !y], is_fresh, start);
                with([!x, !y], is_fresh, start);
                with([x, y], !is_fresh, start);
                for start in [[1, -1], [0, 0], [1, 0], [0, -1], [-1, 1], [2, -2], [1, -2], [2, -1]]
                {
                    with([x, y], is_fresh, start);
                }
            }
            Method::Added { .. } => {
                for bits in [24, 53] {
                    for toward in Toward::ALL.into_iter().chain([Toward::NearestDown]) {
                        all.push(Self { method: Method::Added { bits, toward }, ..*self });
                    }
                }
            }
        }
        all.retain(|other| other != self);
        all
    }

    /// The picture of a line; nothing where it is too long to be walked.
    pub(super) fn draw(&self, q: &AnyQuestion) -> Option<Picture> {
        let mut picture = Picture::new(q.side);
        let [mut from, mut to] = [q.points[0], q.points[1]];
        let size = [0, 1].map(|axis| (to[axis] - from[axis]).abs());
        if size[0].max(size[1]) > MOST_STEPS {
            return None;
        }
        // Along an axis on which it has no length, no line can be walked.
        let longer = usize::from(size[1] > size[0]);
        let longer = self.along.filter(|along| size[*along] > 0).unwrap_or(longer);
        let is_turned = match self.from {
            From::Before => from[longer] > to[longer],
            From::After => from[longer] < to[longer],
            From::First => false,
            From::Second => true,
        };
        if is_turned {
            std::mem::swap(&mut from, &mut to);
        }
        let step = [0, 1].map(|axis| (to[axis] - from[axis]).signum());
        // Steps are many, and few of them are in the picture.
        let [columns, rows] = q.side.map(|side| i64::from(side + MARGIN));
        let mut plot = |[x, y]: [i64; 2]| {
            let margin = i64::from(MARGIN);
            if x >= -margin && x < columns && y >= -margin && y < rows {
                picture.set([x as i32, y as i32], 1);
            }
        };
        match self.method {
            Method::Error(error) => {
                let mut value = self.in_word(error.begins(size[longer], size[1 - longer]));
                let is_enough = error.is_enough[usize::from(step[longer] < 0)];
                let mut at = from;
                for _ in 0..=size[longer] {
                    plot(at);
                    let loss = error.loss[0] * size[longer] + error.loss[1];
                    while value > 0 || is_enough && value == 0 {
                        at[1 - longer] += step[1 - longer];
                        value -= loss;
                        // Along the shorter axis there are several steps aside, along the longer one at most one.
                        if self.along.is_none() || loss <= 0 {
                            break;
                        }
                    }
                    value = self.in_word(value + error.gain[0] * size[1 - longer] + error.gain[1]);
                    at[longer] += step[longer];
                }
            }
            Method::BothAxes { equal, is_fresh, start } => {
                let mut value = self.in_word(start[0] * size[0] + start[1] * size[1]);
                let mut at = from;
                // A walk that misses its end would not stop.
                for _ in 0..=2 * (size[0] + size[1]) {
                    plot(at);
                    if at == to {
                        break;
                    }
                    let mut twice = self.in_word(2 * value);
                    if twice > -size[1] || equal[0] && twice == -size[1] {
                        value -= size[1];
                        at[0] += step[0];
                    }
                    if is_fresh {
                        twice = self.in_word(2 * value);
                    }
                    if twice < size[0] || equal[1] && twice == size[0] {
                        value += size[0];
                        at[1] += step[1];
                    }
                    value = self.in_word(value);
                }
            }
            Method::Added { bits, toward } => {
                let mut at = from.map(|v| v as f64);
                let by = [0, 1].map(|axis| {
                    let way = (to[axis] - from[axis]) as f64;
                    float(way / size[longer].max(1) as f64, bits)
                });
                for _ in 0..=size[longer] {
                    plot([rounded(at[0], bits, toward), rounded(at[1], bits, toward)]);
                    at[0] = float(at[0] + by[0], bits);
                    at[1] = float(at[1] + by[1], bits);
                }
            }
        }
        Some(picture)
    }

    fn in_word(&self, v: i64) -> i64 {
        // The bits that do not fit are shifted out, and the sign comes back.
        self.bits.map_or(v, |bits| v << (64 - bits) >> (64 - bits))
    }
}

/// A float as a pixel. To the nearest is down after a half is added, which is rounded, too.
fn rounded(v: f64, bits: u32, toward: Toward) -> i64 {
    let whole = match toward {
        Toward::Down => v.floor(),
        Toward::Nearest => float(v + 0.5, bits).floor(),
        Toward::NearestDown => (v - 0.5).ceil(),
        Toward::Up => v.ceil(),
        Toward::Zero => v.trunc(),
        Toward::HalfAway => v.round(),
    };
    whole as i64
}

impl Error {
    fn begins(&self, du: i64, dv: i64) -> i64 {
        let [of_du, of_dv, more] = self.start;
        // Half of an odd number is rounded down and subtracted, so that the term is larger.
        let rest = |times: i64, v: i64| if self.is_halved { (times * v).rem_euclid(2) } else { 0 };
        of_du * du + rest(of_du, du) + of_dv * dv + rest(of_dv, dv) + more
    }

    fn variants(&self) -> Vec<Self> {
        let mut all = Vec::new();
        for v in -4..=4 {
            let mut others = [*self; 6];
            others[0].start[0] = v;
            others[1].start[1] = v;
            others[2].start[2] = v;
            others[3].gain[0] = v;
            others[4].gain[1] = v;
            others[5].loss[1] = v;
            all.extend(others);
        }
        for v in 1..=4 {
            let mut other = *self;
            other.loss[0] = v;
            all.push(other);
        }
        // As if the term were counted in halves, or in doubles, and its steps were not.
        let start = self.start;
        all.push(Self { start: start.map(|v| 2 * v), ..*self });
        if start.iter().all(|v| v % 2 == 0) {
            all.push(Self { start: start.map(|v| v / 2), ..*self });
        }
        all.push(Self { is_halved: !self.is_halved, ..*self });
        for is_enough in [[true, true], [true, false], [false, true], [false, false]] {
            all.push(Self { is_enough, ..*self });
        }
        all
    }
}
