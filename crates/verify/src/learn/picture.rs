//! A picture with a margin, and the rows and columns of the shape in it.

/// Pixels kept on each side of the window: what a shape is like just beyond it decides which pixel of a row is its last.
pub(super) const MARGIN: i32 = 3;

/// A number for each pixel of a window and of its margin: how often it is drawn.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Picture {
    /// Width and height of the window.
    pub(super) side: [i32; 2],
    hits: Vec<u8>,
}

impl Picture {
    pub(super) fn new(side: [i32; 2]) -> Self {
        let [columns, rows] = side.map(|side| (side + 2 * MARGIN) as usize);
        Self { side, hits: vec![0; columns * rows] }
    }

    fn index(&self, [x, y]: [i32; 2]) -> Option<usize> {
        let [columns, rows] = self.side.map(|side| side + 2 * MARGIN);
        let (column, row) = (x + MARGIN, y + MARGIN);
        let is_in = (0..columns).contains(&column) && (0..rows).contains(&row);
        is_in.then_some((row * columns + column) as usize)
    }

    /// How often a pixel is drawn; 0 beyond the margin.
    pub(super) fn hits(&self, at: [i32; 2]) -> u8 {
        self.index(at).map_or(0, |i| self.hits[i])
    }

    pub(super) fn has(&self, at: [i32; 2]) -> bool {
        self.hits(at) > 0
    }

    /// Beyond the margin nothing is kept.
    pub(super) fn set(&mut self, at: [i32; 2], hits: u8) {
        if let Some(i) = self.index(at) {
            self.hits[i] = hits;
        }
    }

    /// Whether a pixel lies in the window.
    pub(super) fn shows(&self, [x, y]: [i32; 2]) -> bool {
        (0..self.side[0]).contains(&x) && (0..self.side[1]).contains(&y)
    }

    /// The pixels of the window, row by row.
    pub(super) fn pixels(&self) -> impl Iterator<Item = [i32; 2]> + use<> {
        pixels([0, 0], self.side)
    }

    /// The pixels of the window and of its margin.
    pub(super) fn all(&self) -> impl Iterator<Item = [i32; 2]> + use<> {
        pixels([-MARGIN; 2], self.side.map(|side| side + MARGIN))
    }

    /// The rows of the window.
    fn rows(&self) -> impl Iterator<Item = &[u8]> {
        let [columns, _] = self.side.map(|side| (side + 2 * MARGIN) as usize);
        let [width, height] = self.side.map(|side| side as usize);
        let margin = MARGIN as usize;
        let rows = self.hits.chunks_exact(columns).skip(margin).take(height);
        rows.map(move |row| &row[margin..margin + width])
    }

    /// Pixels of the window that are drawn otherwise than in another picture of its size.
    pub(super) fn differs(&self, other: &Self) -> usize {
        let rows = self.rows().zip(other.rows()).filter(|(a, b)| a != b);
        rows.map(|(a, b)| a.iter().zip(b).filter(|(a, b)| a != b).count()).sum()
    }

    /// The same without counts of pixels that are drawn more than once.
    pub(super) fn once(mut self) -> Self {
        self.hits.iter_mut().for_each(|hits| *hits = (*hits).min(1));
        self
    }

    /// Whether nothing is drawn in the window.
    pub(super) fn is_empty(&self) -> bool {
        self.rows().all(|row| row.iter().all(|hits| *hits == 0))
    }

    /// Whether the window looks as in another picture of its size.
    pub(super) fn is_as(&self, other: &Self) -> bool {
        self.rows().eq(other.rows())
    }
}

fn pixels(from: [i32; 2], to: [i32; 2]) -> impl Iterator<Item = [i32; 2]> {
    (from[1]..to[1]).flat_map(move |y| (from[0]..to[0]).map(move |x| [x, y]))
}

/// Where a shape begins and ends in a row or a column, and how many pixels it has there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    pub(super) first: i32,
    pub(super) last: i32,
    pub(super) count: i32,
}

const EMPTY: Run = Run { first: i32::MAX, last: i32::MIN, count: 0 };

/// The runs of a picture in its window, by row and by column.
pub(super) struct Runs {
    rows: Vec<Run>,
    columns: Vec<Run>,
    /// From the first row that has a pixel to the last, and how many rows have one.
    pub(super) of_rows: Run,
    pub(super) of_columns: Run,
}

impl Runs {
    pub(super) fn of(picture: &Picture) -> Self {
        let [width, height] = picture.side.map(|side| side as usize);
        let (mut rows, mut columns) = (vec![EMPTY; height], vec![EMPTY; width]);
        for (y, row) in picture.rows().enumerate() {
            for x in (0..width).filter(|x| row[*x] > 0) {
                rows[y].add(x as i32);
                columns[x].add(y as i32);
            }
        }
        let whole = |runs: &[Run]| {
            let mut whole = EMPTY;
            let filled = (0..).zip(runs).filter(|(_, run)| run.count > 0);
            filled.for_each(|(place, _)| whole.add(place));
            whole
        };
        let (of_rows, of_columns) = (whole(&rows), whole(&columns));
        Self { rows, columns, of_rows, of_columns }
    }

    /// The run of a row; nothing where the row is empty or beyond the window.
    pub(super) fn row(&self, y: i32) -> Option<Run> {
        self.rows.get(usize::try_from(y).ok()?).copied().filter(|run| run.count > 0)
    }

    pub(super) fn column(&self, x: i32) -> Option<Run> {
        self.columns.get(usize::try_from(x).ok()?).copied().filter(|run| run.count > 0)
    }
}

impl Run {
    fn add(&mut self, place: i32) {
        self.first = self.first.min(place);
        self.last = self.last.max(place);
        self.count += 1;
    }
}
