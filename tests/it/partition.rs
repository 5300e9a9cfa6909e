//! Partitions of a second source: what spade makes of the generated polygons has no fault, and has one when anything is changed.

use std::collections::VecDeque;

use rasterproof::assert_partition;
use rasterproof::partition::{
    Coordinates, Family, FaultKind, Options, Polygon, Triangle, Winding, judge_partition,
    judge_partitions,
};
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation as _};

use crate::fixtures::fixtures;
use crate::pages::read;

/// The triangles inside by the even-odd rule, of a triangulation that has all edges of the contours.
fn spade(polygon: &Polygon) -> Vec<Triangle> {
    let mut mesh = ConstrainedDelaunayTriangulation::<Point2<f64>>::new();
    // How often contours run along each edge, in either direction.
    let mut runs: Vec<usize> = Vec::new();
    let mut contours = Vec::new();
    for contour in &polygon.contours {
        let insert = |&[x, y]: &[f64; 2]| mesh.insert(Point2::new(x, y)).unwrap();
        contours.push(contour.iter().map(insert).collect::<Vec<_>>());
    }
    for contour in contours {
        for (i, &from) in contour.iter().enumerate() {
            let to = contour[(i + 1) % contour.len()];
            if from != to {
                for edge in mesh.try_add_constraint(from, to) {
                    let edge = mesh.directed_edge(edge).as_undirected().fix().index();
                    runs.resize(runs.len().max(edge + 1), 0);
                    runs[edge] += 1;
                }
            }
        }
    }
    let mut is_inside: Vec<Option<bool>> = vec![None; mesh.num_all_faces()];
    is_inside[mesh.outer_face().fix().index()] = Some(false);
    let mut open: VecDeque<_> =
        mesh.directed_edges().filter(|edge| edge.face() == mesh.outer_face()).collect();
    while let Some(edge) = open.pop_front() {
        let (here, beyond) = (edge.face().fix().index(), edge.rev().face());
        let crossed = runs.get(edge.as_undirected().fix().index()).is_some_and(|n| n % 2 == 1);
        if is_inside[beyond.fix().index()].is_none() {
            is_inside[beyond.fix().index()] = is_inside[here].map(|inside| inside != crossed);
            open.extend(beyond.as_inner().into_iter().flat_map(|face| face.adjacent_edges()));
        }
    }
    let inside = mesh.inner_faces().filter(|face| is_inside[face.fix().index()] == Some(true));
    inside.map(|face| face.positions().map(|corner| [corner.x, corner.y])).collect()
}

/// The same where vertices on straight edges go, so that edges become longer.
fn without_straight_vertices(polygon: &Polygon) -> Vec<Triangle> {
    let turns = |[a, b, c]: [[f64; 2]; 3]| {
        let value = (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0]);
        value != 0.0
    };
    let kept = |c: &Vec<[f64; 2]>| {
        let n = c.len();
        let is_kept = |i: &usize| turns([c[(i + n - 1) % n], c[*i], c[(i + 1) % n]]);
        (0..n).filter(is_kept).map(|i| c[i]).collect()
    };
    spade(&Polygon::new(polygon.contours.iter().map(kept).collect()))
}

/// 11,040 polygons, of whose triangulations none is blamed. Spade refuses coordinates below 2^-142, so they are whole.
#[test]
fn partitions_of_spade_are_right() {
    assert_partition!(spade, Options::default().cases(920).coordinates(Coordinates::Integer));
}

/// The same triangulations, one triangle of each left out, doubled, flipped, or moved by an ulp at a corner.
#[test]
fn partitions_of_spade_are_wrong_once_changed() {
    let options = Options::default();
    let mut planted = 0;
    for family in Family::ALL {
        for index in 0..100 {
            let polygon = family.polygon(3, index, Coordinates::Integer);
            let triangles = spade(&polygon);
            let number = index as usize * 7 % triangles.len();
            let [a, b, c] = triangles[number];
            let with = |changed: &[Triangle]| {
                let mut triangles = triangles.clone();
                triangles.splice(number..=number, changed.iter().copied());
                let faults = judge_partition(&polygon, &triangles, &options).unwrap().faults;
                faults.into_iter().map(|fault| fault.kind).collect::<Vec<_>>()
            };
            let name = family.name();
            assert!(with(&[]).contains(&FaultKind::Gap), "{name} {index}");
            assert!(with(&[[a, b, c], [b, c, a]]).contains(&FaultKind::Overlap), "{name} {index}");
            if triangles.len() > 2 {
                assert_eq!(with(&[[a, c, b]]), [FaultKind::Flipped], "{name} {index}");
            }
            assert!(!with(&[[a, b, [c[0].next_up(), c[1]]]]).is_empty(), "{name} {index}");
            planted += 4;
        }
    }
    assert_eq!(planted, 4 * 1_200);
}

/// What a triangulation that has no fault covers is the area that the file of fixtures states.
#[test]
fn partition_fixtures_have_the_area_of_triangles() {
    let area = |corners: Triangle| {
        let [[ax, ay], [bx, by], [cx, cy]] = corners.map(|corner| corner.map(|v| v as i64));
        ((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)).abs()
    };
    for fixture in fixtures().polygons {
        let points = |contour: &Vec<[i32; 2]>| {
            contour.iter().map(|point| point.map(f64::from)).collect::<Vec<_>>()
        };
        let polygon = Polygon::new(fixture.contours.iter().map(points).collect());
        let triangles = spade(&polygon);
        judge_partition(&polygon, &triangles, &Options::default()).unwrap().check().unwrap();
        let sum: i64 = triangles.into_iter().map(area).sum();
        assert_eq!(sum, fixture.twice_area, "{fixture:?}");
    }
}

/// The first line says what is wrong. Each polygon counts by its gravest fault, and one that is covered exactly once is not said
/// to be otherwise.
#[test]
fn what_is_wrong_with_polygons_is_said() {
    let options =
        Options::default().cases(60).coordinates(Coordinates::Integer).family(Family::Collinear);
    let said = |make: &(dyn Fn(&Polygon) -> Vec<Triangle> + Sync), options: &Options| {
        let message = judge_partitions(&make, options).unwrap().check().unwrap_err().to_string();
        message.lines().next().unwrap().to_owned()
    };
    let junctions = said(&without_straight_vertices, &options);
    let (count, what) = junctions.split_once(" of 60 polygons ").unwrap();
    let count: u64 = count.parse().unwrap();
    assert_eq!(what, "have T-junctions, and all are covered exactly once");
    let turned = said(&spade, &options.clone().winding(Winding::Clockwise));
    let turns = "have triangles that turn the other way, and all are covered exactly once";
    assert_eq!(turned, format!("60 of 60 polygons {turns}"));
    let some_lost = |polygon: &Polygon| {
        let mut all = without_straight_vertices(polygon);
        if polygon.contours[0].len().is_multiple_of(2) {
            all.pop();
        }
        all
    };
    let both = said(&some_lost, &options);
    let (lost, rest) = both.split_once(" of 60 polygons are not covered exactly once, ").unwrap();
    let lost: u64 = lost.parse().unwrap();
    let more: u64 = rest.strip_suffix(" more have T-junctions").unwrap().parse().unwrap();
    assert!(lost > 0 && more > 0 && lost + more >= count && more <= count, "{both}");
}

/// A triangulation that leaves out the second contour covers the hole, and the report says so and where.
#[test]
fn partition_with_a_filled_hole_is_reported() {
    let fills = |polygon: &Polygon| spade(&Polygon::new(polygon.contours[..1].to_vec()));
    let options =
        Options::default().cases(100).family(Family::Touching).coordinates(Coordinates::Integer);
    let report = judge_partitions(&fills, &options).unwrap();
    let message = report.check().unwrap_err().to_string();
    assert!(
        report.failures.iter().any(|failure| failure.evidence.kind == FaultKind::Outside),
        "{message}"
    );
    for part in ["outside", "vec![vec![[", "family(Family::Touching)", "Coordinates::Integer"] {
        assert!(message.contains(part), "{part}: {message}");
    }
}

/// Wrong tessellators and what is said of each; one whose mistake nobody knows gets none.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn mistakes_of_tessellators_are_named() {
    type Make<'a> = &'a (dyn Fn(&Polygon) -> Vec<Triangle> + Sync);
    let first = |polygon: &Polygon| spade(&Polygon::new(polygon.contours[..1].to_vec()));
    let each = |polygon: &Polygon| -> Vec<Triangle> {
        let alone = |contour: &Vec<_>| spade(&Polygon::new(vec![contour.clone()]));
        polygon.contours.iter().flat_map(alone).collect()
    };
    let fan = |polygon: &Polygon| -> Vec<Triangle> {
        let fan =
            |c: &Vec<[f64; 2]>| (2..c.len()).map(|i| [c[0], c[i - 1], c[i]]).collect::<Vec<_>>();
        polygon.contours.iter().flat_map(fan).collect()
    };
    let hull = |polygon: &Polygon| -> Vec<Triangle> {
        let mut mesh = ConstrainedDelaunayTriangulation::<Point2<f64>>::new();
        for &[x, y] in polygon.contours.iter().flatten() {
            mesh.insert(Point2::new(x, y)).unwrap();
        }
        let corners = |corner: Point2<f64>| [corner.x, corner.y];
        mesh.inner_faces().map(|face| face.positions().map(corners)).collect()
    };
    let holes_lost = |polygon: &Polygon| {
        if polygon.contours.len() > 1 { Vec::new() } else { spade(polygon) }
    };
    let rounds = |polygon: &Polygon| {
        let round = |p: &[f64; 2]| p.map(|v| (v / 16.0).round() * 16.0);
        let contours = polygon.contours.iter().map(|c| c.iter().map(round).collect());
        spade(&Polygon::new(contours.collect()))
    };
    let last_lost = |polygon: &Polygon| {
        let mut all = spade(polygon);
        all.pop();
        all
    };
    let is_clockwise = |polygon: &Polygon| {
        let (c, cross) =
            (&polygon.contours[0], |a: [f64; 2], b: [f64; 2]| a[0] * b[1] - a[1] * b[0]);
        (0..c.len()).map(|i| cross(c[i], c[(i + 1) % c.len()])).sum::<f64>() < 0.0
    };
    // Fills what contours run around counterclockwise.
    let positive = |polygon: &Polygon| {
        if is_clockwise(polygon) { Vec::new() } else { spade(polygon) }
    };
    let wound_as_given = |polygon: &Polygon| {
        let turn = |[a, b, c]: Triangle| if is_clockwise(polygon) { [a, c, b] } else { [a, b, c] };
        spade(polygon).into_iter().map(turn).collect()
    };
    let options = Options::default().cases(60).coordinates(Coordinates::Integer);
    let left = options.clone().winding(Winding::Counterclockwise);
    let wound = options.clone().winding(Winding::Clockwise);
    let straight = options.clone().family(Family::Collinear);
    let one_way = "probable cause: It depends on the direction of the contours: where the first one runs clockwise";
    let all: [(Make<'_>, &Options, &str); 11] = [
        (&positive, &options, one_way),
        (&wound_as_given, &left, one_way),
        (&first, &options, "probable cause: It fills the first contour and ignores the others"),
        (&each, &options, "probable cause: It fills every contour by itself"),
        (&fan, &options, "probable cause: It draws a fan around the first vertex"),
        (&hull, &options, "probable cause: It fills the convex hull"),
        (
            &holes_lost,
            &options,
            "probable cause: It makes no triangles of polygons of more than one contour",
        ),
        (&spade, &wound, "probable cause: It winds all triangles the other way"),
        (
            &without_straight_vertices,
            &straight,
            "probable cause: It leaves out vertices on straight edges",
        ),
        (&rounds, &options, "no cause was recognised: "),
        (&last_lost, &options, "no cause was recognised: "),
    ];
    for (make, options, said) in all {
        let report = judge_partitions(&make, options).unwrap();
        assert!(report.check().is_err(), "{said}");
        let message = report.check().unwrap_err().to_string();
        assert!(message.replace("\n  ", " ").contains(said), "{said}: {message}");
    }
    assert!(judge_partitions(&spade, &options).unwrap().cause.is_none());
}

/// Rows of the pages are the sums of what the adapters counted.
#[test]
fn pages_show_what_tessellators_of_others_did() {
    let names = "cdt earcut earcut-i32 earcutr i_triangle kika lyon_tessellation poly2tri-rs spade triangulate";
    for name in names.split(' ') {
        let text = read(format!("adapters/tessellators/results/{name}.csv"));
        let head: Vec<_> = text.lines().next().unwrap().split(',').collect();
        let sum = |meant: &str| -> String {
            let is_meant = |(column, _): &(&&str, &str)| **column == meant;
            let cells = text.lines().skip(1).flat_map(|line| head.iter().zip(line.split(',')));
            let counts = cells.filter(is_meant).map(|(_, cell)| cell.split(' ').next().unwrap());
            counts.map(|count| count.parse::<u64>().unwrap()).sum::<u64>().to_string()
        };
        let cells = ["judged", "left out", "wrong cover", "T-junction", "degenerate"].map(sum);
        let (start, end) = (format!("| {name} "), format!(" | {} |", cells.join(" | ")));
        for page in ["docs/tessellators.md", "docs/zh/tessellators.md"] {
            let page = read(page).replace(',', "");
            let is_row = |line: &str| line.starts_with(&start) && line.ends_with(&end);
            assert!(page.lines().any(is_row), "{start}...{end}");
        }
    }
}
