//! What the machine can do at most: bytes that a copy moves, and instructions that do not wait for each
//! other. `limits.py` compares frames with both.

use std::hint::black_box;
use std::time::Instant;

use rasterproof_render::scene::meshes;

use crate::Machine;
use crate::mesh::Mesh;
use crate::spread::Spread;

/// Far more than the caches hold.
const COPIED: usize = 1 << 28;
const ROUNDS: usize = 9;

/// Prints, by the first word: `machine`, what the results of other runs begin with; `mesh NAME`, the bytes of its vertices and
/// indices, as peers get them; `copy`, the bytes that a second reads and writes; `loop COUNT`, the seconds of so many rounds,
/// whose instructions valgrind counts.
pub fn print(machine: &Machine, words: &[String]) -> Result<(), String> {
    let [what, rest @ ..] = words else {
        return Err("--rates needs machine, mesh, copy or loop".to_owned());
    };
    match (what.as_str(), rest) {
        ("machine", []) => {
            println!("{}", serde_json::to_string(machine).map_err(|error| error.to_string())?);
        }
        ("mesh", [name]) => {
            let scene = meshes::scene(name).ok_or_else(|| format!("{name} is no mesh"))?;
            let mesh = Mesh::new(&scene);
            println!("{}", size_of_val(&mesh.vertices[..]) + size_of_val(&mesh.indices[..]));
        }
        ("copy", []) => {
            let (from, mut to) = (vec![1_u8; COPIED], vec![2_u8; COPIED]);
            let seconds = median(|| black_box(&mut to[..]).copy_from_slice(black_box(&from)));
            println!("{}", 2.0 * COPIED as f64 / seconds);
        }
        ("loop", [count]) => {
            let count = count.parse().map_err(|error| format!("{count}: {error}"))?;
            println!("{}", median(|| _ = black_box(rounds(count))));
        }
        _ => return Err(format!("{what}: --rates has machine, mesh NAME, copy and loop COUNT")),
    }
    Ok(())
}

fn median(mut run: impl FnMut()) -> f64 {
    let times = (0..ROUNDS).map(|_| {
        let start = Instant::now();
        run();
        start.elapsed().as_secs_f64()
    });
    Spread::of(&times.collect::<Vec<_>>()).median
}

/// Four scalars with four operations in a row and eight vectors with two: more than a core begins at a time, also where one of a
/// vector takes two cycles.
fn rounds(count: u64) -> u64 {
    let k = black_box([3_u64, 5, 7, 11]);
    let (mut a, mut b, mut c, mut d) = (1_u64, 2_u64, 3_u64, 4_u64);
    let mut vectors = [[1_u32; 4]; 8];
    for _ in 0..count {
        a = ((a ^ k[0]).wrapping_add(k[1]) ^ k[2]).wrapping_add(k[3]);
        b = (b.wrapping_sub(k[2]) ^ k[1]).wrapping_sub(k[0]) ^ k[3];
        c = ((c | k[2]).wrapping_add(k[3]) | k[0]).wrapping_add(k[1]);
        d = ((d ^ k[3]).wrapping_sub(k[0]) ^ k[1]).wrapping_sub(k[2]);
        for vector in &mut vectors {
            for x in vector {
                *x = (*x ^ 0x5555).wrapping_add(0x1234_5678);
            }
        }
    }
    let sum = vectors.as_flattened().iter().fold(0, |sum, &x| sum ^ u64::from(x));
    a ^ b ^ c ^ d ^ sum
}
