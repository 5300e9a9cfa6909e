//! `rasterproof-adapters NAME`: speaks the line protocol for one of four Rust libraries.

mod embedded_graphics;
mod euc;
mod protocol;
mod raqote;
mod tiny_skia;

fn main() -> std::io::Result<()> {
    let libraries =
        [&tiny_skia::LIBRARY, &raqote::LIBRARY, &euc::LIBRARY, &embedded_graphics::LIBRARY];
    let asked = std::env::args().nth(1).unwrap_or_default();
    // The name without its version: "tiny-skia" of "tiny-skia-0.12.0".
    let bare = |name: &'static str| name.rsplit_once('-').map_or(name, |(bare, _)| bare);
    match libraries.iter().find(|library| bare(library.name) == asked) {
        Some(library) => protocol::serve(library),
        None => {
            let names: Vec<_> = libraries.iter().map(|library| bare(library.name)).collect();
            eprintln!("which library? one of: {}", names.join(" "));
            std::process::exit(2);
        }
    }
}
