//! The viewer `<rp-view>` and the style of every page, as text to put into pages.
//!
//! The files in `page` are modules of the browser. A page that is opened from disk may load none, so a page has
//! them one behind the other in one script: [`script`] leaves out the lines that name other modules. No two of
//! them define the same name.

/// The colours, sizes and spaces that every page and the site share.
pub const TOKENS: &str = include_str!("../page/tokens.css");
/// How the viewer looks, also inside of an element that sees no style of the page around it.
pub const VIEW_STYLE: &str = include_str!("../page/view.css");
/// The look of everything on a page of the program that is not the viewer.
pub const PAGE_STYLE: &str = include_str!("../page/style.css");

/// What is around every page: its head, with places for all that differs.
pub const FRAME: &str = include_str!("../page/frame.html");

/// The modules of the viewer, each behind those that it uses.
pub const MODULES: [&str; 3] = [
    include_str!("../page/dom.js"),
    include_str!("../page/paint.js"),
    include_str!("../page/view.js"),
];

/// The style of a page, with its own behind that of all.
#[must_use]
pub fn style(own: &[&str]) -> String {
    [TOKENS, PAGE_STYLE, VIEW_STYLE].into_iter().chain(own.iter().copied()).collect()
}

/// Whether a line is nothing but a comment. Shaders are made of lines with places, and keep theirs.
fn is_comment(line: &str) -> bool {
    let line = line.trim();
    (line.starts_with("// ") && !line.contains("${"))
        || (line.starts_with("/** ") && line.ends_with("*/"))
}

/// What is said of a pixel, for pages that say it: after the viewer, before their own modules.
pub const PIXEL: &str = include_str!("../page/pixel.js");

/// The viewer and the modules of a page as one script, without their comments.
#[must_use]
pub fn script(own: &[&str]) -> String {
    let mut script = String::new();
    for line in MODULES.iter().chain(own).flat_map(|module| module.lines()) {
        if !line.starts_with("import ") && !is_comment(line) {
            script += line.strip_prefix("export ").unwrap_or(line);
            script.push('\n');
        }
    }
    script
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A colour of the style sheet on a light and on a dark page, as linear red, green and blue.
    fn token(name: &str) -> [[f64; 3]; 2] {
        let (_, value) = TOKENS.split_once(&format!("--px-{name}: light-dark(")).unwrap();
        let (value, _) = value.split_once(')').unwrap();
        let (light, dark) = value.split_once(", ").unwrap();
        [light, dark].map(|hex| {
            [1, 3, 5].map(|at| {
                let byte = f64::from(u8::from_str_radix(&hex[at..at + 2], 16).unwrap()) / 255.0;
                if byte <= 0.040_45 { byte / 12.92 } else { libm::pow((byte + 0.055) / 1.055, 2.4) }
            })
        })
    }

    /// What eyes of three kinds, and all others, see of a colour: Machado, Oliveira and Fernandes, 2009, all of the defect.
    const EYES: [(&str, [[f64; 3]; 3]); 4] = [
        ("all colours", [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
        (
            "no red",
            [
                [0.152_286, 1.052_583, -0.204_868],
                [0.114_503, 0.786_281, 0.099_216],
                [-0.003_882, -0.048_116, 1.051_998],
            ],
        ),
        (
            "no green",
            [
                [0.367_322, 0.860_646, -0.227_968],
                [0.280_085, 0.672_501, 0.047_413],
                [-0.011_820, 0.042_940, 0.968_881],
            ],
        ),
        (
            "no blue",
            [
                [1.255_528, -0.076_749, -0.178_779],
                [-0.078_411, 0.930_809, 0.147_602],
                [0.004_733, 0.691_367, 0.303_900],
            ],
        ),
    ];

    /// A colour in the space of CIE L*a*b*, whose distances are those that eyes see.
    fn lab(eye: &[[f64; 3]; 3], colour: [f64; 3]) -> [f64; 3] {
        let product = |rows: &[[f64; 3]; 3], c: [f64; 3]| {
            rows.map(|row| row.iter().zip(c).map(|(a, b)| a * b).sum::<f64>())
        };
        let to_xyz = [[0.4339, 0.3762, 0.1899], [0.2126, 0.7152, 0.0722], [0.0177, 0.1095, 0.8730]];
        let seen = product(eye, colour).map(|part| part.clamp(0.0, 1.0));
        let [x, y, z] = product(&to_xyz, seen)
            .map(|t| if t > 0.008_856 { libm::cbrt(t) } else { 7.787 * t + 16.0 / 116.0 });
        [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
    }

    /// Eyes see a difference from a distance of about 2 where two colours lie side by side; 20 is a plain one.
    #[test]
    fn marks_are_told_apart_by_all_eyes() {
        let names = ["empty", "agrees", "missing", "extra", "twice", "overlap"];
        for (who, eye) in &EYES {
            for (page, ground) in ["light", "dark"].into_iter().enumerate() {
                for (i, a) in names.iter().enumerate() {
                    for b in &names[..i] {
                        let [p, q] = [a, b].map(|name| lab(eye, token(name)[page]));
                        let far = p.iter().zip(q).map(|(p, q)| (p - q).powi(2)).sum::<f64>().sqrt();
                        assert!(far > 20.0, "{a} and {b}, {ground}, {who}: {far:.0}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_script_has_no_modules() {
        let own = "import { x } from './x.js';\n  // Why.\n/** What. */\nexport const y = 1;\n";
        let script = script(&[own]);
        assert!(
            script.ends_with("}\n\ncustomElements.define('rp-view', View);\nconst y = 1;\n")
                && !script.contains("\nimport ")
        );
        assert!(!script.contains("\nexport "), "{script}");
    }
}
