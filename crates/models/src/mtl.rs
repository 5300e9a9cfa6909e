//! Material files (MTL): the colour and the texture of each material.
//!
//! `tobj` reads them too, but panics at a `Kd` of two numbers, drops a whole file for one bad line and
//! names neither. Only three kinds of lines are needed, so they are read here.

use std::path::Path;

use rasterproof_host::text::{printable_path, printable_short};

/// A material as a file describes it.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Described {
    /// Its name, for `usemtl`.
    pub name: String,
    /// Its diffuse colour (`Kd`).
    pub colour: Option<[f32; 3]>,
    /// What follows `map_Kd`: options and the name of a file.
    pub texture: Option<String>,
}

#[derive(Debug, Default)]
pub(crate) struct Read {
    /// Its materials, in its order.
    pub materials: Vec<Described>,
    /// The lines that cannot be understood, and were left out.
    pub warnings: Vec<String>,
}

/// Lines that are understood and not drawn; an empty line is one.
const UNUSED: [&str; 27] = [
    "",
    "Ka",
    "Ks",
    "Ke",
    "Km",
    "Kt",
    "Ns",
    "Ni",
    "Nr",
    "Tr",
    "Tf",
    "d",
    "illum",
    "sharpness",
    "refl",
    "bump",
    "disp",
    "decal",
    "norm",
    "Pr",
    "Pm",
    "Ps",
    "Pc",
    "Pcr",
    "aniso",
    "anisor",
    "halo",
];

/// Warnings of one file that are kept; of the rest the number is.
const MOST_WARNINGS: usize = 8;

/// Reads the text of a material file. A line that cannot be understood is a warning.
pub(crate) fn read(path: &Path, text: &str) -> Read {
    let mut read = Read::default();
    let mut left_out = 0;
    for (index, line) in text.lines().enumerate() {
        let line = line.split('#').next().unwrap_or_default().trim();
        let (kind, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        if let Err(cause) = read_line(kind, rest.trim(), &mut read.materials) {
            if read.warnings.len() < MOST_WARNINGS {
                let path = printable_path(path);
                read.warnings.push(format!("{path}:{}: {cause}; the line is left out", index + 1));
            } else {
                left_out += 1;
            }
        }
    }
    if left_out > 0 {
        let path = printable_path(path);
        read.warnings.push(format!("{path}: {left_out} more lines are left out"));
    }
    read
}

fn read_line(kind: &str, rest: &str, materials: &mut Vec<Described>) -> Result<(), String> {
    if kind == "newmtl" {
        materials.push(Described { name: rest.to_owned(), ..Described::default() });
        return Ok(());
    }
    if kind != "Kd" && kind != "map_Kd" {
        // What the format has, and what exporters add to it for physically based shading.
        let is_known = kind.to_ascii_lowercase().starts_with("map_") || UNUSED.contains(&kind);
        let shown = || format!("'{}' is not a line of a material file", printable_short(kind, 40));
        return if is_known { Ok(()) } else { Err(shown()) };
    }
    let material = materials.last_mut().ok_or_else(|| format!("'{kind}' before any 'newmtl'"))?;
    if kind == "Kd" {
        material.colour = Some(colour(rest)?);
    } else {
        material.texture = (!rest.is_empty()).then(|| rest.to_owned());
    }
    Ok(())
}

/// Three numbers, or one that is all three.
fn colour(rest: &str) -> Result<[f32; 3], String> {
    let mut numbers = Vec::new();
    for word in rest.split_whitespace().take(3) {
        match word.parse::<f32>() {
            Ok(number) if number.is_finite() => numbers.push(number),
            _ => return Err(format!("'{}' is not a finite number", printable_short(word, 40))),
        }
    }
    match numbers[..] {
        [grey] => Ok([grey; 3]),
        [r, g, b] => Ok([r, g, b]),
        _ => Err(format!("'Kd' has {} numbers where 3 are needed", numbers.len())),
    }
}
