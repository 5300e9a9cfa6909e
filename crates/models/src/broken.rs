//! Vertices whose numbers are not finite. The faces that use them are left out, so that one of them does not end the file.

use glam::{DVec2, DVec3, DVec4};
use rasterproof_core::parallel;
use rasterproof_host::text::printable_short;

use crate::Warnings;
use crate::contents::{Contents, FilePart};

/// What is counted of faces that are left out.
const POSITION: &str = "position that is not finite of face";
/// And of those whose positions are good.
const COLOUR: &str = "colour that is not finite of face";

/// Removes the faces of all parts that cannot be drawn, counts them among what is not drawn, and returns how many they are.
pub(crate) fn leave_out(contents: &mut Contents, warnings: &mut Warnings) -> u64 {
    let all: u64 = contents.parts.iter().map(|part| part.polygons.len() as u64).sum();
    // How many faces of which kind, where the first one is, and how many faces the parts before had.
    let (mut counts, mut first, mut before) = ([0; 2], None, 0);
    let mut uvs = 0;
    for part in &mut contents.parts {
        let count = part.polygons.len();
        if let Some((number, of_part)) = faces(part) {
            let line = part.polygons.line(number) as usize;
            let name = printable_short(&part.name, 40);
            let part_of = if name.is_empty() { String::new() } else { format!(" of '{name}'") };
            let place = format!("face {} of the file{part_of}", before + number + 1);
            first.get_or_insert((line, place));
            counts = [counts[0] + of_part[0], counts[1] + of_part[1]];
            part.retain(|part, number| is_broken(part, number) == [false; 2]);
        }
        before += count;
        // Nothing uses the others. They are no part of the picture, and do not have to be told from those that are.
        let some = part.corners.first().map_or(DVec3::ZERO, |&at| part.positions[at as usize]);
        for position in part.positions.iter_mut().filter(|position| !position.is_finite()) {
            *position = some;
        }
        for colour in part.colours.values.iter_mut().filter(|colour| !colour.is_finite()) {
            *colour = DVec3::ONE;
        }
        for tangent in part.tangents.iter_mut().filter(|tangent| !tangent.is_finite()) {
            *tangent = DVec4::ZERO;
        }
        let all = part.uvs.values.iter_mut().chain(&mut part.second_uvs);
        for uv in all.filter(|uv| !uv.is_finite()) {
            *uv = DVec2::ZERO;
            uvs += 1;
        }
    }
    if uvs > 0 {
        let text = format!("{uvs} texture coordinates are not finite numbers; they are taken as 0");
        warnings.add("texture coordinates", &text);
    }
    let left_out = counts[0] + counts[1];
    contents.count(POSITION, counts[0]);
    contents.count(COLOUR, counts[1]);
    if let Some((line, place)) = first {
        let what = match counts {
            [_, 0] => "a position",
            [0, _] => "a colour",
            _ => "a position or a colour",
        };
        let are = match (left_out, all) {
            (1, 1) => "face is",
            (1, _) => "faces is",
            _ => "faces are",
        };
        let text = format!(
            "{left_out} of {all} {are} left out, since {what} of each is not a finite number; the first is {place}: \
             repair it in the program that wrote the file"
        );
        warnings.add_at(line, "faces", &text);
    }
    left_out
}

/// The first face that cannot be drawn, how many have such a position, and how many of the others such a colour.
fn faces(part: &FilePart) -> Option<(usize, [u64; 2])> {
    // Nearly all files have none, which all threads look for.
    let is_broken = |vector: &DVec3| !vector.is_finite();
    parallel::first(&part.positions, is_broken)
        .or_else(|| parallel::first(&part.colours.values, is_broken))?;
    let (mut first, mut counts) = (None, [0; 2]);
    for number in 0..part.polygons.len() {
        let [position, colour] = self::is_broken(part, number);
        if position || colour {
            first.get_or_insert(number);
            counts[usize::from(!position)] += 1;
        }
    }
    first.map(|first| (first, counts))
}

/// Whether a face has a position (0) or a colour (1) that is not finite.
fn is_broken(part: &FilePart, number: usize) -> [bool; 2] {
    let mut is_broken = [false; 2];
    for corner in part.polygons.corners(number) {
        let position = part.corners[corner];
        let colour = part.colours.numbers.get(corner, position);
        let colour = colour.map(|number| part.colours.values[number as usize]);
        is_broken[0] |= !part.positions[position as usize].is_finite();
        is_broken[1] |= colour.is_some_and(|colour| !colour.is_finite());
    }
    is_broken
}
