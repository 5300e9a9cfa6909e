//! What the formulas of the pipeline give: numbers in, numbers out, where no pixel has a part.
//!
//! All is computed in quotients of big integers, but for a root, which is cut 100 bits after the point, and the logarithm of a level,
//! which is rounded to an `f64`.

use crate::values::Exact;

rasterproof_core::named! {
    /// A formula, by its name in requests.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Formula {
        /// The distance of a film and a point x, y, z of camera space: x and y on the film, and w (chapter 4).
        Project = "project",
        /// Width and height of a window, the distances of both planes, and a point x, y, z of camera space: x and y in the window,
        /// and the depth from 0 to 1 (chapter 8).
        Window = "window",
        /// Three corners x, y in the window: 1 where they run clockwise after they are snapped, -1 where they run the other way,
        /// 0 where there is no area (chapter 9).
        Winding = "winding",
        /// An axis 0, 1 or 2, cosine and sine, a centre and a point: the point turned about an axis through the centre (chapter 10).
        Turn = "turn",
        /// A matrix of three rows, and a normal: the normal of the surface that the matrix has moved (chapter 10).
        Normal = "normal",
        /// A normal of any length, the direction to the light of length 1, ambient and diffuse light: the brightness (chapter 11).
        Light = "light",
        /// u, and a row of texels that repeats: what the nearest and what the bilinear look-up reads (chapter 11).
        Texel = "texel",
        /// Width and height of a texture, three corners x, y, w, u, v, and a place in the window: the level there (chapter 13).
        Level = "level",
    }
}

/// A number that a formula gives.
#[derive(Clone, Debug)]
pub struct ExactNumber {
    pub exact: Exact,
    /// What a tolerance is a part of.
    pub scale: f64,
}

/// The largest number that may be asked.
const MOST: f64 = 1e6;
/// Directions of length 1 are given in decimals.
const UNIT: f64 = 1e-9;
/// The most texels that a row has, so that a request is a short line.
const MOST_TEXELS: usize = 16;

impl Formula {
    /// What the formula gives; nothing where these are no numbers to ask it.
    #[must_use]
    pub fn of(self, numbers: &[f64]) -> Option<Vec<ExactNumber>> {
        if !numbers.iter().all(|number| number.abs() <= MOST) {
            return None;
        }
        match self {
            Self::Project => project(numbers),
            Self::Window => window(numbers),
            Self::Winding => winding(numbers),
            Self::Turn => turn(numbers),
            Self::Normal => normal(numbers),
            Self::Light => light(numbers),
            Self::Texel => texel(numbers),
            Self::Level => level(numbers),
        }
    }
}

fn largest(numbers: &[f64]) -> f64 {
    let mut most = 0.0_f64;
    for number in numbers {
        most = most.max(number.abs());
    }
    most
}

/// Numbers that may be off by a part of the largest of them, or of `least` where that is more.
fn alike(exact: Vec<Exact>, least: f64) -> Vec<ExactNumber> {
    let floats: Vec<f64> = exact.iter().map(Exact::to_f64).collect();
    let scale = largest(&floats).max(least);
    exact.into_iter().map(|exact| ExactNumber { exact, scale }).collect()
}

/// See [`Formula::Project`], as of those below.
fn project(numbers: &[f64]) -> Option<Vec<ExactNumber>> {
    let &[n, .., z] = numbers else { return None };
    let [film, x, y, w] = <[f64; 4]>::try_from(numbers).ok()?.map(Exact::from);
    if n <= 0.0 || z <= 0.0 {
        return None;
    }
    let mut given = alike(vec![&film * x / &w, film * y / &w], 0.0);
    given.extend(alike(vec![w], 0.0));
    Some(given)
}

fn window(numbers: &[f64]) -> Option<Vec<ExactNumber>> {
    let &[width_px, height_px, n, f, _, _, distance] = numbers else { return None };
    let [width, height, near, far, x, y, z] = <[f64; 7]>::try_from(numbers).ok()?.map(Exact::from);
    if width_px <= 0.0 || height_px <= 0.0 || n <= 0.0 || f <= n || distance <= 0.0 {
        return None;
    }
    let [one, two] = [1.0, 2.0].map(Exact::from);
    let x_px = (&near * x / &z + &one) / &two * width;
    let y_px = (&one - &near * y / &z) / &two * height;
    // z' = a z + b is -1 at the near plane and 1 at the far one, divided by w' = z.
    let depth = ((&far + &near) - &two * &far * &near / &z) / (far - near);
    let mut given = alike(vec![x_px], width_px);
    given.extend(alike(vec![y_px], height_px));
    given.extend(alike(vec![(depth + one) / two], 1.0));
    Some(given)
}

fn winding(numbers: &[f64]) -> Option<Vec<ExactNumber>> {
    let sub = <[f64; 6]>::try_from(numbers).ok()?.map(|px| px * 256.0);
    // What lies halfway between two places of the grid may be snapped to either.
    if sub.iter().any(|sub| (sub - sub.floor()) == 0.5) {
        return None;
    }
    let [ax, ay, bx, by, cx, cy] = sub.map(|sub| sub.round() as i64);
    let twice_area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
    Some(alike(vec![Exact::from(twice_area.signum() as f64)], 1.0))
}

fn turn(numbers: &[f64]) -> Option<Vec<ExactNumber>> {
    let &[axis, cos, sin, ..] = numbers else { return None };
    let [_, c, s, centre @ .., x, y, z] = <[f64; 9]>::try_from(numbers).ok()?.map(Exact::from);
    let axis = [0.0, 1.0, 2.0].iter().position(|known| *known == axis)?;
    if (cos * cos + sin * sin - 1.0).abs() > UNIT {
        return None;
    }
    let mut point = [x, y, z];
    let [from, to] = [(axis + 1) % 3, (axis + 2) % 3];
    // Each axis goes towards the next one in the ring x, y, z.
    let [a, b] = [from, to].map(|k| &point[k] - &centre[k]);
    point[from] = &centre[from] + (&c * &a - &s * &b);
    point[to] = &centre[to] + (s * a + c * b);
    Some(alike(point.to_vec(), largest(&numbers[3..])))
}

fn normal(numbers: &[f64]) -> Option<Vec<ExactNumber>> {
    let numbers: Vec<Exact> = numbers.iter().map(|number| Exact::from(*number)).collect();
    let (matrix, n) = numbers.split_at_checked(9)?;
    let [x, y, z] = n else { return None };
    // The inverse, transposed, has at each place the cofactor of that place, divided by the determinant.
    let rows = [0, 1, 2].map(|row| [0, 1, 2].map(|column| cofactor(matrix, row, column)));
    let [c0, c1, c2] = &rows[0];
    let determinant = &matrix[0] * c0 + &matrix[1] * c1 + &matrix[2] * c2;
    if determinant == Exact::from(0.0) {
        return None;
    }
    let moved = rows.map(|[a, b, c]| (a * x + b * y + c * z) / &determinant);
    Some(alike(moved.into(), 0.0))
}

/// The determinant of what is left of a matrix without a row and a column, with its sign: the rows and columns after these, in turn.
fn cofactor(matrix: &[Exact], row: usize, column: usize) -> Exact {
    let at = |i: usize, j: usize| &matrix[3 * ((row + i) % 3) + (column + j) % 3];
    at(1, 1) * at(2, 2) - at(1, 2) * at(2, 1)
}

fn light(numbers: &[f64]) -> Option<Vec<ExactNumber>> {
    let &[_, _, _, lx, ly, lz, a, k] = numbers else { return None };
    let [n0, n1, n2, l0, l1, l2, ambient, diffuse] =
        <[f64; 8]>::try_from(numbers).ok()?.map(Exact::from);
    if (lx * lx + ly * ly + lz * lz - 1.0).abs() > UNIT || a < 0.0 || k < 0.0 {
        return None;
    }
    let dot = &n0 * l0 + &n1 * l1 + &n2 * l2;
    let length = (&n0 * &n0 + &n1 * &n1 + &n2 * &n2).root();
    let zero = Exact::from(0.0);
    let brightness = if dot > zero { ambient + diffuse * dot / length } else { ambient };
    Some(alike(vec![brightness], a + k))
}

fn texel(numbers: &[f64]) -> Option<Vec<ExactNumber>> {
    let (u, texels) = numbers.split_first()?;
    let count = texels.len();
    let place = u * count as f64;
    // On whole numbers of 1/256 texel there is nothing to round, and all below is exact.
    if !(1..=MOST_TEXELS).contains(&count) || (256.0 * place).fract() != 0.0 {
        return None;
    }
    // A texel has its value at its centre.
    let from_centre = place - 0.5;
    let left = from_centre.floor();
    let [nearest, first, second] = [place.floor(), left, left + 1.0]
        .map(|index| Exact::from(texels[(index as i64).rem_euclid(count as i64) as usize]));
    let mixed = &first + (second - &first) * Exact::from(from_centre - left);
    let scale = largest(texels);
    Some(vec![ExactNumber { exact: nearest, scale }, ExactNumber { exact: mixed, scale }])
}

/// A corner of a triangle with a texture: x, y, w, u, v.
type TexturedCorner = [Exact; 5];

fn level(numbers: &[f64]) -> Option<Vec<ExactNumber>> {
    let &[width, height, ref corners @ .., _, _] = numbers else { return None };
    let numbers: Vec<Exact> = numbers.iter().map(|number| Exact::from(*number)).collect();
    if corners.len() != 15 || width < 1.0 || height < 1.0 {
        return None;
    }
    let mut exact = Vec::new();
    for (given, exact_numbers) in corners.chunks_exact(5).zip(numbers[2..].chunks_exact(5)) {
        // What lies behind the eye is not seen.
        if given[2] <= 0.0 {
            return None;
        }
        exact.push(TexturedCorner::try_from(exact_numbers.to_vec()).ok()?);
    }
    let corners: [TexturedCorner; 3] = exact.try_into().ok()?;
    let at = [&numbers[17], &numbers[18]];
    let one = Exact::from(1.0);
    // 1/w, u/w and v/w change evenly in the window: each with its value at the place, and its slopes.
    let [inv_w, u_over_w, v_over_w] = [
        plane(&corners, at, |_| one.clone())?,
        plane(&corners, at, |[_, _, _, u, _]| u.clone())?,
        plane(&corners, at, |[_, _, _, _, v]| v.clone())?,
    ];
    let zero = Exact::from(0.0);
    if inv_w[0] <= zero {
        return None;
    }
    let mut longest = zero.clone();
    for slope in [1, 2] {
        let du = derivative(&u_over_w, &inv_w, slope) * &numbers[0];
        let dv = derivative(&v_over_w, &inv_w, slope) * &numbers[1];
        let square = &du * &du + &dv * &dv;
        longest = if square > longest { square } else { longest };
    }
    if longest == zero {
        return None;
    }
    Some(alike(vec![Exact::from(0.5 * libm::log2(longest.to_f64()))], 1.0))
}

/// How u or v grows along an axis, as the quotient of two planes.
fn derivative(over_w: &[Exact; 3], inv_w: &[Exact; 3], slope: usize) -> Exact {
    let value = &over_w[0] / &inv_w[0];
    (&over_w[slope] - value * &inv_w[slope]) / &inv_w[0]
}

/// Of the plane through three values over w: its value at a place, and its slopes along x and y. Nothing of a triangle without area.
fn plane(
    corners: &[TexturedCorner; 3],
    [x, y]: [&Exact; 2],
    value: impl Fn(&TexturedCorner) -> Exact,
) -> Option<[Exact; 3]> {
    let [f0, f1, f2] = corners.each_ref().map(|corner| value(corner) / &corner[2]);
    let [[x0, y0, ..], [x1, y1, ..], [x2, y2, ..]] = corners;
    let [dx1, dy1, dx2, dy2] = [x1 - x0, y1 - y0, x2 - x0, y2 - y0];
    let area = &dx1 * &dy2 - &dx2 * &dy1;
    if area == Exact::from(0.0) {
        return None;
    }
    let [df1, df2] = [f1 - &f0, f2 - &f0];
    let by_x = (&df1 * dy2 - &df2 * dy1) / &area;
    let by_y = (df2 * dx1 - df1 * dx2) / area;
    Some([f0 + &by_x * (x - x0) + &by_y * (y - y0), by_x, by_y])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The examples of the chapters, computed there by hand.
    #[test]
    fn formulas_by_hand() {
        let all = |formula: Formula, numbers: &[f64]| -> Vec<f64> {
            let given = formula.of(numbers).expect("numbers to ask");
            given.iter().map(|given| given.exact.to_f64()).collect()
        };
        assert_eq!(all(Formula::Project, &[1.0, 2.0, 1.0, 4.0]), [0.5, 0.25, 4.0]);
        // With the planes at 1 and 3, z' is 2 z - 3: at the distance 2 the depth is (2 - 3/2 + 1) / 2.
        let window = all(Formula::Window, &[5.0, 5.0, 1.0, 3.0, 1.0, 0.5, 2.0]);
        assert_eq!(window, [3.75, 1.875, 0.75]);
        assert_eq!(all(Formula::Winding, &[1.0, 1.0, 4.0, 1.0, 1.0, 4.0]), [1.0]);
        assert_eq!(all(Formula::Winding, &[0.0, 0.0, 1.0, 0.0021, 2.0, 0.0043]), [-1.0]);
        let turn = all(Formula::Turn, &[2.0, 0.0, 1.0, 4.0, 0.0, 0.0, 5.0, 0.0, 0.0]);
        assert_eq!(turn, [4.0, 1.0, 0.0]);
        let stretched = [4.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 0.0];
        assert_eq!(all(Formula::Normal, &stretched), [0.25, 1.0, 0.0]);
        assert_eq!(all(Formula::Light, &[2.0, 0.0, 0.0, 0.6, 0.8, 0.0, 0.2, 0.8]), [0.68]);
        assert_eq!(all(Formula::Light, &[-1.0, 0.0, 0.0, 0.6, 0.8, 0.0, 0.2, 0.8]), [0.2]);
        let texels = [10.0, 20.0, 30.0, 40.0];
        let texel = |u: f64| all(Formula::Texel, &[&[u][..], &texels].concat());
        assert_eq!((texel(0.0), texel(0.59375)), (vec![10.0, 25.0], vec![30.0, 28.75]));
        assert!(Formula::Texel.of(&[0.6, 10.0, 20.0, 30.0, 40.0]).is_none());
    }

    /// The floor of chapter 13, as a triangle: at row s it lies at 100/s, where v is 1600/s texels.
    #[test]
    fn a_level_by_hand() {
        let corner = |x: f64, s: f64| [x, s, 100.0 / s, x * 0.16 / s, 16.0 / s];
        let corners = [corner(-100.0, 5.0), corner(100.0, 5.0), corner(0.0, 50.0)];
        let level = |s: f64| {
            let numbers = [&[100.0, 100.0][..], corners.as_flattened(), &[0.0, s]].concat();
            Formula::Level.of(&numbers).unwrap()[0].exact.to_f64()
        };
        assert!(
            [10.0, 20.0, 40.0]
                .map(level)
                .iter()
                .zip([4.0, 2.0, 0.0])
                .all(|(a, b)| (a - b).abs() < 1e-9)
        );
    }
}
