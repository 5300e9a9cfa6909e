//! Buffer views that meshoptimizer compressed.

use meshoptimizer_rs::codec::{BufferView, Filter, Mode};
use meshoptimizer_rs::{Limits, Workspace};

use super::document::Compressed;

/// The extension of such buffer views.
pub(super) const EXTENSION: &str = "EXT_meshopt_compression";

/// The bytes of a view that takes at most so many.
pub(super) fn decode(view: &Compressed, bytes: &[u8], most: usize) -> Result<Vec<u8>, String> {
    let Compressed { count, byte_stride, mode, filter, .. } = view;
    let decode = || {
        let (mode, filter) =
            (Mode::parse(mode)?, Filter::parse(filter.as_deref().unwrap_or("NONE"))?);
        let layout = BufferView::new(mode, filter, *count, *byte_stride)?;
        let limits = Limits { max_bytes: most, ..Limits::default() };
        layout.decode(bytes, &mut Workspace::new(limits))
    };
    decode().map_err(|error| format!("{EXTENSION}: {error}"))
}
