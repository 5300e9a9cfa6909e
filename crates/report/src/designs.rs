//! How much of what can be asked the designs ask, beside the families: the table of `docs/designs.md`.

use crate::words::thousands;
use rasterproof_judge::Options;
use rasterproof_verify::cases::facts::asked::{AskedClasses, DesignShare};
use rasterproof_verify::cases::facts::{self, Topic};
use rasterproof_verify::cases::{self, Family, Limits};
use rasterproof_verify::partition::{self, Coordinates, Family as PolygonFamily};

/// How many of the pairs and triples of a design's facts occur in some numbers of cases, and in the families alone.
pub struct Shares {
    pub whole: DesignShare,
    /// By 1,000 cases of the design, by the default numbers of `judge` and `verify` (nothing where it does not ask the design), and by
    /// 100,000 cases, for a whole table.
    pub by_design: [Option<AskedClasses>; 4],
    pub by_families: AskedClasses,
}

/// The default numbers of cases of a design, in `judge` and in `verify`.
type Defaults = [Option<u64>; 2];

/// The numbers of cases by which shares are counted; the last one only for a whole table.
fn counts([of_judge, of_verify]: Defaults, is_whole: bool) -> [Option<u64>; 4] {
    [Some(1000), of_judge, of_verify, is_whole.then_some(100_000)]
}

impl Shares {
    /// The shares of pairs and of triples in percent.
    pub fn percent(&self, asked: &AskedClasses) -> [f64; 2] {
        let percent = |part: usize, of: usize| 100.0 * part as f64 / of as f64;
        [percent(asked.pairs, self.whole.of_pairs), percent(asked.triples, self.whole.of_triples)]
    }

    /// Its row of the table, the same in both languages.
    pub fn row(&self) -> String {
        let DesignShare { family, facts, classes, of_pairs, of_triples, .. } = &self.whole;
        let share = |asked: Option<&AskedClasses>| {
            let percent = asked.map(|asked| self.percent(asked));
            percent.map_or("-".to_owned(), |[pairs, triples]| format!("{pairs:.1}/{triples:.1}"))
        };
        let all = self.by_design.iter().map(Option::as_ref).chain([Some(&self.by_families)]);
        let shares: Vec<String> = all.map(share).collect();
        format!(
            "| `{family}` | {facts} | {classes} | {} | {} | {} |\n",
            thousands(*of_pairs as u64),
            thousands(*of_triples as u64),
            shares.join(" | ")
        )
    }
}

/// The families that a design is compared with, and how many cases of each are asked by default.
fn families_beside(design: &str) -> (Vec<&'static Family>, u64) {
    let all = cases::families().chain(cases::near_plane::FAMILIES);
    let drawn = all.filter(|family| family.design().is_none());
    let chosen = drawn.filter(|family| {
        let name = family.name;
        let is_of_stages =
            ["depth-order", "depth-near-tie", "near-plane", "wide-line", "area"].contains(&name);
        match design {
            "line-design" => name.starts_with("line-"),
            "w-design" | "sample-value-design" => name.starts_with("w-"),
            "depth-design" => name.starts_with("depth-"),
            "near-design" => name == "near-plane",
            "wide-line-design" => name == "wide-line",
            "area-design" => name == "area",
            "mesh-design" => ["rectangle", "fan", "strip", "mesh-border"].contains(&name),
            _ => !is_of_stages && !name.starts_with("line-") && !name.starts_with("w-"),
        }
    });
    let of_engines = ["design", "w-design", "line-design"].contains(&design);
    let of_judge = Options::default().cases;
    // Of samples every eighth case of a family is asked.
    let cases = match design {
        "sample-design" => of_judge / 8,
        _ if of_engines => 20_000,
        _ => of_judge,
    };
    (chosen.collect(), cases)
}

/// Of the design of a topic, beside the families that ask about the same. A whole table also has 100,000 cases, which takes
/// minutes.
pub fn of_topic(topic: &Topic, is_whole: bool) -> Shares {
    let limits = Limits::default();
    let question = |index: u64| facts::design::case(topic, 1, index, &limits);
    let (families, cases) = families_beside(topic.name);
    let drawn = families.iter().flat_map(|family| (0..cases).map(|index| family.case(1, index)));
    let of_judge = Options::default().cases * topic.times();
    let defaults = [Some(of_judge), (cases == 20_000).then_some(cases)];
    Shares {
        whole: DesignShare::of(topic, 0..1000, &limits, &question),
        by_design: counts(defaults, is_whole).map(|count| {
            count.map(|count| AskedClasses::by(topic, &limits, (0..count).map(question)))
        }),
        by_families: AskedClasses::by(topic, &limits, drawn),
    }
}

/// The same of the polygons that tessellators are asked.
pub fn of_polygons(is_whole: bool) -> Shares {
    let (topic, limits) = (&partition::design::TOPIC, Coordinates::F64);
    let question = |index: u64| partition::design::polygon(1, index, limits);
    let families = PolygonFamily::ALL.into_iter().filter(|of| *of != PolygonFamily::Design);
    let drawn = families.flat_map(|of| (0..2000).map(move |index| of.polygon(1, index, limits)));
    Shares {
        whole: partition::design::asked(1, 0..1000, limits),
        by_design: counts([Some(2000), None], is_whole).map(|count| {
            count.map(|count| AskedClasses::by(topic, &limits, (0..count).map(question)))
        }),
        by_families: AskedClasses::by(topic, &limits, drawn),
    }
}
