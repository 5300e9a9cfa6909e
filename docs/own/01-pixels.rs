use image::{Rgb, RgbImage};

const WIDTH: i64 = 160;
const HEIGHT: i64 = 120;
const BACKGROUND: Rgb<u8> = Rgb([18, 18, 24]);

fn empty() -> RgbImage {
    RgbImage::from_pixel(WIDTH as u32, HEIGHT as u32, BACKGROUND)
}

/// Sets a pixel; one outside the picture is ignored.
fn set(picture: &mut RgbImage, x: i64, y: i64, colour: Rgb<u8>) {
    if (0..WIDTH).contains(&x) && (0..HEIGHT).contains(&y) {
        picture.put_pixel(x as u32, y as u32, colour);
    }
}

/// A disc: every pixel whose centre lies in it. In half pixels the centre of pixel x is 2 x + 1.
pub fn stage1() -> RgbImage {
    let mut picture = empty();
    for y in 0..HEIGHT {
        for x in 0..WIDTH {
            let (dx, dy) = (2 * x + 1 - WIDTH, 2 * y + 1 - HEIGHT);
            if dx * dx + dy * dy < 100 * 100 {
                set(&mut picture, x, y, Rgb([240, 200, 60]));
            }
        }
    }
    picture
}
