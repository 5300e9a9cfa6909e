//! `planes values|bounds`: depth and attributes of each pixel of triangles, or the bounds of their errors, from planes as tiles have
//! them. Requests and answers are those of the line protocol, I and F; `proof/check` compares them with the proved model.

use std::io::BufRead as _;

use rasterproof_core::contract::Rasterize as _;
use rasterproof_core::grid::{PixelRect, SUBPIXEL_BITS};
use rasterproof_core::triangle::ScreenVertex;
use rasterproof_tiles::coverage::Tiles;
use rasterproof_tiles::frames::planes::{ATTRIBUTES, Bounded};

fn main() {
    let bounds = match std::env::args().nth(1).as_deref() {
        Some("values") => false,
        Some("bounds") => true,
        _ => panic!("usage: planes values|bounds <REQUESTS"),
    };
    for line in std::io::stdin().lock().lines() {
        println!("{}", answer(&line.expect("requests are text"), bounds));
    }
}

fn answer(request: &str, bounds: bool) -> String {
    let words: Vec<&str> = request.split(' ').collect();
    let numbers: Vec<f64> = words[2..].iter().map(|word| word.parse().expect(word)).collect();
    let window = PixelRect::window(numbers[0] as u32, numbers[1] as u32);
    let vertices = [0, 1, 2].map(|i| {
        let [x, y, z, w, a, b] = std::array::from_fn(|j| numbers[2 + 6 * i + j]);
        let vertex = ScreenVertex::new(x, y, z, w, ()).expect("requests are in the domain");
        let mut values = [0.0; ATTRIBUTES];
        values[..2].copy_from_slice(&[a, b]);
        (vertex, values)
    });
    let (corners, values) = (vertices.map(|v| v.0), vertices.map(|v| v.1));
    let side = |v: [i32; 3]| {
        (v[0].min(v[1]).min(v[2]) >> SUBPIXEL_BITS, (v[0].max(v[1]).max(v[2]) >> SUBPIXEL_BITS) + 1)
    };
    let positions = corners.map(|corner| corner.position);
    let ((x0, x1), (y0, y1)) = (side(positions.map(|p| p.x)), side(positions.map(|p| p.y)));
    let shown = PixelRect { x0, y0, x1, y1 }.intersect(&window);
    let engine = Tiles::default();
    let mut fragments = Vec::new();
    engine.cover(positions, window, |span| {
        fragments.extend((span.x0_px..span.x1_px).map(|x_px| (x_px, span.y_px)));
    });
    let mut answered = vec!["F".to_owned(), words[1].to_owned(), fragments.len().to_string()];
    if fragments.is_empty() {
        return answered.join(" ");
    }
    let planes = Bounded::new(engine, &corners, &values, shown, false);
    for (x_px, y_px) in fragments {
        let (x, y) = (f64::from(x_px), f64::from(y_px));
        answered.extend([x_px.to_string(), y_px.to_string()]);
        let found = [planes.depth_at(x, y), planes.value(0, x, y), planes.value(1, x, y)];
        answered.extend(found.map(|(value, bound)| {
            // A value without a bound may be anything.
            let number = if bounds || bound == f64::INFINITY { bound } else { value.into() };
            format!("{number:?}")
        }));
    }
    answered.join(" ")
}
