//! What is judged by which rule: one table of clauses of specifications, documentation and declarations; and how an answer stands to them.

use crate::comparison::Rule;

/// A document by which something is judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Source {
    /// Its name in the table.
    pub key: &'static str,
    pub title: &'static str,
    pub version: &'static str,
    /// Its version in Chinese.
    pub chinese: &'static str,
    /// What it says of samples on an edge of a triangle.
    pub edges: Rule,
    /// Whether of two triangles that share an edge exactly one has a sample on it.
    pub shares: bool,
}

/// Its sections are named by their titles and anchors.
pub const VULKAN: Source = Source {
    key: "vulkan",
    title: "Vulkan",
    version: "specification 1.3 with extensions",
    chinese: "规范 1.3，含扩展",
    edges: Rule::Unspecified,
    shares: true,
};
/// WebGL 2 refers to it.
pub const OPENGL_ES: Source = Source {
    key: "opengl-es",
    title: "OpenGL ES 3.0",
    version: "specification, by its sections",
    chinese: "规范，按章节号",
    edges: Rule::Unspecified,
    shares: true,
};
pub const WEBGPU: Source = Source {
    key: "webgpu",
    title: "WebGPU",
    version: "editor's draft of 2024",
    chinese: "2024 年的编辑草案",
    edges: Rule::Unspecified,
    shares: false,
};
pub const GDAL: Source = Source {
    key: "gdal",
    title: "GDAL",
    version: "documentation of the C API, in its source at commit 0354358b",
    chinese: "C API 的文档，见源码的提交 0354358b",
    edges: Rule::Unspecified,
    shares: false,
};

/// What a program declares by a rule of the line protocol.
#[must_use]
pub fn declared(rule: Rule) -> Source {
    let shares = !matches!(rule, Rule::Inclusive | Rule::Strict | Rule::Unspecified);
    Source {
        key: "declared",
        title: "A declared rule",
        version: "line protocol, version 2",
        chinese: "行协议，版本 2",
        edges: rule,
        shares,
    }
}

/// A part of a specification by which something is judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Clause {
    pub section: &'static str,
    /// What has to be drawn, and what must not be.
    pub says: &'static str,
    /// What may be drawn or not.
    pub open: &'static str,
    /// What is judged by it.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub name: &'static str,
    #[cfg_attr(feature = "serde", serde(skip))]
    pub key: &'static str,
    /// Its name, and what it asks for and leaves open, in Chinese.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub chinese: [&'static str; 3],
    /// Its own words, and where they stand; both empty where they were not at hand.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub quote: [&'static str; 2],
}

impl Source {
    /// Its rows of the table, in order.
    pub fn clauses(self) -> impl Iterator<Item = Clause> {
        let rows = include_str!("clauses.md").lines().filter_map(|line| line.strip_prefix("| "));
        let cells = rows.map(|row| row.trim_end_matches(" |").split(" | ").collect::<Vec<_>>());
        cells.filter_map(move |cells| {
            let [source, key, name, section, says, open, zh, zh_says, zh_open, words, place] =
                cells[..]
            else {
                return None;
            };
            (source == self.key).then_some(Clause {
                section,
                says,
                open,
                name,
                key,
                chinese: [zh, zh_says, zh_open],
                quote: [words, place],
            })
        })
    }

    /// A row of the table.
    ///
    /// # Panics
    /// If it has no such row.
    #[must_use]
    pub fn clause(self, key: &str) -> Clause {
        let found = self.clauses().find(|clause| clause.key == key);
        found.unwrap_or_else(|| panic!("{} has no clause '{key}'", self.title))
    }
}

/// How what was drawn stands to the specification and to the oracle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "kebab-case"))]
pub enum Standing {
    /// What the oracle says, to the pixel; of values, within the derived bound.
    Equal,
    /// Something else, but nothing that the specification forbids.
    Allowed,
    /// Outside the specification, as the baseline of known faults says.
    Known,
    NotOffered,
    /// Fixed: the baseline names a fault that no case shows any more.
    Stale,
    Outside,
    NoAnswer,
}

impl Standing {
    #[must_use]
    pub fn of(is_equal: bool, is_allowed: bool) -> Self {
        match (is_equal, is_allowed) {
            (true, _) => Self::Equal,
            (_, true) => Self::Allowed,
            _ => Self::Outside,
        }
    }

    #[must_use]
    pub fn is_good(self) -> bool {
        self <= Self::NotOffered
    }

    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Equal => "equal",
            Self::Allowed => "allowed, but different",
            Self::Known => "known fault",
            Self::NotOffered => "not offered",
            Self::Stale => "no longer wrong",
            Self::Outside => "OUTSIDE THE SPECIFICATION",
            Self::NoAnswer => "NO ANSWER",
        }
    }
}
