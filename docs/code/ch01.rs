fn main() {
    use rasterproof::frame::Coverage;
    use rasterproof::grid::{PixelRect, Refusal, SubpixelPoint, snap};

    // The book's lower left sample (0, 0) in a window of 64 rows is the centre of our pixel (0, 63).
    let from_book = |x: f64, y: f64| (x + 0.5, 64.0 - y - 0.5);
    let (x_px, y_px) = from_book(0.0, 0.0);
    assert_eq!((x_px, y_px), (0.5, 63.5));
    assert_eq!(SubpixelPoint::from_px(x_px, y_px), Ok(SubpixelPoint::new(128, 63 * 256 + 128)));

    // Ties go to the even neighbour, on both sides of zero.
    let ties = [-2.5, -1.5, -0.5, 0.5, 1.5, 2.5];
    assert_eq!(ties.map(|sub| snap(sub / 256.0).unwrap()), [-2, -2, 0, 0, 2, 2]);

    // No wrapping, no saturating: a number without a place is refused, with the reason.
    assert_eq!(snap(f64::NAN), Err(Refusal::NotANumber));
    assert_eq!(snap(1e22), Err(Refusal::OutOfDomain(1e22)));
    assert_eq!(
        snap(1e22).unwrap_err().to_string(),
        "1e22 px is outside the domain [-8388608, 8388608) px"
    );

    // The digit 3 out of runs of pixels (row, first column, one past the last); no pixel is hit twice.
    let mut picture = Coverage::new(PixelRect::window(6, 7), 0);
    for (y_px, x0_px, x1_px) in [(1, 1, 5), (2, 4, 5), (3, 2, 5), (4, 4, 5), (5, 1, 5)] {
        picture.hit(y_px, x0_px, x1_px);
    }
    assert_eq!((picture.covered(), picture.get(4, 3), picture.get(0, 3)), (13, Some(1), Some(0)));
    assert_eq!(picture.get(6, 3), None, "outside the frame");

    // A second hit does not vanish.
    picture.hit(3, 2, 5);
    assert_eq!(picture.row(3), [0, 0, 2, 2, 2, 0]);
}
