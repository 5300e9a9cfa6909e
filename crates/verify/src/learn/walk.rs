//! Lines walked pixel by pixel: the numbers that a program adds up on its way, each with its start, its steps and its word.

use super::border::{From, Toward, float, round};
use super::picture::{MARGIN, Picture};
use super::quantity::AXES;
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
    /// A point for each of some steps, rounded to a pixel.
    Sampled { place: Place, toward: Toward, steps: Steps },
}

/// How a point on a line is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Place {
    /// Both coordinates are added up in floats of so many bits.
    Added(u32),
    /// The coordinates as they are.
    Exact,
    /// The way from the start as it is: it is this that is rounded.
    Way,
    /// The same between points that are so many steps apart and were rounded before.
    Pieces(i64),
}

/// How many steps a line is cut into.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Steps {
    /// The length of the longer side.
    Longer,
    /// Its own length, rounded up.
    Length,
    /// The length of both sides.
    Sum,
    Twice,
    OneMore,
}

impl Steps {
    const ALL: [Self; 5] = [Self::Longer, Self::Length, Self::Sum, Self::Twice, Self::OneMore];

    fn of(self, way: &Way) -> i64 {
        let [width, height] = way.size;
        match self {
            Self::Longer => way.size[way.axis],
            // Below 2^31, so that the root is off by less than one part in 2^50.
            Self::Length => ((width * width + height * height) as f64).sqrt().ceil() as i64,
            Self::Sum => width + height,
            Self::Twice => 2 * way.size[way.axis],
            Self::OneMore => way.size[way.axis] + 1,
        }
    }

    fn words(self) -> Option<&'static str> {
        match self {
            Self::Longer => None,
            Self::Length => Some("as many as it is long, rounded up"),
            Self::Sum => Some("as many as both sides have together"),
            Self::Twice => Some("twice as many as its longer side has"),
            Self::OneMore => Some("one more than its longer side has"),
        }
    }
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
    /// Whether a step aside is made for one pixel alone, and the next one is where it would be without.
    pub(super) is_lost: bool,
    /// Whether there is a step aside where it is 0, too: of lines that go to larger coordinates along the longer axis, and of others.
    pub(super) is_enough: [bool; 2],
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Walk {
    pub(super) method: Method,
    pub(super) from: From,
    /// The axis that it steps along, whichever is longer; the longer one where that is not said.
    pub(super) along: Option<usize>,
    /// The bits of the signed word that holds the error term; as many as it needs where that is not said.
    pub(super) bits: Option<u32>,
}

/// A line in the direction in which it is walked.
#[derive(Clone, Copy)]
struct Way {
    from: [i64; 2],
    to: [i64; 2],
    /// |dx| and |dy|, and their directions.
    size: [i64; 2],
    step: [i64; 2],
    /// The axis along which there is a pixel for each step.
    axis: usize,
}

/// Gets each pixel, also those beyond the window.
type Plot<'a> = &'a mut dyn FnMut([i64; 2]);

/// Steps beyond which a line is not walked.
const MOST_STEPS: i64 = 1 << 17;

impl Walk {
    pub(super) const RIGHT: Self = Self {
        method: Method::Error(Error {
            start: [-1, 2, 0],
            is_halved: false,
            gain: [2, 0],
            loss: [2, 0],
            is_lost: false,
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
    pub(super) const SAMPLED: Self = Self {
        method: Method::Sampled {
            place: Place::Added(24),
            toward: Toward::Nearest,
            steps: Steps::Longer,
        },
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
                    + usize::from(error.is_lost)
            }
            Method::BothAxes { is_fresh, start, .. } => {
                1 + usize::from(is_fresh) + usize::from(start != [1, -1])
            }
            Method::Sampled { place, steps, .. } => {
                let is_plain = matches!(place, Place::Exact | Place::Way);
                usize::from(!is_plain) + usize::from(steps != Steps::Longer)
            }
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
            Method::Sampled { place, toward, steps } => {
                let mut with = |place, toward, steps| {
                    let method = Method::Sampled { place, toward, steps };
                    all.push(Self { method, ..*self });
                };
                Steps::ALL.into_iter().for_each(|steps| with(place, toward, steps));
                let mut places = vec![Place::Added(24), Place::Added(53), Place::Exact, Place::Way];
                places.extend((1..=6).map(|bits| Place::Pieces(1 << bits)));
                for place in places {
                    for toward in Toward::ALL.into_iter().chain([Toward::NearestDown]) {
                        with(place, toward, steps);
                    }
                }
            }
        }
        all.retain(|other| other != self);
        all
    }

    /// How it walks, after 'as if'.
    pub(super) fn words(&self) -> Vec<String> {
        let mut said = Vec::new();
        let right = Self::RIGHT;
        match (self.method, right.method) {
            (Method::Error(error), Method::Error(right)) => {
                if error.start != right.start || error.is_halved {
                    let half =
                        if error.is_halved { ", half of an odd number rounded down" } else { "" };
                    said.push(format!(
                    "the error term began at {}{half}, not at 2 dv - du (du is the length, dv the side way)",
                    sum([(error.start[1], " dv"), (error.start[0], " du"), (error.start[2], "")])
                ));
                }
                if error.gain != right.gain {
                    let by = sum([(error.gain[0], " dv"), (error.gain[1], ""), (0, "")]);
                    said.push(format!("the error term grew at each step by {by}, not by 2 dv"));
                }
                if error.loss != right.loss {
                    let by = sum([(error.loss[0], " du"), (error.loss[1], ""), (0, "")]);
                    said.push(format!(
                        "the error term shrank at each side step by {by}, not by 2 du"
                    ));
                }
                if error.is_lost {
                    said.push("a side step were made for one pixel alone".to_owned());
                }
                if said.is_empty() {
                    said.push("an error term were added up".to_owned());
                }
                said.push(match error.is_enough {
                    [true, true] => "a tie went on, seen from its start".to_owned(),
                    [false, false] => "a tie went back, seen from its start".to_owned(),
                    [is_on, _] => {
                        let way = if is_on { "on" } else { "back" };
                        format!("a tie went {way}, seen from its left or upper end")
                    }
                });
            }
            (Method::BothAxes { equal, is_fresh, start }, _) => {
                said.push("one error term decided the steps along both axes".to_owned());
                let [of_x, of_y] = equal.map(|is| if is { "taken" } else { "not taken" });
                said.push(format!(
                "where twice the term equals its limit, a step in x were {of_x} and one in y {of_y}"
            ));
                if is_fresh {
                    said.push("the term were doubled anew after a step in x".to_owned());
                }
                if start != [1, -1] {
                    let [dx, dy] = start;
                    said.push(format!(
                        "the term began with {dx} |dx| {dy:+} |dy|, where it should be 1 and -1"
                    ));
                }
            }
            (Method::Sampled { place, toward, steps }, _) => {
                said.extend(steps.words().map(|words| format!("its steps were {words}")));
                let what = match place {
                    Place::Added(bits) => {
                        said.push(format!(
                            "its coordinates were added up in floats of {bits} bits"
                        ));
                        "each pixel"
                    }
                    Place::Exact => "the place of each step",
                    Place::Way => "the way from the start to each step",
                    Place::Pieces(steps) => {
                        said.push(format!("each {steps} of its steps were a line of their own"));
                        "the way from its start to each step"
                    }
                };
                said.push(format!("{what} were rounded {}", toward.words()));
            }
            (Method::Error(_), _) => {}
        }
        if let Some(bits) = self.bits {
            said.push(format!("the error term were in a signed word of {bits} bits"));
        }
        if let Some(axis) = self.along {
            said.push(format!("it had one pixel for each step along {}", AXES[axis]));
        }
        said.push(match self.from {
            From::Before => "it began at its left or upper end".to_owned(),
            From::After => "it began at its right or lower end".to_owned(),
            From::First => "it began at its first end".to_owned(),
            From::Second => "it began at its last end".to_owned(),
        });
        said
    }

    /// The picture of a line; nothing where it is too long to be walked.
    pub(super) fn draw(&self, q: &AnyQuestion) -> Option<Picture> {
        let way = self.way(q)?;
        let mut picture = Picture::new(q.side);
        // Steps are many, and few of them are in the picture.
        let [columns, rows] = q.side.map(|side| i64::from(side + MARGIN));
        let mut plot = |[x, y]: [i64; 2]| {
            let margin = i64::from(MARGIN);
            if x >= -margin && x < columns && y >= -margin && y < rows {
                picture.set([x as i32, y as i32], 1);
            }
        };
        match self.method {
            Method::Error(error) => self.by_error(error, &way, &mut plot),
            Method::BothAxes { equal, is_fresh, start } => {
                self.on_both_axes(equal, is_fresh, start, &way, &mut plot);
            }
            Method::Sampled { place, toward, steps } => {
                let steps = steps.of(&way);
                match place {
                    Place::Added(bits) => added(bits, toward, steps, &way, &mut plot),
                    Place::Exact => placed(false, toward, steps, &way, &mut plot),
                    Place::Way => placed(true, toward, steps, &way, &mut plot),
                    Place::Pieces(piece) => in_pieces(piece, toward, steps, &way, &mut plot),
                }
            }
        }
        Some(picture)
    }

    /// Where the line goes; nothing where that is too far.
    fn way(&self, q: &AnyQuestion) -> Option<Way> {
        let [mut from, mut to] = [q.points[0], q.points[1]];
        let size = [0, 1].map(|axis| (to[axis] - from[axis]).abs());
        if size[0].max(size[1]) > MOST_STEPS {
            return None;
        }
        // Along an axis on which it has no length, no line can be walked.
        let longer = usize::from(size[1] > size[0]);
        let axis = self.along.filter(|along| size[*along] > 0).unwrap_or(longer);
        if self.from.is_turned(from[axis], to[axis]) {
            std::mem::swap(&mut from, &mut to);
        }
        let step = [0, 1].map(|axis| (to[axis] - from[axis]).signum());
        Some(Way { from, to, size, step, axis })
    }

    fn by_error(&self, error: Error, way: &Way, plot: Plot<'_>) {
        let (axis, side) = (way.axis, 1 - way.axis);
        let (du, dv) = (way.size[axis], way.size[side]);
        let gain = error.gain[0] * dv + error.gain[1];
        let loss = error.loss[0] * du + error.loss[1];
        let is_enough = error.is_enough[usize::from(way.step[axis] < 0)];
        let mut value = self.in_word(error.begins(du, dv));
        let mut at = way.from;
        let mut is_aside = false;
        for _ in 0..=du {
            plot(at);
            if error.is_lost && is_aside {
                at[side] -= way.step[side];
                is_aside = false;
            }
            while value > 0 || is_enough && value == 0 {
                at[side] += way.step[side];
                value -= loss;
                is_aside = true;
                // Along the shorter axis there are several steps aside, along the longer one at most one.
                if self.along.is_none() || loss <= 0 {
                    break;
                }
            }
            value = self.in_word(value + gain);
            at[axis] += way.step[axis];
        }
    }

    fn on_both_axes(
        &self,
        equal: [bool; 2],
        is_fresh: bool,
        start: [i64; 2],
        way: &Way,
        plot: Plot<'_>,
    ) {
        let [dx, dy] = way.size;
        let mut value = self.in_word(start[0] * dx + start[1] * dy);
        let mut at = way.from;
        // A walk that misses its end would not stop.
        for _ in 0..=2 * (dx + dy) {
            plot(at);
            if at == way.to {
                break;
            }
            let mut twice = self.in_word(2 * value);
            if twice > -dy || equal[0] && twice == -dy {
                value -= dy;
                at[0] += way.step[0];
            }
            if is_fresh {
                twice = self.in_word(2 * value);
            }
            if twice < dx || equal[1] && twice == dx {
                value += dx;
                at[1] += way.step[1];
            }
            value = self.in_word(value);
        }
    }

    fn in_word(&self, v: i64) -> i64 {
        // The bits that do not fit are shifted out, and the sign comes back.
        self.bits.map_or(v, |bits| v << (64 - bits) >> (64 - bits))
    }
}

fn added(bits: u32, toward: Toward, steps: i64, way: &Way, plot: Plot<'_>) {
    let mut at = way.from.map(|v| v as f64);
    let by = [0, 1].map(|axis| {
        let length = (way.to[axis] - way.from[axis]) as f64;
        float(length / steps.max(1) as f64, bits)
    });
    for _ in 0..=steps {
        plot([rounded(at[0], bits, toward), rounded(at[1], bits, toward)]);
        at[0] = float(at[0] + by[0], bits);
        at[1] = float(at[1] + by[1], bits);
    }
}

/// A point for each step, exactly: its coordinates are rounded, or its ways from the start.
fn placed(by_way: bool, toward: Toward, steps: i64, way: &Way, plot: Plot<'_>) {
    let steps = i128::from(steps.max(1));
    for step in 0..=steps {
        plot([0, 1].map(|axis| {
            let (from, to) = (i128::from(way.from[axis]), i128::from(way.to[axis]));
            let at = match by_way {
                true => {
                    from + round((to - from).abs() * step, steps, toward) * (to - from).signum()
                }
                false => round(from * steps + (to - from) * step, steps, toward),
            };
            // Between the ends, which are numbers of 64 bits.
            at as i64
        }));
    }
}

/// Pieces of so many steps, between points whose ways from the start are rounded.
fn in_pieces(piece: i64, toward: Toward, steps: i64, way: &Way, plot: Plot<'_>) {
    let joint = |step: i64| {
        [0, 1].map(|axis| {
            let (from, to) = (way.from[axis], way.to[axis]);
            let along = i128::from((to - from).abs()) * i128::from(step);
            from + round(along, steps.max(1).into(), toward) as i64 * (to - from).signum()
        })
    };
    for first in (0..=steps).step_by(piece as usize) {
        let last = (first + piece).min(steps);
        let part = Way { from: joint(first), to: joint(last), ..*way };
        placed(true, toward, last - first, &part, plot);
    }
}

/// A sum of some numbers with their units, such as '2 dv - du'.
fn sum(parts: [(i64, &str); 3]) -> String {
    let mut said = String::new();
    for (number, unit) in parts.into_iter().filter(|(number, _)| *number != 0) {
        let sign = match (number < 0, said.is_empty()) {
            (true, true) => "-",
            (true, false) => " - ",
            (false, true) => "",
            (false, false) => " + ",
        };
        let size = match number.abs() {
            1 if !unit.is_empty() => unit.trim_start().to_owned(),
            size => format!("{size}{unit}"),
        };
        said += &format!("{sign}{size}");
    }
    if said.is_empty() { "0".to_owned() } else { said }
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
        Toward::HalfEven => v.round_ties_even(),
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
        all.push(Self { is_lost: !self.is_lost, ..*self });
        for is_enough in [[true, true], [true, false], [false, true], [false, false]] {
            all.push(Self { is_enough, ..*self });
        }
        all
    }
}
