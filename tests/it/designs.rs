//! Wrong rasterizers that the families of dangers hardly see, and the designs do: each is wrong under two facts together.

use rasterproof::cases::triangles::FAMILIES;
use rasterproof::cases::{Case, Family, FamilyName};
use rasterproof::contract::Rasterize;
use rasterproof::grid::PixelRect;
use rasterproof::oracle::Oracle;
use rasterproof::triangle::{Corners, Span};

/// What is wrong of a span that is right: it is changed, or dropped.
type Fault = fn(&[[i64; 2]; 3], PixelRect, Span) -> Option<Span>;

/// The oracle with a fault.
struct Wrong(Fault);

impl Rasterize for Wrong {
    fn cover(&self, corners: Corners, bounds: PixelRect, mut emit: impl FnMut(Span)) {
        let points = corners.map(|p| [i64::from(p.x), i64::from(p.y)]);
        Oracle.cover(corners, bounds, |span| {
            (self.0)(&points, bounds, span).into_iter().for_each(&mut emit);
        });
    }
}

fn least(points: &[[i64; 2]; 3], axis: usize) -> i64 {
    points.iter().map(|p| p[axis]).min().unwrap()
}

fn most(points: &[[i64; 2]; 3], axis: usize) -> i64 {
    points.iter().map(|p| p[axis]).max().unwrap()
}

/// A span without its last pixel.
fn shorter(span: Span) -> Option<Span> {
    (span.x1_px > span.x0_px + 1).then(|| Span { x1_px: span.x1_px - 1, ..span })
}

const FAULTS: [(&str, Fault); 10] = [
    ("the last row of windows of odd height that are wider than 32 px", |_, window, span| {
        let is_lost = window.height() % 2 == 1 && window.width() > 32 && span.y_px == window.y1 - 1;
        (!is_lost).then_some(span)
    }),
    ("windows of one column, clockwise", |points, window, span| {
        let [a, b, c] = points;
        let turns = (b[0] - a[0]) * (c[1] - a[1]) > (b[1] - a[1]) * (c[0] - a[0]);
        (window.width() > 1 || !turns).then_some(span)
    }),
    ("far to the left and far below", |points, window, span| {
        let far = 32_768 * 256;
        let is_far = least(points, 0) < -far && most(points, 1) > far + i64::from(window.y1) * 256;
        if is_far { shorter(span) } else { Some(span) }
    }),
    ("columns from 256 on of triangles that are one row high", |points, _, span| {
        let is_low = most(points, 1) - least(points, 1) < 512;
        if is_low && span.x1_px > 256 { shorter(span) } else { Some(span) }
    }),
    ("row 40 of triangles with an upright edge", |points, _, span| {
        let is_upright = (0..3).any(|i| points[i][0] == points[(i + 1) % 3][0]);
        (!is_upright || span.y_px != 40).then_some(span)
    }),
    (
        "corners on whole pixels in windows whose width is a multiple of 16",
        |points, window, span| {
            let is_whole = points.iter().flatten().all(|v| v % 256 == 0);
            if is_whole && window.width() % 16 == 0 { shorter(span) } else { Some(span) }
        },
    ),
    ("slivers that begin in a column of 8", |points, _, span| {
        let height = most(points, 1) - least(points, 1);
        let is_thin = most(points, 0) - least(points, 0) > 64 * height;
        (!is_thin || span.x0_px % 8 != 0).then_some(span)
    }),
    ("more than 64 px wide in a window of two rows", |points, window, span| {
        let is_wide = most(points, 0) - least(points, 0) > 64 * 256;
        (!is_wide || window.height() != 2).then_some(span)
    }),
    ("a level lower edge outside the window on the right", |points, window, span| {
        let lowest = most(points, 1);
        let is_level = points.iter().filter(|p| p[1] == lowest).count() > 1;
        let is_out = least(points, 0) >= 0 && most(points, 0) > i64::from(window.x1) * 256;
        if is_level && is_out { shorter(span) } else { Some(span) }
    }),
    ("the first corner uppermost, above 2^20 px", |points, _, span| {
        let is_high = points[0][1] < -(1 << 28) && points[0][1] == least(points, 1);
        (!is_high).then_some(span)
    }),
];

/// In how many of the first cases of a family that a program is asked it is wrong.
fn wrong_cases(fault: Fault, family: &Family) -> usize {
    let spans = |case: &Case, drawn: &dyn Fn(Corners, &mut Vec<Span>)| {
        let mut spans = Vec::new();
        case.triangles().iter().for_each(|triangle| drawn(triangle.corners(), &mut spans));
        spans
    };
    let is_wrong = |index: &u64| {
        let case = family.case(1, *index);
        let right =
            spans(&case, &|corners, out| Oracle.cover(corners, case.window, |s| out.push(s)));
        let drawn =
            spans(&case, &|corners, out| Wrong(fault).cover(corners, case.window, |s| out.push(s)));
        drawn != right
    };
    (0..1000).filter(is_wrong).count()
}

/// In the default number of cases of a program the design finds every one of them.
#[test]
fn designs_find_what_needs_two_facts() {
    let is_design = |family: &&Family| family.name == FamilyName::Design.as_str();
    let (design, others): (Vec<_>, Vec<_>) = FAMILIES.iter().partition(is_design);
    let mut missed = Vec::new();
    for (name, fault) in FAULTS {
        let by_design = wrong_cases(fault, design[0]);
        let by_others: usize = others.iter().map(|family| wrong_cases(fault, family)).sum();
        println!("{name}: {by_design} cases of the design, {by_others} of the other families");
        if by_design == 0 {
            missed.push(name);
        }
    }
    assert!(missed.is_empty(), "{missed:?}");
}
