//! Buffer views that meshoptimizer compressed.

use meshoptimizer::{
    decode_filter_exp, decode_filter_oct, decode_filter_quat, decode_index_buffer,
    decode_index_sequence, decode_vertex_buffer,
};

use super::document::Compressed;

/// The extension of such buffer views.
pub(super) const EXTENSION: &str = "EXT_meshopt_compression";

/// The bytes of a view that takes at most so many.
pub(super) fn decode(view: &Compressed, bytes: &[u8], most: usize) -> Result<Vec<u8>, String> {
    decompressed(view, bytes, most).map_err(|error| format!("{EXTENSION}: {error}"))
}

/// The same, with an error that does not name the extension.
fn decompressed(view: &Compressed, bytes: &[u8], most: usize) -> Result<Vec<u8>, String> {
    let &Compressed { count, byte_stride: stride, ref mode, ref filter, .. } = view;
    let size = count.checked_mul(stride).filter(|&size| size <= most);
    let size = size
        .ok_or_else(|| format!("{count} times {stride} bytes are more than the {most} allowed"))?;
    // A filter turns the whole numbers that were stored into those of the attribute.
    let filter = filter.as_deref().unwrap_or("NONE");
    let decoded = match (mode.as_str(), filter, stride) {
        ("ATTRIBUTES", ..) => {
            let mut decoded = vec![0; size];
            let filtered = match filter {
                "NONE" => |_: &mut [u8], _, _| Ok(()),
                "OCTAHEDRAL" => decode_filter_oct,
                "QUATERNION" => decode_filter_quat,
                "EXPONENTIAL" => decode_filter_exp,
                other => return Err(format!("no filter is named `{other}`")),
            };
            decode_vertex_buffer(&mut decoded, count, stride, bytes, bytes.len())
                .and_then(|()| filtered(&mut decoded, count, stride))
                .map(|()| decoded)
        }
        ("TRIANGLES" | "INDICES", "NONE", 2 | 4) => {
            let decode =
                if mode == "INDICES" { decode_index_sequence } else { decode_index_buffer };
            let mut indices = vec![0_u32; count];
            let written = |index: &u32| index.to_le_bytes().into_iter().take(stride);
            decode(&mut indices, count, bytes, bytes.len())
                .map(|()| indices.iter().flat_map(written).collect())
        }
        ("TRIANGLES" | "INDICES", "NONE", _) => return Err(format!("indices of {stride} bytes")),
        ("TRIANGLES" | "INDICES", ..) => {
            return Err(format!("the filter {filter} is for attributes alone"));
        }
        (other, ..) => return Err(format!("no mode is named `{other}`")),
    };
    decoded.map_err(|error| error.to_string())
}
