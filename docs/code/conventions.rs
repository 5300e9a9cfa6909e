fn main() {
    use rasterproof::contract::Rasterize;
    use rasterproof::frame::Coverage;
    use rasterproof::grid::SubpixelPoint;
    use rasterproof::raster::scanline::Scanline;
    use rasterproof_verify::ask::Search;
    use rasterproof_verify::convention::{
        Confidence, Declarations, Shape, TriangleQuestion, diagnose,
    };

    /// The scanline, for corners that are cut to whole pixels.
    fn draw(question: &TriangleQuestion) -> Option<Coverage> {
        let cut = |c: SubpixelPoint| SubpixelPoint::new(c.x / 256 * 256, c.y / 256 * 256);
        let mut picture = Coverage::new(question.window, 0);
        let corners = question.corners.map(cut);
        Scanline.cover(corners, question.window, |s| picture.hit(s.y_px, s.x0_px, s.x1_px));
        Some(picture)
    }

    // The search is a value: it says what to ask next, and whoever can answer does.
    let known = Declarations::default();
    let search = Search::new(async |asker| diagnose(&asker, &known, 1).await);
    let found = search.answered_by(|questions| questions.iter().map(draw).collect());
    assert_eq!(found.confidence, Confidence::Certain);
    assert_eq!(found.convention.shape, Shape::Point { x: 128, y: 128 });
    assert_eq!(
        found.sentence(),
        "It moves corners to whole pixels (toward zero), samples at the pixel's centre and follows the top-left rule."
    );
}
