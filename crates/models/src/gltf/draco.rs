//! Triangles that are compressed by Draco.

use draco_core::{DecoderBuffer, FaceIndex, Mesh, MeshDecoder};
use serde_json::Value;

use super::data::Data;
use super::document::Primitive;

/// The extension of a primitive that is compressed.
pub(super) const EXTENSION: &str = "KHR_draco_mesh_compression";

/// The vertices and triangles of a primitive.
pub(super) struct Decoded {
    mesh: Mesh,
    /// The number of each attribute within the compressed bytes.
    numbers: Vec<(String, u32)>,
}

/// Decodes a primitive; nothing of one that is not compressed.
pub(super) fn decode(data: &Data<'_>, primitive: &Primitive) -> Result<Option<Decoded>, String> {
    let Some(value) = &primitive.extensions.draco else { return Ok(None) };
    let view = value.get("bufferView").and_then(Value::as_u64);
    let view = view.and_then(|view| usize::try_from(view).ok());
    let (bytes, _) = data.view(view.ok_or(format!("{EXTENSION} names no bufferView"))?)?;
    let mut mesh = Mesh::new();
    MeshDecoder::new()
        .decode(&mut DecoderBuffer::new(bytes), &mut mesh)
        .map_err(|error| format!("what Draco compressed cannot be decoded: {error:?}"))?;
    let numbers = value.get("attributes").and_then(Value::as_object).into_iter().flatten();
    let numbers = numbers
        .filter_map(|(name, number)| Some((name.clone(), u32::try_from(number.as_u64()?).ok()?)));
    Ok(Some(Decoded { mesh, numbers: numbers.collect() }))
}

impl Decoded {
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
