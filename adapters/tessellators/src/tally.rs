//! The counts of one family, and the file that keeps those of a library.

use std::fs;
use std::path::PathBuf;

use rasterproof_verify::partition::Family;

use crate::Library;

/// Kinds of faults: those of `FaultKind::ALL`, in its order, and two ways in which a process ends.
pub const KINDS: [&str; 11] = [
    "panic",
    "refused",
    "not finite",
    "overlap",
    "gap",
    "outside",
    "flipped",
    "T-junction",
    "degenerate",
    "process ended",
    "no answer",
];
/// The bits of T-junctions and of triangles without area: points are covered once as long as coordinates are exact.
const HARMLESS: u64 = 1 << 7 | 1 << 8;
pub const ENDED: usize = 9;
pub const SILENT: usize = 10;

pub struct Tally {
    pub family: Family,
    pub judged: u64,
    pub left_out: u64,
    pub wrong: u64,
    /// Those with another fault than T-junctions and triangles without area.
    pub wrong_cover: u64,
    pub added_points: u64,
    /// Polygons with a fault of each kind.
    pub faults: [u64; KINDS.len()],
    /// Of each kind the polygon with the fewest vertices: how many, and its number.
    pub smallest: [Option<(u64, u64)>; KINDS.len()],
}

impl Tally {
    fn new(family: Family) -> Self {
        Self {
            family,
            judged: 0,
            left_out: 0,
            wrong: 0,
            wrong_cover: 0,
            added_points: 0,
            faults: [0; KINDS.len()],
            smallest: [None; KINDS.len()],
        }
    }

    pub fn drawn(&self) -> u64 {
        self.judged + self.left_out
    }

    /// One more polygon: whether it was judged, vertices, added points, a bit for each kind of fault.
    pub fn count(&mut self, numbers: &[u64]) {
        let [judged, vertices, added_points, bits] = *numbers else { panic!("{numbers:?}") };
        let index = self.drawn();
        self.judged += judged;
        self.left_out += 1 - judged;
        self.wrong += u64::from(bits != 0);
        self.wrong_cover += u64::from(bits & !HARMLESS != 0);
        self.added_points += added_points;
        for kind in (0..KINDS.len()).filter(|kind| bits >> kind & 1 == 1) {
            self.faults[kind] += 1;
            if self.smallest[kind].is_none_or(|(size, _)| vertices < size) {
                self.smallest[kind] = Some((vertices, index));
            }
        }
    }
}

fn path(library: &Library) -> PathBuf {
    PathBuf::from(format!("results/{}.csv", library.name))
}

/// The counts that an earlier run kept in the results folder; none where there is no file.
pub fn read(library: &Library) -> Vec<Tally> {
    let text = fs::read_to_string(path(library)).unwrap_or_default();
    let mut lines = text.lines().skip(1);
    library
        .families()
        .map(|family| {
            let mut tally = Tally::new(family);
            let Some(line) = lines.next() else { return tally };
            let cells: Vec<&str> = line.split(',').collect();
            assert_eq!((cells[0], cells.len()), (family.name(), 6 + KINDS.len()), "{line}");
            let number = |text: &str| text.parse::<u64>().expect("a number");
            [tally.judged, tally.left_out, tally.wrong, tally.wrong_cover, tally.added_points] =
                [1, 2, 3, 4, 5].map(|i| number(cells[i]));
            for (kind, cell) in cells[6..].iter().enumerate() {
                let mut parts = cell.split(' ').map(number);
                tally.faults[kind] = parts.next().unwrap_or(0);
                tally.smallest[kind] = parts.next().zip(parts.next());
            }
            tally
        })
        .collect()
}

/// Replaces the file as a whole, so that a stop loses one round at most.
pub fn write(library: &Library, tallies: &[Tally]) {
    let mut text =
        format!("family,judged,left out,wrong,wrong cover,added points,{}\n", KINDS.join(","));
    for tally in tallies {
        let mut cells = vec![tally.family.name().to_owned()];
        let Tally { judged, left_out, wrong, wrong_cover, added_points, .. } = *tally;
        cells.extend([judged, left_out, wrong, wrong_cover, added_points].map(|n| n.to_string()));
        cells.extend(tally.faults.iter().zip(tally.smallest).map(|(count, smallest)| {
            smallest.map_or(count.to_string(), |(size, index)| format!("{count} {size} {index}"))
        }));
        text += &(cells.join(",") + "\n");
    }
    let path = path(library);
    let beside = path.with_extension("new");
    fs::create_dir_all("results").expect("results/ can be made");
    fs::write(&beside, text).expect("results can be written");
    fs::rename(beside, path).expect("results can be replaced");
}
