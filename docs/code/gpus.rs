fn main() {
    // A triangle in quarter pixels, clockwise with y down, so that all three functions are positive inside.
    // The sample of pixel (x, y) is (4x + 2, 4y + 2); none lies on an edge, so no rule for ties is needed.
    let corners = [(5, 9), (253, 61), (81, 243)];
    let edge = |i: usize, (x, y): (i32, i32)| {
        let ((ax, ay), (bx, by)) = (corners[i], corners[(i + 1) % 3]);
        (bx - ax) * (y - ay) - (by - ay) * (x - ax)
    };
    let sample = |x: i32, y: i32| (4 * x + 2, 4 * y + 2);
    let is_inside = |x, y| (0..3).all(|i| edge(i, sample(x, y)) > 0);

    // One after another, in the bounding box: columns 1 to 62, rows 2 to 60.
    let in_box: usize = (2..=60).map(|y| (1..=62).filter(|&x| is_inside(x, y)).count()).sum();
    assert_eq!((59 * 62, in_box), (3658, 1686));

    // By tiles of 8 x 8. A linear function is least and largest at corners of the tile.
    let (mut whole, mut empty, mut mixed, mut covered) = (0, 0, 0, 0);
    for (tx, ty) in (0..64).map(|t| (t % 8 * 8, t / 8 * 8)) {
        let at = |i, pick: fn(i32, i32) -> i32| {
            let ends =
                [(0, 0), (7, 0), (0, 7), (7, 7)].map(|(x, y)| edge(i, sample(tx + x, ty + y)));
            ends.into_iter().reduce(pick).unwrap()
        };
        if (0..3).any(|i| at(i, i32::max) < 0) {
            empty += 1;
        } else if (0..3).all(|i| at(i, i32::min) > 0) {
            whole += 1;
            covered += 64;
        } else {
            mixed += 1;
            covered += (0..64).filter(|p| is_inside(tx + p % 8, ty + p / 8)).count();
        }
    }
    assert_eq!((whole, empty, mixed, covered), (16, 26, 22, 1686));
}
