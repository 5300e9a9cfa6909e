//! `rasterproof-adapters NAME`: speaks the line protocol for a Rust library.

mod ab_glyph_rasterizer;
mod embedded_graphics;
mod euc;
mod imageproc;
mod protocol;
mod raqote;
mod retrofire;
mod tiny_skia;
mod vello_cpu;
mod zeno;

fn main() -> std::io::Result<()> {
    let libraries = [
        &tiny_skia::LIBRARY,
        &raqote::LIBRARY,
        &euc::LIBRARY,
        &embedded_graphics::LIBRARY,
        &vello_cpu::LIBRARY,
        &zeno::LIBRARY,
        &ab_glyph_rasterizer::LIBRARY,
        &retrofire::LIBRARY,
        &imageproc::LIBRARY,
    ];
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
