//! STL: triangles in text, or in records of 50 bytes after a header of 84.
//!
//! Own code, since the format has one kind of record, and errors name its line or byte. Its normals are not read: they are
//! those of the triangles, or wrong.

use std::collections::BTreeMap;
use std::hash::BuildHasher as _;
use std::path::Path;

use foldhash::fast::RandomState;
use glam::{DMat4, DVec3};
use hashbrown::HashTable;
use rasterproof_host::text::printable_short;
use rayon::prelude::*;

use crate::contents::{Contents, FilePart, Polygons, SHARE};
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

/// A part whose equal positions are one, so that neighbours are known.
struct Merged {
    part: FilePart,
    /// The numbers of the positions, to find a position again.
    known: HashTable<u32>,
    /// The numbers of positions that were seen not long ago, by their hashes.
    recent: Vec<u32>,
    /// With a random seed, so that no file can be written whose positions all have the same hash.
    hasher: RandomState,
}

impl Merged {
    fn new(name: String, triangles: usize) -> Self {
        let mut part = FilePart { name, to_file: DMat4::IDENTITY, ..FilePart::default() };
        part.corners.reserve(3 * triangles);
        // A closed surface has half as many positions as triangles.
        part.positions.reserve(triangles / 2);
        let known = HashTable::with_capacity(triangles / 2);
        let recent = vec![u32::MAX; RECENT];
        Self { part, known, recent, hasher: RandomState::default() }
    }

    fn triangle(&mut self, points: [DVec3; 3], line: u32) {
        let mut corners = [0; 3];
        for (corner, point) in corners.iter_mut().zip(points) {
            let number = self.in_last(point).unwrap_or_else(|| self.number(point));
            *corner = number;
        }
        self.part.corners.extend(corners);
        self.part.polygons.push(3, line, 0);
    }

    /// Adds the triangles of another part, which come after those of this one.
    fn append(&mut self, other: FilePart) {
        let numbers: Vec<u32> = other.positions.iter().map(|&point| self.number(point)).collect();
        let corners = other.corners.par_iter().with_min_len(SHARE);
        self.part.corners.par_extend(corners.map(|&corner| numbers[corner as usize]));
        self.part.polygons = Polygons::triangles(self.part.corners.len() / 3);
    }

    /// The number of a position of the last triangle, which often is a neighbour.
    #[inline]
    fn in_last(&self, point: DVec3) -> Option<u32> {
        let last = self.part.corners.last_chunk::<3>()?;
        last.iter().copied().find(|&number| self.part.positions[number as usize] == point)
    }

    #[inline]
    fn number(&mut self, point: DVec3) -> u32 {
        let hasher = &self.hasher;
        // -0 and 0 are one position.
        let hash = |point: DVec3| {
            let [x, y, z] = (point + DVec3::ZERO).to_array().map(f64::to_bits);
            hasher.hash_one((x, y, z))
        };
        let positions = &mut self.part.positions;
        let of_point = hash(point);
        let recent = &mut self.recent[of_point as usize % RECENT];
        if positions.get(*recent as usize) == Some(&point) {
            return *recent;
        }
        let is_same = |&number: &u32| positions[number as usize] == point;
        if let Some(&number) = self.known.find(of_point, is_same) {
            *recent = number;
            return number;
        }
        let number = positions.len() as u32;
        *recent = number;
        positions.push(point);
        self.known.insert_unique(of_point, number, |&number| hash(positions[number as usize]));
        number
    }
}

/// Positions that are found without looking into the table: it is larger than a cache of the processor, and neighbours
/// of a triangle are often not far before it in the file.
const RECENT: usize = 1 << 14;

/// Reads the bytes of an STL of either kind.
pub(crate) fn read(path: &Path, bytes: &[u8]) -> Result<Contents, BadFile> {
    let mut not_drawn = BTreeMap::new();
    let parts = match is_binary(bytes, bytes.len() as u64) {
        true => vec![binary(bytes, &mut not_drawn)],
        false => text(path, bytes)?,
    };
    Ok(Contents { parts, not_drawn, ..Contents::default() })
}

fn binary(bytes: &[u8], not_drawn: &mut BTreeMap<String, u64>) -> FilePart {
    let (records, _) = bytes[HEADER..].as_chunks::<RECORD>();
    // Some programs keep a colour there, in ways that exclude each other.
    let has_attribute = |record: &&[u8; RECORD]| record[RECORD - 2..] != [0; 2];
    let with_attribute = records.par_iter().with_min_len(SHARE).filter(has_attribute).count();
    if with_attribute > 0 {
        not_drawn.insert("attribute of triangle".to_owned(), with_attribute as u64);
    }
    merged(records, records.len(), rayon::current_num_threads()).part
}

/// Merges the equal positions of records with this number of threads, and reserves memory for `reserved` triangles. Positions get
/// the same numbers as with one thread.
fn merged(records: &[[u8; RECORD]], reserved: usize, threads: usize) -> Merged {
    if threads > 1 && records.len() > SHARE {
        let (first, second) = records.split_at(records.len() / 2);
        let (mut first, second) = rayon::join(
            || merged(first, reserved, threads / 2),
            || merged(second, second.len(), threads - threads / 2),
        );
        first.append(second.part);
        return first;
    }
    let mut merged = Merged::new(String::new(), reserved);
    for record in records {
        let number_at = |at: usize| {
            let at = 12 + 4 * at;
            let word = [record[at], record[at + 1], record[at + 2], record[at + 3]];
            f64::from(f32::from_le_bytes(word))
        };
        let point = |at: usize| DVec3::new(number_at(at), number_at(at + 1), number_at(at + 2));
        merged.triangle([point(0), point(3), point(6)], 0);
    }
    merged
}

fn text(path: &Path, bytes: &[u8]) -> Result<Vec<FilePart>, BadFile> {
    let mut parts: Vec<Merged> = Vec::new();
    let mut points: Vec<DVec3> = Vec::new();
    let mut first_line = 0;
    for (index, line) in bytes.split(|&byte| byte == b'\n' || byte == b'\r').enumerate() {
        let number = index + 1;
        let line = String::from_utf8_lossy(line);
        let mut words = line.split_ascii_whitespace();
        match words.next().map(str::to_ascii_lowercase).as_deref() {
            Some("solid") => {
                parts.push(Merged::new(words.collect::<Vec<_>>().join(" "), 0));
            }
            Some("facet") => (points, first_line) = (Vec::new(), number),
            Some("vertex") => {
                let numbers: Option<Vec<f64>> = words.map(|word| word.parse().ok()).collect();
                let Some(&[x, y, z]) = numbers.as_deref() else {
                    let line = printable_short(&line, 60);
                    let cause = format!(
                        "'{line}' is not 'vertex X Y Z' with three numbers: repair the line"
                    );
                    return Err(bad(path, Some(number), cause));
                };
                if points.len() == 3 {
                    let cause = "a facet has more than three vertices: export the model as OBJ, which has polygons";
                    return Err(bad(path, Some(number), cause));
                }
                points.push(DVec3::new(x, y, z));
            }
            Some("endfacet") => {
                let (Ok(corners), Some(part)) =
                    (<[DVec3; 3]>::try_from(&points[..]), parts.last_mut())
                else {
                    let cause = format!(
                        "a facet ends with {} vertices instead of 3: export the model again",
                        points.len()
                    );
                    return Err(bad(path, Some(number), cause));
                };
                part.triangle(corners, first_line as u32);
                points.clear();
            }
            Some("outer" | "endloop" | "endsolid") | None => {}
            Some(_) => {
                let cause = format!(
                    "'{}' is no line of an STL: remove it, or export the model again",
                    printable_short(&line, 60)
                );
                return Err(bad(path, Some(number), cause));
            }
        }
    }
    if !points.is_empty() {
        let cause = "the file ends inside this facet: it is cut off; export the model again";
        return Err(bad(path, Some(first_line.max(1)), cause));
    }
    Ok(parts.into_iter().map(|merged| merged.part).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A strip, whose neighbours share positions, and which comes back to its beginning.
    #[test]
    fn threads_give_the_numbers_that_one_would_give() {
        let count = 5 * SHARE;
        let point = |at: usize| [(at % 40_000) as f32, (at % 3) as f32, -0.0];
        let record = |at: usize| {
            let mut record = [0; RECORD];
            let numbers = [point(at), point(at + 1), point(at + 2)].into_iter().flatten();
            for (place, number) in record[12..48].chunks_exact_mut(4).zip(numbers) {
                place.copy_from_slice(&number.to_le_bytes());
            }
            record
        };
        let records: Vec<_> = (0..count).map(record).collect();
        let one = merged(&records, count, 1).part;
        assert!(one.positions.len() > SHARE && one.polygons.len() == count);
        for threads in [2, 3, 8] {
            let many = merged(&records, count, threads).part;
            assert_eq!(
                (many.positions, many.corners),
                (one.positions.clone(), one.corners.clone())
            );
            assert_eq!(many.polygons.len(), count);
        }
    }
}
