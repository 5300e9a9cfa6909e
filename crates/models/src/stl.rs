//! STL: triangles in text, or in records of 50 bytes after a header of 84.
//!
//! Own code, since the format has one kind of record, and errors name its line or byte. Its normals are not read: they are
//! those of the triangles, or wrong.

use std::hash::BuildHasher as _;
use std::iter::Peekable;
use std::path::Path;

use foldhash::fast::RandomState;
use glam::DVec3;
use hashbrown::HashTable;
use hashbrown::hash_table::Entry;
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::parallel::{self, SHARE};
use rasterproof_host::text::printable_short;
use rayon::prelude::*;

use crate::Wrong;
use crate::contents::{Contents, Coordinate, FilePart, Polygons};
use crate::records::{self, Records, is_wide, without_mark};

/// The bytes before the triangles, the last four of which count them.
const HEADER: usize = 84;
/// A triangle has a normal, three corners and an attribute: 12 numbers of 4 bytes, and 2 bytes.
const RECORD: usize = 50;
/// The triangles that the header of a binary file counts.
fn counted(bytes: &[u8]) -> Option<u64> {
    Some(u32::from_le_bytes(bytes.get(80..HEADER)?.try_into().ok()?).into())
}

/// Whether the length is that of the records which the header counts. A text that begins with `solid` has another one.
pub(crate) fn is_binary(bytes: &[u8], length: u64) -> bool {
    counted(bytes).is_some_and(|count| count * RECORD as u64 + HEADER as u64 == length)
}

/// Whether it begins as the text of an STL. A binary one may do so too, but has zeros in its first record.
pub(crate) fn is_text(bytes: &[u8]) -> bool {
    let begin = without_mark(&bytes[..bytes.len().min(HEADER + RECORD)]);
    let begin = begin.trim_ascii_start();
    let word = begin.split(u8::is_ascii_whitespace).next().unwrap_or_default();
    // Some programs write no `solid`.
    let is_known =
        ["solid", "facet"].iter().any(|known| word.eq_ignore_ascii_case(known.as_bytes()));
    is_known && !begin.contains(&0)
}

/// Whether it begins as an STL in records, whatever its length is: with zeros, which no text has, and a first triangle of usual numbers or
/// the ending of its name.
pub(crate) fn begins_binary(path: &Path, bytes: &[u8]) -> bool {
    let begin = &bytes[..bytes.len().min(HEADER + RECORD)];
    if is_wide(begin) || !begin.contains(&0) {
        return false;
    }
    // Coordinates of real models are neither tiny nor huge.
    let is_usual = |word: &[u8; 4]| {
        let size = f32::from_le_bytes(*word).abs();
        size == 0.0 || (1e-20..1e20).contains(&size)
    };
    let record = begin.get(HEADER..HEADER + RECORD - 2);
    record.is_some_and(|record| record.as_chunks::<4>().0.iter().all(is_usual))
        || path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("stl"))
}

/// Corners of triangles in the order of the file, and the positions that they name. Those of records stay `f32`, which take half
/// the memory until equal ones are found.
#[derive(Default)]
struct Corners<C> {
    /// Most are different; [`merged`] makes one of those that are equal.
    positions: Vec<[C; 3]>,
    /// The number of each corner's position.
    numbers: Vec<u32>,
    /// The numbers of positions that were added not long ago, in places that follow from their coordinates.
    recent: Vec<u32>,
}

/// How many positions are remembered: they fit into the cache of a processor, and a neighbour of a triangle often is not far
/// before it in the file.
const RECENT: usize = 1 << 14;

impl<C: Coordinate> Corners<C> {
    /// No corners yet, with the capacity for so many triangles.
    fn with_capacity(triangles: usize) -> Self {
        // A closed surface has half as many positions as triangles.
        let positions = Vec::with_capacity(triangles / 2);
        Self { positions, numbers: Vec::with_capacity(3 * triangles), recent: vec![0; RECENT] }
    }

    /// Adds a corner, at a position that was added not long ago where there is an equal one.
    #[inline]
    fn push(&mut self, point: [C; 3]) {
        let [x, y, z]: [u64; 3] = point.map_array(|number| number.bits().into());
        let mixed = (x ^ y.rotate_left(21) ^ z.rotate_left(42)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let recent = &mut self.recent[(mixed >> 50) as usize % RECENT];
        if self.positions.get(*recent as usize) != Some(&point) {
            *recent = self.positions.len() as u32;
            self.positions.push(point);
        }
        self.numbers.push(*recent);
    }
}

/// The bits of a position, and its number.
type Keyed<C> = ([<C as Coordinate>::Bits; 3], u32);

/// The positions of all shares of a file, each once, in the order in which they come first; and their numbers at all corners.
fn merged<C: Coordinate>(shares: &[Corners<C>]) -> (Vec<DVec3>, Vec<u32>) {
    // Where the positions of each share begin among those of all.
    let (mut starts, mut count) = (Vec::new(), 0);
    for share in shares {
        starts.push(count);
        count += share.positions.len();
    }
    // Equal positions have the same hash, so they are looked for in one of many small tables, which fits into a cache. The
    // seed of the hash is random, so that no file can be written whose positions all are in the same one.
    let hasher = RandomState::default();
    // Each table has about as many positions as a thread reads.
    let tables = count.div_ceil(SHARE).max(1);
    let hash = |[x, y, z]: [C::Bits; 3]| hasher.hash_one((x, y, z));
    let sorted: Vec<Vec<Vec<Keyed<C>>>> = parallel::map(shares.len(), |share| {
        let (start, share) = (starts[share], &shares[share]);
        let usual = share.positions.len() / tables;
        let mut of_tables = Vec::new();
        of_tables.resize_with(tables, || Vec::with_capacity(usual + usual / 16));
        for (number, &point) in (start as u32..).zip(&share.positions) {
            let keys = point.map_array(C::bits);
            of_tables[(hash(keys) >> 32) as usize % tables].push((keys, number));
        }
        of_tables
    });
    let found: Vec<Vec<(u32, u32)>> = parallel::map(tables, |table| {
        let count = sorted.iter().map(|of_tables| of_tables[table].len()).sum();
        let mut known = HashTable::with_capacity(count);
        let mut again = Vec::new();
        for &(keys, number) in sorted.iter().flat_map(|of_tables| &of_tables[table]) {
            let is_same = |other: &Keyed<C>| other.0 == keys;
            match known.entry(hash(keys), is_same, |other| hash(other.0)) {
                Entry::Occupied(first) => again.push((number, first.get().1)),
                Entry::Vacant(place) => drop(place.insert((keys, number))),
            }
        }
        again
    });
    // For each position the number of the first one that is equal, and then its number among those that are kept.
    let mut numbers: Vec<u32> = (0..count as u32).collect();
    for (number, first) in found.into_iter().flatten() {
        numbers[number as usize] = first;
    }
    let mut positions = Vec::with_capacity(count);
    for (number, &point) in shares.iter().flat_map(|share| &share.positions).enumerate() {
        let first = numbers[number] as usize;
        if first == number {
            numbers[number] = positions.len() as u32;
            positions.push(DVec3::from_array(point.map_array(C::into)));
        } else {
            numbers[number] = numbers[first];
        }
    }
    let mut corners = Vec::new();
    for (start, share) in starts.into_iter().zip(shares) {
        renumber(&share.numbers, &numbers[start..], &mut corners);
    }
    (positions, corners)
}

/// For each number the one at its place in a list.
fn renumber(old: &[u32], new: &[u32], to: &mut Vec<u32>) {
    let old = old.par_iter().with_min_len(SHARE);
    to.par_extend(old.map(|&number| new[number as usize]));
}

/// Reads triangles in records, and counts those that have an attribute, which is not drawn.
pub(crate) fn binary(mut file: Records, contents: &mut Contents) -> Result<(), Wrong> {
    file.at = 0;
    let length = file.left_bytes();
    let truncated =
        |cause: String| format!("is truncated: {cause}: copy it or export the model again");
    let Some(announced) = counted(&file.bytes) else {
        let cause = format!("an STL without text begins with {HEADER} bytes, and it has {length}");
        return Err(truncated(cause).into());
    };
    file.at = HEADER;
    // The header may count more triangles than there are, or fewer.
    let there = file.left_bytes() / RECORD as u64;
    let warnings = &mut contents.warnings;
    // Programs that write before they know the number leave one of these.
    let count = match announced {
        0 | UNKNOWN if there > 0 => {
            let text = format!(
                "its header announces {announced} triangles, and it has {there}, which are read"
            );
            warnings.add("headers", &text);
            there
        }
        announced if announced > there => {
            let cause = format!("its header announces {announced} triangles, and it has {there}");
            return Err(truncated(cause).into());
        }
        announced => announced,
    };
    let more = file.left_bytes() - count * RECORD as u64;
    if more > 0 {
        let text =
            format!("{more} bytes follow the last of its {count} triangles; they are left out");
        warnings.add("bytes", &text);
    }
    let (mut all, mut with_attribute) = (Vec::new(), 0);
    let read = file.records(RECORD, count, |bytes| {
        let records = bytes.as_chunks::<RECORD>().0;
        // Some programs keep a colour there, in ways that exclude each other.
        for record in records {
            with_attribute += u64::from(record[RECORD - 2..] != [0; 2]);
        }
        all.extend(shares(records, rayon::current_num_threads()));
        records.len()
    });
    if read? < count {
        return Err("the file is cut off: it became shorter while it was read".into());
    }
    drop(file);
    contents.count("attribute of triangle", with_attribute);
    let (positions, corners) = merged(&all);
    let polygons = Polygons::triangles(count as usize);
    contents.parts.push(FilePart { positions, corners, polygons, ..FilePart::default() });
    Ok(())
}

/// A number of triangles that stands for one which is not known.
const UNKNOWN: u64 = u32::MAX as u64;

/// Reads the corners of records, a share of them by each of up to so many threads.
fn shares(records: &[[u8; RECORD]], threads: usize) -> Vec<Corners<f32>> {
    let share = records.len().div_ceil(threads).max(SHARE);
    let shares: Vec<_> = records.chunks(share).collect();
    parallel::map(shares.len(), |share| {
        let mut corners = Corners::with_capacity(shares[share].len());
        for record in shares[share] {
            // A normal, which is not read, three corners of three numbers, and the attribute.
            let (numbers, _) = record[12..RECORD - 2].as_chunks::<4>();
            for corner in numbers.as_chunks::<3>().0 {
                corners.push(corner.map_array(f32::from_le_bytes));
            }
        }
        corners
    })
}

/// Reads triangles in text, of which each `solid` becomes a part.
pub(crate) fn text(mut file: Records, contents: &mut Contents) -> Result<(), Wrong> {
    let warnings = &mut contents.warnings;
    let mut parts: Vec<FilePart> = Vec::new();
    // Those of the last part.
    let mut corners = Corners::with_capacity(0);
    let mut points: Vec<[f64; 3]> = Vec::new();
    let mut triangles = 0u64;
    // The first line of a facet that has not ended, and whether a solid has not.
    // How far it was when a file ends, which tells one that is cut off.
    let (mut open, mut is_open) = (None, false);
    loop {
        let number = file.line + 1;
        let Some(line) = file.next_line()? else { break };
        let mut wrong = None;
        let words = line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
        let mut words = words.peekable();
        // Most lines have one statement, and some files one line.
        while let (Some(word), None) = (words.next(), &wrong) {
            // Some programs write `end facet` in two words.
            let mut kind = statement(word);
            if kind == Some("end")
                && let Some(next) = words.next()
            {
                kind = end_of(next);
            }
            match kind {
                Some("vertex") => {
                    let numbers = [(); 3].map_array(|()| words.next().unwrap_or_default());
                    let is_last = words.peek().is_none_or(|word| statement(word).is_some());
                    match numbers.map_array(records::number) {
                        [Some(_), Some(_), Some(_)] if is_last && points.len() == 3 => {
                            wrong = Some("a facet has more than three vertices: export the model as OBJ, which has polygons".to_owned());
                        }
                        [Some(x), Some(y), Some(z)] if is_last => {
                            points.push([x, y, z]);
                            if let Some(word) = numbers.iter().find(|word| word.contains(&b',')) {
                                warnings.add_at(number, "lines", &records::comma(word));
                            }
                        }
                        _ => {
                            wrong = Some(format!(
                                "'{}' is not 'vertex X Y Z' with three numbers: repair the line",
                                shown(line)
                            ));
                        }
                    }
                }
                Some("facet") if points.is_empty() => open = Some(number),
                Some("facet" | "endfacet") if points.len() != 3 => {
                    wrong = Some(format!(
                        "a facet ends with {} vertices instead of 3: export the model again",
                        points.len()
                    ));
                }
                Some("facet" | "endfacet") => {
                    if parts.is_empty() {
                        parts.push(FilePart::default());
                    }
                    if let Some(part) = parts.last_mut() {
                        for point in points.drain(..) {
                            corners.push(point);
                        }
                        part.polygons.push(3, open.unwrap_or(number) as u32, 0);
                    }
                    triangles += 1;
                    // Where no `endfacet` is before it.
                    open = (kind == Some("facet")).then_some(number);
                }
                // What was read so far belongs to the solid before this one.
                Some("solid") => {
                    end_part(parts.last_mut(), &mut corners);
                    let name = name(&mut words, &["facet", "endsolid"]);
                    // A line is six bytes, and a part hundreds.
                    if parts.last().is_some_and(|part| part.polygons.len() == 0) {
                        parts.pop();
                    }
                    parts.push(FilePart { name, ..FilePart::default() });
                    is_open = true;
                }
                Some("endsolid") => {
                    is_open = false;
                    name(&mut words, &["solid"]);
                }
                Some("outer" | "endloop") => {}
                _ => {
                    let text =
                        format!("'{}' is no line of an STL; the line is left out", shown(line));
                    warnings.add_at(number, "lines", &text);
                    break;
                }
            }
            // Normals, and what is no statement.
            while words.next_if(|word| statement(word).is_none()).is_some() {}
        }
        // A wrong line ends the file, unless it is the last one.
        let Some(cause) = wrong else { continue };
        // The last line of a file that was cut off may be a part of one.
        if file.next_line()?.is_some() {
            return Err(Wrong { line: number, cause });
        }
        open = open.or(Some(number));
        break;
    }
    if let Some(line) = open {
        let cause = format!(
            "the file ends inside this facet: it is truncated, with {triangles} whole triangles before; copy it or export the model again"
        );
        return Err(Wrong { line, cause });
    }
    if is_open && triangles > 0 {
        let text =
            format!("ends without 'endsolid' after {triangles} triangles: it may be truncated");
        warnings.add("ends", &text);
    }
    end_part(parts.last_mut(), &mut corners);
    for part in parts {
        contents.add(part)?;
    }
    Ok(())
}

/// Moves the corners that were read into the part that they belong to.
fn end_part(part: Option<&mut FilePart>, corners: &mut Corners<f64>) {
    if let Some(part) = part {
        let corners = std::mem::replace(corners, Corners::with_capacity(0));
        (part.positions, part.corners) = merged(&[corners]);
    }
}

/// A text STL has these words beside numbers and the names of solids.
const STATEMENTS: [&str; 8] =
    ["vertex", "facet", "endfacet", "endloop", "outer", "solid", "endsolid", "end"];

/// The statement that a word begins, if it begins one.
fn statement(word: &[u8]) -> Option<&'static str> {
    STATEMENTS.into_iter().find(|known| word.eq_ignore_ascii_case(known.as_bytes()))
}

/// The statement of two words, of which this is the second after `end`.
fn end_of(word: &[u8]) -> Option<&'static str> {
    let is_second = |second: &str| word.eq_ignore_ascii_case(second.as_bytes());
    STATEMENTS.into_iter().find(|known| known.strip_prefix("end").is_some_and(is_second))
}

/// The name of a solid: what is left of a line, up to a word that begins the next statement where a facet is in the same line.
fn name<'a>(words: &mut Peekable<impl Iterator<Item = &'a [u8]> + Clone>, next: &[&str]) -> String {
    // A facet begins with its normal; a solid may be called `facet`.
    let (mut has_facet, mut is_after_facet) = (false, false);
    for word in words.clone() {
        has_facet |= is_after_facet && word.eq_ignore_ascii_case(b"normal");
        is_after_facet = word.eq_ignore_ascii_case(b"facet");
    }
    let ends_name = |word: &[u8]| {
        has_facet && next.iter().any(|next| word.eq_ignore_ascii_case(next.as_bytes()))
    };
    let mut name = Vec::new();
    while let Some(word) = words.next_if(|word| !ends_name(word)) {
        name.push(String::from_utf8_lossy(word));
    }
    records::name(&name.join(" ")).to_owned()
}

/// The beginning of a line, for a message.
fn shown(line: &[u8]) -> String {
    printable_short(String::from_utf8_lossy(line).trim(), 60)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A strip, whose neighbours share positions, and which comes back to its beginning.
    #[test]
    fn threads_give_the_numbers_that_one_would_give() {
        let count = 5 * SHARE;
        let point = |at: usize| [(at % 30_000) as f32, (at % 3) as f32, -0.0];
        let record = |at: usize| {
            let mut record = [0; RECORD];
            let numbers = [point(at), point(at + 1), point(at + 2)].into_iter().flatten();
            for (place, number) in record[12..48].chunks_exact_mut(4).zip(numbers) {
                place.copy_from_slice(&number.to_le_bytes());
            }
            record
        };
        let records: Vec<_> = (0..count).map(record).collect();
        let one = merged(&shares(&records, 1));
        assert_eq!((one.0.len(), one.1.len()), (30_000, 3 * count));
        for threads in [2, 3, 8] {
            assert_eq!(merged(&shares(&records, threads)), one);
        }
    }
}
