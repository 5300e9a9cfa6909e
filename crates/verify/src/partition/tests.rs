//! Partitions that are right by construction, faults planted in them, and cases by hand.

use std::sync::atomic::{AtomicUsize, Ordering};

use super::exact::orientation;
use super::families::star;
use super::*;
use crate::cases::unsnapped::nudge_f64;
use rasterproof_core::random::Rng;

fn square(low: f64, high: f64) -> Vec<Point> {
    vec![[low, low], [high, low], [high, high], [low, high]]
}

fn kinds(polygon: &Polygon, triangles: &[Triangle], options: &Options) -> Vec<FaultKind> {
    let finding = judge_partition(polygon, triangles, options).unwrap();
    let mut kinds: Vec<_> = finding.faults.iter().map(|fault| fault.kind).collect();
    kinds.sort();
    kinds.dedup();
    kinds
}

/// The triangles of a square, and each thing that can be wrong with them.
#[test]
fn a_square_by_hand() {
    let polygon = Polygon::new(vec![square(0.0, 4.0)]);
    let [a, b, c, d] = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
    let (middle, side) = ([2.0, 2.0], [2.0, 0.0]);
    let strict = Options::default();
    let judge = |triangles: &[Triangle]| kinds(&polygon, triangles, &strict);
    assert_eq!(judge(&[[a, b, c], [a, c, d]]), []);
    assert_eq!(judge(&[[b, a, c], [c, a, d]]), []);
    assert_eq!(judge(&[[a, b, middle], [b, c, middle], [c, d, middle], [d, a, middle]]), []);
    assert_eq!(judge(&[[a, b, c], [a, d, c], [a, d, c]]), [FaultKind::Overlap, FaultKind::Flipped]);
    assert_eq!(judge(&[[a, b, c]]), [FaultKind::Gap]);
    assert_eq!(judge(&[]), [FaultKind::Gap]);
    assert_eq!(judge(&[[a, b, c], [a, c, [0.0, 5.0]]]), [FaultKind::Outside, FaultKind::TJunction]);
    assert_eq!(
        judge(&[[a, b, c], [a, c, [f64::NAN, 4.0]]]),
        [FaultKind::NotFinite, FaultKind::Gap]
    );
    // A corner on the side, which a neighbour of the square does not have; and one on the diagonal.
    let split_side = [[a, side, c], [side, b, c], [a, c, d]];
    assert_eq!(judge(&split_side), [FaultKind::TJunction]);
    assert_eq!(judge(&[[a, b, middle], [b, c, middle], [a, c, d]]), [FaultKind::TJunction]);
    assert_eq!(kinds(&polygon, &split_side, &Options::default().allow_t_junctions()), []);
    // A triangle without area closes the slit.
    let closed = [[a, b, middle], [b, c, middle], [a, c, d], [a, middle, c]];
    assert_eq!(judge(&closed), [FaultKind::Degenerate]);
    let allowing = Options::default().allow_degenerate_triangles();
    assert_eq!(kinds(&polygon, &closed, &allowing), []);
    let finding = judge_partition(&polygon, &closed, &allowing).unwrap();
    assert_eq!((finding.added_points, finding.allowed.len()), (1, 1));
    // A vertex on the side is one of the partition.
    let mut with_vertex = polygon.clone();
    with_vertex.contours[0].insert(1, side);
    assert_eq!(kinds(&with_vertex, &[[a, b, c], [a, c, d]], &strict), [FaultKind::TJunction]);
    assert_eq!(kinds(&with_vertex, &split_side, &strict), []);
}

#[test]
fn windings_are_declared() {
    let polygon = Polygon::new(vec![square(0.0, 4.0)]);
    let [a, b, c, d] = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
    let faults = |winding: Winding, triangles: [Triangle; 2]| {
        kinds(&polygon, &triangles, &Options::default().winding(winding)).len()
    };
    let (left, right, mixed) =
        ([[a, b, c], [a, c, d]], [[a, c, b], [a, d, c]], [[a, b, c], [a, d, c]]);
    for (winding, expected) in [
        (Winding::Alike, [0, 0, 1]),
        (Winding::Counterclockwise, [0, 1, 1]),
        (Winding::Clockwise, [1, 0, 1]),
        (Winding::Any, [0, 0, 0]),
    ] {
        assert_eq!([left, right, mixed].map(|triangles| faults(winding, triangles)), expected);
    }
}

/// What the region is: holes in either direction, contours that run twice, spikes, an edge that two holes share.
#[test]
fn regions_by_hand() {
    let area = |contours: Vec<Vec<Point>>, rule: FillRule| -> f64 {
        let edges = region::region(&Polygon::new(contours), rule).unwrap().boundary;
        edges.iter().map(|[a, b]| a[0] * b[1] - a[1] * b[0]).sum::<f64>() / 2.0
    };
    let (outer, inner) = (square(0.0, 6.0), square(2.0, 4.0));
    let reversed = |contour: &[Point]| contour.iter().rev().copied().collect::<Vec<_>>();
    for rule in [FillRule::EvenOdd, FillRule::NonZero] {
        assert_eq!(area(vec![outer.clone(), reversed(&inner)], rule), 32.0);
        assert_eq!(area(vec![reversed(&outer)], rule), 36.0);
        // Two squares that meet at a vertex, as one contour that turns left in one and right in the other.
        let there = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [4.0, 2.0]];
        let back = [[4.0, 4.0], [2.0, 4.0], [2.0, 2.0], [0.0, 2.0]];
        let eight = [there, back].concat();
        assert_eq!(area(vec![eight], rule), 8.0);
        let bow = vec![[0.0, 0.0], [1.0, 1.0], [2.0, 2.0], [2.0, 0.0], [1.0, 1.0], [0.0, 2.0]];
        assert_eq!(area(vec![bow], rule), 2.0);
        let inwards = [[0.0, 0.0], [6.0, 0.0], [6.0, 6.0], [3.0, 3.0], [6.0, 6.0]];
        let outwards = [[0.0, 6.0], [0.0, 9.0], [0.0, 6.0]];
        let spiked = [&inwards[..], &outwards].concat();
        assert_eq!(area(vec![spiked], rule), 36.0);
        let halves = [
            vec![[2.0, 2.0], [2.0, 4.0], [3.0, 4.0], [3.0, 2.0]],
            vec![[3.0, 2.0], [3.0, 4.0], [4.0, 4.0], [4.0, 2.0]],
        ];
        assert_eq!(area(vec![outer.clone(), halves[0].clone(), halves[1].clone()], rule), 32.0);
        assert_eq!(
            area(vec![vec![[0.0, 0.0], [1.0, 1.0]], vec![[5.0, 5.0]], Vec::new()], rule),
            0.0
        );
    }
    assert_eq!(area(vec![outer.clone(), inner.clone()], FillRule::EvenOdd), 32.0);
    assert_eq!(area(vec![outer.clone(), inner], FillRule::NonZero), 36.0);
    assert_eq!(area(vec![outer.clone(), outer.clone()], FillRule::EvenOdd), 0.0);
    assert_eq!(area(vec![outer.clone(), outer], FillRule::NonZero), 36.0);
}

#[test]
fn polygons_that_are_not_valid() {
    let judge = |contour: Vec<Point>| {
        judge_partition(&Polygon::new(vec![contour]), &[], &Options::default()).unwrap_err()
    };
    let bow = judge(vec![[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 2.0]]);
    assert!(matches!(bow, InvalidPolygon::Crossing(_)), "{bow:?}");
    assert!(bow.to_string().contains("cross"), "{bow}");
    let infinite = judge(vec![[0.0, 0.0], [f64::INFINITY, 2.0], [2.0, 0.0]]);
    assert!(matches!(infinite, InvalidPolygon::NotFinite(_)), "{infinite:?}");
}

/// A polygon with triangles that cover it once.
struct Right {
    polygon: Polygon,
    triangles: Vec<Triangle>,
    /// A triangle that would fill a hole or a notch.
    removed: Option<Triangle>,
}

/// Closed walks along directed edges, of which as many arrive at each point as leave it.
fn walks(mut edges: Vec<[Point; 2]>) -> Vec<Vec<Point>> {
    let mut contours = Vec::new();
    while let Some(edge) = edges.pop() {
        let mut contour = vec![edge[0]];
        let mut at = edge[1];
        while at != edge[0] {
            contour.push(at);
            let next = edges.iter().position(|edge| edge[0] == at).expect("walks are closed");
            at = edges.swap_remove(next)[1];
        }
        contours.push(contour);
    }
    contours
}

/// A large triangle that is cut again and again, at points inside triangles and on edges; then some are removed.
fn cut_triangle(rng: &mut Rng) -> Right {
    let mut triangles: Vec<Triangle> = vec![[[0.0, 0.0], [1_048_576.0, 0.0], [0.0, 1_048_576.0]]];
    let middle = |a: Point, b: Point| [0, 1].map(|axis| (a[axis] + b[axis]) / 2.0);
    for _ in 0..rng.int(2, 24) {
        let number = rng.int(0, triangles.len() as i64 - 1) as usize;
        let [a, b, c] = triangles[number];
        if rng.chance(2) {
            // Any whole point that is inside.
            let weights = [0; 3].map(|_| rng.unit() + 0.01);
            let sum: f64 = weights.iter().sum();
            let inner = [0, 1].map(|axis| {
                ((a[axis] * weights[0] + b[axis] * weights[1] + c[axis] * weights[2]) / sum).round()
            });
            let is_inside =
                [[a, b], [b, c], [c, a]].iter().all(|&[a, b]| orientation(a, b, inner).is_gt());
            if is_inside {
                triangles.swap_remove(number);
                triangles.extend([[a, b, inner], [b, c, inner], [c, a, inner]]);
            }
        } else {
            // The middle of an edge, in both triangles that have it.
            let cut = middle(a, b);
            let is_on = orientation(a, b, cut).is_eq() && cut != a && cut != b;
            let with_it: Vec<usize> = (0..triangles.len())
                .filter(|&i| [a, b].iter().all(|end| triangles[i].contains(end)))
                .collect();
            for i in with_it.into_iter().filter(|_| is_on) {
                let whole = triangles[i];
                let put = |old: Point| whole.map(|corner| if corner == old { cut } else { corner });
                triangles[i] = put(a);
                triangles.push(put(b));
            }
        }
    }
    let mut removed = None;
    for _ in 0..rng.int(0, triangles.len() as i64 / 3) {
        let number = rng.int(0, triangles.len() as i64 - 1) as usize;
        removed = Some(triangles.swap_remove(number));
    }
    let edges = || triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let outline = edges().filter(|&[a, b]| edges().all(|other| other != [b, a]));
    Right { polygon: Polygon::new(walks(outline.collect())), triangles, removed }
}

/// The triangles between two chains with the same x, which are an ulp apart in places.
fn corridor(rng: &mut Rng) -> Right {
    let mut x = 0.0;
    let (mut low, mut high) = (Vec::new(), Vec::new());
    for _ in 0..rng.int(2, 12) {
        let y = rng.signed();
        low.push([x, y]);
        high.push([x, if rng.chance(2) { nudge_f64(y, 1) } else { y + rng.unit() + 0.1 }]);
        x = if rng.chance(4) { nudge_f64(x, 1) } else { x + rng.unit() };
    }
    // A chain may come back to one x twice after rounding; there is no quadrilateral then.
    let mut triangles = Vec::new();
    for i in 1..low.len() {
        let [a, b, c, d] = [low[i - 1], low[i], high[i], high[i - 1]];
        let halves = if rng.chance(2) { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] };
        triangles.extend(halves);
    }
    let outline = low.into_iter().chain(high.into_iter().rev()).collect();
    Right { polygon: Polygon::new(vec![outline]), triangles, removed: None }
}

/// A star, and triangles from its centre, which is an added point.
fn fan(rng: &mut Rng) -> Right {
    let (scale, offset) = (2_f64.powi(rng.int(-60, 60) as i32), rng.int(-5000, 5000) as f64);
    let place = |point: Point| point.map(|value| (value + offset) * scale);
    let outline: Vec<Point> = star(rng).into_iter().map(place).collect();
    let next = outline.iter().cycle().skip(1);
    let triangles = outline.iter().zip(next).map(|(&a, &b)| [place([0.0, 0.0]), a, b]).collect();
    Right { polygon: Polygon::new(vec![outline]), triangles, removed: None }
}

/// Each of the 10,000 partitions, mirrored or not, in any order.
fn each_right(job: &mut dyn FnMut(u64, Right, &mut Rng)) {
    for index in 0..10_000 {
        let mut rng = Rng::new("right partitions", 1, index);
        let mut right = match index % 10 {
            0..4 => cut_triangle(&mut rng),
            4..7 => corridor(&mut rng),
            _ => fan(&mut rng),
        };
        let is_clockwise = rng.chance(2);
        for triangle in right.triangles.iter_mut().chain(&mut right.removed) {
            triangle.rotate_left(rng.int(0, 2) as usize);
            if is_clockwise {
                triangle.swap(0, 1);
            }
        }
        let first = rng.int(0, right.triangles.len() as i64 - 1) as usize;
        right.triangles.rotate_left(first);
        job(index, right, &mut rng);
    }
}

#[test]
fn right_partitions_are_right() {
    let mut triangles = 0;
    each_right(&mut |index, right, _| {
        let finding = judge_partition(&right.polygon, &right.triangles, &Options::default());
        assert!(finding.as_ref().is_ok_and(|f| f.faults.is_empty()), "{index}: {finding:?}");
        triangles += right.triangles.len();
    });
    assert!(triangles > 100_000, "{triangles}");
}

/// A corner moved by an ulp to a point that its triangle does not contain.
fn grown([a, b, c]: Triangle) -> Option<Triangle> {
    let sign = orientation(a, b, c);
    let moved = [
        [nudge_f64(c[0], 1), c[1]],
        [nudge_f64(c[0], -1), c[1]],
        [c[0], nudge_f64(c[1], 1)],
        [c[0], nudge_f64(c[1], -1)],
    ];
    let is_outside = |&c: &Point| orientation(b, [c[0], c[1]], a) == sign;
    let leaves = |&p: &Point| {
        [[a, b], [b, c], [c, a]]
            .iter()
            .any(|&[from, to]| orientation(from, to, p) == sign.reverse())
    };
    moved.into_iter().filter(is_outside).find(leaves).map(|c| [a, b, c])
}

/// Faults that are planted in the 10,000 partitions are found, as what they are.
#[test]
fn planted_faults_are_found() {
    let mut planted = [0; 6];
    each_right(&mut |index, right, rng| {
        let Right { polygon, triangles, removed } = right;
        let number = rng.int(0, triangles.len() as i64 - 1) as usize;
        let chosen = triangles[number];
        // One of them in turn: all six in each are 51,139 faults, all found, in ten seconds.
        let mut plant = |place: usize, faulty: Vec<Triangle>, expected: &[FaultKind]| {
            if index / 10 % 6 != place as u64 {
                return;
            }
            planted[place] += 1;
            let found = kinds(&polygon, &faulty, &Options::default());
            assert!(found.iter().any(|kind| expected.contains(kind)), "{index} {place}: {found:?}");
        };
        let replaced = |with: &[Triangle]| {
            let mut faulty = triangles.clone();
            faulty.splice(number..=number, with.iter().copied());
            faulty
        };
        if let Some(grown) = grown(chosen) {
            plant(0, replaced(&[grown]), &[FaultKind::Overlap, FaultKind::Outside]);
        }
        let [a, b, c] = chosen;
        if triangles.len() > 2 {
            plant(1, replaced(&[[b, a, c]]), &[FaultKind::Flipped]);
        }
        plant(2, replaced(&[]), &[FaultKind::Gap]);
        plant(3, replaced(&[chosen, chosen]), &[FaultKind::Overlap]);
        let middle = [0, 1].map(|axis| a[axis] / 2.0 + b[axis] / 2.0);
        if orientation(a, b, middle).is_eq() && middle != a && middle != b {
            plant(4, replaced(&[[a, middle, c], [middle, b, c]]), &[FaultKind::TJunction]);
        }
        if let Some(removed) = removed {
            plant(5, [triangles.clone(), vec![removed]].concat(), &[FaultKind::Outside]);
        }
    });
    println!(
        "overlap of an ulp, flipped, missing, duplicate, T-junction, hole filled: {planted:?}"
    );
    assert!(planted.iter().all(|&count| count > 500), "{planted:?}");
}

/// Triangles with corners anywhere on a small grid: at samples, they cover as the decision says.
#[test]
fn decisions_agree_with_samples() {
    let contains = |[a, b, c]: &Triangle, p: Point| {
        let signs = [[a, b], [b, c], [c, a]].map(|[&a, &b]| orientation(a, b, p));
        signs.iter().all(|sign| sign.is_gt()) || signs.iter().all(|sign| sign.is_lt())
    };
    let (mut wrong, mut right) = (0, 0);
    for index in 0..1_000 {
        let mut rng = Rng::new("samples", 1, index);
        let polygon = Polygon::new(vec![square(0.0, 4.0), square(1.0, 2.0)]);
        let (outer, inner) = (square(0.0, 4.0), square(1.0, 2.0));
        let side = |i: usize| {
            let (a, b, c, d) = (outer[i], outer[(i + 1) % 4], inner[(i + 1) % 4], inner[i]);
            [[a, b, d], [d, b, c]]
        };
        let mut triangles: Vec<Triangle> = (0..4).flat_map(side).collect();
        for _ in 0..rng.int(0, 2) {
            let number = rng.int(0, triangles.len() as i64 - 1) as usize;
            triangles[number][rng.int(0, 2) as usize] =
                [rng.int(0, 4) as f64, rng.int(0, 4) as f64];
        }
        let options = Options::default()
            .winding(Winding::Any)
            .allow_degenerate_triangles()
            .allow_t_junctions();
        let found = kinds(&polygon, &triangles, &options);
        let mut seen = Vec::new();
        // Samples that are on no line between points of the grid.
        for i in 0..64 * 64 {
            let p = [f64::from(i % 64) / 16.0 + 0.013, f64::from(i / 64) / 16.0 + 0.0271];
            let count = triangles.iter().filter(|triangle| contains(triangle, p)).count();
            let is_inside = !(1.0..2.0).contains(&p[0]) || !(1.0..2.0).contains(&p[1]);
            match (count, is_inside) {
                (0, true) => seen.push(FaultKind::Gap),
                (2.., true) => seen.push(FaultKind::Overlap),
                (1.., false) => seen.push(FaultKind::Outside),
                _ => {}
            }
        }
        seen.sort();
        seen.dedup();
        // One place of each piece is looked at, so that some kind is found of those that samples see.
        assert_eq!(seen.is_empty(), found.is_empty(), "{index}: {triangles:?}");
        assert!(
            found.iter().all(|kind| seen.contains(kind)),
            "{index}: {seen:?} {found:?} {triangles:?}"
        );
        if seen.is_empty() { right += 1 } else { wrong += 1 }
    }
    assert!(right > 200 && wrong > 400, "{right} {wrong}");
}

/// A fan is right for no star with a reflex vertex near its start.
fn fan_of_first(polygon: &Polygon) -> Vec<Triangle> {
    let vertices = &polygon.contours[0];
    (2..vertices.len()).map(|i| [vertices[0], vertices[i - 1], vertices[i]]).collect()
}

#[test]
fn a_tessellator_is_judged() {
    let options = Options::default().cases(50).family(Family::Star).family(Family::Comb);
    let report = judge_partitions(&fan_of_first, &options).unwrap();
    assert_eq!(report.sum().polygons, 100);
    let message = report.check().unwrap_err().to_string();
    for part in [
        "of 100 polygons",
        "the smallest polygon",
        "Polygon::new(vec![vec![[",
        "triangle 0: [[",
        "only(",
    ] {
        assert!(message.contains(part), "{part}: {message}");
    }
    // A fan first fails at four vertices.
    let outside =
        report.failures.iter().find(|failure| failure.evidence.kind == FaultKind::Outside).unwrap();
    assert_eq!(outside.case.contours[0].len(), 4, "{message}");
    println!("{message}");
}

/// A fan around another vertex each time.
struct Turning(AtomicUsize);
impl Tessellate for Turning {
    fn triangles(&self, polygon: &Polygon) -> Result<Vec<Triangle>, Refused> {
        let mut turned = polygon.clone();
        let vertices = &mut turned.contours[0];
        let by = self.0.fetch_add(1, Ordering::Relaxed) % vertices.len();
        vertices.rotate_left(by);
        Ok(fan_of_first(&turned))
    }
}

/// Every failing polygon is asked again. What changes is said first, with both answers; nothing is made smaller or explained.
#[test]
fn answers_that_change_are_said_first() {
    let options = Options::default().cases(50).family(Family::Star).family(Family::Comb);
    let report = judge_partitions(&Turning(AtomicUsize::new(0)), &options).unwrap();
    let message = report.check().unwrap_err().to_string();
    assert!(message.starts_with("The answers change from one time to the next"), "{message}");
    for part in [": a polygon that was found", "triangle 0: [[", "asked again:", "found in: "] {
        assert!(message.contains(part), "{part}: {message}");
    }
    for part in ["the smallest polygon", "cause was recognised", "probable cause"] {
        assert!(!message.contains(part), "{part}: {message}");
    }
}

struct Refusing;
impl Tessellate for Refusing {
    fn triangles(&self, polygon: &Polygon) -> Result<Vec<Triangle>, Refused> {
        assert!(polygon.contours.len() < 2, "more than one contour");
        Err(Refused("no polygons today".to_owned()))
    }
}

#[test]
fn refusals_and_panics_are_faults() {
    let report = judge_partitions(&Refusing, &Options::default().cases(10)).unwrap();
    let kinds: Vec<_> = report.failures.iter().map(|failure| failure.evidence.kind).collect();
    assert_eq!(kinds, [FaultKind::Panicked, FaultKind::Refused]);
    let message = report.check().unwrap_err().to_string();
    assert!(message.contains("no polygons today") && message.contains("more than one contour"));
    assert_eq!(report.sum().wrong, report.sum().polygons);
}

struct OneContour;
impl Tessellate for OneContour {
    fn triangles(&self, _: &Polygon) -> Result<Vec<Triangle>, Refused> {
        Ok(Vec::new())
    }

    fn accepts(&self, polygon: &Polygon) -> bool {
        polygon.contours.len() == 1
    }
}

#[test]
fn what_is_not_accepted_is_counted() {
    let options = Options::default().cases(50);
    let sum = judge_partitions(&OneContour, &options.clone().family(Family::SnappedCircle));
    let sum = sum.unwrap().sum();
    assert!(sum.left_out > 10 && sum.wrong > 10 && sum.polygons + sum.left_out == 50, "{sum:?}");
    let none = judge_partitions(&OneContour, &options.family(Family::Islands)).unwrap_err();
    assert!(none.to_string().contains("accepts none"), "{none}");
}

#[test]
#[should_panic(expected = "cases")]
fn no_polygon_is_no_success() {
    crate::assert_partition!(fan_of_first, Options::default().cases(0));
}

#[test]
#[should_panic(expected = "polygons are not covered exactly once")]
fn a_wrong_tessellator_fails_a_test() {
    crate::assert_partition!(fan_of_first, Options::default().cases(20));
}
