/// The places of the four samples in a pixel, in steps of the grid.
const SAMPLES: [[i64; 2]; 4] = [[96, 32], [224, 96], [32, 160], [160, 224]];

/// The triangle moved so that a sample comes to lie where the centre of its pixel was.
fn onto_centre(corners: [[i64; 2]; 3], [x, y]: [i64; 2]) -> [[i64; 2]; 3] {
    corners.map(|corner| [corner[0] + STEPS / 2 - x, corner[1] + STEPS / 2 - y])
}

/// The mean of the four samples of each pixel, halves rounded up.
fn resolve(samples: &[RgbImage; 4]) -> RgbImage {
    RgbImage::from_fn(WIDTH as u32, HEIGHT as u32, |x, y| {
        Rgb([0, 1, 2].map(|channel| {
            let sum: u32 = samples.iter().map(|one| u32::from(one.get_pixel(x, y)[channel])).sum();
            ((sum + 2) / 4) as u8
        }))
    })
}

/// The fan of stage 2b with four samples in each pixel, each of one triangle.
pub fn stage12() -> RgbImage {
    let mut samples = [(); 4].map(|()| empty());
    for (corners, colour) in (0..12).map(blade) {
        for (picture, sample) in samples.iter_mut().zip(SAMPLES) {
            cover(onto_centre(corners, sample), [0, 0, WIDTH, HEIGHT], |x, y, _| {
                set(picture, x, y, colour);
            });
        }
    }
    resolve(&samples)
}
