//! Loads a model and prints how long it took: `cargo run --release -p rasterproof-models --example load FILE`.

use std::path::Path;
use std::time::Instant;

use rasterproof_models::{LoadOptions, load};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    for path in std::env::args().skip(1) {
        let start = Instant::now();
        let model = load(Path::new(&path), LoadOptions::default())?;
        let seconds = start.elapsed().as_secs_f64();
        let triangles: usize = model.items.iter().map(|item| item.mesh.triangles.len()).sum();
        println!("{path}: {triangles} triangles in {seconds:.3} s");
    }
    Ok(())
}
