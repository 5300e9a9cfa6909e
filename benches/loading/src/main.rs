//! Loads a model with a reader of crates.io, and prints the triangles and the seconds: `READER FILE`.

use std::error::Error;
use std::fs::File;
use std::hint::black_box;
use std::io::BufReader;
use std::time::Instant;

use ply_rs_bw::parser::{Parser, Reader};
use ply_rs_bw::ply::{Property, PropertyAccess, PropertyAccessResult};

type Triangles = Result<usize, Box<dyn Error>>;

/// A reader by its name: it keeps what it read until it has counted the triangles.
const READERS: [(&str, fn(&str) -> Triangles); 10] = [
    ("tobj", |path| {
        let (models, _) = tobj::load_obj(path, &tobj::LoadOptions::default())?;
        Ok(black_box(models).iter().map(|model| model.mesh.indices.len() / 3).sum())
    }),
    ("tobj-single-index", |path| {
        let (models, _) = tobj::load_obj(path, &tobj::GPU_LOAD_OPTIONS)?;
        Ok(black_box(models).iter().map(|model| model.mesh.indices.len() / 3).sum())
    }),
    ("obj", |path| {
        let data = black_box(wavefront::ObjData::load_buf(open(path)?)?);
        let groups = data.objects.iter().flat_map(|object| &object.groups);
        Ok(groups.map(|group| group.polys.len()).sum())
    }),
    ("obj-rs", |path| Ok(black_box(obj::raw::parse_obj(open(path)?)?).polygons.len())),
    ("mesh-loader", |path| {
        let scene = black_box(mesh_loader::Loader::default().load(path)?);
        Ok(scene.meshes.iter().map(|mesh| mesh.faces.len()).sum())
    }),
    ("stl_io", |path| Ok(black_box(stl_io::read_stl(&mut open(path)?)?).faces.len())),
    ("stl_io-unmerged", |path| {
        let triangles: Result<Vec<_>, _> = stl_io::create_stl_reader(&mut open(path)?)?.collect();
        Ok(black_box(triangles?).len())
    }),
    ("nom_stl", |path| Ok(black_box(nom_stl::parse_stl(&mut open(path)?)?).triangles().len())),
    ("gltf", gltf_file),
    ("ply-rs-bw", ply),
];

fn open(path: &str) -> Result<BufReader<File>, Box<dyn Error>> {
    Ok(BufReader::with_capacity(1 << 20, File::open(path)?))
}

/// The vectors and indices of all primitives. `import` alone reads bytes.
fn gltf_file(path: &str) -> Triangles {
    let (document, buffers, _) = gltf::import(path)?;
    let mut triangles = 0;
    for primitive in document.meshes().flat_map(|mesh| mesh.primitives()) {
        let reader = primitive.reader(|buffer| Some(&buffers[buffer.index()]));
        let positions: Option<Vec<[f32; 3]>> = reader.read_positions().map(Iterator::collect);
        let normals: Option<Vec<[f32; 3]>> = reader.read_normals().map(Iterator::collect);
        let uvs: Option<Vec<[f32; 2]>> =
            reader.read_tex_coords(0).map(|uvs| uvs.into_f32().collect());
        let indices: Option<Vec<u32>> = reader.read_indices().map(|all| all.into_u32().collect());
        black_box((positions, normals, uvs));
        triangles += black_box(indices).map_or(0, |indices| indices.len() / 3);
    }
    Ok(triangles)
}

#[derive(Default)]
struct Vertex {
    position: [f32; 3],
}

#[derive(Default)]
struct Face {
    indices: Vec<i32>,
}

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, key: &str, property: Property) -> PropertyAccessResult {
        let place = ["x", "y", "z"].iter().position(|name| *name == key);
        if let (Some(place), Property::Float(value)) = (place, property) {
            self.position[place] = value;
        }
        PropertyAccessResult::Set
    }
}

impl PropertyAccess for Face {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, _: &str, property: Property) -> PropertyAccessResult {
        if let Property::ListInt(indices) = property {
            self.indices = indices;
        }
        PropertyAccessResult::Set
    }
}

fn ply(path: &str) -> Triangles {
    let mut reader = Reader::new(open(path)?);
    let (of_vertices, of_faces) = (Parser::<Vertex>::new(), Parser::<Face>::new());
    let header = of_vertices.read_header(&mut reader)?;
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    for (name, element) in &header.elements {
        match name.as_str() {
            "vertex" => {
                vertices = of_vertices.read_payload_for_element(&mut reader, element, &header)?;
            }
            _ => faces = of_faces.read_payload_for_element(&mut reader, element, &header)?,
        }
    }
    let positions = vertices.iter().map(|vertex| vertex.position.len()).sum::<usize>();
    black_box(positions);
    Ok(black_box(faces).iter().filter(|face| face.indices.len() == 3).count())
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().collect();
    let [_, name, path] = &arguments[..] else { return Err("two arguments: READER FILE".into()) };
    let reader = READERS.iter().find(|(of, _)| of == name).ok_or("no such reader")?;
    let start = Instant::now();
    let triangles = reader.1(path)?;
    println!("{triangles} {:.4}", start.elapsed().as_secs_f64());
    Ok(())
}
