/// Bresenham's line between two pixels, both included.
pub fn line(from: [i64; 2], to: [i64; 2], mut plot: impl FnMut(i64, i64)) {
    let steep = (to[1] - from[1]).abs() > (to[0] - from[0]).abs();
    // u runs along the longer axis, v along the other one.
    let turn = |[x, y]: [i64; 2]| if steep { [y, x] } else { [x, y] };
    let (mut start, mut end) = (turn(from), turn(to));
    // Both directions of drawing start at the same end, so they give the same pixels.
    if end[0] < start[0] {
        (start, end) = (end, start);
    }
    let (du, dv) = (end[0] - start[0], (end[1] - start[1]).abs());
    let side = (end[1] - start[1]).signum();
    let mut v = start[1];
    let mut decision = 2 * dv - du;
    for u in start[0]..=end[0] {
        let [x, y] = turn([u, v]);
        plot(x, y);
        if decision >= 0 {
            v += side;
            decision -= 2 * du;
        }
        decision += 2 * dv;
    }
}

/// A star of sixteen lines.
pub fn stage2a() -> RgbImage {
    let mut picture = empty();
    for (dx, dy) in [(50, 0), (46, 19), (35, 35), (19, 46)] {
        for [x, y] in [[dx, dy], [-dy, dx], [-dx, -dy], [dy, -dx]] {
            let end = [80 + x, 60 + y];
            line([80, 60], end, |x, y| set(&mut picture, x, y, Rgb([120, 200, 255])));
        }
    }
    picture
}
