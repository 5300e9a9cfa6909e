//! Triangles that are compressed by Draco.

use draco_core::{DecodeLimits, DecoderBuffer, ErrorKind, FaceIndex, Mesh, MeshDecoder};
use glam::DVec3;
use rasterproof_render::pipeline::assemble::ClipPoint;
use serde_json::Value;

use super::CORNER_BYTES;
use super::data::Data;
use super::document::Primitive;
use rasterproof_core::arrays::MapArray as _;

/// The extension of a primitive that is compressed.
pub(super) const EXTENSION: &str = "KHR_draco_mesh_compression";

/// The vertices and triangles of a primitive.
pub(super) struct DecodedPrimitive {
    mesh: Mesh,
    /// The number of each attribute within the compressed bytes.
    numbers: Vec<(String, u32)>,
}

/// What a point takes and what a triangle does until they are drawn.
const BYTES: [u64; 2] =
    [(size_of::<ClipPoint>() + 3 * size_of::<DVec3>()) as u64, 3 * CORNER_BYTES];

/// Decodes a primitive, which takes at most so many bytes, and subtracts them: a few hundred bytes may describe millions of
/// triangles. Nothing of one that is not compressed.
pub(super) fn decode(
    data: &Data<'_>,
    primitive: &Primitive,
    left_bytes: &mut u64,
) -> Result<Option<DecodedPrimitive>, String> {
    let Some(value) = &primitive.extensions.draco else { return Ok(None) };
    let view = value.get("bufferView").and_then(Value::as_u64);
    let view = view.and_then(|view| usize::try_from(view).ok());
    let (bytes, _) = data.view(view.ok_or(format!("{EXTENSION} names no bufferView"))?)?;
    let mut mesh = Mesh::new();
    let limits = DecodeLimits::default().with_max_decoded_bytes(*left_bytes);
    let [points, triangles] = BYTES.map_array(|bytes| *left_bytes / bytes);
    // The decoder refuses what would take more before it takes it.
    let limits = limits.with_max_points(points).with_max_faces(triangles);
    MeshDecoder::new()
        .decode(&mut DecoderBuffer::new(bytes).with_limits(limits), &mut mesh)
        .map_err(|error| match error.kind() {
            ErrorKind::LimitExceeded => format!(
                "what Draco compressed takes more than the {} MiB that are left of what a file of this length may have: export \
                 it with fewer triangles or copies",
                *left_bytes >> 20
            ),
            _ => format!("what Draco compressed cannot be decoded: {error:?}"),
        })?;
    let counts = [mesh.num_points(), mesh.num_faces()].map_array(|count| count as u64);
    let taken: u64 = counts.into_iter().zip(BYTES).map(|(count, bytes)| count * bytes).sum();
    *left_bytes = left_bytes.saturating_sub(taken);
    let numbers = value.get("attributes").and_then(Value::as_object).into_iter().flatten();
    let numbers = numbers
        .filter_map(|(name, number)| Some((name.clone(), u32::try_from(number.as_u64()?).ok()?)));
    Ok(Some(DecodedPrimitive { mesh, numbers: numbers.collect() }))
}

impl DecodedPrimitive {
    /// The vertices of all corners, three for each triangle.
    pub(super) fn indices(&self) -> Vec<u32> {
        let faces = (0..self.mesh.num_faces() as u32).map(|face| self.mesh.face(FaceIndex(face)));
        faces.flatten().map(|point| point.0).collect()
    }

    /// The values of an attribute in the order of the vertices; nothing of one that is not compressed.
    pub(super) fn vectors<const N: usize>(&self, name: &str) -> Option<Vec<[f64; N]>> {
        let (_, number) = self.numbers.iter().find(|(other, _)| *other == name)?;
        let attribute = self.mesh.attribute_by_unique_id(*number)?;
        let read = attribute.read_f32s(self.mesh.num_points(), N);
        Some(read.as_chunks::<N>().0.iter().map(|vector| vector.map(f64::from)).collect())
    }
}
