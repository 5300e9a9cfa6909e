//! Cases for the report page: positions as whole numbers, and what everybody draws there.
//!
//! Each case has its engines, the oracle and the specimens that can draw it, all by hit counts. The
//! page computes the edge functions itself from the positions; nothing here rounds one.

use serde::Serialize;

use super::chapter::{Chapter, chapter_of_source};
use super::drawn;
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::{ScreenTriangle, ScreenVertex};
use rasterproof_faults::planted;
use rasterproof_faults::published::RealVertex;
use rasterproof_faults::published::catalogue::{CARDS, Exhibit, TriangleCase};
use rasterproof_judge::pictured::Pictured;
use rasterproof_registry::comparison::{EnginesToJudge, Hits};
use rasterproof_registry::engines::SPECIMENS;
use rasterproof_registry::named;
use rasterproof_registry::published_check::{line_case, real_triangles};
use rasterproof_verify::cases::named::Input;
use rasterproof_verify::cases::{self, Case, Family, Shape};
use rasterproof_verify::comparison::{Tally, Verdict, oracle_hits};

/// A case of the page: positions, and what is drawn there, as the script reads it.
#[derive(Clone, Debug, Serialize)]
pub struct CaseView {
    /// Its name; unique within the page, and its address.
    pub name: String,
    /// Where the case is from, in a sentence.
    #[serde(serialize_with = "crate::words::serialize_grouped")]
    pub about: String,
    pub kind: Kind,
    /// What was found, in a sentence, or nothing.
    #[serde(serialize_with = "crate::words::serialize_grouped")]
    pub found: String,
    pub command: String,
    /// The page of the docs that explains what decides it.
    pub chapter: Chapter,
    /// What the picture shows, where that is not the pixels of the case.
    pictured: String,
    window: PixelRect,
    shape: ShapeView,
    /// What each of them draws, the engines first.
    layers: Vec<Layer>,
    /// The two layers that are compared first.
    start: [usize; 2],
}

/// Why a case is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// It was found to be wrong, and made small.
    Failing,
    /// Its values came closest to a bound.
    Closest,
    /// The first of a family off the lattice.
    OffGrid,
    /// It has a name in the catalogue of hard cases.
    Named,
    /// It exposes a published fault.
    Specimen,
}

/// Positions: subpixels, whole pixels, or doubles in pixels.
#[derive(Clone, Debug, Serialize)]
#[serde(tag = "kind", content = "points", rename_all = "lowercase")]
enum ShapeView {
    Triangles(Vec<[[i32; 2]; 3]>),
    Lines(Vec<[[i32; 2]; 2]>),
    /// In pixels, off the lattice; empty where there is no shape to show.
    Free(Vec<[[f64; 2]; 3]>),
}

/// What one of them draws, or several of them who draw alike.
#[derive(Clone, Debug, Serialize)]
struct Layer {
    /// Several where specimens draw alike.
    names: Vec<String>,
    role: Role,
    /// Run lengths and hits, by rows from the top: n, hits, n, hits ...; empty where it is refused.
    runs: Vec<u32>,
    covered: u64,
    /// Pixels that differ from the oracle's, or from what is expected.
    tally: Tally,
    /// Why nothing is drawn, or nothing.
    refused: String,
}

/// Who draws a layer, by which the page colours its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
enum Role {
    Engine,
    /// An engine with a planted fault.
    Planted,
    Oracle,
    /// Of a program that declares another convention than this project's.
    Expected,
    /// A published algorithm with its faults.
    Specimen,
}

/// Who draws, as what, and what it is.
type EngineHits = (String, Role, Hits);

/// The failing cases of a run, then for each family the one that came closest to a bound, then
/// every named case. `repeat` gives the command that repeats a failing case.
pub fn of_verdict(
    verdict: &Verdict,
    judged: &EnginesToJudge,
    repeat: impl Fn(&str, u64) -> String,
) -> Vec<CaseView> {
    let mut views = Vec::new();
    for f in &verdict.failures {
        // A failing case begins with the two that disagree about it.
        let name = format!("{}#{}", f.family, f.index);
        let about = format!("found in {} #{} of seed {}, shrunk", f.family, f.index, f.seed);
        let found = format!("{} against {}: {}", f.evidence.pair[0], f.evidence.pair[1], f.what);
        let mut view = of_case(name, about, Kind::Failing, &f.case, judged);
        view.start = [view.place(&f.evidence.pair[0], 0), view.place(&f.evidence.pair[1], 1)];
        views.push(CaseView { found, command: repeat(f.family, f.index), ..view });
    }
    // Right cases follow, for readers who want to see what was judged.
    views.extend(closest(verdict, judged));
    views.extend(unsnapped_samples(verdict, judged));
    views.extend(every_named(judged));
    unique(&mut views);
    views
}

/// For each family the case whose values came closest to their bound, the closest family first.
fn closest(verdict: &Verdict, judged: &EnginesToJudge) -> Vec<CaseView> {
    let seed = verdict.options.seed;
    let mut worst = Vec::new();
    for f in &verdict.families {
        let pairs = f.pairs.iter().filter(|p| p.is_by_oracle() && p.values > 0);
        let Some(pair) = pairs.max_by(|a, b| a.worst().total_cmp(&b.worst())) else { continue };
        if pair.worst() > 0.0 && pair.worst() <= 1.0 {
            worst.push((f, pair));
        }
    }
    // The closest first, since it is the most interesting.
    worst.sort_by(|(_, a), (_, b)| b.worst().total_cmp(&a.worst()));
    let mut views = Vec::new();
    for (report, pair) in worst {
        let Some(family) = cases::families().find(|f| f.name == report.family) else { continue };
        let view = of_family(family, seed, pair.worst_case, Kind::Closest, judged);
        // Wrong pixels are the news of such a case, and stand among the failing ones.
        let is_wrong = |l: &Layer| l.role != Role::Specimen && l.tally.total() > 0;
        if !view.layers.iter().any(is_wrong) {
            let found = format!("a value of {} at {:.2} of its bound", pair.actual, pair.worst());
            views.push(CaseView { found, ..view });
        }
    }
    views
}

/// The first case of each family that is not snapped: they have no bounds to come close to.
fn unsnapped_samples(verdict: &Verdict, judged: &EnginesToJudge) -> Vec<CaseView> {
    let seed = verdict.options.seed;
    let families = cases::unsnapped::FAMILIES.iter();
    let families = families.filter(|f| verdict.families.iter().any(|r| r.family == f.name));
    families.map(|family| of_family(family, seed, 0, Kind::OffGrid, judged)).collect()
}

/// A case of a family as it is generated, with the command that shows it.
fn of_family(
    family: &Family,
    seed: u64,
    index: u64,
    kind: Kind,
    judged: &EnginesToJudge,
) -> CaseView {
    // The same name that the command takes.
    let name = format!("{}#{index}", family.name);
    let command = format!("rasterproof inspect {name} --seed {seed}");
    let view = of_case(name, family.about.to_owned(), kind, &family.case(seed, index), judged);
    CaseView { command, ..view }
}

/// Every case of the catalogue but those that are refused.
fn every_named(judged: &EnginesToJudge) -> Vec<CaseView> {
    let mut views = Vec::new();
    for named in named::named() {
        let Input::Drawn { case, .. } = named.input else { continue };
        let (name, about) = (named.name.to_owned(), named.about.to_owned());
        let view = of_case(name, about, Kind::Named, &case, judged);
        views.push(CaseView { command: format!("rasterproof inspect {}", named.name), ..view });
    }
    views
}

/// The case that exposes each specimen that draws triangles or lines.
pub fn of_specimens() -> Vec<CaseView> {
    let judged = EnginesToJudge::all();
    let mut views = Vec::new();
    for card in CARDS {
        let (case, shown) = match &card.exhibit {
            Exhibit::Triangles([case, _]) => match snapped(case) {
                Some(snapped) => (snapped, case.name),
                None => continue,
            },
            Exhibit::Lines([case, _]) => (line_case(case), case.name),
            Exhibit::Scene(..) => continue,
        };
        let about = format!("{}: {shown}", card.source);
        let mut view = of_case(card.name.to_owned(), about, Kind::Specimen, &case, &judged);
        // The published code is compared with the oracle.
        let place = view.place(card.name, 0);
        // A fault of the values alone is for the pictures to show.
        if view.layers[place].tally.total() == 0 && view.layers[place].refused.is_empty() {
            continue;
        }
        view.start = [place, view.place("oracle", 1)];
        let found = format!("{}; cure: {}", card.fault, card.cure);
        let command = format!("rasterproof specimens --specimen {}", card.name);
        let chapter = chapter_of_source(card.source);
        views.push(CaseView { found, command, chapter, ..view });
    }
    views
}

/// The case on the lattice: the page shows whole subpixels.
fn snapped(case: &TriangleCase) -> Option<Case> {
    let vertex = |v: &RealVertex| {
        let (x, y) = (v.position_px.x, v.position_px.y);
        ScreenVertex::new(x, y, v.depth, v.w, v.varying).ok()
    };
    let mut list = Vec::new();
    for [a, b, c] in &real_triangles(case) {
        list.push(ScreenTriangle { vertices: [vertex(a)?, vertex(b)?, vertex(c)?] });
    }
    let window = PixelRect::window(case.side_px, case.side_px);
    Some(Case { window, shape: Shape::Triangles { list, disjoint: false } })
}

/// A failing case of a program that was judged, or of two that were compared, beside what the engines and the specimens draw. Where
/// something else is expected of it than of them, or the picture is another than theirs, beside what
/// was expected alone.
pub fn of_program(
    name: String,
    about: String,
    case: &Case,
    programs: &[&str],
    picture: Option<&Pictured>,
) -> CaseView {
    let mut view = of_case(name, about, Kind::Failing, case, &EnginesToJudge::default());
    // The engines and the specimens draw the case; the program's picture comes from the judge.
    let Some(Pictured { drawn, other, expected, of, moved }) = picture else { return view };
    // Each program with its own picture, compared with what is expected.
    let pictures = programs.iter().zip([drawn].into_iter().chain(other));
    let drawn = pictures
        .map(|(by, drawn)| layer((*by).to_owned(), Role::Engine, Ok(drawn.clone()), expected));
    let truth = oracle_hits(case);
    if !of.is_empty() || *expected != truth {
        let target = layer("expected".to_owned(), Role::Expected, Ok(expected.clone()), expected);
        (view.layers, view.start) = (drawn.chain([target]).collect(), [0, 1]);
        view.window = expected.bounds();
        if !of.is_empty() {
            view.pictured = format!("The picture: {of}.");
        }
        if let Some(moved) = moved {
            let corners = moved.iter().map(|c| c.map_array(|p| [p.x, p.y]));
            view.shape = ShapeView::Triangles(corners.collect());
        }
        return view;
    }
    // The program comes first, and is compared with the other program or with the oracle.
    view.layers.splice(0..0, drawn);
    view.start = [0, if other.is_some() { 1 } else { view.place("oracle", 1) }];
    view
}

/// Gives views of one name names that differ.
fn unique(views: &mut [CaseView]) {
    let mut seen = std::collections::HashMap::new();
    for view in views {
        // The second one of a name gets a 2.
        let times: &mut u32 = seen.entry(view.name.clone()).or_insert(0);
        *times += 1;
        if *times > 1 {
            view.name = format!("{}~{times}", view.name);
        }
    }
}

/// A case, drawn by those that are judged, the other engines, the oracle and the specimens.
pub fn of_case(
    name: String,
    about: String,
    kind: Kind,
    case: &Case,
    judged: &EnginesToJudge,
) -> CaseView {
    let truth = oracle_hits(case);
    // Whoever draws the case: the engines, then the oracle, then the specimens.
    let mut drawn: Vec<EngineHits> =
        judged.with_others().hits(case).into_iter().map(with_role).collect();
    drawn.push(("oracle".to_owned(), Role::Oracle, Ok(truth.clone())));
    for entry in &SPECIMENS {
        if let Some(hits) = drawn::by_specimen(entry, case) {
            drawn.push((entry.name.to_owned(), Role::Specimen, hits));
        }
    }
    let shape = match &case.shape {
        Shape::Triangles { list, .. } => {
            let corners = list.iter().map(|t| t.corners().map_array(|p| [p.x, p.y]));
            ShapeView::Triangles(corners.collect())
        }
        Shape::Lines(list) => {
            let ends = list.iter().map(|l| l.ends.map_array(|e| [e.pixel.x, e.pixel.y]));
            ShapeView::Lines(ends.collect())
        }
        Shape::Unsnapped { list, .. } => ShapeView::Free(list.iter().map(|t| t.px()).collect()),
        Shape::Numbers { .. } => ShapeView::Free(Vec::new()),
    };
    // Each of them as a layer, but for specimens that draw what another one draws.
    let mut layers: Vec<Layer> = Vec::new();
    for (name, role, hits) in drawn {
        let layer = layer(name, role, hits, &truth);
        // Specimens of one author often draw alike: one layer for all of them.
        let alike = layers.iter_mut().find(|l| {
            role == Role::Specimen
                && l.role == Role::Specimen
                && (&l.runs, &l.refused) == (&layer.runs, &layer.refused)
        });
        match alike {
            Some(other) => other.names.extend(layer.names),
            None => layers.push(layer),
        }
    }
    // The page begins with two layers that differ, if there are any.
    let (start, window) = (start(&layers), case.window);
    let [found, command, pictured] = [const { String::new() }; 3];
    let chapter = chapter(kind, &shape);
    CaseView { name, about, kind, found, command, chapter, pictured, window, shape, layers, start }
}

/// What an engine draws, or a planted fault.
fn with_role((name, hits): (String, Hits)) -> EngineHits {
    // Planted faults are engines by their interface.
    let role = if planted::about(&name).is_some() { Role::Planted } else { Role::Engine };
    (name, role, hits)
}

/// Where the docs derive what decides such a case.
fn chapter(kind: Kind, shape: &ShapeView) -> Chapter {
    const RULE: &str = "ch02-edge-functions.md#the-derivation-the-top-left-rule";
    // The nearest page to what is shown.
    let (title, path) = match (kind, shape) {
        (_, ShapeView::Lines(_)) => ("chapter 2, lines", "ch02.md"),
        (_, ShapeView::Free(_)) => ("off the grid", "offgrid.md"),
        (Kind::Closest, _) => ("chapter 3, values at the pixels", "ch03.md"),
        _ => ("chapter 2, the top-left rule", RULE),
    };
    Chapter { title, path }
}

fn layer(name: String, role: Role, hits: Hits, truth: &Coverage) -> Layer {
    // Who panics or refuses draws nothing, and the reason is shown.
    let (runs, covered, tally, refused) = match hits {
        Ok(hits) => (runs(&hits), hits.covered(), Tally::between(&hits, truth), String::new()),
        Err(message) => (Vec::new(), 0, Tally::default(), message),
    };
    Layer { names: vec![name], role, runs, covered, tally, refused }
}

fn runs(hits: &Coverage) -> Vec<u32> {
    let mut runs: Vec<u32> = Vec::new();
    // A run may go on in the next row.
    for (_, row) in hits.rows() {
        for &hits in row {
            match runs.as_mut_slice() {
                [.., count, last] if *last == u32::from(hits) => *count += 1,
                _ => runs.extend([1, u32::from(hits)]),
            }
        }
    }
    runs
}

/// A layer that is wrong against the oracle: an engine before a specimen. Where all agree, the first
/// two engines.
fn start(layers: &[Layer]) -> [usize; 2] {
    let oracle = layers.iter().position(|l| l.role == Role::Oracle).unwrap_or(0);
    for of_specimens in [false, true] {
        let (mut worst, mut most) = (0, 0);
        for (at, layer) in layers.iter().enumerate() {
            let wrong = layer.tally.total();
            // Of layers that are as wrong, the last one.
            if (layer.role == Role::Specimen) == of_specimens && wrong > 0 && wrong >= most {
                (worst, most) = (at, wrong);
            }
        }
        if most > 0 {
            return [worst, oracle];
        }
    }
    [0, 1.min(layers.len().saturating_sub(1))]
}

impl CaseView {
    /// The layer that `name` draws, or `otherwise`.
    fn place(&self, name: &str, otherwise: usize) -> usize {
        self.layers.iter().position(|l| l.names.iter().any(|n| n == name)).unwrap_or(otherwise)
    }
}
