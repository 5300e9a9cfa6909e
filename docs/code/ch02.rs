fn main() {
    use rasterproof::contract::DrawLine;
    use rasterproof::grid::PixelRect;
    use rasterproof::line::bresenham::Bresenham;
    use rasterproof::line::dda::Dda;
    use rasterproof::triangle::{LineEnd, PixelPoint, ScreenLine};

    fn lit(drawer: &impl DrawLine, from: (i32, i32), to: (i32, i32)) -> Vec<(i32, i32)> {
        let end = |(x, y)| LineEnd { pixel: PixelPoint::new(x, y), depth: 0.0, varying: 0.0 };
        let mut pixels = Vec::new();
        let line = ScreenLine { ends: [end(from), end(to)] };
        drawer.draw(&line, PixelRect::window(16, 16), |f| pixels.push((f.x_px, f.y_px)));
        pixels
    }

    // L1. Column 4 is the tie: the height there is 12/8, and the pixel farther along is row 2.
    let there = lit(&Dda, (0, 0), (8, 3));
    assert_eq!(there, [(0, 0), (1, 0), (2, 1), (3, 1), (4, 2), (5, 2), (6, 2), (7, 3), (8, 3)]);
    assert_eq!(there, lit(&Bresenham, (0, 0), (8, 3)));
    let back = lit(&Bresenham, (8, 3), (0, 0));
    assert!(back.iter().rev().eq(&there));

    // Four billion pixels long, and done at once: 16 of them lie in the window.
    assert_eq!(lit(&Dda, (i32::MIN, i32::MIN), (i32::MAX, i32::MAX)).len(), 16);
}
