//! What a formula gives to those who believe something else: in floats, as a student computes it.
//!
//! Each formula has one function, which computes it with the mistakes that are known of it. A mistake is a line of a `match`.

use rasterproof_verify::oracle::formula::Formula;

/// A mistake about one of the formulas, by the formula that it is about.
#[derive(Clone, Copy)]
pub(super) enum Wrong {
    Project(Project),
    Window(Window),
    Winding(Winding),
    Turn(Turn),
    Normal(Normal),
    Light(Light),
    Texel(Texel),
    Level(Level),
}

impl Wrong {
    /// The numbers that the mistake leads to; nothing where a request is about another formula.
    pub(super) fn of(self, formula: Formula, numbers: &[f64]) -> Option<Vec<f64>> {
        match (self, formula) {
            (Self::Project(how), Formula::Project) => project(how, numbers),
            (Self::Window(how), Formula::Window) => window(how, numbers),
            (Self::Winding(how), Formula::Winding) => winding(how, numbers),
            (Self::Turn(how), Formula::Turn) => turned_point(how, numbers),
            (Self::Normal(how), Formula::Normal) => normal(how, numbers),
            (Self::Light(how), Formula::Light) => brightness(how, numbers),
            (Self::Texel(how), Formula::Texel) => texels(how, numbers),
            (Self::Level(how), Formula::Level) => level(how, numbers),
            _ => None,
        }
    }
}

/// What a right program computes: the exact numbers, rounded to floats.
fn right(formula: Formula, numbers: &[f64]) -> Option<Vec<f64>> {
    Some(formula.of(numbers)?.iter().map(|given| given.exact.to_f64()).collect())
}

fn length(vector: [f64; 3]) -> f64 {
    dot(vector, vector).sqrt()
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Mistakes about a point on the film, and w.
#[derive(Clone, Copy)]
pub(super) enum Project {
    /// x and y are multiplied by the distance of the film, and not divided.
    TimesFilm,
    AsItCame,
    /// x and y are divided by z, and not multiplied by the distance of the film.
    FilmForgotten,
    /// The point is returned as it came: nothing is projected.
    /// The divisor is the length of the way from the eye; w is z, as it should be.
    ByWay,
    /// The same, and w is that length too.
    ByWayAsW,
    /// The right place, with the w of a point that is not projected.
    WLost,
}

fn project(how: Project, numbers: &[f64]) -> Option<Vec<f64>> {
    let &[n, x, y, z] = numbers else { return None };
    let way = length([x, y, z]);
    let point = match how {
        Project::TimesFilm => [n * x, n * y, z],
        Project::AsItCame => [x, y, z],
        Project::FilmForgotten => [x / z, y / z, z],
        Project::ByWay => [n * x / way, n * y / way, z],
        Project::ByWayAsW => [n * x / way, n * y / way, way],
        Project::WLost => [n * x / z, n * y / z, 1.0],
    };
    Some(point.to_vec())
}

/// Mistakes about a place in the window, and the depth there.
#[derive(Clone, Copy)]
pub(super) enum Window {
    SizeLess1,
    YNotTurned,
    DepthNotHalved,
    LinearDepth,
    FilmAt1,
}

/// A place in the window, and the depth there.
fn window(how: Window, numbers: &[f64]) -> Option<Vec<f64>> {
    let &[mut width, mut height, n, f, mut x, mut y, z] = numbers else { return None };
    // Two of the mistakes change what the formula is computed from,
    match how {
        Window::SizeLess1 => {
            width -= 1.0;
            height -= 1.0;
        }
        Window::FilmAt1 => {
            x /= n;
            y /= n;
        }
        Window::YNotTurned | Window::DepthNotHalved | Window::LinearDepth => {}
    }
    let x_px = (n * x / z + 1.0) / 2.0 * width;
    let mut y_px = (1.0 - n * y / z) / 2.0 * height;
    let mut depth = (((f + n) * z - 2.0 * n * f) / (f - n) / z + 1.0) / 2.0;
    // and the other three change one number of the result.
    match how {
        Window::YNotTurned => y_px = height - y_px,
        Window::DepthNotHalved => depth = 2.0 * depth - 1.0,
        Window::LinearDepth => depth = (z - n) / (f - n),
        Window::SizeLess1 | Window::FilmAt1 => {}
    }
    Some(vec![x_px, y_px, depth])
}

/// Mistakes about the sign of an area.
#[derive(Clone, Copy)]
pub(super) enum Winding {
    YUp,
    /// The sign of the area before snapping, with a threshold below which an area counts as none.
    AsGiven(f64),
    /// The sign of the area of the snapped corners, with such a threshold.
    Snapped(f64),
    /// The area itself, with or without snapping, and in the square subpixels of the oracle.
    Area,
    AreaSnapped,
    AreaInSubpixels,
}

/// The sign of the area, or what is taken for it.
fn winding(how: Winding, numbers: &[f64]) -> Option<Vec<f64>> {
    let given = twice_area(numbers)?;
    let snapped: Vec<f64> = numbers.iter().map(|px| (px * 256.0).round() / 256.0).collect();
    let snapped = twice_area(&snapped)?;
    let number = match how {
        // Not the negative number, which is -0 where there is no area.
        Winding::YUp => 0.0 - right(Formula::Winding, numbers)?[0],
        Winding::AsGiven(threshold) => sign(given, threshold),
        Winding::Snapped(threshold) => sign(snapped, threshold),
        Winding::Area => given,
        Winding::AreaSnapped => snapped,
        Winding::AreaInSubpixels => snapped * 65536.0,
    };
    Some(vec![number])
}

fn twice_area(numbers: &[f64]) -> Option<f64> {
    let &[ax, ay, bx, by, cx, cy] = numbers else { return None };
    Some((bx - ax) * (cy - ay) - (by - ay) * (cx - ax))
}

/// 1, -1, or 0 for what is not larger than a threshold.
fn sign(area: f64, threshold: f64) -> f64 {
    if area.abs() > threshold { area.signum() } else { 0.0 }
}

/// Mistakes about a turn around a centre.
#[derive(Clone, Copy)]
pub(super) enum Turn {
    Back,
    AboutYBack,
    AboutOrigin,
    CentreBack,
    NotMovedBack,
}

fn turned_point(how: Turn, numbers: &[f64]) -> Option<Vec<f64>> {
    let axis = *numbers.first()?;
    let mut changed = numbers.to_vec();
    // A turn the other way is one whose sine has the other sign.
    if matches!(how, Turn::Back) || (matches!(how, Turn::AboutYBack) && axis == 1.0) {
        changed[2] *= -1.0;
    }
    // Without its centre the turn is one about the origin.
    for part in &mut changed[3..6] {
        match how {
            Turn::AboutOrigin => *part *= 0.0,
            Turn::CentreBack => *part *= -1.0,
            Turn::Back | Turn::AboutYBack | Turn::NotMovedBack => {}
        }
    }
    let mut point = right(Formula::Turn, &changed)?;
    if matches!(how, Turn::NotMovedBack) {
        for (part, centre) in point.iter_mut().zip(&numbers[3..]) {
            *part -= centre;
        }
    }
    Some(point)
}

type Rows = [[f64; 3]; 3];

/// Mistakes about which matrix takes a normal along. The right one is the inverse, transposed.
#[derive(Clone, Copy)]
pub(super) enum Normal {
    AsPoint,
    TransposedAlone,
    InvertedAlone,
}

/// A normal after the surface was moved.
fn normal(how: Normal, numbers: &[f64]) -> Option<Vec<f64>> {
    let &[a, b, c, normal] = numbers.as_chunks().0 else { return None };
    let [a, b, c] = match how {
        Normal::AsPoint => [a, b, c],
        Normal::TransposedAlone => transposed([a, b, c]),
        Normal::InvertedAlone => transposed(inverse_transposed([a, b, c])?),
    };
    Some(vec![dot(a, normal), dot(b, normal), dot(c, normal)])
}

fn transposed([a, b, c]: Rows) -> Rows {
    [[a[0], b[0], c[0]], [a[1], b[1], c[1]], [a[2], b[2], c[2]]]
}

/// The matrix for normals, by the right formula: it takes each axis to one of the columns.
fn inverse_transposed(rows: Rows) -> Option<Rows> {
    let mut columns = [[0.0; 3]; 3];
    for (axis, column) in columns.iter_mut().enumerate() {
        let mut normal = [0.0; 3];
        normal[axis] = 1.0;
        let asked = [rows.as_flattened(), &normal].concat();
        *column = right(Formula::Normal, &asked)?.try_into().ok()?;
    }
    Some(transposed(columns))
}

/// Mistakes about the cosine between normal and light.
#[derive(Clone, Copy)]
pub(super) enum Light {
    Dark,
    /// Dark, and cut only in the sum with the ambient light.
    DarkCut,
    LitBehind,
    LongNormal,
    LongNormalCut,
}

fn brightness(how: Light, numbers: &[f64]) -> Option<Vec<f64>> {
    let &[n0, n1, n2, l0, l1, l2, ambient, diffuse] = numbers else { return None };
    let normal = [n0, n1, n2];
    let product = dot(normal, [l0, l1, l2]);
    // A normal of length 0 has no direction, and its cosine counts as 0.
    let cosine = if length(normal) > 0.0 { product / length(normal) } else { 0.0 };
    Some(vec![match how {
        Light::Dark => ambient + diffuse * cosine,
        Light::DarkCut => (ambient + diffuse * cosine).max(0.0),
        Light::LitBehind => ambient + diffuse * cosine.abs(),
        Light::LongNormal => ambient + diffuse * product.max(0.0),
        Light::LongNormalCut => ambient + diffuse * product.clamp(0.0, 1.0),
    }])
}

/// Mistakes about where the texels of a row are.
#[derive(Clone, Copy)]
pub(super) enum Texel {
    /// A texel has its value at its left border.
    Corners,
    Clamped,
    Less1,
    Less1Corners,
}

/// What the nearest and the bilinear look-up read.
fn texels(how: Texel, numbers: &[f64]) -> Option<Vec<f64>> {
    let (&u, texels) = numbers.split_first()?;
    let count = texels.len() as f64;
    let place = match how {
        Texel::Less1 | Texel::Less1Corners => u * (count - 1.0),
        Texel::Corners | Texel::Clamped => u * count,
    };
    // How far from its left border a texel has its value.
    let middle = match how {
        Texel::Corners | Texel::Less1Corners => 0.0,
        Texel::Clamped | Texel::Less1 => 0.5,
    };
    // The bilinear look-up mixes the texel whose value lies at or to the left of the place with the next one.
    let left = (place - middle).floor();
    let share = place - middle - left;
    let [nearest, first, second] = [place.floor(), left, left + 1.0].map(|index| {
        texels[match how {
            Texel::Clamped => index.clamp(0.0, count - 1.0),
            _ => index.rem_euclid(count),
        } as usize]
    });
    Some(vec![nearest, first + (second - first) * share])
}

/// Mistakes about the level at which a texture is read: the logarithm to the base 2 of the longer step in texels.
#[derive(Clone, Copy)]
pub(super) enum Level {
    InWindow,
    AcrossAlone,
    DownAlone,
    Shorter,
    Sum,
    NaturalLogarithm,
    NoLogarithm,
    SizeForgotten,
    Floor,
    Round,
    NotBelow0,
}

fn level(how: Level, numbers: &[f64]) -> Option<Vec<f64>> {
    let mut changed = numbers.to_vec();
    match how {
        // Without w, u and v change evenly in the window.
        Level::InWindow => [4, 9, 14].into_iter().for_each(|w| changed[w] = 1.0),
        // The step is then a part of the texture.
        Level::SizeForgotten => changed[..2].fill(1.0),
        _ => {}
    }
    // The right level of what is now asked, and the steps of what the program was asked.
    let exact = right(Formula::Level, &changed)?;
    let [across, down] = steps(numbers)?;
    Some(match how {
        Level::InWindow | Level::SizeForgotten => exact,
        Level::AcrossAlone => level_of(across)?,
        Level::DownAlone => level_of(down)?,
        Level::Shorter => level_of(across.min(down))?,
        Level::Sum => level_of(across + down)?,
        Level::NaturalLogarithm => vec![libm::log(across.max(down))],
        Level::NoLogarithm => vec![across.max(down)],
        Level::Floor => vec![exact[0].floor()],
        Level::Round => vec![exact[0].round()],
        Level::NotBelow0 => vec![exact[0].max(0.0)],
    })
}

/// The level of a step in texels; nothing of one that has no length.
fn level_of(step: f64) -> Option<Vec<f64>> {
    (step > 0.0).then(|| vec![libm::log2(step)])
}

/// How many texels the place in the texture moves by a pixel to the right, and by a pixel downwards.
fn steps(numbers: &[f64]) -> Option<[f64; 2]> {
    let &[width, height, ref corners @ .., x, y] = numbers else { return None };
    let corners: [[f64; 5]; 3] = corners.as_chunks().0.try_into().ok()?;
    // 1/w, u/w and v/w are linear in the window,
    let q = plane(&corners, corners.map(|[_, _, w, _, _]| 1.0 / w), [x, y]);
    let u = plane(&corners, corners.map(|[_, _, w, u, _]| u / w), [x, y]);
    let v = plane(&corners, corners.map(|[_, _, w, _, v]| v / w), [x, y]);
    // and u and v are their quotients.
    let by_x = [quotient_slope(u, q, u.by_x, q.by_x), quotient_slope(v, q, v.by_x, q.by_x)];
    let by_y = [quotient_slope(u, q, u.by_y, q.by_y), quotient_slope(v, q, v.by_y, q.by_y)];
    Some([by_x, by_y].map(|[u, v]| length([u * width, v * height, 0.0])))
}

/// A function that is linear in the window: its value at a place, and how much it grows by a pixel in x and in y.
#[derive(Clone, Copy)]
struct Plane {
    value: f64,
    by_x: f64,
    by_y: f64,
}

/// The plane through the values at three corners.
fn plane([a, b, c]: &[[f64; 5]; 3], values: [f64; 3], [x, y]: [f64; 2]) -> Plane {
    let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    let [to_b, to_c] = [values[1] - values[0], values[2] - values[0]];
    let by_x = (to_b * (c[1] - a[1]) - to_c * (b[1] - a[1])) / area;
    let by_y = (to_c * (b[0] - a[0]) - to_b * (c[0] - a[0])) / area;
    Plane { value: values[0] + by_x * (x - a[0]) + by_y * (y - a[1]), by_x, by_y }
}

/// How much over / q grows in the direction in which the two grow by these slopes: the quotient rule.
fn quotient_slope(over: Plane, q: Plane, over_slope: f64, q_slope: f64) -> f64 {
    (over_slope - over.value / q.value * q_slope) / q.value
}
