//! Vertices whose numbers are not finite. The faces that use them are left out, so that one of them does not end the file.

use std::path::Path;

use glam::{DVec2, DVec3, DVec4};
use rasterproof_core::parallel;
use rasterproof_host::text::printable_short;

use crate::Warnings;
use crate::contents::{Contents, FilePart, retain};

/// What is counted of faces that are left out.
const POSITION: &str = "position that is not finite of face";
const COLOUR: &str = "colour that is not finite of face";

/// Removes the faces of all parts that cannot be drawn, counts them among what is not drawn, and returns how many they are.
pub(crate) fn leave_out(path: &Path, contents: &mut Contents, warnings: &mut Warnings) -> u64 {
    let all: u64 = contents.parts.iter().map(|part| part.polygons.len() as u64).sum();
    let (mut counts, mut first, mut before) = ([0; 2], None, 0);
    let mut uvs = 0;
    for part in &mut contents.parts {
        let count = part.polygons.len();
        if let Some((number, of_part)) = faces(part) {
            let line = part.polygons.line(number) as usize;
            let name = printable_short(&part.name, 40);
            let part_of = if name.is_empty() { String::new() } else { format!(" of '{name}'") };
            let place = format!("face {} of the file{part_of}", before + number + 1);
            first.get_or_insert((Some(line).filter(|&line| line > 0), place));
            counts = [counts[0] + of_part[0], counts[1] + of_part[1]];
            remove(part);
        }
        before += count;
        // Nothing uses the others. They are no part of the picture, and do not have to be told from those that are.
        let some = part.corners.first().map_or(DVec3::ZERO, |&at| part.positions[at as usize]);
        for position in part.positions.iter_mut().filter(|position| !position.is_finite()) {
            *position = some;
        }
        for colour in part.colours.iter_mut().filter(|colour| !colour.is_finite()) {
            *colour = DVec3::ONE;
        }
        for tangent in part.tangents.iter_mut().filter(|tangent| !tangent.is_finite()) {
            *tangent = DVec4::ZERO;
        }
        let all = part.uvs.iter_mut().chain(&mut part.second_uvs);
        for uv in all.filter(|uv| !uv.is_finite()) {
            *uv = DVec2::ZERO;
            uvs += 1;
        }
    }
    if uvs > 0 {
        let text = format!("{uvs} texture coordinates are not finite numbers; they are taken as 0");
        warnings.add(path, None, "texture coordinates", &text);
    }
    let left_out = counts[0] + counts[1];
    for (key, count) in [POSITION, COLOUR].into_iter().zip(counts).filter(|(_, count)| *count > 0) {
        contents.not_drawn.insert(key.to_owned(), count);
    }
    if let Some((line, place)) = first {
        let what = match counts {
            [_, 0] => "a position",
            [0, _] => "a colour",
            _ => "a position or a colour",
        };
        let text = format!(
            "{left_out} of {all} faces are left out, since {what} of each is not a finite number; the first is {place}: \
             repair it in the program that wrote the file"
        );
        warnings.add(path, line, "faces", &text);
    }
    left_out
}

/// The first face that cannot be drawn, how many have such a position, and how many of the others such a colour.
fn faces(part: &FilePart) -> Option<(usize, [u64; 2])> {
    let is_broken = |vector: &DVec3| !vector.is_finite();
    parallel::first(&part.positions, is_broken)
        .or_else(|| parallel::first(&part.colours, is_broken))
        .or_else(|| parallel::first(&part.face_colours, is_broken))?;
    let (mut first, mut counts) = (None, [0; 2]);
    for number in 0..part.polygons.len() {
        let corners = part.polygons.corners(number);
        let has = |vectors: &[DVec3]| {
            let mut vectors =
                corners.clone().filter_map(|at| vectors.get(part.corners[at] as usize));
            vectors.any(is_broken)
        };
        let kind = if has(&part.positions) { 0 } else { 1 };
        let has_colour = has(&part.colours) || part.face_colours.get(number).is_some_and(is_broken);
        if kind == 0 || has_colour {
            first.get_or_insert(number);
            counts[kind] += 1;
        }
    }
    first.map(|first| (first, counts))
}

/// Removes the faces that [`faces`] counts.
fn remove(part: &mut FilePart) {
    let FilePart { positions, colours, corners, normal_numbers, uv_numbers, polygons, .. } = part;
    let face_colours = &part.face_colours;
    let is_broken = |&corner: &u32| {
        let vectors = [positions.get(corner as usize), colours.get(corner as usize)];
        vectors.into_iter().flatten().any(|vector| !vector.is_finite())
    };
    let is_kept = |number: usize, corners: &[u32]| {
        let has_colour = face_colours.get(number).is_none_or(|colour| colour.is_finite());
        has_colour && !corners.iter().any(is_broken)
    };
    let kept = (0..polygons.len()).filter(|&at| is_kept(at, &corners[polygons.corners(at)]));
    let colours = kept.filter_map(|at| face_colours.get(at).copied()).collect();
    retain(polygons, corners, [normal_numbers, uv_numbers], is_kept);
    part.face_colours = colours;
}
