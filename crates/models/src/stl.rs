//! STL: triangles in text, or in records of 50 bytes after a header of 84.
//!
//! Own code, since the format has one kind of record, and errors name its line or byte. Its normals are not read: they are
//! those of the triangles, or wrong.

use std::hash::BuildHasher as _;
use std::path::Path;

use foldhash::fast::RandomState;
use glam::{DMat4, DVec3};
use hashbrown::HashTable;
use hashbrown::hash_table::Entry;
use rasterproof_core::parallel::{self, SHARE};
use rasterproof_host::text::printable_short;
use rayon::prelude::*;

use crate::ahead::Ahead;
use crate::contents::{Contents, Coordinate, FilePart, Polygons};
use crate::text::Text;
use crate::{BadFile, bad};

const HEADER: usize = 84;
const RECORD: usize = 50;
/// The triangles that the header of a binary file counts.
fn counted(bytes: &[u8]) -> Option<u64> {
    Some(u32::from_le_bytes(bytes.get(80..HEADER)?.try_into().ok()?).into())
}

/// Whether the length is that of the records which the header counts: text that begins with `solid` has another one.
pub(crate) fn is_binary(bytes: &[u8], length: u64) -> bool {
    counted(bytes).is_some_and(|count| count * RECORD as u64 + HEADER as u64 == length)
}

/// Whether the first word is `solid`.
pub(crate) fn is_text(bytes: &[u8]) -> bool {
    let rest = bytes.trim_ascii_start();
    rest.starts_with(b"solid") && rest.get(5).is_none_or(u8::is_ascii_whitespace)
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
    fn with_capacity(triangles: usize) -> Self {
        // A closed surface has half as many positions as triangles.
        let positions = Vec::with_capacity(triangles / 2);
        Self { positions, numbers: Vec::with_capacity(3 * triangles), recent: vec![0; RECENT] }
    }

    #[inline]
    fn push(&mut self, point: [C; 3]) {
        let [x, y, z]: [u64; 3] = point.map(|number| number.bits().into());
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
    let mut count = 0;
    let with_start = shares.iter().map(|share| {
        let start = count;
        count += share.positions.len();
        (start, share)
    });
    let shares: Vec<(usize, &Corners<C>)> = with_start.collect();
    // Equal positions have the same hash, so they are looked for in one of many small tables, which fits into a cache. The
    // seed of the hash is random, so that no file can be written whose positions all are in the same one.
    let hasher = RandomState::default();
    let tables = count.div_ceil(SHARE).max(1);
    let hash = |[x, y, z]: [C::Bits; 3]| hasher.hash_one((x, y, z));
    let sorted: Vec<Vec<Vec<Keyed<C>>>> = parallel::map(shares.len(), |share| {
        let (start, share) = shares[share];
        let usual = share.positions.len() / tables;
        let mut of_tables: Vec<_> =
            (0..tables).map(|_| Vec::with_capacity(usual + usual / 16)).collect();
        for (number, &point) in (start as u32..).zip(&share.positions) {
            let keys = point.map(C::bits);
            of_tables[(hash(keys) >> 32) as usize % tables].push((keys, number));
        }
        of_tables
    });
    let found: Vec<Vec<(u32, u32)>> = parallel::map(tables, |table| {
        let all = || sorted.iter().map(|of_tables| &of_tables[table]);
        let mut known = HashTable::with_capacity(all().map(Vec::len).sum());
        let mut again = Vec::new();
        for &(keys, number) in all().flatten() {
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
    for (number, &point) in shares.iter().flat_map(|(_, share)| &share.positions).enumerate() {
        let first = numbers[number] as usize;
        if first == number {
            numbers[number] = positions.len() as u32;
            positions.push(DVec3::from_array(point.map(C::into)));
        } else {
            numbers[number] = numbers[first];
        }
    }
    let mut corners = Vec::new();
    for (start, share) in shares {
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
pub(crate) fn binary(path: &Path, mut file: Ahead) -> Result<Contents, BadFile> {
    let count = counted(&file.bytes).unwrap_or(0);
    file.at = HEADER;
    let (mut all, mut with_attribute) = (Vec::new(), 0);
    let read = file.records(RECORD, count, |bytes| {
        let records = bytes.as_chunks::<RECORD>().0;
        // Some programs keep a colour there, in ways that exclude each other.
        let has_attribute = |record: &&[u8; RECORD]| record[RECORD - 2..] != [0; 2];
        with_attribute += records.iter().filter(has_attribute).count() as u64;
        all.extend(shares(records, rayon::current_num_threads()));
        records.len()
    });
    if read.map_err(|error| bad(path, None, error.cause))? < count {
        let cause = "the file is cut off: it became shorter while it was read";
        return Err(bad(path, None, cause));
    }
    drop(file);
    let mut contents = Contents::default();
    if with_attribute > 0 {
        contents.not_drawn.insert("attribute of triangle".to_owned(), with_attribute);
    }
    let (positions, corners) = merged(&all);
    let polygons = Polygons::triangles(count as usize);
    let to_file = DMat4::IDENTITY;
    contents.parts =
        vec![FilePart { to_file, positions, corners, polygons, ..FilePart::default() }];
    Ok(contents)
}

/// Reads the corners of records, a share of them by each of up to so many threads.
fn shares(records: &[[u8; RECORD]], threads: usize) -> Vec<Corners<f32>> {
    let share = records.len().div_ceil(threads).max(SHARE);
    let read = |share: &[[u8; RECORD]]| {
        let mut corners = Corners::with_capacity(share.len());
        for record in share {
            let (numbers, _) = record[12..RECORD - 2].as_chunks::<4>();
            for corner in numbers.as_chunks::<3>().0 {
                corners.push(corner.map(f32::from_le_bytes));
            }
        }
        corners
    };
    let shares: Vec<_> = records.chunks(share).collect();
    parallel::map(shares.len(), |share| read(shares[share]))
}

/// Triangles in text that are merged by one thread.
const TEXT_SHARE: usize = 1 << 17;

/// Reads triangles in text, of which each `solid` becomes a part.
pub(crate) fn text(path: &Path, mut text: Text) -> Result<Contents, BadFile> {
    let mut parts: Vec<FilePart> = Vec::new();
    // Those of the last part.
    let mut shares: Vec<Corners<f64>> = Vec::new();
    let end = |part: Option<&mut FilePart>, shares: &mut Vec<Corners<f64>>| {
        if let Some(part) = part {
            (part.positions, part.corners) = merged(&std::mem::take(shares));
        }
    };
    let mut points: Vec<[f64; 3]> = Vec::new();
    let (mut number, mut first_line) = (0, 0);
    while let Some(line) = text.next_line().map_err(|error| bad(path, None, error.cause))? {
        number += 1;
        let shown = || printable_short(String::from_utf8_lossy(line).trim(), 60);
        let mut words = line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
        let Some(kind) = words.next() else { continue };
        let is = |name: &str| kind.eq_ignore_ascii_case(name.as_bytes());
        if is("vertex") {
            let mut next = || std::str::from_utf8(words.next()?).ok()?.parse::<f64>().ok();
            let (Some(x), Some(y), Some(z), None) = (next(), next(), next(), words.next()) else {
                let cause = format!(
                    "'{}' is not 'vertex X Y Z' with three numbers: repair the line",
                    shown()
                );
                return Err(bad(path, Some(number), cause));
            };
            if points.len() == 3 {
                let cause = "a facet has more than three vertices: export the model as OBJ, which has polygons";
                return Err(bad(path, Some(number), cause));
            }
            points.push([x, y, z]);
        } else if is("facet") {
            points.clear();
            first_line = number;
        } else if is("endfacet") {
            let (3, Some(part)) = (points.len(), parts.last_mut()) else {
                let cause = format!(
                    "a facet ends with {} vertices instead of 3: export the model again",
                    points.len()
                );
                return Err(bad(path, Some(number), cause));
            };
            if shares.last().is_none_or(|share| share.numbers.len() >= 3 * TEXT_SHARE) {
                shares.push(Corners::with_capacity(0));
            }
            if let Some(share) = shares.last_mut() {
                points.drain(..).for_each(|point| share.push(point));
            }
            part.polygons.push(3, first_line as u32, 0);
        } else if is("solid") {
            end(parts.last_mut(), &mut shares);
            let name = words.map(String::from_utf8_lossy).collect::<Vec<_>>().join(" ");
            // A line is six bytes, and a part hundreds.
            if parts.last().is_some_and(|part| part.polygons.len() == 0) {
                parts.pop();
            }
            parts.push(FilePart { name, to_file: DMat4::IDENTITY, ..FilePart::default() });
        } else if !(is("outer") || is("endloop") || is("endsolid")) {
            let cause =
                format!("'{}' is no line of an STL: remove it, or export the model again", shown());
            return Err(bad(path, Some(number), cause));
        }
    }
    if !points.is_empty() {
        let cause = "the file ends inside this facet: it is cut off; export the model again";
        return Err(bad(path, Some(first_line.max(1)), cause));
    }
    end(parts.last_mut(), &mut shares);
    let mut contents = Contents::default();
    for part in parts {
        contents.add(part).map_err(|cause| bad(path, None, cause))?;
    }
    Ok(contents)
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
