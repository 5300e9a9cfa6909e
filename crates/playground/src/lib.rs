//! Two pages: the playground, and the one that judges a browser's GPU. Each is one file with its style, its
//! scripts and the compiled module inside.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use rasterproof_verify::specification::{OPENGL_ES, Source, WEBGPU};
use serde_json::{Map, Value, json};

pub struct Parts {
    title: &'static str,
    body: &'static str,
    styles: &'static [&'static str],
    scripts: &'static [&'static str],
}

pub const PLAYGROUND: Parts = Parts {
    title: "rasterproof: playground",
    body: include_str!("../page/page.html"),
    styles: &[include_str!("../page/page.css")],
    scripts: &[
        rasterproof_view::PIXEL,
        include_str!("../page/words.js"),
        include_str!("../page/engines.js"),
        include_str!("../page/state.js"),
        include_str!("../page/parts.js"),
        include_str!("../page/edges.js"),
        include_str!("../page/look.js"),
        include_str!("../page/grips.js"),
        include_str!("../page/scenes.js"),
        include_str!("../page/frames.js"),
        include_str!("../page/panels.js"),
        include_str!("../page/tools.js"),
        include_str!("../page/hunt.js"),
        include_str!("../page/address.js"),
        include_str!("../page/start.js"),
    ],
};

/// The page that judges a browser's GPU.
pub const YOUR_GPU: Parts = Parts {
    title: "rasterproof: your GPU",
    body: include_str!("../page/gpu/page.html"),
    styles: &[include_str!("../page/page.css"), include_str!("../page/gpu/gpu.css")],
    scripts: &[
        rasterproof_view::PIXEL,
        include_str!("../page/gpu/words.js"),
        include_str!("../page/gpu/rules.js"),
        include_str!("../page/engines.js"),
        include_str!("../page/gpu/pixels.js"),
        include_str!("../page/gpu/webgl2.js"),
        include_str!("../page/gpu/webgpu.js"),
        include_str!("../page/gpu/run.js"),
        include_str!("../page/edges.js"),
        include_str!("../page/gpu/show.js"),
    ],
};

/// The script of the live figures, which pages load that are not made here. No style of theirs reaches into a figure.
#[must_use]
pub fn figure_script() -> String {
    let own = [
        include_str!("../page/engines.js"),
        include_str!("../page/grips.js"),
        include_str!("../page/figure.js"),
    ];
    let style = (rasterproof_view::TOKENS.to_owned() + rasterproof_view::VIEW_STYLE)
        .replace(":root", ":host");
    format!(
        "(() => {{\nconst VIEW_STYLE = {};\n{}}})();\n",
        json!(style),
        rasterproof_view::script(&own)
    )
}

/// What a page may weigh, so that it can be sent and opened anywhere.
pub const MOST_BYTES: usize = 3_000_000;

/// The page around a compiled module, the bytes of a `.wasm` file.
///
/// # Errors
/// A message where these bytes are no module, or the page would weigh more than [`MOST_BYTES`].
pub fn page(parts: &Parts, module: &[u8]) -> Result<String, String> {
    if !module.starts_with(b"\0asm") {
        return Err("is no WebAssembly module: it does not begin with \\0asm".to_owned());
    }
    let filled = [
        ("{{policy}}", " 'wasm-unsafe-eval'"),
        ("{{about}}", ""),
        ("{{title}}", parts.title),
        ("{{body}}", parts.body),
        ("{{style}}", &*rasterproof_view::style(parts.styles)),
        ("{{script}}", &*rasterproof_view::script(parts.scripts)),
        ("{{words}}", include_str!("../page/words.json")),
        ("{{clauses}}", &*clauses()),
        ("{{module}}", &*STANDARD.encode(module)),
    ];
    let page =
        filled.into_iter().fold(rasterproof_view::FRAME.to_owned(), |page, (place, text)| {
            page.replacen(place, text, 1)
        });
    if page.len() > MOST_BYTES {
        return Err(format!(
            "makes a page of {} bytes; at most {MOST_BYTES} are allowed",
            page.len()
        ));
    }
    Ok(page)
}

/// What each interface promises, by the checks of the page.
fn clauses() -> String {
    let of = |source: Source| -> Map<String, Value> {
        let rules = source.clauses().map(|clause| {
            let [_, says, open] = clause.chinese;
            let section = [source.title, clause.section].join(", ");
            let rule = json!({
                "section": section.trim_end_matches(", "),
                "says": [clause.says, says], "open": [clause.open, open],
                "quote": Some(clause.quote).filter(|[words, _]| !words.is_empty()),
            });
            (clause.key.to_owned(), rule)
        });
        rules.collect()
    };
    json!({ "webgl2": of(OPENGL_ES), "webgpu": of(WEBGPU) }).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_holds_its_module() {
        for parts in [&PLAYGROUND, &YOUR_GPU] {
            let page = page(parts, b"\0asm\x01\0\0\0").unwrap();
            assert!(page.contains("AGFzbQEAAAA=") && !page.contains("{{"), "every place is filled");
            // The one address names the language of a drawing; nothing is fetched from it.
            let page = page.replace("http://www.w3.org/2000/svg", "");
            assert!(!page.contains("http://") && !page.contains("https://"), "loads nothing");
        }
    }

    #[test]
    fn what_is_no_module_is_refused() {
        assert!(page(&YOUR_GPU, b"ELF").unwrap_err().contains("no WebAssembly module"));
        let mut large = vec![0; MOST_BYTES];
        large[..4].copy_from_slice(b"\0asm");
        assert!(page(&PLAYGROUND, &large).unwrap_err().contains("at most"));
    }
}
