//! What is drawn into: colours and depths of every sample, cleared, tested and resolved (the book's
//! sections 6.2 and 9.4, GAMES101 homework 2).
//!
//! Supersampling is a window of N times the size; multisampling is four planes of the same size.
//! Samples are averaged once, when everything has been drawn. To average inside the loop over
//! triangles, as the course's pitfall does, leaves black seams: what a triangle leaves of a pixel
//! to its neighbour is not background.

use super::Counters;
use super::depth::{CLEAR, DepthFormat};
use super::layers::Layers;
pub use super::sample::{Colour, SamplePlane, to_colour};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::{MAX_SIDE_PX, PixelRect};

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum Antialias {
    /// One, at the centre.
    #[default]
    None,
    /// Four at [`super::multisample::SAMPLES`], shaded once for each triangle.
    Multisample4,
    /// A regular grid of N x N, each shaded.
    Supersample(u32),
}

impl Antialias {
    /// Samples along a side of the pixel's grid: the factor of the window.
    #[must_use]
    pub fn scale(self) -> u32 {
        match self {
            Self::None | Self::Multisample4 => 1,
            Self::Supersample(n) => n,
        }
    }

    #[must_use]
    pub fn planes(self) -> usize {
        if self == Self::Multisample4 { super::multisample::SAMPLES.len() } else { 1 }
    }

    #[must_use]
    pub fn samples(self) -> u64 {
        u64::from(self.scale()).pow(2) * self.planes() as u64
    }
}

/// The most samples of a picture: 2^26, which with colour, depth and a spare are about 1 GiB.
pub const MAX_SAMPLES: u64 = 1 << 26;

/// Checks a picture's size.
///
/// # Errors
/// In words, for a side of 0 or more than [`MAX_SIDE_PX`], or more than [`MAX_SAMPLES`] samples.
pub fn check_size(width: u32, height: u32, antialias: Antialias) -> Result<(), String> {
    let scale = antialias.scale();
    let sides = [width, height].map_array(|side| u64::from(side) * u64::from(scale));
    if width == 0 || height == 0 || scale == 0 {
        return Err(format!("a picture of {width} x {height} px has no pixels"));
    }
    if sides.iter().any(|&side| side > MAX_SIDE_PX.into()) {
        let samples = if scale == 1 { "sample" } else { "samples" };
        return Err(format!(
            "a picture of {width} x {height} px, {scale} {samples} a side, is too large; \
             a side has at most {MAX_SIDE_PX} samples"
        ));
    }
    let samples = u64::from(width) * u64::from(height) * antialias.samples();
    if samples > MAX_SAMPLES {
        return Err(format!("{samples} samples are too many; a picture has at most {MAX_SAMPLES}"));
    }
    Ok(())
}

/// What is known of one triangle in each pixel, while its four samples are drawn.
#[derive(Clone, Debug)]
pub(super) struct Shading {
    serial: u64,
    /// The colour at a sample, and which triangle it is of; empty where nothing is multisampled.
    colours: Frame<(u64, Colour)>,
    /// [`Shading::CENTRE`] where the triangle covers the centre, with a bit for each sample that
    /// waits for the colour there. 0 everywhere between two triangles.
    pub(super) centres: Frame<u8>,
}

impl Shading {
    pub(super) const CENTRE: u8 = 0x80;

    /// The colour that this triangle has in a pixel already.
    #[inline]
    pub(super) fn get(&self, x_px: i32, y_px: i32) -> Option<Colour> {
        let (serial, colour) = self.colours.get(x_px, y_px)?;
        (serial == self.serial).then_some(colour)
    }

    #[inline]
    pub(super) fn put(&mut self, x_px: i32, y_px: i32, colour: Colour) {
        self.colours.span_mut(y_px, x_px, x_px + 1)[0] = (self.serial, colour);
    }

    /// Notes a sample of the pixels whose bits are set; the bits of those that the triangle does not
    /// cover at the centre.
    #[inline]
    pub(super) fn wait(&mut self, y_px: i32, x0_px: i32, visible: u32, sample: usize) -> u32 {
        let end_px = x0_px + (u32::BITS - visible.leading_zeros()) as i32;
        let mut outside = 0;
        for (i, centre) in self.centres.span_mut(y_px, x0_px, end_px).iter_mut().enumerate() {
            let (is_visible, is_inside) = (visible >> i & 1, u32::from(*centre) >> 7);
            *centre |= ((is_visible & is_inside) as u8) << sample;
            outside |= (is_visible & !is_inside) << i;
        }
        outside
    }
}

#[derive(Clone, Debug)]
pub struct Target {
    antialias: Antialias,
    size: PixelRect,
    shading: Shading,
    /// Room for two keys of each pixel, kept from frame to frame by those who use it.
    intervals: Option<Frame<[u64; 2]>>,
    layers: Layers,
    pub format: DepthFormat,
    /// One plane, or four of [`Antialias::Multisample4`].
    pub planes: Vec<SamplePlane>,
}

impl Target {
    /// A target for `width` x `height` pixels, cleared to black.
    pub fn new(
        width: u32,
        height: u32,
        antialias: Antialias,
        format: DepthFormat,
    ) -> Result<Self, String> {
        check_size(width, height, antialias)?;
        Ok(Self::unchecked(width, height, antialias, format))
    }

    /// An empty target for the same picture with one sample a pixel.
    pub(crate) fn single(&self) -> Self {
        Self::unchecked(self.size.width(), self.size.height(), Antialias::None, self.format)
    }

    fn unchecked(width: u32, height: u32, antialias: Antialias, format: DepthFormat) -> Self {
        let scale = antialias.scale();
        let bounds = PixelRect::window(width * scale, height * scale);
        let plane = SamplePlane {
            colour: Frame::new(bounds, [0, 0, 0, u8::MAX]),
            depth: Frame::new(bounds, CLEAR),
        };
        let size = PixelRect::window(width, height);
        let shaded =
            if antialias == Antialias::Multisample4 { size } else { PixelRect::window(0, 0) };
        let (colours, centres) = (Frame::new(shaded, (0, [0; 4])), Frame::new(shaded, 0));
        let shading = Shading { serial: 0, colours, centres };
        let planes = vec![plane; antialias.planes()];
        let layers = Layers::default();
        Self { antialias, size, shading, intervals: None, layers, format, planes }
    }

    /// Room for two keys of each pixel, with whatever stands there.
    pub(crate) fn take_intervals(&mut self) -> Frame<[u64; 2]> {
        self.intervals.take().unwrap_or_else(|| Frame::new(self.size, [0; 2]))
    }

    /// Keeps that room for the next frame.
    pub(crate) fn keep_intervals(&mut self, intervals: Frame<[u64; 2]>) {
        self.intervals = Some(intervals);
    }

    #[must_use]
    pub fn size(&self) -> PixelRect {
        self.size
    }

    /// The window that triangles are drawn into: N times the size where supersampled.
    #[must_use]
    pub fn bounds(&self) -> PixelRect {
        self.planes[0].colour.bounds()
    }

    #[must_use]
    pub fn antialias(&self) -> Antialias {
        self.antialias
    }

    /// The planes, and room for the colours of one more triangle.
    pub(super) fn with_shading(&mut self) -> (&mut [SamplePlane], &mut Shading) {
        let (planes, shading, _) = self.with_layers();
        (planes, shading)
    }

    /// The same, and the layers that wait to be mixed.
    pub(super) fn with_layers(&mut self) -> (&mut [SamplePlane], &mut Shading, &mut Layers) {
        self.shading.serial += 1;
        (&mut self.planes, &mut self.shading, &mut self.layers)
    }

    /// Forgets the layers of a frame that was not finished.
    pub(crate) fn clear_layers(&mut self) {
        self.layers.all.clear();
    }

    /// Mixes the layers that wait, of each sample at most so many of the nearest.
    pub(crate) fn mix_layers(&mut self, most: u32, counters: &mut Counters) {
        counters.layers += self.layers.all.len() as u64;
        counters.layers_left_out += self.layers.mix(most, &mut self.planes);
    }

    /// Forgets the last frame's colours (section 9.4.1).
    pub fn clear_colour(&mut self, colour: Colour, counters: &mut Counters) {
        for plane in &mut self.planes {
            plane.colour.fill(colour);
        }
        counters.cleared += self.sample_count();
    }

    /// Forgets the last frame's depths.
    pub fn clear_depth(&mut self, counters: &mut Counters) {
        for plane in &mut self.planes {
            plane.depth.fill(CLEAR);
        }
        counters.depths_cleared += self.sample_count();
    }

    /// Forgets the last frame's colours in some tiles of [`Target::bounds`].
    pub fn clear_tiles(&mut self, tiles: &[PixelRect], colour: Colour, counters: &mut Counters) {
        for plane in &mut self.planes {
            for tile in tiles {
                counters.cleared += u64::from(tile.width()) * u64::from(tile.height());
                for y_px in tile.y0..tile.y1 {
                    plane.colour.span_mut(y_px, tile.x0, tile.x1).fill(colour);
                }
            }
        }
    }

    pub(crate) fn pixel_count(&self) -> u64 {
        u64::from(self.size.width()) * u64::from(self.size.height())
    }

    pub(crate) fn sample_count(&self) -> u64 {
        self.pixel_count() * self.antialias.samples()
    }

    /// The picture: each pixel the mean of its samples, a half rounded up. Whole numbers, so a
    /// pixel of one colour keeps it.
    #[must_use]
    pub fn resolve(&self) -> Frame<Colour> {
        if self.antialias.samples() == 1 {
            return self.planes[0].colour.clone();
        }
        let mut picture = Frame::new(self.size, [0; 4]);
        let mut sums = Vec::new();
        for y_px in self.size.y0..self.size.y1 {
            self.resolve_run(y_px, self.size.x0, picture.row_mut(y_px), &mut sums);
        }
        picture
    }

    /// The means of the samples of adjacent pixels in a row; `sums` is room that several runs share.
    pub(crate) fn resolve_run(
        &self,
        y_px: i32,
        x0_px: i32,
        pixels: &mut [Colour],
        sums: &mut Vec<[u32; 4]>,
    ) {
        let (scale, samples) = (self.antialias.scale() as usize, self.antialias.samples() as u32);
        let columns = x0_px as usize * scale..(x0_px as usize + pixels.len()) * scale;
        sums.clear();
        sums.resize(pixels.len(), [0; 4]);
        for plane in &self.planes {
            for y in y_px * scale as i32..(y_px + 1) * scale as i32 {
                add(sums, &plane.colour.row(y)[columns.clone()], scale);
            }
        }
        for (pixel, sum) in pixels.iter_mut().zip(sums) {
            *pixel = mean(*sum, samples);
        }
    }

    #[must_use]
    pub fn pixel(&self, x_px: i32, y_px: i32) -> Colour {
        let mut pixel = [[0; 4]];
        self.resolve_run(y_px, x_px, &mut pixel, &mut Vec::new());
        pixel[0]
    }
}

/// Adds `scale` adjacent colours to each sum.
fn add(sums: &mut [[u32; 4]], colours: &[Colour], scale: usize) {
    let add = |sum: &mut [u32; 4], colour: &Colour| {
        for (sum, channel) in sum.iter_mut().zip(colour) {
            *sum += u32::from(*channel);
        }
    };
    if scale == 1 {
        sums.iter_mut().zip(colours).for_each(|(sum, colour)| add(sum, colour));
    } else {
        for (sum, colours) in sums.iter_mut().zip(colours.chunks_exact(scale)) {
            colours.iter().for_each(|colour| add(sum, colour));
        }
    }
}

/// The mean of so many samples, a half rounded up.
#[inline]
fn mean(sum: [u32; 4], samples: u32) -> Colour {
    // Mostly a power of two; a division by a number that is not known before is slow.
    let part = |sum: u32| {
        let sum = sum + samples / 2;
        if samples.is_power_of_two() { sum >> samples.ilog2() } else { sum / samples }
    };
    // A mean of bytes is a byte.
    [part(sum[0]) as u8, part(sum[1]) as u8, part(sum[2]) as u8, part(sum[3]) as u8]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quarter_and_three_quarters_leave_no_seam() {
        let mut target = Target::new(1, 1, Antialias::Supersample(2), DepthFormat::F64).unwrap();
        let mut set = |x, y, colour| target.planes[0].test_and_write(x, y, 7, || colour);
        let (green, blue) = ([0, 255, 0, 255], [0, 0, 255, 255]);
        assert!(set(0, 0, green) && set(1, 0, blue) && set(0, 1, blue) && set(1, 1, blue));
        assert!(!set(1, 1, green), "an equal depth keeps what was first");
        // 255 / 4 = 63.75 and 3 * 255 / 4 = 191.25.
        assert_eq!(target.resolve().get(0, 0), Some([0, 64, 191, 255]));
    }

    #[test]
    fn one_colour_stays_one_colour() {
        for antialias in [Antialias::None, Antialias::Multisample4, Antialias::Supersample(3)] {
            let mut target = Target::new(5, 4, antialias, DepthFormat::Unorm32).unwrap();
            target.clear_colour([1, 77, 254, 255], &mut Counters::default());
            let picture = target.resolve();
            assert!(picture.rows().all(|(_, row)| row.iter().all(|c| *c == [1, 77, 254, 255])));
        }
    }

    #[test]
    fn sizes() {
        assert!(check_size(100_000, 100_000, Antialias::None).unwrap_err().contains("too large"));
        assert!(check_size(0, 4, Antialias::None).is_err());
        assert!(check_size(16384, 16384, Antialias::None).unwrap_err().contains("samples"));
        assert!(check_size(16384, 2, Antialias::Supersample(2)).is_err());
        assert!(check_size(u32::MAX, 2, Antialias::Supersample(u32::MAX)).is_err());
        assert!(check_size(1024, 1024, Antialias::Supersample(4)).is_ok());
    }
}
