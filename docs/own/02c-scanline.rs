/// The first column or row whose centre lies at or beyond a coordinate, which is a quotient.
fn first_centre(above: i128, below: i128) -> i64 {
    // The centre of column x is at x + 1/2 pixels, so x is the quotient less half a pixel, rounded up.
    let steps = below * i128::from(STEPS);
    -(below * i128::from(STEPS / 2) - above).div_euclid(steps) as i64
}

/// The first column whose centre lies on the edge from a down to b or to the right of it, at the height y.
fn first_column(a: [i64; 2], b: [i64; 2], y: i64) -> i64 {
    let [rise, run] = [b[1] - a[1], b[0] - a[0]].map(i128::from);
    first_centre(i128::from(a[0]) * rise + i128::from(y - a[1]) * run, rise)
}

/// The same pixels row by row: for each row of the window its first column, and one past its last.
pub fn rows(
    mut corners: [[i64; 2]; 3],
    [x0, y0, x1, y1]: [i64; 4],
    mut emit: impl FnMut(i64, i64, i64),
) {
    corners.sort_by_key(|corner| corner[1]);
    let [top, middle, bottom] = corners;
    let first_row = |corner: [i64; 2]| first_centre(corner[1].into(), 1);
    for y in y0.max(first_row(top))..y1.min(first_row(bottom)) {
        let centre = y * STEPS + STEPS / 2;
        let long = first_column(top, bottom, centre);
        let short = if centre < middle[1] {
            first_column(top, middle, centre)
        } else {
            first_column(middle, bottom, centre)
        };
        let (from, to) = (x0.max(long.min(short)), x1.min(long.max(short)));
        if from < to {
            emit(y, from, to);
        }
    }
}

/// The fan of the stage before, row by row.
pub fn stage2c() -> RgbImage {
    let mut picture = empty();
    for (corners, colour) in (0..12).map(blade) {
        rows(corners, [0, 0, WIDTH, HEIGHT], |y, from, to| {
            (from..to).for_each(|x| set_once(&mut picture, x, y, colour));
        });
    }
    picture
}
