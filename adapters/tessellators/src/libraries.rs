//! The libraries, each with what its documentation says about polygons that it takes.

use std::cell::RefCell;
use std::collections::HashMap;
use std::fmt::Display;

use rasterproof_verify::partition::{Coordinates, Family, Point, Polygon, Refused, Triangle};

use crate::Library;

/// An outline with holes: what most interfaces take.
const NO_ISLANDS: &[Family] = &[Family::Islands];

const fn library(
    name: &'static str,
    version: &'static str,
    coordinates: Coordinates,
    left_out: &'static [Family],
    accepts: fn(&Polygon) -> bool,
    triangles: fn(&Polygon) -> Result<Vec<Triangle>, Refused>,
) -> Library {
    Library { name, version, coordinates, left_out, accepts, triangles }
}

pub const ALL: &[Library] = &[
    library("lyon_tessellation", "1.0.23", Coordinates::F32, &[], has_f32_range, lyon),
    library("earcutr", "0.5.0", Coordinates::F64, NO_ISLANDS, has_range, earcutr),
    library("earcut", "0.4.12", Coordinates::F64, NO_ISLANDS, has_range, earcut),
    library(
        "earcut-i32",
        "0.4.12",
        Coordinates::Integer,
        NO_ISLANDS,
        within_2_to_the_19,
        earcut_i32,
    ),
    library("i_triangle", "0.51.0", Coordinates::Integer, &[], any, i_triangle),
    library("spade", "2.15.1", Coordinates::F64, &[], has_range, spade),
    library("cdt", "0.1.0", Coordinates::F64, &[], is_free_of_touches, cdt),
    library("poly2tri-rs", "0.1.2", Coordinates::F64, NO_ISLANDS, is_free_of_touches, poly2tri),
    library("triangulate", "0.2.0", Coordinates::F64, &[], is_free_of_touches, triangulate),
    library("kika", "0.7.1", Coordinates::F64, NO_ISLANDS, is_free_of_touches, kika),
];

fn any(_: &Polygon) -> bool {
    true
}

/// Exact predicates in `f64` need exponents from -142 to 201, says their author, Shewchuk; documentation of spade repeats it.
fn has_range(polygon: &Polygon) -> bool {
    let (least, most) = (2_f64.powi(-142), 2_f64.powi(201));
    let mut values = polygon.contours.iter().flatten().flatten().map(|value| value.abs());
    values.all(|value| value == 0.0 || (least..=most).contains(&value))
}

/// Products of two coordinates, and of two differences of them, are normal numbers in `f32`.
fn has_f32_range(polygon: &Polygon) -> bool {
    let least = 2_f64.powi(-40);
    polygon.contours.iter().flatten().flatten().all(|value| *value == 0.0 || value.abs() >= least)
}

/// The largest coordinate that the documentation of `EarcutI32` allows.
fn within_2_to_the_19(polygon: &Polygon) -> bool {
    polygon.contours.iter().flatten().flatten().all(|value| value.abs() <= f64::from(1 << 19))
}

/// Whether all vertices are distinct and none lies on an edge that does not end in it.
fn is_free_of_touches(polygon: &Polygon) -> bool {
    if !has_range(polygon) {
        return false;
    }
    let mut points: Vec<Point> = polygon.contours.iter().flatten().copied().collect();
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    if points.windows(2).any(|pair| pair[0] == pair[1]) {
        return false;
    }
    polygon.contours.iter().all(|contour| {
        let next = contour.iter().cycle().skip(1);
        contour.iter().zip(next).all(|(&a, &b)| {
            let (left, right) = (a[0].min(b[0]), a[0].max(b[0]));
            let (low, high) = (a[1].min(b[1]), a[1].max(b[1]));
            let start = points.partition_point(|p| p[0] < left);
            let near = points[start..].iter().take_while(|p| p[0] <= right);
            let mut near = near.filter(|p| low <= p[1] && p[1] <= high && **p != a && **p != b);
            near.all(|p| {
                let [a, b, p] = [a, b, *p].map(|[x, y]| robust::Coord { x, y });
                robust::orient2d(a, b, p) != 0.0
            })
        })
    })
}

fn refused(error: impl Display) -> Refused {
    Refused(error.to_string())
}

/// All vertices in one list, and the numbers at which the holes begin.
fn flat(polygon: &Polygon) -> (Vec<Point>, Vec<usize>) {
    let mut starts = Vec::new();
    let mut points = Vec::new();
    for contour in &polygon.contours {
        starts.push(points.len());
        points.extend_from_slice(contour);
    }
    (points, starts.split_off(1))
}

fn by_index(points: &[Point], indices: impl IntoIterator<Item = usize>) -> Vec<Triangle> {
    let corners: Vec<Point> = indices.into_iter().map(|index| points[index]).collect();
    corners.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect()
}

fn lyon(polygon: &Polygon) -> Result<Vec<Triangle>, Refused> {
    use lyon_tessellation::geometry_builder::simple_builder;
    use lyon_tessellation::math::{Point, point};
    use lyon_tessellation::path::Path;
    use lyon_tessellation::{FillOptions, FillTessellator, VertexBuffers};
    thread_local! {
        static TESSELLATOR: RefCell<FillTessellator> = RefCell::new(FillTessellator::new());
    }
    let mut path = Path::builder();
    for contour in &polygon.contours {
        let mut points = contour.iter().map(|&[x, y]| point(x as f32, y as f32));
        path.begin(points.next().ok_or(Refused("an empty contour".to_owned()))?);
        points.for_each(|point| {
            path.line_to(point);
        });
        path.end(true);
    }
    let mut buffers: VertexBuffers<Point, u16> = VertexBuffers::new();
    // Even-odd is its default, and so is looking for intersections. The default tolerance, 0.1, allows it to move edges.
    let options = FillOptions::default().with_tolerance(f32::MIN_POSITIVE);
    let result = TESSELLATOR.with_borrow_mut(|tessellator| {
        tessellator.tessellate_path(&path.build(), &options, &mut simple_builder(&mut buffers))
    });
    if result.is_err() {
        TESSELLATOR.replace(FillTessellator::new());
    }
    result.map_err(refused)?;
    let points: Vec<_> =
        buffers.vertices.iter().map(|p| [f64::from(p.x), f64::from(p.y)]).collect();
    Ok(by_index(&points, buffers.indices.iter().map(|&i| i as usize)))
}

fn earcutr(polygon: &Polygon) -> Result<Vec<Triangle>, Refused> {
    let (points, holes) = flat(polygon);
    let indices = ::earcutr::earcut(points.as_flattened(), &holes, 2);
    let indices = indices.map_err(|error| Refused(format!("{error:?}")))?;
    Ok(by_index(&points, indices))
}

fn earcut(polygon: &Polygon) -> Result<Vec<Triangle>, Refused> {
    let (points, holes) = flat(polygon);
    let holes: Vec<u32> = holes.into_iter().map(|start| start as u32).collect();
    let mut indices: Vec<u32> = Vec::new();
    ::earcut::Earcut::new().earcut_slice(&points, &holes, &mut indices);
    Ok(by_index(&points, indices.into_iter().map(|i| i as usize)))
}

fn earcut_i32(polygon: &Polygon) -> Result<Vec<Triangle>, Refused> {
    let (points, holes) = flat(polygon);
    let whole: Vec<[i32; 2]> = points.iter().map(|p| p.map(|value| value as i32)).collect();
    let holes: Vec<u32> = holes.into_iter().map(|start| start as u32).collect();
    let mut indices: Vec<u32> = Vec::new();
    ::earcut::int::EarcutI32::new().earcut_slice(&whole, &holes, &mut indices);
    Ok(by_index(&points, indices.into_iter().map(|i| i as usize)))
}

fn i_triangle(polygon: &Polygon) -> Result<Vec<Triangle>, Refused> {
    use ::i_triangle::i_overlay::core::fill_rule::FillRule;
    use ::i_triangle::i_overlay::core::overlay::IntOverlayOptions;
    use ::i_triangle::i_overlay::i_float::int::point::IntPoint;
    use ::i_triangle::int::custom::IntCustomTriangulatable as _;
    use ::i_triangle::int::validation::Validation;
    let point = |&[x, y]: &Point| IntPoint::new(x as i32, y as i32);
    let shape: Vec<Vec<_>> =
        polygon.contours.iter().map(|contour| contour.iter().map(point).collect()).collect();
    // By default, vertices on straight edges are removed.
    let options = IntOverlayOptions::keep_all_points();
    let validation = Validation { fill_rule: FillRule::EvenOdd, options };
    let made = shape.custom_triangulate(validation).into_triangulation::<u32>();
    let points: Vec<_> = made.points.iter().map(|p| [f64::from(p.x), f64::from(p.y)]).collect();
    Ok(by_index(&points, made.indices.iter().map(|&i| i as usize)))
}

/// Spade triangulates the convex hull; here the faces inside by the even-odd rule are kept.
fn spade(polygon: &Polygon) -> Result<Vec<Triangle>, Refused> {
    use ::spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation as _};
    let mut mesh = ConstrainedDelaunayTriangulation::<Point2<f64>>::new();
    let mut runs: Vec<usize> = Vec::new();
    let mut contours = Vec::new();
    for contour in &polygon.contours {
        let vertices = contour.iter().map(|&[x, y]| mesh.insert(Point2::new(x, y)));
        contours.push(vertices.collect::<Result<Vec<_>, _>>().map_err(refused)?);
    }
    for vertices in contours {
        for (i, &from) in vertices.iter().enumerate() {
            let to = vertices[(i + 1) % vertices.len()];
            let edges = if from == to { Vec::new() } else { mesh.try_add_constraint(from, to) };
            if from != to && edges.is_empty() {
                return Err(Refused("an edge crosses another".to_owned()));
            }
            for edge in edges {
                let edge = mesh.directed_edge(edge).as_undirected().fix().index();
                runs.resize(runs.len().max(edge + 1), 0);
                runs[edge] += 1;
            }
        }
    }
    let mut is_inside: Vec<Option<bool>> = vec![None; mesh.num_all_faces()];
    is_inside[mesh.outer_face().fix().index()] = Some(false);
    let outside = mesh.directed_edges().filter(|edge| edge.face() == mesh.outer_face());
    let mut open: Vec<_> = outside.collect();
    while let Some(edge) = open.pop() {
        let (here, beyond) = (edge.face().fix().index(), edge.rev().face());
        let crossed = runs.get(edge.as_undirected().fix().index()).is_some_and(|n| n % 2 == 1);
        if is_inside[beyond.fix().index()].is_none() {
            is_inside[beyond.fix().index()] = is_inside[here].map(|inside| inside != crossed);
            open.extend(beyond.as_inner().into_iter().flat_map(|face| face.adjacent_edges()));
        }
    }
    let inside = mesh.inner_faces().filter(|face| is_inside[face.fix().index()] == Some(true));
    Ok(inside.map(|face| face.positions().map(|p| [p.x, p.y])).collect())
}

fn cdt(polygon: &Polygon) -> Result<Vec<Triangle>, Refused> {
    // Equal points have one number.
    let mut numbers: HashMap<[u64; 2], usize> = HashMap::new();
    let mut points = Vec::new();
    let mut contours = Vec::new();
    for contour in &polygon.contours {
        let mut indices: Vec<usize> = Vec::new();
        for &point in contour {
            let number = *numbers.entry(point.map(|v| (v + 0.0).to_bits())).or_insert_with(|| {
                points.push((point[0], point[1]));
                points.len() - 1
            });
            if indices.last() != Some(&number) {
                indices.push(number);
            }
        }
        if indices.first() != indices.last() {
            indices.push(indices[0]);
        }
        contours.push(indices);
    }
    let triangles = ::cdt::triangulate_contours(&points, &contours).map_err(refused)?;
    let point = |i: usize| [points[i].0, points[i].1];
    Ok(triangles.into_iter().map(|(a, b, c)| [point(a), point(b), point(c)]).collect())
}

fn poly2tri(polygon: &Polygon) -> Result<Vec<Triangle>, Refused> {
    use poly2tri_rs::{Point, SweeperBuilder};
    let line = |contour: &Vec<[f64; 2]>| contour.iter().map(|&[x, y]| Point::new(x, y)).collect();
    let mut contours = polygon.contours.iter().map(line);
    let outline = contours.next().ok_or(Refused("no contour".to_owned()))?;
    let triangles = SweeperBuilder::new(outline).add_holes(contours).build().triangulate();
    Ok(triangles.map(|triangle| triangle.points.map(|p| [p.x, p.y])).collect())
}

fn triangulate(polygon: &Polygon) -> Result<Vec<Triangle>, Refused> {
    use ::triangulate::{ListFormat as _, PolygonList as _, formats};
    let mut indices: Vec<[usize; 2]> = Vec::new();
    let format = formats::IndexedListFormat::new(&mut indices).into_fan_format();
    let result = polygon.contours.triangulate(format).map(|_| ());
    // The first line; what follows is a backtrace.
    let first = |text: String| text.lines().next().unwrap_or("").to_owned();
    result.map_err(|error| Refused(first(error.to_string())))?;
    let corners: Vec<Point> = indices.iter().map(|&[c, i]| polygon.contours[c][i]).collect();
    Ok(corners.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect())
}

fn kika(polygon: &Polygon) -> Result<Vec<Triangle>, Refused> {
    use ::kika::{Point2, Polygon2, triangulate_polygon_with_holes};
    let contour = |contour: &Vec<Point>| -> Result<Polygon2, Refused> {
        let points = contour.iter().map(|&[x, y]| Point2::new(x, y));
        let points = points.collect::<Result<Vec<_>, _>>();
        Ok(Polygon2::new(points.map_err(|error| Refused(format!("{error:?}")))?))
    };
    let contours = polygon.contours.iter().map(contour).collect::<Result<Vec<_>, _>>()?;
    let (outline, holes) = contours.split_first().ok_or(Refused("no contour".to_owned()))?;
    let made = triangulate_polygon_with_holes(outline, holes);
    let made = made.map_err(|error| Refused(format!("{error:?}")))?;
    let point = |p: Point2| [p.x(), p.y()];
    Ok(made.triangles().iter().map(|t| [t.a(), t.b(), t.c()].map(point)).collect())
}
