//! A study of a model as text and as JSON.

use std::fmt::Write as _;

use rasterproof_models::Origin;
use rasterproof_render::scene::Scene;
use rasterproof_study::hard::{HardCases, Kind};
use rasterproof_study::{face_of, triangle_of};
use serde_json::{Value, json};

/// A scene and where it comes from.
#[derive(Clone, Copy)]
pub struct Subject<'a> {
    pub scene: &'a Scene,
    pub origins: &'a [Origin],
    /// The command that shows a face, by its number from 1.
    pub inspect: &'a dyn Fn(u32) -> String,
}

impl Subject<'_> {
    /// Where a triangle is, in words.
    #[must_use]
    pub fn place(&self, triangle: u32) -> String {
        let place = triangle_of(self.scene, triangle)
            .and_then(|(item, number)| Some(self.origins.get(item)?.place(number)));
        place.unwrap_or_else(|| format!("triangle {}", u64::from(triangle) + 1))
    }

    /// The command that shows the face of a triangle.
    #[must_use]
    pub fn command(&self, triangle: u32) -> String {
        (self.inspect)(face_of(self.scene, self.origins, triangle))
    }
}

/// `1,234,567`.
#[must_use]
pub fn thousands(number: u64) -> String {
    let digits = number.to_string();
    let mut out = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            out.push(',');
        }
        out.push(digit);
    }
    out
}

/// The hard cases, each with the command that shows one.
#[must_use]
pub fn hard_cases(subject: &Subject<'_>, found: &HardCases) -> String {
    let mut out = String::new();
    if found.cases.is_empty() {
        out += "hard cases: none\n";
    } else {
        let _ = writeln!(out, "{:<32}{:>12}{:>14}", "hard cases", "count", "pixels");
    }
    for case in &found.cases {
        let (count, pixels) = (thousands(case.count), thousands(case.pixels));
        let _ = writeln!(out, "  {:<30}{count:>12}{pixels:>14}", case.kind.name());
        let _ = writeln!(out, "    {}", case.kind.about());
        let Some(&face) = case.triangles.first() else { continue };
        let note = if case.note.is_empty() { String::new() } else { format!("; {}", case.note) };
        let _ = writeln!(out, "    {}{note}", subject.place(face));
        let _ = writeln!(out, "    {}", subject.command(face));
    }
    let missing: Vec<&str> = Kind::ALL
        .into_iter()
        .filter(|kind| found.cases.iter().all(|case| case.kind != *kind))
        .map(Kind::name)
        .collect();
    if !missing.is_empty() && !found.cases.is_empty() {
        let _ = writeln!(out, "none: {}", missing.join(", "));
    }
    if found.is_cut_short {
        out +=
            "the model is so large that overlaps and T-junctions were looked for in a part of it\n";
    }
    if let Some([near, far]) = found.w {
        let _ = writeln!(out, "w in the window: {near:.3e} to {far:.3e}");
    }
    if found.f32_pixels > 0 {
        let pixels = thousands(found.f32_pixels);
        let _ = writeln!(out, "positions rounded to f32 change {pixels} px of the picture");
    }
    out
}

/// The same for machines.
#[must_use]
pub fn hard_cases_json(subject: &Subject<'_>, found: &HardCases) -> Value {
    let face = |&triangle: &u32| {
        let origin = triangle_of(subject.scene, triangle)
            .and_then(|(item, number)| Some((subject.origins.get(item)?, number)));
        json!({
            "face": face_of(subject.scene, subject.origins, triangle),
            "line": origin.and_then(|(origin, number)| origin.lines.get(number)),
            "part": origin.map(|(origin, _)| &origin.part),
            "material": origin.map(|(origin, _)| &origin.material),
            "command": subject.command(triangle),
        })
    };
    let cases = found.cases.iter().map(|case| {
        json!({
            "kind": case.kind.name(),
            "count": case.count,
            "pixels": case.pixels,
            "note": case.note,
            "faces": case.triangles.iter().map(face).collect::<Vec<_>>(),
        })
    });
    json!({
        "cases": cases.collect::<Vec<_>>(),
        "w": found.w,
        "f32_pixels": found.f32_pixels,
        "is_cut_short": found.is_cut_short,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thousands_have_commas() {
        let shown = [0, 999, 1000, 1_234_567].map(thousands);
        assert_eq!(shown, ["0", "999", "1,000", "1,234,567"]);
    }
}
