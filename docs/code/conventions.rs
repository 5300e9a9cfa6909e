fn main() {
    use rasterproof::contract::Rasterize;
    use rasterproof::frame::Coverage;
    use rasterproof::grid::SubpixelPoint;
    use rasterproof::raster::scanline::Scanline;
    use rasterproof_verify::convention::{
        Ask, Confidence, Declarations, Shape, TriangleQuestion, diagnose,
    };

    /// The scanline, for corners that are cut to whole pixels.
    struct Cut;

    impl Ask for Cut {
        fn ask(&mut self, questions: &[TriangleQuestion]) -> Vec<Option<Coverage>> {
            let cut = |c: SubpixelPoint| SubpixelPoint::new(c.x / 256 * 256, c.y / 256 * 256);
            let draw = |question: &TriangleQuestion| {
                let mut picture = Coverage::new(question.window, 0);
                let corners = question.corners.map(cut);
                Scanline.cover(corners, question.window, |s| picture.hit(s.y_px, s.x0_px, s.x1_px));
                Some(picture)
            };
            questions.iter().map(draw).collect()
        }
    }

    let found = diagnose(&mut Cut, &Declarations::default(), 1);
    assert_eq!(found.confidence, Confidence::Certain);
    assert_eq!(found.convention.shape, Shape::Point { x: 128, y: 128 });
    assert_eq!(
        found.sentence(),
        "It moves corners to whole pixels (toward zero), samples at the pixel's centre and follows the top-left rule."
    );
}
