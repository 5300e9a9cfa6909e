//! Two buffers: the one that is looked at never shows an unfinished frame (the book's section 9.4.2).

use super::Counters;
use super::target::{Colour, Target};
use rasterproof_core::frame::Frame;

/// A frame that is looked at, and one that is drawn into.
#[derive(Clone, Debug)]
pub struct DoubleBuffer {
    front: Frame<Colour>,
    pub back: Target,
}

impl DoubleBuffer {
    /// Shows what the back buffer holds now.
    #[must_use]
    pub fn new(back: Target) -> Self {
        Self { front: back.resolve(), back }
    }

    #[must_use]
    pub fn front(&self) -> &Frame<Colour> {
        &self.front
    }

    /// The front, and where the next frame is drawn.
    pub(crate) fn split(&mut self) -> (&mut Frame<Colour>, &mut Target) {
        (&mut self.front, &mut self.back)
    }

    /// Shows a finished frame: what was drawn into the back buffer, resolved.
    pub fn present(&mut self, finished: Frame<Colour>, counters: &mut Counters) {
        self.front = finished;
        let size = self.front.bounds();
        counters.presented += u64::from(size.width()) * u64::from(size.height());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pipeline::depth::DepthFormat;
    use crate::pipeline::target::Antialias;

    #[test]
    fn a_viewer_never_sees_half_a_frame() {
        let target = Target::new(2, 1, Antialias::None, DepthFormat::F64).unwrap();
        let mut buffers = DoubleBuffer::new(target);
        let before = buffers.front().clone();
        let mut counters = Counters::default();
        buffers.back.planes[0].write(0, 0, [9, 9, 9, 255]);
        // With one buffer the viewer would look at this.
        assert!(buffers.back.resolve() != before);
        assert!(*buffers.front() == before);
        buffers.back.planes[0].write(1, 0, [8, 8, 8, 255]);
        buffers.present(buffers.back.resolve(), &mut counters);
        assert!(*buffers.front() == buffers.back.resolve());
        assert_eq!(counters.presented, 2);
    }
}
