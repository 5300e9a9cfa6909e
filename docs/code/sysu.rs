fn main() {
    use glam::DVec4;
    use rasterproof::contract::DrawLine;
    use rasterproof::grid::{PixelRect, SubpixelPoint};
    use rasterproof::line::bresenham::Bresenham;
    use rasterproof::line::dda::Dda;
    use rasterproof::triangle::{LineEnd, PixelPoint, ScreenLine};
    use rasterproof_render::pipeline::Counters;
    use rasterproof_render::pipeline::assemble::{Assembler, Cull};

    // Task 1: the line through a tie, both ways, by both drawers.
    let window = PixelRect::window(4, 4);
    fn pixels(drawer: &impl DrawLine, ends: [(i32, i32); 2], window: PixelRect) -> Vec<(i32, i32)> {
        let end = |(x, y)| LineEnd { pixel: PixelPoint::new(x, y), depth: 0.0, varying: 0.0 };
        let mut list = Vec::new();
        drawer.draw(&ScreenLine { ends: ends.map(end) }, window, |f| list.push((f.x_px, f.y_px)));
        list.sort();
        list
    }
    let forwards = pixels(&Bresenham, [(0, 0), (2, 1)], window);
    assert_eq!(forwards, pixels(&Bresenham, [(2, 1), (0, 0)], window));
    assert_eq!(forwards, pixels(&Dda, [(0, 0), (2, 1)], window));

    // Task 2: a triangle around the whole screen, all corners outside, is cut and not dropped.
    let assembler = Assembler::new(window, Cull::None);
    let around = [(-9.0, -3.0), (9.0, -3.0), (0.0, 9.0)]
        .map(|(x, y)| assembler.point(DVec4::new(x, y, 0.0, 1.0)));
    let mut counters = Counters::default();
    let mut pieces = 0;
    assembler.assemble(around.each_ref(), |_| [0.0; 3], &mut counters, |_| pieces += 1);
    assert_eq!((counters.rejected, counters.clipped), (0, 1));
    assert!(pieces > 0);

    // Task 3: the same three corners in the other order are the other side.
    let p = |x, y| SubpixelPoint::new(x, y);
    let [a, b, c] = [p(0, 0), p(256, 0), p(0, 256)];
    assert!(Cull::Clockwise.removes([a, b, c]) && !Cull::Clockwise.removes([a, c, b]));

    // Task 4: the product that 32 bits cannot hold.
    assert_eq!(46_341i32.checked_mul(46_341), None);
}
